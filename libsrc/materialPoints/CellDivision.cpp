#include "materialPoints/CellDivision.h"

#include <algorithm>
#include <cmath>

namespace caisson {

namespace {

using Offset = std::array<double, 2>; ///< place relative to corner 0 of the cell: sums then lose no digits
using Polygon = std::vector<Offset>;

Offset corner(const BackgroundMesh& mesh, int cell, int k)
{
    const int first = mesh.node(cell, 0);
    const int node = mesh.node(cell, k);
    return {mesh.r[node] - mesh.r[first], mesh.z[node] - mesh.z[first]};
}

Offset mix(const Offset& a, double weightA, const Offset& b, double weightB)
{
    return {weightA * a[0] + weightB * b[0], weightA * a[1] + weightB * b[1]};
}

/// Whether coordinate 0 of a quadrilateral (from corner 0 to corner 1) runs along r, or rather along z.
bool firstAlongR(const BackgroundMesh& mesh, int cell)
{
    const Offset middle =
        mix(corner(mesh, cell, 1), 1, mix(corner(mesh, cell, 2), 1, corner(mesh, cell, 3), -1), 1);
    return std::abs(middle[0]) >= std::abs(middle[1]);
}

int atLeast(int divisions, double length, double maxSpacing)
{
    return std::max(divisions, static_cast<int>(std::ceil(length / maxSpacing - 1e-9)));
}

class Subdivision
{
public:
    Subdivision(const BackgroundMesh& mesh, int cell)
        : geometry_(mesh.geometry), baseR_(mesh.r[mesh.node(cell, 0)]), baseZ_(mesh.z[mesh.node(cell, 0)])
    {
    }

    void quadrilateral(const std::array<Offset, 4>& c, int n, int m)
    {
        const auto place = [&](double xi, double eta) {
            return mix(mix(c[0], 1 - xi, c[1], xi), 1 - eta, mix(c[3], 1 - xi, c[2], xi), eta);
        };
        const auto part = [](double i, int count) { return i / count; };
        for (int j = 0; j < m; ++j) {
            for (int i = 0; i < n; ++i) {
                add({place(part(i, n), part(j, m)), place(part(i + 1, n), part(j, m)),
                     place(part(i + 1, n), part(j + 1, m)), place(part(i, n), part(j + 1, m))});
            }
        }
    }

    void triangle(const std::array<Offset, 3>& c, int split, int pattern)
    {
        const auto place = [&](int i, int j) {
            return mix(c[1], static_cast<double>(i) / split, c[2], static_cast<double>(j) / split);
        };
        for (int j = 0; j < split; ++j) {
            for (int i = 0; i + j < split; ++i) {
                points({place(i, j), place(i + 1, j), place(i, j + 1)}, pattern);
                if (i + j + 1 < split) {
                    points({place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)}, pattern);
                }
            }
        }
    }

    std::vector<SubCell> subCells;

private:
    /// Centre of volume, weighted with r in axisymmetry. Points there integrate linear functions exactly, and
    /// so the shape functions of triangles and rectangles: soil at rest is in balance at every node.
    [[nodiscard]] Offset centroid(const Polygon& polygon) const
    {
        double volume = 0;
        Offset moment{};
        for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
            const std::array<Offset, 3> c{polygon[0], polygon[k], polygon[k + 1]};
            const double area =
                ((c[1][0] - c[0][0]) * (c[2][1] - c[0][1]) - (c[2][0] - c[0][0]) * (c[1][1] - c[0][1])) / 2;
            const auto weight = [&](const Offset& place) {
                return geometry_ == Geometry::axisymmetric ? baseR_ + place[0] : 1.0;
            };
            double sumOfWeights = 0;
            Offset sum{};
            for (const Offset& place : c) {
                sumOfWeights += weight(place);
                sum = mix(sum, 1, place, 1);
            }
            volume += area * sumOfWeights / 3;
            for (int direction : {0, 1}) { // integral of a product of two linear functions over a triangle
                double products = 0;
                for (const Offset& place : c) {
                    products += weight(place) * place[direction];
                }
                moment[direction] += area * (sumOfWeights * sum[direction] + products) / 12;
            }
        }
        return {moment[0] / volume, moment[1] / volume};
    }

    void points(const std::array<Offset, 3>& c, int pattern)
    {
        const auto weighted = [&](int k, double own, double next, double last) {
            return mix(mix(c[k], own, c[(k + 1) % 3], next), 1, c[(k + 2) % 3], last);
        };
        const Offset centre = weighted(0, 1.0 / 3, 1.0 / 3, 1.0 / 3);
        if (pattern == 1) {
            add({c[0], c[1], c[2]});
            return;
        }
        for (int k = 0; k < 3; ++k) {
            const Offset middle = weighted(k, 0.5, 0.5, 0);
            const Offset middleBefore = weighted(k, 0.5, 0, 0.5);
            if (pattern == 3) {
                add({c[k], middle, centre, middleBefore});
            } else {
                add({c[k], middle, centre});
                add({c[k], centre, middleBefore});
            }
        }
    }

    void add(const Polygon& polygon)
    {
        const Offset point = centroid(polygon);
        const auto [low, high] = std::ranges::minmax_element(
            polygon, [](const Offset& a, const Offset& b) { return a[1] < b[1]; });
        subCells.push_back({baseR_ + point[0], baseZ_ + point[1], polygonVolume(geometry_, baseR_, polygon),
                            baseZ_ + (*low)[1], baseZ_ + (*high)[1]});
    }

    Geometry geometry_;
    double baseR_, baseZ_;
};

} // namespace

bool divideTriangle(int points, CellDivision& division)
{
    for (const int pattern : {3, 1, 6}) {
        const int split = static_cast<int>(std::lround(std::sqrt(static_cast<double>(points) / pattern)));
        if (split > 0 && pattern * split * split == points) {
            division.pattern = pattern;
            division.split = split;
            return true;
        }
    }
    return false;
}

CellDivision finer(const CellDivision& one, const CellDivision& other)
{
    const auto points = [](const CellDivision& division) {
        return division.pattern * division.split * division.split;
    };
    CellDivision result = points(one) >= points(other) ? one : other;
    result.along = {std::max(one.along[0], other.along[0]), std::max(one.along[1], other.along[1])};
    return result;
}

CellDivision refined(const BackgroundMesh& mesh, int cell, CellDivision division,
                     const std::array<double, 2>& maxSpacing)
{
    Polygon c;
    for (int k = 0; k < mesh.corners; ++k) {
        c.push_back(corner(mesh, cell, k));
    }
    if (mesh.corners == 4) {
        const Offset first = mix(mix(c[1], 0.5, c[0], -0.5), 1, mix(c[2], 0.5, c[3], -0.5), 1);
        const Offset second = mix(mix(c[3], 0.5, c[0], -0.5), 1, mix(c[2], 0.5, c[1], -0.5), 1);
        const bool firstIsR = firstAlongR(mesh, cell);
        const Offset& alongR = firstIsR ? first : second;
        const Offset& alongZ = firstIsR ? second : first;
        division.along[0] = atLeast(division.along[0], std::hypot(alongR[0], alongR[1]), maxSpacing[0]);
        division.along[1] = atLeast(division.along[1], std::hypot(alongZ[0], alongZ[1]), maxSpacing[1]);
        return division;
    }
    const int perSide = division.pattern == 1 ? 1 : division.pattern == 3 ? 2 : 3;
    for (const int direction : {0, 1}) {
        const auto [low, high] = std::minmax({c[0][direction], c[1][direction], c[2][direction]});
        division.split = atLeast(division.split, (high - low) / perSide, maxSpacing[direction]);
    }
    return division;
}

std::vector<SubCell> subdivide(const BackgroundMesh& mesh, int cell, const CellDivision& division)
{
    Subdivision result(mesh, cell);
    const auto c = [&](int k) { return corner(mesh, cell, k); };
    if (mesh.corners == 3) {
        result.triangle({c(0), c(1), c(2)}, division.split, division.pattern);
    } else if (firstAlongR(mesh, cell)) {
        result.quadrilateral({c(0), c(1), c(2), c(3)}, division.along[0], division.along[1]);
    } else {
        result.quadrilateral({c(0), c(1), c(2), c(3)}, division.along[1], division.along[0]);
    }
    return std::move(result.subCells);
}

double polygonVolume(Geometry geometry, double baseR, const std::vector<std::array<double, 2>>& offsets)
{
    // Fan of triangles: area times the mean r of the corners.
    double sum = 0;
    for (std::size_t k = 1; k + 1 < offsets.size(); ++k) {
        const Offset& a = offsets[0];
        const Offset& b = offsets[k];
        const Offset& c = offsets[k + 1];
        const double area = ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2;
        sum += geometry == Geometry::axisymmetric ? area * (baseR + (a[0] + b[0] + c[0]) / 3) : area;
    }
    return sum;
}

} // namespace caisson

#include "dictionary/Text.h"
#include "mesh/BackgroundMesh.h"
#include "mesh/MeshOrientation.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace caisson {

namespace {

using Eigen::Vector3d;

/// Deviations up to this part of the mesh's extent are rounding of points written with six digits.
constexpr double placeTolerance = 1e-5;

/// The steps from a polyMesh to the 2-D mesh; each returns false where the next one would make no sense.
class Extraction
{
public:
    Extraction(const PolyMesh& polyMesh, InputProblems& problems) : poly_(polyMesh), problems_(problems) {}

    BackgroundMesh mesh()
    {
        if (findPlanes() && orient() && findCellFaces() && pairPoints() && checkPlaces() && makeCells()) {
            joinCells();
            makeNodeCells();
            for (const PolyZone& zone : poly_.cellZones) {
                mesh_.cellZones[zone.name] = zone.cells;
            }
        }
        return std::move(mesh_);
    }

private:
    /// Which of the two planes a face or a point belongs to.
    enum Plane : unsigned char { neither = 0, front = 1, back = 2, both = 3 };

    bool problem(const std::string& message, const std::string& hint)
    {
        problems_.add({poly_.directory + "/boundary", 0}, message, hint);
        return false;
    }
    [[nodiscard]] Vector3d point(int p) const { return Vector3d::Map(poly_.points[p].data()); }
    [[nodiscard]] Vector3d areaVector(int face) const
    {
        const std::vector<int>& corner = poly_.faces[face];
        Vector3d sum = Vector3d::Zero();
        for (std::size_t k = 1; k + 1 < corner.size(); ++k) {
            sum += (point(corner[k]) - point(corner[0])).cross(point(corner[k + 1]) - point(corner[0]));
        }
        return sum / 2;
    }
    [[nodiscard]] std::string place(int face) const
    {
        const Vector3d p = point(poly_.faces[face][0]);
        return text("(%g %g %g)", p.x(), p.y(), p.z());
    }

    bool findPlanes();
    bool orient();
    bool findCellFaces();
    bool pairPoints();
    bool checkPlaces();
    bool makeCells();
    void startLowerLeft(int cell);
    void joinCells();
    void makeNodeCells();
    int sideOf(int cell, int face) const;

    const PolyMesh& poly_;
    InputProblems& problems_;
    BackgroundMesh mesh_;
    int cells_ = 0;
    std::vector<Plane> planeOf_;            ///< of each face
    std::array<Vector3d, 2> normal_;        ///< out of the mesh; front, back
    std::vector<int> frontFace_;            ///< of each cell
    std::vector<unsigned char> pointPlane_; ///< of each point
    std::vector<int> partner_;              ///< back point of each front point
    std::vector<int> nodeOfPoint_;          ///< node of each front point
};

/// Faces of the wedge or empty patches, divided by the side that they face.
bool Extraction::findPlanes()
{
    int faces[2] = {0, 0};
    for (const PolyPatch& patch : poly_.patches) {
        faces[0] += patch.type == "wedge" ? patch.faces : 0;
        faces[1] += patch.type == "empty" ? patch.faces : 0;
    }
    if (faces[0] > 0 && faces[1] > 0) {
        return problem(
            "the mesh has faces on patches of type wedge and on patches of type empty",
            "axisymmetric: only the two wedge planes have the type wedge, and the axis (type empty) "
            "has no faces; plane strain: only the two planes of the layer have the type empty");
    }
    if (faces[0] + faces[1] == 0) {
        return problem("the mesh has neither wedge nor empty patches",
                       "give the two planes of the layer the type wedge (axisymmetric) or empty (plane "
                       "strain) in blockMeshDict, createPatchDict or constant/polyMesh/boundary");
    }
    mesh_.geometry = faces[0] > 0 ? Geometry::axisymmetric : Geometry::planeStrain;
    mesh_.polyMeshPoints = static_cast<int>(poly_.points.size());
    cells_ = poly_.owner.empty() ? 0 : 1 + *std::max_element(poly_.owner.begin(), poly_.owner.end());

    const char* type = faces[0] > 0 ? "wedge" : "empty";
    planeOf_.assign(poly_.faces.size(), neither);
    normal_ = {Vector3d::Zero(), Vector3d::Zero()};
    std::array<double, 2> area = {0, 0};
    Vector3d reference = Vector3d::Zero();
    for (const PolyPatch& patch : poly_.patches) {
        for (int f = patch.startFace; patch.type == type && f < patch.startFace + patch.faces; ++f) {
            const Vector3d vector = areaVector(f);
            if (reference.isZero(0)) {
                reference = vector;
            }
            const int side = reference.dot(vector) >= 0 ? 0 : 1;
            planeOf_[f] = side == 0 ? front : back;
            normal_[side] += vector;
            area[side] += vector.norm();
        }
    }
    for (const int side : {0, 1}) {
        if (area[side] == 0) {
            return problem(text("all faces of type %s lie on the same side of the mesh", type),
                           text("both planes of the layer need the type %s", type));
        }
        if (normal_[side].norm() < (1 - 1e-6) * area[side]) {
            return problem(text("the faces of type %s do not lie in two planes", type),
                           "make one layer of cells between two planes (extrudeMesh, blockMesh with one cell "
                           "in the direction of y); write it with writePrecision 14");
        }
        normal_[side].normalize();
    }
    return true;
}

bool Extraction::orient()
{
    const auto array = [](const Vector3d& v) { return std::array<double, 3>{v.x(), v.y(), v.z()}; };
    if (const auto wrong = checkOrientation(mesh_.geometry, array(normal_[0]), array(normal_[1]))) {
        return problem(wrong->message, wrong->hint);
    }
    if (normal_[0].y() > 0) {
        std::swap(normal_[0], normal_[1]);
        for (Plane& plane : planeOf_) {
            plane = plane == front ? back : plane == back ? front : plane;
        }
    }
    return true;
}

bool Extraction::findCellFaces()
{
    frontFace_.assign(cells_, -1);
    std::vector<int> faces(cells_, 0), backFaces(cells_, 0);
    for (std::size_t f = 0; f < planeOf_.size(); ++f) {
        const int cell = poly_.owner[f];
        if (planeOf_[f] == front) {
            frontFace_[cell] = static_cast<int>(f);
            ++faces[cell];
        }
        backFaces[cell] += planeOf_[f] == back ? 1 : 0;
    }
    int wrong = 0, first = -1;
    for (int c = 0; c < cells_; ++c) {
        if (faces[c] != 1 || backFaces[c] != 1) {
            first = wrong == 0 ? c : first;
            ++wrong;
        }
    }
    if (wrong > 0) {
        return problem(text("%d of %d cells do not reach from one plane to the other with one face on each "
                            "(the first is cell %d): the mesh has several layers",
                            wrong, cells_, first),
                       "make one layer of cells between the two planes (blockMesh: one cell in the direction "
                       "of y; extrudeMesh: nLayers 1)");
    }
    return true;
}

/// The sides of the cells join each front point with its back point.
bool Extraction::pairPoints()
{
    pointPlane_.assign(poly_.points.size(), neither);
    for (std::size_t f = 0; f < planeOf_.size(); ++f) {
        for (const int p : poly_.faces[f]) {
            pointPlane_[p] |= planeOf_[f];
        }
    }
    partner_.assign(poly_.points.size(), -1);
    for (std::size_t f = 0; f < planeOf_.size(); ++f) {
        const std::vector<int>& face = poly_.faces[f];
        for (std::size_t k = 0; planeOf_[f] == neither && k < face.size(); ++k) {
            const int p = face[k];
            const int q = face[(k + 1) % face.size()];
            if (pointPlane_[p] == front && pointPlane_[q] == back) {
                partner_[p] = q;
            } else if (pointPlane_[p] == back && pointPlane_[q] == front) {
                partner_[q] = p;
            }
        }
    }
    for (std::size_t p = 0; p < pointPlane_.size(); ++p) {
        if (pointPlane_[p] == both) {
            partner_[p] = static_cast<int>(p);
        } else if (pointPlane_[p] == front && partner_[p] < 0) {
            return problem(text("point %zu at (%g %g %g) has no counterpart on the other plane", p,
                                poly_.points[p][0], poly_.points[p][1], poly_.points[p][2]),
                           "make one layer of prisms or hexahedra between the two planes");
        }
    }
    return true;
}

/// Nodes from the pairs of points, each where its plane wants it.
bool Extraction::checkPlaces()
{
    Vector3d low = point(0), high = point(0);
    for (std::size_t p = 0; p < poly_.points.size(); ++p) {
        low = low.cwiseMin(point(static_cast<int>(p)));
        high = high.cwiseMax(point(static_cast<int>(p)));
    }
    const double tolerance = placeTolerance * (high - low).maxCoeff();
    const bool axisymmetric = mesh_.geometry == Geometry::axisymmetric;

    nodeOfPoint_.assign(poly_.points.size(), -1);
    double farthest = 0;
    for (int p = 0; p < mesh_.polyMeshPoints; ++p) {
        if ((pointPlane_[p] & front) == 0) {
            continue;
        }
        const Vector3d a = point(p);
        const Vector3d b = point(partner_[p]);
        nodeOfPoint_[p] = mesh_.nodes();
        mesh_.nodePoints.push_back({p, partner_[p]});
        mesh_.r.push_back(!axisymmetric ? a.x() : pointPlane_[p] == both ? 0 : std::hypot(a.x(), a.y()));
        mesh_.z.push_back(a.z());
        if (axisymmetric && a.x() > farthest) {
            farthest = a.x();
            mesh_.wedgeHalfAngle = std::atan2(-a.y(), a.x());
        }
        if (p == mesh_.nodePoints[0][0]) {
            mesh_.halfThickness = axisymmetric ? 0 : (b.y() - a.y()) / 2;
            mesh_.middleY = axisymmetric ? 0 : (a.y() + b.y()) / 2;
        }
    }
    const std::vector<std::array<double, 3>> wanted = polyMeshPoints(mesh_);
    for (const std::array<int, 2>& pair : mesh_.nodePoints) {
        for (const int p : pair) {
            const Vector3d deviation = point(p) - Vector3d::Map(wanted[p].data());
            if (!(deviation.cwiseAbs().maxCoeff() <= tolerance)) {
                return problem(
                    text("point %d at (%.9g %.9g %.9g) should lie at (%.9g %.9g %.9g): %s", p,
                         poly_.points[p][0], poly_.points[p][1], poly_.points[p][2], wanted[p][0],
                         wanted[p][1], wanted[p][2],
                         axisymmetric ? "the wedge planes must meet in the z axis, symmetric about y = 0"
                                      : "the empty planes must be mirror images of each other"),
                    axisymmetric ? "move the axis to x = y = 0 with transformPoints -translate, or write the "
                                   "mesh with writePrecision 14"
                                 : "make one layer of constant thickness along y (extrudeMesh with "
                                   "extrudeModel linearDirection), written with writePrecision 14");
            }
        }
    }
    return true;
}

/// Turns the corners so that side 0 is the one that runs along r most closely.
void Extraction::startLowerLeft(int cell)
{
    const auto slope = [&](int k) {
        const int a = mesh_.node(cell, k);
        const int b = mesh_.node(cell, (k + 1) % mesh_.corners);
        const double dr = mesh_.r[b] - mesh_.r[a];
        return dr / std::hypot(dr, mesh_.z[b] - mesh_.z[a]);
    };
    int lowest = 0;
    for (int k = 1; k < mesh_.corners; ++k) {
        lowest = slope(k) > slope(lowest) ? k : lowest;
    }
    const auto first = mesh_.cellNodes.begin() + static_cast<std::ptrdiff_t>(cell) * mesh_.corners;
    std::rotate(first, first + lowest, first + mesh_.corners);
}

bool Extraction::makeCells()
{
    std::array<int, 2> count = {0, 0};
    int polygonal = 0, firstPolygonal = -1;
    for (int c = 0; c < cells_; ++c) {
        const std::size_t corners = poly_.faces[frontFace_[c]].size();
        if (corners == 3 || corners == 4) {
            ++count[corners - 3];
        } else {
            firstPolygonal = polygonal++ == 0 ? c : firstPolygonal;
        }
    }
    if (polygonal > 0) {
        return problem(text("%d cells have more than four corners, the first is cell %d at %s", polygonal,
                            firstPolygonal, place(frontFace_[firstPolygonal]).c_str()),
                       "cells must be all quadrilaterals or all triangles, with no hanging points");
    }
    if (count[0] > 0 && count[1] > 0) {
        return problem(
            text("the mesh mixes %d triangles and %d quadrilaterals", count[0], count[1]),
            "mesh with quadrilaterals only (blockMesh; gmsh: Recombine and Mesh.SubdivisionAlgorithm = 1) or "
            "with triangles only");
    }
    mesh_.corners = count[0] > 0 ? 3 : 4;
    int bad = 0, firstBad = -1;
    for (int c = 0; c < cells_; ++c) {
        // The face's corners run counter-clockwise seen against its outward normal, that is from y = -inf,
        // in the plane of x and z; a face that is written the other way round has a negative area.
        for (const int p : poly_.faces[frontFace_[c]]) {
            mesh_.cellNodes.push_back(nodeOfPoint_[p]);
        }
        if (cellArea(mesh_, c) < 0) {
            std::reverse(mesh_.cellNodes.end() - mesh_.corners + 1, mesh_.cellNodes.end());
        }
        startLowerLeft(c);
        bool convex = true;
        for (int k = 0; k < mesh_.corners; ++k) {
            const int a = mesh_.node(c, k);
            const int b = mesh_.node(c, (k + 1) % mesh_.corners);
            const int d = mesh_.node(c, (k + 2) % mesh_.corners);
            convex = convex && (mesh_.r[b] - mesh_.r[a]) * (mesh_.z[d] - mesh_.z[b]) -
                                       (mesh_.z[b] - mesh_.z[a]) * (mesh_.r[d] - mesh_.r[b]) >
                                   0;
        }
        if (!convex) {
            firstBad = bad++ == 0 ? c : firstBad;
        }
    }
    return bad == 0 || problem(text("%d cells are not convex or have no area, the first is cell %d at %s",
                                    bad, firstBad, place(frontFace_[firstBad]).c_str()),
                               "see what checkMesh -allGeometry says of them");
}

/// Side of a cell that a face of the polyMesh makes, -1 where it makes none.
int Extraction::sideOf(int cell, int face) const
{
    const std::vector<int>& points = poly_.faces[face];
    const auto holds = [&](int node) {
        return std::find(points.begin(), points.end(), mesh_.nodePoints[node][0]) != points.end();
    };
    for (int k = 0; k < mesh_.corners; ++k) {
        if (holds(mesh_.node(cell, k)) && holds(mesh_.node(cell, (k + 1) % mesh_.corners))) {
            return k;
        }
    }
    return -1;
}

void Extraction::joinCells()
{
    std::vector<bool> known(mesh_.cellNodes.size(), false);
    mesh_.neighbour.assign(mesh_.cellNodes.size(), -1);
    for (std::size_t f = 0; f < poly_.neighbour.size(); ++f) {
        const int face = static_cast<int>(f);
        const int owner = poly_.owner[f];
        const int other = poly_.neighbour[f];
        const int ownerSide = sideOf(owner, face);
        const int otherSide = sideOf(other, face);
        if (ownerSide >= 0 && otherSide >= 0) {
            mesh_.neighbour[owner * mesh_.corners + ownerSide] = other;
            mesh_.neighbour[other * mesh_.corners + otherSide] = owner;
            known[owner * mesh_.corners + ownerSide] = known[other * mesh_.corners + otherSide] = true;
        }
    }
    for (const PolyPatch& patch : poly_.patches) {
        BoundaryPatch& edges = mesh_.patches.emplace_back(BoundaryPatch{patch.name, patch.type, {}});
        for (int f = patch.startFace; f < patch.startFace + patch.faces; ++f) {
            const int cell = poly_.owner[f];
            const int side = planeOf_[f] == neither ? sideOf(cell, f) : -1;
            if (side >= 0) {
                edges.edges.push_back(
                    {{mesh_.node(cell, side), mesh_.node(cell, (side + 1) % mesh_.corners)}, cell, side});
                known[cell * mesh_.corners + side] = true;
            }
        }
    }
    for (std::size_t k = 0; k < known.size(); ++k) {
        const auto cell = static_cast<int>(k) / mesh_.corners;
        const int a = mesh_.cellNodes[k];
        const int b = mesh_.node(cell, (static_cast<int>(k) + 1) % mesh_.corners);
        const bool onAxis = mesh_.geometry == Geometry::axisymmetric && mesh_.r[a] == 0 && mesh_.r[b] == 0;
        if (!known[k] && !onAxis) {
            problem(text("the side of cell %d from (%g %g) to (%g %g) belongs to no patch", cell, mesh_.r[a],
                         mesh_.z[a], mesh_.r[b], mesh_.z[b]),
                    "see what checkMesh -allTopology says of it");
            return;
        }
    }
}

void Extraction::makeNodeCells()
{
    std::vector<int>& start = mesh_.nodeCells.start;
    start.assign(mesh_.nodes() + 1, 0);
    for (const int node : mesh_.cellNodes) {
        ++start[node + 1];
    }
    std::partial_sum(start.begin(), start.end(), start.begin());
    mesh_.nodeCells.item.resize(mesh_.cellNodes.size());
    std::vector<int> next(start.begin(), start.end() - 1);
    for (std::size_t k = 0; k < mesh_.cellNodes.size(); ++k) {
        mesh_.nodeCells.item[next[mesh_.cellNodes[k]]++] = static_cast<int>(k);
    }
}

} // namespace

BackgroundMesh buildBackgroundMesh(const PolyMesh& polyMesh, InputProblems& problems)
{
    return Extraction(polyMesh, problems).mesh();
}

} // namespace caisson

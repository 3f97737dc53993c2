#include "fem/Seepage.h"

#include "dictionary/Text.h"

#include <cmath>
#include <functional>

namespace caisson {

namespace {

/// Shape functions and their gradients at one integration point, with its weight.
struct IntegrationPoint
{
    double N[4], dr[4], dz[4], weight;
};

/// Calls `use` at the integration points of a cell: 2 x 2 of a quadrilateral (exact on rectangles), three of
/// a triangle.
void integrate(const BackgroundMesh& mesh, int cell, const std::function<void(const IntegrationPoint&)>& use)
{
    double r[4], z[4];
    for (int k = 0; k < mesh.corners; ++k) {
        r[k] = mesh.r[mesh.node(cell, k)];
        z[k] = mesh.z[mesh.node(cell, k)];
    }
    const bool axisymmetric = mesh.geometry == Geometry::axisymmetric;
    IntegrationPoint point{};
    if (mesh.corners == 3) {
        const double doubleArea = (r[1] - r[0]) * (z[2] - z[0]) - (r[2] - r[0]) * (z[1] - z[0]);
        for (int k = 0; k < 3; ++k) {
            const int a = (k + 1) % 3;
            const int b = (k + 2) % 3;
            point.dr[k] = (z[a] - z[b]) / doubleArea;
            point.dz[k] = (r[b] - r[a]) / doubleArea;
        }
        for (int j = 0; j < 3; ++j) { // middles of the sides
            double radius = 0;
            for (int k = 0; k < 3; ++k) {
                point.N[k] = k == j ? 0 : 0.5;
                radius += point.N[k] * r[k];
            }
            point.weight = doubleArea / 6 * (axisymmetric ? radius : 1);
            use(point);
        }
        return;
    }
    const double gauss = 1 / std::sqrt(3.0);
    constexpr int signXi[4] = {-1, 1, 1, -1};
    constexpr int signEta[4] = {-1, -1, 1, 1};
    for (const double xi : {-gauss, gauss}) {
        for (const double eta : {-gauss, gauss}) {
            double dNdXi[4], dNdEta[4];
            double rXi = 0, rEta = 0, zXi = 0, zEta = 0, radius = 0;
            for (int k = 0; k < 4; ++k) {
                point.N[k] = 0.25 * (1 + signXi[k] * xi) * (1 + signEta[k] * eta);
                dNdXi[k] = 0.25 * signXi[k] * (1 + signEta[k] * eta);
                dNdEta[k] = 0.25 * signEta[k] * (1 + signXi[k] * xi);
                rXi += dNdXi[k] * r[k];
                rEta += dNdEta[k] * r[k];
                zXi += dNdXi[k] * z[k];
                zEta += dNdEta[k] * z[k];
                radius += point.N[k] * r[k];
            }
            const double determinant = rXi * zEta - rEta * zXi;
            for (int k = 0; k < 4; ++k) {
                point.dr[k] = (dNdXi[k] * zEta - dNdEta[k] * zXi) / determinant;
                point.dz[k] = (dNdEta[k] * rXi - dNdXi[k] * rEta) / determinant;
            }
            point.weight = determinant * (axisymmetric ? radius : 1);
            use(point);
        }
    }
}

} // namespace

Seepage::Seepage(const BackgroundMesh& mesh, const std::vector<unsigned char>& soil,
                 const std::vector<double>& conductivity, const std::vector<double>& storage)
    : mesh_(mesh), unknown_(mesh.nodes(), -1), soil_(soil)
{
    for (int c = 0; c < mesh.cells(); ++c) {
        for (int k = 0; k < mesh.corners && soil[c]; ++k) {
            int& unknown = unknown_[mesh.node(c, k)];
            if (unknown < 0) {
                unknown = static_cast<int>(nodes_.size());
                nodes_.push_back(mesh.node(c, k));
            }
        }
    }
    const int size = static_cast<int>(nodes_.size());
    std::vector<Eigen::Triplet<double>> entries;
    capacity_ = Vector::Zero(size);
    for (int c = 0; c < mesh.cells(); ++c) {
        if (!soil[c]) {
            continue;
        }
        double local[4][4] = {};
        integrate(mesh, c, [&](const IntegrationPoint& point) {
            for (int i = 0; i < mesh.corners; ++i) {
                for (int j = 0; j < mesh.corners; ++j) {
                    local[i][j] += conductivity[c] * point.weight *
                                   (point.dr[i] * point.dr[j] + point.dz[i] * point.dz[j]);
                }
                if (!storage.empty()) {
                    capacity_[unknown_[mesh.node(c, i)]] += storage[c] * point.weight * point.N[i];
                }
            }
        });
        for (int i = 0; i < mesh.corners; ++i) {
            for (int j = 0; j < mesh.corners; ++j) {
                entries.emplace_back(unknown_[mesh.node(c, i)], unknown_[mesh.node(c, j)], local[i][j]);
            }
        }
    }
    stiffness_.resize(size, size);
    stiffness_.setFromTriplets(entries.begin(), entries.end());
}

void Seepage::factorise(const Matrix& matrix, const std::vector<double>& given, System& system) const
{
    system.freeIndex.assign(nodes_.size(), -1);
    system.count = 0;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (std::isnan(given[nodes_[i]])) {
            system.freeIndex[i] = system.count++;
        }
    }
    std::vector<Eigen::Triplet<double>> inner;
    std::vector<Eigen::Triplet<double>> coupling;
    for (int column = 0; column < matrix.outerSize(); ++column) {
        for (Matrix::InnerIterator entry(matrix, column); entry; ++entry) {
            const int row = system.freeIndex[entry.row()];
            if (row < 0) {
                continue;
            }
            const int place = system.freeIndex[column];
            if (place >= 0) {
                inner.emplace_back(row, place, entry.value());
            } else {
                coupling.emplace_back(row, column, entry.value());
            }
        }
    }
    Matrix reduced(system.count, system.count);
    reduced.setFromTriplets(inner.begin(), inner.end());
    system.coupling.resize(system.count, static_cast<int>(nodes_.size()));
    system.coupling.setFromTriplets(coupling.begin(), coupling.end());
    system.solver.compute(reduced);
    const Vector pivots = system.count > 0 ? system.solver.vectorD() : Vector();
    if (system.count > 0 &&
        (system.solver.info() != Eigen::Success || pivots.minCoeff() <= 1e-13 * pivots.maxCoeff())) {
        throw InputError("the seepage",
                         {{{"0/p", 0},
                           "a part of the soil has no given pressure: its level is free",
                           "give the pressure on a patch or on a free surface that it reaches"}});
    }
}

Seepage::Vector Seepage::solve(const System& system, const Vector& rightSide,
                               const std::vector<double>& given) const
{
    Vector all(static_cast<int>(nodes_.size()));
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        all[static_cast<int>(i)] = system.freeIndex[i] < 0 ? given[nodes_[i]] : 0;
    }
    if (system.count == 0) {
        return all;
    }
    Vector reduced(system.count);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (system.freeIndex[i] >= 0) {
            reduced[system.freeIndex[i]] = rightSide[static_cast<int>(i)];
        }
    }
    reduced -= system.coupling * all;
    const Vector solution = system.solver.solve(reduced);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (system.freeIndex[i] >= 0) {
            all[static_cast<int>(i)] = solution[system.freeIndex[i]];
        }
    }
    return all;
}

std::vector<double> Seepage::steady(const std::vector<double>& given, const std::vector<double>& inflow) const
{
    System system;
    factorise(stiffness_, given, system);
    Vector rightSide = Vector::Zero(static_cast<int>(nodes_.size()));
    for (std::size_t i = 0; i < nodes_.size() && !inflow.empty(); ++i) {
        rightSide[static_cast<int>(i)] = inflow[nodes_[i]];
    }
    const Vector solution = solve(system, rightSide, given);
    std::vector<double> result(mesh_.nodes(), 0);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        result[nodes_[i]] = solution[static_cast<int>(i)];
    }
    return result;
}

std::vector<double> Seepage::advance(const std::vector<double>& excess, double dt, double theta,
                                     const std::vector<double>& given, const std::vector<double>& inflow)
{
    std::vector<unsigned char> isGiven(nodes_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        isGiven[i] = !std::isnan(given[nodes_[i]]);
    }
    if (dt != transientStep_ || theta != transientTheta_ || isGiven != transientGiven_) {
        Matrix matrix = theta * stiffness_;
        for (int i = 0; i < matrix.rows(); ++i) {
            matrix.coeffRef(i, i) += capacity_[i] / dt;
        }
        factorise(matrix, given, transient_);
        transientStep_ = dt;
        transientTheta_ = theta;
        transientGiven_ = isGiven;
    }
    Vector old(static_cast<int>(nodes_.size()));
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        old[static_cast<int>(i)] = excess[nodes_[i]];
    }
    Vector rightSide = capacity_.cwiseProduct(old) / dt - (1 - theta) * (stiffness_ * old);
    for (std::size_t i = 0; i < nodes_.size() && !inflow.empty(); ++i) {
        rightSide[static_cast<int>(i)] += inflow[nodes_[i]];
    }
    const Vector solution = solve(transient_, rightSide, given);
    std::vector<double> result(mesh_.nodes(), 0);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        result[nodes_[i]] = solution[static_cast<int>(i)];
    }
    return result;
}

std::vector<double> Seepage::nodalInflow(const std::vector<double>& excess) const
{
    Vector all(static_cast<int>(nodes_.size()));
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        all[static_cast<int>(i)] = excess[nodes_[i]];
    }
    const Vector flow = stiffness_ * all;
    std::vector<double> result(mesh_.nodes(), 0);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        result[nodes_[i]] = flow[static_cast<int>(i)];
    }
    return result;
}

std::array<double, 2> Seepage::gradient(int cell, const std::vector<double>& excess) const
{
    std::array<double, 2> sum{};
    double weight = 0;
    integrate(mesh_, cell, [&](const IntegrationPoint& point) {
        for (int k = 0; k < mesh_.corners; ++k) {
            sum[0] += point.weight * point.dr[k] * excess[mesh_.node(cell, k)];
            sum[1] += point.weight * point.dz[k] * excess[mesh_.node(cell, k)];
        }
        weight += point.weight;
    });
    return {sum[0] / weight, sum[1] / weight};
}

double Seepage::cellMean(int cell, const std::vector<double>& excess) const
{
    double sum = 0;
    double weight = 0;
    integrate(mesh_, cell, [&](const IntegrationPoint& point) {
        for (int k = 0; k < mesh_.corners; ++k) {
            sum += point.weight * point.N[k] * excess[mesh_.node(cell, k)];
        }
        weight += point.weight;
    });
    return sum / weight;
}

} // namespace caisson

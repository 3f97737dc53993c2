#pragma once

#include "mesh/BackgroundMesh.h"

#include <Eigen/SparseCholesky>

#include <limits>

namespace caisson {

/// Flow of pore liquid through soil by finite elements on the background mesh: linear triangles, bilinear
/// quadrilaterals; weight r (axisymmetric, per radian) or 1 (plane strain).
///
/// With the excess pressure e = p - rho_w g_z z Darcy's law is q = -(permeability/viscosity) grad e, and
///   storage de/dt + div q = 0.
/// Cells that are no soil (voids, bodies) are left out: their sides are impermeable where nothing is given.
class Seepage
{
public:
    static constexpr double free = std::numeric_limits<double>::quiet_NaN();

    /// @param soil          per cell
    /// @param conductivity  per cell: intrinsic permeability over viscosity [m2/(Pa s)]
    /// @param storage       per cell: liquid and skeleton taken up per pressure [1/Pa]; for transient flow
    Seepage(const BackgroundMesh& mesh, const std::vector<unsigned char>& soil,
            const std::vector<double>& conductivity, const std::vector<double>& storage = {});

    /// Nodes of the soil region.
    [[nodiscard]] const std::vector<int>& nodes() const { return nodes_; }

    /// Steady excess pressure per node of the mesh [Pa]; 0 where there is no soil.
    /// @param given   per node of the mesh: excess pressure, or `free`
    /// @param inflow  per node: liquid fed in [m3/s/rad or m2/s]; may be empty
    /// @throws InputError where a part of the soil has no given pressure
    [[nodiscard]] std::vector<double> steady(const std::vector<double>& given,
                                             const std::vector<double>& inflow = {}) const;

    /// One step of dt [s] from `excess`, implicit: backward Euler (theta 1) or Crank-Nicolson (theta 0.5).
    /// The factorisation is kept while dt, theta and the places of the given pressures stay.
    [[nodiscard]] std::vector<double> advance(const std::vector<double>& excess, double dt, double theta,
                                              const std::vector<double>& given,
                                              const std::vector<double>& inflow = {});

    /// Liquid that enters at each node [m3/s/rad or m2/s] in steady flow: zero to rounding where neither
    /// pressure nor inflow is given, so that flows through boundaries balance.
    [[nodiscard]] std::vector<double> nodalInflow(const std::vector<double>& excess) const;

    /// Mean excess gradient (d/dr, d/dz) [Pa/m] of a cell.
    [[nodiscard]] std::array<double, 2> gradient(int cell, const std::vector<double>& excess) const;
    /// Mean excess pressure of a cell [Pa].
    [[nodiscard]] double cellMean(int cell, const std::vector<double>& excess) const;

private:
    using Matrix = Eigen::SparseMatrix<double>;
    using Vector = Eigen::VectorXd;
    using Solver = Eigen::SimplicialLDLT<Matrix>;

    /// Splits the unknowns into given and free ones, and factorises the free part of `matrix`.
    struct System
    {
        std::vector<int> freeIndex; ///< per unknown: place among the free ones, or -1
        Matrix coupling;            ///< free rows, all columns
        Solver solver;
        int count = 0;
    };
    void factorise(const Matrix& matrix, const std::vector<double>& given, System& system) const;
    [[nodiscard]] Vector solve(const System& system, const Vector& rightSide,
                               const std::vector<double>& given) const;

    const BackgroundMesh& mesh_;
    std::vector<int> nodes_;   ///< unknown -> node of the mesh
    std::vector<int> unknown_; ///< node of the mesh -> unknown, or -1
    std::vector<unsigned char> soil_;
    Matrix stiffness_;
    Vector capacity_; ///< lumped storage
    System transient_;
    std::vector<unsigned char> transientGiven_;
    double transientStep_ = 0, transientTheta_ = 0;
};

} // namespace caisson

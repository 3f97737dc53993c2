#pragma once

#include "mesh/CellLocator.h"
#include "timeStepping/CellShapes.h"
#include "timeStepping/PointCells.h"
#include "timeStepping/TimeStep.h"

namespace caisson {

/// Explicit step of one-phase soil on cells of one Shape (see CellShapes.h).
///
/// Order of a step: masses, momenta and forces of the points go to the nodes; the nodes are solved with
/// boundary conditions and contact; velocities and places of the points are updated (FLIP share, places with
/// the mean of old and new velocity, which is second order in time); strains of the new nodal velocities
/// drive the constitutive laws in batches; the mesh follows its body and the points are found in it again.
///
/// Every cell keeps its own sums per corner; the nodes gather them in a fixed order. So the result does not
/// depend on who computed which cell.
template <class Shape, int phases>
class ExplicitStep final : public TimeStep
{
public:
    ExplicitStep(const Scene& scene, State& state);

    void advance(State& state, double dt) override;
    [[nodiscard]] StableStep stableStep(const State& state) const override;
    void rebuild(State& state) override;
    [[nodiscard]] CellCounts cellCounts(const State& state) const override;
    [[nodiscard]] std::string description() const override;
    [[nodiscard]] std::vector<std::array<double, 2>> nodalVelocities(const State& state) const override;

private:
    static constexpr int corners = Shape::corners;
    static constexpr bool axisymmetric = Shape::isAxisymmetric;
    using Values = shapes::Values<corners>;
    using Dilatation = shapes::MeanDilatation<corners>;

    /// What the points of one cell add to one of its corners.
    struct Corner
    {
        double mass, momentumR, momentumZ, forceR, forceZ;
        double fullMass; ///< what it would be in a cell evenly filled
    };

    /// Nodal result of a step.
    struct alignas(64) Node
    {
        double mass;
        double vr, vz;           ///< new velocity; strains are taken from it
        double dvr, dvz;         ///< change of velocity in the step
        double placeVr, placeVz; ///< velocity that moves the points: mean of old and new, new where held
        double spare;
    };

    void updateCells(const State& state);
    void classifyCells(State& state);
    void staggerStrain(State& state, double dt);
    void mapToNodes(State& state);
    void mapCellToNodes(State& state, int c);
    void solveNodes(State& state, double dt);
    void applyConditions(double time, bool remapped);
    void applyContact(State& state, double dt, bool remapped);
    void mapToPoints(State& state, double dt);
    void averageDilatationAtNodes();
    template <bool velocities, bool strains>
    void mapCellToPoints(State& state, double dt, int c);
    void addRemappedMomentum(const State& state, int c);
    void updateStress(State& state);
    void moveBodiesAndMesh(State& state, double dt);
    void relocate(State& state);
    void scaleInertia(const State& state);
    [[nodiscard]] double fastestWave(const State& state, int c) const;

    const Scene& scene_;
    std::vector<int> cellNodes_; ///< corners in the order that Shape wants
    CompressedRows nodeCorners_; ///< around each node: cell * corners + corner
    std::vector<BodySurface> surfaces_;
    std::vector<unsigned char>
        contactNode_;                   ///< on a body: local damping would change normal force and friction
    std::vector<unsigned char> inside_; ///< per cell: inside a body
    std::vector<typename Shape::Cell> cells_;
    std::vector<Dilatation> dilatation_;
    std::vector<double> inertiaScale_; ///< per cell
    /// Per filled cell: its volume over that of its points. Mass and weight are those of the whole cell, as
    /// the stress is: the points are samples. Otherwise a cell with few points would have the stiffness of a
    /// full one on a small mass, and rows of points that cross a line would shift weight from cell to cell.
    std::vector<double> fullness_;
    std::vector<double> gravityShare_; ///< per material: weighing over inertial density
    std::vector<double> waveSpeed_;    ///< per material
    std::vector<double> density_;      ///< per material, inertial

    PointCells pointCells_;
    std::vector<unsigned char> occupied_;
    std::vector<unsigned char> surfaceNode_; ///< touches an empty cell that is no body's
    std::vector<unsigned char> bySurface_;   ///< per cell: has a surface node
    std::vector<unsigned char> looseNode_;   ///< on a surface, or with a mass well below that of full cells
    std::vector<unsigned char> byLoose_;     ///< per cell: has a loose node
    std::vector<int> activeCells_, activeNodes_;
    bool occupancyChanged_ = true;

    std::vector<Corner> cornerSums_;
    std::vector<Node> nodes_;
    std::vector<std::array<double, 2>> traction_;
    std::vector<double> cellRate_; ///< dilatation rate used by the points of the cell (nodal average)
    std::vector<double> nodeRate_;
    std::array<std::vector<double>, 4> strain_; ///< increments of the step, per point
    std::vector<double> spin_;
    std::vector<double*> statePointers_;
    CellLocator locator_;
};

} // namespace caisson

#pragma once

#include "mesh/CellLocator.h"
#include "timeStepping/CellShapes.h"
#include "timeStepping/FourPoints.h"
#include "timeStepping/PointBox.h"
#include "timeStepping/PointCells.h"
#include "timeStepping/PressureSolver.h"
#include "timeStepping/StiffestMode.h"
#include "timeStepping/Threads.h"
#include "timeStepping/TimeStep.h"

namespace caisson {

namespace kernels {

/// Factor on the weights of the points of a filled cell, linear in local coordinates about the points'
/// centre.
struct Fit
{
    double xi = 0, eta = 0;           ///< centre
    double slopeXi = 0, slopeEta = 0; ///< 0: as they come

    [[nodiscard]] double at(double x, double y) const
    {
        return 1 + slopeXi * (x - xi) + slopeEta * (y - eta);
    }
};

/// Sums over the points of a filled cell, or of several: of their volume, times 1, xi and eta and products of
/// these, and of the volume times stress, times 1, xi and eta.
template <class Real>
struct alignas(4 * sizeof(double)) StressSums
{
    Real w, wx, wy, wxy;
    Real s[4], sx[4], sy[4];
    Real wxx, wyy, none[2];

    /// Of `count` cells; the last one again where they are fewer than the lanes.
    [[nodiscard]] static StressSums of(const StressSums<double>* sums, int count)
    {
        if constexpr (std::is_same_v<Real, double>) {
            return *sums;
        } else {
            StressSums result;
            Real* const to = &result.w;
            for (int j = 0; j < static_cast<int>(sizeof(StressSums<double>) / sizeof(double)); j += 4) {
                std::array<Four, 4> rows;
                for (int l = 0; l < 4; ++l) {
                    rows[l] = fourFrom((&sums[std::min(l, count - 1)].w)[j]);
                }
                transpose(rows);
                std::ranges::copy(rows, to + j);
            }
            return result;
        }
    }
};

} // namespace kernels

/// Explicit step of soil on cells of one Shape (see CellShapes.h): of one phase, or of two, soil and liquid
/// with velocities of their own (LiquidKernels.h).
///
/// Order of a step: masses, momenta and forces of the points go to the nodes; the nodes are solved with
/// boundary conditions and contact; velocities and places of the points are updated (FLIP share, places with
/// the mean of old and new velocity, which is second order in time); strains of the new nodal velocities
/// drive the constitutive laws in batches; the mesh follows its body and the points are found in it again.
///
/// Every cell keeps its own sums per corner; the nodes gather them in a fixed order. So the result does not
/// depend on which thread computed which cell: the same bits for any number of threads.
template <class Shape, int phases>
class ExplicitStep final : public TimeStep
{
public:
    ExplicitStep(const Scene& scene, State& state);

    void advance(State& state, double dt) override;
    [[nodiscard]] StableStep stableStep(const State& state) const override;
    void rebuild(State& state) override;
    void setSeepage(const State& state, const std::vector<double>& excess) override;
    [[nodiscard]] CellCounts cellCounts(const State& state) const override;
    [[nodiscard]] std::string description() const override;
    [[nodiscard]] std::vector<std::array<double, 2>> nodalVelocities(const State& state) const override;
    [[nodiscard]] std::vector<double> nodalPressures(const State& state) const override;
    [[nodiscard]] double checkerboardIndex(const State& state) const override;

private:
    static constexpr int corners = Shape::corners;
    static constexpr bool axisymmetric = Shape::isAxisymmetric;
    static constexpr bool twoPhase = phases == 2;
    static constexpr bool isConstantStrain = Shape::corners == 3;
    static constexpr bool hasBoxes = Shape::corners == 4 && !twoPhase;
    static constexpr bool hasFours = Shape::lanes > 1; ///< RectangleKernels.h
    // Pieces of work that a thread takes at a time
    static constexpr int cellsPerPiece = 16;
    static constexpr int nodesPerPiece = 128;
    static constexpr int pointsPerPiece = 256;     ///< or FEM cells
    static constexpr double viscousReserve = 1.01; ///< how much a step may grow before it is set anew
    using Values = shapes::Values<corners>;
    using Dilatation = shapes::MeanDilatation<corners>;

    static constexpr int momentCount = shapes::Moments<corners>::count;

    /// What the points of one cell add to one of its corners.
    struct alignas(64) SolidCorner
    {
        double mass = 0, momentumR = 0, momentumZ = 0;
        double fullMass = 0; ///< what it would be in a cell evenly filled
        double forceR = 0, forceZ = 0;
        double pressureR = 0, pressureZ = 0; ///< two phases: of the excess pore pressure on the mixture
    };

    /// Nodal result of a step.
    struct alignas(64) Node
    {
        double mass;
        double vr, vz; ///< new velocity; strains are taken from it
        double spare;
        double dvr, dvz;         ///< change of velocity in the step
        double placeVr, placeVz; ///< velocity that moves the points: mean of old and new, new where held

        /// What the points take over: dvr, dvz, placeVr, placeVz.
        [[nodiscard]] Four motion() const { return fourFrom(dvr); }
    };

    /// What the liquid in the points of one cell adds to one of its corners.
    struct alignas(64) LiquidCorner
    {
        double mass = 0, momentumR = 0, momentumZ = 0;
        double drag = 0;                                       ///< integral of N n^2 viscosity/permeability
        double volume = 0, poreVolume = 0, pressureVolume = 0; ///< of N, N n and N times excess pore pressure
        double spare = 0;
    };

    struct TwoPhaseCorner : SolidCorner
    {
        LiquidCorner liquid;
    };
    using Corner = std::conditional_t<twoPhase, TwoPhaseCorner, SolidCorner>;

    /// Sum of what the cells around a node have on it, four numbers at once.
    [[nodiscard]] Corner gather(int i) const
    {
        constexpr std::size_t fours = sizeof(Corner) / (4 * sizeof(double));
        std::array<Four, fours> sums;
        sums.fill(0);
        for (int k = nodeCorners_.start[i]; k < nodeCorners_.start[i + 1]; ++k) {
            const double* const ofCorner = &cornerSums_[nodeCorners_.item[k]].mass;
            for (std::size_t j = 0; j < fours; ++j) {
                sums[j] += fourFrom(ofCorner[4 * j]);
            }
        }
        Corner sum;
        for (std::size_t j = 0; j < fours; ++j) {
            setFour((&sum.mass)[4 * j], sums[j]);
        }
        return sum;
    }

    /// work(node) for nodes that gather. What cells have on the nodes after next comes into the cache
    /// meanwhile: corners of a node are in lines far from each other, which the processor does not foresee.
    template <class Work>
    void forGathered(std::span<const int> nodes, const Work& work) const
    {
        constexpr std::size_t ahead = 6;
        for (std::size_t j = 0; j < nodes.size(); ++j) {
            if (j + ahead < nodes.size()) {
                const int i = nodes[j + ahead];
                for (int k = nodeCorners_.start[i]; k < nodeCorners_.start[i + 1]; ++k) {
                    const Corner& corner = cornerSums_[nodeCorners_.item[k]];
                    __builtin_prefetch(&corner);
                    if constexpr (twoPhase) {
                        __builtin_prefetch(&corner.liquid);
                    }
                }
            }
            work(nodes[j]);
        }
    }

    /// What the kernels need of a material for its liquid.
    struct LiquidProperties
    {
        double grainVolume; ///< per saturated mass at the start [m3/kg]
        double density, bulkModulus, viscosity, leastPressure;
        double constantDrag; ///< viscosity over permeability, where that is constant [Pa s/m2]
        bool kozenyCarman;
    };

    /// Nodal result for the liquid, and what is needed to solve it again where the solid is held.
    struct alignas(64) LiquidNode
    {
        double mass, drag;         ///< drag: times the step
        double solidVr, solidVz;   ///< velocity of the solid with its own forces, without drag
        double liquidVr, liquidVz; ///< of the liquid, likewise
        double porosity;
        double spare;
        double relativeVr, relativeVz;       ///< of the liquid to the solid, new
        double keep;                         ///< share of a relative velocity that drag leaves
        double pressure;                     ///< mean excess pore pressure round the node [Pa]
        double oldRelativeVr, oldRelativeVz; ///< at the start of the step
        double none[2];                      ///< zero

        /// What the points take over: changes of the relative velocity but for drag, keep, pressure.
        [[nodiscard]] Four motion() const { return fourFrom(relativeVr) - keep * fourFrom(oldRelativeVr); }
    };

    /// What the points of a cell see of its nodes.
    struct CornerMotion
    {
        double vr[corners], vz[corners];
        double wr[corners], wz[corners];        ///< of the liquid
        std::array<Four, corners> motion;       ///< Node::motion
        std::array<Four, corners> liquidMotion; ///< LiquidNode::motion
    };

    /// Mean and slopes over a filled cell, about the points' centre.
    struct FilledStrain
    {
        alignas(4 * sizeof(double)) double strain[momentCount][4]; ///< with the dilatation that is taken
        double spin[momentCount];
        double dilatation[momentCount]; ///< the one that is taken
        double rate;                    ///< of dilatation, shared by the points
        double liquidRate;              ///< of the liquid's velocity, likewise
        double liquidGradient[3];
        double centreXi, centreEta;
        shapes::VelocityGradient<corners> gradient; ///< rr, zz, hoop, v_r,z, v_z,r
    };

    /// How the points of a filled cell move and are strained (RectangleKernels.h): its strain, spin and rates
    /// as in FilledStrain, but about the middle of the cell, and modes (Shape::modes) of what its nodes have.
    struct CellMotion
    {
        alignas(4 * sizeof(double)) double strain[3][4];
        double motion[4][4];       ///< of Node::motion
        double liquidMotion[4][4]; ///< of LiquidNode::motion
        double velocity[4][4];     ///< of vr and vz, second and third, where points take a share of it
        double spin[3];
        double rate, liquidRate;
    };

    /// By which velocities a pressure increment moves a node (ProjectionKernels.h): along a direction and
    /// across it, of solid and liquid, per force on the mixture; and the mobility of the mixture.
    struct Mobility
    {
        std::array<double, 2> direction{1, 0};
        std::array<bool, 2> solidHeld{}, flowHeld{};
        std::array<double, 2> solid{}, liquid{}; ///< [m/s per N/rad or N/m]
        double rr = 0, rz = 0, zz = 0;
    };

    /// What a node does at the wall of a body in this step.
    struct WallTouch
    {
        int node;
        std::array<double, 2> normal;
        bool pressed, sticks;
    };

    /// A cell whose points rest (FemKernels.h).
    struct FemCell
    {
        int cell, material;
        bool restedBefore;    ///< so its nodes have their velocities already
        bool inner;           ///< all of its nodes are inner ones
        double mass[corners]; ///< of the solid, of the whole cell, not scaled
    };

    /// What such cells compute with, all of them.
    struct FemFields
    {
        std::vector<std::array<int, corners>> node;           ///< among the nodes of such cells
        std::array<std::vector<double>, 4> stress;            ///< mean [Pa]
        std::array<std::vector<double>, 4> slopeXi, slopeEta; ///< of the stress [Pa]
        std::vector<double> shareXi,
            shareEta; ///< of the slopes at the points that a cell has (kernels::Spread)
        std::array<std::vector<double>, 4> yielding; ///< see setYielding
        std::vector<unsigned char> yields; ///< per first cell of a block: `yielding` is not zero throughout
        std::vector<double>
            yielded; ///< share of the elastic stiffness in shear lost in that direction, at most
        std::vector<double> dilatation;              ///< since the points rest
        std::vector<double> pressure;                ///< of the liquid in excess, mean [Pa]
        std::vector<double> porosity;                ///< mean
        std::array<std::vector<double>, 4> meanRate; ///< of strain, over the last steps [1/s]
        std::vector<double> viscousTime;             ///< viscosity over elastic stiffness [s]
        std::vector<std::vector<double>> state;      ///< variables of the laws

        void resize(std::size_t size);
    };

    /// Those of one material that have a viscosity, or of one that have none.
    struct FemRun
    {
        int material;
        bool viscous;
        int begin, end;
    };

    /// Some of them, while they are strained.
    struct FemBlock
    {
        static constexpr int size = 64;
        int begin; ///< among the cells at rest
        double dt;
        bool viscous;
        alignas(64) double strain[4][size];
        alignas(64) double spin[size];
        alignas(64) double stressBefore[4][size]; ///< mean, before the step [Pa]
    };

    /// The liquid of such a cell.
    struct FemLiquidCell
    {
        double mass[corners], drag[corners], volume[corners], poreVolume[corners]; ///< as in LiquidCorner
    };

    /// A node of such cells, and what the points will have to catch up with.
    struct FemNode
    {
        int node;
        double placeR = 0, placeZ = 0;       ///< displacement of the points [m]
        double dvr = 0, dvz = 0;             ///< change of velocity [m/s]
        double relativeR = 0, relativeZ = 0; ///< of the relative velocity of the liquid [m/s]
    };

    /// Velocity of such a node and, of two phases, that of its liquid relative to it [m/s].
    using FemMotion = std::array<double, twoPhase ? 4 : 2>;
    /// Of a cell at rest on one of its corners: of its stress and, of two phases, of its excess pressure.
    using FemForce = std::array<double, twoPhase ? 4 : 2>;

    /// Cells whose points have boxes (BoxKernels.h), and those that such boxes reach into.
    enum class BoxCell : unsigned char { none, beside, smooth };

    /// What has happened at such a node in all steps since the points rest.
    struct FemHistory
    {
        double strainR = 0, strainZ = 0; ///< displacement by the new velocities, which strain the cells [m]
        double keep = 1;                 ///< share of a relative velocity that drag has left
        double mayMove = std::numeric_limits<double>::max(); ///< the points, before they must catch up [m]
    };

    /// An inner node lies among cells at rest only and nothing but they acts on it: its masses stay, its
    /// momentum is that of its own velocity, and only forces have to be summed.
    struct FemInner
    {
        double weightR, weightZ, inverseMass;
        double inverseLiquidMass, drag, porosity,
            liquidShare; ///< drag: not times the step; share: of the mass
        double spare;
    };

    /// A node between four cells, of which the first two lie opposite each other.
    struct FilterNode
    {
        int node;
        std::array<int, 4> cells;
    };

    /// Cells or nodes in the order of work, and where the part of each thread begins, and the last one ends.
    /// Parts of cells and of nodes are neighbours, loop after loop: what one thread has written must not
    /// come out of the cache of another.
    struct WorkList
    {
        std::vector<int> items, part;
    };

    /// work(cell) for all active cells, or work(node) for all active nodes, on all threads.
    template <class Work>
    void forCells(const Work& work) const
    {
        forItemsOf(active_, work);
    }
    /// For those with points that move and the FEM cells beside them.
    template <class Work>
    void forAwakeCells(const Work& work) const
    {
        forItemsOf(awake_, work);
    }
    template <class Work>
    void forItemsOf(const WorkList& list, const Work& work) const
    {
        threads_.share(list.part, cellsPerPiece, [&](int, int begin, int end) {
            for (int i = begin; i < end; ++i) {
                work(list.items[i]);
            }
        });
    }
    template <class Work>
    void forNodes(const Work& work) const
    {
        threads_.share(static_cast<int>(activeNodes_.size()), nodesPerPiece, [&](int, int begin, int end) {
            for (int i = begin; i < end; ++i) {
                work(activeNodes_[i]);
            }
        });
    }

    void updateCells(const State& state);
    void divideCells();
    void divide(WorkList& list) const;
    void findOuterNodes();
    void updateOccupancy(State& state);
    void classifyCells(State& state, bool looks);
    void moveBodies(State& state, double dt);
    void meanPressures(const State& state, std::vector<double>& cellPressure) const;
    void averageOverNodes(const std::vector<double>& ofCells, std::vector<double>& result) const;
    void averageToNodes(const std::vector<double>& ofCells) const;
    void findCheckerboardSigns();
    void findFilterNodes();
    void filterPressures(State& state);
    void takeCheckerboard(std::vector<double>& ofCells);
    /// Steps between two uses of the filter: once while a wave of the skeleton passes a cell, where the water
    /// is stiff and makes much of a checkerboard or the step is that of the skeleton (projection).
    [[nodiscard]] int filterInterval(const State& state) const
    {
        constexpr int forSoftWater = 10;
        return stepsPerPassage_ > 0
                   ? std::max(1, static_cast<int>(stepsPerPassage_ / std::sqrt(state.massScaling)))
                   : forSoftWater;
    }
    void staggerStrain(State& state, double dt);
    void mapToNodes(State& state);
    template <class Real>
    [[nodiscard]] auto cellLanes(const int* cells, int count) const;
    void sumPoints(const State& state, int c, kernels::StressSums<double>& sums);
    template <class Real>
    void addStress(const State& state, const int* cells, int count, const kernels::StressSums<double>* sums);
    template <class May, class Alone, class Together>
    void forPieces(const WorkList& list, const May& may, const Alone& alone, const Together& together) const;
    [[nodiscard]] bool mayTakeFours() const;
    void sumByFours(const State& state, std::span<const int> cells, kernels::StressSums<double>* sums)
        requires hasFours;
    [[nodiscard]] bool holdsItsPoints(const MaterialPoints& points, int c) const
        requires hasFours;
    template <bool wake>
    void moveByFours(State& state, double dt, std::span<const int> cells, const CellMotion* motions)
        requires hasFours;
    [[nodiscard]] CellMotion motionSinceRest(int c) const
        requires hasFours;
    void strainByFours(const int* cells, int count, double dt, CellMotion* motions) const
        requires hasFours;
    [[nodiscard]] double viscousStress(const State& state, int c, int material) const;
    /// How much longer the way from a point to its loaded surface has become, and r of the surface [m].
    struct PointSurface
    {
        double stretch, r;
    };
    [[nodiscard]] PointSurface surfaceOf(const MaterialPoints& points, int p) const;
    [[nodiscard]] std::array<double, 2> pointLoad(const MaterialPoints& points, int p) const;
    void addPointLoads(const State& state, int c);
    void findBoxCells(const BackgroundMesh& mesh);
    /// Whether cell c is one that boxes reach into.
    [[nodiscard]] bool inBoxes(int c) const
    {
        return hasBoxes && !boxCell_.empty() && boxCell_[c] != BoxCell::none;
    }
    void makeBoxes(const State& state)
        requires hasBoxes;
    [[nodiscard]] BoxPart wholePoint(const State& state, int p, int c) const
        requires hasBoxes;
    template <class Work>
    void forPartsIn(const State& state, int c, const Work& work) const
        requires hasBoxes;
    template <class Work>
    void forPartsOf(const State& state, int p, int c, const Work& work) const
        requires hasBoxes;
    void mapBoxCellToNodes(const State& state, int c)
        requires hasBoxes;
    void addRemappedBoxMomentum(const State& state, int c)
        requires hasBoxes;
    void moveBoxVelocities(State& state, double dt, int c)
        requires hasBoxes;
    void strainBoxPoints(State& state, double dt, int c)
        requires hasBoxes;
    void findPartialNodes(const State& state);
    [[nodiscard]] bool fits(int c) const { return !fit_.empty() && byPartial_[c] == 0; }
    [[nodiscard]] kernels::Fit fitWeights(const State& state, int c) const;
    void evaluateExpressions(const State& state, double dt);
    void addBodyForce(const State& state, int c);
    void solveNodes(State& state, double dt);
    void findFreeSurfaces(const State& state);
    void updateWallAreas(const State& state);
    void prepareLiquid(const State& state);
    void updateSurfacePressures(const State& state);
    [[nodiscard]] double suction(const RigidBody& body) const;
    void mapLiquidToNodes(const State& state, int c)
        requires twoPhase;
    void mapVoidToNodes(int c);
    void pump(State& state, double dt);
    [[nodiscard]] bool projects() const
    {
        return twoPhase && scene_.controls.pressureCoupling == SolutionControls::PressureCoupling::projection;
    }
    void project(State& state, double dt);
    /// Whether the points of a cell whose velocities are mapped again keep the dilatation that the pressures
    /// balance: otherwise the soil would be strained by volumes that the water knows nothing of.
    [[nodiscard]] bool keepsRate(int c) const
    {
        const SolutionControls& controls = scene_.controls;
        return projects() && controls.locking == SolutionControls::Locking::meanDilatation &&
               (controls.remap == SolutionControls::Remap::all ||
                (controls.remap == SolutionControls::Remap::loose && byLoose_[c] != 0));
    }
    [[nodiscard]] double projectedRate(const State& state, int c) const;
    /// Cells away from a surface are full of liquid, whatever their points hold.
    [[nodiscard]] bool isFull(int c) const
    {
        return scene_.controls.integration == SolutionControls::Integration::mixed && !bySurface_[c];
    }
    void freeMobility(int i, double dt);
    void holdMobility(int i, const std::array<double, 2>& direction, bool solid, bool flow, bool byWall,
                      double dt);
    void updateMobilities(double dt);
    void updateDilatationRows(const State& state, double dt);
    void multiplyPressures(const Eigen::VectorXd& x, Eigen::VectorXd& product);
    void factorisePressures();
    void solveTwoPhaseNode(int i, const Corner& solid, double dt)
        requires twoPhase;
    void solveLiquidAgain(int i, const std::array<double, 2>& direction);
    void applyLiquidConditions(double time, bool remapped);
    void applyConditions(double time, bool remapped);
    void applyContact(State& state, double dt, bool remapped);
    template <class Touch>
    void touchFaces(const RigidBody& body, const SurfaceNode& contact, const Touch& touch) const;
    void touchTwoPhase(const RigidBody& body, BodyReaction& reaction, const SurfaceNode& contact, double dt,
                       bool remapped);
    void mapToPoints(State& state, double dt);
    void averageDilatationAtNodes();
    template <class Velocity>
    void averageAtNodes(std::vector<double>& cellRate, const Velocity& velocity);
    /// The free surface whose water a void cell has at a corner. Over a wall that of the node's side: where
    /// two surfaces meet, the jump between their pressures would act on soil that reaches the top of the
    /// wall.
    [[nodiscard]] int voidSurface(int c, int k) const
    {
        return overWall_[c] ? nodeSurface_[cellNodes_[c * corners + k]] : freeSurface_[c];
    }
    /// Of a point now: the grains keep their volume.
    [[nodiscard]] double porosity(const MaterialPoints& points, int p) const
    {
        return 1 - points.mass[p] * liquid_[points.material[p]].grainVolume / points.volume[p];
    }
    template <bool velocities, bool strains>
    void mapCellToPoints(State& state, double dt, int c);
    [[nodiscard]] CornerMotion cornerMotion(int c) const;
    [[nodiscard]] FilledStrain strainOfFilled(int c, const CornerMotion& motion, double dt) const;
    void addRemappedMomentum(const State& state, int c);
    void remapMomentum(const State& state, int c);
    [[nodiscard]] std::array<double, 2> affineVelocity(const State& state, int p, int corner) const;
    bool updateBatch(int material, int thread, int begin, int end, const std::array<const double*, 4>& strain,
                     const double* spin, std::array<std::vector<double>, 4>& stress,
                     std::vector<std::vector<double>>& variables);
    void updateStress(State& state, bool resting);
    template <class Run, class Work>
    void inBlocks(std::span<const Run> runs, const Work& work) const;
    [[nodiscard]] bool resting(int c) const { return !femOf_.empty() && femOf_[c] >= 0; }
    [[nodiscard]] double mayRest(const State& state, int c, double step) const;
    [[nodiscard]] int chooseRest(const MaterialPoints& points, const std::vector<double>& mayRest) const;
    void chooseFemCells(const State& state);
    /// Weight of the mixture per mass of the solid, over gravity.
    [[nodiscard]] double weighing(int material) const
    {
        return gravityShare_[material] / (twoPhase ? solidShare_[material] : 1.0);
    }
    void wakeBesideBodies(const MaterialPoints& points);
    [[nodiscard]] bool mayBeViscous(const State& state, int c) const;
    void setFemViscosity(const State& state, double dt);
    void numberFemNodes();
    void sampleFemCell(int c);
    void addViscousForces(int c);
    template <class Real>
    void addFemViscosity(int material, const Real& time, const Real (&rate)[4], Real (&stress)[4]) const;
    void sumInnerNodes();
    void mapFemCellsToNodes();
    template <class Real, class Count>
    void addFemForces(const State& state, const FemBlock& block, int material, int f, Count count);
    void mapFemEdgeToNodes(int f);
    void solveInnerNodes(double dt);
    [[nodiscard]] FemForce innerForce(int j) const;
    [[nodiscard]] bool solveFourInnerNodes(int j, double dt)
        requires(hasFours && twoPhase);
    void keepFemMomentum(int c);
    template <class Real, class Count>
    void setYielding(const FemBlock& block, int material, int f, Count count);
    template <class Count>
    void strainFemCells(State& state, double dt, FemBlock& block, int material, int f, Count count);
    void updateFemCells(State& state, double dt);
    void accumulateFemNodes(double dt);
    void returnInnerMotion();
    [[nodiscard]] StableStep femStep(const State& state) const;
    [[nodiscard]] StableStep estimatedStep(const State& state) const;
    void keepMeanRates(const State& state);
    void wakeFemCells(State& state);
    void wakeFemCell(State& state, int c);
    void moveBodiesAndMesh(State& state, double dt);
    void relocate(State& state, bool sorts);
    void sortPoints(State& state);
    void mergePassedPoints(State& state);
    void mergePointsOf(State& state, int c);
    [[nodiscard]] int cellOfMoved(State& state, int p, int c) const;
    void scaleInertia(const State& state);
    [[nodiscard]] double waveStep(const State& state, int c) const;
    [[nodiscard]] double laggedDragStep(const State& state, int c, double size) const;
    [[nodiscard]] double fastestWave(const State& state, int c) const;
    void findStiffestMode(const State& state)
        requires isConstantStrain;
    [[nodiscard]] typename StiffestMode<phases>::Cell modeCell(const State& state, int c) const
        requires isConstantStrain;
    void setModeNodes()
        requires isConstantStrain;
    [[nodiscard]] double cellStep(const State& state, int c) const;

    const Scene& scene_;
    mutable Threads threads_;
    mutable std::vector<StableStep> shortest_;           ///< per thread
    mutable StableStep stable_{};                        ///< as estimated last; its step 0 where not known
    mutable long stableSince_ = 0;                       ///< step of that
    std::vector<std::vector<PointCells::Mover>> movers_; ///< per thread
    std::vector<std::vector<double*>> statePointers_;    ///< per thread
    std::vector<int> cellNodes_;                         ///< corners in the order that Shape wants
    CompressedRows nodeCorners_;                         ///< around each node: cell * corners + corner
    std::vector<BodySurface> surfaces_;
    std::vector<double> impulseBefore_; ///< per body: its vertical impulse before the step
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
    std::vector<kernels::Fit> fit_;          ///< per cell, with fittedWeights only
    std::vector<unsigned char> byPartial_;   ///< likewise: has a node of a partly filled cell
    std::vector<unsigned char> partialNode_; ///< likewise: of a partly filled cell
    std::vector<std::array<double, 2>>
        pointCentre_;                   ///< of filled cells: mean local coordinates of the points
    std::vector<double> gravityShare_;  ///< per material: weighing over inertial density
    std::vector<double> waveSpeed_;     ///< per material
    std::vector<double> density_;       ///< per material, inertial
    std::vector<double> largestVolume_; ///< per material: of a point, per mass [m3/kg]
    std::vector<double> solidShare_; ///< per material: of the solid in the inertial density; 1 of one phase

    PointCells pointCells_;
    bool byFours_ = false; ///< points of filled cells are computed four at a time
    std::vector<unsigned char> occupied_;
    std::vector<unsigned char> surfaceNode_; ///< touches an empty cell that is no body's
    std::vector<unsigned char> bySurface_;   ///< per cell: has a surface node
    std::vector<unsigned char> looseNode_;   ///< on a surface, or with a mass well below that of full cells
    std::vector<unsigned char> byLoose_;     ///< per cell: has a loose node
    WorkList active_, awake_;
    std::vector<int> activeNodes_;
    std::vector<int> emptyCells_; ///< and those of bodies
    std::vector<unsigned char> activeNode_;
    bool occupancyChanged_ = true;
    int stepsToSort_ = 0; ///< never where it is not positive

    std::vector<Corner> cornerSums_;
    std::vector<Node> nodes_;
    std::vector<std::array<double, 2>> traction_;
    // Soil with pore water; empty otherwise.
    std::vector<double> surfacePressure_;          ///< per free surface: excess pressure now [Pa]
    std::vector<std::array<double, 2>> wallArea_;  ///< per node: normals of bodies into the soil times area
    std::vector<std::array<double, 2>> waterLoad_; ///< per node: of pressures on patches; of all seepage
    double unitWeight_ = 0;                        ///< of the liquid, along z [N/m3]: negative
    // Quasi-steady seepage only.
    std::vector<double> seepage_;   ///< per node: excess pressure [Pa]
    std::vector<double> wallWater_; ///< per body: vertical force of the water on it [N/rad or N/m]
    // Two phases only.
    std::vector<LiquidNode> liquidNodes_;
    std::vector<std::array<bool, 2>> solidHeld_; ///< per node of the liquid's boundary and direction
    std::vector<LiquidProperties> liquid_;       ///< per material
    std::vector<int> freeSurface_;               ///< per cell: the free surface that its void would be of
    std::vector<int> nodeSurface_;               ///< per node of a void cell: the free surface that it is of
    std::vector<unsigned char> overWall_;        ///< per cell: at the radius of a wall
    std::vector<int> voidCells_;                 ///< empty cells with active nodes
    bool pumped_ = false;                        ///< a free surface has a given flow
    std::vector<std::array<double, 2>> voidForce_; ///< per corner, of a unit pressure in the void; with pumps
    std::vector<double> givenPressure_;            ///< per node: excess pressure of a boundary, or NaN
    std::vector<int> openNodes_;                   ///< on patches that give a pressure
    std::vector<int> voidNodes_;                   ///< of voidCells_ in the last step
    mutable std::vector<double> cellPressure_, cellAverage_; ///< of the filter
    double stepsPerPassage_ = 0; ///< of a wave of the skeleton through a cell, where the filter asks for it
    std::vector<signed char> checkerboardSign_;        ///< per corner
    std::vector<FilterNode> checkerboardNodes_;        ///< those between four cells (quadrilaterals)
    std::vector<FilterNode> filterNodes_;              ///< those that the filter looks at
    std::vector<double> alternating_;                  ///< per node: what it finds there, 0 elsewhere
    std::vector<double> cellLiquidRate_;               ///< as cellRate_, for the liquid
    std::vector<double> loadedArea_;                   ///< per load: of its points (see loadedAreas)
    std::vector<std::array<double, 2>> pointTraction_; ///< per load, now [Pa]
    // With a body force only: acceleration of the points in this step [m/s2].
    std::vector<double> bodyForceR_, bodyForceZ_;
    std::vector<PointVector::Workspace> bodyForceRoom_; ///< per thread
    // With loads given by expressions only: tractions of the points in this step [Pa].
    std::vector<double> expressionR_, expressionZ_;
    std::vector<std::vector<PointVector::Workspace>> expressionRoom_; ///< per thread and load
    // Projection only.
    std::vector<Mobility> mobility_;             ///< per node
    std::vector<WallTouch> wallTouches_;         ///< of this step
    std::vector<std::array<double, 2>> flowRow_; ///< per corner: dilatation of the cell per velocity [m2/rad]
    std::vector<std::array<double, 2>> flow_;    ///< per node
    std::vector<double> storage_;                ///< per cell [m3/rad/(Pa s)]
    Eigen::VectorXd pressureLoad_, pressureStep_; ///< per cell: less the flow [m3/rad/s], increment [Pa]
    PressureSolver pressureSolver_;
    std::vector<double> cellRate_;        ///< dilatation rate used by the points of the cell (nodal average)
    mutable std::vector<double> ofNodes_; ///< of averageOverNodes
    std::array<std::vector<double>, 4> strain_; ///< increments of the step, per point
    std::vector<double> spin_;
    // Cells whose points rest; empty where none may.
    std::vector<int> femOf_;                      ///< per cell: index of its FemCell, or -1
    std::vector<unsigned char> rests_;            ///< per cell: is one
    std::vector<std::array<double, 4>> meanRate_; ///< per cell: FemFields::meanRate when it was one last
    std::vector<long> yieldedAt_;                 ///< per cell: step when it was one last that had yielded
    std::vector<FemCell> femCells_;
    std::vector<FemLiquidCell> femLiquidCells_;
    std::vector<int> femEdge_;                    ///< FEM cells with a node that is no inner one
    std::vector<unsigned char> restless_;         ///< per thread: points have moved too far to rest on
    std::vector<FemNode> femNodes_;               ///< nodes of FEM cells: the inner ones, and the others
    int innerNodes_ = 0;                          ///< of these
    std::vector<FemMotion> femMotion_, femStart_; ///< per FemNode: now, and when the points came to rest
    std::vector<FemHistory> femHistory_;          ///< per FemNode
    std::vector<FemInner> femInner_;              ///< per inner node
    bool femInnerOld_ = true;
    double femTime_ = 0;                      ///< since the points rest [s]
    CompressedRows femCorners_;               ///< around each inner node: FEM cell * corners + corner
    std::vector<FemForce> femForces_;         ///< per corner of the FEM cells
    typename Shape::FrozenCells femShapes_;   ///< of the FEM cells, when the points came to rest
    std::vector<unsigned char> innerNode_;    ///< per node
    std::vector<unsigned char> boundaryNode_; ///< per node: on the boundary of the mesh
    WorkList outerNodes_;                     ///< active nodes that are no inner ones
    mutable StableStep femStep_{};            ///< that FEM cells allow; 0 where not known
    std::vector<FemRun> femRuns_;
    FemFields fem_;
    std::vector<double> shearModulus_, pWaveModulus_; ///< per material [Pa]
    // Speed of the waves of the soil [m/s]: with its liquid or, where that may leave, without; and without
    // it.
    std::vector<double> skeletonSpeed_, drainedSpeed_;
    long femSteps_ = 0;      ///< steps that the points rest already
    double viscousStep_ = 0; ///< longest step that the viscosity of FEM cells is set for [s]
    double femFlip_ = 1;     ///< share of the FLIP velocity that these steps leave
    // Boxes of points; empty where none has one.
    std::vector<BoxCell> boxCell_; ///< per cell
    std::vector<std::array<int, 9>>
        around_;                  ///< per cell: itself and those around it, row by row from below, or -1
    std::vector<PointBox> boxes_; ///< per point
    CellLocator locator_;
    // Triangles only (StableStepKernels.h).
    StiffestMode<phases> mode_;
    std::vector<int> modeNumber_;                   ///< per node: its number there, or -1
    double stepShare_ = 1;                          ///< the stable step over what the size of the cells says
    double nodalShare_ = shapes::nodalShare<Shape>; ///< likewise, of nodes whose points keep all they have
};

} // namespace caisson

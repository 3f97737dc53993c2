#pragma once

#include "bodies/BodySurface.h"
#include "bodies/FreeSurface.h"
#include "boundary/LiquidBoundary.h"
#include "boundary/VelocityConditions.h"
#include "constitutive/Material.h"
#include "materialPoints/MaterialPoints.h"
#include "materialPoints/PointLoads.h"
#include "materialPoints/PointVector.h"
#include "mesh/MeshMotion.h"

#include <algorithm>
#include <limits>

namespace caisson {

/// Switches of system/mpmSolution.
struct SolutionControls
{
    /// mixed: cells filled with soil are integrated with their own volume [Jassim, Stolle & Vermeer 2013],
    /// the others at their points; points: all at their points.
    enum class Integration { mixed, points };
    /// Treatment of volumetric locking: mean dilatation of a quadrilateral [Hughes 1980], or volumetric
    /// strain averaged at the nodes of triangles [Detournay & Dzik 2006].
    enum class Locking { none, meanDilatation, nodalAverage };
    /// Nodes whose velocity is mapped again from the points before strains are taken from it: none, those of
    /// loosely filled cells and free surfaces, whose masses may be small, or all [Sulsky, Zhou & Schreyer
    /// 1995].
    enum class Remap { none, loose, all };

    /// Drag between liquid and solid: implicit at the nodes, or with the velocities of the step before.
    enum class Drag { implicit, lagged };

    /// How the pore pressure of soil follows it: a second phase in the explicit step; the same with pressures
    /// of the end of the step, which neither the liquid's stiffness nor drag limit; or (one phase) steady
    /// seepage between the surfaces as they are now, whose gradient loads the drained soil.
    enum class PressureCoupling { explicitStep, projection, quasiSteady };

    /// Cells whose points rest between two sorts while the cell itself is a finite element: none, or all
    /// filled ones that are femDistance cells away from bodies, surfaces and loads.
    enum class FemCells { none, automatic };

    double boxWidth = 0; ///< of a point's box over that of its cell [-]; 0: shape functions at the point
    std::string boxZone; ///< cellZone of such points; empty: all
    FemCells femCells = FemCells::none;
    int femDistance = 6;       ///< [cells]
    std::string femZone;       ///< cellZone that they are in; empty: anywhere
    double femMotion = 0.2;    ///< of their points relative to the mesh until the next sort [cells], at most
    double femStrain = 0.01;   ///< of their points until the next sort [-], at most
    double femViscosity = 0.2; ///< of the critical damping, times pi h/l (setFemViscosity)
    PressureCoupling pressureCoupling = PressureCoupling::explicitStep;
    double seepageInterval =
        0.02;                  ///< penetration of a body between two solutions of quasi-steady seepage [m]
    double seepageRamp = 0.2;  ///< time over which quasi-steady seepage sets in [s]
    double seepageGate = 0.05; ///< of the pressure that steady seepage leaves out, over the suction [-]
    int phases = 1; ///< 1: soil, drained or dry; 2: soil and liquid with velocities of their own (v-w)
    Drag drag = Drag::implicit;
    Integration integration = Integration::mixed;
    Locking locking = Locking::meanDilatation;
    Remap remap = Remap::loose;
    double flipShare = 1; ///< share of the FLIP velocity update per step [-]
    /// APIC [Jiang, Schroeder, Selle, Teran & Stomakhin 2015] instead of PIC: points bring the gradient of
    /// their velocity to the nodes, taken from the velocities that strains are taken from. Unstable with a
    /// share of FLIP, and where soil yields beside a free surface.
    bool affine = false;
    /// One phase, quadrilaterals: points of filled cells away from partly filled ones weigh as their places
    /// ask for, so that their centre is that of the cell, and stress and strain are those of these places.
    bool fittedWeights = false;
    double picTime = 0;                ///< time over which velocities relax to the PIC ones [s]; 0: never
    double localDamping = 0;           ///< share of the out-of-balance force [-]
    double linearBulkViscosity = 0;    ///< [-]
    double quadraticBulkViscosity = 0; ///< [-]
    /// What the factor on the inertia of the soil is chosen by: given; or as large as the gates allow.
    enum class MassScaling { given, gates };
    MassScaling massScalingBy = MassScaling::given;
    double massScaling = 1; ///< the factor [-], or its upper limit
    bool scaleSmallCells =
        false;                 ///< scale only the cells whose own step is below that of the smallest, scaled
    double inertiaGate = 0.02; ///< of scaled rho v^2 over the vertical effective stress at the tip [-]
    double energyGate = 0.05;  ///< of kinetic energy over work done [-]
    /// Share of a checkerboard of pore pressures that is removed every ten steps, or, with the projection or
    /// stiff water, whenever a wave of the skeleton has passed a cell; smooth fields change by O(h^8), in
    /// triangles O(h^4).
    double checkerboardFilter = 1;
    int sortInterval = 50;  ///< steps between physical sorts of the points; those of FEM cells rest between
    int checkInterval = 10; ///< steps between estimates of the stable step, and looks at how full cells are
    int passedPointsPerCell = 0; ///< at most, where the tip of the moving body has passed; 0: any number
    int threads = 0;             ///< 0: the processors, where there are points enough

    /// Share of the FLIP velocity that a step leaves.
    [[nodiscard]] double flipOf(double dt) const
    {
        return std::max(0.0, flipShare - (picTime > 0 ? dt / picTime : 0.0));
    }

    [[nodiscard]] bool isViscous() const { return linearBulkViscosity != 0 || quadraticBulkViscosity != 0; }

    /// Cells at rest have one dilatation and the velocities of their nodes.
    [[nodiscard]] bool mayHaveFemCells() const
    {
        return femCells == FemCells::automatic && integration == Integration::mixed &&
               locking != Locking::none && remap != Remap::all && !affine && !fittedWeights;
    }
};

/// All that does not change while a case runs. Plain, validated data.
struct Scene
{
    std::vector<Material> materials;
    std::array<double, 2> gravity{0, 0}; ///< [m/s2]
    VelocityConditions conditions;
    LiquidBoundary liquidBoundary;         ///< two phases: patches
    std::vector<FreeSurface> freeSurfaces; ///< two phases: surfaces of the soil under water or air
    std::vector<PointLoad> pointLoads;
    PointVector bodyForce; ///< one phase: acceleration of the soil besides gravity [m/s2]
    MeshMotion motion;
    int movingBody = -1;            ///< index of the body that the mesh follows, or -1
    std::vector<double> referenceZ; ///< node heights of constant/polyMesh [m]
    SolutionControls controls;
};

/// What the soil did to a body: impulses of effective stress on the body per part of its surface since they
/// were last collected [N s/rad or N s/m], upward and away from the axis positive.
struct BodyReaction
{
    std::array<double, surfaceParts> verticalImpulse{};
    std::array<double, surfaceParts> radialImpulse{};
    double waterImpulse = 0; ///< of the excess pore pressure, vertical; not in those above
    double suction = 0;      ///< of the water within the body, of the last step [Pa]
    double force = 0;        ///< vertical, of the last step, pore pressure included [N/rad or N/m]
    double duration = 0;     ///< of the collection [s]
    double work = 0;         ///< done by the body on the soil since the start [J/rad or J/m]

    /// Of soil and water.
    [[nodiscard]] double totalVerticalImpulse() const
    {
        double sum = waterImpulse;
        for (const double part : verticalImpulse) {
            sum += part;
        }
        return sum;
    }

    /// Forgets what was collected; the work stays.
    void restartCollection()
    {
        verticalImpulse = {};
        radialImpulse = {};
        waterImpulse = 0;
        duration = 0;
    }
};

/// Everything that changes with time, and nothing else that matters: writing it is a complete restart.
struct State
{
    BackgroundMesh mesh;
    MaterialPoints points;
    std::vector<RigidBody> bodies;
    std::vector<BodyReaction> reactions; ///< one per body
    std::vector<double> pumped;          ///< per free surface: pressure that its pump has made [Pa]
    std::vector<unsigned char> filled;   ///< per cell: integrated as filled (has hysteresis)
    std::vector<double> cellDivergence;  ///< per cell, rate [1/s]; kept for the bulk viscosity alone
    double massScaling = 1;              ///< factor on the inertia of the soil now
    double time = 0;
    long step = 0;
    double timeStep = 0; ///< of the last step [s]
};

} // namespace caisson

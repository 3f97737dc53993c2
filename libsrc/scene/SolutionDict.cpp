#include "scene/SolutionDict.h"

namespace caisson {

namespace {

constexpr Keyword keywords[] = {
    {"phases", "integer", "1", "1 2",
     "1: the soil alone, drained or dry; 2: soil and pore liquid, each with its velocity (v-w)"},
    {"drag", "word", "implicit", "implicit lagged",
     "drag between the phases: implicit at the nodes, or with the last velocities, which limits the step"},
    {"checkerboardFilter", "-", "1", "[0, 1]",
     "share of a checkerboard of pore pressures that is removed every ten steps; in every step of the "
     "projection; and in quadrilaterals whenever a wave of the skeleton has passed a cell, if those of the "
     "water are three times as fast; two phases only"},
    {"integration", "word", "mixed", "mixed points",
     "mixed: cells filled with soil with their own volume, others at their points; points: all at points"},
    {"fittedWeights", "flag", "no", "",
     "points of filled cells weigh so that their centre is the cell's: second order at large strain; one "
     "phase, "
     "quadrilaterals"},
    {"volumetricLocking", "word", "automatic", "automatic none meanDilatation nodalAverage",
     "treatment of locking; automatic: meanDilatation on quadrilaterals, nodalAverage on triangles"},
    {"shapeFunctions", "word", "linear", "linear GIMP BSpline",
     "linear: those of the mesh at the point; GIMP: averaged over the point's box; BSpline: over a box as "
     "wide "
     "as a cell. One phase, rectangles"},
    {"boxWidth", "-", "0.5", "(0, 1]",
     "GIMP: width of the boxes over that of their cells: 1 over the points per cell and direction"},
    {"boxZone", "word", "-", "", "cellZone whose points have boxes; everywhere without it"},
    {"femCells", "word", "none", "none automatic",
     "automatic: cells well inside the soil are finite elements, whose points rest from sort to sort"},
    {"femDistance", "integer", "6", "[1, 1000]",
     "cells between an FEM cell and a body, a free surface or a loaded cell"},
    {"femZone", "word", "-", "", "cellZone that FEM cells are in; anywhere without it"},
    {"femMotion", "-", "0.2", "(0, 1]",
     "cells that points of FEM cells may move relative to the mesh until the next sort; those that would "
     "move "
     "further do not rest"},
    {"femStrain", "-", "0.01", "(0, 1]", "strain that they may have until the next sort, likewise"},
    {"femViscosity", "-", "0.2", "[0, 1]",
     "viscosity of FEM cells that yield, lest vibrations grow: pi times this h/l of the critical damping for "
     "waves of length l over cells of size h"},
    {"velocityRemap", "word", "loose", "none loose all",
     "nodes whose velocity is mapped again from the points before strains are taken from it"},
    {"pressureCoupling", "word", "explicit", "explicit projection quasiSteady",
     "pore water: a phase of its own in the explicit step, or with a step that its stiffness and drag do not "
     "limit (phases 2); or steady seepage through drained soil (phases 1)"},
    {"seepageInterval", "m", "0.02", "(0, inf)",
     "penetration of a body between two solutions of quasiSteady"},
    {"seepageRamp", "s", "0.2", "[0, inf)", "time over which the pressures of quasiSteady set in"},
    {"seepageGate", "-", "0.05", "(0, inf)",
     "warn where what quasiSteady leaves out passes this share of the pressures"},
    {"flipShare", "-", "1", "[0, 1]", "share of the FLIP velocity update per step, the rest is PIC"},
    {"affine", "flag", "no", "",
     "APIC: points bring the gradient of their velocity to the nodes, which keeps angular momentum; "
     "flipShare 0, elastic laws, quadrilaterals"},
    {"picTime", "s", "0", "[0, inf)", "time over which velocities relax to the PIC ones; 0 is never"},
    {"localDamping", "-", "0", "[0, 1)",
     "share of the out-of-balance force that opposes the motion; 0 to 0.05 while a body penetrates"},
    {"linearBulkViscosity", "-", "0", "[0, 1]", "factor of the linear viscous pressure; 0.06 is usual"},
    {"quadraticBulkViscosity", "-", "0", "[0, 10]",
     "factor of the quadratic one, in compression; 1.2 is usual"},
    {"massScaling", "-", "1", "[1, inf)", "factor on the inertia of the soil; its upper limit with gates"},
    {"massScalingBy", "word", "given", "given gates",
     "given: massScaling itself; gates: as much as inertiaGate and energyGate allow as the run goes"},
    {"massScalingOf", "word", "soil", "soil smallCells",
     "soil: all of it; smallCells: those cells alone whose own step is below that of the smallest, scaled"},
    {"inertiaGate", "-", "0.02", "(0, inf)",
     "share of the vertical effective stress at the tip that scaled inertia rho v^2 may have (else a "
     "warning)"},
    {"energyGate", "-", "0.05", "(0, inf)",
     "share of the work done that the scaled kinetic energy may have (else a warning)"},
    {"monitorInterval", "s", "0.005", "[0, inf)", "least time between two records in postProcessing"},
    {"sortInterval", "integer", "50", "[1, 100000]",
     "steps between two sorts of the points in memory, at most: FEM cells may need them sooner"},
    {"checkInterval", "integer", "10", "[1, 100]",
     "steps between two estimates of the stable step, and two looks at how full the cells are: cells that a "
     "mesh compresses lose next to nothing in between"},
    {"passedPointsPerCell", "integer", "0", "[0, 1000]",
     "points that a filled cell keeps where the tip of a body that the mesh follows down has passed it: more "
     "are merged two by two, 8 or 9 will do. 0: any number"},
    {"threads", "integer", "0", "[0, 64]",
     "threads; 0 takes the processors, one for every 5,000 points at most. Results do not depend on it"},
};

constexpr int leastPassedPoints = 4;

} // namespace

std::span<const Keyword> solutionKeywords() { return keywords; }

double readMonitorInterval(const Dictionary& mpmSolution)
{
    InputProblems alreadyReported;
    return KeywordReader(mpmSolution, keywords, "mpmSolution", alreadyReported).number("monitorInterval");
}

SolutionControls readSolutionControls(const Dictionary& mpmSolution, bool triangles, InputProblems& problems)
{
    const KeywordReader reader(mpmSolution, keywords, "mpmSolution", problems);
    SolutionControls controls;
    controls.phases = static_cast<int>(reader.integer("phases"));
    controls.drag =
        reader.word("drag") == "lagged" ? SolutionControls::Drag::lagged : SolutionControls::Drag::implicit;
    controls.checkerboardFilter = reader.number("checkerboardFilter");
    controls.integration = reader.word("integration") == "points" ? SolutionControls::Integration::points
                                                                  : SolutionControls::Integration::mixed;
    controls.fittedWeights = reader.flag("fittedWeights");
    if (controls.fittedWeights && (triangles || controls.phases == 2 ||
                                   controls.integration == SolutionControls::Integration::points)) {
        reader.problem("fittedWeights", "weights are fitted in filled quadrilaterals of one phase",
                       "fittedWeights no; or phases 1, integration mixed");
    }
    const std::string locking = reader.word("volumetricLocking");
    if (locking == "none") {
        controls.locking = SolutionControls::Locking::none;
    } else if (locking == "nodalAverage" || (locking == "automatic" && triangles)) {
        controls.locking = SolutionControls::Locking::nodalAverage;
    } else {
        controls.locking = SolutionControls::Locking::meanDilatation;
    }
    if (triangles && locking == "meanDilatation") {
        reader.problem("volumetricLocking",
                       "meanDilatation does nothing on triangles, whose strain is constant",
                       "choose nodalAverage or none");
    }
    const std::string remap = reader.word("velocityRemap");
    controls.remap = remap == "none"  ? SolutionControls::Remap::none
                     : remap == "all" ? SolutionControls::Remap::all
                                      : SolutionControls::Remap::loose;
    const std::string coupling = reader.word("pressureCoupling");
    controls.pressureCoupling = coupling == "quasiSteady"  ? SolutionControls::PressureCoupling::quasiSteady
                                : coupling == "projection" ? SolutionControls::PressureCoupling::projection
                                                           : SolutionControls::PressureCoupling::explicitStep;
    if (controls.pressureCoupling == SolutionControls::PressureCoupling::projection) {
        if (controls.phases != 2) {
            reader.problem("pressureCoupling", "projection is of soil with a liquid of its own", "phases 2;");
        }
        if (controls.locking == SolutionControls::Locking::none && !triangles) {
            reader.problem("volumetricLocking", "projection knows one pressure per cell",
                           "meanDilatation or nodalAverage; or pressureCoupling explicit");
        }
        if (controls.drag == SolutionControls::Drag::lagged) {
            reader.problem("drag", "the step of lagged drag is what projection is to avoid",
                           "drag implicit;");
        }
    }
    if (controls.phases == 2 &&
        controls.pressureCoupling == SolutionControls::PressureCoupling::quasiSteady) {
        reader.problem("pressureCoupling",
                       "quasiSteady goes with phases 1: the soil is drained, and loaded by seepage",
                       "phases 1; or pressureCoupling explicit");
    }
    const std::string functions = reader.word("shapeFunctions");
    controls.boxWidth = functions == "GIMP" ? reader.number("boxWidth") : functions == "BSpline" ? 1.0 : 0.0;
    controls.boxZone = reader.has("boxZone") ? reader.word("boxZone") : std::string();
    if (functions != "GIMP" && reader.has("boxWidth")) {
        reader.problem("boxWidth", "boxWidth is of shapeFunctions GIMP", "shapeFunctions GIMP;");
    }
    if (functions == "linear" && !controls.boxZone.empty()) {
        reader.problem("boxZone", "linear shape functions have no boxes", "shapeFunctions GIMP;  or BSpline");
    }
    if (functions != "linear" && controls.phases == 2) {
        reader.problem("shapeFunctions", functions + " is of soil of one phase", "shapeFunctions linear;");
    } else if (functions != "linear" && triangles) {
        reader.problem("shapeFunctions", functions + " needs rectangles, the mesh has triangles",
                       "shapeFunctions linear;");
    }
    controls.femCells = reader.word("femCells") == "automatic" ? SolutionControls::FemCells::automatic
                                                               : SolutionControls::FemCells::none;
    controls.femDistance = static_cast<int>(reader.integer("femDistance"));
    controls.femZone = reader.has("femZone") ? reader.word("femZone") : std::string();
    controls.femMotion = reader.number("femMotion");
    controls.femStrain = reader.number("femStrain");
    controls.femViscosity = reader.number("femViscosity");
    controls.seepageInterval = reader.number("seepageInterval");
    controls.seepageRamp = reader.number("seepageRamp");
    controls.seepageGate = reader.number("seepageGate");
    controls.flipShare = reader.number("flipShare");
    controls.picTime = reader.number("picTime");
    controls.affine = reader.flag("affine");
    if (controls.affine && controls.flipShare != 0) {
        reader.problem("affine", "affine (APIC) takes the place of FLIP", "flipShare 0;");
    }
    if (controls.affine && controls.boxWidth > 0) {
        reader.problem("affine", "affine (APIC) is of linear shape functions", "shapeFunctions linear;");
    }
    if (controls.affine && controls.remap != SolutionControls::Remap::loose) {
        reader.problem("affine", "affine (APIC) is unstable without velocityRemap loose",
                       "velocityRemap loose;");
    }
    if (controls.femCells == SolutionControls::FemCells::automatic && !controls.mayHaveFemCells()) {
        reader.problem("femCells",
                       "FEM cells need integration mixed, a treatment of volumetricLocking, and other "
                       "velocities than those of velocityRemap all or affine, and no fittedWeights",
                       "femCells none; or those settings");
    }
    controls.localDamping = reader.number("localDamping");
    controls.linearBulkViscosity = reader.number("linearBulkViscosity");
    controls.quadraticBulkViscosity = reader.number("quadraticBulkViscosity");
    controls.massScaling = reader.number("massScaling");
    controls.massScalingBy = reader.word("massScalingBy") == "gates" ? SolutionControls::MassScaling::gates
                                                                     : SolutionControls::MassScaling::given;
    controls.scaleSmallCells = reader.word("massScalingOf") == "smallCells";
    controls.inertiaGate = reader.number("inertiaGate");
    controls.energyGate = reader.number("energyGate");
    controls.sortInterval = static_cast<int>(reader.integer("sortInterval"));
    controls.checkInterval = static_cast<int>(reader.integer("checkInterval"));
    controls.passedPointsPerCell = static_cast<int>(reader.integer("passedPointsPerCell"));
    if (controls.passedPointsPerCell > 0 && controls.passedPointsPerCell < leastPassedPoints) {
        reader.problem("passedPointsPerCell", "a cell of so few points has no slopes of stress",
                       "passedPointsPerCell 9;  or 0, for any number");
    } else if (controls.passedPointsPerCell > 0 &&
               controls.integration == SolutionControls::Integration::points) {
        reader.problem("passedPointsPerCell", "points are merged in filled cells", "integration mixed;");
    }
    controls.threads = static_cast<int>(reader.integer("threads"));
    return controls;
}

} // namespace caisson

// axiMpmFoam: installation of caissons and other offshore foundations by the material point method.
//
// Usage: axiMpmFoam [-case <directory>] [-dry-run]

#include "InstallationWatch.h"
#include "Plan.h"
#include "RunOutput.h"
#include "case/FileIO.h"
#include "case/Log.h"
#include "case/Program.h"
#include "case/RunTime.h"
#include "dictionary/Text.h"
#include "scene/CaseScene.h"
#include "scene/QuasiSteadySeepage.h"
#include "scene/StabilityWatch.h"

#include <cmath>
#include <iostream>

namespace {

using namespace caisson;

/// Fixed steps are refused where they are longer than the stable one.
void checkTimeStep(const RunTime& runTime, double deltaT, const StableStep& stable)
{
    if (deltaT <= stable.step) {
        return;
    }
    throw InputError("the run",
                     {{{"system/controlDict", 0},
                       text("deltaT %.4g s is longer than the stable step %.4g s (cell %d: size %.4g m, "
                            "wave speed %.4g m/s) at t = %.6g s",
                            deltaT, stable.step, stable.cell, stable.size, stable.waveSpeed, runTime.time()),
                       "set adjustTimeStep yes, or a smaller deltaT"}});
}

/// The stretched zones of the mesh must not be pressed flat.
void checkMotion(const Scene& scene, const State& state)
{
    if (scene.movingBody < 0) {
        return;
    }
    const RigidBody& body = state.bodies[scene.movingBody];
    const double displacement = body.tipLevel - body.initialTipLevel;
    const DisplacementRange range = scene.motion.allowedDisplacements();
    if (displacement < range.lowest || displacement > range.highest) {
        throw InputError("the run",
                         {{{"constant/dynamicMeshDict", 0},
                           text("the mesh cannot follow '%s' any further: it has moved by %.4g m, and the "
                                "stretched zones allow %.4g to %.4g m",
                                body.name.c_str(), displacement, range.lowest, range.highest),
                           "set top higher or bottom lower"}});
    }
}

int run(const std::filesystem::path& caseDirectory, bool dryRun, const std::string& commandLine)
{
    Log log(std::cout);
    log.banner(commandLine, caseDirectory);
    const std::string subject = "case " + caseDirectory.string();

    InputProblems problems;
    const ControlDict control = readControlDict(caseDirectory, problems);
    problems.throwIfAny(subject); // the rest depends on the start time
    RunTime runTime(caseDirectory, control, log);
    CaseScene caseScene =
        readCaseScene(caseDirectory, runTime.startDirectory(), runTime.restarted(), runTime.kept, problems);
    problems.throwIfAny(subject);
    Scene& scene = caseScene.scene;
    State& state = caseScene.state;
    state.time = runTime.time();
    state.step = runTime.index();
    const std::unique_ptr<TimeStep> step = makeTimeStep(scene, state);
    printPlan(log, control, scene, state, *step);
    checkTimeStep(runTime, control.adjustTimeStep ? 0 : control.deltaT, step->stableStep(state));
    std::unique_ptr<QuasiSteadySeepage> seepage;
    if (scene.controls.pressureCoupling == SolutionControls::PressureCoupling::quasiSteady) {
        seepage = std::make_unique<QuasiSteadySeepage>(scene);
        seepage->update(state, *step, true);
    }
    if (dryRun) {
        timeSteps(log, control, runTime, scene, state, *step);
        return 0;
    }

    RunOutput output(runTime, caseScene, log);
    InstallationWatch watch(state, log);
    StabilityWatch stability;
    while (runTime.running()) {
        const StableStep stable = step->stableStep(state);
        const double deltaT = runTime.advance(runTime.wantedDeltaT(stable.step));
        checkTimeStep(runTime, deltaT, stable);
        if (seepage) {
            seepage->update(state, *step, false);
        }
        try {
            step->advance(state, deltaT);
        } catch (const InputError&) {
            stability.look(scene, state, stable); // a blow-up is the better answer than what it has led to
            throw;
        }
        state.time = runTime.time();
        checkMotion(scene, state);
        stability.afterStep(scene, state, stable, runTime.writeTime() || !runTime.running());
        watch.afterStep(state, runTime);
        output.afterStep(state, *step, deltaT / stable.step, seepage.get());
        if (runTime.writeTime()) {
            step->rebuild(state);
            if (seepage) {
                seepage->update(state, *step, true);
            }
            output.write(state, *step);
        }
    }
    output.summary(state);
    log.end(runTime);
    return 0;
}

} // namespace

int main(int argc, char* argv[])
{
    namespace options = boost::program_options;
    Program program{
        "axiMpmFoam", "[-case DIR] [-dry-run]",
        "Runs a case of the material point method: axisymmetric or plane strain, soil of one or two phases,\n"
        "rigid bodies with frictional contact. Cases are OpenFOAM-style directories."};
    program.options.add_options()("case", options::value<std::string>()->default_value("."),
                                  "the case directory")(
        "dry-run", "read and check everything, print the plan, time a few steps, write nothing");
    program.run = [](const options::variables_map& given, const std::string& commandLine) {
        return run(given["case"].as<std::string>(), given.contains("dry-run"), commandLine);
    };
    return runProgram(std::move(program), argc, argv);
}

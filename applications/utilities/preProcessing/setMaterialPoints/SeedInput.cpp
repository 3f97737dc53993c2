#include "SeedInput.h"

#include "case/FileIO.h"
#include "case/FoamFile.h"
#include "case/RunTime.h"
#include "dictionary/Text.h"
#include "materialPoints/CloudConversion.h"
#include "scene/CaseScene.h"

#include <algorithm>
#include <cmath>

namespace caisson {

namespace {

namespace fs = std::filesystem;

constexpr Keyword gravityKeywords[] = {
    {"dimensions", "list", "-", "", "[0 1 -2 0 0 0 0]"},
    {"value", "vector", "", "", "acceleration of gravity [m/s2]: (0 0 -9.81)"},
};

/// Runs `read`; the problems of an InputError join the others, so that reading goes on with the next file.
template <typename Read>
void collect(InputProblems& problems, const Read& read)
{
    try {
        read();
    } catch (const InputError& error) {
        for (const InputProblem& problem : error.problems()) {
            problems.add(problem.where, problem.message, problem.hint);
        }
    }
}

/// The time directory that controlDict starts from. It must be one that no run has written: points that are
/// filled in afresh do not belong to a later state.
fs::path findStart(const fs::path& caseDirectory, const ControlDict& control, InputProblems& problems)
{
    const SourceLocation where = {"system/controlDict", 0};
    const std::vector<TimeDirectory> times = timeDirectories(caseDirectory);
    const TimeDirectory* start = nullptr;
    for (const TimeDirectory& time : times) {
        const bool wanted =
            control.startFrom == StartFrom::latestTime ||
            (control.startFrom == StartFrom::firstTime && start == nullptr) ||
            (control.startFrom == StartFrom::startTime &&
             std::abs(time.value - control.startTime) <= 1e-6 * std::max(std::abs(control.startTime), 1e-3));
        start = wanted ? &time : start;
    }
    if (start == nullptr) {
        const bool original = fs::is_directory(caseDirectory / "0.orig");
        problems.add(where, "there is no time directory to start from",
                     original ? "copy 0.orig to 0 (restore0Dir in Allrun)"
                              : "the initial and boundary conditions go into the folder 0");
        return {};
    }
    if (fileExists(caseDirectory / start->name / "uniform/time")) {
        problems.add(where,
                     "the time directory " + start->name +
                         " to start from was written by a run, which goes on "
                         "with its own material points",
                     "remove the results (Allclean), or set startFrom startTime; startTime 0;");
    }
    return caseDirectory / start->name;
}

std::array<double, 2> readGravity(const Dictionary& dictionary, const BackgroundMesh& mesh,
                                  InputProblems& problems)
{
    const KeywordReader reader(dictionary, gravityKeywords, "g", problems);
    const std::array<double, 3> g = reader.vector("value");
    if (g[1] != 0 || (g[0] != 0 && mesh.geometry == Geometry::axisymmetric)) {
        reader.problem("value", "gravity must lie along z (in plane strain: in the plane of x and z)",
                       "value (0 0 -9.81);");
    }
    return {g[0], g[2]};
}

/// The points of initialState fromTime, with the materials of their case.
EarlierPoints readEarlier(const fs::path& caseDirectory, const InitialState& state, InputProblems& problems)
{
    const fs::path directory = caseDirectory / state.caseDirectory;
    std::string names;
    std::string name;
    for (const TimeDirectory& time : timeDirectories(directory)) {
        if (fs::is_directory(directory / time.name / "lagrangian/materialPoints")) {
            names += " " + time.name;
            if (std::abs(time.value - state.time) <= 1e-6 * std::max(std::abs(state.time), 1e-3)) {
                name = time.name;
            }
        }
    }
    EarlierPoints earlier;
    if (name.empty()) {
        problems.add(
            state.where,
            text("case '%s' has no material points at the time %g", state.caseDirectory.c_str(), state.time),
            names.empty() ? "run it first" : "it has them at" + names);
        return earlier;
    }
    earlier.materials = readMaterials(
        readDictionary(directory / "constant/materialProperties", directory,
                       (fs::path(state.caseDirectory) / "constant/materialProperties").string()),
        problems);
    earlier.points =
        materialPoints(readCloud(directory / name, "materialPoints"), stateVariableNames(earlier.materials));
    return earlier;
}

} // namespace

std::span<const Keyword> setMaterialPointsKeywords()
{
    static constexpr Keyword table[] = {
        {"regions", "list", "", "",
         "what is filled: ( { type box; ... } ... ); where they overlap the later wins"},
        {"initialState", "dictionary", "", "", "stress of the points at the start"},
        {"porePressure", "dictionary", "-", "", "pore pressure of two-phase soil at the start"},
        {"loadedPoints", "list", "-", "",
         "points that the loads of constant/pointLoads act on: ( { load surcharge; type box; ... } ... )"},
    };
    return table;
}

SeedInput readSeedInput(const fs::path& caseDirectory, const fs::path& dictionaryFile)
{
    SeedInput input;
    InputProblems problems;
    const auto dictionary = [&](const fs::path& file) {
        const fs::path path = file.is_absolute() ? file : caseDirectory / file;
        return readDictionary(path, caseDirectory, file.string());
    };
    collect(problems, [&] {
        input.control = readControlDict(caseDirectory, problems);
        input.startDirectory = findStart(caseDirectory, input.control, problems);
    });
    collect(problems, [&] { input.mesh = buildBackgroundMesh(readPolyMesh(caseDirectory), problems); });
    const bool meshIsThere = !input.mesh.nodeCells.start.empty();
    collect(problems,
            [&] { input.materials = readMaterials(dictionary("constant/materialProperties"), problems); });
    collect(problems, [&] { input.gravity = readGravity(dictionary("constant/g"), input.mesh, problems); });
    if (fileExists(caseDirectory / "constant/bodies")) {
        collect(problems, [&] { input.bodies = readBodies(dictionary("constant/bodies"), problems); });
    }
    if (meshIsThere && fileExists(caseDirectory / "constant/pointLoads")) {
        collect(problems, [&] {
            input.pointLoads =
                readPointLoads(dictionary("constant/pointLoads"), input.mesh.geometry, problems);
        });
    }
    collect(problems, [&] {
        const Dictionary own = dictionary(dictionaryFile);
        const KeywordReader reader(own, setMaterialPointsKeywords(), dictionaryFile.filename().string(),
                                   problems);
        const std::vector<Dictionary> regions = reader.dictionaries("regions");
        if (regions.empty() && reader.has("regions")) {
            reader.problem("regions", "there is no region to fill",
                           "regions ( { type all; material sand; } );");
        }
        if (meshIsThere) { // without a mesh every cellZone and pointsPerCell would look wrong
            MeshMotion motion;
            if (fileExists(caseDirectory / "constant/dynamicMeshDict")) {
                motion = readMeshMotion(dictionary("constant/dynamicMeshDict"), problems);
            }
            input.regions = readSeedRegions(regions, input.mesh, input.materials, problems, motion);
        }
        if (const Dictionary* state = reader.dictionary("initialState")) {
            input.initialState = readInitialState(*state, problems);
            if (input.initialState.type == InitialState::Type::fromTime && problems.empty()) {
                input.earlier = readEarlier(caseDirectory, input.initialState, problems);
            }
        }
        if (reader.has("porePressure")) {
            if (const Dictionary* pore = reader.dictionary("porePressure")) {
                input.porePressure = readInitialPorePressure(*pore, problems);
            }
        }
        if (meshIsThere && reader.has("loadedPoints")) {
            input.loadedSurfaces = readLoadedSurfaces(reader.dictionaries("loadedPoints"), input.mesh,
                                                      input.pointLoads, problems);
        }
    });
    problems.throwIfAny("case " + caseDirectory.string());
    return input;
}

} // namespace caisson

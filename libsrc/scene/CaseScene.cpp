#include "scene/CaseScene.h"

#include "case/FileIO.h"
#include "dictionary/Text.h"
#include "materialPoints/CloudConversion.h"
#include "mesh/CellLocator.h"
#include "scene/SeepageScene.h"
#include "scene/SolutionDict.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace caisson {

namespace {

constexpr Keyword gravityTable[] = {
    {"dimensions", "list", "-", "", "[0 1 -2 0 0 0 0]"},
    {"value", "vector", "", "", "acceleration of gravity [m/s2]: (0 0 -9.81)"},
};

/// Reads a dictionary of the case, or nothing (a problem) where it is missing or broken.
std::unique_ptr<Dictionary> readCaseDictionary(const std::filesystem::path& caseDirectory,
                                               const std::string& name, const std::string& purpose,
                                               InputProblems& problems)
{
    if (!fileExists(caseDirectory / name)) {
        problems.add({name, 0}, "is missing", purpose);
        return nullptr;
    }
    try {
        return std::make_unique<Dictionary>(readDictionary(caseDirectory / name, caseDirectory, name));
    } catch (const InputError& error) {
        for (const InputProblem& problem : error.problems()) {
            problems.add(problem.where, problem.message, problem.hint);
        }
        return nullptr;
    }
}

std::vector<std::string> constraintPatches(const PolyMesh& polyMesh)
{
    std::vector<std::string> names;
    for (const PolyPatch& patch : polyMesh.patches) {
        if (patch.type == "wedge" || patch.type == "empty") {
            names.push_back(patch.name);
        }
    }
    return names;
}

/// Text of the entries of a patch's condition, for the U of every written time.
std::string printEntries(const Dictionary& dictionary)
{
    std::string text = dictionary.print();
    std::ranges::replace(text, '\n', ' ');
    return text;
}

void readConditions(const std::filesystem::path& caseDirectory, const std::filesystem::path& start,
                    const PolyMesh& polyMesh, CaseScene& result, InputProblems& problems)
{
    const std::string name = fileExists(start / "U") ? (start.filename() / "U").string() : "0/U";
    const auto fieldU =
        readCaseDictionary(caseDirectory, name, "the conditions on the solid's velocity per patch", problems);
    if (!fieldU) {
        return;
    }
    const std::vector<std::string> constraints = constraintPatches(polyMesh);
    auto conditions = readPatchVelocities(*fieldU, result.state.mesh, constraints, problems);
    result.scene.conditions = VelocityConditions(result.state.mesh, std::move(conditions));
    const Dictionary* boundaryField = fieldU->findDictionary("boundaryField");
    for (const PolyPatch& patch : polyMesh.patches) {
        const Dictionary* own = boundaryField ? boundaryField->findDictionary(patch.name) : nullptr;
        result.patchEntries.emplace_back(patch.name, own ? printEntries(*own) : "type " + patch.type + ";");
    }
}

/// What the pore liquid needs: its properties in every material, and 0/p.
void readLiquid(const std::filesystem::path& caseDirectory, const std::string& start,
                const PolyMesh& polyMesh, CaseScene& result, InputProblems& problems)
{
    const SourceLocation materialsFile{"constant/materialProperties", 0};
    for (const Material& material : result.scene.materials) {
        if (material.intrinsicPermeability <= 0) {
            problems.add(materialsFile, "'" + material.name + "' has no intrinsicPermeability",
                         "soil with pore water needs it, in m2: 1e-11 is a fine sand");
        }
        if (material.weight != Weight::submerged) {
            problems.add(materialsFile, "'" + material.name + "' has a weight other than submerged",
                         "the pore water bears its own weight: leave the key out");
        }
        if (material.porosity <= 0) {
            problems.add(materialsFile, "'" + material.name + "' has no porosity");
        }
        if (material.liquidDensity != result.scene.materials.front().liquidDensity) {
            problems.add(materialsFile,
                         "'" + material.name + "' has another liquidDensity than '" +
                             result.scene.materials.front().name + "'",
                         "one liquid fills all pores");
        }
    }
    const auto fieldP = readCaseDictionary(caseDirectory, start + "/p",
                                           "the conditions on the pore pressure per patch", problems);
    if (!fieldP) {
        return;
    }
    const double unitWeight =
        -result.scene.gravity[1] *
        (result.scene.materials.empty() ? 0 : result.scene.materials.front().liquidDensity);
    auto pressures =
        readPatchPressures(*fieldP, result.state.mesh, constraintPatches(polyMesh), unitWeight, problems);
    result.scene.liquidBoundary = LiquidBoundary(result.state.mesh, std::move(pressures));
    const Dictionary* boundaryField = fieldP->findDictionary("boundaryField");
    for (const PolyPatch& patch : polyMesh.patches) {
        const Dictionary* own = boundaryField ? boundaryField->findDictionary(patch.name) : nullptr;
        result.pressureEntries.emplace_back(patch.name,
                                            own ? printEntries(*own) : "type " + patch.type + ";");
    }
    if (const Dictionary* surfaces = fieldP->findDictionary("freeSurfaces")) {
        std::vector<std::string> names;
        names.reserve(result.state.bodies.size());
        for (const RigidBody& body : result.state.bodies) {
            names.push_back(body.name);
        }
        result.scene.freeSurfaces = readFreeSurfaces(*surfaces, names, problems);
        const double bottom = *std::ranges::min_element(result.state.mesh.z);
        for (const FreeSurface& surface : result.scene.freeSurfaces) {
            if (surface.level < bottom) {
                problems.add(
                    surfaces->where(),
                    "the water of free surface '" + surface.name +
                        "' has its level at z = " + std::to_string(surface.level) + " m, below the mesh",
                    "the mesh begins at z = " + std::to_string(bottom) + " m: all of it is under water");
            }
        }
        for (const FreeSurface& surface : result.scene.freeSurfaces) {
            for (const RigidBody& body : result.state.bodies) {
                if (surface.region != FreeSurface::Region::all && body.name == surface.body &&
                    body.innerRadius() <= 0) {
                    problems.add(surfaces->where(),
                                 "free surface '" + surface.name + "' is inside or outside of body '" +
                                     body.name + "', which encloses nothing",
                                 "region all;");
                }
            }
        }
    }
}

/// The loads that the points carry must be there, and every load must have points.
void checkLoads(const std::filesystem::path& start, const CaseScene& result, InputProblems& problems)
{
    const std::vector<PointLoad>& loads = result.scene.pointLoads;
    const std::vector<int>& carried = result.state.points.load;
    const std::string again = "run setMaterialPoints again after a change of the loads";
    if (!carried.empty() && *std::ranges::max_element(carried) >= static_cast<int>(loads.size())) {
        problems.add({start.filename().string() + "/lagrangian/materialPoints/load", 0},
                     "points carry load " + std::to_string(*std::ranges::max_element(carried)) +
                         " (from 0), but constant/pointLoads has " + std::to_string(loads.size()),
                     again);
    }
    for (std::size_t l = 0; l < loads.size(); ++l) {
        if (std::ranges::find(carried, static_cast<int>(l)) == carried.end()) {
            problems.add({"constant/pointLoads", 0}, "no material point carries load '" + loads[l].name + "'",
                         "loadedPoints in system/setMaterialPointsDict; " + again);
        }
    }
}

/// At the start at least, the body force must have a value at every point.
void checkBodyForce(const std::filesystem::path& start, const CaseScene& result, InputProblems& problems)
{
    const double time = std::strtod(start.filename().c_str(), nullptr);
    const MaterialPoints& points = result.state.points;
    const PointVector& force = result.scene.bodyForce;
    if (!force.given()) {
        return;
    }
    std::vector<double> r(points.size());
    std::vector<double> z(points.size());
    PointVector::Workspace room = force.workspace();
    force.evaluate(points, 0, static_cast<int>(points.size()), time, 0, r.data(), z.data(), room);
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (!std::isfinite(r[p]) || !std::isfinite(z[p])) {
            problems.add({"constant/bodyForce", 0},
                         text("'%s' is no finite number at t = %g s at the material point with r %g, z %g, "
                              "R %g, Z %g",
                              std::isfinite(r[p]) ? "z" : "r", time, points.r[p], points.z[p],
                              points.initialR[p], points.initialZ[p]),
                         "is something divided by zero there?");
            return;
        }
    }
}

void readPoints(const std::filesystem::path& start, CaseScene& result, InputProblems& problems)
{
    if (!std::filesystem::exists(start / "lagrangian/materialPoints")) {
        problems.add({start.filename().string() + "/lagrangian/materialPoints", 0},
                     "there are no material points", "fill the mesh first: run setMaterialPoints");
        return;
    }
    MaterialPoints& points = result.state.points;
    points = materialPoints(readCloud(start, "materialPoints"), result.stateNames);
    const int materials = static_cast<int>(result.scene.materials.size());
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (points.material[p] < 0 || points.material[p] >= materials) {
            problems.add({start.filename().string() + "/lagrangian/materialPoints/material", 0},
                         "point " + std::to_string(points.id[p]) + " is of material " +
                             std::to_string(points.material[p]) + ", but constant/materialProperties has " +
                             std::to_string(materials),
                         "run setMaterialPoints again after a change of the materials");
            return;
        }
        if (!(points.mass[p] > 0) || !(points.volume[p] > 0)) {
            problems.add({start.filename().string() + "/lagrangian/materialPoints", 0},
                         "point " + std::to_string(points.id[p]) + " has no mass or no volume");
            return;
        }
    }
    checkLoads(start, result, problems);
    // Cells of the file may be of another numbering: what counts is where the points are.
    const CellLocator locator(result.state.mesh);
    for (std::size_t p = 0; p < points.size(); ++p) {
        const int hint = points.cell[p];
        int cell =
            hint >= 0 && hint < result.state.mesh.cells() ? locator.walk(points.r[p], points.z[p], hint) : -1;
        if (cell < 0) {
            cell = locator.find(points.r[p], points.z[p]);
        }
        if (cell < 0) {
            problems.add({start.filename().string() + "/lagrangian/materialPoints/positions", 0},
                         "point " + std::to_string(points.id[p]) + " at r = " + std::to_string(points.r[p]) +
                             " m, z = " + std::to_string(points.z[p]) + " m is outside the mesh");
            return;
        }
        points.cell[p] = cell;
    }
}

} // namespace

std::span<const Keyword> gravityKeywords() { return gravityTable; }

std::vector<std::string> stateVariableNames(const std::vector<Material>& materials)
{
    std::vector<std::string> names;
    for (const Material& material : materials) {
        const auto& own = material.law->stateNames();
        for (std::size_t k = 0; k < own.size(); ++k) {
            if (k >= names.size()) {
                names.push_back(own[k]);
            } else if (names[k].find(own[k]) == std::string::npos) {
                names[k] += "_" + own[k]; // another law's variable in the same place
            }
        }
    }
    return names;
}

std::map<std::string, std::vector<double>> keptNumbers(const State& state)
{
    std::map<std::string, std::vector<double>> kept;
    for (std::size_t b = 0; b < state.bodies.size(); ++b) {
        const BodyReaction& reaction = state.reactions[b];
        std::vector<double>& numbers = kept["body_" + state.bodies[b].name];
        numbers = {state.bodies[b].tipLevel, state.bodies[b].velocity, reaction.work, reaction.duration};
        numbers.insert(numbers.end(), reaction.verticalImpulse.begin(), reaction.verticalImpulse.end());
        numbers.insert(numbers.end(), reaction.radialImpulse.begin(), reaction.radialImpulse.end());
        numbers.push_back(reaction.waterImpulse);
        numbers.push_back(reaction.force);
    }
    if (!state.pumped.empty()) {
        kept["pumped"] = state.pumped;
    }
    kept["massScaling"] = {state.massScaling};
    return kept;
}

CaseScene readCaseScene(const std::filesystem::path& caseDirectory, const std::filesystem::path& start,
                        bool restarted, const std::map<std::string, std::vector<double>>& kept,
                        InputProblems& problems)
{
    CaseScene result;
    State& state = result.state;
    Scene& scene = result.scene;

    if (const auto dictionary = readCaseDictionary(caseDirectory, "constant/materialProperties",
                                                   "one sub-dictionary per material", problems)) {
        scene.materials = readMaterials(*dictionary, problems);
        result.stateNames = stateVariableNames(scene.materials);
        if (scene.materials.empty()) {
            problems.add({"constant/materialProperties", 0}, "no material",
                         "one sub-dictionary per material");
        }
    }
    if (const auto dictionary = readCaseDictionary(caseDirectory, "constant/g",
                                                   "acceleration of gravity: value (0 0 -9.81);", problems)) {
        const KeywordReader reader(*dictionary, gravityTable, "g", problems);
        const auto value = reader.vector("value");
        scene.gravity = {value[0], value[2]};
        if (value[1] != 0) {
            reader.problem("value", "gravity has a component along y, out of the plane of the model");
        }
    }
    if (fileExists(caseDirectory / "constant/bodies")) {
        if (const auto dictionary = readCaseDictionary(caseDirectory, "constant/bodies", "", problems)) {
            state.bodies = readBodies(*dictionary, problems);
        }
    }
    state.reactions.resize(state.bodies.size());

    const PolyMesh polyMesh = readPolyMesh(caseDirectory);
    InputProblems meshProblems;
    state.mesh = buildBackgroundMesh(polyMesh, meshProblems);
    for (const InputProblem& problem : meshProblems.all()) {
        problems.add(problem.where, problem.message, problem.hint);
    }
    if (!meshProblems.empty()) {
        return result;
    }
    scene.referenceZ = state.mesh.z;
    if (state.mesh.geometry == Geometry::axisymmetric && scene.gravity[0] != 0) {
        problems.add({"constant/g", 0}, "gravity has a radial component in an axisymmetric case",
                     "value (0 0 -9.81);");
    }

    if (const auto dictionary = readCaseDictionary(caseDirectory, "system/mpmSolution",
                                                   "the scheme and its switches", problems)) {
        scene.controls = readSolutionControls(*dictionary, state.mesh.corners == 3, problems);
        for (const auto& [key, zone] :
             {std::pair{"femZone", scene.controls.femZone}, std::pair{"boxZone", scene.controls.boxZone}}) {
            if (zone.empty() || state.mesh.cellZones.contains(zone)) {
                continue;
            }
            std::vector<std::string> names;
            names.reserve(state.mesh.cellZones.size());
            for (const auto& [name, cells] : state.mesh.cellZones) {
                names.push_back(name);
            }
            problems.add(dictionary->find(key)->where, "the mesh has no cellZone '" + zone + "'",
                         names.empty() ? "it has none at all: name blocks in blockMeshDict, or use topoSet"
                                       : suggestion(zone, names, "cellZones"));
        }
        result.monitorInterval = readMonitorInterval(*dictionary);
        if (scene.controls.affine && state.mesh.corners == 3) {
            problems.add(
                {"system/mpmSolution", 0},
                "affine (APIC) is unstable on triangles: nothing there takes energy from what points that "
                "move add to short waves",
                "flipShare 1; affine no; or quadrilaterals");
        }
        for (const Material& material : scene.materials) {
            if (scene.controls.affine && material.law->plastic()) {
                problems.add({"system/mpmSolution", 0},
                             "affine (APIC) is unstable where soil yields beside a free surface, and '" +
                                 material.name + "' can",
                             "flipShare 1; affine no;");
            }
        }
    }
    if (fileExists(caseDirectory / "constant/dynamicMeshDict")) {
        if (const auto dictionary =
                readCaseDictionary(caseDirectory, "constant/dynamicMeshDict", "", problems)) {
            scene.motion = readMeshMotion(*dictionary, problems);
            for (std::size_t b = 0; b < state.bodies.size(); ++b) {
                if (scene.motion.moves() && state.bodies[b].name == scene.motion.body()) {
                    scene.movingBody = static_cast<int>(b);
                }
            }
            if (scene.motion.moves() && scene.movingBody < 0) {
                std::vector<std::string> names;
                names.reserve(state.bodies.size());
                for (const RigidBody& body : state.bodies) {
                    names.push_back(body.name);
                }
                problems.add({"constant/dynamicMeshDict", 0},
                             "there is no body '" + scene.motion.body() + "'",
                             suggestion(scene.motion.body(), names, "bodies"));
            }
        }
    }
    if (scene.controls.passedPointsPerCell > 0 && scene.movingBody < 0) {
        problems.add({"system/mpmSolution", 0},
                     "passedPointsPerCell is of a mesh that follows a body, and this one does not",
                     "leave passedPointsPerCell out; or constant/dynamicMeshDict: type followBody; ...");
    }
    for (std::size_t b = 0; b < state.bodies.size(); ++b) {
        if (state.bodies[b].moves() && static_cast<int>(b) != scene.movingBody) {
            problems.add({"constant/bodies", 0},
                         "body '" + state.bodies[b].name + "' moves, but the mesh does not follow it",
                         "constant/dynamicMeshDict: type followBody; body " + state.bodies[b].name + "; ...");
        }
    }
    if (fileExists(caseDirectory / "constant/pointLoads")) {
        if (const auto dictionary = readCaseDictionary(caseDirectory, "constant/pointLoads", "", problems)) {
            scene.pointLoads = readPointLoads(*dictionary, state.mesh.geometry, problems);
        }
    }
    if (fileExists(caseDirectory / "constant/bodyForce")) {
        if (const auto dictionary = readCaseDictionary(caseDirectory, "constant/bodyForce", "", problems)) {
            const std::vector<Keyword> keywords = pointVectorKeywords();
            const KeywordReader reader(*dictionary, keywords, "bodyForce", problems);
            scene.bodyForce = readPointVector(reader, "bodyForce");
        }
        if (scene.controls.phases == 2 ||
            scene.controls.pressureCoupling == SolutionControls::PressureCoupling::quasiSteady) {
            problems.add({"constant/bodyForce", 0},
                         "a body force acts on one-phase soil, but system/mpmSolution asks for pore water",
                         "phases 1, without pressureCoupling quasiSteady; or leave the file out");
        }
    }
    // The mesh must fit the bodies where constant/polyMesh has them.
    for (const RigidBody& body : state.bodies) {
        const BodySurface surface = findBodySurface(body, state.mesh, problems);
        if (surface.nodes.empty() && !body.profile.empty()) {
            problems.add({"constant/bodies", 0}, "body '" + body.name + "' touches no cell of the mesh",
                         "its tip is at z = " + std::to_string(body.tipLevel) +
                             " m: is it outside the mesh?");
        }
    }
    readConditions(caseDirectory, start, polyMesh, result, problems);
    const bool seepage = scene.controls.pressureCoupling == SolutionControls::PressureCoupling::quasiSteady;
    if (scene.controls.phases == 2 || seepage) {
        // A time that a run wrote holds the pressures, but not all of the conditions.
        readLiquid(caseDirectory, restarted ? "0" : start.filename().string(), polyMesh, result, problems);
    }

    const bool projection = scene.controls.pressureCoupling == SolutionControls::PressureCoupling::projection;
    for (const Material& material : scene.materials) {
        if (projection && material.cavitationPressure > std::numeric_limits<double>::lowest()) {
            problems.add({"constant/materialProperties", 0},
                         "'" + material.name + "' has a cavitationPressure, which projection does not know",
                         "leave it out; or pressureCoupling explicit");
        }
    }
    for (const FreeSurface& surface : scene.freeSurfaces) {
        if (seepage && surface.givesFlow()) {
            problems.add({"0/p", 0},
                         "free surface '" + surface.name + "' has a flow, but seepage is quasi-steady",
                         "give its pressure or suction; or phases 2");
        }
        if (projection && surface.givesFlow()) {
            problems.add({"0/p", 0},
                         "free surface '" + surface.name +
                             "' has a flow, which projection does not keep: its pressures are those of the "
                             "step before",
                         "give its pressure or suction; or pressureCoupling explicit");
        }
    }

    if (restarted) {
        for (std::size_t b = 0; b < state.bodies.size(); ++b) {
            const auto found = kept.find("body_" + state.bodies[b].name);
            if (found == kept.end() || found->second.size() != 6 + 2 * surfaceParts) {
                problems.add(
                    {start.filename().string() + "/uniform/time", 0},
                    "nothing is kept of body '" + state.bodies[b].name + "'",
                    "the time was written by another version, or the body is new: start from time 0");
                continue;
            }
            BodyReaction& reaction = state.reactions[b];
            state.bodies[b].tipLevel = found->second[0];
            state.bodies[b].velocity = found->second[1];
            reaction.work = found->second[2];
            reaction.duration = found->second[3];
            std::copy_n(found->second.begin() + 4, surfaceParts, reaction.verticalImpulse.begin());
            std::copy_n(found->second.begin() + 4 + surfaceParts, surfaceParts,
                        reaction.radialImpulse.begin());
            reaction.waterImpulse = found->second[4 + 2 * surfaceParts];
            reaction.force = found->second.back();
        }
        if (const auto pumped = kept.find("pumped");
            pumped != kept.end() && pumped->second.size() == scene.freeSurfaces.size()) {
            state.pumped = pumped->second;
        }
        if (const auto factor = kept.find("massScaling");
            factor != kept.end() && factor->second.size() == 1) {
            state.massScaling = factor->second[0];
        }
        if (scene.movingBody >= 0) {
            const RigidBody& body = state.bodies[scene.movingBody];
            scene.motion.place(state.mesh, scene.referenceZ, body.tipLevel - body.initialTipLevel);
        }
        const NamedField filled = readField(start / "filled", state.mesh.cells());
        state.filled.resize(state.mesh.cells());
        std::ranges::transform(filled.values, state.filled.begin(), [](double value) { return value > 0.5; });
        if (fileExists(start / "dilatationRate")) {
            state.cellDivergence = readField(start / "dilatationRate", state.mesh.cells()).values;
        }
    }
    readPoints(start, result, problems);
    checkBodyForce(start, result, problems);
    const SourceLocation points{start.filename().string() + "/lagrangian/materialPoints", 0};
    if (scene.controls.phases == 2 && !state.points.twoPhase()) {
        problems.add(points, "the points have no pore pressure, but system/mpmSolution asks for phases 2",
                     "porePressure { type hydrostatic; level 0; } in system/setMaterialPointsDict");
    } else if (scene.controls.phases == 1 && state.points.twoPhase()) {
        problems.add(points, "the points have a pore pressure, but system/mpmSolution has phases 1",
                     "phases 2, or no porePressure in system/setMaterialPointsDict");
    }
    return result;
}

std::vector<double> readSeepagePressure(const std::filesystem::path& caseDirectory, const std::string& start,
                                        const BackgroundMesh& mesh, const MaterialPoints& points,
                                        const std::array<double, 2>& gravity)
{
    CaseScene result;
    InputProblems problems;
    result.scene.materials =
        readMaterials(readDictionary(caseDirectory / "constant/materialProperties", caseDirectory), problems);
    if (fileExists(caseDirectory / "constant/bodies")) {
        result.state.bodies =
            readBodies(readDictionary(caseDirectory / "constant/bodies", caseDirectory), problems);
    }
    result.scene.gravity = gravity;
    result.state.mesh = mesh;
    result.state.points = points;
    readLiquid(caseDirectory, start, readPolyMesh(caseDirectory), result, problems);
    problems.throwIfAny("case " + caseDirectory.string());
    return steadyPorePressure(result.scene, result.state);
}

} // namespace caisson

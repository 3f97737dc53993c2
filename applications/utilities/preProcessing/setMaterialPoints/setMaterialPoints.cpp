// setMaterialPoints: fills the mesh with material points and sets their initial stress.
//
// Usage: setMaterialPoints [-case <directory>] [-dict <file>] [-dry-run]
//
// Reads system/setMaterialPointsDict, constant/polyMesh, constant/materialProperties, constant/g and, where
// it is there, constant/bodies: cells within a body stay empty. Writes lagrangian/materialPoints in the time
// directory that system/controlDict starts from.

#include "SeedInput.h"
#include "case/FoamFile.h"
#include "case/Program.h"
#include "dictionary/Text.h"
#include "materialPoints/CloudConversion.h"
#include "scene/CaseScene.h"

#include <algorithm>
#include <iostream>
#include <numbers>

namespace {

using namespace caisson;
namespace fs = std::filesystem;

/// "12 points, volume 3 m3, mass 4 kg" of the whole body of revolution, or per metre of thickness.
std::string amounts(const BackgroundMesh& mesh, std::size_t points, double volume, double mass)
{
    const bool axisymmetric = mesh.geometry == Geometry::axisymmetric;
    const double whole = axisymmetric ? 2 * std::numbers::pi : 1;
    return text("%zu points, volume %.9g %s, mass %.9g %s", points, whole * volume,
                axisymmetric ? "m3" : "m3/m", whole * mass, axisymmetric ? "kg" : "kg/m");
}

void printRegions(const SeedInput& input, const SeededPoints& seeded)
{
    const double whole = input.mesh.geometry == Geometry::axisymmetric ? 2 * std::numbers::pi : 1;
    SeededRegion total;
    for (std::size_t i = 0; i < seeded.regions.size(); ++i) {
        const SeedRegion& region = input.regions[i];
        const SeededRegion& amount = seeded.regions[i];
        std::cout << "Region " << i + 1 << " (" << region.type << ", material "
                  << input.materials[region.material].name
                  << "): " << amounts(input.mesh, amount.points, amount.volume, amount.mass)
                  << text("\n    exact volume %.9g, error %.3g %%", whole * amount.exactVolume,
                          100 * (amount.coveredVolume / amount.exactVolume - 1));
        if (amount.volume < amount.coveredVolume * (1 - 1e-9)) {
            std::cout << text("; later regions take %.9g of it",
                              whole * (amount.coveredVolume - amount.volume));
        }
        if (amount.emptyCells > 0) {
            std::cout << text(
                "\n    %zu cells that it reaches into hold no point: lay its boundary on lines of "
                "the mesh, or raise pointsPerCell",
                amount.emptyCells);
        }
        std::cout << '\n';
        total.points += amount.points;
        total.volume += amount.volume;
        total.mass += amount.mass;
    }
    std::cout << "Total: " << amounts(input.mesh, total.points, total.volume, total.mass) << '\n';
}

void printStress(const MaterialPoints& points)
{
    static constexpr const char* names[] = {"rr", "zz", "tt", "rz"};
    std::cout << "Initial effective stress [Pa]:";
    for (std::size_t k = 0; k < points.stress.size(); ++k) {
        const auto [low, high] = std::ranges::minmax(points.stress[k]);
        std::cout << text("%s %s %.6g to %.6g", k == 0 ? "" : ",", names[k], low, high);
    }
    std::cout << '\n';
    if (points.twoPhase()) {
        const auto [low, high] = std::ranges::minmax(points.porePressure);
        std::cout << text("Initial pore pressure [Pa]: %.6g to %.6g\n", low, high);
    }
}

void printLoads(const SeedInput& input, const std::vector<LoadedPoints>& loaded)
{
    const bool axisymmetric = input.mesh.geometry == Geometry::axisymmetric;
    for (std::size_t i = 0; i < loaded.size(); ++i) {
        std::cout << text("Load %s: %zu points, area %.9g %s\n",
                          input.pointLoads[input.loadedSurfaces[i].load].name.c_str(), loaded[i].points,
                          (axisymmetric ? 2 * std::numbers::pi : 1) * loaded[i].area,
                          axisymmetric ? "m2" : "m2/m");
    }
}

void run(const fs::path& caseDirectory, const fs::path& dictionaryFile, bool dryRun)
{
    const SeedInput input = readSeedInput(caseDirectory, dictionaryFile);
    const BackgroundMesh& mesh = input.mesh;
    std::cout << "Mesh: " << mesh.cells() << (mesh.corners == 4 ? " quadrilaterals, " : " triangles, ")
              << mesh.nodes() << " nodes, "
              << (mesh.geometry == Geometry::axisymmetric ? "axisymmetric" : "plane strain") << '\n';

    InputProblems problems;
    const auto insideBody = [&](double r, double z) {
        return std::ranges::any_of(input.bodies, [&](const RigidBody& body) { return body.contains(r, z); });
    };
    SeededPoints seeded = seedPoints(mesh, input.regions, input.materials, insideBody, problems);
    setInitialStress(seeded, input.materials, input.initialState, input.gravity, problems);
    if (input.earlier) {
        takeEarlierState(seeded.points, input.materials, mesh, *input.earlier, input.initialState.where,
                         problems);
    }
    if (input.porePressure) {
        setInitialPorePressure(seeded, input.materials, *input.porePressure, input.gravity);
    }
    problems.throwIfAny("case " + caseDirectory.string());
    if (input.porePressure && input.porePressure->seepage) {
        seeded.points.porePressure = readSeepagePressure(
            caseDirectory, input.startDirectory.filename().string(), mesh, seeded.points, input.gravity);
    }
    const std::vector<LoadedPoints> loaded = loadPoints(seeded.points, mesh, input.loadedSurfaces, problems);
    problems.throwIfAny("case " + caseDirectory.string());
    printRegions(input, seeded);
    printStress(seeded.points);
    printLoads(input, loaded);

    const fs::path folder = input.startDirectory / "lagrangian/materialPoints";
    if (dryRun) {
        std::cout << "Dry run: nothing is written\n";
    } else {
        fs::remove_all(folder); // fields of earlier points, of other laws perhaps
        writeCloud(input.startDirectory, cloud(seeded.points, stateVariableNames(input.materials)),
                   input.control.writeStyle);
        std::cout << "Written: " << fs::relative(folder, caseDirectory).string() << '\n';
    }
    std::cout << "\nEnd\n";
}

} // namespace

int main(int argc, char* argv[])
{
    namespace options = boost::program_options;
    Program program{"setMaterialPoints", "[-case DIR] [-dict FILE] [-dry-run]",
                    "Fills the mesh with material points and sets their initial stress."};
    program.options.add_options()("case", options::value<std::string>()->default_value("."),
                                  "the case directory")(
        "dict", options::value<std::string>()->default_value("system/setMaterialPointsDict"),
        "dictionary, relative to the case")("dry-run", "read, check and report, but write nothing");
    program.run = [](const options::variables_map& given, const std::string&) {
        run(given["case"].as<std::string>(), given["dict"].as<std::string>(), given.contains("dry-run"));
        return 0;
    };
    return runProgram(std::move(program), argc, argv);
}

// coarsenMesh: merges the rows and columns of a mesh of rectangles where they are finer than they need be.
//
// Usage: coarsenMesh [-case <directory>] [-dict <file>] [-dry-run]
//
// Reads system/coarsenMeshDict, constant/polyMesh as blockMesh makes it and, where it is there,
// constant/dynamicMeshDict: rows do not merge across the levels of the motion. Writes constant/polyMesh.

#include "mesh/CoarsenMesh.h"

#include "case/ControlDict.h"
#include "case/FileIO.h"
#include "case/Program.h"
#include "dictionary/Text.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace {

using namespace caisson;
namespace fs = std::filesystem;

/// Greatest ratio of the longer to the shorter of the two lines between the middles of opposite sides.
double greatestAspectRatio(const BackgroundMesh& mesh)
{
    double greatest = 1;
    for (int cell = 0; cell < mesh.cells(); ++cell) {
        const auto middleLine = [&](int k) {
            const int a = mesh.node(cell, k), b = mesh.node(cell, k + 1), c = mesh.node(cell, k + 2),
                      d = mesh.node(cell, (k + 3) % 4);
            return std::hypot(mesh.r[c] + mesh.r[b] - mesh.r[a] - mesh.r[d],
                              mesh.z[c] + mesh.z[b] - mesh.z[a] - mesh.z[d]);
        };
        const double ratio = middleLine(0) / middleLine(1);
        greatest = std::max({greatest, ratio, 1 / ratio});
    }
    return greatest;
}

void print(const char* when, const BackgroundMesh& mesh)
{
    std::cout << text("%s: %d cells, %d nodes, aspect ratio up to %.1f\n", when, mesh.cells(), mesh.nodes(),
                      greatestAspectRatio(mesh));
}

void run(const fs::path& caseDirectory, const fs::path& dictionaryFile, bool dryRun)
{
    const std::string subject = "case " + caseDirectory.string();
    InputProblems problems;
    const auto dictionary = [&](const fs::path& file) {
        return readDictionary(file.is_absolute() ? file : caseDirectory / file, caseDirectory, file.string());
    };
    const ControlDict control = readControlDict(caseDirectory, problems);
    MeshMotion motion;
    if (fileExists(caseDirectory / "constant/dynamicMeshDict")) {
        motion = readMeshMotion(dictionary("constant/dynamicMeshDict"), problems);
    }
    const Coarsening coarsening = readCoarsening(dictionary(dictionaryFile), std::move(motion), problems);
    const PolyMesh fine = readPolyMesh(caseDirectory);
    const BackgroundMesh before = buildBackgroundMesh(fine, problems);
    problems.throwIfAny(subject);
    const PolyMesh coarse = coarsened(fine, coarsening, problems);
    problems.throwIfAny(subject);
    const BackgroundMesh after = buildBackgroundMesh(coarse, problems);
    problems.throwIfAny(subject);
    print("Before", before);
    print("After", after);
    if (dryRun) {
        std::cout << "Dry run: nothing is written\n";
    } else {
        writePolyMesh(caseDirectory, coarse, control.writeStyle);
        std::cout << "Written: constant/polyMesh\n";
    }
    std::cout << "\nEnd\n";
}

} // namespace

int main(int argc, char* argv[])
{
    namespace options = boost::program_options;
    Program program{"coarsenMesh", "[-case DIR] [-dict FILE] [-dry-run]",
                    "Merges the rows and columns of a mesh of rectangles where they are finer than they need "
                    "be."};
    program.options.add_options()("case", options::value<std::string>()->default_value("."),
                                  "the case directory")(
        "dict", options::value<std::string>()->default_value("system/coarsenMeshDict"),
        "dictionary, relative to the case")("dry-run", "read, check and report, but write nothing");
    program.run = [](const options::variables_map& given, const std::string&) {
        run(given["case"].as<std::string>(), given["dict"].as<std::string>(), given.contains("dry-run"));
        return 0;
    };
    return runProgram(std::move(program), argc, argv);
}

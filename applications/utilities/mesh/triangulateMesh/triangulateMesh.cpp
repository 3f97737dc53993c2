// triangulateMesh: makes two triangles of each quadrilateral of a mesh.
//
// Usage: triangulateMesh [-case <directory>] [-dry-run]
//
// Reads constant/polyMesh, as blockMesh makes it, and writes it anew. Diagonals alternate from cell to cell.

#include "mesh/TriangulateMesh.h"

#include "case/ControlDict.h"
#include "case/Program.h"
#include "dictionary/Text.h"

#include <iostream>

namespace {

using namespace caisson;
namespace fs = std::filesystem;

void run(const fs::path& caseDirectory, bool dryRun)
{
    const std::string subject = "case " + caseDirectory.string();
    InputProblems problems;
    const ControlDict control = readControlDict(caseDirectory, problems);
    const PolyMesh before = readPolyMesh(caseDirectory);
    const PolyMesh after = triangulated(before, problems);
    problems.throwIfAny(subject);
    const BackgroundMesh mesh = buildBackgroundMesh(after, problems);
    problems.throwIfAny(subject);
    std::cout << text("%d quadrilaterals became %d triangles, %d nodes\n", mesh.cells() / 2, mesh.cells(),
                      mesh.nodes());
    if (dryRun) {
        std::cout << "Dry run: nothing is written\n";
    } else {
        writePolyMesh(caseDirectory, after, control.writeStyle);
        std::cout << "Written: constant/polyMesh\n";
    }
    std::cout << "\nEnd\n";
}

} // namespace

int main(int argc, char* argv[])
{
    namespace options = boost::program_options;
    Program program{"triangulateMesh", "[-case DIR] [-dry-run]",
                    "Makes two triangles of each quadrilateral of a mesh."};
    program.options.add_options()("case", options::value<std::string>()->default_value("."),
                                  "the case directory")("dry-run",
                                                        "read, check and report, but write nothing");
    program.run = [](const options::variables_map& given, const std::string&) {
        run(given["case"].as<std::string>(), given.contains("dry-run"));
        return 0;
    };
    return runProgram(std::move(program), argc, argv);
}

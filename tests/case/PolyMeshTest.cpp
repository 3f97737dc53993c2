#include "case/PolyMesh.h"

#include "TemporaryCase.h"
#include "case/FileIO.h"
#include "case/FoamFile.h"
#include "dictionary/InputProblems.h"

#include <gtest/gtest.h>

using namespace caisson;
namespace fs = std::filesystem;

namespace {

const fs::path wedge = fs::path(CAISSON_SOURCE_DIR) / "tests/case/data/wedge";

/// The first problem of reading the mesh of a case, "file:line: message | hint".
std::string problemOf(const fs::path& caseDirectory, const fs::path& pointsFrom = {})
{
    try {
        readPolyMesh(caseDirectory, pointsFrom);
    } catch (const InputError& error) {
        const InputProblem& problem = error.problems().at(0);
        return problem.where.file + ":" + std::to_string(problem.where.line) + ": " + problem.message +
               " | " + problem.hint;
    }
    return "no problem";
}

void copyMesh(const TemporaryCase& to, const std::string& format)
{
    fs::copy(wedge / format, to.path(), fs::copy_options::recursive);
}

void replaceIn(const TemporaryCase& testCase, const std::string& file, const std::string& from,
               const std::string& by)
{
    std::string text = testCase.read(file);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    testCase.write(file, text.replace(at, from.size(), by));
}

void expectSame(const PolyMesh& a, const PolyMesh& b)
{
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.faces, b.faces);
    EXPECT_EQ(a.owner, b.owner);
    EXPECT_EQ(a.neighbour, b.neighbour);
    ASSERT_EQ(a.patches.size(), b.patches.size());
    ASSERT_EQ(a.cellZones.size(), b.cellZones.size());
}

} // namespace

TEST(PolyMesh, asciiMeshOfBlockMeshIsReadCompletely)
{
    const PolyMesh mesh = readPolyMesh(wedge / "ascii");
    EXPECT_EQ(mesh.directory, "constant/polyMesh");
    ASSERT_EQ(mesh.points.size(), 27U);
    EXPECT_EQ(mesh.points[3], (std::array<double, 3>{1, 0.050000000000000010, 0}));
    ASSERT_EQ(mesh.faces.size(), 36U);
    EXPECT_EQ(mesh.faces[0], (std::vector<int>{1, 3, 8, 6}));
    EXPECT_EQ(mesh.faces[1], (std::vector<int>{5, 6, 8}));
    EXPECT_EQ(mesh.owner.size(), 36U);
    EXPECT_EQ(mesh.neighbour, (std::vector<int>{1, 2, 3, 4, 3, 6, 5, 6, 7, 7}));
    ASSERT_EQ(mesh.patches.size(), 6U);
    EXPECT_EQ(mesh.patches[0].name, "axis");
    EXPECT_EQ(mesh.patches[0].faces, 0);
    EXPECT_EQ(mesh.patches[3].name, "outer");
    EXPECT_EQ(mesh.patches[3].type, "wall");
    EXPECT_EQ(mesh.patches[3].startFace, 26);
    EXPECT_EQ(mesh.patches[3].faces, 2);
    ASSERT_EQ(mesh.cellZones.size(), 2U);
    EXPECT_EQ(mesh.cellZones[1].name, "water");
    EXPECT_EQ(mesh.cellZones[1].cells, (std::vector<int>{4, 5, 6, 7}));
}

TEST(PolyMesh, binaryMeshOfBlockMeshIsTheSameMesh)
{
    const PolyMesh ascii = readPolyMesh(wedge / "ascii");
    const PolyMesh binary = readPolyMesh(wedge / "binary");
    expectSame(ascii, binary);
    EXPECT_EQ(ascii.cellZones[1].cells, binary.cellZones[1].cells);
    EXPECT_EQ(ascii.patches[5].startFace, binary.patches[5].startFace);
}

TEST(PolyMesh, gzippedFilesStandInForMissingPlainOnes)
{
    for (const char* format : {"ascii", "binary"}) {
        const TemporaryCase packed;
        copyMesh(packed, format);
        const fs::path folder = packed.path() / "constant/polyMesh";
        for (const char* file : {"points", "faces", "owner", "neighbour", "boundary", "cellZones"}) {
            writeFileAtomically(folder / file, readFile(folder / file, file), true);
            ASSERT_FALSE(fs::exists(folder / file)) << "the plain file must give way to the packed one";
        }
        expectSame(readPolyMesh(packed.path()), readPolyMesh(wedge / format));
    }
}

TEST(PolyMesh, labelsOf64BitsAndScalarsOf32BitsAreRead)
{
    const TemporaryCase testCase;
    copyMesh(testCase, "binary");
    const PolyMesh mesh = readPolyMesh(wedge / "binary");
    const auto rewrite = [&](const std::string& file, const std::string& list) {
        std::string text = testCase.read(file);
        text.resize(text.find("\n\n", text.find("// * *")));
        text.replace(text.find("label=32;scalar=64"), 18, "label=64;scalar=32");
        testCase.write(file, text + "\n\n" + list);
    };
    const auto raw = [](auto value) {
        return std::string(reinterpret_cast<const char*>(&value), sizeof(value));
    };
    std::string owners = "36\n(";
    for (const int owner : mesh.owner) {
        owners += raw(static_cast<std::int64_t>(owner));
    }
    rewrite("constant/polyMesh/owner", owners + ")");
    std::string points = "27\n(";
    for (const auto& point : mesh.points) {
        for (const double x : point) {
            points += raw(static_cast<float>(x));
        }
    }
    rewrite("constant/polyMesh/points", points + ")");

    const PolyMesh read = readPolyMesh(testCase.path());
    EXPECT_EQ(read.owner, mesh.owner);
    EXPECT_EQ(read.points[3][1], static_cast<double>(static_cast<float>(mesh.points[3][1])));
}

TEST(PolyMesh, pointsOfATimeDirectoryReplaceThoseOfConstant)
{
    const TemporaryCase testCase;
    copyMesh(testCase, "ascii");
    PolyMesh mesh = readPolyMesh(testCase.path());
    mesh.points[7] = {0.1, -0.2, 1.0 / 3.0};
    writePoints(testCase.path() / "0.5", mesh.points, {});
    EXPECT_EQ(readPolyMesh(testCase.path(), testCase.path() / "0.5").points, mesh.points);

    mesh.points.pop_back();
    writePoints(testCase.path() / "0.5", mesh.points, {});
    EXPECT_EQ(problemOf(testCase.path(), testCase.path() / "0.5"),
              "0.5/polyMesh/points:0: 26 points for a mesh of 27 | ");
}

TEST(PolyMesh, missingMeshNamesTheFileAndWhatToRun)
{
    const TemporaryCase empty;
    EXPECT_EQ(problemOf(empty.path()),
              "constant/polyMesh/points:0: file is missing | "
              "run blockMesh (or gmshToFoam, extrudeMesh ...) in the case to make the mesh");
    copyMesh(empty, "ascii");
    fs::remove(empty.path() / "constant/polyMesh/owner");
    EXPECT_EQ(problemOf(empty.path()).substr(0, 40), "constant/polyMesh/owner:0: file is missi");
}

TEST(PolyMesh, brokenFilesAreNamedWithTheLine)
{
    const auto problemAfter = [](const std::string& file, const std::string& from, const std::string& by) {
        const TemporaryCase testCase;
        copyMesh(testCase, "ascii");
        replaceIn(testCase, "constant/polyMesh/" + file, from, by);
        return problemOf(testCase.path());
    };
    EXPECT_EQ(problemAfter("points", "\n27\n", "\n28\n"),
              "constant/polyMesh/points:48: list of 27 items is announced as 28 | ");
    EXPECT_EQ(problemAfter("points", "(1 -0.05", "(1 x-0.05"),
              "constant/polyMesh/points:22: expected a number, got 'x-0.0500000000000000' | ");
    const auto expectMessage = [&](const char* file, const char* from, const char* by, const char* message) {
        const std::string problem = problemAfter(file, from, by);
        EXPECT_NE(problem.find(message), std::string::npos)
            << "expected: " << message << "\ngot: " << problem;
    };
    expectMessage("faces", "4(1 3 8 6)", "4(1 3 88 6)",
                  "a face refers to a point outside the 27 points of the mesh");
    expectMessage("boundary", "startFace       32", "startFace       33",
                  "patch 'top' needs a type, and nFaces");
    expectMessage("cellZones", "4(4 5 6 7)", "4(4 5 6 8)",
                  "cellZone 'water' names cell 8 of a mesh of 8 cells");
    expectMessage("owner", "36\n(\n0\n", "35\n(\n", "35 owners for 36 faces");
}

TEST(PolyMesh, truncatedBinaryFileIsAnError)
{
    const TemporaryCase testCase;
    copyMesh(testCase, "binary");
    const std::string file = "constant/polyMesh/points";
    testCase.write(file, testCase.read(file).substr(0, 1200));
    EXPECT_NE(problemOf(testCase.path()).find("binary data end too early: 648 bytes expected"),
              std::string::npos)
        << problemOf(testCase.path());
}

TEST(PolyMesh, aWrittenMeshIsReadBackAsItWas)
{
    const PolyMesh mesh = readPolyMesh(wedge / "binary");
    for (const WriteStyle style : {WriteStyle{.binary = true}, WriteStyle{.binary = false},
                                   WriteStyle{.binary = true, .compressed = true}}) {
        const TemporaryCase testCase;
        testCase.write("constant/polyMesh/faceZones", "of another mesh");
        writePolyMesh(testCase.path(), mesh, style);
        const PolyMesh again = readPolyMesh(testCase.path());
        expectSame(again, mesh);
        for (std::size_t i = 0; i < mesh.patches.size(); ++i) {
            EXPECT_EQ(again.patches[i].name, mesh.patches[i].name);
            EXPECT_EQ(again.patches[i].type, mesh.patches[i].type);
            EXPECT_EQ(again.patches[i].startFace, mesh.patches[i].startFace);
            EXPECT_EQ(again.patches[i].faces, mesh.patches[i].faces);
        }
        for (std::size_t i = 0; i < mesh.cellZones.size(); ++i) {
            EXPECT_EQ(again.cellZones[i].name, mesh.cellZones[i].name);
            EXPECT_EQ(again.cellZones[i].cells, mesh.cellZones[i].cells);
        }
        EXPECT_FALSE(fs::exists(testCase.path() / "constant/polyMesh/faceZones"));
    }
}

#include "case/FoamFile.h"

#include "TemporaryCase.h"
#include "case/FileIO.h"
#include "dictionary/InputProblems.h"

#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>
#include <random>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace caisson;
namespace fs = std::filesystem;

namespace {

/// Numbers that ascii easily gets wrong, then random bit patterns (finite).
std::vector<double> awkwardNumbers(std::size_t count)
{
    std::vector<double> values{0.0,
                               -0.0,
                               0.1,
                               1.0 / 3.0,
                               -2.0 / 3.0,
                               1e22,
                               5e-324,
                               2.2250738585072014e-308,
                               std::numeric_limits<double>::max(),
                               -std::numeric_limits<double>::epsilon(),
                               123456789.123456789};
    std::mt19937_64 random(12345);
    while (values.size() < count) {
        const std::uint64_t bits = random();
        double value = 0;
        std::memcpy(&value, &bits, sizeof(value));
        if (std::isfinite(value)) {
            values.push_back(value);
        }
    }
    values.resize(count);
    return values;
}

template <class T>
void expectSameBits(const std::vector<T>& expected, const std::vector<T>& got, const std::string& what)
{
    ASSERT_EQ(expected.size(), got.size()) << what;
    EXPECT_TRUE(expected.empty() ||
                std::memcmp(expected.data(), got.data(), expected.size() * sizeof(T)) == 0)
        << what << " differs in its bits";
}

Cloud sampleCloud(std::size_t points)
{
    Cloud cloud;
    const std::vector<double> numbers = awkwardNumbers(3 * points);
    for (std::size_t i = 0; i < points; ++i) {
        cloud.positions.push_back({numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]});
        cloud.cells.push_back(static_cast<int>(i) - 1);
    }
    std::vector<double> labels(points);
    for (std::size_t i = 0; i < points; ++i) {
        labels[i] = i % 2 == 0 ? -2147483648.0 : 2147483647.0;
    }
    cloud.fields = {{"effectiveStress", FieldKind::symmTensor, awkwardNumbers(6 * points)},
                    {"id", FieldKind::label, labels},
                    {"porosity", FieldKind::scalar, awkwardNumbers(points)},
                    {"velocity", FieldKind::vector, awkwardNumbers(3 * points)}};
    return cloud;
}

std::string problemOf(auto&& action)
{
    try {
        action();
    } catch (const InputError& error) {
        const InputProblem& problem = error.problems().at(0);
        return problem.where.file + ":" + std::to_string(problem.where.line) + ": " + problem.message +
               " | " + problem.hint;
    }
    return "no problem";
}

const std::vector<WriteStyle> exactStyles{
    {true, 17, false}, {true, 6, true}, {false, 17, false}, {false, 17, true}};

} // namespace

TEST(FoamFile, cloudComesBackWithEveryBit)
{
    for (const WriteStyle& style : exactStyles) {
        for (const std::size_t points : {0U, 1U, 40U}) {
            const TemporaryCase testCase;
            const Cloud cloud = sampleCloud(points);
            writeCloud(testCase.path() / "0.5", cloud, style);
            const Cloud read = readCloud(testCase.path() / "0.5", cloud.name);
            const std::string what =
                std::string(style.binary ? "binary" : "ascii") + (style.compressed ? ".gz" : "");
            expectSameBits(cloud.positions, read.positions, what + " positions");
            EXPECT_EQ(cloud.cells, read.cells);
            ASSERT_EQ(cloud.fields.size(), read.fields.size());
            for (std::size_t i = 0; i < cloud.fields.size(); ++i) {
                EXPECT_EQ(cloud.fields[i].name, read.fields[i].name);
                EXPECT_EQ(cloud.fields[i].kind, read.fields[i].kind);
                expectSameBits(cloud.fields[i].values, read.fields[i].values,
                               what + " " + cloud.fields[i].name);
            }
        }
    }
}

TEST(FoamFile, fieldsComeBackWithEveryBit)
{
    const std::vector<std::pair<std::string, std::string>> patches{
        {"top", "type fixedValue;\n        value uniform 0;"}, {"axis", "type empty;"}};
    for (const WriteStyle& style : exactStyles) {
        for (const bool atPoints : {true, false}) {
            for (const FieldKind kind : {FieldKind::scalar, FieldKind::vector, FieldKind::symmTensor}) {
                const TemporaryCase testCase;
                const NamedField field{"x", kind,
                                       awkwardNumbers(static_cast<std::size_t>(30 * components(kind)))};
                writeField(testCase.path() / "2", field, atPoints, "[0 1 -1 0 0 0 0]", patches, style);
                const NamedField read = readField(testCase.path() / "2/x", 30);
                EXPECT_EQ(read.kind, kind);
                EXPECT_EQ(read.name, "x");
                expectSameBits(field.values, read.values, "field");
            }
        }
    }
}

TEST(FoamFile, headerTellsClassPlaceAndFormat)
{
    const TemporaryCase testCase;
    writeField(testCase.path() / ".0.25.writing", {"p", FieldKind::scalar, {1, 2}}, true, "[1 -1 -2 0 0 0 0]",
               {{"top", "type zeroGradient;"}}, {.binary = true});
    const std::string text = testCase.read(".0.25.writing/p");
    for (const char* line :
         {"    format      binary;", "    class       pointScalarField;",
          "    arch        \"LSB;label=32;scalar=64\";", "    location    \"0.25\";", "    object      p;",
          "dimensions      [1 -1 -2 0 0 0 0];", "internalField   nonuniform List<scalar> \n2\n(",
          "        type zeroGradient;"}) {
        EXPECT_NE(text.find(line), std::string::npos) << line << "\nis not in\n" << text;
    }
}

TEST(FoamFile, uniformFieldIsSpreadOverTheMesh)
{
    const TemporaryCase testCase;
    const std::string head = "FoamFile { format ascii; class pointVectorField; object U; }\n";
    testCase.write("0/U", head +
                              "dimensions [0 1 -1 0 0 0 0]; // velocity\ninternalField uniform (1 -2 3e-1);\n"
                              "boundaryField { top { type zeroGradient; } }\n");
    const NamedField field = readField(testCase.path() / "0/U", 2);
    EXPECT_EQ(field.kind, FieldKind::vector);
    EXPECT_EQ(field.values, (std::vector<double>{1, -2, 0.3, 1, -2, 0.3}));
}

TEST(FoamFile, macrosMayStandInAUniformField)
{
    const TemporaryCase testCase;
    testCase.write("0/p", "FoamFile { format ascii; class pointScalarField; object p; }\n"
                          "pressure 12.5;\ninternalField uniform $pressure;\n"
                          "boundaryField { top { type zeroGradient; } }\n");
    EXPECT_EQ(readField(testCase.path() / "0/p", 3).values, (std::vector<double>(3, 12.5)));
}

TEST(FoamFile, fieldOfWrongSizeOrClassIsAnError)
{
    const TemporaryCase testCase;
    writeField(testCase.path() / "1", {"p", FieldKind::scalar, {1, 2, 3}}, true, "[]", {}, {.binary = false});
    EXPECT_EQ(problemOf([&] { readField(testCase.path() / "1/p", 4); }),
              "1/p:22: internalField has 3 values, the mesh needs 4 | ");
    testCase.write("1/q", "FoamFile { class surfaceScalarField; }\ninternalField uniform 0;\n");
    EXPECT_EQ(problemOf([&] { readField(testCase.path() / "1/q", 4); }).substr(0, 55),
              "1/q:1: class 'surfaceScalarField' is not a field | vali");
    testCase.write("1/u", "FoamFile { class pointVectorField; }\ninternalField uniform 0;\n");
    EXPECT_EQ(problemOf([&] { readField(testCase.path() / "1/u", 4); }),
              "1/u:2: internalField: 3 numbers expected, got 1 | ");
}

TEST(FoamFile, brokenCloudsAreNamed)
{
    const TemporaryCase testCase;
    const auto read = [&] { readCloud(testCase.path() / "1", "materialPoints"); };
    EXPECT_EQ(problemOf(read), "1/lagrangian/materialPoints/positions:0: file is missing | "
                               "fill the mesh with material points first: run setMaterialPoints");

    writeCloud(testCase.path() / "1", sampleCloud(5), {});
    const std::string folder = "1/lagrangian/materialPoints/";
    const std::string porosity = testCase.read(folder + "porosity");
    writeFileAtomically(testCase.path() / folder / "porosity", "FoamFile { class scalarField; }\n4{0}\n");
    EXPECT_EQ(problemOf(read), folder + "porosity:2: field of 4 values for a cloud of 5 material points | ");

    testCase.write(folder + "porosity", porosity.substr(0, porosity.size() - 90));
    EXPECT_NE(problemOf(read).find("binary data end too early: 40 bytes expected"), std::string::npos)
        << problemOf(read);

    testCase.write(folder + "porosity", "FoamFile { class tensorField; }\n0()\n");
    EXPECT_NE(problemOf(read).find("class 'tensorField' is not a field of a cloud"), std::string::npos);

    testCase.write(folder + "positions", "FoamFile { class vectorField; }\n0()\n");
    EXPECT_NE(problemOf(read).find("class 'vectorField' is not a cloud"), std::string::npos);
}

TEST(FoamFile, handWrittenAsciiCloudIsRead)
{
    const TemporaryCase testCase;
    testCase.write("0/lagrangian/soil/positions", "FoamFile { class Cloud<passiveParticle>; }\n"
                                                  "2\n(\n(1 0 -2) 0 // first\n( .5 +0 -1e-3 ) 7\n)\n");
    testCase.write("0/lagrangian/soil/rho", "FoamFile { class scalarField; }\n2{ 2650 }\n");
    testCase.write("0/lagrangian/soil/rho~", "an editor's copy");
    const Cloud cloud = readCloud(testCase.path() / "0", "soil");
    EXPECT_EQ(cloud.positions[1], (std::array<double, 3>{0.5, 0, -1e-3}));
    EXPECT_EQ(cloud.cells, (std::vector<int>{0, 7}));
    ASSERT_EQ(cloud.fields.size(), 1U);
    EXPECT_EQ(cloud.fields[0].values, (std::vector<double>{2650, 2650}));
}

TEST(FoamFile, truncatedGzipFileIsAnError)
{
    const TemporaryCase testCase;
    writeCloud(testCase.path() / "1", sampleCloud(40), {true, 17, true});
    const std::string file = "1/lagrangian/materialPoints/velocity.gz";
    testCase.write(file, testCase.read(file).substr(0, 500));
    EXPECT_NE(problemOf([&] {
                  readCloud(testCase.path() / "1", "materialPoints");
              }).find("is not a complete gzip file"),
              std::string::npos);
}

TEST(FileIO, fullDiskIsReportedWithFileAndReason)
{
    // /dev/full takes any open and refuses every byte.
    try {
        appendToFile("/dev/full", "x");
        FAIL() << "a write to a full disk went unnoticed";
    } catch (const WriteError& error) {
        EXPECT_STREQ(error.what(), "cannot write /dev/full: No space left on device");
    }
}

TEST(FileIO, diskThatFillsUpInTheMiddleOfAFileIsReported)
{
    // A limit on the size of files makes write() stop half-way, as a disk that fills up does.
    const TemporaryCase testCase;
    const pid_t child = fork();
    if (child == 0) {
        const rlimit limit{4000, 4000};
        setrlimit(RLIMIT_FSIZE, &limit);
        std::signal(SIGXFSZ, SIG_IGN);
        try {
            writeCloud(testCase.path() / "1", sampleCloud(1000), {});
        } catch (const WriteError&) {
            _exit(fs::is_empty(testCase.path() / "1/lagrangian/materialPoints") ? 0 : 2);
        }
        _exit(1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 0) << "1: no error was thrown, 2: half a file was left";
}

TEST(FileIO, failedWriteKeepsTheOldFileAndLeavesNothingBehind)
{
    const TemporaryCase testCase;
    testCase.write("points", "old");
    fs::create_directories(testCase.path() / ".points.writing"); // in the way of the temporary file
    EXPECT_THROW(writeFileAtomically(testCase.path() / "points", "new"), WriteError);
    EXPECT_EQ(testCase.read("points"), "old");
    fs::remove(testCase.path() / ".points.writing");
    writeFileAtomically(testCase.path() / "points", "new");
    EXPECT_EQ(testCase.read("points"), "new");
    EXPECT_EQ(std::distance(fs::directory_iterator(testCase.path()), {}), 1);
}

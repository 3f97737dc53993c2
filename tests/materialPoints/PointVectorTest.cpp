#include "materialPoints/PointVector.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace caisson;

namespace {

PointVector read(const std::string& text, InputProblems& problems)
{
    const Dictionary dictionary = parseDictionary(text, "constant/bodyForce");
    const std::vector<Keyword> keywords = pointVectorKeywords();
    const KeywordReader reader(dictionary, keywords, "bodyForce", problems);
    return readPointVector(reader, "bodyForce");
}

/// The only problem of a text.
InputProblem problemOf(const std::string& text)
{
    InputProblems problems;
    static_cast<void>(read(text, problems));
    EXPECT_EQ(problems.all().size(), 1U) << text;
    return problems.all().empty() ? InputProblem{} : problems.all().front();
}

MaterialPoints row(int size)
{
    MaterialPoints points;
    points.resize(size, 0);
    for (int p = 0; p < size; ++p) {
        points.initialR[p] = 0.01 * p;
        points.initialZ[p] = 1 - 0.002 * p;
        points.r[p] = points.initialR[p] + 0.3;
        points.z[p] = points.initialZ[p] - 0.2;
        points.vr[p] = 2;
        points.vz[p] = 4;
    }
    return points;
}

} // namespace

TEST(PointVector, isWhatTheExpressionsSayAtEveryPoint)
{
    InputProblems problems;
    const PointVector vector = read("definitions { A 0.1; f \"A*sin(3*t)\"; far \"R > 1\"; }\n"
                                    "r \"f*R + (far ? z : 0)\"; z \"-Z*r + pow(t, 2)\";",
                                    problems);
    problems.throwIfAny("test");
    const int size = 200; // more than a block, and no multiple of one
    const MaterialPoints points = row(size);
    std::vector<double> r(size), z(size);
    PointVector::Workspace room = vector.workspace();
    const double t = 0.7;
    const double lead = 0.05;
    vector.evaluate(points, 0, size, t, lead, r.data(), z.data(), room);
    for (int p = 0; p < size; ++p) {
        const double nowR = points.r[p] + lead * 2;
        const double nowZ = points.z[p] + lead * 4;
        const double R = points.initialR[p];
        EXPECT_NEAR(r[p], 0.1 * std::sin(3 * t) * R + (R > 1 ? nowZ : 0), 1e-15) << "point " << p;
        EXPECT_NEAR(z[p], -points.initialZ[p] * nowR + t * t, 1e-15) << "point " << p;
    }
    std::vector<double> partR(3), partZ(3);
    vector.evaluate(points, 150, 153, t, lead, partR.data(), partZ.data(), room);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(partR[i], r[150 + i]);
        EXPECT_EQ(partZ[i], z[150 + i]);
    }
}

TEST(PointVector, numbersAreExpressions)
{
    InputProblems problems;
    const PointVector vector = read("r 0; z -9.81;", problems);
    const MaterialPoints points = row(1);
    double r = 1, z = 0;
    PointVector::Workspace room = vector.workspace();
    vector.evaluate(points, 0, 1, 0, 0, &r, &z, room);
    EXPECT_EQ(r, 0);
    EXPECT_EQ(z, -9.81);
}

TEST(PointVector, mistakesAreToldWithLineKeyAndWhatWouldBeRight)
{
    InputProblem problem = problemOf("r 0;\nz \"2*RR\";");
    EXPECT_EQ(problem.where.line, 2);
    EXPECT_NE(problem.message.find("'z' of bodyForce: unknown name 'RR'"), std::string::npos)
        << problem.message;
    EXPECT_NE(problem.message.find("did you mean 'r'?"), std::string::npos) << problem.message;
    EXPECT_NE(problem.hint.find("R Z (initial place)"), std::string::npos) << problem.hint;

    problem = problemOf("r \"2*(R + 1\"; z 0;");
    EXPECT_NE(problem.message.find("expected ')' at character 9 of '2*(R + 1'"), std::string::npos)
        << problem.message;

    problem = problemOf("r \"R^2\"; z 0;");
    EXPECT_NE(problem.message.find("powers are pow(a, b)"), std::string::npos) << problem.message;

    problem = problemOf("r 2*R + 1; z 0;");
    EXPECT_NE(problem.message.find("'r' is not one expression"), std::string::npos) << problem.message;
    EXPECT_NE(problem.hint.find("in quotes"), std::string::npos) << problem.hint;

    problem = problemOf("r 0;");
    EXPECT_NE(problem.message.find("missing key 'z' in bodyForce"), std::string::npos) << problem.message;

    problem = problemOf("r 0; x 1; z 0;");
    EXPECT_NE(problem.message.find("unknown key 'x' in bodyForce"), std::string::npos) << problem.message;

    problem = problemOf("definitions\n{\n    f \"2*g\";\n    g 1;\n}\nr f; z 0;");
    EXPECT_EQ(problem.where.line, 3);
    EXPECT_NE(problem.message.find("'f' of bodyForce: unknown name 'g'"), std::string::npos)
        << problem.message;

    problem = problemOf("definitions { t 1; } r 0; z 0;");
    EXPECT_NE(problem.message.find("'t' has a meaning already"), std::string::npos) << problem.message;

    problem = problemOf("r \"1/0\"; z 0;");
    EXPECT_NE(problem.message.find("the result is not finite"), std::string::npos) << problem.message;
}

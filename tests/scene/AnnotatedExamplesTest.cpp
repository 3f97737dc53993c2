#include "case/ControlDict.h"
#include "materialPoints/InitialState.h"
#include "materialPoints/PointLoads.h"
#include "mesh/CoarsenMesh.h"
#include "scene/SolutionDict.h"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

using namespace caisson;

namespace {

std::string annotated(const std::string& name)
{
    const std::ifstream file(std::string(CAISSON_SOURCE_DIR) + "/etc/caseDicts/annotated/" + name);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// The comment above an entry, which may be commented out itself; "" where there is no such entry.
std::string commentOf(const std::string& text, const std::string& key)
{
    const std::regex line("^ *(// )?" + key + "( .*[;}]|)$");
    const std::regex comment("^ *//(.*)$");
    std::istringstream lines(text);
    std::string above;
    std::smatch match;
    for (std::string current; std::getline(lines, current);) {
        if (std::regex_match(current, line)) {
            return above;
        }
        above = std::regex_match(current, match, comment) ? above + match.str(1) : std::string();
    }
    return {};
}

/// Every keyword stands in the file, and the comment above it tells its unit and its default.
void expectExplained(const std::string& name, std::span<const Keyword> table)
{
    const std::string text = annotated(name);
    for (const Keyword& keyword : table) {
        const std::string key(keyword.name);
        const std::string comment = commentOf(text, key);
        EXPECT_NE(comment, "") << name << " has no commented entry '" << key << "'";
        const std::string told = keyword.defaultValue.empty() ? "required"
                                 : keyword.defaultValue == "-"
                                     ? "optional"
                                     : "default " + std::string(keyword.defaultValue);
        EXPECT_NE((comment + " ").find(told + ". "), std::string::npos)
            << name << ": the comment above '" << key << "' does not say '" << told << "':" << comment;
        for (const std::string unit : {"m", "s", "Pa", "kg/m3", "deg", "m2", "Pa s", "-"}) {
            if (keyword.unit == unit) {
                EXPECT_NE(comment.find("[" + unit + "]"), std::string::npos)
                    << name << ": the comment above '" << key << "' does not say [" << unit
                    << "]:" << comment;
            }
        }
    }
}

} // namespace

TEST(AnnotatedExamples, controlDictExplainsEveryKey)
{
    expectExplained("controlDict", controlDictKeywords());
}

TEST(AnnotatedExamples, mpmSolutionExplainsEveryKey) { expectExplained("mpmSolution", solutionKeywords()); }

TEST(AnnotatedExamples, dynamicMeshDictExplainsEveryKey)
{
    expectExplained("dynamicMeshDict", meshMotionKeywords());
}

TEST(AnnotatedExamples, coarsenMeshDictExplainsEveryKey)
{
    expectExplained("coarsenMeshDict", coarsenMeshKeywords());
}

TEST(AnnotatedExamples, bodiesExplainEveryKeyOfEveryShape)
{
    for (const std::string& shape : bodyShapes()) {
        expectExplained("bodies", bodyKeywords(shape));
    }
}

TEST(AnnotatedExamples, materialPropertiesExplainEveryKeyOfEveryLaw)
{
    for (const std::string& law : constitutiveLawTypes()) {
        expectExplained("materialProperties", materialKeywords(law));
    }
}

TEST(AnnotatedExamples, setMaterialPointsDictExplainsEveryKey)
{
    for (const std::string& type : seedRegionTypes()) {
        expectExplained("setMaterialPointsDict", seedRegionKeywords(type));
    }
    for (const std::string& type : initialStateTypes()) {
        expectExplained("setMaterialPointsDict", initialStateKeywords(type));
    }
    for (const std::string& type : seedRegionTypes()) {
        expectExplained("setMaterialPointsDict", loadedSurfaceKeywords(type));
    }
    expectExplained("setMaterialPointsDict", seedRefinementKeywords());
    expectExplained("setMaterialPointsDict", seedVelocityKeywords());
}

TEST(AnnotatedExamples, pointLoadsExplainEveryKeyOfEveryType)
{
    for (const std::string& type : pointLoadTypes()) {
        expectExplained("pointLoads", pointLoadKeywords(type));
    }
}

TEST(AnnotatedExamples, bodyForceExplainsEveryKey) { expectExplained("bodyForce", pointVectorKeywords()); }

TEST(AnnotatedExamples, velocityShowsEveryTypeOfCondition)
{
    const std::string text = annotated("U");
    for (const std::string& type : patchVelocityTypes()) {
        EXPECT_NE(text.find("type " + type + ";"), std::string::npos) << "0/U shows no type " << type;
    }
}

// caissonKeywords: the keywords of all dictionaries as one Markdown file, from the tables that read them.
//
// Usage: caissonKeywords [-check <file>]

#include "../setMaterialPoints/SeedInput.h"
#include "bodies/FreeSurface.h"
#include "boundary/LiquidConditions.h"
#include "case/FileIO.h"
#include "case/Program.h"
#include "installation/InstallationInput.h"
#include "mesh/CoarsenMesh.h"
#include "mesh/MeshMotion.h"
#include "scene/CaseScene.h"
#include "scene/SeepageScene.h"
#include "scene/SolutionDict.h"

#include <algorithm>
#include <iostream>

namespace {

using namespace caisson;

/// A place holder such as <name> would be taken for HTML.
std::string table(const std::string& title, std::span<const Keyword> keywords)
{
    std::string text;
    for (const char c : keywordTableMarkdown(title, keywords)) {
        text += c == '<' ? "&lt;" : std::string(1, c);
    }
    return text + "\n";
}

/// Tables of a dictionary whose keys depend on a type word: the keys of every type once, then each type's
/// own.
template <class TableOf>
std::string tables(const std::string& every, const std::string& each, const std::vector<std::string>& types,
                   const TableOf& tableOf)
{
    const auto has = [&](const std::string& type, std::string_view key) {
        const std::vector<Keyword> keywords = tableOf(type);
        return std::ranges::any_of(keywords, [&](const Keyword& keyword) { return keyword.name == key; });
    };
    const auto shared = [&](const Keyword& keyword) {
        return std::ranges::all_of(types, [&](const std::string& type) { return has(type, keyword.name); });
    };
    std::vector<Keyword> common = tableOf(types.front());
    std::erase_if(common, [&](const Keyword& keyword) { return !shared(keyword); });
    std::string text = table(every, common);
    const auto own = [&](const std::string& type) {
        std::vector<Keyword> keywords = tableOf(type);
        std::erase_if(keywords, shared);
        return keywords;
    };
    for (std::size_t i = 0; i < types.size();) { // neighbours of equal keys share a table
        const std::vector<Keyword> keywords = own(types[i]);
        const std::string body = table("", keywords);
        std::string title = each + " `" + types[i] + "`";
        while (++i < types.size() && table("", own(types[i])) == body) {
            title += ", `" + types[i] + "`";
        }
        if (!keywords.empty()) {
            text += table(title, keywords);
        }
    }
    return text;
}

std::string allTables()
{
    std::string text = "# Keywords\n\n"
                       "Printed by `caissonKeywords` from the tables that the programs read with. `required` "
                       "in the third column: there is no default;\n`none`: may be left out. Intervals: `[` "
                       "includes the end, `(` does not. SI units. `Function1` and `flag` are explained in\n"
                       "[Dictionaries](dictionaries.md).\n\n";
    text += "## system/controlDict\n\n" + table("controlDict", controlDictKeywords());
    text += "## system/mpmSolution\n\n" + table("mpmSolution", solutionKeywords());
    text += "## system/setMaterialPointsDict\n\n" +
            table("setMaterialPointsDict", setMaterialPointsKeywords()) +
            tables("every region", "region of type", seedRegionTypes(), seedRegionKeywords) +
            table("a refinement of a region", seedRefinementKeywords()) +
            table("velocity of a region", seedVelocityKeywords()) +
            tables("initialState", "initialState of type", initialStateTypes(), initialStateKeywords) +
            tables("porePressure", "porePressure of type", initialPorePressureTypes(),
                   initialPorePressureKeywords) +
            tables("loadedPoints", "loadedPoints of type", seedRegionTypes(), loadedSurfaceKeywords);
    text += "## 0/p\n\nOne sub-dictionary per patch in `boundaryField`, one per surface of the soil in "
            "`freeSurfaces`.\n\n" +
            tables("every patch", "patch of type", patchPressureTypes(), patchPressureKeywords) +
            table("a free surface", freeSurfaceKeywords());
    text += "## constant/materialProperties\n\nOne sub-dictionary per material.\n\n" +
            tables("every material", "material with law", constitutiveLawTypes(), materialKeywords);
    text += "## constant/bodies\n\nOne sub-dictionary per body.\n\n" +
            tables("every body", "body of shape", bodyShapes(), bodyKeywords);
    text += "## constant/pointLoads\n\nLoads on material points, one sub-dictionary each.\n\n" +
            tables("every load", "load of type", pointLoadTypes(), pointLoadKeywords);
    text +=
        "## constant/bodyForce\n\nAcceleration of one-phase soil besides gravity [m/s2], where the file is "
        "there.\n\n" +
        table("bodyForce", pointVectorKeywords());
    text += "## constant/dynamicMeshDict\n\n" + table("dynamicMeshDict", meshMotionKeywords());
    text += "## system/coarsenMeshDict\n\n" + table("coarsenMeshDict", coarsenMeshKeywords());
    text += "## constant/g\n\n" + table("g", gravityKeywords());
    text += "## system/seepageDict\n\nFor seepageFoam; steady where the file is missing.\n\n" +
            table("seepageDict", seepageKeywords());
    text += "## system/suctionPressureDict\n\n";
    for (const InstallationKeywords& part : installationKeywords()) {
        text += table(part.title, part.keywords);
    }
    text +=
        "## Function1\n\n`type` is a key where the function is a dictionary; otherwise it stands before the "
        "value.\n\n" +
        tables("every Function1", "Function1 of type", function1Types(), function1Keywords);
    text.pop_back(); // no empty line at the end
    return text;
}

int check(const std::filesystem::path& file)
{
    if (readFile(file, file.string()) == allTables()) {
        return 0;
    }
    std::cerr << file.string() << " is not what the programs read any more; renew it with\n"
              << "    caissonKeywords > doc/userGuide/keywords.md\n";
    return 1;
}

} // namespace

int main(int argc, char* argv[])
{
    namespace options = boost::program_options;
    Program program{"caissonKeywords", "[-check FILE]",
                    "Prints the keywords of all dictionaries as Markdown."};
    program.options.add_options()("check", options::value<std::string>(),
                                  "compare the tables with those of a file; status 1 where they differ");
    program.run = [](const options::variables_map& given, const std::string&) {
        if (given.contains("check")) {
            return check(given["check"].as<std::string>());
        }
        std::cout << allTables();
        return 0;
    };
    return runProgram(std::move(program), argc, argv);
}

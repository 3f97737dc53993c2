#include "boundary/LiquidConditions.h"

#include <algorithm>

namespace caisson {

std::vector<std::string> patchPressureTypes()
{
    return {"fixedValue",  "uniformFixedValue", "hydrostatic", "prescribedFlux",
            "impermeable", "zeroGradient",      "slip",        "symmetryPlane"};
}

std::vector<Keyword> patchPressureKeywords(const std::string& type)
{
    const std::vector<std::string> types = patchPressureTypes();
    if (std::ranges::find(types, type) == types.end()) {
        return {};
    }
    std::vector<Keyword> keywords = {{"type", "word", "", "", "condition on the pore liquid"}};
    if (type == "fixedValue") {
        keywords.push_back({"value", "list", "", "", "pressure [Pa]: uniform 0"});
        return keywords;
    }
    if (type == "uniformFixedValue") {
        keywords.push_back({"uniformValue", "Function1", "", "", "pressure [Pa] of time [s]"});
    } else if (type == "prescribedFlux") {
        keywords.push_back(
            {"uniformValue", "Function1", "", "", "discharge into the soil per area [m/s] of time [s]"});
    } else if (type == "hydrostatic") {
        keywords.push_back({"level", "m", "0", "", "where the hydrostatic part rho_w g (level - z) is zero"});
        keywords.push_back({"pressure", "Function1", "-", "", "added to it [Pa], of time [s]"});
    }
    keywords.push_back({"value", "list", "-", "", "for the tools of OpenFOAM, not used"});
    return keywords;
}

namespace {

PatchPressure readCondition(const Dictionary& dictionary, const std::string& type, const std::string& patch,
                            double unitWeight, InputProblems& problems)
{
    const std::vector<Keyword> keywords = patchPressureKeywords(type);
    const KeywordReader reader(dictionary, keywords, "patch '" + patch + "'", problems);
    PatchPressure condition;
    const std::string needed = type == "fixedValue"                                      ? "value"
                               : type == "uniformFixedValue" || type == "prescribedFlux" ? "uniformValue"
                                                                                         : "";
    if (!needed.empty() && !reader.has(needed)) {
        reader.problem(needed, "patch '" + patch + "' of type " + type + " has no '" + needed + "'",
                       needed == "value" ? "value uniform 0;" : "uniformValue 0;");
        return condition;
    }
    if (type == "fixedValue") {
        condition.kind = PatchPressure::Kind::pressure;
        const Entry* entry = dictionary.find("value");
        const bool uniform = entry->tokens.size() == 2 && entry->tokens[0].text == "uniform";
        if (!uniform) {
            reader.problem("value", "'value' of patch '" + patch + "' is not uniform", "value uniform 0;");
        } else if (entry->tokens[1].kind != Token::Kind::number) {
            reader.problem("value", "'" + entry->tokens[1].text + "' is no number", "value uniform 0;");
        } else {
            condition.value = constantFunction1(entry->tokens[1].number);
        }
    } else if (type == "uniformFixedValue" || type == "prescribedFlux") {
        condition.kind = type == "prescribedFlux" ? PatchPressure::Kind::flux : PatchPressure::Kind::pressure;
        condition.value = readFunction1(dictionary, "uniformValue", problems);
    } else if (type == "hydrostatic") {
        condition.kind = PatchPressure::Kind::pressure;
        condition.unitWeight = unitWeight;
        condition.level = reader.number("level");
        if (reader.has("pressure")) {
            condition.value = readFunction1(dictionary, "pressure", problems);
        }
    }
    return condition;
}

} // namespace

std::map<std::string, PatchPressure> readPatchPressures(const Dictionary& fieldP, const BackgroundMesh& mesh,
                                                        const std::vector<std::string>& constraintPatches,
                                                        double unitWeight, InputProblems& problems)
{
    std::map<std::string, PatchPressure> result;
    const Dictionary* boundaryField = fieldP.findDictionary("boundaryField");
    if (!boundaryField) {
        problems.add(fieldP.where(), "no boundaryField",
                     "one sub-dictionary per patch of constant/polyMesh/boundary");
        return result;
    }
    std::vector<std::string> patchNames = constraintPatches;
    for (const BoundaryPatch& patch : mesh.patches) {
        patchNames.push_back(patch.name);
    }
    for (const Entry& entry : boundaryField->entries()) {
        if (!entry.isPattern && std::ranges::find(patchNames, entry.keyword) == patchNames.end()) {
            problems.add(entry.where, "unknown patch '" + entry.keyword + "' in boundaryField",
                         suggestion(entry.keyword, patchNames, "patches"));
        }
    }
    const std::vector<std::string> types = patchPressureTypes();
    for (const BoundaryPatch& patch : mesh.patches) {
        if (patch.edges.empty() ||
            std::ranges::find(constraintPatches, patch.name) != constraintPatches.end()) {
            continue;
        }
        const Entry* entry = boundaryField->find(patch.name);
        if (!entry || !entry->dictionary) {
            problems.add(boundaryField->where(), "no condition for patch '" + patch.name + "'",
                         patch.name + " { type impermeable; }");
            continue;
        }
        const Entry* typeEntry = entry->dictionary->find("type");
        const std::string type = typeEntry && !typeEntry->tokens.empty() ? typeEntry->tokens[0].text : "";
        if (std::ranges::find(types, type) == types.end()) {
            problems.add(typeEntry ? typeEntry->where : entry->where,
                         type.empty() ? "no type for patch '" + patch.name + "'"
                                      : "unknown type '" + type + "' for patch '" + patch.name + "'",
                         suggestion(type, types, "types"));
            continue;
        }
        result.emplace(patch.name, readCondition(*entry->dictionary, type, patch.name, unitWeight, problems));
    }
    return result;
}

} // namespace caisson

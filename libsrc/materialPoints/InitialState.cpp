#include "materialPoints/InitialState.h"

#include "dictionary/Text.h"

#include <algorithm>
#include <limits>

namespace caisson {

namespace {

/// A horizontal layer of soil of one weight.
struct Layer
{
    double top;        ///< level [m]
    double unitWeight; ///< [N/m3]
    MaterialExtent extent;
    std::string materials;
};

/// Layers from the top down; those of equal weight are one. Empty where materials do not lie in layers.
std::vector<Layer> findLayers(const SeededPoints& seeded, const std::vector<Material>& materials,
                              double surfaceLevel, double g, const SourceLocation& where,
                              InputProblems& problems)
{
    std::vector<Layer> layers;
    for (std::size_t m = 0; m < materials.size(); ++m) {
        const MaterialExtent& extent = seeded.extent[m];
        if (extent.lowest > extent.highest) {
            continue;
        }
        layers.push_back({0, materials[m].weighingDensity() * g, extent, materials[m].name});
    }
    std::ranges::sort(
        layers, [](const Layer& a, const Layer& b) { return a.extent.highestPoint > b.extent.highestPoint; });
    std::vector<Layer> merged;
    for (const Layer& layer : layers) {
        if (!merged.empty() && merged.back().unitWeight == layer.unitWeight) {
            MaterialExtent& extent = merged.back().extent;
            extent.lowest = std::min(extent.lowest, layer.extent.lowest);
            extent.lowestPoint = std::min(extent.lowestPoint, layer.extent.lowestPoint);
            merged.back().materials += ", " + layer.materials;
        } else {
            merged.push_back(layer);
        }
    }
    for (std::size_t i = 0; i < merged.size(); ++i) {
        merged[i].top = i == 0 ? surfaceLevel : (merged[i].extent.highest + merged[i - 1].extent.lowest) / 2;
        if (i > 0 && merged[i].extent.highestPoint >= merged[i - 1].extent.lowestPoint) {
            problems.add(
                where,
                text("K0 needs materials of different weight in horizontal layers, but %s reaches up to "
                     "z = %g and %s down to z = %g",
                     merged[i].materials.c_str(), merged[i].extent.highest, merged[i - 1].materials.c_str(),
                     merged[i - 1].extent.lowest),
                "use type zero or uniform");
            return {};
        }
    }
    return merged;
}

/// Nothing would carry the weight of soil that is not there. Where the surface cuts the cells it may lie
/// above the uppermost sub-cell, by less than the height of one.
bool reachesSurface(const SeededPoints& seeded, const InitialState& state, InputProblems& problems)
{
    double highest = -std::numeric_limits<double>::infinity();
    double highestPoint = highest;
    for (const MaterialExtent& extent : seeded.extent) {
        highest = std::max(highest, extent.highest);
        highestPoint = std::max(highestPoint, extent.highestPoint);
    }
    if (seeded.points.size() == 0 || state.surfaceLevel - highest <= 2 * (highest - highestPoint)) {
        return true;
    }
    problems.add(
        state.where,
        text("the soil reaches up to z = %g only, not to surfaceLevel %g", highest, state.surfaceLevel),
        "surfaceLevel is the z of the soil surface; give what rests on it as overburden");
    return false;
}

void setK0(SeededPoints& seeded, const std::vector<Material>& materials, const InitialState& state,
           const std::array<double, 2>& gravity, InputProblems& problems)
{
    if (gravity[0] != 0 || gravity[1] > 0) {
        problems.add(state.where, "K0 needs gravity along -z",
                     text("constant/g has (%g %g) along r and z", gravity[0], gravity[1]));
        return;
    }
    MaterialPoints& points = seeded.points;
    const auto above = std::ranges::count_if(points.z, [&](double z) { return z > state.surfaceLevel; });
    if (above > 0) {
        problems.add(state.where,
                     text("%ld points lie above surfaceLevel %g, up to z = %g", static_cast<long>(above),
                          state.surfaceLevel, *std::ranges::max_element(points.z)),
                     "surfaceLevel is the z of the soil surface");
        return;
    }
    if (!reachesSurface(seeded, state, problems)) {
        return;
    }
    const std::vector<Layer> layers =
        findLayers(seeded, materials, state.surfaceLevel, -gravity[1], state.where, problems);
    for (std::size_t p = 0; !layers.empty() && p < points.size(); ++p) {
        double pressure = state.overburden;
        for (std::size_t i = 0; i < layers.size() && points.z[p] < layers[i].top; ++i) {
            const double bottom =
                i + 1 < layers.size() ? std::max(points.z[p], layers[i + 1].top) : points.z[p];
            pressure += layers[i].unitWeight * (layers[i].top - bottom);
        }
        points.stress[0][p] = points.stress[2][p] = -state.K0 * pressure;
        points.stress[1][p] = -pressure;
        points.stress[3][p] = 0;
    }
}

constexpr std::string_view typeWords = "zero uniform K0 fromTime";

} // namespace

std::vector<std::string> initialStateTypes() { return {"zero", "uniform", "K0", "fromTime"}; }

std::vector<Keyword> initialStateKeywords(const std::string& type)
{
    std::vector<Keyword> keywords = {{"type", "word", "", typeWords, "how the initial stress is found"}};
    if (type == "uniform") {
        keywords.push_back(
            {"stress", "list", "", "",
             "effective stress (rr zz tt rz) [Pa], tension positive; tt is the hoop stress, or "
             "that out of the plane"});
    } else if (type == "K0") {
        keywords.push_back({"K0", "-", "", "[0, inf)", "horizontal over vertical effective stress"});
        keywords.push_back({"surfaceLevel", "m", "", "", "z of the soil surface"});
        keywords.push_back(
            {"overburden", "Pa", "0", "[0, inf)", "vertical effective pressure on the surface"});
    } else if (type == "fromTime") {
        keywords.push_back(
            {"case", "string", ".", "",
             "case directory of an earlier run, relative to this one; its points give stress and "
             "state variables to those next to them"});
        keywords.push_back({"time", "s", "", "", "time that the earlier run wrote"});
    }
    return keywords;
}

InitialState readInitialState(const Dictionary& dictionary, InputProblems& problems)
{
    InitialState state;
    state.where = dictionary.where();
    const Entry* entry = dictionary.find("type");
    const std::string type = entry != nullptr && entry->tokens.size() == 1 ? entry->tokens[0].text : "";
    const std::vector<std::string> types = initialStateTypes();
    if (std::ranges::find(types, type) == types.end()) {
        problems.add(entry != nullptr ? entry->where : state.where,
                     entry != nullptr ? "unknown word '" + type + "' for type of initialState"
                                      : "missing key 'type' in initialState",
                     suggestion(type, types, "types"));
        return state;
    }
    const std::vector<Keyword> keywords = initialStateKeywords(type);
    const KeywordReader reader(dictionary, keywords, "initialState", problems);
    if (type == "uniform") {
        state.type = InitialState::Type::uniform;
        const std::vector<double> stress = reader.numbers("stress");
        if (stress.size() == 4) {
            std::ranges::copy(stress, state.stress.begin());
        } else if (!stress.empty()) {
            reader.problem("stress", text("'stress' has %zu numbers, not four", stress.size()),
                           "stress (rr zz tt rz);");
        }
    } else if (type == "K0") {
        state.type = InitialState::Type::K0;
        state.K0 = reader.number("K0");
        state.surfaceLevel = reader.number("surfaceLevel");
        state.overburden = reader.number("overburden");
    } else if (type == "fromTime") {
        state.type = InitialState::Type::fromTime;
        state.caseDirectory = reader.word("case");
        state.time = reader.number("time");
    }
    return state;
}

void setInitialStress(SeededPoints& seeded, const std::vector<Material>& materials, const InitialState& state,
                      const std::array<double, 2>& gravity, InputProblems& problems)
{
    if (state.type == InitialState::Type::K0) {
        setK0(seeded, materials, state, gravity, problems);
        return;
    }
    for (std::size_t k = 0; k < 4; ++k) {
        std::ranges::fill(seeded.points.stress[k], state.stress[k]);
    }
}

std::vector<std::string> initialPorePressureTypes() { return {"hydrostatic", "uniform", "seepage"}; }

std::vector<Keyword> initialPorePressureKeywords(const std::string& type)
{
    std::vector<Keyword> keywords = {
        {"type", "word", "", "hydrostatic uniform seepage", "how the pore pressure at the start is found"}};
    if (type == "hydrostatic") {
        keywords.push_back({"level", "m", "0", "", "where the hydrostatic part rho_w g (level - z) is zero"});
        keywords.push_back({"pressure", "Pa", "0", "", "added to the hydrostatic part"});
    } else if (type == "uniform") {
        keywords.push_back({"pressure", "Pa", "", "", "pore pressure, compression positive"});
    }
    return keywords;
}

InitialPorePressure readInitialPorePressure(const Dictionary& dictionary, InputProblems& problems)
{
    const Entry* entry = dictionary.find("type");
    const std::string type = entry != nullptr && entry->tokens.size() == 1 ? entry->tokens[0].text : "";
    const std::vector<std::string> types = initialPorePressureTypes();
    InitialPorePressure initial;
    if (std::ranges::find(types, type) == types.end()) {
        problems.add(entry != nullptr ? entry->where : dictionary.where(),
                     entry != nullptr ? "unknown word '" + type + "' for type of porePressure"
                                      : "missing key 'type' in porePressure",
                     suggestion(type, types, "types"));
        return initial;
    }
    const std::vector<Keyword> keywords = initialPorePressureKeywords(type);
    const KeywordReader reader(dictionary, keywords, "porePressure", problems);
    initial.seepage = type == "seepage";
    if (initial.seepage) {
        return initial;
    }
    initial.hydrostatic = type == "hydrostatic";
    initial.level = initial.hydrostatic ? reader.number("level") : 0;
    initial.pressure = reader.number("pressure");
    return initial;
}

void setInitialPorePressure(SeededPoints& seeded, const std::vector<Material>& materials,
                            const InitialPorePressure& initial, const std::array<double, 2>& gravity)
{
    MaterialPoints& points = seeded.points;
    points.addLiquid();
    for (std::size_t p = 0; p < points.size(); ++p) {
        const double unitWeight = -materials[points.material[p]].liquidDensity * gravity[1];
        points.porePressure[p] =
            initial.pressure + (initial.hydrostatic ? unitWeight * (initial.level - points.z[p]) : 0);
    }
}

} // namespace caisson

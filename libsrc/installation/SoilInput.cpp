#include "installation/SoilInput.h"

#include "installation/ConeResistance.h"
#include "installation/ConeResistanceInput.h"
#include "installation/HoulsbyByrneClay.h"
#include "installation/HoulsbyByrneSand.h"
#include "installation/PrescribedSuction.h"

#include <algorithm>
#include <numbers>
#include <sstream>

namespace caisson {
namespace {

constexpr double degree = std::numbers::pi / 180;

constexpr Keyword effectiveUnitWeight{"effectiveUnitWeight", "N/m3", "", "(0, inf)",
                                      "Unit weight under water."};
constexpr Keyword intrinsicPermeability{"intrinsicPermeability", "m2", "-", "(0, inf)",
                                        "Outside the plug; without it no flow is computed."};
constexpr Keyword permeabilityRatio{"permeabilityRatio", "-", "1", "(0, inf)",
                                    "Permeability inside over outside."};

constexpr std::array sandKeywords{
    effectiveUnitWeight,
    Keyword{"frictionAngle", "deg", "", "(0, 60)", "Friction angle for the bearing factors."},
    Keyword{"bearingFactorFormula", "word", "vesic", "vesic hansen meyerhof eurocode7",
            "Formula for the bearing factor Ngamma."},
    Keyword{"sideFactorInside", "-", "", "(0, inf)", "K tan(delta) of the inner face."},
    Keyword{"sideFactorOutside", "-", "", "(0, inf)", "K tan(delta) of the outer face."},
    Keyword{"enhancement", "word", "", "none uniform loadSpread",
            "How friction adds to the vertical stress beside the skirt."},
    Keyword{"annulusRatio", "-", "-", "(1, inf)",
            "Diameter of the annulus outside that bears the friction, over outerDiameter; for uniform."},
    Keyword{"loadSpreadInside", "-", "-", "(0, inf)", "Widening per depth, for loadSpread."},
    Keyword{"loadSpreadOutside", "-", "-", "(0, inf)", "Widening per depth, for loadSpread."},
    Keyword{"tipRule", "word", "full", "full simpleInner",
            "Bearing under the tip: from the stresses on both sides, or from the inside alone."},
    permeabilityRatio,
    intrinsicPermeability,
};

constexpr std::array clayLayerKeywords{
    Keyword{"top", "m", "", "[0, inf)", "Depth of the layer's upper side."},
    effectiveUnitWeight,
    Keyword{"undrainedShearStrength", "Pa", "", "[0, inf)", "At the top of the layer."},
    Keyword{"strengthGradient", "Pa/m", "0", "[0, inf)", "Gain of strength per depth."},
    Keyword{"adhesionFactorInside", "-", "", "[0, 1]", "Adhesion over undrained shear strength."},
    Keyword{"adhesionFactorOutside", "-", "", "[0, 1]", "Adhesion over undrained shear strength."},
};

constexpr std::array clayKeywords{
    Keyword{
        "layers", "dictionary", "", "",
        "One sub-dictionary per layer, from the sea bed down: its top, unit weight, strength and adhesion."},
    Keyword{"bearingFactorNc", "-", "9", "(0, inf)", "Bearing factor of the tip and of the plug."},
    Keyword{"loadSpread", "-", "1", "(0, inf)",
            "Widening of the annulus outside that bears the friction, for the plug's failure."},
};

constexpr std::array criticalSuctionKeywords{
    effectiveUnitWeight,
    coneResistance,
    coneResistanceProfile,
    coneResistanceFile,
    Keyword{"tipFactor", "-", "", "[0, inf)", "Tip resistance over cone resistance, kp."},
    Keyword{"frictionFactor", "-", "-", "[0, inf)", "Friction over cone resistance, kf. Or give:"},
    Keyword{"frictionCoefficient", "-", "-", "[0, inf)",
            "C of kf = C [1 - (Di/Do)^2]^0.3 tan(interfaceFrictionAngle)."},
    Keyword{"interfaceFrictionAngle", "deg", "-", "[0, 90)", "Between soil and steel."},
    permeabilityRatio,
    intrinsicPermeability,
};

constexpr std::array dnvKeywords{
    Keyword{"effectiveUnitWeight", "N/m3", "-", "(0, inf)", "Unit weight under water, to normalise with."},
    coneResistance,
    coneResistanceProfile,
    coneResistanceFile,
    Keyword{"estimate", "word", "mostProbable", "mostProbable highest",
            "Which of the factors of the soil types is taken."},
    Keyword{"layers", "dictionary", "", "",
            "One sub-dictionary per layer, from the sea bed down: its top, and type or factors."},
};

constexpr std::array dnvLayerKeywords{
    Keyword{"top", "m", "", "[0, inf)", "Depth of the layer's upper side."},
    Keyword{
        "soilType", "word", "-", "sand clay silt",
        "North Sea values of kp (most probable, highest) and kf: sand 0.3 0.6, 0.001 0.003; clay 0.4 0.6, "
        "0.03 0.05; silt 0.35 0.6, 0.015 0.02."},
    Keyword{"tipFactor", "-", "-", "[0, inf)", "Tip resistance over cone resistance, kp."},
    Keyword{"frictionFactor", "-", "-", "[0, inf)", "Friction over cone resistance, kf."},
};

constexpr std::array tableKeywords{
    effectiveUnitWeight,
    Keyword{"values", "list", "", "",
            "((z/L s) ...), s the suction over effectiveUnitWeight times outerDiameter."},
    permeabilityRatio,
    intrinsicPermeability,
};

struct SoilSource
{
    const Dictionary& soil;
    const std::filesystem::path& caseDirectory;
    InputProblems& problems;
    InstallationInput& input;
};

bool written(const KeywordReader& reader, const std::initializer_list<std::string_view> keys)
{
    return std::ranges::all_of(keys, [&](const std::string_view key) { return reader.has(key); });
}

void requireFor(const KeywordReader& reader, const std::string_view key, const std::string_view choice)
{
    if (!reader.has(key))
        reader.problem(key,
                       "missing key '" + std::string(key) + "', which " + std::string(choice) + " needs");
}

void readSeepage(const KeywordReader& reader, InstallationSite& site)
{
    site.permeabilityRatio = reader.number("permeabilityRatio");
    if (reader.has("intrinsicPermeability"))
        site.intrinsicPermeability = reader.number("intrinsicPermeability");
}

MethodMaker readSand(const SoilSource& source)
{
    const KeywordReader reader(source.soil, sandKeywords, "'soil'", source.problems);
    HoulsbyByrneSandSoil soil;
    soil.effectiveUnitWeight = source.input.effectiveUnitWeight = reader.number("effectiveUnitWeight");
    const double frictionAngle = reader.number("frictionAngle") * degree;
    const std::string formula = reader.word("bearingFactorFormula");
    soil.bearingFactorNq = bearingFactorNq(frictionAngle);
    soil.bearingFactorNgamma =
        bearingFactorNgamma(frictionAngle, formula == "hansen"      ? NgammaFormula::hansen
                                           : formula == "meyerhof"  ? NgammaFormula::meyerhof
                                           : formula == "eurocode7" ? NgammaFormula::eurocode7
                                                                    : NgammaFormula::vesic);
    soil.sideFactorInside = reader.number("sideFactorInside");
    soil.sideFactorOutside = reader.number("sideFactorOutside");
    soil.tipRule = reader.word("tipRule") == "simpleInner" ? TipRule::simpleInner : TipRule::full;
    const std::string enhancement = reader.word("enhancement");
    if (enhancement == "uniform") {
        soil.enhancement = StressEnhancement::uniform;
        requireFor(reader, "annulusRatio", "enhancement uniform");
        if (reader.has("annulusRatio"))
            soil.annulusRatio = reader.number("annulusRatio");
    } else if (enhancement == "loadSpread") {
        soil.enhancement = StressEnhancement::loadSpread;
        for (const std::string_view key : {"loadSpreadInside", "loadSpreadOutside"})
            requireFor(reader, key, "enhancement loadSpread");
        if (written(reader, {"loadSpreadInside", "loadSpreadOutside"})) {
            soil.loadSpreadInside = reader.number("loadSpreadInside");
            soil.loadSpreadOutside = reader.number("loadSpreadOutside");
        }
    }
    readSeepage(reader, source.input.site);
    soil.permeabilityRatio = source.input.site.permeabilityRatio;
    return [soil](const Caisson& caisson) { return std::make_unique<HoulsbyByrneSand>(caisson, soil); };
}

/// Layers from the sea bed down; calls `read(name, dictionary)` for each, which returns the top.
template <class Read>
void readLayers(const KeywordReader& reader, const Read& read)
{
    const Dictionary* layers = reader.dictionary("layers");
    if (layers == nullptr)
        return;
    double previous = -1;
    for (const Entry& entry : layers->entries()) {
        if (!entry.dictionary) {
            reader.problems().add(entry.where, "'" + entry.keyword + "' is not a layer",
                                  "a layer is a sub-dictionary: " + entry.keyword + " { top 0; ... }");
            continue;
        }
        const double top = read("layer '" + entry.keyword + "'", *entry.dictionary);
        if (previous < 0 && top > 0)
            reader.problems().add(entry.where, "the first layer must begin at the sea bed: top 0");
        else if (previous >= 0 && top <= previous)
            reader.problems().add(entry.where, "layer '" + entry.keyword + "' begins above the one before it",
                                  "write the layers from the sea bed down, each with a larger top");
        previous = top;
    }
    if (previous < 0)
        reader.problem("layers", "no layer is defined", "a layer is a sub-dictionary: sand { top 0; ... }");
}

MethodMaker readClay(const SoilSource& source)
{
    const KeywordReader reader(source.soil, clayKeywords, "'soil'", source.problems);
    struct Layer
    {
        double top, unitWeight, strength, gradient, inside, outside;
    };
    std::vector<Layer> layers;
    readLayers(reader, [&](const std::string& name, const Dictionary& dictionary) {
        const KeywordReader layer(dictionary, clayLayerKeywords, name, source.problems);
        layers.push_back({layer.number("top"), layer.number("effectiveUnitWeight"),
                          layer.number("undrainedShearStrength"), layer.number("strengthGradient"),
                          layer.number("adhesionFactorInside"), layer.number("adhesionFactorOutside")});
        return layers.back().top;
    });
    const double factor = reader.number("bearingFactorNc");
    const double spread = reader.number("loadSpread");
    if (!source.problems.empty())
        return {};
    source.input.effectiveUnitWeight = layers.front().unitWeight;

    return [layers, factor, spread](const Caisson& caisson) {
        // Each layer gives a point at its top and one at its bottom.
        const auto profile = [&](const auto& value) {
            std::vector<double> depth;
            std::vector<double> values;
            for (std::size_t i = 0; i < layers.size(); ++i) {
                const double bottom =
                    i + 1 < layers.size() ? layers[i + 1].top : layers[i].top + 10 * caisson.skirtLength;
                for (const double z : {layers[i].top, bottom}) {
                    depth.push_back(z);
                    values.push_back(value(layers[i], z));
                }
            }
            return DepthProfile(depth, values);
        };
        const auto strength = [](const Layer& layer, const double z) {
            return layer.strength + layer.gradient * (z - layer.top);
        };
        return std::make_unique<HoulsbyByrneClay>(
            caisson,
            HoulsbyByrneClaySoil{
                profile([](const Layer& layer, double) { return layer.unitWeight; }), profile(strength),
                profile([&](const Layer& layer, double z) { return layer.inside * strength(layer, z); }),
                profile([&](const Layer& layer, double z) { return layer.outside * strength(layer, z); }),
                factor, spread});
    };
}

/// A factor that steps from layer to layer.
struct LayerFactor
{
    double top;
    double factor;
};

/// Cone resistance times the factor of the layer, down to the full length of the skirt.
DepthProfile scaled(const DepthProfile& cone, const std::vector<LayerFactor>& layers,
                    const double skirtLength)
{
    if (cone.depths().size() > 1 && cone.deepest() < skirtLength * (1 - 1e-12)) {
        std::ostringstream message;
        message << "the cone resistance ends at depth " << cone.deepest() << " m, before skirtLength "
                << skirtLength << " m";
        throw std::invalid_argument(message.str());
    }
    std::vector<double> depth;
    std::vector<double> value;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const bool last = i + 1 == layers.size();
        const double bottom = last ? std::max(cone.deepest(), layers[i].top) : layers[i + 1].top;
        const auto add = [&](const double z, const double coneResistanceThere) {
            depth.push_back(z);
            value.push_back(layers[i].factor * coneResistanceThere);
        };
        add(layers[i].top, cone.value(layers[i].top));
        for (std::size_t k = 0; k < cone.depths().size(); ++k)
            if (cone.depths()[k] > layers[i].top && cone.depths()[k] < bottom)
                add(cone.depths()[k], cone.values()[k]);
        add(bottom, cone.valueAbove(bottom));
    }
    return {depth, value};
}

MethodMaker readCriticalSuction(const SoilSource& source, const CriticalSuction formula)
{
    const KeywordReader reader(source.soil, criticalSuctionKeywords, "'soil'", source.problems);
    const double weight = source.input.effectiveUnitWeight = reader.number("effectiveUnitWeight");
    const DepthProfile cone = readConeResistance(reader, source.caseDirectory);
    const double tipFactor = reader.number("tipFactor");
    readSeepage(reader, source.input.site);
    const bool direct = reader.has("frictionFactor");
    const bool byAngle = written(reader, {"frictionCoefficient", "interfaceFrictionAngle"});
    if (direct == byAngle)
        reader.problem("frictionFactor",
                       direct ? "the friction is given twice" : "the friction factor is missing",
                       "give frictionFactor, or frictionCoefficient and interfaceFrictionAngle");
    const double factor = direct ? reader.number("frictionFactor") : 0;
    const double coefficient = byAngle ? reader.number("frictionCoefficient") : 0;
    const double angle = byAngle ? reader.number("interfaceFrictionAngle") * degree : 0;
    return [=](const Caisson& caisson) {
        const double friction = direct ? factor : openPileFrictionFactor(caisson, coefficient, angle);
        return std::make_unique<CriticalSuctionMethod>(
            caisson,
            ConeResistanceSoil{scaled(cone, {{0, tipFactor}}, caisson.skirtLength),
                               scaled(cone, {{0, friction}}, caisson.skirtLength), weight},
            formula);
    };
}

MethodMaker readDnv(const SoilSource& source)
{
    const KeywordReader reader(source.soil, dnvKeywords, "'soil'", source.problems);
    source.input.effectiveUnitWeight = reader.has("effectiveUnitWeight")
                                           ? reader.number("effectiveUnitWeight")
                                           : std::numeric_limits<double>::quiet_NaN();
    const DepthProfile cone = readConeResistance(reader, source.caseDirectory);
    const bool highest = reader.word("estimate") == "highest";
    std::vector<LayerFactor> tip;
    std::vector<LayerFactor> friction;
    readLayers(reader, [&](const std::string& name, const Dictionary& dictionary) {
        const KeywordReader layer(dictionary, dnvLayerKeywords, name, source.problems);
        const double top = layer.number("top");
        const bool factors = written(layer, {"tipFactor", "frictionFactor"});
        if (factors == layer.has("soilType"))
            layer.problem("soilType", name + " needs either soilType or tipFactor and frictionFactor");
        if (factors) {
            tip.push_back({top, layer.number("tipFactor")});
            friction.push_back({top, layer.number("frictionFactor")});
        } else {
            const std::string type = layer.has("soilType") ? layer.word("soilType") : "sand";
            const std::array<double, 4> values = type == "clay"   ? std::array{0.4, 0.6, 0.03, 0.05}
                                                 : type == "silt" ? std::array{0.35, 0.6, 0.015, 0.02}
                                                                  : std::array{0.3, 0.6, 0.001, 0.003};
            tip.push_back({top, highest ? values[1] : values[0]});
            friction.push_back({top, highest ? values[3] : values[2]});
        }
        return top;
    });
    return [=](const Caisson& caisson) {
        return std::make_unique<ConeResistance>(
            caisson, ConeResistanceSoil{scaled(cone, tip, caisson.skirtLength),
                                        scaled(cone, friction, caisson.skirtLength), 0});
    };
}

MethodMaker readTable(const SoilSource& source)
{
    const KeywordReader reader(source.soil, tableKeywords, "'soil'", source.problems);
    const double weight = source.input.effectiveUnitWeight = reader.number("effectiveUnitWeight");
    readSeepage(reader, source.input.site);
    std::vector<double> penetration;
    std::vector<double> suction;
    for (const auto& row : readPairs(reader, "values", 2)) {
        penetration.push_back(row[0]);
        suction.push_back(row[1]);
    }
    return [=](const Caisson& caisson) {
        return std::make_unique<PrescribedSuction>(caisson, weight, penetration, suction);
    };
}

struct Method
{
    std::string_view name;
    MethodMaker (*read)(const SoilSource&);
    std::string_view noLayers; ///< why it takes no layers; empty where it does
};

constexpr std::array methods{
    Method{"houlsbyByrneSand", readSand,
           "its pore pressure factor and its enhanced stress hold for uniform sand only; dnv and "
           "houlsbyByrneClay take layers"},
    Method{"houlsbyByrneClay", readClay, ""},
    Method{
        "sendersRandolph",
        [](const SoilSource& source) {
            return readCriticalSuction(source, CriticalSuction::sendersRandolph);
        },
        "its critical suction holds for sand of one permeability; a cone resistance that changes with depth "
        "is given by coneResistanceProfile or coneResistanceFile"},
    Method{
        "feld", [](const SoilSource& source) { return readCriticalSuction(source, CriticalSuction::feld); },
        "its critical suction holds for sand of one permeability; a cone resistance that changes with depth "
        "is given by coneResistanceProfile or coneResistanceFile"},
    Method{"dnv", readDnv, ""},
    Method{"table", readTable, "the suction is prescribed"},
};

} // namespace

std::vector<std::string> installationMethods()
{
    std::vector<std::string> names;
    names.reserve(methods.size());
    for (const Method& method : methods)
        names.emplace_back(method.name);
    return names;
}

MethodMaker readSoil(const std::string& method, const Dictionary& soil,
                     const std::filesystem::path& caseDirectory, InputProblems& problems,
                     InstallationInput& input)
{
    const auto* const found = std::ranges::find(methods, method, &Method::name);
    if (found == methods.end())
        throw std::out_of_range("unknown installation method '" + method + "'");
    if (const Entry* layers = soil.find("layers"); layers != nullptr && !found->noLayers.empty()) {
        problems.add(layers->where, "method " + method + " takes no layers", std::string(found->noLayers));
        return {};
    }
    return found->read({soil, caseDirectory, problems, input});
}

std::vector<InstallationKeywords> soilKeywords()
{
    return {{"soil of houlsbyByrneSand", sandKeywords},
            {"soil of houlsbyByrneClay", clayKeywords},
            {"layers of houlsbyByrneClay", clayLayerKeywords},
            {"soil of sendersRandolph and feld", criticalSuctionKeywords},
            {"soil of dnv", dnvKeywords},
            {"layers of dnv", dnvLayerKeywords},
            {"coneResistanceFile", coneFileKeywords()},
            {"soil of table", tableKeywords}};
}

} // namespace caisson

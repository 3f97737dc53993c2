#include "constitutive/ConstitutiveLaw.h"

#include "constitutive/LinearElastic.h"
#include "constitutive/MohrCoulomb.h"
#include "constitutive/NeoHookean.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>

namespace caisson {
namespace {

constexpr Keyword youngsModulus{"youngsModulus", "Pa", "", "(0, inf)", "Young's modulus of the skeleton."};
constexpr Keyword poissonsRatio{"poissonsRatio", "-", "", "(-1, 0.5)", "Poisson's ratio of the skeleton."};

constexpr std::array elasticKeywords{youngsModulus, poissonsRatio};
constexpr std::array mohrCoulombKeywords{
    youngsModulus,
    poissonsRatio,
    Keyword{"frictionAngle", "deg", "", "[0, 90)", "Effective friction angle."},
    Keyword{"dilatancyAngle", "deg", "0", "(-90, 90)",
            "Dilatancy angle, at most the friction angle; negative for soil that contracts in shear."},
    Keyword{"cohesion", "Pa", "0", "[0, inf)",
            "Effective cohesion; with 0 the soil bears no tension at all."},
    Keyword{"gapClosing", "flag", "no", "",
            "Whether soil that opened in tension bears stress again only when the opening has closed."},
};
constexpr std::array trescaKeywords{
    youngsModulus,
    poissonsRatio,
    Keyword{"undrainedShearStrength", "Pa", "", "(0, inf)",
            "Half of the largest difference of two stresses."},
};

IsotropicElasticity elasticity(const KeywordReader& reader)
{
    return {reader.number("youngsModulus"), reader.number("poissonsRatio")};
}

std::unique_ptr<ConstitutiveLaw> makeLinearElastic(const KeywordReader& reader)
{
    return std::make_unique<LinearElastic>(elasticity(reader));
}

std::unique_ptr<ConstitutiveLaw> makeNeoHookean(const KeywordReader& reader)
{
    return std::make_unique<NeoHookean>(elasticity(reader));
}

/// With a problem in the input the run will stop: an elastic law then stands in, so that the reading can go
/// on.
std::unique_ptr<ConstitutiveLaw> makeMohrCoulomb(const KeywordReader& reader)
{
    constexpr double degree = std::numbers::pi / 180;
    const std::size_t before = reader.problems().all().size();
    const IsotropicElasticity elastic = elasticity(reader);
    const MohrCoulombStrength strength{reader.number("frictionAngle") * degree,
                                       reader.number("dilatancyAngle") * degree, reader.number("cohesion"),
                                       reader.flag("gapClosing")};
    if (reader.has("frictionAngle") && strength.dilatancyAngle > strength.frictionAngle)
        reader.problem("dilatancyAngle", "dilatancyAngle is larger than frictionAngle",
                       "plastic flow would create energy: choose a dilatancyAngle of at most frictionAngle");
    else if (reader.problems().all().size() == before && !MohrCoulombSurface(elastic, strength).wellPosed())
        reader.problem("dilatancyAngle",
                       "so negative a dilatancyAngle leaves the stress undefined at this poissonsRatio",
                       "raise dilatancyAngle or lower poissonsRatio");
    if (reader.problems().all().size() > before)
        return std::make_unique<LinearElastic>(elastic);
    return std::make_unique<MohrCoulomb>(elastic, strength);
}

std::unique_ptr<ConstitutiveLaw> makeTresca(const KeywordReader& reader)
{
    const std::size_t before = reader.problems().all().size();
    const IsotropicElasticity elastic = elasticity(reader);
    const MohrCoulombStrength strength{0, 0, reader.number("undrainedShearStrength")};
    if (reader.problems().all().size() > before)
        return std::make_unique<LinearElastic>(elastic);
    return std::make_unique<MohrCoulomb>(elastic, strength, "tresca");
}

struct Law
{
    std::string_view type;
    std::span<const Keyword> keywords;
    std::unique_ptr<ConstitutiveLaw> (*make)(const KeywordReader&);
};

constexpr std::array laws{
    Law{"linearElastic", elasticKeywords, makeLinearElastic},
    Law{"neoHookean", elasticKeywords, makeNeoHookean},
    Law{"mohrCoulomb", mohrCoulombKeywords, makeMohrCoulomb},
    Law{"tresca", trescaKeywords, makeTresca},
};

const Law& find(const std::string& type)
{
    const auto* const law =
        std::find_if(laws.begin(), laws.end(), [&](const Law& l) { return l.type == type; });
    if (law == laws.end())
        throw std::out_of_range("unknown constitutive law '" + type + "'");
    return *law;
}

} // namespace

std::vector<std::string> constitutiveLawTypes()
{
    std::vector<std::string> types;
    types.reserve(laws.size());
    for (const Law& law : laws)
        types.emplace_back(law.type);
    return types;
}

std::span<const Keyword> constitutiveLawKeywords(const std::string& type) { return find(type).keywords; }

std::unique_ptr<ConstitutiveLaw> makeConstitutiveLaw(const std::string& type, const KeywordReader& reader)
{
    return find(type).make(reader);
}

} // namespace caisson

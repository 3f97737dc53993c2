#include "constitutive/Material.h"

#include "constitutive/LinearElastic.h"

#include <algorithm>

namespace caisson {
namespace {

const std::string& lawWords()
{
    static const std::string words = [] {
        std::string joined;
        for (const std::string& type : constitutiveLawTypes())
            joined += (joined.empty() ? "" : " ") + type;
        return joined;
    }();
    return words;
}

std::vector<Keyword> generalKeywords()
{
    return {
        {"law", "word", "", lawWords(), "Constitutive law."},
        {"porosity", "-", "-", "(0, 1)",
         "Volume of the pores per volume. May be left out with weight dry: solidDensity is then that of the "
         "bulk."},
        {"solidDensity", "kg/m3", "", "(0, inf)", "Density of the grains."},
        {"liquidDensity", "kg/m3", "1000", "(0, inf)", "Density of the pore liquid."},
        {"weight", "word", "submerged", "submerged saturated dry",
         "What gravity acts on in one-phase soil: (1-n)(solidDensity-liquidDensity), the saturated density, "
         "or "
         "(1-n) solidDensity."},
        {"intrinsicPermeability", "m2", "-", "(0, inf)",
         "Intrinsic permeability, hydraulic conductivity times viscosity over unit weight; two-phase only."},
        {"permeabilityLaw", "word", "constant", "constant kozenyCarman",
         "Whether the permeability follows the porosity, as n^3/(1-n)^2, or not; two-phase only."},
        {"cavitationPressure", "Pa", "-", "(-inf, 0]",
         "Least pore pressure, in the measure of 0/p; none where left out; two-phase only."},
        {"liquidBulkModulus", "Pa", "2.2e9", "(0, inf)", "Bulk modulus of the pore liquid; two-phase only."},
        {"liquidViscosity", "Pa s", "1e-3", "(0, inf)",
         "Dynamic viscosity of the pore liquid; two-phase only."},
    };
}

/// Keys to check a material against whose law is missing or misspelt: the general ones and, so that they are
/// not called unknown, those of all laws.
std::vector<Keyword> keywordsOfAnyLaw()
{
    std::vector<Keyword> keywords = generalKeywords();
    for (const std::string& type : constitutiveLawTypes())
        for (Keyword keyword : constitutiveLawKeywords(type)) {
            keyword.defaultValue = "-";
            if (std::ranges::none_of(keywords, [&](const Keyword& k) { return k.name == keyword.name; }))
                keywords.push_back(keyword);
        }
    return keywords;
}

std::string writtenLaw(const Dictionary& dictionary)
{
    const Entry* entry = dictionary.find("law");
    return entry != nullptr && entry->tokens.size() == 1 ? entry->tokens.front().text : "";
}

Weight weightFromWord(const std::string& word)
{
    if (word == "saturated")
        return Weight::saturated;
    return word == "dry" ? Weight::dry : Weight::submerged;
}

Material readMaterial(const std::string& name, const Dictionary& dictionary, InputProblems& problems)
{
    const std::string type = writtenLaw(dictionary);
    const bool known = std::ranges::count(constitutiveLawTypes(), type) > 0;
    const std::vector<Keyword> keywords = known ? materialKeywords(type) : keywordsOfAnyLaw();
    const KeywordReader reader(dictionary, keywords, "'" + name + "'", problems);

    Material material;
    material.name = name;
    material.weight = weightFromWord(reader.word("weight"));
    if (reader.has("porosity"))
        material.porosity = reader.number("porosity");
    else if (material.weight != Weight::dry)
        reader.problem("porosity", "missing key 'porosity' in '" + name + "'");
    material.solidDensity = reader.number("solidDensity");
    material.liquidDensity = reader.number("liquidDensity");
    if (material.weight == Weight::submerged && material.solidDensity <= material.liquidDensity &&
        material.solidDensity > 0)
        reader.problem("solidDensity", "'" + name + "' is not heavier than its liquid",
                       "check solidDensity and liquidDensity, or choose weight saturated or dry");
    if (reader.has("intrinsicPermeability"))
        material.intrinsicPermeability = reader.number("intrinsicPermeability");
    material.kozenyCarman = reader.word("permeabilityLaw") == "kozenyCarman";
    if (reader.has("cavitationPressure"))
        material.cavitationPressure = reader.number("cavitationPressure");
    material.liquidBulkModulus = reader.number("liquidBulkModulus");
    material.liquidViscosity = reader.number("liquidViscosity");
    if (known)
        material.law = makeConstitutiveLaw(type, reader);
    else {
        (void)reader.word("law"); // reports the missing or unknown word
        material.law = std::make_unique<LinearElastic>(IsotropicElasticity{});
    }
    return material;
}

} // namespace

double Material::inertialDensity() const
{
    const double dry = (1 - porosity) * solidDensity;
    return weight == Weight::dry ? dry : dry + porosity * liquidDensity;
}

double Material::weighingDensity() const
{
    return weight == Weight::submerged ? (1 - porosity) * (solidDensity - liquidDensity) : inertialDensity();
}

std::vector<Keyword> materialKeywords(const std::string& type)
{
    std::vector<Keyword> keywords = generalKeywords();
    const std::span<const Keyword> own = constitutiveLawKeywords(type);
    keywords.insert(keywords.end(), own.begin(), own.end());
    return keywords;
}

std::vector<Material> readMaterials(const Dictionary& materialProperties, InputProblems& problems)
{
    std::vector<Material> materials;
    for (const Entry& entry : materialProperties.entries()) {
        if (entry.keyword == "FoamFile")
            continue;
        if (entry.dictionary)
            materials.push_back(readMaterial(entry.keyword, *entry.dictionary, problems));
        else if (!materialProperties.usedAsMacro(entry.keyword))
            problems.add(entry.where, "'" + entry.keyword + "' is not a material",
                         "a material is a sub-dictionary: " + entry.keyword + " { law ...; ... }");
    }
    if (materials.empty())
        problems.add(materialProperties.where(), "no material is defined",
                     "a material is a sub-dictionary: sand { law mohrCoulomb; ... }");
    return materials;
}

} // namespace caisson

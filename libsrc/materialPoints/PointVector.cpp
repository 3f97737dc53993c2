#include "materialPoints/PointVector.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace caisson {

namespace {

constexpr std::array<Keyword, 3> keywords{{
    {"definitions", "dictionary", "-", "",
     "names for numbers and expressions, each of those before it: { A 0.1; f \"A*sin(10*t)\"; }"},
    {"r", "expression", "", "",
     "component along r (plane strain: along x), of r z R Z t and the definitions"},
    {"z", "expression", "", "", "component along z, likewise"},
}};

/// Text of an expression: a number, a word, or a string in quotes; empty, and a problem, where it is not.
std::string expressionText(const Entry& entry, InputProblems& problems)
{
    if (!entry.dictionary && entry.tokens.size() == 1 && entry.tokens[0].kind != Token::Kind::punctuation &&
        entry.tokens[0].kind != Token::Kind::binary) {
        return entry.tokens[0].text;
    }
    problems.add(entry.where, "'" + entry.keyword + "' is not one expression",
                 "put it in quotes: " + entry.keyword + " \"0.1*R*sin(10*t)\";");
    return {};
}

} // namespace

std::vector<Keyword> pointVectorKeywords() { return {keywords.begin(), keywords.end()}; }

PointVector readPointVector(const KeywordReader& reader, std::string_view what)
{
    InputProblems& problems = reader.problems();
    Expressions expressions({{"r", false}, {"z", false}, {"R", false}, {"Z", false}, {"t", true}});
    const std::size_t before = problems.all().size();
    const auto take = [&](const Entry& entry, const auto& use) {
        const std::string text = expressionText(entry, problems);
        if (text.empty()) {
            return;
        }
        try {
            use(text);
        } catch (const std::invalid_argument& error) {
            problems.add(entry.where, "'" + entry.keyword + "' of " + std::string(what) + ": " + error.what(),
                         "known are r z (place), R Z (initial place), t, the definitions above, pi() and the "
                         "functions of #eval");
        }
    };
    if (const Dictionary* definitions = reader.dictionary("definitions")) {
        for (const Entry& entry : definitions->entries()) {
            take(entry, [&](const std::string& text) { expressions.define(entry.keyword, text); });
            if (problems.all().size() > before) { // what follows from a mistake is none
                return {};
            }
        }
    }
    for (const std::string_view key : {"r", "z"}) {
        if (const Entry* entry = reader.entry(key)) {
            take(*entry, [&](const std::string& text) { expressions.addResult(text); });
        }
    }
    PointVector result;
    if (problems.all().size() == before) {
        result.expressions_ = std::make_shared<const Expressions>(std::move(expressions));
    }
    return result;
}

PointVector::Workspace PointVector::workspace() const
{
    Workspace workspace;
    if (given()) {
        workspace.inputs.resize(std::size_t{2} * Expressions::block);
        workspace.registers.resize(expressions_->workspaceSize());
    }
    return workspace;
}

void PointVector::evaluate(const MaterialPoints& points, int begin, int end, double time, double lead,
                           double* r, double* z, Workspace& workspace) const
{
    double* const placeR = workspace.inputs.data();
    double* const placeZ = placeR + Expressions::block;
    for (int p = begin; p < end; p += Expressions::block) {
        const int count = std::min(Expressions::block, end - p);
        for (int i = 0; i < count; ++i) {
            placeR[i] = points.r[p + i] + lead * points.vr[p + i];
            placeZ[i] = points.z[p + i] + lead * points.vz[p + i];
        }
        const double* const variables[] = {placeR, placeZ, points.initialR.data() + p,
                                           points.initialZ.data() + p, &time};
        double* const results[] = {r + (p - begin), z + (p - begin)};
        expressions_->evaluate(variables, count, results, workspace.registers);
    }
}

} // namespace caisson

#include "dictionary/InputProblems.h"

#include <algorithm>
#include <numeric>

namespace caisson {

InputError::InputError(std::string_view subject, std::vector<InputProblem> problems)
    : std::runtime_error(formatProblems(subject, problems)), problems_(std::move(problems))
{
}

void InputProblems::add(SourceLocation where, std::string message, std::string hint)
{
    problems_.push_back({std::move(where), std::move(message), std::move(hint)});
}

void InputProblems::throwIfAny(std::string_view subject) const
{
    if (problems_.empty()) {
        return;
    }
    std::vector<InputProblem> sorted = problems_;
    std::ranges::stable_sort(sorted, [](const InputProblem& a, const InputProblem& b) {
        return a.where.file != b.where.file ? a.where.file < b.where.file : a.where.line < b.where.line;
    });
    throw InputError(subject, std::move(sorted));
}

std::string formatProblems(std::string_view subject, const std::vector<InputProblem>& problems)
{
    std::string report = "--> CAISSONFOAM FATAL ERROR : " + std::to_string(problems.size()) +
                         (problems.size() == 1 ? " problem in " : " problems in ") + std::string(subject) +
                         "\n";
    for (const InputProblem& problem : problems) {
        report += '\n';
        if (!problem.where.file.empty()) {
            report += problem.where.file;
            report += problem.where.line > 0 ? ":" + std::to_string(problem.where.line) + ": " : ": ";
        }
        report += problem.message + '\n';
        if (!problem.hint.empty()) {
            report += "    " + problem.hint + '\n';
        }
    }
    return report;
}

namespace {

/// Edits (insert, remove, replace, swap of neighbours) from one word to the other, capitals free of charge.
std::size_t editDistance(std::string_view a, std::string_view b)
{
    const auto same = [](char x, char y) {
        return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
    };
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                d[i][j] = i + j;
                continue;
            }
            d[i][j] = std::min(
                {d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1)});
            if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1])) {
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
            }
        }
    }
    return d[a.size()][b.size()];
}

} // namespace

std::string nearestWord(std::string_view word, const std::vector<std::string>& valid)
{
    std::string nearest;
    std::size_t shortest = word.size() < 4 ? 2 : 2 + word.size() / 4; // at most this many edits, exclusive
    if (word.size() > 200) {
        return nearest;
    }
    for (const std::string& candidate : valid) {
        const std::size_t distance = editDistance(word, candidate);
        if (distance < shortest) {
            shortest = distance;
            nearest = candidate;
        }
    }
    return nearest;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& valid, std::string_view what)
{
    std::string hint;
    if (const std::string near = nearestWord(word, valid); !near.empty()) {
        hint = "did you mean '" + near + "'?  ";
    }
    std::vector<std::string> sorted = valid;
    std::ranges::sort(sorted);
    hint += "valid";
    if (!what.empty()) {
        hint += " " + std::string(what);
    }
    hint += ":";
    for (const std::string& candidate : sorted) {
        hint += " " + candidate;
    }
    return hint;
}

} // namespace caisson

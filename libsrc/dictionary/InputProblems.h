#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace caisson {

/// Where something stands in a file that the user wrote.
struct SourceLocation
{
    std::string file; ///< path as the user would type it, relative to the case where possible
    int line = 0;     ///< from 1; 0 where a line makes no sense (a missing file)
};

/// One problem of the input: where, what is wrong, and what would be right.
struct InputProblem
{
    SourceLocation where;
    std::string message; ///< one line, starts in lower case, no full stop
    std::string hint;    ///< may be empty; "did you mean 'frictionAngle'?  valid keys: ..."
};

/// Wrong input. The one exception type that a user's mistake ends in; carries every problem found.
class InputError : public std::runtime_error
{
public:
    /// @param subject  what was being read, e.g. "case tutorials/caisson/jackedInstallation"
    InputError(std::string_view subject, std::vector<InputProblem> problems);
    [[nodiscard]] const std::vector<InputProblem>& problems() const { return problems_; }

private:
    std::vector<InputProblem> problems_;
};

/// Collects the problems of a case, so that all of them are reported in one run.
class InputProblems
{
public:
    void add(SourceLocation where, std::string message, std::string hint = {});
    [[nodiscard]] bool empty() const { return problems_.empty(); }
    [[nodiscard]] const std::vector<InputProblem>& all() const { return problems_; }
    /// @throws InputError with everything collected so far, in the order of file and line
    void throwIfAny(std::string_view subject) const;

private:
    std::vector<InputProblem> problems_;
};

/// The report that a user sees:
/// "--> CAISSONFOAM FATAL ERROR : 3 problems in <subject>" and a paragraph for each (doc: etc/errors).
std::string formatProblems(std::string_view subject, const std::vector<InputProblem>& problems);

/// The valid word nearest to `word` by edit distance, or "" where none is near.
std::string nearestWord(std::string_view word, const std::vector<std::string>& valid);

/// "did you mean 'x'?  valid <what>: a b c" (the first half only where a word is near).
std::string suggestion(std::string_view word, const std::vector<std::string>& valid, std::string_view what);

} // namespace caisson

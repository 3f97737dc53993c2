#pragma once

#include "dictionary/KeywordReader.h"

#include <memory>

namespace caisson {

/// A function of one variable (time [s], or a body's penetration [m]) given in a dictionary.
class Function1
{
public:
    virtual ~Function1() = default;
    /// @throws InputError beyond the ends of a table with outOfBounds error
    [[nodiscard]] virtual double value(double x) const = 0;
    /// Largest x up to which the function is defined (tables with outOfBounds error); infinity otherwise.
    [[nodiscard]] virtual double end() const;
};

std::unique_ptr<Function1> constantFunction1(double value);

/// Reads `key` of `dictionary` in any of the spellings of OpenFOAM v1912 and v2406: bare number, inline
/// `table ((x y) ...)`, `key tableFile; keyCoeffs {}`, in-place `key { type table; values (...); }`.
/// Files are sought as Dictionary::filePath says. Unknown types and keys, missing files and bad values become
/// problems; then a constant zero is returned.
std::unique_ptr<Function1> readFunction1(const Dictionary& dictionary, std::string_view key,
                                         InputProblems& problems);

/// A vector-valued one: components share the variable. Accepts a vector `(0 0 -1)`, `constant (0 0 -1)`,
/// `table ((0 (0 0 0)) (1 (0 0 -1)))` and in-place dictionaries.
struct VectorFunction1
{
    std::array<std::unique_ptr<Function1>, 3> component;
    [[nodiscard]] std::array<double, 3> value(double x) const;
};
VectorFunction1 readVectorFunction1(const Dictionary& dictionary, std::string_view key,
                                    InputProblems& problems);

/// Type words, and the keys of a type's dictionary, for the user guide.
std::vector<std::string> function1Types();
std::vector<Keyword> function1Keywords(const std::string& type);

} // namespace caisson

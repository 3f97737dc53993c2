#pragma once

#include "dictionary/Dictionary.h"
#include "dictionary/Expression.h"
#include "dictionary/KeywordReader.h"
#include "materialPoints/MaterialPoints.h"

#include <memory>

namespace caisson {

/// A vector (r z) at material points, as expressions of their place r z, their initial place R Z and the time
/// t; in plane strain r and R stand for x.
class PointVector
{
public:
    /// Room for one thread's evaluation, so that a step allocates nothing.
    struct Workspace
    {
        std::vector<double> inputs, registers;
    };

    [[nodiscard]] bool given() const { return expressions_ != nullptr; }
    [[nodiscard]] Workspace workspace() const;

    /// At points begin to end - 1. @param lead  [s] that places are ahead of those of the points, by velocity
    void evaluate(const MaterialPoints& points, int begin, int end, double time, double lead, double* r,
                  double* z, Workspace& workspace) const;

private:
    friend PointVector readPointVector(const KeywordReader&, std::string_view);
    std::shared_ptr<const Expressions> expressions_;
};

/// Keys of a vector, for reading and the user guide.
std::vector<Keyword> pointVectorKeywords();
/// Reads `definitions { A 0.1; f "A*sin(10*t)"; } r "f*R"; z 0;`, keys of the reader's table.
/// @param what  how messages call the dictionary
PointVector readPointVector(const KeywordReader& reader, std::string_view what);

} // namespace caisson

// Where the code stays stable: prints, as tables of tab-separated columns, what becomes of small hostile
// scenes.
//
// Usage: stabilityMap matrix [sweep]     every square of the map, or those whose sweep contains a text
//        stabilityMap limits             the true limit of the step against its estimate
//        stabilityMap long [share]       long runs, or a share of them

#include "Limits.h"
#include "LongRuns.h"
#include "Matrix.h"

#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace {

using namespace caisson::stability;

double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// @returns the number of squares that are not as they have to be
int printMatrix(const std::string& wanted)
{
    int failures = 0;
    std::puts("sweep\tvalue\tkernel\tverdict\texpected\tseconds\tremark");
    for (const Case& square : stabilityMatrix()) {
        if (square.sweep.find(wanted) == std::string::npos) {
            continue;
        }
        const double start = processorSeconds();
        const Outcome outcome = outcomeOf(square.run);
        const bool content = square.content(outcome);
        failures += !content;
        std::printf("%s\t%s\t%s\t%s\t%s\t%.2f\t%s\n", square.sweep.c_str(), square.value.c_str(),
                    square.kernel.c_str(), name(outcome.verdict).c_str(), content ? "yes" : "no",
                    processorSeconds() - start, outcome.remark.c_str());
        std::fflush(stdout);
    }
    return failures;
}

int printLimits()
{
    int failures = 0;
    std::puts("kernel\tcells\tdrag\tsurface\testimate\ttruth\testimate/truth");
    for (Limit& limit : limitScenes()) {
        findLimit(limit);
        failures += !(limit.share() <= 1 && limit.share() >= 0.75);
        std::printf("%s\t%s\t%s\t%s\t%.4g\t%.4g\t%.3f\n", limit.kernel.c_str(), limit.cells.c_str(),
                    limit.drag.c_str(), limit.surface.c_str(), limit.estimate, limit.truth, limit.share());
        std::fflush(stdout);
    }
    return failures;
}

int printLongRuns(double share)
{
    int failures = 0;
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    std::puts("run\tverdict\tseconds\tfigures");
    for (const LongRun& run : longRuns()) {
        const double start = processorSeconds();
        const Outcome outcome = outcomeOf([&] { return run.run(share); });
        failures += outcome.verdict != Verdict::holds;
        std::printf("%s\t%s\t%.1f\t%s\n", run.name.c_str(), name(outcome.verdict).c_str(),
                    processorSeconds() - start, outcome.remark.c_str());
        std::fflush(stdout);
    }
    return failures;
}

} // namespace

int main(int argc, char* argv[])
{
    const std::string what = argc > 1 ? argv[1] : "";
    if (what == "matrix") {
        return printMatrix(argc > 2 ? argv[2] : "") == 0 ? 0 : 1;
    }
    if (what == "limits") {
        return printLimits() == 0 ? 0 : 1;
    }
    if (what == "long") {
        return printLongRuns(argc > 2 ? std::atof(argv[2]) : 1.0) == 0 ? 0 : 1;
    }
    std::fputs("Usage: stabilityMap matrix [sweep] | limits | long [share]\n", stderr);
    return 2;
}

#include "bodies/FreeSurface.h"

#include <algorithm>
#include <cmath>

namespace caisson {

namespace {

constexpr Keyword keywords[] = {
    {"region", "word", "all", "all inside outside",
     "the soil surfaces meant: all, those inside the walls of the body, or those outside"},
    {"body", "word", "-", "", "name of the body, for region inside or outside and variable penetration"},
    {"level", "m", "0", "", "height at which the hydrostatic part rho_w g (level - z) is zero"},
    {"pressure", "Function1", "-", "", "added to the hydrostatic part [Pa], zero if left out"},
    {"suction", "Function1", "-", "", "taken from it [Pa], zero if left out; not together with pressure"},
    {"pumpFlow", "Function1", "-", "",
     "water that a pump takes out of the closed void of region inside [m3/s], of time: the suction is then a "
     "result"},
    {"seepageFlow", "Function1", "-", "",
     "seepage that leaves the soil through a covered surface [m3/s], of time; 0: impermeable"},
    {"compliance", "m3/Pa", "1e-8", "(0, inf)",
     "volume of water that a change of pressure takes up in the void or below the cover, for pumpFlow and "
     "seepageFlow; 1e-8 is 20 m3 of water"},
    {"sealedFrom", "s", "0", "[0, inf)",
     "time until which the surface is open, for pumpFlow and seepageFlow"},
    {"variable", "word", "time", "time penetration",
     "what pressure or suction is a function of [s or m]; penetration is that of the body"},
};

/// Minus another function.
class Negative final : public Function1
{
public:
    explicit Negative(std::unique_ptr<Function1> function) : function_(std::move(function)) {}
    [[nodiscard]] double value(double x) const override { return -function_->value(x); }
    [[nodiscard]] double end() const override { return function_->end(); }

private:
    std::unique_ptr<Function1> function_;
};

} // namespace

int freeSurfaceAt(const std::vector<FreeSurface>& surfaces, const std::vector<RigidBody>& bodies,
                  double radius)
{
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        if (surfaces[s].region == FreeSurface::Region::all) {
            return static_cast<int>(s);
        }
        for (const RigidBody& body : bodies) {
            const bool inside = std::abs(radius) < body.innerRadius();
            if (body.name == surfaces[s].body &&
                inside == (surfaces[s].region == FreeSurface::Region::inside)) {
                return static_cast<int>(s);
            }
        }
    }
    return -1;
}

bool overWall(const std::vector<RigidBody>& bodies, double radius)
{
    return std::ranges::any_of(bodies, [&](const RigidBody& body) {
        double outer = 0;
        for (const ProfileEdge& edge : body.profile) {
            outer = std::max(outer, edge.from[0]);
        }
        return body.innerRadius() > 0 && std::abs(radius) > body.innerRadius() && std::abs(radius) < outer;
    });
}

double excessPressure(const FreeSurface& surface, const std::vector<RigidBody>& bodies, double time,
                      double unitWeight)
{
    double pressure = -unitWeight * surface.level;
    if (surface.pressure) {
        double x = time;
        for (const RigidBody& body : bodies) {
            if (surface.variable == FreeSurface::Variable::penetration && body.name == surface.body) {
                x = body.penetration();
            }
        }
        pressure += surface.pressure->value(x);
    }
    return pressure;
}

std::span<const Keyword> freeSurfaceKeywords() { return keywords; }

std::vector<FreeSurface> readFreeSurfaces(const Dictionary& freeSurfaces,
                                          const std::vector<std::string>& bodies, InputProblems& problems)
{
    std::vector<FreeSurface> surfaces;
    for (const Entry& entry : freeSurfaces.entries()) {
        if (!entry.dictionary) {
            problems.add(entry.where, "'" + entry.keyword + "' of freeSurfaces is no dictionary",
                         "plug { region inside; body caisson; suction 10e3; }");
            continue;
        }
        const KeywordReader reader(*entry.dictionary, keywords, "free surface '" + entry.keyword + "'",
                                   problems);
        FreeSurface surface;
        surface.name = entry.keyword;
        const std::string region = reader.word("region");
        surface.region = region == "inside"    ? FreeSurface::Region::inside
                         : region == "outside" ? FreeSurface::Region::outside
                                               : FreeSurface::Region::all;
        surface.level = reader.number("level");
        surface.variable = reader.word("variable") == "penetration" ? FreeSurface::Variable::penetration
                                                                    : FreeSurface::Variable::time;
        if (reader.has("body")) {
            surface.body = reader.word("body");
            if (std::ranges::find(bodies, surface.body) == bodies.end()) {
                reader.problem("body", "there is no body '" + surface.body + "'",
                               suggestion(surface.body, bodies, "bodies"));
            }
        } else if (surface.region != FreeSurface::Region::all ||
                   surface.variable == FreeSurface::Variable::penetration) {
            reader.problem("body", "free surface '" + surface.name + "' needs 'body'",
                           "region inside and outside, and variable penetration, are those of a body");
        }
        if (reader.has("pressure") && reader.has("suction")) {
            reader.problem("suction", "free surface '" + surface.name + "' has a pressure and a suction",
                           "suction is a negative pressure: keep one of them");
        }
        if (reader.has("pressure")) {
            surface.pressure = readFunction1(*entry.dictionary, "pressure", problems);
        } else if (reader.has("suction")) {
            surface.pressure =
                std::make_shared<Negative>(readFunction1(*entry.dictionary, "suction", problems));
        }
        if (reader.has("pumpFlow")) {
            surface.pumpFlow = readFunction1(*entry.dictionary, "pumpFlow", problems);
            if (surface.region != FreeSurface::Region::inside) {
                reader.problem("pumpFlow", "free surface '" + surface.name + "' is not that of a closed void",
                               "region inside; body caisson;");
            }
        }
        if (reader.has("seepageFlow")) {
            surface.seepageFlow = readFunction1(*entry.dictionary, "seepageFlow", problems);
            if (surface.pumpFlow) {
                reader.problem("seepageFlow", "free surface '" + surface.name + "' has two flows",
                               "pumpFlow for a closed void, seepageFlow for a covered surface: keep one");
            }
        }
        surface.compliance = reader.number("compliance");
        surface.sealedFrom = reader.number("sealedFrom");
        surfaces.push_back(std::move(surface));
    }
    return surfaces;
}

} // namespace caisson

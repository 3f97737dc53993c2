#include "bodies/RigidBody.h"

#include <algorithm>
#include <cmath>

namespace caisson {

namespace {

/// Half a cosine: no jump of velocity or acceleration, which would send a wave through the soil.
double rampShare(double time, double ramp)
{
    return (ramp > 0 && time < ramp) ? 0.5 * (1 - std::cos(M_PI * time / ramp)) : 1.0;
}

} // namespace

double RigidBody::drivingLoad(double time) const
{
    return rampShare(time, ramp) * submergedWeight + (load ? load->value(time) : 0);
}

double RigidBody::prescribedVelocity(double time) const
{
    if (!penetrationRate) {
        return 0;
    }
    const double rate = penetrationRate->value(variable == Variable::time ? time : penetration());
    return -rate * rampShare(time, ramp);
}

double RigidBody::innerRadius() const
{
    double radius = 0;
    for (const ProfileEdge& edge : profile) {
        if (edge.part == SurfacePart::inner && (radius == 0 || edge.from[0] < radius)) {
            radius = edge.from[0];
        }
    }
    return radius;
}

bool RigidBody::contains(double r, double z) const
{
    const double height = z - tipLevel;
    bool inside = false;
    for (const ProfileEdge& edge : profile) {
        const auto& a = edge.from;
        const auto& b = edge.to;
        if ((a[1] > height) != (b[1] > height) &&
            r < a[0] + (b[0] - a[0]) * (height - a[1]) / (b[1] - a[1])) {
            inside = !inside;
        }
    }
    return inside;
}

std::vector<ProfileEdge> profileFromPolygon(std::vector<std::array<double, 2>> polygon)
{
    double doubleArea = 0;
    double lowest = polygon.front()[1];
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const auto& a = polygon[i];
        const auto& b = polygon[(i + 1) % polygon.size()];
        doubleArea += a[0] * b[1] - b[0] * a[1];
        lowest = std::min(lowest, a[1]);
    }
    if (doubleArea < 0) {
        std::reverse(polygon.begin(), polygon.end());
    }
    std::vector<ProfileEdge> edges;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        std::array<double, 2> a = polygon[i];
        std::array<double, 2> b = polygon[(i + 1) % polygon.size()];
        a[1] -= lowest;
        b[1] -= lowest;
        const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
        if (length == 0 || (a[0] == 0 && b[0] == 0)) {
            continue; // a piece along the axis is no surface
        }
        const std::array<double, 2> normal{(b[1] - a[1]) / length, -(b[0] - a[0]) / length};
        SurfacePart part = SurfacePart::lid;
        if (normal[1] < -0.1) {
            part = SurfacePart::tip;
        } else if (std::abs(normal[0]) > 0.5) {
            part = normal[0] < 0 ? SurfacePart::inner : SurfacePart::outer;
        }
        edges.push_back({a, b, normal, part});
    }
    return edges;
}

std::vector<ProfileEdge> caissonProfile(double outerRadius, double wallThickness, double skirtLength,
                                        double lidHeight, double lidThickness)
{
    const double innerRadius = outerRadius - wallThickness;
    if (lidHeight <= 0) {
        return profileFromPolygon(
            {{innerRadius, 0}, {outerRadius, 0}, {outerRadius, skirtLength}, {innerRadius, skirtLength}});
    }
    auto edges = profileFromPolygon({{innerRadius, 0},
                                     {outerRadius, 0},
                                     {outerRadius, lidHeight + lidThickness},
                                     {0, lidHeight + lidThickness},
                                     {0, lidHeight},
                                     {innerRadius, lidHeight}});
    for (ProfileEdge& edge : edges) { // the lower face of the lid looks down as the tip does
        if (edge.part == SurfacePart::tip && edge.from[1] > 0) {
            edge.part = SurfacePart::lid;
        }
    }
    return edges;
}

namespace {

// Keys that every body has, whatever its shape.
constexpr Keyword commonKeywords[] = {
    {"shape", "word", "", "caisson polygon", "how the profile is given"},
    {"tipLevel", "m", "", "(-inf, inf)", "z of the lowest point, as constant/polyMesh has it"},
    {"surfaceLevel", "m", "0", "(-inf, inf)", "z that penetration is measured from"},
    {"friction", "-", "0", "[0, inf)", "friction coefficient mu = tan(delta) of the interface"},
    {"adhesion", "Pa", "0", "[0, inf)", "adhesion of the interface"},
    {"tipCorner", "word", "rounded", "full shared rounded", "treatment of the corner nodes of the tip"},
    {"motion", "word", "prescribed", "prescribed load",
     "prescribed: at penetrationRate; load: by its weight, load and suction against the soil's reaction"},
    {"penetrationRate", "Function1", "-", "", "downward velocity [m/s]; the body is at rest without it"},
    {"variable", "word", "time", "time penetration", "what penetrationRate is a function of [s or m]"},
    {"ramp", "s", "0.05", "[0, inf)", "time over which the rate, or the weight, rises from rest"},
    {"submergedWeight", "N", "-", "[0, inf)",
     "weight of the whole body under water (plane strain: per metre); motion load needs it"},
    {"mass", "kg", "-", "(0, inf)",
     "inertia of the whole body, water that moves with it included; motion load needs it"},
    {"restTime", "s", "0", "[0, inf)",
     "motion load: the run ends where the body moves less than restPenetration in this time; 0 is never"},
    {"restPenetration", "m", "0.001", "(0, inf)", "see restTime"},
    {"load", "Function1", "-", "", "downward force besides the weight [N], of time; motion load only"},
};
constexpr Keyword caissonKeywords[] = {
    {"outerRadius", "m", "", "(0, inf)", "outer radius of the skirt"},
    {"wallThickness", "m", "", "(0, inf)", "thickness of the skirt"},
    {"skirtLength", "m", "", "(0, inf)", "length of the skirt"},
    {"lid", "m", "-", "(0, inf)", "height of the lid's lower face above the tip; no lid without it"},
    {"lidThickness", "m", "0.1", "(0, inf)", "thickness of the lid"},
    {"stopAtLid", "flag", "yes", "", "whether the run ends where the soil meets the lid"},
};
constexpr Keyword polygonKeywords[] = {
    {"profile", "list", "", "", "corners ((r z) (r z) ...) of the closed profile, any reference height [m]"},
    {"referenceLength", "m", "1", "(0, inf)", "length that penetration is normalised with in output"},
};

} // namespace

std::vector<std::string> bodyShapes() { return {"caisson", "polygon"}; }

std::vector<Keyword> bodyKeywords(const std::string& shape)
{
    std::vector<Keyword> table(std::begin(commonKeywords), std::end(commonKeywords));
    if (shape == "polygon") {
        table.insert(table.end(), std::begin(polygonKeywords), std::end(polygonKeywords));
    } else {
        table.insert(table.end(), std::begin(caissonKeywords), std::end(caissonKeywords));
    }
    return table;
}

std::vector<RigidBody> readBodies(const Dictionary& bodies, InputProblems& problems)
{
    std::vector<RigidBody> result;
    for (const Entry& entry : bodies.entries()) {
        if (entry.keyword == "FoamFile" || !entry.dictionary) {
            if (!entry.dictionary && !bodies.usedAsMacro(entry.keyword)) {
                problems.add(entry.where, "'" + entry.keyword + "' is not a body",
                             "a body is a sub-dictionary: " + entry.keyword + " { shape caisson; ... }");
            }
            continue;
        }
        const Entry* shapeEntry = entry.dictionary->find("shape");
        const std::string shape = shapeEntry && !shapeEntry->tokens.empty() ? shapeEntry->tokens[0].text : "";
        const std::vector<Keyword> table = bodyKeywords(shape);
        const KeywordReader reader(*entry.dictionary, table, "'" + entry.keyword + "'", problems);

        RigidBody body;
        body.name = entry.keyword;
        body.tipLevel = body.initialTipLevel = reader.number("tipLevel");
        body.surfaceLevel = reader.number("surfaceLevel");
        body.friction = reader.number("friction");
        body.adhesion = reader.number("adhesion");
        const std::string corner = reader.word("tipCorner");
        body.tipCorner = corner == "full"     ? TipCorner::full
                         : corner == "shared" ? TipCorner::shared
                                              : TipCorner::rounded;
        body.variable = reader.word("variable") == "penetration" ? RigidBody::Variable::penetration
                                                                 : RigidBody::Variable::time;
        body.ramp = reader.number("ramp");
        body.loadControlled = reader.word("motion") == "load";
        for (const char* key : {"submergedWeight", "mass"}) {
            if (body.loadControlled && !reader.has(key)) {
                reader.problem(key, "'" + entry.keyword + "' has motion load, but no " + key,
                               std::string(key) == "mass" ? "the weight over g, at least" : "");
            } else if (!body.loadControlled && reader.has(key)) {
                reader.problem(key, std::string(key) + " of '" + entry.keyword + "' has no effect",
                               "motion load;");
            }
        }
        if (body.loadControlled) {
            body.submergedWeight = reader.has("submergedWeight") ? reader.number("submergedWeight") : 0;
            body.mass = reader.has("mass") ? reader.number("mass") : 1;
        }
        body.restTime = reader.number("restTime");
        body.restPenetration = reader.number("restPenetration");
        if (reader.has("load")) {
            body.load = readFunction1(*entry.dictionary, "load", problems);
            if (!body.loadControlled) {
                reader.problem("load", "load of '" + entry.keyword + "' has no effect", "motion load;");
            }
        }
        if (body.loadControlled && reader.has("penetrationRate")) {
            reader.problem("penetrationRate",
                           "'" + entry.keyword + "' moves by its loads: penetrationRate has no effect",
                           "motion prescribed; or leave penetrationRate out");
        }
        if (reader.has("penetrationRate")) {
            body.penetrationRate = readFunction1(*entry.dictionary, "penetrationRate", problems);
        }
        if (reader.word("shape") == "polygon") {
            std::vector<std::array<double, 2>> corners;
            for (const auto& row : reader.rows("profile")) {
                if (row.size() != 2) {
                    reader.problem("profile",
                                   "a corner of 'profile' has " + std::to_string(row.size()) + " numbers",
                                   "write ((r z) (r z) ...)");
                    break;
                }
                corners.push_back({row[0], row[1]});
            }
            body.referenceLength = reader.number("referenceLength");
            if (corners.size() < 3) {
                reader.problem("profile", "a profile needs at least three corners");
            } else {
                body.profile = profileFromPolygon(corners);
            }
        } else {
            body.stopAtLid = reader.flag("stopAtLid");
            const double outerRadius = reader.number("outerRadius");
            const double wallThickness = reader.number("wallThickness");
            body.referenceLength = reader.number("skirtLength");
            if (wallThickness >= outerRadius && outerRadius > 0) {
                reader.problem("wallThickness", "wallThickness is not smaller than outerRadius");
            } else {
                body.profile = caissonProfile(outerRadius, wallThickness, body.referenceLength,
                                              reader.has("lid") ? reader.number("lid") : 0.0,
                                              reader.number("lidThickness"));
            }
        }
        result.push_back(std::move(body));
    }
    return result;
}

} // namespace caisson

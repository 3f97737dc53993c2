#include "materialPoints/PointLoads.h"

#include "dictionary/Text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace caisson {

namespace {

constexpr std::string_view typeWords = "traction pressure force expression";
constexpr std::string_view faceWords = "top bottom inner outer any all";

/// One of the words of a Keyword's range.
std::vector<std::string> split(std::string_view words)
{
    std::vector<std::string> result(1);
    for (const char c : words) {
        if (c == ' ') {
            result.emplace_back();
        } else {
            result.back() += c;
        }
    }
    return result;
}

PointLoad::Type typeOf(std::string_view word)
{
    return word == "pressure"     ? PointLoad::Type::pressure
           : word == "force"      ? PointLoad::Type::force
           : word == "expression" ? PointLoad::Type::expression
                                  : PointLoad::Type::traction;
}

LoadedSurface::Face faceOf(std::string_view word)
{
    using Face = LoadedSurface::Face;
    return word == "top"      ? Face::top
           : word == "bottom" ? Face::bottom
           : word == "inner"  ? Face::inner
           : word == "outer"  ? Face::outer
           : word == "all"    ? Face::all
                              : Face::any;
}

/// Whether an outward normal looks towards the face, to within 45 degrees.
bool looksTo(LoadedSurface::Face face, double normalR, double normalZ)
{
    using Face = LoadedSurface::Face;
    const double along = face == Face::top      ? normalZ
                         : face == Face::bottom ? -normalZ
                         : face == Face::inner  ? -normalR
                         : face == Face::outer  ? normalR
                                                : 1;
    return along > std::numbers::sqrt2 / 2 - 1e-9;
}

/// Shares the surface of the soil out to the points.
class SurfaceShares
{
public:
    SurfaceShares(const MaterialPoints& points, const BackgroundMesh& mesh)
        : points_(points), mesh_(mesh), inCell_(mesh.cells())
    {
        for (std::size_t p = 0; p < points.size(); ++p) {
            inCell_[points.cell[p]].push_back(static_cast<int>(p));
        }
    }

    /// Area of a point on the surface [m2/rad] or [m], and the way to the surface times that area.
    struct Share
    {
        double area = 0, reachR = 0, reachZ = 0;
    };

    /// Adds the area of the sides of `cell` that look to the face to the points next to them.
    void addSides(int cell, LoadedSurface::Face face, std::vector<Share>& shares) const
    {
        for (int k = 0; k < mesh_.corners; ++k) {
            const int neighbour = mesh_.neighbour[cell * mesh_.corners + k];
            if (neighbour >= 0 && !inCell_[neighbour].empty()) {
                continue;
            }
            const int a = mesh_.node(cell, k);
            const int b = mesh_.node(cell, (k + 1) % mesh_.corners);
            const double dr = mesh_.r[b] - mesh_.r[a];
            const double dz = mesh_.z[b] - mesh_.z[a];
            const double length = std::hypot(dr, dz);
            if (!looksTo(face, dz / length, -dr / length)) {
                continue;
            }
            // The points along the side are those that are nearest to a good part of it. They share it by
            // their volumes: for sub-cells of equal depth these are as the areas, and the moments come right.
            constexpr int bits = 60;
            std::map<int, int> found;
            for (int i = 0; i < bits; ++i) {
                ++found[nearest(cell, mesh_.r[a] + (i + 0.5) / bits * dr,
                                mesh_.z[a] + (i + 0.5) / bits * dz)];
            }
            const std::size_t points = found.size();
            std::erase_if(found, [&](const auto& item) { return 4 * item.second * points < bits; });
            double volume = 0;
            for (const auto& [p, count] : found) {
                volume += points_.volume[p];
            }
            const double meanR = 0.5 * (mesh_.r[a] + mesh_.r[b]);
            const double whole = length * (mesh_.geometry == Geometry::axisymmetric ? meanR : 1);
            for (const auto& [p, count] : found) {
                const double area = whole * points_.volume[p] / volume;
                const double normalR = dz / length;
                const double normalZ = -dr / length;
                const double reach =
                    (mesh_.r[a] - points_.r[p]) * normalR + (mesh_.z[a] - points_.z[p]) * normalZ;
                shares[p].area += area;
                shares[p].reachR += area * reach * normalR;
                shares[p].reachZ += area * reach * normalZ;
            }
        }
    }

private:
    [[nodiscard]] int nearest(int cell, double r, double z) const
    {
        const auto distance = [&](int p) { return std::hypot(points_.r[p] - r, points_.z[p] - z); };
        return *std::ranges::min_element(inCell_[cell], {}, distance);
    }

    const MaterialPoints& points_;
    const BackgroundMesh& mesh_;
    std::vector<std::vector<int>> inCell_;
};

/// Area of each point on the surface [m2/rad] or [m], zero for those that are not; and the way from the point
/// to the surface [m].
std::vector<SurfaceShares::Share> shareOut(const MaterialPoints& points, const BackgroundMesh& mesh,
                                           const LoadedSurface& surface, const SurfaceShares& shares,
                                           const std::vector<int>& selected)
{
    std::vector<SurfaceShares::Share> result(points.size());
    if (surface.face == LoadedSurface::Face::all) {
        for (const int p : selected) {
            result[p].area = points.volume[p];
        }
    } else {
        std::vector<SurfaceShares::Share> whole(points.size());
        int last = -1;
        for (const int p : selected) {
            if (points.cell[p] != last) { // points ascend by cell
                last = points.cell[p];
                shares.addSides(last, surface.face, whole);
            }
        }
        for (const int p : selected) { // a cell may reach beyond the region
            result[p] = whole[p];
        }
    }
    double sum = 0;
    for (SurfaceShares::Share& share : result) {
        sum += share.area;
        if (share.area > 0) {
            share.reachR /= share.area;
            share.reachZ /= share.area;
        }
    }
    if (surface.area > 0) {
        const double round = mesh.geometry == Geometry::axisymmetric ? 2 * std::numbers::pi : 1;
        for (SurfaceShares::Share& share : result) {
            share.area *= sum > 0 ? surface.area / (round * sum) : 0;
        }
    }
    return result;
}

} // namespace

std::array<double, 2> PointLoad::traction(double time, double area) const
{
    if (type == Type::pressure) {
        const double pressure = value.component[0]->value(time);
        return {pressure * direction[0], pressure * direction[1]};
    }
    const std::array<double, 3> vector = value.value(time);
    const double share = type == Type::force ? 1 / area : 1.0;
    return {share * vector[0], share * vector[2]};
}

std::vector<std::string> pointLoadTypes() { return split(typeWords); }

std::vector<Keyword> pointLoadKeywords(const std::string& type)
{
    std::vector<Keyword> keywords = {
        {"type", "word", "", typeWords,
         "what uniformValue is; or expression: a traction [Pa] given by r and z"}};
    if (type == "pressure") {
        keywords.push_back({"direction", "vector", "", "", "in which the pressure pushes: (1 0 0) along +r"});
    }
    if (type == "expression") {
        const std::vector<Keyword> vector = pointVectorKeywords();
        keywords.insert(keywords.end(), vector.begin(), vector.end());
    } else {
        keywords.push_back(
            {"uniformValue", "Function1", "", "",
             "as a function of time: traction (r 0 z) [Pa], or pressure [Pa], or force (r 0 z) on "
             "all its points, "
             "round the whole axis [N] (plane strain: per metre [N/m])"});
    }
    if (type != "force") {
        keywords.push_back({"areaFollows", "flag", "no", "",
                            "axisymmetric: whether the areas grow with r of the surface over its initial r"});
    }
    return keywords;
}

std::vector<PointLoad> readPointLoads(const Dictionary& loads, Geometry geometry, InputProblems& problems)
{
    std::vector<PointLoad> result;
    for (const Entry& entry : loads.entries()) {
        if (entry.keyword == "FoamFile" || !entry.dictionary) {
            if (!entry.dictionary && !loads.usedAsMacro(entry.keyword)) {
                problems.add(entry.where, "'" + entry.keyword + "' is not a load",
                             "a load is a sub-dictionary: " + entry.keyword + " { type traction; ... }");
            }
            continue;
        }
        const Dictionary& own = *entry.dictionary;
        const Entry* typeEntry = own.find("type");
        const std::string type =
            typeEntry != nullptr && typeEntry->tokens.size() == 1 ? typeEntry->tokens[0].text : "";
        const std::vector<std::string> types = pointLoadTypes();
        PointLoad load;
        load.name = entry.keyword;
        if (std::ranges::find(types, type) == types.end()) {
            problems.add(typeEntry != nullptr ? typeEntry->where : entry.where,
                         typeEntry != nullptr ? "unknown word '" + type + "' for type of a load"
                                              : "missing key 'type' in '" + entry.keyword + "'",
                         suggestion(type, types, "types"));
            result.push_back(std::move(load)); // so that the points find its name
            continue;
        }
        const std::vector<Keyword> keywords = pointLoadKeywords(type);
        const KeywordReader reader(own, keywords, "'" + entry.keyword + "'", problems);
        load.type = typeOf(type);
        load.areaFollows = load.type != PointLoad::Type::force && reader.flag("areaFollows");
        if (load.areaFollows && geometry == Geometry::planeStrain) {
            reader.problem("areaFollows", "areas do not grow with r in plane strain", "areaFollows no;");
        }
        if (load.type == PointLoad::Type::pressure) {
            const std::array<double, 3> direction = reader.vector("direction");
            const double length = std::hypot(direction[0], direction[2]);
            if (reader.has("direction") && (!(length > 0) || direction[1] != 0)) {
                reader.problem("direction", "the direction must lie in the plane of r and z",
                               "direction (1 0 0);");
            } else {
                load.direction = {direction[0] / length, direction[2] / length};
            }
        }
        if (load.type == PointLoad::Type::expression) {
            load.expression = readPointVector(reader, "load '" + entry.keyword + "'");
        } else if (!reader.has("uniformValue")) {
            problems.add(entry.where, "missing key 'uniformValue' in '" + entry.keyword + "'");
        } else if (load.type == PointLoad::Type::pressure) {
            load.value.component[0] = readFunction1(own, "uniformValue", problems);
        } else {
            load.value = readVectorFunction1(own, "uniformValue", problems);
        }
        result.push_back(std::move(load));
    }
    return result;
}

std::vector<Keyword> loadedSurfaceKeywords(const std::string& regionType)
{
    std::vector<Keyword> keywords = regionShapeKeywords(regionType);
    keywords.insert(
        keywords.end(),
        {{"load", "word", "", "", "name of a load in constant/pointLoads"},
         {"face", "word", "any", faceWords,
          "the side of the soil's surface that is loaded, to within 45 degrees; any: its whole surface; all: "
          "all points of the region, by their volumes"},
         {"area", "m2", "-", "(0, inf)",
          "of all the points, round the whole axis (plane strain: per metre [m]); by default as the sides of "
          "the cells have it, with face all needed"}});
    return keywords;
}

std::vector<LoadedSurface> readLoadedSurfaces(const std::vector<Dictionary>& surfaces,
                                              const BackgroundMesh& mesh, const std::vector<PointLoad>& loads,
                                              InputProblems& problems)
{
    std::vector<std::string> names;
    names.reserve(loads.size());
    for (const PointLoad& load : loads) {
        names.push_back(load.name);
    }
    std::vector<LoadedSurface> result;
    for (const Dictionary& dictionary : surfaces) {
        LoadedSurface surface;
        if (!readRegionType(dictionary, surface.region, problems)) {
            continue;
        }
        const std::vector<Keyword> keywords = loadedSurfaceKeywords(surface.region.type);
        const KeywordReader reader(dictionary, keywords, "loadedPoints", problems);
        readRegionShape(reader, mesh, surface.region);
        surface.face = faceOf(reader.word("face"));
        surface.area = reader.has("area") ? reader.number("area") : 0;
        if (surface.face == LoadedSurface::Face::all && !reader.has("area")) {
            reader.problem("face", "face all needs the 'area' that the points of the region share",
                           "area 1; where only a force is shared out");
        }
        const std::string load = reader.word("load");
        const auto found = std::ranges::find(names, load);
        surface.load = static_cast<int>(found - names.begin());
        if (found == names.end() && reader.has("load")) {
            reader.problem("load", "there is no load '" + load + "' in constant/pointLoads",
                           names.empty()
                               ? "it has none: " + load + " { type traction; uniformValue (0 0 -1e3); }"
                               : suggestion(load, names, "loads"));
        }
        result.push_back(std::move(surface));
    }
    return result;
}

std::vector<LoadedPoints> loadPoints(MaterialPoints& points, const BackgroundMesh& mesh,
                                     const std::vector<LoadedSurface>& surfaces, InputProblems& problems)
{
    std::vector<LoadedPoints> result;
    if (surfaces.empty()) {
        return result;
    }
    points.load.assign(points.size(), -1);
    points.loadArea.assign(points.size(), 0);
    points.loadReachR.assign(points.size(), 0);
    points.loadReachZ.assign(points.size(), 0);
    const SurfaceShares shares(points, mesh);
    for (const LoadedSurface& surface : surfaces) {
        std::vector<bool> reaches(mesh.cells(), false);
        for (const int cell : surface.region.cells(mesh)) {
            reaches[cell] = true;
        }
        std::vector<int> selected;
        for (std::size_t p = 0; p < points.size(); ++p) {
            if (reaches[points.cell[p]] && surface.region.contains(points.r[p], points.z[p])) {
                selected.push_back(static_cast<int>(p));
            }
        }
        const std::vector<SurfaceShares::Share> share = shareOut(points, mesh, surface, shares, selected);
        LoadedPoints& report = result.emplace_back();
        std::size_t twice = 0;
        for (const int p : selected) {
            if (!(share[p].area > 0)) {
                continue;
            }
            twice += points.load[p] >= 0 ? 1 : 0;
            points.load[p] = surface.load;
            points.loadArea[p] = share[p].area;
            points.loadReachR[p] = share[p].reachR;
            points.loadReachZ[p] = share[p].reachZ;
            ++report.points;
            report.area += share[p].area;
        }
        if (report.points == 0) {
            problems.add(surface.region.where,
                         selected.empty()
                             ? "there is no material point in the region of loadedPoints"
                             : text("none of the %zu points in the region of loadedPoints is on a surface "
                                    "of the soil that looks to the face",
                                    selected.size()),
                         selected.empty() ? "give a region that the regions above fill"
                                          : "the outermost points of the soil must lie in the region");
        } else if (twice > 0) {
            problems.add(surface.region.where, text("%zu points have a load already", twice),
                         "a point carries one load: let the regions of loadedPoints not overlap");
        }
    }
    return result;
}

std::vector<double> loadedAreas(const MaterialPoints& points, std::size_t loads, Geometry geometry)
{
    std::vector<int> order(points.load.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [&](int p) { return points.id[p]; });
    std::vector<double> area(loads, 0);
    for (const int p : order) {
        if (points.load[p] >= 0) {
            area[points.load[p]] += points.loadArea[p];
        }
    }
    for (double& a : area) {
        a *= geometry == Geometry::axisymmetric ? 2 * std::numbers::pi : 1;
    }
    return area;
}

} // namespace caisson

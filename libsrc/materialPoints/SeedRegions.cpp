#include "materialPoints/SeedRegions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace caisson {

namespace {

using Place = std::array<double, 2>;

constexpr int circleSides = 720;

double cross(const Place& a, const Place& b, const Place& c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

/// The part of a polygon on the left of the line from a to b [Sutherland & Hodgman 1974].
std::vector<Place> leftPart(const std::vector<Place>& polygon, const Place& a, const Place& b)
{
    std::vector<Place> part;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Place& from = polygon[i];
        const Place& to = polygon[(i + 1) % polygon.size()];
        const double start = cross(a, b, from);
        const double end = cross(a, b, to);
        if (start >= 0) {
            part.push_back(from);
        }
        if ((start >= 0) != (end >= 0)) {
            const double share = start / (start - end);
            part.push_back({from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])});
        }
    }
    return part;
}

bool insideBox(const Place& low, const Place& high, double r, double z)
{
    return r >= low[0] && r <= high[0] && z >= low[1] && z <= high[1];
}

std::vector<Keyword> shapeKeywords(const std::string& type)
{
    if (type == "cellZone") {
        return {{"name", "word", "", "", "name of the cellZone"}};
    }
    if (type == "box") {
        return {{"min", "list", "", "", "lower left corner (r z) [m]"},
                {"max", "list", "", "", "upper right corner (r z) [m]"}};
    }
    if (type == "polygon") {
        return {{"vertices", "list", "", "", "corners ((r z) (r z) ...) in order [m]"}};
    }
    if (type == "circle") {
        return {{"centre", "list", "", "", "centre (r z) [m]"},
                {"radius", "m", "", "(0, inf)", "radius of the circle"}};
    }
    return {};
}

constexpr std::string_view typeWords = "all cellZone box polygon circle";

constexpr Keyword refinementKeywords[] = {
    {"box", "list", "", "",
     "corners ((r z) (r z)) of the box in which cells are refined, by their centres [m]"},
    {"maxSpacing", "list", "-", "",
     "largest spacing of points: of both directions, or (along r, along z) [m]"},
    {"pointsPerCell", "list", "-", "",
     "points of a cell, at least: as in the region. This, maxSpacing or both"},
};

constexpr Keyword velocityKeywords[] = {
    {"r", "Function1", "0", "", "radial velocity [m/s] as a function of r [m]"},
    {"z", "Function1", "0", "", "vertical velocity [m/s] as a function of z [m]"},
};

/// One region's dictionary; what is wrong goes to the problems of its reader.
class RegionReader
{
public:
    RegionReader(const KeywordReader& reader, SeedRegion& region) : reader_(reader), region_(region) {}

    void readShape(const BackgroundMesh& mesh)
    {
        if (region_.type == "cellZone") {
            readZone(mesh);
        } else if (region_.type == "box") {
            const Place low = place("min");
            const Place high = place("max");
            if (!(low[0] < high[0] && low[1] < high[1]) && reader_.has("min") && reader_.has("max")) {
                reader_.problem("max", "the box has no extent: max must lie above and to the right of min");
            }
            region_.boundary = {low, {high[0], low[1]}, high, {low[0], high[1]}};
        } else if (region_.type == "polygon") {
            readPolygon();
        } else if (region_.type == "circle") {
            readCircle();
        }
    }

    void readDivision(int corners) { readDivision(reader_, corners, region_.division); }

    static void readDivision(const KeywordReader& reader, int corners, CellDivision& division)
    {
        if (!reader.has("pointsPerCell")) {
            return;
        }
        const std::vector<double> values = numbers(reader, "pointsPerCell");
        const bool whole =
            std::ranges::all_of(values, [](double x) { return x >= 1 && x <= 1000 && x == std::floor(x); });
        if (corners == 4 && whole && values.size() == 2) {
            division.along = {static_cast<int>(values[0]), static_cast<int>(values[1])};
        } else if (corners == 4) {
            reader.problem("pointsPerCell", "quadrilaterals need two whole numbers from 1 to 1000",
                           "pointsPerCell (2 2);  along r and along z");
        } else if (!(whole && values.size() == 1 && divideTriangle(static_cast<int>(values[0]), division))) {
            reader.problem("pointsPerCell", "triangles need 1, 3 or 6 times a square number",
                           "pointsPerCell 3;  valid: 1 3 4 6 9 12 16 24 25 27 ...");
        }
    }

    void readRefinements(int corners)
    {
        for (const Dictionary& dictionary : reader_.dictionaries("refinements")) {
            const KeywordReader own(dictionary, refinementKeywords, "a refinement", reader_.problems());
            const std::vector<std::vector<double>> box = own.rows("box");
            std::vector<double> spacing(2, std::numeric_limits<double>::infinity());
            if (own.has("maxSpacing")) {
                spacing = numbers(own, "maxSpacing");
                spacing.resize(spacing.size() == 1 ? 2 : spacing.size(), spacing.empty() ? 0 : spacing[0]);
            }
            CellDivision division{{1, 1}, 1, 1};
            readDivision(own, corners, division);
            if (box.size() != 2 || box[0].size() != 2 || box[1].size() != 2) {
                own.problem("box", "the box of a refinement needs two corners", "box ((0 -5) (3 0));");
            } else if (!own.has("maxSpacing") && !own.has("pointsPerCell")) {
                own.problem("box", "a refinement needs maxSpacing, pointsPerCell or both",
                            "{ box ((0 -5) (3 0)); maxSpacing (1 0.02); }");
            } else if (spacing.size() != 2 || !(spacing[0] > 0) || !(spacing[1] > 0)) {
                own.problem("maxSpacing", "maxSpacing needs one or two positive numbers",
                            "maxSpacing 0.02;  or along r and along z: maxSpacing (1 0.02);");
            } else {
                region_.refinements.push_back(
                    {{std::min(box[0][0], box[1][0]), std::min(box[0][1], box[1][1])},
                     {std::max(box[0][0], box[1][0]), std::max(box[0][1], box[1][1])},
                     {spacing[0], spacing[1]},
                     division});
            }
        }
    }

    void readDisplacement(const BackgroundMesh& mesh, const MeshMotion& motion)
    {
        if (!reader_.has("meshDisplacement")) {
            return;
        }
        const double displacement = motion.readDisplacement(reader_, "meshDisplacement");
        region_.passingHeight = motion.passingHeights(mesh, displacement);
    }

    void readVelocity()
    {
        const Dictionary* dictionary = reader_.dictionary("velocity");
        if (dictionary == nullptr) {
            return;
        }
        const KeywordReader own(*dictionary, velocityKeywords, "velocity", reader_.problems());
        if (own.has("r")) {
            region_.velocityR = readFunction1(*dictionary, "r", reader_.problems());
        }
        if (own.has("z")) {
            region_.velocityZ = readFunction1(*dictionary, "z", reader_.problems());
        }
    }

private:
    /// A list of numbers, or a number alone.
    [[nodiscard]] static std::vector<double> numbers(const KeywordReader& reader, const char* key)
    {
        const Entry* entry = reader.entry(key);
        if (entry != nullptr && entry->tokens.size() == 1 && entry->tokens[0].kind == Token::Kind::number) {
            return {entry->tokens[0].number};
        }
        return reader.numbers(key);
    }

    [[nodiscard]] Place place(const char* key) const
    {
        const std::vector<double> values = reader_.numbers(key);
        if (values.size() == 2) {
            return {values[0], values[1]};
        }
        if (!values.empty()) {
            reader_.problem(key, "'" + std::string(key) + "' has " + std::to_string(values.size()) +
                                     " numbers, not the two of a place (r z)");
        }
        return {};
    }

    void readZone(const BackgroundMesh& mesh)
    {
        region_.zone = reader_.word("name");
        if (!reader_.has("name") || mesh.cellZones.contains(region_.zone)) {
            return;
        }
        std::vector<std::string> names;
        names.reserve(mesh.cellZones.size());
        for (const auto& [name, cells] : mesh.cellZones) {
            names.push_back(name);
        }
        reader_.problem("name", "the mesh has no cellZone '" + region_.zone + "'",
                        names.empty() ? "it has none at all: name blocks in blockMeshDict, or use topoSet"
                                      : suggestion(region_.zone, names, "cellZones"));
    }

    void readPolygon()
    {
        for (const std::vector<double>& row : reader_.rows("vertices")) {
            if (row.size() != 2) {
                reader_.problem("vertices", "a vertex needs two numbers (r z)");
                return;
            }
            region_.boundary.push_back({row[0], row[1]});
        }
        if (region_.boundary.size() < 3 && !region_.boundary.empty()) {
            reader_.problem("vertices", "a polygon needs three vertices at least");
        }
        const double area = polygonVolume(Geometry::planeStrain, 0, region_.boundary);
        if (area < 0) {
            std::ranges::reverse(region_.boundary);
        }
    }

    void readCircle()
    {
        region_.centre = place("centre");
        region_.radius = reader_.number("radius");
        // A polygon of the circle's area
        const double angle = 2 * std::numbers::pi / circleSides;
        const double reach = region_.radius * std::sqrt(angle / std::sin(angle));
        for (int i = 0; i < circleSides; ++i) {
            region_.boundary.push_back({region_.centre[0] + reach * std::cos(i * angle),
                                        region_.centre[1] + reach * std::sin(i * angle)});
        }
    }

    const KeywordReader& reader_;
    SeedRegion& region_;
};

} // namespace

bool SeedRegion::contains(double r, double z) const
{
    if (boundary.empty()) {
        return true;
    }
    if (type == "box") {
        return insideBox(boundary[0], boundary[2], r, z);
    }
    if (type == "circle") {
        return std::hypot(r - centre[0], z - centre[1]) <= radius;
    }
    bool inside = false;
    for (std::size_t i = 0; i < boundary.size(); ++i) {
        const Place& a = boundary[i];
        const Place& b = boundary[(i + 1) % boundary.size()];
        if ((a[1] > z) != (b[1] > z) && r < a[0] + (z - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) {
            inside = !inside;
        }
    }
    return inside;
}

std::vector<int> SeedRegion::cells(const BackgroundMesh& mesh) const
{
    std::vector<int> all;
    if (type == "cellZone") {
        all = mesh.cellZones.at(zone);
        std::ranges::sort(all);
        return all;
    }
    all.resize(mesh.cells());
    std::iota(all.begin(), all.end(), 0);
    return all;
}

double SeedRegion::volumeWithin(const BackgroundMesh& mesh, int cell) const
{
    if (boundary.empty()) {
        return cellVolume(mesh, cell);
    }
    const int first = mesh.node(cell, 0);
    std::vector<Place> part;
    part.reserve(boundary.size());
    for (const Place& vertex : boundary) {
        part.push_back({vertex[0] - mesh.r[first], vertex[1] - mesh.z[first]});
    }
    for (int k = 0; k < mesh.corners && !part.empty(); ++k) {
        const int a = mesh.node(cell, k);
        const int b = mesh.node(cell, (k + 1) % mesh.corners);
        part = leftPart(part, {mesh.r[a] - mesh.r[first], mesh.z[a] - mesh.z[first]},
                        {mesh.r[b] - mesh.r[first], mesh.z[b] - mesh.z[first]});
    }
    return polygonVolume(mesh.geometry, mesh.r[first], part);
}

std::vector<std::string> seedRegionTypes() { return {"all", "cellZone", "box", "polygon", "circle"}; }

std::vector<Keyword> regionShapeKeywords(const std::string& type)
{
    std::vector<Keyword> keywords = shapeKeywords(type);
    keywords.insert(keywords.begin(), {"type", "word", "", typeWords, "shape of the region"});
    return keywords;
}

std::vector<Keyword> seedRegionKeywords(const std::string& type)
{
    std::vector<Keyword> keywords = regionShapeKeywords(type);
    const Keyword own[] = {
        {"material", "word", "", "", "name of a material in constant/materialProperties"},
        {"pointsPerCell", "list", "-", "",
         "quadrilaterals: (n m) along r and z, by default (2 2); triangles: 3 by default, or 1, 3 or 6 times "
         "a "
         "square"},
        {"refinements", "list", "-", "",
         "boxes with finer points: ( { box ((r z) (r z)); maxSpacing d; pointsPerCell (n m); } ... )"},
        {"meshDisplacement", "m", "-", "",
         "how far the mesh will move, down negative: points as fine as the cells that come by on the way"},
        {"velocity", "dictionary", "-", "", "initial velocity: { r <Function1 of r>; z <Function1 of z>; }"},
    };
    keywords.insert(keywords.end(), std::begin(own), std::end(own));
    return keywords;
}

std::span<const Keyword> seedRefinementKeywords() { return refinementKeywords; }

std::span<const Keyword> seedVelocityKeywords() { return velocityKeywords; }

bool readRegionType(const Dictionary& dictionary, SeedRegion& region, InputProblems& problems)
{
    region.where = dictionary.where();
    const Entry* type = dictionary.find("type");
    region.type = type != nullptr && type->tokens.size() == 1 ? type->tokens[0].text : "";
    const std::vector<std::string> types = seedRegionTypes();
    if (std::ranges::find(types, region.type) != types.end()) {
        return true;
    }
    problems.add(type != nullptr ? type->where : region.where,
                 type != nullptr ? "unknown word '" + region.type + "' for type of a region"
                                 : "missing key 'type' in a region",
                 suggestion(region.type, types, "types"));
    return false;
}

void readRegionShape(const KeywordReader& reader, const BackgroundMesh& mesh, SeedRegion& region)
{
    RegionReader(reader, region).readShape(mesh);
}

std::vector<SeedRegion> readSeedRegions(const std::vector<Dictionary>& regions, const BackgroundMesh& mesh,
                                        const std::vector<Material>& materials, InputProblems& problems,
                                        const MeshMotion& motion)
{
    std::vector<std::string> names;
    names.reserve(materials.size());
    for (const Material& material : materials) {
        names.push_back(material.name);
    }
    std::vector<SeedRegion> result;
    for (const Dictionary& dictionary : regions) {
        SeedRegion region;
        if (!readRegionType(dictionary, region, problems)) {
            continue;
        }
        const std::vector<Keyword> keywords = seedRegionKeywords(region.type);
        const KeywordReader reader(dictionary, keywords, "the region", problems);
        RegionReader parts(reader, region);
        parts.readShape(mesh);
        parts.readDivision(mesh.corners);
        parts.readRefinements(mesh.corners);
        parts.readDisplacement(mesh, motion);
        parts.readVelocity();
        const std::string material = reader.word("material");
        const auto found = std::ranges::find(names, material);
        region.material = static_cast<int>(found - names.begin());
        if (found == names.end() && reader.has("material")) {
            reader.problem("material",
                           "there is no material '" + material + "' in constant/materialProperties",
                           suggestion(material, names, "materials"));
        }
        result.push_back(std::move(region));
    }
    return result;
}

} // namespace caisson

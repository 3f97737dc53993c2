#include "mesh/CoarsenMesh.h"

#include "dictionary/Text.h"
#include "mesh/PolyMeshLayer.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace caisson {

namespace {

/// Places up to this part of the mesh's extent apart are the same.
constexpr double placeTolerance = 1e-7;

/// The lines of the mesh in one direction and the rows (or columns) between them.
struct Lines
{
    std::vector<double> at;   ///< places of the lines [m], ascending
    std::vector<double> size; ///< of the row between line k and k + 1, the greatest of the whole motion [m]
    std::vector<bool> kept;   ///< lines that stay lines
    std::vector<bool> whole;  ///< whether the row moves as one, without a kink of the motion in it

    [[nodiscard]] int rows() const { return static_cast<int>(size.size()); }
    /// The line nearest to a place.
    [[nodiscard]] int nearest(double place) const
    {
        const auto above = std::ranges::lower_bound(at, place);
        if (above == at.begin()) {
            return 0;
        }
        const auto k = static_cast<int>(above - at.begin());
        return above == at.end() || place - at[k - 1] < at[k] - place ? k - 1 : k;
    }
};

/// A place on the lines of the mesh, in halves: (2i, 2j) is where column line i and row line j cross.
using Place = std::array<int, 2>;

class Grid
{
public:
    Grid(const PolyMesh& poly, const Coarsening& wish, InputProblems& problems)
        : poly_(poly), wish_(wish), problems_(problems), fine_(buildBackgroundMesh(poly, problems))
    {
    }

    PolyMesh coarsened()
    {
        if (fine_.nodeCells.start.empty() || !findLines() || !findCells()) {
            return {};
        }
        keepLevels();
        keepPatchesAndZones();
        merge();
        sortCells();
        const auto [front, back] = planePatches(poly_, fine_);
        return polyMeshLayer(flatMesh(), front, back);
    }

private:
    bool notAGrid(const std::string& message)
    {
        problems_.add({poly_.directory, 0}, message,
                      "coarsenMesh starts from a grid of rectangles: one block of blockMesh, or several that "
                      "continue each other's lines; after coarsenMesh itself, run blockMesh again first");
        return false;
    }
    [[nodiscard]] int fineCell(int i, int j) const { return cellAt_[i + columns_.rows() * j]; }

    bool findLines();
    bool findCells();
    void keepLevels();
    void keepPatchesAndZones();
    void merge();
    void sweep(int first, int end, std::vector<int> lines, bool column);
    [[nodiscard]] std::vector<int> merged(const std::vector<int>& lines, const Lines& of, double limit) const;
    void addStrip(int near, int far, const std::vector<int>& in, const std::vector<int>& out, bool column);
    void sortCells();
    [[nodiscard]] BackgroundMesh flatMesh() const;
    [[nodiscard]] int patchOf(const Place& a, const Place& b) const;
    [[nodiscard]] static double coordinate(const Lines& lines, int halves)
    {
        return (lines.at[halves / 2] + lines.at[(halves + 1) / 2]) / 2;
    }

    struct Cell
    {
        std::array<Place, 4> corner; ///< counter-clockwise
        int fine;                    ///< one of the cells in its place
    };

    const PolyMesh& poly_;
    const Coarsening& wish_;
    InputProblems& problems_;
    BackgroundMesh fine_;
    double tolerance_ = 0;
    Lines columns_, rows_; ///< of constant r, of constant z
    std::vector<int> cellAt_;
    std::vector<std::vector<std::string>> zonesOf_; ///< of each fine cell
    /// patch of each side of the boundary, -1 for none: left, right (by row), bottom, top (by column)
    std::array<std::vector<int>, 4> patchOf_;
    std::vector<Cell> cells_;
};

bool Grid::findLines()
{
    if (fine_.corners != 4) {
        return notAGrid("the cells of the mesh are triangles");
    }
    const auto extent = [](const std::vector<double>& x) {
        const auto [low, high] = std::ranges::minmax(x);
        return high - low;
    };
    tolerance_ = placeTolerance * std::max(extent(fine_.r), extent(fine_.z));
    for (const bool column : {true, false}) {
        std::vector<double> places = column ? fine_.r : fine_.z;
        std::ranges::sort(places);
        Lines& lines = column ? columns_ : rows_;
        for (const double place : places) {
            if (lines.at.empty() || place > lines.at.back() + tolerance_) {
                lines.at.push_back(place);
            }
        }
        for (std::size_t k = 0; k + 1 < lines.at.size(); ++k) {
            lines.size.push_back(lines.at[k + 1] - lines.at[k]);
        }
        lines.kept.assign(lines.at.size(), false);
        lines.kept.front() = lines.kept.back() = true;
        lines.whole.assign(lines.size.size(), true);
    }
    return true;
}

/// Every cell must be the rectangle between two neighbouring columns lines and two row lines.
bool Grid::findCells()
{
    if (static_cast<long>(columns_.rows()) * rows_.rows() != fine_.cells()) {
        return notAGrid(text("the %d cells are no grid: their corners lie on %zu lines of r and %zu of z",
                             fine_.cells(), columns_.at.size(), rows_.at.size()));
    }
    cellAt_.assign(fine_.cells(), -1);
    for (int cell = 0; cell < fine_.cells(); ++cell) {
        const int first = fine_.node(cell, 0);
        const int i = columns_.nearest(fine_.r[first]);
        const int j = rows_.nearest(fine_.z[first]);
        for (int k = 0; k < 4; ++k) {
            const int node = fine_.node(cell, k);
            const int column = i + (k == 1 || k == 2 ? 1 : 0);
            const int row = j + (k >= 2 ? 1 : 0);
            if (column > columns_.rows() || row > rows_.rows() ||
                std::abs(fine_.r[node] - columns_.at[column]) > 2 * tolerance_ ||
                std::abs(fine_.z[node] - rows_.at[row]) > 2 * tolerance_) {
                return notAGrid(
                    text("cell %d at (%g %g) is no rectangle between neighbouring lines of the mesh", cell,
                         fine_.r[first], fine_.z[first]));
            }
        }
        cellAt_[i + columns_.rows() * j] = cell;
    }
    return true;
}

/// The levels of the dictionary and those where the motion of the mesh has a kink; heights over the motion.
void Grid::keepLevels()
{
    for (const double level : wish_.keptLevels) {
        const int line = rows_.nearest(level);
        if (std::abs(rows_.at[line] - level) > 2 * tolerance_) {
            problems_.add(wish_.whereLevels, text("the mesh has no line at z = %g", level),
                          text("the nearest is at %.9g", rows_.at[line]));
        }
        rows_.kept[line] = true;
    }
    if (!wish_.motion.moves()) {
        return;
    }
    const auto& [bottom, movingBottom, movingTop, top] = wish_.motion.heights();
    for (const double level : {bottom, movingBottom, movingTop, top}) {
        const int line = rows_.nearest(level);
        const double offset = level - rows_.at[line];
        rows_.kept[line] = true;
        if (std::abs(offset) > 2 * tolerance_ && level > rows_.at.front() && level < rows_.at.back()) {
            const int row = offset > 0 ? line : line - 1;
            rows_.kept[row] = rows_.kept[row + 1] = true;
            rows_.whole[row] = false;
        }
    }
    const DisplacementRange& range = wish_.displacements;
    for (int j = 0; j < rows_.rows(); ++j) {
        const double stretch = wish_.motion.weight(rows_.at[j + 1]) - wish_.motion.weight(rows_.at[j]);
        rows_.size[j] += std::max({0.0, stretch * range.lowest, stretch * range.highest});
    }
}

/// Cells of different zones, and sides of different patches, do not merge.
void Grid::keepPatchesAndZones()
{
    const int nr = columns_.rows();
    const int nz = rows_.rows();
    zonesOf_.resize(fine_.cells());
    for (const auto& [name, cells] : fine_.cellZones) {
        for (const int cell : cells) {
            zonesOf_[cell].push_back(name);
        }
    }
    for (int j = 0; j < nz; ++j) {
        for (int i = 0; i < nr; ++i) {
            const auto differs = [&](int i2, int j2) {
                return zonesOf_[fineCell(i, j)] != zonesOf_[fineCell(i2, j2)];
            };
            columns_.kept[i] = columns_.kept[i] || (i > 0 && differs(i - 1, j));
            rows_.kept[j] = rows_.kept[j] || (j > 0 && differs(i, j - 1));
        }
    }
    for (std::size_t side = 0; side < patchOf_.size(); ++side) {
        patchOf_[side].assign(side < 2 ? nz : nr, -1);
    }
    for (std::size_t patch = 0; patch < fine_.patches.size(); ++patch) {
        for (const BoundaryEdge& edge : fine_.patches[patch].edges) {
            const double r = (fine_.r[edge.node[0]] + fine_.r[edge.node[1]]) / 2;
            const double z = (fine_.z[edge.node[0]] + fine_.z[edge.node[1]]) / 2;
            const bool upright = std::abs(fine_.r[edge.node[0]] - fine_.r[edge.node[1]]) <= 2 * tolerance_;
            const Lines& across = upright ? columns_ : rows_;
            const Lines& along = upright ? rows_ : columns_;
            const int last = across.nearest(upright ? r : z) > 0 ? 1 : 0;
            const auto above = std::ranges::lower_bound(along.at, upright ? z : r);
            patchOf_[(upright ? 0 : 2) + last][above - along.at.begin() - 1] = static_cast<int>(patch);
        }
    }
    for (std::size_t side = 0; side < patchOf_.size(); ++side) {
        Lines& along = side < 2 ? rows_ : columns_;
        for (int k = 1; k < along.rows(); ++k) {
            along.kept[k] = along.kept[k] || patchOf_[side][k] != patchOf_[side][k - 1];
        }
    }
}

/// The lines that remain where every three neighbouring rows merge of which none is larger than `limit`.
/// Between two kept lines the finer end comes first, so that what is left over is coarse.
std::vector<int> Grid::merged(const std::vector<int>& lines, const Lines& of, double limit) const
{
    const auto size = [&](int a, int b) {
        return std::accumulate(of.size.begin() + std::min(a, b), of.size.begin() + std::max(a, b), 0.0);
    };
    std::vector<int> left;
    for (std::size_t begin = 0; begin + 1 < lines.size();) {
        std::size_t end = begin + 1;
        while (!of.kept[lines[end]]) {
            ++end;
        }
        std::vector<int> zone(lines.begin() + static_cast<std::ptrdiff_t>(begin),
                              lines.begin() + static_cast<std::ptrdiff_t>(end) + 1);
        constexpr double rounding = 1 + 1e-6;
        if (size(zone[0], zone[1]) > rounding * size(zone.end()[-2], zone.back())) {
            std::ranges::reverse(zone);
        }
        for (std::size_t k = 0; k < zone.size();) {
            left.push_back(zone[k]);
            const bool three = k + 3 < zone.size() && size(zone[k], zone[k + 1]) <= rounding * limit &&
                               size(zone[k + 1], zone[k + 2]) <= rounding * limit &&
                               size(zone[k + 2], zone[k + 3]) <= rounding * limit;
            k += three ? 3 : 1;
        }
        begin = end;
    }
    std::ranges::sort(left);
    left.erase(std::unique(left.begin(), left.end()), left.end());
    return left;
}

/// Rows away from the radii, above the level of columnsMergeBelow; columns downwards, below it. So neither
/// meets the other.
void Grid::merge()
{
    const int nr = columns_.rows();
    const int nz = rows_.rows();
    const auto linesFrom = [](int first, int last) {
        std::vector<int> lines(last - first + 1);
        std::iota(lines.begin(), lines.end(), first);
        return lines;
    };
    int base = 0; // line that columns merge below
    while (wish_.columnsMergeBelow && base < nz &&
           rows_.at[base + 1] <= *wish_.columnsMergeBelow + tolerance_) {
        ++base;
    }
    int low = 0, high = nr; // columns of the place where rows stay
    if (wish_.rowsMergeOutside) {
        while (low < nr && columns_.at[low + 1] <= wish_.rowsMergeOutside->at(0) + tolerance_) {
            ++low;
        }
        while (high > low && columns_.at[high - 1] >= wish_.rowsMergeOutside->at(1) - tolerance_) {
            --high;
        }
    }
    const std::vector<int> allRows = linesFrom(base, nz);
    for (int i = low; i < high; ++i) {
        addStrip(i, i + 1, allRows, allRows, true);
    }
    sweep(high, nr, allRows, true);
    sweep(low - 1, -1, allRows, true);
    sweep(base - 1, -1, linesFrom(0, nr), false);
}

/// Columns (or rows) from `first` on, not to `end`, and what merges in them of the lines that meet the first.
void Grid::sweep(int first, int end, std::vector<int> lines, bool column)
{
    const Lines& strips = column ? columns_ : rows_;
    const int step = end > first ? 1 : -1;
    for (int s = first; s != end; s += step) {
        // What merges must be flat from here on; in the last strip it would make more cells, not fewer.
        double narrowest = strips.at.back() - strips.at.front();
        for (int k = s; k != end; k += step) {
            narrowest = std::min(narrowest, strips.at[k + 1] - strips.at[k]);
        }
        const bool mayMerge = s + step != end && strips.whole[s];
        const std::vector<int> out =
            mayMerge ? merged(lines, column ? rows_ : columns_, narrowest / wish_.aspectRatio) : lines;
        const int near = step > 0 ? s : s + 1;
        addStrip(near, near + step, lines, out, column);
        lines = out;
    }
}

/// The cells of one column (row) from its near to its far side, where the lines `in` and `out` end at it.
void Grid::addStrip(int near, int far, const std::vector<int>& in, const std::vector<int>& out, bool column)
{
    const auto add = [&](const std::array<Place, 4>& c, int line) {
        std::array<Place, 4> corners = c;
        for (Place& place : corners) {
            place = column ? place : Place{place[1], place[0]};
        }
        if (column != (far > near)) {
            std::ranges::reverse(corners);
        }
        const int strip = std::min(near, far);
        cells_.push_back({corners, column ? fineCell(strip, line) : fineCell(line, strip)});
    };
    const int middle = near + far; // in halves
    std::size_t k = 0;
    for (std::size_t o = 0; o + 1 < out.size(); ++o) {
        const Place r0{2 * far, 2 * out[o]};
        const Place r1{2 * far, 2 * out[o + 1]};
        const auto left = [&](std::size_t n) { return Place{2 * near, 2 * in[k + n]}; };
        if (in[k + 1] == out[o + 1]) {
            add({left(0), r0, r1, left(1)}, in[k]);
            k += 1;
            continue;
        }
        const Place a{middle, 2 * in[k + 1]};
        const Place b{middle, 2 * in[k + 2]};
        add({left(0), r0, a, left(1)}, in[k]);
        add({left(1), a, b, left(2)}, in[k]);
        add({left(2), b, r1, left(3)}, in[k]);
        add({a, r0, r1, b}, in[k]);
        k += 3;
    }
}

/// Row by row from below, as blockMesh numbers cells.
void Grid::sortCells()
{
    const auto lowest = [](const Cell& cell, int direction) {
        int least = cell.corner[0][direction];
        for (const Place& place : cell.corner) {
            least = std::min(least, place[direction]);
        }
        return least;
    };
    std::ranges::stable_sort(cells_, {}, [&](const Cell& cell) {
        return Place{lowest(cell, 1), lowest(cell, 0)};
    });
}

BackgroundMesh Grid::flatMesh() const
{
    BackgroundMesh mesh;
    mesh.geometry = fine_.geometry;
    mesh.wedgeHalfAngle = fine_.wedgeHalfAngle;
    mesh.halfThickness = fine_.halfThickness;
    mesh.middleY = fine_.middleY;
    for (const BoundaryPatch& patch : fine_.patches) {
        mesh.patches.push_back({patch.name, patch.type, {}});
    }
    std::map<Place, int> nodes;
    for (const Cell& cell : cells_) {
        const int number = mesh.cells();
        std::array<int, 4> corner{};
        for (std::size_t k = 0; k < corner.size(); ++k) {
            const auto [node, isNew] = nodes.try_emplace(cell.corner[k], mesh.nodes());
            if (isNew) {
                mesh.r.push_back(coordinate(columns_, cell.corner[k][0]));
                mesh.z.push_back(coordinate(rows_, cell.corner[k][1]));
            }
            corner[k] = node->second;
        }
        mesh.cellNodes.insert(mesh.cellNodes.end(), corner.begin(), corner.end());
        for (int k = 0; k < 4; ++k) {
            const int patch = patchOf(cell.corner[k], cell.corner[(k + 1) % 4]);
            if (patch >= 0) {
                mesh.patches[patch].edges.push_back({{corner[k], corner[(k + 1) % 4]}, number, k});
            }
        }
        for (const std::string& zone : zonesOf_[cell.fine]) {
            mesh.cellZones[zone].push_back(number);
        }
    }
    return mesh;
}

/// The patch of a side, -1 where it is none of the boundary.
int Grid::patchOf(const Place& a, const Place& b) const
{
    for (const int direction : {0, 1}) {
        const int last = 2 * (direction == 0 ? columns_ : rows_).rows();
        if (a[direction] == b[direction] && (a[direction] == 0 || a[direction] == last)) {
            return patchOf_[2 * direction + (a[direction] == 0 ? 0 : 1)]
                           [std::min(a[1 - direction], b[1 - direction]) / 2];
        }
    }
    return -1;
}

} // namespace

std::span<const Keyword> coarsenMeshKeywords()
{
    static constexpr Keyword table[] = {
        {"aspectRatio", "-", "2", "[1, inf)",
         "three cells side by side merge where each is longer than this; below 2 the stable step suffers"},
        {"rowsMergeOutside", "list", "-", "",
         "radii (r r) [m]: rows merge from the inner one towards the axis, from the outer one outwards"},
        {"columnsMergeBelow", "m", "-", "", "level from which downwards columns merge; there rows stay"},
        {"keepLevels", "list", "-", "", "levels (z ...) of lines that stay lines [m]: surfaces of the soil"},
        {"meshDisplacement", "m", "-", "",
         "how far the mesh will move, down negative; without it as far as it may: rows that will be "
         "stretched "
         "are counted with their greatest height"},
    };
    return table;
}

Coarsening readCoarsening(const Dictionary& coarsenMeshDict, MeshMotion motion, InputProblems& problems)
{
    const KeywordReader reader(coarsenMeshDict, coarsenMeshKeywords(), "coarsenMeshDict", problems);
    Coarsening coarsening;
    if (motion.moves()) {
        coarsening.displacements = motion.allowedDisplacements();
    }
    if (reader.has("meshDisplacement")) {
        const double displacement = motion.readDisplacement(reader, "meshDisplacement");
        coarsening.displacements = {std::min(0.0, displacement), std::max(0.0, displacement)};
    }
    coarsening.aspectRatio = reader.number("aspectRatio");
    coarsening.whereLevels = reader.where("keepLevels");
    if (reader.has("keepLevels")) {
        coarsening.keptLevels = reader.numbers("keepLevels");
    }
    if (reader.has("rowsMergeOutside")) {
        const std::vector<double> radii = reader.numbers("rowsMergeOutside");
        if (radii.size() == 2 && radii[0] < radii[1]) {
            coarsening.rowsMergeOutside = {radii[0], radii[1]};
        } else {
            reader.problem("rowsMergeOutside", "rowsMergeOutside needs two radii, the smaller one first",
                           "rowsMergeOutside (2.2 2.8);");
        }
    }
    if (reader.has("columnsMergeBelow")) {
        coarsening.columnsMergeBelow = reader.number("columnsMergeBelow");
    }
    if (!reader.has("rowsMergeOutside") && !reader.has("columnsMergeBelow")) {
        reader.problem("rowsMergeOutside", "nothing would merge",
                       "rowsMergeOutside (2.2 2.8);  or columnsMergeBelow -6;  or both");
    }
    coarsening.motion = std::move(motion);
    return coarsening;
}

PolyMesh coarsened(const PolyMesh& polyMesh, const Coarsening& coarsening, InputProblems& problems)
{
    return Grid(polyMesh, coarsening, problems).coarsened();
}

} // namespace caisson

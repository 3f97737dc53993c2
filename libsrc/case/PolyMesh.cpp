#include "case/PolyMesh.h"

#include "case/FileIO.h"
#include "case/FoamScanner.h"
#include "dictionary/Text.h"

#include <algorithm>
#include <cstdint>

namespace caisson {

namespace fs = std::filesystem;

namespace {

constexpr const char* meshHint =
    "run blockMesh (or gmshToFoam, extrudeMesh ...) in the case to make the mesh";

std::vector<std::array<double, 3>> readPoints(FoamScanner in)
{
    const std::vector<double> numbers = in.scalarList(3);
    std::vector<std::array<double, 3>> points(numbers.size() / 3);
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
    }
    return points;
}

std::vector<std::vector<int>> readFaces(FoamScanner& in)
{
    std::vector<std::vector<int>> faces;
    if (in.className() == "faceCompactList") {
        const std::vector<int> start = in.labelList();
        const std::vector<int> nodes = in.labelList();
        for (std::size_t i = 1; i < start.size(); ++i) {
            if (start[i] < start[i - 1] || start[i - 1] < 0 ||
                static_cast<std::size_t>(start[i]) > nodes.size()) {
                in.fail("offsets of face " + std::to_string(i - 1) + " lie outside the list of its points");
            }
            faces.emplace_back(nodes.begin() + start[i - 1], nodes.begin() + start[i]);
        }
        return faces;
    }
    const int count = in.label();
    in.expect('(');
    for (int i = 0; i < count; ++i) {
        faces.push_back(in.labelList());
    }
    in.expect(')');
    return faces;
}

std::vector<PolyPatch> readBoundary(FoamScanner in, std::size_t faces)
{
    std::vector<PolyPatch> patches;
    if (in.atNumber()) {
        in.label();
    }
    in.expect('(');
    while (!in.accept(')')) {
        PolyPatch patch;
        patch.name = in.word();
        in.expect('{');
        while (!in.accept('}')) {
            const std::string key = in.word();
            if (key == "type") {
                patch.type = in.word();
            } else if (key == "nFaces") {
                patch.faces = in.label();
            } else if (key == "startFace") {
                patch.startFace = in.label();
            }
            in.skipEntry();
        }
        const long end = static_cast<long>(patch.startFace) + patch.faces;
        if (patch.type.empty() || patch.startFace < 0 || patch.faces < 0 || end > static_cast<long>(faces)) {
            in.fail("patch '" + patch.name + "' needs a type, and nFaces and startFace within the " +
                    std::to_string(faces) + " faces of the mesh");
        }
        patches.push_back(std::move(patch));
    }
    return patches;
}

std::vector<PolyZone> readCellZones(FoamScanner in, int cells)
{
    std::vector<PolyZone> zones;
    if (in.atNumber()) {
        in.label();
    }
    in.expect('(');
    while (!in.accept(')')) {
        PolyZone zone;
        zone.name = in.word();
        in.expect('{');
        while (!in.accept('}')) {
            if (in.word() == "cellLabels") {
                zone.cells = in.labelList();
            }
            in.skipEntry();
        }
        for (const int cell : zone.cells) {
            if (cell < 0 || cell >= cells) {
                in.fail("cellZone '" + zone.name + "' names cell " + std::to_string(cell) + " of a mesh of " +
                        std::to_string(cells) + " cells");
            }
        }
        zones.push_back(std::move(zone));
    }
    return zones;
}

/// `N ( ... )`, a label per line in ascii.
std::string labelList(const std::vector<int>& labels, bool binary)
{
    std::string body = std::to_string(labels.size()) + "\n(";
    if (binary) {
        const std::vector<std::int32_t> raw(labels.begin(), labels.end());
        body.append(reinterpret_cast<const char*>(raw.data()), raw.size() * sizeof(std::int32_t));
        return body + ")";
    }
    for (const int label : labels) {
        body.append("\n").append(std::to_string(label));
    }
    return body + "\n)";
}

std::string faceList(const std::vector<std::vector<int>>& faces)
{
    std::string body = std::to_string(faces.size()) + "\n(";
    for (const std::vector<int>& face : faces) {
        body.append("\n").append(std::to_string(face.size())).append("(");
        for (std::size_t k = 0; k < face.size(); ++k) {
            body.append(k == 0 ? "" : " ").append(std::to_string(face[k]));
        }
        body += ")";
    }
    return body + "\n)";
}

/// Where the points of each face begin, then the points of all faces.
std::string faceCompactList(const std::vector<std::vector<int>>& faces)
{
    std::vector<int> start = {0}, points;
    for (const std::vector<int>& face : faces) {
        points.insert(points.end(), face.begin(), face.end());
        start.push_back(static_cast<int>(points.size()));
    }
    return labelList(start, true) + "\n" + labelList(points, true);
}

std::string boundaryList(const std::vector<PolyPatch>& patches)
{
    std::string body = std::to_string(patches.size()) + "\n(\n";
    for (const PolyPatch& patch : patches) {
        body += text("    %s\n    {\n        type            %s;\n        nFaces          %d;\n"
                     "        startFace       %d;\n    }\n",
                     patch.name.c_str(), patch.type.c_str(), patch.faces, patch.startFace);
    }
    return body + ")";
}

std::string zoneList(const std::vector<PolyZone>& zones, bool binary)
{
    std::string body = std::to_string(zones.size()) + "\n(\n";
    for (const PolyZone& zone : zones) {
        body.append(zone.name).append(
            "\n{\n    type            cellZone;\n    cellLabels      List<label>\n");
        body.append(labelList(zone.cells, binary)).append(";\n}\n");
    }
    return body + ")";
}

} // namespace

PolyMesh readPolyMesh(const fs::path& caseDirectory, const fs::path& pointsFrom)
{
    PolyMesh mesh;
    mesh.directory = "constant/polyMesh";
    const fs::path folder = caseDirectory / mesh.directory;
    const auto open = [&](const char* file) {
        return FoamScanner(folder / file, mesh.directory + "/" + file, meshHint);
    };

    mesh.points = readPoints(open("points"));
    if (!pointsFrom.empty()) {
        const std::string display = pointsFrom.filename().string() + "/polyMesh/points";
        FoamScanner in(pointsFrom / "polyMesh/points", display);
        std::vector<std::array<double, 3>> moved = readPoints(in);
        if (moved.size() != mesh.points.size()) {
            in.fail(std::to_string(moved.size()) + " points for a mesh of " +
                    std::to_string(mesh.points.size()));
        }
        mesh.points = std::move(moved);
    }

    FoamScanner faces = open("faces");
    mesh.faces = readFaces(faces);
    const auto points = static_cast<int>(mesh.points.size());
    for (const std::vector<int>& face : mesh.faces) {
        if (std::any_of(face.begin(), face.end(), [&](int p) { return p < 0 || p >= points; })) {
            faces.fail("a face refers to a point outside the " + std::to_string(points) +
                       " points of the mesh");
        }
    }

    FoamScanner owner = open("owner");
    mesh.owner = owner.labelList();
    if (mesh.owner.size() != mesh.faces.size()) {
        owner.fail(std::to_string(mesh.owner.size()) + " owners for " + std::to_string(mesh.faces.size()) +
                   " faces");
    }
    FoamScanner neighbour = open("neighbour");
    mesh.neighbour = neighbour.labelList();
    if (mesh.neighbour.size() > mesh.faces.size()) {
        neighbour.fail(std::to_string(mesh.neighbour.size()) + " neighbours for " +
                       std::to_string(mesh.faces.size()) + " faces");
    }
    mesh.patches = readBoundary(open("boundary"), mesh.faces.size());

    if (fileExists(folder / "cellZones")) {
        int cells = 0;
        for (const std::vector<int>* list : {&mesh.owner, &mesh.neighbour}) {
            cells =
                list->empty() ? cells : std::max(cells, 1 + *std::max_element(list->begin(), list->end()));
        }
        mesh.cellZones = readCellZones(open("cellZones"), cells);
    }
    return mesh;
}

void writePolyMesh(const fs::path& caseDirectory, const PolyMesh& mesh, const WriteStyle& style)
{
    const fs::path constant = caseDirectory / "constant";
    const auto write = [&](const char* className, const char* object, const std::string& body,
                           const WriteStyle& as) {
        writeFoamFile(constant, "polyMesh", className, object, body, as);
    };
    for (const char* stale : {"cellZones", "faceZones", "pointZones", "sets"}) {
        fs::remove_all(constant / "polyMesh" / stale);
        fs::remove(constant / "polyMesh" / (std::string(stale) + ".gz"));
    }
    writePoints(constant, mesh.points, style);
    write(style.binary ? "faceCompactList" : "faceList", "faces",
          style.binary ? faceCompactList(mesh.faces) : faceList(mesh.faces), style);
    write("labelList", "owner", labelList(mesh.owner, style.binary), style);
    write("labelList", "neighbour", labelList(mesh.neighbour, style.binary), style);
    write("polyBoundaryMesh", "boundary", boundaryList(mesh.patches), {.binary = false, .compressed = false});
    if (!mesh.cellZones.empty()) {
        write("regIOobject", "cellZones", zoneList(mesh.cellZones, style.binary), style);
    }
}

} // namespace caisson

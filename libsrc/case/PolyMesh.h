#pragma once

#include "case/FoamFile.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace caisson {

struct PolyPatch
{
    std::string name;
    std::string type;
    int startFace = 0;
    int faces = 0;
};

struct PolyZone
{
    std::string name;
    std::vector<int> cells;
};

/// constant/polyMesh as it stands on disk.
struct PolyMesh
{
    std::vector<std::array<double, 3>> points;
    std::vector<std::vector<int>> faces;
    std::vector<int> owner;
    std::vector<int> neighbour;
    std::vector<PolyPatch> patches;
    std::vector<PolyZone> cellZones;
    std::string directory; ///< as messages call it: "constant/polyMesh"
};

/// Reads points, faces, owner, neighbour, boundary and, where present, cellZones; ascii or binary, .gz where
/// the plain file is missing. `pointsFrom` (a time directory with polyMesh/points) replaces the points.
/// @throws InputError naming the missing or broken file and the command that would make the mesh
PolyMesh readPolyMesh(const std::filesystem::path& caseDirectory,
                      const std::filesystem::path& pointsFrom = {});

/// Writes points, faces, owner, neighbour, boundary and, where there are any, cellZones of constant/polyMesh;
/// removes what another mesh left there: zones and sets of faces, points or cells.
void writePolyMesh(const std::filesystem::path& caseDirectory, const PolyMesh& mesh, const WriteStyle& style);

} // namespace caisson

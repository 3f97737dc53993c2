#pragma once

#include "constitutive/Material.h"
#include "function1/Function1.h"
#include "materialPoints/CellDivision.h"
#include "mesh/MeshMotion.h"

#include <memory>
#include <string>
#include <vector>

namespace caisson {

/// A box within which points are no farther apart than maxSpacing, in the directions of r and z [m], and
/// cells divided at least as often as in `division`.
struct SeedRefinement
{
    std::array<double, 2> low, high;
    std::array<double, 2> maxSpacing;
    CellDivision division;
};

/// A part of the mesh that is filled with one material.
struct SeedRegion
{
    SourceLocation where;
    std::string type;
    std::string zone;                            ///< of type cellZone
    std::vector<std::array<double, 2>> boundary; ///< of box, polygon and circle: closed polygon [m]
    std::array<double, 2> centre{};              ///< of circle [m]
    double radius = 0;                           ///< of circle [m]
    int material = 0;
    CellDivision division;
    std::vector<SeedRefinement> refinements;
    std::vector<double> passingHeight; ///< of the moving mesh, at each cell [m]; empty: not asked for
    std::shared_ptr<const Function1> velocityR, velocityZ; ///< of r and of z [m/s]; none: at rest

    /// Whether the region holds the place (r, z); true for regions made of whole cells.
    [[nodiscard]] bool contains(double r, double z) const;
    /// The cells that the region may reach into, ascending.
    [[nodiscard]] std::vector<int> cells(const BackgroundMesh& mesh) const;
    /// Volume of the region within a cell, exact (circle: a polygon of 720 sides and the same area).
    [[nodiscard]] double volumeWithin(const BackgroundMesh& mesh, int cell) const;
};

std::vector<std::string> seedRegionTypes();
/// Keywords of a region of the given type, for reading and the user guide.
std::vector<Keyword> seedRegionKeywords(const std::string& type);
std::span<const Keyword> seedRefinementKeywords(); ///< of one of a region's refinements
std::span<const Keyword> seedVelocityKeywords();   ///< of a region's velocity

std::vector<Keyword> regionShapeKeywords(const std::string& type); ///< of shape and place alone
/// Reads the type of a region; an unknown one is a problem. @returns whether it is known
bool readRegionType(const Dictionary& dictionary, SeedRegion& region, InputProblems& problems);
/// Reads shape and place, once the type is known.
void readRegionShape(const KeywordReader& reader, const BackgroundMesh& mesh, SeedRegion& region);

/// Reads `regions ( { type box; min (0 -20); max (15 0); material sand; pointsPerCell (2 2); } ... );`.
std::vector<SeedRegion> readSeedRegions(const std::vector<Dictionary>& regions, const BackgroundMesh& mesh,
                                        const std::vector<Material>& materials, InputProblems& problems,
                                        const MeshMotion& motion = {});

} // namespace caisson

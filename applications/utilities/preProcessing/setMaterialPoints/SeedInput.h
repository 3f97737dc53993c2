#pragma once

#include "bodies/RigidBody.h"
#include "case/ControlDict.h"
#include "materialPoints/InitialState.h"
#include "materialPoints/PointLoads.h"
#include "materialPoints/StateTransfer.h"

#include <filesystem>
#include <optional>

namespace caisson {

/// All that setMaterialPoints reads of a case.
struct SeedInput
{
    ControlDict control;
    std::filesystem::path startDirectory; ///< the time directory that the points go into
    BackgroundMesh mesh;
    std::vector<Material> materials;
    std::vector<RigidBody> bodies;
    std::array<double, 2> gravity{}; ///< r, z [m/s2]
    std::vector<SeedRegion> regions;
    InitialState initialState;
    std::optional<EarlierPoints> earlier;            ///< of initialState fromTime
    std::optional<InitialPorePressure> porePressure; ///< of two-phase soil
    std::vector<PointLoad> pointLoads;
    std::vector<LoadedSurface> loadedSurfaces;
};

std::span<const Keyword> setMaterialPointsKeywords();

/// Reads the case and its setMaterialPointsDict.
/// @param dictionaryFile  relative to the case
/// @throws InputError with every problem found
SeedInput readSeedInput(const std::filesystem::path& caseDirectory,
                        const std::filesystem::path& dictionaryFile);

} // namespace caisson

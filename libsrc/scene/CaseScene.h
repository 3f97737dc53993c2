#pragma once

#include "timeStepping/TimeStep.h"

#include <filesystem>
#include <map>

namespace caisson {

/// A case as the solver runs it: what does not change, and the state to start from.
struct CaseScene
{
    Scene scene;
    State state;
    std::vector<std::string> stateNames; ///< of the points' state variables
    /// boundaryField of 0/U by patch, to be written again with every time.
    std::vector<std::pair<std::string, std::string>> patchEntries;
    /// The same of 0/p; empty for one phase.
    std::vector<std::pair<std::string, std::string>> pressureEntries;
    double monitorInterval = 0; ///< [s]
};

/// Reads and checks everything but system/controlDict: mesh, materials, bodies, gravity, conditions,
/// switches, mesh motion, and the material points of the start time. All problems are collected.
/// @param start      the time directory to start from
/// @param restarted  whether a run wrote it
/// @param kept       numbers that the run kept (see keptNumbers)
/// @throws InputError where reading cannot go on (no mesh, say)
CaseScene readCaseScene(const std::filesystem::path& caseDirectory, const std::filesystem::path& start,
                        bool restarted, const std::map<std::string, std::vector<double>>& kept,
                        InputProblems& problems);

/// Pore pressure of freshly filled points in the steady seepage that 0/p asks for [Pa]; their own is not
/// looked at. For setMaterialPoints.
/// @throws InputError with every problem of 0/p and of the liquid's properties
std::vector<double> readSeepagePressure(const std::filesystem::path& caseDirectory, const std::string& start,
                                        const BackgroundMesh& mesh, const MaterialPoints& points,
                                        const std::array<double, 2>& gravity);

/// Keys of constant/g.
std::span<const Keyword> gravityKeywords();

/// The numbers of the state that are neither points nor cells: what uniform/time keeps.
std::map<std::string, std::vector<double>> keptNumbers(const State& state);

/// Names of all state variables of the materials, each once, in the order in which the points keep them.
/// Materials share the places: variable k of every law is place k.
std::vector<std::string> stateVariableNames(const std::vector<Material>& materials);

} // namespace caisson

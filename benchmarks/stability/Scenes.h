#pragma once

#include "support/Simulation.h"

#include <string>

/// Small scenes with one thing driven to an extreme, for the map of where the code stays stable.
namespace caisson::stability {

using testing::Simulation;

/// One of the compiled kernels.
struct Kernel
{
    int phases = 1;
    bool triangles = false;
    Geometry geometry = Geometry::axisymmetric;
    [[nodiscard]] std::string name() const; ///< e.g. "2 phases, triangles"
};

struct Soil
{
    double youngsModulus = 6e7, poissonsRatio = 0.25;
    bool plastic = false;
    double frictionAngle = 38, dilatancyAngle = 0, cohesion = 0; ///< [deg], [Pa]
    double permeability = 1e-11, liquidBulkModulus = 2e7;

    static constexpr double porosity = 0.35, solidDensity = 2650, liquidDensity = 1000, viscosity = 1e-3;
    static constexpr double buoyantWeight = (1 - porosity) * (solidDensity - liquidDensity) * 9.81;
    [[nodiscard]] std::string dictionary() const;
    /// Largest value of the yield function over all points, over the largest stress; negative: elastic.
    [[nodiscard]] double yieldExcess(const MaterialPoints& points) const;
};

/// A block of soil in a box of rollers, its top free, with random velocities at the points.
struct Block
{
    Kernel kernel;
    Soil soil{};
    int columns = 10, rows = 10;
    double cellWidth = 0.1, cellHeight = 0.1; ///< [m]
    int emptyRows = 2;                        ///< of cells above the soil; 0: the soil ends with the mesh
    int pointsPerSide = 2;                    ///< of quadrilaterals; 1 or more: triangles have 1 or 3 points
    bool randomPlaces = false;                ///< anywhere in their cells, with their volumes
    bool hole = false;                        ///< one cell in the middle is empty
    double gravity = 9.81;
    double noise = 1e-3; ///< of the velocities, over the speed of waves
    SolutionControls::Drag drag = SolutionControls::Drag::implicit;
    double massScaling = 1;
    unsigned seed = 1;
};
Simulation make(const Block& block);

/// The skirt of a caisson on its way into sand, 0.2 m thick on cells of 0.1 m, the mesh going with it.
struct Skirt
{
    Kernel kernel;
    Soil soil{.plastic = true};
    double friction = 0.15, rate = 0.2, ramp = 0.05; ///< [-], [m/s], [s]
    double massScaling = 1;
};
Simulation make(const Skirt& skirt);

/// A column one cell wide between rollers, of height 1 m; two-phase soil is drained at its top.
struct Column
{
    Kernel kernel;
    Soil soil{};
    int cells = 10, emptyCells = 2, pointsPerSide = 2;
    double gravity = 0;
    std::string top = "type zeroGradient;";        ///< condition on the velocity
    std::string bottomWater = "type impermeable;"; ///< condition on the pressure
    std::string topWater = "type impermeable;";    ///< likewise; where soil ends with the mesh
};
Simulation make(const Column& column);

inline constexpr double diskRadius = 0.4, diskCentre = 0.6; ///< [m], of r and z alike

/// A free disk in plane strain, on cells of a quarter of its radius, that turns with a given speed of its
/// rim.
Simulation turningDisk(const Kernel& kernel, const Soil& soil, double rimSpeed, int cells);

/// Fastest wave as the kernels see it: of the limiting cell of an unscaled scene.
double waveSpeed(const Simulation& simulation);

/// Kinetic energy of solid and liquid, with their own velocities [J/rad or J/m].
double kineticEnergy(const Simulation& simulation);

/// Of a turning disk about its centre [N m s/m].
double angularMomentum(const Simulation& simulation);

/// Largest change of a point's distance from the centre of its disk [m].
double offCircle(const Simulation& simulation);

/// Places in the cells found anew, after points have been put elsewhere.
void findCells(Simulation& simulation);

} // namespace caisson::stability

#pragma once

#include "timeStepping/Threads.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace caisson {

/// Largest stable step of triangles, from the vibration that is the stiffest for the scheme. With K the
/// stiffness, M the lumped masses of the nodes, C the consistent ones of the points, u the nodal
/// displacements and v the nodal velocities mapped from the points, a step without remapping is
///
///     u' = u + dt (v - dt M^-1 K u),     v' = v - dt M^-1 C M^-1 K u,
///
/// which ends to be stable where a vibration changes its sign in every step, at 4/dt^2 = the largest
/// eigenvalue of
///
///     (2 M^-1 - M^-1 C M^-1) K.
///
/// Proof: between symmetric matrices, a = M^-1/2 K M^-1/2 and g = a^1/2 (I - M^-1/2 C M^-1/2) a^1/2 <= a,
/// eliminating v leaves z^2 - (2 - dt^2 a) z + 1 - dt^2 g = 0 in the Rayleigh quotients a, g of a vibration,
/// whose roots stay in the unit circle for dt^2 (a + g) <= 4 [Jury's conditions for a real quadratic]. Nodes
/// that are remapped (the strains see what the points have kept) have M^-1 C M^-1 alone, which is less.
///
/// The operator is that of the step: own strains of a cell for shear, dilatations averaged over nodes
/// [Detournay & Dzik 2006], the masses of the points where they are, what is held. Water is without drag,
/// which can only slow it down: its pressures act on (1-n) v + n w (LiquidKernels.h). The eigenvalue is found
/// by Lanczos' method [Lanczos 1950] with K times the bracket, which is symmetric in the inner product of the
/// bracket, from below: see margin.
template <int phases>
class StiffestMode
{
public:
    static constexpr int corners = 3;
    static constexpr int components = 2 * phases; ///< of a node: of the soil, of its liquid
    /// Share of the step that follows from the eigenvalue: it is found from below, and points move until it
    /// is found again.
    static constexpr double margin = 0.95;

    using Vector = std::array<double, components>;
    /// Symmetric projector on what may move, rr, rz, zz.
    using Projector = std::array<double, 3>;

    struct Cell
    {
        std::array<int, corners> node{};
        std::array<double, corners> gr{}, gz{}, h{}; ///< means of dN/dr, dN/dz, N/r over what is stressed
        double volume = 0;                           ///< weight in the averages of nodes
        double stressed = 0, wet = 0;                ///< volumes that soil and liquid are integrated over
        double shear = 0, bulk = 0;                  ///< moduli of the soil [Pa]
        double storage = 0;                          ///< of the liquid: bulk modulus over porosity [Pa]
        double porosity = 0;
        std::array<double, corners> fullMass{}; ///< of the soil at the corners, were the cell evenly filled
        /// Integral of density N_k N_l of each phase: 00, 11, 22, 01, 12, 20.
        std::array<std::array<double, 6>, phases> mass{};
    };

    struct Node
    {
        bool loose = false; ///< is remapped
        std::array<Projector, phases> free;

        Node() { free.fill({1, 0, 1}); }
        /// No velocity of this phase along a unit vector.
        void hold(int phase, const std::array<double, 2>& n)
        {
            Projector& p = free[phase];
            if (p[0] != 1 || p[2] != 1) { // held along another one already, as a rule
                const double left = p[0] * n[0] * n[0] + 2 * p[1] * n[0] * n[1] + p[2] * n[1] * n[1];
                if (left > 1e-6) {
                    p = {0, 0, 0};
                }
                return;
            }
            p = {1 - n[0] * n[0], -n[0] * n[1], 1 - n[1] * n[1]};
        }
    };

    std::vector<Cell> cells;
    std::vector<Node> nodes;
    bool averaged = true;  ///< dilatations over nodes
    double looseShare = 0; ///< nodes with a smaller share of their full mass are loose, too

    /// Sums over the cells, and what all multiplications share; before one of the steps is asked for.
    void prepare(Threads& threads)
    {
        const int count = static_cast<int>(nodes.size());
        start_.assign(count + 1, 0);
        for (const Cell& cell : cells) {
            for (const int i : cell.node) {
                ++start_[i + 1];
            }
        }
        for (int i = 0; i < count; ++i) {
            start_[i + 1] += start_[i];
        }
        corner_.resize(cells.size() * corners);
        cursor_.assign(start_.begin(), start_.end() - 1);
        for (std::size_t k = 0; k < corner_.size(); ++k) {
            corner_[cursor_[cells[k / corners].node[k % corners]]++] = static_cast<int>(k);
        }
        inverseMass_.resize(count);
        inverseVolume_.resize(count);
        porosity_.resize(count);
        average_.resize(count);
        atCorner_.resize(corner_.size());
        rate_.resize(cells.size());
        scaled_.resize(count);
        for (auto* vector : {&force_, &before_, &next_, &image_, &nextImage_}) {
            vector->assign(count, Vector{});
        }
        forNodes(threads, [&](int i) {
            std::array<double, phases> mass{};
            double volume = 0, pores = 0, fullMass = 0;
            for (int j = start_[i]; j < start_[i + 1]; ++j) {
                const int k = corner_[j] % corners;
                const Cell& cell = cells[corner_[j] / corners];
                volume += cell.volume;
                pores += cell.volume * cell.porosity;
                fullMass += cell.fullMass[k];
                for (int f = 0; f < phases; ++f) {
                    mass[f] += cell.mass[f][k] + cell.mass[f][3 + k] + cell.mass[f][3 + (k + 2) % 3];
                }
            }
            inverseVolume_[i] = 1 / volume;
            porosity_[i] = pores / volume;
            nodes[i].loose = nodes[i].loose || mass[0] < looseShare * fullMass;
            for (int f = 0; f < phases; ++f) {
                inverseMass_[i][f] = mass[f] > 0 ? 1 / mass[f] : 0;
            }
        });
        // A loose node and another one: what the one has of the other's forces is opposite in sign to what
        // the other has of its own, and cancels out of the energy.
        forCells(threads, [&](int c) {
            Cell& cell = cells[c];
            for (int k = 0; k < corners; ++k) {
                for (int f = 0; f < phases; ++f) {
                    if (nodes[cell.node[k]].loose != nodes[cell.node[(k + 1) % 3]].loose) {
                        cell.mass[f][3 + k] = 0;
                    }
                }
            }
        });
    }
    /// Step at which the stiffest vibration grows, less a margin [s]; infinite where nothing can vibrate.
    double step(Threads& threads) { return stepOf<true>(threads); }
    /// The same, if the points kept all that the nodes have (C = M): 2/omega, less the margin [s].
    double stepOfNodes(Threads& threads) { return stepOf<false>(threads); }

private:
    static constexpr int fewest = 10, most = 60, between = 5; // multiplications
    static constexpr double growth = 2e-3;                    // of the eigenvalue in so many, at the end
    static constexpr int cellsPerPiece = 64;

    template <bool points>
    double stepOf(Threads& threads)
    {
        const double largest = largestEigenvalue<points>(threads);
        return largest == 0 ? std::numeric_limits<double>::infinity() : margin * 2 / std::sqrt(largest);
    }

    template <bool points>
    double largestEigenvalue(Threads& threads)
    {
        // Any vector will do that has a share in every vibration.
        unsigned random = 1;
        const auto number = [&random] {
            random = 1664525u * random + 1013904223u; // Knuth's linear congruential generator
            return random * 0x1p-31 - 1;
        };
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            for (double& component : force_[i]) {
                component = number();
            }
            project(nodes[i], force_[i]);
        }
        accelerate<points>(threads, force_, image_);
        double norm = std::sqrt(dot(force_, image_));
        if (!(norm > 0)) { // nothing moves, or no number
            return norm;
        }
        scale(force_, image_, 1 / norm);
        diagonal_.clear();
        beside_.clear();
        double largest = 0, stiffest = 0;
        for (int j = 1; j <= most; ++j) {
            multiply(threads, image_, next_);
            const double a = dot(next_, image_);
            const double b = beside_.empty() ? 0 : beside_.back();
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                for (int d = 0; d < components; ++d) {
                    next_[i][d] -= a * force_[i][d] + b * before_[i][d];
                }
            }
            diagonal_.push_back(a);
            accelerate<points>(threads, next_, nextImage_);
            norm = std::sqrt(std::max(0.0, dot(next_, nextImage_)));
            // No other vibration is left: what follows would be rounding.
            stiffest = std::max(stiffest, a);
            const bool complete = !(norm > 1e-6 * stiffest);
            if (j % between == 0 || complete) {
                const double found = largestOfTridiagonal();
                if (complete || (j >= fewest && found - largest <= growth * found)) {
                    return found;
                }
                largest = found;
            }
            beside_.push_back(norm);
            scale(next_, nextImage_, 1 / norm);
            std::swap(before_, force_);
            std::swap(force_, next_);
            std::swap(image_, nextImage_);
        }
        return largest;
    }

    [[nodiscard]] double largestOfTridiagonal() const
    {
        const auto size = static_cast<Eigen::Index>(diagonal_.size());
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
        solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal_.data(), size),
                                      Eigen::Map<const Eigen::VectorXd>(beside_.data(), size - 1),
                                      Eigen::EigenvaluesOnly);
        return solver.eigenvalues().maxCoeff();
    }

    /// Forces of displacements, positive against them.
    void multiply(Threads& threads, const std::vector<Vector>& displacement, std::vector<Vector>& force)
    {
        // Roots of the stiffnesses: with partly filled cells and several soils the product stays symmetric.
        forCells(threads, [&](int c) {
            const Cell& cell = cells[c];
            std::array<double, phases> rate{};
            for (int k = 0; k < corners; ++k) {
                const Vector& u = displacement[cell.node[k]];
                const double r = cell.gr[k] + cell.h[k];
                rate[0] += r * u[0] + cell.gz[k] * u[1];
                if constexpr (phases == 2) {
                    const double n = porosity_[cell.node[k]];
                    rate[1] += r * (u[0] + n * (u[2] - u[0])) + cell.gz[k] * (u[1] + n * (u[3] - u[1]));
                }
            }
            rate_[c][0] = rate[0] * std::sqrt(cell.bulk * cell.stressed * cell.volume);
            if constexpr (phases == 2) {
                rate_[c][1] = rate[1] * std::sqrt(cell.storage * cell.wet * cell.volume);
            }
        });
        if (averaged) {
            forNodes(threads, [&](int i) {
                std::array<double, phases> sum{};
                for (int j = start_[i]; j < start_[i + 1]; ++j) {
                    for (int f = 0; f < phases; ++f) {
                        sum[f] += rate_[corner_[j] / corners][f];
                    }
                }
                for (int f = 0; f < phases; ++f) {
                    average_[i][f] = sum[f] * inverseVolume_[i] / corners;
                }
            });
        }
        forCells(threads, [&](int c) {
            const Cell& cell = cells[c];
            std::array<double, phases> mean{};
            if (averaged) {
                for (int k = 0; k < corners; ++k) {
                    for (int f = 0; f < phases; ++f) {
                        mean[f] += average_[cell.node[k]][f];
                    }
                }
            } else {
                for (int f = 0; f < phases; ++f) {
                    mean[f] = rate_[c][f] / cell.volume;
                }
            }
            double rr = 0, zz = 0, hoop = 0, rz = 0;
            for (int k = 0; k < corners; ++k) {
                const Vector& u = displacement[cell.node[k]];
                rr += cell.gr[k] * u[0];
                zz += cell.gz[k] * u[1];
                hoop += cell.h[k] * u[0];
                rz += cell.gz[k] * u[0] + cell.gr[k] * u[1];
            }
            const double third = (rr + zz + hoop) / 3;
            const double shear = cell.shear * cell.stressed;
            const double pressure = mean[0] * std::sqrt(cell.bulk * cell.stressed * cell.volume);
            rr = 2 * shear * (rr - third) + pressure;
            zz = 2 * shear * (zz - third) + pressure;
            hoop = 2 * shear * (hoop - third) + pressure;
            rz *= shear;
            for (int k = 0; k < corners; ++k) {
                Vector& f = atCorner_[c * corners + k];
                f[0] = cell.gr[k] * rr + cell.h[k] * hoop + cell.gz[k] * rz;
                f[1] = cell.gz[k] * zz + cell.gr[k] * rz;
                if constexpr (phases == 2) {
                    const double n = porosity_[cell.node[k]];
                    const double water = mean[1] * std::sqrt(cell.storage * cell.wet * cell.volume);
                    const double r = (cell.gr[k] + cell.h[k]) * water;
                    const double z = cell.gz[k] * water;
                    f[0] += (1 - n) * r;
                    f[1] += (1 - n) * z;
                    f[2] = n * r;
                    f[3] = n * z;
                }
            }
        });
        forNodes(threads, [&](int i) {
            force[i] = gather(i);
            project(nodes[i], force[i]);
        });
    }

    /// result = (2 M^-1 - M^-1 C M^-1) force, of loose nodes without the first and with the other sign; or
    /// M^-1 force.
    template <bool points>
    void accelerate(Threads& threads, const std::vector<Vector>& force, std::vector<Vector>& result)
    {
        forNodes(threads, [&](int i) {
            for (int d = 0; d < components; ++d) {
                scaled_[i][d] = inverseMass_[i][d / 2] * force[i][d];
            }
            if constexpr (!points) {
                result[i] = scaled_[i];
                project(nodes[i], result[i]);
            }
        });
        if constexpr (!points) {
            return;
        }
        forCells(threads, [&](int c) {
            const Cell& cell = cells[c];
            for (int k = 0; k < corners; ++k) {
                const int after = (k + 1) % 3, last = (k + 2) % 3;
                Vector& atCorner = atCorner_[c * corners + k];
                for (int d = 0; d < components; ++d) {
                    const auto& m = cell.mass[d / 2];
                    atCorner[d] = m[k] * scaled_[cell.node[k]][d] + m[3 + k] * scaled_[cell.node[after]][d] +
                                  m[3 + last] * scaled_[cell.node[last]][d];
                }
            }
        });
        forNodes(threads, [&](int i) {
            const Vector kept = gather(i);
            const bool loose = nodes[i].loose;
            for (int d = 0; d < components; ++d) {
                const double ofPoints = inverseMass_[i][d / 2] * kept[d];
                result[i][d] = loose ? ofPoints : 2 * scaled_[i][d] - ofPoints;
            }
            project(nodes[i], result[i]);
        });
    }

    [[nodiscard]] Vector gather(int i) const
    {
        Vector sum{};
        for (int j = start_[i]; j < start_[i + 1]; ++j) {
            for (int d = 0; d < components; ++d) {
                sum[d] += atCorner_[corner_[j]][d];
            }
        }
        return sum;
    }

    static void project(const Node& node, Vector& v)
    {
        for (int f = 0; f < phases; ++f) {
            const Projector& p = node.free[f];
            const double r = v[2 * f], z = v[2 * f + 1];
            v[2 * f] = p[0] * r + p[1] * z;
            v[2 * f + 1] = p[1] * r + p[2] * z;
        }
    }

    /// In the order of the nodes: the same bits for any number of threads.
    static double dot(const std::vector<Vector>& a, const std::vector<Vector>& b)
    {
        Vector sum{};
        for (std::size_t i = 0; i < a.size(); ++i) {
            for (int d = 0; d < components; ++d) {
                sum[d] += a[i][d] * b[i][d];
            }
        }
        double total = 0;
        for (const double part : sum) {
            total += part;
        }
        return total;
    }
    static void scale(std::vector<Vector>& a, std::vector<Vector>& b, double factor)
    {
        for (std::size_t i = 0; i < a.size(); ++i) {
            for (int d = 0; d < components; ++d) {
                a[i][d] *= factor;
                b[i][d] *= factor;
            }
        }
    }

    template <class Work>
    void forCells(Threads& threads, const Work& work) const
    {
        share(threads, static_cast<int>(cells.size()), work);
    }
    template <class Work>
    void forNodes(Threads& threads, const Work& work) const
    {
        share(threads, static_cast<int>(nodes.size()), work);
    }
    template <class Work>
    static void share(Threads& threads, int count, const Work& work)
    {
        threads.share(count, cellsPerPiece, [&](int, int begin, int end) {
            for (int i = begin; i < end; ++i) {
                work(i);
            }
        });
    }

    std::vector<int> start_, corner_, cursor_; // corners around each node
    std::vector<std::array<double, phases>> inverseMass_, rate_, average_;
    std::vector<double> inverseVolume_, porosity_;
    std::vector<Vector> atCorner_, scaled_, force_, before_, next_, image_, nextImage_;
    std::vector<double> diagonal_, beside_;
};

} // namespace caisson

#pragma once

#include "timeStepping/ExplicitStepKernels.h"

// What the cells are: their shape now, who computes them, and which of them are filled.
namespace caisson {

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::updateCells(const State& state)
{
    const auto update = [&](int c) {
        if (resting(c)) {
            return;
        }
        double r[corners];
        double z[corners];
        for (int k = 0; k < corners; ++k) {
            r[k] = state.mesh.r[cellNodes_[c * corners + k]];
            z[k] = state.mesh.z[cellNodes_[c * corners + k]];
        }
        if constexpr (requires { Shape::isAt(cells_[c], r, z); }) {
            if (Shape::isAt(cells_[c], r, z)) {
                return;
            }
        }
        cells_[c] = Shape::make(r, z);
        dilatation_[c] = Shape::meanDilatation(cells_[c]);
    };
    forAwakeCells(update);
    threads_.share(static_cast<int>(emptyCells_.size()), pointsPerPiece, [&](int, int begin, int end) {
        for (int i = begin; i < end; ++i) {
            update(emptyCells_[i]);
        }
    });
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::divideCells()
{
    awake_.items.clear();
    std::ranges::copy_if(active_.items, std::back_inserter(awake_.items),
                         [this](int c) { return !resting(c) || !femCells_[femOf_[c]].inner; });
    divide(active_);
    divide(awake_);
    findOuterNodes();
}

/// Those of the cells that are awake, in the order of the cells; inner nodes only while cells rest.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::findOuterNodes()
{
    outerNodes_.items.clear();
    outerNodes_.part.assign(1, 0);
    std::vector<unsigned char> found(nodes_.size(), 0);
    for (int part = 0; part < threads_.count(); ++part) {
        for (int j = awake_.part[part]; j < awake_.part[part + 1]; ++j) {
            for (int k = 0; k < corners; ++k) {
                const int i = cellNodes_[awake_.items[j] * corners + k];
                if (!found[i] && (innerNode_.empty() || innerNode_[i] == 0)) {
                    found[i] = 1;
                    outerNodes_.items.push_back(i);
                }
            }
        }
        outerNodes_.part.push_back(static_cast<int>(outerNodes_.items.size()));
    }
}

/// Parts with about as many points in each.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::divide(WorkList& list) const
{
    const auto cost = [this](int c) { return 1 + (resting(c) ? 0 : pointCells_.count(c)); };
    long long total = 0;
    for (const int c : list.items) {
        total += cost(c);
    }
    const int threads = threads_.count();
    list.part.assign(threads + 1, static_cast<int>(list.items.size()));
    long long sum = 0;
    int part = 0;
    for (int i = 0; i < static_cast<int>(list.items.size()); ++i) {
        for (; part < threads && sum * threads >= total * part; ++part) {
            list.part[part] = i;
        }
        sum += cost(list.items[i]);
    }
}

/// Which cells have soil, and what follows from it.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::updateOccupancy(State& state)
{
    const int cells = state.mesh.cells();
    const int nodes = state.mesh.nodes();
    const auto nodeOf = [this](int c, int k) { return cellNodes_[c * corners + k]; };
    // Sums of cells that went empty must not linger, nor those of voids.
    const auto forget = [&](int c) {
        const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(c) * corners;
        std::fill_n(cornerSums_.begin() + first, corners, Corner{});
        if (twoPhase && pumped_) {
            std::fill_n(voidForce_.begin() + first, corners, std::array<double, 2>{});
        }
    };
    std::ranges::for_each(voidCells_, forget);
    occupied_.resize(cells, 0);
    surfaceNode_.assign(nodes, 0);
    active_.items.clear();
    emptyCells_.clear();
    for (int c = 0; c < cells; ++c) {
        if (pointCells_.count(c) > 0) {
            occupied_[c] = 1;
            active_.items.push_back(c);
            continue;
        }
        if (occupied_[c]) {
            forget(c);
        }
        occupied_[c] = 0;
        state.filled[c] = 0;
        emptyCells_.push_back(c);
        for (int k = 0; k < corners && !inside_[c]; ++k) {
            surfaceNode_[nodeOf(c, k)] = 1;
        }
    }
    bySurface_.assign(cells, 0);
    activeNode_.assign(nodes, 0);
    for (const int c : active_.items) {
        for (int k = 0; k < corners; ++k) {
            bySurface_[c] |= surfaceNode_[nodeOf(c, k)];
            activeNode_[nodeOf(c, k)] = 1;
        }
    }
    activeNodes_.clear();
    for (int i = 0; i < nodes; ++i) {
        if (activeNode_[i]) {
            activeNodes_.push_back(i);
        }
    }
    if constexpr (twoPhase) {
        voidCells_.clear();
        for (const int c : emptyCells_) {
            bool beside = false;
            for (int k = 0; k < corners; ++k) {
                beside = beside || activeNode_[nodeOf(c, k)];
            }
            if (beside && !inside_[c] && freeSurface_[c] >= 0) {
                voidCells_.push_back(c);
            }
        }
        // Nodes of several take the pressure of the last: that of a side rather than of what is over a wall.
        std::ranges::stable_partition(voidCells_, [this](int c) { return overWall_[c] != 0; });
        findFilterNodes();
    }
    stable_.step = 0;
    divideCells();
}

/// @param looks  whether cells are looked at that have neither got soil nor lost all of theirs
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::classifyCells(State& state, bool looks)
{
    if (occupancyChanged_) {
        updateOccupancy(state);
    } else if (!looks) {
        return;
    }
    occupancyChanged_ = false;
    const bool mixed = scene_.controls.integration == SolutionControls::Integration::mixed;
    forAwakeCells([&](int c) {
        if (resting(c)) {
            return;
        }
        bool filled = mixed && !bySurface_[c] && !inBoxes(c);
        if (filled) {
            double volume = 0;
            for (const int* p = pointCells_.begin(c); p != pointCells_.end(c); ++p) {
                volume += state.points.volume[*p];
            }
            filled = volume >
                     (state.filled[c] ? kernels::leastFill : kernels::leastFill + kernels::fillHysteresis) *
                         dilatation_[c].volume;
        }
        state.filled[c] = filled;
    });
    if (!fit_.empty()) {
        findPartialNodes(state);
    }
}

/// Beside cells that count their points as they are, the others do so too: nodes must not weigh points of one
/// row in two ways.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::findPartialNodes(const State& state)
{
    std::ranges::fill(partialNode_, 0);
    for (const int c : active_.items) {
        for (int k = 0; !state.filled[c] && k < corners; ++k) {
            partialNode_[cellNodes_[c * corners + k]] = 1;
        }
    }
    forCells([&](int c) {
        byPartial_[c] = 0;
        for (int k = 0; k < corners; ++k) {
            byPartial_[c] |= partialNode_[cellNodes_[c * corners + k]];
        }
    });
}

template <class Shape, int phases>
CellCounts ExplicitStep<Shape, phases>::cellCounts(const State& state) const
{
    CellCounts counts;
    for (std::size_t c = 0; c < cells_.size(); ++c) {
        if (inside_[c]) {
            ++counts.inside;
        } else if (!occupied_[c]) {
            ++counts.empty;
        } else if (resting(static_cast<int>(c))) {
            ++counts.fem;
        } else if (state.filled[c]) {
            ++counts.filled;
        } else {
            ++counts.partial;
        }
    }
    return counts;
}

} // namespace caisson

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Border following after S. Suzuki and K. Abe, "Topological structural analysis of digitized binary images by border
// following" (1985). Departure: what has been followed is marked not in the image but in a list of the ends of every
// row's runs of liquid, each of which one border passes once. A border begins at the first of its own, so that all are
// found from the list: the pixels are read once and neither copied nor written.

#include "footprint/borders.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace droplet {
namespace {

/// The ends of all runs of liquid: in every row the first pixels of runs and of the gaps after them, in turn.
struct RunEnds {
    std::vector<int> columns;
    std::vector<std::size_t> rows;  ///< where each row begins in `columns`, and where the last ends

    [[nodiscard]] std::size_t find(int row, int column) const
    {
        const auto begin = columns.begin() + static_cast<std::ptrdiff_t>(rows[static_cast<std::size_t>(row)]);
        const auto end = columns.begin() + static_cast<std::ptrdiff_t>(rows[static_cast<std::size_t>(row) + 1]);
        return static_cast<std::size_t>(std::lower_bound(begin, end, column) - columns.begin());
    }
};

/// Appends the ends of a row's runs.
void appendRunEnds(const std::uint16_t* row, int width, std::uint16_t level, std::vector<int>& ends)
{
    // Compilers make vector instructions of the count, which passes over all but the few blocks that hold an end.
    constexpr int kBlock = 128;
    std::array<int, kBlock> found;
    bool liquid = false;
    for (int first = 0; first < width; first += kBlock) {
        const int pixels = std::min(kBlock, width - first);
        std::uint16_t covered = 0;
        for (int i = 0; i < pixels; ++i) {
            covered = static_cast<std::uint16_t>(covered + (row[first + i] >= level ? 1 : 0));
        }
        if (covered == (liquid ? pixels : 0)) {
            continue;
        }
        std::size_t count = 0;
        for (int i = 0; i < pixels; ++i) {
            const bool here = row[first + i] >= level;
            found[count] = first + i;
            count += here != liquid ? 1 : 0;
            liquid = here;
        }
        ends.insert(ends.end(), found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count));
    }
    if (liquid) {
        ends.push_back(width);
    }
}

RunEnds findRunEnds(const Mask& mask, std::uint16_t level)
{
    const auto width = static_cast<std::size_t>(mask.width);
    const auto height = static_cast<std::size_t>(mask.height);
    // Bands of rows are searched in parallel; enough for any number of threads, few enough to join at once.
    constexpr std::size_t kBand = 32;
    std::vector<std::vector<int>> bands((height + kBand - 1) / kBand);
    RunEnds ends;
    ends.rows.resize(height + 1);
    tbb::parallel_for(std::size_t{0}, bands.size(), [&](std::size_t band) {
        for (std::size_t y = band * kBand; y < std::min(height, (band + 1) * kBand); ++y) {
            appendRunEnds(mask.coverage.data() + y * width, mask.width, level, bands[band]);
            ends.rows[y + 1] = bands[band].size();
        }
    });
    for (std::size_t band = 0; band < bands.size(); ++band) {
        for (std::size_t y = band * kBand; y < std::min(height, (band + 1) * kBand); ++y) {
            ends.rows[y + 1] += ends.columns.size();
        }
        ends.columns.insert(ends.columns.end(), bands[band].begin(), bands[band].end());
    }
    return ends;
}

/// The next crossing of the border that has one.
Crossing next(const Mask& mask, std::uint16_t level, const Crossing& at)
{
    const auto liquid = [&](int x, int y) {
        return x >= 0 && y >= 0 && x < mask.width && y < mask.height && mask.at(x, y) >= level;
    };
    const Step d = at.toward();
    const int facing = (at.direction + 1) % 4;
    const Step f = kSteps[static_cast<std::size_t>(facing)];
    // Liquid is 8-connected: at a saddle it joins.
    if (liquid(at.x + d.x + f.x, at.y + d.y + f.y)) {
        return {at.x + d.x + f.x, at.y + d.y + f.y, (facing + 2) % 4};
    }
    return liquid(at.x + f.x, at.y + f.y) ? Crossing{at.x + f.x, at.y + f.y, at.direction}
                                          : Crossing{at.x, at.y, facing};
}

}  // namespace

std::vector<Border> followBorders(const Mask& mask, std::uint16_t level)
{
    constexpr int kEast = 0;
    constexpr int kWest = 2;
    const RunEnds ends = findRunEnds(mask, level);
    std::vector<Border> borders;
    std::vector<std::uint8_t> followed(ends.columns.size(), 0);
    for (int y = 0; y < mask.height; ++y) {
        const std::size_t row = ends.rows[static_cast<std::size_t>(y)];
        for (std::size_t k = row; k < ends.rows[static_cast<std::size_t>(y) + 1]; ++k) {
            if (followed[k] != 0) {
                continue;
            }
            const bool begins = (k - row) % 2 == 0;
            const Crossing start =
                begins ? Crossing{ends.columns[k], y, kWest} : Crossing{ends.columns[k] - 1, y, kEast};
            Border& border = borders.emplace_back();
            Crossing at = start;
            do {
                border.push_back(at);
                if (at.direction == kWest) {
                    followed[ends.find(at.y, at.x)] = 1;
                } else if (at.direction == kEast) {
                    followed[ends.find(at.y, at.x + 1)] = 1;
                }
                at = next(mask, level, at);
            } while (!(at == start));
        }
    }
    return borders;
}

}  // namespace droplet

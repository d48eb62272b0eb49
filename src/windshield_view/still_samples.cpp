// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_view/still_samples.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "windshield_view/water_optics.h"

namespace droplet {

/// Cells of still droplets that changed.
class StillSamples::ChangedCells {
public:
    ChangedCells(const StillCells& still, const std::vector<std::size_t>& changed)
        : columns_(static_cast<int>(still.columns)),
          rows_(static_cast<int>(still.rows)),
          per_metre_(static_cast<float>(1.0 / still.cell)),
          flags_(std::size_t{still.columns} * still.rows, 0)
    {
        for (const std::size_t cell : changed) {
            flags_[cell] = 1;
        }
    }

    /// Whether a changed cell overlaps a box [m].
    [[nodiscard]] bool reach(Vec2f low, Vec2f high) const
    {
        const int top = index(high.y, rows_);
        const int right = index(high.x, columns_);
        for (int row = index(low.y, rows_); row <= top; ++row) {
            for (int column = index(low.x, columns_); column <= right; ++column) {
                if (flags_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                           static_cast<std::size_t>(column)] != 0) {
                    return true;
                }
            }
        }
        return false;
    }

private:
    [[nodiscard]] int index(float place, int count) const
    {
        return static_cast<int>(std::clamp(place * per_metre_, 0.0F, static_cast<float>(count - 1)));
    }

    int columns_;
    int rows_;
    float per_metre_;
    std::vector<std::uint8_t> flags_;
};

StillSamples::StillSamples(const ViewContext& scene)
    : scene_(scene), map_(scene.tiles.window(), scene.options.shape.contact_angle), samples_(scene.tiles.count())
{
}

void StillSamples::update(const StillCells& still)
{
    const std::vector<std::size_t> changed = map_.update(still);
    if (changed.empty()) {
        return;
    }
    const ChangedCells cells(still, changed);
    const Tiles& tiles = scene_.tiles;
    tbb::parallel_for(0, tiles.rows(), [&](int r) {
        for (int c = 0; c < tiles.columns(); ++c) {
            const ViewTile& tile = tiles[tiles.number(c, r)];
            if (tile.on_glass && cells.reach(tile.low, tile.high)) {
                sample(c, r, cells);
            }
        }
    });
}

/// Renews the samples of pixels that see a changed cell.
void StillSamples::sample(int column, int row, const ChangedCells& cells)
{
    const ViewOptions& options = scene_.options;
    const std::size_t number = scene_.tiles.number(column, row);
    const ViewTile& tile = scene_.tiles[number];
    std::vector<StillSample>& samples = samples_[number];
    const std::vector<StillSample> before = std::exchange(samples, {});
    samples.reserve(before.size() + kTilePixels);
    auto old = before.begin();
    // A texel belongs to the cell that contains its middle, so it may extend beyond the cell.
    const float margin = 1.0F / map_.perMetre();
    const Vec2f half{0.5F * (std::abs(tile.right.x) + std::abs(tile.down.x)) + margin,
                     0.5F * (std::abs(tile.right.y) + std::abs(tile.down.y)) + margin};
    const auto ior = static_cast<float>(options.ior);
    const float quarter = 0.25F / map_.perMetre();  // a quarter of a texel [m]
    std::uint8_t size = 0;                          // size of the last droplet, and its level
    std::uint8_t level = 0;
    for (int y = row * kTile; y < std::min((row + 1) * kTile, options.height); ++y) {
        for (int x = column * kTile; x < std::min((column + 1) * kTile, options.width); ++x) {
            const Vec2f middle = scene_.eye.place(x, y);
            if (std::isnan(middle.x)) {
                continue;
            }
            const auto pixel = pixelInTile(x, y);
            const auto first = old;
            while (old != before.end() && old->pixel == pixel) {
                ++old;
            }
            if (!cells.reach({middle.x - half.x, middle.y - half.y}, {middle.x + half.x, middle.y + half.y})) {
                samples.insert(samples.end(), first, old);
                continue;
            }
            for (int j = 0; j < options.samples; ++j) {
                for (int i = 0; i < options.samples; ++i) {
                    const float u = scene_.offset(i);
                    const float v = scene_.offset(j);
                    const Texel seen = map_.at(middle.x + u * tile.right.x + v * tile.down.x,
                                               middle.y + u * tile.right.y + v * tile.down.y);
                    if (seen.empty()) {
                        continue;
                    }
                    const Vec3f inside = intoWater(toFrame(tile.frame, scene_.eye.ray(x, y)), ior);
                    const Interface out = intoAir(inside, seen.normal(), ior);
                    StillSample sample;
                    sample.pixel = pixel;
                    sample.cover = static_cast<std::uint8_t>(seen.cover());
                    sample.light = level8(1.0F - out.reflected);
                    if (out.reflected < 1.0F) {
                        if (seen.size() != size) {
                            size = seen.size();
                            level = scene_.levelFor(2.0F * quarter * static_cast<float>(size) / tile.pixel);
                        }
                        const Vec3f outside = fromFrame(tile.frame, out.transmitted);
                        sample.outside = scene_.backdrop.pixelAt(scene_.backdrop.placeOf(outside, level));
                    }
                    samples.push_back(sample);
                }
            }
        }
    }
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "support/masks.h"
#include "torture/corpus.h"

namespace droplet::torture {

/// Named mask that is drawn on demand.
struct Drawing {
    std::string name;
    std::function<Mask()> draw;
};

inline Corpus corpusOf(const std::string& name, std::vector<Drawing> drawings)
{
    const std::size_t count = drawings.size();
    return {name, count, [drawings = std::move(drawings)](std::size_t index) {
                return greymapItem(drawings[index].name + ".pgm", drawings[index].draw());
            }};
}

/// Mask of levels, clipped to [0, 1].
inline Mask levelMask(int width, int height, const std::function<double(int x, int y)>& level)
{
    Mask mask;
    mask.width = width;
    mask.height = height;
    mask.coverage.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            mask.coverage.push_back(
                static_cast<std::uint16_t>(std::lround(65535.0 * std::clamp(level(x, y), 0.0, 1.0))));
        }
    }
    return mask;
}

/// Coarsely anti-aliased mask, by 4 × 4 samples, as fast renderers do.
inline Mask coarseMask(int width, int height, const testing::Inside& inside)
{
    constexpr int kSamples = 4;
    return levelMask(width, height, [&](int x, int y) {
        int count = 0;
        for (int row = 0; row < kSamples; ++row) {
            for (int column = 0; column < kSamples; ++column) {
                count += inside({x + (column + 0.5) / kSamples, y + (row + 0.5) / kSamples}) ? 1 : 0;
            }
        }
        return static_cast<double>(count) / (kSamples * kSamples);
    });
}

/// Two drawings of a shape, hard and anti-aliased.
inline void addShape(std::vector<Drawing>& drawings, const std::string& name, int width, int height,
                     const testing::Inside& inside)
{
    drawings.push_back({name + "_hard", [=] { return testing::hardMask(width, height, inside); }});
    drawings.push_back({name + "_soft", [=] { return coarseMask(width, height, inside); }});
}

}  // namespace droplet::torture

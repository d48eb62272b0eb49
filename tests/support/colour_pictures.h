// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "droplet/colours/colour_regions.h"
#include "droplet/vector.h"

namespace droplet::testing {

using Colour = std::array<int, 3>;

inline constexpr Colour kWhite{255, 255, 255};
inline constexpr Colour kRed{227, 6, 19};
inline constexpr Colour kGold{255, 204, 0};
inline constexpr Colour kBlue{0, 98, 184};

/// Binary pixmap (PPM) of a drawing, anti-aliased by 8 × 8 samples per pixel.
/// @param colour  at a place [px], y down
inline std::string pixmap(int width, int height, const std::function<Colour(Vec2 at)>& colour, int samples = 8)
{
    std::string bytes = "P6\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            std::array<double, 3> sum{};
            for (int s = 0; s < samples * samples; ++s) {
                const Colour here = colour({x + (s % samples + 0.5) / samples, y + (s / samples + 0.5) / samples});
                for (std::size_t c = 0; c < 3; ++c) {
                    sum[c] += here[c];
                }
            }
            for (const double level : sum) {
                bytes.push_back(static_cast<char>(std::lround(level / (samples * samples))));
            }
        }
    }
    return bytes;
}

/// Disc of three sectors on white, in the middle of a square picture.
inline std::string pie(int size, double radius)
{
    return pixmap(size, size, [&](Vec2 at) {
        const Vec2 from{at.x - 0.5 * size, at.y - 0.5 * size};
        if (length(from) > radius) {
            return kWhite;
        }
        constexpr std::array<Colour, 3> kColours{kRed, kGold, kBlue};
        const double turn = std::atan2(from.y, from.x) / (2.0 * std::numbers::pi) + 0.53;
        return kColours[static_cast<std::size_t>(3.0 * turn) % 3];
    });
}

/// Picture of labels with hard edges.
inline ColourRegions labelled(int width, int height, std::vector<std::uint8_t> labels, std::size_t colours)
{
    ColourRegions regions;
    regions.width = width;
    regions.height = height;
    regions.label = std::move(labels);
    regions.is_blend.assign(regions.label.size(), 0);
    regions.colour.assign(regions.label.size(), {0, 0, 0});
    for (std::size_t k = 0; k < colours; ++k) {
        const auto level = static_cast<std::uint8_t>(k * 255 / colours);
        regions.palette.push_back({{level, static_cast<std::uint8_t>(255 - level), 128}, 1});
    }
    return regions;
}

}  // namespace droplet::testing

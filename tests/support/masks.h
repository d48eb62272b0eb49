// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "droplet/mask/mask.h"
#include "droplet/vector.h"

namespace droplet::testing {

/// Function that says whether a point of the image is liquid [px], y down, origin at the image's corner.
using Inside = std::function<bool(Vec2)>;

/// Mask with hard edges: a pixel is liquid if its centre is.
inline Mask hardMask(int width, int height, const Inside& inside)
{
    Mask mask;
    mask.width = width;
    mask.height = height;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            mask.coverage.push_back(inside({x + 0.5, y + 0.5}) ? 65535 : 0);
        }
    }
    return mask;
}

/// Anti-aliased mask: in pixels on an edge, coverage is counted on a grid of samples and rounded to 8 bits, as
/// renderers do.
inline Mask smoothMask(int width, int height, const Inside& inside)
{
    constexpr int kSamples = 32;
    Mask mask;
    mask.width = width;
    mask.height = height;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            int coarse = 0;
            for (int k = 0; k < 25; ++k) {
                coarse += inside({x + (k % 5) / 4.0, y + (k / 5) / 4.0}) ? 1 : 0;
            }
            double cover = coarse == 25 ? 1.0 : 0.0;
            if (coarse != 0 && coarse != 25) {
                int count = 0;
                for (int k = 0; k < kSamples * kSamples; ++k) {
                    count += inside({x + (k % kSamples + 0.5) / kSamples, y + (k / kSamples + 0.5) / kSamples}) ? 1 : 0;
                }
                cover = static_cast<double>(count) / (kSamples * kSamples);
            }
            mask.coverage.push_back(static_cast<std::uint16_t>(257 * std::lround(255.0 * cover)));
        }
    }
    return mask;
}

inline Inside disc(Vec2 centre, double radius)
{
    return [=](Vec2 p) { return length(p - centre) < radius; };
}

/// Rectangle with given half sides, turned counter-clockwise as seen with y down.
inline Inside rectangle(Vec2 centre, Vec2 half, double angle)
{
    return [=](Vec2 p) {
        const Vec2 d = p - centre;
        const double x = std::cos(angle) * d.x + std::sin(angle) * d.y;
        const double y = -std::sin(angle) * d.x + std::cos(angle) * d.y;
        return std::abs(x) < half.x && std::abs(y) < half.y;
    };
}

/// Mask drawn with characters: `#` is liquid; rows separated by line breaks.
inline Mask drawnMask(std::string_view rows)
{
    Mask mask;
    int column = 0;
    for (const char c : rows) {
        if (c == '\n') {
            mask.width = column;
            column = 0;
            ++mask.height;
        } else {
            mask.coverage.push_back(c == '#' ? 65535 : 0);
            ++column;
        }
    }
    if (column > 0) {
        mask.width = column;
        ++mask.height;
    }
    return mask;
}

}  // namespace droplet::testing

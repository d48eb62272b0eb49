// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/render/stand_look.h"

#include <cmath>
#include <cstddef>

namespace droplet {
namespace {

/// Pixel at a coordinate of a texture that repeats.
int pixelAt(double coordinate, int count)
{
    return std::min(static_cast<int>((coordinate - std::floor(coordinate)) * count), count - 1);
}

}  // namespace

bool StandLook::isThere(int x, int y) const
{
    if (!coverage) {
        return true;
    }
    const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(coverage->width);
    const std::uint8_t red = coverage->rgb[3 * (row + static_cast<std::size_t>(x))];
    return cutoff ? red / 255.0 >= *cutoff : red > 0;
}

bool StandLook::isThere(Vec2 uv) const
{
    if (!coverage) {
        return true;
    }
    const Vec2 at = place.at(uv);
    return isThere(pixelAt(at.x, coverage->width), pixelAt(at.y, coverage->height));
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "droplet/shape/capillary_surface.h"
#include "droplet/vector.h"

namespace droplet {

/// Ground as the triangles of a droplet's base have it. Finds the triangle at a place by a grid of squares.
class FacetedGround {
public:
    /// @param base  triangles that do not overlap, seen from above; at least one
    explicit FacetedGround(const CapillarySurface& base);

    /// Height at a place [m]; none beside the triangles.
    [[nodiscard]] std::optional<double> heightAt(Vec2 place) const;

private:
    /// Column or row of a coordinate, if it is inside of the grid.
    [[nodiscard]] std::size_t cellOf(double from_low, std::size_t count) const;

    std::vector<Vec3> vertices_;
    std::vector<Triangle> triangles_;
    Vec2 low_;           ///< corner of the grid
    double cell_ = 0.0;  ///< side of its squares [m]
    std::size_t columns_ = 0;
    std::size_t rows_ = 0;
    std::vector<std::size_t> starts_;   ///< of every square's triangles in `found_`, and their end
    std::vector<std::uint32_t> found_;  ///< triangles whose boxes meet a square
};

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "droplet/io/compression.h"
#include "droplet/vector.h"

namespace droplet {

/// Numbers of the integers of a quantized vertex: x, y, z, and 0, since vertices must be aligned to four bytes.
inline constexpr std::size_t kLanes = 4;

/// Cube that quantized positions fill, by integers from 0 to 65535.
struct QuantizationCube {
    Vec3 low;
    double side = 1.0;  ///< > 0

    [[nodiscard]] std::array<std::uint16_t, kLanes> quantized(Vec3 position) const;
    /// Place that a reader finds.
    [[nodiscard]] Vec3 place(const std::array<std::uint16_t, kLanes>& quantized) const;
};

/// Smallest cube around positions.
QuantizationCube cubeAround(std::span<const Vec3> positions);

/// Normals as a compression stores them.
struct QuantizedNormals {
    std::vector<std::int16_t> stored;  ///< kLanes per normal; with Meshopt, filtered
    std::vector<std::int16_t> read;    ///< kLanes per normal, as a reader finds them: 32767 is 1
};

/// @param normals  unit vectors
QuantizedNormals quantizeNormals(std::span<const Vec3> normals, Compression compression);

}  // namespace droplet

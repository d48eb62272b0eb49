// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "droplet/scene/compression.h"
#include "droplet/vector.h"

namespace droplet {

/// Integers of a quantized vector: x, y, z, and 0, since vertices must be aligned to four bytes.
using QuantizedPosition = std::array<std::uint16_t, 4>;
using QuantizedVector = std::array<std::int16_t, 4>;

/// Cube that quantized vertices fill, by integers from 0 to 65535.
struct QuantizationCube {
    Vec3 low;
    double side = 1.0;  ///< > 0

    [[nodiscard]] QuantizedPosition quantized(Vec3 position) const;
    /// Change of a position; no longer than the side in any direction.
    [[nodiscard]] QuantizedVector quantizedChange(Vec3 change) const;
    /// Place that a reader finds.
    [[nodiscard]] Vec3 place(const QuantizedPosition& quantized) const;
    /// Change that a reader finds.
    [[nodiscard]] Vec3 change(const QuantizedVector& quantized) const;
};

/// Smallest cube around vertices whose side is not exceeded by any change of a coordinate.
/// @param longest  largest change of a coordinate [m]
QuantizationCube cubeAround(std::span<const Vec3> vertices, double longest);

/// Vector whose coordinates are from −1 to 1; 32767 is 1.
QuantizedVector quantized(Vec3 vector);

/// Normals as a compression stores them.
struct QuantizedNormals {
    std::vector<QuantizedVector> stored;  ///< with Meshopt, filtered
    std::vector<QuantizedVector> read;    ///< as a reader finds them: 32767 is 1
};

/// @param normals  unit vectors
QuantizedNormals quantizeNormals(std::span<const Vec3> normals, Compression compression);

}  // namespace droplet

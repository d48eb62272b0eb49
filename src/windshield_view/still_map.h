// SPDX-License-Identifier: GPL-3.0-or-later
// Map of all still droplets (thesis, section 3.2.2).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "droplet/vector.h"
#include "render/optics.h"
#include "windshield/still_droplets.h"

namespace droplet {

/// Point of the map. Where droplets overlap it shows the thicker one, in any order: texels are compared as numbers,
/// thickness first.
class Texel {
public:
    static constexpr double kThickest = 2e-3;  ///< upper limit of the thickness [m]

    Texel() = default;
    /// @param cover   share of the texel that the droplet covers, in (0, 1]
    /// @param radius  radius of the droplet, seen from above [texels]
    Texel(double thickness, Vec3f normal, float cover, float radius);

    [[nodiscard]] bool empty() const { return bits_ == 0; }
    /// Covered share, 0 … 255.
    [[nodiscard]] std::uint32_t cover() const { return static_cast<std::uint32_t>((bits_ >> 8) & 0xFFU); }
    [[nodiscard]] double thickness() const { return kThickest * static_cast<double>(bits_ >> 48) / 65535.0; }
    /// Radius of the droplet, seen from above, in quarters of texels.
    [[nodiscard]] std::uint8_t size() const { return static_cast<std::uint8_t>(bits_ & 0xFFU); }
    /// Unit normal out of the water.
    [[nodiscard]] Vec3f normal() const;

    friend constexpr bool operator==(const Texel&, const Texel&) = default;
    friend constexpr bool operator<(const Texel& a, const Texel& b) { return a.bits_ < b.bits_; }

private:
    /// From the highest bit: 16 bits of thickness, 16 each of the normal's x and y, 8 of cover, 8 of radius.
    std::uint64_t bits_ = 0;
};

/// Window of the glass, with the size of its texels.
struct MapWindow {
    Vec2 low;            ///< lower left corner [m]
    Vec2 high;           ///< upper right corner [m]
    double texel = 0.0;  ///< [m]
};

/// Map of still droplets; an update draws only cells that changed.
class StillMap {
public:
    /// @param contact_angle  contact angle of the droplets [rad]
    StillMap(const MapWindow& window, double contact_angle);

    /// Updates the map.
    /// @return cells in which a texel changed, in order
    std::vector<std::size_t> update(const StillCells& still);

    [[nodiscard]] std::size_t cellsDrawn() const { return drawn_; }
    [[nodiscard]] float perMetre() const { return per_metre_; }  ///< texels per metre
    [[nodiscard]] int columns() const { return columns_; }
    [[nodiscard]] int rows() const { return rows_; }
    [[nodiscard]] const std::vector<Texel>& texels() const { return texels_; }
    /// Texel at a place on the glass [m]; empty beyond the window.
    [[nodiscard]] Texel at(float x, float y) const
    {
        const float across = (x - low_x_) * per_metre_;
        const float up = (y - low_y_) * per_metre_;
        if (!(across >= 0.0F && up >= 0.0F && across < static_cast<float>(columns_) &&
              up < static_cast<float>(rows_))) {
            return {};
        }
        const int column = static_cast<int>(across);
        const int row = static_cast<int>(up);
        return texels_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                       static_cast<std::size_t>(column)];
    }

private:
    /// Box of texels.
    struct Box {
        int left = 0;
        int right = 0;  ///< after the last column
        int low = 0;
        int high = 0;  ///< after the last row
    };

    [[nodiscard]] Box boxOf(const StillCells& still, std::size_t cell) const;
    bool draw(const StillCells& still, std::size_t cell);
    /// One bit for each of the eight neighbours of a cell that its droplets reach, row by row.
    [[nodiscard]] std::uint8_t reachOf(const StillCells& still, std::size_t cell) const;

    double texel_;
    std::int64_t first_column_;  ///< first column of the window, counted from the glass's corner
    std::int64_t first_row_;
    int columns_ = 0;
    int rows_ = 0;
    float low_x_ = 0.0F;
    float low_y_ = 0.0F;
    float per_metre_ = 0.0F;
    double sine_;
    double cosine_;
    double unit_radius_;  ///< contact radius of a cap of 1 m³ [m]
    std::vector<Texel> texels_;
    std::vector<std::uint32_t> revisions_;
    std::vector<std::uint8_t> reaches_;
    std::size_t drawn_ = 0;
};

}  // namespace droplet

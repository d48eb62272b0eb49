// SPDX-License-Identifier: GPL-3.0-or-later
// The one map of all still droplets (thesis, section 3.2.2), kept up with them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "droplet/vector.h"
#include "picture/optics.h"
#include "windshield/still_droplets.h"

namespace droplet {

/// A point of the map. Of droplets that overlap the thicker one is there, whatever their order: texels are compared as
/// numbers, the thickness first.
class Texel {
public:
    static constexpr double kThickest = 2e-3;  ///< [m]; what is thicker is so thick

    Texel() = default;
    /// @param cover  share of the texel that the droplet takes, over 0 up to 1
    /// @param radius of what is seen of it [texels]
    Texel(double thickness, Vec3f normal, float cover, float radius);

    [[nodiscard]] bool empty() const { return bits_ == 0; }
    /// 0 … 255
    [[nodiscard]] std::uint32_t cover() const { return static_cast<std::uint32_t>((bits_ >> 8) & 0xFFU); }
    [[nodiscard]] double thickness() const { return kThickest * static_cast<double>(bits_ >> 48) / 65535.0; }
    /// Radius of what is seen of the droplet, in quarters of texels.
    [[nodiscard]] std::uint8_t size() const { return static_cast<std::uint8_t>(bits_ & 0xFFU); }
    /// Unit, out of the water.
    [[nodiscard]] Vec3f normal() const;

    friend constexpr bool operator==(const Texel&, const Texel&) = default;
    friend constexpr bool operator<(const Texel& a, const Texel& b) { return a.bits_ < b.bits_; }

private:
    /// From the top: 16 bits of thickness, 16 each of the normal's x and y, 8 of cover, 8 of radius.
    std::uint64_t bits_ = 0;
};

/// A window of the glass in texels.
struct MapWindow {
    Vec2 low;            ///< corner [m]
    Vec2 high;           ///< [m]
    double texel = 0.0;  ///< [m]
};

class StillMap {
public:
    /// @param contact_angle  of the droplets [rad]
    StillMap(const MapWindow& window, double contact_angle);

    /// Brings the map to the state of the droplets.
    /// @return the cells within which something changed, in order
    std::vector<std::size_t> follow(const StillCells& still);

    [[nodiscard]] std::size_t cellsDrawn() const { return drawn_; }
    [[nodiscard]] float perMetre() const { return per_metre_; }  ///< texels
    [[nodiscard]] int columns() const { return columns_; }
    [[nodiscard]] int rows() const { return rows_; }
    [[nodiscard]] const std::vector<Texel>& texels() const { return texels_; }
    /// The texel at a place on the glass [m], bare beyond the window.
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
    struct Box {
        int left = 0;
        int right = 0;  ///< beyond the last
        int low = 0;
        int high = 0;  ///< beyond the last
    };

    [[nodiscard]] Box boxOf(const StillCells& still, std::size_t cell) const;
    bool draw(const StillCells& still, std::size_t cell);
    /// Into which of the eight cells around it a cell's droplets reach, a bit each, row by row.
    [[nodiscard]] std::uint8_t reachOf(const StillCells& still, std::size_t cell) const;

    double texel_;
    std::int64_t first_column_;  ///< of the window, counted from the glass's corner
    std::int64_t first_row_;
    int columns_ = 0;
    int rows_ = 0;
    float low_x_ = 0.0F;
    float low_y_ = 0.0F;
    float per_metre_ = 0.0F;
    double sine_;
    double cosine_;
    double unit_radius_;  ///< of contact, of a cap of 1 m³ [m]
    std::vector<Texel> texels_;
    std::vector<std::uint32_t> revisions_;
    std::vector<std::uint8_t> reaches_;
    std::size_t drawn_ = 0;
};

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "droplet/windshield/wipers.h"
#include "view/sight.h"

namespace droplet {

/// Water on the glass that a ray meets.
struct WaterMet {
    float cover = 0.0F;    ///< share of the pixel
    Vec2f slope;           ///< of its surface along the glass's x and y
    bool is_bead = false;  ///< thick, like a droplet
};

/// What is seen of a wiper at one moment.
struct WiperMet {
    float cover = 0.0F;  ///< share of the pixel that is blade or arm
    float shine = 0.0F;  ///< light of it, over that of the cabin
    WaterMet pushed;     ///< water ahead of the blade, before the glass is wiped
};

/// Wipers as the driver sees them: blades and arms, the water that they push, the film that they leave, which breaks up
/// into streaks and is gone within a second, and the wedge of water that lies for a while where a blade has turned, but
/// where another blade passes. All of this is water that has been wiped: the balance knows no other.
///
/// Shapes and sizes are chosen by eye, after blades and arms of cars.
class WiperView {
public:
    /// @param sight  must outlive this
    explicit WiperView(const Sight& sight) : sight_(sight) {}

    /// What is seen from now on.
    void follow(double time);

    /// Whether anything of the wipers may be seen in a tile; rough.
    [[nodiscard]] bool reach(std::size_t tile) const { return !tiles_.empty() && tiles_[tile] != 0; }
    /// At how many moments blades are looked at while the shutter is open.
    [[nodiscard]] int moments() const { return moments_; }

    /// Water that stays where it is: film, and wedges.
    /// @param pixel  size of a pixel's image on the glass [m]
    [[nodiscard]] WaterMet left(Vec2f place, float pixel) const;
    /// @param moment  0 … moments() − 1
    [[nodiscard]] WiperMet at(Vec2f place, float pixel, int moment) const;

private:
    /// A blade at a moment.
    struct Blade {
        Vec2f along;           ///< unit, from the pivot
        float forward = 0.0F;  ///< 1 where its angle grows, −1 where it shrinks, 0 at rest
        float pushed = 0.0F;   ///< how much of its stroke lies behind it, 0 … 1
    };
    struct Wiping {
        Wiper wiper;
        double since = 0.0;  ///< of its period [s]
        std::uint32_t stroke = 0;
        std::vector<Blade> blades;  ///< of each moment
    };

    [[nodiscard]] static Blade bladeAt(const Wiper& wiper, double time);
    [[nodiscard]] WaterMet film(const Wiping& one, Vec2f from, float pixel) const;
    [[nodiscard]] WaterMet wedge(const Wiping& one, Vec2f from, float pixel) const;
    /// Whether a place is in another wiper's field.
    [[nodiscard]] bool isOthers(const Wiping& own, Vec2f place) const;

    const Sight& sight_;
    std::vector<Wiping> wipings_;
    std::vector<std::uint8_t> tiles_;
    int moments_ = 1;
};

}  // namespace droplet

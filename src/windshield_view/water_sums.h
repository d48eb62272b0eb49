// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "droplet/body/running_shape.h"
#include "droplet/windshield/windshield.h"
#include "windshield/still_droplets.h"
#include "windshield_view/body_relief.h"
#include "windshield_view/water_raster.h"

namespace droplet {

/// Water of a state in every pixel of a raster. It follows a simulation: what has not changed is not drawn again, and
/// as sums are whole numbers, they are those of the state alone.
class WaterSums {
public:
    /// Relief of a running droplet; empty: it is a capsule.
    using ReliefOf = std::function<std::optional<BodyRelief>(const RunningDroplet& droplet)>;

    /// Sums of a dry glass.
    /// @param shape  of droplets at rest, and of capsules
    /// @param relief_of  thread-safe; none: all are capsules
    WaterSums(const WaterRaster& raster, const ShapeOptions& shape, ReliefOf relief_of = {});

    /// Brings the sums up to a state of the same simulation.
    void update(const WindshieldState& state);
    /// Brings the film that runs off up to a state, too.
    void updateFilm(const Runoff& film);

    [[nodiscard]] const WaterRaster& raster() const { return raster_; }
    /// Water of every pixel, row by row from the upper left.
    [[nodiscard]] const std::vector<WaterPixel>& water() const { return water_; }
    [[nodiscard]] const std::vector<WaterMotion>& motion() const { return motion_; }
    /// Calls work(pixel) for every pixel of a row that changed since the last call for this row, from the left.
    /// @return  whether there is any
    template <typename Work>
    bool takeChanged(std::size_t row, const Work& work)
    {
        const auto columns = static_cast<std::size_t>(raster_.width());
        std::uint8_t* const begin = is_changed_.data() + row * columns;
        std::uint8_t* const end = begin + columns;
        bool is_any = false;
        for (std::uint8_t* one = begin; one != end; ++one) {
            if (*one == 0) {  // most pixels have not changed, unless a film runs over them
                one = static_cast<std::uint8_t*>(std::memchr(one, 1, static_cast<std::size_t>(end - one)));
                if (one == nullptr) {
                    break;
                }
            }
            *one = 0;
            is_any = true;
            work(static_cast<std::size_t>(one - is_changed_.data()));
        }
        return is_any;
    }

private:
    /// Running droplet as it is drawn.
    struct Drawn {
        RunningDroplet droplet;
        std::vector<WaterStamp> water;
        std::vector<WaterStamp> before = {};  ///< its water in the sums, if that is to be replaced
    };

    void update(const StillCells& now);
    void update(const std::vector<RunningDroplet>& now);
    void update(const std::vector<Splash>& splashes, double time);
    void add(std::span<const WaterStamp> stamps, int sign);
    void draw(const std::vector<StillDroplet>& droplets, int sign);
    void draw(Drawn& one) const;

    WaterRaster raster_;
    ShapeOptions shape_;
    ReliefOf relief_of_;
    std::vector<WaterPixel> water_;
    std::vector<WaterMotion> motion_;
    StillCells still_;  ///< as drawn
    std::vector<Drawn> running_;
    std::vector<WaterStamp> rims_;          ///< of splashes
    std::vector<WaterPixel> film_;          ///< in the sums, of every pixel; empty: there is none
    std::vector<std::uint8_t> is_changed_;  ///< for every pixel
};

}  // namespace droplet

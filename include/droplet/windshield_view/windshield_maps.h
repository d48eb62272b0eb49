// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "droplet/body/running_shape.h"
#include "droplet/windshield/glass.h"
#include "droplet/windshield/windshield.h"

namespace droplet {

/// Options of WindshieldMaps.
struct WindshieldMapOptions {
    int width = 1024;         ///< [px], 16 … 8192; the height follows from the glass, with nearly square pixels
    ShapeOptions shape = {};  ///< shape of droplets; running ones are capsules

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// Part of a map.
struct MapTile {
    int x = 0;       ///< of its left edge [px]
    int y = 0;       ///< of its upper edge [px]
    int width = 0;   ///< [px]
    int height = 0;  ///< [px]

    friend bool operator==(const MapTile&, const MapTile&) = default;  ///< Compares all members.
};

/// Water on the unrolled glass as a texture for a renderer that runs along: each frame, only what has changed since the
/// last one is drawn. As GlassMaps it has the left edge left and the upper edge up, as the driver sees the glass from
/// inside.
///
/// A pixel has four half floats (IEEE 754 binary16, GL_RGBA16F): x and y of the water's outward unit normal, to the
/// driver's right and up the glass, both times the wetness; the mean thickness of the water [mm]; and the wetness, the
/// share that water covers, which exceeds 1 where droplets overlap. Rings of splashes have no thickness; the film that
/// runs off (WindshieldState::film) is a texture of its own. Bare glass is 0. All four are means over the pixel, so
/// that they may be interpolated; over the wetness the first two are the normal of the water alone.
class WindshieldMaps {
public:
    /// Side of a tile [px].
    static constexpr int kTile = 32;

    /// Maps of a dry glass.
    /// @param glass    glass of the simulation
    /// @param options  width and shapes
    /// @throws Error   InvalidArgument if an option is out of its range, or the map higher than 8192 px
    explicit WindshieldMaps(const Glass& glass, const WindshieldMapOptions& options = {});
    ~WindshieldMaps();
    WindshieldMaps(WindshieldMaps&& other) noexcept;             ///< Moves the data.
    WindshieldMaps& operator=(WindshieldMaps&& other) noexcept;  ///< Moves the data.

    [[nodiscard]] int width() const;   ///< Width of the map [px].
    [[nodiscard]] int height() const;  ///< Height of the map [px].

    /// Brings a map up to a state.
    ///
    /// Guarantees: the pixels are those of a new WindshieldMaps that is brought up to the same state, to the last bit.
    /// @param state   of one simulation, each not before the last; for another simulation make new maps
    /// @param pixels  width · height · 4 numbers, row by row from the upper left, as the last call left them; before
    /// the
    ///                first call all are 0
    /// @return        tiles with pixels that were written, row by row; valid until the next call
    /// @throws Error  InvalidArgument if `pixels` has another size
    const std::vector<MapTile>& update(const WindshieldState& state, std::span<std::uint16_t> pixels);

private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace droplet

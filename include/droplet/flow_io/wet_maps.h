// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "droplet/drawing/picture.h"
#include "droplet/flow/flow.h"
#include "droplet/flow/flow_terrain.h"
#include "droplet/flow_io/flow_object.h"
#include "droplet/flow_io/trail_film.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// Options of WetMapper.
struct WetMapOptions {
    int width = 1024;              ///< [px], 16 … 8192
    int height = 1024;             ///< [px], 16 … 8192
    TrailFilm film = {};           ///< behind the droplets
    double full_thickness = 5e-3;  ///< thickness of the highest level [m], > 0; more is clipped
    double full_age = 10.0;        ///< age of the highest level [s], > 0; more is clipped

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// Water on an object as textures, by its uv, 16 bits per channel, without a colour space. A few texels beyond the
/// edges of the uv's islands repeat the islands, so that filters do not bleed.
struct WetMaps {
    /// Outward unit normal of the water in the object's tangent frame: red x, to larger u; green y, up in the texture;
    /// blue z, out of the object; each (n + 1)/2 of 65535. Where it is dry, (32768, 32768, 65535). +Y up, as in
    /// OpenGL.
    DeepPicture normal;
    /// Grey: thickness of the water of droplets and streaks over full_thickness; 0: dry. Droplets have their volume at
    /// any resolution, except for clipped water.
    DeepPicture thickness;
    /// Grey: time since a droplet passed the place, over full_age; 0: one is there; 65535: longer ago, or never.
    DeepPicture age;
    /// Grey: 65535 under droplets and where the film behind them is at least as thick as spread over their width; less
    /// where it is thinner; 0: dry.
    DeepPicture wet;
};

/// The maps of WetMaps in floating point.
struct WetFloatMaps {
    FloatPicture normal;     ///< from −1 to 1; (0, 0, 1) where it is dry
    FloatPicture thickness;  ///< [m]; not clipped
    FloatPicture age;        ///< [s], at most full_age, also where no droplet passed
    FloatPicture wet;        ///< from 0, dry, to 1
};

/// Makes maps of the water on an object, frame by frame. For every frame: advanceFlow(), add(), then maps() or
/// floatMaps().
///
/// Guarantees: the same arguments give the same bytes with any number of threads. Where triangles share texels, these
/// have the water of all.
class WetMapper {
public:
    /// Prepares the texels of a dry object.
    /// @param object   with uvs; outside the unit square they repeat
    /// @param terrain  of this object's triangles; must outlive the maps
    /// @param options  size and scales
    /// @throws Error   InvalidArgument if the object has no uvs or an option is out of its range; InvalidInput if its
    /// uvs
    ///                have no area
    WetMapper(const FlowObject& object, const FlowTerrain& terrain, const WetMapOptions& options = {});
    ~WetMapper();
    WetMapper(WetMapper&&) noexcept;             ///< Moves the maps.
    WetMapper& operator=(WetMapper&&) noexcept;  ///< Moves the maps.

    /// Leaves films on the paths of one advanceFlow().
    /// @param tracks  FlowState::tracks
    void add(std::span<const FlowTrack> tracks);

    /// Maps another shape of the object from now on. What is wet stays so; tracks are still those on the first shape.
    /// @param object   as inShape() makes it
    /// @param terrain  of this shape; must outlive the maps of it
    void reshape(const FlowObject& object, const FlowTerrain& terrain);

    /// Draws maps.
    /// @param time      [s]; not before the last track
    /// @param samples   droplets at that time
    /// @param droplets  dropletSurfaces() of these samples
    WetMaps maps(double time, std::span<const FlowSample> samples, const Surface& droplets);

    /// The same in floating point; full_thickness has no effect.
    WetFloatMaps floatMaps(double time, std::span<const FlowSample> samples, const Surface& droplets);

    /// Exact bytes of what is wet.
    [[nodiscard]] std::string bytes() const;

    /// Wets what was wet, so that the next maps equal those of the mapper that was saved.
    /// @param bytes  of bytes(), by a mapper of the same object and options
    /// @param name   of the source, for messages
    /// @throws Error InvalidInput if the bytes are damaged, or of another object or other options
    void restore(std::string_view bytes, const std::string& name);

private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace droplet

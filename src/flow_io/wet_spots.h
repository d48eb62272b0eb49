// SPDX-License-Identifier: GPL-3.0-or-later
// Sample places on a surface, and which of them water wets.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/flow/flow.h"
#include "droplet/flow/flow_surface.h"
#include "droplet/flow_io/trail_film.h"
#include "droplet/surface/surface.h"
#include "droplet/vector.h"
#include "flow_io/trail_section.h"

namespace droplet {

/// Places on the faces of a surface.
struct WetSpots {
    std::vector<std::uint32_t> first;          ///< number of every face's first place; one more at the end
    std::vector<std::array<float, 3>> places;  ///< relative to `middle` [m]
    Vec3 middle;                               ///< [m]
    double spacing = 0.0;                      ///< typical distance of places [m]

    [[nodiscard]] Vec3 place(std::size_t spot) const
    {
        const auto& [x, y, z] = places[spot];
        return middle + Vec3{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
    }
    void add(Vec3 place)
    {
        const Vec3 p = place - middle;
        places.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    }
};

/// Part of the surface around a segment.
struct Around {
    std::uint32_t face = 0;  ///< that the segment is on
    Vec3 from;               ///< [m]
    Vec3 to;                 ///< [m]
    double reach = 0.0;      ///< [m]
};

/// Finds the faces that are joined to a face over edges within reach of a segment, and do not face the other way, so
/// that the back of a thin sheet stays dry.
class FacesAround {
public:
    explicit FacesAround(const FlowSurface& surface) : surface_(surface) {}

    /// @return  valid until the next call; the first is `around.face`
    const std::vector<std::uint32_t>& find(const Around& around);

private:
    const FlowSurface& surface_;
    std::vector<std::uint32_t> found_;
    std::vector<std::uint32_t> seen_;  ///< number of the search that found the face last
    std::uint32_t search_ = 0;
};

/// Film behind droplets at places.
class WetPlaces {
public:
    WetPlaces(std::size_t count, const TrailFilm& film) : places_(count), film_(film) {}

    /// A droplet passes a place.
    /// @param id        of the droplet
    /// @param distance  of the place from the droplet's way [m]
    void pass(std::size_t spot, std::uint64_t id, const Passage& passage, double distance);
    /// Thickness of the film at a time [m].
    /// @param at  the place [m]
    [[nodiscard]] double thickness(std::size_t spot, Vec3 at, double time) const;
    /// Time since a droplet passed the place; infinity if none did [s].
    [[nodiscard]] double age(std::size_t spot, double time) const;

    /// Exact bytes of all places.
    [[nodiscard]] std::string bytes() const;
    /// Places from their bytes.
    /// @param name    of the source, for messages
    /// @throws Error  InvalidInput if the bytes are damaged, or of another number of places
    void restore(std::string_view bytes, const std::string& name);

private:
    struct Place {
        float time = -std::numeric_limits<float>::infinity();  // of the passage
        float width = 0.0F;                                    // 0: none
        float speed = 0.0F;
        float distance = 0.0F;
        std::uint32_t id = 0;  // the last bits
    };

    std::vector<Place> places_;
    TrailFilm film_;
};

/// Distance of a point from a segment [m].
double distanceFrom(Vec3 p, Vec3 from, Vec3 to);

/// Passes all places on the tracks.
void wetTracks(const WetSpots& spots, std::span<const FlowTrack> tracks, FacesAround& faces, WetPlaces& wet);

/// Water of a droplet over a place.
struct WaterAt {
    std::uint32_t face = 0;
    std::uint32_t spot = 0;
    double thickness = 0.0;  ///< [m]
    Vec3 normal;             ///< not unit; 0 if unknown
};

/// Water of every droplet over the places; none for droplets in the air. A droplet too small for any place gives its
/// water to the nearest.
/// @param area      of the surface that a place of a face stands for [m²]: the water of a droplet over all its places
///                  is the droplet's volume
/// @param droplets  dropletSurfaces() of the samples
std::vector<std::vector<WaterAt>> waterOf(const WetSpots& spots, const FlowSurface& surface,
                                          std::span<const double> area, std::span<const FlowSample> samples,
                                          const Surface& droplets);

}  // namespace droplet

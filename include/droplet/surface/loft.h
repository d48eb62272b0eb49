// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/base_surface.h"
#include "droplet/shape/capillary_surface.h"
#include "droplet/shape/refill.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// Change of height fields with the amount of liquid.
struct LoftRefill {
    FillRange range;              ///< allowed fills
    std::vector<FillGain> gains;  ///< change per fill, one per surface
};

/// Options of loft().
struct LoftOptions {
    bool open = false;        ///< leave out the base
    Vec2 extent;              ///< size of the image, centred at the origin, for texture coordinates [m]; both > 0
    BaseSurface ground = {};  ///< ground of the surfaces
    std::vector<PlanarMesh> bases = {};     ///< covers of every rim, if known already; may be empty
    std::optional<LoftRefill> refill = {};  ///< for a surface that can be filled and drained
    bool flatten = true;                    ///< spread sheets that lean out over their footprint in texture
                                            ///< coordinates; otherwise these are the place above or below
    bool even_base = false;                 ///< the base has the triangles of the footprint on flat ground, too
    bool keeps_dry = false;                 ///< cover ground that sheets left dry, so that their triangles stay

    /// Checks all options.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// Closes the surfaces of droplets with bases on the ground, and gives them normals and texture coordinates.
///
/// A base meets the liquid at the rim. On flat ground it has few triangles; on other ground, and with `even_base`, it
/// has those of the footprint, at the height of the ground. Neither covers ground that the liquid left dry, unless
/// `keeps_dry` says so.
///
/// Normals inside are area-weighted means. On the rim they come from the contact angle, so a cap's rim shades like the
/// cap. A base has the normals of the ground.
///
/// Texture coordinates are those of the place below in the picture. If a surface leans out, it is spread over its
/// footprint instead, so that every point of the picture occurs once: the rim stays in its place, and triangles keep
/// the shape that they have seen from above as far as possible (Garanzha et al. 2021). Surface::texture_map says which.
/// @param surfaces  one per droplet
/// @param options   open or closed, extent of the image, ground
/// @throws Error    InvalidArgument: options or surfaces; a base or gain does not fit its surface; all is dry; or there
///                  are gains, and anything is dry or no height field
Surface loft(const std::vector<CapillarySurface>& surfaces, const LoftOptions& options);

/// Adds a surface to another one. Parts keep their numbers of droplets; they are unknown if those of either surface
/// are.
void append(Surface& surface, const Surface& more);

}  // namespace droplet

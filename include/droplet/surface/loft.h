// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/base_surface.h"
#include "droplet/shape/refill.h"
#include "droplet/shape/sheet.h"
#include "droplet/shape/solve.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// Change of the heights with the amount of liquid.
struct LoftRefill {
    FillRange range;              ///< allowed fills
    std::vector<FillGain> gains;  ///< change per fill, one per mesh
};

/// Options of loft().
struct LoftOptions {
    bool open = false;        ///< leave out the base
    Vec2 extent;              ///< size of the image, centred at the origin, for texture coordinates [m]; both > 0
    BaseSurface ground = {};  ///< ground of the fields
    std::vector<PlanarMesh> bases = {};     ///< cover() of every mesh, if known already; may be empty
    std::optional<LoftRefill> refill = {};  ///< for a surface that can be filled and drained
    bool flatten = true;                    ///< spread sheets that lean out over their footprint in texture
                                            ///< coordinates; otherwise these are the place above or below
    bool keeps_dry = false;                 ///< cover ground that sheets left dry, so that their triangles stay

    /// Checks all options.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// Turns height fields into a surface in space: raises every mesh to its heights and closes it with a base.
///
/// The base meets the liquid at the rim. On flat ground it has few triangles; on other ground it has the triangles of
/// the liquid, at the height of the ground. Neither covers what the liquid left dry. Normals inside come from the
/// recovered gradient. On the rim they come from the slope that balances the rim's force (Carey's boundary flux) across
/// the rim, and from the ground along it, so a cap's rim shades like the cap. The base has the normals of the ground.
/// @param meshes   one per droplet
/// @param fields   one per mesh
/// @param options  open or closed, extent of the image, ground
/// @throws Error   InvalidArgument: counts differ; a field or gain does not fit its mesh or the ground; all is dry; or
///                 anything is dry and there are gains
Surface loft(const std::vector<PlanarMesh>& meshes, const std::vector<HeightField>& fields, const LoftOptions& options);

/// Closes a sheet that hangs over its rim with a base on the ground. Normals on the rim come from the contact angle.
///
/// Flat ground that the liquid left dry is left out, as with height fields. On other ground, and with keeps_dry, the
/// liquid lies on it without thickness.
///
/// Texture coordinates are those of the place below in the picture. If the sheet leans out, it is spread over its
/// footprint instead, so that every point of the picture occurs once: the rim stays in its place, and triangles keep
/// the shape that they have seen from above as far as possible (Garanzha et al. 2021). Surface::texture_map says which.
/// @param sheet    with its footprint
/// @param options  open or closed, extent of the image, the ground, a base if it is flat and known; no refill
/// @return         surface without a mean height; the volume of its part is 0. Empty if all is dry
/// @throws Error   InvalidArgument: options, or the rims differ
Surface loft(const ParametricSheet& sheet, const LoftOptions& options);

/// Adds a surface to another one. Parts keep their numbers of droplets; they are unknown if those of either surface
/// are.
void append(Surface& surface, const Surface& more);

}  // namespace droplet

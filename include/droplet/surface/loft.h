// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/base_surface.h"
#include "droplet/shape/refill.h"
#include "droplet/shape/solve.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// How the liquid's surface changes with its amount.
struct LoftRefill {
    FillRange range;
    std::vector<FillGain> gains;  ///< one per mesh
};

/// How height fields become a surface in space.
struct LoftOptions {
    bool open = false;  ///< leave out the base
    Vec2 extent;        ///< physical size of the image, centred at the origin, for texture coordinates [m]; both > 0
    BaseSurface ground = {};                ///< what the fields were solved on
    std::vector<PlanarMesh> bases = {};     ///< cover() of every mesh, where known already; empty: made
    std::optional<LoftRefill> refill = {};  ///< makes a surface that can be filled and drained

    /// @throws Error InvalidArgument
    void validate() const;
};

/// Raises every mesh to its height and closes it with a base that shares the rim's places: flat ground with few
/// triangles, any other with the liquid's own, at the ground's height. What the liquid left dry is in neither.
///
/// Normals are those of the recovered gradient inside, and on the rim of the slope that balances the rim's force
/// (Carey's boundary flux) across it and of the ground along it, so that a cap's rim shades like the cap. The base has
/// the ground's normals: the rim is crisp.
/// @param meshes   one per droplet
/// @param fields   one per mesh
/// @param options  open or closed, extent of the image, ground
/// @throws Error   InvalidArgument if counts differ, a field or gain is not of its mesh or of this ground, all is dry,
///                 or something is and there are gains
Surface loft(const std::vector<PlanarMesh>& meshes, const std::vector<HeightField>& fields, const LoftOptions& options);

}  // namespace droplet

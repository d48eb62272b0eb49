// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/solve.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// How height fields become a surface in space.
struct LoftOptions {
    bool open = false;  ///< leave out the base
    Vec2 extent;        ///< physical size of the image, centred at the origin, for texture coordinates [m]; both > 0

    /// @throws Error InvalidArgument
    void validate() const;
};

/// Raises every mesh to its height and closes it with a flat base of few triangles, which share the rim's places.
///
/// Normals are those of the recovered gradient inside, and on the rim of the slope that balances the rim's force
/// (Carey's boundary flux), so that a cap's rim shades like the cap. The base has its own normal: the rim is crisp.
/// @param meshes   one per droplet
/// @param fields   one per mesh
/// @param options  open or closed, extent of the image
/// @throws Error   InvalidArgument if counts differ
Surface loft(const std::vector<PlanarMesh>& meshes, const std::vector<HeightField>& fields, const LoftOptions& options);

}  // namespace droplet

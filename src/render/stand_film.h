// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/render/stand_water.h"
#include "droplet/surface/textured_mesh.h"
#include "render/optics.h"
#include "render/ray_tracer.h"

namespace droplet {

/// The film of water on a stand.
class StandFilm {
public:
    /// Film at a place.
    struct Here {
        float thickness = 0.0F;  ///< [m]
        Vec3f normal;            ///< of the water's surface, unit
    };

    /// @param water  must outlive the film, as must the stand
    StandFilm(const StandWater& water, const TexturedMesh& stand) : water_(water), stand_(stand) {}

    /// @param meeting  on the stand
    [[nodiscard]] Here at(const Meeting& meeting) const;

private:
    const StandWater& water_;
    const TexturedMesh& stand_;
};

}  // namespace droplet

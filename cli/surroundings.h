// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "droplet/droplet.h"
#include "droplet/image/height_map.h"
#include "droplet/io/report.h"
#include "droplet/picture/environment.h"
#include "droplet/picture/picture.h"
#include "droplet/shape/base_surface.h"
#include "droplet/surface/textured_mesh.h"
#include "droplet_options.h"

namespace cli {

/// What droplets lie on, read before their picture: what is known to fail must fail before any work is done.
struct Surroundings {
    std::optional<droplet::HeightMap> map;
    std::optional<droplet::TexturedMesh> object;
    std::optional<droplet::Picture> below;      ///< to be seen there
    std::optional<droplet::Environment> light;  ///< to be mirrored
};

/// @throws droplet::Error InvalidInput; InvalidArgument if --surface-depth is missing
/// @param below  path of a picture to be seen below the droplets
/// @param light  path of one of what is all around
Surroundings readSurroundings(const DropletSettings& settings, const std::optional<std::string>& below = {},
                              const std::optional<std::string>& light = {});

/// What droplets are solved on.
/// @param extent          of the picture, which a height map is stretched over [m]
/// @throws droplet::Error InvalidArgument
droplet::BaseSurface groundOf(const DropletSettings& settings, const Surroundings& around, droplet::Vec2 extent);

/// Puts the droplets where they are on the object.
/// @param path            of the object, for the report
/// @throws droplet::Error InvalidInput if the object has no area in uv; NoSuchDroplet if none can be laid on it
droplet::ObjectReport lay(droplet::Droplet& droplet, const droplet::TexturedMesh& object, const std::string& path);

}  // namespace cli

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "droplet/drawing/picture.h"
#include "droplet/droplet.h"
#include "droplet/image/height_map.h"
#include "droplet/io/report.h"
#include "droplet/render/environment.h"
#include "droplet/render/object_stand.h"
#include "droplet/shape/base_surface.h"
#include "droplet_options.h"
#include "preview.h"

namespace cli {

/// Ground, object and light around the droplets, read before the picture, so that errors are found early.
struct Surroundings {
    std::optional<droplet::HeightMap> map;
    std::optional<droplet::ObjectStand> object;  ///< plain unless it is shown
    std::optional<droplet::Picture> below;       ///< picture on the ground
    std::optional<droplet::Environment> light;   ///< panorama that lights the scene
};

/// Reads height map, object and pictures.
/// @param preview         of the droplets
/// @throws droplet::Error InvalidInput; InvalidArgument if --surface-depth is missing
Surroundings readSurroundings(const DropletSettings& settings, const std::optional<PreviewOptions>& preview = {});

/// The object that all files have below their droplets, with its looks; null: none.
std::shared_ptr<const droplet::ObjectStand> objectInFiles(const DropletSettings& settings, const Surroundings& around);

/// Ground on which droplets are solved.
/// @param extent          extent of the picture, which a height map covers [m]
/// @throws droplet::Error InvalidArgument
droplet::BaseSurface groundOf(const DropletSettings& settings, const Surroundings& around, droplet::Vec2 extent);

/// Sinks the droplets and places them on the object, and warns of what pictures of it do not show.
/// @param settings        with the depth to sink, and the object's path for the report
/// @throws droplet::Error InvalidInput if the object has no area in uv; NoSuchDroplet if no droplet fits on it
droplet::ObjectReport placeOnObject(droplet::Droplet& droplet, const droplet::ObjectStand& object,
                                    const DropletSettings& settings);

}  // namespace cli

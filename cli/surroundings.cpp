// SPDX-License-Identifier: GPL-3.0-or-later
#include "surroundings.h"

#include <utility>

#include "droplet/error.h"
#include "droplet/io/object.h"
#include "droplet/surface/onto.h"

namespace cli {

using droplet::Error;
using droplet::ErrorCode;

Surroundings readSurroundings(const DropletSettings& settings, const std::optional<PreviewOptions>& preview)
{
    Surroundings around;
    if (settings.ground.path) {
        around.map = droplet::readHeightMap(*settings.ground.path);
        if (!around.map->in_floats && !settings.ground.depth) {
            throw Error(ErrorCode::InvalidArgument,
                        "--surface-depth is missing: give the height of white above black in " + *settings.ground.path +
                            ", such as 2mm");
        }
    }
    if (settings.onto) {
        around.object = preview && showsLooks(*preview) ? droplet::readObjectStand(*settings.onto)
                                                        : droplet::ObjectStand{droplet::readObject(*settings.onto)};
    }
    if (preview && preview->ground) {
        around.below = droplet::readPicture(*preview->ground);
    }
    if (preview && preview->environment) {
        around.light = droplet::readEnvironment(*preview->environment);
    }
    return around;
}

droplet::BaseSurface groundOf(const DropletSettings& settings, const Surroundings& around, droplet::Vec2 extent)
{
    if (around.object) {
        // Level ground as a general function: a flat base would have too few triangles to follow the object.
        return droplet::BaseSurface([](droplet::Vec2) { return droplet::GroundPoint{}; });
    }
    const droplet::GroundReport& ground = settings.ground;
    switch (ground.kind) {
        case droplet::GroundKind::Sphere:
            return droplet::BaseSurface::sphere(ground.radius.value());
        case droplet::GroundKind::Cylinder:
            return droplet::BaseSurface::cylinder(ground.radius.value(), ground.axis.value());
        case droplet::GroundKind::HeightMap:
            return droplet::BaseSurface::heightMap(around.map.value(), extent, ground.depth);
        case droplet::GroundKind::Flat:
            break;
    }
    return {};
}

droplet::ObjectReport placeOnObject(droplet::Droplet& droplet, const droplet::ObjectStand& object,
                                    const std::string& path)
{
    droplet::OntoResult result = droplet::placeOnto(droplet.surface, object.mesh, {droplet.domain.extent});
    droplet.surface = std::move(result.surface);
    droplet.warnings.insert(droplet.warnings.end(), result.report.warnings.begin(), result.report.warnings.end());
    droplet.warnings.insert(droplet.warnings.end(), object.warnings.begin(), object.warnings.end());
    const droplet::OntoReport& onto = result.report;
    return {path,
            onto.laid,
            onto.outside + onto.across + onto.folded,
            onto.flipped_charts,
            onto.overlapping_charts,
            onto.min_scale,
            onto.max_scale};
}

}  // namespace cli

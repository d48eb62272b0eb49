// SPDX-License-Identifier: GPL-3.0-or-later
#include "surroundings.h"

#include <cstdint>
#include <memory>
#include <utility>

#include "droplet/error.h"
#include "droplet/render/object_stand.h"
#include "droplet/surface/onto.h"
#include "option_values.h"
#include "surface_files.h"

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
        const bool is_shown = preview && showsLooks(*preview);
        const bool has_looks = is_shown || settings.with_object || settings.page_has_object;
        around.object = droplet::readObjectStand(*settings.onto, settings.reading,
                                                 has_looks ? droplet::StandParts::All : droplet::StandParts::Holes);
        around.object->is_plain = !is_shown;
    }
    if (preview && preview->ground) {
        around.below = droplet::readPicture(*preview->ground);
    }
    if (preview && preview->environment) {
        around.light = droplet::readEnvironment(*preview->environment);
    }
    return around;
}

std::shared_ptr<const droplet::ObjectStand> objectInFiles(const DropletSettings& settings, const Surroundings& around)
{
    if (!settings.with_object) {
        return nullptr;
    }
    auto object = std::make_shared<droplet::ObjectStand>(around.object.value());
    object->is_plain = false;
    return object;
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
                                    const DropletSettings& settings)
{
    const std::string& path = settings.onto.value();
    droplet.surface = lowered(std::move(droplet.surface), settings.sink);
    droplet::OntoOptions options{droplet.domain.extent};
    if (!object.looks.empty()) {
        options.is_there = [&](std::uint32_t triangle, droplet::Vec2 uv) { return object.isThere(triangle, uv); };
    }
    droplet::OntoResult result =
        forOption("--onto " + path, [&] { return droplet::placeOnto(droplet.surface, object.mesh, options); });
    droplet.surface = std::move(result.surface);
    droplet.warnings.insert(droplet.warnings.end(), result.report.warnings.begin(), result.report.warnings.end());
    droplet.warnings.insert(droplet.warnings.end(), object.warnings.begin(), object.warnings.end());
    const droplet::OntoReport& onto = result.report;
    return {path,
            onto.laid,
            onto.outside + onto.across + onto.folded + onto.cut_out,
            onto.flipped_charts,
            onto.overlapping_charts,
            onto.min_scale,
            onto.max_scale};
}

}  // namespace cli

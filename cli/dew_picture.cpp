// SPDX-License-Identifier: GPL-3.0-or-later
#include "dew_picture.h"

#include <cstddef>
#include <memory>

#include "droplet/flow_io/droplet_surfaces.h"
#include "droplet/flow_io/flow_painter.h"
#include "droplet/render/environment.h"
#include "video_encoding.h"

namespace cli {

std::vector<OutputFile> dewPictures(const Dew& dew, const PreviewOptions& options, droplet::Material material)
{
    droplet::FlowPainterOptions painting;
    aim(options, painting.render);
    if (options.environment) {
        painting.render.environment = droplet::readEnvironment(*options.environment);
    }
    painting.render.fit_all_azimuths = options.turns.has_value();
    painting.render.look = droplet::lookOf(material);
    const auto painter = std::make_shared<droplet::FlowPainter>(dew.object, dew.terrain, painting);
    const auto droplets = std::make_shared<const droplet::SettledDroplets>(dew.model.settled());
    return previewFiles(options, VideoFrames{}.per_second, [&options, painter, droplets](std::size_t index) {
        return painter->picture({.azimuth = options.turns ? turnOf(options, index) : 0.0}, *droplets);
    });
}

}  // namespace cli

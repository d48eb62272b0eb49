// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_frames.h"

#include <array>
#include <ostream>
#include <sstream>
#include <utility>

#include "droplet/io/output.h"
#include "droplet/render/environment.h"
#include "droplet/windshield_view/glass_maps.h"
#include "option_values.h"
#include "windshield_files.h"
#include "windshield_plan.h"

namespace cli {
namespace {

BackgroundOptions backgroundOf(const WindshieldOptions& options)
{
    BackgroundOptions background;
    background.path = options.background;
    if (options.sized) {
        background.width = options.view.width;
        background.height = options.view.height;
    }
    background.surroundings = options.environment.has_value();
    background.fit = options.fit;
    background.frames_per_second = options.frames_per_second;
    background.field_of_view = options.view.field_of_view;
    return background;
}

}  // namespace

WindshieldFrames::WindshieldFrames(const WindshieldOptions& options, const droplet::WindshieldParameters& parameters,
                                   Film& film)
    : options_(options),
      film_(film),
      glass_(parameters.glass),
      background_(backgroundOf(options)),
      view_options_(options.view)
{
    view_options_.width = background_.width();
    view_options_.height = background_.height();
    view_options_.wipers = parameters.wipers;
    if (options_.is_video) {
        requireEvenSides("--frame-size", view_options_.width, view_options_.height);
    }
    forGlass(options_, [&] { view_ = std::make_unique<droplet::DriversView>(glass_, view_options_); });
    if (options_.are_maps_exr) {
        // Writing EXR needs a library that may be missing; find this out before any work is done.
        std::ostringstream nowhere;
        writeExr(droplet::FloatPicture{1, 1, 1, {0.0F}}, nowhere);
    }
    if (options_.environment) {
        view_->setEnvironment(droplet::readEnvironment(*options_.environment));
    }
}

void WindshieldFrames::begin()
{
    if (options_.is_video) {
        video_ = std::make_unique<VideoWriter>(
            triedVideo(options_.output, {view_options_.width, view_options_.height, options_.frames_per_second},
                       options_.encoding));
    }
}

void WindshieldFrames::draw(const droplet::WindshieldState& state, std::size_t number, bool is_last,
                            const CarState& car)
{
    const bool is_shown = options_.files || options_.is_video || is_last;
    if (is_shown) {
        if (auto behind = background_.next(car.travelled, car.speed * view_options_.shutter_time)) {
            view_->setBackground(*behind);
        }
        view_->show(state);
    } else {
        background_.skip(1);
    }
    if (options_.is_video && options_.layer) {
        video_->add(view_->layer());
    } else if (options_.is_video) {
        video_->add(view_->frame());
    } else if (is_shown) {
        layer_ = options_.layer ? view_->layer() : droplet::Layer();
        picture_ = options_.layer ? droplet::Picture() : view_->frame();
    }
    if (options_.files) {
        film_.save({{options_.files->at(number),
                     [layer = std::move(layer_), picture = std::move(picture_), this](std::ostream& out) {
                         writePicture(out, layer, picture, droplet::PngEffort::Fast);
                     }}});
    }
    if (options_.maps) {
        writeMaps(state, number);
    }
}

void WindshieldFrames::writePicture(std::ostream& out, const droplet::Layer& layer, const droplet::Picture& picture,
                                    droplet::PngEffort effort) const
{
    if (options_.layer) {
        writePng(layer, out, effort);
    } else {
        writePng(picture, out, effort);
    }
}

void WindshieldFrames::writeMaps(const droplet::WindshieldState& state, std::size_t number) const
{
    const auto write = [&](std::size_t map, const auto& writer) {
        droplet::writeAtomically(options_.maps->beside(kMapNames[map]).at(number), writer, options_.run.files);
    };
    if (options_.are_maps_exr) {
        const droplet::GlassFloatMaps maps = glassFloatMaps(glass_, state, options_.map);
        const std::array<const droplet::FloatPicture*, kMapNames.size()> all{&maps.normal, &maps.thickness,
                                                                             &maps.velocity};
        for (std::size_t k = 0; k < all.size(); ++k) {
            write(k, [&](std::ostream& out) { writeExr(*all[k], out); });
        }
        return;
    }
    const droplet::GlassMaps maps = glassMaps(glass_, state, options_.map);
    const std::array<const droplet::DeepPicture*, kMapNames.size()> all{&maps.normal, &maps.thickness, &maps.velocity};
    for (std::size_t k = 0; k < all.size(); ++k) {
        write(k, [&](std::ostream& out) { writePng(*all[k], out, droplet::PngEffort::Fast); });
    }
}

void WindshieldFrames::write(std::ostream& out)
{
    if (options_.is_video) {
        video_->finish(out);
    } else {
        writePicture(out, layer_, picture_, droplet::PngEffort::Small);
    }
}

}  // namespace cli

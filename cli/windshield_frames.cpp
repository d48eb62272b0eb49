// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_frames.h"

#include <ostream>
#include <sstream>
#include <utility>

#include "droplet/render/environment.h"
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
    if (options_.maps) {
        forGlass(options_, [&] { maps_ = std::make_unique<droplet::GlassMapFrames>(glass_, options_.map); });
    }
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
    std::vector<OutputFile> files;
    if (options_.files) {
        files.push_back({options_.files->at(number),
                         [layer = std::move(layer_), picture = std::move(picture_), this](std::ostream& out) {
                             writePicture(out, layer, picture, droplet::PngEffort::Fast);
                         }});
    }
    if (maps_) {
        for (OutputFile& file : mapsOf(state, number)) {
            files.push_back(std::move(file));
        }
    }
    if (!files.empty()) {
        film_.save(std::move(files));
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

std::vector<OutputFile> WindshieldFrames::mapsOf(const droplet::WindshieldState& state, std::size_t number)
{
    // They are written while the next ones are drawn: each file has a map of its own.
    const auto file = [&](std::size_t map, auto picture, auto write) {
        auto held = std::make_shared<const decltype(picture)>(std::move(picture));
        return OutputFile{options_.maps->beside(kMapNames[map]).at(number),
                          [held, write](std::ostream& out) { write(*held, out); }};
    };
    if (options_.are_maps_exr) {
        droplet::GlassFloatMaps maps = maps_->floatMaps(state);
        const auto write = [](const droplet::FloatPicture& picture, std::ostream& out) { writeExr(picture, out); };
        return {file(0, std::move(maps.normal), write), file(1, std::move(maps.thickness), write),
                file(2, std::move(maps.velocity), write)};
    }
    const droplet::GlassMaps& maps = maps_->maps(state);
    const auto write = [](const droplet::DeepPicture& picture, std::ostream& out) {
        writePng(picture, out, droplet::PngEffort::Fast);
    };
    return {file(0, maps.normal, write), file(1, maps.thickness, write), file(2, maps.velocity, write)};
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

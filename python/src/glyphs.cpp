// SPDX-License-Identifier: GPL-3.0-or-later
#include "glyphs.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "arguments.h"
#include "droplet/type/font.h"
#include "droplet/type/glyph.h"
#include "glyphs_command.h"
#include "glyphs_options.h"
#include "mask_shape.h"
#include "shape.h"
#include "surroundings.h"
#include "work.h"

namespace binding {
namespace {

namespace py = pybind11;

droplet::InputReport inputOf(const droplet::Font& font, const cli::GlyphsOptions& options, const std::string& text,
                             const droplet::TextLayout& layout)
{
    droplet::TypeReport type = cli::describe(font, options);
    type.text = text;
    type.missing = layout.missing;
    droplet::InputReport input;
    input.path = options.font;
    input.specks_dropped = layout.outline.specks_dropped;
    input.type = std::move(type);
    return input;
}

std::shared_ptr<Droplet> glyphs(const std::filesystem::path& path, const std::string& text, const Arguments& arguments)
{
    cli::StageClock clock;
    clock.begin(droplet::Stage::Read);
    Arguments all = arguments;
    all.insert(all.end(), {"--font=" + path.string(), "--text=text", "--output=droplet.glb"});
    auto options = parsed(cli::parseGlyphs, all);
    const Work work(options.shape.run.threads);
    const droplet::Font font = droplet::readFont(options.font, options.face);
    cli::DropletSettings& settings = options.shape.settings;
    settings.with_object = false;  // save() reads what files need of it
    const cli::Surroundings around = cli::readSurroundings(settings);
    cli::readPath(options);
    if (around.object) {
        cli::fitToObject(options, around.object->mesh, font, text);
    }
    droplet::TextLayout layout = droplet::layOutText(font, text, options.type);
    const cli::LeftOut left_out{layout.missing, layout.beyond};
    cli::requireInk(!layout.outline.loops.empty(), left_out, options);
    cli::noteLeftOut(left_out, options);
    settings.droplet.solve.ground = groundOf(settings, around, layout.outline.extent);
    cli::refuseTooShortEdge(cli::coveredArea(layout.outline), settings.droplet);
    droplet::InputReport input = inputOf(font, options, text, layout);
    droplet::Droplet made =
        droplet::makeDroplet(std::move(layout.outline), settings.droplet,
                             [&](droplet::Stage stage, double share) { clock.begin(stage, share); });
    return Droplet::make(std::move(made), settings, {std::move(input), around}, clock);
}

}  // namespace

void bindGlyphs(py::module_& module)
{
    module.def("glyphs", &glyphs);
}

}  // namespace binding

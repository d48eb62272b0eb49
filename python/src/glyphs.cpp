// SPDX-License-Identifier: GPL-3.0-or-later
#include "glyphs.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "arguments.h"
#include "droplet/error.h"
#include "droplet/surface/onto.h"
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

using droplet::Error;
using droplet::ErrorCode;

std::string missingText(const std::vector<char32_t>& missing)
{
    std::string text = "the font has no glyph for ";
    for (const char32_t character : missing) {
        text += (character == missing.front() ? "" : ", ") + droplet::characterText(character);
    }
    return text;
}

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
    droplet::GlyphOptions& glyph = options.type.glyph;
    if (around.object && !options.sized) {
        // The text is as large as a picture would be.
        const droplet::Vec2 extent = droplet::layOutText(font, text, options.type).outline.extent;
        glyph.em *= droplet::metresPerUv(around.object->mesh) * std::sqrt(extent.x / extent.y) / extent.x;
    }
    droplet::TextLayout layout = droplet::layOutText(font, text, options.type);
    if (layout.outline.loops.empty()) {
        throw Error(ErrorCode::InvalidInput,
                    options.font + ": " +
                        (layout.missing.empty() ? "the text has no ink"
                                                : missingText(layout.missing) + ", and nothing is left"));
    }
    if (!layout.missing.empty()) {
        settings.warnings.push_back(missingText(layout.missing) + "; left out");
    }
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

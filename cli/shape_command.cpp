// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_command.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "colour_shape.h"
#include "droplet/colours/colour_regions.h"
#include "droplet/drawing/grey_picture.h"
#include "droplet/drawing/picture.h"
#include "droplet/error.h"
#include "droplet/io/evolver.h"
#include "droplet/render/droplet_maps.h"
#include "droplet/surface/onto.h"
#include "droplet/surface/plate.h"
#include "droplet/surface/simplify.h"
#include "droplet/units.h"
#include "droplet_report.h"
#include "file_droplets.h"
#include "files.h"
#include "html_page.h"
#include "mask_shape.h"
#include "picture_watch.h"
#include "progress_display.h"
#include "run_command.h"
#include "shape_maps.h"
#include "stage_clock.h"
#include "summary.h"
#include "surface_files.h"
#include "surroundings.h"
#include "terminal.h"
#include "this_process.h"

namespace cli {
namespace {

using droplet::Droplet;
using droplet::Error;
using droplet::ErrorCode;
using droplet::Stage;

/// Runs a function that may reject the picture's content, and puts the picture's name before the error message.
template <typename Function>
auto forInput(const ShapeOptions& options, Function function)
{
    try {
        return function();
    } catch (const Error& error) {
        // Of other files than the picture, messages begin with the option.
        if (error.code() != ErrorCode::InvalidInput || std::string_view(error.what()).starts_with("--")) {
            throw;
        }
        throw Error(error.code(), (isStream(options.input) ? "standard input" : options.input) + ": " + error.what());
    }
}

/// Longer side [px] at which an SVG image must be drawn, so that a pixel is at most a quarter of a triangle's edge.
/// Nothing if the image is large enough, or cannot be larger.
///
/// A traced outline differs from the drawn one by 0.02 pixels rms and half a pixel at corners, whatever the pixels'
/// size. So the error is at most an eighth of an edge, even where pixels could be visible.
std::optional<int> finerSide(const droplet::Mask& mask, const droplet::DropletOptions& options)
{
    constexpr double kPixelsPerEdge = 4.0;
    constexpr int kLongest = 8192;  // half a gigabyte while it is drawn
    const double covered = std::accumulate(mask.coverage.begin(), mask.coverage.end(), 0.0) / 65535.0;
    const double equilateral = covered / static_cast<double>(options.mesh.triangles);
    const double edge = options.mesh.edge ? *options.mesh.edge / droplet::pixelSize(mask, options.trace)
                                          : std::sqrt(equilateral * 4.0 / std::sqrt(3.0));
    const int side = std::max(mask.width, mask.height);
    if (!mask.raster_scale || edge >= kPixelsPerEdge || !(edge > 0.0) || side >= kLongest) {
        return std::nullopt;
    }
    return static_cast<int>(std::min<double>(kLongest, std::ceil(side * kPixelsPerEdge / edge)));
}

void writeMask(std::ostream& out, const droplet::Mask& mask, const droplet::TraceOptions& trace)
{
    const droplet::Mask used = tracedMask(mask, trace);
    droplet::writeShortestPng({used.width, used.height, 1, used.coverage}, out);
}

/// Whether only the page's droplet gets a slider: without --fill-range, if a slider is possible.
bool hasSliderInPageOnly(const ShapeOptions& options)
{
    const droplet::SolveOptions& solve = options.settings.droplet.solve;
    return options.html && !options.settings.droplet.fill_range && !solve.no_penetration && !options.settings.onto &&
           !options.settings.base;
}

void addPageSlider(droplet::DropletOptions& droplet, const ShapeOptions& options)
{
    if (hasSliderInPageOnly(options)) {
        droplet.fill_range = droplet::FillRange{.may_shrink = true};
    }
}

/// What is written beside the surface.
struct Extras {
    std::vector<droplet::FileDroplet> droplets;
    std::optional<PreviewSubject> subject;
    std::optional<OutputFile> mask;
    std::vector<OutputFile> maps;
    std::string texture;                              ///< bytes of a PNG, or empty
    std::optional<droplet::Surface> in_file;          ///< what OUTPUT holds, if it is not the droplets alone
    std::vector<droplet::Surface> levels = {};        ///< of detail, but the first
    std::optional<droplet::Refill> page_refill = {};  ///< of the page's slider, if OUTPUT has none
    /// What pictures and the page show, if it is not the droplets alone: on the ground, not below it.
    std::optional<droplet::Surface> shown = {};
    const droplet::ObjectStand* page_object = nullptr;  ///< below the droplets of the page; null: none
};

/// Writes the page with the droplet as a GLB, on the object if the page shows it.
void writeHtml(std::ostream& out, const droplet::Surface& surface, const ShapeOptions& options, const Extras& extras,
               const droplet::Report& report)
{
    const bool is_text = report.input.type && report.input.type->text;
    const auto name = [&] {
        return isStream(options.input) ? "droplet" : std::filesystem::path(options.input).stem().string();
    };
    writeHtmlPage(out, {is_text ? *report.input.type->text : name(),
                        [&](std::ostream& model) {
                            writeSurface(surface, model,
                                         {{},
                                          droplet::Format::Glb,
                                          {.material = options.settings.material,
                                           .closed = report.output.topology.closed,
                                           .droplets = extras.droplets,
                                           .texture = extras.texture},
                                          extras.page_object});
                        },
                        [&](std::ostream& json) { droplet::writeReport(json, report); }});
}

/// Subject of the preview.
PreviewSubject subjectOf(const MadeShape& made, const Extras& extras, const Surroundings& around)
{
    PreviewSubject subject{extras.shown ? *extras.shown : made.droplet.surface,
                           droplet::lookOf(made.settings.material),
                           droplet::looksOf(extras.droplets),
                           made.colour_map,
                           made.droplet.domain.extent,
                           around.below,
                           around.light,
                           around.object};
    const droplet::BaseSurface& below = made.settings.droplet.solve.ground;
    if (!around.object && !below.flat()) {
        subject.curved = droplet::groundMesh(below, made.droplet.domain.extent);
    }
    subject.by_colour = !made.colours.empty();
    return subject;
}

/// Writes the surface and, if given, the mask, the datafile for Surface Evolver, the page, the pictures and the report.
/// @param object  in the surface's file; null: none
void save(Droplet& droplet, const droplet::ObjectStand* object, const ShapeOptions& options, Extras& extras,
          StageClock& clock, droplet::Report& report)
{
    const droplet::Surface& written = extras.in_file ? *extras.in_file : droplet.surface;
    std::vector<OutputFile> files = surfaceFiles(written,
                                                 {options.output,
                                                  options.format,
                                                  {.material = options.settings.material,
                                                   .closed = report.output.topology.closed,
                                                   .unit = options.settings.unit,
                                                   .nodes = options.settings.nodes,
                                                   .droplets = extras.droplets,
                                                   .texture = extras.texture,
                                                   .compression = options.compression,
                                                   .levels = extras.levels},
                                                  object},
                                                 report.output.bytes);
    if (extras.mask) {
        files.push_back(*extras.mask);
    }
    files.insert(files.end(), extras.maps.begin(), extras.maps.end());
    if (options.evolver) {
        files.push_back({*options.evolver, [&](std::ostream& out) {
                             droplet::writeEvolver(out, droplet.solution.droplets, report.physics);
                         }});
    }
    if (options.html) {
        files.push_back({*options.html, [&](std::ostream& out) {
                             if (extras.page_refill) {
                                 droplet.surface.refill.swap(extras.page_refill);
                             }
                             writeHtml(out, extras.shown ? *extras.shown : droplet.surface, options, extras, report);
                         }});
    }
    if (extras.subject) {
        for (OutputFile& file : previewFiles(*options.preview, *extras.subject)) {
            files.push_back(std::move(file));
        }
    }
    if (options.json) {
        files.push_back({*options.json, [&](std::ostream& out) {
                             // The report is the last file, so that it contains the time of the others.
                             report.time = clock.times();
                             report.time_total = clock.total();
                             report.peak_memory = peakMemory();
                             droplet::writeReport(out, report);
                         }});
    }
    writeTogether(files, options.run.files);
    report.time = clock.times();
    report.time_total = clock.total();
    report.peak_memory = peakMemory();
}

/// Reports every stage and measures its time.
struct Stages {
    StageClock clock;
    droplet::Progress progress;

    /// @param share  as of droplet::Progress
    void begin(Stage stage, double share = 0.0)
    {
        clock.begin(stage, share);
        progress(stage, share);
    }
};

/// Writes the files of droplets, and returns the report.
droplet::Report finish(MadeShape made, const Surroundings& around, const ShapeOptions& options, Stages& stages)
{
    stages.begin(Stage::Write);
    DescribedShape described = describe(made, options);
    droplet::Report& report = described.report;
    Extras extras{std::move(described.droplets), {}, {}, {}, textureOf(made), {}};
    if (const auto base = made.settings.base) {
        const droplet::PlateOptions plate{*base, made.droplet.domain.extent};
        if (extras.droplets.empty()) {
            extras.in_file = droplet::onPlate(made.droplet.solution.droplets, plate);
            if (made.settings.droplet.mesh.quads) {
                droplet::joinTriangles(*extras.in_file);
            }
        } else {
            extras.in_file = droplet::withPlate(made.droplet.surface, extras.droplets.size(), plate);
            droplet::Look look = droplet::lookOf(made.settings.material);
            look.name = "plate";  // so that droplets with the liquid's own look stay parts of their own
            extras.droplets.push_back({"plate", std::move(look)});
        }
        extras.shown = lowered(*extras.in_file, -*base);
        // Pictures take what copies of the rim lead to for ground; here that is the underside alone.
        std::iota(extras.shown->weld.begin(), extras.shown->weld.end(), 0U);
        if (auto warning = droplet::printWarning(made.droplet.meshes, made.droplet.figures, plate)) {
            report.warnings.push_back(*std::move(warning));
        }
    }
    if (hasSliderInPageOnly(options)) {
        extras.page_refill.swap(made.droplet.surface.refill);
    }
    // Previews and the page have a ground of their own; an object's droplets were lowered before they were laid on it.
    if (made.settings.sink > 0.0 && !made.settings.onto) {
        extras.in_file = lowered(made.droplet.surface, made.settings.sink);
    }
    const droplet::Surface& whole = extras.in_file ? *extras.in_file : made.droplet.surface;
    // Levels are made with both copies of the rim, which is a crease then, and joined afterwards.
    Levels levels = makeLevels(whole, made.settings, options.output, options.format);
    extras.levels = std::move(levels.surfaces);
    report.warnings.insert(report.warnings.end(), levels.warnings.begin(), levels.warnings.end());
    if (made.settings.weld) {
        extras.in_file = droplet::welded(whole);
    }
    const droplet::ObjectStand* const object = made.settings.with_object ? &around.object.value() : nullptr;
    extras.page_object = made.settings.page_has_object ? &around.object.value() : nullptr;
    const droplet::Surface& written = extras.in_file ? *extras.in_file : made.droplet.surface;
    report.output = describeOutput(written, options.output, options.format);
    report.output.levels = std::move(levels.reports);
    report.output.base = made.settings.base;
    report.output.compression = options.compression;
    if (options.compression != droplet::Compression::None) {
        report.output.compression_error = droplet::compressionError(
            written, options.compression, object != nullptr ? object->mesh.vertices : std::vector<droplet::Vec3>());
    }
    if (options.footprint.mask_out) {
        extras.mask = {*options.footprint.mask_out,
                       [&](std::ostream& out) { writeMask(out, *made.mask, made.settings.droplet.trace); }};
    }
    if (options.maps) {
        const auto maps = std::make_shared<droplet::DropletMaps>(
            droplet::dropletMaps(made.droplet.surface, {.extent = made.droplet.domain.extent,
                                                        .width = options.maps->width,
                                                        .is_tile = options.maps->is_tile,
                                                        .ground = made.settings.droplet.solve.ground}));
        if (auto seam = options.maps->is_tile ? seamWarning(*maps, made.droplet.domain.extent) : std::nullopt) {
            report.warnings.push_back(*std::move(seam));
        }
        report.output.maps = mapPaths(*options.maps);
        report.output.map_thickness = whiteOf(*maps, *options.maps);
        extras.maps = mapFiles(maps, *options.maps, report.output.map_thickness);
    }
    if (options.preview) {
        extras.subject.emplace(subjectOf(made, extras, around));
    }
    save(made.droplet, object, options, extras, stages.clock, report);
    return report;
}

MadeShape makeFromMask(const ShapeOptions& options, const Surroundings& around, std::vector<std::byte> picture,
                       Stages& stages)
{
    droplet::MaskOptions mask_options = readMaskOptions(options.footprint);
    const auto decode = [&] { return decodedMask(picture, mask_options); };
    droplet::Mask mask = forInput(options, decode);
    DropletSettings settings = forInput(options, [&] { return completeSettings(mask, around, options); });
    if (const auto side = finerSide(mask, settings.droplet)) {
        mask_options.vector_long_side = *side;
        mask = forInput(options, decode);
        settings = completeSettings(mask, around, options);
    }
    std::optional<droplet::Picture> colour_map;
    if (settings.colour_map) {
        colour_map = forInput(options, [&] { return droplet::decodePicture(picture); });
    }
    const auto hidden = settings.colour_map ? std::nullopt : hiddenColoursWarning(mask, picture, mask_options);
    picture = {};
    addPageSlider(settings.droplet, options);
    const auto begin = [&](Stage stage, double share) { stages.begin(stage, share); };
    MaskShape made = forInput(options, [&] { return makeOfMask(mask, settings, options, begin); });
    if (hidden) {
        settings.warnings.push_back(*hidden);
    }
    for (auto& warning :
         {seedsWarning(mask_options), maskWarning(mask, "look at it with --mask-out"), drawingWarning(mask)}) {
        if (warning) {
            settings.warnings.insert(settings.warnings.begin(), *warning);
        }
    }
    return {.droplet = std::move(made.droplet),
            .settings = std::move(settings),
            .input = std::move(made.input),
            .mask = options.footprint.mask_out ? std::optional(std::move(mask)) : std::nullopt,
            .colour_map = std::move(colour_map)};
}

/// Input by colour: a picture, or type.
struct ColourSource {
    /// Reads the regions; drawings without pixels get so many on their longer side.
    std::function<droplet::ColourRegions(std::optional<int> long_side)> read;
    std::optional<double> speck_size = {};  ///< as in DrawnColours, if larger than that of the options
    std::optional<droplet::TypeReport> type = {};
};

/// Makes droplets from the regions of one colour.
MadeShape makeByColour(const ShapeOptions& options, const Surroundings& around, const ColourSource& source,
                       Stages& stages)
{
    droplet::ColourRegions regions = forInput(options, [&] { return source.read(std::nullopt); });
    droplet::Mask mask = maskOf(regions);
    DropletSettings settings = forInput(options, [&] { return completeSettings(mask, around, options); });
    if (const auto side = finerSide(mask, settings.droplet)) {
        regions = forInput(options, [&] { return source.read(*side); });
        mask = maskOf(regions);
        settings = completeSettings(mask, around, options);
    }
    if (source.speck_size) {
        const double pixel = droplet::pixelSize(mask, settings.droplet.trace);
        double& speck_size = settings.droplet.trace.speck_size;
        speck_size = std::max(speck_size, *source.speck_size / (pixel * pixel));
    }
    addPageSlider(settings.droplet, options);
    const auto begin = [&](Stage stage, double share) { stages.begin(stage, share); };
    ColourShape made = forInput(options, [&] { return makeOfColours(regions, settings, options, begin); });
    made.input.type = source.type;
    settings.warnings.insert(settings.warnings.begin(), made.warnings.begin(), made.warnings.end());
    if (auto warning = drawingWarning(mask)) {
        settings.warnings.insert(settings.warnings.begin(), std::move(*warning));
    }
    return {.droplet = std::move(made.droplet),
            .settings = std::move(settings),
            .input = std::move(made.input),
            .colours = std::move(made.colours)};
}

MadeShape makeByColour(const ShapeOptions& options, const Surroundings& around, const std::vector<std::byte>& picture,
                       Stages& stages)
{
    droplet::ColourOptions colour_options;
    colour_options.colours = options.footprint.by_colour->colours;
    colour_options.channel = options.footprint.mask.channel;
    return makeByColour(options, around, {[&](std::optional<int> long_side) {
                            colour_options.vector_long_side = long_side.value_or(colour_options.vector_long_side);
                            return droplet::decodeColours(picture, colour_options);
                        }},
                        stages);
}

MadeShape make(const ShapeOptions& options, const Surroundings& around, std::vector<std::byte> picture, Stages& stages)
{
    return placed(options.footprint.by_colour ? makeByColour(options, around, picture, stages)
                                              : makeFromMask(options, around, std::move(picture), stages),
                  around);
}

/// Calls a function at once and whenever a picture is saved, until a signal ends the program. A picture may be half
/// drawn, so what the function throws is printed.
[[noreturn]] void makeWheneverSaved(const std::string& picture, const std::function<void()>& make)
{
    PictureWatch watch(picture);
    for (;; watch.wait()) {
        try {
            make();
        } catch (const Error& error) {
            printError(error.what());
        }
    }
}

}  // namespace

MadeShape placed(MadeShape made, const Surroundings& around)
{
    if (around.object) {
        made.onto = placeOnObject(made.droplet, *around.object, made.settings);
    }
    return made;
}

MadeShape makeOfPicture(const ShapeOptions& options, const Surroundings& around, std::vector<std::byte> picture)
{
    Stages stages{{}, [](Stage, double) {}};
    return make(options, around, std::move(picture), stages);
}

DescribedShape describe(const MadeShape& made, const ShapeOptions& options)
{
    DescribedShape described{describe(made.droplet, made.settings), {}};
    droplet::Report& report = described.report;
    report.fill_range = options.settings.droplet.fill_range;
    report.input = made.input;
    report.onto = made.onto;
    for (std::size_t k = 0; k < made.colours.size(); ++k) {
        report.droplets[k].colour = made.colours[k];
    }
    const DropletSettings& settings = made.settings;
    described.droplets =
        fileDroplets(report.droplets, {settings.material, settings.nodes, settings.materials}, report.warnings);
    return described;
}

std::string textureOf(const MadeShape& made)
{
    std::ostringstream png;
    if (made.colour_map) {
        droplet::writePng(*made.colour_map, png);
    }
    return std::move(png).str();
}

std::vector<std::byte> readPicture(const ShapeOptions& options)
{
    return isStream(options.input) ? readStandardInput(options.footprint.mask.max_pixels)
                                   : droplet::readImageBytes(options.input);
}

droplet::Report makeShape(const ShapeOptions& options, const droplet::Progress& progress)
{
    Stages stages{{}, progress};
    stages.begin(Stage::Read);
    const Surroundings around = readSurroundings(options.settings, options.preview);
    return finish(make(options, around, readPicture(options), stages), around, options, stages);
}

droplet::Report makeShape(const ShapeOptions& options, const Surroundings& around, std::vector<std::byte> picture)
{
    Stages stages{{}, [](Stage, double) {}};
    stages.begin(Stage::Read);
    return finish(make(options, around, std::move(picture), stages), around, options, stages);
}

droplet::Report makeShape(const ShapeOptions& options, const Surroundings& around, const DrawnColours& drawn,
                          const droplet::Progress& progress)
{
    Stages stages{{}, progress};
    const auto draw = [&](std::optional<int> long_side) {
        return long_side ? droplet::drawColours(drawn.drawing, *long_side) : droplet::drawColours(drawn.drawing);
    };
    MadeShape made = makeByColour(options, around, {draw, drawn.speck_size, drawn.input.type}, stages);
    return finish(placed(std::move(made), around), around, options, stages);
}

droplet::Report makeShape(const ShapeOptions& options, const Surroundings& around, DrawnFootprint footprint,
                          const droplet::Progress& progress)
{
    Stages stages{{}, progress};
    DropletSettings settings = options.settings;
    settings.droplet.solve.ground = groundOf(settings, around, footprint.outline.extent);
    refuseTooShortEdge(coveredArea(footprint.outline), settings.droplet);
    addPageSlider(settings.droplet, options);
    footprint.input.specks_dropped = footprint.outline.specks_dropped;
    Droplet droplet = droplet::makeDroplet(std::move(footprint.outline), settings.droplet,
                                           [&](Stage stage, double share) { stages.begin(stage, share); });
    MadeShape made{.droplet = std::move(droplet), .settings = std::move(settings), .input = std::move(footprint.input)};
    return finish(placed(std::move(made), around), around, options, stages);
}

void addSettings(RunFiles& files, const DropletSettings& settings, const RunOptions& run)
{
    files.reads("--config", run.config);
    files.reads("--surface", settings.ground.path);
    files.reads("--onto", settings.onto);
    if (settings.materials) {
        files.reads("--materials", settings.materials->path);
    }
}

RunFiles filesOf(const ShapeOptions& options, const std::string& input_name)
{
    RunFiles files;
    files.reads(input_name, options.input);
    files.reads("--seeds", options.footprint.seeds);
    addSettings(files, options.settings, options.run);
    if (options.preview) {
        files.reads("--ground", options.preview->ground);
        files.reads("--environment", options.preview->environment);
    }
    files.writes("OUTPUT", options.output);
    files.writes("OUTPUT's material", materialFile(options.output, options.format));
    for (const std::string& path : levelPaths(options.output, options.format, options.settings.levels.size())) {
        files.writes("OUTPUT's level", path);
    }
    files.writes("--json", options.json);
    files.writes("--mask-out", options.footprint.mask_out);
    files.writes("--export-evolver", options.evolver);
    files.writes("--html", options.html);
    if (options.maps) {
        for (const std::string& path : mapPaths(*options.maps)) {
            files.writesInFolder("--maps", path);
        }
    }
    if (options.preview) {
        for (const std::string& path : previewPaths(*options.preview)) {
            files.writes("--preview", path);
        }
    }
    return files;
}

void checkShape(const ShapeOptions& options, const RunFiles& files)
{
    checkFiles(files, options.run.files);
    if (options.preview) {
        checkVideo(*options.preview);
    }
}

void printWarning(const std::string& warning, ProgressMode progress)
{
    if (progress == ProgressMode::Json) {
        std::cerr << nlohmann::json{{"warning", warning}}.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
                  << "\n"
                  << std::flush;
        return;
    }
    std::cerr << paint("warning: ", Colour::Yellow) << oneLine(warning) << "\n" << std::flush;
}

void makeAndReport(const RunOptions& run, const RunFiles& files,
                   const std::function<droplet::Report(const droplet::Progress&)>& make)
{
    runAndTell(run, files, [&](ProgressDisplay& progress) {
        const droplet::Report report = make([&](Stage stage, double share) { progress.begin(stage, share); });
        return RunEnd{summary(report, run.verbosity == Verbosity::Verbose), report.warnings, report.severe_warnings};
    });
}

int runShape(int argc, const char* const* argv)
{
    const auto parsed = parseShape(argc, argv);
    if (const auto* text = std::get_if<std::string>(&parsed)) {
        print(*text);
        return 0;
    }
    const auto& options = std::get<ShapeOptions>(parsed);
    checkShape(options, filesOf(options, "INPUT"));
    const auto make = [&] {
        makeAndReport(options.run, filesOf(options, "INPUT"),
                      [&](const droplet::Progress& progress) { return makeShape(options, progress); });
    };
    if (options.watch) {
        makeWheneverSaved(options.input, make);
    }
    make();
    return 0;
}

}  // namespace cli

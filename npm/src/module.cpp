// SPDX-License-Identifier: GPL-3.0-or-later
// The functions that droplet_shape.js calls: reads a mask, makes a droplet of it by the command's options, or covers an
// object with droplets, and hands out arrays of the result.
#include <emscripten/emscripten.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "command_line.h"
#include "dew_options.h"
#include "dew_run.h"
#include "droplet/droplet.h"
#include "droplet/error.h"
#include "droplet/io/output.h"
#include "droplet/io/report.h"
#include "droplet/mask/mask.h"
#include "droplet/mask/two_levels.h"
#include "droplet/render/droplet_maps.h"
#include "droplet/render/object_stand.h"
#include "droplet/render/write_on_object.h"
#include "droplet/shape/base_surface.h"
#include "droplet_report.h"
#include "files.h"
#include "mask_shape.h"
#include "shape_maps.h"
#include "shape_options.h"
#include "stage_clock.h"
#include "surroundings.h"

namespace {

using droplet::Error;
using droplet::ErrorCode;

/// How a mask is given; known to solver.js.
enum class MaskKind : int { Png = 0, Bytes = 1, Words = 2 };

/// Arrays of a result; known to solver.js.
enum class Array : int {
    Positions,
    Normals,
    Uvs,
    ContactAngles,
    Triangles,
    Report,
    File,
    Message,
    Code,
    Coverage,
    Name
};

/// Covered object and how its files are wanted.
struct MadeDew {
    cli::DewCommandOptions options;
    cli::Dew dew;
};

struct MapFile {
    std::string name;
    std::string bytes;
};

/// A mask, a droplet or a covered object, or the error that prevented it.
struct Result {
    bool is_dew = false;  ///< whether an object is to be covered
    std::optional<MadeDew> dew;
    droplet::Mask mask;        ///< of droplet_mask
    double pixel_size = 0.0;   ///< of this mask [m]
    droplet::Surface surface;  ///< of all droplets
    droplet::Report report;
    droplet::Material material = droplet::Material::Water;
    droplet::LengthUnit unit = droplet::LengthUnit::Millimetre;
    std::optional<std::string> object;  ///< path of the object that the droplets lie on
    droplet::ObjectOptions reading;     ///< of this object
    bool with_object = false;           ///< whether files have it, too
    droplet::Vec2 extent;               ///< of the mask [m]
    droplet::BaseSurface ground;
    std::vector<MapFile> maps;  ///< of the last droplet_maps
    std::string name;           ///< of the last droplet_map
    std::vector<float> positions;
    std::vector<float> normals;
    std::vector<float> uvs;
    std::string json;
    std::string file;
    std::span<const std::byte> given_out;  ///< by the last droplet_array
    std::string message;
    std::string code;
};

struct Given {
    std::span<const std::byte> bytes;
    int width = 0;
    int height = 0;
    MaskKind kind = MaskKind::Png;
};

void declare(cli::CommandLine& line, cli::ShapeOptions& options, cli::ShapeMapOptions& maps)
{
    cli::declareShapes(line, options);
    cli::declareSeeds(line, options.footprint);
    cli::declareShapeMaps(line, maps);
    cli::declareRun(line);
}

cli::ShapeOptions parse(const std::vector<std::string>& arguments)
{
    cli::CommandLine line({"droplet-shape", "", "", ""});
    cli::ShapeOptions options;
    cli::ShapeMapOptions maps;
    declare(line, options, maps);
    std::vector<const char*> words{"droplet-shape"};
    for (const std::string& argument : arguments) {
        words.push_back(argument.c_str());
    }
    line.parse(static_cast<int>(words.size()), words.data());
    line.read();
    options.input = "mask";
    options.output = "droplet.glb";
    cli::readShapes(line, options, "OUTPUT");
    options.maps = cli::readShapeMaps(line, maps);
    if (options.run.config || options.settings.ground.path) {
        throw Error(ErrorCode::InvalidArgument,
                    "--config and height maps of --surface need files, which the module cannot read");
    }
    return options;
}

/// @return  the options, or the text of the help
std::variant<cli::DewCommandOptions, std::string> parseDew(const std::vector<std::string>& arguments)
{
    std::vector<const char*> words{"droplet-shape dew"};
    for (const std::string& argument : arguments) {
        words.push_back(argument.c_str());
    }
    return cli::parseDew(static_cast<int>(words.size()), words.data());
}

/// Reads a picture, or takes coverage as it is.
droplet::Mask maskOf(const Given& given, const cli::FootprintOptions& footprint)
{
    if (given.kind == MaskKind::Png) {
        return cli::decodedMask(given.bytes, cli::readMaskOptions(footprint));
    }
    if (footprint.seeds) {
        throw Error(ErrorCode::InvalidArgument, "--seeds needs a picture, not coverage");
    }
    droplet::Mask mask;
    mask.width = given.width;
    mask.height = given.height;
    if (given.kind == MaskKind::Words) {
        mask.coverage.resize(given.bytes.size() / sizeof(std::uint16_t));
        std::memcpy(mask.coverage.data(), given.bytes.data(), mask.coverage.size() * sizeof(std::uint16_t));
    } else {
        mask.coverage.reserve(given.bytes.size());
        for (const std::byte level : given.bytes) {
            mask.coverage.push_back(static_cast<std::uint16_t>(257 * std::to_integer<int>(level)));
        }
    }
    if (const auto both = droplet::twoLevels(std::span<const std::uint16_t>(mask.coverage))) {
        std::transform(mask.coverage.begin(), mask.coverage.end(), mask.coverage.begin(), [&](std::uint16_t level) {
            return static_cast<std::uint16_t>(level == both->second ? 0xFFFF : 0);
        });
    }
    if (footprint.mask.invert) {
        cli::invert(mask);
    }
    return mask;
}

std::uint64_t memory()
{
    return static_cast<std::uint64_t>(__builtin_wasm_memory_size(0)) * 65536U;
}

void make(Result& result, const std::vector<std::string>& arguments, const Given& given)
{
    cli::StageClock clock;
    clock.begin(droplet::Stage::Read);
    cli::ShapeOptions options = parse(arguments);
    // What a file needs of the object is read when one is written: Studio makes droplets with every stroke.
    result.with_object = std::exchange(options.settings.with_object, false);
    result.object = options.settings.onto;
    result.reading = options.settings.reading;
    const cli::Surroundings around = cli::readSurroundings(options.settings);
    const droplet::Mask mask = maskOf(given, options.footprint);
    cli::DropletSettings settings = cli::completeSettings(mask, around, options);
    cli::MaskShape made = cli::makeOfMask(mask, settings, options,
                                          [&](droplet::Stage stage, double share) { clock.begin(stage, share); });
    std::optional<droplet::ObjectReport> onto;
    if (around.object) {
        onto = cli::placeOnObject(made.droplet, *around.object, settings);
    }
    if (auto warning = cli::maskWarning(mask, "look at it")) {
        settings.warnings.insert(settings.warnings.begin(), std::move(*warning));
    }
    clock.begin(droplet::Stage::Write);
    result.report = cli::describe(made.droplet, settings);
    result.report.onto = std::move(onto);
    result.report.fill_range = settings.droplet.fill_range;
    result.report.input = std::move(made.input);
    result.report.output = cli::describeOutput(made.droplet.surface, "", droplet::Format::Glb);
    result.surface = std::move(made.droplet.surface);
    result.extent = made.droplet.domain.extent;
    result.ground = settings.droplet.solve.ground;
    result.material = settings.material;
    result.unit = settings.unit;
    result.report.time = clock.times();
    result.report.time_total = clock.total();
    result.report.peak_memory = memory();
}

/// Makes maps, as --maps does.
void makeMaps(Result& result, const std::vector<std::string>& arguments)
{
    const cli::ShapeMapOptions options = parse(arguments).maps.value();
    const auto maps = std::make_shared<const droplet::DropletMaps>(droplet::dropletMaps(
        result.surface,
        {.extent = result.extent, .width = options.width, .is_tile = options.is_tile, .ground = result.ground}));
    result.maps.clear();
    for (const cli::OutputFile& file : cli::mapFiles(maps, options, cli::whiteOf(*maps, options))) {
        std::ostringstream out;
        file.write(out);
        result.maps.push_back({file.path, std::move(out).str()});
    }
}

void makeMask(Result& result, const std::vector<std::string>& arguments, const Given& given)
{
    const cli::ShapeOptions options = parse(arguments);
    const droplet::Mask mask = maskOf(given, options.footprint);
    const cli::Surroundings around = cli::readSurroundings(options.settings);
    const droplet::TraceOptions trace = cli::completeSettings(mask, around, options).droplet.trace;
    result.mask = cli::tracedMask(mask, trace);
    result.pixel_size = droplet::pixelSize(mask, trace);
}

void makeDew(Result& result, const std::vector<std::string>& arguments)
{
    const cli::StageClock clock;
    const auto parsed = parseDew(arguments);
    const auto* const options = std::get_if<cli::DewCommandOptions>(&parsed);
    result.dew.emplace(MadeDew{*options, cli::placeDew(*options)});
    result.dew->dew.report.time_total = clock.total();
    result.dew->dew.report.peak_memory = memory();
}

/// Writes a file of a covered object; the options are those of a .glb.
void writeDew(const MadeDew& made, const std::string& name, std::ostream& out)
{
    if (name == "csv") {
        writeTable(out, droplet::TableFormat::Csv, made.dew);
        return;
    }
    droplet::DewFile file = made.options.file;
    file.file.format = droplet::formatNamed(name);
    if (droplet::isAnimated(file.file.format)) {
        file.file.compression =
            file.file.format == droplet::Format::Glb ? file.file.compression : droplet::Compression::None;
        made.dew.model.write(made.dew.object, out, file);
        return;
    }
    droplet::WriteOptions options;
    options.material = file.material;
    writeSurface(surfaceFor(file.file.format, made.dew, made.options.reading), out, file.file.format, options);
}

template <typename Vector>
std::vector<float> floats(const std::vector<Vector>& vectors)
{
    constexpr std::size_t kCount = sizeof(Vector) / sizeof(double);
    std::vector<float> result;
    result.reserve(kCount * vectors.size());
    for (const Vector& v : vectors) {
        result.push_back(static_cast<float>(v.x));
        result.push_back(static_cast<float>(v.y));
        if constexpr (kCount == 3) {
            result.push_back(static_cast<float>(v.z));
        }
    }
    return result;
}

/// Writes a file of droplets, with the object that they lie on if it is wanted.
void writeDroplets(const Result& result, const std::string& name, std::ostream& out)
{
    droplet::WriteOptions options;
    options.material = result.material;
    options.unit = result.unit;
    options.closed = result.report.output.topology.closed;
    const droplet::Format format = droplet::formatNamed(name);
    if (result.object && result.with_object && droplet::isAnimated(format)) {
        writeOnObject(result.surface, droplet::readObjectStand(*result.object, result.reading), out, format, options);
    } else {
        writeSurface(result.surface, out, format, options);
    }
}

/// Calls a function, and keeps what it throws as the result's message.
template <typename Function>
void guarded(Result& result, const Function& function)
{
    try {
        function();
    } catch (const Error& error) {
        result.code = name(error.code());
        result.message = error.what();
    } catch (const std::bad_alloc&) {
        result.code = "OutOfMemory";
        result.message = result.is_dew ? "out of memory; use an object of fewer triangles, or fewer droplets"
                                       : "out of memory; use a smaller mask or fewer --triangles";
    } catch (const std::exception& error) {
        result.code = "Internal";
        result.message = error.what();
    }
}

/// A result that a function fills.
template <typename Function>
Result* resultOf(const Function& fill)
{
    auto result = std::make_unique<Result>();
    guarded(*result, [&] { fill(*result); });
    return result.release();
}

std::span<const std::byte> arrayOf(Result& result, Array array)
{
    const auto kept = [](auto& place, auto numbers) {
        place = std::move(numbers);
        return std::as_bytes(std::span(place));
    };
    if (result.dew && result.surface.vertices.empty()) {
        result.surface = result.dew->dew.model.surface();
    }
    switch (array) {
        case Array::Positions:
            return kept(result.positions, floats(result.surface.vertices));
        case Array::Normals:
            return kept(result.normals, floats(result.surface.normals));
        case Array::Uvs:
            return kept(result.uvs, floats(result.surface.uvs));
        case Array::ContactAngles:
            return std::as_bytes(std::span(result.surface.contact_angle));
        case Array::Triangles:
            return std::as_bytes(std::span(result.surface.triangles));
        case Array::Report:
            guarded(result, [&] {
                std::ostringstream out;
                if (result.dew) {
                    writeDewReport(out, result.dew->dew.report);
                } else {
                    writeReport(out, result.report);
                }
                result.json = std::move(out).str();
            });
            return std::as_bytes(std::span(result.json));
        case Array::File:
            return std::as_bytes(std::span(result.file));
        case Array::Message:
            return std::as_bytes(std::span(result.message));
        case Array::Coverage:
            return std::as_bytes(std::span(result.mask.coverage));
        case Array::Name:
            return std::as_bytes(std::span(result.name));
        case Array::Code:
            break;
    }
    return std::as_bytes(std::span(result.code));
}

/// Arguments that are each ended by a zero byte.
std::vector<std::string> wordsOf(const char* arguments, std::size_t bytes)
{
    std::vector<std::string> words;
    for (const char* word = arguments; word < arguments + bytes; word += words.back().size() + 1) {
        words.emplace_back(word);
    }
    return words;
}

}  // namespace

extern "C" {

/// Makes a droplet.
/// @param arguments  such as `--volume=30uL`, each ended by a zero byte
/// @param mask       bytes of the mask, `kind` as in MaskKind; width and height only if it is not a PNG
EMSCRIPTEN_KEEPALIVE Result* droplet_make(const char* arguments, std::size_t argument_bytes, const std::byte* mask,
                                          std::size_t mask_bytes, int width, int height, int kind)
{
    return resultOf([&](Result& result) {
        make(result, wordsOf(arguments, argument_bytes),
             {{mask, mask_bytes}, width, height, static_cast<MaskKind>(kind)});
    });
}

/// Reads the mask that droplet_make would take.
/// @param arguments  as of droplet_make
EMSCRIPTEN_KEEPALIVE Result* droplet_mask(const char* arguments, std::size_t argument_bytes, const std::byte* mask,
                                          std::size_t mask_bytes, int width, int height, int kind)
{
    return resultOf([&](Result& result) {
        makeMask(result, wordsOf(arguments, argument_bytes),
                 {{mask, mask_bytes}, width, height, static_cast<MaskKind>(kind)});
    });
}

/// Width of the result of droplet_mask [px].
EMSCRIPTEN_KEEPALIVE int droplet_mask_width(const Result* result)
{
    return result->mask.width;
}

/// Size of its pixels [m].
EMSCRIPTEN_KEEPALIVE double droplet_mask_pixel_size(const Result* result)
{
    return result->pixel_size;
}

/// Covers an object with droplets.
/// @param arguments  of `droplet-shape dew`, each ended by a zero byte
EMSCRIPTEN_KEEPALIVE Result* droplet_dew(const char* arguments, std::size_t argument_bytes)
{
    return resultOf([&](Result& result) {
        result.is_dew = true;
        makeDew(result, wordsOf(arguments, argument_bytes));
    });
}

/// Sets how files of droplets are written.
/// @param arguments  those of droplet_make or droplet_dew, with other options of files
EMSCRIPTEN_KEEPALIVE void droplet_form(Result* result, const char* arguments, std::size_t argument_bytes)
{
    result->code.clear();
    result->message.clear();
    guarded(*result, [&] {
        if (!result->dew) {
            result->with_object = parse(wordsOf(arguments, argument_bytes)).settings.with_object;
            return;
        }
        const auto parsed = parseDew(wordsOf(arguments, argument_bytes));
        const auto* const options = std::get_if<cli::DewCommandOptions>(&parsed);
        result->dew->options.file = options->file;
    });
}

/// Makes maps of droplets; returns their number.
/// @param arguments  those of droplet_make, with those of maps
EMSCRIPTEN_KEEPALIVE std::size_t droplet_maps(Result* result, const char* arguments, std::size_t argument_bytes)
{
    result->code.clear();
    result->message.clear();
    guarded(*result, [&] { makeMaps(*result, wordsOf(arguments, argument_bytes)); });
    return result->maps.size();
}

/// Takes one of them, for Array::Name and Array::File.
EMSCRIPTEN_KEEPALIVE void droplet_map(Result* result, std::size_t number)
{
    result->name = std::move(result->maps[number].name);
    result->file = std::move(result->maps[number].bytes);
}

/// Writes a file in a format, for Array::File.
EMSCRIPTEN_KEEPALIVE void droplet_write(Result* result, const char* format)
{
    result->code.clear();
    result->message.clear();
    guarded(*result, [&] {
        std::ostringstream out;
        if (result->dew) {
            writeDew(*result->dew, format, out);
        } else {
            writeDroplets(*result, format, out);
        }
        result->file = std::move(out).str();
    });
}

/// Array of a result: where it begins. It stays until the result is deleted.
EMSCRIPTEN_KEEPALIVE const void* droplet_array(Result* result, int array)
{
    result->given_out = arrayOf(*result, static_cast<Array>(array));
    return result->given_out.data();
}

/// Length of the array that droplet_array gave last [byte].
EMSCRIPTEN_KEEPALIVE std::size_t droplet_array_bytes(const Result* result)
{
    return result->given_out.size();
}

EMSCRIPTEN_KEEPALIVE void droplet_delete(const Result* result)
{
    delete result;
}

/// The options for programs, as --help=json prints them.
EMSCRIPTEN_KEEPALIVE const char* droplet_help()
{
    static const std::string text = [] {
        cli::CommandLine line({"droplet-shape", "", "", ""});
        cli::ShapeOptions options;
        cli::ShapeMapOptions maps;
        declare(line, options, maps);
        return line.helpJson();
    }();
    return text.c_str();
}

/// The options of `droplet-shape dew`, likewise.
EMSCRIPTEN_KEEPALIVE const char* droplet_dew_help()
{
    static const std::string text = std::get<std::string>(parseDew({"--help=json"}));
    return text.c_str();
}

}  // extern "C"

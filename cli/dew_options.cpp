// SPDX-License-Identifier: GPL-3.0-or-later
#include "dew_options.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <set>

#include "command_line.h"
#include "droplet/units.h"
#include "files.h"
#include "force_options.h"
#include "liquid_options.h"
#include "object_options.h"
#include "object_reading.h"
#include "option_values.h"
#include "video_writer.h"

namespace cli {
namespace {

using droplet::DewSizes;
using droplet::Dimension;
using droplet::Vec3;

constexpr Range kRadius{Dimension::Length, 1e-5, 0.02, "from 0.01mm to 20mm"};

/// Named kind of wetness. Radii in metres.
struct Preset {
    const char* name;
    DewSizes sizes;
    double coverage;
    double smallest;
    double largest;
    double median;  ///< of LogNormal
    double spread;  ///< of LogNormal
    bool is_rain;   ///< only where rain from above meets the object
};

// Judged by pictures of objects of a hand's size: docs/cli/dew.md.
constexpr std::array<Preset, 5> kPresets{{{"dew", DewSizes::Condensation, 0.4, 0.2e-3, 1.2e-3, 0.5e-3, 0.5, false},
                                          {"rain", DewSizes::LogNormal, 0.25, 0.2e-3, 3e-3, 0.9e-3, 0.5, true},
                                          {"bottle", DewSizes::Condensation, 0.55, 0.2e-3, 2.5e-3, 0.8e-3, 0.6, false},
                                          {"shower", DewSizes::LogNormal, 0.35, 0.3e-3, 4e-3, 1.2e-3, 0.6, false},
                                          {"mist", DewSizes::LogNormal, 0.2, 0.08e-3, 0.5e-3, 0.15e-3, 0.35, false}}};

const CommandText& commandText()
{
    static const CommandText text{"droplet-shape dew", "cover an object with droplets that rest on it",
                                  "[OPTIONS] OBJECT OUTPUT",
                                  "Quantities carry a unit:\n"
                                  "  lengths nm um mm cm m in; angles deg rad; surface tension mN/m N/m dyn/cm;\n"
                                  "  density kg/m3 g/cm3 g/mL; acceleration m/s2 mm/s2 g; viscosity mPa.s Pa.s\n"
                                  "Vectors x,y,z are in the frame of the object's file, +Y up.\n"
                                  "\n"
                                  "Examples:\n"
                                  "  droplet-shape dew leaf.glb wet.glb\n"
                                  "  droplet-shape dew bottle.glb cold.glb --preset bottle --object-size 12cm\n"
                                  "  droplet-shape dew leaf.glb rain.obj --preset rain --coverage 0.3 --largest 2mm\n"
                                  "  droplet-shape dew leaf.glb wet.usdz --preset mist --droplets drops.csv\n"
                                  "  droplet-shape dew leaf.glb wet.glb --preview wet.png --camera 20deg,40deg\n"
                                  "\n"
                                  "Exit codes:\n"
                                  "  0 done; 1 internal error; 2 usage; 3 input unreadable, or no place for\n"
                                  "  droplets; 4 output cannot be written"};
    return text;
}

void declare(CommandLine& line, DewCommandOptions& options)
{
    droplet::DewOptions& dew = options.dew;
    line.addArgument("OBJECT", "Mesh to wet: .glb, .gltf, .obj, .ply or .stl; OBJ and STL in millimetres");
    line.addArgument("OUTPUT",
                     "Object and droplets, .glb, .gltf, .usda or .usdz; or the droplets alone, .obj, .ply or .stl");
    constexpr const char* kObject = "Object";
    declareReading(line, kObject, options.reading);
    constexpr const char* kDroplets = "Droplets";
    line.add(kDroplets, "--preset", wordsOf(kPresets, &Preset::name).c_str(),
             "Kind of wetness: dew in the morning, fresh rain, a cold bottle, after a shower, fine mist; the other "
             "options of this group change it [dew]");
    line.add(kDroplets, "--coverage", "NUMBER", "Share of the surface below droplets, 0.001 to 0.7 [by preset]",
             within(1e-3, 0.7));
    line.add(kDroplets, "--smallest", "LENGTH", "Radius of the smallest droplets seen from above [by preset]",
             within(kRadius));
    line.add(kDroplets, "--largest", "LENGTH",
             "Radius of the largest droplets seen from above, before some join [by preset]", within(kRadius));
    line.add(kDroplets, "--sizes", "condensation|lognormal",
             "Numbers of droplets by radius r: condensation is r to the power of -8/3, lognormal has a median and a "
             "spread [by preset]");
    line.add(kDroplets, "--median", "LENGTH", "Median of the radii, lognormal [by preset]", within(kRadius));
    line.add(kDroplets, "--spread", "NUMBER", "Standard deviation of their logarithm, lognormal, 0 to 3 [by preset]",
             within(0.0, 3.0));
    line.add(kDroplets, "--from", "X,Y,Z",
             "Direction that rain comes from; droplets are then only where it meets the object [of rain 0,1,0]");
    line.add(kDroplets, "--mask", "FILE",
             "Mask over the object's texture coordinates: droplets are where it is covered", into(options.mask));
    line.addFlag(
        kDroplets, "--vertex-weights",
        "Droplets are where the vertices have weights: _WEIGHT or the red of COLOR_0 of glTF, weight or red of "
        "PLY");
    line.exclude({"--mask", "--vertex-weights"});
    line.addFlag(kDroplets, "--inside", "Droplets also on inner sides, which see less than a tenth of the outside");
    line.add(kDroplets, "--seed", "N", "Random seed", seedInto(dew.seed));
    constexpr const char* kHold = "Slopes";
    line.add(kHold, "--hysteresis", "NUMBER",
             "Contact angle hysteresis: cosine of the receding minus cosine of the advancing angle; it holds droplets",
             into(dew.forces.wetting.hysteresis, {0.0, 2.0, "a number from 0 to 2"}));
    declarePinning(line, kHold, dew.pinning);
    line.add(kHold, "--gravity-direction", "X,Y,Z", "Direction of gravity [0,-1,0]");
    declareForces(line, dew.forces);
    constexpr const char* kOut = "Output";
    line.add(kOut, "--detail", "Triangles of droplets: medium has 64 of small ones to 352 of large ones",
             into(options.detail, {{"low", droplet::DewDetail::Low},
                                   {"medium", droplet::DewDetail::Medium},
                                   {"high", droplet::DewDetail::High}}));
    declareMaterial(line, kOut, "Look of the droplets [by liquid]");
    line.add(
        kOut, "--instancing",
        "auto is one mesh up to 20000 droplets; none one mesh; nodes a node for each droplet, with shared meshes; gpu "
        "EXT_mesh_gpu_instancing, for glTF",
        into(options.file.instancing, {{"auto", droplet::Instancing::Auto},
                                       {"none", droplet::Instancing::None},
                                       {"nodes", droplet::Instancing::Nodes},
                                       {"gpu", droplet::Instancing::Gpu}}));
    declareDropletsOnly(line, kOut);
    declareCompression(line, kOut);
    line.add(kOut, "--droplets", "FILE", "Write a table of all droplets, .csv or .json; flow can start with the .csv",
             into(options.droplets));
    line.add(kOut, "--json", "FILE", "Write a report; - is standard output", into(options.json));
    line.add("Picture", "--preview", "FILE",
             "Write a rendered picture of object and droplets, as PNG; with --turntable also a video");
    declareView(line);
    declareEnvironment(line);
    declareTurntable(line);
    constexpr const char* kRun = "Run";
    line.addFlag(kRun, "--no-clobber", "Do not replace existing files");
    declareStageProgress(line, kRun, "while droplets are placed");
    declareCommon(line, kRun, "coverage = 0.3");
}

void readDroplets(const CommandLine& line, DewCommandOptions& options)
{
    droplet::DewOptions& dew = options.dew;
    const auto named = line.value("--preset");
    const auto* const preset = std::find_if(kPresets.begin(), kPresets.end(), [&](const Preset& one) {
        return one.name == (named ? named->text : std::string("dew"));
    });
    if (preset == kPresets.end()) {
        refuse(*named, wordsOf(kPresets, &Preset::name));
    }
    options.preset = preset->name;
    options.reading.weights = line.flag("--vertex-weights");
    dew.inside = line.flag("--inside");
    dew.sizes = preset->sizes;
    if (const auto sizes = line.value("--sizes")) {
        if (sizes->text != "condensation" && sizes->text != "lognormal") {
            refuse(*sizes, "condensation or lognormal");
        }
        dew.sizes = sizes->text == "lognormal" ? DewSizes::LogNormal : DewSizes::Condensation;
    }
    const auto length_or = [&](const char* option, double otherwise) {
        const auto given = line.value(option);
        return given ? quantity(*given, kRadius) : otherwise;
    };
    dew.smallest = length_or("--smallest", preset->smallest);
    dew.largest = length_or("--largest", preset->largest);
    if (const auto smallest = line.value("--smallest"); smallest && dew.largest < dew.smallest) {
        const auto largest = line.value("--largest");
        refuse(*smallest,
               "at most --largest, " + (largest ? largest->text
                                                : fmt::format("which is {:g}mm by --preset {}; give --largest, too",
                                                              preset->largest / droplet::kMillimetre, preset->name)));
    }
    if (dew.largest < dew.smallest) {
        dew.smallest = dew.largest * preset->smallest / preset->largest;
    }
    dew.median = length_or("--median", std::clamp(preset->median, dew.smallest, dew.largest));
    const auto number_or = [&](const char* option, const NumberRange& range, double otherwise) {
        const auto given = line.value(option);
        return given ? number(*given, range) : otherwise;
    };
    dew.spread = number_or("--spread", {0.0, 3.0, "a number from 0 to 3"}, preset->spread);
    dew.coverage = number_or("--coverage", {1e-3, 0.7, "a number from 0.001 to 0.7"}, preset->coverage);
    for (const char* option : {"--median", "--spread"}) {
        if (line.value(option) && dew.sizes != DewSizes::LogNormal) {
            refuse(std::string(option) + " needs --sizes lognormal");
        }
    }
    if (const auto from = line.value("--from")) {
        dew.from = direction(*from);
    } else if (preset->is_rain) {
        dew.from = Vec3{0.0, 0.0, 1.0};
    }
    readForces(line, dew.forces);
    const auto down = line.value("--gravity-direction");
    dew.gravity = dew.forces.gravity * (down ? direction(*down) : Vec3{0.0, 0.0, -1.0});
}

void readDewPreview(const CommandLine& line, DewCommandOptions& options)
{
    PreviewOptions preview;
    const bool has_preview = readPreviewFile(line, preview);
    for (const char* option : {"--view", "--camera", "--look-at", "--environment", "--preview-size", "--turntable"}) {
        if (line.value(option) && !has_preview) {
            refuse(std::string(option) + " needs --preview");
        }
    }
    preview.sees_below = true;
    readView(line, preview);
    if (const auto light = line.value("--environment")) {
        preview.environment = light->text;
    }
    const bool is_video = has_preview && isVideo(preview.path);
    preview.encoding = readVideoEncoding(line, is_video, "--preview or --turntable");
    if (is_video) {
        requireEvenSides("--preview-size", preview.width, preview.height);
    }
    if (has_preview) {
        options.preview = preview;
    }
}

void readOutput(const CommandLine& line, DewCommandOptions& options)
{
    options.object = line.argument("OBJECT");
    options.output = line.argument("OUTPUT");
    const std::string extension = lowerExtension(options.output);
    if (!std::set<std::string>{".glb", ".gltf", ".obj", ".ply", ".stl", ".usda", ".usdz"}.contains(extension)) {
        refuse({options.output, "OUTPUT"}, "a file that ends in .glb, .gltf, .usda, .usdz, .obj, .ply or .stl");
    }
    const droplet::Format format = droplet::formatNamed(extension.substr(1));
    options.file.file = {format, readCompression(line, format)};
    options.file.has_object = hasObject(line, format, options.output);
    if (line.value("--instancing") && !droplet::isAnimated(format)) {
        refuse("--instancing needs a .glb, .gltf, .usda or .usdz as OUTPUT, not '" + options.output + "'");
    }
    if (options.file.instancing == droplet::Instancing::Gpu && format != droplet::Format::Glb &&
        format != droplet::Format::Gltf) {
        refuse("--instancing gpu needs a .glb or .gltf as OUTPUT, not '" + options.output + "'");
    }
    options.file.material = droplet::materialOf(options.dew.forces.liquid);
    if (const auto material = line.value("--material")) {
        options.file.material = forOption("--material", [&] { return droplet::materialNamed(material->text); });
    }
    if (options.droplets) {
        const std::string ending = lowerExtension(*options.droplets);
        if (ending != ".csv" && ending != ".json") {
            refuse({*options.droplets, "--droplets"}, "a file that ends in .csv or .json");
        }
    }
}

}  // namespace

std::variant<DewCommandOptions, std::string> parseDew(int argc, const char* const* argv)
{
    CommandLine line(commandText());
    DewCommandOptions options;
    declare(line, options);
    line.parse(argc, argv);
    if (const auto text = requestedText(line)) {
        return *text;
    }
    line.read();
    readDroplets(line, options);
    readOutput(line, options);
    readDewPreview(line, options);
    options.run = readRun(line);
    return options;
}

}  // namespace cli

// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet_options.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "droplet/colours/colour_regions.h"
#include "droplet/error.h"
#include "droplet/io/read_surface.h"
#include "droplet/liquid.h"
#include "droplet/units.h"
#include "droplet/wetting.h"
#include "files.h"
#include "liquid_options.h"
#include "object_reading.h"

namespace cli {
namespace {

using droplet::Dimension;

constexpr Range kArea{Dimension::Area, 0.0, 1e6, "from 0mm2 to 1e6m2"};
constexpr Range kVolume{Dimension::Volume, 1e-27, 1e9, "from 1e-18uL to 1e9m3"};
// At 180° liquid touches the ground all around, and does not stay in place.
constexpr Range kAngle{Dimension::Angle, 1e-3 * droplet::kDegree, 179.0 * droplet::kDegree, "from 0.001deg to 179deg"};
constexpr Range kDensity{Dimension::Density, 0.0, 1e6, "from 0kg/m3 to 1e6kg/m3"};
constexpr Range kGravity{Dimension::Acceleration, -1e6, 1e6, "from -1e6m/s2 to 1e6m/s2"};
constexpr Range kHalfTurn{Dimension::Angle, 0.0, std::numbers::pi, "from 0deg to 180deg"};
constexpr NumberRange kThreshold{std::numeric_limits<double>::denorm_min(),
                                 1.0 - 0.5 * std::numeric_limits<double>::epsilon(),
                                 "a number over 0 and under 1, such as 0.5"};
constexpr NumberRange kSpeckSize{0.0, std::numeric_limits<double>::max(), "a number of square pixels, at least 0"};
constexpr Range kDirection{Dimension::Angle, -2 * std::numbers::pi, 2 * std::numbers::pi, "from -360deg to 360deg"};

/// Contact angle that a liquid takes by itself on what it lies on.
double naturalAngle(const CommandLine& line, const Given& given, const droplet::Liquid& liquid)
{
    using droplet::Solid;
    Solid solid = Solid::Glass;
    if (const auto on = line.value("--on")) {
        solid = choice<Solid>(
            *on, {{"glass", Solid::Glass}, {"ptfe", Solid::Ptfe}, {"wax", Solid::Wax}, {"lotus", Solid::Lotus}});
    }
    const std::optional<double> angle = droplet::naturalContactAngle(liquid.name, solid);
    const std::string pair = liquid.name + " on " + droplet::name(solid);
    if (!angle) {
        refuse(given, "an angle: that of " + pair + " is not known");
    }
    if (*angle == 0.0) {
        refuse(given, "an angle: " + pair + " spreads, and is no droplet");
    }
    return *angle;
}

void readAmount(const CommandLine& line, DropletSettings& settings)
{
    auto& solve = settings.droplet.solve;
    if (const auto volume = line.value("--volume")) {
        solve.fill.by = droplet::FillBy::Volume;
        solve.fill.amount = quantity(*volume, kVolume);
    }
    if (const auto height = line.value("--height")) {
        solve.fill.by = droplet::FillBy::Height;
        solve.fill.amount = quantity(*height, kLength);
    }
    readLiquidProperties(line, kDensity, solve.liquid);
    const auto angle = line.value("--contact-angle");
    const bool is_natural = angle && angle->text == "natural";
    if (angle) {
        solve.fill.by = droplet::FillBy::ContactAngle;
        solve.fill.amount = is_natural ? naturalAngle(line, *angle, solve.liquid) : quantity(*angle, kAngle);
    }
    if (line.value("--on") && !is_natural) {
        settings.warnings.push_back("--on has no effect without --contact-angle natural");
    }
    const bool is_default = !angle && !line.value("--volume") && !line.value("--height");
    settings.droplet.allow_less = is_default || is_natural;
    solve.fill.below_puddle = is_default;
    if (angle && solve.model == droplet::Model::Linear && solve.fill.amount >= 0.5 * std::numbers::pi) {
        refuse(*angle, "below 90deg with --model linear; use --model auto");
    }
}

void readGravity(const CommandLine& line, DropletSettings& settings)
{
    auto& solve = settings.droplet.solve;
    if (solve.tilt > 0.0 && solve.gravity == 0.0) {
        settings.warnings.push_back("--tilt has no effect: there is no gravity");
    }
    if (line.value("--tilt-direction") && (solve.tilt == 0.0 || solve.tilt == kHalfTurn.max)) {
        settings.warnings.push_back("--tilt-direction has no effect: level ground has no downhill direction");
    }
}

void readHysteresis(const CommandLine& line, DropletSettings& settings)
{
    const auto advancing = line.value("--advancing");
    const auto receding = line.value("--receding");
    if (!advancing && !receding) {
        return;
    }
    if (!advancing || !receding) {
        refuse(std::string("--advancing and --receding belong together, ") +
               (advancing ? "--receding" : "--advancing") + " is missing");
    }
    droplet::Hysteresis hysteresis;
    hysteresis.advancing = quantity(*advancing, kHalfTurn);
    hysteresis.receding = quantity(*receding, kHalfTurn);
    if (hysteresis.receding > hysteresis.advancing) {
        refuse(*receding, "at most --advancing, '" + advancing->text + "'");
    }
    settings.hysteresis = hysteresis;
}

/// Reads the options that separate liquid from dry and clean the mask.
void readSegment(const CommandLine& line, FootprintOptions& options)
{
    const auto segment = line.value("--segment");
    const auto channel = line.value("--channel");
    if (segment && channel && channel->text == "alpha" && (segment->text == "adaptive" || segment->text == "grabcut")) {
        refuse("--segment " + segment->text +
               " and --channel alpha exclude each other: alpha already separates liquid from dry");
    }
    options.mask.accept_any = line.value("--threshold").has_value();
    const auto colour = line.value("--colour");
    if (colour) {
        if (segment) {
            refuse("--segment and --colour exclude each other, give one of them");
        }
        options.mask.colour = forOption(colour->subject, [&] { return droplet::parseCssColour(colour->text); });
    }
}

constexpr const char* kGroundForms =
    "a height map's file, sphere:R=LENGTH or cylinder:R=LENGTH,axis=ANGLE, where axis may also be x or y";

/// Values of a list such as `R=33mm,axis=y`, in the order of `keys`. The list must contain every key once.
std::vector<Given> partsOf(const Given& given, std::string_view list, const std::vector<std::string>& keys)
{
    std::vector<std::optional<std::string>> values(keys.size());
    for (bool last = false; !last;) {
        const std::string_view part = list.substr(0, list.find(','));
        last = part.size() == list.size();
        list.remove_prefix(last ? list.size() : part.size() + 1);
        const auto equals = part.find('=');
        const auto key =
            static_cast<std::size_t>(std::find(keys.begin(), keys.end(), part.substr(0, equals)) - keys.begin());
        if (equals == std::string_view::npos || key == keys.size() || values[key]) {
            refuse(given, kGroundForms);
        }
        values[key] = part.substr(equals + 1);
    }
    std::vector<Given> parts;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (!values[i]) {
            refuse(given, kGroundForms);
        }
        parts.push_back({*values[i], given.subject + ": " + keys[i]});
    }
    return parts;
}

/// Parses a radius, which is negative for a bowl or gutter.
double radius(const Given& given)
{
    constexpr Range kRadius{Dimension::Length, -kLength.max, kLength.max, "from 1nm to 1000m, or from -1000m to -1nm"};
    const double value = quantity(given, kRadius);
    if (std::abs(value) < kLength.min) {
        refuse(given, kRadius.allowed);
    }
    return value;
}

double axis(const Given& given)
{
    if (given.text == "x" || given.text == "y") {
        return given.text == "x" ? 0.0 : 0.5 * std::numbers::pi;
    }
    return quantity(given, kDirection);
}

/// Whether a text has the form `word:…=…`, so that it is a ground, perhaps misspelt, and not the name of a file.
bool describesGround(std::string_view text)
{
    const auto colon = text.find(':');
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const std::string_view word = text.substr(0, colon);
    return word == "sphere" || word == "cylinder" ||
           (colon != std::string_view::npos && text.find('=', colon) != std::string_view::npos &&
            std::all_of(word.begin(), word.end(), is_letter));
}

droplet::GroundReport groundOf(const Given& given)
{
    const std::string_view text = given.text;
    const std::string_view kind = text.substr(0, text.find(':'));
    const std::string_view list = text.substr(std::min(text.size(), kind.size() + 1));
    droplet::GroundReport ground;
    if (text.empty()) {
        refuse(given, kGroundForms);
    }
    if (!describesGround(text)) {
        ground.kind = droplet::GroundKind::HeightMap;
        ground.path = given.text;
    } else if (kind == "sphere") {
        ground.kind = droplet::GroundKind::Sphere;
        ground.radius = radius(partsOf(given, list, {"R"})[0]);
    } else if (kind == "cylinder") {
        const auto parts = partsOf(given, list, {"R", "axis"});
        ground.kind = droplet::GroundKind::Cylinder;
        ground.radius = radius(parts[0]);
        ground.axis = axis(parts[1]);
    } else {
        refuse(given, kGroundForms);
    }
    return ground;
}

void readGround(const CommandLine& line, DropletSettings& settings)
{
    auto& solve = settings.droplet.solve;
    if (const auto surface = line.value("--surface")) {
        settings.ground = groundOf(*surface);
    }
    if (const auto onto = line.value("--onto")) {
        const bool has_uv = [&] {
            try {
                return droplet::readableFormat(onto->text) != droplet::Format::Stl;
            } catch (const droplet::Error&) {
                return false;
            }
        }();
        if (!has_uv) {
            refuse(*onto, "a .glb, .gltf, .obj or .ply, whose uv place the droplets; dew and flow take an .stl");
        }
    }
    for (const char* option : {"--scale", "--object-size", "--up"}) {
        if (line.value(option) && !line.value("--onto")) {
            settings.warnings.push_back(std::string(option) + " has no effect without --onto");
        }
    }
    if (const auto depth = line.value("--surface-depth")) {
        settings.ground.depth = quantity(*depth, kLength);
        if (settings.ground.kind != droplet::GroundKind::HeightMap) {
            settings.ground.depth.reset();
            settings.warnings.push_back("--surface-depth has no effect: the ground is no height map");
        }
    }
    const bool pulled_down = solve.gravity >= 0.0 && solve.tilt == 0.0;
    if (solve.no_penetration && pulled_down && settings.ground.kind == droplet::GroundKind::Flat) {
        settings.warnings.push_back("--no-penetration has no effect: on level flat ground the liquid stays above it");
    }
}

void readSurface(const CommandLine& line, DropletSettings& settings)
{
    const auto material = line.value("--material");
    settings.material = material ? forOption(material->subject, [&] { return droplet::materialNamed(material->text); })
                                 : droplet::materialOf(settings.droplet.solve.liquid);
    if (const auto solver = line.value("--solver")) {
        if (solver->text == "cholmod") {
            refuse(solver->subject + ": 'cholmod' is no longer built in; llt factorises the same matrix");
        }
        settings.droplet.solve.solver = choice<droplet::Solver>(*solver, {{"auto", droplet::Solver::Auto},
                                                                          {"llt", droplet::Solver::Llt},
                                                                          {"multigrid", droplet::Solver::Multigrid}});
    }
}

}  // namespace

void declareFootprint(CommandLine& line, FootprintOptions& options)
{
    using droplet::Channel;
    using droplet::Segmentation;
    droplet::TraceOptions& trace = options.trace;
    constexpr const char* kGroup = "Footprint";
    line.add(kGroup, "--width", "LENGTH", "Width of the picture; an SVG may state its own", into(trace.width, kLength));
    line.add(kGroup, "--pixel-size", "LENGTH", "Size of one pixel, instead of --width",
             into(trace.pixel_size, kLength));
    line.add(kGroup, "--channel",
             "Channel that shows the liquid: auto takes alpha if the picture has transparent parts, else what differs "
             "from the brightness of its border",
             into(options.mask.channel, {{"auto", Channel::Auto}, {"alpha", Channel::Alpha}, {"luma", Channel::Luma}}));
    line.add(kGroup, "--threshold", "F", "Coverage at which liquid begins, between 0 and 1",
             into(trace.threshold, kThreshold));
    line.addFlag(kGroup, "--invert", "Exchange liquid and dry", options.mask.invert);
    line.add(kGroup, "--segment",
             "How to separate liquid from dry: threshold for drawings and scans, adaptive for photographs in uneven "
             "light, grabcut by colour; auto chooses and reports its choice",
             into(options.mask.segment, {{"auto", Segmentation::Auto},
                                         {"threshold", Segmentation::Threshold},
                                         {"adaptive", Segmentation::Adaptive},
                                         {"grabcut", Segmentation::GrabCut}}));
    line.add(kGroup, "--colour", "COLOUR", "Take the regions of this colour, such as red or #e30613");
    line.add(kGroup, "--smooth", "LENGTH", "Remove spots, and bends of the rim, that are narrower than this",
             withoutDefault(into(trace.clean.smooth, kLength)));
    line.add(kGroup, "--fill-holes", "AREA", "Fill holes smaller than this, such as glints: 1mm2",
             withoutDefault(into(trace.clean.fill_holes, kArea)));
    line.add(kGroup, "--keep", "N", "Keep only the N largest droplets",
             into(trace.clean.keep, CountRange{1, 1'000'000, "1M"}));
    line.add(kGroup, "--speck-size", "F", "Drop spots and holes smaller than F square pixels",
             into(trace.speck_size, kSpeckSize));
    line.exclude({"--width", "--pixel-size"});
}

void declareGap(CommandLine& line, const char* group)
{
    line.add(group, "--gap", "LENGTH", "Dry width between neighbours for --by-colour [none]", within(kLength));
}

void declareByColour(CommandLine& line)
{
    constexpr const char* kGroup = "Footprint";
    line.addFlag(
        kGroup, "--by-colour",
        "Make one droplet for each region of one colour, in that colour; neighbours share their boundary. Dry is "
        "what is transparent, else the border's colour if 95 % of the border has it; --channel alpha: only what "
        "is transparent; --channel luma: the border's most common colour");
    line.add(kGroup, "--colours", "K|auto", "Number of colours for --by-colour, 1 to 64 [auto]",
             within(1, droplet::kMaxColours));
    declareGap(line, kGroup);
    for (const char* other :
         {"--segment", "--colour", "--threshold", "--invert", "--smooth", "--fill-holes", "--keep"}) {
        if (line.knows(other)) {
            line.exclude({"--by-colour", other});
        }
    }
}

void declareSeeds(CommandLine& line, FootprintOptions& options)
{
    line.add(
        "Footprint", "--seeds", "FILE",
        "Strokes on the picture, in a picture of its size: light ones on liquid, dark ones on dry ground, the rest "
        "transparent or grey; for clear droplets, whose rims are then found between them",
        into(options.seeds));
    for (const char* other : {"--segment", "--colour", "--channel", "--by-colour"}) {
        line.exclude({"--seeds", other});
    }
}

void declareMaskOut(CommandLine& line)
{
    if (line.knows("--by-colour")) {
        line.exclude({"--by-colour", "--mask-out"});
    }
    line.add("Footprint", "--mask-out", "FILE", "Write the mask that was used, as PNG; - is standard output");
}

void declareLiquid(CommandLine& line, DropletSettings& settings)
{
    droplet::SolveOptions& solve = settings.droplet.solve;
    constexpr const char* kGroup = "Liquid";
    line.add(
        kGroup, "--contact-angle", "ANGLE",
        "Amount of liquid, by the mean contact angle along the rim, up to 179deg; natural: that of the liquid on "
        "what it lies on. By default no droplet is higher than a puddle of 40deg; by default and with natural, the "
        "largest angle that exists is taken if that one does not [" +
            quantityText(solve.fill.amount, Dimension::Angle) + "]",
        within(kAngle));
    line.add(kGroup, "--on", "glass|ptfe|wax|lotus", "What the liquid lies on, for --contact-angle natural [glass]");
    line.add(kGroup, "--volume", "VOLUME", "Amount of liquid, by its volume", within(kVolume));
    line.add(kGroup, "--height", "LENGTH",
             "Amount of liquid, by its largest height; if two droplets have it, the one with less liquid",
             within(kLength));
    const bool is_sequence = line.knows("--volume-mode");
    line.add(kGroup, "--fill",
             std::string("each: every droplet gets this amount; total: all droplets share it at one pressure") +
                 (is_sequence ? " [total with --volume-mode total, else each]" : ""),
             into(solve.fill.sharing, {{"each", droplet::FillSharing::Each}, {"total", droplet::FillSharing::Total}}));
    declareLiquidProperties(line, kGroup, kDensity);
    line.add(
        kGroup, "--model",
        "Model of the surface's area: linear is within 1 % up to 5 to 8deg, exact for all slopes, also where liquid "
        "hangs over its rim; auto takes linear where it is within 0.3 %",
        into(solve.model,
             {{"auto", droplet::Model::Auto}, {"linear", droplet::Model::Linear}, {"exact", droplet::Model::Exact}}));
    line.exclude({"--contact-angle", "--volume", "--height"});
}

void declareGround(CommandLine& line, DropletSettings& settings)
{
    droplet::SolveOptions& solve = settings.droplet.solve;
    constexpr const char* kGroup = "Gravity and ground";
    line.add(kGroup, "--gravity", "G", "Gravity into the ground; negative under a ceiling",
             into(solve.gravity, kGravity));
    line.add(kGroup, "--tilt", "ANGLE", "Tilt of the ground: 90deg is a wall, 180deg a ceiling",
             into(solve.tilt, kHalfTurn));
    line.add(kGroup, "--tilt-direction", "ANGLE",
             "Direction of downhill, counter-clockwise from the picture's right; -90deg is its lower edge",
             into(solve.tilt_direction, kDirection));
    line.add(kGroup, "--surface", "GROUND",
             "Curved ground: a height map's file, white is high; sphere:R=40mm; or cylinder:R=33mm,axis=y, with axis "
             "x, y or an angle; R < 0 is a bowl or a gutter [flat]");
    line.add(
        kGroup, "--surface-depth", "LENGTH",
        "Height of white above black in the height map; samples that are floating-point numbers are metres without it",
        within(kLength));
    line.addFlag(kGroup, "--no-penetration",
                 "Keep the liquid above the ground; where it would sink in, the ground stays dry",
                 solve.no_penetration);
    line.add(kGroup, "--onto", "OBJECT",
             "Lay the droplets on the object in a .glb, .gltf, .obj or .ply file by its texture coordinates; a .glb, "
             ".gltf, .usda or .usdz has the object with them, other formats the droplets alone",
             into(settings.onto));
    declareReading(line, kGroup, settings.reading, "With --onto: ");
    line.add(kGroup, "--advancing", "ANGLE",
             "Advancing contact angle; with --receding the report says whether droplets slide", within(kHalfTurn));
    line.add(kGroup, "--receding", "ANGLE", "Receding contact angle, at most --advancing", within(kHalfTurn));
    line.exclude({"--surface", "--onto"});
}

void declareSurface(CommandLine& line, DropletSettings& settings)
{
    using droplet::LengthUnit;
    droplet::TriangulateOptions& mesh = settings.droplet.mesh;
    constexpr const char* kGroup = "Surface";
    line.add(kGroup, "--triangles", "N", "Number of triangles of the liquid's surface, within 10 %: 5000, 5k, 1M",
             into(mesh.triangles, {1, kMaxTriangles, "100M, such as 5000, 5k or 1M"}));
    line.add(kGroup, "--edge", "LENGTH", "Edge length of the triangles, instead of --triangles",
             into(mesh.edge, kLength));
    line.add(
        kGroup, "--grading",
        "Largest edge length far from the rim, as a multiple of the length at the rim; auto: 1, or 64 in puddles "
        "where gravity flattens all but the rim",
        into(mesh.grading,
             {{"auto", std::nullopt}, {"1", 1}, {"2", 2}, {"4", 4}, {"8", 8}, {"16", 16}, {"32", 32}, {"64", 64}}));
    line.addFlag(kGroup, "--open", "Leave out the base", settings.droplet.open);
    declareMaterial(line, kGroup,
                    "Look in glTF, OBJ, USD, previews and the page; does not change the shape [the liquid's own]");
    line.add(kGroup, "--unit", "Unit of length in OBJ and STL",
             into(settings.unit,
                  {{"m", LengthUnit::Metre}, {"cm", LengthUnit::Centimetre}, {"mm", LengthUnit::Millimetre}}));
    line.exclude({"--triangles", "--edge"});
}

void declareRun(CommandLine& line)
{
    constexpr const char* kGroup = "Run";
    line.addFlag(kGroup, "--no-clobber", "Do not replace existing files");
    line.add(kGroup, "--solver", "auto|llt|multigrid",
             "Solver of the linear system: llt is Eigen's factorisation, multigrid iterates; auto takes llt for "
             "linear models of up to 25,000 unknowns and for small or irregular meshes [auto]");
    line.add(kGroup, "-j,--threads", "N", "Maximum number of threads [all cores]", within(1, kMaxThreads));
    line.addFlag(kGroup, "-q,--quiet", "Print only errors, and warnings of results that cannot be right");
    line.addFlag(kGroup, "-v,--verbose", "Print more: every droplet, times, memory");
    declareStageProgress(line, kGroup, "of a long solve");
    line.add(kGroup, "--config", "FILE",
             "Read options from a TOML file with lines such as width = \"8cm\"; the command line takes precedence");
    line.addFlag(kGroup, "-h,--help", "Print this help; --help=json prints it for programs");
    line.addFlag(kGroup, "--version", "Print the version");
    line.exclude({"--quiet", "--verbose"});
}

void readFootprint(const CommandLine& line, FootprintOptions& options)
{
    options.sized = line.value("--width") || line.value("--pixel-size");
    readSegment(line, options);
}

std::optional<ByColourOptions> readByColour(const CommandLine& line, std::vector<std::string>& warnings)
{
    const auto given = [&](const char* name) { return line.knows(name) ? line.value(name) : std::nullopt; };
    ByColourOptions options;
    if (const auto colours = given("--colours"); colours && colours->text != "auto") {
        options.colours = count(*colours, {1, droplet::kMaxColours, "64, or auto"});
    }
    if (const auto gap = given("--gap")) {
        options.gap = quantity(*gap, kLength);
    }
    if (line.flag("--by-colour")) {
        return options;
    }
    for (const char* name : {"--colours", "--gap", "--palette", "--text-colour"}) {
        if (const auto useless = given(name)) {
            warnings.push_back(useless->subject + " has no effect without --by-colour");
        }
    }
    return std::nullopt;
}

void readDroplet(const CommandLine& line, DropletSettings& settings)
{
    readAmount(line, settings);
    readGravity(line, settings);
    readHysteresis(line, settings);
    readGround(line, settings);
    readSurface(line, settings);
}

void warnOfFormat(const CommandLine& line, droplet::Format format, bool is_shown, DropletSettings& settings)
{
    const auto warn = [&](const Given& given, const std::string& why) {
        settings.warnings.push_back(given.subject + " " + given.text + " has no effect: " + droplet::name(format) +
                                    " files " + why);
    };
    const bool has_unit = format == droplet::Format::Obj || format == droplet::Format::Stl;
    const bool has_material = format != droplet::Format::Ply && format != droplet::Format::Stl;
    if (const auto material = line.value("--material"); material && !has_material && !is_shown) {
        warn(*material, "have no material");
    }
    if (const auto unit = line.value("--unit"); unit && !has_unit) {
        warn(*unit, format == droplet::Format::ThreeMf ? "are in millimetres" : "are in metres");
    }
    // On a plate, droplets of several looks and droplets by name are bodies of their own in every format.
    const auto warn_of_parts = [&](const Given& given, bool has_parts, const std::string& why) {
        if (!has_parts && !settings.base) {
            warn(given, why);
        }
    };
    if (settings.materials) {
        warn_of_parts({settings.materials->path, "--materials"}, has_material || is_shown, "have no material");
    }
    const bool is_gltf = format == droplet::Format::Glb || format == droplet::Format::Gltf;
    const bool is_usd = format == droplet::Format::Usda || format == droplet::Format::Usdz;
    if (settings.colour_map && !is_gltf && format != droplet::Format::Usdz && !is_shown) {
        settings.warnings.push_back(std::string("--colour-map has no effect: ") + droplet::name(format) +
                                    " files have no texture" + (is_usd ? "; usdz files have one" : ""));
    }
    if (settings.droplet.mesh.quads && !droplet::hasQuads(format)) {
        settings.warnings.push_back(std::string("--quads: ") + droplet::name(format) +
                                    " files hold triangles alone, here the halves; obj, ply and usda files hold "
                                    "quadrilaterals");
    }
    if (settings.nodes == droplet::Nodes::Each) {
        warn_of_parts({"each", "--nodes"}, is_gltf || is_usd || format == droplet::Format::ThreeMf, "have no nodes");
    }
}

}  // namespace cli

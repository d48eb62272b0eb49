// SPDX-License-Identifier: GPL-3.0-or-later
//
// CLI11 splits the command line and lays out the help; what values mean and how a refusal reads is decided here.
#include "shape_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <numeric>
#include <string_view>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "config_file.h"
#include "droplet/error.h"
#include "droplet/liquid.h"
#include "droplet/units.h"
#include "droplet/version.h"

namespace cli {
namespace {

using droplet::Dimension;

[[noreturn]] void refuse(const std::string& message)
{
    throw droplet::Error(droplet::ErrorCode::InvalidArgument, message);
}

/// An option's value as text, and how to call the option in a message.
struct Given {
    std::string text;
    std::string subject;
};

[[noreturn]] void refuse(const Given& given, const std::string& constraint)
{
    refuse(given.subject + ": '" + given.text + "' must be " + constraint);
}

/// Runs a function of the library and puts the option's name before its complaint.
template <typename Function>
auto forOption(const std::string& subject, Function function)
{
    try {
        return function();
    } catch (const droplet::Error& error) {
        throw droplet::Error(error.code(), subject + ": " + error.what());
    }
}

/// What a quantity may be. Beyond these bounds a droplet is no droplet, and squares and single-precision files
/// overflow; the words are what a message says.
struct Range {
    Dimension dimension;
    double min;
    double max;
    const char* words;
};

constexpr Range kLength{Dimension::Length, 1e-9, 1e3, "from 1nm to 1000m"};
constexpr Range kVolume{Dimension::Volume, 1e-27, 1e9, "from 1e-18uL to 1e9m3"};
// 90° would stand upright: the height has no finite slope there.
constexpr Range kAngle{Dimension::Angle, 1e-3 * droplet::kDegree, 89.999 * droplet::kDegree,
                       "from 0.001deg to 89.999deg"};
constexpr Range kTension{Dimension::SurfaceTension, 1e-6, 1e3, "from 0.001mN/m to 1000N/m"};
constexpr Range kDensity{Dimension::Density, 0.0, 1e6, "from 0kg/m3 to 1e6kg/m3"};
constexpr Range kGravity{Dimension::Acceleration, -1e6, 1e6, "from -1e6m/s2 to 1e6m/s2"};
constexpr Range kHalfTurn{Dimension::Angle, 0.0, std::numbers::pi, "from 0deg to 180deg"};
constexpr Range kDirection{Dimension::Angle, -2 * std::numbers::pi, 2 * std::numbers::pi, "from -360deg to 360deg"};

double quantity(const Given& given, const Range& range)
{
    const double value = forOption(given.subject, [&] { return droplet::parseQuantity(given.text, range.dimension); });
    // Units round: 89.999deg itself must pass.
    const double slack = 4 * std::numeric_limits<double>::epsilon();
    if (value < range.min - slack * std::abs(range.min) || value > range.max + slack * std::abs(range.max)) {
        refuse(given, range.words);
    }
    return std::clamp(value, range.min, range.max);
}

std::optional<double> finiteNumber(std::string_view text)
{
    double value = 0.0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
        return std::nullopt;
    }
    return value;
}

/// A count such as 5000, 5k, 2.5k or 1M.
std::size_t count(const Given& given, std::size_t max, const std::string& words)
{
    std::string_view digits = given.text;
    double factor = 1.0;
    if (!digits.empty() && (digits.back() == 'k' || digits.back() == 'M')) {
        factor = digits.back() == 'k' ? 1e3 : 1e6;
        digits.remove_suffix(1);
    }
    const auto number = finiteNumber(digits);
    const double value = number.value_or(0.0) * factor;
    if (value < 1.0 || value > static_cast<double>(max) || value != std::floor(value)) {
        refuse(given, "a whole number from 1 to " + words);
    }
    return static_cast<std::size_t>(value);
}

template <typename Value>
Value choice(const Given& given, std::initializer_list<std::pair<const char*, Value>> known)
{
    std::string names;
    for (const auto& [name, value] : known) {
        if (given.text == name) {
            return value;
        }
        names += std::string(names.empty() ? "" : ", ") + name;
    }
    refuse(given, "one of " + names);
}

/// Changes of one letter that turn one word into the other (Levenshtein).
std::size_t distance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

/// Options of which one at most may be given.
const std::vector<std::vector<std::string>>& exclusiveGroups()
{
    static const std::vector<std::vector<std::string>> groups{{"--width", "--pixel-size"},
                                                              {"--contact-angle", "--volume", "--height"},
                                                              {"--triangles", "--edge"},
                                                              {"--surface", "--onto"},
                                                              {"--quiet", "--verbose"}};
    return groups;
}

class HelpFormatter : public CLI::Formatter {
public:
    HelpFormatter()
    {
        column_width(26);
        label("Positionals", "Arguments");
    }

    std::string make_usage(const CLI::App* /*app*/, std::string /*name*/) const override
    {
        return "\nUsage: droplet-shape [OPTIONS] INPUT OUTPUT\n";
    }

    /// One empty line between groups: the base class leaves two between all but the first.
    std::string make_group(std::string group, bool is_positional,
                           std::vector<const CLI::Option*> options) const override
    {
        const std::string text = CLI::Formatter::make_group(std::move(group), is_positional, std::move(options));
        return is_positional ? text + "\n" : text.substr(1);
    }

    std::string make_option_name(const CLI::Option* option, bool is_positional) const override
    {
        const std::string name = CLI::Formatter::make_option_name(option, is_positional);
        const auto comma = name.find(',');
        return comma == std::string::npos ? name : name.substr(0, comma) + ", " + name.substr(comma + 1);
    }

    std::string make_option_opts(const CLI::Option* option) const override
    {
        return option->get_expected_max() == 0 || option->get_positional() ? "" : " " + option->get_type_name();
    }
};

/// The options given on the command line and in the configuration file, the former going before the latter.
class CommandLine {
public:
    CommandLine()
    {
        app_.formatter(std::make_shared<HelpFormatter>());
        app_.set_help_flag();
        app_.allow_extras();
        declareArguments();
        declareFootprint();
        declareLiquid();
        declareGround();
        declareSurface();
        declareRun();
        app_.footer(kFooter);
    }

    void parse(int argc, const char* const* argv)
    {
        refuseEmptyValues(argc, argv);
        try {
            app_.parse(argc, argv);
        } catch (const CLI::ArgumentMismatch& error) {
            const std::string message = error.what();
            refuse(message.substr(0, message.find(':')) + ": value is missing");
        } catch (const CLI::ParseError& error) {
            refuse(error.what());
        }
        refuseExtras();
        refuseRepetitions();
        if (!flag("--help") && !flag("--version")) {
            if (const auto config = value("--config")) {
                addConfig(config->text);
            }
            refuseConflicts();
        }
    }

    [[nodiscard]] bool flag(const std::string& name) const
    {
        const CLI::Option* option = app_.get_option(name);
        return option->count() > 0 && option->results().back() == "true";
    }

    [[nodiscard]] std::optional<Given> value(const std::string& name) const
    {
        const CLI::Option* option = app_.get_option(name);
        if (option->count() == 0) {
            return std::nullopt;
        }
        const auto origin = origins_.find(name);
        return Given{option->results().back(), origin == origins_.end() ? name : name + origin->second};
    }

    [[nodiscard]] std::string help() const { return app_.help(); }

private:
    static constexpr const char* kFooter =
        "Quantities carry a unit:\n"
        "  lengths nm um mm cm m in; volumes nL uL mL L mm3 cm3 m3; angles deg rad;\n"
        "  surface tension mN/m N/m dyn/cm; density kg/m3 g/cm3 g/mL;\n"
        "  acceleration m/s2 mm/s2 g\n"
        "\n"
        "Examples:\n"
        "  droplet-shape logo.png logo.glb\n"
        "  droplet-shape logo.png logo.glb --width 8cm --contact-angle 60deg\n"
        "  droplet-shape logo.png wall.glb --model exact --tilt 90deg\n"
        "  droplet-shape logo.png can.glb --surface cylinder:R=33mm,axis=y\n"
        "  droplet-shape blots.png blots.obj --volume 30uL --fill total --json run.json\n"
        "  droplet-shape - - --format stl < logo.png > logo.stl\n"
        "\n"
        "Exit codes:\n"
        "  0 done; 1 internal error; 2 usage; 3 input unreadable or without liquid;\n"
        "  4 output cannot be written; 5 no such droplet exists";

    void add(const char* group, const char* names, const char* type, const std::string& description)
    {
        app_.add_option(names)->description(description)->type_name(type)->group(group)->take_all();
    }

    void addFlag(const char* group, const char* names, const std::string& description)
    {
        app_.add_flag(names)->description(description)->group(group);
    }

    void declareArguments()
    {
        app_.add_option("INPUT")->description(
            "picture of the footprint: PNG, JPEG, BMP, TIFF, WebP,\n"
            "PBM, PGM or PPM; - is standard input");
        app_.add_option("OUTPUT")->description(
            "the droplet: .glb, .gltf, .obj, .ply or .stl;\n"
            "- is standard output and needs --format");
    }

    void declareFootprint()
    {
        constexpr const char* kGroup = "Footprint";
        add(kGroup, "--width", "LENGTH", "width of the picture [20mm]");
        add(kGroup, "--pixel-size", "LENGTH", "or edge of one pixel");
        add(kGroup, "--channel", "NAME",
            "what shows the liquid: alpha, luma, or auto: alpha\n"
            "where some of the picture is transparent, else what\n"
            "differs from the colour of its border [auto]");
        add(kGroup, "--threshold", "F", "coverage at which liquid begins, over 0, under 1 [0.5]");
        addFlag(kGroup, "--invert", "exchange liquid and dry");
        add(kGroup, "--speck-size", "F", "drop spots and holes of less than F square pixels [3]");
    }

    void declareLiquid()
    {
        constexpr const char* kGroup = "Liquid";
        add(kGroup, "--contact-angle", "ANGLE", "mean angle along the rim, under 90deg [40deg]");
        add(kGroup, "--volume", "VOLUME", "or volume");
        add(kGroup, "--height", "LENGTH", "or largest height");
        add(kGroup, "--fill", "NAME",
            "each droplet gets that much, or they share it as one\n"
            "reservoir of one pressure: each, total [each]");
        add(kGroup, "--liquid", "NAME", "water, ethanol, glycerol, mercury, honey, all at 20 C\n[water]");
        add(kGroup, "--surface-tension", "S", "instead of the liquid's own");
        add(kGroup, "--density", "D", "instead of the liquid's own");
        add(kGroup, "--model", "NAME",
            "area of the liquid's surface: linear, good to slopes\n"
            "of some 50deg; exact [linear]");
    }

    void declareGround()
    {
        constexpr const char* kGroup = "Gravity and ground";
        add(kGroup, "--gravity", "G", "into the ground; negative under a ceiling [9.81m/s2]");
        add(kGroup, "--tilt", "ANGLE", "of the ground: 90deg a wall, 180deg a ceiling [0deg]");
        add(kGroup, "--tilt-direction", "ANGLE",
            "of downhill, counter-clockwise from the picture's\n"
            "right: -90deg is toward its lower edge [-90deg]");
        add(kGroup, "--surface", "GROUND",
            "a height map's file, white is high; sphere:R=40mm; or\n"
            "cylinder:R=33mm,axis=y, its axis x, y or an angle;\n"
            "R < 0 is a bowl or a gutter [flat]");
        add(kGroup, "--surface-depth", "LENGTH", "height of white over black in the height map");
        addFlag(kGroup, "--no-penetration", "keep the liquid above the ground, or leave it dry");
        add(kGroup, "--onto", "OBJECT", "lay the droplets on a .glb or .gltf by its uv");
        add(kGroup, "--advancing", "ANGLE",
            "contact angle beyond which the rim moves out; with\n"
            "--receding the report says if droplets would slide");
        add(kGroup, "--receding", "ANGLE", "contact angle below which the rim moves in");
    }

    void declareSurface()
    {
        constexpr const char* kGroup = "Surface";
        add(kGroup, "--triangles", "N", "about so many on the footprint: 5000, 5k, 1M [40k]");
        add(kGroup, "--edge", "LENGTH", "or length of their edges");
        add(kGroup, "--grading", "N",
            "edges far from the rim up to N times as long as there:\n"
            "1, 2, 4, 8, 16, 32, 64 [1]");
        addFlag(kGroup, "--open", "leave out the base");
        add(kGroup, "--material", "NAME", "look in glTF: water, ink, mercury, honey, plain\n[water]");
        add(kGroup, "--format", "NAME",
            "glb, gltf, obj, ply, stl, whatever OUTPUT ends in\n"
            "[by OUTPUT's extension]");
    }

    void declareRun()
    {
        constexpr const char* kGroup = "Run";
        add(kGroup, "--json", "FILE", "write a report; - is standard output");
        add(kGroup, "--export-evolver", "FILE", "write the droplets for Surface Evolver");
        addFlag(kGroup, "--no-clobber", "do not replace existing files");
        add(kGroup, "--solver", "NAME",
            "of the linear system: auto, whichever is fastest; llt,\n"
            "Eigen's factorisation; cholmod, CHOLMOD's; multigrid,\n"
            "by iteration [auto]");
        add(kGroup, "-j,--threads", "N", "use at most N threads [all cores]");
        addFlag(kGroup, "-q,--quiet", "say nothing but errors");
        addFlag(kGroup, "-v,--verbose", "say more: every droplet, times, memory");
        add(kGroup, "--progress", "NAME",
            "auto: a bar on a terminal; json: a line of JSON per\n"
            "stage in place of the summary; none [auto]");
        add(kGroup, "--config", "FILE",
            "take options from lines such as width = \"8cm\";\n"
            "the command line goes before them");
        addFlag(kGroup, "-h,--help", "print this help");
        addFlag(kGroup, "--version", "print the version");
    }

    /// CLI11 takes `--width= in.png` for `--width in.png`.
    static void refuseEmptyValues(int argc, const char* const* argv)
    {
        for (int i = 1; i < argc && std::string_view(argv[i]) != "--"; ++i) {
            const std::string_view argument = argv[i];
            if (argument.substr(0, 2) == "--" && argument.find('=') + 1 == argument.size()) {
                refuse(std::string(argument.substr(0, argument.size() - 1)) + ": value is empty");
            }
        }
    }

    [[nodiscard]] std::string nearest(const std::string& unknown) const
    {
        constexpr std::size_t kFarthest = 2;  // a slip or two; more is another word
        std::string best;
        std::size_t least = kFarthest + 1;
        for (const CLI::Option* option : app_.get_options()) {
            for (const std::string& name : option->get_lnames()) {
                if (distance("--" + name, unknown) < least) {
                    least = distance("--" + name, unknown);
                    best = "--" + name;
                }
            }
        }
        return best;
    }

    void refuseExtras() const
    {
        const auto extras = app_.remaining();
        const auto is_option = [](const std::string& e) { return e.size() > 1 && e.front() == '-' && e != "--"; };
        const auto option = std::find_if(extras.begin(), extras.end(), is_option);
        if (option != extras.end()) {
            const std::string name = option->substr(0, option->find('='));
            const std::string known = nearest(name);
            refuse("unknown option " + name + (known.empty() ? "" : ", did you mean " + known + "?") +
                   (known.empty() ? "; droplet-shape --help lists all" : ""));
        }
        const auto argument = std::find_if(extras.begin(), extras.end(), [](const auto& e) { return e != "--"; });
        if (argument != extras.end()) {
            refuse("unexpected argument '" + *argument + "' after INPUT and OUTPUT");
        }
    }

    void refuseRepetitions() const
    {
        for (const CLI::Option* option : app_.get_options()) {
            if (option->count() == 0 || option->get_positional()) {
                continue;
            }
            const std::string name = "--" + option->get_lnames().front();
            if (isFlag(option)) {
                requireBoolean({option->results().back(), name});
            } else if (option->count() > 1) {
                refuse(name + ": given " + std::to_string(option->count()) + " times, must be given once");
            }
        }
    }

    static bool isFlag(const CLI::Option* option) { return option->get_expected_max() == 0; }

    /// CLI11 takes any word in `--open=word`.
    static void requireBoolean(const Given& given)
    {
        if (given.text != "true" && given.text != "false") {
            refuse(given, "true or false");
        }
    }

    /// Whether the command line decides what an option of this name would decide.
    [[nodiscard]] bool settled(const std::string& name) const
    {
        const auto given = [&](const std::string& other) {
            return app_.get_option(other)->count() > 0 && origins_.find(other) == origins_.end();
        };
        for (const auto& group : exclusiveGroups()) {
            if (std::find(group.begin(), group.end(), name) != group.end()) {
                return std::any_of(group.begin(), group.end(), given);
            }
        }
        return given(name);
    }

    void addConfig(const std::string& path)
    {
        for (const ConfigEntry& entry : readConfig(path)) {
            const std::string name = "--" + entry.key;
            const std::string origin = " (" + path + ":" + std::to_string(entry.line) + ")";
            CLI::Option* const option = entry.key.size() > 1 ? app_.get_option_no_throw(name) : nullptr;
            if (option == nullptr || name == "--config" || name == "--help" || name == "--version") {
                const std::string known = option == nullptr ? nearest(name) : "";
                refuse("--config: " + path + ":" + std::to_string(entry.line) + ": unknown key '" + entry.key + "'" +
                       (known.empty() ? "" : ", did you mean '" + known.substr(2) + "'?"));
            }
            if (isFlag(option)) {
                requireBoolean({entry.value, name + origin});
            }
            if (!settled(name)) {
                option->add_result(entry.value);
                origins_[name] = origin;
            }
        }
    }

    void refuseConflicts() const
    {
        for (const auto& group : exclusiveGroups()) {
            std::vector<std::string> given;
            for (const std::string& name : group) {
                if (isFlag(app_.get_option(name)) ? flag(name) : value(name).has_value()) {
                    given.push_back(name);
                }
            }
            if (given.size() > 1) {
                refuse(given[0] + " and " + given[1] + " exclude each other, give one of them");
            }
        }
    }

    CLI::App app_{"droplet-shape " + std::string(droplet::kVersion) +
                  ": from the picture of a footprint to a 3D droplet of liquid"};
    std::unordered_map<std::string, std::string> origins_;  ///< of options that come from the configuration file
};

void readFootprint(const CommandLine& line, ShapeOptions& options)
{
    auto& trace = options.droplet.trace;
    if (const auto width = line.value("--width")) {
        trace.width = quantity(*width, kLength);
    }
    if (const auto pixel = line.value("--pixel-size")) {
        trace.pixel_size = quantity(*pixel, kLength);
    }
    options.sized = line.value("--width") || line.value("--pixel-size");
    if (const auto channel = line.value("--channel")) {
        options.mask.channel = choice<droplet::Channel>(
            *channel,
            {{"auto", droplet::Channel::Auto}, {"alpha", droplet::Channel::Alpha}, {"luma", droplet::Channel::Luma}});
    }
    if (const auto threshold = line.value("--threshold")) {
        const auto number = finiteNumber(threshold->text);
        if (!number || *number <= 0.0 || *number >= 1.0) {
            refuse(*threshold, "a number over 0 and under 1, such as 0.5");
        }
        trace.threshold = *number;
    }
    options.mask.invert = line.flag("--invert");
    if (const auto speck = line.value("--speck-size")) {
        const auto number = finiteNumber(speck->text);
        if (!number || *number < 0.0) {
            refuse(*speck, "a number of square pixels, at least 0");
        }
        trace.speck_size = *number;
    }
}

void readLiquid(const CommandLine& line, ShapeOptions& options)
{
    auto& solve = options.droplet.solve;
    if (const auto angle = line.value("--contact-angle")) {
        solve.fill = {droplet::FillBy::ContactAngle, quantity(*angle, kAngle)};
    }
    if (const auto volume = line.value("--volume")) {
        solve.fill = {droplet::FillBy::Volume, quantity(*volume, kVolume)};
    }
    if (const auto height = line.value("--height")) {
        solve.fill = {droplet::FillBy::Height, quantity(*height, kLength)};
    }
    if (const auto sharing = line.value("--fill")) {
        solve.fill.sharing = choice<droplet::FillSharing>(
            *sharing, {{"each", droplet::FillSharing::Each}, {"total", droplet::FillSharing::Total}});
    }

    const auto liquid = line.value("--liquid");
    if (liquid) {
        solve.liquid = forOption(liquid->subject, [&] { return droplet::liquidNamed(liquid->text); });
    }
    const auto tension = line.value("--surface-tension");
    if (tension) {
        solve.liquid.surface_tension = quantity(*tension, kTension);
    }
    const auto density = line.value("--density");
    if (density) {
        solve.liquid.density = quantity(*density, kDensity);
    }
    if (!liquid && (tension || density)) {
        solve.liquid.name = "custom";
    }
    if (const auto model = line.value("--model")) {
        solve.model =
            choice<droplet::Model>(*model, {{"linear", droplet::Model::Linear}, {"exact", droplet::Model::Exact}});
    }
}

void readGravity(const CommandLine& line, ShapeOptions& options)
{
    auto& solve = options.droplet.solve;
    if (const auto gravity = line.value("--gravity")) {
        solve.gravity = quantity(*gravity, kGravity);
    }
    if (const auto tilt = line.value("--tilt")) {
        solve.tilt = quantity(*tilt, kHalfTurn);
        if (solve.tilt > 0.0 && solve.gravity == 0.0) {
            options.warnings.push_back("--tilt has no effect: there is no gravity");
        }
    }
    if (const auto direction = line.value("--tilt-direction")) {
        solve.tilt_direction = quantity(*direction, kDirection);
        if (solve.tilt == 0.0 || solve.tilt == kHalfTurn.max) {
            options.warnings.push_back("--tilt-direction has no effect: no side of level ground is downhill");
        }
    }
}

void readHysteresis(const CommandLine& line, ShapeOptions& options)
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
    options.hysteresis = hysteresis;
}

constexpr const char* kGroundWords =
    "a height map's file, sphere:R=LENGTH or cylinder:R=LENGTH,axis=ANGLE, where axis may also be x or y";

/// The values in a list such as `R=33mm,axis=y`, in the order of `keys`, each of which it must have once.
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
            refuse(given, kGroundWords);
        }
        values[key] = part.substr(equals + 1);
    }
    std::vector<Given> parts;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (!values[i]) {
            refuse(given, kGroundWords);
        }
        parts.push_back({*values[i], given.subject + ": " + keys[i]});
    }
    return parts;
}

/// A radius, of a bowl or gutter if negative.
double radius(const Given& given)
{
    constexpr Range kRadius{Dimension::Length, -kLength.max, kLength.max, "from 1nm to 1000m, or from -1000m to -1nm"};
    const double value = quantity(given, kRadius);
    if (std::abs(value) < kLength.min) {
        refuse(given, kRadius.words);
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

/// Whether a text is of the form `word:…=…`: a ground described, or misspelt, rather than the name of a file.
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
        refuse(given, kGroundWords);
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
        refuse(given, kGroundWords);
    }
    return ground;
}

void readGround(const CommandLine& line, ShapeOptions& options)
{
    auto& solve = options.droplet.solve;
    if (const auto surface = line.value("--surface")) {
        options.ground = groundOf(*surface);
    }
    if (const auto depth = line.value("--surface-depth")) {
        options.ground.depth = quantity(*depth, kLength);
        if (options.ground.kind != droplet::GroundKind::HeightMap) {
            options.ground.depth.reset();
            options.warnings.push_back("--surface-depth has no effect: the ground is no height map");
        }
    }
    if (const auto onto = line.value("--onto")) {
        options.onto = onto->text;
    }
    solve.no_penetration = line.flag("--no-penetration");
    const bool pulled_down = solve.gravity >= 0.0 && solve.tilt == 0.0;
    if (solve.no_penetration && pulled_down && options.ground.kind == droplet::GroundKind::Flat) {
        options.warnings.push_back("--no-penetration has no effect: on level flat ground the liquid stays above it");
    }
}

void readFormat(const CommandLine& line, ShapeOptions& options)
{
    const std::string known = "glb, gltf, obj, ply, stl";
    const std::string extension = std::filesystem::path(options.output).extension().string();
    if (const auto format = line.value("--format")) {
        options.format = choice<droplet::Format>(*format, {{"glb", droplet::Format::Glb},
                                                           {"gltf", droplet::Format::Gltf},
                                                           {"obj", droplet::Format::Obj},
                                                           {"ply", droplet::Format::Ply},
                                                           {"stl", droplet::Format::Stl}});
    } else if (options.output == kStandardStream) {
        refuse("--format is needed when OUTPUT is -; allowed are " + known);
    } else if (extension.empty()) {
        refuse("OUTPUT '" + options.output + "' has no extension to tell the format; allowed are " + known +
               ", or give --format");
    } else {
        options.format = forOption("OUTPUT '" + options.output + "'", [&] { return droplet::formatNamed(extension); });
    }

    if (const auto material = line.value("--material")) {
        options.material = forOption(material->subject, [&] { return droplet::materialNamed(material->text); });
        if (options.format != droplet::Format::Glb && options.format != droplet::Format::Gltf) {
            options.warnings.push_back("--material " + material->text +
                                       " has no effect: " + droplet::name(options.format) + " files carry no material");
        }
    }
}

void readSurface(const CommandLine& line, ShapeOptions& options)
{
    if (const auto triangles = line.value("--triangles")) {
        options.droplet.mesh.triangles = count(*triangles, kMostTriangles, "100M, such as 5000, 5k or 1M");
    }
    if (const auto edge = line.value("--edge")) {
        options.droplet.mesh.edge = quantity(*edge, kLength);
    }
    if (const auto grading = line.value("--grading")) {
        options.droplet.mesh.grading =
            choice<int>(*grading, {{"1", 1}, {"2", 2}, {"4", 4}, {"8", 8}, {"16", 16}, {"32", 32}, {"64", 64}});
    }
    options.droplet.open = line.flag("--open");
}

void readRun(const CommandLine& line, ShapeOptions& options)
{
    constexpr std::size_t kMostThreads = 1024;  // more than any machine this runs on
    if (const auto json = line.value("--json")) {
        options.json = json->text;
    }
    if (const auto evolver = line.value("--export-evolver")) {
        options.evolver = evolver->text;
    }
    if (const auto config = line.value("--config")) {
        options.config = config->text;
    }
    options.files.no_clobber = line.flag("--no-clobber");
    if (const auto solver = line.value("--solver")) {
        options.droplet.solve.solver = choice<droplet::Solver>(*solver, {{"auto", droplet::Solver::Auto},
                                                                         {"llt", droplet::Solver::Llt},
                                                                         {"cholmod", droplet::Solver::Cholmod},
                                                                         {"multigrid", droplet::Solver::Multigrid}});
    }
    if (const auto threads = line.value("--threads")) {
        options.threads = count(*threads, kMostThreads, "1024");
    }
    options.verbosity = line.flag("--quiet")     ? Verbosity::Quiet
                        : line.flag("--verbose") ? Verbosity::Verbose
                                                 : Verbosity::Normal;
    if (const auto progress = line.value("--progress")) {
        options.progress = choice<ProgressMode>(
            *progress, {{"auto", ProgressMode::Auto}, {"none", ProgressMode::None}, {"json", ProgressMode::Json}});
    }
}

void readArguments(const CommandLine& line, ShapeOptions& options)
{
    const auto argument = [&](const char* name) {
        const auto given = line.value(name);
        if (!given || given->text.empty()) {
            refuse(std::string(name) + " is missing; usage: droplet-shape [OPTIONS] INPUT OUTPUT, more with --help");
        }
        return given->text;
    };
    options.input = argument("INPUT");
    options.output = argument("OUTPUT");
}

}  // namespace

std::variant<ShapeOptions, std::string> parseShape(int argc, const char* const* argv)
{
    CommandLine line;
    line.parse(argc, argv);
    if (line.flag("--help")) {
        return line.help();
    }
    if (line.flag("--version")) {
        return "droplet-shape " + std::string(droplet::kVersion) + "\n";
    }
    ShapeOptions options;
    readFootprint(line, options);
    readLiquid(line, options);
    readGravity(line, options);
    readHysteresis(line, options);
    readGround(line, options);
    readSurface(line, options);
    readRun(line, options);
    readArguments(line, options);
    readFormat(line, options);
    return options;
}

}  // namespace cli

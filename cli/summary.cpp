// SPDX-License-Identifier: GPL-3.0-or-later
#include "summary.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "droplet/units.h"
#include "terminal.h"

namespace cli {
namespace {

using droplet::Report;

std::string digits(double value, int significant = 4)
{
    return fmt::format("{:.{}g}", value + 0.0, significant);
}

std::string counted(std::size_t count, const std::string& noun)
{
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string millimetres(double metres)
{
    return digits(metres / droplet::kMillimetre) + " mm";
}
std::string squareMillimetres(double square_metres)
{
    return digits(square_metres / (droplet::kMillimetre * droplet::kMillimetre)) + " mm²";
}
std::string microlitres(double cubic_metres)
{
    return digits(cubic_metres / droplet::kMicrolitre) + " µL";
}
/// Degrees, rounded to tenths; never −0.
double tenthsOfDegrees(double radians)
{
    return std::round(10.0 * radians / droplet::kDegree) / 10.0 + 0.0;
}
std::string degrees(double radians)
{
    return fmt::format("{:.1f}°", tenthsOfDegrees(radians));
}

std::string bytes(std::uint64_t count)
{
    constexpr std::array<const char*, 4> kUnits{"bytes", "kB", "MB", "GB"};
    auto value = static_cast<double>(count);
    std::size_t unit = 0;
    for (; value >= 1e3 && unit + 1 < kUnits.size(); ++unit) {
        value /= 1e3;
    }
    return digits(value, 3) + " " + kUnits[unit];
}

std::string line(const std::string& label, const std::string& text)
{
    constexpr std::size_t kColumn = 11;
    return paint(label, Colour::Bold) + std::string(kColumn - label.size(), ' ') + text + "\n";
}

std::string picture(const droplet::InputReport& input)
{
    const bool alpha = input.channel == droplet::Channel::Alpha;
    const std::string liquid = !input.palette.empty() ? counted(input.palette.size(), "colour")
                               : input.segment == droplet::Segmentation::Colour ? "one colour"
                               : input.segment == droplet::Segmentation::Seeds
                                   ? (input.inverted ? "what dark strokes mark" : "what light strokes mark")
                               : alpha ? (input.inverted ? "transparent" : "opaque")
                                       : (input.inverted ? "dark" : "bright");
    const std::string page = "SVG page " + millimetres(input.pixel_size * input.width_px) + " wide" +
                             (input.own_size ? " as it states" : "") + ", drawn with ";
    std::string text =
        fmt::format("{}{} × {} pixels of {}; {} {} liquid ({}), {} edges", input.drawn ? page : "", input.width_px,
                    input.height_px, millimetres(input.pixel_size), liquid, input.palette.size() > 1 ? "are" : "is",
                    !input.palette.empty()                           ? "--by-colour"
                    : input.segment == droplet::Segmentation::Colour ? "--colour"
                    : input.segment == droplet::Segmentation::Seeds  ? "--seeds"
                    : alpha                                          ? "alpha"
                                                                     : "luma",
                    input.anti_aliased ? "anti-aliased" : "hard");
    if (input.specks_dropped > 0) {
        text += "; " + counted(input.specks_dropped, "speck") + " dropped, the largest of " +
                digits(input.largest_speck_px, 3) + " pixels";
    }
    return text;
}

/// Text on one line, with line breaks as \n.
std::string asTyped(const std::string& text)
{
    std::string typed;
    for (const char c : text) {
        typed += c == '\n' ? std::string("\\n") : std::string(1, c);
    }
    return oneLine(typed);
}

std::string type(const droplet::InputReport& input)
{
    const droplet::TypeReport& type = *input.type;
    std::string text = type.text ? "'" + asTyped(*type.text) + "'" : "glyph '" + oneLine(type.glyph_name) + "'";
    text += " in " + (type.family.empty() ? oneLine(input.path) : oneLine(type.family + " " + type.style));
    for (const auto& [tag, value] : type.axes) {
        text += ", " + oneLine(tag) + " " + digits(value);
    }
    text += ", em " + millimetres(type.em);
    if (!input.palette.empty()) {
        text += ", " + counted(input.palette.size(), "colour") + " (--by-colour)";
    }
    if (input.specks_dropped > 0) {
        text += "; " + counted(input.specks_dropped, "speck") + " dropped";
    }
    return text;
}

std::string shape(const Report& report)
{
    const auto& total = report.total;
    return fmt::format("{}, {} high, contact angle {} ({} to {})", microlitres(total.volume),
                       millimetres(total.height_max), degrees(total.contact_angle.mean),
                       degrees(total.contact_angle.min), degrees(total.contact_angle.max));
}

/// Where the height of a puddle decides the amount.
std::string amount(const Report& report)
{
    const auto low = std::count_if(report.droplets.begin(), report.droplets.end(),
                                   [](const auto& droplet) { return droplet.limit == droplet::FillLimit::Puddle; });
    const std::string which =
        report.droplets.size() == 1 ? "the" : fmt::format("{} of {}", low, report.droplets.size());
    const bool is_puddle = droplet::bendingLayer(report.physics).has_value();
    const bool is_one = report.droplets.size() == 1;
    return fmt::format("the height of {} with a contact angle of {}{} limits {} {}; ask for more with --height",
                       is_puddle ? "a puddle" : "a round droplet of its area", degrees(report.physics.fill.amount),
                       is_puddle || is_one ? ", " + millimetres(report.total.height_max) + "," : "", which,
                       is_one ? "droplet" : "droplets");
}

std::string table(const Report& report)
{
    constexpr std::size_t kRows = 20;  // rows that fit on a screen; the JSON report contains all
    std::string text = "           droplet  holes  footprint/mm²  volume/µL  height/mm  angle/°  pressure/Pa\n";
    const std::size_t rows = std::min(kRows, report.droplets.size());
    for (std::size_t i = 0; i < rows; ++i) {
        const auto& droplet = report.droplets[i];
        const auto& figures = droplet.figures;
        text += fmt::format("           {:7}  {:5}  {:13.4g}  {:9.4g}  {:9.4g}  {:7.1f}  {:11.4g}\n", i + 1,
                            droplet.holes, figures.footprint_area / (droplet::kMillimetre * droplet::kMillimetre),
                            figures.volume / droplet::kMicrolitre, figures.height_max / droplet::kMillimetre,
                            tenthsOfDegrees(figures.contact_angle.mean), droplet.pressure);
    }
    if (rows < report.droplets.size()) {
        text += fmt::format("           and {} more, all in the --json report\n", report.droplets.size() - rows);
    }
    return text;
}

std::string retention(const Report& report)
{
    const auto sliding = std::count_if(report.droplets.begin(), report.droplets.end(), [](const auto& droplet) {
        return droplet.retention && droplet.retention->wouldSlide();
    });
    const std::string count = sliding == 0 ? "no droplet" : counted(static_cast<std::size_t>(sliding), "droplet");
    return fmt::format("{} would slide; pulled by {} µN, held by up to {} µN", count,
                       digits(report.retention->driving_force * 1e6), digits(report.retention->retention_force * 1e6));
}

std::string object(const droplet::ObjectReport& onto)
{
    return fmt::format("{}: {} laid on it, {} left out, lengths {} to {} times the picture's", oneLine(onto.path),
                       counted(onto.droplets_laid, "droplet"), onto.droplets_left_out, digits(onto.min_scale, 3),
                       digits(onto.max_scale, 3));
}

std::string gravity(const Report& report)
{
    const auto& physics = report.physics;
    std::string text = digits(physics.gravity) + " m/s², tilt " + degrees(physics.tilt);
    if (physics.tilt > 0.0) {
        text += " downhill to " + degrees(physics.tilt_direction);
    }
    if (const auto length = droplet::capillaryLength(physics.liquid, physics.gravity)) {
        text += ", capillary length " + millimetres(*length);
    }
    return text + ", Bond number " + digits(report.total.bond_number);
}

std::string ground(const Report& report)
{
    const droplet::GroundReport& ground = report.ground;
    const std::string radius = ground.radius ? " of radius " + millimetres(*ground.radius) : "";
    switch (ground.kind) {
        case droplet::GroundKind::Flat:
            return "flat";
        case droplet::GroundKind::Sphere:
            return "sphere" + radius;
        case droplet::GroundKind::Cylinder:
            return "cylinder" + radius + ", axis at " + degrees(ground.axis.value_or(0.0));
        case droplet::GroundKind::HeightMap:
            return oneLine(ground.path.value_or("")) +
                   (ground.depth ? ", " + millimetres(*ground.depth) + " deep" : "");
    }
    return "";
}

std::string penetration(const Report& report)
{
    if (report.physics.no_penetration) {
        return ", no penetration, " + squareMillimetres(report.total.dry_area) + " left dry";
    }
    const bool sinks = report.total.depth_max > 0.0;
    return sinks ? ", the liquid sinks " + millimetres(report.total.depth_max) + " into it" : "";
}

std::string compression(const droplet::OutputReport& output)
{
    if (!output.compression_error) {
        return "";
    }
    return fmt::format("; {}, vertices off by up to {} µm, normals by {}°", name(output.compression),
                       digits(output.compression_error->position * 1e6, 2),
                       digits(output.compression_error->normal / droplet::kDegree, 2));
}

/// Files of the maps, and the scale of PNGs.
std::string maps(const droplet::OutputReport& output)
{
    std::string text;
    for (const std::string& path : output.maps) {
        text += (text.empty() ? "" : ", ") + oneLine(path);
    }
    return text + (output.map_thickness ? "; white is " + millimetres(*output.map_thickness) + " of liquid" : "");
}

std::string details(const Report& report)
{
    const auto& liquid = report.physics.liquid;
    std::string text;
    if (!report.input.type) {
        text += line("mask", fmt::format("by {}, {:.0f} % sure", name(report.input.segment),
                                         100.0 * report.input.segment_confidence));
    }
    text += line("liquid", liquid.name + ", " + digits(liquid.surface_tension * 1e3) + " mN/m, " +
                               digits(liquid.density) + " kg/m³");
    text += line("gravity", gravity(report));
    text += line("ground", ground(report) + penetration(report));
    text += line("energy", digits(report.total.surface_energy * 1e6) + " µJ of surface, " +
                               digits(report.total.gravity_energy * 1e6) + " µJ of gravity");
    const bool is_linear = report.physics.model == droplet::Model::Linear;
    const std::string model = is_linear ? "linear model"
                                        : (report.sheets > 0 ? counted(report.sheets, "parametric sheet") + ", "
                                                             : std::string("exact model, ")) +
                                              counted(report.solve.newton_steps, "Newton step");
    text += line("solve", model + ", " + report.solve.method + ", " + counted(report.solve.unknowns, "unknown") +
                              ", residual " + digits(report.solve.residual, 2) +
                              (report.pressure ? ", pressure " + digits(*report.pressure) + " Pa" : ""));
    const droplet::ShapeFigures& total = report.total;
    if (is_linear && total.steep_area > 0.0) {
        text +=
            line("slopes", fmt::format("over 50° on {:.2g} % of the footprint, where the linear model overstates the "
                                       "liquid's area: by {:.2g} % in all",
                                       100.0 * total.steep_area / total.footprint_area,
                                       100.0 * (total.linear_area / total.liquid_area - 1.0)));
    }
    text += table(report);
    std::string times;
    for (std::size_t stage = 0; stage < droplet::kStageCount; ++stage) {
        times += fmt::format("{} {:.3f} s, ", name(static_cast<droplet::Stage>(stage)), report.time[stage]);
    }
    text += line("time", fmt::format("{}total {:.3f} s", times, report.time_total));
    text += line("memory", bytes(report.peak_memory) + " at most");
    return text;
}

std::string faces(const droplet::OutputReport& output)
{
    const std::string triangles = counted(output.triangles - 2 * output.quads, "triangle");
    return output.quads == 0 ? triangles : counted(output.quads, "quadrilateral") + " and " + triangles;
}

}  // namespace

std::string summary(const Report& report, bool with_details)
{
    std::string text = report.input.type ? line("type", type(report.input)) : line("picture", picture(report.input));
    text += line("footprint", counted(report.droplets.size(), "droplet") + ", " + counted(report.mesh.holes, "hole") +
                                  ", " + squareMillimetres(report.total.footprint_area) + ", rim " +
                                  millimetres(report.total.rim_length));
    text += line("shape", shape(report));
    if (droplet::limitOf(report.droplets) == droplet::FillLimit::Puddle) {
        text += line("amount", amount(report));
    }
    if (report.retention) {
        text += line("retention", retention(report));
    }
    if (report.onto) {
        text += line("object", object(*report.onto));
    }
    text += line("mesh", counted(report.mesh.triangles, "triangle") + " of the liquid's surface, smallest angle " +
                             degrees(report.mesh.min_angle));
    if (with_details) {
        text += details(report);
    }
    text +=
        line("written", oneLine(report.output.path) + ": " + bytes(report.output.bytes) + ", " + faces(report.output) +
                            ", " + (report.output.topology.closed ? "closed" : "open") + compression(report.output));
    for (std::size_t k = 0; k < report.output.levels.size(); ++k) {
        const droplet::LevelReport& level = report.output.levels[k];
        const std::string name = level.path ? oneLine(*level.path) : fmt::format("level {} in it", k + 1);
        text += line("", name + ": " + counted(level.triangles, "triangle") + ", off by " +
                             digits(level.error * 1e6, 2) + " µm rms");
    }
    if (!report.output.maps.empty()) {
        text += line("maps", maps(report.output));
    }
    return text;
}

}  // namespace cli

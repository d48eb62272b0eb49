// SPDX-License-Identifier: GPL-3.0-or-later
#include "summary.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "droplet/units.h"
#include "terminal.h"

namespace cli {
namespace {

using droplet::Report;

std::string digits(double value, int significant = 4)
{
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.*g", significant, value);
    return text.data();
}

std::string fixed(double value, int decimals)
{
    std::array<char, 350> text{};  // the largest double has 309 digits before its point
    std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
    return text.data();
}

std::string counted(std::size_t count, const std::string& noun)
{
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
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
std::string degrees(double radians)
{
    return fixed(radians / droplet::kDegree, 1) + "°";
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
    const std::string liquid =
        alpha ? (input.inverted ? "transparent" : "opaque") : (input.inverted ? "dark" : "bright");
    const std::string page = "SVG page " + millimetres(input.pixel_size * input.width_px) + " wide" +
                             (input.own_size ? " as it states" : "") + ", drawn with ";
    std::string text = (input.drawn ? page : "") + std::to_string(input.width_px) + " × " +
                       std::to_string(input.height_px) + " pixels of " + millimetres(input.pixel_size) + "; " + liquid +
                       " is liquid (" + (alpha ? "alpha" : "luma") + "), " +
                       (input.anti_aliased ? "anti-aliased edges" : "hard edges");
    if (input.specks_dropped > 0) {
        text += "; " + counted(input.specks_dropped, "speck") + " dropped, the largest of " +
                digits(input.largest_speck_px, 3) + " pixels";
    }
    return text;
}

std::string type(const droplet::InputReport& input)
{
    const droplet::TypeReport& type = *input.type;
    std::string text = type.text ? "'" + oneLine(*type.text) + "'" : "glyph '" + oneLine(type.glyph_name) + "'";
    text += " in " + (type.family.empty() ? oneLine(input.path) : oneLine(type.family + " " + type.style));
    for (const auto& [tag, value] : type.axes) {
        text += ", " + oneLine(tag) + " " + digits(value);
    }
    text += ", em " + millimetres(type.em);
    if (input.specks_dropped > 0) {
        text += "; " + counted(input.specks_dropped, "speck") + " dropped";
    }
    return text;
}

std::string shape(const Report& report)
{
    const auto& total = report.total;
    return microlitres(total.volume) + ", " + millimetres(total.height_max) + " high, contact angle " +
           degrees(total.contact_angle.mean) + " (" + degrees(total.contact_angle.min) + " to " +
           degrees(total.contact_angle.max) + ")";
}

std::string table(const Report& report)
{
    constexpr std::size_t kRows = 20;  // what fits on a screen beside the rest; the report in JSON holds all
    std::string text = "           droplet  holes  footprint/mm²  volume/µL  height/mm  angle/°  pressure/Pa\n";
    const std::size_t rows = std::min(kRows, report.droplets.size());
    for (std::size_t i = 0; i < rows; ++i) {
        const auto& droplet = report.droplets[i];
        const auto& figures = droplet.figures;
        std::array<char, 160> row{};
        std::snprintf(row.data(), row.size(), "           %7zu  %5zu  %13.4g  %9.4g  %9.4g  %7.1f  %11.4g\n", i + 1,
                      droplet.holes, figures.footprint_area / (droplet::kMillimetre * droplet::kMillimetre),
                      figures.volume / droplet::kMicrolitre, figures.height_max / droplet::kMillimetre,
                      figures.contact_angle.mean / droplet::kDegree, droplet.pressure);
        text += row.data();
    }
    if (rows < report.droplets.size()) {
        text += "           and " + std::to_string(report.droplets.size() - rows) + " more, all in the --json report\n";
    }
    return text;
}

std::string retention(const Report& report)
{
    const auto sliding = std::count_if(report.droplets.begin(), report.droplets.end(), [](const auto& droplet) {
        return droplet.retention && droplet.retention->wouldSlide();
    });
    const std::string count = sliding == 0 ? "no droplet" : counted(static_cast<std::size_t>(sliding), "droplet");
    return count + " would slide; pulled by " + digits(report.retention->driving_force * 1e6) + " µN, held by up to " +
           digits(report.retention->retention_force * 1e6) + " µN";
}

std::string object(const droplet::ObjectReport& onto)
{
    return oneLine(onto.path) + ": " + counted(onto.droplets_laid, "droplet") + " laid on it, " +
           std::to_string(onto.droplets_left_out) + " left out, lengths " + digits(onto.least_scale, 3) + " to " +
           digits(onto.most_scale, 3) + " times the picture's";
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

std::string details(const Report& report)
{
    const auto& liquid = report.physics.liquid;
    std::string text = line("liquid", liquid.name + ", " + digits(liquid.surface_tension * 1e3) + " mN/m, " +
                                          digits(liquid.density) + " kg/m³");
    text += line("gravity", gravity(report));
    text += line("ground", ground(report) + penetration(report));
    text += line("energy", digits(report.total.surface_energy * 1e6) + " µJ of surface, " +
                               digits(report.total.gravity_energy * 1e6) + " µJ of gravity");
    const std::string model = report.physics.model == droplet::Model::Exact
                                  ? "exact model, " + counted(report.solve.newton_steps, "Newton step")
                                  : "linear model";
    text += line("solve", model + ", " + report.solve.method + ", " + counted(report.solve.unknowns, "unknown") +
                              ", residual " + digits(report.solve.residual, 2) +
                              (report.pressure ? ", pressure " + digits(*report.pressure) + " Pa" : ""));
    text += table(report);
    std::string times;
    for (std::size_t stage = 0; stage < droplet::kStageCount; ++stage) {
        times += std::string(name(static_cast<droplet::Stage>(stage))) + " " + fixed(report.time[stage], 3) + " s, ";
    }
    text += line("time", times + "total " + fixed(report.time_total, 3) + " s");
    text += line("memory", bytes(report.peak_memory) + " at most");
    return text;
}

}  // namespace

std::string summary(const Report& report, bool with_details)
{
    std::string text = report.input.type ? line("type", type(report.input)) : line("picture", picture(report.input));
    text += line("footprint", counted(report.droplets.size(), "droplet") + ", " + counted(report.mesh.holes, "hole") +
                                  ", " + squareMillimetres(report.total.footprint_area) + ", rim " +
                                  millimetres(report.total.rim_length));
    text += line("shape", shape(report));
    if (report.retention) {
        text += line("retention", retention(report));
    }
    if (report.onto) {
        text += line("object", object(*report.onto));
    }
    text += line("mesh", counted(report.mesh.triangles, "triangle") + " on the footprint, smallest angle " +
                             degrees(report.mesh.min_angle));
    if (with_details) {
        text += details(report);
    }
    text += line("written", oneLine(report.output.path) + ": " + bytes(report.output.bytes) + ", " +
                                counted(report.output.triangles, "triangle") + ", " +
                                (report.output.topology.closed ? "closed" : "open"));
    return text;
}

}  // namespace cli

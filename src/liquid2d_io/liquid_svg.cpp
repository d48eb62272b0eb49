// SPDX-License-Identifier: GPL-3.0-or-later
// Looks, and drawings as SVG.
#include <fmt/core.h>

#include <cmath>
#include <ostream>

#include "droplet/liquid2d_io/liquid_drawing.h"
#include "entry_named.h"
#include "liquid_paths.h"

namespace droplet {
namespace {

std::string hex(Colour colour)
{
    return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

/// Number with two digits after the point, without trailing zeros.
void put(std::string& text, double value)
{
    std::string number = fmt::format("{:.2f}", value);
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') {
        number.pop_back();
    }
    if (number == "-0") {
        number = "0";
    }
    if (!text.empty() && text.back() != 'M' && text.back() != 'c' && text.back() != 'L' && number.front() != '-') {
        text += ' ';
    }
    text += number;
}

/// Path data, with relative coordinates of rounded points, so that rounding does not add up.
std::string dataOf(const std::vector<BezierPath>& paths)
{
    const auto rounded = [](Vec2 a) { return Vec2{std::round(a.x * 100.0) / 100.0, std::round(a.y * 100.0) / 100.0}; };
    std::string data;
    for (const BezierPath& path : paths) {
        Vec2 at = rounded(path.start);
        data += 'M';
        put(data, at.x);
        put(data, at.y);
        data += 'c';
        for (const BezierCurve& curve : path.curves) {
            for (const Vec2 point : {curve.leaving, curve.arriving, curve.end}) {
                put(data, rounded(point).x - at.x);
                put(data, rounded(point).y - at.y);
            }
            at = rounded(curve.end);
        }
        data += 'z';
    }
    return data;
}

std::string dataOf(const Region& region, const LiquidView& view)
{
    std::string data;
    for (const std::vector<Vec2>& loop : region.loops) {
        data += 'M';
        const std::vector<Vec2> points = toPixels(loop, view);
        for (std::size_t k = 0; k < points.size(); ++k) {
            data += k == 1 ? "L" : "";
            put(data, points[k].x);
            put(data, points[k].y);
        }
        data += 'z';
    }
    return data;
}

}  // namespace

const std::vector<LiquidLook>& liquidLooks()
{
    static const std::vector<LiquidLook> looks{
        {"flat", {58, 134, 200}, {58, 134, 200}, Colour{214, 236, 250}, {}, 0.0, {92, 84, 78}, std::nullopt},
        {"comic",
         {66, 152, 214},
         {104, 178, 228},
         Colour{244, 250, 255},
         {18, 38, 76},
         2.5,
         {122, 104, 92},
         Colour{252, 246, 232}},
        {"ink", {255, 255, 255}, {255, 255, 255}, std::nullopt, {20, 20, 24}, 2.0, {60, 60, 64}, Colour{255, 255, 255}},
        {"night", {38, 190, 206}, {140, 232, 232}, Colour{16, 92, 116}, {}, 0.0, {44, 52, 76}, Colour{12, 18, 40}},
    };
    return looks;
}

const LiquidLook& liquidLookNamed(std::string_view name)
{
    return entryNamed(liquidLooks(), name, "look");
}

void writeLiquidSvg(const DrawnLiquid& scene, const LiquidView& view, const LiquidLook& look, std::ostream& out)
{
    validate(view);
    out << fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n", view.width,
        view.height);
    if (look.background) {
        out << fmt::format("<rect id=\"background\" width=\"100%\" height=\"100%\" fill=\"{}\"/>\n",
                           hex(*look.background));
    }
    const auto path = [](const std::string& data, Colour fill) {
        return data.empty() ? "" : fmt::format("<path fill=\"{}\" d=\"{}\"/>", hex(fill), data);
    };
    const auto group = [&](const char* id, const std::string& paths) {
        if (!paths.empty()) {
            out << fmt::format("<g id=\"{}\">{}</g>\n", id, paths);
        }
    };
    const LiquidPaths paths = liquidPaths(scene.shape, view, look);
    group("liquid", path(dataOf(paths.liquid), look.water));
    group("droplets", path(dataOf(paths.droplets), look.droplet));
    group("foam", path(dataOf(paths.foam), look.foam.value_or(look.water)));
    group("lines", path(dataOf(paths.lines), look.line));
    // Walls may overlap, which would be holes in one path.
    std::string walls;
    for (const Region& region : scene.walls) {
        const std::string data = dataOf(region, view);
        walls += fmt::format("<path fill-rule=\"evenodd\" fill=\"{}\" d=\"{}\"/>", hex(look.wall), data);
    }
    group("walls", walls);
    out << "</svg>\n";
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
// Lottie Animation Format 1.0 (Lottie Animation Community), written for players from bodymovin 5.7 on.
#include "droplet/liquid2d_io/liquid_lottie.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <ostream>
#include <utility>

#include "liquid_paths.h"
#include "require.h"

namespace droplet {
namespace {

/// Place in hundredths of a pixel, the precision of the file.
struct Place {
    long long x = 0;
    long long y = 0;
};

Place rounded(Vec2 a)
{
    return {std::llround(100.0 * a.x), std::llround(100.0 * a.y)};
}

Place operator-(Place a, Place b)
{
    return {a.x - b.x, a.y - b.y};
}

/// Hundredths as a number of JSON, without trailing zeros.
void put(std::string& text, long long hundredths)
{
    if (hundredths < 0) {
        text += '-';
        hundredths = -hundredths;
    }
    text += std::to_string(hundredths / 100);
    if (const long long rest = hundredths % 100; rest != 0) {
        text += '.';
        text += static_cast<char>('0' + rest / 10);
        if (rest % 10 != 0) {
            text += static_cast<char>('0' + rest % 10);
        }
    }
}

/// Corners of a closed path, with control points relative to them.
struct Vertices {
    std::vector<Place> arriving;
    std::vector<Place> leaving;
    std::vector<Place> at;
};

Vertices verticesOf(const BezierPath& path)
{
    Vertices vertices;
    Place start = rounded(path.start);
    // The last curve arrives at the first vertex.
    Place arriving = rounded(path.curves.back().arriving);
    for (const BezierCurve& curve : path.curves) {
        vertices.at.push_back(start);
        vertices.arriving.push_back(arriving - start);
        vertices.leaving.push_back(rounded(curve.leaving) - start);
        arriving = rounded(curve.arriving);
        start = rounded(curve.end);
    }
    return vertices;
}

Vertices verticesOf(const std::vector<Vec2>& polygon)
{
    Vertices vertices;
    for (const Vec2 point : polygon) {
        vertices.at.push_back(rounded(point));
    }
    vertices.arriving.resize(polygon.size());
    vertices.leaving.resize(polygon.size());
    return vertices;
}

void put(std::string& text, const std::vector<Place>& places)
{
    text += '[';
    for (const Place place : places) {
        text += text.back() == '[' ? "[" : ",[";
        put(text, place.x);
        text += ',';
        put(text, place.y);
        text += ']';
    }
    text += ']';
}

std::string pathOf(const Vertices& vertices)
{
    std::string text = R"({"ty":"sh","ks":{"a":0,"k":{"c":true,"i":)";
    put(text, vertices.arriving);
    text += R"(,"o":)";
    put(text, vertices.leaving);
    text += R"(,"v":)";
    put(text, vertices.at);
    return text + "}}},";
}

std::string colourOf(Colour colour)
{
    return fmt::format(R"("c":{{"a":0,"k":[{:.4g},{:.4g},{:.4g},1]}},"o":{{"a":0,"k":100}})", colour[0] / 255.0,
                       colour[1] / 255.0, colour[2] / 255.0);
}

/// Group of paths with their filling. What comes first in a list is on top, so the line stands before the filling.
std::string group(const char* name, const std::string& paths, Colour fill, const std::string& line)
{
    return paths.empty() ? std::string()
                         : fmt::format(R"({{"ty":"gr","nm":"{}","it":[{}{}{{"ty":"fl",{},"r":2}},)"
                                       R"({{"ty":"tr","p":{{"a":0,"k":[0,0]}},"a":{{"a":0,"k":[0,0]}},)"
                                       R"("s":{{"a":0,"k":[100,100]}},"r":{{"a":0,"k":0}},"o":{{"a":0,"k":100}}}}]}})",
                                       name, paths, line, colourOf(fill));
}

std::string pathsOfLoops(const std::vector<Loop>& loops, const LiquidView& view)
{
    std::string paths;
    for (const BezierPath& path : pathsOf(loops, view)) {
        paths += pathOf(verticesOf(path));
    }
    return paths;
}

void append(std::string& list, const std::string& item)
{
    if (!list.empty() && !item.empty()) {
        list += ',';
    }
    list += item;
}

/// What all layers have: name, number, frames, and a place that does not change.
std::string layer(std::size_t index, const std::string& name, std::size_t begin, std::size_t end)
{
    return fmt::format(R"({{"ddd":0,"ind":{},"nm":"{}","sr":1,"ks":{{"o":{{"a":0,"k":100}},"r":{{"a":0,"k":0}},)"
                       R"("p":{{"a":0,"k":[0,0,0]}},"a":{{"a":0,"k":[0,0,0]}},"s":{{"a":0,"k":[100,100,100]}}}},)"
                       R"("ao":0,"ip":{},"op":{},"st":0,"bm":0,)",
                       index, name, begin, end);
}

}  // namespace

LiquidLottie::LiquidLottie(const LiquidView& view, LiquidLook look, double frames_per_second)
    : view_(view), look_(std::move(look)), frames_per_second_(frames_per_second)
{
    validate(view);
    require(frames_per_second > 0.0 && std::isfinite(frames_per_second), "frames_per_second", frames_per_second,
            "finite and more than 0");
}

void LiquidLottie::add(const DrawnLiquid& scene)
{
    const double width = lineWidth(look_, view_);
    std::string line;
    if (width > 0.0) {
        line = fmt::format(R"({{"ty":"st",{},"w":{{"a":0,"k":{:.4g}}},"lc":2,"lj":2}},)", colourOf(look_.line), width);
    }
    std::string shapes;
    if (look_.foam) {
        append(shapes, group("foam", pathsOfLoops(scene.shape.foam, view_), *look_.foam, line));
    }
    append(shapes, group("droplets", pathsOfLoops(scene.shape.droplets, view_), look_.droplet, line));
    append(shapes, group("liquid", pathsOfLoops(scene.shape.liquid, view_), look_.water, line));

    // Each wall is a group of its own: in one group, their overlap would be a hole.
    std::string walls;
    for (const Region& region : scene.walls) {
        std::string paths;
        for (const std::vector<Vec2>& loop : region.loops) {
            paths += pathOf(verticesOf(toPixels(loop, view_)));
        }
        append(walls, group("wall", paths, look_.wall, ""));
    }
    const std::size_t number = frames_.size();
    if (!walls_.empty() && walls_.back().end == number && walls_.back().shapes == walls) {
        ++walls_.back().end;
    } else if (!walls.empty()) {
        walls_.push_back({std::move(walls), number, number + 1});
    }
    frames_.push_back(std::move(shapes));
}

void LiquidLottie::write(std::ostream& out) const
{
    out << fmt::format(
        R"({{"v":"5.7.0","fr":{:.10g},"ip":0,"op":{},"w":{},"h":{},"nm":"liquid","ddd":0,"assets":[],"layers":[)",
        frames_per_second_, frames_.size(), view_.width, view_.height);
    std::size_t index = 0;
    const auto begin_layer = [&](const std::string& name, std::size_t begin, std::size_t end) {
        out << (index == 0 ? "\n" : ",\n");
        ++index;
        out << layer(index, name, begin, end);
    };
    for (const Span& walls : walls_) {
        begin_layer("walls", walls.begin, walls.end);
        out << R"("ty":4,"shapes":[)" << walls.shapes << "]}";
    }
    for (std::size_t k = 0; k < frames_.size(); ++k) {
        begin_layer(fmt::format("frame {}", k + 1), k, k + 1);
        out << R"("ty":4,"shapes":[)" << frames_[k] << "]}";
    }
    if (look_.background) {
        begin_layer("background", 0, frames_.size());
        const Colour colour = *look_.background;
        out << fmt::format(R"("ty":1,"sw":{},"sh":{},"sc":"#{:02x}{:02x}{:02x}"}})", view_.width, view_.height,
                           colour[0], colour[1], colour[2]);
    }
    out << "\n]}\n";
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
// Lottie Animation Format 1.0 (Lottie Animation Community), written for players from bodymovin 5.7 on.
#include "droplet/liquid2d_io/liquid_lottie.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>

#include "liquid_paths.h"
#include "require.h"

namespace droplet {
namespace {

/// Hundredths as a number of JSON, without trailing zeros.
void put(std::string& text, std::int64_t hundredths)
{
    if (hundredths < 0) {
        text += '-';
        hundredths = -hundredths;
    }
    text += std::to_string(hundredths / 100);
    if (const std::int64_t rest = hundredths % 100; rest != 0) {
        text += '.';
        text += static_cast<char>('0' + rest / 10);
        if (rest % 10 != 0) {
            text += static_cast<char>('0' + rest % 10);
        }
    }
}

/// Puts the places that a member of all vertices names, and the last vertex again up to a number.
template <typename Vertices, typename Member>
void putAll(std::string& text, const Vertices& vertices, Member member, std::size_t count, bool is_place)
{
    text += '[';
    for (std::size_t k = 0; k < count; ++k) {
        text += k == 0 ? "[" : ",[";
        if (k < vertices.size() || is_place) {
            const auto& place = vertices[std::min(k, vertices.size() - 1)].*member;
            put(text, place.x);
            text += ',';
            put(text, place.y);
        } else {
            text += "0,0";
        }
        text += ']';
    }
    text += ']';
}

std::string colourOf(Colour colour)
{
    return fmt::format(R"("c":{{"a":0,"k":[{:.4g},{:.4g},{:.4g},1]}},"o":{{"a":0,"k":100}})", colour[0] / 255.0,
                       colour[1] / 255.0, colour[2] / 255.0);
}

/// What all layers have: name, number, frames, and a place that does not change.
std::string layerHead(std::size_t index, const char* name, std::size_t end)
{
    return fmt::format(R"({{"ddd":0,"ind":{},"nm":"{}","sr":1,"ks":{{"o":{{"a":0,"k":100}},"r":{{"a":0,"k":0}},)"
                       R"("p":{{"a":0,"k":[0,0,0]}},"a":{{"a":0,"k":[0,0,0]}},"s":{{"a":0,"k":[100,100,100]}}}},)"
                       R"("ao":0,"ip":0,"op":{},"st":0,"bm":0,)",
                       index, name, end);
}

constexpr int kNonzero = 1;
constexpr int kEvenOdd = 2;

}  // namespace

LiquidLottie::Path LiquidLottie::pathOf(const BezierPath& path)
{
    const auto rounded = [](Vec2 a) { return Place{std::llround(100.0 * a.x), std::llround(100.0 * a.y)}; };
    const auto minus = [](Place a, Place b) { return Place{a.x - b.x, a.y - b.y}; };
    Path vertices;
    Place start = rounded(path.start);
    // The last curve arrives at the first vertex.
    Place arriving = rounded(path.curves.back().arriving);
    for (const BezierCurve& curve : path.curves) {
        vertices.push_back({minus(arriving, start), minus(rounded(curve.leaving), start), start});
        arriving = rounded(curve.arriving);
        start = rounded(curve.end);
    }
    return vertices;
}

LiquidLottie::Path LiquidLottie::pathOf(const std::vector<Vec2>& polygon)
{
    Path vertices;
    for (const Vec2 point : polygon) {
        vertices.push_back({{}, {}, {std::llround(100.0 * point.x), std::llround(100.0 * point.y)}});
    }
    return vertices;
}

void LiquidLottie::add(Layer& layer, const std::vector<BezierPath>& paths)
{
    std::vector<Path> frame;
    frame.reserve(paths.size());
    for (const BezierPath& path : paths) {
        frame.push_back(pathOf(path));
    }
    // The longest first, so that paths that share keyframes have about as many vertices.
    std::stable_sort(frame.begin(), frame.end(), [](const Path& a, const Path& b) { return a.size() > b.size(); });
    layer.push_back(std::move(frame));
}

std::string LiquidLottie::shapesOf(const Layer& layer, const char* name, Colour fill, int rule)
{
    std::size_t slots = 0;
    for (const std::vector<Path>& frame : layer) {
        slots = std::max(slots, frame.size());
    }
    if (slots == 0) {
        return {};
    }
    std::string text = fmt::format(R"({{"ty":"gr","nm":"{}","it":[)", name);
    const Path nothing(1);
    for (std::size_t slot = 0; slot < slots; ++slot) {
        const auto path = [&](std::size_t frame) -> const Path& {
            return slot < layer[frame].size() ? layer[frame][slot] : nothing;
        };
        std::size_t count = 0;
        bool is_still = true;
        for (std::size_t frame = 0; frame < layer.size(); ++frame) {
            count = std::max(count, path(frame).size());
            is_still = is_still && path(frame) == path(0);
        }
        const auto value = [&](const Path& vertices) {
            // Of a repeated vertex, the last copy has the handle that leaves.
            text += R"({"c":true,"i":)";
            putAll(text, vertices, &Vertex::arriving, count, false);
            text += R"(,"o":)";
            Path leaving = vertices;
            if (count > leaving.size()) {
                leaving.resize(count, Vertex{{}, {}, vertices.back().at});
                std::swap(leaving[vertices.size() - 1].leaving, leaving.back().leaving);
            }
            putAll(text, leaving, &Vertex::leaving, count, false);
            text += R"(,"v":)";
            putAll(text, vertices, &Vertex::at, count, true);
            text += '}';
        };
        if (is_still) {
            text += R"({"ty":"sh","ks":{"a":0,"k":)";
            value(path(0));
            text += "}},";
            continue;
        }
        text += R"({"ty":"sh","ks":{"a":1,"k":[)";
        for (std::size_t frame = 0; frame < layer.size(); ++frame) {
            if (frame > 0 && path(frame) == path(frame - 1)) {
                continue;
            }
            text += fmt::format(R"({}{{"t":{},"h":1,"s":[)", frame == 0 ? "" : ",", frame);
            value(path(frame));
            text += "]}";
        }
        text += "]}},";
    }
    return text + fmt::format(R"({{"ty":"fl",{},"r":{}}},{{"ty":"tr","p":{{"a":0,"k":[0,0]}},"a":{{"a":0,"k":[0,0]}},)"
                              R"("s":{{"a":0,"k":[100,100]}},"r":{{"a":0,"k":0}},"o":{{"a":0,"k":100}}}}]}})",
                              colourOf(fill), rule);
}

LiquidLottie::LiquidLottie(const LiquidView& view, LiquidLook look, double frames_per_second)
    : view_(view), look_(std::move(look)), frames_per_second_(frames_per_second)
{
    validate(view);
    require(frames_per_second > 0.0 && std::isfinite(frames_per_second), "frames_per_second", frames_per_second,
            "finite and more than 0");
}

void LiquidLottie::add(const DrawnLiquid& scene)
{
    const LiquidPaths paths = liquidPaths(scene.shape, view_, look_);
    add(liquid_, paths.liquid);
    add(droplets_, paths.droplets);
    add(foam_, paths.foam);
    add(lines_, paths.lines);
    // Each wall is a group of its own: in one group, their overlap would be a hole.
    walls_.resize(std::max(walls_.size(), scene.walls.size()), Layer(frames_));
    for (std::size_t k = 0; k < walls_.size(); ++k) {
        std::vector<Path> wall;
        if (k < scene.walls.size()) {
            for (const std::vector<Vec2>& loop : scene.walls[k].loops) {
                wall.push_back(pathOf(toPixels(loop, view_)));
            }
        }
        walls_[k].push_back(std::move(wall));
    }
    ++frames_;
}

void LiquidLottie::write(std::ostream& out) const
{
    out << fmt::format(
        R"({{"v":"5.7.0","fr":{:.10g},"ip":0,"op":{},"w":{},"h":{},"nm":"liquid","ddd":0,"assets":[],"layers":[)",
        frames_per_second_, frames_, view_.width, view_.height);
    std::size_t index = 0;
    const auto begin_layer = [&](const char* name) {
        out << (index == 0 ? "\n" : ",\n");
        ++index;
        out << layerHead(index, name, frames_);
    };
    const auto write_layer = [&](const char* name, const std::string& shapes) {
        if (!shapes.empty()) {
            begin_layer(name);
            out << R"("ty":4,"shapes":[)" << shapes << "]}";
        }
    };
    // What comes first is on top.
    std::string walls;
    for (const Layer& wall : walls_) {
        const std::string shapes = shapesOf(wall, "wall", look_.wall, kEvenOdd);
        walls += walls.empty() || shapes.empty() ? "" : ",";
        walls += shapes;
    }
    write_layer("walls", walls);
    write_layer("lines", shapesOf(lines_, "lines", look_.line, kNonzero));
    write_layer("foam", shapesOf(foam_, "foam", look_.foam.value_or(look_.water), kNonzero));
    write_layer("droplets", shapesOf(droplets_, "droplets", look_.droplet, kNonzero));
    write_layer("liquid", shapesOf(liquid_, "liquid", look_.water, kNonzero));
    if (look_.background) {
        begin_layer("background");
        const Colour colour = *look_.background;
        out << fmt::format(R"("ty":1,"sw":{},"sh":{},"sc":"#{:02x}{:02x}{:02x}"}})", view_.width, view_.height,
                           colour[0], colour[1], colour[2]);
    }
    out << "\n]}\n";
}

}  // namespace droplet

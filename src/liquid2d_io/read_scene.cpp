// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/liquid2d_io/read_scene.h"

#include <fmt/core.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>

#include "droplet/error.h"
#include "droplet/mask/mask.h"
#include "droplet/printable.h"
#include "droplet/units.h"
#include "file_bytes.h"
#include "liquid2d/region.h"
#include "number_text.h"

namespace droplet {
namespace {

class SceneFile {
public:
    explicit SceneFile(const std::filesystem::path& path) : path_(path) {}

    FluidScene read(std::string_view text)
    {
        try {
            const toml::table root = toml::parse(text);
            return scene(root);
        } catch (const toml::parse_error& error) {
            refuse(error.source().begin.line, "is not TOML: " + std::string(error.description()));
        }
    }

private:
    using Keys = std::initializer_list<std::string_view>;

    [[noreturn]] void refuse(std::size_t line, const std::string& what) const
    {
        throw Error(ErrorCode::InvalidInput, printable(fmt::format("{}:{}: {}", path_.string(), line, what)));
    }

    static std::size_t lineOf(const toml::node& node) { return node.source().begin.line; }

    /// Runs a reader of a value; its errors get the file and the line.
    template <class Read>
    auto at(const toml::node& node, const std::string& name, const Read& read) const
    {
        try {
            return read();
        } catch (const Error& error) {
            refuse(lineOf(node), name + ": " + error.what());
        }
    }

    void requireKeys(const toml::table& table, Keys known) const
    {
        std::size_t line = 0;
        std::string first;
        for (const auto& [key, value] : table) {
            if (std::find(known.begin(), known.end(), key.str()) == known.end() &&
                (first.empty() || lineOf(value) < line)) {
                line = lineOf(value);
                first = key.str();
            }
        }
        if (!first.empty()) {
            std::string all;
            for (const std::string_view key : known) {
                all += (all.empty() ? "" : ", ") + std::string(key);
            }
            refuse(line, fmt::format("unknown key '{}'; known are {}", first.substr(0, 40), all));
        }
    }

    const toml::table& tableIn(const toml::node& node, const std::string& name) const
    {
        if (!node.is_table()) {
            refuse(lineOf(node), name + " must be a table");
        }
        return *node.as_table();
    }

    std::string text(const toml::node& node, const std::string& name, std::string_view example) const
    {
        if (!node.is_string()) {
            refuse(lineOf(node), fmt::format("{} must be text in quotes, such as \"{}\"", name, example));
        }
        return *node.value<std::string>();
    }

    double quantity(const toml::node& node, const std::string& name, Dimension dimension) const
    {
        const std::string value = text(node, name, dimension == Dimension::Speed ? "2m/s" : "0.5m");
        return at(node, name, [&] { return parseQuantity(value, dimension); });
    }

    Vec2 pair(const toml::node& node, const std::string& name, Dimension dimension) const
    {
        const toml::array* values = node.as_array();
        if (values == nullptr || values->size() != 2) {
            refuse(lineOf(node), name + R"( must be a pair, such as ["1m", "0.5m"])");
        }
        return {quantity((*values)[0], name, dimension), quantity((*values)[1], name, dimension)};
    }

    void take(const toml::table& table, const char* key, Dimension dimension, double& value) const
    {
        if (const toml::node* node = table.get(key)) {
            value = quantity(*node, key, dimension);
        }
    }

    void take(const toml::table& table, const char* key, Dimension dimension, Vec2& value) const
    {
        if (const toml::node* node = table.get(key)) {
            value = pair(*node, key, dimension);
        }
    }

    const toml::node& need(const toml::table& table, const char* key, const std::string& owner) const
    {
        const toml::node* node = table.get(key);
        if (node == nullptr) {
            refuse(lineOf(table), owner + " needs " + key);
        }
        return *node;
    }

    std::vector<Vec2> points(const toml::node& node, const std::string& name) const
    {
        const toml::array* values = node.as_array();
        if (values == nullptr) {
            refuse(lineOf(node), name + R"( must be a list of points, such as [["0m", "0m"], ["1m", "0.5m"]])");
        }
        std::vector<Vec2> result;
        for (const toml::node& point : *values) {
            result.push_back(pair(point, name, Dimension::Length));
        }
        return result;
    }

    Region region(const toml::table& table, const std::string& owner) const
    {
        constexpr std::array kShapes{"box", "circle", "polygon", "mask"};
        const char* shape = nullptr;
        for (const char* key : kShapes) {
            if (table.contains(key)) {
                if (shape != nullptr) {
                    refuse(lineOf(*table.get(key)), fmt::format("{} has both {} and {}", owner, shape, key));
                }
                shape = key;
            }
        }
        if (shape == nullptr) {
            refuse(lineOf(table), owner + " needs one of box, circle, polygon and mask");
        }
        const toml::node& node = *table.get(shape);
        const bool is_mask = std::string_view(shape) == "mask";
        for (const char* key : {"at", "width"}) {
            if (!is_mask && table.contains(key)) {
                refuse(lineOf(*table.get(key)), fmt::format("{} belongs to a mask, not to a {}", key, shape));
            }
        }
        if (is_mask) {
            return masked(table, node, owner);
        }
        if (std::string_view(shape) == "circle") {
            return disc(tableIn(node, "circle"));
        }
        std::vector<Vec2> loop = points(node, shape);
        if (std::string_view(shape) == "polygon") {
            if (loop.size() < 3) {
                refuse(lineOf(node), "polygon needs three points or more");
            }
            return {{std::move(loop)}};
        }
        if (loop.size() != 2 || !(loop[0].x < loop[1].x && loop[0].y < loop[1].y)) {
            refuse(lineOf(node), "box must be its lower left and its upper right corner");
        }
        return rectangle(loop[0], loop[1]);
    }

    Region disc(const toml::table& table) const
    {
        requireKeys(table, {"at", "radius"});
        const Vec2 centre = pair(need(table, "at", "circle"), "at", Dimension::Length);
        const toml::node& node = need(table, "radius", "circle");
        const double radius = quantity(node, "radius", Dimension::Length);
        if (!(radius > 0.0)) {
            refuse(lineOf(node), "radius must be more than 0 m");
        }
        return circle(centre, radius);
    }

    Region masked(const toml::table& table, const toml::node& node, const std::string& owner) const
    {
        const std::string file = text(node, "mask", "drop.png");
        const Vec2 centre = pair(need(table, "at", owner), "at", Dimension::Length);
        TraceOptions options;
        options.width = quantity(need(table, "width", owner), "width", Dimension::Length);
        return at(node, "mask", [&] { return regionOf(trace(readMask(path_.parent_path() / file), options), centre); });
    }

    WallMotion motion(const toml::node& node) const
    {
        const toml::table& table = tableIn(node, "motion");
        requireKeys(table, {"amplitude", "swing", "pivot", "period", "phase", "begin"});
        WallMotion result;
        take(table, "amplitude", Dimension::Length, result.amplitude);
        take(table, "swing", Dimension::Angle, result.swing);
        take(table, "pivot", Dimension::Length, result.pivot);
        take(table, "period", Dimension::Duration, result.period);
        take(table, "phase", Dimension::Angle, result.phase);
        take(table, "begin", Dimension::Duration, result.begin);
        if (table.contains("swing") && !table.contains("pivot")) {
            refuse(lineOf(*table.get("swing")), "swing needs a pivot");
        }
        return result;
    }

    LiquidBody liquid(const toml::table& table) const
    {
        requireKeys(table, {"box", "circle", "polygon", "mask", "at", "width", "velocity", "spin"});
        LiquidBody body;
        body.region = region(table, "liquid");
        body.rings = table.contains("circle");
        take(table, "velocity", Dimension::Speed, body.velocity);
        if (const toml::node* node = table.get("spin")) {
            std::string value = text(*node, "spin", "90deg/s");
            if (!value.ends_with("/s")) {
                refuse(lineOf(*node), "spin must be an angle per second, such as \"90deg/s\"");
            }
            value.resize(value.size() - 2);
            body.spin = at(*node, "spin", [&] { return parseQuantity(value, Dimension::Angle); });
        }
        return body;
    }

    Wall wall(const toml::table& table) const
    {
        requireKeys(table, {"box", "circle", "polygon", "mask", "at", "width", "motion", "visible"});
        Wall result;
        result.region = region(table, "wall");
        if (const toml::node* node = table.get("motion")) {
            result.motion = motion(*node);
        }
        if (const toml::node* node = table.get("visible")) {
            if (!node->is_boolean()) {
                refuse(lineOf(*node), "visible must be true or false");
            }
            result.visible = *node->value<bool>();
        }
        return result;
    }

    Emitter emitter(const toml::table& table) const
    {
        requireKeys(table, {"position", "velocity", "width", "begin", "end"});
        Emitter result;
        result.position = pair(need(table, "position", "emitter"), "position", Dimension::Length);
        result.velocity = pair(need(table, "velocity", "emitter"), "velocity", Dimension::Speed);
        result.width = quantity(need(table, "width", "emitter"), "width", Dimension::Length);
        take(table, "begin", Dimension::Duration, result.begin);
        take(table, "end", Dimension::Duration, result.end);
        return result;
    }

    /// Calls read(table, line) for each table of a list [[key]].
    template <class Read>
    void each(const toml::table& root, const std::string& key, const Read& read) const
    {
        const toml::node* node = root.get(key);
        if (node == nullptr) {
            return;
        }
        const toml::array* list = node->as_array();
        if (list == nullptr) {
            refuse(lineOf(*node), fmt::format("{0} must be a list of tables: [[{0}]]", key));
        }
        for (const toml::node& item : *list) {
            read(tableIn(item, key), lineOf(item));
        }
    }

    FluidScene scene(const toml::table& root) const
    {
        requireKeys(root, {"size", "spacing", "gravity", "density", "surface_tension", "viscosity", "margin",
                           "max_particles", "liquid", "wall", "emitter"});
        FluidScene result;
        take(root, "size", Dimension::Length, result.size);
        take(root, "spacing", Dimension::Length, result.spacing);
        take(root, "gravity", Dimension::Acceleration, result.gravity);
        take(root, "density", Dimension::Density, result.density);
        take(root, "surface_tension", Dimension::SurfaceTension, result.surface_tension);
        take(root, "margin", Dimension::Length, result.margin);
        if (const toml::node* node = root.get("viscosity")) {
            result.viscosity = quantity(*node, "viscosity", Dimension::Viscosity) / result.density;
        }
        if (const toml::node* node = root.get("max_particles")) {
            const auto value = node->is_integer() ? *node->value<std::int64_t>() : 0;
            if (value < 1 || value > 100'000'000) {
                refuse(lineOf(*node), "max_particles must be a whole number from 1 to 100000000");
            }
            result.max_particles = static_cast<std::size_t>(value);
        }
        // Each part is checked alone, so that the message has its line.
        const auto check = [&](std::size_t line, const FluidScene& part) {
            try {
                part.validate();
                checkEmitters(part);
            } catch (const Error& error) {
                std::string said = error.what();
                for (const char* index : {"liquid[0].", "walls[0].", "emitters[0]."}) {
                    said = said.starts_with(index) ? said.substr(std::string_view(index).size()) : said;
                }
                refuse(line, said);
            }
        };
        for (const char* key : {"size", "spacing", "gravity", "density", "surface_tension", "viscosity", "margin"}) {
            if (const toml::node* node = root.get(key)) {
                FluidScene part;
                part.spacing = std::max(result.size.x, result.size.y) * 1e-2;
                const std::string_view name = key;
                if (name == "size" || name == "spacing" || name == "margin") {
                    part.size = result.size;
                    part.margin = name == "size" ? 0.0 : result.margin;
                    part.spacing = name == "size" ? part.spacing : result.spacing;
                } else {
                    part = result;
                }
                check(lineOf(*node), part);
            }
        }
        FluidScene alone;
        each(root, "liquid", [&](const toml::table& table, std::size_t line) {
            result.liquid.push_back(liquid(table));
            alone.liquid = {result.liquid.back()};
            check(line, alone);
        });
        alone.liquid.clear();
        each(root, "wall", [&](const toml::table& table, std::size_t line) {
            result.walls.push_back(wall(table));
            alone.walls = {result.walls.back()};
            check(line, alone);
        });
        alone.walls = result.walls;
        each(root, "emitter", [&](const toml::table& table, std::size_t line) {
            result.emitters.push_back(emitter(table));
            alone.emitters = {result.emitters.back()};
            check(line, alone);
        });
        check(1, result);
        return result;
    }

    const std::filesystem::path& path_;
};

/// Text of a scene's file.
/// @throws Error InvalidInput
std::string textOf(const std::filesystem::path& path)
{
    constexpr std::size_t kMaxBytes = std::size_t{1} << 24U;
    Bytes bytes;
    readFile(path, [&] {
        bytes = readBytes(path, kMaxBytes, [](std::byte) { return true; });
        if (bytes.size() == kMaxBytes) {
            throw Damage("a scene has less than 16 MiB");
        }
    });
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Adds the values of all keys `mask` in a table, as paths below a folder.
void addMasks(const toml::table& table, const std::filesystem::path& folder, std::vector<std::filesystem::path>& masks)
{
    for (const auto& [key, node] : table) {
        if (const auto mask = key == "mask" ? node.value<std::string>() : std::nullopt) {
            masks.push_back(folder / *mask);
        } else if (const toml::table* inner = node.as_table()) {
            addMasks(*inner, folder, masks);
        } else if (const toml::array* list = node.as_array()) {
            for (const toml::node& item : *list) {
                if (const toml::table* of_list = item.as_table()) {
                    addMasks(*of_list, folder, masks);
                }
            }
        }
    }
}

}  // namespace

Region regionOf(const Outline& outline, Vec2 centre)
{
    Region region;
    for (const Loop& loop : outline.loops) {
        std::vector<Vec2>& points = region.loops.emplace_back(loop.points);
        for (Vec2& point : points) {
            point = point + centre;
        }
    }
    return region;
}

std::optional<std::size_t> wallInOpening(const Emitter& emitter, const std::vector<Wall>& walls)
{
    constexpr int kSamples = 32;
    const double speed = length(emitter.velocity);
    const Vec2 across = emitter.width / speed * Vec2{-emitter.velocity.y, emitter.velocity.x};
    for (std::size_t w = 0; w < walls.size(); ++w) {
        for (int k = 0; k < kSamples; ++k) {
            if (contains(walls[w].region, emitter.position + ((k + 0.5) / kSamples - 0.5) * across)) {
                return w;
            }
        }
    }
    return std::nullopt;
}

void checkEmitters(const FluidScene& scene)
{
    for (std::size_t k = 0; k < scene.emitters.size(); ++k) {
        if (const std::optional<std::size_t> wall = wallInOpening(scene.emitters[k], scene.walls)) {
            const Vec2 at = scene.emitters[k].position;
            throw Error(ErrorCode::InvalidInput, fmt::format("emitter {} at ({} m, {} m) opens in wall {}", k + 1,
                                                             numberText(at.x), numberText(at.y), *wall + 1));
        }
    }
}

FluidScene parseFluidScene(std::string_view text, const std::filesystem::path& path)
{
    return SceneFile(path).read(text);
}

std::vector<std::filesystem::path> masksOfScene(const std::filesystem::path& path)
{
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
        return {};  // a pipe can be read only once
    }
    try {
        std::vector<std::filesystem::path> masks;
        addMasks(toml::parse(textOf(path)), path.parent_path(), masks);
        return masks;
    } catch (const toml::parse_error&) {
        return {};
    } catch (const Error&) {
        return {};
    }
}

FluidScene readFluidScene(const std::filesystem::path& path)
{
    return parseFluidScene(textOf(path), path);
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "droplet/vector.h"

namespace droplet::testing {

/// Transform of a droplet's mesh: x along its motion, y off the ground.
struct Shown {
    Vec3 place;
    Vec3 x;
    Vec3 y;
    Vec3 scale;
    std::size_t slot = 0;
    std::string mesh;  ///< name
};

/// Reader of an animated scene of droplets: evaluates its animation as viewers do.
class AnimatedScene {
public:
    explicit AnimatedScene(const std::string& glb)
    {
        std::uint32_t length = 0;
        std::memcpy(&length, glb.data() + 12, 4);
        json_ = nlohmann::json::parse(glb.substr(20, length));
        buffer_ = glb.substr(28 + length);
        const nlohmann::json& nodes = json_.at("nodes");
        for (std::size_t node = 0; node < nodes.size(); ++node) {
            for (const std::size_t child : nodes[node].value("children", std::vector<std::size_t>())) {
                parents_[child] = node;
            }
        }
        for (const nlohmann::json& animation : json_.value("animations", nlohmann::json::array())) {
            for (const nlohmann::json& channel : animation.at("channels")) {
                const nlohmann::json& sampler = animation.at("samplers").at(channel.at("sampler").get<std::size_t>());
                Track& track = tracks_[{channel.at("target").at("node"), channel.at("target").at("path")}];
                track.steps = sampler.at("interpolation") == "STEP";
                track.times = array(sampler.at("input"));
                track.values = array(sampler.at("output"));
            }
        }
        for (const nlohmann::json& node : nodes) {
            if (!node.contains("skin")) {
                continue;
            }
            const nlohmann::json& skin = json_.at("skins").at(node.at("skin").get<std::size_t>());
            const auto joints = skin.at("joints").get<std::vector<std::size_t>>();
            joints_.insert(joints_.end(), joints.begin(), joints.end() - 2);  // without the corners of the scene
            meshes_.resize(joints_.size(), node.at("name"));
        }
    }

    [[nodiscard]] const nlohmann::json& model() const { return json_; }
    /// Joints that ever show a droplet.
    [[nodiscard]] std::size_t pool() const
    {
        return static_cast<std::size_t>(std::count_if(joints_.begin(), joints_.end(), [&](std::size_t joint) {
            return tracks_.count({joint, "scale"}) > 0 || at(joint, "scale", 0.0)[0] > 0.0;
        }));
    }

    [[nodiscard]] std::vector<Shown> at(double time) const
    {
        std::vector<Shown> all;
        for (std::size_t k = 0; k < joints_.size(); ++k) {
            const std::vector<double> s = at(joints_[k], "scale", time);
            if (s[0] == 0.0) {
                continue;
            }
            const std::vector<double> t = at(joints_[k], "translation", time);
            Shown one{{t[0], t[1], t[2]}, {1, 0, 0}, {0, 1, 0}, {s[0], s[1], s[2]}, k, meshes_[k]};
            turn(one, at(joints_[k], "rotation", time), false);
            for (auto up = parents_.find(joints_[k]); up != parents_.end(); up = parents_.find(up->second)) {
                turn(one, at(up->second, "rotation", time), true);
                const std::vector<double> shift = at(up->second, "translation", time);
                one.place = one.place + Vec3{shift[0], shift[1], shift[2]};
            }
            all.push_back(one);
        }
        return all;
    }

    /// Translation, rotation or scale of a node.
    [[nodiscard]] std::vector<double> at(std::size_t node, const std::string& path, double time) const
    {
        const auto found = tracks_.find({node, path});
        if (found == tracks_.end()) {
            const std::vector<double> otherwise = path == "scale"      ? std::vector<double>{1, 1, 1}
                                                  : path == "rotation" ? std::vector<double>{0, 0, 0, 1}
                                                                       : std::vector<double>{0, 0, 0};
            return json_.at("nodes").at(node).value(path, otherwise);
        }
        const Track& track = found->second;
        std::size_t key = 0;
        while (key + 1 < track.times.size() && track.times[key + 1][0] <= time) {
            ++key;
        }
        std::vector<double> value = track.values[key];
        if (!track.steps && key + 1 < track.times.size() && time > track.times[key][0]) {
            const double share = (time - track.times[key][0]) / (track.times[key + 1][0] - track.times[key][0]);
            for (std::size_t i = 0; i < value.size(); ++i) {
                value[i] += share * (track.values[key + 1][i] - value[i]);
            }
        }
        return value;
    }

    /// A droplet's mesh in its own frame, without compression.
    struct Shape {
        std::vector<Vec3> vertices;
        std::vector<std::array<std::size_t, 3>> triangles;
    };
    /// A mesh that is not one of droplets.
    [[nodiscard]] Shape meshOf(std::size_t mesh) const
    {
        Shape shape;
        const nlohmann::json& primitive = json_.at("meshes").at(mesh).at("primitives").at(0);
        for (const std::vector<double>& p : array(primitive.at("attributes").at("POSITION"))) {
            shape.vertices.push_back({p[0], p[1], p[2]});
        }
        const auto corners = array(primitive.at("indices"));
        for (std::size_t c = 0; c + 2 < corners.size(); c += 3) {
            const auto at = [&](std::size_t k) { return static_cast<std::size_t>(corners[c + k][0]); };
            shape.triangles.push_back({at(0), at(1), at(2)});
        }
        return shape;
    }

    /// Change of such a mesh's vertices by a weight of 1.
    [[nodiscard]] std::vector<Vec3> changeOf(std::size_t mesh, std::size_t target) const
    {
        std::vector<Vec3> change;
        const nlohmann::json& primitive = json_.at("meshes").at(mesh).at("primitives").at(0);
        for (const std::vector<double>& p : array(primitive.at("targets").at(target).at("POSITION"))) {
            change.push_back({p[0], p[1], p[2]});
        }
        return change;
    }

    /// Shapes of all slots.
    [[nodiscard]] std::vector<Shape> shapes() const
    {
        std::vector<Shape> shapes;
        for (const nlohmann::json& node : json_.at("nodes")) {
            if (!node.contains("skin")) {
                continue;
            }
            const std::size_t first = shapes.size();
            const nlohmann::json& skin = json_.at("skins").at(node.at("skin").get<std::size_t>());
            shapes.resize(first + skin.at("joints").size() - 2);
            const nlohmann::json& primitive =
                json_.at("meshes").at(node.at("mesh").get<std::size_t>()).at("primitives").at(0);
            const nlohmann::json& attributes = primitive.at("attributes");
            const auto vertices = array(attributes.at("POSITION"));
            const auto joints = array(attributes.at("JOINTS_0"));
            const auto slot = [&](std::size_t v) { return first + static_cast<std::size_t>(joints[v][0]); };
            std::vector<std::size_t> numbers(vertices.size());
            for (std::size_t v = 0; v < vertices.size(); ++v) {
                if (slot(v) < shapes.size()) {
                    numbers[v] = shapes[slot(v)].vertices.size();
                    shapes[slot(v)].vertices.push_back({vertices[v][0], vertices[v][1], vertices[v][2]});
                }
            }
            const auto corners = array(primitive.at("indices"));
            for (std::size_t c = 0; c + 2 < corners.size(); c += 3) {
                const auto at = [&](std::size_t k) { return static_cast<std::size_t>(corners[c + k][0]); };
                shapes[slot(at(0))].triangles.push_back({numbers[at(0)], numbers[at(1)], numbers[at(2)]});
            }
        }
        return shapes;
    }

    /// The only picture of the file.
    [[nodiscard]] std::string png() const
    {
        const nlohmann::json& view =
            json_.at("bufferViews").at(json_.at("images").at(0).at("bufferView").get<std::size_t>());
        return buffer_.substr(view.at("byteOffset"), view.at("byteLength"));
    }

private:
    struct Track {
        bool steps = false;
        std::vector<std::vector<double>> times;
        std::vector<std::vector<double>> values;
    };

    [[nodiscard]] std::vector<std::vector<double>> array(std::size_t accessor) const
    {
        const nlohmann::json& one = json_.at("accessors").at(accessor);
        const std::string type = one.at("type");
        const std::size_t width = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : 4;
        const std::size_t offset =
            json_.at("bufferViews").at(one.at("bufferView").get<std::size_t>()).value("byteOffset", std::size_t{0}) +
            one.value("byteOffset", std::size_t{0});
        std::vector<std::vector<double>> rows(one.at("count").get<std::size_t>(), std::vector<double>(width));
        for (std::size_t i = 0; i < width * rows.size(); ++i) {
            const auto number = [&](auto kind) {
                std::memcpy(&kind, buffer_.data() + offset + sizeof kind * i, sizeof kind);
                return static_cast<double>(kind);
            };
            switch (one.at("componentType").get<int>()) {
                case 5121:
                    rows[i / width][i % width] = number(std::uint8_t{});
                    break;
                case 5122:
                    rows[i / width][i % width] = number(std::int16_t{}) / 32767.0;
                    break;
                case 5123:
                    rows[i / width][i % width] = number(std::uint16_t{});
                    break;
                default:
                    rows[i / width][i % width] = number(float{});
            }
        }
        return rows;
    }

    static void turn(Shown& one, const std::vector<double>& q, bool with_place)
    {
        const auto turned = [&](Vec3 v) {
            const Vec3 u{q[0], q[1], q[2]};
            const Vec3 t = 2.0 * cross(u, v);
            return v + q[3] * t + cross(u, t);
        };
        one.x = turned(one.x);
        one.y = turned(one.y);
        one.place = with_place ? turned(one.place) : one.place;
    }

    nlohmann::json json_;
    std::string buffer_;
    std::map<std::size_t, std::size_t> parents_;
    std::map<std::pair<std::size_t, std::string>, Track> tracks_;
    std::vector<std::size_t> joints_;
    std::vector<std::string> meshes_;  ///< of the joints
};

}  // namespace droplet::testing

// SPDX-License-Identifier: GPL-3.0-or-later
// Khronos Group, "glTF 2.0 Specification" (2021), section 3.11, animations.
#include "droplet/wind_io/droplet_scene.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "io/axes.h"
#include "io/byte_stream.h"
#include "io/gltf_model.h"
#include "require.h"

namespace droplet {
namespace {

constexpr std::array<float, 3> kGone{0.0F, 0.0F, 0.0F};

/// Where, which way and how large a droplet is at a time.
struct Key {
    float time = 0.0F;
    std::array<float, 3> translation{};
    std::array<float, 4> rotation{};
    std::array<float, 3> scale = kGone;

    [[nodiscard]] bool sameBut(const Key& other) const
    {
        return translation == other.translation && rotation == other.rotation && scale == other.scale;
    }
};

/// A droplet's life.
struct Track {
    std::vector<Key> keys;
    std::size_t last_frame = 0;  ///< in which it was
};

/// From the vehicle's frame, y ahead, to the file's, whose front is +Z once it is +Y up: half a turn.
Vec3 turned(Vec3 v)
{
    return {0.0 - v.x, 0.0 - v.y, v.z};
}

/// A mesh's arrays.
struct Net {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;
    std::vector<Triangle> triangles;
};

/// A cap of contact radius 1 with its base, z up.
Net capNet(double angle)
{
    constexpr std::uint32_t kAround = 24;
    constexpr std::uint32_t kRings = 9;
    Net net;
    const double radius = 1.0 / std::sin(angle);
    const double centre = -radius * std::cos(angle);
    net.positions.push_back({0.0, 0.0, radius + centre});
    net.normals.push_back({0.0, 0.0, 1.0});
    const auto around = [](std::uint32_t k) { return 2.0 * std::numbers::pi * (k % kAround) / kAround; };
    for (std::uint32_t ring = 1; ring <= kRings; ++ring) {
        const double tilt = angle * ring / kRings;
        for (std::uint32_t k = 0; k < kAround; ++k) {
            const Vec3 normal{std::sin(tilt) * std::cos(around(k)), std::sin(tilt) * std::sin(around(k)),
                              std::cos(tilt)};
            net.normals.push_back(normal);
            net.positions.push_back(radius * normal + Vec3{0.0, 0.0, centre});
            if (ring == kRings) {
                net.positions.back().z = 0.0;  // exactly on the glass
            }
        }
    }
    for (std::uint32_t k = 0; k < kAround; ++k) {
        const std::uint32_t next = (k + 1) % kAround;
        net.triangles.push_back({0, 1 + k, 1 + next});
        for (std::uint32_t ring = 0; ring + 1 < kRings; ++ring) {
            const std::uint32_t upper = 1 + ring * kAround;
            const std::uint32_t lower = upper + kAround;
            net.triangles.push_back({upper + k, lower + k, lower + next});
            net.triangles.push_back({upper + k, lower + next, upper + next});
        }
    }
    // The base, where the droplet stands on the glass.
    const auto first = static_cast<std::uint32_t>(net.positions.size());
    net.positions.push_back({0.0, 0.0, 0.0});
    net.normals.push_back({0.0, 0.0, -1.0});
    for (std::uint32_t k = 0; k < kAround; ++k) {
        net.positions.push_back({std::cos(around(k)), std::sin(around(k)), 0.0});
        net.normals.push_back({0.0, 0.0, -1.0});
    }
    for (std::uint32_t k = 0; k < kAround; ++k) {
        net.triangles.push_back({first, first + 1 + (k + 1) % kAround, first + 1 + k});
    }
    return net;
}

Net glassNet(const Glass& glass)
{
    constexpr int kAcross = 64;
    constexpr int kUpward = 32;
    Net net;
    std::map<std::pair<int, int>, std::uint32_t> knots;
    for (int j = 0; j <= kUpward; ++j) {
        for (int i = 0; i <= kAcross; ++i) {
            if (const auto place = glass.place({glass.width() * i / kAcross, glass.height() * j / kUpward})) {
                knots[{i, j}] = static_cast<std::uint32_t>(net.positions.size());
                net.positions.push_back(turned(place->point));
                net.normals.push_back(turned(place->normal));
            }
        }
    }
    for (int j = 0; j < kUpward; ++j) {
        for (int i = 0; i < kAcross; ++i) {
            const auto a = knots.find({i, j});
            const auto b = knots.find({i + 1, j});
            const auto c = knots.find({i + 1, j + 1});
            const auto d = knots.find({i, j + 1});
            if (a != knots.end() && b != knots.end() && c != knots.end() && d != knots.end()) {
                // Seen from inside x goes right and y up, so from outside this is counter-clockwise the other way
                // round.
                net.triangles.push_back({a->second, c->second, b->second});
                net.triangles.push_back({a->second, d->second, c->second});
            }
        }
    }
    return net;
}

/// The quaternion of a turn that takes the axes x, y and z to these, x first, w last.
std::array<double, 4> quaternion(Vec3 x, Vec3 y, Vec3 z)
{
    // S. W. Shepperd, "Quaternion from rotation matrix", J. Guidance and Control 1 (1978) 223: the largest first.
    const double trace = x.x + y.y + z.z;
    const std::array<double, 4> squares{1.0 + 2.0 * x.x - trace, 1.0 + 2.0 * y.y - trace, 1.0 + 2.0 * z.z - trace,
                                        1.0 + trace};
    const auto most = static_cast<std::size_t>(std::max_element(squares.begin(), squares.end()) - squares.begin());
    const double s = 0.5 / std::sqrt(squares[most]);
    const double xy = x.y + y.x;
    const double yz = y.z + z.y;
    const double zx = z.x + x.z;
    const double wx = y.z - z.y;
    const double wy = z.x - x.z;
    const double wz = x.y - y.x;
    switch (most) {
        case 0:
            return {s * squares[0], s * xy, s * zx, s * wx};
        case 1:
            return {s * xy, s * squares[1], s * yz, s * wy};
        case 2:
            return {s * zx, s * yz, s * squares[2], s * wz};
        default:
            return {s * wx, s * wy, s * wz, s * squares[3]};
    }
}

std::array<float, 3> floats(Vec3 v)
{
    return {toFloat(v.x), toFloat(v.y), toFloat(v.z)};
}

}  // namespace

struct DropletScene::Content {
    Glass glass;
    DropletSceneOptions options;
    Net cap;
    Net pane;
    std::map<std::uint64_t, Track> tracks;  ///< by id
    std::size_t frames = 0;
    std::size_t keys = 0;

    [[nodiscard]] float timeOf(std::size_t frame) const
    {
        return toFloat(static_cast<double>(frame) / options.frames_per_second);
    }

    [[nodiscard]] Key keyOf(const RunningDroplet& droplet, const GlassPlace& place, const Track& track) const
    {
        const double speed = length(droplet.velocity);
        const RunningShape rest = runningShape(droplet.volume, 0.0, options.shape);
        const RunningShape shape = runningShape(droplet.volume, speed, options.shape);
        const double longer = std::pow((shape.half_length + shape.contact_radius) / shape.contact_radius, 2.0 / 3.0);
        const double narrower = 1.0 / std::sqrt(longer);
        Key key;
        key.time = timeOf(frames);
        key.translation = floats(yUp(turned(place.point)));
        // Along its width a droplet at rest is the same all around: it stays as it was turned.
        if (speed > 0.0 || track.keys.empty()) {
            const Vec2 along = speed > 0.0 ? (1.0 / speed) * droplet.velocity : Vec2{1.0, 0.0};
            const Vec3 x = yUp(turned(along.x * place.across + along.y * place.up));
            const Vec3 y = yUp(turned(place.normal));
            // across, up and normal are left-handed; a turn is made of the way, the normal and what is square to both.
            std::array<double, 4> turn = quaternion(x, y, cross(x, y));
            if (!track.keys.empty()) {
                double cosine = 0.0;
                for (std::size_t i = 0; i < 4; ++i) {
                    cosine += turn[i] * static_cast<double>(track.keys.back().rotation[i]);
                }
                if (cosine < 0.0) {  // the same turn, the short way from the one before
                    for (double& number : turn) {
                        number = -number;
                    }
                }
            }
            for (std::size_t i = 0; i < 4; ++i) {
                key.rotation[i] = toFloat(turn[i]);
            }
        } else {
            key.rotation = track.keys.back().rotation;
        }
        key.scale =
            floats({rest.contact_radius * longer, rest.contact_radius * narrower, rest.contact_radius * narrower});
        return key;
    }

    void put(Track& track, const Key& key)
    {
        track.keys.push_back(key);
        ++keys;
    }

    /// Ends a life that is not in this frame.
    void end(Track& track, std::size_t frame)
    {
        if (track.keys.empty() || track.keys.back().scale == kGone) {
            return;
        }
        Key key = track.keys.back();
        key.time = timeOf(frame);
        key.scale = kGone;
        put(track, key);
    }

    void add(const WindshieldState& state)
    {
        for (const RunningDroplet& droplet : state.droplets) {
            const auto place = glass.place(droplet.position);
            if (!place) {
                continue;
            }
            Track& track = tracks[droplet.id];
            Key key = keyOf(droplet, *place, track);
            if (track.keys.empty()) {
                if (frames > 0) {
                    Key before = key;
                    before.time = 0.0F;
                    before.scale = kGone;
                    put(track, before);
                }
                put(track, key);
            } else if (!key.sameBut(track.keys.back())) {
                // What has not changed for a while does not begin to do so before now.
                const float before = timeOf(frames - 1);
                if (track.keys.back().time < before) {
                    Key still = track.keys.back();
                    still.time = before;
                    put(track, still);
                }
                put(track, key);
            }
            track.last_frame = frames;
        }
        for (auto& [id, track] : tracks) {
            if (track.last_frame != frames) {
                end(track, frames);
            }
        }
        ++frames;
        checkSize();
    }

    void checkSize() const
    {
        // Numbers of the keys, and as much JSON for a node with three channels. While a file is made, memory takes
        // some fifteen times as much.
        constexpr std::uint64_t kKey = sizeof(Key);
        constexpr std::uint64_t kNode = 1800;
        constexpr std::uint64_t kMost = std::uint64_t{1} << 27;
        const std::uint64_t bytes = kKey * keys + kNode * tracks.size();
        if (bytes >= kMost) {
            throw Error(
                ErrorCode::InvalidArgument,
                std::to_string(frames) + " frames of " + std::to_string(tracks.size()) +
                    " droplets would make a glTF file of about " + std::to_string(bytes) +
                    " bytes; it must stay below 128 MiB: ask for less time, fewer frames a second or less rain");
        }
    }

    static int addNet(tinygltf::Model& model, const Net& net, const char* name, int material)
    {
        tinygltf::Primitive primitive;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.material = material;
        primitive.attributes["POSITION"] = addVertexArray(model, TINYGLTF_TYPE_VEC3, net.positions.size());
        addBounds(model.accessors.back(), net.positions);
        primitive.attributes["NORMAL"] = addVertexArray(model, TINYGLTF_TYPE_VEC3, net.normals.size());
        primitive.indices = addIndices(model, net.triangles.size(), net.positions.size());
        tinygltf::Mesh mesh;
        mesh.name = name;
        mesh.primitives.push_back(std::move(primitive));
        model.meshes.push_back(std::move(mesh));
        return static_cast<int>(model.meshes.size()) - 1;
    }

    static int addGlass(tinygltf::Model& model)
    {
        tinygltf::Material glass;
        glass.name = "glass";
        glass.alphaMode = "BLEND";
        glass.doubleSided = true;
        glass.pbrMetallicRoughness.baseColorFactor = {0.85, 0.95, 0.92, 0.15};
        glass.pbrMetallicRoughness.metallicFactor = 0.0;
        glass.pbrMetallicRoughness.roughnessFactor = 0.05;
        model.materials.push_back(std::move(glass));
        return static_cast<int>(model.materials.size()) - 1;
    }

    [[nodiscard]] tinygltf::Model model() const
    {
        // Liquid of a droplet is as thick as the unit cap in the mesh's own measure; viewers scale it with the node.
        tinygltf::Model model = makeBareModel(options.material, 1.0, true);
        tinygltf::Scene scene;
        const int droplet = addNet(model, cap, "droplet", 0);
        tinygltf::Node glass_node;
        glass_node.name = "glass";
        glass_node.mesh = addNet(model, pane, "glass", addGlass(model));
        scene.nodes.push_back(0);
        model.nodes.push_back(std::move(glass_node));
        for (const auto& [id, track] : tracks) {
            tinygltf::Node node;
            node.name = "droplet " + std::to_string(id);
            node.mesh = droplet;
            const Key& first = track.keys.front();
            node.translation.assign(first.translation.begin(), first.translation.end());
            node.rotation.assign(first.rotation.begin(), first.rotation.end());
            node.scale.assign(first.scale.begin(), first.scale.end());
            scene.nodes.push_back(static_cast<int>(model.nodes.size()));
            model.nodes.push_back(std::move(node));
        }
        model.scenes.push_back(std::move(scene));
        model.defaultScene = 0;
        if (frames > 1 &&
            std::any_of(tracks.begin(), tracks.end(), [](const auto& one) { return changes(one.second); })) {
            model.animations.emplace_back().name = "rain";
            int node = 1;
            for (const auto& [id, track] : tracks) {
                addTrack(model, node++, track);
            }
        }
        return model;
    }

    /// Calls take(path, type, interpolation, part) for what changes of a droplet, part(key) being its numbers.
    template <typename Take>
    static void forChanging(const Track& track, const Take& take)
    {
        const auto offer = [&](const char* path, int type, const char* interpolation, const auto& part) {
            const auto& keys = track.keys;
            if (std::any_of(keys.begin(), keys.end(),
                            [&](const Key& key) { return part(key) != part(keys.front()); })) {
                take(path, type, interpolation, part);
            }
        };
        offer("translation", TINYGLTF_TYPE_VEC3, "LINEAR", [](const Key& key) { return key.translation; });
        offer("rotation", TINYGLTF_TYPE_VEC4, "LINEAR", [](const Key& key) { return key.rotation; });
        offer("scale", TINYGLTF_TYPE_VEC3, "STEP", [](const Key& key) { return key.scale; });
    }

    static bool changes(const Track& track)
    {
        bool found = false;
        forChanging(track, [&](auto&&...) { found = true; });
        return found;
    }

    static void addTrack(tinygltf::Model& model, int node, const Track& track)
    {
        if (!changes(track)) {
            return;
        }
        const auto add_floats = [&](int type) {
            return addArray(model, 0, TINYGLTF_COMPONENT_TYPE_FLOAT, type, track.keys.size());
        };
        const int times = add_floats(TINYGLTF_TYPE_SCALAR);
        model.accessors.back().minValues = {track.keys.front().time};
        model.accessors.back().maxValues = {track.keys.back().time};
        tinygltf::Animation& animation = model.animations.front();
        forChanging(track, [&](const char* path, int type, const char* interpolation, const auto& /*part*/) {
            tinygltf::AnimationSampler sampler;
            sampler.input = times;
            sampler.output = add_floats(type);
            sampler.interpolation = interpolation;
            tinygltf::AnimationChannel channel;
            channel.sampler = static_cast<int>(animation.samplers.size());
            channel.target_node = node;
            channel.target_path = path;
            animation.samplers.push_back(std::move(sampler));
            animation.channels.push_back(std::move(channel));
        });
    }

    static void writeNet(const Net& net, ByteStream& bytes)
    {
        writeVectors(net.positions, bytes);
        writeVectors(net.normals, bytes);
        writeIndices(net.triangles, net.positions.size(), bytes);
        if (net.positions.size() < kVerticesBeyond16Bit && net.triangles.size() % 2 != 0) {
            bytes.u16(0);  // to the next word
        }
    }

    /// In the order of the model's arrays.
    void writeBuffer(ByteStream& bytes) const
    {
        writeNet(cap, bytes);
        writeNet(pane, bytes);
        if (frames <= 1) {
            return;
        }
        for (const auto& entry : tracks) {
            const Track& track = entry.second;
            if (!changes(track)) {
                continue;
            }
            for (const Key& key : track.keys) {
                bytes.f32(key.time);
            }
            forChanging(track,
                        [&](const char* /*path*/, int /*type*/, const char* /*interpolation*/, const auto& part) {
                            for (const Key& key : track.keys) {
                                for (const float number : part(key)) {
                                    bytes.f32(number);
                                }
                            }
                        });
        }
    }
};

void DropletSceneOptions::validate() const
{
    require(frames_per_second > 0.0 && std::isfinite(frames_per_second), "frames_per_second", frames_per_second,
            "finite and more than 0");
    shape.validate();
}

DropletScene::DropletScene(const Glass& glass, const DropletSceneOptions& options)
{
    options.validate();
    content_ = std::make_unique<Content>();
    content_->glass = glass;
    content_->options = options;
    content_->cap = capNet(options.shape.contact_angle);
    content_->pane = glassNet(glass);
}

DropletScene::~DropletScene() = default;
DropletScene::DropletScene(DropletScene&&) noexcept = default;
DropletScene& DropletScene::operator=(DropletScene&&) noexcept = default;

void DropletScene::add(const WindshieldState& state)
{
    content_->add(state);
}

std::uint64_t DropletScene::write(std::ostream& out) const
{
    if (content_->frames == 0) {
        throw Error(ErrorCode::InvalidArgument, "a scene of droplets must have at least one frame");
    }
    return writeBinary(out, content_->model(), [&](ByteStream& bytes) { content_->writeBuffer(bytes); });
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
// Khronos Group, "glTF 2.0 Specification" (2021), sections 3.7.2.2, morph targets, and 3.11, animations.
#include "droplet/io/animation.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "io/axes.h"
#include "io/byte_stream.h"
#include "io/gltf_model.h"
#include "require.h"

namespace droplet {
namespace {

/// Viewers keep morph targets in layers of a texture; 256 layers are guaranteed. They keep the weights in uniforms; a
/// quarter of that number is always free.
constexpr std::size_t kMaxTargets = 64;

using Floats = std::vector<float>;

/// File data of one vector per vertex.
struct Array {
    Floats numbers;
    std::array<double, 3> low{};
    std::array<double, 3> high{};
};

/// @param from  base values to which the array is a difference; empty: none
Array arrayOf(const std::vector<Vec3>& vectors, const Floats& from)
{
    Array array;
    array.low.fill(std::numeric_limits<double>::infinity());
    array.high.fill(-std::numeric_limits<double>::infinity());
    array.numbers.reserve(3 * vectors.size());
    for (const Vec3& vector : vectors) {
        const Vec3 up = yUp(vector);
        for (const double value : {up.x, up.y, up.z}) {
            const std::size_t i = array.numbers.size();
            const float number = toFloat(from.empty() ? value : value - static_cast<double>(from[i]));
            array.numbers.push_back(number);
            array.low[i % 3] = std::min(array.low[i % 3], static_cast<double>(number));
            array.high[i % 3] = std::max(array.high[i % 3], static_cast<double>(number));
        }
    }
    return array;
}

struct Shape {
    Array positions;
    Array normals;
};

/// Frames with the same triangles.
struct Run {
    std::size_t first = 0;                ///< index of the first frame
    std::optional<std::size_t> end = {};  ///< index of the first frame after the run; empty: to the end
    Shape base;
    Floats uvs;
    std::vector<Triangle> triangles;
    std::vector<Shape> targets;  ///< later frames, as differences from the base

    [[nodiscard]] std::size_t vertices() const { return base.positions.numbers.size() / 3; }
};

std::uint64_t bytesOfTarget(std::size_t vertices)
{
    return 6 * sizeof(float) * vertices;
}

std::uint64_t bytesOf(const Run& run)
{
    const std::uint64_t index = run.vertices() >= kVerticesBeyond16Bit ? 4 : 2;
    return 8 * sizeof(float) * run.vertices() + bytesOfTarget(run.vertices()) * run.targets.size() +
           3 * index * run.triangles.size();
}

[[noreturn]] void refuseSize(std::size_t frames, const std::string& about, std::uint64_t bytes)
{
    throw Error(ErrorCode::InvalidArgument, std::to_string(frames) + " frames would make a glTF file of " + about +
                                                std::to_string(bytes) +
                                                " bytes; it must stay below 2 GiB: ask for fewer triangles or frames");
}

/// Keyframes of an animation channel.
struct Track {
    Floats times;
    Floats values;
};

int addFloats(tinygltf::Model& model, int type, std::size_t count)
{
    return addArray(model, 0, TINYGLTF_COMPONENT_TYPE_FLOAT, type, count);
}

void addArrayBounds(tinygltf::Accessor& accessor, const Array& array)
{
    accessor.minValues.assign(array.low.begin(), array.low.end());
    accessor.maxValues.assign(array.high.begin(), array.high.end());
}

}  // namespace

struct Animation::Content {
    AnimationOptions options;
    std::vector<Run> runs;
    std::size_t frames = 0;
    std::size_t surfaces = 0;  ///< number of frames with a surface
    double thickness = 0.0;    ///< sum over all frames [m]

    [[nodiscard]] bool shownToTheEnd(const Run& run) const { return run.end.value_or(frames) == frames; }
    [[nodiscard]] float timeOf(std::size_t frame) const
    {
        return toFloat(static_cast<double>(frame) / options.frames_per_second);
    }

    /// Keyframes that show and hide the k-th run.
    [[nodiscard]] Track visibility(std::size_t k) const
    {
        Track track;
        const auto key = [&](std::size_t frame, float shown) {
            track.times.push_back(timeOf(frame));
            track.values.insert(track.values.end(), 3, shown);
        };
        if (runs[k].first > 0) {
            key(0, 0.0F);
        }
        key(runs[k].first, 1.0F);
        if (!shownToTheEnd(runs[k])) {
            key(*runs[k].end, 0.0F);
        }
        if (k + 1 == runs.size()) {
            key(frames, shownToTheEnd(runs[k]) ? 1.0F : 0.0F);
        }
        return track;
    }

    /// Keyframes that select a frame of the k-th run.
    [[nodiscard]] Track weights(std::size_t k) const
    {
        const std::size_t targets = runs[k].targets.size();
        Track track;
        const auto key = [&](std::size_t frame, std::size_t shown) {
            track.times.push_back(timeOf(frame));
            for (std::size_t i = 1; i <= targets; ++i) {
                track.values.push_back(i == shown ? 1.0F : 0.0F);
            }
        };
        for (std::size_t i = 0; i <= targets; ++i) {
            key(runs[k].first + i, i);
        }
        if (shownToTheEnd(runs[k])) {
            key(frames, targets);
        }
        return track;
    }

    void checkSize() const
    {
        std::uint64_t bytes = 0;
        for (const Run& run : runs) {
            bytes += bytesOf(run);
        }
        if (bytes >= kGltfFileLimit) {
            refuseSize(frames, "more than ", bytes);
        }
        // The first frame predicts the size of the others to about a tenth.
        constexpr double kSurely = 0.8;
        if (surfaces == 1 && options.frames) {
            const std::uint64_t expected = bytes + bytesOfTarget(runs[0].vertices()) * (*options.frames - frames);
            if (kSurely * static_cast<double>(expected) >= static_cast<double>(kGltfFileLimit)) {
                refuseSize(*options.frames, "about ", expected);
            }
        }
    }

    void endRun(std::size_t frame)
    {
        if (!runs.empty() && !runs.back().end) {
            runs.back().end = frame;
        }
    }

    void begin(const Surface& surface, std::size_t frame)
    {
        endRun(frame);
        Run run;
        run.first = frame;
        run.base = {arrayOf(surface.positions, {}), arrayOf(surface.normals, {})};
        for (const Vec2& uv : surface.uvs) {
            run.uvs.push_back(toFloat(uv.x));
            run.uvs.push_back(toFloat(uv.y));
        }
        run.triangles = surface.triangles;
        runs.push_back(std::move(run));
    }

    static int addMesh(tinygltf::Model& model, const Run& run)
    {
        tinygltf::Primitive primitive;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.material = 0;
        primitive.attributes["POSITION"] = addVertexArray(model, TINYGLTF_TYPE_VEC3, run.vertices());
        addArrayBounds(model.accessors.back(), run.base.positions);
        primitive.attributes["NORMAL"] = addVertexArray(model, TINYGLTF_TYPE_VEC3, run.vertices());
        primitive.attributes["TEXCOORD_0"] = addVertexArray(model, TINYGLTF_TYPE_VEC2, run.vertices());
        tinygltf::Value::Array names;
        for (std::size_t i = 0; i < run.targets.size(); ++i) {
            std::map<std::string, int>& target = primitive.targets.emplace_back();
            target["POSITION"] = addVertexArray(model, TINYGLTF_TYPE_VEC3, run.vertices());
            addArrayBounds(model.accessors.back(), run.targets[i].positions);
            target["NORMAL"] = addVertexArray(model, TINYGLTF_TYPE_VEC3, run.vertices());
            names.emplace_back("frame " + std::to_string(run.first + i + 2));
        }
        primitive.indices = addIndices(model, run.triangles.size(), run.vertices());
        tinygltf::Mesh mesh;
        mesh.name = "frame " + std::to_string(run.first + 1);
        mesh.primitives.push_back(std::move(primitive));
        if (!run.targets.empty()) {
            mesh.weights.assign(run.targets.size(), 0.0);
            mesh.extras = tinygltf::Value(tinygltf::Value::Object{{"targetNames", tinygltf::Value(std::move(names))}});
        }
        model.meshes.push_back(std::move(mesh));
        return static_cast<int>(model.meshes.size()) - 1;
    }

    static void addChannel(tinygltf::Model& model, int node, const char* path, const Track& track)
    {
        const bool scale = std::string_view(path) == "scale";
        tinygltf::AnimationSampler sampler;
        sampler.input = addFloats(model, TINYGLTF_TYPE_SCALAR, track.times.size());
        model.accessors.back().minValues = {track.times.front()};
        model.accessors.back().maxValues = {track.times.back()};
        sampler.output = scale ? addFloats(model, TINYGLTF_TYPE_VEC3, track.values.size() / 3)
                               : addFloats(model, TINYGLTF_TYPE_SCALAR, track.values.size());
        sampler.interpolation = scale ? "STEP" : "LINEAR";
        tinygltf::Animation& animation = model.animations.front();
        tinygltf::AnimationChannel channel;
        channel.sampler = static_cast<int>(animation.samplers.size());
        channel.target_node = node;
        channel.target_path = path;
        animation.samplers.push_back(std::move(sampler));
        animation.channels.push_back(std::move(channel));
    }

    [[nodiscard]] tinygltf::Model model() const
    {
        tinygltf::Model model =
            makeBareModel(options.material, thickness / static_cast<double>(surfaces), options.closed);
        tinygltf::Scene scene;
        for (const Run& run : runs) {
            const int mesh = addMesh(model, run);
            tinygltf::Node node;
            node.name = model.meshes.back().name;
            node.mesh = mesh;
            if (&run != &runs.front()) {
                node.scale = {0.0, 0.0, 0.0};
            }
            scene.nodes.push_back(static_cast<int>(model.nodes.size()));
            model.nodes.push_back(std::move(node));
        }
        model.scenes.push_back(std::move(scene));
        model.defaultScene = 0;
        if (frames > 1) {
            model.animations.emplace_back().name = "sequence";
            forTracks([&](std::size_t k, const char* path, const Track& track) {
                addChannel(model, static_cast<int>(k), path, track);
            });
        }
        return model;
    }

    /// Calls take(run, path, track) for every animated property.
    template <typename Take>
    void forTracks(const Take& take) const
    {
        for (std::size_t k = 0; k < runs.size(); ++k) {
            if (runs.size() > 1 || runs[k].first > 0 || !shownToTheEnd(runs[k])) {
                take(k, "scale", visibility(k));
            }
            if (!runs[k].targets.empty()) {
                take(k, "weights", weights(k));
            }
        }
    }

    /// Writes data in the order of the model's arrays.
    void writeBuffer(ByteStream& bytes) const
    {
        const auto put = [&](const Floats& numbers) {
            for (const float number : numbers) {
                bytes.f32(number);
            }
        };
        for (const Run& run : runs) {
            put(run.base.positions.numbers);
            put(run.base.normals.numbers);
            put(run.uvs);
            for (const Shape& target : run.targets) {
                put(target.positions.numbers);
                put(target.normals.numbers);
            }
            writeIndices(run.triangles, run.vertices(), bytes);
            if (run.vertices() < kVerticesBeyond16Bit && run.triangles.size() % 2 != 0) {
                bytes.u16(0);  // padding to the next word
            }
        }
        if (frames > 1) {
            forTracks([&](std::size_t, const char*, const Track& track) {
                put(track.times);
                put(track.values);
            });
        }
    }
};

void AnimationOptions::validate() const
{
    require(frames_per_second > 0.0 && std::isfinite(frames_per_second), "frames_per_second", frames_per_second,
            "finite and more than 0");
    require(frames != 0, "frames", 0, "at least 1");
}

Animation::Animation(const AnimationOptions& options) : content_(std::make_unique<Content>())
{
    options.validate();
    lookOf(options.material);  // throws if there is no such material
    content_->options = options;
}

Animation::~Animation() = default;
Animation::Animation(Animation&&) noexcept = default;
Animation& Animation::operator=(Animation&&) noexcept = default;

void Animation::add(const Surface& surface, bool continues)
{
    surface.validate();
    Content& content = *content_;
    if (continues && (content.runs.empty() || content.runs.back().end ||
                      content.runs.back().vertices() != surface.positions.size() ||
                      content.runs.back().triangles != surface.triangles)) {
        throw Error(ErrorCode::InvalidArgument, "frame " + std::to_string(content.frames + 1) +
                                                    " must have the same triangles as the frame before");
    }
    if (continues) {
        Run& run = content.runs.back();
        run.targets.push_back({arrayOf(surface.positions, run.base.positions.numbers),
                               arrayOf(surface.normals, run.base.normals.numbers)});
        if (run.targets.size() == kMaxTargets) {
            content.begin(surface, content.frames);
        }
    } else {
        content.begin(surface, content.frames);
    }
    ++content.frames;
    ++content.surfaces;
    content.thickness += surface.mean_height;
    content.checkSize();
}

void Animation::addDry()
{
    content_->endRun(content_->frames);
    ++content_->frames;
}

std::uint64_t Animation::write(std::ostream& out) const
{
    if (content_->surfaces == 0) {
        throw Error(ErrorCode::InvalidArgument, "an animation must have at least one frame with a surface");
    }
    return writeBinary(out, content_->model(), [&](ByteStream& bytes) { content_->writeBuffer(bytes); });
}

}  // namespace droplet

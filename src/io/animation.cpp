// SPDX-License-Identifier: GPL-3.0-or-later
// Khronos Group, "glTF 2.0 Specification" (2021), sections 3.7.2.2, morph targets, and 3.11, animations.
#include "droplet/io/animation.h"

#include <cmath>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "axes.h"
#include "byte_stream.h"
#include "droplet/error.h"
#include "io/surface_scene.h"
#include "require.h"
#include "scene/write_gltf.h"
#include "scene/write_scene.h"

namespace droplet {
namespace {

/// Viewers keep morph targets in layers of a texture; 256 layers are guaranteed. They keep the weights in uniforms; a
/// quarter of that number is always free.
constexpr std::size_t kMaxTargets = 64;

/// Frames with the same triangles: a mesh of the scene.
struct Run {
    std::size_t first = 0;                ///< index of the first frame
    std::optional<std::size_t> end = {};  ///< index of the first frame after the run; empty: to the end
};

/// Vectors as differences from others.
std::vector<Float3> changesFrom(const std::vector<Float3>& base, const std::vector<Vec3>& vectors)
{
    std::vector<Float3> changes(base.size());
    for (std::size_t v = 0; v < base.size(); ++v) {
        const Vec3 up = yUp(vectors[v]);
        changes[v] = {toFloat(up.x - static_cast<double>(base[v][0])), toFloat(up.y - static_cast<double>(base[v][1])),
                      toFloat(up.z - static_cast<double>(base[v][2]))};
    }
    return changes;
}

std::uint64_t bytesOfTarget(std::size_t vertices)
{
    return 6 * sizeof(float) * vertices;
}

std::uint64_t bytesOf(const SceneGeometry& geometry)
{
    const std::size_t vertices = geometry.vertices.size();
    constexpr std::uint64_t kIndex = 2;  // at least
    return 8 * sizeof(float) * vertices + bytesOfTarget(vertices) * geometry.targets.size() +
           3 * kIndex * geometry.parts.front().triangles.size();
}

[[noreturn]] void refuseSize(std::size_t frames, const std::string& about, std::uint64_t bytes)
{
    throw Error(ErrorCode::InvalidArgument, std::to_string(frames) + " frames would make a glTF file of " + about +
                                                std::to_string(bytes) +
                                                " bytes; it must stay below 2 GiB: ask for fewer triangles or frames");
}

}  // namespace

struct Animation::Content {
    AnimationOptions options;
    Scene scene;            ///< a mesh for each run; the rest of it is made when it is written
    std::vector<Run> runs;  ///< one for each mesh
    std::size_t frames = 0;
    std::size_t surfaces = 0;  ///< number of frames with a surface
    double thickness = 0.0;    ///< sum over all frames [m]

    [[nodiscard]] SceneGeometry& geometryOf(std::size_t run) { return scene.meshes[run].geometries.front(); }
    [[nodiscard]] bool shownToTheEnd(const Run& run) const { return run.end.value_or(frames) == frames; }
    [[nodiscard]] float timeOf(std::size_t frame) const
    {
        return toFloat(static_cast<double>(frame) / options.frames_per_second);
    }

    /// Adds the track that shows and hides the k-th run.
    void addVisibility(std::size_t k)
    {
        SceneTrack track{.node = k, .change = SceneChange::Scale, .steps = true};
        std::vector<float> times;
        const auto key = [&](std::size_t frame, float shown) {
            times.push_back(timeOf(frame));
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
        track.times = scene.addTimes(std::move(times));
        scene.tracks.push_back(std::move(track));
    }

    /// Adds the track that selects a frame of the k-th run.
    void addWeights(std::size_t k)
    {
        const std::size_t targets = geometryOf(k).targets.size();
        SceneTrack track{.node = k, .change = SceneChange::Weights};
        std::vector<float> times;
        const auto key = [&](std::size_t frame, std::size_t shown) {
            times.push_back(timeOf(frame));
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
        track.times = scene.addTimes(std::move(times));
        scene.tracks.push_back(std::move(track));
    }

    void checkSize()
    {
        std::uint64_t bytes = 0;
        for (std::size_t k = 0; k < runs.size(); ++k) {
            bytes += bytesOf(geometryOf(k));
        }
        if (bytes >= kGltfFileLimit) {
            refuseSize(frames, "more than ", bytes);
        }
        // The first frame predicts the size of the others to about a tenth.
        constexpr double kSurely = 0.8;
        if (surfaces == 1 && options.frames) {
            const std::uint64_t expected =
                bytes + bytesOfTarget(geometryOf(0).vertices.size()) * (*options.frames - frames);
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
        runs.push_back({frame});
        SceneGeometry geometry = droplet::geometryOf(surface, 0);
        geometry.angles.clear();
        geometry.targets.clear();
        SceneMesh mesh{"frame " + std::to_string(frame + 1)};
        mesh.geometries.push_back(std::move(geometry));
        scene.addMesh(std::move(mesh));
    }

    /// Makes all but the meshes.
    void finish()
    {
        const double mean = thickness / static_cast<double>(surfaces);
        scene.materials.assign(1, liquidMaterial(lookOf(options.material), options.closed ? mean : 0.0));
        scene.nodes.clear();
        scene.roots.clear();
        scene.times.clear();
        scene.tracks.clear();
        scene.animation = "sequence";
        scene.frames_per_second = options.frames_per_second;
        for (std::size_t k = 0; k < runs.size(); ++k) {
            SceneNode node{scene.meshes[k].name, k};
            if (k > 0) {
                node.scale = {0.0, 0.0, 0.0};
            }
            scene.addNode(std::move(node));
        }
        for (std::size_t k = 0; frames > 1 && k < runs.size(); ++k) {
            if (runs.size() > 1 || runs[k].first > 0 || !shownToTheEnd(runs[k])) {
                addVisibility(k);
            }
            if (!geometryOf(k).targets.empty()) {
                addWeights(k);
            }
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
    if (continues) {
        const bool is_open = !content.runs.empty() && !content.runs.back().end;
        const SceneGeometry* const base = is_open ? &content.geometryOf(content.runs.size() - 1) : nullptr;
        if (!base || base->vertices.size() != surface.vertices.size() ||
            base->parts.front().triangles != surface.triangles) {
            throw Error(ErrorCode::InvalidArgument, "frame " + std::to_string(content.frames + 1) +
                                                        " must have the same triangles as the frame before");
        }
        SceneMesh& mesh = content.scene.meshes.back();
        SceneGeometry& geometry = mesh.geometries.front();
        geometry.targets.push_back(
            {changesFrom(geometry.vertices, surface.vertices), changesFrom(geometry.normals, surface.normals)});
        mesh.targets.push_back("frame " + std::to_string(content.frames + 1));
        if (geometry.targets.size() == kMaxTargets) {
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

std::uint64_t Animation::write(std::ostream& out, const AnimatedFile& file)
{
    if (content_->surfaces == 0) {
        throw Error(ErrorCode::InvalidArgument, "an animation must have at least one frame with a surface");
    }
    content_->finish();
    return writeScene(content_->scene, out, file);
}

}  // namespace droplet

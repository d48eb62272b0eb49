// SPDX-License-Identifier: GPL-3.0-or-later
//
// Droplets are sorted into classes by what shapes them: the Bond number of their contact radius, the slope, and the
// detail that their size deserves. A class has one mesh, the body of its mean droplet, which is scaled to the volume.
#include "droplet/flow_io/dew_model.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "byte_stream.h"
#include "droplet/error.h"
#include "droplet/flow_io/droplet_surfaces.h"
#include "flow_io/object_scene.h"
#include "flow_io/seat.h"
#include "flow_io/unit_bodies.h"
#include "io/droplet_meshes.h"
#include "scene/write_scene.h"

namespace droplet {
namespace {

constexpr double kGap = 0.05;                // of a rim, over the contact radius
constexpr std::size_t kMostMerged = 20'000;  // droplets in one mesh, by default

/// Class of droplets; those of the flat one look the same at every slope.
struct Kind {
    int volume = 0;  ///< 0: as flat as without gravity
    int slope = 0;
    BodyDetail detail;

    friend bool operator<(const Kind& a, const Kind& b)
    {
        return std::array{a.volume, a.slope, static_cast<int>(a.detail.around)} <
               std::array{b.volume, b.slope, static_cast<int>(b.detail.around)};
    }
};

constexpr double kVolumeStep = 1.4;  // ratio of a class's volumes
constexpr double kSlopeStep = std::numbers::pi / 12;
constexpr double kLeastVolume = 2e-10;  // water flattens a droplet of 0.5 mm by under 1 % [m³]

BodyDetail detailOf(double volume, DewDetail detail)
{
    constexpr std::array<BodyDetail, 4> kDetails{{{8, 2}, {14, 4}, {22, 6}, {32, 8}}};
    const double size = std::cbrt(volume);
    if (detail == DewDetail::Low) {
        return kDetails[size < 2.5e-3 ? 0 : 1];
    }
    const std::size_t step = size < 0.4e-3 ? 0 : size < 1.2e-3 ? 1 : 2;
    return kDetails[detail == DewDetail::High ? step + 1 : step];
}

Kind kindOf(const FlowSample& sample, Vec3 gravity, DewDetail detail)
{
    Kind kind;
    kind.detail = detailOf(sample.volume, detail);
    if (sample.volume <= kLeastVolume || length(gravity) == 0.0) {
        return kind;
    }
    kind.volume = 1 + static_cast<int>(std::floor(std::log(sample.volume / kLeastVolume) / std::log(kVolumeStep)));
    const double up = -dot(gravity, sample.normal) / length(gravity);
    kind.slope = static_cast<int>(std::lround(std::acos(std::clamp(up, -1.0, 1.0)) / kSlopeStep));
    return kind;
}

BodyConditions meanOf(const Kind& kind, double gravity)
{
    BodyConditions conditions;
    conditions.volume = kLeastVolume * (kind.volume == 0 ? 0.1 : std::pow(kVolumeStep, kind.volume - 0.5));
    const double slope = kSlopeStep * kind.slope;
    conditions.gravity = kind.volume == 0 ? Vec3{} : gravity * Vec3{std::sin(slope), 0.0, -std::cos(slope)};
    return conditions;
}

struct SharedMesh {
    DropletMesh mesh;
    double volume = 0.0;  ///< of the mean droplet [m³]
    Vec2 half;            ///< of the mean droplet [m]
};

/// Whether a seated droplet still looks like one.
/// @param volume  of the mesh
bool isLike(const DropletMesh& mesh, const DropletShape& shape, double volume)
{
    constexpr double kTaller = 1.6;
    constexpr double kLost = 0.01;
    const double seated = volumeUnder(shape.vertices, mesh.triangles);
    const auto height = [](const std::vector<Vec3>& vertices) { return cornersOf(vertices)[1].z; };
    return std::abs(seated / volume - 1.0) <= kLost && height(shape.vertices) <= kTaller * height(mesh.vertices);
}

void append(const DropletShape& shape, const std::vector<Triangle>& triangles, DropletMesh& to)
{
    const auto first = static_cast<std::uint32_t>(to.vertices.size());
    to.vertices.insert(to.vertices.end(), shape.vertices.begin(), shape.vertices.end());
    to.normals.insert(to.normals.end(), shape.normals.begin(), shape.normals.end());
    for (const auto& [a, b, c] : triangles) {
        to.triangles.push_back({first + a, first + b, first + c});
    }
}

}  // namespace

struct DewModel::Content {
    std::map<Kind, SharedMesh> shared = {};
    std::vector<const std::pair<const Kind, SharedMesh>*> kinds = {};  ///< of every droplet
    std::vector<DropletPose> poses = {};                               ///< of every droplet
    std::vector<std::size_t> shown = {};                               ///< numbers of droplets that sit
    std::vector<DropletShape> own = {};  ///< of every droplet, in the object's frame; or empty

    [[nodiscard]] DropletShape shapeOf(std::size_t i) const
    {
        const DropletMesh& mesh = kinds[i]->second.mesh;
        return own[i].vertices.empty() ? inObject({mesh.vertices, mesh.normals}, poses[i]) : own[i];
    }

    [[nodiscard]] const std::vector<Triangle>& trianglesOf(std::size_t i) const
    {
        return kinds[i]->second.mesh.triangles;
    }

    /// One mesh of all droplets, or of those that have a mesh of their own.
    [[nodiscard]] DropletMesh merged(bool all) const
    {
        DropletMesh mesh;
        for (const std::size_t i : shown) {
            if (all || !own[i].vertices.empty()) {
                append(shapeOf(i), trianglesOf(i), mesh);
            }
        }
        return mesh;
    }

    [[nodiscard]] double meanRadius() const
    {
        double sum = 0.0;
        for (const std::size_t i : shown) {
            sum += static_cast<double>(poses[i].restRadius());
        }
        return shown.empty() ? 0.0 : sum / static_cast<double>(shown.size());
    }
};

DewModel::DewModel(const FlowTerrain& terrain, std::span<const FlowSample> samples, const DropletBodies& bodies,
                   Vec3 gravity, DewDetail detail)
    : content_(std::make_unique<Content>())
{
    Content& content = *content_;
    const double unit = unitVolume(bodies);
    for (const FlowSample& sample : samples) {
        content.shared.try_emplace(kindOf(sample, gravity, detail));
    }
    std::vector<std::pair<const Kind, SharedMesh>*> all;
    for (auto& entry : content.shared) {
        all.push_back(&entry);
    }
    tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t k) {
        const BodyConditions conditions = meanOf(all[k]->first, length(gravity));
        all[k]->second = {unitBody(bodies, conditions, all[k]->first.detail, unit), conditions.volume,
                          halfSizes(bodies, conditions)};
    });
    content.kinds.resize(samples.size());
    content.poses.resize(samples.size());
    content.own.resize(samples.size());
    std::vector<char> sits(samples.size(), 1);
    tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t i) {
        const FlowSample& sample = samples[i];
        const auto* const kind = &*content.shared.find(kindOf(sample, gravity, detail));
        const double factor = std::cbrt(sample.volume / kind->second.volume);
        const Vec2 half = factor * kind->second.half;
        DropletPose& pose = content.poses[i];
        pose.place = sceneVector(sample.place);
        pose.turn = turnOf(droplet::frameOf(sample, gravity));
        pose.along = toFloat(half.x);
        pose.across = toFloat(half.y);
        pose.up = toFloat(sample.volume / (unit * half.x * half.y));
        content.kinds[i] = kind;
        const DropletMesh& mesh = kind->second.mesh;
        const std::size_t rim = kind->first.detail.around;
        if (rimGap(terrain, mesh.vertices, rim, pose) > kGap) {
            const DropletShape shape = seatedBody(terrain, mesh, rim, pose);
            sits[i] = isLike(mesh, shape, unit) ? 1 : 0;
            content.own[i] = inObject(shape, pose);
        }
    });
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (sits[i] != 0) {
            content.shown.push_back(i);
        }
    }
}

DewModel::~DewModel() = default;
DewModel::DewModel(DewModel&&) noexcept = default;
DewModel& DewModel::operator=(DewModel&&) noexcept = default;

const std::vector<std::size_t>& DewModel::shown() const
{
    return content_->shown;
}

Surface DewModel::surface() const
{
    DropletMesh mesh = content_->merged(true);
    Surface surface;
    surface.vertices = std::move(mesh.vertices);
    surface.normals = std::move(mesh.normals);
    surface.triangles = std::move(mesh.triangles);
    surface.uvs.resize(surface.vertices.size());
    surface.contact_angle.resize(surface.vertices.size());
    surface.mean_height = content_->meanRadius();
    // The base has copies of the rim, at the same places.
    std::map<std::array<double, 3>, std::uint32_t> first;
    for (std::uint32_t v = 0; v < surface.vertices.size(); ++v) {
        const Vec3 p = surface.vertices[v];
        surface.weld.push_back(first.try_emplace({p.x, p.y, p.z}, v).first->second);
    }
    return surface;
}

std::uint64_t DewModel::write(const FlowObject& object, std::ostream& out, const DewFile& form) const
{
    const Content& content = *content_;
    const bool is_usd = form.file.format == Format::Usda || form.file.format == Format::Usdz;
    Instancing instancing = form.instancing;
    if (instancing == Instancing::Auto) {
        instancing = content.shown.size() <= kMostMerged ? Instancing::None
                     : is_usd                            ? Instancing::Nodes
                                                         : Instancing::Gpu;
    }
    if (instancing == Instancing::Gpu && is_usd) {
        throw Error(ErrorCode::InvalidArgument, "instancing = gpu is a form of glTF, not of USD");
    }
    Scene scene;
    const std::size_t root = form.has_object ? addObject(object, scene) : scene.addNode({"droplets"});
    const double radius = content.meanRadius();
    const auto liquid = [&] { return scene.addMaterial(liquidMaterial(lookOf(form.material), radius)); };
    const DropletMesh merged = content.merged(instancing == Instancing::None);
    if (!merged.vertices.empty()) {
        const char* const name = instancing == Instancing::None ? "droplets" : "droplets on bends";
        scene.addNode({name, scene.addMesh(sceneMesh(merged, name, liquid()))}, root);
    }
    if (instancing != Instancing::None && !content.shown.empty()) {
        scene.gpu_instancing = instancing == Instancing::Gpu;
        std::map<const void*, SceneInstances> by_kind;
        for (const std::size_t i : content.shown) {
            if (content.own[i].vertices.empty()) {
                const DropletPose& pose = content.poses[i];
                SceneInstances& instances = by_kind[content.kinds[i]];
                instances.translations.push_back(pose.place);
                instances.rotations.push_back(pose.turn);
                instances.scales.push_back({pose.along, pose.up, pose.across});
            }
        }
        const std::size_t material = liquid();
        for (const auto& kind : content.shared) {
            if (auto found = by_kind.find(&kind); found != by_kind.end()) {
                found->second.mesh = scene.addMesh(sceneMesh(kind.second.mesh, "droplets", material));
                found->second.parent = root;
                scene.instances.push_back(std::move(found->second));
            }
        }
    }
    return writeScene(scene, out, form.file);
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Droplets are sorted into classes by what shapes them: the Bond number of their contact radius, the slope, the detail
// that their size deserves, and how the ground below them bends. A class has one mesh, the body of its mean droplet,
// which is scaled to the volume.
//
// The heights of the ground below a rim are a Fourier series over the angle. Its first harmonics are those of a plane,
// to which the droplet is leant. The mean and the second harmonics are those of a quadric: a dome or bowl, and a
// saddle. Round droplets are turned so that the saddle is along their axes. Their classes have steps of both. A droplet
// whose rim is still off the ground has a mesh of its own.
#include "droplet/flow_io/dew_model.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "box_corners.h"
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

constexpr double kGap = 0.05;                  // of a rim, over the contact radius
constexpr double kBendStep = 0.03;             // of heights on the rim over the contact radius, between classes
constexpr double kMostBent = 0.36;             // likewise, of classes; what bends more has a mesh of its own
constexpr int kLeastAlike = 6;                 // droplets that share the mesh of a bend
constexpr std::size_t kMostVertices = 65'535;  // of a part of a mesh, whose indices then have 16 bits
constexpr std::size_t kMostMerged = 20'000;    // droplets in one mesh, by default

/// Quadric that ground below a droplet follows: heights on the rim, in steps.
struct Bend {
    int dome = 0;    ///< all around
    int saddle = 0;  ///< ahead and behind; as far down on both sides
    int twist = 0;   ///< the same, between these directions

    friend bool operator==(const Bend&, const Bend&) = default;
};

/// Class of droplets; round ones look the same at every slope.
struct Kind {
    int volume = 0;  ///< 0: as round as without gravity
    int slope = 0;
    BodyDetail detail;
    Bend bend = {};

    friend bool operator<(const Kind& a, const Kind& b)
    {
        const auto key = [](const Kind& kind) {
            return std::tuple(kind.volume, kind.slope, kind.detail.around, kind.bend.dome, kind.bend.saddle,
                              kind.bend.twist);
        };
        return key(a) < key(b);
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

Kind kindOf(double volume, Vec3 normal, Vec3 gravity, DewDetail detail)
{
    Kind kind;
    kind.detail = detailOf(volume, detail);
    if (volume <= kLeastVolume || length(gravity) == 0.0) {
        return kind;
    }
    kind.volume = 1 + static_cast<int>(std::floor(std::log(volume / kLeastVolume) / std::log(kVolumeStep)));
    const double up = -dot(gravity, normal) / length(gravity);
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

    /// Contact radius in the mesh's frame, by the factor on heights there.
    [[nodiscard]] double radius(double unit) const
    {
        const double base = half.x * half.y;
        return std::sqrt(base) * unit * base / volume;
    }
};

SharedMesh sharedMesh(const DropletBodies& bodies, const Kind& kind, double gravity, double unit)
{
    const BodyConditions conditions = meanOf(kind, gravity);
    return {unitBody(bodies, conditions, kind.detail, unit), conditions.volume, halfSizes(bodies, conditions)};
}

/// Ellipsoid along the axes of a frame.
struct Ellipsoid {
    Vec3 middle;
    Vec3 half;
};

/// Whether a seated droplet still looks like one.
/// @param volume  of the mesh
/// @param rim     number of its vertices on the rim
bool isLike(const DropletMesh& mesh, const DropletShape& shape, double volume, std::size_t rim)
{
    constexpr double kTaller = 1.6;
    constexpr double kWider = 1.1;  // it has no more room between the others
    constexpr double kLost = 0.01;
    const double seated = volumeUnder(shape.vertices, mesh.triangles);
    const auto height = [](const std::vector<Vec3>& vertices) { return cornersOf(vertices)[1].z; };
    const auto width = [rim](const std::vector<Vec3>& vertices) {
        const auto points = std::span(vertices).subspan(vertices.size() - baseVertices(rim), rim);
        Vec3 sum;
        for (const Vec3 p : points) {
            sum = sum + p;
        }
        double widest = 0.0;
        for (const Vec3 p : points) {
            const Vec3 d = p - 1.0 / static_cast<double>(rim) * sum;
            widest = std::max(widest, std::hypot(d.x, d.y));
        }
        return widest;
    };
    return std::abs(seated / volume - 1.0) <= kLost && height(shape.vertices) <= kTaller * height(mesh.vertices) &&
           width(shape.vertices) <= kWider * width(mesh.vertices);
}

/// Ground under a rim: harmonics of its heights over the contact radius.
struct RimHeights {
    double mean = 0.0;
    Vec2 plane;   ///< slope ahead and to the left
    Vec2 saddle;  ///< second harmonics: of the cosine and of the sine
};

/// Heights of the ground along a droplet's normal; none where no ground that faces the droplet is in reach.
/// @param rim  number of the base's vertices on the rim, at even angles
std::optional<RimHeights> rimHeights(const FlowTerrain& terrain, const DropletMesh& mesh, std::size_t rim,
                                     const DropletPose& pose)
{
    const DropletFrame frame = droplet::frameOf(pose);
    const double radius = std::sqrt(static_cast<double>(pose.along) * static_cast<double>(pose.across));
    const std::size_t base = mesh.vertices.size() - baseVertices(rim);
    RimHeights heights;
    for (std::size_t k = 0; k < rim; ++k) {
        const Vec3 p = mesh.vertices[base + k];
        const Vec3 flat = frame.place + static_cast<double>(pose.along) * p.x * frame.ahead +
                          static_cast<double>(pose.across) * p.y * frame.left;
        const auto met = terrain.firstAlong(flat + radius * frame.normal, -1.0 * frame.normal);
        if (!met || dot(terrain.surface().faces[met->face].normal, frame.normal) <= 0.0) {
            return std::nullopt;
        }
        const double height = dot(met->place - frame.place, frame.normal) / radius;
        if (std::abs(height) >= 1.0) {
            return std::nullopt;
        }
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(rim);
        const double share = height / static_cast<double>(rim);
        heights.mean += share;
        heights.plane = heights.plane + 2.0 * share * Vec2{std::cos(angle), std::sin(angle)};
        heights.saddle = heights.saddle + 2.0 * share * Vec2{std::cos(2.0 * angle), std::sin(2.0 * angle)};
    }
    return heights;
}

/// A pose whose plane has other slopes.
DropletPose leant(DropletPose pose, Vec2 slopes)
{
    DropletFrame frame = droplet::frameOf(pose);
    const Vec3 normal = frame.normal - slopes.x * frame.ahead - slopes.y * frame.left;
    frame.normal = (1.0 / length(normal)) * normal;
    const Vec3 ahead = frame.ahead - dot(frame.ahead, frame.normal) * frame.normal;
    frame.ahead = (1.0 / length(ahead)) * ahead;
    frame.left = cross(frame.normal, frame.ahead);
    pose.turn = turnOf(frame);
    return pose;
}

/// A pose that is turned about its normal.
DropletPose turnedAbout(DropletPose pose, double angle)
{
    DropletFrame frame = droplet::frameOf(pose);
    frame.ahead = std::cos(angle) * frame.ahead + std::sin(angle) * frame.left;
    frame.left = cross(frame.normal, frame.ahead);
    pose.turn = turnOf(frame);
    return pose;
}

/// Class of a bend, and the pose in which a droplet belongs to it; none if no quadric is like the ground.
struct Bent {
    Bend bend;
    DropletPose pose;
};

std::optional<Bent> bentOn(const FlowTerrain& terrain, const DropletMesh& mesh, const Kind& kind, DropletPose pose)
{
    const std::size_t rim = kind.detail.around;
    constexpr int kLeans = 2;
    auto heights = rimHeights(terrain, mesh, rim, pose);
    for (int i = 0; i < kLeans && heights; ++i) {
        pose = leant(pose, heights->plane);
        heights = rimHeights(terrain, mesh, rim, pose);
    }
    if (!heights) {
        return std::nullopt;
    }
    Vec2 saddle = heights->saddle;
    if (kind.volume == 0) {
        pose = turnedAbout(pose, 0.5 * std::atan2(saddle.y, saddle.x));
        saddle = {length(saddle), 0.0};
    }
    if (std::max(std::abs(heights->mean), length(saddle)) > kMostBent) {
        return std::nullopt;
    }
    // The rim stays as far from the middle, in space.
    const double away = std::sqrt(1.0 + heights->mean * heights->mean + 0.5 * dot(saddle, saddle));
    pose.along = toFloat(static_cast<double>(pose.along) / away);
    pose.across = toFloat(static_cast<double>(pose.across) / away);
    pose.up = toFloat(static_cast<double>(pose.up) * away * away);
    const auto step = [](double height) { return static_cast<int>(std::lround(height / kBendStep)); };
    return Bent{{step(heights->mean), step(saddle.x), step(saddle.y)}, pose};
}

/// A flat mesh on a quadric; liquid that hangs over the rim goes with it.
/// @param height  of the rim's circle, over its height in the mesh's frame
DropletMesh bentMesh(const DropletMesh& flat, const Bend& bend, double height, double volume)
{
    const double unit = kBendStep * height;
    const Vec3 rise =
        unit * Vec3{static_cast<double>(bend.dome), static_cast<double>(bend.saddle), static_cast<double>(bend.twist)};
    DropletMesh mesh = flat;
    std::vector<double> ground;
    for (std::size_t v = 0; v < flat.vertices.size(); ++v) {
        const Vec3 p = flat.vertices[v];
        const double reach = std::hypot(p.x, p.y);
        const double way = reach > 1.0 ? 1.0 / reach : 1.0;
        const Vec2 at{way * p.x, way * p.y};
        ground.push_back(rise.x * dot(at, at) + rise.y * (at.x * at.x - at.y * at.y) + rise.z * 2.0 * at.x * at.y);
        const Vec2 slope = way == 1.0 ? Vec2{2.0 * ((rise.x + rise.y) * at.x + rise.z * at.y),
                                             2.0 * ((rise.x - rise.y) * at.y + rise.z * at.x)}
                                      : Vec2{};
        Vec3& n = mesh.normals[v];
        n = {n.x - slope.x * n.z, n.y - slope.y * n.z, n.z};
        n = (1.0 / length(n)) * n;
    }
    const auto raise = [&](double factor) {
        for (std::size_t v = 0; v < flat.vertices.size(); ++v) {
            mesh.vertices[v].z = ground[v] + factor * flat.vertices[v].z;
        }
    };
    // The volume is linear in the factor on the heights.
    raise(0.0);
    const double empty = volumeUnder(mesh.vertices, mesh.triangles);
    raise(1.0);
    const double full = volumeUnder(mesh.vertices, mesh.triangles);
    raise((volume - empty) / (full - empty));
    return mesh;
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

bool isUsd(Format format)
{
    return format == Format::Usda || format == Format::Usdz;
}

}  // namespace

std::function<DewExtent(double volume, Vec3 normal)> dewExtents(const DropletBodies& bodies, Vec3 gravity,
                                                                DewDetail detail)
{
    const double unit = unitVolume(bodies);
    // Meshes of a kind are scaled alike: that of 1 m³, in the droplet's frame.
    const auto box_of = [&bodies, gravity, unit](const Kind& kind) {
        const SharedMesh shared = sharedMesh(bodies, kind, length(gravity), unit);
        const Vec2 half = (1.0 / std::cbrt(shared.volume)) * shared.half;
        std::vector<Vec3> vertices = shared.mesh.vertices;
        for (Vec3& p : vertices) {
            p = {half.x * p.x, half.y * p.y, p.z / (unit * half.x * half.y)};
        }
        const auto [low, high] = cornersOf(vertices);
        Ellipsoid around{{0.5 * (low.x + high.x), 0.5 * (low.y + high.y), 0.0}, 0.5 * (high - low)};
        double widest = 0.0;
        for (const Vec3 p : vertices) {
            const double wide =
                std::hypot((p.x - around.middle.x) / around.half.x, (p.y - around.middle.y) / around.half.y);
            if (wide > widest) {
                widest = wide;
                around.middle.z = p.z;
            }
        }
        around.half.z = std::max(high.z - around.middle.z, around.middle.z);
        double most = 0.0;
        for (const Vec3 p : vertices) {
            const Vec3 d = p - around.middle;
            most = std::max(most, length(Vec3{d.x / around.half.x, d.y / around.half.y, d.z / around.half.z}));
        }
        around.half = most * around.half;
        return around;
    };
    return [box_of, gravity, detail, known = std::map<Kind, Ellipsoid>{}](double volume, Vec3 normal) mutable {
        const Kind kind = kindOf(volume, normal, gravity, detail);
        auto found = known.find(kind);
        if (found == known.end()) {
            found = known.emplace(kind, box_of(kind)).first;
        }
        FlowSample sample;
        sample.normal = normal;
        const DropletFrame frame = droplet::frameOf(sample, gravity);
        const double size = std::cbrt(volume);
        const Vec3 middle = size * found->second.middle;
        const Vec3 half = size * found->second.half;
        return DewExtent{middle.x * frame.ahead + middle.y * frame.left + middle.z * frame.normal,
                         {half.x * frame.ahead, half.y * frame.left, half.z * frame.normal}};
    };
}

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

    /// One mesh of droplets.
    [[nodiscard]] DropletMesh merged(std::span<const std::size_t> droplets) const
    {
        DropletMesh mesh;
        for (const std::size_t i : droplets) {
            append(shapeOf(i), trianglesOf(i), mesh);
        }
        return mesh;
    }

    /// Droplets that share no mesh.
    [[nodiscard]] std::vector<std::size_t> alone() const
    {
        std::vector<std::size_t> droplets;
        std::copy_if(shown.begin(), shown.end(), std::back_inserter(droplets),
                     [&](std::size_t i) { return !own[i].vertices.empty(); });
        return droplets;
    }

    /// A mesh of droplets with the same number of vertices in each of its parts, as many as indices of 16 bits reach,
    /// so that parts have the same triangles.
    [[nodiscard]] SceneMesh meshInParts(const std::vector<std::size_t>& droplets, const char* name,
                                        std::size_t material) const
    {
        std::map<std::size_t, std::vector<std::size_t>> alike;  // by vertices
        for (const std::size_t i : droplets) {
            alike[kinds[i]->second.mesh.vertices.size()].push_back(i);
        }
        SceneMesh mesh{name};
        for (const auto& [vertices, some] : alike) {
            const std::size_t count = kMostVertices / vertices;
            for (std::size_t begin = 0; begin < some.size(); begin += count) {
                const std::span part = std::span(some).subspan(begin, std::min(count, some.size() - begin));
                mesh.geometries.push_back(std::move(sceneMesh(merged(part), name, material).geometries.front()));
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
        content.shared.try_emplace(kindOf(sample.volume, sample.normal, gravity, detail));
    }
    std::vector<std::pair<const Kind, SharedMesh>*> all;
    for (auto& entry : content.shared) {
        all.push_back(&entry);
    }
    tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t k) {
        all[k]->second = sharedMesh(bodies, all[k]->first, length(gravity), unit);
    });
    content.kinds.resize(samples.size());
    content.poses.resize(samples.size());
    content.own.resize(samples.size());
    std::vector<std::optional<Bent>> bent(samples.size());
    std::vector<char> fits(samples.size(), 0);
    tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t i) {
        const FlowSample& sample = samples[i];
        const auto* const kind = &*content.shared.find(kindOf(sample.volume, sample.normal, gravity, detail));
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
        fits[i] = rimGap(terrain, mesh.vertices, kind->first.detail.around, pose) <= kGap ? 1 : 0;
        if (fits[i] == 0) {
            bent[i] = bentOn(terrain, mesh, kind->first, pose);
        }
    });
    const auto kind_on = [&](std::size_t i) {
        Kind kind = content.kinds[i]->first;
        kind.bend = bent[i]->bend;
        return kind;
    };
    std::map<Kind, int> alike;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (bent[i]) {
            ++alike[kind_on(i)];
        }
    }
    for (const auto& [kind, count] : alike) {
        if (count >= kLeastAlike && kind.bend != Bend{}) {
            Kind flat = kind;
            flat.bend = {};
            SharedMesh mesh = content.shared.at(flat);
            mesh.mesh = bentMesh(mesh.mesh, kind.bend, mesh.radius(unit), unit);
            content.shared.emplace(kind, std::move(mesh));
        }
    }
    std::vector<char> sits(samples.size(), 1);
    tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t i) {
        if (fits[i] != 0) {
            return;
        }
        const std::size_t rim = content.kinds[i]->first.detail.around;
        if (const auto shared = bent[i] ? content.shared.find(kind_on(i)) : content.shared.end();
            shared != content.shared.end() &&
            rimGap(terrain, shared->second.mesh.vertices, rim, bent[i]->pose) <= kGap) {
            content.kinds[i] = &*shared;
            content.poses[i] = bent[i]->pose;
            return;
        }
        const DropletMesh& mesh = content.kinds[i]->second.mesh;
        const DropletShape shape = seatedBody(terrain, mesh, rim, content.poses[i]);
        sits[i] = isLike(mesh, shape, unit, rim) ? 1 : 0;
        content.own[i] = inObject(shape, content.poses[i]);
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
    DropletMesh mesh = content_->merged(content_->shown);
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

SettledDroplets DewModel::settled() const
{
    SettledDroplets made{surface(), {}};
    for (const std::size_t i : content_->shown) {
        const DropletPose& pose = content_->poses[i];
        const DropletFrame frame = droplet::frameOf(pose);
        const double top = cornersOf(content_->kinds[i]->second.mesh.vertices)[1].z;
        made.bases.push_back({frame.place, frame.ahead, frame.normal, static_cast<double>(pose.along),
                              static_cast<double>(pose.across), top * static_cast<double>(pose.up)});
    }
    return made;
}

const char* name(Instancing instancing)
{
    switch (instancing) {
        case Instancing::Auto:
            break;
        case Instancing::None:
            return "none";
        case Instancing::Nodes:
            return "nodes";
        case Instancing::Gpu:
            return "gpu";
    }
    return "auto";
}

Instancing DewModel::instancingIn(const DewFile& file) const
{
    if (file.instancing != Instancing::Auto) {
        return file.instancing;
    }
    return content_->shown.size() <= kMostMerged ? Instancing::None
           : isUsd(file.file.format)             ? Instancing::Nodes
                                                 : Instancing::Gpu;
}

std::uint64_t DewModel::write(const FlowObject& object, std::ostream& out, const DewFile& form) const
{
    const Content& content = *content_;
    const Instancing instancing = instancingIn(form);
    if (instancing == Instancing::Gpu && isUsd(form.file.format)) {
        throw Error(ErrorCode::InvalidArgument, "instancing = gpu is a form of glTF, not of USD");
    }
    Scene scene;
    const std::size_t root = form.has_object ? addObject(object, scene) : scene.addNode({"droplets"});
    const double radius = content.meanRadius();
    const auto liquid = [&] { return scene.addMaterial(liquidMaterial(lookOf(form.material), radius)); };
    if (instancing == Instancing::None && !content.shown.empty()) {
        SceneMesh mesh = sceneMesh(content.merged(content.shown), "droplets", liquid());
        scene.addNode({"droplets", scene.addMesh(std::move(mesh))}, root);
    } else if (const std::vector<std::size_t> alone = content.alone(); !alone.empty()) {
        const char* const name = "droplets on bends";
        scene.addNode({name, scene.addMesh(content.meshInParts(alone, name, liquid()))}, root);
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

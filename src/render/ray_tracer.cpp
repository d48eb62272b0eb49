// SPDX-License-Identifier: GPL-3.0-or-later
// I. Wald, S. Woop, C. Benthin, G. S. Johnson, M. Ernst, "Embree: A Kernel Framework for Efficient CPU Ray Tracing"
// (2014).
#include "render/ray_tracer.h"

#include <tbb/task_arena.h>

#include <array>
#include <cstring>
#include <limits>
#include <new>

#include "rays/embree_device.h"
#include "union_find.h"

namespace droplet {
namespace {

// Scenes have a size of about 1; floats are accurate to 1e-7, and robust intersections miss nothing beyond this.
constexpr float kNear = 2e-5F;

/// For every triangle, whether it belongs to the base.
std::vector<bool> baseTriangles(const Surface& surface)
{
    UnionFind sheets(surface.vertices.size());
    for (const Triangle& t : surface.triangles) {
        sheets.join(t[0], t[1]);
        sheets.join(t[0], t[2]);
    }
    std::vector<bool> copied(surface.vertices.size());
    for (std::uint32_t v = 0; v < surface.vertices.size(); ++v) {
        if (surface.weld[v] != v) {
            copied[sheets.find(v)] = true;
        }
    }
    std::vector<bool> base(surface.triangles.size());
    for (std::size_t t = 0; t < base.size(); ++t) {
        const Triangle& triangle = surface.triangles[t];
        const bool in_plane = surface.vertices[triangle[0]].z == 0.0 && surface.vertices[triangle[1]].z == 0.0 &&
                              surface.vertices[triangle[2]].z == 0.0;
        base[t] = in_plane || copied[sheets.find(triangle[0])];
    }
    return base;
}

struct Buffers {
    std::vector<Vec3f> vertices;
    std::vector<Vec3f> normals;
    std::vector<Vec2> uvs;
    std::vector<Triangle> triangles;
};

// Numbers of the parts of a scene.
constexpr unsigned kLiquid = 0;
constexpr unsigned kBase = 1;
constexpr unsigned kStand = 2;

}  // namespace

struct RayTracer::Embree {
    EmbreeDevice device;
    EmbreeDevice::Scene air;
    EmbreeDevice::Scene liquid;
    EmbreeDevice::Scene dry;
    std::array<Buffers, 3> parts;

    // One thread builds the tree, so that the order of triangles, which decides on shared edges, is always the same.
    EmbreeDevice::Scene build(std::initializer_list<unsigned> wanted)
    {
        EmbreeDevice::Scene scene = device.newScene();
        rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
        for (const unsigned part : wanted) {
            Buffers& buffers = parts[part];
            if (buffers.triangles.empty()) {
                continue;
            }
            RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
            auto* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                     sizeof(Vec3f), buffers.vertices.size());
            auto* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                    sizeof(Triangle), buffers.triangles.size());
            if (vertices == nullptr || indices == nullptr) {
                throw std::bad_alloc();
            }
            std::memcpy(vertices, buffers.vertices.data(), sizeof(Vec3f) * buffers.vertices.size());
            std::memcpy(indices, buffers.triangles.data(), sizeof(Triangle) * buffers.triangles.size());
            rtcCommitGeometry(geometry);
            rtcAttachGeometryByID(scene.get(), geometry, part);
            rtcReleaseGeometry(geometry);
        }
        tbb::task_arena(1).execute([&] { rtcCommitScene(scene.get()); });
        device.check();
        return scene;
    }
};

RayTracer::RayTracer(const Surface& surface, const RenderOptions& options) : embree_(std::make_unique<Embree>())
{
    const TexturedMesh* const stand = options.stand ? &*options.stand : nullptr;
    const Vec2 extent = options.extent;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Vec3 low{kInfinity, kInfinity, kInfinity};
    Vec3 high{-kInfinity, -kInfinity, -kInfinity};
    const auto enclose = [&](const std::vector<Vec3>& points) {
        for (const Vec3& p : points) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
    };
    // Droplets that fall away from an object must not change its picture.
    if (!options.stand_water) {
        enclose(surface.vertices);
    }
    if (options.framed) {
        enclose({options.framed->low, options.framed->high});
    }
    if (options.stand_water && !options.framed) {
        enclose(stand->vertices);
    }
    const Vec3 liquid_low = low;
    const Vec3 liquid_high = high;
    if (stand != nullptr) {
        enclose(stand->vertices);
    }
    scale_ = std::max(0.5 * length(high - low), 1e-30);
    middle_ = {0.5 * (low.x + high.x), 0.5 * (low.y + high.y), 0.0};
    extent_ = extent.x > 0.0 && extent.y > 0.0 ? extent : Vec2{high.x - low.x, high.y - low.y};
    low_ = toScene(liquid_low);
    high_ = toScene(liquid_high);
    if (options.framed) {
        for (unsigned corner = 0; corner < 8; ++corner) {
            framed_.push_back({(corner & 1U) != 0 ? high_.x : low_.x, (corner & 2U) != 0 ? high_.y : low_.y,
                               (corner & 4U) != 0 ? high_.z : low_.z});
        }
    }

    const std::vector<bool> base = baseTriangles(surface);
    on_plane_ = stand == nullptr;
    for (std::size_t t = 0; t < base.size() && on_plane_; ++t) {
        for (const std::uint32_t v : surface.triangles[t]) {
            on_plane_ = on_plane_ && (!base[t] || surface.vertices[v].z == 0.0);
        }
    }
    const auto fill = [&](Buffers& buffers, const auto& mesh) {
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
            buffers.vertices.push_back(toScene(mesh.vertices[v]));
            buffers.normals.push_back(toFloats(mesh.normals[v]));
        }
        buffers.uvs = mesh.uvs;
    };
    Buffers& liquid = embree_->parts[kLiquid];
    fill(liquid, surface);
    for (std::size_t t = 0; t < base.size(); ++t) {
        if (!base[t]) {
            liquid.triangles.push_back(surface.triangles[t]);
        } else if (!on_plane_) {
            embree_->parts[kBase].triangles.push_back(surface.triangles[t]);
        }
    }
    triangles_ = liquid.triangles;
    shown_ = liquid.vertices;
    surface_vertices_ = shown_.size();
    const bool has_base = !embree_->parts[kBase].triangles.empty();
    if (has_base) {
        Buffers& below = embree_->parts[kBase];
        below.vertices = liquid.vertices;
        below.normals = liquid.normals;
        below.uvs = liquid.uvs;
    }
    if (stand != nullptr) {
        fill(embree_->parts[kStand], *stand);
        embree_->parts[kStand].triangles = stand->triangles;
        shown_.insert(shown_.end(), embree_->parts[kStand].vertices.begin(), embree_->parts[kStand].vertices.end());
        shown_.insert(shown_.end(), framed_.begin(), framed_.end());
    }
    on_object_ = has_base && stand != nullptr && options.shows_whole_stand;
    // The stand and the base touch: through air the stand is seen, through the liquid the base.
    embree_->air = stand != nullptr ? embree_->build({kLiquid, kStand}) : embree_->build({kLiquid, kBase});
    embree_->liquid = has_base ? embree_->build({kLiquid, kBase}) : embree_->build({kLiquid, kStand});
    embree_->dry = stand != nullptr ? embree_->build({kStand}) : embree_->build({kBase});
}

RayTracer::~RayTracer() = default;

Vec3f RayTracer::toScene(Vec3 p) const
{
    return toFloats((1.0 / scale_) * (p - middle_));
}

std::vector<Vec3f> RayTracer::droplets() const
{
    return framed_.empty()
               ? std::vector<Vec3f>(shown_.begin(), shown_.begin() + static_cast<std::ptrdiff_t>(surface_vertices_))
               : framed_;
}

std::vector<Vec3f> RayTracer::stand() const
{
    return {shown_.begin() + static_cast<std::ptrdiff_t>(surface_vertices_), shown_.end()};
}

Vec2 RayTracer::uvOnPlane(Vec3f place) const
{
    return {0.5 + (scale_ * static_cast<double>(place.x) + middle_.x) / extent_.x,
            0.5 - (scale_ * static_cast<double>(place.y) + middle_.y) / extent_.y};
}

Meeting RayTracer::meet(void* scene, const RayF& ray) const
{
    RayContext context;
    RTCRayHit hit{};
    hit.ray.org_x = ray.origin.x;
    hit.ray.org_y = ray.origin.y;
    hit.ray.org_z = ray.origin.z;
    hit.ray.dir_x = ray.direction.x;
    hit.ray.dir_y = ray.direction.y;
    hit.ray.dir_z = ray.direction.z;
    hit.ray.tnear = kNear;
    hit.ray.tfar = std::numeric_limits<float>::infinity();
    hit.ray.mask = ~0U;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    intersect(static_cast<RTCScene>(scene), context, hit);
    Meeting meeting;
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return meeting;
    }
    const Buffers& part = embree_->parts[hit.hit.geomID];
    const Triangle& t = part.triangles[hit.hit.primID];
    meeting.what = hit.hit.geomID == kLiquid ? Meeting::What::Liquid : Meeting::What::Ground;
    meeting.distance = hit.ray.tfar;
    meeting.triangle = hit.hit.primID;
    meeting.u = hit.hit.u;
    meeting.v = hit.hit.v;
    const float w = 1.0F - meeting.u - meeting.v;
    meeting.place = w * part.vertices[t[0]] + meeting.u * part.vertices[t[1]] + meeting.v * part.vertices[t[2]];
    meeting.facet = unit(cross(part.vertices[t[1]] - part.vertices[t[0]], part.vertices[t[2]] - part.vertices[t[0]]));
    meeting.normal = unit(w * part.normals[t[0]] + meeting.u * part.normals[t[1]] + meeting.v * part.normals[t[2]]);
    meeting.uv = static_cast<double>(w) * part.uvs[t[0]] + static_cast<double>(meeting.u) * part.uvs[t[1]] +
                 static_cast<double>(meeting.v) * part.uvs[t[2]];
    // The base's normal points down, out of the liquid; the ground's normal points up.
    if (hit.hit.geomID == kBase) {
        meeting.normal = -1.0F * meeting.normal;
        meeting.facet = -1.0F * meeting.facet;
    }
    return meeting;
}

bool RayTracer::passesBox(const RayF& ray) const
{
    float from = 0.0F;
    float to = std::numeric_limits<float>::infinity();
    const auto clip = [&](float origin, float direction, float low, float high) {
        if (direction != 0.0F) {
            const float a = (low - kNear - origin) / direction;
            const float b = (high + kNear - origin) / direction;
            from = std::max(from, std::min(a, b));
            to = std::min(to, std::max(a, b));
        }
    };
    clip(ray.origin.x, ray.direction.x, low_.x, high_.x);
    clip(ray.origin.y, ray.direction.y, low_.y, high_.y);
    clip(ray.origin.z, ray.direction.z, low_.z, high_.z);
    return from > to;
}

Meeting RayTracer::nearerOfPlane(const RayF& ray, Meeting meeting) const
{
    if (!on_plane_ || ray.direction.z >= 0.0F) {
        return meeting;
    }
    const float distance = std::max(0.0F, -ray.origin.z / ray.direction.z);
    if (meeting.what != Meeting::What::Nothing && meeting.distance <= distance) {
        return meeting;
    }
    Meeting plane;
    plane.what = Meeting::What::Ground;
    plane.distance = distance;
    plane.place = ray.origin + distance * ray.direction;
    plane.place.z = 0.0F;
    plane.facet = plane.normal = {0.0F, 0.0F, 1.0F};
    plane.uv = uvOnPlane(plane.place);
    return plane;
}

Meeting RayTracer::fromAir(const RayF& ray) const
{
    if (on_plane_ && passesBox(ray)) {
        return nearerOfPlane(ray, {});
    }
    return nearerOfPlane(ray, meet(embree_->air.get(), ray));
}

Meeting RayTracer::fromLiquid(const RayF& ray) const
{
    if (!on_object_) {
        return nearerOfPlane(ray, meet(embree_->liquid.get(), ray));
    }
    // The base is only a lid for rounding: a way that comes up from the object goes through it.
    Meeting meeting = meet(embree_->liquid.get(), ray);
    const float before = meeting.distance;
    const bool is_from_below = meeting.what == Meeting::What::Ground && dot(ray.direction, meeting.facet) > 0.0F;
    if (is_from_below) {
        meeting = meet(embree_->liquid.get(), {meeting.place, ray.direction});
        meeting.distance += before;
    }
    return meeting.what == Meeting::What::Ground ? onObject(meeting) : meeting;
}

Meeting RayTracer::onObject(const Meeting& base) const
{
    constexpr float kLift = 0.01F;
    for (const float side : {1.0F, -1.0F}) {
        const Vec3f up = side * base.facet;
        Meeting meeting = meet(embree_->dry.get(), {base.place + kLift * up, -1.0F * up});
        if (meeting.what == Meeting::What::Ground && meeting.distance < 2.0F * kLift) {
            meeting.distance = base.distance;
            return meeting;
        }
    }
    return {};
}

Meeting RayTracer::dry(const RayF& ray) const
{
    return nearerOfPlane(ray, on_plane_ ? Meeting{} : meet(embree_->dry.get(), ray));
}

}  // namespace droplet

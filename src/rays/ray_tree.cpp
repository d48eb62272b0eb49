// SPDX-License-Identifier: GPL-3.0-or-later
#include "rays/ray_tree.h"

#include "rays/embree_device.h"

namespace droplet {
namespace {

struct Context : RayContext {
    const std::function<bool(std::uint32_t)>* takes = nullptr;
};

void keepTaken(const RTCFilterFunctionNArguments* arguments)
{
    const auto& takes = *static_cast<const Context*>(arguments->context)->takes;
    const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);  // of one ray at a time
    if (takes && !takes(hit->primID)) {
        arguments->valid[0] = 0;
    }
}

}  // namespace

struct RayTree::Scene {
    EmbreeDevice device;
    EmbreeDevice::Scene scene = device.newScene();
};

RayTree::RayTree(const std::vector<Corners3>& triangles) : scene_(std::make_unique<Scene>())
{
    Scene& s = *scene_;
    RTCGeometry geometry = rtcNewGeometry(s.device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 3 * sizeof(float), 3 * triangles.size()));
    auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles.size()));
    s.device.check();
    std::uint32_t number = 0;
    for (const Corners3& corners : triangles) {
        for (const Vec3 p : corners) {
            *vertices++ = static_cast<float>(p.x);
            *vertices++ = static_cast<float>(p.y);
            *vertices++ = static_cast<float>(p.z);
            *indices++ = number++;
        }
    }
    rtcSetGeometryIntersectFilterFunction(geometry, &keepTaken);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(s.scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(s.scene.get(), RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(s.scene.get());
    s.device.check();
}

RayTree::~RayTree() = default;
RayTree::RayTree(RayTree&& other) noexcept = default;

std::optional<std::uint32_t> RayTree::first(Vec3 origin, Vec3 direction, double end,
                                            const std::function<bool(std::uint32_t)>& takes) const
{
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(origin.x);
    ray.ray.org_y = static_cast<float>(origin.y);
    ray.ray.org_z = static_cast<float>(origin.z);
    ray.ray.dir_x = static_cast<float>(direction.x);
    ray.ray.dir_y = static_cast<float>(direction.y);
    ray.ray.dir_z = static_cast<float>(direction.z);
    ray.ray.tfar = static_cast<float>(end);
    ray.ray.mask = 0xFFFFFFFFU;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    Context context;
    context.takes = &takes;
    intersect(scene_->scene.get(), context, ray);
    return ray.hit.geomID != RTC_INVALID_GEOMETRY_ID ? std::optional(ray.hit.primID) : std::nullopt;
}

}  // namespace droplet

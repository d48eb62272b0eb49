// SPDX-License-Identifier: GPL-3.0-or-later
// S. Zhukov, A. Iones, G. Kronin, "An Ambient Light Illumination Model" (1998): the cosine-weighted share of the
// directions around a normal that meet nothing.
#include "render/openness.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <numbers>
#include <utility>

#include "rays/embree_device.h"

namespace droplet {
namespace {

constexpr int kRays = 96;       // levels differ by 1 %, which no eye sees
constexpr double kLift = 1e-4;  // of a ray's start above the surface, over the object's size
constexpr int kVerticesAtOnce = 256;

/// Embree's scene of the triangles that light does not pass, in units of the object's size.
class Occluders {
public:
    Occluders(const TexturedMesh& object, const std::vector<bool>& is_clear)
    {
        for (const Vec3& p : object.vertices) {
            size_ = std::max({size_, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        }
        std::vector<Triangle> triangles;
        for (std::size_t t = 0; t < object.triangles.size(); ++t) {
            if (is_clear.empty() || !is_clear[t]) {
                triangles.push_back(object.triangles[t]);
            }
        }
        if (!triangles.empty()) {
            const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
            auto* const vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
                geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), object.vertices.size()));
            auto* const indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                          sizeof(Triangle), triangles.size());
            if (vertices == nullptr || indices == nullptr) {
                throw std::bad_alloc();
            }
            for (std::size_t v = 0; v < object.vertices.size(); ++v) {
                const Vec3 p = scaled(object.vertices[v]);
                vertices[3 * v] = static_cast<float>(p.x);
                vertices[3 * v + 1] = static_cast<float>(p.y);
                vertices[3 * v + 2] = static_cast<float>(p.z);
            }
            std::memcpy(indices, triangles.data(), sizeof(Triangle) * triangles.size());
            rtcCommitGeometry(geometry);
            rtcAttachGeometry(scene_.get(), geometry);
            rtcReleaseGeometry(geometry);
        }
        rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
        rtcCommitScene(scene_.get());
        device_.check();
    }

    [[nodiscard]] Vec3 scaled(Vec3 p) const { return (1.0 / size_) * p; }

    /// Whether a ray meets anything.
    [[nodiscard]] bool meets(Vec3 from, Vec3 direction) const
    {
        RTCRay ray{};
        ray.org_x = static_cast<float>(from.x);
        ray.org_y = static_cast<float>(from.y);
        ray.org_z = static_cast<float>(from.z);
        ray.dir_x = static_cast<float>(direction.x);
        ray.dir_y = static_cast<float>(direction.y);
        ray.dir_z = static_cast<float>(direction.z);
        ray.tfar = std::numeric_limits<float>::infinity();
        ray.mask = ~0U;
        return isOccluded(scene_.get(), ray);
    }

private:
    EmbreeDevice device_;
    EmbreeDevice::Scene scene_ = device_.newScene();
    double size_ = 1e-30;
};

/// Vertices at one place with one normal, to rounding: a mesh with corners of its own for every triangle has each six
/// times, and rays are what takes time.
struct Places {
    std::vector<std::uint32_t> first;  ///< a vertex of every place
    std::vector<std::uint32_t> of;     ///< number of every vertex's place
};

Places placesOf(const TexturedMesh& object)
{
    using Key = std::array<double, 6>;
    std::vector<std::pair<Key, std::uint32_t>> keys;
    for (std::uint32_t v = 0; v < object.vertices.size(); ++v) {
        constexpr double kParts = 1 << 20;  // of a normal: far less than the rays are apart
        const auto [x, y, z] = object.vertices[v];
        const Vec3 n = kParts * object.normals[v];
        keys.push_back({{x, y, z, std::round(n.x) + 0.0, std::round(n.y) + 0.0, std::round(n.z) + 0.0}, v});
    }
    std::sort(keys.begin(), keys.end());
    Places places{{}, std::vector<std::uint32_t>(keys.size())};
    for (std::size_t k = 0; k < keys.size(); ++k) {
        if (k == 0 || keys[k].first != keys[k - 1].first) {
            places.first.push_back(keys[k].second);
        }
        places.of[keys[k].second] = static_cast<std::uint32_t>(places.first.size() - 1);
    }
    return places;
}

}  // namespace

std::vector<float> opennessOf(const TexturedMesh& object, const std::vector<bool>& is_clear)
{
    const Occluders occluders(object, is_clear);
    std::vector<Vec3> directions;  // about z, spread as the seeds of a sunflower
    for (int k = 0; k < kRays; ++k) {
        const double share = (k + 0.5) / kRays;
        const double turn = k * std::numbers::pi * (3.0 - std::sqrt(5.0));
        directions.push_back(
            {std::sqrt(share) * std::cos(turn), std::sqrt(share) * std::sin(turn), std::sqrt(1.0 - share)});
    }
    const Places places = placesOf(object);
    std::vector<float> openness(places.first.size());
    const tbb::blocked_range<std::size_t> all(0, openness.size(), kVerticesAtOnce);
    tbb::parallel_for(all, [&](const tbb::blocked_range<std::size_t>& some) {
        for (std::size_t k = some.begin(); k < some.end(); ++k) {
            const std::uint32_t v = places.first[k];
            const Vec3 n = object.normals[v];
            const Vec3 fixed = std::abs(n.x) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
            const Vec3 across = cross(n, fixed);
            const Vec3 right = (1.0 / length(across)) * across;
            const Vec3 up = cross(n, right);
            const Vec3 from = occluders.scaled(object.vertices[v]) + kLift * n;
            int open = 0;
            for (const Vec3& d : directions) {
                open += occluders.meets(from, d.x * right + d.y * up + d.z * n) ? 0 : 1;
            }
            openness[k] = static_cast<float>(open) / kRays;
        }
    });
    std::vector<float> of_vertices;
    of_vertices.reserve(object.vertices.size());
    for (const std::uint32_t place : places.of) {
        of_vertices.push_back(openness[place]);
    }
    return of_vertices;
}

}  // namespace droplet

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

#include "box_corners.h"
#include "rays/embree_device.h"
#include "render/triangle_grid.h"
#include "require.h"
#include "unit_vector.h"

namespace droplet {
namespace {

constexpr int kRays = 96;        // levels differ by 1 %, which no eye sees
constexpr double kLift = 1e-4;   // of a ray's start above the surface, over the object's size
constexpr double kParts = 48.0;  // of the object's diagonal, between the places of a triangle
constexpr double kMostDivisions = 64.0;
constexpr int kPlacesAtOnce = 256;

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

/// A place of a grid.
struct Spot {
    Vec3 place;
    Vec3 normal;
    Vec3 inside;  ///< to the middle of its triangles: rays from the foot of a wall must meet the wall
};

/// Spots at one place with one normal, to rounding, are many: triangles share edges, and rays are what takes time.
struct Spots {
    std::vector<Spot> different;
    std::vector<std::uint32_t> of;  ///< number of every given spot among these
};

Spots withoutCopies(const std::vector<Spot>& all)
{
    using Key = std::array<double, 6>;
    std::vector<std::pair<Key, std::uint32_t>> keys;
    double size = 1e-30;
    for (const Spot& spot : all) {
        size = std::max({size, std::abs(spot.place.x), std::abs(spot.place.y), std::abs(spot.place.z)});
    }
    for (std::uint32_t k = 0; k < all.size(); ++k) {
        // Far less than the rays are apart, or start above the ground.
        const Vec3 p = ((1 << 20) / size) * all[k].place;
        const Vec3 n = (1 << 20) * all[k].normal;
        keys.push_back({{std::round(p.x) + 0.0, std::round(p.y) + 0.0, std::round(p.z) + 0.0, std::round(n.x) + 0.0,
                         std::round(n.y) + 0.0, std::round(n.z) + 0.0},
                        k});
    }
    std::sort(keys.begin(), keys.end());
    Spots spots{{}, std::vector<std::uint32_t>(keys.size())};
    for (std::size_t k = 0; k < keys.size(); ++k) {
        if (k == 0 || keys[k].first != keys[k - 1].first) {
            spots.different.push_back(all[keys[k].second]);
        } else {
            spots.different.back().inside = spots.different.back().inside + all[keys[k].second].inside;
        }
        spots.of[keys[k].second] = static_cast<std::uint32_t>(spots.different.size() - 1);
    }
    return spots;
}

/// Grids over all triangles, without values.
StandOpenness gridsOver(const TexturedMesh& object)
{
    const auto [low, high] = object.vertices.empty() ? std::array<Vec3, 2>{} : cornersOf(object.vertices);
    const double spacing = std::max(length(high - low), 1e-30) / kParts;
    StandOpenness grids;
    std::size_t count = 0;
    for (const auto& [a, b, c] : object.triangles) {
        // Needles have as many places as other triangles of their area.
        const double twice =
            length(cross(object.vertices[b] - object.vertices[a], object.vertices[c] - object.vertices[a]));
        const auto n =
            static_cast<std::uint16_t>(std::clamp(std::ceil(std::sqrt(twice) / spacing), 1.0, kMostDivisions));
        grids.divisions.push_back(n);
        grids.first.push_back(static_cast<std::uint32_t>(count));
        count += gridValues(n);
    }
    return grids;
}

std::vector<Spot> spotsOf(const TexturedMesh& object, const StandOpenness& grids)
{
    std::vector<Spot> spots;
    for (std::size_t t = 0; t < object.triangles.size(); ++t) {
        const Triangle& triangle = object.triangles[t];
        const Vec3 middle =
            (1.0 / 3.0) * (object.vertices[triangle[0]] + object.vertices[triangle[1]] + object.vertices[triangle[2]]);
        const int n = grids.divisions[t];
        for (int j = 0; j <= n; ++j) {
            for (int i = 0; i + j <= n; ++i) {
                const double u = static_cast<double>(i) / n;
                const double v = static_cast<double>(j) / n;
                const auto mixed = [&](const std::vector<Vec3>& of) {
                    return (1.0 - u - v) * of[triangle[0]] + u * of[triangle[1]] + v * of[triangle[2]];
                };
                const Vec3 place = mixed(object.vertices);
                spots.push_back({place, unit(mixed(object.normals), object.normals[triangle[0]]), middle - place});
            }
        }
    }
    return spots;
}

/// Share of directions about the normals of spots that meet nothing.
std::vector<float> opennessAt(const std::vector<Spot>& all, const Occluders& occluders)
{
    std::vector<Vec3> directions;  // about z, spread as the seeds of a sunflower
    for (int k = 0; k < kRays; ++k) {
        const double share = (k + 0.5) / kRays;
        const double turn = k * std::numbers::pi * (3.0 - std::sqrt(5.0));
        directions.push_back(
            {std::sqrt(share) * std::cos(turn), std::sqrt(share) * std::sin(turn), std::sqrt(1.0 - share)});
    }
    const Spots spots = withoutCopies(all);
    std::vector<float> openness(spots.different.size());
    const tbb::blocked_range<std::size_t> range(0, openness.size(), kPlacesAtOnce);
    tbb::parallel_for(range, [&](const tbb::blocked_range<std::size_t>& some) {
        for (std::size_t k = some.begin(); k < some.end(); ++k) {
            const Vec3 n = spots.different[k].normal;
            const Vec3 fixed = std::abs(n.x) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
            const Vec3 across = cross(n, fixed);
            const Vec3 right = (1.0 / length(across)) * across;
            const Vec3 up = cross(n, right);
            const Vec3 inside = spots.different[k].inside - dot(spots.different[k].inside, n) * n;
            const Vec3 from = occluders.scaled(spots.different[k].place) + kLift * (n + unit(inside, {}));
            int open = 0;
            for (const Vec3& d : directions) {
                open += occluders.meets(from, d.x * right + d.y * up + d.z * n) ? 0 : 1;
            }
            openness[k] = static_cast<float>(open) / kRays;
        }
    });
    std::vector<float> of_all;
    of_all.reserve(all.size());
    for (const std::uint32_t spot : spots.of) {
        of_all.push_back(openness[spot]);
    }
    return of_all;
}

}  // namespace

void StandOpenness::validate(std::size_t triangles) const
{
    require(divisions.size() == triangles, "options.stand_openness.divisions", divisions.size(),
            "as many as the stand's triangles");
    require(first.size() == triangles, "options.stand_openness.first", first.size(), "as many as divisions");
    require(back.empty() || back.size() == front.size(), "options.stand_openness.back", back.size(),
            "as many as front, or none");
    for (std::size_t t = 0; t < triangles; ++t) {
        require(divisions[t] > 0, "options.stand_openness.divisions", divisions[t], "above 0");
        require(first[t] + gridValues(divisions[t]) <= front.size(), "options.stand_openness.first", first[t],
                "inside front");
    }
    for (const std::vector<float>* const side : {&front, &back}) {
        for (const float value : *side) {
            require(value >= 0.0F && value <= 1.0F, "options.stand_openness", value, "from 0 to 1");
        }
    }
}

StandOpenness opennessOf(const TexturedMesh& object, const OpennessOptions& options)
{
    const Occluders occluders(object, options.is_clear);
    StandOpenness openness = gridsOver(object);
    std::vector<Spot> spots = spotsOf(object, openness);
    openness.front = opennessAt(spots, occluders);
    if (options.has_backs) {
        for (Spot& spot : spots) {
            spot.normal = -1.0 * spot.normal;
        }
        openness.back = opennessAt(spots, occluders);
    }
    return openness;
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
// P. Fournier, A. Habibi, P. Poulin, "Simulating the Flow of Liquid Droplets" (1998), section 4: illumination textures.
#include "render/base_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include "droplet/units.h"

namespace droplet {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kAngles = 6;
constexpr double kStep = 15.0 * kDegree;  // between the textures' angles
constexpr double kLampSize = 9.0 * kDegree;
constexpr int kCells = 72;
constexpr float kGrain = 1.2F;  // [cells]

/// Cap of a sphere on a disc of radius 1, open below.
Surface cap(double height)
{
    constexpr std::uint32_t kRings = 14;
    constexpr std::uint32_t kAround = 40;
    const double radius = 0.5 * (1.0 + height * height) / height;
    const double rim = 2.0 * std::atan(height);  // contact angle
    Surface surface;
    for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
        const double tilt = rim * ring / kRings;
        for (std::uint32_t k = 0; k < kAround; ++k) {
            const double turn = 2.0 * kPi * (k + 0.5) / kAround;
            const Vec3 normal{std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)};
            surface.normals.push_back(normal);
            surface.vertices.push_back(radius * normal + Vec3{0.0, 0.0, height - radius});
            if (ring == kRings) {
                surface.vertices.back().z = 0.0;
                continue;
            }
            const std::uint32_t a = ring * kAround + k;
            const std::uint32_t b = ring * kAround + (k + 1) % kAround;
            surface.triangles.push_back({a, a + kAround, b + kAround});
            if (ring > 0) {
                surface.triangles.push_back({a, b + kAround, b});
            }
        }
    }
    surface.uvs.resize(surface.vertices.size());
    surface.weld.resize(surface.vertices.size());
    std::iota(surface.weld.begin(), surface.weld.end(), std::uint32_t{0});
    return surface;
}

Vec3f towards(double tilt, double azimuth)
{
    return toFloats({std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt)});
}

/// Soft box in the plane y = 0, seen at an angle from the normal.
Light lampAt(double angle)
{
    constexpr int kBeams = 7;
    constexpr float kLowest = 0.05F;
    Light light;
    for (int k = 0; k < kBeams; ++k) {
        const double turn = 2.0 * kPi * k / (kBeams - 1);
        const double off = k + 1 < kBeams ? kLampSize : 0.0;
        Vec3f toward =
            unit(towards(angle, 0.0) + static_cast<float>(off * std::cos(turn)) * towards(angle + 0.5 * kPi, 0.0) +
                 Vec3f{0.0F, static_cast<float>(off * std::sin(turn)), 0.0F});
        toward.z = std::max(toward.z, kLowest);
        light.beams.push_back({unit(toward), 1.0F / kBeams});
    }
    return light;
}

/// Uniform light from all sides.
Light everywhere()
{
    constexpr int kBeams = 40;
    Light light;
    for (int k = 0; k < kBeams; ++k) {
        const double cosine = std::sqrt((k + 0.5) / kBeams);
        light.beams.push_back({towards(std::acos(cosine), k * kPi * (3.0 - std::sqrt(5.0))), 1.0F / kBeams});
    }
    return light;
}

}  // namespace

BaseLight::BaseLight(const RayTracer& scene, const Look& look, double mean_height,
                     const std::vector<DropletBase>& bases, const std::vector<Light>& lights)
{
    for (const Light& light : lights) {
        if (light.soft || light.beams.empty()) {
            continue;
        }
        Vec3f toward;
        for (const Beam& beam : light.beams) {
            toward = toward + beam.share * beam.toward;
        }
        toward = unit(toward);
        lamps_.push_back({toward, 1.0F / (std::numbers::pi_v<float> * std::max(toward.z, 0.05F)) * light.irradiance});
    }
    if (bases.empty()) {
        return;
    }
    makeTextures(look, mean_height, bases);
    const auto per_metre = static_cast<float>(scene.scale());
    for (const DropletBase& base : bases) {
        Spot spot;
        spot.place = scene.toScene(base.place);
        spot.normal = toFloats(base.normal);
        spot.ahead = per_metre / static_cast<float>(base.half_length) * toFloats(base.ahead);
        spot.left = per_metre / static_cast<float>(base.half_width) * toFloats(cross(base.normal, base.ahead));
        spot.size = static_cast<float>(std::sqrt(base.half_length * base.half_width)) / per_metre;
        spot.reach = margin_ * static_cast<float>(std::max(base.half_length, base.half_width)) / per_metre;
        spots_.push_back(spot);
        for (const Lamp& lamp : lamps_) {
            turns_.push_back(turnOf(spot, lamp.toward));
        }
    }
    sortSpots();
}

void BaseLight::makeTextures(const Look& look, double mean_height, const std::vector<DropletBase>& bases)
{
    double aspect = 0.0;
    double radius = 0.0;
    for (const DropletBase& base : bases) {
        const double size = std::sqrt(base.half_length * base.half_width);
        aspect += base.height / size / static_cast<double>(bases.size());
        radius += size / static_cast<double>(bases.size());
    }
    const Surface droplet = cap(std::clamp(aspect, 0.1, 1.5));
    const RayTracer scene(droplet, {});
    const Media media{mediumOf(look, mean_height, radius * scene.scale())};
    // Places in radii instead of the scene's units.
    const auto in_radii = [&](LightMap map) {
        const auto scale = static_cast<float>(scene.scale());
        map.cell *= scale;
        map.low = scale * map.low;
        return map;
    };
    for (int k = 0; k < kAngles; ++k) {
        by_angle_.push_back(in_radii(lightGain(scene, media, lampAt(k * kStep), kCells, kGrain)));
    }
    soft_ = in_radii(lightGain(scene, media, everywhere(), kCells / 2, kGrain));
    margin_ = -soft_.low.x;
}

std::uint64_t BaseLight::cellOf(int x, int y, int z) const
{
    constexpr int kHalf = 1 << 20;
    const auto part = [](int at) { return static_cast<std::uint64_t>(std::clamp(at + kHalf, 0, 2 * kHalf - 1)); };
    return part(x) << 42U | part(y) << 21U | part(z);
}

void BaseLight::sortSpots()
{
    constexpr int kMostCells = 8;  // that a droplet reaches, along each axis
    std::vector<float> reaches;
    for (const Spot& spot : spots_) {
        reaches.push_back(spot.reach);
    }
    const auto middle = reaches.begin() + static_cast<std::ptrdiff_t>(reaches.size() / 2);
    std::nth_element(reaches.begin(), middle, reaches.end());
    cell_ = 2.0F * std::max(*middle, *std::max_element(reaches.begin(), reaches.end()) / kMostCells);
    for (std::uint32_t k = 0; k < spots_.size(); ++k) {
        const Spot& spot = spots_[k];
        const auto at = [&](float p) { return static_cast<int>(std::floor(p / cell_)); };
        for (int z = at(spot.place.z - spot.reach); z <= at(spot.place.z + spot.reach); ++z) {
            for (int y = at(spot.place.y - spot.reach); y <= at(spot.place.y + spot.reach); ++y) {
                for (int x = at(spot.place.x - spot.reach); x <= at(spot.place.x + spot.reach); ++x) {
                    in_cell_[cellOf(x, y, z)].push_back(k);
                }
            }
        }
    }
}

BaseLight::Turn BaseLight::turnOf(const Spot& spot, Vec3f toward) const
{
    const float cosine = dot(toward, spot.normal);
    if (cosine <= 0.05F) {
        return {};
    }
    // The texture's x axis is toward the light.
    const Vec2 lamp{static_cast<double>(dot(toward, spot.ahead)), static_cast<double>(dot(toward, spot.left))};
    const double size = length(lamp);
    const float at = std::acos(std::min(cosine, 1.0F)) / static_cast<float>(kStep);
    const auto below = std::min(static_cast<std::size_t>(at), by_angle_.size() - 2);
    return {size > 1e-6 ? (1.0 / size) * lamp : Vec2{1.0, 0.0}, below, std::min(at - static_cast<float>(below), 1.0F),
            true};
}

Vec3f BaseLight::gain(const Turn& turn, Vec2 place) const
{
    if (!turn.is_lit) {
        return grey(1.0F);
    }
    const Vec3f turned = toFloats({dot(turn.x, place), cross(turn.x, place), 0.0});
    return mix(by_angle_[turn.below].at(turned), by_angle_[turn.below + 1].at(turned), turn.share);
}

Vec3f BaseLight::at(Vec3f place, Vec3f normal, Vec3f open) const
{
    const auto cell = [&](float p) { return static_cast<int>(std::floor(p / cell_)); };
    const auto found = in_cell_.find(cellOf(cell(place.x), cell(place.y), cell(place.z)));
    if (found == in_cell_.end()) {
        return open;
    }
    Vec3f change;
    Vec3f soft = open;
    for (const Lamp& lamp : lamps_) {
        soft = soft - std::max(dot(normal, lamp.toward), 0.0F) * lamp.irradiance;
    }
    soft = {std::max(soft.x, 0.0F), std::max(soft.y, 0.0F), std::max(soft.z, 0.0F)};
    for (const std::uint32_t k : found->second) {
        const Spot& spot = spots_[k];
        const Vec3f offset = place - spot.place;
        const Vec2 local{static_cast<double>(dot(offset, spot.ahead)), static_cast<double>(dot(offset, spot.left))};
        const double margin = static_cast<double>(margin_);
        if (dot(local, local) > margin * margin || std::abs(dot(offset, spot.normal)) > spot.size ||
            dot(normal, spot.normal) < 0.0F) {
            continue;
        }
        const auto away = static_cast<float>(length(local));
        const float share = 1.0F - smoothstep(0.7F * margin_, margin_, away);
        change = change + share * (soft_.at(toFloats({local.x, local.y, 0.0})) - grey(1.0F)) * soft;
        for (std::size_t i = 0; i < lamps_.size(); ++i) {
            const Lamp& lamp = lamps_[i];
            const float cosine = dot(normal, lamp.toward);
            if (cosine > 0.0F) {
                change = change +
                         share * cosine * (gain(turns_[k * lamps_.size() + i], local) - grey(1.0F)) * lamp.irradiance;
            }
        }
    }
    constexpr float kDarkest = 0.1F;
    const Vec3f sum = open + change;
    return {std::max(sum.x, kDarkest * open.x), std::max(sum.y, kDarkest * open.y), std::max(sum.z, kDarkest * open.z)};
}

}  // namespace droplet

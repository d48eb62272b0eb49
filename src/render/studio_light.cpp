// SPDX-License-Identifier: GPL-3.0-or-later
// R. Ramamoorthi, P. Hanrahan, "An Efficient Representation for Irradiance Environment Maps" (2001).
#include "render/studio_light.h"

#include <algorithm>
#include <numbers>
#include <span>
#include <utility>

#include "droplet/units.h"

namespace droplet {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// Factor of a cosine lobe for each band of spherical harmonics, divided by π.
constexpr std::array<float, 9> kLobe = {1.0F, 2.0F / 3.0F, 2.0F / 3.0F, 2.0F / 3.0F, 0.25F, 0.25F, 0.25F, 0.25F, 0.25F};

struct BoxPlace {
    double azimuth;    // counter-clockwise from the picture's right [°]
    double elevation;  // [°]
    float half_width;
    float half_height;
    Vec3f radiance;
};

// Values are chosen by eye. The key light is warm, low and small, so that every stroke of water casts a bright and a
// dark edge. A band high on the left is reflected by every edge that faces it, also toward a camera above. The band on
// the right is cool.
constexpr std::array<BoxPlace, 3> kBoxes = {{
    {126.0, 33.0, 0.14F, 0.10F, {128.0F, 119.0F, 106.0F}},
    {138.0, 56.0, 0.90F, 0.060F, {18.0F, 18.5F, 19.0F}},
    {28.0, 30.0, 0.06F, 0.36F, {14.0F, 16.5F, 19.6F}},
}};
constexpr std::array<BoxPlace, 3> kBoxesUpright = {{
    {-146.0, 36.0, 0.24F, 0.34F, {26.0F, 24.8F, 22.9F}},
    {-14.0, 18.0, 0.07F, 0.60F, {9.0F, 10.3F, 12.3F}},
    {150.0, 30.0, 0.16F, 0.50F, {8.0F, 8.8F, 9.9F}},
}};

Vec3f towards(double azimuth, double elevation)
{
    const double a = azimuth * kDegree;
    const double e = elevation * kDegree;
    return toFloats({std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)});
}

// Directions spread evenly over the sphere by the golden angle.
Vec3f onSphere(int index, int count)
{
    const float z = 1.0F - 2.0F * (static_cast<float>(index) + 0.5F) / static_cast<float>(count);
    const double angle = index * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const float radius = std::sqrt(1.0F - z * z);
    return {radius * static_cast<float>(std::cos(angle)), radius * static_cast<float>(std::sin(angle)), z};
}

std::array<float, 9> basis(Vec3f d)
{
    return {0.282095F,
            0.488603F * d.y,
            0.488603F * d.z,
            0.488603F * d.x,
            1.092548F * d.x * d.y,
            1.092548F * d.y * d.z,
            0.315392F * (3.0F * d.z * d.z - 1.0F),
            1.092548F * d.x * d.z,
            0.546274F * (d.x * d.x - d.y * d.y)};
}

Light lightOf(const SoftBox& box, int across, int upward)
{
    Light light;
    float total = 0.0F;
    for (int i = 0; i < across; ++i) {
        for (int j = 0; j < upward; ++j) {
            const float x = (2.0F * static_cast<float>(i) + 1.0F) / static_cast<float>(across) - 1.0F;
            const float y = (2.0F * static_cast<float>(j) + 1.0F) / static_cast<float>(upward) - 1.0F;
            const Vec3f ahead = box.centre + x * box.half_width * box.right + y * box.half_height * box.up;
            const Vec3f toward = unit(ahead);
            // Solid angle of this part of the rectangle at distance 1.
            const float angle = 4.0F * box.half_width * box.half_height / static_cast<float>(across * upward) /
                                std::pow(dot(ahead, ahead), 1.5F);
            const Vec3f irradiance = angle * toward.z * box.seen(toward);
            light.beams.push_back({toward, irradiance.y});
            light.irradiance = light.irradiance + irradiance;
            total += irradiance.y;
        }
    }
    for (Beam& beam : light.beams) {
        beam.share /= total;
    }
    return light;
}

}  // namespace

Vec3f SoftBox::seen(Vec3f direction) const
{
    const float ahead = dot(direction, centre);
    if (ahead <= 1e-3F) {
        return {};
    }
    const float x = std::abs(dot(direction, right)) / (ahead * half_width);
    const float y = std::abs(dot(direction, up)) / (ahead * half_height);
    if (std::max(x, y) > 1.2F) {
        return {};
    }
    const float x2 = x * x;
    const float y2 = y * y;
    const float reach = std::sqrt(std::sqrt(x2 * x2 + y2 * y2));
    const float cloth = 1.0F - 0.35F * std::min(0.5F * (x2 + y2), 1.0F);
    return (1.0F - smoothstep(0.90F, 1.06F, reach)) * cloth * radiance;
}

StudioLight::StudioLight(const RenderOptions& options, CameraTurn turn)
    : uniform_(options.lighting == Lighting::Uniform),
      shows_room_(options.shows_room),
      back_{turn.cosine, -turn.sine},
      harmonics_{}
{
    constexpr float kIrradiance = 6.0F;  // about the studio's
    if (options.environment && !uniform_) {
        sky_.emplace(*options.environment, kIrradiance);
        addSky(turn);
        return;
    }
    if (!uniform_) {
        addBoxes(options.stand && options.shows_whole_stand, turn);
    }
    addRoom(turn);
    constexpr int kDirections = 4096;
    for (int i = 0; i < kDirections; ++i) {
        const Vec3f d = onSphere(i, kDirections);
        const std::array<float, 9> values = basis(d);
        for (std::size_t k = 0; k < values.size(); ++k) {
            harmonics_[k] = harmonics_[k] + 4.0F * kPi / kDirections * kLobe[k] * values[k] * radiance(d);
        }
    }
}

void StudioLight::addBoxes(bool upright, CameraTurn turn)
{
    const auto places = upright ? std::span<const BoxPlace>(kBoxesUpright) : std::span<const BoxPlace>(kBoxes);
    for (const BoxPlace& place : places) {
        SoftBox box;
        box.centre = turn(towards(place.azimuth, place.elevation));
        box.right = unit(cross(box.centre, {0.0F, 0.0F, 1.0F}));
        box.up = cross(box.right, box.centre);
        box.half_width = place.half_width;
        box.half_height = place.half_height;
        box.radiance = place.radiance;
        boxes_.push_back(box);
    }
    lights_.push_back(lightOf(boxes_[0], 4, 3));
    for (std::size_t k = 1; k < boxes_.size(); ++k) {
        const bool upright_box = boxes_[k].half_height > boxes_[k].half_width;
        lights_.push_back(upright_box ? lightOf(boxes_[k], 1, 5) : lightOf(boxes_[k], 5, 1));
    }
}

void StudioLight::addRoom(CameraTurn turn)
{
    // The room becomes beams of equal weight, spread evenly over the squared cosine of elevation (Lambert's law).
    constexpr int kRoomBeams = 48;
    Light sky;
    sky.soft = true;
    float total = 0.0F;
    for (int i = 0; i < kRoomBeams; ++i) {
        const float z = std::sqrt((static_cast<float>(i) + 0.5F) / kRoomBeams);
        const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
        const float radius = std::sqrt(1.0F - z * z);
        const Vec3f toward =
            turn({radius * static_cast<float>(std::cos(angle)), radius * static_cast<float>(std::sin(angle)), z});
        const Vec3f irradiance = kPi / kRoomBeams * room(toward);
        sky.beams.push_back({toward, irradiance.y});
        sky.irradiance = sky.irradiance + irradiance;
        total += irradiance.y;
    }
    for (Beam& beam : sky.beams) {
        beam.share /= total;
    }
    lights_.push_back(std::move(sky));
}

void StudioLight::addSky(CameraTurn turn)
{
    // The parts far brighter than the rest cast detailed shadows from few directions; the rest is soft.
    constexpr std::size_t kMaxBeams = 16;
    constexpr float kBright = 4.0F;  // limit over the mean radiance
    std::vector<Sky::Cell> cells = sky_->cells();
    std::stable_sort(cells.begin(), cells.end(),
                     [](const Sky::Cell& a, const Sky::Cell& b) { return a.radiance.y > b.radiance.y; });
    float mean = 0.0F;
    for (const Sky::Cell& cell : cells) {
        mean += cell.angle * cell.radiance.y / (4.0F * kPi);
    }
    Light key;
    Light rest;
    rest.soft = true;
    constexpr float kLowest = 0.05F;
    for (const Sky::Cell& cell : cells) {
        const Vec3f toward = turn(cell.toward);
        const std::array<float, 9> values = basis(toward);
        for (std::size_t k = 0; k < values.size(); ++k) {
            harmonics_[k] = harmonics_[k] + cell.angle * kLobe[k] * values[k] * cell.radiance;
        }
        if (toward.z < kLowest) {
            continue;
        }
        const bool is_key = cell.radiance.y > kBright * mean && key.beams.size() < kMaxBeams;
        Light& light = is_key ? key : rest;
        const Vec3f irradiance = cell.angle * toward.z * cell.radiance;
        light.beams.push_back({toward, irradiance.y});
        light.irradiance = light.irradiance + irradiance;
    }
    // For the soft rest, a regular selection of cells represents all.
    constexpr std::size_t kSoftBeams = 64;
    std::vector<Beam> few;
    for (std::size_t k = 0; k < kSoftBeams && !rest.beams.empty(); ++k) {
        few.push_back(rest.beams[k * rest.beams.size() / kSoftBeams]);
    }
    rest.beams = std::move(few);
    for (Light* light : {&key, &rest}) {
        float total = 0.0F;
        for (const Beam& beam : light->beams) {
            total += beam.share;
        }
        if (total > 0.0F) {
            for (Beam& beam : light->beams) {
                beam.share /= total;
            }
            lights_.push_back(std::move(*light));
        }
    }
    if (lights_.empty()) {
        lights_.emplace_back();  // all light comes from below
    }
}

Vec3f StudioLight::skyAt(Vec3f direction) const
{
    return sky_->at(back_(direction));
}

Vec3f StudioLight::room(Vec3f direction) const
{
    if (uniform_) {
        return grey(1.0F);
    }
    constexpr Vec3f kFloor = {0.11F, 0.13F, 0.15F};
    constexpr Vec3f kWall = {1.12F, 1.15F, 1.20F};
    constexpr Vec3f kCeiling = {0.35F, 0.34F, 0.34F};
    const float z = direction.z;
    return z < 0.25F ? mix(kFloor, kWall, smoothstep(-0.15F, 0.25F, z))
                     : mix(kWall, kCeiling, smoothstep(0.25F, 1.0F, z));
}

Vec3f StudioLight::radiance(Vec3f direction) const
{
    if (sky_) {
        return skyAt(direction);
    }
    Vec3f sum = room(direction);
    for (const SoftBox& box : boxes_) {
        sum = sum + box.seen(direction);
    }
    return sum;
}

Vec3f StudioLight::backdrop(Vec3f direction) const
{
    if (uniform_) {
        return grey(1.0F);
    }
    if (sky_) {
        return skyAt(direction);
    }
    if (shows_room_) {
        return radiance(direction);
    }
    return mix(kDistance, {0.20F, 0.27F, 0.32F}, smoothstep(0.0F, 0.6F, direction.z));
}

Vec3f StudioLight::diffuse(Vec3f normal) const
{
    const std::array<float, 9> values = basis(normal);
    Vec3f sum;
    for (std::size_t k = 0; k < values.size(); ++k) {
        sum = sum + values[k] * harmonics_[k];
    }
    return {std::max(sum.x, 0.0F), std::max(sum.y, 0.0F), std::max(sum.z, 0.0F)};
}

Vec3f StudioLight::level() const
{
    Vec3f sum;
    for (const Light& light : lights_) {
        sum = sum + light.irradiance;
    }
    return sum;
}

}  // namespace droplet

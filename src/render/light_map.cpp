// SPDX-License-Identifier: GPL-3.0-or-later
// Rays start at the lamps: J. Arvo, "Backward Ray Tracing" (1986). They form a regular grid, so there is no noise; sums
// are integers, so their order does not matter.
#include "render/light_map.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>
#include <numbers>

#include "render/facets.h"

namespace droplet {
namespace {

/// Coefficients of absorption, per length of a scene with this unit.
Vec3f absorptionOf(const Attenuation& attenuation, double scale)
{
    const auto per_length = [&](double share) {
        return static_cast<float>(-std::log(share) / attenuation.distance * scale);
    };
    return {per_length(attenuation.colour.x), per_length(attenuation.colour.y), per_length(attenuation.colour.z)};
}

constexpr float kOne =
    static_cast<float>(1 << 24);  // value 1 in the sums: resolution 1e-7 of a cell's light, range 2³⁹ times 1

class Gatherer {
public:
    Gatherer(const RayTracer& scene, const Media& media, LightMap& map)
        : scene_(scene), media_(media), map_(map), sums_(3 * map.values.size())
    {
    }

    // Follows a ray that would arrive at `place` without liquid.
    void send(Vec3f place, const Beam& beam)
    {
        const float reach = (scene_.high().z + 0.01F) / beam.toward.z;
        const RayF ray{place + reach * beam.toward, -1.0F * beam.toward};
        const Meeting meeting = scene_.fromAir(ray);
        if (meeting.what != Meeting::What::Liquid) {
            return;
        }
        add(place, grey(-beam.share));
        bend(ray, meeting, beam.share);
    }

    // Follows a ray that meets liquid.
    void bend(const RayF& ray, const Meeting& meeting, float light)
    {
        meetLiquid(ray, meeting, {grey(light), kMin * light, false, 0, 0});
    }

    // Position in the map of a place on the ground.
    [[nodiscard]] Vec3f spot(const Meeting& meeting) const
    {
        return scene_.onPlane() ? meeting.place
                                : Vec3f{static_cast<float>(meeting.uv.x), static_cast<float>(meeting.uv.y), 0.0F};
    }

    void finish(float before)
    {
        for (std::size_t i = 0; i < map_.values.size(); ++i) {
            const auto value = [&](std::size_t c) { return before + static_cast<float>(sums_[3 * i + c]) / kOne; };
            map_.values[i] = {value(0), value(1), value(2)};
        }
    }

    void add(Vec3f place, Vec3f light)
    {
        const float x = (place.x - map_.low.x) / map_.cell - 0.5F;
        const float y = (place.y - map_.low.y) / map_.cell - 0.5F;
        if (!(x > -1.0F && y > -1.0F && x < static_cast<float>(map_.columns) && y < static_cast<float>(map_.rows))) {
            return;
        }
        const float whole_x = std::floor(x);
        const float whole_y = std::floor(y);
        for (int j = 0; j < 2; ++j) {
            for (int i = 0; i < 2; ++i) {
                const int column = static_cast<int>(whole_x) + i;
                const int row = static_cast<int>(whole_y) + j;
                if (column < 0 || row < 0 || column >= map_.columns || row >= map_.rows) {
                    continue;
                }
                const float weight =
                    (i == 0 ? 1.0F - (x - whole_x) : x - whole_x) * (j == 0 ? 1.0F - (y - whole_y) : y - whole_y);
                const std::size_t at = 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(map_.columns) +
                                            static_cast<std::size_t>(column));
                const Vec3f part = weight * kOne * light;
                addTo(sums_[at], part.x);
                addTo(sums_[at + 1], part.y);
                addTo(sums_[at + 2], part.z);
            }
        }
    }

private:
    static constexpr int kMaxMeetings = 6;
    static constexpr float kMin = 1e-3F;  // minimum light of a ray that is followed, times its share

    struct Way {
        Vec3f light;
        float min;  // a ray with less light is not followed
        bool inside;
        int meetings;
        std::uint32_t droplet;  // that the ray is inside of
    };

    void follow(const RayF& ray, Way way)
    {
        // Light that goes up into the air again is lost.
        if (way.meetings > kMaxMeetings || largest(way.light) < way.min ||
            (!way.inside && scene_.onPlane() && ray.direction.z >= 0.0F)) {
            return;
        }
        const Meeting meeting = way.inside ? scene_.fromLiquid(ray) : scene_.fromAir(ray);
        if (meeting.what == Meeting::What::Nothing) {
            return;
        }
        if (way.inside) {
            way.light = way.light * passed(media_.of(way.droplet), meeting.distance);
        }
        if (meeting.what == Meeting::What::Ground) {
            add(spot(meeting), way.light);
            return;
        }
        meetLiquid(ray, meeting, way);
    }

    void meetLiquid(const RayF& ray, const Meeting& meeting, const Way& way)
    {
        const std::uint32_t droplet = media_.dropletAt(scene_, meeting);
        const Medium& medium = media_.of(droplet);
        if (!medium.clear) {
            return;
        }
        Vec3f normal = facing(ray.direction, way.inside ? -1.0F * meeting.normal : meeting.normal);
        if (!isSmooth(medium.roughness)) {
            const std::uint32_t shift = hashOf(meeting.place.x, meeting.place.y);
            normal = facing(ray.direction, facetNormal(ray.direction, normal, medium.roughness, facetChoice(0, shift)));
        }
        const Interface there = atInterface(ray.direction, normal, way.inside ? medium.ior : 1.0F / medium.ior);
        const auto onward = [&](float share, bool inside) {
            return Way{share * way.light, way.min, inside, way.meetings + 1, droplet};
        };
        follow({meeting.place, mirrored(ray.direction, normal)}, onward(there.reflected, way.inside));
        if (there.reflected < 1.0F) {
            Way through = onward(1.0F - there.reflected, !way.inside);
            if (!way.inside) {
                through.light = medium.transmission * through.light;
                if (media_.map) {
                    through.light = media_.mapAt(meeting, 0.0) * through.light;
                }
            }
            follow({meeting.place, there.transmitted}, through);
        }
    }

    static void addTo(std::int64_t& sum, float value)
    {
        std::atomic_ref(sum).fetch_add(std::llrint(value), std::memory_order_relaxed);
    }

    const RayTracer& scene_;
    const Media& media_;
    LightMap& map_;
    std::vector<std::int64_t> sums_;
};

void blurRows(std::vector<Vec3f>& values, int columns, int rows, const std::vector<float>& weights)
{
    const int reach = static_cast<int>(weights.size()) - 1;
    tbb::parallel_for(0, rows, [&](int row) {
        Vec3f* line = values.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(columns);
        const std::vector<Vec3f> from(line, line + columns);
        for (int x = 0; x < columns; ++x) {
            Vec3f sum;
            for (int k = -reach; k <= reach; ++k) {
                const auto at = static_cast<std::size_t>(std::clamp(x + k, 0, columns - 1));
                sum = sum + weights[static_cast<std::size_t>(std::abs(k))] * from[at];
            }
            line[x] = sum;
        }
    });
}

std::vector<Vec3f> transposed(const std::vector<Vec3f>& values, int columns, int rows)
{
    std::vector<Vec3f> turned(values.size());
    for (std::size_t y = 0; y < static_cast<std::size_t>(rows); ++y) {
        for (std::size_t x = 0; x < static_cast<std::size_t>(columns); ++x) {
            turned[x * static_cast<std::size_t>(rows) + y] = values[y * static_cast<std::size_t>(columns) + x];
        }
    }
    return turned;
}

void blurMap(LightMap& map, float deviation)
{
    std::vector<float> weights;
    float total = 0.0F;
    for (int k = 0; static_cast<float>(k) <= 3.0F * deviation; ++k) {
        const float t = static_cast<float>(k) / deviation;
        weights.push_back(std::exp(-0.5F * t * t));
        total += (k == 0 ? 1.0F : 2.0F) * weights.back();
    }
    for (float& weight : weights) {
        weight /= total;
    }
    blurRows(map.values, map.columns, map.rows, weights);
    std::vector<Vec3f> turned = transposed(map.values, map.columns, map.rows);
    blurRows(turned, map.rows, map.columns, weights);
    map.values = transposed(turned, map.rows, map.columns);
}

}  // namespace

Medium mediumOf(const Look& look, double mean_height, double scale)
{
    Medium medium{look.transmission > 0.0,
                  static_cast<float>(look.ior),
                  {},
                  look.roughness,
                  static_cast<float>(look.transmission)};
    if (look.tinted && mean_height > 0.0) {
        medium.absorption = absorptionOf(attenuationOf(look, mean_height), scale);
    }
    return medium;
}

Medium mediumOf(const StandLook& look, double scale)
{
    return {true, static_cast<float>(look.look.ior), look.absorption ? absorptionOf(*look.absorption, scale) : Vec3f{}};
}

Media mediaOf(const Surface& surface, const RenderOptions& options, double scale)
{
    Media media{mediumOf(options.look, surface.mean_height, scale)};
    if (options.colour_map) {
        media.map.emplace(*options.colour_map);
    }
    if (options.looks.empty()) {
        return media;
    }
    for (const Look& look : options.looks) {
        media.several.push_back(mediumOf(look, surface.mean_height, scale));
    }
    for (const SurfacePart& part : surface.parts) {
        media.several[part.droplet] = mediumOf(options.looks[part.droplet], part.volume / part.area, scale);
        media.droplet.insert(media.droplet.end(), part.vertices, static_cast<std::uint32_t>(part.droplet));
    }
    return media;
}

Vec3f LightMap::at(Vec3f place) const
{
    const float x = (place.x - low.x) / cell - 0.5F;
    const float y = (place.y - low.y) / cell - 0.5F;
    const auto last_x = static_cast<float>(columns - 1);
    const auto last_y = static_cast<float>(rows - 1);
    if (!(x > 0.0F && y > 0.0F && x < last_x && y < last_y)) {
        return open;
    }
    const auto column = static_cast<std::size_t>(x);
    const auto row = static_cast<std::size_t>(y);
    const auto width = static_cast<std::size_t>(columns);
    const float fx = x - static_cast<float>(column);
    const float fy = y - static_cast<float>(row);
    const Vec3f* corner = values.data() + row * width + column;
    return mix(mix(corner[0], corner[1], fx), mix(corner[width], corner[width + 1], fx), fy);
}

LightMap lightGain(const RayTracer& scene, const Media& media, const Light& light, int cells, float blur)
{
    const Vec3f size = scene.high() - scene.low();
    const float span = std::max(size.x, size.y);
    const float margin = std::max(0.15F * span, 1.5F * size.z);
    LightMap map;
    map.cell = (span + 2.0F * margin) / static_cast<float>(cells);
    map.low = {scene.low().x - margin, scene.low().y - margin, 0.0F};
    map.columns = static_cast<int>(std::ceil((size.x + 2.0F * margin) / map.cell));
    map.rows = static_cast<int>(std::ceil((size.y + 2.0F * margin) / map.cell));
    map.values.resize(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows));

    Gatherer gatherer(scene, media, map);
    for (std::size_t b = 0; b < light.beams.size(); ++b) {
        const Beam& beam = light.beams[b];
        // The box around the liquid, projected along the beam onto the plane, holds all rays that can meet it.
        const Vec3f far = -(scene.high().z / beam.toward.z) * beam.toward;
        const Vec3f near = -(scene.low().z / beam.toward.z) * beam.toward;
        const auto cells_from = [&](float a, float from) {
            return static_cast<int>(std::floor((a - from) / map.cell));
        };
        const int first_column = cells_from(scene.low().x + std::min(far.x, near.x), map.low.x);
        const int last_column = cells_from(scene.high().x + std::max(far.x, near.x), map.low.x);
        const int first_row = cells_from(scene.low().y + std::min(far.y, near.y), map.low.y);
        const int last_row = cells_from(scene.high().y + std::max(far.y, near.y), map.low.y);
        // Every beam's grid has another offset within the cells, so that together they are denser than one.
        const float offset_x = std::fmod(0.5F + 0.7548777F * static_cast<float>(b), 1.0F);
        const float offset_y = std::fmod(0.5F + 0.5698403F * static_cast<float>(b), 1.0F);
        tbb::parallel_for(first_row, last_row + 1, [&](int row) {
            for (int column = first_column; column <= last_column; ++column) {
                gatherer.send(map.low + Vec3f{(static_cast<float>(column) + offset_x) * map.cell,
                                              (static_cast<float>(row) + offset_y) * map.cell, 0.0F},
                              beam);
            }
        });
    }
    gatherer.finish(1.0F);
    if (blur > 0.0F) {
        blurMap(map, blur);
    }
    return map;
}

LightMap lightOnPlane(const RayTracer& scene, const Media& media, const std::vector<Light>& lights, int cells)
{
    constexpr int kCoarser = 4;
    constexpr float kGrain = 1.3F;    // [cells]
    constexpr float kMargin = 0.08F;  // share of the map in which it blends into open light
    LightMap sum;
    for (const Light& light : lights) {
        const LightMap gain = lightGain(scene, media, light, light.soft ? cells / kCoarser : cells, kGrain);
        const Vec3f radiance = std::numbers::inv_pi_v<float> * light.irradiance;
        if (sum.values.empty()) {
            sum = gain;
            sum.values.assign(gain.values.size(), Vec3f{});
            sum.open = {};
        }
        sum.open = sum.open + radiance;
        tbb::parallel_for(0, sum.rows, [&](int row) {
            for (int column = 0; column < sum.columns; ++column) {
                const Vec3f centre = sum.low + Vec3f{(static_cast<float>(column) + 0.5F) * sum.cell,
                                                     (static_cast<float>(row) + 0.5F) * sum.cell, 0.0F};
                Vec3f& value = sum.values[static_cast<std::size_t>(row) * static_cast<std::size_t>(sum.columns) +
                                          static_cast<std::size_t>(column)];
                value = value + radiance * gain.at(centre);
            }
        });
    }
    const auto inside = [](int at, int count) { return static_cast<float>(std::min(at, count - 1 - at)); };
    const float margin = kMargin * static_cast<float>(std::max(sum.columns, sum.rows));
    for (int row = 0; row < sum.rows; ++row) {
        for (int column = 0; column < sum.columns; ++column) {
            const float away = std::min(inside(row, sum.rows), inside(column, sum.columns)) / margin;
            Vec3f& value = sum.values[static_cast<std::size_t>(row) * static_cast<std::size_t>(sum.columns) +
                                      static_cast<std::size_t>(column)];
            value = mix(sum.open, value, smoothstep(0.0F, 1.0F, away));
        }
    }
    return sum;
}

LightMap lightGainOnStand(const RayTracer& scene, const Media& media, const Light& light, int cells)
{
    constexpr float kGrain = 2.0F;         // [cells]
    constexpr float kRaysForACell = 0.7F;  // rays per cell along a side
    LightMap map;
    map.columns = map.rows = cells;
    map.cell = 1.0F / static_cast<float>(cells);
    map.values.resize(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells));
    LightMap dry = map;
    Gatherer change(scene, media, map);
    Gatherer straight(scene, media, dry);
    const Vec3f middle = 0.5F * (scene.low() + scene.high());
    const Vec3f size = scene.high() - scene.low();
    const float reach = 0.52F * std::sqrt(dot(size, size));
    const auto rays = static_cast<int>(kRaysForACell * static_cast<float>(cells));
    for (std::size_t b = 0; b < light.beams.size(); ++b) {
        const Beam& beam = light.beams[b];
        const Vec3f right = unit(cross(beam.toward, {0.0F, 0.0F, 1.0F}));
        const Vec3f up = cross(right, beam.toward);
        const float offset = std::fmod(0.5F + 0.7548777F * static_cast<float>(b), 1.0F);
        const float other_offset = std::fmod(0.5F + 0.5698403F * static_cast<float>(b), 1.0F);
        tbb::parallel_for(0, rays, [&](int row) {
            const auto across = [&](float at) { return reach * (2.0F * at / static_cast<float>(rays) - 1.0F); };
            for (int column = 0; column < rays; ++column) {
                const RayF ray{middle + 4.0F * beam.toward + across(static_cast<float>(column) + offset) * right +
                                   across(static_cast<float>(row) + other_offset) * up,
                               -1.0F * beam.toward};
                const Meeting ground = scene.dry(ray);
                if (ground.what != Meeting::What::Ground) {
                    continue;
                }
                straight.add(straight.spot(ground), grey(beam.share));
                const Meeting meeting = scene.fromAir(ray);
                if (meeting.what == Meeting::What::Liquid) {
                    change.add(change.spot(ground), grey(-beam.share));
                    change.bend(ray, meeting, beam.share);
                }
            }
        });
    }
    change.finish(0.0F);
    straight.finish(0.0F);
    blurMap(map, kGrain);
    blurMap(dry, kGrain);
    float max = 0.0F;
    for (const Vec3f& value : dry.values) {
        max = std::max(max, value.x);
    }
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        // Where little light falls the share is noise.
        const float there = dry.values[i].x + 0.02F * max;
        const Vec3f gain = grey(1.0F) + (1.0F / std::max(there, 1e-12F)) * map.values[i];
        map.values[i] = {std::clamp(gain.x, 0.0F, 4.0F), std::clamp(gain.y, 0.0F, 4.0F),
                         std::clamp(gain.z, 0.0F, 4.0F)};
    }
    return map;
}

}  // namespace droplet

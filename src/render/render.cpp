// SPDX-License-Identifier: GPL-3.0-or-later
// T. Whitted, "An Improved Illumination Model for Shaded Display" (1980): rays branch at every surface; nothing is
// random. Wet ground is darker than dry ground: J. Lekner, M. C. Dorf, "Why some things are darker when wet" (1988).
// Samples within a pixel: I. M. Sobol', "On the distribution of points in a cube" (1967).
#include "droplet/render/render.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "drawing/tone.h"
#include "droplet/error.h"
#include "entry_named.h"
#include "number_text.h"
#include "render/base_light.h"
#include "render/camera.h"
#include "render/facets.h"
#include "render/legend.h"
#include "render/light_map.h"
#include "render/optics.h"
#include "render/ray_tracer.h"
#include "render/stand_film.h"
#include "render/studio_light.h"
#include "render/table.h"
#include "render/triangle_grid.h"
#include "require.h"

namespace droplet {
namespace {

constexpr int kMaxPixels = 8192;
constexpr int kMinSamples = 4;
constexpr int kMaxSamples = 256;
constexpr float kCovering = 60e-6F;  // thickness of a film that covers the ground's bumps [m]
constexpr float kWhite = 0.85F;      // level of open white ground before the filmic curve
constexpr float kPi = 3.14159265F;

// Beyond these limits a ray ends in the room's light.
constexpr int kMaxMeetings = 9;
constexpr float kMinWeight = 0.004F;  // one level of 255

// Facets of rough liquid in one sample of a pixel: at 16 samples the grain of frosted glass has a deviation of 3 of
// 255.
constexpr std::uint32_t kFacets = 8;
// Share of the facets that are seen. The few that tilt most would show lamps as single bright pixels.
constexpr float kSeenFacets = 0.9F;

// Cells of the light map along its longer side, per pixel of the picture's longer side.
constexpr double kLightCells = 0.36;
constexpr double kStandCells = 0.45;  // likewise for the light on a stand, along its texture
constexpr int kMinLightCells = 64;
constexpr int kMaxLightCells = 1024;

[[noreturn]] void refuse(const std::string& text)
{
    throw Error(ErrorCode::InvalidArgument, "options." + text);
}

/// Filmic curve (J. Hable's form, fitted by K. Narkowicz).
Vec3f filmic(Vec3f a)
{
    const auto curve = [](float light) {
        const float x = std::max(light, 0.0F);
        return std::min(x * (2.51F * x + 0.03F) / (x * (2.43F * x + 0.59F) + 0.14F), 1.0F);
    };
    return {curve(a.x), curve(a.y), curve(a.z)};
}

/// What a ray sees: everything; everything on black ground; or only white ground through the liquid.
enum class Part { All, Own, Through };

class Tracer {
public:
    Tracer(const Surface& surface, const RenderOptions& options)
        : options_(options),
          turn_(turnedBack(options.azimuth)),
          scene_(surface, options),
          studio_(options, turn_),
          media_(mediaOf(surface, options, scene_.scale())),
          camera_(framedPoints(), scene_, options,
                  options.paint ? legendWidth(*options.paint, options.width, options.height) : 0)
    {
        if (options.paint) {
            media_.only.clear = false;
            for (Medium& medium : media_.several) {
                medium.clear = false;
            }
        }
        if (options.ground) {
            picture_.emplace(*options.ground);
        }
        const auto pyramid = [](const std::optional<Picture>& picture, PicturePyramid::Levels levels) {
            return picture ? std::optional<PicturePyramid>(std::in_place, *picture, levels) : std::nullopt;
        };
        for (const StandLook& one : options.stand_looks) {
            stand_looks_.push_back(
                {one, options.ground ? std::nullopt : pyramid(one.colours, PicturePyramid::Levels::Colours),
                 pyramid(one.normals, PicturePyramid::Levels::Numbers),
                 pyramid(one.finish, PicturePyramid::Levels::Numbers),
                 pyramid(one.glows, PicturePyramid::Levels::Colours),
                 pyramid(one.coverage, PicturePyramid::Levels::Numbers), mediumOf(one, scene_.scale())});
        }
        if (std::any_of(stand_looks_.begin(), stand_looks_.end(), [](const ShownLook& look) {
                return look.colours || look.normals || look.finish || look.glows || look.coverage;
            })) {
            charts_ = chartsOf(*options.stand);
        }
        const Vec3f size = scene_.high() - scene_.low();
        table_.emplace(std::max(size.x, size.y), size.x * size.y, turn_({-0.75F, 0.66F, 0.0F}), options.light_table);
        span_ = std::max(size.x, size.y);
        if (scene_.onPlane() && !studio_.uniform()) {
            light_ = lightOnPlane(scene_, media_, studio_.lights(),
                                  std::clamp(static_cast<int>(kLightCells * std::max(options.width, options.height)),
                                             kMinLightCells, kMaxLightCells));
        }
        if (options.stand_water) {
            film_.emplace(*options.stand_water, *options.stand);
        }
        if (options.stand_water && !studio_.uniform()) {
            base_light_.emplace(scene_, options.look, surface.mean_height, options.stand_water->bases,
                                studio_.lights());
        } else if (!scene_.onPlane() && options.stand && !studio_.uniform()) {
            key_gain_ =
                lightGainOnStand(scene_, media_, studio_.lights().front(),
                                 std::clamp(static_cast<int>(kStandCells * std::max(options.width, options.height)),
                                            kMinLightCells, kMaxLightCells));
            for (const Beam& beam : studio_.lights().front().beams) {
                key_ = key_ + beam.share * beam.toward;
            }
            key_ = unit(key_);
        }
        level_ = studio_.level();
        exposure_ = kWhite * kPi / std::max(level_.y, 1e-3F);
        const std::size_t count = std::max<std::size_t>(1, media_.several.size());
        for (std::uint32_t k = 0; k < count; ++k) {
            const double n = media_.of(k).clear ? lookAt(k).ior : 1.0;
            returned_.push_back(static_cast<float>(1.0 - (1.0 - diffuseReflectance(n)) / (n * n)));
            squeezed_.push_back(static_cast<float>(1.0 / (n * n)));
        }
    }

    // Linear light 0 … 1 for a screen at a point of the picture.
    // @param sample  its number in its pixel
    [[nodiscard]] Vec3f shown(float x, float y, std::uint32_t sample, Part part) const
    {
        const RayF ray = camera_.ray(x, y);
        const Vec3f light = trace(ray, {.part = part, .sample = sample, .shift = hashOf(std::floor(x), std::floor(y))});
        if (part == Part::Through) {
            return {std::min(light.x, 1.0F), std::min(light.y, 1.0F), std::min(light.z, 1.0F)};
        }
        if (studio_.uniform() || options_.paint) {
            return {std::min(light.x, 1.0F), std::min(light.y, 1.0F), std::min(light.z, 1.0F)};
        }
        return filmic(exposure_ * light);
    }

private:
    [[nodiscard]] std::vector<Vec3f> framedPoints() const
    {
        if (options_.stand_water) {
            return options_.framed ? scene_.droplets() : scene_.stand();
        }
        return options_.stand && options_.shows_whole_stand ? scene_.shown() : scene_.droplets();
    }

    struct ShownLook {
        const StandLook& from;
        std::optional<PicturePyramid> colours;
        std::optional<PicturePyramid> normals;
        std::optional<PicturePyramid> finish;
        std::optional<PicturePyramid> glows;
        std::optional<PicturePyramid> coverage;
        Medium inside;  // of what light enters
    };

    struct Way {
        float weight = 1.0F;    // weight of the ray in the pixel
        bool inside = false;    // inside the liquid
        int meetings = 0;       // number of surfaces met so far
        float distance = 0.0F;  // length of the path so far
        Part part = Part::All;
        std::uint32_t droplet = 0;         // that the ray is inside of
        bool mirrored = false;             // reflected on its way, outside of the liquid
        const ShownLook* solid = nullptr;  // that the ray is inside of
        // For facets:
        std::uint32_t sample = 0;  // number in the pixel
        std::uint32_t shift = 0;   // hash of the pixel and of the way
    };

    [[nodiscard]] const Look& lookAt(std::uint32_t droplet) const
    {
        return options_.looks.empty() ? options_.look : options_.looks[droplet];
    }

    [[nodiscard]] Vec3f trace(const RayF& ray, const Way& way) const
    {
        const Meeting meeting = way.solid != nullptr ? scene_.dry(ray)
                                : way.inside         ? scene_.fromLiquid(ray)
                                                     : scene_.fromAir(ray);
        if (meeting.what == Meeting::What::Nothing) {
            if (way.meetings == 0 && way.part != Part::All) {
                return grey(way.part == Part::Own ? 0.0F : 1.0F);
            }
            return way.meetings == 0 ? studio_.backdrop(ray.direction) : roomLight(ray.direction, way.part);
        }
        const Vec3f light =
            meeting.what == Meeting::What::Ground ? onGround(ray, meeting, way) : onLiquid(ray, meeting, way);
        return way.solid != nullptr ? passed(way.solid->inside, meeting.distance) * light
               : way.inside         ? passed(media_.of(way.droplet), meeting.distance) * light
                                    : light;
    }

    [[nodiscard]] Vec3f roomLight(Vec3f direction, Part part) const
    {
        return part == Part::Through ? Vec3f{} : studio_.radiance(direction);
    }

    [[nodiscard]] Vec3f onLiquid(const RayF& ray, const Meeting& meeting, const Way& way) const
    {
        const Vec3f normal = facing(ray.direction, way.inside ? -1.0F * meeting.normal : meeting.normal);
        const std::uint32_t droplet = media_.dropletAt(scene_, meeting);
        const Medium& medium = media_.of(droplet);
        if (way.part == Part::Through && (options_.paint || !medium.clear)) {
            return {};
        }
        if (options_.paint) {
            return painted(ray, meeting, normal, way);
        }
        if (!medium.clear) {
            return opaque(ray, meeting, normal, way);
        }
        const Look& look = lookAt(droplet);
        return overFacets(ray, normal, look.roughness, way, [&](Vec3f facet, const Way& one) {
            const float near = one.inside ? medium.ior : 1.0F;
            const float far = one.inside ? 1.0F : medium.ior;
            const Interface there = atInterface(ray.direction, facet, near / far);
            const Vec3f reflected =
                look.film ? reflectedByFilm(-dot(ray.direction, facet), near, far, *look.film) : grey(there.reflected);
            const Vec3f mirror = mirrored(ray.direction, facet);
            Vec3f light = reflected * onward(meeting, mirror, one, largest(reflected), one.inside);
            if (there.reflected < 1.0F) {
                const Vec3f passes = grey(1.0F) - reflected;
                Vec3f through = onward(meeting, there.transmitted, one, largest(passes), !one.inside);
                if (!one.inside) {
                    // What does not pass is scattered, in matter that is a little cloudy.
                    const auto share = static_cast<float>(look.transmission);
                    const Vec3f scattered = share < 1.0F ? toFloats(look.colour) * studio_.diffuse(normal) : Vec3f{};
                    through = mapAt(ray, meeting, one) * mix(scattered, through, share);
                }
                light = light + passes * through;
            }
            return light;
        });
    }

    // Mean of the light from the facets that a ray sees. Later on its way a ray follows one of them.
    // @param light  from a facet, by its normal and the ray's way
    template <class Light>
    [[nodiscard]] static Vec3f overFacets(const RayF& ray, Vec3f normal, double roughness, const Way& way,
                                          const Light& light)
    {
        if (isSmooth(roughness)) {
            return light(normal, way);
        }
        const std::uint32_t count = way.meetings == 0 ? kFacets : 1;
        Vec3f sum;
        for (std::uint32_t k = 0; k < count; ++k) {
            Way one = way;
            one.weight /= static_cast<float>(count);
            one.shift = hashOf(way.shift, k);
            FacetChoice choice = facetChoice(way.sample * kFacets + k, way.shift);
            choice.u *= kSeenFacets;
            const Vec3f facet = facetNormal(ray.direction, normal, roughness, choice);
            sum = sum + light(facing(ray.direction, facet), one);
        }
        return (1.0F / static_cast<float>(count)) * sum;
    }

    // Width of a pixel on a surface that a ray meets.
    [[nodiscard]] float pixelWidth(const RayF& ray, const Meeting& meeting, const Way& way) const
    {
        const float distance = way.distance + meeting.distance;
        const float slant = std::max(0.2F, std::abs(dot(ray.direction, meeting.normal)));
        return camera_.pixel() * distance / slant;
    }

    // Width in the picture of the footprint's extent.
    [[nodiscard]] double inPicture(float width) const
    {
        return width * scene_.scale() / std::max(options_.extent.x, options_.extent.y);
    }

    // Colour of the map where a ray meets liquid.
    [[nodiscard]] Vec3f mapAt(const RayF& ray, const Meeting& meeting, const Way& way) const
    {
        return media_.map ? media_.mapAt(meeting, inPicture(pixelWidth(ray, meeting, way))) : grey(1.0F);
    }

    // Droplet that a ray is in beyond a place where it met liquid or, inside, the ground.
    [[nodiscard]] std::uint32_t entered(const Meeting& meeting, const Way& way) const
    {
        return meeting.what == Meeting::What::Liquid ? media_.dropletAt(scene_, meeting) : way.droplet;
    }

    // @param inside  of liquid
    [[nodiscard]] Vec3f onward(const Meeting& meeting, Vec3f direction, const Way& way, float share, bool inside) const
    {
        const Way next{share * way.weight,
                       inside,
                       way.meetings + 1,
                       way.distance + meeting.distance,
                       way.part,
                       inside ? entered(meeting, way) : 0,
                       way.mirrored || (!inside && !way.inside),
                       inside ? nullptr : way.solid,
                       way.sample,
                       hashOf(way.shift, inside ? 1U : 0U)};
        // A direction from a smooth normal may point through the facet; it is bent to graze the facet.
        const float side = (inside ? -1.0F : 1.0F) * dot(direction, meeting.facet);
        if (side < 1e-3F) {
            direction = unit(direction + (inside ? side - 1e-3F : 1e-3F - side) * meeting.facet);
        }
        if (next.meetings > kMaxMeetings || next.weight < kMinWeight) {
            return roomLight(direction, way.part);
        }
        return trace({meeting.place, direction}, next);
    }

    // Share of light that matter mirrors upright, and how far it goes to all of it at a slant (C. Schlick, Computer
    // Graphics Forum 13 (1994) 233).
    // @param ratio  of refractive indices, inside over outside
    static Vec3f reflectance(double ratio, Vec3f colour, float metal)
    {
        const auto root = static_cast<float>((ratio - 1.0) / (ratio + 1.0));
        return mix(grey(root * root), colour, metal);
    }
    static float grazing(float cosine) { return std::pow(1.0F - cosine, 5.0F); }

    [[nodiscard]] Vec3f opaque(const RayF& ray, const Meeting& meeting, Vec3f normal, const Way& way) const
    {
        const Look& look = lookAt(media_.dropletAt(scene_, meeting));
        const Vec3f colour = mapAt(ray, meeting, way) * toFloats(look.colour);
        const auto metal = static_cast<float>(look.metallic);
        const Vec3f matter = (1.0F - metal) * colour * studio_.diffuse(normal);
        return overFacets(ray, normal, look.roughness, way, [&](Vec3f facet, const Way& one) {
            const float cosine = std::clamp(-dot(ray.direction, facet), 0.0F, 1.0F);
            const Vec3f share = mix(reflectance(look.ior, colour, metal), grey(1.0F), grazing(cosine));
            const Vec3f mirror = mirrored(ray.direction, facet);
            return share * onward(meeting, mirror, one, largest(share), false) + (grey(1.0F) - share) * matter;
        });
    }

    [[nodiscard]] Vec3f painted(const RayF& ray, const Meeting& meeting, Vec3f normal, const Way& way) const
    {
        constexpr float kLine = 1.6F;  // [px]
        const Triangle& triangle = scene_.triangle(meeting);
        // Gradient of the values on the facet, times the length that the pixel covers.
        const float pixel = kLine * camera_.pixel() * (way.distance + meeting.distance);
        const double slope = static_cast<double>(pixel) * slopeOn(triangle, ray.direction, meeting.facet);
        const Vec3f colour = paintAt(*options_.paint, triangle, {meeting.u, meeting.v, slope});
        if (studio_.uniform()) {
            return colour;
        }
        const float light = studio_.diffuse(normal).y / (level_.y / kPi);
        return std::clamp(0.45F + 0.55F * light, 0.0F, 1.15F) * colour;
    }

    // Change of the paint's values across the picture, per length perpendicular to the ray.
    [[nodiscard]] double slopeOn(const Triangle& triangle, Vec3f direction, Vec3f facet) const
    {
        const Vec3f a = scene_.vertex(triangle[0]);
        const Vec3f p = scene_.vertex(triangle[1]) - a;
        const Vec3f q = scene_.vertex(triangle[2]) - a;
        const std::vector<double>& values = options_.paint->values;
        const auto dp = static_cast<float>(values[triangle[1]] - values[triangle[0]]);
        const auto dq = static_cast<float>(values[triangle[2]] - values[triangle[0]]);
        const Vec3f across = cross(p, q);
        const Vec3f gradient = (1.0F / std::max(dot(across, across), 1e-30F)) * cross(dp * q - dq * p, across);
        // A step across the picture is longer on a slanted facet, in the direction of the ray's projection on it.
        const float slant = std::max(std::abs(dot(direction, facet)), 0.15F);
        const Vec3f trace = direction - dot(direction, facet) * facet;
        const float along = dot(gradient, unit(trace)) * (1.0F / slant - 1.0F);
        return std::sqrt(static_cast<double>(dot(gradient, gradient) + along * along));
    }

    [[nodiscard]] Vec3f onGround(const RayF& ray, const Meeting& met, const Way& way) const
    {
        if (way.part != Part::All && scene_.onPlane()) {
            return leftOut(met, way);
        }
        if (way.part == Part::Through) {
            return {};
        }
        const float width = pixelWidth(ray, met, way);
        const ShownLook* const shown = studio_.uniform() ? nullptr : lookOfStand(met);
        if (shown != nullptr) {
            const float here = shareThere(*shown, met, width);
            if (here < 1.0F) {
                const Vec3f behind = (1.0F - here) * throughHole(ray, met, way, 1.0F - here);
                return here > 0.0F ? behind + here * onMatter(ray, met, way, shown) : behind;
            }
        }
        return onMatter(ray, met, way, shown);
    }

    // Ground that is there.
    // @param shown  null: it has no look
    [[nodiscard]] Vec3f onMatter(const RayF& ray, const Meeting& met, const Way& way, const ShownLook* shown) const
    {
        const float width = pixelWidth(ray, met, way);
        const bool wet = way.inside;
        const std::optional<Matter> matter =
            shown == nullptr ? std::nullopt : std::optional(matterAt(*shown, met, width));
        const Vec3f colour = matter ? matter->colour : albedo(met, width);
        if (studio_.uniform()) {
            return wet ? colour * wetness(colour, 1.0F - returned_[way.droplet], way.droplet) : colour;
        }
        Meeting meeting = met;
        if (shown != nullptr && shown->normals) {
            meeting.normal = withRelief(*shown, met, width);
        }
        Vec3f glow = shown == nullptr ? Vec3f{} : glowAt(*shown, met, width);
        if (wet) {
            glow = glow * wetness(colour, squeezed_[way.droplet], way.droplet);
        }
        if (matter && matter->clear >= 1.0F) {
            return glow + throughClear(*matter, ray, meeting, way, {});
        }
        const Vec3f light = light_ ? light_->at(meeting.place) : lightOnStand(meeting, ray);
        Vec3f seen = colour * light;
        if (options_.paint) {
            seen = (kPi / level_.y) * 0.82F * Vec3f{light.y, light.y, light.y};
            seen = mix(seen, grey(0.82F), 0.35F);
        }
        if (wet) {
            seen = seen * wetness(colour, squeezed_[way.droplet], way.droplet);
        }
        if (scene_.onPlane() && !options_.paint) {
            seen = faded(seen, meeting.place);
        }
        if (matter && matter->clear > 0.0F) {
            return glow + throughClear(*matter, ray, meeting, way, seen);
        }
        if (matter) {
            seen = glow + finished(*matter, ray, meeting, way, seen);
        }
        return film_ && !wet && media_.of(0).clear ? underFilm(ray, meeting, way, seen, colour) : seen;
    }

    [[nodiscard]] const ShownLook* lookOfStand(const Meeting& meeting) const
    {
        return stand_looks_.empty() ? nullptr : &stand_looks_[options_.stand_materials[meeting.triangle]];
    }

    // Directions of its pictures on a triangle of the stand.
    struct Chart {
        Vec3f right;         // unit, along uv's x; or 0
        Vec3f up;            // unit, against uv's y; or 0
        float scale = 0.0F;  // length in the picture over length in the scene
    };

    [[nodiscard]] std::vector<Chart> chartsOf(const TexturedMesh& stand) const
    {
        std::vector<Chart> charts(stand.triangles.size());
        for (std::size_t i = 0; i < charts.size(); ++i) {
            const auto [a, b, c] = stand.triangles[i];
            const Vec3 p = stand.vertices[b] - stand.vertices[a];
            const Vec3 q = stand.vertices[c] - stand.vertices[a];
            const TexturePlace& place = options_.stand_looks[options_.stand_materials[i]].place;
            const Vec2 s = place.at(stand.uvs[b]) - place.at(stand.uvs[a]);
            const Vec2 t = place.at(stand.uvs[c]) - place.at(stand.uvs[a]);
            const double turn = s.x * t.y - t.x * s.y;
            const double area = length(cross(p, q));
            if (turn != 0.0 && area > 0.0) {
                const double side = turn > 0.0 ? 1.0 : -1.0;
                charts[i] = {unit(toFloats(side / length(p) * (t.y * p - s.y * q))),
                             unit(toFloats(side / length(p) * (t.x * p - s.x * q))),
                             static_cast<float>(std::sqrt(std::abs(turn) / area) * scene_.scale())};
            }
        }
        return charts;
    }

    // Place in the pictures of a look.
    [[nodiscard]] static Vec2 inPictureOf(const ShownLook& shown, const Meeting& meeting)
    {
        return shown.from.place.at(meeting.uv);
    }

    // Width in uv of an area on the stand.
    [[nodiscard]] double inTexture(const Meeting& meeting, float width) const
    {
        return width * charts_[meeting.triangle].scale;
    }

    [[nodiscard]] Vec3f withRelief(const ShownLook& shown, const Meeting& meeting, float width) const
    {
        const Vec3f level = shown.normals->repeatedAt(inPictureOf(shown, meeting), inTexture(meeting, width));
        const Chart& chart = charts_[meeting.triangle];
        const auto relief = static_cast<float>(shown.from.relief);
        const auto along_surface = [&](Vec3f direction) {
            const Vec3f flat = direction - dot(direction, meeting.normal) * meeting.normal;
            return dot(flat, flat) > 0.0F ? unit(flat) : Vec3f{};
        };
        return unit((relief * (2.0F * level.x - 1.0F)) * along_surface(chart.right) +
                    (relief * (2.0F * level.y - 1.0F)) * along_surface(chart.up) +
                    std::max(2.0F * level.z - 1.0F, 1e-3F) * meeting.normal);
    }

    // Share of a stand's surface that is there. What opacity leaves of metal is a hole: no light passes the rest.
    [[nodiscard]] float shareThere(const ShownLook& shown, const Meeting& meeting, float width) const
    {
        const float covered = shown.coverage ? coverageAt(shown, meeting, width) : 1.0F;
        if (shown.from.opacity >= 1.0 || shown.from.look.metallic <= 0.0) {
            return covered;
        }
        return covered * (1.0F - matterAt(shown, meeting, width).metal * static_cast<float>(1.0 - shown.from.opacity));
    }

    [[nodiscard]] float coverageAt(const ShownLook& shown, const Meeting& meeting, float width) const
    {
        // Means of a cut picture would shrink what is thin.
        const double area = shown.from.cutoff ? 0.0 : inTexture(meeting, width);
        const float share = shown.coverage->repeatedAt(inPictureOf(shown, meeting), area).x;
        return shown.from.cutoff ? (share < static_cast<float>(*shown.from.cutoff) ? 0.0F : 1.0F) : share;
    }

    [[nodiscard]] Vec3f glowAt(const ShownLook& shown, const Meeting& meeting, float width) const
    {
        const Vec3f glow = level_.y / kPi * toFloats(shown.from.glow);
        return shown.glows ? glow * shown.glows->repeatedAt(inPictureOf(shown, meeting), inTexture(meeting, width))
                           : glow;
    }

    // Light through ground that is not there. A droplet ends where the ground would be.
    [[nodiscard]] Vec3f throughHole(const RayF& ray, const Meeting& meeting, const Way& way, float share) const
    {
        const auto behind = dot(ray.direction, meeting.facet) < 0.0F ? std::nullopt : dropletBehind(ray, meeting);
        const float near = way.inside ? media_.of(way.droplet).ior : 1.0F;
        const float far = behind ? media_.of(*behind).ior : 1.0F;
        const Vec3f normal = seenNormal(ray, meeting);
        const Interface split = atInterface(ray.direction, normal, near / far);
        Way next = way;
        next.inside = behind.has_value();
        next.droplet = behind.value_or(way.droplet);
        if (split.reflected >= 1.0F) {
            return onward(towards(meeting, ray, false, way.inside), mirrored(ray.direction, normal), way, share,
                          way.inside);
        }
        if (near == far) {
            --next.meetings;  // a hole is no meeting: behind it is the backdrop
        }
        return onward(towards(meeting, ray, true, next.inside), split.transmitted, next, share, next.inside);
    }

    // Matter of a stand at a place.
    struct Matter {
        const ShownLook& shown;
        Vec3f colour;
        float metal;      // 0 … 1
        float roughness;  // 0 … 1
        float clear;      // share of what is not mirrored that passes, 0 … 1
    };

    [[nodiscard]] Matter matterAt(const ShownLook& shown, const Meeting& meeting, float width) const
    {
        const Look& look = shown.from.look;
        Matter matter{shown, albedo(meeting, width), static_cast<float>(look.metallic),
                      static_cast<float>(look.roughness), 0.0F};
        if (shown.finish) {
            const Vec3f factor = shown.finish->repeatedAt(inPictureOf(shown, meeting), inTexture(meeting, width));
            matter.roughness *= factor.y;
            matter.metal *= factor.z;
        }
        matter.clear = (1.0F - matter.metal) * static_cast<float>(shown.from.clearness());
        return matter;
    }

    static float blurOf(const Matter& matter) { return smoothstep(0.0F, 0.4F, matter.roughness); }

    // What matter mirrors towards a ray; rough matter mirrors a blurred room.
    [[nodiscard]] Vec3f glossOf(const Matter& matter, const RayF& ray, const Meeting& meeting, Vec3f normal,
                                const Way& way, float share) const
    {
        const Vec3f mirror = mirrored(ray.direction, normal);
        const float blur = blurOf(matter);
        const Vec3f sharp = blur < 1.0F ? onward(towards(meeting, ray, false, way.inside), mirror, way,
                                                 (1.0F - blur) * share, way.inside)
                                        : Vec3f{};
        return blur > 0.0F ? mix(sharp, studio_.diffuse(mirror), blur) : sharp;
    }

    // Normal of ground on the side that a ray comes to.
    [[nodiscard]] static Vec3f seenNormal(const RayF& ray, const Meeting& meeting)
    {
        const float side = dot(ray.direction, meeting.facet) < 0.0F ? 1.0F : -1.0F;
        return facing(ray.direction, side * meeting.normal);
    }

    // Light from matter that lets none pass.
    [[nodiscard]] Vec3f finished(const Matter& matter, const RayF& ray, const Meeting& meeting, const Way& way,
                                 Vec3f scattered) const
    {
        const Vec3f normal = seenNormal(ray, meeting);
        const double outside = way.inside ? lookAt(way.droplet).ior : 1.0;
        const float cosine = std::clamp(-dot(ray.direction, normal), 0.0F, 1.0F);
        // Rough matter has no bright edges.
        const Vec3f share = mix(reflectance(matter.shown.from.look.ior / outside, matter.colour, matter.metal),
                                grey(1.0F), grazing(cosine) * (1.0F - matter.roughness));
        return share * glossOf(matter, ray, meeting, normal, way, largest(share)) +
               (1.0F - matter.metal) * (grey(1.0F) - share) * scattered;
    }

    // A meeting with ground whose facet points to the side that a ray goes on to.
    // @param goes_on  through the ground; otherwise it stays on its side
    [[nodiscard]] static Meeting towards(Meeting meeting, const RayF& ray, bool goes_on, bool inside)
    {
        // onward() expects facets that point out of the liquid.
        const bool points_ahead = dot(ray.direction, meeting.facet) > 0.0F;
        if ((points_ahead == goes_on) == inside) {
            meeting.facet = -1.0F * meeting.facet;
        }
        return meeting;
    }

    // Droplet that stands on the other side of ground: a way beyond leaves it next.
    [[nodiscard]] std::optional<std::uint32_t> dropletBehind(const RayF& ray, const Meeting& meeting) const
    {
        const Meeting next = scene_.fromAir({meeting.place, ray.direction});
        return next.what == Meeting::What::Liquid && dot(ray.direction, next.facet) > 0.0F
                   ? std::optional(media_.dropletAt(scene_, next))
                   : std::nullopt;
    }

    // Light from matter that lets light pass. A thin wall bends no way by itself and tints what passes; a droplet on
    // its outside refracts there, as its water ends at the wall. Matter with a thickness refracts, and tints what
    // enters.
    [[nodiscard]] Vec3f throughClear(const Matter& matter, const RayF& ray, const Meeting& meeting, const Way& way,
                                     Vec3f scattered) const
    {
        const bool is_front = dot(ray.direction, meeting.facet) < 0.0F;
        const bool is_matter = matter.shown.from.thickness.has_value();
        const auto behind = is_front ? std::nullopt : dropletBehind(ray, meeting);
        // There is film on the outside alone, and none below droplets.
        const bool may_have_film = film_ && !way.inside && !behind && (is_front || is_matter) && media_.of(0).clear;
        const StandFilm::Here film = may_have_film ? film_->at(meeting) : StandFilm::Here{0.0F, meeting.normal};
        const Vec3f ground = is_front ? meeting.normal : -1.0F * meeting.normal;
        const Vec3f water = is_front ? film.normal : -1.0F * film.normal;
        const Vec3f normal = facing(ray.direction, is_front ? water : ground);
        const float look_ior = static_cast<float>(matter.shown.from.look.ior);
        const float near = is_matter && !is_front ? look_ior : way.inside ? media_.of(way.droplet).ior : 1.0F;
        const float far = is_matter && is_front ? look_ior : behind ? media_.of(*behind).ior : 1.0F;
        Way next = way;
        next.inside = behind.has_value();
        next.droplet = behind.value_or(way.droplet);
        if (is_matter) {
            next.solid = is_front ? &matter.shown : nullptr;
        }
        Interface split;
        if (film.thickness > 0.0F) {
            const float ior = media_.of(0).ior;
            split = atInterface(ray.direction, normal, near / ior);
            if (split.reflected < 1.0F) {
                const Vec3f other = facing(split.transmitted, is_front ? ground : water);
                const Interface second = atInterface(split.transmitted, other, ior / far);
                split.transmitted = second.transmitted;
                split.reflected += (1.0F - split.reflected) * second.reflected;
            }
        } else if (is_matter || way.inside || behind) {
            split = atInterface(ray.direction, normal, near / far);
        } else {
            split = atInterface(ray.direction, normal, 1.0F / look_ior);
            split.transmitted = ray.direction;
            split.reflected *= 2.0F / (1.0F + split.reflected);  // both sides of the wall
        }
        const float passes = (1.0F - split.reflected) * matter.clear;
        Vec3f light = split.reflected * glossOf(matter, ray, meeting, normal, way, split.reflected) +
                      (1.0F - split.reflected) * (1.0F - matter.clear) * scattered;
        if (passes > 0.0F) {
            // What opacity leaves is not tinted; rough matter shows a blurred room behind it.
            const auto transmits = static_cast<float>(matter.shown.from.look.transmission);
            const float stained = transmits / (transmits + static_cast<float>(1.0 - matter.shown.from.opacity));
            const Vec3f tint = is_matter && !is_front ? grey(1.0F) : mix(grey(1.0F), matter.colour, stained);
            const float blur = stained * blurOf(matter);
            const Vec3f sharp = blur < 1.0F ? onward(towards(meeting, ray, true, next.inside), split.transmitted, next,
                                                     (1.0F - blur) * passes, next.inside)
                                            : Vec3f{};
            light =
                light + passes * tint * (blur > 0.0F ? mix(sharp, studio_.diffuse(split.transmitted), blur) : sharp);
        }
        return light;
    }

    // Ground below a film of water, which darkens and mirrors.
    [[nodiscard]] Vec3f underFilm(const RayF& ray, const Meeting& meeting, const Way& way, Vec3f dry,
                                  Vec3f matter) const
    {
        const StandFilm::Here film = film_->at(meeting);
        const bool is_front = dot(ray.direction, meeting.facet) < 0.0F;
        if (film.thickness <= 0.0F || !is_front) {
            return dry;
        }
        // A film that covers the bumps of matt ground darkens and mirrors as a thicker one.
        const ShownLook* const shown = lookOfStand(meeting);
        const float rough =
            shown == nullptr ? 1.0F : smoothstep(0.1F, 0.6F, static_cast<float>(shown->from.look.roughness));
        const float covered = std::min(film.thickness / kCovering, 1.0F);
        const Vec3f normal = facing(ray.direction, film.normal);
        const float mirrors = covered * atInterface(ray.direction, normal, 1.0F / media_.of(0).ior).reflected;
        const Vec3f wet = mix(dry, dry * wetness(matter, squeezed_[way.droplet], way.droplet), rough * covered);
        return (1.0F - mirrors) * wet + mirrors * onward(meeting, mirrored(ray.direction, normal), way, mirrors, false);
    }

    // Ground of a cut-out: white where it is seen directly or through the liquid, which a ray may leave again where it
    // hangs over its rim; grey where it is reflected.
    [[nodiscard]] Vec3f leftOut(const Meeting& meeting, const Way& way) const
    {
        const bool is_seen = !way.mirrored;
        if (is_seen != (way.part == Part::Through)) {
            return {};
        }
        constexpr float kGrey = 0.4F;
        const Vec3f light = light_ ? light_->at(meeting.place) : grey(1.0F);
        if (!is_seen) {
            return kGrey * light;
        }
        const Vec3f open = light_ ? light_->open : grey(1.0F);
        constexpr float kDark = 1e-6F;
        const Vec3f share{light.x / std::max(open.x, kDark), light.y / std::max(open.y, kDark),
                          light.z / std::max(open.z, kDark)};
        return way.inside ? share * wetness(grey(kGrey), squeezed_[way.droplet], way.droplet) : share;
    }

    // Share of the light around that reaches a place on the stand. What hides the rest scatters some light itself.
    [[nodiscard]] float opennessAt(const Meeting& meeting, bool is_front) const
    {
        if (!options_.stand_openness) {
            return 1.0F;
        }
        constexpr float kScattered = 0.2F;
        const StandOpenness& openness = *options_.stand_openness;
        const std::vector<float>& side = is_front || openness.back.empty() ? openness.front : openness.back;
        const std::uint32_t first = openness.first[meeting.triangle];
        const float open = onGrid(side.data() + first, openness.divisions[meeting.triangle], meeting).here;
        return kScattered + (1.0F - kScattered) * open;
    }

    // Light on the side of the stand that a ray comes to.
    [[nodiscard]] Vec3f lightOnStand(Meeting meeting, const RayF& ray) const
    {
        const bool is_front = dot(ray.direction, meeting.facet) < 0.0F || !options_.shows_whole_stand;
        if (!is_front) {
            meeting.normal = -1.0F * meeting.normal;
        }
        return opennessAt(meeting, is_front) * openLightOnStand(meeting);
    }

    [[nodiscard]] Vec3f openLightOnStand(const Meeting& meeting) const
    {
        const Vec3f light = studio_.diffuse(meeting.normal);
        if (base_light_) {
            return base_light_->at(meeting.place, meeting.normal, light);
        }
        if (!key_gain_) {
            return light;
        }
        const Vec3f key =
            std::max(dot(meeting.normal, key_), 0.0F) / (kPi * key_.z) * studio_.lights().front().irradiance;
        const Vec3f gain = key_gain_->at({static_cast<float>(meeting.uv.x), static_cast<float>(meeting.uv.y), 0.0F});
        const Vec3f sum = light + (gain - grey(1.0F)) * key;
        return {std::max(sum.x, 0.2F * light.x), std::max(sum.y, 0.2F * light.y), std::max(sum.z, 0.2F * light.z)};
    }

    // A part of the light scattered below the liquid is reflected back to the ground, repeatedly.
    [[nodiscard]] Vec3f wetness(Vec3f matter, float first, std::uint32_t droplet) const
    {
        const float returned = returned_[droplet];
        return {first / (1.0F - returned * matter.x), first / (1.0F - returned * matter.y),
                first / (1.0F - returned * matter.z)};
    }

    // The table is bright near the droplet and dark far away.
    [[nodiscard]] Vec3f faded(Vec3f seen, Vec3f place) const
    {
        const Vec3f flat = turn_({0.12F, -0.10F, 0.0F});
        const Vec3f offset = (1.0F / span_) * Vec3f{place.x, place.y, 0.0F} + flat;
        const float pool = 1.0F / (1.0F + (options_.light_table ? 0.3F : 1.2F) * dot(offset, offset));
        const float haze = smoothstep(1.5F, 7.0F, std::sqrt(dot(offset, offset)));
        return mix(pool * seen, kDistance, haze);
    }

    // Colour of a stand's vertices at a place.
    [[nodiscard]] Vec3f colourOfVertices(const Meeting& meeting) const
    {
        const std::vector<Vec3>& colours = options_.stand_colours;
        if (colours.empty()) {
            return grey(1.0F);
        }
        const auto [a, b, c] = options_.stand->triangles[meeting.triangle];
        return (1.0F - meeting.u - meeting.v) * toFloats(colours[a]) + meeting.u * toFloats(colours[b]) +
               meeting.v * toFloats(colours[c]);
    }

    [[nodiscard]] Vec3f albedo(const Meeting& meeting, float width) const
    {
        if (picture_) {
            return picture_->at(meeting.uv, inPicture(width));
        }
        if (studio_.uniform()) {
            return grey(1.0F);
        }
        if (const ShownLook* const shown = lookOfStand(meeting)) {
            const Vec3f colour = toFloats(shown->from.look.colour) * colourOfVertices(meeting);
            return shown->colours
                       ? colour * shown->colours->repeatedAt(inPictureOf(*shown, meeting), inTexture(meeting, width))
                       : colour;
        }
        // An object is plain; curved ground has the table's ruling, projected from above.
        return options_.stand && options_.shows_whole_stand ? Vec3f{0.42F, 0.45F, 0.46F}
                                                            : table_->at(meeting.place, width);
    }

    const RenderOptions& options_;
    CameraTurn turn_;
    RayTracer scene_;
    StudioLight studio_;
    Media media_;
    Camera camera_;
    std::optional<PicturePyramid> picture_;
    std::optional<Table> table_;
    std::optional<LightMap> light_;        // light on the plane
    std::optional<LightMap> key_gain_;     // share of the key light on a stand
    std::optional<BaseLight> base_light_;  // light on a stand below many droplets
    std::optional<StandFilm> film_;
    std::vector<ShownLook> stand_looks_;
    std::vector<Chart> charts_;  // of every triangle of a stand with pictures
    Vec3f key_;                  // direction toward the key light
    Vec3f level_;
    float exposure_ = 1.0F;
    float span_ = 1.0F;
    // By droplet:
    std::vector<float> returned_;  // share of the light scattered below that the surface reflects back
    std::vector<float> squeezed_;  // radiance outside over radiance inside
};

/// Places of samples in a pixel: the first 4, 16, 64 … lie one in every cell of a grid.
std::vector<std::array<float, 2>> samplesInPixel(int count)
{
    std::vector<std::array<float, 2>> samples;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
        std::uint32_t first = 0;
        std::uint32_t second = 0;
        std::uint32_t direction = 1U << 31;
        for (std::uint32_t k = 0, bits = i; bits != 0; ++k, bits >>= 1) {
            if ((bits & 1U) != 0) {
                first ^= 1U << (31 - k);
                second ^= direction;
            }
            direction ^= direction >> 1;
        }
        const auto within = [](std::uint32_t bits) {
            return (static_cast<float>(bits >> 8) + 0.5F) / static_cast<float>(1 << 24);
        };
        samples.push_back({within(first), within(second)});
    }
    return samples;
}

/// Sums over the samples of a pixel so far.
struct Pixel {
    Vec3f sum;
    float spread = 0.0F;
};

Vec3f onScreen(Vec3f light)
{
    return {toDisplay(light.x), toDisplay(light.y), toDisplay(light.z)};
}

// Approximate conversion, good enough to detect visible differences.
Vec3f roughly(Vec3f light)
{
    return {std::sqrt(light.x), std::sqrt(light.y), std::sqrt(light.z)};
}

float difference(Vec3f a, Vec3f b)
{
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

Picture trace(const Tracer& tracer, const RenderOptions& options, Part part)
{
    constexpr float kVisible = 5.0F / 255.0F;
    const auto width = static_cast<std::size_t>(options.width);
    const auto height = static_cast<std::size_t>(options.height);
    const auto samples = samplesInPixel(options.samples);
    std::vector<Pixel> pixels(width * height);
    const auto sample = [&](std::size_t x, std::size_t y, std::size_t s) {
        return tracer.shown(static_cast<float>(x) + samples[s][0], static_cast<float>(y) + samples[s][1],
                            static_cast<std::uint32_t>(s), part);
    };
    tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) {
        for (std::size_t x = 0; x < width; ++x) {
            Pixel& pixel = pixels[y * width + x];
            Vec3f low = grey(2.0F);
            Vec3f high = grey(-1.0F);
            for (std::size_t s = 0; s < kMinSamples; ++s) {
                const Vec3f light = sample(x, y, s);
                pixel.sum = pixel.sum + light;
                low = {std::min(low.x, light.x), std::min(low.y, light.y), std::min(low.z, light.z)};
                high = {std::max(high.x, light.x), std::max(high.y, light.y), std::max(high.z, light.z)};
            }
            pixel.spread = difference(roughly(low), roughly(high));
        }
    });
    std::vector<Vec3f> seen(pixels.size());
    tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) {
        for (std::size_t x = 0; x < width; ++x) {
            seen[y * width + x] = onScreen((1.0F / kMinSamples) * pixels[y * width + x].sum);
        }
    });
    Picture picture{options.width, options.height, std::vector<std::uint8_t>(3 * width * height)};
    tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) {
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t at = y * width + x;
            const auto apart = [&](bool there, std::size_t other) {
                return there && difference(seen[at], seen[other]) > 5.0F * kVisible;
            };
            Vec3f shown = seen[at];
            if (pixels[at].spread > kVisible || apart(x > 0, at - 1) || apart(x + 1 < width, at + 1) ||
                apart(y > 0, at - width) || apart(y + 1 < height, at + width)) {
                Vec3f sum = pixels[at].sum;
                for (std::size_t s = kMinSamples; s < samples.size(); ++s) {
                    sum = sum + sample(x, y, s);
                }
                shown = onScreen((1.0F / static_cast<float>(samples.size())) * sum);
            }
            const auto byte = [](float level) {
                return static_cast<std::uint8_t>(std::lrint(255.0F * std::clamp(level, 0.0F, 1.0F)));
            };
            picture.rgb[3 * at] = byte(shown.x);
            picture.rgb[3 * at + 1] = byte(shown.y);
            picture.rgb[3 * at + 2] = byte(shown.z);
        }
    });
    return picture;
}

}  // namespace

View viewNamed(std::string_view name)
{
    constexpr std::array<std::pair<View, const char*>, 3> kNames{
        {{View::ThreeQuarter, "three-quarter"}, {View::Top, "top"}, {View::Side, "side"}}};
    return valueNamed(kNames, name, "view");
}

void RenderOptions::validate() const
{
    requireWithin("options.width", width, 1, kMaxPixels);
    requireWithin("options.height", height, 1, kMaxPixels);
    requireWithin("options.samples", samples, kMinSamples, kMaxSamples);
    require(std::isfinite(azimuth), "options.azimuth", azimuth, "finite");
    if (camera) {
        require(std::isfinite(camera->azimuth), "options.camera.azimuth", camera->azimuth, "finite");
        require(std::abs(camera->elevation) <= 0.5 * std::numbers::pi, "options.camera.elevation", camera->elevation,
                "from -pi/2 to pi/2");
    }
    if (look_at && !(std::isfinite(look_at->x) && std::isfinite(look_at->y) && std::isfinite(look_at->z))) {
        refuse("look_at must be finite");
    }
    if (distance) {
        require(*distance > 0.0 && std::isfinite(*distance), "options.distance", *distance, "finite and more than 0 m");
    }
    require(look.ior >= 1.0 && look.ior <= 4.0, "options.look.ior", look.ior, "from 1 to 4");
    for (const Look& one : looks) {
        require(one.ior >= 1.0 && one.ior <= 4.0, "options.looks.ior", one.ior, "from 1 to 4");
    }
    const auto within = [](double a) { return a >= 0.0 && std::isfinite(a); };
    if (!within(extent.x) || !within(extent.y)) {
        refuse("extent must be finite and not negative");
    }
    if (environment) {
        environment->validate();
    }
    if (ground) {
        ground->validate();
        if (!stand && !(extent.x > 0.0 && extent.y > 0.0)) {
            refuse("extent = " + numberText(extent.x) + " by " + numberText(extent.y) +
                   " must be above 0 where a picture is the ground");
        }
    }
    if (colour_map) {
        colour_map->validate();
        if (!(extent.x > 0.0 && extent.y > 0.0)) {
            refuse("extent = " + numberText(extent.x) + " by " + numberText(extent.y) +
                   " must be above 0 where a picture is on the liquid");
        }
    }
    if (stand) {
        stand->validate();
    }
    if (stand_openness) {
        if (!stand || !shows_whole_stand) {
            refuse("stand_openness needs a stand that is an object");
        }
        stand_openness->validate(stand->triangles.size());
    }
    if (!stand_looks.empty()) {
        if (!stand || !shows_whole_stand || stand_materials.size() != stand->triangles.size() ||
            std::any_of(stand_materials.begin(), stand_materials.end(),
                        [&](std::uint32_t material) { return material >= stand_looks.size(); })) {
            refuse("stand_looks need a stand that is an object, with a look in stand_materials for every triangle");
        }
        for (const StandLook& one : stand_looks) {
            require(one.look.ior >= 1.0 && one.look.ior <= 4.0, "options.stand_looks.ior", one.look.ior, "from 1 to 4");
            require(one.opacity >= 0.0 && one.opacity <= 1.0, "options.stand_looks.opacity", one.opacity,
                    "from 0 to 1");
            require(std::isfinite(one.relief), "options.stand_looks.relief", one.relief, "finite");
            const Vec2 corner = one.place.at({1.0, 1.0});
            if (!std::isfinite(corner.x) || !std::isfinite(corner.y)) {
                refuse("stand_looks.place must be finite");
            }
            if (one.thickness) {
                require(*one.thickness > 0.0 && std::isfinite(*one.thickness), "options.stand_looks.thickness",
                        *one.thickness, "finite and more than 0 m");
            }
            if (one.absorption) {
                const auto& [colour, path] = *one.absorption;
                const auto is_share = [](double a) { return a > 0.0 && a <= 1.0; };
                if (!is_share(colour.x) || !is_share(colour.y) || !is_share(colour.z)) {
                    refuse("stand_looks.absorption.colour must be above 0, to 1");
                }
                require(path > 0.0 && std::isfinite(path), "options.stand_looks.absorption.distance", path,
                        "finite and more than 0 m");
            }
            const auto is_light = [](double a) { return a >= 0.0 && std::isfinite(a); };
            if (!is_light(one.glow.x) || !is_light(one.glow.y) || !is_light(one.glow.z)) {
                refuse("stand_looks.glow must be finite and at least 0");
            }
            if (one.cutoff) {
                require(*one.cutoff >= 0.0 && *one.cutoff <= 1.0, "options.stand_looks.cutoff", *one.cutoff,
                        "from 0 to 1");
            }
            for (const std::optional<Picture>* const picture :
                 {&one.colours, &one.normals, &one.finish, &one.glows, &one.coverage}) {
                if (*picture) {
                    (*picture)->validate();
                }
            }
        }
    }
    if (!stand_colours.empty()) {
        const auto is_share = [](double a) { return a >= 0.0 && a <= 1.0; };
        if (!stand || stand_looks.empty() || stand_colours.size() != stand->vertices.size() ||
            !std::all_of(stand_colours.begin(), stand_colours.end(), [&](const Vec3& colour) {
                return is_share(colour.x) && is_share(colour.y) && is_share(colour.z);
            })) {
            refuse("stand_colours must be from 0 to 1, one for each vertex of a stand with stand_looks");
        }
    }
    if (stand_water) {
        if (!stand || !shows_whole_stand) {
            refuse("stand_water needs a stand that is an object");
        }
        stand_water->validate(stand->triangles.size());
    }
    if (framed) {
        const Vec3 size = framed->high - framed->low;
        if (!(size.x >= 0.0 && size.y >= 0.0 && size.z >= 0.0 && length(size) > 0.0 && std::isfinite(length(size)))) {
            refuse("framed must be a box with a positive extent");
        }
    }
}

namespace {

void requireDrawable(const Surface& surface, const RenderOptions& options)
{
    options.validate();
    if (options.camera && !(options.stand && options.shows_whole_stand)) {
        require(options.camera->elevation >= 0.0, "options.camera.elevation", options.camera->elevation,
                "from 0 to pi/2, above the ground");
    }
    const bool dry = (options.framed || options.stand_water) && surface.triangles.empty();
    if (!dry) {
        surface.validate();
        if (!options.looks.empty() &&
            (surface.parts.empty() ||
             std::any_of(surface.parts.begin(), surface.parts.end(),
                         [&](const SurfacePart& part) { return part.droplet >= options.looks.size(); }))) {
            refuse("looks has " + std::to_string(options.looks.size()) +
                   " entries; the surface must have parts, for these droplets alone");
        }
    }
    if (!dry && std::all_of(surface.vertices.begin(), surface.vertices.end(),
                            [&first = surface.vertices.front()](const Vec3& p) {
                                return p.x == first.x && p.y == first.y && p.z == first.z;
                            })) {
        throw Error(ErrorCode::InvalidArgument, "surface must have an extent; all vertices are at one place");
    }
    if (options.paint) {
        options.paint->validate(surface.vertices.size());
    }
}

}  // namespace

bool canRender() noexcept
{
    return true;
}

Picture render(const Surface& surface, const RenderOptions& options)
{
    requireDrawable(surface, options);
    const Tracer tracer(surface, options);
    Picture picture = trace(tracer, options, Part::All);
    if (options.paint) {
        drawLegend(picture, *options.paint);
    }
    return picture;
}

Layer renderCutOut(const Surface& surface, const RenderOptions& options)
{
    requireDrawable(surface, options);
    const Tracer tracer(surface, options);
    const Picture own = trace(tracer, options, Part::Own);
    const Picture through = trace(tracer, options, Part::Through);
    Layer layer{own.width, own.height, {}};
    layer.rgba.resize(own.rgb.size() / 3 * 4);
    tbb::parallel_for(std::size_t{0}, own.rgb.size() / 3, [&](std::size_t i) {
        const std::uint8_t* const mirrored = own.rgb.data() + 3 * i;
        const std::uint8_t* const passed = through.rgb.data() + 3 * i;
        // Over white the colour is the sum; over black it is the reflected and tinted part.
        const int min = std::min({passed[0], passed[1], passed[2]});
        std::array<int, 3> over_black{};
        int alpha = 255 - min;
        for (std::size_t c = 0; c < 3; ++c) {
            over_black[c] = std::min(mirrored[c] + passed[c] - min, 255);
            alpha = std::max(alpha, over_black[c]);
        }
        std::uint8_t* const to = layer.rgba.data() + 4 * i;
        for (std::size_t c = 0; c < 3; ++c) {
            to[c] = static_cast<std::uint8_t>(alpha == 0 ? 0 : (255 * over_black[c] + alpha / 2) / alpha);
        }
        to[3] = static_cast<std::uint8_t>(alpha);
    });
    return layer;
}

std::optional<ViewBox> around(const Surface& surface, const std::optional<ViewBox>& box)
{
    std::optional<ViewBox> found = box;
    for (const Vec3& p : surface.vertices) {
        if (!found) {
            found = ViewBox{p, p};
        }
        found->low = {std::min(found->low.x, p.x), std::min(found->low.y, p.y), std::min(found->low.z, p.z)};
        found->high = {std::max(found->high.x, p.x), std::max(found->high.y, p.y), std::max(found->high.z, p.z)};
    }
    return found;
}

TexturedMesh groundMesh(const BaseSurface& ground, Vec2 extent)
{
    if (!(extent.x > 0.0 && extent.y > 0.0) || ground.flat()) {
        throw Error(ErrorCode::InvalidArgument, "ground must not be flat, and extent above 0");
    }
    constexpr int kCells = 400;
    constexpr double kBeyond = 3.0;    // size of the ground over the image's
    constexpr double kSteepest = 8.0;  // on steeper ground single cells would be visible
    TexturedMesh mesh;
    std::vector<std::optional<std::uint32_t>> vertices;
    for (int j = 0; j <= kCells; ++j) {
        for (int i = 0; i <= kCells; ++i) {
            const Vec2 p{kBeyond * extent.x * (static_cast<double>(i) / kCells - 0.5),
                         kBeyond * extent.y * (static_cast<double>(j) / kCells - 0.5)};
            vertices.emplace_back();
            const std::optional<GroundPoint> point = ground.find(p);
            if (!point || length(point->gradient) > kSteepest) {
                continue;
            }
            const double slope = std::sqrt(1.0 + dot(point->gradient, point->gradient));
            vertices.back() = static_cast<std::uint32_t>(mesh.vertices.size());
            mesh.vertices.push_back({p.x, p.y, point->height});
            mesh.normals.push_back({-point->gradient.x / slope, -point->gradient.y / slope, 1.0 / slope});
            mesh.uvs.push_back({0.5 + p.x / extent.x, 0.5 - p.y / extent.y});
        }
    }
    for (int j = 0; j < kCells; ++j) {
        for (int i = 0; i < kCells; ++i) {
            const std::size_t at = static_cast<std::size_t>(j) * (kCells + 1) + static_cast<std::size_t>(i);
            const auto a = vertices[at];
            const auto b = vertices[at + 1];
            const auto c = vertices[at + kCells + 2];
            const auto d = vertices[at + kCells + 1];
            if (a && b && c && d) {
                mesh.triangles.push_back({*a, *b, *c});
                mesh.triangles.push_back({*a, *c, *d});
            }
        }
    }
    if (mesh.triangles.empty()) {
        throw Error(ErrorCode::InvalidArgument, "ground must exist somewhere below the image");
    }
    return mesh;
}

}  // namespace droplet

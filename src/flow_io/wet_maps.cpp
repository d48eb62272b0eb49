// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/wet_maps.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "flow/following.h"
#include "flow_io/object_faces.h"
#include "flow_io/wet_spots.h"
#include "require.h"
#include "unit_vector.h"

namespace droplet {
namespace {

constexpr int kGutter = 4;        // [px]
constexpr double kOnEdge = 1e-9;  // of a triangle's height
constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();
constexpr std::int64_t kMaxRepeats = 64;  // of the texture across a triangle

/// A triangle in the texture; corners in pixels.
struct TexelTriangle {
    std::array<Vec2, 3> corners;
    double twice = 0.0;  ///< its area, signed

    [[nodiscard]] std::array<double, 3> weights(Vec2 p) const
    {
        const double u = cross(p - corners[0], corners[2] - corners[0]) / twice;
        const double v = cross(corners[1] - corners[0], p - corners[0]) / twice;
        return {1.0 - u - v, u, v};
    }
};

TexelTriangle inTexels(const FlowObject& object, const Triangle& triangle, const WetMapOptions& options)
{
    TexelTriangle t;
    for (std::size_t k = 0; k < 3; ++k) {
        t.corners[k] = {object.uvs[triangle[k]].x * options.width, object.uvs[triangle[k]].y * options.height};
    }
    t.twice = cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
    return t;
}

std::int64_t wrapped(std::int64_t at, std::int64_t count)
{
    return (at % count + count) % count;
}

/// Mean directions of growing u at the vertices of the object, and from them those at the corners of the faces.
std::vector<Vec3> tangentsOn(const FlowSurface& surface, const FlowObject& object)
{
    std::vector<Vec3> tangents(object.vertices.size());
    for (const auto& [a, b, c] : object.triangles) {
        const Vec2 p = object.uvs[b] - object.uvs[a];
        const Vec2 q = object.uvs[c] - object.uvs[a];
        const double area = cross(p, q);
        const Vec3 along = std::copysign(1.0, area) * (q.y * (object.vertices[b] - object.vertices[a]) -
                                                       p.y * (object.vertices[c] - object.vertices[a]));
        for (const std::uint32_t v : {a, b, c}) {
            tangents[v] = tangents[v] + unit(along);
        }
    }
    std::vector<Vec3> on_faces;
    for (const FlowSurface::Face& face : surface.faces) {
        for (const std::array<double, 3>& weights : cornerWeights(object, face)) {
            on_faces.push_back(mixed(tangents, object.triangles[face.source], weights));
        }
    }
    return on_faces;
}

/// Sums over a texel.
struct Texel {
    double thickness = 0.0;  ///< of droplets [m]
    double film = 0.0;       ///< behind droplets [m]
    double age = std::numeric_limits<double>::infinity();
    Vec3 normal;  ///< times thickness, in the tangent frame
};

std::uint16_t level(double share)
{
    return static_cast<std::uint16_t>(std::lround(65535.0 * std::clamp(share, 0.0, 1.0)));
}

}  // namespace

void WetMapOptions::validate() const
{
    requireWithin("width", width, 16, 8192);
    requireWithin("height", height, 16, 8192);
    film.validate();
    require(full_thickness > 0.0 && std::isfinite(full_thickness), "full_thickness", full_thickness, "positive");
    require(full_age > 0.0 && std::isfinite(full_age), "full_age", full_age, "positive");
}

struct WetMapper::Content {
    Content(const FlowObject& of, const FlowTerrain& terrain_of, const WetMapOptions& given)
        : object(onFaces(of, terrain_of.surface())),
          first(terrain_of.surface()),
          terrain(&terrain_of),
          options(given),
          faces(first),
          tangents(tangentsOn(first, of))
    {
        spots.middle = of.vertices.front();
        const auto count = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
        std::vector<std::uint32_t> owner(count, kNobody);
        for (const Triangle& triangle : object.triangles) {
            spots.first.push_back(static_cast<std::uint32_t>(spots.places.size()));
            area.push_back(addTexels(triangle, owner));
        }
        spots.first.push_back(static_cast<std::uint32_t>(spots.places.size()));
        if (spots.places.empty()) {
            throw Error(ErrorCode::InvalidInput,
                        "the object's texture coordinates have no area: unwrap it before wet maps are made");
        }
        spots.spacing = std::sqrt(terrain->area() / static_cast<double>(spots.places.size()));
        wet.emplace(spots.places.size(), options.film);
        fillGutter(owner);
    }

    // Adds the texels of a triangle and returns the area that each stands for.
    double addTexels(const Triangle& triangle, std::vector<std::uint32_t>& owner)
    {
        const TexelTriangle t = inTexels(object, triangle, options);
        if (!(std::abs(t.twice) > 0.0)) {
            return 0.0;
        }
        const auto& [a, b, c] = t.corners;
        const auto lowest = [](double p, double q, double r) {
            return static_cast<std::int64_t>(std::ceil(std::min({p, q, r}) - 0.5));
        };
        const auto highest = [](double p, double q, double r) {
            return static_cast<std::int64_t>(std::floor(std::max({p, q, r}) - 0.5));
        };
        const std::int64_t left = lowest(a.x, b.x, c.x);
        const std::int64_t right = std::min(highest(a.x, b.x, c.x), left + kMaxRepeats * options.width);
        const std::int64_t top = lowest(a.y, b.y, c.y);
        const std::int64_t bottom = std::min(highest(a.y, b.y, c.y), top + kMaxRepeats * options.height);
        for (std::int64_t y = top; y <= bottom; ++y) {
            for (std::int64_t x = left; x <= right; ++x) {
                const std::array<double, 3> w = t.weights({static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5});
                const auto texel =
                    static_cast<std::uint32_t>(wrapped(y, options.height) * options.width + wrapped(x, options.width));
                // A texel on the edge of two triangles belongs to the first.
                const double inside = std::min({w[0], w[1], w[2]});
                if (inside < -kOnEdge || (inside < kOnEdge && owner[texel] != kNobody)) {
                    continue;
                }
                owner[texel] = texel;
                spots.add(mixed(object.vertices, triangle, w));
                texels.push_back(texel);
            }
        }
        const Vec3 p = object.vertices[triangle[1]] - object.vertices[triangle[0]];
        const Vec3 q = object.vertices[triangle[2]] - object.vertices[triangle[0]];
        return length(cross(p, q)) / std::abs(t.twice);
    }

    // Texels beside the islands repeat them.
    void fillGutter(std::vector<std::uint32_t>& owner)
    {
        std::vector<std::uint32_t> edge;
        for (std::uint32_t texel = 0; texel < owner.size(); ++texel) {
            if (owner[texel] != kNobody) {
                edge.push_back(texel);
            }
        }
        for (int ring = 0; ring < kGutter; ++ring) {
            std::vector<std::uint32_t> next;
            for (const std::uint32_t texel : edge) {
                const std::int64_t x = texel % static_cast<std::uint32_t>(options.width);
                const std::int64_t y = texel / static_cast<std::uint32_t>(options.width);
                for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
                    if (x + dx < 0 || y + dy < 0 || x + dx >= options.width || y + dy >= options.height) {
                        continue;
                    }
                    const auto at = static_cast<std::uint32_t>((y + dy) * options.width + x + dx);
                    if (owner[at] == kNobody) {
                        owner[at] = owner[texel];
                        gutter.emplace_back(at, owner[texel]);
                        next.push_back(at);
                    }
                }
            }
            edge = std::move(next);
        }
    }

    // Normal of the water in the tangent frame of a place.
    [[nodiscard]] Vec3 inTangentFrame(Vec3 normal, const WaterAt& at) const
    {
        const Triangle& triangle = object.triangles[at.face];
        const Vec3 across = cross(object.vertices[triangle[1]] - object.vertices[triangle[0]],
                                  object.vertices[triangle[2]] - object.vertices[triangle[0]]);
        const std::array<double, 3> weights = weightsAt(object, triangle, shown().place(at.spot));
        const Vec3 up = unit(mixed(object.normals, triangle, weights));
        const Vec3 tangent = mixed(tangents, triangle, weights);
        const Vec3 x = unit(tangent - dot(tangent, up) * up);
        const Vec2 uv_p = object.uvs[triangle[1]] - object.uvs[triangle[0]];
        const Vec2 uv_q = object.uvs[triangle[2]] - object.uvs[triangle[0]];
        // v grows downward in the texture. An island seen from behind is mirrored.
        const bool is_mirrored = cross(uv_p, uv_q) * dot(across, up) > 0.0;
        const Vec3 y = (is_mirrored ? -1.0 : 1.0) * cross(up, x);
        return {dot(normal, x), dot(normal, y), dot(normal, up)};
    }

    /// Gives texels of the film their normals, by the film's thickness in the texels beside them.
    void bendFilm(std::vector<Texel>& drawn) const
    {
        const auto rise = [&](std::int64_t x, std::int64_t y, std::int64_t dx, std::int64_t dy) {
            const auto film = [&](std::int64_t column, std::int64_t row) {
                return drawn[static_cast<std::size_t>(wrapped(row, options.height) * options.width +
                                                      wrapped(column, options.width))]
                    .film;
            };
            return 0.5 * (film(x + dx, y + dy) - film(x - dx, y - dy));
        };
        const std::vector<FlowSurface::Face>& all = terrain->surface().faces;
        for (std::uint32_t face = 0; face < all.size(); ++face) {
            const Triangle& triangle = object.triangles[face];
            const TexelTriangle t = inTexels(object, triangle, options);
            const Vec3 p = object.vertices[triangle[1]] - object.vertices[triangle[0]];
            const Vec3 q = object.vertices[triangle[2]] - object.vertices[triangle[0]];
            const Vec3 across = cross(p, q);
            const double size = dot(across, across);
            for (std::uint32_t spot = spots.first[face]; spot < spots.first[face + 1]; ++spot) {
                Texel& texel = drawn[texels[spot]];
                if (texel.thickness > 0.0 || texel.film <= 0.0 || !(size > 0.0)) {
                    continue;
                }
                const std::int64_t x = texels[spot] % static_cast<std::uint32_t>(options.width);
                const std::int64_t y = texels[spot] / static_cast<std::uint32_t>(options.width);
                const Vec2 slope{rise(x, y, 1, 0), rise(x, y, 0, 1)};
                // Changes along both sides of the triangle, and from them the gradient on it.
                const double along_p = dot(slope, t.corners[1] - t.corners[0]);
                const double along_q = dot(slope, t.corners[2] - t.corners[0]);
                const Vec3 gradient = (1.0 / size) * cross(along_p * q - along_q * p, across);
                texel.normal = inTangentFrame(all[face].normal - gradient, {face, spot, 0.0, {}});
            }
        }
    }

    struct Shown {
        std::array<double, 3> normal;
        double thickness = 0.0;  ///< [m]
        double age = 0.0;        ///< [s]
        double wet = 0.0;        ///< 0 … 1
    };

    // Calls take(shown) for all texels.
    template <typename Take>
    void draw(double time, std::span<const FlowSample> samples, const Surface& droplets, const Take& take)
    {
        const auto water = waterOf(shown(), terrain->surface(), area, samples, droplets);
        std::vector<Texel> drawn(static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height));
        std::vector<double> film(texels.size());
        tbb::parallel_for(std::size_t{0}, texels.size(),
                          [&](std::size_t spot) { film[spot] = wet->thickness(spot, spots.place(spot), time); });
        for (std::size_t spot = 0; spot < texels.size(); ++spot) {
            Texel& texel = drawn[texels[spot]];
            texel.film = std::max(texel.film, film[spot]);
            texel.age = std::min(texel.age, wet->age(spot, time));
        }
        for (const std::vector<WaterAt>& droplet : water) {
            for (const WaterAt& at : droplet) {
                Texel& texel = drawn[texels[at.spot]];
                texel.thickness += at.thickness;
                texel.age = 0.0;
                texel.normal = texel.normal + at.thickness * unit(inTangentFrame(at.normal, at));
            }
        }
        for (const auto& [to, from] : gutter) {
            drawn[to] = drawn[from];
        }
        bendFilm(drawn);
        const double full = options.film.thickness;
        for (const Texel& texel : drawn) {
            const Vec3 normal = length(texel.normal) > 0.0 ? unit(texel.normal) : Vec3{0.0, 0.0, 1.0};
            const bool is_under = texel.thickness > 0.0;
            take(Shown{{normal.x, normal.y, normal.z},
                       is_under ? texel.thickness : texel.film,
                       std::min(texel.age, options.full_age),
                       is_under     ? 1.0
                       : full > 0.0 ? std::min(texel.film / full, 1.0)
                                    : 0.0});
        }
    }

    /// Places on the shape that is mapped.
    [[nodiscard]] const WetSpots& shown() const { return reshaped ? *reshaped : spots; }

    void reshape(const FlowObject& of, const FlowTerrain& shape)
    {
        const std::vector<FlowSurface::Face>& from = terrain->surface().faces;
        const std::vector<FlowSurface::Face>& to = shape.surface().faces;
        for (std::size_t face = 0; face < area.size(); ++face) {
            area[face] *= areaOf(to[face]) / areaOf(from[face]);
        }
        reshaped = spots;
        reshaped->middle = of.vertices.front();
        reshaped->places.clear();
        for (std::size_t face = 0; face < to.size(); ++face) {
            for (std::uint32_t spot = spots.first[face]; spot < spots.first[face + 1]; ++spot) {
                reshaped->add(followed(first.faces[face], to[face], spots.place(spot)));
            }
        }
        object = onFaces(of, shape.surface());
        tangents = tangentsOn(shape.surface(), of);
        terrain = &shape;
    }

    FlowObject object;         // whose triangles are the faces
    const FlowSurface& first;  // its first shape
    const FlowTerrain* terrain;
    WetMapOptions options;
    FacesAround faces;
    std::vector<Vec3> tangents;
    WetSpots spots;                                               // on the first shape
    std::optional<WetSpots> reshaped;                             // on another one
    std::vector<std::uint32_t> texels;                            // of the spots
    std::vector<double> area;                                     // of every face's texels [m²]
    std::vector<std::pair<std::uint32_t, std::uint32_t>> gutter;  // texel and the one that it repeats
    std::optional<WetPlaces> wet;
};

WetMapper::WetMapper(const FlowObject& object, const FlowTerrain& terrain, const WetMapOptions& options)
{
    options.validate();
    if (object.uvs.empty()) {
        throw Error(
            ErrorCode::InvalidArgument,
            "wet maps need an object with texture coordinates (uv), but this one has none: unwrap it, and save it "
            "as GLB, glTF or OBJ");
    }
    content_ = std::make_unique<Content>(object, terrain, options);
}
WetMapper::~WetMapper() = default;
WetMapper::WetMapper(WetMapper&&) noexcept = default;
WetMapper& WetMapper::operator=(WetMapper&&) noexcept = default;

void WetMapper::add(std::span<const FlowTrack> tracks)
{
    wetTracks(content_->spots, tracks, content_->faces, *content_->wet);
}

void WetMapper::reshape(const FlowObject& object, const FlowTerrain& terrain)
{
    content_->reshape(object, terrain);
}

WetMaps WetMapper::maps(double time, std::span<const FlowSample> samples, const Surface& droplets)
{
    const WetMapOptions& options = content_->options;
    WetMaps maps{{options.width, options.height, 3, {}},
                 {options.width, options.height, 1, {}},
                 {options.width, options.height, 1, {}},
                 {options.width, options.height, 1, {}}};
    content_->draw(time, samples, droplets, [&](const Content::Shown& texel) {
        for (const double part : texel.normal) {
            maps.normal.levels.push_back(level(0.5 * (part + 1.0)));
        }
        maps.thickness.levels.push_back(level(texel.thickness / options.full_thickness));
        maps.age.levels.push_back(level(texel.age / options.full_age));
        maps.wet.levels.push_back(level(texel.wet));
    });
    return maps;
}

WetFloatMaps WetMapper::floatMaps(double time, std::span<const FlowSample> samples, const Surface& droplets)
{
    const WetMapOptions& options = content_->options;
    WetFloatMaps maps{{options.width, options.height, 3, {}},
                      {options.width, options.height, 1, {}},
                      {options.width, options.height, 1, {}},
                      {options.width, options.height, 1, {}}};
    content_->draw(time, samples, droplets, [&](const Content::Shown& texel) {
        for (const double part : texel.normal) {
            maps.normal.values.push_back(static_cast<float>(part));
        }
        maps.thickness.values.push_back(static_cast<float>(texel.thickness));
        maps.age.values.push_back(static_cast<float>(texel.age));
        maps.wet.values.push_back(static_cast<float>(texel.wet));
    });
    return maps;
}

std::string WetMapper::bytes() const
{
    return content_->wet->bytes();
}

void WetMapper::restore(std::string_view bytes, const std::string& name)
{
    content_->wet->restore(bytes, name);
}

}  // namespace droplet

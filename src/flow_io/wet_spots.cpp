// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_io/wet_spots.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

#include "droplet/flow_io/droplet_surfaces.h"
#include "exact_bytes.h"

namespace droplet {
namespace {

constexpr std::string_view kHead = "droplet-shape wet places 2\n";

/// Distance of two segments (C. Ericson, "Real-Time Collision Detection", 2004, section 5.1.9) [m].
double distanceBetween(Vec3 p1, Vec3 q1, Vec3 p2, Vec3 q2)
{
    const Vec3 d1 = q1 - p1;
    const Vec3 d2 = q2 - p2;
    const Vec3 r = p1 - p2;
    const double a = dot(d1, d1);
    const double e = dot(d2, d2);
    if (a == 0.0) {
        return distanceFrom(p1, p2, q2);
    }
    if (e == 0.0) {
        return distanceFrom(p2, p1, q1);
    }
    const double b = dot(d1, d2);
    const double c = dot(d1, r);
    const double f = dot(d2, r);
    const double across = a * e - b * b;
    double s = across > 1e-12 * a * e ? std::clamp((b * f - c * e) / across, 0.0, 1.0) : 0.0;
    double t = (b * s + f) / e;
    if (t < 0.0 || t > 1.0) {
        t = std::clamp(t, 0.0, 1.0);
        s = std::clamp((b * t - c) / a, 0.0, 1.0);
    }
    return length(p1 + s * d1 - (p2 + t * d2));
}

/// Thickness of a droplet over the plane of its frame, as a grid.
class Columns {
public:
    /// @param cell  [m]
    Columns(const DropletFrame& frame, std::span<const Vec3> vertices, std::span<const Vec3> normals,
            std::span<const Triangle> triangles, std::uint32_t first, double cell)
        : frame_(frame)
    {
        constexpr double kMin = 8.0;
        constexpr double kMax = 96.0;
        std::vector<Vec3> local;
        Vec2 high{-1e300, -1e300};
        low_ = {1e300, 1e300};
        for (const Vec3 p : vertices) {
            local.push_back(toLocal(p));
            low_ = {std::min(low_.x, local.back().x), std::min(low_.y, local.back().y)};
            high = {std::max(high.x, local.back().x), std::max(high.y, local.back().y)};
        }
        const double size = std::max(high.x - low_.x, high.y - low_.y);
        cell_ = size / std::clamp(std::ceil(size / cell), kMin, kMax);
        // Nodes keep off the lines of symmetry, where edges of triangles lie.
        low_ = low_ - Vec2{0.637 * cell_, 0.381 * cell_};
        columns_ = static_cast<int>(std::ceil((high.x - low_.x) / cell_)) + 2;
        rows_ = static_cast<int>(std::ceil((high.y - low_.y) / cell_)) + 2;
        nodes_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
        for (const auto& [a, b, c] : triangles) {
            fill({local[a - first], local[b - first], local[c - first]},
                 {normals[a - first], normals[b - first], normals[c - first]});
        }
        reach_ = length(Vec2{std::max(high.x, -low_.x), std::max(high.y, -low_.y)});
    }

    [[nodiscard]] double reach() const { return reach_; }

    /// Thickness and, times it, normal at a place.
    [[nodiscard]] WaterAt at(Vec3 place) const
    {
        const Vec3 p = toLocal(place);
        const double x = (p.x - low_.x) / cell_;
        const double y = (p.y - low_.y) / cell_;
        WaterAt sum;
        if (!(x >= 0.0 && y >= 0.0 && x < columns_ - 1 && y < rows_ - 1 && std::abs(p.z) < reach_)) {
            return sum;
        }
        const double fx = x - std::floor(x);
        const double fy = y - std::floor(y);
        for (int k = 0; k < 4; ++k) {
            const int i = k % 2;
            const int j = k / 2;
            const double weight = (i == 0 ? 1.0 - fx : fx) * (j == 0 ? 1.0 - fy : fy);
            const Node& node = nodes_[index(static_cast<int>(x) + i, static_cast<int>(y) + j)];
            sum.thickness += weight * node.thickness;
            sum.normal = sum.normal + weight * node.normal;
        }
        return sum;
    }

private:
    struct Node {
        double thickness = 0.0;
        double top = -1e300;
        Vec3 normal;
    };

    [[nodiscard]] Vec3 toLocal(Vec3 place) const
    {
        const Vec3 d = place - frame_.place;
        return {dot(d, frame_.ahead), dot(d, frame_.left), dot(d, frame_.normal)};
    }
    [[nodiscard]] std::size_t index(int column, int row) const
    {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
    }

    // Adds a triangle: liquid begins below its upper sides and ends at its lower sides.
    void fill(const std::array<Vec3, 3>& corners, const std::array<Vec3, 3>& normals)
    {
        const auto flat = [&](std::size_t k) { return Vec2{corners[k].x, corners[k].y}; };
        const double area = cross(flat(1) - flat(0), flat(2) - flat(0));
        if (area == 0.0) {
            return;
        }
        const auto first = [&](double a, double b, double c, double from) {
            return std::max(static_cast<int>(std::ceil((std::min({a, b, c}) - from) / cell_)), 0);
        };
        const auto last = [&](double a, double b, double c, double from, int count) {
            return std::min(static_cast<int>(std::floor((std::max({a, b, c}) - from) / cell_)), count - 1);
        };
        for (int row = first(flat(0).y, flat(1).y, flat(2).y, low_.y);
             row <= last(flat(0).y, flat(1).y, flat(2).y, low_.y, rows_); ++row) {
            for (int column = first(flat(0).x, flat(1).x, flat(2).x, low_.x);
                 column <= last(flat(0).x, flat(1).x, flat(2).x, low_.x, columns_); ++column) {
                const Vec2 p = low_ + cell_ * Vec2{static_cast<double>(column), static_cast<double>(row)};
                const double u = cross(p - flat(0), flat(2) - flat(0)) / area;
                const double v = cross(flat(1) - flat(0), p - flat(0)) / area;
                const double w = 1.0 - u - v;
                if (u < 0.0 || v < 0.0 || w < 0.0) {
                    continue;
                }
                Node& node = nodes_[index(column, row)];
                const double height = w * corners[0].z + u * corners[1].z + v * corners[2].z;
                node.thickness += area > 0.0 ? height : -height;
                if (area > 0.0 && height > node.top) {
                    node.top = height;
                    node.normal = w * normals[0] + u * normals[1] + v * normals[2];
                }
            }
        }
    }

    DropletFrame frame_;
    Vec2 low_;
    double cell_ = 0.0;
    int columns_ = 0;
    int rows_ = 0;
    double reach_ = 0.0;
    std::vector<Node> nodes_;
};

}  // namespace

double distanceFrom(Vec3 p, Vec3 from, Vec3 to)
{
    const Vec3 way = to - from;
    const double size = dot(way, way);
    const double t = size > 0.0 ? std::clamp(dot(p - from, way) / size, 0.0, 1.0) : 0.0;
    return length(p - (from + t * way));
}

const std::vector<std::uint32_t>& FacesAround::find(const Around& around)
{
    seen_.resize(surface_.faces.size());
    ++search_;
    found_.assign(1, around.face);
    seen_[around.face] = search_;
    const Vec3 normal = surface_.faces[around.face].normal;
    for (std::size_t i = 0; i < found_.size(); ++i) {
        const FlowSurface::Face& face = surface_.faces[found_[i]];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t next = face.neighbour[k];
            if (next == FlowSurface::kNone || seen_[next] == search_ ||
                dot(surface_.faces[next].normal, normal) < -0.2 ||
                distanceBetween(around.from, around.to, face.corners[k], face.corners[(k + 1) % 3]) > around.reach) {
                continue;
            }
            seen_[next] = search_;
            found_.push_back(next);
        }
    }
    return found_;
}

void WetPlaces::pass(std::size_t spot, std::uint64_t id, const Passage& passage, double distance)
{
    Place& place = places_[spot];
    const auto last_bits = static_cast<std::uint32_t>(id);
    // As a droplet comes and goes, the place is nearest to its way when its middle is beside it.
    const double beside = passage.speed > 0.0 ? passage.width / passage.speed : 0.0;
    const bool is_same = place.id == last_bits && age(spot, passage.time) <= beside;
    if (!is_same || distance <= static_cast<double>(place.distance)) {
        place = {static_cast<float>(passage.time), static_cast<float>(passage.width), static_cast<float>(passage.speed),
                 static_cast<float>(distance), last_bits};
    }
}

double WetPlaces::thickness(std::size_t spot, Vec3 at, double time) const
{
    const Place& place = places_[spot];
    if (place.width <= 0.0F) {
        return 0.0;
    }
    const Passage passage{0.0, static_cast<double>(place.width), static_cast<double>(place.speed)};
    return trailSection(film_, passage, at, age(spot, time)).at(static_cast<double>(place.distance));
}

double WetPlaces::age(std::size_t spot, double time) const
{
    return std::max(time - static_cast<double>(places_[spot].time), 0.0);
}

std::string WetPlaces::bytes() const
{
    ExactWriter out(kHead);
    out.put(std::uint64_t{places_.size()});
    const auto pair = [](float a, float b) {
        return std::uint64_t{std::bit_cast<std::uint32_t>(a)} << 32U | std::bit_cast<std::uint32_t>(b);
    };
    // Runs of wet places: most are dry.
    for (std::size_t begin = 0; begin < places_.size();) {
        std::size_t end = begin;
        while (end < places_.size() && places_[end].width > 0.0F) {
            ++end;
        }
        if (end > begin) {
            out.all(std::uint64_t{begin}, std::uint64_t{end - begin});
        }
        for (; begin < end; ++begin) {
            const Place& place = places_[begin];
            out.all(pair(place.time, place.width), pair(place.speed, place.distance), std::uint64_t{place.id});
        }
        ++begin;
    }
    return out.release();
}

void WetPlaces::restore(std::string_view bytes, const std::string& name)
{
    ExactReader in(bytes, kHead, name);
    std::uint64_t count = 0;
    in.get(count);
    in.require(count == places_.size());
    std::vector<Place> places(places_.size());
    std::size_t next = 0;
    const auto pair = [&](float& a, float& b) {
        std::uint64_t bits = 0;
        in.get(bits);
        a = std::bit_cast<float>(static_cast<std::uint32_t>(bits >> 32U));
        b = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
        in.require(std::isfinite(a) && std::isfinite(b) && a >= 0.0F && b >= 0.0F);
    };
    while (!in.ended()) {
        std::uint64_t begin = 0;
        in.get(begin);
        const std::size_t length = in.count(24);
        in.require(begin >= next && begin <= places.size() && length <= places.size() - begin);
        for (next = begin; next < begin + length; ++next) {
            Place& place = places[next];
            std::uint64_t id = 0;
            pair(place.time, place.width);
            pair(place.speed, place.distance);
            in.get(id);
            in.require(place.width > 0.0F && id <= std::numeric_limits<std::uint32_t>::max());
            place.id = static_cast<std::uint32_t>(id);
        }
    }
    places_ = std::move(places);
}

void wetTracks(const WetSpots& spots, std::span<const FlowTrack> tracks, FacesAround& faces, WetPlaces& wet)
{
    for (const FlowTrack& track : tracks) {
        const double reach = 0.5 * track.width;
        for (const std::uint32_t face : faces.find({track.face, track.from, track.to, reach})) {
            for (std::uint32_t spot = spots.first[face]; spot < spots.first[face + 1]; ++spot) {
                const double distance = distanceFrom(spots.place(spot), track.from, track.to);
                if (distance <= reach) {
                    wet.pass(spot, track.id, {track.time, track.width, track.speed}, distance);
                }
            }
        }
    }
}

std::vector<std::vector<WaterAt>> waterOf(const WetSpots& spots, const FlowSurface& surface,
                                          std::span<const double> area, std::span<const FlowSample> samples,
                                          const Surface& droplets)
{
    std::vector<std::vector<WaterAt>> water(samples.size());
    if (samples.empty()) {
        return water;
    }
    const std::size_t vertices = droplets.vertices.size() / samples.size();
    const std::size_t triangles = droplets.triangles.size() / samples.size();
    tbb::enumerable_thread_specific<FacesAround> searches(surface);
    tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t d) {
        const FlowSample& sample = samples[d];
        if (!sample.face || sample.contact == FlowContact::Air) {
            return;
        }
        std::vector<WaterAt>& held = water[d];
        WaterAt nearest;
        double least = std::numeric_limits<double>::infinity();
        double sum = 0.0;
        const auto consider = [&](WaterAt there, Vec3 place) {
            const double away = length(place - sample.place);
            if (away < least) {
                least = away;
                nearest = {there.face, there.spot, 1.0, {}};
            }
            if (there.thickness > 0.0) {
                held.push_back(there);
                sum += there.thickness * area[there.face];
            }
        };
        const auto scale = [&] {
            if (held.empty() && std::isfinite(least)) {
                held.push_back(nearest);
                sum = area[nearest.face];
            }
            for (WaterAt& there : held) {
                there.thickness *= sample.volume / sum;
            }
        };
        if (sample.pond) {
            for (std::size_t k = 0; k < sample.pond->faces.size(); ++k) {
                const std::uint32_t face = sample.pond->faces[k];
                for (std::uint32_t spot = spots.first[face]; spot < spots.first[face + 1]; ++spot) {
                    const Vec3 place = spots.place(spot);
                    const double depth = sample.pond->heightOver(k, place) - dot(sample.pond->up, place);
                    // A place stands for ground that may be steep.
                    const double flat = std::max(dot(surface.faces[face].normal, sample.pond->up), 0.0);
                    consider({face, spot, depth * flat, sample.pond->up}, place);
                }
            }
            scale();
            return;
        }
        const Columns columns(frameOf(sample, {}), std::span(droplets.vertices).subspan(d * vertices, vertices),
                              std::span(droplets.normals).subspan(d * vertices, vertices),
                              std::span(droplets.triangles).subspan(d * triangles, triangles),
                              static_cast<std::uint32_t>(d * vertices), spots.spacing);
        const Around around{*sample.face, sample.place, sample.place, std::max(columns.reach(), 2.0 * spots.spacing)};
        for (const std::uint32_t face : searches.local().find(around)) {
            for (std::uint32_t spot = spots.first[face]; spot < spots.first[face + 1]; ++spot) {
                const Vec3 place = spots.place(spot);
                WaterAt there = columns.at(place);
                there.face = face;
                there.spot = spot;
                consider(there, place);
            }
        }
        scale();
    });
    return water;
}

}  // namespace droplet

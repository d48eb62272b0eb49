// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/streak_ribbons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>

#include "droplet/flow/flow_terrain.h"
#include "flow/following.h"
#include "flow_io/trail_section.h"
#include "unit_vector.h"

namespace droplet {
namespace {

/// Points may be left out where the path is straight to this part of its width, and shorter than this number of widths.
constexpr double kStraight = 0.02;
constexpr double kLongest = 4.0;
/// Steps shorter than this part of the width are left out, as where a droplet follows an edge on both of its sides.
constexpr double kShort = 0.05;
/// Ribbons shorter than this part of their width are left out: the droplet hardly moved.
constexpr double kShortest = 0.25;
/// Distance of cross-sections over the width of the droplet: pieces of a film that has broken up are about as long.
constexpr double kBetween = 0.12;
/// Pieces narrower than this part of the droplet are left out.
constexpr double kNarrowest = 0.02;
/// Where across it the vertices are, over the half width.
constexpr std::array<double, 5> kAcross{1.0, 0.55, 0.0, -0.55, -1.0};
/// Height of its sides over that of its middle: they show on the surface.
constexpr double kSides = 0.1;
/// Stations of a round end: distance from the end over the half width.
constexpr std::array<double, 4> kRoundEnd{0.0, 0.13, 0.5, 1.0};

/// Cross-section of a ribbon.
struct Station {
    Vec3 place;
    Vec3 normal;
    Vec3 left;
    Passage passage;
    double along = 0.0;  ///< distance from the begin [m]
    Vec3 rest;           ///< the place that the film's unevenness belongs to
    TrailSection film = {};
};

Station between(const Station& a, const Station& b, double along)
{
    const double share = (along - a.along) / (b.along - a.along);
    const auto mixed = [share](auto from, auto to) { return from + share * (to - from); };
    return {mixed(a.place, b.place),
            unit(mixed(a.normal, b.normal)),
            unit(mixed(a.left, b.left)),
            {mixed(a.passage.time, b.passage.time), mixed(a.passage.width, b.passage.width),
             mixed(a.passage.speed, b.passage.speed)},
            along,
            mixed(a.rest, b.rest),
            {}};
}

/// Station at a distance from the begin, with the mean direction of its cross-section over a width of the ribbon: where
/// the way turns on less than that, the cross-sections of single places would cross one another.
Station stationAt(const std::vector<Station>& knots, double along)
{
    const auto at = [&](double place) {
        const auto next = std::upper_bound(knots.begin() + 1, knots.end() - 1, place,
                                           [](double value, const Station& knot) { return value < knot.along; });
        return between(*(next - 1), *next, place);
    };
    Station station = at(along);
    constexpr int kAround = 4;  // on each side
    Vec3 left;
    for (int k = -kAround; k <= kAround; ++k) {
        const double off = 0.5 * station.passage.width * k / kAround;
        left = left + at(std::clamp(along + off, 0.0, knots.back().along)).left;
    }
    left = left - dot(left, station.normal) * station.normal;
    if (length(left) > 0.0) {
        station.left = unit(left);
    }
    return station;
}

/// Whether the ribbon between two cross-sections has no fold: its corners, seen from above, all turn left.
bool isUnfolded(const Station& a, const Station& b)
{
    const auto side = [](const Station& s, double share) { return s.place + share * s.film.half_width * s.left; };
    const std::array<Vec3, 4> corners{side(a, 1.0), side(a, -1.0), side(b, -1.0), side(b, 1.0)};
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec3 before = corners[(k + 1) % 4] - corners[k];
        const Vec3 after = corners[(k + 2) % 4] - corners[(k + 1) % 4];
        if (dot(cross(before, after), a.normal + b.normal) < 0.0) {
            return false;
        }
    }
    return true;
}

/// Lifetime in an animation with frames of a duration: what becomes beads stays up to √2 times as long, so that few
/// different lifetimes occur and few parts of the mesh vanish by themselves.
double shownFor(const TrailFilm& film, const Passage& passage, std::optional<double> frame)
{
    const double life = lifetime(film, passage);
    if (!frame || !std::isfinite(life) || life == film.drying) {
        return life;
    }
    return *frame * std::exp2(0.5 * std::ceil(2.0 * std::log2(std::max(life / *frame, 1.0))));
}

/// Adds a piece of a ribbon.
void append(std::span<const Station> stations, const TrailFilm& film, std::optional<double> frame, StreakMesh& mesh)
{
    Surface& surface = mesh.surface;
    constexpr auto kCount = static_cast<std::uint32_t>(kAcross.size());
    double width = 0.0;
    for (const Station& station : stations) {
        width += station.passage.width / static_cast<double>(stations.size());
    }
    const auto first = static_cast<std::uint32_t>(surface.vertices.size());
    for (const Station& s : stations) {
        const auto& [half, height] = s.film;
        for (const double side : kAcross) {
            const double up = height * (kSides + (1.0 - kSides) * (1.0 - side * side));
            const double tilt = half > 0.0 ? 2.0 * height * side / half : 0.0;  // slope of a parabola
            surface.vertices.push_back(s.place + side * half * s.left + up * s.normal);
            surface.normals.push_back(unit(s.normal + tilt * s.left));
            surface.uvs.push_back({0.5 - 0.5 * side, s.along / width});
        }
    }
    for (std::uint32_t i = 0; i + 1 < stations.size(); ++i) {
        const Passage& passage = stations[i + 1].passage;
        for (std::uint32_t k = 0; k + 1 < kCount; ++k) {
            const std::uint32_t a = first + kCount * i + k;
            surface.triangles.push_back({a, a + 1, a + kCount + 1});
            surface.triangles.push_back({a, a + kCount + 1, a + kCount});
            mesh.wetted.insert(mesh.wetted.end(), 2, passage.time);
            mesh.gone.insert(mesh.gone.end(), 2, passage.time + shownFor(film, passage, frame));
        }
    }
}

/// Where along a ribbon its cross-sections are.
/// @param step  of time; there is one at each of its multiples
std::vector<double> stationsOn(const std::vector<Station>& knots, std::optional<double> step)
{
    const double whole = knots.back().along;
    std::vector<double> stations;
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
        const Station& a = knots[i];
        const Station& b = knots[i + 1];
        const auto parts = static_cast<int>(std::ceil((b.along - a.along) / (kBetween * b.passage.width)));
        for (int k = 0; k < parts; ++k) {
            stations.push_back(a.along + (b.along - a.along) * k / parts);
        }
        const double begin = a.passage.time;
        const double end = b.passage.time;
        const auto last = step ? static_cast<std::int64_t>(std::ceil(end / *step)) : 0;
        for (auto k = step ? static_cast<std::int64_t>(std::floor(begin / *step)) + 1 : 0; k < last; ++k) {
            const double share = (*step * static_cast<double>(k) - begin) / (end - begin);
            stations.push_back(a.along + share * (b.along - a.along));
        }
    }
    for (const double share : kRoundEnd) {
        stations.push_back(std::min(0.5 * share * knots.front().passage.width, whole));
        stations.push_back(std::max(whole - 0.5 * share * knots.back().passage.width, 0.0));
    }
    std::sort(stations.begin(), stations.end());
    stations.erase(std::unique(stations.begin(), stations.end()), stations.end());
    return stations;
}

}  // namespace

StreakRibbons::StreakRibbons(const TrailFilm& film) : film_(film)
{
    film_.validate();
}

void StreakRibbons::extend(Ribbon& ribbon, const FlowTrack& track, Vec3 normal)
{
    Point& last = ribbon.back();
    const Point& before = ribbon[ribbon.size() - 2];
    const Vec3 chord = track.to - before.place;
    const Vec3 off = last.place - before.place;
    const double size = length(chord);
    const double across = size > 0.0 ? length(cross(unit(chord), off)) : length(off);
    const bool is_straight = last.face == track.face && size >= length(off) && size <= kLongest * track.width &&
                             across <= kStraight * track.width;
    if (is_straight || std::max(size, length(off)) <= kShort * track.width) {
        last = {track.to, last.normal, track.width, track.time, track.speed, track.face, track.to};
        return;
    }
    if (last.face != track.face) {
        last.normal = unit(last.normal + normal);
    }
    ribbon.push_back({track.to, normal, track.width, track.time, track.speed, track.face, track.to});
}

void StreakRibbons::add(std::span<const FlowTrack> tracks, const FlowSurface& surface)
{
    surface_ = &surface;
    for (const FlowTrack& track : tracks) {
        const Vec3 normal = surface.faces[track.face].normal;
        std::vector<Ribbon>& all = ribbons_[track.id];
        // Where one piece ends, the next begins; droplets that merge move to their common centre.
        const double gap = all.empty() ? 0.0 : length(all.back().back().place - track.from);
        if (!all.empty() && gap <= track.width) {
            if (gap > kShort * track.width) {
                extend(all.back(), {track.id, track.face, {}, track.from, track.width, track.time, track.speed},
                       normal);
            }
            extend(all.back(), track, normal);
            continue;
        }
        const double begin = track.speed > 0.0 ? track.time - length(track.to - track.from) / track.speed : track.time;
        all.push_back({{track.from, normal, track.width, begin, track.speed, track.face, track.from},
                       {track.to, normal, track.width, track.time, track.speed, track.face, track.to}});
    }
}

void StreakRibbons::forgetDry(double time)
{
    if (!film_.drying) {
        return;
    }
    for (auto one = ribbons_.begin(); one != ribbons_.end();) {
        std::erase_if(one->second, [&](const Ribbon& r) { return r.back().time < time - *film_.drying; });
        one = one->second.empty() ? ribbons_.erase(one) : std::next(one);
    }
}

StreakRibbons::Ribbon StreakRibbons::onShape(Ribbon ribbon, const FlowSurface& shape) const
{
    for (Point& point : ribbon) {
        const FlowSurface::Face& from = surface_->faces[point.face];
        const FlowSurface::Face& to = shape.faces[point.face];
        if (from.corners != to.corners) {
            const double stretch = stretchOf(from, to);
            point.place = followed(from, to, point.place);
            point.normal = turnedWith(from, to, point.normal);
            point.width *= stretch;
            point.speed *= stretch;
        }
    }
    return ribbon;
}

StreakMesh StreakRibbons::mesh(double time, const FlowSurface* shape) const
{
    return meshOf(time, {}, shape);
}

StreakMesh StreakRibbons::growing(double step) const
{
    return meshOf({}, step, nullptr);
}

StreakMesh StreakRibbons::meshOf(std::optional<double> time, std::optional<double> step, const FlowSurface* shape) const
{
    StreakMesh mesh;
    Surface& surface = mesh.surface;
    surface.mean_height = film_.thickness;
    for (const auto& [id, ribbons] : ribbons_) {
        for (const Ribbon& tracked : ribbons) {
            const Ribbon ribbon = shape != nullptr ? onShape(tracked, *shape) : tracked;
            std::vector<Station> knots;
            for (std::size_t i = 0; i < ribbon.size(); ++i) {
                const Point& point = ribbon[i];
                const Vec3 before = i > 0 ? unit(point.place - ribbon[i - 1].place) : Vec3{};
                const Vec3 after = i + 1 < ribbon.size() ? unit(ribbon[i + 1].place - point.place) : Vec3{};
                const Vec3 left = unit(cross(point.normal, before + after));
                const double way = i > 0 ? length(point.place - ribbon[i - 1].place) : 0.0;
                if (left == Vec3{} || (i > 0 && way == 0.0)) {
                    continue;
                }
                const double along = knots.empty() ? 0.0 : knots.back().along + way;
                knots.push_back(
                    {point.place, point.normal, left, {point.time, point.width, point.speed}, along, point.rest, {}});
            }
            if (knots.size() < 2 || knots.back().along < kShortest * knots.back().passage.width) {
                continue;
            }
            std::vector<Station> piece;  // between gaps, with its ends
            std::optional<Station> dry;  // the last station, if nothing is there
            const auto end = [&] {
                if (piece.size() > 1) {
                    append(piece, film_, step, mesh);
                }
                piece.clear();
            };
            const double whole = knots.back().along;
            for (const double along : stationsOn(knots, step)) {
                Station s = stationAt(knots, along);
                const double age = time ? std::max(*time - s.passage.time, 0.0) : settledAge(film_, s.passage);
                s.film = trailSection(film_, s.passage, s.rest, age);
                const double near = std::min(1.0, 2.0 * std::min(along, whole - along) / s.passage.width);
                const double round = std::sqrt(near * (2.0 - near));
                s.film.half_width *= round;
                if (!piece.empty() && !isUnfolded(piece.back(), s)) {
                    // The ribbon turns on less than its width: it goes on ahead, or in a new piece.
                    if (along - piece.back().along < s.passage.width) {
                        continue;
                    }
                    end();
                    dry.reset();
                }
                const bool is_wet = s.film.half_width > 0.5 * kNarrowest * s.passage.width;
                if (is_wet && dry) {
                    piece.push_back(*dry);
                }
                if (is_wet || !piece.empty()) {
                    piece.push_back(s);
                }
                dry = is_wet ? std::nullopt : std::optional(s);
                if (!is_wet) {
                    end();
                }
            }
            end();
        }
    }
    surface.weld.resize(surface.vertices.size());
    std::iota(surface.weld.begin(), surface.weld.end(), std::uint32_t{0});
    return mesh;
}

}  // namespace droplet

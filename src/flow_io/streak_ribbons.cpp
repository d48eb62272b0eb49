// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/streak_ribbons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "require.h"

namespace droplet {
namespace {

/// Points may be left out where the path is straight to this part of its width, and shorter than this number of widths.
constexpr double kStraight = 0.02;
constexpr double kLongest = 4.0;
/// Steps shorter than this part of the width are left out, as where a droplet follows an edge on both of its sides.
constexpr double kShort = 0.05;
/// Ribbons shorter than this part of their width are left out: the droplet hardly moved.
constexpr double kShortest = 0.25;
/// Height of a ribbon's sides over that of its middle.
constexpr double kSides = 0.2;
/// Stations of a round end: distance from the end over the half width.
constexpr std::array<double, 4> kRoundEnd{0.0, 0.13, 0.5, 1.0};

Vec3 unit(Vec3 v)
{
    const double size = length(v);
    return size > 0.0 ? (1.0 / size) * v : v;
}

/// Cross-section of a ribbon.
struct Station {
    Vec3 place;
    Vec3 normal;
    Vec3 left;
    double half_width = 0.0;
    double along = 0.0;   ///< distance from the begin [m]
    double wetted = 0.0;  ///< [s]
};

Station between(const Station& a, const Station& b, double along)
{
    const double share = (along - a.along) / (b.along - a.along);
    const auto mixed = [share](Vec3 from, Vec3 to) { return from + share * (to - from); };
    return {mixed(a.place, b.place),
            unit(mixed(a.normal, b.normal)),
            unit(mixed(a.left, b.left)),
            a.half_width + share * (b.half_width - a.half_width),
            along,
            a.wetted + share * (b.wetted - a.wetted)};
}

void append(const std::vector<Station>& stations, double thickness, StreakMesh& mesh)
{
    Surface& surface = mesh.surface;
    constexpr std::uint32_t kAcross = 3;
    double width = 0.0;
    for (const Station& station : stations) {
        width += 2.0 * station.half_width / static_cast<double>(stations.size());
    }
    const double whole = stations.back().along;
    const auto first = static_cast<std::uint32_t>(surface.vertices.size());
    for (const Station& s : stations) {
        const double share = std::min(1.0, std::min(s.along, whole - s.along) / s.half_width);
        const double half = s.half_width * std::sqrt(share * (2.0 - share));
        const double tilt = 2.0 * thickness / s.half_width;  // slope of the sides of a parabola
        for (const double side : {1.0, 0.0, -1.0}) {
            const double height = thickness * (side == 0.0 ? 1.0 : kSides);
            surface.vertices.push_back(s.place + side * half * s.left + height * s.normal);
            surface.normals.push_back(unit(s.normal + side * tilt * s.left));
            surface.uvs.push_back({0.5 - 0.5 * side, s.along / width});
        }
    }
    for (std::uint32_t i = 0; i + 1 < stations.size(); ++i) {
        for (std::uint32_t k = 0; k + 1 < kAcross; ++k) {
            const std::uint32_t a = first + kAcross * i + k;
            surface.triangles.push_back({a, a + 1, a + kAcross + 1});
            surface.triangles.push_back({a, a + kAcross + 1, a + kAcross});
            mesh.wetted.insert(mesh.wetted.end(), 2, stations[i + 1].wetted);
        }
    }
}

}  // namespace

void StreakRibbonOptions::validate() const
{
    require(!drying || *drying > 0.0, "drying", drying.value_or(0.0), "more than 0 s");
    require(thickness >= 0.0 && std::isfinite(thickness), "thickness", thickness, "finite and at least 0 m");
}

StreakRibbons::StreakRibbons(const StreakRibbonOptions& options) : options_(options)
{
    options_.validate();
}

void StreakRibbons::extend(Ribbon& ribbon, const FlowTrack& track, Vec3 normal) const
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
        last = {track.to, last.normal, track.width, track.time, track.face};
        return;
    }
    if (last.face != track.face) {
        last.normal = unit(last.normal + normal);
    }
    ribbon.push_back({track.to, normal, track.width, track.time, track.face});
}

void StreakRibbons::add(std::span<const FlowTrack> tracks, const FlowSurface& surface)
{
    for (const FlowTrack& track : tracks) {
        const Vec3 normal = surface.faces[track.face].normal;
        std::vector<Ribbon>& all = ribbons_[track.id];
        // Where one piece ends, the next begins; droplets that merge move to their common centre.
        const double gap = all.empty() ? 0.0 : length(all.back().back().place - track.from);
        if (!all.empty() && gap <= track.width) {
            if (gap > kShort * track.width) {
                extend(all.back(), {track.id, track.face, {}, track.from, track.width, track.time}, normal);
            }
            extend(all.back(), track, normal);
            continue;
        }
        all.push_back({{track.from, normal, track.width, track.time, track.face},
                       {track.to, normal, track.width, track.time, track.face}});
    }
    if (options_.drying && !tracks.empty()) {
        double now = 0.0;
        for (const FlowTrack& track : tracks) {
            now = std::max(now, track.time);
        }
        for (auto one = ribbons_.begin(); one != ribbons_.end();) {
            std::erase_if(one->second, [&](const Ribbon& r) { return r.back().time < now - *options_.drying; });
            one = one->second.empty() ? ribbons_.erase(one) : std::next(one);
        }
    }
}

StreakRibbons::Ribbon StreakRibbons::wetPart(const Ribbon& ribbon, double time) const
{
    const double since = time - options_.drying.value_or(0.0);
    const auto wet = options_.drying ? std::find_if(ribbon.begin(), ribbon.end(),
                                                    [&](const Point& point) { return point.time >= since; })
                                     : ribbon.begin();
    Ribbon part(wet, ribbon.end());
    if (wet != ribbon.begin() && wet != ribbon.end()) {
        Point begin = *(wet - 1);
        const double share = (since - begin.time) / (wet->time - begin.time);
        begin.place = begin.place + share * (wet->place - begin.place);
        part.insert(part.begin(), begin);
    }
    return part;
}

StreakMesh StreakRibbons::mesh(double time, std::optional<double> step) const
{
    StreakMesh mesh;
    Surface& surface = mesh.surface;
    surface.mean_height = options_.thickness;
    for (const auto& [id, ribbons] : ribbons_) {
        for (const Ribbon& ribbon : ribbons) {
            const Ribbon part = wetPart(ribbon, time);
            std::vector<Station> knots;
            for (std::size_t i = 0; i < part.size(); ++i) {
                const Vec3 before = i > 0 ? unit(part[i].place - part[i - 1].place) : Vec3{};
                const Vec3 after = i + 1 < part.size() ? unit(part[i + 1].place - part[i].place) : Vec3{};
                const Vec3 left = unit(cross(part[i].normal, before + after));
                const double way = i > 0 ? length(part[i].place - part[i - 1].place) : 0.0;
                if (left == Vec3{} || (i > 0 && way == 0.0)) {
                    continue;
                }
                const double along = knots.empty() ? 0.0 : knots.back().along + way;
                knots.push_back({part[i].place, part[i].normal, left, 0.5 * part[i].width, along, part[i].time});
            }
            if (knots.size() < 2 || knots.back().along < 2.0 * kShortest * knots.back().half_width) {
                continue;
            }
            const double whole = knots.back().along;
            std::vector<double> stations;
            stations.reserve(knots.size() + 2 * std::size(kRoundEnd));
            for (const Station& knot : knots) {
                stations.push_back(knot.along);
            }
            for (std::size_t i = 0; step && i + 1 < knots.size(); ++i) {
                const Station& a = knots[i];
                const Station& b = knots[i + 1];
                const auto last = static_cast<std::int64_t>(std::ceil(b.wetted / *step));
                for (auto k = static_cast<std::int64_t>(std::floor(a.wetted / *step)) + 1; k < last; ++k) {
                    const double share = (*step * static_cast<double>(k) - a.wetted) / (b.wetted - a.wetted);
                    stations.push_back(a.along + share * (b.along - a.along));
                }
            }
            for (const double share : kRoundEnd) {
                stations.push_back(std::min(share * knots.front().half_width, whole));
                stations.push_back(std::max(whole - share * knots.back().half_width, 0.0));
            }
            std::sort(stations.begin(), stations.end());
            stations.erase(std::unique(stations.begin(), stations.end()), stations.end());
            std::vector<Station> all;
            std::size_t knot = 0;
            for (const double along : stations) {
                while (knot + 2 < knots.size() && knots[knot + 1].along < along) {
                    ++knot;
                }
                all.push_back(between(knots[knot], knots[knot + 1], along));
            }
            append(all, options_.thickness, mesh);
        }
    }
    surface.weld.resize(surface.vertices.size());
    std::iota(surface.weld.begin(), surface.weld.end(), std::uint32_t{0});
    return mesh;
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "drawing/lettering.h"
#include "wind_io/plot.h"

namespace droplet {
namespace {

constexpr Colour kDown{62, 124, 177};
constexpr Colour kUp{66, 153, 118};
constexpr Colour kTorn{146, 98, 150};

/// Ticks in µL: 1, 2, 5, 10 …, or powers of ten over a wide range.
std::vector<Tick> volumeTicks(const Scale& scale)
{
    std::vector<Tick> ticks;
    const bool is_long = scale.high / scale.low > 3e3;
    const auto last = static_cast<int>(std::floor(std::log10(scale.high / kMicrolitre)));
    for (int decade = static_cast<int>(std::floor(std::log10(scale.low / kMicrolitre))); decade <= last; ++decade) {
        for (const double first : {1.0, 2.0, 5.0}) {
            const double value = first * std::pow(10.0, decade);
            const double volume = value * kMicrolitre;
            const bool is_inside = volume >= scale.low * (1.0 - 1e-9) && volume <= scale.high * (1.0 + 1e-9);
            if (is_inside && (first == 1.0 || !is_long)) {
                ticks.push_back({volume, written(value, 10)});
            }
        }
    }
    return ticks;
}

/// Edges of the regions at one volume, as coordinates on the page.
struct Level {
    double y = 0.0;
    double lower = 0.0;  ///< U₋
    double upper = 0.0;  ///< U₊
    double shedding = 0.0;
    bool has_lower = false;
    bool has_upper = false;
    bool has_shedding = false;
};

std::vector<Level> levelsOf(const ForceModel& model, double slope, const Scale& x, const Scale& y)
{
    constexpr int kLevels = 240;
    std::vector<double> volumes;
    for (int k = 0; k <= kLevels; ++k) {
        volumes.push_back(y.low * std::pow(y.high / y.low, static_cast<double>(k) / kLevels));
    }
    // Corners: where edges leave the plot, and where they bend at the edge of the boundary layer.
    for (const double wind : {x.low, x.high}) {
        for (const RegimeChange& change : regimeChanges(model, {slope, wind}, {y.low, y.high})) {
            // The rounded root may lie on either side.
            volumes.push_back(change.volume * (1.0 - 1e-9));
            volumes.push_back(change.volume * (1.0 + 1e-9));
        }
    }
    const double scale = model.air.boundary_layer / capOf(1.0, model.wetting.contact_angle).height;
    if (const double bend = scale * scale * scale; bend > y.low && bend < y.high) {
        volumes.push_back(bend);
    }
    std::sort(volumes.begin(), volumes.end());
    std::vector<Level> levels;
    for (const double volume : volumes) {
        const CapSize cap = capOf(volume, model.wetting.contact_angle);
        const Thresholds found = thresholdsOf(forcesOn(model, cap), slope);
        const auto shedding = tearOffWind(model, cap);
        const auto inside = [&](const std::optional<double>& wind) {
            const double rounding = 1e-6 * (x.high - x.low);
            return wind && *wind >= x.low - rounding && *wind <= x.high + rounding;
        };
        const auto at = [&](double wind) { return x.at(std::clamp(wind, x.low, x.high)); };
        levels.push_back({y.at(volume), at(found.lower.value_or(0.0)), at(found.upper.value_or(x.high)),
                          at(shedding.value_or(x.high)), inside(found.lower), inside(found.upper), inside(shedding)});
    }
    return levels;
}

/// Region between two edges, with its name.
struct Region {
    const char* name;
    const char* short_name;
    Colour colour;
    std::function<double(const Level&)> from;
    std::function<double(const Level&)> to;
};

void fill(Plot& plot, const std::vector<Level>& levels, const Region& region)
{
    std::vector<Vec2> outline;
    outline.reserve(2 * levels.size());
    for (const Level& level : levels) {
        outline.push_back({region.to(level), level.y});
    }
    std::transform(levels.rbegin(), levels.rend(), std::back_inserter(outline), [&](const Level& level) {
        return Vec2{region.from(level), level.y};
    });
    plot.area(std::move(outline), region.colour, 0.3);
}

/// Text and size of a name.
struct Lettering {
    const char* words;
    double size;
};

/// Writes the name of a region inside it, near the middle of its widest part and clear of vertical lines.
/// @return  whether there was room
bool name(Plot& plot, const std::vector<Level>& levels, const Region& region, const std::vector<double>& verticals,
          const Lettering& as)
{
    const double half_word = 0.5 * textWidth(as.words, as.size) + 6.0;
    constexpr double kHalfLine = 10.0;
    const auto width = [&](const Level& level) { return region.to(level) - region.from(level); };
    double widest = 0.0;
    for (const Level& level : levels) {
        widest = std::max(widest, width(level));
    }
    if (widest < 2.0 * half_word) {
        return false;
    }
    // The middle is the median of the heights where the region is nearly as wide.
    std::vector<double> heights;
    for (const Level& level : levels) {
        if (width(level) > 0.75 * widest) {
            heights.push_back(level.y);
        }
    }
    const double middle = heights[heights.size() / 2];
    std::optional<Vec2> best;
    double min = std::numeric_limits<double>::infinity();
    for (const Level& level : levels) {
        const double first = region.from(level) + half_word;
        const double last = region.to(level) - half_word;
        for (int k = 0; first + 6.0 * k <= last; ++k) {
            const double x = first + 6.0 * k;
            const bool fits = level.y > plot.top() + 28.0 && level.y < plot.bottom() - 14.0;
            const auto clear = [&](double line) { return std::abs(line - x) > half_word; };
            const bool is_clear = std::all_of(verticals.begin(), verticals.end(), clear) &&
                                  std::all_of(levels.begin(), levels.end(), [&](const Level& other) {
                                      return std::abs(other.y - level.y) > kHalfLine ||
                                             (x - half_word > region.from(other) && x + half_word < region.to(other));
                                  });
            const double off = std::hypot(x - 0.5 * (region.from(level) + region.to(level)), level.y - middle);
            if (fits && is_clear && off < min) {
                min = off;
                best = Vec2{x, level.y};
            }
        }
    }
    if (!best) {
        return false;
    }
    Colour deep{};
    for (std::size_t c = 0; c < 3; ++c) {
        deep[c] = static_cast<std::uint8_t>(region.colour[c] * 0.62);
    }
    plot.text({as.words, *best + Vec2{0.0, 5.0}, as.size, deep, Anchor::Middle, true});
    return true;
}

/// Draws an edge along the levels that have it.
template <typename Has>
void drawEdge(Plot& plot, const std::vector<Level>& levels, double Level::*edge, const Has& has)
{
    std::vector<Vec2> line;
    for (const Level& level : levels) {
        if (has(level)) {
            line.push_back({level.*edge, level.y});
        }
    }
    if (line.size() > 1) {
        edge == &Level::shedding ? plot.line(line, kSoft, 1.2, 3.5) : plot.line(line, kInk, 1.8);
    }
}

VolumeRange volumesOf(const TunnelSweep& swept, const TunnelCase& tunnel_case)
{
    // Up to twice the largest volume, and down to droplets too small to run; two to four decades.
    const auto [min, max] = std::minmax_element(swept.volumes.begin(), swept.volumes.end());
    const double high = 2.0 * *max;
    double low = std::min(0.5 * *min, 1e-2 * high);
    if (tunnel_case.critical_volume) {
        low = std::min(low, std::max(0.3 * *tunnel_case.critical_volume, 1e-4 * high));
    }
    return {low, high};
}

}  // namespace

Drawing regimeMap(const TunnelSweep& swept, const Tunnel& tunnel, const ChartOptions& options)
{
    Drawing drawing;
    const std::vector<Panel> panels = panelsOf(swept, tunnel, drawing);
    title(drawing, swept, options);
    const WindBand winds = windsOf(swept);
    for (const Panel& panel : panels) {
        const TunnelCase& first = *panel.cases.front();
        ForceModel model = swept.model;
        if (!model.wetting.sliding_angle) {
            model.wetting.hysteresis = first.hysteresis;
        }
        Plot plot(drawing, panel, 20.0);
        const VolumeRange volumes = volumesOf(swept, first);
        const Scale x = plot.across(winds.from, winds.to);
        const Scale y = plot.up(volumes.min, volumes.max, true);
        const auto x_ticks = ticksOf(x, 8.0);
        const auto y_ticks = volumeTicks(y);
        const std::vector<Level> levels = levelsOf(model, first.slope, x, y);
        const auto left = [&](const Level&) { return plot.left(); };
        const auto right = [&](const Level&) { return plot.right(); };
        const auto lower = [](const Level& level) { return std::min(level.lower, level.shedding); };
        const auto upper = [](const Level& level) { return std::min(level.upper, level.shedding); };
        const auto torn = [](const Level& level) { return level.shedding; };
        const std::array<Region, 4> regions{{{"runs down", "runs down", kDown, left, lower},
                                             {"still", "still", kStill, lower, upper},
                                             {"climbs", "climbs", kUp, upper, torn},
                                             {"torn off, We 7.5", "torn off", kTorn, torn, right}}};
        for (const Region& region : regions) {
            fill(plot, levels, region);
        }
        plot.gridLines(x, x_ticks, y, y_ticks, {255, 255, 255});
        const auto before_shedding = [](double Level::*edge, bool Level::*has) {
            return [=](const Level& level) { return level.*has && level.*edge <= level.shedding; };
        };
        drawEdge(plot, levels, &Level::lower, before_shedding(&Level::lower, &Level::has_lower));
        drawEdge(plot, levels, &Level::upper, before_shedding(&Level::upper, &Level::has_upper));
        drawEdge(plot, levels, &Level::shedding, [](const Level& level) { return level.has_shedding; });
        std::vector<double> verticals;
        if (options.measured) {
            plot.measured(x, *options.measured);
            verticals = {x.at(options.measured->from), x.at(options.measured->to)};
        }
        for (const Region& region : regions) {
            for (const Lettering& as : std::initializer_list<Lettering>{
                     {region.name, 10.5}, {region.name, kSmallLetters}, {region.short_name, kSmallLetters}}) {
                if (name(plot, levels, region, verticals, as)) {
                    break;
                }
            }
        }
        plot.axes(x, x_ticks, y, y_ticks);
        plot.headings(captionOf(swept, first), "volume, µL");
    }
    return drawing;
}

}  // namespace droplet

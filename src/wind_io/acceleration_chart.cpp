// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "droplet/render/paint.h"
#include "wind_io/plot.h"

namespace droplet {
namespace {

/// Colour of a curve: from light blue for the smallest droplet to dark blue for the largest.
Colour shade(std::size_t index, std::size_t count)
{
    constexpr std::array<std::array<double, 3>, 4> kRamp{
        {{108, 190, 214}, {58, 138, 196}, {48, 84, 160}, {38, 30, 92}}};
    const double at = count < 2 ? 1.5 : 3.0 * static_cast<double>(index) / static_cast<double>(count - 1);
    const auto k = std::min<std::size_t>(2, static_cast<std::size_t>(at));
    const double share = at - static_cast<double>(k);
    Colour colour{};
    for (std::size_t c = 0; c < 3; ++c) {
        colour[c] = static_cast<std::uint8_t>(std::lrint((1.0 - share) * kRamp[k][c] + share * kRamp[k + 1][c]));
    }
    return colour;
}

/// Points of a curve, also just below and above each threshold: the curve has corners there, and jumps if sliding
/// friction is less than retention.
std::vector<Vec2> curveOf(const TunnelCase& tunnel_case, const Scale& x, const Scale& y)
{
    constexpr int kParts = 160;
    std::vector<double> winds;
    for (int k = 0; k <= kParts; ++k) {
        winds.push_back(x.low + (x.high - x.low) * k / kParts);
    }
    for (const auto& threshold : {tunnel_case.thresholds.lower, tunnel_case.thresholds.upper}) {
        if (threshold) {
            for (const double beside : {1.0 - 1e-9, 1.0 + 1e-9}) {
                winds.push_back(std::clamp(*threshold * beside, x.low, x.high));
            }
        }
    }
    std::sort(winds.begin(), winds.end());
    std::vector<Vec2> points;
    points.reserve(winds.size());
    for (const double wind : winds) {
        points.push_back(
            {x.at(wind),
             y.at(acceleration(tunnel_case.forces, drivingForce(tunnel_case.forces, tunnel_case.slope, wind), 0.0))});
    }
    return points;
}

/// Moves heights apart to at least a pitch, within bounds and in their order.
std::vector<double> spreadOut(std::vector<double> wanted, double pitch, double top, double bottom)
{
    // Each pass pushes overlapping neighbours apart, and all back within the bounds.
    for (int pass = 0; pass < 200; ++pass) {
        for (std::size_t i = 1; i < wanted.size(); ++i) {
            const double overlap = pitch - (wanted[i - 1] - wanted[i]);
            if (overlap > 0.0) {
                wanted[i - 1] += 0.5 * overlap;
                wanted[i] -= 0.5 * overlap;
            }
        }
        for (double& at : wanted) {
            at = std::clamp(at, top, bottom);
        }
    }
    return wanted;
}

void drawCurves(Plot& plot, const Panel& panel, const Scale& x, const Scale& y)
{
    const std::size_t count = panel.cases.size();
    std::vector<double> ends;
    for (std::size_t v = 0; v < count; ++v) {
        const std::vector<Vec2> points = curveOf(*panel.cases[v], x, y);
        plot.line(points, shade(v, count), 2.2);
        ends.push_back(points.back().y);
    }
    // Names beside the ends of the curves; if there is no room for all, of every k-th curve.
    constexpr double kPitch = 15.0;
    const auto room = static_cast<std::size_t>((plot.bottom() - plot.top()) / kPitch);
    const std::size_t every = (count + room - 1) / room;
    std::vector<std::pair<double, std::size_t>> named;
    for (std::size_t v = 0; v < count; ++v) {
        if ((count - 1 - v) % every == 0) {
            named.emplace_back(ends[v], v);
        }
    }
    std::stable_sort(named.begin(), named.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<double> wanted;
    wanted.reserve(named.size());
    for (const auto& [at, v] : named) {
        wanted.push_back(at);
    }
    const std::vector<double> places = spreadOut(wanted, kPitch, plot.top(), plot.bottom());
    for (std::size_t i = 0; i < named.size(); ++i) {
        const std::size_t v = named[i].second;
        plot.line({{plot.right() + 3.0, named[i].first}, {plot.right() + 13.0, places[i]}}, shade(v, count), 1.2);
        plot.text({written(panel.cases[v]->cap.volume / kMicrolitre, 3) + " µL",
                   {plot.right() + 17.0, places[i] + 0.5 * kLetters},
                   kLetters,
                   shade(v, count)});
    }
}

}  // namespace

Drawing accelerationChart(const TunnelSweep& swept, const Tunnel& tunnel, const ChartOptions& options)
{
    Drawing drawing;
    const std::vector<Panel> panels = panelsOf(swept, tunnel, drawing);
    title(drawing, swept, options);
    const WindBand winds = windsOf(swept);
    double low = std::min(-1.0, options.min);
    double high = std::max(1.0, options.max);
    for (const TunnelCase& tunnel_case : tunnel.cases) {
        for (const double wind : {winds.from, winds.to}) {
            const double rate =
                acceleration(tunnel_case.forces, drivingForce(tunnel_case.forces, tunnel_case.slope, wind), 0.0);
            low = std::min(low, rate);
            high = std::max(high, rate);
        }
    }
    const double step = roundStep(high - low, 6.0);
    low = step * std::floor(low / step - 0.1);
    high = step * std::ceil(high / step + 0.1);
    for (const Panel& panel : panels) {
        Plot plot(drawing, panel, 66.0);
        const Scale x = plot.across(winds.from, winds.to);
        const Scale y = plot.up(low, high, false);
        const auto x_ticks = ticksOf(x, 8.0);
        const auto y_ticks = ticksOf(y, 6.0);
        // All layers together have the opacity 0.55.
        const double layer = 1.0 - std::pow(0.45, 1.0 / static_cast<double>(panel.cases.size()));
        for (const TunnelCase* tunnel_case : panel.cases) {
            const double from = std::clamp(tunnel_case->thresholds.lower.value_or(x.low), x.low, x.high);
            const double to = std::clamp(tunnel_case->thresholds.upper.value_or(x.high), x.low, x.high);
            plot.box(x.at(from), x.at(to), kStill, layer);
        }
        plot.gridLines(x, x_ticks, y, y_ticks, kGrid);
        plot.line({{plot.left(), y.at(0.0)}, {plot.right(), y.at(0.0)}}, kAxis, 1.2);
        if (options.measured) {
            plot.measured(x, *options.measured);
        }
        drawCurves(plot, panel, x, y);
        plot.axes(x, x_ticks, y, y_ticks);
        plot.headings(captionOf(swept, *panel.cases.front()), "acceleration up the slope, m/s²");
        const auto remark = [&](const char* words, double at) {
            plot.text({words, {plot.left() + 9.0, at}, kSmallLetters, kSoft, Anchor::Start, false, true});
        };
        remark("climbs", y.at(0.0) - 8.0);
        remark("runs down", y.from - 9.0);
    }
    return drawing;
}

}  // namespace droplet

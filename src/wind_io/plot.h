// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "droplet/picture/drawing.h"
#include "droplet/wind_io/chart.h"

namespace droplet {

// What the chart of accelerations and the map of regimes have in common.

inline constexpr Colour kInk{32, 38, 46};
inline constexpr Colour kSoft{98, 106, 116};
inline constexpr Colour kGrid{226, 229, 233};
inline constexpr Colour kAxis{120, 128, 138};
inline constexpr Colour kStill{233, 180, 76};

inline constexpr double kLetters = 8.5;
inline constexpr double kSmallLetters = 7.5;

/// A number with a minus, which a hyphen is not.
std::string written(double value, int digits);

/// Values on a page's axis.
struct Scale {
    double low = 0.0;
    double high = 1.0;
    double from = 0.0;  ///< where low lies on the page
    double to = 1.0;
    bool logarithmic = false;

    [[nodiscard]] double at(double value) const
    {
        const double share = logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
        return from + share * (to - from);
    }
};

struct Tick {
    double value = 0.0;
    std::string text;
};

/// Round numbers, so far apart that about so many parts lie between them.
std::vector<Tick> ticksOf(const Scale& scale, double parts);

/// The part of a chart that a slope and a hysteresis have.
struct Panel {
    std::vector<const TunnelCase*> cases;  ///< by volume
    Vec2 corner;                           ///< top left of its part of the page
};

/// A panel for every slope and hysteresis, in a grid, of several of both a row for each slope, on a drawing that
/// becomes as large as they need.
/// @throws Error  InvalidArgument: over kMaxPanels
std::vector<Panel> panelsOf(const TunnelSweep& swept, const Tunnel& tunnel, Drawing& drawing);

/// A panel's slope and hysteresis in words.
std::string captionOf(const TunnelSweep& swept, const TunnelCase& of);

/// The winds an axis shows.
WindBand windsOf(const TunnelSweep& swept);

/// Writes what the whole chart is of.
void title(Drawing& drawing, const TunnelSweep& swept, const ChartOptions& options);

/// A panel's plot, in a drawing.
class Plot {
public:
    /// @param right  room beside the plot, for names
    Plot(Drawing& drawing, const Panel& panel, double right);

    [[nodiscard]] Scale across(double low, double high) const { return {low, high, left_, right_, false}; }
    [[nodiscard]] Scale up(double low, double high, bool logarithmic) const
    {
        return {low, high, bottom_, top_, logarithmic};
    }
    [[nodiscard]] double left() const { return left_; }
    [[nodiscard]] double right() const { return right_; }
    [[nodiscard]] double top() const { return top_; }
    [[nodiscard]] double bottom() const { return bottom_; }

    void area(std::vector<Vec2> points, const Colour& colour, double opacity)
    {
        drawing_->marks.emplace_back(Area{std::move(points), colour, opacity});
    }
    void box(double from, double to, const Colour& colour, double opacity)
    {
        area({{from, top_}, {to, top_}, {to, bottom_}, {from, bottom_}}, colour, opacity);
    }
    void line(std::vector<Vec2> points, const Colour& colour, double width, double dash = 0.0)
    {
        drawing_->marks.emplace_back(Line{std::move(points), colour, width, dash});
    }
    void text(Text text) { drawing_->marks.emplace_back(std::move(text)); }

    /// Lines across the plot at the ticks.
    void rulers(const Scale& x, const std::vector<Tick>& x_ticks, const Scale& y, const std::vector<Tick>& y_ticks,
                const Colour& colour);
    /// The axes with their ticks and numbers.
    void axes(const Scale& x, const std::vector<Tick>& x_ticks, const Scale& y, const std::vector<Tick>& y_ticks);
    /// What stands above the plot.
    void heads(const std::string& caption, const std::string& ordinate);
    /// The measured band's edges, and what they are.
    void measured(const Scale& x, const WindBand& band);

private:
    Drawing* drawing_;
    double left_;
    double top_;
    double right_;
    double bottom_;
    Vec2 corner_;
};

}  // namespace droplet

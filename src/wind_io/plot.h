// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "droplet/drawing/drawing.h"
#include "droplet/wind_io/chart.h"

namespace droplet {

// Common parts of the acceleration chart and the regime map.

inline constexpr Colour kInk{32, 38, 46};
inline constexpr Colour kSoft{98, 106, 116};
inline constexpr Colour kGrid{226, 229, 233};
inline constexpr Colour kAxis{120, 128, 138};
inline constexpr Colour kStill{233, 180, 76};

inline constexpr double kLetters = 8.5;
inline constexpr double kSmallLetters = 7.5;

/// Text of a number, with a true minus sign instead of a hyphen.
std::string written(double value, int digits);

/// Scale of an axis.
struct Scale {
    double low = 0.0;
    double high = 1.0;
    double from = 0.0;  ///< coordinate of `low` on the page
    double to = 1.0;    ///< coordinate of `high` on the page
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

/// Ticks at round numbers, with about `parts` intervals.
std::vector<Tick> ticksOf(const Scale& scale, double parts);

/// Panel of a chart, for one slope and hysteresis.
struct Panel {
    std::vector<const TunnelCase*> cases;  ///< by volume
    Vec2 corner;                           ///< top left corner on the page
};

/// Lays out a panel for every slope and hysteresis in a grid, and sets the size of the drawing. If there are several of
/// both, each slope is a row.
/// @throws Error  InvalidArgument if there are more than kMaxPanels
std::vector<Panel> panelsOf(const TunnelSweep& swept, const Tunnel& tunnel, Drawing& drawing);

/// Text with a panel's slope and hysteresis.
std::string captionOf(const TunnelSweep& swept, const TunnelCase& tunnel_case);

/// Range of winds of an axis.
WindBand windsOf(const TunnelSweep& swept);

/// Draws the title of the chart.
void title(Drawing& drawing, const TunnelSweep& swept, const ChartOptions& options);

/// Plot of a panel, inside a drawing.
class Plot {
public:
    /// @param right  width of the space beside the plot, for names
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

    /// Draws grid lines at the ticks.
    void gridLines(const Scale& x, const std::vector<Tick>& x_ticks, const Scale& y, const std::vector<Tick>& y_ticks,
                   const Colour& colour);
    /// Draws the axes with their ticks and numbers.
    void axes(const Scale& x, const std::vector<Tick>& x_ticks, const Scale& y, const std::vector<Tick>& y_ticks);
    /// Draws the texts above the plot.
    void headings(const std::string& caption, const std::string& ordinate);
    /// Draws the edges of the measured band with their name.
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

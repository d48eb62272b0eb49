// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/wind_io/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/picture/paint.h"

namespace droplet {
namespace {

constexpr Colour kInk{32, 38, 46};
constexpr Colour kSoft{98, 106, 116};
constexpr Colour kGrid{226, 229, 233};
constexpr Colour kAxis{120, 128, 138};
constexpr Colour kStill{233, 180, 76};
constexpr Colour kMeasured{176, 58, 46};
constexpr Colour kDown{62, 124, 177};
constexpr Colour kUp{66, 153, 118};

constexpr double kPanelWidth = 560.0;
constexpr double kPanelHeight = 440.0;
constexpr double kGap = 28.0;     // between panels
constexpr double kMargin = 26.0;  // of the page
constexpr double kHead = 74.0;    // for the title
constexpr double kLetters = 8.5;
constexpr double kSmallLetters = 7.5;

std::string digits(const char* format, double value)
{
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), format, value == 0.0 ? 0.0 : value);
    // A hyphen is no minus.
    std::string number = text.data();
    return number.front() == '-' ? "−" + number.substr(1) : number;
}

std::string microlitres(double volume)
{
    return digits("%.3g", volume / kMicrolitre) + " µL";
}

/// Small droplets light, large ones deep: from one blue to another over the volumes' order.
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

std::vector<Tick> ticksOf(const Scale& scale, double parts)
{
    const double step = roundStep(scale.high - scale.low, parts);
    const int behind = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 9);
    const std::string format = "%." + std::to_string(behind) + "f";
    std::vector<Tick> ticks;
    const auto last = std::llround(std::floor(scale.high / step + 1e-6));
    for (auto k = std::llround(std::ceil(scale.low / step - 1e-6)); k <= last; ++k) {
        const double value = static_cast<double>(k) * step;
        ticks.push_back({value, digits(format.c_str(), value)});
    }
    return ticks;
}

/// Volumes in µL: 1, 2, 5, 10 …, or powers of ten where those would crowd.
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
                ticks.push_back({volume, digits("%.10g", value)});
            }
        }
    }
    return ticks;
}

struct Panel {
    std::vector<const TunnelCase*> cases;  ///< by volume
    Vec2 corner;                           ///< top left of its part of the page
};

/// A panel for every slope and hysteresis, in a grid.
std::vector<Panel> panelsOf(const TunnelSweep& swept, const Tunnel& tunnel, Drawing& drawing)
{
    const std::size_t volumes = swept.volumes.size();
    const std::size_t count = tunnel.cases.size() / volumes;
    if (count > kMostPanels) {
        throw Error(ErrorCode::InvalidArgument, "a chart of " + std::to_string(count) +
                                                    " slopes and hystereses is over the limit of " +
                                                    std::to_string(kMostPanels) + " panels");
    }
    const std::size_t columns = count < 2 ? 1 : count < 5 ? 2 : 3;
    const std::size_t rows = (count + columns - 1) / columns;
    drawing.width = 2.0 * kMargin + static_cast<double>(columns) * (kPanelWidth + kGap) - kGap;
    drawing.height = kHead + static_cast<double>(rows) * (kPanelHeight + kGap) - kGap + kMargin;
    std::vector<Panel> panels(count);
    for (std::size_t p = 0; p < count; ++p) {
        Panel& panel = panels[p];
        for (std::size_t v = 0; v < volumes; ++v) {
            panel.cases.push_back(&tunnel.cases[p * volumes + v]);
        }
        std::stable_sort(panel.cases.begin(), panel.cases.end(),
                         [](const TunnelCase* a, const TunnelCase* b) { return a->cap.volume < b->cap.volume; });
        const std::size_t row = p / columns;
        panel.corner = {kMargin + static_cast<double>(p % columns) * (kPanelWidth + kGap),
                        kHead + static_cast<double>(row) * (kPanelHeight + kGap)};
    }
    return panels;
}

std::string captionOf(const TunnelSweep& swept, const TunnelCase& of)
{
    std::string text = "slope " + digits("%.4g", of.slope / kDegree) + "°, ";
    if (const auto& falling_angle = swept.model.wetting.falling_angle) {
        return text + "falling angle " + digits("%.4g", *falling_angle / kDegree) + "°";
    }
    return text + "hysteresis " + digits("%.3g", of.hysteresis);
}

WindBand windsOf(const TunnelSweep& swept)
{
    const auto [least, most] = std::minmax_element(swept.winds.begin(), swept.winds.end());
    // One wind alone makes no axis.
    return *most - *least > 1e-3 ? WindBand{*least, *most} : WindBand{0.0, std::max(16.0, 1.25 * *most)};
}

class Plot {
public:
    Plot(Drawing& drawing, const Panel& panel, double right)
        : drawing_(&drawing),
          left_(panel.corner.x + 44.0),
          top_(panel.corner.y + 40.0),
          right_(panel.corner.x + kPanelWidth - right),
          bottom_(panel.corner.y + kPanelHeight - 40.0),
          corner_(panel.corner)
    {
    }

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

    void rulers(const Scale& x, const std::vector<Tick>& x_ticks, const Scale& y, const std::vector<Tick>& y_ticks,
                const Colour& colour)
    {
        for (const Tick& tick : x_ticks) {
            line({{x.at(tick.value), top_}, {x.at(tick.value), bottom_}}, colour, 1.0);
        }
        for (const Tick& tick : y_ticks) {
            line({{left_, y.at(tick.value)}, {right_, y.at(tick.value)}}, colour, 1.0);
        }
    }

    void axes(const Scale& x, const std::vector<Tick>& x_ticks, const Scale& y, const std::vector<Tick>& y_ticks)
    {
        line({{left_, bottom_}, {right_, bottom_}}, kAxis, 1.2);
        line({{left_, top_}, {left_, bottom_}}, kAxis, 1.2);
        for (const Tick& tick : x_ticks) {
            line({{x.at(tick.value), bottom_}, {x.at(tick.value), bottom_ + 4.0}}, kAxis, 1.2);
            text({tick.text, {x.at(tick.value), bottom_ + 17.0}, kLetters, kInk, Anchor::Middle});
        }
        for (const Tick& tick : y_ticks) {
            line({{left_ - 4.0, y.at(tick.value)}, {left_, y.at(tick.value)}}, kAxis, 1.2);
            text({tick.text, {left_ - 9.0, y.at(tick.value) + 0.5 * kLetters}, kLetters, kInk, Anchor::End});
        }
        text({"wind along the slope, m/s", {right_, bottom_ + 35.0}, kLetters, kSoft, Anchor::End});
    }

    void heads(const std::string& caption, const std::string& ordinate)
    {
        text({caption, {left_ - 35.0, corner_.y + 10.0}, 9.5, kInk, Anchor::Start, true});
        text({ordinate, {left_ - 35.0, corner_.y + 29.0}, kLetters, kSoft});
    }

    /// The measured band's edges, and what they are.
    void measured(const Scale& x, const WindBand& band)
    {
        bool is_named = false;
        for (const double wind : {band.from, band.to}) {
            if (wind >= x.low && wind <= x.high) {
                line({{x.at(wind), top_}, {x.at(wind), bottom_}}, kMeasured, 1.3, 5.0);
                if (!is_named) {
                    text({"measured still " + digits("%.3g", band.from) + "–" + digits("%.3g", band.to) + " m/s",
                          {x.at(wind) - 6.0, top_ + 13.0},
                          kSmallLetters,
                          kMeasured,
                          Anchor::End,
                          false,
                          true});
                }
                is_named = true;
            }
        }
    }

private:
    Drawing* drawing_;
    double left_;
    double top_;
    double right_;
    double bottom_;
    Vec2 corner_;
};

void title(Drawing& drawing, const TunnelSweep& swept, const ChartOptions& options)
{
    drawing.marks.emplace_back(Text{options.title, {kMargin + 9.0, 30.0}, 12.5, kInk, Anchor::Start, true});
    const ForceModel& model = swept.model;
    const std::string about = model.liquid.name + ", contact angle " +
                              digits("%.4g", model.wetting.contact_angle / kDegree) + "°, boundary layer " +
                              digits("%.3g", model.air.boundary_layer / kMillimetre) + " mm";
    drawing.marks.emplace_back(Text{about, {kMargin + 9.0, 50.0}, kLetters, kSoft});
}

/// Acceleration at rest just above or below a threshold and between them: what a curve needs to show its corners, and
/// its jumps where less than all friction is left in motion.
std::vector<Vec2> curveOf(const TunnelCase& of, const Scale& x, const Scale& y)
{
    constexpr int kParts = 160;
    std::vector<double> winds;
    for (int k = 0; k <= kParts; ++k) {
        winds.push_back(x.low + (x.high - x.low) * k / kParts);
    }
    for (const auto& threshold : {of.thresholds.lower, of.thresholds.upper}) {
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
        points.push_back({x.at(wind), y.at(acceleration(of.forces, drivingForce(of.forces, of.slope, wind), 0.0))});
    }
    return points;
}

/// Heights near to those wished for, in their order, a pitch apart and within bounds.
std::vector<double> spreadOut(std::vector<double> wished, double pitch, double top, double bottom)
{
    // From the bottom up they are pushed apart, and from the top down pushed back.
    for (int pass = 0; pass < 200; ++pass) {
        for (std::size_t i = 1; i < wished.size(); ++i) {
            const double overlap = pitch - (wished[i - 1] - wished[i]);
            if (overlap > 0.0) {
                wished[i - 1] += 0.5 * overlap;
                wished[i] -= 0.5 * overlap;
            }
        }
        for (double& at : wished) {
            at = std::clamp(at, top, bottom);
        }
    }
    return wished;
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
    // Names beside the curves' ends: those of every so many if there is no room for all.
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
    std::vector<double> wished;
    wished.reserve(named.size());
    for (const auto& [at, v] : named) {
        wished.push_back(at);
    }
    const std::vector<double> places = spreadOut(wished, kPitch, plot.top(), plot.bottom());
    for (std::size_t i = 0; i < named.size(); ++i) {
        const std::size_t v = named[i].second;
        plot.line({{plot.right() + 3.0, named[i].first}, {plot.right() + 13.0, places[i]}}, shade(v, count), 1.2);
        plot.text({microlitres(panel.cases[v]->cap.volume),
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
    double low = std::min(-1.0, options.least);
    double high = std::max(1.0, options.most);
    for (const TunnelCase& of : tunnel.cases) {
        for (const double wind : {winds.from, winds.to}) {
            const double rate = acceleration(of.forces, drivingForce(of.forces, of.slope, wind), 0.0);
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
        // Of many layers together what one of this opacity is.
        const double layer = 1.0 - std::pow(0.45, 1.0 / static_cast<double>(panel.cases.size()));
        for (const TunnelCase* of : panel.cases) {
            const double from = std::clamp(of->thresholds.lower.value_or(x.low), x.low, x.high);
            const double to = std::clamp(of->thresholds.upper.value_or(x.high), x.low, x.high);
            plot.box(x.at(from), x.at(to), kStill, layer);
        }
        plot.rulers(x, x_ticks, y, y_ticks, kGrid);
        plot.line({{plot.left(), y.at(0.0)}, {plot.right(), y.at(0.0)}}, kAxis, 1.2);
        if (options.measured) {
            plot.measured(x, *options.measured);
        }
        drawCurves(plot, panel, x, y);
        plot.axes(x, x_ticks, y, y_ticks);
        plot.heads(captionOf(swept, *panel.cases.front()), "acceleration up the slope, m/s²");
        const auto remark = [&](const char* words, double at) {
            plot.text({words, {plot.left() + 9.0, at}, kSmallLetters, kSoft, Anchor::Start, false, true});
        };
        remark("climbs", y.at(0.0) - 8.0);
        remark("runs down", y.from - 9.0);
    }
    return drawing;
}

namespace {

/// What the map shows of one volume, on the page.
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
    // Corners: where edges meet the page's, and where they bend at the boundary layer's edge.
    for (const double wind : {x.low, x.high}) {
        for (const RegimeChange& change : regimeChanges(model, {slope, wind}, {y.low, y.high})) {
            // A root's last digit may lie on either side.
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
        const auto shedding = sheddingWind(model, cap);
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

/// What is between two edges, and what it is called.
struct Region {
    const char* name;
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

/// Its name, near the middle of where it is widest, clear of upright lines and of the one of shedding.
void name(Plot& plot, const std::vector<Level>& levels, const Region& region, const std::vector<double>& uprights)
{
    constexpr double kHalfWord = 47.0;
    constexpr double kHalfLine = 10.0;
    const auto width = [&](const Level& level) { return region.to(level) - region.from(level); };
    double widest = 0.0;
    for (const Level& level : levels) {
        widest = std::max(widest, width(level));
    }
    if (widest < 2.0 * kHalfWord) {
        return;
    }
    // Half the heights at which it is nearly as wide lie above the middle.
    std::vector<double> heights;
    for (const Level& level : levels) {
        if (width(level) > 0.75 * widest) {
            heights.push_back(level.y);
        }
    }
    const double middle = heights[heights.size() / 2];
    std::optional<Vec2> best;
    double least = std::numeric_limits<double>::infinity();
    for (const Level& level : levels) {
        const double first = region.from(level) + kHalfWord;
        const double last = region.to(level) - kHalfWord;
        for (int k = 0; first + 6.0 * k <= last; ++k) {
            const double x = first + 6.0 * k;
            const bool fits = level.y > plot.top() + 46.0 && level.y < plot.bottom() - 14.0;
            const auto clear = [&](double line) { return std::abs(line - x) > kHalfWord; };
            const bool is_clear = std::all_of(uprights.begin(), uprights.end(), clear) &&
                                  std::all_of(levels.begin(), levels.end(), [&](const Level& other) {
                                      return std::abs(other.y - level.y) > kHalfLine ||
                                             ((!other.has_shedding || clear(other.shedding)) &&
                                              x - kHalfWord > region.from(other) && x + kHalfWord < region.to(other));
                                  });
            const double off = std::hypot(x - 0.5 * (region.from(level) + region.to(level)), level.y - middle);
            if (fits && is_clear && off < least) {
                least = off;
                best = Vec2{x, level.y};
            }
        }
    }
    if (best) {
        Colour deep{};
        for (std::size_t c = 0; c < 3; ++c) {
            deep[c] = static_cast<std::uint8_t>(region.colour[c] * 0.62);
        }
        plot.text({region.name, *best + Vec2{0.0, 5.0}, 10.5, deep, Anchor::Middle, true});
    }
}

/// The wind that would tear droplets off, as far as it is on the map.
void drawShedding(Plot& plot, const std::vector<Level>& levels, bool is_below)
{
    std::vector<Vec2> line;
    for (const Level& level : levels) {
        if (level.has_shedding) {
            line.push_back({level.shedding, level.y});
        }
    }
    if (line.size() > 1) {
        plot.line(line, kSoft, 1.2, 3.5);
        // Beside its upper end, above the regimes' names and below that of the measured band.
        constexpr double kName = 100.0;
        constexpr double kRow = 16.0;
        const double y = plot.top() + 13.0 + (is_below ? kRow : 0.0);
        const auto at = std::min_element(line.begin(), line.end(), [&](const Vec2& a, const Vec2& b) {
            return std::abs(a.y - y) < std::abs(b.y - y);
        });
        const bool is_right = at->x + kName > plot.right();
        plot.text({"torn off, We 7.5",
                   {at->x + (is_right ? -10.0 : 10.0), at->y},
                   kSmallLetters,
                   kSoft,
                   is_right ? Anchor::End : Anchor::Start});
    }
}

VolumeRange volumesOf(const TunnelSweep& swept, const TunnelCase& of)
{
    // To twice the largest, and down to droplets too small to run, over two decades at least and four at most.
    const auto [least, most] = std::minmax_element(swept.volumes.begin(), swept.volumes.end());
    const double high = 2.0 * *most;
    double low = std::min(0.5 * *least, 1e-2 * high);
    if (of.critical_volume) {
        low = std::min(low, std::max(0.3 * *of.critical_volume, 1e-4 * high));
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
        if (!model.wetting.falling_angle) {
            model.wetting.hysteresis = first.hysteresis;
        }
        Plot plot(drawing, panel, 20.0);
        const VolumeRange volumes = volumesOf(swept, first);
        const Scale x = plot.across(winds.from, winds.to);
        const Scale y = plot.up(volumes.from, volumes.to, true);
        const auto x_ticks = ticksOf(x, 8.0);
        const auto y_ticks = volumeTicks(y);
        const std::vector<Level> levels = levelsOf(model, first.slope, x, y);
        const auto left = [&](const Level&) { return plot.left(); };
        const auto right = [&](const Level&) { return plot.right(); };
        const auto lower = [](const Level& level) { return level.lower; };
        const auto upper = [](const Level& level) { return level.upper; };
        const std::array<Region, 3> regions{
            {{"runs down", kDown, left, lower}, {"still", kStill, lower, upper}, {"climbs", kUp, upper, right}}};
        for (const Region& region : regions) {
            fill(plot, levels, region);
        }
        plot.rulers(x, x_ticks, y, y_ticks, {255, 255, 255});
        const auto draw_edge = [&](double Level::*edge, bool Level::*has) {
            std::vector<Vec2> line;
            for (const Level& level : levels) {
                if (level.*has) {
                    line.push_back({level.*edge, level.y});
                }
            }
            if (line.size() > 1) {
                plot.line(line, kInk, 1.8);
            }
        };
        draw_edge(&Level::lower, &Level::has_lower);
        draw_edge(&Level::upper, &Level::has_upper);
        drawShedding(plot, levels, options.measured.has_value());
        std::vector<double> uprights;
        if (options.measured) {
            plot.measured(x, *options.measured);
            uprights = {x.at(options.measured->from), x.at(options.measured->to)};
        }
        for (const Region& region : regions) {
            name(plot, levels, region, uprights);
        }
        plot.axes(x, x_ticks, y, y_ticks);
        plot.heads(captionOf(swept, first), "volume, µL");
    }
    return drawing;
}

}  // namespace droplet

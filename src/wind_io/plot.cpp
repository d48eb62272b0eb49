// SPDX-License-Identifier: GPL-3.0-or-later
#include "wind_io/plot.h"

#include <algorithm>
#include <cmath>

#include "droplet/error.h"
#include "droplet/render/paint.h"
#include "number_text.h"

namespace droplet {
namespace {

constexpr Colour kMeasured{176, 58, 46};

constexpr double kPanelWidth = 560.0;
constexpr double kPanelHeight = 440.0;
constexpr double kGap = 28.0;     // space between panels
constexpr double kMargin = 26.0;  // margin of the page
constexpr double kHead = 74.0;    // height of the title

std::string withMinus(const std::string& number)
{
    return number.front() == '-' ? "−" + number.substr(1) : number;
}

}  // namespace

std::string written(double value, int digits)
{
    return withMinus(numberText(value, digits));
}

std::vector<Tick> ticksOf(const Scale& scale, double parts)
{
    const double step = roundStep(scale.high - scale.low, parts);
    const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 9);
    std::vector<Tick> ticks;
    const auto last = std::llround(std::floor(scale.high / step + 1e-6));
    for (auto k = std::llround(std::ceil(scale.low / step - 1e-6)); k <= last; ++k) {
        const double value = static_cast<double>(k) * step;
        ticks.push_back({value, withMinus(fmt::format("{:.{}f}", value + 0.0, decimals))});
    }
    return ticks;
}

std::vector<Panel> panelsOf(const TunnelSweep& swept, const Tunnel& tunnel, Drawing& drawing)
{
    const std::size_t volumes = swept.volumes.size();
    const std::size_t count = tunnel.cases.size() / volumes;
    if (count > kMaxPanels) {
        throw Error(
            ErrorCode::InvalidArgument,
            fmt::format("a chart of {} pairs of slope and hysteresis is too large; at most {} panels are allowed",
                        count, kMaxPanels));
    }
    // With many slopes and many hystereses each slope has its own row.
    const std::size_t slopes = swept.slopes.size();
    const bool is_table = slopes > 1 && count > slopes;
    const std::size_t columns = is_table ? count / slopes : count < 2 ? 1 : count < 5 ? 2 : 3;
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
        const std::size_t row = is_table ? p % slopes : p / columns;
        const std::size_t column = is_table ? p / slopes : p % columns;
        panel.corner = {kMargin + static_cast<double>(column) * (kPanelWidth + kGap),
                        kHead + static_cast<double>(row) * (kPanelHeight + kGap)};
    }
    return panels;
}

std::string captionOf(const TunnelSweep& swept, const TunnelCase& tunnel_case)
{
    std::string text = "slope " + written(tunnel_case.slope / kDegree, 4) + "°, ";
    if (const auto& sliding_angle = swept.model.wetting.sliding_angle) {
        return text + "sliding angle " + written(*sliding_angle / kDegree, 4) + "°";
    }
    return text + "hysteresis " + written(tunnel_case.hysteresis, 3);
}

WindBand windsOf(const TunnelSweep& swept)
{
    const auto [min, max] = std::minmax_element(swept.winds.begin(), swept.winds.end());
    // A single wind gives no axis.
    return *max - *min > 1e-3 ? WindBand{*min, *max} : WindBand{0.0, std::max(16.0, 1.25 * *max)};
}

void title(Drawing& drawing, const TunnelSweep& swept, const ChartOptions& options)
{
    drawing.marks.emplace_back(Text{options.title, {kMargin + 9.0, 30.0}, 12.5, kInk, Anchor::Start, true});
    const ForceModel& model = swept.model;
    const std::string about = model.liquid.name + ", contact angle " +
                              written(model.wetting.contact_angle / kDegree, 4) + "°, boundary layer " +
                              written(model.air.boundary_layer / kMillimetre, 3) + " mm";
    drawing.marks.emplace_back(Text{about, {kMargin + 9.0, 50.0}, kLetters, kSoft});
}

Plot::Plot(Drawing& drawing, const Panel& panel, double right)
    : drawing_(&drawing),
      left_(panel.corner.x + 44.0),
      top_(panel.corner.y + 40.0),
      right_(panel.corner.x + kPanelWidth - right),
      bottom_(panel.corner.y + kPanelHeight - 40.0),
      corner_(panel.corner)
{
}

void Plot::gridLines(const Scale& x, const std::vector<Tick>& x_ticks, const Scale& y, const std::vector<Tick>& y_ticks,
                     const Colour& colour)
{
    for (const Tick& tick : x_ticks) {
        line({{x.at(tick.value), top_}, {x.at(tick.value), bottom_}}, colour, 1.0);
    }
    for (const Tick& tick : y_ticks) {
        line({{left_, y.at(tick.value)}, {right_, y.at(tick.value)}}, colour, 1.0);
    }
}

void Plot::axes(const Scale& x, const std::vector<Tick>& x_ticks, const Scale& y, const std::vector<Tick>& y_ticks)
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

void Plot::headings(const std::string& caption, const std::string& ordinate)
{
    text({caption, {left_ - 35.0, corner_.y + 10.0}, 9.5, kInk, Anchor::Start, true});
    text({ordinate, {left_ - 35.0, corner_.y + 29.0}, kLetters, kSoft});
}

void Plot::measured(const Scale& x, const WindBand& band)
{
    bool is_named = false;
    for (const double wind : {band.from, band.to}) {
        if (wind >= x.low && wind <= x.high) {
            line({{x.at(wind), top_}, {x.at(wind), bottom_}}, kMeasured, 1.3, 5.0);
            if (!is_named) {
                text({"measured still " + written(band.from, 3) + "–" + written(band.to, 3) + " m/s",
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

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
// Time of the driver's view, without encoding, as a table in Markdown:
//
//   bench_view
//
// Frames of 1280 x 720 pixels of figure 3.12, after rain of 200 000 still droplets. 1000 larger droplets are left in
// view, and the rain continues, at 60 frames per second. The background is one picture for all frames, a new one for
// every frame, or the built-in road, which is painted for every frame. The simulation's step is not counted. Processor
// time is the sum over all threads; on a busy machine it is more reliable than wall time.
#include "droplet/windshield_view/view.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <exception>
#include <utility>
#include <vector>

#include "droplet/windshield/presets.h"
#include "droplet/windshield/wipers.h"

namespace {

using namespace droplet;

constexpr int kFrames = 61;
constexpr double kStep = 1.0 / 60.0;

double now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Processor time of all threads [s].
double processorTime()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Box around the visible part of the glass.
std::pair<Vec2, Vec2> seenBox(const DriversView& view, const ViewOptions& options)
{
    Vec2 low{1e9, 1e9};
    Vec2 high{-1e9, -1e9};
    for (const int x : {0, options.width / 2, options.width - 1}) {
        for (const int y : {0, options.height - 1}) {
            if (const auto place = view.onGlass(x, y)) {
                low = {std::min(low.x, place->x), std::min(low.y, place->y)};
                high = {std::max(high.x, place->x), std::max(high.y, place->y)};
            }
        }
    }
    return {low, high};
}

/// State after rain of `still` still droplets, with only `running` of the larger droplets in view.
WindshieldState stateAfterRain(const WindshieldParameters& parameters, std::size_t running, std::size_t still,
                               const std::pair<Vec2, Vec2>& box)
{
    WindshieldState state = startWindshield(parameters);
    while (state.still.count() < still) {
        state = step(std::move(state), parameters, kStep);
    }
    std::vector<RunningDroplet> in_view;
    for (const RunningDroplet& droplet : state.droplets) {
        const Vec2 p = droplet.position;
        if (p.x > box.first.x && p.x < box.second.x && p.y > box.first.y && p.y < box.second.y) {
            in_view.push_back(droplet);
        }
    }
    state.droplets.clear();
    for (std::size_t k = 0; k < running; ++k) {  // evenly by age, and so by size
        state.droplets.push_back(in_view[k * in_view.size() / running]);
    }
    return state;
}

double medianOf(std::vector<double> values)
{
    std::nth_element(values.begin(), values.begin() + kFrames / 2, values.end());
    return values[kFrames / 2];
}

enum class Background { Still, Changing, Road };

struct Case {
    std::size_t threads = 1;
    Background background = Background::Still;
    int samples = 2;
    bool wipes = false;
};

void timeFrames(WindshieldParameters parameters, const WindshieldState& begin_state, const Case& c)
{
    const auto [threads, background, samples, wipes] = c;
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    ViewOptions options;
    options.samples = samples;
    if (wipes) {
        parameters.wipers = tandemWipers(parameters.glass, 1.2);
        for (Wiper& wiper : parameters.wipers) {
            wiper.start = begin_state.time;
        }
        options.wipers = parameters.wipers;
    }
    options.shape.contact_angle = parameters.forces.wetting.contact_angle;
    DriversView view(parameters.glass, options);
    const DefaultBackground road(options);
    const std::vector<Picture> roads{road.at(0.0), road.at(2.0)};
    WindshieldState state = begin_state;
    view.setBackground(roads[0]);
    view.show(state);
    std::vector<double> look;
    std::vector<double> show;
    std::vector<double> frame;
    std::vector<double> all;
    std::vector<double> processor;
    for (std::size_t k = 0; k < kFrames; ++k) {
        state = step(std::move(state), parameters, kStep);
        const double processor_begin = processorTime();
        const double begin = now();
        if (background == Background::Changing) {
            view.setBackground(roads[k % 2]);
        } else if (background == Background::Road) {
            view.setBackground(road.at(15.0 * kStep * static_cast<double>(k)));
        }
        const double looked = now();
        view.show(state);
        const double shown = now();
        const Picture picture = view.frame();
        const double end = now();
        look.push_back(looked - begin);
        show.push_back(shown - looked);
        frame.push_back(end - shown);
        all.push_back(end - begin);
        processor.push_back(processorTime() - processor_begin);
    }
    std::printf("| %zu | %d x %d | %s%s | %.1f ms | %.1f ms | %.1f ms | %.1f ms | %.1f ms | %.0f |\n", threads, samples,
                samples,
                background == Background::Still      ? "one for all frames"
                : background == Background::Changing ? "a new one per frame"
                                                     : "the built-in road",
                wipes ? ", wipers" : "", 1e3 * medianOf(look), 1e3 * medianOf(show), 1e3 * medianOf(frame),
                1e3 * medianOf(processor), 1e3 * medianOf(all), 1.0 / medianOf(all));
    std::fflush(stdout);
}

}  // namespace

int main()
{
    try {
        const WindshieldParameters parameters = windshieldPresetNamed("figure-3.12").parameters;
        const ViewOptions options;
        const WindshieldState state =
            stateAfterRain(parameters, 1000, 200'000, seenBox(DriversView(parameters.glass, options), options));
        std::puts(
            "| threads | rays per pixel | background | background and levels | changed water | light | processor | "
            "frame "
            "| "
            "frames/s |");
        std::puts("| ---: | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: |");
        for (const std::size_t threads : {1U, 2U}) {
            for (const Background background : {Background::Still, Background::Changing, Background::Road}) {
                timeFrames(parameters, state, {threads, background});
            }
        }
        timeFrames(parameters, state, {2, Background::Changing, 1});
        for (const std::size_t threads : {1U, 2U}) {
            timeFrames(parameters, state, {threads, Background::Still, 2, true});
        }
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_view: %s\n", error.what());
        return 1;
    }
}

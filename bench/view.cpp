// SPDX-License-Identifier: GPL-3.0-or-later
// How long the driver's view takes, without encoding, as a table in Markdown:
//
//   bench_view
//
// Frames of 1280 x 720 pixels of the default glass with 200 000 still droplets and as many larger ones on it that 1000
// of them are in view, all of them moving from frame to frame in the rain; behind it a picture that stays, or a new one
// for every frame. The step of the simulation is not counted.
#include "droplet/wind/view.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <random>
#include <utility>
#include <vector>

#include "droplet/picture/evening_road.h"

namespace {

using namespace droplet;

constexpr int kFrames = 61;
constexpr double kStep = 1.0 / 60.0;

double now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double uniform(std::mt19937_64& bits)
{
    return static_cast<double>(bits() >> 11U) * 0x1p-53;
}

/// The part of the glass that is seen, as a box.
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

/// Still droplets all over the glass, larger ones of 1 to 30 µL where they are seen.
WindshieldState scattered(const WindshieldParameters& parameters, std::size_t running, std::size_t still,
                          const std::pair<Vec2, Vec2>& box)
{
    std::mt19937_64 bits(1);
    WindshieldState state = startWindshield(parameters);
    for (std::size_t k = 0; k < running; ++k) {
        const Vec2 place{box.first.x + (box.second.x - box.first.x) * uniform(bits),
                         box.first.y + (box.second.y - box.first.y) * uniform(bits)};
        state.droplets.push_back(
            {state.next_id++, place, {0.0, 0.3 * uniform(bits)}, std::pow(30.0, uniform(bits)) * 1e-9, 0.0, 0});
    }
    StillDroplets& s = state.still;
    for (std::size_t k = 0; k < still;) {
        const Vec2 place{parameters.glass.width() * uniform(bits), parameters.glass.height() * uniform(bits)};
        const std::size_t number =
            static_cast<std::size_t>(place.y / s.cell) * s.columns + static_cast<std::size_t>(place.x / s.cell);
        if (s.counts[number] < StillDroplets::kMost) {
            s.slots[number * StillDroplets::kMost + s.counts[number]++] = {place, (0.01 + 0.2 * uniform(bits)) * 1e-9};
            ++k;
        }
    }
    return state;
}

/// The next frame's droplets: all larger ones a little farther, and still ones come and gone along their way.
void goOn(WindshieldState& state, const std::pair<Vec2, Vec2>& box)
{
    StillDroplets& s = state.still;
    for (RunningDroplet& droplet : state.droplets) {
        droplet.position.y += kStep * droplet.velocity.y;
        if (droplet.position.y > box.second.y) {
            droplet.position.y = box.first.y;
        }
        const std::size_t number = static_cast<std::size_t>(droplet.position.y / s.cell) * s.columns +
                                   static_cast<std::size_t>(droplet.position.x / s.cell);
        if (s.counts[number] > 0) {
            s.slots[number * StillDroplets::kMost].volume *= 1.01;
            ++s.revisions[number];
        }
    }
}

double medianOf(std::vector<double> values)
{
    std::nth_element(values.begin(), values.begin() + kFrames / 2, values.end());
    return values[kFrames / 2];
}

void timeFrames(std::size_t threads, bool moving, int samples)
{
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const WindshieldParameters parameters = windshieldPresetNamed("figure-3.12").parameters;
    ViewOptions options;
    options.samples = samples;
    DriversView view(parameters.glass, options);
    const std::vector<Picture> roads{eveningRoad(), eveningRoad({.travelled = 2.0})};
    const auto box = seenBox(view, options);
    WindshieldState state = scattered(parameters, 1000, 200'000, box);
    view.lookAt(roads[0]);
    view.show(state);
    std::vector<double> look;
    std::vector<double> show;
    std::vector<double> frame;
    std::vector<double> all;
    for (std::size_t k = 0; k < kFrames; ++k) {
        goOn(state, box);
        const double begin = now();
        if (moving) {
            view.lookAt(roads[k % 2]);
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
    }
    std::printf("| %zu | %d x %d | %s | %.1f ms | %.1f ms | %.1f ms | %.1f ms | %.0f |\n", threads, samples, samples,
                moving ? "a new one each frame" : "stays", 1e3 * medianOf(look), 1e3 * medianOf(show),
                1e3 * medianOf(frame), 1e3 * medianOf(all), 1.0 / medianOf(all));
    std::fflush(stdout);
}

}  // namespace

int main()
{
    try {
        std::puts("| threads | rays a pixel | picture behind | its levels | what changed | light | frame | frames/s |");
        std::puts("| ---: | ---: | --- | ---: | ---: | ---: | ---: | ---: |");
        for (const std::size_t threads : {1U, 2U}) {
            for (const bool moving : {false, true}) {
                timeFrames(threads, moving, 2);
            }
        }
        timeFrames(2, true, 1);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_view: %s\n", error.what());
        return 1;
    }
}

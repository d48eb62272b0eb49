// SPDX-License-Identifier: GPL-3.0-or-later
// Times of the windshield's steps, as tables in Markdown:
//
//   bench_windshield [--hour=SECONDS]
//
// 1. The default glass with 2000 moving droplets, alone and among 200 000 still ones, dry and in the rain.
// 2. Larger and larger glasses with the same number of droplets per area: time per droplet.
// 3. Maps for a renderer that runs along, and for files, one core: the thesis' scale, and heavy rain with wipers.
// 4. Frames of 1280 x 720 pixels of the thesis' figures and of heavy rain, with wipers, one core: every part of them.
//    What wipers add is told in time on two cores, too.
// 5. An hour, or SECONDS, of rain at 25 mm/h: water balance and number of droplets.
#include "droplet/windshield/windshield.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <optional>
#include <ostream>
#include <random>
#include <streambuf>
#include <utility>
#include <vector>

#include "droplet/drawing/picture.h"
#include "droplet/windshield/presets.h"
#include "droplet/windshield/wipers.h"
#include "droplet/windshield_view/glass_maps.h"
#include "droplet/windshield_view/view.h"
#include "droplet/windshield_view/windshield_maps.h"
#include "memory.h"
#include "windshield/still_droplets.h"

namespace {

using namespace droplet;

constexpr double kStep = 1.0 / 60.0;
constexpr int kSettling = 5;
constexpr int kSteps = 31;

double now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Processor time that work takes, of all threads [s]: on a busy machine it is more reliable than wall time.
template <typename Work>
double timeOf(const Work& work)
{
    const std::clock_t begin = std::clock();
    work();
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

double medianOf(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double uniform(std::mt19937_64& bits)
{
    return static_cast<double>(bits() >> 11U) * 0x1p-53;
}

/// Slippery glass and a strong wind, so that all droplets run.
WindshieldParameters slippery(const Glass::Cylinder& form)
{
    WindshieldParameters p = windshieldPresetNamed("figure-3.12").parameters;
    p.glass = Glass(form);
    p.forces.wetting.hysteresis = 0.02;
    p.rainfall = 0.0;
    return p;
}

/// Running droplets of 2 to 12 µL and still ones of 0.02 to 0.4 µL, scattered evenly.
WindshieldState scattered(const WindshieldParameters& p, std::size_t running, std::size_t still)
{
    std::mt19937_64 bits(1);
    WindshieldState state = startWindshield(p);
    const Vec2 size{p.glass.width(), p.glass.height()};
    // Each droplet has a random position in its own cell of a lattice, so that none overlap.
    const auto columns = static_cast<std::size_t>(std::sqrt(static_cast<double>(running) * size.x / size.y));
    const double cell = size.x / static_cast<double>(columns);
    for (std::size_t k = 0; k < running; ++k) {
        const Vec2 place{(static_cast<double>(k % columns) + 0.3 + 0.4 * uniform(bits)) * cell,
                         (static_cast<double>(k / columns) + 0.3 + 0.4 * uniform(bits)) * cell};
        if (!p.glass.holds(place)) {
            continue;
        }
        state.droplets.push_back({state.next_id++, place, {0.0, 0.05}, (2.0 + 10.0 * uniform(bits)) * 1e-9, 0.0, 0});
        state.rained.add(state.droplets.back().volume);
    }
    StillCells& s = StillCells::of(state.still);
    for (std::size_t k = 0; k < still; ++k) {
        const Vec2 place{size.x * uniform(bits), size.y * uniform(bits)};
        const std::size_t number =
            static_cast<std::size_t>(place.y / s.cell) * s.columns + static_cast<std::size_t>(place.x / s.cell);
        if (s.counts[number] < StillCells::kMax) {
            const double volume = (0.02 + 0.38 * uniform(bits)) * 1e-9;
            s.put(number, {place, volume});
            state.rained.add(volume);
        }
    }
    return state;
}

struct Timing {
    double step = 0.0;      // median time of a step [s]
    double droplet = 0.0;   // median time of a step per droplet [s]
    double droplets = 0.0;  // mean number of running droplets
    double moving = 0.0;    // mean number of moving droplets
};

Timing time(WindshieldState state, const WindshieldParameters& p)
{
    for (int k = 0; k < kSettling; ++k) {  // running droplets absorb the still ones below them
        state = step(std::move(state), p, kStep);
    }
    std::vector<double> steps;
    std::vector<double> each;
    Timing timing;
    for (int k = 0; k < kSteps; ++k) {
        const auto count = static_cast<double>(state.droplets.size());
        const double begin = now();
        state = step(std::move(state), p, kStep);
        steps.push_back(now() - begin);
        each.push_back(steps.back() / count);
        timing.droplets += count / kSteps;
        timing.moving += static_cast<double>(state.tracks.size()) / kSteps;
    }
    timing.step = medianOf(std::move(steps));
    timing.droplet = medianOf(std::move(each));
    return timing;
}

void timeDefaultGlass()
{
    std::puts("| glass of 1.4 m x 0.8 m | still droplets | threads | running droplets | moving | time per step |");
    std::puts("| --- | ---: | ---: | ---: | ---: | ---: |");
    struct Case {
        double rainfall;  // [mm/h]
        std::size_t still;
    };
    for (const Case& c : {Case{0.0, 0}, Case{0.0, 200'000}, Case{5.0, 200'000}, Case{25.0, 200'000}}) {
        for (const std::size_t threads : {1U, 2U}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            WindshieldParameters p = slippery({});
            p.rainfall = c.rainfall * kMillimetrePerHour;
            const Timing t = time(scattered(p, 2000, c.still), p);
            std::printf("| rain of %g mm/h | %zu | %zu | %.0f | %.0f | %.3f ms |\n", c.rainfall, c.still, threads,
                        t.droplets, t.moving, 1e3 * t.step);
        }
    }
}

void timeGrowth()
{
    std::puts("\n| running droplets | glass | still ones per running | time per step | time per droplet |");
    std::puts("| ---: | ---: | ---: | ---: | ---: |");
    for (const std::size_t still : {0U, 10U}) {
        for (const std::size_t count : {1'000U, 3'000U, 10'000U, 30'000U, 100'000U}) {
            const double side = std::sqrt(static_cast<double>(count) / 5000.0);  // 5000 per square metre
            const WindshieldParameters p = slippery({.width = side, .height = side, .radius = 10.0});
            const Timing t = time(scattered(p, count, still * count), p);
            std::printf("| %.0f | %.1f m² | %zu | %.3f ms | %.0f ns |\n", t.droplets, side * side, still, 1e3 * t.step,
                        1e9 * t.droplet);
        }
    }
}

void timeMaps()
{
    std::puts("\n| maps of 1024 px | running | still | step | changed tiles | all from the start | for files |");
    std::puts("| --- | ---: | ---: | ---: | ---: | ---: | ---: |");
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    struct Case {
        const char* name;
        double rainfall;  // [mm/h]
        std::size_t running;
        std::size_t still;
        double rains;  // before [s]
    };
    for (const Case& c :
         {Case{"the thesis' scale", 5.0, 500, 40'000, 0.0}, Case{"50 mm/h for 20 s, wipers", 50.0, 0, 0, 20.0},
          Case{"many", 5.0, 14'000, 100'000, 0.0}}) {
        WindshieldParameters p = windshieldPresetNamed("figure-3.11").parameters;
        p.rainfall = c.rainfall * kMillimetrePerHour;
        if (c.rains > 0.0) {
            p.wipers = tandemWipers(p.glass, 1.2);
        }
        WindshieldState state = c.running > 0 ? scattered(p, c.running, c.still) : startWindshield(p);
        while (state.time < c.rains) {
            state = step(std::move(state), p, kStep);
        }
        WindshieldMaps maps(p.glass);
        std::vector<std::uint16_t> pixels(4 * static_cast<std::size_t>(maps.width()) *
                                          static_cast<std::size_t>(maps.height()));
        const double first = timeOf([&] { maps.update(state, pixels); });
        std::vector<double> steps;
        std::vector<double> updates;
        for (int k = 0; k < kSteps; ++k) {
            steps.push_back(timeOf([&] { state = step(std::move(state), p, kStep); }));
            updates.push_back(timeOf([&] { maps.update(state, pixels); }));
        }
        GlassMapFrames files(p.glass, {.width = 1024});
        files.maps(state);
        std::vector<double> file_updates;
        for (int k = 0; k < kSteps; ++k) {
            state = step(std::move(state), p, kStep);
            file_updates.push_back(timeOf([&] { files.maps(state); }));
        }
        std::printf("| %s | %zu | %zu | %.2f ms | %.2f ms | %.1f ms | %.1f ms |\n", c.name, state.droplets.size(),
                    state.still.count(), 1e3 * medianOf(steps), 1e3 * medianOf(updates), 1e3 * first,
                    1e3 * medianOf(file_updates));
    }
}

/// Takes bytes and forgets them.
class Nowhere : public std::streambuf {
    int_type overflow(int_type c) override { return traits_type::not_eof(c); }
    std::streamsize xsputn(const char* /*bytes*/, std::streamsize count) override { return count; }
};

void timeFrames()
{
    std::puts(
        "\n| frames with wipers | running | still | step | frame without wipers | wipers add | on two cores | its PNG "
        "| "
        "maps | PNGs of maps |");
    std::puts("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |");
    std::optional<tbb::global_control> limit(std::in_place, tbb::global_control::max_allowed_parallelism, 1);
    struct Case {
        const char* name;
        const char* preset;
        double rainfall;      // [mm/h]
        double runoff = 0.0;  // [s]
    };
    for (const Case& c :
         {Case{"figure 3.10", "figure-3.10", 5.0}, Case{"figure 3.11", "figure-3.11", 5.0},
          Case{"figure 3.12", "figure-3.12", 5.0}, Case{"25 mm/h", "figure-3.12", 25.0},
          Case{"25 mm/h, its film", "figure-3.12", 25.0, 1.0}, Case{"49 mm/h, its film", "figure-3.12", 49.0, 1.0}}) {
        WindshieldParameters p = windshieldPresetNamed(c.preset).parameters;
        p.rainfall = c.rainfall * kMillimetrePerHour;
        p.runoff = c.runoff;
        p.wipers = tandemWipers(p.glass, 1.2);
        ViewOptions options;
        const Picture road = defaultBackground(options);
        DriversView without(p.glass, options);
        options.wipers = p.wipers;
        DriversView with(p.glass, options);
        without.setBackground(road);
        with.setBackground(road);
        WindshieldState state = startWindshield(p);
        while (state.time < 6.0) {  // five strokes
            state = step(std::move(state), p, kStep);
        }
        std::vector<double> steps;
        std::vector<double> bare;
        std::vector<double> added;
        std::vector<double> added_by_two;
        std::vector<double> pngs;
        std::vector<double> maps;
        std::vector<double> map_pngs;
        GlassMapFrames map_frames(p.glass, {.width = 1024});
        Picture frame;
        const auto draw = [&](DriversView& view) {
            view.show(state);
            frame = view.frame();
        };
        const auto wall_time = [&](DriversView& view) {
            const double begin = now();
            draw(view);
            return now() - begin;
        };
        Nowhere nowhere;
        std::ostream out(&nowhere);
        for (int k = 0; k < 72; ++k) {  // a stroke
            steps.push_back(timeOf([&] { state = step(std::move(state), p, kStep); }));
            bare.push_back(timeOf([&] { draw(without); }));
            added.push_back(timeOf([&] { draw(with); }) - bare.back());
            const GlassMaps* files = nullptr;
            maps.push_back(timeOf([&] { files = &map_frames.maps(state); }));
            if (k % 8 == 0) {
                pngs.push_back(timeOf([&] { writePng(frame, out, PngEffort::Fast); }));
                map_pngs.push_back(timeOf([&] {
                    writePng(files->normal, out, PngEffort::Fast);
                    writePng(files->thickness, out, PngEffort::Fast);
                    writePng(files->velocity, out, PngEffort::Fast);
                }));
            }
        }
        limit.emplace(tbb::global_control::max_allowed_parallelism, 2);
        for (int k = 0; k < 72; ++k) {
            state = step(std::move(state), p, kStep);
            const double without_wipers = wall_time(without);
            added_by_two.push_back(wall_time(with) - without_wipers);
        }
        limit.emplace(tbb::global_control::max_allowed_parallelism, 1);
        std::printf("| %s | %zu | %zu | %.2f ms | %.1f ms | %.1f ms | %.1f ms | %.1f ms | %.1f ms | %.1f ms |\n",
                    c.name, state.droplets.size(), state.still.count(), 1e3 * medianOf(steps), 1e3 * medianOf(bare),
                    1e3 * medianOf(added), 1e3 * medianOf(added_by_two), 1e3 * medianOf(pngs), 1e3 * medianOf(maps),
                    1e3 * medianOf(map_pngs));
    }
}

void timeHour(double seconds)
{
    WindshieldParameters p = windshieldPresetNamed("figure-3.12").parameters;
    p.rainfall = 25.0 * kMillimetrePerHour;
    constexpr double kLongStep = 1.0 / 30.0;
    std::puts(
        "\n| simulated | running droplets | still droplets | run off, of all rain | balance error | memory | wall time "
        "|");
    std::puts("| ---: | ---: | ---: | ---: | ---: | ---: | ---: |");
    const bench::PeakMemory memory;
    WindshieldState state = startWindshield(p);
    const double begin = now();
    const auto steps = static_cast<long>(std::lround(seconds / kLongStep));
    for (long k = 1; k <= steps; ++k) {
        state = step(std::move(state), p, kLongStep);
        if (k % std::max(1L, steps / 6) == 0) {
            const WaterBalance balance = balanceOf(state);
            std::printf("| %.0f s | %zu | %zu | %.1f %% | %.0e | %.0f MB | %.0f s |\n", state.time,
                        state.droplets.size(), state.still.count(), 100.0 * balance.left / balance.rained,
                        std::abs(balance.residual()), static_cast<double>(memory.rise().value_or(0)) / 1e6,
                        now() - begin);
            std::fflush(stdout);
        }
    }
}

}  // namespace

int main(int argc, char** argv)
{
    double seconds = 3600.0;
    for (int k = 1; k < argc; ++k) {
        if (std::strncmp(argv[k], "--hour=", 7) != 0 || !((seconds = std::atof(argv[k] + 7)) > 0.0)) {
            std::fputs("usage: bench_windshield [--hour=SECONDS]\n", stderr);
            return 2;
        }
    }
    try {
        timeDefaultGlass();
        timeGrowth();
        timeMaps();
        timeFrames();
        timeHour(seconds);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_windshield: %s\n", error.what());
        return 1;
    }
}

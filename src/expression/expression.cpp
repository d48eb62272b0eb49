// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/expression/expression.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "aeration.h"
#include "blocks.h"
#include "field.h"
#include "isoline.h"
#include "require.h"
#include "surface_kernel.h"
#include "tails.h"

namespace droplet {
namespace {

/// Samples of a way over the length of a tail.
constexpr double kSamples = 10.0;
/// Air below this makes no foam.
constexpr double kFoamAir = 0.1;

FieldOptions fieldOptions(const ExpressionOptions& options)
{
    return {options.smoothing, std::clamp(static_cast<int>(std::ceil(1.0 / options.resolution - 1e-9)), 1, 5), false};
}

/// Particles of a frame in the order of their ids.
std::vector<std::uint32_t> orderOf(const ParticleFrame& frame)
{
    std::vector<std::uint32_t> order(frame.id.size());
    std::iota(order.begin(), order.end(), 0U);
    if (!std::is_sorted(frame.id.begin(), frame.id.end())) {
        std::sort(order.begin(), order.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return frame.id[a] < frame.id[b]; });
    }
    return order;
}

/// For each particle of the frame the place of its memory.
std::vector<std::uint32_t> memoryOf(const ExpressionState& state, const ParticleFrame& frame)
{
    std::vector<std::uint32_t> memory(frame.id.size());
    const auto& known = state.particles;
    std::size_t at = 0;
    for (const std::uint32_t i : orderOf(frame)) {
        while (at < known.size() && known[at].id < frame.id[i]) {
            ++at;
        }
        if (at == known.size() || known[at].id != frame.id[i]) {
            throw Error(ErrorCode::InvalidArgument, "frame is another than the one that the state took up last");
        }
        memory[i] = static_cast<std::uint32_t>(at);
    }
    return memory;
}

/// Air of the sorted particles; empty if none has any.
std::vector<float> airOf(const ExpressionState& state, const std::vector<std::uint32_t>& memory,
                         const ParticleCells& cells)
{
    std::vector<float> air(memory.size());
    bool any = false;
    for (std::size_t k = 0; k < air.size(); ++k) {
        air[k] = static_cast<float>(state.particles[memory[cells.particle[k]]].air);
        any = any || air[k] > 0.0F;
    }
    if (!any) {
        air.clear();
    }
    return air;
}

struct Box {
    Vec2 lower{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    Vec2 upper{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    [[nodiscard]] bool holds(Vec2 p) const
    {
        return p.x >= lower.x && p.x <= upper.x && p.y >= lower.y && p.y <= upper.y;
    }
};

Box boxOf(const Loop& loop)
{
    Box box;
    for (const Vec2 p : loop.points) {
        box.lower = {std::min(box.lower.x, p.x), std::min(box.lower.y, p.y)};
        box.upper = {std::max(box.upper.x, p.x), std::max(box.upper.y, p.y)};
    }
    return box;
}

bool encloses(const Loop& loop, Vec2 p)
{
    bool inside = false;
    for (std::size_t k = 0, last = loop.points.size() - 1; k < loop.points.size(); last = k++) {
        const Vec2 a = loop.points[last];
        const Vec2 b = loop.points[k];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) {
            inside = !inside;
        }
    }
    return inside;
}

}  // namespace

void ExpressionOptions::validate() const
{
    const auto within = [](const char* field, double value, double min, double max, const char* constraint) {
        require(value >= min && value <= max, field, value, constraint);
    };
    within("tail_length", tail_length, 0.0, 1e6, "from 0 to 1e6 s");
    within("tail_slope", tail_slope, 0.2, 1.2, "from 0.2 to 1.2");
    within("max_tail", max_tail, 0.0, 20.0, "from 0 to 20 radii");
    within("air", air, 0.0, 1e6, "from 0 to 1e6 areas per second");
    within("release", release, 0.0, 1e6, "from 0 to 1e6 areas per second");
    within("max_air", max_air, 0.0, 10.0, "from 0 to 10 areas");
    within("smoothing", smoothing, 0.0, 2.0, "from 0 to 2");
    within("resolution", resolution, 0.2, 1.0, "from 0.2 to 1 spacings");
    within("min_area", min_area, 0.0, 1e6, "from 0 to 1e6 areas");
    within("droplet_size", droplet_size, 0.0, 1e4, "from 0 to 1e4 particles");
}

ExpressionOptions expressionOf(LiquidStyle style)
{
    ExpressionOptions options;
    if (style != LiquidStyle::Realistic) {
        options.tail_length = 0.12;
        options.resolution = 1.0 / 3.0;
    }
    if (style == LiquidStyle::Wave) {
        options.air = 12.0;
        options.release = 3.0;
        options.max_air = 3.0;
    }
    return options;
}

ExpressionState advanceExpression(ExpressionState state, const ParticleFrame& frame, const ExpressionOptions& options)
{
    options.validate();
    if (state.begun && frame.time < state.time) {
        throw Error(ErrorCode::InvalidInput, "time of a frame is before that of the frame before it");
    }
    const double elapsed = state.begun ? frame.time - state.time : 0.0;
    const bool keeps_ways = options.tail_length > 0.0;

    // The latest sample is replaced as long as it is too close to the one before.
    bool replaces = false;
    if (keeps_ways) {
        const double interval = options.tail_length / kSamples;
        replaces = !state.times.empty() && (frame.time == state.times[0] ||
                                            (state.times.size() > 1 && state.times[0] - state.times[1] < interval));
        if (replaces) {
            state.times[0] = frame.time;
        } else {
            state.times.insert(state.times.begin(), frame.time);
        }
        while (state.times.size() > 2 && state.times[0] - state.times[state.times.size() - 2] >= options.tail_length) {
            state.times.pop_back();
        }
    } else {
        state.times.clear();
    }
    const std::size_t samples = state.times.size();

    const std::vector<std::uint32_t> order = orderOf(frame);
    std::vector<ExpressionState::Memory> particles(order.size());
    std::size_t at = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
        const std::uint32_t id = frame.id[order[k]];
        while (at < state.particles.size() && state.particles[at].id < id) {
            ++at;
        }
        if (at < state.particles.size() && state.particles[at].id == id) {
            particles[k] = std::move(state.particles[at]);
        }
        particles[k].id = id;
    }
    state.particles = std::move(particles);
    forBlocks(
        order.size(),
        [&](std::size_t b, std::size_t e) {
            for (std::size_t k = b; k < e; ++k) {
                std::vector<Vec2>& way = state.particles[k].way;
                if (!keeps_ways) {
                    way.clear();
                    continue;
                }
                if (replaces && !way.empty()) {
                    way[0] = frame.position[order[k]];
                } else {
                    way.insert(way.begin(), frame.position[order[k]]);
                }
                if (way.size() > samples) {
                    way.resize(samples);
                }
            }
        },
        4096);

    if (options.air > 0.0 && elapsed > 0.0) {
        const ParticleCells cells = sortIntoCells(frame);
        const Coverage coverage = coverageOf(cells, {}, fieldOptions(options));
        const Aeration aeration = aerationOf(frame, cells, coverage, options.crest_gate);
        state.aeration_limit += (aeration.largest - state.aeration_limit) / static_cast<double>(state.frames + 1);
        ++state.frames;
        const double high = state.aeration_limit;
        const double low = 0.1 * high;
        for (std::size_t k = 0; k < order.size(); ++k) {
            const auto entry = static_cast<double>(aeration.entry[order[k]]);
            const double taken = high > 0.0 ? std::clamp((entry - low) / (high - low), 0.0, 1.0) : 0.0;
            const double released = static_cast<double>(aeration.release[order[k]]);
            double& air = state.particles[k].air;
            air = std::clamp(air + (options.air * taken - options.release * released) * elapsed, 0.0, options.max_air);
        }
    }
    state.time = frame.time;
    state.begun = true;
    return state;
}

LiquidShape liquidShape(const ExpressionState& state, const ParticleFrame& frame, const ExpressionOptions& options)
{
    options.validate();
    const FieldOptions field_options = fieldOptions(options);
    const std::vector<std::uint32_t> memory = memoryOf(state, frame);
    const ParticleCells cells = sortIntoCells(frame);
    const std::vector<float> air = airOf(state, memory, cells);
    const Coverage coverage = coverageOf(cells, air, field_options);
    const Tails tails = tailsOf({state, memory, frame, cells, coverage.full}, options);
    const SurfaceField field = surfaceField(cells, coverage, air, tails, field_options);

    LiquidShape shape;
    shape.time = frame.time;
    const double particle_area = frame.spacing * frame.spacing;
    std::vector<Loop> small;
    std::vector<Vec2> erasers;
    for (std::size_t k = 0; k < air.size(); ++k) {
        if (static_cast<double>(air[k]) > kFoamAir) {
            erasers.push_back(frame.position[cells.particle[k]]);
        }
    }
    std::vector<Loop> holes;
    for (Loop& loop : isolines(field, frame.spacing)) {
        const double area = signedArea(loop);
        if (std::abs(area) < options.min_area * particle_area) {
            continue;
        }
        if (area < 0.0) {
            holes.push_back(std::move(loop));
        } else if (area <= options.droplet_size * particle_area) {
            small.push_back(std::move(loop));
        } else {
            shape.liquid.push_back(std::move(loop));
        }
    }
    for (Loop& loop : small) {
        const Box box = boxOf(loop);
        const bool has_hole = std::any_of(holes.begin(), holes.end(), [&](const Loop& hole) {
            return box.holds(hole.points[0]) && encloses(loop, hole.points[0]);
        });
        (has_hole ? shape.liquid : shape.droplets).push_back(std::move(loop));
    }
    for (Loop& hole : holes) {
        const Box box = boxOf(hole);
        if (std::any_of(erasers.begin(), erasers.end(), [&](Vec2 p) { return box.holds(p) && encloses(hole, p); })) {
            shape.foam.push_back(hole);
        }
        shape.liquid.push_back(std::move(hole));
    }
    return shape;
}

}  // namespace droplet

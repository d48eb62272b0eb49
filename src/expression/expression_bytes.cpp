// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdint>

#include "droplet/expression/expression.h"
#include "exact_bytes.h"

namespace droplet {
namespace {

constexpr std::string_view kHead = "droplet-shape expression 4\n";

}  // namespace

std::string bytesOf(const ExpressionState& state)
{
    ExactWriter out(kHead);
    out.all(state.aeration_limit, state.speed, state.frames);
    for (const auto* values : {&state.air, &state.curl, &state.flight, &state.aeration}) {
        out.put(std::uint64_t{values->size()});
        for (const double value : *values) {
            out.put(value);
        }
    }
    out.put(std::uint64_t{state.group.size()});
    for (const std::uint32_t group : state.group) {
        out.put(std::uint64_t{group});
    }
    out.put(std::uint64_t{state.landed.size()});
    for (const std::uint8_t landed : state.landed) {
        out.put(std::uint64_t{landed});
    }
    out.put(std::uint64_t{state.past.size()});
    for (const ExpressionState::Past& past : state.past) {
        out.put(past.time);
        out.put(std::uint64_t{past.position.size()});
        for (const Vec2 x : past.position) {
            const bool was_there = !std::isnan(x.x);
            out.all(std::uint64_t{was_there}, was_there ? x : Vec2{});
        }
    }
    out.put(std::uint64_t{state.remembers});
    out.put(std::uint64_t{state.holes.size()});
    for (const LiquidHole& hole : state.holes) {
        out.all(hole.centre, hole.area, hole.reach, hole.clearance, hole.seen, std::uint64_t{hole.shown.has_value()},
                hole.shown.value_or(0.0), std::uint64_t{hole.gap.has_value()}, hole.gap.value_or(Vec2{}));
    }
    return out.release();
}

ExpressionState expressionFromBytes(std::string_view bytes, const std::string& name)
{
    ExactReader in(bytes, kHead, name);
    ExpressionState state;
    in.all(state.aeration_limit, state.speed, state.frames);
    for (auto* values : {&state.air, &state.curl, &state.flight, &state.aeration}) {
        values->resize(in.count(sizeof(double)));
        for (double& value : *values) {
            in.get(value);
        }
    }
    state.group.resize(in.count(sizeof(std::uint64_t)));
    for (std::uint32_t& group : state.group) {
        std::uint64_t number = 0;
        in.get(number);
        in.require(number < state.group.size() || number == ExpressionState::kNoGroup);
        group = static_cast<std::uint32_t>(number);
    }
    state.landed.resize(in.count(sizeof(std::uint64_t)));
    for (std::uint8_t& landed : state.landed) {
        std::uint64_t number = 0;
        in.get(number);
        in.require(number <= 1);
        landed = static_cast<std::uint8_t>(number);
    }
    state.past.resize(in.count(2 * sizeof(double)));
    for (ExpressionState::Past& past : state.past) {
        in.get(past.time);
        past.position.resize(in.count(3 * sizeof(double)));
        for (Vec2& x : past.position) {
            std::uint64_t was_there = 0;
            in.all(was_there, x);
            if (was_there == 0) {
                x = {std::nan(""), std::nan("")};
            }
        }
    }
    std::uint64_t remembers = 0;
    in.get(remembers);
    in.require(remembers <= 1);
    state.remembers = remembers != 0;
    state.holes.resize(in.count(11 * sizeof(double)));
    for (LiquidHole& hole : state.holes) {
        std::uint64_t is_shown = 0;
        double shown = 0.0;
        std::uint64_t has_gap = 0;
        Vec2 gap;
        in.all(hole.centre, hole.area, hole.reach, hole.clearance, hole.seen, is_shown, shown, has_gap, gap);
        in.require(is_shown <= 1 && has_gap <= 1);
        hole.shown = is_shown != 0 ? std::optional(shown) : std::nullopt;
        hole.gap = has_gap != 0 ? std::optional(gap) : std::nullopt;
    }
    in.require(in.ended());
    return state;
}

}  // namespace droplet

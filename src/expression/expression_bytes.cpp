// SPDX-License-Identifier: GPL-3.0-or-later
#include <limits>

#include "droplet/expression/expression.h"
#include "exact_bytes.h"

namespace droplet {
namespace {

constexpr std::string_view kHead = "droplet-shape expression 1\n";

}  // namespace

std::string bytesOf(const ExpressionState& state)
{
    ExactWriter out(kHead);
    out.all(state.time, std::uint64_t{state.begun}, state.aeration_limit, state.frames);
    out.put(std::uint64_t{state.times.size()});
    for (const double time : state.times) {
        out.put(time);
    }
    out.put(std::uint64_t{state.particles.size()});
    for (const ExpressionState::Memory& m : state.particles) {
        out.all(std::uint64_t{m.id}, m.air, std::uint64_t{m.way.size()});
        for (const Vec2 p : m.way) {
            out.put(p);
        }
    }
    return out.release();
}

ExpressionState expressionFromBytes(const std::string& bytes, const std::string& name)
{
    ExactReader in(bytes, kHead, name);
    ExpressionState state;
    std::uint64_t begun = 0;
    in.all(state.time, begun, state.aeration_limit, state.frames);
    in.require(begun < 2 && state.aeration_limit >= 0.0);
    state.begun = begun != 0;
    state.times.resize(in.count(sizeof(double)));
    for (std::size_t k = 0; k < state.times.size(); ++k) {
        in.get(state.times[k]);
        in.require(k == 0 || state.times[k] < state.times[k - 1]);
    }
    state.particles.resize(in.count(3 * sizeof(double)));
    std::uint64_t after = 0;
    for (ExpressionState::Memory& m : state.particles) {
        std::uint64_t id = 0;
        in.all(id, m.air);
        in.require(id >= after && id <= std::numeric_limits<std::uint32_t>::max() && m.air >= 0.0);
        after = id + 1;
        m.id = static_cast<std::uint32_t>(id);
        m.way.resize(in.count(2 * sizeof(double)));
        in.require(m.way.size() <= state.times.size());
        for (Vec2& p : m.way) {
            in.get(p);
        }
    }
    in.require(in.ended());
    return state;
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>

#include "droplet/flow/flow.h"
#include "exact_bytes.h"

namespace droplet {
namespace {

constexpr std::string_view kHead = "droplet-shape flow 5\n";

template <class Archive, class State>
void scalars(Archive& archive, State& s)
{
    archive.all(s.time, s.steps, s.next_id, s.next_raindrop, s.next_nucleus, s.until_raindrop, s.until_nucleus,
                s.released, s.left, s.dried, s.counts.released, s.counts.crossings, s.counts.launches,
                s.counts.landings, s.counts.merged, s.counts.beads, s.counts.left, s.counts.dried, s.counts.stuck,
                s.counts.raindrops, s.counts.overflows, s.counts.behind, s.counts.behind_volume);
}

}  // namespace

std::string bytesOf(const FlowState& state)
{
    ExactWriter out(kHead);
    scalars(out, state);
    out.put(std::uint64_t{state.droplets.size()});
    for (const FlowDroplet& d : state.droplets) {
        out.all(d.id, d.volume, d.drying, d.born, std::uint64_t{d.has_grown}, static_cast<std::uint64_t>(d.contact),
                std::uint64_t{d.face}, std::uint64_t{d.side}, d.leg.begin, d.leg.place, d.leg.velocity, d.leg.push,
                d.leg.decay, d.heading, d.held, d.held_at);
    }
    out.put(std::uint64_t{state.wetness.size()});
    for (const FlowState::Wetness& w : state.wetness) {
        out.all(w.dryness, w.before, w.id, w.time);
    }
    out.put(std::uint64_t{state.trails.size()});
    for (const FlowState::Trail& t : state.trails) {
        out.all(t.id, t.volume, t.drying, t.length, t.spacing, t.until, std::uint64_t{t.face}, t.place);
    }
    out.put(std::uint64_t{state.emissions.size()});
    for (const FlowState::Emission& e : state.emissions) {
        out.all(e.pending, e.released);
    }
    return out.release();
}

FlowState flowStateFromBytes(std::string_view bytes, std::size_t faces, const std::string& name)
{
    ExactReader in(bytes, kHead, name);
    const auto face = [&](std::uint32_t& value) {
        std::uint64_t number = 0;
        in.get(number);
        in.require(number < faces);
        value = static_cast<std::uint32_t>(number);
    };
    FlowState state;
    scalars(in, state);
    in.require(state.time >= 0.0);
    state.droplets.resize(in.count(26 * sizeof(double)));
    std::uint64_t previous_id = 0;
    for (FlowDroplet& d : state.droplets) {
        std::uint64_t has_grown = 0;
        std::uint64_t contact = 0;
        std::uint64_t side = 0;
        in.all(d.id, d.volume, d.drying, d.born, has_grown, contact);
        face(d.face);
        in.all(side, d.leg.begin, d.leg.place, d.leg.velocity, d.leg.push, d.leg.decay, d.heading, d.held, d.held_at);
        in.require(d.volume > 0.0 && d.drying >= 0.0 && d.leg.decay >= 0.0 && d.id > previous_id &&
                   d.id < state.next_id && has_grown < 2 && contact <= 3 && side < 3);
        d.has_grown = has_grown != 0;
        d.contact = static_cast<FlowContact>(contact);
        d.side = static_cast<std::uint32_t>(side);
        previous_id = d.id;
    }
    state.wetness.resize(in.count(6 * sizeof(double)));
    in.require(state.wetness.size() == faces);
    for (FlowState::Wetness& w : state.wetness) {
        in.all(w.dryness, w.before, w.id, w.time);
    }
    state.trails.resize(in.count(10 * sizeof(double)));
    for (FlowState::Trail& t : state.trails) {
        in.all(t.id, t.volume, t.drying, t.length, t.spacing, t.until);
        face(t.face);
        in.get(t.place);
        in.require(t.volume >= 0.0 && t.drying >= 0.0);
    }
    state.emissions.resize(in.count(2 * sizeof(double)));
    for (FlowState::Emission& e : state.emissions) {
        in.all(e.pending, e.released);
    }
    in.require(in.ended());
    return state;
}

}  // namespace droplet

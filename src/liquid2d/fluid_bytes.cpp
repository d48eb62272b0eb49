// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>
#include <string_view>

#include "droplet/liquid2d/fluid.h"
#include "exact_bytes.h"

namespace droplet {
namespace {

constexpr std::string_view kHead = "droplet-shape fluid 2\n";

}  // namespace

std::string bytesOf(const FluidState& state)
{
    ExactWriter out(kHead);
    out.all(state.time, std::uint64_t{state.next_id}, state.approach_speed, state.density_error, state.step,
            state.counts.steps, state.counts.density_iterations, state.counts.divergence_iterations,
            state.counts.emitted, state.counts.removed, state.counts.rescued, state.counts.blocked);
    out.put(std::uint64_t{state.emitted.size()});
    for (const double length : state.emitted) {
        out.put(length);
    }
    out.put(std::uint64_t{state.position.size()});
    for (std::size_t i = 0; i < state.position.size(); ++i) {
        out.all(state.position[i], state.velocity[i], std::uint64_t{state.id[i]}, state.density[i], state.pressure[i]);
    }
    out.put(std::uint64_t{state.affine.size()});
    for (const auto& [across, up] : state.affine) {
        out.all(across, up);
    }
    return out.release();
}

FluidState fluidStateFromBytes(std::string_view bytes, const std::string& name)
{
    ExactReader in(bytes, kHead, name);
    const auto id = [&](std::uint32_t& value) {
        std::uint64_t number = 0;
        in.get(number);
        in.require(number <= 0xFFFFFFFFU);
        value = static_cast<std::uint32_t>(number);
    };
    FluidState state;
    in.get(state.time);
    id(state.next_id);
    in.all(state.approach_speed, state.density_error, state.step, state.counts.steps, state.counts.density_iterations,
           state.counts.divergence_iterations, state.counts.emitted, state.counts.removed, state.counts.rescued,
           state.counts.blocked);
    in.require(state.time >= 0.0 && state.approach_speed >= 0.0);
    state.emitted.resize(in.count(sizeof(double)));
    for (double& length : state.emitted) {
        in.get(length);
    }
    const std::size_t count = in.count(7 * sizeof(double));
    state.position.resize(count);
    state.velocity.resize(count);
    state.id.resize(count);
    state.density.resize(count);
    state.pressure.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        in.all(state.position[i], state.velocity[i]);
        id(state.id[i]);
        in.all(state.density[i], state.pressure[i]);
    }
    const std::size_t affine = in.count(4 * sizeof(double));
    in.require(affine == 0 || affine == count);
    state.affine.resize(affine);
    for (auto& [across, up] : state.affine) {
        in.all(across, up);
    }
    in.require(in.ended());
    return state;
}

}  // namespace droplet

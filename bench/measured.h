// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <benchmark/benchmark.h>

#include <optional>
#include <string>
#include <utility>

#include "memory.h"

namespace droplet::bench {

/// Registers a case. `prepare` makes the input of `work` and is not measured. Measured are the time of `work`, the rise
/// of the peak memory, and by `judge` the quality of the result.
template <class Prepare, class Work, class Judge>
void measure(const std::string& name, int repetitions, Prepare prepare, Work work, Judge judge)
{
    benchmark::RegisterBenchmark(name.c_str(),
                                 [prepare, work, judge](benchmark::State& state) {
                                     using Result = decltype(work());
                                     prepare();
                                     std::optional<Result> result;
                                     const PeakMemory memory;
                                     for ([[maybe_unused]] auto round : state) {
                                         state.PauseTiming();
                                         result.reset();
                                         state.ResumeTiming();
                                         result.emplace(work());
                                     }
                                     if (const auto rise = memory.rise()) {
                                         state.counters["peak_bytes"] = static_cast<double>(*rise);
                                     }
                                     judge(*result, state.counters);
                                 })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime()
        ->Repetitions(repetitions);
}

}  // namespace droplet::bench

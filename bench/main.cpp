// SPDX-License-Identifier: GPL-3.0-or-later
// Google Benchmark of the pipeline's stages and of other programs:
//
//   droplet_bench [--largest=TRIANGLES] [Google Benchmark's own options] MASK...
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "stages.h"

int main(int argc, char** argv)
{
    using namespace droplet::bench;
    try {
        benchmark::Initialize(&argc, argv);
        std::size_t largest = 4'000'000;
        Plan plan;
        for (int k = 1; k < argc; ++k) {
            const std::string argument = argv[k];
            const std::string option = "--largest=";
            if (argument.rfind(option, 0) == 0) {
                largest = std::stoul(argument.substr(option.size()));
            } else {
                plan.masks.emplace_back(argument);
            }
        }
        if (plan.masks.empty()) {
            std::fputs("usage: droplet_bench [--largest=TRIANGLES] [--benchmark_...] MASK...\n", stderr);
            return 2;
        }
        for (const std::size_t size : {5'000U, 40'000U, 100'000U, 400'000U, 1'000'000U, 4'000'000U}) {
            if (size <= largest) {
                plan.sizes.push_back(size);
            }
        }
        registerStages(plan);
        registerPeers(plan);
        registerGrading(plan);
        benchmark::RunSpecifiedBenchmarks();
        benchmark::Shutdown();
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "droplet_bench: %s\n", error.what());
        return 1;
    }
}

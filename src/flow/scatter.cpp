// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow/scatter.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <string>

#include "droplet/error.h"
#include "flow/places.h"
#include "require.h"

namespace droplet {
namespace {

std::optional<FlowStart> startOf(const Places& places, const ScatterOptions& options, std::size_t k)
{
    const RandomStream random(options.seed, RandomPurpose::Scatter, k);
    std::uint64_t counter = 0;
    const std::optional<FlowTerrain::Point> point = places.pointOf(random, counter);
    if (!point) {
        return std::nullopt;
    }
    FlowStart start;
    start.volume = options.volumes.at(random.uniform(0), random.uniform(1));
    start.place = point->place;
    return start;
}

}  // namespace

void ScatterOptions::validate() const
{
    volumes.validate();
    if (from) {
        const double size = length(*from);
        require(size > 0.0 && std::isfinite(size), "from", size, "a direction that is not 0");
    }
}

std::vector<FlowStart> scatterDroplets(const FlowTerrain& terrain, const ScatterOptions& options)
{
    options.validate();
    const Places places{terrain, options.from, options.coverage};
    std::vector<FlowStart> starts(options.count);
    const auto put = [&](std::size_t k) {
        const std::optional<FlowStart> start = startOf(places, options, k);
        if (!start) {
            throw Error(ErrorCode::InvalidInput,
                        "no place for droplet " + std::to_string(k + 1) + " of " + std::to_string(options.count) +
                            " in a million tries: " +
                            (options.coverage && options.from
                                 ? "too little of the object is in the mask or has weight, and faces the rain"
                             : options.coverage ? "too little of the object is in the mask or has weight"
                                                : "too little of the object faces the rain"));
        }
        starts[k] = *start;
    };
    if (options.count > 0) {
        put(0);  // if there is no place at all, one search is enough
        tbb::parallel_for(std::size_t{1}, options.count, put);
    }
    return starts;
}

double scatterArea(const FlowTerrain& terrain, const ScatterOptions& options)
{
    options.validate();
    return Places{terrain, options.from, options.coverage}.share(options.seed, 4096) * terrain.area();
}

}  // namespace droplet

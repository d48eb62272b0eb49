// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow/scatter.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>
#include <string>

#include "droplet/error.h"
#include "require.h"
#include "wind/random.h"

namespace droplet {
namespace {

constexpr std::uint64_t kMaxTries = 1'000'000;

/// Points that droplets may have.
class Places {
public:
    Places(const FlowTerrain& terrain, const ScatterOptions& options) : terrain_(terrain), options_(options)
    {
        if (options.from) {
            up_ = (1.0 / length(*options.from)) * *options.from;
        }
    }

    [[nodiscard]] std::optional<FlowStart> startOf(std::size_t k) const
    {
        const RandomStream random(options_.seed, RandomPurpose::Scatter, k);
        FlowStart start;
        start.volume = options_.volumes.at(random.uniform(0), random.uniform(1));
        for (std::uint64_t i = 0; i < kMaxTries; ++i) {
            const FlowTerrain::Point point = terrain_.pointAt(random.uniform(2 + 3 * i), random.uniform(3 + 3 * i));
            if (takes(point, random.uniform(4 + 3 * i))) {
                start.place = point.place;
                return start;
            }
        }
        return std::nullopt;
    }

    /// Share of the surface that takes droplets.
    [[nodiscard]] double share() const
    {
        constexpr std::uint64_t kSample = 4096;
        const RandomStream random(options_.seed, RandomPurpose::Scatter, std::numeric_limits<std::uint64_t>::max());
        std::uint64_t taken = 0;
        for (std::uint64_t i = 0; i < kSample; ++i) {
            const FlowTerrain::Point point = terrain_.pointAt(random.uniform(3 * i), random.uniform(3 * i + 1));
            taken += takes(point, random.uniform(3 * i + 2)) ? 1 : 0;
        }
        return static_cast<double>(taken) / static_cast<double>(kSample);
    }

private:
    /// Whether a point takes a droplet.
    /// @param u  uniform in [0, 1)
    [[nodiscard]] bool takes(const FlowTerrain::Point& point, double u) const
    {
        return (!options_.coverage || u < options_.coverage(point)) && isMet(point);
    }

    /// Whether rain meets a point first.
    [[nodiscard]] bool isMet(const FlowTerrain::Point& point) const
    {
        if (!up_) {
            return true;
        }
        if (!(dot(terrain_.surface().faces[point.face].normal, *up_) > 0.0)) {
            return false;
        }
        const double size = terrain_.diameter();
        const std::optional<FlowTerrain::Point> met = terrain_.firstAlong(point.place + 2.0 * size * *up_, -1.0 * *up_);
        constexpr double kNear = 1e-6;  // the search works with floats
        return met && (met->face == point.face || length(met->place - point.place) <= kNear * size);
    }

    const FlowTerrain& terrain_;
    const ScatterOptions& options_;
    std::optional<Vec3> up_;
};

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
    const Places places(terrain, options);
    std::vector<FlowStart> starts(options.count);
    const auto put = [&](std::size_t k) {
        const std::optional<FlowStart> start = places.startOf(k);
        if (!start) {
            throw Error(ErrorCode::InvalidInput, "no place for droplet " + std::to_string(k + 1) + " of " +
                                                     std::to_string(options.count) + " in a million tries: " +
                                                     (options.coverage && options.from
                                                          ? "too little of the object is in the mask and faces the rain"
                                                      : options.coverage ? "too little of the object is in the mask"
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
    return Places(terrain, options).share() * terrain.area();
}

}  // namespace droplet

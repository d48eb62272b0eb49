// SPDX-License-Identifier: GPL-3.0-or-later
#include "aeration.h"

#include <algorithm>
#include <cmath>

#include "blocks.h"
#include "surface_kernel.h"

namespace droplet {

Aeration aerationOf(const ParticleFrame& frame, const ParticleCells& cells, const Coverage& coverage, bool gated)
{
    const std::size_t count = frame.position.size();
    Aeration result{std::vector<float>(count, 0.0F), std::vector<float>(count, 1.0F), 0.0};
    const double squares = sumOverBlocks(count, [&](std::size_t b, std::size_t e) {
        double sum = 0.0;
        for (std::size_t i = b; i < e; ++i) {
            sum += dot(frame.velocity[i], frame.velocity[i]);
        }
        return sum;
    });
    const double typical = std::sqrt(squares / std::max(1.0, static_cast<double>(count)));
    if (typical == 0.0) {
        return result;
    }
    constexpr float kReach = 2.0F;
    const auto largest = mapBlocks<double>(
        count,
        [&](std::size_t b, std::size_t e) {
            double most = 0.0;
            for (std::size_t k = b; k < e; ++k) {
                const std::uint32_t place = cells.place[k];
                const double cover = static_cast<double>(coverage.coverage[k]);
                const std::uint32_t i = cells.particle[k];
                const Vec2 v = frame.velocity[i];
                const double speed = length(v);
                result.release[i] = static_cast<float>(1.0 - 0.8 * smoothRamp(speed, 0.5 * typical, 1.5 * typical));
                // Deep liquid and single droplets take in no air.
                const double surface = smoothRamp(cover, 1.0, 0.9) * smoothRamp(cover, 0.35, 0.55);
                if ((coverage.near[place / kTileCells] >> (place % kTileCells) & 1U) == 0 || surface == 0.0) {
                    continue;
                }
                const int cx = static_cast<int>(place % kTileCells) % kTileSide;
                const int cy = static_cast<int>(place % kTileCells) / kTileSide;
                double trapped = 0.0;
                Vec2 outwards{};
                cells.rows(place / kTileCells, cx - 2, cx + 2, cy - 2, cy + 2,
                           [&](std::uint32_t first, std::uint32_t last, float dx, float dy) {
                               for (std::uint32_t j = first; j < last; ++j) {
                                   const float ex = cells.x[k] - cells.x[j] - dx;
                                   const float ey = cells.y[k] - cells.y[j] - dy;
                                   const float d = std::sqrt(ex * ex + ey * ey);
                                   if (d >= kReach || d == 0.0F) {
                                       continue;
                                   }
                                   const auto w = static_cast<double>(surfaceKernel(d / kReach));
                                   const Vec2 away{static_cast<double>(ex / d), static_cast<double>(ey / d)};
                                   const Vec2 relative = v - frame.velocity[cells.particle[j]];
                                   trapped += w * (length(relative) - dot(relative, away));
                                   outwards = outwards + w * away;
                               }
                           });
                double entry = surface * trapped;
                if (gated) {
                    const double size = length(outwards);
                    const Vec2 normal = size > 0.0 ? (1.0 / size) * outwards : Vec2{};
                    const double leading = speed > 0.0 ? dot(normal, v) / speed : 0.0;
                    // Crests are convex, or the front of the wave below them is steep.
                    const double shape = std::max(smoothRamp(cover, 0.8, 0.65), smoothRamp(normal.y, 0.7, 0.2));
                    entry *= smoothRamp(leading, 0.0, 0.4) * shape * smoothRamp(speed, typical, 1.5 * typical);
                }
                result.entry[i] = static_cast<float>(entry);
                most = std::max(most, entry);
            }
            return most;
        },
        2048);
    for (const double most : largest) {
        result.largest = std::max(result.largest, most);
    }
    return result;
}

}  // namespace droplet

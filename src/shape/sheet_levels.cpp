// SPDX-License-Identifier: GPL-3.0-or-later
// Nested iteration, as multigrid methods begin: U. Trottenberg, C. Oosterlee, A. Schüller, "Multigrid" (2001), 2.6. The
// liquid's way from dry ground is followed where triangles are few, and the number of Newton's steps on a finer mesh
// does not grow with its size: E. Allgower, K. Böhmer, F. Potra, W. Rheinboldt, "A mesh-independence principle for
// operator equations and their discretizations" (1986).
#include "shape/sheet_levels.h"

#include <algorithm>
#include <utility>

#include "shape/sheet_divide.h"
#include "shape/sheet_limits.h"

namespace droplet {
namespace {

/// Most work on the coarsest mesh, for each of its triangles. Of 150 silhouettes of 40 000 triangles, whose coarsest
/// meshes have 10 000, 135 reached their angle there, half of them with 7000 and 127 with less than 15 000.
constexpr double kCoarsestWork = 15'000.0;

}  // namespace

std::optional<FilledSheet> fillByLevels(const std::vector<SheetLevel>& levels, const SheetTarget& target, double& work)
{
    SheetOptions first = levels.front().options;
    first.max_work = std::min(first.max_work, kCoarsestWork * static_cast<double>(first.triangles));
    first.is_end_wanted = false;
    first.mends = true;
    first.tolerance = kOnTheWay;
    FilledSheet filled = fillSheet(levels.front().footprint, target, first);
    work = filled.work;
    double change = 0.0;  // of the volume, by the last level
    for (std::size_t k = 1; k < levels.size(); ++k) {
        if (filled.end != SheetEnd::Reached) {
            return std::nullopt;
        }
        const SheetOptions& options = levels[k].options;
        const std::optional<CapillarySurface> divided =
            divide(filled.mesh, levels[k - 1].footprint, levels[k].footprint);
        if (!divided) {
            return std::nullopt;
        }
        // The angle of a volume converges with the first power of the mesh size.
        const double volume = target.by == FillBy::Volume ? target.amount : filled.volume + 0.5 * change;
        std::optional<FilledSheet> settled =
            settleSheet({*divided, filled.pressure, volume, k + 1 == levels.size()}, target, options);
        if (!settled) {
            return std::nullopt;
        }
        change = settled->volume - filled.volume;
        settled->work += filled.work;
        settled->newton_steps += filled.newton_steps;
        filled = *std::move(settled);
        work = filled.work;
    }
    return filled.end == SheetEnd::Reached ? std::optional(std::move(filled)) : std::nullopt;
}

}  // namespace droplet

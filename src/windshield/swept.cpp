// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield/swept.h"

#include "blocks.h"
#include "windshield/segment.h"
#include "windshield/tracks.h"

namespace droplet {
namespace {

bool touches(double squared, double reach, double still_volume, const StillRules& rules)
{
    const double touching = reach + rules.reachOf(still_volume);
    return squared <= touching * touching;
}

std::vector<SweptDroplet> find(std::span<const SweptPiece> pieces, const StillCells& still, const StillRules& rules)
{
    struct Candidate {
        const SweptPiece* piece = nullptr;
        StillSlot slot;
    };
    // All candidates are prefetched before the first is read: waiting for each would take most of the time.
    std::vector<Candidate> candidates;
    candidates.reserve(4 * pieces.size());
    const double max_still_reach = rules.maxReach();
    for (const SweptPiece& piece : pieces) {
        visitNear(still, piece.from, piece.to, piece.reach + max_still_reach, [&](StillSlot slot) {
            __builtin_prefetch(&at(still, slot));
            candidates.push_back({&piece, slot});
        });
    }
    std::vector<SweptDroplet> found;
    for (const auto& [piece, slot] : candidates) {
        const StillDroplet& d = at(still, slot);
        const double squared = Segment(piece->from, piece->to).squaredDistance(d.position);
        // The cube root costs most; it is computed only where needed.
        if (d.volume > 0.0 &&
            (squared <= piece->reach * piece->reach || touches(squared, piece->reach, d.volume, rules))) {
            found.push_back({piece->owner, slot});
        }
    }
    return found;
}

}  // namespace

std::vector<SweptDroplet> sweptBy(std::span<const SweptPiece> pieces, const StillCells& still, const StillRules& rules)
{
    std::vector<SweptDroplet> all;
    for (const std::vector<SweptDroplet>&found : mapBlocks<std::vector<SweptDroplet>>(
             pieces.size(),
             [&](std::size_t begin, std::size_t end) { return find(pieces.subspan(begin, end - begin), still, rules); },
             kDropletsPerBlock)) {
        all.insert(all.end(), found.begin(), found.end());
    }
    return all;
}

}  // namespace droplet

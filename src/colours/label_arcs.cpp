// SPDX-License-Identifier: GPL-3.0-or-later
#include "colours/label_arcs.h"

#include <algorithm>
#include <array>
#include <string>
#include <unordered_map>
#include <utility>

#include "droplet/error.h"

namespace droplet {
namespace {

constexpr std::size_t kLongestBorders = 3 * (std::size_t{1} << 20);  // as followBorders
constexpr int kWest = 2;

Step stepOf(int direction)
{
    return kSteps[static_cast<std::size_t>(direction % 4)];
}

/// Follows all borders of an image of labels.
class Follower {
public:
    explicit Follower(const LabelView& labels)
        : labels_(labels), visited_(labels.labels.size(), 0), columns_(static_cast<std::uint64_t>(labels.width) + 2)
    {
    }

    LabelArcs follow()
    {
        for (int y = 0; y < labels_.height; ++y) {
            for (int x = 0; x < labels_.width; ++x) {
                const std::uint8_t label = labels_.at(x, y);
                if (label != 0 && labels_.at(x - 1, y) != label && !isVisited({x, y, kWest})) {
                    walks_.push_back(walk({x, y, kWest}));
                }
            }
        }
        std::stable_sort(walks_.begin(), walks_.end(), [](const Walk& a, const Walk& b) { return a.label < b.label; });
        // A label owns its arcs with larger labels, which come later.
        for (const Walk& walk : walks_) {
            addLoop(walk);
        }
        return std::move(result_);
    }

private:
    /// Labels of four pixels around a corner: that of the region, its neighbour, and those ahead of both.
    struct Corner {
        std::uint8_t own = 0;
        std::uint8_t other = 0;
        std::uint8_t ahead = 0;
        std::uint8_t other_ahead = 0;

        [[nodiscard]] bool isJunction() const
        {
            const int changes = static_cast<int>(own != other) + static_cast<int>(other != other_ahead) +
                                static_cast<int>(other_ahead != ahead) + static_cast<int>(ahead != own);
            return changes == 3 || (changes == 4 && own != other_ahead && other != ahead);
        }
        /// Whether the region goes on across the corner.
        [[nodiscard]] bool isConnected() const { return own == other_ahead && (other != ahead || own > other); }
    };

    struct Walk {
        std::uint8_t label = 0;
        Border crossings;
        std::vector<std::int64_t> junctions;  ///< cell of the junction after every crossing; −1 for none
    };

    [[nodiscard]] std::uint8_t bitOf(const Crossing& at) const
    {
        return static_cast<std::uint8_t>(1U << static_cast<unsigned>(at.direction));
    }
    [[nodiscard]] std::size_t pixelOf(const Crossing& at) const
    {
        return static_cast<std::size_t>(at.y) * static_cast<std::size_t>(labels_.width) +
               static_cast<std::size_t>(at.x);
    }
    [[nodiscard]] bool isVisited(const Crossing& at) const { return (visited_[pixelOf(at)] & bitOf(at)) != 0; }

    [[nodiscard]] Corner cornerAfter(const Crossing& at) const
    {
        const Step d = at.toward();
        const Step f = stepOf(at.direction + 1);
        return {labels_.at(at.x, at.y), labels_.at(at.x + d.x, at.y + d.y), labels_.at(at.x + f.x, at.y + f.y),
                labels_.at(at.x + d.x + f.x, at.y + d.y + f.y)};
    }

    [[nodiscard]] std::int64_t cellAfter(const Crossing& at) const
    {
        const Step d = at.toward();
        const Step f = stepOf(at.direction + 1);
        const int x = std::min(at.x, at.x + d.x + f.x);
        const int y = std::min(at.y, at.y + d.y + f.y);
        return static_cast<std::int64_t>((static_cast<std::uint64_t>(y) + 1) * columns_ +
                                         static_cast<std::uint64_t>(x) + 1);
    }

    /// Number of the grid edge that a crossing is on, from either side.
    [[nodiscard]] std::uint64_t edgeOf(const Crossing& at) const
    {
        const Step d = at.toward();
        const auto x = static_cast<std::uint64_t>(std::min(at.x, at.x + d.x) + 1);
        const auto y = static_cast<std::uint64_t>(std::min(at.y, at.y + d.y) + 1);
        return 2 * (y * columns_ + x) + (d.x == 0 ? 1 : 0);
    }

    [[nodiscard]] Crossing after(const Crossing& at, const Corner& corner) const
    {
        const Step d = at.toward();
        const Step f = stepOf(at.direction + 1);
        const bool own_ahead = corner.ahead == corner.own;
        if (own_ahead && corner.other_ahead != corner.own) {
            return {at.x + f.x, at.y + f.y, at.direction};
        }
        if (own_ahead || corner.isConnected()) {
            return {at.x + d.x + f.x, at.y + d.y + f.y, (at.direction + 3) % 4};
        }
        return {at.x, at.y, (at.direction + 1) % 4};
    }

    Walk walk(const Crossing& start)
    {
        Walk walk;
        walk.label = labels_.at(start.x, start.y);
        Crossing at = start;
        do {
            visited_[pixelOf(at)] = static_cast<std::uint8_t>(visited_[pixelOf(at)] | bitOf(at));
            const Corner corner = cornerAfter(at);
            walk.crossings.push_back(at);
            walk.junctions.push_back(corner.isJunction() ? cellAfter(at) : -1);
            at = after(at, corner);
            if (++length_ > kLongestBorders) {
                throw Error(ErrorCode::InvalidInput,
                            "the borders of the picture's colours are longer than the limit of " +
                                std::to_string(kLongestBorders) + " pixels; make the picture smaller or smooth it");
            }
        } while (!(at == start));
        return walk;
    }

    std::size_t junctionAt(std::int64_t cell)
    {
        const auto [place, is_new] = junction_of_.try_emplace(cell, result_.junctions.size());
        if (is_new) {
            const auto columns = static_cast<std::int64_t>(columns_);
            result_.junctions.push_back({static_cast<int>(cell % columns) - 1, static_cast<int>(cell / columns) - 1});
        }
        return place->second;
    }

    void addLoop(const Walk& walk)
    {
        LabelLoop loop{walk.label, {}};
        const std::size_t n = walk.crossings.size();
        const auto first = static_cast<std::size_t>(
            std::find_if(walk.junctions.begin(), walk.junctions.end(), [](std::int64_t cell) { return cell >= 0; }) -
            walk.junctions.begin());
        if (first == n) {
            loop.arcs.push_back(useOf({walk.crossings, walk.label, 0, {}, {}}));
        } else {
            std::int64_t before = walk.junctions[first];
            LabelArc arc;
            for (std::size_t k = 1; k <= n; ++k) {
                const std::size_t i = (first + k) % n;
                arc.crossings.push_back(walk.crossings[i]);
                if (walk.junctions[i] >= 0) {
                    arc.left = walk.label;
                    arc.from = junctionAt(before);
                    arc.to = junctionAt(walk.junctions[i]);
                    before = walk.junctions[i];
                    loop.arcs.push_back(useOf(std::exchange(arc, {})));
                }
            }
        }
        result_.loops.push_back(std::move(loop));
    }

    /// The arc, added unless the label on the other side has added it.
    ArcUse useOf(LabelArc arc)
    {
        const Crossing& at = arc.crossings.front();
        const Step d = at.toward();
        arc.right = labels_.at(at.x + d.x, at.y + d.y);
        std::uint64_t key = std::min(edgeOf(arc.crossings.front()), edgeOf(arc.crossings.back()));
        if (!arc.from) {
            for (const Crossing& crossing : arc.crossings) {
                key = std::min(key, edgeOf(crossing));
            }
        }
        if (arc.right != 0 && arc.right < arc.left) {
            return {arc_of_.at(key), true};
        }
        arc_of_.emplace(key, result_.arcs.size());
        result_.arcs.push_back(std::move(arc));
        return {result_.arcs.size() - 1, false};
    }

    const LabelView& labels_;
    std::vector<std::uint8_t> visited_;
    std::uint64_t columns_;
    std::size_t length_ = 0;
    std::vector<Walk> walks_;
    LabelArcs result_;
    std::unordered_map<std::int64_t, std::size_t> junction_of_;
    std::unordered_map<std::uint64_t, std::size_t> arc_of_;
};

}  // namespace

LabelArcs followLabels(const LabelView& labels)
{
    return Follower(labels).follow();
}

}  // namespace droplet

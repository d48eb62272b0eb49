// SPDX-License-Identifier: GPL-3.0-or-later
// R. E. Tarjan, J. van Leeuwen, "Worst-case analysis of set union algorithms" (1984): path halving.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace droplet {

/// Disjoint sets of the numbers below a count. The smallest member of a set is its name.
class UnionFind {
public:
    explicit UnionFind(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
    /// @param parent  for each number itself or a smaller one of the same set
    explicit UnionFind(std::vector<std::uint32_t> parent) : parent_(std::move(parent)) {}

    /// Name of a number's set.
    std::uint32_t find(std::uint32_t a)
    {
        while (parent_[a] != a) {
            a = parent_[a] = parent_[parent_[a]];
        }
        return a;
    }

    /// Joins two sets. Returns false if they are one already.
    bool join(std::uint32_t a, std::uint32_t b)
    {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
        return a != b;
    }

private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace droplet

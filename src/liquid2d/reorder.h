// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "blocks.h"

namespace droplet {

/// Takes the values of `order`, in that order.
/// @param sorted  memory, whose values are lost
template <typename Value>
void reorder(std::vector<Value>& values, const std::vector<std::uint32_t>& order, std::vector<Value>& sorted)
{
    sorted.resize(order.size());
    forBlocks(order.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            sorted[k] = values[order[k]];
        }
    });
    values.swap(sorted);
}

template <typename Value>
void reorder(std::vector<Value>& values, const std::vector<std::uint32_t>& order)
{
    std::vector<Value> sorted;
    reorder(values, order, sorted);
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "blocks.h"

namespace droplet {

/// Takes the values of `order`, in that order.
template <typename Value>
void reorder(std::vector<Value>& values, const std::vector<std::uint32_t>& order)
{
    std::vector<Value> sorted(order.size());
    forBlocks(order.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            sorted[k] = values[order[k]];
        }
    });
    values = std::move(sorted);
}

}  // namespace droplet

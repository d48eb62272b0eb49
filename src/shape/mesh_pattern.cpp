// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape/mesh_pattern.h"

#include <algorithm>
#include <numeric>

namespace droplet {

MeshPattern::Gathering MeshPattern::gather(const std::vector<std::int32_t>& sum_of, std::size_t sums)
{
    Gathering result;
    result.starts.assign(sums + 1, 0);
    for (const std::int32_t sum : sum_of) {
        if (sum >= 0) {
            ++result.starts[static_cast<std::size_t>(sum) + 1];
        }
    }
    std::partial_sum(result.starts.begin(), result.starts.end(), result.starts.begin());
    result.parts.resize(static_cast<std::size_t>(result.starts.back()));
    std::vector<std::int32_t> next(result.starts.begin(), result.starts.end() - 1);
    for (std::size_t part = 0; part < sum_of.size(); ++part) {
        if (sum_of[part] >= 0) {
            const auto sum = static_cast<std::size_t>(sum_of[part]);
            result.parts[static_cast<std::size_t>(next[sum]++)] = static_cast<std::int32_t>(part);
        }
    }
    return result;
}

MeshPattern::MeshPattern(const std::vector<Triangle>& triangles, std::size_t vertices, std::uint32_t rim)
    : triangles_(triangles.size())
{
    const std::size_t unknowns = vertices - rim;
    const auto row_of = [&](std::uint32_t v) { return static_cast<std::int32_t>(v) - static_cast<std::int32_t>(rim); };
    std::vector<std::int32_t> corner_of;
    corner_of.reserve(3 * triangles.size());
    for (const Triangle& t : triangles) {
        for (const std::uint32_t v : t) {
            corner_of.push_back(static_cast<std::int32_t>(v));
        }
    }
    corners_ = gather(corner_of, vertices);

    // Rows of a column: its vertex, and those of its triangles with larger numbers.
    std::vector<int> outer{0};
    std::vector<int> inner;
    inner.reserve(4 * unknowns);
    outer.reserve(unknowns + 1);
    for (std::size_t v = rim; v < vertices; ++v) {
        const auto first = static_cast<std::ptrdiff_t>(inner.size());
        inner.push_back(row_of(static_cast<std::uint32_t>(v)));
        for (auto k = corners_.starts[v]; k < corners_.starts[v + 1]; ++k) {
            for (const std::uint32_t w :
                 triangles[static_cast<std::size_t>(corners_.parts[static_cast<std::size_t>(k)] / 3)]) {
                if (w > v) {
                    inner.push_back(row_of(w));
                }
            }
        }
        std::sort(inner.begin() + first, inner.end());
        inner.erase(std::unique(inner.begin() + first, inner.end()), inner.end());
        outer.push_back(static_cast<int>(inner.size()));
    }
    const std::vector<double> values(inner.size(), 0.0);
    const auto size = static_cast<Eigen::Index>(unknowns);
    empty_ = Eigen::Map<const Eigen::SparseMatrix<double>>(size, size, static_cast<Eigen::Index>(inner.size()),
                                                           outer.data(), inner.data(), values.data());

    std::vector<std::int32_t> entry_of;
    entry_of.reserve(6 * triangles.size());
    for (const Triangle& t : triangles) {
        for (const auto& [a, b] : kPairs) {
            const std::int32_t i = row_of(t[a]);
            const std::int32_t j = row_of(t[b]);
            std::int32_t entry = -1;
            if (i >= 0 && j >= 0) {
                const auto column = static_cast<std::size_t>(std::min(i, j));
                entry = static_cast<std::int32_t>(
                    std::lower_bound(inner.begin() + outer[column], inner.begin() + outer[column + 1], std::max(i, j)) -
                    inner.begin());
            }
            entry_of.push_back(entry);
        }
    }
    entries_ = gather(entry_of, inner.size());
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "blocks.h"
#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// Entries of the symmetric matrices of a mesh, with one unknown for every vertex inside. Sums over triangles are made
/// in parallel, and in the same order at any number of threads.
class MeshPattern {
public:
    /// Pairs of a triangle's corners with an entry: each with itself, then each with the next one.
    static constexpr std::array<std::array<std::size_t, 2>, 6> kPairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
    /// Contributions of a triangle, one for each of kPairs.
    using Element = std::array<double, kPairs.size()>;

    /// @param rim  number of vertices on the rim, which come first and are no unknowns
    MeshPattern(const std::vector<Triangle>& triangles, std::size_t vertices, std::uint32_t rim);

    /// Lower triangle with the entries that may differ from 0, all 0.
    [[nodiscard]] const Eigen::SparseMatrix<double>& empty() const { return empty_; }

    /// Lower triangle of a matrix.
    /// @param element  gives the Element of a triangle, by its number
    template <typename ElementOf>
    [[nodiscard]] Eigen::SparseMatrix<double> assemble(const ElementOf& element) const
    {
        std::vector<Element> parts(triangles_);
        forBlocks(
            triangles_,
            [&](std::size_t begin, std::size_t end) {
                for (std::size_t k = begin; k < end; ++k) {
                    parts[k] = element(k);
                }
            },
            kTriangles);
        Eigen::SparseMatrix<double> matrix = empty_;
        double* const values = matrix.valuePtr();
        forEachSum(entries_, [&](std::size_t entry, std::size_t part) {
            values[entry] += parts[part / kPairs.size()][part % kPairs.size()];
        });
        return matrix;
    }

    /// Calls add(vertex, triangle, corner) for every corner of every triangle, in parallel over vertices.
    template <typename Add>
    void forEachCorner(const Add& add) const
    {
        forEachSum(corners_, [&](std::size_t vertex, std::size_t part) { add(vertex, part / 3, part % 3); });
    }

    /// Triangles of a block: some 0.1 ms of work.
    static constexpr std::size_t kTriangles = 2048;

private:
    /// Lists of what adds up to every one of many sums.
    struct Gathering {
        std::vector<std::int32_t> starts;
        std::vector<std::int32_t> parts;  ///< in ascending order
    };
    /// @param sum_of  of every part, −1 for none
    static Gathering gather(const std::vector<std::int32_t>& sum_of, std::size_t sums);

    template <typename Add>
    static void forEachSum(const Gathering& gathering, const Add& add)
    {
        forBlocks(
            gathering.starts.size() - 1,
            [&](std::size_t begin, std::size_t end) {
                for (std::size_t sum = begin; sum < end; ++sum) {
                    for (auto k = gathering.starts[sum]; k < gathering.starts[sum + 1]; ++k) {
                        add(sum, static_cast<std::size_t>(gathering.parts[static_cast<std::size_t>(k)]));
                    }
                }
            },
            kTriangles);
    }

    std::size_t triangles_;
    Eigen::SparseMatrix<double> empty_;
    Gathering entries_;  ///< for values of the matrix: six times a triangle and a pair of its corners
    Gathering corners_;  ///< for vertices: three times a triangle and its corner
};

}  // namespace droplet

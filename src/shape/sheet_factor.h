// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// LDLᵀ of symmetric matrices with the pattern of a surface mesh, without pivoting; D is diagonal, and its signs are
/// those of the eigenvalues.
///
/// Guarantees: the same input gives the same bits at any number of threads.
class SheetFactor {
public:
    SheetFactor() = default;

    /// Orders the unknowns.
    /// @param lower   lower triangle with its diagonal; the values do not count
    /// @param places  of the unknowns in space; near ones are coupled
    SheetFactor(const Eigen::SparseMatrix<double>& lower, const std::vector<Vec3>& places);

    /// Factorises a matrix.
    /// @param lower  lower triangle, with the pattern that was ordered
    /// @return       false if a pivot is 0 or not finite
    bool factorize(const Eigen::SparseMatrix<double>& lower);

    /// Number of negative pivots.
    [[nodiscard]] std::size_t negatives() const;

    /// Solves with the last matrix.
    [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

    /// Number of entries of L.
    [[nodiscard]] std::size_t entryCount() const { return panel_size_; }

private:
    /// Dense part: columns that are eliminated together, and the rows below that they touch.
    struct Front {
        std::int32_t begin = 0;  ///< first own column in the order of elimination
        std::int32_t end = 0;
        std::int32_t left = -1;  ///< parts that are eliminated before
        std::int32_t right = -1;
        std::size_t first_row = 0;    ///< its rows below in rows_
        std::size_t row_count = 0;    ///< number of them
        std::size_t first_panel = 0;  ///< its columns of L in panels_
        std::size_t first_entry = 0;  ///< its entries of the matrix in entries_
        std::size_t last_entry = 0;
        std::size_t size = 0;  ///< unknowns of it and of all parts before

        [[nodiscard]] std::size_t columns() const { return static_cast<std::size_t>(end - begin); }
        [[nodiscard]] std::size_t height() const { return columns() + row_count; }
    };
    struct Entry {
        std::int32_t from = 0;  ///< in the values of the matrix
        std::int32_t to = 0;    ///< in the panel
    };
    /// Unknowns that one is coupled to.
    struct Neighbours {
        std::vector<std::int32_t> starts;
        std::vector<Entry> entries;  ///< from: in the values of the matrix; to: the other unknown
    };

    static Neighbours neighboursOf(const Eigen::SparseMatrix<double>& lower);
    /// Unknown and its place.
    struct Node {
        Vec3 place;
        std::int32_t unknown = 0;
    };
    /// Orders the nodes of a range, and adds the fronts of its parts.
    /// @return  that of the last one, −1 without nodes
    std::int32_t dissect(std::int32_t begin, std::int32_t end, const Neighbours& near, std::vector<Node>& nodes,
                         std::vector<Front>& fronts);
    void findRows(const Neighbours& near);
    void findEntries(const Neighbours& near);
    /// Calls work(front) for a front and all before it, those before first, in parallel where it pays.
    template <typename Work>
    void climb(std::int32_t front, const Work& work) const;
    template <typename Work>
    void descend(std::int32_t front, const Work& work) const;
    bool eliminate(const Front& front, const double* values, std::vector<std::vector<double>>& updates);
    void add(const Front& child, std::vector<double>& update, const Front& front, double* panel,
             std::vector<double>& sum) const;

    std::vector<std::int32_t> order_;     ///< unknowns in the order of elimination
    std::vector<std::int32_t> position_;  ///< of every unknown in it
    std::vector<Front> fronts_;           ///< parts come before what they are parts of
    std::vector<std::int32_t> rows_;
    std::vector<std::int32_t> above_;  ///< of every row in rows_: its row in the front that this one is a part of
    std::vector<Entry> entries_;
    std::unique_ptr<double[]> panels_;  ///< columns of L, with D on its diagonal
    std::size_t panel_size_ = 0;
};

}  // namespace droplet

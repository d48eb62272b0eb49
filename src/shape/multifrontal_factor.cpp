// SPDX-License-Identifier: GPL-3.0-or-later
// A. George, "Nested dissection of a regular finite element mesh", SIAM J. Numer. Anal. 10 (1973): halves of the mesh
// are eliminated before what separates them. J. Liu, "The multifrontal method for sparse matrix solution", SIAM Review
// 34 (1992). Departure: no pivoting, because the inertia of the matrix itself is wanted.
#include <tbb/parallel_invoke.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "blocks.h"
#include "shape/symmetric_factor.h"

namespace droplet {
namespace {

/// Unknowns that are not dissected further.
constexpr std::int32_t kLeaf = 12;
/// Unknowns on the edge of a half, over the root of their number, from which on other directions are tried. Discs,
/// letters and beads have up to 3.5; noise 4 mm deep under a splash of 1 mm had 40, and a factorisation took thirty
/// times as long.
constexpr double kLongEdge = 4.0;
/// Columns that are eliminated before the others are updated.
constexpr std::size_t kColumns = 32;
/// Unknowns from which on the parts of a front are worth a thread.
constexpr std::size_t kParallel = 1000;
/// Fronts of a block: some 0.1 ms of work.
constexpr std::size_t kFronts = 256;

using Matrix = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
using Vector = Eigen::Map<Eigen::VectorXd>;

Matrix block(double* data, std::size_t rows, std::size_t columns, std::size_t stride)
{
    return {data, static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns),
            Eigen::OuterStride<>(static_cast<Eigen::Index>(stride))};
}

Eigen::Index index(std::size_t i)
{
    return static_cast<Eigen::Index>(i);
}

class MultifrontalFactor final : public SymmetricFactor {
public:
    MultifrontalFactor(const Eigen::SparseMatrix<double>& lower, const std::vector<Vec3>& places);

    bool factorize(const Eigen::SparseMatrix<double>& lower) override;
    [[nodiscard]] std::size_t negatives() const override;
    [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right) const override;
    [[nodiscard]] const char* method() const override { return "multifrontal-ldlt"; }

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

MultifrontalFactor::MultifrontalFactor(const Eigen::SparseMatrix<double>& lower, const std::vector<Vec3>& places)
{
    const auto size = static_cast<std::int32_t>(lower.cols());
    const Neighbours near = neighboursOf(lower);
    std::vector<Node> nodes;
    nodes.reserve(places.size());
    for (std::int32_t i = 0; i < size; ++i) {
        nodes.push_back({places[static_cast<std::size_t>(i)], i});
    }
    position_.resize(nodes.size());
    dissect(0, size, near, nodes, fronts_);
    order_.reserve(nodes.size());
    for (const Node& node : nodes) {
        order_.push_back(node.unknown);
    }
    findRows(near);
    findEntries(near);
}

MultifrontalFactor::Neighbours MultifrontalFactor::neighboursOf(const Eigen::SparseMatrix<double>& lower)
{
    const auto size = static_cast<std::size_t>(lower.cols());
    const int* outer = lower.outerIndexPtr();
    const int* inner = lower.innerIndexPtr();
    Neighbours near;
    near.starts.assign(size + 1, 0);
    for (std::size_t column = 0; column < size; ++column) {
        for (int k = outer[column]; k < outer[column + 1]; ++k) {
            const auto row = static_cast<std::size_t>(inner[k]);
            ++near.starts[column + 1];
            near.starts[row + 1] += row != column ? 1 : 0;
        }
    }
    for (std::size_t i = 0; i < size; ++i) {
        near.starts[i + 1] += near.starts[i];
    }
    near.entries.resize(static_cast<std::size_t>(near.starts[size]));
    std::vector<std::int32_t> next(near.starts.begin(), near.starts.end() - 1);
    for (std::size_t column = 0; column < size; ++column) {
        for (int k = outer[column]; k < outer[column + 1]; ++k) {
            const auto row = static_cast<std::size_t>(inner[k]);
            near.entries[static_cast<std::size_t>(next[column]++)] = {k, inner[k]};
            if (row != column) {
                near.entries[static_cast<std::size_t>(next[row]++)] = {k, static_cast<std::int32_t>(column)};
            }
        }
    }
    return near;
}

std::int32_t MultifrontalFactor::dissect(std::int32_t begin, std::int32_t end, const Neighbours& near,
                                         std::vector<Node>& nodes, std::vector<Front>& fronts)
{
    if (begin == end) {
        return -1;
    }
    Front front{begin, end};
    front.size = static_cast<std::size_t>(end - begin);
    const auto first = nodes.begin() + begin;
    const auto last = nodes.begin() + end;
    const auto renumber = [&] {
        for (auto node = first; node != last; ++node) {
            position_[static_cast<std::size_t>(node->unknown)] = static_cast<std::int32_t>(node - nodes.begin());
        }
    };
    if (end - begin > kLeaf) {
        Vec3 least = first->place;
        Vec3 most = least;
        for (auto node = first; node != last; ++node) {
            const Vec3& p = node->place;
            least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
            most = {std::max(most.x, p.x), std::max(most.y, p.y), std::max(most.z, p.z)};
        }
        const Vec3 size = most - least;
        const std::int32_t half = begin + (end - begin) / 2;
        const auto middle = nodes.begin() + half;
        const auto halve = [&](double Vec3::*axis) {
            std::nth_element(first, middle, last, [&](const Node& one, const Node& other) {
                const double a = one.place.*axis;
                const double b = other.place.*axis;
                return a != b ? a < b : one.unknown < other.unknown;
            });
        };
        // Neighbours of a node are in the range, or are eliminated after it, and do not move any more.
        const auto touches = [&](const Node& node, std::int32_t from, std::int32_t to) {
            const auto i = static_cast<std::size_t>(node.unknown);
            const auto here = near.entries.begin();
            return std::any_of(here + near.starts[i], here + near.starts[i + 1], [&](const Entry& entry) {
                const std::int32_t there = position_[static_cast<std::size_t>(entry.to)];
                return there >= from && there < to;
            });
        };
        auto left_edge = middle;
        auto right_edge = last;
        // What separates the halves is the edge of one of them, the shorter one.
        const auto separate = [&](double Vec3::*axis) {
            halve(axis);
            renumber();
            left_edge = std::partition(first, middle, [&](const Node& node) { return !touches(node, half, end); });
            right_edge = std::partition(middle, last, [&](const Node& node) { return !touches(node, begin, half); });
            return std::min(middle - left_edge, last - right_edge);
        };
        // Across its longest side, unless the surface goes to and fro there, as over rough ground.
        std::array<double Vec3::*, 3> axes{&Vec3::x, &Vec3::y, &Vec3::z};
        std::stable_sort(axes.begin(), axes.end(), [&](auto one, auto other) { return size.*one > size.*other; });
        auto shortest = separate(axes.front());
        if (static_cast<double>(shortest) > kLongEdge * std::sqrt(static_cast<double>(end - begin))) {
            std::size_t best = 0;
            for (std::size_t k = 1; k < axes.size(); ++k) {
                const auto other = separate(axes[k]);
                best = other < shortest ? k : best;
                shortest = std::min(shortest, other);
            }
            if (best + 1 != axes.size()) {
                separate(axes[best]);
            }
        }
        std::int32_t split = half;
        if (middle - left_edge <= last - right_edge) {
            split = static_cast<std::int32_t>(left_edge - nodes.begin());
            front.begin = end - static_cast<std::int32_t>(middle - left_edge);
            std::rotate(left_edge, middle, last);
        } else {
            front.begin = static_cast<std::int32_t>(right_edge - nodes.begin());
        }
        renumber();
        if (front.size >= kParallel) {
            std::vector<Front> others;
            tbb::parallel_invoke([&] { front.left = dissect(begin, split, near, nodes, fronts); },
                                 [&] { front.right = dissect(split, front.begin, near, nodes, others); });
            const auto before = static_cast<std::int32_t>(fronts.size());
            for (Front& other : others) {
                other.left += other.left >= 0 ? before : 0;
                other.right += other.right >= 0 ? before : 0;
                fronts.push_back(other);
            }
            front.right += front.right >= 0 ? before : 0;
        } else {
            front.left = dissect(begin, split, near, nodes, fronts);
            front.right = dissect(split, front.begin, near, nodes, fronts);
        }
    } else {
        renumber();
    }
    fronts.push_back(front);
    return static_cast<std::int32_t>(fronts.size()) - 1;
}

void MultifrontalFactor::findRows(const Neighbours& near)
{
    std::vector<std::int32_t> seen(order_.size(), -1);
    std::size_t panel = 0;
    for (std::size_t f = 0; f < fronts_.size(); ++f) {
        Front& front = fronts_[f];
        front.first_row = rows_.size();
        const auto take = [&](std::int32_t row) {
            if (row >= front.end && seen[static_cast<std::size_t>(row)] != static_cast<std::int32_t>(f)) {
                seen[static_cast<std::size_t>(row)] = static_cast<std::int32_t>(f);
                rows_.push_back(row);
            }
        };
        for (std::int32_t column = front.begin; column < front.end; ++column) {
            const auto i = static_cast<std::size_t>(order_[static_cast<std::size_t>(column)]);
            for (auto k = static_cast<std::size_t>(near.starts[i]); k < static_cast<std::size_t>(near.starts[i + 1]);
                 ++k) {
                take(position_[static_cast<std::size_t>(near.entries[k].to)]);
            }
        }
        for (const std::int32_t c : {front.left, front.right}) {
            if (c >= 0) {
                const Front& child = fronts_[static_cast<std::size_t>(c)];
                for (std::size_t k = 0; k < child.row_count; ++k) {
                    take(rows_[child.first_row + k]);
                }
            }
        }
        front.row_count = rows_.size() - front.first_row;
        std::sort(rows_.begin() + index(front.first_row), rows_.end());
        front.first_panel = panel;
        panel += front.columns() * front.height();
    }
    panel_size_ = panel;
    panels_ = std::make_unique_for_overwrite<double[]>(panel);
    above_.resize(rows_.size());
    for (const Front& front : fronts_) {
        for (const std::int32_t c : {front.left, front.right}) {
            if (c < 0) {
                continue;
            }
            const Front& child = fronts_[static_cast<std::size_t>(c)];
            std::size_t at = 0;
            for (std::size_t k = child.first_row; k < child.first_row + child.row_count; ++k) {
                if (rows_[k] < front.end) {
                    above_[k] = rows_[k] - front.begin;
                    continue;
                }
                while (rows_[front.first_row + at] != rows_[k]) {
                    ++at;
                }
                above_[k] = static_cast<std::int32_t>(front.columns() + at);
            }
        }
    }
}

void MultifrontalFactor::findEntries(const Neighbours& near)
{
    // Of every column, the entries on the diagonal and below.
    const auto for_entries = [&](const Front& front, const auto& use) {
        for (std::int32_t column = front.begin; column < front.end; ++column) {
            const auto i = static_cast<std::size_t>(order_[static_cast<std::size_t>(column)]);
            for (auto k = static_cast<std::size_t>(near.starts[i]); k < static_cast<std::size_t>(near.starts[i + 1]);
                 ++k) {
                const std::int32_t row = position_[static_cast<std::size_t>(near.entries[k].to)];
                if (row >= column) {
                    use(near.entries[k].from, row, column - front.begin);
                }
            }
        }
    };
    forBlocks(
        fronts_.size(),
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t f = begin; f < end; ++f) {
                fronts_[f].last_entry = 0;
                for_entries(fronts_[f], [&](auto, auto, auto) { ++fronts_[f].last_entry; });
            }
        },
        kFronts);
    std::size_t count = 0;
    for (Front& front : fronts_) {
        front.first_entry = count;
        count += front.last_entry;
        front.last_entry = count;
    }
    entries_.resize(count);
    forBlocks(
        fronts_.size(),
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t f = begin; f < end; ++f) {
                const Front& front = fronts_[f];
                const auto own = static_cast<std::int32_t>(front.columns());
                const auto height = static_cast<std::int32_t>(front.height());
                const auto first = rows_.begin() + index(front.first_row);
                const auto last = first + index(front.row_count);
                std::size_t next = front.first_entry;
                for_entries(front, [&](std::int32_t from, std::int32_t row, std::int32_t column) {
                    const std::int32_t at =
                        row < front.end ? row - front.begin
                                        : own + static_cast<std::int32_t>(std::lower_bound(first, last, row) - first);
                    entries_[next++] = {from, at + column * height};
                });
            }
        },
        kFronts);
}

template <typename Work>
void MultifrontalFactor::climb(std::int32_t at, const Work& work) const
{
    if (at < 0) {
        return;
    }
    const Front& front = fronts_[static_cast<std::size_t>(at)];
    if (front.size >= kParallel) {
        tbb::parallel_invoke([&] { climb(front.left, work); }, [&] { climb(front.right, work); });
        work(at);
    } else {
        climb(front.left, work);
        climb(front.right, work);
        work(at);
    }
}

template <typename Work>
void MultifrontalFactor::descend(std::int32_t at, const Work& work) const
{
    if (at < 0) {
        return;
    }
    const Front& front = fronts_[static_cast<std::size_t>(at)];
    work(at);
    if (front.size >= kParallel) {
        tbb::parallel_invoke([&] { descend(front.left, work); }, [&] { descend(front.right, work); });
    } else {
        descend(front.left, work);
        descend(front.right, work);
    }
}

void MultifrontalFactor::add(const Front& child, std::vector<double>& update, const Front& front, double* panel,
                             std::vector<double>& sum) const
{
    const std::size_t own = front.columns();
    const std::int32_t* above = above_.data() + child.first_row;
    for (std::size_t a = 0; a < child.row_count; ++a) {
        const double* from = update.data() + a * child.row_count;
        const auto column = static_cast<std::size_t>(above[a]);
        if (column < own) {
            double* to = panel + column * front.height();
            for (std::size_t b = a; b < child.row_count; ++b) {
                to[above[b]] += from[b];
            }
        } else {
            double* to = sum.data() + (column - own) * front.row_count;
            for (std::size_t b = a; b < child.row_count; ++b) {
                to[static_cast<std::size_t>(above[b]) - own] += from[b];
            }
        }
    }
    std::vector<double>().swap(update);
}

bool MultifrontalFactor::eliminate(const Front& front, const double* values, std::vector<std::vector<double>>& updates)
{
    const std::size_t own = front.columns();
    const std::size_t height = front.height();
    const std::size_t below = front.row_count;
    double* panel = panels_.get() + front.first_panel;
    std::fill(panel, panel + own * height, 0.0);
    for (std::size_t k = front.first_entry; k < front.last_entry; ++k) {
        panel[entries_[k].to] = values[entries_[k].from];
    }
    std::vector<double>& sum = updates[static_cast<std::size_t>(&front - fronts_.data())];
    sum.assign(below * below, 0.0);
    for (const std::int32_t c : {front.left, front.right}) {
        if (c >= 0) {
            add(fronts_[static_cast<std::size_t>(c)], updates[static_cast<std::size_t>(c)], front, panel, sum);
        }
    }
    const auto column = [&](std::size_t j, std::size_t from) {
        return Vector(panel + j * height + from, index(height - from));
    };
    for (std::size_t begin = 0; begin < own; begin += kColumns) {
        const std::size_t end = std::min(begin + kColumns, own);
        for (std::size_t j = begin; j < end; ++j) {
            const double pivot = panel[j * height + j];
            if (!(std::abs(pivot) > 0.0) || !std::isfinite(pivot)) {
                return false;
            }
            for (std::size_t k = j + 1; k < end; ++k) {
                const double factor = panel[j * height + k] / pivot;
                column(k, k) -= factor * column(j, k);
            }
            column(j, j + 1) *= 1.0 / pivot;
        }
        if (end < own) {
            const Matrix done = block(panel + begin * height + end, height - end, end - begin, height);
            Eigen::MatrixXd scaled = done.topRows(index(own - end));
            for (std::size_t j = begin; j < end; ++j) {
                scaled.col(index(j - begin)) *= panel[j * height + j];
            }
            block(panel + end * height + end, height - end, own - end, height).noalias() -= done * scaled.transpose();
        }
    }
    if (below > 0 && own > 0) {  // nothing may separate two pieces
        Matrix rest = block(sum.data(), below, below, below);
        const Matrix done = block(panel + own, below, own, height);
        Eigen::MatrixXd scaled = done;
        for (std::size_t j = 0; j < own; ++j) {
            scaled.col(index(j)) *= panel[j * height + j];
        }
        rest.triangularView<Eigen::Lower>() -= done * scaled.transpose();
    }
    return true;
}

bool MultifrontalFactor::factorize(const Eigen::SparseMatrix<double>& lower)
{
    std::vector<std::vector<double>> updates(fronts_.size());
    std::atomic<bool> is_regular = true;
    climb(static_cast<std::int32_t>(fronts_.size()) - 1, [&](std::int32_t f) {
        if (is_regular && !eliminate(fronts_[static_cast<std::size_t>(f)], lower.valuePtr(), updates)) {
            is_regular = false;
        }
    });
    return is_regular;
}

std::size_t MultifrontalFactor::negatives() const
{
    std::size_t count = 0;
    for (const Front& front : fronts_) {
        for (std::size_t j = 0; j < front.columns(); ++j) {
            count += panels_[front.first_panel + j * (front.height() + 1)] < 0.0 ? 1 : 0;
        }
    }
    return count;
}

Eigen::VectorXd MultifrontalFactor::solve(const Eigen::VectorXd& right) const
{
    Eigen::VectorXd x(right.size());
    std::vector<double> passed(rows_.size());  // what a front passes on to rows below
    const auto top = static_cast<std::int32_t>(fronts_.size()) - 1;
    climb(top, [&](std::int32_t f) {
        const Front& front = fronts_[static_cast<std::size_t>(f)];
        const std::size_t own = front.columns();
        const std::size_t height = front.height();
        double* sum = passed.data() + front.first_row;
        std::fill(sum, sum + front.row_count, 0.0);
        double* here = x.data() + front.begin;
        for (std::size_t j = 0; j < own; ++j) {
            here[j] = right[order_[static_cast<std::size_t>(front.begin) + j]];
        }
        for (const std::int32_t c : {front.left, front.right}) {
            if (c >= 0) {
                const Front& child = fronts_[static_cast<std::size_t>(c)];
                for (std::size_t k = child.first_row; k < child.first_row + child.row_count; ++k) {
                    const auto at = static_cast<std::size_t>(above_[k]);
                    (at < own ? here[at] : sum[at - own]) += passed[k];
                }
            }
        }
        const double* panel = panels_.get() + front.first_panel;
        for (std::size_t j = 0; j < own; ++j) {
            const double value = here[j];
            const double* l = panel + j * height;
            for (std::size_t i = j + 1; i < own; ++i) {
                here[i] -= l[i] * value;
            }
            for (std::size_t i = 0; i < front.row_count; ++i) {
                sum[i] -= l[own + i] * value;
            }
        }
    });
    descend(top, [&](std::int32_t f) {
        const Front& front = fronts_[static_cast<std::size_t>(f)];
        const std::size_t own = front.columns();
        const std::size_t height = front.height();
        double* below = passed.data() + front.first_row;
        for (std::size_t k = 0; k < front.row_count; ++k) {
            below[k] = x[rows_[front.first_row + k]];
        }
        double* here = x.data() + front.begin;
        const double* panel = panels_.get() + front.first_panel;
        for (std::size_t j = own; j-- > 0;) {
            const double* l = panel + j * height;
            double value = here[j] / l[j];
            value -= Eigen::Map<const Eigen::VectorXd>(l + own, index(front.row_count))
                         .dot(Eigen::Map<const Eigen::VectorXd>(below, index(front.row_count)));
            for (std::size_t i = j + 1; i < own; ++i) {
                value -= l[i] * here[i];
            }
            here[j] = value;
        }
    });
    Eigen::VectorXd result(right.size());
    for (std::size_t k = 0; k < order_.size(); ++k) {
        result[order_[k]] = x[index(k)];
    }
    return result;
}

}  // namespace

std::unique_ptr<SymmetricFactor> multifrontalFactor(const Eigen::SparseMatrix<double>& lower,
                                                    const std::vector<Vec3>& places)
{
    return std::make_unique<MultifrontalFactor>(lower, places);
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
// Batty, Bridson: Accurate viscous free surfaces for buckling, coiling, and rotating liquids. SCA 2008: the velocities
// after the step make the sum of their change's energy and of what viscosity takes in it the least. Stresses that are
// not in the sum, at the surface and along walls, are zero thereby. So liquid turns and falls as it does without
// viscosity.
#include "grid_viscosity.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace droplet {
namespace {

/// Least mass of a side, in parts of a cell's.
constexpr double kLeastMass = 0.05;

/// Unknown velocities, and the quadratic form of them.
class Form {
public:
    Form(const GridShape& grid, double rate, const ViscousSides& sides) : rate_(rate), sides_(sides)
    {
        across_ = numbersOf(sides.has_across);
        up_ = numbersOf(sides.has_up);
        for (std::size_t row = 1; row + 1 < grid.rows; ++row) {
            for (std::size_t column = 1; column + 1 < grid.columns; ++column) {
                const std::size_t k = grid.at(column, row);
                const std::size_t left = k + row;
                addMass(across_[left], part(k - 1, k), sides.across[left]);
                addMass(up_[k], part(k - grid.columns, k), sides.up[k]);
                // Stretch along each axis: 2 D².
                addStress(2.0 * part(k, k),
                          std::array{std::pair{across_[left], -1.0}, std::pair{across_[left + 1], 1.0}});
                addStress(2.0 * part(k, k), std::array{std::pair{up_[k], -1.0}, std::pair{up_[k + grid.columns], 1.0}});
                // Shear, at the lower left corner: 4 D² with D half of the sum.
                const double volume = 0.5 * (part(k, k - 1) + part(k - grid.columns, k - grid.columns - 1));
                addStress(volume,
                          std::array{std::pair{across_[left], 1.0}, std::pair{across_[left - grid.columns - 1], -1.0},
                                     std::pair{up_[k], 1.0}, std::pair{up_[k - 1], -1.0}});
            }
        }
    }

    /// Puts the least form's velocities into the sides.
    void solve()
    {
        const auto count = static_cast<Eigen::Index>(momentum_.size());
        Eigen::SparseMatrix<double> matrix(count, count);
        matrix.setFromTriplets(entries_.begin(), entries_.end());
        const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
        if (count == 0 || factor.info() != Eigen::Success) {
            return;
        }
        const Eigen::VectorXd velocity = factor.solve(Eigen::Map<const Eigen::VectorXd>(momentum_.data(), count));
        for (auto [numbers, values] : {std::pair{&across_, &sides_.across}, std::pair{&up_, &sides_.up}}) {
            for (std::size_t k = 0; k < values->size(); ++k) {
                if ((*numbers)[k] != kNone) {
                    (*values)[k] = velocity[(*numbers)[k]];
                }
            }
        }
    }

private:
    static constexpr int kNone = -1;

    std::vector<int> numbersOf(const std::vector<std::uint8_t>& has)
    {
        std::vector<int> numbers(has.size(), kNone);
        for (std::size_t k = 0; k < has.size(); ++k) {
            if (has[k] != 0) {
                numbers[k] = static_cast<int>(momentum_.size());
                momentum_.push_back(0.0);
            }
        }
        return numbers;
    }

    /// Mean liquid part of two cells.
    [[nodiscard]] double part(std::size_t a, std::size_t b) const
    {
        return 0.5 * (std::min(sides_.filled[a], 1.0) + std::min(sides_.filled[b], 1.0));
    }

    void addMass(int number, double mass, double velocity)
    {
        if (number != kNone) {
            const double all = std::max(mass, kLeastMass);
            entries_.emplace_back(number, number, all);
            momentum_[static_cast<std::size_t>(number)] = all * velocity;
        }
    }

    template <std::size_t kCount>
    void addStress(double factor, const std::array<std::pair<int, double>, kCount>& sum)
    {
        if (!(factor > 0.0) ||
            std::any_of(sum.begin(), sum.end(), [](const auto& term) { return term.first == kNone; })) {
            return;
        }
        for (const auto& [a, by_a] : sum) {
            for (const auto& [b, by_b] : sum) {
                entries_.emplace_back(a, b, rate_ * factor * by_a * by_b);
            }
        }
    }

    double rate_;
    const ViscousSides& sides_;
    std::vector<int> across_;
    std::vector<int> up_;
    std::vector<double> momentum_;
    std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace

void applyViscosity(const GridShape& grid, double rate, const ViscousSides& sides)
{
    Form(grid, rate, sides).solve();
}

}  // namespace droplet

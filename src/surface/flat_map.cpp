// SPDX-License-Identifier: GPL-3.0-or-later
//
// The energy, and its regularisation that begins at maps with folds: V. Garanzha, I. Kaporin, L. Kudryavtseva,
// F. Protais, N. Ray, D. Sokolov, "Foldover-free maps in 50 lines of code", ACM Trans. Graph. 40 (2021). Newton's
// method takes the positive part of every triangle's Hessian: J. Teran, E. Sifakis, G. Irving, R. Fedkiw, "Robust
// quasistatic finite elements and flesh simulation" (2005). Where nothing folds, the harmonic map's matrix
// preconditions L-BFGS: Y. Zhu, R. Bridson, D. M. Kaufman, "Blended cured quasi-Newton for distortion optimization",
// ACM Trans. Graph. 37 (2018). Steps end before a triangle turns over: J. Smith, S. Schaefer, "Bijective
// parameterization with free boundaries", ACM Trans. Graph. 34 (2015).
//
// A map of triangles with a simple boundary that stays, whose triangles are all counter-clockwise, covers the inside
// once: the number of triangles over a point is the winding number of the boundary.
#include "surface/flat_map.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "shape/area_vector.h"
#include "shape/symmetric_factor.h"

namespace droplet {
namespace {

using Places = Eigen::Matrix<double, Eigen::Dynamic, 2>;
using Sparse = Eigen::SparseMatrix<double>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Width of a wanted triangle along its slope, over that in space, which steep ones have at least. Beads of 140° and
/// 160° then have a mean stretch of 1.8 and 2.1, against 2.9 and 3.2 with 0.1; above, parts that are not steep leave
/// the vertical projection more and more.
constexpr double kNarrowest = 0.4;

/// Share of folded triangles up to which the vertical projection is mended around them, from the harmonic map there, so
/// that a picture stays straight elsewhere; liquid that leans out farther is spread as a whole.
constexpr double kFewFolds = 0.1;
/// Folded triangles get these rings of free neighbours around them, then twice as many, up to these where the vertical
/// projection is mended, and up to these elsewhere.
constexpr int kFirstRings = 12;
constexpr int kNearRings = 24;
constexpr int kMostRings = 96;
/// First ε, and Newton's steps and rounds with a smaller ε for one number of rings.
constexpr double kFirstEpsilon = 0.1;
constexpr int kStepsPerRound = 6;
constexpr int kRounds = 40;
/// Smallest progress that the rule for ε assumes. With 0.1, as in the paper, ε falls too slowly for Newton's method;
/// with 0.75 it runs ahead, and 22 of 24 runs on six sheets stayed folded.
constexpr double kLeastProgress = 0.5;
/// Triangles in all of Newton's steps: about half a second.
constexpr std::size_t kMostWork = 300'000;
/// Steps that free a map of its narrowest triangles, once it has no folds.
constexpr int kRelaxingSteps = 5;
/// Part of the energy that a step must gain to be followed by another.
constexpr double kWorthwhile = 1e-3;

/// Triangle with the shape that it should have in the picture.
struct Wanted {
    Triangle corners{};
    std::array<Vec2, 3> slopes;  ///< gradients of the corners' hat functions
    double weight = 0.0;         ///< share of the area
};

/// Sides of the vertical projection, unfolded, and not narrower than a part of the triangle, in axes of its own.
std::array<Vec2, 2> wantedSides(const std::vector<Vec3>& places, const Triangle& t)
{
    const Vec3 area = areaVector(places, t);
    const Vec3 normal = (1.0 / length(area)) * area;
    const double tilt = std::hypot(normal.x, normal.y);
    const Vec3 level = tilt > 0.0 ? Vec3{-normal.y / tilt, normal.x / tilt, 0.0} : Vec3{1.0, 0.0, 0.0};
    const Vec3 slope = std::max(std::abs(normal.z), kNarrowest) * cross(normal, level);
    const Vec3 p = places[t[1]] - places[t[0]];
    const Vec3 q = places[t[2]] - places[t[0]];
    return {Vec2{dot(p, level), dot(p, slope)}, Vec2{dot(q, level), dot(q, slope)}};
}

std::vector<Wanted> wantedTriangles(const CapillarySurface& sheet)
{
    std::vector<Wanted> all;
    double total = 0.0;
    double footprint = 0.0;
    for (const Triangle& t : sheet.triangles) {
        const auto [p, q] = wantedSides(sheet.vertices, t);
        const double twice = cross(p, q);
        const Vec2 second{q.y / twice, -q.x / twice};
        const Vec2 third{-p.y / twice, p.x / twice};
        all.push_back({t, {-1.0 * (second + third), second, third}, 0.5 * twice});
        total += 0.5 * twice;
        footprint += areaVector(sheet.vertices, t).z;
    }
    // All have to share the footprint.
    const double scale = std::sqrt(total / footprint);
    for (Wanted& w : all) {
        w.weight /= total;
        for (Vec2& slope : w.slopes) {
            slope = scale * slope;
        }
    }
    return all;
}

Vec2 rowOf(const Places& places, std::uint32_t v)
{
    return {places(v, 0), places(v, 1)};
}

/// Derivatives of the map in a triangle.
struct Jacobian {
    Vec2 x;
    Vec2 y;

    [[nodiscard]] double determinant() const { return cross(x, y); }
};

Jacobian jacobianOf(const Places& at, const Wanted& w)
{
    Jacobian result;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 p = rowOf(at, w.corners[k]);
        result.x = result.x + w.slopes[k].x * p;
        result.y = result.y + w.slopes[k].y * p;
    }
    return result;
}

/// Energy of a triangle, (|J|² + d² + 1)/2χ, with d = det J and χ = (d + √(d² + ε²))/2, and its derivatives by d.
struct Density {
    double value = 0.0;
    double stiffness = 0.0;  ///< 1/χ
    double by_d = 0.0;       ///< with |J| fixed
    double by_dd = 0.0;
    double stiffness_by_d = 0.0;

    Density(const Jacobian& j, double epsilon)
    {
        const double d = j.determinant();
        const double root = std::sqrt(d * d + epsilon * epsilon);
        const double chi = 0.5 * (d + root);
        if (!(chi > 0.0)) {
            value = kInfinity;
            return;
        }
        const double chi_1 = epsilon > 0.0 ? 0.5 * (1.0 + d / root) : 1.0;
        const double chi_2 = epsilon > 0.0 ? 0.5 * epsilon * epsilon / (root * root * root) : 0.0;
        const double top = 0.5 * (dot(j.x, j.x) + dot(j.y, j.y) + d * d + 1.0);
        stiffness = 1.0 / chi;
        value = top / chi;
        stiffness_by_d = -chi_1 / (chi * chi);
        by_d = d / chi + top * stiffness_by_d;
        by_dd = 1.0 / chi + 2.0 * d * stiffness_by_d - top * chi_2 / (chi * chi) +
                2.0 * top * chi_1 * chi_1 / (chi * chi * chi);
    }
};

/// Solves for both coordinates.
Places solveBoth(const SymmetricFactor& factor, const Places& right)
{
    Places result(right.rows(), 2);
    result.col(0) = factor.solve(right.col(0));
    result.col(1) = factor.solve(right.col(1));
    return result;
}

class Flattening {
public:
    explicit Flattening(const CapillarySurface& sheet)
        : rim_(sheet.rimVertexCount()),
          places_(sheet.vertices),
          wanted_(wantedTriangles(sheet)),
          at_(sheet.vertices.size(), 2)
    {
        for (std::size_t v = 0; v < sheet.vertices.size(); ++v) {
            at_.row(static_cast<Eigen::Index>(v)) << sheet.vertices[v].x, sheet.vertices[v].y;
        }
        all_.resize(wanted_.size());
        std::iota(all_.begin(), all_.end(), 0U);
    }

    /// @return  whether the map has no folds
    bool run();
    [[nodiscard]] const Places& places() const { return at_; }

private:
    using Indices = std::vector<std::uint32_t>;

    [[nodiscard]] double energy(const Places& at, const Indices& triangles, double epsilon) const;
    [[nodiscard]] Places gradient(const Places& at, const Indices& triangles, double epsilon) const;
    [[nodiscard]] double leastDeterminant(const Indices& triangles) const;
    [[nodiscard]] double stepLimit(const Places& step, const Indices& triangles) const;
    /// Sets some vertices to the harmonic map between the wanted shapes and the picture.
    /// @param triangles  those that have one of them
    /// @return           the factors of its matrix; none if it cannot be factorised
    std::unique_ptr<SymmetricFactor> startHarmonic(const Indices& triangles, const std::vector<std::uint8_t>& is_free);
    /// Moves along a step while the energy falls. @return the new energy; empty if it does not fall
    std::optional<double> moveAlong(const Places& step, const Indices& triangles, double epsilon, double energy,
                                    double slope);
    /// Newton's method on some vertices.
    /// @param triangles  those that have one of them
    /// Ends when a step gains little; with ε > 0, also when no triangle is folded.
    void relax(const Indices& triangles, const std::vector<std::uint8_t>& is_free, double epsilon, int steps);
    /// Adds Newton's matrix of a triangle, of which negative eigenvalues are left out.
    void addHessian(const Wanted& w, double epsilon, const std::vector<int>& unknown,
                    std::vector<Eigen::Triplet<double>>& entries) const;
    /// Frees the vertices within some rings around folds, until there are none.
    /// @return  whether there are none
    bool untangle(int most_rings);
    /// L-BFGS on all vertices; the map has no folds.
    void flatten();

    std::uint32_t rim_;
    const std::vector<Vec3>& places_;  ///< in space
    std::vector<Wanted> wanted_;
    Places at_;
    Indices all_;
    std::unique_ptr<SymmetricFactor> harmonic_;  ///< of the map of all vertices
    std::size_t work_ = 0;                       ///< triangles in Newton's steps so far
};

double Flattening::energy(const Places& at, const Indices& triangles, double epsilon) const
{
    double sum = 0.0;
    for (const std::uint32_t i : triangles) {
        sum += wanted_[i].weight * Density(jacobianOf(at, wanted_[i]), epsilon).value;
    }
    return sum;
}

Places Flattening::gradient(const Places& at, const Indices& triangles, double epsilon) const
{
    Places result = Places::Zero(at.rows(), 2);
    for (const std::uint32_t i : triangles) {
        const Wanted& w = wanted_[i];
        const Jacobian j = jacobianOf(at, w);
        const Density density(j, epsilon);
        const Vec2 gx = w.weight * (density.stiffness * j.x + density.by_d * Vec2{j.y.y, -j.y.x});
        const Vec2 gy = w.weight * (density.stiffness * j.y + density.by_d * Vec2{-j.x.y, j.x.x});
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 g = w.slopes[k].x * gx + w.slopes[k].y * gy;
            result(w.corners[k], 0) += g.x;
            result(w.corners[k], 1) += g.y;
        }
    }
    result.topRows(rim_).setZero();
    return result;
}

double Flattening::leastDeterminant(const Indices& triangles) const
{
    double least = kInfinity;
    for (const std::uint32_t i : triangles) {
        least = std::min(least, jacobianOf(at_, wanted_[i]).determinant());
    }
    return least;
}

double Flattening::stepLimit(const Places& step, const Indices& triangles) const
{
    double limit = kInfinity;
    for (const std::uint32_t i : triangles) {
        // The determinant is a + bt + ct² after t steps.
        const Jacobian from = jacobianOf(at_, wanted_[i]);
        const Jacobian along = jacobianOf(step, wanted_[i]);
        const double a = from.determinant();
        const double b = cross(from.x, along.y) + cross(along.x, from.y);
        const double c = along.determinant();
        const double root = b * b - 4.0 * a * c;
        if (root >= 0.0 && -b + std::sqrt(root) > 0.0) {
            limit = std::min(limit, 2.0 * a / (-b + std::sqrt(root)));
        }
    }
    return limit;
}

std::unique_ptr<SymmetricFactor> Flattening::startHarmonic(const Indices& triangles,
                                                           const std::vector<std::uint8_t>& is_free)
{
    std::vector<int> unknown(is_free.size(), -1);
    std::vector<Vec3> places;
    for (std::size_t v = 0; v < is_free.size(); ++v) {
        if (is_free[v] != 0) {
            unknown[v] = static_cast<int>(places.size());
            places.push_back(places_[v]);
        }
    }
    const auto count = static_cast<Eigen::Index>(places.size());
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(6 * triangles.size());
    Places load = Places::Zero(count, 2);
    for (const std::uint32_t i : triangles) {
        const Wanted& w = wanted_[i];
        for (std::size_t j = 0; j < 3; ++j) {
            const int row = unknown[w.corners[j]];
            for (std::size_t k = 0; k < 3 && row >= 0; ++k) {
                const int column = unknown[w.corners[k]];
                const double entry = w.weight * dot(w.slopes[j], w.slopes[k]);
                if (column < 0) {
                    load.row(row) -= entry * at_.row(w.corners[k]);
                } else if (column <= row) {
                    entries.emplace_back(row, column, entry);
                }
            }
        }
    }
    Sparse matrix(count, count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    std::unique_ptr<SymmetricFactor> factor = multifrontalFactor(matrix, places);
    if (!factor->factorize(matrix)) {
        return nullptr;
    }
    const Places found = solveBoth(*factor, load);
    for (std::size_t v = 0; v < unknown.size(); ++v) {
        if (unknown[v] >= 0) {
            at_.row(static_cast<Eigen::Index>(v)) = found.row(unknown[v]);
        }
    }
    return factor;
}

std::optional<double> Flattening::moveAlong(const Places& step, const Indices& triangles, double epsilon, double before,
                                            double slope)
{
    if (!(slope < 0.0)) {
        return std::nullopt;
    }
    constexpr int kHalvings = 25;
    constexpr double kArmijo = 1e-4;
    double t = epsilon > 0.0 ? 1.0 : std::min(1.0, 0.9 * stepLimit(step, triangles));
    for (int k = 0; k < kHalvings; ++k, t *= 0.5) {
        const Places next = at_ + t * step;
        const double after = energy(next, triangles, epsilon);
        if (after <= before + kArmijo * t * slope) {
            at_ = next;
            return after;
        }
    }
    return std::nullopt;
}

void Flattening::addHessian(const Wanted& w, double epsilon, const std::vector<int>& unknown,
                            std::vector<Eigen::Triplet<double>>& entries) const
{
    using Eigen::Matrix4d;
    constexpr double kLeastEigenvalue = 1e-3;  // so that the matrix is not singular
    const Jacobian j = jacobianOf(at_, w);
    const Density density(j, epsilon);
    const Eigen::Vector4d place(j.x.x, j.x.y, j.y.x, j.y.y);
    const Eigen::Vector4d by_place(j.y.y, -j.y.x, -j.x.y, j.x.x);  // derivative of d
    Matrix4d hessian = density.stiffness * Matrix4d::Identity() + density.by_dd * by_place * by_place.transpose() +
                       density.stiffness_by_d * (place * by_place.transpose() + by_place * place.transpose());
    hessian(0, 3) += density.by_d;
    hessian(3, 0) += density.by_d;
    hessian(1, 2) -= density.by_d;
    hessian(2, 1) -= density.by_d;
    // Nearly all are positive as they are, which a factorisation tells sooner than the eigenvalues.
    const double least = kLeastEigenvalue * density.stiffness;
    if (Eigen::LLT<Matrix4d>(hessian - least * Matrix4d::Identity()).info() != Eigen::Success) {
        const Eigen::SelfAdjointEigenSolver<Matrix4d> eigen(hessian);
        hessian =
            eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(least).asDiagonal() * eigen.eigenvectors().transpose();
    }
    const Matrix4d positive = w.weight * hessian;
    for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = 0; b < 3; ++b) {
            const int row = unknown[w.corners[a]];
            const int column = unknown[w.corners[b]];
            if (column < 0 || column > row) {
                continue;
            }
            const Vec2 p = w.slopes[a];
            const Vec2 q = w.slopes[b];
            for (int r = 0; r < 2; ++r) {
                for (int c = 0; c < 2; ++c) {
                    if (column + c <= row + r) {
                        const double entry = p.x * q.x * positive(r, c) + p.x * q.y * positive(r, c + 2) +
                                             p.y * q.x * positive(r + 2, c) + p.y * q.y * positive(r + 2, c + 2);
                        entries.emplace_back(row + r, column + c, entry);
                    }
                }
            }
        }
    }
}

void Flattening::relax(const Indices& triangles, const std::vector<std::uint8_t>& is_free, double epsilon, int steps)
{
    std::vector<int> unknown(is_free.size(), -1);
    std::vector<Vec3> places;
    int count = 0;
    for (std::size_t v = 0; v < is_free.size(); ++v) {
        if (is_free[v] != 0) {
            unknown[v] = count;
            count += 2;
            places.insert(places.end(), 2, places_[v]);
        }
    }
    std::unique_ptr<SymmetricFactor> factor;
    double now = energy(at_, triangles, epsilon);
    for (int n = 0; n < steps; ++n) {
        work_ += triangles.size();
        std::vector<Eigen::Triplet<double>> entries;
        for (const std::uint32_t i : triangles) {
            addHessian(wanted_[i], epsilon, unknown, entries);
        }
        Sparse matrix(count, count);
        matrix.setFromTriplets(entries.begin(), entries.end());
        if (n == 0) {
            factor = multifrontalFactor(matrix, places);
        }
        if (!factor->factorize(matrix)) {
            return;
        }
        const Places slopes = gradient(at_, triangles, epsilon);
        Eigen::VectorXd forces(count);
        for (std::size_t v = 0; v < unknown.size(); ++v) {
            if (unknown[v] >= 0) {
                forces.segment<2>(unknown[v]) = -slopes.row(static_cast<Eigen::Index>(v)).transpose();
            }
        }
        const Eigen::VectorXd motion = factor->solve(forces);
        Places step = Places::Zero(at_.rows(), 2);
        for (std::size_t v = 0; v < unknown.size(); ++v) {
            if (unknown[v] >= 0) {
                step.row(static_cast<Eigen::Index>(v)) = motion.segment<2>(unknown[v]).transpose();
            }
        }
        const std::optional<double> after = moveAlong(step, triangles, epsilon, now, -forces.dot(motion));
        const double gain = after ? now - *after : 0.0;
        now -= gain;
        if (!(gain >= kWorthwhile * now) || (epsilon > 0.0 && leastDeterminant(triangles) > 0.0)) {
            return;
        }
    }
}

bool Flattening::untangle(int most_rings)
{
    std::vector<std::uint8_t> is_near(static_cast<std::size_t>(at_.rows()), 0);
    const auto mark = [](const Triangle& t, std::vector<std::uint8_t>& marks) {
        for (const std::uint32_t v : t) {
            marks[v] = 1;
        }
    };
    const auto touches = [](const Triangle& t, const std::vector<std::uint8_t>& marks) {
        return marks[t[0]] != 0 || marks[t[1]] != 0 || marks[t[2]] != 0;
    };
    if (leastDeterminant(all_) > 0.0) {
        return true;
    }
    for (const Wanted& w : wanted_) {
        if (!(jacobianOf(at_, w).determinant() > 0.0)) {
            mark(w.corners, is_near);
        }
    }
    int grown = 0;
    for (int rings = kFirstRings; rings <= most_rings && work_ < kMostWork; rings *= 2) {
        for (; grown < rings; ++grown) {
            std::vector<std::uint8_t> next = is_near;
            for (const Wanted& w : wanted_) {
                if (touches(w.corners, is_near)) {
                    mark(w.corners, next);
                }
            }
            is_near = std::move(next);
        }
        std::vector<std::uint8_t> is_free = is_near;
        std::fill_n(is_free.begin(), rim_, std::uint8_t{0});
        Indices triangles;
        for (const std::uint32_t i : all_) {
            if (touches(wanted_[i].corners, is_free)) {
                triangles.push_back(i);
            }
        }
        if (!harmonic_ && rings == kFirstRings) {
            startHarmonic(triangles, is_free);
        }
        double least = leastDeterminant(triangles);
        double epsilon = kFirstEpsilon;
        for (int round = 0; round < kRounds && !(least > 0.0) && work_ < kMostWork; ++round) {
            const double before = energy(at_, triangles, epsilon);
            relax(triangles, is_free, epsilon, kStepsPerRound);
            least = leastDeterminant(triangles);
            // The paper's rule.
            const double progress = std::max(1.0 - energy(at_, triangles, epsilon) / before, kLeastProgress);
            const double bound = (1.0 - progress) * 0.5 * (least + std::sqrt(least * least + epsilon * epsilon));
            constexpr double kNone = 1e-10;
            epsilon = least < bound ? std::max(2.0 * std::sqrt(bound * (bound - least)), kNone) : kNone;
        }
        if (least > 0.0) {
            relax(triangles, is_free, 0.0, kRelaxingSteps);
            return true;
        }
    }
    return false;
}

void Flattening::flatten()
{
    constexpr std::size_t kMemory = 6;
    constexpr int kSteps = 20;
    struct Pair {
        Places motion;
        Places change;  ///< of the gradient
        double inverse_product = 0.0;
    };
    const auto product = [](const Places& a, const Places& b) { return a.cwiseProduct(b).sum(); };
    std::deque<Pair> memory;
    double now = energy(at_, all_, 0.0);
    Places slopes = gradient(at_, all_, 0.0);
    for (int n = 0; n < kSteps; ++n) {
        Places step = slopes;
        std::vector<double> parts(memory.size());
        for (std::size_t i = memory.size(); i-- > 0;) {
            parts[i] = memory[i].inverse_product * product(memory[i].motion, step);
            step -= parts[i] * memory[i].change;
        }
        const Places inner = step.bottomRows(step.rows() - rim_);
        step.bottomRows(step.rows() - rim_) = solveBoth(*harmonic_, inner);
        for (std::size_t i = 0; i < memory.size(); ++i) {
            step += (parts[i] - memory[i].inverse_product * product(memory[i].change, step)) * memory[i].motion;
        }
        step = -step;
        const Places before = at_;
        const std::optional<double> after = moveAlong(step, all_, 0.0, now, product(slopes, step));
        const double gain = after ? now - *after : 0.0;
        now -= gain;
        if (!(gain >= kWorthwhile * now)) {
            return;
        }
        Pair pair{at_ - before, gradient(at_, all_, 0.0) - slopes, 0.0};
        slopes += pair.change;
        const double curvature = product(pair.motion, pair.change);
        if (curvature > 0.0) {
            pair.inverse_product = 1.0 / curvature;
            memory.push_back(std::move(pair));
        }
        if (memory.size() > kMemory) {
            memory.pop_front();
        }
    }
}

bool Flattening::run()
{
    const auto folded = std::count_if(wanted_.begin(), wanted_.end(),
                                      [&](const Wanted& w) { return !(jacobianOf(at_, w).determinant() > 0.0); });
    if (static_cast<double>(folded) < kFewFolds * static_cast<double>(wanted_.size()) && untangle(kNearRings)) {
        return true;
    }
    std::vector<std::uint8_t> is_free(static_cast<std::size_t>(at_.rows()), 1);
    std::fill_n(is_free.begin(), rim_, std::uint8_t{0});
    harmonic_ = startHarmonic(all_, is_free);
    if (!harmonic_ || !untangle(kMostRings)) {
        return false;
    }
    flatten();
    return leastDeterminant(all_) > 0.0;
}

}  // namespace

FlatMap projected(const CapillarySurface& sheet)
{
    FlatMap map;
    for (const Vec3& p : sheet.vertices) {
        map.places.push_back({p.x, p.y});
    }
    const bool is_graph = std::all_of(sheet.triangles.begin(), sheet.triangles.end(),
                                      [&](const Triangle& t) { return areaVector(sheet.vertices, t).z > 0.0; });
    map.kind = is_graph ? TextureMap::Projection : TextureMap::Folded;
    return map;
}

FlatMap flatMap(const CapillarySurface& sheet)
{
    FlatMap map = projected(sheet);
    if (map.kind == TextureMap::Projection) {
        return map;
    }
    Flattening flattening(sheet);
    if (flattening.run()) {
        map.kind = TextureMap::Flat;
        for (std::uint32_t v = sheet.rimVertexCount(); v < map.places.size(); ++v) {
            map.places[v] = rowOf(flattening.places(), v);
        }
    }
    return map;
}

}  // namespace droplet

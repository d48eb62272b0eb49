// SPDX-License-Identifier: GPL-3.0-or-later
//
// P. Fournier, A. Habibi, P. Poulin, "Simulating the Flow of Liquid Droplets", Graphics Interface 1998, section 3. The
// paper leaves out the weights of eq. (1). For similar levels the network is a stack of frustums, so
// V = S/(3N²) Σ α_i h_i with α_i = 6 (N + 1 − i) for 2 ≤ i ≤ N, α_{N+1} = 1 and h_1 = 0.
//
// The paper reaches the balance by steps of time with very stiff springs. Here they are rigid, and Newton's method
// finds the balance. The springs of the guide point push outward; were it fixed, a basis beside it would be driven
// away. It is the centre of the basis, so that the ground holds the sum of all forces, the same on every basis point.
#include "body/spring_body.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "droplet/error.h"

namespace droplet {
namespace {

using Index = Eigen::Index;

constexpr double kPi = std::numbers::pi;

/// Angle between slices times a number.
double turn(const SpringNetwork& network, std::size_t slices)
{
    return 2.0 * kPi * static_cast<double>(slices) / static_cast<double>(network.slices);
}

/// Length of a side of the basis.
double sideOf(const SpringNetwork& network)
{
    return 2.0 * network.radius * std::sin(kPi / static_cast<double>(network.slices));
}

/// Area S of the basis, a regular polygon.
double basisArea(const SpringNetwork& network)
{
    const auto slices = static_cast<double>(network.slices);
    return 0.5 * slices * network.radius * network.radius * std::sin(2.0 * kPi / slices);
}

/// Lagrange function of the network: energy minus multipliers times constraints.
///
/// Unknowns: x and y of the basis points, then x, y and z of all others. Constraints: length of the sides, centre of
/// the basis, direction of its first point, and the solco connection.
class Balance {
public:
    explicit Balance(const SpringNetwork& network)
        : network_(&network),
          points_(network.slices * network.levels + 1),
          unknowns_(static_cast<Index>(3 * points_ - network.slices)),
          constraints_(static_cast<Index>(network.slices) + 4)
    {
    }

    SpringBalance find()
    {
        start();
        SpringBalance result;
        constexpr std::size_t kMaxSteps = 50;
        const double tolerance = 1e-12 * scale();
        for (;; ++result.steps) {
            assemble();
            const double residual = right_.cwiseAbs().maxCoeff();
            if (residual <= tolerance) {
                break;
            }
            if (result.steps == kMaxSteps || !std::isfinite(residual)) {
                throw Error(ErrorCode::NoSuchDroplet, "the springs of a droplet find no balance");
            }
            values_ -= matrix_.partialPivLu().solve(right_);
        }
        for (std::size_t p = 0; p < points_; ++p) {
            result.points.push_back(at(p));
        }
        result.rods.assign(values_.data() + unknowns_, values_.data() + unknowns_ + sides());
        for (double& tension : result.rods) {
            tension *= -sideOf(*network_);  // the constraint is half the square of the length
        }
        result.pressure = values_[values_.size() - 1];
        return result;
    }

private:
    [[nodiscard]] Index sides() const { return static_cast<Index>(network_->slices); }
    [[nodiscard]] std::size_t point(std::size_t level, std::size_t slice) const
    {
        return level > network_->levels ? points_ - 1 : (level - 1) * network_->slices + slice % network_->slices;
    }
    /// First unknown of a point.
    [[nodiscard]] Index first(std::size_t p) const
    {
        return static_cast<Index>(p < network_->slices ? 2 * p : 3 * p - network_->slices);
    }
    [[nodiscard]] Index axes(std::size_t p) const { return p < network_->slices ? 2 : 3; }
    [[nodiscard]] Vec3 at(std::size_t p) const
    {
        const Index i = first(p);
        return {values_[i], values_[i + 1], axes(p) == 3 ? values_[i + 2] : 0.0};
    }
    /// A force of the network.
    [[nodiscard]] double scale() const { return network_->longitudinal * network_->radius + length(network_->force); }
    /// Height of a cone with the volume.
    [[nodiscard]] double coneHeight() const { return 3.0 * network_->volume / basisArea(*network_); }

    /// Starts from a cone.
    void start()
    {
        values_ = Eigen::VectorXd::Zero(unknowns_ + constraints_);
        for (std::size_t level = 1; level <= network_->levels + 1; ++level) {
            const double size = levelScale(*network_, level);
            for (std::size_t j = 0; j < network_->slices; ++j) {
                const std::size_t p = point(level, j);
                const Index i = first(p);
                values_[i] = size * network_->radius * std::cos(turn(*network_, j));
                values_[i + 1] = size * network_->radius * std::sin(turn(*network_, j));
                if (axes(p) == 3) {
                    values_[i + 2] = (1.0 - size) * coneHeight();
                }
            }
        }
    }

    /// Adds a force on the second of two points from the first, which has the opposite force, and its derivative.
    void addPair(std::size_t a, std::size_t b, const Eigen::Vector3d& force, const Eigen::Matrix3d& stiffness)
    {
        const std::array<std::size_t, 2> ends{a, b};
        for (std::size_t e = 0; e < 2; ++e) {
            const double sign = e == 0 ? -1.0 : 1.0;
            right_.segment(first(ends[e]), axes(ends[e])) += sign * force.head(axes(ends[e]));
            for (std::size_t f = 0; f < 2; ++f) {
                matrix_.block(first(ends[e]), first(ends[f]), axes(ends[e]), axes(ends[f])) +=
                    (e == f ? 1.0 : -1.0) * stiffness.topLeftCorner(axes(ends[e]), axes(ends[f]));
            }
        }
    }

    void addSpring(std::size_t a, std::size_t b, double stiffness, double rest)
    {
        const Vec3 d = at(b) - at(a);
        const Eigen::Vector3d way(d.x, d.y, d.z);
        if (rest == 0.0) {
            addPair(a, b, stiffness * way, stiffness * Eigen::Matrix3d::Identity());
            return;
        }
        const double now = way.norm();
        const Eigen::Vector3d unit = way / now;
        const Eigen::Matrix3d along = unit * unit.transpose();
        addPair(a, b, stiffness * (now - rest) * unit,
                stiffness * (along + (1.0 - rest / now) * (Eigen::Matrix3d::Identity() - along)));
    }

    /// Adds a constraint's row, its derivative by one unknown.
    void addDerivative(Index constraint, Index unknown, double derivative)
    {
        const Index row = unknowns_ + constraint;
        matrix_(row, unknown) += derivative;
        matrix_(unknown, row) -= derivative;
        right_[unknown] -= values_[row] * derivative;
    }

    void assemble()
    {
        const SpringNetwork& n = *network_;
        matrix_ = Eigen::MatrixXd::Zero(values_.size(), values_.size());
        right_ = Eigen::VectorXd::Zero(values_.size());
        for (std::size_t level = 1; level <= n.levels; ++level) {
            const double size = levelScale(n, level);
            for (std::size_t j = 0; j < n.slices; ++j) {
                addSpring(point(level, j), point(level + 1, j), n.longitudinal, 0.0);
                if (level > 1) {
                    addSpring(point(level, j), point(level, j + 1), n.transverse * size, size * sideOf(n));
                }
            }
        }
        addGuide();
        for (std::size_t p = n.slices; p < points_; ++p) {
            right_.segment(first(p), 3) -= Eigen::Vector3d(n.force.x, n.force.y, n.force.z);
        }
        addBasis();
        addSolco();
    }

    void addGuide()
    {
        const double rest = network_->guide_length * network_->radius;
        for (std::size_t p = 0; p < network_->slices; ++p) {
            const Eigen::Vector2d way(at(p).x, at(p).y);
            const double now = way.norm();
            const Eigen::Matrix2d along = way * way.transpose() / (now * now);
            right_.segment(first(p), 2) += network_->guide * (1.0 - rest / now) * way;
            matrix_.block(first(p), first(p), 2, 2) +=
                network_->guide * (along + (1.0 - rest / now) * (Eigen::Matrix2d::Identity() - along));
        }
    }

    void addBasis()
    {
        const double side = sideOf(*network_);
        for (std::size_t j = 0; j < network_->slices; ++j) {
            const auto constraint = static_cast<Index>(j);
            const std::size_t a = point(1, j);
            const std::size_t b = point(1, j + 1);
            const Vec3 way = at(b) - at(a);
            const double multiplier = values_[unknowns_ + constraint];
            right_[unknowns_ + constraint] = 0.5 * (dot(way, way) - side * side);
            addDerivative(constraint, first(b), way.x);
            addDerivative(constraint, first(b) + 1, way.y);
            addDerivative(constraint, first(a), -way.x);
            addDerivative(constraint, first(a) + 1, -way.y);
            addPair(a, b, Eigen::Vector3d::Zero(), -multiplier * Eigen::Matrix3d::Identity());
            for (const Index axis : {Index{0}, Index{1}}) {
                right_[unknowns_ + sides() + axis] += values_[first(a) + axis];
                addDerivative(sides() + axis, first(a) + axis, 1.0);
            }
        }
        right_[unknowns_ + sides() + 2] = values_[1];
        addDerivative(sides() + 2, 1, 1.0);
    }

    void addSolco()
    {
        const SpringNetwork& n = *network_;
        const auto levels = static_cast<double>(n.levels);
        const Index constraint = sides() + 3;
        double sum = 0.0;
        for (std::size_t p = n.slices; p < points_; ++p) {
            const bool is_apex = p + 1 == points_;
            const double share = is_apex ? 1.0 : 1.0 / static_cast<double>(n.slices);
            const double weight = share * levelWeight(n, is_apex ? n.levels + 1 : p / n.slices + 1);
            sum += weight * at(p).z;
            addDerivative(constraint, first(p) + 2, weight);
        }
        right_[unknowns_ + constraint] = sum - 3.0 * levels * levels * n.volume / basisArea(n);
    }

    const SpringNetwork* network_;
    std::size_t points_;
    Index unknowns_;
    Index constraints_;
    Eigen::VectorXd values_;  // unknowns, then multipliers
    Eigen::VectorXd right_;   // derivative of the function by each
    Eigen::MatrixXd matrix_;
};

/// Weights of four neighbours in a uniform cubic B-spline.
std::array<double, 4> splineWeights(double x)
{
    const double y = 1.0 - x;
    return {y * y * y / 6.0, (4.0 - 6.0 * x * x + 3.0 * x * x * x) / 6.0, (4.0 - 6.0 * y * y + 3.0 * y * y * y) / 6.0,
            x * x * x / 6.0};
}

}  // namespace

double levelScale(const SpringNetwork& network, std::size_t level)
{
    return static_cast<double>(network.levels + 1 - level) / static_cast<double>(network.levels);
}

double levelWeight(const SpringNetwork& network, std::size_t level)
{
    if (level == 1) {
        return 0.0;
    }
    return level > network.levels ? 1.0 : 6.0 * static_cast<double>(network.levels + 1 - level);
}

SpringBalance balance(const SpringNetwork& network)
{
    return Balance(network).find();
}

BodyGrid skin(const SpringNetwork& network, const std::vector<Vec3>& points)
{
    const std::size_t slices = network.slices;
    const std::size_t levels = network.levels;
    // Rows of control points: one before the rim, so that the spline begins there; levels; apex; the last level
    // mirrored at its centre, so that the spline passes the apex smoothly.
    std::vector<std::vector<Vec3>> rows(levels + 3, std::vector<Vec3>(slices));
    Vec3 centre;
    for (std::size_t j = 0; j < slices; ++j) {
        for (std::size_t level = 0; level < levels; ++level) {
            rows[level + 1][j] = points[level * slices + j];
        }
        rows[levels + 1][j] = points.back();
        rows[0][j] = 2.0 * rows[1][j] - rows[2][j];
        centre = centre + (1.0 / static_cast<double>(slices)) * rows[levels][j];
    }
    for (std::size_t j = 0; j < slices; ++j) {
        rows[levels + 2][j] = 2.0 * centre - rows[levels][j];
    }
    const auto across = [&](const std::vector<Vec3>& row, double turned) {
        const auto begin = static_cast<std::size_t>(turned);
        const std::array<double, 4> weights = splineWeights(turned - static_cast<double>(begin));
        Vec3 sum;
        for (std::size_t i = 0; i < 4; ++i) {
            sum = sum + weights[i] * row[(begin + slices - 1 + i) % slices];
        }
        return sum;
    };
    const auto up = [&](double turned, double place) {
        const std::size_t begin = std::min(static_cast<std::size_t>(place), levels - 1);
        const std::array<double, 4> weights = splineWeights(place - static_cast<double>(begin));
        Vec3 sum;
        for (std::size_t i = 0; i < 4; ++i) {
            sum = sum + weights[i] * across(rows[begin + i], turned);
        }
        return sum;
    };
    BodyGrid grid;
    for (std::size_t j = 0; j < kBodySlices; ++j) {
        const double turned = static_cast<double>(j * slices) / static_cast<double>(kBodySlices);
        for (std::size_t k = 0; k < kBodyRings; ++k) {
            Vec3 place = up(turned, static_cast<double>(k * levels) / static_cast<double>(kBodyRings));
            place.z = k == 0 ? 0.0 : place.z;
            grid.set(k, j, place);
        }
        grid.inward[j] = across(rows[2], turned) - across(rows[1], turned);
    }
    grid.apex = up(0.0, static_cast<double>(levels));
    return grid;
}

SpringBody::SpringBody(const ForceModel& model)
{
    // The paper gives no sizes and stiffnesses. These look as its figures 4 and 6 do: the paper's liquid wets the
    // ground, and a droplet of 20 µL of water leans visibly on a wall.
    constexpr double kWidest = kPi / 3.0;
    constexpr double kSoftness = 0.2;
    const double angle = std::min(model.wetting.contact_angle, kWidest);
    SpringNetwork network;
    network.radius = capOf(1.0, angle).contact_radius;
    network.volume = 1.0;
    // With a softness of 1 the surface between two slices would have the tension of the liquid, here 1.
    const auto slices = static_cast<double>(network.slices);
    network.longitudinal = kSoftness * 2.0 * kPi * static_cast<double>(network.levels) / slices;
    network.transverse = 10.0 * network.longitudinal;
    network.guide = network.longitudinal;
    const SpringBalance rest = balance(network);
    rest_ = skin(network, rest.points);
    const auto above = static_cast<double>(rest.points.size() - network.slices);
    per_gravity_ = model.liquid.density / model.liquid.surface_tension / above;
    largest_force_ = 0.6 * rest.pressure;
    const std::array<Vec3, 3> axes{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        network.force = largest_force_ * axes[axis];
        std::vector<Vec3> change = balance(network).points;
        for (std::size_t p = 0; p < change.size(); ++p) {
            change[p] = (1.0 / largest_force_) * (change[p] - rest.points[p]);
        }
        changes_[axis] = skin(network, change);
    }
}

BodyGrid SpringBody::shape(const BodyConditions& conditions) const
{
    // In units of the surface tension and the cube root of the volume
    const double size = std::cbrt(conditions.volume);
    const Vec3 wanted = per_gravity_ * size * size * conditions.gravity;
    const double far = length(wanted) / largest_force_;
    const Vec3 force = (1.0 / std::sqrt(1.0 + far * far)) * wanted;
    const std::array<double, 3> parts{force.x, force.y, force.z};
    BodyGrid grid = rest_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double part = parts[axis];
        const BodyGrid& change = changes_[axis];
        for (std::size_t k = 0; k < kBodyRings; ++k) {
            for (std::size_t j = 1; j <= kBodySlices; ++j) {
                grid.x[k][j] += part * change.x[k][j];
                grid.y[k][j] += part * change.y[k][j];
                grid.z[k][j] += part * change.z[k][j];
            }
        }
        grid.apex = grid.apex + part * change.apex;
        for (std::size_t j = 0; j < kBodySlices; ++j) {
            grid.inward[j] = grid.inward[j] + part * change.inward[j];
        }
    }
    return grid;
}

}  // namespace droplet

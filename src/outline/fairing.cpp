// SPDX-License-Identifier: GPL-3.0-or-later
//
// Minimum-variation curves: H. P. Moreton and C. H. Séquin, "Functional optimization for fair surface design", SIGGRAPH
// 1992 (the functional ∫ (dκ/ds)² ds). Here the curve is a polygon whose vertices have one degree of freedom each. So
// Gauss–Newton minimises the functional on the discrete (Menger) curvature. The place of a vertex is a random variable:
// normal about the place from grey levels, or, in a hard mask, with density 6t(1 − t) over its slot. Departure: the
// variation is weighed against the curvature itself, as in scale-invariant minimum-variation curves (Moreton and
// Séquin, section 6).

#include "outline/fairing.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace droplet {
namespace {

/// Radius below which the curvature of a curve may vary more freely [px]. The cost depends on dκ/ds relative to κ², so
/// that small shapes are treated like large ones seen from afar.
constexpr double kFreeRadius = 4.0;

/// Maximum number of Gauss–Newton steps; discs and squares converge in half a dozen.
constexpr int kSteps = 20;

/// Maximum number of halvings of a step that makes the curve worse.
constexpr int kHalvings = 6;

/// Smallest length in a curvature, roughly [px]; crossings next to a pixel centre nearly coincide.
constexpr double kMinLength = 0.05;

/// Half-width of the rows of the normal equations: a variation of curvature spans four vertices.
constexpr std::size_t kHalfBand = 3;

/// Coupling around the loop, relative to the diagonal, below which it is dropped.
constexpr double kNoCoupling = 1e-40;

double smoothLength(Vec2 a)
{
    return std::sqrt(dot(a, a) + kMinLength * kMinLength);
}

/// Cost of a slot's place: half the squared deviation in standard deviations. In a hard mask, minus the logarithm of
/// the density relative to that at the middle.
double placeStrain(const Slot& slot)
{
    if (!slot.measured) {
        return -std::log(4.0 * slot.t * (1.0 - slot.t));
    }
    const double deviation = (slot.t - *slot.measured) / slot.spread;
    return 0.5 * deviation * deviation;
}

double totalPlaceStrain(const SlotLoop& loop)
{
    // One logarithm for many slots: a product of 64 densities, none below 0.07, is far from underflow.
    constexpr int kFactors = 64;
    double sum = 0.0;
    double density = 1.0;
    int factors = 0;
    for (const Slot& slot : loop) {
        if (slot.measured) {
            sum += placeStrain(slot);
            continue;
        }
        density *= 4.0 * slot.t * (1.0 - slot.t);
        if (++factors == kFactors) {
            sum -= std::log(density);
            density = 1.0;
            factors = 0;
        }
    }
    return sum - std::log(density);
}

/// Gradient and curvature of the cost of a vertex's place in its slot.
struct PlaceCost {
    double gradient = 0.0;
    double hessian = 0.0;
};

PlaceCost placeCost(const Slot& slot)
{
    if (slot.measured) {
        const double weight = 1.0 / (slot.spread * slot.spread);
        return {weight * (slot.t - *slot.measured), weight};
    }
    const double below = 1.0 / slot.t;
    const double above = 1.0 / (1.0 - slot.t);
    return {above - below, below * below + above * above};
}

/// Polygon with the quantities that the functional needs.
///
/// Every vector wraps around: after its n entries the first few are repeated.
struct Polygon {
    std::vector<Vec2> points;
    std::vector<double> edges;   ///< smooth length of the edge to the next vertex
    std::vector<double> scales;  ///< 2/(product of the sides) of vertices i, i + 1, i + 2: curvature per cross product
    std::vector<double> bends;   ///< Menger curvature of these vertices
};

template <class Value>
void wrap(std::vector<Value>& values)
{
    const std::size_t n = values.size() - kHalfBand;
    for (std::size_t k = 0; k < kHalfBand; ++k) {
        values[n + k] = values[k];
    }
}

void measure(const SlotLoop& loop, Polygon& polygon)
{
    const std::size_t n = loop.size();
    polygon.points.resize(n + kHalfBand);
    polygon.edges.resize(n + kHalfBand);
    polygon.scales.resize(n + kHalfBand);
    polygon.bends.resize(n + kHalfBand);
    for (std::size_t i = 0; i < n; ++i) {
        polygon.points[i] = loop[i].point();
    }
    wrap(polygon.points);
    for (std::size_t i = 0; i < n; ++i) {
        polygon.edges[i] = smoothLength(polygon.points[i + 1] - polygon.points[i]);
    }
    wrap(polygon.edges);
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 a = polygon.points[i];
        const Vec2 b = polygon.points[i + 1];
        const Vec2 c = polygon.points[i + 2];
        polygon.scales[i] = 2.0 / (polygon.edges[i] * polygon.edges[i + 1] * smoothLength(c - a));
        polygon.bends[i] = polygon.scales[i] * cross(b - a, c - b);
    }
    wrap(polygon.scales);
    wrap(polygon.bends);
}

/// Term of the functional between slots i + 1 and i + 2, from the curvatures at both.
struct Variation {
    double weight = 0.0;
    double difference = 0.0;
};

double variationStrain(const Variation& term)
{
    return 0.5 * term.weight * term.difference * term.difference;
}

void measureVariations(const Polygon& polygon, const FairingOptions& options, std::vector<Variation>& terms)
{
    const std::size_t n = polygon.bends.size() - kHalfBand;
    constexpr double kSquare = kFreeRadius * kFreeRadius;
    terms.resize(n);
    double before = polygon.bends[n - 1];
    for (std::size_t i = 0; i < n; ++i) {
        const double here = polygon.bends[i];
        const double next = polygon.bends[i + 1];
        const double mean = 0.25 * (before + here + next + polygon.bends[i + 2]);
        const double freedom = kSquare * mean * mean;
        terms[i] = {options.fairness / (polygon.edges[i + 1] * (1.0 + freedom * freedom)), next - here};
        before = here;
    }
    for (std::size_t gap = 0; gap < options.breaks.size(); ++gap) {
        if (options.breaks[gap] != 0) {
            std::size_t i = gap;
            for (std::size_t k = 0; k < kHalfBand; ++k) {
                terms[i] = {};
                i = (i > 0 ? i : n) - 1;
            }
        }
    }
}

/// Row of the normal equations: the vertex's own coefficient, those of the next three vertices, and the right-hand
/// side.
struct Row {
    std::array<double, kHalfBand + 1> band{};
    double right = 0.0;
};

/// Normal equations of one Gauss–Newton step: a band of half-width 3 that wraps around.
void assemble(const SlotLoop& loop, const Polygon& polygon, const std::vector<Variation>& terms, std::vector<Row>& rows)
{
    const std::size_t n = loop.size();
    rows.assign(n + kHalfBand, {});
    for (std::size_t i = 0; i < n; ++i) {
        const PlaceCost cost = placeCost(loop[i]);
        rows[i].band[0] = cost.hessian;
        rows[i].right = -cost.gradient;
    }
    const auto toward = [&](std::size_t i) { return loop[i < n ? i : i - n].toward; };
    // Derivatives of the curvature at slots i, i + 1, i + 2 with respect to their places
    const auto derivatives = [&](std::size_t i) {
        const Vec2 ab = polygon.points[i + 1] - polygon.points[i];
        const Vec2 bc = polygon.points[i + 2] - polygon.points[i + 1];
        const Vec2 b = toward(i + 1);
        const double scale = polygon.scales[i];
        return std::array<double, 3>{-scale * cross(toward(i), bc), scale * (cross(b, bc) - cross(ab, b)),
                                     scale * cross(ab, toward(i + 2))};
    };
    std::array<double, 3> here = derivatives(0);
    for (std::size_t i = 0; i < n; ++i) {
        const std::array<double, 3> next = i + 1 < n ? derivatives(i + 1) : derivatives(0);
        const Variation& term = terms[i];
        const std::array<double, 4> slope{-here[0], next[0] - here[1], next[1] - here[2], next[2]};
        for (std::size_t a = 0; a <= kHalfBand; ++a) {
            const double weighted = term.weight * slope[a];
            rows[i + a].right -= weighted * term.difference;
            for (std::size_t b = a; b <= kHalfBand; ++b) {
                rows[i + a].band[b - a] += weighted * slope[b];
            }
        }
        here = next;
    }
    for (std::size_t k = 0; k < kHalfBand; ++k) {
        for (std::size_t offset = 0; offset <= kHalfBand; ++offset) {
            rows[k].band[offset] += rows[n + k].band[offset];
        }
        rows[k].right += rows[n + k].right;
    }
    rows.resize(n);
}

/// Solves the normal equations by LDLᵀ, row after row. The last six rows are left as a dense block. The first three
/// rows are coupled to the last three around the loop. Elimination carries this coupling along until it becomes
/// negligible, as the influence of one vertex on another does.
class BandSolver {
public:
    /// @param rows  at least 8; overwritten
    /// @return      the Newton step; empty if round-off spoils the factorisation
    const std::vector<double>& solve(std::vector<Row>& rows)
    {
        solution_.clear();
        if (eliminate(rows)) {
            substitute(rows);
        }
        return solution_;
    }

private:
    static constexpr std::size_t kDense = 2 * kHalfBand;
    /// Coupling of a row to the last three rows.
    using Around = std::array<double, kHalfBand>;

    [[nodiscard]] bool eliminate(std::vector<Row>& rows)
    {
        const std::size_t n = rows.size();
        std::array<Around, kHalfBand> around{};  // coupling of rows k, k + 1, k + 2
        for (std::size_t k = 0; k < kHalfBand; ++k) {
            for (std::size_t q = k; q < kHalfBand; ++q) {
                around[k][q] = rows[n - kHalfBand + q].band[k + kHalfBand - q];
            }
        }
        around_.clear();
        dense_.setZero();
        dense_right_.setZero();
        bool coupled = true;
        for (std::size_t k = 0; k + kDense < n; ++k) {
            Row& row = rows[k];
            if (!(row.band[0] > 0.0)) {
                return false;
            }
            const double inverse = 1.0 / row.band[0];
            const Row factor{{inverse, row.band[1] * inverse, row.band[2] * inverse, row.band[3] * inverse}, row.right};
            for (std::size_t a = 1; a <= kHalfBand; ++a) {
                for (std::size_t b = a; b <= kHalfBand; ++b) {
                    rows[k + a].band[b - a] -= factor.band[a] * row.band[b];
                }
                rows[k + a].right -= factor.band[a] * row.right;
            }
            if (coupled) {
                coupled = carryAround(around, factor, row.band[0]);
            }
            row = factor;
        }
        fillDense(rows, around);
        return true;
    }

    /// Eliminates one row from the coupling around the loop.
    /// @return whether any coupling is left
    bool carryAround(std::array<Around, kHalfBand>& around, const Row& factor, double pivot)
    {
        const Around here = around[0];
        around = {around[1], around[2], Around{}};
        Around& factors = around_.emplace_back();
        double max = 0.0;
        for (std::size_t q = 0; q < kHalfBand; ++q) {
            factors[q] = here[q] * factor.band[0];
            for (std::size_t p = 0; p <= q; ++p) {
                dense_(row(q), row(p)) -= factors[q] * here[p];
            }
            dense_right_[row(q)] -= factors[q] * factor.right;
            for (std::size_t a = 0; a < kHalfBand; ++a) {
                around[a][q] -= factor.band[a + 1] * here[q];
                max = std::max(max, std::abs(around[a][q]));
            }
        }
        if (max < kNoCoupling * pivot) {
            around = {};
            return false;
        }
        return true;
    }

    /// Adds the last six rows to the terms that elimination put into the last three.
    void fillDense(const std::vector<Row>& rows, const std::array<Around, kHalfBand>& around)
    {
        const std::size_t first = rows.size() - kDense;
        for (std::size_t a = 0; a < kDense; ++a) {
            for (std::size_t b = 0; b <= kHalfBand && a + b < kDense; ++b) {
                dense_(static_cast<Eigen::Index>(a + b), static_cast<Eigen::Index>(a)) += rows[first + a].band[b];
            }
            dense_right_[static_cast<Eigen::Index>(a)] += rows[first + a].right;
        }
        for (std::size_t k = 0; k < kHalfBand; ++k) {
            for (std::size_t q = 0; q < kHalfBand; ++q) {
                dense_(row(q), static_cast<Eigen::Index>(k)) += around[k][q];
            }
        }
    }

    void substitute(const std::vector<Row>& rows)
    {
        const std::size_t n = rows.size();
        const Dense last = dense_.selfadjointView<Eigen::Lower>().ldlt().solve(dense_right_);
        solution_.resize(n);
        std::copy(last.begin(), last.end(), solution_.end() - kDense);
        for (std::size_t k = n - kDense; k-- > 0;) {
            const std::array<double, kHalfBand + 1>& factor = rows[k].band;
            double value = rows[k].right * factor[0];
            for (std::size_t q = 0; k < around_.size() && q < kHalfBand; ++q) {
                value -= around_[k][q] * solution_[n - kHalfBand + q];
            }
            for (std::size_t a = kHalfBand; a > 0; --a) {
                value -= factor[a] * solution_[k + a];
            }
            solution_[k] = value;
        }
    }

    /// Index of one of the last three rows within the last six.
    static Eigen::Index row(std::size_t q) { return static_cast<Eigen::Index>(q + kHalfBand); }

    using Dense = Eigen::Matrix<double, kDense, 1>;
    std::vector<Around> around_;
    Eigen::Matrix<double, kDense, kDense> dense_;
    Dense dense_right_;
    std::vector<double> solution_;
};

/// Loop and its cost.
struct Curve {
    SlotLoop loop;
    Polygon polygon;
    std::vector<Variation> terms;
    double strain = 0.0;

    void measure(const FairingOptions& options)
    {
        droplet::measure(loop, polygon);
        measureVariations(polygon, options, terms);
        strain = totalPlaceStrain(loop);
        for (const Variation& term : terms) {
            strain += variationStrain(term);
        }
    }
};

/// Moves a loop by a part of the step; every slot moves at most nine tenths of the way to its end.
void move(const SlotLoop& loop, const std::vector<double>& step, double part, SlotLoop& result)
{
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const double d = part * step[i];
        const double room = d > 0 ? 1.0 - kSlotMargin - loop[i].t : loop[i].t - kSlotMargin;
        result[i].t = loop[i].t + std::copysign(std::min(std::abs(d), 0.9 * std::max(room, 0.0)), d);
    }
}

/// Smallest distance of neighbouring knots by their measured places [px]. The curvature through two crossings next to
/// the same pixel centre only shows how they were rounded.
constexpr double kKnotSpacing = 0.4;

/// Slots that carry curvature; those between two knots follow them.
std::vector<std::size_t> knots(const SlotLoop& loop)
{
    const auto place = [](const Slot& slot) { return slot.liquid + slot.measured.value_or(0.5) * slot.toward; };
    std::vector<std::size_t> result{0};
    for (std::size_t i = 1; i < loop.size(); ++i) {
        if (length(place(loop[i]) - place(loop[result.back()])) >= kKnotSpacing) {
            result.push_back(i);
        }
    }
    while (result.size() > 1 && length(place(loop[result.back()]) - place(loop[0])) < kKnotSpacing) {
        result.pop_back();
    }
    return result;
}

SlotLoop select(const SlotLoop& loop, const std::vector<std::size_t>& indices)
{
    SlotLoop result;
    result.reserve(indices.size());
    for (const std::size_t i : indices) {
        result.push_back(loop[i]);
    }
    return result;
}

/// Breaks between the knots: one wherever there is a break between the slots from one knot to the next.
FairingOptions selectBreaks(const FairingOptions& options, const std::vector<std::size_t>& indices)
{
    FairingOptions result{{}, options.fairness};
    if (options.breaks.empty()) {
        return result;
    }
    const std::size_t n = options.breaks.size();
    for (std::size_t k = 0; k < indices.size(); ++k) {
        const std::size_t end = indices[(k + 1) % indices.size()];
        std::uint8_t broken = 0;
        std::size_t i = indices[k];
        do {
            broken |= options.breaks[i];
            i = (i + 1) % n;
        } while (i != end);
        result.breaks.push_back(broken);
    }
    return result;
}

/// Puts a slot's vertex where the chord between two points crosses the slot, within the slot.
void follow(Slot& slot, Vec2 from, Vec2 to)
{
    const double slope = cross(slot.toward, to - from);
    if (std::abs(slope) > 1e-6) {
        slot.t = std::clamp(-cross(slot.liquid - from, to - from) / slope, kSlotMargin, 1.0 - kSlotMargin);
    }
}

/// Fairs a loop whose slots are all knots.
void fairKnots(SlotLoop& loop, const FairingOptions& options)
{
    // The band of a shorter loop would overlap itself.
    if (loop.size() < 8) {
        return;
    }
    Curve here{loop, {}, {}, 0.0};
    here.measure(options);
    Curve there = here;
    std::vector<Row> rows;
    BandSolver solver;
    for (int k = 0; k < kSteps; ++k) {
        assemble(here.loop, here.polygon, here.terms, rows);
        const std::vector<double>& step = solver.solve(rows);
        if (step.empty()) {
            break;
        }
        double part = 1.0;
        for (int halvings = 0; halvings <= kHalvings; ++halvings) {
            move(here.loop, step, part, there.loop);
            there.measure(options);
            if (!(there.strain > here.strain)) {
                break;
            }
            part *= 0.5;
        }
        if (!(there.strain < here.strain)) {
            break;
        }
        const bool settled = here.strain - there.strain < 1e-3;
        std::swap(here, there);
        if (settled) {
            break;
        }
    }
    loop = std::move(here.loop);
}

}  // namespace

void fair(SlotLoop& loop, const FairingOptions& options)
{
    const std::vector<std::size_t> indices = knots(loop);
    if (indices.size() == loop.size()) {
        fairKnots(loop, options);
        return;
    }
    SlotLoop faired = select(loop, indices);
    fairKnots(faired, selectBreaks(options, indices));
    for (std::size_t k = 0; k < indices.size(); ++k) {
        loop[indices[k]] = faired[k];
    }
    for (std::size_t k = 0; k < indices.size(); ++k) {
        const Vec2 from = faired[k].point();
        const Vec2 to = faired[(k + 1) % indices.size()].point();
        for (std::size_t i = (indices[k] + 1) % loop.size(); i != indices[(k + 1) % indices.size()];
             i = (i + 1) % loop.size()) {
            follow(loop[i], from, to);
        }
    }
}

std::vector<double> strain(const SlotLoop& loop, const FairingOptions& options)
{
    const std::vector<std::size_t> indices = knots(loop);
    const SlotLoop carriers = select(loop, indices);
    Polygon polygon;
    measure(carriers, polygon);
    std::vector<Variation> terms;
    measureVariations(polygon, selectBreaks(options, indices), terms);
    std::vector<double> result(loop.size(), 0.0);
    for (std::size_t k = 0; k < indices.size(); ++k) {
        // A term is stored at the first of its four slots; the piece between the middle two begins at the second.
        result[indices[(k + 1) % indices.size()]] =
            placeStrain(carriers[(k + 1) % indices.size()]) + variationStrain(terms[k]);
    }
    return result;
}

}  // namespace droplet

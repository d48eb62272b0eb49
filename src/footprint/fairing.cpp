// SPDX-License-Identifier: GPL-3.0-or-later
//
// Minimum-variation curves: H. P. Moreton and C. H. Séquin, "Functional optimization for fair surface design",
// SIGGRAPH 1992 (the functional ∫ (dκ/ds)² ds). Here the curve is a polygon whose vertices have one freedom each, so
// the functional is minimised by Gauss–Newton on the discrete (Menger) curvature, with the place of every vertex as a
// random variable: normal about what grey levels say, or, in a hard mask, with density 6t(1 − t) over its slot.
// Departure: the variation is weighed against the curvature itself, as in scale-invariant minimum-variation curves
// (Moreton and Séquin, section 6).

#include "footprint/fairing.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace droplet {
namespace {

/// Radius below which a curve may vary its curvature more freely [px]: what counts is dκ/ds against κ², so that small
/// shapes are treated like large ones seen from afar.
constexpr double kFreeRadius = 4.0;

/// Most Gauss–Newton steps; discs and squares settle in half a dozen.
constexpr int kSteps = 20;

/// Lengths enter curvatures no shorter than about this [px]: crossings next to a pixel centre nearly coincide.
constexpr double kShortest = 0.05;

/// Share of the fairness left where the curvature is κ.
double stiffness(double curvature)
{
    const double square = kFreeRadius * kFreeRadius * curvature * curvature;
    return 1.0 / (1.0 + square * square);
}

double smoothLength(Vec2 a)
{
    return std::sqrt(dot(a, a) + kShortest * kShortest);
}

/// Curvature at the middle of three vertices and its derivatives with respect to their places in their slots.
struct Curvature {
    double value = 0.0;
    std::array<double, 3> derivative{};
};

Curvature curvature(const Slot& a, const Slot& b, const Slot& c)
{
    const Vec2 ab = b.point() - a.point();
    const Vec2 bc = c.point() - b.point();
    const double scale = 2.0 / (smoothLength(ab) * smoothLength(bc) * smoothLength(ab + bc));
    return {scale * cross(ab, bc),
            {-scale * cross(a.toward, bc), scale * (cross(b.toward, bc) - cross(ab, b.toward)),
             scale * cross(ab, c.toward)}};
}

/// Gradient and curvature of the cost of a vertex's place in its slot.
struct PlaceCost {
    double gradient = 0.0;
    double hessian = 0.0;
};

PlaceCost placeCost(const Slot& slot)
{
    const double below = slot.t;
    const double above = 1.0 - slot.t;
    PlaceCost cost{-1.0 / below + 1.0 / above, 1.0 / (below * below) + 1.0 / (above * above)};
    if (slot.measured) {
        const double weight = 1.0 / (slot.spread * slot.spread);
        cost = {weight * (slot.t - *slot.measured), weight};
    }
    return cost;
}

/// The normal equations of one loop: a band of half-width 3 that wraps around.
class BandSystem {
public:
    explicit BandSystem(std::size_t size) : size_(static_cast<Eigen::Index>(size)), gradient_(size_)
    {
        std::vector<Eigen::Triplet<double>> entries;
        entries.reserve(size * 4);
        for (Eigen::Index column = 0; column < size_; ++column) {
            for (Eigen::Index offset = 0; offset <= 3; ++offset) {
                const Eigen::Index row = (column + offset) % size_;
                entries.emplace_back(std::max(row, column), std::min(row, column), 0.0);
            }
        }
        matrix_.resize(size_, size_);
        matrix_.setFromTriplets(entries.begin(), entries.end());
        solver_.analyzePattern(matrix_);
        // Where entry (column + offset, column) of the band stands in the sparse matrix.
        place_.resize(size * 4);
        for (Eigen::Index column = 0; column < size_; ++column) {
            for (Eigen::Index offset = 0; offset <= 3; ++offset) {
                const Eigen::Index row = (column + offset) % size_;
                double& entry = matrix_.coeffRef(std::max(row, column), std::min(row, column));
                place_[static_cast<std::size_t>(column * 4 + offset)] = &entry - matrix_.valuePtr();
            }
        }
    }

    void clear()
    {
        std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
        gradient_.setZero();
    }

    void add(std::size_t i, std::size_t offset, double value) { matrix_.valuePtr()[place_[i * 4 + offset]] += value; }
    void addGradient(std::size_t i, double value) { gradient_[static_cast<Eigen::Index>(i)] += value; }

    /// The Newton step; empty if round-off spoils the factorisation.
    Eigen::VectorXd step()
    {
        solver_.factorize(matrix_);
        if (solver_.info() != Eigen::Success) {
            return {};
        }
        return solver_.solve(-gradient_);
    }

private:
    Eigen::Index size_;
    Eigen::SparseMatrix<double> matrix_;
    Eigen::VectorXd gradient_;
    std::vector<std::ptrdiff_t> place_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver_;
};

void addPlaceCosts(const SlotLoop& loop, BandSystem& system)
{
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const PlaceCost cost = placeCost(loop[i]);
        system.add(i, 0, cost.hessian);
        system.addGradient(i, cost.gradient);
    }
}

/// The term of the functional between slots i + 1 and i + 2, from the curvatures at both.
struct Variation {
    double weight = 0.0;
    double difference = 0.0;
    std::array<double, 4> row{};  ///< derivatives of the difference for slots i … i + 3
};

std::vector<Variation> variations(const SlotLoop& loop, const FairingOptions& options)
{
    const std::size_t n = loop.size();
    const auto broken = [&](std::size_t i) { return !options.breaks.empty() && options.breaks[i % n] != 0; };
    std::vector<Curvature> bend(n);
    for (std::size_t i = 0; i < n; ++i) {
        bend[i] = curvature(loop[i], loop[(i + 1) % n], loop[(i + 2) % n]);
    }
    std::vector<Variation> terms(n);
    for (std::size_t i = 0; i < n; ++i) {
        if (broken(i) || broken(i + 1) || broken(i + 2)) {
            continue;
        }
        const Curvature& here = bend[i];
        const Curvature& next = bend[(i + 1) % n];
        const double ds = smoothLength(loop[(i + 2) % n].point() - loop[(i + 1) % n].point());
        const double mean = 0.25 * (bend[(i + n - 1) % n].value + here.value + next.value + bend[(i + 2) % n].value);
        terms[i] = {options.fairness * stiffness(mean) / ds,
                    next.value - here.value,
                    {-here.derivative[0], next.derivative[0] - here.derivative[1],
                     next.derivative[1] - here.derivative[2], next.derivative[2]}};
    }
    return terms;
}

void addVariations(const std::vector<Variation>& terms, BandSystem& system)
{
    const std::size_t n = terms.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Variation& term = terms[i];
        for (std::size_t a = 0; a < 4; ++a) {
            system.addGradient((i + a) % n, term.weight * term.difference * term.row[a]);
            for (std::size_t b = a; b < 4; ++b) {
                system.add((i + a) % n, b - a, term.weight * term.row[a] * term.row[b]);
            }
        }
    }
}

double placeStrain(const Slot& slot)
{
    return slot.measured ? 0.5 * std::pow((slot.t - *slot.measured) / slot.spread, 2.0)
                         : -std::log(4.0 * slot.t * (1.0 - slot.t));
}

double variationStrain(const Variation& term)
{
    return 0.5 * term.weight * term.difference * term.difference;
}

double totalStrain(const SlotLoop& loop, const std::vector<Variation>& terms)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        sum += placeStrain(loop[i]) + variationStrain(terms[i]);
    }
    return sum;
}

/// The loop moved along a part of the step, every slot at most nine tenths of the way to its end.
SlotLoop moved(const SlotLoop& loop, const Eigen::VectorXd& step, double part)
{
    SlotLoop result = loop;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const double d = part * step[static_cast<Eigen::Index>(i)];
        const double room = d > 0 ? 1.0 - kSlotMargin - loop[i].t : loop[i].t - kSlotMargin;
        result[i].t += std::copysign(std::min(std::abs(d), 0.9 * std::max(room, 0.0)), d);
    }
    return result;
}

/// Least distance of neighbouring knots [px], by where they are measured: the curvature through two crossings next to
/// the same pixel centre says nothing but how they were rounded.
constexpr double kKnotSpacing = 0.4;

/// The slots that carry curvature; those between follow them.
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

/// Breaks between the knots: wherever there is one between the slots from one knot to the next.
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

/// Puts a slot where the chord between two points crosses it, as far as it reaches.
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
    // A band that wraps around onto itself has no place to put its entries twice.
    if (loop.size() < 8) {
        return;
    }
    BandSystem system(loop.size());
    std::vector<Variation> terms = variations(loop, options);
    double strain_here = totalStrain(loop, terms);
    for (int k = 0; k < kSteps; ++k) {
        system.clear();
        addPlaceCosts(loop, system);
        addVariations(terms, system);
        const Eigen::VectorXd step = system.step();
        if (step.size() == 0) {
            return;
        }
        double part = 1.0;
        SlotLoop trial = moved(loop, step, part);
        std::vector<Variation> trial_terms = variations(trial, options);
        double strain_there = totalStrain(trial, trial_terms);
        for (int halvings = 0; halvings < 6 && strain_there > strain_here; ++halvings) {
            part *= 0.5;
            trial = moved(loop, step, part);
            trial_terms = variations(trial, options);
            strain_there = totalStrain(trial, trial_terms);
        }
        if (!(strain_there < strain_here)) {
            return;
        }
        const bool settled = strain_here - strain_there < 1e-3;
        loop = std::move(trial);
        terms = std::move(trial_terms);
        strain_here = strain_there;
        if (settled) {
            return;
        }
    }
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
    const std::vector<Variation> terms = variations(carriers, selectBreaks(options, indices));
    std::vector<double> result(loop.size(), 0.0);
    for (std::size_t k = 0; k < indices.size(); ++k) {
        // Terms stand at the first of their four slots; the piece between the middle two begins at the second.
        result[indices[(k + 1) % indices.size()]] =
            placeStrain(carriers[(k + 1) % indices.size()]) + variationStrain(terms[k]);
    }
    return result;
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Radii are drawn until they cover enough, and placed from large to small, so that small droplets fill what large ones
// leave (random sequential adsorption). Those that no slope holds, those that are too large between edges, and those
// that others took up, leave room: more are drawn for it, until the object is covered or they find none. Droplets lie
// in a grid for each power of four of their reach: a search looks into few cells, however different the sizes are.
// Volumes of joined droplets add up.
#include "droplet/flow/dew.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <unordered_map>
#include <utility>

#include "droplet/error.h"
#include "flow/footing.h"
#include "flow/pinning.h"
#include "flow/places.h"
#include "require.h"
#include "wind/random.h"

namespace droplet {
namespace {

constexpr double kRight = 0.5 * std::numbers::pi;
constexpr std::size_t kMost = 1'000'000;

/// Droplet on the surface.
struct Drop {
    FlowTerrain::Point point;
    Vec3 normal;
    double volume = 0.0;
    double radius = 0.0;         ///< seen from above
    double reach = 0.0;          ///< radius of a ball about the centre that has it, and its equator at the ground
    Vec3 centre;                 ///< of the ellipsoid that has it
    std::array<Vec3, 3> axes{};  ///< of that
};

/// Droplets by place, with a grid for each power of four of their reach.
class Grids {
public:
    /// @param smallest  radius
    explicit Grids(double smallest) : smallest_(smallest) {}

    void add(std::size_t k, const Drop& drop) { cellOf(drop).push_back({drop.centre, drop.reach, k}); }
    void remove(std::size_t k, const Drop& drop)
    {
        std::erase_if(cellOf(drop), [&](const Entry& entry) { return entry.drop == k; });
    }

    /// Whether a droplet touches any other one.
    [[nodiscard]] bool isTouched(const Drop& drop, const std::vector<Drop>& all) const
    {
        // Large ones first: most of the ground is theirs.
        return std::any_of(grids_.rbegin(), grids_.rend(), [&](const auto& level) {
            return !visit(drop, level, [&](std::size_t k) { return !touch(drop, all[k]); });
        });
    }

    /// A droplet that touches another one; of several, the first that was placed.
    [[nodiscard]] std::optional<std::size_t> touching(const Drop& drop, const std::vector<Drop>& all) const
    {
        std::optional<std::size_t> met;
        for (const auto& level : grids_) {
            visit(drop, level, [&](std::size_t k) {
                if ((!met || k < *met) && touch(drop, all[k])) {
                    met = k;
                }
                return true;
            });
        }
        return met;
    }

private:
    using Cell = std::array<std::int64_t, 3>;
    struct Hash {
        std::size_t operator()(const Cell& c) const
        {
            constexpr std::array<std::uint64_t, 3> kStrides{0x9E3779B97F4A7C15U, 0xC2B2AE3D27D4EB4FU,
                                                            0x165667B19E3779F9U};
            return static_cast<std::size_t>(static_cast<std::uint64_t>(c[0]) * kStrides[0] +
                                            static_cast<std::uint64_t>(c[1]) * kStrides[1] +
                                            static_cast<std::uint64_t>(c[2]) * kStrides[2]);
        }
    };
    /// Ball that has a droplet.
    struct Entry {
        Vec3 centre;
        double reach = 0.0;
        std::size_t drop = 0;
    };
    using Grid = std::unordered_map<Cell, std::vector<Entry>, Hash>;
    static constexpr double kRatio = 4.0;  // of levels' sizes

    /// Visits droplets of a level whose balls touch that of one, until a function returns false.
    /// @return  whether all were visited
    template <typename Function>
    bool visit(const Drop& drop, const std::pair<const int, Grid>& level, const Function& function) const
    {
        const double side = sideOf(level.first);
        const double reach = drop.reach + 0.5 * side;
        const Cell low = at(drop.centre - reach * Vec3{1.0, 1.0, 1.0}, side);
        const Cell high = at(drop.centre + reach * Vec3{1.0, 1.0, 1.0}, side);
        for (Cell c = low; c[0] <= high[0]; ++c[0]) {
            for (c[1] = low[1]; c[1] <= high[1]; ++c[1]) {
                for (c[2] = low[2]; c[2] <= high[2]; ++c[2]) {
                    const auto found = level.second.find(c);
                    if (found == level.second.end()) {
                        continue;
                    }
                    for (const Entry& entry : found->second) {
                        const Vec3 way = entry.centre - drop.centre;
                        const double sum = entry.reach + drop.reach;
                        if (dot(way, way) < sum * sum && !function(entry.drop)) {
                            return false;
                        }
                    }
                }
            }
        }
        return true;
    }

    /// Whether two droplets touch: no plane across the way between their centres lies between them, or they are nearer
    /// than on a plane, as in a dent, where both are bent towards each other. Those on the two sides of a thin part do
    /// not touch.
    static bool touch(const Drop& a, const Drop& b)
    {
        const double alike = dot(a.normal, b.normal);
        if (alike <= -0.5) {
            return false;
        }
        const auto along = [](const Drop& drop, Vec3 way) {
            double sum = 0.0;
            for (const Vec3& axis : drop.axes) {
                sum += dot(axis, way) * dot(axis, way);
            }
            return std::sqrt(sum);
        };
        const Vec3 way = b.centre - a.centre;
        if (dot(way, way) < along(a, way) + along(b, way)) {
            return true;
        }
        const auto foot = [](const Drop& drop) {
            return drop.centre - dot(drop.centre - drop.point.place, drop.normal) * drop.normal;
        };
        const Vec3 between = foot(b) - foot(a);
        const auto over_ground = [&](const Drop& drop) {
            const Vec3 level = between - dot(between, drop.normal) * drop.normal;
            const double size = length(level);
            return size > 0.0 ? along(drop, level) / size : drop.radius;
        };
        return alike > 0.0 && length(between) < over_ground(a) + over_ground(b);
    }

    [[nodiscard]] double sideOf(int level) const { return 2.0 * smallest_ * std::pow(kRatio, level); }

    static Cell at(Vec3 p, double side)
    {
        return {static_cast<std::int64_t>(std::floor(p.x / side)), static_cast<std::int64_t>(std::floor(p.y / side)),
                static_cast<std::int64_t>(std::floor(p.z / side))};
    }

    std::vector<Entry>& cellOf(const Drop& drop)
    {
        int level = 0;
        while (0.5 * sideOf(level) < drop.reach) {
            ++level;
        }
        return grids_[level][at(drop.centre, sideOf(level))];
    }

    double smallest_;
    std::map<int, Grid> grids_;  ///< cells are as wide as their largest droplets
};

/// Places droplets.
class Dew {
public:
    Dew(const FlowTerrain& terrain, const DewOptions& options, const Progress& progress)
        : terrain_(terrain),
          options_(options),
          progress_(progress),
          places_{terrain, options.from, options.weight},
          pinning_(options.pinning, RandomStream(options.seed, RandomPurpose::Pinning, 0).bits(0)),
          grids_(options.smallest)
    {
    }

    DewDroplets make()
    {
        constexpr std::uint64_t kPoints = 65536;
        const bool takes_all = !options_.from && !options_.weight && options_.inside;
        Places all = places_;
        all.inside = options_.inside;
        result_.area = terrain_.area() * (takes_all ? 1.0 : all.share(options_.seed, kPoints));
        if (!(result_.area > 0.0)) {
            refuseObject();
        }
        cover();
        for (const Drop& drop : drops_) {
            if (drop.volume > 0.0) {
                FlowSample sample;
                sample.id = result_.samples.size();
                sample.contact = FlowContact::Still;
                sample.face = drop.point.face;
                sample.place = drop.point.place;
                sample.normal = drop.normal;
                sample.volume = drop.volume;
                result_.samples.push_back(sample);
                result_.covered += std::numbers::pi * drop.radius * drop.radius;
            }
        }
        return std::move(result_);
    }

private:
    [[noreturn]] static void refuseObject()
    {
        throw Error(
            ErrorCode::InvalidInput,
            "the object has no place for droplets: nothing of it faces the rain, or is in the mask, or has weight, or "
            "sees the outside; an open mesh may be inside out");
    }

    /// Places droplets until they cover as much as asked, or more of them add next to nothing.
    void cover()
    {
        constexpr double kNear = 0.01;  // of the coverage
        constexpr double kLeast = 0.1;  // of what is missing, that a round adds
        constexpr double kSmall = 1.2;  // radius over the smallest, of which droplets are all alike
        constexpr int kMostRounds = 30;
        // What ground holds no droplet at all is not covered by more elsewhere.
        const double held = heldShare();
        const double wanted = held * options_.coverage * result_.area;
        double missing = options_.coverage * result_.area;
        double largest = options_.largest;
        for (int round = 0; round < kMostRounds && missing > kNear * wanted; ++round) {
            obstacles_ = {};
            const std::vector<double> radii = drawn(missing, largest);
            for (std::size_t k = 0; k < radii.size(); ++k) {
                if (round == 0 && held < 1.0 && runsOff(held)) {
                    ++result_.run_off;
                } else {
                    place(radii[k], round == 0);
                }
                if (round == 0) {
                    report(static_cast<double>(k + 1) / static_cast<double>(radii.size()));
                }
            }
            result_.obstacle =
                static_cast<DewObstacle>(std::max_element(obstacles_.begin(), obstacles_.end()) - obstacles_.begin());
            double covered = 0.0;
            for (const Drop& drop : drops_) {
                covered += std::numbers::pi * drop.radius * drop.radius;
            }
            if (held < 1.0 - kNear) {
                result_.obstacle = DewObstacle::Slopes;
            }
            const double left = wanted - covered;
            if (left > (1.0 - kLeast) * missing && largest <= kSmall * options_.smallest) {
                return;
            }
            missing = left;
            // Smaller ones stay where those ran off, and fit between those that are there.
            largest = std::max(0.5 * largest, options_.smallest);
        }
    }

    /// Share of the ground that holds the smallest droplets.
    [[nodiscard]] double heldShare() const
    {
        constexpr int kPoints = 4096;
        const RandomStream random(options_.seed, RandomPurpose::Dew, std::numeric_limits<std::uint64_t>::max());
        const double volume = volumeOf(options_.smallest);
        std::uint64_t counter = 0;
        int held = 0;
        for (int k = 0; k < kPoints; ++k) {
            const auto point = places_.pointOf(random, counter);
            if (!point) {
                refuseObject();
            }
            held += isHeld(dropAt(*point, volume)) ? 1 : 0;
        }
        return static_cast<double>(held) / kPoints;
    }

    /// Whether the next droplet is one for ground that holds none.
    bool runsOff(double held)
    {
        constexpr std::uint64_t kCounter = std::numeric_limits<std::uint64_t>::max();  // place() begins with 0
        const bool runs = RandomStream(options_.seed, RandomPurpose::Dew, 2 * placed_ + 1).uniform(kCounter) >= held;
        placed_ += runs ? 1 : 0;
        return runs;
    }

    /// Reports a share of the first round, which has nearly all droplets.
    void report(double share)
    {
        constexpr double kStep = 0.01;
        if (progress_ && share >= reported_ + kStep) {
            progress_(Stage::Solve, share);
            reported_ = share;
        }
    }

    /// Radii that cover an area, from large to small, with the range of sizes shortened to a largest one.
    [[nodiscard]] std::vector<double> drawn(double area, double largest)
    {
        std::vector<double> radii;
        double covered = 0.0;
        while (covered < area) {
            if (next_radius_ == kMost) {
                throw Error(
                    ErrorCode::InvalidArgument,
                    "the coverage takes more than " + std::to_string(kMost) +
                        " droplets of this size; ask for larger ones, for less coverage, or for a smaller object");
            }
            const double drawn = radiusOf(next_radius_++);
            const double radius = largest < options_.largest
                                      ? options_.smallest + (drawn - options_.smallest) *
                                                                (largest - options_.smallest) /
                                                                (options_.largest - options_.smallest)
                                      : drawn;
            radii.push_back(radius);
            covered += std::numbers::pi * radius * radius;
        }
        std::sort(radii.begin(), radii.end(), std::greater<>());
        return radii;
    }

    [[nodiscard]] double radiusOf(std::size_t k) const
    {
        const RandomStream random(options_.seed, RandomPurpose::Dew, 2 * k);
        if (options_.sizes == DewSizes::LogNormal) {
            for (std::uint64_t i = 0;; i += 2) {
                const double radius =
                    options_.median * std::exp(options_.spread * normal(random.uniform(i), random.uniform(i + 1)));
                constexpr std::uint64_t kTries = 2000;
                if ((radius >= options_.smallest && radius <= options_.largest) || i >= kTries) {
                    return std::clamp(radius, options_.smallest, options_.largest);
                }
            }
        }
        // The inverse of the cumulated distribution.
        constexpr double kPower = -5.0 / 3.0;
        const double low = std::pow(options_.smallest, kPower);
        const double high = std::pow(options_.largest, kPower);
        return std::pow(low + random.uniform(0) * (high - low), 1.0 / kPower);
    }

    [[nodiscard]] Drop dropAt(const FlowTerrain::Point& point, double volume) const
    {
        const double angle = options_.forces.wetting.contact_angle;
        const Vec3 normal = terrain_.surface().faces[point.face].normal;
        const DewExtent extent = options_.extent ? options_.extent(volume, normal) : ballOf(volume, normal);
        double reach = 0.0;
        for (const Vec3& axis : extent.axes) {
            reach = std::max(reach, length(axis));
        }
        reach += std::abs(dot(extent.middle, normal));  // about its foot, too
        return {point, normal, volume, dewRadius(volume, angle), reach, point.place + extent.middle, extent.axes};
    }

    /// Ball of the cap that a droplet is without gravity, or below 90° about its base.
    [[nodiscard]] DewExtent ballOf(double volume, Vec3 normal) const
    {
        const double angle = options_.forces.wetting.contact_angle;
        const double rise = angle > kRight ? -std::cos(angle) * capOf(volume, angle).radius : 0.0;
        const double radius = dewRadius(volume, angle);
        return {rise * normal,
                {radius * Vec3{1.0, 0.0, 0.0}, radius * Vec3{0.0, 1.0, 0.0}, radius * Vec3{0.0, 0.0, 1.0}}};
    }

    /// Volume of a droplet with a radius seen from above.
    [[nodiscard]] double volumeOf(double radius) const
    {
        const double angle = options_.forces.wetting.contact_angle;
        return capVolume(angle > kRight ? radius * std::sin(angle) : radius, angle);
    }

    /// Whether a droplet stays where it is.
    [[nodiscard]] bool isHeld(const Drop& drop) const
    {
        const DropletForces forces = forcesOn(options_.forces, drop.volume);
        const double off = dot(options_.gravity, drop.normal);
        const Vec3 along = options_.gravity - off * drop.normal;
        const double angle = options_.forces.wetting.contact_angle;
        const double contact = capOf(drop.volume, angle).contact_radius;
        // As FlowParameters::adhesion has it: 2 σ sin θ / r over the contact circle.
        const double adhesion =
            2.0 * std::numbers::pi * contact * options_.forces.liquid.surface_tension * std::sin(angle);
        if (forces.mass * off > adhesion) {
            return false;
        }
        const double pushed = length(along);
        const double push = forces.mass * pushed;
        if (pinning_.isEven() || push <= pinning_.least() * forces.retention) {
            return push <= forces.retention;
        }
        if (push > pinning_.most() * forces.retention) {
            return false;
        }
        // As for droplets that run: where hysteresis varies, it is that of the front half of the rim.
        const Vec3 ahead = (1.0 / pushed) * along;
        return push <=
               forces.retention * pinning_.over({drop.point.place, contact, ahead, cross(drop.normal, ahead)}).along;
    }

    /// Where a droplet has to go of which a part would lie across an edge or the end of the surface.
    [[nodiscard]] std::optional<Vec3> away(const Drop& drop) const
    {
        const Vec3 middle = drop.centre - drop.point.place;
        const double aside = length(middle - dot(middle, drop.normal) * drop.normal);
        return awayFromEdge(terrain_, drop.point, aside + std::max(length(drop.axes[0]), length(drop.axes[1])));
    }

    /// @param joins  whether it becomes part of another one where it finds no room, or is not there at all
    void place(double radius, bool joins)
    {
        const int room_tries = joins ? 100 : 30;
        constexpr int kGroundTries = 200;
        constexpr std::uint64_t kMostInner = 10'000;  // tries, of an object that has nearly only inner sides
        const RandomStream random(options_.seed, RandomPurpose::Dew, 2 * placed_++ + 1);
        const double volume = volumeOf(radius);
        std::optional<Drop> crowded;  // where it found no room last
        std::uint64_t counter = 0;
        std::uint64_t inner = 0;
        int room = 0;
        int slope = 0;
        int edge = 0;
        while (room < room_tries && slope + edge < kGroundTries) {
            const std::optional<FlowTerrain::Point> point = places_.pointOf(random, counter);
            if (!point) {
                refuseObject();
            }
            const Drop drop = dropAt(*point, volume);
            if (!isHeld(drop)) {
                ++slope;
                continue;
            }
            if (grids_.isTouched(drop, drops_)) {
                crowded = drop;
                ++room;
                continue;
            }
            if (away(drop)) {
                ++edge;
                continue;
            }
            // What takes rays comes last.
            if (!options_.inside && !places_.isOutside(*point)) {
                if (++inner == kMostInner) {
                    refuseObject();
                }
                continue;
            }
            grids_.add(drops_.size(), drop);
            drops_.push_back(drop);
            return;
        }
        ++obstacles_[static_cast<std::size_t>(room > std::max(edge, slope) ? DewObstacle::Droplets
                                              : edge > slope               ? DewObstacle::Edges
                                                                           : DewObstacle::Slopes)];
        if (!crowded) {
            ++(edge > slope ? result_.between_edges : result_.run_off);
        } else if (joins) {
            ++result_.joined;
            const std::size_t met = *grids_.touching(*crowded, drops_);
            Drop grown = take(met);
            grown = dropAt(grown.point, grown.volume + volume);
            settle(met, grown);
        }
    }

    /// Takes a droplet off the surface.
    Drop take(std::size_t k)
    {
        grids_.remove(k, drops_[k]);
        return std::exchange(drops_[k], {});
    }

    /// Puts a droplet that has grown back; it joins those that it touches, and withdraws from edges. One that is too
    /// large runs off.
    void settle(std::size_t k, Drop drop)
    {
        constexpr int kMostMoves = 8;
        std::optional<Vec3> there;
        for (int moves = 0; moves <= kMostMoves; ++moves) {
            while (const auto other = grids_.touching(drop, drops_)) {
                const Drop second = take(*other);
                const double volume = drop.volume + second.volume;
                const Vec3 middle =
                    (1.0 / volume) * (drop.volume * drop.point.place + second.volume * second.point.place);
                drop = dropAt(terrain_.nearest(middle), volume);
                ++result_.joined;
            }
            there = away(drop);
            if (!there) {
                break;
            }
            drop = dropAt(terrain_.nearest(*there), drop.volume);
        }
        if (there) {
            ++result_.between_edges;
        } else if (!isHeld(drop)) {
            ++result_.run_off;
        } else {
            grids_.add(k, drop);
            drops_[k] = drop;
        }
    }

    const FlowTerrain& terrain_;
    const DewOptions& options_;
    const Progress& progress_;
    Places places_;
    PinningField pinning_;
    Grids grids_;
    std::size_t next_radius_ = 0;             ///< number of radii drawn
    std::uint64_t placed_ = 0;                ///< number of radii that were given a place
    std::array<std::size_t, 4> obstacles_{};  ///< droplets of this round without a place, by DewObstacle
    std::vector<Drop> drops_;                 ///< without volume: joined another one
    double reported_ = 0.0;                   ///< share
    DewDroplets result_;
};

}  // namespace

void DewOptions::validate() const
{
    constexpr double kLeast = 1e-3;
    constexpr double kMostCoverage = 0.7;  // small droplets find no room in more
    require(coverage >= kLeast && coverage <= kMostCoverage, "coverage", coverage, "from 0.001 to 0.7");
    require(smallest > 0.0 && std::isfinite(smallest), "smallest", smallest, "finite and more than 0");
    require(largest >= smallest && std::isfinite(largest), "largest", largest, "finite and not below smallest");
    require(median > 0.0 && std::isfinite(median), "median", median, "finite and more than 0");
    require(spread >= 0.0 && spread <= 3.0, "spread", spread, "from 0 to 3");
    require(std::isfinite(length(gravity)), "gravity", length(gravity), "finite");
    forces.validate();
    pinning.validate();
    if (from) {
        const double size = length(*from);
        require(size > 0.0 && std::isfinite(size), "from", size, "a direction that is not 0");
    }
}

double dewRadius(double volume, double contact_angle)
{
    const CapSize cap = capOf(volume, contact_angle);
    return contact_angle > kRight ? cap.radius : cap.contact_radius;
}

DewDroplets dewDroplets(const FlowTerrain& terrain, const DewOptions& options, const Progress& progress)
{
    options.validate();
    if (progress) {
        progress(Stage::Solve, 0.0);
    }
    return Dew(terrain, options, progress).make();
}

}  // namespace droplet

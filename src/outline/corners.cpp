// SPDX-License-Identifier: GPL-3.0-or-later
//
// Corners of a traced rim. P. Selinger, "Potrace: a polygon-based tracing algorithm" (2003), section 2.3, decides by
// how far a corner stands out from the smooth curve. Here both sides are extended, and the corner is kept if it turns
// enough and separates the same pixel centres as the mask.

#include "outline/corners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>

namespace droplet {
namespace {

/// Smallest turn between the chords for which a corner is tried. A circle turns by (length + 2 gap)/R between them, so
/// circles with radii above 6 px are never tried.
constexpr double kMinTriedTurn = 35.0 * std::numbers::pi / 180.0;

/// Smallest turn between the extended sides for which a corner is kept. In a hard mask, small discs are octagons, which
/// turn by up to 53° at their corners; grey levels distinguish the two.
constexpr double kMinKeptTurn = 25.0 * std::numbers::pi / 180.0;
constexpr double kMinKeptTurnHard = 56.0 * std::numbers::pi / 180.0;

/// Largest turn at a corner. A tip sharper than 20° is narrower than a pixel over more than the length of a side.
constexpr double kMaxTurn = 160.0 * std::numbers::pi / 180.0;

/// A side is extended along the line through its last piece of this length [px].
constexpr double kSideLength = 3.5;

/// Largest distance of a corner from the ends of its sides [px]. It is the tip of an angle of 30° whose last liquid
/// pixel centre is as far back as possible, (1/2)/sin 15°, plus a pixel of gap.
constexpr double kReach = 3.0;

/// Largest area that a corner may add between its ends [px²]. A tip without a pixel centre has less, at the corner of a
/// square (1/4) as well as at an angle of 30°.
constexpr double kMaxAdded = 1.0;

/// Largest deviation of a side from its line in a hard mask [px]. Discs of 3 to 10 px, whose pixels are those of
/// polygons, deviate by more; the straight sides of squares and bars deviate by at most 0.05 px.
constexpr double kMaxBend = 0.12;

/// Walks along the loop from a slot, forward or backward.
class Walker {
public:
    Walker(const SlotLoop& loop, std::size_t start, bool forward) : loop_(loop), index_(start), forward_(forward) {}

    void step() { index_ = forward_ ? (index_ + 1) % loop_.size() : (index_ + loop_.size() - 1) % loop_.size(); }
    [[nodiscard]] Vec2 point() const { return loop_[index_].point(); }
    [[nodiscard]] std::size_t index() const { return index_; }

private:
    const SlotLoop& loop_;
    std::size_t index_;
    bool forward_;
};

/// Points of a loop and lengths of the pieces between them, measured once.
class Path {
public:
    explicit Path(const SlotLoop& loop)
    {
        points_.reserve(loop.size());
        for (const Slot& slot : loop) {
            points_.push_back(slot.point());
        }
        pieces_.reserve(loop.size());
        for (std::size_t i = 0; i < points_.size(); ++i) {
            pieces_.push_back(length(points_[next(i)] - points_[i]));
        }
    }

    [[nodiscard]] std::size_t next(std::size_t i) const { return i + 1 < points_.size() ? i + 1 : 0; }
    [[nodiscard]] std::size_t previous(std::size_t i) const { return (i > 0 ? i : points_.size()) - 1; }
    [[nodiscard]] std::size_t step(std::size_t i, bool forward) const { return forward ? next(i) : previous(i); }

    /// Length of the piece between a point and the next one in a direction.
    [[nodiscard]] double piece(std::size_t i, bool forward) const { return pieces_[forward ? i : previous(i)]; }

    [[nodiscard]] double perimeter() const { return std::accumulate(pieces_.begin(), pieces_.end(), 0.0); }

    /// Point at a given distance along the path from one of its own points.
    [[nodiscard]] Vec2 along(std::size_t start, bool forward, double way) const
    {
        std::size_t here = start;
        for (std::size_t count = 0; count < points_.size(); ++count) {
            const double piece_length = piece(here, forward);
            const std::size_t there = step(here, forward);
            if (piece_length >= way) {
                return points_[here] + (way / piece_length) * (points_[there] - points_[here]);
            }
            way -= piece_length;
            here = there;
        }
        return points_[here];
    }

private:
    std::vector<Vec2> points_;
    std::vector<double> pieces_;
};

double angleBetween(Vec2 from, Vec2 to)
{
    return std::atan2(cross(from, to), dot(from, to));
}

/// Straight line; the direction is a unit vector.
struct Line {
    Vec2 through;
    Vec2 direction;
};

/// Least-squares line through points, directed from `behind` to `ahead`.
Line fitLine(const std::vector<Vec2>& points, Vec2 behind, Vec2 ahead)
{
    Vec2 mean{};
    for (const Vec2 p : points) {
        mean = mean + p;
    }
    mean = (1.0 / static_cast<double>(points.size())) * mean;
    double xx = 0.0;
    double xy = 0.0;
    double yy = 0.0;
    for (const Vec2 p : points) {
        const Vec2 d = p - mean;
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
    }
    const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
    const Vec2 direction{std::cos(angle), std::sin(angle)};
    return {mean, (dot(direction, ahead - behind) < 0 ? -1.0 : 1.0) * direction};
}

std::optional<Vec2> meet(const Line& a, const Line& b)
{
    const double determinant = cross(a.direction, b.direction);
    if (std::abs(determinant) < 1e-3) {
        return std::nullopt;
    }
    return a.through + (cross(b.through - a.through, b.direction) / determinant) * a.direction;
}

/// Side of a corner.
struct Side {
    Vec2 end;           ///< last vertex before the corner
    Line line;          ///< line through its last piece, toward the corner
    double bend = 0.0;  ///< largest distance of a vertex of that piece from the line [px]
};

/// Fits a line to the last piece of a side, up to the next break.
Side fitSide(const SlotLoop& loop, const std::vector<std::uint8_t>& breaks, std::size_t end, bool forward)
{
    std::vector<Vec2> points;
    Walker walker(loop, end, forward);
    double way = 0.0;
    while (true) {
        points.push_back(walker.point());
        const std::size_t gap = forward ? walker.index() : (walker.index() + loop.size() - 1) % loop.size();
        if (breaks[gap] != 0 || points.size() >= loop.size()) {
            break;
        }
        walker.step();
        way += length(walker.point() - points.back());
        if (way > kSideLength && points.size() >= 3) {
            break;
        }
    }
    const Line line = fitLine(points, points.back(), points.front());
    double bend = 0.0;
    for (const Vec2 p : points) {
        bend = std::max(bend, std::abs(cross(line.direction, p - line.through)));
    }
    return {points.front(), line, bend};
}

/// Line through the chord before or after a turn; the curve between the chord and the turn is left out.
Line fitChord(const Path& path, std::size_t start, bool forward, const Chord& chord)
{
    std::vector<Vec2> points;
    constexpr int kPoints = 9;
    points.reserve(kPoints);
    for (int k = 0; k < kPoints; ++k) {
        points.push_back(path.along(start, forward, chord.gap + k * chord.length / (kPoints - 1)));
    }
    return fitLine(points, points.back(), points.front());
}

/// Turn from the chord before a gap to the chord after it; 0 if it is too small for a corner.
double turnBetweenChords(const Path& path, std::size_t gap, const Chord& chord)
{
    const double far = chord.gap + chord.length;
    const std::size_t next = path.next(gap);
    const Vec2 before = path.along(gap, false, chord.gap) - path.along(gap, false, far);
    const Vec2 after = path.along(next, true, far) - path.along(next, true, chord.gap);
    // Most turns are less than half a radian; this is checked without an arc tangent.
    const double ahead = dot(before, after);
    const double aside = std::abs(cross(before, after));
    static_assert(kMinTriedTurn > 0.5);
    return aside < 0.5 * ahead ? 0.0 : std::atan2(aside, ahead);
}

/// Distance of a line from a slot's place, at most 1 [px].
double misfit(const Slot& slot, const Line& line)
{
    const double slope = cross(slot.toward, line.direction);
    if (std::abs(slope) < 1e-3) {
        return 1.0;
    }
    const double t = -cross(slot.liquid - line.through, line.direction) / slope;
    return std::min(1.0, slot.measured ? std::abs(t - *slot.measured) : std::max({0.0, -t, t - 1.0}));
}

/// The pixel that all slots between the ends of a turn share, dry or liquid; the corner then covers a part of it. Empty
/// if there is none: then the slots may not be dropped.
std::optional<Vec2> sharedPixel(const SlotLoop& loop, const Turn& turn)
{
    const std::size_t n = loop.size();
    const Slot& first = loop[(turn.first + 1) % n];
    bool same_liquid = true;
    bool same_dry = true;
    for (std::size_t i = (turn.first + 1) % n; i != turn.last; i = (i + 1) % n) {
        same_liquid = same_liquid && loop[i].liquid == first.liquid;
        same_dry = same_dry && loop[i].liquid + loop[i].toward == first.liquid + first.toward;
    }
    if (same_dry) {
        return first.liquid + first.toward;
    }
    return same_liquid ? std::optional(first.liquid) : std::nullopt;
}

/// Turn near a gap at which the slots change best from the line before it to the line after it.
Turn locate(const SlotLoop& loop, const Path& path, std::size_t near, const Chord& chord)
{
    const std::size_t n = loop.size();
    const Turn fallback{near, (near + 1) % n};
    const Line before = fitChord(path, near, false, chord);
    const Line after = fitChord(path, (near + 1) % n, true, chord);
    const std::optional<Vec2> tip = meet(before, after);
    constexpr std::size_t kSlots = 5;  // 3 to 4 px; the chords themselves are farther off
    if (!tip || n < 4 * kSlots) {
        return fallback;
    }
    // Costs of the first k slots of the window, on the line before and on the line after.
    std::array<double, 2 * kSlots + 1> on_before{};
    std::array<double, 2 * kSlots + 1> on_after{};
    const auto slot_at = [&](std::size_t j) { return (near + n + j + 1 - kSlots) % n; };
    for (std::size_t j = 0; j < 2 * kSlots; ++j) {
        on_before[j + 1] = on_before[j] + misfit(loop[slot_at(j)], before);
        on_after[j + 1] = on_after[j] + misfit(loop[slot_at(j)], after);
    }
    Turn best = fallback;
    double best_cost = std::numeric_limits<double>::infinity();
    // Dropping a slot must be better than a poor fit in it.
    constexpr double kDropCost = 0.25;
    constexpr std::size_t kMaxDropped = 2;
    for (std::size_t first = 0; first + 1 < 2 * kSlots; ++first) {
        for (std::size_t dropped = 0; dropped <= kMaxDropped && first + dropped + 1 < 2 * kSlots; ++dropped) {
            const Turn turn{slot_at(first), slot_at(first + dropped + 1)};
            if (dropped > 0 && (!loop[slot_at(first + 1)].measured || !sharedPixel(loop, turn))) {
                continue;
            }
            const Vec2 middle = 0.5 * (loop[turn.first].point() + loop[turn.last].point());
            // Of equal turns, take the nearest to where the lines meet.
            const double cost = on_before[first + 1] + on_after[2 * kSlots] - on_after[first + dropped + 1] +
                                kDropCost * static_cast<double>(dropped) + 0.05 * length(middle - *tip);
            if (cost < best_cost) {
                best_cost = cost;
                best = turn;
            }
        }
    }
    return best;
}

/// Part of a convex polygon to the left of a line through two points, y down.
std::vector<Vec2> clip(const std::vector<Vec2>& polygon, Vec2 from, Vec2 to)
{
    std::vector<Vec2> result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 a = polygon[i];
        const Vec2 b = polygon[(i + 1) % polygon.size()];
        // Liquid lies on the left with y up; with y down, that is a negative cross product.
        const double u = -cross(to - from, a - from);
        const double v = -cross(to - from, b - from);
        if (u >= 0) {
            result.push_back(a);
        }
        if ((u > 0 && v < 0) || (u < 0 && v > 0)) {
            result.push_back(a + (u / (u - v)) * (b - a));
        }
    }
    return result;
}

double polygonArea(const std::vector<Vec2>& polygon)
{
    double sum = 0.0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        sum += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    }
    return 0.5 * std::abs(sum);
}

/// Whether the grey levels around a corner fit the corner better than a straight rim from one end to the other.
bool levelsAgree(const Side& before, const Side& after, Vec2 tip, const Coverage& coverage)
{
    const bool convex = cross(before.line.direction, after.line.direction) > 0;
    double with = 0.0;
    double without = 0.0;
    double measured = 0.0;
    const int left = static_cast<int>(std::floor(std::min({before.end.x, tip.x, after.end.x})));
    const int right = static_cast<int>(std::floor(std::max({before.end.x, tip.x, after.end.x})));
    const int top = static_cast<int>(std::floor(std::min({before.end.y, tip.y, after.end.y})));
    const int bottom = static_cast<int>(std::floor(std::max({before.end.y, tip.y, after.end.y})));
    for (int y = top; y <= bottom; ++y) {
        for (int x = left; x <= right; ++x) {
            const double fx = x;
            const double fy = y;
            const std::vector<Vec2> pixel{{fx, fy}, {fx + 1, fy}, {fx + 1, fy + 1}, {fx, fy + 1}};
            // The wedge is liquid at a convex corner, dry at a concave one; blunt is the wedge without its tip.
            std::vector<Vec2> wedge;
            std::vector<Vec2> blunt;
            if (convex) {
                wedge = clip(clip(pixel, tip - before.line.direction, tip), tip, tip - after.line.direction);
                blunt = clip(wedge, before.end, after.end);
            } else {
                wedge = clip(clip(pixel, tip, tip - before.line.direction), tip - after.line.direction, tip);
                blunt = clip(wedge, after.end, before.end);
            }
            with += polygonArea(wedge);
            without += polygonArea(blunt);
            measured += convex ? coverage(x, y) : 1.0 - coverage(x, y);
        }
    }
    return std::abs(measured - with) < std::abs(measured - without);
}

bool contains(Vec2 a, Vec2 b, Vec2 c, Vec2 p)
{
    const double u = cross(b - a, p - a);
    const double v = cross(c - b, p - b);
    const double w = cross(a - c, p - c);
    return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

/// Whether the triangle at a corner's tip contains a pixel centre other than the excepted one.
bool coversPixelCentre(Vec2 a, Vec2 tip, Vec2 b, const std::optional<Vec2>& excepted)
{
    const int left = static_cast<int>(std::floor(std::min({a.x, tip.x, b.x}) - 0.5));
    const int right = static_cast<int>(std::ceil(std::max({a.x, tip.x, b.x}) - 0.5));
    const int top = static_cast<int>(std::floor(std::min({a.y, tip.y, b.y}) - 0.5));
    const int bottom = static_cast<int>(std::ceil(std::max({a.y, tip.y, b.y}) - 0.5));
    for (int y = top; y <= bottom; ++y) {
        for (int x = left; x <= right; ++x) {
            const Vec2 centre{x + 0.5, y + 0.5};
            if (!(excepted && *excepted == centre) && contains(a, tip, b, centre)) {
                return true;
            }
        }
    }
    return false;
}

/// The square between four pixel centres.
struct Cell {
    int x = 0;
    int y = 0;

    friend bool operator<(const Cell& a, const Cell& b) { return std::tie(a.y, a.x) < std::tie(b.y, b.x); }
};

Cell cellOf(Vec2 p)
{
    return {static_cast<int>(std::floor(p.x - 0.5)), static_cast<int>(std::floor(p.y - 0.5))};
}

/// End of a piece of rim. Its identity counts, because two corners may stand at the same point.
struct End {
    Vec2 at;
    std::size_t loop = 0;
    std::size_t slot = 0;  ///< slot of the vertex, or the slot before a tip
    bool is_tip = false;

    [[nodiscard]] bool same(const End& other) const
    {
        return loop == other.loop && slot == other.slot && is_tip == other.is_tip;
    }
};

/// Straight piece of rim.
struct Piece {
    End from;
    End to;
};

double distance(Vec2 p, const Piece& piece)
{
    const Vec2 along = piece.to.at - piece.from.at;
    const double squared = dot(along, along);
    const double t = squared > 0 ? std::clamp(dot(p - piece.from.at, along) / squared, 0.0, 1.0) : 0.0;
    return length(p - (piece.from.at + t * along));
}

/// Whether two pieces without a common end cross or nearly touch.
bool touch(const Piece& p, const Piece& q)
{
    if (p.from.same(q.from) || p.from.same(q.to) || p.to.same(q.from) || p.to.same(q.to)) {
        return false;
    }
    constexpr double kNear = 1e-3;  // px; vertices of slots keep kSlotMargin from one another
    const Vec2 u = p.to.at - p.from.at;
    const Vec2 v = q.to.at - q.from.at;
    const bool crossing = cross(u, q.from.at - p.from.at) * cross(u, q.to.at - p.from.at) < 0 &&
                          cross(v, p.from.at - q.from.at) * cross(v, p.to.at - q.from.at) < 0;
    return crossing || std::min({distance(p.from.at, q), distance(p.to.at, q), distance(q.from.at, p),
                                 distance(q.to.at, p)}) < kNear;
}

/// The two pieces of rim that make a corner between slots.
std::array<Piece, 2> piecesOf(const SlotLoop& slots, std::size_t loop, const Corner& corner)
{
    const End first{slots[corner.turn.first].point(), loop, corner.turn.first, false};
    const End tip{corner.tip, loop, corner.turn.first, true};
    const End last{slots[corner.turn.last].point(), loop, corner.turn.last, false};
    return {Piece{first, tip}, Piece{tip, last}};
}

bool standsBetween(const Corner& corner)
{
    return !corner.replaces_first && !corner.replaces_last;
}

/// All cells that a piece can touch.
std::vector<Cell> cellsAround(const Piece& piece)
{
    constexpr double kSlack = 0.01;  // a piece along a cell's border belongs to both sides
    const Vec2 a = piece.from.at;
    const Vec2 b = piece.to.at;
    const Cell low = cellOf({std::min(a.x, b.x) - kSlack, std::min(a.y, b.y) - kSlack});
    const Cell high = cellOf({std::max(a.x, b.x) + kSlack, std::max(a.y, b.y) + kSlack});
    std::vector<Cell> cells;
    for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) {
            cells.push_back({x, y});
        }
    }
    return cells;
}

/// Pieces of rim in the cells in which corners stand.
class PiecesByCell {
public:
    explicit PiecesByCell(const std::vector<CorneredLoop>& loops)
    {
        for (std::size_t k = 0; k < loops.size(); ++k) {
            for (const Corner& corner : loops[k].corners) {
                if (standsBetween(corner)) {
                    for (const Piece& piece : piecesOf(loops[k].slots, k, corner)) {
                        for (const Cell& cell : cellsAround(piece)) {
                            pieces_[cell].push_back(piece);
                        }
                    }
                }
            }
        }
        for (std::size_t k = 0; k < loops.size(); ++k) {
            addSlotPieces(loops[k], k);
        }
    }

    [[nodiscard]] bool touched(const Piece& piece) const
    {
        for (const Cell& cell : cellsAround(piece)) {
            for (const Piece& other : pieces_.at(cell)) {
                if (touch(piece, other)) {
                    return true;
                }
            }
        }
        return false;
    }

private:
    /// Adds the pieces between slots in cells with corners, except pieces that corners replace.
    void addSlotPieces(const CorneredLoop& loop, std::size_t id)
    {
        const std::size_t n = loop.slots.size();
        std::vector<std::uint8_t> replaced(n, 0);
        for (const Corner& corner : loop.corners) {
            for (std::size_t k = corner.turn.first; standsBetween(corner) && k != corner.turn.last; k = (k + 1) % n) {
                replaced[k] = 1;
            }
        }
        const auto slot = [&](std::size_t k) { return End{loop.slots[k].point(), id, k, false}; };
        std::vector<Piece> pieces;
        for (std::size_t k = 0; k < n; ++k) {
            if (k + 1 < n || !loop.ends) {
                pieces.push_back({slot(k), slot((k + 1) % n)});
            }
        }
        if (loop.ends) {
            pieces.push_back({slot(n - 1), {(*loop.ends)[1], id, n, false}});
            pieces.push_back({{(*loop.ends)[0], id, n + 1, false}, slot(0)});
        }
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            const Piece& piece = pieces[k];
            const auto there = pieces_.find(cellOf(0.5 * (piece.from.at + piece.to.at)));
            if ((k >= n || replaced[k] == 0) && there != pieces_.end()) {
                there->second.push_back(piece);
            }
        }
    }

    std::map<Cell, std::vector<Piece>> pieces_;
};

}  // namespace

std::vector<Turn> sharpTurns(const SlotLoop& loop, const Chord& chord, const std::vector<Turn>& known)
{
    const std::size_t n = loop.size();
    const Path path(loop);
    if (path.perimeter() < 4.0 * (chord.length + chord.gap)) {
        return known;
    }
    std::vector<double> sharpness(n);
    for (std::size_t i = 0; i < n; ++i) {
        sharpness[i] = turnBetweenChords(path, i, chord);
    }
    // Slots that are too near to a known turn.
    std::vector<std::uint8_t> taken(n, 0);
    for (const Turn& turn : known) {
        for (const bool forward : {false, true}) {
            std::size_t k = turn.first;
            double way = 0.0;
            for (std::size_t count = 0; count < n && way < chord.length + 2.0 * chord.gap; ++count) {
                taken[k] = 1;
                way += path.piece(k, forward);
                k = path.step(k, forward);
            }
        }
    }
    std::vector<Turn> turns = known;
    for (std::size_t i = 0; i < n; ++i) {
        if (sharpness[i] < kMinTriedTurn || taken[i] != 0) {
            continue;
        }
        // Keep the sharpest turn of a neighbourhood; of equal ones, the first.
        bool sharpest = true;
        for (const bool forward : {false, true}) {
            std::size_t j = i;
            double way = 0.0;
            while (sharpest) {
                way += path.piece(j, forward);
                j = path.step(j, forward);
                if (way > chord.gap + 1.0 || j == i) {
                    break;
                }
                sharpest = forward ? sharpness[i] >= sharpness[j] : sharpness[i] > sharpness[j];
            }
        }
        if (!sharpest) {
            continue;
        }
        const Turn turn = locate(loop, path, i, chord);
        bool free = true;
        for (std::size_t k = turn.first; k != turn.last; k = path.next(k)) {
            free = free && taken[k] == 0;
        }
        if (free) {
            for (std::size_t k = turn.first; k != turn.last; k = path.next(k)) {
                taken[k] = 1;
            }
            turns.push_back(turn);
        }
    }
    std::sort(turns.begin(), turns.end(), [](const Turn& a, const Turn& b) { return a.first < b.first; });
    return turns;
}

std::vector<Turn> relocated(const SlotLoop& loop, std::vector<Turn> turns)
{
    // The chords are well away from the turn, because the curve near it is biased toward the first guess.
    constexpr Chord kSides{3.0, 1.5};
    const Path path(loop);
    for (Turn& turn : turns) {
        turn = locate(loop, path, turn.first, kSides);
    }
    return turns;
}

std::vector<std::uint8_t> breaksAt(const std::vector<Turn>& turns, std::size_t slots)
{
    std::vector<std::uint8_t> breaks(slots, 0);
    for (const Turn& turn : turns) {
        for (std::size_t k = turn.first; k != turn.last; k = (k + 1) % slots) {
            breaks[k] = 1;
        }
    }
    return breaks;
}

std::optional<Corner> findCorner(const SlotLoop& loop, const std::vector<std::uint8_t>& breaks, const Turn& turn,
                                 const Coverage& coverage)
{
    const std::size_t n = loop.size();
    const Side before = fitSide(loop, breaks, turn.first, false);
    const Side after = fitSide(loop, breaks, turn.last, true);
    const std::optional<Vec2> tip = meet(before.line, after.line);
    const double min_turn = coverage ? kMinKeptTurn : kMinKeptTurnHard;
    if (!tip) {
        return std::nullopt;
    }
    const double turning = std::abs(angleBetween(before.line.direction, -1.0 * after.line.direction));
    if (turning < min_turn || turning > kMaxTurn) {
        return std::nullopt;
    }
    if (!coverage && std::max(before.bend, after.bend) > kMaxBend) {
        return std::nullopt;
    }
    const bool drops = (turn.first + 1) % n != turn.last;
    const double ahead_before = dot(*tip - before.end, before.line.direction);
    const double ahead_after = dot(*tip - after.end, after.line.direction);
    // A tip at the end of a side is that end; a tip further behind would fold the rim back.
    constexpr double kBehind = 0.35;
    constexpr double kAt = 0.05;
    if (std::min(ahead_before, ahead_after) < -kBehind || std::max(ahead_before, ahead_after) > kReach) {
        return std::nullopt;
    }
    if (!drops && std::min(ahead_before, ahead_after) < kAt) {
        const bool first_is_nearer = length(*tip - before.end) <= length(*tip - after.end);
        return Corner{turn, first_is_nearer ? before.end : after.end, first_is_nearer, !first_is_nearer};
    }
    const double added = 0.5 * std::abs(cross(*tip - before.end, after.end - before.end));
    if (added > kMaxAdded) {
        return std::nullopt;
    }
    const std::optional<Vec2> pixel = drops ? sharedPixel(loop, turn) : std::nullopt;
    if (std::min(ahead_before, ahead_after) < kAt || coversPixelCentre(before.end, *tip, after.end, pixel)) {
        return std::nullopt;
    }
    // Less area than this is within the error of the sides, which is a few hundredths of a pixel over their ends.
    constexpr double kMinCheckedArea = 0.15;
    if (coverage && added > kMinCheckedArea && !levelsAgree(before, after, *tip, coverage)) {
        return std::nullopt;
    }
    return Corner{turn, *tip, false, false};
}

void removeTouchingCorners(std::vector<CorneredLoop>& loops)
{
    // Removing a corner restores the pieces it replaced, which another corner may touch.
    for (bool changed = true; changed;) {
        changed = false;
        const PiecesByCell pieces(loops);
        for (std::size_t k = 0; k < loops.size(); ++k) {
            const auto touching = [&](const Corner& corner) {
                const std::array<Piece, 2> own = piecesOf(loops[k].slots, k, corner);
                return standsBetween(corner) && (pieces.touched(own[0]) || pieces.touched(own[1]));
            };
            changed = std::erase_if(loops[k].corners, touching) > 0 || changed;
        }
    }
}

}  // namespace droplet

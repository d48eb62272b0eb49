// SPDX-License-Identifier: GPL-3.0-or-later
//
// A line is a sequence of arcs, with straight pieces and corners as limits: an arc of length l that turns by t has at
// height h beside it an arc of length l − t h, which turns as much. So lines of text beside a path are exact, a circle
// is a path of one piece, and text goes round outer corners on arcs of radius h.
#include "type/base_line.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>

namespace droplet {

namespace {

Vec2 turned(Vec2 v, double angle)
{
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

double turnFrom(Vec2 before, Vec2 after)
{
    return std::atan2(cross(before, after), dot(before, after));
}

/// Half of an arc's turn over its sine: the ratio of its length to its chord.
double lengthOverChord(double turn)
{
    const double half = 0.5 * turn;
    return std::abs(half) < 1e-4 ? 1.0 + half * half / 6.0 : half / std::sin(half);
}

}  // namespace

std::vector<LinePiece> circlePieces(double radius)
{
    const double size = std::abs(radius);
    const double turn = radius > 0.0 ? -2.0 * std::numbers::pi : 2.0 * std::numbers::pi;
    return {{{0.0, radius > 0.0 ? -size : size}, {-1.0, 0.0}, 2.0 * std::numbers::pi * size, turn}};
}

std::vector<LinePiece> piecesOf(const std::vector<Vec2>& points)
{
    std::vector<Vec2> corners;
    corners.reserve(points.size());
    for (const Vec2 p : points) {
        if (corners.empty() || !(p == corners.back())) {
            corners.push_back(p);
        }
    }
    const std::size_t count = corners.size() - 1;
    std::vector<Vec2> chords;
    chords.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec2 chord = corners[i + 1] - corners[i];
        chords.push_back((1.0 / length(chord)) * chord);
    }
    const bool is_closed = count > 1 && corners.front() == corners.back();
    // Turns at the chords' ends; a smooth line's tangent halves them.
    std::vector<double> turns(count + 1, 0.0);
    for (std::size_t i = is_closed ? 0 : 1; i < count; ++i) {
        turns[i] = turnFrom(chords[(i + count - 1) % count], chords[i]);
    }
    turns[count] = is_closed ? turns[0] : 0.0;
    const auto is_corner = [&](std::size_t i) { return std::abs(turns[i]) > kCornerTurn; };
    std::vector<LinePiece> pieces;
    pieces.reserve(2 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const double before = is_corner(i) ? 0.0 : 0.5 * turns[i];
        const double after = is_corner(i + 1) ? 0.0 : 0.5 * turns[i + 1];
        if (is_corner(i) && i > 0) {
            pieces.push_back({corners[i], chords[i - 1], 0.0, turns[i]});
        }
        // An arc through both ends turns equally at both.
        const double turn = before + after;
        pieces.push_back({corners[i], turn == 0.0 ? chords[i] : turned(chords[i], -0.5 * turn),
                          length(corners[i + 1] - corners[i]) * lengthOverChord(turn), turn});
    }
    return pieces;
}

BaseLine::BaseLine(const std::vector<LinePiece>& pieces, double height) : height_(height)
{
    pieces_.reserve(pieces.size());
    ends_.reserve(pieces.size());
    double end = 0.0;
    for (const LinePiece& piece : pieces) {
        const double own = piece.length - piece.turn * height;
        if (own > 0.0) {
            end += own;
            pieces_.push_back(piece);
            ends_.push_back(end);
        }
    }
}

BaseLine::Place BaseLine::at(double distance) const
{
    const auto found = std::min(std::lower_bound(ends_.begin(), ends_.end(), distance), std::prev(ends_.end()));
    const LinePiece& piece = pieces_[static_cast<std::size_t>(std::distance(ends_.begin(), found))];
    const double begin = found == ends_.begin() ? 0.0 : *std::prev(found);
    const double share = (distance - begin) / (piece.length - piece.turn * height_);
    const double way = piece.turn == 0.0 ? distance - begin : share * piece.length;
    const double turn = share * piece.turn;
    const Vec2 along = turn == 0.0 ? piece.along : turned(piece.along, turn);
    const Vec2 chord = turn == 0.0 ? piece.along : turned(piece.along, 0.5 * turn);
    return {piece.begin + (way / lengthOverChord(turn)) * chord + height_ * Vec2{-along.y, along.x}, along};
}

}  // namespace droplet

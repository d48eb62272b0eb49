// SPDX-License-Identifier: GPL-3.0-or-later
// Whether an edge is halved depends on its ends alone, so both of its triangles agree and the result has no gaps. The
// middle of two points is the same number from either side, by which flowSurface() joins the pieces.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "droplet/flow/flow_surface.h"

namespace droplet {
namespace {

struct Piece {
    std::array<Vec3, 3> corners;
    std::uint32_t face = 0;  ///< that it is of
};

/// Halves the edges of a triangle that are longer than a length.
/// @return  number of pieces, which are added to `pieces`
std::size_t split(const Piece& whole, double longest, std::vector<Piece>& pieces)
{
    std::array<bool, 3> is_long{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        is_long[k] = length(whole.corners[(k + 1) % 3] - whole.corners[k]) > longest;
        count += is_long[k] ? 1 : 0;
    }
    const auto middle = [&](std::size_t k) { return 0.5 * (whole.corners[k % 3] + whole.corners[(k + 1) % 3]); };
    const auto add = [&](Vec3 a, Vec3 b, Vec3 c) { pieces.push_back({{a, b, c}, whole.face}); };
    if (count == 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            add(middle(k), whole.corners[(k + 1) % 3], middle(k + 1));
        }
        add(middle(0), middle(1), middle(2));
    } else if (count == 2) {
        // Sides a b and b c are long.
        const std::size_t k = !is_long[2] ? 0 : !is_long[0] ? 1 : 2;
        const Vec3 a = whole.corners[k];
        const Vec3 c = whole.corners[(k + 2) % 3];
        const Vec3 ab = middle(k);
        const Vec3 bc = middle(k + 1);
        add(ab, whole.corners[(k + 1) % 3], bc);
        if (length(c - ab) < length(bc - a)) {
            add(ab, bc, c);
            add(ab, c, a);
        } else {
            add(ab, bc, a);
            add(a, bc, c);
        }
    } else if (count == 1) {
        const std::size_t k = is_long[0] ? 0 : is_long[1] ? 1 : 2;
        add(whole.corners[k], middle(k), whole.corners[(k + 2) % 3]);
        add(middle(k), whole.corners[(k + 1) % 3], whole.corners[(k + 2) % 3]);
    } else {
        pieces.push_back(whole);
    }
    return count + 1;
}

}  // namespace

FlowSurface refined(const FlowSurface& surface, double longest, std::size_t most)
{
    std::vector<Piece> pieces;
    for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
        pieces.push_back({surface.faces[f].corners, f});
    }
    for (bool has_split = true; has_split;) {
        has_split = false;
        std::vector<Piece> next;
        next.reserve(2 * pieces.size());
        for (const Piece& piece : pieces) {
            has_split |= split(piece, longest, next) > 1;
        }
        if (next.size() > std::max(most, 2 * surface.faces.size())) {
            break;
        }
        pieces = std::move(next);
    }
    if (pieces.size() == surface.faces.size()) {
        return surface;
    }
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    for (const Piece& piece : pieces) {
        const auto first = static_cast<std::uint32_t>(vertices.size());
        vertices.insert(vertices.end(), piece.corners.begin(), piece.corners.end());
        triangles.push_back({first, first + 1, first + 2});
    }
    FlowSurface result = flowSurface(vertices, triangles);
    if (result.faces.size() != pieces.size()) {
        return surface;
    }
    for (FlowSurface::Face& face : result.faces) {
        face.source = surface.faces[pieces[face.source].face].source;
    }
    result.report = surface.report;
    return result;
}

}  // namespace droplet

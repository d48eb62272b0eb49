// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/surface/loft.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "blocks.h"
#include "droplet/error.h"
#include "droplet/mesh/triangulate.h"
#include "number_text.h"
#include "shape/area_vector.h"
#include "shape/recovered_normals.h"
#include "shape/sheet_base.h"
#include "surface/flat_map.h"
#include "surface/wet_part.h"

namespace droplet {
namespace {

/// Numbers of vertices and triangles, or indices of the first ones.
struct Counts {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
};

/// Droplet, or a part of one, with the place of its vertices and triangles in the result.
struct Piece {
    std::size_t droplet = 0;
    const CapillarySurface* liquid = nullptr;
    PlanarMesh base = {};  ///< empty if there is none
    TextureMap texture_map = TextureMap::Projection;
    double volume = 0.0;  ///< [m³]
    double area = 0.0;    ///< wet area of the footprint [m²]
    Counts begin = {};    ///< of the liquid; the base follows

    [[nodiscard]] std::uint32_t firstOfBase() const
    {
        return static_cast<std::uint32_t>(begin.vertices + liquid->vertices.size());
    }
};

Vec2 textureAt(Vec2 p, const LoftOptions& options)
{
    return {0.5 + p.x / options.extent.x, 0.5 - p.y / options.extent.y};
}

/// Sets the change per fill of the liquid's vertices and normals; rim and base stay.
///
/// A normal before normalisation is (−∇u, 1), which is affine in the volume. Its change is divided by its length at
/// fill 1, so that it can be added to the unit normal.
void fillRefill(const CapillarySurface& field, const FillGain& gain, std::size_t first, Surface& surface)
{
    CapillarySurface change = field;
    for (std::size_t v = 0; v < gain.height.size(); ++v) {
        change.vertices[v].z = gain.height[v];
    }
    for (std::size_t v = 0; v < gain.rim_slope.size(); ++v) {
        change.contact_angle[v] = std::atan(gain.rim_slope[v]);
    }
    const std::vector<Vec3> normals = recoveredNormals(change, {});
    RefillState& refill = surface.refill->states.front();
    forBlocks(normals.size(), [&](std::size_t from, std::size_t to) {
        for (std::size_t v = from; v < to; ++v) {
            const double shortened = surface.normals[first + v].z / normals[v].z;
            refill.vertices[first + v] = {0.0, 0.0, gain.height[v]};
            refill.normals[first + v] = {shortened * normals[v].x, shortened * normals[v].y, 0.0};
        }
    });
}

void fillLiquid(Piece& piece, const LoftOptions& options, Surface& surface)
{
    const CapillarySurface& liquid = *piece.liquid;
    const std::vector<Vec3> normals = recoveredNormals(liquid, options.ground);
    std::optional<FlatMap> map;
    if (!liquid.isHeightField()) {
        map = options.flatten ? flatMap(liquid) : projected(liquid);
        piece.texture_map = map->kind;
    }
    const auto first = static_cast<std::uint32_t>(piece.begin.vertices);
    forBlocks(liquid.vertices.size(), [&](std::size_t from, std::size_t to) {
        for (std::size_t v = from; v < to; ++v) {
            const Vec3& p = liquid.vertices[v];
            surface.vertices[first + v] = p;
            surface.normals[first + v] = normals[v];
            surface.uvs[first + v] = textureAt(map ? map->places[v] : Vec2{p.x, p.y}, options);
            surface.weld[first + v] = first + static_cast<std::uint32_t>(v);
        }
    });
    std::transform(liquid.contact_angle.begin(), liquid.contact_angle.end(), surface.contact_angle.begin() + first,
                   [](double angle) { return static_cast<float>(std::max(angle, 0.0)); });
    forBlocks(liquid.triangles.size(), [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) {
            const Triangle& t = liquid.triangles[i];
            surface.triangles[piece.begin.triangles + i] = {first + t[0], first + t[1], first + t[2]};
        }
    });
}

/// Adds the base. Its rim vertices are copies of the liquid's, with another normal.
void fillBase(const Piece& piece, const LoftOptions& options, Surface& surface)
{
    const std::uint32_t first = piece.firstOfBase();
    const auto liquid = static_cast<std::uint32_t>(piece.begin.vertices);
    forBlocks(piece.base.vertices.size(), [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) {
            const auto v = static_cast<std::uint32_t>(i);
            const Vec2 p = piece.base.vertices[v];
            const GroundPoint ground = options.ground.at(p);
            surface.vertices[first + v] =
                piece.base.onRim(v) ? surface.vertices[liquid + v] : Vec3{p.x, p.y, ground.height};
            surface.normals[first + v] = -1.0 * normalOf(ground);
            surface.uvs[first + v] = textureAt(p, options);
            surface.weld[first + v] = piece.base.onRim(v) ? liquid + v : first + v;
        }
    });
    const std::size_t begin = piece.begin.triangles + piece.liquid->triangles.size();
    forBlocks(piece.base.triangles.size(), [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) {
            const Triangle& t = piece.base.triangles[i];
            surface.triangles[begin + i] = {first + t[0], first + t[2], first + t[1]};
        }
    });
}

/// Area of the footprint without dry ground [m²].
double wetArea(const CapillarySurface& liquid)
{
    return sumOverBlocks(liquid.triangles.size(), [&](std::size_t begin, std::size_t end) {
        double sum = 0.0;
        for (std::size_t i = begin; i < end; ++i) {
            const Triangle& t = liquid.triangles[i];
            sum += isDry(liquid, t) ? 0.0 : areaVector(liquid.vertices, t).z;
        }
        return sum;
    });
}

void check(const std::vector<CapillarySurface>& surfaces, const LoftOptions& options)
{
    options.validate();
    if (!options.bases.empty() && options.bases.size() != surfaces.size()) {
        throw Error(ErrorCode::InvalidArgument, std::to_string(options.bases.size()) +
                                                    " bases must be none, or as many as the " +
                                                    std::to_string(surfaces.size()) + " surfaces");
    }
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
        surfaces[k].validate();
        if (!options.bases.empty() && options.bases[k].loop_starts != surfaces[k].loop_starts) {
            throw Error(ErrorCode::InvalidArgument,
                        "bases[" + std::to_string(k) + "] must have the rim of its surface");
        }
    }
    if (!options.refill) {
        return;
    }
    options.refill->range.validate();
    if (options.refill->gains.size() != surfaces.size()) {
        throw Error(ErrorCode::InvalidArgument, std::to_string(options.refill->gains.size()) +
                                                    " refill.gains must be as many as the " +
                                                    std::to_string(surfaces.size()) + " surfaces");
    }
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
        const FillGain& gain = options.refill->gains[k];
        if (gain.height.size() != surfaces[k].vertices.size() ||
            gain.rim_slope.size() != surfaces[k].rimVertexCount()) {
            throw Error(ErrorCode::InvalidArgument,
                        "refill.gains[" + std::to_string(k) + "] does not belong to its surface");
        }
        if (!surfaces[k].dry.empty() || !surfaces[k].isHeightField()) {
            throw Error(ErrorCode::InvalidArgument,
                        "surface " + std::to_string(k) +
                            (surfaces[k].isHeightField() ? " has dry ground" : " is no height field") +
                            ", so it has no gain per fill");
        }
    }
}

/// Base under a droplet, or under a part of one.
/// @param known  cover() of its rim, if it is known
PlanarMesh baseUnder(const CapillarySurface& liquid, bool is_flat, const PlanarMesh* known)
{
    if (!is_flat) {
        return footprintOf(liquid);
    }
    return known != nullptr ? *known : cover(rimOf(liquid));
}

/// Lists droplets and parts of droplets, with their bases.
/// @param wet  wetParts() of every droplet
std::vector<Piece> piecesOf(const std::vector<CapillarySurface>& surfaces,
                            const std::vector<std::optional<std::vector<CapillarySurface>>>& wet,
                            const LoftOptions& options)
{
    std::vector<Piece> pieces;
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
        if (!wet[k]) {
            pieces.push_back({.droplet = k, .liquid = &surfaces[k]});
            continue;
        }
        for (const CapillarySurface& part : *wet[k]) {
            pieces.push_back({.droplet = k, .liquid = &part});
        }
    }
    tbb::parallel_for(std::size_t{0}, options.open ? 0 : pieces.size(), [&](std::size_t i) {
        const std::size_t k = pieces[i].droplet;
        // The rim of a height field's part may touch itself, so that nothing can cover it.
        const bool may_touch = wet[k] && surfaces[k].isHeightField();
        pieces[i].base = baseUnder(*pieces[i].liquid, options.ground.flat() && !options.even_base && !may_touch,
                                   wet[k] || options.bases.empty() ? nullptr : &options.bases[k]);
    });
    return pieces;
}

/// Gives every piece its place in the surface. Returns the size of the surface.
Counts assignPlaces(std::vector<Piece>& pieces)
{
    Counts total;
    for (Piece& piece : pieces) {
        piece.begin = total;
        total.vertices += piece.liquid->vertices.size() + piece.base.vertices.size();
        total.triangles += piece.liquid->triangles.size() + piece.base.triangles.size();
    }
    return total;
}

/// Droplets of a surface; pieces of one droplet follow each other.
std::vector<SurfacePart> partsOf(const std::vector<Piece>& pieces, const Counts& total)
{
    std::vector<SurfacePart> parts;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        const Piece& piece = pieces[k];
        const Counts& end = k + 1 < pieces.size() ? pieces[k + 1].begin : total;
        if (parts.empty() || parts.back().droplet != piece.droplet) {
            parts.push_back({.droplet = piece.droplet,
                             .first_vertex = piece.begin.vertices,
                             .first_triangle = piece.begin.triangles});
        }
        SurfacePart& part = parts.back();
        part.vertices += end.vertices - piece.begin.vertices;
        part.triangles += end.triangles - piece.begin.triangles;
        part.volume += std::max(0.0, piece.volume);
        part.area += piece.area;
    }
    return parts;
}

}  // namespace

void LoftOptions::validate() const
{
    if (!(extent.x > 0.0 && extent.y > 0.0 && std::isfinite(extent.x) && std::isfinite(extent.y))) {
        throw Error(ErrorCode::InvalidArgument,
                    "extent " + numberText(extent.x) + " m × " + numberText(extent.y) + " m must be positive");
    }
}

Surface loft(const std::vector<CapillarySurface>& surfaces, const LoftOptions& options)
{
    check(surfaces, options);
    std::vector<std::optional<std::vector<CapillarySurface>>> wet(surfaces.size());
    tbb::parallel_for(std::size_t{0}, surfaces.size(), [&](std::size_t k) {
        const bool keeps_dry = options.keeps_dry && !surfaces[k].isHeightField();
        if (!surfaces[k].dry.empty() && !keeps_dry) {
            wet[k] = wetParts(surfaces[k], options.ground);
        }
    });
    std::vector<Piece> pieces = piecesOf(surfaces, wet, options);
    if (pieces.empty()) {
        throw Error(ErrorCode::InvalidArgument, "surfaces must leave some liquid; all of the footprint is dry");
    }
    const Counts total = assignPlaces(pieces);
    Surface surface;
    surface.vertices.resize(total.vertices);
    surface.normals.resize(total.vertices);
    surface.uvs.resize(total.vertices);
    surface.contact_angle.resize(total.vertices, 0.0F);
    surface.weld.resize(total.vertices);
    surface.triangles.resize(total.triangles);
    if (options.refill) {
        const FillRange& range = options.refill->range;
        surface.refill =
            Refill{range.min, range.max, {{2.0, std::vector<Vec3>(total.vertices), std::vector<Vec3>(total.vertices)}}};
    }
    tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t k) {
        Piece& piece = pieces[k];
        fillLiquid(piece, options, surface);
        fillBase(piece, options, surface);
        if (options.refill) {  // without dry ground, pieces are the droplets
            fillRefill(*piece.liquid, options.refill->gains[k], piece.begin.vertices, surface);
        }
        piece.volume = liquidVolume(*piece.liquid, options.ground);
        piece.area = wetArea(*piece.liquid);
    });
    double volume = 0.0;
    double area = 0.0;
    for (const Piece& piece : pieces) {
        volume += piece.volume;
        area += piece.area;
        surface.texture_map = std::max(surface.texture_map, piece.texture_map);
    }
    surface.mean_height = volume / area;
    surface.parts = partsOf(pieces, total);
    return surface;
}

void append(Surface& surface, const Surface& more)
{
    if (more.triangles.empty()) {
        return;
    }
    const auto first = static_cast<std::uint32_t>(surface.vertices.size());
    if ((surface.parts.empty() && first > 0) || more.parts.empty()) {
        surface.parts.clear();
    } else {
        for (SurfacePart part : more.parts) {
            part.first_vertex += first;
            part.first_triangle += surface.triangles.size();
            surface.parts.push_back(part);
        }
    }
    const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    add(surface.vertices, more.vertices);
    add(surface.normals, more.normals);
    add(surface.uvs, more.uvs);
    add(surface.contact_angle, more.contact_angle);
    surface.texture_map = std::max(surface.texture_map, more.texture_map);
    for (const std::uint32_t v : more.weld) {
        surface.weld.push_back(first + v);
    }
    for (const Triangle& t : more.triangles) {
        surface.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals are those of the recovered gradient, an area-weighted mean: O. C. Zienkiewicz and J. Z. Zhu, "A simple error
// estimator and adaptive procedure for practical engineering analysis" (1987). On the rim a mean is one-sided and less
// accurate by one order, so the slope that balances the rim's force is used (see solve).

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
#include "shape/recovered_gradients.h"
#include "shape/sheet_base.h"
#include "shape/sheet_mesh.h"
#include "surface/flat_map.h"
#include "surface/rim_normals.h"
#include "surface/wet_part.h"

namespace droplet {
namespace {

/// Recovered gradients; on the rim from the slope across it and the ground along it.
std::vector<Vec2> surfaceGradients(const PlanarMesh& mesh, const HeightField& field, const BaseSurface& ground)
{
    std::vector<Vec2> gradients = recoveredGradients(mesh, field.height);
    const std::vector<Vec2> outward = rimNormals(mesh);
    for (std::uint32_t v = 0; v < mesh.rimVertexCount(); ++v) {
        gradients[v] = -field.rim_slope[v] * outward[v];
        if (!ground.flat()) {
            const Vec2 along_rim{-outward[v].y, outward[v].x};
            gradients[v] = gradients[v] + dot(ground.at(mesh.vertices[v]).gradient, along_rim) * along_rim;
        }
    }
    return gradients;
}

Vec3 normalOf(Vec2 g)
{
    const double size = std::sqrt(1.0 + dot(g, g));
    return {-g.x / size, -g.y / size, 1.0 / size};
}

/// Numbers of vertices and triangles, or indices of the first ones.
struct Counts {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
};

/// Sets the change per fill of the liquid's vertices and normals; rim and base stay.
///
/// A normal before normalisation is (−∇u, 1), which is affine in the volume. Its change is divided by its length at
/// fill 1, so that it can be added to the unit normal.
void fillRefill(const PlanarMesh& mesh, const FillGain& gain, std::size_t first, Surface& surface)
{
    std::vector<Vec2> gradients = recoveredGradients(mesh, gain.height);
    const std::vector<Vec2> outward = rimNormals(mesh);
    for (std::uint32_t v = 0; v < mesh.rimVertexCount(); ++v) {
        gradients[v] = -gain.rim_slope[v] * outward[v];
    }
    RefillState& refill = surface.refill->states.front();
    forBlocks(mesh.vertices.size(), [&](std::size_t from, std::size_t to) {
        for (std::size_t v = from; v < to; ++v) {
            const double shortened = surface.normals[first + v].z;
            refill.positions[first + v] = {0.0, 0.0, gain.height[v]};
            refill.normals[first + v] = {-shortened * gradients[v].x, -shortened * gradients[v].y, 0.0};
        }
    });
}

/// Droplet, or a part of one, with the place of its vertices and triangles in the surface.
struct Piece {
    std::size_t droplet = 0;
    const PlanarMesh* mesh = nullptr;
    const HeightField* field = nullptr;
    bool mirrored = false;  ///< whether its base has the triangles of the liquid
    PlanarMesh cover;       ///< base, if it is not mirrored
    Counts liquid;
    Counts base;

    [[nodiscard]] const PlanarMesh& baseMesh() const { return mirrored ? *mesh : cover; }
};

Vec2 textureAt(Vec2 p, const LoftOptions& options)
{
    return {0.5 + p.x / options.extent.x, 0.5 - p.y / options.extent.y};
}

void fillLiquid(const PlanarMesh& mesh, const HeightField& field, const LoftOptions& options, const Counts& begin,
                Surface& surface)
{
    const std::vector<Vec2> gradients = surfaceGradients(mesh, field, options.ground);
    const auto first = static_cast<std::uint32_t>(begin.vertices);
    forBlocks(mesh.vertices.size(), [&](std::size_t from, std::size_t to) {
        for (std::size_t v = from; v < to; ++v) {
            const Vec2 p = mesh.vertices[v];
            surface.positions[first + v] = {p.x, p.y, field.height[v]};
            surface.normals[first + v] = normalOf(gradients[v]);
            surface.uvs[first + v] = textureAt(p, options);
            surface.weld[first + v] = first + static_cast<std::uint32_t>(v);
        }
    });
    std::transform(field.contact_angle.begin(), field.contact_angle.end(), surface.contact_angle.begin() + first,
                   [](double angle) { return static_cast<float>(angle); });
    forBlocks(mesh.triangles.size(), [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) {
            const Triangle& t = mesh.triangles[i];
            surface.triangles[begin.triangles + i] = {first + t[0], first + t[1], first + t[2]};
        }
    });
}

/// Adds the base. Its rim vertices are copies of the liquid's, with another normal.
void fillBase(const Piece& piece, const LoftOptions& options, Surface& surface)
{
    const PlanarMesh& mesh = piece.baseMesh();
    const auto first = static_cast<std::uint32_t>(piece.base.vertices);
    const auto liquid = static_cast<std::uint32_t>(piece.liquid.vertices);
    forBlocks(mesh.vertices.size(), [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) {
            const auto v = static_cast<std::uint32_t>(i);
            const Vec2 p = mesh.vertices[v];
            surface.positions[first + v] =
                mesh.onRim(v) ? surface.positions[liquid + v] : Vec3{p.x, p.y, piece.field->groundAt(v)};
            surface.normals[first + v] = -1.0 * normalOf(options.ground.at(p).gradient);
            surface.uvs[first + v] = textureAt(p, options);
            surface.weld[first + v] = mesh.onRim(v) ? liquid + v : first + v;
        }
    });
    forBlocks(mesh.triangles.size(), [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) {
            const Triangle& t = mesh.triangles[i];
            surface.triangles[piece.base.triangles + i] = {first + t[0], first + t[2], first + t[1]};
        }
    });
}

/// Volume and area of a droplet, for the mean height.
struct Extent {
    double volume = 0.0;
    double area = 0.0;
};

Extent extentOf(const PlanarMesh& mesh, const HeightField& field)
{
    const auto sum_over = [](const std::vector<double>& values, const Triangle& t) {
        return values[t[0]] + values[t[1]] + values[t[2]];
    };
    const bool on_plane = field.ground.empty();
    Extent total;
    for (const Extent& block : mapBlocks<Extent>(mesh.triangles.size(), [&](std::size_t begin, std::size_t end) {
             Extent sum;
             for (std::size_t i = begin; i < end; ++i) {
                 const Triangle& t = mesh.triangles[i];
                 const double area = 0.5 * doubleArea(mesh, t);
                 sum.area += area;
                 sum.volume += area * (sum_over(field.height, t) - (on_plane ? 0.0 : sum_over(field.ground, t))) / 3.0;
             }
             return sum;
         })) {
        total.volume += block.volume;
        total.area += block.area;
    }
    return total;
}

bool hasDry(const HeightField& field)
{
    return std::any_of(field.dry.begin(), field.dry.end(), [](std::uint8_t dry) { return dry != 0; });
}

void check(const PlanarMesh& mesh, const HeightField& field, const LoftOptions& options, std::size_t k)
{
    const std::size_t vertices = mesh.vertices.size();
    const std::size_t rim = mesh.rimVertexCount();
    const auto all_or_none = [vertices](std::size_t count) { return count == 0 || count == vertices; };
    if (field.height.size() != vertices || !all_or_none(field.ground.size()) || !all_or_none(field.dry.size()) ||
        field.rim_slope.size() != rim || field.contact_angle.size() != rim) {
        throw Error(ErrorCode::InvalidArgument, "field " + std::to_string(k) + " does not belong to its mesh");
    }
    if (field.ground.empty() != options.ground.flat()) {
        throw Error(ErrorCode::InvalidArgument, "ground must be the one that field " + std::to_string(k) +
                                                    " was solved on, which is " +
                                                    (field.ground.empty() ? "flat" : "not flat"));
    }
}

void check(const std::vector<PlanarMesh>& meshes, const std::vector<HeightField>& fields, const LoftRefill& refill)
{
    refill.range.validate();
    if (refill.gains.size() != meshes.size()) {
        throw Error(ErrorCode::InvalidArgument, std::to_string(refill.gains.size()) +
                                                    " refill.gains must be as many as the " +
                                                    std::to_string(meshes.size()) + " meshes");
    }
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        if (refill.gains[k].height.size() != meshes[k].vertices.size() ||
            refill.gains[k].rim_slope.size() != meshes[k].rimVertexCount()) {
            throw Error(ErrorCode::InvalidArgument,
                        "refill.gains[" + std::to_string(k) + "] does not belong to its mesh");
        }
        if (hasDry(fields[k])) {
            throw Error(ErrorCode::InvalidArgument,
                        "field " + std::to_string(k) + " has dry ground, so it cannot be refilled");
        }
    }
}

/// Lists droplets and parts of droplets.
/// @param wet  parts of the droplets that have dry vertices
std::vector<Piece> piecesOf(const std::vector<PlanarMesh>& meshes, const std::vector<HeightField>& fields,
                            const std::vector<std::vector<WetPart>>& wet, const LoftOptions& options)
{
    std::vector<Piece> pieces;
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        for (const WetPart& part : wet[k]) {
            pieces.push_back({k, &part.mesh, &part.field, true, {}, {}, {}});
        }
        if (!hasDry(fields[k])) {
            Piece& piece = pieces.emplace_back();
            piece.droplet = k;
            piece.mesh = &meshes[k];
            piece.field = &fields[k];
            piece.mirrored = !options.ground.flat();
            if (!options.open && !piece.mirrored && !options.bases.empty()) {
                piece.cover = options.bases[k];
            }
        }
    }
    tbb::parallel_for(std::size_t{0}, options.open ? 0 : pieces.size(), [&](std::size_t k) {
        if (!pieces[k].mirrored && pieces[k].cover.vertices.empty()) {
            pieces[k].cover = cover(*pieces[k].mesh);
        }
    });
    return pieces;
}

/// Gives every piece its place in the surface. Returns the size of the surface.
Counts assignPlaces(std::vector<Piece>& pieces, bool open)
{
    Counts total;
    const auto take = [&total](Counts& begin, const PlanarMesh& mesh) {
        begin = total;
        total.vertices += mesh.vertices.size();
        total.triangles += mesh.triangles.size();
    };
    for (Piece& piece : pieces) {
        take(piece.liquid, *piece.mesh);
        if (!open) {
            take(piece.base, piece.baseMesh());
        }
    }
    return total;
}

/// Droplets of a surface; pieces of one droplet follow each other.
std::vector<SurfacePart> partsOf(const std::vector<Piece>& pieces, const std::vector<Extent>& extents,
                                 const Counts& total)
{
    std::vector<SurfacePart> parts;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        const Counts& begin = pieces[k].liquid;
        const Counts end = k + 1 < pieces.size() ? pieces[k + 1].liquid : total;
        if (parts.empty() || parts.back().droplet != pieces[k].droplet) {
            SurfacePart& part = parts.emplace_back();
            part.droplet = pieces[k].droplet;
            part.first_vertex = begin.vertices;
            part.first_triangle = begin.triangles;
        }
        SurfacePart& part = parts.back();
        part.vertices += end.vertices - begin.vertices;
        part.triangles += end.triangles - begin.triangles;
        part.volume += std::max(0.0, extents[k].volume);
        part.area += extents[k].area;
    }
    return parts;
}

/// Surface of the parts of one droplet.
Surface loftAll(const std::vector<ParametricSheet>& parts, LoftOptions options)
{
    options.keeps_dry = true;
    Surface surface;
    SurfacePart whole;
    for (const ParametricSheet& part : parts) {
        options.bases = {part.footprint};
        append(surface, loft(part, options));
        whole.area += surface.parts.back().area;
    }
    whole.vertices = surface.positions.size();
    whole.triangles = surface.triangles.size();
    if (!parts.empty()) {
        surface.parts = {whole};
    }
    return surface;
}

}  // namespace

void LoftOptions::validate() const
{
    if (!(extent.x > 0.0 && extent.y > 0.0 && std::isfinite(extent.x) && std::isfinite(extent.y))) {
        throw Error(ErrorCode::InvalidArgument,
                    "extent " + numberText(extent.x) + " m × " + numberText(extent.y) + " m must be positive");
    }
}

Surface loft(const std::vector<PlanarMesh>& meshes, const std::vector<HeightField>& fields, const LoftOptions& options)
{
    options.validate();
    if (meshes.size() != fields.size()) {
        throw Error(ErrorCode::InvalidArgument, "fields must have " + std::to_string(meshes.size()) +
                                                    " entries, one per mesh, not " + std::to_string(fields.size()));
    }
    if (!options.bases.empty() && options.bases.size() != meshes.size()) {
        throw Error(ErrorCode::InvalidArgument, std::to_string(options.bases.size()) +
                                                    " bases must be none, or as many as the " +
                                                    std::to_string(meshes.size()) + " meshes");
    }
    std::vector<std::vector<WetPart>> wet(meshes.size());
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        check(meshes[k], fields[k], options, k);
        if (!options.bases.empty() && options.bases[k].loop_starts != meshes[k].loop_starts) {
            throw Error(ErrorCode::InvalidArgument, "bases[" + std::to_string(k) + "] must have the rim of its mesh");
        }
    }
    tbb::parallel_for(std::size_t{0}, meshes.size(), [&](std::size_t k) {
        if (hasDry(fields[k])) {
            wet[k] = wetParts(meshes[k], fields[k], options.ground);
        }
    });
    if (options.refill) {
        check(meshes, fields, *options.refill);
    }
    std::vector<Piece> pieces = piecesOf(meshes, fields, wet, options);
    if (pieces.empty()) {
        throw Error(ErrorCode::InvalidArgument, "fields must leave some liquid; all of the footprint is dry");
    }
    const Counts total = assignPlaces(pieces, options.open);
    Surface surface;
    surface.positions.resize(total.vertices);
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
    std::vector<Extent> extents(pieces.size());
    tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t k) {
        fillLiquid(*pieces[k].mesh, *pieces[k].field, options, pieces[k].liquid, surface);
        if (!options.open) {
            fillBase(pieces[k], options, surface);
        }
        if (options.refill) {  // without dry ground, pieces are the droplets
            fillRefill(*pieces[k].mesh, options.refill->gains[k], pieces[k].liquid.vertices, surface);
        }
        extents[k] = extentOf(*pieces[k].mesh, *pieces[k].field);
    });
    Extent whole;
    for (const Extent& extent : extents) {
        whole.volume += extent.volume;
        whole.area += extent.area;
    }
    surface.mean_height = whole.volume / whole.area;
    surface.parts = partsOf(pieces, extents, total);
    return surface;
}

Surface loft(const ParametricSheet& sheet, const LoftOptions& options)
{
    options.validate();
    const PlanarMesh& footprint = sheet.footprint;
    if (sheet.rim != footprint.rimVertexCount() || sheet.contact_angle.size() != sheet.rim) {
        throw Error(ErrorCode::InvalidArgument, "the sheet's rim must be that of its footprint");
    }
    if (options.ground.flat() && !options.keeps_dry) {
        if (const std::optional<std::vector<ParametricSheet>> parts = wetParts(sheet)) {
            return loftAll(*parts, options);
        }
    }
    HeightField ground;
    if (!options.ground.flat()) {
        ground.ground = heightsUnder(footprint, options.ground);
    }
    Piece piece{
        0, &footprint, &ground, !options.ground.flat(), {}, {}, {sheet.vertices.size(), sheet.triangles.size()}};
    Counts total = piece.base;
    if (!options.open) {
        if (!piece.mirrored) {
            piece.cover = options.bases.empty() ? cover(footprint) : options.bases.front();
        }
        total.vertices += piece.baseMesh().vertices.size();
        total.triangles += piece.baseMesh().triangles.size();
    }
    Surface surface;
    surface.positions = sheet.vertices;
    surface.triangles = sheet.triangles;
    surface.normals.resize(total.vertices);
    for (const Triangle& t : sheet.triangles) {
        const Vec3 normal = areaVector(sheet.vertices, t);
        for (const std::uint32_t v : t) {
            surface.normals[v] = surface.normals[v] + normal;
        }
    }
    // On the rim the mean is one-sided; there the contact angle is exact.
    const std::vector<Vec2> outward = rimNormals(footprint);
    for (std::uint32_t v = 0; v < sheet.rim; ++v) {
        const Vec2 slope = options.ground.at(footprint.vertices[v]).gradient;
        const Vec2 along{-outward[v].y, outward[v].x};
        const Vec3 up = normalOf(slope);
        const Vec3 side = cross({along.x, along.y, dot(slope, along)}, up);
        surface.normals[v] =
            std::sin(sheet.contact_angle[v]) / length(side) * side + std::cos(sheet.contact_angle[v]) * up;
    }
    surface.contact_angle.assign(sheet.contact_angle.begin(), sheet.contact_angle.end());
    const FlatMap map = options.flatten ? flatMap(sheet) : projected(sheet);
    surface.texture_map = map.kind;
    for (std::uint32_t v = 0; v < sheet.vertices.size(); ++v) {
        surface.normals[v] = (1.0 / length(surface.normals[v])) * surface.normals[v];
        surface.uvs.push_back(textureAt(map.places[v], options));
        surface.weld.push_back(v);
    }
    surface.positions.resize(total.vertices);
    surface.uvs.resize(total.vertices);
    surface.contact_angle.resize(total.vertices, 0.0F);
    surface.weld.resize(total.vertices);
    surface.triangles.resize(total.triangles);
    if (!options.open) {
        fillBase(piece, options, surface);
    }
    surface.parts = {{.vertices = total.vertices, .triangles = total.triangles, .area = area(footprint)}};
    return surface;
}

void append(Surface& surface, const Surface& more)
{
    if (more.triangles.empty()) {
        return;
    }
    const auto first = static_cast<std::uint32_t>(surface.positions.size());
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
    add(surface.positions, more.positions);
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

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The union of droplets and a plate below them, without a Boolean operation: the liquid's rims lie in the plane of the
// plate's top. So the top is the plate's outline with these rims as holes, and also what is dry inside the liquid's own
// holes: all loops together by the even-odd rule, covered as a droplet's base is.

#include "droplet/surface/plate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "box_corners.h"
#include "droplet/error.h"
#include "droplet/mesh/triangulate.h"
#include "droplet/surface/loft.h"
#include "droplet/units.h"
#include "mesh/narrow_parts.h"
#include "number_text.h"
#include "surface/open_edges.h"

namespace droplet {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Width of the plate beside the liquid, and radius of its corners, in thicknesses.
constexpr double kMargin = 2.0;

/// Edges of one rounded corner: within 0.5 % of its radius.
constexpr int kCornerEdges = 8;

/// Loops of edges without a neighbour, with the liquid on their right, as they bound the plate's top.
std::vector<std::vector<std::uint32_t>> dryLoops(const Surface& surface)
{
    const std::vector<DirectedEdge> edges = openEdges(surface.triangles);
    std::vector<bool> is_met(surface.vertices.size());
    for (const auto& [v, to] : edges) {
        if (surface.vertices[v].z != 0.0 || is_met[v]) {
            throw Error(ErrorCode::InvalidArgument,
                        "surfaces must have rims at height 0 that do not touch themselves, to lie on a plate");
        }
        is_met[v] = true;
    }
    return loopsOf(edges);
}

/// Point of the plate's outline, with the direction outward.
struct OutlinePoint {
    Vec2 place;
    Vec2 outward;
};

/// Rectangle around the liquid, widened by the margin, counter-clockwise.
std::vector<OutlinePoint> outlineAround(const std::vector<Vec3>& liquid, double margin)
{
    const auto [lower, upper] = cornersOf(liquid);
    const Vec3 size = upper - lower;
    std::vector<OutlinePoint> outline;
    for (int corner = 0; corner < 4; ++corner) {  // from the upper right one
        const Vec2 centre{corner == 0 || corner == 3 ? upper.x : lower.x, corner < 2 ? upper.y : lower.y};
        Vec2 outward;
        for (int k = 0; k <= kCornerEdges; ++k) {
            const double angle = 0.5 * std::numbers::pi * (corner + static_cast<double>(k) / kCornerEdges);
            outward = {std::cos(angle), std::sin(angle)};
            outline.push_back({centre + margin * outward, outward});
        }
        // The side to the next corner has points as well, as a fan of long triangles prints badly and shades worse.
        const double side = corner % 2 == 0 ? size.x : size.y;
        const Vec2 along = corner % 2 == 0 ? Vec2{corner == 0 ? -1.0 : 1.0, 0.0} : Vec2{0.0, corner == 1 ? -1.0 : 1.0};
        const auto pieces = static_cast<int>(std::clamp(std::round(side / margin), 1.0, 100.0));
        const Vec2 begin = outline.back().place;
        for (int k = 1; k < pieces; ++k) {
            outline.push_back({begin + (side * k / pieces) * along, outward});
        }
    }
    return outline;
}

PlanarMesh loopOf(const std::vector<OutlinePoint>& outline)
{
    PlanarMesh loop;
    for (const OutlinePoint& point : outline) {
        loop.vertices.push_back(point.place);
    }
    loop.loop_starts = {0, static_cast<std::uint32_t>(outline.size())};
    return loop;
}

/// Surface to which a plate is added.
class PlateBuilder {
public:
    PlateBuilder(Surface& surface, const PlateOptions& options) : surface_(surface), options_(options) {}

    /// Adds the plate.
    /// @param outline  counter-clockwise
    /// @param top      loops that bound its top: the outline, and those of liquid
    /// @param rim      earlier vertices at the points of `top`, or kNone; may be shorter
    /// @return         area of its underside [m²]
    double addPlate(const std::vector<OutlinePoint>& outline, const PlanarMesh& top,
                    const std::vector<std::uint32_t>& rim)
    {
        const PlanarMesh underside = cover(loopOf(outline));
        const std::uint32_t upper = addCover(cover(top), 0.0, true, rim);
        const std::uint32_t lower = addCover(underside, -options_.thickness, false, {});
        addSide(outline, upper, lower);
        return area(underside);
    }

private:
    /// Adds a vertex.
    /// @param place   of an earlier vertex, or of its own
    std::uint32_t add(Vec3 place, Vec3 normal, std::optional<std::uint32_t> same = {})
    {
        const auto index = static_cast<std::uint32_t>(surface_.vertices.size());
        surface_.vertices.push_back(place);
        surface_.normals.push_back(normal);
        surface_.uvs.push_back({0.5 + place.x / options_.extent.x, 0.5 - place.y / options_.extent.y});
        if (!surface_.contact_angle.empty()) {
            surface_.contact_angle.push_back(0.0F);
        }
        surface_.weld.push_back(same ? surface_.weld[*same] : index);
        return index;
    }

    /// Adds a cover of loops, at one height.
    /// @param rim  earlier vertices at the loops' points, if there are some
    /// @return     index of its first vertex
    std::uint32_t addCover(const PlanarMesh& mesh, double height, bool faces_up, const std::vector<std::uint32_t>& rim)
    {
        const auto first = static_cast<std::uint32_t>(surface_.vertices.size());
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
            const bool is_copy = v < rim.size() && rim[v] != kNone;
            const Vec2& p = mesh.vertices[v];
            add({p.x, p.y, height}, {0.0, 0.0, faces_up ? 1.0 : -1.0}, is_copy ? std::optional(rim[v]) : std::nullopt);
        }
        for (const auto& [a, b, c] : mesh.triangles) {
            surface_.triangles.push_back(faces_up ? Triangle{first + a, first + b, first + c}
                                                  : Triangle{first + a, first + c, first + b});
        }
        return first;
    }

    /// Adds the side.
    /// @param top, bottom  first vertices of the outline
    void addSide(const std::vector<OutlinePoint>& outline, std::uint32_t top, std::uint32_t bottom)
    {
        const auto first = static_cast<std::uint32_t>(surface_.vertices.size());
        const auto count = static_cast<std::uint32_t>(outline.size());
        for (std::uint32_t k = 0; k < count; ++k) {
            const Vec3 outward{outline[k].outward.x, outline[k].outward.y, 0.0};
            add(surface_.vertices[top + k], outward, top + k);
            add(surface_.vertices[bottom + k], outward, bottom + k);
        }
        for (std::uint32_t k = 0; k < count; ++k) {
            const std::uint32_t here = first + 2 * k;
            const std::uint32_t next = first + 2 * ((k + 1) % count);
            surface_.triangles.push_back({here, here + 1, next + 1});
            surface_.triangles.push_back({here, next + 1, next});
        }
    }

    Surface& surface_;
    const PlateOptions& options_;
};

}  // namespace

void PlateOptions::validate() const
{
    if (!(thickness > 0.0 && std::isfinite(thickness))) {
        throw Error(ErrorCode::InvalidArgument, "thickness " + numberText(thickness) + " m must be positive");
    }
    if (!(extent.x > 0.0 && extent.y > 0.0 && std::isfinite(extent.x) && std::isfinite(extent.y))) {
        throw Error(ErrorCode::InvalidArgument,
                    "extent " + numberText(extent.x) + " m × " + numberText(extent.y) + " m must be positive");
    }
}

Surface onPlate(const std::vector<CapillarySurface>& surfaces, const PlateOptions& options)
{
    options.validate();
    Surface surface = loft(surfaces, {.open = true, .extent = options.extent});
    const std::vector<OutlinePoint> outline = outlineAround(surface.vertices, kMargin * options.thickness);
    PlanarMesh top = loopOf(outline);
    std::vector<std::uint32_t> rim(outline.size(), kNone);
    for (const std::vector<std::uint32_t>& loop : dryLoops(surface)) {
        for (const std::uint32_t v : loop) {
            top.vertices.push_back({surface.vertices[v].x, surface.vertices[v].y});
            rim.push_back(v);
        }
        top.loop_starts.push_back(static_cast<std::uint32_t>(top.vertices.size()));
    }
    PlateBuilder(surface, options).addPlate(outline, top, rim);
    SurfacePart whole{.vertices = surface.vertices.size(), .triangles = surface.triangles.size()};
    for (const SurfacePart& part : surface.parts) {
        whole.volume += part.volume;
        whole.area += part.area;
    }
    surface.parts = {whole};
    return surface;
}

Surface withPlate(Surface droplets, std::size_t number, const PlateOptions& options)
{
    options.validate();
    if (droplets.parts.empty()) {
        throw Error(ErrorCode::InvalidArgument, "droplets must have parts, to get a plate as another one");
    }
    SurfacePart plate{
        .droplet = number, .first_vertex = droplets.vertices.size(), .first_triangle = droplets.triangles.size()};
    const std::vector<OutlinePoint> outline = outlineAround(droplets.vertices, kMargin * options.thickness);
    plate.area = PlateBuilder(droplets, options).addPlate(outline, loopOf(outline), {});
    plate.vertices = droplets.vertices.size() - plate.first_vertex;
    plate.triangles = droplets.triangles.size() - plate.first_triangle;
    droplets.parts.push_back(plate);
    return droplets;
}

std::optional<std::string> printWarning(const std::vector<PlanarMesh>& footprints,
                                        const std::vector<ShapeFigures>& droplets, const PlateOptions& plate)
{
    constexpr double kNozzle = 0.4e-3;
    constexpr double kLayer = 0.2e-3;
    std::vector<std::string> texts;
    const double side = std::max(plate.extent.x, plate.extent.y);
    const std::string thick = numberText(plate.thickness / kMillimetre, 6);
    if (plate.thickness < 2.0 * kLayer) {
        texts.push_back(
            fmt::format("the plate is {} mm thick, which is less than two layers of 0.2 mm; make it thicker", thick));
    } else if (2.0 * kMargin * plate.thickness > side) {
        texts.push_back(fmt::format(
            "the plate is {} mm thick and two thicknesses wider than the liquid on every side, so its margins are "
            "wider than the picture of {} mm; make it thinner",
            thick, numberText(side / kMillimetre, 3)));
    }
    const auto low = std::count_if(droplets.begin(), droplets.end(), [](const ShapeFigures& figures) {
        return figures.volume > 0.0 && figures.height_max < kLayer;
    });
    std::size_t narrow = 0;
    double narrow_area = 0.0;
    for (std::size_t k = 0; k < footprints.size(); ++k) {
        const double area = droplets[k].volume > 0.0 ? narrowArea(footprints[k], kNozzle) : 0.0;
        narrow += area > 0.0 ? 1 : 0;
        narrow_area += area;
    }
    const auto are = [](auto count) { return count == 1 ? "is" : "are"; };
    if (low > 0) {
        texts.push_back(
            fmt::format("{} of {} droplets {} lower than a layer of 0.2 mm", low, droplets.size(), are(low)));
    }
    if (narrow > 0) {
        texts.push_back(fmt::format("{} of {} droplets {} narrower than a nozzle of 0.4 mm on {} mm²", narrow,
                                    footprints.size(), are(narrow), numberText(1e6 * narrow_area, 2)));
    }
    if (low > 0 || narrow > 0) {
        texts.back() +=
            low + static_cast<std::ptrdiff_t>(narrow) == 1 ? ", so a print may lose it" : ", so a print may lose them";
        texts.back() += "; make the picture wider";
    }
    return texts.empty() ? std::nullopt : std::optional(fmt::format("{}", fmt::join(texts, "; ")));
}

}  // namespace droplet

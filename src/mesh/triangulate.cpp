// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles are even where the liquid bends everywhere: strokes of type and logos are at most a capillary length wide,
// and grading gains little. In puddles only a layer along the rim bends. On a disc of radius 10 capillary lengths with
// 10 000 triangles, edges three times as long in the middle as at the rim have a third of the error.

#include "droplet/mesh/triangulate.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "mesh/aligned_points.h"
#include "mesh/band.h"
#include "mesh/lattice_core.h"
#include "mesh/mean_edge.h"
#include "mesh/rim_sampling.h"
#include "mesh/smoothing.h"
#include "number_text.h"

namespace droplet {
namespace {

/// Nothing is refined below this share of the loops' own detail. With half of it, strips a tenth of a pixel wide take
/// eight times the triangles and gain a few degrees.
constexpr double kFinest = 0.07;

constexpr double kRoot3 = std::numbers::sqrt3;

/// More triangles would need more vertices than there are indices.
constexpr double kMaxTriangles = 4e9;

/// Maximum number of triangles that the detail of an outline may cause beyond the requested number. Refinement doubles
/// or triples it, and three million triangles take half a minute and a gigabyte.
constexpr double kMaxDetailTriangles = 1 << 20;

/// Number of triangles over the requested one that is as good.
constexpr double kSlack = 1.1;

constexpr int kMaxGrading = 64;

/// Triangles of one vertex of a cover that make a fan, which is divided. Six are even.
constexpr std::size_t kManyTriangles = 10;

/// Rounds of dividing fans. Of pictures with up to 22 triangles around a vertex, one leaves 16 and two 13 to 15.
constexpr int kRounds = 2;

/// Layers that fit into the area over the length of the rim from which on liquid is wide: a disc of a radius of 4.
constexpr double kWide = 2.0;

/// How triangles cover the inside.
struct Pattern {
    int longest = 1;       ///< times the edges along the rim
    double layer = 0.0;    ///< as of layeredPoints(); 0: none
    bool squares = false;  ///< as of alignedPoints(); the others are then not used
};

/// Length of the edges of equilateral triangles.
double evenEdge(double area, std::size_t triangles)
{
    return std::sqrt(4.0 * area / (kRoot3 * static_cast<double>(triangles)));
}

/// Area of a triangle by the square of its edge: equilateral, or half a square.
double areaPerSquaredEdge(bool squares)
{
    return squares ? 0.5 : kRoot3 / 4.0;
}

/// Whether the inside is an even lattice.
bool isLattice(const Pattern& pattern)
{
    return pattern.longest == 1 && !pattern.squares;
}

double areaOf(const Domain& domain)
{
    double total = 0.0;
    for (const Footprint& footprint : domain.droplets) {
        total += area(footprint);
    }
    return total;
}

double rimLengthOf(const Domain& domain)
{
    double total = 0.0;
    for (const Footprint& footprint : domain.droplets) {
        total += rimLength(footprint);
    }
    return total;
}

std::vector<Vec2> innerPoints(const std::vector<RimPolygon>& polygons, double edge, Pattern pattern)
{
    return pattern.squares       ? alignedPoints(polygons, edge)
           : pattern.layer > 0.0 ? layeredPoints(polygons, edge, pattern.longest, pattern.layer)
                                 : gradedPoints(polygons, edge, pattern.longest);
}

PlanarMesh meshFootprint(const RimSampler& sampler, double edge, Pattern pattern)
{
    const std::vector<RimPolygon> polygons = sampler.sample(edge);
    const double finest = kFinest * sampler.finest();
    if (isLattice(pattern)) {
        return triangulateBand(polygons, LatticeCore(polygons, edge), finest);
    }
    PlanarMesh mesh = triangulatePoints(polygons, innerPoints(polygons, edge, pattern), finest);
    if (!pattern.squares) {  // smoothed, their halves would become equilateral
        smooth(mesh, {mesh.rimVertexCount(), mesh.vertices.size(), mesh.triangles.size()});
    }
    return mesh;
}

std::vector<PlanarMesh> meshAll(const std::vector<RimSampler>& samplers, double edge, Pattern pattern)
{
    std::vector<PlanarMesh> meshes(samplers.size());
    tbb::parallel_for(std::size_t{0}, samplers.size(),
                      [&](std::size_t k) { meshes[k] = meshFootprint(samplers[k], edge, pattern); });
    return meshes;
}

std::size_t countTriangles(const std::vector<PlanarMesh>& meshes)
{
    std::size_t count = 0;
    for (const PlanarMesh& mesh : meshes) {
        count += mesh.triangles.size();
    }
    return count;
}

/// Number of triangles for an edge length, predicted from the vertices of rim and lattice alone: 2·inner + rim − 2 per
/// droplet, plus 2 per hole (Euler), without refinement.
double predictTriangles(const std::vector<RimSampler>& samplers, double edge, Pattern pattern)
{
    std::vector<double> counts(samplers.size());
    tbb::parallel_for(std::size_t{0}, samplers.size(), [&](std::size_t k) {
        const std::vector<RimPolygon> polygons = samplers[k].sample(edge);
        std::size_t rim = 0;
        for (const RimPolygon& polygon : polygons) {
            rim += polygon.size();
        }
        const std::size_t inner =
            !isLattice(pattern) ? innerPoints(polygons, edge, pattern).size() : countClearPoints(polygons, edge);
        counts[k] = 2.0 * static_cast<double>(inner) + static_cast<double>(rim) +
                    2.0 * static_cast<double>(polygons.size()) - 4.0;
    });
    double sum = 0.0;
    for (const double count : counts) {
        sum += std::max(count, 1.0);
    }
    return sum;
}

/// Rejects outlines whose detail needs far more triangles than requested.
/// @param wanted  triangles that the footprint's area needs at this edge length
void checkDetail(double predicted, double wanted)
{
    const double max = std::max(kMaxDetailTriangles, wanted);
    if (predicted > max) {
        throw Error(ErrorCode::InvalidInput,
                    "the footprint's detail takes " + numberText(std::round(predicted), 9) +
                        " triangles or more, over the limit of " + numberText(std::floor(max), 9) +
                        "; make the picture smaller, smooth it, or raise the number of triangles to that");
    }
}

/// Rejects rims on which the longest edges that are allowed take far more triangles than requested.
void checkLongest(double count, const TriangulateOptions& options)
{
    const double max = std::max(kMaxDetailTriangles, static_cast<double>(options.triangles));
    if (count > max) {
        throw Error(ErrorCode::InvalidInput, "edges of " + numberText(*options.max_edge) +
                                                 " m along the rim, over which the surface bends, take " +
                                                 numberText(std::round(count), 9) + " triangles, over the limit of " +
                                                 numberText(std::floor(max), 9) + "; check the footprint's width");
    }
}

/// Meshes with these edges, if they have more triangles than requested.
std::optional<std::vector<PlanarMesh>> meshWithLongest(const std::vector<RimSampler>& samplers,
                                                       const TriangulateOptions& options, Pattern pattern)
{
    const double count = predictTriangles(samplers, *options.max_edge, pattern);
    if (count <= kSlack * static_cast<double>(options.triangles)) {
        return std::nullopt;
    }
    checkLongest(count, options);
    return meshAll(samplers, *options.max_edge, pattern);
}

/// Next edge length to try, from two that were tried: the count is assumed to go like edge^(−p), with p from both.
double nextEdge(double edge, double count, double other_edge, double other_count, double wanted)
{
    double power = 2.0;
    if (edge != other_edge && count != other_count) {
        power = std::clamp(-std::log(count / other_count) / std::log(edge / other_edge), 0.25, 3.0);
    }
    return edge * std::clamp(std::pow(count / wanted, 1.0 / power), 0.25, 4.0);
}

std::vector<PlanarMesh> meshToCount(const std::vector<RimSampler>& samplers, double area, std::size_t triangles,
                                    Pattern pattern)
{
    const auto target = static_cast<double>(triangles);
    double edge = pattern.squares ? std::sqrt(2.0 * area / target) : evenEdge(area, triangles);
    double last_edge = edge;
    double last_count = 0.0;
    // If narrow parts alone need more triangles, longer edges change nothing.
    const auto is_stuck = [](double count, double before) { return std::abs(count / before - 1.0) < 0.005; };
    // Cheap predictions come first; they do most of the search without triangulation.
    for (int k = 0; k < 4 || last_count > 1.1 * std::max(kMaxDetailTriangles, target); ++k) {
        const double count = predictTriangles(samplers, edge, pattern);
        if (k > 0 && count > 1.1 * target && is_stuck(count, last_count)) {
            checkDetail(count, target);
            return meshAll(samplers, edge, pattern);
        }
        const double next = nextEdge(edge, count, k == 0 ? edge : last_edge, k == 0 ? count : last_count, target);
        const bool near = std::abs(count / target - 1.0) < 0.02;
        last_edge = edge;
        last_count = count;
        if (near) {
            break;
        }
        edge = next;
    }
    constexpr double kMaxError = 0.08;  // the guarantee is 10 %
    std::vector<PlanarMesh> best;
    double best_error = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 5 && best_error > kMaxError; ++k) {
        std::vector<PlanarMesh> meshes = meshAll(samplers, edge, pattern);
        const auto count = static_cast<double>(countTriangles(meshes));
        const double error = std::abs(std::log(count / target));
        const double next = nextEdge(edge, count, k == 0 ? edge : last_edge, k == 0 ? count : last_count, target);
        const bool stuck = k > 0 && is_stuck(count, last_count);
        if (error < best_error) {
            best_error = error;
            best = std::move(meshes);
        }
        if (stuck) {
            break;
        }
        last_edge = edge;
        last_count = count;
        edge = next;
    }
    return best;
}

/// Vertices around each inner vertex that has many triangles, counter-clockwise, with the vertex itself in front.
std::vector<std::vector<std::uint32_t>> fansOf(const PlanarMesh& mesh)
{
    std::vector<std::size_t> counts(mesh.vertices.size());
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : t) {
            ++counts[v];
        }
    }
    // Edges opposite of a fan's vertex, by the vertex and their first end.
    std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> opposite;
    for (const auto& [a, b, c] : mesh.triangles) {
        for (const auto& [v, from, to] : {Triangle{a, b, c}, Triangle{b, c, a}, Triangle{c, a, b}}) {
            if (counts[v] > kManyTriangles && !mesh.onRim(v)) {
                opposite[v].emplace(from, to);
            }
        }
    }
    std::vector<std::vector<std::uint32_t>> fans;
    for (const auto& [v, next] : opposite) {
        fans.push_back({v});
        std::uint32_t at = next.begin()->first;
        for (std::size_t k = 0; k < next.size(); ++k) {
            fans.back().push_back(at);
            at = next.at(at);
        }
    }
    return fans;
}

/// Points that divide fans of many triangles: halfway from a fan's vertex to every sixth vertex around it, or fewer, so
/// that the vertex has not many triangles then. A fan has nothing inside, so the rim is no nearer than what is around.
/// @param clear  distance of points from the rim, at least [m]
std::vector<Vec2> pointsInFans(const PlanarMesh& mesh, double clear)
{
    constexpr std::size_t kStep = 6;
    std::vector<Vec2> points;
    std::set<std::pair<std::uint32_t, std::uint32_t>> halved;  // an edge may be part of two fans
    for (const std::vector<std::uint32_t>& fan : fansOf(mesh)) {
        const auto at = [&](std::size_t k) { return mesh.vertices[fan[1 + k % (fan.size() - 1)]]; };
        const Vec2 centre = mesh.vertices[fan.front()];
        const std::size_t around = fan.size() - 1;
        const std::size_t count = std::min(kManyTriangles, (around + kStep - 1) / kStep);
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t i = k * around / count;
            const Vec2 point = 0.5 * (centre + at(i));
            bool is_clear = true;
            for (std::size_t j = 0; j < around && is_clear; ++j) {
                const Vec2 along = at(j + 1) - at(j);
                const double part = std::clamp(dot(point - at(j), along) / dot(along, along), 0.0, 1.0);
                is_clear = length(point - at(j) - part * along) > clear;
            }
            if (is_clear && halved.insert(std::minmax(fan.front(), fan[1 + i])).second) {
                points.push_back(point);
            }
        }
    }
    return points;
}

}  // namespace

void TriangulateOptions::validate() const
{
    if (triangles < 1) {
        throw Error(ErrorCode::InvalidArgument, "triangles 0 must be at least 1");
    }
    if (edge && !(*edge > 0.0 && std::isfinite(*edge))) {
        throw Error(ErrorCode::InvalidArgument, "the edge length " + numberText(*edge) + " m must be positive");
    }
    if (grading && (*grading < 1 || *grading > kMaxGrading || !std::has_single_bit(static_cast<unsigned>(*grading)))) {
        throw Error(ErrorCode::InvalidArgument,
                    "grading " + std::to_string(*grading) + " must be a power of two from 1 to 64");
    }
    if (quads && grading.value_or(1) != 1) {
        throw Error(ErrorCode::InvalidArgument,
                    "grading " + std::to_string(*grading) + " must be 1 for quads, which have even edges");
    }
    if (layer && !(*layer > 0.0 && std::isfinite(*layer))) {
        throw Error(ErrorCode::InvalidArgument, "layer " + numberText(*layer) + " m must be positive");
    }
    if (max_edge && !(*max_edge > 0.0 && std::isfinite(*max_edge))) {
        throw Error(ErrorCode::InvalidArgument, "max_edge " + numberText(*max_edge) + " m must be positive");
    }
    if (edge && max_edge && *edge > *max_edge) {
        throw Error(ErrorCode::InvalidArgument, "the edge length " + numberText(*edge) + " m must be at most " +
                                                    numberText(*max_edge) +
                                                    " m, over which the liquid's surface bends");
    }
}

int gradingOf(const Domain& domain, const TriangulateOptions& options)
{
    options.validate();
    if (options.grading || options.edge || !options.layer || options.quads) {
        return options.grading.value_or(1);
    }
    const double total_area = areaOf(domain);
    const bool is_wide = total_area > kWide * *options.layer * rimLengthOf(domain);
    return is_wide && kEdgesPerLayer * evenEdge(total_area, options.triangles) > *options.layer ? kMaxGrading : 1;
}

std::vector<PlanarMesh> triangulate(const Domain& domain, const TriangulateOptions& options)
{
    options.validate();
    const double total_area = areaOf(domain);
    const Pattern pattern{gradingOf(domain, options), options.grading ? 0.0 : options.layer.value_or(0.0),
                          options.quads};
    const double per_square = areaPerSquaredEdge(options.quads);
    if (options.edge && total_area / (per_square * *options.edge * *options.edge) > kMaxTriangles) {
        throw Error(ErrorCode::InvalidArgument, "the edge length " + numberText(*options.edge) +
                                                    " m must be longer: it would take more than 4e9 triangles");
    }
    // 1.5 times the edge of equilateral triangles, because the band along the rim has more triangles than its share of
    // the area.
    const double even = evenEdge(total_area, options.triangles);
    const double widest =
        std::min(1.5 * options.edge.value_or(even), options.max_edge.value_or(std::numeric_limits<double>::infinity()));
    if (options.max_edge) {
        // Every edge along the rim has a triangle, and sampling takes time.
        checkLongest(rimLengthOf(domain) / *options.max_edge, options);
    }
    std::vector<std::optional<RimSampler>> made(domain.droplets.size());
    tbb::parallel_for(std::size_t{0}, made.size(), [&](std::size_t k) { made[k].emplace(domain.droplets[k], widest); });
    std::vector<RimSampler> samplers;
    samplers.reserve(made.size());
    for (std::optional<RimSampler>& sampler : made) {
        samplers.push_back(std::move(*sampler));
    }
    // Even triangles that are short enough need no prediction.
    if (!options.edge && options.max_edge && kEdgesPerLayer * even > *options.max_edge) {
        if (auto meshes = meshWithLongest(samplers, options, pattern)) {
            return *std::move(meshes);
        }
    }
    if (!options.edge) {
        return meshToCount(samplers, total_area, options.triangles, pattern);
    }
    std::size_t points = 0;
    for (const Footprint& footprint : domain.droplets) {
        points += footprint.rim.points.size();
        for (const Loop& hole : footprint.holes) {
            points += hole.points.size();
        }
    }
    if (4.0 * static_cast<double>(points) > kMaxDetailTriangles) {
        // Triangles at a rim may be half as high as others.
        checkDetail(predictTriangles(samplers, *options.edge, pattern),
                    2.0 * total_area / (per_square * *options.edge * *options.edge));
    }
    return meshAll(samplers, *options.edge, pattern);
}

PlanarMesh cover(const PlanarMesh& mesh, std::optional<double> edge)
{
    std::vector<std::vector<Vec2>> polygons;
    for (std::size_t k = 0; k < mesh.loopCount(); ++k) {
        polygons.emplace_back(mesh.vertices.begin() + mesh.loop_starts[k],
                              mesh.vertices.begin() + mesh.loop_starts[k + 1]);
    }
    // Start at four times the length of rim edges, because nobody looks at the ground from below.
    const double rim_edge = rimLength(mesh) / static_cast<double>(mesh.rimVertexCount());
    std::vector<Vec2> points =
        edge ? gradedPoints(polygons, *edge, 1) : gradedPoints(polygons, 4.0 * rim_edge, kMaxGrading);
    PlanarMesh result;
    result.loop_starts = mesh.loop_starts;
    const auto fill = [&] {
        result.triangles = triangulateUnrefined(polygons, points);
        result.vertices.assign(mesh.vertices.begin(), mesh.vertices.begin() + mesh.rimVertexCount());
        result.vertices.insert(result.vertices.end(), points.begin(), points.end());
    };
    fill();
    for (int round = 0; round < kRounds && !edge; ++round) {
        const std::vector<Vec2> more = pointsInFans(result, rim_edge);
        if (more.empty()) {
            break;
        }
        points.insert(points.end(), more.begin(), more.end());
        fill();
    }
    return result;
}

}  // namespace droplet

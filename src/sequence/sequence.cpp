// SPDX-License-Identifier: GPL-3.0-or-later
//
// After the thesis, section 4.2.4: every frame is solved by itself, the total volume is fixed. Added here: volumes of
// single droplets, and vertices that keep their identity.
#include "droplet/sequence/sequence.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "droplet/domain/overlap.h"
#include "droplet/error.h"
#include "droplet/mesh/follow.h"
#include "droplet/mesh/patch.h"
#include "droplet/units.h"
#include "mesh/mean_edge.h"
#include "pipeline.h"
#include "sequence/frame_lineage.h"

namespace droplet {

namespace {

/// Share of the smaller footprint from which an overlap links two droplets. A droplet that moves by half its width into
/// the place of the one before overlaps that by less.
constexpr double kMinJoinedShare = 0.25;

double volumeOf(const std::vector<Ancestry>& droplets)
{
    return std::accumulate(droplets.begin(), droplets.end(), 0.0,
                           [](double sum, const Ancestry& droplet) { return sum + droplet.volume; });
}

/// Distance of rows for overlaps(): half a pixel; for outlines without a picture, a fraction of the extent.
double rowDistance(const Outline& outline)
{
    constexpr double kRows = 2048.0;
    return outline.pixel_size > 0.0 ? 0.5 * outline.pixel_size : outline.extent.y / kRows;
}

/// Two droplets of two frames that belong together.
struct Link {
    std::size_t before = 0;
    std::size_t after = 0;
    double area = 0.0;
};

std::vector<Link> linksOf(const Domain& before, const Domain& after, double row)
{
    const std::vector<Overlap> all = overlaps(before, after, row);
    std::vector<double> max_before(before.droplets.size(), 0.0);
    std::vector<double> max_after(after.droplets.size(), 0.0);
    for (const Overlap& overlap : all) {
        max_before[overlap.first] = std::max(max_before[overlap.first], overlap.area);
        max_after[overlap.second] = std::max(max_after[overlap.second], overlap.area);
    }
    std::vector<Link> links;
    for (const Overlap& overlap : all) {
        const double smaller = std::min(area(before.droplets[overlap.first]), area(after.droplets[overlap.second]));
        const bool nearest = overlap.area == max_before[overlap.first] && overlap.area == max_after[overlap.second];
        if (overlap.area >= kMinJoinedShare * smaller || nearest) {
            links.push_back({overlap.first, overlap.second, overlap.area});
        }
    }
    return links;
}

/// Droplets that are connected by links.
struct Group {
    std::vector<std::size_t> before;
    std::vector<std::size_t> after;
};

/// Groups in the order of their first droplets before; groups of new droplets come last.
std::vector<Group> groupsOf(std::size_t before, std::size_t after, const std::vector<Link>& links)
{
    // Droplets after are numbered on from those before. The name of a droplet is the smallest number among the droplets
    // connected with it.
    std::vector<std::size_t> name(before + after);
    std::iota(name.begin(), name.end(), std::size_t{0});
    for (bool changed = true; changed;) {
        changed = false;
        for (const Link& link : links) {
            std::size_t& a = name[link.before];
            std::size_t& b = name[before + link.after];
            changed = changed || a != b;
            a = b = std::min(a, b);
        }
    }
    std::vector<Group> groups(before + after);
    for (std::size_t i = 0; i < name.size(); ++i) {
        Group& group = groups[name[i]];
        (i < before ? group.before : group.after).push_back(i < before ? i : i - before);
    }
    groups.erase(std::remove_if(groups.begin(), groups.end(),
                                [](const Group& group) { return group.before.empty() && group.after.empty(); }),
                 groups.end());
    return groups;
}

/// Volumes of droplets on meshes at one pressure, as shares of the total.
std::vector<double> sharesOf(const std::vector<PlanarMesh>& meshes, const SolveOptions& options)
{
    SolveOptions level = options;
    level.model = Model::Linear;
    level.gravity = std::max(planeGravity(options).normal, 0.0);
    level.tilt = 0.0;
    level.ground = {};
    level.no_penetration = false;
    level.volumes.clear();
    double whole = 0.0;
    for (const PlanarMesh& mesh : meshes) {
        whole += std::pow(area(mesh), 1.5);  // about the volume of the droplets, so that nothing overflows
    }
    level.fill = {FillBy::Volume, whole, FillSharing::Total};
    const Solution solution = solve(meshes, level);
    std::vector<double> shares;
    double sum = 0.0;
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        shares.push_back(solution.report.usable() ? measure(solution.droplets[k], level).volume : area(meshes[k]));
        sum += shares.back();
    }
    for (double& share : shares) {
        share /= sum;
    }
    return shares;
}

template <typename Value>
std::vector<Value> selected(const std::vector<Value>& all, const std::vector<std::size_t>& which)
{
    std::vector<Value> some;
    some.reserve(which.size());
    for (const std::size_t k : which) {
        some.push_back(all[k]);
    }
    return some;
}

/// Gives every droplet its id and its origin.
/// @return the next unused id
std::size_t assignIds(const Frame& before, const std::vector<Group>& groups, const std::vector<Link>& links,
                      Frame& frame)
{
    std::size_t next_id = before.lineage->next_id;
    for (const Group& group : groups) {
        std::vector<std::size_t> ids;
        std::size_t main_parent = 0;
        for (const std::size_t i : group.before) {
            ids.push_back(before.droplets[i].id);
            main_parent = before.droplets[i].volume > before.droplets[main_parent].volume || i == group.before.front()
                              ? i
                              : main_parent;
        }
        // The droplet that covers most of the largest parent's ground gets its id.
        std::size_t keeper = frame.droplets.size();
        double max = -1.0;
        for (const std::size_t k : group.after) {
            double common = 0.0;
            for (const Link& link : links) {
                common += link.before == main_parent && link.after == k && !group.before.empty() ? link.area : 0.0;
            }
            if (common > max) {
                max = common;
                keeper = k;
            }
        }
        for (const std::size_t k : group.after) {
            frame.droplets[k].from = ids;
            frame.droplets[k].id = !group.before.empty() && k == keeper ? before.droplets[main_parent].id : next_id++;
        }
    }
    return next_id;
}

/// Distributes the volumes of the frame before to the droplets of the frame.
void distributeVolumes(const Frame& before, const std::vector<Group>& groups, const DropletOptions& options,
                       Frame& frame)
{
    std::vector<std::size_t> appeared;
    for (const Group& group : groups) {
        double volume = 0.0;
        for (const std::size_t i : group.before) {
            volume += before.droplets[i].volume;
        }
        if (group.after.empty()) {
            frame.volume_lost += volume;
        } else if (group.before.empty()) {
            appeared.insert(appeared.end(), group.after.begin(), group.after.end());
        } else if (group.after.size() == 1) {
            frame.droplets[group.after.front()].volume = volume;
        } else {
            const std::vector<double> shares = sharesOf(selected(frame.droplet.meshes, group.after), options.solve);
            for (std::size_t k = 0; k < shares.size(); ++k) {
                frame.droplets[group.after[k]].volume = shares[k] * volume;
            }
        }
    }
    if (!appeared.empty()) {
        const std::vector<double> volumes = volumesOf(selected(frame.droplet.meshes, appeared), options);
        for (std::size_t k = 0; k < appeared.size(); ++k) {
            frame.droplets[appeared[k]].volume = volumes[k];
            frame.volume_gained += volumes[k];
        }
    }
}

/// Puts the footprints into their old order if every droplet continues as one droplet; else returns false.
bool restoreOrder(std::size_t count, const std::vector<Group>& groups, Domain& domain)
{
    const bool one_to_one =
        domain.droplets.size() == count && std::all_of(groups.begin(), groups.end(), [](const Group& group) {
            return group.before.size() == 1 && group.after.size() == 1;
        });
    if (!one_to_one) {
        return false;
    }
    std::vector<Footprint> ordered(count);
    for (const Group& group : groups) {
        ordered[group.before.front()] = std::move(domain.droplets[group.after.front()]);
    }
    domain.droplets = std::move(ordered);
    return true;
}

bool anyDry(const Droplet& droplet)
{
    return std::any_of(droplet.solution.droplets.begin(), droplet.solution.droplets.end(),
                       [](const CapillarySurface& surface) { return surface.isHeightField() && !surface.dry.empty(); });
}

/// Mesh of a droplet in a frame, and its base if that is kept.
struct Meshed {
    PlanarMesh mesh;
    std::optional<PlanarMesh> base;
};

/// Moves a droplet's mesh and base with its footprint, if possible.
/// @param as_sheet  the mesh serves a sheet that follows: its rim alone counts
std::optional<Meshed> followOne(const Frame& before, std::size_t k, const Footprint& footprint, bool as_sheet = false)
{
    const TriangulatedMeshes& first = *before.lineage->first;
    std::optional<PlanarMesh> mesh = as_sheet ? follow(first.meshes[k], before.droplet.meshes[k], footprint, 0.0)
                                              : follow(first.meshes[k], before.droplet.meshes[k], footprint);
    if (!mesh) {
        return std::nullopt;
    }
    Meshed moved{std::move(*mesh), {}};
    if (!first.bases.empty()) {
        const auto rim = moved.mesh.vertices.begin();
        moved.base = moveRim(first.bases[k], {rim, rim + moved.mesh.rimVertexCount()});
        if (!moved.base) {
            return std::nullopt;
        }
    }
    return moved;
}

/// Moves all meshes and bases with their footprints.
/// @param domain       new footprints
/// @param with_sheets  sheets follow, too
/// @param meshes       receives the moved meshes
/// @return             none unless all of them can be moved
std::optional<FrameLineage> followAll(const Frame& before, const Domain& domain, bool with_sheets,
                                      std::vector<PlanarMesh>& meshes)
{
    const std::size_t count = before.lineage->first->meshes.size();
    std::vector<std::optional<Meshed>> moved(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
        const bool as_sheet = with_sheets && sheetOf(before.droplet, k) != nullptr;
        moved[k] = followOne(before, k, domain.droplets[k], as_sheet);
    });
    if (!std::all_of(moved.begin(), moved.end(), [](const auto& one) { return one.has_value(); })) {
        return std::nullopt;
    }
    FrameLineage lineage = *before.lineage;
    lineage.bases.clear();
    for (std::optional<Meshed>& one : moved) {
        meshes.push_back(std::move(one->mesh));
        if (one->base) {
            lineage.bases.push_back(std::move(*one->base));
        }
    }
    return lineage;
}

bool needBases(const DropletOptions& options)
{
    return !options.open && options.solve.ground.flat();
}

/// Triangulates footprints and, if needed, their bases.
/// @param meshes  receives the meshes
FrameLineage triangulateAnew(const Domain& domain, const DropletOptions& options, std::vector<PlanarMesh>& meshes)
{
    DomainMeshes made = meshesOf(domain, options);
    meshes = std::move(made.meshes);
    FrameLineage lineage;
    lineage.are_even = made.are_even;
    if (options.mesh.edge) {
        lineage.edge = *options.mesh.edge;
    } else {
        double covered = 0.0;
        std::size_t triangles = 0;
        for (const PlanarMesh& mesh : meshes) {
            covered += area(mesh);
            triangles += mesh.triangles.size();
        }
        lineage.edge = meanEdge(covered, triangles);
    }
    if (needBases(options)) {
        lineage.bases.resize(meshes.size());
        tbb::parallel_for(std::size_t{0}, meshes.size(),
                          [&](std::size_t k) { lineage.bases[k] = movableCover(meshes[k]); });
    }
    lineage.first = std::make_shared<const TriangulatedMeshes>(TriangulatedMeshes{meshes, lineage.bases});
    return lineage;
}

/// Whether the angles of a mesh are good enough for moved meshes, or as good as those of a new mesh.
bool anglesAreGood(const PlanarMesh& mesh, const Footprint& footprint, double edge)
{
    constexpr double kMinAngle = 15.0 * kDegree;
    constexpr double kMinAngleShare = 0.75;
    const double min = minAngle(mesh);
    return min >= kMinAngle || min >= kMinAngleShare * minAngle(triangulate({{footprint}, {}}, {.edge = edge}).front());
}

/// Meshes a frame and keeps as many vertices as possible. Droplets that only move are moved. Others keep triangles far
/// from changes of their rims. New ones are triangulated with edges of the same length.
/// @param kept  receives the number of vertices that the frame before had, of every mesh
/// @return      none if it is better to triangulate the whole frame
std::optional<FrameLineage> keepVertices(const Frame& before, const std::vector<Group>& groups, const Domain& domain,
                                         const DropletOptions& options, std::vector<PlanarMesh>& meshes,
                                         std::vector<std::size_t>& kept)
{
    if (!before.lineage->are_even) {
        return std::nullopt;
    }
    const std::size_t count = domain.droplets.size();
    const double edge = before.lineage->edge;
    std::vector<const Group*> group_of(count);
    for (const Group& group : groups) {
        for (const std::size_t k : group.after) {
            group_of[k] = &group;
        }
    }
    std::vector<Meshed> made(count);
    std::vector<std::optional<std::size_t>> followed(count);  // the droplet before that was moved
    kept.assign(count, 0);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
        const Footprint& footprint = domain.droplets[k];
        const Group& group = *group_of[k];
        if (group.before.size() == 1 && group.after.size() == 1) {
            if (auto moved = followOne(before, group.before.front(), footprint)) {
                made[k] = std::move(*moved);
                followed[k] = group.before.front();
                kept[k] = made[k].mesh.vertices.size();
                return;
            }
        }
        std::vector<const PlanarMesh*> parents;
        for (const std::size_t i : group.before) {
            parents.push_back(&before.droplet.meshes[i]);
        }
        std::optional<PatchedMesh> patched;
        if (!parents.empty()) {
            patched = patch(parents, footprint, edge);
        }
        if (patched && anglesAreGood(patched->mesh, footprint, edge)) {
            kept[k] = patched->kept;
            made[k].mesh = std::move(patched->mesh);
        } else {
            made[k].mesh = triangulate({{footprint}, {}}, {.edge = edge}).front();
        }
        if (needBases(options)) {
            made[k].base = movableCover(made[k].mesh);
        }
    });
    std::size_t triangles = 0;
    for (const Meshed& one : made) {
        triangles += one.mesh.triangles.size();
    }
    if (std::all_of(kept.begin(), kept.end(), [](std::size_t vertices) { return vertices == 0; }) ||
        (!options.mesh.edge && (triangles > 2 * options.mesh.triangles || 2 * triangles < options.mesh.triangles))) {
        kept.clear();
        return std::nullopt;
    }
    FrameLineage lineage;
    lineage.edge = edge;
    TriangulatedMeshes first;
    for (std::size_t k = 0; k < count; ++k) {
        first.meshes.push_back(followed[k] ? before.lineage->first->meshes[*followed[k]] : made[k].mesh);
        if (made[k].base) {
            first.bases.push_back(followed[k] ? before.lineage->first->bases[*followed[k]] : *made[k].base);
            lineage.bases.push_back(std::move(*made[k].base));
        }
        meshes.push_back(std::move(made[k].mesh));
    }
    lineage.first = std::make_shared<const TriangulatedMeshes>(std::move(first));
    return lineage;
}

Frame dryFrame(Outline outline, FrameLineage lineage)
{
    Frame frame;
    frame.droplet.domain.extent = outline.extent;
    frame.droplet.outline = std::move(outline);
    lineage.first.reset();
    lineage.bases.clear();
    lineage.sheets.clear();
    frame.lineage = std::make_shared<const FrameLineage>(std::move(lineage));
    return frame;
}

/// Options of a frame whose droplets are those of the frame before.
SolveOptions followedOptions(const Frame& before, const SequenceOptions& options, SolveOptions solve)
{
    if (options.volume_mode == VolumeMode::Track) {
        solve.fill = {FillBy::Volume, solve.fill.amount, FillSharing::Each};
        for (const Ancestry& droplet : before.droplets) {
            solve.volumes.push_back(droplet.volume);
        }
    }
    return solve;
}

/// Number of vertices of a droplet's surface.
std::size_t vertexCount(const Droplet& droplet, std::size_t k)
{
    return droplet.solution.droplets[k].vertices.size();
}

/// Share of the vertices of a frame that the frame before had; new sheets have none.
/// @param followed  whether the meshes are those of the frame before, moved
/// @param kept      otherwise: vertices that they kept; or empty
double keptShare(const Droplet& before, const Droplet& after, bool followed, const std::vector<std::size_t>& kept)
{
    std::size_t all = 0;
    std::size_t known = 0;
    for (std::size_t k = 0; k < after.meshes.size(); ++k) {
        const std::size_t count = vertexCount(after, k);
        all += count;
        if (followed) {
            known += isSameSheet(before, after, k) ? count : 0;
        } else if (!kept.empty() && sheetOf(after, k) == nullptr) {
            known += kept[k];
        }
    }
    return static_cast<double>(known) / static_cast<double>(all);
}

/// Frame that shows the droplets of the frame before.
Frame heldFrame(const Frame& before, const std::string& why)
{
    Frame frame = before;
    for (Ancestry& droplet : frame.droplets) {
        droplet.from = {droplet.id};
    }
    frame.continues = true;
    frame.vertices_kept = 1.0;
    frame.volume_gained = 0.0;
    frame.volume_lost = 0.0;
    frame.held = why;
    return frame;
}

/// Makes a frame with liquid after another frame.
Frame wetFrame(const Frame& before, Outline outline, const SequenceOptions& options, const Progress& progress)
{
    Frame frame;
    frame.droplet.outline = std::move(outline);
    Domain& domain = frame.droplet.domain;
    domain = split(frame.droplet.outline);
    const double row = rowDistance(frame.droplet.outline);
    const std::size_t count = before.droplets.size();
    std::vector<Link> links;
    if (count > 0) {
        links = linksOf(before.droplet.domain, domain, row);
    }
    std::vector<Group> groups = groupsOf(count, domain.droplets.size(), links);
    if (progress) {
        progress(Stage::Triangulate, 0.0);
    }
    const bool one_to_one = restoreOrder(count, groups, domain);
    if (one_to_one) {
        links.clear();
        for (Group& group : groups) {
            group.after = group.before;
            links.push_back({group.before.front(), group.after.front(), 1.0});
        }
    }
    DropletOptions frame_options = options.droplet;
    const std::optional<double> reservoir = before.lineage->reservoir;
    if (options.volume_mode == VolumeMode::Total && reservoir) {
        frame_options.solve.fill = {FillBy::Volume, *reservoir, FillSharing::Total};
    }
    std::optional<FrameLineage> lineage;
    std::optional<FollowedSheets> sheets;
    if (options.keep_vertices && one_to_one && !anyDry(before.droplet)) {
        if (haveSheets(before.droplet.solution.droplets)) {
            lineage = followAll(before, domain, true, frame.droplet.meshes);
            if (lineage) {
                sheets = followSheets(before.lineage->sheets, before.droplet, frame.droplet.meshes, lineage->bases,
                                      followedOptions(before, options, frame_options.solve));
            }
        }
        if (!sheets) {
            frame.droplet.meshes.clear();
            lineage = followAll(before, domain, false, frame.droplet.meshes);
        }
    }
    const bool followed = lineage.has_value();
    std::vector<std::size_t> kept;
    if (!followed && options.keep_vertices && count > 0) {
        lineage = keepVertices(before, groups, domain, frame_options, frame.droplet.meshes, kept);
    }
    if (lineage) {
        frame_options.mesh.edge = lineage->edge;  // the edge length stays the same, not the number of triangles
    } else {
        lineage = triangulateAnew(domain, frame_options, frame.droplet.meshes);
    }
    frame.droplets.resize(domain.droplets.size());
    lineage->next_id = assignIds(before, groups, links, frame);
    if (options.volume_mode == VolumeMode::Track) {
        distributeVolumes(before, groups, options.droplet, frame);
        frame_options.solve.fill.by = FillBy::Volume;
        frame_options.solve.fill.sharing = FillSharing::Each;
        for (const Ancestry& droplet : frame.droplets) {
            frame_options.solve.volumes.push_back(droplet.volume);
        }
    }
    const SheetOrigins origins = sheets ? before.lineage->sheets : SheetOrigins{};
    if (!sheets) {
        sheets = FollowedSheets{{}, lineage->bases};
    }
    finish(frame.droplet, frame_options, progress, {sheets->bases, std::move(sheets->sheets), options.keep_vertices});
    if (count > 0) {
        frame.vertices_kept = keptShare(before.droplet, frame.droplet, followed, kept);
    }
    if (options.volume_mode == VolumeMode::Fill) {
        for (std::size_t k = 0; k < frame.droplets.size(); ++k) {
            frame.droplets[k].volume = frame.droplet.figures[k].volume;
        }
        const double growth = volumeOf(frame.droplets) - volumeOf(before.droplets);
        frame.volume_gained = std::max(growth, 0.0);
        frame.volume_lost = std::max(-growth, 0.0);
    }
    if (options.volume_mode == VolumeMode::Total) {
        const double scale = reservoir.value_or(frame.droplet.total.volume) / frame.droplet.total.volume;  // no drift
        for (std::size_t k = 0; k < frame.droplets.size(); ++k) {
            frame.droplets[k].volume = scale * frame.droplet.figures[k].volume;
        }
        if (count == 0) {
            frame.volume_gained = volumeOf(frame.droplets);
        }
    }
    lineage->reservoir = reservoir.value_or(volumeOf(frame.droplets));
    frame.continues = followed && !anyDry(frame.droplet) && frame.vertices_kept == 1.0;
    lineage->sheets = originsOf(frame.droplet, origins, sheets->bases);
    frame.lineage = std::make_shared<const FrameLineage>(*std::move(lineage));
    return frame;
}

}  // namespace

void SequenceOptions::validate() const
{
    validateStages(droplet);
    if (droplet.fill_range) {
        throw Error(ErrorCode::InvalidArgument, "fill_range is not allowed in a sequence");
    }
    if (droplet.mesh.quads) {
        // Others would be joined in every frame, though triangles stay.
        throw Error(ErrorCode::InvalidArgument, "mesh.quads are not allowed in a sequence");
    }
    if (!droplet.solve.volumes.empty()) {
        throw Error(ErrorCode::InvalidArgument,
                    "volumes are not allowed in a sequence: fill sets the amount of the first frame");
    }
    if (volume_mode == VolumeMode::Total && droplet.solve.fill.sharing != FillSharing::Total) {
        throw Error(ErrorCode::InvalidArgument, "volume_mode total requires fill.sharing total: one reservoir");
    }
}

Frame firstFrame(Outline outline, const SequenceOptions& options, const Progress& progress)
{
    options.validate();
    if (outline.loops.empty()) {
        return dryFrame(std::move(outline), {});
    }
    Frame frame;
    frame.droplet.outline = std::move(outline);
    frame.droplet.domain = split(frame.droplet.outline);
    if (progress) {
        progress(Stage::Triangulate, 0.0);
    }
    FrameLineage lineage = triangulateAnew(frame.droplet.domain, options.droplet, frame.droplet.meshes);
    finish(frame.droplet, options.droplet, progress,
           {.bases = lineage.bases, .keeps_triangles = options.keep_vertices});
    for (const ShapeFigures& figures : frame.droplet.figures) {
        frame.droplets.push_back({lineage.next_id++, {}, figures.volume});
    }
    lineage.reservoir = volumeOf(frame.droplets);
    lineage.sheets = originsOf(frame.droplet, {}, lineage.bases);
    frame.lineage = std::make_shared<const FrameLineage>(std::move(lineage));
    return frame;
}

Frame nextFrame(const Frame& before, Outline outline, const SequenceOptions& options, const Progress& progress)
{
    options.validate();
    if (!before.lineage) {
        throw Error(ErrorCode::InvalidArgument, "before must be a frame made by firstFrame or nextFrame");
    }
    if (outline.extent != before.droplet.outline.extent) {
        throw Error(ErrorCode::InvalidInput, "frames of a sequence must have the same extent");
    }
    if (outline.loops.empty()) {
        Frame dry = dryFrame(std::move(outline), *before.lineage);
        dry.volume_lost = volumeOf(before.droplets);
        return dry;
    }
    try {
        return wetFrame(before, std::move(outline), options, progress);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::NoSuchDroplet || !options.hold || before.droplets.empty()) {
            throw;
        }
        return heldFrame(before, error.what());
    }
}

}  // namespace droplet

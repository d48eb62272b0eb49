// SPDX-License-Identifier: GPL-3.0-or-later
//
// One description of every value serves writing and reading: `fields` lists the members of a struct.
#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/sequence/sequence.h"
#include "droplet/sequence/sequence_report.h"
#include "exact_bytes.h"
#include "mesh/lattice.h"
#include "sequence/frame_lineage.h"

namespace droplet {
namespace {

constexpr std::string_view kFrameHead = "droplet-shape frame 2\n";
constexpr std::string_view kReportsHead = "droplet-shape frame reports 2\n";

/// A struct or a constant one.
template <class Value, class Struct>
concept Like = std::same_as<std::remove_const_t<Value>, Struct>;

template <class Value>
concept Whole = std::integral<Value> || std::is_enum_v<Value>;

void fields(auto& archive, Like<RowInterval> auto& interval)
{
    archive(interval.row, interval.begin, interval.end);
}

void fields(auto& archive, Like<PlanarMesh> auto& mesh)
{
    archive(mesh.vertices, mesh.triangles, mesh.loop_starts, mesh.lattice);
}

void fields(auto& archive, Like<CapillarySurface> auto& surface)
{
    archive(surface.vertices, surface.triangles, surface.loop_starts, surface.dry, surface.contact_angle,
            surface.pressure, surface.lattice, surface.footprint);
}

void fields(auto& archive, Like<Loop> auto& loop)
{
    archive(loop.points, loop.corner);
}

void fields(auto& archive, Like<Footprint> auto& footprint)
{
    archive(footprint.rim, footprint.holes);
}

void fields(auto& archive, Like<Ancestry> auto& droplet)
{
    archive(droplet.id, droplet.from, droplet.volume);
}

void fields(auto& archive, Like<FallingDrop> auto& drop)
{
    archive(drop.droplet, drop.volume, drop.start, drop.since, drop.gravity);
}

void fields(auto& archive, Like<TriangulatedMeshes> auto& meshes)
{
    archive(meshes.meshes, meshes.bases);
}

void fields(auto& archive, Like<SheetOrigin> auto& origin)
{
    archive(origin.sheet, origin.mesh, origin.base);
}

void fields(auto& archive, Like<FrameLineage> auto& lineage)
{
    archive(lineage.first, lineage.bases, lineage.sheets, lineage.edge, lineage.are_even, lineage.next_id,
            lineage.reservoir);
}

void fields(auto& archive, Like<ContactAngle> auto& angle)
{
    archive(angle.min, angle.mean, angle.max, angle.min_at, angle.max_at);
}

void fields(auto& archive, Like<ShapeFigures> auto& f)
{
    archive(f.footprint_area, f.rim_length, f.dry_area, f.volume, f.height_max, f.depth_max, f.overhang, f.liquid_area,
            f.linear_area, f.surface_energy, f.gravity_energy, f.slope_max, f.steep_area, f.bond_number,
            f.projected_width, f.contact_angle, f.height_bound);
}

void fields(auto& archive, Like<SurfacePart> auto& part)
{
    archive(part.droplet, part.first_vertex, part.vertices, part.first_triangle, part.triangles, part.quads,
            part.volume, part.area);
}

/// Surfaces of a sequence have no refill.
void fields(auto& archive, Like<Surface> auto& surface)
{
    archive(surface.vertices, surface.normals, surface.uvs, surface.contact_angle, surface.triangles, surface.weld,
            surface.texture_map, surface.mean_height, surface.parts);
}

/// What nextFrame() needs of the frame before, also to show it once more.
void fields(auto& archive, Like<Frame> auto& frame)
{
    archive(frame.droplet.outline.extent, frame.droplet.domain.droplets, frame.droplet.domain.extent,
            frame.droplet.meshes, frame.droplet.solution.droplets, frame.droplet.figures, frame.droplet.total,
            frame.droplet.surface, frame.droplets, frame.falling, frame.drops_shed, frame.lineage);
}

void fields(auto& archive, Like<Retention> auto& retention)
{
    archive(retention.driving_force, retention.retention_force);
}

void fields(auto& archive, Like<CssColour> auto& colour)
{
    archive(colour.red, colour.green, colour.blue);
}

void fields(auto& archive, Like<DropletReport> auto& droplet)
{
    archive(droplet.figures, droplet.holes, droplet.pressure, droplet.retention, droplet.colour, droplet.limit);
}

void fields(auto& archive, Like<FrameReport> auto& frame)
{
    archive(frame.input, frame.output, frame.continues, frame.held, frame.vertices_kept, frame.volume_gained,
            frame.volume_lost, frame.total, frame.pressure, frame.vertices, frame.triangles, frame.closed,
            frame.ancestry, frame.droplets, frame.falling, frame.drops_shed);
}

class Saver {
public:
    explicit Saver(std::string_view head) : out_(head) {}

    void operator()(const auto&... values) { (put(values), ...); }

    [[nodiscard]] std::string&& release() { return out_.release(); }

private:
    template <Whole Number>
    void put(Number value)
    {
        out_.put(static_cast<std::uint64_t>(value));
    }
    void put(double value) { out_.put(value); }
    void put(float value) { out_.put(double{value}); }
    void put(Vec2 value) { out_.put(value); }
    void put(Vec3 value) { out_.put(value); }
    template <class Value>
    void put(const std::vector<Value>& values)
    {
        put(values.size());
        for (const Value& value : values) {
            put(value);
        }
    }
    void put(const std::string& text)
    {
        put(text.size());
        for (const char c : text) {
            put(static_cast<unsigned char>(c));
        }
    }
    void put(const Triangle& triangle) { (*this)(triangle[0], triangle[1], triangle[2]); }
    template <class Value>
    void put(const std::optional<Value>& value)
    {
        put(value.has_value());
        if (value) {
            put(*value);
        }
    }
    template <class Value>
    void put(const std::shared_ptr<const Value>& value)
    {
        put(value != nullptr);
        if (value) {
            put(*value);
        }
    }
    void put(const Lattice& lattice)
    {
        (*this)(lattice.edge, lattice.first_regular_triangle, lattice.grid.begin(), lattice.grid.region().intervals());
    }
    template <class Struct>
    requires std::is_class_v<Struct>
    void put(const Struct& value) { fields(*this, value); }

    ExactWriter out_;
};

class Loader {
public:
    Loader(std::string_view bytes, std::string_view head, const std::string& name) : in_(bytes, head, name) {}

    void operator()(auto&... values) { (get(values), ...); }

    // Both throw Error InvalidInput.
    void require(bool holds) const { in_.require(holds); }
    void end() const { in_.require(in_.ended()); }

private:
    template <Whole Number>
    void get(Number& value)
    {
        std::uint64_t bits = 0;
        in_.get(bits);
        value = static_cast<Number>(bits);
        in_.require(static_cast<std::uint64_t>(value) == bits);
    }
    void get(double& value) { in_.get(value); }
    void get(float& value)
    {
        double exact = 0.0;
        in_.get(exact);
        value = static_cast<float>(exact);
    }
    void get(Vec2& value) { in_.get(value); }
    void get(Vec3& value) { in_.get(value); }
    template <class Value>
    void get(std::vector<Value>& values)
    {
        values.resize(in_.count(8));
        for (Value& value : values) {
            get(value);
        }
    }
    void get(std::string& text)
    {
        text.resize(in_.count(8));
        for (char& c : text) {
            unsigned char byte = 0;
            get(byte);
            c = static_cast<char>(byte);
        }
    }
    void get(Triangle& triangle) { (*this)(triangle[0], triangle[1], triangle[2]); }
    template <class Value>
    void get(std::optional<Value>& value)
    {
        bool is_there = false;
        get(is_there);
        if (is_there) {
            get(value.emplace());
        }
    }
    template <class Value>
    void get(std::shared_ptr<const Value>& value)
    {
        bool is_there = false;
        get(is_there);
        if (is_there) {
            auto made = std::make_shared<Value>();
            get(*made);
            value = std::move(made);
        }
    }
    void get(Lattice& lattice)
    {
        std::uint32_t begin = 0;
        std::vector<RowInterval> intervals;
        (*this)(lattice.edge, lattice.first_regular_triangle, begin, intervals);
        for (const RowInterval& interval : intervals) {
            const auto is_near = [](std::int32_t place) { return place > -(1 << 24) && place < (1 << 24); };
            in_.require(interval.begin < interval.end && is_near(interval.row) && is_near(interval.begin) &&
                        is_near(interval.end));
        }
        lattice.grid = LatticeGrid(LatticeRegion(std::move(intervals)), begin);
    }
    template <class Struct>
    requires std::is_class_v<Struct>
    void get(Struct& value)
    {
        fields(*this, value);
        if constexpr (std::same_as<Struct, PlanarMesh> || std::same_as<Struct, CapillarySurface>) {
            requireIndices(value);
        }
    }
    /// Requires that indices name vertices.
    void requireIndices(const auto& mesh) const
    {
        const auto is_known = [&](std::uint32_t end) { return end <= mesh.vertices.size(); };
        in_.require(std::is_sorted(mesh.loop_starts.begin(), mesh.loop_starts.end()) &&
                    is_known(mesh.rimVertexCount()) && (!mesh.lattice || is_known(mesh.lattice->grid.end())));
        for (const Triangle& triangle : mesh.triangles) {
            in_.require(*std::max_element(triangle.begin(), triangle.end()) < mesh.vertices.size());
        }
    }

    ExactReader in_;
};

}  // namespace

std::string bytesOf(const Frame& frame)
{
    Saver saver(kFrameHead);
    saver(frame);
    return saver.release();
}

Frame frameFromBytes(std::string_view bytes, const std::string& name)
{
    Loader loader(bytes, kFrameHead, name);
    Frame frame;
    loader(frame);
    loader.end();
    const std::size_t count = frame.droplets.size();
    loader.require(frame.lineage && (count == 0 || frame.lineage->first) && frame.droplet.meshes.size() == count &&
                   frame.droplet.solution.droplets.size() == count && frame.droplet.domain.droplets.size() == count &&
                   frame.droplet.figures.size() == count);
    if (!frame.droplet.surface.vertices.empty()) {
        try {
            frame.droplet.surface.validate();
        } catch (const Error& /*error*/) {
            loader.require(false);
        }
    }
    return frame;
}

std::string bytesOf(const std::vector<FrameReport>& frames)
{
    Saver saver(kReportsHead);
    saver(frames);
    return saver.release();
}

std::vector<FrameReport> frameReportsFromBytes(std::string_view bytes, const std::string& name)
{
    Loader loader(bytes, kReportsHead, name);
    std::vector<FrameReport> frames;
    loader(frames);
    loader.end();
    return frames;
}

}  // namespace droplet

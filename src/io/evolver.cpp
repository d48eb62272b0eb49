// SPDX-License-Identifier: GPL-3.0-or-later
// K. A. Brakke, "The Surface Evolver", Experimental Mathematics 1 (1992); "Surface Evolver Manual", version 2.70
// (2013), chapters "Datafile organization" and "Hessian".
#include "droplet/io/evolver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <ostream>
#include <string>
#include <type_traits>

#include "byte_stream.h"
#include "droplet/error.h"
#include "droplet/version.h"
#include "shape/area_vector.h"
#include "shape/liquid_shapes.h"
#include "shape/sheet_base.h"

namespace droplet {
namespace {

/// Physics in Evolver's units. The divergence theorem turns volume integrals of energy into surface integrals: ρgz
/// becomes the flux of (0, 0, ½z²), Evolver's density of a body, and the pull along the plane the flux of
/// (0, 0, −(s·x)z). Between curved ground and z = 0 lies a constant part of both energies and of the volume.
struct Physics {
    double unit = 1.0;     ///< unit of length [m]
    double weight = 0.0;   ///< ρg⊥/σ [1/unit²]
    Vec2 pull;             ///< s = ρg∥/σ [1/unit²]
    double tension = 1.0;  ///< σ [N/m]

    [[nodiscard]] bool tilted() const { return pull.x != 0.0 || pull.y != 0.0; }
};

/// ∫½wz² − (s·x)z and ∫z of a function z that is linear on every triangle.
struct Column {
    double energy = 0.0;
    double volume = 0.0;
};

/// Droplet in the file's units.
struct Drop {
    const CapillarySurface* surface = nullptr;
    std::vector<Vec3> vertices;
    std::vector<double> ground;  ///< height of the ground at every vertex; empty if flat
    double pressure = 0.0;
    double area = 0.0;
    Column liquid;
    Column under;  ///< space between the ground and z = 0
};

[[noreturn]] void refuse(const std::string& message)
{
    throw Error(ErrorCode::InvalidArgument, message);
}

void check(const std::vector<CapillarySurface>& surfaces)
{
    if (surfaces.empty()) {
        refuse("surfaces must hold at least one droplet");
    }
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
        const CapillarySurface& surface = surfaces[k];
        surface.validate();
        if (!std::isfinite(surface.pressure) ||
            !std::all_of(surface.vertices.begin(), surface.vertices.end(),
                         [](Vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); })) {
            refuse("surfaces[" + std::to_string(k) + "] must be finite");
        }
    }
}

/// Power of ten nearest to the radius of a disc with the area of the mean footprint.
double unitOfLength(const std::vector<CapillarySurface>& surfaces)
{
    double total = 0.0;
    for (const CapillarySurface& surface : surfaces) {
        for (const Triangle& t : surface.triangles) {
            total += areaVector(surface.vertices, t).z;
        }
    }
    const double mean = total / static_cast<double>(surfaces.size());
    return std::pow(10.0, std::round(0.5 * std::log10(mean / std::numbers::pi)));
}

Physics physicsOf(const std::vector<CapillarySurface>& surfaces, const SolveOptions& options)
{
    Physics physics;
    physics.unit = unitOfLength(surfaces);
    physics.tension = options.liquid.surface_tension;
    const PlaneGravity gravity = planeGravity(options);
    const double scale = options.liquid.density / physics.tension * physics.unit * physics.unit;
    physics.weight = scale * gravity.normal;
    physics.pull = scale * gravity.along;
    return physics;
}

Column columnUnder(const std::array<Vec3, 3>& corners, double area, const Physics& physics)
{
    double z = 0.0;
    double zz = 0.0;
    double sz = 0.0;
    double s = 0.0;
    for (const Vec3& p : corners) {
        const double along = physics.pull.x * p.x + physics.pull.y * p.y;
        z += p.z;
        zz += p.z * p.z;
        s += along;
        sz += along * p.z;
    }
    // ∫fg = A/12·(Σf·Σg + Σfg) for linear functions on a triangle.
    return {area / 12.0 * (0.5 * physics.weight * (z * z + zz) - (s * z + sz)), area / 3.0 * z};
}

/// What lies below the liquid, over triangles of the footprint.
Column underOf(const PlanarMesh& footprint, const BaseSurface& ground, const Physics& physics)
{
    const std::vector<double> heights = heightsUnder(footprint, ground);
    Column under;
    for (const Triangle& t : footprint.triangles) {
        std::array<Vec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 p = footprint.vertices[t[k]];
            corners[k] = {p.x / physics.unit, p.y / physics.unit, heights[t[k]] / physics.unit};
        }
        const double size = 0.5 * doubleArea(footprint, t) / (physics.unit * physics.unit);
        const Column part = columnUnder(corners, size, physics);
        under.energy += part.energy;
        under.volume += part.volume;
    }
    return under;
}

Drop makeDrop(const CapillarySurface& surface, const BaseSurface& ground, const Physics& physics)
{
    const SheetBase base{ground, {}};
    Drop drop;
    drop.surface = &surface;
    drop.pressure = surface.pressure / physics.tension * physics.unit;
    for (const Vec3& p : surface.vertices) {
        drop.vertices.push_back({p.x / physics.unit, p.y / physics.unit, p.z / physics.unit});
        if (!ground.flat()) {
            const double height = base.under(p).height;
            drop.ground.push_back((std::isfinite(height) ? height : p.z) / physics.unit);
        }
    }
    for (const Triangle& t : surface.triangles) {
        const std::array<Vec3, 3> corners{drop.vertices[t[0]], drop.vertices[t[1]], drop.vertices[t[2]]};
        const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
        drop.area += 0.5 * length(normal);
        const Column part = columnUnder(corners, 0.5 * normal.z, physics);
        drop.liquid.energy += part.energy;
        drop.liquid.volume += part.volume;
    }
    if (!ground.flat()) {
        drop.under = underOf(footprintOf(surface), ground, physics);
    }
    return drop;
}

using Ends = std::array<std::uint32_t, 2>;

/// Both vertices of every edge, smaller index first, in ascending order.
std::vector<Ends> edgesOf(const std::vector<Triangle>& triangles)
{
    std::vector<Ends> edges;
    edges.reserve(3 * triangles.size());
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            edges.push_back({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

/// Writer of words and numbers, separated by spaces and line ends.
class Lines {
public:
    explicit Lines(std::ostream& out) : bytes_(out) {}

    template <class... Items>
    void line(Items... items)
    {
        begin(items...);
        end();
    }

    template <class... Items>
    void begin(Items... items)
    {
        (item(items), ...);
    }

    void end() { bytes_.u8('\n'); }
    std::uint64_t finish() { return bytes_.finish(); }

private:
    void item(const char* words) { bytes_.text(words); }
    template <class Number>
    void item(Number value)
    {
        if constexpr (std::is_floating_point_v<Number>) {
            value += 0.0;  // no negative zero
        }
        bytes_.digits(value);
    }

    ByteStream bytes_;
};

/// Commands of the datafile. A step of length 0 finds the pressures at which Newton's method starts. hessian_seek
/// searches the minimum of energy along Newton's direction: it is safe, but only as accurate as energies can be
/// distinguished. Then hessian, the full step, converges quadratically.
constexpr const char* kCommands = R"(
read
hessian_normal on
vertically := { hessian_special_normal on; }
freely := { hessian_special_normal off; }
steps := 0
equilibrate := {
  m 0; g;
  do { before := total_energy; hessian_seek; steps += 1; }
  while ( steps < 50 && before - total_energy > 1e-6*abs(total_energy) );
  do { before := sum(body, pressure); hessian; steps += 1; }
  while ( steps < 60 && abs(sum(body, pressure) - before) > 1e-10*abs(before) );
}
report := {
  printf "energy %.17g height %.17g steps %g\n", total_energy - ground_energy, max(vertex, z - ground), steps;
  foreach body bb do printf "body %g volume %.17g pressure %.17g\n", bb.id, bb.volume, bb.pressure;
}
)";

/// Bodies as ranges [begin, end) of droplets.
std::vector<std::array<std::size_t, 2>> bodiesOf(std::size_t droplets, const SolveOptions& options)
{
    if (options.fill.sharing == FillSharing::Total) {
        return {{0, droplets}};
    }
    std::vector<std::array<std::size_t, 2>> bodies;
    for (std::size_t k = 0; k < droplets; ++k) {
        bodies.push_back({k, k + 1});
    }
    return bodies;
}

/// Total volume above z = 0, and total volume between the ground and z = 0.
std::array<double, 2> volumesOf(const std::vector<Drop>& drops, const std::array<std::size_t, 2>& body)
{
    std::array<double, 2> volumes{};
    for (std::size_t k = body[0]; k < body[1]; ++k) {
        volumes[0] += drops[k].liquid.volume;
        volumes[1] += drops[k].under.volume;
    }
    return volumes;
}

double heightOf(const std::vector<Drop>& drops)
{
    double height = 0.0;
    for (const Drop& drop : drops) {
        for (std::size_t i = 0; i < drop.vertices.size(); ++i) {
            height = std::max(height, drop.vertices[i].z - (drop.ground.empty() ? 0.0 : drop.ground[i]));
        }
    }
    return height;
}

/// Writer of a datafile from droplets in its units.
class Datafile {
public:
    Datafile(std::ostream& out, const std::vector<Drop>& drops, const Physics& physics, const SolveOptions& options,
             bool has_sheets)
        : lines_(out),
          drops_(drops),
          physics_(physics),
          options_(options),
          has_sheets_(has_sheets),
          bodies_(bodiesOf(drops.size(), options))
    {
    }

    std::uint64_t write()
    {
        writeOpening();
        writeTop();
        writeVertices();
        writeEdgesAndFaces();
        writeBodies();
        lines_.line(kCommands, has_sheets_ ? "freely" : "vertically");
        return lines_.finish();
    }

private:
    void writeOpening()
    {
        const double unit = physics_.unit;
        const double sigma = physics_.tension;
        lines_.line("// Droplets for Surface Evolver 2.70, by droplet-shape ", kVersion);
        lines_.line("//");
        lines_.line("// The unit of length is ", unit, " m, the surface tension 1. To SI:");
        lines_.line("//   energy * ", sigma * unit * unit, " J, pressure * ", sigma / unit, " Pa");
        lines_.line("//   height * ", unit, " m, volume * ", unit * unit * unit, " m3");
        lines_.line(
            "// Energy: area + int(weight/2*(u^2 - h^2) - (pull_x*x + pull_y*y)*(u - h)), of a surface u over the");
        lines_.line("// ground h. Volume: int(u - h). Height: the largest u - h. Pressure: dE/dV, at the origin.");
        lines_.line("//");
        lines_.line("// The surface below has");
        double energy = 0.0;
        for (const Drop& drop : drops_) {
            energy += drop.area + drop.liquid.energy - drop.under.energy;
        }
        lines_.line("//   energy ", energy, " height ", heightOf(drops_));
        for (std::size_t b = 0; b < bodies_.size(); ++b) {
            const auto [above, below] = volumesOf(drops_, bodies_[b]);
            lines_.line("//   body ", b + 1, " volume ", above - below, " pressure ", drops_[bodies_[b][0]].pressure);
        }
        lines_.line("//");
        lines_.line(
            "// \"equilibrate; report\" finds the equilibrium and prints the same of it. Vertices move up and down "
            "only,");
        lines_.line("// which minimises among the functions that the exact model does; after \"freely\" they move");
        lines_.line("// along the surface's normal and may hang over, after \"vertically\" up and down again.");
    }

    void writeTop()
    {
        lines_.line();
        lines_.line("gravity_constant 1");
        lines_.line("integral_order_2d 2");
        double ground_energy = 0.0;
        for (const Drop& drop : drops_) {
            ground_energy += drop.under.energy;
        }
        lines_.line("parameter weight = ", physics_.weight);
        lines_.line("parameter pull_x = ", physics_.pull.x);
        lines_.line("parameter pull_y = ", physics_.pull.y);
        lines_.line("parameter ground_energy = ", ground_energy);
        lines_.line("define vertex attribute ground real");
        lines_.line("hessian_special_normal_vector");
        lines_.line("c1: 0\nc2: 0\nc3: 1");
        if (physics_.tilted()) {
            lines_.line("quantity tilt energy method facet_vector_integral global");
            lines_.line("vector_integrand:");
            lines_.line("q1: 0\nq2: 0\nq3: -(pull_x*x + pull_y*y)*z");
        }
        if (options_.no_penetration) {
            lines_.line(
                "// What is dry below is fixed: Newton steps free no vertex that a one-sided constraint holds.");
            lines_.line("constraint 1 nonnegative");
            lines_.line("formula: z = ground");
        }
    }

    void writeVertices()
    {
        lines_.line();
        lines_.line("vertices");
        std::size_t number = 0;
        for (const Drop& drop : drops_) {
            for (std::uint32_t v = 0; v < drop.vertices.size(); ++v) {
                const Vec3& p = drop.vertices[v];
                lines_.begin(++number, " ", p.x, " ", p.y, " ", p.z);
                if (drop.surface->onRim(v) || (!drop.surface->dry.empty() && drop.surface->dry[v] != 0)) {
                    lines_.begin(" fixed");
                } else if (options_.no_penetration) {
                    lines_.begin(" constraint 1");
                }
                if (!drop.ground.empty()) {
                    lines_.begin(" ground ", drop.ground[v]);
                }
                lines_.line();
            }
        }
    }

    void writeEdgesAndFaces()
    {
        std::vector<std::vector<Ends>> edges;
        lines_.line();
        lines_.line("edges");
        std::size_t number = 0;
        std::size_t first_vertex = 1;
        for (const Drop& drop : drops_) {
            edges.push_back(edgesOf(drop.surface->triangles));
            for (const auto& [a, b] : edges.back()) {
                lines_.line(++number, " ", first_vertex + a, " ", first_vertex + b,
                            drop.surface->onRim(b) ? " fixed" : "");
            }
            first_vertex += drop.vertices.size();
        }
        lines_.line();
        lines_.line("faces");
        number = 0;
        std::size_t first_edge = 1;
        for (std::size_t k = 0; k < drops_.size(); ++k) {
            for (const Triangle& t : drops_[k].surface->triangles) {
                lines_.begin(++number);
                for (std::size_t i = 0; i < 3; ++i) {
                    const std::uint32_t from = t[i];
                    const std::uint32_t to = t[(i + 1) % 3];
                    const Ends ends{std::min(from, to), std::max(from, to)};
                    const auto edge = std::lower_bound(edges[k].begin(), edges[k].end(), ends) - edges[k].begin();
                    lines_.begin(from < to ? " " : " -", first_edge + static_cast<std::size_t>(edge));
                }
                lines_.line();
            }
            first_edge += edges[k].size();
        }
    }

    void writeBodies()
    {
        constexpr std::size_t kFacesPerLine = 16;
        lines_.line();
        lines_.line("bodies");
        std::size_t face = 0;
        for (std::size_t b = 0; b < bodies_.size(); ++b) {
            lines_.begin(b + 1);
            for (std::size_t k = bodies_[b][0]; k < bodies_[b][1]; ++k) {
                for (std::size_t i = 0; i < drops_[k].surface->triangles.size(); ++i) {
                    lines_.begin(i % kFacesPerLine == 0 ? " \\\n" : " ", ++face);
                }
            }
            const auto [above, below] = volumesOf(drops_, bodies_[b]);
            lines_.line(" \\\nvolume ", above - below, " volconst ", 0.0 - below, " density weight");
        }
    }

    Lines lines_;
    const std::vector<Drop>& drops_;
    const Physics& physics_;
    const SolveOptions& options_;
    bool has_sheets_;
    std::vector<std::array<std::size_t, 2>> bodies_;
};

}  // namespace

std::uint64_t writeEvolver(std::ostream& out, const std::vector<CapillarySurface>& surfaces,
                           const SolveOptions& options)
{
    SolveOptions checked = options;
    checked.fill = {};  // angles beyond 90° are those of sheets
    checked.validate();
    check(surfaces);
    const Physics physics = physicsOf(surfaces, options);
    std::vector<Drop> drops;
    drops.reserve(surfaces.size());
    for (const CapillarySurface& surface : surfaces) {
        drops.push_back(makeDrop(surface, options.ground, physics));
    }
    return Datafile(out, drops, physics, options, haveSheets(surfaces)).write();
}

}  // namespace droplet

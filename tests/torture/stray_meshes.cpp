// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes over which droplets run: no mesh may lose liquid, or let a droplet leave its face.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "droplet/flow/flow.h"
#include "droplet/flow/scatter.h"
#include "droplet/flow_io/flow_object.h"
#include "rays/nearest.h"
#include "support/command.h"
#include "torture/corpus.h"
#include "torture/random.h"
#include "torture/trial.h"

namespace droplet::torture {
namespace {

constexpr std::size_t kVariants = 10;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;

    void add(Vec3 a, Vec3 b, Vec3 c)
    {
        const auto first = static_cast<std::uint32_t>(vertices.size());
        vertices.insert(vertices.end(), {a, b, c});
        triangles.push_back({first, first + 1, first + 2});
    }
    void add(const Mesh& other)
    {
        const auto first = static_cast<std::uint32_t>(vertices.size());
        vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
        for (const auto& [a, b, c] : other.triangles) {
            triangles.push_back({a + first, b + first, c + first});
        }
    }
    void turnOver(std::size_t t) { std::swap(triangles[t][1], triangles[t][2]); }
};

double between(Random& random, double low, double high)
{
    return low + (high - low) * random.real();
}

Vec3 inCube(Random& random, double half)
{
    const double x = between(random, -half, half);
    const double y = between(random, -half, half);
    return {x, y, between(random, -half, half)};
}

/// Net of n × m cells; `place` maps the unit square.
template <typename Place>
Mesh netOf(std::uint32_t n, std::uint32_t m, const Place& place)
{
    Mesh mesh;
    for (std::uint32_t j = 0; j <= m; ++j) {
        for (std::uint32_t i = 0; i <= n; ++i) {
            mesh.vertices.push_back(place(static_cast<double>(i) / n, static_cast<double>(j) / m));
        }
    }
    for (std::uint32_t j = 0; j < m; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i;
            mesh.triangles.push_back({a, a + 1, a + n + 2});
            mesh.triangles.push_back({a, a + n + 2, a + n + 1});
        }
    }
    return mesh;
}

/// Its poles are triangles without an area, and its seam is open but for rounding.
Mesh sphere(std::uint32_t n, double radius, Vec3 centre = {})
{
    return netOf(2 * n, n, [&](double u, double v) {
        const double turn = 2.0 * std::numbers::pi * u;
        const double polar = std::numbers::pi * (1.0 - v);
        return centre +
               radius * Vec3{std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)};
    });
}

Mesh closedSphere(std::uint32_t n, double radius)
{
    Mesh mesh = sphere(n, radius);
    const std::uint32_t row = 2 * n + 1;
    for (std::uint32_t j = 0; j <= n; ++j) {
        mesh.vertices[j * row + row - 1] = mesh.vertices[j * row];
    }
    for (std::uint32_t i = 0; i < row; ++i) {
        mesh.vertices[i] = {0.0, 0.0, -radius};
        mesh.vertices[n * row + i] = {0.0, 0.0, radius};
    }
    return mesh;
}

Mesh tetrahedron(Random& random, Vec3 centre, double size)
{
    std::array<Vec3, 4> corners;
    for (Vec3& corner : corners) {
        corner = centre + inCube(random, size);
    }
    Mesh mesh;
    mesh.vertices.assign(corners.begin(), corners.end());
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    return mesh;
}

std::uint32_t count(Random& random, std::uint32_t low, std::uint32_t high)
{
    return low + static_cast<std::uint32_t>(random.below(static_cast<int>(high - low + 1)));
}

using Make = Mesh (*)(Random&);

const std::array<std::pair<const char*, Make>, 20> kKinds{{
    {"soup",
     [](Random& random) {
         Mesh mesh;
         for (std::uint32_t left = count(random, 2, 400); left > 0; --left) {
             mesh.add(inCube(random, 0.1), inCube(random, 0.1), inCube(random, 0.1));
         }
         return mesh;
     }},
    {"moebius",
     [](Random& random) {
         const std::uint32_t n = count(random, 3, 60);
         Mesh mesh = netOf(n, count(random, 1, 4), [&](double u, double v) {
             const double turn = 2.0 * std::numbers::pi * u;
             const double r = 0.1 + 0.05 * (v - 0.5) * std::cos(0.5 * turn);
             return Vec3{r * std::cos(turn), r * std::sin(turn), 0.05 * (v - 0.5) * std::sin(0.5 * turn)};
         });
         // The last column meets the first one upside down.
         const std::uint32_t rows = static_cast<std::uint32_t>(mesh.vertices.size()) / (n + 1);
         for (std::uint32_t j = 0; j < rows; ++j) {
             mesh.vertices[j * (n + 1) + n] = mesh.vertices[(rows - 1 - j) * (n + 1)];
         }
         return mesh;
     }},
    {"crossing",
     [](Random& random) {
         Mesh mesh;
         for (std::uint32_t left = count(random, 2, 6); left > 0; --left) {
             mesh.add(sphere(count(random, 3, 10), between(random, 0.02, 0.1), inCube(random, 0.05)));
         }
         return mesh;
     }},
    {"duplicates",
     [](Random& random) {
         Mesh mesh = closedSphere(6, 0.1);
         for (std::size_t t = mesh.triangles.size(); t > 0; --t) {
             for (std::uint32_t left = count(random, 0, 2); left > 0; --left) {
                 mesh.triangles.push_back(mesh.triangles[t - 1]);
                 if (random.real() < 0.5) {
                     mesh.turnOver(mesh.triangles.size() - 1);
                 }
             }
         }
         return mesh;
     }},
    {"flipped",
     [](Random& random) {
         Mesh mesh = closedSphere(count(random, 3, 12), 0.1);
         for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
             if (random.real() < 0.5) {
                 mesh.turnOver(t);
             }
         }
         return mesh;
     }},
    {"slivers",
     [](Random& random) {
         // Rows whose height shrinks to nothing, on a slope.
         const double shrink = between(random, 0.05, 0.6);
         const double slope = between(random, 0.1, 5.0);
         return netOf(3, 24, [&](double u, double v) {
             const double y = 0.1 * std::pow(shrink, 24.0 * v);
             return Vec3{0.1 * u, y, slope * y};
         });
     }},
    {"nan",
     [](Random& random) {
         Mesh mesh = closedSphere(5, 0.1);
         Vec3& p = mesh.vertices[count(random, 0, 30)];
         (random.real() < 0.5 ? p.x : p.z) = random.real() < 0.5 ? kNaN : std::numeric_limits<double>::infinity();
         return mesh;
     }},
    {"huge",
     [](Random& random) {
         Mesh mesh = closedSphere(5, 0.1);
         const double far = std::pow(10.0, between(random, 3.0, 40.0));
         if (random.real() < 0.5) {
             mesh.vertices[20].x = far;
         } else {
             for (Vec3& p : mesh.vertices) {
                 p.y += far;
             }
         }
         return mesh;
     }},
    {"tiny",
     [](Random& random) {
         Mesh mesh = closedSphere(5, std::pow(10.0, between(random, -30.0, -2.0)));
         if (random.real() < 0.3) {
             mesh.vertices[20].x += 0.1;
         }
         return mesh;
     }},
    {"parts",
     [](Random& random) {
         Mesh mesh;
         for (std::uint32_t left = count(random, 2, 200); left > 0; --left) {
             const Vec3 centre = inCube(random, 0.1);
             mesh.add(tetrahedron(random, centre, std::pow(10.0, between(random, -7.0, -1.5))));
         }
         return mesh;
     }},
    {"fan",
     [](Random& random) {
         // Many triangles at one edge.
         Mesh mesh;
         const Vec3 a = inCube(random, 0.1);
         const Vec3 b = inCube(random, 0.1);
         for (std::uint32_t left = count(random, 3, 40); left > 0; --left) {
             mesh.add(a, b, inCube(random, 0.1));
         }
         return mesh;
     }},
    {"triangle",
     [](Random& random) {
         Mesh mesh;
         mesh.add(inCube(random, 0.1), inCube(random, 0.1), inCube(random, 0.1));
         return mesh;
     }},
    {"inside_out",
     [](Random& random) {
         Mesh mesh = closedSphere(count(random, 3, 16), 0.1);
         for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
             mesh.turnOver(t);
         }
         return mesh;
     }},
    {"needles",
     [](Random& random) {
         Mesh mesh;
         for (std::uint32_t left = count(random, 1, 30); left > 0; --left) {
             const Vec3 a = inCube(random, 0.1);
             const double width = std::pow(10.0, between(random, -9.0, -2.0));
             mesh.add(a, a + inCube(random, width), inCube(random, 0.1));
         }
         return mesh;
     }},
    {"junctions",
     [](Random& random) {
         // Neighbours that are cut differently, with cracks of rounding between them.
         Mesh mesh;
         const double slope = between(random, 0.0, 2.0);
         for (std::uint32_t k = 0; k < 5; ++k) {
             mesh.add(netOf(count(random, 1, 9), count(random, 1, 9), [&](double u, double v) {
                 return Vec3{0.1 * u, 0.04 * (k + v), slope * 0.04 * (k + v) + between(random, -1e-17, 1e-17)};
             }));
         }
         return mesh;
     }},
    {"sheets",
     [](Random& random) {
         // Parallel sheets at distances from nothing up, some upside down.
         Mesh mesh;
         const double slope = between(random, 0.0, 2.0);
         double height = 0.0;
         for (std::uint32_t k = 0; k < 6; ++k) {
             Mesh sheet = netOf(4, 4, [&](double u, double v) { return Vec3{0.1 * u, 0.1 * v, height + slope * v}; });
             for (std::size_t t = 0; k % 2 == 1 && t < sheet.triangles.size(); ++t) {
                 sheet.turnOver(t);
             }
             mesh.add(sheet);
             height += random.real() < 0.3 ? 0.0 : std::pow(10.0, between(random, -14.0, -2.0));
         }
         return mesh;
     }},
    {"folds",
     [](Random& random) {
         // Back onto itself, fold after fold.
         const double gap = random.real() < 0.5 ? 0.0 : std::pow(10.0, between(random, -12.0, -3.0));
         const double slope = between(random, 0.2, 3.0);
         const std::uint32_t folds = count(random, 2, 12);
         return netOf(2, folds, [&](double u, double v) {
             const double k = std::round(v * folds);
             const double y = std::fmod(k, 2.0) * 0.05;
             return Vec3{0.1 * u, y, slope * y + gap * k};
         });
     }},
    {"bow_ties",
     [](Random& random) {
         // Parts that touch in one vertex alone.
         Mesh mesh;
         mesh.vertices.push_back(inCube(random, 0.02));
         for (std::uint32_t left = count(random, 2, 30); left > 0; --left) {
             const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
             mesh.vertices.push_back(inCube(random, 0.1));
             mesh.vertices.push_back(inCube(random, 0.1));
             mesh.triangles.push_back({0, first, first + 1});
         }
         return mesh;
     }},
    {"spikes",
     [](Random& random) {
         Mesh mesh = closedSphere(count(random, 4, 16), 0.1);
         const double most = between(random, 0.1, 3.0);
         std::vector<double> factors;
         for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
             factors.push_back(1.0 + most * random.real());
         }
         for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
             const auto same = std::find(mesh.vertices.begin(), mesh.vertices.end(), mesh.vertices[v]);
             factors[v] = factors[static_cast<std::size_t>(same - mesh.vertices.begin())];
         }
         for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
             mesh.vertices[v] = factors[v] * mesh.vertices[v];
         }
         return mesh;
     }},
    {"lattice",
     [](Random& random) {
         // Corners on few places: triangles repeat, overlap, and have no area.
         Mesh mesh;
         const auto corner = [&] {
             const auto at = [&] { return 0.05 * count(random, 0, 3); };
             const double x = at();
             const double y = at();
             return Vec3{x, y, at()};
         };
         for (std::uint32_t left = count(random, 3, 120); left > 0; --left) {
             const Vec3 a = corner();
             const Vec3 b = corner();
             mesh.add(a, b, corner());
         }
         return mesh;
     }},
}};

/// Binary PLY with doubles.
std::string plyOf(const Mesh& mesh)
{
    std::string text = fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
        "property double z\nelement face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        mesh.vertices.size(), mesh.triangles.size());
    const auto put = [&text](const auto& value) { text.append(reinterpret_cast<const char*>(&value), sizeof value); };
    for (const Vec3& p : mesh.vertices) {
        put(p.x);
        put(p.y);
        put(p.z);
    }
    for (const auto& [a, b, c] : mesh.triangles) {
        put(std::uint8_t{3});
        put(a);
        put(b);
        put(c);
    }
    return text;
}

void check(const FlowState& state, const FlowTerrain& scene, const FlowParameters& parameters)
{
    constexpr double kBalance = 1e-9;
    constexpr double kDistance = 1e-9;  // over the size
    const double residual = balanceOf(state).residual();
    if (!(std::abs(residual) <= kBalance)) {
        throw std::logic_error(fmt::format("{:g} of the liquid is missing at {:g} s", residual, state.time));
    }
    for (const FlowSample& sample : sampleFlow(state, scene, parameters)) {
        const std::string droplet = fmt::format("droplet {} at {:g} s: ", sample.id, state.time);
        if (!std::isfinite(length(sample.place)) || !std::isfinite(length(sample.velocity)) || !(sample.volume > 0.0)) {
            throw std::logic_error(droplet + "place, velocity or volume is not a number");
        }
        const double off =
            sample.face ? distance(sample.place, scene.surface().faces[*sample.face].corners) / scene.diameter() : 0.0;
        if (!(off <= kDistance)) {
            throw std::logic_error(droplet + fmt::format("{:g} of the size away from its face {}", off, *sample.face));
        }
    }
}

FlowParameters parametersOf(std::size_t variant)
{
    FlowParameters parameters;
    parameters.seed = variant;
    parameters.wind = {0.0, variant % 3 == 0 ? 4.0 : 0.0, 0.0};
    if (variant % 2 == 1) {
        parameters.model = FlowModel::Paper;
        parameters.friction = variant % 4 == 1 ? 0.0 : 1e-5;
        parameters.adhesion = variant % 5 == 0 ? 0.0 : 10.0;
    } else {
        parameters.streaks.film = 5e-6;
        parameters.drying = 1.0;
        parameters.rain = FlowRain{};
        parameters.rain->rainfall = 1e-5;
        parameters.condensation = FlowCondensation{1e-7, 1e-2};
    }
    if (variant % 5 == 3) {
        parameters.motion.spin = {0.5, 3.0, 0.0};
    }
    return parameters;
}

Verdict tryStrayMesh(const Item& item)
{
    const testing::ScratchDirectory scratch;
    const auto path = scratch.path() / item.name;
    testing::writeFile(path, {reinterpret_cast<const char*>(item.bytes.data()), item.bytes.size()});
    const auto variant = static_cast<std::size_t>(std::stoi(item.name)) % kVariants;
    return tryReading([&] {
        const FlowObject object = readFlowObject(path);
        const FlowTerrain scene(flowSurface(object.vertices, object.triangles));
        const FlowParameters parameters = parametersOf(variant);
        const double width = 0.005 * scene.diameter();
        const auto starts = scatterDroplets(
            scene, {.count = 40, .volumes = {.median = width * width * width, .spread = 0.5}, .seed = variant});
        FlowState state = startFlow(scene, parameters, starts);
        constexpr int kFrames = 12;
        for (int k = 1; k <= kFrames; ++k) {
            state = advanceFlow(std::move(state), scene, parameters, 0.5 * k / kFrames);
            check(state, scene, parameters);
        }
    });
}

}  // namespace

Corpus strayMeshes()
{
    return {"stray meshes", kKinds.size() * kVariants,
            [](std::size_t index) {
                const auto& [name, make] = kKinds[index / kVariants];
                Random random(index);
                return Item{fmt::format("{:03}_{}.ply", index, name), bytesOf(plyOf(make(random)))};
            },
            tryStrayMesh};
}

}  // namespace droplet::torture

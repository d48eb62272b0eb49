// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "measured.h"
#include "resample.h"
#include "stages.h"
#include "system.h"

namespace droplet::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using VertexBase = CGAL::Delaunay_mesh_vertex_base_2<Kernel>;
using FaceBase = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;
using Mesher = CGAL::Delaunay_mesher_2<Triangulation, Criteria>;

// B = 1/(4 sin² of the smallest angle), here 20.7°: the manual's bound for which termination is proved.
constexpr double kShape = 0.125;

// Point inside a hole, a seed for CGAL. A horizontal line through the middle of one of the loop's sides enters the hole
// at its first crossing and leaves it at the second.
Point insideOf(const Loop& loop)
{
    const auto& points = loop.points;
    std::size_t longest = 0;
    const auto rise = [&](std::size_t i) { return std::abs(points[(i + 1) % points.size()].y - points[i].y); };
    for (std::size_t i = 1; i < points.size(); ++i) {
        longest = rise(i) > rise(longest) ? i : longest;
    }
    const double y = 0.5 * (points[longest].y + points[(longest + 1) % points.size()].y);
    std::vector<double> crossings;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec2 a = points[i];
        const Vec2 b = points[(i + 1) % points.size()];
        if ((a.y > y) != (b.y > y)) {
            crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
        }
    }
    std::sort(crossings.begin(), crossings.end());
    return {0.5 * (crossings[0] + crossings[1]), y};
}

struct Refined {
    std::size_t triangles = 0;
    double min_angle = std::numeric_limits<double>::infinity();  // [rad]
};

void addLoop(const Loop& loop, Triangulation& triangulation)
{
    std::vector<Triangulation::Vertex_handle> vertices;
    for (const Vec2 p : loop.points) {
        vertices.push_back(triangulation.insert(Point(p.x, p.y)));
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        triangulation.insert_constraint(vertices[i], vertices[(i + 1) % vertices.size()]);
    }
}

std::unique_ptr<Triangulation> refine(const Domain& domain, double edge)
{
    auto triangulation = std::make_unique<Triangulation>();
    std::vector<Point> seeds;
    for (const Footprint& footprint : resampled(domain, edge).droplets) {
        addLoop(footprint.rim, *triangulation);
        for (const Loop& hole : footprint.holes) {
            addLoop(hole, *triangulation);
            seeds.push_back(insideOf(hole));
        }
    }
    Mesher mesher(*triangulation, Criteria(kShape, edge));
    mesher.set_seeds(seeds.begin(), seeds.end());
    mesher.refine_mesh();
    return triangulation;
}

Refined countTriangles(const Triangulation& triangulation)
{
    Refined refined;
    for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end(); ++face) {
        if (!face->is_in_domain()) {
            continue;
        }
        ++refined.triangles;
        for (int k = 0; k < 3; ++k) {
            const auto u = face->vertex((k + 1) % 3)->point() - face->vertex(k)->point();
            const auto v = face->vertex((k + 2) % 3)->point() - face->vertex(k)->point();
            refined.min_angle = std::min(refined.min_angle, std::atan2(u.x() * v.y() - u.y() * v.x(), u * v));
        }
    }
    return refined;
}

/// Edge length at which CGAL makes the wanted number of triangles within 2 %. It is extrapolated from coarse meshes:
/// the number is proportional to 1/edge².
double edgeFor(const Domain& domain, std::size_t wanted)
{
    double ground = 0.0;
    for (const Footprint& footprint : domain.droplets) {
        ground += area(footprint);
    }
    const auto coarse = static_cast<double>(std::min<std::size_t>(wanted, 50'000));
    double edge = std::sqrt(2.0 * ground / coarse);
    for (int k = 0; k < 3; ++k) {
        const auto found = static_cast<double>(countTriangles(*refine(domain, edge)).triangles);
        edge *= std::sqrt(found / coarse);
    }
    return edge * std::sqrt(coarse / static_cast<double>(wanted));
}

void registerMesher(const std::shared_ptr<Case>& letter, std::size_t size)
{
    measure(
        "Triangulate/Delaunay_mesher_2/" + inShort(size), 5, [] {},
        [letter, edge = edgeFor(letter->domain(), size)] { return refine(letter->domain(), edge); },
        [](const std::unique_ptr<Triangulation>& triangulation, benchmark::UserCounters& counters) {
            const Refined refined = countTriangles(*triangulation);
            counters["triangles"] = static_cast<double>(refined.triangles);
            counters["min_angle_deg"] = refined.min_angle / kDegree;
        });
}

/// Measures ordering, factorisation and solution; the assembly of the matrix is not counted.
void registerCholesky(const std::shared_ptr<Case>& letter, std::size_t size)
{
    const auto system = std::make_shared<System>();
    measure(
        "Solve/Eigen SimplicialLLT/" + inShort(size), 5,
        [letter, size, system] { *system = assemble(letter->meshes(size).front(), {}); },
        [system] {
            const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor(system->matrix);
            return Eigen::VectorXd(factor.solve(system->load));
        },
        [letter, size, system](const Eigen::VectorXd& height, benchmark::UserCounters& counters) {
            counters["triangles"] = static_cast<double>(triangleCount(letter->meshes(size)));
            counters["unknowns"] = static_cast<double>(height.size());
            counters["residual"] =
                (system->load - system->matrix.selfadjointView<Eigen::Lower>() * height).norm() / system->load.norm();
            *system = {};
        });
}

}  // namespace

void registerPeers(const Plan& plan)
{
    const auto letter = std::make_shared<Case>("letter", split(trace(readMask(plan.masks.front()))));
    for (const std::size_t size : {std::size_t{5'000}, std::size_t{100'000}, std::size_t{1'000'000}}) {
        if (plan.has(size)) {
            registerMesher(letter, size);
            registerCholesky(letter, size);
        }
    }
}

}  // namespace droplet::bench

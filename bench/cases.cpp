// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases.h"

#include <algorithm>
#include <utility>

namespace droplet::bench {

Case::Case(std::string name, Domain domain) : name_(std::move(name)), domain_(std::move(domain)) {}

const std::vector<PlanarMesh>& Case::meshes(std::size_t triangles)
{
    choose(triangles);
    if (!meshes_) {
        meshes_ = triangulate(domain_, meshOf(triangles));
    }
    return *meshes_;
}

const Solution& Case::solution(std::size_t triangles)
{
    choose(triangles);
    if (!solution_) {
        solution_ = solve(meshes(triangles));
    }
    return *solution_;
}

const Surface& Case::surface(std::size_t triangles)
{
    choose(triangles);
    if (!surface_) {
        surface_ = loft(solution(triangles).droplets, {.extent = domain_.extent});
    }
    return *surface_;
}

void Case::choose(std::size_t triangles)
{
    if (triangles != triangles_) {
        triangles_ = triangles;
        meshes_.reset();
        solution_.reset();
        surface_.reset();
    }
}

TriangulateOptions meshOf(std::size_t triangles)
{
    TriangulateOptions options;
    options.triangles = triangles;
    return options;
}

bool Plan::has(std::size_t size) const
{
    return std::find(sizes.begin(), sizes.end(), size) != sizes.end();
}

std::string inShort(std::size_t triangles)
{
    return triangles % 1'000'000 == 0 ? std::to_string(triangles / 1'000'000) + "M"
                                      : std::to_string(triangles / 1'000) + "k";
}

std::size_t triangleCount(const std::vector<PlanarMesh>& meshes)
{
    std::size_t count = 0;
    for (const PlanarMesh& mesh : meshes) {
        count += mesh.triangles.size();
    }
    return count;
}

}  // namespace droplet::bench

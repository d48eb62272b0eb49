// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "droplet/droplet.h"

namespace droplet::bench {

/// A footprint, and what comes of it at one number of triangles after the other: each stage's result is made when it is
/// first asked for, and kept until another number is.
class Case {
public:
    Case(std::string name, Domain domain);

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const Domain& domain() const { return domain_; }
    const std::vector<PlanarMesh>& meshes(std::size_t triangles);
    const Solution& solution(std::size_t triangles);
    const Surface& surface(std::size_t triangles);

private:
    void choose(std::size_t triangles);

    std::string name_;
    Domain domain_;
    std::size_t triangles_ = 0;
    std::optional<std::vector<PlanarMesh>> meshes_;
    std::optional<Solution> solution_;
    std::optional<Surface> surface_;
};

/// What is to be measured.
struct Plan {
    std::vector<std::filesystem::path> masks;  ///< the first also goes through all later stages
    std::vector<std::size_t> sizes;            ///< [triangles]

    [[nodiscard]] bool has(std::size_t size) const;
};

TriangulateOptions meshOf(std::size_t triangles);

/// As it stands in names: 5k, 1M.
std::string inShort(std::size_t triangles);

std::size_t triangleCount(const std::vector<PlanarMesh>& meshes);

}  // namespace droplet::bench

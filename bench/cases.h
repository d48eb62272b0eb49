// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "droplet/droplet.h"

namespace droplet::bench {

/// Footprint with the results of the stages at one number of triangles. A result is computed at the first call, and
/// kept until a call with another number.
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

/// Masks and sizes to be measured.
struct Plan {
    std::vector<std::filesystem::path> masks;  ///< the first one is also measured in all later stages
    std::vector<std::size_t> sizes;            ///< [triangles]

    [[nodiscard]] bool has(std::size_t size) const;
};

TriangulateOptions meshOf(std::size_t triangles);

/// Short form for names: 5k, 1M.
std::string inShort(std::size_t triangles);

std::size_t triangleCount(const std::vector<PlanarMesh>& meshes);

}  // namespace droplet::bench

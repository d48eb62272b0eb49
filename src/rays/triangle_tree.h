// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Corners of a triangle in space.
using Corners3 = std::array<Vec3, 3>;

/// Tree of the boxes of triangles. Any number of threads may search at the same time.
class TriangleTree {
public:
    /// @param triangles  at least one, all coordinates within [−1, 1]; they must stay where they are
    explicit TriangleTree(const std::vector<Corners3>& triangles);
    ~TriangleTree();
    TriangleTree(const TriangleTree&) = delete;
    TriangleTree& operator=(const TriangleTree&) = delete;

    /// Visits every triangle whose box is no farther from p than the radius, in any order, and perhaps others.
    /// @param p      within [−1, 1]³
    /// @param visit  returns the new radius; a larger one has no effect
    void visit(Vec3 p, double radius, const std::function<double(std::uint32_t triangle)>& visit) const;

private:
    struct Boxes;
    std::unique_ptr<Boxes> boxes_;
};

}  // namespace droplet

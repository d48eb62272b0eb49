// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "droplet/vector.h"
#include "rays/triangle_tree.h"

namespace droplet {

/// Triangles that rays meet, with corners of floats. Any number of threads may search at the same time.
class RayTree {
public:
    /// @param triangles  at least one, all coordinates within [−1, 1]
    explicit RayTree(const std::vector<Corners3>& triangles);
    ~RayTree();
    RayTree(RayTree&& other) noexcept;

    /// First triangle on a ray, from either side.
    /// @param direction  not 0
    /// @param end        where the ray ends, over the direction; may be infinite
    /// @param takes      whether the ray ends at a triangle that it meets; otherwise it goes on. Empty: at all
    [[nodiscard]] std::optional<std::uint32_t> first(Vec3 origin, Vec3 direction, double end,
                                                     const std::function<bool(std::uint32_t)>& takes = {}) const;

private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
};

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "droplet/flow/flow_surface.h"
#include "droplet/vector.h"

namespace droplet {

/// Faces that a droplet can go to over faces that are near it.
///
/// A face counts as near within a reach, and every question has a reach of its own. So the faces are found in the order
/// of the least reach that joins them with the droplet's: R. C. Prim, "Shortest connection networks and some
/// generalizations", Bell System Technical Journal 36 (1957) 1389. The search goes on where the last question left it,
/// so all questions about a droplet visit each face once, however many there are.
class JoinedFaces {
public:
    /// @param surface  must outlive the object
    /// @param from     face of the droplet
    /// @param place    of the droplet [m]
    JoinedFaces(const FlowSurface& surface, std::uint32_t from, Vec3 place);

    /// Whether a way leads to a face over faces no farther than a reach from the droplet. The answer does not depend on
    /// earlier questions.
    /// @param to     number of the face
    /// @param reach  [m]
    [[nodiscard]] bool has(std::uint32_t to, double reach);

private:
    using Entry = std::pair<double, std::uint32_t>;  // reach that joins a face, and the face

    const FlowSurface& surface_;
    Vec3 place_;
    std::vector<Entry> open_;                          // heap: the least reach is on top
    std::unordered_map<std::uint32_t, double> reach_;  // that joins the faces found
};

}  // namespace droplet

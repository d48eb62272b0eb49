// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "droplet/flow/flow_surface.h"
#include "droplet/flow_io/flow_object.h"

namespace droplet {

/// Weights of a face's corners in the corners of the object's triangle that the face is part of: for each corner of the
/// face, three weights whose sum is 1.
/// @param face  of a surface made of the object's triangles
std::array<std::array<double, 3>, 3> cornerWeights(const FlowObject& object, const FlowSurface::Face& face);

/// The object with the triangles of a surface made of it, in their order and wound as they are, none with another's
/// vertices.
FlowObject onFaces(const FlowObject& object, const FlowSurface& surface);

}  // namespace droplet

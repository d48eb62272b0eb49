// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "droplet/flow/flow_surface.h"
#include "droplet/flow_io/flow_object.h"

namespace droplet {

/// Weights of a triangle's corners at a place in its plane; their sum is 1.
std::array<double, 3> weightsAt(const FlowObject& object, const Triangle& triangle, Vec3 place);

/// Mean of the values at a triangle's corners.
template <typename Value>
Value mixed(const std::vector<Value>& values, const Triangle& triangle, const std::array<double, 3>& weights)
{
    return weights[0] * values[triangle[0]] + weights[1] * values[triangle[1]] + weights[2] * values[triangle[2]];
}

/// Weights of a face's corners in the corners of the object's triangle that the face is part of: for each corner of the
/// face, three weights whose sum is 1.
/// @param face  of a surface made of the object's triangles
std::array<std::array<double, 3>, 3> cornerWeights(const FlowObject& object, const FlowSurface::Face& face);

/// The object with the triangles of a surface made of it, in their order and wound as they are, none with another's
/// vertices; without its looks, motion and warnings.
FlowObject onFaces(const FlowObject& object, const FlowSurface& surface);

}  // namespace droplet

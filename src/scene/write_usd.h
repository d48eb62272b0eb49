// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>

#include "droplet/scene/format.h"
#include "scene/scene.h"

namespace droplet {

/// Writes a scene as Universal Scene Description, in text, or as a package of that text and the scene's picture.
///
/// The default prim is `/droplet`. A node is a Mesh, or an Xform with what it carries; looks are materials beside them.
/// A crowd is a class, of which every copy is an instance with a transform of its own. Tracks are time samples in
/// frames: of transforms, and of points and normals where weights change. Values that hold until the next key get a
/// sample just before it, since USD knows one kind of interpolation for all of a stage. Points are a PointInstancer,
/// with a sample for every frame.
///
/// Guarantees: the same scene gives the same bytes, in any locale; nothing is written if it throws.
/// @param file   Usda or Usdz, without compression
/// @return       bytes handed to the stream, which is left failed if it did not take everything
/// @throws Error InvalidArgument if a mesh has more than 2³¹ − 1 corners, there is a picture that is data or needs a
///               package, or the package would reach 4 GiB
std::uint64_t writeUsd(const Scene& scene, std::ostream& out, const AnimatedFile& file);

}  // namespace droplet

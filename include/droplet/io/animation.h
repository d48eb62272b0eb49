// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>

#include "droplet/io/gltf.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// What an animated glTF file holds beside the surfaces.
struct AnimationOptions {
    double frames_per_second = 24.0;  ///< > 0
    Material material = Material::Water;
    bool closed = true;                      ///< as in GltfOptions
    std::optional<std::size_t> frames = {};  ///< how many are to come, where that is known: too large a file is then
                                             ///< refused with the first

    /// @throws Error InvalidArgument
    void validate() const;
};

/// An animated GLB on its way: takes one surface after another, keeps what the file will hold of them, and is written
/// in the end.
///
/// A node with a mesh for every run of frames that share their triangles. Within a run frames are morph targets whose
/// weights are animated LINEAR, so that between frames vertices move; runs longer than 64 frames go on in another node,
/// which begins with the frame that the one before ends with, so nothing jumps there. Which run is shown, is animated
/// by scale, STEP, 1 or 0, for all viewers can do that. The last frame is shown for as long as all others, then the
/// animation may begin again. In frames without a surface no run is shown. Without an animation, the first surface is.
/// Texture coordinates are those of a run's first frame; contact angles are left out.
class Animation {
public:
    /// @throws Error InvalidArgument
    explicit Animation(const AnimationOptions& options);
    ~Animation();
    Animation(Animation&&) noexcept;
    Animation& operator=(Animation&&) noexcept;

    /// @param surface    valid
    /// @param continues  it is the surface before with its vertices moved: as many, and the same triangles
    /// @throws Error     InvalidArgument: an invalid surface, one that does not continue the one before, or the file
    ///                   would reach 2 GiB
    void add(const Surface& surface, bool continues);

    /// A frame in which nothing is shown.
    void addDry();

    /// Guarantees: the same frames give the same bytes; the stream is left failed if it did not take everything.
    /// @return       bytes handed to the stream
    /// @throws Error InvalidArgument if no frame has a surface
    std::uint64_t write(std::ostream& out) const;

private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace droplet

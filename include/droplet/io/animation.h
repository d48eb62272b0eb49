// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>

#include "droplet/scene/format.h"
#include "droplet/surface/material.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// Options of an animation.
struct AnimationOptions {
    double frames_per_second = 24.0;         ///< > 0
    Material material = Material::Water;     ///< of the liquid
    bool closed = true;                      ///< as in GltfOptions
    std::optional<std::size_t> frames = {};  ///< expected number of frames, if known: a file that would be too large
                                             ///< is then refused at its first surface

    /// @throws Error InvalidArgument
    void validate() const;
};

/// Builder of an animated file, glTF or USD: collects surfaces frame by frame and writes the file at the end.
///
/// Each run of frames with the same triangles becomes one node with one mesh. The frames of a run are morph targets
/// with LINEAR weights, so vertices move between frames. A run of more than 64 frames continues in another node; its
/// first frame is the last one of the node before, so nothing jumps. The scale of a node, 1 or 0 with STEP, shows or
/// hides its run; all viewers support that. The last frame is shown as long as the others; then the animation may
/// repeat. Frames without a surface show no run. Viewers that do not play animations show the first surface.
/// Texture coordinates are those of a run's first frame; contact angles are left out. USD has time samples of points
/// and normals in place of morph targets.
class Animation {
public:
    /// An animation without frames.
    /// @throws Error InvalidArgument
    explicit Animation(const AnimationOptions& options);
    ~Animation();
    Animation(Animation&&) noexcept;             ///< leaves the other one unusable
    Animation& operator=(Animation&&) noexcept;  ///< leaves the other one unusable

    /// Adds a frame.
    /// @param surface    valid
    /// @param continues  the surface has as many vertices and the same triangles as the one before
    /// @throws Error     InvalidArgument: the surface is invalid or does not continue the one before, or the file would
    ///                   reach 2 GiB
    void add(const Surface& surface, bool continues);

    /// Adds a frame without liquid.
    void addDry();

    /// Writes the file. Frames may be added afterwards.
    ///
    /// Guarantees: the same frames give the same bytes; the stream is left failed if it did not take everything.
    /// @param out    takes the bytes
    /// @param file   form; by default GLB
    /// @return       bytes handed to the stream
    /// @throws Error InvalidArgument if no frame has a surface, or the form does not exist
    std::uint64_t write(std::ostream& out, const AnimatedFile& file = {});

private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace droplet

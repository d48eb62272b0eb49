// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <vector>

#include "droplet/liquid2d/particle_frame.h"

namespace droplet {

/// Particles over time in one USD file, for Houdini, Blender and others: a prim `liquid` of the type Points, whose
/// places, velocities and ids have a sample for every frame, and whose width is the spacing of the particles. Ids tell
/// which points are the same, for their order and number change.
class ParticleUsda {
public:
    /// @param frames_per_second  > 0
    /// @throws Error             InvalidArgument
    explicit ParticleUsda(double frames_per_second);

    /// Adds the next frame: 20 bytes for a particle are kept, 24 with densities.
    /// @param frame   valid
    /// @throws Error  InvalidArgument if a number does not fit into a float
    void add(const ParticleFrame& frame);

    /// Writes the file of all frames so far; lengths are in metres, time codes count the frames from 0.
    /// Guarantees: the same frames give the same bytes; the stream is left failed if it did not take everything.
    /// @param out  takes the bytes
    void write(std::ostream& out) const;

private:
    using Pair = std::array<float, 2>;
    struct Frame {
        std::vector<Pair> position;
        std::vector<Pair> velocity;
        std::vector<std::uint32_t> id;
        std::vector<float> density;
    };

    double frames_per_second_;
    double spacing_ = 0.0;
    std::vector<Frame> frames_;
};

}  // namespace droplet

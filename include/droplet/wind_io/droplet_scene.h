// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>

#include "droplet/surface/material.h"
#include "droplet/windshield/glass.h"
#include "droplet/windshield/running_shape.h"
#include "droplet/windshield/windshield.h"

namespace droplet {

struct DropletSceneOptions {
    double frames_per_second = 30.0;  ///< > 0
    Material material = Material::Water;
    ShapeOptions shape = {};  ///< of droplets

    /// @throws Error InvalidArgument
    void validate() const;
};

/// An animated GLB of droplets on their way over a windshield: takes one state after another, keeps what the file will
/// hold of them, and is written in the end.
///
/// One mesh of a droplet at rest, a cap of contact radius 1 m, and a node with it for every droplet that may run,
/// called by its id. Nodes have translation and rotation, LINEAR, and scale, STEP: it is 0 before a droplet is born and
/// after it has gone. One that runs is lengthened along its way by λ and made narrower and lower by √λ, which keeps its
/// volume; λ^1.5 is the capsule's length over its width (RunningShape). A droplet's keys stand only where
/// something changes, and only what changes of it is animated. Still droplets are left out: they are a map's
/// (glassMaps). The glass is there, too, as a node `glass`. Metres, +Y up, +Z ahead,
/// as glTF has an object's front and Glass reads one.
class DropletScene {
public:
    /// @throws Error InvalidArgument
    DropletScene(const Glass& glass, const DropletSceneOptions& options = {});
    ~DropletScene();
    DropletScene(DropletScene&&) noexcept;
    DropletScene& operator=(DropletScene&&) noexcept;

    /// The next frame.
    /// @throws Error InvalidArgument: the file would reach 128 MiB
    void add(const WindshieldState& state);

    /// Guarantees: the same frames give the same bytes; the stream is left failed if it did not take everything.
    /// @return       bytes handed to the stream
    /// @throws Error InvalidArgument if there is no frame
    std::uint64_t write(std::ostream& out) const;

private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace droplet

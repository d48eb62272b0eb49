// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "droplet/body/droplet_body.h"
#include "droplet/flow/flow.h"
#include "droplet/flow_io/flow_object.h"
#include "droplet/picture/picture.h"
#include "droplet/picture/render.h"
#include "droplet/units.h"
#include "droplet/vector.h"

namespace droplet {

/// Options of FlowView.
struct FlowPictureOptions {
    RenderOptions render;                          ///< size, camera, look of the liquid, light; the view sets the rest
    Vec3 gravity = {0.0, 0.0, -kStandardGravity};  ///< in the object's frame [m/s²]
};

/// Pictures of an object and the droplets on it, ray-traced with refraction, shadows and the light that droplets
/// gather. All pictures of a view have the same frame: the object's box and a twentieth of its size around it. Droplets
/// beyond are not shown.
class FlowView {
public:
    /// Makes a view.
    /// @param object  that the droplets run over
    /// @param bodies  shapes of the droplets; must outlive the view
    FlowView(const FlowObject& object, const DropletBodies& bodies);

    /// Draws one picture.
    ///
    /// Guarantees: the same bytes for the same arguments, with any number of threads.
    /// @param samples  droplets in the object's frame
    /// @param options  size, camera, look, gravity
    /// @throws Error   InvalidArgument if an option is out of its range
    [[nodiscard]] Picture draw(std::span<const FlowSample> samples, const FlowPictureOptions& options) const;

private:
    const DropletBodies& bodies_;
    TexturedMesh stand_;
    ViewBox box_;
};

}  // namespace droplet

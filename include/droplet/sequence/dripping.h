// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/sequence/sequence.h"

namespace droplet {

/// Liquid that flows into droplets under a level ceiling, until drops fall off them.
struct DrippingOptions {
    double inflow = 5e-8;     ///< into all droplets together, in proportion to their footprints, > 0 [m³/s]
    double time_step = 0.04;  ///< from frame to frame, > 0 [s]
    double way = 0.02;        ///< way down after which a drop is left out, > 0 [m]

    /// @throws Error InvalidArgument
    void validate() const;
};

/// Share of a droplet that falls when it hangs as heavy as it can; the rest stays.
///
/// A disc from which as much can hang sheds what W. D. Harkins and F. E. Brown measured at tips of its radius r:
/// Tate's 2πrσ/ρg times their fraction.
/// @param largest           largest volume that hangs from the footprint, > 0 [m³]
/// @param capillary_length  √(σ/ρg), > 0 [m]
/// @return                  from 0.59 to 0.99
double fallingShare(double largest, double capillary_length);

/// Makes the next frame of droplets into which liquid flows, with the footprints of the frame before.
///
/// A droplet that reaches the largest volume that hangs from its footprint sheds a drop at that time, within the step:
/// fallingShare() of its volume. The drop is a ball that falls freely from rest: first its lowest place is where that
/// of the droplet was, or its highest is below what stays, whichever is lower. The neck breaks within milliseconds, and
/// is not shown. What stays goes on growing.
///
/// Guarantees: volumes of droplets and of Frame::falling together are those of the frame before − lost + gained, to
/// 1e-9; the meshes of drops enclose exactly their volumes; the surface has one part for each drop, after those of the
/// droplets.
/// @param before    made by firstFrame() or nextDripping()
/// @param outline   rims, the same ones
/// @param options   with VolumeMode::Track; hold has no effect
/// @param dripping  how much flows in, how long, and where drops leave the picture
/// @param progress  called at every stage; may be empty
/// @throws Error    as nextFrame(); InvalidArgument unless the plane is a level ceiling and the liquid has a weight;
///                  NoSuchDroplet if no volume is found that hangs
Frame nextDripping(const Frame& before, const Outline& outline, const SequenceOptions& options,
                   const DrippingOptions& dripping, const Progress& progress = {});

}  // namespace droplet

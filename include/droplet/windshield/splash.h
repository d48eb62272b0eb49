// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "droplet/liquid.h"
#include "droplet/vector.h"

namespace droplet {

/// Raindrop that has just hit the glass so hard that it splashes: for some milliseconds its water is a ring. The water
/// balance has it in a droplet from the impact on; the ring is how that droplet looks.
struct Splash {
    Vec2 position;          ///< where it hit, on the unrolled glass (Glass) [m]
    double time = 0.0;      ///< when it hit [s]
    double diameter = 0.0;  ///< of the raindrop [m], > 0
    double speed = 0.0;     ///< of the raindrop, perpendicular to the glass [m/s], > 0
    double radius = 0.0;    ///< largest radius of the ring [m]
    double lifetime = 0.0;  ///< time from the impact until the ring is gone [s]

    friend bool operator==(const Splash&, const Splash&) = default;  ///< Compares all members.
};

/// Ring of a splash at a moment.
struct SplashRing {
    double radius = 0.0;      ///< of the middle of its rim [m]
    double half_width = 0.0;  ///< of its rim, whose section is a half disc [m]
    double age = 0.0;         ///< share of its lifetime, 0 … 1
    int knots = 0;            ///< number of places around the rim in which its water gathers
};

/// Splash of a raindrop; empty if it hits too gently to splash.
///
/// The number K = We^(1/2) Re^(1/4), of diameter and normal speed, must be at least 57.7 (C. Mundo, M. Sommerfeld, C.
/// Tropea, "Droplet-wall collisions: experimental studies of the deformation and breakup process", Int. J. Multiphase
/// Flow 21 (1995) 151); Re has the viscosity of water at 20 °C. The ring spreads to the radius D We^(1/4)/2 (C. Clanet,
/// C. Béguin, D. Richard, D. Quéré, "Maximal deformation of an impacting drop", J. Fluid Mech. 517 (2004) 199). Its
/// lifetime is 2.6 √(ρ (D/2)³/γ), after which a drop has drawn itself together again (D. Richard, C. Clanet, D. Quéré,
/// "Contact time of a bouncing drop", Nature 417 (2002) 811).
/// @param diameter  of the raindrop [m], > 0
/// @param speed     perpendicular to the glass [m/s], ≥ 0
/// @param liquid    its density and surface tension
/// @return          without position and time
std::optional<Splash> splashOf(double diameter, double speed, const Liquid& liquid);

/// Ring of a splash; empty before the impact and after its lifetime.
///
/// Its radius grows as C (U D t)^(1/2), C = 1.1 (A. L. Yarin, D. A. Weiss, "Impact of drops on solid surfaces:
/// self-similar capillary waves, and splashing as a new type of kinematic discontinuity", J. Fluid Mech. 283 (1995)
/// 141: C = (2 D/(3 h))^(1/4), here for a film of the thickness h = 0.45 D), up to its largest. Then it recoils to the
/// raindrop's radius with a constant speed. The rim holds the raindrop's water. Its knots are 9.02
/// half widths apart at its largest radius, the wavelength that grows fastest on a cylinder of liquid (Lord Rayleigh,
/// "On the instability of jets", Proc. London Math. Soc. 10 (1878) 4).
/// @param splash  made by splashOf
/// @param time    [s]
std::optional<SplashRing> ringOf(const Splash& splash, double time);

}  // namespace droplet

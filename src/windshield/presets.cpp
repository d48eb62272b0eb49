// SPDX-License-Identifier: GPL-3.0-or-later
//
// The thesis, figures 3.10 to 3.12 and section 3.2.3. It gives wind, hysteresis and glass, but not δ, C_D or the rain.
// δ/C_D follows from the measured still band of figure 3.3 (wind/forces.h), with C_D = 1. This layer is thicker than
// the height of any droplet: "thick", as figure 3.12 says. Then a wind of 10.2 m/s cancels gravity on a slope of 45°.
//
//     11.3 m/s   the wind exceeds gravity by g sin 45° · 0.23: hysteresis 0.5 holds droplets below 8 mm across,
//                0.05 those below 3 mm
//     15 m/s     the wind exceeds gravity by g sin 45° · 1.2: hysteresis 0.5 holds droplets below 4 mm
#include "droplet/windshield/presets.h"

#include "entry_named.h"

namespace droplet {
namespace {

WindshieldPreset figure(const char* name, const char* description, double wind, double hysteresis)
{
    WindshieldPreset preset;
    preset.name = name;
    preset.description = description;
    WindshieldParameters& p = preset.parameters;
    p.forces = forcePresetNamed("thesis").model;
    p.forces.wetting.contact_angle = 90.0 * kDegree;  // hemispheres (3.1)
    p.forces.wetting.hysteresis = hysteresis;
    p.vehicle = constantSpeed(wind);
    return preset;
}

}  // namespace

const std::vector<WindshieldPreset>& windshieldPresets()
{
    static const std::vector<WindshieldPreset> presets{
        figure("figure-3.10", "11.3 m/s, hysteresis 0.5: the droplets do not move at all", 11.3, 0.5),
        figure("figure-3.11", "11.3 m/s, hysteresis 0.05: they move along the windshield's curve", 11.3, 0.05),
        figure("figure-3.12", "15 m/s, hysteresis 0.5: the large ones climb straight up, the small ones stay", 15.0,
               0.5)};
    return presets;
}

const WindshieldPreset& windshieldPresetNamed(std::string_view name)
{
    return entryNamed(windshieldPresets(), name, "preset");
}

}  // namespace droplet

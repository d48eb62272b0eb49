// SPDX-License-Identifier: GPL-3.0-or-later
// P. Fournier, A. Habibi, P. Poulin, "Simulating the flow of liquid droplets", Graphics Interface 1998, section 5. The
// paper gives ratios, no units: lengths, friction and adhesion are chosen so that what it describes is seen.
#include "droplet/flow_io/flow_presets.h"

#include <cmath>
#include <numbers>
#include <string>

#include "droplet/units.h"
#include "entry_named.h"

namespace droplet {
namespace {

constexpr double kHold = 1e6;  // adhesion without end [Pa]

/// A preset of the paper. The camera looks from the front.
FlowPreset ofPaper(const char* name, const char* description, PresetObject object, double friction)
{
    FlowPreset preset;
    preset.name = name;
    preset.description = description;
    preset.object = object;
    preset.parameters.model = FlowModel::Paper;
    preset.parameters.forces.wetting.contact_angle = 90.0 * kDegree;  // hemispheres (figure 1)
    preset.parameters.friction = friction;
    preset.parameters.adhesion = kHold;
    preset.camera = {-90.0 * kDegree, 45.0 * kDegree};
    return preset;
}

/// A place on the slopes.
/// @param up  from their lower edge [m]
Vec3 onSlope(double x, double up)
{
    constexpr double kSlope = 30.0 * kDegree;
    const double along = up - 0.15;
    return {x, along * std::cos(kSlope), along * std::sin(kSlope)};
}

FlowPreset masses()
{
    FlowPreset preset =
        ofPaper("masses", "droplets of 1 to 4 masses on a slope: heavy ones are faster and take up others",
                PresetObject::Slope, 9e-3);
    // Rows of light droplets below, heavier ones above; neighbours are a little aside.
    for (int row = 0; row < 3; ++row) {
        for (int k = 0; k < 8; ++k) {
            const double mass = 1.0 + (3 * row + 5 * k) % 4;
            const double x = -0.126 + 0.036 * k + 0.002 * ((row + k) % 3 - 1);
            preset.starts.push_back({onSlope(x, 0.2 + 0.04 * row), mass * 60e-9, {}});
        }
    }
    preset.duration = 2.5;
    return preset;
}

FlowPreset viscosities()
{
    FlowPreset preset =
        ofPaper("viscosities", "three slopes with viscous friction 1, 10 and 100", PresetObject::Slopes, 4e-3);
    preset.materials = {{"left", {{}, 1.0, {}}}, {"middle", {{}, 10.0, {}}}, {"right", {{}, 100.0, {}}}};
    for (const double left : {-0.16, -0.05, 0.06}) {
        for (int k = 0; k < 3; ++k) {
            preset.starts.push_back({onSlope(left + 0.02 + 0.03 * k, 0.28 - 0.02 * (k % 2)), 90e-9, {}});
        }
    }
    preset.duration = 2.2;
    return preset;
}

FlowPreset adhesions()
{
    FlowPreset preset = ofPaper("adhesions", "equal droplets on a sphere: stronger adhesion lets them go farther below",
                                PresetObject::Sphere, 1e-3);
    preset.parameters.adhesion = 5.0;
    preset.parameters.merges = false;
    constexpr int kCount = 24;
    for (int k = 0; k < kCount; ++k) {
        const double turn = 2.0 * std::numbers::pi * (k + 0.25) / kCount;
        const double tilt = 25.0 * kDegree;
        preset.starts.push_back(
            {0.1 * Vec3{std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)}, 30e-9, {}});
    }
    preset.duration = 0.7;
    preset.camera.elevation = 5.0 * kDegree;
    return preset;
}

FlowPreset roughnesses()
{
    FlowPreset preset =
        ofPaper("roughnesses", "rougher slopes from left to right: small droplets barely move, but run on streaks",
                PresetObject::Slopes, 4e-3);
    preset.materials = {{"left", {0.7e-3, {}, {}}}, {"middle", {1.7e-3, {}, {}}}, {"right", {2.75e-3, {}, {}}}};
    for (const double left : {-0.16, -0.05, 0.06}) {
        preset.starts.push_back({onSlope(left + 0.02, 0.27), 60e-9, {}});  // 3.1 mm high
        preset.starts.push_back({onSlope(left + 0.045, 0.27), 180e-9, {}});
        // The lower one leaves a streak; the upper one reaches it, runs faster and merges with the lower one.
        preset.starts.push_back({onSlope(left + 0.075, 0.29), 150e-9, {}});
        preset.starts.push_back({onSlope(left + 0.075, 0.20), 110e-9, {}});
    }
    preset.duration = 1.6;
    return preset;
}

FlowPreset tear()
{
    FlowPreset preset =
        ofPaper("tear", "a tear rolls down a mask and falls off below the chin", PresetObject::Mask, 3e-3);
    preset.parameters.adhesion = 11.0;
    preset.starts = {{{0.032, -0.0645, 0.006}, 25e-9, {}}};
    preset.duration = 2.0;
    preset.camera = {-65.0 * kDegree, 8.0 * kDegree};
    return preset;
}

FlowPreset forces()
{
    FlowPreset preset =
        ofPaper("forces", "a plate rocks: the force on a droplet that stays turns to one side and to the other",
                PresetObject::Plate, 1e-3);
    preset.parameters.roughness = 0.1;  // it stays
    preset.starts = {{{0.0, 0.0, 0.0}, 150e-9, {}}};
    preset.duration = 4.0;
    constexpr double kTilt = 50.0 * kDegree;
    constexpr int kKeys = 96;
    for (int k = 0; k <= kKeys; ++k) {
        const double turns = static_cast<double>(k) / kKeys;
        const double tilt = kTilt * std::sin(2.0 * std::numbers::pi * turns);
        preset.parameters.motion.keys.push_back(
            {preset.duration * turns, {{}, {0.0, std::sin(0.5 * tilt), 0.0}, std::cos(0.5 * tilt)}});
    }
    preset.camera = {-90.0 * kDegree, 12.0 * kDegree};
    return preset;
}

FlowPreset bottle()
{
    FlowPreset preset;
    preset.name = "bottle";
    preset.description = "a cold bottle sweats, in time lapse: dew grows, drops run and wipe their tracks";
    preset.object = PresetObject::Bottle;
    FlowParameters& p = preset.parameters;
    p.forces.wetting.contact_angle = 80.0 * kDegree;
    p.forces.wetting.hysteresis = 0.25;
    p.condensation = FlowCondensation{50e-6, 2.5e-3};
    p.drying = 1.5;  // dew covers the tracks again
    p.step = 1.0 / 60.0;
    preset.duration = 10.0;
    preset.camera = {-70.0 * kDegree, 8.0 * kDegree};
    return preset;
}

FlowPreset leaf()
{
    FlowPreset preset;
    preset.name = "leaf";
    preset.description = "rain on a leaf: droplets gather in its valley and fall from tip and margin";
    preset.object = PresetObject::Leaf;
    FlowParameters& p = preset.parameters;
    p.forces.wetting.hysteresis = 0.15;
    p.rain = FlowRain{150.0 * kMillimetrePerHour, {0.0, 0.0, 1.0}, {}, 1e-3};
    preset.duration = 8.0;
    preset.camera = {-50.0 * kDegree, 35.0 * kDegree};
    return preset;
}

FlowPreset car()
{
    FlowPreset preset;
    preset.name = "car";
    preset.description = "rain and wind of 25 m/s on a model car: droplets climb the bonnet and the windshield";
    preset.object = PresetObject::Car;
    FlowParameters& p = preset.parameters;
    p.wind = {0.0, 25.0, 0.0};
    p.forces.wetting.contact_angle = 90.0 * kDegree;
    p.rain = FlowRain{100.0 * kMillimetrePerHour, {0.0, -0.6, 1.0}, {}, 1e-3};
    preset.duration = 4.0;
    preset.camera = {-50.0 * kDegree, 25.0 * kDegree};
    return preset;
}

FlowPreset window()
{
    FlowPreset preset;
    preset.name = "window";
    preset.description = "rain on a window: drops stick, run and leave tails that break up to beads";
    preset.object = PresetObject::Window;
    FlowParameters& p = preset.parameters;
    p.forces.wetting.contact_angle = 75.0 * kDegree;  // of glass that is not new
    p.forces.wetting.hysteresis = 0.3;
    p.rain = FlowRain{60.0 * kMillimetrePerHour, {0.0, -1.0, 0.5}, {}, 0.5e-3};
    p.streaks = {30e-6, 6e-3};
    preset.duration = 8.0;
    preset.camera = {-90.0 * kDegree, 5.0 * kDegree};
    return preset;
}

}  // namespace

const std::vector<FlowPreset>& flowPresets()
{
    static const std::vector<FlowPreset> presets{masses(), viscosities(), adhesions(), roughnesses(), tear(),
                                                 forces(), bottle(),      leaf(),      car(),         window()};
    return presets;
}

const FlowPreset& flowPresetNamed(std::string_view name)
{
    return entryNamed(flowPresets(), name, "preset");
}

}  // namespace droplet

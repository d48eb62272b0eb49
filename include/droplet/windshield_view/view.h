// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "droplet/body/droplet_body.h"
#include "droplet/body/running_shape.h"
#include "droplet/drawing/picture.h"
#include "droplet/render/environment.h"
#include "droplet/units.h"
#include "droplet/vector.h"
#include "droplet/wind/forces.h"
#include "droplet/windshield/glass.h"
#include "droplet/windshield/windshield.h"
#include "droplet/windshield/wipers.h"

namespace droplet {

/// Options of the driver's view; defaults as in the thesis, section 3.2.3.
struct ViewOptions {
    int width = 1280;                     ///< width of the frame [px], 16 … 8192
    int height = 720;                     ///< height of the frame [px], 16 … 8192
    double field_of_view = 45 * kDegree;  ///< horizontal angle [rad], 1° … 150°
    double eye_distance = 0.5;            ///< distance of the eye from the glass, straight ahead [m], 0.01 … 100
    std::optional<Vec2> aim = {};         ///< reference place on the glass [m]; empty: its middle
    /// Position of the eye relative to `aim`: right, ahead, up; behind the glass [m]. Empty: eye_distance behind `aim`.
    std::optional<Vec3> eye = {};
    /// Point in the middle of the frame, relative to `aim`; in front of the eye [m]. Empty: straight ahead.
    std::optional<Vec3> look_at = {};
    BodyShape body = BodyShape::Capsule;  ///< shape of running droplets: Capsule or Capillary
    ShapeOptions shape = {};              ///< shape of droplets at rest, and of capsules
    ForceModel forces = {};               ///< liquid, contact angle and friction, which shape capillary droplets
    double ior = 1.333;     ///< index of refraction; water at 20 °C in yellow light (Lide, CRC Handbook); 1 … 2
    int samples = 2;        ///< rays per pixel and droplet, across and down; 1 … 4
    double exposure = 0.0;  ///< exposure of the whole frame [stops]: 1 doubles the light; −8 … 8
    /// Extra brightness of clipped lamps: the brightest pixels of the picture count as up to 1 + this times as bright,
    /// in their own hue; 0 … 4. Empty: 3 if few pixels are bright (night), less if more are, down to 0 (day).
    std::optional<double> highlight_boost = {};
    /// Blur of the distant background while the eye looks at the droplets: diameter of the disc that a point of light
    /// becomes [rad], 0 … 20°. A lens of aperture a, focused at distance b, has a/b. Droplets stay sharp, and so does
    /// what they show: there the background and its blur are far smaller.
    double background_blur = 0.0;
    /// Time that the shutter is open, half before and half after the state's time [s], 0 … 1. Moving droplets are
    /// blurred along their way.
    double shutter_time = 0.0;
    /// Visible wipers, with the water that they push and leave. Empty: wipers are invisible.
    std::vector<Wiper> wipers = {};
    Vec3 glass_colour{0.97, 0.985, 0.98};  ///< transmittance of the pane for red, green and blue; 0 … 1

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// Generated background: a road on a wet evening, out of focus. Objects come nearer as the car travels; constant parts
/// are painted once.
///
/// Guarantees: the same arguments give the same bytes with any number of threads; the pictures have the frame's size.
class DefaultBackground {
public:
    /// Paints the constant parts.
    /// @throws Error InvalidArgument if an option is out of its range
    explicit DefaultBackground(const ViewOptions& options);
    ~DefaultBackground();
    DefaultBackground(DefaultBackground&&) noexcept;             ///< Moves the content.
    DefaultBackground& operator=(DefaultBackground&&) noexcept;  ///< Moves the content.

    /// Picture at one place of the road.
    /// @param travelled  distance that the car has travelled [m], finite
    /// @param passed     distance while the shutter is open, half before and half after that [m], 0 … 100
    /// @throws Error     InvalidArgument if an argument is out of its range
    [[nodiscard]] Picture at(double travelled, double passed = 0.0) const;

private:
    struct Content;
    std::unique_ptr<const Content> content_;
};

/// One picture of DefaultBackground.
/// @throws Error  InvalidArgument if an argument is out of its range
Picture defaultBackground(const ViewOptions& options, double travelled = 0.0);

/// The driver's view: an eye behind the glass, and a background so distant that only the direction of a ray counts.
///
/// Rays of the eye pass the pane, which does not turn them, and the water on it, and are refracted where they leave it
/// (Snell, Fresnel). Where a droplet of more than 90° overhangs its contact, the air below it is ignored. Running
/// droplets are capsules (RunningShape) with exact intersections, or capillary bodies (DropletBodies). Still droplets
/// are one map of the glass with the normals of caps, in which only cells that changed are drawn again. Where running
/// droplets have swept it, the glass is bare: the Lotus tracks. Rings of splashes are flat inside, where they hide
/// droplets at rest. Rays that lead back inside, by total reflection, are as dark as a cabin.
///
/// The picture fills the frame: it is the view through dry glass. Refracted rays go far beyond it. Beyond its edge, at
/// the tangent s₀, a direction with the tangent s shows the point of s₀²/s: the picture is mirrored at its edge, with
/// the same scale there, and at a right angle its middle appears again. surround() replaces this mirror.
///
/// Guarantees: the frame depends on the last state and picture alone, if all states are of one run; the same arguments
/// give the same bytes with any number of threads. No argument is kept by reference.
class DriversView {
public:
    /// Makes a view without picture and water.
    /// @throws Error InvalidArgument if an option is out of its range or the eye sees nothing of the glass
    DriversView(const Glass& glass, const ViewOptions& options = {});
    ~DriversView();
    DriversView(DriversView&&) noexcept;             ///< Moves the content.
    DriversView& operator=(DriversView&&) noexcept;  ///< Moves the content.

    /// Sets the picture behind the glass; black before the first call.
    /// @param picture  valid, with the size of the frame: see covering()
    /// @throws Error   InvalidArgument if the size differs
    void setBackground(const Picture& picture);

    /// Sets the panorama around the car, its middle straight ahead. Rays beyond the picture's edges show it; so does
    /// the whole frame before the first setBackground(). Light is used as it is: 1 is white. Call show() again
    /// afterwards.
    /// @throws Error  InvalidArgument if the panorama is not valid
    void setEnvironment(const Environment& environment);

    /// Sets the water on the glass; none before the first call.
    /// @param state  state on this glass
    void show(const WindshieldState& state);

    /// Picture behind the glass, through the dry pane.
    [[nodiscard]] const Picture& bare() const;
    /// Droplets alone: what they show of the picture, and how much of it they hide.
    [[nodiscard]] Layer layer() const;
    /// Complete frame: over(layer(), bare()). With an shutter_time it is the mean of the light during that time;
    /// blurred edges are then brighter than in a mix of the layers' levels.
    [[nodiscard]] Picture frame() const;

    /// Position on the glass at the middle of a pixel [m]; empty beside the glass.
    [[nodiscard]] std::optional<Vec2> onGlass(int x, int y) const;
    /// Number of cells of still droplets that have been drawn into the map so far.
    [[nodiscard]] std::size_t cellsDrawn() const;

private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace droplet

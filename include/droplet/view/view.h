// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "droplet/picture/environment.h"
#include "droplet/picture/picture.h"
#include "droplet/units.h"
#include "droplet/vector.h"
#include "droplet/windshield/glass.h"
#include "droplet/windshield/running_shape.h"
#include "droplet/windshield/windshield.h"
#include "droplet/windshield/wipers.h"

namespace droplet {

/// How the driver looks through the glass; defaults as in the thesis, section 3.2.3.
struct ViewOptions {
    int width = 1280;                     ///< [px] 16 … 8192
    int height = 720;                     ///< [px] 16 … 8192
    double field_of_view = 45 * kDegree;  ///< of the width [rad], 1° … 150°
    double eye_distance = 0.5;            ///< from the glass, straight ahead [m], 0.01 … 100
    std::optional<Vec2> aim = {};         ///< place on the glass that is straight ahead [m]; empty: its middle
    /// The eye, from that place: to the right, ahead and up; behind the glass [m]. Empty: eye_distance behind it.
    std::optional<Vec3> eye = {};
    /// What the middle of the frame shows, from that place, in the eye's front. Empty: what is straight ahead.
    std::optional<Vec3> look_at = {};
    ShapeOptions shape = {};  ///< of droplets
    double ior = 1.333;       ///< of water at 20 °C, in yellow light (Lide, CRC Handbook); 1 … 2
    int samples = 2;          ///< rays a pixel and droplet, across and down; 1 … 4
    double exposure = 0.0;    ///< of all that is seen, in stops: 1 is twice the light; −8 … 8
    /// Lamps saturate a picture: its brightest pixels are taken for up to 1 + this times as bright, in their own hue;
    /// 0 … 4. Empty: 3 where few are bright, as by night, and less the more are, down to 0 by day.
    std::optional<double> highlight_boost = {};
    /// Blur of what is behind the glass, which is far away, while the eye looks at the droplets: the disc that a point
    /// of light becomes is so wide [rad], 0 … 20°. A lens whose aperture is a wide and that is focused at b spreads it
    /// over a/b. Droplets stay sharp, and so does what they show: it is far smaller there, and its blur with it.
    double background_blur = 0.0;
    /// How long the shutter is open for a frame, half of it before the state's time and half after it [s], 0 … 1; 0:
    /// for an instant. Droplets that move are blurred along their way; what is at rest stays sharp.
    double open_time = 0.0;
    /// Wipers that are seen, with the water that they push and leave; by a state's time. Empty: they wipe unseen.
    std::vector<Wiper> wipers = {};
    Vec3 glass_colour{0.97, 0.985, 0.98};  ///< share of light that the pane lets through, of each colour; 0 … 1

    /// @throws Error InvalidArgument
    void validate() const;
};

/// What is behind the glass where nobody brings a picture: a made-up road on a wet evening, out of focus. What stands
/// still comes nearer as the car travels. What looks the same wherever the car is, is painted once.
///
/// Guarantees: the same bytes from the same arguments, at any number of threads; as large as the frame.
class DefaultBackground {
public:
    /// @throws Error InvalidArgument
    explicit DefaultBackground(const ViewOptions& options);
    ~DefaultBackground();
    DefaultBackground(DefaultBackground&&) noexcept;
    DefaultBackground& operator=(DefaultBackground&&) noexcept;

    /// @param travelled  how far the car has come [m], finite
    /// @param passed     how far it comes while the shutter is open, half before and half after it [m], 0 … 100
    /// @throws Error     InvalidArgument
    [[nodiscard]] Picture at(double travelled, double passed = 0.0) const;

private:
    struct Content;
    std::unique_ptr<const Content> content_;
};

/// One picture of DefaultBackground.
/// @throws Error  InvalidArgument
Picture defaultBackground(const ViewOptions& options, double travelled = 0.0);

/// What the driver sees: an eye behind the glass, which looks straight ahead or elsewhere, and a picture so far away
/// that only the direction of a ray tells what is seen of it.
///
/// The eye's rays pass the pane, a plate that does not turn them, and the water on it, and are refracted where they
/// leave it (Snell, Fresnel); where a droplet overhangs its contact, as beyond 90°, the air below it is passed over.
/// Droplets that can run are capsules (RunningShape), met exactly; still droplets are one map of the glass that holds
/// normals of caps, kept up with the state: only cells that changed are drawn anew. Where running droplets have swept
/// it, it is bare: the Lotus tracks. What leads back inside, by total reflection, is as dark as a cabin is.
///
/// The picture fills the frame: it is what is seen through dry glass. Refracted rays go far beyond it: past its edge,
/// at the tangent s₀, a direction of tangent s shows what s₀²/s does. So the picture is mirrored at its edge, as large
/// there as before it, and at a right angle its middle is seen again. Surroundings take the place of that mirror.
///
/// Guarantees: what is seen depends on the state and the picture alone, not on those before, as long as all states are
/// of one run: the same bytes, at any number of threads. Nothing of what is given is kept by reference.
class DriversView {
public:
    /// @throws Error InvalidArgument, also where the eye sees nothing of the glass
    DriversView(const Glass& glass, const ViewOptions& options = {});
    ~DriversView();
    DriversView(DriversView&&) noexcept;
    DriversView& operator=(DriversView&&) noexcept;

    /// What is behind the glass from now on; black before.
    /// @param picture  valid, as large as the frame: see covering
    /// @throws Error   InvalidArgument
    void lookAt(const Picture& picture);

    /// What is around the car from now on, its middle straight ahead: rays that end beyond the picture's edges meet it,
    /// and until there is a picture, all of them do, and so does the frame. Light is taken as it is: 1 is white. Water
    /// has to be shown again.
    /// @throws Error  InvalidArgument
    void surround(const Environment& environment);

    /// The water that is on the glass from now on; none before.
    /// @param state  of this glass
    void show(const WindshieldState& state);

    /// The picture behind the glass, through the dry pane.
    [[nodiscard]] const Picture& bare() const;
    /// The droplets alone: what they show of the picture behind, and how much they hide of it.
    [[nodiscard]] Layer layer() const;
    /// All that the driver sees: over(layer(), bare()), in one go. With an open_time it is the mean of the light that
    /// is seen in that time, which is brighter at blurred edges than layers mixed by levels are.
    [[nodiscard]] Picture frame() const;

    /// Where on the glass the middle of a pixel is seen [m]; empty beside the glass.
    [[nodiscard]] std::optional<Vec2> onGlass(int x, int y) const;
    /// How many cells of still droplets have been drawn into the map so far.
    [[nodiscard]] std::size_t cellsDrawn() const;

private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace droplet

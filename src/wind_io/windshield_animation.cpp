// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/wind_io/windshield_animation.h"

#include <algorithm>
#include <cmath>

#include "axes.h"
#include "box_corners.h"
#include "byte_stream.h"
#include "droplet/error.h"
#include "io/droplet_crowd.h"
#include "require.h"
#include "scene/write_scene.h"
#include "wind_io/droplet_meshes.h"
#include "wind_io/scene_files.h"

namespace droplet {
namespace {

/// Vector of the vehicle's frame, y ahead and z up, in the file's frame.
Vec3 inFile(Vec3 v)
{
    return yUp({0.0 - v.x, 0.0 - v.y, v.z});  // half a turn, so that the front is +Z after yUp()
}

/// @param last  pose in the frame before, or null
DropletPose poseOf(const RunningDroplet& droplet, const GlassPlace& place, const ShapeOptions& options,
                   const DropletPose* last)
{
    const double speed = length(droplet.velocity);
    const RunningShape rest = runningShape(droplet.volume, 0.0, options);
    const RunningShape shape = runningShape(droplet.volume, speed, options);
    const double longer = std::pow((shape.half_length + shape.contact_radius) / shape.contact_radius, 2.0 / 3.0);
    DropletPose pose;
    pose.moves = speed > 0.0;
    const Vec3 point = inFile(place.point);
    pose.place = {toFloat(point.x), toFloat(point.y), toFloat(point.z)};
    pose.along = toFloat(rest.contact_radius * longer);
    pose.across = toFloat(rest.contact_radius / std::sqrt(longer));
    pose.up = pose.across;
    if (speed == 0.0 && last != nullptr) {
        pose.turn = last->turn;  // a droplet at rest is rotationally symmetric
        return pose;
    }
    const Vec2 along = speed > 0.0 ? (1.0 / speed) * droplet.velocity : Vec2{1.0, 0.0};
    const Vec3 x = inFile(along.x * place.across + along.y * place.up);
    const Vec3 y = inFile(place.normal);
    // (across, up, normal) is left-handed; the rotation takes the motion, the normal and their cross product.
    pose.turn = turnTo(x, y, cross(x, y));
    return pose;
}

Scene sceneOfNodes(const DropletHistories& histories, const Glass& glass, const WindshieldAnimationOptions& options)
{
    const DropletMesh pane = glassMesh(glass);
    Scene scene;
    scene.frames_per_second = options.frames_per_second;
    CrowdOptions droplets;
    droplets.ground = addGlass(scene, pane);
    droplets.material = options.material;
    droplets.animation = "rain";
    droplets.corners = cornersOf(pane.vertices);
    droplets.corner = "corner of the glass";
    droplets.resting = capMesh(options.shape.contact_angle, {.around = 12, .rings = 3});
    droplets.running = capMesh(options.shape.contact_angle, {.around = 16, .rings = 5});
    addDroplets(histories, droplets, scene);
    return scene;
}

}  // namespace

struct WindshieldAnimation::Content {
    Glass glass;
    WindshieldAnimationOptions options;
    DropletHistories histories;

    void checkSize() const
    {
        if (options.animation == AnimationMethod::Texture) {
            checkTexture(histories.maxCount(), histories.frames());
            return;
        }
        checkCrowd(histories, 0, "less rain");
    }
};

void WindshieldAnimationOptions::validate() const
{
    require(frames_per_second > 0.0 && std::isfinite(frames_per_second), "frames_per_second", frames_per_second,
            "finite and more than 0");
    shape.validate();
}

WindshieldAnimation::WindshieldAnimation(const Glass& glass, const WindshieldAnimationOptions& options)
{
    options.validate();
    content_ = std::make_unique<Content>(Content{glass, options, DropletHistories()});
}

WindshieldAnimation::~WindshieldAnimation() = default;
WindshieldAnimation::WindshieldAnimation(WindshieldAnimation&&) noexcept = default;
WindshieldAnimation& WindshieldAnimation::operator=(WindshieldAnimation&&) noexcept = default;

void WindshieldAnimation::add(const WindshieldState& state)
{
    DropletHistories& histories = content_->histories;
    for (const RunningDroplet& droplet : state.droplets) {
        if (const auto place = content_->glass.place(droplet.position)) {
            histories.add(droplet.id, poseOf(droplet, *place, content_->options.shape, histories.last(droplet.id)));
        }
    }
    histories.endFrame();
    content_->checkSize();
}

std::uint64_t WindshieldAnimation::write(std::ostream& out, const AnimatedFile& file) const
{
    if (content_->histories.frames() == 0) {
        throw Error(ErrorCode::InvalidArgument, "a scene of droplets must have at least one frame");
    }
    const bool is_texture = content_->options.animation == AnimationMethod::Texture;
    const auto scene = is_texture ? sceneOfTexture : sceneOfNodes;
    return writeScene(scene(content_->histories, content_->glass, content_->options), out, file);
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/wind_io/droplet_scene.h"

#include <cmath>
#include <string>

#include "droplet/error.h"
#include "require.h"
#include "wind_io/scene_files.h"

namespace droplet {

struct DropletScene::Content {
    Glass glass;
    DropletSceneOptions options;
    DropletHistories histories;

    void checkSize() const
    {
        if (options.animation == SceneAnimation::Texture) {
            checkTexture(histories.maxCount(), histories.frames());
            return;
        }
        // Bytes of a joint's JSON and of a sample's keys. In memory the JSON takes about fifteen times as much.
        constexpr std::uint64_t kJoint = 800;
        constexpr std::uint64_t kSample = 10;
        constexpr std::uint64_t kMax = std::uint64_t{1} << 27;
        const std::uint64_t bytes = kSample * histories.samples() + kJoint * histories.maxCount();
        if (bytes >= kMax) {
            throw Error(
                ErrorCode::InvalidArgument,
                std::to_string(histories.frames()) + " frames of up to " + std::to_string(histories.maxCount()) +
                    " droplets would make a glTF file of about " + std::to_string(bytes) +
                    " bytes; it must be less than 128 MiB: use a shorter time, fewer frames per second or less rain");
        }
    }
};

void DropletSceneOptions::validate() const
{
    require(frames_per_second > 0.0 && std::isfinite(frames_per_second), "frames_per_second", frames_per_second,
            "finite and more than 0");
    shape.validate();
}

DropletScene::DropletScene(const Glass& glass, const DropletSceneOptions& options)
{
    options.validate();
    content_ = std::make_unique<Content>(Content{glass, options, DropletHistories(glass, options.shape)});
}

DropletScene::~DropletScene() = default;
DropletScene::DropletScene(DropletScene&&) noexcept = default;
DropletScene& DropletScene::operator=(DropletScene&&) noexcept = default;

void DropletScene::add(const WindshieldState& state)
{
    content_->histories.add(state);
    content_->checkSize();
}

std::uint64_t DropletScene::write(std::ostream& out) const
{
    if (content_->histories.frames() == 0) {
        throw Error(ErrorCode::InvalidArgument, "a scene of droplets must have at least one frame");
    }
    const auto write = content_->options.animation == SceneAnimation::Texture ? writeSceneOfTexture : writeSceneOfNodes;
    return write(content_->histories, content_->glass, content_->options, out);
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
// The layout of the texture: docs/formats.md, "Droplets in a texture".
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>

#include "droplet/drawing/picture.h"
#include "droplet/error.h"
#include "wind_io/droplet_meshes.h"
#include "wind_io/scene_files.h"

namespace droplet {
namespace {

/// Largest side of a texture that graphics processors of viewers support.
constexpr std::size_t kLargestSide = 8192;
constexpr std::size_t kTexels = 4;  ///< texels of a droplet in a frame
constexpr std::size_t kMaxColumns = kLargestSide / kTexels;

std::size_t blocksOf(std::size_t slots)
{
    return std::max<std::size_t>((slots + kMaxColumns - 1) / kMaxColumns, 1);
}

/// Range of numbers that are stored as integers.
struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void include(float number)
    {
        low = std::min(low, static_cast<double>(number));
        high = std::max(high, static_cast<double>(number));
    }
    /// The range, extended if it is empty or has no width.
    [[nodiscard]] Range widened() const
    {
        return low < high ? *this : low > high ? Range{1.0, 2.0} : Range{low, low + std::max(std::abs(low), 1e-3)};
    }
};

class SceneOfTexture {
public:
    SceneOfTexture(const DropletHistories& histories, const Glass& glass, const WindshieldAnimationOptions& options)
        : frames_(histories.frames()),
          options_(options),
          pane_(glassMesh(glass)),
          cap_(capMesh(options.shape.contact_angle, {.around = 16, .rings = 5}))
    {
        struct Span {
            const DropletHistory* history;
            std::uint32_t begin;
            std::uint32_t end;
        };
        std::vector<Span> spans;
        for (const DropletHistory* history : histories.all()) {
            spans.push_back({history, history->begin(), history->end});
            for (const DropletSample& sample : history->samples) {
                for (std::size_t i = 0; i < 3; ++i) {
                    places_[i].include(sample.pose.place[i]);
                }
                sizes_.include(sample.pose.along);
                sizes_.include(sample.pose.across);
                mean_radius_ += static_cast<double>(sample.pose.restRadius());
            }
        }
        mean_radius_ /= static_cast<double>(std::max<std::size_t>(histories.samples(), 1));
        for (Range& range : places_) {
            range = range.widened();
        }
        sizes_ = sizes_.widened();
        const auto slots = assignSlots(spans, 1);  // an empty frame separates one droplet from the next
        slots_ = slots.size();
        const std::size_t blocks = blocksOf(slots_);
        checkTexture(slots_, frames_);
        columns_ = std::max<std::size_t>((slots_ + blocks - 1) / blocks, 1);
        Picture picture;
        picture.width = static_cast<int>(kTexels * columns_);
        picture.height = static_cast<int>(blocks * frames_);
        picture.rgb.assign(3 * kTexels * columns_ * blocks * frames_, 0);
        for (std::size_t slot = 0; slot < slots_; ++slot) {
            for (const std::size_t number : slots[slot]) {
                draw(*spans[number].history, slot, picture);
            }
        }
        std::ostringstream png;
        writePng(picture, png);
        png_ = std::move(png).str();
    }

    [[nodiscard]] Scene scene() const
    {
        Scene scene;
        addGlass(scene, pane_);
        const std::size_t material = scene.addMaterial(liquidMaterial(lookOf(options_.material), mean_radius_));
        SceneNode node{"droplets", scene.addMesh(sceneMesh(cap_, "droplet", material))};
        node.scale = {0.0, 0.0, 0.0};  // invisible without the shader that places the droplets
        node.properties = mapping();
        scene.addNode(std::move(node));
        scene.picture = ScenePicture{"droplets", png_, false};
        return scene;
    }

private:
    void draw(const DropletHistory& history, std::size_t slot, Picture& picture) const
    {
        const std::size_t row = static_cast<std::size_t>(frames_) * (slot / columns_);
        DropletPose shown = history.samples.front().pose;
        for (std::size_t i = 0; i < history.samples.size(); ++i) {
            const DropletPose& pose = history.samples[i].pose;
            if (!shown.looksLike(pose)) {  // unchanged bytes compress better
                shown = pose;
            }
            shown.place = pose.place;
            const auto bytes = bytesOf(shown);
            const std::uint32_t end = i + 1 < history.samples.size() ? history.samples[i + 1].frame : history.end;
            for (std::uint32_t frame = history.samples[i].frame; frame < end; ++frame) {
                const std::size_t texel = (row + frame) * kTexels * columns_ + kTexels * (slot % columns_);
                std::copy(bytes.begin(), bytes.end(), picture.rgb.begin() + static_cast<std::ptrdiff_t>(3 * texel));
            }
        }
    }

    [[nodiscard]] std::array<std::uint8_t, 3 * kTexels> bytesOf(const DropletPose& pose) const
    {
        std::array<std::uint8_t, 3 * kTexels> bytes{};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& [low, high] = places_[i];
            const long number = std::lround(65535.0 * (static_cast<double>(pose.place[i]) - low) / (high - low));
            bytes[2 * i] = static_cast<std::uint8_t>(number / 256);
            bytes[2 * i + 1] = static_cast<std::uint8_t>(number % 256);
        }
        for (std::size_t i = 0; i < 4; ++i) {
            bytes[6 + i] = static_cast<std::uint8_t>(std::lround(127.5 * (1.0 + static_cast<double>(pose.turn[i]))));
        }
        const auto step = [&](float size) {
            const double share = std::log(static_cast<double>(size) / sizes_.low) / std::log(sizes_.high / sizes_.low);
            return static_cast<std::uint8_t>(1 + std::lround(254.0 * share));
        };
        bytes[10] = step(pose.along);
        bytes[11] = step(pose.across);
        return bytes;
    }

    [[nodiscard]] std::vector<SceneProperty> mapping() const
    {
        const auto corner = [&](double Range::*end) {
            return std::vector{places_[0].*end, places_[1].*end, places_[2].*end};
        };
        return {{"texture", 0},
                {"slots", static_cast<int>(slots_)},
                {"columns", static_cast<int>(columns_)},
                {"frames", static_cast<int>(frames_)},
                {"frames_per_second", options_.frames_per_second},
                {"low_m", corner(&Range::low)},
                {"high_m", corner(&Range::high)},
                {"smallest_m", sizes_.low},
                {"largest_m", sizes_.high}};
    }

    std::uint32_t frames_;
    WindshieldAnimationOptions options_;
    DropletMesh pane_;
    DropletMesh cap_;
    std::array<Range, 3> places_;
    Range sizes_;
    double mean_radius_ = 0.0;  ///< mean radius of the droplets [m]
    std::size_t slots_ = 0;
    std::size_t columns_ = 0;
    std::string png_;
};

}  // namespace

void checkTexture(std::size_t slots, std::size_t frames)
{
    const std::size_t rows = blocksOf(slots) * frames;
    if (rows > kLargestSide) {
        throw Error(ErrorCode::InvalidArgument, std::to_string(frames) + " frames of up to " + std::to_string(slots) +
                                                    " droplets would make a texture of " + std::to_string(rows) +
                                                    " rows; at most " + std::to_string(kLargestSide) +
                                                    " are allowed: use a shorter time, fewer frames per second or "
                                                    "less rain");
    }
}

Scene sceneOfTexture(const DropletHistories& histories, const Glass& glass, const WindshieldAnimationOptions& options)
{
    return SceneOfTexture(histories, glass, options).scene();
}

}  // namespace droplet

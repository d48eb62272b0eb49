// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_view/eye.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "droplet/error.h"
#include "number_text.h"

namespace droplet {
namespace {

std::string textOf(Vec3 v)
{
    return "(" + numberText(v.x) + ", " + numberText(v.y) + ", " + numberText(v.z) + ")";
}

}  // namespace

/// Finds the place of every pixel by drawing the glass as a mesh of triangles.
class Eye::GlassMesh {
public:
    explicit GlassMesh(Eye& eye) : eye_(eye), depths_(eye.places_.size(), std::numeric_limits<float>::infinity()) {}

    /// Draws a mesh with vertices 4 mm apart; at a radius of 5 m the error is 0.4 µm.
    void draw(const Glass& glass)
    {
        constexpr double kApart = 4e-3;
        constexpr int kMax = 2048;
        const int across = std::clamp(static_cast<int>(std::ceil(glass.width() / kApart)), 1, kMax);
        const int upward = std::clamp(static_cast<int>(std::ceil(glass.height() / kApart)), 1, kMax);
        std::vector<std::optional<Vec3f>> vertices(static_cast<std::size_t>(across + 1) *
                                                   static_cast<std::size_t>(upward + 1));
        const auto position = [&](int i, int j) {
            return Vec2{glass.width() * i / across, glass.height() * j / upward};
        };
        const auto vertex = [&](int i, int j) -> std::optional<Vec3f>& {
            return vertices[static_cast<std::size_t>(j) * static_cast<std::size_t>(across + 1) +
                            static_cast<std::size_t>(i)];
        };
        tbb::parallel_for(0, upward + 1, [&](int j) {
            for (int i = 0; i <= across; ++i) {
                if (const auto place = glass.place(position(i, j))) {
                    vertex(i, j) = toFloats(eye_.seen(*place).point);
                }
            }
        });
        for (int j = 0; j < upward; ++j) {
            for (int i = 0; i < across; ++i) {
                drawTriangle({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)},
                             {position(i, j), position(i + 1, j), position(i + 1, j + 1)});
                drawTriangle({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)},
                             {position(i, j), position(i + 1, j + 1), position(i, j + 1)});
            }
        }
    }

private:
    void drawTriangle(const std::array<std::optional<Vec3f>, 3>& corners, const std::array<Vec2, 3>& positions)
    {
        constexpr float kBeforeEye = 1e-3F;  // [m]
        float left = 1e9F;
        float right = -1e9F;
        float top = 1e9F;
        float bottom = -1e9F;
        for (const auto& corner : corners) {
            if (!corner || corner->y < kBeforeEye) {
                return;
            }
            const float x = 0.5F * static_cast<float>(eye_.width_) + corner->x / corner->y / eye_.tangent_;
            const float y = 0.5F * static_cast<float>(eye_.height_) - corner->z / corner->y / eye_.tangent_;
            left = std::min(left, x);
            right = std::max(right, x);
            top = std::min(top, y);
            bottom = std::max(bottom, y);
        }
        const auto w = static_cast<float>(eye_.width_);
        const auto h = static_cast<float>(eye_.height_);
        if (right < 0.0F || left > w || bottom < 0.0F || top > h) {
            return;
        }
        const Vec3f& a = *corners[0];
        const Vec3f& b = *corners[1];
        const Vec3f& c = *corners[2];
        const std::array<Vec3f, 3> faces{cross(b, c), cross(c, a), cross(a, b)};
        const float volume = dot(a, faces[0]);
        for (int y = std::max(static_cast<int>(top - 1.0F), 0);
             y <= std::min(static_cast<int>(bottom + 1.0F), eye_.height_ - 1); ++y) {
            for (int x = std::max(static_cast<int>(left - 1.0F), 0);
                 x <= std::min(static_cast<int>(right + 1.0F), eye_.width_ - 1); ++x) {
                const Vec3f direction = eye_.ray(x, y);
                std::array<float, 3> shares{};
                for (std::size_t k = 0; k < 3; ++k) {
                    shares[k] = dot(direction, faces[k]);
                }
                const float sum = shares[0] + shares[1] + shares[2];
                // Neighbours share an edge only up to rounding; the tolerance keeps pixels on it from being missed by
                // both.
                constexpr float kOutside = -1e-3F;
                if (sum == 0.0F || std::min({shares[0] / sum, shares[1] / sum, shares[2] / sum}) < kOutside) {
                    continue;
                }
                const float depth = volume / sum;
                if (depth > 0.0F && depth < depths_[eye_.at(x, y)]) {
                    depths_[eye_.at(x, y)] = depth;
                    double px = 0.0;
                    double py = 0.0;
                    for (std::size_t k = 0; k < 3; ++k) {
                        px += static_cast<double>(shares[k] / sum) * positions[k].x;
                        py += static_cast<double>(shares[k] / sum) * positions[k].y;
                    }
                    eye_.places_[eye_.at(x, y)] = {static_cast<float>(px), static_cast<float>(py)};
                }
            }
        }
    }

    Eye& eye_;
    std::vector<float> depths_;  ///< depth of the surface drawn in each pixel
};

Eye::Eye(const Glass& glass, const ViewOptions& options)
    : width_(options.width),
      height_(options.height),
      half_width_(static_cast<float>(std::tan(0.5 * options.field_of_view))),
      tangent_(2.0F * half_width_ / static_cast<float>(width_))
{
    const Vec2 aim = options.aim.value_or(Vec2{0.5 * glass.width(), 0.5 * glass.height()});
    const auto ahead = glass.place(aim);
    if (!ahead) {
        const std::string place = "(" + numberText(aim.x) + ", " + numberText(aim.y) + ")";
        throw Error(ErrorCode::InvalidArgument,
                    options.aim ? "aim " + place + " must be on the glass"
                                : "the glass has a hole in its middle, at " + place + " m, where the eye must see it");
    }
    const Vec3 from_aim = options.eye.value_or(Vec3{0.0, -options.eye_distance, 0.0});
    position_ = ahead->point + from_aim;
    if (options.eye && !(dot(from_aim, ahead->normal) < 0.0)) {
        throw Error(ErrorCode::InvalidArgument, "eye " + textOf(from_aim) + " must be behind the glass");
    }
    if (options.look_at) {
        const Vec3 way = *options.look_at - from_aim;
        if (!(way.y > 0.05 * length(way))) {
            throw Error(ErrorCode::InvalidArgument,
                        "look_at " + textOf(*options.look_at) + " must be in front of the eye");
        }
        ahead_ = (1.0 / length(way)) * way;
        const Vec3 right = cross(ahead_, Vec3{0.0, 0.0, 1.0});
        right_ = (1.0 / length(right)) * right;
        up_ = cross(right_, ahead_);
    }
    constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();
    places_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), {kNowhere, kNowhere});
    GlassMesh(*this).draw(glass);
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
// When liquid arrives at a pixel is the first time of a front that goes with a given speed: the eikonal equation,
// solved outward from where the front begins (J. A. Sethian, "A fast marching level set method for monotonically
// advancing fronts", Proc. Natl. Acad. Sci. 93 (1996) 1591), with differences of the first order. The distance to the
// rim, which the speed depends on, is the arrival of a front of speed 1 from the rim.
#include "droplet/mask/reveal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <queue>
#include <utility>

#include "droplet/error.h"
#include "entry_named.h"
#include "require.h"

namespace droplet {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();
constexpr std::uint16_t kHalf = 32768;  // coverage from which a pixel is liquid
constexpr float kSpeedAtRim = 0.5F;     // of that in the middle: a front stands at 60° to it there; chosen by eye

/// Pixels of a picture, row by row.
struct Grid {
    int width = 0;
    int height = 0;

    [[nodiscard]] std::size_t size() const
    {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    [[nodiscard]] int column(std::size_t pixel) const
    {
        return static_cast<int>(pixel % static_cast<std::size_t>(width));
    }
    [[nodiscard]] int row(std::size_t pixel) const { return static_cast<int>(pixel / static_cast<std::size_t>(width)); }
    [[nodiscard]] std::size_t pixel(int column, int row) const
    {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
    }

    /// Calls visit(neighbour, whether it is beside and not above or below) for the up to four neighbours of a pixel.
    template <class Visit>
    void visitNeighbours(std::size_t pixel, const Visit& visit) const
    {
        const int x = column(pixel);
        if (x > 0) {
            visit(pixel - 1, true);
        }
        if (x + 1 < width) {
            visit(pixel + 1, true);
        }
        if (pixel >= static_cast<std::size_t>(width)) {
            visit(pixel - static_cast<std::size_t>(width), false);
        }
        if (pixel + static_cast<std::size_t>(width) < size()) {
            visit(pixel + static_cast<std::size_t>(width), false);
        }
    }
};

/// Solution of |∇T| = 1/speed at a pixel, from the smaller arrivals beside and above or below.
float arrivalFrom(float beside, float above, float speed)
{
    const float step = 1.0F / speed;
    const float first = std::min(beside, above);
    const float apart = std::abs(beside - above);
    if (!(apart < step)) {
        return first + step;
    }
    return 0.5F * (beside + above + std::sqrt(2.0F * step * step - apart * apart));
}

/// Lets a front go on from pixels whose arrival is set, into pixels of positive speed.
void march(const Grid& grid, const std::vector<float>& speed, std::vector<float>& arrival)
{
    using Entry = std::pair<float, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    for (std::size_t i = 0; i < arrival.size(); ++i) {
        if (arrival[i] < kNever) {
            front.emplace(arrival[i], i);
        }
    }
    std::vector<bool> done(arrival.size());
    while (!front.empty()) {
        const std::size_t pixel = front.top().second;
        front.pop();
        if (done[pixel]) {
            continue;
        }
        done[pixel] = true;
        grid.visitNeighbours(pixel, [&](std::size_t next, bool /*is_beside*/) {
            if (done[next] || speed[next] <= 0.0F) {
                return;
            }
            std::array<float, 2> smaller{kNever, kNever};  // beside; above or below
            grid.visitNeighbours(next, [&](std::size_t other, bool is_beside) {
                float& least = smaller[is_beside ? 0 : 1];
                least = std::min(least, done[other] ? arrival[other] : kNever);
            });
            const float found = arrivalFrom(smaller[0], smaller[1], speed[next]);
            if (found < arrival[next]) {
                arrival[next] = found;
                front.emplace(found, next);
            }
        });
    }
}

/// Distance of liquid pixels to the rim [px]; 0 on dry ones.
std::vector<float> depthOf(const Grid& grid, const std::vector<bool>& liquid)
{
    std::vector<float> depth(grid.size(), kNever);
    std::vector<float> speed(grid.size(), 0.0F);
    for (std::size_t i = 0; i < grid.size(); ++i) {
        if (!liquid[i]) {
            depth[i] = 0.0F;
            continue;
        }
        speed[i] = 1.0F;
    }
    march(grid, speed, depth);
    return depth;
}

/// Distance that a front over the picture has gone at a pixel [px].
class Wipe {
public:
    Wipe(const Grid& grid, const std::vector<bool>& liquid, const RevealSource& source) : grid_(grid), source_(source)
    {
        Vec2 low{1e9, 1e9};
        Vec2 high{-1e9, -1e9};
        for (std::size_t i = 0; i < liquid.size(); ++i) {
            if (liquid[i]) {
                const Vec2 at = placeOf(i);
                low = {std::min(low.x, at.x), std::min(low.y, at.y)};
                high = {std::max(high.x, at.x), std::max(high.y, at.y)};
            }
        }
        if (const auto* place = std::get_if<Vec2>(&source)) {
            centre_ = {place->x * grid.width, place->y * grid.height};
        } else {
            centre_ = 0.5 * (low + high);
        }
    }

    [[nodiscard]] float at(std::size_t pixel) const
    {
        const Vec2 place = placeOf(pixel);
        if (const auto* side = std::get_if<RevealFrom>(&source_)) {
            switch (*side) {
                case RevealFrom::Left:
                    return static_cast<float>(place.x);
                case RevealFrom::Right:
                    return static_cast<float>(grid_.width - place.x);
                case RevealFrom::Top:
                    return static_cast<float>(place.y);
                case RevealFrom::Bottom:
                    return static_cast<float>(grid_.height - place.y);
                case RevealFrom::Middle:
                    break;
            }
        }
        return static_cast<float>(length(place - centre_));
    }

private:
    [[nodiscard]] Vec2 placeOf(std::size_t pixel) const { return {grid_.column(pixel) + 0.5, grid_.row(pixel) + 0.5}; }

    Grid grid_;
    RevealSource source_;
    Vec2 centre_;
};

/// Number of the droplet of every pixel, from 1; 0 on dry ones. Pixels are joined by sides, as a front goes.
std::vector<std::int32_t> dropletsOf(const Grid& grid, const std::vector<bool>& liquid)
{
    cv::Mat is_liquid(grid.height, grid.width, CV_8U);
    std::copy(liquid.begin(), liquid.end(), is_liquid.begin<std::uint8_t>());
    cv::Mat droplets;
    cv::connectedComponents(is_liquid, droplets, 4, CV_32S);
    return {droplets.begin<std::int32_t>(), droplets.end<std::int32_t>()};
}

}  // namespace

RevealFrom revealFromNamed(std::string_view name)
{
    constexpr std::array<std::pair<RevealFrom, const char*>, 5> kNames{{{RevealFrom::Left, "left"},
                                                                        {RevealFrom::Right, "right"},
                                                                        {RevealFrom::Top, "top"},
                                                                        {RevealFrom::Bottom, "bottom"},
                                                                        {RevealFrom::Middle, "middle"}}};
    return valueNamed(kNames, name, "reveal");
}

Reveal::Reveal(Mask mask, const RevealSource& source) : mask_(std::move(mask))
{
    mask_.validate();
    if (const auto* place = std::get_if<Vec2>(&source)) {
        require(std::isfinite(place->x), "source.x", place->x, "finite");
        require(std::isfinite(place->y), "source.y", place->y, "finite");
    }
    const Grid grid{mask_.width, mask_.height};
    std::vector<bool> liquid(grid.size());
    for (std::size_t i = 0; i < grid.size(); ++i) {
        liquid[i] = mask_.coverage[i] >= kHalf;
    }
    const std::vector<float> depth = depthOf(grid, liquid);
    // A strip's area over its rim is half its width.
    double area = 0.0;
    double rim = 0.0;
    for (std::size_t i = 0; i < grid.size(); ++i) {
        area += liquid[i] ? 1.0 : 0.0;
        rim += liquid[i] && depth[i] <= 1.0F ? 1.0 : 0.0;
    }
    if (area == 0.0) {
        throw Error(ErrorCode::InvalidInput, "mask has no liquid");
    }
    const auto half_width = static_cast<float>(area / std::max(rim, 1.0));
    speed_.assign(grid.size(), 0.0F);
    for (std::size_t i = 0; i < grid.size(); ++i) {
        if (liquid[i]) {
            speed_[i] = kSpeedAtRim + (1.0F - kSpeedAtRim) * std::min(depth[i] / half_width, 1.0F);
        }
    }
    const Wipe wipe(grid, liquid, source);
    const std::vector<std::int32_t> droplets = dropletsOf(grid, liquid);
    const auto count = static_cast<std::size_t>(*std::max_element(droplets.begin(), droplets.end()));
    std::vector<float> begin(count + 1, kNever);
    for (std::size_t i = 0; i < grid.size(); ++i) {
        float& first = begin[static_cast<std::size_t>(droplets[i])];
        first = std::min(first, wipe.at(i));
    }
    const float earliest = *std::min_element(begin.begin() + 1, begin.end());
    arrival_.assign(grid.size(), kNever);
    for (std::size_t i = 0; i < grid.size(); ++i) {
        if (liquid[i] && wipe.at(i) <= begin[static_cast<std::size_t>(droplets[i])] + half_width) {
            arrival_[i] = wipe.at(i) - earliest;
        }
    }
    march(grid, speed_, arrival_);
    float last = 0.0F;
    for (const float arrival : arrival_) {
        last = arrival < kNever ? std::max(last, arrival) : last;
    }
    // Pixels at the rim that are less than half liquid follow their neighbours.
    std::vector<float> beside = arrival_;
    for (std::size_t i = 0; i < grid.size(); ++i) {
        if (liquid[i]) {
            continue;
        }
        speed_[i] = 1.0F;
        float least = last;
        for (int y = std::max(grid.row(i) - 1, 0); y <= std::min(grid.row(i) + 1, grid.height - 1); ++y) {
            for (int x = std::max(grid.column(i) - 1, 0); x <= std::min(grid.column(i) + 1, grid.width - 1); ++x) {
                least = std::min(least, arrival_[grid.pixel(x, y)]);
            }
        }
        beside[i] = least;
    }
    arrival_ = std::move(beside);
    end_ = last + 1.0F / kSpeedAtRim;
}

Mask Reveal::at(double time) const
{
    require(time >= 0.0 && time <= 1.0, "time", time, "from 0 to 1");
    Mask mask = mask_;
    const float now = static_cast<float>(time) * end_;
    for (std::size_t i = 0; i < mask.coverage.size(); ++i) {
        const float covered = std::clamp((now - arrival_[i]) * speed_[i] + 0.5F, 0.0F, 1.0F);
        mask.coverage[i] = static_cast<std::uint16_t>(std::lrint(covered * static_cast<float>(mask_.coverage[i])));
    }
    return mask;
}

}  // namespace droplet

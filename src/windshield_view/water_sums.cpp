// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_view/water_sums.h"

#include <algorithm>
#include <utility>

#include "blocks.h"
#include "windshield_view/film_raster.h"

namespace droplet {
namespace {

constexpr std::size_t kDropsPerBlock = 256;

bool looksAs(const RunningDroplet& a, const RunningDroplet& b)
{
    return a.position == b.position && a.velocity == b.velocity && a.volume == b.volume;
}

/// Appends what some have and others have not.
void appendOnlyIn(std::span<const StillDroplet> some, std::span<const StillDroplet> others,
                  std::vector<StillDroplet>& to)
{
    std::copy_if(some.begin(), some.end(), std::back_inserter(to), [&](const StillDroplet& droplet) {
        return std::find(others.begin(), others.end(), droplet) == others.end();
    });
}

}  // namespace

WaterSums::WaterSums(const WaterRaster& raster, const ShapeOptions& shape, ReliefOf relief_of)
    : raster_(raster), shape_(shape), relief_of_(std::move(relief_of))
{
    const auto pixels = static_cast<std::size_t>(raster.width()) * static_cast<std::size_t>(raster.height());
    water_.resize(pixels);
    motion_.resize(pixels);
    is_changed_.resize(pixels);
}

void WaterSums::update(const WindshieldState& state)
{
    update(StillCells::of(state.still));
    update(state.droplets);
    update(state.splashes, state.time);
}

void WaterSums::updateFilm(const Runoff& film)
{
    if (film.thickness.empty() && film_.empty()) {
        return;
    }
    const bool is_there = !film.thickness.empty();
    film_.resize(water_.size());
    const auto columns = static_cast<std::size_t>(raster_.width());
    const std::optional<FilmRaster> raster =
        is_there ? std::optional<FilmRaster>(std::in_place, raster_, film) : std::nullopt;
    constexpr std::size_t kRows = 16;  // that a thread takes
    forBlocks(
        static_cast<std::size_t>(raster_.height()),
        [&](std::size_t first, std::size_t last) {
            std::vector<WaterPixel> now(columns);
            for (std::size_t row = first; row < last; ++row) {
                if (raster) {
                    raster->row(row, now);
                }
                for (std::size_t column = 0; column < columns; ++column) {
                    const std::size_t k = row * columns + column;
                    if (!(now[column] == film_[k])) {
                        water_[k].add(now[column], 1);
                        water_[k].add(film_[k], -1);
                        film_[k] = now[column];
                        is_changed_[k] = 1;
                    }
                }
            }
        },
        kRows);
    if (!is_there) {
        film_.clear();
    }
}

void WaterSums::add(std::span<const WaterStamp> stamps, int sign)
{
    for (const WaterStamp& stamp : stamps) {
        water_[stamp.pixel].add(stamp.water, sign);
        if (stamp.motion.cover != 0) {
            motion_[stamp.pixel].add(stamp.motion, sign);
        }
        is_changed_[stamp.pixel] = 1;
    }
}

void WaterSums::draw(const std::vector<StillDroplet>& droplets, int sign)
{
    const auto blocks = mapBlocks<std::vector<WaterStamp>>(
        droplets.size(),
        [&](std::size_t first, std::size_t last) {
            std::vector<WaterStamp> stamps;
            for (std::size_t k = first; k < last; ++k) {
                const StillDroplet& one = droplets[k];
                raster_.draw({one.position, {}, one.volume, runningShape(one.volume, 0.0, shape_), false}, stamps);
            }
            return stamps;
        },
        kDropsPerBlock);
    for (const std::vector<WaterStamp>& block : blocks) {
        add(block, sign);
    }
}

void WaterSums::update(const StillCells& now)
{
    if (still_.revisions.size() != now.revisions.size()) {
        still_ = StillCells();
        still_.slots.resize(now.slots.size());
        still_.counts.resize(now.counts.size());
        still_.revisions.resize(now.revisions.size());
    }
    std::vector<StillDroplet> gone;
    std::vector<StillDroplet> come;
    for (std::size_t cell = 0; cell < now.revisions.size(); ++cell) {
        if (still_.revisions[cell] == now.revisions[cell]) {
            continue;
        }
        const auto droplets = now.droplets(cell);
        appendOnlyIn(still_.droplets(cell), droplets, gone);
        appendOnlyIn(droplets, still_.droplets(cell), come);
        std::copy(droplets.begin(), droplets.end(),
                  still_.slots.begin() + static_cast<std::ptrdiff_t>(cell * StillCells::kMax));
        still_.counts[cell] = now.counts[cell];
        still_.revisions[cell] = now.revisions[cell];
    }
    draw(gone, -1);
    draw(come, 1);
}

void WaterSums::draw(Drawn& one) const
{
    const RunningDroplet& droplet = one.droplet;
    const std::optional<BodyRelief> relief = relief_of_ ? relief_of_(droplet) : std::nullopt;
    raster_.draw({droplet.position, droplet.velocity, droplet.volume,
                  runningShape(droplet.volume, length(droplet.velocity), shape_), true,
                  relief ? std::make_shared<const BodyRelief>(*relief) : nullptr},
                 one.water);
}

/// Both lists are in the order of ids. What has not changed keeps its water where it is.
void WaterSums::update(const std::vector<RunningDroplet>& now)
{
    std::vector<Drawn> drawn;
    drawn.reserve(now.size());
    std::vector<std::size_t> fresh;
    auto old = running_.begin();
    for (const RunningDroplet& droplet : now) {
        for (; old != running_.end() && old->droplet.id < droplet.id; ++old) {
            add(old->water, -1);
        }
        const bool was_there = old != running_.end() && old->droplet.id == droplet.id;
        if (was_there && looksAs(old->droplet, droplet)) {
            drawn.push_back(std::move(*old));
        } else {
            fresh.push_back(drawn.size());
            Drawn& one = drawn.emplace_back(Drawn{droplet, {}});
            if (was_there) {
                one.before = std::move(old->water);
                one.water = std::move(old->before);
                one.water.clear();
            }
        }
        old += was_there ? 1 : 0;
    }
    for (; old != running_.end(); ++old) {
        add(old->water, -1);
    }
    forBlocks(
        fresh.size(),
        [&](std::size_t first, std::size_t last) {
            for (std::size_t k = first; k < last; ++k) {
                draw(drawn[fresh[k]]);
            }
        },
        kDropsPerBlock);
    for (const std::size_t k : fresh) {
        add(drawn[k].before, -1);
        drawn[k].before.clear();
        add(drawn[k].water, 1);
    }
    running_ = std::move(drawn);
}

void WaterSums::update(const std::vector<Splash>& splashes, double time)
{
    std::vector<WaterStamp> now = raster_.rimsOf(splashes, time);
    if (now != rims_) {
        add(rims_, -1);
        rims_ = std::move(now);
        add(rims_, 1);
    }
}

}  // namespace droplet

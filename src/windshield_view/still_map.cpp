// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_view/still_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "droplet/body/running_shape.h"

namespace droplet {
namespace {

/// Level from 0 to 65535 of a value from −1 to 1.
std::uint64_t level16(float value)
{
    return static_cast<std::uint64_t>(std::lround(32767.5F + 32767.5F * std::clamp(value, -1.0F, 1.0F)));
}

float value16(std::uint64_t level)
{
    return (static_cast<float>(level) - 32767.5F) / 32767.5F;
}

}  // namespace

Texel::Texel(double thickness, Vec3f normal, float cover, float radius)
{
    const auto depth = static_cast<std::uint64_t>(std::lround(65535.0 * std::clamp(thickness / kThickest, 0.0, 1.0)));
    const auto share = static_cast<std::uint64_t>(std::lround(255.0F * std::clamp(cover, 0.0F, 1.0F)));
    const auto size = static_cast<std::uint64_t>(std::clamp(std::lround(4.0F * radius), 1L, 255L));
    bits_ = depth << 48 | level16(normal.x) << 32 | level16(normal.y) << 16 | share << 8 | size;
}

Vec3f Texel::normal() const
{
    const float x = value16((bits_ >> 32) & 0xFFFFU);
    const float y = value16((bits_ >> 16) & 0xFFFFU);
    return {x, y, std::sqrt(std::max(1.0F - x * x - y * y, 0.0F))};
}

StillMap::StillMap(const MapWindow& window, double contact_angle)
    : texel_(window.texel),
      first_column_(static_cast<std::int64_t>(std::floor(window.low.x / texel_))),
      first_row_(static_cast<std::int64_t>(std::floor(window.low.y / texel_))),
      columns_(static_cast<int>(static_cast<std::int64_t>(std::ceil(window.high.x / texel_)) - first_column_)),
      rows_(static_cast<int>(static_cast<std::int64_t>(std::ceil(window.high.y / texel_)) - first_row_)),
      low_x_(static_cast<float>(static_cast<double>(first_column_) * texel_)),
      low_y_(static_cast<float>(static_cast<double>(first_row_) * texel_)),
      per_metre_(static_cast<float>(1.0 / texel_)),
      sine_(std::sin(contact_angle)),
      cosine_(std::cos(contact_angle)),
      unit_radius_(runningShape(1.0, 0.0, {.contact_angle = contact_angle}).contact_radius),
      texels_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_))
{
}

StillMap::Box StillMap::boxOf(const StillCells& still, std::size_t cell) const
{
    const auto column = static_cast<double>(cell % still.columns);
    const std::size_t whole_rows = cell / still.columns;
    const auto row = static_cast<double>(whole_rows);
    // A texel belongs to the cell that contains its middle.
    const auto edge = [&](double at, std::int64_t first, int max) {
        const auto texel = static_cast<std::int64_t>(std::ceil(at / texel_ - 0.5)) - first;
        return static_cast<int>(std::clamp<std::int64_t>(texel, 0, max));
    };
    return {edge(column * still.cell, first_column_, columns_),
            edge((column + 1.0) * still.cell, first_column_, columns_), edge(row * still.cell, first_row_, rows_),
            edge((row + 1.0) * still.cell, first_row_, rows_)};
}

bool StillMap::draw(const StillCells& still, std::size_t cell)
{
    const Box box = boxOf(still, cell);
    const int width = box.right - box.left;
    std::vector<Texel> drawn(static_cast<std::size_t>(width) * static_cast<std::size_t>(box.high - box.low));
    const auto column = static_cast<std::int64_t>(cell % still.columns);
    const auto row = static_cast<std::int64_t>(cell / still.columns);
    for (std::int64_t r = std::max<std::int64_t>(row - 1, 0); r <= std::min<std::int64_t>(row + 1, still.rows - 1);
         ++r) {
        for (std::int64_t c = std::max<std::int64_t>(column - 1, 0);
             c <= std::min<std::int64_t>(column + 1, still.columns - 1); ++c) {
            for (const StillDroplet& droplet :
                 still.droplets(static_cast<std::size_t>(r) * still.columns + static_cast<std::size_t>(c))) {
                const double contact = unit_radius_ * std::cbrt(droplet.volume);
                const double sphere = contact / sine_;
                // Only neighbouring cells are searched.
                const double wide = std::min(cosine_ < 0.0 ? sphere : contact, still.cell - texel_);
                const double reach = wide + 0.5 * texel_;
                const double x0 = droplet.position.x / texel_ - 0.5 - static_cast<double>(first_column_);
                const double y0 = droplet.position.y / texel_ - 0.5 - static_cast<double>(first_row_);
                const int left = std::max(box.left, static_cast<int>(std::ceil(x0 - reach / texel_)));
                const int right = std::min(box.right - 1, static_cast<int>(std::floor(x0 + reach / texel_)));
                const int low = std::max(box.low, static_cast<int>(std::ceil(y0 - reach / texel_)));
                const int high = std::min(box.high - 1, static_cast<int>(std::floor(y0 + reach / texel_)));
                for (int j = low; j <= high; ++j) {
                    for (int i = left; i <= right; ++i) {
                        const double x = texel_ * (i - x0);
                        const double y = texel_ * (j - y0);
                        const double far = std::hypot(x, y);
                        const double cover = std::min((wide - far) / texel_ + 0.5, 1.0);
                        if (cover <= 0.0) {
                            continue;
                        }
                        const double inside =
                            std::min(1.0, wide / std::max(far, 1e-12));  // beyond the rim, the rim's normal
                        const double up = std::sqrt(std::max(sphere * sphere - far * far * inside * inside, 0.0));
                        const Vec3f normal{static_cast<float>(x * inside / sphere),
                                           static_cast<float>(y * inside / sphere), static_cast<float>(up / sphere)};
                        Texel& texel = drawn[static_cast<std::size_t>((j - box.low) * width + i - box.left)];
                        // Where the droplet overhangs its contact, there is air below it.
                        const double thickness = std::min(up - sphere * cosine_, 2.0 * up);
                        texel = std::max(texel, Texel(thickness, normal, static_cast<float>(cover),
                                                      static_cast<float>(wide / texel_)));
                    }
                }
            }
        }
    }
    bool changed = false;
    for (int j = box.low; j < box.high; ++j) {
        const auto from = drawn.begin() + static_cast<std::ptrdiff_t>(j - box.low) * width;
        const auto to = texels_.begin() + static_cast<std::ptrdiff_t>(j) * columns_ + box.left;
        if (!std::equal(from, from + width, to)) {
            std::copy(from, from + width, to);
            changed = true;
        }
    }
    return changed;
}

std::uint8_t StillMap::reachOf(const StillCells& still, std::size_t cell) const
{
    const double left = static_cast<double>(cell % still.columns) * still.cell;
    const std::size_t row = cell / still.columns;
    const double low = static_cast<double>(row) * still.cell;
    std::uint8_t bits = 0;
    for (const StillDroplet& droplet : still.droplets(cell)) {
        // Two texels more, because draw() uses the middles of texels and rounds.
        const double reach = unit_radius_ / (cosine_ < 0.0 ? sine_ : 1.0) * std::cbrt(droplet.volume) + 2.0 * texel_;
        const bool to_left = droplet.position.x - reach < left;
        const bool to_right = droplet.position.x + reach > left + still.cell;
        const bool down = droplet.position.y - reach < low;
        const bool up = droplet.position.y + reach > low + still.cell;
        bits = static_cast<std::uint8_t>(bits | (down && to_left ? 1 : 0) | (down ? 2 : 0) |
                                         (down && to_right ? 4 : 0) | (to_left ? 8 : 0) | (to_right ? 16 : 0) |
                                         (up && to_left ? 32 : 0) | (up ? 64 : 0) | (up && to_right ? 128 : 0));
    }
    return bits;
}

std::vector<std::size_t> StillMap::update(const StillCells& still)
{
    const std::size_t count = std::size_t{still.columns} * still.rows;
    std::vector<std::uint8_t> stale(count, 0);
    const bool is_new = revisions_.size() != count;
    if (is_new) {
        std::fill(texels_.begin(), texels_.end(), Texel());
        revisions_.assign(count, 0);
        reaches_.assign(count, 0);
    }
    // Cells in the window, and those next to it.
    const auto cell_at = [&](double at, std::uint32_t max) {
        return static_cast<std::int64_t>(std::clamp(std::floor(at / still.cell), 0.0, static_cast<double>(max) - 1.0));
    };
    if (count == 0) {
        return {};
    }
    const std::int64_t left = cell_at(static_cast<double>(first_column_) * texel_, still.columns);
    const std::int64_t right = cell_at(static_cast<double>(first_column_ + columns_) * texel_, still.columns);
    const std::int64_t low = cell_at(static_cast<double>(first_row_) * texel_, still.rows);
    const std::int64_t high = cell_at(static_cast<double>(first_row_ + rows_) * texel_, still.rows);
    const auto columns = static_cast<std::int64_t>(still.columns);
    for (std::int64_t r = std::max<std::int64_t>(low - 1, 0); r <= std::min<std::int64_t>(high + 1, still.rows - 1);
         ++r) {
        for (std::int64_t c = std::max<std::int64_t>(left - 1, 0); c <= std::min<std::int64_t>(right + 1, columns - 1);
             ++c) {
            const auto cell = static_cast<std::size_t>(r * columns + c);
            if (!is_new && revisions_[cell] == still.revisions[cell]) {
                continue;
            }
            revisions_[cell] = still.revisions[cell];
            const std::uint8_t reach = reachOf(still, cell);
            int bits = reaches_[cell] | reach;  // cells that former or present droplets reach
            reaches_[cell] = reach;
            for (std::int64_t j = r - 1; j <= r + 1; ++j) {
                for (std::int64_t i = c - 1; i <= c + 1; ++i) {
                    const bool is_own = j == r && i == c;
                    const bool is_reached = is_own || (bits & 1) != 0;
                    bits = is_own ? bits : bits >> 1;
                    if (is_reached && i >= left && i <= right && j >= low && j <= high) {
                        stale[static_cast<std::size_t>(j * columns + i)] = 1;
                    }
                }
            }
        }
    }
    std::vector<std::size_t> cells;
    for (std::size_t cell = 0; cell < count; ++cell) {
        if (stale[cell] != 0) {
            cells.push_back(cell);
        }
    }
    std::vector<std::uint8_t> changed(cells.size());
    tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t k) { changed[k] = draw(still, cells[k]) ? 1 : 0; });
    drawn_ += cells.size();
    std::vector<std::size_t> result;
    for (std::size_t k = 0; k < cells.size(); ++k) {
        if (changed[k] != 0) {
            result.push_back(cells[k]);
        }
    }
    return result;
}

}  // namespace droplet

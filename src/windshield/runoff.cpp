// SPDX-License-Identifier: GPL-3.0-or-later
//
// A film of water runs off a slope with W. Nusselt's profile ("Die Oberflächenkondensation des Wasserdampfes", Z. VDI
// 60 (1916) 541): its mean velocity is g sin α h²/(3ν), so that rain over the length x of a glass makes it h = (3ν R x
// / (g sin α))^(1/3) thick, 0.13 mm for 25 mm/h over 0.8 m at 45°. The wind pushes its waves as it pushes droplets. So
// thin a film is not stable on glass that water does not wet: below 1.72 (σ(1 − cos θ)/ρ)^(1/5) (μ/(ρg))^(2/5), 0.35 mm
// at θ = 60°, it gathers in rivulets and leaves dry patches (D. E. Hartley, W. Murgatroyd, "Criteria for the break-up
// of thin liquid layers flowing isothermally over solid surfaces", Int. J. Heat Mass Transfer 7 (1964) 1003). Where
// they run is a matter of how well the glass is wetted from place to place. Here this is a random field that turns the
// flow aside, so that it meets in rivulets, and another one for the thickness that stays.
#include "droplet/windshield/runoff.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "blocks.h"
#include "wind/random.h"
#include "windshield/runoff_cells.h"
#include "windshield/segment.h"

namespace droplet {
namespace {

constexpr double kViscosity = 1.0e-3;  // of water at 20 °C (Lide, CRC Handbook) [Pa s]
constexpr double kThinFilm = 24e-6;    // a cell of it is one still droplet [m]

/// How well the glass is wetted from cell to cell: a field that repeats.
class Wettability {
public:
    static constexpr std::uint32_t kColumns = 384;  // as many as a wide windshield has
    static constexpr std::uint32_t kRows = 256;
    struct Place {
        float aside = 0.0F;  ///< velocity to the left of the force over that along it
        float held = 0.0F;   ///< thickness that does not move [m]
    };

    Wettability()
    {
        for (std::uint32_t row = 0; row < kRows; ++row) {
            for (std::uint32_t column = 0; column < kColumns; ++column) {
                const float aside = 1.9F * noise(column, row, {8, 16, 1}) + 1.3F * noise(column, row, {4, 8, 2});
                const float held = 40e-6F + 44e-6F * noise(column, row, {4, 4, 3});
                places_[row * kColumns + column] = {aside, std::max(held, 18e-6F)};
            }
        }
    }

    /// Cells of a row from a column on, up to a multiple of kDriveBlock.
    [[nodiscard]] const Place* block(std::uint32_t column, std::uint32_t row) const
    {
        return places_.data() + std::size_t{row % kRows} * kColumns + column % kColumns;
    }

private:
    struct Octave {
        std::uint32_t across;  ///< length of its waves [cells]
        std::uint32_t up;
        std::uint64_t seed;
    };

    /// Smooth random number, −0.5 to 0.5.
    static float noise(std::uint32_t column, std::uint32_t row, const Octave& octave)
    {
        const auto corner = [&](std::uint32_t i, std::uint32_t j) {
            const std::uint32_t x = (column / octave.across + i) % (kColumns / octave.across);
            const std::uint32_t y = (row / octave.up + j) % (kRows / octave.up);
            const RandomStream random(octave.seed, RandomPurpose::Runoff, std::uint64_t{y} * kColumns + x);
            return static_cast<float>(random.uniform(0)) - 0.5F;
        };
        const auto smooth = [](std::uint32_t k, std::uint32_t length) {
            const float t = static_cast<float>(k % length) / static_cast<float>(length);
            return t * t * (3.0F - 2.0F * t);
        };
        const float x = smooth(column, octave.across);
        const float low = std::lerp(corner(0, 0), corner(1, 0), x);
        const float high = std::lerp(corner(0, 1), corner(1, 1), x);
        return std::lerp(low, high, smooth(row, octave.up));
    }

    std::vector<Place> places_ = std::vector<Place>(std::size_t{kColumns} * kRows);
};

const Wettability& wettability()
{
    static const Wettability field;
    return field;
}

double unitOf(const Runoff& film)
{
    return Runoff::kThickness * film.cell * film.cell;
}

Cells cellsOf(const Runoff& film)
{
    return {film.cell, film.columns, film.rows};
}

/// Middle of a cell [m].
Vec2 middleOf(const Runoff& film, std::size_t cell)
{
    const auto row = static_cast<std::uint32_t>(cell / film.columns);
    const auto column = static_cast<std::uint32_t>(cell % film.columns);
    return {(column + 0.5) * film.cell, (row + 0.5) * film.cell};
}

/// Water that leaves every cell in a step.
struct Outflow {
    std::vector<std::int32_t> x;  ///< to the right; below 0: to the left
    std::vector<std::int32_t> y;  ///< upwards; below 0: downwards
    std::vector<std::int32_t>
        loose;  ///< to each of four neighbours, which give back as much of their own: it levels out
};

constexpr std::uint32_t kDriveBlock = 16;  // cells, along which what moves the film hardly changes

std::uint32_t blocksOf(std::uint32_t cells)
{
    return (cells + kDriveBlock - 1) / kDriveBlock;
}

/// Velocity over the squared thickness, in every block [1/(m s)]; empty: there is no glass.
using Drives = std::vector<std::optional<Vec2>>;

Drives drivesOf(const Runoff& film, const Liquid& liquid, const FilmPush& push_at)
{
    Drives drives;
    for (std::uint32_t low = 0; low < film.rows; low += kDriveBlock) {
        for (std::uint32_t first = 0; first < film.columns; first += kDriveBlock) {
            const double right = std::min(first + kDriveBlock, film.columns);
            const double high = std::min(low + kDriveBlock, film.rows);
            const std::optional<Vec2> push =
                push_at({0.5 * (first + right) * film.cell, 0.5 * (low + high) * film.cell});
            drives.push_back(push ? std::optional((liquid.density / (3.0 * kViscosity)) * *push) : std::nullopt);
        }
    }
    return drives;
}

/// Velocity of the small waves on a film, by what moves it over the whole glass: three times that of its water, but no
/// faster than half their length in a frame of a film of 30 a second, in which they would seem to stand or run back.
Vec2 waveVelocity(const Drives& drives)
{
    constexpr double kThickness = 80e-6;  // of the film that is looked at [m]
    constexpr double kFastest = 36e-3;    // [m/s]
    Vec2 sum;
    double count = 0.0;
    for (const std::optional<Vec2>& drive : drives) {
        if (drive) {
            sum = sum + *drive;
            count += 1.0;
        }
    }
    const Vec2 velocity = (count > 0.0 ? 3.0 * kThickness * kThickness / count : 0.0) * sum;
    return std::min(1.0, kFastest / std::max(length(velocity), kFastest)) * velocity;
}

/// Takes all water of a block of cells.
std::int64_t takeBlock(Runoff& film, std::size_t block)
{
    const std::size_t blocks = std::max(blocksOf(film.columns), 1U);
    const auto across = static_cast<std::uint32_t>(block % blocks) * kDriveBlock;
    const auto up = static_cast<std::uint32_t>(block / blocks) * kDriveBlock;
    std::int64_t taken = 0;
    for (std::uint32_t row = up; row < std::min(up + kDriveBlock, film.rows); ++row) {
        for (std::uint32_t column = across; column < std::min(across + kDriveBlock, film.columns); ++column) {
            taken += std::exchange(film.thickness[std::size_t{row} * film.columns + column], 0);
        }
    }
    return taken;
}

/// Computes the outflow of a row.
void flowOut(const Runoff& film, std::uint32_t row, std::span<const std::optional<Vec2>> drives, double dt,
             Outflow& out)
{
    const auto per_cell = static_cast<float>(dt / film.cell);
    constexpr auto kUnit = static_cast<float>(Runoff::kThickness);
    constexpr float kMost = 0.33F;  // leaves a cell at once: waves of a film are three times as fast as its water
    const Wettability& glass = wettability();
    const std::size_t row_begin = std::size_t{row} * film.columns;
    for (std::uint32_t first = 0; first < film.columns; first += kDriveBlock) {
        const Vec2 drive = drives[first / kDriveBlock].value_or(Vec2{});
        const float drive_x = per_cell * static_cast<float>(drive.x);
        const float drive_y = per_cell * static_cast<float>(drive.y);
        const Wettability::Place* const places = glass.block(first, row);
        const std::uint32_t count = std::min(kDriveBlock, film.columns - first);
        for (std::uint32_t k = 0; k < count; ++k) {
            const std::size_t cell = row_begin + first + k;
            const float moves = std::max(kUnit * static_cast<float>(film.thickness[cell]) - places[k].held, 0.0F);
            const float x = moves * moves * (drive_x - places[k].aside * drive_y);
            const float y = moves * moves * (drive_y + places[k].aside * drive_x);
            const float share = std::max(std::abs(x) + std::abs(y), kMost);
            const float scale = moves * (kMost / kUnit) / share;
            out.x[cell] = static_cast<std::int32_t>(scale * x);
            out.y[cell] = static_cast<std::int32_t>(scale * y);
            constexpr auto kHeld = static_cast<std::int32_t>(40e-6 / Runoff::kThickness);
            constexpr std::int32_t kPart = 32;  // of what is thicker; chosen by eye: rivulets keep their width
            out.loose[cell] = std::max(film.thickness[cell] - kHeld, 0) / kPart;
        }
    }
}

/// Moves the film by a step.
/// @return  water that has left the glass, in units of a cell
std::int64_t flowOnce(Runoff& film, const Drives& drives, double dt, Outflow& out)
{
    const std::size_t columns = film.columns;
    const std::size_t rows = film.rows;
    constexpr std::size_t kRows = 32;  // that a thread takes
    forBlocks(
        rows,
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t row = begin; row < end; ++row) {
                const std::size_t first = row / kDriveBlock * blocksOf(film.columns);
                flowOut(film, static_cast<std::uint32_t>(row), std::span(drives).subspan(first, blocksOf(film.columns)),
                        dt, out);
            }
        },
        kRows);
    std::int64_t left = 0;
    for (std::size_t at = 0; at < film.thickness.size(); at += columns) {
        left += std::max(-out.x[at], 0) + std::max(out.x[at + columns - 1], 0);
    }
    for (std::size_t k = 0; k < columns; ++k) {
        left += std::max(-out.y[k], 0) + std::max(out.y[(rows - 1) * columns + k], 0);
    }
    forBlocks(
        rows,
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t row = begin; row < end; ++row) {
                const std::size_t at = row * columns;
                std::int32_t* const to = film.thickness.data() + at;
                const std::int32_t* const x = out.x.data() + at;
                const std::int32_t* const y = out.y.data() + at;
                const std::int32_t* const loose = out.loose.data() + at;
                for (std::size_t k = 0; k < columns; ++k) {
                    to[k] -= std::abs(x[k]) + std::abs(y[k]);
                }
                for (std::size_t k = 1; k < columns; ++k) {
                    to[k] += std::max(x[k - 1], 0) + loose[k - 1] - loose[k];
                }
                for (std::size_t k = 0; k + 1 < columns; ++k) {
                    to[k] += std::max(-x[k + 1], 0) + loose[k + 1] - loose[k];
                }
                for (std::size_t k = 0; row > 0 && k < columns; ++k) {
                    to[k] += std::max(out.y[at - columns + k], 0) + out.loose[at - columns + k] - loose[k];
                }
                for (std::size_t k = 0; row + 1 < rows && k < columns; ++k) {
                    to[k] += std::max(-out.y[at + columns + k], 0) + out.loose[at + columns + k] - loose[k];
                }
            }
        },
        kRows);
    for (std::size_t block = 0; block < drives.size(); ++block) {
        if (!drives[block]) {
            left += takeBlock(film, block);
        }
    }
    return left;
}

}  // namespace

double Runoff::volume() const
{
    const auto sum = std::accumulate(thickness.begin(), thickness.end(), std::int64_t{0});
    return static_cast<double>(sum) * unitOf(*this) + rest;
}

void layOut(Runoff& film, Vec2 size)
{
    if (film.thickness.empty()) {
        const Cells cells = Cells::over(size, kStillCell);
        film.cell = kStillCell;
        film.columns = cells.columns;
        film.rows = cells.rows;
        film.thickness.resize(cells.count());
    }
}

double thicknessAt(const Runoff& film, Vec2 position)
{
    return film.thickness.empty() ? 0.0 : Runoff::kThickness * film.thickness[cellsOf(film).number(position)];
}

void pour(Runoff& film, Vec2 middle, double radius, double volume)
{
    const Cells cells = cellsOf(film);
    std::vector<std::size_t> reached;
    cells.visitAround(middle, middle, radius, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k <= last; ++k) {
            if (length(middleOf(film, k) - middle) <= radius) {
                reached.push_back(k);
            }
        }
    });
    if (reached.empty()) {
        reached.push_back(cells.number(middle));
    }
    const double whole = volume + film.rest;
    const double units = std::floor(whole / unitOf(film));
    film.rest = std::max(whole - units * unitOf(film), 0.0);
    auto left = static_cast<std::int64_t>(units);
    for (std::size_t k = 0; k < reached.size(); ++k) {
        const std::int64_t share = left / static_cast<std::int64_t>(reached.size() - k);
        film.thickness[reached[k]] += static_cast<std::int32_t>(share);
        left -= share;
    }
}

double takeRunoff(Runoff& film, const Sweep& blade)
{
    if (film.thickness.empty()) {
        return 0.0;
    }
    std::int64_t taken = 0;
    blade.visitCells(cellsOf(film), [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k <= last; ++k) {
            if (film.thickness[k] != 0 && blade.covers(middleOf(film, k))) {
                taken += std::exchange(film.thickness[k], 0);
            }
        }
    });
    return static_cast<double>(taken) * unitOf(film);
}

double takeRunoff(Runoff& film, const MistStroke& stroke)
{
    if (film.thickness.empty()) {
        return 0.0;
    }
    const Segment middle(stroke.from, stroke.to);
    std::int64_t taken = 0;
    cellsOf(film).visitAround(stroke.from, stroke.to, stroke.reach, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k <= last; ++k) {
            if (middle.squaredDistance(middleOf(film, k)) <= stroke.reach * stroke.reach) {
                taken += std::exchange(film.thickness[k], 0);
            }
        }
    });
    return static_cast<double>(taken) * unitOf(film);
}

double flow(Runoff& film, const Liquid& liquid, double dt, const FilmPush& push_at)
{
    const Drives drives = drivesOf(film, liquid, push_at);
    film.drift = film.drift + dt * waveVelocity(drives);
    constexpr double kLongest = 1.0 / 120.0;  // [s]
    const int parts = std::max(static_cast<int>(std::ceil(dt / kLongest - 1e-6)), 1);
    std::int64_t left = 0;
    const std::vector<std::int32_t> none(film.thickness.size());
    Outflow out{none, none, none};
    for (int k = 0; k < parts; ++k) {
        left += flowOnce(film, drives, dt / parts, out);
    }
    return static_cast<double>(left) * unitOf(film);
}

std::vector<StillDroplet> breakUp(Runoff& film, double share, std::uint64_t seed)
{
    std::vector<StillDroplet> droplets;
    const RandomStream random(seed, RandomPurpose::Runoff, film.next_break++);
    // The gaps between cells that break are as long as between successes of trials.
    const double rare = std::log1p(-std::min(share, 0.999));
    constexpr auto kUnit = static_cast<float>(Runoff::kThickness);
    constexpr float kSlow = 15e-6F;  // more than what is held: moves by less than a millimetre a second [m]
    std::uint64_t draw = 0;
    double at = -1.0;
    while (true) {
        at += 1.0 + std::floor(std::log1p(-random.uniform(draw++)) / rare);
        if (at >= static_cast<double>(film.thickness.size())) {
            return droplets;
        }
        const auto k = static_cast<std::size_t>(at);
        const auto column = static_cast<std::uint32_t>(k % film.columns);
        const auto row = static_cast<std::uint32_t>(k / film.columns);
        const float thickness = kUnit * static_cast<float>(film.thickness[k]);
        if (thickness <= 0.0F || thickness > wettability().block(column, row)->held + kSlow) {
            continue;
        }
        // The thicker it is, the longer it takes.
        const double thin = kThinFilm / static_cast<double>(thickness);
        if (random.uniform(draw++) < thin * thin * thin) {
            const Vec2 place{(column + random.uniform(draw)) * film.cell, (row + random.uniform(draw + 1)) * film.cell};
            draw += 2;
            droplets.push_back({place, std::exchange(film.thickness[k], 0) * unitOf(film)});
        }
    }
}

}  // namespace droplet

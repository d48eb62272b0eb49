// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid_shape.h"

namespace droplet {

/// Cells around particles that matter: velocities are taken from the sides around a particle, which are at most two
/// cells from liquid.
inline constexpr std::size_t kPad = 3;

/// Range of indices: [begin, end).
struct Span {
    std::size_t begin = 0;
    std::size_t end = 0;
};

/// Calls work(index) for all indices of spans.
template <typename Work>
void forSpans(const std::vector<Span>& spans, const Work& work)
{
    for (const Span& span : spans) {
        for (std::size_t k = span.begin; k < span.end; ++k) {
            work(k);
        }
    }
}

/// Gives values within spans a value.
template <typename Value>
void fillSpans(const std::vector<Span>& spans, std::vector<Value>& values, Value value)
{
    for (const Span& span : spans) {
        std::fill(values.begin() + static_cast<std::ptrdiff_t>(span.begin),
                  values.begin() + static_cast<std::ptrdiff_t>(span.end), value);
    }
}

/// What is known of a value that is continued. Only `Yes` has the lowest bit.
enum class Reached : std::uint8_t {
    No = 0,
    Yes = 1,
    Next = 2,     ///< in the present layer
    Outside = 4,  ///< of the spans
};

/// How far values have been continued. What is continued at the same time needs one of its own.
struct Continuation {
    std::vector<Reached> reached;
    std::vector<std::size_t> layer;
    std::vector<std::size_t> next_layer;
};

/// Values on the sides of cells that face one axis.
struct Sides {
    std::size_t columns = 0;
    Vec2 first{};                      ///< middle of the first one, in cells from the grid's corner
    std::vector<Span> spans;           ///< near particles: what all others have is of no account
    std::vector<double> open;          ///< part outside of walls
    std::vector<double> wall;          ///< velocity of the wall along the axis
    std::vector<double> value;         ///< velocity along the axis
    std::vector<double> weight;        ///< of the particles near
    std::vector<double> before;        ///< value before the pressure changed it
    std::vector<double> change;        ///< of the value by the pressure
    std::vector<double> shift;         ///< displacement along the axis that mends the density [m]
    std::vector<std::uint8_t> solved;  ///< whether the pressure acts on it
    std::vector<std::uint8_t> known;
    Continuation of_value;  ///< and of its change
    Continuation of_shift;

    Sides() = default;
    Sides(Vec2 middle, std::size_t across, std::size_t up);

    /// Forgets what particles brought.
    void clear();

    [[nodiscard]] Vec2 placeOf(std::size_t k, const GridShape& grid) const
    {
        const std::size_t row = k / columns;
        return grid.placeOf(first.x + static_cast<double>(k % columns), first.y + static_cast<double>(row));
    }

    /// Gives values that are not given the mean of those beside them, layer by layer.
    void extend(std::vector<double>& values, const std::vector<std::uint8_t>& given, Continuation& state) const;

private:
    void findLayer(Continuation& state) const;
};

/// Part of a side outside of walls, from the distances of its ends in cells.
double openPart(double a, double b);

}  // namespace droplet

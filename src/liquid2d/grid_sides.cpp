// SPDX-License-Identifier: GPL-3.0-or-later
#include "grid_sides.h"

#include <cstring>

namespace droplet {

Sides::Sides(Vec2 middle, std::size_t across, std::size_t up) : columns(across), first(middle)
{
    const std::size_t count = across * up;
    for (std::vector<double>* values : {&open, &wall, &value, &weight, &before, &change, &shift}) {
        values->assign(count, 0.0);
    }
    solved.assign(count, 0);
    known.assign(count, 0);
    for (Continuation* state : {&of_value, &of_shift}) {
        state->reached.assign(count, Reached::Outside);
    }
}

void Sides::clear()
{
    for (std::vector<double>* values : {&value, &weight, &shift}) {
        fillSpans(spans, *values, 0.0);
    }
    fillSpans(spans, solved, std::uint8_t{0});
    fillSpans(spans, known, std::uint8_t{0});
    for (Continuation* state : {&of_value, &of_shift}) {
        fillSpans(spans, state->reached, Reached::Outside);
    }
    spans.clear();
}

void Sides::extend(std::vector<double>& values, const std::vector<std::uint8_t>& given, Continuation& state) const
{
    std::vector<Reached>& reached = state.reached;
    std::vector<std::size_t>& layer = state.layer;
    for (const Span& span : spans) {
        for (std::size_t k = span.begin; k < span.end; ++k) {
            reached[k] = given[k] != 0 ? Reached::Yes : Reached::No;
        }
    }
    findLayer(state);
    for (std::size_t pass = 0; pass + 1 < kPad; ++pass) {
        for (const std::size_t k : layer) {
            double sum = 0.0;
            double count = 0.0;
            for (const std::size_t other : {k - 1, k + 1, k - columns, k + columns}) {
                if (reached[other] == Reached::Yes) {
                    sum += values[other];
                    count += 1.0;
                }
            }
            values[k] = sum / count;
        }
        for (const std::size_t k : layer) {
            reached[k] = Reached::Yes;
        }
        state.next_layer.clear();
        for (const std::size_t k : layer) {
            for (const std::size_t other : {k - 1, k + 1, k - columns, k + columns}) {
                if (reached[other] == Reached::No) {
                    reached[other] = Reached::Next;
                    state.next_layer.push_back(other);
                }
            }
        }
        layer.swap(state.next_layer);
    }
}

/// Finds the sides that have no value beside ones that have. Of eight in a row mostly none is one.
void Sides::findLayer(Continuation& state) const
{
    std::vector<Reached>& reached = state.reached;
    constexpr std::size_t kMany = 8;
    constexpr std::uint64_t kLowest = 0x0101010101010101U;
    const auto many = [&](std::size_t k) {
        std::uint64_t bytes = 0;
        std::memcpy(&bytes, reached.data() + k, kMany);
        return bytes;
    };
    const auto is_beside_reached = [&](std::size_t k) {
        return reached[k - 1] == Reached::Yes || reached[k + 1] == Reached::Yes ||
               reached[k - columns] == Reached::Yes || reached[k + columns] == Reached::Yes;
    };
    state.layer.clear();
    for (const Span& span : spans) {
        for (std::size_t k = span.begin; k < span.end;) {
            if (k + kMany <= span.end &&
                ((many(k - 1) | many(k + 1) | many(k - columns) | many(k + columns)) & ~many(k) & kLowest) == 0) {
                k += kMany;
                continue;
            }
            if (reached[k] == Reached::No && is_beside_reached(k)) {
                reached[k] = Reached::Next;
                state.layer.push_back(k);
            }
            ++k;
        }
    }
}

double openPart(double a, double b)
{
    constexpr double kClosed = 0.02;  // less counts as closed
    constexpr double kOnWall = 1e-6;  // rounding puts ends on either side of a wall
    const double most = std::max(a, b);
    const double least = std::min(a, b);
    if (most <= kOnWall) {
        return 0.0;
    }
    const double part = least < 0.0 ? most / (most - least) : 1.0;
    return part < kClosed ? 0.0 : part;
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield/state_bytes.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "droplet/error.h"
#include "windshield/still_droplets.h"

namespace droplet {
namespace {

// After this line every value has 8 bytes, lowest byte first; reals are IEEE 754 bits.
constexpr std::string_view kHead = "droplet-shape windshield 2\n";

class Writer {
public:
    void put(std::uint64_t value)
    {
        for (int k = 0; k < 8; ++k) {
            bytes_ += static_cast<char>((value >> (8 * k)) & 0xFFU);
        }
    }
    void put(double value) { put(std::bit_cast<std::uint64_t>(value)); }
    void put(Vec2 value)
    {
        put(value.x);
        put(value.y);
    }
    void put(const CompensatedSum& value)
    {
        put(value.sum);
        put(value.carry);
    }
    template <class... Values>
    void all(const Values&... values)
    {
        (put(values), ...);
    }

    [[nodiscard]] std::string&& release() { return std::move(bytes_); }

private:
    std::string bytes_{kHead};
};

class Reader {
public:
    Reader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name)
    {
        if (bytes_.substr(0, kHead.size()) != kHead) {
            refuse("is not a windshield state");
        }
        bytes_.remove_prefix(kHead.size());
    }

    [[noreturn]] void refuse(const std::string& what) const
    {
        throw Error(ErrorCode::InvalidInput, name_ + " " + what);
    }
    void require(bool holds) const
    {
        if (!holds) {
            refuse("is damaged: a value is out of its range");
        }
    }

    void get(std::uint64_t& value)
    {
        if (bytes_.size() < 8) {
            refuse("is cut off");
        }
        value = 0;
        for (int k = 7; k >= 0; --k) {
            value = value << 8U | static_cast<unsigned char>(bytes_[static_cast<std::size_t>(k)]);
        }
        bytes_.remove_prefix(8);
    }
    void get(double& value)
    {
        std::uint64_t bits = 0;
        get(bits);
        value = std::bit_cast<double>(bits);
        require(std::isfinite(value));
    }
    void get(Vec2& value)
    {
        get(value.x);
        get(value.y);
    }
    void get(CompensatedSum& value)
    {
        get(value.sum);
        get(value.carry);
    }
    template <class... Values>
    void all(Values&... values)
    {
        (get(values), ...);
    }

    /// Length of the list that follows, checked against the remaining bytes.
    std::size_t count(std::size_t bytes_each)
    {
        std::uint64_t value = 0;
        get(value);
        if (value > bytes_.size() / bytes_each) {
            refuse("is cut off");
        }
        return static_cast<std::size_t>(value);
    }
    [[nodiscard]] bool ended() const { return bytes_.empty(); }

private:
    std::string_view bytes_;
    const std::string& name_;
};

/// Writes or reads all members of a state except the lists.
template <class Archive, class State>
void scalars(Archive& archive, State& s)
{
    archive.all(s.time, s.next_id, s.next_raindrop, s.until_raindrop, s.rained, s.left, s.wiped, s.merged, s.swept,
                s.shed, s.counts.raindrops, s.counts.merged, s.counts.swept, s.counts.grown, s.counts.torn,
                s.counts.left, s.counts.wiped);
}

}  // namespace

std::string bytesOf(const WindshieldState& state)
{
    Writer out;
    scalars(out, state);
    out.put(std::uint64_t{state.droplets.size()});
    for (const RunningDroplet& d : state.droplets) {
        out.all(d.id, d.position, d.velocity, d.volume, d.since_bead, d.beads);
    }
    out.put(std::uint64_t{state.tracks.size()});
    for (const TrackPiece& t : state.tracks) {
        out.all(t.id, t.from, t.to, t.radius);
    }
    const StillCells& still = StillCells::of(state.still);
    out.all(still.cell, std::uint64_t{still.columns}, std::uint64_t{still.rows});
    // Each cell begins with its revision and its number of droplets, in one value.
    for (std::size_t cell = 0; cell < still.counts.size(); ++cell) {
        out.put(std::uint64_t{still.revisions[cell]} << 8U | still.counts[cell]);
        for (const StillDroplet& d : still.droplets(cell)) {
            out.all(d.position, d.volume);
        }
    }
    return out.release();
}

WindshieldState stateFromBytes(std::string_view bytes, const std::string& name)
{
    Reader in(bytes, name);
    WindshieldState state;
    scalars(in, state);
    in.require(state.until_raindrop >= 0.0 && state.time >= 0.0);
    state.droplets.resize(in.count(64));
    std::uint64_t previous_id = 0;
    for (RunningDroplet& d : state.droplets) {
        in.all(d.id, d.position, d.velocity, d.volume, d.since_bead, d.beads);
        in.require(d.volume > 0.0 && d.id > previous_id && d.id < state.next_id);
        previous_id = d.id;
    }
    state.tracks.resize(in.count(48));
    for (TrackPiece& t : state.tracks) {
        in.all(t.id, t.from, t.to, t.radius);
    }
    std::uint64_t columns = 0;
    std::uint64_t rows = 0;
    StillCells& still = StillCells::of(state.still);
    in.all(still.cell, columns, rows);
    constexpr std::uint64_t kMax = std::numeric_limits<std::uint32_t>::max();
    in.require(still.cell > 0.0 && columns <= kMax && rows <= kMax && columns * rows <= bytes.size() / 8);
    still.columns = static_cast<std::uint32_t>(columns);
    still.rows = static_cast<std::uint32_t>(rows);
    const auto cells = static_cast<std::size_t>(columns * rows);
    still.counts.resize(cells);
    still.revisions.resize(cells);
    still.slots.resize(cells * StillCells::kMax);
    still.places.resize(still.slots.size());
    for (std::size_t cell = 0; cell < cells; ++cell) {
        std::uint64_t both = 0;
        in.get(both);
        in.require((both & 0xFFU) <= StillCells::kMax && both >> 8U <= kMax);
        for (std::uint64_t k = 0; k < (both & 0xFFU); ++k) {
            StillDroplet d;
            in.all(d.position, d.volume);
            in.require(d.volume > 0.0);
            still.put(cell, d);
        }
        still.revisions[cell] = static_cast<std::uint32_t>(both >> 8U);
    }
    in.require(in.ended());
    return state;
}

}  // namespace droplet

// SPDX-License-Identifier: GPL-3.0-or-later
// The thesis, sections 3.2.1 and 3.2.2: large droplets one by one, small ones as a map of the glass, both by the
// directions in which their normals refract what the driver sees.
#include "droplet/view/view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "picture/tone.h"
#include "view/backdrop.h"
#include "view/still_map.h"
#include "view/water_optics.h"

namespace droplet {
namespace {

constexpr int kTile = 16;  // [px] a side: what a thread works on at a time; its light stays in the first cache
constexpr std::size_t kTilePixels = std::size_t{kTile} * kTile;

void require(bool holds, const char* field, double value, const char* constraint)
{
    if (!holds) {
        throw Error(ErrorCode::InvalidArgument, std::string(field) + " " + std::to_string(value) + " " + constraint);
    }
}

/// A share in 255ths.
std::uint8_t level8(float share)
{
    return static_cast<std::uint8_t>(nearest(255.0F * share, 255));
}

struct Vec2f {
    float x = 0.0F;
    float y = 0.0F;
};

/// The glass at a place.
struct Frame {
    Vec3f across;
    Vec3f up;
    Vec3f normal;
};

Frame frameOf(const GlassPlace& place)
{
    return {toFloats(place.across), toFloats(place.up), toFloats(place.normal)};
}

Vec3f toFrame(const Frame& frame, Vec3f v)
{
    return {dot(v, frame.across), dot(v, frame.up), dot(v, frame.normal)};
}

Vec3f fromFrame(const Frame& frame, Vec3f v)
{
    return v.x * frame.across + v.y * frame.up + v.z * frame.normal;
}

/// What a ray through a still droplet shows. Kept as long as the droplet is there, whatever is behind the glass.
struct StillSample {
    std::uint32_t outside = 0;  ///< pixel of the backdrop
    std::uint8_t pixel = 0;     ///< of the tile
    std::uint8_t light = 0;     ///< share of it that gets through, in 255ths
    std::uint8_t cover = 0;     ///< in 255ths
};
static_assert(kTilePixels == 256, "a pixel's number in its tile is a byte");

struct Ray;

struct Tile {
    bool on_glass = false;
    Frame frame;         ///< of the glass in its middle
    Vec2f right;         ///< on the glass, a pixel to the right [m]
    Vec2f down;          ///< and one down
    float pixel = 0.0F;  ///< side of a square as large as a pixel's image on the glass [m]
    Vec2f low;           ///< box of what is seen of the glass [m]
    Vec2f high;
    std::vector<StillSample> samples;
    std::vector<const std::vector<Ray>*> droplets;  ///< that may run and reach into it, in their order
};

/// Cells of the still droplets in which something changed.
class ChangedCells {
public:
    ChangedCells(const StillDroplets& still, const std::vector<std::size_t>& changed)
        : columns_(static_cast<int>(still.columns)),
          rows_(static_cast<int>(still.rows)),
          per_metre_(static_cast<float>(1.0 / still.cell)),
          flags_(std::size_t{still.columns} * still.rows, 0)
    {
        for (const std::size_t cell : changed) {
            flags_[cell] = 1;
        }
    }

    /// Whether one is in a box [m].
    [[nodiscard]] bool reach(Vec2f low, Vec2f high) const
    {
        const int top = index(high.y, rows_);
        const int right = index(high.x, columns_);
        for (int row = index(low.y, rows_); row <= top; ++row) {
            for (int column = index(low.x, columns_); column <= right; ++column) {
                if (flags_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                           static_cast<std::size_t>(column)] != 0) {
                    return true;
                }
            }
        }
        return false;
    }

private:
    [[nodiscard]] int index(float place, int count) const
    {
        return static_cast<int>(std::clamp(place * per_metre_, 0.0F, static_cast<float>(count - 1)));
    }

    int columns_;
    int rows_;
    float per_metre_;
    std::vector<std::uint8_t> flags_;
};

/// What a ray through a droplet that may run shows.
struct Ray {
    PlaceInPicture place;
    std::uint8_t pixel = 0;  ///< of the tile
    std::uint8_t level = 0;  ///< of the backdrop
    std::uint8_t light = 0;  ///< share of it that gets through, in 255ths
    std::uint8_t cover = 0;  ///< of a ray's share of the pixel, in 255ths
    bool is_whole = false;   ///< it stands for the whole pixel
};

/// A droplet that may run, as it is drawn. Kept as long as it rests.
struct Drawn {
    RunningDroplet droplet;
    /// Its rays in a tile, those of a pixel one after another.
    struct Part {
        std::uint32_t tile = 0;
        std::vector<Ray> rays;
    };
    std::vector<Part> parts;
};

/// A droplet about to be traced.
struct Traced {
    Vec2f position;
    Vec2f along;  ///< unit, of its motion
    Frame frame;  ///< x along the motion
    Capsule capsule;
    float wide = 0.0F;            ///< radius of what is seen of the ends [m]
    std::uint8_t level = 0;       ///< of the backdrop
    std::uint8_t calm_level = 0;  ///< where there is one ray a pixel
    int left = 0;                 ///< pixels it may reach
    int right = -1;
    int top = 0;
    int bottom = -1;
};

}  // namespace

void ViewOptions::validate() const
{
    require(width >= 16 && width <= 8192, "width", width, "must be from 16 to 8192");
    require(height >= 16 && height <= 8192, "height", height, "must be from 16 to 8192");
    require(field_of_view >= kDegree && field_of_view <= 150.0 * kDegree, "field_of_view", field_of_view,
            "must be from 1 to 150 degrees");
    require(eye_distance >= 0.01 && eye_distance <= 100.0, "eye_distance", eye_distance, "must be from 0.01 to 100 m");
    if (aim) {
        require(std::isfinite(aim->x), "aim.x", aim->x, "must be finite");
        require(std::isfinite(aim->y), "aim.y", aim->y, "must be finite");
    }
    shape.validate();
    require(ior >= 1.0 && ior <= 2.0, "ior", ior, "must be from 1 to 2");
    require(samples >= 1 && samples <= 4, "samples", samples, "must be from 1 to 4");
    for (const double share : {glass_colour.x, glass_colour.y, glass_colour.z}) {
        require(share >= 0.0 && share <= 1.0, "glass_colour", share, "must be from 0 to 1");
    }
}

struct DriversView::Content {
    Content(const Glass& its_glass, const ViewOptions& its_options)
        : options(its_options),
          glass(its_glass),
          half_width(static_cast<float>(std::tan(0.5 * options.field_of_view))),
          tangent(2.0F * half_width / static_cast<float>(options.width)),
          backdrop(options.width, options.height, half_width, 0.5F * tangent * static_cast<float>(options.height)),
          columns((options.width + kTile - 1) / kTile),
          rows((options.height + kTile - 1) / kTile),
          tiles(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)),
          map(look(), options.shape.contact_angle)
    {
        bare.width = options.width;
        bare.height = options.height;
        bare.rgb.assign(3 * static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height), 0);
        // What dims light by a share dims levels by its 2.4th root, sRGB's but for the darkest.
        const std::array<double, 3> shares{options.glass_colour.x, options.glass_colour.y, options.glass_colour.z};
        for (std::size_t i = 0; i < through_pane.size(); ++i) {
            through_pane[i] = static_cast<std::uint16_t>(std::lround(256.0 * std::pow(shares[i % 3], 1.0 / 2.4)));
        }
        pane = Four{static_cast<float>(options.glass_colour.x), static_cast<float>(options.glass_colour.y),
                    static_cast<float>(options.glass_colour.z), 1.0F};
    }

    // ------------------------------------------------------------------------------------ where the eye's rays go

    [[nodiscard]] Vec3f ray(int x, int y) const
    {
        return unit({tangent * (static_cast<float>(x) + 0.5F - 0.5F * static_cast<float>(options.width)), 1.0F,
                     tangent * (0.5F * static_cast<float>(options.height) - static_cast<float>(y) - 0.5F)});
    }

    [[nodiscard]] std::size_t at(int x, int y) const
    {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(options.width) + static_cast<std::size_t>(x);
    }

    /// Finds every pixel's place on the glass, by drawing the glass as a net of triangles, and sets up the tiles.
    /// @return the part of the glass that is seen, and texels for it
    MapWindow look()
    {
        const Vec2 aim = options.aim.value_or(Vec2{0.5 * glass.width(), 0.5 * glass.height()});
        const auto ahead = glass.place(aim);
        if (!ahead) {
            throw Error(ErrorCode::InvalidArgument,
                        "aim (" + std::to_string(aim.x) + ", " + std::to_string(aim.y) + ") must be on the glass");
        }
        eye = ahead->point - Vec3{0.0, options.eye_distance, 0.0};
        constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();
        places.assign(static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height),
                      {kNowhere, kNowhere});
        drawNet();
        MapWindow window{{1e9, 1e9}, {-1e9, -1e9}, 0.0};
        float finest = std::numeric_limits<float>::infinity();
        for (int r = 0; r < rows; ++r) {
            for (int c = 0; c < columns; ++c) {
                Tile& tile = tileAt(c, r);
                setUp(tile, c, r);
                if (tile.on_glass) {
                    window.low = {std::min<double>(window.low.x, tile.low.x),
                                  std::min<double>(window.low.y, tile.low.y)};
                    window.high = {std::max<double>(window.high.x, tile.high.x),
                                   std::max<double>(window.high.y, tile.high.y)};
                    finest = std::min(finest, tile.pixel);
                }
            }
        }
        if (!(finest < std::numeric_limits<float>::infinity())) {
            throw Error(ErrorCode::InvalidArgument, "eye_distance " + std::to_string(options.eye_distance) +
                                                        ": nothing of the glass is seen from there");
        }
        // A texel for each ray; but no more than 128 MiB of them, and none finer than droplets have detail.
        constexpr double kMostTexels = 16e6;
        constexpr double kFinest = 2e-5;
        const double area = (window.high.x - window.low.x) * (window.high.y - window.low.y);
        window.texel =
            std::max({static_cast<double>(finest) / options.samples, std::sqrt(area / kMostTexels), kFinest});
        return window;
    }

    /// The glass as a net whose knots stand 4 mm apart: on a bend of 5 m, that is off by 0.4 µm.
    void drawNet()
    {
        constexpr double kApart = 4e-3;
        constexpr int kMost = 2048;
        const int across = std::clamp(static_cast<int>(std::ceil(glass.width() / kApart)), 1, kMost);
        const int upward = std::clamp(static_cast<int>(std::ceil(glass.height() / kApart)), 1, kMost);
        std::vector<std::optional<Vec3f>> knots(static_cast<std::size_t>(across + 1) *
                                                static_cast<std::size_t>(upward + 1));
        const auto position = [&](int i, int j) {
            return Vec2{glass.width() * i / across, glass.height() * j / upward};
        };
        const auto knot = [&](int i, int j) -> std::optional<Vec3f>& {
            return knots[static_cast<std::size_t>(j) * static_cast<std::size_t>(across + 1) +
                         static_cast<std::size_t>(i)];
        };
        tbb::parallel_for(0, upward + 1, [&](int j) {
            for (int i = 0; i <= across; ++i) {
                if (const auto place = glass.place(position(i, j))) {
                    knot(i, j) = toFloats(place->point - eye);
                }
            }
        });
        depths.assign(places.size(), std::numeric_limits<float>::infinity());
        for (int j = 0; j < upward; ++j) {
            for (int i = 0; i < across; ++i) {
                drawTriangle({knot(i, j), knot(i + 1, j), knot(i + 1, j + 1)},
                             {position(i, j), position(i + 1, j), position(i + 1, j + 1)});
                drawTriangle({knot(i, j), knot(i + 1, j + 1), knot(i, j + 1)},
                             {position(i, j), position(i + 1, j + 1), position(i, j + 1)});
            }
        }
        depths = {};
    }

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
            const float x = 0.5F * static_cast<float>(options.width) + corner->x / corner->y / tangent;
            const float y = 0.5F * static_cast<float>(options.height) - corner->z / corner->y / tangent;
            left = std::min(left, x);
            right = std::max(right, x);
            top = std::min(top, y);
            bottom = std::max(bottom, y);
        }
        const auto w = static_cast<float>(options.width);
        const auto h = static_cast<float>(options.height);
        if (right < 0.0F || left > w || bottom < 0.0F || top > h) {
            return;
        }
        const Vec3f& a = *corners[0];
        const Vec3f& b = *corners[1];
        const Vec3f& c = *corners[2];
        const std::array<Vec3f, 3> faces{cross(b, c), cross(c, a), cross(a, b)};
        const float volume = dot(a, faces[0]);
        for (int y = std::max(static_cast<int>(top - 1.0F), 0);
             y <= std::min(static_cast<int>(bottom + 1.0F), options.height - 1); ++y) {
            for (int x = std::max(static_cast<int>(left - 1.0F), 0);
                 x <= std::min(static_cast<int>(right + 1.0F), options.width - 1); ++x) {
                const Vec3f direction = ray(x, y);
                std::array<float, 3> shares{};
                for (std::size_t k = 0; k < 3; ++k) {
                    shares[k] = dot(direction, faces[k]);
                }
                const float sum = shares[0] + shares[1] + shares[2];
                // Neighbours share their edges to rounding; a pixel on one must not be missed by both.
                constexpr float kOutside = -1e-3F;
                if (sum == 0.0F || std::min({shares[0] / sum, shares[1] / sum, shares[2] / sum}) < kOutside) {
                    continue;
                }
                const float depth = volume / sum;
                if (depth > 0.0F && depth < depths[at(x, y)]) {
                    depths[at(x, y)] = depth;
                    double px = 0.0;
                    double py = 0.0;
                    for (std::size_t k = 0; k < 3; ++k) {
                        px += static_cast<double>(shares[k] / sum) * positions[k].x;
                        py += static_cast<double>(shares[k] / sum) * positions[k].y;
                    }
                    places[at(x, y)] = {static_cast<float>(px), static_cast<float>(py)};
                }
            }
        }
    }

    [[nodiscard]] Tile& tileAt(int column, int row)
    {
        return tiles[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(column)];
    }

    void setUp(Tile& tile, int column, int row)
    {
        const int x0 = column * kTile;
        const int y0 = row * kTile;
        const int x1 = std::min(x0 + kTile, options.width);
        const int y1 = std::min(y0 + kTile, options.height);
        tile.low = {1e9F, 1e9F};
        tile.high = {-1e9F, -1e9F};
        int nearest = std::numeric_limits<int>::max();
        Vec2f middle;
        bool has_steps = false;
        for (int y = y0; y < y1; ++y) {
            for (int x = x0; x < x1; ++x) {
                const Vec2f here = places[at(x, y)];
                if (std::isnan(here.x)) {
                    continue;
                }
                tile.on_glass = true;
                tile.low = {std::min(tile.low.x, here.x), std::min(tile.low.y, here.y)};
                tile.high = {std::max(tile.high.x, here.x), std::max(tile.high.y, here.y)};
                const int far = std::abs(2 * x - x0 - x1) + std::abs(2 * y - y0 - y1);
                const Vec2f right = places[at(std::min(x + 1, options.width - 1), y)];
                const Vec2f left = places[at(std::max(x - 1, 0), y)];
                const Vec2f above = places[at(x, std::max(y - 1, 0))];
                const Vec2f below = places[at(x, std::min(y + 1, options.height - 1))];
                const bool whole = !std::isnan(right.x + left.x + above.x + below.x);
                if ((whole && !has_steps) || (whole == has_steps && far < nearest)) {
                    nearest = far;
                    middle = here;
                    has_steps = whole;
                    if (whole) {
                        const auto columns_apart =
                            static_cast<float>(std::min(x + 1, options.width - 1) - std::max(x - 1, 0));
                        const auto rows_apart =
                            static_cast<float>(std::min(y + 1, options.height - 1) - std::max(y - 1, 0));
                        tile.right = {(right.x - left.x) / columns_apart, (right.y - left.y) / columns_apart};
                        tile.down = {(below.x - above.x) / rows_apart, (below.y - above.y) / rows_apart};
                    }
                }
            }
        }
        if (!tile.on_glass) {
            return;
        }
        const auto place = glass.place({static_cast<double>(middle.x), static_cast<double>(middle.y)});
        tile.pixel = std::sqrt(std::abs(tile.right.x * tile.down.y - tile.right.y * tile.down.x));
        if (!place || !(tile.pixel > 0.0F)) {
            tile.on_glass = false;  // a sliver at the glass's edge
            return;
        }
        tile.frame = frameOf(*place);
        const float reach =
            std::abs(tile.right.x) + std::abs(tile.right.y) + std::abs(tile.down.x) + std::abs(tile.down.y);
        tile.low = {tile.low.x - reach, tile.low.y - reach};
        tile.high = {tile.high.x + reach, tile.high.y + reach};
    }

    // ------------------------------------------------------------------------------------ water

    void show(const WindshieldState& state)
    {
        const std::vector<std::size_t> changed = map.follow(state.still);
        if (!changed.empty()) {
            sampleAgain(state.still, changed);
        }
        prepare(state.droplets);
    }

    void sampleAgain(const StillDroplets& still, const std::vector<std::size_t>& changed)
    {
        const ChangedCells cells(still, changed);
        tbb::parallel_for(0, rows, [&](int r) {
            for (int c = 0; c < columns; ++c) {
                Tile& tile = tileAt(c, r);
                if (tile.on_glass && cells.reach(tile.low, tile.high)) {
                    sample(tile, c, r, cells);
                }
            }
        });
    }

    /// Place of a ray within a pixel, from its middle: one of n in a row.
    [[nodiscard]] float offset(int k) const
    {
        return (static_cast<float>(k) + 0.5F) / static_cast<float>(options.samples) - 0.5F;
    }

    /// Backdrop pixels that a ray through a droplet stands for: across a droplet goes about the whole picture.
    /// @param diameter  [px]
    [[nodiscard]] std::uint8_t levelFor(float diameter) const
    {
        constexpr float kShare = 0.8F;
        return backdrop.levelOf(kShare * static_cast<float>(options.width) /
                                std::max(diameter * static_cast<float>(options.samples), 1.0F));
    }

    /// Makes samples anew of those pixels that see a cell that changed.
    void sample(Tile& tile, int column, int row, const ChangedCells& cells)
    {
        const std::vector<StillSample> before = std::exchange(tile.samples, {});
        tile.samples.reserve(before.size() + kTilePixels);
        auto old = before.begin();
        // A texel is the cell's in which its middle lies.
        const float margin = 1.0F / map.perMetre();
        const Vec2f half{0.5F * (std::abs(tile.right.x) + std::abs(tile.down.x)) + margin,
                         0.5F * (std::abs(tile.right.y) + std::abs(tile.down.y)) + margin};
        const auto ior = static_cast<float>(options.ior);
        const float quarter = 0.25F / map.perMetre();  // of a texel
        std::uint8_t size = 0;                         // of the droplet met last, and the level for it
        std::uint8_t level = 0;
        for (int y = row * kTile; y < std::min((row + 1) * kTile, options.height); ++y) {
            for (int x = column * kTile; x < std::min((column + 1) * kTile, options.width); ++x) {
                const Vec2f middle = places[at(x, y)];
                if (std::isnan(middle.x)) {
                    continue;
                }
                const auto pixel = static_cast<std::uint8_t>((y % kTile) * kTile + x % kTile);
                const auto first = old;
                while (old != before.end() && old->pixel == pixel) {
                    ++old;
                }
                if (!cells.reach({middle.x - half.x, middle.y - half.y}, {middle.x + half.x, middle.y + half.y})) {
                    tile.samples.insert(tile.samples.end(), first, old);
                    continue;
                }
                for (int j = 0; j < options.samples; ++j) {
                    for (int i = 0; i < options.samples; ++i) {
                        const float u = offset(i);
                        const float v = offset(j);
                        const Texel seen = map.at(middle.x + u * tile.right.x + v * tile.down.x,
                                                  middle.y + u * tile.right.y + v * tile.down.y);
                        if (seen.empty()) {
                            continue;
                        }
                        const Vec3f inside = intoWater(toFrame(tile.frame, ray(x, y)), ior);
                        const Interface out = intoAir(inside, seen.normal(), ior);
                        StillSample sample;
                        sample.pixel = pixel;
                        sample.cover = static_cast<std::uint8_t>(seen.cover());
                        sample.light = level8(1.0F - out.reflected);
                        if (out.reflected < 1.0F) {
                            if (seen.size() != size) {
                                size = seen.size();
                                level = levelFor(2.0F * quarter * static_cast<float>(size) / tile.pixel);
                            }
                            const Vec3f outside = fromFrame(tile.frame, out.transmitted);
                            sample.outside = backdrop.pixelAt(backdrop.placeOf(outside), level);
                        }
                        tile.samples.push_back(sample);
                    }
                }
            }
        }
    }

    void prepare(const std::vector<RunningDroplet>& droplets)
    {
        std::vector<Drawn> next(droplets.size());
        // What rests where it was is as it was; both are in the order of their ids.
        auto before = drawn.begin();
        for (std::size_t k = 0; k < droplets.size(); ++k) {
            const RunningDroplet& droplet = droplets[k];
            before = std::find_if(before, drawn.end(), [&](const Drawn& one) { return one.droplet.id >= droplet.id; });
            if (before != drawn.end() && before->droplet.id == droplet.id &&
                before->droplet.position == droplet.position && before->droplet.velocity == droplet.velocity &&
                before->droplet.volume == droplet.volume) {
                next[k] = std::move(*before);
            }
        }
        constexpr std::size_t kWorthAThread = 32;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, droplets.size(), kWorthAThread), [&](const auto& range) {
            for (std::size_t k = range.begin(); k < range.end(); ++k) {
                if (next[k].droplet.volume == 0.0) {
                    next[k].droplet = droplets[k];
                    next[k].parts = trace(prepared(droplets[k]));
                }
            }
        });
        drawn = std::move(next);
        for (Tile& tile : tiles) {
            tile.droplets.clear();
        }
        for (const Drawn& one : drawn) {
            for (const Drawn::Part& part : one.parts) {
                tiles[part.tile].droplets.push_back(&part.rays);
            }
        }
    }

    [[nodiscard]] Traced prepared(const RunningDroplet& droplet) const
    {
        Traced one;
        const auto place = glass.place(droplet.position);
        if (!place) {
            return one;
        }
        const double speed = length(droplet.velocity);
        const Vec2 along = speed > 0.0 ? (1.0 / speed) * droplet.velocity : Vec2{1.0, 0.0};
        const RunningShape shape = runningShape(droplet.volume, speed, options.shape);
        const Vec3 right = along.x * place->across + along.y * place->up;
        const Vec3 left = along.x * place->up - along.y * place->across;
        one.position = {static_cast<float>(droplet.position.x), static_cast<float>(droplet.position.y)};
        one.along = {static_cast<float>(along.x), static_cast<float>(along.y)};
        one.frame = {toFloats(right), toFloats(left), toFloats(place->normal)};
        one.capsule = {static_cast<float>(shape.half_length), static_cast<float>(shape.radius),
                       static_cast<float>(shape.centre_height)};
        one.wide = static_cast<float>(shape.silhouette());
        const double reach = shape.half_length + shape.silhouette();
        float left_most = 1e9F;
        float right_most = -1e9F;
        float top = 1e9F;
        float bottom = -1e9F;
        for (const double x : {-reach, reach}) {
            for (const double y : {-shape.silhouette(), shape.silhouette()}) {
                const Vec3 corner = place->point + x * right + y * left - eye;
                if (corner.y < 1e-3) {
                    return one;
                }
                const auto px =
                    static_cast<float>(corner.x / corner.y) / tangent + 0.5F * static_cast<float>(options.width);
                const auto py =
                    0.5F * static_cast<float>(options.height) - static_cast<float>(corner.z / corner.y) / tangent;
                left_most = std::min(left_most, px);
                right_most = std::max(right_most, px);
                top = std::min(top, py);
                bottom = std::max(bottom, py);
            }
        }
        constexpr float kRim = 2.0F;  // [px] of soft edge, and of the glass's bend
        const auto w = static_cast<float>(options.width);
        const auto h = static_cast<float>(options.height);
        if (right_most < -kRim || left_most > w + kRim || bottom < -kRim || top > h + kRim) {
            return one;
        }
        one.left = static_cast<int>(std::max(left_most - kRim, 0.0F));
        one.right = static_cast<int>(std::min(right_most + kRim, w - 1.0F));
        one.top = static_cast<int>(std::max(top - kRim, 0.0F));
        one.bottom = static_cast<int>(std::min(bottom + kRim, h - 1.0F));
        const Tile& tile =
            tiles[static_cast<std::size_t>((one.top + one.bottom) / 2 / kTile) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>((one.left + one.right) / 2 / kTile)];
        const float diameter = tile.on_glass ? 2.0F * one.wide / tile.pixel : right_most - left_most;
        one.level = levelFor(diameter);
        one.calm_level = levelFor(diameter / static_cast<float>(options.samples));
        return one;
    }

    [[nodiscard]] std::vector<Drawn::Part> trace(const Traced& one) const
    {
        std::vector<Drawn::Part> parts;
        for (int r = one.top / kTile; r <= one.bottom / kTile && one.bottom >= 0; ++r) {
            for (int c = one.left / kTile; c <= one.right / kTile && one.right >= 0; ++c) {
                const auto number = static_cast<std::uint32_t>(r * columns + c);
                Drawn::Part part{number, {}};
                trace(one, tiles[number], c, r, part.rays);
                if (!part.rays.empty()) {
                    parts.push_back(std::move(part));
                }
            }
        }
        return parts;
    }

    void trace(const Traced& one, const Tile& tile, int column, int row, std::vector<Ray>& rays) const
    {
        const auto ior = static_cast<float>(options.ior);
        const int n = options.samples;
        const float soft = tile.pixel / static_cast<float>(n);
        // In its middle a droplet is smooth: a ray a pixel does.
        const float calm = 0.6F * one.wide - tile.pixel;
        const auto beyond_line = [&](float along) { return std::max(std::abs(along) - one.capsule.half_length, 0.0F); };
        for (int y = std::max(one.top, row * kTile); y <= std::min(one.bottom, row * kTile + kTile - 1); ++y) {
            for (int x = std::max(one.left, column * kTile); x <= std::min(one.right, column * kTile + kTile - 1);
                 ++x) {
                const Vec2f middle = places[at(x, y)];
                if (std::isnan(middle.x)) {
                    continue;
                }
                const float dx = middle.x - one.position.x;
                const float dy = middle.y - one.position.y;
                const float past = beyond_line(one.along.x * dx + one.along.y * dy);
                const float aside = one.along.x * dy - one.along.y * dx;
                const float far2 = past * past + aside * aside;
                const float out = one.wide + 2.0F * tile.pixel;
                if (far2 > out * out) {
                    continue;
                }
                const Vec3f inside = intoWater(toFrame(one.frame, ray(x, y)), ior);
                // A ray so far from the pixel's middle.
                const auto add = [&](float u, float v, bool is_whole) {
                    const float ex = dx + u * tile.right.x + v * tile.down.x;
                    const float ey = dy + u * tile.right.y + v * tile.down.y;
                    const float a = one.along.x * ex + one.along.y * ey;
                    const float b = one.along.x * ey - one.along.y * ex;
                    const float end = beyond_line(a);
                    const float cover = std::min((one.wide - std::sqrt(end * end + b * b)) / soft + 0.5F, 1.0F);
                    if (cover <= 0.0F) {
                        return;
                    }
                    const Interface met = intoAir(inside, normalAtExit(one.capsule, {a, b, 0.0F}, inside), ior);
                    Ray found;
                    found.pixel = static_cast<std::uint8_t>((y % kTile) * kTile + x % kTile);
                    found.cover = level8(cover);
                    found.is_whole = is_whole;
                    if (met.reflected < 1.0F) {
                        found.place = backdrop.placeOf(fromFrame(one.frame, met.transmitted));
                        found.level = is_whole ? one.calm_level : one.level;
                        found.light = level8(1.0F - met.reflected);
                    }
                    rays.push_back(found);
                };
                if (far2 < calm * std::abs(calm)) {
                    add(0.0F, 0.0F, true);
                } else {
                    for (int j = 0; j < n; ++j) {
                        for (int i = 0; i < n; ++i) {
                            add(offset(i), offset(j), false);
                        }
                    }
                }
            }
        }
    }

    // ------------------------------------------------------------------------------------ light

    /// Light of a tile's droplets, premultiplied by what they cover.
    void shine(const Tile& tile, std::array<Four, kTilePixels>& light) const
    {
        light.fill(four(0.0F));
        const float share = 1.0F / (255.0F * static_cast<float>(options.samples * options.samples));
        for (const StillSample& sample : tile.samples) {
            light[sample.pixel] += four(share * static_cast<float>(sample.cover)) *
                                   seen(backdrop.at(sample.outside), static_cast<float>(sample.light) / 255.0F);
        }
        for (const std::vector<Ray>* rays : tile.droplets) {
            for (auto ray = rays->begin(); ray != rays->end();) {
                const std::uint8_t pixel = ray->pixel;
                Four sum = four(0.0F);
                for (; ray != rays->end() && ray->pixel == pixel; ++ray) {
                    const float part = (ray->is_whole ? 1.0F / 255.0F : share) * static_cast<float>(ray->cover);
                    const Four outside = ray->light > 0 ? backdrop.at(ray->place, ray->level) : cabin;
                    sum += four(part) * seen(outside, static_cast<float>(ray->light) / 255.0F);
                }
                light[pixel] = sum + four(1.0F - sum[3]) * light[pixel];
            }
        }
    }

    /// What is seen along a ray of which a share gets out and the rest is led back inside.
    [[nodiscard]] Four seen(Four outside, float share) const
    {
        return pane * (cabin + four(share) * (outside - cabin));
    }

    /// Calls take(x, y, red, green, blue, alpha) for every pixel, in parallel; tiles without water are skipped.
    template <typename Take>
    void forWet(const Take& take) const
    {
        tbb::parallel_for(0, rows, [&](int r) {
            std::array<Four, kTilePixels> light;
            const EncodedLevels& levels = encodedLevels();
            for (int c = 0; c < columns; ++c) {
                const Tile& tile = tiles[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) +
                                         static_cast<std::size_t>(c)];
                if (tile.samples.empty() && tile.droplets.empty()) {
                    continue;
                }
                shine(tile, light);
                for (int y = r * kTile; y < std::min((r + 1) * kTile, options.height); ++y) {
                    for (int x = c * kTile; x < std::min((c + 1) * kTile, options.width); ++x) {
                        const Four& pixel =
                            light[static_cast<std::size_t>(y % kTile) * kTile + static_cast<std::size_t>(x % kTile)];
                        const std::uint32_t alpha = level8(pixel[3]);
                        if (alpha > 0) {
                            const Four straight = four(1.0F / pixel[3]) * pixel;
                            take(at(x, y), encoded(straight[0], levels), encoded(straight[1], levels),
                                 encoded(straight[2], levels), alpha);
                        }
                    }
                }
            }
        });
    }

    ViewOptions options;
    Glass glass;
    float half_width;  ///< tangent of half the field of view
    float tangent;     ///< across a pixel
    Vec3 eye;
    std::vector<Vec2f> places;  ///< on the glass, of each pixel [m]; NaN: beside it
    std::vector<float> depths;  ///< while the glass is drawn
    Backdrop backdrop;
    int columns;  ///< of tiles
    int rows;
    std::vector<Tile> tiles;
    StillMap map;
    Picture bare;
    std::array<std::uint16_t, 48> through_pane{};  ///< of levels, in 256ths, for 16 pixels
    Four pane{};
    Four cabin{0.0F, 0.0F, 0.0F, 1.0F};  ///< light of what is inside
    std::vector<Drawn> drawn;
};

DriversView::DriversView(const Glass& glass, const ViewOptions& options)
{
    options.validate();
    content_ = std::make_unique<Content>(glass, options);
}

DriversView::~DriversView() = default;
DriversView::DriversView(DriversView&&) noexcept = default;
DriversView& DriversView::operator=(DriversView&&) noexcept = default;

void DriversView::lookAt(const Picture& picture)
{
    picture.validate();
    Content& content = *content_;
    if (picture.width != content.options.width || picture.height != content.options.height) {
        throw Error(ErrorCode::InvalidArgument, "picture of " + std::to_string(picture.width) + " by " +
                                                    std::to_string(picture.height) + " pixels must be of the frame's " +
                                                    std::to_string(content.options.width) + " by " +
                                                    std::to_string(content.options.height));
    }
    content.backdrop.take(picture);
    // As dark as it is behind the eye, by eye: a tenth of what is ahead.
    content.cabin = Four{0.1F, 0.1F, 0.1F, 1.0F} * content.backdrop.mean();
    const std::array<std::uint16_t, 48> shares = content.through_pane;
    const std::uint8_t* const from = picture.rgb.data();
    std::uint8_t* const to = content.bare.rgb.data();
    constexpr std::size_t kRun = 48;  // as many as are done at once
    constexpr std::size_t kRunsWorthAThread = 512;
    const std::size_t runs = picture.rgb.size() / kRun;
    const auto dim = [&](std::size_t at, std::size_t k) {
        to[at + k] = static_cast<std::uint8_t>((from[at + k] * shares[k] + 128) >> 8);
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, runs, kRunsWorthAThread), [&](const auto& range) {
        for (std::size_t run = range.begin(); run < range.end(); ++run) {
            for (std::size_t k = 0; k < kRun; ++k) {
                dim(run * kRun, k);
            }
        }
    });
    for (std::size_t k = 0; runs * kRun + k < picture.rgb.size(); ++k) {
        dim(runs * kRun, k);
    }
}

void DriversView::show(const WindshieldState& state)
{
    content_->show(state);
}

const Picture& DriversView::bare() const
{
    return content_->bare;
}

Layer DriversView::layer() const
{
    const Content& content = *content_;
    Layer layer{content.options.width, content.options.height, {}};
    layer.rgba.assign(content.bare.rgb.size() / 3 * 4, 0);
    content.forWet(
        [&](std::size_t pixel, std::uint8_t red, std::uint8_t green, std::uint8_t blue, std::uint32_t alpha) {
            std::uint8_t* const to = layer.rgba.data() + 4 * pixel;
            to[0] = red;
            to[1] = green;
            to[2] = blue;
            to[3] = static_cast<std::uint8_t>(alpha);
        });
    return layer;
}

Picture DriversView::frame() const
{
    const Content& content = *content_;
    Picture frame = content.bare;
    content.forWet(
        [&](std::size_t pixel, std::uint8_t red, std::uint8_t green, std::uint8_t blue, std::uint32_t alpha) {
            std::uint8_t* const to = frame.rgb.data() + 3 * pixel;
            to[0] = mixedLevel(red, to[0], alpha);
            to[1] = mixedLevel(green, to[1], alpha);
            to[2] = mixedLevel(blue, to[2], alpha);
        });
    return frame;
}

std::optional<Vec2> DriversView::onGlass(int x, int y) const
{
    const Content& content = *content_;
    if (x < 0 || y < 0 || x >= content.options.width || y >= content.options.height) {
        return std::nullopt;
    }
    const Vec2f place = content.places[content.at(x, y)];
    return std::isnan(place.x) ? std::nullopt
                               : std::optional(Vec2{static_cast<double>(place.x), static_cast<double>(place.y)});
}

std::size_t DriversView::cellsDrawn() const
{
    return content_->map.cellsDrawn();
}

}  // namespace droplet

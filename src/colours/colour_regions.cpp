// SPDX-License-Identifier: GPL-3.0-or-later
//
// Colours are compared by their distance in CIE 1976 L*a*b* (D65). Groups are merged as in J. H. Ward, "Hierarchical
// grouping to optimize an objective function" (1963), and refined as in S. P. Lloyd, "Least squares quantization in
// PCM" (1982).
#include "droplet/colours/colour_regions.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <opencv2/core.hpp>

#include "droplet/error.h"
#include "droplet/vector.h"
#include "image/image.h"
#include "image/image_file.h"
#include "image/rgb.h"

namespace droplet {
namespace {

constexpr double kSame = 16.0;          ///< distance in Lab up to which colours of a picture become one
constexpr double kSameAsBorder = 12.0;  ///< likewise for the background
constexpr double kFine = 4.0;           ///< likewise before colours are merged to a number
constexpr std::size_t kMaxFound = 12;   ///< colours found without a number
constexpr double kMinShare = 1e-3;      ///< of all even pixels; rarer colours are not found without a number
constexpr double kMinThinShare = 3e-3;  ///< likewise for colours of lines that are too thin for an even part
constexpr double kBorderShare = 0.95;
constexpr int kEven = 8;  ///< range of a channel around a pixel of an even part

double squared(Vec3 a)
{
    return dot(a, a);
}

CssColour rounded(Vec3 rgb)
{
    const auto byte = [](double level) {
        return static_cast<std::uint8_t>(std::lround(std::clamp(level, 0.0, 255.0)));
    };
    return {byte(rgb.x), byte(rgb.y), byte(rgb.z)};
}

/// Colours that are nearly the same.
struct Bin {
    std::size_t count = 0;
    bool is_thin = false;  ///< of lines, not of even parts
    std::array<std::uint64_t, 3> sum{};

    void add(const Rgb& colour)
    {
        ++count;
        for (std::size_t c = 0; c < 3; ++c) {
            sum[c] += colour[c];
        }
    }
    [[nodiscard]] Vec3 mean() const
    {
        const auto n = static_cast<double>(count);
        return {static_cast<double>(sum[0]) / n, static_cast<double>(sum[1]) / n, static_cast<double>(sum[2]) / n};
    }
};

constexpr int kShift = 3;  // 32 bins per channel

std::size_t binOf(const Rgb& colour)
{
    constexpr unsigned kBits = 8U - kShift;
    return (static_cast<std::size_t>(colour[0] >> kShift) << (2 * kBits)) |
           (static_cast<std::size_t>(colour[1] >> kShift) << kBits) | static_cast<std::size_t>(colour[2] >> kShift);
}

std::vector<Bin> emptyBins()
{
    return std::vector<Bin>(std::size_t{1} << (3 * (8 - kShift)));
}

/// Bins with colours, the most common first.
std::vector<Bin> sortedBins(std::vector<Bin> bins)
{
    std::erase_if(bins, [](const Bin& bin) { return bin.count == 0; });
    std::stable_sort(bins.begin(), bins.end(), [](const Bin& a, const Bin& b) { return a.count > b.count; });
    return bins;
}

/// Group of colours.
struct Group {
    Vec3 lab;               ///< mean
    double weight = 0.0;    ///< number of pixels
    Vec3 rgb;               ///< mean
    Bin common;             ///< its most common bin
    bool is_fixed = false;  ///< background
    bool is_thin = true;    ///< has no even part
};

/// Picture being sorted.
class Sorter {
public:
    Sorter(Image image, const ColourOptions& options) : image_(std::move(image)), options_(options) {}

    ColourRegions sort()
    {
        ColourRegions result;
        result.width = image_.width;
        result.height = image_.height;
        result.raster_scale = image_.raster_scale;
        result.physical_width = image_.physical_width;
        result.lacking = image_.lacking;
        findColours();
        if (liquidGroups() == 0) {
            throw Error(ErrorCode::InvalidInput, "the picture has no colour but that of its border" +
                                                     (background_ ? ", " + text(*background_) : std::string()));
        }
        label(result);
        nameColours(result);
        result.background = background_;
        result.colour = std::move(image_.colour);
        result.alpha = std::move(image_.alpha);
        return result;
    }

    std::vector<PaletteColour> palette()
    {
        findColours();
        std::vector<PaletteColour> found;
        for (const Group& group : groups_) {
            if (!group.is_fixed) {
                found.push_back({rounded(group.rgb), static_cast<std::size_t>(group.weight)});
            }
        }
        return found;
    }

private:
    static constexpr std::uint16_t kHalf = 1 << 15;

    void findColours()
    {
        straighten();
        const bool transparent =
            std::any_of(image_.alpha.begin(), image_.alpha.end(), [](std::uint16_t a) { return a < kHalf; });
        if (!transparent) {
            image_.alpha.clear();
        }
        if (options_.channel == Channel::Luma || (options_.channel == Channel::Auto && !transparent)) {
            background_ = borderColour(options_.channel == Channel::Luma ? 0.0 : kBorderShare);
        }
        findGroups();
    }

    [[nodiscard]] std::size_t at(int x, int y) const
    {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) + static_cast<std::size_t>(x);
    }
    [[nodiscard]] bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < image_.width && y < image_.height; }
    [[nodiscard]] bool isOpaque(std::size_t i) const { return image_.alpha.empty() || image_.alpha[i] >= kHalf; }

    /// Takes the weight by alpha off the colours.
    void straighten()
    {
        if (!image_.premultiplied || image_.alpha.empty()) {
            return;
        }
        tbb::parallel_for(0, image_.height, [&](int y) {
            for (int x = 0; x < image_.width; ++x) {
                const unsigned alpha = std::max<unsigned>(1, image_.alpha[at(x, y)]);
                for (std::uint8_t& level : image_.colour[at(x, y)]) {
                    level = static_cast<std::uint8_t>(std::min(255U, (level * 65535U + alpha / 2) / alpha));
                }
            }
        });
    }

    /// Most common colour of the border, if it has a share of the border.
    [[nodiscard]] std::optional<CssColour> borderColour(double min_share) const
    {
        std::vector<Rgb> border;
        const auto add = [&](int x, int y) {
            if (isOpaque(at(x, y))) {
                border.push_back(image_.colour[at(x, y)]);
            }
        };
        for (int x = 0; x < image_.width; ++x) {
            add(x, 0);
            add(x, image_.height - 1);
        }
        for (int y = 1; y + 1 < image_.height; ++y) {
            add(0, y);
            add(image_.width - 1, y);
        }
        if (border.empty()) {
            return std::nullopt;
        }
        std::vector<Bin> bins = emptyBins();
        for (const Rgb& colour : border) {
            bins[binOf(colour)].add(colour);
        }
        const Vec3 common = sortedBins(std::move(bins)).front().mean();
        const auto alike = std::count_if(border.begin(), border.end(), [&](const Rgb& colour) {
            return squared(labOf(vectorOf(colour)) - labOf(common)) <= kSameAsBorder * kSameAsBorder;
        });
        return static_cast<double>(alike) >= min_share * static_cast<double>(border.size())
                   ? std::optional(rounded(common))
                   : std::nullopt;
    }

    /// Whether all colours around an opaque pixel are nearly the same.
    [[nodiscard]] bool isEven(int x, int y, int range) const
    {
        Rgb low{255, 255, 255};
        Rgb high{0, 0, 0};
        for (int v = std::max(0, y - 1); v <= std::min(image_.height - 1, y + 1); ++v) {
            for (int u = std::max(0, x - 1); u <= std::min(image_.width - 1, x + 1); ++u) {
                if (!isOpaque(at(u, v))) {
                    return false;
                }
                for (std::size_t c = 0; c < 3; ++c) {
                    low[c] = std::min(low[c], image_.colour[at(u, v)][c]);
                    high[c] = std::max(high[c], image_.colour[at(u, v)][c]);
                }
            }
        }
        return high[0] - low[0] <= range && high[1] - low[1] <= range && high[2] - low[2] <= range;
    }

    /// Colours of even parts, or of rougher ones if less than a tenth of the picture is even; then those of thin lines.
    [[nodiscard]] std::vector<Bin> evenColours() const
    {
        constexpr double kEnough = 0.1;
        std::size_t opaque = 0;
        for (std::size_t i = 0; i < image_.colour.size(); ++i) {
            opaque += isOpaque(i) ? 1 : 0;
        }
        for (const int range : {kEven, 3 * kEven, 255}) {
            std::vector<Bin> bins = emptyBins();
            std::vector<Bin> thin = emptyBins();
            std::size_t count = 0;
            for (int y = 0; y < image_.height; ++y) {
                for (int x = 0; x < image_.width; ++x) {
                    const Rgb& colour = image_.colour[at(x, y)];
                    if (!isOpaque(at(x, y))) {
                        continue;
                    }
                    if (range == 255 || isEven(x, y, range)) {
                        bins[binOf(colour)].add(colour);
                        ++count;
                    } else if (!isBetween(x, y)) {
                        thin[binOf(colour)].add(colour);
                        thin[binOf(colour)].is_thin = true;
                    }
                }
            }
            if (static_cast<double>(count) >= kEnough * static_cast<double>(opaque) && count > 0) {
                bins = sortedBins(std::move(bins));
                const std::vector<Bin> lines = sortedBins(std::move(thin));
                bins.insert(bins.end(), lines.begin(), lines.end());
                return bins;
            }
        }
        return {};
    }

    [[nodiscard]] std::size_t nearestGroup(Vec3 lab) const
    {
        std::size_t best = 0;
        double distance = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < groups_.size(); ++k) {
            const double here = squared(lab - groups_[k].lab);
            if (here < distance) {
                distance = here;
                best = k;
            }
        }
        return best;
    }

    /// Gives every bin to its nearest group, and moves groups to their means. The background stays in its place.
    void refine(const std::vector<Bin>& bins, const std::vector<Vec3>& labs)
    {
        std::vector<Vec3> lab(groups_.size());
        std::vector<Vec3> rgb(groups_.size());
        for (Group& group : groups_) {
            group.weight = 0.0;
            group.common = {};
            group.is_thin = true;
        }
        for (std::size_t i = 0; i < bins.size(); ++i) {
            const std::size_t k = nearestGroup(labs[i]);
            const auto weight = static_cast<double>(bins[i].count);
            groups_[k].weight += weight;
            groups_[k].is_thin = groups_[k].is_thin && bins[i].is_thin;
            lab[k] = lab[k] + weight * labs[i];
            rgb[k] = rgb[k] + weight * bins[i].mean();
            if (bins[i].count > groups_[k].common.count) {
                groups_[k].common = bins[i];
            }
        }
        for (std::size_t k = 0; k < groups_.size(); ++k) {
            Group& group = groups_[k];
            if (group.weight > 0.0 && !group.is_fixed) {
                group.lab = (1.0 / group.weight) * lab[k];
                group.rgb = (1.0 / group.weight) * rgb[k];
            }
        }
        std::erase_if(groups_, [](const Group& group) { return group.weight == 0.0 && !group.is_fixed; });
    }

    [[nodiscard]] std::size_t liquidGroups() const { return groups_.size() - (background_ ? 1 : 0); }

    /// Merges the two groups whose union costs least, by Ward's measure, or that are nearest.
    /// @param within  merges only groups at most this far apart
    /// @return        whether there were two
    bool mergeOnce(double within)
    {
        double least = std::numeric_limits<double>::infinity();
        std::size_t first = 0;
        std::size_t second = 0;
        for (std::size_t i = 0; i < groups_.size(); ++i) {
            for (std::size_t j = i + 1; j < groups_.size(); ++j) {
                const double distance = squared(groups_[i].lab - groups_[j].lab);
                const double cost =
                    groups_[i].weight * groups_[j].weight / (groups_[i].weight + groups_[j].weight) * distance;
                if (!groups_[i].is_fixed && !groups_[j].is_fixed && distance <= within * within && cost < least) {
                    least = cost;
                    first = i;
                    second = j;
                }
            }
        }
        if (first == second) {
            return false;
        }
        Group& a = groups_[first];
        const Group& b = groups_[second];
        a.lab = (1.0 / (a.weight + b.weight)) * (a.weight * a.lab + b.weight * b.lab);
        a.weight += b.weight;
        groups_.erase(groups_.begin() + static_cast<std::ptrdiff_t>(second));
        return true;
    }

    void findGroups()
    {
        const std::vector<Bin> bins = evenColours();
        std::vector<Vec3> labs;
        double total = 0.0;
        for (const Bin& bin : bins) {
            labs.push_back(labOf(bin.mean()));
            total += static_cast<double>(bin.count);
        }
        if (background_) {
            Group& group = groups_.emplace_back();
            group.rgb = vectorOf(*background_);
            group.lab = labOf(group.rgb);
            group.is_fixed = true;
        }
        // Enough groups for any number of colours, few enough to compare all pairs.
        constexpr std::size_t kMost = 256;
        const double apart = options_.colours ? kFine : kSame;
        for (std::size_t i = 0; i < bins.size() && groups_.size() < kMost; ++i) {
            const bool is_known = std::any_of(groups_.begin(), groups_.end(), [&](const Group& group) {
                const double own = group.is_fixed ? kSameAsBorder : apart;
                return squared(group.lab - labs[i]) <= own * own;
            });
            if (!is_known) {
                Group& group = groups_.emplace_back();
                group.lab = labs[i];
                group.rgb = bins[i].mean();
            }
        }
        constexpr int kRounds = 12;
        const auto settle = [&] {
            for (int k = 0; k < kRounds; ++k) {
                refine(bins, labs);
            }
        };
        settle();
        if (!options_.colours) {
            std::erase_if(groups_, [&](const Group& group) {
                return !group.is_fixed && group.weight < (group.is_thin ? kMinThinShare : kMinShare) * total;
            });
            while (mergeOnce(kSame)) {
            }
        }
        const std::size_t wanted = options_.colours.value_or(kMaxFound);
        while (liquidGroups() > wanted && mergeOnce(std::numeric_limits<double>::infinity())) {
        }
        settle();
        std::stable_sort(groups_.begin(), groups_.end(), [](const Group& a, const Group& b) {
            return a.is_fixed != b.is_fixed ? a.is_fixed : a.weight > b.weight;
        });
        for (Group& group : groups_) {
            // A drawing has one colour exactly; a photograph has many alike.
            constexpr double kDominates = 0.3;
            if (!group.is_fixed && static_cast<double>(group.common.count) >= kDominates * group.weight) {
                group.rgb = group.common.mean();
            }
        }
    }

    /// Label of a group: the background, if there is one, is the first group.
    [[nodiscard]] std::uint8_t labelOf(std::size_t group) const
    {
        return static_cast<std::uint8_t>(background_ ? group : group + 1);
    }
    [[nodiscard]] Vec3 colourOf(std::uint8_t label) const { return groups_[background_ ? label : label - 1U].rgb; }

    /// Whether a pixel lies between the colours on opposite sides of it.
    [[nodiscard]] bool isBetween(int x, int y) const
    {
        constexpr std::array<std::array<int, 2>, 4> kWays{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
        constexpr double kMinStep = 30.0;  // [levels]
        constexpr double kOff = 0.2;
        constexpr double kEnd = 0.06;
        const Vec3 here = vectorOf(image_.colour[at(x, y)]);
        for (const auto& way : kWays) {
            for (const int before : {1, 2}) {
                for (const int after : {1, 2}) {
                    const int u = x - before * way[0];
                    const int v = y - before * way[1];
                    const int s = x + after * way[0];
                    const int t = y + after * way[1];
                    if (!inside(u, v) || !inside(s, t) || !isOpaque(at(u, v)) || !isOpaque(at(s, t))) {
                        continue;
                    }
                    const Vec3 from = vectorOf(image_.colour[at(u, v)]);
                    const Vec3 step = vectorOf(image_.colour[at(s, t)]) - from;
                    const double square = squared(step);
                    const double along = square > 0.0 ? dot(here - from, step) / square : 0.0;
                    if (square >= kMinStep * kMinStep && along > kEnd && along < 1.0 - kEnd &&
                        squared(here - from - along * step) < kOff * kOff * square) {
                        return true;
                    }
                }
            }
        }
        return false;
    }

    /// Label of a blend: the larger share of the two colours near it that explain it best.
    [[nodiscard]] std::uint8_t shareOf(int x, int y, const ColourRegions& known) const
    {
        constexpr int kReach = 3;
        const Vec3 here = vectorOf(image_.colour[at(x, y)]);
        std::vector<std::uint8_t> near;
        for (int reach = 1; reach <= kReach && near.size() < 2; ++reach) {
            for (int v = std::max(0, y - reach); v <= std::min(image_.height - 1, y + reach); ++v) {
                for (int u = std::max(0, x - reach); u <= std::min(image_.width - 1, x + reach); ++u) {
                    const std::size_t i = at(u, v);
                    const bool has_colour = known.is_blend[i] == 0 && isOpaque(i);
                    if (has_colour && std::find(near.begin(), near.end(), known.label[i]) == near.end()) {
                        near.push_back(known.label[i]);
                    }
                }
            }
        }
        if (near.empty()) {
            return labelOf(nearestGroup(labOf(here)));
        }
        std::sort(near.begin(), near.end());
        std::uint8_t best = near.front();
        double off = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < near.size(); ++i) {
            for (std::size_t j = i; j < near.size(); ++j) {
                const Vec3 from = colourOf(near[i]);
                const Vec3 step = colourOf(near[j]) - from;
                const double square = squared(step);
                const double along = square > 0.0 ? std::clamp(dot(here - from, step) / square, 0.0, 1.0) : 0.0;
                const double here_off = squared(here - from - along * step);
                if (here_off < off) {
                    off = here_off;
                    best = along > 0.5 ? near[j] : near[i];
                }
            }
        }
        return best;
    }

    void label(ColourRegions& result) const
    {
        result.label.assign(image_.colour.size(), 0);
        result.is_blend.assign(image_.colour.size(), 0);
        tbb::parallel_for(0, image_.height, [&](int y) {
            std::optional<Rgb> last;
            std::uint8_t label = 0;
            for (int x = 0; x < image_.width; ++x) {
                const std::size_t i = at(x, y);
                if (!isOpaque(i)) {
                    continue;
                }
                if (!last || *last != image_.colour[i]) {
                    last = image_.colour[i];
                    label = labelOf(nearestGroup(labOf(vectorOf(*last))));
                }
                result.label[i] = label;
                result.is_blend[i] = !isEven(x, y, kEven) && isBetween(x, y) ? 1 : 0;
            }
        });
        std::vector<std::uint8_t> shares = result.label;
        tbb::parallel_for(0, image_.height, [&](int y) {
            for (int x = 0; x < image_.width; ++x) {
                if (result.is_blend[at(x, y)] != 0) {
                    shares[at(x, y)] = shareOf(x, y, result);
                }
            }
        });
        result.label = std::move(shares);
    }

    /// Makes the palette of the labels that occur, the most common first.
    void nameColours(ColourRegions& result) const
    {
        std::array<std::size_t, 256> count{};
        for (const std::uint8_t label : result.label) {
            ++count[label];
        }
        std::vector<std::uint8_t> order;
        for (unsigned label = 1; label < count.size(); ++label) {
            if (count[label] > 0) {
                order.push_back(static_cast<std::uint8_t>(label));
            }
        }
        if (order.empty()) {
            throw Error(ErrorCode::InvalidInput, "the picture has no colour but that of its border");
        }
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint8_t a, std::uint8_t b) { return count[a] > count[b]; });
        std::array<std::uint8_t, 256> renamed{};
        for (const std::uint8_t label : order) {
            result.palette.push_back({rounded(colourOf(label)), count[label]});
            renamed[label] = static_cast<std::uint8_t>(result.palette.size());
        }
        for (std::uint8_t& label : result.label) {
            label = renamed[label];
        }
    }

    Image image_;
    const ColourOptions& options_;
    std::optional<CssColour> background_;
    std::vector<Group> groups_;
};

/// What a function makes of an encoded picture.
template <typename Function>
auto ofDecoded(std::span<const std::byte> encoded, const ColourOptions& options, Function function)
{
    options.validate();
    try {
        Image image = decodeImage(encoded, {.max_pixels = options.max_pixels,
                                            .vector_long_side = options.vector_long_side,
                                            .keeps_colour = true,
                                            .drawing = {options.vector_seconds, options.vector_memory}});
        requireInk(image);
        Sorter sorter(std::move(image), options);
        return function(sorter);
    } catch (const cv::Exception&) {
        throwOutOfMemory();
    } catch (const std::bad_alloc&) {
        throwOutOfMemory();
    }
}

}  // namespace

void ColourOptions::validate() const
{
    if (colours && (*colours < 1 || *colours > kMaxColours)) {
        throw Error(ErrorCode::InvalidArgument,
                    "colours " + std::to_string(*colours) + " must be from 1 to " + std::to_string(kMaxColours));
    }
}

ColourRegions decodeColours(std::span<const std::byte> encoded, const ColourOptions& options)
{
    return ofDecoded(encoded, options, [](Sorter& sorter) { return sorter.sort(); });
}

std::vector<PaletteColour> decodePalette(std::span<const std::byte> encoded, const ColourOptions& options)
{
    return ofDecoded(encoded, options, [](Sorter& sorter) { return sorter.palette(); });
}

}  // namespace droplet

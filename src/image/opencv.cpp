// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <string>

#include "image/codecs.h"
#include "image/image_bytes.h"
#include "image/open_codecs.h"

namespace droplet {

namespace {

/// Picture decoded by the module.
class Decoded {
public:
    Decoded(std::span<const std::byte> encoded, ImageFormat format, std::size_t max_pixels)
    {
        const OpenCodecs& codecs = openCodecs();
        if (codecs.decode == nullptr) {
            throw Error(ErrorCode::InvalidInput, std::string(name(format)) +
                                                     " images are read with OpenCV, which must be installed (Debian's "
                                                     "package libopencv-imgcodecs406): " +
                                                     codecs.problem);
        }
        release_ = codecs.release;
        switch (codecs.decode(encoded.data(), encoded.size(), max_pixels, &picture_)) {
            case DropletOutcome::Decoded:
                return;
            case DropletOutcome::TooLarge:
                checkSize(format, static_cast<std::uint64_t>(picture_.width),
                          static_cast<std::uint64_t>(picture_.height), max_pixels);
                break;
            case DropletOutcome::Damaged:
                break;
            case DropletOutcome::OutOfMemory:
                throw std::bad_alloc();
        }
        const std::string problem = picture_.problem;
        throwDamaged(format, problem.empty() ? "OpenCV cannot decode it" : problem,
                     "truncated, damaged or unsupported");
    }
    Decoded(const Decoded&) = delete;
    Decoded& operator=(const Decoded&) = delete;
    ~Decoded() { release_(&picture_); }

    [[nodiscard]] const DropletPicture& picture() const { return picture_; }
    [[nodiscard]] bool floats() const { return picture_.bits > 16; }
    [[nodiscard]] std::size_t width() const { return static_cast<std::size_t>(picture_.width); }
    [[nodiscard]] std::size_t height() const { return static_cast<std::size_t>(picture_.height); }
    [[nodiscard]] std::size_t channels() const { return static_cast<std::size_t>(picture_.channels); }

    /// Copies the samples of a row, colours in the order red, green, blue.
    template <class Stored, class Sample>
    void copyRow(std::size_t y, std::vector<Sample>& row) const
    {
        const std::size_t count = width() * channels();
        const Stored* from = static_cast<const Stored*>(picture_.pixels) + y * count;
        row.resize(count);
        std::transform(from, from + count, row.begin(), [](Stored sample) {
            if constexpr (std::is_floating_point_v<Stored> && !std::is_floating_point_v<Sample>) {
                return static_cast<Sample>(std::lround(65535.0 * (sample > 0 ? std::min<Stored>(sample, 1) : 0)));
            } else {
                return static_cast<Sample>(sample);
            }
        });
        for (std::size_t i = 0; channels() >= 3 && i < count; i += channels()) {
            std::swap(row[i], row[i + 2]);
        }
    }

private:
    DropletPicture picture_{};
    DropletRelease* release_ = nullptr;
};

/// Stores all rows of a decoded picture in an image.
/// @param white  level of white; 0 for the largest possible level
template <class Stored, class Sample>
void putRows(const Decoded& decoded, Image& image, std::uint32_t white = 0)
{
    std::vector<Sample> row;
    for (std::size_t y = 0; y < decoded.height(); ++y) {
        decoded.copyRow<Stored>(y, row);
        for (std::size_t i = 0; white > 0 && i < row.size(); ++i) {
            row[i] = static_cast<Sample>((std::min<std::uint32_t>(row[i], white) * 65535U + white / 2) / white);
        }
        putPixels(image, {y * decoded.width(), 1, decoded.picture().channels}, std::span<const Sample>(row));
    }
}

constexpr std::uint16_t kTagBits = 258;
constexpr std::uint16_t kTagPhotometric = 262;
constexpr std::uint16_t kTagSamples = 277;
constexpr std::uint16_t kTagPlanes = 284;
constexpr std::uint16_t kTagExtraSamples = 338;
constexpr std::uint16_t kTagSampleFormat = 339;
constexpr std::uint64_t kCmyk = 5;

std::uint64_t tiffValue(std::span<const std::byte> encoded, std::uint16_t tag)
{
    return tiffField(encoded, tag).value_or(1);
}

/// Rejects the kinds of TIFF that OpenCV 4.6 silently reads wrongly or without their alpha.
void rejectMisreadTiff(std::span<const std::byte> encoded, const DropletPicture& picture)
{
    const auto reject = [](const std::string& kind) { throwUnsupported(ImageFormat::Tiff, kind); };
    const std::uint64_t sample_format = tiffValue(encoded, kTagSampleFormat);
    constexpr std::uint64_t kUnsigned = 1;
    constexpr std::uint64_t kUndefined = 4;
    if (picture.bits == 0 || (picture.bits <= 16 && sample_format != kUnsigned && sample_format != kUndefined)) {
        reject("samples that are not unsigned integers");
    }
    const std::uint64_t bits = tiffValue(encoded, kTagBits);
    if (bits > 8 && bits < 16) {
        reject(std::to_string(bits) + " bits per sample");
    }
    const std::uint64_t samples = tiffValue(encoded, kTagSamples);
    if (samples == 2) {
        reject("grey with alpha");
    }
    if (picture.bits > 8 && samples > 1 && tiffValue(encoded, kTagPlanes) != 1) {
        reject("separate colour planes of more than 8 bits");
    }
    const std::uint64_t photometric = tiffField(encoded, kTagPhotometric).value_or(1);
    if (picture.bits == 16 && photometric != 1 && photometric != 2) {
        reject("photometric interpretation " + std::to_string(photometric) + " with 16 bits per sample");
    }
}

/// Interprets the fourth channel of a picture. libtiff has already multiplied 8-bit colours by an unassociated alpha.
void interpretAlpha(std::span<const std::byte> encoded, ImageFormat format, int bits, Image& image)
{
    image.premultiplied = format == ImageFormat::OpenExr;
    if (format != ImageFormat::Tiff) {
        return;
    }
    constexpr std::uint64_t kUnspecified = 0;
    constexpr std::uint64_t kAssociated = 1;
    constexpr std::uint64_t kUnassociated = 2;
    const std::optional<std::uint64_t> extra = tiffField(encoded, kTagExtraSamples);
    if (extra == kUnspecified || tiffValue(encoded, kTagPhotometric) == kCmyk) {
        image.alpha = {};
    }
    image.premultiplied = extra == kAssociated || (extra == kUnassociated && bits == 8);
}

}  // namespace

Image decodeWithOpenCv(std::span<const std::byte> encoded, ImageFormat format, const DecodeOptions& options)
{
    const Decoded decoded(encoded, format, options.max_pixels);
    const DropletPicture& picture = decoded.picture();
    if (format == ImageFormat::Tiff) {
        rejectMisreadTiff(encoded, picture);
        if (decoded.floats()) {
            throwUnsupported(format, "samples that are not unsigned integers");
        }
    }
    Image image = blankImage({format, picture.width, picture.height, 1, options.keeps_colour}, picture.channels == 4);
    const std::uint32_t white = format == ImageFormat::Pnm ? pnmWhite(encoded) : 0;
    switch (picture.bits) {
        case 8:
            white > 0 ? putRows<std::uint8_t, std::uint16_t>(decoded, image, white)
                      : putRows<std::uint8_t, std::uint8_t>(decoded, image);
            break;
        case 16:
            putRows<std::uint16_t, std::uint16_t>(decoded, image, white);
            break;
        case 32:
            putRows<float, std::uint16_t>(decoded, image);
            break;
        default:
            putRows<double, std::uint16_t>(decoded, image);
    }
    if (!image.alpha.empty()) {
        interpretAlpha(encoded, format, picture.bits, image);
    }
    return upright(std::move(image), format == ImageFormat::Webp ? webpOrientation(encoded) : 1);
}

std::optional<FloatImage> decodeFloatsWithOpenCv(std::span<const std::byte> encoded, ImageFormat format,
                                                 std::size_t max_pixels, bool keeps_colour)
{
    const Decoded decoded(encoded, format, max_pixels);
    if (!decoded.floats()) {
        return std::nullopt;
    }
    if (format == ImageFormat::Tiff) {
        rejectMisreadTiff(encoded, decoded.picture());
    }
    FloatImage image{decoded.picture().width, decoded.picture().height, {}, {}};
    image.samples.reserve(decoded.width() * decoded.height());
    const std::size_t channels = decoded.channels();
    std::vector<double> row;
    for (std::size_t y = 0; y < decoded.height(); ++y) {
        decoded.picture().bits == 32 ? decoded.copyRow<float>(y, row) : decoded.copyRow<double>(y, row);
        for (std::size_t i = 0; i < row.size(); i += channels) {
            // With these weights, grey stays exactly grey.
            const double luma =
                channels < 3 ? row[i] : row[i + 1] + 0.299 * (row[i] - row[i + 1]) + 0.114 * (row[i + 2] - row[i + 1]);
            image.samples.push_back(static_cast<float>(luma));
            if (keeps_colour) {
                const auto channel = [&](std::size_t k) { return static_cast<float>(row[channels < 3 ? i : i + k]); };
                image.colour.push_back({channel(0), channel(1), channel(2)});
            }
        }
    }
    return image;
}

}  // namespace droplet

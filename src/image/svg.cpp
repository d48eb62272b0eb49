// SPDX-License-Identifier: GPL-3.0-or-later
// After: Scalable Vector Graphics 2 (W3C), 8.2 and 8.12 (the size of a page); CSS Values and Units 3, 5.2; RFC 1952.
//
// librsvg draws the page. It is opened when first needed: with Cairo, Pango and forty more libraries it takes 11 ms, a
// quarter of a small run. Without a base URI it loads nothing but data: URLs, no file and nothing from the network; it
// runs no scripts. What it leaves open is closed here:
// - the length of what compressed files hold, and the number of elements;
// - its stack: it descends into what elements refer to, and a file of a few hundred kilobytes, where every element uses
//   the one before, overflows any ordinary one. No element can refer to itself, so that the deepest descent is through
//   all of them, and at most 7 kB an element were measured (patterns and masks).
// - its time: it counts references, and gives up at 500 000. A page is first drawn very small, where as many take
//   seconds, not hours.
#include <dlfcn.h>
#include <librsvg/rsvg.h>
#include <pthread.h>
#include <sys/mman.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "droplet/units.h"
#include "image/codecs.h"
#include "image/image_bytes.h"
#include "number_text.h"

namespace droplet {
namespace {

constexpr std::size_t kLongestText = std::size_t{1} << 26;
constexpr std::size_t kMostTags = 250'000;
constexpr std::size_t kStackOfTag = 8 << 10;
constexpr std::size_t kLeastStack = 8 << 20;
constexpr double kDotsPerInch = 96.0;  // of CSS
constexpr double kInch = 25.4 * kMillimetre;
constexpr int kLongestSide = 32767;  // of Cairo's images
constexpr int kProbe = 64;

[[noreturn]] void throwRefused(const std::string& detail)
{
    throw Error(ErrorCode::InvalidInput, "SVG image " + detail);
}

/// The functions used.
class Library {
public:
    Library()
    {
        library_ = dlopen("librsvg-2.so.2", RTLD_NOW | RTLD_LOCAL);
        find("rsvg_handle_new_from_data", handle_new);
        find("rsvg_handle_set_dpi", set_dpi);
        find("rsvg_handle_get_intrinsic_dimensions", intrinsic_dimensions);
        find("rsvg_handle_get_intrinsic_size_in_pixels", intrinsic_size);
        find("rsvg_handle_get_geometry_for_element", geometry_for_element);
        find("rsvg_handle_render_document", render_document);
        find("rsvg_handle_render_element", render_element);
        find("g_error_free", error_free);
        find("g_object_unref", object_unref);
        find("cairo_image_surface_create_for_data", surface_create);
        find("cairo_surface_flush", surface_flush);
        find("cairo_surface_destroy", surface_destroy);
        find("cairo_create", context_create);
        find("cairo_status", context_status);
        find("cairo_destroy", context_destroy);
    }

    decltype(&rsvg_handle_new_from_data) handle_new = nullptr;
    decltype(&rsvg_handle_set_dpi) set_dpi = nullptr;
    decltype(&rsvg_handle_get_intrinsic_dimensions) intrinsic_dimensions = nullptr;
    decltype(&rsvg_handle_get_intrinsic_size_in_pixels) intrinsic_size = nullptr;
    decltype(&rsvg_handle_get_geometry_for_element) geometry_for_element = nullptr;
    decltype(&rsvg_handle_render_document) render_document = nullptr;
    decltype(&rsvg_handle_render_element) render_element = nullptr;
    decltype(&g_error_free) error_free = nullptr;
    void (*object_unref)(gpointer) = nullptr;  // g_object_unref is a macro, too
    decltype(&cairo_image_surface_create_for_data) surface_create = nullptr;
    decltype(&cairo_surface_flush) surface_flush = nullptr;
    decltype(&cairo_surface_destroy) surface_destroy = nullptr;
    decltype(&cairo_create) context_create = nullptr;
    decltype(&cairo_status) context_status = nullptr;
    decltype(&cairo_destroy) context_destroy = nullptr;

private:
    template <typename Function>
    void find(const char* name, Function& function)
    {
        void* const symbol = library_ == nullptr ? nullptr : dlsym(library_, name);
        if (symbol == nullptr) {
            throwRefused("needs librsvg, which must be installed: " +
                         std::string(library_ == nullptr ? dlerror() : name));
        }
        function = reinterpret_cast<Function>(symbol);
    }

    void* library_ = nullptr;  // never closed: what it started goes on
};

/// Threads may not start GLib side by side, nor is there a reason to look up names twice.
const Library& library()
{
    static const Library loaded;
    return loaded;
}

std::vector<std::byte> inflated(std::span<const std::byte> compressed)
{
    constexpr int kGzip = 16 + MAX_WBITS;
    z_stream stream{};
    if (inflateInit2(&stream, kGzip) != Z_OK) {
        throw std::bad_alloc();
    }
    const std::unique_ptr<z_stream, decltype(&inflateEnd)> end(&stream, inflateEnd);
    stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(compressed.data()));
    stream.avail_in = static_cast<uInt>(std::min<std::size_t>(compressed.size(), std::numeric_limits<uInt>::max()));
    std::vector<std::byte> text;
    std::vector<std::byte> chunk(std::size_t{1} << 16);
    for (int status = Z_OK; status != Z_STREAM_END;) {
        stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
        stream.avail_out = static_cast<uInt>(chunk.size());
        status = inflate(&stream, Z_NO_FLUSH);
        if (status != Z_OK && status != Z_STREAM_END) {
            throwDamaged(ImageFormat::Svg, status == Z_BUF_ERROR ? "its compressed data end too early"
                                                                 : "its compressed data are broken");
        }
        text.insert(text.end(), chunk.begin(),
                    chunk.begin() + static_cast<std::ptrdiff_t>(chunk.size() - stream.avail_out));
        if (text.size() > kLongestText) {
            break;  // refused by the caller, as it would be uncompressed
        }
    }
    return text;
}

class Document {
public:
    explicit Document(std::span<const std::byte> text)
    {
        GError* error = nullptr;
        handle_ = rsvg_.handle_new(reinterpret_cast<const guint8*>(text.data()), text.size(), &error);
        if (handle_ == nullptr) {
            throwDamaged(ImageFormat::Svg, taken(error));
        }
        rsvg_.set_dpi(handle_, kDotsPerInch);
    }

    ~Document() { rsvg_.object_unref(handle_); }

    Document(const Document&) = delete;
    Document& operator=(const Document&) = delete;

    /// Where the page is as large as what is drawn on it, that is moved into place.
    struct Page {
        double width = 0.0;   ///< [CSS px]
        double height = 0.0;  ///< [CSS px]
        bool as_drawn = false;
        std::optional<double> physical_width;  ///< [m]
    };

    Page page()
    {
        gboolean has_width = FALSE;
        gboolean has_height = FALSE;
        gboolean has_box = FALSE;
        RsvgLength width{};
        RsvgLength height{};
        RsvgRectangle box{};
        rsvg_.intrinsic_dimensions(handle_, &has_width, &width, &has_height, &height, &has_box, &box);
        Page page;
        if (rsvg_.intrinsic_size(handle_, &page.width, &page.height) != FALSE) {
            page.physical_width = metres(width);
        } else if (has_box != FALSE) {
            // One of the two may be stated; the other, like both, is that of the box.
            const double aspect = box.width / box.height;
            page.physical_width = metres(width);
            if (const auto physical_height = metres(height); physical_height && !page.physical_width) {
                page.physical_width = *physical_height * aspect;
            }
            page.width = page.physical_width           ? *page.physical_width / kInch * kDotsPerInch
                         : width.unit == RSVG_UNIT_PX  ? width.length
                         : height.unit == RSVG_UNIT_PX ? height.length * aspect
                                                       : box.width;
            page.height = page.width / aspect;
        } else {
            page.as_drawn = true;
            RsvgRectangle ink{};
            GError* error = nullptr;
            if (rsvg_.geometry_for_element(handle_, nullptr, &ink, nullptr, &error) == FALSE) {
                throwRefused("cannot be drawn: " + taken(error));
            }
            page.width = ink.width;
            page.height = ink.height;
        }
        if (!(page.width > 0.0 && page.height > 0.0 && std::isfinite(page.width) && std::isfinite(page.height))) {
            throwRefused(page.as_drawn ? "states no size and draws nothing" : "has a page without area");
        }
        return page;
    }

    /// Premultiplied colours, row by row; the page lies at the top left and is `scale` times as large.
    std::vector<std::uint32_t> draw(const Page& page, double scale, int width, int height)
    {
        std::vector<std::uint32_t> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        cairo_surface_t* const surface = rsvg_.surface_create(reinterpret_cast<unsigned char*>(pixels.data()),
                                                              CAIRO_FORMAT_ARGB32, width, height, 4 * width);
        cairo_t* const context = rsvg_.context_create(surface);
        const RsvgRectangle place{0.0, 0.0, page.width * scale, page.height * scale};
        GError* error = nullptr;
        const bool drawn = (page.as_drawn ? rsvg_.render_element(handle_, context, nullptr, &place, &error)
                                          : rsvg_.render_document(handle_, context, &place, &error)) != FALSE;
        const bool failed = rsvg_.context_status(context) != CAIRO_STATUS_SUCCESS;
        rsvg_.surface_flush(surface);
        rsvg_.context_destroy(context);
        rsvg_.surface_destroy(surface);
        if (!drawn || failed) {
            throwRefused("cannot be drawn: " + (drawn ? "Cairo fails" : taken(error)));
        }
        return pixels;
    }

private:
    /// What went wrong, in one line; the error is freed.
    std::string taken(GError* error) const
    {
        std::string message = error == nullptr ? "unknown error" : error->message;
        if (error != nullptr) {
            rsvg_.error_free(error);
        }
        // "Error domain 1 code 77 on line 1 column 134 of data: ..." is libxml2's.
        if (const auto from = message.find("Error domain "), to = message.find("on line ", from);
            from != std::string::npos && to != std::string::npos) {
            message.erase(from, to - from);
        }
        while (!message.empty() && (message.back() == '\n' || message.back() == ' ')) {
            message.pop_back();
        }
        std::replace_if(
            message.begin(), message.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; },
            '?');
        return message;
    }

    static std::optional<double> metres(const RsvgLength& length)
    {
        switch (length.unit) {
            case RSVG_UNIT_IN:
                return length.length * kInch;
            case RSVG_UNIT_CM:
                return length.length * 10.0 * kMillimetre;
            case RSVG_UNIT_MM:
                return length.length * kMillimetre;
            case RSVG_UNIT_PT:
                return length.length * kInch / 72.0;
            case RSVG_UNIT_PC:
                return length.length * kInch / 6.0;
            default:
                return std::nullopt;
        }
    }

    const Library& rsvg_ = library();
    RsvgHandle* handle_ = nullptr;
};

/// A grid of pixels over a page. It is exactly as wide as the page, and less than a pixel higher.
struct Raster {
    int width = 1;
    int height = 1;
    double scale = 1.0;  ///< pixels per CSS px
};

Raster rasterOf(const Document::Page& page, const DecodeOptions& options)
{
    // A page as narrow as a hair is drawn larger than asked for rather than as a row of pixels.
    constexpr double kShortSide = 16.0;
    const double most = static_cast<double>(options.max_pixels);
    const double long_side = std::clamp(options.vector_long_side, 1, kLongestSide);
    double scale = std::max(long_side / std::max(page.width, page.height),
                            std::min(kShortSide, long_side) / std::min(page.width, page.height));
    scale =
        std::min({scale, kLongestSide / std::max(page.width, page.height), std::sqrt(most / page.width / page.height)});
    double width = std::max(1.0, std::round(page.width * scale));
    const auto height = [&] {
        constexpr double kRounding = 1e-6;
        return std::max(1.0, std::ceil(page.height / page.width * width - kRounding));
    };
    while (width > 1.0 && (width * height() > most || height() > kLongestSide)) {
        width -= 1.0;
    }
    if (!(height() <= kLongestSide && width * height() <= most)) {
        throwRefused("has a page of " + numberText(page.width) + " x " + numberText(page.height) +
                     ", too narrow to be drawn in " + std::to_string(options.max_pixels) + " pixels");
    }
    return {static_cast<int>(width), static_cast<int>(height()), width / page.width};
}

Image draw(std::span<const std::byte> text, const DecodeOptions& options)
{
    Document document(text);
    const Document::Page page = document.page();
    const Raster raster = rasterOf(page, options);
    if (const Raster probe = rasterOf(page, {std::min(options.max_pixels, std::size_t{kProbe} * kProbe), kProbe});
        probe.width < raster.width) {
        document.draw(page, probe.scale, probe.width, probe.height);
    }
    const std::vector<std::uint32_t> pixels = document.draw(page, raster.scale, raster.width, raster.height);

    Image image = blankImage({.format = ImageFormat::Svg,
                              .width = raster.width,
                              .height = raster.height,
                              .keeps_colour = options.keeps_colour},
                             true);
    image.premultiplied = true;
    image.drawn_scale = raster.scale;
    image.physical_width = page.physical_width;
    const auto columns = static_cast<std::size_t>(raster.width);
    std::vector<std::uint8_t> row(4 * columns);
    for (std::size_t first = 0; first < pixels.size(); first += columns) {
        for (std::size_t x = 0; x < columns; ++x) {
            const std::uint32_t pixel = pixels[first + x];
            row[4 * x] = static_cast<std::uint8_t>(pixel >> 16);
            row[4 * x + 1] = static_cast<std::uint8_t>(pixel >> 8);
            row[4 * x + 2] = static_cast<std::uint8_t>(pixel);
            row[4 * x + 3] = static_cast<std::uint8_t>(pixel >> 24);
        }
        putPixels(image, {first, 1, 4}, std::span<const std::uint8_t>(row));
    }
    return image;
}

/// Memory for a stack, of which only what is touched is taken, above a page that must not be.
class Stack {
public:
    explicit Stack(std::size_t size) : size_(size)
    {
        start_ = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK,
                      -1, 0);
        if (start_ == MAP_FAILED) {
            throw std::bad_alloc();
        }
        mprotect(start_, kGuard, PROT_NONE);
    }

    ~Stack() { munmap(start_, size_); }

    Stack(const Stack&) = delete;
    Stack& operator=(const Stack&) = delete;

    /// Runs a function on this stack, in a thread of its own, and waits for it. What it throws is thrown here.
    template <typename Function>
    void run(Function& function)
    {
        struct Call {
            Function& function;
            std::exception_ptr thrown;
        } call{function, nullptr};
        const auto start = [](void* argument) -> void* {
            auto& started = *static_cast<Call*>(argument);
            try {
                started.function();
            } catch (...) {
                started.thrown = std::current_exception();
            }
            return nullptr;
        };
        pthread_attr_t attributes;
        pthread_t thread{};
        pthread_attr_init(&attributes);
        pthread_attr_setstack(&attributes, start_, size_);
        const int failure = pthread_create(&thread, &attributes, start, &call);
        pthread_attr_destroy(&attributes);
        if (failure != 0) {
            throw std::bad_alloc();
        }
        pthread_join(thread, nullptr);
        if (call.thrown) {
            std::rethrow_exception(call.thrown);
        }
    }

private:
    static constexpr std::size_t kGuard = 1 << 16;

    std::size_t size_;
    void* start_;
};

}  // namespace

Image decodeSvg(std::span<const std::byte> encoded, const DecodeOptions& options)
{
    std::vector<std::byte> text;
    const auto is_compressed = [&] { return ByteView(encoded, ImageFormat::Svg).startsWith("\x1f\x8b"); };
    if (is_compressed()) {
        text = inflated(encoded);
        encoded = text;
        // librsvg would inflate what is compressed twice, without bounds.
        if (is_compressed() || imageFormat(encoded) != ImageFormat::Svg) {
            throw Error(ErrorCode::InvalidInput, "compressed data without an SVG image in them");
        }
    }
    if (encoded.size() > kLongestText) {
        throwRefused("of more than " + std::to_string(kLongestText >> 20) + " MiB of text");
    }
    const auto tags = static_cast<std::size_t>(std::count(encoded.begin(), encoded.end(), std::byte{'<'}));
    if (tags > kMostTags) {
        throwRefused("of " + std::to_string(tags) + " tags, more than the limit of " + std::to_string(kMostTags));
    }
    Image image;
    Stack stack(kLeastStack + tags * kStackOfTag);
    auto on_stack = [&] { image = draw(encoded, options); };
    stack.run(on_stack);
    return image;
}

}  // namespace droplet

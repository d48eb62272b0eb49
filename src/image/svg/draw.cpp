// SPDX-License-Identifier: GPL-3.0-or-later
//
// After: Scalable Vector Graphics 2 (W3C), 8.2 and 8.12 (the size of a page); CSS Values and Units 3, 5.2.
//
// Program that draws SVG with librsvg; see image/svg_drawing.h. It is separate, so that a drawing that crashes librsvg
// or exceeds its limits affects nothing else.
//
// Without a base URI librsvg loads only data: URLs, no file and nothing from the network; it runs no scripts.
#include <dlfcn.h>
#include <librsvg/rsvg.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "droplet/units.h"
#include "image/svg/drawn_line.h"
#include "image/svg/rewrite.h"
#include "image/svg_drawing.h"
#include "image/svg_raster.h"

// NOLINTNEXTLINE(readability-identifier-naming,readability-redundant-declaration): Cairo's name
extern "C" cairo_scaled_font_t* cairo_scaled_font_create(cairo_font_face_t* face, const cairo_matrix_t* size,
                                                         const cairo_matrix_t* place,
                                                         const cairo_font_options_t* options);

namespace droplet {
namespace {

constexpr std::size_t kStackOfTag = 8 << 10;  // 7 kB were measured (patterns and masks)
constexpr std::size_t kMinStack = 8 << 20;
constexpr double kDotsPerInch = 96.0;  // CSS
constexpr double kInch = 25.4 * kMillimetre;

/// Reason reported to the library instead of a drawing.
class Refusal : public std::runtime_error {
public:
    Refusal(SvgOutcome reason, const std::string& problem) : std::runtime_error(problem), outcome(reason) {}

    SvgOutcome outcome;
};

/// Fonts that were requested.
struct Fonts {
    struct Request {
        double size;
        double place;
    };
    std::vector<Request> requested;
    bool too_large = false;  ///< whether letters were requested that FreeType cannot make
};

/// Global state, because Cairo's functions have no parameter for one.
Fonts& fonts()
{
    static Fonts fonts;
    return fonts;
}

/// Creates a scaled font. Pango (1.50) measures a font by one that is scaled twice. FreeType rejects more than 65535
/// pixels per em, and then Cairo rejects the font face permanently, at any size. So letters of 20 on a page of 24 × 24
/// could not be drawn. Such a font is rejected here, before the face is touched, and letters are drawn without its
/// measures.
cairo_scaled_font_t* scaledFont(cairo_font_face_t* face, const cairo_matrix_t& size, const cairo_matrix_t& place,
                                const cairo_font_options_t* options)
{
    static auto* const create =
        reinterpret_cast<decltype(&cairo_scaled_font_create)>(dlsym(RTLD_NEXT, "cairo_scaled_font_create"));
    constexpr double kMaxPixels = 65535.0;
    const auto scale = [](const cairo_matrix_t& matrix) {
        return std::sqrt(std::abs(matrix.xx * matrix.yy - matrix.xy * matrix.yx));
    };
    const Fonts::Request now{scale(size), scale(place)};
    if (now.size * now.place < kMaxPixels) {
        fonts().requested.push_back(now);
        return create(face, &size, &place, options);
    }
    const auto has_measures_here = [&](const Fonts::Request& before) {
        constexpr double kMaxPangoSize = 1 << 21;  // Pango's largest size in pixels; its unit is 1/1024
        constexpr double kRounding = 1e-2;
        const double twice = std::min(before.size * before.place, kMaxPangoSize / now.place);
        return std::abs(before.place / now.place - 1.0) < kRounding && std::abs(twice / now.size - 1.0) < kRounding;
    };
    Fonts& all = fonts();
    all.too_large = all.too_large || std::none_of(all.requested.begin(), all.requested.end(), has_measures_here);
    // A face without a name is in error, and so is its font.
    return create(cairo_toy_font_face_create(nullptr, CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL), &size, &place,
                  options);
}

/// Page of a document. With as_drawn it has the bounds of the drawing, which is moved onto it.
struct Page {
    double width = 0.0;   ///< [CSS px]
    double height = 0.0;  ///< [CSS px]
    bool as_drawn = false;
    std::optional<double> physical_width;  ///< [m]
};

class Document {
public:
    explicit Document(std::span<const std::byte> text)
    {
        GError* error = nullptr;
        handle_ = rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(text.data()), text.size(), &error);
        if (handle_ == nullptr) {
            throw Refusal(SvgOutcome::Damaged, messageOf(error));
        }
        rsvg_handle_set_dpi(handle_, kDotsPerInch);
    }

    ~Document() { g_object_unref(handle_); }

    Document(const Document&) = delete;
    Document& operator=(const Document&) = delete;

    Page page()
    {
        gboolean has_width = FALSE;
        gboolean has_height = FALSE;
        gboolean has_box = FALSE;
        RsvgLength width{};
        RsvgLength height{};
        RsvgRectangle box{};
        rsvg_handle_get_intrinsic_dimensions(handle_, &has_width, &width, &has_height, &height, &has_box, &box);
        Page page;
        if (rsvg_handle_get_intrinsic_size_in_pixels(handle_, &page.width, &page.height) != FALSE) {
            page.physical_width = metres(width);
        } else if (has_box != FALSE) {
            // Either size may be given; missing ones follow from the box.
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
            if (rsvg_handle_get_geometry_for_element(handle_, nullptr, &ink, nullptr, &error) == FALSE) {
                throw Refusal(SvgOutcome::Refused, "cannot be drawn: " + messageOf(error));
            }
            page.width = ink.width;
            page.height = ink.height;
        }
        if (!(page.width > 0.0 && page.height > 0.0 && std::isfinite(page.width) && std::isfinite(page.height))) {
            throw Refusal(SvgOutcome::Refused,
                          page.as_drawn ? "states no size and draws nothing" : "has a page without area");
        }
        return page;
    }

    /// Draws into premultiplied colours, row by row. The page is at the top left, enlarged by `scale`.
    void draw(const Page& page, const SvgRaster& raster, unsigned char* pixels)
    {
        cairo_surface_t* const surface = cairo_image_surface_create_for_data(pixels, CAIRO_FORMAT_ARGB32, raster.width,
                                                                             raster.height, 4 * raster.width);
        cairo_t* const context = cairo_create(surface);
        const RsvgRectangle place{0.0, 0.0, page.width * raster.scale, page.height * raster.scale};
        GError* error = nullptr;
        const bool drawn = (page.as_drawn ? rsvg_handle_render_element(handle_, context, nullptr, &place, &error)
                                          : rsvg_handle_render_document(handle_, context, &place, &error)) != FALSE;
        const bool failed = cairo_status(context) != CAIRO_STATUS_SUCCESS;
        cairo_surface_flush(surface);
        cairo_destroy(context);
        cairo_surface_destroy(surface);
        if (!drawn || failed) {
            throw Refusal(SvgOutcome::Refused, "cannot be drawn: " + (drawn ? "Cairo fails" : messageOf(error)));
        }
        if (fonts().too_large) {
            throw Refusal(SvgOutcome::Refused, "has letters of more than 65535 pixels, larger than can be drawn");
        }
    }

private:
    /// Message of an error in one line; frees the error.
    std::string messageOf(GError* error) const
    {
        std::string message = error == nullptr ? "unknown error" : error->message;
        if (error != nullptr) {
            g_error_free(error);
        }
        // Remove libxml2's "Error domain 1 code 77 on line 1 column 134 of data: ...".
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
        constexpr std::array<std::pair<RsvgUnit, double>, 5> kUnits{{{RSVG_UNIT_IN, kInch},
                                                                     {RSVG_UNIT_CM, 10.0 * kMillimetre},
                                                                     {RSVG_UNIT_MM, kMillimetre},
                                                                     {RSVG_UNIT_PT, kInch / 72.0},
                                                                     {RSVG_UNIT_PC, kInch / 6.0}}};
        for (const auto& [unit, metre] : kUnits) {
            if (length.unit == unit) {
                return length.length * metre;
            }
        }
        return std::nullopt;
    }

    RsvgHandle* handle_ = nullptr;
};

SvgRaster rasterOf(const Page& page, const SvgRequest& request)
{
    const auto raster = svgRaster(page.width, page.height, request.long_side, request.max_pixels);
    if (!raster) {
        throw Refusal(SvgOutcome::Refused, tooNarrow(page.width, page.height, request.max_pixels));
    }
    return *raster;
}

/// Gives the file that is the standard output so much content.
/// @return  its content
unsigned char* resizeOutput(std::size_t bytes)
{
    const std::size_t size = kSvgContent + bytes;
    void* const file = ftruncate(STDOUT_FILENO, static_cast<off_t>(size)) == 0
                           ? mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, STDOUT_FILENO, 0)
                           : MAP_FAILED;
    if (file == MAP_FAILED) {
        throw std::bad_alloc();
    }
    return static_cast<unsigned char*>(file) + kSvgContent;
}

/// Writes the line that text follows.
void writeLine(std::span<const std::byte> text, SvgDrawing& drawing)
{
    const Document refuse_others(text);
    const Rewritten rewrite = rewritten(text);
    const SvgLine line = lineIn(rewrite.text.empty() ? text : std::as_bytes(std::span(rewrite.text)));
    std::copy(line.points.begin(), line.points.end(),
              reinterpret_cast<Vec2*>(resizeOutput(line.points.size() * sizeof(Vec2))));
    drawing.points = line.points.size();
    drawing.others = line.others;
    drawing.page_width = line.page_width;
    drawing.outcome = SvgOutcome::Drawn;
}

/// Draws the text.
void draw(std::span<const std::byte> text, const SvgRequest& request, SvgDrawing& drawing)
{
    const Rewritten rewrite = rewritten(text);
    Document document(rewrite.text.empty() ? text : std::as_bytes(std::span(rewrite.text)));
    const Page page = document.page();
    const SvgRaster raster = rasterOf(page, request);
    document.draw(page, raster,
                  resizeOutput(std::size_t{4} * static_cast<std::size_t>(raster.width) *
                               static_cast<std::size_t>(raster.height)));
    drawing.width = raster.width;
    drawing.height = raster.height;
    drawing.scale = raster.scale;
    drawing.physical_width = page.physical_width.value_or(0.0);
    std::string lacking;
    for (const std::string& what : rewrite.not_drawn) {
        lacking += (lacking.empty() ? "" : ", ") + what;
    }
    lacking.copy(drawing.lacking.data(), drawing.lacking.size() - 1);
    drawing.outcome = SvgOutcome::Drawn;
}

/// Limits the process to the requested resources, and lets it end with the thread that started it.
void limit(const SvgRequest& request)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    const rlimit memory{request.memory, request.memory};
    setrlimit(RLIMIT_DATA, &memory);
    itimerval time{};
    time.it_value.tv_sec = static_cast<time_t>(request.seconds);
    time.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (request.seconds - std::floor(request.seconds)));
    setitimer(ITIMER_PROF, &time, nullptr);
    // Filters run in threads, each with a stack. On large machines the stacks alone would exceed the limit.
    setenv("RAYON_NUM_THREADS", "4", 0);
}

/// Input and output of the drawing thread.
struct Task {
    const SvgRequest& request;
    std::span<const std::byte> text;
    SvgDrawing& drawing;
};

void report(SvgDrawing& drawing, SvgOutcome outcome, const std::string& problem)
{
    drawing.outcome = outcome;
    problem.copy(drawing.problem.data(), drawing.problem.size() - 1);
}

void* drawOrReport(void* argument)
{
    const Task& task = *static_cast<const Task*>(argument);
    try {
        if (task.request.line) {
            writeLine(task.text, task.drawing);
        } else {
            draw(task.text, task.request, task.drawing);
        }
    } catch (const Refusal& refusal) {
        report(task.drawing, refusal.outcome, refusal.what());
    } catch (const std::exception& error) {
        report(task.drawing, SvgOutcome::Refused, std::string("cannot be drawn: ") + error.what());
    }
    return nullptr;
}

/// Draws on a stack that is deep enough for elements to refer to one another (none can refer to itself). The guard page
/// below it ends the process.
bool drawOnDeepStack(Task task)
{
    constexpr std::size_t kGuard = 1 << 16;
    const std::size_t size =
        std::min(kMinStack + task.request.tags * kStackOfTag, task.request.memory / 4 / kGuard * kGuard);
    void* const stack =
        mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK, -1, 0);
    if (stack == MAP_FAILED) {
        return false;
    }
    mprotect(stack, kGuard, PROT_NONE);
    pthread_attr_t attributes;
    pthread_t thread{};
    pthread_attr_init(&attributes);
    pthread_attr_setstack(&attributes, stack, size);
    const bool started = pthread_create(&thread, &attributes, drawOrReport, &task) == 0;
    pthread_attr_destroy(&attributes);
    return started && pthread_join(thread, nullptr) == 0;
}

int start()
{
    struct stat size {};
    void* const from =
        fstat(STDIN_FILENO, &size) == 0 && size.st_size >= static_cast<off_t>(sizeof(SvgRequest))
            ? mmap(nullptr, static_cast<std::size_t>(size.st_size), PROT_READ, MAP_SHARED, STDIN_FILENO, 0)
            : MAP_FAILED;
    void* const to = ftruncate(STDOUT_FILENO, kSvgContent) == 0
                         ? mmap(nullptr, kSvgContent, PROT_READ | PROT_WRITE, MAP_SHARED, STDOUT_FILENO, 0)
                         : MAP_FAILED;
    if (from == MAP_FAILED || to == MAP_FAILED) {
        return 2;  // not started by the library
    }
    const auto& request = *static_cast<const SvgRequest*>(from);
    auto& drawing = *new (to) SvgDrawing();
    limit(request);
    const std::span<const std::byte> whole(static_cast<const std::byte*>(from), static_cast<std::size_t>(size.st_size));
    if (!drawOnDeepStack({request, whole.subspan(sizeof request), drawing})) {
        report(drawing, SvgOutcome::Refused, "needs more memory than is available");
    }
    return 0;
}

}  // namespace
}  // namespace droplet

// Replaces Cairo's function, because a program's functions precede those of its libraries; only scaledFont() calls the
// original.
cairo_scaled_font_t* cairo_scaled_font_create(cairo_font_face_t* face, const cairo_matrix_t* size,
                                              const cairo_matrix_t* place, const cairo_font_options_t* options)
{
    return droplet::scaledFont(face, *size, *place, options);
}

int main()
{
    _exit(droplet::start());  // without the destructors of static objects in libraries
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>

#include "droplet/render/paint.h"
#include "droplet/units.h"
#include "droplet_options.h"
#include "video_writer.h"

namespace cli {
namespace {

constexpr int kMaxPixels = 8192;          // limit of width and height
constexpr std::size_t kMaxTurns = 360;    // limit of a turntable's pictures
constexpr std::size_t kVideoTurns = 120;  // pictures of a turntable's video: five seconds
constexpr int kFewestDigits = 3;

void readSize(const Given& given, PreviewOptions& options)
{
    const char* const allowed = "width and height in pixels such as 1280x960, each from 16 to 8192";
    constexpr int kFewestPixels = 16;
    const auto side = [&](std::string_view text) {
        int value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size() || value < kFewestPixels || value > kMaxPixels) {
            refuse(given, allowed);
        }
        return value;
    };
    const std::string_view text = given.text;
    const auto times = text.find('x');
    if (times == std::string_view::npos) {
        refuse(given, allowed);
    }
    options.width = side(text.substr(0, times));
    options.height = side(text.substr(times + 1));
}

constexpr Range kDistance{droplet::Dimension::Length, 1e-6, 1e6, "from 1um to 1e6 m"};

void readCamera(const Given& given, PreviewOptions& options)
{
    constexpr Range kAzimuth{droplet::Dimension::Angle, -2 * std::numbers::pi, 2 * std::numbers::pi,
                             "from -360deg to 360deg"};
    constexpr Range kAbove{droplet::Dimension::Angle, 0.0, 0.5 * std::numbers::pi, "from 0deg to 90deg"};
    constexpr Range kAll{droplet::Dimension::Angle, -0.5 * std::numbers::pi, 0.5 * std::numbers::pi,
                         "from -90deg to 90deg"};
    const std::vector<Given> parts = partsOf(given);
    if (parts.size() < 2 || parts.size() > 3) {
        refuse(given, "azimuth, elevation and perhaps a distance, such as -60deg,30deg or -60deg,30deg,40cm");
    }
    options.camera = {quantity({parts[0].text, given.subject + ": azimuth"}, kAzimuth),
                      quantity({parts[1].text, given.subject + ": elevation"}, options.sees_below ? kAll : kAbove)};
    if (parts.size() > 2) {
        options.distance = quantity({parts[2].text, given.subject + ": distance"}, kDistance);
    }
}

/// Numbered path: `name-007.png` from `name.png`.
std::string numbered(const std::string& path, std::size_t number, std::size_t count)
{
    const std::filesystem::path whole(path);
    const auto digits = std::max<std::size_t>(kFewestDigits, std::to_string(count).size());
    return fmt::format("{}-{:0{}}{}", (whole.parent_path() / whole.stem()).string(), number, digits,
                       whole.extension().string());
}

/// Height at which a surface seen from the camera's place fills the picture as far as in width [px].
int fittedHeight(const PreviewOptions& options, const droplet::Surface& surface)
{
    const auto box = droplet::around(surface);
    if (!box || !options.camera) {
        return options.height;
    }
    const droplet::Vec3 size = box->high - box->low;
    const double turned = std::hypot(size.x, size.y);
    const double across = options.turns ? turned : size.x;
    const double deep = options.turns ? turned : size.y;
    const double seen = deep * std::sin(options.camera->elevation) + size.z * std::cos(options.camera->elevation);
    const double share = across > 0.0 ? seen / across : 1.0;
    constexpr double kLeast = 0.25;
    // Videos need even sides.
    return 2 * static_cast<int>(std::lround(0.5 * options.width * std::clamp(share, kLeast, 0.75)));
}

droplet::RenderOptions renderOptions(const PreviewOptions& options, const PreviewSubject& subject)
{
    droplet::RenderOptions render;
    aim(options, render);
    render.height = options.fits_height ? fittedHeight(options, subject.surface) : options.height;
    if (options.turns) {
        render.fit_all_azimuths = true;
    }
    render.look = subject.look;
    render.looks = subject.looks;
    render.colour_map = subject.colour_map;
    render.extent = subject.extent;
    render.ground = subject.ground;
    render.light_table = subject.by_colour;
    render.environment = subject.light;
    render.stand = subject.curved;
    render.shows_whole_stand = false;
    if (subject.object) {
        subject.object->showIn(render);
    }
    if (options.colouring == Colouring::Contours) {
        render.paint = droplet::heightPaint(subject.surface);
    } else if (options.colouring == Colouring::ContactAngle) {
        render.paint = droplet::contactAnglePaint(subject.surface);
    }
    return render;
}

/// Draws one picture of a preview.
droplet::Picture drawn(const PreviewSubject& subject, const droplet::RenderOptions& render, bool cut_out)
{
    return cut_out ? onWhite(droplet::renderCutOut(subject.surface, render)) : droplet::render(subject.surface, render);
}

bool showsVideo(const PreviewOptions& options)
{
    return options.turns && isVideo(options.path);
}

}  // namespace

void declarePreview(CommandLine& line, PreviewOf subject)
{
    line.add("Picture", "--preview", "FILE",
             "Write a rendered picture, as PNG; - is standard output; with --turntable also a video");
    declareView(line, subject);
    line.add(
        "Picture", "--ground", "PICTURE",
        "Picture on the ground, aligned with the footprint's picture; with --onto, a texture over the object instead "
        "of its own materials [a table with a ruling]");
    declareEnvironment(line);
    line.add("Picture", "--preview-background,--background", "ground|none",
             "none makes the preview transparent except for the droplet and its shadow [ground]");
    const bool is_taken = line.knows("--colour");
    line.add("Picture", is_taken ? "--preview-colour" : "--preview-colour,--colour", "look|contours|contact-angle",
             "Colours of the preview: look of the material; contours of the height, or contact-angle along the rim, "
             "with a legend [look]");
    if (is_taken) {
        line.moveWords("--colour", {"look", "contours", "contact-angle"}, "--preview-colour");
    }
    declareTurntable(line);
}

void declareEnvironment(CommandLine& line)
{
    line.add(
        "Picture", "--environment", "FILE",
        "Equirectangular picture that lights the scene instead of lamps; EXR and HDR hold linear light, others sRGB");
}

bool showsLooks(const PreviewOptions& options)
{
    return !options.ground && options.colouring == Colouring::Look;
}

void aim(const PreviewOptions& options, droplet::RenderOptions& render)
{
    render.width = options.width;
    render.height = options.height;
    render.view = options.view;
    render.camera = options.camera;
    render.look_at = options.look_at;
    render.distance = options.distance;
}

void declareTurntable(CommandLine& line)
{
    line.add("Picture", "--turntable", "N|FILE",
             "Write N previews of a full turn, FILE-001.png and so on, or one video if --preview names a .mp4, .mkv, "
             ".mov or .webm; up to 360. A video's FILE, without --preview, gets 120",
             within(1, kMaxTurns));
    declareVideoEncoding(line, "Picture");
}

void requireRenderer(const std::string& option)
{
    if (!droplet::canRender()) {
        refuse(option +
               " needs the ray tracer, which this program was built without; the droplet-shape for Linux has it");
    }
}

bool readPreviewFile(const CommandLine& line, PreviewOptions& options)
{
    const auto preview = line.value("--preview");
    const auto turntable = line.value("--turntable");
    if (preview || turntable) {
        requireRenderer(preview ? "--preview" : "--turntable");
    }
    if (turntable && isVideo(turntable->text)) {
        if (preview) {
            refuse("--turntable " + turntable->text + " and --preview exclude each other: give the number of pictures");
        }
        options.path = turntable->text;
        options.turns = kVideoTurns;
        return true;
    }
    if (turntable) {
        options.turns = count(*turntable, {1, kMaxTurns, "360"});
    }
    if (!preview) {
        return false;
    }
    options.path = preview->text;
    const bool is_video = isVideo(options.path);
    if (!isStream(options.path) && lowerExtension(options.path) != ".png" && !is_video) {
        refuse(*preview, "a file that ends in .png, or -; with --turntable also a .mp4, .mkv, .mov or .webm");
    }
    if (is_video && !options.turns) {
        refuse("--preview: the video '" + options.path + "' needs --turntable, its number of frames");
    }
    if (isStream(options.path) && options.turns) {
        refuse("--turntable writes several files: --preview must name a file, not -");
    }
    return true;
}

void lookFromFront(const CommandLine& line, PreviewOptions& options)
{
    constexpr droplet::CameraPlace kFront{-90.0 * droplet::kDegree, 60.0 * droplet::kDegree};
    if (!line.value("--view") && !line.value("--camera")) {
        options.camera = kFront;
        options.fits_height = !line.value("--preview-size");
    }
}

void checkVideo(const PreviewOptions& options)
{
    if (showsVideo(options)) {
        triedVideo(options.path, {options.width, options.height}, options.encoding);
    }
}

double turnOf(const PreviewOptions& options, std::size_t index)
{
    return 2.0 * std::numbers::pi * static_cast<double>(index) / static_cast<double>(options.turns.value_or(1));
}

void declareView(CommandLine& line, PreviewOf subject)
{
    const bool is_text = subject == PreviewOf::Text;
    line.add(
        "Picture", "--view", "three-quarter|top|side",
        std::string("Direction of the preview's view ") + (is_text ? "[the front, from above]" : "[three-quarter]"));
    line.add("Picture", "--camera", "DIRECTION",
             "Camera position, instead of --view: azimuth, counter-clockwise from the picture's right, elevation, and "
             "distance, such as -60deg,30deg or -60deg,30deg,40cm [all fits into the picture]");
    line.exclude({"--view", "--camera"});
    line.add("Picture", "--look-at", "X,Y,Z",
             "Point in the picture's middle, in the frame of the output, +Y up, such as 0cm,4cm,0cm [all is in the "
             "middle]");
    line.add("Picture", "--preview-size", "SIZE",
             std::string("Width and height of the preview in pixels ") +
                 (is_text ? "[1280 wide, as high as the text needs]" : "[1280x960]"));
}

void readView(const CommandLine& line, PreviewOptions& options)
{
    if (const auto view = line.value("--view")) {
        options.view = choice<droplet::View>(*view, {{"three-quarter", droplet::View::ThreeQuarter},
                                                     {"top", droplet::View::Top},
                                                     {"side", droplet::View::Side}});
    }
    if (const auto camera = line.value("--camera")) {
        readCamera(*camera, options);
    }
    if (const auto look_at = line.value("--look-at")) {
        constexpr Range kPlace{droplet::Dimension::Length, -1e6, 1e6, "three lengths x,y,z from -1e6 m to 1e6 m"};
        options.look_at = vector(*look_at, kPlace);
    }
    if (const auto size = line.value("--preview-size")) {
        readSize(*size, options);
    }
}

std::optional<PreviewOptions> readPreview(const CommandLine& line, std::vector<std::string>& warnings)
{
    PreviewOptions options;
    readView(line, options);
    if (const auto background = line.value("--preview-background")) {
        options.cut_out = choice<bool>(*background, {{"ground", false}, {"none", true}});
    }
    if (const auto environment = line.value("--environment")) {
        options.environment = environment->text;
    }
    const auto ground = line.value("--ground");
    if (ground) {
        options.ground = ground->text;
    }
    const auto colour = line.value("--preview-colour");
    if (colour) {
        options.colouring = choice<Colouring>(
            *colour,
            {{"look", Colouring::Look}, {"contours", Colouring::Contours}, {"contact-angle", Colouring::ContactAngle}});
    }
    const bool has_preview = readPreviewFile(line, options);
    options.encoding = readVideoEncoding(line, has_preview && showsVideo(options), "--preview or --turntable");
    if (!has_preview) {
        for (const char* option : {"--view", "--camera", "--preview-size", "--ground", "--environment",
                                   "--preview-background", "--turntable"}) {
            if (line.value(option)) {
                warnings.push_back(std::string(option) + " has no effect without --preview");
            }
        }
        if (colour) {
            warnings.push_back(colour->subject + " has no effect without --preview");
        }
        return std::nullopt;
    }
    if (showsVideo(options)) {
        requireEvenSides("--preview-size", options.width, options.height);
    }
    if (options.cut_out && ground && !line.value("--onto")) {
        refuse("--preview-background none and --ground exclude each other, give one of them");
    }
    if (options.cut_out && options.colouring != Colouring::Look) {
        refuse("--preview-background none and " + colour->subject + " " + colour->text +
               " exclude each other: a legend needs a background");
    }
    if (options.colouring != Colouring::Look) {
        if (ground) {
            warnings.push_back("--ground has no effect with " + colour->subject + " " + colour->text);
            options.ground.reset();
        }
        if (options.colouring == Colouring::Contours && line.value("--onto")) {
            refuse(colour->subject + " contours and --onto exclude each other: contours need flat ground");
        }
    }
    return options;
}

std::vector<std::string> previewPaths(const PreviewOptions& options)
{
    if (!options.turns || isVideo(options.path)) {
        return {options.path};
    }
    std::vector<std::string> found;
    for (std::size_t k = 1; k <= *options.turns; ++k) {
        found.push_back(numbered(options.path, k, *options.turns));
    }
    return found;
}

std::vector<OutputFile> previewFiles(const PreviewOptions& options, const PreviewSubject& subject)
{
    const auto all = std::make_shared<const droplet::RenderOptions>(renderOptions(options, subject));
    const auto render = [all, &options](std::size_t index) {
        droplet::RenderOptions turned = *all;
        turned.azimuth = options.turns ? turnOf(options, index) : 0.0;
        return turned;
    };
    if (!options.cut_out || showsVideo(options)) {
        return previewFiles(options, VideoFrames{}.per_second, [&options, &subject, render](std::size_t index) {
            return drawn(subject, render(index), options.cut_out);
        });
    }
    std::vector<OutputFile> files;
    for (const std::string& path : previewPaths(options)) {
        files.push_back({path, [&subject, render, k = files.size()](std::ostream& out) {
                             droplet::writePng(droplet::renderCutOut(subject.surface, render(k)), out);
                         }});
    }
    return files;
}

std::vector<OutputFile> previewFiles(const PreviewOptions& options, double per_second,
                                     const std::function<droplet::Picture(std::size_t index)>& draw)
{
    if (showsVideo(options)) {
        return {{options.path, [&options, per_second, draw](std::ostream& out) {
                     droplet::Picture picture = draw(0);
                     VideoWriter video(
                         triedVideo(options.path, {picture.width, picture.height, per_second}, options.encoding));
                     video.add(picture);
                     for (std::size_t k = 1; k < *options.turns; ++k) {
                         video.add(draw(k));
                     }
                     video.finish(out);
                 }}};
    }
    std::vector<OutputFile> files;
    for (const std::string& path : previewPaths(options)) {
        files.push_back({path, [draw, k = files.size()](std::ostream& out) { droplet::writePng(draw(k), out); }});
    }
    return files;
}

}  // namespace cli

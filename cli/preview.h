// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "droplet/drawing/picture.h"
#include "droplet/render/environment.h"
#include "droplet/render/object_stand.h"
#include "droplet/render/render.h"
#include "droplet/surface/surface.h"
#include "droplet/surface/textured_mesh.h"
#include "files.h"
#include "video_encoding.h"

namespace cli {

/// Meaning of a preview's colours.
enum class Colouring {
    Look,          ///< look of the material
    Contours,      ///< height of the liquid
    ContactAngle,  ///< contact angle along the rim
};

/// Options of the preview.
struct PreviewOptions {
    std::string path;  ///< or kStandardStream; a turntable adds numbers before the extension
    droplet::View view = droplet::View::ThreeQuarter;
    std::optional<droplet::CameraPlace> camera;  ///< replaces `view`
    std::optional<droplet::Vec3> look_at;        ///< as of RenderOptions [m]
    std::optional<double> distance;              ///< as of RenderOptions [m]
    bool sees_below = false;                     ///< whether the camera may be below the ground
    bool cut_out = false;                        ///< without ground and backdrop
    int width = 1280;                            ///< [px]
    int height = 960;                            ///< [px]
    std::optional<std::string> ground;           ///< path of a picture on the ground
    std::optional<std::string> environment;      ///< path of a panorama that lights the scene
    Colouring colouring = Colouring::Look;
    std::optional<std::size_t> turns;  ///< number of a turntable's pictures
    VideoEncoding encoding = {};       ///< of a turntable's video
    bool fits_height = false;          ///< the height follows from the droplet, seen from `camera`
};

/// Droplet to be shown.
struct PreviewSubject {
    const droplet::Surface& surface;
    droplet::Look look;
    std::vector<droplet::Look> looks;                  ///< one per droplet; empty: `look` for all
    std::optional<droplet::Picture> colour_map;        ///< picture on the liquid
    droplet::Vec2 extent;                              ///< extent of its picture [m]
    std::optional<droplet::Picture> ground;            ///< PreviewOptions::ground, read
    std::optional<droplet::Environment> light;         ///< PreviewOptions::environment, read
    std::optional<droplet::ObjectStand> object = {};   ///< below it
    std::optional<droplet::TexturedMesh> curved = {};  ///< ground below it, unless that is flat or an object
    bool by_colour = false;                            ///< whether droplets show colours of a picture: on a light table
};

/// What a preview shows.
enum class PreviewOf { Picture, Text };

/// Declares the options of the preview.
void declarePreview(CommandLine& line, PreviewOf subject = PreviewOf::Picture);

/// Whether a preview shows the own looks of an object: not with a texture instead, nor with colours that have a
/// meaning.
bool showsLooks(const PreviewOptions& options);

/// Sets size, view, camera and where it looks.
void aim(const PreviewOptions& options, droplet::RenderOptions& render);

/// Declares --environment.
void declareEnvironment(CommandLine& line);

/// Declares --view, --camera, --look-at and --preview-size alone.
void declareView(CommandLine& line, PreviewOf subject = PreviewOf::Picture);

/// Reads the options of declareView.
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
void readView(const CommandLine& line, PreviewOptions& options);

/// Declares --turntable, --codec and --quality.
void declareTurntable(CommandLine& line);

/// Requires the ray tracer for an option.
/// @throws droplet::Error InvalidArgument: the program was built without it
void requireRenderer(const std::string& option);

/// Reads --preview and --turntable.
/// @return                whether there is a preview
/// @throws droplet::Error InvalidArgument
bool readPreviewFile(const CommandLine& line, PreviewOptions& options);

/// Shows a text from the front, and as high as it needs, where neither view nor size is given.
void lookFromFront(const CommandLine& line, PreviewOptions& options);

/// Checks that ffmpeg writes the preview, if it is a video.
/// @throws droplet::Error InvalidArgument: the encoder does not exist, or does not fit; OutputFailed: no ffmpeg
void checkVideo(const PreviewOptions& options);

/// Turn of a turntable's picture [rad].
/// @param index           from 0
double turnOf(const PreviewOptions& options, std::size_t index);

/// Reads the options of declarePreview.
/// @param warnings        receives warnings about options without effect
/// @return                nothing without --preview
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
std::optional<PreviewOptions> readPreview(const CommandLine& line, std::vector<std::string>& warnings);

/// Paths of all files that will be written; a turntable in a video is one file.
std::vector<std::string> previewPaths(const PreviewOptions& options);

/// Output files of the pictures, which are drawn when they are written; `options` and `subject` must live until then.
std::vector<OutputFile> previewFiles(const PreviewOptions& options, const PreviewSubject& subject);

/// Output files of pictures that are drawn when they are written, or of a turntable's video; `options` must live until
/// then.
/// @param per_second  pictures of a video
/// @param draw        draws the picture with this index, which is turned by turnOf()
std::vector<OutputFile> previewFiles(const PreviewOptions& options, double per_second,
                                     const std::function<droplet::Picture(std::size_t index)>& draw);

}  // namespace cli

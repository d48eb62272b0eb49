// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "droplet/picture/environment.h"
#include "droplet/picture/picture.h"
#include "droplet/picture/render.h"
#include "droplet/surface/surface.h"
#include "droplet/surface/textured_mesh.h"
#include "files.h"

namespace cli {

/// What colours of a preview mean.
enum class Colouring {
    Look,          ///< nothing: the droplet as it would look
    Contours,      ///< heights
    ContactAngle,  ///< along the rim
};

/// Pictures as asked for.
struct PreviewOptions {
    std::string path;  ///< or kStandardStream; of a turntable, numbers go before its extension
    droplet::View view = droplet::View::ThreeQuarter;
    std::optional<droplet::CameraPlace> camera;  ///< instead of the view's
    bool cut_out = false;                        ///< without ground and backdrop
    int width = 1280;                            ///< [px]
    int height = 960;                            ///< [px]
    std::optional<std::string> ground;           ///< path of a picture to lay below
    std::optional<std::string> environment;      ///< path of a picture of what shines
    Colouring colouring = Colouring::Look;
    std::optional<std::size_t> turns;  ///< how many pictures a turntable has
};

/// A droplet to be shown.
struct PreviewSubject {
    const droplet::Surface& surface;
    droplet::Material material;
    droplet::Vec2 extent;                        ///< of its picture [m]
    std::optional<droplet::Picture> ground;      ///< PreviewOptions::ground, read
    std::optional<droplet::Environment> light;   ///< PreviewOptions::environment, read
    std::optional<droplet::TexturedMesh> stand;  ///< what it stands on if not level flat ground
    bool on_object = false;                      ///< and that is an object
};

void declarePreview(CommandLine& line);

/// --view and --preview-size alone.
void declareView(CommandLine& line);

/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
void readView(const CommandLine& line, PreviewOptions& options);

/// @param warnings        gets what has no effect
/// @return                none if there is no --preview
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
std::optional<PreviewOptions> readPreview(const CommandLine& line, std::vector<std::string>& warnings);

/// Every file that will be written, to be checked.
std::vector<NamedFile> previewPaths(const PreviewOptions& options);

/// The pictures, each made when it is written. The subject must live until then.
std::vector<OutputFile> previewFiles(const PreviewOptions& options, const PreviewSubject& subject);

}  // namespace cli

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "droplet/io/output.h"
#include "droplet_options.h"
#include "preview.h"
#include "shape_maps.h"

namespace cli {

/// Options for making one droplet. All values are in range; no file but those of --config and --materials has been
/// read.
struct ShapeOptions {
    std::string input;                   ///< path or kStandardStream
    std::string output;                  ///< path or kStandardStream
    std::optional<std::string> json;     ///< path or kStandardStream
    std::optional<std::string> evolver;  ///< path or kStandardStream
    std::optional<PreviewOptions> preview;
    std::optional<ShapeMapOptions> maps;
    std::optional<std::string> html;  ///< path or kStandardStream
    droplet::Format format = droplet::Format::Glb;
    droplet::Compression compression = droplet::Compression::None;
    FootprintOptions footprint;
    DropletSettings settings;
    RunOptions run;
    bool watch = false;  ///< make the droplet again whenever the picture is saved
};

/// Names of all commands, and what they do.
const std::vector<std::pair<std::string, std::string>>& programCommands();

/// Format of a surface by the extension of its file.
/// @param subject         name of the file in messages
/// @throws droplet::Error InvalidArgument if there is no such format
droplet::Format formatOf(const std::string& output, const std::string& subject);

/// Declares --html.
/// @param group  of options that it belongs to
/// @param what   what the page does
void declareHtml(CommandLine& line, const char* group = "Run", const std::string& what = "shows the droplet");

/// Path of the page, if --html is given.
/// @throws droplet::Error InvalidArgument if the program was built without the page
std::optional<std::string> readHtml(const CommandLine& line);

/// Declares --lod.
/// @param files  an example of a level's file, for the help
void declareLevels(CommandLine& line, const std::string& files);

/// Reads --lod.
/// @param output          path of the surface, or pattern of paths
/// @param settings        receives the numbers of triangles
/// @throws droplet::Error InvalidArgument, naming the option and what is allowed
void readLevels(const CommandLine& line, const std::string& output, droplet::Format format, DropletSettings& settings);

/// Declares the options of every command that makes droplets: liquid, ground and surface, --format, --nodes,
/// --materials and --fill-range.
void declareDroplets(CommandLine& line, ShapeOptions& options);

/// Reads the options of declareDroplets and of the run that CommandLine::read() does not read.
/// @param options         those of declareDroplets, with the paths of inputs and outputs, or their patterns
/// @param subject         name of the output in messages
/// @throws droplet::Error InvalidArgument
void readDroplets(const CommandLine& line, ShapeOptions& options, const std::string& subject);

/// Declares the options of every command that makes droplets from pictures: those of declareDroplets and the footprint.
void declareShapes(CommandLine& line, ShapeOptions& options);

/// Reads the options of declareShapes and of the run, as readDroplets does.
void readShapes(const CommandLine& line, ShapeOptions& options, const std::string& subject);

/// Reads the command line and the configuration file that it names.
/// @return                the options, or the text that --help or --version prints
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
std::variant<ShapeOptions, std::string> parseShape(int argc, const char* const* argv);

}  // namespace cli

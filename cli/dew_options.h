// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "common_options.h"
#include "droplet/flow/dew.h"
#include "droplet/flow_io/dew_model.h"
#include "droplet/flow_io/flow_object.h"
#include "preview.h"

namespace cli {

/// Options of `droplet-shape dew`. All values are in range; vectors are turned to z up; no file but the configuration
/// file has been read.
struct DewCommandOptions {
    std::string object;  ///< path
    std::string output;  ///< path
    droplet::ObjectOptions reading;
    droplet::DewOptions dew;  ///< without the content of files
    droplet::DewFile file;    ///< of any format
    droplet::DewDetail detail = droplet::DewDetail::Medium;
    std::optional<std::string> mask;
    std::string preset;                   ///< name
    std::optional<std::string> droplets;  ///< path of a table
    std::optional<std::string> json;      ///< path of the report; - is standard output
    std::optional<PreviewOptions> preview;
    RunOptions run;
};

/// Reads the command line and the configuration file that it names.
/// @return                the options, or the text that --help or --version prints
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
std::variant<DewCommandOptions, std::string> parseDew(int argc, const char* const* argv);

}  // namespace cli

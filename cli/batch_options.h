// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command_line.h"
#include "droplet_options.h"

namespace cli {

/// What was asked for and has no output, and why.
struct BatchLeftOut {
    std::string name;
    std::string reason;
};

/// The share `index` of `count`: items index, index + count, index + 2 count, … counted from 1.
struct BatchShard {
    std::size_t index = 1;  ///< from 1
    std::size_t count = 1;
};

struct BatchOptions {
    std::string manifest;  ///< path
    /// The options given that can change a byte of what is made, for the manifest and fingerprints: all but those of
    /// the run and of the batch. Names without dashes, and values.
    std::vector<std::pair<std::string, std::string>> told;
    std::vector<std::string> read;  ///< files that are read, which no item may replace; inputs of items need no mention
    droplet::OutputOptions files;
    std::vector<BatchLeftOut> left_out;  ///< told in the manifest
    bool keep_going = false;             ///< go on after an item that failed
    bool resume = true;  ///< skip items whose files are there already, made from the same input and options
    std::optional<BatchShard> shard;
    std::optional<std::string> contact_sheet;  ///< path of a picture of all that was made, or stood already
    bool one_scale = false;                    ///< of it
    droplet::Material material = droplet::Material::Water;  ///< what they are drawn in there
    std::optional<std::size_t> threads;                     ///< items worked on at one time [all cores]
    Verbosity verbosity = Verbosity::Normal;
    ProgressMode progress = ProgressMode::Auto;
};

/// Declares what every batch takes: --keep-going, --no-resume, --shard, --manifest, --contact-sheet.
void declareBatch(CommandLine& line);

/// Reads those.
///
/// Without --manifest it is manifest.json in the folder that all outputs share: that of `output_pattern` as far as it
/// has no placeholder. A shard's has the shard in its name, as in manifest-2-of-8.json.
/// @param run             of the same line
/// @param output_pattern  how the paths of outputs are made
/// @throws droplet::Error InvalidArgument
BatchOptions readBatch(const CommandLine& line, const RunOptions& run, const std::string& output_pattern);

}  // namespace cli

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command_line.h"
#include "droplet/render/object_stand.h"
#include "droplet_options.h"
#include "run_files.h"

namespace cli {

/// Requested item without output, and the reason.
struct BatchLeftOut {
    std::string name;
    std::string reason;
};

/// Share of a batch: the items index, index + count, index + 2 count, … counted from 1.
struct BatchShard {
    std::size_t index = 1;  ///< from 1
    std::size_t count = 1;
};

struct BatchOptions {
    std::string manifest;  ///< path
    /// Given options that can change the output's bytes: names without dashes, and values.
    std::vector<std::pair<std::string, std::string>> decisive;
    CommandTerms terms;           ///< for messages
    std::vector<NamedFile> read;  ///< files beside the items' inputs
    droplet::OutputOptions files;
    std::vector<BatchLeftOut> left_out;  ///< listed in the manifest
    bool keep_going = false;             ///< continue after an item that failed
    bool resume = true;                  ///< skip items that are up to date
    std::optional<BatchShard> shard;
    std::optional<std::string> contact_sheet;               ///< path of a picture of all droplets
    bool one_scale = false;                                 ///< draw all droplets of the contact sheet at one scale
    droplet::Material material = droplet::Material::Water;  ///< material on the contact sheet
    std::shared_ptr<const droplet::ObjectStand> object;     ///< in all outputs, below the droplets; null: none
    std::optional<std::size_t> threads;                     ///< maximum number of items in work [all cores]
    Verbosity verbosity = Verbosity::Normal;
    ProgressMode progress = ProgressMode::Auto;
};

/// Declares the options of every batch: --keep-going, --no-resume, --shard, --manifest, --contact-sheet, --same-scale.
void declareBatch(CommandLine& line);

/// Reads the options of declareBatch.
///
/// Without --manifest, the manifest is manifest.json in the folder of all outputs: the part of `output_pattern` before
/// its first placeholder. The name of a shard's manifest contains the shard, as in manifest-2-of-8.json.
/// @param run             run options of the same command line
/// @param output_pattern  pattern of the output paths
/// @throws droplet::Error InvalidArgument
BatchOptions readBatch(const CommandLine& line, const RunOptions& run, const std::string& output_pattern);

}  // namespace cli

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "command_line.h"
#include "droplet/io/report.h"
#include "droplet_options.h"

namespace cli {

/// What the manifest says of a file that was made.
struct BatchFigures {
    std::size_t triangles = 0;
    std::size_t vertices = 0;
    bool closed = false;
    double volume = 0.0;      ///< [m³]
    double height_max = 0.0;  ///< [m]
    std::vector<std::string> warnings;
};

/// What the manifest says of a droplet, from the report of the run that made it.
BatchFigures figuresOf(const droplet::Report& report);

/// One item about to be made: its input has been read.
struct BatchWork {
    /// Hash of everything that decides the output's bytes, but for the program's version, which the runner adds; of
    /// fingerprintOf.
    std::string fingerprint;

    /// Makes the item and writes its files, each whole or not at all.
    std::function<BatchFigures()> make;
};

/// One output of many.
struct BatchItem {
    std::string name;                 ///< how messages call it, as in "glyph 'A'" or the input's path
    std::string input;                ///< path, or empty: the item comes from no file of its own
    std::string output;               ///< path of the file made
    std::vector<std::string> others;  ///< paths of further files made along with it, such as its report

    /// Reads the input, so that the fingerprint and what is made come of the same bytes. Called from any thread, once,
    /// shortly before `make`: inputs of items that wait take no memory. May throw anything, as may `make`: this item
    /// has failed then, no other.
    std::function<BatchWork()> open;
};

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
    std::string manifest;  ///< path, of manifestPath
    /// What the manifest tells of the options the items share: names without dashes, and values.
    std::vector<std::pair<std::string, std::string>> told;
    std::vector<std::string> read;  ///< files that are read, which no item may replace; inputs of items need no mention
    droplet::OutputOptions files;
    std::vector<BatchLeftOut> left_out;  ///< told in the manifest
    bool keep_going = false;             ///< go on after an item that failed
    bool resume = true;  ///< skip items whose files are there already, made from the same input and options
    std::optional<BatchShard> shard;
    std::optional<std::string> contact_sheet;  ///< path of a picture of all that was made, or stood already
    droplet::Material material = droplet::Material::Water;  ///< what they are drawn in there
    std::optional<std::size_t> threads;                     ///< items worked on at one time [all cores]
    Verbosity verbosity = Verbosity::Normal;
    ProgressMode progress = ProgressMode::Auto;
};

/// The exit code of a batch of which some items failed.
inline constexpr int kSomeFailed = 6;

/// Declares what every batch takes: --keep-going, --no-resume, --shard, --manifest, --contact-sheet.
void declareBatch(CommandLine& line);

/// Reads those.
/// @param run             of the same line
/// @param output_pattern  how the paths of outputs are made
/// @throws droplet::Error InvalidArgument
BatchOptions readBatch(const CommandLine& line, const RunOptions& run, const std::string& output_pattern);

/// The options given that can change a byte of what is made, for BatchOptions::told and fingerprints: all but those of
/// the run and of the batch.
std::vector<std::pair<std::string, std::string>> decisiveOptions(const CommandLine& line);

/// Where the manifest goes: `given`, or manifest.json in the folder that all outputs share: that of `output_pattern` as
/// far as it has no placeholder. A shard's has the shard in its name, as in manifest-2-of-8.json.
std::string manifestPath(const std::string& output_pattern, const std::optional<std::string>& given,
                         const std::optional<BatchShard>& shard);

/// A shard as in `2/8`.
/// @throws droplet::Error InvalidArgument, `subject` before its complaint
BatchShard shardOf(const std::string& text, const std::string& subject);

/// SHA-256 in hexadecimal digits.
std::string sha256(std::span<const std::byte> bytes);
std::string sha256OfFile(const std::string& path);  ///< @throws droplet::Error InvalidInput: it cannot be read

/// A hash of several texts, of which none can run into the next.
std::string fingerprintOf(const std::vector<std::string>& parts);

/// Makes all items (or those of one shard), several at one time, and writes the manifest.
///
/// What is left behind is what working on one item after another would leave, whatever the number of threads: rows of
/// the manifest and messages come in the order of the items. Without keep_going no item is begun once one has failed,
/// and whatever comes after the first that failed counts as not started, even if another thread has already made it.
///
/// An item is skipped if the manifest of an earlier run says that its files were made with the same fingerprint, and
/// the output has the size and hash written there. The manifest is replaced every few seconds, and at the end, each
/// time whole. SIGINT, SIGTERM and SIGHUP let items in work be finished, write the manifest and end the process by that
/// signal; a second one ends it at once.
///
/// Folders of outputs are made where missing.
/// @return                0, or kSomeFailed
/// @throws droplet::Error InvalidArgument: no items, two files of one path, an output that is an input, something else
///                        than a manifest where the manifest goes; OutputFailed: the manifest cannot be written. All
///                        but a full disk is found before any work is done
int makeAll(const std::vector<BatchItem>& items, const BatchOptions& options);

}  // namespace cli

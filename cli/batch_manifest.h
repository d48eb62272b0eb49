// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "batch_item.h"
#include "batch_options.h"

namespace cli {

/// What is known of a file: how it was made, how it can be told that it is still the same, and what it holds.
struct MadeFile {
    std::string fingerprint;
    std::uint64_t bytes = 0;
    std::string sha256;
    std::vector<std::string> others;  ///< made along with it
    BatchFigures figures;
};

/// A row of the manifest: what became of an item.
struct ManifestRow {
    std::size_t index = 0;  ///< among all items, whatever the shard
    ItemStatus status = ItemStatus::NotStarted;
    std::string error;
    int exit_code = 0;
    std::optional<MadeFile> file;  ///< as this run left it, or an earlier one if the item was not started
    double time = 0.0;             ///< [s]
};

/// Writes the manifest, whole or not at all.
/// @param seconds         that the batch has taken
/// @throws droplet::Error OutputFailed
void writeManifest(const std::vector<ManifestRow>& rows, const std::vector<BatchItem>& items,
                   const BatchOptions& options, double seconds);

/// What the manifest of an earlier run says.
class EarlierRun {
public:
    /// Reads that manifest and those that shards have left beside it; knows of nothing if there are none.
    /// @throws droplet::Error InvalidArgument if it is something else, which must not be replaced; InvalidInput if it
    ///                        cannot be read
    explicit EarlierRun(const std::string& manifest);

    /// What was made where the item's output goes.
    [[nodiscard]] std::optional<MadeFile> at(const BatchItem& item) const;

private:
    void read(const std::string& manifest, bool is_replaced);

    std::unordered_map<std::string, MadeFile> files_;  ///< by output
};

/// Whether an item's files are there, as an earlier run left them.
bool stands(const BatchItem& item, const std::string& fingerprint, const std::optional<MadeFile>& earlier);

}  // namespace cli

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

/// Finished file: what it was made from, size and hash to detect changes, and its figures.
struct MadeFile {
    std::string fingerprint;
    std::uint64_t bytes = 0;
    std::string sha256;
    std::vector<std::string> others;  ///< paths of further files of the same item
    BatchFigures figures;
};

/// Row of the manifest: the result of one item.
struct ManifestRow {
    std::size_t index = 0;  ///< among the items of all shards
    ItemStatus status = ItemStatus::NotStarted;
    std::string error;
    int exit_code = 0;
    std::optional<MadeFile> file;  ///< written by this run, or by an earlier one if the item was not started
    double time = 0.0;             ///< working time [s]
};

/// Writes the manifest, completely or not at all.
/// @param seconds         duration of the batch so far [s]
/// @throws droplet::Error OutputFailed
void writeManifest(const std::vector<ManifestRow>& rows, const std::vector<BatchItem>& items,
                   const BatchOptions& options, double seconds);

/// Files of earlier runs, read from their manifests.
class EarlierRun {
public:
    /// Reads this manifest and those of shards beside it, as far as they exist.
    /// @throws droplet::Error InvalidArgument: not a manifest, so it must not be replaced; InvalidInput: unreadable
    explicit EarlierRun(const std::string& manifest);

    /// File that an earlier run made at the item's output path.
    [[nodiscard]] std::optional<MadeFile> at(const BatchItem& item) const;

private:
    void read(const std::string& manifest, bool is_replaced);

    std::unordered_map<std::string, MadeFile> files_;  ///< by output path
};

/// Whether all files of an item exist, unchanged since an earlier run with the same fingerprint.
bool isUpToDate(const BatchItem& item, const std::string& fingerprint, const std::optional<MadeFile>& earlier);

}  // namespace cli

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "batch_item.h"
#include "batch_options.h"

namespace cli {

/// Checks the files of all items before any of them is made. They must be listed before other inputs are read.
/// @throws droplet::Error InvalidArgument: no items, two outputs that are one file, an output that is an input
void checkItems(const std::vector<BatchItem>& items, const BatchOptions& options);

/// Makes all items, or those of one shard, in parallel, and writes the manifest. They have passed checkItems().
///
/// The result does not depend on the number of threads: rows of the manifest and messages come in the order of the
/// items. Without keep_going, no item starts after a failure, and all items behind the first failed one count as not
/// started, even if another thread has already made them.
///
/// An item is skipped if the manifest of an earlier run lists its files with the same fingerprint, and the output still
/// has the listed size and hash. The manifest is replaced every few seconds and at the end, always completely. On
/// SIGINT, SIGTERM or SIGHUP, items in work are finished, the manifest is written, and the process ends by that signal;
/// a second signal ends it at once.
///
/// Missing folders of outputs are created. With no_clobber, existing outputs that are not up to date are refused before
/// any item is made.
/// @return                0, or that of ExitCode::SomeFailed
/// @throws droplet::Error InvalidArgument: a file that is not a manifest at the manifest's path; OutputFailed: the
///                        manifest cannot be written, or an output must not be replaced. All errors but a full disk are
///                        found before any work is done
int makeAll(const std::vector<BatchItem>& items, const BatchOptions& options);

}  // namespace cli

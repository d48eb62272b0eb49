// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "batch_item.h"
#include "batch_options.h"

namespace cli {

/// The exit code of a batch of which some items failed.
inline constexpr int kSomeFailed = 6;

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

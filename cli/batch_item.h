// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "droplet/io/report.h"

namespace cli {

/// Figures of a finished file, for the manifest.
struct BatchFigures {
    std::size_t triangles = 0;
    std::size_t vertices = 0;
    bool closed = false;
    double volume = 0.0;      ///< [m³]
    double height_max = 0.0;  ///< [m]
    std::vector<std::string> warnings;
    std::size_t severe_warnings = 0;  ///< number of leading warnings that are printed in spite of --quiet
};

/// Manifest figures of a droplet, taken from its report.
BatchFigures figuresOf(const droplet::Report& report);

/// Item whose input has been read.
struct BatchWork {
    /// Hash of everything that decides the output's bytes, by fingerprintOf. The runner adds the program's version.
    std::string fingerprint;

    /// Makes the item and writes its files, each completely or not at all.
    std::function<BatchFigures()> make;
};

/// One item of a batch.
struct BatchItem {
    std::string name;                 ///< name in messages, such as "glyph 'A'" or the input's path
    std::string input;                ///< path; empty if the item has no file of its own
    std::string output;               ///< path of the droplet's file
    std::vector<std::string> others;  ///< paths of further files, such as its report

    /// Reads the input once, so that fingerprint and output come from the same bytes. Called from any thread, shortly
    /// before `make`, so that waiting items take no memory. If it or `make` throws, only this item fails.
    std::function<BatchWork()> open;
};

/// Result of an item.
enum class ItemStatus { NotStarted, Made, Skipped, Failed };

/// Status as the manifest writes it.
const char* name(ItemStatus status);

}  // namespace cli

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "droplet/io/report.h"

namespace cli {

/// What the manifest says of a file that was made.
struct BatchFigures {
    std::size_t triangles = 0;
    std::size_t vertices = 0;
    bool closed = false;
    double volume = 0.0;      ///< [m³]
    double height_max = 0.0;  ///< [m]
    std::vector<std::string> warnings;
    std::size_t grave_warnings = 0;  ///< so many of the first, when it is made: they are told even if all is quiet
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

enum class ItemStatus { NotStarted, Made, Skipped, Failed };

const char* name(ItemStatus status);

}  // namespace cli

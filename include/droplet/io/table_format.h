// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace droplet {

/// File format of a table.
enum class TableFormat {
    Csv,   ///< comma-separated values with a header
    Json,  ///< one JSON object
};

}  // namespace droplet

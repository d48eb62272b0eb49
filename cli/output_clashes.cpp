// SPDX-License-Identifier: GPL-3.0-or-later
#include "output_clashes.h"

#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "canonical_paths.h"
#include "option_values.h"

namespace cli {

void refuseClashes(const std::vector<BatchItem>& items, const BatchOptions& options)
{
    CanonicalPaths paths;
    std::unordered_set<std::string> read;
    std::set<FileNode> read_nodes;
    const auto add_read = [&](const std::string& path) {
        if (!path.empty() && read.insert(paths.of(path)).second) {
            if (const auto node = nodeOf(path)) {
                read_nodes.insert(*node);
            }
        }
    };
    for (const std::string& path : options.read) {
        add_read(path);
    }
    for (const BatchItem& item : items) {
        add_read(item.input);
    }
    std::unordered_map<std::string, std::string> written;
    const auto add_written = [&](const std::string& path, const std::string& of) {
        const std::string canonical = paths.of(path);
        const auto [other, is_new] = written.try_emplace(canonical, of);
        if (!is_new) {
            refuse(of + " and " + other->second + " have the same output, '" + path + "'; every output needs its own");
        }
        const auto node = nodeOf(path);
        if (read.count(canonical) > 0 || (node && read_nodes.count(*node) > 0)) {
            refuse("the output of " + of + " would replace '" + path + "', which is an input");
        }
    };
    add_written(options.manifest, "the manifest");
    if (options.contact_sheet) {
        add_written(*options.contact_sheet, "the contact sheet");
    }
    for (const BatchItem& item : items) {
        add_written(item.output, item.name);
        for (const std::string& other : item.others) {
            add_written(other, item.name);
        }
    }
}

}  // namespace cli

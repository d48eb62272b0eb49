// SPDX-License-Identifier: GPL-3.0-or-later
#include "batch_progress.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "library_message.h"
#include "shape_command.h"
#include "terminal.h"

namespace cli {
namespace {

using Json = nlohmann::ordered_json;

std::string messageOf(const BatchItem& item, const std::string& error)
{
    return error.rfind(item.name + ": ", 0) == 0 ? error : item.name + ": " + error;
}

}  // namespace

BatchProgress::BatchProgress(std::size_t items, const BatchOptions& options)
    : options_(options),
      items_(items),
      bar_(options.verbosity != Verbosity::Quiet && options.progress == ProgressMode::Auto && errorIsTerminal())
{
}

void BatchProgress::reportItem(const BatchItem& item, const ManifestRow& row)
{
    ++reported_;
    for (std::size_t i = 0; row.file && i < row.file->figures.severe_warnings; ++i) {
        eraseBar();
        printWarning(withOptions(item.name + ": " + row.file->figures.warnings[i], options_.terms), options_.progress);
    }
    if (options_.progress == ProgressMode::Json) {
        std::cerr << Json{{"item", reported_},
                          {"of", items_},
                          {"name", item.name},
                          {"output", item.output},
                          {"status", name(row.status)},
                          {"error", row.status == ItemStatus::Failed ? Json(row.error) : Json()},
                          {"elapsed_s", std::round(1e3 * elapsed()) / 1e3}}
                         .dump(-1, ' ', false, Json::error_handler_t::replace)
                  << std::endl;
        return;
    }
    if (row.status == ItemStatus::Failed) {
        eraseBar();
        std::cerr << paint("droplet-shape: ", Colour::Red) << oneLine(messageOf(item, row.error)) << std::endl;
    } else if (options_.verbosity == Verbosity::Verbose) {
        eraseBar();
        std::cerr << paint(name(row.status), Colour::Bold) << std::string(11 - std::strlen(name(row.status)), ' ')
                  << oneLine(item.output) << std::endl;
    }
}

void BatchProgress::reportDrawn(std::size_t drawn, std::size_t count)
{
    drawn_tiles_ = drawn;
    if (options_.progress == ProgressMode::Json) {
        std::cerr << Json{{"drawn", drawn}, {"of", count}, {"elapsed_s", std::round(1e3 * elapsed()) / 1e3}}.dump()
                  << std::endl;
        return;
    }
    drawBar("contact sheet: ", drawn, count);
}

void BatchProgress::drawBar(const char* what, std::size_t ended, std::size_t count)
{
    constexpr double kRefresh = 0.1;  // [s]
    if (!bar_ || secondsSince(drawn_at_) < kRefresh) {
        return;
    }
    constexpr std::size_t kCells = 28;
    const std::size_t full = ended * kCells / std::max<std::size_t>(1, count);
    std::cerr << kEraseLine << "[" << std::string(full, '#') << std::string(kCells - full, '.') << "] " << what << ended
              << " of " << count << std::flush;
    drawn_ = true;
    drawn_at_ = Clock::now();
}

void BatchProgress::eraseBar()
{
    if (drawn_) {
        std::cerr << kEraseLine << std::flush;
        drawn_ = false;
    }
}

void BatchProgress::summarise(const std::vector<ManifestRow>& rows)
{
    eraseBar();
    if (options_.progress == ProgressMode::Json || options_.verbosity == Verbosity::Quiet) {
        return;
    }
    const auto with = [&](ItemStatus status) {
        return std::count_if(rows.begin(), rows.end(), [&](const ManifestRow& row) { return row.status == status; });
    };
    const auto warned = std::count_if(rows.begin(), rows.end(), [](const ManifestRow& row) {
        return row.status != ItemStatus::NotStarted && row.file && !row.file->figures.warnings.empty();
    });
    std::ostringstream text;
    text << paint("made", Colour::Bold) << "       " << with(ItemStatus::Made) << " of " << rows.size();
    const auto add_count = [&](long count, const char* label) {
        if (count > 0) {
            text << ", " << count << label;
        }
    };
    add_count(with(ItemStatus::Skipped), " skipped: they are up to date");
    add_count(with(ItemStatus::Failed), " failed");
    add_count(with(ItemStatus::NotStarted), " not started");
    text << "; " << std::fixed << std::setprecision(1) << made_after_ << " s\n";
    if (warned > 0) {
        text << paint("warnings", Colour::Yellow) << "   on " << warned << (warned == 1 ? " item" : " items") << "\n";
    }
    if (!options_.left_out.empty()) {
        constexpr std::size_t kNamed = 3;
        const std::size_t count = options_.left_out.size();
        text << paint("left out", Colour::Bold) << "   ";
        for (std::size_t k = 0; k < std::min(count, kNamed); ++k) {
            text << (k == 0 ? "" : ", ") << oneLine(options_.left_out[k].name);
        }
        if (count > kNamed) {
            text << " and " << count - kNamed << " more";
        }
        text << "; the manifest lists the reasons\n";
    }
    if (drawn_tiles_ > 0) {
        text << paint("sheet", Colour::Bold) << "      " << oneLine(*options_.contact_sheet) << ": " << drawn_tiles_
             << (drawn_tiles_ == 1 ? " droplet" : " droplets") << "; " << elapsed() - made_after_ << " s\n";
    }
    text << paint("manifest", Colour::Bold) << "   " << oneLine(options_.manifest) << "\n";
    std::cerr << text.str() << std::flush;
}

}  // namespace cli

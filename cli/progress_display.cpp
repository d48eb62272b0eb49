// SPDX-License-Identifier: GPL-3.0-or-later
#include "progress_display.h"

#include <fmt/core.h>

#include <iostream>
#include <string>
#include <system_error>
#include <utility>

#include "library_message.h"
#include "shape_command.h"
#include "terminal.h"

namespace cli {
namespace {

constexpr std::chrono::seconds kBarDelay{1};        // shorter runs need no bar
constexpr std::chrono::milliseconds kRefresh{100};  // the bar shows tenths of a second
constexpr std::size_t kStages = static_cast<std::size_t>(droplet::Stage::Write) + 1;
constexpr std::size_t kCellsPerStage = 4;

std::string rounded(double value, int decimals)
{
    return fmt::format("{:.{}f}", value, decimals);
}

}  // namespace

ProgressDisplay::ProgressDisplay(ProgressMode mode, CommandTerms terms) : mode_(mode), terms_(std::move(terms))
{
    if (mode_ == ProgressMode::Auto && errorIsTerminal()) {
        try {
            drawer_ = std::thread([this] { drawUntilStopped(); });
        } catch (const std::system_error&) {
            // Without a thread the bar only moves when the run reports its progress.
            next_bar_ = start_ + kBarDelay;
        }
    }
}

ProgressDisplay::~ProgressDisplay()
{
    stop();
}

void ProgressDisplay::begin(droplet::Stage stage, double share)
{
    const std::lock_guard lock(mutex_);
    if (share > 0.0) {
        share_ = share;
        if (mode_ == ProgressMode::Json && item_.empty()) {
            writeLine(*stage_, false);
        }
        drawIfDue();
        return;
    }
    // Stages may alternate, droplet by droplet; the display only moves forward.
    if (stage_ && stage <= *stage_) {
        return;
    }
    stage_ = stage;
    share_ = 0.0;
    if (mode_ == ProgressMode::Json) {
        writeLine(stage, false);
    }
    drawIfDue();
}

void ProgressDisplay::restart(std::string item)
{
    const std::lock_guard lock(mutex_);
    stage_.reset();
    share_ = 0.0;
    count_ = 0;
    item_ = std::move(item);
}

void ProgressDisplay::reportFrame(std::size_t frame, std::size_t count)
{
    report("frame", frame, count);
}

void ProgressDisplay::reportDrawn(std::size_t drawn, std::size_t count)
{
    report("drawn", drawn, count);
}

void ProgressDisplay::report(const char* what, std::size_t done, std::size_t count)
{
    const std::lock_guard lock(mutex_);
    counted_ = what;
    done_ = done;
    count_ = count;
    if (mode_ == ProgressMode::Json) {
        std::cerr << fmt::format(R"({{"{}":{},"of":{},"elapsed_s":{}}})", what, done, count, rounded(elapsed(), 3))
                  << std::endl;
    }
    drawIfDue();
}

void ProgressDisplay::warn(const std::string& warning)
{
    const std::lock_guard lock(mutex_);
    if (is_drawn_) {
        std::cerr << kEraseLine;
    }
    printWarning(withOptions(warning, terms_), mode_);
}

void ProgressDisplay::finish()
{
    stop();
    if (mode_ == ProgressMode::Json && stage_) {
        writeLine(*stage_, true);
    }
}

std::string ProgressDisplay::bar() const
{
    constexpr std::size_t kCells = kCellsPerStage * kStages;
    std::size_t full = 0;
    std::string what;
    if (count_ > 0) {
        full = kCells * done_ / count_;
        what = fmt::format("{}: {} of {}", counted_ == "drawn" ? "pictures" : "frames", done_, count_);
    } else {
        full = kCellsPerStage * static_cast<std::size_t>(*stage_) + static_cast<std::size_t>(share_ * kCellsPerStage);
        what = item_.empty() ? name(*stage_) : item_ + ": " + name(*stage_);
        if (share_ > 0.0) {
            what += fmt::format(": {:.0f} %", 100.0 * share_);
        }
    }
    return "[" + std::string(full, '#') + std::string(kCells - full, '.') + "] " + what + " " + rounded(elapsed(), 1) +
           " s";
}

void ProgressDisplay::writeLine(droplet::Stage stage, bool done) const
{
    const std::string share = share_ > 0.0 && !done ? "\"share\":" + rounded(share_, 2) + "," : "";
    std::cerr << fmt::format(R"({{"stage":"{}","done":{},{}"elapsed_s":{}}})", name(stage), done, share,
                             rounded(elapsed(), 3))
              << std::endl;
}

void ProgressDisplay::draw()
{
    if (stage_ || count_ > 0) {
        std::cerr << kEraseLine << bar() << std::flush;
        is_drawn_ = true;
    }
}

void ProgressDisplay::drawIfDue()
{
    if (next_bar_ && Clock::now() >= *next_bar_) {
        draw();
        next_bar_ = Clock::now() + kRefresh;
    }
}

void ProgressDisplay::drawUntilStopped()
{
    std::unique_lock lock(mutex_);
    for (auto next = start_ + kBarDelay; !stopping_.wait_until(lock, next, [this] { return stopped_; });
         next = Clock::now() + kRefresh) {
        draw();
    }
}

void ProgressDisplay::stop()
{
    {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
    }
    stopping_.notify_all();
    if (drawer_.joinable()) {
        drawer_.join();
    }
    next_bar_.reset();
    if (std::exchange(is_drawn_, false)) {
        std::cerr << kEraseLine << std::flush;
    }
}

}  // namespace cli

// SPDX-License-Identifier: GPL-3.0-or-later
//
// TBB runs as many threads as items in work. A thread that waits for parts of its item does not start another item,
// which would keep the memory of two items. A thread without items helps with the items still in work.
#include "batch_runner.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "batch_manifest.h"
#include "batch_progress.h"
#include "contact_sheet.h"
#include "content_hash.h"
#include "droplet/error.h"
#include "droplet/version.h"
#include "exit_code.h"
#include "files.h"
#include "interruption.h"
#include "library_message.h"
#include "option_values.h"
#include "run_files.h"
#include "seconds.h"
#include "terminal.h"

namespace cli {
namespace {

namespace fs = std::filesystem;
using droplet::Error;

/// Creates the folder of an output, and checks that the output can be written.
void prepare(const std::string& output, const droplet::OutputOptions& options = {})
{
    makeFolderOf(output);
    droplet::checkWritable(output, options);
}

std::size_t threadsOf(const BatchOptions& options)
{
    return options.threads.value_or(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

/// Items of a batch, their results and their progress.
class Batch {
public:
    Batch(const std::vector<BatchItem>& items, const BatchOptions& options, EarlierRun earlier)
        : items_(items),
          options_(options),
          earlier_(std::move(earlier)),
          rows_(shareOfRows()),
          has_ended_(rows_.size(), false),
          progress_(rows_.size(), options)
    {
    }

    /// Refuses to replace existing outputs that are not up to date, if they must not be replaced.
    void refuseReplacing() const
    {
        if (!options_.files.no_clobber) {
            return;
        }
        const auto existing = [](std::vector<std::string> paths) {
            std::error_code ignored;
            std::erase_if(paths, [&](const std::string& path) { return !fs::exists(path, ignored); });
            return paths;
        };
        const auto check = [&](const std::vector<std::string>& paths) {
            for (const std::string& path : paths) {
                droplet::checkWritable(path, options_.files);
            }
        };
        if (options_.contact_sheet) {
            check(existing({*options_.contact_sheet}));
        }
        for (const ManifestRow& row : rows_) {
            const BatchItem& item = items_[row.index];
            std::vector<std::string> paths{item.output};
            paths.insert(paths.end(), item.others.begin(), item.others.end());
            paths = existing(std::move(paths));
            if (!paths.empty() && !isFinished(item, row)) {
                check(paths);
            }
        }
    }

    void run()
    {
        const std::size_t threads = threadsOf(options_);
        constexpr std::size_t kStack = std::size_t{8} << 20;  // the main thread's size
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const tbb::global_control stacks(tbb::global_control::thread_stack_size, kStack);
        tbb::task_arena arena(static_cast<int>(threads));
        arena.execute([&] {
            tbb::task_group group;
            for (std::size_t i = 0; i < std::min(threads, rows_.size()); ++i) {
                group.run([&] {
                    while (const auto place = next()) {
                        work(*place);
                    }
                });
            }
            group.wait();
        });
    }

    /// Paths of the finished outputs, in the order of the items.
    [[nodiscard]] std::vector<std::string> outputs() const
    {
        std::vector<std::string> paths;
        for (const ManifestRow& row : rows_) {
            if (row.status == ItemStatus::Made || row.status == ItemStatus::Skipped) {
                paths.push_back(items_[row.index].output);
            }
        }
        return paths;
    }

    int finish()
    {
        discardAfterFailure();
        progress_.endMaking();
        writeManifest(rows_, items_, options_, progress_.elapsed());
        return std::any_of(rows_.begin(), rows_.end(), hasFailed) ? static_cast<int>(ExitCode::SomeFailed) : 0;
    }

    /// Draws the contact sheet of the finished outputs, if --contact-sheet is given.
    void drawSheet()
    {
        if (!options_.contact_sheet) {
            return;
        }
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threadsOf(options_));
        const ContactSheet sheet{*options_.contact_sheet, options_.material, options_.one_scale, outputs(),
                                 options_.object};
        writeContactSheet(sheet, options_.files,
                          [&](std::size_t drawn) { progress_.reportDrawn(drawn, sheet.droplets.size()); });
    }

    void summarise() { progress_.summarise(rows_); }

private:
    static bool hasFailed(const ManifestRow& row) { return row.status == ItemStatus::Failed; }

    [[nodiscard]] ManifestRow notStarted(std::size_t index) const
    {
        ManifestRow row;
        row.index = index;
        row.file = earlier_.at(items_[index]);
        return row;
    }

    [[nodiscard]] std::vector<ManifestRow> shareOfRows() const
    {
        std::vector<ManifestRow> rows;
        const BatchShard shard = options_.shard.value_or(BatchShard{});
        for (std::size_t i = shard.index - 1; i < items_.size(); i += shard.count) {
            rows.push_back(notStarted(i));
        }
        return rows;
    }

    /// Index of the next row to work on.
    std::optional<std::size_t> next()
    {
        const std::lock_guard lock(mutex_);
        if (next_ == rows_.size() || Interruption::receivedSignal() != 0 || (failed_ && !options_.keep_going)) {
            return std::nullopt;
        }
        return next_++;
    }

    void work(std::size_t place)
    {
        const auto start = Clock::now();
        ManifestRow row = rows_[place];
        tbb::this_task_arena::isolate([&] { make(row); });
        row.time = secondsSince(start);

        const std::lock_guard lock(mutex_);
        rows_[place] = std::move(row);
        has_ended_[place] = true;
        ++ended_;
        failed_ = failed_ || hasFailed(rows_[place]);
        reportInOrder();
        progress_.drawBar(ended_);
        updateManifest();
    }

    static std::string fingerprintOfWork(const BatchWork& work)
    {
        return fingerprintOf({droplet::kVersion, work.fingerprint});
    }

    /// Whether all files of an item are up to date; an item whose input cannot be read fails in its turn.
    [[nodiscard]] bool isFinished(const BatchItem& item, const ManifestRow& row) const
    {
        if (!options_.resume || !row.file) {
            return false;
        }
        try {
            return isUpToDate(item, fingerprintOfWork(item.open()), row.file);
        } catch (const Error&) {
            return true;
        }
    }

    /// Makes one item. Its failure does not affect other items.
    void make(ManifestRow& row) const
    {
        const auto fail = [&](const std::string& error, ExitCode code) {
            row.file.reset();
            row.status = ItemStatus::Failed;
            row.error = oneLine(error);
            row.exit_code = static_cast<int>(code);
        };
        const BatchItem& item = items_[row.index];
        try {
            BatchWork work = item.open();
            const std::string fingerprint = fingerprintOfWork(work);
            if (options_.resume && isUpToDate(item, fingerprint, row.file)) {
                row.status = ItemStatus::Skipped;
                return;
            }
            row.file.reset();
            prepare(item.output, options_.files);
            for (const std::string& other : item.others) {
                prepare(other, options_.files);
            }
            MadeFile file;
            file.fingerprint = fingerprint;
            file.others = item.others;
            file.figures = work.make();
            work = {};  // the input's memory
            file.sha256 = hashOfFile(item.output);
            std::error_code no_size;  // devices have no size
            const auto bytes = fs::file_size(item.output, no_size);
            file.bytes = no_size ? 0 : bytes;
            row.file = std::move(file);
            row.status = ItemStatus::Made;
        } catch (const Error& error) {
            fail(withOptionOfFile(withOptions(error.what(), options_.terms), {options_.read, {}}),
                 exitCodeOf(error.code()));
        } catch (const std::bad_alloc&) {
            fail("out of memory; use fewer triangles, a smaller picture or fewer threads", ExitCode::InternalError);
        } catch (const std::exception& error) {
            fail(std::string("internal error: ") + error.what(), ExitCode::InternalError);
        } catch (...) {
            fail("internal error", ExitCode::InternalError);
        }
    }

    void reportInOrder()
    {
        while (reported_ < rows_.size() && has_ended_[reported_] && !reported_failure_) {
            const ManifestRow& row = rows_[reported_++];
            progress_.reportItem(items_[row.index], row);
            reported_failure_ = hasFailed(row) && !options_.keep_going;
        }
    }

    /// Marks all items behind the first failed one as not started, as if items had been made one after another.
    void discardAfterFailure()
    {
        const auto failed = std::find_if(rows_.begin(), rows_.end(), hasFailed);
        if (options_.keep_going || failed == rows_.end()) {
            return;
        }
        std::for_each(failed + 1, rows_.end(), [&](ManifestRow& row) { row = notStarted(row.index); });
    }

    void updateManifest()
    {
        if (secondsSince(updated_at_) < interval_) {
            return;
        }
        const auto start = Clock::now();
        try {
            writeManifest(rows_, items_, options_, progress_.elapsed());
        } catch (const Error&) {
            // Writing is tried again later; the last failure is reported.
        }
        // Writing a manifest of a million rows must take a small share of the time.
        constexpr double kShare = 20.0;
        interval_ = std::max(interval_, kShare * secondsSince(start));
        updated_at_ = Clock::now();
    }

    const std::vector<BatchItem>& items_;
    const BatchOptions& options_;
    EarlierRun earlier_;

    std::mutex mutex_;  ///< guards all members below while threads run
    std::vector<ManifestRow> rows_;
    std::vector<bool> has_ended_;  ///< by row
    BatchProgress progress_;
    std::size_t next_ = 0;
    std::size_t ended_ = 0;
    std::size_t reported_ = 0;
    bool failed_ = false;
    bool reported_failure_ = false;
    Clock::time_point updated_at_ = Clock::now();
    double interval_ = 5.0;  ///< [s]
};

}  // namespace

void checkItems(const std::vector<BatchItem>& items, const BatchOptions& options)
{
    if (items.empty()) {
        refuse("there are no items to make");
    }
    RunFiles files;
    files.read = options.read;
    files.writes("the manifest", options.manifest);
    files.writes("the contact sheet", options.contact_sheet);
    for (const BatchItem& item : items) {
        if (!item.input.empty()) {
            files.reads("input " + item.input, item.input);
        }
        files.writes("output of " + item.name, item.output);
        for (const std::string& other : item.others) {
            files.writes("output of " + item.name, other);
        }
    }
    refuseClashes(files);
}

int makeAll(const std::vector<BatchItem>& items, const BatchOptions& options)
{
    Batch batch(items, options, EarlierRun(options.manifest));
    batch.refuseReplacing();
    prepare(options.manifest);
    if (options.contact_sheet) {
        prepare(*options.contact_sheet, options.files);
    }
    int code = 0;
    int signal = 0;
    {
        const Interruption interruption;
        batch.run();
        code = batch.finish();
        signal = Interruption::receivedSignal();
    }
    if (signal != 0) {
        batch.summarise();
        endBySignal(signal);
    }
    try {
        batch.drawSheet();
    } catch (...) {
        batch.summarise();
        throw;
    }
    batch.summarise();
    return code;
}

}  // namespace cli

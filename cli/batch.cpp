// SPDX-License-Identifier: GPL-3.0-or-later
//
// SHA-256: FIPS 180-4, of libmd.
//
// Threads are those of TBB, as many as items are worked on at one time. A thread that waits for the parts of its item
// takes no other item in the meantime, which would bind two items' memory to it; one that finds no more items helps
// with those still in work.
#include "batch.h"

#include <fcntl.h>
#include <sha256.h>
#include <sys/stat.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <mutex>
#include <new>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>
#include <unordered_map>

#include "contact_sheet.h"
#include "droplet/error.h"
#include "droplet/version.h"
#include "exit_code.h"
#include "option_values.h"
#include "terminal.h"

namespace cli {
namespace {

namespace fs = std::filesystem;
using droplet::Error;
using droplet::ErrorCode;
using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "droplet-shape.manifest/1";

double secondsSince(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

class Hash {
public:
    Hash() { SHA256Init(&state_); }

    void add(const void* bytes, std::size_t count)
    {
        SHA256Update(&state_, static_cast<const std::uint8_t*>(bytes), count);
    }

    std::string hexadecimal()
    {
        std::array<char, SHA256_DIGEST_STRING_LENGTH> text{};
        SHA256End(&state_, text.data());
        return text.data();
    }

private:
    SHA2_CTX state_{};
};

// --- Places
// -----------------------------------------------------------------------------------------------------------

/// One name for every way to write a path.
class Places {
public:
    std::string of(const std::string& path)
    {
        std::error_code ignored;
        const fs::path absolute = fs::absolute(path, ignored);
        if (fs::is_symlink(fs::symlink_status(absolute, ignored))) {
            return fs::weakly_canonical(absolute, ignored).string();
        }
        auto [folder, is_new] = folders_.try_emplace(absolute.parent_path().string());
        if (is_new) {
            folder->second = fs::weakly_canonical(absolute.parent_path(), ignored).string();
        }
        return (fs::path(folder->second) / absolute.filename()).lexically_normal().string();
    }

private:
    std::unordered_map<std::string, std::string> folders_;
};

/// The same file under another name (a hard link).
std::optional<std::pair<dev_t, ino_t>> identity(const std::string& path)
{
    struct stat status = {};
    if (stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) {
        return std::nullopt;
    }
    return std::pair(status.st_dev, status.st_ino);
}

/// Two outputs in one place would each be lost or mixed with the other; an output in an input's place would replace it.
void refuseClashes(const std::vector<BatchItem>& items, const BatchOptions& options)
{
    Places places;
    std::unordered_map<std::string, std::string> read;
    std::map<std::pair<dev_t, ino_t>, std::string> read_files;
    const auto add_read = [&](const std::string& path) {
        if (!path.empty() && read.try_emplace(places.of(path), path).second) {
            if (const auto file = identity(path)) {
                read_files.try_emplace(*file, path);
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
        const std::string place = places.of(path);
        const auto [other, is_new] = written.try_emplace(place, of);
        if (!is_new) {
            refuse(of + " and " + other->second + " have the same output, '" + path + "'; every output needs its own");
        }
        const auto file = identity(path);
        if (read.count(place) > 0 || (file && read_files.count(*file) > 0)) {
            refuse("the output of " + of + " would replace '" + path + "', which is read");
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

void makeFolder(const std::string& path)
{
    const fs::path folder = fs::path(path).parent_path();
    std::error_code failure;
    if (!folder.empty() && !fs::is_directory(folder, failure) && !fs::create_directories(folder, failure) && failure) {
        throw Error(ErrorCode::OutputFailed, "folder " + folder.string() + " cannot be made: " + failure.message());
    }
}

// --- Rows
// -------------------------------------------------------------------------------------------------------------

enum class Status { NotStarted, Made, Skipped, Failed };

const char* name(Status status)
{
    switch (status) {
        case Status::Made:
            return "made";
        case Status::Skipped:
            return "skipped";
        case Status::Failed:
            return "failed";
        case Status::NotStarted:
            break;
    }
    return "not started";
}

/// What is known of a file: how it was made, how it can be told that it is still the same, and what it holds.
struct Record {
    std::string fingerprint;
    std::uint64_t bytes = 0;
    std::string sha256;
    std::vector<std::string> others;  ///< made along with it
    BatchFigures figures;
};

struct Row {
    std::size_t index = 0;  ///< among all items, whatever the shard
    Status status = Status::NotStarted;
    std::string error;
    int exit_code = 0;
    std::optional<Record> record;  ///< of the file as this run left it, or of an earlier run if it was not started
    double time = 0.0;             ///< [s]
    bool ended = false;
};

Json jsonOf(const Row& row, const BatchItem& item)
{
    Json json{{"index", row.index + 1},
              {"name", item.name},
              {"input", item.input.empty() ? Json() : Json(item.input)},
              {"output", item.output},
              {"status", name(row.status)},
              {"error", row.status == Status::Failed ? Json(row.error) : Json()},
              {"exit_code", row.status == Status::NotStarted ? Json() : Json(row.exit_code)}};
    if (row.record) {
        const BatchFigures& figures = row.record->figures;
        json.update(Json{{"fingerprint", row.record->fingerprint},
                         {"bytes", row.record->bytes},
                         {"sha256", row.record->sha256},
                         {"others", row.record->others},
                         {"triangles", figures.triangles},
                         {"vertices", figures.vertices},
                         {"closed", figures.closed},
                         {"volume_m3", figures.volume},
                         {"height_max_m", figures.height_max},
                         {"warnings", figures.warnings}});
    } else {
        for (const char* key : {"fingerprint", "bytes", "sha256", "others", "triangles", "vertices", "closed",
                                "volume_m3", "height_max_m", "warnings"}) {
            json[key] = nullptr;
        }
    }
    json["time_s"] = row.time;
    return json;
}

std::optional<Record> recordIn(const Json& row)
{
    if (!row.at("fingerprint").is_string()) {
        return std::nullopt;
    }
    Record record;
    row.at("fingerprint").get_to(record.fingerprint);
    row.at("bytes").get_to(record.bytes);
    row.at("sha256").get_to(record.sha256);
    row.at("others").get_to(record.others);
    row.at("triangles").get_to(record.figures.triangles);
    row.at("vertices").get_to(record.figures.vertices);
    row.at("closed").get_to(record.figures.closed);
    row.at("volume_m3").get_to(record.figures.volume);
    row.at("height_max_m").get_to(record.figures.height_max);
    row.at("warnings").get_to(record.figures.warnings);
    return record;
}

/// A text as it comes back from JSON, in which everything is UTF-8.
std::string inJson(const std::string& text)
{
    return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

/// What an earlier run wrote of each output; empty if there was none.
/// @throws Error InvalidArgument if the file is something else, which must not be replaced
std::unordered_map<std::string, Record> readManifest(const std::string& path)
{
    std::error_code failure;
    if (!fs::is_regular_file(path, failure)) {
        return {};  // none yet, or a device, which may be endless
    }
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    std::unordered_map<std::string, Record> records;
    if (text.empty()) {
        return records;
    }
    try {
        const Json manifest = Json::parse(text);
        if (manifest.at("schema") != kSchema) {
            throw std::invalid_argument("another schema");
        }
        for (const Json& row : manifest.at("items")) {
            if (auto record = recordIn(row)) {
                records.insert_or_assign(row.at("output").get<std::string>(), std::move(*record));
            }
        }
    } catch (const std::exception&) {
        refuse("--manifest: " + path + " exists and is no " + kSchema + "; name another file, or remove it");
    }
    return records;
}

/// Whether an item's files are there, as an earlier run left them.
bool stands(const BatchItem& item, const std::string& fingerprint, const std::optional<Record>& earlier)
{
    std::error_code failure;
    if (!earlier || earlier->fingerprint != fingerprint || !fs::is_regular_file(item.output, failure) ||
        fs::file_size(item.output, failure) != earlier->bytes || failure) {
        return false;
    }
    for (const std::string& other : item.others) {
        const bool was_made =
            std::find(earlier->others.begin(), earlier->others.end(), inJson(other)) != earlier->others.end();
        if (!was_made || !fs::exists(other, failure)) {
            return false;
        }
    }
    try {
        return sha256OfFile(item.output) == earlier->sha256;
    } catch (const Error&) {
        return false;  // making it anew will tell what is wrong
    }
}

// --- Interruption
// -----------------------------------------------------------------------------------------------------

/// The signal that asked for an end, or 0. Handlers of signals reach nothing but globals.
std::atomic<int> asked_to_end{0};
static_assert(std::atomic<int>::is_always_lock_free);

/// While one lives, signals that ask for an end are noted, once each; a second one ends the process.
class Interruption {
public:
    Interruption()
    {
        asked_to_end = 0;
        for (Handled& handled : handled_) {
            struct sigaction action = {};
            action.sa_handler = [](int signal) { asked_to_end = signal; };
            action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
            sigaction(handled.signal, nullptr, &handled.before);
            if (handled.before.sa_handler != SIG_IGN) {  // as nohup wants it
                sigaction(handled.signal, &action, nullptr);
            }
        }
    }

    ~Interruption()
    {
        for (const Handled& handled : handled_) {
            sigaction(handled.signal, &handled.before, nullptr);
        }
    }

    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    [[nodiscard]] static bool asked() { return asked_to_end != 0; }

private:
    struct Handled {
        int signal;
        struct sigaction before = {};
    };
    std::array<Handled, 3> handled_{{{SIGINT}, {SIGTERM}, {SIGHUP}}};
};

// --- Telling
// ----------------------------------------------------------------------------------------------------------

std::string messageOf(const BatchItem& item, const std::string& error)
{
    return error.rfind(item.name + ": ", 0) == 0 ? error : item.name + ": " + error;
}

/// Says on standard error how far a batch has come, one item after another.
class Teller {
public:
    Teller(std::size_t items, const BatchOptions& options)
        : items_(items),
          quiet_(options.verbosity == Verbosity::Quiet),
          verbose_(options.verbosity == Verbosity::Verbose),
          json_(options.progress == ProgressMode::Json),
          bar_(!quiet_ && options.progress == ProgressMode::Auto && errorIsTerminal())
    {
    }

    void tell(const BatchItem& item, const Row& row)
    {
        ++told_;
        if (json_) {
            std::cerr << Json{{"item", told_},
                              {"of", items_},
                              {"name", item.name},
                              {"output", item.output},
                              {"status", name(row.status)},
                              {"error", row.status == Status::Failed ? Json(row.error) : Json()},
                              {"elapsed_s", std::round(1e3 * secondsSince(start_)) / 1e3}}
                             .dump(-1, ' ', false, Json::error_handler_t::replace)
                      << std::endl;
            return;
        }
        if (row.status == Status::Failed) {
            eraseBar();
            std::cerr << paint("droplet-shape: ", Colour::Red) << oneLine(messageOf(item, row.error)) << std::endl;
        } else if (verbose_) {
            eraseBar();
            std::cerr << paint(name(row.status), Colour::Bold) << std::string(11 - std::strlen(name(row.status)), ' ')
                      << oneLine(item.output) << std::endl;
        }
    }

    void drawBar(std::size_t ended)
    {
        if (!bar_ || secondsSince(drawn_at_) < kRefresh) {
            return;
        }
        constexpr std::size_t kCells = 28;
        const std::size_t full = ended * kCells / std::max<std::size_t>(1, items_);
        std::cerr << kEraseLine << "[" << std::string(full, '#') << std::string(kCells - full, '.') << "] " << ended
                  << " of " << items_ << std::flush;
        drawn_ = true;
        drawn_at_ = Clock::now();
    }

    void eraseBar()
    {
        if (drawn_) {
            std::cerr << kEraseLine << std::flush;
            drawn_ = false;
        }
    }

    void summarise(const std::vector<Row>& rows, std::size_t left_out, const std::string& manifest)
    {
        eraseBar();
        if (json_ || quiet_) {
            return;
        }
        const auto with = [&](Status status) {
            return std::count_if(rows.begin(), rows.end(), [&](const Row& row) { return row.status == status; });
        };
        const auto warned = std::count_if(rows.begin(), rows.end(), [](const Row& row) {
            return row.status != Status::NotStarted && row.record && !row.record->figures.warnings.empty();
        });
        std::ostringstream text;
        text << paint("made", Colour::Bold) << "       " << with(Status::Made) << " of " << rows.size();
        const auto tell_some = [&](long count, const char* words) {
            if (count > 0) {
                text << ", " << count << words;
            }
        };
        tell_some(with(Status::Skipped), " skipped: they stand as they would be made");
        tell_some(with(Status::Failed), " failed");
        tell_some(with(Status::NotStarted), " not started");
        text << "; " << std::fixed << std::setprecision(1) << secondsSince(start_) << " s\n";
        if (warned > 0) {
            text << paint("warnings", Colour::Yellow) << "   on " << warned << (warned == 1 ? " item" : " items")
                 << "\n";
        }
        if (left_out > 0) {
            text << paint("left out", Colour::Bold) << "   " << left_out << ", the manifest says why\n";
        }
        text << paint("manifest", Colour::Bold) << "   " << oneLine(manifest) << "\n";
        std::cerr << text.str() << std::flush;
    }

    [[nodiscard]] double elapsed() const { return secondsSince(start_); }

private:
    static constexpr const char* kEraseLine = "\r\033[K";
    static constexpr double kRefresh = 0.1;  // [s]

    std::size_t items_;
    bool quiet_;
    bool verbose_;
    bool json_;
    bool bar_;
    std::size_t told_ = 0;
    bool drawn_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point drawn_at_ = start_;
};

// --- The batch itself
// -------------------------------------------------------------------------------------------------

class Batch {
public:
    Batch(const std::vector<BatchItem>& items, const std::vector<std::size_t>& chosen, const BatchOptions& options,
          std::unordered_map<std::string, Record> earlier)
        : items_(items), options_(options), earlier_(std::move(earlier)), teller_(chosen.size(), options)
    {
        for (const std::size_t index : chosen) {
            Row row;
            row.index = index;
            row.record = earlierOf(items[index]);
            rows_.push_back(std::move(row));
        }
    }

    void run()
    {
        const std::size_t threads =
            options_.threads.value_or(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
        constexpr std::size_t kStack = std::size_t{8} << 20;  // as the first thread has
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

    /// The files that are as they were asked for, in their order.
    [[nodiscard]] std::vector<std::string> outputs() const
    {
        std::vector<std::string> paths;
        for (const Row& row : rows_) {
            if (row.status == Status::Made || row.status == Status::Skipped) {
                paths.push_back(items_[row.index].output);
            }
        }
        return paths;
    }

    int finish()
    {
        settle();
        writeManifest();
        teller_.summarise(rows_, options_.left_out.size(), options_.manifest);
        const bool failed =
            std::any_of(rows_.begin(), rows_.end(), [](const Row& row) { return row.status == Status::Failed; });
        return failed ? kSomeFailed : 0;
    }

private:
    [[nodiscard]] std::optional<Record> earlierOf(const BatchItem& item) const
    {
        const auto found = earlier_.find(inJson(item.output));
        return found == earlier_.end() ? std::nullopt : std::optional(found->second);
    }

    /// The row to work on next.
    std::optional<std::size_t> next()
    {
        const std::lock_guard lock(mutex_);
        if (next_ == rows_.size() || Interruption::asked() || (failed_ && !options_.keep_going)) {
            return std::nullopt;
        }
        return next_++;
    }

    void work(std::size_t place)
    {
        const auto start = Clock::now();
        Row row = rows_[place];
        const BatchItem& item = items_[row.index];
        tbb::this_task_arena::isolate([&] { make(item, row); });
        row.time = secondsSince(start);
        row.ended = true;

        const std::lock_guard lock(mutex_);
        rows_[place] = std::move(row);
        ++ended_;
        failed_ = failed_ || rows_[place].status == Status::Failed;
        tellInOrder();
        teller_.drawBar(ended_);
        keepManifest();
    }

    /// Whatever happens to one item must not end the others.
    void make(const BatchItem& item, Row& row) const
    {
        const auto fail = [&](const std::string& error, ExitCode code) {
            row.record.reset();
            row.status = Status::Failed;
            row.error = oneLine(error);
            row.exit_code = static_cast<int>(code);
        };
        try {
            BatchWork work = item.open();
            const std::string fingerprint = fingerprintOf({droplet::kVersion, work.fingerprint});
            if (options_.resume && stands(item, fingerprint, row.record)) {
                row.status = Status::Skipped;
                return;
            }
            row.record.reset();
            prepare(item.output);
            for (const std::string& other : item.others) {
                prepare(other);
            }
            Record record;
            record.fingerprint = fingerprint;
            record.others = item.others;
            record.figures = work.make();
            work = {};  // the input's memory
            record.sha256 = sha256OfFile(item.output);
            std::error_code no_size;  // of a device
            const auto bytes = fs::file_size(item.output, no_size);
            record.bytes = no_size ? 0 : bytes;
            row.record = std::move(record);
            row.status = Status::Made;
        } catch (const Error& error) {
            fail(error.what(), exitCodeOf(error.code()));
        } catch (const std::bad_alloc&) {
            fail("out of memory; fewer --triangles, a smaller picture or fewer --threads need less",
                 ExitCode::InternalError);
        } catch (const std::exception& error) {
            fail(std::string("internal error: ") + error.what(), ExitCode::InternalError);
        } catch (...) {
            fail("internal error", ExitCode::InternalError);
        }
    }

    /// What is known to fail must fail before any work is done.
    void prepare(const std::string& output) const
    {
        makeFolder(output);
        droplet::checkWritable(output, options_.files);
    }

    void tellInOrder()
    {
        while (told_ < rows_.size() && rows_[told_].ended && !told_failure_) {
            const Row& row = rows_[told_++];
            teller_.tell(items_[row.index], row);
            told_failure_ = row.status == Status::Failed && !options_.keep_going;
        }
    }

    /// What comes after the first that failed counts as not started, as if one had been worked on after another.
    void settle()
    {
        if (options_.keep_going) {
            return;
        }
        const auto failed =
            std::find_if(rows_.begin(), rows_.end(), [](const Row& row) { return row.status == Status::Failed; });
        if (failed == rows_.end()) {
            return;
        }
        for (auto row = failed + 1; row != rows_.end(); ++row) {
            Row fresh;
            fresh.index = row->index;
            fresh.record = earlierOf(items_[row->index]);
            *row = std::move(fresh);
        }
    }

    void keepManifest()
    {
        if (secondsSince(kept_at_) < interval_) {
            return;
        }
        const auto start = Clock::now();
        try {
            writeManifest();
        } catch (const Error&) {
            // It is tried again, and at the end the cause is told.
        }
        // A manifest of a million rows must not take the time of the work.
        constexpr double kShare = 20.0;
        interval_ = std::max(interval_, kShare * secondsSince(start));
        kept_at_ = Clock::now();
    }

    void writeManifest() const
    {
        Json options = Json::object();
        for (const auto& [key, value] : options_.told) {
            options[key] = value;
        }
        Json items = Json::array();
        std::map<Status, std::size_t> counts;
        std::uint64_t bytes = 0;
        std::size_t triangles = 0;
        for (const Row& row : rows_) {
            items.push_back(jsonOf(row, items_[row.index]));
            ++counts[row.status];
            if (row.record && row.status != Status::NotStarted) {
                bytes += row.record->bytes;
                triangles += row.record->figures.triangles;
            }
        }
        Json left_out = Json::array();
        for (const auto& [what, reason] : options_.left_out) {
            left_out.push_back({{"name", what}, {"reason", reason}});
        }
        const Json manifest{
            {"schema", kSchema},
            {"version", droplet::kVersion},
            {"options", options},
            {"shard",
             options_.shard ? Json{{"index", options_.shard->index}, {"count", options_.shard->count}} : Json()},
            {"items", items},
            {"left_out", left_out},
            {"totals",
             {{"items", rows_.size()},
              {"made", counts[Status::Made]},
              {"skipped", counts[Status::Skipped]},
              {"failed", counts[Status::Failed]},
              {"not_started", counts[Status::NotStarted]},
              {"bytes", bytes},
              {"triangles", triangles},
              {"time_s", teller_.elapsed()}}}};
        droplet::writeWhole(options_.manifest, [&](std::ostream& out) {
            out << manifest.dump(1, ' ', false, Json::error_handler_t::replace) << "\n";
        });
    }

    const std::vector<BatchItem>& items_;
    const BatchOptions& options_;
    std::unordered_map<std::string, Record> earlier_;  ///< by output
    std::vector<Row> rows_;
    Teller teller_;

    std::mutex mutex_;  ///< over all below, and rows_ while threads run
    std::size_t next_ = 0;
    std::size_t ended_ = 0;
    std::size_t told_ = 0;
    bool failed_ = false;
    bool told_failure_ = false;
    Clock::time_point kept_at_ = Clock::now();
    double interval_ = 5.0;  ///< [s]
};

/// The path that a share of a batch has: with the share in its name.
std::string ofShard(fs::path path, const std::optional<BatchShard>& shard)
{
    if (shard) {
        path.replace_filename(path.stem().string() + "-" + std::to_string(shard->index) + "-of-" +
                              std::to_string(shard->count) + path.extension().string());
    }
    return path.string();
}

}  // namespace

BatchFigures figuresOf(const droplet::Report& report)
{
    return {report.output.triangles, report.output.vertices,  report.output.topology.closed,
            report.total.volume,     report.total.height_max, report.warnings};
}

void declareBatch(CommandLine& line)
{
    constexpr const char* kGroup = "Batch";
    line.addFlag(kGroup, "--keep-going", "go on after an item that failed");
    line.addFlag(kGroup, "--no-resume", "make again what stands as it would be made");
    line.add(kGroup, "--shard", "SHARE", "2/8 makes every 8th item, from the second on");
    line.add(kGroup, "--manifest", "FILE",
             "what became of every item, as JSON\n"
             "[manifest.json in the folder of all outputs]");
    line.add(kGroup, "--contact-sheet", "FILE", "draw all of them on one picture, PNG");
}

BatchOptions readBatch(const CommandLine& line, const RunOptions& run, const std::string& output_pattern)
{
    BatchOptions options;
    options.keep_going = line.flag("--keep-going");
    options.resume = !line.flag("--no-resume");
    if (const auto shard = line.value("--shard")) {
        options.shard = shardOf(shard->text, shard->subject);
    }
    const auto manifest = line.value("--manifest");
    options.manifest =
        manifestPath(output_pattern, manifest ? std::optional(manifest->text) : std::nullopt, options.shard);
    if (const auto sheet = line.value("--contact-sheet")) {
        if (fs::path(sheet->text).extension() != ".png") {
            refuse(*sheet, "a file that ends in .png");
        }
        options.contact_sheet = ofShard(sheet->text, options.shard);
        const auto format = line.value("--format");
        if (format && fs::path(output_pattern).extension() != "." + format->text) {
            refuse("--contact-sheet reads droplets by their extension: --output must end in ." + format->text);
        }
    }
    if (const auto material = line.value("--material")) {
        options.material = forOption(material->subject, [&] { return droplet::materialNamed(material->text); });
    }
    options.told = decisiveOptions(line);
    if (run.config) {
        options.read.push_back(*run.config);
    }
    options.files = run.files;
    options.threads = run.threads;
    options.verbosity = run.verbosity;
    options.progress = run.progress;
    return options;
}

std::vector<std::pair<std::string, std::string>> decisiveOptions(const CommandLine& line)
{
    static const std::set<std::string> others{"--config",   "--help",       "--json",      "--keep-going",
                                              "--manifest", "--no-clobber", "--no-resume", "--output",
                                              "--progress", "--quiet",      "--recursive", "--shard",
                                              "--threads",  "--verbose",    "--version",   "--contact-sheet"};
    std::vector<std::pair<std::string, std::string>> decisive;
    for (const auto& [name, value] : line.given()) {
        if (others.count(name) == 0) {
            decisive.emplace_back(name.substr(2), value);
        }
    }
    return decisive;
}

std::string manifestPath(const std::string& output_pattern, const std::optional<std::string>& given,
                         const std::optional<BatchShard>& shard)
{
    const std::string fixed = output_pattern.substr(0, output_pattern.find_first_of("{%"));
    return ofShard(given ? fs::path(*given) : fs::path(fixed.substr(0, fixed.rfind('/') + 1)) / "manifest.json", shard);
}

BatchShard shardOf(const std::string& text, const std::string& subject)
{
    constexpr std::size_t kMost = 1'000'000;
    const auto number = [](std::string_view digits) {
        std::size_t value = 0;
        const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        return failure == std::errc{} && end == digits.data() + digits.size() ? value : 0;
    };
    const auto slash = text.find('/');
    const BatchShard shard{number(std::string_view(text).substr(0, slash)),
                           slash == std::string::npos ? 0 : number(std::string_view(text).substr(slash + 1))};
    if (shard.index < 1 || shard.index > shard.count || shard.count > kMost) {
        refuse({text, subject}, "a share and the number of shares, such as 2/8");
    }
    return shard;
}

std::string sha256(std::span<const std::byte> bytes)
{
    Hash hash;
    hash.add(bytes.data(), bytes.size());
    return hash.hexadecimal();
}

std::string sha256OfFile(const std::string& path)
{
    Hash hash;
    std::ifstream file(path, std::ios::binary);
    std::vector<char> chunk(std::size_t{1} << 18);
    while (file.read(chunk.data(), static_cast<std::streamsize>(chunk.size())) || file.gcount() > 0) {
        hash.add(chunk.data(), static_cast<std::size_t>(file.gcount()));
    }
    if (!file.eof()) {
        throw Error(ErrorCode::InvalidInput, path + " cannot be read: " + std::strerror(errno));
    }
    return hash.hexadecimal();
}

std::string fingerprintOf(const std::vector<std::string>& parts)
{
    Hash hash;
    for (const std::string& part : parts) {
        const std::string length = std::to_string(part.size()) + ":";
        hash.add(length.data(), length.size());
        hash.add(part.data(), part.size());
    }
    return hash.hexadecimal();
}

int makeAll(const std::vector<BatchItem>& items, const BatchOptions& options)
{
    if (items.empty()) {
        refuse("there is nothing to make");
    }
    refuseClashes(items, options);
    makeFolder(options.manifest);
    droplet::checkWritable(options.manifest);
    if (options.contact_sheet) {
        makeFolder(*options.contact_sheet);
        droplet::checkWritable(*options.contact_sheet, options.files);
    }
    auto earlier = readManifest(options.manifest);
    std::vector<std::size_t> chosen;
    const BatchShard shard = options.shard.value_or(BatchShard{});
    for (std::size_t i = shard.index - 1; i < items.size(); i += shard.count) {
        chosen.push_back(i);
    }
    int code = 0;
    int signal = 0;
    std::vector<std::string> outputs;
    {
        const Interruption interruption;
        Batch batch(items, chosen, options, std::move(earlier));
        batch.run();
        code = batch.finish();
        signal = asked_to_end;
        outputs = batch.outputs();
    }
    if (signal != 0) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
    if (options.contact_sheet) {
        const tbb::global_control limit(
            tbb::global_control::max_allowed_parallelism,
            options.threads.value_or(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)));
        writeContactSheet({*options.contact_sheet, options.material, std::move(outputs)}, options.files);
    }
    return code;
}

}  // namespace cli

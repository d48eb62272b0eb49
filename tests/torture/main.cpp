// SPDX-License-Identifier: GPL-3.0-or-later
//
//   torture [--corpus NAME] [--every N] [--limit SECONDS] [--workers N] [--failures FOLDER]
//   torture [...] FILE|FOLDER...
//
// Makes droplets of thousands of awkward pictures: of the given files, or by default of every glyph of a large font, an
// icon theme, noise and drawings. Each must give sound droplets or be refused with a reason, within 2 s of processor
// time. Broken and hostile SVG, meshes and fonts must be read or refused, too. Pictures alternate between kinds of
// fill; every 101st also runs through the command. One line reports every corpus, and one every failure, whose picture
// is kept in the folder; `torture FILE` tries it again with every kind of fill.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "droplet/units.h"
#include "torture/corpus.h"
#include "torture/trial.h"
#include "torture/workers.h"

namespace droplet::torture {
namespace {

struct Options {
    std::vector<std::filesystem::path> paths;
    std::string corpus;     ///< name of the only corpus to try; empty: all
    std::size_t every = 1;  ///< try only every n-th item
    double limit = 2.0;     ///< [s]
    std::size_t workers = std::max(1U, std::thread::hardware_concurrency());
    std::filesystem::path failures = "failures";
};

/// Results of a corpus.
class Tally {
public:
    void add(std::size_t item, const Verdict& verdict)
    {
        ++items_;
        droplets_ += verdict.droplets;
        triangles_ += verdict.triangles;
        if (verdict.seconds > slowest_.value) {
            slowest_ = {verdict.seconds, item};
        }
        if (verdict.min_angle < sharpest_.value) {
            sharpest_ = {verdict.min_angle, item};
        }
        if (verdict.outcome == Outcome::Refused) {
            // Messages are grouped by the text before the colon; numbers follow it.
            ++refused_[verdict.message.substr(0, verdict.message.find(':'))];
        }
        failed_ += verdict.outcome == Outcome::Failed ? 1 : 0;
    }

    void print(const Corpus& corpus) const
    {
        std::printf("%s: %zu items", corpus.name.c_str(), items_);
        if (!corpus.trial) {
            std::printf(", %zu droplets, %zu triangles", droplets_, triangles_);
        }
        if (slowest_.item) {
            std::printf("; slowest %.2f s (%s)", slowest_.value, corpus.item(*slowest_.item).name.c_str());
        }
        if (sharpest_.item) {
            std::printf("; smallest angle %.3g degrees (%s)", sharpest_.value / kDegree,
                        corpus.item(*sharpest_.item).name.c_str());
        }
        std::size_t refused = 0;
        for (const auto& [reason, count] : refused_) {
            refused += count;
            if (!corpus.trial) {
                std::printf("; %zu refused, %s", count, reason.c_str());
            }
        }
        if (corpus.trial) {
            std::printf("; %zu read, %zu refused", items_ - refused - failed_, refused);
        }
        std::printf("; %zu failed\n", failed_);
        std::fflush(stdout);
    }

    [[nodiscard]] std::size_t failed() const { return failed_; }

private:
    struct Extreme {
        double value;
        std::optional<std::size_t> item;
    };
    std::size_t items_ = 0;
    std::size_t droplets_ = 0;
    std::size_t triangles_ = 0;
    std::size_t failed_ = 0;
    Extreme slowest_{0.0, {}};
    Extreme sharpest_{std::numeric_limits<double>::infinity(), {}};
    std::map<std::string, std::size_t> refused_;
};

/// Saves a failing picture, named after its corpus and itself.
std::filesystem::path keep(const Item& item, const std::string& corpus, const std::filesystem::path& folder)
{
    std::string name = corpus + "_" + item.name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '/' || c == ' '; }, '_');
    std::filesystem::create_directories(folder);
    std::ofstream file(folder / name, std::ios::binary);
    file.write(reinterpret_cast<const char*>(item.bytes.data()), static_cast<std::streamsize>(item.bytes.size()));
    return folder / name;
}

/// Turns a verdict that took too long into a failure.
Verdict judged(Verdict verdict, double limit)
{
    if (verdict.outcome != Outcome::Failed && verdict.seconds > limit) {
        verdict.outcome = Outcome::Failed;
        verdict.message = "took " + std::to_string(verdict.seconds) + " s of processor time";
    }
    return verdict;
}

/// @return the number of failures
std::size_t run(const Corpus& corpus, const Options& options, bool all_fills)
{
    constexpr std::size_t kCommand = 101;  // prime to the cycles of sizes and fills
    const std::size_t fills = all_fills && !corpus.trial ? kFills : 1;
    const std::size_t count = (corpus.count + options.every - 1) / options.every;
    const auto item_of = [&](std::size_t task) { return task / fills * options.every; };
    const auto work = [&](std::size_t task) {
        // One thread per item: its processor time is meaningful, and items share the cores.
        const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
        const Item item = corpus.item(item_of(task));
        if (corpus.trial) {
            return judged(corpus.trial(item), options.limit);
        }
        Verdict verdict = judged(tryLibrary(item, fillOf(task)), options.limit);
        if (verdict.outcome != Outcome::Failed && task % kCommand == 0) {
            const Verdict command = judged(tryCommand(item), options.limit);
            if (command.outcome != verdict.outcome) {
                verdict.outcome = Outcome::Failed;
                verdict.message = "the command does otherwise: " + command.message;
            }
        }
        return verdict;
    };
    Tally tally;
    const auto done = [&](std::size_t task, const Verdict& verdict) {
        tally.add(item_of(task), verdict);
        if (verdict.outcome == Outcome::Failed) {
            const auto kept = keep(corpus.item(item_of(task)), corpus.name, options.failures);
            std::printf("FAILED %s, fill %zu: %s\n", kept.c_str(), task % kFills, verdict.message.c_str());
            std::fflush(stdout);
        }
    };
    WorkOptions work_options;
    work_options.workers = options.workers;
    work_options.processor_limit = 10.0 * options.limit;
    workThrough(count * fills, work, done, work_options);
    tally.print(corpus);
    return tally.failed();
}

std::size_t runAll(const Options& options)
{
    if (!options.paths.empty()) {
        const bool folders = std::any_of(options.paths.begin(), options.paths.end(),
                                         [](const auto& path) { return std::filesystem::is_directory(path); });
        return run(files(options.paths), options, !folders);
    }
    std::size_t failed = 0;
    bool found = false;
    for (const auto& make : {smoothGlyphs, hardGlyphs, icons, whiteNoise, randomWorlds, adversaries, patterns,
                             encodedNoise, hostileDrawings, brokenDrawings, brokenMeshes, brokenFonts, strayMeshes}) {
        const Corpus corpus = make();
        if (options.corpus.empty() || corpus.name == options.corpus) {
            found = true;
            failed += run(corpus, options, false);
        }
    }
    if (!found) {
        throw std::runtime_error("there is no corpus " + options.corpus);
    }
    return failed;
}

int start(int argc, char** argv)
{
    Options options;
    CLI::App app("Makes droplets of thousands of pictures that mean no good");
    app.add_option("paths", options.paths, "pictures, or folders of them, in place of the usual ones");
    app.add_option("--corpus", options.corpus, "take only this corpus, named as in the lines printed");
    app.add_option("--every", options.every, "take only each so manieth item")->check(CLI::PositiveNumber);
    app.add_option("--limit", options.limit, "processor time an item may take [s]")->check(CLI::PositiveNumber);
    app.add_option("--workers", options.workers, "processes at a time")->check(CLI::PositiveNumber);
    app.add_option("--failures", options.failures, "folder that keeps pictures of failures");
    CLI11_PARSE(app, argc, argv);
    // Expectations are also checked outside of tests.
    ::testing::InitGoogleTest();
    return runAll(options) == 0 ? 0 : 1;
}

}  // namespace
}  // namespace droplet::torture

int main(int argc, char** argv)
{
    try {
        return droplet::torture::start(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "torture: %s\n", error.what());
        return 1;
    }
}

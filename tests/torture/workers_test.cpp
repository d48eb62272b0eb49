// SPDX-License-Identifier: GPL-3.0-or-later
#include "torture/workers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace droplet::torture {
namespace {

using ::testing::HasSubstr;

/// Returns a number for every index; crashes, hangs or throws at some.
Verdict misbehave(std::size_t index)
{
    volatile std::uint64_t spins = 0;
    switch (index) {
        case 3:
            std::raise(SIGKILL);
            break;
        case 4:
            _exit(7);
        case 9:
            while (true) {
                spins = spins + 1;
            }
        case 13:
            throw std::runtime_error("thirteen");
        default:
            break;
    }
    Verdict verdict;
    verdict.outcome = index % 2 == 0 ? Outcome::Droplets : Outcome::Refused;
    verdict.droplets = index;
    verdict.triangles = 10 * index;
    verdict.seconds = 0.5 * static_cast<double>(index);
    verdict.min_angle = 0.25;
    verdict.message = std::string(10'000, 'x');
    return verdict;
}

TEST(Workers, ReportEveryItemWhateverItsOutcome)
{
    constexpr std::size_t kCount = 40;
    for (const std::size_t team : {1U, 3U, 100U}) {
        SCOPED_TRACE(team);
        std::map<std::size_t, Verdict> verdicts;
        WorkOptions options;
        options.workers = team;
        options.processor_limit = 0.2;
        options.patience = 600.0;  // no item hangs, but many tests may share the processor
        workThrough(
            kCount, misbehave,
            [&](std::size_t index, const Verdict& verdict) {
                EXPECT_TRUE(verdicts.emplace(index, verdict).second) << index << " twice";
            },
            options);
        ASSERT_EQ(verdicts.size(), kCount);
        const std::map<std::size_t, const char*> fallen{
            {3, "Killed"}, {4, "exit code 7"}, {9, "limit of processor time"}, {13, "threw thirteen"}};
        for (const auto& [index, verdict] : verdicts) {
            SCOPED_TRACE(index);
            if (const auto found = fallen.find(index); found != fallen.end()) {
                EXPECT_TRUE(verdict.outcome == Outcome::Failed);
                EXPECT_THAT(verdict.message, HasSubstr(found->second));
                continue;
            }
            EXPECT_EQ(verdict.outcome, index % 2 == 0 ? Outcome::Droplets : Outcome::Refused);
            EXPECT_EQ(verdict.droplets, index);
            EXPECT_EQ(verdict.triangles, 10 * index);
            EXPECT_EQ(verdict.seconds, 0.5 * static_cast<double>(index));
            EXPECT_EQ(verdict.min_angle, 0.25);
            EXPECT_THAT(verdict.message, ::testing::StartsWith("xxxx"));
        }
    }
}

TEST(Workers, ReportItemsThatDoNotEnd)
{
    WorkOptions options;
    options.patience = 0.1;
    std::vector<std::string> told;
    const auto wait_for_ever = [](std::size_t) {
        while (true) {
            pause();
        }
        return Verdict{};
    };
    workThrough(
        2, wait_for_ever, [&](std::size_t, const Verdict& verdict) { told.push_back(verdict.message); }, options);
    EXPECT_THAT(told, ::testing::ElementsAre("did not end", "did not end"));
}

TEST(Workers, AcceptAnEmptyList)
{
    workThrough(0, misbehave, [](std::size_t, const Verdict&) { ADD_FAILURE(); }, {});
}

}  // namespace
}  // namespace droplet::torture

// SPDX-License-Identifier: GPL-3.0-or-later
#include "torture/trial.h"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <ctime>
#include <exception>
#include <filesystem>
#include <initializer_list>

#include "droplet/error.h"
#include "droplet/units.h"
#include "support/command.h"
#include "support/flood.h"
#include "support/paths.h"
#include "support/sound.h"

namespace droplet::torture {
namespace {

constexpr std::size_t kTriangles = 5'000;

bool isGreymap(const Item& item)
{
    return item.bytes.size() > 2 && item.bytes[0] == std::byte{'P'} && item.bytes[1] == std::byte{'5'};
}

double processorSeconds()
{
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double seconds(const timeval& time)
{
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

double childrensSeconds()
{
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void expectFinite(const ShapeFigures& figures)
{
    for (const double number : {figures.footprint_area, figures.rim_length, figures.volume, figures.height_max,
                                figures.liquid_area, figures.surface_energy, figures.gravity_energy, figures.slope_max,
                                figures.contact_angle.min, figures.contact_angle.mean, figures.contact_angle.max}) {
        EXPECT_TRUE(std::isfinite(number)) << number << " among the figures";
    }
    EXPECT_LE(figures.contact_angle.min, figures.contact_angle.max);
}

void expectFilled(const Droplet& droplet, const Fill& fill)
{
    std::vector<ShapeFigures> filled = droplet.figures;
    if (fill.sharing == FillSharing::Total) {
        filled = {droplet.total};
    }
    for (const ShapeFigures& figures : filled) {
        const double amount = fill.by == FillBy::Volume   ? figures.volume
                              : fill.by == FillBy::Height ? figures.height_max
                                                          : figures.contact_angle.mean;
        if (fill.by == FillBy::ContactAngle) {
            EXPECT_LE(amount / fill.amount, 1.0 + 1e-6);
        } else {
            EXPECT_NEAR(amount / fill.amount, 1.0, 1e-9);
        }
    }
}

/// Checks that every border of the mask is a loop or was dropped as a speck.
void expectEveryBorder(const Droplet& droplet, const Mask& mask)
{
    const testing::Counts counts = testing::flooded(mask);
    EXPECT_EQ(droplet.outline.loops.size() + droplet.outline.specks_dropped, counts.droplets + counts.holes);
}

}  // namespace

Fill fillOf(std::size_t turn)
{
    static constexpr std::array<Fill, kFills> kAll{{
        {},
        {FillBy::Volume, 0.1 * kMicrolitre, FillSharing::Each},
        {FillBy::Volume, 5.0 * kMicrolitre, FillSharing::Total},
        {FillBy::Height, 0.5 * kMillimetre, FillSharing::Total},
    }};
    return kAll[turn % kFills];
}

std::string flawsOf(const Droplet& droplet, const Mask& mask, const Fill& fill)
{
    ::testing::TestPartResultArray results;
    {
        const ::testing::ScopedFakeTestPartResultReporter reporter(
            ::testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &results);
        testing::expectSound(droplet);
        expectFinite(droplet.total);
        std::for_each(droplet.figures.begin(), droplet.figures.end(), expectFinite);
        expectFilled(droplet, fill);
        expectEveryBorder(droplet, mask);
    }
    std::string flaws;
    for (int i = 0; i < results.size(); ++i) {
        flaws += (flaws.empty() ? "" : "; ") + std::string(results.GetTestPartResult(i).message());
    }
    std::replace(flaws.begin(), flaws.end(), '\n', ' ');
    return flaws;
}

Verdict tryLibrary(const Item& item, const Fill& fill)
{
    DropletOptions options;
    options.mesh.triangles = kTriangles;
    options.solve.fill = fill;
    options.allow_less = fill.by == FillBy::ContactAngle;  // as the command does without an amount
    if (!options.allow_less) {
        options.solve.model = Model::Linear;  // in which every volume and height exists
    }
    MaskOptions mask_options;
    mask_options.channel = isGreymap(item) ? Channel::Luma : Channel::Auto;

    Verdict verdict;
    const double begin = processorSeconds();
    try {
        const Mask mask = decodeMask(item.bytes, mask_options);
        const Droplet droplet = makeDroplet(mask, options);
        verdict.seconds = processorSeconds() - begin;
        verdict.droplets = droplet.meshes.size();
        for (const PlanarMesh& mesh : droplet.meshes) {
            verdict.triangles += mesh.triangles.size();
            verdict.min_angle = std::min(verdict.min_angle, minAngle(mesh));
        }
        verdict.message = flawsOf(droplet, mask, fill);
        verdict.outcome = verdict.message.empty() ? Outcome::Droplets : Outcome::Failed;
    } catch (const Error& error) {
        verdict.seconds = processorSeconds() - begin;
        verdict.outcome = error.code() == ErrorCode::InvalidInput ? Outcome::Refused : Outcome::Failed;
        verdict.message = error.what();
    } catch (const std::exception& error) {
        verdict.seconds = processorSeconds() - begin;
        verdict.message = std::string("threw ") + error.what();
    }
    return verdict;
}

Verdict tryReading(const std::function<void()>& read)
{
    Verdict verdict;
    const double begin = processorSeconds();
    try {
        read();
        verdict.outcome = Outcome::Droplets;
    } catch (const Error& error) {
        verdict.message = error.what();
        const bool is_refusal = error.code() == ErrorCode::InvalidInput || error.code() == ErrorCode::InvalidArgument;
        const bool is_line = !verdict.message.empty() && verdict.message.find('\n') == std::string::npos;
        verdict.outcome = is_refusal && is_line ? Outcome::Refused : Outcome::Failed;
    } catch (const std::exception& error) {
        verdict.message = std::string("threw ") + error.what();
    }
    verdict.seconds = processorSeconds() - begin;
    return verdict;
}

Verdict tryCommand(const Item& item)
{
    const testing::ScratchDirectory scratch;
    const auto input = scratch.path() / "input";
    const auto output = scratch.path() / "output.glb";
    testing::writeFile(input, std::string(reinterpret_cast<const char*>(item.bytes.data()), item.bytes.size()));

    const double begin = childrensSeconds();
    // If the parent is killed, the command must still end.
    constexpr const char* kPatience = "60";  // [s]
    const testing::CommandResult result = testing::runProgram(
        {"timeout", kPatience, testing::kCommand, "--quiet", "--triangles", std::to_string(kTriangles), "--channel",
         isGreymap(item) ? "luma" : "auto", input.string(), output.string()});
    Verdict verdict;
    verdict.seconds = childrensSeconds() - begin;
    const bool written = std::filesystem::exists(output) && std::filesystem::file_size(output) > 0;
    const auto lines = result.errorLines();
    if (result.exit_code == 0 && written && lines.empty()) {
        verdict.outcome = Outcome::Droplets;
    } else if (result.exit_code == 3 && !written && lines.size() == 1) {
        verdict.outcome = Outcome::Refused;
    } else {
        verdict.outcome = Outcome::Failed;
    }
    verdict.message = lines.empty() ? "" : lines.back();
    if (verdict.outcome == Outcome::Failed) {
        verdict.message = "the command ended with " + std::to_string(result.exit_code) +
                          (written ? ", a file, and \"" : ", no file, and \"") + verdict.message + "\"";
    }
    return verdict;
}

}  // namespace droplet::torture

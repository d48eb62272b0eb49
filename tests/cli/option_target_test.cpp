// SPDX-License-Identifier: GPL-3.0-or-later
// Options are declared with the variables that they are read into: a default that changes in the library is seen in the
// help, in --help=json, and so in the manual, the completions, Python and npm, which are made from it.
#include "cli/option_target.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "droplet/error.h"
#include "droplet/units.h"

namespace droplet {
namespace {

using cli::into;
using ::testing::HasSubstr;

enum class Side { Left, Right };

/// Options of a library, whose defaults the tests change.
struct Options {
    double length = 20.0 * kMillimetre;
    std::optional<double> angle;
    double factor = 1.5;
    std::size_t number = 40'000;
    Side side = Side::Left;
    std::string name = "plain";
    std::uint64_t seed = 1;
    bool open = false;
};

constexpr cli::Range kAngle{Dimension::Angle, 0.0, 90.0 * kDegree, "from 0deg to 90deg"};

void declare(cli::CommandLine& line, Options& options)
{
    line.add("Group", "--length,--size", "LENGTH", "Length", into(options.length, cli::kLength));
    line.add("Group", "--angle", "ANGLE", "Angle [none]", into(options.angle, kAngle));
    line.add("Group", "--factor", "NUMBER", "Factor", into(options.factor, {0.0, 2.0, "a number from 0 to 2"}));
    line.add("Group", "--number", "N", "Number", into(options.number, {10, 1'000'000, "1M"}));
    line.add("Group", "--side", "Side", into(options.side, {{"left", Side::Left}, {"right", Side::Right}}));
    line.add("Group", "--name", "NAME", "Name", into(options.name));
    line.add("Group", "--seed", "N", "Random seed", cli::seedInto(options.seed));
    line.addFlag("Group", "--open", "Open", options.open);
    line.addFlag("Group", "-h,--help", "Help");
}

Options parsed(const std::vector<std::string>& arguments, Options options = {})
{
    cli::CommandLine line({"program", "", "[OPTIONS]", ""});
    declare(line, options);
    std::vector<const char*> argv{"program"};
    for (const std::string& argument : arguments) {
        argv.push_back(argument.c_str());
    }
    line.parse(static_cast<int>(argv.size()), argv.data());
    line.read();
    return options;
}

std::string refusalOf(const std::vector<std::string>& arguments)
{
    try {
        parsed(arguments);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(OptionTarget, AChangedDefaultIsInEveryForm)
{
    Options options{.length = 3.5 * kMillimetre,
                    .angle = {},
                    .factor = 0.25,
                    .number = 2'000'000,
                    .side = Side::Right,
                    .name = "ink",
                    .seed = 7};
    cli::CommandLine line({"program", "", "[OPTIONS]", ""});
    declare(line, options);
    const auto json = nlohmann::json::parse(line.helpJson());
    const std::vector<std::string> usual{"3.5mm", "none", "0.25", "2M", "right", "ink", "7"};
    for (std::size_t k = 0; k < usual.size(); ++k) {
        EXPECT_EQ(json.at("options").at(k).at("default"), usual[k]);
        EXPECT_THAT(line.help(), HasSubstr("[" + usual[k] + "]"));
    }
}

TEST(OptionTarget, RangesAndWordsAreData)
{
    Options options;
    cli::CommandLine line({"program", "", "[OPTIONS]", ""});
    declare(line, options);
    const auto all = nlohmann::json::parse(line.helpJson()).at("options");
    EXPECT_EQ(all.at(0).at("min"), 1e-9);
    EXPECT_EQ(all.at(0).at("max"), 1e3);
    EXPECT_EQ(all.at(0).at("former"), nlohmann::json({"--size"}));
    EXPECT_DOUBLE_EQ(all.at(1).at("max").get<double>(), 90.0 * kDegree);
    EXPECT_EQ(all.at(3).at("min"), 10);
    EXPECT_EQ(all.at(4).at("words"), nlohmann::json({"left", "right"}));
    EXPECT_TRUE(all.at(4).at("max").is_null());
    EXPECT_EQ(all.at(6).at("min"), 0);
    EXPECT_EQ(all.at(6).at("max"), std::ldexp(1.0, 64));  // of a seed, as near as a double comes
}

TEST(OptionTarget, ReadsWhatIsGivenAndNothingElse)
{
    const Options usual = parsed({});
    EXPECT_EQ(usual.length, 20.0 * kMillimetre);
    EXPECT_EQ(usual.angle, std::nullopt);
    const Options given = parsed({"--size", "2cm", "--angle", "30deg", "--factor", "2", "--number", "20k", "--side",
                                  "right", "--name", "x", "--seed", "18446744073709551615", "--open"});
    EXPECT_DOUBLE_EQ(given.length, 0.02);
    EXPECT_NEAR(given.angle.value_or(0.0), 30.0 * kDegree, 1e-15);
    EXPECT_EQ(given.factor, 2.0);
    EXPECT_EQ(given.number, 20'000U);
    EXPECT_EQ(given.side, Side::Right);
    EXPECT_EQ(given.name, "x");
    EXPECT_EQ(given.seed, 18446744073709551615U);
    EXPECT_TRUE(given.open);
    EXPECT_FALSE(parsed({"--open=false"}).open);
}

TEST(OptionTarget, RefusesWhatIsNotAllowed)
{
    EXPECT_EQ(refusalOf({"--length", "2km"}).substr(0, 9), "--length:");
    EXPECT_EQ(refusalOf({"--angle", "91deg"}), "--angle: '91deg' must be from 0deg to 90deg");
    EXPECT_EQ(refusalOf({"--factor", "3"}), "--factor: '3' must be a number from 0 to 2");
    EXPECT_EQ(refusalOf({"--number", "9"}), "--number: '9' must be a whole number from 10 to 1M");
    EXPECT_EQ(refusalOf({"--number", "10.5"}), "--number: '10.5' must be a whole number from 10 to 1M");
    EXPECT_EQ(refusalOf({"--side", "up"}), "--side: 'up' must be one of left, right");
    EXPECT_THAT(refusalOf({"--seed", "-1"}), HasSubstr("a whole number from 0 to 18446744073709551615"));
}

// What the help shows can be given.
TEST(OptionTarget, TextOfAQuantityIsReadAsThatQuantity)
{
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> exponent(-6.0, 3.0);
    for (const Dimension dimension :
         {Dimension::Length, Dimension::Area, Dimension::Volume, Dimension::Angle, Dimension::SurfaceTension,
          Dimension::Density, Dimension::Acceleration, Dimension::Speed, Dimension::Duration, Dimension::Rainfall,
          Dimension::Viscosity}) {
        for (int k = 0; k < 200; ++k) {
            const double value = std::pow(10.0, exponent(random));
            const std::string text = cli::quantityText(value, dimension);
            EXPECT_NEAR(parseQuantity(text, dimension) / value, 1.0, 5e-6) << text;
        }
    }
    EXPECT_EQ(cli::quantityText(0.5, Dimension::Length), "0.5m");
    EXPECT_EQ(cli::quantityText(0.0, Dimension::Length), "0mm");
    EXPECT_EQ(cli::quantityText(1e-4, Dimension::Length), "0.1mm");
    EXPECT_EQ(cli::countText(40'000), "40k");
    EXPECT_EQ(cli::countText(1024), "1024");
}

}  // namespace
}  // namespace droplet

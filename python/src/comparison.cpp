// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "arguments.h"
#include "command_line.h"
#include "droplet/compare/compare.h"
#include "droplet/compare/comparison_report.h"
#include "droplet/error.h"
#include "droplet/io/read_surface.h"
#include "droplet/units.h"
#include "option_values.h"
#include "surface.h"
#include "work.h"

namespace binding {
namespace {

namespace py = pybind11;

constexpr cli::Range kTolerance{droplet::Dimension::Length, 1e-15, 1e3, "over 0m, up to 1000m"};
constexpr cli::Range kAngle{droplet::Dimension::Angle, 1e-9, 3.2, "over 0deg, up to 180deg"};

/// Options of compare(). Their ranges are those of the command.
struct Options {
    droplet::Tolerances tolerances;
    std::optional<std::size_t> threads;
};

double share(const cli::Given& given)
{
    const std::string& text = given.text;
    const auto number = text.ends_with('%') ? cli::finiteNumber(text.substr(0, text.size() - 1)) : std::nullopt;
    if (!number || *number < 0.0 || *number > 100.0) {
        cli::refuse(given, "a share from 0% to 100%, such as 0.1%");
    }
    return *number / 100.0;
}

std::variant<Options, std::string> parse(int argc, const char* const* argv)
{
    cli::CommandLine line({});
    line.add("Allowed", "--tolerance", "LENGTH", "");
    line.add("Allowed", "--volume-tolerance", "SHARE", "");
    line.add("Allowed", "--normal-tolerance", "ANGLE", "");
    line.add("Run", "--threads", "N", "");
    line.parse(argc, argv);
    Options options;
    if (const auto tolerance = line.value("--tolerance")) {
        options.tolerances.distance = cli::quantity(*tolerance, kTolerance);
    }
    if (const auto tolerance = line.value("--volume-tolerance")) {
        options.tolerances.volume = share(*tolerance);
    }
    if (const auto tolerance = line.value("--normal-tolerance")) {
        options.tolerances.normals = cli::quantity(*tolerance, kAngle);
    }
    if (const auto threads = line.value("--threads")) {
        constexpr std::size_t kMaxThreads = 1024;
        options.threads = cli::count(*threads, {1, kMaxThreads, "1024"});
    }
    return options;
}

/// Surface in memory, or the path of one.
using Operand = std::variant<std::shared_ptr<Surface>, std::filesystem::path>;

/// Surface of an operand.
class Opened {
public:
    Opened(const Operand& operand, std::string name)
    {
        if (const auto* path = std::get_if<std::filesystem::path>(&operand)) {
            name_ = path->string();
            read_ = droplet::readSurface(*path);
        } else {
            name_ = std::move(name);
            held_ = std::get<std::shared_ptr<Surface>>(operand);
        }
    }

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const droplet::Surface& surface() const { return held_ ? held_->surface() : read_.surface; }
    [[nodiscard]] const std::vector<std::string>& warnings() const { return read_.warnings; }

private:
    std::string name_;
    std::shared_ptr<Surface> held_;
    droplet::ReadSurface read_;
};

std::string compare(const Operand& a, const Operand& b, const Arguments& arguments)
{
    const auto options = parsed(parse, arguments);
    const Work work(options.threads);
    const Opened first(a, "a");
    const Opened second(b, "b");
    droplet::ComparisonReport report{first.name(), second.name(), {}, options.tolerances, {}, first.warnings()};
    report.warnings.insert(report.warnings.end(), second.warnings().begin(), second.warnings().end());
    droplet::CompareOptions compare_options;
    compare_options.tolerance = options.tolerances.distance;
    report.comparison = droplet::compare(first.surface(), second.surface(), compare_options);
    report.exceeded = droplet::exceeded(report.comparison, options.tolerances);
    std::ostringstream out;
    writeComparison(out, report);
    return std::move(out).str();
}

}  // namespace

void bindComparison(py::module_& module)
{
    module.def("compare", &compare);
}

}  // namespace binding

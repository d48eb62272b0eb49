// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape.h"

#include <pybind11/stl.h>

#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "arguments.h"
#include "droplet_report.h"
#include "mask.h"
#include "mask_shape.h"
#include "shape_options.h"
#include "surroundings.h"
#include "work.h"

namespace binding {
namespace {

namespace py = pybind11;

std::shared_ptr<Droplet> makeFrom(Mask from, const Arguments& arguments)
{
    cli::StageClock clock;
    clock.begin(droplet::Stage::Read);
    Arguments all = arguments;
    all.insert(all.end(), {"INPUT", "droplet.glb"});
    auto options = parsed(cli::parseShape, all);
    const Work work(options.run.threads);
    droplet::Mask& mask = from.mask;
    options.input = from.path;
    if (from.threshold && !options.footprint.mask.accept_any) {
        options.footprint.trace.threshold = *from.threshold;
    }
    if (options.footprint.mask.invert) {
        cli::invert(mask);
    }
    const cli::Surroundings around = cli::readSurroundings(options.settings);
    cli::DropletSettings settings = cli::completeSettings(mask, around, options);
    cli::MaskShape made = cli::makeOfMask(mask, settings, options, [&](droplet::Stage stage, double share) { clock.begin(stage, share); });
    if (auto warning = cli::maskWarning(mask, "look at the array of the mask")) {
        settings.warnings.insert(settings.warnings.begin(), std::move(*warning));
    }
    std::optional<droplet::ObjectReport> onto;
    if (around.object) {
        onto = cli::placeOnObject(made.droplet, *around.object, *settings.onto);
    }
    return Droplet::make(std::move(made.droplet), settings, std::move(made.input), std::move(onto), clock);
}

}  // namespace

std::shared_ptr<Droplet> Droplet::make(droplet::Droplet droplet, const cli::DropletSettings& settings,
                                       droplet::InputReport input, std::optional<droplet::ObjectReport> onto,
                                       cli::StageClock& clock)
{
    droplet::Report report = cli::describe(droplet, settings);
    report.input = std::move(input);
    report.onto = std::move(onto);
    report.time = clock.times();
    report.time_total = clock.total();
    report.peak_memory = cli::peakMemory();
    return std::shared_ptr<Droplet>(new Droplet(std::move(droplet.surface), settings.material, std::move(report)));
}

std::string Droplet::json() const
{
    droplet::Report report = report_;
    report.output = cli::describeOutput(surface(), "", droplet::Format::Glb);
    std::ostringstream out;
    droplet::writeReport(out, report);
    return std::move(out).str();
}

void bindShape(py::module_& module)
{
    py::class_<Droplet, Surface, std::shared_ptr<Droplet>>(
        module, "Droplet", py::dynamic_attr(),
        R"(Droplets of liquid on one mask or text: a mesh with a report.

Made by make_droplet() and glyphs(); for the arrays see Surface.)")
        .def_property_readonly(
            "report",
            [](const py::object& self) {
                const py::dict cache = self.attr("__dict__");
                if (!cache.contains("_report")) {
                    const auto& droplet = self.cast<const Droplet&>();
                    std::string json;
                    {
                        const py::gil_scoped_release release;
                        json = droplet.json();
                    }
                    cache["_report"] = reportOf("Report", json);
                }
                return py::object(cache["_report"]);
            },
            "Options, results and warnings as a Report, with the names of the command's JSON report. Its output has no "
            "path, format or size, as there is no file.");

    module.def("make_droplet",
               [](const py::handle& mask, const Arguments& arguments) { return makeFrom(maskOf(mask), arguments); });
}

}  // namespace binding

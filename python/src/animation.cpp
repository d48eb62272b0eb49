// SPDX-License-Identifier: GPL-3.0-or-later
#include "animation.h"

#include <fmt/core.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "animate_command.h"
#include "animate_options.h"
#include "arguments.h"
#include "droplet/error.h"
#include "droplet/io/animation.h"
#include "droplet/io/output.h"
#include "droplet/sequence/sequence.h"
#include "droplet/sequence/sequence_report.h"
#include "droplet_report.h"
#include "mask.h"
#include "mask_shape.h"
#include "shape.h"
#include "surface.h"
#include "surroundings.h"
#include "work.h"

namespace binding {
namespace {

namespace py = pybind11;

using droplet::Error;
using droplet::ErrorCode;

/// Surfaces of all frames, with their report.
struct Animation {
    std::vector<std::shared_ptr<Surface>> frames;  ///< a frame without liquid has an empty surface
    droplet::SequenceReport report;
};

/// Makes the droplets of frames, one after another.
class Sequence {
public:
    explicit Sequence(cli::AnimateOptions options)
        : options_(std::move(options)),
          around_(cli::readSurroundings(options_.settings)),
          made_(std::make_shared<Animation>())
    {
        droplet::SequenceReport& report = made_->report;
        report.volume_mode = options_.volume_mode;
        report.frames_per_second = options_.frames_per_second.value_or(report.frames_per_second);
        report.warnings = options_.settings.warnings;
    }

    /// Adds a frame.
    void add(droplet::Mask mask, const std::string& name)
    {
        droplet::SequenceReport& report = made_->report;
        if (options_.footprint.mask.invert) {
            cli::invert(mask);
        }
        if (report.frames.empty()) {
            sequence_ = cli::beginSequence(mask, options_, around_, made_->report);
        } else if (mask.width != report.width_px || mask.height != report.height_px) {
            throw Error(ErrorCode::InvalidInput,
                        fmt::format("{}: {} x {} pixels must be {} x {}, as in the first frame", name, mask.width,
                                    mask.height, report.width_px, report.height_px));
        }
        try {
            solve(mask);
        } catch (const Error& error) {
            const bool is_of_frame =
                error.code() == ErrorCode::InvalidInput || error.code() == ErrorCode::NoSuchDroplet;
            throw Error(error.code(), is_of_frame ? name + ": " + error.what() : error.what());
        }
        droplet::FrameReport frame = reportOf(*frame_, sequence_);
        frame.input = name;
        report.frames.push_back(std::move(frame));
        const droplet::Droplet& droplet = frame_->droplet;
        for (std::size_t i = 0; i < droplet.warnings.size(); ++i) {
            warn(name, droplet.warnings[i], i < droplet.severe_warnings);
        }
        made_->frames.push_back(
            std::make_shared<Surface>(droplet.surface, options_.settings.material, droplet.warnings));
    }

    /// Ends the sequence.
    std::shared_ptr<Animation> finish()
    {
        droplet::SequenceReport& report = made_->report;
        if (report.dry() == report.frames.size()) {
            throw Error(ErrorCode::InvalidInput,
                        fmt::format("frames: no liquid in any of {} frames", report.frames.size()));
        }
        report.time_total = clock_.total();
        report.peak_memory = cli::peakMemory();
        return std::move(made_);
    }

    [[nodiscard]] const std::optional<std::size_t>& threads() const { return options_.run.threads; }

private:
    void solve(const droplet::Mask& mask)
    {
        droplet::Outline outline = droplet::trace(mask, sequence_.droplet.trace);
        if (!outline.loops.empty()) {
            cli::refuseTooShortEdge(cli::coveredArea(outline), sequence_.droplet);
        }
        frame_ = frame_ ? nextFrame(*frame_, std::move(outline), sequence_) : firstFrame(std::move(outline), sequence_);
    }

    /// Adds a warning, unless an earlier frame had the same kind of warning.
    void warn(const std::string& name, const std::string& warning, bool is_grave)
    {
        droplet::SequenceReport& report = made_->report;
        if (warned_.insert(warning.substr(0, warning.find_first_of("0123456789"))).second) {
            report.warnings.insert(is_grave ? report.warnings.begin() : report.warnings.end(), name + ": " + warning);
            report.severe_warnings += is_grave ? 1 : 0;
        }
    }

    cli::AnimateOptions options_;
    cli::StageClock clock_;
    cli::Surroundings around_;
    droplet::SequenceOptions sequence_;
    std::optional<droplet::Frame> frame_;
    std::set<std::string> warned_;  ///< kinds of warnings so far
    std::shared_ptr<Animation> made_;
};

std::shared_ptr<Animation> animate(const py::iterable& frames, const Arguments& arguments)
{
    Arguments all = arguments;
    all.insert(all.end(), {"frames", "droplets.glb"});
    Sequence sequence(parsed(cli::parseAnimate, all));
    std::size_t number = 0;
    for (const py::handle& frame : frames) {
        droplet::Mask mask = maskOf(frame).mask;
        const Work work(sequence.threads());
        sequence.add(std::move(mask), fmt::format("frame {}", ++number));
    }
    if (number == 0) {
        throw Error(ErrorCode::InvalidArgument, "frames: at least one frame is needed");
    }
    return sequence.finish();
}

void save(const Animation& self, const std::filesystem::path& path, const std::optional<std::string>& material,
          bool no_clobber)
{
    const py::gil_scoped_release release;
    if (path.extension() != ".glb" && path.extension() != ".GLB") {
        throw Error(ErrorCode::InvalidArgument,
                    "path: '" + path.string() + "' must end in .glb; other formats hold single frames");
    }
    const auto& reports = self.report.frames;
    droplet::AnimationOptions options;
    options.frames_per_second = self.report.frames_per_second;
    options.material = material ? droplet::materialNamed(*material) : self.frames.front()->material();
    options.frames = reports.size();
    options.closed = std::all_of(reports.begin(), reports.end(), [](const droplet::FrameReport& frame) {
        return frame.droplets.empty() || frame.closed;
    });
    droplet::Animation animation(options);
    for (std::size_t i = 0; i < reports.size(); ++i) {
        if (reports[i].droplets.empty()) {
            animation.addDry();
        } else {
            animation.add(self.frames[i]->surface(), reports[i].continues);
        }
    }
    droplet::writeAtomically(path, [&](std::ostream& out) { animation.write(out); }, {no_clobber});
}

}  // namespace

void bindAnimation(py::module_& module)
{
    py::class_<Animation, std::shared_ptr<Animation>>(
        module, "Animation", py::dynamic_attr(),
        R"(Droplets whose footprints move: a sequence of surfaces, made by animate().

A frame without liquid has a surface without triangles.)")
        .def("__len__", [](const Animation& self) { return self.frames.size(); })
        .def(
            "__getitem__",
            [](const Animation& self, py::ssize_t index) {
                const auto count = static_cast<py::ssize_t>(self.frames.size());
                if (index < -count || index >= count) {
                    throw py::index_error(fmt::format("frame {} of {}", index, count));
                }
                return self.frames[static_cast<std::size_t>(index < 0 ? index + count : index)];
            },
            py::arg("index"))
        .def(
            "__iter__", [](const Animation& self) { return py::make_iterator(self.frames.begin(), self.frames.end()); },
            py::keep_alive<0, 1>())
        .def_property_readonly(
            "report",
            [](const py::object& self) {
                const py::dict cache = self.attr("__dict__");
                if (!cache.contains("_report")) {
                    std::ostringstream out;
                    writeSequenceReport(out, self.cast<const Animation&>().report);
                    cache["_report"] = reportOf("SequenceReport", out.str());
                }
                return py::object(cache["_report"]);
            },
            "Options, results and warnings of all frames as a SequenceReport. Its output has no path or size, as there "
            "is no file.")
        .def_property_readonly(
            "warnings", [](const Animation& self) { return warningsOf(self.report.warnings); },
            "Warnings, one line each, the grave ones first; of each kind the first one.")
        .def("save", &save, py::arg("path"), py::kw_only(), py::arg("material") = py::none(),
             py::arg("no_clobber") = false, R"(Writes all frames to one .glb that plays, completely or not at all.

path        ends in .glb
material    water, ink, mercury, honey or plain [the liquid's own]
no_clobber  refuse to replace a file

Raises InvalidArgument for another extension, OutputFailed if the file cannot
be written.)")
        .def("__repr__",
             [](const Animation& self) { return fmt::format("<Animation of {} frames>", self.frames.size()); });
    module.def("animate", &animate);
}

}  // namespace binding

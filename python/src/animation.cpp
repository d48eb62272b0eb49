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
#include <tuple>
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
#include "option_values.h"
#include "shape.h"
#include "state.h"
#include "surface.h"
#include "surroundings.h"
#include "this_process.h"
#include "work.h"

namespace binding {
namespace {

namespace py = pybind11;

using droplet::Error;
using droplet::ErrorCode;

/// Frame of an animation.
struct Frame {
    std::shared_ptr<Surface> surface;  ///< without triangles if there is no liquid
    bool continues = false;            ///< as in droplet::Frame
    bool closed = false;               ///< whether the surface is closed
};

/// Frames with their report.
struct Animation {
    std::vector<Frame> frames;
    double frames_per_second = 24.0;
    std::vector<std::string> warnings;
    std::string json;  ///< report, with the schema droplet-shape.sequence/1
};

/// Makes the droplets of frames, one after another.
class Sequence {
public:
    explicit Sequence(cli::AnimateOptions options)
        : options_(std::move(options)),
          around_(cli::readSurroundings(options_.settings)),
          made_(std::make_shared<Animation>())
    {
        report_.volume_mode = options_.volume_mode;
        report_.frames_per_second = options_.frames_per_second.value_or(report_.frames_per_second);
        report_.warnings = options_.settings.warnings;
    }

    /// Adds a frame.
    void add(droplet::Mask mask, const std::string& name)
    {
        if (options_.footprint.mask.invert) {
            cli::invert(mask);
        }
        if (report_.frames.empty()) {
            sequence_ = cli::beginSequence(mask, options_, around_, report_);
            stand_ = standOf({.droplet = sequence_.droplet}, around_,
                             {report_.pixel_size * mask.width, report_.pixel_size * mask.height});
        } else if (mask.width != report_.width_px || mask.height != report_.height_px) {
            throw Error(ErrorCode::InvalidInput,
                        fmt::format("{}: {} x {} pixels must be {} x {}, as in the first frame", name, mask.width,
                                    mask.height, report_.width_px, report_.height_px));
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
        if (frame.held) {
            warn(name, frame_->held + "; the droplets of the frame before are shown instead", true);
        }
        const droplet::Droplet& droplet = frame_->droplet;
        for (std::size_t i = 0; i < droplet.warnings.size(); ++i) {
            warn(name, droplet.warnings[i], i < droplet.severe_warnings);
        }
        made_->frames.push_back(
            {std::make_shared<Surface>(SurfaceParts{droplet.surface, options_.settings.material, droplet.warnings},
                                       stand_),
             frame.continues, frame.closed});
        report_.frames.push_back(std::move(frame));
    }

    /// Ends the sequence.
    std::shared_ptr<Animation> finish()
    {
        if (report_.dry() == report_.frames.size()) {
            throw Error(ErrorCode::InvalidInput,
                        fmt::format("frames: no liquid in any of {} frames", report_.frames.size()));
        }
        report_.time_total = clock_.total();
        report_.peak_memory = cli::peakMemory();
        std::ostringstream json;
        writeSequenceReport(json, report_);
        made_->frames_per_second = report_.frames_per_second;
        made_->warnings = report_.warnings;
        made_->json = std::move(json).str();
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
        if (warned_.insert(warning.substr(0, warning.find_first_of("0123456789"))).second) {
            report_.warnings.insert(is_grave ? report_.warnings.begin() : report_.warnings.end(),
                                    name + ": " + warning);
            report_.severe_warnings += is_grave ? 1 : 0;
        }
    }

    cli::AnimateOptions options_;
    cli::StageClock clock_;
    cli::Surroundings around_;
    droplet::SequenceOptions sequence_;
    std::optional<droplet::Frame> frame_;
    std::set<std::string> warned_;  ///< kinds of warnings so far
    std::shared_ptr<const Stand> stand_;
    droplet::SequenceReport report_;
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

/// What save() and to_bytes() in Python have in common.
struct FilmOptions {
    std::optional<std::string> material;
    droplet::AnimatedFile file;
};

/// @throws Error InvalidArgument if there is no such format or compression
FilmOptions filmOptions(const std::optional<std::string>& material, const std::string& format,
                        const std::string& compress, const char* subject)
{
    FilmOptions options{material, {}};
    options.file.format = cli::forOption(subject, [&] { return droplet::formatNamed(format); });
    if (!droplet::isAnimated(options.file.format)) {
        cli::refuse(std::string(subject) + ": " + droplet::name(options.file.format) +
                    " holds single frames; glb, gltf, usda and usdz hold animations");
    }
    options.file.compression = cli::forOption("compress", [&] { return droplet::compressionNamed(compress); });
    if (options.file.compression != droplet::Compression::None && options.file.format != droplet::Format::Glb) {
        cli::refuse(std::string("compress: ") + droplet::name(options.file.format) +
                    " files cannot be compressed, glb files can");
    }
    return options;
}

/// Writes all frames as one file.
void writeFilm(const Animation& self, const FilmOptions& film, std::ostream& out)
{
    droplet::AnimationOptions options;
    options.frames_per_second = self.frames_per_second;
    options.material = materialOf(*self.frames.front().surface, film.material);
    options.frames = self.frames.size();
    const auto is_dry = [](const Frame& frame) { return frame.surface->surface().triangles.empty(); };
    options.closed = std::all_of(self.frames.begin(), self.frames.end(),
                                 [&](const Frame& frame) { return is_dry(frame) || frame.closed; });
    droplet::Animation animation(options);
    for (const Frame& frame : self.frames) {
        if (is_dry(frame)) {
            animation.addDry();
        } else {
            animation.add(frame.surface->surface(), frame.continues);
        }
    }
    animation.write(out, film.file);
}

py::bytes bytesOf(const Animation& self, const FilmOptions& film)
{
    std::ostringstream out;
    {
        const py::gil_scoped_release release;
        writeFilm(self, film, out);
    }
    return out.str();
}

py::bytes toBytes(const Animation& self, const std::string& format, const std::optional<std::string>& material,
                  const std::string& compress)
{
    return bytesOf(self, filmOptions(material, format, compress, "format"));
}

void save(const Animation& self, const py::object& file, const std::optional<std::string>& material, bool no_clobber,
          const std::optional<std::string>& format, const std::string& compress)
{
    if (isFileObject(file)) {
        file.attr("write")(bytesOf(self, filmOptions(material, format.value_or("glb"), compress, "format")));
        return;
    }
    const auto path = pathOf(file);
    const std::string subject = format ? "format" : "path: '" + path.string() + "'";
    const FilmOptions film =
        filmOptions(material, format.value_or(path.extension().string()), compress, subject.c_str());
    const py::gil_scoped_release release;
    droplet::writeAtomically(path, [&](std::ostream& out) { writeFilm(self, film, out); }, {no_clobber});
}

/// State of an animation for pickle.
py::object stateOf(const Animation& self)
{
    py::list frames;
    for (const Frame& frame : self.frames) {
        frames.append(py::make_tuple(binding::stateOf(frame.surface->parts()), frame.continues, frame.closed));
    }
    return py::make_tuple(frames, binding::stateOf(self.frames.front().surface->stand()), self.frames_per_second,
                          binding::stateOf(self.warnings), self.json);
}

std::shared_ptr<Animation> animationOf(const py::handle& state)
{
    const auto [frames, stand_state, frames_per_second, warnings, json] =
        state.cast<std::tuple<py::list, py::object, double, py::object, std::string>>();
    const auto stand = standOf(stand_state);
    auto animation = std::make_shared<Animation>();
    for (const py::handle& frame : frames) {
        const auto [parts, continues, closed] = frame.cast<std::tuple<py::object, bool, bool>>();
        animation->frames.push_back({std::make_shared<Surface>(partsOf(parts), stand), continues, closed});
    }
    animation->frames_per_second = frames_per_second;
    animation->warnings = valueOf<std::vector<std::string>>(warnings);
    animation->json = json;
    return animation;
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
                return self.frames[static_cast<std::size_t>(index < 0 ? index + count : index)].surface;
            },
            py::arg("index"))
        .def("__iter__",
             [](const Animation& self) {
                 py::list surfaces;
                 for (const Frame& frame : self.frames) {
                     surfaces.append(frame.surface);
                 }
                 return py::iter(surfaces);
             })
        .def_property_readonly(
            "report",
            [](const py::object& self) {
                const py::dict cache = self.attr("__dict__");
                if (!cache.contains("_report")) {
                    cache["_report"] = reportOf("SequenceReport", self.cast<const Animation&>().json);
                }
                return py::object(cache["_report"]);
            },
            "Options, results and warnings of all frames as a SequenceReport. Its output has no path or size, as there "
            "is no file.")
        .def_property_readonly(
            "warnings", [](const Animation& self) { return warningsOf(self.warnings); },
            "Warnings, one line each, the grave ones first; of each kind the first one.")
        .def("save", &save, py::arg("path"), py::kw_only(), py::arg("material") = py::none(),
             py::arg("no_clobber") = false, py::arg("format") = py::none(), py::arg("compress") = "none",
             R"(Writes all frames to one file that plays, completely or not at all, or to a file object.

path        ends in .glb, .gltf, .usda or .usdz; or an object that is open for
            bytes
material    water, glass, gold or another look [the liquid's own]
no_clobber  refuse to replace a file
format      glb, gltf, usda or usdz, whatever the path's extension is [by the
            extension; glb for an object]
compress    none, quantize or meshopt: compression of a .glb

Raises InvalidArgument for another extension, OutputFailed if the file cannot
be written.)")
        .def("to_bytes", &toBytes, py::arg("format") = "glb", py::kw_only(), py::arg("material") = py::none(),
             py::arg("compress") = "none", R"(Bytes of the file that save() writes.)")
        .def(py::pickle(
            [](const py::object& self) {
                return pickled(py::make_tuple(stateOf(self.cast<const Animation&>()), attributesOf(self)));
            },
            [](const py::tuple& pickle) {
                const py::tuple parts = unpickled(pickle);
                return std::pair(animationOf(parts[0]), parts[1].cast<py::dict>());
            }))
        .def("__repr__",
             [](const Animation& self) { return fmt::format("<Animation of {} frames>", self.frames.size()); });
    module.def("animate", &animate);
}

}  // namespace binding

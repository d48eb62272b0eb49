// SPDX-License-Identifier: GPL-3.0-or-later
#include "mask.h"

#include <fmt/core.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arguments.h"
#include "droplet/drawing/picture.h"
#include "droplet/error.h"
#include "droplet/mask/two_levels.h"
#include "shape_options.h"
#include "state.h"
#include "work.h"

namespace binding {
namespace {

namespace py = pybind11;

using droplet::Error;
using droplet::ErrorCode;

constexpr double kFull = 65535.0;

[[noreturn]] void refuseLevel(double level, const std::string& allowed)
{
    throw Error(ErrorCode::InvalidArgument,
                fmt::format("mask: {} must be {}; divide the array by its largest value, or compare it with a label: "
                            "mask == {}",
                            level, allowed, level));
}

/// Fills the coverage from an array's items. Of two levels, which may be any, the higher one is liquid; one level is
/// liquid unless it is 0.
/// @param full  level that is liquid where there are more than two
template <typename Item>
void fill(droplet::Mask& mask, const py::array& array, double full)
{
    const auto rows = py::array_t<Item, py::array::c_style | py::array::forcecast>::ensure(array);
    const std::span<const Item> items(rows.data(), static_cast<std::size_t>(rows.size()));
    const auto fill_above = [&](Item dry) {
        std::transform(items.begin(), items.end(), mask.coverage.begin(),
                       [&](Item item) { return static_cast<std::uint16_t>(item > dry ? kFull : 0.0); });
    };
    if (const auto both = droplet::twoLevels(items)) {
        return fill_above(both->first);
    }
    if (std::all_of(items.begin(), items.end(), [&](Item item) { return item == items.front(); })) {
        return fill_above(Item{});
    }
    std::transform(items.begin(), items.end(), mask.coverage.begin(), [&](Item item) {
        const auto level = static_cast<double>(item);
        if (!(level >= 0.0 && level <= full)) {
            refuseLevel(level, fmt::format("from 0 to {}", full));
        }
        return static_cast<std::uint16_t>(std::lround(level / full * kFull));
    });
}

/// Level of full coverage in an array of integers: the largest of its type, or of the smaller of 8 and 16 bits that
/// holds all.
double fullLevel(const py::array& array)
{
    if (py::isinstance<py::array_t<std::uint8_t>>(array) || py::isinstance<py::array_t<std::uint16_t>>(array)) {
        return array.itemsize() == 1 ? 255.0 : kFull;
    }
    return array.attr("max")().cast<double>() <= 255.0 ? 255.0 : kFull;
}

droplet::Mask fromArray(const py::array& array)
{
    if (array.ndim() != 2) {
        throw Error(ErrorCode::InvalidArgument,
                    fmt::format("mask: an array of {} dimensions must have 2; of a picture with colours take one "
                                "channel, or give by_colour",
                                array.ndim()));
    }
    constexpr py::ssize_t kMaxSide = std::numeric_limits<std::int32_t>::max();
    if (array.size() == 0 || array.shape(0) > kMaxSide || array.shape(1) > kMaxSide) {
        throw Error(ErrorCode::InvalidArgument,
                    fmt::format("mask: {} x {} pixels must be at least 1 x 1", array.shape(1), array.shape(0)));
    }
    droplet::Mask mask;
    mask.width = static_cast<int>(array.shape(1));
    mask.height = static_cast<int>(array.shape(0));
    mask.coverage.resize(static_cast<std::size_t>(array.size()));
    switch (array.dtype().kind()) {
        case 'b':
            fill<std::uint8_t>(mask, array, 1.0);
            break;
        case 'u':
        case 'i':
            array.itemsize() == 1 && array.dtype().kind() == 'u' ? fill<std::uint8_t>(mask, array, fullLevel(array))
                                                                 : fill<double>(mask, array, fullLevel(array));
            break;
        case 'f':
            fill<double>(mask, array, 1.0);
            break;
        default:
            throw Error(ErrorCode::InvalidArgument,
                        "mask: an array of " + std::string(py::str(array.dtype())) + " must be of bool, int or float");
    }
    return mask;
}

Mask readMask(const std::filesystem::path& path, const Arguments& arguments)
{
    const Work work({});
    Arguments all = arguments;
    all.insert(all.end(), {"INPUT", "droplet.glb"});
    const auto options = parsed(cli::parseShape, all);
    Mask read{droplet::readMask(path, options.footprint.mask), path.string(), {}};
    if (options.footprint.mask.accept_any) {
        read.threshold = options.footprint.trace.threshold;
    }
    return read;
}

}  // namespace

Mask maskOf(const py::handle& from)
{
    if (py::isinstance<Mask>(from)) {
        return from.cast<const Mask&>();
    }
    return {fromArray(from.cast<py::array>()), "array", {}};
}

std::string pngOf(const py::handle& from)
{
    const auto array = py::isinstance<Mask>(from) ? py::array() : from.cast<py::array>();
    const bool has_colours = array.ndim() == 3 && (array.shape(2) == 3 || array.shape(2) == 4);
    if (!has_colours || array.size() == 0 || !py::isinstance<py::array_t<std::uint8_t>>(array)) {
        throw Error(
            ErrorCode::InvalidArgument,
            "mask: for by_colour it must be an array of rows, columns, and red, green, blue and maybe alpha, of "
            "uint8");
    }
    const auto height = static_cast<int>(array.shape(0));
    const auto width = static_cast<int>(array.shape(1));
    const auto items = array.unchecked<std::uint8_t, 3>();
    std::vector<std::uint8_t> levels;
    levels.reserve(static_cast<std::size_t>(array.size()));
    for (py::ssize_t y = 0; y < items.shape(0); ++y) {
        for (py::ssize_t x = 0; x < items.shape(1); ++x) {
            for (py::ssize_t c = 0; c < items.shape(2); ++c) {
                levels.push_back(items(y, x, c));
            }
        }
    }
    std::ostringstream png;
    if (array.shape(2) == 3) {
        writePng(droplet::Picture{width, height, std::move(levels)}, png, droplet::PngEffort::Fast);
    } else {
        writePng(droplet::Layer{width, height, std::move(levels)}, png, droplet::PngEffort::Fast);
    }
    return std::move(png).str();
}

template <>
struct Members<droplet::MaskLevels> {
    static constexpr std::tuple list{&droplet::MaskLevels::channel, &droplet::MaskLevels::dry,
                                     &droplet::MaskLevels::liquid};
};

template <>
struct Members<droplet::Mask> {
    static constexpr std::tuple list{&droplet::Mask::width,
                                     &droplet::Mask::height,
                                     &droplet::Mask::coverage,
                                     &droplet::Mask::channel,
                                     &droplet::Mask::inverted,
                                     &droplet::Mask::segment,
                                     &droplet::Mask::segment_confidence,
                                     &droplet::Mask::level_dry,
                                     &droplet::Mask::level_liquid,
                                     &droplet::Mask::found,
                                     &droplet::Mask::raster_scale,
                                     &droplet::Mask::physical_width,
                                     &droplet::Mask::lacking};
};

template <>
struct Members<Mask> {
    static constexpr std::tuple list{&Mask::mask, &Mask::path, &Mask::threshold};
};

void bindMask(py::module_& module)
{
    py::class_<Mask, std::shared_ptr<Mask>>(module, "Mask", py::buffer_protocol(),
                                            R"(Coverage of the pixels of a picture by liquid, made by read_mask().

numpy.asarray(mask) is a read-only array of uint16, rows from the top, that
shares its memory: 0 is dry, 65535 is liquid.)")
        .def_buffer([](Mask& self) {
            const droplet::Mask& mask = self.mask;
            constexpr auto kItem = static_cast<py::ssize_t>(sizeof(std::uint16_t));
            return py::buffer_info(self.mask.coverage.data(), kItem, py::format_descriptor<std::uint16_t>::format(), 2,
                                   {mask.height, mask.width}, {kItem * mask.width, kItem}, true);
        })
        .def_property_readonly(
            "shape", [](const Mask& self) { return py::make_tuple(self.mask.height, self.mask.width); },
            "Height and width [px].")
        .def_property_readonly(
            "channel", [](const Mask& self) { return self.mask.channel == droplet::Channel::Alpha ? "alpha" : "luma"; },
            "Channel that shows the liquid: alpha or luma.")
        .def_property_readonly(
            "inverted", [](const Mask& self) { return self.mask.inverted; },
            "Whether dark or transparent pixels are the liquid.")
        .def_property_readonly(
            "segment", [](const Mask& self) { return name(self.mask.segment); },
            "How liquid was separated from dry: threshold, adaptive or grabcut.")
        .def_property_readonly(
            "segment_confidence", [](const Mask& self) { return self.mask.segment_confidence; },
            "How much the picture looks like a mask, from 0 to 1.")
        .def_property_readonly(
            "physical_width", [](const Mask& self) { return self.mask.physical_width; },
            "Width that an SVG states [m], or None.")
        .def(
            "_repr_png_",
            [](const Mask& self) {
                std::ostringstream png;
                {
                    const py::gil_scoped_release release;
                    droplet::writePng(droplet::DeepPicture{self.mask.width, self.mask.height, 1, self.mask.coverage},
                                      png, droplet::PngEffort::Fast);
                }
                return py::bytes(png.str());
            },
            "Picture for notebooks, as PNG: white is liquid.")
        .def(py::pickle([](const Mask& self) { return pickled(stateOf(self)); },
                        [](const py::tuple& pickle) {
                            auto mask = std::make_shared<Mask>(valueOf<Mask>(unpickled(pickle)));
                            mask->mask.validate();
                            return mask;
                        }))
        .def("__repr__", [](const Mask& self) {
            return fmt::format("<Mask of {} x {} pixels>", self.mask.width, self.mask.height);
        });
    module.def("read_mask", &readMask);
}

}  // namespace binding

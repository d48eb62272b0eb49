// SPDX-License-Identifier: GPL-3.0-or-later
#include "errors.h"

#include <exception>
#include <utility>

#include "droplet/error.h"
#include "droplet/printable.h"

namespace binding {
namespace {

namespace py = pybind11;

}  // namespace

void registerErrors()
{
    py::register_exception_translator([](std::exception_ptr thrown) {
        if (!thrown) {
            return;
        }
        try {
            std::rethrow_exception(std::move(thrown));
        } catch (const droplet::Error& error) {
            const py::object made = py::module_::import("droplet_shape._errors")
                                        .attr("made")(name(error.code()), droplet::printable(error.what()));
            PyErr_SetObject(py::type::of(made).ptr(), made.ptr());
        }
    });
}

}  // namespace binding

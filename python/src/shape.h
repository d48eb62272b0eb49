// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>

#include "droplet/droplet.h"
#include "droplet/io/report.h"
#include "droplet_options.h"
#include "stage_clock.h"
#include "surface.h"

namespace binding {

/// Droplet with its report.
class Droplet : public Surface {
public:
    /// @param droplet   its surface becomes the base
    /// @param settings  settings that it was made with
    /// @param input     for the report
    /// @param onto      for the report, if they lie on an object
    /// @param clock     for the report
    static std::shared_ptr<Droplet> make(droplet::Droplet droplet, const cli::DropletSettings& settings,
                                         droplet::InputReport input, std::optional<droplet::ObjectReport> onto,
                                         cli::StageClock& clock);

    /// Report as JSON, with the schema droplet-shape.report/1.
    [[nodiscard]] std::string json() const;

private:
    Droplet(droplet::Surface surface, droplet::Material material, droplet::Report report)
        : Surface(std::move(surface), material, report.warnings), report_(std::move(report))
    {
    }

    droplet::Report report_;  ///< without output
};

/// Adds droplets to the module.
void bindShape(pybind11::module_& module);

}  // namespace binding

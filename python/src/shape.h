// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "droplet/droplet.h"
#include "droplet/footprint/css_colour.h"
#include "droplet/io/report.h"
#include "droplet_options.h"
#include "stage_clock.h"
#include "surface.h"

namespace binding {

/// What the report of droplets says of their origin.
struct DropletSource {
    droplet::InputReport input;
    std::optional<droplet::ObjectReport> onto = {};  ///< if they lie on an object
    std::vector<droplet::CssColour> colours = {};    ///< one per droplet, or none
};

/// Droplet with its report.
class Droplet : public Surface {
public:
    /// @param droplet   its surface becomes the base
    /// @param settings  settings that it was made with
    /// @param source    for the report
    /// @param clock     for the report
    static std::shared_ptr<Droplet> make(droplet::Droplet droplet, const cli::DropletSettings& settings,
                                         DropletSource source, cli::StageClock& clock);

    [[nodiscard]] const std::vector<droplet::DropletReport>& droplets() const { return report_.droplets; }

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

// SPDX-License-Identifier: GPL-3.0-or-later
#include "wind_io/forces_section.h"

#include "droplet/units.h"

namespace droplet {

ReportJson forcesSection(const ForceModel& forces)
{
    return {{"liquid", forces.liquid.name},
            {"surface_tension_n_per_m", forces.liquid.surface_tension},
            {"density_kg_per_m3", forces.liquid.density},
            {"gravity_m_per_s2", forces.gravity},
            {"contact_angle_deg", forces.wetting.contact_angle / kDegree},
            {"hysteresis", forces.wetting.hysteresis},
            {"falling_angle_deg",
             forces.wetting.sliding_angle ? ReportJson(*forces.wetting.sliding_angle / kDegree) : ReportJson()},
            {"kinetic_fraction", forces.wetting.kinetic_fraction},
            {"viscosity_factor_pa_s", forces.wetting.viscosity_factor},
            {"air_density_kg_per_m3", forces.air.density},
            {"drag_coefficient", forces.air.drag_coefficient},
            {"boundary_layer_m", forces.air.boundary_layer},
            {"profile_exponent", forces.air.profile_exponent}};
}

}  // namespace droplet

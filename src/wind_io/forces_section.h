// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/wind/forces.h"
#include "io/report_sections.h"

namespace droplet {

/// Constants of the forces on a droplet.
ReportJson forcesSection(const ForceModel& forces);

}  // namespace droplet

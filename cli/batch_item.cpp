// SPDX-License-Identifier: GPL-3.0-or-later
#include "batch_item.h"

namespace cli {

BatchFigures figuresOf(const droplet::Report& report)
{
    return {report.output.triangles, report.output.vertices, report.output.topology.closed, report.total.volume,
            report.total.height_max, report.warnings,        report.severe_warnings};
}

const char* name(ItemStatus status)
{
    switch (status) {
        case ItemStatus::Made:
            return "made";
        case ItemStatus::Skipped:
            return "skipped";
        case ItemStatus::Failed:
            return "failed";
        case ItemStatus::NotStarted:
            break;
    }
    return "not started";
}

}  // namespace cli

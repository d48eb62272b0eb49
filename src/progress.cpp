// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/progress.h"

#include "droplet/error.h"

namespace droplet {

const char* name(Stage stage)
{
    switch (stage) {
        case Stage::Read:
            return "read";
        case Stage::Trace:
            return "trace";
        case Stage::Triangulate:
            return "triangulate";
        case Stage::Assemble:
            return "assemble";
        case Stage::Solve:
            return "solve";
        case Stage::Loft:
            return "loft";
        case Stage::Write:
            return "write";
    }
    throw Error(ErrorCode::InvalidArgument, "stage: no such stage");
}

}  // namespace droplet

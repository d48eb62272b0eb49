// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the outline of a mask, in the width that droplet-shape uses, for another mesher:
//
//   bench_outline MASK SPACING_MM > loops
//
// For every loop it writes the number of points and the points [mm]; outer rims are counter-clockwise, holes clockwise.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "droplet/droplet.h"
#include "resample.h"

namespace {

void print(const droplet::Loop& loop)
{
    std::printf("%zu\n", loop.points.size());
    for (const droplet::Vec2 p : loop.points) {
        std::printf("%.17g %.17g\n", p.x / droplet::kMillimetre, p.y / droplet::kMillimetre);
    }
}

}  // namespace

int main(int argc, char** argv)
{
    if (argc != 3) {
        std::fputs("usage: bench_outline MASK SPACING_MM\n", stderr);
        return 2;
    }
    try {
        const double spacing = std::atof(argv[2]) * droplet::kMillimetre;
        const droplet::Outline outline = droplet::trace(droplet::readMask(argv[1]));
        for (const droplet::Footprint& footprint : droplet::bench::resampled(split(outline), spacing).droplets) {
            print(footprint.rim);
            for (const droplet::Loop& hole : footprint.holes) {
                print(hole);
            }
        }
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_outline: %s\n", error.what());
        return 1;
    }
}

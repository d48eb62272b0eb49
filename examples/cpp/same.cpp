// SPDX-License-Identifier: GPL-3.0-or-later
// Checks whether two surfaces agree to a hundredth of a millimetre: same A.glb B.glb
// Exit code: 0 they agree, 1 they differ, 2 error
#include <droplet/compare/compare.h>
#include <droplet/error.h>
#include <droplet/io/read_surface.h>

#include <iostream>

int main(int argc, char** argv)
{
    if (argc != 3) {
        std::cerr << "usage: same A.glb B.glb\n";
        return 2;
    }
    try {
        constexpr double kTolerance = 1e-5;
        droplet::CompareOptions options;
        options.tolerance = kTolerance;
        const droplet::Comparison comparison =
            droplet::compare(droplet::readSurface(argv[1]).surface, droplet::readSurface(argv[2]).surface, options);
        std::cout << "at most " << comparison.symmetric.upper * 1e3 << " mm apart\n";
        return comparison.symmetric.upper <= kTolerance && comparison.same_topology ? 0 : 1;
    } catch (const droplet::Error& error) {
        std::cerr << error.what() << "\n";
        return 2;
    }
}

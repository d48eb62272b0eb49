// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a droplet of a picture: logo IN.png OUT.glb
#include <droplet/droplet.h>
#include <droplet/error.h>
#include <droplet/io/output.h>

#include <iostream>

int main(int argc, char** argv)
{
    if (argc != 3) {
        std::cerr << "usage: logo IN.png OUT.glb\n";
        return 2;
    }
    try {
        droplet::DropletOptions options;
        options.trace.width = 80e-3;      // SI units throughout: 8 cm
        options.solve.fill.amount = 0.5;  // a contact angle of 0.5 rad
        const droplet::Droplet drop = droplet::makeDroplet(droplet::readMask(argv[1]), options);
        for (const std::string& warning : drop.warnings) {
            std::cerr << "warning: " << warning << "\n";
        }
        droplet::writeAtomically(argv[2],
                                 [&](std::ostream& out) { writeSurface(drop.surface, out, droplet::Format::Glb); });
        std::cout << drop.figures.size() << " droplets, " << drop.total.volume * 1e9 << " uL\n";
    } catch (const droplet::Error& error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
}

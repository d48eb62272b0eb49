// SPDX-License-Identifier: GPL-3.0-or-later
#include <droplet/droplet.h>
#include <droplet/io/output.h>

int main()
{
    droplet::DropletOptions options;  // lengths in metres, angles in radians: SI units throughout
    options.trace.width = 30e-3;
    options.solve.liquid = droplet::liquidNamed("glycerol");
    const droplet::Droplet drop = droplet::makeDroplet(droplet::readMask("logo.png"), options);
    droplet::writeAtomically("logo.glb",
                             [&](std::ostream& out) { writeSurface(drop.surface, out, droplet::Format::Glb); });
}

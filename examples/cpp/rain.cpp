// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of a program that shows rain on a windshield as it falls: rain FRAMES
// A renderer uploads the tiles that `update` names; here they are counted.
#include <droplet/error.h>
#include <droplet/windshield/presets.h>
#include <droplet/windshield/windshield.h>
#include <droplet/windshield_view/windshield_maps.h>

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <utility>
#include <vector>

int main(int argc, char** argv)
{
    try {
        droplet::WindshieldParameters parameters = droplet::windshieldPresetNamed("figure-3.12").parameters;
        parameters.wipers = droplet::tandemWipers(parameters.glass, 1.2);
        droplet::WindshieldState state = droplet::startWindshield(parameters);
        droplet::WindshieldMaps maps(parameters.glass, {.width = 1024});
        // RGBA, half floats: normal x and y times wetness, thickness in mm, wetness.
        std::vector<std::uint16_t> pixels(std::size_t{4} * maps.width() * maps.height());
        const int frames = argc > 1 ? std::atoi(argv[1]) : 60;
        for (int frame = 0; frame < frames; ++frame) {
            // A driver's inputs go here: parameters.vehicle = droplet::constantSpeed(30.0), or parameters.rainfall.
            state = droplet::step(std::move(state), parameters, 1.0 / 60.0);
            const std::vector<droplet::MapTile>& tiles = maps.update(state, pixels);
            // For each tile: glTexSubImage2D(GL_TEXTURE_2D, 0, x, y, width, height, GL_RGBA, GL_HALF_FLOAT, …)
            std::cout << frame << ": " << state.droplets.size() << " run, " << state.still.count() << " rest, "
                      << tiles.size() << " tiles changed\n";
        }
        return 0;
    } catch (const droplet::Error& error) {
        std::cerr << error.what() << "\n";
        return 2;
    }
}

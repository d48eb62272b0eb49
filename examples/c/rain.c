// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of a program that shows rain on a windshield as it falls: rain FRAMES
//   cc rain.c $(pkg-config --cflags --libs droplet-c) -o rain
#include <droplet/c/droplet.h>
#include <stdio.h>
#include <stdlib.h>

static void check(DropletCode code)
{
    if (code != DROPLET_OK) {
        fprintf(stderr, "%s\n", droplet_message());
        exit(2);
    }
}

int main(int argc, char** argv)
{
    DropletWindshield* rain = NULL;
    check(droplet_windshield_new("figure-3.12", &rain));
    check(droplet_windshield_set(rain, "wiper-period", 1.2));
    int32_t height = 0;
    check(droplet_windshield_map_height(rain, 1024, &height));
    // RGBA, half floats: normal x and y times wetness, thickness in mm, wetness.
    uint16_t* const pixels = calloc((size_t)4 * 1024 * (size_t)height, sizeof *pixels);
    const int frames = argc > 1 ? atoi(argv[1]) : 60;
    for (int frame = 0; frame < frames; ++frame) {
        // A driver's inputs go here: droplet_windshield_set(rain, "speed", 30.0).
        check(droplet_windshield_advance(rain, 1.0 / 60.0));
        DropletTiles tiles;
        check(droplet_windshield_draw(rain, 1024, pixels, &tiles));
        // For each tile: glTexSubImage2D(GL_TEXTURE_2D, 0, x, y, width, height, GL_RGBA, GL_HALF_FLOAT, …)
        printf("%d: %zu run, %zu tiles changed\n", frame, droplet_windshield_running(rain, NULL, 0), tiles.count);
    }
    free(pixels);
    droplet_windshield_delete(rain);
    return 0;
}

// SPDX-License-Identifier: GPL-3.0-or-later
// The interface from C: interface_test FOLDER PICTURE. Prints what does not hold; the exit code is the number of such
// lines.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "droplet/c/droplet.h"

static int failures = 0;

#define HOLDS(what)                                                     \
    do {                                                                \
        if (!(what)) {                                                  \
            fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #what);  \
            fprintf(stderr, "  last message: %s\n", droplet_message()); \
            ++failures;                                                 \
        }                                                               \
    } while (0)

static double volume_of(const DropletMesh* mesh)
{
    double six = 0.0;
    for (size_t t = 0; t < mesh->triangles; ++t) {
        const float* p[3];
        for (int k = 0; k < 3; ++k) {
            p[k] = mesh->positions + 3 * (size_t)mesh->indices[3 * t + (size_t)k];
        }
        six += p[0][0] * ((double)p[1][1] * p[2][2] - (double)p[1][2] * p[2][1]) +
               p[0][1] * ((double)p[1][2] * p[2][0] - (double)p[1][0] * p[2][2]) +
               p[0][2] * ((double)p[1][0] * p[2][1] - (double)p[1][1] * p[2][0]);
    }
    return six / 6.0;
}

// A disc in memory holds the volume that was asked for, and its files are those of the command.
static void shapes(const char* folder, const char* picture)
{
    enum { kSide = 100 };
    static uint8_t coverage[kSide * kSide];
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            coverage[y * kSide + x] = hypot(x - 49.5, y - 49.5) < 40.0 ? 255 : 0;
        }
    }
    const DropletMask mask = {coverage, kSide, kSide};
    const char* const options[] = {"--width", "10mm", "--volume", "20uL", "--threads", "1"};
    DropletShape* shape = NULL;
    HOLDS(droplet_shape_of_mask(&mask, options, 6, &shape) == DROPLET_OK);
    DropletMesh mesh;
    HOLDS(droplet_shape_mesh(shape, &mesh) == DROPLET_OK);
    // Floats of millimetres, summed in double.
    HOLDS(fabs(volume_of(&mesh) - 20e-9) < 1e-5 * 20e-9);
    const char* report = NULL;
    HOLDS(droplet_shape_report(shape, &report) == DROPLET_OK);
    HOLDS(strstr(report, "\"schema\": \"droplet-shape.report/") != NULL);
    char path[1000];
    snprintf(path, sizeof path, "%s/of_mask.obj", folder);
    HOLDS(droplet_shape_write(shape, path) == DROPLET_OK);
    snprintf(path, sizeof path, "%s/none.xyz", folder);
    HOLDS(droplet_shape_write(shape, path) == DROPLET_INVALID_ARGUMENT);
    HOLDS(strstr(droplet_message(), "xyz") != NULL);
    HOLDS(droplet_shape_write(shape, "/nowhere/at/all.glb") == DROPLET_OUTPUT_FAILED);
    droplet_shape_delete(shape);

    shape = NULL;
    HOLDS(droplet_shape_of_file(picture, NULL, 0, &shape) == DROPLET_OK);
    snprintf(path, sizeof path, "%s/of_file.glb", folder);
    HOLDS(droplet_shape_write(shape, path) == DROPLET_OK);
    droplet_shape_delete(shape);

    const char* const wrong[] = {"--volume", "many"};
    shape = NULL;
    HOLDS(droplet_shape_of_mask(&mask, wrong, 2, &shape) == DROPLET_INVALID_ARGUMENT && shape == NULL);
    HOLDS(strstr(droplet_message(), "--volume") != NULL);
    const char* const page[] = {"--html", "page.html"};
    HOLDS(droplet_shape_of_mask(&mask, page, 2, &shape) == DROPLET_INVALID_ARGUMENT);
    HOLDS(droplet_shape_of_file("/nowhere/at/all.png", NULL, 0, &shape) == DROPLET_INVALID_INPUT);
    HOLDS(droplet_shape_of_file(NULL, NULL, 0, &shape) == DROPLET_INVALID_ARGUMENT);
    HOLDS(droplet_shape_of_file(picture, NULL, 0, NULL) == DROPLET_INVALID_ARGUMENT);
    memset(coverage, 0, sizeof coverage);
    HOLDS(droplet_shape_of_mask(&mask, NULL, 0, &shape) == DROPLET_INVALID_INPUT);
    HOLDS(droplet_shape_of_mask(&(DropletMask){coverage, 0, 5}, NULL, 0, &shape) == DROPLET_INVALID_ARGUMENT);
    HOLDS(shape == NULL);
    droplet_shape_delete(NULL);
}

static double value_of(const DropletWindshield* windshield, const char* name)
{
    double value = NAN;
    HOLDS(droplet_windshield_get(windshield, name, &value) == DROPLET_OK);
    return value;
}

// Rain that arrives is on the glass or has left it; the texture follows by its tiles alone.
static void rain(void)
{
    DropletWindshield* windshield = NULL;
    HOLDS(droplet_windshield_new("figure-4", &windshield) == DROPLET_INVALID_ARGUMENT && windshield == NULL);
    HOLDS(droplet_windshield_new(NULL, &windshield) == DROPLET_OK);
    HOLDS(value_of(windshield, "speed") == 15.0);
    HOLDS(droplet_windshield_set(windshield, "glass-width", 0.7) == DROPLET_OK);
    HOLDS(value_of(windshield, "glass-width") == 0.7);
    HOLDS(droplet_windshield_set(windshield, "rain", 50.0 / 3.6e6) == DROPLET_OK);
    HOLDS(droplet_windshield_set(windshield, "mist", 1e-6) == DROPLET_OK);
    HOLDS(value_of(windshield, "splashes") == 0.0);
    HOLDS(droplet_windshield_set(windshield, "splashes", 1.0) == DROPLET_OK);
    HOLDS(value_of(windshield, "splashes") == 1.0);
    HOLDS(droplet_windshield_set(windshield, "splashes", 2.0) == DROPLET_INVALID_ARGUMENT);
    HOLDS(droplet_windshield_set(windshield, "wiper-period", 1.5) == DROPLET_OK);
    HOLDS(droplet_windshield_set(windshield, "wiper-period", 1.0) == DROPLET_INVALID_ARGUMENT);
    HOLDS(droplet_windshield_set(windshield, "hysteresis", -1.0) == DROPLET_INVALID_ARGUMENT);
    HOLDS(droplet_windshield_set(windshield, "gravity", NAN) == DROPLET_INVALID_ARGUMENT);
    HOLDS(droplet_windshield_set(windshield, "nothing", 1.0) == DROPLET_INVALID_ARGUMENT);
    HOLDS(strstr(droplet_message(), "hysteresis") != NULL);  // the message lists all names
    HOLDS(droplet_windshield_set(windshield, NULL, 1.0) == DROPLET_INVALID_ARGUMENT);

    enum { kWidth = 256 };
    int32_t height = 0;
    HOLDS(droplet_windshield_map_height(windshield, kWidth, &height) == DROPLET_OK && height > 0);
    HOLDS(droplet_windshield_map_height(windshield, 4, &height) == DROPLET_INVALID_ARGUMENT);
    const size_t count = 4 * (size_t)kWidth * (size_t)height;
    uint16_t* const whole = malloc(count * sizeof *whole);
    uint16_t* const texture = calloc(count, sizeof *texture);
    memset(whole, 0x55, count * sizeof *whole);  // the first drawing writes everything
    for (int frame = 0; frame < 90; ++frame) {
        if (frame == 30) {
            HOLDS(droplet_windshield_set(windshield, "contact-angle", 1.5) == DROPLET_OK);
        }
        const DropletSpray spray = {0.35, 0.4, 0.05, 1e-8};
        HOLDS(droplet_windshield_spray(windshield, &spray) == DROPLET_OK);
        const DropletStroke stroke = {0.2, 0.2 + 0.003 * frame, 0.2, 0.203 + 0.003 * frame, 0.014};
        HOLDS(droplet_windshield_finger(windshield, &stroke) == DROPLET_OK);
        HOLDS(droplet_windshield_advance(windshield, 1.0 / 60.0) == DROPLET_OK);
        DropletTiles tiles;
        HOLDS(droplet_windshield_draw(windshield, kWidth, whole, &tiles) == DROPLET_OK);
        for (size_t k = 0; k < tiles.count; ++k) {  // as a texture is filled
            const DropletTile t = tiles.list[k];
            for (int32_t y = t.y; y < t.y + t.height; ++y) {
                const size_t at = 4 * ((size_t)y * kWidth + (size_t)t.x);
                memcpy(texture + at, whole + at, 4 * (size_t)t.width * sizeof *texture);
            }
        }
    }
    HOLDS(memcmp(whole, texture, count * sizeof *whole) == 0);

    DropletWindshieldFigures figures;
    HOLDS(droplet_windshield_figures(windshield, &figures) == DROPLET_OK);
    HOLDS(fabs(figures.time - 1.5) < 1e-12 && figures.width == 0.7 && figures.raindrops > 0 && figures.still > 0);
    DropletWater water;
    HOLDS(droplet_windshield_water(windshield, &water) == DROPLET_OK);
    HOLDS(water.volume > 0.0 && fabs(water.balance_error) < 1e-12);
    DropletRunning first[2];
    HOLDS(droplet_windshield_running(windshield, first, 2) == figures.running && figures.running > 2);
    HOLDS(first[0].id < first[1].id && first[0].volume > 0.0 && first[0].radius > 1e-4);
    HOLDS(droplet_windshield_running(windshield, NULL, 0) == figures.running);

    DropletMistMap mist;
    HOLDS(droplet_windshield_mist(windshield, &mist) == DROPLET_OK);
    // 1.5 µm of 10 µm, where neither finger nor wiper was; nothing where the finger is.
    HOLDS(mist.pixels[mist.width - 1] == 38);
    const int32_t x = (int32_t)(0.2 / (mist.right * 0.7) * mist.width);
    const int32_t y = (int32_t)((1.0 - 0.45 / (mist.top * figures.height)) * mist.height);
    HOLDS(mist.pixels[y * mist.width + x] <= 3);

    DropletMistMap film;
    HOLDS(droplet_windshield_runoff(windshield, &film) == DROPLET_OK && film.width == 1 && film.pixels[0] == 0);
    HOLDS(droplet_windshield_set(windshield, "runoff", 11.0) == DROPLET_INVALID_ARGUMENT);
    HOLDS(droplet_windshield_set(windshield, "runoff", 1.0) == DROPLET_OK);
    for (int frame = 0; frame < 60; ++frame) {
        HOLDS(droplet_windshield_advance(windshield, 1.0 / 60.0) == DROPLET_OK);
    }
    HOLDS(droplet_windshield_runoff(windshield, &film) == DROPLET_OK && film.width >= 175 && film.right >= 1.0);
    int32_t wet = 0;
    for (int32_t k = 0; k < film.width * film.height; ++k) {
        wet += film.pixels[k] > 5 ? 1 : 0;
    }
    HOLDS(wet > 20);
    double drift[2] = {0.0, 0.0};
    HOLDS(droplet_windshield_runoff_drift(windshield, drift) == DROPLET_OK && fabs(drift[1]) > 1e-3 &&
          fabs(drift[1]) < 0.037);
    HOLDS(droplet_windshield_runoff_drift(windshield, NULL) == DROPLET_INVALID_ARGUMENT);
    HOLDS(droplet_windshield_water(windshield, &water) == DROPLET_OK && fabs(water.balance_error) < 1e-12);

    DropletPlace place;
    HOLDS(droplet_windshield_place(windshield, 0.35, 0.4, &place) == DROPLET_OK);
    HOLDS(fabs(place.point[0]) < 1e-12 && fabs(place.across[0] - 1.0) < 1e-12 && place.normal[2] > 0.0);
    HOLDS(droplet_windshield_place(windshield, 9.0, 0.4, &place) == DROPLET_INVALID_ARGUMENT);

    // A stroke of the wiper ends before the blades are gone; a speed is reached as a car can.
    DropletBlade blade;
    HOLDS(droplet_windshield_set(windshield, "wiper-period", 0.0) == DROPLET_OK);
    HOLDS(droplet_windshield_set(windshield, "speed", 27.0) == DROPLET_OK);
    HOLDS(droplet_windshield_set(windshield, "slope", 0.5) == DROPLET_INVALID_ARGUMENT);
    HOLDS(droplet_windshield_set(windshield, "wiper-period", 1.2) == DROPLET_OK);
    HOLDS(droplet_windshield_advance(windshield, 0.1) == DROPLET_OK);
    HOLDS(droplet_windshield_set(windshield, "wiper-period", 0.0) == DROPLET_OK);
    HOLDS(droplet_windshield_blades(windshield, &blade, 1) == 2 && blade.outer_y > blade.inner_y);
    // The blade's line goes through the pivot, about which it has turned.
    const double across = (blade.inner_x - blade.pivot_x) * (blade.outer_y - blade.pivot_y) -
                          (blade.inner_y - blade.pivot_y) * (blade.outer_x - blade.pivot_x);
    HOLDS(across < 1e-12 && across > -1e-12 && blade.last > blade.first);
    for (int frame = 0; frame < 12; ++frame) {
        HOLDS(droplet_windshield_advance(windshield, 0.1) == DROPLET_OK);
    }
    HOLDS(droplet_windshield_blades(windshield, &blade, 1) == 0);
    HOLDS(droplet_windshield_figures(windshield, &figures) == DROPLET_OK);
    HOLDS(fabs(figures.speed - 27.0) < 1e-9);
    HOLDS(droplet_windshield_advance(windshield, 0.0) == DROPLET_INVALID_ARGUMENT);
    free(whole);
    free(texture);
    droplet_windshield_delete(windshield);
    droplet_windshield_delete(NULL);
}

// Rain on a mesh: a flat glass of 0.4 m by 0.3 m at 45 degrees, whose lower corners are cut off.
static void surfaces(void)
{
    enum { kCorners = 6 };
    const double uvs_of[kCorners][2] = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.5}, {0.75, 0.75}, {0.25, 0.75}, {0.0, 0.5}};
    float positions[3 * kCorners];
    float normals[3 * kCorners];
    float uvs[2 * kCorners];
    for (int k = 0; k < kCorners; ++k) {
        const float up = (float)(0.4 * (0.75 - uvs_of[k][1]) * sqrt(0.5));
        const float place[3] = {(float)(0.4 * uvs_of[k][0]), up, up};
        const float normal[3] = {0.0F, (float)-sqrt(0.5), (float)sqrt(0.5)};
        memcpy(positions + 3 * k, place, sizeof place);
        memcpy(normals + 3 * k, normal, sizeof normal);
        uvs[2 * k] = (float)uvs_of[k][0];
        uvs[2 * k + 1] = (float)uvs_of[k][1];
    }
    uint32_t indices[] = {0, 5, 2, 0, 2, 1, 5, 4, 3, 5, 3, 2};
    DropletMesh mesh = {kCorners, positions, normals, uvs, NULL, 4, indices};
    DropletWindshield* windshield = NULL;
    HOLDS(droplet_windshield_new(NULL, &windshield) == DROPLET_OK);
    HOLDS(droplet_windshield_surface(windshield, NULL) == DROPLET_INVALID_ARGUMENT);
    indices[0] = 9;
    HOLDS(droplet_windshield_surface(windshield, &mesh) == DROPLET_INVALID_ARGUMENT);
    indices[0] = 0;
    mesh.uvs = NULL;
    HOLDS(droplet_windshield_surface(windshield, &mesh) == DROPLET_INVALID_ARGUMENT);
    HOLDS(strstr(droplet_message(), "mesh.uvs") != NULL);
    HOLDS(value_of(windshield, "glass-width") == 1.4);  // what failed has changed nothing
    mesh.uvs = uvs;
    HOLDS(droplet_windshield_surface(windshield, &mesh) == DROPLET_OK);
    DropletWindshieldFigures figures;
    HOLDS(droplet_windshield_figures(windshield, &figures) == DROPLET_OK);
    HOLDS(fabs(figures.width - 0.4) < 1e-6 && fabs(figures.height - 0.3) < 1e-6);
    double value = 0.0;
    HOLDS(droplet_windshield_get(windshield, "slope", &value) == DROPLET_INVALID_ARGUMENT);
    HOLDS(strstr(droplet_message(), "slope: the glass is a mesh") != NULL);
    HOLDS(droplet_windshield_set(windshield, "glass-width", 1.0) == DROPLET_INVALID_ARGUMENT);

    DropletTriangles triangles;
    HOLDS(droplet_windshield_triangles(windshield, &triangles) == DROPLET_OK && triangles.count == 4);
    double area = 0.0;
    for (size_t t = 0; t < triangles.count; ++t) {
        const DropletCorner* c = triangles.corners + 3 * t;
        area += 0.5 * ((c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y));
        for (int k = 0; k < 3; ++k) {  // it is flat: up the glass is up and back
            HOLDS(fabs(c[k].place.point[2] - c[k].y * sqrt(0.5)) < 1e-6);
            HOLDS(fabs(c[k].place.up[2] - sqrt(0.5)) < 1e-6 && fabs(c[k].place.normal[1] - sqrt(0.5)) < 1e-6);
        }
    }
    HOLDS(fabs(area - (0.4 * 0.3 - 0.1 * 0.1)) < 1e-6);

    DropletPlace place;
    HOLDS(droplet_windshield_place(windshield, 0.02, 0.02, &place) == DROPLET_INVALID_ARGUMENT);
    HOLDS(droplet_windshield_place(windshield, 0.2, 0.02, &place) == DROPLET_OK);
    HOLDS(droplet_windshield_set(windshield, "rain", 50.0 / 3.6e6) == DROPLET_OK);
    for (int frame = 0; frame < 60; ++frame) {
        HOLDS(droplet_windshield_advance(windshield, 1.0 / 60.0) == DROPLET_OK);
    }
    DropletRunning running[64];
    const size_t count = droplet_windshield_running(windshield, running, 64);
    HOLDS(count > 2);
    for (size_t k = 0; k < (count < 64 ? count : 64); ++k) {
        HOLDS(droplet_windshield_place(windshield, running[k].x, running[k].y, &place) == DROPLET_OK);
    }
    DropletWater water;
    HOLDS(droplet_windshield_water(windshield, &water) == DROPLET_OK);
    HOLDS(water.volume > 0.0 && fabs(water.balance_error) < 1e-12);
    HOLDS(droplet_windshield_surface(windshield, &mesh) == DROPLET_INVALID_ARGUMENT);
    HOLDS(strstr(droplet_message(), "mesh must be set before the first step") != NULL);
    droplet_windshield_delete(windshield);
}

static DropletLiquid2dFigures figures_of(const DropletLiquid2d* liquid)
{
    DropletLiquid2dFigures figures = {0};
    HOLDS(droplet_liquid2d_figures(liquid, &figures) == DROPLET_OK);
    return figures;
}

// Area within the outlines of a layer, holes taken off.
static double area_of(DropletLiquid2d* liquid, int32_t layer)
{
    DropletOutlines outlines;
    HOLDS(droplet_liquid2d_outlines(liquid, &outlines) == DROPLET_OK);
    const float* p = outlines.points;
    double area = 0.0;
    for (size_t k = 0; k < outlines.count; ++k) {
        const size_t n = outlines.list[k].points;
        HOLDS(n >= 3);
        for (size_t i = 0; i < n && outlines.list[k].layer == layer; ++i) {
            const float* a = p + 2 * i;
            const float* b = p + 2 * ((i + 1) % n);
            area += 0.5 * ((double)a[0] * b[1] - (double)a[1] * b[0]);
        }
        p += 2 * n;
    }
    return area;
}

static void advance(DropletLiquid2d* liquid, int frames)
{
    for (int k = 0; k < frames; ++k) {
        HOLDS(droplet_liquid2d_advance(liquid, 1.0 / 24.0) == DROPLET_OK);
    }
}

// An empty basin is filled by what is poured, a stirrer moves it, and outlines enclose its area.
static void liquids(void)
{
    DropletLiquid2d* liquid = NULL;
    const DropletLiquid2dScene unknown = {"lake", 1000, NULL};
    HOLDS(droplet_liquid2d_new(&unknown, &liquid) == DROPLET_INVALID_ARGUMENT && liquid == NULL);
    HOLDS(strstr(droplet_message(), "basin") != NULL);  // the message lists all names
    const DropletLiquid2dScene few = {NULL, 10, NULL};
    HOLDS(droplet_liquid2d_new(&few, &liquid) == DROPLET_INVALID_ARGUMENT && liquid == NULL);
    const DropletLiquid2dScene scene = {"basin", 2000, "realistic"};
    HOLDS(droplet_liquid2d_new(&scene, &liquid) == DROPLET_OK);
    HOLDS(figures_of(liquid).particles == 0 && area_of(liquid, DROPLET_LIQUID) == 0.0);
    HOLDS(area_of(liquid, DROPLET_WALL) > 0.0);
    advance(liquid, 1);  // nothing at all

    const double spacing = figures_of(liquid).spacing;
    const DropletPour pour = {2.0, 1.5, 0.3, 0.0, -1.0};
    HOLDS(droplet_liquid2d_pour(liquid, &pour) == DROPLET_OK);
    const DropletLiquid2dFigures first = figures_of(liquid);
    // As many as the disc holds, but for its rim.
    HOLDS(fabs((double)first.particles * spacing * spacing / (3.14159265 * 0.09) - 1.0) < 0.1);
    HOLDS(fabs(first.mean_speed - 1.0) < 1e-12);
    HOLDS(droplet_liquid2d_pour(liquid, &pour) == DROPLET_OK);
    HOLDS(figures_of(liquid).particles == first.particles);  // the place is taken
    const DropletPour below = {2.0, -0.1, 0.05, 0.0, 0.0};
    HOLDS(droplet_liquid2d_pour(liquid, &below) == DROPLET_OK);
    HOLDS(figures_of(liquid).particles == first.particles);  // the floor's, too
    for (int frame = 0; frame < 200; ++frame) {
        HOLDS(droplet_liquid2d_pour(liquid, &pour) == DROPLET_OK);
        advance(liquid, 1);
    }
    const DropletLiquid2dFigures full = figures_of(liquid);
    HOLDS(full.particles > 3 * first.particles && full.particles <= 6000);
    advance(liquid, 72);
    const double area = area_of(liquid, DROPLET_LIQUID) + area_of(liquid, DROPLET_DROPLETS);
    HOLDS(fabs(area / ((double)full.particles * spacing * spacing) - 1.0) < 0.05);

    const char* svg = NULL;
    HOLDS(droplet_liquid2d_svg(liquid, "comic", 800, &svg) == DROPLET_OK);
    HOLDS(strstr(svg, "<g id=\"liquid\"><path") != NULL && strstr(svg, "<g id=\"walls\">") != NULL);
    HOLDS(droplet_liquid2d_svg(liquid, "oil", 800, &svg) == DROPLET_INVALID_ARGUMENT);
    HOLDS(droplet_liquid2d_svg(liquid, NULL, 8, &svg) == DROPLET_INVALID_ARGUMENT);

    const char* lottie = NULL;
    HOLDS(droplet_liquid2d_keep(liquid) == DROPLET_INVALID_ARGUMENT);
    HOLDS(droplet_liquid2d_lottie(liquid, &lottie) == DROPLET_INVALID_ARGUMENT);
    HOLDS(droplet_liquid2d_record(liquid, "comic", 640, 0.5) == DROPLET_INVALID_ARGUMENT);
    HOLDS(droplet_liquid2d_record(liquid, "comic", 640, 24.0) == DROPLET_OK);
    for (int frame = 0; frame < 3; ++frame) {
        HOLDS(droplet_liquid2d_keep(liquid) == DROPLET_OK);
    }
    HOLDS(droplet_liquid2d_lottie(liquid, &lottie) == DROPLET_OK);
    HOLDS(strstr(lottie, "\"fr\":24") != NULL && strstr(lottie, "\"op\":3,") != NULL &&
          strstr(lottie, "\"w\":640,") != NULL);
    HOLDS(strstr(lottie, "\"ty\":\"sh\"") != NULL);
    // Begun again, it is without frames.
    HOLDS(droplet_liquid2d_record(liquid, NULL, 640, 24.0) == DROPLET_OK);
    HOLDS(droplet_liquid2d_lottie(liquid, &lottie) == DROPLET_OK);
    HOLDS(strstr(lottie, "\"op\":0,") != NULL && strstr(lottie, "\"ty\":\"sh\"") == NULL);

    DropletLiquidLook look;
    HOLDS(droplet_liquid2d_look("ink", &look) == DROPLET_OK);
    HOLDS(look.water == 0xFFFFFF && look.foam == DROPLET_NO_COLOUR && look.line == 0x141418 && look.line_width == 2.0);
    HOLDS(droplet_liquid2d_look("oil", &look) == DROPLET_INVALID_ARGUMENT);

    double value = 0.0;
    HOLDS(droplet_liquid2d_set(liquid, "gravity", 0.0) == DROPLET_OK);
    HOLDS(droplet_liquid2d_get(liquid, "gravity", &value) == DROPLET_OK && value == 0.0);
    HOLDS(droplet_liquid2d_set(liquid, "gravity", NAN) == DROPLET_INVALID_ARGUMENT);
    HOLDS(droplet_liquid2d_set(liquid, "surface-tension", -1.0) == DROPLET_INVALID_ARGUMENT);
    HOLDS(droplet_liquid2d_set(liquid, "nothing", 1.0) == DROPLET_INVALID_ARGUMENT);
    HOLDS(droplet_liquid2d_style(liquid, "wave") == DROPLET_OK);
    HOLDS(droplet_liquid2d_style(liquid, "oil") == DROPLET_INVALID_ARGUMENT);
    advance(liquid, 2);
    HOLDS(area_of(liquid, DROPLET_LIQUID) > 0.5 * area);
    HOLDS(droplet_liquid2d_advance(liquid, 0.0) == DROPLET_INVALID_ARGUMENT);
    HOLDS(droplet_liquid2d_pour(liquid, NULL) == DROPLET_INVALID_ARGUMENT);
    const DropletStir still = {1.0, 0.2, 1.2, 0.2, 0.3, 0.0};
    HOLDS(droplet_liquid2d_stir(liquid, &still) == DROPLET_INVALID_ARGUMENT);
    droplet_liquid2d_delete(liquid);
    droplet_liquid2d_delete(NULL);

    // A stirrer moves a pool at rest.
    const DropletLiquid2dScene pool = {"splash", 3000, NULL};
    HOLDS(droplet_liquid2d_new(&pool, &liquid) == DROPLET_OK);
    const double calm = figures_of(liquid).mean_speed;
    const DropletStir stir = {0.8, 0.35, 1.0, 0.35, 0.3, 1.0 / 24.0};
    HOLDS(droplet_liquid2d_stir(liquid, &stir) == DROPLET_OK);
    HOLDS(figures_of(liquid).mean_speed > calm + 0.1);
    advance(liquid, 1);
    HOLDS(figures_of(liquid).mean_speed > calm + 0.1);
    droplet_liquid2d_delete(liquid);

    // Each preset has about the particles that were asked for, once its jet has ended.
    const char* const presets[] = {"splash", "wave", "dam"};
    for (int k = 0; k < 3; ++k) {
        const DropletLiquid2dScene wanted = {presets[k], 3000, NULL};
        HOLDS(droplet_liquid2d_new(&wanted, &liquid) == DROPLET_OK);
        HOLDS(fabs((double)figures_of(liquid).particles / 3000.0 - 1.0) < 0.05);
        droplet_liquid2d_delete(liquid);
    }
}

int main(int argc, char** argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: interface_test FOLDER PICTURE\n");
        return 1;
    }
    HOLDS(strcmp(droplet_message(), "") == 0);
    HOLDS(strchr(droplet_version(), '.') != NULL);
    shapes(argv[1], argv[2]);
    rain();
    surfaces();
    liquids();
    return failures;
}

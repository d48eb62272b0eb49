/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef DROPLET_C_DROPLET_H
#define DROPLET_C_DROPLET_H

/* The library for programs that are not written in C++: droplets of footprints, and rain on a windshield as it falls.
 *
 * Objects are opaque, one owner each, and belong to one thread at a time; different objects may be used by different
 * threads. All quantities are in SI units. Functions that can fail return a code; droplet_message() then has one line
 * that names the argument, its value and what is allowed. They change nothing if they fail.
 *
 * This interface only grows within a major version: names, numbers and the meaning of arguments stay.
 */

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#define DROPLET_API __declspec(dllexport)
#elif defined(__EMSCRIPTEN__)
#define DROPLET_API __attribute__((used, visibility("default")))
#else
#define DROPLET_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** What a function returns. */
typedef enum DropletCode {
    DROPLET_OK = 0,               /**< done */
    DROPLET_INTERNAL = 1,         /**< a defect of the library */
    DROPLET_INVALID_ARGUMENT = 2, /**< an argument is outside its documented range */
    DROPLET_INVALID_INPUT = 3,    /**< a file cannot be read, or holds no liquid */
    DROPLET_OUTPUT_FAILED = 4,    /**< a file cannot be written completely */
    DROPLET_NO_SUCH_DROPLET = 5,  /**< the requested droplet does not exist, or the solver failed */
    DROPLET_OUT_OF_MEMORY = 6     /**< there is not enough memory */
} DropletCode;

/** Why the last function that failed on this thread failed: one line of UTF-8 without its end. It stays until the next
 * failure on this thread; empty before the first. */
DROPLET_API const char* droplet_message(void);

/** Version of the library, such as "0.1.0". */
DROPLET_API const char* droplet_version(void);

/* ---- Rain on a windshield ----
 *
 * Positions are on the unrolled glass, as the driver sees it from inside: x from 0 at the left edge to the width, y from
 * 0 at the lower edge to the height [m]. */

/** Rain on a windshield: glass, parameters, state and maps. */
typedef struct DropletWindshield DropletWindshield;

/** Makes a dry glass at time 0.
 * @param preset  name of a figure of the thesis: "figure-3.10", "figure-3.11" or "figure-3.12"; NULL: figure-3.12
 * @param made    receives the windshield; end it by droplet_windshield_delete() */
DROPLET_API DropletCode droplet_windshield_new(const char* preset, DropletWindshield** made);

/** Ends a windshield. @param windshield  or NULL */
DROPLET_API void droplet_windshield_delete(DropletWindshield* windshield);

/** Sets a parameter; at any time, but for those of the glass, which must be set before the first step.
 *
 * | name | unit | range | of |
 * | --- | --- | --- | --- |
 * | speed | m/s | 0 to 150 | the car in still air; a change is an acceleration, which droplets feel |
 * | rain | m/s | 0 to 1000 mm/h | rainfall: 1 mm/h is 2.778e-7 m/s |
 * | noise | m/s² | 0 to 1000 | the car's vibration, root mean square |
 * | wiper-period | s | 1.2 to 60, or 0 | two wipers; 0: none. Blades that sweep end their stroke |
 * | seed | 1 | 0 to 2^53 | random numbers |
 * | gravity | m/s² | 0 to 1000 | gravity |
 * | contact-angle | rad | 1 to 179 degrees | the coating |
 * | hysteresis | 1 | 0 to 2 | the coating: cosine of the receding minus cosine of the advancing angle |
 * | kinetic-fraction | 1 | 0 to 1 | friction of a moving droplet over what holds it at rest |
 * | viscosity-factor | Pa s | 0 to 1e6 | what slows a moving droplet down |
 * | film | m | 0 to 1 mm | water that running droplets leave behind |
 * | still-diameter | m | 0.11 to 2 mm | smaller raindrops never move |
 * | mist | m/s | 0 to 1e-6 | growth of the mist's thickness on cold glass |
 * | glass-width | m | 0.05 to 5 | glass |
 * | glass-height | m | 0.05 to 5 | glass |
 * | glass-radius | m | 0.1 to 1e6 | glass, bend across |
 * | slope | rad | 0 to 90 degrees | glass, from horizontal */
DROPLET_API DropletCode droplet_windshield_set(DropletWindshield* windshield, const char* name, double value);

/** Value of a parameter of droplet_windshield_set(). @param value  receives it */
DROPLET_API DropletCode droplet_windshield_get(const DropletWindshield* windshield, const char* name, double* value);

/** Advances the rain: it arrives, droplets run, meet and break up, wipers sweep.
 * @param seconds  > 0; at most 1/30 is advised */
DROPLET_API DropletCode droplet_windshield_advance(DropletWindshield* windshield, double seconds);

/** Sprays water onto a place, as droplets of random sizes.
 * @param x,y     middle
 * @param radius  of the place, > 0
 * @param volume  of the water, from 0 to 1e-3 m³ */
DROPLET_API DropletCode droplet_windshield_spray(DropletWindshield* windshield, double x, double y, double radius,
                                                 double volume);

/** Moves a finger over the glass: it takes mist and droplets along and leaves their water as beads beside its path.
 * @param from_x,from_y  where it was
 * @param to_x,to_y      where it is
 * @param width          of the finger, from 1 mm to 0.2 m */
DROPLET_API DropletCode droplet_windshield_finger(DropletWindshield* windshield, double from_x, double from_y,
                                                  double to_x, double to_y, double width);

/** What a windshield looks like in numbers. */
typedef struct DropletWindshieldFigures {
    double time;           /**< [s] */
    double width;          /**< of the unrolled glass [m] */
    double height;         /**< of the unrolled glass [m] */
    uint64_t running;      /**< droplets that are large enough to run */
    uint64_t still;        /**< droplets that are not */
    uint64_t raindrops;    /**< that have met the glass */
    double water;          /**< on the glass [m³] */
    double balance_error;  /**< water that appeared or vanished, over all that has come [1] */
} DropletWindshieldFigures;

/** Figures of the state. @param figures  receives them */
DROPLET_API DropletCode droplet_windshield_figures(const DropletWindshield* windshield,
                                                   DropletWindshieldFigures* figures);

/** Droplet that is large enough to run. */
typedef struct DropletRunning {
    uint64_t id;     /**< stays with the droplet */
    double x, y;     /**< centre [m] */
    double vx, vy;   /**< velocity [m/s]; exactly 0 at rest */
    double volume;   /**< [m³] */
    double radius;   /**< of the cap's contact circle [m] */
} DropletRunning;

/** Droplets that are large enough to run, in the order of their ids.
 * @param droplets  receives at most `room` droplets; NULL if room is 0
 * @return          number of all such droplets */
DROPLET_API size_t droplet_windshield_running(const DropletWindshield* windshield, DropletRunning* droplets,
                                              size_t room);

/** Place on the glass in the vehicle's frame: x to the driver's right, y ahead, z up; the origin is the middle of the
 * lower edge. */
typedef struct DropletPlace {
    double point[3];  /**< [m] */
    double normal[3]; /**< outward, of length 1 */
    double across[3]; /**< tangent along x, of length 1 */
    double up[3];     /**< tangent along y, of length 1 */
} DropletPlace;

/** Place of a position on the glass. @param place  receives it */
DROPLET_API DropletCode droplet_windshield_place(const DropletWindshield* windshield, double x, double y,
                                                 DropletPlace* place);

/** A wiper's blade. */
typedef struct DropletBlade {
    double x1, y1;  /**< inner end [m]; may lie beside the glass */
    double x2, y2;  /**< outer end [m] */
} DropletBlade;

/** Blades where they are now.
 * @param blades  receives at most `room` blades; NULL if room is 0
 * @return        number of all blades */
DROPLET_API size_t droplet_windshield_blades(const DropletWindshield* windshield, DropletBlade* blades, size_t room);

/** Part of a map [px]. */
typedef struct DropletTile {
    int32_t x;      /**< of its left edge */
    int32_t y;      /**< of its upper edge */
    int32_t width;  /**< at most 32 */
    int32_t height; /**< at most 32 */
} DropletTile;

/** Size of the maps of a width; see droplet_windshield_draw().
 * @param width   [px], 16 to 8192
 * @param height  receives the height [px]: pixels are nearly square */
DROPLET_API DropletCode droplet_windshield_map_height(const DropletWindshield* windshield, int32_t width,
                                                      int32_t* height);

/** Brings a texture up to the state: writes the pixels that changed since the last call. Its left edge is left, its upper
 * edge up, as the driver sees the glass.
 *
 * A pixel has four half floats (IEEE 754 binary16: GL_RGBA16F, VK_FORMAT_R16G16B16A16_SFLOAT): x and y of the water's
 * outward unit normal, to the driver's right and up the glass, both times the wetness; the mean thickness of the water
 * [mm]; the wetness, the share that water covers, above 1 where droplets overlap. Bare glass is 0. All are means over
 * the pixel, so that they may be interpolated; over the wetness the first two are the normal of the water alone.
 *
 * @param pixels  width · height · 4 numbers, row by row from the upper left, as the last call left them; all 0 before
 *                the first call and after another width
 * @param width   [px], as in droplet_windshield_map_height()
 * @param tiles   receives where the tiles that were written are listed; they stay until the next call
 * @param count   receives the number of tiles */
DROPLET_API DropletCode droplet_windshield_draw(DropletWindshield* windshield, uint16_t* pixels, int32_t width,
                                                const DropletTile** tiles, size_t* count);

/** The mist on the glass as a texture: each pixel a byte, 0 where the glass is clear, 255 where the mist is as dense as
 * it becomes. Rows begin with the upper one.
 * @param width   receives the width [px]
 * @param height  receives the height [px]
 * @param pixels  receives where they are; they stay until the next call */
DROPLET_API DropletCode droplet_windshield_mist(DropletWindshield* windshield, int32_t* width, int32_t* height,
                                                const uint8_t** pixels);

#ifdef __cplusplus
}
#endif

#endif

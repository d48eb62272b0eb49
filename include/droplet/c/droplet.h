// SPDX-License-Identifier: GPL-3.0-or-later
// The library for programs that are not written in C++: droplets of footprints, rain on a windshield as it falls, and
// 2D liquids.
//
// Objects are opaque. Each belongs to one thread at a time; different ones may be used by different threads. All
// quantities are in SI units, texts are UTF-8. Functions that can fail return a code, and droplet_message() has one
// line that names the argument, its value and what is allowed. A function that fails changes nothing.
// NOLINTBEGIN(*): the names and types are those of C
#ifndef DROPLET_C_DROPLET_H
#define DROPLET_C_DROPLET_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(DROPLET_C_BUILD)
#define DROPLET_API __declspec(dllexport)
#elif defined(_WIN32)
#define DROPLET_API __declspec(dllimport)
#elif defined(__EMSCRIPTEN__)
#define DROPLET_API __attribute__((used, visibility("default")))
#else
/// Marks the functions of the interface.
#define DROPLET_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// What a function returns; the numbers stay.
typedef enum DropletCode {
    DROPLET_OK = 0,                ///< done
    DROPLET_INTERNAL = 1,          ///< a defect of the library
    DROPLET_INVALID_ARGUMENT = 2,  ///< an argument is outside its documented range
    DROPLET_INVALID_INPUT = 3,     ///< the footprint cannot be read, or holds no liquid
    DROPLET_OUTPUT_FAILED = 4,     ///< a file cannot be written completely
    DROPLET_NO_SUCH_DROPLET = 5,   ///< the requested droplet does not exist, or the solver failed
    DROPLET_OUT_OF_MEMORY = 6      ///< there is not enough memory
} DropletCode;

/// Why the last function that failed on this thread failed: one line without its end. It stays until the next failure
/// on this thread; empty before the first.
DROPLET_API const char* droplet_message(void);

/// Version of the library, such as "0.30.0".
DROPLET_API const char* droplet_version(void);

// ---- Droplets of footprints ----

/// Droplets of one footprint.
typedef struct DropletShape DropletShape;

/// Makes the droplets of a picture's file.
/// @param path     of a picture or drawing
/// @param options  words of the command line of `droplet-shape`, such as "--volume" and "20uL"; NULL if count is 0
/// @param count    number of words
/// @param made     receives the droplets; droplet_shape_delete() ends them
/// @return         DROPLET_INVALID_ARGUMENT, also for options of files that the command writes; DROPLET_INVALID_INPUT;
///                 DROPLET_NO_SUCH_DROPLET
DROPLET_API DropletCode droplet_shape_of_file(const char* path, const char* const* options, size_t count,
                                              DropletShape** made);

/// Coverage of pixels by liquid.
typedef struct DropletMask {
    const uint8_t* coverage;  ///< 0 dry to 255 liquid, row by row from the upper left
    int32_t width;            ///< [px], > 0
    int32_t height;           ///< [px], > 0
} DropletMask;

/// Makes the droplets of a mask in memory.
/// @param mask     is copied
/// @param options  as in droplet_shape_of_file()
/// @param count    number of words
/// @param made     receives the droplets; droplet_shape_delete() ends them
/// @return         as droplet_shape_of_file()
DROPLET_API DropletCode droplet_shape_of_mask(const DropletMask* mask, const char* const* options, size_t count,
                                              DropletShape** made);

/// Ends droplets, and with them all arrays and texts that they gave.
/// @param shape  or NULL
DROPLET_API void droplet_shape_delete(DropletShape* shape);

/// Triangles of droplets: closed unless the options say `--open`, counter-clockwise seen from outside. The ground is at
/// z = 0, z points up.
typedef struct DropletMesh {
    size_t vertices;              ///< number of vertices
    const float* positions;       ///< three for each vertex [m]
    const float* normals;         ///< three for each vertex: outward, of length 1
    const float* uvs;             ///< two for each vertex: place in the picture, from its upper left
    const float* contact_angles;  ///< one for each vertex: at the rim [rad], elsewhere 0; NULL if they are unknown
    size_t triangles;             ///< number of triangles
    const uint32_t* indices;      ///< three vertices for each triangle
} DropletMesh;

/// The mesh.
/// @param shape  valid
/// @param mesh   receives arrays that stay until the droplets are ended
DROPLET_API DropletCode droplet_shape_mesh(const DropletShape* shape, DropletMesh* mesh);

/// The report: options, results and warnings, as `--json` writes them, without a file's path and size.
/// @param shape  valid
/// @param json   receives a text that stays until the droplets are ended
DROPLET_API DropletCode droplet_shape_report(const DropletShape* shape, const char** json);

/// Writes a file, completely or not at all. With --onto, a .glb, .gltf, .usda or .usdz has the object, too, unless
/// --droplets-only is among the options.
/// @param shape  valid
/// @param path   ends in .glb, .gltf, .obj, .ply, .stl, .usda, .usdz or .3mf
/// @return      DROPLET_INVALID_ARGUMENT, DROPLET_OUTPUT_FAILED
DROPLET_API DropletCode droplet_shape_write(const DropletShape* shape, const char* path);

// ---- Rain on a windshield ----
//
// Positions are on the unrolled glass, as the driver sees it from inside: x from 0 at the left edge to the width, y
// from 0 at the lower edge to the height [m].

/// Rain on a windshield: glass, parameters, state and maps.
typedef struct DropletWindshield DropletWindshield;

/// Makes a dry glass at time 0.
/// @param preset  name of a figure of the thesis: "figure-3.10", "figure-3.11" or "figure-3.12"; NULL: figure-3.12
/// @param made    receives the windshield; droplet_windshield_delete() ends it
DROPLET_API DropletCode droplet_windshield_new(const char* preset, DropletWindshield** made);

/// Ends a windshield.
/// @param windshield  or NULL
DROPLET_API void droplet_windshield_delete(DropletWindshield* windshield);

/// Sets a parameter, at any time; those of the glass only before the first step.
///
/// | name | unit | range | of |
/// | --- | --- | --- | --- |
/// | speed | m/s | 0 to 150 | the car in still air; from the first step on it is reached at 12 m/s² at most |
/// | rain | m/s | 0 to 1000 mm/h | rainfall: 1 mm/h is 2.778e-7 m/s |
/// | noise | m/s² | 0 to 1000 | vibration of the car, root mean square |
/// | wiper-period | s | 1.2 to 60, or 0 | two wipers; 0: none. A stroke that has begun ends |
/// | seed | 1 | 0 to 2^53 | random numbers; only before the first step |
/// | gravity | m/s² | 0 to 1000 | gravity |
/// | contact-angle | rad | 1 to 179 degrees | the coating |
/// | hysteresis | 1 | 0 to 2 | the coating: cosine of the receding minus cosine of the advancing angle |
/// | kinetic-fraction | 1 | 0 to 1 | friction of a moving droplet over what holds it at rest |
/// | viscosity-factor | Pa s | at least 0 | what slows a moving droplet down |
/// | film | m | at least 0 | thickness of the water that running droplets leave behind |
/// | still-diameter | m | 0 to 2 mm | smaller raindrops never move |
/// | runoff | s | 0 to 10 | time after which a film of heavy rain breaks up without more rain; 0: there is none |
/// | mist | m/s | 0 to 1e-6 | growth of the mist's thickness, which ends at 10 µm |
/// | splashes | 1 | 0 or 1 | 1: maps have the rings of large raindrops that have just hit |
/// | glass-width | m | 0.05 to 5 | a glass that is no mesh |
/// | glass-height | m | 0.05 to 5 | the glass |
/// | glass-radius | m | 0.1 to 1e6 | the glass, bend across |
/// | slope | rad | 0 to 90 degrees | the glass, from horizontal |
/// @param windshield  valid
/// @param name        in the table
/// @param value       in the table
DROPLET_API DropletCode droplet_windshield_set(DropletWindshield* windshield, const char* name, double value);

/// Value of a parameter of droplet_windshield_set().
/// @param windshield  valid
/// @param name        in its table
/// @param value       receives the value
DROPLET_API DropletCode droplet_windshield_get(const DropletWindshield* windshield, const char* name, double* value);

/// Gives a windshield the shape of a mesh, before the first step; it then has none of the parameters of the glass. Its
/// uv times one scale are the unrolled glass: v runs down the glass, u to the driver's right or left.
/// @param windshield  valid
/// @param mesh        z points up, the front is -y, normals are outward; contact_angles are not read
/// @return            DROPLET_INVALID_ARGUMENT; DROPLET_INVALID_INPUT: no triangle has an area both in space and in uv
DROPLET_API DropletCode droplet_windshield_surface(DropletWindshield* windshield, const DropletMesh* mesh);

/// Advances the rain: it arrives, droplets run, meet and break up, wipers sweep.
/// @param windshield  valid
/// @param seconds     > 0; at most 1/30 is advised
DROPLET_API DropletCode droplet_windshield_advance(DropletWindshield* windshield, double seconds);

/// Water from a sprayer.
typedef struct DropletSpray {
    double x;       ///< middle [m]
    double y;       ///< middle [m]
    double radius;  ///< deviation of the droplets' places is half of it [m], > 0
    double volume;  ///< of all droplets [m³], from 0 to 1e-3
} DropletSpray;

/// Sprays water, as droplets with diameters from 0.3 to 2 mm, which meet the glass in the next step.
/// @param windshield  valid
/// @param spray       place and amount
DROPLET_API DropletCode droplet_windshield_spray(DropletWindshield* windshield, const DropletSpray* spray);

/// Straight movement of a finger over the glass.
typedef struct DropletStroke {
    double from_x;  ///< where it was [m]
    double from_y;  ///< where it was [m]
    double to_x;    ///< where it is [m]
    double to_y;    ///< where it is [m]
    double width;   ///< of the finger [m], from 1 mm to 0.2 m
} DropletStroke;

/// Moves a finger: it takes mist and droplets along and leaves their water as beads beside its path and ahead of it,
/// which meet the glass in the next step.
/// @param windshield  valid
/// @param stroke      of the finger
DROPLET_API DropletCode droplet_windshield_finger(DropletWindshield* windshield, const DropletStroke* stroke);

/// Figures of a windshield.
typedef struct DropletWindshieldFigures {
    double time;         ///< since the start [s]
    double speed;        ///< of the car now [m/s]
    double width;        ///< of the unrolled glass [m]
    double height;       ///< of the unrolled glass [m]
    uint64_t running;    ///< number of droplets that are large enough to run
    uint64_t still;      ///< number of droplets that are not
    uint64_t raindrops;  ///< number of raindrops that have met the glass
} DropletWindshieldFigures;

/// Figures of the state.
/// @param windshield  valid
/// @param figures     receives them
DROPLET_API DropletCode droplet_windshield_figures(const DropletWindshield* windshield,
                                                   DropletWindshieldFigures* figures);

/// Water of a windshield.
typedef struct DropletWater {
    double volume;         ///< on the glass [m³]
    double balance_error;  ///< water that appeared or vanished, over all that has come
} DropletWater;

/// Water of the state. All droplets are summed up, which takes milliseconds if there are many.
/// @param windshield  valid
/// @param water       receives it
DROPLET_API DropletCode droplet_windshield_water(const DropletWindshield* windshield, DropletWater* water);

/// Droplet that is large enough to run.
typedef struct DropletRunning {
    uint64_t id;    ///< stays with the droplet
    double x;       ///< of its centre [m]
    double y;       ///< of its centre [m]
    double vx;      ///< velocity across [m/s]; exactly 0 at rest
    double vy;      ///< velocity up the glass [m/s]; exactly 0 at rest
    double volume;  ///< [m³]
    double radius;  ///< of the contact circle [m]
} DropletRunning;

/// Droplets that are large enough to run, in the order of their ids.
/// @param windshield  valid
/// @param droplets    receives at most `room` of them; NULL if room is 0
/// @param room        length of the array
/// @return          number of all such droplets
DROPLET_API size_t droplet_windshield_running(const DropletWindshield* windshield, DropletRunning* droplets,
                                              size_t room);

/// Place on the glass in the vehicle's frame: x to the driver's right, y ahead, z up; the origin is the middle of the
/// lower edge.
typedef struct DropletPlace {
    double point[3];   ///< [m]
    double normal[3];  ///< outward, of length 1
    double across[3];  ///< tangent along x, of length 1
    double up[3];      ///< tangent along y, of length 1
} DropletPlace;

/// Place of a position on the glass.
/// @param windshield  valid
/// @param x           [m]
/// @param y           [m]
/// @param place       receives it
/// @return            DROPLET_INVALID_ARGUMENT: there is no glass
DROPLET_API DropletCode droplet_windshield_place(const DropletWindshield* windshield, double x, double y,
                                                 DropletPlace* place);

/// Corner of a triangle of the glass.
typedef struct DropletCorner {
    double x;            ///< on the unrolled glass [m]
    double y;            ///< on the unrolled glass [m]
    DropletPlace place;  ///< in space
} DropletCorner;

/// Triangles of the glass.
typedef struct DropletTriangles {
    const DropletCorner* corners;  ///< three for each triangle, counter-clockwise on the unrolled glass; stays until
                                   ///< the next call
    size_t count;                  ///< number of triangles
} DropletTriangles;

/// Triangles of the glass, for drawing.
/// @param windshield  valid
/// @param triangles   receives them
DROPLET_API DropletCode droplet_windshield_triangles(DropletWindshield* windshield, DropletTriangles* triangles);

/// A wiper's blade; it may reach beyond the glass.
typedef struct DropletBlade {
    double inner_x;  ///< end near the pivot [m]
    double inner_y;  ///< end near the pivot [m]
    double outer_x;  ///< other end [m]
    double outer_y;  ///< other end [m]
    double pivot_x;  ///< about which it turns [m]
    double pivot_y;  ///< about which it turns [m]
    double first;    ///< angle at rest, from the glass's x towards its y [rad]
    double last;     ///< angle at the turn [rad]
} DropletBlade;

/// Blades where they are now.
/// @param windshield  valid
/// @param blades      receives at most `room` of them; NULL if room is 0
/// @param room        length of the array
/// @return        number of all blades
DROPLET_API size_t droplet_windshield_blades(const DropletWindshield* windshield, DropletBlade* blades, size_t room);

/// Part of a map.
typedef struct DropletTile {
    int32_t x;       ///< of its left edge [px]
    int32_t y;       ///< of its upper edge [px]
    int32_t width;   ///< at most 32 [px]
    int32_t height;  ///< at most 32 [px]
} DropletTile;

/// Height of maps.
/// @param windshield  valid
/// @param width       [px], 16 to 8192
/// @param height      receives the height [px]; pixels are nearly square
DROPLET_API DropletCode droplet_windshield_map_height(DropletWindshield* windshield, int32_t width, int32_t* height);

/// Tiles that were drawn.
typedef struct DropletTiles {
    const DropletTile* list;  ///< stays until the next drawing
    size_t count;             ///< number of tiles
} DropletTiles;

/// Brings a texture up to the state: writes the pixels that changed since the last call; all at the first one, and
/// after the width or the contact angle has changed. Its left edge is left, its upper edge up, as the driver sees the
/// glass.
///
/// A pixel has four half floats (IEEE 754 binary16: GL_RGBA16F): x and y of the water's outward unit normal, to the
/// driver's right and up the glass, both times the wetness; the mean thickness of the water [mm]; and the wetness, the
/// share that water covers, above 1 where droplets overlap. Bare glass is 0. All are means over the pixel, so that they
/// may be interpolated; over the wetness the first two are the normal of the water alone.
/// @param windshield  valid
/// @param width       [px], as in droplet_windshield_map_height()
/// @param pixels      width · height · 4 numbers, row by row from the upper left, as the last call left them
/// @param tiles       receives the tiles with pixels that were written
DROPLET_API DropletCode droplet_windshield_draw(DropletWindshield* windshield, int32_t width, uint16_t* pixels,
                                                DropletTiles* tiles);

/// The mist as a texture.
typedef struct DropletMistMap {
    const uint8_t* pixels;  ///< 0 where the glass is clear to 255 where mist is densest, row by row from the upper
                            ///< left; stays until the next call
    int32_t width;          ///< [px]; 1 if there is no mist
    int32_t height;         ///< [px]; 1 if there is no mist
    double right;           ///< where its right edge is, over the glass's width: 1 or a little more
    double top;             ///< where its upper edge is, over the glass's height: 1 or a little more
} DropletMistMap;

/// Brings the texture of the mist up to the state.
/// @param windshield  valid
/// @param map         receives it
DROPLET_API DropletCode droplet_windshield_mist(DropletWindshield* windshield, DropletMistMap* map);

/// Thickness of the film in a level of its texture [m].
#define DROPLET_RUNOFF_LEVEL 2e-6

/// Brings the texture of the film that runs off up to the state: 0 is dry, 255 is 0.51 mm or more.
/// @param windshield  valid
/// @param map         receives it, as that of the mist
DROPLET_API DropletCode droplet_windshield_runoff(DropletWindshield* windshield, DropletMistMap* map);

/// Way that small waves have run over the film since the start, for shaders that draw them [m].
/// @param windshield  valid
/// @param drift       receives x and y, up positive
DROPLET_API DropletCode droplet_windshield_runoff_drift(const DropletWindshield* windshield, double drift[2]);

// ---- 2D liquids ----
//
// Positions are in the window: x from 0 at the left edge to the width, y from 0 at the lower edge to the height [m].

/// A liquid in the plane: scene, state and outlines.
typedef struct DropletLiquid2d DropletLiquid2d;

/// What a liquid starts from.
typedef struct DropletLiquid2dScene {
    const char* preset;  ///< "splash", "wave", "dam", "pour" or "basin", which is empty; NULL: splash
    uint64_t particles;  ///< of the liquid, about, 100 to 1e6; in an empty basin these fill half of it
    const char* style;   ///< "realistic", "cartoon", "wave" or "paper"; NULL: what suits the preset
} DropletLiquid2dScene;

/// Makes a liquid at time 0.
/// @param scene  what it starts from
/// @param made   receives the liquid; droplet_liquid2d_delete() ends it
DROPLET_API DropletCode droplet_liquid2d_new(const DropletLiquid2dScene* scene, DropletLiquid2d** made);

/// Ends a liquid, and with it all arrays and texts that it gave.
/// @param liquid  or NULL
DROPLET_API void droplet_liquid2d_delete(DropletLiquid2d* liquid);

/// Sets a parameter, at any time.
///
/// | name | unit | range | of |
/// | --- | --- | --- | --- |
/// | gravity | m/s² | -100 to 100 | gravity, downwards |
/// | surface-tension | N/m | 0 to 100 | the liquid, whose density is 1000 kg/m³ |
/// | viscosity | m²/s | 0 to 1 | the liquid, kinematic |
/// @param liquid  valid
/// @param name    in the table
/// @param value   in the table
DROPLET_API DropletCode droplet_liquid2d_set(DropletLiquid2d* liquid, const char* name, double value);

/// Value of a parameter of droplet_liquid2d_set().
/// @param liquid  valid
/// @param name    in its table
/// @param value   receives the value
DROPLET_API DropletCode droplet_liquid2d_get(const DropletLiquid2d* liquid, const char* name, double* value);

/// Sets the style of the outlines, at any time: droplets in flight have no tails until they have flown on.
/// @param liquid  valid
/// @param style   "realistic", "cartoon", "wave" or "paper"
DROPLET_API DropletCode droplet_liquid2d_style(DropletLiquid2d* liquid, const char* style);

/// Advances the liquid.
/// @param liquid   valid
/// @param seconds  > 0; at most 1/24 is advised
DROPLET_API DropletCode droplet_liquid2d_advance(DropletLiquid2d* liquid, double seconds);

/// Liquid that appears in a disc.
typedef struct DropletPour {
    double x;       ///< middle [m]
    double y;       ///< middle [m]
    double radius;  ///< [m], > 0
    double vx;      ///< velocity of the liquid across [m/s]
    double vy;      ///< velocity of the liquid upwards [m/s]
} DropletPour;

/// Adds liquid where a disc has room, until there are three times the particles that the scene asked for.
/// @param liquid  valid
/// @param pour    place and velocity
DROPLET_API DropletCode droplet_liquid2d_pour(DropletLiquid2d* liquid, const DropletPour* pour);

/// Straight movement of a round stirrer.
typedef struct DropletStir {
    double from_x;   ///< where its middle was [m]
    double from_y;   ///< where its middle was [m]
    double to_x;     ///< where its middle is [m]
    double to_y;     ///< where its middle is [m]
    double radius;   ///< [m], > 0
    double seconds;  ///< that the movement took, > 0
} DropletStir;

/// Gives liquid on the way of a stirrer its velocity: wholly in its middle, less towards its rim.
/// @param liquid  valid
/// @param stir    of the stirrer
DROPLET_API DropletCode droplet_liquid2d_stir(DropletLiquid2d* liquid, const DropletStir* stir);

/// Figures of a liquid.
typedef struct DropletLiquid2dFigures {
    double time;         ///< since the start [s]
    double width;        ///< of the window [m]
    double height;       ///< of the window [m]
    double spacing;      ///< of particles [m]; each stands for its square
    double mean_speed;   ///< of all particles [m/s]; 0 without any
    uint64_t particles;  ///< number of particles
} DropletLiquid2dFigures;

/// Figures of the state.
/// @param liquid   valid
/// @param figures  receives them
DROPLET_API DropletCode droplet_liquid2d_figures(const DropletLiquid2d* liquid, DropletLiquid2dFigures* figures);

/// What an outline bounds; the numbers stay.
typedef enum DropletLiquidLayer {
    DROPLET_LIQUID = 0,    ///< connected liquid; its holes run clockwise
    DROPLET_DROPLETS = 1,  ///< a small detached body
    DROPLET_FOAM = 2,      ///< air that is also a hole of the liquid
    DROPLET_WALL = 3       ///< a wall that is visible
} DropletLiquidLayer;

/// Closed polyline.
typedef struct DropletOutline {
    int32_t layer;    ///< of DropletLiquidLayer
    uint32_t points;  ///< number of its points; the first is not repeated at the end
} DropletOutline;

/// Outlines of a liquid.
typedef struct DropletOutlines {
    const DropletOutline* list;  ///< in the order of their points; stays until the next call
    size_t count;                ///< number of outlines
    const float* points;         ///< x and y of all points, outline by outline [m]; stays until the next call
} DropletOutlines;

/// Outlines of the state. Tails of droplets and air in crests come from the states at which this was called before:
/// call it once a frame.
/// @param liquid    valid
/// @param outlines  receives them
DROPLET_API DropletCode droplet_liquid2d_outlines(DropletLiquid2d* liquid, DropletOutlines* outlines);

/// Colours and lines of drawings. Colours are 0xRRGGBB, sRGB.
typedef struct DropletLiquidLook {
    uint32_t water;       ///< connected liquid
    uint32_t droplet;     ///< detached droplets
    uint32_t foam;        ///< foam, or DROPLET_NO_COLOUR: what is behind shows
    uint32_t line;        ///< outlines
    uint32_t wall;        ///< walls
    uint32_t background;  ///< what is behind, or DROPLET_NO_COLOUR: transparent
    double line_width;    ///< of outlines, in thousandths of the window's width; 0: none
} DropletLiquidLook;

/// No colour of a look.
#define DROPLET_NO_COLOUR 0xFFFFFFFFU

/// Colours and lines of a look.
/// @param name  "flat", "comic", "ink" or "night"
/// @param look  receives them
DROPLET_API DropletCode droplet_liquid2d_look(const char* name, DropletLiquidLook* look);

/// The outlines that droplet_liquid2d_outlines() gave last, as SVG: Bézier curves in groups named walls, liquid,
/// droplets and foam.
/// @param liquid  valid
/// @param look    colours and lines: "flat", "comic", "ink" or "night"; NULL: flat
/// @param width   [px], 16 to 16384
/// @param svg     receives a text that stays until the next call
DROPLET_API DropletCode droplet_liquid2d_svg(DropletLiquid2d* liquid, const char* look, int32_t width,
                                             const char** svg);

/// Begins an animation without frames, in place of one that was begun before.
/// @param liquid             valid
/// @param look               colours and lines: "flat", "comic", "ink" or "night"; NULL: flat
/// @param width              [px], 16 to 16384
/// @param frames_per_second  1 to 1000; of what is played, whatever the times between frames are
DROPLET_API DropletCode droplet_liquid2d_record(DropletLiquid2d* liquid, const char* look, int32_t width,
                                                double frames_per_second);

/// Adds the outlines that droplet_liquid2d_outlines() gave last as a frame of the animation. DROPLET_INVALID_ARGUMENT:
/// none was begun.
/// @param liquid  valid
DROPLET_API DropletCode droplet_liquid2d_keep(DropletLiquid2d* liquid);

/// The animation's frames so far, as a Lottie file. DROPLET_INVALID_ARGUMENT: none was begun.
/// @param liquid  valid
/// @param lottie  receives a text of JSON that stays until the next call
DROPLET_API DropletCode droplet_liquid2d_lottie(DropletLiquid2d* liquid, const char** lottie);

#ifdef __cplusplus
}
#endif

#endif
// NOLINTEND(*)

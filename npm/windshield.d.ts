// SPDX-License-Identifier: GPL-3.0-or-later
// Rain on a windshield as it falls. Numbers are in SI units, angles in radians. Positions are on the unrolled glass, as the
// driver sees it from inside: x from 0 at the left edge to the width, y from 0 at the lower edge to the height.

/** Parameters; those that are left out stay as they are. */
export interface WindshieldValues {
    /** Speed of the car in still air, 0 to 150 m/s; from the first step on it is reached at 12 m/s² at most */
    speed?: number;
    /** Rainfall [m/s]: 1 mm/h is 2.778e-7 */
    rain?: number;
    /** Vibration of the car, root mean square [m/s²] */
    noise?: number;
    /** Period of the wipers, 1.2 to 60 s; 0: none */
    wiperPeriod?: number;
    /** Random seed; only before the first step */
    seed?: number;
    /** Gravity [m/s²] */
    gravity?: number;
    /** Contact angle of the coating, 1 to 179 degrees, in radians */
    contactAngle?: number;
    /** Cosine of the receding minus cosine of the advancing angle, 0 to 2 */
    hysteresis?: number;
    /** Friction of a moving droplet over what holds it at rest, 0 to 1 */
    kineticFraction?: number;
    /** What slows a moving droplet down [Pa s] */
    viscosityFactor?: number;
    /** Thickness of the water that running droplets leave behind [m] */
    film?: number;
    /** Smaller raindrops never move, 0.11 to 2 mm, in metres */
    stillDiameter?: number;
    /** Time after which the film of heavy rain breaks up without more rain, 0 to 10 s; 0: there is none */
    runoff?: number;
    /** Growth of the mist's thickness [m/s], up to 1e-6; it ends at 10 µm */
    mist?: number;
    /** 1: maps have the rings of large raindrops that have just hit; 0: they have not */
    splashes?: number;
    /** Width of the glass along its bend, 0.05 to 5 m; as all of the glass, only before the first step */
    glassWidth?: number;
    /** Height of the glass along its slope, 0.05 to 5 m */
    glassHeight?: number;
    /** Radius of the bend across the car [m] */
    glassRadius?: number;
    /** Slope of the glass, from horizontal, 0 to 90 degrees, in radians */
    slope?: number;
}

/** Mesh of a glass: z points up, the front is −y, lengths are in metres. */
export interface GlassMesh {
    /** Three for each vertex [m] */
    positions: ArrayLike<number>;
    /** Three for each vertex: outward, of length 1 */
    normals: ArrayLike<number>;
    /**
     * Two for each vertex: v runs down the glass, u to the driver's right or left. Times one scale they roll the glass out flat.
     */
    uvs: ArrayLike<number>;
    /** Three vertices for each triangle */
    indices: ArrayLike<number>;
}

export interface WindshieldOptions extends WindshieldValues {
    /** Figure of the thesis whose values hold unless others are given [figure-3.12] */
    preset?: 'figure-3.10' | 'figure-3.11' | 'figure-3.12';
    /** Shape of the glass; without it, it is bent as a cylinder, and a mesh has no glassWidth, glassHeight, glassRadius or slope */
    surface?: GlassMesh;
    /** Width of the maps, 16 to 8192 px [1024] */
    mapWidth?: number;
}

export interface Position {
    x: number;
    y: number;
}

export interface WindshieldFigures {
    /** Since the start [s] */
    time: number;
    /** Of the car now [m/s] */
    speed: number;
    /** Of the unrolled glass [m] */
    width: number;
    /** Of the unrolled glass [m] */
    height: number;
    /** Number of droplets that are large enough to run */
    running: number;
    /** Number of droplets that are not */
    still: number;
    /** Number of raindrops that have met the glass */
    raindrops: number;
}

export interface RunningDroplet extends Position {
    /** Stays with the droplet */
    id: number;
    /** Velocity across [m/s]; exactly 0 at rest */
    vx: number;
    /** Velocity up the glass [m/s]; exactly 0 at rest */
    vy: number;
    /** [m³] */
    volume: number;
    /** Of the contact circle [m] */
    radius: number;
}

/** Place on the glass in the vehicle's frame: x to the driver's right, y ahead, z up, from the middle of the lower edge. */
export interface GlassPlace {
    point: number[];
    normal: number[];
    across: number[];
    up: number[];
}

/** Corner of a triangle of the glass: where it is on the unrolled glass, and in space. */
export interface GlassCorner extends Position, GlassPlace {}

export interface WaterMap {
    width: number;
    height: number;
    /** Parts that were written by this call [px] */
    tiles: { x: number; y: number; width: number; height: number }[];
    /**
     * Four half floats per pixel, row by row from the upper left, for a texture of gl.RGBA16F: x and y of the water's outward
     * unit normal, to the driver's right and up the glass, both times the wetness; the mean thickness of the water [mm]; the
     * wetness. In the module's memory: valid until the next call.
     */
    pixels: Uint16Array;
}

export interface MistMap {
    width: number;
    height: number;
    /** Where its right edge is, over the glass's width: 1 or a little more */
    right: number;
    /** Where its upper edge is, over the glass's height: 1 or a little more */
    top: number;
    /** 0 where the glass is clear to 255, row by row from the upper left */
    pixels: Uint8Array;
}

export interface Windshield {
    /** Changes parameters; they hold from the next step on. */
    set(values: WindshieldValues): void;
    /** Value of a parameter. */
    get(name: keyof WindshieldValues): number;
    /** Lets time pass; at most 1/30 s at once is advised. */
    advance(seconds: number): void;
    /** Sprays droplets, 1 mL over a radius of 5 cm unless given otherwise [m, m³]. */
    spray(water: Position & { radius?: number; volume?: number }): void;
    /** Moves a finger, 14 mm wide unless given otherwise [m]: it takes mist and droplets along. */
    finger(stroke: { from: Position; to: Position; width?: number }): void;
    figures(): WindshieldFigures;
    /** Volume of all water on the glass [m³], and what appeared or vanished, over all that has come; sums up all droplets */
    water(): { volume: number; balanceError: number };
    /** Droplets that are large enough to run, in the order of their ids. */
    running(): RunningDroplet[];
    /** Place of a position; throws where there is no glass. */
    place(x: number, y: number): GlassPlace;
    /** Triangles of the glass, for drawing, counter-clockwise on the unrolled glass. */
    triangles(): [GlassCorner, GlassCorner, GlassCorner][];
    /** Blades where they are now [m], and their angles about the pivot at rest and at the turn [rad]. */
    blades(): { inner: Position; outer: Position; pivot: Position; first: number; last: number }[];
    /** Brings the map of the water up to the state. */
    draw(): WaterMap;
    /** Brings the map of the mist up to the state. */
    mist(): MistMap;
    /** Brings the map of the film that runs off up to the state: 255 is 0.51 mm or more; with the way that small waves have run over it [m]. */
    runoff(): MistMap & { drift: Position };
    /** [px]; after another width all is drawn anew */
    mapWidth: number;
    readonly mapHeight: number;
    /** Gives its memory back at once. */
    free(): void;
}

/** Makes a dry windshield at time 0. */
export function windshield(options?: WindshieldOptions): Promise<Windshield>;

/** Loads the module from its bytes where it cannot be fetched, and returns a function that makes windshields. */
export function loadRain(wasm: BufferSource | WebAssembly.Module): Promise<(options?: WindshieldOptions) => Windshield>;

/** Number of a half float. */
export function halfFloat(bits: number): number;

/** Why a call failed. */
export class DropletError extends Error {
    code: 'Internal' | 'InvalidArgument' | 'OutOfMemory';
}

// Made by make_types.mjs.

/**
 * Where the liquid is: the bytes of a PNG, JPEG, WebP, TIFF or another picture of pixels, which is read by the rules of the
 * command; or coverage, 0 dry and 255 (or 65535) liquid; or RGBA like ImageData, read as a PNG is. Rows go from the top.
 */
export type Mask =
    | Uint8Array
    | { width: number; height: number; data: Uint8Array | Uint8ClampedArray | Uint16Array };

/** Coverage of every pixel, 0 dry and 65535 liquid, as the command's --mask-out writes it. Rows go from the top. */
export interface Coverage {
    width: number;
    height: number;
    /** edge of a pixel [m] */
    pixelSize: number;
    data: Uint16Array;
}

/** The command's options. Texts have units, such as '30uL'; numbers are SI. Seeds are a picture's bytes, or RGBA. */
export interface Options {
    /** Width of the picture; an SVG may state its own; a number is in m [20mm] */
    width?: string | number;
    /** Size of one pixel, instead of width; a number is in m */
    pixelSize?: string | number;
    /** Channel that shows the liquid: auto takes alpha if the picture has transparent parts, else what differs from the brightness of its border [auto] */
    channel?: 'auto' | 'alpha' | 'luma';
    /** Coverage at which liquid begins, between 0 and 1 [0.5] */
    threshold?: number;
    /** Exchange liquid and dry */
    invert?: boolean;
    /** How to separate liquid from dry: threshold for drawings and scans, adaptive for photographs in uneven light, grabcut by colour; auto chooses and reports its choice [auto] */
    segment?: 'auto' | 'threshold' | 'adaptive' | 'grabcut';
    /** Take the regions of this colour, such as red or #e30613 */
    colour?: string;
    /** Remove spots, and bends of the rim, that are narrower than this; a number is in m */
    smooth?: string | number;
    /** Fill holes smaller than this, such as glints: 1mm2; a number is in m² */
    fillHoles?: string | number;
    /** Keep only the N largest droplets */
    keep?: string | number;
    /** Drop spots and holes smaller than F square pixels [3] */
    speckSize?: number;
    /** Amount of liquid, by the mean contact angle along the rim, up to 179deg; natural: that of the liquid on what it lies on. By default no droplet is higher than a puddle of 40deg; by default and with natural, the largest angle that exists is taken if that one does not; a number is in rad [40deg] */
    contactAngle?: string | number;
    /** What the liquid lies on, for contactAngle natural [glass] */
    on?: 'glass' | 'ptfe' | 'wax' | 'lotus';
    /** Amount of liquid, by its volume; a number is in m³ */
    volume?: string | number;
    /** Amount of liquid, by its largest height; if two droplets have it, the one with less liquid; a number is in m */
    height?: string | number;
    /** each: every droplet gets this amount; total: all droplets share it at one pressure [each] */
    fill?: 'each' | 'total';
    /** Liquid, at 20 C [water] */
    liquid?: 'water' | 'ethanol' | 'glycerol' | 'mercury' | 'honey';
    /** Surface tension, instead of the liquid's own; a number is in N/m */
    surfaceTension?: string | number;
    /** Density, instead of the liquid's own; a number is in kg/m³ */
    density?: string | number;
    /** Model of the surface's area: linear is within 1 % up to 5 to 8deg, exact for all slopes, also where liquid hangs over its rim; auto takes linear where it is within 0.3 % [auto] */
    model?: 'auto' | 'linear' | 'exact';
    /** Gravity into the ground; negative under a ceiling; a number is in m/s² [9.81m/s2] */
    gravity?: string | number;
    /** Tilt of the ground: 90deg is a wall, 180deg a ceiling; a number is in rad [0deg] */
    tilt?: string | number;
    /** Direction of downhill, counter-clockwise from the picture's right; -90deg is its lower edge; a number is in rad [-90deg] */
    tiltDirection?: string | number;
    /** Curved ground: a height map's file, white is high; sphere:R=40mm; or cylinder:R=33mm,axis=y, with axis x, y or an angle; R < 0 is a bowl or a gutter [flat] */
    surface?: string;
    /** Keep the liquid above the ground; where it would sink in, the ground stays dry */
    noPenetration?: boolean;
    /** Lay the droplets on the object in a .glb, .gltf, .obj or .ply file by its texture coordinates; a .glb, .gltf, .usda or .usdz has the object with them, other formats the droplets alone */
    onto?: DewObject;
    /** With onto: Factor on the lengths of the file [1] */
    scale?: number;
    /** With onto: Longest side of the object, 0.1mm to 1000m; scales it; a number is in m */
    objectSize?: string | number;
    /** With onto: Axis that points up in an .obj, .ply or .stl [y, of .ply z] */
    up?: 'y' | 'z';
    /** Advancing contact angle; with receding the report says whether droplets slide; a number is in rad */
    advancing?: string | number;
    /** Receding contact angle, at most advancing; a number is in rad */
    receding?: string | number;
    /** Number of triangles of the liquid's surface, within 10 %: 5000, 5k, 1M [40k] */
    triangles?: string | number;
    /** Edge length of the triangles, instead of triangles; a number is in m */
    edge?: string | number;
    /** Largest edge length far from the rim, as a multiple of the length at the rim; auto: 1, or 64 in puddles where gravity flattens all but the rim [auto] */
    grading?: 'auto' | 1 | 2 | 4 | 8 | 16 | 32 | 64;
    /** Leave out the base */
    open?: boolean;
    /** Look in glTF, OBJ, USD, previews and the page; does not change the shape [the liquid's own] */
    material?: 'water' | 'ink' | 'mercury' | 'honey' | 'plain' | 'gel' | 'enamel' | 'glass' | 'resin' | 'oil' | 'milk' | 'lacquer' | 'blood' | 'gold' | 'frosted' | 'ice';
    /** Unit of length in OBJ and STL [mm] */
    unit?: 'm' | 'cm' | 'mm';
    /** Quadrilaterals along the rim, for subdivision and sculpting, in .obj, .ply and USD; triangles counts their halves */
    quads?: boolean;
    /** With onto: Leave the object out of a .glb, .gltf, .usda or .usdz */
    dropletsOnly?: boolean;
    /** Add a slider to glTF that fills and drains the droplet, such as 0..2 from none to twice its liquid; takes the linear model unless model exact is given */
    fillRange?: string | [number, number];
    /** Strokes on the picture, in a picture of its size: light ones on liquid, dark ones on dry ground, the rest transparent or grey; for clear droplets, whose rims are then found between them */
    seeds?: Uint8Array | { width: number; height: number; data: Uint8Array | Uint8ClampedArray };
    /** Solver of the linear system: llt is Eigen's factorisation, multigrid iterates; auto takes llt for linear models of up to 25,000 unknowns and for small or irregular meshes [auto] */
    solver?: 'auto' | 'llt' | 'multigrid';
}

/**
 * Object that droplets rest on: the bytes of a .glb; or a file, whose name ends in .glb, .gltf, .obj, .ply or .stl, its bytes, and
 * the files that it names, by their names: buffers, materials, textures.
 */
export type DewObject =
    | Uint8Array
    | { name: string; data: Uint8Array; beside?: Record<string, Uint8Array> };

/** Options of the command dew. Texts have units, such as '12cm'; numbers are SI. A mask is a picture's bytes, or RGBA. */
export interface DewOptions {
    /** Factor on the lengths of the file [1] */
    scale?: number;
    /** Longest side of the object, 0.1mm to 1000m; scales it; a number is in m */
    objectSize?: string | number;
    /** Axis that points up in an .obj, .ply or .stl [y, of .ply z] */
    up?: 'y' | 'z';
    /** Kind of wetness: dew in the morning, fresh rain, a cold bottle, after a shower, fine mist; the other options of this group change it [dew] */
    preset?: 'dew' | 'rain' | 'bottle' | 'shower' | 'mist';
    /** Share of the surface below droplets, 0.001 to 0.7 [by preset] */
    coverage?: number;
    /** Radius of the smallest droplets seen from above; a number is in m [by preset] */
    smallest?: string | number;
    /** Radius of the largest droplets seen from above, before some join; a number is in m [by preset] */
    largest?: string | number;
    /** Numbers of droplets by radius r: condensation is r to the power of -8/3, lognormal has a median and a spread [by preset] */
    sizes?: 'condensation' | 'lognormal';
    /** Median of the radii, lognormal; a number is in m [by preset] */
    median?: string | number;
    /** Standard deviation of their logarithm, lognormal, 0 to 3 [by preset] */
    spread?: number;
    /** Direction that rain comes from; droplets are then only where it meets the object [of rain 0,1,0] */
    from?: string | [number, number, number];
    /** Mask over the object's texture coordinates: droplets are where it is covered */
    mask?: Uint8Array | { width: number; height: number; data: Uint8Array | Uint8ClampedArray };
    /** Droplets are where the vertices have weights: _WEIGHT or the red of COLOR_0 of glTF, weight or red of PLY */
    vertexWeights?: boolean;
    /** Droplets also on inner sides, which see less than a tenth of the outside */
    inside?: boolean;
    /** Random seed [1] */
    seed?: string | number;
    /** Contact angle hysteresis: cosine of the receding minus cosine of the advancing angle; it holds droplets [0.2] */
    hysteresis?: number;
    /** How much hysteresis varies over the surface, so that droplets stick, slip and wander: standard deviation of its logarithm, 0 to 1.5 [0.5] */
    pinning?: number;
    /** Length over which it varies; a number is in m [3mm] */
    pinningLength?: string | number;
    /** Direction of gravity [0,-1,0] */
    gravityDirection?: string | [number, number, number];
    /** Contact angle of droplets at rest, from 1deg to 179deg; a number is in rad [by preset] */
    contactAngle?: string | number;
    /** Viscous drag per radius and speed: artistic is 0.5Pa.s, wedge is that of water by wedge theory; a number is in Pa.s [by preset] */
    viscosityFactor?: string | number;
    /** Friction of a moving droplet, as a fraction of that at rest [1] */
    kineticFraction?: number;
    /** Drag coefficient of droplets in the wind [1] */
    dragCoefficient?: number;
    /** Thickness of the layer in which the wind is slower; a number is in m [by preset] */
    boundaryLayer?: string | number;
    /** Exponent of the wind's growth with height in that layer; 0.143 for a turbulent one [0.5] */
    profileExponent?: number;
    /** Density of the air; a number is in kg/m³ [1.204kg/m3] */
    airDensity?: string | number;
    /** Liquid, at 20 C [water] */
    liquid?: 'water' | 'ethanol' | 'glycerol' | 'mercury' | 'honey';
    /** Surface tension, instead of the liquid's own; a number is in N/m */
    surfaceTension?: string | number;
    /** Density, instead of the liquid's own; a number is in kg/m³ */
    density?: string | number;
    /** Gravity, downwards; a number is in m/s² [9.81m/s2] */
    gravity?: string | number;
    /** Triangles of droplets: medium has 64 of small ones to 352 of large ones [medium] */
    detail?: 'low' | 'medium' | 'high';
    /** Look of the droplets [by liquid] */
    material?: 'water' | 'ink' | 'mercury' | 'honey' | 'plain' | 'gel' | 'enamel' | 'glass' | 'resin' | 'oil' | 'milk' | 'lacquer' | 'blood' | 'gold' | 'frosted' | 'ice';
    /** auto is one mesh up to 20000 droplets; none one mesh; nodes a node for each droplet, with shared meshes; gpu EXT_mesh_gpu_instancing, for glTF [auto] */
    instancing?: 'auto' | 'none' | 'nodes' | 'gpu';
    /** Leave the object out of a .glb, .gltf, .usda or .usdz */
    dropletsOnly?: boolean;
    /** Compress a .glb: quantize, integers of 16 bits (KHR_mesh_quantization), three quarters of the size; meshopt, those encoded (EXT_meshopt_compression), a third of the size [none] */
    compress?: 'none' | 'quantize' | 'meshopt';
}

/** Triangles in space: metres, z up. Arrays of vertices have one length. */
export interface Surface {
    /** x, y, z of every vertex [m]; a vertex that needs two normals, as on the rim, is there twice */
    positions: Float32Array;
    /** x, y, z of every vertex's normal */
    normals: Float32Array;
    /** place of every vertex in the mask: 0, 0 top left, 1, 1 bottom right */
    uvs: Float32Array;
    /** contact angle at the liquid's vertices on the rim [rad], 0 at others */
    contactAngles: Float32Array;
    /** vertices of every triangle, counter-clockwise from outside */
    triangles: Uint32Array;
}

export interface Droplet {
    readonly surface: Surface;
    /** The command's report, droplet-shape.report/1. */
    readonly report: Record<string, any>;
    /**
     * Bytes of a file. With onto, glb, gltf, usda and usdz have the object with the droplets on it; others the droplets alone.
     * @param form  other options for this file
     */
    file(format?: 'glb' | 'gltf' | 'obj' | 'ply' | 'stl' | 'usda' | 'usdz' | '3mf', form?: Pick<Options, 'dropletsOnly'>): Uint8Array;
    /**
     * Textures of the droplets from straight above, as the command's --maps: PNG files by name, such as droplet-height.png. Not with onto.
     * @param options  path: the names without the map's, ending in .png [droplet.png]; the others as of the command
     */
    maps(options?: { path?: string; mapWidth?: number; mapThickness?: string | number; mapTile?: boolean }): Record<string, Uint8Array>;
    /** Gives the solver's memory back before the garbage collector does. */
    free(): void;
}

/** An object and the droplets on it. */
export interface Dew {
    /** All droplets, in the object's frame: metres, z up. */
    readonly surface: Pick<Surface, 'positions' | 'normals' | 'triangles'>;
    /** The command's report, droplet-shape.dew/1. */
    readonly report: Record<string, any>;
    /**
     * Bytes of a file: object and droplets; in obj, ply and stl the droplets alone; in csv a table of them.
     * @param form  other options for this file
     */
    file(format?: 'glb' | 'gltf' | 'usda' | 'usdz' | 'obj' | 'ply' | 'stl' | 'csv',
        form?: Pick<DewOptions, 'material' | 'instancing' | 'dropletsOnly' | 'compress'>): Uint8Array;
    /** Gives the solver's memory back before the garbage collector does. */
    free(): void;
}

export interface Option {
    name: string;
    group: string;
    /** name of the value in the help, or the allowed words; empty for a flag */
    value: string;
    /** what the value is: 'flag', 'words', 'length', 'count', … */
    kind: string;
    /** allowed words, or words that may stand instead of a value */
    words: string[];
    /** of a number; empty if it has none */
    unit: string;
    /** least and greatest number, in SI units; null if there is none */
    min: number | null;
    max: number | null;
    text: string;
    default: string;
}

export interface Solver {
    readonly options: Option[];
    readMask(picture: Mask, options?: Options): Coverage;
    makeDroplet(mask: Mask, options?: Options): Droplet;
    readonly dewOptions: Option[];
    dew(object: DewObject, options?: DewOptions): Dew;
}

/** Why there is no droplet. */
export class DropletError extends Error {
    code: 'InvalidArgument' | 'InvalidInput' | 'NoSuchDroplet' | 'OutOfMemory' | 'Internal';
}

/** Loads the solver from the bytes of droplet_shape.wasm, as in a page without a server. */
export function loadSolver(wasm: BufferSource | WebAssembly.Module): Promise<Solver>;

/** Options, with the texts and defaults of the command's help. */
export const options: Option[];

/** Reads a mask as makeDroplet does, such as by the strokes of `seeds` on a photograph. */
export function readMask(picture: Mask, options?: Options): Coverage;

/** Makes the droplet of a mask: the bytes of a GLB. */
export function makeDroplet(mask: Mask, options?: Options): Uint8Array;

/** Makes the droplet of a mask: its surface, its report, and its files. */
export function shapeDroplet(mask: Mask, options?: Options): Droplet;

/** Options of dew, likewise. */
export const dewOptions: Option[];

/** Covers an object with droplets that rest on it: their surface, the report, and files. */
export function dew(object: DewObject, options?: DewOptions): Dew;

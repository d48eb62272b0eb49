// SPDX-License-Identifier: GPL-3.0-or-later
// Prints droplet_shape.d.ts, with the options that the solver has: node make_types.mjs WASM > droplet_shape.d.ts
import { readFileSync } from 'node:fs';
import { loadSolver } from './droplet_shape.js';

const { options, dewOptions } = await loadSolver(readFileSync(process.argv[2]));

const kPicture = 'Uint8Array | { width: number; height: number; data: Uint8Array | Uint8ClampedArray }';
const kTypes = { flag: 'boolean', count: 'string | number', number: 'number', range: 'string | [number, number]', path: kPicture,
    vector: 'string | [number, number, number]' };

function typeOf({ name, kind, unit, words }) {
    if (name === 'onto') {
        return 'DewObject';
    }
    if (kind === 'words') {
        return words.map((word) => /^\d/.test(word) ? word : `'${word}'`).join(' | ');
    }
    return kTypes[kind] ?? (unit === '' ? 'string' : 'string | number');
}
const linesOf = (list) => list.map((option) => {
    // With superscripts, as in texts.
    const unit = option.unit === '' || option.kind === 'vector' ? '' : `; a number is in ${option.unit.replace('2', '²').replace('3', '³')}`;
    const usual = option.default === '' ? '' : ` [${option.default}]`;
    return `    /** ${option.text}${unit}${usual} */\n    ${option.name}?: ${typeOf(option)};`;
}).join('\n');

process.stdout.write(`// Made by make_types.mjs.

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
${linesOf(options)}
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
${linesOf(dewOptions)}
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

/** Reads a mask as makeDroplet does, such as by the strokes of \`seeds\` on a photograph. */
export function readMask(picture: Mask, options?: Options): Coverage;

/** Makes the droplet of a mask: the bytes of a GLB. */
export function makeDroplet(mask: Mask, options?: Options): Uint8Array;

/** Makes the droplet of a mask: its surface, its report, and its files. */
export function shapeDroplet(mask: Mask, options?: Options): Droplet;

/** Options of dew, likewise. */
export const dewOptions: Option[];

/** Covers an object with droplets that rest on it: their surface, the report, and files. */
export function dew(object: DewObject, options?: DewOptions): Dew;
`);

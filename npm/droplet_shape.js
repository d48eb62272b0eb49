// SPDX-License-Identifier: GPL-3.0-or-later
// Loads the solver, and calls it.
import { DropletError } from './droplet_error.js';
import { pageSystem } from './page_system.js';
import { pngOf } from './png.js';

// As in src/module.cpp.
const kMask = { png: 0, bytes: 1, words: 2 };
const kArray = { positions: 0, normals: 1, uvs: 2, contactAngles: 3, triangles: 4, report: 5, file: 6, message: 7, code: 8, coverage: 9, name: 10 };

export { DropletError };

const camelCase = (name) => name.replace(/-(\w)/g, (_, letter) => letter.toUpperCase());
/** Name of an option on the command line. */
export const dashed = (name) => name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);
/** The command's words for options, as this package has them. */
const inScript = (text) => text.replace(/--([a-z][a-z-]*)/g, (_, name) => camelCase(name));

/** A message that refuses an angle in radians, with the same number of degrees. */
const withDegrees = (message) => message.replace(/'(-?[\d.e+-]+)rad' must be .*/,
    (refusal, number) => `${refusal}; a number is in radians: write '${Number(number)}deg'`);

/** Options of files, of the terminal and of the threads. */
const kNotHere = ['format', 'config', 'help', 'version', 'quiet', 'verbose', 'progress', 'threads', 'no-clobber'];
const kOfMaps = ['map-width', 'map-thickness', 'map-tile'];
/** Those of a droplet, and those of colours, which are not a mask's. */
const kNotOfDroplets = new Set([...kNotHere, 'surface-depth', 'by-colour', 'colours', 'gap', 'colour-map', 'nodes', 'materials',
    'compress', 'sink', 'base', 'lod', 'weld', 'maps', ...kOfMaps]);
// The module draws no pictures.
const kNotOfDew = new Set([...kNotHere, 'droplets', 'json', 'preview', 'view', 'camera', 'look-at', 'preview-size', 'environment',
    'turntable', 'codec', 'quality']);
const kDewFormats = ['glb', 'gltf', 'usda', 'usdz', 'obj', 'ply', 'stl', 'csv'];
/** Options of droplets on an object that change files alone. */
const kForm = ['dropletsOnly'];
/** Those of dew. */
const kDewForm = ['material', 'instancing', 'dropletsOnly', 'compress'];

/** Options of the command's --help=json that the solver has, with their names in JavaScript. */
function optionsOf(help, without) {
    return JSON.parse(help).options.filter(({ name }) => !without.has(name.slice(2)))
        .map(({ name, group, value, kind, unit, words, min, max, text, default: usual }) =>
            ({ name: camelCase(name.slice(2)), group, value, kind, unit, words, min, max, text: inScript(text), default: usual }));
}

function textOf(option, value) {
    const { name } = option;
    const refuse = (allowed) => {
        throw new DropletError('InvalidArgument', `${name}: ${JSON.stringify(value)} must be ${allowed}`);
    };
    if (typeof value === 'string') {
        return value === '' || value.includes('\0') ? refuse('a text that is not empty') : value;
    }
    if (option.kind === 'range' && Array.isArray(value)) {
        return value.join('..');
    }
    if (option.kind === 'vector') {
        const is_vector = Array.isArray(value) && value.length === 3 && value.every(Number.isFinite);
        return is_vector ? value.join(',') : refuse('three numbers');
    }
    if (typeof value !== 'number') {
        return refuse(option.unit !== '' ? 'a number or a text' : 'a text');
    }
    return Number.isFinite(value) ? `${value}${option.unit}` : refuse('a finite number');
}

function argumentsOf(options, known) {
    const list = [];
    for (const [name, value] of Object.entries(options ?? {})) {
        const option = known.get(name);
        if (!option) {
            throw new DropletError('InvalidArgument', `${name}: unknown option; known are ${[...known.keys()].join(', ')}`);
        }
        if (value === undefined || value === null || value === false) {
            continue;
        }
        if (option.kind === 'flag') {
            if (value !== true) {
                throw new DropletError('InvalidArgument', `${name}: ${JSON.stringify(value)} must be true or false`);
            }
            list.push(`--${dashed(name)}`);
        } else {
            list.push(`--${dashed(name)}=${textOf(option, value)}`);
        }
    }
    return list;
}

/** Files of an object, by their names: the object is the first. */
function filesOf(object, subject = 'object') {
    const refuse = (what) => {
        throw new DropletError('InvalidArgument', what);
    };
    const { name, data, beside = {} } = object instanceof Uint8Array ? { name: 'object.glb', data: object } : object ?? {};
    if (typeof name !== 'string' || /^$|[\0/\\]/.test(name) || !(data instanceof Uint8Array)) {
        refuse(subject + ': must be the bytes of a .glb, or have the name of a file, without its folder, and its bytes in data');
    }
    const files = new Map([[name, data], ...Object.entries(beside)]);
    for (const [path, bytes] of files) {
        if (!(bytes instanceof Uint8Array)) {
            refuse(`beside: '${path}' must have the bytes of a file`);
        }
    }
    return files;
}

/** Bytes of a picture that is an option. */
function pictureOf(picture, name) {
    const { kind, bytes } = describe(picture, name);
    if (kind !== kMask.png) {
        throw new DropletError('InvalidArgument', `${name}: must be the bytes of a picture, or pixels of RGBA`);
    }
    return bytes;
}

/** Bytes of a mask and their kind. */
function describe(mask, subject = 'mask') {
    if (mask instanceof Uint8Array && !(mask instanceof Uint8ClampedArray)) {
        return { kind: kMask.png, bytes: mask, width: 0, height: 0 };
    }
    const { width, height, data } = mask ?? {};
    const refuse = (what) => {
        throw new DropletError('InvalidArgument', `${subject}: ${what}`);
    };
    if (typeof mask === 'string') {
        refuse(`'${mask}' must be the bytes of a picture, not its path; in node readFileSync() reads them`);
    }
    if (!Number.isInteger(width) || !Number.isInteger(height) || width < 1 || height < 1) {
        refuse(`must be the bytes of a picture, or have a width and a height of at least 1; it has ${width} and ${height}`);
    }
    if (!(data instanceof Uint8Array || data instanceof Uint8ClampedArray || data instanceof Uint16Array)) {
        refuse('data must be a Uint8Array, a Uint8ClampedArray or a Uint16Array');
    }
    const pixels = width * height;
    if (data.length === pixels) {
        const kind = data instanceof Uint16Array ? kMask.words : kMask.bytes;
        return { kind, bytes: new Uint8Array(data.buffer, data.byteOffset, data.byteLength), width, height };
    }
    if (data.length === 4 * pixels && !(data instanceof Uint16Array)) {
        return { kind: kMask.png, bytes: pngOf(mask), width: 0, height: 0 };
    }
    return refuse(`data has ${data.length} items, must have ${pixels} (coverage) or ${4 * pixels} (RGBA)`);
}

const kBadDescriptor = 8;
const kNoSuchCall = -52;
/** What the module gets for a call that its system does not have. */
const kMissing = { wasi_snapshot_preview1: () => kBadDescriptor, env: () => kNoSuchCall, droplet: () => kNoSuchCall };

/**
 * Starts the module on a system.
 * @param {BufferSource | WebAssembly.Module} wasm  bytes of droplet_shape.wasm, or the compiled module
 * @param {(memory: () => WebAssembly.Memory) => object} systemOf  gives calls by module and name, such as nodeSystem()
 * @returns its exports
 */
export async function instantiate(wasm, systemOf) {
    const module = wasm instanceof WebAssembly.Module ? wasm : await WebAssembly.compile(wasm);
    let exports;
    const system = systemOf(() => exports.memory);
    const imports = {};
    for (const { module: from, name } of WebAssembly.Module.imports(module)) {
        (imports[from] ??= {})[name] = system[from][name] ?? kMissing[from];
    }
    ({ exports } = await WebAssembly.instantiate(module, imports));
    exports._initialize?.();
    return exports;
}

/**
 * Loads the solver. All calls after it are synchronous.
 * @param {BufferSource | WebAssembly.Module} wasm  bytes of droplet_shape.wasm, or the compiled module
 */
export async function loadSolver(wasm) {
    const files = new Map();
    const solver = await instantiate(wasm, (memory) => pageSystem(memory, files));

    const decoder = new TextDecoder();
    const put = (bytes) => {
        const place = solver.malloc(Math.max(bytes.length, 1));
        if (place === 0) {
            throw new DropletError('OutOfMemory', 'out of memory; use a smaller mask');
        }
        new Uint8Array(solver.memory.buffer, place, bytes.length).set(bytes);
        return place;
    };
    const take = (result, which, Items) => {
        const place = solver.droplet_array(result, which);
        const bytes = solver.droplet_array_bytes(result);
        return new Items(solver.memory.buffer.slice(place, place + bytes));
    };
    const text = (result, which) => decoder.decode(take(result, which, Uint8Array));
    const check = (result) => {
        const code = text(result, kArray.code);
        if (code !== '') {
            throw new DropletError(code, withDegrees(inScript(text(result, kArray.message))));
        }
    };
    const textAt = (place) => {
        const bytes = new Uint8Array(solver.memory.buffer, place);
        return decoder.decode(bytes.slice(0, bytes.indexOf(0)));
    };
    const byName = (list) => new Map(list.map((option) => [option.name, option]));
    const help = textAt(solver.droplet_help());
    const options = optionsOf(help, kNotOfDroplets);
    const known = byName(options);
    const knownOfMaps = byName(optionsOf(help, { has: (name) => !kOfMaps.includes(name) }));
    const dewOptions = optionsOf(textAt(solver.droplet_dew_help()), kNotOfDew);
    const knownOfDew = byName(dewOptions);
    const bytesOf = (words) => new TextEncoder().encode(words.map((word) => `${word}\0`).join(''));
    /** Gives the module arguments, and keeps what it makes of them unless it fails. */
    const made = (words, make, wrap) => {
        const bytes = bytesOf(words);
        const at = put(bytes);
        const result = make(at, bytes.length);
        solver.free(at);
        try {
            check(result);
        } catch (error) {
            solver.droplet_delete(result);
            throw error;
        }
        return wrap(result);
    };
    // The solver's own memory of droplets whose objects are gone.
    const forgotten = new FinalizationRegistry((result) => solver.droplet_delete(result));

    /** Lets the module read files while it works. */
    const withFiles = (given, work) => {
        given.forEach((bytes, path) => void files.set(path, bytes));
        try {
            return work();
        } finally {
            files.clear();
        }
    };

    /** What the module made, with its files. */
    class Made {
        #result;
        #words;
        #object;
        #surface;
        #report;

        /**
         * @param words   gives the arguments with other options of files
         * @param object  files of the object that it lies on
         */
        constructor(result, words, object) {
            this.#result = result;
            this.#words = words;
            this.#object = object;
            forgotten.register(this, result, this);
        }

        get surface() {
            const result = this.#kept();
            this.#surface ??= {
                positions: take(result, kArray.positions, Float32Array),
                normals: take(result, kArray.normals, Float32Array),
                uvs: take(result, kArray.uvs, Float32Array),
                contactAngles: take(result, kArray.contactAngles, Float32Array),
                triangles: take(result, kArray.triangles, Uint32Array),
            };
            return this.#surface;
        }

        get report() {
            if (!this.#report) {
                this.#report = JSON.parse(text(this.#kept(), kArray.report));
                this.#report.warnings = this.#report.warnings.map(inScript);
            }
            return this.#report;
        }

        file(format = 'glb', form = {}) {
            const result = this.#kept();
            const only = this.constructor.form;
            const other = Object.keys(form).find((name) => !only.includes(name));
            if (other) {
                throw new DropletError('InvalidArgument', `${other}: changes more than a file; only ${only.join(', ')} may be given here`);
            }
            this._tell(solver.droplet_form, form);
            const place = put(new TextEncoder().encode(`${format}\0`));
            withFiles(this.#object, () => solver.droplet_write(result, place));
            solver.free(place);
            check(result);
            return take(result, kArray.file, Uint8Array);
        }

        /**
         * Gives a call the arguments, with some more; returns what it does.
         * @param form  options of files
         */
        _tell(call, form, more = []) {
            const result = this.#kept();
            const bytes = bytesOf([...this.#words(form), ...more]);
            const at = put(bytes);
            const answer = call(result, at, bytes.length);
            solver.free(at);
            check(result);
            return answer;
        }

        /** Name and bytes of one of the maps. */
        _map(number) {
            const result = this.#kept();
            solver.droplet_map(result, number);
            return [text(result, kArray.name), take(result, kArray.file, Uint8Array)];
        }

        /** Gives its memory back at once. */
        free() {
            if (this.#result) {
                forgotten.unregister(this);
                solver.droplet_delete(this.#result);
                this.#result = undefined;
            }
        }

        #kept() {
            if (!this.#result) {
                throw new DropletError('InvalidArgument', 'the droplet was freed');
            }
            return this.#result;
        }
    }

    class Droplet extends Made {
        static form = kForm;

        maps({ path = 'droplet.png', ...given } = {}) {
            if (typeof path !== 'string' || !path.endsWith('.png')) {
                throw new DropletError('InvalidArgument', `path: ${JSON.stringify(path)} must end in .png; only the command writes OpenEXR`);
            }
            const count = this._tell(solver.droplet_maps, {}, [`--maps=${path}`, ...argumentsOf(given, knownOfMaps)]);
            return Object.fromEntries(Array.from({ length: count }, (_, k) => this._map(k)));
        }
    }

    class Dew extends Made {
        static form = kDewForm;

        get surface() {
            const { positions, normals, triangles } = super.surface;
            return { positions, normals, triangles };
        }

        file(format = 'glb', form = {}) {
            if (!kDewFormats.includes(format)) {
                throw new DropletError('InvalidArgument', `format: '${format}' must be one of ${kDewFormats.join(', ')}`);
            }
            return super.file(format, form);
        }
    }

    /** Gives the module a mask, with the files that its options name, and keeps what it makes of it. */
    const ofMask = (mask, options_given, make, wrap) => {
        const { seeds, onto, ...given } = options_given ?? {};
        const object = onto ? filesOf(onto, 'onto') : new Map();
        const [name] = object.keys();
        const words = (form) => [...argumentsOf({ ...given, ...form }, known), ...seeds ? ['--seeds=seeds'] : [], ...onto ? [`--onto=${name}`] : []];
        const first = words();
        const { kind, bytes, width, height } = describe(mask);
        const inputs = new Map([...object, ...seeds ? [['seeds', pictureOf(seeds, 'seeds')]] : []]);
        const pixels = put(bytes);
        try {
            return withFiles(inputs, () => made(first, (at, length) => make(at, length, pixels, bytes.length, width, height, kind),
                (result) => wrap(result, words, object)));
        } finally {
            solver.free(pixels);
        }
    };

    return {
        options,
        readMask: (picture, given) => ofMask(picture, given, solver.droplet_mask, (result) => {
            const width = solver.droplet_mask_width(result);
            const pixelSize = solver.droplet_mask_pixel_size(result);
            const data = take(result, kArray.coverage, Uint16Array);
            solver.droplet_delete(result);
            return { width, height: data.length / width, pixelSize, data };
        }),
        makeDroplet: (mask, given) => ofMask(mask, given, solver.droplet_make, (result, words, object) => new Droplet(result, words, object)),
        dewOptions,
        dew(object, { mask, ...given } = {}) {
            const inputs = filesOf(object);
            const [name] = inputs.keys();
            if (mask) {
                inputs.set('mask', pictureOf(mask, 'mask'));
            }
            const words = (form) => [...argumentsOf({ ...given, ...form }, knownOfDew), ...mask ? ['--mask=mask'] : [], '--', name, 'droplets.glb'];
            const first = words();
            return withFiles(inputs, () => made(first, solver.droplet_dew, (result) => new Dew(result, words, new Map())));
        },
    };
}

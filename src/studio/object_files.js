// SPDX-License-Identifier: MIT
// Files that a user opens as an object: its own, and those beside it that it names.
import { joined } from '../../npm/bytes.js';
import { glbPieces } from '../html/glb.js';
import { decodeBase64 } from '../html/model.js';
import { say } from '../html/words.js';

const kMeshes = /\.(glb|gltf|obj|ply|stl)$/i;
const kMost = 400 << 20;  // a browser's memory holds a mesh several times [bytes]

/** The object among files; or undefined. */
export const mainOf = (files) => files.find(({ name }) => kMeshes.test(name));

/** Whether one of the files is an object. */
export const hasObject = (files) => mainOf(files) !== undefined;

const bytesOf = async (file) => new Uint8Array(await file.arrayBuffer());

/** Paths that a .gltf names. */
function pathsIn(bytes) {
    try {
        const { buffers = [], images = [] } = JSON.parse(new TextDecoder().decode(bytes));
        return [...buffers, ...images].map(({ uri }) => uri).filter((uri) => typeof uri === 'string' && !uri.startsWith('data:')).map(decodeURIComponent);
    } catch {
        return [];  // the solver says what is wrong with it
    }
}

/** Reads an object: {name, data, beside}, as of the solver's dew(). */
export async function readObject(files) {
    const main = mainOf(files);
    const total = files.reduce((sum, { size }) => sum + size, 0);
    if (total > kMost) {
        throw new Error(say('it has {size} MB, which is too much for a browser, at most {most} MB. Give it fewer triangles, or use the command droplet-shape dew',
            { size: Math.round(total / 2 ** 20), most: kMost >> 20 }));
    }
    const data = await bytesOf(main);
    const others = files.filter((file) => file !== main);
    const beside = Object.fromEntries(await Promise.all(others.map(async (file) => [file.name, await bytesOf(file)])));
    // Files that are dropped lost their folders.
    for (const path of /\.gltf$/i.test(main.name) ? pathsIn(data) : []) {
        const found = beside[path] ?? beside[path.replace(/.*\//, '')];
        if (found) {
            beside[path] = found;
        }
    }
    return { name: main.name, data, beside };
}

const typeOf = (bytes) => (bytes[0] === 0xff && bytes[1] === 0xd8 ? 'image/jpeg' : 'image/png');

/** An object whose data is one file: a .gltf becomes a GLB with all that it names, under the same name. */
export function asGlb({ name, data, beside }) {
    if (!/\.gltf$/i.test(name)) {
        return { name, data, beside };
    }
    const json = JSON.parse(new TextDecoder().decode(data));
    const pieces = [];
    let length = 0;
    /** Adds what a URI names; returns where it begins, and its bytes. */
    const taken = (uri) => {
        const [, text] = /^data:[^,]*;base64,(.*)$/s.exec(uri) ?? [];
        const bytes = text === undefined ? beside[decodeURIComponent(uri)] : decodeBase64(text);
        if (!bytes) {
            throw new Error(say('it names {file}, which must be dropped together with it', { file: decodeURIComponent(uri) }));
        }
        const at = length;
        const padding = new Uint8Array((4 - bytes.length % 4) % 4);
        pieces.push(bytes, padding);
        length += bytes.length + padding.length;
        return { at, bytes };
    };
    const begins = (json.buffers ?? []).map(({ uri }) => taken(uri ?? '').at);
    json.bufferViews = (json.bufferViews ?? []).map((view) =>
        ({ ...view, buffer: 0, byteOffset: (view.byteOffset ?? 0) + begins[view.buffer] }));
    json.images = json.images?.map(({ uri, ...image }) => {
        if (uri === undefined) {
            return image;
        }
        const { at, bytes } = taken(uri);
        json.bufferViews.push({ buffer: 0, byteOffset: at, byteLength: bytes.length });
        return { ...image, mimeType: typeOf(bytes), bufferView: json.bufferViews.length - 1 };
    });
    json.buffers = [{ byteLength: length }];
    return { name, data: joined(glbPieces(json, pieces)), beside: {} };
}

/** Bytes of an object and of the files beside it. */
export const sizeOf = ({ data, beside }) => Object.values(beside).reduce((sum, { byteLength }) => sum + byteLength, data.byteLength);

// SPDX-License-Identifier: MIT
// Files that a user opens as an object: its own, and those beside it that it names.
import { say } from '../html/words.js';

const kMeshes = /\.(glb|gltf|obj|ply|stl)$/i;
const kMost = 400 << 20;  // a browser's memory holds a mesh several times [bytes]

/** Whether one of the files is an object. */
export const hasObject = (files) => files.some(({ name }) => kMeshes.test(name));

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
    const main = files.find(({ name }) => kMeshes.test(name));
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

/** Bytes of an object and of the files beside it. */
export const sizeOf = ({ data, beside }) => Object.values(beside).reduce((sum, { byteLength }) => sum + byteLength, data.byteLength);

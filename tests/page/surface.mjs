// SPDX-License-Identifier: GPL-3.0-or-later
// Prints which part of a GLB's droplet the page takes for the liquid's surface: its triangles, how many of them face
// down, the edges of only one of them, and the greatest height of those.
//
//   node surface.mjs THREE_FOLDER FILE LIQUID_TRIANGLES
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [folder, file, source] = process.argv.slice(2);
const url = (path) => pathToFileURL(`${folder}/${path}`).href;
globalThis.self = globalThis;
const three = url('build/three.module.js');
const { Vector3 } = await import(three);
const { GLTFLoader } = await import(url('examples/jsm/loaders/GLTFLoader.js'));
const { liquidTriangles } = await import(`data:text/javascript,${encodeURIComponent(
    readFileSync(source, 'utf8').replace("'three'", `'${three}'`))}`);

const bytes = readFileSync(file);
const { scene } = await new GLTFLoader().parseAsync(
    bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), '');
scene.updateMatrixWorld(true);
const meshes = [];
scene.traverse((object) => object.isMesh && meshes.push(object));
const [{ geometry, matrixWorld }] = meshes;
const corners = liquidTriangles(geometry, matrixWorld)
    .map((i) => new Vector3().fromBufferAttribute(geometry.attributes.position, i).applyMatrix4(matrixWorld));
const names = corners.map((place) => place.toArray().join());
const edges = new Map();
let facing_down = 0;
for (let i = 0; i < corners.length; i += 3) {
    const [a, b, c] = corners.slice(i, i + 3);
    facing_down += b.clone().sub(a).cross(c.clone().sub(a)).y < 0;
    for (let k = 0; k < 3; ++k) {
        const [from, to] = [i + k, i + (k + 1) % 3];
        if (!edges.delete(`${names[to]} ${names[from]}`)) {
            edges.set(`${names[from]} ${names[to]}`, Math.max(corners[from].y, corners[to].y));
        }
    }
}
process.stdout.write(JSON.stringify(
    { triangles: corners.length / 3, facing_down, rim: edges.size, rim_height: Math.max(...edges.values()) }));

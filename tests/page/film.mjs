// SPDX-License-Identifier: GPL-3.0-or-later
// Shows a glTF file in three.js at several times of its animation, or at several values of its slider, and prints what is
// seen: the number of visible triangles, and the box, the volume and the area of all of them.
//
//   node film.mjs THREE_FOLDER FILE time|fill NUMBER...
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [folder, file, what, ...numbers] = process.argv.slice(2);
const module = (path) => import(pathToFileURL(`${folder}/${path}`).href);
globalThis.self = globalThis;
const { AnimationMixer, Vector3 } = await module('build/three.module.js');
const { GLTFLoader } = await module('examples/jsm/loaders/GLTFLoader.js');
const { MeshoptDecoder } = await module('examples/jsm/libs/meshopt_decoder.module.js');

const bytes = readFileSync(file);
const { scene, animations } = await new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).parseAsync(
    bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), '');
const meshes = [];
scene.traverse((object) => object.isMesh && meshes.push(object));
const mixer = new AnimationMixer(scene);
animations.forEach((clip) => mixer.clipAction(clip).play());

/** Places of a mesh's vertices in the world, moved by its targets and its joints. */
const places = (mesh) => [...Array(mesh.geometry.attributes.position.count).keys()].map((i) =>
    mesh.localToWorld(mesh.getVertexPosition(i, new Vector3())));

const seen = numbers.map(Number).map((number) => {
    if (what === 'time') {
        mixer.setTime(number);
    } else {
        meshes.forEach((mesh) => mesh.morphTargetInfluences?.fill(number - 1));
    }
    scene.updateMatrixWorld(true);
    const one = { triangles: 0, low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity], volume: 0, area: 0 };
    for (const mesh of meshes) {
        const at = places(mesh);
        const corners = mesh.geometry.index.array;
        for (let i = 0; i < corners.length; i += 3) {
            const [a, b, c] = [at[corners[i]], at[corners[i + 1]], at[corners[i + 2]]];
            const area = b.clone().sub(a).cross(c.clone().sub(a)).length() / 2;
            if (area === 0) {
                continue;
            }
            one.triangles += 1;
            one.area += area;
            one.volume += a.dot(b.clone().cross(c)) / 6;
            for (const corner of [a, b, c]) {
                corner.toArray().forEach((value, k) => {
                    one.low[k] = Math.min(one.low[k], value);
                    one.high[k] = Math.max(one.high[k], value);
                });
            }
        }
    }
    return one;
});
process.stdout.write(JSON.stringify(seen));

// SPDX-License-Identifier: GPL-3.0-or-later
// Plays an animated GLB of droplets in three.js and prints, for each time, the joints that show a droplet: the name of
// their mesh, their place in the world and the cube root of their volume.
//
//   node joints.mjs THREE_FOLDER FILE SECONDS...
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [folder, file, ...times] = process.argv.slice(2);
const module = (path) => import(pathToFileURL(`${folder}/${path}`).href);
globalThis.self = globalThis;
const { AnimationMixer, Vector3 } = await module('build/three.module.js');
const { GLTFLoader } = await module('examples/jsm/loaders/GLTFLoader.js');

const bytes = readFileSync(file);
const { scene, animations } = await new GLTFLoader().parseAsync(
    bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), '');
const mixer = new AnimationMixer(scene);
mixer.clipAction(animations[0]).play();
const seen = times.map((time) => {
    mixer.setTime(Number(time));
    scene.updateMatrixWorld(true);
    const joints = [];
    scene.traverse((mesh) => mesh.isSkinnedMesh && mesh.skeleton.bones.slice(0, -2).forEach((bone) => {
        const scale = new Vector3().setFromMatrixScale(bone.matrixWorld);
        if (scale.x > 0) {
            const { x, y, z } = new Vector3().setFromMatrixPosition(bone.matrixWorld);
            joints.push({ mesh: mesh.name, place: [x, y, z], size: Math.cbrt(scale.x * scale.y * scale.z) });
        }
    }));
    return joints;
});
process.stdout.write(JSON.stringify(seen));

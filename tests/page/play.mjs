// SPDX-License-Identifier: GPL-3.0-or-later
// Loads a GLB file in three.js and prints its morph targets and the state of its animation at every frame.
//
//   node play.mjs THREE_FOLDER FRAMES_PER_SECOND FRAMES FILE
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [folder, rate, frames, file] = process.argv.slice(2);
const module = (path) => import(pathToFileURL(`${folder}/${path}`).href);
globalThis.self = globalThis;
const { AnimationMixer, Vector3 } = await module('build/three.module.js');
const { GLTFLoader } = await module('examples/jsm/loaders/GLTFLoader.js');

const bytes = readFileSync(file);
const gltf = await new GLTFLoader().parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), '');
const meshes = [];
gltf.scene.traverse((object) => object.isMesh && meshes.push(object));
const seen = {
    meshes: meshes.map((mesh) => ({
        targets: mesh.morphTargetDictionary ?? {},
        influences: mesh.morphTargetInfluences ?? [],
        extras: mesh.userData,
        relative: mesh.geometry.morphTargetsRelative,
    })),
    clips: gltf.animations.length,
    frames: [],
};
if (seen.clips > 0) {
    const mixer = new AnimationMixer(gltf.scene);
    mixer.clipAction(gltf.animations[0]).play();
    for (let frame = 0; frame < Number(frames); ++frame) {
        mixer.setTime((frame + 0.01) / Number(rate));
        const shown = meshes.filter((mesh) => {
            mesh.updateWorldMatrix(true, false);
            return new Vector3().setFromMatrixScale(mesh.matrixWorld).x > 0;
        });
        seen.frames.push(shown.map((mesh) => ({ name: mesh.name, influences: [...(mesh.morphTargetInfluences ?? [])] })));
    }
}
process.stdout.write(JSON.stringify(seen));

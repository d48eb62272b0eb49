// SPDX-License-Identifier: GPL-3.0-or-later
// Plays the droplets of `windshield --animation` and of `flow` in three.js, from node animations or from a texture (one
// draw call).
import { AnimationMixer, InstancedBufferGeometry, NoColorSpace, PropertyBinding, Sphere, Vector3 } from 'three';

const kVertex = /* glsl */ `
uniform sampler2D droplets;
uniform float moment;  // [frames]
uniform vec3 low, high;
uniform float smallest, largest;
uniform int columns, frames;

struct Droplet { vec3 place; vec4 turn; vec2 size; };

Droplet dropletAt(int frame) {
    ivec2 first = ivec2(4 * (gl_InstanceID % columns), frame + frames * (gl_InstanceID / columns));
    vec3 bytes[4];
    for (int i = 0; i < 4; ++i) {
        bytes[i] = floor(255.0 * texelFetch(droplets, first + ivec2(i, 0), 0).rgb + 0.5);
    }
    vec3 upper = vec3(bytes[0].x, bytes[0].z, bytes[1].y);
    vec3 lower = vec3(bytes[0].y, bytes[1].x, bytes[1].z);
    vec2 steps = bytes[3].yz;
    return Droplet(mix(low, high, (256.0 * upper + lower) / 65535.0),
        normalize(vec4(bytes[2], bytes[3].x) / 127.5 - 1.0),
        steps.x > 0.0 ? smallest * pow(vec2(largest / smallest), (steps - 1.0) / 254.0) : vec2(0.0));
}

Droplet dropletNow() {
    Droplet now = dropletAt(int(moment));
    Droplet next = dropletAt(min(int(moment) + 1, frames - 1));
    if (now.size.x > 0.0 && next.size.x > 0.0) {  // otherwise the droplet does not change until the next frame
        float share = fract(moment);
        now.place = mix(now.place, next.place, share);
        now.turn = normalize(mix(now.turn, dot(now.turn, next.turn) < 0.0 ? -next.turn : next.turn, share));
        now.size = mix(now.size, next.size, share);
    }
    return now;
}

vec3 turned(vec4 turn, vec3 v) {
    vec3 t = 2.0 * cross(turn.xyz, v);
    return v + turn.w * t + cross(turn.xyz, t);
}
`;

/** Plays node animations. three.js searches the whole scene for every track, which takes seconds; a map is faster. */
function playJoints({ scene, animations: [clip] }) {
    const objects = new Map();
    scene.traverse((object) => objects.set(object.uuid, object).set(object.name, object));
    const { findNode } = PropertyBinding;
    PropertyBinding.findNode = (root, name) => objects.get(name) ?? findNode(root, name);
    const mixer = new AnimationMixer(scene);
    mixer.clipAction(clip).play();
    PropertyBinding.findNode = findNode;
    return { show: (seconds) => mixer.setTime(seconds), duration: clip.duration };
}

/**
 * Makes the droplets of a loaded model visible.
 * @param gltf  what GLTFLoader returns; its scene is changed
 * @return      `show`, a function of the time [s], and `duration` [s]
 */
export async function playDroplets(gltf) {
    if (gltf.animations.length > 0) {
        return playJoints(gltf);
    }
    const mesh = gltf.scene.getObjectByName('droplets');
    const about = mesh.userData;
    if (about.texture === undefined) {
        return { show: () => {}, duration: 0 };  // no animation
    }
    const texture = await gltf.parser.getDependency('texture', about.texture);
    texture.colorSpace = NoColorSpace;
    texture.generateMipmaps = false;
    const low = new Vector3(...about.low_m);
    const high = new Vector3(...about.high_m);
    const moment = { value: 0 };

    const geometry = new InstancedBufferGeometry().copy(mesh.geometry);
    geometry.instanceCount = about.slots;
    geometry.boundingSphere = new Sphere(low.clone().lerp(high, 0.5), low.distanceTo(high));
    mesh.geometry = geometry;
    mesh.scale.set(1, 1, 1);
    mesh.material = mesh.material.clone();
    mesh.material.onBeforeCompile = (shader) => {
        Object.assign(shader.uniforms, {
            droplets: { value: texture }, moment, low: { value: low }, high: { value: high },
            smallest: { value: about.smallest_m }, largest: { value: about.largest_m },
            columns: { value: about.columns }, frames: { value: about.frames },
        });
        shader.vertexShader = shader.vertexShader
            .replace('void main() {', `${kVertex}\nvoid main() {\nDroplet droplet = dropletNow();`)
            .replace('#include <beginnormal_vertex>',
                'vec3 objectNormal = turned(droplet.turn, normal / max(droplet.size.xyy, 1e-9));')
            .replace('#include <begin_vertex>',
                'vec3 transformed = droplet.place + turned(droplet.turn, position * droplet.size.xyy);');
    };
    return {
        show: (seconds) => {
            moment.value = Math.min(Math.max(seconds * about.frames_per_second, 0), about.frames - 1);
        },
        duration: about.frames / about.frames_per_second,
    };
}

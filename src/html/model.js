// SPDX-License-Identifier: MIT
// The droplet in the page: its bytes, its mesh and its fill.
import { AnimationMixer, Box3, TextureLoader, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { liquidTriangles } from './liquid_triangles.js';

export function decodeBase64(text) {
    if (Uint8Array.fromBase64) {
        return Uint8Array.fromBase64(text);
    }
    const binary = atob(text);
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; ++i) {
        bytes[i] = binary.charCodeAt(i);
    }
    return bytes;
}

/** Reads a GLB without fetching anything. */
export function loadGlb(bytes) {
    // Pictures are loaded as elements, because the page's policy forbids to fetch anything, even from its own memory.
    const byElements = (parser) => {
        parser.textureLoader = new TextureLoader();
        return { name: 'pictures by elements' };
    };
    return new GLTFLoader().register(byElements).parseAsync(bytes.buffer, '');
}

export async function loadDroplet(bytes) {
    const gltf = await loadGlb(bytes);
    return new Droplet(gltf.scene, gltf.animations[0]);
}

/** Triangles of the liquid's surface, and its rim: the edges of only one such triangle. */
function sheetOf(geometry, place, flat) {
    const triangles = liquidTriangles(geometry, place, flat);
    const { count } = geometry.attributes.position;
    const edges = new Map();
    for (let i = 0; i < triangles.length; i += 3) {
        for (let k = 0; k < 3; ++k) {
            const [from, to] = [triangles[i + k], triangles[i + (k + 1) % 3]];
            if (!edges.delete(to * count + from)) {
                edges.set(from * count + to, [from, to]);
            }
        }
    }
    return { triangles, edges: [...edges.values()].flat() };
}

/** The meshes of a file, and the morph target that fills and drains them, or the animation that plays them. */
class Droplet {
    constructor(scene, clip) {
        this.scene = scene;
        this.meshes = [];
        if (clip) {
            scene.traverse((object) => object.isMesh && object.scale.setScalar(1));  // hidden meshes have scale 0
        }
        scene.updateMatrixWorld(true);
        scene.traverse((object) => object.isMesh && this.meshes.push(object));
        this.places = this.meshes.map((mesh) => mesh.matrixWorld.clone());  // in the file's metres
        this.range = this.#fillRange();
        this.fills = this.#fills();
        if (clip) {
            this.duration = clip.duration;
            this.mixer = new AnimationMixer(scene);
            this.mixer.clipAction(clip).play();
            this.time = 0;
        }
    }

    /** Sets the time of an animation [s], from 0 to its duration. */
    set time(seconds) {
        this.mixer.setTime(Math.min(seconds, 0.9999 * this.duration));  // at the end it would restart
        for (const mesh of this.meshes) {
            mesh.visible = mesh.scale.x > 0;
        }
    }

    /** Minimum and maximum fill, in multiples of the volume; undefined if the fill cannot change. */
    #fillRange() {
        const names = (mesh) => Object.keys(mesh.morphTargetDictionary ?? {});
        if (!this.meshes.length ||
            !this.meshes.every((mesh) => names(mesh).length > 0 && names(mesh).every((name) => name.startsWith('volume')))) {
            return undefined;
        }
        // The mesh's extras are on its object, or on the group of its primitives.
        const [low, high] = this.#extra('fill_range') ?? [0, 2];
        return Number.isFinite(low) && Number.isFinite(high) && low < high ? [low, high] : [0, 2];
    }

    /** An array in the mesh's extras; those are on its object, or on the group of its primitives. */
    #extra(name) {
        return this.meshes.map((mesh) => mesh.userData[name] ?? mesh.parent?.userData[name]).find(Array.isArray);
    }

    /** Fill of every morph target; one target called `volume` is fill 2. */
    #fills() {
        return this.range ? this.#extra('fills') ?? [2] : [];
    }

    /** Weights of the morph targets at a fill: between neighbouring fills, of which 1 is one, the droplet is affine. */
    weights(amount) {
        if (!this.range) {
            return [];
        }
        const full = this.fills.filter((fill) => fill < 1).length;
        const fills = [...this.fills.slice(0, full), 1, ...this.fills.slice(full)];
        const inner = fills.slice(1, -1).filter((fill) => fill <= amount).length;
        const part = (amount - fills[inner]) / (fills[inner + 1] - fills[inner]);
        const weights = fills.map((_, k) => (k === inner ? 1 - part : k === inner + 1 ? part : 0));
        return weights.filter((_, k) => k !== full);
    }

    set fill(amount) {
        for (const mesh of this.meshes) {
            if (this.range) {
                this.weights(amount).forEach((weight, k) => { mesh.morphTargetInfluences[k] = weight; });
            }
            mesh.visible = amount > 0.002;  // an empty droplet is not drawn
        }
    }

    /**
     * Measures the mesh at a fill: the liquid's area [m²] and, on flat ground, contact angles along the rim [°].
     */
    measure(fill, flat) {
        let area = 0;
        let weighted = 0;
        let rim = 0;
        let [min, max] = [Infinity, -Infinity];
        const change = new Vector3();
        this.sheets ??= this.meshes.map((mesh, index) => sheetOf(mesh.geometry, this.places[index], flat));
        const weights = this.weights(fill);
        for (const [index, { geometry }] of this.meshes.entries()) {
            const at = (name, vertex, to) => {
                to.fromBufferAttribute(geometry.attributes[name], vertex);
                weights.forEach((weight, k) => {
                    if (weight !== 0) {
                        to.addScaledVector(change.fromBufferAttribute(geometry.morphAttributes[name][k], vertex), weight);
                    }
                });
                return to;
            };
            const place = (vertex, to) => at('position', vertex, to).applyMatrix4(this.places[index]);
            const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
            const { triangles, edges } = this.sheets[index];
            for (let i = 0; i < triangles.length; i += 3) {
                place(triangles[i], a);
                area += place(triangles[i + 1], b).sub(a).cross(place(triangles[i + 2], c).sub(a)).length() / 2;
            }
            for (let i = 0; i < edges.length && flat; i += 2) {
                const along = place(edges[i + 1], b).clone().sub(place(edges[i], a));
                const length = along.length();
                const ends = [edges[i], edges[i + 1]].map((vertex) => {
                    const { x, y, z } = at('normal', vertex, c);
                    // The liquid lies left of the edge; its normal points outward unless it sinks into the ground.
                    return Math.sign(z * along.x - x * along.z) * Math.atan2(Math.hypot(x, z), y);
                });
                weighted += length * (ends[0] + ends[1]) / 2;
                rim += length;
                min = Math.min(min, ...ends);
                max = Math.max(max, ...ends);
            }
        }
        const degrees = 180 / Math.PI;
        return {
            area_m2: area,
            contact_angle_deg: rim > 0 ? { min: min * degrees, mean: weighted / rim * degrees, max: max * degrees } : null,
        };
    }

    /** Box around the droplet at all of these fills and at all times [m]. */
    box(fills) {
        const box = new Box3();
        const point = new Vector3();
        for (const [index, mesh] of this.meshes.entries()) {
            const { position } = mesh.geometry.attributes;
            const moves = this.mixer ? mesh.geometry.morphAttributes.position ?? [] : [];
            const changes = fills.map((fill) => this.weights(fill)
                .map((weight, k) => ({ weight, change: mesh.geometry.morphAttributes.position[k] }))
                .filter(({ weight }) => weight !== 0));
            for (let i = 0; i < position.count; ++i) {
                for (const move of moves) {
                    point.fromBufferAttribute(position, i);
                    point.set(point.x + move.getX(i), point.y + move.getY(i), point.z + move.getZ(i));
                    box.expandByPoint(point.applyMatrix4(this.places[index]));
                }
                for (const parts of changes) {
                    point.fromBufferAttribute(position, i);
                    for (const { weight, change } of parts) {
                        point.x += weight * change.getX(i);
                        point.y += weight * change.getY(i);
                        point.z += weight * change.getZ(i);
                    }
                    box.expandByPoint(point.applyMatrix4(this.places[index]));
                }
            }
        }
        return box;
    }
}

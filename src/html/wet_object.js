// SPDX-License-Identifier: MIT
// An object with droplets that run over it, and their streaks, from a file of `droplet-shape flow`, as the stage wants a droplet
// (model.js).
import { AnimationMixer, Box3, Matrix4, Quaternion, Vector3 } from 'three';
import { CoveredObject, spaceOf } from './covered_object.js';
import { Copy, Crowd } from './crowd.js';
import { glbPieces, numbersIn, partsOf } from './glb.js';
import { loadGlb } from './model.js';
import { Streaks } from './streaks.js';
import { Track } from './track.js';

const kPoses = 32;  // of an object that moves, in which its space is measured
const kShort = 1 / 32767;  // of a normalised number of 16 bits

/** What a file has: the object as a file of its own, crowds and streaks. */
class Film {
    constructor(bytes) {
        Object.assign(this, partsOf(bytes));
        const { nodes, skins = [], animations = [] } = this.json;
        this.parents = new Map(nodes.flatMap(({ children = [] }, number) => children.map((child) => [child, number])));
        this.tracks = this.#tracksOf(animations[0]);
        this.root = nodes.findIndex(({ name }) => name === 'droplets');
        this.wetted = nodes.findIndex(({ name }) => name === 'streaks');
        const joints = new Set(skins.flatMap((skin) => skin.joints));
        const parts = new Set([...joints, ...nodes[this.wetted]?.children ?? []]);
        this.object = this.#objectAlone(parts);
    }

    #numbers(accessor) {
        return numbersIn(this.json, this.binary, accessor);
    }

    /** Tracks of all nodes: by node, then by what changes. */
    #tracksOf({ channels, samplers } = { channels: [], samplers: [] }) {
        const tracks = new Map();
        for (const { sampler, target: { node, path } } of channels) {
            const { input, output, interpolation } = samplers[sampler];
            const stored = this.#numbers(output);
            const values = stored instanceof Int16Array ? Float32Array.from(stored, (number) => number * kShort) : stored;
            const times = this.#numbers(input);
            const own = tracks.get(node) ?? tracks.set(node, {}).get(node);
            own[path] = new Track(times, values, values.length / times.length, interpolation === 'STEP');
        }
        return tracks;
    }

    /** The file without droplets and streaks, which three.js would make objects of. */
    #objectAlone(parts) {
        const { json } = this;
        const stays = (node) => !parts.has(node) && json.nodes[node].skin === undefined;
        const nodes = json.nodes.map(({ children, ...node }) => ({ ...node, ...children && { children: children.filter(stays) } }));
        const scenes = json.scenes.map((scene) => ({ ...scene, nodes: scene.nodes.filter(stays) }));
        const animations = (json.animations ?? [])
            .map((animation) => ({ ...animation, channels: animation.channels.filter(({ target }) => !parts.has(target.node)) }))
            .filter(({ channels }) => channels.length > 0);
        const pieces = glbPieces({ ...json, nodes, scenes, animations, skins: undefined }, [this.binary]);
        const bytes = new Uint8Array(pieces.reduce((sum, piece) => sum + piece.length, 0));
        pieces.reduce((at, piece) => {
            bytes.set(piece, at);
            return at + piece.length;
        }, 0);
        return bytes;
    }

    #geometryOf(mesh) {
        const { attributes, indices, targets = [] } = this.json.meshes[mesh].primitives[0];
        const changes = targets.map(({ POSITION, NORMAL }) => ({ positions: this.#numbers(POSITION), normals: this.#numbers(NORMAL) }));
        const joints = attributes.JOINTS_0 === undefined ? {} : { joints: this.#numbers(attributes.JOINTS_0) };
        return { positions: this.#numbers(attributes.POSITION), normals: this.#numbers(attributes.NORMAL), triangles: this.#numbers(indices), targets: changes, ...joints };
    }

    materialOf(mesh) {
        return this.json.meshes[mesh].primitives[0].material;
    }

    /** From a node's parent to the node of all droplets; undefined if it does not belong to it. */
    #frameOf(node) {
        const frame = new Matrix4();
        for (let at = this.parents.get(node); at !== this.root; at = this.parents.get(at)) {
            if (at === undefined) {
                return undefined;
            }
            const { translation = [0, 0, 0], rotation = [0, 0, 0, 1], scale = [1, 1, 1] } = this.json.nodes[at];
            frame.premultiply(new Matrix4().compose(new Vector3(...translation), new Quaternion(...rotation), new Vector3(...scale)));
        }
        return frame;
    }

    /** Meshes of all crowds with their copies, by the crowd's name, as Crowd takes them. */
    crowds() {
        const { nodes, skins } = this.json;
        const crowds = new Map();
        const meshes = new Map();
        for (const { name, mesh, skin } of nodes.filter((node) => node.skin !== undefined)) {
            const copies = skins[skin].joints.map((joint) => {
                const frame = this.#frameOf(joint);
                return frame && new Copy(nodes[joint], this.tracks.get(joint) ?? {}, frame);
            });
            const geometry = meshes.get(mesh) ?? meshes.set(mesh, this.#geometryOf(mesh)).get(mesh);
            const crowd = crowds.get(name) ?? crowds.set(name, { parts: [], mesh }).get(name);
            crowd.parts.push({ mesh: geometry, copies });
        }
        return [...crowds.values()];
    }

    /** Parts of the streaks, those that were wetted earlier first, as Streaks takes them. */
    streaks() {
        const { nodes } = this.json;
        const begin = ({ track }) => (track ? track.times[track.values.findIndex((value) => value > 0) / track.size] : 0);
        return (nodes[this.wetted]?.children ?? [])
            .map((node) => ({ ...this.#geometryOf(nodes[node].mesh), mesh: nodes[node].mesh, track: this.tracks.get(node)?.scale }))
            .sort((a, b) => begin(a) - begin(b));
    }
}

/** Box around meshes at all times of an animation. */
function spaceOver(scene, meshes, mixer, duration) {
    const space = new Box3();
    for (let k = 0; k < kPoses; ++k) {
        mixer.setTime(duration * k / kPoses);
        scene.updateMatrixWorld(true);
        meshes.forEach((mesh) => {
            if (mesh.morphTargetInfluences) {
                space.expandByObject(mesh, true);  // the box of its geometry holds shapes that it never has
            } else {
                space.union(spaceOf([mesh]));
            }
        });
    }
    return space;
}

export class WetObject extends CoveredObject {
    /**
     * Reads a file of `droplet-shape flow`.
     * @param duration  of the animation [s], as far as its frames go
     */
    static async load(bytes, duration) {
        const film = new Film(bytes);
        const { scene, parser, animations: [clip] } = await loadGlb(film.object);
        const nodeOf = (number) => {
            let found = scene;
            scene.traverse((object) => {
                found = parser.associations.get(object)?.nodes === number ? object : found;
            });
            return found;
        };
        const own = [];
        scene.traverse((mesh) => mesh.isMesh && own.push(mesh));
        const mixer = clip && new AnimationMixer(scene);
        mixer?.clipAction(clip).play();
        const space = mixer && spaceOver(scene, own, mixer, clip.duration);
        const parts = [];
        const weights = own.find(({ morphTargetInfluences }) => morphTargetInfluences)?.morphTargetInfluences;
        const add = async (Part, list, mesh, parent) => {
            const part = new Part(list, await parser.getDependency('material', film.materialOf(mesh)), weights);
            nodeOf(parent).add(part.mesh);
            parts.push(part);
        };
        for (const { parts: list, mesh } of film.crowds()) {
            await add(Crowd, list, mesh, film.root);
        }
        const streaks = film.streaks();
        if (streaks.length > 0) {
            await add(Streaks, streaks, streaks[0].mesh, film.wetted);
        }
        return new WetObject(scene, own, { parts, mixer, clip, duration, space });
    }

    /** @param moving  of load(): what changes over time, and for how long */
    constructor(scene, own, { parts, mixer, clip, duration, space }) {
        super(scene, (mesh) => own.includes(mesh), space);
        Object.assign(this, { parts, mixer, clip, duration });
        this.time = 0;
    }

    /** Whether what casts light and shadow on the ground is the same at all times. */
    get castsTheSame() {
        return !this.mixer;
    }

    /** Sets the time [s]. */
    set time(seconds) {
        this.mixer?.setTime(Math.min(seconds, 0.9999 * this.clip.duration));  // at the end it would restart
        this.parts.forEach((part) => part.show(seconds));
    }
}

// SPDX-License-Identifier: MIT
// A GLB of a droplet at another fill, without a slider: what a program reads that knows no morph targets.
import { glbPieces, numbersIn, partsOf } from './glb.js';

/** Moves numbers by the morph targets, in place. */
function morph(numbers, targets, weights) {
    targets.forEach((target, k) => {
        if (weights[k] !== 0) {
            target.forEach((change, i) => { numbers[i] += weights[k] * change; });
        }
    });
}

function toUnitLength(normals) {
    for (let i = 0; i < normals.length; i += 3) {
        const length = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
        for (let k = 0; k < 3; ++k) {
            normals[i + k] /= length;
        }
    }
}

/** Least and greatest of every component. */
function bounds(numbers) {
    const [min, max] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
    numbers.forEach((value, i) => {
        min[i % 3] = Math.min(min[i % 3], value);
        max[i % 3] = Math.max(max[i % 3], value);
    });
    return { min, max };
}

/** Drops the views of the buffer that nothing uses, and numbers the others anew. */
function compact(json, binary) {
    const parts = [];
    let size = 0;
    const views = new Map();
    const moved = (old) => {
        if (!views.has(old)) {
            const view = json.bufferViews[old];
            const begin = view.byteOffset ?? 0;
            const padded = size + (4 - size % 4) % 4;
            parts.push(new Uint8Array(padded - size), binary.subarray(begin, begin + view.byteLength));
            size = padded + view.byteLength;
            views.set(old, { number: views.size, view: { ...view, byteOffset: padded } });
        }
        return views.get(old).number;
    };
    for (const holder of [...json.accessors, ...json.images ?? []]) {
        if (holder.bufferView !== undefined) {
            holder.bufferView = moved(holder.bufferView);
        }
    }
    json.bufferViews = [...views.values()].map(({ view }) => view);
    json.buffers = [{ byteLength: size }];
    return parts;
}

/** Drops the accessors that no primitive uses. */
function dropAccessors(json) {
    const kept = new Map();
    const number = (old) => kept.get(old) ?? kept.set(old, kept.size).get(old);
    for (const { primitives } of json.meshes) {
        for (const primitive of primitives) {
            primitive.indices = number(primitive.indices);
            for (const [name, accessor] of Object.entries(primitive.attributes)) {
                primitive.attributes[name] = number(accessor);
            }
        }
    }
    json.accessors = [...kept.keys()].map((old) => json.accessors[old]);
}

/**
 * The file of a droplet as it is at another fill: its vertices are moved, and it has no morph targets.
 * @param bytes    of a GLB that is not compressed
 * @param fill     in multiples of the file's volume
 * @param weights  of the morph targets at that fill
 * @return         a blob
 */
export function filledGlb(bytes, fill, weights) {
    const { json, binary } = partsOf(bytes.slice());  // a copy, since its numbers change
    const numbersOf = (accessor) => numbersIn(json, binary, accessor);
    const done = new Set();  // primitives may share vertices
    for (const mesh of json.meshes) {
        for (const primitive of mesh.primitives) {
            for (const name of ['POSITION', 'NORMAL']) {
                const accessor = primitive.attributes[name];
                if (!primitive.targets || done.has(accessor)) {
                    continue;
                }
                done.add(accessor);
                const numbers = numbersOf(accessor);
                morph(numbers, primitive.targets.map((target) => numbersOf(target[name])), weights);
                if (name === 'NORMAL') {
                    toUnitLength(numbers);
                } else {
                    Object.assign(json.accessors[accessor], bounds(numbers));
                }
            }
        }
    }
    for (const mesh of json.meshes) {
        mesh.primitives.forEach((primitive) => {
            delete primitive.targets;
            delete primitive.attributes._CONTACT_ANGLE;  // of the file's fill
        });
        delete mesh.weights;
        delete mesh.extras;  // names and fills of the targets
    }
    for (const { extensions } of json.materials ?? []) {
        const volume = extensions?.KHR_materials_volume;
        if (volume) {
            volume.thicknessFactor *= fill;
        }
    }
    for (const { extras } of json.nodes) {
        if (extras?.volume_m3 !== undefined) {
            extras.volume_m3 *= fill;
            ['contact_angle_deg', 'height_max_m', 'pressure_pa'].forEach((name) => { delete extras[name]; });
        }
    }
    dropAccessors(json);
    return new Blob(glbPieces(json, compact(json, binary)), { type: 'model/gltf-binary' });
}

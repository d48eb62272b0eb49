// SPDX-License-Identifier: MIT
// A GLB of a droplet at another fill, without a slider: what a program reads that knows no morph targets.

const kBinary = 0x004e4942;
const kParts = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };

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

function file(json, parts) {
    const text = new TextEncoder().encode(JSON.stringify(json));
    const chunk = (kind, pieces, fill) => {
        const size = pieces.reduce((sum, piece) => sum + piece.length, 0);
        const padding = new Uint8Array((4 - size % 4) % 4).fill(fill);
        return [new Uint8Array(new Uint32Array([size + padding.length, kind]).buffer), ...pieces, padding];
    };
    const body = [...chunk(0x4e4f534a, [text], 0x20), ...chunk(kBinary, parts, 0)];
    const total = body.reduce((sum, piece) => sum + piece.length, 12);
    return new Blob([new Uint8Array(new Uint32Array([0x46546c67, 2, total]).buffer), ...body], { type: 'model/gltf-binary' });
}

/**
 * The file of a droplet as it is at another fill: its vertices are moved, and it has no morph targets.
 * @param bytes    of a GLB that is not compressed
 * @param fill     in multiples of the file's volume
 * @param weights  of the morph targets at that fill
 * @return         a blob
 */
export function filledGlb(bytes, fill, weights) {
    const words = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const length = words.getUint32(12, true);
    const json = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length)));
    const binary = bytes.slice(28 + length);  // a copy, in a buffer of its own
    const numbersOf = (accessor) => {
        const { bufferView, byteOffset = 0, count, type } = json.accessors[accessor];
        return new Float32Array(binary.buffer, (json.bufferViews[bufferView].byteOffset ?? 0) + byteOffset, count * kParts[type]);
    };
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
    return file(json, compact(json, binary));
}

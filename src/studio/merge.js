// SPDX-License-Identifier: MIT
// Joins the files of several layers into one.
import { joined } from '../../npm/bytes.js';
import { glbPieces, partsOf } from '../html/glb.js';

const kDroplet = 'droplet';  // name of the droplets' node and mesh in a file

/**
 * Joins GLB files of one scene each; the droplets' nodes and meshes get the layers' names. The first file may have the object that all
 * droplets lie on, with its pictures: then all are below its node.
 */
function mergeGlb(files, names) {
    const whole = { asset: undefined, scene: 0, scenes: [{ nodes: [] }], buffers: [{}], extensionsUsed: [] };
    const lists = ['accessors', 'bufferViews', 'materials', 'meshes', 'nodes'];
    lists.forEach((list) => { whole[list] = []; });
    const binaries = [];
    let bytes = 0;
    files.forEach((file, which) => {
        const { json, binary } = partsOf(file);
        const first = Object.fromEntries(lists.map((list) => [list, whole[list].length]));
        const at = bytes;
        whole.asset ??= json.asset;
        whole.extensionsUsed = [...new Set([...whole.extensionsUsed, ...json.extensionsUsed ?? []])];
        whole.bufferViews.push(...json.bufferViews.map((view) => ({ ...view, byteOffset: (view.byteOffset ?? 0) + at })));
        whole.accessors.push(...json.accessors.map((each) => ({ ...each, bufferView: each.bufferView + first.bufferViews })));
        whole.materials.push(...json.materials);
        for (const list of ['images', 'textures', 'samplers']) {
            if (json[list]) {
                whole[list] = json[list];  // of the first file, whose indices stay
            }
        }
        whole.meshes.push(...json.meshes.map((mesh) => ({
            ...mesh, name: mesh.name === kDroplet ? names[which] : mesh.name,
            primitives: mesh.primitives.map((primitive) => ({
                ...primitive,
                attributes: Object.fromEntries(Object.entries(primitive.attributes).map(([name, k]) => [name, k + first.accessors])),
                indices: primitive.indices + first.accessors, material: primitive.material + first.materials,
            })),
        })));
        whole.nodes.push(...json.nodes.map((node) => ({
            ...node, name: node.name === kDroplet ? names[which] : node.name, mesh: node.mesh + first.meshes,
            ...node.children && { children: node.children.map((k) => k + first.nodes) },
        })));
        const object = whole.nodes[0].children;
        (which > 0 && object ? object : whole.scenes[0].nodes).push(...json.scenes[0].nodes.map((k) => k + first.nodes));
        const padded = new Uint8Array(Math.ceil(binary.length / 4) * 4);
        padded.set(binary);
        binaries.push(padded);
        bytes += padded.length;
    });
    whole.buffers[0].byteLength = bytes;
    if (whole.extensionsUsed.length === 0) {
        delete whole.extensionsUsed;
    }
    return joined(glbPieces(whole, binaries));
}

/** Joins OBJ files: indices of later files follow those of earlier ones. */
function mergeObj(files, names) {
    const counts = { v: 0, vt: 0, vn: 0 };
    const lines = [];
    files.forEach((file, which) => {
        const before = { ...counts };
        for (const line of new TextDecoder().decode(file).split('\n')) {
            const [word, ...rest] = line.split(' ');
            if (word in counts) {
                ++counts[word];
            }
            if (word === 'f') {
                lines.push(`f ${rest.map((corner) => corner.split('/').map((index, k) =>
                    (index === '' ? '' : Number(index) + [before.v, before.vt, before.vn][k])).join('/')).join(' ')}`);
            } else if (word === 'o') {
                lines.push(`o ${names[which].replace(/\s+/g, '_')}`);
            } else if (!(which > 0 && word === '#') && line !== '') {
                lines.push(line);
            }
        }
    });
    return new TextEncoder().encode(`${lines.join('\n')}\n`);
}

/** Joins binary STL files: an 80-byte head, the number of triangles, 50 bytes for each. */
function mergeStl(files) {
    const head = files[0].slice(0, 84);
    const bodies = files.map((file) => file.subarray(84));
    new DataView(head.buffer).setUint32(80, bodies.reduce((sum, { length }) => sum + length / 50, 0), true);
    return joined([head, ...bodies]);
}

/** One file of several; a single file keeps its bytes. */
export function merged(format, files, names) {
    return files.length === 1 ? files[0] : { glb: mergeGlb, obj: mergeObj, stl: mergeStl }[format](files, names);
}

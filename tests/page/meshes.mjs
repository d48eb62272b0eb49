// SPDX-License-Identifier: GPL-3.0-or-later
// Loads a GLB, USDA or USDZ file in three.js and prints its meshes as they stand in the world, each material's part of
// them for itself.
//
//   node meshes.mjs THREE_FOLDER FILE
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [folder, file] = process.argv.slice(2);
const module = (path) => import(pathToFileURL(`${folder}/${path}`).href);
globalThis.self = globalThis;
// Pictures are not decoded.
globalThis.document = { createElementNS: () => ({ addEventListener() {}, removeEventListener() {} }) };
const { Matrix3, Vector3 } = await module('build/three.module.js');

async function load() {
    const bytes = readFileSync(file);
    const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
    if (!file.endsWith('.glb')) {
        const { USDLoader } = await module('examples/jsm/loaders/USDLoader.js');
        return new USDLoader().parse(buffer);
    }
    const { GLTFLoader } = await module('examples/jsm/loaders/GLTFLoader.js');
    const { MeshoptDecoder } = await module('examples/jsm/libs/meshopt_decoder.module.js');
    return (await new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).parseAsync(buffer, '')).scene;
}

/// Edges without a triangle on the other side, with vertices at one place welded.
function openEdges(triangles) {
    const edges = new Map();
    for (const corners of triangles) {
        corners.forEach((corner, k) => {
            const key = `${corner}>${corners[(k + 1) % 3]}`;
            edges.set(key, (edges.get(key) ?? 0) + 1);
        });
    }
    return [...edges].filter(([key, count]) => count !== edges.get(key.split('>').reverse().join('>'))).length;
}

function describe(mesh, material, corners) {
    const { position, normal, uv } = mesh.geometry.attributes;
    const turn = new Matrix3().getNormalMatrix(mesh.matrixWorld);
    const at = (i) => new Vector3().fromBufferAttribute(position, i).applyMatrix4(mesh.matrixWorld);
    const places = corners.map(at);
    const names = places.map((place) => place.toArray().join());
    const triangles = [];
    let volume = 0;
    let outward = 1;
    for (let i = 0; i < corners.length; i += 3) {
        const [a, b, c] = places.slice(i, i + 3);
        volume += a.dot(b.clone().cross(c)) / 6;
        const facet = b.clone().sub(a).cross(c.clone().sub(a)).normalize();
        for (const corner of corners.slice(i, i + 3)) {
            const direction = new Vector3().fromBufferAttribute(normal, corner).applyMatrix3(turn).normalize();
            outward = Math.min(outward, direction.dot(facet));
        }
        triangles.push(names.slice(i, i + 3));
    }
    const xs = (axis) => places.map((place) => place[axis]);
    const sum = (attribute, k) => corners.reduce((total, i) => total + attribute.getComponent(i, k), 0) / corners.length;
    return {
        name: mesh.name,
        triangles: triangles.length,
        places: new Set(names).size,
        low: ['x', 'y', 'z'].map((axis) => xs(axis).reduce((a, b) => Math.min(a, b))),
        high: ['x', 'y', 'z'].map((axis) => xs(axis).reduce((a, b) => Math.max(a, b))),
        volume,
        outward,
        open_edges: openEdges(triangles),
        uv: [sum(uv, 0), sum(uv, 1)],
        material: {
            name: material.name,
            ior: material.ior,
            opacity: material.opacity,
            metalness: material.metalness,
            roughness: material.roughness,
            colour: material.color.toArray(),
            depth_colour: material.attenuationColor?.toArray(),
            has_picture: Boolean(material.map),
            // of the volume's thickness, as the shader scales it
            thickness: material.thickness * new Vector3().setFromMatrixScale(mesh.matrixWorld).x,
        },
    };
}

function parts(mesh) {
    mesh.updateWorldMatrix(true, false);
    const { geometry, material } = mesh;
    const corners = geometry.index ? [...geometry.index.array] : [...Array(geometry.attributes.position.count).keys()];
    return Array.isArray(material)
        ? geometry.groups.map(({ start, count, materialIndex }) => describe(mesh, material[materialIndex], corners.slice(start, start + count)))
        : [describe(mesh, material, corners)];
}

const meshes = [];
(await load()).traverse((object) => object.isMesh && meshes.push(...parts(object)));
process.stdout.write(JSON.stringify(meshes));

// SPDX-License-Identifier: MIT
// The object that the sheet's droplets lie on: as the view shows it, and how its texture is laid out on the sheet.
import { BufferAttribute, MeshStandardMaterial } from 'three';
import { CoveredObject } from '../html/covered_object.js';
import { loadGlb } from '../html/model.js';
import { say } from '../html/words.js';
import { blank, drawShape, whole } from './coverage.js';
import { boundsOf, largestPlace } from './largest_place.js';
import { mainOf } from './object_files.js';
import { placed } from './pictures.js';

const kRoom = 0.8;  // part of its place that a drawing takes

/** Whether the object among files can carry drawings: it states where its texture coordinates lie. */
export const carriesDrawings = (files) => /\.(glb|gltf)$/i.test(mainOf(files)?.name ?? '');

/** Gives a mesh what the view needs: an index, normals, and a material that light falls on. */
function complete(mesh) {
    const { geometry, material } = mesh;
    if (!geometry.index) {
        geometry.setIndex(new BufferAttribute(Uint32Array.from({ length: geometry.attributes.position.count }, (_, k) => k), 1));
    }
    if (!geometry.attributes.normal) {
        geometry.computeVertexNormals();
    }
    if (!material.isMeshStandardMaterial) {
        const { map, color, side } = material;
        mesh.material = new MeshStandardMaterial({ map, color, side });
    }
}

/** The object for the view. */
export async function loadObject({ name, data }) {
    try {
        const { scene } = await loadGlb(data);
        scene.traverse((node) => node.isMesh && complete(node));
        return new CoveredObject(scene, () => true);
    } catch (error) {
        console.error(error);
        throw new Error(say('{file} has no mesh that this browser can show', { file: name }));
    }
}

/** Traces the triangles of a mesh where they are on a sheet. */
function traceLayout(context, { index, attributes: { uv } }, width, height) {
    for (let i = 0; uv && i < index.count; i += 3) {
        for (const [k, act] of [[0, 'moveTo'], [1, 'lineTo'], [2, 'lineTo']]) {
            const vertex = index.getX(i + k);
            context[act](uv.getX(vertex) * width, uv.getY(vertex) * height);
        }
        context.closePath();
    }
}

/** The layout of an object's texture on a sheet, with its picture, as a data URL. */
export function layoutOf({ meshes }, width, height) {
    const canvas = Object.assign(document.createElement('canvas'), { width, height });
    const context = canvas.getContext('2d');
    context.strokeStyle = '#5b7f95';
    context.lineWidth = Math.max(width, height) / 1500;
    for (const { geometry, material } of meshes) {
        if (material.map?.image) {
            context.drawImage(material.map.image, 0, 0, width, height);
        }
        context.beginPath();
        traceLayout(context, geometry, width, height);
        context.stroke();
    }
    return canvas.toDataURL('image/png');
}

/** The masks of layers as they are if they lie within the layout of an object's texture, else moved and shrunk into it. */
export function withinLayout({ meshes }, masks) {
    const bounds = boundsOf(masks);
    const [{ width, height }] = masks;
    const cover = blank(width, height);
    drawShape(cover, whole(cover), (context) => {
        meshes.forEach(({ geometry }) => traceLayout(context, geometry, width, height));
        context.fill();
    }, false);
    if (!bounds || masks.every(({ data }) => data.every((coverage, i) => coverage < 128 || cover.data[i] >= 128))) {
        return masks;
    }
    const [wide, high] = [bounds.right - bounds.left, bounds.bottom - bounds.top];
    const place = largestPlace(cover, wide / high);
    if (!place) {
        return masks;
    }
    const scale = Math.min(1, kRoom * Math.min((place.right - place.left) / wide, (place.bottom - place.top) / high));
    const left = (place.left + place.right - scale * (bounds.left + bounds.right)) / 2;
    const top = (place.top + place.bottom - scale * (bounds.top + bounds.bottom)) / 2;
    return masks.map((mask) => placed(mask, width, height, { left, top, scale }));
}

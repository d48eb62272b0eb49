// SPDX-License-Identifier: MIT
// A project: a sheet with layers of liquid, and the physics. A plain value that is never written to; it is saved as JSON
// with masks as PNG.
import { decodeBase64 } from '../html/model.js';
import { say } from '../html/words.js';
import { blank } from './coverage.js';
import { kLayerFields, kSceneFields, settingsOf } from './physics.js';

const kFormat = 'droplet-shape.studio';
const kVersion = 1;
const kLargestSide = 4096;

/** Name of a project that has been given none. It is kept in English, as are the first names of layers, and shown in the user's language. */
export const kName = 'Droplet';

/** The name of a project or a layer as it is shown and named in files. */
export const shownName = (name) => (name === kName ? say('Droplet') : name.replace(/^Layer(?= \d+$)/, () => say('Layer')));

let next_id = 1;

export function newLayer(width, height, name, more = {}) {
    return { id: next_id++, name, visible: true, mask: blank(width, height), liquid: settingsOf(kLayerFields), ...more };
}

export function newProject({ width = 1024, height = 1024, name = kName } = {}) {
    return {
        name, width, height, scene: settingsOf(kSceneFields), ground: undefined, underlay: undefined, object: undefined,
        layers: [newLayer(width, height, 'Layer 1')], selected: 0,
    };
}

/** The object that the droplets lie on: {name, data, beside}, as of the solver; or undefined. */
export const objectBelow = ({ scene, object }) => (scene.ground === 'object' ? object : undefined);

export const selectedLayer = (project) => project.layers[project.selected];

/** The project with another value of the selected layer's. */
export function withLayer(project, change, index = project.selected) {
    return { ...project, layers: project.layers.map((layer, k) => (k === index ? { ...layer, ...change } : layer)) };
}

/** A mask as a picture whose transparency is dry; the command reads it as the same mask. */
export async function pictureOf({ width, height, data }) {
    const canvas = new OffscreenCanvas(width, height);
    const image = new ImageData(width, height);
    for (let i = 0; i < data.length; ++i) {
        image.data[4 * i + 3] = data[i];
    }
    canvas.getContext('2d').putImageData(image, 0, 0);
    return canvas.convertToBlob({ type: 'image/png' });
}

async function dataUrl(blob) {
    const bytes = new Uint8Array(await blob.arrayBuffer());
    let binary = '';
    for (let i = 0; i < bytes.length; i += 8192) {
        binary += String.fromCharCode(...bytes.subarray(i, i + 8192));
    }
    return `data:${blob.type};base64,${btoa(binary)}`;
}

/** Decodes a picture in a data: URL; nothing is fetched. */
export async function imageOf(url) {
    if (!/^data:image\/[a-z+]+;base64,/.test(url)) {
        throw new Error(say('a picture in it is not a data URL'));
    }
    const image = new Image();
    image.src = url;
    await image.decode();
    return image;
}

async function maskOf(url, width, height) {
    const image = await imageOf(url);
    if (image.naturalWidth !== width || image.naturalHeight !== height) {
        const [has, must] = [[image.naturalWidth, image.naturalHeight], [width, height]].map((sides) => sides.join(' × '));
        throw new Error(say('a mask has {has} pixels, must have {must}', { has, must }));
    }
    const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, width, height);
    const mask = blank(width, height);
    for (let i = 0; i < mask.data.length; ++i) {
        mask.data[i] = data[4 * i + 3];
    }
    return mask;
}

const saved_objects = new WeakMap();  // of bytes, which a project keeps through all its changes

/** An object as it is saved. */
async function textOfObject({ name, data }) {
    if (!saved_objects.has(data)) {
        saved_objects.set(data, await dataUrl(new Blob([data], { type: 'model/gltf-binary' })));
    }
    return { name, data: saved_objects.get(data) };
}

function objectOf({ name, data }) {
    const [, text] = /^data:model\/gltf-binary;base64,(.*)$/.exec(String(data)) ?? [];
    if (text === undefined) {
        throw new Error(say('its object is damaged'));
    }
    return { name: String(name), data: decodeBase64(text), beside: {} };
}

export async function textOf(project) {
    const { layers, object, ground, ...given } = project;
    // A ground of the user's own is a picture, which is not kept.
    const rest = { ...given, ...typeof ground === 'string' && { ground }, ...object && { object: await textOfObject(object) } };
    const saved = await Promise.all(layers.map(async ({ id, mask, ...layer }) => ({ ...layer, mask: await dataUrl(await pictureOf(mask)) })));
    return JSON.stringify({ format: kFormat, version: kVersion, ...rest, layers: saved }, null, 1);
}

const isSide = (value) => Number.isInteger(value) && value >= 1 && value <= kLargestSide;

/** Reads a saved project. Unknown keys are dropped, so a project is as plain after it as before. */
export async function projectOf(text) {
    let json;
    try {
        json = JSON.parse(text);
    } catch {
        throw new Error(say('it is not a project of Studio'));
    }
    if (json?.format !== kFormat) {
        throw new Error(say('it is not a project of Studio'));
    }
    if (json.version !== kVersion) {
        throw new Error(say('its version is {version}; this Studio reads version {known}', { version: json.version, known: kVersion }));
    }
    const { width, height, layers } = json;
    if (!isSide(width) || !isSide(height) || !Array.isArray(layers) || layers.length === 0) {
        throw new Error(say('its sides or layers are damaged'));
    }
    const underlay = json.underlay && { picture: String(json.underlay.picture), opacity: Number(json.underlay.opacity) || 0.4 };
    if (underlay) {
        await imageOf(underlay.picture);
    }
    const object = json.object && objectOf(json.object);
    const scene = settingsOf(kSceneFields, json.scene);
    return {
        name: String(json.name ?? kName), width, height, object,
        scene: scene.ground === 'object' && !object ? { ...scene, ground: 'flat' } : scene,
        ground: json.ground === undefined ? undefined : String(json.ground), underlay,
        layers: await Promise.all(layers.map(async (layer, k) => newLayer(1, 1, String(layer.name ?? `Layer ${k + 1}`), {
            visible: layer.visible !== false, liquid: settingsOf(kLayerFields, layer.liquid),
            mask: await maskOf(String(layer.mask), width, height),
        }))),
        selected: Number.isInteger(json.selected) && json.selected >= 0 && json.selected < layers.length ? json.selected : 0,
    };
}

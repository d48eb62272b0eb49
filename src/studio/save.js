// SPDX-License-Identifier: MIT
// What Studio saves.
import { download, fileStem } from '../html/controls.js';
import { say } from '../html/words.js';
import { merged } from './merge.js';
import { pageWith } from './page_file.js';
import { objectBelow, pictureOf, selectedLayer, shownName, textOf } from './project.js';
import { zipOf } from './zip.js';

const kTypes = { glb: 'model/gltf-binary', obj: 'model/obj', stl: 'model/stl' };

/** Files of several layers, each in a folder with the layer's name; those of a single layer as they are. */
function inFolders(lists, names) {
    if (lists.length === 1) {
        return lists[0];
    }
    return Object.fromEntries(lists.flatMap((files, k) => {
        const own = fileStem(names[k]);
        const folder = names.findIndex((name) => fileStem(name) === own) === k ? own : `${own} ${k + 1}`;
        return Object.entries(files).map(([name, bytes]) => [`${folder}/${name}`, bytes]);
    }));
}

/**
 * Saves a file and returns its name.
 * @param kind    glb, obj or stl; object: a glb that has the object with the droplets on it; maps, view, footprint, project or page
 * @param parts   {project, solver, view, drawn: layers that have a droplet, bottom first, source: of Studio's page}
 */
export async function save(kind, { project, solver, view, drawn, source }) {
    const stem = fileStem(shownName(project.name));
    if (kind === 'project') {
        const name = `${stem}.droplet.json`;
        download(new Blob([await textOf(project)], { type: 'application/json' }), name);
        return name;
    }
    if (kind === 'page') {
        const name = `${stem}.html`;
        download(new Blob([pageWith(source, await textOf(project))], { type: 'text/html' }), name);
        return name;
    }
    if (kind === 'view' || kind === 'footprint') {
        const picture = kind === 'view' ? await view.picture() : await pictureOf(selectedLayer(project).mask);
        const name = kind === 'view' ? `${stem}-view.png` : `${stem}.png`;
        download(picture, name);
        return name;
    }
    if (drawn.length === 0) {
        throw new Error(say('there is no droplet yet'));
    }
    const ids = drawn.map(({ id }) => id);
    const names = drawn.map((layer) => shownName(layer.name));
    if (kind === 'maps') {
        const name = `${stem}-maps.zip`;
        download(new Blob([zipOf(inFolders(await solver.maps(ids, `${stem}.png`), names))], { type: 'application/zip' }), name);
        return name;
    }
    const format = kind === 'object' ? 'glb' : kind;
    const files = await solver.files(ids, format, kind === 'object');
    const name = `${stem}${kind === 'glb' && objectBelow(project) ? '-droplets' : ''}.${format}`;
    download(new Blob([merged(format, files, names)], { type: kTypes[format] }), name);
    return name;
}

// SPDX-License-Identifier: MIT
// What Studio saves.
import { download, fileStem } from '../html/controls.js';
import { say } from '../html/words.js';
import { merged } from './merge.js';
import { pageWith } from './page_file.js';
import { pictureOf, selectedLayer, shownName, textOf } from './project.js';

const kTypes = { glb: 'model/gltf-binary', obj: 'model/obj', stl: 'model/stl' };

/**
 * Saves a file and returns its name.
 * @param kind    glb, obj, stl, view, footprint, project or page
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
    const files = await solver.files(drawn.map(({ id }) => id), kind);
    const name = `${stem}.${kind}`;
    download(new Blob([merged(kind, files, drawn.map((layer) => shownName(layer.name)))], { type: kTypes[kind] }), name);
    return name;
}

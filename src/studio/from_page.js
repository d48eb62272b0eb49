// SPDX-License-Identifier: MIT
// Studio in the page that --html writes.
import { loadDroplet } from '../html/model.js';
import { projectFromDroplet } from './from_droplet.js';
import { openStudio } from './studio.js';
import { unpackSolver } from './unpack.js';

/** Replaces the page by Studio with the page's droplet. */
export async function openInStudio(glb, report, title) {
    const [droplet, solver] = await Promise.all([loadDroplet(glb), unpackSolver()]);
    return openStudio({ ...solver, project: projectFromDroplet(droplet, report, title) });
}

// SPDX-License-Identifier: MIT
// The droplet in a notebook, by the rules of anywidget: render() shows what the model's traits say, and sets `view` when the
// user turns it. Python's DropletWidget documents the traits.
import { MathUtils, Spherical, Vector3 } from 'three';
import { loadDroplet } from './model.js';
import { Stage } from './stage.js';

/** Bytes of a trait, which arrive as a view of a buffer that is shared. */
const bytesOf = ({ buffer, byteOffset, byteLength }) => new Uint8Array(buffer.slice(byteOffset, byteOffset + byteLength));

const degrees = (radians) => Math.round(1e4 * MathUtils.radToDeg(radians)) / 1e4;

/** The camera as the trait `view`. The file's y axis is up, the trait's z axis. */
function viewOf(stage) {
    const { target } = stage.controls;
    const way = new Spherical().setFromVector3(stage.camera.position.clone().sub(target));
    const { x, y, z } = target.clone().divideScalar(stage.scale);
    return {
        azimuth: degrees(way.theta), elevation: 90 - degrees(way.phi), distance: way.radius / stage.scale, target: [x, -z, y],
    };
}

/** Puts the camera where a view says; what it does not say stays as it is. An empty one is the whole droplet. */
function look(stage, view) {
    if (Object.keys(view).length === 0) {
        stage.reset();
        return;
    }
    const { azimuth, elevation, distance, target: [x, y, z] } = { ...viewOf(stage), ...view };
    stage.look(new Vector3(x, z, -y).multiplyScalar(stage.scale),
        new Spherical(distance * stage.scale, MathUtils.degToRad(90 - elevation), MathUtils.degToRad(azimuth)));
}

async function render({ model, el }) {
    const canvas = document.createElement('canvas');
    canvas.tabIndex = 0;
    canvas.setAttribute('role', 'application');
    canvas.setAttribute('aria-label', 'The droplet in 3D. Arrow keys turn it, plus and minus zoom, Home resets the view.');
    Object.assign(canvas.style, { display: 'block', width: '100%', touchAction: 'none', cursor: 'grab' });
    const complaint = document.createElement('p');
    complaint.setAttribute('role', 'alert');
    el.append(canvas, complaint);
    el.dataset.state = 'loading';

    let stage;
    let shown = 0;  // number of droplets that were asked for
    let framed = false;  // whether the camera has been placed, for which the canvas must have a size
    let turned = false;  // whether the user has turned it since its view was told
    const of = {
        height: () => { canvas.style.height = `${model.get('height')}px`; },
        ground: () => stage?.wear((ground) => ground.choose(model.get('ground'))),
        time: () => { if (stage?.droplet.duration) { stage.time = model.get('time'); } },
        fill: () => { if (stage?.droplet.range) { stage.fill = model.get('fill'); } },
        view: () => {
            const view = model.get('view');
            // What was told comes back.
            if (framed && JSON.stringify(view) !== JSON.stringify(stage.touched ? viewOf(stage) : {})) {
                look(stage, view);
            }
        },
        async glb() {
            const turn = ++shown;
            try {
                const droplet = await loadDroplet(bytesOf(model.get('glb')));
                if (turn !== shown) {
                    return;  // another one was asked for meanwhile
                }
                const flat = model.get('flat');
                const sides = model.get('sides') ?? undefined;
                if (stage) {
                    stage.swap(droplet, flat, droplet.box([1]), sides);
                } else {
                    const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
                    stage = new Stage({
                        canvas, droplet, flat, extent: sides, still,
                        drawn: (is_last) => {
                            el.dataset.state = is_last ? 'resting' : 'moving';
                            if (!framed) {
                                framed = true;
                                of.view();
                            }
                            if (is_last && turned) {
                                turned = false;
                                model.set('view', stage.touched ? viewOf(stage) : {});
                                model.save_changes();
                            }
                        },
                    });
                    stage.resize();
                    framed = canvas.clientWidth > 0;
                    stage.controls.addEventListener('start', () => { stage.touched = turned = true; });
                    canvas.addEventListener('keydown', () => { turned = true; });
                    of.ground();
                }
                of.fill();
                of.time();
                of.view();
                complaint.textContent = '';
            } catch (error) {
                el.dataset.state = 'failed';
                complaint.textContent = 'This notebook does not show the droplet in 3D.';
                console.error(error);
            }
        },
    };
    of.height();
    for (const [name, follow] of Object.entries(of)) {
        model.on(`change:${name}`, follow);
    }
    await of.glb();
    return () => {
        for (const [name, follow] of Object.entries(of)) {
            model.off(`change:${name}`, follow);
        }
        ++shown;
        stage?.dispose();
    };
}

export default { render };

// SPDX-License-Identifier: MIT
import { complain, download, drawScale, fileStem, find, offerGrounds, tabulate } from './controls.js';
import { CoveredObject } from './covered_object.js';
import { filledGlb } from './filled_glb.js';
import { extent, filmOf, length, refilled, rows, sides, volume } from './figures.js';
import { partsOf } from './glb.js';
import { decodeBase64, loadDroplet } from './model.js';
import { Stage } from './stage.js';
import { WetObject } from './wet_object.js';
import { openInStudio } from 'studio';  // bundle.mjs says which file this is

const kStudio = '#studio';
const root = document.documentElement;

const { title, report } = JSON.parse(find('content').textContent);
const bytes = decodeBase64(find('model').textContent.trim());

/** Shows the figures of the report, or those at another fill. */
function showFigures(shown = report) {
    find('subtitle').textContent = [shown.liquid?.name ?? shown.forces?.liquid, shown.shape && volume(shown.shape.volume_m3),
        extent(shown) && sides(extent(shown))].filter(Boolean).join(' · ');
    find('figures').hidden = tabulate(rows(shown)) === 0;
}

function showReport() {
    find('title').textContent = title;
    showFigures();
    for (const warning of report.warnings ?? []) {
        const item = document.createElement('li');
        item.textContent = warning;
        find('warnings').append(item);
    }
    find('figures').open = matchMedia('(min-width: 46.01rem) and (min-height: 40rem)').matches;
}

/** Offers the file, or one of the fill that is shown. */
function offerDownload(shown) {
    find('download').addEventListener('click', () => {
        const { fill, weights } = shown;
        download(fill === 1 ? new Blob([bytes], { type: 'model/gltf-binary' }) : filledGlb(bytes, fill, weights),
            `${fileStem(title)}.glb`);
    });
}

/** @param shown  receives the fill that is shown, and the weights of its morph targets */
function offerRefill(stage, droplet, flat, shown) {
    if (!droplet.range) {
        return;
    }
    const slider = find('fill');
    const [low, high] = droplet.range;
    slider.min = low;
    slider.max = high;
    slider.value = Math.min(Math.max(1, low), high);
    const show = () => {
        const fill = Number(slider.value);
        Object.assign(shown, { fill, weights: droplet.weights(fill) });
        const height = flat ? stage.heightAt(fill) : null;
        const parts = [`${Math.round(100 * fill)}\u2009%`];
        if (report.shape) {
            parts.push(volume(fill * report.shape.volume_m3));
        }
        if (flat) {
            parts.push(`${length(height)} high`);
        }
        showFigures(refilled(report, fill, { height_m: height, ...droplet.measure(fill, flat) }));
        find('amount').textContent = parts.join(' · ');
        slider.setAttribute('aria-valuetext', parts.join(', '));
    };
    slider.addEventListener('input', () => {
        stage.fill = Number(slider.value);
        show();
    });
    show();
    find('refill').hidden = false;
}

function offerFilm(stage, droplet, still) {
    if (!droplet.duration) {
        return;
    }
    const slider = find('time');
    let last;  // time of the last frame while playing [ms]
    let time = 0;
    slider.max = droplet.duration;
    const show = (seconds) => {
        time = seconds;
        stage.time = seconds;
        slider.value = seconds;
        const parts = filmOf(report).moment(seconds);
        find('moment').textContent = parts.join(' · ');
        slider.setAttribute('aria-valuetext', `frame ${parts.join(', ')}`);
    };
    const step = (now) => {
        if (last === undefined) {
            return;
        }
        show((time + Number(find('pace').value) * (now - last) / 1000) % droplet.duration);
        last = now;
        requestAnimationFrame(step);
    };
    const play = (plays) => {
        last = plays ? performance.now() : undefined;
        find('play').textContent = plays ? 'Pause' : 'Play';
        if (plays) {
            requestAnimationFrame(step);
        }
    };
    find('play').addEventListener('click', () => play(last === undefined));
    slider.addEventListener('input', () => {
        play(false);
        show(Number(slider.value));
    });
    find('film').hidden = false;
    show(0);
    play(!still);
}

/** Reads the model: droplets that run over an object, those that lie on one, or droplets alone. */
function load() {
    if (report.schema?.startsWith('droplet-shape.flow/')) {
        return WetObject.load(bytes, filmOf(report).duration);
    }
    const lies = report.onto && partsOf(bytes).json.nodes.some(({ name, mesh }) => name === 'object' && mesh === 0);
    return lies ? CoveredObject.load(bytes) : loadDroplet(bytes);
}

/** Offers Studio for droplets of a mask: not for films, nor for droplets laid on an object. Back returns to the page. */
function offerStudio(droplet) {
    if (openInStudio && report.shape && !report.onto && !droplet.duration && report.ground?.kind !== 'height map') {
        find('edit').hidden = false;
        find('edit').addEventListener('click', () => { location.hash = kStudio; });
        addEventListener('hashchange', () => location.reload());
    }
}

async function main() {
    if (openInStudio && location.hash === kStudio) {
        addEventListener('hashchange', () => location.reload());
        await openInStudio(bytes, report, title);
        return;
    }
    showReport();
    const shown = { fill: 1 };
    offerDownload(shown);
    try {
        const droplet = await load();
        const flat = !(droplet instanceof CoveredObject) && (report.ground?.kind ?? 'flat') === 'flat' && !report.onto;
        let frames = 0;
        const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
        const stage = new Stage({
            canvas: find('view'), droplet, flat, extent: report.onto ? undefined : extent(report),
            still,
            drawn: (is_last) => {
                drawScale(stage);
                root.dataset.frames = ++frames;
                root.dataset.state = is_last ? 'resting' : 'moving';
            },
        });
        stage.controls.addEventListener('start', () => { stage.touched = true; });
        offerGrounds(stage);
        offerRefill(stage, droplet, flat, shown);
        offerFilm(stage, droplet, still);
        offerStudio(droplet);
        find('reset').addEventListener('click', () => stage.reset());
        const panel = find('panel');
        const measure = () => {
            const beside = getComputedStyle(panel).position === 'absolute';
            stage.covered = beside ? innerWidth - panel.getBoundingClientRect().left : 0;
        };
        new ResizeObserver(measure).observe(panel);
        addEventListener('resize', measure);
        measure();
    } catch (error) {
        root.dataset.state = 'failed';
        complain('This browser does not show the droplet in 3D. Its figures and its file are here all the same.');
        find('reset').hidden = true;
        find('grounds').hidden = true;
        console.error(error);
    }
}

main();

// SPDX-License-Identifier: MIT
// Controls of the view that the page and Studio share; both have the elements that are named here.
import { length } from './figures.js';
import { kGrounds } from './ground.js';
import { readPicture } from './read_picture.js';
import { roundLength } from './stage.js';
import { say } from './words.js';

export const find = (id) => document.getElementById(id);

/** Fills the table of #figures; returns the number of rows. */
export function tabulate(rows) {
    const body = find('figures').querySelector('tbody');
    body.replaceChildren();
    for (const [name, value] of rows) {
        const row = body.insertRow();
        const head = document.createElement('th');
        head.scope = 'row';
        head.textContent = name;
        row.append(head);
        row.insertCell().textContent = value;
    }
    return body.rows.length;
}

/** A title as the name of a file without its extension. */
export function fileStem(title) {
    return title.replace(/[\u0000-\u001f\u007f"*/:<>?\\|]+/g, '_').replace(/^[.\s]+|[.\s]+$/g, '') || 'droplet';
}

export function download(blob, name) {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

function thumbnail(picture) {
    const small = document.createElement('canvas');
    small.width = small.height = 64;
    const side = Math.min(picture.width, picture.height);
    small.getContext('2d').drawImage(picture, (picture.width - side) / 2, (picture.height - side) / 2, side, side, 0, 0, 64, 64);
    return small.toDataURL();
}

/**
 * Offers the grounds in #swatches, and the user's own picture in #picture.
 * @param first  the first ground: its key, or a picture; undefined: the first one offered
 * @param chose  called with the ground when the user chooses
 * @return a function that shows a ground
 */
export function offerGrounds(stage, first, chose = () => {}) {
    const radios = [];
    const show = (chosen) => {
        const key = typeof chosen === 'object' ? undefined : chosen in kGrounds ? chosen : 'mat';
        if (key === undefined) {
            find('picture').nextElementSibling.style.backgroundImage = `url(${thumbnail(chosen)})`;
        }
        stage.wear((ground) => (key ? ground.choose(key) : ground.show(chosen, stage.renderer.capabilities.getMaxAnisotropy())));
        find('stage').style.setProperty('--mark', stage.ground.mark);
        find('picture').classList.toggle('chosen', key === undefined);
        radios.forEach((radio) => { radio.checked = radio.value === key; });
    };
    for (const [key, { name, swatch }] of Object.entries(kGrounds)) {
        const label = document.createElement('label');
        label.className = 'swatch';
        label.title = name;
        const radio = Object.assign(document.createElement('input'), { type: 'radio', name: 'ground', value: key });
        radio.setAttribute('aria-label', name);
        radio.addEventListener('change', () => {
            show(key);
            chose(key);
        });
        const dot = document.createElement('i');
        dot.style.background = swatch;
        label.append(radio, dot);
        find('picture').parentElement.before(label);
        radios.push(radio);
    }
    find('picture').addEventListener('change', async (event) => {
        const [file] = event.target.files;
        event.target.value = '';  // so that the same file can be chosen again
        if (!file) {
            return;
        }
        try {
            const picture = await readPicture(file);
            show(picture);
            chose(picture);
            find('trouble').hidden = true;
        } catch {
            complain(say('{file} is no picture that this browser can read.', { file: file.name }));
        }
    });
    show(first);
    return show;
}

export function complain(text) {
    find('trouble').textContent = text;
    find('trouble').hidden = false;
}

/** Scale bar: the longest of 1, 2 or 5 times a power of ten that fits into a fifth of the view. */
export function drawScale(stage) {
    const scale = find('scale');
    const metres = roundLength(stage.metresPerPixel * Math.min(180, 0.3 * stage.canvas.clientWidth));
    scale.style.width = `${metres / stage.metresPerPixel}px`;
    scale.firstElementChild.textContent = length(metres).replace(/([.,]\d*?)0+(?=\D)/, '$1').replace(/[.,](?=\D)/, '');
}

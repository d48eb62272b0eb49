// SPDX-License-Identifier: MIT
// The bar and the panel over the rain.
import { kGlassParameters } from '../../npm/rain.js';
import { count, decimal, say } from '../html/words.js';
import { element, Overlay } from '../live/overlay.js';
import { angleOfCoating, kCoatings, kFigures, kSliders } from './controls.js';

const kIcons = {
    finger: '<path d="M9 11V5.5a1.5 1.5 0 0 1 3 0V10l5.2 1.2a2.3 2.3 0 0 1 1.8 2.5l-.6 4.3A3 3 0 0 1 15.4 21H11a4 4 0 0 1-3.3-1.8L5 15.2a1.6 1.6 0 0 1 2.5-2L9 14.5"/>',
    spray: '<path d="M8 10h6v9a2 2 0 0 1-2 2h-2a2 2 0 0 1-2-2zM9 10V6h4v4M9 6h6M17.5 4.5h.01M20 3h.01M20 6h.01M17.5 7.5h.01"/>',
    wipers: '<path d="M4 19 13 7M10 20l8-10M3 21h18"/>',
};
/** Icons of the bar: what they say, their keys, and what they do; a gap before those with one. */
const kBar = [
    { icon: 'finger', label: 'Finger', tool: true }, { icon: 'spray', label: 'Spray water', tool: true },
    { icon: 'wipers', label: 'Wipers (W)', key: 'w', gap: true }, { icon: 'pause', label: 'Pause (Space)', key: ' ' },
    { icon: 'again', label: 'Begin again (B)', key: 'b' },
    { icon: 'picture', label: 'Save a picture (S)', key: 's', gap: true }, { icon: 'record', label: 'Record a video (R)', key: 'r' },
    { icon: 'whole', label: 'Full screen (F)', key: 'f', gap: true }, { icon: 'panel', label: 'Settings (H)', key: 'h' },
    { icon: 'close', label: 'Close (Escape)', key: 'escape', gap: true },
];

export class Panel extends Overlay {
    constructor(root, rain) {
        const sliders = rain.surface ? kSliders.filter(({ name }) => !kGlassParameters.includes(name)) : kSliders;
        super(root, rain, { name: 'rain', label: 'Rain', title: 'Rain on a windshield', icons: kIcons, bar: kBar, sliders, hint: 'Draw on the glass' });
    }

    get rain() {
        return this.part;
    }

    fill(groups) {
        this.coatings = new Map(Object.keys(kCoatings).map((name) => [name, element('button', { type: 'button', onclick: () => this.coat(name) }, name)]));
        groups.get('Glass').children[0].after(element('div', { class: 'choices' }, ...this.coatings.values()));
        const file = element('input', { type: 'file', accept: 'image/*,video/*', id: 'rain-file', hidden: '', onchange: () => {
            this.change({ backdrop: file.files[0] });
            file.value = '';
        } });
        this.backdrops = new Map([
            ['street', element('button', { type: 'button', 'aria-pressed': 'true', onclick: () => this.change({ backdrop: undefined }) }, 'Evening street')],
            ['own', element('button', { type: 'button', 'aria-pressed': 'false', title: 'A picture, a panorama or a video; or drop one on the page', onclick: () => file.click() }, 'Picture or video…')],
        ]);
        this.backdrop_trouble = element('p', { role: 'alert', hidden: '' });
        groups.get('View').children[0].after(element('div', { class: 'choices' }, ...this.backdrops.values(), file), this.backdrop_trouble);
        this.panel.append(element('h2', {}, 'Figures of the thesis'), element('div', { class: 'choices' },
            ...Object.entries(kFigures).map(([figure, what]) => element('button', { type: 'button', title: say('Figure {figure}: {what}', { figure, what: say(what) }), id: `rain-figure-${figure}`,
                onclick: () => this.exchange(this.rain.valuesOf(figure)) }, figure))));
    }

    show(name) {
        super.show(name);
        const value = this.rain.values[name];
        if (['contactAngle', 'hysteresis', 'kineticFraction'].includes(name)) {
            const now = ['contactAngle', 'hysteresis', 'kineticFraction'].map((part) => this.rain.values[part]);
            for (const [coating, button] of this.coatings) {
                const [degrees, hysteresis, kinetic] = kCoatings[coating];
                const is_it = [angleOfCoating(degrees), hysteresis, kinetic].every((value_of, k) => Math.abs(value_of - now[k]) < 1e-6);
                button.setAttribute('aria-pressed', is_it);
            }
        }
        if (name === 'wiperPeriod') {
            this.buttons.get('wipers')?.setAttribute('aria-pressed', value > 0);
        }
    }

    coat(name) {
        const [degrees, hysteresis, kinetic] = kCoatings[name];
        this.change({ contactAngle: angleOfCoating(degrees), hysteresis, kineticFraction: kinetic });
    }

    showBackdrop(name, trouble) {
        for (const [which, button] of this.backdrops) {
            button.setAttribute('aria-pressed', which === name);
        }
        this.backdrop_trouble.hidden = !trouble;
        this.backdrop_trouble.textContent = trouble ?? '';
        this.rain.draws = true;
        document.documentElement.dataset.backdrop = trouble ? 'failed' : name;
    }

    showFigures({ time, running, still }, busy, rate) {
        this.figures.textContent = say('{all} droplets, {large} of them large · {rate} frames/s', { all: count(running + still), large: count(running), rate: rate.toFixed(0) });
        this.figures.title = say('{time} s of rain; simulation and maps {busy} ms a frame', { time: time.toFixed(0), busy: decimal(busy.toFixed(1)) });
    }

    act(icon) {
        if (icon === 'wipers') {
            this.change({ wiperPeriod: this.rain.values.wiperPeriod > 0 ? 0 : 2.4 });
            return;
        }
        super.act(icon);
    }
}

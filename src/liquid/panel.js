// SPDX-License-Identifier: MIT
// The bar and the panel over a 2D liquid.
import { count, decimal, say } from '../html/words.js';
import { element, Overlay } from '../live/overlay.js';
import { kLooks, kPresets, kRecords, kSliders, kStyles } from './controls.js';

const kIcons = {
    pour: '<path d="M4 6h9v3l4-2M4 6v4a4 4 0 0 0 4 4h1a4 4 0 0 0 4-4M18.5 11c1.2 1.7 1.8 2.8 1.8 3.8a1.8 1.8 0 0 1-3.6 0c0-1 .6-2.1 1.8-3.8zM3 20c1.5-1.2 3-1.2 4.5 0s3 1.2 4.5 0 3-1.2 4.5 0 3 1.2 4.5 0"/>',
    drop: '<path d="M12 3.5c3.6 4.6 5.5 7.6 5.5 10.4a5.5 5.5 0 0 1-11 0c0-2.8 1.9-5.8 5.5-10.4z"/>',
    stir: '<path d="M3 15c2-3.5 5-3.5 6.5-1s4.5 2.5 5.500-.5-1-5-3-3.5M17 19h-6M14 6l3-3 3 3M17 3v5"/>',
    svg: '<path d="M12 4v10M8 10.5l4 4 4-4M5 19h14"/>',
    solid: '<path d="M12 3l8 4.5v9L12 21l-8-4.5v-9zM4 7.500l8 4.5 8-4.5M12 12v9"/>',
};
/** Icons of the bar: what they say, their keys, and what they do; a gap before those with one. */
const kBar = [
    { icon: 'pour', label: 'Pour (1)', key: '1', tool: true }, { icon: 'drop', label: 'Drop (2)', key: '2', tool: true },
    { icon: 'stir', label: 'Stir (3)', key: '3', tool: true },
    { icon: 'pause', label: 'Pause (Space)', key: ' ', gap: true }, { icon: 'again', label: 'Begin again (B)', key: 'b' },
    { icon: 'solid', label: 'Make it 3D (M)', key: 'm', gap: true }, { icon: 'svg', label: 'Save as SVG (V)', key: 'v' },
    { icon: 'picture', label: 'Save a picture (S)', key: 's' }, { icon: 'record', label: 'Record (R)', key: 'r' },
    { icon: 'panel', label: 'Settings (H)', key: 'h', gap: true }, { icon: 'close', label: 'Close (Escape)', key: 'escape' },
];

export class Panel extends Overlay {
    constructor(root, liquid) {
        super(root, liquid, { name: 'liquid2d', label: 'Liquid', title: 'Splash', icons: kIcons, bar: kBar, sliders: kSliders, hint: 'Pour with the pointer' });
    }

    fill(groups) {
        this.choices = new Map();
        const choices = (name, all, choose) => {
            const buttons = new Map(Object.entries(all).map(([value, label]) => [value,
                element('button', { type: 'button', id: `liquid2d-${name}-${value}`, onclick: () => choose(value) }, label)]));
            this.choices.set(name, buttons);
            return element('div', { class: 'choices' }, ...buttons.values());
        };
        const labels = Object.fromEntries(Object.entries(kPresets).map(([name, [label]]) => [name, label]));
        groups.get('Liquid').before(element('h2', {}, 'Scene'), choices('preset', labels, (name) => (name === this.part.values.preset ? this.part.restart() : this.change({ preset: name, style: kPresets[name][1] }))),
            element('h2', {}, 'Style'), choices('style', kStyles, (name) => this.change({ style: name })),
            choices('look', kLooks, (name) => this.change({ look: name })));
        this.panel.append(element('h2', {}, 'Record as'), choices('record', kRecords, (name) => this.change({ record: name })));
    }

    showAll() {
        super.showAll();
        for (const [name, buttons] of this.choices) {
            for (const [value, button] of buttons) {
                button.setAttribute('aria-pressed', value === this.part.values[name]);
            }
        }
    }

    showFigures({ particles }, busy, rate) {
        this.figures.textContent = say('{count} particles · {rate} frames/s', { count: count(particles), rate: rate.toFixed(0) });
        this.figures.title = say('Simulation and outlines {busy} ms a frame', { busy: decimal(busy.toFixed(1)) });
    }

    act(icon) {
        if (icon === 'svg') {
            this.part.saveSvg();
        } else if (icon === 'solid') {
            this.part.makeSolid();
        } else {
            super.act(icon);
        }
    }
}

// SPDX-License-Identifier: MIT
// Controls for a table of fields.
import { buildTiles } from './look_tiles.js';

const shown = (field, value) => `${String(value).replace('-', '\u2212')}${field.unit === '°' ? '' : '\u00a0'}${field.unit}`;

function choice(field, id) {
    const select = document.createElement('select');
    select.id = id;
    for (const [value, text] of Object.entries(field.choices)) {
        select.add(new Option(text, value));
    }
    return select;
}

function number(field, id) {
    const [min, max, step] = field.range;
    return Object.assign(document.createElement('input'), {
        id, type: 'number', inputMode: 'decimal', min, max, step: field.whole ? 1 : 'any', required: !field.optional,
        placeholder: field.empty ?? '',
        // Arrow keys change it by this much.
        onkeydown(event) {
            const way = { ArrowUp: 1, ArrowDown: -1 }[event.key];
            const at = event.target.valueAsNumber;
            if (way && Number.isFinite(at)) {
                event.preventDefault();
                const by = step === 'any' ? 10 ** (Math.floor(Math.log10(Math.max(Math.abs(at), 0.01))) - 1) : step;
                event.target.value = Math.min(max, Math.max(min, Number((at + way * by).toPrecision(6))));
                event.target.dispatchEvent(new Event('input', { bubbles: true }));
            }
        },
    });
}

/** Digits that a slider of many sizes sets. */
const kLogDigits = 3;

/** A slider's ends and step, and how its place becomes the value and back: sizes from small to large are even on it by their ratio. */
function scaleOf(field) {
    const [min, max, step] = field.range;
    if (field.slider !== 'log') {
        return { ends: { min, max, step }, value: Number, place: (value) => value };
    }
    const [low, high] = field.window.map(Math.log);
    return {
        ends: { min: low, max: high, step: (high - low) / 200 },
        value: (place) => Number(Math.exp(place).toPrecision(kLogDigits)),
        place: (value) => (value > 0 ? Math.log(value) : low),
    };
}

/**
 * Builds the controls.
 * @param hosts    {plain, more}: elements for usual and for rare fields
 * @param prefix   of the controls' ids
 * @param changed  called with the name and the new value of a field, and the name of the run of which the change is a part,
 *                 as of History; undefined: it is complete
 * @return a function that shows settings
 */
export function buildForm(fields, hosts, prefix, changed) {
    const rows = fields.map((field) => {
        const id = `${prefix}-${field.name}`;
        const row = document.createElement('div');
        row.className = 'field';
        const label = Object.assign(document.createElement('label'), { htmlFor: id, textContent: field.label, title: field.title ?? '' });
        const control = field.choices ? choice(field, id) : number(field, id);
        row.append(label, control);
        let [slider, scale] = [];
        if (!field.choices) {
            row.append(Object.assign(document.createElement('span'), { className: 'unit', textContent: field.unit, translate: false }));
            control.setAttribute('aria-description', field.unit);
        }
        if (field.slider) {
            scale = scaleOf(field);
            slider = Object.assign(document.createElement('input'), { type: 'range', ...scale.ends });
            slider.setAttribute('aria-label', field.label);
            slider.addEventListener('input', () => {
                control.value = scale.value(slider.value);
                changed(field.name, scale.value(slider.value), field.name);
            });
            row.append(slider);
        }
        control.addEventListener(field.choices ? 'change' : 'input', () => {
            if (!control.checkValidity()) {
                return;
            }
            if (field.choices) {
                changed(field.name, control.value);
            } else {
                changed(field.name, control.value === '' ? '' : control.valueAsNumber, field.name);
            }
        });
        const host = field.more ? hosts.more : hosts.plain;
        host.append(row);
        const show_tile = field.tiles && buildTiles(host, field, (value) => {
            control.value = value;
            changed(field.name, value);
        });
        return { field, row, control, slider, scale, show_tile };
    });
    return (settings) => {
        for (const { field, row, control, slider, scale, show_tile } of rows) {
            row.hidden = field.when ? !field.when(settings) : false;
            const value = settings[field.name];
            // Somebody who has emptied an optional number is about to write another.
            const emptied = field.optional && document.activeElement === control && control.value === '';
            if (field.choices || document.activeElement !== control || !emptied && (control.value === '' ? '' : control.valueAsNumber) !== value) {
                control.value = value;
            }
            show_tile?.(value);
            if (slider) {
                slider.value = scale.place(value);
                slider.setAttribute('aria-valuetext', shown(field, value));
            }
        }
    };
}

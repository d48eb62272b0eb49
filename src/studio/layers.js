// SPDX-License-Identifier: MIT
// The list of layers, topmost first.
import { say } from '../html/words.js';
import { inkOf, lookOf } from './looks.js';
import { shownName } from './project.js';

const kEye = '<svg viewBox="0 0 20 20" aria-hidden="true"><path d="M2 10s3-5 8-5 8 5 8 5-3 5-8 5-8-5-8-5z"/><circle cx="10" cy="10" r="2.3"/></svg>';
const kPencil = '<svg viewBox="0 0 20 20" aria-hidden="true"><path d="m4 16 .8-3.6L13.5 3.7l2.800 2.800-8.700 8.700z"/></svg>';

function button(label, svg, act) {
    const element = Object.assign(document.createElement('button'), { type: 'button', className: 'icon', title: label, innerHTML: svg });
    element.setAttribute('aria-label', label);
    element.addEventListener('click', act);
    return element;
}

/**
 * @param list  element for the rows
 * @param acts  {select(index), show(index, visible), rename(index, name)}
 * @return a function that shows a project's layers
 */
export function buildLayers(list, { select, show, rename }) {
    const row = ({ name: stored, visible, liquid }, index, selected) => {
        const name = shownName(stored);
        const item = document.createElement('li');
        const label = document.createElement('label');
        const radio = Object.assign(document.createElement('input'), { type: 'radio', name: 'layer', value: index, checked: selected });
        radio.addEventListener('change', () => select(index));
        const dot = document.createElement('i');
        dot.style.background = `rgb(${inkOf(lookOf(liquid)).join(' ')})`;
        label.append(radio, dot, Object.assign(document.createElement('span'), { textContent: name }));
        const change = () => {
            const field = Object.assign(document.createElement('input'), { className: 'rename', value: name, maxLength: 80 });
            field.setAttribute('aria-label', say('Name of {layer}', { layer: name }));
            let done = false;
            const end = (accepted) => {
                if (!done) {
                    done = true;
                    const given = field.value.trim();
                    rename(index, accepted && given && given !== name ? given : stored);
                    list.querySelector('input[type=radio]:checked')?.focus();
                }
            };
            field.addEventListener('keydown', (event) => {
                event.stopPropagation();
                if (event.key === 'Enter' || event.key === 'Escape') {
                    event.preventDefault();
                    end(event.key === 'Enter');
                }
            });
            field.addEventListener('blur', () => end(true));
            label.replaceWith(field);
            field.select();
        };
        label.addEventListener('dblclick', change);
        const eye = button(say('Show {layer}', { layer: name }), kEye, () => show(index, !visible));
        eye.setAttribute('aria-pressed', visible);
        item.append(label, button(say('Rename {layer}', { layer: name }), kPencil, change), eye);
        return item;
    };
    return ({ layers, selected }) => {
        const focused = list.contains(document.activeElement) ? document.activeElement : null;
        const at = focused ? [...list.querySelectorAll('input, button')].indexOf(focused) : -1;
        const rows = layers.map((layer, index) => row(layer, index, index === selected));
        list.replaceChildren(...rows.reverse());
        if (focused) {
            (focused.type === 'radio' ? list.querySelector(':checked') : list.querySelectorAll('input, button')[at])?.focus();
        }
    };
}

// SPDX-License-Identifier: MIT
// The row of tools: radio buttons with icons.
import { kTools } from './tools.js';

// Paths on a square of 20 units.
const kIcons = {
    brush: 'M16.5 3.5c-4 2-7 5-8.5 8l1 1c3-1.5 6-4.5 8-8.5zM7 12.5c-2 0-2.5 1.5-2.5 2.5S3.5 16.5 3 16.5c1.5 1 5.5.5 6-2.5z',
    eraser: 'm8 16-4.5-4.5 8-8 5 5L9 16zM7 16h9M7.5 7.5l5 5',
    line: 'M4.5 15.5l11-11M4.5 15.5h.01M15.5 4.5h.01',
    rectangle: 'M3.5 5.5h13v9h-13z',
    ellipse: 'M3 10a7 5 0 1 0 14 0a7 5 0 1 0-14 0z',
    lasso: 'M4 13c-2-5 2-9 7-9s7 4 4.5 7-5 1-7 3-1.5 3-2.5 2.5S4.5 14 4 13z',
    text: 'M4.5 6V4h11v2M10 4v12M7.5 16h5',
    fill: 'M9 3.5 3.5 9l6 6 6-6zM3.5 9h12M16.5 12.5c1 1.5 1.3 2.2 1.3 2.8a1.3 1.3 0 0 1-2.6 0c0-.6.3-1.3 1.3-2.8z',
    move: 'M10 2.5v15M2.5 10h15M7.5 5 10 2.5 12.5 5M7.5 15l2.5 2.5 2.5-2.5M5 7.5 2.5 10 5 12.5M15 7.5l2.5 2.5L15 12.5',
};

/**
 * Fills `host` with the tools.
 * @param chose  called with the name of a tool
 * @return a function that marks a tool as chosen
 */
export function buildTools(host, chose) {
    for (const [tool, { name, key }] of Object.entries(kTools)) {
        const label = document.createElement('label');
        label.title = `${name} (${key.toUpperCase()})`;
        const radio = Object.assign(document.createElement('input'), { type: 'radio', name: 'tool', value: tool });
        radio.setAttribute('aria-label', name);
        radio.addEventListener('change', () => chose(tool));
        label.append(radio);
        label.insertAdjacentHTML('beforeend', `<svg viewBox="0 0 20 20" aria-hidden="true"><path d="${kIcons[tool]}"/></svg>`);
        host.append(label);
    }
    return (tool) => { host.querySelector(`[value=${tool}]`).checked = true; };
}

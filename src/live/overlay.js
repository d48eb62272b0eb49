// SPDX-License-Identifier: MIT
// The bar and the panel over a simulation that fills the page.
import { say, translate } from '../html/words.js';
import { History } from './history.js';

const kIcons = {
    pause: '<path d="M9 5v14M15 5v14"/>',
    play: '<path d="M8 5v14l11-7z"/>',
    again: '<path d="M20 11a8 8 0 1 0-2.3 6.3M20 5v6h-6"/>',
    close: '<path d="M6 6l12 12M18 6 6 18"/>',
    whole: '<path d="M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5"/>',
    record: '<circle cx="12" cy="12" r="5.5" fill="currentcolor" stroke="none"/>',
    picture: '<rect x="4" y="6" width="16" height="13" rx="2"/><circle cx="12" cy="12.5" r="3.3"/><path d="M9 6l1-2h4l1 2"/>',
    undo: '<path d="M8.5 5 4.3 9.2l4.2 4.2M4.9 9.2h9a5.3 5.3 0 0 1 0 10.6H9.7"/>',
    redo: '<path d="m15.5 5 4.2 4.2-4.2 4.2M19.1 9.2h-9a5.3 5.3 0 0 0 0 10.6h4.2"/>',
    panel: '<path d="M4 7h9M17 7h3M4 17h3M11 17h9"/><circle cx="15" cy="7" r="2"/><circle cx="9" cy="17" r="2"/>',
};
const kCalm = 3500;  // [ms] until the bar hides
const kHinted = 6500;  // [ms] that a hint is shown

export function element(kind, values = {}, ...content) {
    const made = document.createElement(kind);
    for (const [name, value] of Object.entries(values)) {
        if (name.startsWith('on')) {
            made.addEventListener(name.slice(2), value);
        } else {
            made.setAttribute(name, value);
        }
    }
    made.append(...content);
    return made;
}

/** Buttons and sliders; what is special to a part is in a class of its own that extends this one. */
export class Overlay {
    /**
     * @param root   element of the part
     * @param part   what is shown: `values` by their names, those of sliders among them, never written to; `take(values)`, which
     *               puts others into effect; `tool`, `pause()`, `restart()`, `savePicture()`, `recorder`, `leave` or undefined,
     *               `ends`, which aborts at its end
     * @param about  `name`, which ids begin with; `label` of the bar; `title` of the panel; `icons` of its own; `bar`:
     *               icons, what they say, their keys, whether they are tools, whether a gap is before them; `sliders`, as
     *               in controls.js of the rain; `hint`
     */
    constructor(root, part, about) {
        this.root = root;
        this.part = part;
        this.about = about;
        this.icons = { ...kIcons, ...about.icons };
        this.history = new History(part.values, Infinity, () => 0);
        this.history.restIn(root);
        this.sliders = new Map();
        this.buttons = new Map();
        document.activeElement?.blur();  // the button that opened it must not take keys
        this.#makePanel();
        this.#makeBar();
        this.hint = element('div', { class: 'hint', role: 'status' }, about.hint);
        root.append(this.hint);
        this.#hint(2500);
        for (const gone of ['pointerdown', 'keydown']) {
            addEventListener(gone, () => this.#endHint(), { signal: part.ends.signal, capture: true });
        }
        // Before what lies below, if anything does.
        addEventListener('keydown', (event) => this.#press(event), { signal: part.ends.signal, capture: true });
        for (const kind of ['pointermove', 'pointerdown']) {
            root.addEventListener(kind, () => this.wake());
        }
        this.wake();
        translate(root);
        this.showAll();
    }

    #hint(wait) {
        this.#endHint();
        this.hinted = setTimeout(() => {
            this.hint.classList.add('shown');
            this.hinted = setTimeout(() => this.#endHint(), kHinted);
        }, wait);
    }

    #endHint() {
        clearTimeout(this.hinted);
        this.hint.classList.remove('shown');
    }

    /** Says that the browser has recorded nothing. */
    recordedNothing() {
        this.hint.textContent = say('This browser has recorded nothing.');
        this.#hint(0);
    }

    #makeBar() {
        const { name, label: title } = this.about;
        const bar = element('div', { class: 'bar', role: 'toolbar', 'aria-label': title });
        for (const { icon, label, gap } of this.about.bar) {
            if (icon === 'record' && !this.part.recorder.works || icon === 'close' && !this.part.leave) {
                continue;
            }
            if (gap) {
                bar.append(element('i'));
            }
            const button = element('button', { type: 'button', id: `${name}-${icon}`, title: label, 'aria-label': label, onclick: () => this.act(icon) });
            this.#draw(button, icon);
            this.buttons.set(icon, button);
            bar.append(button);
        }
        this.root.append(bar);
        this.bar = bar;
        this.showTool();
    }

    #draw(button, icon) {
        const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
        svg.setAttribute('viewBox', '0 0 24 24');
        svg.setAttribute('aria-hidden', 'true');
        svg.innerHTML = this.icons[icon];
        button.replaceChildren(svg);
    }

    #makePanel() {
        const { name, title } = this.about;
        this.figures = element('p', {}, '\u00a0');
        this.steps = [['undo', 'Undo', 'Undo (Ctrl+Z)'], ['redo', 'Redo', 'Redo (Ctrl+Y)']].map(([step, label, about]) => {
            const button = element('button', { type: 'button', id: `${name}-${step}`, title: about, 'aria-label': label, onclick: () => this.#step(step) });
            this.#draw(button, step);
            return button;
        });
        this.panel = element('section', { class: 'panel away', id: `${name}-settings`, 'aria-label': 'Settings' },
            element('div', { class: 'steps' }, ...this.steps), element('h1', {}, title), this.figures);
        const groups = new Map();
        for (const slider of this.about.sliders) {
            if (!groups.has(slider.group)) {
                groups.set(slider.group, element('div', {}, element('h2', {}, slider.group)));
                this.panel.append(groups.get(slider.group));
            }
            const input = element('input', { type: 'range', id: `${name}-${slider.name}`, min: slider.min, max: slider.max, step: slider.step,
                oninput: () => this.#slide(slider) });
            const output = element('output', { for: input.id });
            groups.get(slider.group).append(element('label', { for: input.id }, slider.label, output, input));
            this.sliders.set(slider.name, { slider, input, output });
        }
        this.fill(groups);
        this.root.append(this.panel);
    }

    /** Adds to the panel what is special, once. */
    fill() {}

    #slide({ name, from }) {
        this.change({ [name]: from(Number(this.sliders.get(name).input.value)) }, name);
    }

    /**
     * Puts some other values into effect, as a step that can be undone.
     * @param run  as of History
     */
    change(values, run) {
        if (Object.entries(values).some(([name, value]) => value !== this.part.values[name])) {
            this.exchange({ ...this.part.values, ...values }, run);
        }
    }

    /** Puts other values into effect in the place of all. */
    exchange(values, run) {
        this.history.add(values, run);
        this.part.take(values);
        this.history.replace(this.part.values);  // what is not given follows from the others
        this.showAll();
    }

    #step(step) {
        const before = this.history.state;
        const values = this.history[step]();
        if (values !== before) {
            this.part.take(values);
            this.showAll();
        }
    }

    /** Shows a slider's value. */
    show(name) {
        const { slider: { to, show, min, max }, input, output } = this.sliders.get(name);
        const value = this.part.values[name];
        input.value = to(value);
        input.style.setProperty('--at', `${100 * (Number(input.value) - min) / (max - min)}%`);
        output.textContent = show(value);
    }

    showAll() {
        const { can_undo, can_redo } = this.history;
        this.steps.forEach((button, k) => { button.disabled = ![can_undo, can_redo][k]; });
        for (const name of this.sliders.keys()) {
            if (this.part.values[name] !== undefined) {
                this.show(name);
            }
        }
    }

    showPaused(paused) {
        const button = this.buttons.get('pause');
        this.#draw(button, paused ? 'play' : 'pause');
        button.setAttribute('aria-label', say(paused ? 'Go on (Space)' : 'Pause (Space)'));
        button.title = button.getAttribute('aria-label');
    }

    showTool() {
        for (const { icon, tool } of this.about.bar) {
            if (tool) {
                this.buttons.get(icon).setAttribute('aria-pressed', this.part.tool === icon);
            }
        }
    }

    /** Shows the bar, which hides when nothing is done for a while. */
    wake() {
        this.root.classList.remove('calm');
        clearTimeout(this.sleep);
        this.sleep = setTimeout(() => {
            const is_used = this.bar.contains(document.activeElement) && document.activeElement.matches(':focus-visible');
            this.root.classList.toggle('calm', this.panel.classList.contains('away') && !is_used);
        }, kCalm);
    }

    #press(event) {
        event.stopPropagation();
        this.wake();
        const step = { z: event.shiftKey ? 'redo' : 'undo', y: 'redo' }[event.key?.toLowerCase?.()];
        if (step && (event.ctrlKey || event.metaKey)) {
            event.preventDefault();
            this.#step(step);
            return;
        }
        const chosen = this.about.bar.find(({ key }) => key !== undefined && key === event.key?.toLowerCase?.());
        const is_typed = event.target instanceof HTMLElement && event.target.matches('button, input:not([type=range])') && event.key === ' ';
        if (chosen && !is_typed && !event.ctrlKey && !event.metaKey && !event.altKey && !event.repeat) {
            event.preventDefault();
            this.act(chosen.icon);
        }
    }

    /** Does what a button says. */
    act(icon) {
        const { part } = this;
        const button = this.buttons.get(icon);
        if (this.about.bar.find((each) => each.icon === icon).tool) {
            part.tool = icon;
            this.showTool();
            return;
        }
        switch (icon) {
            case 'pause':
                part.pause();
                break;
            case 'again':
                part.restart();
                break;
            case 'picture':
                part.savePicture();
                break;
            case 'record':
                if (!part.recorder.works) {
                    break;
                }
                part.recorder.runs ? part.recorder.stop() : part.recorder.start();
                button.classList.toggle('recording', part.recorder.runs);
                button.setAttribute('aria-label', say(part.recorder.runs ? 'End the recording (R)' : this.about.bar.find((each) => each.icon === icon).label));
                break;
            case 'whole':
                document.fullscreenElement ? document.exitFullscreen() : this.root.requestFullscreen?.();
                break;
            case 'close':
                part.leave?.();
                break;
            case 'panel':
                this.root.classList.toggle('open', !this.panel.classList.toggle('away'));
                button.setAttribute('aria-pressed', this.root.classList.contains('open'));
                this.wake();
                break;
        }
    }
}

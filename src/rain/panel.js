// SPDX-License-Identifier: MIT
// The bar and the panel over the rain.
import { angleOfCoating, kCoatings, kFigures, kSliders } from './controls.js';

const kIcons = {
    finger: '<path d="M9 11V5.5a1.5 1.5 0 0 1 3 0V10l5.2 1.2a2.3 2.3 0 0 1 1.8 2.5l-.6 4.3A3 3 0 0 1 15.4 21H11a4 4 0 0 1-3.3-1.8L5 15.2a1.6 1.6 0 0 1 2.5-2L9 14.5"/>',
    spray: '<path d="M8 10h6v9a2 2 0 0 1-2 2h-2a2 2 0 0 1-2-2zM9 10V6h4v4M9 6h6M17.5 4.5h.01M20 3h.01M20 6h.01M17.5 7.5h.01"/>',
    wipers: '<path d="M4 19 13 7M10 20l8-10M3 21h18"/>',
    pause: '<path d="M9 5v14M15 5v14"/>', play: '<path d="M8 5v14l11-7z"/>',
    again: '<path d="M20 11a8 8 0 1 0-2.3 6.3M20 5v6h-6"/>',
    close: '<path d="M6 6l12 12M18 6 6 18"/>',
    whole: '<path d="M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5"/>',
    record: '<circle cx="12" cy="12" r="5.5" fill="currentcolor" stroke="none"/>',
    picture: '<rect x="4" y="6" width="16" height="13" rx="2"/><circle cx="12" cy="12.5" r="3.3"/><path d="M9 6l1-2h4l1 2"/>',
    panel: '<path d="M4 7h9M17 7h3M4 17h3M11 17h9"/><circle cx="15" cy="7" r="2"/><circle cx="9" cy="17" r="2"/>',
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

function element(kind, values = {}, ...content) {
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

export class Panel {
    constructor(root, rain) {
        this.root = root;
        this.rain = rain;
        this.sliders = new Map();
        this.buttons = new Map();
        this.#makePanel();
        this.#makeBar();
        this.hint = element('div', { class: 'hint' }, 'Draw on the glass');
        root.append(this.hint);
        setTimeout(() => this.hint.classList.add('shown'), 2500);
        for (const gone of ['pointerdown', 'keydown']) {
            addEventListener(gone, () => this.hint.classList.remove('shown'), { once: true, signal: rain.ends.signal, capture: true });
        }
        setTimeout(() => this.hint.classList.remove('shown'), 9000);
        // Before what lies below, if anything does.
        addEventListener('keydown', (event) => this.#press(event), { signal: rain.ends.signal, capture: true });
        for (const kind of ['pointermove', 'pointerdown']) {
            root.addEventListener(kind, () => this.wake());
        }
        this.wake();
        this.showAll();
    }

    #makeBar() {
        const bar = element('div', { class: 'bar', role: 'toolbar', 'aria-label': 'Rain' });
        for (const { icon, label, gap } of kBar) {
            if (icon === 'record' && !this.rain.recorder.works || icon === 'close' && !this.rain.leave) {
                continue;
            }
            if (gap) {
                bar.append(element('i'));
            }
            const button = element('button', { type: 'button', id: `rain-${icon}`, title: label, 'aria-label': label, onclick: () => this.#do(icon) });
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
        svg.innerHTML = kIcons[icon];
        button.replaceChildren(svg);
    }

    #makePanel() {
        this.figures = element('p', {}, '\u00a0');
        this.panel = element('section', { class: 'panel away', id: 'rain-settings', 'aria-label': 'Settings' }, element('h1', {}, 'Rain on a windshield'), this.figures);
        const groups = new Map();
        for (const slider of kSliders) {
            if (!groups.has(slider.group)) {
                groups.set(slider.group, element('div', {}, element('h2', {}, slider.group)));
                this.panel.append(groups.get(slider.group));
            }
            const input = element('input', { type: 'range', id: `rain-${slider.name}`, min: slider.min, max: slider.max, step: slider.step,
                oninput: () => this.#slide(slider) });
            const output = element('output', { for: input.id });
            groups.get(slider.group).append(element('label', { for: input.id }, slider.label, output, input));
            this.sliders.set(slider.name, { slider, input, output });
        }
        this.coatings = new Map(Object.keys(kCoatings).map((name) => [name, element('button', { type: 'button', onclick: () => this.#coat(name) }, name)]));
        groups.get('Glass').children[0].after(element('div', { class: 'choices' }, ...this.coatings.values()));
        const file = element('input', { type: 'file', accept: 'image/*,video/*', id: 'rain-file', hidden: '', onchange: () => {
            this.rain.backdrop.open(file.files[0]);
            file.value = '';
        } });
        this.backdrops = new Map([
            ['street', element('button', { type: 'button', 'aria-pressed': 'true', onclick: () => this.rain.backdrop.street() }, 'Evening street')],
            ['own', element('button', { type: 'button', 'aria-pressed': 'false', title: 'A picture, a panorama or a video; or drop one on the page', onclick: () => file.click() }, 'Picture or video…')],
        ]);
        this.backdrop_trouble = element('p', { role: 'alert', hidden: '' });
        groups.get('View').children[0].after(element('div', { class: 'choices' }, ...this.backdrops.values(), file), this.backdrop_trouble);
        this.panel.append(element('h2', {}, 'Figures of the thesis'), element('div', { class: 'choices' },
            ...Object.entries(kFigures).map(([figure, what]) => element('button', { type: 'button', title: `Figure ${figure}: ${what}`, id: `rain-figure-${figure}`,
                onclick: () => this.rain.show(figure) }, figure))));
        this.root.append(this.panel);
    }

    #slide({ name, from, again }) {
        const { input } = this.sliders.get(name);
        this.rain.set(name, from(Number(input.value)), { again });
        this.#show(name);
    }

    #show(name) {
        const { slider: { to, show, min, max }, input, output } = this.sliders.get(name);
        const value = this.rain.values[name];
        input.value = to(value);
        input.style.setProperty('--at', `${100 * (Number(input.value) - min) / (max - min)}%`);
        output.textContent = show(value);
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

    showAll() {
        for (const name of this.sliders.keys()) {
            if (this.rain.values[name] !== undefined) {
                this.#show(name);
            }
        }
    }

    #coat(name) {
        const [degrees, hysteresis, kinetic] = kCoatings[name];
        this.rain.set('contactAngle', angleOfCoating(degrees));
        this.rain.set('hysteresis', hysteresis);
        this.rain.set('kineticFraction', kinetic);
        this.showAll();
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
        this.figures.textContent = `${(running + still).toLocaleString('en')} droplets, ${running.toLocaleString('en')} of them large · ${rate.toFixed(0)} frames/s`;
        this.figures.title = `${time.toFixed(0)} s of rain; simulation and maps ${busy.toFixed(1)} ms a frame`;
    }

    showPaused(paused) {
        const button = this.buttons.get('pause');
        this.#draw(button, paused ? 'play' : 'pause');
        button.setAttribute('aria-label', paused ? 'Go on (Space)' : 'Pause (Space)');
        button.title = button.getAttribute('aria-label');
    }

    showTool() {
        for (const icon of ['finger', 'spray']) {
            this.buttons.get(icon).setAttribute('aria-pressed', this.rain.tool === icon);
        }
    }

    /** Shows the bar, which hides when nothing is done for a while. */
    wake() {
        this.root.classList.remove('calm');
        clearTimeout(this.sleep);
        this.sleep = setTimeout(() => {
            const is_used = this.bar.contains(document.activeElement) && document.activeElement.matches(':focus-visible');
            this.root.classList.toggle('calm', this.panel.classList.contains('away') && !is_used);
        }, this.rain.calmAfter);
    }

    #press(event) {
        event.stopPropagation();
        this.wake();
        const chosen = kBar.find(({ key }) => key !== undefined && key === event.key?.toLowerCase?.());
        const is_typed = event.target instanceof HTMLElement && event.target.matches('button, input:not([type=range])') && event.key === ' ';
        if (chosen && !is_typed && !event.ctrlKey && !event.metaKey && !event.altKey && !event.repeat) {
            event.preventDefault();
            this.#do(chosen.icon);
        }
    }

    #do(icon) {
        const { rain } = this;
        const button = this.buttons.get(icon);
        switch (icon) {
            case 'finger':
            case 'spray':
                rain.tool = icon;
                this.showTool();
                break;
            case 'wipers':
                rain.set('wiperPeriod', rain.values.wiperPeriod > 0 ? 0 : 2.4);
                this.#show('wiperPeriod');
                break;
            case 'pause':
                rain.pause();
                break;
            case 'again':
                rain.restart();
                break;
            case 'picture':
                rain.savePicture();
                break;
            case 'record':
                if (!rain.recorder.works) {
                    break;
                }
                rain.recorder.runs ? rain.recorder.stop() : rain.recorder.start();
                button.classList.toggle('recording', rain.recorder.runs);
                button.setAttribute('aria-label', rain.recorder.runs ? 'End the recording (R)' : 'Record a video (R)');
                break;
            case 'whole':
                document.fullscreenElement ? document.exitFullscreen() : this.root.requestFullscreen?.();
                break;
            case 'close':
                rain.leave?.();
                break;
            case 'panel':
                this.root.classList.toggle('open', !this.panel.classList.toggle('away'));
                button.setAttribute('aria-pressed', this.root.classList.contains('open'));
                this.wake();
                break;
        }
    }
}

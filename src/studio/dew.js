// SPDX-License-Identifier: MIT
// Dew on an object: the part of Studio that covers an object with droplets. It has an object, settings and a history of
// its own; the view, the figures and the buttons of the bar are Studio's, while this part is shown.
import { complain, download, fileStem, find, tabulate } from '../html/controls.js';
import { CoveredObject } from '../html/covered_object.js';
import { digits, length, volume } from '../html/figures.js';
import { say, translate } from '../html/words.js';
import { History } from '../live/history.js';
import { bottle } from './bottle.js';
import markup from './dew.html';
import {
    dewCommandOf, dewFields, dewOptionsOf, formOf, newSettings, settingsFrom, shownSettings, withPreset, withSetting,
} from './dew_fields.js';
import { NoObject } from './no_object.js';
import { hasObject, readObject, sizeOf } from './object_files.js';
import { buildForm } from './physics_form.js';
import { sentence } from './sentence.js';
import { Servant } from './solver.js';

const kRest = 250;          // without a change, droplets are made [ms]
const kLong = 1500;         // a run that takes longer can be stopped [ms]
const kMostKept = 64 << 20; // of an object that the browser keeps [bytes]
const kManyTriangles = 3e5;
const kMostHistory = 256 << 20;
const kTypes = { glb: 'model/gltf-binary', usdz: 'model/vnd.usdz+zip', obj: 'model/obj', stl: 'model/stl', ply: 'model/ply', csv: 'text/csv' };
// The bottle to try is a small one: few droplets are quick on a phone, and large enough to be seen.
const kBottle = { objectSize: 90, coverage: 45, smallest: 0.4, largest: 1.4 };
const root = document.documentElement;

const counted = (count) => String(count).replace(/\B(?=(\d{3})+$)/g, '\u2009');

/** Bytes of the objects that states hold. */
const bytesIn = (states) => [...new Set(states.map(({ object }) => object))].reduce((sum, object) => sum + (object ? sizeOf(object) : 0), 0);

export class Dew {
    #parts;
    #view;
    #say;
    #keeper;
    #show_ground;
    #history = new History({ object: undefined, settings: undefined, ground: undefined }, kMostHistory, bytesIn);
    #shown = false;

    /**
     * @param parts   {worker_url, wasm}
     * @param view    Studio's view; undefined without 3D
     * @param say     says a sentence to who cannot see
     * @param keeper  as of Studio; or undefined
     * @param show_ground  shows a ground in the view; undefined: that of the drawing, until one is chosen for dew
     */
    constructor({ parts, view, say, keeper, show_ground }) {
        this.#parts = parts;
        this.#view = view;
        this.#say = say;
        this.#keeper = keeper;
        this.#show_ground = show_ground;
        this.#history.restIn(window);
        const template = document.createElement('template');
        template.innerHTML = markup;
        const [panel, saves] = template.content.children;
        find('dew').append(...panel.childNodes);
        document.body.append(saves);
        this.#offer();
    }

    get is_shown() {
        return this.#shown;
    }

    /** Whether files are for this part. */
    takes(files) {
        return hasObject(files);
    }

    async show(shown) {
        if (shown === this.#shown) {
            return;
        }
        this.#shown = shown;
        find('save').setAttribute('popovertarget', shown ? 'dew-saves' : 'saves');
        find('trouble').hidden = true;
        this.#keep();
        this.#introduceCommand();
        if (!shown) {
            this.#view?.showObject(undefined);
            return;
        }
        this.#showScene(false);
        await this.#start();
        this.#update();
    }

    /** Learns the options of the solver, which makes the forms; what was kept comes back. */
    #start() {
        this.#started ??= (async () => {
            const { options } = await this.#servant().ask('dewOptions', {});
            this.#known = dewFields(options);
            this.#buildForms();
            const kept = await this.#keeper?.beside('dew');
            const settings = kept ? settingsFrom(this.#known, kept.settings) : newSettings(this.#known);
            this.#history.reset({ object: this.#state.object ?? kept?.object, settings, ground: this.#state.ground ?? kept?.ground });
            this.#solve();
        })();
        return this.#started;
    }

    #started;
    #known;
    #worker;

    #servant() {
        if (!this.#worker) {
            this.#worker = new Servant(this.#parts);
            this.#held = undefined;
        }
        return this.#worker;
    }

    #held;     // object that the worker has
    #covered;  // job whose droplets it has

    #stopWorker() {
        this.#worker?.stop();
        this.#worker = this.#covered = this.#job = undefined;
    }

    get #state() {
        return this.#history.state;
    }

    // Changes.

    #change(state, run) {
        this.#history.add({ ...this.#state, ...state }, run);
        this.#keep();
        this.#update();
        this.#solve();
    }

    undo(step) {
        const before = this.#state;
        const state = this.#history[step]();
        if (state !== before) {
            this.#keep();
            this.#update();
            this.#solve();
        }
    }

    /** The line before the command that is shown with the figures. */
    #introduceCommand() {
        find('command-line').firstChild.data = `${this.#shown ? say('The same by the command:') :
            say('The same by the command, with the footprint saved as PNG:')} `;
    }

    /** Says everything again, in another language. */
    retell() {
        this.#introduceCommand();
        this.#update();
    }

    async open(files) {
        find('trouble').hidden = true;
        try {
            const object = await readObject(files);
            await this.#start();
            this.#take(object);
        } catch (error) {
            complain(say('{file} cannot be opened: {reason}.', { file: files[0].name, reason: error.message }));
        }
    }

    /** Takes another object; it keeps its own size. */
    #take(object) {
        this.#change({ object, settings: { ...this.#state.settings, objectSize: '', up: '' } });
        this.#say(say('{file} opened', { file: object.name }));
    }

    /** Takes a ground for the view. */
    choose(ground) {
        this.#change({ ground });
    }

    /** Without an object, as at first. */
    clear() {
        if (this.#known) {
            this.#change({ object: undefined, settings: newSettings(this.#known) });
        }
    }

    #keep() {
        clearTimeout(this.#keeping);
        this.#keeping = setTimeout(() => {
            const { object, settings, ground } = this.#state;
            if (this.#known && settings) {
                const kept = object && sizeOf(object) <= kMostKept ? object : undefined;
                this.#keeper?.keepBeside('dew', { shown: this.#shown, settings, object: kept, ground: typeof ground === 'string' ? ground : undefined });
            }
        }, kRest);
    }

    #keeping;

    // Solving: the newest settings count; what is no longer wanted is broken off.

    #job;     // {object, options, settings} that the worker works on
    #made;    // the last that came out, with its report; or with its error
    #resting;

    get #options() {
        return dewOptionsOf(this.#known, this.#state.settings);
    }

    #solve() {
        clearTimeout(this.#resting);
        const { object } = this.#state;
        const wanted = object && JSON.stringify(this.#options);
        const same = (job) => job && job.object === object && job.text === wanted;
        if (!object || same(this.#made)) {
            if (this.#job) {
                this.#stopWorker();
            }
            if (!object) {
                this.#made = undefined;
                this.#showScene(false);
            }
            this.#update();
            return;
        }
        if (same(this.#job)) {
            return;
        }
        this.#resting = setTimeout(() => this.#make({ object, text: wanted, options: this.#options }), kRest);
        this.#update();
    }

    async #make(job) {
        if (this.#job) {
            this.#stopWorker();
        }
        this.#job = job;
        job.began = performance.now();
        this.#tick();
        this.#update();
        const outcome = await this.#ask(job).catch((error) => ({ error }));
        if (this.#job !== job) {
            return;  // a newer one took its place
        }
        this.#job = undefined;
        const { error } = outcome;
        if (error && (error.code === 'Internal' || error.code === 'OutOfMemory')) {
            this.#stopWorker();  // a solver that failed so may be damaged
        }
        const before = this.#made;
        this.#made = { ...job, ...outcome, job };
        this.#showScene(before?.object === job.object && before.scene !== undefined && frameOf(before) === frameOf(job));
        this.#update();
        this.#say(find('result').textContent);
    }

    async #cover(job) {
        const servant = this.#servant();
        if (this.#held !== job.object) {
            await servant.ask('object', { object: job.object });
            this.#held = job.object;
        }
        const answer = await servant.ask('dew', { options: job.options });
        this.#covered = job;
        return answer;
    }

    async #ask(job) {
        const { report, bytes, solve_ms } = await this.#cover(job);
        const scene = this.#view ? await CoveredObject.load(bytes) : undefined;
        return { report, solve_ms, scene };
    }

    /** Counts the seconds of a run that takes long. */
    #tick() {
        clearInterval(this.#ticking);
        this.#ticking = setInterval(() => {
            if (!this.#job) {
                clearInterval(this.#ticking);
            }
            this.#showResult();
        }, 500);
    }

    #ticking;

    #stop() {
        const { text, object } = this.#job ?? {};
        if (object) {
            this.#stopWorker();
            this.#stopped = { object, text };
            this.#update();
        }
    }

    #stopped;

    // What is seen.

    #scene;

    /** @param again  whether the camera stays */
    #showScene(again) {
        const scene = this.#made?.scene ?? new NoObject();
        const before = this.#scene;
        if (this.#shown && this.#view) {
            this.#view.showObject(scene, again && before !== undefined);
        }
        if (before !== scene) {
            before?.dispose();
        }
        this.#scene = scene;
    }

    #update() {
        if (!this.#shown || !this.#known) {
            return;
        }
        const { object, settings, ground } = this.#state;
        this.#show_ground(ground);
        const report = this.#made?.object === object ? this.#made?.report : undefined;
        const shown = shownSettings(this.#known, settings, object?.name ?? '', report);
        this.#showFields(shown);
        this.#showForm(shown);
        find('dew-kinds').querySelector(`[value=${settings.preset}]`).checked = true;
        find('undo').disabled = !this.#history.can_undo;
        find('redo').disabled = !this.#history.can_redo;
        find('dew-bottle').hidden = object !== undefined;
        find('dew-open').classList.toggle('main', object === undefined);
        find('dew-open').textContent = say(object ? 'Open another' : 'Open object');
        find('dew-name').textContent = object?.name ?? say('No object');
        find('dew-settings').hidden = object === undefined;
        document.title = `${object?.name ?? say('Dew')} – Droplet Studio`;
        find('dew-object').hidden = !report;
        if (report) {
            const { triangles, size_m } = report.input;
            find('dew-object').textContent = say('{count} triangles, {size}', { count: counted(triangles), size: size_m.map((side) => length(side)).join(' × ') });
        }
        this.#showResult();
        this.#showFigures(report);
    }

    #showResult() {
        if (!this.#shown) {
            return;
        }
        const { object } = this.#state;
        const made = this.#made?.object === object ? this.#made : undefined;
        const waits = object !== undefined && made?.text !== (this.#known && JSON.stringify(this.#options));
        const stopped = waits && !this.#job && this.#stopped?.object === object && this.#stopped.text === JSON.stringify(this.#options);
        const seconds = this.#job ? Math.floor((performance.now() - this.#job.began) / 1000) : 0;
        const refused = !waits && made?.error !== undefined;
        const text = stopped ? say('Stopped; change something to begin again') :
            waits ? `${say('Covering {object}…', { object: object.name })}${seconds > 1 ? ` ${seconds} s` : ''}` :
            refused ? `${sentence(made.error)}.` : made ? wordsOf(made.report) : '';
        find('result').textContent = text;
        find('result').classList.toggle('refused', refused);
        find('dew-stop').hidden = !this.#job || performance.now() - this.#job.began < kLong;
        find('dew-hint').hidden = object !== undefined;
        root.dataset.dew = object === undefined ? 'empty' : waits ? stopped ? 'stopped' : 'working' : refused ? 'refused' : 'ready';
    }

    #showFigures(report) {
        tabulate(report ? rowsOf(report, this.#made.solve_ms) : [[say('Object'), say('none')]]);
        const many = report && report.input.triangles > kManyTriangles ?
            [say('{count} triangles are many for a browser; the command droplet-shape dew is faster.', { count: counted(report.input.triangles) })] : [];
        find('warnings').replaceChildren(...[...report?.warnings ?? [], ...many].map((warning) =>
            Object.assign(document.createElement('li'), { textContent: warning })));
        find('command-line').hidden = !report;
        if (report) {
            const { object, settings } = this.#state;
            find('command').textContent = dewCommandOf(object.name, this.#stem, { ...this.#options, ...formOf(this.#known, settings) });
        }
    }

    // Controls.

    #showFields = () => {};
    #showForm = () => {};

    #offer() {
        find('dew-open').addEventListener('click', () => find('dew-file').click());
        find('dew-file').addEventListener('change', (event) => {
            const files = [...event.target.files];
            event.target.value = '';
            if (files.length > 0) {
                hasObject(files) ? this.open(files) : complain(say('{file} is no mesh; .glb, .gltf, .obj, .ply and .stl are.', { file: files[0].name }));
            }
        });
        find('dew-bottle').addEventListener('click', async () => {
            await this.#start();
            this.#change({ object: bottle(), settings: { ...withPreset(this.#known, newSettings(this.#known), 'bottle'), ...kBottle } });
            find('dew-open').focus();  // this button goes
        });
        find('dew-again').addEventListener('click', () => {
            const { settings } = this.#state;
            const seed = settings.seed === '' ? this.#made?.report?.sizes.seed ?? 1 : settings.seed;
            this.#change({ settings: { ...settings, seed: seed + 1 } });
        });
        find('dew-stop').addEventListener('click', () => {
            this.#stop();
            find('dew-again').focus();
        });
        for (const button of find('dew-saves').querySelectorAll('[data-dew-save]')) {
            button.addEventListener('click', () => this.save(button.dataset.dewSave));
        }
    }

    #buildForms() {
        const changed = (name, value, run) => this.#change({ settings: withSetting(this.#state.settings, name, value) }, run);
        const { fields, presets } = this.#known;
        this.#showFields = buildForm(fields.filter(({ file }) => !file), { plain: find('dew-fields'), more: find('dew-more') }, 'dew', changed);
        this.#showForm = buildForm(fields.filter(({ file }) => file), { plain: find('dew-form') }, 'dew', changed);
        find('dew-fields').addEventListener('focusout', () => this.#update());
        for (const { name, label, title } of presets) {
            const choice = document.createElement('label');
            const radio = Object.assign(document.createElement('input'), { type: 'radio', name: 'dew-kind', value: name });
            radio.addEventListener('change', () => this.#change({ settings: withPreset(this.#known, this.#state.settings, name) }));
            choice.append(radio, label);
            choice.title = title ?? '';
            find('dew-kinds').append(choice);
        }
        [find('dew'), find('dew-saves')].forEach(translate);
    }

    // Files.

    get #stem() {
        return `${fileStem((this.#state.object?.name ?? 'object').replace(/\.\w+$/, ''))}-dew`;
    }

    async save(kind) {
        if (find('dew-saves').matches(':popover-open')) {
            find('dew-saves').hidePopover();
        }
        try {
            const name = kind === 'view' ? `${this.#stem}.png` : `${this.#stem}.${kind}`;
            download(kind === 'view' ? await this.#view.picture() : new Blob([await this.#bytes(kind)], { type: kTypes[kind] }), name);
            find('trouble').hidden = true;
            this.#say(say('{file} saved', { file: name }));
        } catch (error) {
            complain(say('Nothing was saved. {reason}.', { reason: sentence(error) }));
        }
    }

    async #bytes(format) {
        if (root.dataset.dew !== 'ready') {
            throw new Error(say('there are no droplets yet'));
        }
        const form = formOf(this.#known, this.#state.settings);
        if (format === 'usdz' && form.instancing === 'gpu') {
            delete form.instancing;  // USD has it by nodes
        }
        if (this.#covered !== this.#made.job) {
            await this.#cover(this.#made.job);  // another run was broken off, and the worker with it
        }
        return (await this.#servant().ask('dewFile', { format, form })).bytes;
    }
}

/** What decides where an object is in its file. */
const frameOf = ({ options: { objectSize, up } }) => `${objectSize} ${up}`;

function wordsOf({ droplets }) {
    const { count, volume_m3, covered_m2, area_m2 } = droplets;
    const text = count === 1 ? '{count} droplet, {volume} on {share}' : '{count} droplets, {volume} on {share}';
    return say(text, { count: counted(count), volume: volume(volume_m3), share: `${digits(100 * covered_m2 / area_m2, 2)}\u2009%` });
}

function rowsOf({ input, droplets, forces }, solve_ms) {
    const { count, volume_m3, smallest_m, largest_m, joined, run_off, between_edges, left_out, covered_m2, area_m2 } = droplets;
    return [
        ['Droplets', counted(count)], ['Volume', volume(volume_m3)], ['Covered', `${digits(100 * covered_m2 / area_m2, 3)}\u2009%`],
        ['Radii', say('{smallest} to {largest}', { smallest: length(smallest_m), largest: length(largest_m) })], ['Contact angle', `${digits(forces.contact_angle_deg)}°`],
        ['Joined others', counted(joined)], ['Ran off', counted(run_off)], ['Too large between edges', counted(between_edges)],
        ['Left out', counted(left_out)],
        ['Triangles of the object', counted(input.triangles)], ['Time', `${digits(solve_ms / 1000, 2)}\u00a0s`],
    ].map(([name, value]) => [say(name), value]);
}

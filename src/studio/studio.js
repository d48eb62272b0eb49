// SPDX-License-Identifier: MIT
// Studio: wires the drawing, the solver and the view to one project.
import { complain, drawScale, find, offerGrounds, tabulate } from '../html/controls.js';
import { length, rows, volume } from '../html/figures.js';
import { readPicture } from '../html/read_picture.js';
import { roundLength } from '../html/stage.js';
import { decimal, say, translate } from '../html/words.js';
import { History } from '../live/history.js';
import { blank, isDry, overlap } from './coverage.js';
import { Dew } from './dew.js';
import { lookNear } from './colours.js';
import { buildGallery, coverageOf, kDrawings } from './gallery.js';
import { ImportDialog } from './import_dialog.js';
import { beginLanguage, offerLanguages } from './language.js';
import { buildLayers } from './layers.js';
import { carriesDrawings, layoutOf, loadObject, withinLayout } from './laid_object.js';
import { kLiveParts, showLive } from './live_parts.js';
import markup from './markup.html';
import { inkOf, lookOf } from './looks.js';
import { commandOf, kLayerFields, kSceneFields, liquidOf, optionsOf } from './physics.js';
import { buildForm } from './physics_form.js';
import { asGlb, mainOf, readObject } from './object_files.js';
import { fitted, levelsOf, maskOfLevels } from './pictures.js';
import { kName, newLayer, newProject, objectBelow, projectOf, selectedLayer, shownName, withLayer } from './project.js';
import { save } from './save.js';
import { sentence } from './sentence.js';
import { Sheet } from './sheet.js';
import { Solver } from './solver.js';
import { Times } from './times.js';
import { buildTools } from './tool_buttons.js';
import { kTools } from './tools.js';
import { View } from './view.js';

const kDrawnSide = 1024;  // longer side of an SVG [pixels]
const kExample = 'example';  // id of the droplet that is shown while there is none
const kExampleTriangles = 8000;
const root = document.documentElement;

/** Keys of tools must not act while somebody writes. */
const writes = (target) => target.matches?.('input:not([type=range], [type=checkbox], [type=radio]), select, textarea');
/** Where the browser itself undoes what has been written. */
const undoes = (target) => writes(target) && !target.matches('select, [type=number]');

class Studio {
    constructor({ wasm, worker_url, project, keeper, kept, source }) {
        document.body.className = 'studio';
        document.body.dataset.part = 'draw';
        document.body.innerHTML = markup;
        this.history = new History(project);
        this.keeper = keeper;
        this.source = source;
        this.unsaved = kept;
        this.objects = new WeakMap();  // objects as the view shows them, before it does
        this.known = new Map();    // layer → {job, report, draft, error}: what is known of its droplet
        this.strokes = 0;
        this.tool = 'brush';
        this.setting = { size: 60, text: 'Aqua', font: 'sans', text_size: 320 };
        this.solver = new Solver({ wasm, worker_url }, {
            showed: (job, answer, draft) => this.#showed(job, answer, draft),
            failed: (job, error, draft) => this.#refused(job, error, draft),
            settled: () => this.#settle(),
        });
        this.sheet = new Sheet(
            { table: find('table'), paper: find('paper'), sheet: find('sheet'), cursor: find('cursor'), fit: find('fit') },
            {
                layers: () => this.#drawnLayers(),
                base: () => (selectedLayer(this.project).visible ? selectedLayer(this.project).mask : null),
                tool: () => ({ name: this.tool, removes: find('subtract').checked, setting: this.setting }),
            },
            {
                began: () => this.#began(),
                drew: (mask, rect, time) => this.#drew(mask, rect, time),
                ended: (mask) => this.#ended(mask),
                gaveUp: () => this.#gaveUp(),
                moved: (x, y) => this.#sayPlace(x, y),
            });
        this.#offerTools();
        this.#offerForms();
        this.#offerLayers();
        this.#offerFiles();
        this.#offerKeys();
        this.#offerView();
        this.import_dialog = new ImportDialog({ wasm, worker_url });
        this.dew = new Dew({
            parts: { wasm, worker_url }, view: this.view, say: (text) => this.#say(text), keeper, show_ground: (ground) => this.#showGround(ground),
        });
        this.#offerBeginning();
        this.#offerLanguages();
        this.#update(undefined);
        keeper?.beside('dew').then((dew) => dew?.shown && this.#show('dew'));
        find('kept').hidden = !kept;
        this.solver.ready.then(() => { root.dataset.solver = 'ready'; }, (error) => {
            complain(say('The solver does not run in this browser. Drawings can be saved all the same.'));
            console.error(error);
        });
        addEventListener('beforeunload', (event) => {
            if (this.unsaved && !this.keeper?.keeps(this.project)) {
                event.preventDefault();
            }
        });
    }

    get project() {
        return this.history.state;
    }

    /** Layers as the sheet draws them: the selected one as it is under the hand. */
    #drawnLayers() {
        const { layers, selected } = this.project;
        return layers.map(({ mask, liquid, visible }, index) => ({
            data: index === selected && this.stroke ? this.stroke.data : mask.data, ink: inkOf(lookOf(liquid)),
            selected: index === selected, visible,
        })).filter(({ visible }) => visible);
    }

    /** Goes on to another project, as a step that can be undone. */
    #change(project, run) {
        const before = this.project;
        this.history.add(project, run);
        this.#altered();
        this.#update(before);
    }

    /** The project is not as it was saved. */
    #altered(unsaved = true) {
        this.unsaved = unsaved;
        this.keeper?.keep(this.project);
        find('kept').hidden = true;
    }

    /** Shows the project, of which what is the same as before is shown already. */
    #update(before) {
        const { project } = this;
        const { width, height, scene, layers } = project;
        if (!before || width !== before.width || height !== before.height || scene.width !== before.scene.width) {
            this.sheet.resize(width, height, roundLength(scene.width / 12) / scene.width);
            this.#resize(this.setting.size);
            this.view?.fit(this.#extent());
        }
        if (!before || layers !== before.layers || project.selected !== before.selected || width !== before.width) {
            this.sheet.paint();
        }
        if (project.underlay !== before?.underlay) {
            find('underlay').hidden = !project.underlay;
            find('tracing').hidden = !project.underlay;
            if (project.underlay) {
                find('underlay').src = project.underlay.picture;
                find('underlay').style.opacity = project.underlay.opacity;
                find('opacity').value = project.underlay.opacity;
            }
        }
        if (document.activeElement !== find('name')) {
            find('name').value = shownName(project.name);
        }
        document.title = `${shownName(project.name)} – Droplet Studio`;
        find('laid').hidden = !objectBelow(project);
        find('saves').querySelectorAll('[data-laid]').forEach((each) => { each.hidden = !objectBelow(project); });
        find('saves').querySelector('[data-save=maps]').hidden = objectBelow(project) !== undefined;
        find('paper').classList.toggle('laid', objectBelow(project) !== undefined);
        find('laid-name').textContent = project.object?.name ?? '';
        this.#showObject(objectBelow(project));
        if (!this.dew.is_shown) {
            this.#showGround();
        }
        this.show_layers(project);
        this.show_liquid(selectedLayer(project).liquid);
        this.show_scene(scene);
        find('undo').disabled = !this.history.can_undo;
        find('redo').disabled = !this.history.can_redo;
        find('layer-remove').disabled = layers.length === 1;
        find('layer-up').disabled = project.selected === layers.length - 1;
        find('layer-down').disabled = project.selected === 0;
        this.#solve(before);
        this.#settle();
    }

    /** Shows a ground in the view; undefined: that of the drawing. */
    #showGround(ground = this.project.ground) {
        if (ground !== this.ground_shown) {
            this.ground_shown = ground;
            this.show_ground?.(ground);
        }
    }

    #extent() {
        const { width, height, scene } = this.project;
        return [scene.width * 1e-3, scene.width * 1e-3 * height / width];
    }

    /** Wants the droplets of layers that have changed, and removes those of layers that are dry or gone. */
    #solve(before) {
        const { layers, scene } = this.project;
        if (this.known.has(kExample) && !this.#is_empty) {
            this.#drop(kExample);
        }
        for (const { id } of before?.layers ?? []) {
            if (!layers.some((layer) => layer.id === id)) {
                this.#drop(id);
            }
        }
        for (const layer of layers) {
            const { job } = this.known.get(layer.id) ?? {};
            const options = optionsOf(layer, scene);
            const same = job && job.mask === layer.mask && job.object === objectBelow(this.project) && JSON.stringify(job.options) === JSON.stringify(options);
            this.view?.setVisible(layer.id, layer.visible);
            if (same) {
                continue;
            }
            if (isDry(layer.mask)) {
                this.#drop(layer.id);
            } else if (layer.visible) {
                this.#want(layer, layer.mask, performance.now());
            }
        }
    }

    /** Whether nothing is drawn and nothing lies below. */
    get #is_empty() {
        const { layers, underlay } = this.project;
        return !this.stroke && !underlay && !objectBelow(this.project) && layers.every(({ mask }) => isDry(mask));
    }

    /** Offers drawings to begin with; on the first empty sheet, one of them is shown. */
    #offerBeginning() {
        buildGallery(find('gallery'), (drawing) => this.#beginWith(drawing));
        if (this.view && this.#is_empty) {
            const { scene } = this.project;
            const mask = coverageOf(kDrawings[0], kDrawnSide, kDrawnSide);
            const options = { ...optionsOf(selectedLayer(this.project), scene), triangles: kExampleTriangles };
            const job = { id: kExample, mask, options, look: 'water', flat: true, input: performance.now(), stroke: kExample };
            this.known.set(kExample, { job });
            this.view.rise(kExample);
            this.solver.want(job);
        }
    }

    #beginWith({ name, look, ...drawing }) {
        const { project } = this;
        const layer = selectedLayer(project);
        const mask = coverageOf(drawing, project.width, project.height);
        this.view?.rise(layer.id);
        this.#change({ ...withLayer(project, { mask, liquid: { ...layer.liquid, ...liquidOf(look) } }), name: this.#nameAfter(say(name)) });
    }

    /** The project's name, or that of what it begins with if it has none of its own. */
    #nameAfter(name) {
        return this.project.name === kName ? name.replace(/\.\w+$/, '') || kName : this.project.name;
    }

    #want(layer, mask, time) {
        const { scene } = this.project;
        const known = this.known.get(layer.id) ?? {};
        // A job takes over the oldest input from one that it replaces before that is begun.
        const waiting = known.job && !known.job.begun ? known.job.input : time;
        const job = {
            id: layer.id, mask, options: optionsOf(layer, scene), look: lookOf(layer.liquid), flat: scene.ground === 'flat',
            object: objectBelow(this.project),
            input: Math.min(waiting, time), stroke: `${layer.id} ${this.strokes}`,
        };
        this.known.set(layer.id, { ...known, job });
        root.dataset.droplets = 'solving';
        this.solver.want(job);
    }

    #drop(id) {
        this.known.delete(id);
        this.solver.forget(id);
        this.view?.remove(id);
        this.#settle();
    }

    async #showed(job, { shape, report, solve_ms }, draft) {
        if (this.times?.slow) {
            await this.frame;  // slow graphics fall behind if they are given more frames than they can draw
        }
        const known = this.known.get(job.id);
        if (!known || (draft && this.solver.isWhole(job.id))) {
            return;
        }
        Object.assign(known, { report, draft, error: undefined });
        if (this.view) {
            if (draft && job.id !== kExample) {
                this.frame = this.times.came({ input: job.input, solve_ms });
            }
            this.view.stage.sketch(draft && this.times.slow);
            this.view.show(job.id, job.look, shape, job.flat);
            const layer = this.project.layers.find(({ id }) => id === job.id);
            this.view.setVisible(job.id, layer?.visible ?? true);
        }
        this.#settle();
    }

    #refused(job, error, draft) {
        const known = this.known.get(job.id);
        // A footprint that is too small for a draft may do for the whole mesh; that one's word counts.
        if (known && !draft) {
            Object.assign(known, { error, report: undefined });
            this.view?.remove(job.id);
        }
        this.#settle();
    }

    #settle() {
        const { layers } = this.project;
        if (!this.stroke && layers !== this.looked) {
            this.looked = layers;
            this.overlaps = layers.flatMap((upper, k) => layers.slice(0, k)
                .filter((lower) => upper.visible && lower.visible && overlap(lower.mask, upper.mask))
                .map((lower) => [upper.name, lower.name]));
        }
        this.#showFigures();
        if (!this.stroke && this.solver.at_rest && !this.dew.is_shown) {
            root.dataset.droplets = 'ready';
            this.view?.stage.sketch(false);
            this.view?.frame();
            this.#say(this.#words().replaceAll('\n', '; '));
        }
    }

    // A stroke: the mask under the hand is solved as it grows, and becomes a step when the hand leaves.

    #began() {
        ++this.strokes;
        this.solver.hold(true);
        this.keeper?.wait();
        find('hint').hidden = true;
        find('kept').hidden = true;
        if (this.known.has(kExample)) {
            this.#drop(kExample);
        }
    }

    #drew(mask, rect, time) {
        this.stroke = mask;
        this.sheet.paint(rect);
        const layer = selectedLayer(this.project);
        if (isDry(mask)) {
            this.#drop(layer.id);
        } else {
            this.#want(layer, mask, time);
        }
    }

    #ended(mask) {
        this.stroke = undefined;
        this.solver.hold(false);
        this.#change(withLayer(this.project, { mask }));
    }

    #gaveUp() {
        this.stroke = undefined;
        this.solver.hold(false);
        this.keeper?.keep(this.project);
        this.sheet.paint();
        this.#solve(undefined);
        this.#settle();
    }

    // Words and figures.

    #say(text) {
        if (find('said').textContent !== text) {
            find('said').textContent = text;
        }
    }

    #sayPlace(x, y) {
        const { width, scene } = this.project;
        const layer = selectedLayer(this.project);
        const at = Math.min(Math.floor(y), this.project.height - 1) * width + Math.min(Math.floor(x), width - 1);
        const metres = (pixels) => length(pixels * scene.width * 1e-3 / width);
        const is_liquid = (this.stroke ?? layer.mask).data[at] >= 128;
        find('where').textContent = say('{x} from the left, {y} from the top, {state}', { x: metres(x), y: metres(y), state: say(is_liquid ? 'liquid' : 'dry') });
    }

    /** Layers whose droplets are shown. */
    #drops() {
        return this.project.layers.filter((layer) => layer.visible && this.known.get(layer.id)?.report);
    }

    /** Why a layer has no droplet. */
    #refusal({ job, error }) {
        return job.object && error.code === 'NoSuchDroplet' && error.message.includes(job.object.name) ?
            say('No droplet lies on the object. Draw within the lines of its layout, and across no gap between them.') : sentence(error);
    }

    #words() {
        const errors = this.project.layers.filter(({ id, visible }) => visible && this.known.get(id)?.error)
            .map(({ id, name }) => `${this.project.layers.length > 1 ? `${shownName(name)}: ` : ''}${this.#refusal(this.known.get(id))}`);
        const liquids = this.#drops().map(({ id }) => {
            const { report: { liquid, shape } } = this.known.get(id);
            return say('{volume} of {liquid}, {height} high', { volume: volume(shape.volume_m3), liquid: say(liquid.name), height: length(shape.height_max_m) });
        });
        return [...errors, ...liquids].join('\n');
    }

    #showFigures() {
        if (this.dew.is_shown) {
            return;
        }
        const known = this.known.get(selectedLayer(this.project).id);
        const refused = this.project.layers.some(({ id, visible }) => visible && this.known.get(id)?.error);
        const draft = this.#drops().some(({ id }) => this.known.get(id).draft);
        find('result').textContent = (draft && !refused ? '≈ ' : '') + this.#words();
        find('result').classList.toggle('refused', refused);
        find('hint').hidden = find('begin').hidden = !this.#is_empty;
        const report = known?.report;
        const triangles = report?.output?.triangles ?? report?.mesh.triangles;
        tabulate(report ? [...rows(report), known.draft ? [say('Draft'), say('{count} triangles', { count: triangles })] :
            [say('Triangles'), String(triangles)]] : [[say('Layer'), say('no droplet')]]);
        const overlaps = (this.overlaps ?? []).map((names) => {
            const [upper, lower] = names.map(shownName);
            return say('{upper} overlaps {lower}: their droplets go through each other.', { upper, lower });
        });
        find('warnings').replaceChildren(...[...report && !known.draft ? report.warnings ?? [] : [], ...overlaps]
            .map((warning) => Object.assign(document.createElement('li'), { textContent: warning })));
        find('command-line').hidden = !report;
        if (report) {
            const { project } = this;
            const onto = objectBelow(project)?.name;
            find('command').textContent = commandOf(shownName(project.name).replaceAll('\'', ''),
                { ...optionsOf(selectedLayer(project), project.scene), ...onto && { onto } });
        }
    }

    #showTimes() {
        const { summary } = this.times;
        if (summary && find('times').open) {
            const ms = (value) => `${decimal(value.toFixed(1))} ms`;
            find('times').querySelector('tbody').replaceChildren(...[
                ['Drafts', String(summary.drafts)], ['Hand to eye, median', ms(summary.median)],
                ['Nine in ten within', ms(summary.nine_in_ten)], ['Solver, median', ms(summary.solve)],
            ].map(([name, value]) => {
                const row = document.createElement('tr');
                row.append(Object.assign(document.createElement('th'), { scope: 'row', textContent: say(name) }),
                    Object.assign(document.createElement('td'), { textContent: value }));
                return row;
            }));
        }
    }

    // Controls.

    #offerTools() {
        this.show_tool = buildTools(find('tools'), (tool) => this.#choose(tool));
        find('size').addEventListener('input', () => this.#resize(Number(find('size').value)));
        find('text').addEventListener('input', () => { this.setting.text = find('text').value; });
        find('font').addEventListener('change', () => { this.setting.font = find('font').value; });
        find('text-size').addEventListener('input', () => {
            if (find('text-size').checkValidity() && find('text-size').value !== '') {
                this.setting.text_size = find('text-size').valueAsNumber;
            }
        });
        this.#choose('brush');
        this.#resize(this.setting.size);
    }

    #choose(tool) {
        this.sheet.cancel();
        this.tool = tool;
        this.show_tool(tool);
        find('sizing').hidden = !kTools[tool].sized;
        find('writing').hidden = !kTools[tool].written;
        find('subtracting').hidden = ['eraser', 'move'].includes(tool);
        this.#nameSheet();
    }

    #nameSheet() {
        find('sheet').setAttribute('aria-label', say('Footprint, drawn with: {tool}', { tool: say(kTools[this.tool].name) }));
    }

    #resize(size) {
        this.setting.size = Math.min(300, Math.max(2, Math.round(size)));
        find('size').value = this.setting.size;
        const text = length(this.setting.size * this.project.scene.width * 1e-3 / this.project.width);
        find('size-text').textContent = text;
        find('size').setAttribute('aria-valuetext', text);
    }

    #offerForms() {
        this.show_liquid = buildForm(kLayerFields, { plain: find('liquid'), more: find('liquid-more') }, 'liquid', (name, value, run) => {
            const layer = selectedLayer(this.project);
            this.#change(withLayer(this.project, { liquid: { ...layer.liquid, [name]: value } }), run && `${layer.id} ${run}`);
        });
        this.show_scene = buildForm(kSceneFields, { plain: find('scene') }, 'scene', (name, value, run) => {
            if (value === 'object' && !this.project.object) {
                this.show_scene(this.project.scene);  // until there is one
                find('lay-file').click();
                return;
            }
            this.#change({ ...this.project, scene: { ...this.project.scene, [name]: value } }, run);
        });
        find('name').addEventListener('input', () => this.#change({ ...this.project, name: find('name').value.trim() || kName }, 'name'));
        find('opacity').addEventListener('input', () =>
            this.#change({ ...this.project, underlay: { ...this.project.underlay, opacity: Number(find('opacity').value) } }, 'opacity'));
        find('untrace').addEventListener('click', () => this.#change({ ...this.project, underlay: undefined }));
        find('lay').addEventListener('click', () => find('lay-file').click());
        find('lay-file').addEventListener('change', (event) => {
            const files = [...event.target.files];
            event.target.value = '';
            this.#lay(files);
        });
    }

    /** Lays the sheet on an object, whose texture it becomes. */
    async #lay(files) {
        const name = mainOf(files)?.name ?? files[0].name;
        find('trouble').hidden = true;
        try {
            if (!carriesDrawings(files)) {
                throw new Error(say('only a .glb or .gltf with texture coordinates can carry drawings'));
            }
            const [object, { width, height, scene, layers }] = [asGlb(await readObject(files)), this.project];
            const [shown, metres] = await Promise.all([loadObject(object), this.solver.widthOn(object, width, height)]);
            this.objects.set(object, shown);
            const masks = withinLayout(shown, layers.map(({ mask }) => mask));
            this.#change({
                ...this.project, object, layers: layers.map((layer, k) => ({ ...layer, mask: masks[k] })), scene: { ...scene, ground: 'object', width: Number((metres * 1e3).toPrecision(6)) },
                underlay: { picture: layoutOf(shown, width, height), opacity: 0.7 },
            });
            this.#say(say('The drawing lies on {file}', { file: name }));
        } catch (error) {
            complain(say('{file} cannot be opened. {reason}.', { file: name, reason: sentence(error) }));
        }
    }

    /** Shows the object that the droplets lie on. */
    async #showObject(object) {
        if (object === this.object_shown) {
            return;
        }
        this.object_shown = object;
        const shown = object && (this.objects.get(object) ?? await loadObject(object).catch(() => undefined));
        this.objects.delete(object);  // the view gives its memory back when it shows another
        if (object === this.object_shown) {
            this.view?.lay(shown);
        }
    }

    #offerLayers() {
        this.show_layers = buildLayers(find('layers'), {
            select: (selected) => this.#select(selected),
            show: (index, visible) => this.#change(withLayer(this.project, { visible }, index)),
            rename: (index, name) => (name === this.project.layers[index].name ? this.show_layers(this.project) : this.#change(withLayer(this.project, { name }, index))),
        });
        const insert = (layer) => {
            const { layers, selected } = this.project;
            this.#change({ ...this.project, layers: layers.toSpliced(selected + 1, 0, layer), selected: selected + 1 });
            this.#say(say('{layer} added', { layer: shownName(layer.name) }));
        };
        const free = (stem) => {
            const names = new Set(this.project.layers.map(({ name }) => name));
            return Array.from({ length: names.size + 1 }, (_, k) => `${stem} ${k + 1}`).find((name) => !names.has(name));
        };
        const swap = (by) => {
            const { layers, selected } = this.project;
            const moved = layers.toSpliced(selected, 1).toSpliced(selected + by, 0, layers[selected]);
            this.#change({ ...this.project, layers: moved, selected: selected + by });
        };
        find('layer-add').addEventListener('click', () => insert(newLayer(this.project.width, this.project.height, free('Layer'))));
        find('layer-copy').addEventListener('click', () => {
            const { name, mask, liquid } = selectedLayer(this.project);
            insert(newLayer(1, 1, free(name.replace(/ \d+$/, '')), { mask, liquid }));
        });
        find('layer-up').addEventListener('click', () => swap(1));
        find('layer-down').addEventListener('click', () => swap(-1));
        find('layer-clear').addEventListener('click', () => {
            if (!isDry(selectedLayer(this.project).mask)) {
                this.#change(withLayer(this.project, { mask: blank(this.project.width, this.project.height) }));
            }
        });
        find('layer-remove').addEventListener('click', () => {
            const { layers, selected } = this.project;
            this.#say(say('{layer} removed', { layer: shownName(layers[selected].name) }));
            this.#change({ ...this.project, layers: layers.toSpliced(selected, 1), selected: Math.max(0, selected - 1) });
        });
    }

    /** Selecting is no step of its own. */
    #select(selected) {
        const before = this.project;
        this.sheet.cancel();
        this.history.replace({ ...before, selected });
        this.keeper?.keep(this.project);
        this.#update(before);
    }

    #undo(step) {
        if (this.dew.is_shown) {
            this.dew.undo(step);
            return;
        }
        if (this.stroke) {
            this.sheet.cancel();
            return;
        }
        const before = this.project;
        const moved = this.history[step]();
        if (moved !== before) {
            this.#altered();
            this.#update(before);
        }
    }

    /** Shows another project, as a step that can be undone, so nothing is asked. */
    #replace(project, unsaved) {
        const before = this.project;
        this.history.add(project);
        this.#altered(unsaved);
        this.#update(before);
    }

    async #save(kind) {
        find('saves').hidePopover();
        try {
            const name = await save(kind, { project: this.project, solver: this.solver, view: this.view, drawn: this.#drops(), source: this.source });
            this.unsaved &&= !['project', 'page'].includes(kind);
            find('trouble').hidden = true;
            this.#say(say('{file} saved', { file: name }));
        } catch (error) {
            complain(say('Nothing was saved. {reason}.', { reason: sentence(error) }));
        }
    }

    #offerFiles() {
        find('saves').querySelector('[data-save=page]').hidden = !this.source;
        for (const button of find('saves').querySelectorAll('[data-save]')) {
            button.addEventListener('click', () => this.#save(button.dataset.save));
        }
        for (const name of kLiveParts) {
            find(name).hidden = false;
            find(name).addEventListener('click', () => showLive(name, { draw: (canvas, title) => this.#draw(canvas, title) }));
        }
        for (const button of [find('new'), find('afresh')]) {
            button.addEventListener('click', () => {
                if (this.dew.is_shown) {
                    this.dew.clear();
                    return;
                }
                this.#replace(newProject(), this.unsaved);
                this.#say(say('New project'));
            });
        }
        for (const button of [find('open'), find('begin-picture')]) {
            button.addEventListener('click', () => find('file').click());
        }
        find('file').addEventListener('change', (event) => {
            const files = [...event.target.files];
            event.target.value = '';
            this.#open(files);
        });
        let depth = 0;
        const dropping = (on) => document.body.classList.toggle('dropping', on);
        addEventListener('dragenter', () => dropping(++depth > 0));
        addEventListener('dragleave', () => dropping(--depth > 0));
        addEventListener('dragover', (event) => event.preventDefault());
        addEventListener('drop', (event) => {
            event.preventDefault();
            depth = 0;
            dropping(false);
            this.#open([...event.dataTransfer.files]);
        });
        addEventListener('paste', (event) => {
            const file = [...event.clipboardData?.files ?? []].find(({ type }) => type.startsWith('image/'));
            if (file) {
                event.preventDefault();
                this.#open([file]);
            }
        });
    }

    async #open(files) {
        const [file] = files;
        if (!file) {
            return;
        }
        if (this.dew.takes(files)) {
            const use = this.dew.is_shown || this.#is_empty || !carriesDrawings(files) ? 'dew' : await this.#askObject(mainOf(files).name);
            if (use !== 'dew') {
                return use === 'lay' ? this.#lay(files) : undefined;
            }
            this.#show('dew');
            this.dew.open(files);
            return;
        }
        if (this.dew.is_shown) {
            this.#show('draw');
        }
        find('trouble').hidden = true;
        try {
            if (/\.json$/i.test(file.name) || file.type === 'application/json') {
                this.#replace(await projectOf(await file.text()), false);
                this.#say(say('{file} opened', { file: shownName(this.project.name) }));
            } else {
                await this.#import(await readPicture(file, kDrawnSide), file.name);
            }
        } catch (error) {
            const reason = error instanceof DOMException ? say('It is no picture that this browser can read') : sentence(error);
            complain(say('{file} cannot be opened. {reason}.', { file: file.name, reason }));
        }
    }

    /** Asks what an object is for: dew, lay or empty. */
    async #askObject(name) {
        const dialog = find('object');
        find('object-title').textContent = name;
        dialog.returnValue = '';
        dialog.showModal();
        await new Promise((done) => { dialog.addEventListener('close', done, { once: true }); });
        return dialog.returnValue;
    }

    async #import(canvas, file_name) {
        const { use, mask, photo, colours } = await this.import_dialog.ask(canvas, inkOf(lookOf(selectedLayer(this.project).liquid)));
        if (use === 'footprint') {
            this.#take(mask, file_name);
        } else if (use === 'colours') {
            this.#divide(colours, file_name);
        } else if (use === 'underlay') {
            this.#change({ ...this.project, underlay: { picture: canvas.toDataURL(photo ? 'image/jpeg' : 'image/png', 0.9), opacity: 0.5 } });
        }
    }

    /** Takes every colour of a picture for a layer, in the look that comes nearest. Layers that are dry make room for them. */
    #divide(colours, file_name) {
        const { project } = this;
        const kept = project.layers.filter(({ mask }) => !isDry(mask));
        const { width, height } = kept.length === 0 && !objectBelow(project) ? colours[0].mask : project;
        const added = colours.map(({ colour, mask }, k) => newLayer(1, 1, say('Colour {number}', { number: k + 1 }), {
            mask: fitted(mask, width, height), liquid: { ...selectedLayer(project).liquid, ...liquidOf(lookNear(colour)) },
        }));
        const name = kept.length === 0 ? this.#nameAfter(file_name) : project.name;
        this.#change({ ...project, name, width, height, layers: [...kept, ...added], selected: kept.length });
    }

    /** Takes a drawing of a part over Studio, whose transparency is dry, and shows it on the sheet. */
    #draw(canvas, title) {
        this.#show('draw');
        this.#take(maskOfLevels(levelsOf(canvas), 0.5, false), title);
        this.#say(say('{drawing} is on the sheet', { drawing: title }));
    }

    /** Takes a mask for the selected layer. An empty sheet gets its size and its name. */
    #take(mask, file_name) {
        const { project } = this;
        if (project.layers.every(({ mask }) => isDry(mask)) && !objectBelow(project)) {
            const { width, height } = mask;
            const name = this.#nameAfter(file_name);
            const layers = project.layers.map((layer, k) => ({ ...layer, mask: k === project.selected ? mask : blank(width, height) }));
            this.#change({ ...project, name, width, height, layers });
        } else {
            this.#change(withLayer(project, { mask: fitted(mask, project.width, project.height) }));
        }
    }

    #offerKeys() {
        find('undo').addEventListener('click', () => this.#undo('undo'));
        find('redo').addEventListener('click', () => this.#undo('redo'));
        this.history.restIn(window);
        addEventListener('keydown', (event) => {
            const key = event.key.toLowerCase();
            if (find('import').open || find('object').open || event.altKey) {
                return;
            }
            if (event.ctrlKey || event.metaKey) {
                const act = {
                    z: () => this.#undo(event.shiftKey ? 'redo' : 'undo'), y: () => this.#undo('redo'),
                    s: () => (this.dew.is_shown ? this.dew.save('glb') : this.#save('project')), o: () => find('file').click(),
                }[key];
                if (act && !(undoes(event.target) && 'zy'.includes(key))) {
                    event.preventDefault();
                    act();
                }
                return;
            }
            if (writes(event.target) || this.dew.is_shown) {
                return;
            }
            const tool = Object.keys(kTools).find((name) => kTools[name].key === key);
            if (tool) {
                this.#choose(tool);
            } else if (key === '[' || key === ']') {
                this.#resize(this.setting.size * (key === '[' ? 1 / 1.25 : 1.25));
            } else if (key === 'x') {
                find('subtract').checked = !find('subtract').checked;
            }
        });
        for (const button of find('tabs').querySelectorAll('button')) {
            button.addEventListener('click', () => this.#show(button.dataset.part));
        }
        for (const mode of document.getElementsByName('mode')) {
            mode.addEventListener('change', () => this.#show(mode.value));
        }
    }

    /** Shows dew on an object, or the drawing; on phones, a part of the drawing's settings in its place. */
    #show(part) {
        this.sheet.cancel();
        document.body.dataset.part = part;
        find('tabs').querySelectorAll('button').forEach((each) => each.setAttribute('aria-pressed', each.dataset.part === part));
        for (const mode of document.getElementsByName('mode')) {
            mode.checked = mode.value === (part === 'dew' ? 'dew' : 'draw');
        }
        const left = this.dew.is_shown && part !== 'dew';
        this.dew.show(part === 'dew');
        if (left) {
            this.#update(this.project);
        }
    }

    /** Translates what has been built in English, and again when another language is chosen. */
    #offerLanguages() {
        offerLanguages(document.querySelectorAll('.language select'), () => {
            translate(document.body);
            this.#nameSheet();
            this.#resize(this.setting.size);
            this.#update(this.project);
            this.#showTimes();
            this.dew.retell();
            this.view && drawScale(this.view.stage);
        });
        translate(document.body);
    }

    #offerView() {
        let frames = 0;
        try {
            this.view = new View({
                canvas: find('view'), extent: this.#extent(), still: matchMedia('(prefers-reduced-motion: reduce)').matches,
                drawn: (is_last) => {
                    drawScale(this.view.stage);
                    this.times.drawn();
                    root.dataset.frames = ++frames;
                    root.dataset.state = is_last ? 'resting' : 'moving';
                    if (is_last) {
                        this.#showTimes();
                    }
                },
            });
        } catch (error) {
            complain(say('This browser does not show droplets in 3D. Drawing, figures and files are here all the same.'));
            find('grounds').hidden = true;
            root.dataset.state = 'failed';
            console.error(error);
            return;
        }
        const { stage } = this.view;
        this.times = new Times(stage.renderer.getContext());
        window.studioTimes = this.times;
        this.times.learn(() => stage.renderer.render(stage.scene, stage.camera));
        this.ground_shown = this.project.ground;
        this.show_ground = offerGrounds(stage, this.ground_shown, (ground) => {
            this.ground_shown = ground;
            this.dew.is_shown ? this.dew.choose(ground) : this.#change({ ...this.project, ground });
        });
        find('reset').addEventListener('click', () => stage.reset());
        find('times').addEventListener('toggle', () => this.#showTimes());
    }
}

/**
 * Opens Studio in this document, in the user's language.
 * @param wasm        the solver: bytes, or the compiled module
 * @param worker_url  of solver_worker.js
 * @param project     the first one
 * @param keeper      keeps the project in the browser; undefined: it is not kept
 * @param kept        whether the keeper had the first project
 * @param source      of the page in which Studio is alone, for saving it with a drawing
 */
export function openStudio({ wasm, worker_url, project, keeper, kept = false, source }) {
    beginLanguage();
    return new Studio({ wasm, worker_url, project: project ?? newProject(), keeper, kept, source });
}

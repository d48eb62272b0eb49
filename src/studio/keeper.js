// SPDX-License-Identifier: MIT
// Keeps the project in the browser, for the next opening. Where the browser refuses, nothing is kept and nothing is said.
import { isDry } from './coverage.js';
import { projectOf, textOf } from './project.js';

const kStore = 'projects';
const kPause = 700;      // without a change, the project is kept [ms]
const kPatience = 1500;  // for a browser that does not answer, at the opening [ms]

const isBlank = ({ layers, underlay }) => !underlay && layers.every(({ mask }) => isDry(mask));

const answerOf = (request) => new Promise((resolve, reject) => {
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
});

function openStore() {
    const request = indexedDB.open('droplet-studio', 1);
    request.onupgradeneeded = () => request.result.createObjectStore(kStore);
    return answerOf(request);
}

/** Writes a value, or removes it if undefined; waits until it is on the disk, since there may be no room. */
function written(store, key, value) {
    return new Promise((resolve, reject) => {
        const transaction = store.transaction(kStore, 'readwrite');
        transaction.oncomplete = resolve;
        transaction.onabort = () => reject(transaction.error);
        const records = transaction.objectStore(kStore);
        value === undefined ? records.delete(key) : records.put(value, key);
    });
}

/** Whether this window alone keeps the project; until it closes, others of the same page do not. */
function isAlone(name) {
    return new Promise((resolve) => {
        // A page that is loaded again waits a moment for its former self.
        navigator.locks.request(name, { signal: AbortSignal.timeout(kPatience / 3) }, () => {
            resolve(true);
            return new Promise(() => {});
        }).catch(() => resolve(false));
    });
}

export class Keeper {
    #store;
    #place;
    #wanted;
    #kept;
    #pause;
    #writing;

    constructor(store, place) {
        this.#store = store;
        this.#place = place;
        addEventListener('visibilitychange', () => this.#write());
    }

    /** Opens what is kept for this page; returns {keeper, project}, which are undefined where the browser has none. */
    static open(place = location.pathname) {
        const opening = (async () => {
            if (!await isAlone(`droplet-studio ${place}`)) {
                return {};
            }
            const store = await openStore();
            const keeper = new Keeper(store, place);
            const text = await answerOf(store.transaction(kStore).objectStore(kStore).get(place));
            const project = text === undefined ? undefined : await projectOf(text).catch(() => undefined);
            keeper.#kept = project;
            return { keeper, project };
        })().catch(() => ({}));
        return Promise.race([opening, new Promise((resolve) => { setTimeout(() => resolve({}), kPatience); })]);
    }

    #tell() {
        document.documentElement.dataset.kept = this.#kept === this.#wanted ? 'yes' : 'no';
    }

    /** Keeps another value under a name, beside the project. */
    keepBeside(name, value) {
        return written(this.#store, [this.#place, name], value).catch(() => {});
    }

    /** What was kept under a name; or undefined. */
    beside(name) {
        return answerOf(this.#store.transaction(kStore).objectStore(kStore).get([this.#place, name])).catch(() => undefined);
    }

    /** Keeps a project, as soon as the hand rests. */
    keep(project) {
        this.#wanted = project;
        this.#tell();
        clearTimeout(this.#pause);
        this.#pause = setTimeout(() => this.#write(), kPause);
    }

    /** While the hand draws, nothing is written. */
    wait() {
        clearTimeout(this.#pause);
    }

    /** Whether this project is kept, or has nothing to keep. */
    keeps(project) {
        return project === this.#kept;
    }

    /** Writes the newest project, one at a time. */
    #write() {
        clearTimeout(this.#pause);
        this.#writing ??= (async () => {
            while (this.#wanted && this.#wanted !== this.#kept) {
                const project = this.#wanted;
                const text = isBlank(project) ? undefined : await textOf(project);
                await written(this.#store, this.#place, text);
                this.#kept = project;
                this.#tell();
            }
        })().catch(() => {}).finally(() => { this.#writing = undefined; });
    }
}

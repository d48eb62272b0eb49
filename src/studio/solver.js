// SPDX-License-Identifier: MIT
// Two workers: one makes drafts while the hand draws, the other the whole mesh when it rests. A job that a newer one of
// the same layer replaces is not begun; a whole mesh that is no longer wanted is broken off.
import { say } from '../html/words.js';

const kRest = 250;  // without a change, the hand rests [ms]

/** A worker that answers each message. */
export class Servant {
    constructor({ worker_url, wasm }, drafts = false) {
        this.worker = new Worker(worker_url);
        this.waiting = new Map();
        this.token = 0;
        this.worker.addEventListener('message', ({ data: { token, error, ...answer } }) => {
            const { resolve, reject } = this.waiting.get(token);
            this.waiting.delete(token);
            if (error) {
                reject(Object.assign(new Error(error.message), { code: error.code }));
            } else {
                resolve(answer);
            }
        });
        this.worker.addEventListener('error', (event) => {
            const error = Object.assign(new Error(event.message || say('the solver stopped')), { code: 'Internal' });
            this.waiting.forEach(({ reject }) => reject(error));
            this.waiting.clear();
        });
        this.ready = this.ask('start', { wasm, drafts });  // other acts wait for it there
        this.ready.catch(() => {});  // they tell, too
    }

    ask(act, message, transferred = []) {
        return new Promise((resolve, reject) => {
            this.waiting.set(++this.token, { resolve, reject });
            this.worker.postMessage({ act, token: this.token, ...message }, transferred);
        });
    }

    async solve(job, draft) {
        if (this.object !== job.object) {
            this.object = job.object;
            await this.ask('layOn', { object: job.object });
        }
        const data = job.mask.data.slice();
        return this.ask('solve', {
            id: job.id, options: job.options, stroke: job.stroke, draft, mask: { width: job.mask.width, height: job.mask.height, data },
        }, [data.buffer]);
    }

    stop() {
        this.worker.terminate();
        this.waiting.forEach(({ reject }) => reject(Object.assign(new Error(say('broken off')), { code: 'BrokenOff' })));
        this.waiting.clear();
    }
}

export class Solver {
    /**
     * @param parts     {worker_url, wasm}
     * @param showed    called with (job, answer, is_draft) for every droplet; the next draft waits for what it returns
     * @param failed    called with (job, error, is_draft)
     * @param settled   called when all drafts are made
     */
    constructor(parts, { showed, failed, settled }) {
        Object.assign(this, { parts, showed, failed, settled });
        this.jobs = new Map();     // the newest of every layer
        this.drafts = new Map();   // those of which a draft is shown
        this.wholes = new Map();   // those of which the whole mesh is shown, or is refused
        this.kept = new Map();     // those whose droplet the worker still holds
        this.drafter = new Servant(parts, true);
        this.finisher = new Servant(parts);
    }

    get ready() {
        return Promise.all([this.drafter.ready, this.finisher.ready]);
    }

    /** Wants a layer's droplet: job {id, mask, options, …}. */
    want(job) {
        this.jobs.set(job.id, job);
        this.#breakOff(job.id);
        clearTimeout(this.resting);
        if (!this.held) {
            this.resting = setTimeout(() => this.#finish(), kRest);
        }
        this.#draft();
    }

    /** While the hand draws, no whole mesh is begun. */
    hold(held) {
        this.held = held;
        clearTimeout(this.resting);
        if (!held) {
            this.resting = setTimeout(() => this.#finish(), kRest);
        }
    }

    forget(id) {
        this.#breakOff(id);
        for (const known of [this.jobs, this.drafts, this.wholes, this.kept]) {
            known.delete(id);
        }
    }

    #breakOff(id) {
        if (this.finishing?.id === id) {
            this.finishing = undefined;
            this.#renewFinisher();
        }
    }

    #renewFinisher() {
        this.finisher.stop();
        this.finisher = new Servant(this.parts);
        this.kept.clear();
    }

    async #draft() {
        if (this.drafting) {
            return;
        }
        const job = [...this.jobs.values()].find((wanted) => this.drafts.get(wanted.id) !== wanted && this.wholes.get(wanted.id) !== wanted);
        if (!job) {
            this.settled();
            return;
        }
        this.drafting = job;
        job.begun = true;
        this.drafts.set(job.id, job);
        try {
            const answer = await this.drafter.solve(job, true);
            // An older draft is still nearer to the hand than what is shown; a whole mesh is not replaced by its draft.
            if (this.jobs.has(job.id) && !this.isWhole(job.id)) {
                await this.showed(job, answer, true);
            }
        } catch (error) {
            if (error.code === 'Internal') {
                this.drafter.stop();
                this.drafter = new Servant(this.parts, true);
            }
            if (!error.code) {
                console.error(error);  // not the solver's
            } else if (this.jobs.get(job.id) === job) {
                this.failed(job, error, true);
            }
        }
        this.drafting = undefined;
        this.#draft();
    }

    /** Makes whole meshes of all layers that have none. */
    #finish() {
        this.finished ??= (async () => {
            for (;;) {
                const job = [...this.jobs.values()].find((wanted) => this.wholes.get(wanted.id) !== wanted);
                if (!job || this.held || !await this.#make(job)) {
                    return;
                }
            }
        })().finally(() => { this.finished = undefined; });
        return this.finished;
    }

    /** Makes a whole mesh; returns whether it was not broken off. */
    async #make(job) {
        this.finishing = job;
        const outcome = await this.finisher.solve(job, false).then((answer) => ({ answer }), (error) => ({ error }));
        if (this.finishing !== job) {
            return false;
        }
        this.finishing = undefined;
        this.wholes.set(job.id, job);
        if (outcome.error?.code === 'Internal') {
            this.#renewFinisher();
        }
        if (outcome.error) {
            this.kept.delete(job.id);
            this.failed(job, outcome.error, false);
        } else {
            this.kept.set(job.id, job);
            this.showed(job, outcome.answer, false);
        }
        return true;
    }

    /** Width of a sheet of these sides if it is the texture of an object [m]; throws if it cannot be. */
    async widthOn(object, width, height) {
        return (await this.drafter.ask('widthOn', { object, width, height })).width;
    }

    /** Whether the newest of a layer is shown, or refused, as a whole mesh. */
    isWhole(id) {
        return this.wholes.get(id) === this.jobs.get(id);
    }

    /** Whether every layer's whole mesh is shown or refused. */
    get at_rest() {
        return !this.drafting && [...this.jobs.values()].every((job) => this.wholes.get(job.id) === job);
    }

    /**
     * Bytes of the whole meshes' files, in the order of these layers; a layer without a droplet throws its error.
     * @param with_object  whether the first one has the object that the droplets lie on
     */
    files(ids, format, with_object) {
        return this.#ofWhole(ids, async (id, k) => (await this.finisher.ask('file', { id, format, with_object: with_object && k === 0 })).bytes);
    }

    /** Maps of the whole meshes, by name, in the order of these layers. */
    maps(ids, path) {
        return this.#ofWhole(ids, async (id) => (await this.finisher.ask('maps', { id, path })).files);
    }

    /** Asks for each of these layers, when its whole mesh is made. */
    async #ofWhole(ids, ask) {
        await this.#finish();
        const answers = [];
        for (const id of ids) {
            const job = this.jobs.get(id);
            if (this.kept.get(id) !== job) {
                await this.finisher.solve(job, false);
                this.kept.set(id, job);
            }
            answers.push(await ask(id, answers.length));
        }
        return answers;
    }
}

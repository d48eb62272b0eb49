// SPDX-License-Identifier: MIT
// Undo and redo: states that share what did not change. States are never written to. Each part of Studio has its own.

const kMemory = 96 << 20;  // [bytes]; masks take nearly all of it

/** Bytes of the masks that any of the states holds. */
function bytesOf(states) {
    const masks = new Set(states.flatMap(({ layers }) => layers.map(({ mask }) => mask)));
    return [...masks].reduce((sum, { data }) => sum + data.byteLength, 0);
}

export class History {
    /**
     * @param memory  bytes that all states may hold; the oldest go first
     * @param held    gives the bytes that a list of states holds
     */
    constructor(state, memory = kMemory, held = bytesOf) {
        Object.assign(this, { memory, held });
        this.reset(state);
    }

    reset(state) {
        this.states = [state];
        this.at = 0;
        this.run = undefined;
    }

    get state() {
        return this.states[this.at];
    }

    /**
     * Adds a state; what was undone is forgotten.
     * @param run  changes with the same name, one after another, such as those of a slider, are one step
     */
    add(state, run) {
        const joins = run !== undefined && run === this.run && this.at === this.states.length - 1 && this.at > 0;
        this.states.length = joins ? this.at : this.at + 1;
        this.states.push(state);
        while (this.states.length > 2 && this.held(this.states) > this.memory) {
            this.states.shift();
        }
        this.at = this.states.length - 1;
        this.run = run;
    }

    /** Replaces the current state by one that differs in what is not undone, such as the selection. */
    replace(state) {
        this.states[this.at] = state;
    }

    /** Ends runs in a part of the page when a pointer goes down or the focus moves: what comes then is another act. */
    restIn(target) {
        for (const kind of ['pointerdown', 'focusin']) {
            target.addEventListener(kind, () => { this.run = undefined; }, { capture: true });
        }
    }

    get can_undo() {
        return this.at > 0;
    }

    get can_redo() {
        return this.at < this.states.length - 1;
    }

    undo() {
        this.at -= this.can_undo;
        this.run = undefined;
        return this.state;
    }

    redo() {
        this.at += this.can_redo;
        this.run = undefined;
        return this.state;
    }
}

// SPDX-License-Identifier: MIT
// From the hand to the eye: times of drafts, each from the oldest input in it to the end of the frame that shows it.

const kKept = 500;
const kSlow = 12;  // a frame of nothing but ground that takes longer is one of slow graphics [ms]

export class Times {
    constructor(gl) {
        this.gl = gl;
        this.drafts = [];   // {input, sent, solve_ms, came, drawn, shown} [ms]
        this.slow = false;
        this.open = [];     // drafts that no finished frame shows yet
    }

    /** Whether the graphics are slow; learnt from a frame without droplets, drawn when its shaders are ready. */
    async learn(render) {
        render();
        await this.#done();
        const began = performance.now();
        render();
        await this.#done();
        this.slow = performance.now() - began > kSlow;
    }

    /** Waits until the graphics card has done its commands. */
    #done() {
        const { gl } = this;
        const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
        gl.flush();
        return new Promise((done) => {
            const wait = () => {
                if (!fence || gl.isContextLost() || gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.SIGNALED) {
                    gl.deleteSync(fence);
                    done();
                } else {
                    setTimeout(wait);
                }
            };
            setTimeout(wait);
        });
    }

    /** A draft came; the promise returned is kept when a frame shows it. */
    came(times) {
        return new Promise((done) => { this.open.push({ ...times, came: performance.now(), done }); });
    }

    /** A frame's commands were given; it is shown when the graphics card has done them. */
    drawn() {
        const drafts = this.open.splice(0);
        if (drafts.length === 0) {
            return;
        }
        const now = performance.now();
        this.#done().then(() => {
            const shown = performance.now();
            for (const { done, ...draft } of drafts) {
                this.drafts.push({ ...draft, drawn: now, shown });
                done();
            }
            this.drafts.splice(0, this.drafts.length - kKept);
        });
    }

    /** Median, and the time that nine in ten do not exceed, from input to frame [ms]; undefined without drafts. */
    get summary() {
        const sorted = (list) => list.sort((a, b) => a - b);
        const total = sorted(this.drafts.map(({ input, shown }) => shown - input));
        const solve = sorted(this.drafts.map(({ solve_ms }) => solve_ms));
        const at = (list, share) => list[Math.min(list.length - 1, Math.floor(share * list.length))];
        return total.length === 0 ? undefined :
            { drafts: total.length, median: at(total, 0.5), nine_in_ten: at(total, 0.9), solve: at(solve, 0.5) };
    }
}

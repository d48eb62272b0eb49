// SPDX-License-Identifier: MIT
// From the hand to the eye: times of drafts, each from the oldest input in it to the end of the frame that shows it.

const kKept = 500;

export class Times {
    constructor(gl) {
        this.gl = gl;
        this.drafts = [];   // {input, sent, solve_ms, came, drawn, shown} [ms]
        this.open = [];     // drafts that no finished frame shows yet
    }

    came(times) {
        this.open.push({ ...times, came: performance.now() });
    }

    /** A frame's commands were given; it is shown when the graphics card has done them. */
    drawn() {
        const drafts = this.open.splice(0);
        if (drafts.length === 0) {
            return;
        }
        const { gl } = this;
        const now = performance.now();
        const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
        gl.flush();
        const wait = () => {
            if (gl.isContextLost() || !fence) {
                return;
            }
            if (gl.getSyncParameter(fence, gl.SYNC_STATUS) !== gl.SIGNALED) {
                setTimeout(wait);
                return;
            }
            gl.deleteSync(fence);
            const shown = performance.now();
            this.drafts.push(...drafts.map((draft) => ({ ...draft, drawn: now, shown })));
            this.drafts.splice(0, this.drafts.length - kKept);
        };
        setTimeout(wait);
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

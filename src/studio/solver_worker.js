// SPDX-License-Identifier: MIT
// The solver in a worker. It knows one job at a time; which jobs are worth doing is decided in solver.js.
import { loadSolver } from '../../npm/droplet_shape.js';
import { dewActs } from './dew_acts.js';

const kDraftTriangles = 5000;
const kDraftSide = 512;  // pixels; the triangles are longer than four of these
const kPatience = 16;    // a draft of the exact model that takes longer is the stroke's last [ms]
const kWarmUps = 12;     // drafts until a browser has compiled the solver for speed

let solver;
let below;       // object that droplets lie on
let tried = {};  // models that may do for the stroke
const droplets = new Map();  // by layer, for its files

/**
 * What is drawn of the triangles: not the base on flat ground, which no view shows.
 */
function drawnOf(triangles, positions, flat) {
    if (!flat) {
        return triangles;
    }
    const kept = new Uint32Array(triangles.length);
    let count = 0;
    for (let i = 0; i < triangles.length; i += 3) {
        const [a, b, c] = [3 * triangles[i], 3 * triangles[i + 1], 3 * triangles[i + 2]];
        const down = (positions[b] - positions[a]) * (positions[c + 1] - positions[a + 1]) -
            (positions[b + 1] - positions[a + 1]) * (positions[c] - positions[a]) < 0;
        if (!down || Math.max(positions[a + 2], positions[b + 2], positions[c + 2]) > 1e-12) {
            kept.set(triangles.subarray(i, i + 3), count);
            count += 3;
        }
    }
    return kept.slice(0, count);
}

/** The surface in y up, as three.js has it, and the box around it [m]. */
function shapeOf({ surface, report }) {
    const { positions, normals, triangles } = surface;
    const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
    const turned = [positions, normals].map((vectors) => {
        const result = new Float32Array(vectors.length);
        for (let i = 0; i < vectors.length; i += 3) {
            result[i] = vectors[i];
            result[i + 1] = vectors[i + 2];
            result[i + 2] = -vectors[i + 1];
        }
        return result;
    });
    for (let i = 0; i < positions.length; i += 3) {
        for (let k = 0; k < 3; ++k) {
            box[k] = Math.min(box[k], turned[0][i + k]);
            box[k + 3] = Math.max(box[k + 3], turned[0][i + k]);
        }
    }
    return {
        positions: turned[0], normals: turned[1], triangles: drawnOf(triangles, positions, report.ground.kind === 'flat' && !report.onto), box,
        thickness: report.shape.volume_m3 / report.mesh.footprint_area_m2,
    };
}

/** A mask whose pixels are the means of squares, and its options. */
function coarser({ width, height, data }, options) {
    const step = Math.ceil(Math.max(width, height) / kDraftSide);
    if (step === 1) {
        return [{ width, height, data }, options];
    }
    const small = { width: Math.ceil(width / step), height: Math.ceil(height / step) };
    small.data = new Uint8Array(small.width * small.height);
    const sums = new Uint32Array(small.width);
    for (let y = 0; y < small.height; ++y) {
        sums.fill(0);
        for (let row = y * step; row < Math.min((y + 1) * step, height); ++row) {
            for (let x = 0, at = row * width; x < small.width; ++x) {
                for (const end = Math.min(at + step, (row + 1) * width); at < end; ++at) {
                    sums[x] += data[at];
                }
            }
        }
        for (let x = 0; x < small.width; ++x) {
            small.data[y * small.width + x] = sums[x] / (step * step);
        }
    }
    return [small, { ...options, width: `${parseFloat(options.width) * small.width * step / width}mm` }];
}

/**
 * A draft by the exact model, which is nearer to the whole mesh, or by the linear one, which is faster and has nearly
 * every droplet. The exact one is tried again with every stroke.
 */
function draftOf({ mask, options, stroke }) {
    if (stroke !== tried.stroke) {
        tried = { stroke, models: ['exact', 'linear', 'auto'] };
    }
    const [small, coarse] = coarser(mask, options);
    const models = options.model === 'linear' ? ['linear'] : tried.models;
    for (;;) {
        const began = performance.now();
        const [model] = models;
        try {
            return solver.makeDroplet(small, { ...coarse, triangles: kDraftTriangles, model });
        } catch (error) {
            if (models.length === 1) {
                throw error;
            }
            models.shift();
        } finally {
            if (model === 'exact' && models[0] === 'exact' && performance.now() - began > kPatience) {
                models.shift();
            }
        }
    }
}

/** Makes drafts of a disc, until the solver is as fast as it will be. */
function warmUp() {
    const mask = { width: kDraftSide, height: kDraftSide, data: new Uint8Array(kDraftSide ** 2) };
    for (let y = 0; y < kDraftSide; ++y) {
        for (let x = 0; x < kDraftSide; ++x) {
            mask.data[y * kDraftSide + x] = Math.hypot(x - kDraftSide / 2, y - kDraftSide / 2) < kDraftSide / 3 ? 255 : 0;
        }
    }
    for (let k = 0; k < kWarmUps; ++k) {
        shapeOf(draftOf({ mask, options: { width: '20mm' }, stroke: k }));
    }
}

const acts = {
    ...dewActs(() => solver),
    async start({ wasm, drafts }) {
        solver = await loadSolver(wasm);
        if (drafts) {
            warmUp();
        }
        return { started: true };
    },
    solve(job) {
        const began = performance.now();
        droplets.get(job.id)?.free();
        droplets.delete(job.id);
        const given = { ...job, options: { ...job.options, onto: below } };
        const droplet = job.draft ? draftOf(given) : solver.makeDroplet(job.mask, given.options);
        const shape = shapeOf(droplet);
        const { report } = droplet;
        if (job.draft) {
            droplet.free();
        } else {
            droplets.set(job.id, droplet);
        }
        return [{ id: job.id, shape, report, solve_ms: performance.now() - began },
            [shape.positions.buffer, shape.normals.buffer, shape.triangles.buffer]];
    },
    mask({ picture, seeds }) {
        const { width, height, data } = solver.readMask(picture, { seeds });
        const coverage = Uint8Array.from(data, (level) => level >> 8);
        return [{ mask: { width, height, data: coverage } }, [coverage.buffer]];
    },
    layOn({ object }) {
        below = object;
        return {};
    },
    widthOn({ object, width, height }) {
        const sheet = { width, height, data: new Uint8Array(width * height) };
        return { width: width * solver.readMask(sheet, { onto: object }).pixelSize };
    },
    file({ id, format, with_object }) {
        const bytes = droplets.get(id).file(format, { dropletsOnly: !with_object });
        return [{ bytes }, [bytes.buffer]];
    },
    maps({ id, path }) {
        const files = droplets.get(id).maps({ path });
        return [{ files }, Object.values(files).map(({ buffer }) => buffer)];
    },
};

let started;  // all acts but the first wait for it
addEventListener('message', async ({ data }) => {
    try {
        const answered = await (data.act === 'start' ? started = acts.start(data) : started.then(() => acts[data.act](data)));
        const [answer, transferred] = Array.isArray(answered) ? answered : [answered];
        postMessage({ ...answer, token: data.token }, transferred ?? []);
    } catch (error) {
        postMessage({ token: data.token, error: { code: error.code ?? 'Internal', message: error.message } });
    }
});

// SPDX-License-Identifier: MIT
// The solver in a worker. It knows one job at a time; which jobs are worth doing is decided in solver.js.
import { loadSolver } from '../../npm/droplet_shape.js';

const kDraftTriangles = 5000;

let solver;
const droplets = new Map();  // by layer, for its files

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
        positions: turned[0], normals: turned[1], triangles, box,
        thickness: report.shape.volume_m3 / report.mesh.footprint_area_m2,
    };
}

function solve({ mask, options, draft }) {
    if (!draft) {
        return solver.makeDroplet(mask, options);
    }
    const coarse = { ...options, triangles: kDraftTriangles };
    try {
        return solver.makeDroplet(mask, { ...coarse, model: 'linear' });
    } catch (error) {
        if (options.model === 'linear') {
            throw error;
        }
        return solver.makeDroplet(mask, coarse);
    }
}

const acts = {
    async start({ wasm }) {
        solver = await loadSolver(wasm);
        return { started: true };
    },
    solve(job) {
        const began = performance.now();
        droplets.get(job.id)?.free();
        droplets.delete(job.id);
        const droplet = solve(job);
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
    file({ id, format }) {
        const bytes = droplets.get(id).file(format);
        return [{ bytes }, [bytes.buffer]];
    },
};

addEventListener('message', async ({ data }) => {
    try {
        const answered = await acts[data.act](data);
        const [answer, transferred] = Array.isArray(answered) ? answered : [answered];
        postMessage({ ...answer, token: data.token }, transferred ?? []);
    } catch (error) {
        postMessage({ token: data.token, error: { code: error.code ?? 'Internal', message: error.message } });
    }
});

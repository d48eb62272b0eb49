// SPDX-License-Identifier: MIT
// What the solver's worker does for objects with droplets. It holds one object and what covers it.

/**
 * @param solver  gives the solver
 * @return acts, as those of solver_worker.js
 */
export function dewActs(solver) {
    let object;
    let covered;
    const giveBack = () => {
        covered?.free();
        covered = undefined;
    };
    return {
        dewOptions: () => ({ options: solver().dewOptions }),
        object(given) {
            giveBack();
            object = given.object;
            return {};
        },
        dew({ options }) {
            const began = performance.now();
            giveBack();
            covered = solver().dew(object, options);
            // One mesh, as long as these are not too many: graphics in software draw each instance by itself.
            const bytes = covered.file('glb', { instancing: 'auto', compress: 'none' });
            return [{ report: covered.report, bytes, solve_ms: performance.now() - began }, [bytes.buffer]];
        },
        dewFile({ format, form }) {
            // One mesh, as long as these are not too many: graphics in software draw each instance by itself.
            const bytes = covered.file(format, form);
            return [{ bytes }, [bytes.buffer]];
        },
    };
}

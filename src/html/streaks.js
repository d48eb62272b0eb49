// SPDX-License-Identifier: MIT
// Streaks of an animation as one mesh: a part of it is there from the time when it was wetted until it is dry.
import { BufferAttribute, BufferGeometry, Mesh } from 'three';
import { mergeGeometries } from 'three/addons/utils/BufferGeometryUtils.js';

export class Streaks {
    /**
     * @param parts     `positions`, `normals` and `triangles`, and `track`, whose value is 0 while it is not there
     * @param material  of all
     */
    constructor(parts, material) {
        const geometries = parts.map(({ positions, normals, triangles }) => {
            const geometry = new BufferGeometry();
            geometry.setAttribute('position', new BufferAttribute(positions, 3));
            geometry.setAttribute('normal', new BufferAttribute(normals, 3));
            return geometry.setIndex(new BufferAttribute(new Uint32Array(triangles), 1));
        });
        const geometry = mergeGeometries(geometries);
        this.all = geometry.index.array.slice();
        let begin = 0;
        this.parts = parts.map(({ triangles, track }) => {
            const part = { begin, end: begin + triangles.length, track };
            begin = part.end;
            return part;
        });
        this.shown = [];
        this.mesh = new Mesh(geometry, material);
        this.mesh.frustumCulled = false;
        geometry.setDrawRange(0, 0);
    }

    /** Shows a time [s]. Parts that were wetted earlier come first, so that what grows is written at the end alone. */
    show(seconds) {
        const value = [0];
        const shown = this.parts.filter(({ track }) => {
            track?.read(seconds, value, {});
            return !track || value[0] > 0;
        });
        const same = shown.findIndex((part, k) => part !== this.shown[k]);
        const kept = same < 0 ? Math.min(shown.length, this.shown.length) : same;
        const { index } = this.mesh.geometry;
        const length = (parts) => parts.reduce((sum, { begin, end }) => sum + end - begin, 0);
        const first = length(shown.slice(0, kept));
        let count = first;
        for (const { begin, end } of shown.slice(kept)) {
            index.array.set(this.all.subarray(begin, end), count);
            count += end - begin;
        }
        if (count > first) {
            index.clearUpdateRanges();
            index.addUpdateRange(first, count - first);
            index.needsUpdate = true;
        }
        this.mesh.geometry.setDrawRange(0, count);
        this.shown = shown;
    }
}

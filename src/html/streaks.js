// SPDX-License-Identifier: MIT
// Streaks of an animation as one mesh: a part of it is there from the time when it was wetted until it is dry.
import { BufferAttribute, BufferGeometry, Mesh } from 'three';
import { mergeGeometries } from 'three/addons/utils/BufferGeometryUtils.js';

export class Streaks {
    /**
     * @param parts     `positions`, `normals` and `triangles`, `targets`, changes of positions and normals with the object's shapes,
     *                  and `track`, whose value is 0 while it is not there
     * @param material  of all
     * @param weights   of the targets, if there are some; who has made them changes them
     */
    constructor(parts, material, weights) {
        const vectors = (numbers) => new BufferAttribute(numbers, 3);
        const geometries = parts.map(({ positions, normals, triangles, targets }) => {
            const geometry = new BufferGeometry();
            geometry.setAttribute('position', vectors(positions));
            geometry.setAttribute('normal', vectors(normals));
            if (targets.length > 0) {
                geometry.morphAttributes = {
                    position: targets.map((target) => vectors(target.positions)), normal: targets.map((target) => vectors(target.normals)),
                };
                geometry.morphTargetsRelative = true;
            }
            return geometry.setIndex(new BufferAttribute(new Uint32Array(triangles), 1));
        });
        const geometry = mergeGeometries(geometries);
        geometry.morphTargetsRelative = true;
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
        if (weights) {
            this.mesh.morphTargetInfluences = weights;
        }
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

// SPDX-License-Identifier: MIT
// Droplets of an animation: many copies of a few meshes, each with a shape of its own where its ground bends. A mixer of three.js
// takes seconds to begin and sets every node in every frame; here only copies that change are set, and one call draws all of them.
import { BatchedMesh, BufferAttribute, BufferGeometry, Matrix4, Quaternion, Vector3 } from 'three';

const kSizes = { translation: 3, rotation: 4, scale: 3 };
const kUnchanged = { translation: [0, 0, 0], rotation: [0, 0, 0, 1], scale: [1, 1, 1] };

/** Where a copy is over time. */
export class Copy {
    /**
     * @param node    of the file; its values hold where there is no track
     * @param tracks  by `translation`, `rotation` and `scale`
     * @param frame   from the node's parent to the crowd
     */
    constructor(node, tracks, frame) {
        Object.assign(this, { tracks, frame });
        this.values = Object.fromEntries(Object.keys(kSizes).map((name) => [name, [...node[name] ?? kUnchanged[name]]]));
        this.span = { from: Infinity, until: -Infinity };
    }

    /** Whether it is as it was when it was read last. */
    stays(seconds) {
        return seconds >= this.span.from && seconds < this.span.until;
    }

    /** Reads it at a time; returns whether there is a droplet. */
    read(seconds) {
        const { tracks, values, span } = this;
        Object.assign(span, { from: -Infinity, until: Infinity });
        tracks.scale?.read(seconds, values.scale, span);
        if (values.scale[0] === 0) {
            return false;
        }
        tracks.translation?.read(seconds, values.translation, span);
        tracks.rotation?.read(seconds, values.rotation, span);
        return true;
    }
}

/** The part of a mesh that follows one joint: vertices and triangles that stand together. */
function partsByJoint({ positions, normals, joints, triangles }) {
    const parts = new Map();
    for (let vertex = 0; vertex < positions.length / 3; ++vertex) {
        const joint = joints[4 * vertex];
        const part = parts.get(joint) ?? parts.set(joint, { first: vertex, triangles: [] }).get(joint);
        part.end = vertex + 1;
    }
    triangles.forEach((vertex) => {
        const part = parts.get(joints[4 * vertex]);
        part.triangles.push(vertex - part.first);
    });
    const geometries = [...parts].filter(([, part]) => part.triangles.length > 0).map(([joint, { first, end, triangles: own }]) => {
        const geometry = new BufferGeometry();
        geometry.setAttribute('position', new BufferAttribute(positions.subarray(3 * first, 3 * end), 3));
        geometry.setAttribute('normal', new BufferAttribute(normals.subarray(3 * first, 3 * end), 3));
        geometry.setIndex(own);
        return [joint, geometry];
    });
    return new Map(geometries);
}

export class Crowd {
    /**
     * @param parts     meshes of the file with their joints: `mesh`, as of partsByJoint(), the same object for the same mesh, and
     *                  `copies`, of which undefined ones show nothing
     * @param material  of all droplets
     */
    constructor(parts, material) {
        const shapes = new Map();
        const shown = parts.flatMap(({ mesh, copies }) => {
            const geometries = shapes.get(mesh) ?? shapes.set(mesh, partsByJoint(mesh)).get(mesh);
            return copies.map((copy, joint) => ({ copy, geometry: geometries.get(joint) })).filter((one) => one.copy && one.geometry);
        });
        const used = [...new Set(shown.map(({ geometry }) => geometry))];
        const sum = (count) => used.reduce((all, geometry) => all + count(geometry), 0);
        this.mesh = new BatchedMesh(shown.length, sum(({ attributes }) => attributes.position.count), sum(({ index }) => index.count), material);
        // Each droplet is small: what is outside the picture costs less than to find it.
        Object.assign(this.mesh, { frustumCulled: false, perObjectFrustumCulled: false, sortObjects: false });
        const numbers = new Map(used.map((geometry) => [geometry, this.mesh.addGeometry(geometry)]));
        this.copies = shown.map(({ copy, geometry }) => {
            const number = this.mesh.addInstance(numbers.get(geometry));
            this.mesh.setVisibleAt(number, false);
            return { copy, number };
        });
    }

    /** Shows a time [s]. */
    show(seconds) {
        const [matrix, place, turn, size] = [new Matrix4(), new Vector3(), new Quaternion(), new Vector3()];
        for (const { copy, number } of this.copies) {
            if (copy.stays(seconds)) {
                continue;
            }
            const is_seen = copy.read(seconds);
            this.mesh.setVisibleAt(number, is_seen);
            if (is_seen) {
                const { translation, rotation, scale } = copy.values;
                matrix.compose(place.fromArray(translation), turn.fromArray(rotation), size.fromArray(scale));
                this.mesh.setMatrixAt(number, matrix.premultiply(copy.frame));
            }
        }
    }
}

// SPDX-License-Identifier: MIT
// Which triangles of a droplet's mesh are the liquid's surface.
import { Matrix4, Vector3 } from 'three';

/**
 * Vertices of the triangles of the liquid's surface, three each. The base faces down. Liquid that hangs over its rim
 * does so too, but does not lie on flat ground.
 * @param place  from the mesh's coordinates to those where y is up and flat ground at 0
 * @param flat   whether the ground is flat
 */
export function liquidTriangles({ index, attributes: { position } }, place = new Matrix4(), flat = true) {
    const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
    const triangles = [];
    for (let i = 0; i < index.count; i += 3) {
        const corners = [0, 1, 2].map((k) => index.getX(i + k));
        [a, b, c].forEach((point, k) => point.fromBufferAttribute(position, corners[k]).applyMatrix4(place));
        const on_ground = Math.max(a.y, b.y, c.y) <= 1e-12;
        if (b.sub(a).cross(c.sub(a)).y > 0 || !(on_ground || !flat)) {
            triangles.push(...corners);
        }
    }
    return triangles;
}

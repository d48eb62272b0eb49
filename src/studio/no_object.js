// SPDX-License-Identifier: MIT
// What the view shows before there is an object, as the stage wants a droplet (model.js).
import { Box3, Group, Vector3 } from 'three';

/** Nothing, in a space of a hand's size. */
export class NoObject {
    scene = new Group();
    meshes = [];

    box() {
        return new Box3(new Vector3(-0.05, 0, -0.05), new Vector3(0.05, 0.1, 0.05));
    }

    dispose() {}
}

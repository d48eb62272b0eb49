// SPDX-License-Identifier: MIT
// An object with its droplets, as the stage wants a droplet (model.js).
import { Box3, Group, Vector3 } from 'three';
import { loadGlb } from './model.js';
import { kUnlit } from './stage.js';

const kMostCasting = 4e5;  // triangles of an object whose shadow is drawn

export class CoveredObject {
    tilt = 68;  // objects are seen from the side, droplets from above

    /** Reads a file of `droplet-shape dew`, or of `--onto`, whose first mesh is the object. */
    static async load(bytes) {
        const { scene, parser } = await loadGlb(bytes);
        return new CoveredObject(scene, (mesh) => parser.associations.get(mesh)?.meshes === 0);
    }

    /**
     * @param isObject  whether a mesh is of the object, not of its liquid
     * @param space     box around the object [m], if it changes
     */
    constructor(scene, isObject, space) {
        this.scene = new Group();
        this.scene.add(scene);
        this.meshes = [];
        const own = [];
        scene.updateMatrixWorld(true);
        scene.traverse((mesh) => {
            if (mesh.isMesh) {
                this.meshes.push(mesh);
                (isObject(mesh) ? own : []).push(mesh);
                mesh.layers.set(isObject(mesh) ? 0 : kUnlit);
                if (mesh.isInstancedMesh) {
                    hideBase(mesh.geometry);
                }
            }
        });
        this.space = space ?? spaceOf(own);
        const triangles = own.reduce((sum, { geometry }) => sum + geometry.index.count / 3, 0);
        this.casters = triangles <= kMostCasting ? own : [];
        own.forEach((mesh) => mesh.layers.set(triangles <= kMostCasting ? 0 : kUnlit));
        // It stands on the ground, in the middle.
        const { min } = this.space;
        const centre = this.space.getCenter(new Vector3());
        const shift = new Vector3(-centre.x, -min.y, -centre.z);
        this.shift = shift;
        scene.position.add(shift);
        this.space.translate(shift);
    }

    box() {
        return this.space.clone();  // the stage scales it
    }

    /** Gives the graphics card's memory back. */
    dispose() {
        for (const { geometry, material } of this.meshes) {
            geometry.dispose();
            Object.values(material).filter((value) => value?.isTexture).forEach((texture) => texture.dispose());
            material.dispose();
        }
    }
}

/** Leaves out the base, which lies on the object. It comes last, and begins with a copy of the rim. */
function hideBase(geometry) {
    const { index, attributes: { position } } = geometry;
    const places = new Set();
    let base = 0;
    for (; base < position.count; ++base) {
        const place = [position.getX(base), position.getY(base), position.getZ(base)].join();
        if (places.has(place)) {
            break;
        }
        places.add(place);
    }
    let end = index.count;
    while (end > 0 && index.getX(end - 1) >= base) {
        end -= 3;
    }
    geometry.setDrawRange(0, end);
}

/** Box around meshes where they are. */
export const spaceOf = (meshes) => meshes.reduce((box, { geometry, matrixWorld }) => {
    geometry.computeBoundingBox();
    return box.union(geometry.boundingBox.clone().applyMatrix4(matrixWorld));
}, new Box3());

// SPDX-License-Identifier: MIT
// The droplets of all layers on the page's stage.
import { Box3, BufferAttribute, BufferGeometry, Group, Mesh, Vector3 } from 'three';
import { kUnlit, Stage } from '../html/stage.js';
import { materialOf, thicken } from './materials.js';

/** Meshes of layers, as the stage wants a droplet (model.js). */
class Droplets {
    constructor() {
        this.scene = new Group();
        this.liquid = new Group();
        this.scene.add(this.liquid);
        this.layers = new Map();
    }

    /** Lays them on an object, a CoveredObject; undefined: on the ground. */
    lay(object) {
        if (this.object) {
            this.scene.remove(this.object.scene);
            this.object.dispose();
        }
        this.object = object;
        this.tilt = object?.tilt;
        this.casters = object?.casters;  // its liquid casts no light
        this.liquid.position.copy(object?.shift ?? new Vector3());
        this.layers.forEach((mesh) => mesh.layers.set(object ? kUnlit : 0));
        if (object) {
            this.scene.add(object.scene);
        }
    }

    get #shown() {
        return [...this.layers.values()].filter(({ visible }) => visible);
    }

    get meshes() {
        return [...this.object?.meshes ?? [], ...this.#shown];
    }

    box() {
        return this.object?.box() ?? this.#shown.reduce((box, { userData }) => box.union(userData.box), new Box3());
    }

    show(id, look, { positions, normals, triangles, box, thickness }) {
        const mesh = this.layers.get(id) ?? new Mesh(new BufferGeometry(), materialOf(look));
        mesh.geometry.dispose();
        mesh.geometry = new BufferGeometry();
        mesh.geometry.setAttribute('position', new BufferAttribute(positions, 3));
        mesh.geometry.setAttribute('normal', new BufferAttribute(normals, 3));
        mesh.geometry.setIndex(new BufferAttribute(triangles, 1));
        mesh.userData.box = new Box3(new Vector3(...box.slice(0, 3)), new Vector3(...box.slice(3)));
        mesh.userData.thickness = thickness;
        mesh.frustumCulled = false;  // no bounding sphere is computed for every draft
        mesh.layers.set(this.object ? kUnlit : 0);
        this.layers.set(id, mesh);
        this.liquid.add(mesh);
        this.look(id, look);
    }

    look(id, look) {
        const mesh = this.layers.get(id);
        if (mesh) {
            if (mesh.material.name !== look) {
                mesh.material.dispose();
                mesh.material = materialOf(look);
            }
            thicken(mesh.material, mesh.userData.thickness);
        }
    }

    remove(id) {
        const mesh = this.layers.get(id);
        mesh?.geometry.dispose();
        mesh?.material.dispose();
        mesh?.removeFromParent();
        this.layers.delete(id);
    }
}

const kRise = 900;      // time in which a droplet rises from the ground [ms]
const kMargin = 0.08;   // around the droplets that are shown, as a part of their extent
const kNearest = 0.3;   // least part of the sheet that is shown

/** What is shown of a sheet of these sides [m]. */
function spaceOf([width, depth]) {
    return new Box3(new Vector3(-width / 2, 0, -depth / 2), new Vector3(width / 2, 0.08 * width, depth / 2));
}

export class View {
    /**
     * @param canvas  to draw on
     * @param extent  the sheet's sides [m]
     * @param drawn   as of Stage
     */
    constructor({ canvas, extent, still, drawn }) {
        this.droplets = new Droplets();
        this.extent = extent;
        this.flat = true;
        this.stage = new Stage({ canvas, droplet: this.droplets, flat: true, extent, space: spaceOf(extent), still, drawn });
        this.stage.ground.outline();
        this.stage.controls.addEventListener('start', () => { this.stage.touched = true; });
    }

    /** Shows a sheet of other sides [m]. */
    fit(extent) {
        this.extent = extent;
        this.framed = undefined;
        if (!this.object && !this.droplets.object) {
            this.stage.move(spaceOf(extent), extent);
        }
    }

    /** Lays the droplets on an object, a CoveredObject; undefined: on the sheet's ground. */
    lay(object) {
        this.droplets.lay(object);
        this.flat &&= !object;
        if (!this.object) {
            this.#showDroplets();
        }
    }

    #showDroplets() {
        const { stage, droplets, extent } = this;
        const { object } = droplets;
        stage.swap(droplets, object ? false : this.flat, object?.box() ?? spaceOf(extent), object ? undefined : extent);
        this.framed = undefined;
        this.frame();
        stage.ground.outline(!object);
    }

    show(id, look, shape, flat) {
        this.flat = flat;
        this.droplets.show(id, look, shape);
        if (this.rising === id) {
            this.rising = undefined;
            this.#rise(this.droplets.layers.get(id), performance.now());
        }
        if (this.framed && !this.framed.containsBox(this.droplets.box())) {
            this.frame();
        }
        this.#renew();
    }

    /** Lets a layer's droplet rise from the ground when it is shown next. */
    rise(id) {
        this.rising = this.stage.still || this.stage.sketchy || this.droplets.object ? undefined : id;
    }

    #rise(mesh, began) {
        const left = Math.max(0, 1 - (performance.now() - began) / kRise);
        mesh.scale.y = Math.max(1e-3, 1 - left ** 3);
        this.#renew();
        if (left > 0) {
            requestAnimationFrame(() => this.#rise(mesh, began));
        }
    }

    /** Lets the view show the droplets, or all of the sheet if there are none. */
    frame() {
        const { stage, extent: [width, depth] } = this;
        const box = this.droplets.box();
        if (this.object || this.droplets.object || box.isEmpty()) {
            this.framed = undefined;
            if (!this.object && stage.part) {
                stage.glideTo(undefined);
            }
            return;
        }
        // Small changes leave the view as it is.
        const fits = this.framed?.containsBox(box) && box.getSize(new Vector3()).length() > 0.6 * this.framed.getSize(new Vector3()).length();
        if (!fits) {
            const size = box.getSize(new Vector3());
            const least = kNearest * Math.max(width, depth);
            const grow = (side) => Math.max(kMargin * Math.max(size.x, size.z), (least - side) / 2);
            this.framed = box.clone().expandByVector(new Vector3(grow(size.x), 0, grow(size.z)));
            this.framed.intersect(spaceOf([1.2 * width, 1.2 * depth]).union(box));
            stage.glideTo(new Box3(this.framed.min.clone().multiplyScalar(stage.scale), this.framed.max.clone().multiplyScalar(stage.scale)));
        }
    }

    /** Changes a look without a new mesh. */
    look(id, look) {
        this.droplets.look(id, look);
        this.#renew();
    }

    remove(id) {
        this.droplets.remove(id);
        this.#renew();
    }

    #renew() {
        if (!this.object) {
            this.stage.renew(this.flat);
        }
    }

    /** Shows an object in place of the droplets, or these again if undefined. `again`: from where the camera is. */
    showObject(object, again = false) {
        const { stage } = this;
        this.object = object;
        if (object && again) {
            stage.exchange(object);
        } else if (object) {
            stage.swap(object, false, object.box());
            stage.ground.outline(false);
        } else {
            this.#showDroplets();
        }
    }

    setVisible(id, visible) {
        const mesh = this.droplets.layers.get(id);
        if (mesh && mesh.visible !== visible) {
            mesh.visible = visible;
            this.#renew();
        }
    }

    /** The view as a picture. */
    picture() {
        return this.stage.picture();
    }
}

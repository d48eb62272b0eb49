// SPDX-License-Identifier: MIT
// Scene, camera and controls. A frame is drawn only if something changed.
import { Group, MathUtils, NeutralToneMapping, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { Ground } from './ground.js';
import { GroundLight } from './light.js';
import { putIntoRoom, transmissionOf } from './room.js';
import { Sketcher } from './sketch.js';

/** Layer of what casts no light and no shadow on the ground. */
export const kUnlit = 1;

const kRatioLimit = 2;  // more pixels would not be visible
const kSketchRatio = 0.5;
const kFieldOfView = 26;
const kGlide = 600;  // time in which the camera moves to what it shall show [ms]

/** Largest number up to a given one that is 1, 2 or 5 times a power of ten. */
export function roundLength(most) {
    const power = 10 ** Math.floor(Math.log10(most));
    return power * ([5, 2, 1].find((digit) => digit * power <= most * 1.000001) ?? 1);
}

export class Stage {
    /**
     * @param canvas   to draw on
     * @param droplet  from model.js
     * @param flat     whether the ground is flat, at height 0
     * @param extent   the mask's sides [m], or undefined
     * @param space    box that is shown [m], for droplets that change; the droplet's own if undefined
     * @param still    no motion except by the user
     * @param drawn    called after every frame; its argument says whether the scene is at rest
     */
    constructor({ canvas, droplet, flat, extent, space, still, drawn }) {
        this.canvas = canvas;
        this.flat = flat;
        this.still = still;
        this.drawn = drawn;
        this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: 'high-performance' });
        this.renderer.toneMapping = NeutralToneMapping;
        this.scene = new Scene();
        this.camera = new PerspectiveCamera(kFieldOfView, 1, 0.01, 100);
        this.camera.layers.enable(kUnlit);
        this.holder = new Group();
        this.#hold(droplet);
        this.scene.add(this.holder);
        this.room = { walls: { value: 1 }, lamps: { value: 1 } };
        this.ground_level = { value: 0 };
        const { extensions } = this.renderer;
        if (extensions.has('EXT_color_buffer_half_float') || extensions.has('EXT_color_buffer_float')) {
            this.ground_light = new GroundLight();
        }
        this.ground = new Ground(this.ground_light);
        this.scene.add(this.ground);
        this.#place(space ?? droplet.box([1]), extent);
        this.#light();

        this.controls = new OrbitControls(this.camera, canvas);
        Object.assign(this.controls, {
            enableDamping: !still, dampingFactor: 0.09, screenSpacePanning: false, zoomToCursor: false,
            maxPolarAngle: MathUtils.degToRad(87), rotateSpeed: 0.8,
        });
        this.controls.addEventListener('change', () => this.request());
        canvas.addEventListener('keydown', (event) => this.#key(event));
        canvas.addEventListener('webglcontextrestored', () => {
            this.light_is_old = true;
            this.request();
        });
        this.sizes = new ResizeObserver(() => this.resize());
        this.sizes.observe(canvas);
    }

    /** Gives the graphics card back; nothing is drawn after it. Browsers have only some such contexts for all of a page. */
    dispose() {
        this.request = () => {};
        cancelAnimationFrame(this.frame_id);
        clearTimeout(this.refining);
        this.sizes.disconnect();
        this.controls.dispose();
        this.renderer.dispose();
        this.renderer.forceContextLoss();
    }

    /** Scales a box to a width of about 2 and puts it in the middle. */
    #place(box, extent) {
        const size = Math.max(box.max.x - box.min.x, box.max.z - box.min.z, box.max.y - box.min.y);
        if (!(size > 0)) {
            throw new Error('the model has no extent');
        }
        this.scale = 2 / size;
        this.holder.scale.setScalar(this.scale);
        this.box = box.clone();
        this.box.min.multiplyScalar(this.scale);
        this.box.max.multiplyScalar(this.scale);
        this.level = this.flat ? 0 : this.box.min.y;  // of the ground under it
        this.ground.position.y = this.level;
        this.ground_level.value = this.level;
        this.ground.place(roundLength(size / 12) * this.scale, extent?.map((side) => side * this.scale) ?? [2, 2]);
    }

    /**
     * Shows something else in place of the droplet.
     * @param droplet  as of the constructor; `casters` are the meshes that light on the ground knows, if not all; the others
     *                 are on kUnlit; `tilt` is that of the camera off the vertical [°]; `castsTheSame` says that time does not
     *                 change what light on the ground shows
     */
    swap(droplet, flat, space, extent) {
        this.flat = flat;
        this.#hold(droplet);
        this.move(space, extent);
    }

    /** Shows something of the same size in place of the droplet, from where the camera is. */
    exchange(droplet) {
        this.#hold(droplet);
        this.renew();
    }

    #hold(droplet) {
        if (this.droplet) {
            this.holder.remove(this.droplet.scene);
        }
        this.holder.add(droplet.scene);
        this.droplet = droplet;
        this.filled = [1, Math.min((droplet.range ?? [1, 1])[1], 2)];
        this.thickness = droplet.meshes[0]?.material.thickness;
    }

    /** Shows another space, with a mask of these sides [m]. */
    move(space, extent) {
        this.part = undefined;
        this.#place(space, extent);
        this.reset();
        this.renew();
    }

    /** Puts the droplet's materials into the room, and its light on the ground. */
    #light() {
        const { droplet } = this;
        const { meshes, casters = meshes } = droplet;
        let triangles = 0;
        for (const { geometry } of casters) {
            const own = geometry.index.count / 3;
            triangles = droplet.mixer ? Math.max(triangles, own) : triangles + own;
        }
        for (const { material } of meshes) {
            const is_liquid = transmissionOf(material) > 0;
            if (is_liquid) {
                // In world units, while thickness is in the mesh's.
                material.userData.tint_depth ??= material.attenuationDistance;
                material.attenuationDistance = material.userData.tint_depth * this.scale;
            }
            putIntoRoom(material, this.room, this.flat && is_liquid && material.thickness > 0,
                { uniforms: this.ground.uniforms, level: this.ground_level });
        }
        if (this.ground_light && triangles > 0) {
            const fullest = droplet.box(this.filled);
            fullest.min.multiplyScalar(this.scale);
            fullest.max.multiplyScalar(this.scale);
            this.ground_light.aim(fullest, this.level, this.flat, triangles);
            this.ground.follow(this.ground_light);
        }
        this.light_is_old = true;
    }

    /**
     * Shows what the droplet has become: its meshes, their materials and their light.
     * @param flat  whether its ground is flat, at height 0
     */
    renew(flat = this.flat) {
        this.flat = flat;
        this.level = flat ? 0 : Math.min(0, this.droplet.box([1]).min.y * this.scale);
        this.ground.position.y = this.level;
        this.ground_level.value = this.level;
        this.#light();
        this.#changed();
    }

    set fill(amount) {
        this.droplet.fill = amount;
        for (const { material } of this.droplet.meshes) {
            material.thickness = this.thickness * amount;
        }
        this.#changed();
    }

    /** Sets the time of an animation [s]. */
    set time(seconds) {
        this.droplet.time = seconds;
        if (this.droplet.castsTheSame) {
            this.request();
        } else {
            this.#changed();
        }
    }

    /** Reports a change of the droplet; its light is coarse during further changes. */
    #changed() {
        this.light_is_old = true;
        clearTimeout(this.refining);
        this.refining = setTimeout(() => {
            this.light_is_coarse = false;
            this.light_is_old = true;
            this.request();
        }, 180);
        this.light_is_coarse = true;
        this.request();
    }

    /** Selects the ground and the room light for it. */
    wear(choose) {
        const look = choose(this.ground);
        this.room.walls.value = look.walls ?? 1;
        this.request();
    }

    /** Greatest height above flat ground at that fill [m]. */
    heightAt(fill) {
        return this.droplet.box([fill]).max.y;
    }

    /** Draws plainly and in fewer pixels, without light through the liquid, for graphics that are slow. */
    sketch(sketchy) {
        if (this.sketchy !== sketchy) {
            this.sketchy = sketchy;
            this.resize();
        }
    }

    #render() {
        if (this.sketchy) {
            this.sketcher ??= new Sketcher(this.renderer, this.scene, this.room);
            this.sketcher.render(this.camera, this.ground, this.droplet.meshes, this.flat);
        } else {
            this.renderer.render(this.scene, this.camera);
        }
    }

    /** Sets the covered width at the canvas's right [CSS px]; the droplet is centred in the rest. */
    set covered(width) {
        this.cover = width;
        this.resize();
    }

    resize() {
        const width = this.canvas.clientWidth;
        const height = this.canvas.clientHeight;
        if (!width || !height) {
            return;
        }
        this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, kRatioLimit) * (this.sketchy ? kSketchRatio : 1));
        this.renderer.setSize(width, height, false);
        const cover = this.cover ?? 0;
        this.camera.aspect = width / height;
        this.camera.setViewOffset(width, height, cover / 2, 0, width, height);
        this.camera.updateProjectionMatrix();
        if (!this.touched) {
            this.frame();
        }
        this.request();
    }

    /** Lets the controls act at once, without inertia. */
    #atOnce(act) {
        const { controls } = this;
        const damping = controls.enableDamping;
        controls.enableDamping = false;
        controls.update();
        act(controls);
        controls.update();
        controls.enableDamping = damping;
        this.request();
    }

    /** Where the camera sees all of a box from the front and above: {target, position, distance}. */
    #placeFor(box) {
        const free = this.canvas.clientWidth - (this.cover ?? 0);
        const upright = this.canvas.clientHeight > free;
        const target = box.getCenter(new Vector3());
        const direction = new Vector3().setFromSphericalCoords(1, MathUtils.degToRad(this.droplet.tilt ?? (upright ? 40 : 47)), MathUtils.degToRad(10));
        const forward = direction.clone().negate();
        const right = new Vector3().crossVectors(forward, new Vector3(0, 1, 0)).normalize();
        const up = new Vector3().crossVectors(right, forward);
        const tan_up = Math.tan(MathUtils.degToRad(kFieldOfView / 2));
        const tan_right = tan_up * free / this.canvas.clientHeight;
        const corners = [box.min.x, box.max.x].flatMap((x) => [this.level, box.max.y].flatMap((y) =>
            [box.min.z, box.max.z].map((z) => new Vector3(x, y, z))));
        let distance = 0;
        // The camera moves as near as possible, then centres the visible part, which perspective shifts off the box.
        for (let pass = 0; pass < 4; ++pass) {
            const seen = corners.map((corner) => corner.clone().sub(target))
                .map((way) => ({ x: way.dot(right), y: way.dot(up), nearer: -way.dot(forward) }));
            distance = Math.max(...seen.map(({ x, y, nearer }) =>
                nearer + Math.max(Math.abs(x) / (0.84 * tan_right), Math.abs(y) / (0.74 * tan_up))));
            const middle = (values) => (Math.min(...values) + Math.max(...values)) / 2;
            target.addScaledVector(right, middle(seen.map(({ x, nearer }) => x / (distance - nearer))) * distance);
            target.addScaledVector(up, middle(seen.map(({ y, nearer }) => y / (distance - nearer))) * distance);
        }
        return { target, position: target.clone().addScaledVector(direction, distance), distance };
    }

    /** Shows all that there is, or the part of it that was asked for, at once. */
    frame() {
        const { camera } = this;
        const { distance } = this.#placeFor(this.box);
        camera.near = 0.02 * distance;
        camera.updateProjectionMatrix();
        this.gliding = undefined;
        const { target, position } = this.#placeFor(this.part ?? this.box);
        this.#atOnce((controls) => {
            controls.minDistance = 0.12 * distance;
            controls.maxDistance = 3 * distance;
            camera.position.copy(position);
            controls.target.copy(target);
        });
    }

    /** Glides to a part of the space, in world units; undefined is all of it. A hand at the camera is left alone. */
    glideTo(part) {
        this.part = part;
        if (this.touched) {
            return;
        }
        if (this.still || this.sketchy) {
            this.frame();
            return;
        }
        this.gliding = {
            began: performance.now(), to: this.#placeFor(part ?? this.box),
            from: { target: this.controls.target.clone(), position: this.camera.position.clone() },
        };
        this.request();
    }

    #glide() {
        const { began, from, to } = this.gliding;
        const time = Math.min(1, (performance.now() - began) / kGlide);
        const way = MathUtils.smootherstep(time, 0, 1);
        this.camera.position.lerpVectors(from.position, to.position, way);
        this.controls.target.lerpVectors(from.target, to.target, way);
        if (time === 1) {
            this.gliding = undefined;
        } else {
            this.request();
        }
    }

    /**
     * Puts the camera somewhere.
     * @param target  point in the middle of the picture, in world units
     * @param way     from there to the camera, as spherical coordinates
     */
    look(target, way) {
        this.touched = true;
        this.#atOnce((controls) => {
            this.camera.position.setFromSpherical(way).add(target);
            controls.target.copy(target);
        });
    }

    reset() {
        this.touched = false;
        this.frame();
    }

    #key(event) {
        if (event.ctrlKey || event.metaKey || event.altKey) {
            return;
        }
        const turn = MathUtils.degToRad(6);
        const acts = {
            ArrowLeft: (controls) => controls.rotateLeft(turn),
            ArrowRight: (controls) => controls.rotateLeft(-turn),
            ArrowUp: (controls) => controls.rotateUp(turn),
            ArrowDown: (controls) => controls.rotateUp(-turn),
            '+': (controls) => controls.dollyIn(1 / 1.12),
            '=': (controls) => controls.dollyIn(1 / 1.12),
            '-': (controls) => controls.dollyOut(1 / 1.12),
        };
        if (event.key === 'Home') {
            this.reset();
        } else if (acts[event.key]) {
            this.touched = true;
            this.#atOnce(acts[event.key]);
        } else {
            return;
        }
        event.preventDefault();
    }

    /** Metres per CSS pixel at the droplet. */
    get metresPerPixel() {
        const distance = this.camera.position.distanceTo(this.controls.target);
        return 2 * distance * Math.tan(MathUtils.degToRad(kFieldOfView / 2)) / this.canvas.clientHeight / this.scale;
    }

    /** The view as a PNG, as large as it is shown. */
    picture() {
        this.renderer.render(this.scene, this.camera);  // WebGL keeps its picture until the end of the task
        return new Promise((done) => { this.canvas.toBlob(done, 'image/png'); });
    }

    request() {
        this.frame_id ??= requestAnimationFrame(() => this.#draw());
    }

    #draw() {
        this.frame_id = undefined;
        if (this.gliding && this.touched) {
            this.gliding = undefined;
        }
        if (this.gliding) {
            this.#glide();
        }
        this.controls.update();  // requests another frame while the motion fades
        if (this.light_is_old && this.ground_light && !this.sketchy) {
            const { meshes, casters = meshes } = this.droplet;
            this.ground_light.update(this.renderer, this.holder, casters, this.light_is_coarse);
            this.light_is_old = false;
        }
        this.#render();
        this.drawn(this.frame_id === undefined && !this.light_is_coarse && !this.sketchy);
    }
}

// SPDX-License-Identifier: MIT
// Plain frames for graphics that are too slow for refraction while the hand draws: the ground is drawn once for a place of
// the camera and then copied; liquids only reflect the room.
import { CustomBlending, FramebufferTexture, Matrix4, Mesh, NoBlending, OneFactor, OneMinusSrcAlphaFactor, PlaneGeometry,
    ShaderMaterial, Vector2 } from 'three';
import { kRoom } from './room.js';

const kVertex = `
varying vec3 place;
varying vec3 upright;
void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    place = world.xyz;
    upright = mat3(modelMatrix) * normal;
    gl_Position = projectionMatrix * viewMatrix * world;
}`;

const kFragment = `
${kRoom}
uniform vec3 tint;
uniform float body;
uniform float mirror;
uniform float roughness;
varying vec3 place;
varying vec3 upright;
void main() {
    vec3 normal = normalize(upright);
    vec3 ray = normalize(place - cameraPosition);
    float fresnel = mirror + (1.0 - mirror) * pow(1.0 - max(dot(normal, -ray), 0.0), 5.0);
    vec3 reflected = fresnel * roomRadiance(reflect(ray, normal), roughness);
    float shade = 0.35 * (1.0 - normal.y);
    gl_FragColor = vec4(reflected * mix(vec3(1.0), tint, step(0.5, mirror)) + body * tint * roomIrradiance(normal) / PI,
        clamp(body + fresnel + shade, 0.0, 1.0));
    #include <tonemapping_fragment>
    #include <colorspace_fragment>
}`;

/** A plain look of a material in the room, without refraction. */
function sketchOf(material, light) {
    const tinted = Number.isFinite(material.attenuationDistance);
    return new ShaderMaterial({
        vertexShader: kVertex,
        fragmentShader: `#define PI 3.141592653589793\n${kFragment}`,
        uniforms: {
            room_walls: light.walls, room_lamps: light.lamps,
            tint: { value: tinted ? material.attenuationColor : material.color },
            body: { value: material.metalness > 0 ? 0 : material.transmission > 0 ? (tinted ? 0.7 : 0) : 1 },
            mirror: { value: material.metalness > 0 ? 0.8 : ((material.ior - 1) / (material.ior + 1)) ** 2 },
            roughness: { value: material.roughness },
        },
        transparent: true,
        blending: CustomBlending,
        blendSrc: OneFactor,
        blendDst: OneMinusSrcAlphaFactor,
    });
}

export class Sketcher {
    constructor(renderer, scene, room) {
        Object.assign(this, { renderer, scene, room });
        this.sketches = new WeakMap();
        this.size = new Vector2();
        this.seen = new Matrix4();
        this.backdrop = new Mesh(new PlaneGeometry(2, 2), new ShaderMaterial({
            vertexShader: 'varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 1.0, 1.0); }',
            fragmentShader: 'uniform sampler2D ground; varying vec2 at; void main() { gl_FragColor = texture2D(ground, at); }',
            uniforms: { ground: { value: null } },
            depthTest: false, depthWrite: false, toneMapped: false, blending: NoBlending,
        }));
        this.backdrop.frustumCulled = false;
        this.backdrop.renderOrder = -1;
        this.backdrop.visible = false;
        scene.add(this.backdrop);
    }

    /** The ground as the camera sees it; drawn again if the camera, the size or the ground's look changed. */
    #draw(camera, ground) {
        const { renderer, scene, backdrop, size } = this;
        const { value } = backdrop.material.uniforms.ground;
        const seen = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
        renderer.getDrawingBufferSize(size);
        if (value?.image.width === size.x && value.image.height === size.y && this.seen.equals(seen) && this.look === ground.look) {
            return;
        }
        value?.dispose();
        const texture = new FramebufferTexture(size.x, size.y);
        const { lit } = ground.uniforms;
        const was = lit.value;
        lit.value = 0;  // the light is that of another droplet
        renderer.render(scene, camera);
        lit.value = was;
        renderer.copyFramebufferToTexture(texture);
        backdrop.material.uniforms.ground.value = texture;
        this.seen.copy(seen);
        this.look = ground.look;
    }

    render(camera, ground, meshes) {
        const { sketches, backdrop } = this;
        camera.updateMatrixWorld();
        meshes.forEach((mesh) => { mesh.visible = false; });
        this.#draw(camera, ground);
        const worn = meshes.map((mesh) => mesh.material);
        meshes.forEach((mesh, k) => {
            if (!sketches.has(worn[k])) {
                sketches.set(worn[k], sketchOf(worn[k], this.room));
            }
            mesh.material = sketches.get(worn[k]);
            mesh.visible = true;
        });
        ground.visible = false;
        backdrop.visible = true;
        this.renderer.render(this.scene, camera);
        backdrop.visible = false;
        ground.visible = true;
        meshes.forEach((mesh, k) => { mesh.material = worn[k]; });
    }
}

// SPDX-License-Identifier: MIT
// Plain frames for slow graphics while the hand draws: the ground is drawn once for a place of the camera and then copied.
// Liquids mirror the room; on flat ground they refract it, with the light that enters where it is seen, elsewhere the
// ground shines through unbent.
import { CustomBlending, FramebufferTexture, Matrix4, Mesh, NoBlending, OneFactor, OneMinusSrcAlphaFactor, PlaneGeometry,
    ShaderMaterial, Vector2 } from 'three';
import { kGroundRadiance } from './ground.js';
import { kRoom, kSun, transmissionOf, vec3 } from './room.js';

const kVertex = `
varying vec3 place;
varying vec3 upright;
void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    place = world.xyz;
    upright = transpose(inverse(mat3(modelMatrix))) * normal;
    gl_Position = projectionMatrix * viewMatrix * world;
}`;

const kFragment = `
#define PI 3.141592653589793
${kRoom}
uniform vec3 tint;
uniform float body;
uniform float mirror;
uniform float roughness;
varying vec3 place;
varying vec3 upright;
#ifdef REFRACTS
${kGroundRadiance}
uniform float ior;
uniform float tint_depth;
uniform float transmission;
#endif
void main() {
    vec3 normal = normalize(upright);
    vec3 ray = normalize(place - cameraPosition);
    float fresnel = mirror + (1.0 - mirror) * pow(1.0 - max(dot(normal, -ray), 0.0), 5.0);
    vec3 reflected = fresnel * roomRadiance(reflect(ray, normal), roughness) * mix(vec3(1.0), tint, step(0.5, mirror));
    vec3 scattered = tint * roomIrradiance(normal) / PI;
#ifdef REFRACTS
    vec3 inward = refract(ray, normal, 1.0 / ior);
    float depth = max(place.y, 0.0) / max(-inward.y, 0.1);
    // A lens as flat as a droplet lights the ground about as light enters it there.
    float entering = clamp(dot(normal, ${vec3(kSun)}) / ${kSun.y.toFixed(6)}, 0.25, 1.5);
    vec3 seen = groundRadiance(place.xz + depth * inward.xz, fwidth(place.xz)) * entering * pow(tint, vec3(depth / tint_depth));
    gl_FragColor = vec4(reflected + (1.0 - fresnel) * mix(scattered, seen, transmission), 1.0);
#else
    gl_FragColor = vec4(reflected + body * scattered, clamp(body + fresnel + 0.35 * (1.0 - normal.y), 0.0, 1.0));
#endif
    #include <tonemapping_fragment>
    #include <colorspace_fragment>
}`;

/**
 * A plain look of a material in the room.
 * @param flat  whether it stands on flat ground at height 0, which clear liquid then refracts
 */
function sketchOf(material, light, flat, ground) {
    const tinted = Number.isFinite(material.attenuationDistance);
    const transmission = transmissionOf(material);
    return new ShaderMaterial({
        vertexShader: kVertex,
        fragmentShader: kFragment,
        defines: flat && transmission > 0 ? { REFRACTS: '' } : {},
        uniforms: {
            ...ground.uniforms,
            room_walls: light.walls, room_lamps: light.lamps,
            tint: { value: tinted ? material.attenuationColor : material.color },
            tint_depth: { get value() { return material.attenuationDistance; } },
            transmission: { value: transmission },
            ior: { value: material.ior },
            body: { value: material.metalness > 0 ? 0 : transmission > 0 ? (tinted ? 0.7 : 0) : 1 },
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
        this.sketches = { flat: new WeakMap(), uneven: new WeakMap() };  // of materials
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
        renderer.render(scene, camera);
        renderer.copyFramebufferToTexture(texture);
        backdrop.material.uniforms.ground.value = texture;
        this.seen.copy(seen);
        this.look = ground.look;
    }

    render(camera, ground, meshes, flat) {
        const { backdrop } = this;
        const sketches = this.sketches[flat ? 'flat' : 'uneven'];
        const { lit } = ground.uniforms;
        const was = lit.value;
        lit.value = 0;  // the light is that of another droplet
        camera.updateMatrixWorld();
        meshes.forEach((mesh) => { mesh.visible = false; });
        this.#draw(camera, ground);
        const worn = meshes.map((mesh) => mesh.material);
        meshes.forEach((mesh, k) => {
            if (!sketches.has(worn[k])) {
                sketches.set(worn[k], sketchOf(worn[k], this.room, flat, ground));
            }
            mesh.material = sketches.get(worn[k]);
            mesh.visible = true;
        });
        ground.visible = false;
        backdrop.visible = true;
        this.renderer.render(this.scene, camera);
        backdrop.visible = false;
        ground.visible = true;
        lit.value = was;
        meshes.forEach((mesh, k) => { mesh.material = worn[k]; });
    }
}

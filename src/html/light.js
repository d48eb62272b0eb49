// SPDX-License-Identifier: MIT
// Light on the ground, through the liquid, after E. Wallace, "Rendering realtime caustics in WebGL" (2016): the mesh is
// drawn where its rays land, brighter by the ratio in which a bundle of rays shrinks. The same light is subtracted
// where the rays would land without the liquid. Several points of the window make the shadow soft.
import { AddEquation, BufferGeometry, ClampToEdgeWrapping, Color, CustomBlending, DoubleSide, HalfFloatType, LinearFilter, MathUtils,
    OneFactor, OrthographicCamera, Scene, ShaderMaterial, Vector2, Vector3, WebGLRenderTarget } from 'three';
import { liquidTriangles } from './liquid_triangles.js';
import { kAcross, kSun, kUpward, transmissionOf } from './room.js';

const kTexels = 768;

const kVertex = `
#include <common>
#include <morphtarget_pars_vertex>
uniform vec3 sun;
uniform float ground;
uniform float ior;
uniform bool refracted;
uniform bool opaque;
uniform float rough;
uniform vec2 shift;
varying vec2 at;
varying vec2 straight;
varying vec2 bent;
varying float facing;
varying float depth;
void main() {
    #include <beginnormal_vertex>
    #include <morphnormal_vertex>
    #include <begin_vertex>
    #include <morphtarget_vertex>
    vec3 place = (modelMatrix * vec4(transformed, 1.0)).xyz;
    vec3 normal = normalize(transpose(inverse(mat3(modelMatrix))) * objectNormal);
    float lift = max(place.y - ground, 0.0);
    straight = place.xz - sun.xz * (lift / sun.y);
    vec3 ray = refract(-sun, normal, 1.0 / ior);
    // Rough liquid spreads light so widely that it is not focused.
    bent = mix(place.xz + ray.xz * (lift / max(-ray.y, 0.05)), straight, rough);
    depth = lift / max(-ray.y, 0.05);
    facing = dot(normal, sun);
    at = uv;
    vec2 landing = refracted ? bent : straight;
    gl_Position = refracted && opaque ? vec4(2.0, 2.0, 2.0, 1.0) :
        projectionMatrix * viewMatrix * vec4(landing.x, ground, landing.y, 1.0) + vec4(shift, 0.0, 0.0);
}`;

const kFragment = `
uniform bool refracted;
uniform float ior;
uniform float share;
uniform vec3 tint;
uniform float tint_depth;
uniform float transmission;
uniform bool pictured;
uniform sampler2D picture;
varying vec2 at;
varying vec2 straight;
varying vec2 bent;
varying float facing;
varying float depth;
float spread(vec2 at) {
    vec2 x = dFdx(at);
    vec2 y = dFdy(at);
    return abs(x.x * y.y - x.y * y.x);
}
void main() {
    if (facing <= 0.0) {
        discard;
    }
    if (!refracted) {
        gl_FragColor = vec4(vec3(-share), 1.0);
        return;
    }
    float bundle = min(spread(straight) / max(spread(bent), 1e-12), 24.0);
    float mirrored = pow((ior - 1.0) / (ior + 1.0), 2.0);
    mirrored += (1.0 - mirrored) * pow(1.0 - facing, 5.0);
    vec3 through = tint_depth > 0.0 ? pow(tint, vec3(depth / tint_depth)) : tint;
    if (pictured) {
        through *= texture2D(picture, at).rgb;
    }
    gl_FragColor = vec4(share * transmission * bundle * (1.0 - mirrored) * through, 1.0);
}`;

/** Light on the ground, minus its value without the droplet, as a texture over a square around the droplet. */
export class GroundLight {
    constructor() {
        this.centre = new Vector2();
        this.camera = new OrthographicCamera();
        this.camera.up.set(0, 0, -1);
        this.scene = new Scene();
        this.uniforms = {
            sun: { value: new Vector3() },
            ground: { value: 0 },
            refracted: { value: false },
            shift: { value: new Vector2() },
            share: { value: 1 },
        };
        this.shaders = new WeakMap();
        this.surfaces = new WeakMap();
        this.target = new WebGLRenderTarget(kTexels, kTexels, {
            type: HalfFloatType, depthBuffer: false, generateMipmaps: false, minFilter: LinearFilter,
            magFilter: LinearFilter, wrapS: ClampToEdgeWrapping, wrapT: ClampToEdgeWrapping,
        });
    }

    /**
     * @param box        around the droplet at its fullest, in the scene's units
     * @param ground     height of the ground
     * @param flat       whether the ground is flat
     * @param triangles  of the droplet; the light of many comes from fewer points of the window
     */
    aim(box, ground, flat, triangles) {
        const { camera } = this;
        if (this.flat !== flat) {
            this.flat = flat;
            this.surfaces = new WeakMap();
        }
        const reach = (box.max.y - ground) * Math.hypot(kSun.x, kSun.z) / kSun.y + 0.12;
        const centre = box.getCenter(new Vector3());
        const half = Math.max(box.max.x - box.min.x, box.max.z - box.min.z) / 2 + reach;
        this.centre.set(centre.x, centre.z);
        this.half = half;
        this.count = Math.round(Math.min(16, Math.max(6, 6e5 / triangles)));
        this.uniforms.ground.value = ground;
        Object.assign(camera, { left: -half, right: half, top: half, bottom: -half, near: 0, far: 2 });
        camera.position.set(centre.x, ground + 1, centre.z);
        camera.lookAt(centre.x, ground, centre.z);
        camera.updateProjectionMatrix();
    }

    /** The shader for the light through a material of the droplet. */
    #through(material) {
        if (!this.shaders.has(material)) {
            this.shaders.set(material, new ShaderMaterial({
                vertexShader: kVertex,
                fragmentShader: kFragment,
                uniforms: {
                    ...this.uniforms,
                    opaque: { value: false }, rough: { value: 0 }, transmission: { value: 1 }, ior: { value: 1 },
                    tint: { value: new Color() }, tint_depth: { value: 0 },
                    pictured: { value: false }, picture: { value: null },
                },
                side: DoubleSide,
                depthTest: false,
                depthWrite: false,
                toneMapped: false,
                blending: CustomBlending,
                blendEquation: AddEquation,
                blendSrc: OneFactor,
                blendDst: OneFactor,
            }));
        }
        const shader = this.shaders.get(material);
        const { opaque, rough, transmission, ior, tint, tint_depth, pictured, picture } = shader.uniforms;
        const tinted = Number.isFinite(material.attenuationDistance);
        opaque.value = !(transmissionOf(material) > 0);
        rough.value = MathUtils.smoothstep(material.roughness, 0.03, 0.3);
        transmission.value = transmissionOf(material);
        ior.value = material.ior ?? 1.333;
        tint.value.copy(tinted ? material.attenuationColor : material.color);
        tint_depth.value = tinted ? material.attenuationDistance : 0;  // 0: the same tint everywhere
        pictured.value = Boolean(material.map);
        picture.value = material.map;
        return shader;
    }

    /**
     * The liquid's surface without its base, which would be drawn where its rays land, too. Vertices do not tell: where
     * liquid hangs far over its rim, they face down as the base does, and half of a triangle would be missing.
     */
    #surface(geometry) {
        if (!this.surfaces.has(geometry)) {
            const surface = new BufferGeometry();
            Object.assign(surface, { attributes: geometry.attributes, morphAttributes: geometry.morphAttributes,
                morphTargetsRelative: geometry.morphTargetsRelative });
            surface.setIndex(liquidTriangles(geometry, undefined, this.flat));
            geometry.addEventListener('dispose', () => surface.dispose());
            this.surfaces.set(geometry, surface);
        }
        return this.surfaces.get(geometry);
    }

    /** Draws the texture for the current droplet; `coarse`: from fewer points of the window. */
    update(renderer, object, meshes, coarse) {
        const { scene, camera, target } = this;
        const { sun, refracted, share, shift } = this.uniforms;
        const count = coarse ? Math.min(this.count, 6) : this.count;
        share.value = 1 / count;
        const parent = object.parent;
        const worn = meshes.map(({ material, geometry }) => ({ material, geometry }));
        const colour = renderer.getClearColor(new Color());
        const alpha = renderer.getClearAlpha();
        const auto = renderer.autoClear;

        scene.add(object);
        // scene.overrideMaterial does not work: three.js still asks the mesh's own material whether it is transparent.
        const shaders = worn.map(({ material }) => this.#through(material));
        meshes.forEach((mesh, i) => {
            mesh.material = shaders[i];
            // Only a base that light is refracted to is drawn where it does not belong.
            if (mesh.visible && !shaders[i].uniforms.opaque.value) {
                mesh.geometry = this.#surface(mesh.geometry);
            }
        });
        const clear = shaders.some(({ uniforms }) => !uniforms.opaque.value);
        renderer.setRenderTarget(target);
        renderer.setClearColor(0x000000, 0);
        renderer.clear();
        renderer.autoClear = false;
        for (let i = 0; i < count && meshes.length > 0; ++i) {
            // Sunflower points are spread evenly over a disc.
            const radius = 0.075 * Math.sqrt((i + 0.5) / count);
            const angle = i * 2.399963;
            sun.value.copy(kSun).addScaledVector(kAcross, radius * Math.cos(angle))
                .addScaledVector(kUpward, radius * Math.sin(angle)).normalize();
            // Each pass is shifted by another part of a texel, so the mean has smooth edges.
            shift.value.set((0.754878 * i) % 1 - 0.5, (0.569840 * i) % 1 - 0.5).multiplyScalar(3 / kTexels);
            for (const bends of clear ? [false, true] : [false]) {
                refracted.value = bends;
                shaders.forEach((shader) => { shader.uniformsNeedUpdate = true; });
                renderer.render(scene, camera);
            }
        }
        renderer.autoClear = auto;
        renderer.setRenderTarget(null);
        renderer.setClearColor(colour, alpha);
        meshes.forEach((mesh, i) => Object.assign(mesh, worn[i]));
        parent?.add(object);
    }
}

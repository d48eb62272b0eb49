// SPDX-License-Identifier: MIT
// Ground and backdrop. They are opaque, because only opaque objects are seen through the liquid.
import { BackSide, CircleGeometry, Color, Group, LinearMipmapLinearFilter, Mesh, ShaderMaterial, SphereGeometry,
    SRGBColorSpace, Texture, Vector2 } from 'three';

const paper = {
    name: 'Paper with a grid', colour: '#f0ebe0', far: '#e8e2d6', line: '#7d98aa', mark: '#33414d', lines: 1, sky: 0.4, sun: 0.52,
    swatch: 'repeating-linear-gradient(0deg,#a9bcc8 0 1px,transparent 1px 7px),repeating-linear-gradient(90deg,#a9bcc8 0 1px,transparent 1px 7px),#f3efe6',
};
const mat = {
    name: 'Slate with a grid', colour: '#6a90a5', far: '#51768a', line: '#f2f7f9', mark: '#f2f6f8', lines: 0.75, sky: 0.2, sun: 0.85,
    swatch: 'repeating-linear-gradient(0deg,#c3d2da 0 1px,transparent 1px 7px),repeating-linear-gradient(90deg,#c3d2da 0 1px,transparent 1px 7px),#6a90a5',
};
const studio = {
    name: 'Dark studio', colour: '#4a545d', far: '#14181b', mark: '#c9d3da', sky: 0.28, sun: 1.0, pool: 1, walls: 0.3,
    swatch: 'radial-gradient(circle at 45% 40%,#56626c,#14181b 75%)',
};
const plain = (name, colour, far, mark) => ({ name, colour, far, mark, sky: 0.42, sun: 0.55, swatch: colour });

/** Grounds to choose from, in the order shown. */
export const kGrounds = {
    mat,
    paper,
    studio,
    leaf: plain('Green', '#6f9a6a', '#5d8858', '#f2f6f2'),
    clay: plain('Terracotta', '#c8704f', '#b56143', '#fdf3ee'),
    rose: plain('Rose', '#dfa7ab', '#d3979c', '#4a2d30'),
    white: plain('White', '#fbfbfa', '#f1f1ef', '#33414d'),
};
const kPicture = { name: 'Own picture', colour: '#d9d6d0', far: '#cfccc6', mark: '#33414d', sky: 0.4, sun: 0.52 };

const kVertex = `
varying vec3 place;
void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    place = world.xyz;
    gl_Position = projectionMatrix * viewMatrix * world;
}`;

/** groundRadiance, in GLSL: light that the ground scatters at a place, of which a pixel shows that much. Its uniforms are those of Ground. */
export const kGroundRadiance = `
uniform vec3 colour;
uniform vec3 far;
uniform vec3 line;
uniform float step_length;
uniform float lines;
uniform float sky;
uniform float sun;
uniform float pool;
uniform float lit;
uniform sampler2D light;
uniform vec2 light_centre;
uniform float light_half;
uniform sampler2D picture;
uniform vec2 picture_half;
uniform float pictured;
uniform vec2 sheet_half;

// 1 on the lines of a grid, which are at least a pixel wide; 0 where the grid is finer than the pixels.
float grid(vec2 at, vec2 pixel, float width) {
    vec2 away = abs(fract(at - 0.5) - 0.5);
    vec2 half_width = max(vec2(width), pixel) * 0.5;
    vec2 on = 1.0 - smoothstep(half_width - 0.5 * pixel, half_width + 0.5 * pixel, away);
    on *= min(vec2(1.0), width / pixel) * (1.0 - smoothstep(0.25, 0.5, pixel));
    return max(on.x, on.y);
}

vec3 groundRadiance(vec2 place, vec2 pixel) {
    vec3 base = colour;
    vec2 at = place / step_length;
    vec2 step_pixel = pixel / step_length;
    float fine = 0.34 * grid(at, step_pixel, 0.045);
    float coarse = 0.7 * grid(at / 5.0, step_pixel / 5.0, 0.013);
    base = mix(base, line, lines * max(fine, coarse));
    vec2 uv = place / picture_half;
    vec4 print = texture2D(picture, vec2(0.5, 0.5) + vec2(0.5, -0.5) * uv);
    vec2 edge = abs(uv);
    if (pictured > 0.5 && max(edge.x, edge.y) < 1.0) {
        base = mix(base, print.rgb, print.a);
    }
    vec2 beyond = abs(place) - sheet_half;
    float to_edge = max(beyond.x, beyond.y);
    base *= 1.0 - step(0.0, sheet_half.x) * 0.28 * (1.0 - smoothstep(0.0, 1.5 * max(pixel.x, pixel.y), abs(to_edge)));
    vec2 lamp = (place - light_centre) / light_half;
    vec2 inside = step(abs(lamp), vec2(1.0));
    vec3 reached = vec3(1.0) + lit * inside.x * inside.y *
        texture2D(light, vec2(0.5, 0.5) + vec2(0.5, -0.5) * lamp).rgb;
    // In the sun's shadow, some of the sky's light is missing, too.
    vec3 shade = mix(vec3(1.0), clamp(reached, 0.0, 1.0), 0.3);
    float away = length(place);
    float spot = mix(1.0, exp(-0.16 * away * away), pool);
    vec3 result = base * (sky * shade + sun * spot * max(reached, 0.0));
    return mix(result, far * (sky + mix(sun, 0.0, pool)), smoothstep(2.2, 9.0, away));
}
`;

const kGroundFragment = `
${kGroundRadiance}
varying vec3 place;
void main() {
    gl_FragColor = vec4(groundRadiance(place.xz, fwidth(place.xz)), 1.0);
    #include <tonemapping_fragment>
    #include <colorspace_fragment>
}`;

const kDomeFragment = `
uniform vec3 far;
uniform float sky;
uniform float sun;
uniform float pool;
varying vec3 place;
void main() {
    gl_FragColor = vec4(far * (sky + mix(sun, 0.0, pool)) * mix(1.0, 1.06, clamp(place.y / 30.0, 0.0, 1.0)), 1.0);
    #include <tonemapping_fragment>
    #include <colorspace_fragment>
}`;

export class Ground extends Group {
    /** @param light  from light.js; undefined: none reaches it */
    constructor(light) {
        super();
        this.picture_half = new Vector2(1, 1);
        this.uniforms = {
            colour: { value: new Color() }, far: { value: new Color() }, line: { value: new Color() },
            step_length: { value: 1 }, lines: { value: 0 }, sky: { value: 1 }, sun: { value: 1 }, pool: { value: 0 },
            lit: { value: light ? 1 : 0 }, light: { value: light?.target.texture ?? new Texture() },
            light_centre: { value: new Vector2() }, light_half: { value: 1 },
            picture: { value: new Texture() }, picture_half: { value: new Vector2(1, 1) }, pictured: { value: 0 },
            sheet_half: { value: new Vector2(-1, -1) },
        };
        const floor = new Mesh(new CircleGeometry(30, 96),
            new ShaderMaterial({ vertexShader: kVertex, fragmentShader: kGroundFragment, uniforms: this.uniforms }));
        floor.rotation.x = -Math.PI / 2;
        floor.position.y = -2e-4;  // the droplet's base is not hidden by it
        const dome = new Mesh(new SphereGeometry(30, 32, 16),
            new ShaderMaterial({ vertexShader: kVertex, fragmentShader: kDomeFragment, uniforms: this.uniforms, side: BackSide }));
        this.add(floor, dome);
    }

    /**
     * @param step   of the grid, in the scene's units
     * @param sides  of the mask, in the scene's units; a picture of its shape gets its place
     */
    place(step, sides) {
        this.uniforms.step_length.value = step;
        this.picture_half.set(...sides).multiplyScalar(0.5);
        this.#layPicture();
    }

    /** Draws the mask's edges on the ground. */
    outline(drawn = true) {
        this.uniforms.sheet_half.value = drawn ? this.picture_half : new Vector2(-1, -1);
    }

    /** Takes light that was aimed at another place. */
    follow(light) {
        this.uniforms.light_centre.value = light.centre;
        this.uniforms.light_half.value = light.half;
    }

    #wear(look) {
        const { uniforms } = this;
        uniforms.colour.value.set(look.colour);
        uniforms.far.value.set(look.far);
        uniforms.line.value.set(look.line ?? look.colour);
        uniforms.lines.value = look.lines ?? 0;
        uniforms.sky.value = look.sky;
        uniforms.sun.value = look.sun;
        uniforms.pool.value = look.pool ?? 0;
        uniforms.pictured.value = 0;
        this.mark = look.mark;
        this.look = look;
        return look;
    }

    /** Selects a ground by its key in kGrounds. */
    choose(key) {
        return this.#wear(kGrounds[key]);
    }

    /** Puts a picture under the droplet: in the mask's place if it has the mask's shape, otherwise around it. */
    show(image, anisotropy) {
        const look = this.#wear(kPicture);
        const { uniforms } = this;
        uniforms.picture.value.dispose();
        const texture = new Texture(image);
        texture.colorSpace = SRGBColorSpace;
        texture.minFilter = LinearMipmapLinearFilter;
        texture.anisotropy = anisotropy;
        texture.needsUpdate = true;
        uniforms.picture.value = texture;
        uniforms.pictured.value = 1;
        this.#layPicture();
        return look;
    }

    #layPicture() {
        const { uniforms, picture_half } = this;
        const { image } = uniforms.picture.value;
        if (!image) {
            return;
        }
        const shape = image.width / image.height;
        const same = Math.abs(shape * picture_half.y / picture_half.x - 1) < 0.02;
        const short = same ? picture_half.y : 1.6 * Math.max(picture_half.x / Math.max(1, shape), picture_half.y);
        uniforms.picture_half.value.set(same ? picture_half.x : short * shape, short);
    }
}

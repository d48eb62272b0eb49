// SPDX-License-Identifier: GPL-3.0-or-later
// Rain on a windshield in three.js as it falls: the maps are textures, and the shader is that of `windshield --live`.
import {
    BufferAttribute, BufferGeometry, DataTexture, GLSL3, HalfFloatType, LinearFilter, Mesh, RawShaderMaterial, RedFormat, RGBAFormat,
    UnsignedByteType, Vector2, Vector3,
} from 'three';

const kStep = 1 / 60;
const kStepsAtOnce = 3;

const kVertex = /* glsl */ `
precision highp float;
uniform mat4 modelMatrix, viewMatrix, projectionMatrix;
in vec3 position, facing, right, upward;
in vec2 map;
out vec3 place, normal, across, up;
out vec2 uv;
void main() {
    place = position;
    normal = facing;
    across = right;
    up = upward;
    uv = map;
    gl_Position = projectionMatrix * viewMatrix * modelMatrix * vec4(position, 1.0);
}`;

/** The glass, a cylinder's or a mesh, in the vehicle's frame: x to the right, y ahead, z up. */
function glassOf(rain, { width, height }) {
    const corners = rain.triangles().flat();
    const geometry = new BufferGeometry();
    const add = (name, size, numbersOf) => geometry.setAttribute(name, new BufferAttribute(new Float32Array(corners.flatMap(numbersOf)), size));
    add('position', 3, ({ point }) => point);
    add('facing', 3, ({ normal }) => normal);
    add('right', 3, ({ across }) => across);
    add('upward', 3, ({ up }) => up);
    add('map', 2, ({ x, y }) => [x / width, 1 - y / height]);
    return geometry;
}

function textureOf(map, format, type) {
    const texture = new DataTexture(map.pixels, map.width, map.height, format, type);
    texture.minFilter = texture.magFilter = LinearFilter;
    texture.unpackAlignment = 1;
    return texture;
}

/**
 * Makes a windshield with rain for a camera behind it that looks straight ahead.
 * @param rain     windshield of 'droplet-shape/windshield'
 * @param shader   text of src/rain/rain.glsl
 * @param outside  texture that fills the frame, with mipmaps, `flipY` false and `colorSpace` SRGBColorSpace
 * @param blur     mipmap level of it that bare glass shows
 * @return         `mesh`, which is turned from the vehicle's frame to that of three.js, and `update`, a function of the time
 *                 that has passed [s] and the camera
 */
export function rainyGlass(rain, shader, outside, blur = 0) {
    const figures = rain.figures();
    const uniforms = {
        water: { value: textureOf(rain.draw(), RGBAFormat, HalfFloatType) }, mist: { value: textureOf(rain.mist(), RedFormat, UnsignedByteType) },
        film: { value: textureOf(rain.runoff(), RedFormat, UnsignedByteType) }, film_edge: { value: new Vector2(1, 1) }, drift: { value: new Vector2() },
        outside: { value: outside }, dry: { value: outside }, blur: { value: blur }, mist_edge: { value: new Vector2(1, 1) },
        glass: { value: new Vector2(figures.width, figures.height) }, eye: { value: new Vector3() }, tangent: { value: new Vector2() },
        wide: { value: new Vector2() }, rim: { value: 1 }, cabin: { value: new Vector3(0.01, 0.01, 0.012) }, border: { value: 0 },
    };
    const material = new RawShaderMaterial({
        uniforms, glslVersion: GLSL3, vertexShader: kVertex,
        // It gives light; the canvas takes levels.
        fragmentShader: `precision highp float;\n${shader.replace('colour = vec4(light, 1.0)', 'colour = vec4(pow(light, vec3(1.0 / 2.2)), 1.0)')}`,
    });
    const mesh = new Mesh(glassOf(rain, figures), material);
    mesh.rotation.x = -Math.PI / 2;
    let behind = 0;
    const update = (seconds, camera) => {
        for (behind = Math.min(behind + seconds, kStepsAtOnce * kStep + 1e-9); behind >= kStep; behind -= kStep) {
            rain.advance(kStep);
        }
        uniforms.water.value.image.data = rain.draw().pixels;  // in memory that may have moved
        uniforms.water.value.needsUpdate = true;
        const film = rain.runoff();
        for (const [name, map] of [['mist', rain.mist()], ['film', film]]) {
            const uniform = uniforms[name];
            if (uniform.value.image.width !== map.width) {
                uniform.value.dispose();
                uniform.value = textureOf(map, RedFormat, UnsignedByteType);
            }
            uniform.value.image.data = map.pixels;
            uniform.value.needsUpdate = true;
            uniforms[`${name}_edge`].value.set(map.right, map.top);
        }
        uniforms.drift.value.set(film.drift.x, -film.drift.y);
        uniforms.rim.value = Math.sin(Math.min(rain.get('contactAngle'), Math.PI / 2));
        const { x, y, z } = camera.position;
        uniforms.eye.value.set(x, -z, y);
        const tangent = Math.tan(camera.fov * Math.PI / 360);
        uniforms.tangent.value.set(tangent * camera.aspect, tangent);
        uniforms.wide.value.copy(uniforms.tangent.value);
    };
    return { mesh, update };
}

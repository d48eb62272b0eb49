// SPDX-License-Identifier: MIT
// The room that the liquid reflects: soft light and one tall window, as a formula. It is sharp at every size and ready
// at once; drawing a texture first takes long without a graphics card.
import { ShaderChunk, Vector3 } from 'three';
import { kGroundRadiance } from './ground.js';

/** Direction of the window: behind on the left, so that its rays come through the liquid toward the viewer. */
export const kSun = new Vector3(-0.6, 0.62, -0.5).normalize();
/** Axes of the window. */
export const kAcross = new Vector3(0, 1, 0).cross(kSun).normalize();
export const kUpward = new Vector3().copy(kSun).cross(kAcross);

/** A vector, in GLSL. */
export const vec3 = (v) => `vec3(${v.toArray().map((x) => x.toFixed(6)).join(', ')})`;

/** roomRadiance and roomIrradiance, in GLSL. */
export const kRoom = `
uniform float room_walls;
uniform float room_lamps;

// 1 inside a rectangle with soft edges.
float pane(vec2 at, vec2 middle, vec2 half_size, float soft) {
    vec2 inside = smoothstep(half_size + soft, half_size - soft, abs(at - middle));
    return inside.x * inside.y;
}

vec2 seenFrom(vec3 way, vec3 lamp, vec3 right, vec3 up) {
    float along = dot(way, lamp);
    return along > 0.05 ? vec2(dot(way, right), dot(way, up)) / along : vec2(1e3);
}

vec3 roomRadiance(vec3 way, float roughness) {
    float blur = roughness * 0.6;
    vec3 light = mix(vec3(0.3, 0.29, 0.28), vec3(0.55, 0.58, 0.62), smoothstep(-0.3 - blur, 0.15 + blur, way.y));
    light = room_walls * mix(light, vec3(1.0, 1.05, 1.1), smoothstep(0.1 - blur, 0.95, way.y));
    vec2 at = seenFrom(way, ${vec3(kSun)}, ${vec3(kAcross)}, ${vec3(kUpward)});
    float soft = 0.012 + 0.5 * roughness;
    float window = 0.0;
    for (int x = 0; x < 2; ++x) {
        for (int y = 0; y < 3; ++y) {
            window += pane(at, vec2(float(x) - 0.5, float(y) - 1.0) * vec2(0.24, 0.2), vec2(0.105, 0.085), soft);
        }
    }
    light += room_lamps * 26.0 * vec3(1.0, 0.98, 0.94) * window;
    vec3 box = normalize(vec3(0.8, 0.5, 0.42));
    vec3 side = normalize(cross(vec3(0.0, 1.0, 0.0), box));
    at = seenFrom(way, box, side, cross(box, side));
    light += room_lamps * 2.4 * vec3(0.9, 0.95, 1.0) * pane(at, vec2(0.0), vec2(0.3, 0.2), 0.06 + soft);
    // Between the bright ceiling and the horizon it is dark, or liquids would look like wax and metal be an even grey.
    float wall = smoothstep(0.0, 0.06, way.y) * (1.0 - smoothstep(0.45, 0.8, way.y));
    float lamp = smoothstep(1.5, 4.0, max(light.r, max(light.g, light.b)));
    light *= mix(1.0, 0.08, wall * (1.0 - lamp));
    return light;
}

// On white that faces up, about what lights the ground.
vec3 roomIrradiance(vec3 normal) {
    vec3 walls = room_walls * mix(vec3(0.22), vec3(0.46, 0.48, 0.5), 0.5 + 0.5 * normal.y);
    return PI * walls + room_lamps * 3.0 * max(dot(normal, ${vec3(kSun)}), 0.0);
}
`;

// On flat ground a mirror shows the ground below the horizon.
const kMirror = `
uniform float ground_level;

vec3 mirroredRadiance(vec3 place, vec3 way, float roughness) {
    vec2 met = place.xz + way.xz * max(place.y - ground_level, 0.0) / max(-way.y, 0.02);
    return mix(groundRadiance(met, fwidth(met)), roomRadiance(way, roughness), smoothstep(-0.02, 0.02, way.y));
}
`;

const lightOf = (radiance) => `
#if defined( RE_IndirectDiffuse )
    iblIrradiance += roomIrradiance( transformNormalByInverseViewMatrix( geometryNormal, viewMatrix ) );
#endif
#if defined( RE_IndirectSpecular )
    vec3 mirrored_way = transformDirectionByInverseViewMatrix( reflect( - geometryViewDir, geometryNormal ), viewMatrix );
    radiance += ${radiance};
#endif
`;
const kRoomLight = lightOf('roomRadiance( mirrored_way, material.roughness )');
const kMirrorLight = lightOf(`mirroredRadiance( cameraPosition - ( vec4( vViewPosition, 0.0 ) * viewMatrix ).xyz, mirrored_way,
        material.roughness )`);

// On flat ground the path of a ray through the liquid is known at every pixel and fill; the file's thickness is only a
// mean.
const kRay = 'return normalize( refractionVector ) * thickness * modelScale;';
const kRayToGround = 'return refractionVector * ( max( vWorldPosition.y - ground_level, 0.0 ) / max( - refractionVector.y, 0.1 ) );';

// Smooth liquid shows the ground where that ray meets it. three.js takes it from a picture of the ground, which costs a
// second picture, is blurred, and ends where the canvas does.
const kClear = `
    material.transmissionAlpha = 1.0;
    vec3 view_way = normalize( cameraPosition - vWorldPosition );
    vec3 upright = transformNormalByInverseViewMatrix( normal, viewMatrix );
    vec3 ray = getVolumeTransmissionRay( upright, view_way, thickness, material.ior, modelMatrix );
    vec3 mirrored = EnvironmentBRDF( upright, view_way, material.specularColorBlended, material.specularF90, 0.0 );
    // Slopes of small triangles differ more than the pixels that they cover.
    vec2 met = ( vWorldPosition + ray ).xz;
    vec2 pixel = fwidth( vWorldPosition.xz );
    vec3 seen = groundRadiance( met, clamp( fwidth( met ), pixel, 3.0 * pixel ) ) *
        volumeAttenuation( length( ray ), attenuationColor, attenuationDistance );
    totalDiffuse = mix( totalDiffuse, ( 1.0 - mirrored ) * material.diffuseContribution * seen, transmission );
`;

const kSmooth = 0.03;  // roughness below which what is behind is seen sharply

/** Share of the light that goes through a material. */
export const transmissionOf = (material) => material.userData.transmission ?? material.transmission;

/**
 * Puts a material into the room.
 * @param light   {walls, lamps}: brightness, as uniforms
 * @param exact   whether it is liquid on flat ground
 * @param ground  {uniforms, level}, which metal mirrors and clear liquid shows: of Ground, and its height as a uniform
 */
export function putIntoRoom(material, light, exact, ground) {
    const is_metal = material.metalness > 0;
    const is_clear = exact && material.roughness < kSmooth;
    const mirrors_ground = is_metal || exact;
    material.userData.transmission = transmissionOf(material);
    if (is_clear) {
        material.transmission = 0;  // else three.js draws the second picture
        material.defines.USE_TRANSMISSION = '';
    } else if (material.userData.transmission > 0) {
        material.transmission = material.userData.transmission;
        delete material.defines.USE_TRANSMISSION;
    }
    material.onBeforeCompile = (shader) => {
        shader.uniforms.room_walls = light.walls;
        shader.uniforms.room_lamps = light.lamps;
        if (mirrors_ground) {
            Object.assign(shader.uniforms, ground.uniforms, { ground_level: ground.level });
        }
        if (is_clear) {
            shader.uniforms.transmission = { value: material.userData.transmission };
            shader.uniforms.attenuationColor = { value: material.attenuationColor };
            shader.uniforms.attenuationDistance = { get value() { return material.attenuationDistance; } };
        }
        const transmission = exact ? ShaderChunk.transmission_pars_fragment.replace(kRay, kRayToGround) :
            ShaderChunk.transmission_pars_fragment;
        shader.fragmentShader = shader.fragmentShader
            .replace('#include <transmission_pars_fragment>', [kRoom, ...mirrors_ground ? [kGroundRadiance, kMirror] : [], transmission].join('\n'))
            .replace('#include <lights_fragment_maps>', mirrors_ground ? kMirrorLight : kRoomLight);
        if (is_clear) {
            shader.fragmentShader = shader.fragmentShader.replace('#include <transmission_fragment>', kClear);
        }
    };
    material.customProgramCacheKey = () => `room ${exact} ${is_metal} ${is_clear}`;
}

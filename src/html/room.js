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

const vec3 = (v) => `vec3(${v.toArray().map((x) => x.toFixed(6)).join(', ')})`;

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
    return light;
}

vec3 roomIrradiance(vec3 normal) {
    vec3 walls = room_walls * mix(vec3(0.36), vec3(0.8, 0.84, 0.88), 0.5 + 0.5 * normal.y);
    return PI * walls + room_lamps * 5.0 * max(dot(normal, ${vec3(kSun)}), 0.0);
}
`;

// A mirror shows what is around it: the ground, and a room that is dark between its bright ceiling and the horizon. In
// the room of the liquids, which is bright everywhere, metal would be an even grey.
const kMirror = `
uniform float ground_level;

vec3 mirroredRadiance(vec3 place, vec3 way, float roughness) {
    vec3 room = roomRadiance(way, roughness);
    float wall = smoothstep(0.0, 0.06, way.y) * (1.0 - smoothstep(0.45, 0.8, way.y));
    float window = smoothstep(1.5, 4.0, max(room.r, max(room.g, room.b)));
    room *= mix(1.0, 0.08, wall * (1.0 - window));
    vec2 met = place.xz + way.xz * max(place.y - ground_level, 0.0) / max(-way.y, 0.02);
    return mix(groundRadiance(met), room, smoothstep(-0.02, 0.02, way.y));
}
`;

const kMirrorLight = `
#if defined( RE_IndirectSpecular )
    radiance += mirroredRadiance( cameraPosition - ( vec4( vViewPosition, 0.0 ) * viewMatrix ).xyz,
        transformDirectionByInverseViewMatrix( reflect( - geometryViewDir, geometryNormal ), viewMatrix ), material.roughness );
#endif
`;

const kRoomLight = `
#if defined( RE_IndirectDiffuse )
    iblIrradiance += roomIrradiance( transformNormalByInverseViewMatrix( geometryNormal, viewMatrix ) );
#endif
#if defined( RE_IndirectSpecular )
    radiance += roomRadiance( transformDirectionByInverseViewMatrix( reflect( - geometryViewDir, geometryNormal ), viewMatrix ),
        material.roughness );
#endif
`;

// On flat ground the path length of a ray through the liquid is known at every pixel and fill; the file's thickness is
// only a mean. Only this length is replaced.
const kRay = 'return normalize( refractionVector ) * thickness * modelScale;';
const kRayToGround = 'return refractionVector * ( max( vWorldPosition.y, 0.0 ) / max( - refractionVector.y, 0.1 ) );';

/**
 * Puts a material into the room.
 * @param light   {walls, lamps}: brightness, as uniforms
 * @param exact   whether the liquid stands on flat ground at height 0
 * @param ground  {uniforms, level}, which metal mirrors: of Ground, and its height as a uniform
 */
export function putIntoRoom(material, light, exact, ground) {
    const is_metal = material.metalness > 0;
    material.onBeforeCompile = (shader) => {
        shader.uniforms.room_walls = light.walls;
        shader.uniforms.room_lamps = light.lamps;
        if (is_metal) {
            Object.assign(shader.uniforms, ground.uniforms, { ground_level: ground.level });
        }
        const transmission = exact ? ShaderChunk.transmission_pars_fragment.replace(kRay, kRayToGround) :
            ShaderChunk.transmission_pars_fragment;
        shader.fragmentShader = shader.fragmentShader
            .replace('#include <transmission_pars_fragment>',
                [transmission, kRoom, ...is_metal ? [kGroundRadiance, kMirror] : []].join('\n'))
            .replace('#include <lights_fragment_maps>', is_metal ? kMirrorLight : kRoomLight);
    };
    material.customProgramCacheKey = () => `room ${exact} ${is_metal}`;
}

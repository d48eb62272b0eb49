// SPDX-License-Identifier: GPL-3.0-or-later
// Water on a windshield, as the driver sees it: a fragment shader for OpenGL 3.3 and WebGL 2 alike. The program puts
// "#version 330 core", or "#version 300 es" and "precision highp float;", before it.
//
// Rays of the eye pass the pane, which does not turn them, and the water on it, and are refracted where they leave it
// (Snell, Fresnel), as DriversView of the library has it. Behind the glass lies a picture that fills the frame through
// dry glass; directions beyond its edges show it mirrored.

uniform sampler2D water;    // WindshieldMaps: normal x and y times wetness, thickness in mm, wetness; upper edge first
uniform sampler2D outside;  // picture behind the glass, with mipmaps
uniform vec2 glass;         // width and height of the map [m]
uniform vec3 eye;           // in the vehicle's frame: x right, y ahead, z up [m]
uniform vec2 tangent;       // of half the angle of the frame, across and up
uniform float blur;         // of the picture where the glass is bare, as a mipmap level
uniform vec3 cabin;         // light that total reflection shows

in vec3 place;   // on the glass, in the vehicle's frame [m]
in vec3 normal;  // outward
in vec3 across;  // unit tangents along the map's x, and up the glass
in vec3 up;
in vec2 uv;  // in the map, from the upper left

out vec4 colour;

const float kIor = 1.333;                    // of water
const vec3 kPane = vec3(0.97, 0.985, 0.98);  // what the glass lets pass

// Where the picture shows a direction: mirrored at its edges, the middle again at a right angle.
vec2 pictureOf(vec3 direction)
{
    vec2 s = direction.xz / (max(abs(direction.y), 1e-4) * tangent);
    vec2 inside = mix(s, sign(s) / max(abs(s), 1e-4), step(1.0, abs(s)));
    return vec2(0.5 + 0.5 * inside.x, 0.5 - 0.5 * inside.y);
}

// Light from outside in a direction; `level` of the picture's mipmaps.
vec3 light(vec3 direction, float level)
{
    return textureLod(outside, pictureOf(direction), level).rgb;
}

void main()
{
    vec4 wet = texture(water, uv);
    // The outline of a droplet is sharp, however coarse the map: of several ramps, this is nearest to the ray-traced view.
    float cover = smoothstep(0.2, 0.7, wet.a);
    vec3 n = normalize(normal);
    vec3 ray = normalize(place - eye);
    vec3 local = vec3(dot(ray, across), dot(ray, up), dot(ray, n));
    vec3 inside = vec3(local.xy / kIor, 0.0);
    inside.z = sqrt(1.0 - dot(inside.xy, inside.xy));
    // The ray leaves the water beside the place where it enters it, the farther the thicker the water is.
    vec2 aside = inside.xy / inside.z * vec2(1e-3, -1e-3) / glass;
    vec4 leaves = wet;
    for (int k = 0; k < 4; ++k) {
        leaves = texture(water, uv + aside * leaves.b / max(leaves.a, 0.1));
    }
    vec2 slope = leaves.xy / max(leaves.a, 1e-3);
    vec3 facing = vec3(slope, sqrt(max(1.0 - dot(slope, slope), 0.0)));

    // Unpolarised light that goes from water to air.
    float c = dot(inside, facing);
    float sine2 = kIor * kIor * (1.0 - c * c);
    float passes = 0.0;
    vec3 leaving = local;
    if (c > 0.0 && sine2 < 1.0) {
        float k = sqrt(1.0 - sine2);
        float across_plane = (kIor * c - k) / (kIor * c + k);
        float in_plane = (c - kIor * k) / (c + kIor * k);
        passes = 1.0 - 0.5 * (across_plane * across_plane + in_plane * in_plane);
        leaving = kIor * inside + (k - kIor * c) * facing;
    }
    vec3 direction = leaving.x * across + leaving.y * up + leaving.z * n;
    // What a droplet shows of the picture is small: the level follows from how far neighbours look apart.
    vec2 pixels = vec2(textureSize(outside, 0)) / (2.0 * tangent);
    float apart = max(length(dFdx(direction.xz) * pixels), length(dFdy(direction.xz) * pixels));
    vec3 seen = mix(cabin, light(direction, clamp(log2(max(apart, 1.0)), 0.0, 7.0)), passes);
    colour = vec4(mix(light(ray, blur), seen, cover) * kPane, 1.0);
}

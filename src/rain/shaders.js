// SPDX-License-Identifier: MIT
// Shaders of the page beside rain.glsl, for WebGL 2. All have light, not levels, until the last.

const kHead = '#version 300 es\nprecision highp float;\nprecision highp int;\n';

/** The film: light to levels, and levels to light, before the curve of sRGB. What is bright keeps its hue, as in the ray-traced view. */
const kFilm = `
const float kFilm = 1.15;
float brightest(vec3 c) { return max(max(c.r, c.g), max(c.b, 1e-5)); }
vec3 developed(vec3 light) { return light * (1.0 - exp(-kFilm * brightest(light))) / brightest(light); }
vec3 lightOf(vec3 level) { return level * -log(1.0 - min(brightest(level), 0.985)) / kFilm / brightest(level); }
vec3 encoded(vec3 x) { return mix(12.92 * x, 1.055 * pow(max(x, vec3(1e-6)), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, x)); }
`;

/** A triangle that covers everything; at is from the lower left, 0 to 1. */
export const kWhole = `${kHead}out vec2 at;
void main() {
    at = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0;
    gl_Position = vec4(2.0 * at - 1.0, 0.0, 1.0);
}`;

/** A shader of a file, for WebGL 2. */
export const shaderOf = (source) => kHead + source;

/** Dark parts of the car: wipers and the dashboard. side is 0 in the middle of a part and 1 at its edges. */
export const kPart = `${kHead}uniform vec3 eye;
uniform vec2 tangent;
layout(location = 0) in vec3 at;
layout(location = 1) in vec2 along;
layout(location = 2) in vec4 paint;
out vec2 side;
out vec4 tint;
void main() {
    side = along; tint = paint;
    vec3 from = at - eye;
    gl_Position = vec4(from.xz / tangent, 0.0, from.y);
}`;

export const kPaint = `${kHead}in vec2 side;
in vec4 tint;
out vec4 colour;
void main() {
    vec2 soft = max(fwidth(side), vec2(0.02));
    vec2 share = 1.0 - smoothstep(1.0 - soft, vec2(1.0), abs(side));
    float shine = tint.a > 1.0 ? 0.0 : exp(-18.0 * (side.y - 0.45) * (side.y - 0.45));
    colour = vec4(tint.rgb * (1.0 + 2.5 * shine), share.x * share.y * min(tint.a, 1.0));
}`;

/**
 * Where blades have wiped: a map of the glass that says how fresh the film is, from 1 to 0, the distance along the blade and the
 * way of its outer end [m], and the blade's angle.
 */
export const kSweep = `${kHead}uniform vec2 glass;
layout(location = 0) in vec2 position;
layout(location = 1) in vec4 film;
out vec4 left;
void main() {
    left = film;
    gl_Position = vec4(2.0 * position / glass - 1.0, 0.0, 1.0);
}`;

export const kSwept = `${kHead}in vec4 left;
out vec4 colour;
void main() { colour = left; }`;

/** What all films lose in a step. */
export const kDry = `${kHead}uniform float lost;
out vec4 colour;
void main() { colour = vec4(lost, 0.0, 0.0, 0.0); }`;

/**
 * The film behind a blade, which breaks up into streaks, with the vertices of glass.glsl. Its shapes and sizes are those of the
 * ray-traced view (src/windshield_view/wiper_view.cpp); droplets lie over it.
 */
export const kFilmLeft = `${kHead}uniform highp sampler2D left;
uniform sampler2D water, dry, edge;
uniform vec2 glass, tangent;
uniform vec3 eye, cabin;
uniform float lasts;   // [s]
uniform float border;  // [m]
in vec3 place, normal, across, up;
in vec2 uv;
out vec4 colour;
const float kIor = 1.333;
const vec3 kPane = vec3(0.97, 0.985, 0.98);
float hashed(vec2 cell) {
    vec3 p = fract(vec3(cell.xyx) * 0.1031);
    p += dot(p, p.yzx + 33.33);
    return fract((p.x + p.y) * p.z);
}
// A smooth random number from 0 to 1, and its derivatives.
vec3 noise(vec2 p) {
    vec2 cell = floor(p), f = p - cell, s = f * f * (3.0 - 2.0 * f);
    float a = hashed(cell), b = hashed(cell + vec2(1.0, 0.0)), c = hashed(cell + vec2(0.0, 1.0)), d = hashed(cell + 1.0);
    float twist = a - b - c + d;
    return vec3(a + s.x * (b - a) + s.y * (c - a) + s.x * s.y * twist, 6.0 * f * (1.0 - f) * vec2(b - a + s.y * twist, c - a + s.x * twist));
}
// Streaks, thick and thin, along the way of the blade and across it, per metre.
vec3 level(vec2 p) {
    const vec2 kThick = vec2(1.0 / 0.045, 1.0 / 0.0042), kThin = vec2(47.2, 643.6);
    vec3 thick = noise(p * kThick), thin = noise(p * kThin + 31.0);
    return 0.62 * vec3(thick.x, thick.yz * kThick) + 0.38 * vec3(thin.x, thin.yz * kThin);
}
void main() {
    vec4 film = texture(left, vec2(uv.x, 1.0 - uv.y));
    if (film.r <= 0.0) {
        discard;
    }
    float age = (1.0 - film.r) * lasts;
    vec3 streak = level(vec2(film.b, film.g));
    float over = streak.x - (0.12 + 0.88 * sqrt(1.0 - film.r));  // what is lower is bare
    float pixel = max(length(dFdx(uv) * glass), length(dFdy(uv) * glass));
    float cover = clamp(over / max(length(streak.yz), 1e-3) / pixel + 0.5, 0.0, 1.0) * (1.0 - smoothstep(0.17, 0.6, texture(water, uv).a));
    cover *= border > 0.0 ? smoothstep(border, 1.6 * border, texture(edge, uv).r) : 1.0;  // what is printed lies before it
    if (over <= 0.0 || cover <= 0.0) {
        discard;
    }
    float thickness = 4.5e-5 * (0.35 + 0.65 * exp(-age / 0.3));  // [m]
    vec2 outward = vec2(cos(film.a), sin(film.a));
    vec2 slope = thickness * (1.0 + 1.2 * exp(-over / 0.05)) * (streak.z * outward + streak.y * vec2(-outward.y, outward.x));
    vec3 facing = normalize(vec3(-slope, 1.0)), n = normalize(normal), ray = normalize(place - eye);
    vec3 inside = vec3(dot(ray, across), dot(ray, up), 0.0) / kIor;
    inside.z = sqrt(1.0 - dot(inside.xy, inside.xy));
    vec3 leaving = refract(inside, -facing, kIor);
    vec3 light = cabin;
    if (leaving.z > 0.0) {
        vec3 direction = leaving.x * across + leaving.y * up + leaving.z * n;
        vec2 s = direction.xz / (max(direction.y, 1e-4) * tangent);
        float c = dot(inside, facing), k = dot(leaving, facing);
        float across_plane = (kIor * c - k) / (kIor * c + k), in_plane = (c - kIor * k) / (c + kIor * k);
        light = mix(textureLod(dry, vec2(0.5 + 0.5 * s.x, 0.5 - 0.5 * s.y), 0.0).rgb, cabin, 0.5 * (across_plane * across_plane + in_plane * in_plane));
    }
    colour = vec4(light * kPane, cover);
}`;

/**
 * The line of water that a blade pushes, or leaves where it turns, with the vertices of glass.glsl: half an ellipse across, whose
 * width differs along it (src/windshield_view/wiper_view.cpp).
 */
export const kPushed = `${kHead}uniform sampler2D outside, edge;
uniform vec2 glass, wide, pivot, along, ahead, reach;  // reach: of the blade, from the pivot [m]
uniform vec3 eye, cabin;
uniform float begins;   // distance from the blade's middle [m]
uniform float pushed, drained, seed;
uniform float border;   // [m]
uniform vec2 other_pivot, other_reach, other_angles;  // another blade's field, which lets no water stay
in vec3 place, normal, across, up;
in vec2 uv;
out vec4 colour;
const float kIor = 1.333, kPi = 3.14159265, kWidest = 0.007;
const vec3 kPane = vec3(0.97, 0.985, 0.98);
float hashed(float cell) { return fract(sin(cell * 91.7 + seed * 17.0) * 4375.5); }
float uneven(float x) { return mix(hashed(floor(x)), hashed(floor(x) + 1.0), smoothstep(0.0, 1.0, fract(x))); }
bool isInOther(vec2 p) {
    vec2 from = p - other_pivot;
    float far = length(from), share = (atan(from.y, from.x) - other_angles.x) / (other_angles.y - other_angles.x);
    return far > other_reach.x && far < other_reach.y && share > 0.0 && share < 1.0;
}
void main() {
    vec2 position = vec2(uv.x, 1.0 - uv.y) * glass, from = position - pivot;
    float far = dot(from, along), beyond = dot(from, ahead) - begins, end = min(far - reach.x, reach.y - far);
    float width = smoothstep(0.0, 0.03, end);
    if (drained < 0.0) {
        width *= kWidest * pushed * (0.35 + 0.65 * uneven(far / 0.014));
        width *= isInOther(position) ? 1.0 - smoothstep(0.6, 0.95, pushed) : 1.0;
    } else {
        // It drains along the blade's line, last at thick places, and is wider further out.
        float out_there = (far - reach.x) / (reach.y - reach.x);
        width *= 1.7 * kWidest * (0.35 + 0.65 * out_there) * max(0.6 * uneven(far / 0.018 + 2.0 * drained) + 0.5 - 1.1 * drained, 0.0);
        width *= isInOther(position) ? 0.0 : 1.0;
    }
    float pixel = max(length(dFdx(position)), length(dFdy(position)));
    float cover = clamp(beyond / pixel + 0.5, 0.0, 1.0) + clamp((width - beyond) / pixel + 0.5, 0.0, 1.0) - 1.0;
    cover *= border > 0.0 ? smoothstep(border, 1.6 * border, texture(edge, uv).r) : 1.0;
    float x = clamp(2.0 * beyond / max(width, 1e-6) - 1.0, -0.96, 0.96);
    vec2 slope = -0.7 * x * inversesqrt(1.0 - x * x) * ahead;
    vec3 facing = normalize(vec3(-slope, 1.0)), n = normalize(normal), ray = normalize(place - eye);
    vec3 inside = vec3(dot(ray, across), dot(ray, up), 0.0) / kIor;
    inside.z = sqrt(1.0 - dot(inside.xy, inside.xy));
    vec3 leaving = refract(inside, -facing, kIor);
    bool passes = dot(leaving, leaving) > 0.0;
    leaving = passes ? leaving : inside;
    vec3 direction = leaving.x * across + leaving.y * up + leaving.z * n;
    vec2 s = direction.xz / (max(abs(direction.y), 1e-4) * max(wide, 1e-4));
    vec2 mirrored = mix(s, sign(s) / max(abs(s), 1e-4), step(1.0, abs(s)));
    vec2 at = wide.x == 0.0 ? vec2(0.5 + atan(direction.x, direction.y) / (2.0 * kPi), acos(clamp(direction.z, -1.0, 1.0)) / kPi)
                            : vec2(0.5 + 0.5 * mirrored.x, 0.5 - 0.5 * mirrored.y);
    vec2 pixels = vec2(textureSize(outside, 0)) / (wide.x == 0.0 ? vec2(2.0 * kPi, kPi) : 2.0 * wide);
    float apart = max(length(dFdx(direction.xz) * pixels), length(dFdy(direction.xz) * pixels));
    vec3 light = cabin;
    if (passes) {
        float c = dot(inside, facing), k = dot(leaving, facing);
        float across_plane = (kIor * c - k) / (kIor * c + k), in_plane = (c - kIor * k) / (c + kIor * k);
        light = mix(textureLod(outside, at, clamp(log2(max(apart, 1.0)), 0.0, 7.0)).rgb, cabin, 0.5 * (across_plane * across_plane + in_plane * in_plane));
    }
    if (width < 3e-4 || cover <= 0.0) {
        discard;
    }
    colour = vec4(light * kPane, cover);
}`;

/** The street without its lights: sky, hills, wet road and its lines. */
export const kScenery = `${kHead}in vec2 at;
uniform vec2 wide;
uniform float spread;
uniform float travelled;
out vec4 colour;
const float kEye = 1.2, kLane = 3.5;
float depthOf(float up) { return min(kEye / max(-up, 1e-4), 420.0); }
vec3 sky(vec2 p) {
    float up = max(p.y, 0.0);
    vec3 c = mix(mix(vec3(0.20, 0.115, 0.085), vec3(0.050, 0.062, 0.105), smoothstep(0.0, 0.14, up)), vec3(0.012, 0.020, 0.045), smoothstep(0.08, 0.5, up));
    vec2 g = p - vec2(0.06, 0.012);
    c += exp(-(g.x * g.x / 0.05 + g.y * g.y / 0.006)) * vec3(0.34, 0.19, 0.10);
    float bands = 0.5 + 0.5 * sin(31.0 * up + 3.0 * sin(3.0 * p.x + 7.0 * up));
    return c + 0.022 * bands * smoothstep(0.02, 0.1, up) * vec3(1.0, 0.74, 0.66);
}
float line(vec2 p, float across) {
    float depth = depthOf(p.y), slope = across / kEye, square = inversesqrt(1.0 + slope * slope);
    float away = square * abs(p.x + slope * p.y), half_width = 0.075 * square / depth;
    float a = smoothstep(-spread, spread, half_width + away), b = smoothstep(-spread, spread, half_width - away);
    return (a + b - 1.0) * (1.0 - smoothstep(60.0, 160.0, depth));
}
float dashes(float depth) {
    float soft = 0.3 + spread * depth * depth / kEye, way = mod(depth + travelled, 18.0);
    float d = abs(way - 9.0) - 3.0;
    return mix(1.0 - smoothstep(-soft, soft, d), 0.333, smoothstep(3.0, 9.0, soft));
}
// Roofs at both sides, the nearer the higher; the lens blurs their edges.
float roofs(float x) {
    float high = 0.0;
    for (int k = 0; k < 3; ++k) {
        float size = 0.13 / (1.0 + 0.7 * float(k)), place = x / size + 0.37 * float(k), soft = clamp(1.2 * spread / size, 0.01, 0.5);
        float cell = floor(place), f = place - cell;
        vec3 h = fract(sin((cell + vec3(-1.0, 0.0, 1.0)) * 91.7 + float(k) * 17.0) * 4375.5);
        float roof = mix(mix(h.x, h.y, smoothstep(-soft, soft, f)), h.z, smoothstep(1.0 - soft, 1.0 + soft, f));
        high = max(high, (0.05 + 0.16 * roof) * smoothstep(0.05, 0.32 + 0.1 * float(k), abs(x + 0.02)) / (1.0 + 0.5 * float(k)));
    }
    return high;
}
float skyline(float x) { return 0.012 + 0.006 * sin(13.7 * x + 2.0) + roofs(x) * (0.7 + 1.3 * smoothstep(0.2, 1.2, abs(x))); }
void main() {
    vec2 p = (2.0 * at - 1.0) * wide;
    float depth = depthOf(p.y), down = max(-p.y, 1e-4), across = p.x * depth, edge = (spread + 0.02) * depth;
    vec3 verge = mix(vec3(0.030, 0.026, 0.028), vec3(0.006, 0.008, 0.009), 1.0 - exp(-down / 0.05));
    vec3 road = vec3(0.010, 0.011, 0.014) + (0.14 + 0.6 * smoothstep(5.0, 110.0, depth)) * sky(vec2(0.6 * p.x, 0.55 * down));
    float on_road = smoothstep(-1.5 * kLane - 0.6 - edge, -1.5 * kLane - 0.6 + edge, across) * (1.0 - smoothstep(0.5 * kLane + 0.6 - edge, 0.5 * kLane + 0.6 + edge, across));
    float painted = max(max(line(p, 0.5 * kLane), line(p, -1.5 * kLane)), dashes(depth) * line(p, -0.5 * kLane));
    vec3 ground = mix(verge, mix(road, vec3(0.10) + 0.5 * road, painted), on_road);
    float roof = skyline(p.x);
    vec3 houses = mix(vec3(0.030, 0.025, 0.027), vec3(0.012, 0.013, 0.017), smoothstep(0.0, 0.2, p.y));
    vec3 above = mix(houses, sky(p), smoothstep(-0.7 * spread - 0.004, 0.7 * spread + 0.004, p.y - roof));
    colour = vec4(0.72 * mix(ground, above, smoothstep(-0.5 * spread - 0.002, 0.5 * spread + 0.002, p.y + 0.002)), 1.0);
}`;

/** Lights as discs of a lens out of focus, or as small spots. */
export const kLights = `${kHead}layout(location = 0) in vec2 corner;
layout(location = 1) in vec4 spot;
layout(location = 2) in vec4 shine;
uniform vec2 wide;
uniform float spread, least;
out vec2 inside;
out vec3 light;
flat out float is_mirrored;
void main() {
    float radius = sqrt(spread * spread + spot.z * spot.z);
    float drawn = max(radius, least);
    is_mirrored = shine.w;
    vec2 half_size = shine.w > 0.5 ? vec2(1.7 * drawn, max(2.0 * drawn, spot.w)) : vec2(spread > 0.0 ? 1.04 * drawn : 2.4 * drawn);
    // A light has the same power in focus and out of it.
    const float kReference = 0.017;
    float power = (kReference * kReference + spot.z * spot.z) / (drawn * drawn);
    light = shine.rgb * min(shine.w > 0.5 ? mix(1.0, sqrt(power), 0.5) : power, 60.0);
    inside = corner;
    gl_Position = vec4((spot.xy + corner * half_size) / wide, 0.0, 1.0);
}`;

export const kShine = `${kHead}in vec2 inside;
in vec3 light;
flat in float is_mirrored;
uniform float spread;
out vec4 colour;
void main() {
    float d = length(inside);
    float rest = max(1.0 - d * d, 0.0);  // vanishes smoothly: the brightest show an edge otherwise
    float share = rest * rest * rest;
    if (is_mirrored < 0.5 && spread > 0.0) {
        float soft = max(2.0 * fwidth(d), 0.07);
        share = (1.0 - smoothstep(1.0 - soft, 1.0, d)) * (0.66 + 0.18 * d * d + 0.42 * smoothstep(0.76, 0.96, d));
    }
    colour = vec4(light * share, 0.0);
}`;

/** A picture or panorama as light. \`crop\` is the part of it that is shown: left, top, width, height. */
export const kDevelop = `${kHead}${kFilm}in vec2 at;
uniform sampler2D picture;
uniform vec4 crop;
out vec4 colour;
void main() { colour = vec4(lightOf(texture(picture, crop.xy + crop.zw * at).rgb), 1.0); }`;

/** The frame's part of a panorama. */
export const kAhead = `${kHead}in vec2 at;
uniform sampler2D panorama;
uniform vec2 tangent;
out vec4 colour;
void main() {
    vec3 d = normalize(vec3((2.0 * at.x - 1.0) * tangent.x, 1.0, (2.0 * at.y - 1.0) * tangent.y));
    colour = vec4(textureLod(panorama, vec2(0.5 + atan(d.x, d.y) / 6.2831853, acos(d.z) / 3.14159265), 0.0).rgb, 1.0);
}`;

/** A lens out of focus: the mean over a disc. Textures have their upper edge first. */
export const kDefocus = `${kHead}in vec2 at;
uniform sampler2D sharp;
uniform vec2 radius;  // of the picture
out vec4 colour;
void main() {
    vec2 p = vec2(at.x, at.y);
    vec2 size = vec2(textureSize(sharp, 0));
    float level = max(log2(radius.x * size.x / 5.0), 0.0);
    vec3 sum = textureLod(sharp, p, level).rgb;
    for (int k = 1; k < 72; ++k) {
        float r = sqrt(float(k) / 71.5), a = 2.39996 * float(k);
        sum += textureLod(sharp, p + r * radius * vec2(cos(a), sin(a)), level).rgb;
    }
    colour = vec4(sum / 72.0, 1.0);
}`;

/** Halves a picture, with a soft filter, for the glow. */
export const kHalve = `${kHead}in vec2 at;
uniform sampler2D from;
uniform float most;
out vec4 colour;
void main() {
    vec2 t = 1.0 / vec2(textureSize(from, 0));
    vec3 sum = 4.0 * min(texture(from, at).rgb, most);
    for (int k = 0; k < 4; ++k) {
        sum += min(texture(from, at + t * vec2(k % 2 == 0 ? -1.0 : 1.0, k < 2 ? -1.0 : 1.0)).rgb, most);
    }
    colour = vec4(sum / 8.0, 1.0);
}`;

/** Doubles a picture, and adds a share of it to what is there by blending. */
export const kDouble = `${kHead}in vec2 at;
uniform sampler2D from;
uniform float share;
out vec4 colour;
void main() {
    vec2 t = 1.0 / vec2(textureSize(from, 0));
    vec3 sum = vec3(0.0);
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            sum += float((2 - abs(x)) * (2 - abs(y))) * texture(from, at + t * vec2(x, y)).rgb;
        }
    }
    colour = vec4(sum / 16.0, share);
}`;

/** The film: glow of the lens, its falloff to the corners, grain; `glowing` and `falloff` are shares. */
export const kDevelopFrame = `${kHead}${kFilm}in vec2 at;
uniform sampler2D frame;
uniform sampler2D glow;
uniform float time, exposure, glowing, falloff, graininess;
out vec4 colour;
float hashed(vec2 p) {
    vec3 q = fract(vec3(p.xyx) * 0.1031);
    q += dot(q, q.yzx + 33.33);
    return fract((q.x + q.y) * q.z);
}
void main() {
    vec3 light = mix(texture(frame, at).rgb, texture(glow, at).rgb, glowing);
    vec2 off = at - 0.5;
    light *= exposure * (1.0 - falloff * dot(off, off));
    vec3 level = encoded(developed(light));
    float noise = hashed(gl_FragCoord.xy + 61.0 * fract(time)) + hashed(gl_FragCoord.yx + 17.0 + 61.0 * fract(time)) - 1.0;
    colour = vec4(level + graininess * noise * (1.0 - 0.6 * level), 1.0);
}`;

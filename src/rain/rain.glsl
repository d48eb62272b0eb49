// SPDX-License-Identifier: GPL-3.0-or-later
// Water on a windshield, as the driver sees it: a fragment shader for OpenGL 3.3 and WebGL 2 alike. The program puts
// "#version 330 core", or "#version 300 es" and "precision highp float;", before it. It gives light, not levels.
//
// Rays of the eye pass the pane, which does not turn them, and the water on it, and are refracted where they leave it
// (Snell, Fresnel), as DriversView of the library has it. What lies behind is infinitely far away. Bare glass shows a
// picture that fills the frame, sharp or out of focus. Droplets show another one, which may reach farther: a picture,
// which is mirrored at its edges, or a panorama. Mist scatters the light of bare glass.

uniform sampler2D water;    // WindshieldMaps: normal x and y times wetness, thickness in mm, wetness; upper edge first
uniform sampler2D outside;  // what droplets show, sharp, with mipmaps
uniform sampler2D dry;      // what bare glass shows in the frame, with mipmaps
uniform sampler2D mist;     // red: how dense it is, 0 to 1; upper edge first
uniform vec2 mist_edge;     // where its right and upper edges are, over the glass's width and height
uniform sampler2D film;     // red: thickness of the film that runs off, 1 is 0.51 mm; upper edge first
uniform vec2 film_edge;     // as mist_edge
uniform vec2 drift;         // way that small waves have run over the film [m], down positive
uniform sampler2D edge;     // red: distance from the edge of the glass [m]; upper edge first; not read without a border
uniform vec2 glass;         // width and height of the glass [m]
uniform vec3 eye;           // in the vehicle's frame: x right, y ahead, z up [m]
uniform vec2 tangent;       // of half the angle of the frame, across and up
uniform vec2 wide;          // the same of `outside`; 0: it is a panorama, its middle straight ahead
uniform float rim;          // sine of the contact angle, 1 beyond a right angle
uniform float blur;         // of bare glass, as a mipmap level of `dry`
uniform vec3 cabin;         // light that total reflection shows
uniform float border;       // width of the black border of the glass [m]; 0: none

in vec3 place;   // on the glass, in the vehicle's frame [m]
in vec3 normal;  // outward
in vec3 across;  // unit tangents along the map's x, and up the glass
in vec3 up;
in vec2 uv;  // in the map, from the upper left

out vec4 colour;

const float kIor = 1.333;                    // of water
const vec3 kPane = vec3(0.97, 0.985, 0.98);  // what the glass lets pass
const float kPi = 3.14159265;

// Where the frame shows a direction.
vec2 frameOf(vec3 direction)
{
    vec2 s = direction.xz / (max(direction.y, 1e-4) * tangent);
    return vec2(0.5 + 0.5 * s.x, 0.5 - 0.5 * s.y);
}

// Where `outside` shows a direction. A picture is mirrored at its edges, its middle again at a right angle.
vec2 outsideOf(vec3 direction)
{
    if (wide.x == 0.0) {
        return vec2(0.5 + atan(direction.x, direction.y) / (2.0 * kPi), acos(clamp(direction.z, -1.0, 1.0)) / kPi);
    }
    vec2 s = direction.xz / (max(abs(direction.y), 1e-4) * wide);
    vec2 inside = mix(s, sign(s) / max(abs(s), 1e-4), step(1.0, abs(s)));
    return vec2(0.5 + 0.5 * inside.x, 0.5 - 0.5 * inside.y);
}

// Pixels of `outside` for a change of direction straight ahead.
vec2 scaleOfOutside()
{
    vec2 size = vec2(textureSize(outside, 0));
    return wide.x == 0.0 ? size / vec2(2.0 * kPi, kPi) : size / (2.0 * wide);
}

// A mipmap level of a texture between its pixels by cubic splines: four places that the texture unit interpolates.
vec3 smoothly(sampler2D from, vec2 at, float level)
{
    vec2 size = max(vec2(textureSize(from, 0)) * exp2(-level), 1.0);
    vec2 p = at * size - 0.5;
    vec2 f = fract(p);
    vec2 f2 = f * f;
    vec2 f3 = f2 * f;
    vec2 w0 = (1.0 - 3.0 * f + 3.0 * f2 - f3) / 6.0;
    vec2 w1 = (4.0 - 6.0 * f2 + 3.0 * f3) / 6.0;
    vec2 w3 = f3 / 6.0;
    vec2 w2 = 1.0 - w0 - w1 - w3;
    vec2 low = w0 + w1;
    vec2 a = (p - f - 0.5 + w1 / low) / size;
    vec2 b = (p - f + 1.5 + w3 / (1.0 - low)) / size;
    return mix(mix(textureLod(from, b, level).rgb, textureLod(from, vec2(a.x, b.y), level).rgb, low.x),
               mix(textureLod(from, vec2(b.x, a.y), level).rgb, textureLod(from, a, level).rgb, low.x), low.y);
}

// A number from 0 to 1 for every place of a grid.
float hashed(vec2 cell)
{
    vec3 p = fract(vec3(cell.xyx) * 0.1031);
    p += dot(p, p.yzx + 33.33);
    return fract((p.x + p.y) * p.z);
}

// A number from 0 to 1, smooth from place to place.
float noise(vec2 p)
{
    vec2 cell = floor(p);
    vec2 f = smoothstep(0.0, 1.0, p - cell);
    return mix(mix(hashed(cell), hashed(cell + vec2(1.0, 0.0)), f.x),
               mix(hashed(cell + vec2(0.0, 1.0)), hashed(cell + 1.0), f.x), f.y);
}

// The film at a position on the glass [m], from the upper left: its thickness with the waves on it [mm], and how far it is from
// its rim, which is at 0. Its rims are where it is thin, and irregular; what its texture has is far coarser.
vec2 filmAt(vec2 position)
{
    vec2 at = position / glass;
    float mean = 0.51 * smoothly(film, vec2(at.x / film_edge.x, 1.0 - (1.0 - at.y) / film_edge.y), 0.0).r;
    if (mean < 2e-3) {
        return vec2(0.0, -1.0);
    }
    // Grids in different directions hide one another.
    const mat2 kLeft = mat2(0.8, 0.6, -0.6, 0.8);
    const mat2 kRight = mat2(0.6, -0.8, 0.8, 0.6);
    float waves = noise(kLeft * ((position - 0.5 * drift) / vec2(5e-3, 10e-3))) +
        0.6 * noise(kRight * ((position - drift) / vec2(2.9e-3, 4.8e-3))) - 0.8;
    float lies = mean / 0.05 + 0.9 * noise(kLeft * position / 5e-3) + 0.5 * noise(kRight * position / 1.7e-3) - 1.25;
    return vec2(mean * (1.0 + 0.8 * waves) * smoothstep(0.0, 0.8, lies), lies);
}

// Grain of the mist, whose droplets differ from place to place: 0 to 1, smooth over half a millimetre and coarser.
float grain(vec2 position)
{
    float sum = 0.0;
    float part = 0.5;
    vec2 p = position / 6e-4;
    for (int k = 0; k < 3; ++k) {
        sum += part * noise(p);
        part *= 0.6;
        p /= 3.7;
    }
    return sum;
}

// Light of the glass beside the droplets.
vec3 bareLight(vec2 at)
{
    vec3 clear = textureLod(dry, at, blur).rgb;
    float dense = texture(mist, vec2(uv.x / mist_edge.x, 1.0 - (1.0 - uv.y) / mist_edge.y)).r;
    if (dense <= 0.0) {
        return clear;
    }
    // Thin mist is patchy; dense mist is even. Most light goes nearly straight on: a glow around lamps, and a veil of all
    // that is bright.
    float share = 1.0 - pow(1.0 - clamp(dense * (1.0 + 0.9 * (grain(uv * glass) - 0.5) * (1.2 - dense)), 0.0, 1.0), 2.2);
    float level = log2(float(textureSize(dry, 0).x)) - 4.0;
    vec3 glow = 0.34 * smoothly(dry, at, level - 2.2) + 0.36 * smoothly(dry, at, level - 0.6) + 0.30 * smoothly(dry, at, level + 1.2);
    vec3 veil = smoothly(dry, at, level + 3.0);
    return mix(clear, 0.86 * glow + 0.16 * veil + 0.05 * dot(veil, vec3(0.3, 0.6, 0.1)), 0.96 * share);
}

void main()
{
    vec4 wet = texture(water, uv);
    // The outline of a droplet is sharp, however coarse the map: of several ramps, these are nearest to the ray-traced view.
    float cover = smoothstep(0.17, 0.6, wet.a);
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
    // A pixel at the outline has the mean of its water. At the contact line it is as steep as the contact angle, and reflects
    // totally where the eye looks into the slope: the dark rim that droplets have.
    slope = mix(slope, rim * slope / max(length(slope), 1e-3), 1.0 - smoothstep(0.2, 0.9, leaves.a));
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
    // What a droplet shows is small: the level follows from how far neighbours look apart.
    vec2 pixels = scaleOfOutside();
    float apart = max(length(dFdx(direction.xz) * pixels), length(dFdy(direction.xz) * pixels));
    vec3 seen = mix(cabin, textureLod(outside, outsideOf(direction), clamp(log2(max(apart, 1.0)), 0.0, 7.0)).rgb, passes);
    vec3 bare = bareLight(frameOf(ray));
    vec2 position = uv * glass;
    vec2 there = filmAt(position);
    if (there.y > 0.0) {
        // Thin films displace what lies behind them.
        const float kStep = 4e-4;  // [m]
        vec2 right = filmAt(position + vec2(kStep, 0.0));
        vec2 below = filmAt(position + vec2(0.0, kStep));
        vec2 rises = vec2(right.x - there.x, there.x - below.x) * 1e-3 / kStep;
        vec3 out_of = refract(inside, -normalize(vec3(-rises, 1.0)), kIor);
        vec3 behind = out_of.x * across + out_of.y * up + out_of.z * n;
        float rim_width = max(length(vec2(right.y, below.y) - there.y) / kStep * length(fwidth(position)), 0.05);
        bare = mix(bare, bareLight(frameOf(behind)), clamp(there.y / rim_width, 0.0, 1.0));
    }
    vec3 light = mix(bare, seen, cover) * kPane;
    // The border is printed in black, and ends in dots.
    float inward = texture(edge, uv).r;
    if (border > 0.0 && inward < 1.6 * border) {
        vec2 dot_place = fract(uv * glass / 4e-3) - 0.5;
        float size = 0.62 * (1.6 - inward / border) / 0.6;
        float printed = inward < border ? 1.0 : 1.0 - smoothstep(size - 0.12, size + 0.12, length(dot_place));
        light = mix(light, vec3(0.004), printed);
    }
    colour = vec4(light, 1.0);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// The glass of a windshield, as the driver sees it: a vertex shader for rain.glsl, with the same words before it. The eye
// looks straight ahead.

uniform vec3 eye;
uniform vec2 tangent;
layout(location = 0) in vec3 at;
layout(location = 1) in vec3 facing;
layout(location = 2) in vec3 right;
layout(location = 3) in vec3 upward;
layout(location = 4) in vec2 map;
out vec3 place;
out vec3 normal;
out vec3 across;
out vec3 up;
out vec2 uv;
void main()
{
    place = at;
    normal = facing;
    across = right;
    up = upward;
    uv = map;
    vec3 from = at - eye;
    gl_Position = vec4(from.xz / tangent, 0.0, from.y);
}

// SPDX-License-Identifier: MIT
// Draws a windshield by WebGL 2: what lies behind it, the water, the mist, wipers and the car's dark parts, and the film.
import { Edge } from './edge.js';
import glass from './glass.glsl';
import rain from './rain.glsl';
import { Road, kNumbers } from './road.js';
import {
    kAhead, kDefocus, kDevelop, kDevelopFrame, kDouble, kDry, kFilmLeft, kHalve, kLights, kPaint, kPart, kPushed, kScenery, kShine, kSweep, kSwept,
    kWhole, shaderOf,
} from './shaders.js';
import { Sweeps } from './sweeps.js';

const kEdgeMap = 512;  // width of the map of distances from the edge [px]
const kEdgeReach = 0.06;  // farthest of these distances, beyond the dots of the border [m]
const kFieldOfView = Math.PI / 4;
/** Tangents that droplets of the street show, up to 60 degrees aside. */
const kWide = [1.75, 1.0];
const kStreetMap = [1024, 576];
const kPanoramaMap = [2048, 1024];
/** What lens and film do to a frame, by eye. Pictures have grain of their own. */
const kLens = { glowing: 0.11, falloff: 0.42 };
const kFilmLasts = 0.75;      // behind a blade [s]
const kFilmMap = 1024;        // width of the map of films [px]
const kBladeHalf = 0.0045;    // half its width, as in the ray-traced view [m]
const kBarEnd = [0, 0.002, 0.006, 0.015, 0.04];  // shares of a blade or arm at which its parts begin, near an end ...
const kBarParts = 12;                           // ... and so many between
const kBesideGlass = 0.03;    // how far they are seen beside the glass [m]
const kPushedReach = 0.024;   // of pushed water from the middle of a blade [m]
const kStrip = 24;            // parts of its mesh along the blade
const kGrain = { street: 0.014, picture: 0.008 };

class Program {
    constructor(gl, vertex, fragment) {
        this.gl = gl;
        const program = gl.createProgram();
        for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
            const shader = gl.createShader(kind);
            gl.shaderSource(shader, text);
            gl.compileShader(shader);
            gl.attachShader(program, shader);
            this.log = gl.getShaderInfoLog(shader);
            if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) {
                throw new Error(this.log);
            }
        }
        gl.linkProgram(program);
        if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
            throw new Error(gl.getProgramInfoLog(program));
        }
        this.program = program;
        this.places = new Map();
    }

    /** Uses the program with these values: numbers, lists of numbers, or textures, which take the units in their order. */
    use(values) {
        const { gl } = this;
        gl.useProgram(this.program);
        let unit = 0;
        for (const [name, value] of Object.entries(values)) {
            if (!this.places.has(name)) {
                this.places.set(name, gl.getUniformLocation(this.program, name));
            }
            const at = this.places.get(name);
            if (typeof value === 'number') {
                gl.uniform1f(at, value);
            } else if (value instanceof WebGLTexture) {
                gl.activeTexture(gl.TEXTURE0 + unit);
                gl.bindTexture(gl.TEXTURE_2D, value);
                gl.uniform1i(at, unit++);
            } else {
                gl[`uniform${value.length}fv`](at, value);
            }
        }
    }
}

/** Where a picture covers a frame of an aspect: left, top, width and height of the part that is shown. */
function covering(width, height, aspect) {
    const part = Math.min(width / height / aspect, aspect * height / width);
    return width / height > aspect ? [0.5 - 0.5 * part, 0, part, 1] : [0, 0.5 - 0.5 * part, 1, part];
}

export class View {
    #gl;
    #programs;
    #road = new Road();
    #targets = new Map();
    #water;
    #mist;
    #runoff;
    #edge;
    #edge_map;
    #picture;      // a picture, video or panorama: {texture, width, height, video, panorama}
    #is_stale = true;  // whether what lies behind must be drawn anew, though it does not move
    #pane;
    #parts;
    #lights;
    #swept;
    #strip;
    #sweeps;
    #drawn_with = '';

    constructor(canvas) {
        const gl = canvas.getContext('webgl2', { alpha: false, antialias: false, depth: false, powerPreference: 'high-performance' });
        if (!gl) {
            throw new Error('this browser has no WebGL 2');
        }
        this.canvas = canvas;
        this.#gl = gl;
        this.#deep = Boolean(gl.getExtension('EXT_color_buffer_float') ?? gl.getExtension('EXT_color_buffer_half_float'));
        this.#programs = Object.fromEntries(Object.entries({
            rain: [shaderOf(glass), shaderOf(rain)], part: [kPart, kPaint], scenery: [kWhole, kScenery], lights: [kLights, kShine],
            develop: [kWhole, kDevelop], ahead: [kWhole, kAhead], defocus: [kWhole, kDefocus], halve: [kWhole, kHalve],
            double: [kWhole, kDouble], film: [kWhole, kDevelopFrame], sweep: [kSweep, kSwept], dry: [kWhole, kDry],
            left: [shaderOf(glass), kFilmLeft], pushed: [shaderOf(glass), kPushed],
        }).map(([name, [vertex, fragment]]) => [name, new Program(gl, vertex, fragment)]));
        this.#empty = gl.createVertexArray();
        this.#pane = this.#mesh([3, 3, 3, 3, 2]);
        this.#parts = this.#mesh([3, 2, 4]);
        this.#swept = this.#mesh([2, 4]);
        this.#strip = this.#mesh([3, 3, 3, 3, 2]);
        this.#lights = this.#mesh([2], new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]));
        this.#lights.numbers = gl.createBuffer();
        gl.bindBuffer(gl.ARRAY_BUFFER, this.#lights.numbers);
        for (const k of [0, 1]) {
            gl.enableVertexAttribArray(k + 1);
            gl.vertexAttribPointer(k + 1, 4, gl.FLOAT, false, 4 * kNumbers, 16 * k);
            gl.vertexAttribDivisor(k + 1, 1);
        }
        gl.bindVertexArray(null);
        this.#water = this.#texture(gl.LINEAR);
        this.#mist = this.#texture(gl.LINEAR);
        this.#runoff = this.#texture(gl.LINEAR);
        this.#edge_map = this.#texture(gl.LINEAR);
        gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    }

    #deep;
    #empty;

    /** Gives the graphics' memory back. */
    close() {
        this.#gl.getExtension('WEBGL_lose_context')?.loseContext();
    }

    /** Attributes of these sizes, one after another. */
    #mesh(sizes, numbers) {
        const gl = this.#gl;
        const mesh = { array: gl.createVertexArray(), buffer: gl.createBuffer(), stride: sizes.reduce((a, b) => a + b), count: 0 };
        gl.bindVertexArray(mesh.array);
        gl.bindBuffer(gl.ARRAY_BUFFER, mesh.buffer);
        let offset = 0;
        sizes.forEach((size, k) => {
            gl.enableVertexAttribArray(k);
            gl.vertexAttribPointer(k, size, gl.FLOAT, false, 4 * mesh.stride, 4 * offset);
            offset += size;
        });
        if (numbers) {
            gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.STATIC_DRAW);
        }
        return mesh;
    }

    #fill(mesh, numbers) {
        const gl = this.#gl;
        gl.bindBuffer(gl.ARRAY_BUFFER, mesh.buffer);
        gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(numbers), gl.DYNAMIC_DRAW);
        mesh.count = numbers.length / mesh.stride;
    }

    #texture(filter) {
        const gl = this.#gl;
        const texture = gl.createTexture();
        gl.activeTexture(gl.TEXTURE0);
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, filter);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
        return texture;
    }

    /** A texture that is drawn on; made anew if its size changes. */
    #target(name, width, height) {
        const gl = this.#gl;
        let target = this.#targets.get(name);
        if (!target) {
            target = { texture: this.#texture(gl.LINEAR_MIPMAP_LINEAR), frame: gl.createFramebuffer(), width: 0, height: 0 };
            this.#targets.set(name, target);
        }
        if (target.width !== width || target.height !== height) {
            Object.assign(target, { width, height });
            gl.activeTexture(gl.TEXTURE0);
            gl.bindTexture(gl.TEXTURE_2D, target.texture);
            const mipmapped = ['outside', 'dry', 'sharp'].includes(name);
            gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, mipmapped ? gl.LINEAR_MIPMAP_LINEAR : gl.LINEAR);
            gl.texImage2D(gl.TEXTURE_2D, 0, this.#deep ? gl.RGBA16F : gl.RGBA8, width, height, 0, gl.RGBA,
                this.#deep ? gl.HALF_FLOAT : gl.UNSIGNED_BYTE, null);
            if (mipmapped) {
                gl.generateMipmap(gl.TEXTURE_2D);
            }
            gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
            gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target.texture, 0);
        }
        return target;
    }

    #onto({ frame = null, width, height }) {
        const gl = this.#gl;
        gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
        gl.viewport(0, 0, width, height);
    }

    /** Draws everywhere. */
    #whole(target, program, values) {
        const gl = this.#gl;
        this.#onto(target);
        this.#programs[program].use(values);
        gl.bindVertexArray(this.#empty);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
    }

    #mipmap({ texture }) {
        const gl = this.#gl;
        gl.activeTexture(gl.TEXTURE0);
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.generateMipmap(gl.TEXTURE_2D);
    }

    /** Takes a windshield: the triangles of its glass, and their edge. */
    setGlass(windshield) {
        const gl = this.#gl;
        const { width, height } = windshield.figures();
        this.glass = [width, height];
        const triangles = windshield.triangles();
        this.#fill(this.#pane, triangles.flat().flatMap((corner) => this.#vertex(corner)));
        this.#edge = new Edge(triangles);
        const size = [kEdgeMap, Math.max(Math.round(kEdgeMap * height / width), 1)];
        gl.activeTexture(gl.TEXTURE0);
        gl.bindTexture(gl.TEXTURE_2D, this.#edge_map);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.R16F, ...size, 0, gl.RED, gl.FLOAT, this.#edge.distances(this.glass, size, kEdgeReach));
        this.middle = this.#placed(windshield, 0.5 * width, 0.5 * height).point;
        this.foot = this.#placed(windshield, 0.5 * width, 0).point;
        this.#drawn_with = '';
        this.#sweeps = new Sweeps(kFilmLasts);
    }

    /** The position on the glass that is nearest to a position, and its place. */
    #placed(windshield, x, y) {
        try {
            return { x, y, ...windshield.place(x, y) };
        } catch {  // there is no glass
            return this.#edge.nearest(x, y);
        }
    }

    /** Point in space of a position, which may be beside the glass. */
    #pointOf(windshield, x, y) {
        const at = this.#placed(windshield, x, y);
        return { ...at, point: at.point.map((value, k) => value + (x - at.x) * at.across[k] + (y - at.y) * at.up[k]) };
    }

    #vertex({ x, y, point, normal, across, up }) {
        return [...point, ...normal, ...across, ...up, x / this.glass[0], 1 - y / this.glass[1]];
    }

    /** Shows a picture, a video or a panorama behind the glass; nothing: the street. */
    setPicture(source, { panorama = false } = {}) {
        const gl = this.#gl;
        if (this.#picture) {
            gl.deleteTexture(this.#picture.texture);
        }
        this.#picture = undefined;
        this.#is_stale = true;
        if (!source) {
            return;
        }
        const is_video = source instanceof HTMLVideoElement;
        this.#picture = {
            source, panorama, is_video, texture: this.#texture(gl.LINEAR_MIPMAP_LINEAR),
            width: is_video ? source.videoWidth : source.width, height: is_video ? source.videoHeight : source.height,
        };
        this.#upload();
    }

    #upload() {
        const gl = this.#gl;
        const { source, texture } = this.#picture;
        gl.activeTexture(gl.TEXTURE0);
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, gl.RGBA, gl.UNSIGNED_BYTE, source);
        gl.generateMipmap(gl.TEXTURE_2D);
    }

    /** Eye and angles of a frame; the field of view is that of a frame of 16:9 that the frame covers. */
    #cameraOf({ distance, fieldOfView = kFieldOfView, height = 0 }) {
        const aspect = this.canvas.width / this.canvas.height;
        const reference = Math.tan(0.5 * fieldOfView);
        const tangent = aspect > 16 / 9 ? [reference, reference / aspect] : [reference * 9 / 16 * aspect, reference * 9 / 16];
        const [x, y, z] = this.middle;
        return { tangent, eye: [x, y - distance, z + height] };
    }

    /** Place of the frame where a place in space is seen, from the middle: −1 to 1 to the right and up. */
    seen([x, y, z], camera) {
        const { eye, tangent } = this.#cameraOf(camera);
        const ahead = y - eye[1];
        return [(x - eye[0]) / ahead / tangent[0], (z - eye[2]) / ahead / tangent[1]];
    }

    /** Position on the glass [m] that is seen at a place of the frame. Newton's method: the glass is nearly flat. */
    onGlass(right, up, windshield, camera) {
        const [width, height] = this.glass;
        let [x, y] = [0.5 * width, 0.5 * height];
        const missed = (u, v) => this.seen(this.#pointOf(windshield, u, v).point, camera);
        const kStep = 1e-3;
        for (let k = 0; k < 8; ++k) {
            ({ x, y } = this.#placed(windshield, x, y));
            const [a, b] = missed(x, y);
            const [ax, bx] = missed(x + kStep, y);
            const [ay, by] = missed(x, y + kStep);
            const [j11, j12, j21, j22] = [(ax - a) / kStep, (ay - a) / kStep, (bx - b) / kStep, (by - b) / kStep];
            const d = j11 * j22 - j12 * j21;
            if (!d) {
                break;
            }
            x += ((right - a) * j22 - (up - b) * j12) / d;
            y += ((up - b) * j11 - (right - a) * j21) / d;
        }
        return this.#placed(windshield, x, y);
    }

    /** Uploads what has changed of the water; neighbours of a row go together, as calls are slow. */
    setWater({ width, height, tiles, pixels }) {
        const gl = this.#gl;
        gl.activeTexture(gl.TEXTURE0);
        gl.bindTexture(gl.TEXTURE_2D, this.#water);
        const size = `${width}x${height}`;
        if (this.#drawn_with !== size) {
            this.#drawn_with = size;
            gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA16F, width, height, 0, gl.RGBA, gl.HALF_FLOAT, pixels);
            return;
        }
        const kGap = 96;  // [px] of what has not changed, which are cheaper than a call
        gl.pixelStorei(gl.UNPACK_ROW_LENGTH, width);
        for (let k = 0; k < tiles.length;) {
            const { x, y, height: rows } = tiles[k];
            let end = x;
            for (; k < tiles.length && tiles[k].y === y && tiles[k].x <= end + kGap; ++k) {
                end = tiles[k].x + tiles[k].width;
            }
            gl.texSubImage2D(gl.TEXTURE_2D, 0, x, y, end - x, rows, gl.RGBA, gl.HALF_FLOAT, pixels, 4 * (y * width + x));
        }
        gl.pixelStorei(gl.UNPACK_ROW_LENGTH, 0);
    }

    setMist(map) {
        this.mist_edge = this.#setCells(this.#mist, map);
    }

    setRunoff(map) {
        this.film_edge = this.#setCells(this.#runoff, map);
        this.drift = [map.drift.x, -map.drift.y];
    }

    #setCells(texture, { width, height, right, top, pixels }) {
        const gl = this.#gl;
        gl.activeTexture(gl.TEXTURE0);
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.R8, width, height, 0, gl.RED, gl.UNSIGNED_BYTE, pixels);
        return [right, top];
    }

    /** What lies behind: `outside`, which droplets show, and `dry`, which bare glass shows. */
    #drawOutside({ travelled, time, blur }, tangent) {
        const spread = 0.5 * blur;  // of the disc, as a tangent
        const width = Math.min(1280, this.canvas.width);
        const height = Math.max(Math.round(width * tangent[1] / tangent[0]), 1);
        const before = this.#targets.get('dry');
        const is_resized = before?.width !== width || before?.height !== height;
        if (this.#picture) {
            if (!this.#picture.is_video && !this.#is_stale && !is_resized && this.#blurred === blur) {
                return this.#picture.panorama ? [0, 0] : tangent;
            }
            return this.#drawPicture(spread, width, height, tangent);
        }
        const gl = this.#gl;
        const numbers = this.#road.at(travelled, time);
        const street = (target, wide, out_of_focus) => {
            const flipped = [wide[0], -wide[1]];  // upper edge first
            this.#whole(target, 'scenery', { wide: flipped, spread: Math.max(out_of_focus, 0.002), travelled: travelled % 18 });
            gl.enable(gl.BLEND);
            gl.blendFunc(gl.ONE, gl.ONE);
            this.#programs.lights.use({ wide: flipped, spread: out_of_focus, least: 1.1 * wide[0] / target.width });
            gl.bindVertexArray(this.#lights.array);
            gl.bindBuffer(gl.ARRAY_BUFFER, this.#lights.numbers);
            gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.STREAM_DRAW);
            gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, numbers.length / kNumbers);
            gl.disable(gl.BLEND);
            this.#mipmap(target);
        };
        street(this.#target('outside', ...kStreetMap), kWide, 0);
        street(this.#target('dry', width, height), tangent, spread);
        return kWide;
    }

    #blurred = 0;

    #drawPicture(spread, width, height, tangent) {
        const { panorama, texture, is_video, width: own_width, height: own_height } = this.#picture;
        if (is_video) {
            this.#upload();
        }
        let sharp;
        if (panorama) {
            const outside = this.#target('outside', ...kPanoramaMap);
            this.#whole(outside, 'develop', { picture: texture, crop: [0, 0, 1, 1] });
            this.#mipmap(outside);
            sharp = this.#target('sharp', width, height);
            this.#whole(sharp, 'ahead', { panorama: outside.texture, tangent: [tangent[0], -tangent[1]] });
        } else {
            sharp = this.#target('outside', width, height);
            this.#whole(sharp, 'develop', { picture: texture, crop: covering(own_width, own_height, tangent[0] / tangent[1]) });
        }
        this.#mipmap(sharp);
        const dry = this.#target('dry', width, height);
        this.#whole(dry, 'defocus', { sharp: sharp.texture, radius: [0.5 * spread / tangent[0], 0.5 * spread / tangent[1]] });
        this.#mipmap(dry);
        this.#is_stale = false;
        this.#blurred = 2 * spread;
        return panorama ? [0, 0] : tangent;
    }

    /** Width of a bar over that in its middle, which is slimmer towards its ends, and round there. */
    #taper(share, length, half) {
        const end = Math.min(share, 1 - share);
        const slim = Math.min(end / 0.4, 1);
        const round = Math.max(1 - end * length / (1.5 * half), 0);
        return (0.55 + 0.45 * slim * slim * (3 - 2 * slim)) * Math.sqrt(1 - round * round);
    }

    /** Vertices of a flat bar between two positions, some way above the glass; what is beside it is behind the pillars. */
    #bar(numbers, windshield, from, to, half, paint, above = 0.004) {
        const away = Math.hypot(to.x - from.x, to.y - from.y) || 1;
        const side = { x: -half * (to.y - from.y) / away, y: half * (to.x - from.x) / away };
        const at = (share) => ({ x: from.x + share * (to.x - from.x), y: from.y + share * (to.y - from.y) });
        const corner = (share, across) => {
            const { x, y } = at(share);
            const wide = across * this.#taper(share, away, half);
            const { point, normal } = this.#pointOf(windshield, x + wide * side.x, y + wide * side.y);
            return [...point.map((value, k) => value + above * normal[k]), 2 * share - 1, across, ...paint];
        };
        const inner = Array.from({ length: kBarParts - 1 }, (_, k) => (k + 1) / kBarParts);
        const shares = [...kBarEnd, ...inner, ...kBarEnd.map((share) => 1 - share).reverse()];
        for (let k = 0; k + 1 < shares.length; ++k) {
            const { x, y } = at(0.5 * (shares[k] + shares[k + 1]));
            const near = this.#placed(windshield, x, y);
            if (Math.hypot(near.x - x, near.y - y) < kBesideGlass) {
                const [begin, end] = [shares[k], shares[k + 1]];
                const [a, b, c, d] = [corner(begin, -1), corner(end, -1), corner(end, 1), corner(begin, 1)];
                numbers.push(...a, ...b, ...c, ...a, ...c, ...d);
            }
        }
    }

    /** Films that blades have left on the glass. */
    #drawFilms(windshield, time, camera, shown) {
        if (!this.#deep) {
            return;
        }
        const gl = this.#gl;
        const [width, height] = this.glass;
        const films = this.#target('films', kFilmMap, Math.max(Math.round(kFilmMap * height / width), 1));
        const { begins, lost, numbers, is_wet } = this.#sweeps.follow(windshield.blades(), time);
        if (begins) {
            this.#onto(films);
            gl.clearColor(0, 0, 0, 0);
            gl.clear(gl.COLOR_BUFFER_BIT);
        }
        if (lost > 0) {
            gl.enable(gl.BLEND);
            gl.blendEquation(gl.FUNC_REVERSE_SUBTRACT);
            gl.blendFunc(gl.ONE, gl.ONE);
            this.#whole(films, 'dry', { lost });
            gl.blendEquation(gl.FUNC_ADD);
            gl.disable(gl.BLEND);
        }
        if (numbers.length > 0) {
            this.#onto(films);
            this.#programs.sweep.use({ glass: this.glass });
            this.#fill(this.#swept, numbers);
            gl.bindVertexArray(this.#swept.array);
            gl.drawArrays(gl.TRIANGLES, 0, this.#swept.count);
        }
        if (is_wet) {
            this.#onto(this.#targets.get('frame'));
            gl.enable(gl.BLEND);
            gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE);
            this.#programs.left.use({ ...camera, ...shown, left: films.texture, water: this.#water, edge: this.#edge_map, glass: this.glass, lasts: kFilmLasts });
            gl.bindVertexArray(this.#pane.array);
            gl.drawArrays(gl.TRIANGLES, 0, this.#pane.count);
            gl.disable(gl.BLEND);
        }
    }

    /** Water that blades push ahead, and what is left of it where they have turned. */
    #drawPushed(windshield, values) {
        const gl = this.#gl;
        const blades = windshield.blades();
        for (const { blade, angle, side, pushed, drained, seed } of this.#sweeps.beads()) {
            const { inner, outer, pivot } = blades[blade] ?? {};
            if (!pivot) {
                continue;
            }
            const reachOf = (one) => [one.inner, one.outer].map(({ x, y }) => Math.hypot(x - one.pivot.x, y - one.pivot.y));
            const reach = reachOf({ inner, outer, pivot });
            const along = [Math.cos(angle), Math.sin(angle)];
            const ahead = [-side * along[1], side * along[0]];
            const numbers = [];
            const corner = (far, aside) => this.#vertex(this.#placed(windshield,
                pivot.x + far * along[0] + aside * ahead[0], pivot.y + far * along[1] + aside * ahead[1]));
            for (let k = 0; k < kStrip; ++k) {
                const [from, to] = [k, k + 1].map((i) => reach[0] + (reach[1] - reach[0]) * i / kStrip);
                const [a, b, c, d] = [corner(from, 0), corner(to, 0), corner(to, kPushedReach), corner(from, kPushedReach)];
                numbers.push(...a, ...b, ...c, ...a, ...c, ...d);
            }
            const other = blades.find((_, k) => k !== blade);
            this.#programs.pushed.use({
                ...values, edge: this.#edge_map, glass: this.glass, pivot: [pivot.x, pivot.y], along, ahead, reach, begins: kBladeHalf, pushed, drained, seed,
                other_pivot: other ? [other.pivot.x, other.pivot.y] : [0, 0], other_reach: other ? reachOf(other) : [0, 0],
                other_angles: other ? [other.first, other.last] : [0, 1],
            });
            this.#fill(this.#strip, numbers);
            gl.enable(gl.BLEND);
            gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE);
            gl.bindVertexArray(this.#strip.array);
            gl.drawArrays(gl.TRIANGLES, 0, this.#strip.count);
            gl.disable(gl.BLEND);
        }
    }

    /** Wipers, beyond the glass. */
    #drawBlades(windshield, camera) {
        const numbers = [];
        for (const { inner, outer } of windshield.blades()) {
            const along = { x: outer.x - inner.x, y: outer.y - inner.y };
            const at = (share) => ({ x: inner.x + share * along.x, y: inner.y + share * along.y });
            this.#bar(numbers, windshield, at(0), at(1), kBladeHalf, [0.0035, 0.0036, 0.004, 1]);
            this.#bar(numbers, windshield, at(-0.4), at(0.5), 0.006, [0.006, 0.006, 0.007, 1], 0.02);
        }
        this.#drawParts(numbers, camera);
    }

    /** The dashboard, before the glass. */
    #drawDashboard(camera) {
        const half = 0.5 * this.glass[0] + 0.25;
        const foot = this.foot;
        const corner = (x, y, z, v) => [foot[0] + x, foot[1] + y, foot[2] + z, 0, v, 0.010, 0.010, 0.011, 2];
        const [a, b, c, d] = [corner(-half, 0.03, 0.012, 0), corner(half, 0.03, 0.012, 0), corner(half, -0.8, -0.1, 0), corner(-half, -0.8, -0.1, 0)];
        this.#drawParts([...a, ...b, ...c, ...a, ...c, ...d], camera);
    }

    #drawParts(numbers, camera) {
        const gl = this.#gl;
        if (numbers.length === 0) {
            return;
        }
        gl.enable(gl.BLEND);
        gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE);
        this.#programs.part.use(camera);
        this.#fill(this.#parts, numbers);
        gl.bindVertexArray(this.#parts.array);
        gl.drawArrays(gl.TRIANGLES, 0, this.#parts.count);
        gl.disable(gl.BLEND);
    }

    /**
     * Draws a frame.
     * @param windshield  of setGlass()
     * @param shown       travelled [m], time [s], blur [rad], camera, border [m], which is 0 for a pane without a car around it,
     *                    exposure, and `film`, values of the shader that take the place of kLens and kGrain
     */
    draw(windshield, shown) {
        const gl = this.#gl;
        const { width, height } = this.canvas;
        const camera = this.#cameraOf(shown.camera);
        const wide = this.#drawOutside(shown, camera.tangent);
        const [outside, dry] = ['outside', 'dry'].map((name) => this.#targets.get(name).texture);
        const cabin = this.#picture ? [0.03, 0.03, 0.032] : [0.006, 0.006, 0.008];
        const frame = this.#target('frame', width, height);
        this.#onto(frame);
        gl.clearColor(0.0025, 0.0025, 0.003, 1);
        gl.clear(gl.COLOR_BUFFER_BIT);
        this.#programs.rain.use({
            ...camera, water: this.#water, outside, dry, mist: this.#mist, mist_edge: this.mist_edge, film: this.#runoff, film_edge: this.film_edge,
            drift: this.drift, edge: this.#edge_map, glass: this.glass, wide, blur: 0,
            rim: Math.sin(Math.min(windshield.get('contactAngle'), 0.5 * Math.PI)), cabin, border: shown.border,
        });
        gl.bindVertexArray(this.#pane.array);
        gl.drawArrays(gl.TRIANGLES, 0, this.#pane.count);
        this.#drawFilms(windshield, shown.time, camera, { dry, cabin, border: shown.border });
        this.#drawPushed(windshield, { ...camera, outside, wide, cabin, border: shown.border });
        this.#drawBlades(windshield, camera);
        if (shown.border > 0) {
            this.#drawDashboard(camera);
        }
        // The glow of the lens: halved some times, and added up again.
        const levels = [frame];
        for (let k = 1; k <= 6 && Math.min(width, height) >> k > 4; ++k) {
            levels.push(this.#target(`glow${k}`, width >> k, height >> k));
            this.#whole(levels[k], 'halve', { from: levels[k - 1].texture, most: k === 1 ? 12 : 1e4 });
        }
        gl.enable(gl.BLEND);
        gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
        for (let k = levels.length - 1; k > 1; --k) {
            this.#whole(levels[k - 1], 'double', { from: levels[k].texture, share: 0.6 });
        }
        gl.disable(gl.BLEND);
        this.#whole({ width, height }, 'film', {
            frame: frame.texture, glow: levels[1].texture, time: shown.time, exposure: shown.exposure, ...kLens,
            graininess: this.#picture ? kGrain.picture : kGrain.street, ...shown.film,
        });
    }
}

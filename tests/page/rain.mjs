// SPDX-License-Identifier: GPL-3.0-or-later
// Plays a windshield's models in three.js in a real browser:
//
//   node rain.mjs CHROMIUM THREE_FOLDER EXAMPLE NODES_GLB TEXTURE_GLB FRAMES_PER_SECOND FRAME... [--screenshots FOLDER]
//
// Prints one JSON object: draw calls of each model, and for each frame how many pixels show droplets in the first model,
// in the second, and in one of them only.
import { readFileSync, writeFileSync } from 'node:fs';
import { chromium } from 'playwright-core';

const [executablePath, three, example, nodes, texture, rate, ...rest] = process.argv.slice(2);
const folder = rest.includes('--screenshots') ? rest[rest.indexOf('--screenshots') + 1] : undefined;
const frames = rest.slice(0, folder ? -2 : undefined).map(Number);
const files = { '/example.js': example, '/nodes.glb': nodes, '/texture.glb': texture };
const kPage = `<!doctype html><canvas id="view" width="480" height="300"></canvas>
<script type="importmap">{"imports": {"three": "/three/build/three.module.js", "three/addons/": "/three/examples/jsm/"}}</script>`;

/** In the page: shows a model and returns what is needed to play it. */
async function show(file) {
    const { AmbientLight, MeshPhysicalMaterial, OrthographicCamera, Scene, WebGLRenderer } = await import('three');
    const { GLTFLoader } = await import('three/addons/loaders/GLTFLoader.js');
    const { playDroplets } = await import('/example.js');
    const gltf = await new GLTFLoader().loadAsync(file);
    const { show: play } = await playDroplets(gltf);
    gltf.scene.getObjectByName('glass').visible = false;
    const renderer = new WebGLRenderer({ canvas: document.getElementById('view').cloneNode(), preserveDrawingBuffer: true });
    const scene = new Scene();
    scene.add(gltf.scene);
    // Opaque and white, so that every drawn pixel is visible.
    scene.add(new AmbientLight(0xffffff, 3));
    gltf.scene.traverse((object) => {
        if (object.isMesh) {
            const { onBeforeCompile } = object.material;
            object.material = Object.assign(new MeshPhysicalMaterial({ color: 0xffffff }), { onBeforeCompile });
        }
    });
    const camera = new OrthographicCamera(-0.24, 0.24, 0.15, -0.15, 0.01, 10);
    camera.position.set(0, 1.1, 1);
    camera.lookAt(0, 0.1, 0);
    const draw = (seconds) => {
        play(seconds);
        renderer.render(scene, camera);
    };
    window.model = { draw, renderer };
}

/** In the page: which pixels show something at a time. */
function pixels(seconds) {
    const { draw, renderer } = window.model;
    draw(seconds);
    const gl = renderer.getContext();
    const rgba = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
    gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, rgba);
    const shown = [];
    for (let i = 0; i < rgba.length; i += 4) {
        shown.push(rgba[i] > 64 ? 1 : 0);
    }
    return { shown, calls: renderer.info.render.calls, picture: renderer.domElement.toDataURL() };
}

const browser = await chromium.launch({
    executablePath,
    args: ['--headless=new', '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist',
        '--disable-background-networking'],
});
try {
    const seen = { complaints: [], calls: {}, frames: [] };
    const views = {};
    for (const name of ['nodes', 'texture']) {
        const page = await browser.newPage({ viewport: { width: 480, height: 300 } });
        page.on('pageerror', (error) => seen.complaints.push(error.message));
        page.on('console', (message) => {
            if (['error', 'warning'].includes(message.type()) && !/GPU stall|swiftshader|GroupMarkerNotSet/i.test(message.text())) {
                seen.complaints.push(message.text());
            }
        });
        await page.route('**', (route) => {
            const { pathname } = new URL(route.request().url());
            if (pathname === '/') {
                return route.fulfill({ body: kPage, contentType: 'text/html' });
            }
            const path = files[pathname] ?? (pathname.startsWith('/three/') ? three + pathname.slice('/three'.length) : undefined);
            return path ? route.fulfill({ body: readFileSync(path),
                contentType: path.endsWith('.js') ? 'text/javascript' : 'application/octet-stream' }) : route.fulfill({ status: 204 });
        });
        await page.goto('http://droplets.test/');
        await page.evaluate(show, `/${name}.glb`);
        views[name] = [];
        for (const frame of frames) {
            const { shown, calls, picture } = await page.evaluate(pixels, (frame + 0.01) / Number(rate));
            views[name].push(shown);
            seen.calls[name] = Math.max(seen.calls[name] ?? 0, calls);
            if (folder) {
                writeFileSync(`${folder}/${name}-${frame}.png`, Buffer.from(picture.split(',')[1], 'base64'));
            }
        }
        await page.close();
    }
    const sum = (numbers) => numbers.reduce((a, b) => a + b, 0);
    frames.forEach((frame, k) => seen.frames.push({
        nodes: sum(views.nodes[k]), texture: sum(views.texture[k]),
        different: sum(views.nodes[k].map((shown, i) => Math.abs(shown - views.texture[k][i]))),
    }));
    console.log(JSON.stringify(seen));
} finally {
    await browser.close();
}

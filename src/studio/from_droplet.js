// SPDX-License-Identifier: MIT
// The page's droplet as a project: "Edit in Studio".
import { blank, drawShape } from './coverage.js';
import { newProject, withLayer } from './project.js';
import { kLayerFields, kSceneFields, settingsOf } from './physics.js';

const kSide = 1024;  // longer side of a sheet for a droplet that came from no picture [pixels]
const kAmounts = { contact_angle_deg: ['contactAngle', 1], volume_m3: ['volume', 1e9], height_m: ['height', 1e3] };

/** Digits enough for the eye, and none of the noise of a change of units. */
const plain = (value) => Number(value.toPrecision(9));

/** The mask's sides: those of the picture, else a square around the droplet. */
function sheetOf(report, box) {
    const { width_px, height_px, pixel_size_m } = report.input ?? {};
    if (width_px && height_px && pixel_size_m && Math.max(width_px, height_px) <= 4096) {
        return { width: width_px, height: height_px, pixel: pixel_size_m };
    }
    const [width, depth] = [2.2 * Math.max(-box.min.x, box.max.x), 2.2 * Math.max(-box.min.z, box.max.z)];
    const pixel = Math.max(width, depth) / kSide;
    return { width: Math.ceil(width / pixel), height: Math.ceil(depth / pixel), pixel };
}

/** Draws the base of the mesh: triangles that face down, seen from above. */
function footprintOf(meshes, places, { width, height, pixel }) {
    const mask = blank(width, height);
    drawShape(mask, { left: 0, top: 0, right: width, bottom: height }, (canvas) => {
        canvas.beginPath();
        meshes.forEach(({ geometry: { index, attributes: { position } } }, which) => {
            const [m0, , m8] = [places[which].elements[0], 0, places[which].elements[10]];
            const at = (k) => [position.getX(index.getX(k)) * m0, position.getY(index.getX(k)), position.getZ(index.getX(k)) * m8];
            for (let i = 0; i < index.count; i += 3) {
                const [a, b, c] = [at(i), at(i + 1), at(i + 2)];
                const up = (b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2]);
                if (up < 0 && Math.max(a[1], b[1], c[1]) <= 1e-9) {
                    [a, b, c].forEach(([x, , z], k) =>
                        canvas[k === 0 ? 'moveTo' : 'lineTo'](width / 2 + x / pixel, height / 2 + z / pixel));
                    canvas.closePath();
                }
            }
        });
        canvas.fill();
        // The seams of neighbouring triangles, each of which is half covered by either.
        canvas.lineWidth = 0.5;
        canvas.globalCompositeOperation = 'source-over';
    }, false);
    return mask;
}

/**
 * A project of the droplet in a page.
 * @param droplet  from page/model.js
 * @param report   the command's
 */
export function projectFromDroplet(droplet, report, name) {
    const sheet = sheetOf(report, droplet.box([1]));
    const project = newProject({ width: sheet.width, height: sheet.height, name });
    const { liquid = {}, fill = {}, ground = {} } = report;
    const settings = { liquid: liquid.name, fill: fill.sharing, model: { linear: 'linear', exact: 'auto', parametric: 'auto' }[report.model] };
    const [by, factor] = kAmounts[fill.by] ?? [];
    if (by && fill.amount) {
        Object.assign(settings, { by, [by]: plain(fill.amount * factor) });
    }
    const material = droplet.meshes[0]?.material.name;
    settings.material = material === liquid.name ? 'own' : material;
    const known = settingsOf(kLayerFields, settings);
    const scene = settingsOf(kSceneFields, {
        width: plain(sheet.width * sheet.pixel * 1e3), gravity: liquid.gravity_m_per_s2, tilt: liquid.tilt_deg,
        tiltDirection: liquid.tilt_direction_deg,
        ...(['sphere', 'cylinder'].includes(ground.kind) && ground.radius_m ? {
            ground: ground.radius_m > 0 ? ground.kind : { sphere: 'bowl', cylinder: 'gutter' }[ground.kind],
            radius: plain(Math.abs(ground.radius_m) * 1e3), axis: ground.axis_deg === 0 ? 'x' : 'y',
        } : {}),
    });
    return withLayer({ ...project, scene }, { mask: footprintOf(droplet.meshes, droplet.places, sheet), liquid: known });
}

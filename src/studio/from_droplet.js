// SPDX-License-Identifier: MIT
// The page's droplet as a project.
import { Vector3 } from 'three';
import { blank, drawShape, whole } from './coverage.js';
import { kLayerFields, kSceneFields, settingsOf } from './physics.js';
import { newProject, withLayer } from './project.js';

const kSide = 1024;        // longer side of a sheet for a droplet that came from no picture [pixels]
const kLargestSide = 4096;
// Field and unit of what sets the amount.
const kAmounts = { contact_angle_deg: ['contactAngle', 1], volume_m3: ['volume', 1e9], height_m: ['height', 1e3] };
// Surface tension [mN/m] and density [kg/m³], as in src/liquid.cpp.
const kLiquids = {
    water: [72.8, 998.2], ethanol: [22.39, 789.3], glycerol: [63.4, 1261], mercury: [486.5, 13545.9], honey: [55, 1417],
};

/** Digits enough for the eye, and none of the noise of a change of units. */
const plain = (value) => Number(value.toPrecision(9));

/** The mask's sides and its pixel [m]: those of the picture, else of a rectangle around the droplet. */
function sheetOf({ input = {} }, box) {
    const { width_px: width, height_px: height, pixel_size_m: pixel } = input;
    if (width && height && pixel && Math.max(width, height) <= kLargestSide) {
        return { width, height, pixel };
    }
    const sides = [2.2 * Math.max(-box.min.x, box.max.x), 2.2 * Math.max(-box.min.z, box.max.z)];
    const unit = Math.max(...sides) / kSide;
    return { width: Math.ceil(sides[0] / unit), height: Math.ceil(sides[1] / unit), pixel: unit };
}

/** Draws the bases of the meshes, whose triangles face down; of an open mesh, what it covers. */
function footprintOf({ meshes, places }, { width, height, pixel }, flat) {
    const [down, up] = [[], []];
    meshes.forEach(({ geometry: { index, attributes: { position } } }, which) => {
        for (let i = 0; i < index.count; i += 3) {
            const corners = [0, 1, 2].map((k) => new Vector3().fromBufferAttribute(position, index.getX(i + k)).applyMatrix4(places[which]));
            const [a, b, c] = corners;
            const faces_up = (b.z - a.z) * (c.x - a.x) - (b.x - a.x) * (c.z - a.z) > 0;
            if (faces_up) {
                up.push(corners);
            } else if (!flat || Math.max(a.y, b.y, c.y) <= 1e-9) {
                down.push(corners);
            }
        }
    });
    const mask = blank(width, height);
    drawShape(mask, whole(mask), (canvas) => {
        // One path, since triangles that are filled one by one leave seams.
        for (const corners of down.length > 0 ? down : up) {
            corners.forEach(({ x, z }, k) => canvas[k === 0 ? 'moveTo' : 'lineTo'](width / 2 + x / pixel, height / 2 + z / pixel));
            canvas.closePath();
        }
        canvas.fill();
    }, false);
    return mask;
}

function liquidOf({ liquid = {}, fill = {}, model }, look) {
    const settings = { liquid: liquid.name, fill: fill.sharing, model: model === 'linear' ? 'linear' : 'auto' };
    const [by, unit] = kAmounts[fill.by] ?? [];
    if (by && fill.amount) {
        Object.assign(settings, { by, [by]: plain(fill.amount * unit) });
    }
    const { liquid: name } = settingsOf(kLayerFields, settings);
    const own = { surfaceTension: plain(liquid.surface_tension_n_per_m * 1e3), density: plain(liquid.density_kg_per_m3) };
    ['surfaceTension', 'density'].forEach((field, k) => {
        if (own[field] !== kLiquids[name][k]) {
            settings[field] = own[field];
        }
    });
    for (const [field, angle] of [['advancing', liquid.advancing_deg], ['receding', liquid.receding_deg]]) {
        settings[field] = angle ?? '';
    }
    const usual = name === 'mercury' || name === 'honey' ? name : 'water';
    settings.material = look === usual ? 'own' : look;
    return settingsOf(kLayerFields, settings);
}

function sceneOf({ liquid = {}, ground = {} }, { width, pixel }) {
    const scene = {
        width: plain(width * pixel * 1e3), gravity: liquid.gravity_m_per_s2, tilt: liquid.tilt_deg, tiltDirection: liquid.tilt_direction_deg,
    };
    if (ground.radius_m) {
        const hollow = { sphere: 'bowl', cylinder: 'gutter' };
        scene.ground = ground.radius_m > 0 ? ground.kind : hollow[ground.kind];
        scene.radius = plain(Math.abs(ground.radius_m) * 1e3);
        scene.axis = ground.axis_deg ?? 90;
    }
    return settingsOf(kSceneFields, scene);
}

/**
 * A project of the droplet in a page.
 * @param droplet  from page/model.js
 * @param report   the command's
 */
export function projectFromDroplet(droplet, report, name) {
    const sheet = sheetOf(report, droplet.box([1]));
    const flat = (report.ground?.kind ?? 'flat') === 'flat';
    const project = newProject({ width: sheet.width, height: sheet.height, name });
    return withLayer({ ...project, scene: sceneOf(report, sheet) }, {
        mask: footprintOf(droplet, sheet, flat), liquid: liquidOf(report, droplet.meshes[0]?.material.name),
    });
}

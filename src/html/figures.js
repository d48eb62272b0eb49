// SPDX-License-Identifier: MIT
// Formats the report's numbers in readable units.
import { decimal, say } from './words.js';

const kScales = {
    volume: [[1e-15, 'pL'], [1e-12, 'nL'], [1e-9, 'µL'], [1e-6, 'mL'], [1e-3, 'L'], [1, 'm³']],
    length: [[1e-9, 'nm'], [1e-6, 'µm'], [1e-3, 'mm'], [1e-2, 'cm'], [1, 'm']],
    area: [[1e-12, 'µm²'], [1e-6, 'mm²'], [1e-4, 'cm²'], [1, 'm²']],
    energy: [[1e-12, 'pJ'], [1e-9, 'nJ'], [1e-6, 'µJ'], [1e-3, 'mJ'], [1, 'J']],
    force: [[1e-9, 'nN'], [1e-6, 'µN'], [1e-3, 'mN'], [1, 'N']],
};
const kSpace = '\u00a0';

/** Three significant digits, without an exponent if that is short. */
export function digits(value, count = 3) {
    if (value === 0) {
        return '0';
    }
    const size = Math.abs(value);
    if (size >= 1e7 || size < 1e-4) {
        return decimal(value.toExponential(count - 1)).replace('-', '−').replace('e', ' × 10^').replace('^+', '^');
    }
    const places = Math.max(0, count - 1 - Math.floor(Math.log10(size)));
    return decimal(value.toFixed(places)).replace('-', '−');
}

/** The largest unit in which the number is at least one, else the smallest unit. */
function inUnit(kind, value) {
    const scales = kScales[kind];
    // 0.9995 would be printed as 1.00.
    return scales.findLast(([size]) => Math.abs(value) >= 0.9995 * size) ?? scales[0];
}

export function quantity(kind, value) {
    const [size, unit] = value === 0 ? kScales[kind].find(([, name]) => ['µL', 'mm', 'mm²'].includes(name)) ?? [1, ''] :
        inUnit(kind, value);
    return digits(value / size) + kSpace + unit;
}

export const volume = (value) => quantity('volume', value);
/** Lengths up to ten centimetres stay in millimetres, the usual unit for droplets. */
export function length(value) {
    return Math.abs(value) >= 9.995e-3 && Math.abs(value) < 99.95e-3 ? digits(value / 1e-3) + kSpace + 'mm' :
        quantity('length', value);
}
const area = (value) => (Math.abs(value) >= 99.95e-6 && Math.abs(value) < 999.5e-6 ? digits(value / 1e-6) + kSpace + 'mm²' :
    quantity('area', value));
const degrees = (value) => digits(value, value >= 10 ? 2 : 1) + '°';
const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

/** The picture's sides [m]; undefined if the report has none, as for type. */
export function extent(report) {
    const { width_px, height_px, pixel_size_m } = report.input ?? {};
    return width_px && height_px && pixel_size_m ? [width_px * pixel_size_m, height_px * pixel_size_m] : undefined;
}

/** Formats both lengths in the unit of the longer one. */
export function sides([width, height]) {
    const [, unit] = length(Math.max(width, height)).split(kSpace);
    const [size] = kScales.length.find(([, name]) => name === unit);
    return `${digits(width / size)} × ${digits(height / size)}${kSpace}${unit}`;
}

function groundText(ground) {
    if (ground.radius_m !== null) {
        const radius = length(Math.abs(ground.radius_m));
        return say('{ground}, radius {radius}', { ground: say(ground.radius_m < 0 ? `hollow ${ground.kind}` : ground.kind), radius });
    }
    return say(ground.kind);
}

/**
 * The report of the droplet at another fill, in multiples of its volume. A value is null if it neither follows from
 * the report nor is measured on the mesh.
 * @param measured  of the mesh at that fill: height_m, area_m2, contact_angle_deg; null if unknown
 */
export function refilled(report, fill, measured) {
    if (!report.shape || fill === 1) {
        return report;
    }
    const { shape, liquid, ground } = report;
    const times = (value) => (value === null || value === undefined ? null : fill * value);
    // On flat ground without a pull along it, all values are proportional to the volume.
    const proportional = (ground?.kind ?? 'flat') === 'flat' && !liquid?.tilt_deg;
    const driving = times(shape.driving_force_n);
    return {
        ...report,
        shape: {
            ...shape,
            volume_m3: fill * shape.volume_m3,
            height_max_m: measured.height_m,
            contact_angle_deg: measured.contact_angle_deg,
            liquid_area_m2: measured.area_m2,
            pressure_pa: proportional ? times(shape.pressure_pa) : null,
            would_slide: driving === null ? null : driving > shape.retention_force_n,
        },
    };
}

/**
 * The frames of a report's animation.
 * @return  `duration` [s] as far as the last one is shown, and `moment`, which tells what is seen at a time [s]
 */
export function filmOf({ frames = [], output, balance = [] }) {
    const rate = output?.frames_per_second ?? 24;
    const count = Math.max(output?.frames ?? frames.length, 1);
    const moment = (seconds) => {
        const frame = Math.min(Math.floor(seconds * rate + 1e-6), count - 1);
        const { volume_m3, height_max_m } = frames[frame] ?? {};
        const parts = [`${frame + 1} of ${count}`];
        if (volume_m3 !== undefined) {
            parts.push(...(volume_m3 > 0 ? [volume(volume_m3), `${length(height_max_m)} high`] : ['no liquid']));
        }
        if (balance.length > 0) {
            parts.push(`${seconds.toFixed(2)}${kSpace}s`);
        }
        return parts;
    };
    return { duration: count / rate, moment };
}

/** Rows of what ran over an object: from the report of `droplet-shape flow`. */
function flowRows({ input, forces, balance, counts }) {
    const last = balance[balance.length - 1];
    return [
        ['Object', input.size_m.map((side) => length(side)).join(' × ')],
        ['Liquid', capital(forces.liquid)],
        ['Surface tension', `${digits(forces.surface_tension_n_per_m * 1e3)}${kSpace}mN/m`],
        ['Density', `${digits(forces.density_kg_per_m3)}${kSpace}kg/m³`],
        ['Contact angle', degrees(forces.contact_angle_deg)],
        ['Hysteresis', digits(forces.hysteresis)],
        ['Droplets at the end', `${last.running_droplets + last.still_droplets + last.airborne_droplets}`],
        ['Merged', `${counts.merged}`],
        ['Fell off', `${counts.left}`],
        ['Released', volume(last.released_m3)],
        ['On the object', volume(last.running_m3 + last.still_m3 + last.streaks_m3)],
        ['Dried', volume(last.dried_m3)],
    ];
}

/** Rows of the table: name and formatted value. Values that the report lacks are left out. */
export function rows(report) {
    const { input, shape, liquid, mesh, ground, model, onto } = report;
    if (report.schema?.startsWith('droplet-shape.flow/')) {
        return flowRows(report);
    }
    const found = [];
    const add = (name, value, text) => {
        if (value !== null && value !== undefined) {
            found.push([say(name), text(value)]);
        }
    };
    add('Liquid', liquid?.name, (name) => say(capital(name)));
    add('Surface tension', liquid?.surface_tension_n_per_m, (s) => `${digits(s * 1e3)}${kSpace}mN/m`);
    add('Density', liquid?.density_kg_per_m3, (d) => `${digits(d)}${kSpace}kg/m³`);
    add('Volume', shape?.volume_m3, volume);
    add('Greatest height', shape?.height_max_m, length);
    add('Contact angle', shape?.contact_angle_deg, ({ min, mean, max }) =>
        say('{mean} ({min} to {max})', { mean: degrees(mean), min: degrees(min), max: degrees(max) }));
    add('Footprint', mesh?.footprint_area_m2, area);
    add('Liquid surface', shape?.liquid_area_m2, area);
    add('Rim', mesh?.rim_length_m, length);
    add('Pressure', shape?.pressure_pa, (p) => `${digits(p)}${kSpace}Pa`);
    add('Bond number', shape?.bond_number, (b) => digits(b));
    add('Capillary length', liquid?.capillary_length_m, length);
    add('Picture', extent(report), sides);
    add('Font', input?.type, ({ family, style }) => [family, style].filter(Boolean).join(' '));
    add('Font size', input?.type?.em_m, length);
    if (mesh?.droplets > 1) {
        add('Droplets', mesh.droplets, String);
    }
    if (mesh?.holes > 0) {
        add('Holes', mesh.holes, String);
    }
    if (liquid && liquid.gravity_m_per_s2 !== 9.81) {
        add('Gravity', liquid.gravity_m_per_s2, (g) => `${digits(g)}${kSpace}m/s²`);
    }
    if (liquid?.tilt_deg) {
        add('Tilt', liquid.tilt_deg, (value) => digits(value) + '°');
    }
    if (ground && ground.kind !== 'flat') {
        add('Ground', ground, groundText);
    }
    if (onto) {
        add('Laid on', onto.path, (path) => path.split('/').pop());
    }
    add('Would slide', shape?.would_slide, (slides) => say(slides ? 'yes' : 'no'));
    add('Model', model, say);
    return found;
}

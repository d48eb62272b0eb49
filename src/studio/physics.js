// SPDX-License-Identifier: MIT
// The physics that Studio offers, as tables of fields; and a project's layer as options of the command.
import { dashed } from '../../npm/droplet_shape.js';

/**
 * Fields: name; label; the value at first; `choices` {value: label}, or `unit` and `range` [min, max, step] of a number;
 * `optional` numbers may be empty, which means `empty`; `slider`; `when(settings)`: whether the field matters.
 */
export const kLayerFields = [
    {
        name: 'liquid', label: 'Liquid', value: 'water',
        choices: { water: 'Water', ethanol: 'Ethanol', glycerol: 'Glycerol', mercury: 'Mercury', honey: 'Honey' },
    },
    {
        name: 'material', label: 'Look', value: 'own',
        choices: { own: 'as the liquid', water: 'Clear water', ink: 'Blue ink', mercury: 'Mercury', honey: 'Honey', plain: 'Plain' },
    },
    {
        name: 'by', label: 'Amount', value: 'free',
        choices: {
            free: '40° if it can', contactAngle: 'Contact angle', natural: 'Natural angle', volume: 'Volume', height: 'Height',
        },
    },
    { name: 'contactAngle', label: 'Contact angle', value: 60, unit: '°', range: [1, 179, 1], slider: true, when: ({ by }) => by === 'contactAngle' },
    {
        name: 'on', label: 'Lies on', value: 'glass', choices: { glass: 'Glass', ptfe: 'PTFE', wax: 'Wax', lotus: 'Lotus leaf' },
        when: ({ by }) => by === 'natural',
    },
    { name: 'volume', label: 'Volume', value: 50, unit: 'µL', range: [0.001, 1e9, 'any'], when: ({ by }) => by === 'volume' },
    { name: 'height', label: 'Height', value: 1.5, unit: 'mm', range: [0.001, 1e6, 'any'], when: ({ by }) => by === 'height' },
    { name: 'fill', label: 'For', value: 'each', choices: { each: 'each droplet', total: 'all in total' } },
    {
        name: 'model', label: 'Model', value: 'auto',
        choices: { auto: 'Automatic', linear: 'Linear', exact: 'Exact' }, more: true,
    },
    { name: 'surfaceTension', label: 'Surface tension', value: '', unit: 'mN/m', range: [0.001, 1e6, 'any'], optional: true, empty: 'own', more: true },
    { name: 'density', label: 'Density', value: '', unit: 'kg/m³', range: [0, 1e6, 'any'], optional: true, empty: 'own', more: true },
    { name: 'advancing', label: 'Advancing angle', value: '', unit: '°', range: [0, 180, 'any'], optional: true, empty: 'none', more: true },
    { name: 'receding', label: 'Receding angle', value: '', unit: '°', range: [0, 180, 'any'], optional: true, empty: 'none', more: true },
];

const curved = ({ ground }) => ground !== 'flat';

export const kSceneFields = [
    { name: 'width', label: 'Sheet width', value: 20, unit: 'mm', range: [0.01, 1e5, 'any'] },
    { name: 'gravity', label: 'Gravity', value: 9.81, unit: 'm/s²', range: [-1000, 1000, 'any'] },
    { name: 'tilt', label: 'Tilt', value: 0, unit: '°', range: [0, 180, 1], slider: true },
    { name: 'tiltDirection', label: 'Downhill', value: -90, unit: '°', range: [-180, 180, 5], slider: true, when: ({ tilt }) => Number(tilt) > 0 },
    {
        name: 'ground', label: 'Surface', value: 'flat',
        choices: { flat: 'Flat', sphere: 'Sphere', bowl: 'Bowl', cylinder: 'Cylinder', gutter: 'Gutter' },
    },
    { name: 'radius', label: 'Radius', value: 40, unit: 'mm', range: [0.01, 1e6, 'any'], when: curved },
    {
        name: 'axis', label: 'Axis', value: 90, unit: '°', range: [-180, 180, 5], slider: true,
        when: ({ ground }) => ['cylinder', 'gutter'].includes(ground),
    },
];

function valid(field, value) {
    if (field.choices) {
        return Object.hasOwn(field.choices, value);
    }
    if (value === '') {
        return field.optional === true;
    }
    const [min, max] = field.range;
    return Number.isFinite(value) && value >= min && value <= max;
}

/** Values of all fields: the given ones where they are allowed, else the first ones. */
export function settingsOf(fields, given = {}) {
    return Object.fromEntries(fields.map((field) => [field.name, valid(field, given?.[field.name]) ? given[field.name] : field.value]));
}

const kAmounts = { contactAngle: 'deg', volume: 'uL', height: 'mm' };
const kUnits = { surfaceTension: 'mN/m', density: 'kg/m3', advancing: 'deg', receding: 'deg' };

/** Options of the command for a layer, without those that are its defaults. */
export function optionsOf({ liquid }, scene) {
    const options = { width: `${scene.width}mm` };
    if (liquid.liquid !== 'water') {
        options.liquid = liquid.liquid;
    }
    if (liquid.material !== 'own') {
        options.material = liquid.material;
    }
    if (liquid.by === 'natural') {
        Object.assign(options, { contactAngle: 'natural', on: liquid.on });
    } else if (liquid.by in kAmounts) {
        options[liquid.by] = `${liquid[liquid.by]}${kAmounts[liquid.by]}`;
    }
    if (liquid.fill !== 'each') {
        options.fill = liquid.fill;
    }
    if (liquid.model !== 'auto') {
        options.model = liquid.model;
    }
    for (const [name, unit] of Object.entries(kUnits)) {
        if (liquid[name] !== '') {
            options[name] = `${liquid[name]}${unit}`;
        }
    }
    if (scene.gravity !== 9.81) {
        options.gravity = `${scene.gravity}m/s2`;
    }
    if (scene.tilt > 0) {
        Object.assign(options, { tilt: `${scene.tilt}deg`, tiltDirection: `${scene.tiltDirection}deg` });
    }
    if (scene.ground !== 'flat') {
        const round = ['cylinder', 'gutter'].includes(scene.ground);
        const sign = ['bowl', 'gutter'].includes(scene.ground) ? '-' : '';
        options.surface = `${round ? 'cylinder' : 'sphere'}:R=${sign}${scene.radius}mm${round ? `,axis=${scene.axis}deg` : ''}`;
    }
    return options;
}

/** The command that makes the same droplet of the footprint's picture. */
export function commandOf(stem, options) {
    const words = Object.entries(options).map(([name, value]) =>
        `--${dashed(name)} ${/^[\w.+/-]+$/.test(value) ? value : `'${value}'`}`);
    return ['droplet-shape', `'${stem}.png'`, `'${stem}.glb'`, ...words].join(' ');
}

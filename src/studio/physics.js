// SPDX-License-Identifier: MIT
// The physics that Studio offers, as tables of fields; and a project's layer as options of the command.
import { dashed } from '../../npm/droplet_shape.js';
import { kOptions } from './options.js';

const kUnitSizes = { '°': Math.PI / 180, mm: 1e-3, 'µL': 1e-9, 'mN/m': 1e-3, 'kg/m³': 1, 'm/s²': 1 };

/** Unit, and range [min, max, step] in that unit, of an option. */
function quantity(option, unit, step = 'any') {
    const [min, max] = [kOptions[option].min, kOptions[option].max].map((end) => Number((end / kUnitSizes[unit]).toPrecision(12)));
    return { unit, range: [min, max, step] };
}

/** The number in an option's default. */
const usual = (option) => Number.parseFloat(kOptions[option].default);

/** The words of an option with their labels; a word without one is its own. */
const wordsOf = (option, labels) => Object.fromEntries(kOptions[option].words.map((word) =>
    [word, labels[word] ?? word.replace(/^./, (letter) => letter.toUpperCase())]));

/**
 * Fields: name; label; the value at first; `choices` {value: label}, or `unit` and `range` [min, max, step] of a number;
 * `optional` numbers may be empty, which means `empty`; `slider`; `tiles`: looks are choices, shown as pictures, too;
 * `when(settings)`: whether the field matters.
 */
export const kLayerFields = [
    {
        name: 'liquid', label: 'Liquid', value: 'water',
        choices: wordsOf('liquid', {}),
    },
    {
        name: 'material', label: 'Look', value: 'own', tiles: true,
        choices: { own: 'as the liquid', ...wordsOf('material', { water: 'Clear water', ink: 'Blue ink', oil: 'Iridescent oil', frosted: 'Frosted glass' }) },
    },
    {
        name: 'by', label: 'Amount', value: 'free',
        choices: {
            free: '40° if it can', contactAngle: 'Contact angle', natural: 'Natural angle', volume: 'Volume', height: 'Height',
        },
    },
    { name: 'contactAngle', label: 'Contact angle', value: 60, unit: '°', range: [1, 179, 1], slider: true, when: ({ by }) => by === 'contactAngle' },
    {
        name: 'on', label: 'Lies on', value: 'glass', choices: wordsOf('on', { ptfe: 'PTFE', lotus: 'Lotus leaf' }),
        when: ({ by }) => by === 'natural',
    },
    { name: 'volume', label: 'Volume', value: 50, ...quantity('volume', 'µL'), when: ({ by }) => by === 'volume' },
    { name: 'height', label: 'Height', value: 1.5, ...quantity('height', 'mm'), when: ({ by }) => by === 'height' },
    { name: 'fill', label: 'For', value: 'each', choices: wordsOf('fill', { each: 'each droplet', total: 'all in total' }) },
    {
        name: 'model', label: 'Model', value: 'auto',
        choices: wordsOf('model', { auto: 'Automatic' }), more: true,
    },
    { name: 'surfaceTension', label: 'Surface tension', value: '', ...quantity('surface-tension', 'mN/m'), optional: true, empty: 'own', more: true },
    { name: 'density', label: 'Density', value: '', ...quantity('density', 'kg/m³'), optional: true, empty: 'own', more: true },
    { name: 'advancing', label: 'Advancing angle', value: '', ...quantity('advancing', '°'), optional: true, empty: 'none', more: true },
    { name: 'receding', label: 'Receding angle', value: '', ...quantity('receding', '°'), optional: true, empty: 'none', more: true },
];

const curved = ({ ground }) => ground !== 'flat' && ground !== 'object';

export const kSceneFields = [
    { name: 'width', label: 'Sheet width', value: usual('width'), ...quantity('width', 'mm'), when: ({ ground }) => ground !== 'object' },
    { name: 'gravity', label: 'Gravity', value: usual('gravity'), ...quantity('gravity', 'm/s²') },
    { name: 'tilt', label: 'Tilt', value: usual('tilt'), ...quantity('tilt', '°', 1), slider: true },
    { name: 'tiltDirection', label: 'Downhill', value: usual('tilt-direction'), unit: '°', range: [-180, 180, 5], slider: true, when: ({ tilt }) => Number(tilt) > 0 },
    {
        name: 'ground', label: 'Surface', value: 'flat',
        choices: { flat: 'Flat', sphere: 'Sphere', bowl: 'Bowl', cylinder: 'Cylinder', gutter: 'Gutter', object: 'Object' },
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

/** Options of the command for a layer, without those that are its defaults, and without the object that it lies on. */
export function optionsOf({ liquid }, scene) {
    const options = { width: `${scene.width}mm` };
    if (liquid.liquid !== kOptions.liquid.default) {
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
    if (liquid.fill !== kOptions.fill.default) {
        options.fill = liquid.fill;
    }
    if (liquid.model !== kOptions.model.default) {
        options.model = liquid.model;
    }
    for (const [name, unit] of Object.entries(kUnits)) {
        if (liquid[name] !== '') {
            options[name] = `${liquid[name]}${unit}`;
        }
    }
    if (scene.gravity !== usual('gravity')) {
        options.gravity = `${scene.gravity}m/s2`;
    }
    if (scene.tilt > 0) {
        Object.assign(options, { tilt: `${scene.tilt}deg`, tiltDirection: `${scene.tiltDirection}deg` });
    }
    if (curved(scene)) {
        const round = ['cylinder', 'gutter'].includes(scene.ground);
        const sign = ['bowl', 'gutter'].includes(scene.ground) ? '-' : '';
        options.surface = `${round ? 'cylinder' : 'sphere'}:R=${sign}${scene.radius}mm${round ? `,axis=${scene.axis}deg` : ''}`;
    }
    return options;
}

/** What of a layer's liquid gives it a look: the liquid that has it, else water that wears it. */
export const liquidOf = (look) =>
    (kOptions.liquid.words.includes(look) ? { liquid: look, material: 'own' } : { liquid: kOptions.liquid.default, material: look });

/** The command that makes the same droplet of the footprint's picture. */
export function commandOf(stem, options) {
    const words = Object.entries(options).map(([name, value]) =>
        `--${dashed(name)} ${/^[\w.+/-]+$/.test(value) ? value : `'${value}'`}`);
    return ['droplet-shape', `'${stem}.png'`, `'${stem}.glb'`, ...words].join(' ');
}

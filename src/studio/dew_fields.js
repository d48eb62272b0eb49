// SPDX-License-Identifier: MIT
// What Studio offers of `droplet-shape dew`. Words, ranges, defaults and texts are those of the command's help, which the
// solver has; only the selection, the labels and the units are here.
import { dashed } from '../../npm/droplet_shape.js';

const kUnits = {
    '%': { size: 0.01, text: '' }, '°': { size: Math.PI / 180, text: 'deg' }, mm: { size: 1e-3, text: 'mm' },
    '': { size: 1, text: '' },
};

/** Fields in their order; `report`: where the command's report has the value in use; `window`: what a slider spans. */
const kFields = [
    { name: 'objectSize', label: 'Longest side', unit: 'mm', empty: 'as the file', report: ({ input }) => Math.max(...input.size_m) },
    { name: 'coverage', label: 'Covered', unit: '%', step: 1, slider: true, report: ({ sizes }) => sizes.coverage },
    { name: 'smallest', label: 'Smallest', unit: 'mm', slider: 'log', window: [0.05, 2], report: ({ sizes }) => sizes.smallest_m },
    { name: 'largest', label: 'Largest', unit: 'mm', slider: 'log', window: [0.1, 8], report: ({ sizes }) => sizes.largest_m },
    { name: 'contactAngle', label: 'Contact angle', unit: '°', step: 1, slider: true, report: ({ forces }) => forces.contact_angle_deg * kUnits['°'].size },
    { name: 'seed', label: 'Seed', unit: '', step: 1, whole: true, window: [0, 2 ** 31], report: ({ sizes }) => sizes.seed },
    { name: 'where', label: 'Where' },
    { name: 'up', label: 'Up in the file', labels: { y: 'Y', z: 'Z' }, more: true, when: ({ object }) => /\.(obj|ply|stl)$/i.test(object) },
    { name: 'sizes', label: 'Sizes', labels: { condensation: 'of condensation', lognormal: 'log-normal' }, more: true },
    { name: 'median', label: 'Median radius', unit: 'mm', more: true, when: isLogNormal, report: ({ sizes }) => sizes.median_m },
    { name: 'spread', label: 'Spread', unit: '', more: true, when: isLogNormal, report: ({ sizes }) => sizes.spread },
    { name: 'hysteresis', label: 'Hysteresis', unit: '', window: [0, 2], more: true, report: ({ forces }) => forces.hysteresis },
    { name: 'liquid', label: 'Liquid', labels: {}, more: true },
    { name: 'material', label: 'Look', labels: { water: 'Clear water', ink: 'Blue ink', oil: 'Iridescent oil', frosted: 'Frosted glass' }, more: true },
    { name: 'detail', label: 'Triangles', labels: { low: 'few', medium: 'usual', high: 'many' }, more: true },
    { name: 'instancing', label: 'Droplets', labels: { auto: 'automatic', none: 'one mesh', nodes: 'a node each', gpu: 'instances' }, file: true },
    { name: 'compress', label: 'Compress', labels: { none: 'none', quantize: '16 bits', meshopt: 'meshopt' }, file: true },
];

/** Where droplets are, as options. */
const kWhere = {
    '': { label: 'as its kind', options: {} },
    above: { label: 'where rain from above falls', options: { from: '0,1,0' } },
    side: { label: 'where rain from a side falls', options: { from: '1,0.6,0.6' } },
    weights: { label: 'by weights in the file', options: { vertexWeights: true } },
};

const kPresets = { dew: 'Dew', rain: 'Fresh rain', bottle: 'Cold bottle', shower: 'After a shower', mist: 'Fine mist' };

function isLogNormal({ sizes, in_use }) {
    return sizes !== '' ? sizes === 'lognormal' : in_use?.sizes.distribution === 'lognormal';
}

const capital = (word) => word.replace(/^./, (letter) => letter.toUpperCase());

/** The option's default as a word for an empty field. */
const usual = ({ default: text }) => (/^by /.test(text) ? 'as its kind' : text);

function fieldOf(form, option) {
    const field = { ...form, value: '', optional: true, title: option?.text ?? '' };
    if (form.name === 'where') {
        field.choices = Object.fromEntries(Object.entries(kWhere).map(([name, { label }]) => [name, label]));
    } else if (form.labels) {
        const labelOf = (word) => form.labels[word] ?? capital(word);
        const { words, default: own } = option;
        field.choices = {
            '': words.includes(own) ? labelOf(own) : usual(option),
            ...Object.fromEntries(words.filter((word) => word !== own).map((word) => [word, labelOf(word)])),
        };
    } else {
        const { size } = kUnits[form.unit];
        const [low, high] = [option.min, option.max].map((end, k) =>
            (Number.isFinite(end) ? Number((end / size).toPrecision(9)) : form.window?.[k] ?? (k ? 1e6 : 0)));
        field.range = [low, high, form.step ?? 'any'];
        field.empty = form.empty ?? usual(option);
        if (form.slider === 'log') {
            field.window = [Math.max(low, form.window[0]), Math.min(high, form.window[1])];
        }
    }
    return field;
}

/**
 * Fields for buildForm() and the words of the presets.
 * @param options  the solver's dewOptions
 */
export function dewFields(options) {
    const byName = new Map(options.map((option) => [option.name, option]));
    const presets = byName.get('preset');
    return {
        fields: kFields.map((form) => fieldOf(form, byName.get(form.name))),
        presets: presets.words.map((name) => ({ name, label: kPresets[name] ?? capital(name) })),
        preset: presets.default,
        // A kind of wetness has its own values for these.
        of_preset: ['where', ...options.filter(({ group, default: text }) => group === presets.group && text.startsWith('by preset'))
            .map(({ name }) => name)],
    };
}

/** Settings at first: everything as the command has it. */
export const newSettings = ({ fields, preset }) => ({ preset, ...Object.fromEntries(fields.map(({ name, value }) => [name, value])) });

/** Settings that were kept, without what is unknown or not allowed. */
export function settingsFrom(known, given) {
    const settings = newSettings(known);
    for (const { name, choices, range } of known.fields) {
        const value = given?.[name];
        if (choices ? Object.hasOwn(choices, value) : Number.isFinite(value) && value >= range[0] && value <= range[1]) {
            settings[name] = value;
        }
    }
    if (known.presets.some(({ name }) => name === given?.preset)) {
        settings.preset = given.preset;
    }
    return settings;
}

/** Settings with another value of a field. */
export const withSetting = (settings, name, value) =>
    ({ ...settings, ...name === 'sizes' ? { median: '', spread: '' } : {}, [name]: value });

/** Settings for a kind of wetness, with its own values. */
export const withPreset = ({ of_preset }, settings, preset) =>
    ({ ...settings, ...Object.fromEntries(of_preset.map((name) => [name, ''])), preset });

/** Options of the command that change a file of the result alone. */
export const formOf = ({ fields }, settings) => Object.fromEntries(fields.filter(({ name, file }) => file && settings[name] !== '')
    .map(({ name }) => [name, settings[name]]));

/** The other options of the command. */
export function dewOptionsOf({ fields, preset }, settings) {
    const options = settings.preset === preset ? {} : { preset: settings.preset };
    for (const { name, unit, choices, file } of fields) {
        const value = settings[name];
        if (value === '' || file) {
            continue;
        }
        if (name === 'where') {
            Object.assign(options, kWhere[value].options);
        } else if (choices) {
            options[name] = value;
        } else if (unit === '%' || unit === '') {
            options[name] = Number((value * kUnits[unit].size).toPrecision(9));
        } else {
            options[name] = `${value}${kUnits[unit].text}`;
        }
    }
    return options;
}

/** Settings with the values in use where none is given, for the form. */
export function shownSettings({ fields }, settings, object, report) {
    const shown = { ...settings, object, in_use: report };
    for (const { name, unit, report: valueIn } of fields) {
        const value = settings[name] === '' && report && valueIn ? valueIn(report) : undefined;
        if (Number.isFinite(value)) {
            shown[name] = Number((value / kUnits[unit].size).toPrecision(4));
        }
    }
    return shown;
}

/** The command that makes the same file. */
export function dewCommandOf(object, stem, options) {
    const quoted = (text) => `'${text.replaceAll('\'', '')}'`;
    const words = Object.entries(options).map(([name, value]) => (value === true ? `--${dashed(name)}` : `--${dashed(name)} ${value}`));
    return ['droplet-shape dew', quoted(object), quoted(`${stem}.glb`), ...words].join(' ');
}

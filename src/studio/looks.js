// SPDX-License-Identifier: MIT
// The looks of src/surface/material.cpp, and their colours on the sheet.

/** By name; `ink`: red, green and blue on the sheet, up to 255. */
export const kLooks = {
    water: { colour: [1, 1, 1], metalness: 0, roughness: 0, transmission: 1, ior: 1.333, tinted: false, ink: [58, 139, 181] },
    ink: { colour: [0.03, 0.06, 0.35], metalness: 0, roughness: 0, transmission: 1, ior: 1.333, tinted: true, ink: [38, 52, 138] },
    mercury: { colour: [0.78, 0.78, 0.78], metalness: 1, roughness: 0.02, transmission: 0, ior: 1.5, tinted: false, ink: [122, 131, 139] },
    honey: { colour: [0.9, 0.5, 0.1], metalness: 0, roughness: 0, transmission: 1, ior: 1.489, tinted: true, ink: [212, 138, 34] },
    plain: { colour: [0.8, 0.8, 0.8], metalness: 0, roughness: 0.5, transmission: 0, ior: 1.5, tinted: false, ink: [154, 150, 144] },
};

/** The look that a layer's droplet has. */
export function lookOf({ material, liquid }) {
    return material !== 'own' ? material : liquid in kLooks ? liquid : 'water';
}

export const inkOf = (look) => kLooks[look].ink;

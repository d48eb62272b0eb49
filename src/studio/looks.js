// SPDX-License-Identifier: MIT
// The looks of src/surface/material.cpp, and their colours on the sheet.

/** By name; `ink`: red, green and blue on the sheet, up to 255. */
export const kLooks = {
    water: { colour: [1, 1, 1], metalness: 0, roughness: 0, transmission: 1, ior: 1.333, tinted: false, ink: [58, 139, 181] },
    ink: { colour: [0.03, 0.06, 0.35], metalness: 0, roughness: 0, transmission: 1, ior: 1.333, tinted: true, ink: [38, 52, 138] },
    mercury: { colour: [0.78, 0.78, 0.78], metalness: 1, roughness: 0.02, transmission: 0, ior: 1.5, tinted: false, ink: [122, 131, 139] },
    honey: { colour: [0.9, 0.5, 0.1], metalness: 0, roughness: 0, transmission: 1, ior: 1.489, tinted: true, ink: [212, 138, 34] },
    plain: { colour: [0.8, 0.8, 0.8], metalness: 0, roughness: 0.5, transmission: 0, ior: 1.5, tinted: false, ink: [154, 150, 144] },
    gel: { colour: [0.45, 0.93, 0.88], metalness: 0, roughness: 0.06, transmission: 0.94, ior: 1.37, tinted: true, ink: [70, 184, 176] },
    enamel: { colour: [0.02, 0.11, 0.42], metalness: 0, roughness: 0.03, transmission: 0, ior: 1.55, tinted: false, ink: [38, 93, 174] },
    glass: { colour: [0.86, 0.97, 0.92], metalness: 0, roughness: 0, transmission: 1, ior: 1.52, tinted: true, ink: [120, 176, 150] },
    resin: { colour: [0.98, 0.88, 0.62], metalness: 0, roughness: 0, transmission: 1, ior: 1.56, tinted: true, ink: [206, 178, 112] },
    oil: { colour: [0.07, 0.04, 0.02], metalness: 0, roughness: 0, transmission: 1, ior: 1.47, tinted: true, film: { ior: 1.9, thickness: 430e-9 }, ink: [96, 74, 36] },
    milk: { colour: [0.9, 0.87, 0.78], metalness: 0, roughness: 0, transmission: 0, ior: 1.35, tinted: false, ink: [196, 190, 172] },
    lacquer: { colour: [0.45, 0.012, 0.01], metalness: 0, roughness: 0, transmission: 0, ior: 1.54, tinted: false, ink: [176, 30, 26] },
    blood: { colour: [0.5, 0.012, 0.01], metalness: 0, roughness: 0, transmission: 0.8, ior: 1.38, tinted: true, ink: [124, 12, 14] },
    gold: { colour: [1, 0.71, 0.29], metalness: 1, roughness: 0.1, transmission: 0, ior: 1.5, tinted: false, ink: [200, 156, 66] },
    frosted: { colour: [1, 1, 1], metalness: 0, roughness: 0.35, transmission: 0.8, ior: 1.52, tinted: false, ink: [140, 160, 172] },
    ice: { colour: [0.75, 0.92, 1], metalness: 0, roughness: 0.14, transmission: 0.9, ior: 1.309, tinted: true, ink: [110, 170, 206] },
};

/** The look that a layer's droplet has. */
export function lookOf({ material, liquid }) {
    return material !== 'own' ? material : liquid in kLooks ? liquid : 'water';
}

export const inkOf = (look) => kLooks[look].ink;

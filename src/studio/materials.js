// SPDX-License-Identifier: MIT
// The looks of src/surface/material.cpp for three.js, as its glTF loader would make them; and their colours on the sheet.
import { Color, MeshPhysicalMaterial } from 'three';

const kLooks = {
    water: { colour: [1, 1, 1], roughness: 0, transmission: 1, ior: 1.333, ink: [58, 139, 181] },
    ink: { colour: [0.03, 0.06, 0.35], roughness: 0, transmission: 1, ior: 1.333, tinted: true, ink: [38, 52, 138] },
    mercury: { colour: [0.78, 0.78, 0.78], metalness: 1, roughness: 0.02, ink: [122, 131, 139] },
    honey: { colour: [0.9, 0.5, 0.1], roughness: 0, transmission: 1, ior: 1.489, tinted: true, ink: [212, 138, 34] },
    plain: { colour: [0.8, 0.8, 0.8], roughness: 0.5, ink: [154, 150, 144] },
};

/** The look that a layer's droplet has. */
export function lookOf({ material, liquid }) {
    return material !== 'own' ? material : liquid in kLooks ? liquid : 'water';
}

/** Red, green and blue, up to 255, of a look on the sheet. */
export const inkOf = (look) => kLooks[look].ink;

export function materialOf(look) {
    const { colour, metalness = 0, roughness, transmission = 0, ior = 1.5, tinted } = kLooks[look];
    const material = new MeshPhysicalMaterial({ metalness, roughness, transmission, ior });
    if (tinted) {
        material.attenuationColor = new Color(...colour);
    } else {
        material.color = new Color(...colour);
    }
    material.name = look;
    return material;
}

/** Fits a material to the mean thickness of its droplet [m]. */
export function thicken(material, thickness) {
    if (material.transmission > 0) {
        material.thickness = thickness;
        material.userData.tint_depth = kLooks[material.name].tinted ? thickness : Infinity;
    }
}

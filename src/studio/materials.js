// SPDX-License-Identifier: MIT
// Looks as three.js's glTF loader would make them.
import { Color, MeshPhysicalMaterial } from 'three';
import { kLooks } from './looks.js';

export function materialOf(look) {
    const { colour, metalness, roughness, transmission, ior, tinted, film } = kLooks[look];
    const material = new MeshPhysicalMaterial({ metalness, roughness, transmission, ior });
    if (film) {
        const nanometres = 1e9 * film.thickness;
        Object.assign(material, { iridescence: 1, iridescenceIOR: film.ior, iridescenceThicknessRange: [nanometres, nanometres] });
    }
    if (tinted && transmission < 1) {  // the scattered light and the absorption each have a half of the tint
        material.attenuationColor = new Color(...colour.map(Math.sqrt));
        material.color.copy(material.attenuationColor);
    } else if (tinted) {
        material.attenuationColor = new Color(...colour);
    } else {
        material.color = new Color(...colour);
    }
    material.name = look;
    return material;
}

/** Fits a material to the mean thickness of its droplet [m]; light passes it down to the ground and up again. */
export function thicken(material, thickness) {
    if (kLooks[material.name].transmission > 0) {
        material.thickness = thickness;
        material.userData.tint_depth = kLooks[material.name].tinted ? 2 * thickness : Infinity;
    }
}

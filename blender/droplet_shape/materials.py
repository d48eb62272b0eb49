# SPDX-License-Identifier: GPL-3.0-or-later
"""The look of the liquid in Cycles and Eevee."""

import math

import bpy

# Names of sockets: those of 4.x, then those of 3.4.
_TRANSMISSION = ("Transmission Weight", "Transmission")


def socket(node, names):
    """Input of a node by the first of the names that it has."""
    return next(node.inputs[name] for name in names if name in node.inputs)


def make_material(look, scale):
    """Material with this look. scale: units of the scene in a metre. An equal material is used again."""
    state = repr((look, float(f"{scale:.6g}")))  # scales that differ by rounding share a material
    for known in bpy.data.materials:
        if known.get("droplet_look") == state:
            return known
    material = bpy.data.materials.new(f"Droplet {look.name}")
    material["droplet_look"] = state
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    if look.attenuation_distance is None:
        _surface(material, look, look.base_colour, "ALL", 0)
    else:
        # Cycles absorbs light along its way. Eevee does not; there, the colour is that of white ground below the mean
        # thickness, which light passes down and up.
        depth = 2 * look.thickness / look.attenuation_distance
        tint = (*(channel**depth for channel in look.attenuation_colour), 1.0)
        output = _surface(material, look, look.base_colour, "CYCLES", 0)
        _surface(material, look, tint, "EEVEE", -500)
        rates = [-math.log(max(channel, 1e-6)) / look.attenuation_distance for channel in look.attenuation_colour]
        largest = max(max(rates), 1e-9)
        volume = nodes.new("ShaderNodeVolumeAbsorption")
        volume.location = 0, -1000
        volume.inputs["Color"].default_value = (*(1 - rate / largest for rate in rates), 1.0)
        volume.inputs["Density"].default_value = largest / scale
        material.node_tree.links.new(volume.outputs["Volume"], output.inputs["Volume"])
    if look.transmission > 0:
        if hasattr(material, "use_screen_refraction"):  # renamed in 4.2, where the old name stays
            material.use_screen_refraction = True
        if hasattr(material, "refraction_depth"):
            material.refraction_depth = 2 * look.thickness * scale
    material.diffuse_color = (*look.base_colour[:3], 1.0)
    return material


def _surface(material, look, colour, target, y):
    nodes = material.node_tree.nodes
    shader = nodes.new("ShaderNodeBsdfPrincipled")
    shader.location = 0, y
    shader.inputs["Base Color"].default_value = colour
    shader.inputs["Metallic"].default_value = look.metallic
    shader.inputs["Roughness"].default_value = look.roughness
    shader.inputs["IOR"].default_value = look.ior
    socket(shader, _TRANSMISSION).default_value = look.transmission
    output = nodes.new("ShaderNodeOutputMaterial")
    output.location = 400, y
    output.target = target
    material.node_tree.links.new(shader.outputs["BSDF"], output.inputs["Surface"])
    return output


def prepare_eevee(scene, look):
    """Switches on refraction, which Eevee needs to show clear liquid."""
    if look.transmission == 0:
        return
    for setting in ("use_ssr", "use_ssr_refraction", "use_raytracing"):  # 3.4 to 4.1; from 4.2 on
        if hasattr(scene.eevee, setting):
            setattr(scene.eevee, setting, True)

# SPDX-License-Identifier: GPL-3.0-or-later
"""The look of the liquid in Cycles and Eevee."""

import math

import bpy

# Names of sockets: those of 4.x, then those of 3.4.
_TRANSMISSION = ("Transmission Weight", "Transmission")


def socket(node, names):
    """Input of a node by the first of the names that it has."""
    return next(node.inputs[name] for name in names if name in node.inputs)


def make_material(look, scale, clear_shadows):
    """Material with this look. An equal material is used again.

    scale: units of the scene in a metre. clear_shadows: see let_light_through().
    """
    state = repr((look, float(f"{scale:.6g}"), clear_shadows))  # scales that differ by rounding share a material
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
        refract_in_eevee(material)
        if hasattr(material, "refraction_depth"):
            material.refraction_depth = 2 * look.thickness * scale
    material.diffuse_color = (*look.base_colour[:3], 1.0)
    if clear_shadows:
        let_light_through(material)
    return material


def let_light_through(material):
    """Lets the light of lamps pass clear matter straight on. Without it, a path tracer finds lamps behind refraction by
    chance alone: shadows are black, or full of grain. Light is not focused then.

    Returns whether something changed: whether there is clear matter that cast shadows.
    """
    changed = False
    if not material.use_nodes:
        return changed
    nodes, links = material.node_tree.nodes, material.node_tree.links
    for output in [node for node in nodes if node.type == "OUTPUT_MATERIAL" and node.target in {"ALL", "CYCLES"}]:
        if not output.inputs["Surface"].links:
            continue
        shader = output.inputs["Surface"].links[0].from_node
        if shader.type != "BSDF_PRINCIPLED" or socket(shader, _TRANSMISSION).default_value == 0:
            continue
        x, y = output.location
        output.location = x + 400, y
        path = nodes.new("ShaderNodeLightPath")
        path.location = x, y + 350
        straight = nodes.new("ShaderNodeBsdfTransparent")
        straight.location = x, y - 150
        # Light crosses the surface twice.
        colour = shader.inputs["Base Color"].default_value
        straight.inputs["Color"].default_value = (*(math.sqrt(channel) for channel in colour[:3]), 1.0)
        mix = nodes.new("ShaderNodeMixShader")
        mix.location = x + 200, y
        # Rays that matt ground scatters pass, too: both ways to find a lamp must see the same.
        either = nodes.new("ShaderNodeMath")
        either.operation = "MAXIMUM"
        either.location = x + 200, y + 350
        links.new(path.outputs["Is Shadow Ray"], either.inputs[0])
        links.new(path.outputs["Is Diffuse Ray"], either.inputs[1])
        links.new(either.outputs["Value"], mix.inputs["Fac"])
        links.new(shader.outputs["BSDF"], mix.inputs[1])
        links.new(straight.outputs["BSDF"], mix.inputs[2])
        links.new(mix.outputs["Shader"], output.inputs["Surface"])
        changed = True
    if changed and hasattr(material, "shadow_method"):  # Eevee before 4.2
        material.shadow_method = "HASHED"
    return changed


def refract_in_eevee(material):
    """Lets Eevee show through clear matter what is behind it; the scene must be prepared, too."""
    if hasattr(material, "use_screen_refraction"):  # renamed in 4.2, where the old name stays
        material.use_screen_refraction = True


def _surface(material, look, colour, target, y):
    nodes = material.node_tree.nodes
    shader = nodes.new("ShaderNodeBsdfPrincipled")
    shader.location = 0, y
    shader.inputs["Base Color"].default_value = colour
    shader.inputs["Metallic"].default_value = look.metallic
    shader.inputs["Roughness"].default_value = look.roughness
    shader.inputs["IOR"].default_value = look.ior
    socket(shader, _TRANSMISSION).default_value = look.transmission
    if look.film_thickness is not None and "Thin Film Thickness" in shader.inputs:  # from 4.2 on
        shader.inputs["Thin Film Thickness"].default_value = look.film_thickness
        shader.inputs["Thin Film IOR"].default_value = look.film_ior
    output = nodes.new("ShaderNodeOutputMaterial")
    output.location = 400, y
    output.target = target
    material.node_tree.links.new(shader.outputs["BSDF"], output.inputs["Surface"])
    return output


def prepare_eevee(scene):
    """Switches on refraction, which Eevee needs to show clear liquid."""
    for setting in ("use_ssr", "use_ssr_refraction", "use_raytracing"):  # 3.4 to 4.1; from 4.2 on
        if hasattr(scene.eevee, setting):
            setattr(scene.eevee, setting, True)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders maps of droplets on a plane beside the droplets themselves, in Blender with Cycles:

    droplet-shape logo.png logo.glb --width 6cm --maps maps/logo.exr --map-width 2k
    blender --background --factory-startup --python decal.py -- maps/logo.exr 6cm logo.png [MODEL [SAMPLES]]

6cm is the width of the footprint's picture. With MODEL, logo.glb, the droplets stand to the right of the decal, in the
same look. The material mixes stone with water: where `-coverage` says so it is smooth and shines by `-normal`, `-height` lifts it,
`-wetness` darkens the stone below it, and `-occlusion` what little light reaches.
"""
import math
import pathlib
import sys

import bpy
import numpy

if "bool" not in numpy.__dict__:
    numpy.bool = bool  # which the importer of Debian 12's Blender 3.4 still asks for

maps, width, picture, *more = sys.argv[sys.argv.index("--") + 1:]
UNITS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0}
unit = next((name for name in UNITS if width.endswith(name)), None)
if unit is None:
    sys.exit(f"decal.py: the width, {width}, needs a unit: mm, cm or m")
if not maps.endswith(".exr"):
    sys.exit("decal.py takes maps in OpenEXR, which have metres")
width = float(width[:-len(unit)]) * UNITS[unit]
model = more[0] if more else None
samples = int(more[1]) if len(more) > 1 else 64

DAMP, SMOOTH = 0.45, 0.03

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene


def map_file(word):
    path = pathlib.Path(maps)
    return str(path.with_name(f"{path.stem}-{word}{path.suffix}"))


def node(tree, kind, **inputs):
    made = tree.nodes.new(kind)
    for name, value in inputs.items():
        made.inputs[name.replace("_", " ")].default_value = value
    return made


def texture(tree, word):
    made = tree.nodes.new("ShaderNodeTexImage")
    made.image = bpy.data.images.load(map_file(word))
    made.image.colorspace_settings.name = "Non-Color"
    made.extension = "EXTEND"
    return made.outputs["Color"]


def stone(tree):
    """What the decal lies on; the same wherever an object is."""
    place = node(tree, "ShaderNodeNewGeometry")
    noise = node(tree, "ShaderNodeTexNoise", Scale=4 / width, Detail=10.0, Roughness=0.65)
    tree.links.new(place.outputs["Position"], noise.inputs["Vector"])
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    ramp.color_ramp.elements[0].position, ramp.color_ramp.elements[0].color = 0.35, (0.22, 0.16, 0.11, 1)
    ramp.color_ramp.elements[1].position, ramp.color_ramp.elements[1].color = 0.65, (0.52, 0.44, 0.35, 1)
    tree.links.new(noise.outputs["Fac"], ramp.inputs["Fac"])
    return ramp.outputs["Color"]


def principled(material):
    material.use_nodes = True
    return next(item for item in material.node_tree.nodes if item.type == "BSDF_PRINCIPLED")


def dry_floor():
    material = bpy.data.materials.new("floor")
    shader = principled(material)
    shader.inputs["Roughness"].default_value = 0.7
    material.node_tree.links.new(stone(material.node_tree), shader.inputs["Base Color"])
    return material


def wet_decal():
    """Ground with water on it, by the maps alone."""
    material = bpy.data.materials.new("wet_decal")
    shader = principled(material)
    tree = material.node_tree
    link = tree.links.new

    def mixed(factor, dry, wet, kind="MIX"):
        mix = node(tree, "ShaderNodeMixRGB")
        mix.blend_type = kind
        for value, name in ((factor, "Fac"), (dry, "Color1"), (wet, "Color2")):
            if hasattr(value, "is_output"):
                link(value, mix.inputs[name])
            else:
                mix.inputs[name].default_value = value
        return mix.outputs["Color"]

    coverage, occlusion = texture(tree, "coverage"), texture(tree, "occlusion")
    # Wet ground is darker, as light that it scatters is thrown back by the water's surface.
    darker = mixed(texture(tree, "wetness"), (1, 1, 1, 1), (DAMP,) * 3 + (1,))
    colour = mixed(1.0, stone(tree), darker, "MULTIPLY")
    link(mixed(0.8, colour, occlusion, "MULTIPLY"), shader.inputs["Base Color"])
    link(mixed(coverage, (0.7,) * 3 + (1,), (SMOOTH,) * 3 + (1,)), shader.inputs["Roughness"])
    # The map's normals are those of the plane, on which the maps lie upright.
    normal = node(tree, "ShaderNodeNormalMap", Strength=1.0)
    normal.space = "OBJECT"  # of the flat plane, whatever the height does to it
    scale = node(tree, "ShaderNodeVectorMath")  # -1 ... 1; the node wants 0 ... 1
    scale.operation = "MULTIPLY_ADD"
    scale.inputs[1].default_value = scale.inputs[2].default_value = (0.5, 0.5, 0.5)
    link(texture(tree, "normal"), scale.inputs[0])
    link(scale.outputs["Vector"], normal.inputs["Color"])
    link(normal.outputs["Normal"], shader.inputs["Normal"])
    return material


def wet_stone():
    """The same look for droplets of a mesh."""
    material = bpy.data.materials.new("wet_stone")
    shader = principled(material)
    shader.inputs["Roughness"].default_value = SMOOTH
    tree = material.node_tree
    darker = node(tree, "ShaderNodeMixRGB", Fac=1.0, Color2=(DAMP,) * 3 + (1,))
    darker.blend_type = "MULTIPLY"
    tree.links.new(stone(tree), darker.inputs["Color1"])
    tree.links.new(darker.outputs["Color"], shader.inputs["Base Color"])
    return material


image = bpy.data.images.load(map_file("height"))
height = width * image.size[1] / image.size[0]
side = max(width, height)
apart = 0.53 * width if model else 0.0

bpy.ops.mesh.primitive_plane_add(size=40 * side, location=(0, 0, -1e-5 * side))
bpy.context.object.data.materials.append(dry_floor())

bpy.ops.mesh.primitive_grid_add(x_subdivisions=512, y_subdivisions=int(512 * height / width), size=1, location=(-apart, 0, 0))
decal = bpy.context.object
decal.scale = (width, height, 1)
bpy.ops.object.transform_apply(location=False)
bpy.ops.object.shade_smooth()
decal.data.materials.append(wet_decal())
lift = decal.modifiers.new("height", "DISPLACE")
lift.texture = bpy.data.textures.new("height", "IMAGE")
image.colorspace_settings.name = "Non-Color"
lift.texture.image, lift.texture.extension = image, "EXTEND"
lift.texture_coords, lift.mid_level, lift.strength = "UV", 0.0, 1.0  # the map is in metres

if model:
    before = set(scene.objects)
    bpy.ops.import_scene.gltf(filepath=model)
    for item in set(scene.objects) - before:
        if item.parent is None:
            item.location.x += apart
        if item.type == "MESH":
            item.data.materials.clear()
            item.data.materials.append(wet_stone())


def lamp(place, energy, size):
    light = bpy.data.lights.new("lamp", "AREA")
    light.energy, light.size = energy * side * side, size * side
    item = bpy.data.objects.new("lamp", light)
    item.location = [side * x for x in place]
    item.rotation_euler = (-item.location).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(item)


# Far away, so that decal and mesh have the same light.
lamp((-8, 22, 16), 7000, 9)
lamp((-18, 2, 16), 3000, 12)
world = bpy.data.worlds.new("world")
scene.world = world
world.use_nodes = True
world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.05, 0.06, 0.08, 1)

camera = bpy.data.cameras.new("camera")
camera.type = "ORTHO"  # so that both are seen alike
item = bpy.data.objects.new("camera", camera)
wide = (2.0 if model else 1.1) * width
camera.ortho_scale = wide
item.location = (0, -1.15 * wide, 0.95 * wide)
item.rotation_euler = (math.atan2(1.15, 0.95), 0, 0)
camera.clip_start = 1e-4
scene.collection.objects.link(item)
scene.camera = item

scene.render.engine = "CYCLES"
scene.cycles.samples = samples
scene.cycles.use_denoising = False
scene.render.resolution_x, scene.render.resolution_y = 1600, 720 if model else 1200
scene.view_settings.view_transform = "Filmic"
scene.render.filepath = picture
bpy.ops.render.render(write_still=True)

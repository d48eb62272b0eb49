# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders an object with droplets as a picture, in Blender with Cycles:

    droplet-shape dew can.glb cold.glb --preset bottle --object-size 12cm --instancing none
    blender --background --factory-startup --python cold_can.py -- cold.glb cold.png [SAMPLES [PERCENT]]

The object is lacquered, the droplets are water, and a lamp behind the object makes them shine.
"""
import math
import sys

import bpy
import numpy
from mathutils import Vector

if "bool" not in numpy.__dict__:
    numpy.bool = bool  # which the importer of Debian 12's Blender 3.4 still asks for

model, picture, *more = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=model)
scene = bpy.context.scene
meshes = [item for item in scene.objects if item.type == "MESH"]
(thing,) = (item for item in meshes if item.name.startswith("object"))
corners = [thing.matrix_world @ Vector(corner) for corner in thing.bound_box]
low, high = (Vector([pick(corner[k] for corner in corners) for k in range(3)]) for pick in (min, max))
middle, size = (low + high) / 2, max(high - low)


def socket(node, *names):
    """An input by the first name that this version of Blender knows."""
    return next(node.inputs[name] for name in names if name in node.inputs)


def material(name, colour, **values):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    shader = next(node for node in made.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Base Color"].default_value = (*colour, 1)
    for names, value in values.items():
        socket(shader, *names.split("_or_")).default_value = value
    return made


lacquer = material("lacquer", (0.03, 0.3, 0.4), Metallic=0.7, Roughness=0.3)
water = material("water", (1, 1, 1), Roughness=0, IOR=1.333, **{"Transmission Weight_or_Transmission": 1})
for item in meshes:
    item.data.materials.clear()
    item.data.materials.append(lacquer if item == thing else water)

bpy.ops.mesh.primitive_plane_add(size=100 * size, location=(middle.x, middle.y, low.z))
bpy.context.object.data.materials.append(material("table", (0.05, 0.055, 0.06), Roughness=0.35))


def lamp(place, energy, width, colour=(1, 1, 1)):
    light = bpy.data.lights.new("lamp", "AREA")
    light.energy, light.size, light.color = energy * size * size, width * size, colour
    item = bpy.data.objects.new("lamp", light)
    item.location = middle + size * Vector(place)
    item.rotation_euler = (middle - item.location).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(item)


lamp((-1.4, 1.6, 1.5), 60, 1.2)  # behind
lamp((1.8, -0.6, 1.2), 25, 0.8, (1, 0.93, 0.85))
lamp((-1.6, -1.4, 0.6), 8, 1.5, (0.8, 0.9, 1))
scene.world = bpy.data.worlds.new("room")
scene.world.use_nodes = True
scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.16, 0.18, 0.21, 1)

camera = bpy.data.cameras.new("camera")
camera.lens, camera.clip_start = 85, 0.01 * size
camera.dof.use_dof, camera.dof.aperture_fstop = True, 11 * 0.12 / size
eye = bpy.data.objects.new("camera", camera)
eye.location = middle + size * Vector((0.6, -3.1, 0.25))
eye.rotation_euler = (middle - eye.location).to_track_quat("-Z", "Y").to_euler()
camera.dof.focus_distance = (middle - eye.location).length - 0.25 * size
scene.collection.objects.link(eye)
scene.camera = eye

scene.render.engine = "CYCLES"
scene.cycles.samples = int(more[0]) if more else 256
scene.cycles.max_bounces, scene.cycles.transmission_bounces = 12, 12
scene.cycles.use_denoising = False  # Debian's Blender has none
scene.render.resolution_x, scene.render.resolution_y = 1200, 1600
scene.render.resolution_percentage = int(more[1]) if len(more) > 1 else 100
scene.view_settings.look = "Medium High Contrast"
scene.render.filepath = picture
bpy.ops.render.render(write_still=True)

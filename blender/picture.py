# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders the picture of docs/blender.md: a text, turned into water by the add-on, on a checked ground.

    blender --background --factory-startup --python-exit-code 1 --python blender/picture.py -- PROGRAM PICTURE_PNG
"""

import math
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.dont_write_bytecode = True

import addon_utils
import bpy
from mathutils import Vector

program, picture = (os.path.abspath(path) for path in sys.argv[sys.argv.index("--") + 1:])
addon_utils.enable("droplet_shape", default_set=True)
bpy.context.preferences.addons["droplet_shape"].preferences.program = program

scene = bpy.context.scene
for item in list(bpy.data.objects):
    bpy.data.objects.remove(item)


def aimed(position, target):
    return (Vector(target) - Vector(position)).to_track_quat("-Z", "Y").to_euler()


def place(kind, position, target, **settings):
    getattr(bpy.ops.object, f"{kind}_add")(location=position, rotation=aimed(position, target), **settings)
    return bpy.context.object


bpy.ops.object.text_add()
text = bpy.context.object
text.data.body = "drop"
text.data.align_x, text.data.align_y = "CENTER", "CENTER"
text.data.offset = 0.03  # bolder
bpy.context.view_layer.update()
bpy.ops.mesh.droplet_add(source="OBJECT", width=30, triangles=60000, clear_shadows=False)

bpy.ops.mesh.primitive_plane_add(size=60)
ground = bpy.data.materials.new("ground")
ground.use_nodes = True
nodes, links = ground.node_tree.nodes, ground.node_tree.links
checks = nodes.new("ShaderNodeTexChecker")
checks.inputs["Scale"].default_value = 5
checks.inputs["Color1"].default_value = (0.6, 0.55, 0.46, 1)
checks.inputs["Color2"].default_value = (0.24, 0.32, 0.35, 1)
places = nodes.new("ShaderNodeTexCoord")
links.new(places.outputs["Object"], checks.inputs["Vector"])
links.new(checks.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
nodes["Principled BSDF"].inputs["Roughness"].default_value = 0.7
bpy.context.object.data.materials.append(ground)
bpy.context.object.cycles.is_caustics_receiver = True

scene.world.use_nodes = True
sky = scene.world.node_tree.nodes["Background"]
sky.inputs["Color"].default_value = (0.75, 0.85, 1, 1)
sky.inputs["Strength"].default_value = 0.35
for position, energy, size in (((-2.2, 2.4, 2.6), 150, 1.5), ((2.6, 1.6, 1.4), 40, 1.2)):
    lamp = place("light", position, (0, 0, 0), type="AREA")
    lamp.data.energy, lamp.data.size = energy, size
    lamp.data.cycles.is_caustics_light = True

camera = place("camera", (0, -1.9, 1.9), (0, 0.0, 0))
camera.data.lens = 44
scene.camera = camera
scene.render.engine = "CYCLES"
scene.cycles.device = "CPU"
scene.cycles.samples = 64
scene.cycles.use_denoising = False
scene.cycles.use_adaptive_sampling = False
scene.view_settings.view_transform = "Filmic"
scene.view_settings.look = "High Contrast"
scene.render.resolution_x, scene.render.resolution_y = 640, 480
scene.render.resolution_percentage = 100
scene.render.image_settings.color_mode = "RGB"
for stamp in dir(scene.render):
    if stamp.startswith("use_stamp_"):
        setattr(scene.render, stamp, False)  # no date in the file
scene.render.filepath = picture
bpy.ops.render.render(write_still=True)

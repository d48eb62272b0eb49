# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders a droplet on a checked ground: blender -b -P blender.py -- DROPLET_GLB PICTURE_PNG"""
import sys

import numpy

numpy.bool = bool  # Blender's importer in Debian 12 uses a name that its numpy no longer has

import bpy
from mathutils import Vector

glb, picture = sys.argv[sys.argv.index("--") + 1 :]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=glb)
droplet = next(item for item in bpy.data.objects if item.type == "MESH")
size = max(droplet.dimensions)


def aimed(position, target):
    return (Vector(target) - Vector(position)).to_track_quat("-Z", "Y").to_euler()


bpy.ops.mesh.primitive_plane_add(size=40 * size)  # the droplet was made with --sink
ground = bpy.data.materials.new("ground")
ground.use_nodes = True
nodes = ground.node_tree.nodes
checks = nodes.new("ShaderNodeTexChecker")
checks.inputs["Scale"].default_value = 320
checks.inputs["Color1"].default_value = (0.05, 0.12, 0.2, 1)
checks.inputs["Color2"].default_value = (0.02, 0.06, 0.11, 1)
nodes["Principled BSDF"].inputs["Roughness"].default_value = 0.6
ground.node_tree.links.new(checks.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
bpy.context.object.data.materials.append(ground)

world = bpy.data.worlds.new("world")
world.use_nodes = True
world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.7, 0.8, 1, 1)
scene = bpy.context.scene
scene.world = world
lamp = (-1.5 * size, 2 * size, 2.5 * size)
bpy.ops.object.light_add(type="AREA", location=lamp, rotation=aimed(lamp, (0, 0, 0)))
bpy.context.object.data.energy = 60 * size * size
bpy.context.object.data.size = 0.8 * size
eye = (0, -1.25 * size, 1.15 * size)
bpy.ops.object.camera_add(location=eye, rotation=aimed(eye, (0, 0.02 * size, 0)))
scene.camera = bpy.context.object
scene.camera.data.clip_start = 0.01 * size  # a droplet is nearer than Blender's default of 10 cm
scene.camera.data.lens = 45
scene.render.engine = "CYCLES"
scene.cycles.samples = 256
scene.cycles.use_denoising = False
scene.render.resolution_x, scene.render.resolution_y = 800, 600
scene.render.filepath = picture
bpy.ops.render.render(write_still=True)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Droplets of liquid in Blender: source -> footprint -> command -> model -> object.

    footprints.py   a picture, an image, a text or a curve, as the file that the command reads
    places.py       where the droplet lies, and which way gravity points there
    command.py      the command: its options, its errors, its result
    glb.py          glTF files to arrays, and back
    meshes.py       arrays to Blender's meshes and shape keys
    materials.py    the look of the liquid in Cycles and Eevee
    operators.py    the operators and the menu
    preferences.py  where the command is
"""

from . import command, operators, preferences

bl_info = {
    "name": "Droplet",
    "author": "The authors of droplet-shape",
    "version": (0, 2, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Add > Mesh > Droplet",
    "description": "Turns a picture, a text or a curve into a droplet of liquid",
    "category": "Add Mesh",
}


def register():
    preferences.register()
    operators.register()


def unregister():
    operators.unregister()
    preferences.unregister()
    command.forget()

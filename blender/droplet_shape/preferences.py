# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the command is, and how long it may take."""

import bpy


class DropletPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: bpy.props.StringProperty(
        name="Program",
        description="The command droplet-shape. Empty: the one on PATH",
        subtype="FILE_PATH",
    )
    timeout: bpy.props.IntProperty(
        name="Time Limit",
        description="Seconds after which the command is stopped",
        default=600,
        min=1,
    )

    def draw(self, context):
        self.layout.prop(self, "program")
        self.layout.prop(self, "timeout")


def preferences(context):
    return context.preferences.addons[__package__].preferences


def register():
    bpy.utils.register_class(DropletPreferences)


def unregister():
    bpy.utils.unregister_class(DropletPreferences)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays to Blender's meshes and shape keys."""

import bpy
import numpy as np


def _flat(values):
    return np.ascontiguousarray(values, np.float32).reshape(-1)


def make_mesh(part, welded, name):
    """Closed mesh of a part with its normals, its texture coordinates and the attribute contact_angle, in metres."""
    corners = part.triangles.reshape(-1)
    count = len(part.triangles)

    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(welded.sources))
    mesh.vertices.foreach_set("co", _flat(part.positions[welded.sources]))
    mesh.loops.add(3 * count)
    mesh.loops.foreach_set("vertex_index", welded.triangles.reshape(-1))
    mesh.polygons.add(count)
    mesh.polygons.foreach_set("loop_start", np.arange(0, 3 * count, 3, np.int32))
    if bpy.app.version < (4, 1, 0):  # later versions derive it
        mesh.polygons.foreach_set("loop_total", np.full(count, 3, np.int32))
    mesh.polygons.foreach_set("use_smooth", np.ones(count, bool))
    if part.uvs is not None:
        mesh.uv_layers.new(name="UVMap", do_init=False).data.foreach_set("uv", _flat(part.uvs[corners]))
    mesh.update(calc_edges=True)

    if part.contact_angles is not None:
        angles = mesh.attributes.new("contact_angle", "FLOAT", "POINT")
        angles.data.foreach_set("value", _flat(part.contact_angles[welded.sources]))
    if hasattr(mesh, "use_auto_smooth"):  # before 4.1
        mesh.use_auto_smooth = True
        mesh.auto_smooth_angle = np.pi
    normals = part.normals.tolist()  # corners share these lists, which Blender reads sooner than an array
    mesh.normals_split_custom_set([normals[corner] for corner in corners.tolist()])
    return mesh


def add_shape_keys(item, part, welded, fps=24, start=1):
    """Gives the object the part's targets as shape keys, and its animation as keyframes from the frame start on."""
    def frame(time):
        return start + float(time) * fps

    if part.targets:
        rest = part.positions[welded.sources]
        item.shape_key_add(name="Basis", from_mix=False)
        for name, shift in part.targets:
            key = item.shape_key_add(name=name, from_mix=False)
            key.data.foreach_set("co", _flat(rest + shift[welded.sources]))
        if part.fill_range is not None and len(part.targets) == 1:
            key.slider_min, key.slider_max = (fill - 1 for fill in part.fill_range)
    if part.targets and part.weights is not None:
        times, weights = part.weights
        for key, values in zip(item.data.shape_keys.key_blocks[1:], weights.T):
            for index in _bends(values):
                key.value = values[index]
                key.keyframe_insert("value", frame=frame(times[index]))
        _interpolate(item.data.shape_keys, "LINEAR")
    if part.shown is not None:
        for time, shown in zip(*part.shown):
            item.hide_viewport = item.hide_render = not shown
            item.keyframe_insert("hide_viewport", frame=frame(time))
            item.keyframe_insert("hide_render", frame=frame(time))
        _interpolate(item, "CONSTANT")


def _bends(values):
    """Indices of the values that the straight line between their neighbours does not give; first and last, too."""
    straight = np.zeros(len(values), bool)
    straight[1:-1] = np.abs(2 * values[1:-1] - values[:-2] - values[2:]) < 1e-6
    return np.flatnonzero(~straight)


def _interpolate(animated, interpolation):
    for curve in animated.animation_data.action.fcurves:
        for key in curve.keyframe_points:
            key.interpolation = interpolation

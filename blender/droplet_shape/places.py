# SPDX-License-Identifier: GPL-3.0-or-later
"""Places: where a droplet lies, which way gravity points there, and the object it is laid on.

A frame is a matrix without scale: its z axis is the normal of the ground, its y axis the picture's upper edge.
"""

import math
from dataclasses import dataclass

import bmesh
import numpy as np
from mathutils import Matrix, Vector

from . import glb
from .command import DropletError, Input


_FILLED = 0.9  # of a face, by a droplet that is fitted to it


def unscaled(matrix):
    """Location and rotation of a matrix."""
    place, turn, _ = matrix.decompose()
    return Matrix.LocRotScale(place, turn, None)


def gravity(frame):
    """Tilt of the frame's ground and direction of downhill on it, counter-clockwise from its x axis [rad]."""
    down = frame.to_3x3().inverted() @ Vector((0, 0, -1))
    return math.acos(max(-1.0, min(1.0, -down.z))), math.atan2(down.y, down.x)


@dataclass(frozen=True)
class Face:
    frame: Matrix  # its middle and normal; y uphill, or north on level faces
    corners: np.ndarray  # (k, 2) in the frame

    def scale_for(self, points):
        """Factor by which points (n, 2) around the frame's origin fit into the face; the face counts as convex."""
        begins = self.corners
        along = np.roll(begins, -1, axis=0) - begins
        inward = np.stack((-along[:, 1], along[:, 0]), axis=1)
        reach = np.max(points @ -inward.T, axis=0)
        distance = -np.sum(inward * begins, axis=1)
        fits = (reach > 0) & (distance > 0)
        return _FILLED * float(np.min(distance[fits] / reach[fits]))


def selected_face(item, spin):
    """The active face of a mesh, or the first selected one, turned by the angle spin about its normal."""
    mesh = item.data
    if item.mode == "EDIT":
        faces = bmesh.from_edit_mesh(mesh).faces
        face = faces.active
        if face is None or not face.select:
            face = next((face for face in faces if face.select), None)
        corners = [vertex.co for vertex in face.verts] if face else None
    else:
        active = mesh.polygons.active
        face = mesh.polygons[active] if 0 <= active < len(mesh.polygons) else None
        if face is None or not face.select:
            face = next((face for face in mesh.polygons if face.select), None)
        corners = [mesh.vertices[index].co for index in face.vertices] if face else None
    if corners is None:
        raise DropletError(f"no face of {item.name!r} is selected")
    return _face([item.matrix_world @ corner for corner in corners], spin)


def _face(corners, spin):
    first = corners[0]
    pairs = list(zip(corners[1:], corners[2:]))
    normals = [(b - first).cross(c - first) for b, c in pairs]
    normal = sum(normals, Vector())
    if normal.length == 0:
        raise DropletError("the selected face has no area")
    shares = [part.dot(normal) for part in normals]
    middle = sum(((first + b + c) / 3 * share for (b, c), share in zip(pairs, shares)), Vector()) / sum(shares)
    z = normal.normalized()
    up = Vector((0, 0, 1)) - z * z.z
    if up.length < 1e-4:
        up = Vector((0, 1, 0)) - z * z.y
    y = Matrix.Rotation(spin, 3, z) @ up.normalized()
    frame = Matrix((y.cross(z), y, z)).transposed().to_4x4()
    frame.translation = middle
    inverse = frame.inverted()
    return Face(frame, np.array([(inverse @ corner)[:2] for corner in corners]))


@dataclass(frozen=True)
class Ground:
    """An object that droplets are laid on."""

    frame: Matrix
    file: Input  # in the frame, in metres


def _weights(mesh, group):
    """Weights of a vertex group, one per vertex."""
    return np.array([next((entry.weight for entry in vertex.groups if entry.group == group), 0.0)
                     for vertex in mesh.vertices], np.float32)


def shown_object(item, context, scale, needs_uv, group=""):
    """The object as it is shown, with its modifiers.

    scale:    units of the scene in a metre
    needs_uv: whether droplets are laid on it by its texture coordinates
    group:    name of a vertex group whose weights the file gets
    """
    if group and group not in item.vertex_groups:
        raise DropletError(f"{item.name!r} has no vertex group {group!r}")
    place = unscaled(item.matrix_world)
    shape = Matrix.Scale(1 / scale, 4) @ place.inverted() @ item.matrix_world
    shown = item.evaluated_get(context.evaluated_depsgraph_get())
    mesh = shown.to_mesh()
    try:
        has_uv = mesh.uv_layers.active is not None
        if needs_uv and not has_uv:
            raise DropletError(f"{item.name!r} has no texture coordinates; unwrap it first")
        mesh.transform(shape, shape_keys=False)
        if hasattr(mesh, "calc_normals_split"):  # before 4.1
            mesh.calc_normals_split()
            normals = mesh.loops, "normal"
        else:
            normals = mesh.corner_normals, "vector"
        mesh.calc_loop_triangles()

        def column(items, name, width, kind):
            values = np.empty(len(items) * width, kind)
            items.foreach_get(name, values)
            return values.reshape(-1, width)

        corner_vertices = column(mesh.loops, "vertex_index", 1, np.int32)
        rows = np.concatenate((
            column(mesh.vertices, "co", 3, np.float32)[corner_vertices[:, 0]],
            column(*normals, 3, np.float32),
            column(mesh.uv_layers.active.data, "uv", 2, np.float32) if has_uv
            else np.zeros((len(corner_vertices), 2), np.float32),
            _weights(mesh, item.vertex_groups[group].index)[corner_vertices] if group
            else np.zeros((len(corner_vertices), 1), np.float32),
        ), axis=1)
        triangles = column(mesh.loop_triangles, "loops", 3, np.int32)
    finally:
        shown.to_mesh_clear()
    if not len(triangles):
        raise DropletError(f"{item.name!r} has no faces")
    rows, numbers = np.unique(rows, axis=0, return_inverse=True)
    data = glb.write(rows[:, :3], rows[:, 3:6], rows[:, 6:8], numbers.reshape(-1)[triangles],
                     rows[:, 8] if group else None)
    return Ground(place, Input("object.glb", data))

# SPDX-License-Identifier: GPL-3.0-or-later
"""glTF 2.0 in binary form, as droplet-shape writes and reads it. Nothing here needs Blender.

glTF has +Y up and texture coordinates with the origin upper left. Everything else in this add-on has +Z up and the
origin lower left, as Blender does. Lengths are metres.
"""

import json
import struct
from dataclasses import dataclass, field

import numpy as np

_TYPES = {5121: "<u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


@dataclass(frozen=True)
class Look:
    """Material, by the terms of glTF."""

    name: str
    base_colour: tuple = (1.0, 1.0, 1.0, 1.0)
    metallic: float = 1.0
    roughness: float = 1.0
    transmission: float = 0.0
    ior: float = 1.5
    thickness: float = 0.0  # [m]
    attenuation_colour: tuple = (1.0, 1.0, 1.0)  # what is left of white light after attenuation_distance
    attenuation_distance: float | None = None  # [m]
    film_ior: float = 1.3
    film_thickness: float | None = None  # of a thin film on the surface [nm]


@dataclass(frozen=True)
class Part:
    """A mesh. Vertices on the rim are there twice: with the normal of the liquid and with that of the base."""

    name: str
    positions: np.ndarray  # (n, 3)
    normals: np.ndarray  # (n, 3)
    uvs: np.ndarray | None  # (n, 2)
    contact_angles: np.ndarray | None  # (n), degrees, 0 beside the rim
    triangles: np.ndarray  # (m, 3)
    targets: list = field(default_factory=list)  # (name, displacements (n, 3))
    fill_range: tuple | None = None  # lower and upper fill that the target "volume" spans
    weights: tuple | None = None  # times [s] (k), weights of the targets (k, len(targets))
    shown: tuple | None = None  # times [s] (k), whether the part is shown from then on (k)


@dataclass(frozen=True)
class Model:
    parts: list
    look: Look


def _z_up(vectors):
    return np.stack((vectors[:, 0], -vectors[:, 2], vectors[:, 1]), axis=1)


def _flipped(uvs):
    return np.stack((uvs[:, 0], 1 - uvs[:, 1]), axis=1)


def read(data):
    """Model in a file's bytes. Raises ValueError, KeyError or IndexError if they are no such file."""
    if len(data) < 12 or struct.unpack_from("<4sI", data) != (b"glTF", 2):
        raise ValueError("not a GLB file of version 2")
    chunks, at = {}, 12
    while at + 8 <= len(data):
        size, kind = struct.unpack_from("<I4s", data, at)
        chunks[kind] = memoryview(data)[at + 8:at + 8 + size]
        at += 8 + size
    scene = json.loads(bytes(chunks[b"JSON"]))

    def array(index):
        entry = scene["accessors"][index]
        view = scene["bufferViews"][entry["bufferView"]]
        kind, width = np.dtype(_TYPES[entry["componentType"]]), _WIDTHS[entry["type"]]
        start = view.get("byteOffset", 0) + entry.get("byteOffset", 0)
        stride = view.get("byteStride", kind.itemsize * width)
        values = np.ndarray((entry["count"], width), kind, chunks[b"BIN\0"], start, (stride, kind.itemsize))
        return values[:, 0] if width == 1 else values

    animated = {}
    for animation in scene.get("animations", []):
        for channel in animation["channels"]:
            sampler = animation["samplers"][channel["sampler"]]
            target = channel["target"]
            animated[target["node"], target["path"]] = array(sampler["input"]), array(sampler["output"])

    parts = []
    for index, node in enumerate(scene["nodes"]):
        if "mesh" not in node:
            continue
        mesh = scene["meshes"][node["mesh"]]
        (primitive,) = mesh["primitives"]
        attributes = primitive["attributes"]
        extras = mesh.get("extras", {})
        names = extras.get("targetNames", [])
        targets = [
            (names[i] if i < len(names) else f"target {i + 1}", _z_up(array(target["POSITION"])))
            for i, target in enumerate(primitive.get("targets", []))
        ]
        weights = animated.get((index, "weights"))
        if weights is not None:
            weights = weights[0], weights[1].reshape(len(weights[0]), len(targets))
        shown = animated.get((index, "scale"))
        if shown is not None:
            shown = shown[0], shown[1].any(axis=1)
        parts.append(Part(
            name=node.get("name", "droplet"),
            positions=_z_up(array(attributes["POSITION"])),
            normals=_z_up(array(attributes["NORMAL"])),
            uvs=_flipped(array(attributes["TEXCOORD_0"])) if "TEXCOORD_0" in attributes else None,
            contact_angles=array(attributes["_CONTACT_ANGLE"]) if "_CONTACT_ANGLE" in attributes else None,
            triangles=array(primitive["indices"]).astype(np.int32).reshape(-1, 3),
            targets=targets,
            fill_range=extras.get("fill_range"),
            weights=weights,
            shown=shown,
        ))
    return Model(parts, _look(scene["materials"][0]))


def _look(material):
    surface = material.get("pbrMetallicRoughness", {})
    extensions = material.get("extensions", {})
    volume = extensions.get("KHR_materials_volume", {})
    film = extensions.get("KHR_materials_iridescence", {})
    return Look(
        name=material.get("name", "water"),
        base_colour=tuple(surface.get("baseColorFactor", (1.0, 1.0, 1.0, 1.0))),
        metallic=surface.get("metallicFactor", 1.0),
        roughness=surface.get("roughnessFactor", 1.0),
        transmission=extensions.get("KHR_materials_transmission", {}).get("transmissionFactor", 0.0),
        ior=extensions.get("KHR_materials_ior", {}).get("ior", 1.5),
        thickness=volume.get("thicknessFactor", 0.0),
        attenuation_colour=tuple(volume.get("attenuationColor", (1.0, 1.0, 1.0))),
        attenuation_distance=volume.get("attenuationDistance"),
        film_ior=film.get("iridescenceIor", 1.3),
        film_thickness=film.get("iridescenceThicknessMaximum"),
    )


def write(positions, normals, uvs, triangles, weights=None):
    """Bytes of a file with one mesh, for --onto and dew."""
    columns = [
        (np.stack((positions[:, 0], positions[:, 2], -positions[:, 1]), axis=1), "<f4", "VEC3", 5126),
        (np.stack((normals[:, 0], normals[:, 2], -normals[:, 1]), axis=1), "<f4", "VEC3", 5126),
        (_flipped(uvs), "<f4", "VEC2", 5126),
        (triangles.reshape(-1), "<u4", "SCALAR", 5125),
    ]
    attributes = {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}
    if weights is not None:
        attributes["_WEIGHT"] = len(columns)
        columns.append((weights, "<f4", "SCALAR", 5126))
    body, views, accessors = b"", [], []
    for values, kind, shape, component in columns:
        part = np.ascontiguousarray(values, kind)
        views.append({"buffer": 0, "byteOffset": len(body), "byteLength": part.nbytes})
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": len(part), "type": shape})
        body += part.tobytes()
    low, high = (np.asarray(edge, np.float32).tolist() for edge in (columns[0][0].min(0), columns[0][0].max(0)))
    accessors[0] |= {"min": low, "max": high}
    head = json.dumps({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": 3}]}],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(body)}],
    }).encode()
    head += b" " * (-len(head) % 4)
    size = 12 + 8 + len(head) + 8 + len(body)
    return b"".join((struct.pack("<4sII", b"glTF", 2, size), struct.pack("<I4s", len(head), b"JSON"), head,
                     struct.pack("<I4s", len(body), b"BIN\0"), body))


@dataclass(frozen=True)
class Welded:
    """A part as a closed mesh: every vertex once; normals and uvs belong to the corners of triangles."""

    sources: np.ndarray  # (v) vertex of the part
    triangles: np.ndarray  # (m, 3)
    rim: np.ndarray  # (r) vertices of the part on the rim


def weld(part):
    """Joins the two copies of every vertex on the rim: vertices on open edges that have one place in all targets."""
    count = len(part.positions)
    edges = part.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).astype(np.int64)
    keys = np.sort(edges.min(axis=1) * count + edges.max(axis=1))
    differs = np.ones(len(keys) + 1, bool)
    differs[1:-1] = keys[1:] != keys[:-1]
    single = keys[differs[1:] & differs[:-1]]
    rim = np.unique(np.concatenate((single // count, single % count)))
    joined = np.arange(count)
    if len(rim):
        places = np.concatenate([part.positions[rim], *(shift[rim] for _, shift in part.targets)], axis=1)
        _, first, inverse = np.unique(places, axis=0, return_index=True, return_inverse=True)
        joined[rim] = rim[first[inverse.reshape(-1)]]
    kept = joined == np.arange(count)
    numbers = np.cumsum(kept) - 1
    return Welded(np.flatnonzero(kept), numbers[joined[part.triangles]].astype(np.int32), rim)

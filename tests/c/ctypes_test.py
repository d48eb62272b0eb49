#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The C interface from Python's ctypes, as other languages bind to it: ctypes_test.py LIBRARY"""
import ctypes
import math
import sys
from ctypes import POINTER, Structure, byref, c_char_p, c_double, c_float, c_int, c_int32, c_size_t, c_uint8, c_uint16, c_uint32, c_uint64, c_void_p

library = ctypes.CDLL(sys.argv[1])


class Mask(Structure):
    _fields_ = [("coverage", POINTER(c_uint8)), ("width", c_int32), ("height", c_int32)]


class Mesh(Structure):
    _fields_ = [("vertices", c_size_t), ("positions", POINTER(c_float)), ("normals", POINTER(c_float)),
                ("uvs", POINTER(c_float)), ("contact_angles", POINTER(c_float)), ("triangles", c_size_t),
                ("indices", POINTER(c_uint32))]


class Figures(Structure):
    _fields_ = [(name, c_double) for name in ("time", "speed", "width", "height")] + [
        (name, c_uint64) for name in ("running", "still", "raindrops")]


class Water(Structure):
    _fields_ = [("volume", c_double), ("balance_error", c_double)]


class Place(Structure):
    _fields_ = [(name, c_double * 3) for name in ("point", "normal", "across", "up")]


class Corner(Structure):
    _fields_ = [("x", c_double), ("y", c_double), ("place", Place)]


class Triangles(Structure):
    _fields_ = [("corners", POINTER(Corner)), ("count", c_size_t)]


class Tile(Structure):
    _fields_ = [("x", c_int32), ("y", c_int32), ("width", c_int32), ("height", c_int32)]


class Tiles(Structure):
    _fields_ = [("list", POINTER(Tile)), ("count", c_size_t)]


def function(name, *arguments, result=c_int):
    found = getattr(library, name)
    found.argtypes = arguments
    found.restype = result
    return found


message = function("droplet_message", result=c_char_p)


def check(code):
    assert code == 0, message().decode()


of_mask = function("droplet_shape_of_mask", POINTER(Mask), POINTER(c_char_p), c_size_t, POINTER(c_void_p))
mesh_of = function("droplet_shape_mesh", c_void_p, POINTER(Mesh))
delete_shape = function("droplet_shape_delete", c_void_p, result=None)
side = 60
coverage = (c_uint8 * (side * side))(*[255 * (math.hypot(k % side - 29.5, k // side - 29.5) < 25.0) for k in range(side * side)])
words = (c_char_p * 4)(b"--volume", b"5uL", b"--width", b"6mm")
shape = c_void_p()
check(of_mask(byref(Mask(coverage, side, side)), words, 4, byref(shape)))
mesh = Mesh()
check(mesh_of(shape, byref(mesh)))
heights = [mesh.positions[3 * k + 2] for k in range(mesh.vertices)]
assert mesh.triangles > 1000 and 0.0 < max(heights) < 3e-3, max(heights)
delete_shape(shape)
words = (c_char_p * 1)(b"--nothing")
assert of_mask(byref(Mask(coverage, side, side)), words, 1, byref(shape)) == 2
assert "--nothing" in message().decode()

new = function("droplet_windshield_new", c_char_p, POINTER(c_void_p))
set_value = function("droplet_windshield_set", c_void_p, c_char_p, c_double)
advance = function("droplet_windshield_advance", c_void_p, c_double)
map_height = function("droplet_windshield_map_height", c_void_p, c_int32, POINTER(c_int32))
draw = function("droplet_windshield_draw", c_void_p, c_int32, POINTER(c_uint16), POINTER(Tiles))
figures_of = function("droplet_windshield_figures", c_void_p, POINTER(Figures))
water_of = function("droplet_windshield_water", c_void_p, POINTER(Water))
delete = function("droplet_windshield_delete", c_void_p, result=None)
rain = c_void_p()
check(new(b"figure-3.10", byref(rain)))
check(set_value(rain, b"rain", 25.0 / 3.6e6))
height = c_int32()
check(map_height(rain, 1024, byref(height)))
pixels = (c_uint16 * (4 * 1024 * height.value))()
changed = []
for _ in range(30):
    check(advance(rain, 1.0 / 60.0))
    tiles = Tiles()
    check(draw(rain, 1024, pixels, byref(tiles)))
    changed.append(tiles.count)
assert changed[0] == math.ceil(height.value / 32) * 32 and 0 < changed[1] < changed[0], changed
figures = Figures()
check(figures_of(rain, byref(figures)))
water = Water()
check(water_of(rain, byref(water)))
assert abs(figures.time - 0.5) < 1e-12 and figures.raindrops > 100 and abs(water.balance_error) < 1e-12
assert any(pixels)
delete(rain)

# Rain on a mesh: a flat pane of 0.3 m by 0.2 m.
surface = function("droplet_windshield_surface", c_void_p, POINTER(Mesh))
triangles_of = function("droplet_windshield_triangles", c_void_p, POINTER(Triangles))
corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 2 / 3), (0.0, 2 / 3)]
tilt = math.sqrt(0.5)
positions = (c_float * 12)(*[value for u, v in corners for value in (0.3 * u, (0.2 - 0.3 * v) * tilt, (0.2 - 0.3 * v) * tilt)])
normals = (c_float * 12)(*[0.0, -tilt, tilt] * 4)
uvs = (c_float * 8)(*[value for corner in corners for value in corner])
pane = Mesh(4, positions, normals, uvs, None, 2, (c_uint32 * 6)(0, 3, 2, 0, 2, 1))
rain = c_void_p()
check(new(None, byref(rain)))
check(surface(rain, byref(pane)))
check(figures_of(rain, byref(figures)))
assert abs(figures.width - 0.3) < 1e-6 and abs(figures.height - 0.2) < 1e-6, (figures.width, figures.height)
triangles = Triangles()
check(triangles_of(rain, byref(triangles)))
assert triangles.count == 2
for k in range(6):
    corner = triangles.corners[k]
    assert abs(corner.place.point[2] - corner.y * tilt) < 1e-6 and abs(corner.place.normal[2] - tilt) < 1e-6
check(advance(rain, 1.0 / 60.0))
assert surface(rain, byref(pane)) == 2 and "mesh" in message().decode()
delete(rain)

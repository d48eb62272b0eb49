# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the Blender add-on.

    blender --background --factory-startup --python-exit-code 1 --python tests/blender/addon_test.py -- \\
        PROGRAM [TEST...]

PROGRAM is the command droplet-shape. TEST is a name such as Sources.test_svg; without any, all run.
"""

import json
import math
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "blender"))
sys.dont_write_bytecode = True

import addon_utils
import bmesh
import bpy
import numpy as np

np.bool = bool  # Blender 3.4's importer of glTF needs it; numpy 1.24 has left it out
from mathutils import Matrix, Vector
from mathutils.bvhtree import BVHTree

ARGUMENTS = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
if not ARGUMENTS:
    raise SystemExit("addon_test.py: the path of droplet-shape is missing after --")
PROGRAM = os.path.abspath(ARGUMENTS[0])
DATA = ROOT / "data"
ADDON = addon_utils.enable("droplet_shape", default_set=True)
PREFERENCES = bpy.context.preferences.addons["droplet_shape"].preferences

FAST = {"model": "linear", "triangles": 3000}


def defaults(operator):
    """Settings of an operator that has not run before: Blender keeps those of the last run."""
    kept = {}
    for setting in operator.get_rna_type().properties:
        if setting.identifier in {"rna_type", "location", "files"} or setting.is_hidden:
            continue
        if setting.type != "COLLECTION":
            kept[setting.identifier] = (
                tuple(setting.default_array) if getattr(setting, "is_array", False) else setting.default)
    return kept


def columns(items, name, width=1, kind=np.float32):
    values = np.empty(len(items) * width, kind)
    items.foreach_get(name, values)
    return values.reshape(-1, width) if width > 1 else values


def corner_normals(mesh):
    if hasattr(mesh, "calc_normals_split"):  # before 4.1
        mesh.calc_normals_split()
        return columns(mesh.loops, "normal", 3)
    return columns(mesh.corner_normals, "vector", 3)


def solid(item, evaluated=False):
    """Mesh of an object in its own units, as a bmesh."""
    shape = bmesh.new()
    if evaluated:
        shape.from_object(item, bpy.context.evaluated_depsgraph_get())
    else:
        shape.from_mesh(item.data)
    return shape


def volume_of(item, evaluated=False):
    shape = solid(item, evaluated)
    try:
        return shape.calc_volume(signed=True)
    finally:
        shape.free()


def world_points(item):
    return np.array([item.matrix_world @ vertex.co for vertex in item.data.vertices])


def centroid(item):
    """Centre of the volume, in the world."""
    points = world_points(item)
    middle = points.mean(axis=0)
    triangles = columns(item.data.polygons, "vertices", 3, np.int32)
    a, b, c = (points[triangles[:, i]] - middle for i in range(3))
    volumes = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6
    return middle + ((a + b + c) / 4 * volumes[:, None]).sum(axis=0) / volumes.sum()


def words_of(option, *command):
    """Words that the command allows for an option."""
    told = json.loads(subprocess.run([PROGRAM, *command, "--help=json"], check=True, capture_output=True).stdout)
    (found,) = (one for one in told["options"] if one["name"] == option)
    return found["words"]


class AddonTest(unittest.TestCase):
    def setUp(self):
        if bpy.context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        for collection in (bpy.data.objects, bpy.data.meshes, bpy.data.curves, bpy.data.materials, bpy.data.images,
                           bpy.data.actions):
            for item in list(collection):
                collection.remove(item)
        bpy.context.scene.cursor.matrix = Matrix()
        PREFERENCES.program = PROGRAM
        PREFERENCES.timeout = 600
        ADDON.command.forget()
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.disc = self.picture("disc.png", lambda x, y: x * x + y * y < 0.8**2)

    def picture(self, name, inside, size=256):
        """Path of a mask of what is inside; x and y go from -1 to 1, y up. Each pixel has the share of 16 points."""
        places = (np.arange(4 * size) + 0.5) / (2 * size) - 1
        x, y = np.meshgrid(places, -places)
        share = inside(x, y).reshape(size, 4, size, 4).mean(axis=(1, 3))
        path = os.path.join(self.folder.name, name)
        rows = np.zeros((size, size + 1), np.uint8)  # each row begins with its filter: none
        rows[:, 1:] = np.rint(255 * share)
        Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
            for kind, data in ((b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 0, 0, 0, 0)),
                               (b"IDAT", zlib.compress(rows.tobytes())), (b"IEND", b""))))
        return path

    def droplet(self, **settings):
        operator = bpy.ops.mesh.droplet_add
        self.assertEqual(operator("EXEC_DEFAULT", True, **defaults(operator) | settings), {"FINISHED"})
        return bpy.context.object

    def refused(self, **settings):
        """The message of an operator that fails and changes nothing."""
        before = self.state()
        with self.assertRaises(RuntimeError) as caught:
            bpy.ops.mesh.droplet_add("EXEC_DEFAULT", True, **defaults(bpy.ops.mesh.droplet_add) | settings)
        self.assertEqual(self.state(), before)
        message = str(caught.exception)
        self.assertNotIn("Traceback", message)
        self.assertEqual(len(message.strip().splitlines()), 1, message)
        return message

    def state(self):
        return [sorted(item.name for item in collection) for collection in (
            bpy.data.objects, bpy.data.meshes, bpy.data.curves, bpy.data.materials)], bpy.context.mode

    def report(self, footprint, *options):
        """What the command itself says about a droplet."""
        output = os.path.join(self.folder.name, "reference.glb")
        done = subprocess.run([PROGRAM, footprint, output, *options, "--json", "-", "--quiet"],
                              check=True, capture_output=True)
        return json.loads(done.stdout)

    def text(self, body, **settings):
        bpy.ops.object.text_add(**settings)
        bpy.context.object.data.body = body
        bpy.context.view_layer.update()
        return bpy.context.object

    def assertClosed(self, item):
        shape = solid(item)
        self.assertTrue(shape.edges)
        self.assertEqual([edge.index for edge in shape.edges if len(edge.link_faces) != 2], [])
        self.assertEqual([edge.index for edge in shape.edges if not edge.is_contiguous], [])
        self.assertGreater(shape.calc_volume(signed=True), 0)
        shape.free()

    def euler(self, item):
        return len(item.data.vertices) - len(item.data.edges) + len(item.data.polygons)


class Dew(AddonTest):
    def cover(self, item, **given):
        for other in bpy.context.selected_objects:
            other.select_set(False)
        item.select_set(True)
        bpy.context.view_layer.objects.active = item
        settings = {**defaults(bpy.ops.mesh.droplet_dew_add), "scale": 20.0, **given}
        self.assertEqual(bpy.ops.mesh.droplet_dew_add(**settings), {"FINISHED"})
        (dew,) = (other for other in bpy.data.objects if other.name.startswith("Dew") and other.select_get())
        return dew

    def monkey(self):
        bpy.ops.mesh.primitive_monkey_add(size=2, location=(1, 2, 3), rotation=(0.3, 0.2, 0.5))
        return bpy.context.active_object

    def test_droplets_sit_on_the_object_and_are_closed(self):
        monkey = self.monkey()
        dew = self.cover(monkey, coverage=0.2, largest=1.5, smallest=0.5)
        self.assertEqual(dew.parent, monkey)
        shape = solid(dew)
        self.assertTrue(all(edge.is_manifold for edge in shape.edges))
        shape.free()
        self.assertGreater(volume_of(dew), 0)
        tree = BVHTree.FromObject(monkey, bpy.context.evaluated_depsgraph_get())
        inverse = monkey.matrix_world.inverted()
        away = [tree.find_nearest(inverse @ Vector(point))[3] for point in world_points(dew)]
        # Units of the scene: a droplet of 1.5 mm is 0.03 units wide at the scale 20, and at most as high as wide.
        self.assertLess(max(away), 0.08)
        self.assertLess(np.quantile(away, 0.2), 1.5e-3, "bases and rims are on the object")
        (material,) = dew.data.materials
        self.assertIn("water", material.name)

    def test_droplets_are_where_the_vertex_group_is(self):
        bpy.ops.mesh.primitive_uv_sphere_add(radius=1)
        ball = bpy.context.active_object
        group = ball.vertex_groups.new(name="wet")
        group.add([vertex.index for vertex in ball.data.vertices if vertex.co.x > 0.1], 1.0, "REPLACE")
        ball.modifiers.new("finer", "SUBSURF").levels = 1  # weights go through modifiers
        places = world_points(self.cover(ball, coverage=0.2, smallest=0.5, largest=1, vertex_group="wet"))
        self.assertGreater(places[:, 0].min(), -0.2)
        self.assertGreater(places[:, 1].max() - places[:, 1].min(), 1)
        with self.assertRaisesRegex(RuntimeError, "no vertex group 'dry'"):
            self.cover(ball, vertex_group="dry")

    def test_rain_comes_from_above_in_the_world(self):
        bpy.ops.mesh.primitive_uv_sphere_add(radius=1, location=(5, 0, 0), rotation=(2, 1, 0))
        ball = bpy.context.active_object
        self.assertGreater(world_points(self.cover(ball, preset="rain", coverage=0.1))[:, 2].min(), -0.15)
        above = self.cover(ball, preset="rain", coverage=0.1, use_gravity=False)
        self.assertGreater(world_points(above)[:, 2].min(), -0.15)

    def test_size_of_droplets_is_real(self):
        bpy.ops.mesh.primitive_plane_add(size=2)
        plane = bpy.context.active_object
        small = self.cover(plane, coverage=0.1, smallest=1, largest=1, scale=20)
        large = self.cover(plane, coverage=0.1, smallest=1, largest=1, scale=40)
        # At the scale 20 the plane is 10 cm wide.
        one = 20**3 * math.pi * 1e-9  # of the order of a droplet of 1 mm
        count = lambda item: volume_of(item) * item.matrix_world.to_scale()[0]**3
        self.assertGreater(count(small) / one, 50)
        self.assertLess(count(small) / count(large), 0.8, "fewer and larger ones, seen from afar")

    def test_messages(self):
        monkey = self.monkey()
        with self.assertRaisesRegex(RuntimeError, "--coverage|more than 1000000"):
            self.cover(monkey, smallest=0.011, largest=0.011, scale=0.1)
        with self.assertRaisesRegex(RuntimeError, "unknown option --wet"):
            self.cover(monkey, options="--wet")
        bpy.ops.object.select_all(action="DESELECT")
        bpy.context.view_layer.objects.active = None
        with self.assertRaisesRegex(RuntimeError, "select the mesh"):
            bpy.ops.mesh.droplet_dew_add()

    def test_kinds_are_those_of_the_command(self):
        kinds = bpy.ops.mesh.droplet_dew_add.get_rna_type().properties["preset"].enum_items.keys()
        self.assertEqual(list(kinds), words_of("--preset", "dew"))

    def test_speed(self):
        monkey = self.monkey()
        self.cover(monkey, coverage=0.25, smallest=0.7, largest=1.5)
        begin = time.perf_counter()
        dew = self.cover(monkey, coverage=0.25, smallest=0.7, largest=1.5, seed=2)
        print(f"dew: {len(dew.data.polygons)} triangles in {time.perf_counter() - begin:.2f} s")


class Mesh(AddonTest):
    def test_dimensions_and_volume_are_those_of_the_report(self):
        for model in ("linear", "exact", "auto"):
            with self.subTest(model=model):
                path = str(DATA / "ampersand.png")
                item = self.droplet(filepath=path, model=model, width=30, scale=50)
                report = self.report(path, "--width", "30mm", "--model", model)
                self.assertEqual(len(item.data.polygons), report["output"]["triangles"])
                self.assertAlmostEqual(volume_of(item) / report["shape"]["volume_m3"], 1, delta=2e-3)
                self.assertAlmostEqual(item.dimensions.z / 50 / report["shape"]["height_max_m"], 1, delta=1e-5)
                self.assertEqual(self.euler(item), report["output"]["euler"])
                self.assertClosed(item)

    def test_a_disc_has_its_size_and_place(self):
        item = self.droplet(filepath=self.disc, width=10, scale=200, location=(3, 4, 5), sink=0.05, **FAST)
        self.assertAlmostEqual(item.dimensions.x, 0.8 * 2, delta=4e-3)
        self.assertAlmostEqual(item.dimensions.y, 0.8 * 2, delta=4e-3)
        low, high = world_points(item).min(axis=0), world_points(item).max(axis=0)
        np.testing.assert_allclose((low + high)[:2] / 2, (3, 4), atol=2e-3)
        self.assertAlmostEqual(low[2], 5 - 0.05e-3 * 200, delta=1e-5)

    def test_each_amount_reaches_the_command(self):
        item = self.droplet(filepath=self.disc, fill="VOLUME", volume=20, triangles=20000)
        self.assertAlmostEqual(volume_of(item) * 1e9, 20, delta=0.02)
        item = self.droplet(filepath=self.disc, fill="HEIGHT", height=1.25, scale=1000)
        self.assertAlmostEqual(item.dimensions.z, 1.25, delta=1e-3)
        low = self.droplet(filepath=self.disc, fill="ANGLE", contact_angle=math.radians(20))
        high = self.droplet(filepath=self.disc, fill="ANGLE", contact_angle=math.radians(60))
        self.assertGreater(volume_of(high), 2 * volume_of(low))

    def test_more_options_reach_the_command(self):
        plain = self.droplet(filepath=self.disc, **FAST)
        inverted = self.droplet(filepath=self.disc, options="--invert", **FAST)
        self.assertEqual(self.euler(plain), 2)
        self.assertEqual(self.euler(inverted), 0)  # a square with a hole

    def test_the_fill_range_is_a_shape_key(self):
        item = self.droplet(filepath=self.disc, fill="VOLUME", volume=10, options="--fill-range 0.5..2", **FAST)
        (key,) = item.data.shape_keys.key_blocks[1:]
        self.assertEqual((key.slider_min, key.slider_max), (-0.5, 1))
        for value in (-0.5, 0, 1):
            key.value = value
            self.assertAlmostEqual(volume_of(item, evaluated=True) * 1e9, 10 * (1 + value), delta=0.1)

    def test_normals_point_outward_and_the_rim_is_crisp(self):
        item = self.droplet(filepath=self.disc, fill="ANGLE", contact_angle=math.radians(50), triangles=20000,
                            model="exact")
        mesh = item.data
        normals = corner_normals(mesh)
        faces = np.repeat(columns(mesh.polygons, "normal", 3), 3, axis=0)
        np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-3)
        self.assertGreater(np.einsum("ij,ij->i", normals, faces).min(), 0.9)

        vertices = columns(mesh.loops, "vertex_index", kind=np.int32)
        angles = columns(mesh.attributes["contact_angle"].data, "value")[vertices]
        rim = angles > 0
        self.assertGreater(rim.sum(), 100)
        liquid = rim & (faces[:, 2] > 0)
        base = faces[:, 2] < -0.999
        np.testing.assert_allclose(normals[base], np.tile((0, 0, -1), (base.sum(), 1)), atol=1e-3)
        # On the rim of a disc, the normal of the liquid leans outward by the contact angle.
        tilt = np.degrees(np.arccos(np.clip(normals[liquid, 2], -1, 1)))
        np.testing.assert_allclose(tilt, angles[liquid], atol=0.2)
        np.testing.assert_allclose(tilt, 50, atol=1.5)
        self.assertEqual(set(vertices[liquid]), set(vertices[rim & base]))

    def test_texture_coordinates_are_those_of_the_picture(self):
        item = self.droplet(filepath=self.disc, width=20, **FAST)
        vertices = columns(item.data.loops, "vertex_index", kind=np.int32)
        places = columns(item.data.vertices, "co", 3)[vertices, :2]
        uvs = columns(item.data.uv_layers.active.data, "uv", 2)
        np.testing.assert_allclose(uvs, places / 20e-3 + 0.5, atol=1e-5)

    def test_many_droplets_are_closed(self):
        item = self.droplet(filepath=str(DATA / "dew.png"), triangles=20000)
        self.assertClosed(item)
        self.assertGreater(self.euler(item), 1000)  # 2 for each droplet

    def test_curved_ground_is_closed(self):
        item = self.droplet(filepath=self.disc, options="--surface sphere:R=30mm", **FAST)
        self.assertClosed(item)


class Look(AddonTest):
    def principled(self, item, target):
        (material,) = item.data.materials
        output = material.node_tree.get_output_node(target)
        node = output.inputs["Surface"].links[0].from_node
        if node.type == "MIX_SHADER":  # of clear shadows
            node = node.inputs[1].links[0].from_node
        self.assertEqual(node.type, "BSDF_PRINCIPLED")
        transmission = node.inputs.get("Transmission Weight") or node.inputs["Transmission"]
        return node, transmission.default_value, output

    def test_water_is_clear_in_cycles_and_eevee(self):
        item = self.droplet(filepath=self.disc, **FAST)
        for target in ("CYCLES", "EEVEE"):
            node, transmission, output = self.principled(item, target)
            self.assertEqual(transmission, 1)
            self.assertAlmostEqual(node.inputs["IOR"].default_value, 1.333, places=5)
            self.assertEqual(node.inputs["Roughness"].default_value, 0)
            self.assertEqual(node.inputs["Metallic"].default_value, 0)
            self.assertFalse(output.inputs["Volume"].links)
        if bpy.app.version < (4, 2, 0):
            self.assertTrue(item.data.materials[0].use_screen_refraction)
            self.assertTrue(bpy.context.scene.eevee.use_ssr and bpy.context.scene.eevee.use_ssr_refraction)

    def test_ink_absorbs_light_by_its_real_thickness(self):
        densities = []
        for scale in (100, 200):
            item = self.droplet(filepath=self.disc, look="ink", scale=scale, **FAST)
            _, _, output = self.principled(item, "CYCLES")
            volume = output.inputs["Volume"].links[0].from_node
            colour, density = volume.inputs["Color"].default_value, volume.inputs["Density"].default_value
            densities.append(density)
            # Light that passes the mean thickness down to the ground and up again has the material's colour.
            thickness = volume_of(item) / (math.pi * 8e-3**2) * scale
            kept = [math.exp(-2 * density * (1 - channel) * thickness) for channel in colour[:3]]
            np.testing.assert_allclose(kept, (0.03, 0.06, 0.35), atol=0.06)
            node, _, output = self.principled(item, "EEVEE")
            self.assertFalse(output.inputs["Volume"].links)
            np.testing.assert_allclose(tuple(node.inputs["Base Color"].default_value)[:3], (0.03, 0.06, 0.35),
                                       rtol=1e-3)
        self.assertAlmostEqual(densities[0] / densities[1], 2, places=4)

    def test_every_look_of_the_command(self):
        looks = {}
        for name in words_of("--material"):
            item = self.droplet(filepath=self.disc, look=name, **FAST)
            node, transmission, _ = self.principled(item, "CYCLES" if name != "plain" else "ALL")
            looks[name] = (tuple(node.inputs["Base Color"].default_value)[:3], node.inputs["Metallic"].default_value,
                           round(node.inputs["Roughness"].default_value, 6), round(transmission, 6), round(node.inputs["IOR"].default_value, 6))
        self.assertEqual(looks["gold"][1], 1)
        self.assertEqual(looks["frosted"][2:4], (0.35, 0.8))
        self.assertEqual(looks["lacquer"][3], 0)
        self.assertEqual(looks["ice"][3], 0.9)

    def test_shadows_are_clear_unless_caustics_are_wanted(self):
        for clear in (True, False):
            item = self.droplet(filepath=self.disc, clear_shadows=clear, **FAST)
            output = item.data.materials[0].node_tree.get_output_node("CYCLES")
            self.assertEqual(output.inputs["Surface"].links[0].from_node.type == "MIX_SHADER", clear)
            self.assertEqual(item.cycles.is_caustics_caster, not clear)
        level, grain = self.light_below(True)
        self.assertGreater(level, 0.7)
        self.assertLess(grain, 0.05)
        self.assertGreater(self.light_below(False)[1], 0.5)

    def light_below(self, clear):
        """Light on the ground below a droplet, seen from above in Cycles, over that of open ground; and its deviation
        between pixels, over itself."""
        self.setUp()
        self.droplet(filepath=self.disc, clear_shadows=clear, **FAST)
        bpy.ops.mesh.primitive_plane_add(size=10)
        bpy.ops.object.light_add(type="SUN", rotation=(0.3, 0, 0))
        bpy.context.object.data.energy = 1
        bpy.ops.object.camera_add(location=(0, 0, 5))
        bpy.context.object.data.type, bpy.context.object.data.ortho_scale = "ORTHO", 3
        scene = bpy.context.scene
        scene.camera, scene.render.engine, scene.cycles.samples = bpy.context.object, "CYCLES", 32
        scene.cycles.use_denoising, scene.world.use_nodes = False, False
        scene.world.color = 0, 0, 0
        scene.render.resolution_x = scene.render.resolution_y = 32
        scene.render.filepath, scene.render.image_settings.file_format = self.folder.name + "/seen.exr", "OPEN_EXR"
        bpy.ops.render.render(write_still=True)
        seen = bpy.data.images.load(scene.render.filepath)
        level = np.array(seen.pixels[:]).reshape(32, 32, 4)[..., 0]
        below = level[12:20, 12:20]
        return below.mean() / level[1:3, 1:3].mean(), below.std() / below.mean()

    def test_imported_files_get_clear_shadows(self):
        self.droplet(filepath=self.disc, **FAST)
        subprocess.run([PROGRAM, self.disc, self.folder.name + "/water.glb", "--model", "linear", "--triangles", "3k", "--quiet"], check=True)
        bpy.ops.import_scene.gltf(filepath=self.folder.name + "/water.glb")
        self.assertEqual(bpy.ops.object.droplet_clear_shadows(), {"FINISHED"})
        (material,) = bpy.context.selected_objects[0].data.materials
        mixed = [node for node in material.node_tree.nodes if node.type == "MIX_SHADER"]
        self.assertEqual(len(mixed), 1)
        self.assertTrue(material.use_screen_refraction)
        bpy.ops.object.droplet_clear_shadows()  # a second time changes nothing
        self.assertEqual(sum(node.type == "MIX_SHADER" for node in material.node_tree.nodes), 1)

    def test_mercury_is_metal(self):
        item = self.droplet(filepath=self.disc, liquid="mercury", fill="ANGLE", contact_angle=math.radians(60), **FAST)
        node, transmission, _ = self.principled(item, "ALL")
        self.assertEqual((node.inputs["Metallic"].default_value, transmission), (1, 0))

    def test_equal_looks_share_a_material(self):
        first, second = (self.droplet(filepath=str(DATA / "dew.png"), location=(x, 0, 0), **FAST) for x in (0, 3))
        self.assertEqual(first.data.materials[0], second.data.materials[0])
        self.assertNotEqual(first.data, second.data)


class Undo(AddonTest):
    def objects(self):
        return sorted(item.name for item in bpy.data.objects)

    def test_undo_removes_the_droplet_and_redo_brings_it_back(self):
        self.text("o")
        bpy.ops.ed.undo_push(message="before")
        self.droplet(source="OBJECT", **FAST)
        self.assertEqual(self.objects(), ["Droplet", "Text"])
        self.assertTrue(bpy.data.objects["Text"].hide_get())
        bpy.ops.ed.undo()
        self.assertEqual(self.objects(), ["Text"])
        self.assertFalse(bpy.data.objects["Text"].hide_get())
        bpy.ops.ed.redo()
        self.assertEqual(self.objects(), ["Droplet", "Text"])
        self.assertClosed(bpy.data.objects["Droplet"])

    def change(self, **settings):
        """Does what the redo panel does."""
        for name, value in settings.items():
            setattr(bpy.context.window_manager.operators[-1], name, value)
        return bpy.ops.ed.undo_redo("EXEC_DEFAULT", True)

    def test_the_redo_panel_replaces_the_droplet(self):
        bpy.ops.ed.undo_push(message="before")
        self.droplet(filepath=self.disc, fill="VOLUME", volume=10, **FAST)
        for volume in (20, 30):
            self.change(volume=volume)
            self.assertEqual(self.objects(), ["Droplet"])
            self.assertEqual(len(bpy.data.meshes), 1)
            self.assertAlmostEqual(volume_of(bpy.data.objects["Droplet"]) * 1e9, volume, delta=0.01 * volume)
        self.change(width=40, fill="ANGLE", contact_angle=math.radians(30))
        self.assertEqual(self.objects(), ["Droplet"])
        self.assertAlmostEqual(bpy.data.objects["Droplet"].dimensions.x, 0.8 * 4, delta=0.01)
        bpy.ops.ed.undo()
        self.assertEqual(self.objects(), [])

    def test_an_error_in_the_redo_panel_keeps_the_last_droplet(self):
        bpy.ops.ed.undo_push(message="before")
        self.droplet(filepath=self.disc, fill="VOLUME", volume=10, **FAST)
        self.change(options="--no-such-option")
        self.assertEqual(self.objects(), ["Droplet"])
        self.assertAlmostEqual(volume_of(bpy.data.objects["Droplet"]) * 1e9, 10, delta=0.1)

    def test_undo_returns_to_edit_mode(self):
        bpy.ops.mesh.primitive_plane_add()
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.ed.undo_push(message="before")
        self.droplet(filepath=self.disc, place="FACE", **FAST)
        self.assertEqual((self.objects(), bpy.context.mode), (["Droplet", "Plane"], "OBJECT"))
        self.assertEqual(bpy.data.objects["Plane"].mode, "OBJECT")
        bpy.ops.ed.undo()
        self.assertEqual((self.objects(), bpy.context.mode), (["Plane"], "EDIT_MESH"))
        self.droplet(filepath=self.disc, place="FACE", **FAST)
        self.assertEqual(self.objects(), ["Droplet", "Plane"])

    def test_a_change_of_place_does_not_run_the_command_again(self):
        self.droplet(filepath=self.disc, **FAST)
        PREFERENCES.timeout = 600
        stored = ADDON.command._last
        self.droplet(filepath=self.disc, location=(1, 2, 3), scale=10, **FAST)
        self.assertIs(ADDON.command._last, stored)
        self.picture("disc.png", lambda x, y: x * x + y * y < 0.5**2)
        item = self.droplet(filepath=self.disc, **FAST)
        self.assertIsNot(ADDON.command._last, stored)
        self.assertAlmostEqual(item.dimensions.x, 1, delta=0.01)


class Sources(AddonTest):
    def test_picture(self):
        item = self.droplet(filepath=str(DATA / "ampersand.png"), **FAST)
        self.assertEqual(self.euler(item), 0)
        self.assertClosed(item)

    def test_svg(self):
        item = self.droplet(filepath=str(DATA / "ring.svg"), **FAST)
        self.assertEqual(self.euler(item), 0)
        self.assertClosed(item)

    def test_painted_image(self):
        for channels in (3, 4):
            with self.subTest(channels=channels):
                image = bpy.data.images.new("painted", 200, 100, alpha=channels == 4)
                pixels = np.zeros((100, 200, 4), np.float32)
                pixels[..., 3] = 1
                pixels[60:90, 20:60, :3] = 1  # rows go up
                image.pixels.foreach_set(pixels.reshape(-1))
                item = self.droplet(source="IMAGE", image=image.name, width=20, scale=1000, **FAST)
                points = world_points(item)
                np.testing.assert_allclose(points.min(axis=0)[:2], (-8, 1), atol=0.1)
                np.testing.assert_allclose(points.max(axis=0)[:2], (-4, 4), atol=0.1)

    def test_image_of_a_file_and_packed(self):
        image = bpy.data.images.load(str(DATA / "ampersand.png"))
        loaded = self.droplet(source="IMAGE", image=image.name, **FAST)
        image.pack()
        packed = self.droplet(source="IMAGE", image=image.name, **FAST)
        self.assertEqual(self.euler(packed), 0)
        self.assertAlmostEqual(volume_of(packed) / volume_of(loaded), 1, delta=1e-3)

    def test_text_with_a_hole_lies_where_the_text_does(self):
        text = self.text("Bo", location=(1, 2, 3), rotation=(0.3, 0.2, 0.5))
        text.data.extrude = text.data.bevel_depth = 0.05
        item = self.droplet(source="OBJECT", width=15, triangles=10000, model="linear")
        self.assertClosed(item)
        self.assertEqual(self.euler(item), -2)  # B, closed, with two holes: -2; o: 0
        self.assertTrue(text.hide_get() and text.hide_render)
        text.data.extrude = text.data.bevel_depth = 0
        bpy.context.view_layer.update()
        outline = np.array([text.matrix_world.inverted() @ item.matrix_world @ vertex.co
                            for vertex in item.data.vertices])
        corners = np.array(text.bound_box)
        np.testing.assert_allclose(outline.min(axis=0)[:2], corners.min(axis=0)[:2], atol=3e-3)
        np.testing.assert_allclose(outline.max(axis=0)[:2], corners.max(axis=0)[:2], atol=3e-3)
        points = columns(item.data.vertices, "co", 3)
        self.assertAlmostEqual(np.ptp(points[:, 0]), 15e-3, delta=5e-5)

    def test_letters_that_overlap_stay_filled(self):
        text = self.text("oo")
        text.data.space_character = 0.75
        item = self.droplet(source="OBJECT", triangles=10000, model="linear")
        self.assertEqual(self.euler(item), -2)  # one body with two holes

    def test_curve(self):
        bpy.ops.curve.primitive_bezier_circle_add(radius=2, location=(5, 0, 1))
        item = self.droplet(source="OBJECT", width=10, hide_source=False, **FAST)
        self.assertFalse(bpy.data.objects["BezierCircle"].hide_get())
        points = world_points(item)
        np.testing.assert_allclose(points.min(axis=0)[:2], (3, -2), atol=0.01)
        np.testing.assert_allclose(points.max(axis=0)[:2], (7, 2), atol=0.01)
        self.assertEqual(self.euler(item), 2)

    def test_curve_with_a_hole(self):
        bpy.ops.curve.primitive_bezier_circle_add(radius=2)
        inner = bpy.context.object.copy()
        inner.data = inner.data.copy()
        for point in inner.data.splines[0].bezier_points:
            for name in ("co", "handle_left", "handle_right"):
                setattr(point, name, getattr(point, name) * 0.5)
        bpy.context.collection.objects.link(inner)
        inner.select_set(True)
        bpy.ops.object.join()
        item = self.droplet(source="OBJECT", triangles=10000, model="linear")
        self.assertEqual(self.euler(item), 0)

    def test_the_source_is_not_changed(self):
        text = self.text("x")
        text.data.extrude, before = 0.25, len(bpy.data.curves)
        self.droplet(source="OBJECT", **FAST)
        self.assertEqual((text.data.extrude, text.data.resolution_u, len(bpy.data.curves)), (0.25, 12, before))


class Places(AddonTest):
    def plane(self, **settings):
        bpy.ops.mesh.primitive_plane_add(**settings)
        bpy.context.view_layer.update()
        return bpy.context.object

    def test_on_a_wall_liquid_sags_down(self):
        target = self.plane(size=4, location=(1, 2, 3), rotation=(math.pi / 2, 0, 0))
        item = self.droplet(filepath=self.disc, place="FACE", triangles=10000, width=6, sink=0)
        axes = item.matrix_world.to_3x3()
        normal = Vector((0, -1, 0))
        np.testing.assert_allclose(axes.col[2].normalized(), normal, atol=1e-5)
        np.testing.assert_allclose(axes.col[1].normalized(), (0, 0, 1), atol=1e-5)
        rim = world_points(item)
        rim = rim[rim[:, 1] > 2 - 1e-5]
        np.testing.assert_allclose((rim.min(axis=0) + rim.max(axis=0)) / 2, (1, 2, 3), atol=5e-3)
        np.testing.assert_allclose(np.ptp(rim, axis=0)[[0, 2]], 0.9 * 4, atol=1e-2)
        self.assertLess(centroid(item)[2], 3 - 0.05)
        self.assertEqual(item.parent, target)
        level = self.droplet_again(target, use_gravity=False)
        self.assertAlmostEqual(centroid(level)[2], 3, delta=5e-3)

    def droplet_again(self, target, **settings):
        bpy.ops.object.select_all(action="DESELECT")
        target.select_set(True)
        bpy.context.view_layer.objects.active = target
        return self.droplet(filepath=self.disc, place="FACE", triangles=10000, **{"width": 6} | settings)

    def test_spin_turns_the_picture_but_not_gravity(self):
        target = self.plane(size=4, rotation=(math.radians(60), 0, math.radians(20)))
        plain = self.droplet_again(target)
        turned = self.droplet_again(target, spin=math.radians(130))
        np.testing.assert_allclose(centroid(turned), centroid(plain), atol=5e-3)
        angle = plain.matrix_world.to_quaternion().rotation_difference(turned.matrix_world.to_quaternion()).angle
        self.assertAlmostEqual(math.degrees(angle), 130, delta=0.01)

    def test_on_a_ceiling_liquid_hangs(self):
        target = self.plane(size=2, rotation=(math.pi, 0, 0))
        hanging = self.droplet_again(target, fill="VOLUME", volume=10)
        self.assertLess(centroid(hanging)[2], 0)
        lying = self.droplet_again(target, fill="VOLUME", volume=10, use_gravity=False)
        self.assertGreater(hanging.dimensions.z, 1.02 * lying.dimensions.z)

    def test_selected_face_in_edit_mode(self):
        bpy.ops.mesh.primitive_cube_add(size=2, location=(0, 0, 1), rotation=(0, 0, 0.4))
        cube = bpy.context.object
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_mode(type="FACE")
        bpy.ops.mesh.select_all(action="DESELECT")
        shape = bmesh.from_edit_mesh(cube.data)
        face = next(face for face in shape.faces if face.normal.x > 0.9)
        face.select_set(True)
        shape.faces.active = face
        bmesh.update_edit_mesh(cube.data)
        item = self.droplet(filepath=self.disc, place="FACE", fit=False, scale=50, **FAST)
        normal = cube.matrix_world.to_3x3() @ Vector((1, 0, 0))
        np.testing.assert_allclose(item.matrix_world.to_3x3().col[2].normalized(), normal, atol=1e-5)
        np.testing.assert_allclose(item.matrix_world.to_scale(), (50, 50, 50), rtol=1e-5)
        points = columns(item.data.vertices, "co", 3)
        place = item.matrix_world @ Vector((*(points.min(axis=0) + points.max(axis=0))[:2] / 2, 0.01e-3))
        np.testing.assert_allclose(place, cube.matrix_world @ Vector((1, 0, 0)), atol=1e-4)

    def test_text_on_the_selected_face(self):
        text = self.text("o", location=(9, 9, 9))
        target = self.plane(size=3, location=(1, 2, 3))
        text.select_set(True)
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        item = self.droplet(source="OBJECT", place="FACE", sink=0, **FAST)
        self.assertEqual((self.euler(item), item.parent), (0, target))
        points = world_points(item)
        np.testing.assert_allclose((points.min(axis=0) + points.max(axis=0))[:2] / 2, (1, 2), atol=1e-2)
        self.assertAlmostEqual(points[:, 2].min(), 3, delta=1e-5)

    def test_the_droplet_fits_into_a_slender_face(self):
        self.plane(size=2, rotation=(0.7, 0.4, 0.2))
        target = bpy.context.object
        target.data.vertices[3].co = (-0.2, 1.5, 0)
        item = self.droplet(filepath=str(DATA / "ampersand.png"), place="FACE", **FAST)
        inside = target.matrix_world.inverted() @ item.matrix_world
        outline = [(inside @ vertex.co)[:2] for vertex in item.data.vertices]
        corners = [target.data.vertices[index].co.xy for index in target.data.polygons[0].vertices]
        for begin, end in zip(corners, corners[1:] + corners[:1]):
            for x, y in outline:
                self.assertGreater((end - begin).cross(Vector((x, y)) - begin), 0)
        self.assertGreater(item.dimensions.x, 0.5)

    def test_a_text_on_a_wall_sags_down(self):
        self.text("o", rotation=(math.pi / 2, 0, 0))
        item = self.droplet(source="OBJECT", triangles=10000, model="linear", use_gravity=True)
        points = world_points(item)
        middle = (points.min(axis=0) + points.max(axis=0))[2] / 2
        self.assertLess(centroid(item)[2], middle - 0.005)

    def test_at_the_cursor(self):
        bpy.context.scene.cursor.location = (1, -2, 0.5)
        item = self.droplet(filepath=self.disc, sink=0, **FAST)
        np.testing.assert_allclose(item.matrix_world.translation, (1, -2, 0.5), atol=1e-6)


class Onto(AddonTest):
    def cylinder(self):
        bpy.ops.mesh.primitive_cylinder_add(radius=1, depth=2, vertices=64, location=(3, 0, 1), rotation=(0.4, 0, 0.7),
                                            end_fill_type="NOTHING")
        item = bpy.context.object
        item.scale = (1, 1, 2)
        bpy.context.view_layer.update()
        return item

    def test_droplets_lie_on_the_object_and_follow_it(self):
        target = self.cylinder()
        path = self.picture("dots.png", lambda x, y: (np.abs(np.abs(x) - 0.5) < 0.1) & (np.abs(y) < 0.3))
        item = self.droplet(filepath=path, place="ONTO", triangles=10000)
        self.assertClosed(item)
        self.assertEqual(self.euler(item), 4)
        points = world_points(item)
        tree = BVHTree.FromObject(target, bpy.context.evaluated_depsgraph_get())
        inverse = target.matrix_world.inverted()
        angles = columns(item.data.attributes["contact_angle"].data, "value")
        # Distances in the object's frame, where it has radius 1.
        rim = [tree.find_nearest(inverse @ Vector(point))[3] for point in points[angles > 0]]
        self.assertGreater(len(rim), 50)
        self.assertLess(max(rim), 5e-3)
        radii = np.array([(inverse @ Vector(point)).xy.length for point in points])
        self.assertGreater(radii.max(), 1.01)
        self.assertGreater(radii.min(), 0.99)
        target.location.x += 5
        bpy.context.view_layer.update()
        np.testing.assert_allclose(world_points(item), points + (5, 0, 0), atol=1e-4)

    def test_text_along_uv(self):
        target = self.cylinder()
        text = self.text("o")
        target.select_set(True)
        bpy.context.view_layer.objects.active = target
        item = self.droplet(source="OBJECT", place="ONTO", **FAST)
        self.assertEqual(self.euler(item), 0)
        self.assertEqual(item.parent, target)
        self.assertTrue(text.hide_get())

    def test_modifiers_count(self):
        bpy.ops.mesh.primitive_plane_add(size=2)
        target = bpy.context.object
        target.modifiers.new("up", "DISPLACE").strength = 0.5
        item = self.droplet(filepath=self.disc, place="ONTO", scale=100, **FAST)
        self.assertAlmostEqual(world_points(item)[:, 2].min(), 0.25, delta=1e-3)
        self.assertAlmostEqual(item.dimensions.x, 0.8 * 2, delta=0.01)

    def test_an_object_without_texture_coordinates_is_refused(self):
        target = self.cylinder()
        target.data.uv_layers.remove(target.data.uv_layers[0])
        self.assertIn("has no texture coordinates", self.refused(filepath=self.disc, place="ONTO"))


class Sequence(AddonTest):
    def sequence(self, **settings):
        operator = bpy.ops.mesh.droplet_sequence_add
        self.assertEqual(operator("EXEC_DEFAULT", True, **defaults(operator) | settings), {"FINISHED"})
        return bpy.context.object

    def shown(self, parent):
        return [item for item in parent.children if not item.hide_viewport]

    def frames(self):
        """A disc that moves to the right, 1 mm a frame of 20 mm."""
        for frame in range(1, 7):
            path = self.picture(f"move{frame:04d}.png",
                                lambda x, y, at=-0.3 + 0.1 * frame: (x - at)**2 + y * y < 0.3**2)
        return path

    def test_a_moving_droplet_has_shape_keys(self):
        scene = bpy.context.scene
        scene.frame_start = 10
        parent = self.sequence(filepath=self.frames(), triangles=3000, model="linear", scale=1000)
        self.assertEqual(parent.type, "EMPTY")
        (item,) = parent.children
        self.assertEqual(len(item.data.shape_keys.key_blocks), 6)
        self.assertClosed(item)
        volumes = []
        for frame in range(6):
            scene.frame_set(10 + frame)
            weights = [key.value for key in item.data.shape_keys.key_blocks[1:]]
            self.assertEqual([round(value, 4) for value in weights], [float(i == frame - 1) for i in range(5)])
            shape = solid(item, evaluated=True)
            places = np.array([vertex.co for vertex in shape.verts])
            self.assertAlmostEqual((places[:, 0].min() + places[:, 0].max()) / 2, (-2 + frame) * 1e-3, delta=3e-5)
            volumes.append(shape.calc_volume(signed=True))
            shape.free()
        np.testing.assert_allclose(volumes, volumes[0], rtol=0.01)
        scene.frame_set(10, subframe=0.5)  # half way between two frames
        self.assertAlmostEqual(item.data.shape_keys.key_blocks[1].value, 0.5, places=3)
        scene.frame_start = 1

    def test_new_meshes_take_over_where_the_topology_changes(self):
        scene = bpy.context.scene
        parent = self.sequence(filepath=str(DATA / "closing" / "0001.png"), triangles=3000)
        self.assertGreater(len(parent.children), 1)
        volumes, keys = [], 0
        for item in parent.children:
            self.assertClosed(item)
            keys += len(item.data.shape_keys.key_blocks) if item.data.shape_keys else 1
        self.assertEqual(keys, 12)
        for frame in range(12):
            scene.frame_set(1 + frame)
            (item,) = self.shown(parent)
            self.assertEqual(item.hide_viewport, item.hide_render)
            volumes.append(volume_of(item, evaluated=True))
        np.testing.assert_allclose(volumes, volumes[0], rtol=0.01)

    def test_undo_removes_a_sequence(self):
        path = self.frames()
        bpy.ops.ed.undo_push(message="before")
        self.sequence(filepath=path, triangles=3000, model="linear")
        self.assertEqual(len(bpy.data.objects), 2)
        bpy.ops.ed.undo()
        self.assertEqual(len(bpy.data.objects), 0)

    def test_a_relative_path(self):
        self.frames()
        before = os.getcwd()
        os.chdir(self.folder.name)
        try:
            parent = self.sequence(filepath="move0001.png", triangles=3000, model="linear")
            item = self.droplet(filepath="move0003.png", **FAST)
        finally:
            os.chdir(before)
        self.assertEqual(len(parent.children[0].data.shape_keys.key_blocks), 6)
        self.assertAlmostEqual(item.dimensions.x, 0.6, delta=0.01)

    def test_chosen_files_are_frames(self):
        self.frames()
        parent = self.sequence(directory=self.folder.name, files=[{"name": f"move{n:04d}.png"} for n in (1, 2, 3)],
                               triangles=3000, model="linear")
        (item,) = parent.children
        self.assertEqual(len(item.data.shape_keys.key_blocks), 3)

    def test_flow_from_one_picture_to_the_next(self):
        self.picture("square.png", lambda x, y: (np.abs(x) < 0.6) & (np.abs(y) < 0.6))
        parent = self.sequence(kind="FLOW", frames=6, directory=self.folder.name, triangles=3000, model="linear",
                               files=[{"name": "disc.png"}, {"name": "square.png"}], options="--particle-count 1k")
        self.assertEqual(sum(len(item.data.shape_keys.key_blocks) if item.data.shape_keys else 1
                             for item in parent.children), 6)

    def test_errors_are_reported(self):
        for settings, message in (
            ({"filepath": ""}, "no pictures are chosen"),
            ({"filepath": self.disc, "kind": "FLOW"}, "two pictures"),
            ({"filepath": os.path.join(self.folder.name, "absent0001.png")}, "absent0001.png"),
        ):
            before = self.state()
            with self.assertRaisesRegex(RuntimeError, message):
                operator = bpy.ops.mesh.droplet_sequence_add
                operator("EXEC_DEFAULT", True, **defaults(operator) | settings)
            self.assertEqual(self.state(), before)


class Errors(AddonTest):
    def test_the_command_refuses(self):
        empty = self.picture("empty.png", lambda x, y: x > 2)
        for exit_code, settings, words in (
            (2, {"filepath": self.disc, "options": "--contact-angle 300deg"}, "--contact-angle: '300deg' must be"),
            (2, {"filepath": self.disc, "options": "--no-such-option"}, "--no-such-option"),
            (3, {"filepath": empty}, "empty.png"),
            (3, {"filepath": os.path.join(self.folder.name, "absent.png")}, "No such file"),
            (5, {"filepath": str(DATA / "ampersand.png"), "fill": "HEIGHT", "height": 50, "triangles": 2000},
             "no stable droplet"),
        ):
            with self.subTest(exit_code=exit_code, words=words):
                self.assertIn(words, self.refused(**settings))

    def test_the_output_cannot_be_written(self):
        self.assertIn("/nowhere/report", self.refused(filepath=self.disc, options="--mask-out /nowhere/report.png"))

    def test_the_command_is_not_found(self):
        PREFERENCES.program = "/nowhere/droplet-shape"
        self.assertIn("/nowhere/droplet-shape is not a program", self.refused(filepath=self.disc))
        PREFERENCES.program = ""
        path, os.environ["PATH"] = os.environ["PATH"], self.folder.name
        try:
            self.assertIn("not on PATH", self.refused(filepath=self.disc))
            os.symlink(PROGRAM, os.path.join(self.folder.name, "droplet-shape"))
            self.droplet(filepath=self.disc, **FAST)
        finally:
            os.environ["PATH"] = path

    def script(self, text):
        path = os.path.join(self.folder.name, "command")
        Path(path).write_text(f"#!/bin/sh\n{text}\n")
        os.chmod(path, 0o755)
        PREFERENCES.program = path

    def test_the_command_crashes(self):
        self.script("kill -SEGV $$")
        self.assertIn("exit code -11", self.refused(filepath=self.disc))

    def test_the_command_writes_nonsense(self):
        self.script("exit 0")
        self.assertIn("wrote no droplet", self.refused(filepath=self.disc))
        for line in ('echo glTF > "$2"', 'printf "glTF\\2\\0\\0\\0aaaabbbbccccdddd" > "$2"'):
            with self.subTest(line=line):
                self.script(line + '; echo "{}" > "$(dirname "$2")/report.json"')
                self.assertIn("cannot be read", self.refused(filepath=self.disc))

    def test_the_command_takes_too_long(self):
        self.script("exec sleep 20")
        PREFERENCES.timeout = 1
        self.assertIn("more than 1 s", self.refused(filepath=self.disc))

    def test_sources_that_are_missing(self):
        self.assertIn("no picture is chosen", self.refused())
        self.assertIn("no image is chosen", self.refused(source="IMAGE"))
        self.assertIn("there is no image 'x'", self.refused(source="IMAGE", image="x"))
        self.assertIn("select a text or a curve", self.refused(source="OBJECT"))
        self.assertIn("select the mesh", self.refused(filepath=self.disc, place="FACE"))
        bpy.ops.curve.primitive_bezier_curve_add()
        self.assertIn("encloses no area", self.refused(source="OBJECT"))
        self.text("")
        self.assertIn("encloses no area", self.refused(source="OBJECT"))

    def test_no_face_is_selected(self):
        bpy.ops.mesh.primitive_cube_add()
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="DESELECT")
        self.assertIn("no face of 'Cube' is selected", self.refused(filepath=self.disc, place="FACE"))

    def test_edit_mode_stays_after_an_error(self):
        bpy.ops.mesh.primitive_cube_add()
        bpy.ops.object.mode_set(mode="EDIT")
        self.refused(filepath="/nowhere.png", place="FACE")
        self.assertEqual(bpy.context.mode, "EDIT_MESH")

    def test_no_file_stays(self):
        beside = set(os.listdir(self.folder.name))
        temporary = set(os.listdir(tempfile.gettempdir()))
        self.droplet(filepath=self.disc, **FAST)
        self.refused(filepath=self.disc, options="--contact-angle 300deg")
        self.text("o")
        self.droplet(source="OBJECT", **FAST)
        self.assertEqual(set(os.listdir(self.folder.name)), beside)
        new = set(os.listdir(tempfile.gettempdir())) - temporary
        self.assertEqual([name for name in new if name.startswith("droplet-shape-")], [])


class Package(AddonTest):
    def test_the_zip_installs(self):
        """A second Blender installs the zip, finds the menu entry and makes a droplet."""
        folder = self.folder.name
        package = shutil.make_archive(os.path.join(folder, "droplet_shape"), "zip", ROOT / "blender", "droplet_shape")
        script = os.path.join(folder, "install.py")
        Path(script).write_text(
            "import sys, bpy\n"
            "package, program, picture = sys.argv[sys.argv.index('--') + 1:]\n"
            "bpy.ops.preferences.addon_install(filepath=package)\n"
            "bpy.ops.preferences.addon_enable(module='droplet_shape')\n"
            "bpy.context.preferences.addons['droplet_shape'].preferences.program = program\n"
            "assert hasattr(bpy.types, 'VIEW3D_MT_droplet_add')\n"
            "bpy.ops.mesh.droplet_add(filepath=picture)\n"
            "assert bpy.context.object.name == 'Droplet'\n"
            "bpy.ops.preferences.addon_disable(module='droplet_shape')\n"
            "assert not hasattr(bpy.types, 'VIEW3D_MT_droplet_add')\n"
            "assert not hasattr(bpy.types, 'MESH_OT_droplet_add')\n")
        done = subprocess.run(
            [bpy.app.binary_path, "--background", "--factory-startup", "--python-exit-code", "1", "--python", script,
             "--", package, PROGRAM, self.disc],
            capture_output=True, text=True, env=os.environ | {"BLENDER_USER_SCRIPTS": os.path.join(folder, "scripts")})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


def print_times():
    """Prints how long the redo panel takes for a change at 40 000 triangles: undo, command, mesh, undo step."""
    path = str(DATA / "ampersand.png")
    for name, settings, step in (
        ("picture, linear model", {"filepath": path, "model": "linear"}, {"width": 0.01}),
        ("picture, exact model, 9°", {"filepath": path, "fill": "ANGLE", "contact_angle": math.radians(9)},
         {"width": 0.01}),
        ("picture, liquid hangs over its rim", {"filepath": path}, {"width": 0.01}),
        ("text, linear model", {"source": "OBJECT", "model": "linear"}, {"width": 0.01}),
        ("picture, only its scale", {"filepath": path, "model": "linear"}, {"scale": 1}),
    ):
        for item in list(bpy.data.objects):
            bpy.data.objects.remove(item)
        bpy.ops.outliner.orphans_purge()
        if "source" in settings:
            bpy.ops.object.text_add()
            bpy.context.object.data.body = "&"
            bpy.context.view_layer.update()
        bpy.ops.ed.undo_push(message="before")
        bpy.ops.mesh.droplet_add("EXEC_DEFAULT", True, **defaults(bpy.ops.mesh.droplet_add) | settings)
        clock, processor = [], []
        for _ in range(9):
            last = bpy.context.window_manager.operators[-1]
            for key, change in step.items():
                setattr(last, key, getattr(last, key) + change)
            begin, spent = time.perf_counter(), sum(os.times()[:4])
            bpy.ops.ed.undo_redo("EXEC_DEFAULT", True)
            clock.append(time.perf_counter() - begin)
            processor.append(sum(os.times()[:4]) - spent)
        print(f"update, {name}: {len(bpy.context.object.data.polygons)} triangles, {min(clock):.3f} s "
              f"(median {sorted(clock)[4]:.3f} s, processor time {sorted(processor)[4]:.2f} s)")


if __name__ == "__main__":
    run = unittest.main(argv=["addon_test.py", *ARGUMENTS[1:]], exit=False, verbosity=2)
    if not run.result.wasSuccessful():
        sys.exit(1)
    if len(ARGUMENTS) == 1:
        print_times()

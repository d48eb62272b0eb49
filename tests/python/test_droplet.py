# SPDX-License-Identifier: GPL-3.0-or-later
"""make_droplet: masks, arrays, options, reports, errors, threads."""
import dataclasses
import gc
import json
import math
import tempfile
import threading
import time
import unittest
from pathlib import Path

import numpy as np

import droplet_shape as ds
from support import DATA, ROOT, disc

SMALL = {"triangles": 2000, "model": "linear"}


class Masks(unittest.TestCase):
    def test_all_types_give_the_same_droplet(self):
        mask = disc()
        expected = ds.make_droplet(mask, **SMALL).vertices
        for array in (
            mask.astype(np.uint8) * 255,
            mask.astype(np.uint16) * 65535,
            mask.astype(np.float32),
            mask.astype(np.float64),
            mask.tolist(),
            mask.astype(np.uint8),
            mask.astype(np.uint16) * 4095,
            mask.astype(np.int8) * 2 - 1,
            mask.astype(np.int32) * 20,
            mask.astype(np.int64),
            mask.astype(np.uint64) * 255,
            mask.astype(np.float16),
            mask.astype(np.longdouble) * 255,
        ):
            np.testing.assert_array_equal(ds.make_droplet(array, **SMALL).vertices, expected)

    def test_grey_levels_of_8_and_16_bits_are_the_same_shares(self):
        grey = (200 * disc()).astype(np.uint8)
        grey[90:110, 90:110] = 255
        wide = grey.astype(np.uint16) * 257
        expected = ds.make_droplet(grey, **SMALL).vertices
        for array in (wide, grey.astype(np.int32), wide.astype(np.int64), grey / 255):
            np.testing.assert_array_equal(ds.make_droplet(array, **SMALL).vertices, expected)

    def test_labels_are_listed(self):
        labels = disc().astype(np.uint8)
        labels[90:110, 90:110] = 2
        with self.assertRaisesRegex(ds.InvalidInput, r"levels 0, 1 and 2 of 255: choose a threshold, 0\.0059 for"):
            ds.make_droplet(labels)
        np.testing.assert_allclose(
            ds.make_droplet(labels, threshold=0.0059, **SMALL).vertices.max(axis=0)[:2],
            ds.make_droplet(labels == 2, **SMALL).vertices.max(axis=0)[:2],
            rtol=0.1,
        )

    def test_the_order_in_memory_does_not_matter(self):
        mask = disc()
        mask[:, :70] = False
        expected = ds.make_droplet(mask, **SMALL).vertices
        wide = np.zeros((400, 400), bool)
        wide[::2, ::2] = mask
        for array in (np.asfortranarray(mask), wide[::2, ::2], mask[::-1, ::-1].copy()[::-1, ::-1]):
            np.testing.assert_array_equal(ds.make_droplet(array, **SMALL).vertices, expected)

    def test_row_0_is_at_the_top_and_column_0_at_the_left(self):
        mask = np.zeros((100, 100), bool)
        mask[10:30, 60:90] = True
        x, y, _ = ds.make_droplet(mask, width=0.1, **SMALL).vertices.T
        self.assertAlmostEqual(x.min(), 0.01, 5)
        self.assertAlmostEqual(x.max(), 0.04, 5)
        self.assertAlmostEqual(y.min(), 0.02, 5)
        self.assertAlmostEqual(y.max(), 0.04, 5)

    def test_the_array_is_not_changed_and_may_change_afterwards(self):
        mask = disc().astype(np.uint8) * 255
        before = mask.copy()
        drop = ds.make_droplet(mask, invert=True, **SMALL)
        np.testing.assert_array_equal(mask, before)
        vertices = drop.vertices.copy()
        mask[:] = 0
        np.testing.assert_array_equal(drop.vertices, vertices)

    def test_invert_exchanges_liquid_and_dry(self):
        np.testing.assert_array_equal(
            ds.make_droplet(~disc(), invert=True, **SMALL).vertices, ds.make_droplet(disc(), **SMALL).vertices
        )

    def test_other_arrays_are_refused(self):
        for array, words in (
            (np.zeros((2, 3, 4)), "3 dimensions"),
            (np.zeros(5), "1 dimensions"),
            (np.zeros((0, 4)), "at least 1 x 1"),
            (np.zeros((4, 4), complex), "complex128"),
            (np.array([["a", "b"], ["c", "d"]]), "must be of bool"),
            (np.array([[0, 1.5, 3]]), "1.5 must be from 0 to 1; .* mask == 1.5"),
            (np.array([[0, 1, -0.1]]), "-0.1 must be from 0 to 1"),
            (np.array([[0, 1, 70000]]), "70000 must be from 0 to 65535"),
            (np.full((4, 4), np.nan), "nan must be from 0 to 1"),
            (None, "dimensions"),
            ("logo.png", r"'logo.png' is a path, must be an array; read_mask\(\)"),
            (DATA / "ring.svg", r"ring.svg' is a path, must be an array; read_mask\(\)"),
        ):
            with self.assertRaisesRegex(ds.InvalidArgument, "^mask: .*" + words):
                ds.make_droplet(array)

    def test_a_mask_without_liquid_is_an_invalid_input(self):
        with self.assertRaises(ds.InvalidInput):
            ds.make_droplet(np.zeros((50, 50)))

    def test_read_mask_shares_its_memory(self):
        mask = ds.read_mask(DATA / "letter_g_1bit.png")
        array = np.asarray(mask)
        self.assertEqual(array.shape, mask.shape)
        self.assertEqual(array.dtype, np.uint16)
        self.assertFalse(array.flags.writeable)
        self.assertTrue(np.shares_memory(array, np.asarray(mask)))
        expected = array.copy()
        del mask
        gc.collect()
        np.testing.assert_array_equal(array, expected)

    def test_pictures_of_all_kinds_are_read(self):
        for name in ("ring.svg", "sakura.tif", "deer.bmp", "handprint.jpg", "shamrock.webp"):
            self.assertGreater(np.asarray(ds.read_mask(DATA / name)).max(), 32768, name)

    def test_an_unreadable_picture_is_an_invalid_input(self):
        with self.assertRaisesRegex(ds.InvalidInput, "^" + str(ROOT / "README.md")) as caught:
            ds.read_mask(ROOT / "README.md")
        self.assertNotIsInstance(caught.exception, OSError)


class Arrays(unittest.TestCase):
    def setUp(self):
        self.drop = ds.make_droplet(disc(), **SMALL)

    def test_shapes_and_types(self):
        drop = self.drop
        vertices, triangles = len(drop.vertices), len(drop.triangles)
        for array, shape, kind in (
            (drop.vertices, (vertices, 3), np.float64),
            (drop.triangles, (triangles, 3), np.uint32),
            (drop.normals, (vertices, 3), np.float64),
            (drop.uv, (vertices, 2), np.float64),
            (drop.contact_angle, (vertices,), np.float32),
            (drop.weld, (vertices,), np.uint32),
        ):
            self.assertEqual(array.shape, shape)
            self.assertEqual(array.dtype, kind)
            self.assertTrue(array.flags.c_contiguous)

    def test_nothing_is_copied(self):
        for name in ("vertices", "triangles", "normals", "uv", "contact_angle", "weld"):
            first, second = getattr(self.drop, name), getattr(self.drop, name)
            self.assertFalse(first.flags.owndata)
            self.assertIs(first.base, self.drop)
            self.assertEqual(first.__array_interface__["data"][0], second.__array_interface__["data"][0])

    def test_arrays_are_read_only(self):
        for name in ("vertices", "triangles", "normals", "uv", "contact_angle", "weld"):
            array = getattr(self.drop, name)
            with self.assertRaises(ValueError):
                array[0] = 0
            with self.assertRaises(ValueError):
                array.flags.writeable = True

    def test_arrays_outlive_the_droplet(self):
        vertices, triangles = self.drop.vertices, self.drop.triangles
        copies = vertices.copy(), triangles.copy()
        del self.drop
        gc.collect()
        others = [ds.make_droplet(disc(radius=0.5), **SMALL) for _ in range(3)]
        np.testing.assert_array_equal(vertices, copies[0])
        np.testing.assert_array_equal(triangles, copies[1])
        self.assertEqual(len(others), 3)

    def test_quads_are_pairs_of_triangles(self):
        self.assertEqual(self.drop.quads.shape, (0, 4))
        drop = ds.make_droplet(disc(), quads=True, **SMALL)
        quads = drop.quads
        self.assertEqual(quads.dtype, np.uint32)
        self.assertGreater(2 * len(quads), 0.9 * len(drop.triangles))
        halves = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
        self.assertLessEqual(set(map(tuple, halves)), set(map(tuple, drop.triangles)))

    def test_the_mesh_is_closed_and_has_the_volume_of_the_report(self):
        corners = self.drop.vertices[self.drop.triangles]
        volume = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
        self.assertAlmostEqual(volume / self.drop.report.shape.volume_m3, 1.0, 9)
        welded = self.drop.weld[self.drop.triangles]
        edges = np.concatenate([welded[:, [0, 1]], welded[:, [1, 2]], welded[:, [2, 0]]])
        self.assertEqual(set(map(tuple, edges)), set(map(tuple, edges[:, ::-1])))

    def test_normals_have_length_1_and_uv_is_in_the_mask(self):
        np.testing.assert_allclose(np.linalg.norm(self.drop.normals, axis=1), 1.0, atol=1e-9)
        self.assertTrue(((self.drop.uv >= 0) & (self.drop.uv <= 1)).all())


class Options(unittest.TestCase):
    def test_numbers_are_si_units(self):
        for in_units, in_si in (
            ({"width": "30mm"}, {"width": 0.03}),
            ({"pixel_size": "0.1mm"}, {"pixel_size": 1e-4}),
            ({"contact_angle": "30deg"}, {"contact_angle": math.radians(30)}),
            ({"volume": "20uL"}, {"volume": 2e-8}),
            ({"height": "0.4mm"}, {"height": np.float64(4e-4)}),
            ({"tilt": "20deg", "gravity": "1.62m/s2"}, {"tilt": math.radians(20), "gravity": 1.62}),
            ({"surface_tension": "30mN/m", "density": "0.8g/mL"}, {"surface_tension": 0.03, "density": 800}),
            ({"edge": "0.5mm"}, {"edge": 5e-4}),
            ({"speck_size": 4, "threshold": 0.4}, {"speck_size": np.int32(4), "threshold": np.float32(0.4)}),
            ({"triangles": "3k"}, {"triangles": np.int64(3000)}),
            ({"fill_range": "0..2"}, {"fill_range": (0, 2)}),
            ({"fill_holes": "1mm2"}, {"fill_holes": 1e-6}),
            ({"grading": "4"}, {"grading": 4}),
        ):
            common = {"model": "linear"} if {"edge", "triangles"} & set(in_units) else SMALL
            a = ds.make_droplet(disc(), **{**common, **in_units})
            b = ds.make_droplet(disc(), **{**common, **in_si})
            np.testing.assert_allclose(a.vertices, b.vertices, rtol=1e-9, atol=1e-15)

    def test_the_fill_is_met(self):
        self.assertAlmostEqual(ds.make_droplet(disc(), volume="30uL", **SMALL).report.shape.volume_ul, 30, 9)
        self.assertAlmostEqual(ds.make_droplet(disc(), height="0.5mm", **SMALL).report.shape.height_max_m, 5e-4, 9)
        angle = ds.make_droplet(disc(), contact_angle=0.5, **SMALL).report.shape.contact_angle_deg.mean
        self.assertAlmostEqual(math.radians(angle), 0.5, 6)

    def test_wrong_values_name_the_option(self):
        for options, words in (
            ({"width": "20"}, "width: "),
            ({"width": "20kg"}, "width: "),
            ({"width": -0.02}, "width: "),
            ({"width": math.nan}, "width: nan must be a finite number"),
            ({"width": True}, "width: True must be"),
            ({"width": ""}, "width: '' must be"),
            ({"width": [1, 2]}, "width: "),
            ({"contact_angle": "200deg"}, "contact_angle: '200deg' must be from 0.001deg to 179deg"),
            ({"contact_angle": 40}, "^contact_angle: .*; a number is in radians: write '40deg'$"),
            ({"contact_angle": np.float32(62.5)}, "write '62.5deg'$"),
            ({"tilt": -200}, "^tilt: .*; a number is in radians: write '-200deg'$"),
            ({"grading": 3}, "grading: '3' must be one of auto, 1, 2"),
            ({"grading": True}, "grading: True must be"),
            ({"liquid": "wine"}, "liquid: "),
            ({"model": 3}, "model: 3 must be a text"),
            ({"triangles": 0}, "triangles: "),
            ({"triangles": 2.5}, "triangles: "),
            ({"open": 1}, "open: 1 must be True or False"),
            ({"fill_range": (1,)}, "fill_range: "),
            ({"volume": "1uL", "contact_angle": "40deg"}, "contact_angle and volume exclude each other"),
            ({"threads": 0}, "threads: "),
            ({"surface": "missing.png", "surface_depth": 1e-3}, "missing.png"),
        ):
            with self.assertRaisesRegex((ds.InvalidArgument, ds.InvalidInput), words):
                ds.make_droplet(disc(), **options)

    def test_unknown_options_are_type_errors(self):
        with self.assertRaises(TypeError):
            ds.make_droplet(disc(), witdh=3)
        with self.assertRaises(TypeError):
            ds.make_droplet(disc(), 3)

    def test_flags_may_be_numpy_values(self):
        self.assertFalse(ds.make_droplet(disc(), open=np.True_, **SMALL).report.output.closed)
        self.assertTrue(ds.make_droplet(disc(), open=False, **SMALL).report.output.closed)


class Reports(unittest.TestCase):
    def test_reports_are_frozen_dataclasses(self):
        report = ds.make_droplet(disc(), **SMALL).report
        self.assertIsInstance(report, ds.Report)
        self.assertEqual(report.schema, "droplet-shape.report/1")
        self.assertEqual(report.input.width_px, 200)
        self.assertEqual(report.input.path, "array")
        self.assertIsInstance(report.droplets, tuple)
        self.assertEqual(dataclasses.asdict(report)["shape"]["volume_m3"], report.shape.volume_m3)
        with self.assertRaises(dataclasses.FrozenInstanceError):
            report.model = "exact"

    def test_the_report_is_made_once(self):
        drop = ds.make_droplet(disc(), **SMALL)
        self.assertIs(drop.report, drop.report)

    def test_warnings_name_options_as_python_does(self):
        drop = ds.make_droplet(disc(), on="wax", contact_angle="40deg", **SMALL)
        self.assertEqual(drop.warnings, drop.report.warnings)
        self.assertIn("on has no effect without contact_angle natural", drop.warnings)


class Errors(unittest.TestCase):
    def test_classes(self):
        for kind, base in (
            (ds.InvalidArgument, ValueError),
            (ds.InvalidInput, ValueError),
            (ds.NoSuchDroplet, ValueError),
            (ds.OutputFailed, OSError),
        ):
            self.assertTrue(issubclass(kind, ds.Error) and issubclass(kind, base))
            self.assertEqual(kind.code, kind.__name__)

    def test_no_such_droplet(self):
        with self.assertRaises(ds.NoSuchDroplet) as caught:
            ds.make_droplet(disc(), width="50mm", tilt="90deg", contact_angle="60deg", model="exact", triangles=500)
        self.assertEqual(caught.exception.code, "NoSuchDroplet")
        self.assertNotIn("--", str(caught.exception))


def flag(channels=3):
    """Picture of two stripes on white, or on transparent ground."""
    picture = np.full((80, 120, channels), 255, np.uint8)
    if channels == 4:
        picture[..., 3] = 0
    picture[10:70, 10:60, :] = (0, 0, 139, 255)[:channels]
    picture[10:70, 60:110, :] = (255, 215, 0, 255)[:channels]
    return picture


class ByColour(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def gltf(self, path):
        data = path.read_bytes()
        return json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])

    def test_every_region_is_a_droplet(self):
        for channels in (3, 4):
            report = ds.make_droplet(flag(channels), by_colour=True, **SMALL).report
            self.assertEqual([droplet.colour for droplet in report.droplets], ["#00008b", "#ffd700"])
            self.assertEqual([entry.colour for entry in report.input.palette], ["#00008b", "#ffd700"])
            self.assertEqual(report.input.background, "#ffffff" if channels == 3 else None)
            self.assertEqual(report.input.path, "array")

    def test_the_order_in_memory_does_not_matter(self):
        a = ds.make_droplet(flag(), by_colour=True, **SMALL)
        b = ds.make_droplet(np.asfortranarray(flag()), by_colour=True, **SMALL)
        np.testing.assert_array_equal(a.vertices, b.vertices)

    def test_number_gap_and_channel(self):
        areas = [
            ds.make_droplet(flag(), by_colour=True, gap=gap, **SMALL).report.mesh.footprint_area_m2
            for gap in (None, "1mm", 1e-3)
        ]
        self.assertAlmostEqual(areas[0] - areas[1], 10e-3 * 1e-3, delta=2e-6)
        self.assertEqual(areas[1], areas[2])
        one = ds.make_droplet(flag(), by_colour=True, colours=1, **SMALL)
        self.assertEqual(len(one.report.input.palette), 1)
        opaque = ds.make_droplet(flag(), by_colour=True, channel="alpha", **SMALL)
        self.assertEqual(len(opaque.report.droplets), 3)

    def test_files_have_the_colours(self):
        drop = ds.make_droplet(flag(), by_colour=True, **SMALL)
        drop.save(self.folder / "one.glb")
        one = self.gltf(self.folder / "one.glb")
        self.assertEqual([material["name"] for material in one["materials"]], ["darkblue", "gold"])
        self.assertEqual(len(one["nodes"]), 1)
        for compress in ("none", "meshopt"):
            drop.save(self.folder / "each.glb", nodes="each", compress=compress)
            each = self.gltf(self.folder / "each.glb")
            self.assertEqual([node["name"] for node in each["nodes"]], ["darkblue_1", "gold_1"])
            for node, droplet in zip(each["nodes"], drop.report.droplets):
                self.assertEqual(node["extras"]["volume_m3"], droplet.volume_m3)
        drop.save(self.folder / "drop.usda", nodes="each")
        self.assertIn('def Mesh "gold_1"', (self.folder / "drop.usda").read_text())
        drop.save(self.folder / "drop.obj")
        self.assertIn("newmtl gold\n", (self.folder / "drop.mtl").read_text())

    def test_materials_come_from_a_file(self):
        drop = ds.make_droplet(flag(), by_colour=True, **SMALL)
        materials = self.folder / "m.toml"
        materials.write_text('[[droplet]]\nindex = 2\nmaterial = "mercury"\n')
        drop.save(self.folder / "drop.glb", materials=materials)
        names = [material["name"] for material in self.gltf(self.folder / "drop.glb")["materials"]]
        self.assertEqual(names, ["darkblue", "mercury"])
        materials.write_text('[[droplet]]\nindex = 3\nmaterial = "mercury"\n')
        with self.assertWarnsRegex(UserWarning, "names droplet 3, but there are only 2"):
            drop.save(self.folder / "drop.glb", materials=materials)
        with self.assertRaisesRegex(ds.InvalidArgument, "^materials: .*cannot be read"):
            drop.save(self.folder / "drop.glb", materials="missing.toml")
        with self.assertRaisesRegex(ds.InvalidArgument, "^nodes"):
            drop.save(self.folder / "drop.glb", nodes="some")

    def test_other_arrays_are_refused(self):
        for array in (disc(), flag()[..., :2], flag().astype(float), np.zeros((0, 4, 3), np.uint8)):
            with self.assertRaisesRegex(ds.InvalidArgument, "^mask: for by_colour it must be an array of rows"):
                ds.make_droplet(array, by_colour=True)
        with self.assertRaisesRegex(ds.InvalidArgument, "by_colour and invert exclude"):
            ds.make_droplet(flag(), by_colour=True, invert=True)
        with self.assertRaisesRegex(ds.InvalidArgument, "^channel needs by_colour"):
            ds.make_droplet(disc(), channel="alpha")


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.drop = ds.make_droplet(disc(), **SMALL)

    def test_every_format_reads_back(self):
        for extension in ("glb", "gltf", "obj", "ply", "stl"):
            path = self.folder / f"drop.{extension}"
            self.drop.save(path)
            found = ds.compare(self.drop, path)
            self.assertLess(found.distance.upper_m, 1e-8, extension)
            self.assertTrue(found.same_topology, extension)
        self.assertTrue((self.folder / "drop.mtl").exists())

    def test_unit_and_material(self):
        self.drop.save(str(self.folder / "metres.stl"), unit="m")
        self.drop.save(self.folder / "drop.glb", material="ink")
        self.assertIn(b"ink", (self.folder / "drop.glb").read_bytes())
        for options in ({"unit": "inch"}, {"material": "brick"}):
            with self.assertRaisesRegex(ds.InvalidArgument, "^" + next(iter(options))):
                self.drop.save(self.folder / "drop.obj", **options)

    def test_compression(self):
        sizes = {}
        for compress in ("none", "quantize", "meshopt"):
            path = self.folder / f"{compress}.glb"
            self.drop.save(path, compress=compress)
            sizes[compress] = path.stat().st_size
            self.assertTrue(ds.compare(self.drop, path).same_topology, compress)
        self.assertLess(sizes["quantize"], sizes["none"])
        self.assertLess(sizes["meshopt"], sizes["quantize"])
        with self.assertRaisesRegex(ds.InvalidArgument, "^compress"):
            self.drop.save(self.folder / "drop.glb", compress="draco")

    def test_failures(self):
        with self.assertRaisesRegex(ds.InvalidArgument, "path: .*drop.txt"):
            self.drop.save(self.folder / "drop.txt")
        with self.assertRaises(ds.OutputFailed):
            self.drop.save(self.folder / "nowhere" / "drop.glb")
        self.drop.save(self.folder / "drop.glb")
        with self.assertRaises(ds.OutputFailed):
            self.drop.save(self.folder / "drop.glb", no_clobber=True)


class Threads(unittest.TestCase):
    def test_other_threads_run_during_a_solve(self):
        begun, ended = threading.Event(), threading.Event()

        def solve():
            begun.set()
            for _ in range(3):
                ds.make_droplet(disc(400), model="exact", contact_angle="60deg", triangles=30000)
            ended.set()

        worker = threading.Thread(target=solve)
        worker.start()
        begun.wait()
        steps = 0
        while not ended.is_set():
            time.sleep(0.001)
            steps += 1
        worker.join()
        self.assertGreater(steps, 50)

    def test_droplets_of_several_threads_are_right(self):
        expected = ds.make_droplet(disc(), **SMALL).vertices
        results = [None] * 4

        def solve(k):
            results[k] = ds.make_droplet(disc(), threads=1, **SMALL).vertices

        workers = [threading.Thread(target=solve, args=(k,)) for k in range(4)]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join()
        for vertices in results:
            np.testing.assert_array_equal(vertices, expected)


if __name__ == "__main__":
    unittest.main()

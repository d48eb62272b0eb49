# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects in pickles and copies, file objects, notebooks; files that do not exist."""
import concurrent.futures
import copy
import io
import json
import multiprocessing
import pickle
import tempfile
import unittest
from pathlib import Path

import numpy as np

import droplet_shape as ds
from support import DATA, FONT, disc

SMALL = {"triangles": 1000, "model": "linear"}
ARRAYS = ("vertices", "triangles", "normals", "uv", "contact_angle", "weld")


def film():
    return ds.animate([disc(80, 0.5), np.zeros((80, 80)), disc(80, 0.6)], **SMALL)


def flag():
    picture = np.full((40, 60, 3), 255, np.uint8)
    picture[5:35, 5:30] = 0, 0, 139
    picture[5:35, 30:55] = 255, 215, 0
    return ds.make_droplet(picture, by_colour=True, **SMALL)


def volume(mask):
    """Work for another process, which takes and returns objects of the package."""
    drop = ds.make_droplet(mask, **SMALL)
    return drop.report.shape.volume_m3, drop


class Pickles(unittest.TestCase):
    def assert_same(self, ours, theirs):
        self.assertIs(type(ours), type(theirs))
        for name in ARRAYS:
            np.testing.assert_array_equal(getattr(ours, name), getattr(theirs, name))
        self.assertEqual(ours.warnings, theirs.warnings)
        for extension in ("glb", "obj", "usda"):
            self.assertEqual(ours.to_bytes(extension), theirs.to_bytes(extension))

    def copies(self, value):
        yield copy.deepcopy(value)
        for protocol in (2, pickle.HIGHEST_PROTOCOL):
            yield pickle.loads(pickle.dumps(value, protocol))

    def test_droplets(self):
        for drop in (
            ds.make_droplet(disc(), liquid="mercury", fill_range=(0, 2), **SMALL),
            ds.make_droplet(disc(), surface="sphere:R=30mm", **SMALL),
            ds.make_droplet(ds.read_mask(DATA / "dew.png"), onto=DATA / "can.glb", **SMALL),
            ds.glyphs(FONT, "o", advancing="60deg", receding="20deg", tilt="10deg", **SMALL),
            flag(),
        ):
            for other in self.copies(drop):
                self.assert_same(other, drop)
                self.assertEqual(other.report, drop.report)
                self.assertEqual(other.to_bytes(nodes="each"), drop.to_bytes(nodes="each"))
                self.assertFalse(np.shares_memory(other.vertices, drop.vertices))
            self.assertEqual(other._repr_png_(), drop._repr_png_())

    def test_files_have_the_object(self):
        drop = ds.make_droplet(ds.read_mask(DATA / "dew.png"), onto=DATA / "can.glb", **SMALL)
        both, alone = drop.to_bytes(), drop.to_bytes(droplets_only=True)
        self.assertIn(b'"name":"object"', both)
        self.assertNotIn(b'"name":"object"', alone)
        self.assertEqual(drop.to_bytes("stl"), drop.to_bytes("stl", droplets_only=True))
        self.assertEqual(pickle.loads(pickle.dumps(drop)).to_bytes(), both)

    def test_attributes_stay(self):
        drop = ds.make_droplet(disc(), **SMALL)
        drop.label = "a"
        self.assertEqual(copy.copy(drop).label, "a")
        self.assertEqual(pickle.loads(pickle.dumps(drop)).report, drop.report)

    def test_surfaces_and_animations(self):
        made = film()
        for other in self.copies(made[0]):
            self.assert_same(other, made[0])
        self.assertEqual(len(copy.copy(made[1]).vertices), 0)
        for other in self.copies(made):
            self.assertEqual(other.report, made.report)
            self.assertEqual(other.warnings, made.warnings)
            self.assertEqual(other.to_bytes(), made.to_bytes())
            self.assert_same(other[2], made[2])

    def test_masks(self):
        for name in ("letter_g_1bit.png", "inkscape.png", "ring.svg"):
            mask = ds.read_mask(DATA / name, threshold=0.4)
            for other in self.copies(mask):
                np.testing.assert_array_equal(np.asarray(other), np.asarray(mask))
                for member in ("shape", "channel", "inverted", "segment", "segment_confidence", "physical_width"):
                    self.assertEqual(getattr(other, member), getattr(mask, member), member)
                ours, theirs = (ds.make_droplet(each, **SMALL).report.input for each in (other, mask))
                self.assertEqual(ours, theirs)

    def test_errors_and_reports(self):
        report = ds.make_droplet(disc(), **SMALL).report
        self.assertEqual(pickle.loads(pickle.dumps(report)), report)
        for path in ("nowhere.png", DATA.parent / "README.md"):
            with self.assertRaises(ds.InvalidInput) as caught:
                ds.read_mask(path)
            other = pickle.loads(pickle.dumps(caught.exception))
            self.assertIs(type(other), type(caught.exception))
            self.assertEqual(str(other), str(caught.exception))

    def test_other_processes_take_and_return_them(self):
        masks = [ds.read_mask(DATA / "letter_g_1bit.png"), disc(80)]
        expected = [volume(mask)[0] for mask in masks]  # a fork takes over a library that has threads
        for method in multiprocessing.get_all_start_methods():
            context = multiprocessing.get_context(method)
            with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as pool:
                found = list(pool.map(volume, masks))
            self.assertEqual([each for each, _ in found], expected, method)
            self.assertEqual([drop.report.shape.volume_m3 for _, drop in found], expected, method)

    def test_other_versions_and_damage_are_refused(self):
        drop = ds.make_droplet(disc(80), **SMALL)
        _, state = drop.__getstate__()
        other = ds.Droplet.__new__(ds.Droplet)
        with self.assertRaisesRegex(ds.InvalidInput, "version 0.0.1 .* files fit all versions"):
            other.__setstate__(("0.0.1", state))
        surface = film()[0]
        version, ((parts, *rest), stand) = surface.__getstate__()
        damaged = (parts[0], parts[1], parts[2], parts[3], b"\xff" * len(parts[4]), *parts[5:])
        with self.assertRaisesRegex(ds.InvalidArgument, "triangles"):
            ds.Surface.__new__(ds.Surface).__setstate__((version, ((damaged, *rest), stand)))


class FileObjects(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_they_get_the_bytes_of_the_file(self):
        for made in (flag(), film()[0]):
            for extension in ("glb", "gltf", "ply", "stl", "usda", "usdz"):
                made.save(self.folder / f"drop.{extension}")
                expected = (self.folder / f"drop.{extension}").read_bytes()
                memory = io.BytesIO()
                made.save(memory, format=extension)
                self.assertEqual(memory.getvalue(), expected, extension)
                self.assertEqual(made.to_bytes(extension), expected, extension)
                made.save(self.folder / "without_extension", format=extension)
                self.assertEqual((self.folder / "without_extension").read_bytes(), expected, extension)
        made = film()
        made.save(self.folder / "film.glb", material="ink")
        memory = io.BytesIO()
        made.save(memory, material="ink")
        self.assertEqual(memory.getvalue(), (self.folder / "film.glb").read_bytes())
        self.assertEqual(made.to_bytes(material="ink"), memory.getvalue())
        for extension in ("glb", "gltf", "usda", "usdz"):
            with self.subTest(extension):
                made.save(self.folder / f"film.{extension}")
                self.assertEqual(made.to_bytes(extension), (self.folder / f"film.{extension}").read_bytes())
        self.assertIn(b"timeSamples", made.to_bytes("usda"))
        self.assertLess(len(made.to_bytes(compress="meshopt")), 0.6 * len(made.to_bytes()))

    def test_options_are_those_of_a_file(self):
        drop = flag()
        drop.save(self.folder / "drop.glb", nodes="each", compress="meshopt", material="honey")
        options = {"nodes": "each", "compress": "meshopt", "material": "honey"}
        self.assertEqual(drop.to_bytes(**options), (self.folder / "drop.glb").read_bytes())
        self.assertNotEqual(drop.to_bytes(), drop.to_bytes(**options))
        self.assertNotIn(b"mtllib", drop.to_bytes("obj"))
        self.assertNotEqual(drop.to_bytes("stl"), drop.to_bytes("stl", unit="m"))

    def test_errors(self):
        drop = flag()
        for words, call in (
            ("^format: a file object has no extension", lambda: drop.save(io.BytesIO())),
            ("^format: .*glb, gltf, obj", lambda: drop.to_bytes("dwg")),
            ("^unit: ", lambda: drop.to_bytes(unit="inch")),
            ("^material: ", lambda: film().to_bytes(material="brick")),
            ("^format: obj holds single frames", lambda: film().to_bytes("obj")),
            ("^compress: usda files cannot", lambda: film().to_bytes("usda", compress="meshopt")),
            ("^nodes: ", lambda: drop.to_bytes(nodes="some")),
        ):
            with self.assertRaisesRegex(ds.InvalidArgument, words):
                call()
        with self.assertRaises(TypeError):
            drop.save(io.StringIO(), format="glb")
        with self.assertRaises(TypeError):
            drop.save(3)


class Notebooks(unittest.TestCase):
    def size(self, png):
        self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
        return int.from_bytes(png[16:20], "big"), int.from_bytes(png[20:24], "big")

    def test_surfaces_show_their_preview(self):
        made = film()
        for surface in (flag(), made[0]):
            self.assertEqual(self.size(surface._repr_png_()), (640, 480))
        self.assertIsNone(made[1]._repr_png_())

    def test_masks_show_their_pixels(self):
        mask = ds.read_mask(DATA / "letter_g_1bit.png")
        png = mask._repr_png_()
        self.assertEqual(self.size(png), mask.shape[::-1])
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "mask.png")
            path.write_bytes(png)
            np.testing.assert_array_equal(np.asarray(ds.read_mask(path, channel="luma")), np.asarray(mask))


class MissingFiles(unittest.TestCase):
    def test_they_are_not_found_and_named_once(self):
        drop = flag()
        calls = (
            lambda path: ds.read_mask(path),
            lambda path: ds.glyphs(path, "a"),
            lambda path: ds.compare(path, drop),
            lambda path: ds.flow(path, "out.glb", drops=3),
            lambda path: ds.make_droplet(disc(80), surface=path, surface_depth=1e-3),
            lambda path: ds.make_droplet(disc(80), onto=path),
            lambda path: drop.to_bytes(materials=path),
        )
        for call in calls:
            for path in ("nowhere.glb", Path("no folder", "nowhere.glb")):
                with self.assertRaises(FileNotFoundError) as caught:
                    call(path)
                self.assertIsInstance(caught.exception, ds.Error)
                self.assertEqual(str(caught.exception).count(str(path)), 1, caught.exception)

    def test_folders_are_no_missing_files(self):
        with self.assertRaises(ds.InvalidInput) as caught:
            ds.read_mask(DATA)
        self.assertNotIsInstance(caught.exception, FileNotFoundError)
        self.assertEqual(str(caught.exception).count(str(DATA)), 1)

    def test_paths_are_no_frames(self):
        with self.assertRaisesRegex(ds.InvalidArgument, r"^frames: 'film.mp4' is a path, .*read_mask\(\)"):
            ds.animate("film.mp4")
        with self.assertRaisesRegex(ds.InvalidArgument, r"^mask: 'a.png' is a path, .*read_mask\(\)"):
            ds.animate(["a.png"])


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-3.0-or-later
"""glyphs, animate, compare, wind_tunnel, windshield, flow and dew."""
import math
import tempfile
import unittest
from pathlib import Path

import numpy as np

import droplet_shape as ds
from support import DATA, FONT, disc

SMALL = {"triangles": 1000, "model": "linear"}


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)


class Glyphs(InFolder):
    def test_a_text_has_a_droplet_per_part(self):
        drop = ds.glyphs(FONT, "Hi", em=0.01, **SMALL)
        self.assertEqual(len(drop.report.droplets), 3)
        self.assertEqual(drop.report.input.type.text, "Hi")
        self.assertEqual(drop.report.input.type.em_m, 0.01)

    def test_lines_are_separated_by_line_feeds(self):
        one, two = ds.glyphs(FONT, "H H", **SMALL), ds.glyphs(FONT, "H\nH", **SMALL)
        self.assertGreater(np.ptp(two.vertices[:, 1]), 1.5 * np.ptp(one.vertices[:, 1]))

    def test_lines_have_sizes_and_follow_a_path(self):
        one, large = ds.glyphs(FONT, "H", **SMALL), ds.glyphs(FONT, "H", line_sizes=[2, 1], **SMALL)
        self.assertAlmostEqual(np.ptp(large.vertices[:, 1]) / np.ptp(one.vertices[:, 1]), 2, places=5)
        wave = self.folder / "wave.svg"
        wave.write_text("<svg xmlns='http://www.w3.org/2000/svg' width='50mm' viewBox='0 0 5 5'><path d='M1,4V1'/></svg>")
        up = ds.glyphs(FONT, "HHHH", path=wave, **SMALL)
        self.assertGreater(np.ptp(up.vertices[:, 1]), np.ptp(up.vertices[:, 0]))
        self.assertIn("2 letters are left out", up.warnings[0])
        self.assertEqual(len(ds.glyphs(FONT, "HHHH", path=wave, path_width="100mm", **SMALL).report.droplets), 4)
        with self.assertRaisesRegex(ds.InvalidInput, "path: .*no path"):
            wave.write_text("<svg xmlns='http://www.w3.org/2000/svg'/>")
            ds.glyphs(FONT, "H", path=wave)

    def test_backslashes_are_characters(self):
        self.assertEqual(ds.glyphs(FONT, r"\n", **SMALL).report.input.type.text, r"\n")

    def test_errors(self):
        with self.assertRaisesRegex(ds.InvalidInput, "no ink"):
            ds.glyphs(FONT, "  ")
        with self.assertRaisesRegex(ds.InvalidInput, "nowhere.ttf"):
            ds.glyphs("nowhere.ttf", "a")
        with self.assertRaisesRegex(ds.InvalidArgument, "^axis: "):
            ds.glyphs(FONT, "a", axis="wght=700")
        with self.assertRaises(ds.InvalidArgument):
            ds.glyphs(FONT, "a", axis={"wght": 700})

    def test_missing_characters_are_a_warning(self):
        self.assertIn("left out", ds.glyphs(FONT, "a\U0001f9ff", **SMALL).warnings[0])


class Animate(InFolder):
    def setUp(self):
        super().setUp()
        self.masks = [disc(120, radius) for radius in (0.5, 0.52, 0.54, 0.56)]

    def test_the_volume_stays(self):
        film = ds.animate(self.masks, volume=2e-8, **SMALL)
        self.assertEqual(len(film), 4)
        for frame, report in zip(film, film.report.frames):
            self.assertAlmostEqual(report.volume_m3 / 2e-8, 1, 9)
            self.assertEqual(len(frame.vertices), report.vertices)
        np.testing.assert_array_equal(film[0].triangles, film[3].triangles)
        self.assertTrue(film.report.frames[3].continues)
        self.assertFalse(np.shares_memory(film[0].vertices, film[1].vertices))

    def test_frames_are_a_sequence(self):
        film = ds.animate(iter(self.masks), **SMALL)
        self.assertEqual(len(list(film)), 4)
        self.assertIs(film[-1], film[3])
        with self.assertRaises(IndexError):
            film[4]

    def test_frames_outlive_the_film(self):
        film = ds.animate(self.masks, **SMALL)
        vertices = film[2].vertices
        copy = vertices.copy()
        del film
        np.testing.assert_array_equal(vertices, copy)

    def test_dry_frames_have_no_triangles(self):
        film = ds.animate([self.masks[0], np.zeros((120, 120)), self.masks[0]], **SMALL)
        self.assertEqual(film[1].vertices.shape, (0, 3))
        self.assertEqual(film[1].triangles.shape, (0, 3))
        self.assertEqual(film.report.frames[1].droplets, ())
        film.save(self.folder / "film.glb")
        film[1].save(self.folder / "dry.obj")

    def test_ids_and_origins(self):
        left, right = np.zeros((100, 200), bool), np.zeros((100, 200), bool)
        left[30:70, 20:90] = True
        right[30:70, 110:180] = True
        bridge = left | right
        bridge[45:55, 80:120] = True
        film = ds.animate([left | right, bridge], volume_mode="track", **SMALL)
        merged = film.report.frames[1].droplets
        self.assertEqual(len(merged), 1)
        self.assertEqual(sorted(merged[0].from_), sorted(drop.id for drop in film.report.frames[0].droplets))

    def test_errors(self):
        with self.assertRaisesRegex(ds.InvalidArgument, "^frames: "):
            ds.animate([])
        with self.assertRaisesRegex(ds.InvalidInput, "^frames: no liquid in any of 2 frames"):
            ds.animate([np.zeros((9, 9))] * 2)
        with self.assertRaisesRegex(ds.InvalidInput, "^frame 2: 100 x 100 pixels must be 120 x 120"):
            ds.animate([self.masks[0], disc(100)])
        with self.assertRaisesRegex(ds.InvalidArgument, "volume_mode"):
            ds.animate(self.masks, fill="each")
        with self.assertRaisesRegex(ds.InvalidArgument, "glb"):
            ds.animate(self.masks[:1], **SMALL).save(self.folder / "film.obj")
        with self.assertRaises(ZeroDivisionError):
            ds.animate(1 / 0 for _ in range(2))


class Compare(InFolder):
    def test_a_surface_is_like_itself(self):
        drop = ds.make_droplet(disc(), **SMALL)
        found = ds.compare(drop, drop, tolerance=1e-9, volume_tolerance=1e-6, normal_tolerance="0.1deg")
        self.assertLess(found.distance.upper_m, 1e-15)
        self.assertEqual(found.exceeded, ())
        self.assertEqual((found.a.path, found.b.path), ("a", "b"))

    def test_differences_over_a_tolerance_are_listed(self):
        a, b = (ds.make_droplet(disc(), contact_angle=angle, **SMALL) for angle in (0.5, 0.6))
        found = ds.compare(a, b, tolerance="1um", volume_tolerance="0.1%")
        self.assertEqual(len(found.exceeded), 2)
        self.assertEqual(found.tolerance.volume_share, 1e-3)

    def test_errors(self):
        drop = ds.make_droplet(disc(), **SMALL)
        with self.assertRaises(ds.InvalidInput):
            ds.compare(drop, self.folder / "nowhere.glb")
        with self.assertRaises(TypeError):
            ds.compare(drop, 3)
        for option in ("tolerance", "volume_tolerance", "normal_tolerance"):
            with self.assertRaisesRegex(ds.InvalidArgument, "^" + option):
                ds.compare(drop, drop, **{option: -1})


class WindTunnel(unittest.TestCase):
    def test_lists_may_be_arrays(self):
        winds = np.linspace(0, 10, 5)
        run = ds.wind_tunnel(volume=[1e-8, "20uL"], wind_speed=winds, slope=math.radians(30)).runs[0]
        self.assertEqual(len(run.cases), 2)
        np.testing.assert_allclose(run.wind_m_per_s, winds)
        self.assertAlmostEqual(run.cases[0].slope_deg, 30)
        self.assertEqual(len(run.cases[0].acceleration_m_per_s2), 5)

    def test_errors(self):
        with self.assertRaisesRegex(ds.InvalidArgument, "^volume: "):
            ds.wind_tunnel(volume=[])
        with self.assertRaisesRegex(ds.InvalidArgument, "^slope: "):
            ds.wind_tunnel(slope="100deg")
        with self.assertRaisesRegex(ds.InvalidArgument, "hysteresis and sliding_angle exclude each other"):
            ds.wind_tunnel(hysteresis=0.2, sliding_angle="30deg")
        self.assertEqual(ds.wind_tunnel(measured=(7, 11)).runs[0].measured_still_m_per_s, (7, 11))


class Windshield(InFolder):
    def test_pictures_table_and_water(self):
        report = ds.windshield(
            self.folder / "%02d.png",
            time=0.1,
            warm_up="1s",
            rain=25e-3 / 3600,
            speed=20,
            frame_size=(160, 90),
            droplets=self.folder / "droplets.csv",
            eye=(0, -0.6, 0.1),
        )
        self.assertEqual(report.output.frames, 3)
        self.assertAlmostEqual(report.rain.rainfall_mm_per_h, 25)
        self.assertEqual(report.view.eye_m, (0, -0.6, 0.1))
        self.assertLess(report.largest_residual, 1e-9)
        self.assertEqual(len(list(self.folder.glob("*.png"))), 3)
        table = np.genfromtxt(self.folder / "droplets.csv", delimiter=",", names=True)
        self.assertIn("contact_radius_m", table.dtype.names)

    def test_errors(self):
        with self.assertRaisesRegex(ds.InvalidArgument, "^rain: "):
            ds.windshield(self.folder / "a.png", rain="5mm")
        with self.assertRaises(ds.OutputFailed):
            ds.windshield(self.folder / "nowhere" / "a.png", time=0.1, warm_up="1s")


class Dew(InFolder):
    def test_droplets_rest_on_a_mesh(self):
        report = ds.dew(DATA / "can.glb", self.folder / "wet.obj", coverage=0.1, smallest="0.4mm", largest="1mm")
        self.assertGreater(report.droplets.count, 10)
        self.assertAlmostEqual(report.droplets.covered_m2 / report.droplets.area_m2, 0.1, delta=0.02)
        self.assertTrue((self.folder / "wet.obj").exists())
        with self.assertRaisesRegex(ds.InvalidArgument, "coverage"):
            ds.dew(DATA / "can.glb", self.folder / "wet.obj", coverage=2)


class Flow(InFolder):
    def test_droplets_run_over_a_mesh(self):
        report = ds.flow(
            DATA / "can.glb",
            self.folder / "wet.glb",
            drops=20,
            time=0.2,
            spin=0.5,
            emitter=["0,1,0,50uL/s", "0.01,1,0,50uL/s"],
            droplets=self.folder / "droplets.json",
        )
        self.assertGreaterEqual(report.counts.released, 20)
        self.assertEqual(len(report.sources.emitters), 2)
        self.assertAlmostEqual(np.linalg.norm(report.object.spin_rad_per_s), 0.5)
        self.assertLess(abs(report.largest_residual), 1e-9)
        self.assertTrue((self.folder / "wet.glb").exists() and (self.folder / "droplets.json").exists())

    def test_a_preset_has_its_own_object(self):
        report = ds.flow(None, self.folder / "wet.glb", preset="leaf", time="0.1s")
        self.assertEqual(report.preset, "leaf")
        self.assertEqual(report.input.path, "preset leaf")

    def test_a_droplet_is_an_object_too(self):
        ds.make_droplet(disc(), **SMALL).save(self.folder / "object.obj")
        report = ds.flow(self.folder / "object.obj", self.folder / "wet.glb", rain="100mm/h", from_=(0, 1, 0.5), time=0.1)
        self.assertGreater(report.sources.rain.from_[1], 0)

    def test_errors(self):
        with self.assertRaisesRegex(ds.InvalidArgument, "no droplets are asked for"):
            ds.flow(DATA / "can.glb", self.folder / "wet.glb")
        with self.assertRaisesRegex(ds.InvalidArgument, "^wind_velocity: "):
            ds.flow(DATA / "can.glb", self.folder / "wet.glb", drops=3, wind_velocity=(1, 2))
        with self.assertRaises(ds.InvalidInput):
            ds.flow(self.folder / "nowhere.glb", self.folder / "wet.glb", drops=3)


class LiveWindshield(unittest.TestCase):
    def test_the_texture_follows_the_rain(self):
        rain = ds.Windshield(rain="50mm/h", glass_width=0.7, contact_angle="80deg")
        self.assertAlmostEqual(rain.get("contact_angle"), math.radians(80))
        first, tiles = rain.draw(256)
        self.assertEqual(first.shape[1:], (256, 4))
        self.assertFalse(first.any())
        shown = np.array(first)
        for _ in range(30):
            rain.advance(1 / 60)
            pixels, tiles = rain.draw(256)
            for x, y, width, height in tiles:
                shown[y : y + height, x : x + width] = pixels[y : y + height, x : x + width]
        self.assertIs(pixels.base, first.base)
        np.testing.assert_array_equal(shown, pixels)
        self.assertTrue(pixels[..., 3].any())
        self.assertEqual(len(rain.running), rain.figures.running)
        self.assertGreater(rain.running["volume"].min(), 0)
        self.assertAlmostEqual(rain.figures.time, 0.5)
        self.assertLess(abs(rain.water.balance_error), 1e-12)

    def test_it_rains_on_a_mesh(self):
        rain = ds.Windshield(surface=DATA / "can.glb", rain="50mm/h")
        self.assertAlmostEqual(rain.figures.width, 2 * math.pi * 33e-3, delta=1e-3)
        for _ in range(30):
            rain.advance(1 / 60)
        self.assertGreater(rain.figures.raindrops, 10)
        self.assertTrue(rain.draw(128)[0].any())
        self.assertLess(abs(rain.water.balance_error), 1e-12)
        with self.assertRaisesRegex(ds.InvalidArgument, "slope: the glass is a mesh"):
            rain.get("slope")
        with self.assertRaisesRegex(ds.InvalidArgument, "glass-width: the glass is a mesh"):
            ds.Windshield(surface=DATA / "can.glb", glass_width=1)
        with self.assertRaises(ds.InvalidInput):
            ds.Windshield(surface="nowhere.glb")

    def test_mist_is_wiped_by_a_finger(self):
        rain = ds.Windshield(rain=0, mist=1e-6, speed=0)
        self.assertEqual(rain.mist.shape, (1, 1))
        rain.advance(5)
        self.assertTrue((rain.mist == 128).all())
        rain.finger((0.5, 0.4), (0.9, 0.4), width=0.02)
        row = rain.mist[len(rain.mist) // 2]
        self.assertEqual(row[row.size // 2], 0)
        rain.spray(0.7, 0.4)
        rain.advance(0.01)
        self.assertGreater(rain.figures.running + rain.figures.still, 100)

    def test_errors(self):
        with self.assertRaisesRegex(ds.InvalidArgument, "figure-9"):
            ds.Windshield("figure-9")
        with self.assertRaisesRegex(ds.InvalidArgument, "hysteresis"):
            ds.Windshield(hysteresis=-1)
        with self.assertRaises(ds.InvalidArgument):
            ds.Windshield(speed="5mm")
        rain = ds.Windshield()
        with self.assertRaises(ds.InvalidArgument):
            rain.advance(0)
        rain.advance(0.01)
        with self.assertRaisesRegex(ds.InvalidArgument, "slope"):
            rain.set(slope="30deg")


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-3.0-or-later
"""The package and the command give the same results."""
import json
import tempfile
import unittest
from pathlib import Path

import numpy as np

import droplet_shape as ds
from support import DATA, FONT, program, run

CASES = [
    ("ampersand.png", {}),
    ("raindrops.png", {"fill": "total", "volume": "5uL"}),
    ("letter_g_1bit.png", {"model": "exact", "contact_angle": "50deg", "tilt": "20deg"}),
    ("inkscape.png", {"model": "linear", "liquid": "glycerol", "height": "0.6mm"}),
    ("raindrops.png", {"width": "30mm", "smooth": "0.7mm", "liquid": "mercury", "contact_angle": "30deg"}),
]


class SameAsTheCommand(unittest.TestCase):
    def setUp(self):
        program()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def assert_same(self, ours, theirs):
        """Compares figures of a report with those of the command's."""
        for key in ("volume_m3", "pressure_pa", "height_max_m", "liquid_area_m2", "energy_j"):
            a, b = getattr(ours, key), theirs[key]
            if b is None:
                self.assertIsNone(a)
            else:
                self.assertAlmostEqual(a / b if b else a + 1, 1.0, delta=1e-12, msg=key)

    def test_droplets(self):
        for name, options in CASES:
            with self.subTest(name):
                words = [word for key, text in options.items() for word in ("--" + key.replace("_", "-"), text)]
                run(DATA / name, self.folder / "command.glb", *words, "--triangles", "2k", "--json", self.folder / "r.json")
                theirs = json.loads((self.folder / "r.json").read_text())
                mask = ds.read_mask(DATA / name)
                for source in (mask, np.asarray(mask)):
                    drop = ds.make_droplet(source, triangles=2000, **options)
                    self.assert_same(drop.report.shape, theirs["shape"])
                    self.assertEqual(len(drop.report.droplets), len(theirs["droplets"]))
                    for ours, other in zip(drop.report.droplets, theirs["droplets"]):
                        self.assert_same(ours, other)
                    self.assertEqual(len(drop.triangles), theirs["output"]["triangles"])
                    self.assertEqual(drop.report.mesh.triangles, theirs["mesh"]["triangles"])
                    self.assertEqual(drop.report.model, theirs["model"])
                    drop.save(self.folder / "package.glb")
                    self.assertEqual(
                        (self.folder / "package.glb").read_bytes(), (self.folder / "command.glb").read_bytes()
                    )

    def test_glyphs(self):
        run("glyphs", "--font", FONT, "--text", "Ag", "-o", self.folder / "command.glb", "--em", "1cm", "--triangles", "2k")
        ds.glyphs(FONT, "Ag", em="1cm", triangles="2k").save(self.folder / "package.glb")
        self.assertEqual((self.folder / "package.glb").read_bytes(), (self.folder / "command.glb").read_bytes())

    def test_animation(self):
        frames = sorted((DATA / "closing").glob("*.png"))[:6]
        run("animate", *frames, self.folder / "command.glb", "--triangles", "1k", "--volume", "20uL")
        film = ds.animate([ds.read_mask(frame) for frame in frames], triangles=1000, volume="20uL")
        film.save(self.folder / "package.glb")
        self.assertEqual((self.folder / "package.glb").read_bytes(), (self.folder / "command.glb").read_bytes())

    def test_comparison(self):
        for name, triangles in (("a", "1k"), ("b", "3k")):
            run(DATA / "letter_g_1bit.png", self.folder / f"{name}.glb", "--triangles", triangles, "--model", "linear")
        a, b, out = self.folder / "a.glb", self.folder / "b.glb", self.folder / "c.json"
        run("compare", a, b, "--json", out)
        theirs = json.loads(out.read_text())
        ours = ds.compare(a, b)
        self.assertEqual(ours.distance.upper_m, theirs["distance"]["upper_m"])
        self.assertEqual(ours.normals.rms_deg, theirs["normals"]["rms_deg"])

    def test_wind_tunnel(self):
        out = self.folder / "tunnel.json"
        run("wind-tunnel", out, "--preset", "thesis", "--volume", "10..50uL:10", "--slope", "20deg,30deg")
        theirs = json.loads(out.read_text())
        run_of = ds.wind_tunnel(preset="thesis", volume="10..50uL:10", slope=["20deg", "30deg"]).runs[0]
        self.assertEqual(len(run_of.cases), 10)
        for ours, other in zip(run_of.cases, theirs["runs"][0]["cases"]):
            self.assertEqual(ours.upper_threshold_m_per_s, other["upper_threshold_m_per_s"])
            self.assertEqual(list(ours.acceleration_m_per_s2), other["acceleration_m_per_s2"])

    def test_windshield(self):
        run("windshield", self.folder / "command.png", "--time", "0.2s", "--warm-up", "1s", "--frame-size", "160x90")
        ds.windshield(self.folder / "package.png", time=0.2, warm_up="1s", frame_size=(160, 90))
        self.assertEqual((self.folder / "package.png").read_bytes(), (self.folder / "command.png").read_bytes())

    def test_dew(self):
        run("dew", DATA / "can.glb", self.folder / "command.glb", "--preset", "rain", "--smallest", "1mm", "--from", "0,1,1")
        ds.dew(DATA / "can.glb", self.folder / "package.glb", preset="rain", smallest=0.001, from_=(0, 1, 1))
        self.assertEqual((self.folder / "package.glb").read_bytes(), (self.folder / "command.glb").read_bytes())

    def test_flow(self):
        run("flow", DATA / "can.glb", self.folder / "command.glb", "--drops", "30", "--time", "0.3s", "--wind-velocity", "1,0,0")
        ds.flow(DATA / "can.glb", self.folder / "package.glb", drops=30, time=0.3, wind_velocity=(1, 0, 0))
        self.assertEqual((self.folder / "package.glb").read_bytes(), (self.folder / "command.glb").read_bytes())


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-3.0-or-later
"""The widget for notebooks, with a class in place of anywidget's. tests/studio has its script in a browser."""
import contextlib
import importlib
import importlib.util
import sys
import tempfile
import types
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

import droplet_shape as ds


def load(script=None):
    """The module of the widget as it is with anywidget; script: path of its script."""
    import traitlets

    class AnyWidget(traitlets.HasTraits):
        hold_sync = contextlib.nullcontext

    stub = types.ModuleType("anywidget")
    stub.AnyWidget = AnyWidget
    with mock.patch.dict(sys.modules, {"anywidget": stub}):
        sys.modules.pop("droplet_shape.widget", None)
        module = importlib.import_module("droplet_shape.widget")
        del sys.modules["droplet_shape.widget"]
    if script:
        module._SCRIPT = script
    return module


class Alone(unittest.TestCase):
    def test_without_anywidget_the_error_names_it(self):
        with mock.patch.dict(sys.modules, {"anywidget": None}):
            with self.assertRaisesRegex(ModuleNotFoundError, "needs the package anywidget.*pip install anywidget"):
                importlib.import_module("droplet_shape.widget")
        self.assertIn("make_droplet", dir(ds))  # which works without


@unittest.skipIf(importlib.util.find_spec("traitlets") is None, "traitlets is not installed")
class Widget(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.script = Path(folder.name, "widget.js")
        cls.script.touch()
        cls.widget = load(cls.script)
        y, x = np.mgrid[-1:1:40j, -1:1:60j]
        cls.drop = ds.make_droplet(np.hypot(x, y) < 0.8, width="30mm", triangles=500)

    def test_it_has_the_bytes_of_a_droplet_and_its_ground(self):
        widget = self.widget.DropletWidget(self.drop, view={"elevation": 30}, ground="clay")
        self.assertEqual(widget.glb, self.drop.to_bytes())
        self.assertTrue(widget.flat)
        self.assertAlmostEqual(widget.sides[0] / widget.sides[1], 60 / 40)
        self.assertEqual((widget.view, widget.ground, widget.fill), ({"elevation": 30}, "clay", 1))

    def test_it_shows_another_one_from_the_same_side(self):
        widget = self.widget.DropletWidget(self.drop, view={"azimuth": 45}, fill=0.5)
        other = ds.make_droplet(np.eye(20) > -1, width="10mm", triangles=500)
        widget.show(other)
        self.assertEqual(widget.glb, other.to_bytes())
        self.assertEqual((widget.view, widget.fill), ({"azimuth": 45}, 0.5))
        widget.show(b"glTF")
        self.assertEqual(widget.glb, b"glTF")

    def test_frames_and_films_are_shown_too(self):
        film = ds.animate([np.eye(20) > -1, np.ones((20, 20))], width="10mm", triangles=300)
        self.assertEqual(self.widget.DropletWidget(film).glb, film.to_bytes())
        self.assertEqual(self.widget.DropletWidget(film[0]).glb, film[0].to_bytes())

    def test_all_traits_are_synchronised_and_described(self):
        traits = {name for name, trait in self.widget.DropletWidget.class_traits(sync=True).items()}
        self.assertEqual(traits, {"glb", "view", "fill", "time", "ground", "height", "flat", "sides"})
        for name in traits:
            self.assertRegex(self.widget.DropletWidget.__doc__, rf"\n      {name}( \[s\])?: ")

    def test_values_that_cannot_be_are_refused(self):
        import traitlets

        for wrong in ({"ground": "sea"}, {"fill": -1.0}, {"height": 0}, {"glb": "text"}):
            with self.assertRaises(traitlets.TraitError):
                self.widget.DropletWidget(self.drop, **wrong)

    def test_a_build_without_its_script_says_so(self):
        with self.assertRaisesRegex(RuntimeError, "DROPLET_PAGE=ON"):
            load(self.script.with_name("missing.js")).DropletWidget(self.drop)


if __name__ == "__main__":
    unittest.main()

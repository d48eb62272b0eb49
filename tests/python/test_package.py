# SPDX-License-Identifier: GPL-3.0-or-later
"""Names, stubs, docstrings and examples of the package."""
import ast
import contextlib
import doctest
import importlib.util
import inspect
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import droplet_shape as ds
from droplet_shape import _functions, _reports
from support import ROOT, program

PACKAGE = ROOT / "python/droplet_shape"
FUNCTIONS = ["animate", "compare", "dew", "flow", "glyphs", "make_droplet", "read_mask", "wind_tunnel", "windshield"]

# Lines from 16 on have errors of types.
TYPED = """\
import numpy
import droplet_shape as ds
drop = ds.make_droplet(numpy.zeros((3, 3)), width=0.02, contact_angle="40deg", fill_range=(0, 2))
volume: float = drop.report.shape.volume_m3
area: float = float(drop.vertices.max()) + ds.compare(drop, "drop.glb").distance.upper_m
ids: list = [frame.vertices for frame in ds.animate([numpy.zeros((3, 3))])]
code: str = ds.NoSuchDroplet.code
import io, pickle
memory = io.BytesIO()
drop.save(memory, format="ply", unit="m")
data: bytes = drop.to_bytes(nodes="each")
with open("drop.glb", "wb") as file:
    ds.animate([numpy.zeros((3, 3))]).save(file, material="ink")
ds.make_droplet(ds.read_mask("a.png", channel="luma"), grading=4, model="exact", liquid="honey")
ds.windshield("a.mp4", shutter=0.5, preset="figure-3.10")
ds.make_droplet(numpy.zeros((3, 3)), witdh=0.02)
number: int = drop.report
drop.save("drop.glb", compress="draco")
ds.make_droplet(numpy.zeros((3, 3)), grading=3)
ds.glyphs("a.ttf", "a", align="left")
drop.save(io.StringIO(), format="ply")
"""


def make_package():
    """The module python/make_package.py."""
    spec = importlib.util.spec_from_file_location("make_package", ROOT / "python/make_package.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # its dataclasses look for it there
    spec.loader.exec_module(module)
    return module


def names_of_stub(path):
    """Names that a stub defines, and the members of its classes."""
    names = {}
    for node in ast.parse(path.read_text()).body:
        if isinstance(node, ast.ClassDef):
            names[node.name] = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
        elif isinstance(node, ast.FunctionDef):
            names[node.name] = set()
        elif isinstance(node, ast.ImportFrom):
            names.update({alias.asname: set() for alias in node.names if alias.asname})
        elif isinstance(node, ast.AnnAssign):
            names[node.target.id] = set()
    return names


@contextlib.contextmanager
def folder_with_data():
    """A temporary folder with data in it, as the current one."""
    before = Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        os.symlink(ROOT / "data", Path(folder, "data"))
        os.chdir(folder)
        try:
            yield Path(folder)
        finally:
            os.chdir(before)


class Names(unittest.TestCase):
    def test_all_public_names_exist_and_are_in_the_stub(self):
        stub = names_of_stub(PACKAGE / "__init__.pyi")
        self.assertEqual(set(stub) - {"__version__"}, set(ds.__all__))
        for name in ds.__all__:
            self.assertTrue(hasattr(ds, name), name)
        self.assertEqual(sorted(ds.__all__), list(ds.__all__))
        self.assertLessEqual(set(ds.__all__), set(dir(ds)))
        with self.assertRaises(AttributeError):
            ds.nothing

    def test_members_of_the_module_are_in_its_stub(self):
        from droplet_shape import _core

        stub = names_of_stub(PACKAGE / "_core.pyi")
        public = {name for name in stub if not name.startswith("_")}
        self.assertEqual({name for name in vars(_core) if not name.startswith("_")}, public)
        for name in ("Animation", "Droplet", "Mask", "Surface"):
            members = {member for member in vars(getattr(_core, name)) if not member.startswith("_")}
            self.assertEqual(members, {member for member in stub[name] if not member.startswith("_")}, name)

    def test_mypy_knows_the_types(self):
        if importlib.util.find_spec("mypy") is None:
            self.skipTest("mypy is not installed")
        with tempfile.TemporaryDirectory() as folder:
            script = Path(folder, "script.py")
            script.write_text(TYPED)
            command = [sys.executable, "-m", "mypy", "--cache-dir", folder, "--python-version", "3.11", script]
            path = {"MYPYPATH": str(Path(ds.__file__).parents[1])}
            result = subprocess.run(command, cwd=folder, capture_output=True, text=True, env={**os.environ, **path})
        self.assertEqual(re.findall(r":(\d+): error", result.stdout), [str(line) for line in range(16, 22)], result.stdout + result.stderr)

    def test_words_are_those_of_the_command(self):
        options = make_package().read_options(program(), "")
        stub = (PACKAGE / "_core.pyi").read_text()
        for name in ("format", "material", "unit", "compress", "nodes"):
            words = re.search(rf"^_{name.capitalize()} = Literal\[(.*)\]$", stub, re.MULTILINE).group(1)
            self.assertEqual([word.strip('"') for word in words.split(", ")], options[name].value.split("|"), name)

    def test_options_with_numbers_among_their_words_take_numbers(self):
        maker = make_package()
        found = set()
        for function in maker.FUNCTIONS:
            kinds = getattr(_functions, "_" + function.name.upper())
            for name, option in maker.read_options(program(), function.command).items():
                if re.search(r"(^|\|)\d", option.value) and name in kinds:
                    self.assertEqual(kinds[name], "number", f"{function.name}: {name}")
                    found.add(name)
        self.assertIn("grading", found)
        with self.assertRaisesRegex(ds.InvalidArgument, "^shutter: '2' must be"):
            ds.windshield("a.png", shutter=2)

    def test_version(self):
        header = (ROOT / "include/droplet/version.h").read_text()
        self.assertIn(f'"{ds.__version__}"', header)


class Docstrings(unittest.TestCase):
    def test_every_public_name_has_one(self):
        for name in ds.__all__:
            value = getattr(ds, name)
            self.assertTrue((value.__doc__ or "").strip(), name)
            if inspect.isclass(value) and value.__module__ == "droplet_shape":
                for member, item in vars(value).items():
                    if not member.startswith("_"):
                        self.assertTrue((item.__doc__ or "").strip(), f"{name}.{member}")

    def test_functions_describe_all_their_arguments_and_errors(self):
        for name in FUNCTIONS:
            text = getattr(ds, name).__doc__
            for parameter in inspect.signature(getattr(ds, name)).parameters:
                self.assertRegex(text, rf"\b{parameter.rstrip('_')}\b", name)
            self.assertIn("Raises InvalidArgument", text)
            self.assertNotRegex(text, r"--[a-z]")

    def test_quantities_have_a_unit(self):
        for name in FUNCTIONS:
            function = getattr(ds, name)
            for parameter in inspect.signature(function).parameters.values():
                if "str | float" in str(parameter.annotation) and not parameter.name.endswith("hysteresis"):
                    option = parameter.name.rstrip("_")
                    self.assertRegex(function.__doc__, rf"\n      {option} \[.+?\]: |volume_tolerance:", f"{name}: {option}")


class Examples(unittest.TestCase):
    def test_docstrings(self):
        with folder_with_data():
            result = doctest.testmod(_functions)
        self.assertEqual(result.failed, 0)
        self.assertGreaterEqual(result.attempted, len(FUNCTIONS))

    def test_page(self):
        with folder_with_data():
            result = doctest.testfile(str(ROOT / "docs/python.md"), module_relative=False)
        self.assertEqual(result.failed, 0)
        self.assertGreater(result.attempted, 10)

    def test_script(self):
        if importlib.util.find_spec("matplotlib") is None:
            self.skipTest("matplotlib is not installed")
        with folder_with_data() as folder:
            subprocess.run([sys.executable, ROOT / "python/examples/plot_droplet.py"], check=True, capture_output=True)
            self.assertEqual(len(list(folder.glob("*.png"))), 4)

    def test_meshio(self):
        if importlib.util.find_spec("meshio") is None:
            self.skipTest("meshio is not installed")
        with folder_with_data() as folder:
            subprocess.run([sys.executable, ROOT / "python/examples/to_meshio.py"], check=True, capture_output=True)
            self.assertTrue((folder / "drop.vtu").exists())


class SourceArchive(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        metadata = ["egg_info", "--egg-base", cls.folder]
        command = [sys.executable, "setup.py", "--quiet", *metadata, "sdist", "--dist-dir", cls.folder]
        subprocess.run(command, cwd=ROOT, check=True, capture_output=True)
        (cls.archive,) = cls.folder.glob("*.tar.gz")
        shutil.unpack_archive(cls.archive, cls.folder / "unpacked")
        (cls.sources,) = (cls.folder / "unpacked").iterdir()

    def test_it_has_all_sources(self):
        def files(root, part):
            found = {path.relative_to(root) for path in (root / part).rglob("*") if path.is_file()}
            return {path for path in found if not re.search(r"__pycache__|\.egg-info", str(path))}

        for part in ("c", "cli", "include", "python", "src"):
            self.assertEqual(files(self.sources, part), files(ROOT, part))
        for part in ("LICENSE", "pyproject.toml", "docs/python.md", "scripts/setup"):
            self.assertEqual((self.sources / part).read_bytes(), (ROOT / part).read_bytes())

    def test_cmake_configures_it(self):
        options = ["-DDROPLET_PYTHON=ON", "-DDROPLET_TESTS=OFF", f"-DPython_EXECUTABLE={sys.executable}"]
        command = ["cmake", "-G", "Ninja", "-S", self.sources, "-B", self.folder / "build", *options]
        subprocess.run(command, check=True, capture_output=True)

    def test_pip_builds_it_alone_with_what_it_asks_for(self):
        # Wheels of Debian instead of a network; the libraries are those of a build.
        build, wheels = os.environ.get("DROPLET_BUILD"), Path("/usr/share/python-wheels")
        asked_for = importlib.util.find_spec("pybind11"), *wheels.glob("setuptools-*"), *wheels.glob("wheel-*")
        if not build or len(asked_for) != 3 or not asked_for[0]:
            self.skipTest("DROPLET_BUILD does not name a build, or Debian's wheels are not installed")
        package = self.folder / "pybind11"
        version = importlib.import_module("pybind11").__version__
        shutil.copytree(asked_for[0].submodule_search_locations[0], package / "pybind11")
        metadata = package / f"pybind11-{version}.dist-info"
        metadata.mkdir()
        (metadata / "METADATA").write_text(f"Metadata-Version: 2.1\nName: pybind11\nVersion: {version}\n")
        (metadata / "WHEEL").write_text("Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n")
        subprocess.run([sys.executable, "-m", "wheel", "pack", "-d", self.folder, package], check=True, capture_output=True)
        offline = ["--no-index", "--no-deps", "--find-links", self.folder, "--find-links", wheels]
        target = ["--target", self.folder / "package"]
        command = [sys.executable, "-m", "pip", "--isolated", "install", *offline, *target, self.archive]
        result = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        code = "import droplet_shape as ds; print(ds.read_mask('data/ring.svg'), ds.__file__)"
        path = {"PYTHONPATH": str(self.folder / "package")}
        made = subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=True, capture_output=True, text=True,
                              env={**os.environ, **path})
        self.assertRegex(made.stdout, f"^<Mask of .*{re.escape(str(self.folder))}")


class MadeFiles(unittest.TestCase):
    def test_functions_and_reports_are_up_to_date(self):
        command = [sys.executable, ROOT / "python/make_package.py", "--check", program()]
        result = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_reports_leave_out_unknown_keys(self):
        fill = _reports.ReportFill.from_json('{"by": "height_m", "amount": 1.0, "sharing": "each", "new": 3}')
        self.assertEqual((fill.amount, fill.range), (1.0, None))

    def test_messages_have_the_names_of_python(self):
        from droplet_shape._errors import in_python

        self.assertEqual(in_python("--contact-angle and --on: a--b, '--x'"), "contact_angle and on: a--b, 'x'")
        self.assertFalse(re.search("--", in_python("--warm-up")))


if __name__ == "__main__":
    unittest.main()

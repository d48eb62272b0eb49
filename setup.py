# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the Python package by CMake; docs/python.md says how to install it."""
import importlib.util
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent
VERSION = re.search(r'kVersion = "([^"]+)"', (ROOT / "include/droplet/version.h").read_text()).group(1)


class CMakeBuild(build_ext):
    """Builds and installs the component `python` of the CMake project.

    The environment variable DROPLET_BUILD may name a build folder to use again. DROPLET_PAGE=ON makes the widget for notebooks,
    too, for which npm fetches three.js.
    """

    def build_extension(self, extension):
        missing = [program for program in ("cmake", "ninja") if not shutil.which(program)]
        if missing:
            sys.exit(f"{' and '.join(missing)} missing; scripts/setup python installs all that the build needs")
        own_build = os.environ.get("DROPLET_BUILD")
        build = Path(own_build or self.build_temp).resolve()
        package = Path(self.get_ext_fullpath(extension.name)).resolve().parent
        options = {
            "CMAKE_BUILD_TYPE": "Release",
            "DROPLET_PAGE": os.environ.get("DROPLET_PAGE", "OFF"),
            "DROPLET_PYTHON": "ON",
            "DROPLET_TESTS": "OFF",
            "Python_EXECUTABLE": sys.executable,
        }
        if importlib.util.find_spec("pybind11"):  # where pip installed it
            import pybind11

            options["pybind11_DIR"] = pybind11.get_cmake_dir()
        if not own_build or not (build / "CMakeCache.txt").exists():
            definitions = [f"-D{name}={value}" for name, value in options.items()]
            subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", *definitions], check=True)
        jobs = ["--parallel", str(self.parallel)] if self.parallel else []
        targets = ["droplet_python", "droplet_svg", "droplet_codecs"]
        subprocess.run(["cmake", "--build", build, *jobs, "--target", *targets], check=True)
        install = ["cmake", "--install", build, "--component", "python", "--strip", "--prefix", package.parent]
        subprocess.run(install, check=True)


setup(
    version=VERSION,
    ext_modules=[Extension("droplet_shape._core", [])],
    cmdclass={"build_ext": CMakeBuild},
)

# SPDX-License-Identifier: GPL-3.0-or-later
"""What several tests need."""
import os
import subprocess
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "data"
FONT = Path("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf")


def disc(pixels=200, radius=0.8):
    """Mask of a disc."""
    y, x = np.mgrid[1 : -1 : pixels * 1j, -1 : 1 : pixels * 1j]
    return x**2 + y**2 < radius**2


def program():
    """Path of the command; skips the test without it."""
    path = os.environ.get("DROPLET_SHAPE")
    if not path:
        raise unittest.SkipTest("DROPLET_SHAPE does not name the command")
    return path


def run(*arguments):
    """Runs the command."""
    subprocess.run([program(), *map(str, arguments)], check=True, capture_output=True)

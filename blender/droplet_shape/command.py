# SPDX-License-Identifier: GPL-3.0-or-later
"""The command droplet-shape: finds it, runs it, reads its result. Nothing here needs Blender."""

import json
import os
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from . import glb


class DropletError(Exception):
    """What was wrong, in one line."""


@dataclass(frozen=True)
class Input:
    """A file that the command reads: one that exists, or content that is written to a temporary file."""

    name: str  # path of the file, or name of the temporary file
    content: bytes | None = None

    def placed(self, folder):
        """Path of the file, which is written to the folder if it has content."""
        if self.content is None:
            return self.name
        path = Path(folder, self.name)
        path.write_bytes(self.content)
        return str(path)

    def state(self):
        """A value that changes when the input does."""
        if self.content is not None:
            return self.content
        try:
            status = os.stat(self.name)
        except OSError:
            return None  # a pattern, or a file whose absence the command reports
        return status.st_mtime_ns, status.st_size


@dataclass(frozen=True)
class Result:
    model: glb.Model
    report: dict


def find_program(chosen):
    """Path of the command: the chosen one, or the one on PATH."""
    if chosen:
        path = os.path.abspath(os.path.expanduser(chosen))
        if not (os.path.isfile(path) and os.access(path, os.X_OK)):
            raise DropletError(f"{path} is not a program; set the path of droplet-shape in the add-on's preferences")
        return path
    path = shutil.which("droplet-shape")
    if path is None:
        raise DropletError("droplet-shape is not on PATH; set its path in the add-on's preferences")
    return path


_last = (None, None)  # the last run and its result: a change of place or scale needs no new run


def forget():
    """Drops the stored result."""
    global _last
    _last = (None, None)


def run(program, timeout, arguments, inputs, onto=None, has_report=True):
    """Runs the command.

    arguments:  the subcommand, if there is one, in arguments[0]; then options
    inputs:     footprints, or the object, in order
    onto:       object to lay the droplets on
    has_report: whether the subcommand writes one; otherwise it is empty
    Raises DropletError with the command's own message.
    """
    global _last
    key = (program, tuple(arguments), inputs, tuple(item.state() for item in inputs), onto)
    if _last[0] == key and all(state is not None for state in key[3]):
        return _last[1]
    subcommand = [name for name in arguments[:1] if not name.startswith("-")]
    with tempfile.TemporaryDirectory(prefix="droplet-shape-") as folder:
        output, report = Path(folder, "droplet.glb"), Path(folder, "report.json")
        line = [program, *subcommand, *(item.placed(folder) for item in inputs), str(output)]
        line += arguments[len(subcommand):]
        if onto is not None:
            line += ["--onto", onto.placed(folder), "--droplets-only"]  # the scene has the object
        line += ["--json", str(report), "--progress", "none"] if has_report else []
        line += ["--quiet"]
        try:
            done = subprocess.run(line, stdin=subprocess.DEVNULL, capture_output=True, timeout=timeout, cwd=folder)
        except subprocess.TimeoutExpired:
            raise DropletError(f"droplet-shape took more than {timeout} s; the add-on's preferences set this limit")
        except OSError as error:
            raise DropletError(f"{program} does not start: {error.strerror}")
        if done.returncode != 0:
            raise DropletError(_message(done, folder))
        if not (output.exists() and report.exists() == has_report):
            raise DropletError("droplet-shape wrote no droplet")
        try:
            result = Result(glb.read(output.read_bytes()), json.loads(report.read_bytes()) if has_report else {})
        except (OSError, ValueError, KeyError, IndexError, TypeError) as error:
            raise DropletError(f"droplet-shape wrote a file that cannot be read: {error!r}")
    _last = (key, result)
    return result


def _message(done, folder):
    lines = done.stderr.decode("utf-8", "replace").strip().splitlines()
    if not lines:
        return f"droplet-shape stopped with exit code {done.returncode}"
    return lines[-1].removeprefix("droplet-shape: ").replace(f"{folder}{os.sep}", "")

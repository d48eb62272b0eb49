# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs programs and measures them from outside: wall time from before the start to after the end, and peak memory by the
kernel's count."""

import dataclasses
import os
import statistics
import subprocess
import time


@dataclasses.dataclass
class Run:
    seconds: float
    peak_bytes: int
    output: str


def run(arguments, environment=None, folder=None):
    """One run; a failure ends the measurement."""
    begin = time.perf_counter()
    child = subprocess.Popen([str(a) for a in arguments], stdout=subprocess.PIPE, cwd=folder,
                             env={**os.environ, **(environment or {})})
    output = child.stdout.read()
    _, status, usage = os.wait4(child.pid, 0)
    seconds = time.perf_counter() - begin
    child.returncode = os.waitstatus_to_exitcode(status)
    child.stdout.close()
    if child.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, arguments))}: exit {child.returncode}\n{output.decode()}")
    return Run(seconds, usage.ru_maxrss * 1024, output.decode())


def alternately(count, *cases):
    """Runs cases, which are functions that return a Run, in turns, so that a slow machine slows all of them."""
    runs = [[] for _ in cases]
    for _ in range(count):
        for results, case in zip(runs, cases):
            results.append(case())
    return runs


def median(runs):
    return statistics.median(r.seconds for r in runs)


def spread(runs):
    """Half the range, relative to the median."""
    seconds = [r.seconds for r in runs]
    return 0.5 * (max(seconds) - min(seconds)) / statistics.median(seconds)


def peak(runs):
    return max(r.peak_bytes for r in runs)

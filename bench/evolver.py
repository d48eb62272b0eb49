# SPDX-License-Identifier: GPL-3.0-or-later
"""Time to the same error of the height as Surface Evolver, on four droplets of fixed volume.

Evolver begins with a mesh of droplet-shape and tries several scripts; the fastest one counts. The search is not timed,
nor is the work of droplet-shape for that mesh. Times are processor times of whole processes, user and system."""

import dataclasses
import json
import math
import os
import re
import resource
import signal
import statistics
import struct
import subprocess
import zlib

LIMIT = 1e-3                # error of the height, relative
SIZES = [125 * 2**k for k in range(12)]  # triangles that are asked for
FINEST = 640_000            # triangles of droplet-shape, for heights that no formula gives
EVOLVER_FINEST = 32_000     # triangles of Evolver's check of these heights, each with six points
EVOLVER_LARGEST = 70_000    # triangles of Evolver
RUNS = 5
SLOWER = {True: 10.0, False: 2.0}  # longest run in the search, over that of droplet-shape; with curved triangles or not
PIXELS, RADIUS = 512, 200.0
WATER = {"tension": 0.0728, "weight": 998.2 * 9.81}  # [N/m], [N/m³]: defaults of droplet-shape


@dataclasses.dataclass
class Case:
    name: str
    mask: str
    options: str
    microlitres: float
    height: float | None  # exact [m]
    check: str = ""       # how Evolver begins that checks the height of the finest mesh


# ------------------------------------------------------------------------------------------------ masks and heights

def write_png(path, coverage):
    """Grey PNG of coverage(x, y) at the centres of pixels, in pixels from the middle."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    middle = 0.5 * (PIXELS - 1)
    rows = b"".join(b"\0" + bytes(round(255 * min(max(coverage(x - middle, y - middle), 0.0), 1.0)) for x in range(PIXELS))
                    for y in range(PIXELS))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", PIXELS, PIXELS, 8, 0, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def disc(x, y):
    return RADIUS + 0.5 - math.hypot(x, y)


def star(x, y):
    """Five points; inner corners are half as far from the middle. The tenth that holds the point has one edge."""
    outer, tenth = 1.15 * RADIUS, math.pi / 5
    angle = abs((math.atan2(y, x) + math.pi / 2 + tenth) % (2 * tenth) - tenth)
    px, py = math.hypot(x, y) * math.cos(angle), math.hypot(x, y) * math.sin(angle)
    ex, ey = 0.5 * outer * math.cos(tenth) - outer, 0.5 * outer * math.sin(tenth)
    return 0.5 + (ex * py - ey * (px - outer)) / math.hypot(ex, ey)


def root(function, low, high):
    """Zero of an increasing function."""
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if function(middle) < 0.0 else (low, middle)
    return low


def cap_height(radius, volume):
    """Without gravity: the spherical cap."""
    return root(lambda h: math.pi * h * (3.0 * radius**2 + h**2) / 6.0 - volume, 0.0, 10.0 * radius)


def puddle_height(radius, volume):
    """Young and Laplace's equation of a droplet of revolution below 90°, from the top to the rim, by Runge and Kutta."""
    steps = 4000

    def shape(bend):
        """Height and volume at the rim for the curvature 2·bend at the top; infinite where the rim is not reached."""
        def rate(r, depth, sine):  # of depth, r sin ψ and volume below the top, by r
            sine = min(sine / r if r else 0.0, 1.0)
            slope = sine / math.sqrt(max(1.0 - sine * sine, 1e-12))
            return slope, r * (2.0 * bend + WATER["weight"] / WATER["tension"] * depth), math.pi * r * r * slope
        y, dr = [0.0, 0.0, 0.0], radius / steps
        for k in range(steps):
            r = k * dr
            a = rate(r, y[0], y[1])
            b = rate(r + 0.5 * dr, y[0] + 0.5 * dr * a[0], y[1] + 0.5 * dr * a[1])
            c = rate(r + 0.5 * dr, y[0] + 0.5 * dr * b[0], y[1] + 0.5 * dr * b[1])
            d = rate(r + dr, y[0] + dr * c[0], y[1] + dr * c[1])
            y = [v + dr / 6.0 * (s + 2.0 * t + 2.0 * u + w) for v, s, t, u, w in zip(y, a, b, c, d)]
            if y[1] > r + dr:
                return math.inf, math.inf
        return y[0], y[2]

    bend = math.exp(root(lambda x: shape(math.exp(x))[1] - volume, math.log(1e-6 / radius), math.log(1.0 / radius)))
    return shape(bend)[0]


def cases(root_folder, folder):
    write_png(folder / "disc.png", disc)
    write_png(folder / "star.png", star)
    metre = PIXELS / RADIUS / 1000.0  # width of the picture for a radius of 1 mm
    return [Case("letter g, 20 mm", root_folder / "data" / "letter_g_1bit.png", "--width 20mm", 38.0, None, "half, slowly"),
            Case("star, 18 mm", folder / "star.png", "--width 20mm", 60.0, None, "linear"),
            Case("bead, R = 1 mm, 140°, no gravity", folder / "disc.png", f"--width {metre}m --gravity 0m/s2", 15.13,
                 cap_height(1e-3, 15.13e-9)),
            Case("puddle, R = 20 mm, 60°", folder / "disc.png", f"--width {20 * metre}m", 2820.0,
                 puddle_height(20e-3, 2820e-9))]


# ------------------------------------------------------------------------------------------------------ two programs

@dataclasses.dataclass
class Run:
    size: int              # triangles that were asked for
    triangles: int
    height: float          # [m]
    seconds: float
    solve_seconds: float = 0.0
    script: "Script | None" = None


def processor_time(arguments, longest=600.0):
    """Processor time of a process, and what it prints; None if it fails, infinite if it takes longer."""
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(longest), math.ceil(longest)))

    child = subprocess.Popen([str(a) for a in arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, preexec_fn=limit)
    text = child.stdout.read().decode(errors="replace")
    child.stdout.close()
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode == -signal.SIGXCPU or child.returncode == -signal.SIGKILL:
        return math.inf, text
    return (usage.ru_utime + usage.ru_stime if child.returncode == 0 else None), text


class Bench:
    def __init__(self, program, folder):
        self.program, self.folder, self.starts = program, folder, {}

    def call(self, case, size, share=1.0):
        return [self.program, case.mask, self.folder / "droplet.glb", "--quiet", "--threads", "1", "--triangles", size,
                "--volume", f"{share * case.microlitres:.12g}uL", *case.options.split()]

    def ours(self, case, size):
        report = self.folder / "report.json"
        _, text = processor_time([*self.call(case, size), "--json", report])
        seconds, _ = processor_time(self.call(case, size))
        if seconds is None:
            raise RuntimeError(f"{case.name}, {size} triangles: {text}")
        found = json.loads(report.read_text())
        return Run(size, found["mesh"]["triangles"], found["shape"]["height_max_m"], seconds,
                   found["time_s"]["assemble"] + found["time_s"]["solve"])

    def start(self, case, kind, size):
        """Datafile from which Evolver begins, and its unit of length."""
        path = self.folder / f"{self.names(case)}_{kind.split(',')[0]}_{size}.fe"
        if path not in self.starts:
            path.unlink(missing_ok=True)
            options = ["--model", "linear"] if kind == "linear" else []
            _, text = processor_time([*self.call(case, size, SHARE[kind]), *options, "--export-evolver", path])
            if not path.exists():
                raise RuntimeError(f"{case.name}, {size} triangles: {text}")
            self.starts[path] = float(re.search(r"unit of length is (\S+) m", path.read_text())[1])
        return path, self.starts[path]

    @staticmethod
    def names(case):
        return case.name.split()[0].strip(",")

    def theirs(self, case, script, size, longest=600.0, further=False):
        """None where Evolver fails or misses the volume."""
        path, unit = self.start(case, script.start, size)
        commands = self.folder / "commands.txt"
        commands.write_text("\n".join([*script.commands(further), 'printf "reached %.17g %.17g %g\\n", max(vertex, z), '
                                       "body[1].volume, facet_count", "q", "q", ""]))
        seconds, text = processor_time(["evolver", "-f", commands, path], longest)
        found = re.search(r"^reached (\S+) (\S+) (\S+)$", text, re.MULTILINE)
        if seconds == math.inf:
            return Run(size, 0, math.nan, seconds)
        if seconds is None or not found:
            return None
        try:
            height, volume = (float(x) for x in found.groups()[:2])
        except ValueError:  # (NaN)
            return None
        if not abs(volume * unit**3 / (1e-9 * case.microlitres) - 1.0) < 1e-4:
            return None
        return Run(size, int(found[3]), height * unit, seconds, script=script)


# ------------------------------------------------------------------------------------------------- Evolver's scripts

def filled(steps):
    """Commands that fill a mesh of half the volume by equal factors."""
    return ["start := body[1].volume; m 0",
            *(f"set body target start*2^({k}/{steps}); g; u; V; u; hessian; hessian" for k in range(1, steps + 1))]


# Evolver begins with the heights of the linear model, or with half of the volume.
SHARE = {"linear": 1.0, "half": 0.5, "half, slowly": 0.5}
BEGIN = {
    "half": filled(2),
    "half, slowly": [*filled(5), "u; V; u; hessian; hessian"],
    # Newton's method with a line search, until full steps are safe.
    "linear": ["freely; m 0; g; hessian_seek; hessian_seek; hessian"],
}
REFINE = ["r; u; hessian", "r; u; V; u; hessian; hessian"]
QUADRATIC = ["M 2; hessian", "M 2; hessian; hessian", "M 2; hessian_seek; hessian; hessian"]


@dataclasses.dataclass(frozen=True)
class Script:
    start: str
    levels: tuple
    quadratic: bool

    def commands(self, further=False):
        """All commands; `further` divides every triangle once more."""
        more = "r; hessian; hessian" if self.quadratic else self.levels[-1] if self.levels else REFINE[1]
        return [*BEGIN[self.start], *self.levels, *([more] if further else [])]


def scripts():
    """Triangles are divided up to three times, and get curved edges (M 2) on demand."""
    for start in BEGIN:
        for last in QUADRATIC:
            yield Script(start, (last,), True)
            yield from (Script(start, (refine, last), True) for refine in REFINE)
        yield Script(start, (), False)
        yield from (Script(start, count * (refine,), False) for count in (1, 2, 3) for refine in REFINE)


def is_within(run, height):
    return run is not None and abs(run.height / height - 1.0) <= LIMIT


def fastest(bench, case, height, quadratic, longest):
    """Evolver's fastest run that is within the limit, and is so with triangles that are divided once more, too; None if
    none takes less than the longest time."""
    best = None
    for script in scripts():
        if script.quadratic != quadratic:
            continue
        for size in SIZES:
            if size * 4 ** sum(level.startswith("r") for level in script.levels) > EVOLVER_LARGEST:
                break
            run = bench.theirs(case, script, size, longest)
            if run and run.seconds > longest:
                break
            if is_within(run, height) and is_within(bench.theirs(case, script, size, 10.0 * longest, further=True), height):
                best, longest = run, run.seconds
    return best


def coarsest(bench, case, height):
    """The fewest triangles of droplet-shape within the limit, and is so with twice as many, too."""
    runs = [bench.ours(case, size) for size in SIZES]
    return next((run for run, finer in zip(runs, runs[1:]) if is_within(run, height) and is_within(finer, height)), None)


# -------------------------------------------------------------------------------------------------------- the results

def measured(bench, case):
    height, difference, check, finest = case.height, None, None, None
    if height is None:
        finest = bench.ours(case, FINEST)
        height = finest.height
        script = Script(case.check, (QUADRATIC[-1] + "; hessian",), True)
        check = bench.theirs(case, script, EVOLVER_FINEST)
        difference = check.height / height - 1.0 if check else None
    ours = coarsest(bench, case, height)
    longest = ours.seconds if ours else 0.0
    theirs = [run for quadratic in (False, True) if (run := fastest(bench, case, height, quadratic, SLOWER[quadratic] * longest))]
    again = [[] for _ in range(1 + len(theirs))]
    for _ in range(RUNS if ours else 0):  # in turns, so that a slow machine slows both
        again[0].append(bench.ours(case, ours.size))
        for runs, run in zip(again[1:], theirs):
            runs.append(bench.theirs(case, run.script, run.size))

    def summary(run, runs):
        return {"size": run.size, "triangles": run.triangles, "error": run.height / height - 1.0,
                "seconds": statistics.median(r.seconds for r in runs),
                "solve_seconds": statistics.median(r.solve_seconds for r in runs),
                "commands": run.script.commands() if run.script else [], "start": run.script.start if run.script else "",
                "quadratic": bool(run.script and run.script.quadratic)}

    return {"name": case.name, "options": case.options, "microlitres": case.microlitres, "height": height,
            "exact": case.height is not None, "difference": difference, "slower": {"curved": SLOWER[True], "flat": SLOWER[False]},
            "finest": finest.triangles if finest else None, "check_triangles": check.triangles if check else None,
            "ours": summary(ours, again[0]) if ours else None,
            "theirs": [summary(run, runs) for run, runs in zip(theirs, again[1:])]}


def run(root_folder, program, folder):
    folder.mkdir(parents=True, exist_ok=True)
    bench = Bench(program, folder)
    commit = subprocess.run(["git", "-C", root_folder, "describe", "--always"], capture_output=True, text=True).stdout.strip()
    return [{"commit": commit, **measured(bench, case)} for case in cases(root_folder, folder)]

# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs all measurements one after another. The results are plain data, ready for JSON."""

import json
import math
import os
import pathlib
import platform
import re
import statistics
import subprocess
import sys

import evolver
import freefem
import process

SIZES = [100_000, 400_000, 1_000_000, 4_000_000]
REFERENCE = 16_000_000    # triangles; their volume and height count as exact for up to 4 M
MASKS = [2048, 512, 1024, 4096, 8192]  # the first one is meshed at every size
DEFAULT_MASK = 1024
LARGEST_MASK = 16384
AGREEMENT = 1e-3  # largest difference of volume and height from FreeFem++, so that both did the same work
WATER = {"tension": 0.0728, "weight": 998.2 * 9.81}  # [N/m], [N/m³]: defaults of droplet-shape
CAPILLARY_LENGTHS = 3.0


def log(text):
    print(f"bench: {text}", file=sys.stderr, flush=True)


def runs_of(triangles):
    return 5 if triangles <= 1_000_000 else 3


def short_name(triangles):
    return f"{triangles // 1_000_000}M" if triangles % 1_000_000 == 0 else f"{triangles // 1000}k"


# ------------------------------------------------------------------------------------------------------ the machine

def output_of(*arguments):
    try:
        return subprocess.run(arguments, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def machine(build):
    cpu = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    cache = (build / "CMakeCache.txt").read_text()
    compiler = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.*)$", cache, re.MULTILINE).group(1)
    packages = ["freefem++", "libcgal-dev", "libeigen3-dev", "libopenblas0-pthread", "libtbb-dev",
                "libbenchmark-dev"]
    versions = dict(line.split("=") for line in
                    output_of("dpkg-query", "--show", "--showformat", "${Package}=${Version}\n", *packages).split())
    return {"cpu": cpu.group(1) if cpu else platform.machine(), "cores": len(os.sched_getaffinity(0)),
            "memory_gib": round(memory / 2**30), "system": output_of("uname", "-sr"),
            "compiler": output_of(compiler, "--version").splitlines()[0], "packages": versions,
            "commit": output_of("git", "-C", str(build), "describe", "--always", "--dirty")}


def tables(*command):
    """Tables that a program prints, ready for RESULTS.md."""
    return subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout.strip()


# ------------------------------------------------------------------------------- stages and peers: Google Benchmark

def stages(build, masks, quick):
    """One entry per case: parts of its name, median time, half the range of times, and counters."""
    out = build / "stages.json"
    subprocess.run([build / "bench" / "droplet_bench", f"--largest={100_000 if quick else 4_000_000}",
                    f"--benchmark_out={out}", "--benchmark_out_format=json", "--benchmark_display_aggregates_only=true",
                    "--benchmark_min_time=0.1", *masks], cwd=build, check=True, stdout=sys.stderr)
    skip = {"name", "family_index", "per_family_instance_index", "run_name", "run_type", "repetitions", "threads",
            "repetition_index", "iterations", "real_time", "cpu_time", "time_unit"}
    cases = {}
    for entry in json.loads(out.read_text())["benchmarks"]:
        if entry["run_type"] == "iteration":
            cases.setdefault(entry["run_name"].split("/repeats")[0].split("/real_time")[0], []).append(entry)
    result = []
    for name, entries in cases.items():
        seconds = [entry["real_time"] / 1000.0 for entry in entries]
        counters = {key: statistics.median(entry[key] for entry in entries) for key in entries[0] if key not in skip}
        counters["peak_bytes"] = max(entry.get("peak_bytes", 0) for entry in entries)
        result.append({"name": name.split("/"), "runs": len(entries), "seconds": statistics.median(seconds),
                       "spread": 0.5 * (max(seconds) - min(seconds)) / statistics.median(seconds), **counters})
    return result


# ------------------------------------------------------------------------------------------------- whole processes

class Command:
    """droplet-shape, from a mask to a GLB and a report."""

    def __init__(self, program, mask, folder):
        self.program, self.mask, self.folder = program, mask, folder

    def start(self, *options):
        self.output.unlink(missing_ok=True)
        return process.run([self.program, self.mask, self.output, "--quiet", *options])

    def reported(self, *options):
        """A run with the report of a second run as its output, because writing a report takes time."""
        report = self.folder / "report.json"
        run = self.start(*options)
        self.start("--json", report, *options)
        run.output = json.loads(report.read_text())
        return run

    @property
    def output(self):
        return self.folder / "droplet.glb"


def summary(runs):
    """Medians of several reported runs."""
    report = runs[0].output
    times = {stage: statistics.median(run.output["time_s"][stage] for run in runs) for stage in report["time_s"]}
    return {"seconds": process.median(runs), "spread": process.spread(runs), "runs": len(runs),
            "peak_bytes": process.peak(runs), "stages": times, "bytes": report["output"]["bytes"],
            "closed": report["output"]["closed"], "triangles": report["mesh"]["triangles"],
            "surface_triangles": report["output"]["triangles"], "min_angle_deg": report["mesh"]["min_angle_deg"],
            "area": report["mesh"]["footprint_area_m2"], "method": report["solve"]["method"],
            "iterations": report["solve"]["iterations"], "residual": report["solve"]["residual"],
            "unit_volume": report["shape"]["volume_m3"] / report["shape"]["pressure_pa"],
            "unit_height": report["shape"]["height_max_m"] / report["shape"]["pressure_pa"]}


def whole(command, sizes):
    return {short_name(size): summary([command.reported("--triangles", size) for _ in range(runs_of(size))])
            for size in sizes}


# --------------------------------------------------------------------------------------------------------- FreeFem++

def outline(build, mask, spacing):
    """Loops of the letter, with points at the given spacing [mm]."""
    numbers = iter(subprocess.run([build / "bench" / "bench_outline", mask, repr(spacing)], capture_output=True,
                                  text=True, check=True).stdout.split())
    return [[(float(next(numbers)), float(next(numbers))) for _ in range(int(count))] for count in numbers]


def against_freefem(build, command, folder, size):
    """Both programs on the letter, in turns; FreeFem++ with its faster number of BLAS threads."""
    triangles = command.reported("--triangles", size).output["mesh"]["triangles"]
    area = command.reported("--triangles", 5_000).output["mesh"]["footprint_area_m2"]
    loops = freefem.fitted(lambda spacing: outline(build, command.mask, spacing), area, triangles, folder, WATER)
    tried = {threads: freefem.solve(loops, folder, WATER, threads)[0].seconds for threads in (1, 2)}
    threads = min(tried, key=tried.get)
    found = []

    def theirs():
        run, solution = freefem.solve(loops, folder, WATER, threads)
        found.append(solution)
        return run

    their_runs, our_runs = process.alternately(5, theirs, lambda: command.reported("--triangles", size))
    stages = {stage: statistics.median(getattr(s, stage) for s in found) for stage in ("mesh", "assemble", "solve")}
    ours = summary(our_runs)
    difference = max(abs(found[0].unit_volume / ours["unit_volume"] - 1.0),
                abs(found[0].unit_height / ours["unit_height"] - 1.0))
    if difference > AGREEMENT:
        raise RuntimeError(f"FreeFem++ and droplet-shape differ by {difference} in volume or height")
    return {"ours": ours, "difference": difference,
            "theirs": {"seconds": process.median(their_runs), "spread": process.spread(their_runs), "runs": 5,
                       "peak_bytes": process.peak(their_runs), "stages": stages, "triangles": found[0].triangles,
                       "unit_volume": found[0].unit_volume, "unit_height": found[0].unit_height,
                       "blas_threads": threads, "first_run_by_threads": tried}}


def bessel_i(order, x):
    """Modified Bessel function of the first kind, by its series for small x."""
    return sum((0.5 * x) ** (2 * k + order) / (math.factorial(k) * math.factorial(k + order)) for k in range(40))


def freefem_on_disc(folder, size):
    """Errors of FreeFem++ against the exact solution: height in the middle, and volume. Times are not measured."""
    radius = CAPILLARY_LENGTHS * math.sqrt(WATER["tension"] / WATER["weight"])
    i0, i1 = bessel_i(0, CAPILLARY_LENGTHS), bessel_i(1, CAPILLARY_LENGTHS)
    height = (1.0 - 1.0 / i0) / WATER["weight"]
    volume = 2.0 * math.pi * radius**2 / WATER["weight"] * (0.5 - i1 / (CAPILLARY_LENGTHS * i0))

    def circle(spacing):
        millimetres = 1000.0 * radius
        count = round(2.0 * math.pi * millimetres / spacing)
        angles = [2.0 * math.pi * k / count for k in range(count)]
        return [[(millimetres * math.cos(a), millimetres * math.sin(a)) for a in angles]]

    loops = freefem.fitted(circle, math.pi * radius**2, size, folder, WATER)
    solution = freefem.solve(loops, folder, WATER, 1)[1]
    return {"triangles": solution.triangles, "height_error": abs(solution.unit_height / height - 1.0),
            "volume_error": abs(solution.unit_volume / volume - 1.0)}


# ----------------------------------------------------------------------------------------------------------- the run

def run(root, build, native, quick):
    folder = build / "measured"
    folder.mkdir(exist_ok=True)
    subprocess.run([root / "bench" / "masks.py", folder, *map(str, MASKS), str(LARGEST_MASK)],
                   check=True)
    masks = [folder / f"letter_{pixels}.png" for pixels in MASKS]
    program = pathlib.Path("cli") / "droplet-shape"
    command = Command(build / program, masks[0], folder)
    results = {"machine": machine(build), "quick": quick}
    sizes = [size for size in SIZES if not quick or size <= 100_000]

    log("whole processes")
    command.start()  # loads the libraries once
    results["whole"] = whole(command, sizes)
    finest = sizes[-1] if quick else REFERENCE
    reference = summary([command.reported("--triangles", finest)])
    results["reference"] = {key: reference[key] for key in ("triangles", "unit_volume", "unit_height")}

    log("a default run")
    default = Command(build / program, folder / f"letter_{DEFAULT_MASK}.png", folder)
    results["default"] = summary([default.reported() for _ in range(15)])
    results["default"]["plain_seconds"] = process.median([default.start() for _ in range(15)])
    version = [process.run([build / program, "--version"]) for _ in range(15)]
    results["start"] = {"seconds": process.median(version), "peak_bytes": process.peak(version)}

    poster = Command(build / program, folder / f"letter_{LARGEST_MASK}.png", folder)
    results["largest_mask"] = summary([poster.reported() for _ in range(3)])

    triangles = sizes[-1] if quick else 1_000_000
    log("threads and -march=native")
    portable = ["--triangles", triangles]
    ours = Command(native / program, masks[0], folder)
    one, two, own = process.alternately(5, lambda: command.reported(*portable, "-j", "1"),
                                        lambda: command.reported(*portable, "-j", "2"),
                                        lambda: ours.reported(*portable, "-j", "2"))
    results["threads"] = {"size": short_name(triangles), "1": summary(one), "2": summary(two)}
    results["native"] = {"size": short_name(triangles), "portable": summary(two), "native": summary(own)}

    log("FreeFem++")
    against = [size for size in (10_000, 100_000, 1_000_000) if not quick or size <= 100_000]
    results["freefem"] = {short_name(size): against_freefem(build, command, folder, size) for size in against}
    results["freefem_disc"] = {short_name(size): freefem_on_disc(folder, size) for size in against}

    log("stages and peers")
    results["stages"] = stages(build, masks, quick)

    log("Surface Evolver")
    results["evolver"] = evolver.run(root, build / program, folder / "evolver")
    log("the wind tunnel")
    results["tunnel"] = tables(build / "bench" / "bench_tunnel")
    log("the windshield")
    results["windshield"] = tables(build / "bench" / "bench_windshield", f"--hour={60 if quick else 600}")
    log("the driver's view")
    results["view"] = tables(build / "bench" / "bench_view")
    log("droplets on meshes")
    results["flow"] = tables(build / "bench" / "bench_flow", *(["--quick"] if quick else []))
    log("sheets")
    results["sheet"] = tables(build / "bench" / "bench_sheet", *(["--quick"] if quick else []))
    log("liquids in the plane")
    results["liquid2d"] = tables(build / "bench" / "bench_liquid2d", *(["--quick"] if quick else []))
    return results

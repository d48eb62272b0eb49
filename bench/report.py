# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes RESULTS.md, growth.svg and the profile in README.md from the measurements of campaign.py."""

import math

import picture

# Times of a million triangles before optimisation: CGAL refined everything, Eigen factorised at every size, and the
# base was as fine as the dome [s].
BEFORE = {"read": 0.017, "trace": 0.036, "triangulate": 1.54, "assemble": 0.17, "solve": 2.81, "loft": 0.79,
          "write": 0.22, "total": 5.6}
STAGES = ["read", "trace", "triangulate", "assemble", "solve", "loft", "write"]


# ---------------------------------------------------------------------------------------------------------- numbers

def count(triangles):
    return f"{triangles:,.0f}".replace(",", " ")


def seconds(value):
    """Time with three significant digits, without exponent."""
    digits = 2 - math.floor(math.log10(value)) if value > 0 else 0
    return f"{value:.{max(0, digits)}f} s" if value >= 0.1 else f"{1000 * value:.{max(0, digits - 3)}f} ms"


def megabytes(value):
    return f"{value / 1e6:.0f} MB" if value >= 1e7 else f"{value / 1e6:.1f} MB"


def small(value):
    return f"{value:.1e}" if value else "0"


def exponent(points):
    """Slope of the straight line fitted to the logarithms."""
    logs = [(math.log(x), math.log(y)) for x, y in points]
    x_mean = sum(x for x, _ in logs) / len(logs)
    y_mean = sum(y for _, y in logs) / len(logs)
    return (sum((x - x_mean) * (y - y_mean) for x, y in logs) / sum((x - x_mean) ** 2 for x, _ in logs))


def table(head, rows, words=(0,)):
    """Markdown table: columns in `words` are aligned left, all others right."""
    lines = ["| " + " | ".join(head) + " |",
             "| " + " | ".join("---" if k in words else "---:" for k in range(len(head))) + " |"]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows]) + "\n"


class Results:
    """Measurements by name."""

    def __init__(self, results):
        self.data = results
        self.by_name = {"/".join(case["name"]): case for case in results["stages"]}

    def stage(self, name):
        return self.by_name.get(name)

    def stages(self, *prefix):
        return [case for case in self.data["stages"] if case["name"][:len(prefix)] == list(prefix)]

    def volume_error(self, case):
        """Error of the volume at unit pressure against the finest mesh; None for that mesh itself."""
        reference = self.data["reference"]
        if case["triangles"] > 0.9 * reference["triangles"]:
            return None
        return abs(case["unit_volume"] / reference["unit_volume"] - 1.0)

    def height_error(self, case):
        reference = self.data["reference"]
        if case["triangles"] > 0.9 * reference["triangles"]:
            return None
        return abs(case["unit_height"] / reference["unit_height"] - 1.0)

    def growth(self, stage):
        """Exponent of the time of a stage, or of the whole process, from the smallest size to the largest."""
        points = [(whole["triangles"], whole["seconds"] if stage == "process" else whole["stages"][stage])
                  for whole in self.data["whole"].values()]
        return exponent(points) if len(points) > 1 else None


def error(value):
    return "–" if value is None else small(value)


# ---------------------------------------------------------------------------------------------------------- targets

def verdict(reached):
    return "**reached**" if reached else "**not reached**"


def targets(results):
    """Each target with its measurement and whether it is reached; targets without a measurement are left out."""
    data, rows = results.data, []

    def add(work, target, found, reached):
        rows.append((work, target, found, verdict(reached)))

    for size, wanted in (("1M", 45.0), ("100k", 9.0)):
        if size in data["freefem"]:
            ours, theirs = data["freefem"][size]["ours"], data["freefem"][size]["theirs"]
            ratio = theirs["seconds"] / ours["seconds"]
            add(f"mask to GLB, {count(ours['triangles'])} footprint triangles, whole process, against FreeFem++",
                f"≥ {wanted:.0f}×", f"{ratio:.1f}× ({seconds(ours['seconds'])} against {seconds(theirs['seconds'])})",
                ratio >= wanted)
    ours, theirs = results.stage("Triangulate/letter/1M"), results.stage("Triangulate/Delaunay_mesher_2/1M")
    if ours and theirs:
        ratio = theirs["seconds"] / ours["seconds"]
        add("triangulation at 1 M, against `CGAL::Delaunay_mesher_2`", "≥ 80×, angles ≥ 20°",
            f"{ratio:.0f}× ({seconds(ours['seconds'])} against {seconds(theirs['seconds'])}), smallest angle "
            f"{ours['min_angle_deg']:.1f}°", ratio >= 80.0 and ours["min_angle_deg"] >= 20.0)
    ours, theirs = results.stage("Solve/multigrid-pcg/letter/1M"), results.stage("Solve/Eigen SimplicialLLT/1M")
    if ours and theirs:
        ratio = theirs["seconds"] / ours["seconds"]
        add("linear solve at 1 M, assembly and set-up included, against Eigen `SimplicialLLT` (AMD), assembly not "
            "included", "≥ 20×, residual ≤ 1e-9, less memory",
            f"{ratio:.1f}× ({seconds(ours['seconds'])} against {seconds(theirs['seconds'])}), residual "
            f"{small(ours['residual'])}, {megabytes(ours['peak_bytes'])} against {megabytes(theirs['peak_bytes'])}",
            ratio >= 20.0 and ours["residual"] <= 1e-9 and ours["peak_bytes"] < theirs["peak_bytes"])
    exponents = {stage: results.growth(stage) for stage in [*STAGES, "process"]}
    if all(value is not None for value in exponents.values()):
        worst = max(exponents, key=exponents.get)
        add("growth of time from 100 k to 4 M triangles, every stage and the whole process", "exponent ≤ 1.1",
            f"at most {exponents[worst]:.2f} ({worst}); whole process {exponents['process']:.2f}",
            exponents[worst] <= 1.1)
    memory = {size: whole["peak_bytes"] / whole["triangles"] for size, whole in data["whole"].items()
              if size in ("1M", "4M")}
    if memory:
        add("peak memory per footprint triangle, closed output included", "≤ 300 bytes",
            ", ".join(f"{value:.0f} at {size}" for size, value in memory.items()), max(memory.values()) <= 300.0)
    plain = data["default"]["plain_seconds"]
    add("default run on a 1024 px PNG, process start included", "≤ 0.065 s", seconds(plain), plain <= 0.065)
    largest = data["largest_mask"]
    add("a 16384² mask, default run", "< 2 GiB",
        f"{largest['peak_bytes'] / 2**30:.2f} GiB, {seconds(largest['seconds'])}", largest["peak_bytes"] < 2**31)
    draft = results.stage("Draft/1024px")
    add("draft of 5 k triangles, 1024 px mask in memory to surface in memory", "≤ 10 ms", seconds(draft["seconds"]),
        draft["seconds"] <= 0.01)
    return table(["work", "target", "measured", ""], rows, words=range(4))


# --------------------------------------------------------------------------------------------------------- sections

def machine(data):
    found = data["machine"]
    versions = ", ".join(f"{name} {version}" for name, version in found["packages"].items())
    return (f"{found['cpu']}, {found['cores']} cores, {found['memory_gib']} GiB; {found['system']}; "
            f"{found['compiler']}, `-O3`, no `-march`; {versions}. Commit {found['commit']}.\n")


def freefem(results):
    rows = []
    for size, both in results.data["freefem"].items():
        for name, run in (("droplet-shape", both["ours"]), ("FreeFem++", both["theirs"])):
            ratio = both["theirs"]["seconds"] / both["ours"]["seconds"]
            rows.append((name, count(run["triangles"]), seconds(run["seconds"]), f"{100 * run['spread']:.0f} %",
                         megabytes(run["peak_bytes"]), megabytes(run["bytes"]) if "bytes" in run else "–",
                         error(results.volume_error(run)), error(results.height_error(run)),
                         f"{ratio:.1f}×" if name == "droplet-shape" else ""))
    whole = table(["", "triangles", "seconds", "±", "peak memory", "file", "error of volume", "of height", "faster"],
                  rows)
    parts = []
    for size, both in results.data["freefem"].items():
        ours, theirs = both["ours"]["stages"], both["theirs"]["stages"]
        parts.append((count(both["ours"]["triangles"]), f"{seconds(ours['triangulate'])} / {seconds(theirs['mesh'])}",
                      f"{seconds(ours['assemble'])} / {seconds(theirs['assemble'])}",
                      f"{seconds(ours['solve'])} / {seconds(theirs['solve'])}",
                      both["theirs"]["blas_threads"]))
    disc = []
    for size, theirs in results.data["freefem_disc"].items():
        ours = results.stage(f"Solve/multigrid-pcg/disc/{size}")
        if ours:
            disc.append((count(ours["triangles"]), small(ours["volume_error"]), small(ours["middle_error"]),
                         count(theirs["triangles"]), small(theirs["volume_error"]), small(theirs["height_error"])))
    return (whole + "\nTimes of droplet-shape / FreeFem++:\n\n"
            + table(["triangles", "mesh", "assemble", "solve", "BLAS threads of FreeFem++"], parts, words=())
            + "\nOn the disc of three capillary lengths, whose exact solution is known:\n\n"
            + table(["triangles", "error of volume", "of height", "FreeFem++: triangles", "error of volume",
                     "of height"], disc, words=()))


def whole(results):
    rows = []
    for run in results.data["whole"].values():
        rows.append((count(run["triangles"]), seconds(run["seconds"]), f"{100 * run['spread']:.0f} %",
                     *(seconds(run["stages"][stage]) for stage in STAGES),
                     f"{run['peak_bytes'] / run['triangles']:.0f}", megabytes(run["bytes"]),
                     error(results.volume_error(run))))
    exponents = [results.growth(stage) for stage in ["process", *STAGES]]
    if exponents[0] is not None:
        rows.append(("exponent", f"{exponents[0]:.2f}", "", *(f"{value:.2f}" for value in exponents[1:]), "", "", ""))
    return table(["triangles", "process", "±", *STAGES, "peak B per triangle", "file", "error of volume"], rows,
                 words=())


def small_runs(data):
    default, start = data["default"], data["start"]
    stages = ", ".join(f"{stage} {seconds(default['stages'][stage])}" for stage in STAGES)
    return (f"A default run, {count(default['triangles'])} triangles from a 1024 px mask, takes "
            f"{seconds(default['plain_seconds'])} and {megabytes(default['peak_bytes'])}: {stages}. `--version` alone "
            f"takes {seconds(start['seconds'])} and {megabytes(start['peak_bytes'])}.\n")


def solvers(results):
    rows = []
    for case in results.stages("Solve"):
        name, *where = case["name"][1:]
        shape = where[0] if len(where) > 1 else "letter"
        found = case.get("error")
        volume = case.get("volume_error", results.volume_error(case) if "unit_volume" in case else None)
        rows.append((shape, name, count(case["triangles"]), seconds(case["seconds"]), f"{100 * case['spread']:.0f} %",
                     megabytes(case["peak_bytes"]),
                     f"{case['solver_iterations']:.0f}" if "solver_iterations" in case else "–",
                     small(case["residual"]), error(found), error(volume)))
    rows.sort(key=lambda row: (row[0], int(row[2].replace(" ", "")) // 10_000, row[1]))
    return table(["domain", "solver", "triangles", "time", "±", "memory", "iterations", "residual", "error of heights",
                  "of volume"], rows, words=(0, 1))


def other_stages(results):
    rows = []
    for case in results.data["stages"]:
        if case["name"][0] in ("Solve", "Grading"):
            continue
        quality = []
        if "min_angle_deg" in case:
            quality.append(f"smallest angle {case['min_angle_deg']:.1f}°")
        if "error" in case:
            quality.append(f"error of area {small(case['error'])}")
        if "bytes" in case:
            quality.append(f"{megabytes(case['bytes'])} written")
        if "closed" in case:
            quality.append("closed" if case["closed"] else "open")
        rows.append((" ".join(case["name"][:-1]) if "triangles" in case and case["name"][0] != "Draft"
                     else " ".join(case["name"]), count(case["triangles"]) if "triangles" in case else "–",
                     seconds(case["seconds"]), f"{100 * case['spread']:.0f} %", megabytes(case["peak_bytes"]),
                     ", ".join(quality)))
    return table(["stage", "triangles", "time", "±", "memory", "quality"], rows, words=(0, 5))


def pixel_growth(results):
    lines = []
    for stage in ("Read", "Trace"):
        points = [(case["pixels"], case["seconds"]) for case in results.stages(stage)]
        lines.append(f"{stage} grows as pixels^{exponent(points):.2f}")
    return f"{', '.join(lines)} (512 px to 8192 px square).\n"


def threads_and_instructions(results):
    one, two = results.data["threads"]["1"], results.data["threads"]["2"]
    portable, native = results.data["native"]["portable"], results.data["native"]["native"]

    def times(stage):
        return [run["seconds"] if stage == "process" else run["stages"][stage] for run in (one, two, native)]

    rows = [(stage, *map(seconds, times(stage)), f"{times(stage)[0] / times(stage)[1]:.2f}×")
            for stage in [*STAGES, "process"]]
    gain = portable["seconds"] / native["seconds"]
    return (table(["stage", "1 thread", "2 threads", "2 threads, `-march=native`", "2 threads faster by"], rows)
            + f"\nWith `-march=native` the whole process is {gain:.2f}× as fast "
              f"({count(portable['triangles'])} triangles).\n")


def grading(results):
    """Number of triangles of each grading for the same error of the volume as a uniform mesh."""
    cases = results.stages("Grading")
    if not cases:
        return None
    reference = results.data["reference"]["unit_volume"]
    curves = {}
    for case in cases:
        found = case.get("volume_error", abs(case["unit_volume"] / reference - 1.0))
        curves.setdefault(case["name"][1], {}).setdefault(int(case["grading"]), []).append((case["triangles"], found))
    rows = []
    for shape, by_grading in curves.items():
        for uniform, wanted in by_grading[1]:
            if not 30_000 < uniform < 50_000:
                continue
            needed = [triangles_for(wanted, sorted(curve)) for grade, curve in sorted(by_grading.items()) if grade > 1]
            rows.append((shape, small(wanted), count(uniform), *(count(n) if n else "–" for n in needed)))
    grades = sorted(grade for grade in next(iter(curves.values())) if grade > 1)
    return table(["shape", "error of volume", "uniform", *(f"`--grading {grade}`" for grade in grades)], rows)


def triangles_for(wanted, curve):
    """Number of triangles at which a curve of (triangles, error) reaches an error, interpolated in logarithms."""
    for (n0, e0), (n1, e1) in zip(curve, curve[1:]):
        if e0 >= wanted >= e1:
            share = math.log(e0 / wanted) / math.log(e0 / e1)
            return math.exp(math.log(n0) + share * math.log(n1 / n0))
    return None


def evolver(rows):
    """Time to the same error as Surface Evolver, with the scripts of its fastest runs."""
    lines, scripts = [], []
    for row in rows:
        ours = row["ours"]
        if not ours:
            lines.append((row["name"], "droplet-shape", "–", "none is within the limit", "–", "–", "–"))
            continue
        lines.append((row["name"], "droplet-shape", count(ours["triangles"]), small(abs(ours["error"])),
                      seconds(ours["seconds"]), seconds(ours["solve_seconds"]), ""))
        for theirs in row["theirs"]:
            kind = "curved" if theirs["quadratic"] else "flat"
            lines.append(("", f"Evolver, {kind} triangles", count(theirs["triangles"]), small(abs(theirs["error"])),
                          seconds(theirs["seconds"]), "–", f"{theirs['seconds'] / ours['seconds']:.2f}×"))
            scripts.append(f"- {row['name']}, {kind}, from {count(theirs['size'])} triangles"
                           f" ({'heights of the linear model' if theirs['start'] == 'linear' else 'half of the volume'}):\n"
                           + "".join(f"  `{command}`\n" for command in theirs["commands"]))
        found = ["curved" if theirs["quadratic"] else "flat" for theirs in row["theirs"]]
        for kind in ("flat", "curved"):
            if kind not in found:
                lines.append(("", f"Evolver, {kind} triangles", "–", "–", "–", "–", f"> {row['slower'][kind]:.0f}×"))
    heights = "\n".join(
        f"- {row['name']}, {row['microlitres']:g} µL (`{row['options']}`): {1e3 * row['height']:.5f} mm, "
        + ("exact." if row["exact"] else f"of droplet-shape with {count(row['finest'])} triangles. "
           + (f"Evolver's with {count(row['check_triangles'])} curved triangles differs by {row['difference']:+.1e}."
              if row["difference"] is not None else "Evolver's check failed."))
        for row in rows)
    ratios = [min((theirs["seconds"] / row["ours"]["seconds"] for theirs in row["theirs"]), default=row["slower"]["curved"])
              for row in rows if row["ours"]]
    reached = len(ratios) == len(rows) and min(ratios) >= EVOLVER_TARGET
    return (f"{EVOLVER_TITLE}\n\n{EVOLVER_TEXT.format(commit=rows[0]['commit'])}\n" + heights + f"\n\nTarget: Evolver's fastest run takes at least "
            f"{EVOLVER_TARGET:.0f} times as long in every case. It takes {min(ratios):.2f} to {max(ratios):.2f} times as long: "
            f"{verdict(reached)}.\n\n"
            + table(["droplet", "", "triangles", "error", "processor time", "solve", "over droplet-shape"], lines, words=(0, 1))
            + "\nThe fastest scripts:\n\n" + "".join(scripts))


def rewrite_evolver(data, path):
    """Replaces the section about Surface Evolver in RESULTS.md, or appends it."""
    before, found, rest = path.read_text().partition(EVOLVER_TITLE + "\n")
    _, more, after = rest.partition("\n## ")
    section = evolver(data)
    path.write_text((before if found else before.rstrip("\n") + "\n\n") + section + (more + after if more else ""))


def profile(data):
    """Shares of the stages at a million triangles, before optimisation and now; None if that was not measured."""
    now = data["whole"].get("1M")
    if not now:
        return None
    rows = []
    for stage in [*STAGES, "total"]:
        before, after = BEFORE[stage], now["stages"][stage]
        rows.append((stage, seconds(before), f"{100 * before / BEFORE['total']:.0f} %", seconds(after),
                     f"{100 * after / now['stages']['total']:.0f} %", f"{before / after:.1f}×"))
    return table(["stage", "before", "", "now", "", "faster"], rows)


# ---------------------------------------------------------------------------------------------------------- the files

EVOLVER_TARGET = 10.0
EVOLVER_TITLE = "## Against Surface Evolver"
EVOLVER_TEXT = """\
Processor time, user and system, of a whole run on one thread whose height is within 1e-3 of the limit: medians of 5 runs, in
turns; commit {commit}. droplet-shape reads a PNG, traces, meshes, solves and writes a GLB; it has the fewest `--triangles` (125, 250, 500 and so
on) that are within the limit, and are so with twice as many, too. All its other options are the defaults.

Surface Evolver 2.70 gets what helps it. It reads a mesh of droplet-shape of any of these sizes, either with the heights of the
linear model or with half of the volume; that mesh costs it nothing, however fine it is. The table has the fastest of 48
scripts: Newton's method on that mesh, triangles divided 0 to 3 times with edges flipped and vertices averaged or not, then one
Newton step or two, with flat triangles or with curved ones of six points (`M 2`), an element that droplet-shape does not have.
Dividing keeps the polygon of the first rim; fixing new vertices on the true rim gained nothing. A result counts if another
division (`r`) keeps it within the limit. The search is not timed.

Heights:
"""


TEXT = """\
<!-- SPDX-License-Identifier: GPL-3.0-or-later -->
<!-- Written by scripts/bench, which overwrites changes. -->
# Speed, memory and accuracy

[README.md](README.md) describes the measurements. Times are medians; ± is half the range of all runs.

{machine}
## Targets

{targets}
## Whole processes against FreeFem++

Both programs mesh the same outline, of "&" on a 2048 px mask, with the same number of triangles within 3 %.
droplet-shape reads the mask, traces, triangulates, solves, and writes a closed GLB; FreeFem++ reads the outline,
triangulates and solves. Errors are those of volume and height at unit pressure, against {reference} triangles. Both programs agree within {difference}.

{freefem}
![Seconds against triangles, and error against seconds](growth.svg)

## Whole processes by size

{whole}
{small}
## Solvers

Time and memory of droplet-shape's solvers include assembly; those of Eigen's factorisation do not. Residuals are
‖Au − m‖/‖m‖ with A assembled by the benchmark. Errors on the disc are against the exact solution (heights: largest error
at a vertex, relative to the middle); errors of the letter's volume are against {reference} triangles.

{solvers}
## Other stages and programs

{other}
{pixels}
## Threads and instructions

{threads}
## The wind tunnel

Errors of sweeps are the largest deviations from closed forms in long double, for hemispheres with n = ½; thresholds are
roots, computed for every case. Errors of traces are deviations from the closed form of a droplet that climbs through 100
gusts.

{tunnel}

## The windshield

Steps with moving droplets; the last table is the beginning of an hour at 25 mm/h. The balance error is the water that is
missing, relative to all rain.

{windshield}

## The driver's view

Frames of 1280 × 720 pixels with 1000 large droplets and 200 000 small ones, without encoding.

{view}

## Droplets on meshes

Droplets that run down a slope from edge to edge; frames of 1/24 s with droplets that merge, 5000 per square metre, on 100 000
triangles. Motion includes merging and streaks; shapes are the meshes of all droplets.

{flow}

## Liquids in the plane

Steps of a breaking dam, with the outlines of a frame; frames of 1/24 s of the scenes, with outlines in their own style. Errors: mean
compression that steps leave; area of the outlines over that of the particles.

{liquid2d}

## Sheets

Time of the whole path of a cap from dry ground to 140°, per 10 000 triangles too, and errors against the spherical cap.

{sheet}

{evolver}"""

PROFILE_BEGINS = "<!-- begin: written by scripts/bench -->\n"
PROFILE_ENDS = "<!-- end: written by scripts/bench -->\n"

GRADING = """\
## Grading

Number of triangles for the same error of the volume, which is the squared error of the heights in the energy norm.

{grading}
"""


def write(data, folder):
    results = Results(data)
    text = TEXT.format(machine=machine(data), targets=targets(results), reference=count(data["reference"]["triangles"]),
                       freefem=freefem(results), whole=whole(results), small=small_runs(data), solvers=solvers(results),
                       difference=small(max(both["difference"] for both in data["freefem"].values())),
                       other=other_stages(results), pixels=pixel_growth(results),
                       threads=threads_and_instructions(results), tunnel=data["tunnel"],
                       windshield=data["windshield"], view=data["view"], flow=data["flow"],
                       liquid2d=data["liquid2d"], sheet=data["sheet"], evolver=evolver(data["evolver"]))
    if table_of_grading := grading(results):
        text += "\n" + GRADING.format(grading=table_of_grading)
    (folder / "RESULTS.md").write_text(text)
    (folder / "growth.svg").write_text(picture.growth(results))
    readme = folder / "README.md"
    if readme.exists() and (table_of_stages := profile(data)):
        before, _, rest = readme.read_text().partition(PROFILE_BEGINS)
        _, _, after = rest.partition(PROFILE_ENDS)
        readme.write_text(before + PROFILE_BEGINS + table_of_stages + PROFILE_ENDS + after)

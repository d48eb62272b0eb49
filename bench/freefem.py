# SPDX-License-Identifier: GPL-3.0-or-later
"""The same droplet in FreeFem++: buildmesh, P1, its sparse direct solver (F. Hecht, "New development in FreeFem++",
2012).

Lengths are in millimetres, near 1 as its mesher expects. In the plane, sigma K does not depend on the unit of length;
the mass matrix and the load are proportional to its square. Only the heights, in metres per pascal, are computed: no
surface is lofted and no file is written, which favours FreeFem++.
"""

import dataclasses
import math

import process

SQUARE_MM = 1e-6  # [m²]

SCRIPT = """\
{arrays}
{borders}
real t0 = clock();
mesh Th = buildmesh({boundary});
real t1 = clock();
fespace Vh(Th, P1);
Vh u, v;
varf a(u, v) = int2d(Th)({tension} * (dx(u) * dx(v) + dy(u) * dy(v)) + {weight} * u * v) + on(1, u = 0);
varf l(u, v) = int2d(Th)({load} * v) + on(1, u = 0);
matrix A = a(Vh, Vh, solver = sparsesolver);
real[int] b = l(0, Vh);
real t2 = clock();
u[] = A^-1 * b;
real t3 = clock();
cout.precision(17);
cout << "DROPLET " << Th.nt << " " << u[].max << " " << int2d(Th)({load} * u) << " "
     << t1 - t0 << " " << t2 - t1 << " " << t3 - t2 << endl;
"""

MESH_ONLY = """\
{arrays}
{borders}
mesh Th = buildmesh({boundary});
cout << "DROPLET " << Th.nt << endl;
"""

@dataclasses.dataclass
class Solution:
    triangles: int
    unit_height: float  # [m/Pa]
    unit_volume: float  # [m³/Pa]
    mesh: float         # [s]
    assemble: float
    solve: float


def script(template, loops, folder, physics):
    """Text of a program for a polygon. It reads the points from files, so that it stays short."""
    arrays, borders = [], []
    for k, points in enumerate(loops):
        path = folder / f"loop_{k}"
        path.write_text("\n".join(f"{x!r} {y!r}" for x, y in points) + "\n")
        n = len(points)
        arrays.append(f"real[int] x{k}({n}), y{k}({n});\n"
                      f"{{ ifstream file(\"{path}\"); for (int i = 0; i < {n}; i++) file >> x{k}[i] >> y{k}[i]; }}")
        borders.append(f"border b{k}(t = 0, {n}) "
                       f"{{ int i = int(t + 0.5) % {n}; x = x{k}[i]; y = y{k}[i]; label = 1; }}")
    return template.format(arrays="\n".join(arrays), borders="\n".join(borders),
                           boundary=" + ".join(f"b{k}({len(points)})" for k, points in enumerate(loops)),
                           tension=repr(physics["tension"]), weight=repr(physics["weight"] * SQUARE_MM),
                           load=repr(SQUARE_MM))


def answer(run):
    line = next(line for line in run.output.splitlines() if line.startswith("DROPLET"))
    return line.split()[1:]


def start(text, folder, threads):
    path = folder / "droplet.edp"
    path.write_text(text)
    return process.run(["FreeFem++", "-nw", "-v", "0", path], {"OPENBLAS_NUM_THREADS": str(threads)})


def count(loops, folder, physics):
    """Number of triangles that buildmesh makes of a polygon."""
    return int(answer(start(script(MESH_ONLY, loops, folder, physics), folder, 1))[0])


def solve(loops, folder, physics, threads):
    """Run of the whole process, and its solution."""
    run = start(script(SCRIPT, loops, folder, physics), folder, threads)
    numbers = answer(run)
    return run, Solution(int(numbers[0]), *map(float, numbers[1:]))


def fitted(loops_at, area, wanted, folder, physics):
    """Loops whose mesh has the wanted number of triangles within 3 %; loops_at(spacing) returns those of a spacing
    [mm]. The number is proportional to 1/spacing², with irregular deviations of 2 %."""
    coarse = min(wanted, 50_000)
    spacing = math.sqrt(area / SQUARE_MM / coarse * 4.0 / math.sqrt(3.0))
    for _ in range(2):
        spacing *= math.sqrt(count(loops_at(spacing), folder, physics) / coarse)
    spacing *= math.sqrt(coarse / wanted)
    for _ in range(5):
        loops = loops_at(spacing)
        found = count(loops, folder, physics)
        if abs(found / wanted - 1.0) < 0.03:
            return loops
        spacing *= math.sqrt(found / wanted)
    raise RuntimeError(f"buildmesh: {found} triangles, not {wanted}")

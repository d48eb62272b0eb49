# SPDX-License-Identifier: GPL-3.0-or-later
"""Log-log charts as SVG; lines and texts need no library."""

import html
import math

WIDTH, HEIGHT = 1240, 1020
COLOURS = ["#1f5fa8", "#c23b22", "#2e8b57", "#8a5fb0", "#d08a1d", "#4f9fb8", "#777777"]


class Chart:
    """Chart with logarithmic axes, as a part of the picture."""

    def __init__(self, column, row, title, x_label, y_label, curves):
        self.left, self.top, self.width, self.height = 70 + 600 * column, 50 + 500 * row, 330, 380
        points = [point for _, curve, _ in curves for point in curve]
        self.x_range, self.y_range = span([x for x, _ in points]), span([y for _, y in points])
        self.parts = [f'<text x="{self.left}" y="{self.top - 22}" class="title">{html.escape(title)}</text>']
        self.frame(x_label, y_label)
        for index, (name, curve, dashed) in enumerate(curves):
            self.line(index, name, curve, dashed)

    def x(self, value):
        low, high = map(math.log10, self.x_range)
        return self.left + self.width * (math.log10(value) - low) / (high - low)

    def y(self, value):
        low, high = map(math.log10, self.y_range)
        return self.top + self.height * (1.0 - (math.log10(value) - low) / (high - low))

    def frame(self, x_label, y_label):
        right, bottom = self.left + self.width, self.top + self.height
        for value in decades(self.x_range):
            x = self.x(value)
            self.parts.append(f'<line x1="{x:.1f}" y1="{self.top}" x2="{x:.1f}" y2="{bottom}" class="grid"/>'
                              f'<text x="{x:.1f}" y="{bottom + 18}" text-anchor="middle">{power(value)}</text>')
        for value in decades(self.y_range):
            y = self.y(value)
            self.parts.append(f'<line x1="{self.left}" y1="{y:.1f}" x2="{right}" y2="{y:.1f}" class="grid"/>'
                              f'<text x="{self.left - 8}" y="{y + 4:.1f}" text-anchor="end">{power(value)}</text>')
        middle = self.top + self.height / 2
        self.parts.append(
            f'<rect x="{self.left}" y="{self.top}" width="{self.width}" height="{self.height}" class="frame"/>'
            f'<text x="{self.left + self.width / 2}" y="{bottom + 40}" text-anchor="middle">'
            f'{html.escape(x_label)}</text>'
            f'<text transform="translate({self.left - 46} {middle}) rotate(-90)" text-anchor="middle">'
            f'{html.escape(y_label)}</text>')

    def line(self, index, name, points, dashed):
        colour = COLOURS[index]
        places = [(self.x(x), self.y(y)) for x, y in sorted(points)]
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
        style = f'stroke="{colour}"' + (' stroke-dasharray="6 4"' if dashed else "")
        self.parts.append(f'<polyline points="{path}" class="line" {style}/>')
        self.parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{colour}"/>' for x, y in places]
        y = self.top + 10 + 20 * index
        x = self.left + self.width + 12
        self.parts.append(f'<line x1="{x}" y1="{y}" x2="{x + 22}" y2="{y}" class="line" {style}/>'
                           f'<text x="{x + 28}" y="{y + 4}">{html.escape(name)}</text>')

    def svg(self):
        return "\n".join(self.parts)


def decades(limits):
    low, high = (math.log10(value) for value in limits)
    return [10.0**k for k in range(math.ceil(low - 1e-9), math.floor(high + 1e-9) + 1)]


def power(value):
    exponent = round(math.log10(value))
    raised = f'10<tspan dy="-5" class="small">{str(exponent).replace("-", "−")}</tspan>'
    return {0: "1", 1: "10"}.get(exponent, raised)


def span(values):
    """Range of whole decades around numbers."""
    return 10.0 ** math.floor(math.log10(min(values))), 10.0 ** math.ceil(math.log10(max(values)))


def growth(results):
    """Four charts: time, memory and error against triangles, and error against time."""
    by_size = {**{size: both["ours"] for size, both in results.data["freefem"].items()}, **results.data["whole"]}
    ours = by_size.values()
    theirs = [both["theirs"] for both in results.data["freefem"].values()]

    def against_triangles(cases, key):
        return [(case["triangles"], case[key]) for case in cases]

    def solver(name, key, domain="letter"):
        return against_triangles(results.stages("Solve", name, domain), key)

    def cost(cases):
        errors = [(case["seconds"], results.volume_error(case)) for case in cases]
        return [point for point in errors if point[1]]

    time = [("droplet-shape, whole process", against_triangles(ours, "seconds"), False),
            ("FreeFem++, whole process", against_triangles(theirs, "seconds"), False),
            ("triangulate", against_triangles(results.stages("Triangulate", "letter"), "seconds"), False),
            ("CGAL Delaunay_mesher_2", against_triangles(results.stages("Triangulate", "Delaunay_mesher_2"), "seconds"),
             True),
            ("multigrid-pcg", solver("multigrid-pcg", "seconds"), False),
            ("simplicial-llt", solver("simplicial-llt", "seconds"), True)]
    memory = [("droplet-shape, whole process", against_triangles(ours, "peak_bytes"), False),
              ("FreeFem++, whole process", against_triangles(theirs, "peak_bytes"), False),
              ("multigrid-pcg", solver("multigrid-pcg", "peak_bytes"), False),
              ("simplicial-llt", solver("simplicial-llt", "peak_bytes"), True)]
    error = [("droplet-shape, volume", solver("multigrid-pcg", "volume_error", "disc"), False),
             ("FreeFem++, volume", against_triangles(results.data["freefem_disc"].values(), "volume_error"), False),
             ("droplet-shape, height", solver("multigrid-pcg", "middle_error", "disc"), True),
             ("FreeFem++, height", against_triangles(results.data["freefem_disc"].values(), "height_error"), True)]
    exactness = [("droplet-shape", cost(ours), False), ("FreeFem++", cost(theirs), False)]
    body = "\n".join(chart.svg() for chart in (
        Chart(0, 0, "Time", "triangles", "seconds", time),
        Chart(1, 0, "Peak memory", "triangles", "bytes", memory),
        Chart(0, 1, "Error on the disc, against the exact solution", "triangles", "relative error", error),
        Chart(1, 1, "Error against time", "seconds, whole process", "error of the letter's volume", exactness)))
    return f"""\
<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="13">
<!-- SPDX-License-Identifier: GPL-3.0-or-later -->
<style>
.title {{ font-size: 16px; font-weight: bold }} .small {{ font-size: 10px }}
.grid {{ stroke: #dddddd }} .frame {{ fill: none; stroke: #888888 }} .line {{ fill: none; stroke-width: 2 }}
</style>
<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>
{body}
</svg>
"""

#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# %% [markdown]
# # Droplets from an array
#
# This script is a notebook: editors that know `# %%` show its cells. It draws four figures into the folder that is its
# argument, or into the current folder.

# %%
import sys
from pathlib import Path

import matplotlib
import numpy as np

import droplet_shape as ds

if "ipykernel" not in sys.modules:
    matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.tri import Triangulation

folder = Path(sys.argv[1] if len(sys.argv) > 1 and "ipykernel" not in sys.modules else ".")

# %% [markdown]
# ## A mask
#
# Any array of two dimensions is a mask: here, a flower with a dry spot in its middle.

# %%
y, x = np.mgrid[1:-1:400j, -1:1:400j]
radius, angle = np.hypot(x, y), np.arctan2(y, x)
flower = (radius < 0.7 + 0.2 * np.cos(5 * angle)) & (radius > 0.2)

# %% [markdown]
# ## A droplet
#
# `vertices` and `triangles` share the memory of the mesh. Matplotlib draws them as they are.

# %%
drop = ds.make_droplet(flower, width="20mm", contact_angle="30deg", triangles=8000)
shape = drop.report.shape
print(f"{shape.volume_ul:.1f} µL, {1e3 * shape.height_max_m:.2f} mm high, {shape.pressure_pa:.1f} Pa")

millimetres = 1e3 * drop.vertices
figure = plt.figure(figsize=(7, 4))
axes = figure.add_axes((0, 0, 1, 1), projection="3d")
axes.plot_trisurf(*millimetres.T[:2], millimetres.T[2], triangles=drop.triangles, color="#7fb2e5", linewidth=0)
axes.set(xlabel="x [mm]", ylabel="y [mm]", zlabel="z [mm]", zticks=[0, 0.5])
axes.set_box_aspect(np.ptp(millimetres, axis=0) + [0, 0, 2], zoom=1.3)
figure.savefig(folder / "droplet.png")

# %% [markdown]
# ## Heights and contact angles

# %%
is_liquid = drop.normals[drop.triangles, 2].mean(axis=1) > 0  # the others are the base
mesh = Triangulation(*millimetres.T[:2], triangles=drop.triangles[is_liquid])
rim = drop.contact_angle > 0
figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), sharex=True, sharey=True, layout="constrained")
figure.colorbar(left.tricontourf(mesh, millimetres[:, 2], levels=12), ax=left, label="height [mm]")
points = right.scatter(*millimetres[rim].T[:2], c=np.degrees(drop.contact_angle[rim]), s=6)
figure.colorbar(points, ax=right, label="contact angle [°]")
for axes in (left, right):
    axes.set(aspect="equal", xlabel="x [mm]", xlim=(-9.8, 9.8), ylim=(-9.8, 9.8))
left.set_ylabel("y [mm]")
figure.savefig(folder / "heights.png")

# %% [markdown]
# ## A series
#
# How pressure changes with the amount of liquid, for a disc: it has a maximum.

# %%
disc = radius < 0.8
angles = np.radians(np.arange(5, 90, 10))
runs = [ds.make_droplet(disc, width="5mm", contact_angle=angle, model="exact", triangles=2000) for angle in angles]
figure, axes = plt.subplots(figsize=(6, 4))
axes.plot([run.report.shape.volume_ul for run in runs], [run.report.shape.pressure_pa for run in runs], "o-")
axes.set(xlabel="volume [µL]", ylabel="pressure [Pa]")
figure.savefig(folder / "series.png")

# %% [markdown]
# ## The wind tunnel
#
# Acceleration from rest of droplets on a slope, against the wind.

# %%
tunnel = ds.wind_tunnel(volume=["10uL", "30uL", "100uL"], wind_speed="0..16m/s:0.25").runs[0]
figure, axes = plt.subplots(figsize=(6, 4))
for case in tunnel.cases:
    axes.plot(tunnel.wind_m_per_s, case.acceleration_m_per_s2, label=f"{1e9 * case.volume_m3:.0f} µL")
axes.set(xlabel="wind [m/s]", ylabel="acceleration up the slope [m/s²]")
axes.legend()
figure.savefig(folder / "tunnel.png")

#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a droplet by meshio, with the contact angle of its rim, in formats of other programs: VTU and Gmsh."""
import meshio
import numpy as np

import droplet_shape as ds

y, x = np.mgrid[1:-1:300j, -1:1:300j]
drop = ds.make_droplet(x**2 + y**2 < 0.8, width="10mm", triangles=5000)
mesh = meshio.Mesh(
    drop.vertices,
    [("triangle", drop.triangles)],
    point_data={"normal": drop.normals, "contact_angle_rad": drop.contact_angle},
)
mesh.write("drop.vtu")
mesh.write("drop.msh", file_format="gmsh")

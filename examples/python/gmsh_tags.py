"""Heat through a wall of two layers, -div κ∇u = 0: a Gmsh file whose physical groups are materials and boundary conditions.

The inside is kept at 20 degrees (Dirichlet), a given power enters from outside (Neumann), top and bottom are insulated.
The exact solution is linear in each layer, so linear elements have it.
"""

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import scipy.sparse.linalg as linalg

import derham

file = """\
$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
4
1 1 "inside"
1 2 "outside"
2 3 "brick"
2 4 "wool"
$EndPhysicalNames
$Nodes
8
1 0 0 0
2 1 0 0
3 2 0 0
4 2 1 0
5 1 1 0
6 0 1 0
7 0.4 0.6 0
8 1.7 0.4 0
$EndNodes
$Elements
10
1 1 2 1 1 6 1
2 1 2 2 1 3 4
3 2 2 3 1 1 2 7
4 2 2 3 1 2 5 7
5 2 2 3 1 5 6 7
6 2 2 3 1 6 1 7
7 2 2 4 1 2 3 8
8 2 2 4 1 3 4 8
9 2 2 4 1 4 5 8
10 2 2 4 1 5 2 8
$EndElements
"""
with TemporaryDirectory() as folder:
    path = Path(folder, "wall.msh")
    path.write_text(file)
    K = derham.read(path, planar=True).refined().fine.refined().fine  # the groups come along
print(K, *K.parts, sep="\n")

kappa, power, temperature = {"brick": 0.6, "wool": 0.04}, 0.8, 20.0
conductivity = sum(kappa[name] * K.tagged_chain(name) for name in kappa)  # of every triangle
A = K.d(0).T @ K.star(1, "whitney", material=conductivity) @ K.d(0)

B = K.boundary_complex()[0]
outside = K.boundary_material([(K.tagged_facets("outside"), 1)])  # 1 there, 0 elsewhere
load = K.boundary_load(np.full(B.size(0), power), 0, B.star(0, "whitney", material=outside))

space = K.form_space(K.tagged_facets("inside"))
u = np.zeros(K.size(0))
u[space.prescribed(0)] = temperature
E = space.extension(0)
u += E @ linalg.spsolve((E.T @ A @ E).tocsc(), E.T @ (load - A @ u))

x = K.points[:, 0]
exact = temperature + power * (np.minimum(x, 1) / kappa["brick"] + np.maximum(x - 1, 0) / kappa["wool"])
print(f"outside temperature {u.max():.6f}, expected {exact.max():.6f}; error {abs(u - exact).max():.0e}")
flow = -conductivity[:, np.newaxis] * K.sharp(K.d(0) @ u)
print("heat flows with", flow.mean(axis=0).round(9), "everywhere; what leaves:", -(A @ u)[space.prescribed(0)].sum().round(9))
assert np.allclose(u, exact, rtol=1e-12) and np.allclose(flow, [-power, 0], atol=1e-9)
assert np.isclose((A @ u)[space.prescribed(0)].sum(), -power)

"""The first ten lines: a mesh, its operators, a law."""

import derham

K = derham.generate.ball(3, 4)  # or derham.read("mesh.msh"), or derham.Complex(tetrahedra, points)
print(K)

x = K.points
w = K.integrate(lambda p: p[:, [1, 2, 0]], 1)  # the vector field (y, z, x) as its integrals along the edges
flux = K.apply_d(w, 1)  # of its curl, (-1, -1, -1), through the triangles
print("d d w          ", abs(K.apply_d(flux, 2)).max().round(12))
print("Stokes, error  ", abs(flux - K.integrate([-1, -1, -1], 2, flux=True)).max().round(12))
print("volume         ", round(K.volumes(3).sum(), 4))
print("manifold       ", K.check().verdict)

verdict = K.star_verdict(1)
print("star of edges  ", verdict.definiteness, "with", len(verdict.negative), "negative entries:", verdict.advice)

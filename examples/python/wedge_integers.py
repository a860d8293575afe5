"""Integers from wedge products: the volume of the 3-torus by three 1-forms, the intersection form of S² × S²."""

import numpy as np

import derham

# dx, dy, dz on the flat torus are closed, not exact: their integrals along the three loops are 1
T = derham.generate.periodic_box(3, 3, jitter=0.2)
dx, dy, dz = (T.integrate(e, 1) for e in np.eye(3))
assert all(abs(T.apply_d(w, 1)).max() < 1e-15 for w in (dx, dy, dz))
volume = T.wedge(T.wedge(dx, 1, dy, 1), 2, dz, 1).sum()
print(f"T³       ∫ dx ∧ dy ∧ dz = {volume:.12f}")
assert abs(volume - 1) < 1e-12

# on S² × S² the areas of the two factors, pulled back
S = derham.generate.sphere(2)
M = derham.generate.product(S, S)
area = np.zeros(S.size(2))
area[0] = 1  # a 2-form of integral 1


def pulled_back(vertex_images: np.ndarray) -> np.ndarray:
    """area of the image of every triangle; 0 where it is collapsed."""
    index, sign = S.find(vertex_images[M.simplices(2)])
    return np.where(sign == 0, 0.0, sign * S.signs[index] * area[index])


vertices = np.arange(M.size(0))
forms = [pulled_back(vertices // S.size(0)), pulled_back(vertices % S.size(0))]
assert not any(M.apply_d(a, 2).any() for a in forms)
Q = np.array([[M.wedge(a, 2, b, 2).sum() for b in forms] for a in forms])
signature = (int((np.linalg.eigvalsh(Q) > 0).sum()), int((np.linalg.eigvalsh(Q) < 0).sum()))
print(f"S² × S²  intersection form {np.round(Q, 12).tolist()}, signature {signature}")
assert signature == (1, 1) and np.allclose(abs(Q), [[0, 1], [1, 0]], atol=1e-12)

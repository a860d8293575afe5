"""Maxwell's equations in a periodic box by leapfrog: dE/dt = ⋆⁻¹ dᵀ ⋆ B, dB/dt = -d E, the speed of light 1.

E is a 1-form at times n Δt, B a 2-form half a step later. On the tetrahedra of the body-centred cubic lattice all dual
volumes are positive: ⋆⁻¹ is diagonal. (Bossavit & Kettunen, "Yee-like schemes on a tetrahedral mesh", 1999.)
"""

import numpy as np
import scipy.sparse.linalg as linalg

import derham

length = 3.0
random = np.random.default_rng(1)


class Box:
    """The cubic torus of some cells³; curl_curl E = λ ⋆ E has the squares λ of the frequencies."""

    def __init__(self, cells: int) -> None:
        self.K = K = derham.generate.bcc_lattice(cells, length / cells)
        assert all(K.star_verdict(k) for k in range(4))
        self.star1, self.star2, self.star1_inverse = K.star(1), K.star(2), K.star_inverse(1)
        self.curl_curl = (K.d(1).T @ self.star2 @ K.d(1)).tocsc()

    def step(self, E: np.ndarray, B: np.ndarray, dt: float) -> tuple[np.ndarray, np.ndarray]:
        E = E + dt * (self.star1_inverse @ (self.K.d(1).T @ (self.star2 @ B)))
        return E, B - dt * (self.K.d(1) @ E)


box = Box(3)
K, star1, star2 = box.K, box.star1, box.star2
fastest = linalg.eigsh(box.curl_curl, k=1, M=star1.tocsc(), Minv=box.star1_inverse, return_eigenvectors=False)[0]
limit = 2 / np.sqrt(fastest)
print(f"{K}\nlargest eigenvalue {fastest:.7f}: stable for steps below {limit:.7f}")

E, B = random.standard_normal(K.size(1)), K.d(1) @ random.standard_normal(K.size(1))
charge, energies = K.d(0).T @ (star1 @ E), []
for _ in range(1000):
    E, later = box.step(E, B, 0.99 * limit)
    energies.append((E @ star1 @ E + later @ star2 @ B) / 2)
    B = later
drifts = np.ptp(energies) / energies[0], abs(K.d(0).T @ (star1 @ E) - charge).max(), abs(K.d(2) @ B).max()
print("below it, after 1000 steps: drift of energy {:.0e}, of charge {:.0e}; magnetic charge {:.0e}".format(*drifts))
assert max(drifts) < 1e-11

E, B, norms = random.standard_normal(K.size(1)), np.zeros(K.size(2)), []
for _ in range(200):
    E, B = box.step(E, B, 1.01 * limit)
    norms.append(np.linalg.norm(E))
growth, expected = np.log(norms[-1] / norms[-2]), 2 * np.arccosh(1.01)  # z² - (2 - Δt² λ) z + 1 = 0
print(f"above it: growth exp({growth:.4f}) per step, expected exp({expected:.4f})")
assert abs(growth - expected) < 1e-6

errors = []
for cells in (3, 6):  # the longest waves: 6 directions, 2 polarisations, |k| = 2π / length
    box, k, dt = Box(cells), 2 * np.pi / length, 0.1 / cells
    values, modes = linalg.eigsh(box.curl_curl, k=12, M=box.star1.tocsc(), sigma=k**2)
    assert np.ptp(values) < 1e-9
    E = start = modes[:, 0]
    B = -dt / 2 * (box.K.d(1) @ E)  # B = 0 at time 0
    for _ in range(100):
        E, B = box.step(E, B, dt)
    frequency = 2 / dt * np.arcsin(dt / 2 * np.sqrt(values[0]))
    assert np.allclose(E, np.cos(frequency * 100 * dt) * start, atol=1e-10)
    errors.append(1 - frequency / k)
print("error of the frequency of the longest waves", np.round(errors, 5), "order", np.log2(errors[0] / errors[1]).round(2))
assert abs(np.log2(errors[0] / errors[1]) - 2) < 0.1

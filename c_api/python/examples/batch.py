"""A thousand designs at once: the functions as a dense array, in a product on any device.

With PyTorch, ``torch.as_tensor(morph.matrix(), device="cuda")`` and the same products have gradients.
"""
import harmorph
import numpy as np

ni, nj = 65, 17
angle = 2 * np.pi * (np.arange(ni) % (ni - 1)) / (ni - 1)
r = np.exp(2 * np.arange(nj) / (nj - 1))[:, None]
points = np.stack([(r + 0.4 / r) * np.cos(angle), (r - 0.4 / r) * np.sin(angle)], axis=-1)
mesh = harmorph.Mesh.structured(points, j_min="wall", j_max="far")
morph = harmorph.Morph(mesh, harmorph.Curves.fit(mesh, "wall", n_control=12, closed="periodic"))

f, g = morph.matrix()  # f + i g: 2 planes of shape (points, functions)
moves = 0.05 * np.random.default_rng(1).standard_normal((12, 2, 1000))
dx = f @ moves[:, 0] - g @ moves[:, 1]  # (points, 1000)
dy = g @ moves[:, 0] + f @ moves[:, 1]

one = morph.displacement(moves[:, :, 500])
error = np.abs(one - np.stack([dx[:, 500], dy[:, 500]], axis=1)).max() / np.abs(one).max()
print(f"{dx.shape[1]} designs of {dx.shape[0]} points; "
      f"the difference from morph is {error:.1e} of the largest movement")

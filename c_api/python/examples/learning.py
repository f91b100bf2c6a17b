"""PyTorch: an optimiser of torch finds control points from mesh points, through the mesh.

The gradient from mesh points to control points is confirmed by torch.autograd.gradcheck, for a batch.
"""
import harmorph
import harmorph.torch
import numpy as np
import torch

ni, nj = 33, 9
angle = 2 * np.pi * (np.arange(ni) % (ni - 1)) / (ni - 1)
r = np.exp(2 * np.arange(nj) / (nj - 1))[:, None]
points = np.stack([(r + 0.4 / r) * np.cos(angle), (r - 0.4 / r) * np.sin(angle)], axis=-1)
mesh = harmorph.Mesh.structured(points, j_min="wall", j_max="far")
morph = harmorph.Morph(mesh, harmorph.Curves.fit(mesh, "wall", n_control=8, closed="periodic"))

batch = torch.randn(2, 8, 2, dtype=torch.float64, generator=torch.Generator().manual_seed(1)).requires_grad_()
assert torch.autograd.gradcheck(lambda one: harmorph.torch.displacement(morph, one), batch)
print("gradcheck passed for a batch of 2")

wanted = 0.1 * torch.sin(torch.arange(16, dtype=torch.float64)).reshape(8, 2)
target = harmorph.torch.morph_points(morph, wanted)
move = torch.zeros(8, 2, dtype=torch.float64, requires_grad=True)
optimiser = torch.optim.LBFGS([move], lr=1, max_iter=100, tolerance_grad=1e-14, tolerance_change=1e-16,
                              line_search_fn="strong_wolfe")


def misfit():
    optimiser.zero_grad()
    value = ((harmorph.torch.morph_points(morph, move) - target) ** 2).sum()
    value.backward()
    return value


first = misfit().item()
optimiser.step(misfit)
print(f"misfit {first:.2e} -> {misfit().item():.2e}; control points differ by {(move - wanted).abs().max().item():.1e}")

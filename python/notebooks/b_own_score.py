# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # Can a score of one's own be trusted?
# Fig. 5 of Loeper et al. draws the error of sampled poses against their score: a score that reflects
# the pose has its least errors where it is best. Here a score of our own, in Python, beside the
# paper's `line_energy` and ours, with its energy map.

# %%
from common import save, town

# %%
import matplotlib.pyplot as plt
import numpy as np

import ridgeline

# %% [markdown]
# The score: how near the middles of the model's visible edges lie to picture lines of about the same
# direction. It is called with the poses of one place at once.


# %%
def prepare(picture):
    """Middles and directions of the picture's lines."""
    lines = picture.lines.astype(np.float64)
    along = lines[:, 2:4] - lines[:, :2]
    return 0.5 * (lines[:, :2] + lines[:, 2:4]), np.arctan2(along[:, 1], along[:, 0]), along


def nearness(batch):
    """Sum over the model's edges of exp(-distance / 4 px) to the nearest line of its direction."""
    middles, angles, along = batch.prepared
    segments, pose, _ = batch.segments()
    model = segments.astype(np.float64)
    center = 0.5 * (model[:, :2] + model[:, 2:])
    direction = np.arctan2(model[:, 3] - model[:, 1], model[:, 2] - model[:, 0])
    turn = np.abs((direction[:, None] - angles[None] + np.pi / 2) % np.pi - np.pi / 2)
    offset = center[:, None] - middles[None]
    length = np.linalg.norm(along, axis=1)
    unit = along / length[:, None]
    beside = np.abs(offset[..., 0] * unit[:, 1] - offset[..., 1] * unit[:, 0])
    beyond = np.maximum(np.abs((offset * unit).sum(-1)) - 0.5 * length, 0.0)
    distance = np.where(turn < np.radians(5.0), np.hypot(beside, beyond), np.inf)
    seen = np.exp(-distance.min(1, initial=np.inf) / 4.0)
    total = np.bincount(pose, weights=seen - 0.3, minlength=len(batch))
    return np.where(np.bincount(pose, minlength=len(batch)) > 0, total, -np.inf)


ridgeline.register_score(nearness, prepare=prepare)

# %% [markdown]
# The study draws priors around the truths, maps the energy of every pose of the box, and lets a TPE
# sampler search it, as the paper did.

# %%
SCORES = ["evidence", "line_energy", "nearness"]
study = ridgeline.study(
    town(), SCORES, queries=["street_000", "street_003"], perturb="6,6,0,10", classes=[50, 100]
)
for item in (study[i] for i in range(len(study))):
    figures = item["figures"]
    print(
        f"{item['query']} {item['score']:12} minimum {figures['minimum_m']:5.2f} m "
        f"{figures['minimum_deg']:5.2f} deg, better than the truth {figures['better_share']:.3%}"
    )

# %%
figure, axes = plt.subplots(2, len(SCORES), figsize=(11, 6.5))
for column, name in enumerate(SCORES):
    of_score = [item for item in (study[i] for i in range(len(study))) if item["score"] == name]
    above, below = axes[:, column]
    for item in of_score:
        above.scatter(item["sampled"]["energy"], item["sampled"]["error_m"], s=8, label=item["query"])
    above.set(title=name, xlabel="energy", ylabel="error [m]" if column == 0 else "")
    above.legend(fontsize=7)
    energy_map, truth = of_score[0]["map"], of_score[0]["truth"].center
    west, east, south, north = energy_map.extent
    below.imshow(
        energy_map.energies,
        origin="lower",
        extent=(west - truth[0], east - truth[0], south - truth[1], north - truth[1]),
    )
    below.plot(0, 0, "w+", markersize=12)
    below.set(xlabel="east of the truth [m]", ylabel="north [m]" if column == 0 else "")
figure.tight_layout()
save(figure, "own_score")

# %%
assert all(len(study[i]["sampled"]["energy"]) == 100 for i in range(len(study)))

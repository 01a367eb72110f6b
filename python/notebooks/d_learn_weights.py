# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # Weights for a city of one's own
# "evidence" is a log-linear model, P(pose) ~ exp(sum of w_k cue_k). The weights that come with
# ridgeline are those of the highest likelihood of known poses of other cities; here they are learned
# for one city, from a few pictures with known poses, and tried on others.

# %%
from common import save, town

# %%
import matplotlib.pyplot as plt
import numpy as np

import ridgeline

dataset = ridgeline.Dataset(town())
localizer = ridgeline.Localizer(ridgeline.World.of_dataset(town()))
defaults = ridgeline.Options()["score.weights"]
learn, test = dataset.queries[:4], dataset.queries[4:]
random = np.random.default_rng(1)


# %% [markdown]
# The cues of all poses of a box around a place near the truth, and which of them are right.


# %%
def box_of(query):
    """(cues (n, k), right (n,)) of a grid of poses whose middle is off by up to 3 m and 5 degrees."""
    truth = query.truth
    middle = truth.center + np.append(random.uniform(-3, 3, 2), 0.0)
    steps = np.arange(-6.0, 6.5, 1.5)
    headings = truth.heading_deg + random.uniform(-5, 5) + np.arange(-10.0, 10.5, 1.0)
    east, north, heading = np.meshgrid(steps, steps, headings, indexing="ij")
    centers = middle + np.stack([east, north, 0 * east], -1).reshape(-1, 3)
    angles = np.stack(
        [heading, np.full_like(heading, truth.pitch_deg), np.full_like(heading, truth.roll_deg)], -1
    ).reshape(-1, 3)
    poses = ridgeline.Poses.from_view_angles(centers, angles)
    errors = poses.errors(truth)
    picture = ridgeline.Picture(localizer, query.image, query.camera)
    score = picture.score(weights={name: 1.0 for name in defaults})  # a cue of weight 0 is left out
    return score.cue_names, score.cues(poses).astype(float), (errors[:, 0] <= 2) & (errors[:, 2] <= 2)


boxes = [box_of(query) for query in learn]
names = boxes[0][0]


# %% [markdown]
# Weights >= 0 of the highest log likelihood of the right poses, less a ridge towards the defaults:
# projected gradient ascent with steps that grow while they help.


# %%
def log_likelihood(weights, boxes):
    """Mean log probability of the right poses and its gradient."""
    total, gradient = 0.0, np.zeros(len(weights))
    for _, cues, right in boxes:
        energy = cues @ weights
        p = np.exp(energy - energy.max())
        of_right = np.where(right, p, 0.0)
        total += np.log(of_right.sum() / p.sum())
        gradient += (of_right / of_right.sum() - p / p.sum()) @ cues
    return total / len(boxes), gradient / len(boxes)


start = np.array([defaults[name] for name in names])
RIDGE = 0.01


def objective(weights):
    value, gradient = log_likelihood(weights, boxes)
    away = weights - start
    return value - RIDGE * away @ away, gradient - 2 * RIDGE * away


weights, step = start.copy(), 0.1
value, gradient = objective(weights)
for _ in range(300):
    trial = np.maximum(weights + step * gradient, 0.0)
    trial_value, trial_gradient = objective(trial)
    if trial_value > value:
        weights, value, gradient, step = trial, trial_value, trial_gradient, 1.2 * step
    else:
        step *= 0.5

# %%
test_boxes = [box_of(query) for query in test]
for what, of in (("learned on", boxes), ("others", test_boxes)):
    before, after = log_likelihood(start, of)[0], log_likelihood(weights, of)[0]
    print(f"{what:10} log likelihood of the right poses {before:.3f} before, {after:.3f} after")
print({name: round(float(w), 2) for name, w in zip(names, weights)})

# %%
figure, axis = plt.subplots(figsize=(7, 3))
places = np.arange(len(names))
axis.bar(places - 0.2, start, 0.4, label="default")
axis.bar(places + 0.2, weights, 0.4, label="learned for this town")
axis.set_xticks(places, names, rotation=30, ha="right")
axis.set_yscale("symlog", linthresh=0.1)
axis.set_ylabel("weight")
axis.legend()
save(figure, "learned_weights")

# %% [markdown]
# The weights as options; `options.json()` is a configuration file for the program.

# %%
options = ridgeline.Options({"score.weights": {n: float(w) for n, w in zip(names, weights)}})
query = test[0]
found = ridgeline.Localizer(localizer.world, options).localize(
    query.image, query.camera, query.prior
)
print(query.id, found.status, found.pose and found.pose.error(query.truth))
assert value >= objective(start)[0]

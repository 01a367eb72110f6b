# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # Which of two methods is better, and is it certain?
# Both localize the same pictures from the same priors. Shares come with Wilson's interval over the
# pictures (seeds of one picture are not independent), and the difference with a bootstrap over the
# pictures, paired: that is what tells two methods apart.

# %%
from common import save, town

# %%
import matplotlib.pyplot as plt
import numpy as np

import ridgeline

PERTURB = "8,8,0,15"
METHODS = {
    "evidence": {},
    "line_energy": {"score.name": "line_energy", "search.widenings": 0},
}
SEEDS = 2
results = {
    name: ridgeline.bench(town(), perturb=PERTURB, seeds=SEEDS, options=options)
    for name, options in METHODS.items()
}


# %% [markdown]
# A pose counts as right within 2 m and 2 degrees; the best pose of every run is judged, withheld or
# not, so that the two scores are compared and not their confidences.


# %%
def right(result):
    """(pictures, seeds) of 0 or 1."""
    a = result.arrays()
    hits = (a["candidate_error_m"] <= 2.0) & (a["candidate_error_deg"] <= 2.0)
    return hits.reshape(-1, SEEDS).astype(float)


shares = {name: right(result) for name, result in results.items()}
for name, hits in shares.items():
    low, high = ridgeline.wilson_interval(hits.mean() * len(hits), len(hits))
    print(f"{name:12} right {hits.mean():.0%}, 95 % interval {low:.0%} to {high:.0%}")

# %%
first, second = shares.values()
difference = (first - second).mean(1)  # by picture
random = np.random.default_rng(1)
draws = random.choice(difference, (10_000, len(difference))).mean(1)
low, high = np.percentile(draws, [2.5, 97.5])
print(f"difference {difference.mean():+.0%}, 95 % interval {low:+.0%} to {high:+.0%}")
print("certain" if low > 0 or high < 0 else "not certain: more pictures are needed")

# %%
figure, axes = plt.subplots(1, 2, figsize=(9, 3.2))
for name, result in results.items():
    errors = np.sort(np.nan_to_num(result.arrays()["candidate_error_m"], nan=np.inf))
    axes[0].step(errors, np.arange(1, len(errors) + 1) / len(errors), where="post", label=name)
axes[0].set(xlim=(0, 10), ylim=(0, 1.02), xlabel="error [m]", ylabel="share of runs")
axes[0].legend()
for row, (name, hits) in enumerate(shares.items()):
    low_share, high_share = ridgeline.wilson_interval(hits.mean() * len(hits), len(hits))
    axes[1].plot([low_share, high_share], [row, row], color=f"C{row}")
    axes[1].plot(hits.mean(), row, "o", color=f"C{row}")
axes[1].set(yticks=range(len(shares)), yticklabels=list(shares), xlim=(0, 1), ylim=(-0.5, 1.5))
axes[1].set_xlabel("within 2 m and 2 degrees, 95 % interval")
figure.tight_layout()
save(figure, "compare_methods")

# %%
assert len(difference) == 6

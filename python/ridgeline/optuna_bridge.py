# SPDX-License-Identifier: Apache-2.0
"""Optuna and ridgeline: an Optuna study drives our energy; our sampler is an Optuna sampler.

    import optuna
    from ridgeline.optuna_bridge import PoseObjective, RidgelineSampler

    objective = PoseObjective(score, space)
    study = optuna.create_study(sampler=RidgelineSampler("gp_de", seed=1))
    study.optimize(objective, n_trials=200)
    best = objective.pose_of(study.best_params)

Optuna is not needed to import this: its classes are only met through their interface (that of
Optuna 3 and 4: Trial.suggest_float, BaseSampler, FloatDistribution).
"""

import math

from ._ridgeline import Sampler

try:
    from optuna.samplers import BaseSampler as _BaseSampler
except ImportError:  # a class with the same methods serves where Optuna is not installed

    class _BaseSampler:
        """Stands for optuna.samplers.BaseSampler."""


class PoseObjective:
    """The energy of a pose as an Optuna objective, to be minimised: [0, 1], 0 best.

    Points where no camera can be are pruned, if Optuna is there, and inf otherwise.

    Args:
        score: ridgeline.Score.
        space: ridgeline.PoseSpace; its free offsets are the trial's parameters, under their names.
    """

    def __init__(self, score, space):
        self._score = score
        self._space = space

    def __call__(self, trial):
        params = {
            name: trial.suggest_float(name, lower, upper)
            for name, lower, upper, _ in self._space.box
            if lower < upper
        }
        pose = self.pose_of(params)
        if pose is None:
            return self._inadmissible()
        return float(self._score.energies(pose)[0])

    def pose_of(self, params):
        """Pose of a dict of offsets (fixed ones may be absent); None: no camera can be there."""
        return self._space.pose_at(
            [float(params.get(name, lower)) for name, lower, _, _ in self._space.box]
        )

    @staticmethod
    def _inadmissible():
        try:
            from optuna import TrialPruned
        except ImportError:
            return math.inf
        raise TrialPruned("no camera can be there")


class RidgelineSampler(_BaseSampler):
    """One of ridgeline's samplers as an Optuna sampler, for float parameters without log or step.

    Parameters that appear for the first time in a study's first trial make the box. Others, and
    what the sampler cannot propose yet (it waits for results that are outstanding), are drawn
    uniformly. Directions "minimize" and "maximize" both work.

    Args:
        name: one of ridgeline.samplers().
        seed: of its random numbers.
        options: keys of "search.sampler".
    """

    def __init__(self, name="gp_de", seed=1, options=None):
        self._name = name
        self._seed = seed
        self._options = dict(options or {})
        self._sampler = None
        self._box = []
        self._asked = {}  # by the number of Optuna's trial
        self._draws = 0

    def infer_relative_search_space(self, study, trial):
        """The float parameters of the first finished trial, by name."""
        if self._box:
            return {name: space for name, space in self._spaces}
        for done in study.get_trials(deepcopy=False):
            if not done.state.is_finished() or not done.distributions:
                continue
            spaces = sorted(done.distributions.items())
            self._spaces = [(n, s) for n, s in spaces if _is_plain(s)]
            self._box = [(n, float(s.low), float(s.high)) for n, s in self._spaces]
            if self._box:
                self._sampler = Sampler(
                    self._name, self._box, seed=self._seed, options=self._options
                )
                self._learn(study, done)
            return dict(self._spaces)
        return {}

    def sample_relative(self, study, trial, search_space):
        """The sampler's next point, as a dict; empty where it waits for results."""
        if self._sampler is None or not search_space:
            return {}
        proposals = self._sampler.ask(1)
        if not proposals:
            return {}
        self._asked[trial.number] = proposals[0]
        return self._sampler.params(proposals[0])

    def sample_independent(self, study, trial, param_name, param_distribution):
        """A uniform number, from a stream of the seed alone."""
        self._draws += 1
        draw = Sampler(
            "random",
            [(param_name, float(param_distribution.low), float(param_distribution.high))],
            seed=self._seed * 1_000_003 + self._draws,
        )
        return float(draw.ask(1)[0].values[0])

    def before_trial(self, study, trial):
        """Nothing is to be done."""

    def after_trial(self, study, trial, state, values):
        """Tells the sampler what became of the point that it proposed."""
        asked = self._asked.pop(trial.number, None)
        if asked is not None:
            self._sampler.tell(asked, _energy_of(study, values))

    def reseed_rng(self):
        """Another stream of random numbers: for Optuna's worker processes."""
        self._seed += 1

    def _learn(self, study, done):
        if done.values is None or any(name not in done.params for name, _, _ in self._box):
            return
        point = [float(done.params[name]) for name, _, _ in self._box]
        self._sampler.add(point, _energy_of(study, done.values))


def _is_plain(space):
    return (
        hasattr(space, "low")
        and not getattr(space, "log", False)
        and getattr(space, "step", None) is None
        and isinstance(space.low, float)
    )


def _energy_of(study, values):
    if values is None:
        return math.inf
    value = float(values[0])
    direction = getattr(study.direction, "name", str(study.direction))
    return -value if direction.upper().endswith("MAXIMIZE") else value

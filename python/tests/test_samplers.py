# SPDX-License-Identifier: Apache-2.0
import math
import types

import numpy as np
import pytest

import ridgeline
from ridgeline.optuna_bridge import PoseObjective, RidgelineSampler

BOX = [("x", -2.0, 3.0), ("y", 0.0, 1.0)]


def bowl(values):
    return (values[0] - 0.5) ** 2 + (values[1] - 0.25) ** 2


@pytest.mark.parametrize("name", ["random", "sobol", "tpe", "gp", "cmaes", "nelder_mead"])
def test_ask_and_tell(name):
    def run():
        sampler = ridgeline.Sampler(name, BOX, seed=5)
        told = []
        while len(told) < 60 and not sampler.ended:
            trials = sampler.ask(4)
            for trial in trials:
                energy = bowl(trial.values)
                sampler.tell(trial, energy)
                told.append((*trial.values, energy))
        return np.array(told)

    told = run()
    np.testing.assert_array_equal(told, run())  # same seed, same points
    assert ((told[:, 0] >= -2) & (told[:, 0] <= 3) & (told[:, 1] >= 0) & (told[:, 1] <= 1)).all()
    assert told[:, 2].min() < 0.3


def test_infeasible_points_are_not_proposed():
    sampler = ridgeline.Sampler("random", BOX, feasible=lambda v: v[0] > 1.0)
    assert all(trial.values[0] > 1.0 for trial in sampler.ask(20))
    nowhere = ridgeline.Sampler("random", BOX, feasible=lambda v: False)
    with pytest.raises(ridgeline.InputError, match="no admissible point"):
        nowhere.ask()

    def fail(values):
        raise OSError("mine")

    with pytest.raises(OSError, match="mine"):
        ridgeline.Sampler("random", BOX, feasible=fail).ask()


def test_what_samplers_refuse():
    with pytest.raises(ridgeline.InputError, match="expected random, sobol, tpe"):
        ridgeline.Sampler("tqe", BOX)
    with pytest.raises(ridgeline.InputError, match="lower"):
        ridgeline.Sampler("tpe", [("x", 1.0, 0.0)])
    with pytest.raises(ridgeline.InputError, match=r"box\[0\]"):
        ridgeline.Sampler("tpe", [("x", 1.0)])
    sampler = ridgeline.Sampler("tpe", BOX)
    trial = sampler.ask()[0]
    sampler.tell(trial, 1.0)
    with pytest.raises(ridgeline.InputError, match="told before"):
        sampler.tell(trial, 1.0)
    with pytest.raises(ridgeline.InputError, match="a point of the box"):
        sampler.add([9.0, 0.5], 1.0)


def test_a_search_over_poses(localizer, picture, query):
    space = localizer.search_space(query.truth, {"east_m": 3, "north_m": 3, "heading_deg": 5,
                                                 "pitch_deg": 0, "roll_deg": 0})
    score = picture.score()
    sampler = ridgeline.Sampler(
        "sobol", space.box, feasible=lambda v: space.pose_at(v) is not None
    )
    trials = sampler.ask(32)
    poses = ridgeline.Poses([space.pose_at(trial.values) for trial in trials])
    for trial, energy in zip(trials, score.energies(poses)):
        sampler.tell(trial, energy)
    offsets = np.array([trial.values for trial in trials])
    assert space.admissible(offsets).all()
    np.testing.assert_allclose(space.pose_at([0.0] * 6).center, query.truth.center, atol=1e-9)


class FakeOptuna:
    """A study with the interface of Optuna 4 that the bridge meets."""

    class State:
        def __init__(self, finished):
            self._finished = finished

        def is_finished(self):
            return self._finished

    class Trial:
        def __init__(self, study, number):
            self.study, self.number = study, number
            self.params, self.distributions, self.values = {}, {}, None
            self.state = FakeOptuna.State(False)
            space = study.sampler.infer_relative_search_space(study, self)
            self.relative = study.sampler.sample_relative(study, self, space)

        def suggest_float(self, name, low, high):
            distribution = types.SimpleNamespace(low=low, high=high, log=False, step=None)
            if name in self.relative:
                value = self.relative[name]
            else:
                value = self.study.sampler.sample_independent(self.study, self, name, distribution)
            assert low <= value <= high
            self.params[name], self.distributions[name] = value, distribution
            return value

    def __init__(self, sampler, direction="MINIMIZE"):
        self.sampler, self.trials = sampler, []
        self.direction = types.SimpleNamespace(name=direction)

    def get_trials(self, deepcopy=True):
        return self.trials

    def optimize(self, objective, n_trials):
        for number in range(n_trials):
            self.sampler.before_trial(self, number)
            trial = FakeOptuna.Trial(self, number)
            self.trials.append(trial)
            trial.values = [objective(trial)]
            trial.state = FakeOptuna.State(True)
            self.sampler.after_trial(self, trial, trial.state, trial.values)

    def best(self):
        sign = 1.0 if self.direction.name == "MINIMIZE" else -1.0
        return min(self.trials, key=lambda t: sign * t.values[0])


@pytest.mark.parametrize("direction, sign", [("MINIMIZE", 1.0), ("MAXIMIZE", -1.0)])
def test_our_sampler_in_an_optuna_study(direction, sign):
    study = FakeOptuna(RidgelineSampler("gp", seed=2), direction)
    study.optimize(
        lambda t: sign * bowl([t.suggest_float("x", -2.0, 3.0), t.suggest_float("y", 0.0, 1.0)]), 30
    )
    assert sign * study.best().values[0] < 0.01
    relative = [t for t in study.trials if t.relative]
    assert len(relative) == 29  # all but the first, which made the box


def test_an_optuna_study_drives_our_energy(localizer, picture, query):
    space = localizer.search_space(query.truth, {"east_m": 2, "north_m": 2, "heading_deg": 3,
                                                 "pitch_deg": 0, "roll_deg": 0})
    objective = PoseObjective(picture.score(), space)
    study = FakeOptuna(RidgelineSampler("tpe", seed=1))
    study.optimize(objective, 25)
    best = study.best()
    assert set(best.params) == {"east_m", "north_m", "heading_deg"}
    pose = objective.pose_of(best.params)
    assert picture.score().energies(pose)[0] == best.values[0]
    assert math.isfinite(best.values[0])

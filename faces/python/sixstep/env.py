# SPDX-License-Identifier: Apache-2.0
"""An environment for learning, with the interface of Gymnasium, over many drives at a time."""
from __future__ import annotations

import operator
import os
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core
from .scenario import Source, as_scenario

Array = NDArray[np.float64]


class Box:
    """Bounds of an array. If gymnasium is installed, gymnasium.spaces.Box is used instead."""

    def __init__(self, low: Array, high: Array) -> None:
        self.low, self.high, self.shape = low, high, low.shape

    def sample(self, rng: np.random.Generator | None = None) -> Array:
        return (rng or np.random.default_rng()).uniform(self.low, self.high)


def _box(low: Array, high: Array) -> Any:
    try:
        from gymnasium.spaces import Box as GymnasiumBox
    except ImportError:
        return Box(low, high)
    return GymnasiumBox(low, high, dtype=np.float64)


class Env:
    """Drives of one scenario. Each drive receives one action per step.

    scenario   defines the task: reference, load, sensors and [[at]] changes. The actions replace its controller
    drives     number of drives; arrays have one row per drive
    action     "duty": the duty of the driven pair, -1..1, commutated by the Hall code; "legs": duties of the three legs, 0..1;
               "current": setpoint of the library's current loop in A, with the gains of the scenario
    hold       control periods per step
    spread     True: each drive is a different drive of the scenario's [[spread]]. False: all drives have the scenario's values
    reward     function of (observation, action) with one row per drive. Default: minus the distance between `target` and the setpoint
    target     the observed value that follows the setpoint: "speed_rad_s", "motor_current_A" or another of `Env.observed`
    workers    number of threads. Default: one per core. Results do not depend on this number

    An observation contains the board's measurements at a control tick (`Env.observed`). The action of a step acts from the next tick
    on, like the output of a firmware that needs one period to compute.

    >>> import numpy as np, sixstep
    >>> s = sixstep.Scenario(motor="maxon-251601", duration_s=0.01, control={"mode": "speed"}, reference={"value": 100, "unit": "rad/s"})
    >>> env = sixstep.Env(s, drives=4)
    >>> seen, info = env.reset(seed=1)
    >>> seen, reward, terminated, truncated, info = env.step(np.full((4, 1), 0.3))
    >>> seen.shape, bool((seen[:, 5] > 0).all())
    ((4, 11), True)
    """

    observed: tuple[str, ...] = _core.observed

    def __init__(self, scenario: Source, drives: int = 1, *, action: str = "duty", hold: int = 1, spread: bool = False,
                 target: str | None = None, reward: Callable[[Array, Array], Array] | None = None, workers: int | None = None) -> None:
        scenario = as_scenario(scenario)
        if int(drives) != drives or int(hold) != hold or drives < 1 or hold < 1:
            raise ValueError("drives and hold must be whole numbers from 1")
        if workers is not None and (int(workers) != workers or workers < 1):
            raise ValueError(f"workers = {workers} must be a whole number from 1")
        if spread and not any(key.startswith("spread[") for key in scenario):
            raise ValueError("spread=True needs a [[spread]] in the scenario")
        self.num_envs, self.hold = drives, hold
        self._spread, self._seed, self._numbers = spread, 1, np.arange(drives)
        self._columns = 3 if action == "legs" else 1
        usual = {"speed": "speed_rad_s", "position": "position_deg", "current": "motor_current_A"}
        self._target = usual.get(str(scenario["control.mode"]), "") if target is None else target
        if not self._target and reward is None:
            raise ValueError("this mode has no measured value that follows its setpoint; give reward, or target")
        if self._target and self._target not in self.observed:
            raise ValueError(f'target = "{self._target}" is not observed; use one of {", ".join(self.observed)}')
        self._reward = reward
        self._core = _core.Environment(scenario._core, drives, action, workers or os.cpu_count() or 1)
        most = self._core.most_current_A if action == "current" else 1.0
        self._least, self._most = 0.0 if action == "legs" else -most, most
        self.action_space = _box(np.full((drives, self._columns), self._least), np.full((drives, self._columns), most))
        bound = np.full((drives, len(self.observed)), np.inf)
        self.observation_space = _box(-bound, bound)
        self.single_action_space = _box(np.full(self._columns, self._least), np.full(self._columns, most))
        self.single_observation_space = _box(-bound[0], bound[0])

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Array, dict[str, Any]]:
        """Restarts all drives. `seed` is the seed of the drives of `spread`."""
        if seed is not None:
            if operator.index(seed) < 0:
                raise ValueError(f"seed = {seed} must be at least 0")
            self._seed = seed
            self._numbers = np.arange(self.num_envs)
        self._start(np.arange(self.num_envs))
        return self._core.observations(), {}

    def step(self, actions: Any) -> tuple[Array, Array, NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]:
        """One step of all drives: observations, rewards, terminated, truncated, info. A fault terminates a drive's run, and the end of
        the duration truncates it. An ended run does not change until `reset_where`."""
        given = np.ascontiguousarray(actions, dtype=np.float64).reshape(self.num_envs, self._columns)
        if not (np.isfinite(given).all() and (given >= self._least).all() and (given <= self._most).all()):
            raise ValueError(f"each action must lie in {self._least:g} to {self._most:g}, the bounds of action_space")
        self._core.step(given, self.hold)
        seen = self._core.observations()
        over = self._core.over()
        failed = self._core.failed()
        return seen, self.rewarded(seen, given), failed, over & ~failed, {}

    def reset_where(self, which: Any) -> Array:
        """Restarts the drives of this mask. Each becomes the next drive of the series. Returns all observations."""
        mask = np.asarray(which)
        if mask.dtype != np.bool_ or mask.shape != (self.num_envs,):
            raise ValueError(f"reset_where needs one True or False for each of the {self.num_envs} drives")
        chosen = np.flatnonzero(mask)
        self._numbers[chosen] += self.num_envs
        self._start(chosen)
        return self._core.observations()

    def _start(self, which: NDArray[np.int_]) -> None:
        numbers = [int(self._numbers[n]) if self._spread else None for n in which]
        self._core.reset([int(n) for n in which], self._seed, numbers)

    def rewarded(self, seen: Array, actions: Array) -> Array:
        """The reward of each drive."""
        if self._reward is not None:
            given: Array = np.asarray(self._reward(seen, actions), dtype=np.float64)
            if given.shape != (self.num_envs,):
                raise ValueError(f"reward returned the shape {given.shape}; it needs one number for each of the {self.num_envs} drives")
            return given
        distance: Array = np.abs(seen[:, -1] - self.value(seen, self._target))
        return -distance

    @classmethod
    def value(cls, seen: Array, name: str) -> Array:
        """A column of the observation by its name."""
        if name not in cls.observed:
            raise ValueError(f"{name} is not observed; use one of {', '.join(cls.observed)}")
        column: Array = seen[:, cls.observed.index(name)]
        return column

    def close(self) -> None:
        """Does nothing. The memory is freed with the object."""

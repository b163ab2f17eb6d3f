# SPDX-License-Identifier: GPL-2.0-or-later
"""The cyclic stage: the upper platen follows haversines, the force is read at both platens.

The lower platen is the report's load cell. At rest both platens feel the same force; in motion they differ by the inertia
of the sand between them. For a uniform bar of wave speed c, height H, and theta = w H/c, the fixed end answers with
k theta/sin(theta) = k (1 + theta^2/6 + ...) and the driven end with k theta/tan(theta) = k (1 - theta^2/3 - ...), so that
(2 x fixed + driven)/3 is free of inertia to the order theta^4.
"""
from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from yade import O, Vector3

from grainfall.dynamics import Response, multisine, stiffness_and_damping
from grainfall.triaxial import scene
from grainfall.triaxial.checks import common_period
from grainfall.triaxial.samples import Sample

#: Rows recorded in a period of the highest frequency; each is a mean over the steps in between.
ROWS_PER_PERIOD = 64
COLUMNS = ("time_s", "displacement_m", "lower_force_N", "upper_force_N")


class CyclicTest:
    """One stretch of cycles: a single frequency, or several at once.

    Parameters
    ----------
    sample : Sample
        Its bodies are in the scene, the upper platen held.
    frequencies : sequence of float
        [Hz].
    peak_to_peak : float
        Displacement of the platen [m].
    longest_step : float
        Bound of the time step [s]; the step is shortened so that a period has a whole number of steps.
    """

    def __init__(
        self, sample: Sample, frequencies: Sequence[float], peak_to_peak: float, longest_step: float
    ) -> None:
        self.sample = sample
        self.frequencies = tuple(frequencies)
        self.peak_to_peak = peak_to_peak
        self.period = common_period(frequencies)
        rows = ROWS_PER_PERIOD * max(1, round(self.period * max(frequencies)))
        self.steps_per_row = max(1, math.ceil(self.period / rows / longest_step))
        self.steps_per_cycle = rows * self.steps_per_row
        self.step = self.period / self.steps_per_cycle
        self.rows: list[tuple[float, ...]] = []
        self.cycle_ends: list[int] = []
        self.work = 0.0
        self._start = O.time
        self._zero = scene.top_height(sample)
        self._body = O.bodies[sample.top_platen]
        self._sum = np.zeros(4)
        self._count = 0
        self._last: tuple[float, float] | None = None

    def target(self, time: float) -> float:
        """Displacement at this time since the start [m]; over the first cycle the amplitude grows from zero."""
        grown = 1.0
        if time < self.period:
            grown = 0.5 * (1 - math.cos(math.pi * time / self.period))
        return grown * float(multisine(time, self.peak_to_peak, self.frequencies))

    def drive(self) -> None:
        """Record this moment and send the platen to where it must be after the step; called in every step.

        Forces and positions belong to the same moment here, between the contacts and the integrator.
        """
        now = O.time - self._start
        displacement = self._zero - self._body.state.pos[2]
        below, above = scene.platen_forces(self.sample)
        if self._last is not None:
            moved = displacement - self._last[0]
            self.work += 0.5 * (above + self._last[1]) * moved
        self._last = (displacement, above)
        self._sum += (now, displacement, below, above)
        self._count += 1
        if self._count == self.steps_per_row:
            self.rows.append(tuple(self._sum / self._count))
            self._sum[:] = 0.0
            self._count = 0
        ahead = self.target(now + O.dt)
        self._body.state.vel = Vector3(0, 0, (displacement - ahead) / O.dt)

    def end_cycle(self) -> None:
        """Mark the end of a cycle in the record."""
        self.cycle_ends.append(len(self.rows))

    def table(self, cycles: int | None = None) -> np.ndarray:
        """The record, or its last cycles, shape (rows, 4), columns `COLUMNS`."""
        start = 0
        if cycles is not None and len(self.cycle_ends) > cycles:
            start = self.cycle_ends[-cycles - 1]
        return np.array(self.rows[start:], dtype=float).reshape(-1, len(COLUMNS))

    def responses(self, cycles: int, platen: str = "lower") -> list[Response]:
        """k and b at each frequency from the last cycles, with the force of the 'lower' or the 'upper' platen."""
        time, displacement, below, above = self.table(cycles).T
        force = below if platen == "lower" else above
        return stiffness_and_damping(time, displacement, force, self.frequencies)

    def change(self) -> float:
        """Largest relative change of k + i w b between the last two cycles; infinite while there is but one.

        The first cycle, in which the amplitude grows, does not count.
        """
        if len(self.cycle_ends) < 3:
            return math.inf
        ends = self.cycle_ends
        both = []
        for begin, end in ((ends[-3], ends[-2]), (ends[-2], ends[-1])):
            time, displacement, below, _ = np.array(self.rows[begin:end]).T
            both.append(
                [
                    one.complex_stiffness
                    for one in stiffness_and_damping(time, displacement, below, self.frequencies, 1)
                ]
            )
        before, after = np.array(both)
        return float(np.max(np.abs(after - before) / np.abs(after)))


def inertia_free(lower: Response, upper: Response) -> complex:
    """Complex stiffness without the sand's inertia, (2 x fixed end + driven end)/3 [N/m]."""
    return (2 * lower.complex_stiffness + upper.complex_stiffness) / 3


_current: CyclicTest | None = None


def set_current(test: CyclicTest | None) -> None:
    """Name the test that the actuator of the scene in hand serves."""
    global _current
    _current = test


def drive() -> None:
    """Called by the actuator's engine; without a test (scene loaded by hand) the platen keeps its velocity."""
    if _current is not None:
        _current.drive()


def actuator() -> Any:
    """The engine that calls `drive` in every step."""
    import yade.wrapper

    command = "import grainfall.triaxial.cyclic; grainfall.triaxial.cyclic.drive()"
    return yade.wrapper.PyRunner(command=command, iterPeriod=1, label="actuator")

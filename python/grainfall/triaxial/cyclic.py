# SPDX-License-Identifier: GPL-2.0-or-later
"""The cyclic stage: the upper platen follows haversines, the force is read at both platens.

The lower platen is the report's load cell. At rest both platens feel the same force; in motion they differ by the
inertia of the sand between them. For a uniform bar of wave speed c, height H, and theta = w H/c, the fixed end answers
with k theta/sin(theta) = k (1 + theta^2/6 + ...) and the driven end with k theta/tan(theta) = k (1 - theta^2/3 - ...),
so that (2 x fixed + driven)/3 is free of inertia to the order theta^4.
"""
from __future__ import annotations

import builtins
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from yade import O, Vector3

from grainfall.dynamics import Response, stiffness_and_damping
from grainfall.triaxial import scene
from grainfall.triaxial.checks import common_period
from grainfall.triaxial.samples import Sample

#: Rows recorded in a period of the highest frequency, and samples of which each row is the mean. Between two the
#: platen moves at constant speed: 1024 in a period keep its path within 2e-6 of the amplitude from the haversine.
ROWS_PER_PERIOD, SAMPLES_PER_ROW = 64, 16
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
        steps_per_row = max(1, math.ceil(self.period / rows / longest_step))
        self.stride = max(1, steps_per_row // SAMPLES_PER_ROW)
        self.samples_per_row = math.ceil(steps_per_row / self.stride)
        self.steps_per_cycle = rows * self.samples_per_row * self.stride
        self.step = self.period / self.steps_per_cycle
        self.rows: list[tuple[float, ...]] = []
        self.cycle_ends: list[int] = []
        self._start = O.time
        self._share = 0.5 * peak_to_peak / len(self.frequencies)
        self._omegas = [2 * math.pi * frequency for frequency in self.frequencies]
        self._zero = scene.top_height(sample)
        self._state = O.bodies[sample.top_platen].state
        self._sums = [0.0] * len(COLUMNS)
        self._count = 0

    def target(self, time: float) -> float:
        """Displacement at this time since the start [m]; over the first cycle the amplitude grows from zero.

        `grainfall.dynamics.multisine` times the growth, for one moment at a time.
        """
        total = self._share * sum(1.0 - math.cos(omega * time) for omega in self._omegas)
        if time < self.period:
            total *= 0.5 * (1 - math.cos(math.pi * time / self.period))
        return total

    def drive(self) -> None:
        """Record this moment and send the platen to where it must be at the next call, `stride` steps on.

        Forces and positions belong to the same moment here, between the contacts and the integrator.
        """
        now = O.time - self._start
        displacement = self._zero - self._state.pos[2]
        below, above = scene.platen_forces(self.sample)
        row = (now, displacement, below, above)
        self._sums = [total + value for total, value in zip(self._sums, row)]
        self._count += 1
        if self._count == self.samples_per_row:
            self.rows.append(tuple(total / self._count for total in self._sums))
            self._sums = [0.0] * len(COLUMNS)
            self._count = 0
        span = self.stride * self.step
        self._state.vel = Vector3(0, 0, (displacement - self.target(now + span)) / span)

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


def start(test: CyclicTest) -> None:
    """Let the actuator of the scene in hand serve this test from the next step on."""
    global _current
    _current = test
    O.dt = test.step
    builtins.actuator.iterPeriod = test.stride
    builtins.actuator.iterLast = O.iter - test.stride


def stop() -> None:
    """Leave the actuator without a test: a scene loaded by hand, or between two tests."""
    global _current
    _current = None


def drive() -> None:
    """Called by the actuator's engine; without a test the platen keeps its velocity."""
    if _current is not None:
        _current.drive()


def actuator() -> Any:
    """The engine that calls `drive`."""
    import yade.wrapper

    command = "import grainfall.triaxial.cyclic; grainfall.triaxial.cyclic.drive()"
    return yade.wrapper.PyRunner(command=command, iterPeriod=1, label="actuator")

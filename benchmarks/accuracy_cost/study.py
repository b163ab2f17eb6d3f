# SPDX-License-Identifier: GPL-2.0-or-later
"""A study varies knobs of one case and measures, for each setting, an error and the processor time.

To add an effect, add a `Knob` to a case of this folder, or a new case: a function that runs one setting and returns a
`Measurement`, and one that turns measurements into errors.
"""
from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, dataclass, field
from typing import Any


@dataclass(frozen=True)
class Knob:
    """One thing that buys accuracy.

    name : what is varied, with its unit; becomes a line of the figure
    settings : label of each value -> options of the case that differ from its defaults
    """

    name: str
    settings: Mapping[str, Mapping[str, Any]]


@dataclass(frozen=True)
class Measurement:
    """Result of one run: whatever the case compares, and processor seconds."""

    result: Any
    cpu_seconds: float
    extra: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Point:
    """One line of the table."""

    knob: str
    setting: str
    error: float
    cpu_seconds: float
    extra: Mapping[str, float]


@dataclass(frozen=True)
class Case:
    """A scene, its knobs, and its measure of error.

    name : of the files
    error : what the error is, with its unit
    cost : what the processor time is spent on
    run : options -> Measurement
    reference : options of the run that counts as the truth
    distance : result, reference result -> error
    """

    name: str
    error: str
    cost: str
    run: Callable[..., Measurement]
    reference: Mapping[str, Any]
    distance: Callable[[Any, Any], float]
    knobs: tuple[Knob, ...]


def measure(case: Case, repeats: int, truth: Any, progress: Callable[[str], None]) -> list[Point]:
    """Run every setting `repeats` times in turn; the least time of each counts, which other programs disturb least.

    `truth` is the result of the reference run.
    """
    best: dict[tuple[str, str], Measurement] = {}
    for repeat in range(repeats):
        for knob in case.knobs:
            for label, options in knob.settings.items():
                progress(f"{case.name}: {knob.name} = {label} ({repeat + 1}/{repeats})")
                key = (knob.name, label)
                now = case.run(**options)
                if key not in best or now.cpu_seconds < best[key].cpu_seconds:
                    best[key] = now
    return [
        Point(knob, label, case.distance(m.result, truth), m.cpu_seconds, dict(m.extra))
        for (knob, label), m in best.items()
    ]


def timed(function: Callable[[], None]) -> float:
    """Processor seconds that a call takes, all threads."""
    started = time.process_time()
    function()
    return time.process_time() - started


def reference_options(case: Case) -> dict[str, str]:
    """Options of the reference run as the results file has them."""
    return {key: str(value) for key, value in case.reference.items()}


def as_json(case: Case, truth: Any, points: Iterable[Point]) -> dict[str, Any]:
    """What goes into the results file; a reference that is one number is kept, since its run may be long."""
    return {
        "error": case.error,
        "cost": case.cost,
        "reference": reference_options(case),
        "reference_result": truth if isinstance(truth, float) else None,
        "points": [asdict(point) for point in points],
    }

# SPDX-License-Identifier: GPL-2.0-or-later
"""A study varies knobs of one case and measures, for each setting, an error, its scatter and the processor time.

Where chance decides part of the result (the packing of a bed), each setting is run with several samples. Their mean is
compared with the truth; the scatter is what a single run may be off by chance.

To add an effect, add a `Knob` to a case of this folder, or a new case: a function that runs one setting and returns a
`Measurement`, and one that turns measurements into errors.
"""
from __future__ import annotations

import json
import math
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

ONE_SAMPLE: Mapping[str, Any] = {}


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
    """One line of the table.

    error : of the mean of the samples
    scatter : standard deviation of the samples' results, in the unit of the error; None for one sample
    samples : how many
    cpu_seconds, extra : means of the samples
    """

    knob: str
    setting: str
    error: float
    scatter: float | None
    samples: int
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
    distance : result, reference result -> error; results can be added and divided by numbers
    samples : options of runs that differ by chance alone
    """

    name: str
    error: str
    cost: str
    run: Callable[..., Measurement]
    reference: Mapping[str, Any]
    distance: Callable[[Any, Any], float]
    knobs: tuple[Knob, ...]
    samples: Sequence[Mapping[str, Any]] = (ONE_SAMPLE,)


class KeptRuns:
    """Results of runs by their options, so that long studies go on where they stopped.

    Only results that are one number are kept.
    """

    def __init__(self, entries: Iterable[Mapping[str, Any]], save: Callable[[list], None]) -> None:
        self._runs = {self._key(e["options"]): dict(e) for e in entries}
        self._save = save

    @staticmethod
    def _key(options: Mapping[str, Any]) -> str:
        return json.dumps(options, sort_keys=True)

    def find(self, options: Mapping[str, Any]) -> Measurement | None:
        """The run with these options, if there was one."""
        entry = self._runs.get(self._key(options))
        return entry and Measurement(entry["result"], entry["cpu_seconds"], entry["extra"])

    def add(self, options: Mapping[str, Any], run: Measurement) -> None:
        """Keep a run."""
        if isinstance(run.result, float):
            entry = {"options": dict(options), **asdict(run)}
            self._runs[self._key(options)] = entry
            self._save(list(self._runs.values()))


def measure(
    case: Case,
    truth: Any,
    kept: KeptRuns,
    repeats: int,
    samples: int,
    progress: Callable[[str], None],
) -> list[Point]:
    """Run the settings, the first `samples` samples of each, and compare with `truth`, the result of the reference run.

    Kept runs are not run again, and count whatever their sample. The others are repeated `repeats` times in turn; the
    least time of each counts, which other programs disturb least.
    """
    names = [(knob.name, label) for knob in case.knobs for label in knob.settings]
    settings = [options for knob in case.knobs for options in knob.settings.values()]
    best: list[dict[int, Measurement]] = [{} for _ in settings]
    for setting, runs in zip(settings, best):
        for number, sample in enumerate(case.samples):
            if run := kept.find({**sample, **setting}):
                runs[number] = run
    missing = [
        (place, number)
        for place, runs in enumerate(best)
        for number in range(min(samples, len(case.samples)))
        if number not in runs
    ]
    for repeat in range(repeats):
        for place, number in missing:
            knob, label = names[place]
            progress(f"{case.name}: {knob} = {label}, {number + 1} ({repeat + 1}/{repeats})")
            options = {**case.samples[number], **settings[place]}
            run, before = case.run(**options), best[place].get(number)
            if before is None or run.cpu_seconds < before.cpu_seconds:
                best[place][number] = run
                kept.add(options, run)
    return [point(case, truth, *name, list(runs.values())) for name, runs in zip(names, best)]


def point(case: Case, truth: Any, knob: str, label: str, runs: Sequence[Measurement]) -> Point:
    """Mean, error and scatter of the samples of one setting."""
    count = len(runs)
    mean = sum(run.result for run in runs) / count
    # The distance of a result from the mean, measured from the truth so that it has the error's unit.
    squares = sum(case.distance(truth + (run.result - mean), truth) ** 2 for run in runs)
    return Point(
        knob,
        label,
        case.distance(mean, truth),
        math.sqrt(squares / (count - 1)) if count > 1 else None,
        count,
        sum(run.cpu_seconds for run in runs) / count,
        {key: sum(run.extra[key] for run in runs) / count for key in runs[0].extra},
    )


def timed(function: Callable[[], None]) -> float:
    """Processor seconds that a call takes, all threads."""
    started = time.process_time()
    function()
    return time.process_time() - started


def reference_options(case: Case) -> dict[str, str]:
    """Options of the reference run as the results file has them."""
    return {key: str(value) for key, value in case.reference.items()}


def reference_as_json(case: Case, truth: Any) -> dict[str, Any]:
    """The reference in the results file; one that is a number is kept, since its run may be long."""
    return {
        "reference": reference_options(case),
        "reference_result": truth if isinstance(truth, float) else None,
    }


def as_json(case: Case, points: Iterable[Point]) -> dict[str, Any]:
    """The points in the results file."""
    return {
        "error": case.error,
        "cost": case.cost,
        "points": [asdict(point) for point in points],
    }

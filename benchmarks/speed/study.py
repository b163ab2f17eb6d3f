# SPDX-License-Identifier: GPL-2.0-or-later
"""Rounds in which every contender runs once, and what the rounds say together.

Ratios are formed within a round and the median over the rounds is given, so that a machine that is
slow for a minute is slow for all. One thread is measured in processor time, which other programs
disturb least; two threads, where waiting counts, by the clock on the wall.
"""
from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from speed import bed as beds
from speed.bed import Bed
from speed.contenders import Contender, Run, Sample, take
from speed.machine import OthersWatch

#: Largest difference from the reference, root mean square, relative to the reference's displacement.
#: Within Grainfall the formulas are the same but for lever arms at walls, which differ by the overlap (1e-4
#: after 100 steps); the others start half a step apart (1 %) and damp and rescale shear a little differently.
TOLERANCE = {"flat": 1e-3, "kernel": 1e-3}
TOLERANCE_OF_OTHERS = 0.1


@dataclass(frozen=True)
class Case:
    """What is run on one bed.

    Parameters
    ----------
    bed : Bed
        The bed at the start.
    threads : int
        Threads or ranks.
    warm_up, steps, rounds : int
        Untimed and timed steps of a sample; samples of each contender.
    moving : bool
        Whether the projectile moves; neighbours are then looked up within the timed steps.
    """

    bed: Bed
    threads: int
    warm_up: int
    steps: int
    rounds: int
    moving: bool = False


def measure(case: Case, field: Sequence[Contender]) -> dict[str, Any]:
    """Run all rounds of a case."""
    taking_part = [
        c
        for c in field
        if not c.absent and c.most_threads >= case.threads and (c.moving_skin or not case.moving)
    ]
    samples: dict[str, list[Sample]] = {c.name: [] for c in taking_part}
    others: list[float] = []
    run = Run(case.bed, case.threads, case.warm_up, case.steps, beds.SKIN)
    for number in range(case.rounds):
        turned = taking_part[number % len(taking_part) :] + taking_part[: number % len(taking_part)]
        for contender in turned:
            watch = OthersWatch()
            own_run = replace(run, skin=contender.moving_skin) if case.moving else run
            sample = take(contender, own_run)
            if number:  # the bodies at the end are compared once
                sample.bodies = np.empty((0, 11))
            samples[contender.name].append(sample)
            others.append(watch.busy())
    contacts = _touching(samples[taking_part[0].name][0].bodies[: case.bed.grains], case.bed.side)
    result: dict[str, Any] = {
        "grains": case.bed.grains,
        "threads": case.threads,
        "clock": "processor" if case.threads == 1 else "wall",
        "steps": case.steps,
        "rounds": case.rounds,
        "contacts": contacts,
        "others_busy_processors": {
            "median": round(float(np.median(others)), 2),
            "most": round(max(others), 2),
        },
        "physics": _differences(case, {name: s[0].bodies for name, s in samples.items()}),
    }
    if not case.moving:
        _require_no_rebuild(samples)
    result["contenders"] = {
        name: _summary(s, case.threads, contacts) for name, s in samples.items()
    }
    return result


def cost(sample: Sample, threads: int) -> float:
    """Seconds a step that count: of the processor on one thread, on the wall on more."""
    return sample.processor if threads == 1 else sample.wall


def _summary(samples: Sequence[Sample], threads: int, contacts: int) -> dict[str, Any]:
    costs = [1e3 * cost(s, threads) for s in samples]
    low, middle, high = np.percentile(costs, (25, 50, 75))
    extra = {
        key: float(np.median([s.extra[key] for s in samples]))
        for key in samples[0].extra
        if key.startswith(("bytes", "pairs", "force", "motion"))
    }
    return {
        "step_ms": _rounded(middle),
        "step_ms_quartiles": [_rounded(low), _rounded(high)],
        "step_ms_rounds": [_rounded(c) for c in costs],
        "wall_ms": _rounded(1e3 * float(np.median([s.wall for s in samples]))),
        "ns_per_contact": round(1e6 * float(middle) / contacts, 1),
        "rebuilds": samples[0].rebuilds,
        **extra,
    }


def ratio(case: dict[str, Any], over: str, under: str) -> dict[str, Any] | None:
    """Median and quartiles of the ratio of two contenders, formed round by round; None if one is absent."""
    contenders = case["contenders"]
    if over not in contenders or under not in contenders:
        return None
    ratios = np.divide(contenders[over]["step_ms_rounds"], contenders[under]["step_ms_rounds"])
    low, middle, high = np.percentile(ratios, (25, 50, 75))
    return {"median": round(middle, 3), "quartiles": [round(low, 3), round(high, 3)]}


def growth(cases: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Step time against number of grains, and the exponent of the power law that fits it best."""
    lines: dict[str, Any] = {}
    for case in cases:
        for name, entry in case["contenders"].items():
            line = lines.setdefault(name, {"grains": [], "step_ms": []})
            line["grains"].append(case["grains"])
            line["step_ms"].append(entry["step_ms"])
    for line in lines.values():
        if len(line["grains"]) > 1:
            slope = np.polyfit(np.log(line["grains"]), np.log(line["step_ms"]), 1)[0]
            line["exponent"] = round(float(slope), 3)
    busy = [case["others_busy_processors"]["median"] for case in cases]
    return {"others_busy_processors": busy, "rounds": [c["rounds"] for c in cases], "lines": lines}


def memory(case: dict[str, Any]) -> dict[str, Any]:
    """Bytes a grain and a contact, from the resident memory of the processes of one case."""
    result: dict[str, Any] = {}
    for name, entry in case["contenders"].items():
        if "bytes_bodies" in entry:
            result[name] = {
                "bytes_per_grain": round(entry["bytes_bodies"] / case["grains"]),
                "bytes_per_contact": round(entry["bytes_contacts"] / case["contacts"]),
            }
        elif "bytes_all" in entry:
            result[name] = {
                "bytes_per_grain_contacts_included": round(entry["bytes_all"] / case["grains"])
            }
    return result


def _differences(case: Case, ends: dict[str, np.ndarray]) -> dict[str, Any]:
    """How far each contender's grains end from the reference's; raises where it is too far."""
    start = case.bed.bodies()
    result: dict[str, Any] = {}
    for name, end in ends.items():
        ours = name in TOLERANCE and "general" in ends
        reference = "general" if ours else "stock_yade"
        if name == reference or reference not in ends:
            continue
        moved = _distance(ends[reference], start)
        relative = _distance(end, ends[reference]) / moved
        tolerance = TOLERANCE[name] if ours else TOLERANCE_OF_OTHERS
        result[name] = {
            "position_difference": _rounded(relative),
            "relative_to": reference,
            "tolerance": tolerance,
        }
        if not relative <= tolerance:
            raise RuntimeError(
                f"{name} computes something else: its grains end {relative:.2g} of the way that "
                f"{reference} moved them from where {reference} put them (allowed {tolerance:g})"
            )
    return result


def _distance(one: np.ndarray, other: np.ndarray) -> float:
    """Root mean square distance of bodies, shape (n, 11) [m]."""
    return float(np.sqrt(((one[:, :3] - other[:, :3]) ** 2).sum(axis=1).mean()))


def _touching(grains: np.ndarray, side: float) -> int:
    """Contacts among grains and with the walls."""
    radius = grains[0, 9]
    between = len(cKDTree(grains[:, :3]).query_pairs(2 * radius, output_type="ndarray"))
    lateral = np.count_nonzero(np.abs(grains[:, :2]) > side / 2 - radius)
    return between + int(lateral) + int(np.count_nonzero(grains[:, 2] < radius))


def _require_no_rebuild(samples: dict[str, list[Sample]]) -> None:
    for name, taken in samples.items():
        if any(sample.rebuilds for sample in taken):
            raise RuntimeError(f"{name} looked for neighbours while timed: the bed is not at rest")


def _rounded(value: float) -> float:
    return float(f"{value:.5g}")

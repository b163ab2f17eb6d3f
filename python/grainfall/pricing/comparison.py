# SPDX-License-Identifier: GPL-2.0-or-later
"""What an effect costs and changes, from runs with it and without it."""
from __future__ import annotations

from typing import Any

import numpy as np
from grainfall.pricing.variants import Variant


def change(variant: Variant, with_it: dict, without: dict) -> dict[str, float | None]:
    """How the run with an effect differs from the run without it."""
    if not variant.comparable:
        names = ("position_m", "contact_force", "kinetic_J", "stored_J")
        return {f"change_{name}": None for name in names}
    common = with_it["positions"].keys() & without["positions"].keys()
    moved = [np.linalg.norm(with_it["positions"][i] - without["positions"][i]) for i in common]
    force = with_it["force"] / without["force"] - 1 if without["force"] > 0 else None
    return {
        "change_position_m": float(max(moved, default=0.0)),
        "change_contact_force": force,
        "change_kinetic_J": with_it["kinetic"] - without["kinetic"],
        "change_stored_J": with_it["stored"] - without["stored"],
    }


def entry(variant: Variant, times: np.ndarray, base: np.ndarray, states: tuple) -> dict[str, Any]:
    """One line of the price list.

    Parameters
    ----------
    times, base : np.ndarray
        Seconds a step of the variant and of the scene as it is, shape (rounds,).
    states : tuple
        What the scene as it is and the variant are compared by.
    """
    on = variant.on if variant.comparable else False  # the stepper is what its variant adds
    with_it, without = (base, times) if on else (times, base)
    ratios = np.percentile(with_it / without - 1, (25, 50, 75))
    pair = states if on else states[::-1]
    contacts = max(states[0]["contacts"], 1)
    return {
        "effect": variant.effect,
        "on": variant.on,
        "instead": variant.instead,
        "step_with_us": float(np.median(with_it)) * 1e6,
        "step_without_us": float(np.median(without)) * 1e6,
        "price": float(ratios[1]),
        "price_quartiles": (float(ratios[0]), float(ratios[2])),
        "nanoseconds_per_contact": float(np.median(with_it - without)) / contacts * 1e9,
        **change(variant, *pair),
    }

# SPDX-License-Identifier: GPL-2.0-or-later
"""What every scenario says at its end: notes on the sand, the water and the energy balance; effects and price."""
from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from grainfall.options import Option

ENERGY_LIMIT = Option(
    "energy_limit",
    1e-3,
    "warn if the energy residual is larger than this; relative to the energy in play, in the triaxial test to the "
    "energy that a cycle stores",
    "-",
    low=0,
    runtime=True,
)


def coarse_grains(summary: Mapping[str, Any]) -> list[str]:
    """Grains that stand for many smaller ones."""
    if summary["grain_enlargement"] <= 1:
        return []
    return [
        f"Grains are {summary['grain_enlargement']:.1f} times larger than the real ones: {summary['particles']} stand "
        f"for {summary['real_grains']:.3g}. Friction is read at the load divided by the square of that."
    ]


def energy_balance(summary: Mapping[str, Any], reference: str) -> list[str]:
    """A residual above ``--energy-limit``; `reference` says what it is relative to."""
    residual, limit = summary.get("energy_residual_relative"), summary["parameters"]["energy_limit"]
    if residual is None or residual <= limit:
        return []
    interval = summary["parameters"].get("far_field_interval") or 1
    remedy = "--far-field-interval or --dt-safety" if interval > 1 else "--dt-safety"
    return [
        f"WARNING: the energy balance is off by {residual:.1e} of {reference}, more than --energy-limit {limit:g}: "
        f"reduce {remedy}."
    ]


def water(summary: Mapping[str, Any]) -> list[str]:
    """Water that nothing depends on, and bridges that are too large."""
    p = summary["parameters"]
    lines = []
    if p["moisture"] > 0 and not p["moisture_factor"] and p["bridges"] == "none":
        lines.append(
            "Water is present but nothing in this run depends on it: give --moisture-factor or leave --bridges on."
        )
    share = summary.get("water", {}).get("share_beyond_pendular", 0.0)
    if share > 0:
        lines.append(
            f"{100 * share:.0f} % of the liquid bridges are so large that neighbours would merge (beyond the pendular "
            "regime): the forces are those of separate bridges of the same volume."
        )
    return lines


def interruption(summary: Mapping[str, Any]) -> list[str]:
    """A run that can be continued."""
    if not summary["interrupted"]:
        return []
    return ["The run was interrupted: continue with --resume FOLDER."]


def print_end(summary: Mapping[str, Any]) -> None:
    """Print the last lines of a summary: wall time, effects, the dearest parts, notes."""
    dearest = sorted(summary["price"].items(), key=lambda item: -item[1])[:4]
    print(f"  {'wall':28s} {summary['wall_seconds']:.1f} s")
    print(f"  {'effects':28s} " + "; ".join(summary["effects"]))
    print(f"  {'price':28s} " + ", ".join(f"{name} {seconds:.1f} s" for name, seconds in dearest))
    for note in summary["notes"]:
        print(f"  note: {note}")

# SPDX-License-Identifier: GPL-2.0-or-later
"""Which effects run in the scene in hand, and why."""
from __future__ import annotations

from typing import Any

import yade.wrapper
from yade import O

from grainfall.materials import contact_functors

#: Engines that are effects of their own, in words.
ENGINES = {
    "HertzTimeStepper": "adaptive time step",
    "EnergyLedger": "energy ledger",
}


def contact_law() -> Any | None:
    """The contact law of the scene in hand; None where there is none of ours."""
    for _, laws in contact_functors():
        for law in laws:
            if isinstance(law, yade.wrapper.Law2_ScGeom_GrainPhys_HertzMindlin):
                return law
    return None


def running_effects() -> dict[str, str]:
    """Effects of the contact law, and those that are engines or bodies of their own.

    Returns
    -------
    dict
        {effect: why it runs}; what is off is not in it.
    """
    law = contact_law()
    effects = dict(law.effects) if law is not None else {}
    for engine in O.engines:
        name = ENGINES.get(engine.__class__.__name__)
        if name is not None and not engine.dead:
            effects[name] = engine.label or engine.__class__.__name__
    projectiles = [
        str(body.id) for body in O.bodies if isinstance(body.shape, yade.wrapper.SolidOfRevolution)
    ]
    if projectiles:
        effects["projectile"] = "body " + ", ".join(projectiles)
    return effects


def print_effects() -> None:
    """Print what runs and why, a line each."""
    effects = running_effects()
    width = max(map(len, effects), default=0)
    print("effects:")
    for effect, reason in effects.items():
        print(f"  {effect:{width}s}  {reason}")

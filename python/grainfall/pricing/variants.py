# SPDX-License-Identifier: GPL-2.0-or-later
"""The effects of the scene in hand, and how to turn each of them off (or on) in a copy of it."""
from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
import yade.wrapper as w
from yade import O

from grainfall.effects import contact_law
from grainfall.materials import contact_functors

#: Dynamic viscosity of water at 20 C [Pa s].
WATER_VISCOSITY = 1.0e-3


@dataclass(frozen=True)
class Variant:
    """One effect turned round: off where the scene has it, on where it has not."""

    effect: str
    on: bool
    instead: str
    #: Changes the scene in hand, which is a copy.
    apply: Callable[[], None]
    #: May states be compared step by step?
    comparable: bool = True


def makers() -> list[Any]:
    """Functors of ours that make contacts in the scene in hand."""
    found = [f for functors, _ in contact_functors() for f in functors]
    return [f for f in found if isinstance(f, w.Ip2_GrainMat_GrainMat_GrainPhys)]


def materials() -> list[Any]:
    """Materials of ours in the scene in hand."""
    return [m for m in O.materials if isinstance(m, w.GrainMat)]


def pairs() -> list[Any]:
    """Explicit pairs of materials of the scene in hand."""
    return [pair for maker in makers() for pair in maker.pairs]


def renew() -> None:
    """Let the contacts there are follow their materials."""
    for maker in makers()[:1]:
        maker.renewContacts()


def variants(ledger_period: int) -> list[Variant]:
    """Every effect of the scene in hand, and those that it could have without further parameters."""
    groups = (_tangential(), _friction(), _water(), _damping(), _energy(ledger_period), _engines())
    return [variant for group in groups for variant in group]


def _tangential() -> Iterable[Variant]:
    law = contact_law().tangentialLaw

    def use(name: str) -> Callable[[], None]:
        def apply() -> None:
            contact_law().tangentialLaw = name

        return apply

    if law == "none":
        yield Variant("tangential force", False, "tangentialLaw 'incremental'", use("incremental"))
        return
    yield Variant("tangential force", True, "tangentialLaw 'none'", use("none"))
    partial = law == "mindlin-deresiewicz"
    other = "incremental" if partial else "mindlin-deresiewicz"
    yield Variant("partial slip", partial, f"tangentialLaw '{other}'", use(other))


def _friction() -> Iterable[Variant]:
    bearers = [b for b in (*materials(), *pairs()) if b.friction is not None]
    frictional = contact_law().tangentialLaw != "none"
    moisture = max((m.gravimetricMoisture for m in materials()), default=0.0)
    loads = any(b.friction.dependsOnLoad for b in bearers)
    if frictional and loads:
        load = _mean_load()

        def constant() -> None:
            for bearer in (*materials(), *pairs()):
                if bearer.friction is not None:
                    bearer.friction = bearer.friction.coefficient(load, moisture)
            renew()

        text = f"constant friction, that at {load:.2g} N"
        yield Variant("load-dependent friction", True, text, constant)
    if frictional and moisture > 0 and any(b.friction.dependsOnMoisture for b in bearers):
        yield Variant("moisture in friction", True, "friction of dry grains", _dry_friction)
    bridges = any(m.hasBridges for m in materials())
    if any(m.referenceRadius > 0 for m in materials()) and (bridges or (frictional and loads)):
        yield Variant("load scaling", True, "referenceRadius 0", _set("referenceRadius", 0.0))


def _mean_load() -> float:
    """Mean normal force at which the curves of the contacts are read [N]; 1 where there are none."""
    loads = [
        i.phys.normalForce.norm() / i.phys.loadScale
        for i in O.interactions
        if isinstance(i.phys, w.GrainPhys) and i.phys.normalForce.norm() > 0
    ]
    return float(np.mean(loads)) if loads else 1.0


def _dry_friction() -> None:
    for bearer in (*materials(), *pairs()):
        curve = bearer.friction
        if curve is None or not curve.dependsOnMoisture:
            continue
        curve.moistureFactor = None
        if isinstance(curve, w.TableFriction):
            mu = [curve.coefficient(load, 0.0) for load in curve.loads]
            bearer.friction = w.TableFriction(loads=curve.loads, moistures=[0.0], mu=mu)
    renew()


def _set(attribute: str, value: Any) -> Callable[[], None]:
    """Give an attribute of all materials this value."""

    def apply() -> None:
        for material in materials():
            setattr(material, attribute, value)
        renew()

    return apply


def _water() -> Iterable[Variant]:
    wet = [m for m in materials() if m.hasBridges]
    if not wet:
        return
    yield Variant("liquid bridges", True, "bridgeModel 'none'", _set("bridgeModel", "none"))
    film = any(m.liquidViscosity > 0 for m in wet)
    value = 0.0 if film else WATER_VISCOSITY
    text = f"liquidViscosity {value:g} Pa s"
    yield Variant("viscous film", film, text, _set("liquidViscosity", value))


def _damping() -> Iterable[Variant]:
    def elastic() -> None:
        for bearer in (*materials(), *pairs()):
            bearer.restitution = 1.0
        renew()

    if any(b.restitution < 1 for b in (*materials(), *pairs())):
        yield Variant("viscous damping", True, "restitution 1", elastic)


def remove_engines(*classes: str) -> None:
    """Take all engines of these classes out of the scene in hand."""
    O.engines = [e for e in O.engines if e.__class__.__name__ not in classes]


def add_ledger(period: int) -> None:
    """The energy ledger that the scene had, with empty books."""
    O.engines = [*O.engines, w.EnergyLedger(iterPeriod=period)]


def _energy(ledger_period: int) -> Iterable[Variant]:
    def without_booking() -> None:
        remove_engines("EnergyLedger")
        O.trackEnergy = False

    def with_booking() -> None:
        O.trackEnergy = True

    if ledger_period:
        yield Variant(
            "energy ledger", True, "no EnergyLedger", lambda: remove_engines("EnergyLedger")
        )
    booking = bool(O.trackEnergy or ledger_period)
    text = f"O.trackEnergy {not booking}"
    yield Variant("energy booking", booking, text, without_booking if booking else with_booking)


def _engines() -> Iterable[Variant]:
    steppers = [e for e in O.engines if isinstance(e, w.HertzTimeStepper) and not e.dead]
    stepper = steppers[0] if steppers else w.HertzTimeStepper()
    attributes = {
        name: getattr(stepper, name)
        for name in ("safety", "equation", "maxApproach", "maxGrowth", "deadBand", "minStep")
        + ("maxStep", "correctVelocity", "timeStepUpdateInterval")
    }

    def with_stepper() -> None:
        at = 1 + max(i for i, e in enumerate(O.engines) if hasattr(e, "lawDispatcher"))
        engines = list(O.engines)
        O.engines = [*engines[:at], w.HertzTimeStepper(**attributes), *engines[at:]]

    # The copies run with a fixed step, else their states belong to different times.
    yield Variant("adaptive time step", bool(steppers), "fixed step", with_stepper, False)

    def without_projectile() -> None:
        remove_engines("ProjectileLoad")
        for body in projectiles():
            O.bodies.erase(body)

    if projectiles():
        yield Variant("projectile", True, "no projectile", without_projectile)


def projectiles() -> list[int]:
    """Bodies that are solids of revolution."""
    return [body.id for body in O.bodies if isinstance(body.shape, w.SolidOfRevolution)]

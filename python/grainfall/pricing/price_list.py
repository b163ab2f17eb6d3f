# SPDX-License-Identifier: GPL-2.0-or-later
"""The result of pricing a scene."""
from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True)
class EffectPrice:
    """One effect: what it costs, and what it changes in the steps that were run.

    ``change_*`` compare the run with the effect to the run without it, at the same step; None where that says
    nothing.
    """

    effect: str
    #: Does it act in the scene as it is?
    on: bool
    #: What stands in its place where it is off (or, for one that is off, what was turned on).
    instead: str
    step_with_us: float
    step_without_us: float
    #: Median over the rounds of time with / time without, less one, and its quartiles.
    price: float
    price_quartiles: tuple[float, float]
    nanoseconds_per_contact: float
    #: Largest distance between a body's places in the two runs [m].
    change_position_m: float | None
    #: Relative change of the sum of the normal forces in the contacts [-].
    change_contact_force: float | None
    #: Change of the kinetic energy [J], and of the energy in the springs of the contacts.
    change_kinetic_J: float | None
    change_stored_J: float | None


@dataclass(frozen=True)
class PriceList:
    """Prices of the effects of a scene, and how they were measured."""

    effects: tuple[EffectPrice, ...]
    bodies: int
    contacts: int
    steps: int
    rounds: int
    threads: int
    #: What was measured: processor time (one thread) or wall time of the engines.
    clock: str
    #: Kinetic energy and energy in the springs of the contacts at the end of the run of the scene as it is [J].
    kinetic_J: float
    stored_J: float
    #: Engines that were left out of the runs.
    stood_still: tuple[str, ...] = ()

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> PriceList:
        """From plain values, as `as_dict` gives them."""
        effects = tuple(
            EffectPrice(**{**entry, "price_quartiles": tuple(entry["price_quartiles"])})
            for entry in values["effects"]
        )
        still = tuple(values["stood_still"])
        return cls(**{**values, "effects": effects, "stood_still": still})

    def as_dict(self) -> dict[str, Any]:
        """Plain values, for JSON."""
        return asdict(self)

    def __getitem__(self, effect: str) -> EffectPrice:
        """The price of the effect of this name."""
        for entry in self.effects:
            if entry.effect == effect:
                return entry
        raise KeyError(effect)

    def table(self) -> str:
        """As text, a line for each effect."""
        lines = [
            f"{self.bodies} bodies, {self.contacts} contacts, {self.threads} threads, {self.steps} steps in "
            f"{self.rounds} rounds; {self.clock}",
            f"{'effect':24s}{'now':>4s} {'step with':>10s} {'without':>10s} {'price (quartiles)':>22s}"
            f"{'ns/contact':>11s} {'moved':>9s} {'forces':>8s} {'kinetic':>8s} {'stored':>8s}  off means",
        ]
        lines += [self._line(entry) for entry in self.effects]
        if self.stood_still:
            lines.append("left out: " + ", ".join(self.stood_still))
        return "\n".join(lines)

    def _line(self, e: EffectPrice) -> str:
        low, high = e.price_quartiles
        quartiles = f"({100 * low:+.1f} to {100 * high:+.1f})"
        return (
            f"{e.effect:24s}{'on' if e.on else 'off':>4s} {e.step_with_us:7.1f} us {e.step_without_us:7.1f} us "
            f"{100 * e.price:+6.1f}% {quartiles:>14s}{e.nanoseconds_per_contact:11.0f} "
            f"{_length(e.change_position_m)} {_share(e.change_contact_force)} "
            f"{_share(_relative(e.change_kinetic_J, self.kinetic_J))} "
            f"{_share(_relative(e.change_stored_J, self.stored_J))}  {e.instead}"
        )


def _relative(change: float | None, whole: float) -> float | None:
    return change / whole if change is not None and whole > 0 else None


def _share(value: float | None) -> str:
    """A relative change in percent, 8 characters."""
    return f"{100 * value:+7.2g}%" if value is not None else f"{'-':>8s}"


def _length(value: float | None) -> str:
    """A length, 9 characters."""
    return f"{value:7.1e} m" if value is not None else f"{'-':>9s}"

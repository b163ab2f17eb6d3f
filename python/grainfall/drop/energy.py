# SPDX-License-Identifier: GPL-2.0-or-later
"""Energy balance of a drop, from what YADE and the contact law book.

Everything is taken at the same instant, the positions x_n of step n: the kinetic energy is the mean of
those before and after the step (leapfrog knows velocities only half-way between), the elastic energy is
that of the overlaps at x_n, and the dissipated energies run up to x_n.
"""
from __future__ import annotations

from yade import O, utils

from grainfall.recording import Table

ENERGY_COLUMNS = (
    "time_s",
    "kinetic_J",
    "potential_J",
    "elastic_normal_J",
    "elastic_shear_J",
    "friction_J",
    "viscous_J",
    "rescaling_J",
    "residual_J",
)


class EnergyBook:
    """Rows of the energy balance of the whole scene.

    Attributes
    ----------
    table : Table
        Columns `ENERGY_COLUMNS`; the residual is the sum of the others less the sum of the first row.
    """

    def __init__(self) -> None:
        self.table = Table(ENERGY_COLUMNS)
        self.connect()

    def connect(self) -> None:
        """Find the contact law in the present scene; to be repeated after O.load."""
        loop = next(e for e in O.engines if e.label == "contacts")
        self._law = loop.lawDispatcher.functors[0]

    def sample(self) -> None:
        """Add a row; called at the end of a step, before O.iter is raised."""
        booked = dict(O.energy.items())
        elastic = self._law.elasticEnergy()
        parts = (
            0.5 * (booked.get("kinetic", 0.0) + utils.kineticEnergy()),
            booked.get("gravWork", 0.0),
            elastic["normal"],
            elastic["shear"],
            booked.get("grainFriction", 0.0),
            booked.get("grainViscous", 0.0),
            booked.get("grainRescaling", 0.0),
        )
        total = sum(parts)
        start = sum(self.table.array()[0, 1:-1]) if len(self.table) else total
        self.table.append((O.iter * O.dt, *parts, total - start))


def relative_residual(table: Table) -> float:
    """Largest residual over the energy in play.

    In play are the kinetic energy at the start and what gravity added until the end [J].
    """
    if len(table) < 2:
        return 0.0
    in_play = table["kinetic_J"][0] + abs(table["potential_J"][-1] - table["potential_J"][0])
    return float(abs(table["residual_J"]).max() / in_play)

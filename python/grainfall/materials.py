# SPDX-License-Identifier: GPL-2.0-or-later
"""Material presets: quartz sand, the report's Table 1 grains, the printed projectile.

Every number carries its source. The functions return keyword arguments or friction curves, so a
script may change any of them before it makes the material::

    O.materials.append(GrainMat(**grainfall.quartz_sand(), label="sand"))
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

#: Volume of a bridge over the cube of the grain's radius above which bridges of three touching grains meet:
#: half filling angle of 30 degrees, by the Young-Laplace equation at perfect wetting.
PENDULAR_LIMIT = 0.0577

#: The two points that MR-2629 (section 2.2.2) quotes from Cole (2015): load [N], coefficient [-].
COLE_POINTS: tuple[tuple[float, float], tuple[float, float]] = ((1.0, 0.8), (20.0, 0.2))


def cole_friction(form: str = "power-law") -> Any:
    """Friction that falls from 0.8 at 1 N to 0.2 at 20 N (Cole 2015, as MR-2629 quotes him).

    Independent tests on quartz between 0.5 and 15 N found little or no such fall (Senetakis, Coop &
    Todisco 2013): run a constant-friction control beside it.

    Parameters
    ----------
    form : {'power-law', 'exponential', 'table'}
        How the two points are joined. Outside 1 N to 20 N the power law and the table stay constant;
        the exponential goes on to its limits.

    Returns
    -------
    FrictionCurve

    Raises
    ------
    ValueError
        If the form is unknown.
    """
    from yade import wrapper

    (low_load, low_mu), (high_load, high_mu) = COLE_POINTS
    if form == "power-law":
        exponent = math.log(low_mu / high_mu) / math.log(high_load / low_load)
        return wrapper.PowerLawFriction(
            muRef=low_mu, loadRef=low_load, exponent=exponent, muMin=high_mu, muMax=low_mu
        )
    if form == "exponential":
        load_scale = 5.0
        drop = math.exp(-low_load / load_scale) - math.exp(-high_load / load_scale)
        fall = (low_mu - high_mu) / drop
        mu_inf = low_mu - fall * math.exp(-low_load / load_scale)
        return wrapper.ExponentialFriction(mu0=mu_inf + fall, muInf=mu_inf, loadScale=load_scale)
    if form == "table":
        return wrapper.TableFriction(
            loads=[low_load, high_load], moistures=[0.0], mu=[low_mu, high_mu]
        )
    raise ValueError(f"form = {form!r}: must be 'power-law', 'exponential' or 'table'")


def quartz_sand() -> dict[str, Any]:
    """Quartz grains: keyword arguments of GrainMat.

    Young's modulus 70 GPa and Poisson's ratio 0.2 (shear modulus 29 GPa) are the usual choice for
    quartz in discrete element work; density 2650 kg/m3; restitution 0.9.

    Returns
    -------
    dict
        young [Pa], poisson [-], density [kg/m3], restitution [-].
    """
    return dict(young=70e9, poisson=0.2, density=2650.0, restitution=0.9)


def table1_grains() -> dict[str, Any]:
    """Grains of MR-2629, Table 1: keyword arguments of GrainMat.

    1.0 g at 5 mm is 15.3 g/cm3, twice the density of steel: as printed. The shear modulus of 1e9 Pa
    and Poisson's ratio of 0.4 give Young's modulus 2 G (1 + nu) = 2.8e9 Pa.

    Returns
    -------
    dict
        young [Pa], poisson [-], density [kg/m3].
    """
    shear_modulus, poisson = 1e9, 0.4
    density = 1.0e-3 / (math.pi / 6 * 5e-3**3)
    return dict(young=2 * shear_modulus * (1 + poisson), poisson=poisson, density=density)


def check_scene() -> list[str]:
    """Look for what no single object can see: mistakes between the parts of the scene in hand.

    Returns
    -------
    list of str
        Warnings, one sentence each: effects that were asked for but cannot act, such as a friction
        curve that depends on moisture in a scene without water. Without this call they are logged when the first
        contact is made.

    Raises
    ------
    ValueError
        A pair names a material label that no material of the scene bears.
    """
    from yade import O, wrapper

    labels = {m.label for m in O.materials if isinstance(m, wrapper.GrainMat)}
    warnings: dict[str, None] = {}
    for makers, laws in contact_functors():
        law = next(
            (f for f in laws if isinstance(f, wrapper.Law2_ScGeom_GrainPhys_HertzMindlin)), None
        )
        for maker in makers:
            if isinstance(maker, wrapper.Ip2_GrainMat_GrainMat_GrainPhys):
                _check_pairs(maker, labels)
                warnings.update(dict.fromkeys(maker.idleEffects(law)))
    return list(warnings)


def contact_functors() -> Iterator[tuple[list[Any], list[Any]]]:
    """The functors that make contacts, and those that act in them, of each interaction loop of the scene."""
    from yade import O

    for engine in O.engines:
        if hasattr(engine, "physDispatcher") and hasattr(engine, "lawDispatcher"):
            yield engine.physDispatcher.functors, engine.lawDispatcher.functors


def _check_pairs(functor: Any, labels: set[str]) -> None:
    """Raise ValueError for a pair whose label no material bears."""
    for pair in functor.pairs:
        for attribute, label in (("first", pair.first), ("second", pair.second)):
            if label not in labels:
                known = ", ".join(sorted(repr(name) for name in labels if name)) or "none"
                raise ValueError(
                    f"GrainPair.{attribute} = {label!r}: must be the label of a GrainMat in "
                    f"O.materials ({known})"
                )

# SPDX-License-Identifier: GPL-2.0-or-later
"""From a sand's parameters to YADE's materials and engines, and the text form of friction curves."""
from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import yade.wrapper

# Words for curves on a command line: class, and the names of its parameters.
CURVES = {
    "constant": ("ConstantFriction", ("mu",)),
    "power-law": ("PowerLawFriction", ("muRef", "loadRef", "exponent", "muMin", "muMax")),
    "exponential": ("ExponentialFriction", ("mu0", "muInf", "loadScale")),
    "asperity": ("AsperityFriction", ("alpha", "c", "muMax", "muMin")),
}


@dataclass(frozen=True)
class Sand:
    """What the contacts of a sand are made of.

    Parameters
    ----------
    density : float
        Of a grain [kg/m3].
    young, poisson : float
        Elastic constants of a grain [Pa], [-].
    restitution : float
        Coefficient of restitution [-].
    friction : str
        Curve as `friction_curve` reads it.
    moisture : float
        Gravimetric water content [kg/kg].
    moisture_factor : str
        Factor on friction by moisture as `moisture_factor` reads it; '' for none.
    reference_diameter : float
        Diameter of the real grain [m]; 0 where a grain stands for itself.
    normal_law, tangential_law : str
        Attributes of the contact law.
    bridges : str
        Force of liquid bridges where there is moisture: 'willett', 'willett-closed' or 'none'.
    bridges_per_grain : float
        Number of bridges among which a grain shares its water [-].
    surface_tension, contact_angle, liquid_viscosity : float
        Of the liquid [N/m], [rad], [Pa s].
    """

    density: float
    young: float
    poisson: float
    restitution: float
    friction: str
    moisture: float
    moisture_factor: str
    reference_diameter: float
    normal_law: str
    tangential_law: str
    bridges: str = "willett"
    bridges_per_grain: float = 6.0
    surface_tension: float = 0.0728
    contact_angle: float = 0.0
    liquid_viscosity: float = 0.0

    def material(self, label: str, **changes: Any) -> Any:
        """GrainMat of these parameters; `changes` are attributes of GrainMat that differ."""
        attributes = {
            "young": self.young,
            "poisson": self.poisson,
            "density": self.density,
            "restitution": self.restitution,
            "gravimetricMoisture": self.moisture,
            "referenceRadius": self.reference_diameter / 2,
            "friction": friction_curve(self.friction, self.moisture_factor),
            "bridgeModel": self.bridges,
            "bridgesPerGrain": self.bridges_per_grain,
            "surfaceTension": self.surface_tension,
            "contactAngle": self.contact_angle,
            "liquidViscosity": self.liquid_viscosity,
            "label": label,
        }
        attributes.update(changes)
        return yade.wrapper.GrainMat(**attributes)

    @classmethod
    def of(cls, parameters: Mapping[str, Any]) -> Sand:
        """The sand that a scenario's parameters (`grainfall.sand_options`) describe."""
        p = parameters
        return cls(
            density=p["grain_density"],
            young=p["young"],
            poisson=p["poisson"],
            restitution=p["restitution"],
            friction=p["friction"],
            moisture=p["moisture"],
            moisture_factor=p["moisture_factor"],
            reference_diameter=p["reference_diameter"],
            normal_law=p["normal_law"],
            tangential_law=p["tangential_law"],
            bridges=p["bridges"],
            bridges_per_grain=p["bridges_per_grain"],
            surface_tension=p["surface_tension"],
            contact_angle=p["contact_angle"],
            liquid_viscosity=p["liquid_viscosity"],
        )

    def as_dict(self) -> dict[str, Any]:
        """Plain values, for hashing and saving."""
        return asdict(self)


def friction_curve(text: str, moisture_text: str = "") -> Any:
    """Friction curve written as a number, as 'cole', or as CURVE:NAME=VALUE,...

    Parameters
    ----------
    text : str
        For example '0.5', 'cole', 'exponential:mu0=0.8,muInf=0.2,loadScale=5'.
    moisture_text : str
        Factor by moisture, see `moisture_factor`.

    Returns
    -------
    FrictionCurve
    """
    curve = _curve(text)
    if moisture_text:
        curve.moistureFactor = moisture_factor(moisture_text)
    return curve


def _curve(text: str) -> Any:
    word, _, rest = text.strip().partition(":")
    if word == "cole" and not rest:
        from grainfall.materials import cole_friction

        return cole_friction()
    if not rest and _number(word) is not None:
        return yade.wrapper.ConstantFriction(mu=_number(word))
    if word not in CURVES:
        raise ValueError(
            f"--friction = {text!r}: must be a number, 'cole', or one of "
            f"{', '.join(CURVES)} followed by :NAME=VALUE,..."
        )
    class_name, names = CURVES[word]
    parameters = {}
    for item in filter(None, rest.split(",")):
        name, _, value = item.partition("=")
        if name not in names or _number(value) is None:
            raise ValueError(
                f"--friction = {text!r}: {item!r} must be NAME=NUMBER with NAME one of "
                f"{', '.join(names)}"
            )
        parameters[name] = _number(value)
    return getattr(yade.wrapper, class_name)(**parameters)


def moisture_factor(text: str) -> Any:
    """MoistureFactor written as MOISTURE:FACTOR,... , for example '0:1,0.023:0.9'."""
    moistures, factors = [], []
    for item in text.split(","):
        moisture, _, factor = item.partition(":")
        if _number(moisture) is None or _number(factor) is None:
            raise ValueError(
                f"--moisture-factor = {text!r}: {item!r} must be MOISTURE:FACTOR, two numbers"
            )
        moistures.append(_number(moisture))
        factors.append(_number(factor))
    return yade.wrapper.MoistureFactor(moistures=moistures, factors=factors)


def _number(text: str) -> float | None:
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


#: Words for the two ways that contacts and motion of the grains can run.
PATHS = ("flat", "general")


def contact_loop(
    sand: Sand,
    pairs: list[Any],
    geometry: list[Any],
    path: str = "flat",
    blind: Sequence[str] = (),
    laws: Sequence[Any] = (),
) -> Any:
    """Interaction loop of our law for spheres, walls and whatever `geometry` adds.

    Parameters
    ----------
    pairs : list of GrainPair
        Friction and restitution of named pairs of materials.
    geometry : list of IGeomFunctor
        Functors beside sphere-sphere and wall-sphere.
    path : str
        'flat': GrainInteractionLoop, in packed arrays; 'general': YADE's own InteractionLoop.
    blind : sequence of str
        Labels of engines that look at no grain: the flat path publishes nothing for them.
    laws : sequence of LawFunctor
        For geometries that `geometry` makes beside ScGeom.
    """
    w = yade.wrapper
    functors = (
        [w.Ig2_Sphere_Sphere_ScGeom(), w.Ig2_Wall_Sphere_ScGeom(hertzian=True), *geometry],
        [w.Ip2_GrainMat_GrainMat_GrainPhys(pairs=pairs, label="contact_maker")],
        [
            w.Law2_ScGeom_GrainPhys_HertzMindlin(
                normalLaw=sand.normal_law, tangentialLaw=sand.tangential_law, label="contact_law"
            ),
            *laws,
        ],
    )
    if path == "general":
        return w.InteractionLoop(*functors, label="contacts")
    return w.GrainInteractionLoop(*functors, blindEngines=list(blind), label="contacts")


def integrator(path: str = "flat", **attributes: Any) -> Any:
    """Integrator that belongs to `contact_loop` of the same path; attributes of NewtonIntegrator."""
    w = yade.wrapper
    kind = w.NewtonIntegrator if path == "general" else w.GrainIntegrator
    return kind(**attributes)


def rayleigh_step(radius: float, density: float, young: float, poisson: float) -> float:
    """Time a Rayleigh wave takes around half a sphere [s].

    pi R sqrt(rho / G) / (0.1631 nu + 0.8766), the usual measure of the critical step of a bed of spheres.
    """
    shear_modulus = young / (2 * (1 + poisson))
    return math.pi * radius * math.sqrt(density / shear_modulus) / (0.1631 * poisson + 0.8766)

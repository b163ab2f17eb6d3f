# SPDX-License-Identifier: GPL-2.0-or-later
"""A calibration as a scenario: options in, ``calibration.json`` out."""
from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from grainfall.calibrate.fit import STEP, Calibration, Parameter, calibrate
from grainfall.calibrate.spectra import read_spectra
from grainfall.calibrate.triaxial_model import CURVE, FACTOR, triaxial_model
from grainfall.options import Option, OptionError, OptionTable
from grainfall.triaxial.parameters import TABLE as TRIAXIAL

OWN = (
    Option("measured", "", "table of measured k and b", kind=str),
    Option(
        "fit",
        "friction=0.5:0.05:1.5",
        "parameters to estimate, as NAME=START:LOW:HIGH,... with NAME friction, mu0, muInf, loadScale, "
        "moisture_factor@W, or a numeric option such as restitution or young",
        kind=str,
    ),
    Option("fix", "", "parameters held at a value, as NAME=VALUE,...", kind=str),
    Option("step", STEP, "step of the logarithms for derivatives", "-", low=1e-4, high=1),
    Option("most_steps", 12, "most steps of the optimiser", kind=int, low=1, high=1000),
)
#: Options of the triaxial test that the calibration sets itself.
TAKEN = ("output", "resume", "frequencies", "moisture", "no_plots", "quiet")
TABLE = OptionTable(
    {
        "calibration": (
            *OWN,
            Option("output", "results/calibration", "folder for results", kind=str),
            Option("quiet", False, "print nothing", kind=bool),
        ),
        **{
            title: [option for option in options if option.name not in TAKEN]
            for title, options in TRIAXIAL.groups.items()
        },
    },
    TRIAXIAL.presets,
    prog="calibrate_friction.py",
)


def calibrate_friction(**given: Any) -> Calibration:
    """Fit the triaxial test to a table of measured k and b; see ``scenarios/calibrate_friction.py --help``.

    Parameters
    ----------
    **given
        ``measured``, ``fit``, ``fix``, ``step``, ``most_steps``, ``output``, and options of the triaxial test.

    Returns
    -------
    Calibration
        Also written to ``calibration.json`` in the output folder.

    Raises
    ------
    OptionError, SpectraError
        An option or the measured table cannot be used; nothing has been run then.
    """
    for name, value in given.items():
        TABLE.check(name, value)
    p = {
        option.name: given.get(option.name, option.default)
        for option in TABLE.groups["calibration"]
    }
    if not p["measured"]:
        raise OptionError("--measured: a table of measured k and b must be given")
    data = read_spectra(p["measured"])
    parameters = read_parameters(str(p["fit"]))
    fixed = {name: _number("--fix", item, text) for name, item, text in _items("--fix", p["fix"])}
    options = {name: value for name, value in given.items() if name not in p}
    TRIAXIAL.resolve(options)
    folder = Path(p["output"])
    model = triaxial_model(folder / "runs", **options)
    found = calibrate(
        model, parameters, data, float(p["step"]), most_steps=int(p["most_steps"]), fixed=fixed
    )
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "calibration.json").write_text(json.dumps(found.as_dict(), indent=1) + "\n")
    if not p["quiet"]:
        print_calibration(found)
    return found


def read_parameters(text: str) -> list[Parameter]:
    """Parameters written as NAME=START:LOW:HIGH,..."""
    parameters = []
    for name, item, values in _items("--fit", text):
        numbers = [_number("--fit", item, value) for value in values.split(":")]
        if len(numbers) != 3:
            raise OptionError(f"--fit = {text!r}: {item!r} must be NAME=START:LOW:HIGH")
        try:
            parameters.append(Parameter(name, *numbers))
        except ValueError as error:
            raise OptionError(f"--fit = {text!r}: {error}") from None
    if not parameters:
        raise OptionError(f"--fit = {text!r}: must name at least one parameter")
    return parameters


def _items(flag: str, text: str) -> list[tuple[str, str, str]]:
    """(name, item, text behind the =) of each item; the names are checked."""
    items = []
    for item in filter(None, (part.strip() for part in text.split(","))):
        name, equals, rest = item.partition("=")
        option = TRIAXIAL.by_name.get(name)
        numeric = option is not None and option.kind is float and name not in TAKEN
        if not equals or not (numeric or name in (*CURVE, "friction") or name.startswith(FACTOR)):
            raise OptionError(
                f"{flag} = {text!r}: {item!r}: must be NAME=..., NAME one of friction, {', '.join(CURVE)}, {FACTOR}W "
                "or a numeric option of the triaxial test"
            )
        items.append((name, item, rest))
    return items


def _number(flag: str, item: str, text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise OptionError(f"{flag}: {item!r}: {text!r} must be a number") from None


def print_calibration(found: Calibration) -> None:
    """Print estimates, their errors, and what the data cannot tell."""
    print(
        f"chi square {found.chi_square:.4g} for {found.degrees_of_freedom} degrees of freedom, "
        f"{found.evaluations} evaluations{'' if found.converged else ', not converged'}"
    )
    for name, value in found.values.items():
        note = " (at its bound)" if name in found.at_bound else ""
        print(f"  {name:24s} {value:.4g}  +- {100 * found.relative_errors[name]:.2g} %{note}")
    for line in found.unseen:
        print(f"  not determined: {line}")

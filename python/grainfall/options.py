# SPDX-License-Identifier: GPL-2.0-or-later
"""Every parameter of a scenario: name, unit, default, allowed range, and how it is read from a command line.

One table serves the command line (``--grain-diameter``), the function (``grain_diameter=``) and the columns
of a ``yade-batch`` table, so that the three cannot drift apart.
"""
from __future__ import annotations

import argparse
import difflib
import json
import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any


class OptionError(ValueError):
    """A parameter that cannot be used; the message names it, its value and what is allowed."""


@dataclass(frozen=True)
class Option:
    """One parameter.

    Parameters
    ----------
    name : str
        Python keyword and table column; with dashes for underscores it is the command-line option.
    default : object
        Value where neither the user nor the preset says otherwise.
    help : str
        One sentence; the unit is appended in brackets.
    unit : str
        SI unit as written for the user, '' for none.
    kind : type
        float, int, str or bool.
    low, high : float
        Allowed range, ends included unless `open_low`.
    choices : tuple of str
        Allowed words; empty for any.
    runtime : bool
        May be changed when a run is resumed: it has no influence on the trajectory already computed.
    """

    name: str
    default: Any
    help: str
    unit: str = ""
    kind: type = float
    low: float = -math.inf
    high: float = math.inf
    open_low: bool = False
    choices: tuple[str, ...] = ()
    runtime: bool = False

    @property
    def flag(self) -> str:
        """Name on the command line."""
        return "--" + self.name.replace("_", "-")

    @property
    def allowed(self) -> str:
        """The allowed values in words."""
        if self.choices:
            return "one of " + ", ".join(self.choices)
        if self.kind is bool:
            return "true or false"
        if self.kind is str:
            return "a text"
        number = "a whole number" if self.kind is int else "a number"
        unit = f" {self.unit}" if self.unit else ""
        if math.isinf(self.low) and math.isinf(self.high):
            return number + (f" in{unit}" if unit else "")
        if math.isinf(self.high):
            return f"{number} {'above' if self.open_low else 'of at least'} {self.low:g}{unit}"
        left = "(" if self.open_low else "["
        return f"{number} in {left}{self.low:g}, {self.high:g}]{unit}"

    def check(self, value: Any) -> Any:
        """Return `value` as this option's kind or raise `OptionError`."""
        if value is None and self.default is None:
            return None
        converted = self._convert(value)
        if self.choices and converted not in self.choices:
            near = difflib.get_close_matches(str(converted), self.choices, n=1)
            hint = f" (did you mean {near[0]}?)" if near else ""
            raise OptionError(f"{self.flag} = {value!r}: must be {self.allowed}{hint}")
        if self.kind in (int, float):
            too_low = converted <= self.low if self.open_low else converted < self.low
            if too_low or converted > self.high or not math.isfinite(converted):
                raise OptionError(f"{self.flag} = {value!r}: must be {self.allowed}")
        return converted

    def _convert(self, value: Any) -> Any:
        try:
            if self.kind is bool:
                return _to_bool(value)
            if self.kind is str:
                return str(value)
            if isinstance(value, bool):
                raise ValueError
            number = float(value)
            if self.kind is int:
                if number != int(number):
                    raise ValueError
                return int(number)
            return number
        except (TypeError, ValueError, OverflowError):
            raise OptionError(f"{self.flag} = {value!r}: must be {self.allowed}") from None


def _to_bool(value: Any) -> bool:
    words = {"true": True, "yes": True, "1": True, "false": False, "no": False, "0": False}
    word = str(value).lower()
    if word not in words:
        raise ValueError(word)
    return words[word]


class OptionTable:
    """The options of a scenario, in groups, with the presets that change their defaults.

    Parameters
    ----------
    groups : mapping
        Options under the titles of their groups.
    presets : mapping
        Defaults by preset.
    checks : iterable of callables
        Each gets all values and those given; raises `OptionError` for values that do not fit together.
    prog : str
        Name of the scenario's script, for its help.
    """

    def __init__(
        self,
        groups: Mapping[str, Iterable[Option]],
        presets: Mapping[str, Mapping[str, Any]],
        checks: Iterable[Callable[[dict[str, Any], Mapping[str, Any]], None]] = (),
        prog: str = "",
    ) -> None:
        self.groups = {title: tuple(options) for title, options in groups.items()}
        self.presets = presets
        self.checks = tuple(checks)
        self.prog = prog
        self.by_name = {option.name: option for group in self.groups.values() for option in group}

    def check_name(self, name: str) -> None:
        """Raise `OptionError` for an unknown name."""
        if name not in self.by_name:
            near = difflib.get_close_matches(name, self.by_name, n=1)
            hint = f" (did you mean {near[0]}?)" if near else ""
            raise OptionError(f"unknown parameter {name!r}{hint}")

    def check(self, name: str, value: Any) -> Any:
        """The checked value of one parameter; raises `OptionError` also for an unknown name."""
        self.check_name(name)
        return self.by_name[name].check(value)

    def parser(self, description: str, epilog: str) -> argparse.ArgumentParser:
        """Command-line parser; values are left as text for `resolve` to check."""
        parser = argparse.ArgumentParser(
            prog=self.prog or None,
            description=description,
            epilog=epilog,
            formatter_class=argparse.RawDescriptionHelpFormatter,
            allow_abbrev=False,
            argument_default=argparse.SUPPRESS,
        )
        for title, options in self.groups.items():
            group = parser.add_argument_group(title)
            for option in options:
                self._add(group, option)
        return parser

    def _add(self, group: Any, option: Option) -> None:
        unit = f" [{option.unit}]" if option.unit else ""
        by_preset = any(option.name in values for values in self.presets.values())
        shown = option.default
        if option.kind is bool:
            default = ""
        elif by_preset:
            default = " (default: by preset)"
        else:
            default = "" if shown in (None, "") else f" (default: {shown})"
        text = (option.help + unit + default).replace("%", "%%")
        if option.kind is bool:
            group.add_argument(option.flag, dest=option.name, action="store_true", help=text)
        else:
            metavar = "|".join(option.choices) or option.kind.__name__.upper()
            group.add_argument(option.flag, dest=option.name, metavar=metavar, help=text)

    def resolve(
        self,
        given: Mapping[str, Any],
        overlays: Iterable[Callable[[dict[str, Any]], Mapping[str, Any]]] = (),
    ) -> dict[str, Any]:
        """All parameters: what is given, over what its preset says, over the defaults; each checked.

        Parameters
        ----------
        given : mapping
            Parameters that the user set.
        overlays : iterable of callables
            Each gets the parameters found so far and returns further defaults; the user still wins.
        """
        for name, value in given.items():
            self.check(name, value)
        values = {name: option.default for name, option in self.by_name.items()}
        if "preset" in self.by_name:
            preset = self.by_name["preset"].check(given.get("preset", values["preset"]))
            values.update(self.presets[preset])
        values.update(given)
        for overlay in overlays:
            extra = overlay(values)
            values.update({name: value for name, value in extra.items() if name not in given})
        values = {name: self.by_name[name].check(value) for name, value in values.items()}
        for check in self.checks:
            check(values, given)
        return values


def resumed(
    table: OptionTable, given: Mapping[str, Any], state: str, parameters: str
) -> tuple[Path, dict[str, Any]]:
    """Folder and parameters of the interrupted run that ``given["resume"]`` names.

    Parameters
    ----------
    state, parameters : str
        Files of that folder: the scene to go on from, and the parameters of the run.

    Raises
    ------
    OptionError
        There is nothing to resume, or a parameter is given that only a new run can have.
    """
    folder = Path(given["resume"])
    if not (folder / state).exists():
        raise OptionError(f"--resume = {str(folder)!r}: must be a results folder with a {state}")
    saved = json.loads((folder / parameters).read_text())
    changed = [n for n in given if n in table.by_name and not table.by_name[n].runtime]
    if changed:
        raise OptionError(f"{table.by_name[changed[0]].flag} cannot be changed by a resumed run")
    return folder, table.resolve({**saved, **given, "output": str(folder)})

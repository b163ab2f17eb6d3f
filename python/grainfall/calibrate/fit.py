# SPDX-License-Identifier: GPL-2.0-or-later
"""Least squares for a model that is expensive and not quite smooth, and what the data can say about its parameters.

Parameters are positive and fitted by their logarithms. Derivatives are differences over a step of the logarithm that
is large beside the model's own scatter (0.1: 10 % of the parameter), not the smallest that rounding allows.

With J the matrix of derivatives of the weighted residuals with respect to the logarithms, the covariance of the
estimates is (J^T J)^-1. A parameter is reported as *unseen* where its standard error exceeds `UNSEEN`: the data would
not tell it from one half as large again. The same is said of combinations: a right singular vector of J whose singular
value is below 1/UNSEEN is a direction in which the parameters can be moved without the data noticing.
"""
from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from scipy.optimize import least_squares

from grainfall.calibrate.spectra import Spectra

#: Standard error of a logarithm above which the data do not see the parameter.
UNSEEN = 0.5
#: Step of the logarithm for derivatives.
STEP = 0.1

#: (k, b) by (moisture, frequency), from parameter values and the conditions wanted.
Model = Callable[
    [Mapping[str, float], list[tuple[float, list[float]]]],
    Mapping[tuple[float, float], tuple[float, float]],
]


@dataclass(frozen=True)
class Parameter:
    """One parameter to estimate.

    Parameters
    ----------
    name : str
        As the model knows it.
    start : float
        First guess, > 0.
    low, high : float
        Bounds.
    """

    name: str
    start: float
    low: float
    high: float

    def __post_init__(self) -> None:
        if not 0 < self.low <= self.start <= self.high < math.inf or self.low == self.high:
            raise ValueError(
                f"parameter {self.name!r}: start = {self.start!r} must lie in [low, high] = [{self.low!r}, "
                f"{self.high!r}] with 0 < low < high"
            )


@dataclass(frozen=True)
class Calibration:
    """Outcome of a calibration.

    Parameters
    ----------
    values : dict
        Estimates.
    relative_errors : dict
        Standard errors of their logarithms, infinite where nothing follows from the data.
    unseen : list of str
        Parameters that the data do not determine, and why, one sentence each.
    at_bound : list of str
        Names of parameters that ended at a bound.
    singular_values : list of float
        Of J, largest first.
    directions : list of dict
        The combination of logarithms that belongs to each singular value.
    chi_square, degrees_of_freedom : float, int
        Sum of squared weighted residuals, and residuals less parameters.
    residuals : numpy.ndarray, shape (2 n,)
        Weighted residuals: all k, then all b.
    evaluations : int
        Calls of the model.
    converged : bool
        Did the optimiser end by itself?
    """

    values: dict[str, float]
    relative_errors: dict[str, float]
    unseen: list[str]
    at_bound: list[str]
    singular_values: list[float]
    directions: list[dict[str, float]]
    chi_square: float
    degrees_of_freedom: int
    residuals: np.ndarray = field(repr=False)
    evaluations: int
    converged: bool

    def as_dict(self) -> dict[str, Any]:
        """Plain values for JSON; an error that is infinite becomes None."""
        plain = {k: v for k, v in self.__dict__.items() if k != "residuals"}
        plain["residuals"] = self.residuals.tolist()
        plain["relative_errors"] = {
            name: error if math.isfinite(error) else None
            for name, error in self.relative_errors.items()
        }
        return plain


class _Residuals:
    """Weighted residuals and their derivatives as functions of the logarithms."""

    def __init__(
        self,
        model: Model,
        parameters: Sequence[Parameter],
        data: Spectra,
        step: float,
        fixed: Mapping[str, float],
    ) -> None:
        self.model, self.data, self.step = model, data, step
        self.names = [p.name for p in parameters]
        self.low = np.log([p.low for p in parameters])
        self.high = np.log([p.high for p in parameters])
        self.fixed = dict(fixed)
        self.evaluations = 0

    def __call__(self, logarithms: np.ndarray) -> np.ndarray:
        self.evaluations += 1
        values = {**self.fixed, **dict(zip(self.names, np.exp(logarithms).tolist()))}
        return self.data.residuals(self.model(values, self.data.conditions))

    def jacobian(self, logarithms: np.ndarray) -> np.ndarray:
        """Central differences, one-sided where a bound is near; shape (2 n, p)."""
        columns = []
        for i in range(len(logarithms)):
            ends = []
            for sign in (-1, 1):
                end = logarithms.copy()
                end[i] = np.clip(end[i] + sign * self.step, self.low[i], self.high[i])
                ends.append(end)
            span = ends[1][i] - ends[0][i]
            columns.append((self(ends[1]) - self(ends[0])) / span)
        return np.array(columns).T


def calibrate(
    model: Model,
    parameters: Sequence[Parameter],
    data: Spectra,
    step: float = STEP,
    tolerance: float = 1e-3,
    most_steps: int = 12,
    fixed: Mapping[str, float] | None = None,
) -> Calibration:
    """Estimate the parameters that bring the model closest to the data.

    Parameters
    ----------
    model : callable
        Gets parameter values and the conditions [(moisture, [frequencies in Hz]), ...]; returns (k, b) in [N/m],
        [N s/m] by (moisture, frequency). Wrap expensive ones in `RunCache`.
    parameters : sequence of Parameter
        What to estimate.
    data : Spectra
        What was measured.
    step : float
        Step of the logarithms for derivatives; choose it large beside the model's scatter.
    tolerance : float
        Relative change of the estimates, and of the sum of squares, at which to stop.
    most_steps : int
        Steps of the optimiser, each worth one evaluation and those of a Jacobian.
    fixed : mapping
        Values of further parameters of the model that are not estimated.

    Returns
    -------
    Calibration
    """
    if not parameters:
        raise ValueError("parameters: there must be at least one to estimate")
    residuals = _Residuals(model, parameters, data, step, fixed or {})
    start = np.log([p.start for p in parameters])
    found = least_squares(
        residuals,
        start,
        jac=residuals.jacobian,
        bounds=(residuals.low, residuals.high),
        xtol=tolerance,
        ftol=tolerance,
        max_nfev=most_steps,
    )
    _, singular, right = np.linalg.svd(found.jac, full_matrices=False)
    errors = _errors(singular, right)
    names = residuals.names
    return Calibration(
        values=dict(zip(names, np.exp(found.x).tolist())),
        relative_errors=dict(zip(names, errors)),
        unseen=_unseen(names, errors, singular, right),
        at_bound=[
            name
            for name, x, low, high in zip(names, found.x, residuals.low, residuals.high)
            if min(x - low, high - x) < 1e-3 * (high - low)
        ],
        singular_values=singular.tolist(),
        directions=[dict(zip(names, row.tolist())) for row in right],
        chi_square=float(found.fun @ found.fun),
        degrees_of_freedom=len(found.fun) - len(names),
        residuals=found.fun,
        evaluations=residuals.evaluations,
        converged=found.status > 0,
    )


def _errors(singular: np.ndarray, right: np.ndarray) -> list[float]:
    """Standard errors of the logarithms: roots of the diagonal of (J^T J)^-1."""
    with np.errstate(divide="ignore", invalid="ignore"):
        weights = np.where(right == 0, 0.0, right / singular[:, None])
    return np.sqrt((weights**2).sum(axis=0)).tolist()


def _unseen(
    names: Sequence[str], errors: Sequence[float], singular: np.ndarray, right: np.ndarray
) -> list[str]:
    """What the data do not determine, in words."""
    lines = [
        f"{name}: the data allow a factor of {math.exp(min(error, 50.0)):.3g} either way (standard error)"
        for name, error in zip(names, errors)
        if error > UNSEEN
    ]
    for value, row in zip(singular, right):
        shares = [(name, part) for name, part in zip(names, row) if abs(part) > 0.2]
        if value < 1 / UNSEEN and len(shares) > 1:
            product = " ".join(f"{name}^{part:+.2f}" for name, part in shares)
            lines.append(f"hardly any datum changes along {product}: fix one of them")
    return lines


def profile(
    model: Model,
    parameters: Sequence[Parameter],
    data: Spectra,
    name: str,
    values: Sequence[float],
    **options: Any,
) -> list[tuple[float, float]]:
    """Smallest sum of squares with one parameter held at each of `values`, the others fitted anew.

    Where the profile rises by 1 above its lowest lies the standard error; where it stays flat the data see nothing.

    Returns
    -------
    list of (value, chi square)
    """
    if name not in [p.name for p in parameters]:
        raise ValueError(f"name = {name!r}: must be one of {', '.join(p.name for p in parameters)}")
    rows, others = [], [p for p in parameters if p.name != name]
    for value in values:
        fixed = {**options.get("fixed", {}), name: float(value)}
        rest = {key: option for key, option in options.items() if key != "fixed"}
        if others:
            found = calibrate(model, others, data, fixed=fixed, **rest)
            others = [replace(p, start=found.values[p.name]) for p in others]
            rows.append((float(value), found.chi_square))
        else:
            weighted = data.residuals(model(fixed, data.conditions))
            rows.append((float(value), float(weighted @ weighted)))
    return rows

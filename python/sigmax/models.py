"""Motions along 1, 2 or 3 axes: the models of a bank. States are x, y, z, vx, …, az, in SI units; rates in rad/s."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from . import _sigmax
from ._sigmax import Model

core: Any = _sigmax  # also what its stubs do not declare


def named(make: Callable[..., Any], name: str, doc: str) -> Callable[..., Any]:
    """What makes one of the library's by its name."""
    def call(*arguments: Any, **others: Any) -> Any:
        return make(name, *arguments, **others)
    call.__name__, call.__doc__ = name, doc
    return call


# (axes, sigma=3.0, **others)
dwna = named(core._known_model, "dwna", "Discrete white-noise acceleration: sigma in m/s².")
dwpa = named(core._known_model, "dwpa", "Discrete Wiener-process acceleration: sigma in m/s² per step.")
cwna = named(core._known_model, "cwna", "Continuous white-noise acceleration: sigma = √q in m/s^1.5.")
cwpa = named(core._known_model, "cwpa", "Continuous white-noise jerk: sigma = √q in m/s^2.5.")
singer = named(core._known_model, "singer", "An acceleration: sigma in m/s², correlated over tau_s=10.")
ou_velocity = named(core._known_model, "ou_velocity", "A velocity: sigma in m/s, correlated over tau_s=10.")
ou_position = named(core._known_model, "ou_position", "A position: sigma in m, correlated over tau_s=10.")
known_turn = named(core._known_model, "known_turn", "A turn at turn_deg_s=3, counter-clockwise; sigma as of cwna.")
coordinated_turn = named(core._known_model, "ct", "A turn at an estimated rate, omega, with turn_drift_deg_s=0.2.")


def slopes(f: Callable[..., Any]) -> Callable[..., Any]:
    """The Jacobian of f(x, …) by central differences."""
    def jacobian(x: Any, *others: Any) -> Any:
        steps = 6e-6 * np.maximum(1.0, np.abs(x))
        differences = [np.asarray(f(x + step, *others)) - f(x - step, *others) for step in np.diag(steps)]
        return np.transpose(differences) / (2.0 * steps)
    return jacobian


def linear(F: Any, Q: Any, components: Sequence[str], *, name: str = "linear") -> Model:
    """x = F x + w, (47): F and Q (n, n) for every step alike, or functions of the step, at a few microseconds each."""
    return core._own_model(name, list(components), None, F, Q, "ekf")  # type: ignore[no-any-return]


def motion(f: Callable[..., Any], Q: Any, components: Sequence[str], *, jacobian: Any = None, name: str = "motion",
           member: str = "ekf") -> Model:
    """x = f(x, dt) + w, (21): f returns (n,), jacobian(x, dt) (n, n); Q as of linear; member is "ekf", "ukf" or "ckf".

    Without a Jacobian the EKF calls f 2n times for central differences: some microseconds each, in every mode and step.
    """
    return core._own_model(name, list(components), f, jacobian or slopes(f), Q, member)  # type: ignore[no-any-return]

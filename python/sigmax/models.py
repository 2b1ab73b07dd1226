"""Motions along 1, 2 or 3 axes: the models of a bank. States are x, y, z, vx, …, az, in SI units; rates in rad/s."""

from collections.abc import Callable, Sequence
from typing import Any, Optional

from . import _sigmax
from ._sigmax import Model

_core: Any = _sigmax
_Matrix = Any  # (n, n), or a function of the step in s that returns it


def dwna(axes: int, sigma: float = 3.0) -> Model:
    """Discrete white-noise acceleration: sigma in m/s²."""
    return _core._known_model("dwna", axes, {"sigma_w": sigma})  # type: ignore[no-any-return]


def dwpa(axes: int, sigma: float = 3.0) -> Model:
    """Discrete Wiener-process acceleration: sigma in m/s² per step."""
    return _core._known_model("dwpa", axes, {"sigma_w": sigma})  # type: ignore[no-any-return]


def cwna(axes: int, sigma: float = 3.0) -> Model:
    """Continuous white-noise acceleration: sigma = √q in m/s^1.5."""
    return _core._known_model("cwna", axes, {"sigma_w": sigma})  # type: ignore[no-any-return]


def cwpa(axes: int, sigma: float = 3.0) -> Model:
    """Continuous white-noise jerk: sigma = √q in m/s^2.5."""
    return _core._known_model("cwpa", axes, {"sigma_w": sigma})  # type: ignore[no-any-return]


def singer(axes: int, sigma: float = 3.0, tau: float = 10.0) -> Model:
    """An acceleration of standard deviation sigma in m/s², correlated over tau seconds."""
    return _core._known_model("singer", axes, {"sigma_w": sigma, "tau_s": tau})  # type: ignore[no-any-return]


def ou_velocity(axes: int, sigma: float = 3.0, tau: float = 10.0) -> Model:
    """A velocity of standard deviation sigma in m/s, correlated over tau seconds."""
    return _core._known_model("ou_velocity", axes, {"sigma_w": sigma, "tau_s": tau})  # type: ignore[no-any-return]


def ou_position(axes: int, sigma: float = 3.0, tau: float = 10.0) -> Model:
    """A position of standard deviation sigma in m, correlated over tau seconds."""
    return _core._known_model("ou_position", axes, {"sigma_w": sigma, "tau_s": tau})  # type: ignore[no-any-return]


def known_turn(axes: int, rate_deg_s: float, sigma: float = 3.0) -> Model:
    """A turn at a known rate, counter-clockwise, with noise as of cwna."""
    return _core._known_model("known_turn", axes, {"sigma_w": sigma, "turn_deg_s": rate_deg_s})  # type: ignore[no-any-return]


def coordinated_turn(axes: int, sigma: float = 3.0, drift_deg_s: float = 0.2) -> Model:
    """A turn at a rate that is estimated, omega in rad/s, and changes by drift_deg_s in a second."""
    return _core._known_model("ct", axes, {"sigma_w": sigma, "turn_drift_deg_s": drift_deg_s})  # type: ignore[no-any-return]


def linear(F: _Matrix, Q: _Matrix, components: Sequence[str], *, dt: Optional[float] = None, name: str = "linear") -> Model:
    """x = F x + w, (47): F and Q (n, n) for steps of dt seconds, or without dt for any; or functions of the step.

    A function costs a few microseconds a step. The position leads the components.
    """
    return _core._linear_model(name, list(components), F, Q, dt)  # type: ignore[no-any-return]


def motion(f: Callable[..., Any], Q: _Matrix, components: Sequence[str], *, jacobian: Any = None, name: str = "motion", member: str = "ekf") -> Model:
    """x = f(x, dt) + w, (21): f returns (n,), jacobian(x, dt) (n, n); member is "ekf", "ukf" or "ckf".

    Without a Jacobian the EKF calls f 2n times for central differences: some microseconds each, in every mode and step.
    """
    return _core._own_model(name, list(components), f, Q, jacobian, member)  # type: ignore[no-any-return]

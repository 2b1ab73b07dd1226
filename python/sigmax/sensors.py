"""What measures a state, and from where. A position needs no sensor. Angles are in rad, counter-clockwise from x."""

from collections.abc import Callable, Sequence
from typing import Any

from . import _sigmax
from ._sigmax import Sensor

_core: Any = _sigmax


def polar(axes: int, origin: Sequence[float] = ()) -> Sensor:
    """A radar at origin, in m: range and azimuth, along three axes also the elevation."""
    return _core._placed_sensor("polar", axes, origin)  # type: ignore[no-any-return]


def slant(origin: Sequence[float] = ()) -> Sensor:
    """A radar in space without an elevation: slant range and azimuth."""
    return _core._placed_sensor("slant", 3, origin)  # type: ignore[no-any-return]


def doppler(axes: int, origin: Sequence[float] = ()) -> Sensor:
    """As polar, and the rate of the range in m/s."""
    return _core._placed_sensor("doppler", axes, origin)  # type: ignore[no-any-return]


def bearing(origin: Sequence[float] = ()) -> Sensor:
    """The azimuth alone."""
    return _core._placed_sensor("bearing", 2, origin)  # type: ignore[no-any-return]


def components(places: Sequence[int]) -> Sensor:
    """Components of the state at these places."""
    return _core._component_sensor(places)  # type: ignore[no-any-return]


def own(h: Callable[..., Any], *, jacobian: Any = None, angles: Sequence[int] = ()) -> Sensor:
    """z = h(x), (22): of a model's state (n,) the quantities (m,), jacobian(x) (m, n); angles are wrapped.

    For step alone. A call of Python costs some microseconds; without a Jacobian there are 2n of them for each mode.
    """
    return _core._own_sensor(h, jacobian, angles)  # type: ignore[no-any-return]

"""What measures a state, and from where. A position needs no sensor. Angles are in rad, counter-clockwise from x."""

from collections.abc import Callable, Sequence
from typing import Any

from ._sigmax import Sensor
from .models import core, named, slopes

polar = named(core._placed_sensor, "polar", "A radar at (x, y[, z]) in m: range and azimuth, in space also elevation.")
slant = named(core._placed_sensor, "slant", "A radar in space without an elevation: slant range and azimuth.")
doppler = named(core._placed_sensor, "doppler", "As polar, and the rate of the range in m/s.")
bearing = named(core._placed_sensor, "bearing", "The azimuth alone.")
components = named(core._placed_sensor, "components", "Components of the state at these places.")


def own(h: Callable[..., Any], *, jacobian: Any = None, angles: Sequence[int] = ()) -> Sensor:
    """z = h(x), (22): of a model's state (n,) the quantities (m,), jacobian(x) (m, n); angles are wrapped.

    For step alone. A call of Python costs some microseconds; without a Jacobian there are 2n of them for each mode.
    """
    return core._own_sensor(h, jacobian or slopes(h), angles)  # type: ignore[no-any-return]

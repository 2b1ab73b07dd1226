"""Whole recordings: track, associate and tune."""

import dataclasses
import html
import importlib
import io
from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from ._sigmax import Detections, Model, RandomVariable, Sensor, Variable
from .filters import MultiTargetTracker, settings

_Array = npt.NDArray[np.float64]


@dataclasses.dataclass(repr=False)
class Track:
    """A target at N times; rows are NaN before it starts."""

    times: _Array  # (N,), s
    x: _Array  # (N, n), in the order of components
    P: _Array  # (N, n, n)
    weights: _Array  # (N, modes)
    nis: _Array  # (N,), NaN without a detection that passed the gate
    components: list[str]
    mode: Variable  # random or fuzzy; its labels are the models
    _again: Any = None

    def __repr__(self) -> str:
        return f"<Track of {len(self.times)} rows: {', '.join(self.components)}; modes {', '.join(self.mode.labels)}>"

    def smooth(self) -> "Track":
        """The same of the whole recording: the filter runs again and keeps its steps for the smoother."""
        if self._again is None:
            raise ValueError("only a track of track() can be smoothed")
        return _track(*self._again, True)

    def to_pandas(self) -> Any:
        """A data frame with a row for each time: components, sigma_…, nis, weight_…."""
        pandas: Any = importlib.import_module("pandas")
        labels = [*self.components, *("sigma_" + name for name in self.components), "nis"]
        labels += ["weight_" + name for name in self.mode.labels]
        columns = np.column_stack([self.x, np.sqrt(np.diagonal(self.P, axis1=1, axis2=2)), self.nis, self.weights])
        return pandas.DataFrame(columns, columns=labels, index=pandas.Index(self.times, name="time_s"))

    def plot(self, axes: Any = None) -> Any:
        """Draws the path, or x over time along one axis, and the weights of the modes; returns matplotlib's axes."""
        if axes is None:
            axes = importlib.import_module("matplotlib.figure").Figure((9, 3.5), layout="constrained").subplots(1, 2)
        path, modes = axes
        plane = "y" in self.components
        path.plot(self.x[:, 0] if plane else self.times, self.x[:, 1 if plane else 0])
        path.set(xlabel="x in m" if plane else "time in s", ylabel="y in m" if plane else "x in m")
        path.set_aspect("equal" if plane else "auto", adjustable="datalim")
        modes.plot(self.times, self.weights, label=self.mode.labels)
        modes.set(xlabel="time in s", ylabel="probability" if isinstance(self.mode, RandomVariable) else "possibility")
        modes.legend()
        return axes

    def _repr_html_(self) -> str:
        """The chart of plot() as SVG; without matplotlib a sentence."""
        picture, caption = io.StringIO(), html.escape(repr(self))
        try:
            self.plot()[0].figure.savefig(picture, format="svg")
        except ImportError:
            return caption
        head, tag, drawn = picture.getvalue().partition("<svg")
        return f"<figure>{tag}{drawn}<figcaption>{caption}</figcaption></figure>"


def _track(made: Any, detections: Detections, smoothed: bool) -> Track:
    return Track(*made.follow(detections, smoothed), made.relation.to, (made, detections))


def track(times: Any, z: Any = None, R: Any = None, *, models: Sequence[Model], filter: str = "himm",
          transition: Any = None, sensor: Optional[Sensor] = None, **rules: Any) -> Track:
    """Follows one target through a recording at the speed of the library.

    times (N,) in s, z (N, m) with NaN or masked rows for missed detections, R (m, m), (m,) or (N, m, m); or Detections
    instead of all. The filter is one of filters._names; models are of the library. Rules are keywords: gate=0.999,
    rejections=3, start="given", sojourn=[…], augmentation="unbiased", mixed_covariance="selected", member="ukf", ….
    """
    detections = times if isinstance(times, Detections) else Detections(times, z, R, sensor)
    return _track(settings(filter, models, transition, rules, recorded=True), detections, False)


def associate(scans: Sequence[Detections], models: Sequence[Model],
              **rules: Any) -> tuple[dict[int, Track], list[npt.NDArray[np.int64]]]:
    """Tracks many targets: the confirmed ones, a row for each scan, by number; and whose each detection is, or 0."""
    tracker, labels = MultiTargetTracker(models, **rules), []
    known: dict[int, list[Any]] = {}
    for scan in scans:
        labels.append(tracker.scan(scan))
        for target in tracker.tracks():
            if target.confirmed:
                known.setdefault(target.number, []).append((target.time, target.x, target.P, target.weights, np.nan))
    last = tracker.components, tracker.mode
    return {each: Track(*map(np.array, zip(*rows)), *last) for each, rows in known.items()}, labels


def tune(recordings: Sequence[Detections], *, models: Sequence[Model], filter: str = "himm", transition: Any = None,
         folds: int = 5, seed: int = 1, **rules: Any) -> SimpleNamespace:
    """Fits the motions' noise, the transition and a factor on the sensors' standard deviations, `noise`.

    `numbers` has each with its standard error, infinite if it is not identifiable; `settings` are for track(detections,
    **settings); `loss`, and `loss_before`, is minus the robust log-score per row, in nats.
    """
    made = settings(filter, models, transition, rules, recorded=True)
    if not hasattr(made, "tune"):
        raise RuntimeError("sigmax was built without NLopt (libnlopt-cxx-dev), so it cannot tune")
    numbers, fitted, table, sojourn, loss, before = made.tune(list(recordings), folds, seed)
    found = {**rules, "filter": filter, "models": fitted}
    found |= {"sojourn": sojourn} if sojourn else {"transition": table}
    return SimpleNamespace(numbers=numbers, settings=found, noise=numbers["noise"][0], loss=loss, loss_before=before)

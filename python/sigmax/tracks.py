"""Whole recordings: track, associate and tune."""

import dataclasses
import html
import importlib
import io
from collections.abc import Sequence
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from . import _sigmax
from ._sigmax import Detections, Model, MultiTargetTracker, Sensor, Variable

_core: Any = _sigmax
_Array = npt.NDArray[np.float64]


@dataclasses.dataclass(repr=False)
class Track:
    """A target at N times; rows are NaN before it starts. `changes` has (time, mode) of the best history, if kept."""

    times: _Array  # (N,), s
    x: _Array  # (N, n), in the order of components
    P: _Array  # (N, n, n)
    weights: _Array  # (N, modes)
    nis: _Array  # (N,), NaN without a detection that passed the gate
    components: list[str]
    mode: Variable  # random or fuzzy; its labels are the models
    changes: list[tuple[float, str]] = dataclasses.field(default_factory=list)
    _again: Any = None

    def __len__(self) -> int:
        return len(self.times)

    def __repr__(self) -> str:
        return f"<Track of {len(self)} rows: {', '.join(self.components)}; modes {', '.join(self.mode.labels)}>"

    def smooth(self) -> "Track":
        """The same of the whole recording: the filter runs again and keeps its steps for the fixed-interval smoother."""
        if self._again is None:
            raise ValueError("only a track of track() can be smoothed")
        settings, detections = self._again
        return _track(settings, detections, True)

    def to_pandas(self) -> Any:
        """A data frame with a row for each time: components, sigma_…, nis, weight_…."""
        pandas: Any = importlib.import_module("pandas")
        sigmas = np.sqrt(np.diagonal(self.P, axis1=1, axis2=2))
        series = {name: self.x[:, i] for i, name in enumerate(self.components)}
        series.update({f"sigma_{name}": sigmas[:, i] for i, name in enumerate(self.components)})
        series["nis"] = self.nis
        series.update({f"weight_{label}": self.weights[:, j] for j, label in enumerate(self.mode.labels)})
        return pandas.DataFrame(series, index=pandas.Index(self.times, name="time_s"))

    def plot(self, axes: Any = None) -> Any:
        """Draws the path, or x over time along one axis, and the weights of the modes; returns two axes of matplotlib."""
        if axes is None:
            figure: Any = importlib.import_module("matplotlib.figure").Figure(figsize=(9, 3.5), layout="constrained")
            axes = figure.subplots(1, 2)
        path, modes = axes
        plane = "y" in self.components
        path.plot(self.x[:, 0] if plane else self.times, self.x[:, 1 if plane else 0])
        path.set(xlabel="x in m" if plane else "time in s", ylabel="y in m" if plane else "x in m")
        if plane:
            path.set_aspect("equal", adjustable="datalim")
        for j, label in enumerate(self.mode.labels):
            modes.plot(self.times, self.weights[:, j], label=label)
        modes.set(xlabel="time in s", ylabel="probability" if isinstance(self.mode, _core.RandomVariable) else "possibility")
        modes.legend()
        return axes

    def _repr_html_(self) -> str:
        """The chart of plot() as SVG; without matplotlib a sentence."""
        try:
            picture = io.StringIO()
            self.plot()[0].figure.savefig(picture, format="svg")
        except ImportError:
            return html.escape(repr(self))
        return f"<figure>{picture.getvalue()[picture.getvalue().index('<svg'):]}<figcaption>{html.escape(repr(self))}</figcaption></figure>"


def _track(settings: Any, detections: Detections, smoothed: bool) -> Track:
    x, P, weights, nis, components, changes = settings.follow(detections, smoothed)
    return Track(detections.times, x, P, weights, nis, components, settings.mode, changes, (settings, detections))


def track(times: Any, z: Any = None, R: Any = None, *, models: Sequence[Model], filter: str = "himm", transition: Any = None, sensor: Optional[Sensor] = None, **rules: Any) -> Track:
    """Follows one target through a recording at the speed of the library.

    times (N,) in s, z (N, m) with NaN or masked rows for missed detections, R (m, m), (m,) or (N, m, m); or Detections
    instead of all. filter: imm, himm, gpb1, himm_global, gpb2, viterbi, static_random, static_fuzzy, imm_histories,
    himm_histories. Models are of the library. Rules are keywords: gate=0.999, rejections=3, start="given", sojourn=[…],
    augmentation="unbiased", mixed_covariance="selected", member="ukf", ….
    """
    detections = times if isinstance(times, Detections) else Detections(times, z, R, sensor)
    return _track(_core._Settings(filter, list(models), transition, rules), detections, False)


def associate(scans: Sequence[Detections], models: Sequence[Model], **rules: Any) -> tuple[dict[int, Track], list[npt.NDArray[np.int64]]]:
    """Tracks many targets: the confirmed tracks by number, and for each scan whose each detection is, 0 if nobody's.

    Keywords are as of MultiTargetTracker. A track has a row for each scan after which it was confirmed.
    """
    tracker, labels = MultiTargetTracker(list(models), **rules), []
    known: dict[int, list[Any]] = {}
    for scan in scans:
        labels.append(tracker.scan(scan))
        for target in tracker.tracks(tracker.time):
            if target.confirmed:
                known.setdefault(target.number, []).append((target.time, target.x, target.P, target.weights, np.nan))
    made: Any = Track
    tracks = {number: made(*map(np.array, zip(*rows)), tracker.components, tracker.mode) for number, rows in known.items()}
    return tracks, labels


@dataclasses.dataclass
class Tuned:
    """What tune found: each number with its standard error, infinite if it is not identifiable."""

    numbers: dict[str, tuple[float, float]]
    settings: dict[str, Any]  # models, transition or sojourn, and rules: for track(detections, **settings)
    noise: float  # a factor on the sensors' standard deviations
    loss: float  # minus the robust log-score per row, in nats
    loss_before: float


def tune(recordings: Sequence[Detections], *, models: Sequence[Model], filter: str = "himm", transition: Any = None, noise: bool = True, folds: int = 5, seed: int = 1, **rules: Any) -> Tuned:
    """Fits the motions' noise, the transition, and with `noise` a factor on the sensors' standard deviations."""
    settings = _core._Settings(filter, list(models), transition, rules)
    numbers, fitted, table, sojourn, loss, before = _core._tune(settings, list(recordings), noise, folds, seed)
    found = {**rules, "filter": filter, "models": fitted, **({"sojourn": sojourn} if sojourn else {"transition": table})}
    return Tuned(numbers, found, numbers.get("noise", (1.0, 0.0))[0], loss, before)

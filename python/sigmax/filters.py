"""What steps: filters of one target, and a tracker of many."""

from collections.abc import Sequence
from typing import Any, TypeVar

import numpy as np

from ._sigmax import Distribution, FuzzyModeFilter, Model, RandomModeFilter, Relation, Variable, _Tracker
from .models import core

_F = TypeVar("_F")
_names = ["imm", "gpb1", "gpb2", "static_random", "imm_histories",
          "himm", "himm_global", "viterbi", "static_fuzzy", "himm_histories"]


def settings(filter: str, models: Sequence[Model], transition: Any, rules: dict[str, Any], recorded: bool = False,
             many: bool = False) -> Any:
    """What a filter is made of. Modes have the names of the models, and by default the transition of himm_demo."""
    if filter not in _names:
        raise ValueError(f"filter: expected one of {', '.join(_names)}, found '{filter}'")
    fuzzy, scheme = divmod(_names.index(filter), 5)
    kind, other = ("fuzzy", "random") if fuzzy else ("random", "fuzzy")
    names, n = [model.name for model in models], len(models)
    if recorded and (own := [model.name for model in models if not getattr(model, "_known")]):
        raise TypeError(f"{filter}: a recording needs motions of the library; '{own[0]}' is your own: call step")
    if isinstance(transition, Relation):
        if not transition.to.kind == transition.from_.kind == kind:
            raise TypeError(f"{filter}: a {kind} mode and a transition {type(transition).__name__}")
    else:
        labels = [f"{name}_{k}" if (k := names[: i + 1].count(name)) > 1 else name for i, name in enumerate(names)]
        stay, leave = (1.0, 0.5) if fuzzy or n == 1 else (0.95, 0.05 / (n - 1))
        table = np.asarray(np.where(np.eye(n), stay, leave) if transition is None else transition, np.float64)
        error = {"random": abs(table.sum(-1) - 1).max(), "fuzzy": abs(table.max(-1) - 1).max()}
        if error[other] < 1e-5 <= error[kind]:
            raise TypeError(f"{filter}: a {kind} mode and a {other} transition")
        mode = getattr(core, kind.capitalize() + "Variable")("mode", labels)
        transition = Relation(mode, mode, table)
    return core._Settings(bool(fuzzy), scheme, list(models), transition, rules, many)


def _named(name: str, filter: str, base: type[_F], doc: str) -> type[_F]:
    def init(self: Any, models: Sequence[Model], transition: Any = None, *, x: Any = None, P: Any = None,
             mode: Any = None, **rules: Any) -> None:
        made = settings(filter, models, transition, rules)
        if mode is not None and not isinstance(mode, Distribution):
            mode = Distribution(made.relation.to, mode)
        base.__init__(self, made, x, P, mode)  # type: ignore[call-arg]
    return type(name, (base,), {"__init__": init, "__doc__": doc})


IMM = _named("IMM", "imm", RandomModeFilter, "The interacting multiple-model filter of Blom and Bar-Shalom.")
HIMM = _named("HIMM", "himm", FuzzyModeFilter, "The same with a fuzzy mode, section V: Mei, Xu and Liu.")
GPB2 = _named("GPB2", "gpb2", RandomModeFilter, "Merges predecessors after the measurement.")
Viterbi = _named("Viterbi", "viterbi", FuzzyModeFilter, "Keeps the best predecessor of each mode.")
IMMHistories = _named("IMMHistories", "imm_histories", RandomModeFilter, "Prunes histories of a random mode.")
HIMMHistories = _named("HIMMHistories", "himm_histories", FuzzyModeFilter, "Keeps the most possible histories, (A-1).")


class MultiTargetTracker(_Tracker):
    """Tracks of many targets among false detections. Rules of track, and pattern, permutation, clutter_density, …."""

    def __init__(self, models: Sequence[Model], transition: Any = None, *, filter: str = "himm", **rules: Any) -> None:
        made = settings(filter, models, transition, rules, recorded=True, many=True)
        super().__init__(made)
        self.mode: Variable = made.relation.to

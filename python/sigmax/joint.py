"""Joint distributions of two variables."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import numpy.typing as npt

from ._sigmax import Distribution, InducedDistribution, Relation, compose, invert


@dataclasses.dataclass(frozen=True)
class HybridDistribution:
    """The joint of a relation and a distribution of its condition, of any kinds, (9), (12), (13).

    ⊕ over the condition of ⊕ over the other variable is one. In the other order it is β of the inner marginal, (14).
    """

    conditional: Relation[Any, Any]
    marginal: Distribution[Any]

    def __post_init__(self) -> None:
        self.inner_marginal()  # refuses other kinds and other variables

    @property
    def table(self) -> npt.NDArray[np.float64]:
        """The joint, (from_, to)."""
        return self.marginal.values[:, None] * self.conditional.table

    def inner_marginal(self) -> Distribution[Any] | InducedDistribution[Any]:
        """What is left when the condition is eliminated: only induced if its kind differs, (15)."""
        return compose(self.conditional, self.marginal)

    def outer_given_inner(self) -> tuple[Relation[Any, Any], list[int]]:
        """The other conditional, (14), and the outcomes that nothing reaches, as by invert."""
        return invert(self.conditional, self.marginal)

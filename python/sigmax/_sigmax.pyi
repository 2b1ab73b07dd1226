# The compiled module. stubtest holds it to this file: a section per room, in the order of the rooms.
import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Generic, Literal, NamedTuple, Protocol, TypeVar, overload

import numpy as np
import numpy.typing as npt

# ------------------------------------------------------------------------------------------------------------- core

Array = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
Key = str | int  # an outcome by its label or its index

class _Sparse(Protocol):  # a sparse matrix of SciPy
    def tocsr(self) -> Any: ...

class Variable:
    kind: str
    name: str
    size: int
    labels: list[str]
    outcomes: list[str] | int
    def index_of(self, label: str, /) -> int: ...
    def __len__(self) -> int: ...

class RandomVariable(Variable):
    def __init__(self, name: str, outcomes: Sequence[str] | int) -> None: ...

class FuzzyVariable(Variable):
    def __init__(self, name: str, outcomes: Sequence[str] | int) -> None: ...

class OrdinalVariable(Variable):
    def __init__(self, name: str, outcomes: Sequence[str] | int) -> None: ...

V = TypeVar("V", bound=Variable)
To = TypeVar("To", bound=Variable)
Middle = TypeVar("Middle", bound=Variable)
From = TypeVar("From", bound=Variable)

class _Row(Generic[V]):
    variable: V
    values: Array
    def __len__(self) -> int: ...
    def __getitem__(self, outcome: Key, /) -> float: ...

class Distribution(_Row[V]):
    def __init__(self, variable: V, values: npt.ArrayLike, /) -> None: ...
    def normalized(self) -> Distribution[V]: ...

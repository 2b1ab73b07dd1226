"""Sigma-max inference: probability and possibility as one calculus, arrays in and arrays out."""

from ._sigmax import *

"""Sigma-max inference: probability and possibility as one calculus, arrays in and arrays out."""

from ._sigmax import *
from . import models, sensors
from .joint import HybridDistribution
from .tracks import Track, Tuned, associate, track, tune

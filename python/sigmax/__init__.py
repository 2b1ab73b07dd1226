"""Sigma-max inference: probability and possibility as one calculus, arrays in and arrays out."""

from ._sigmax import *
from . import models, sensors
from .filters import IMM, HIMM, GPB2, Viterbi, IMMHistories, HIMMHistories, MultiTargetTracker
from .joint import HybridDistribution
from .tracks import Track, associate, track, tune

"""The package as a whole: what importing it does, its types, how it is installed."""

import sigmax


def test_the_module_is_compiled():
    assert sigmax._sigmax.__file__.endswith(".so")

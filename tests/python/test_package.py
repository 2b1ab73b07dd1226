"""The package as a whole: what importing it does, and its types."""

import os
import pathlib
import re
import subprocess
import sys

import sigmax

package = pathlib.Path(sigmax.__file__).parent


def run(*arguments, **options):
    environment = {**os.environ, "PYTHONPATH": str(package.parent), "MYPYPATH": str(package.parent)}
    return subprocess.run([sys.executable, *arguments], env=environment, capture_output=True, text=True, **options)


def test_importing_it_imports_nothing_but_numpy():
    code = "import sys, sigmax; print([m for m in ('pandas', 'matplotlib', 'sklearn', 'scipy') if m in sys.modules])"
    assert run("-c", code).stdout == "[]\n"


def test_with_an_unknown_numpy_there_is_a_sentence():
    code = "import sys, types; sys.modules['numpy'] = types.SimpleNamespace(__version__='2.1.0'); import sigmax"
    result = run("-c", code)
    assert result.returncode == 1
    sentence = r"ImportError: sigmax was built with pybind11 2\.1\d, .*found NumPy 2\.1\.0; install 'numpy<2'"
    assert re.search(sentence, result.stderr)


def test_the_stubs_are_those_of_the_module():
    # pybind11's own metaclass, and its __init__ of a class that has none, are not declared.
    allowed = r"metaclass differs|__init__ is inconsistent, stub does not have \*args"
    found = run("-m", "mypy.stubtest", "--concise", "sigmax._sigmax").stdout.splitlines()
    assert [line for line in found if not re.search(allowed, line)] == []
    assert any("metaclass differs" in line for line in found)  # it ran


def test_a_checker_of_types_sees_kinds(tmp_path):
    program = tmp_path / "program.py"
    program.write_text(
        "import sigmax as sx\n"
        "age, speed = sx.FuzzyVariable('age', 3), sx.RandomVariable('speed', 2)\n"
        "relation = sx.Relation(speed, age, [[1, 0]] * 3)\n"
        "reveal_type(sx.update(sx.uninformative(age), relation.likelihood(0)))\n"
        "sx.update(sx.uninformative(speed), relation.likelihood(0))\n"
    )
    found = run("-m", "mypy", "--strict", "--no-incremental", str(program), cwd=tmp_path).stdout
    assert 'Revealed type is "sigmax._sigmax.Distribution[sigmax._sigmax.FuzzyVariable]"' in found
    assert "program.py:5: error: " in found and "Found 1 error" in found

"""The gallery: each script draws its figure, and prints what its page shows."""

import os
import pathlib
import re
import subprocess
import sys

import pytest
import sigmax

gallery = pathlib.Path(__file__).parents[2] / "docs/gallery"
scripts = sorted(gallery.glob("*.py"))
page = (gallery / "README.md").read_text()


@pytest.mark.parametrize("script", scripts, ids=[script.stem for script in scripts])
def test_a_script_draws_its_figure_and_prints_what_the_page_shows(script, tmp_path):
    folder = pathlib.Path(sigmax.__file__).parents[1]
    environment = {**os.environ, "PYTHONPATH": str(folder), "MPLBACKEND": "Agg", "MPLCONFIGDIR": str(tmp_path)}
    figure = tmp_path / "figure.png"
    arguments = [sys.executable, str(script), str(figure)]
    result = subprocess.run(arguments, env=environment, cwd=tmp_path, capture_output=True, text=True)
    if "built without NLopt" in result.stderr:
        pytest.skip("sigmax was built without NLopt")
    assert (result.returncode, result.stderr) == (0, "")
    assert figure.read_bytes()[:8] == b"\x89PNG\r\n\x1a\n" and figure.stat().st_size > 5000
    assert all(line in page for line in result.stdout.splitlines()) and result.stdout


def test_the_page_shows_every_script_and_figure():
    assert sorted(set(re.findall(r"\((\w+)\.py\)", page))) == [script.stem for script in scripts]
    assert sorted(set(re.findall(r"\((\w+)\.png\)", page))) == [figure.stem for figure in sorted(gallery.glob("*.png"))]
    assert len(scripts) == len(list(gallery.glob("*.png")))

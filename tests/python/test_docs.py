"""Python in the documentation: it runs, and prints what the comments behind `print` say."""

import pathlib
import re

import matplotlib
import pytest

root = pathlib.Path(__file__).parents[2]


@pytest.mark.parametrize("page", ["README.md", "docs/coming_from.md"])
def test_code_prints_what_the_page_says(page, capsys, monkeypatch):
    matplotlib.use("Agg")
    monkeypatch.chdir(root)
    code = "".join(re.findall(r"```python\n(.*?)```", (root / page).read_text(), re.S))
    exec(compile(code, page, "exec"), {})
    expected = re.findall(r"^print\(.*\)  # (.*)$", code, re.M)
    assert expected and capsys.readouterr().out.splitlines() == expected

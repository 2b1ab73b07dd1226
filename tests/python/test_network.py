"""Networks: queries against the whole joint in NumPy, explanations, files."""

import itertools

import numpy as np
import pytest

import sigmax as sx

age = sx.FuzzyVariable("age", ["young", "middle", "old"])
mood = sx.FuzzyVariable("mood", ["calm", "wild"])
speed = sx.RandomVariable("speed", ["slow", "fast"])
noise = sx.RandomVariable("noise", ["low", "high"])


def mixed():
    """age → mood, both → speed → noise; and its joint, an axis for each variable."""
    network = sx.RelationNetwork()
    network.declare(sx.Distribution(age, [1.0, 0.8, 0.5]))
    network.declare(sx.Relation(mood, age, [[0.3, 1.0], [1.0, 0.6], [1.0, 0.2]]))
    fast = np.array([[0.2, 0.7], [0.1, 0.6], [0.05, 0.5]])
    network.declare(speed, [age, mood], np.stack([1 - fast, fast], axis=-1).reshape(6, 2))
    network.declare(sx.Relation(noise, speed, [[0.8, 0.2], [0.3, 0.7]]))
    table = {name: network.table(name) for name in network.parents}
    joint = (table["age"].reshape(3, 1, 1, 1) * table["mood"].reshape(3, 2, 1, 1) * table["speed"].reshape(3, 2, 2, 1)
             * table["noise"].reshape(1, 1, 2, 2))
    return network, joint


axes, plus = ["age", "mood", "speed", "noise"], {"age": np.max, "mood": np.max, "speed": np.sum, "noise": np.sum}


def queried(joint, names):
    """All others eliminated innermost first."""
    for name in reversed(axes):
        if name not in names:
            joint = plus[name](joint, axis=axes.index(name), keepdims=True)
    return joint.squeeze()


@pytest.mark.parametrize("names", [c for n in range(1, 4) for c in itertools.combinations(axes, n)], ids=" ".join)
def test_a_query_eliminates_all_others_innermost_first(names):
    network, joint = mixed()
    answer = sx.query(network, names)
    total = np.exp(answer.logs)
    np.testing.assert_allclose(total, queried(joint, names), rtol=1e-12)
    for name in reversed(names):
        total = plus[name](total, axis=-1)
    assert answer.log_total == pytest.approx(np.log(total))


def test_evidence_is_a_label_or_a_likelihood():
    network, joint = mixed()
    evidence = {"noise": "high", "mood": sx.Likelihood(mood, [0.2, 1.0]), "age": sx.Likelihood(age, [1, 0, 1])}
    weights = joint * np.array([0, 1.0]) * np.reshape([0.2, 1.0], (2, 1, 1)) * np.reshape([1, 0, 1.0], (3, 1, 1, 1))
    answer = sx.query(network, ["age"], evidence)
    np.testing.assert_allclose(np.exp(answer.logs), queried(weights, ["age"]), rtol=1e-12)
    assert type(answer.distribution()) is sx.FuzzyDistribution and answer.distribution()["young"] == 1.0
    assert not answer.induced
    for one, name in zip(sx.marginals(network, evidence), axes):
        np.testing.assert_allclose(np.exp(one.logs), queried(weights, [name]), rtol=1e-12)
    outcomes, log = sx.most_likely_explanation(network, evidence=evidence)
    best = np.unravel_index(weights.argmax(), weights.shape)
    assert outcomes == {name: network.variable(name).labels[i] for name, i in zip(axes, best)}
    assert log == pytest.approx(np.log(weights.max()))
    assert sx.most_likely_explanation(network, ["age"], evidence)[0] == {"age": "young"}


def test_declarations_are_read_again():
    network, _ = mixed()
    assert network.parents == {"age": [], "mood": ["age"], "speed": ["age", "mood"], "noise": ["speed"]}
    assert sx.query(network, ["mood", "noise"]).induced and not sx.query(network, ["mood"]).induced


def test_bif_files(tmp_path):
    network = sx.RelationNetwork()
    network.declare(sx.Distribution(speed, [0.25, 0.75]))
    network.declare(sx.Relation(noise, speed, [[0.8, 0.2], [1 / 3, 2 / 3]]))
    sx.write_bif(tmp_path / "small.bif", network)
    again = sx.read_bif(tmp_path / "small.bif")
    assert again.parents == network.parents and again.variable("noise") == noise
    np.testing.assert_array_equal(again.table("noise"), network.table("noise"))
    (tmp_path / "bad.bif").write_text("network a {\n}\nvariable b {\n  type discrete [ 2 ] { x };\n}\n")
    with pytest.raises(ValueError, match=r"bad\.bif:4"):
        sx.read_bif(str(tmp_path / "bad.bif"))
    with pytest.raises(FileNotFoundError):
        sx.read_bif(tmp_path / "none.bif")


refusals = [
    (ValueError, "no variable 'x'", lambda network: sx.query(network, ["x"])),
    (ValueError, "'mood' is declared twice", lambda network: network.declare(mood, [], [[1, 1]])),
    (ValueError, "above the limit", lambda network: sx.query(network, axes, table_limit=8)),
    (ValueError, "evidence of 'age': found that of 'mood'",
     lambda network: sx.query(network, ["age"], {"age": sx.Likelihood(mood, [1, 1])})),
    (ValueError, "2 variables, not of one", lambda network: sx.query(network, ["age", "mood"]).distribution()),
    (ValueError, "'age' is fuzzy, not random", lambda network: sx.write_bif("/dev/null", network)),
    (TypeError, "'age': 3", lambda network: sx.query(network, ["age"], {"age": 3})),
    (TypeError, "OrdinalVariable", lambda network: network.declare(sx.OrdinalVariable("o", 2), [], [[1, 1]])),
]


@pytest.mark.parametrize("error, words, call", refusals, ids=[words for _, words, _ in refusals])
def test_refusals(error, words, call):
    with pytest.raises(error, match=words):
        call(mixed()[0])

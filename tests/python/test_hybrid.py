"""Models, sensors, filters and whole recordings: against restatements in NumPy, and the C++ program."""

import csv
import gc
import os
import pathlib
import subprocess
import threading

import numpy as np
import pytest

import sigmax as sx
from sigmax import models, sensors

bank = [models.dwna(3, sigma=3.0), models.dwpa(3, sigma=3.0)]
start = {"x": [12e3, 8e3, 1e3, -100, -100, 0, 0, 0, 0], "P": np.diag([100.0] * 3 + [50.0] * 3 + [9.0] * 3)}
R = np.diag([100.0, 400.0, 225.0])


def scenario(seed=1):
    """The paper's first scenario: 200 samples at 0.2 s, accelerated from sample 81 to 130; measured positions."""
    rng, T = np.random.default_rng(seed), 0.2
    position, velocity, path = np.array([12e3, 8e3, 1e3]), np.array([-100.0, -100.0, 0.0]), []
    for k in range(1, 201):
        a = np.array([-30.0, -50.0, 0.0]) if 81 <= k <= 130 else rng.normal(0, 3, 3)
        position, velocity = position + T * velocity + T * T / 2 * a, velocity + T * a
        path.append(position + rng.normal(0, np.sqrt(np.diag(R))))
    return T * np.arange(1, 201), np.array(path)


times, z = scenario()


class RestatedIMM:
    """Blom and Bar-Shalom's IMM of models with one state, in plain NumPy."""

    def __init__(self, Fs, Qs, H, x, P, mode, transition):
        self.Fs, self.Qs, self.H, self.mode, self.transition = Fs, Qs, H, np.array(mode), np.array(transition)
        self.xs, self.Ps = [np.array(x)] * len(Fs), [np.array(P)] * len(Fs)

    def step(self, z, R):
        prior = self.mode @ self.transition
        into = self.transition * self.mode[:, None] / prior
        mixed = [sum(w * x for w, x in zip(into[:, j], self.xs)) for j in range(len(prior))]
        spread = lambda x, m: np.outer(x - m, x - m)
        starts = [sum(w * (P + spread(x, m)) for w, x, P in zip(into[:, j], self.xs, self.Ps))
                  for j, m in enumerate(mixed)]
        fit = np.empty(len(prior))
        for j, (F, Q) in enumerate(zip(self.Fs, self.Qs)):
            x, P = F @ mixed[j], F @ starts[j] @ F.T + Q
            S, nu = self.H @ P @ self.H.T + R, z - self.H @ x
            W = P @ self.H.T @ np.linalg.inv(S)
            fit[j] = np.exp(-nu @ np.linalg.solve(S, nu) / 2) / np.sqrt(np.linalg.det(2 * np.pi * S))
            I_WH = np.eye(len(x)) - W @ self.H
            self.xs[j], self.Ps[j] = x + W @ nu, I_WH @ P @ I_WH.T + W @ R @ W.T
        self.mode = prior * fit / (prior * fit).sum()
        self.x = sum(w * x for w, x in zip(self.mode, self.xs))
        self.P = sum(w * (P + spread(x, self.x)) for w, x, P in zip(self.mode, self.xs, self.Ps))


def test_filterpys_example_of_an_imm():
    # Two filters of position, velocity and acceleration in the plane; the second one has no noise. Unit P, Q and R.
    F, I = np.kron([[1, 1, 0.5], [0, 1, 1], [0, 0, 1]], np.eye(2)), np.eye(6)
    M = [[0.97, 0.03], [0.03, 0.97]]
    names = ["x", "y", "vx", "vy", "ax", "ay"]
    imm = sx.IMM([models.linear(F, I, names), models.linear(F, 0 * I, names)], mode=[0.5, 0.5], transition=M)
    own = models.motion(lambda x, dt: F @ x, 0 * I, names)
    called = sx.IMM([models.linear(lambda dt: F, lambda dt: I, names), own],
                    mode=[0.5, 0.5], transition=M, x=np.zeros(6), P=I)  # fmt: skip
    restated = RestatedIMM([F, F], [I, 0 * I], np.eye(2, 6), np.zeros(6), I, [0.5, 0.5], M)
    rng = np.random.default_rng(3)
    for i in range(100):
        seen = i + rng.normal(size=2)
        imm.step(1.0, seen, R=np.eye(2))
        called.step(1.0, seen, R=[1.0, 1.0])
        restated.step(seen, np.eye(2))
        np.testing.assert_allclose(imm.x, restated.x, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(imm.P, restated.P, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(imm.weights.values, restated.mode, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(called.x, restated.x, rtol=1e-6, atol=1e-6)
    assert imm.components == names and isinstance(imm.weights, sx.RandomDistribution)
    assert imm.weights.variable.labels == ["linear", "linear_2"]


@pytest.mark.parametrize("kind, name", [
    (sx.IMM, "imm"), (sx.HIMM, "himm"), (sx.GPB2, "gpb2"), (sx.Viterbi, "viterbi"),
    (sx.IMMHistories, "imm_histories"), (sx.HIMMHistories, "himm_histories")])  # fmt: skip
def test_a_recording_is_its_steps(kind, name):
    variances = np.diag(start["P"])
    rules = {"start": "given", "start_mean": start["x"], "start_variances": variances, "start_time": 0.0}
    masked = np.ma.masked_invalid(np.where(np.arange(200)[:, None] % 7 == 3, np.nan, z))
    track = sx.track(times, masked, R=R, models=bank, filter=name, **rules)
    history = {"augmentation": "prior", "cut": 0.0 if name == "imm_histories" else 0.05} if "hist" in name else {}
    stepped = kind(bank, **start, **history)
    each_R = np.broadcast_to(R, (200, 3, 3))
    nan_track = sx.track(times, masked.filled(np.nan), R=each_R, models=bank, filter=name, **rules)
    before = 0.0
    for k, time in enumerate(times):
        if k % 7 == 3:
            stepped.step(time - before)
            assert stepped.nis is None and np.isnan(track.nis[k])
        else:
            stepped.step(time - before, z[k], R=R)
            assert track.nis[k] == stepped.nis
        before = time
        np.testing.assert_array_equal(track.x[k], stepped.x)
        np.testing.assert_array_equal(track.P[k], stepped.P)
        np.testing.assert_array_equal(track.weights[k], stepped.weights.values)
    np.testing.assert_array_equal(track.x, nan_track.x)
    assert track.x.shape == (200, 9) and track.P.shape == (200, 9, 9) and track.weights.shape == (200, 2)
    of_mode = "fuzzy" if issubclass(kind, sx.FuzzyModeFilter) else "random"
    assert track.mode.kind == stepped.weights.variable.kind == of_mode


def program(tmp_path, positions, at, *settings):
    """Rows of the C++ program's estimates by filter."""
    path = tmp_path / "recording.csv"
    rows = [["time_s", "x_m", "y_m", "z_m"]]
    rows += [[repr(float(t)), *map(repr, row)] for t, row in zip(at, positions.tolist())]
    path.write_text("\n".join(map(",".join, rows)) + "\n")
    arguments = [os.environ["SIGMAX_HIMM_DEMO"], "track", path, "--quiet", "--out", tmp_path / "out"]
    arguments += [part for each in settings for part in ("--set", each)]
    subprocess.run(arguments, check=True, capture_output=True, env={**os.environ, "LD_PRELOAD": ""})
    found = {}
    with open(tmp_path / "out" / "estimates.csv", newline="") as file:
        for row in csv.DictReader(file):
            found.setdefault(row["filter"], []).append(row)
    return found


def expect_the_programs(found, track):
    first = np.flatnonzero(~np.isnan(track.x[:, 0]))[0] + 1  # it does not print starts
    assert len(found) == len(track.x) - first
    names = ["x_m", "y_m", "z_m", "vx_mps", "vy_mps", "vz_mps", "ax_mps2", "ay_mps2", "az_mps2"]
    number = lambda name: np.array([float(row[name] or "nan") for row in found])
    np.testing.assert_array_equal(np.array([number(name) for name in names]).T, track.x[first:])
    for i, name in enumerate(names[:6]):
        np.testing.assert_array_equal(number("sigma_" + name), np.sqrt(track.P[first:, i, i]))
    np.testing.assert_array_equal(number("nis"), track.nis[first:])
    for j, label in enumerate(track.mode.labels):
        np.testing.assert_array_equal(number("weight_" + label), track.weights[first:, j])


needs_program = pytest.mark.skipif("SIGMAX_HIMM_DEMO" not in os.environ, reason="SIGMAX_HIMM_DEMO is not set")


@needs_program
def test_the_papers_scenario_equals_the_program(tmp_path):
    filters = ["imm", "himm", "gpb2", "viterbi", "himm_histories"]
    chosen = f'filters={filters}'.replace("'", '"')
    found = program(tmp_path, z, times, chosen, "sigma_position_m=[10,20,15]", "sigma_w=3")
    for name in filters[:4]:
        expect_the_programs(found[name], sx.track(times, z, R=[100, 400, 225], models=bank, filter=name))
    smoothed = program(tmp_path, z, times, 'filters=["himm"]', "sigma_position_m=[10,20,15]", "smooth=true")
    expect_the_programs(smoothed["himm"], sx.track(times, z, R=R, models=bank).smooth())


@needs_program
def test_the_recorded_jet_equals_the_program(tmp_path):
    path = pathlib.Path(os.environ.get("SIGMAX_DATA", "")) / "tracking" / "c550_phlab_20170320_08.csv"
    if not path.exists():
        pytest.skip(f"no recorded data: {path}")
    with open(path, newline="") as file:
        columns = ("time_s", "latitude_deg", "longitude_deg", "altitude_gnss_ft")
        rows = [[float(row[c]) for c in columns] for row in csv.DictReader(file)]
    t, latitude, longitude, height = np.array(rows).T  # on a plane, in m
    east, north = (longitude - longitude[0]) * np.cos(np.radians(52)), latitude - latitude[0]
    flown = np.array([east * 111e3, north * 111e3, height * 0.3048]).T
    found = program(tmp_path, flown, t, 'filters=["imm","himm"]', "sigma_w=3", "sigma_position_m=10")
    for name in "imm", "himm":
        expect_the_programs(found[name], sx.track(t, flown, R=[100.0] * 3, models=bank, filter=name))


def test_kinds_do_not_mix():
    mode, other = sx.RandomVariable("mode", 2), sx.FuzzyVariable("mode", 2)
    P, Pi = [[0.9, 0.1], [0.2, 0.8]], [[1, 0.5], [0.5, 1]]
    for kind, table, good in [(sx.HIMM, P, sx.Relation(other, other, Pi)), (sx.IMM, Pi, sx.Relation(mode, mode, P))]:
        with pytest.raises(TypeError, match="(himm: a fuzzy mode and a random|imm: a random mode and a fuzzy) tr"):
            kind(bank, table)
        assert kind(bank, good).weights.variable == good.to
    with pytest.raises(TypeError, match="himm: a fuzzy mode and a transition RandomGivenRandom"):
        sx.HIMM(bank, sx.Relation(mode, mode, P))
    with pytest.raises(TypeError, match="a fuzzy mode and a random"):
        sx.track(times, z, R=R, models=bank, transition=P)
    with pytest.raises(TypeError, match="mode: a random mode and a FuzzyDistribution"):
        sx.IMM(bank, P, mode=sx.uninformative(other))
    with pytest.raises(ValueError, match="dwna.*0.7"):
        sx.IMM(bank, [[0.3, 0.4], [0.2, 0.8]])


def test_wrong_shapes_and_words():
    filter = sx.IMM(bank, **start)
    for call, words in [
        (lambda: filter.step(0.2, z[:1].T, R=R), r"z: expected shape \(any,\), found \(3, 1\)"),
        (lambda: filter.step(0.2, z[0], R=100.0), r"R: expected shape \(3, 3\), found \(\)"),
        (lambda: filter.step(0.2, np.zeros(7), R=np.eye(7)), "z"),
        (lambda: filter.step(0.2, [np.nan] * 3, R=R), "finite"),
        (lambda: filter.step(0.2, np.ma.array(z[0], mask=[0, 1, 0]), R=R), "finite"),
        (lambda: sx.IMM(bank, x=start["x"][:3], P=R), r"x: expected shape \(9,\)"),
        (lambda: filter.step(0.2, z[0]), r"R: expected shape \(3, 3\), found \(\)"),
        (lambda: sx.track(times, z[:-1], R=R, models=bank), r"z: expected shape \(200, any\), found \(199, 3\)"),
        (lambda: sx.track(times, np.where(z > 1e3, z, np.nan), R=R, models=bank), r"z: row \d+ has \d NaN of 3"),
        (lambda: sx.track(times, z, R=R, models=bank, filter="ukf"), "filter: expected .* imm, .*himm.*found 'ukf'"),
        (lambda: sx.track(times, z, R=R, models=bank, augmentation="none"), "augmentation: expected one of zero"),
        (lambda: models.dwna(4), "along 4 axes"),
        (lambda: models.singer(2, tau_s=-1.0), "the rate of model 'singer' is -1"),
        (lambda: models.linear(np.eye(2), np.eye(3), ["x", "v"]), r"Q: expected shape \(2, 2\)"),
    ]:
        with pytest.raises(ValueError, match=words):
            call()
    with pytest.raises(TypeError, match="step: unexpected float"):
        filter.step(0.2, z[0], R=R, gate=0.99)
    with pytest.raises(TypeError, match="dwna: there is no parameter 'tau_s'"):
        models.dwna(2, tau_s=1.0)
    with pytest.raises(TypeError, match="there is no rule 'gaet'"):
        sx.track(times, z, R=R, models=bank, gaet=0.99)
    with pytest.raises(TypeError, match="there is no rule 'clutter_density'"):
        sx.IMM(bank, clutter_density=1e-6)


def test_functions_of_python_are_models_and_sensors():
    names = ["x", "y", "vx", "vy"]
    F = lambda dt: np.kron([[1, dt], [0, 1]], np.eye(2))
    Q = lambda dt: np.kron([[dt**4 / 4, dt**3 / 2], [dt**3 / 2, dt**2]], np.eye(2))
    own = models.motion(lambda x, dt: F(dt) @ x, Q, names)
    jacobian = models.motion(lambda x, dt: F(dt) @ x, Q, names, jacobian=lambda x, dt: F(dt))
    polar = lambda x: [np.hypot(x[0], x[1]), np.arctan2(x[1], x[0])]
    begin = {"x": [-5e3, 30.0, -50.0, -60.0], "P": np.diag([1e3, 1e3, 100, 100])}
    motions = models.dwna(2, sigma=1.0), own, jacobian, models.linear(F, Q, names)
    filters = [sx.IMM([each], **begin) for each in motions]
    own_sensor = sensors.own(polar, angles=[1])
    eyes = [sensors.polar([0, 0]), own_sensor, own_sensor, sensors.polar([0, 0])]
    for k in range(20):  # the azimuth passes π
        seen = np.array(polar([-5e3 - 50 * k, 30.0 - 60 * k])) + [3.0, 1e-3]
        for filter, eye in zip(filters, eyes):
            filter.step(1.0, seen, R=[100.0, 1e-6], sensor=eye)
            np.testing.assert_allclose(filter.x, filters[0].x, rtol=1e-6)
    with pytest.raises(TypeError, match="himm: a recording needs motions of the library; 'motion' is your own"):
        sx.track([1.0], [[0.0, 0.0]], R=[1.0, 1.0], models=[own])
    with pytest.raises(TypeError, match="a sensor of your own"):
        sx.Detections([1.0], [[0.0, 0.0]], [1.0, 1.0], eyes[1])
    points = sx.IMM([models.motion(lambda x, dt: F(dt) @ x, Q, names, member="ukf")], **begin)
    points.step(1.0, [4980.0, 3.1], R=[100.0, 1e-6], sensor=eyes[1])

    def fails(x, dt):
        raise KeyError("mine")

    broken = sx.IMM([models.motion(fails, np.eye(2), ["x", "v"])], x=[0, 0], P=np.eye(2))
    with pytest.raises(KeyError, match="mine"):
        broken.step(1.0)
    np.testing.assert_array_equal(broken.x, [0, 0])
    with pytest.raises(ValueError, match=r"f: expected shape \(2,\), found \(3,\)"):
        sx.IMM([models.motion(lambda x, dt: [1, 2, 3], np.eye(2), ["x", "v"])]).step(1.0)
    with pytest.raises(ValueError, match="3 quantities by a sensor of 2"):
        sx.IMM([models.dwna(1)], x=[0, 0], P=np.eye(2)).step(1.0, [0.0] * 3, [1.0] * 3, sensors.own(lambda x: x))
    with pytest.raises(ValueError, match="(h|jacobian) has too many rows"):
        sx.IMM([models.dwna(1)], x=[0, 0], P=np.eye(2)).step(1.0, [0.0], [1.0], sensors.own(lambda x: np.zeros(7)))


def test_the_gate_turns_away_and_sensors_merge():
    filter = sx.HIMM(bank, **start)
    filter.step(0.2, np.array(start["x"][:3]) + 5e3, R=R, gate=sx.Gate(0.999))
    assert filter.nis is None
    radar = sensors.polar([0, 0, 0])
    r = np.linalg.norm(z, axis=1)
    seen = np.array([r, np.arctan2(z[:, 1], z[:, 0]), np.arcsin(z[:, 2] / r)]).T
    both = sx.Detections(times[::2], z[::2], R) + sx.Detections(times[1::2], seen[1::2], [400, 1e-6, 1e-6], radar)
    assert len(both) == 200
    track = sx.track(both, models=bank, filter="imm", member="ukf", gate=0.9999, rejections=3)
    np.testing.assert_array_equal(track.times, times)
    assert np.abs(track.x[50:, :3] - z[50:]).mean() < 20


def test_a_bank_steps_each_track_by_its_own_filter():
    for kind in sx.IMM, sx.HIMM:
        tracks, filters = ([kind(bank, **start) for _ in range(11)] for _ in range(2))
        for k in range(30):
            scan = z[k] + np.arange(11)[:, None]
            scan[k % 11] = np.nan
            kind.step_all(tracks, 0.2, np.ma.masked_invalid(scan), R)
            for i, filter in enumerate(filters):
                filter.step(0.2, *(() if i == k % 11 else (scan[i], R)))
        for track, filter in zip(tracks, filters):
            np.testing.assert_array_equal(track.x, filter.x)
            np.testing.assert_array_equal(track.weights.values, filter.weights.values)
    with pytest.raises(TypeError):
        sx.IMM.step_all(tracks, 0.2, scan, R)  # of the other kind
    with pytest.raises(ValueError, match=r"z: expected shape \(11, any\)"):
        sx.HIMM.step_all(tracks, 0.2, scan[:10], R)


def test_many_targets_and_their_metrics():
    rng = np.random.default_rng(5)
    truth = np.array([[[10 * k, 0.0], [10 * k, 400.0 - 2 * k]] for k in range(40)])
    seen = [np.vstack([truth[k] + rng.normal(0, 3, (2, 2)), rng.uniform(-500, 900, 2)]) for k in range(40)]
    scans = [sx.Detections([1.0 * k] * 3, z, [9, 9]) for k, z in enumerate(seen)]
    plane = [models.dwna(2, sigma=1.0), models.dwpa(2, sigma=1.0)]
    tracks, labels = sx.associate(scans, plane, clutter_density=1e-6, greatest_speed=30.0)
    assert len(tracks) == 2 and all(len(each) == 3 for each in labels)
    last = np.array([track.x[-1, :2] for track in tracks.values()])
    found = sx.gospa(truth[-1], last, cutoff=20.0)
    assert found.missed == found.false_targets == 0 and sorted(found.estimate_of) == [0, 1]
    assert found.value == pytest.approx(np.sqrt(sum(min(np.sum((p - q) ** 2) for q in last) for p in truth[-1])))
    with pytest.raises(ValueError, match="only a track of track"):
        next(iter(tracks.values())).smooth()


def test_tuning_finds_the_noise():
    rng, T = np.random.default_rng(6), np.arange(300.0)
    a = rng.normal(0, 0.5, 300)
    v = np.cumsum(a)
    walked = np.cumsum(v - a / 2)
    # of twice the deviation that R says
    recording = sx.Detections(T, (walked + rng.normal(0, 10, 300))[:, None], [25.0])
    tuned = sx.tune([recording], models=[models.dwna(1, sigma=3.0)], filter="imm")
    value, error = next(number for name, number in tuned.numbers.items() if "sigma_w" in name)
    assert abs(np.log(value / 0.5)) < 3 * error / value and 1.8 < tuned.noise < 2.2 and tuned.loss < tuned.loss_before
    assert sx.track(recording, **tuned.settings).x.shape == (300, 2)


def test_two_threads_follow_at_once():
    expected, found = sx.track(times, z, R=R, models=bank).x, {}
    work = lambda i: found.__setitem__(i, [sx.track(times, z, R=R, models=bank).x for _ in range(20)])
    threads = [threading.Thread(target=work, args=(i,)) for i in range(2)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert all(np.array_equal(x, expected, equal_nan=True) for each in found.values() for x in each) and len(found) == 2


def test_arrays_outlive_what_they_come_from():
    filter = sx.HIMM(bank, **start)
    filter.step(0.2, z[0], R=R)
    x, values, before = filter.x, filter.weights.values, filter.x.copy()
    weights = values.copy()
    filter.step(0.2, z[1], R=R)
    del filter
    gc.collect()
    assert np.array_equal(x, before) and np.array_equal(values, weights)


def test_a_track_becomes_a_frame_and_charts():
    track = sx.track(times, z, R=R, models=bank)
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(z, columns=["x_m", "y_m", "z_m"])
    np.testing.assert_array_equal(sx.track(pandas.Series(times), frame, R=R, models=bank).x, track.x)
    filter = sx.IMM(bank, **start)
    filter.step(0.2, frame.iloc[0], R=pandas.DataFrame(R))
    frame = track.to_pandas()
    assert isinstance(frame, pandas.DataFrame)
    assert list(frame.columns[:2]) == ["x", "y"] and frame.index.name == "time_s"
    pytest.importorskip("matplotlib")
    path, modes = track.plot()
    assert path.get_xlabel() == "x in m" and modes.get_ylabel() == "possibility"
    page = track._repr_html_()
    assert page.startswith("<figure><svg") and "Track of 200 rows" in page

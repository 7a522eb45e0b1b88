import math
import tomllib

import pytest
from pydantic import ValidationError

from cadgraph.config import ClusterConfig, Config, describe, read_config


def toml(tmp_path, text):
    path = tmp_path / "settings.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_the_papers_thresholds_are_the_defaults():
    config = Config()
    assert (config.cluster.eps, config.cluster.min_samples) == (0.01, 1)
    assert config.preprocess.voxel == config.preprocess.spacing == 0.01
    assert config.group.max_volume == 1e-6


def test_settings_are_frozen_and_unknown_ones_refused():
    with pytest.raises(ValidationError, match="frozen"):
        Config().cluster.eps = 1
    with pytest.raises(ValidationError, match="epsilon"):
        ClusterConfig(epsilon=1)


def test_a_file_changes_what_it_names_and_nothing_else(tmp_path):
    config = read_config(toml(tmp_path, "[cluster]\neps = 0.02\n[load]\npurposes = ['proxy']\n"))
    assert config.cluster.eps == 0.02
    assert config.load.purposes == ("proxy",)
    assert config == Config().replace({"cluster.eps": 0.02, "load.purposes": ["proxy"]})


def test_a_file_lies_over_its_base(tmp_path):
    base = Config().replace({"cluster.min_samples": 3})
    config = read_config(toml(tmp_path, "[cluster]\neps = 0.02"), base)
    assert (config.cluster.eps, config.cluster.min_samples) == (0.02, 3)
    assert base.cluster.eps == 0.01, "the base stays as it is"


def test_a_byte_order_mark_is_no_matter(tmp_path):
    assert read_config(toml(tmp_path, "\ufeff[cluster]\neps = 0.02")).cluster.eps == 0.02


def test_an_empty_file_changes_nothing(tmp_path):
    assert read_config(toml(tmp_path, "")) == Config()


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("[cluster]\nepsilon = 1", "no setting is called 'cluster.epsilon'"),
        ("[clusters]\neps = 1", "no setting is called 'clusters'"),
        ("eps = 1", "no setting is called 'eps'"),
        (
            "[cluster]\neps = -1",
            "cluster.eps must be at least 0, not -1 (parts at most this far apart",
        ),
        ("[cluster]\neps = nan", "cluster.eps must be a finite number, not nan"),
        ("[cluster]\neps = 'wide'", "cluster.eps must be a number, not 'wide'"),
        ("[cluster]\neps = '0.01'", "cluster.eps must be a number, not '0.01'"),
        ("[cluster]\neps = true", "cluster.eps must be a number, not true"),
        ("[cluster]\neps = 11", "cluster.eps must be at most 10, not 11"),
        ("[cluster]\nmin_samples = 1.5", "cluster.min_samples must be a whole number, not 1.5"),
        ("[cluster]\nmin_samples = true", "cluster.min_samples must be a whole number, not true"),
        ("[cluster]\ncut_bridges = 1", "cluster.cut_bridges must be true or false, not 1"),
        (
            "[load]\npurposes = 'proxy'",
            "load.purposes must be a list, not 'proxy' (USD purposes that count as geometry",
        ),
        ("[load]\npurposes = ['x']", "must be 'default', 'render', 'proxy' or 'guide', not 'x'"),
        ("[load]\ntime = true", "load.time must be a number, not true"),
        ("[load]\nsides = 1000000", "load.sides must be at most 512, not 1000000"),
        ("[load]\nmax_gap = 1e-12", "load.max_gap must be at least 1e-06, not 1e-12"),
        ("[preprocess]\nspacing = 1e-9", "preprocess.spacing must be at least 0.0001, not 1e-09"),
        ("cluster = 1", "cluster must be a table of names and values, not 1"),
        ("method = 'guess'", "method must be 'exact' or 'paper', not 'guess' (what touches"),
        ("[report]\nwidth = 63", "report.width must be at least 64, not 63"),
        ("[report]\nwidth = 63", "default 1280)"),
        ("[cluster", "not TOML"),
        ("x = " + "[" * 5000, "not TOML"),
    ],
)
def test_a_wrong_setting_is_an_error_that_names_file_and_setting(tmp_path, text, says):
    path = toml(tmp_path, text)
    with pytest.raises(ValueError, match="settings") as caught:
        read_config(path)
    assert says in str(caught.value)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_what_cannot_be_read_is_an_error(tmp_path):
    with pytest.raises(ValueError, match="no such file"):
        read_config(tmp_path / "none.toml")
    with pytest.raises(ValueError, match="can't be read"):
        read_config(tmp_path)
    (tmp_path / "binary.toml").write_bytes(b"\xff\xfe")
    with pytest.raises(ValueError, match="not UTF-8 text"):
        read_config(tmp_path / "binary.toml")


def test_replacing_changes_by_dotted_name():
    config = Config()
    assert config.replace({"cluster.eps": 0.5, "method": "paper"}).cluster.eps == 0.5
    assert config.cluster.eps == 0.01
    assert config.replace({}) == config


@pytest.mark.parametrize(
    "name", ["epsilon", "cluster.epsilon", "clusters.eps", "cluster.eps.x", "", ".", "cluster.", "a.b.c.d"]
)
def test_replacing_an_unknown_setting_names_it(name):
    with pytest.raises(ValueError, match="no setting is called") as caught:
        Config().replace({name: 1})
    assert repr(name) in str(caught.value)


@pytest.mark.parametrize(("name", "value"), [("cluster.eps", -1e-12), ("cluster.eps", math.inf), ("cluster", 3)])
def test_replacing_by_an_impossible_value_names_the_setting(name, value):
    with pytest.raises(ValueError, match=name):
        Config().replace({name: value})


@pytest.mark.parametrize(("name", "value"), [("cluster.eps", 0), ("report.width", 64), ("label.min_confidence", 1)])
def test_values_at_their_limits_are_fine(name, value):
    found = {n: v for n, v, _, _ in describe(Config().replace({name: value}))}
    assert found[name] == value


def test_every_setting_has_a_meaning_and_a_source():
    rows = list(describe(Config()))
    assert len({name for name, *_ in rows}) == len(rows)
    for name, _, meaning, source in rows:
        assert meaning, name
        assert source, name


def test_settings_in_force_survive_the_graphs_json():
    config = Config().replace({"ground.meshes": ["/floor"]})
    assert Config.model_validate(config.model_dump(mode="json")) == config
    assert tomllib.loads("eps = 0.01")["eps"] == config.cluster.eps

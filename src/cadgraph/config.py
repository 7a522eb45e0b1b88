"""All settings, with their meaning and source: one frozen class for each stage.

Settings come from the defaults here, then a TOML file, then flags. ``cadgraph config`` prints those in force.
"""

from __future__ import annotations

import json
import tomllib
import warnings
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from cadgraph._io.limits import CONFIG, read_text_within
from cadgraph._io.text import quoted
from cadgraph._io.validation_messages import expectation

__all__ = [
    "ClusterConfig",
    "Config",
    "GroundConfig",
    "GroupConfig",
    "InspectConfig",
    "LabelConfig",
    "LoadConfig",
    "LvlmConfig",
    "PreprocessConfig",
    "RelateConfig",
    "ReportConfig",
    "Section",
    "config_as_read",
    "describe",
    "read_config",
    "restore_config",
    "to_toml",
]

_PAPER = "paper, section III-B"
_MOST_SHOWN = 100  # characters of a name that a message repeats


def _setting(default: Any, meaning: str, source: str = "ours", **limits: Any) -> Any:
    # TOML and JSON know lists only.
    strict = False if isinstance(default, tuple) else None
    return Field(default, description=meaning, json_schema_extra={"source": source}, strict=strict, **limits)


class Section(BaseModel):
    """A frozen group of settings; an unknown name is an error, and so is a number in quotes or true for a number."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, strict=True)


# Settings that say whether a file is read, and not what of it.
_WHETHER = frozenset({
    "isolate", "strict", "timeout", "memory",
    "max_meshes", "max_prims", "max_shape_triangles", "max_placed_triangles", "max_growth",
})  # fmt: skip


class LoadConfig(Section):
    """How a file is read."""

    purposes: tuple[Literal["default", "render", "proxy", "guide"], ...] = _setting(
        ("default", "render"), "USD purposes that count as geometry", "UsdGeomImageable"
    )
    invisible: bool = _setting(False, "also load what the file hides")
    split_subsets: bool = _setting(False, "split a USD mesh into one mesh for each material subset")
    time: float | None = _setting(None, "USD time code to read; none: the default time, else the first sample")
    isolate: bool = _setting(True, "read files in a process of its own, so that a damaged file can't crash the caller")
    timeout: float = _setting(600.0, "give up on reading a file after this long [s]", gt=0, le=604_800)
    max_gap: float = _setting(
        0.0005,
        "greatest gap between a curved STEP, IFC or RVM surface and its triangles [m]",
        "ours: bolts stay round",
        ge=1e-6,
        le=1,
    )
    max_angle: float = _setting(
        0.35, "greatest angle between neighbouring triangles on a curve of STEP, IFC or RVM [rad]", ge=0.01, le=1.6
    )
    sides: int = _setting(
        32, "sides of a round USD primitive (Cylinder, Sphere...) when turned into triangles", ge=6, le=512
    )
    unit: Literal["m", "cm", "mm", "dm", "km", "in", "ft"] | None = _setting(
        None, "unit of the file's lengths, whatever it says itself; none: its own, or by what its pipes measure"
    )
    scale: float | None = _setting(
        None,
        "multiplies the file's lengths, in the unit it says, else metres; none: as they are",
        gt=0,
        le=1e9,
    )
    strict: bool = _setting(False, "refuse a file of which geometry is lost: damaged, unreadable or not found")
    up: Literal["X", "Y", "Z"] | None = _setting(None, "up axis of the file, whatever it says itself; none: its own")
    granularity: Literal["auto", "node", "primitive"] = _setting(
        "auto",
        "what is one mesh of an RVM file: a node, each primitive, or a primitive only where its node has others below",
    )
    insulation: bool = _setting(False, "also load the insulation and obstruction volumes of an RVM file")
    split: bool = _setting(True, "split one mesh that holds a whole plant into its separate solids")
    max_triangles: int = _setting(
        50_000_000, "cut curved RVM surfaces coarser where the scene would have more triangles", ge=1000
    )
    asset_roots: tuple[str, ...] = _setting(
        (),
        "folders that a USD scene may bring files from, beside its own folder and all below; counted from that folder",
    )
    memory: float | None = _setting(
        None,
        "memory that reading may take [GB], where the system can hold a process to it; none: what the machine has",
        gt=0,
        le=1_000_000,
    )
    max_meshes: int = _setting(5_000_000, "refuse a scene of more meshes, with all its instances", ge=1)
    max_prims: int = _setting(
        20_000_000,
        "refuse a USD scene that its references make more prims of than these, before they are composed",
        ge=1,
    )
    max_shape_triangles: int = _setting(
        200_000_000, "refuse a scene of more triangles, those of each shape counted once", "ours: about 20 GB", ge=1
    )
    max_placed_triangles: int = _setting(
        5_000_000_000, "refuse a scene of more triangles, those of a shape counted for each place that it has", ge=1
    )
    max_growth: float = _setting(
        10.0,
        "refuse a file that grows to more meshes or prims than these for each of its bytes, beyond the first 50,000",
        "ours: an instance takes 4 bytes or more in any real file",
        gt=0,
    )
    metadata: Literal["off", "keep"] = _setting(
        "keep", "what the file says of its parts (types, tags, systems): leave it, or keep it beside the geometry"
    )

    def deciding(self) -> str:
        """The settings that decide what is read, and not only whether it is, as JSON."""
        return self.model_dump_json(exclude=set(_WHETHER))

    @model_validator(mode="after")
    def _one_way_to_measure(self) -> LoadConfig:
        if self.unit is not None and self.scale is not None:
            raise ValueError("a unit (--unit) and a scale (--scale) contradict each other; give one of them")
        return self


class PreprocessConfig(Section):
    """How surfaces become points; for method = 'paper' only."""

    voxel: float = _setting(0.01, "edge of a voxel, to whose centre vertices move [m]", _PAPER, ge=1e-4, le=1)
    spacing: float = _setting(0.01, "distance of the points along the sides of each face [m]", _PAPER, ge=1e-4, le=1)


class InspectConfig(Section):
    """Which odd meshes are looked for; all are kept unless excluded."""

    duplicates: bool = _setting(True, "look for meshes that lie in the place of another one")
    hidden: bool = _setting(True, "look for meshes that can't be seen from anywhere outside")
    exclude: tuple[Literal["duplicate", "hidden"], ...] = _setting(
        (), "leave exact duplicates and never visible meshes out of the graph", "ours; the paper excluded nine by hand"
    )


class GroundConfig(Section):
    """What counts as the ground, which no cluster holds."""

    find: Literal["auto", "named", "none"] = _setting("auto", "find it, take the meshes named below, or assume none")
    meshes: tuple[str, ...] = _setting((), "source paths of the ground (for find = 'named')")
    min_size: float = _setting(2.0, "auto: least extent in both horizontal directions [m]", gt=0)
    max_thickness_ratio: float = _setting(0.1, "auto: greatest height over the lesser horizontal extent", gt=0)
    min_cover: float = _setting(0.95, "auto: least share of everything else's footprint that it covers", gt=0, le=1)
    min_margin: float = _setting(1.1, "auto: least footprint over everything else's footprint, or as follows", gt=0)
    min_overhang: float = _setting(
        0.3, "auto: how far it reaches beyond everything else on each of its sides [m]", ge=0
    )
    max_buried: float = _setting(
        0.0, "auto: greatest share of all other meshes that may lie wholly below it", ge=0, le=1
    )


class GroupConfig(Section):
    """Which small meshes join a larger one."""

    max_volume: float = _setting(1e-6, "a mesh below this volume is small [m3]", _PAPER + " (1 cm3)", ge=0)
    volume: Literal["obb", "aabb", "mesh"] = _setting(
        "obb", "which volume decides: oriented box, axis-aligned box, or enclosed (box where open)"
    )
    proximity: float = _setting(
        0.01,
        "a small mesh joins the nearest larger one within this distance [m]",
        "ours; the paper gives no figure",
        ge=0,
        le=10,
    )


class ClusterConfig(Section):
    """What touches, and what is one structure."""

    eps: float = _setting(0.01, "parts at most this far apart are adjacent [m]", _PAPER + " (DBSCAN eps)", ge=0, le=10)
    bridge_gap: float = _setting(
        0.002, "a single contact over at least this gap is a weak bridge between two structures [m]", ge=0
    )
    bridge_parts: int = _setting(5, "least number of parts on both sides of a weak bridge", ge=1)
    cut_bridges: bool = _setting(False, "take weak bridges for no contact; off: only list them in diagnostics")
    min_samples: int = _setting(1, "DBSCAN's least number of neighbours, itself included", _PAPER, ge=1)


class LabelConfig(Section):
    """How parts get their labels."""

    labeler: Literal["embedded", "none", "own"] = _setting(
        "embedded", "the trained network in the package, or none; own, in a graph: one that a program gave"
    )
    min_confidence: float | None = _setting(
        None,
        "a label below this confidence is only a guess; none: the labeler's own threshold",
        "ours: docs/labeler.md",
        ge=0,
        le=1,
    )
    sure_confidence: float | None = _setting(
        None,
        "a label below this confidence is marked as likely, not sure; none: the labeler's own threshold",
        "ours: docs/labeler.md",
        ge=0,
        le=1,
    )
    overrule: bool = _setting(True, "labels from outside replace those of the labeler; off: they only fill gaps")
    catalogs: tuple[str, ...] = _setting(
        (), "catalogues of your own parts, made by 'cadgraph catalog add'; the first that knows a shape counts"
    )
    use_metadata: bool = _setting(
        False, "what the file says of its parts (classes, types, names) counts beside geometry, each by its trust"
    )
    words: str = _setting(
        "", "words in names and their labels (YAML), beside the built-in ones; empty: these alone", max_length=4096
    )

    @model_validator(mode="before")
    @classmethod
    def _read_use_names(cls, values: Any) -> Any:
        # Until facts were read, names alone could count.
        if not isinstance(values, Mapping) or "use_names" not in values:
            return values
        rest = {name: value for name, value in values.items() if name != "use_names"}
        if values["use_names"] is False:
            return rest
        if values["use_names"] is True:
            warnings.warn("label.use_names is now label.use_metadata; taken as that", DeprecationWarning, stacklevel=2)
            return {**rest, "use_metadata": True}
        return {**rest, "use_metadata": values["use_names"]}


class LvlmConfig(Section):
    """How a vision-language model is asked; keys come from the environment only."""

    ask: Literal["never", "unsure", "all"] = _setting(
        "never", "ask it never, where the embedded labeler is unsure, or about all parts instead of that"
    )
    model: str = _setting("gpt-4o", "name of the model, as the server knows it", "paper, section III", max_length=200)
    base_url: str = _setting(
        "", "address of a compatible server (vLLM, Ollama, Azure...); empty: OpenAI", max_length=500
    )
    key_variable: str = _setting("OPENAI_API_KEY", "environment variable that holds the key", pattern=r"^\w{1,100}$")
    per: Literal["shape", "part"] = _setting(
        "shape", "one question for each shape and role, or for each part as the paper asks"
    )
    votes: int = _setting(1, "members of a kind that are asked about; the majority counts", ge=1, le=15)
    hints: bool = _setting(False, "tell it what geometry knows: form, repeats, labels of neighbours")
    staged: bool = _setting(True, "ask about small parts after large ones, with the labels of what they touch")
    below: float = _setting(0.8, "ask = 'unsure': where the embedded labeler's confidence is below", ge=0, le=1)
    again_below: float = _setting(
        0.5, "answers below this confidence are asked again with what geometry knows; 0: never", ge=0, le=1
    )
    repair: bool = _setting(True, "let sizes correct gaskets and flanges", "ASME B16.20, B16.21, EN 1092-1")
    paper_views: bool = _setting(False, "plain pictures from three sides around, as in the paper")
    size: int = _setting(512, "side of a picture [px]", "paper, section III-B", ge=128, le=2048)
    detail: Literal["low", "high", "auto"] = _setting("high", "how closely the model looks; low costs a third")
    max_questions: int | None = _setting(None, "at most so many questions in a run, those that help most", ge=0)
    max_cost: float | None = _setting(None, "at most so many US dollars in a run, by the price table", ge=0)
    prices: str = _setting("", "price table (YAML); empty: the built-in one", max_length=4096)
    accuracy: str = _setting("", "how often models are right (YAML); empty: the built-in table", max_length=4096)
    profiles: str = _setting(
        "", "table of what models and servers understand (YAML); empty: the built-in one", max_length=4096
    )
    context: int | None = _setting(
        None, "tokens that the server leaves to a question with its answer; none: by the table of profiles", ge=256
    )
    pictures: int | None = _setting(
        None,
        "pictures of a message at most, the rest is tiled into sheets; none: by the table of profiles",
        ge=1,
        le=64,
    )
    cache: str = _setting(
        "", "file of answers that were given; empty: lvlm/answers.sqlite in the output folder", max_length=4096
    )
    concurrency: int = _setting(8, "questions at a time", ge=1, le=256)
    timeout: float = _setting(
        120.0, "give up on one try after this long [s], on a server that answers nothing after twice that", gt=0
    )
    wait: float = _setting(
        300.0, "the longest that is waited where a server asks for it [s]; for longer, the run ends and says so", ge=0
    )
    retries: int = _setting(5, "further tries after 429, 5xx, a timeout or a broken connection", ge=0, le=20)
    max_answer_tokens: int = _setting(600, "greatest length of an answer [tokens]", ge=50, le=20000)
    temperature: float | None = _setting(0.0, "of the model; none: its own", ge=0, le=2)
    structured: Literal["auto", "json_schema", "json_object", "none"] = _setting(
        "auto", "how the server is held to a form; auto: the strictest that it knows"
    )


class RelateConfig(Section):
    """What counts as a connection along the pipes."""

    bridge: float = _setting(
        0.012,
        "ends of pipes that face each other over at most this gap are joined [m]",
        "ours: see functional.md",
        ge=0,
    )
    leg: float = _setting(
        0.6, "a gauge stands in the run that it is tapped into where the way to it is at most this long [m]", ge=0
    )
    flow: tuple[str, ...] = _setting((), "flow directions that are known: 'P-001 -> T-001', tags of units or nodes")
    use_metadata: bool = _setting(False, "let what the file says of joints and flow count beside geometry")


class ReportConfig(Section):
    """The pictures and the page."""

    width: int = _setting(
        1280, "width of a picture [px]; those that stand side by side have three quarters of it", ge=64, le=8192
    )
    height: int = _setting(800, "height of a picture [px]", ge=64, le=8192)
    samples: int = _setting(3, "anti-aliasing: rays along each side of a pixel", ge=1, le=8)
    max_systems: int = _setting(12, "at most so many structures with pipes are drawn, the largest first", ge=0, le=1000)


class GraphConfig(Section):
    """How the graph is written."""

    shard_above: int = _setting(
        200_000, "kinds of nodes and edges of more rows than that go into shards beside graph.json", ge=1
    )


class Config(Section):
    """All settings."""

    method: Literal["exact", "paper"] = _setting(
        "exact", "what touches: by the exact distance of surfaces, or by points on a voxel grid as the paper does"
    )
    load: LoadConfig = LoadConfig()
    preprocess: PreprocessConfig = PreprocessConfig()
    inspect: InspectConfig = InspectConfig()
    ground: GroundConfig = GroundConfig()
    group: GroupConfig = GroupConfig()
    cluster: ClusterConfig = ClusterConfig()
    label: LabelConfig = LabelConfig()
    lvlm: LvlmConfig = LvlmConfig()
    relate: RelateConfig = RelateConfig()
    graph: GraphConfig = GraphConfig()
    report: ReportConfig = ReportConfig()

    def replace(self, changes: Mapping[str, Any]) -> Config:
        """This configuration with some settings changed.

        Args:
            changes: dotted names and values, ``{"cluster.eps": 0.02}``.

        Raises:
            ValueError: a name is unknown or a value out of its limits.
        """
        if not isinstance(changes, Mapping) or not all(isinstance(name, str) for name in changes):
            raise ValueError("give values by dotted name, {'cluster.eps': 0.02}")
        tree = self.model_dump()
        for name, value in changes.items():
            at: Any = tree
            *sections, last = name.split(".")
            for section in sections:
                at = at.get(section) if isinstance(at, dict) else None
                if not isinstance(at, dict):
                    raise ValueError(
                        f"no setting is called {quoted(name, _MOST_SHOWN)}; 'cadgraph config' lists them all"
                    )
            at[last] = value
        return _validated(tree, "settings")


def read_config(path: str | Path, base: Config | None = None) -> Config:
    """Reads a TOML file over a base.

    Raises:
        ValueError: the file can't be read, is no TOML, or holds an unknown or impossible setting.
    """
    text = read_text_within(path, CONFIG, ValueError, "give a TOML file as 'cadgraph config' prints it")
    try:
        tree = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise ValueError(f"{path}: not TOML ({error}); 'cadgraph config' prints a file to start from") from error
    whole = (base or Config()).model_dump()
    for name, value in tree.items():
        if isinstance(value, dict) and isinstance(whole.get(name), dict):
            whole[name].update(value)
        else:
            whole[name] = value
    return _validated(whole, str(path))


def config_as_read(config: Config, read_with: str) -> Config:
    """The settings with those that a scene was read with.

    Args:
        config: all settings; of those that decide what is read, each must be as it was then or its default.
        read_with: what ``LoadConfig.deciding`` said of the settings that it was read with; empty: not known.

    Raises:
        ValueError: one of them is another, which would be kept as if the scene had been read so.
    """
    if not read_with:
        return config
    used, plain = LoadConfig.model_validate_json(read_with), LoadConfig()
    changes: dict[str, Any] = {}
    for name in used.model_fields_set:
        wanted, was = getattr(config.load, name), getattr(used, name)
        if wanted == was:
            continue
        if wanted != getattr(plain, name):
            raise ValueError(
                f"load.{name} is {wanted!r} here, but the scene was read with {was!r}: give it where the scene is "
                "read, load(path, config.load)"
            )
        changes[name] = was
    return config.model_copy(update={"load": config.load.model_copy(update=changes)}) if changes else config


def restore_config(tree: Mapping[str, Any]) -> Config:
    """The settings that a graph keeps; the defaults where it says nothing.

    Args:
        tree: names and values, those of a section under its name, as ``graph.json`` has them under ``config``.

    Raises:
        ValueError: a name is not known any more, or a value out of its limits.
    """
    flat: dict[str, Any] = {}
    for name, value in tree.items():
        flat |= {f"{name}.{inner}": each for inner, each in value.items()} if isinstance(value, dict) else {name: value}
    return Config().replace(flat)


def describe(config: Config) -> Iterator[tuple[str, Any, str, str]]:
    """Every setting as (dotted name, value, meaning, source), in order."""
    for name, field in Config.model_fields.items():
        value = getattr(config, name)
        if not isinstance(value, Section):
            yield name, value, field.description or "", _source_of(field)
            continue
        for inner, inner_field in type(value).model_fields.items():
            yield f"{name}.{inner}", getattr(value, inner), inner_field.description or "", _source_of(inner_field)


def _source_of(field: Any) -> str:
    extra = field.json_schema_extra
    return str(extra["source"]) if isinstance(extra, dict) else ""


def _validated(tree: Mapping[str, Any], where: str) -> Config:
    try:
        return Config.model_validate(tree)
    except ValidationError as error:
        first = error.errors()[0]
        name = ".".join(str(step) for step in first["loc"])
        if first["type"] == "extra_forbidden":
            raise ValueError(
                f"{where}: no setting is called {quoted(name, _MOST_SHOWN)}; 'cadgraph config' lists them all"
            ) from None
        raise ValueError(f"{where}: {name} {expectation(first)}{_meaning_of(first['loc'])}") from None


def _meaning_of(place: tuple[str | int, ...]) -> str:
    """What a setting is for and its default, in brackets; empty for a whole section."""
    names = [str(step) for step in place if isinstance(step, str)]
    for name, value, meaning, _ in describe(Config()):
        if names and name == ".".join(names[: name.count(".") + 1]):
            return f" ({meaning}; {'default ' + _toml(value) if value is not None else 'none by default'})"
    return ""


def to_toml(config: Config) -> str:
    """All settings as a TOML file that ``read_config`` takes, each with its meaning and source as a comment."""
    lines: list[str] = []
    section = ""
    for name, value, meaning, source in describe(config):
        *above, last = name.split(".")
        if above and above[0] != section:
            section = above[0]
            lines += ["", f"[{section}]"]
        lines.append(f"# {meaning} ({source})")
        lines.append(f"{last} = {_toml(value)}" if value is not None else f"# {last} =")
    return "\n".join(lines) + "\n"


def _toml(value: Any) -> str:
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(item) for item in value) + "]"
    return json.dumps(value, ensure_ascii=False)  # TOML writes text, numbers and booleans as JSON does

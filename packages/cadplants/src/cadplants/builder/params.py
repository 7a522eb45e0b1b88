"""Parameters of devices: drawn at random or given, checked, and written down.

A family is a class of ``Params``. Each of its fields says how it is drawn, what it means and in which unit:

    class Siphon(Params):
        loops: int = whole(1, 3, "turns of the coil")
        bend: float = between(0.04, 0.06, "radius of the coil", "m")
        valve: bool = chance(0.5, "a needle valve sits on it")
        knob: float = between(0.02, 0.04, "of the needle valve's knob", "m", when=lambda p: p.valve)

``Siphon.draw(source)`` draws all fields, ``Siphon.draw(source, loops=2)`` those that are not given. What is built from
them is a function of them alone.
"""

from __future__ import annotations

import dataclasses
import zlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any, ClassVar, Protocol, TypeVar, dataclass_transform

import numpy as np

__all__ = [
    "Apart",
    "Field",
    "OneStream",
    "Params",
    "Source",
    "When",
    "among",
    "between",
    "chance",
    "each",
    "given",
    "nested",
    "several",
    "spread",
    "styled",
    "weighted",
    "whole",
]

_DIGITS = 9  # of numbers that are written down
_ROUNDED = 10.0**-_DIGITS
_DEPENDS = "by the fields before"
_TRIES = 300  # draws of a piece that is made anew, until one is of its class; ours: few classes are as rare as this

Rng = np.random.Generator
When = Callable[[Any], bool]
T = TypeVar("T")
P = TypeVar("P", bound="Params")


class Source(Protocol):
    """Where random numbers come from, field by field."""

    @property
    def rng(self) -> Rng:
        """The generator of this field."""
        ...

    def of(self, name: str) -> Source:
        """The source of a field within this one."""
        ...


@dataclass(frozen=True)
class OneStream:
    """One generator for all fields, in their order."""

    rng: Rng

    def of(self, name: str) -> Source:
        """Itself, whatever the name."""
        return self


class Apart:
    """A generator for each field by its name, so that a field more changes no other.

    Args:
        path: a seed, then whatever tells one device from another.
    """

    def __init__(self, *path: int) -> None:
        self._path = path

    @property
    def rng(self) -> Rng:
        """A new generator, which always begins anew."""
        return np.random.default_rng(self._path)

    def of(self, name: str) -> Source:
        """The source of a field, by the field's name."""
        return Apart(*self._path, zlib.crc32(name.encode()))


@dataclass(frozen=True)
class Field:
    """How a parameter is drawn and checked.

    Args:
        about: what it means: a noun phrase.
        unit: ``m``, ``rad``...; "" of counts, choices and ratios.
        limits: what it can be, for people.
        sample: draws it, given its source and the fields before it.
        accept: what a given value (maybe text) stands for; raises ``ValueError`` where it can't be.
        when: whether the device has it at all, by the fields before it; None: always.
        otherwise: its value where it has not.
        of_style: whether the style says it.
        piece: draws a piece with parameters of its own, given its source, the fields before, and what of it a user
            gives and the rest of the device sets; None of what has none.
        limits_by: what it can be, for people, by the fields before; None where that is always the same.
    """

    about: str
    unit: str
    limits: str
    sample: Callable[[Source, Any], Any]
    accept: Callable[[Any, Any], Any]
    when: When | None = None
    otherwise: Any = None
    of_style: bool = False
    piece: Callable[[Source, Any, Mapping[str, Any], Mapping[str, Any]], Any] | None = None
    limits_by: Callable[[Any], str] | None = None

    def limits_here(self, drawn: Any) -> str:
        """What it can be beside the other fields of what was drawn, for people."""
        if self.limits_by is None:
            return self.limits
        if self.when is not None and not self.when(drawn):
            return "as the rest has it"
        return self.limits_by(drawn)


def _field(spec: Field, default: Any = dataclasses.MISSING) -> Any:
    return dataclasses.field(default=default, metadata={"spec": spec})


def between(
    low: float | Callable[[Any], float],
    high: float | Callable[[Any], float],
    about: str,
    unit: str = "",
    *,
    when: When | None = None,
    otherwise: float = 0.0,
    digits: int = _DIGITS,
) -> float:
    """A number, all between two as likely; these may follow from the fields before.

    Args:
        low: the least.
        high: the most.
        about: what it means: a noun phrase.
        unit: of it.
        when: whether the device has it.
        otherwise: its value where it has not.
        digits: that a draw is rounded to, if fewer than are written down.
    """

    def bounds(before: Any) -> tuple[float, float]:
        return (low(before) if callable(low) else low), (high(before) if callable(high) else high)

    def accept(value: Any, before: Any) -> float:
        return _within(value, *bounds(before))

    depends = callable(low) or callable(high)
    limits = _DEPENDS if depends else f"{low:g} to {high:g}"
    here = (lambda before: "{:.4g} to {:.4g}".format(*bounds(before))) if depends else None

    def draw(source: Source, before: Any) -> float:
        number = float(source.rng.uniform(*bounds(before)))
        return round(number, digits) if digits < _DIGITS else number

    return _field(Field(about, unit, limits, draw, accept, when, otherwise, limits_by=here))  # type: ignore[no-any-return]


def _within(value: Any, least: float, most: float) -> float:
    """A number between two; what was rounded beyond one of them when it was written down is that one."""
    number = float(value)
    if not np.isfinite(number):
        raise ValueError("give a number")
    if not least - _ROUNDED <= number <= most + _ROUNDED:
        raise ValueError(f"give {least:g} to {most:g}")
    return min(max(number, least), most)


def spread(low: float, high: float, about: str, unit: str = "", *, most: float = np.inf, scale: float = 1.0) -> float:
    """A number whose logarithm is drawn evenly, so that small ones are as usual as large ones.

    Args:
        low: the least that is drawn.
        high: the most that is drawn.
        about: what it means: a noun phrase.
        unit: of it.
        most: what is drawn above becomes this.
        scale: what the result is then multiplied by.
    """
    least, largest = scale * min(low, most), scale * min(high, most)

    def sample(source: Source, _: Any) -> float:
        return scale * min(float(np.exp(source.rng.uniform(np.log(low), np.log(high)))), most)

    def accept(value: Any, _: Any) -> float:
        return _within(value, least, largest)

    return _field(Field(about, unit, f"{least:g} to {largest:g}", sample, accept))  # type: ignore[no-any-return]


def whole(low: int, high: int, about: str, *, when: When | None = None, otherwise: int = 0) -> int:
    """A whole number, from ``low`` to ``high`` with both."""

    def accept(value: Any, _: Any) -> int:
        number = int(value)
        if not low <= number <= high:
            raise ValueError(f"give {low} to {high}")
        return number

    limits = f"{low} to {high}"
    return _field(Field(about, "", limits, lambda s, _: int(s.rng.integers(low, high + 1)), accept, when, otherwise))  # type: ignore[no-any-return]


def chance(share: float, about: str, *, when: When | None = None, otherwise: bool = False) -> bool:
    """Whether something is there, or is so, that is so this often."""
    limits, draw = f"yes or no, {share:.0%} yes", lambda s, _: bool(s.rng.random() < share)
    return _field(Field(about, "", limits, draw, lambda value, _: _yes_or_no(value), when, otherwise))  # type: ignore[no-any-return]


def _yes_or_no(value: Any) -> bool:
    text = str(value).lower()
    if text not in ("true", "false", "yes", "no", "1", "0"):
        raise ValueError("give yes or no")
    return text in ("true", "yes", "1")


def among(
    items: Sequence[T] | Callable[[Any], Sequence[T]],
    about: str,
    unit: str = "",
    *,
    when: When | None = None,
    otherwise: T | None = None,
) -> T:
    """One of some things, all as likely; what stands twice is twice as likely.

    Args:
        items: the things, or what gives them by the fields before.
        about: what it means.
        unit: of numbers.
        when: whether the device has it.
        otherwise: its value where it has not.
    """
    choices: Callable[[Any], Sequence[T]] = items if callable(items) else lambda _: items

    def sample(source: Source, before: Any) -> T:
        some = choices(before)
        return some[int(source.rng.integers(len(some)))]

    def accept(value: Any, before: Any) -> T:
        some = choices(before)
        for item in some:
            if _is_told(value, item):
                return item
        if all(isinstance(item, float) for item in some):
            # A size that no draw takes may be asked for, as far as it lies among those that draws take.
            number, least, most = float(value), min(some), max(some)  # type: ignore[type-var]
            if least <= number <= most:  # type: ignore[operator]
                return number  # type: ignore[return-value]
            raise ValueError(f"give {least:g} to {most:g}")
        raise ValueError(f"give {', '.join(map(_told, dict.fromkeys(some)))}")

    def listed(some: Sequence[T]) -> str:
        return ", ".join(map(_told, dict.fromkeys(some)))

    here = (lambda before: listed(choices(before))) if callable(items) else None
    limits = _DEPENDS if callable(items) else listed(items)
    return _field(Field(about, unit, limits, sample, accept, when, otherwise, limits_by=here))  # type: ignore[no-any-return]


def weighted(about: str, *, when: When | None = None, otherwise: str = "", **shares: float) -> str:
    """One of some words, each as likely as its share says; the last takes what is left."""
    names, bounds = tuple(shares), np.cumsum(list(shares.values()))[:-1]

    def sample(source: Source, _: Any) -> str:
        return names[int(np.searchsorted(bounds, source.rng.random(), side="right"))].replace("_", " ")

    def accept(value: Any, _: Any) -> str:
        if str(value).replace(" ", "_") not in names:
            raise ValueError(f"give {', '.join(names).replace('_', ' ')}")
        return str(value)

    limits = ", ".join(f"{name.replace('_', ' ')} {share:.0%}" for name, share in shares.items())
    return _field(Field(about, "", limits, sample, accept, when, otherwise))  # type: ignore[no-any-return]


def given(
    default: T,
    about: str,
    unit: str = "",
    *,
    choices: Sequence[T] = (),
    low: float | Callable[[Any], float] = -np.inf,
    high: float | Callable[[Any], float] = np.inf,
) -> T:
    """What is not drawn but said by whoever asks for the device: a nominal size, a height.

    Args:
        default: its value where nobody says.
        about: what it means: a noun phrase.
        unit: of it.
        choices: what it can be; anything like the default where there are none.
        low: the least of a number that is no whole one, maybe by the fields before.
        high: the most of it.
    """
    kind: Any = _yes_or_no if isinstance(default, bool) else type(default)

    def accept(value: Any, before: Any) -> T:
        told: Any = kind(value)
        if choices and told not in choices:
            raise ValueError(f"give {', '.join(map(_told, choices))}")
        if isinstance(told, float):
            told = _within(told, *(end(before) if callable(end) else end for end in (low, high)))
        return told  # type: ignore[no-any-return]

    limits = f"{', '.join(map(_told, choices))}; " if choices else ""
    if not callable(low) and not callable(high) and np.isfinite([low, high]).all():
        limits += f"{low:g} to {high:g}; "
    limits += f"{_told(default) or 'nothing'} unless given"
    return _field(Field(about, unit, limits, lambda *_: default, accept), default)  # type: ignore[no-any-return]


def styled(default: T, about: str) -> T:
    """What the style says under the field's own name, of which other fields depend: ``hollow``, ``fasteners``."""
    return _field(Field(about, "", "as the style has it", lambda *_: default, lambda v, _: v, of_style=True))  # type: ignore[no-any-return]


def nested(
    kind: type[P] | Callable[[Source, Any], type[P]],
    about: str,
    *,
    fixed: Callable[[Any], Mapping[str, Any]] = lambda _: {},
    stream: Callable[[Source, Any], Source | Rng] = lambda source, _: source,
    when: When | None = None,
    otherwise: P | None = None,
) -> P:
    """A piece with parameters of its own.

    Args:
        kind: its class, or what chooses it by the fields before or by a draw.
        about: what it is.
        fixed: what the fields before set of it, by name.
        stream: where its parameters are drawn from, given the field's own source and the fields before.
        when: whether the device has it.
        otherwise: what it is where it has not.
    """

    def draw(source: Source, before: Any, given: Mapping[str, Any], said: Mapping[str, Any]) -> Any:
        chosen: Any = kind if isinstance(kind, type) else kind(source, before)
        return chosen.draw(stream(source, before), {**fixed(before), **said}, **given)

    def accept(value: Any, before: Any) -> P:
        if isinstance(value, Params):
            return value  # type: ignore[return-value]
        raise ValueError("give its own fields, as name.field=value")

    def sample(source: Source, before: Any) -> Any:
        return draw(source, before, {}, {})

    return _field(Field(about, "", "see its own", sample, accept, when, otherwise, piece=draw))  # type: ignore[no-any-return]


def several(
    draw: Callable[[Rng, Any], T],
    count: int | Callable[[Any], int],
    about: str,
    unit: str = "",
    *,
    when: When | None = None,
) -> tuple[T, ...]:
    """As many values as are said, or as the fields before say, one after the other."""
    return each(lambda rng, before, _: draw(rng, before), count, about, unit, when=when)


def each(
    draw: Callable[[Rng, Any, tuple[T, ...]], T],
    count: int | Callable[[Any], int],
    about: str,
    unit: str = "",
    *,
    when: When | None = None,
) -> tuple[T, ...]:
    """As ``several``, but what is drawn may follow from those before: how many they are, what they were."""
    how_many: Callable[[Any], int] = count if callable(count) else lambda _: count

    def sample(source: Source, before: Any) -> tuple[T, ...]:
        rng = source.rng
        found: tuple[T, ...] = ()
        for _ in range(how_many(before)):
            found = (*found, draw(rng, before, found))
        return found

    def accept(value: Any, before: Any) -> tuple[T, ...]:
        if not isinstance(value, (list, tuple)) or len(value) != how_many(before):
            raise ValueError(f"give {how_many(before)} values")
        return tuple(value)

    return _field(Field(about, unit, "one each", sample, accept, when, ()))  # type: ignore[no-any-return]


@dataclass_transform(
    kw_only_default=True,
    frozen_default=True,
    field_specifiers=(between, whole, chance, among, weighted, given, nested, several, each, spread, styled),
)
class Params:
    """The parameters of a device or a piece of one; every subclass is a frozen dataclass of its fields.

    It becomes one when it is first used: there are a thousand, and a dataclass takes about a millisecond to make.
    """

    kind: ClassVar[str] = ""
    """What the piece is called where it is one of several: ``lever``."""
    _fields: ClassVar[Mapping[str, Field]]

    def __new__(cls: type[P], **values: Any) -> P:
        """An empty one, which ``__init__`` fills."""
        _make_dataclass(cls)
        return super().__new__(cls)

    @classmethod
    def fields(cls) -> Mapping[str, Field]:
        """How each parameter is drawn, by its name."""
        if "_fields" not in cls.__dict__:
            _make_dataclass(cls)
            cls._fields = {f.name: f.metadata["spec"] for f in dataclasses.fields(cls)}  # type: ignore[arg-type]
        return cls._fields

    @classmethod
    def draw(cls: type[P], source: Source | Rng, fixed: Mapping[str, Any] | None = None, **given: Any) -> P:
        """Draws what is not given.

        Args:
            source: of random numbers; of a plain generator all fields are drawn one after the other.
            fixed: values by name that the one who builds with the piece sets, whatever a draw could be.
            given: values by name that a user wants, of pieces as ``"drive.length"``, of one of several as
                ``"nozzles.0.size"``, the rest of which stays as drawn; text is understood.

        Raises:
            ValueError: a name is not known, or a given value can't be.
        """
        source = OneStream(source) if isinstance(source, np.random.Generator) else source
        specs, fixed = cls.fields(), fixed or {}
        unknown = [key for key in (*given, *fixed) if key.split(".")[0] not in specs]
        if unknown:
            raise ValueError(f"{unknown[0]}: no parameter; there are {', '.join(specs) or 'none'}")
        before = SimpleNamespace()
        values = vars(before)
        for name, spec in specs.items():
            values[name] = _value(name, spec, source, before, given, fixed)
        return cls(**values)

    def rows(self, within: str = "", here: bool = False) -> list[tuple[str, str, str, str]]:
        """What people read of all parameters: name, value, what it can be, what it is; pieces' own below them.

        Args:
            within: name of the piece that these are of, for their names.
            here: whether what they can be is said for this draw, where it follows from fields before.
        """
        found = []
        for name, spec in self.fields().items():
            limits = spec.limits_here(self) if here else spec.limits
            value, unit = getattr(self, name), f" [{spec.unit}]" if spec.unit else ""
            if isinstance(value, Params):
                # Of a piece that can be of several kinds, which one it is.
                found += [(within + name, value.kind, limits, spec.about)] if value.kind else []
                found += value.rows(f"{within}{name}.", here)
            elif isinstance(value, tuple) and value and isinstance(value[0], Params):
                for k, one in enumerate(value):
                    found += [(f"{within}{name}.{k}", one.kind, limits, spec.about)] if one.kind else []
                    found += one.rows(f"{within}{name}.{k}.", here)
            elif value is not None:
                found.append((within + name, _told(value), limits, spec.about + unit))
        return found

    @classmethod
    def from_json(cls: type[P], said: Mapping[str, Any]) -> P:
        """What ``to_json`` has written down; its numbers are as exact as they stand there, to nine digits.

        Args:
            said: all parameters, pieces as objects of their own.

        Raises:
            ValueError: a parameter is missing, or there is none of a name.
        """
        specs = cls.fields()
        other = sorted(set(specs) ^ (set(said) - ({"kind"} if cls.kind else set())))
        if other:
            what = "is missing" if other[0] in specs else f"no parameter; there are {', '.join(specs) or 'none'}"
            raise ValueError(f"{other[0]}: {what}")
        before = SimpleNamespace()
        for name, spec in specs.items():
            try:
                vars(before)[name] = _restored(name, spec, said[name], before)
            except (TypeError, AttributeError) as error:
                raise ValueError(f"{name}={said[name]}: no value of it ({error})") from None
        return cls(**vars(before))

    def to_json(self) -> dict[str, Any]:
        """All parameters as plain JSON values, pieces as objects of their own."""
        said = {"kind": self.kind} if self.kind else {}
        return said | {name: _plain(getattr(self, name)) for name in self.fields()}


def _value(
    name: str, spec: Field, source: Source, before: Any, given: Mapping[str, Any], fixed: Mapping[str, Any]
) -> Any:
    """A field's value: as it is set, as a user gives it, or as it is drawn; of a piece maybe a part of that."""
    told, placed = _below(name, given), _below(name, fixed)
    if name in fixed:
        _refuse_others(name, given, fixed[name], "as the style or the rest of the device has it")
        value = fixed[name]
    elif spec.when is not None and not spec.when(before):
        _refuse_others(name, given, spec.otherwise, "as other parameters rule it out")
        value = spec.otherwise
    elif name in given:
        value = _accepted(name, spec, given[name], before)
    elif spec.piece is not None and (told or placed):
        return _drawn(name, spec.piece, source.of(name), before, told, placed)
    else:
        value = spec.sample(source.of(name), before)
    return _altered(name, value, told, placed) if told or placed else value


def _altered(name: str, value: Any, told: Mapping[str, Any], placed: Mapping[str, Any]) -> Any:
    """A value in which parameters of pieces are as a user gives them, where it has any."""
    if placed or not _pieces_in(value):
        first = next(iter({**told, **placed}))
        raise ValueError(f"{name}.{first}: the device has no {name} with parameters of its own")
    return _drawn(name, _with, value, told)


def _restored(name: str, spec: Field, told: Any, before: Any) -> Any:
    """A value as it was before it was written down; which class a piece is of is found by drawing such pieces."""
    classes: dict[tuple[str, frozenset[str]], type[Params]] = {}
    tries = 0

    def class_of(said: Mapping[str, Any]) -> type[Params]:
        nonlocal tries
        sign = _sign(said)
        while sign not in classes:
            tries += 1
            if tries > _TRIES:
                raise ValueError(f"{name}: no piece of it has the parameters {', '.join(said) or 'none'}")
            # As plants draw, and each field apart, as single devices do: which pieces come differs.
            source: Source = Apart(tries) if tries % 2 else OneStream(np.random.default_rng(tries))
            for one in _pieces_in(spec.sample(source, before)):
                classes.setdefault(_sign(one.to_json()), type(one))
        return classes[sign]

    def restored(value: Any) -> Any:
        if isinstance(value, Mapping):
            return class_of(value).from_json(value)
        return tuple(map(restored, value)) if isinstance(value, (list, tuple)) else value

    return restored(told)


def _sign(said: Mapping[str, Any]) -> tuple[str, frozenset[str]]:
    """What tells the class of a piece that is written down: what it is called and which parameters it has."""
    return str(said.get("kind", "")), frozenset(said)


def _pieces_in(value: Any) -> list[Params]:
    """The pieces that a drawn value is or has, but for those within them."""
    if isinstance(value, Params):
        return [value]
    return [piece for one in value for piece in _pieces_in(one)] if isinstance(value, tuple) else []


def _make_dataclass(cls: type) -> None:
    """Makes a class a dataclass, after those that it derives from, unless it is one."""
    if "__dataclass_fields__" in cls.__dict__:
        return
    for one in reversed(cls.__mro__):
        if issubclass(one, Params) and one is not Params and "__dataclass_fields__" not in one.__dict__:
            dataclass(frozen=True, kw_only=True)(one)


def _below(name: str, given: Mapping[str, Any]) -> dict[str, Any]:
    """What is given of a piece, by the piece's own names."""
    return {key.split(".", 1)[1]: value for key, value in given.items() if key.startswith(f"{name}.")}


def _accepted(name: str, spec: Field, value: Any, before: Any) -> Any:
    try:
        return spec.accept(value, before)
    except (TypeError, ValueError) as error:
        # What is no number at all is told what a number could be.
        said = str(error) if str(error).startswith("give ") else f"give {spec.limits}"
        raise ValueError(f"{name}={value}: {said}") from None


def _with(value: Any, told: Mapping[str, Any]) -> Any:
    """A piece, or several by their numbers, with some of its parameters as they are told."""
    parts: dict[str, dict[str, Any]] = {}
    for key, one in told.items():
        head, _, rest = key.partition(".")
        parts.setdefault(head, {})[rest] = one
    if isinstance(value, tuple):
        found = list(value)
        for head, inner in parts.items():
            if not head.isdecimal() or int(head) >= len(found) or "" in inner:
                raise ValueError(f"{head}: give one of 0 to {len(found) - 1} and a parameter of it, as 0.name")
            found[int(head)] = _drawn(head, _with, found[int(head)], inner)
        return tuple(found)
    if not isinstance(value, Params):
        raise ValueError(f"{next(iter(told))}: no parameter; there are none")
    specs, before = value.fields(), SimpleNamespace(**{name: getattr(value, name) for name in value.fields()})
    for head, inner in parts.items():
        if head not in specs:
            raise ValueError(f"{head}: no parameter; there are {', '.join(specs) or 'none'}")
        spec, own = specs[head], getattr(before, head)
        if spec.when is not None and not spec.when(before):
            raise ValueError(f"{head}: the rest of it rules that out")
        vars(before)[head] = (
            _accepted(head, spec, inner[""], before) if "" in inner else _drawn(head, _with, own, inner)
        )
    return type(value)(**vars(before))


def _drawn(name: str, piece: Callable[..., Any], *args: Any) -> Any:
    try:
        return piece(*args)
    except ValueError as error:
        raise ValueError(f"{name}.{error}") from None


def _refuse_others(name: str, given: Mapping[str, Any], only: Any, why: str) -> None:
    """Refuses what is given where a parameter can be one thing only."""
    if name in given and not _is_told(given[name], only):
        raise ValueError(f"{name}={given[name]}: it is {_told(only)}, {why}")


def _is_told(value: Any, item: Any) -> bool:
    """Whether a value that is given, maybe as text or as a list, stands for something."""
    value = tuple(value) if isinstance(value, list) else value
    return bool(value == item) or str(value) in (str(item), _told(item))


def _told(value: Any) -> str:
    if isinstance(value, tuple):
        return ", ".join(map(_told, value))
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def _plain(value: Any) -> Any:
    if isinstance(value, Params):
        return value.to_json()
    if isinstance(value, (tuple, list)):
        return [_plain(one) for one in value]
    if isinstance(value, (bool, str)) or value is None:
        return value
    return int(value) if isinstance(value, (int, np.integer)) else round(float(value), _DIGITS)

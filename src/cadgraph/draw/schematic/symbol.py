"""Symbols in the manner of ISO 10628-2 and ISA 5.1, drawn about the point where the line passes."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

from cadgraph._io.text import shortened, xml_text
from cadgraph.draw.svg import Svg, element, number
from cadgraph.model.records import Junction, Terminal, Unit
from cadgraph.query.network import Network

__all__ = ["Symbol", "clean", "instrument_letters", "symbol_of", "text_width"]

TAG_SIZE = 8.0  # px, size of tags
_VALVE = (13.0, 7.5)  # px, half the length and half the height of a valve
_BUBBLE = 15.0  # px, radius of an instrument's circle
_PUMP = 18.0  # px, radius of a pump's circle

_MOST = 40  # characters of a name that are shown


@dataclass(frozen=True)
class Symbol:
    """How one node is drawn.

    Args:
        form: which symbol (``"gate"``, ``"pump"``...).
        label: its tag; drawn above it, or inside tanks, equipment and instruments.
        title: what a viewer shows under the pointer.
        left: extent to the left of its centre [px].
        right: likewise.
        top: likewise, of the symbol alone.
        bottom: likewise.
        flow: 1 where the flow goes to the right, -1 to the left, 0 where nobody knows.
        letters: of an instrument (``"PI"``).
        upright: whether it stands on a vertical line.
        place: id of the node.
    """

    form: str
    label: str
    title: str
    left: float
    right: float
    top: float
    bottom: float
    flow: int = 0
    letters: str = ""
    upright: bool = False
    place: str = ""

    @property
    def width(self) -> float:
        """Along the line [px]."""
        return self.left + self.right

    @property
    def height(self) -> float:
        """Across the line [px]."""
        return self.top + self.bottom

    @cached_property
    def label_width(self) -> float:
        """Of the tag where it is drawn beside the symbol [px]; 0 where it is drawn inside."""
        if not self.label or self.form in ("instrument", "tank", "equipment", "exchanger", "strainer", "open", "end"):
            return 0.0
        return text_width(self.label, TAG_SIZE)

    def draw(self, x: float, y: float) -> Svg:
        """SVG of the symbol with its centre at a point, without the tag beside it."""
        turn = " rotate(-90)" if self.upright and self.form in _TURNING else ""
        body = _FORMS[self.form](self)
        move = f"translate({number(x)} {number(y)}){turn}"
        return element("g", element("title", self.title), body, transform=move, data_id=self.place)


def symbol_of(network: Network, place: str, flow: int = 0, upright: bool = False) -> Symbol:
    """The symbol of a unit, junction or terminal.

    Args:
        network: that it is in.
        place: its id.
        flow: 1 where the flow goes to the right through it, -1 to the left, 0 where nobody knows.
        upright: whether it stands on a vertical line.
    """
    return replace(_symbol(network, place, flow, upright), place=place)


def _symbol(network: Network, place: str, flow: int, upright: bool) -> Symbol:
    node = network.places[place]
    name, what = clean(network.name(place)), clean(network.what(place))
    title = f"{name}: {what}"
    if isinstance(node, Junction):
        return Symbol("junction", name, title, 0.5, 0.5, 0.5, 0.5)
    if isinstance(node, Terminal):
        if node.kind == "blind":
            return Symbol("blind", name, title, 3, 3, 8, 8)
        return Symbol("open" if node.kind == "open" else "end", name, title, 8, 8, 6, 6)
    return _unit_symbol(node, name, title, flow, upright)


def _unit_symbol(node: Unit, name: str, title: str, flow: int, upright: bool) -> Symbol:
    kind = (node.kind or "").casefold()
    if node.unit_type == "valve":
        form = next((form for word, form in _VALVE_KINDS if word in kind), "valve")
        long, high = _VALVE
        top = high + {"control": 16.0, "relief": 14.0}.get(form, 0.0)
        if upright:
            return Symbol(form, name, title, top, high, long, long, flow, upright=True)
        return Symbol(form, name, title, long, long, top, high, flow)
    if node.unit_type == "gauge":
        radius = max(_BUBBLE, text_width(name, 6.5) / 2 + 3)
        letters = instrument_letters(node.kind)
        return Symbol("instrument", name, title, radius, radius, radius, radius, letters=letters)
    if node.unit_type == "pump":
        return Symbol("pump", name, title, _PUMP, _PUMP, _PUMP, _PUMP, flow)
    if node.unit_type == "tank":
        half = max(38.0, text_width(name, TAG_SIZE + 1) / 2 + 8)
        return Symbol("tank", name, title, half, half, 55, 55)
    form = next((form for word, form in _EQUIPMENT_KINDS if word in kind), "equipment")
    half = max(26.0, text_width(name, TAG_SIZE) / 2 + 6)
    return Symbol(form, name, title, half, half, 18, 18)


_VALVE_KINDS = (
    ("ball", "ball"), ("gate", "gate"), ("globe", "globe"), ("butterfly", "butterfly"), ("check", "check"),
    ("non-return", "check"), ("control", "control"), ("relief", "relief"), ("safety", "relief"), ("plug", "plug"),
)  # fmt: skip
_EQUIPMENT_KINDS = (
    ("exchanger", "exchanger"),
    ("cooler", "exchanger"),
    ("strainer", "strainer"),
    ("filter", "strainer"),
)

# ISA 5.1, table 4.1: first letter the measured variable; second what the device does with it.
_VARIABLES = (
    ("pressure", "P"), ("level", "L"), ("sight", "L"), ("flow", "F"), ("temperature", "T"), ("thermo", "T"),
)  # fmt: skip
_FUNCTIONS = (("transmitter", "T"), ("switch", "S"), ("sight", "G"), ("thermowell", "W"), ("element", "E"))


def instrument_letters(kind: str | None) -> str:
    """The identification letters of an instrument after ISA 5.1: ``PI``, ``LI``, ``FI``...; ``XI`` where unknown.

    ISA 5.1 leaves X to the user, for a variable that isn't listed.
    """
    text = (kind or "").casefold()
    variable = next((letter for word, letter in _VARIABLES if word in text), "X")
    return variable + next((letter for word, letter in _FUNCTIONS if word in text), "I")


def clean(text: str) -> str:
    """A name fit for XML, not longer than a drawing can show."""
    return shortened(" ".join(xml_text(text).split()), _MOST)


def text_width(text: str, size: float) -> float:
    """About how wide a text is drawn in a sans-serif face [px]."""
    wide = sum(1.0 if ord(c) > 0x2E80 else 0.3 if c in "iljI.,:;'|! " else 0.62 for c in text)
    return wide * size


def _path(d: str, style: str = "s") -> Svg:
    return element("path", class_=style, d=d)


def _circle(style: str, radius: float) -> Svg:
    return element("circle", class_=style, r=radius)


def _bow(_: Symbol | None = None) -> Svg:
    a, b = (number(v) for v in _VALVE)
    return _path(f"M-{a} -{b}L{a} {b}V-{b}L-{a} {b}Z")


def _ball(symbol: Symbol) -> Svg:
    return _bow() + _circle("s", 4.6)


def _gate(symbol: Symbol) -> Svg:
    return _bow() + _path(f"M0 -{_VALVE[1]}V{_VALVE[1]}")


def _globe(symbol: Symbol) -> Svg:
    return _bow() + _circle("k", 4)


def _plug(symbol: Symbol) -> Svg:
    return _bow() + _path("M0 -6L4 0L0 6L-4 0Z", "k")


def _butterfly(symbol: Symbol) -> Svg:
    a, b = (number(v) for v in _VALVE)
    blank = element("rect", class_="w", x=f"-{a}", y=f"-{b}", width=2 * _VALVE[0], height=2 * _VALVE[1])
    return blank + _path(f"M-{a} -{b}V{b}M{a} -{b}V{b}M-{a} {b}L{a} -{b}") + _circle("k", 2.6)


def _check(symbol: Symbol) -> Svg:
    a, b = _VALVE
    x = number(a if symbol.flow >= 0 else -a)
    low, high = number(b), number(-b)
    minus = x[1:] if x.startswith("-") else f"-{x}"
    blank = element("rect", class_="w", x=-a, y=high, width=2 * a, height=2 * b)
    body = _path(f"M{minus} {low}V{high}L{x} {low}V{high}")
    if symbol.flow == 0:
        return blank + body
    # The dot is where the flow comes from; the arrow says which way it may go.
    tip, tail = (9, -7) if symbol.flow > 0 else (-9, 7)
    arrow = _path(f"M{tail} -11.5H{tip}M{tip - 4 * symbol.flow} -13.5L{tip} -11.5L{tip - 4 * symbol.flow} -9.5", "t")
    return blank + body + element("circle", class_="k", cx=minus, cy=high, r=2.4) + arrow


def _control(symbol: Symbol) -> Svg:
    return _path("M0 0V-14") + _bow() + _path("M-8 -14A8 8 0 0 1 8 -14Z")


def _relief(symbol: Symbol) -> Svg:
    return _bow() + _path("M0 0V-8M-4 -9.5L4 -11.5M-4 -12.5L4 -14.5M-4 -15.5L4 -17.5M0 -8L-4 -9.5M0 -20V-17", "t")


def _pump(symbol: Symbol) -> Svg:
    r = _PUMP
    side = -1 if symbol.flow < 0 else 1
    x, y = r * math.cos(math.radians(115)), r * math.sin(math.radians(115))
    wings = f"M{number(side * x)} -{number(y)}L{number(side * r)} 0L{number(side * x)} {number(y)}"
    return _circle("s", r) + _path(wings, "n")


def _tank(symbol: Symbol) -> Svg:
    w, h = symbol.left, symbol.top
    dome = 12.0
    x, y, d = number(w), number(h - dome), number(dome)
    shell = f"M-{x} -{y}V{y}A{x} {d} 0 0 0 {x} {y}V-{y}A{x} {d} 0 0 0 -{x} -{y}Z"
    return _path(shell) + _inside(symbol.label, TAG_SIZE + 1)


def _equipment(symbol: Symbol) -> Svg:
    return _frame(symbol) + _inside(symbol.label, TAG_SIZE)


def _exchanger(symbol: Symbol) -> Svg:
    zig = _path("M-18 -18L-10 -6L0 -16L10 -6L18 -18", "n") if symbol.left >= 18 else Svg()
    return _frame(symbol) + zig + _inside(symbol.label, TAG_SIZE, 8)


def _strainer(symbol: Symbol) -> Svg:
    x, y = number(symbol.left), number(symbol.top)
    return _frame(symbol) + _path(f"M-{x} {y}L{x} -{y}", "d") + _inside(symbol.label, TAG_SIZE)


def _frame(symbol: Symbol) -> Svg:
    x, y = number(symbol.left), number(symbol.top)
    return _path(f"M-{x} -{y}H{x}V{y}H-{x}Z")


def _instrument(symbol: Symbol) -> Svg:
    circle = _circle("s", symbol.left)
    return circle + _inside(symbol.letters, TAG_SIZE, -1.5) + _inside(symbol.label, 6.5, 7)


def _junction(symbol: Symbol) -> Svg:
    return _circle("k", 2.6)


def _open(symbol: Symbol) -> Svg:
    return _path("M-8 -6H2L8 0L2 6H-8Z") if symbol.flow >= 0 else _path("M8 -6H-2L-8 0L-2 6H8Z")


def _end(symbol: Symbol) -> Svg:
    return _circle("s", 6) + _inside("?", TAG_SIZE, 3)


def _blind(symbol: Symbol) -> Svg:
    return _path("M-2 -8V8M2 -8V8", "b")


def _inside(text: str, size: float, y: float = 3.0) -> Svg:
    return element("text", text, class_="c", y=y, font_size=size)


_FORMS: dict[str, Callable[[Symbol], Svg]] = {
    "valve": _bow, "ball": _ball, "gate": _gate, "globe": _globe, "plug": _plug, "butterfly": _butterfly,
    "check": _check, "control": _control, "relief": _relief, "pump": _pump, "tank": _tank, "equipment": _equipment,
    "exchanger": _exchanger, "strainer": _strainer, "instrument": _instrument, "junction": _junction, "open": _open,
    "end": _end, "blind": _blind,
}  # fmt: skip
_TURNING = frozenset({"valve", "ball", "gate", "globe", "plug", "butterfly", "check", "control", "relief"})

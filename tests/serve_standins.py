"""What other parts of the project bring, small enough to test the server alone."""

import sys
import types
from dataclasses import dataclass, field

import cadgraph.model.corrections as corrections
from cadgraph.model.corrections import read_corrections, write_corrections
from cadgraph.session.session import Change, Session


def install():
    if hasattr(corrections, "History"):
        return
    review = types.ModuleType("cadgraph.session.review")
    review.Question, review.review_queue = Question, review_queue
    web = types.ModuleType("cadgraph.draw.web")
    sys.modules[review.__name__] = review
    corrections.History, corrections.read_history, corrections.write_history = History, read_history, write_history
    plain = Session.__init__

    def init(self, *arguments, corrections=(), **more):
        history = corrections if isinstance(corrections, History) else History.of(corrections)
        plain(self, *arguments, corrections=history.in_force, **more)
        self.history = history

    def apply(self, edits, *, who="", why=""):
        before = self.graph
        for edit in edits:
            if edit.get("kind") == "label":
                name = edit["group"] if edit["name"] is None else f"{edit['group']}/{edit['name']}"
                change = self.correct(edit["part"], name, this_only=edit.get("this_only", False))
            elif edit.get("kind") == "forget":
                change = self.forget(edit["part"])
            else:
                raise ValueError(f"edit of kind {edit.get('kind')!r}: not known")
        self.history = self.history.do(self._corrections, f"{edits[0]['kind']} {edits[0]['part']}", who, why)
        return _change(self, before, change.changed)

    def step(name):
        def go(self, *, who=""):
            before = self.graph
            self.history = getattr(self.history, name)(who)
            self._corrections, self._graph = self.history.in_force, None
            from cadgraph.session.session import changed_parts

            return _change(self, before, changed_parts(before, self.graph))

        return go

    Session.__init__, Session.apply, Session.undo, Session.redo = init, apply, step("undo"), step("redo")


def _change(session, before, changed):
    change = Change(None, tuple(changed))
    object.__setattr__(change, "message", f"{len(changed)} parts changed")
    object.__setattr__(change, "regrouped", False)
    return change


@dataclass(frozen=True)
class Event:
    id: int
    who: str
    why: str
    what: str
    after: tuple
    kind: str = "do"
    when: str = ""


@dataclass(frozen=True)
class History:
    start: tuple = ()
    done: tuple = ()
    undone: tuple = ()
    events: tuple = ()

    @classmethod
    def of(cls, found):
        history = cls()
        for n in range(len(found)):
            history = history.do(tuple(found[: n + 1]), f"label {found[n].mesh}", "", "")
        return history

    def do(self, after, what, who, why):
        event = Event(len(self.events) + 1, who, why, what, tuple(after))
        return History(self.start, (*self.done, event), (), (*self.events, event))

    def undo(self, who):
        if not self.done:
            raise ValueError("nothing to undo")
        event = Event(len(self.events) + 1, who, "", f"undone: {self.done[-1].what}", (), "undo")
        return History(self.start, self.done[:-1], (*self.undone, self.done[-1]), (*self.events, event))

    def redo(self, who):
        if not self.undone:
            raise ValueError("nothing to redo")
        event = Event(len(self.events) + 1, who, "", f"done again: {self.undone[-1].what}", (), "redo")
        return History(self.start, (*self.done, self.undone[-1]), self.undone[:-1], (*self.events, event))

    @property
    def in_force(self):
        return self.done[-1].after if self.done else self.start

    @property
    def to_undo(self):
        return self.done[-1] if self.done else None

    @property
    def to_redo(self):
        return self.undone[-1] if self.undone else None

    can_undo = property(lambda self: bool(self.done))
    can_redo = property(lambda self: bool(self.undone))

    def audit(self):
        return [
            {
                **{key: getattr(event, key) for key in ("id", "when", "who", "what", "why")},
                "undone": event.kind == "do" and event not in self.done,
            }
            for event in reversed(self.events)
        ]


def read_history(path, vocabulary=None):
    return History.of(read_corrections(path, vocabulary))


def write_history(history, path):
    return write_corrections(history.in_force, path)


@dataclass(frozen=True)
class Option:
    text: str
    edits: tuple


@dataclass(frozen=True)
class Question:
    id: str
    title: str
    options: tuple = field(default=())

    def to_json(self):
        return {
            "id": self.id,
            "title": self.title,
            "options": [{"text": o.text, "edits": list(o.edits)} for o in self.options],
        }


def review_queue(session, limit=50, skipped=()):
    corrected = {one.mesh for one in session.history.in_force}
    found = []
    for part in session.graph.parts():
        name = f"label:{part.meshes[0]}"
        if part.label is not None and part.meshes[0] not in corrected and name not in skipped:
            edit = {"kind": "label", "part": part.id, "group": "Pipe assembly", "name": "tee", "this_only": True}
            found.append(Question(name, "What is this?", (Option("tee", (edit,)),)))
    return tuple(found[:limit])

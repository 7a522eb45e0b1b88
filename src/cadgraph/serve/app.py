"""What the server answers: the page's own files, what the plant is, and what the person does to it."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Callable, Mapping
from concurrent.futures import Executor
from importlib import resources
from importlib.resources.abc import Traversable
from typing import Any, TypeVar, cast

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect, Request
from starlette.responses import Response, StreamingResponse
from starlette.routing import Route

from cadgraph.draw.web.content import as_bytes
from cadgraph.errors import CadGraphError, UnknownNode
from cadgraph.model.pipework import Direction
from cadgraph.serve.guard import Doors, Guard, refuse
from cadgraph.serve.plant import Plant
from cadgraph.serve.snapshot import Snapshot
from cadgraph.serve.state import Refusal, one_line

__all__ = ["make_app"]

_PAGE = {"/": "index.html", "/viewer.js": "viewer.js", "/viewer.css": "viewer.css"}
_TYPES = {"html": "text/html; charset=utf-8", "js": "text/javascript; charset=utf-8", "css": "text/css; charset=utf-8"}
_MOST_BODY = 16 << 20  # bytes: a hundred thousand edits
_MOST_WHY = 2000  # characters
_MOST_QUESTIONS = 500

_T = TypeVar("_T")


def make_app(plant: Plant, worker: Executor, token: str, doors: Doors, page: Traversable | None = None) -> Guard:
    """The application.

    Args:
        plant: what is shown; only the worker changes it.
        worker: one thread, which does what changes the plant in the order in which it was asked for.
        token: that each request must carry.
        doors: the names under which the server answers.
        page: folder of the page's files; those of the package if None.
    """
    desk = _Answers(plant, worker, page or resources.files("cadgraph.draw.web").joinpath("page"))
    routes = [
        *(Route(path, desk.page) for path in _PAGE),
        Route("/api/state", desk.state),
        Route("/api/events", desk.events),
        Route("/api/content", desk.content),
        Route("/api/scene", desk.manifest),
        Route("/api/scene/{file}", desk.scene_file),
        Route("/api/schematic", desk.schematic),
        Route("/api/part/{which:path}", desk.explain),
        Route("/api/unit/{which:path}", desk.explain),
        Route("/api/trace", desk.trace),
        Route("/api/isolate", desk.isolate),
        Route("/api/review", desk.review),
        Route("/api/audit", desk.audit),
        Route("/api/edit", desk.edit, methods=["POST"]),
        Route("/api/undo", desk.undo, methods=["POST"]),
        Route("/api/redo", desk.redo, methods=["POST"]),
        Route("/api/answer", desk.answer, methods=["POST"]),
    ]
    handlers: Any = {
        HTTPException: _http_error,
        Refusal: _refusal,
        UnknownNode: _none,
        CadGraphError: _bad,
        ValueError: _bad,
        Exception: _broken,
    }
    answers = Starlette(routes=routes, exception_handlers=handlers)
    return Guard(answers, token, doors, [path for path in _PAGE if path != "/"])


class _Answers:
    """One method for each thing that can be asked."""

    def __init__(self, plant: Plant, worker: Executor, page: Traversable) -> None:
        self._plant, self._worker, self._files = plant, worker, page

    async def page(self, request: Request) -> Response:
        name = _PAGE[request.url.path]
        try:
            content = self._files.joinpath(name).read_bytes()
        except OSError:
            raise Refusal(503, f"{name} is not part of this installation; install cadgraph from a wheel") from None
        return Response(content, media_type=_TYPES[name.rpartition(".")[2]])

    async def state(self, request: Request) -> Response:
        return _json(self._plant.feed.state.to_json())

    async def events(self, request: Request) -> Response:
        return StreamingResponse(self._events(), media_type="text/event-stream")

    async def _events(self) -> AsyncIterator[bytes]:
        async for state in self._plant.feed.follow():
            yield b":\n\n" if state is None else b"data: " + as_bytes(state.to_json()) + b"\n\n"

    async def content(self, request: Request) -> Response:
        shown = self._shown()
        return Response(await run_in_threadpool(lambda: shown.content), media_type="application/json")

    async def manifest(self, request: Request) -> Response:
        self._shown()
        return _json(self._plant.packed.manifest)

    async def scene_file(self, request: Request) -> Response:
        self._shown()
        content = self._plant.packed.files.get(request.path_params["file"])
        if content is None:
            raise Refusal(404, "the scene has no such file")
        return Response(content, media_type="application/octet-stream")

    async def schematic(self, request: Request) -> Response:
        shown = self._shown()
        return Response(await run_in_threadpool(lambda: shown.schematic), media_type="image/svg+xml")

    async def explain(self, request: Request) -> Response:
        return await self._read(lambda shown: shown.explain(request.path_params["which"]))

    async def trace(self, request: Request) -> Response:
        at, given, to = (request.query_params.get(key) for key in ("at", "direction", "to"))
        direction = cast("Direction | None", given)
        return await self._read(lambda shown: shown.trace(_given(at), direction, to))

    async def isolate(self, request: Request) -> Response:
        at = request.query_params.get("at")
        return await self._read(lambda shown: shown.isolate(_given(at)))

    async def review(self, request: Request) -> Response:
        try:
            limit = int(request.query_params.get("limit", "50"))
        except ValueError:
            limit = 0
        if limit < 1:
            raise Refusal(400, "limit: give a number of at least 1")
        return _json(await self._work(self._plant.review, min(limit, _MOST_QUESTIONS)))

    async def audit(self, request: Request) -> Response:
        return _json(await self._work(self._plant.audit))

    async def edit(self, request: Request) -> Response:
        body = await _body(request)
        edits = body.get("edits")
        if not isinstance(edits, list) or not edits or not all(isinstance(edit, dict) for edit in edits):
            raise Refusal(400, "edits: give a list of at least one edit")
        return _json(await self._work(self._plant.edit, _version(body), edits, _why(body)))

    async def undo(self, request: Request) -> Response:
        return _json(await self._work(self._plant.undo, _version(await _body(request))))

    async def redo(self, request: Request) -> Response:
        return _json(await self._work(self._plant.redo, _version(await _body(request))))

    async def answer(self, request: Request) -> Response:
        body = await _body(request)
        question, option = body.get("question"), body.get("option")
        if not isinstance(question, str):
            raise Refusal(400, "question: give the id of one")
        if option not in ("skip", "unsure") and (not isinstance(option, int) or isinstance(option, bool)):
            raise Refusal(400, "option: give the number of one, 'skip' or 'unsure'")
        return _json(await self._work(self._plant.answer, _version(body), question, option, _why(body)))

    def _shown(self) -> Snapshot:
        """What is there to be seen."""
        return self._plant.shown()

    async def _read(self, ask: Callable[[Snapshot], Any]) -> Response:
        shown = self._shown()
        return _json(await run_in_threadpool(ask, shown))

    async def _work(self, do: Callable[..., _T], *arguments: Any) -> _T:
        """Something done by the thread that alone may change the plant; at once refused while that builds."""
        self._plant.check_ready()
        return await asyncio.get_running_loop().run_in_executor(self._worker, do, *arguments)


def _json(values: Any) -> Response:
    return Response(as_bytes(values), media_type="application/json")


def _given(text: str | None) -> str:
    if not text:
        raise Refusal(400, "at: say which unit is meant")
    return text


async def _body(request: Request) -> Mapping[str, Any]:
    """What was posted: a JSON object, read no further than it may be long."""
    content = bytearray()
    try:
        async for chunk in request.stream():
            content += chunk
            if len(content) > _MOST_BODY:
                raise Refusal(413, f"more than {_MOST_BODY >> 20} MB at once; correct fewer parts in one step")
    except ClientDisconnect:
        raise Refusal(400, "the page was closed before all was sent") from None
    try:
        body = json.loads(bytes(content))
    except (ValueError, RecursionError):
        raise Refusal(400, "what was posted is no JSON") from None
    if not isinstance(body, dict):
        raise Refusal(400, "what was posted is no JSON object")
    return body


def _version(body: Mapping[str, Any]) -> int:
    version = body.get("version")
    if not isinstance(version, int) or isinstance(version, bool):
        raise Refusal(400, "version: say which version of the plant the page shows")
    return version


def _why(body: Mapping[str, Any]) -> str:
    why = body.get("why", "")
    if not isinstance(why, str) or len(why) > _MOST_WHY:
        raise Refusal(400, f"why: give a text of at most {_MOST_WHY:,} characters")
    return why


async def _http_error(request: Request, error: HTTPException) -> Response:
    return refuse(request.url.path, error.status_code, one_line(str(error.detail)))


async def _refusal(request: Request, error: Refusal) -> Response:
    if error.state is None:
        return refuse(request.url.path, error.status, one_line(error.reason))
    told = {"error": one_line(error.reason), "state": error.state.to_json()}
    return Response(as_bytes(told), error.status, media_type="application/json")


async def _bad(request: Request, error: Exception) -> Response:
    return refuse(request.url.path, 400, one_line(str(error)))


async def _none(request: Request, error: UnknownNode) -> Response:
    return refuse(request.url.path, 404 if request.method != "POST" else 400, one_line(str(error)))


async def _broken(request: Request, error: Exception) -> Response:
    return refuse(
        request.url.path, 500, f"an error of cadgraph itself ({type(error).__name__}); the terminal says more"
    )

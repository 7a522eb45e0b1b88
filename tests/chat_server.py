"""A small server that speaks chat completions over loopback, answers as it is told, and misbehaves on order."""

from __future__ import annotations

import asyncio
import base64
import gzip
import io
import json
import math
import threading
import time
from contextlib import contextmanager

import uvicorn
from PIL import Image
from starlette.applications import Starlette
from starlette.responses import JSONResponse, Response, StreamingResponse
from starlette.routing import Route


class ChatServer:
    """Answers from a function of the question's text; ``orders`` say how each request in turn goes wrong.

    Orders: ``ok``, ``400``, ``429``, ``500``, ``slow``, ``drop``, ``broken``, ``wrong``, ``refuse``, ``huge``,
    ``empty``.
    """

    def __init__(self, answer, orders=(), delay=0.0, accepts=("json_schema", "json_object", "none")):
        self.answer, self.orders, self.delay, self.accepts = answer, list(orders), delay, accepts
        self.bodies = []
        self.answered = []
        self.prompt_tokens = self.answer_tokens = 0
        self._lock = threading.Lock()
        self.app = Starlette(routes=[Route("/v1/chat/completions", self._chat, methods=["POST"])])

    async def _chat(self, request):
        body = await request.json()
        with self._lock:
            self.bodies.append(body)
            order = self.orders.pop(0) if self.orders else "ok"
        if request.headers.get("authorization") == "Bearer wrong":
            return self._error(401, "bad key")
        kind = body.get("response_format", {"type": "none"})["type"]
        if kind not in self.accepts:
            return self._error(400, f"response_format of type {kind} is not supported")
        if kind == "json_schema":
            assert body["response_format"]["json_schema"]["strict"] is True
        if self.delay:
            await asyncio.sleep(self.delay)
        if order == "429":
            return self._error(429, "slow down", {"retry-after-ms": "20", "retry-after": "0.02"})
        if order == "400":
            return self._error(400, "the picture can't be decoded")
        if order == "500":
            return self._error(500, "oops", {"retry-after-ms": "20"})
        if order == "slow":
            await asyncio.sleep(1.0)
        if order == "drop":
            return StreamingResponse(self._cut_off(), headers={"content-length": "1000"})
        text = body["messages"][-1]["content"][0]["text"]
        content = json.dumps(self.answer(text))
        refusal = None
        if order == "broken":
            content = content[: len(content) // 2]
        elif order == "wrong":
            content = json.dumps({"seen": "?", "group": "Spaceship", "name": "warp core", "confidence": 1})
        elif order == "refuse":
            content, refusal = None, "I can't help with that"
        elif order == "huge":
            content = json.dumps({"seen": "x" * 60_000, "group": "Tank", "name": "shell", "confidence": 1})
        elif order == "empty":
            content = ""
        elif order == "enormous":
            return Response(b" " * 5_000_000, media_type="application/json")
        elif order == "endless":
            return StreamingResponse(iter([b" " * 1_000_000] * 9), media_type="application/json")
        elif order == "packed":
            return Response(gzip.compress(b" " * 9_000_000), headers={"content-encoding": "gzip"})
        usage = self._count(body, content or "")
        with self._lock:
            self.answered.append(digest(body))
        return JSONResponse(
            {
                "id": "chatcmpl-1", "object": "chat.completion", "created": int(time.time()), "model": body["model"],
                "choices": [
                    {
                        "index": 0, "finish_reason": "stop", "logprobs": None,
                        "message": {"role": "assistant", "content": content, "refusal": refusal},
                    }
                ],
                "usage": usage,
            }
        )  # fmt: skip

    @staticmethod
    async def _cut_off():
        yield b'{"id": "chat'
        raise ConnectionResetError

    @staticmethod
    def _error(status, message, headers=None):
        return JSONResponse({"error": {"message": message, "type": "x", "code": None}}, status, headers)

    def _count(self, body, content):
        """As gpt-4o counts pictures; text at four bytes a token, the schema at half of that, as it is compressed."""
        tokens = 3.0
        for message in body["messages"]:
            tokens += 4
            parts = message["content"] if isinstance(message["content"], list) else [{"type": "text", **message}]
            for part in parts:
                if part["type"] == "image_url":
                    tokens += picture_tokens(part["image_url"])
                else:
                    tokens += len((part.get("text") or part.get("content")).encode()) / 4.2
        tokens += len(json.dumps(body.get("response_format", {}))) / 8
        usage = {"prompt_tokens": int(tokens), "completion_tokens": math.ceil(len(content) / 4)}
        with self._lock:
            self.prompt_tokens += usage["prompt_tokens"]
            self.answer_tokens += usage["completion_tokens"]
        return usage | {"total_tokens": sum(usage.values())}

    @contextmanager
    def running(self):
        """The address while it runs."""
        config = uvicorn.Config(self.app, host="127.0.0.1", port=0, log_level="critical", lifespan="off", ws="none")
        server = uvicorn.Server(config)
        thread = threading.Thread(target=server.run, daemon=True)
        thread.start()
        while not server.started:
            time.sleep(0.005)
        port = server.servers[0].sockets[0].getsockname()[1]
        try:
            yield f"http://127.0.0.1:{port}/v1"
        finally:
            server.should_exit = True
            thread.join(5)


def picture_tokens(image):
    data = base64.b64decode(image["url"].removeprefix("data:image/jpeg;base64,"))
    with Image.open(io.BytesIO(data)) as opened:
        width, height = opened.size
    if image["detail"] == "low":
        return 85
    return 85 + 170 * math.ceil(width / 512) * math.ceil(height / 512)


def digest(body):
    """What tells one question from another, whatever its pictures."""
    return json.dumps(body["messages"][-1]["content"][0]["text"])

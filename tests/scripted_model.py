"""A server that speaks chat completions and says, turn by turn, what it was told to, calls of tools included."""

from __future__ import annotations

import json
import time

from starlette.responses import Response

from chat_server import ChatServer


class ScriptedModel(ChatServer):
    """Says its turns one after the other; the last one again and again.

    A turn is a text, a list of calls (name, arguments), an error (status, message), or a function of the request's body
    that makes one of them.
    """

    def __init__(self, *turns, usage=(1000, 50), finish=None, beside=None):
        super().__init__(None)
        self.turns, self.usage, self.finish, self.beside = list(turns), usage, finish, beside or {}
        self.keys = []

    async def _chat(self, request):
        body = await request.json()
        self.bodies.append(body)
        self.keys.append(request.headers.get("authorization"))
        if self.keys[-1] == "Bearer wrong-key-of-nobody":
            return self._error(401, "Incorrect API key provided: wrong-key-of-nobody")
        turn = self.turns.pop(0) if len(self.turns) > 1 else self.turns[0]
        turn = turn(body) if callable(turn) else turn
        if isinstance(turn, tuple):
            return self._error(turn[0], turn[1])
        message = {"role": "assistant", "content": turn if isinstance(turn, str) else None, **self.beside}
        if isinstance(turn, list):
            message["tool_calls"] = [
                {
                    "id": f"call-{len(self.bodies)}-{i}",
                    "type": "function",
                    "function": {"name": name, "arguments": given if isinstance(given, str) else json.dumps(given)},
                }
                for i, (name, given) in enumerate(turn)
            ]
        choice = {"index": 0, "finish_reason": self.finish or "stop", "logprobs": None, "message": message}
        prompt, answered = self.usage
        usage = {"prompt_tokens": prompt, "completion_tokens": answered, "total_tokens": prompt + answered}
        told = {"id": "x", "object": "chat.completion", "created": int(time.time()), "model": "scripted"}
        told |= {"choices": [choice]} | ({"usage": usage} if self.usage != (0, 0) else {})
        # In plain letters, so that halves of characters can be told as well.
        return Response(json.dumps(told), media_type="application/json")

    def results(self, request=-1):
        """What the tools were said to have returned, up to one of the requests."""
        return [each["content"] for each in self.bodies[request]["messages"] if each["role"] == "tool"]

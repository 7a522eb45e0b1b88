"""A plain HTTP server for tests of asking: a function of each request says what comes back, byte by byte if need be."""

import base64
import io
import json
import threading
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

from PIL import Image

from cadgraph.labelers.lvlm.gallery import Picture
from cadgraph.labelers.lvlm.reply import Question

ANSWER = {"seen": "a disc", "group": "Pipe assembly", "name": "flange", "confidence": 0.9}


class HomeServer:
    """Answers requests by ``reply(body, server)``, which gives ``(status, content)`` or ``(status, content, headers)``.

    Content is a dict (sent as JSON), bytes, or an iterator of bytes, which is sent in chunks for as long as the client
    reads. ``None`` in place of all that hangs up.
    """

    def __init__(self, reply):
        self.reply, self.bodies, self.headers, self.sent = reply, [], [], 0

    @contextmanager
    def running(self):
        """The address while it runs."""
        outer = self

        class Handler(BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"

            def do_POST(self):
                body = json.loads(self.rfile.read(int(self.headers["content-length"])))
                outer.bodies.append(body)
                outer.headers.append({name.lower(): value for name, value in self.headers.items()})
                told = outer.reply(body, outer)
                if told is None:
                    self.close_connection = True
                    return
                try:
                    self._send(*told)
                except OSError:
                    self.close_connection = True

            def _send(self, status, content, headers=None):
                self.send_response(status)
                for name, value in (headers or {}).items():
                    self.send_header(name, value)
                if isinstance(content, dict):
                    content = json.dumps(content).encode()
                if isinstance(content, bytes):
                    self.send_header("content-length", str(len(content)))
                    self.end_headers()
                    self.wfile.write(content)
                    return
                self.send_header("transfer-encoding", "chunked")
                self.end_headers()
                for piece in content:
                    self.wfile.write(b"%x\r\n%s\r\n" % (len(piece), piece))
                    outer.sent += len(piece)
                self.wfile.write(b"0\r\n\r\n")

            def log_message(self, *_):
                pass

        class Server(ThreadingHTTPServer):
            daemon_threads = True

            def handle_error(self, *_):
                """A client that hangs up is what the tests want."""

        server = Server(("127.0.0.1", 0), Handler)
        thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01}, daemon=True)
        thread.start()
        try:
            yield f"http://127.0.0.1:{server.server_port}/v1"
        finally:
            server.shutdown()
            server.server_close()
            thread.join(5)


def said(content=None, **more):
    """A chat completion with this text, or with an answer."""
    text = json.dumps(ANSWER) if content is None else content
    message = {"role": "assistant", "content": text, **more}
    return {
        "id": "chatcmpl-1", "object": "chat.completion", "created": 1, "model": "m",
        "choices": [{"index": 0, "finish_reason": "stop", "message": message}],
        "usage": {"prompt_tokens": 100, "completion_tokens": 20, "total_tokens": 120},
    }  # fmt: skip


def refused(message, kind="invalid_request_error"):
    """An error in the form of OpenAI's."""
    return {"error": {"message": message, "type": kind, "code": None}}


def question(text="What is this?", n_pictures=6, side=512, system="Answer in JSON."):
    """One with pictures in plain colours."""
    pictures = tuple(
        Picture(f"view{i + 1}", f"View {i + 1}:", _Plain((40 * i % 256, 90, 200 - 20 * i), side))
        for i in range(n_pictures)
    )
    schema = {"type": "object", "properties": {name: {"type": "string"} for name in ANSWER}}
    return Question(system, text, schema, "recipe", lambda: pictures, "label-0", part=3, about="/plant/mesh_3")


def images_in(body):
    """The pictures of a request, as sizes and as images."""
    parts = body["messages"][-1]["content"]
    urls = [part["image_url"]["url"] for part in parts if part["type"] == "image_url"]
    return [Image.open(io.BytesIO(base64.b64decode(url.partition(",")[2]))) for url in urls]


def words_in(body):
    """All text of a request."""
    texts = []
    for message in body["messages"]:
        content = message["content"]
        texts += [content] if isinstance(content, str) else [part["text"] for part in content if part["type"] == "text"]
    return "\n".join(texts)


class _Plain:
    def __init__(self, color, side):
        self.color, self.side = color, side

    def __call__(self):
        buffer = io.BytesIO()
        Image.new("RGB", (self.side, self.side), self.color).save(buffer, "JPEG")
        return buffer.getvalue()

"""The workbench in a folder of its own."""

import contextlib
import http.client
import json
import os
import pathlib
import re
import signal
import socket
import subprocess
import threading

import pytest

PROGRAM = os.environ.get("EXPERIMENT", "experiment")

# What takes long, or is much the same as what is run in the short form.
full = pytest.mark.skipif(os.environ.get("FULL") != "1", reason="only with FULL=1")


def free_port():
    """A port that nobody listens on."""
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class Answer:
    """Status, headers and content of an answer."""

    def __init__(self, response):
        self.status = response.status
        self.headers = response.headers
        self.content = response.read()

    @property
    def text(self):
        return self.content.decode()

    @property
    def json(self):
        return json.loads(self.content)


class Server:
    """A running workbench."""

    def __init__(self, folder, config, program=PROGRAM, path=None):
        self.folder, self.config, self.program = pathlib.Path(folder), pathlib.Path(config), program
        self.path = path
        self.process = None
        self.errors = []
        for attempts_left in (2, 1, 0):
            self.port = free_port()
            try:
                self.start()
                break
            except AssertionError:
                # Another process may have taken the port since it was found to be free.
                if not attempts_left:
                    raise

    def start(self):
        """Starts it, and waits for its address."""
        environment = {**os.environ, "XDG_CONFIG_HOME": str(self.config)}
        if self.path:
            environment["PATH"] = f"{self.path}{os.pathsep}{environment['PATH']}"
        options = ["--port", str(self.port)] + ([] if self.path else ["--no-open"])
        self.process = subprocess.Popen(
            [self.program, "serve", str(self.folder), *options],
            env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )
        # The standard error is read all the time, so that the program never waits for it.
        self.reader = threading.Thread(target=lambda: self.errors.extend(self.process.stderr), daemon=True)
        self.reader.start()
        self.address = self.process.stdout.readline().strip()
        found = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/\?token=([0-9a-f]{64})", self.address)
        assert found, f"{self.address!r} {self.errors}"
        self.token = found[2]

    @property
    def host(self):
        return f"127.0.0.1:{self.port}"

    def headers(self, method, headers=None, cookie=True, origin=True):
        """Headers as the page's; those that are None are left out."""
        own = {"Host": self.host}
        if cookie:
            own["Cookie"] = f"asperity-workbench={self.token}"
        if origin and method == "POST":
            own["Origin"] = f"http://{self.host}"
        own.update(headers or {})
        return {name: value for name, value in own.items() if value is not None}

    def send(self, method, path, body=None, headers=None, cookie=True, origin=True, timeout=20):
        """A connection that a request was sent on."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout)
        own = self.headers(method, headers, cookie, origin)
        if isinstance(body, (dict, list)):
            body = json.dumps(body)
            own.setdefault("Content-Type", "application/json")
        if isinstance(body, str):
            body = body.encode()
        connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
        for name, value in own.items():
            connection.putheader(name, value)
        if body is not None and "Content-Length" not in own:
            connection.putheader("Content-Length", str(len(body)))
        connection.endheaders(body)
        return connection

    def request(self, method, path, body=None, headers=None, cookie=True, origin=True, timeout=20):
        """The answer to a request as the page sends it, or without its cookie or origin."""
        with contextlib.closing(self.send(method, path, body, headers, cookie, origin, timeout)) as connection:
            return Answer(connection.getresponse())

    def post(self, path, body, **options):
        return self.request("POST", path, body, **options)

    def events(self, path, body, timeout=60):
        """The events of an answer, as pairs of name and value."""
        answer = self.post(path, body, timeout=timeout)
        assert answer.status == 200, answer.text
        found = []
        for block in answer.text.split("\n\n"):
            lines = [line.partition(":")[::2] for line in block.splitlines()]
            fields = {name: value.removeprefix(" ") for name, value in lines if name}
            if "data" in fields:
                found.append((fields.get("event", "message"), json.loads(fields["data"])))
        return found

    def cpu(self):
        """Seconds that its threads have computed."""
        fields = pathlib.Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def end(self, number=signal.SIGKILL):
        """Ends it, and gives its exit code."""
        if self.process.poll() is None:
            self.process.send_signal(number)
        code = self.process.wait(10)
        self.reader.join(5)
        self.process.stdout.close()
        self.process.stderr.close()
        return code


@pytest.fixture
def start(tmp_path):
    """Starts workbenches, of which none has panicked when the test ends."""
    started = []

    def one(folder=None, **options):
        folder = folder or tmp_path / "folder"
        folder.mkdir(exist_ok=True)
        started.append(Server(folder, tmp_path / "config", **options))
        return started[-1]

    yield one
    for server in started:
        server.end()
        assert "panicked" not in "".join(server.errors), "".join(server.errors)


@pytest.fixture
def server(start):
    """A workbench of an empty folder."""
    return start()

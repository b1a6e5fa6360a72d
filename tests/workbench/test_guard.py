"""Attacks on the workbench: by a page of another site, by what lies in its folder, by whoever has no token."""

import array
import ast
import copy
import json
import os
import pathlib
import random
import signal
import socket
import threading
import time

import pytest
from conftest import full

SPEC = {
    "title": "t",
    "seed": 1,
    "material": {"steel": {"from": "steel-100Cr6"}},
    "compare": {"rough": "steel", "flat": "steel", "law": "zmc", "separation": {"from": 3, "to": 0, "points": 11}},
    "surface": {"a": {"population": {"radius": "20 um", "sigma": "48 nm", "density": "6e10 /m^2", "count": 1000}}},
}
SUMMITS = {"radius": "20 um", "sigma": "48 nm", "density": "6e10 /m^2"}
SPECTRUM = {"self-affine": {"hurst": 0.8, "cut-off-pixels": 8}}


def spec_of(surface):
    """The spec with another surface."""
    return {**SPEC, "surface": {"a": surface}}


def long_spec():
    """A spec that computes for longer than a test."""
    return spec_of({"generate": {"points": 4096, "spectrum": SPECTRUM, "summits": SUMMITS}})


def wait_for(what, seconds=5):
    """Whether something happens in time."""
    end = time.monotonic() + seconds
    while not what():
        if time.monotonic() > end:
            return False
        time.sleep(0.05)
    return True


def is_busy(server):
    """Whether it computes."""
    before = server.cpu()
    time.sleep(0.3)
    return server.cpu() - before > 0.1


def parts(server):
    """Parts of files in its folder."""
    return sorted(server.folder.rglob(".part-*"))


# A map of heights as text.
ROWS = "1 2 3 4\n5 1 7 2\n"


def begun_upload(server, length="2000"):
    """A connection with half of an upload."""
    connection = socket.create_connection(("127.0.0.1", server.port), timeout=10)
    lines = [
        "POST /api/upload/x.npy HTTP/1.1", f"Host: {server.host}", f"Cookie: asperity-workbench={server.token}",
        f"Origin: http://{server.host}", f"Content-Length: {length}", "", "",
    ]
    connection.sendall("\r\n".join(lines).encode() + ROWS.encode()[:16] * 62 + b"1 2 3 4\n")
    return connection


def raw(server, text):
    """The begin of the answer to the bytes of a request."""
    with socket.create_connection(("127.0.0.1", server.port), timeout=10) as connection:
        connection.sendall(text.encode())
        return connection.recv(200).decode()


@pytest.fixture
def outside(tmp_path):
    """A folder beside that of the workbench, with a secret."""
    folder = tmp_path / "outside"
    folder.mkdir()
    (folder / "secret.toml").write_text('title = "secret"\n[compare]\n')
    (folder / "secret.txt").write_text("1 2 3\n4 5 6\n7 8 9\n")
    (folder / "secret.csv").write_text("height,radius\n1e-6,2e-5\n")
    return folder


def content(folder):
    """All files of a folder, with what they hold."""
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


# A page of another site.


@pytest.mark.parametrize("host", [
    "evil.example", "evil.example:{port}", "127.0.0.1", "127.0.0.1:1", "127.0.0.1:{port}.evil.example",
    "localhost.:{port}", "0.0.0.0:{port}", "127.1:{port}", "", None,
])
def test_a_request_for_another_host_is_refused(server, host):
    """A name that leads to this machine (DNS rebinding) is not its own."""
    host = host and host.format(port=server.port)
    for path in ["/", f"/?token={server.token}", "/api/files"]:
        assert server.request("GET", path, headers={"Host": host}).status == 421


def test_own_hosts_are_served(server):
    """All names of this machine that browsers send."""
    for host in ["127.0.0.1", "localhost", "LOCALHOST", "[::1]"]:
        assert server.request("GET", "/api/files", headers={"Host": f"{host}:{server.port}"}).status == 200


def test_a_second_host_is_refused(server):
    """Nobody can choose which of two hosts counts."""
    cookie = f"Cookie: asperity-workbench={server.token}"
    lines = ["GET /api/files HTTP/1.1", f"Host: {server.host}", "Host: evil.example", cookie, "", ""]
    assert " 421 " in raw(server, "\r\n".join(lines))


@pytest.mark.parametrize("origin", [
    "http://evil.example", "null", "", "https://{host}", "http://127.0.0.1:1", "http://127.0.0.1", "http://{host}/",
    "http://{host}.evil.example", "http://evil@{host}",
])
def test_a_request_of_another_origin_is_refused(server, origin):
    """Also with the cookie, and of another port."""
    headers = {"Origin": origin.format(host=server.host)}
    assert server.post("/api/text", {"spec": SPEC}, headers=headers).status == 403
    assert server.request("GET", "/api/files", headers=headers).status == 403


def test_what_changes_something_names_its_origin(server):
    """A request that is no reading needs an origin."""
    for path in ["/api/text", "/api/example", "/api/close", "/api/upload/a.csv"]:
        assert server.post(path, {"spec": SPEC}, origin=False).status == 403
    assert not list(server.folder.iterdir())


def test_a_cross_site_request_is_refused(server):
    """Browsers say where a request comes from."""
    for site in ["cross-site", "same-site", "Cross-Site", ""]:
        assert server.request("GET", "/api/files", headers={"Sec-Fetch-Site": site}).status == 403
        assert server.post("/api/text", {"spec": SPEC}, headers={"Sec-Fetch-Site": site}).status == 403


def test_a_form_or_text_is_no_request(server):
    """What a page of another site could send without being asked is not accepted."""
    for media in ["text/plain", "application/x-www-form-urlencoded", "multipart/form-data"]:
        answer = server.post("/api/text", json.dumps({"spec": SPEC}), headers={"Content-Type": media})
        assert answer.status == 415


def test_no_other_site_is_allowed_to_read(server):
    """There are no headers for other origins, also before a request."""
    headers = {"Origin": "http://evil.example", "Access-Control-Request-Method": "POST"}
    answer = server.request("OPTIONS", "/api/text", headers=headers, cookie=False)
    assert answer.status == 403
    for answer in [answer, server.request("GET", "/api/files")]:
        assert not [name for name in answer.headers if name.lower().startswith("access-control")]


@pytest.mark.parametrize("method", ["PUT", "DELETE", "PATCH", "OPTIONS", "TRACE"])
def test_other_methods_are_refused(server, method):
    """Only GET and POST do something."""
    headers = {"Origin": f"http://{server.host}"}
    assert server.request(method, "/api/files", headers=headers).status == 405
    assert server.request(method, "/api/files").status == 403


# Whoever has no token.


def test_without_the_cookie_nothing_is_told(server):
    """Neither files nor the page."""
    for path in ["/", "/api/files", "/api/vocabulary", "/assets/app.js", "/nothing", "/a/b"]:
        answer = server.request("GET", path, cookie=False)
        assert answer.status == 401 and server.token not in answer.text and "set-cookie" not in answer.headers
    for path in ["/api/text", "/api/upload/a.csv", "/api/analyse", "/api/report", "/api/close"]:
        assert server.post(path, {"spec": SPEC, "name": "a"}, cookie=False).status == 401
    assert not list(server.folder.iterdir())


def test_a_wrong_cookie_is_refused(server):
    """Shorter, longer, of another name."""
    token = server.token
    for cookie in [f"token={token}", *(f"asperity-workbench={value}" for value in
                                       ["", token[:-1], f"{token}0", "0" * 64, f'"{token}"', f"%{token}"])]:
        assert server.request("GET", "/api/files", headers={"Cookie": cookie}).status == 401


def test_the_token_counts_only_in_the_first_address(server):
    """Not in other addresses, headers or methods."""
    token = server.token
    headers = {"Authorization": f"token {token}", "X-Token": token, "Referer": f"http://{server.host}/?token={token}"}
    assert server.request("GET", f"/api/files?token={token}", cookie=False, headers=headers).status == 401
    assert server.post(f"/?token={token}", "", cookie=False).status == 401
    assert server.request("HEAD", f"/?token={token}", cookie=False).status == 401
    for query in ["token=", f"token={token[:-1]}", f"Token={token}", f"a=token={token}", "token=" + "0" * 64]:
        assert server.request("GET", f"/?{query}", cookie=False).status == 401


def test_the_first_address_gives_a_cookie_that_scripts_and_other_sites_do_not_get(server):
    """HttpOnly, SameSite=Strict, and the token is no longer in the address."""
    answer = server.request("GET", f"/?token={server.token}", cookie=False)
    assert answer.status == 200 and 'content="0;url=/"' in answer.text
    cookie = answer.headers["set-cookie"].split("; ")
    assert cookie[0] == f"asperity-workbench={server.token}" and {"HttpOnly", "SameSite=Strict", "Path=/"} <= {*cookie}


def test_answers_say_what_browsers_may_do(server):
    """No scripts of others, no frames, no guessed media types, nothing kept."""
    for path, cookie in [("/", True), ("/", False), ("/api/files", True), ("/assets/app.js", True)]:
        headers = server.request("GET", path, cookie=cookie).headers
        policy = dict(part.strip().partition(" ")[::2] for part in headers["content-security-policy"].split(";"))
        assert policy["default-src"] == "'none'" and policy["script-src"] == "'self'"
        assert policy["connect-src"] == "'self'" and policy["frame-ancestors"] == "'none'"
        assert policy["base-uri"] == policy["form-action"] == "'none'"
        assert headers["x-content-type-options"] == "nosniff" and headers["x-frame-options"] == "DENY"
        assert headers["referrer-policy"] == "no-referrer" and headers["cache-control"] == "no-store"
        assert headers["cross-origin-resource-policy"] == headers["cross-origin-opener-policy"] == "same-origin"


def test_it_listens_on_this_machine_alone(server):
    """No address of a network answers."""
    lines = [*pathlib.Path("/proc/net/tcp").read_text().splitlines()[1:],
             *pathlib.Path("/proc/net/tcp6").read_text().splitlines()[1:]]
    fields = [line.split() for line in lines]
    listening = [one[1].split(":")[0] for one in fields if one[3] == "0A" and one[1].endswith(f":{server.port:04X}")]
    assert listening and {*listening} <= {"0100007F", "00000000000000000000000001000000"}


def test_the_token_is_private(server):
    """Only its owner can read its file."""
    path = server.config / "asperity" / "workbench-token"
    assert path.read_text().strip() == server.token and path.stat().st_mode & 0o777 == 0o600


def test_the_token_is_in_no_argument_of_a_program(start, tmp_path):
    """All users of a machine see the arguments of all programs: the browser is given something else."""
    (tmp_path / "bin").mkdir()
    seen = tmp_path / "seen"
    program = tmp_path / "bin" / "xdg-open"
    program.write_text(f"#!/bin/sh\necho \"$@\" > {seen}.new\nmv {seen}.new {seen}\n")
    program.chmod(0o755)
    server = start(path=tmp_path / "bin")
    assert wait_for(seen.exists)
    assert server.token not in seen.read_text()


# Paths.

WAYS_OUT = [
    "../outside/secret.toml", "sub/../../outside/secret.toml", "./../outside/secret.toml", "link.toml",
    "link/secret.toml", "..\\outside\\secret.toml", "sub\\..\\..\\outside\\secret.toml", "%2e%2e/outside/secret.toml",
    "..%2foutside%2fsecret.toml", "inside.toml\0", "/etc/passwd", "/dev/zero", "file:///etc/passwd", "..", "",
]


@pytest.fixture
def led_out(server, outside):
    """A workbench with links that lead out of its folder."""
    (server.folder / "sub").mkdir()
    (server.folder / "inside.toml").write_text('title = "inside"\n[compare]\n')
    (server.folder / "link.toml").symlink_to(outside / "secret.toml")
    (server.folder / "link.csv").symlink_to(outside / "secret.csv")
    (server.folder / "link").symlink_to(outside)
    (server.folder / "nowhere.toml").symlink_to(outside / "made.toml")
    return server


def test_no_file_outside_is_opened(led_out, outside):
    """By no path and no link."""
    for path in [*WAYS_OUT, str(outside / "secret.toml")]:
        for request in ["/api/open", "/api/begin"]:
            answer = led_out.post(request, {"path": path})
            assert answer.status == 422 and '"secret"' not in answer.text, path
    assert led_out.post("/api/open", {"path": "inside.toml"}).json["spec"]["title"] == "inside"


def test_no_folder_outside_is_that_of_a_spec(led_out):
    """The folder of a request is in that of the workbench."""
    for folder in ["..", "/", "/etc", "link", "sub/..", "sub/../..", "nothing", "sub\0", ".."]:
        for path in ["/api/text", "/api/analyse", "/api/save", "/api/report"]:
            assert led_out.post(path, {"spec": SPEC, "folder": folder, "name": "a"}).status == 422, (path, folder)


def test_nothing_outside_is_listed(led_out):
    """Links are neither followed nor listed."""
    assert [entry["path"] for entry in led_out.request("GET", "/api/files").json] == ["inside.toml"]


def test_a_spec_reads_no_file_outside(led_out, outside):
    """By a map, a list of asperities, or measured points; and it is not told whether there is one."""
    for path in ["../outside/secret", "link/secret", str(outside / "secret"), "../outside/nothing"]:
        overlay = {
            **SPEC, "surface": None, "compare": None, "material": {**SPEC["material"], "lead": {"from": "lead"}},
            "indentation": {
                "ball": "steel", "radius": "5 mm", "flat": "steel", "law": "zmc",
                "layer": {"material": "lead", "thickness": "1 um"}, "overlay": f"{path}.csv",
                "indentation": {"from": "1 nm", "to": "1 um", "points": 10},
            },
        }
        for spec in [
            spec_of({"file": {"path": f"{path}.txt", "pixel": "1 um", "unit": "um"}}),
            spec_of({"asperities": {"file": f"{path}.csv", "nominal-area": "1 mm2"}}), overlay,
        ]:
            for request in ["/api/analyse", "/api/surface", "/api/heights", "/api/save", "/api/report"]:
                body = {"spec": spec, "folder": "", "surface": "a", "most": 10, "name": "a"}
                answer = led_out.post(request, body)
                assert answer.status == 422 and "a file in the folder of the workbench" in answer.text, answer.text
    assert not (led_out.folder / "a.toml").exists()


def test_a_spec_reads_no_device(server):
    """Neither a device nor a folder."""
    (server.folder / "sub").mkdir()
    for path in ["/dev/zero", "/dev/stdin", "/proc/self/environ", "sub"]:
        spec = spec_of({"file": {"path": path, "pixel": "1 um", "unit": "um"}})
        assert server.post("/api/analyse", {"spec": spec}).status == 422


def test_nothing_is_saved_outside(led_out, outside):
    """By no name and no link."""
    before = content(outside)
    names = ["../x", "sub/../../x", "link", "link/x", "nowhere", ".x", "..", "", "a\\b", "a:b", "a\n", "a\0", "x" * 300,
             "/tmp/workbench-x", "new/x", "con*", "<img src=x>"]
    for name in names:
        for request in ["/api/save", "/api/report"]:
            answer = led_out.post(request, {"spec": SPEC, "folder": "", "name": name})
            assert answer.status == 422 or "event: error" in answer.text, (request, name)
    assert content(outside) == before and not (outside.parent / "x.toml").exists()


def test_a_file_of_someone_else_is_not_overwritten(server):
    """Only a file that the page has read or written, and only as it was then."""
    path = server.folder / "a.toml"
    path.write_text("# mine\n")
    body = {"spec": SPEC, "folder": "", "name": "a"}
    for state in [None, "", "0" * 64]:
        assert server.post("/api/save", {**body, "state": state}).status == 422
        assert [name for name, _ in server.events("/api/report", {**body, "state": state})] == ["error"]
    assert path.read_text() == "# mine\n"
    state = server.post("/api/open", {"path": "a.toml"}).json["state"]
    assert server.post("/api/save", {**body, "state": state}).status == 200
    assert server.post("/api/save", {**body, "spec": {**SPEC, "seed": 2}, "state": state}).status == 422
    assert not parts(server)


def test_an_upload_keeps_what_is_there(server):
    """Another file of the same name gets a number; the same file is kept once."""
    sent = [("a.csv", ROWS), ("a.csv", 2 * ROWS), ("a.csv", ROWS)]
    found = [server.post(f"/api/upload/{name}", text).json["path"] for name, text in sent]
    assert found == ["uploads/a.csv", "uploads/a-2.csv", "uploads/a.csv"]
    assert (server.folder / "uploads" / "a.csv").read_text() == ROWS


def test_what_the_program_does_not_read_is_not_kept(server):
    """A picture, an empty file, a text of letters, a spec without an experiment."""
    for name, sent in [("a.png", "\x89PNG"), ("a.npy", ""), ("a.txt", "once upon a time"), ("a.toml", "title = 1")]:
        answer = server.post(f"/api/upload/{name}", sent)
        assert answer.status == 422 and answer.json["message"], name
    assert server.request("GET", "/api/files").json == [] and not parts(server)


@pytest.mark.parametrize("name", [
    "..%2f..%2fx.csv", "%2e%2e", "..", "%2fetc%2fx", "%5c..%5cx.csv", "x%00y.csv", ".hidden", "%0a", "a%3a%3ax",
    "a" * 2000, "%3Cimg%20src=x%20onerror=alert(1)%3E.csv",
])
def test_an_upload_stays_in_its_folder(server, name):
    """By whatever name it comes."""
    path = server.post(f"/api/upload/{name}", ROWS).json["path"]
    files = [one for one in server.folder.parent.rglob("*") if one.is_file() and one.read_bytes() == ROWS.encode()]
    assert files == [server.folder / path] and files[0].parent == server.folder / "uploads"
    assert not set(files[0].name) & set('\\:*?"<>|\n\0') and not files[0].name.startswith(".")


def test_linked_folders_of_the_workbench_are_not_written_to(server, outside):
    """Uploads, example and reports of which one is a link to elsewhere."""
    for name in ["uploads", "example", "reports"]:
        (server.folder / name).symlink_to(outside)
    before = content(outside)
    assert server.post("/api/upload/x.csv", ROWS).status == 422
    assert server.post("/api/example", {}).status == 422
    server.events("/api/report", {"spec": SPEC, "folder": "", "name": "r"})
    assert content(outside) == before


def test_a_linked_report_is_not_written_to(server, outside):
    """The folder of one report, and the lock of all of them, that is a link to elsewhere."""
    (server.folder / "reports").mkdir()
    (server.folder / "reports" / "r").symlink_to(outside)
    before = content(outside)
    events = server.events("/api/report", {"spec": SPEC, "folder": "", "name": "r"})
    assert events[-1][0] == "error" and content(outside) == before


def test_parts_outside_are_not_removed(start, tmp_path, outside):
    """Where `uploads` is a link to elsewhere, nothing is cleared up there."""
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder" / "uploads").symlink_to(outside)
    (outside / ".part-precious").write_text("mine")
    start()
    assert (outside / ".part-precious").exists()


# Reports.


@pytest.fixture
def reports(server):
    """The first part of the addresses of reports of a workbench with two reports, one of them hostile."""
    assert server.events("/api/report", {"spec": SPEC, "folder": "", "name": "r"})[-1][0] == "done"
    folder = server.folder / "hostile"
    folder.mkdir()
    (folder / "summary.json").write_text('{"program": "asperity", "title": "<img src=x>", "answer": "<b>x"}')
    (folder / "report.html").write_text("<script>fetch('/api/files')</script>")
    (server.folder / "private.json").write_text("{}")
    return server.request("GET", "/api/vocabulary").json["reports"]


def test_a_report_has_no_rights(server, reports):
    """It is shown in a sandbox, without an origin, and may fetch nothing."""
    for page in ["reports/r/report.html", "hostile/report.html"]:
        answer = server.request("GET", f"/{reports}/{page}", cookie=False, headers={"Sec-Fetch-Site": "cross-site"})
        policy = answer.headers["content-security-policy"]
        assert answer.status == 200 and policy.startswith("sandbox ") and "default-src 'none'" in policy
        assert "allow-same-origin" not in policy and "allow-forms" not in policy and "connect-src" not in policy
        assert "allow-top-navigation" not in policy and "escape-sandbox" not in policy
        assert server.token not in answer.text and answer.headers["x-content-type-options"] == "nosniff"


def test_pictures_of_reports_are_shown_in_their_pages(server, reports):
    """A page in a sandbox is of no origin: the policy of a resource must not keep its own pictures from it."""
    answer = server.request("GET", f"/{reports}/reports/r/card.svg", cookie=False)
    assert answer.status == 200 and answer.headers["content-security-policy"].startswith("sandbox ")
    assert answer.headers["cross-origin-resource-policy"] != "same-origin"


def test_only_files_of_reports_are_shown(server, reports, outside):
    """No other file of the folder, and none outside."""
    (server.folder / "hostile" / "link.html").symlink_to(outside / "secret.toml")
    for path in ["private.json", "r.toml", "hostile/../private.json", "hostile/%2e%2e/private.json", "%2fetc%2fpasswd",
                 "..%2foutside%2fsecret.csv", "hostile/link.html", "hostile", "reports/.lock", "."]:
        assert server.request("GET", f"/{reports}/{path}").status in (404, 422), path


def test_reports_lie_under_a_secret(server, reports):
    """Without the first part there is nothing, and with it only files of reports."""
    for key in ["0" * 64, reports[:-1], server.token, "hostile"]:
        assert server.request("GET", f"/{key}/hostile/report.html", cookie=False).status == 401
        assert server.request("GET", f"/{key}/hostile/report.html").status == 404
    assert server.post(f"/{reports}/hostile/report.html", "", cookie=False).status == 401
    assert server.request("GET", f"/{reports}/r", headers={"Host": "evil.example"}).status == 421


def test_html_of_files_is_text(server, reports):
    """Titles of reports and specs are no HTML of the page."""
    spec = copy.deepcopy(SPEC)
    spec["title"] = "<img src=x onerror=alert(1)>"
    spec["material"] = {"<b>steel": {"from": "steel-100Cr6"}}
    spec["compare"].update(rough="<b>steel", flat="<b>steel")

    def texts(value, key=""):
        if isinstance(value, str) and key not in ("title", "name"):
            yield value
        items = value.items() if isinstance(value, dict) else enumerate(value if isinstance(value, list) else [])
        for name, inner in items:
            yield from texts(inner, name)

    events = server.events("/api/analyse", {"spec": spec, "folder": ""})
    found = "\n".join(texts([value for _, value in events]))
    assert events[-1][0] == "done" and "<img src=x" not in found and "<b>steel" not in found
    assert server.post("/api/analyse", {"spec": {**SPEC, "surface": {"<i>": SPEC["surface"]["a"]}}}).status == 422
    entries = server.request("GET", "/api/files")
    assert entries.headers["content-type"] == "application/json" and "<img src=x>" in entries.text


def test_the_python_of_a_spec_is_only_the_spec(server):
    """The name of a folder, which can have lines, brings no code into it."""
    name = "a\nimport os  # "
    (server.folder / name).mkdir()
    spec = {**SPEC, "title": "a\"\"\"'\\\n\u2028</script>"}
    python = server.post("/api/text", {"spec": spec, "folder": name}).json["python"]
    statements = ast.parse(python).body
    assert [ast.unparse(one).partition(" ")[0] for one in statements[:2]] == ["import", "spec"] and len(statements) == 4
    assert ast.literal_eval(statements[1].value) == spec


# Files that are none.


def test_a_pipe_does_not_stop_the_list(server):
    """A pipe in the place of the summary of a report is not waited for."""
    (server.folder / "r").mkdir()
    os.mkfifo(server.folder / "r" / "summary.json")
    assert server.request("GET", "/api/files", timeout=1.5).status == 200


@pytest.mark.parametrize("path", ["/api/open", "/api/begin"])
def test_a_pipe_is_no_file(server, path):
    """It is refused, not waited for."""
    os.mkfifo(server.folder / "a.toml")
    assert server.post(path, {"path": "a.toml"}, timeout=1.5).status == 422


def test_a_summary_is_no_link_and_small(server, outside):
    """A link in its place tells nothing of a file outside; neither it nor a huge one fills the memory."""
    (outside / "summary.json").write_text('{"program": "asperity", "title": "outside", "answer": "x"}')
    for name in ["linked", "huge"]:
        (server.folder / name).mkdir()
    (server.folder / "linked" / "summary.json").symlink_to(outside / "summary.json")
    with open(server.folder / "huge" / "summary.json", "wb") as file:
        file.truncate(1 << 28)
    assert server.request("GET", "/api/files").json == []
    status = pathlib.Path(f"/proc/{server.process.pid}/status").read_text()
    peak = int(status.partition("VmHWM:")[2].split()[0])
    assert peak < 150_000, f"{peak} kB"


@pytest.mark.parametrize("text", [
    '{"program": "asperity", "title": "a", "answer": ' + "[" * 100_000 + "]" * 100_000 + "}", "", "{", "[]", "\xff",
], ids=range(5))
def test_a_broken_summary_is_no_report(server, text):
    """The list goes on without it."""
    (server.folder / "r").mkdir()
    (server.folder / "r" / "summary.json").write_text(text, "latin-1")
    assert server.request("GET", "/api/files").json == []


# Requests that are too much.


@pytest.mark.parametrize("body", [
    "", "{", "[1]", "1", "null", '{"spec": 1}', '{"spec": {"a": NaN}}', '{"spec": {"a": 1e999}}',
    '{"spec": {"a": 18446744073709551615}}',
    '{"spec": ' + "[" * 200_000 + "]" * 200_000 + "}", '{"spec": ' + '{"a":' * 100_000 + "1" + "}" * 100_000 + "}",
    '{"spec": {}, "spec": {}}', '{"spec": {"a": "\ud800"}}'.encode("utf-8", "surrogatepass"), '{"spec": {"a": [null]}}',
], ids=range(14))
def test_broken_json_is_refused(server, body):
    """Deep, doubled, cut off, not finite: an answer, and the server goes on."""
    answer = server.post("/api/text", body, headers={"Content-Type": "application/json"})
    assert answer.status in (400, 422)
    assert server.request("GET", "/api/files").status == 200


@pytest.mark.parametrize("text", [
    "a=" + "[" * 200_000, "a=" + "{a=" * 200_000, ".".join("a" * 200_000) + "=1", f"[{'.'.join('a' * 200_000)}]",
    f"[[{'.'.join('a' * 200_000)}]]", "\n".join(f"[{'.'.join('a' * k)}]" for k in range(1, 700)), "a=inf", "a=nan",
    "a=2026-01-01", "a=99999999999999999999", "a=9007199254740993", "a=1\na=2", '="' * 100_000,
    'a="""' + "x\n" * 200_000,
], ids=range(14))
def test_broken_toml_is_refused(server, text):
    """In a short time, and the server goes on."""
    start = time.monotonic()
    assert server.post("/api/parse", {"text": text}).status == 422
    (server.folder / "a.toml").write_text(text)
    assert server.post("/api/open", {"path": "a.toml"}).status == 422
    server.request("GET", "/api/files")
    assert time.monotonic() - start < 3


def test_a_large_request_is_refused(server):
    """A spec is at most 1 MiB, also one on disk."""
    assert server.post("/api/text", " " * ((1 << 20) + 1), headers={"Content-Type": "application/json"}).status == 413
    (server.folder / "a.toml").write_text("#" * ((1 << 20) + 1))
    assert server.post("/api/open", {"path": "a.toml"}).status == 422
    assert server.request("GET", "/api/files").json == []


def test_an_upload_that_says_it_is_too_large_is_refused(server):
    """Before any of it is written."""
    with begun_upload(server, str((2 << 30) + 1)) as connection:
        assert b" 422 " in connection.recv(200)
    for length in ["-1", "x", "18446744073709551616", "5, 6"]:
        with begun_upload(server, length) as connection:
            assert b" 400 " in connection.recv(200)
    assert not (server.folder / "uploads").exists()


def test_an_upload_that_is_broken_off_leaves_nothing(server):
    """Its part is removed, and it is not listed before."""
    with begun_upload(server):
        assert wait_for(lambda: parts(server))
        assert server.request("GET", "/api/files").json == []
    assert wait_for(lambda: not parts(server))


def test_a_second_workbench_leaves_an_upload_alone(start):
    """Parts of another workbench of the same folder are not old."""
    server = start()
    with begun_upload(server) as connection:
        assert wait_for(lambda: parts(server))
        start(server.folder)
        connection.sendall((b"5 1 7 2\n1 2 3 4\n" * 63)[:1000])
        assert b" 200 " in connection.recv(200)


@pytest.mark.parametrize("lines", [
    ["GET / HTTP/1.1", "X: " + "a" * 1_000_000], ["GET / HTTP/1.1", *(f"X{k}: a" for k in range(2000))],
    ["\x16\x03\x01\x02", "a"], ["GET / HTTP/9.9", "Host: a"], ["GET /%00 HTTP/1.1", "Host: a\0b"],
], ids=["long", "many", "tls", "version", "nul"])
def test_a_broken_request_is_refused(server, lines):
    """By an answer or by the end of the connection; the server goes on."""
    try:
        answer = raw(server, "\r\n".join([*lines, "", ""]))
    except ConnectionError:
        answer = ""
    assert " 200 " not in answer and server.request("GET", "/api/files").status == 200


@pytest.mark.parametrize("change", [
    {"count": 10**12}, {"count": 2**53}, {"count": 1e300}, {"count": -1}, {"count": 0}, {"count": 1.5},
    {"radius": "1e300 m"}, {"radius": "-1 um"}, {"sigma": "inf"}, {"sigma": "nan"}, {"density": "1e300 /m^2"},
], ids=str)
def test_a_surface_without_measure_is_refused(server, change):
    """Before any memory is taken, with its key."""
    population = {**SPEC["surface"]["a"]["population"], **change}
    answer = server.post("/api/analyse", {"spec": spec_of({"population": population})})
    assert answer.status == 422 and answer.json["key"] == f"surface.a.population.{next(iter(change))}"


def test_too_many_points_are_refused(server):
    """Of a map and of loads."""
    for points in [10**6, 10**12, 2**53]:
        spec = {**SPEC, "compare": {**SPEC["compare"], "separation": {"from": 3, "to": 0, "points": points}}}
        assert server.post("/api/analyse", {"spec": spec}).json["key"] == "compare.separation"
        spec = spec_of({"generate": {"points": points, "spectrum": SPECTRUM, "summits": SUMMITS}})
        assert server.post("/api/analyse", {"spec": spec}).status == 422


# Many, slow, and gone.


def test_slow_clients_do_not_keep_others_waiting(server):
    """Two hundred that have begun a request and do not end it."""
    slow = [socket.create_connection(("127.0.0.1", server.port), timeout=10) for _ in range(200)]
    try:
        for one in slow:
            one.sendall(b"GET / HTTP/1.1\r\nHo")
        start = time.monotonic()
        assert server.request("GET", "/api/files").status == 200 and time.monotonic() - start < 1
    finally:
        for one in slow:
            one.close()


def test_many_requests_at_once_are_answered(server):
    """Two hundred, of which twenty compute."""
    found = []

    def ask(place):
        body = {"spec": SPEC, "folder": "", "last": "models"}
        found.append(server.events("/api/analyse", body)[-1][0] if place % 10 == 0 else
                     server.request("GET", "/api/files").status)

    threads = [threading.Thread(target=ask, args=(place,)) for place in range(200)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found.count(200) == 180 and found.count("done") == 20


@pytest.mark.parametrize("path", ["/api/analyse", *(pytest.param(f"/api/{name}", marks=full) for name in ("surface", "heights", "report"))])
def test_what_nobody_waits_for_ends(server, path):
    """The computation of a page that is gone."""
    body = {"spec": long_spec(), "folder": "", "surface": "a", "most": 100, "name": "a"}
    connection = server.send("POST", path, body)
    assert wait_for(lambda: is_busy(server))
    connection.close()
    assert wait_for(lambda: not is_busy(server), 2)
    assert not (server.folder / "reports").exists()


@full
def test_a_file_that_changes_while_it_is_read_is_read_again(server):
    """What was found in a file is not kept for the one that has taken its place."""
    def text(height):
        return "\n".join(" ".join(str(height * (k * j % 7)) for k in range(1000)) for j in range(1000)) + "\n"

    path, new = server.folder / "m.txt", server.folder / "new.tmp"
    body = {"spec": spec_of({"file": {"path": "m.txt", "pixel": "1 um", "unit": "um"}}), "folder": "", "surface": "a"}

    def rms():
        events = server.events("/api/surface", body)
        return next(value["map"]["sq_m"] for name, value in events if name == "surface")

    path.write_text(text(1))
    new.write_text(text(9))
    found = []
    thread = threading.Thread(target=lambda: found.append(rms()))
    before = server.cpu()
    thread.start()
    assert wait_for(lambda: server.cpu() > before + 0.5)
    new.replace(path)
    thread.join()
    after = rms()
    server.post("/api/close", {})
    assert after == rms() and found[0] < after


def test_a_file_that_is_gone_is_an_error(server):
    """Also where its surface is kept."""
    rows = [" ".join(str(k * j % 7) for k in range(64)) for j in range(64)]
    (server.folder / "m.txt").write_text("\n".join(rows) + "\n")
    body = {"spec": spec_of({"file": {"path": "m.txt", "pixel": "1 um", "unit": "um"}}), "folder": "", "surface": "a"}
    assert server.events("/api/surface", body)[-1][0] == "done"
    (server.folder / "m.txt").unlink()
    assert server.post("/api/surface", body).status == 422


# The end.


def test_a_killed_workbench_starts_again(server):
    """With the same token, and without parts of files."""
    with begun_upload(server):
        assert wait_for(lambda: parts(server))
        token = server.token
        server.end(signal.SIGKILL)
    assert parts(server)
    server.start()
    assert server.token == token and not parts(server)
    assert server.request("GET", "/api/files").status == 200


def test_ctrl_c_ends_it_while_it_computes(server):
    """At once, with one line and exit code 0."""
    connection = server.send("POST", "/api/analyse", {"spec": long_spec(), "folder": ""})
    assert wait_for(lambda: is_busy(server))
    start = time.monotonic()
    assert server.end(signal.SIGINT) == 0 and time.monotonic() - start < 2
    assert "".join(server.errors).startswith("the workbench has ended") and len(server.errors) == 1
    connection.close()


def test_a_token_that_others_have_read_is_not_used_again(server):
    """A file that others could read is replaced."""
    path = server.config / "asperity" / "workbench-token"
    token = server.token
    server.end()
    path.chmod(0o644)
    server.start()
    assert server.token != token and path.stat().st_mode & 0o777 == 0o600


def resident(server):
    """Bytes of memory that it holds."""
    pages = pathlib.Path(f"/proc/{server.process.pid}/statm").read_text().split()[1]
    return int(pages) * os.sysconf("SC_PAGE_SIZE")


@full
def test_memory_returns_after_a_surface_is_closed(server):
    """A map of four million points, shown and closed."""
    side = 2048
    draw = random.Random(1).random
    heights = array.array("f", (1e-7 * draw() for _ in range(side * side)))
    head = f"{{'descr': '<f4', 'fortran_order': False, 'shape': ({side}, {side}), }}".ljust(117) + "\n"
    content = b"\x93NUMPY\x01\x00" + len(head).to_bytes(2, "little") + head.encode() + heights.tobytes()
    (server.folder / "large.npy").write_bytes(content)
    spec = {**SPEC, "surface": {"large": {"file": {"path": "large.npy", "pixel": "1 um"}}}}
    before = resident(server)
    found = server.events("/api/surface", {"spec": spec, "folder": "", "surface": "large"})
    assert found[-1][0] == "done", found[-1]
    held = resident(server) - before
    assert server.post("/api/close", {}).status == 200
    left = resident(server) - before
    assert held > 8 * side * side and left < held / 2, (held, left)

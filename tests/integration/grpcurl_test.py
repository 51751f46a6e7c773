"""Asks a daemon for health, services, fields, scenes and errors with grpcurl, which knows only what reflection tells.

Usage: grpcurl_test.py ISOFIELDD FOLDER
If grpcurl is not installed, go builds it in FOLDER. The test is skipped without go, or if the modules are out of reach.
"""

import base64
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

from served import start_daemon, stop_daemon

SKIPPED = 77
# Versions to try: the newest, then one that an older go can build.
VERSIONS = ("latest", "v1.8.9")

BALL = {"inline": {"nodes": [{"sphere": {"radius": 1, "range": 1}}]}}


def skip(why):
    print(f"\n******** SKIPPED, NOT PASSED: {why} ********\n", file=sys.stderr, flush=True)
    sys.exit(SKIPPED)


def find_grpcurl(folder):
    installed = shutil.which("grpcurl")
    built = folder / "grpcurl"
    if installed or built.exists():
        return installed or str(built)
    go = shutil.which("go") or shutil.which("/usr/local/go/bin/go")
    if go is None:
        skip("there is neither grpcurl nor go")
    folder.mkdir(parents=True, exist_ok=True)
    environment = {**os.environ, "GOBIN": str(folder), "GOPATH": str(folder / "path"), "GOFLAGS": "-modcacherw"}
    for version in VERSIONS:
        command = [go, "install", f"github.com/fullstorydev/grpcurl/cmd/grpcurl@{version}"]
        try:
            run = subprocess.run(command, env=environment, cwd=folder, capture_output=True, text=True, timeout=600)
        except subprocess.TimeoutExpired:
            skip("go does not build grpcurl within ten minutes")
        if run.returncode == 0:
            return str(built)
    skip(f"go cannot build grpcurl: {run.stderr[-400:]}")


def snake_case(answer):
    """Returns an answer with the fields' names of the .proto files, which only newer versions of grpcurl print."""
    if isinstance(answer, list):
        return [snake_case(part) for part in answer]
    if not isinstance(answer, dict):
        return answer
    return {re.sub("[A-Z]", lambda m: "_" + m[0].lower(), key): snake_case(part) for key, part in answer.items()}


class Grpcurl:
    def __init__(self, program, address):
        self.program, self.address = program, address

    def run(self, *arguments, data=None):
        command = [self.program, "-plaintext", *([] if data is None else ["-d", "@"]), self.address, *arguments]
        text = data if data is None or isinstance(data, str) else json.dumps(data)
        return subprocess.run(command, input=text, capture_output=True, text=True)

    def text(self, *arguments):
        run = self.run(*arguments)
        assert run.returncode == 0, f"{arguments}: {run.stderr}"
        return run.stdout

    def call(self, method, data=None):
        """Returns the answers; a stream may have several."""
        run = self.run(method, data=data)
        assert run.returncode == 0, f"{method}: {run.stderr}"
        answers, text = [], run.stdout.strip()
        while text:
            answer, end = json.JSONDecoder().raw_decode(text)
            answers.append(snake_case(answer))
            text = text[end:].strip()
        return answers

    def refused(self, method, data, code, *parts):
        run = self.run(method, data=data)
        assert run.returncode != 0, f"{method} was not refused: {run.stdout}"
        for part in (f"Code: {code}", *parts):
            assert part in run.stderr, f"{method}: {part!r} is not in: {run.stderr}"


def check_health(grpcurl):
    assert grpcurl.call("grpc.health.v1.Health/Check") == [{"status": "SERVING"}]
    of_one = {"service": "isofield.v1.MeshService"}
    assert grpcurl.call("grpc.health.v1.Health/Check", of_one) == [{"status": "SERVING"}]
    grpcurl.refused("grpc.health.v1.Health/Check", {"service": "none"}, "NotFound")


def check_reflection(grpcurl):
    services = grpcurl.text("list").split()
    expected = {f"isofield.v1.{name}Service" for name in ("Field", "Info", "Mesh", "Operator", "Scene", "Surface")}
    assert expected | {"grpc.health.v1.Health"} <= set(services), services
    for service in services:
        described = grpcurl.text("describe", service)
        assert f"{service} is a service" in described, described
        assert grpcurl.text("list", service).split(), service
    assert "rpc Check" in grpcurl.text("describe", "grpc.health.v1.Health")
    assert "repeated double numbers" in grpcurl.text("describe", "isofield.v1.Tensor")
    for version in "v1", "v1alpha":
        (answer,) = grpcurl.call(f"grpc.reflection.{version}.ServerReflection/ServerReflectionInfo",
                                 {"list_services": "*"})
        names = {service["name"] for service in answer["list_services_response"]["service"]}
        assert names == set(services), (version, names)


def check_fields(grpcurl):
    method = "isofield.v1.FieldService/Evaluate"
    asked = {"scene": BALL, "points": {"numbers": [0, 0, 0, 1, 0, 0]}, "answer_in_numbers": True}
    (answer,) = grpcurl.call(method, asked)
    assert answer["result"] == {"dtype": "FLOAT32", "shape": ["2", "1"], "numbers": [1, 0.5]}, answer
    (answer,) = grpcurl.call(method, {**asked, "quantity": "VALUE_AND_GRADIENT"})
    assert answer["result"]["shape"] == ["2", "4"] and len(answer["result"]["numbers"]) == 8, answer
    answers = grpcurl.call("isofield.v1.FieldService/EvaluateStream", {"scene": BALL, "points": asked["points"]})
    assert base64.b64decode(answers[0]["result"]["data"]) == b"\0\0\x80?\0\0\0?", answers
    grpcurl.refused(method, {"scene": BALL, "points": {"numbers": [1, 2]}}, "InvalidArgument",
                    "points.numbers holds 2 numbers", "multiple of 3")
    grpcurl.refused(method, {"scene": BALL, "points": {"numbers": [0, "NaN", 0]}}, "InvalidArgument", "points[0].y")
    grpcurl.refused(method, {"scene": BALL, "points": {"numbers": [0] * 3 * 4097}}, "InvalidArgument", "4096")
    grpcurl.refused(method, {"scene": {"name": "no\nsuch"}, "points": {"numbers": [0, 0, 0]}}, "NotFound",
                    r"'no\nsuch'")


def check_surfaces(grpcurl):
    (hits,) = grpcurl.call("isofield.v1.SurfaceService/CastRays", {
        "scene": BALL, "origins": {"numbers": [0, 0, -9, 5, 5, -9]}, "directions": {"numbers": [0, 0, 1, 0, 0, 1]},
        "answer_in_numbers": True})
    assert abs(hits["distances"]["numbers"][0] - 8) < 1e-3 and hits["distances"]["numbers"][1] == "Infinity", hits
    assert hits["nodes"]["numbers"] == [0, 4294967295] and hits["inside"]["numbers"] == [0, 0], hits
    (inside,) = grpcurl.call("isofield.v1.SurfaceService/Contains", {
        "scene": BALL, "points": {"numbers": [0, 0, 0, 3, 0, 0]}, "answer_in_numbers": True})
    assert inside["inside"]["numbers"] == [1, 0], inside
    (found,) = grpcurl.call("isofield.v1.SurfaceService/ProjectPoints", {
        "scene": BALL, "points": {"numbers": [1.2, 0, 0]}, "answer_in_numbers": True})
    assert abs(found["positions"]["numbers"][0] - 1) < 1e-4 and found["converged"]["numbers"] == [1], found
    (values,) = grpcurl.call("isofield.v1.OperatorService/EvaluateOperator", {
        "name": "sum", "columns": ["f1", "f2"], "arguments": {"numbers": [0.25, 0.5]}, "answer_in_numbers": True})
    assert values["results"]["numbers"] == [0.75, 1, 1], values
    grpcurl.refused("isofield.v1.SurfaceService/CastRays", {
        "scene": BALL, "origins": {"numbers": [0, 0, 0]}, "directions": {"numbers": [0, 0]}}, "InvalidArgument",
        "directions.numbers holds 2 numbers")


def check_scenes(grpcurl):
    scene = {"nodes": [{"name": "ball", "sphere": {"radius": 1, "range": 1}}]}
    grpcurl.call("isofield.v1.SceneService/PutScene", {"name": "kept", "scene": scene})
    (part,) = grpcurl.call("isofield.v1.SceneService/GetSceneParts", {"name": "kept"})
    assert part["summary"]["name"] == "kept" and b"ball" in base64.b64decode(part["data"]), part
    (got,) = grpcurl.call("isofield.v1.SceneService/GetScene", {"name": "kept"})
    assert got["scene"] == scene, got
    grpcurl.refused("isofield.v1.SceneService/GetScene", {"name": "kept", "max_answer_bytes": 10}, "ResourceExhausted",
                    "GetSceneParts")
    (listed,) = grpcurl.call("isofield.v1.SceneService/ListScenes")
    assert [summary["name"] for summary in listed["scenes"]] == ["kept"], listed
    grpcurl.call("isofield.v1.SceneService/DeleteScene", {"name": "kept"})
    grpcurl.refused("isofield.v1.SceneService/GetSceneParts", {"name": "kept"}, "NotFound", "'kept'")


def main():
    isofieldd, folder = sys.argv[1:]
    program = find_grpcurl(pathlib.Path(folder).absolute())
    daemon, address = start_daemon(isofieldd, "127.0.0.1:0")
    try:
        grpcurl = Grpcurl(program, address)
        for check in check_health, check_reflection, check_fields, check_surfaces, check_scenes:
            check(grpcurl)
            print(f"{check.__name__}: passed", flush=True)
    finally:
        stop_daemon(daemon)


if __name__ == "__main__":
    main()

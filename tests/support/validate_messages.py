#!/usr/bin/python3
"""Validates recorded sessions against the schemas of protocol/schema.

    validate_messages.py SCHEMA_FOLDER < session.txt
    validate_messages.py SCHEMA_FOLDER FOLDER_OF_SESSIONS

A line "> {...}" went from an agent to the server, "< {...}" came back; lines that begin with "#"
and empty lines are passed over, and so is "! ...", a line of an agent that is wrong on purpose. "s {...}"
is a scene for `poolhall simulate`, "r {...}" its result. A reply is held against the schema of the request with its id; an
error may answer anything. Prints how many messages were valid; exit code 1 and one line each for
those that were not.
"""
import json
import pathlib
import sys

import jsonschema

BASE = "https://poolhall.example/schema/"


def load(folder):
    store = {}
    for path in sorted(pathlib.Path(folder).glob("*.schema.json")):
        schema = json.loads(path.read_text(encoding="utf-8"))
        jsonschema.Draft202012Validator.check_schema(schema)
        store[schema["$id"]] = schema
    return store


class Schemas:
    def __init__(self, folder):
        self.store = load(folder)
        self.validators = {}

    def errors(self, message, file, definition=None):
        key = (file, definition)
        if key not in self.validators:
            schema = self.store[BASE + file]
            if definition is not None and definition not in schema["$defs"]:
                return [f"{file} has no $defs/{definition}"]
            resolver = jsonschema.RefResolver(BASE + file, schema, store=self.store)
            part = schema if definition is None else schema["$defs"][definition]
            self.validators[key] = jsonschema.Draft202012Validator(part, resolver=resolver)
        return [f"{e.json_path}: {e.message[:200]}"
                for e in self.validators[key].iter_errors(message)]


def check(schemas, direction, message, methods):
    if direction in "sr":
        return schemas.errors(message, {"s": "scene", "r": "simulation"}[direction] + ".schema.json")
    if direction == ">":
        methods[json.dumps(message.get("id"))] = message.get("method")
        return schemas.errors(message, "request.schema.json", message.get("method"))
    if "method" in message:
        return schemas.errors(message, "notification.schema.json", message["method"])
    if "error" in message:
        return schemas.errors(message, "error.schema.json")
    method = methods.get(json.dumps(message.get("id")))
    return (schemas.errors(message, "reply.schema.json")
            + schemas.errors(message.get("result"), "reply.schema.json", method))


def check_session(schemas, lines, name=""):
    methods, valid, wrong = {}, 0, 0
    for number, line in enumerate(lines, 1):
        line = line.rstrip("\n")
        if not line or line[0] in "#!":
            continue
        found = check(schemas, line[0], json.loads(line[2:]), methods)
        for error in found[:3]:
            print(f"{name}line {number}: {error}")
        wrong += bool(found)
        valid += not found
    return valid, wrong


def main():
    schemas = Schemas(sys.argv[1])
    if len(sys.argv) < 3:
        valid, wrong = check_session(schemas, sys.stdin)
        print(f"{valid} valid, {wrong} wrong")
        return 1 if wrong else 0
    valid, wrong, sessions = 0, 0, 0
    for path in sorted(pathlib.Path(sys.argv[2]).glob("*.txt")):
        with path.open(encoding="utf-8", newline="\n") as lines:
            found = check_session(schemas, lines, f"{path}: ")
        valid, wrong, sessions = valid + found[0], wrong + found[1], sessions + 1
    print(f"{valid} valid, {wrong} wrong in {sessions} sessions")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# Validates protocols against `physvib study schema`, as an editor does: the built-in ones and the examples pass, and
# what the program refuses by its fields alone does not. The part of JSON schema that the schema uses is written out
# here, from the standard library; other words of the schema are an error.
# Usage: schema.py PHYSVIB SOURCE_FOLDER
import json
import pathlib
import subprocess
import sys

KINDS = {"object": dict, "array": list, "string": str, "boolean": bool}
WORDS = {"$schema", "title", "type", "properties", "required", "additionalProperties", "items", "minItems", "maxItems",
         "minimum", "maximum", "maxLength", "enum", "const", "allOf", "if", "then"}


def is_of(kind, value):
    if kind in KINDS:
        return isinstance(value, KINDS[kind])
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return False
    return kind == "number" or value == int(value)


def faults(schema, value, at=""):
    """Lines "place: what is wrong" of a value."""
    unknown = set(schema) - WORDS
    if unknown:
        sys.exit(f"schema.py does not know {unknown}")
    if "type" in schema and not is_of(schema["type"], value):
        return [f"{at}: expected {schema['type']}"]
    found = []
    if "enum" in schema and value not in schema["enum"]:
        found.append(f"{at}: expected one of {schema['enum']}")
    if "const" in schema and value != schema["const"]:
        found.append(f"{at}: expected {schema['const']}")
    if isinstance(value, str) and len(value) > schema.get("maxLength", len(value)):
        found.append(f"{at}: too long")
    if is_of("number", value):
        if value < schema.get("minimum", value) or value > schema.get("maximum", value):
            found.append(f"{at}: out of range")
    if isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            found.append(f"{at}: {len(value)} items")
        for index, item in enumerate(value):
            found += faults(schema.get("items", {}), item, f"{at}[{index}]")
    if isinstance(value, dict):
        properties = schema.get("properties", {})
        found += [f"{at}: lacks {name}" for name in schema.get("required", []) if name not in value]
        for name, field in value.items():
            if name in properties:
                found += faults(properties[name], field, f"{at}.{name}")
            elif schema.get("additionalProperties", True) is False:
                found.append(f"{at}: unknown field {name}")
    for part in schema.get("allOf", []):
        found += faults(part, value, at)
    if "if" in schema and not faults(schema["if"], value, at):
        found += faults(schema.get("then", {}), value, at)
    return found


def main(program, source):
    schema = json.loads(subprocess.run([program, "study", "schema"], check=True, capture_output=True).stdout)
    root = pathlib.Path(source)
    files = [*(root / "Docs/protocol-examples").glob("*.json"), *(root / "Source/Lab/Protocols").glob("*.json")]
    wrong = []
    for file in files:
        wrong += [f"{file.name}{line}" for line in faults(schema, json.loads(file.read_text()))]
    # faults that fields alone show
    spoiled = refused = 0
    for file in (root / "Docs/protocol-examples").glob("*.json"):
        for change in (lambda d: d.update(nonsense=1), lambda d: d.pop("name"), lambda d: d["sessions"][0].update(task="x"),
                       lambda d: d["sessions"][0].update(repetitions=0.5), lambda d: d["conditions"][0].pop("stimuli"),
                       lambda d: d["sessions"][0].update(break_s=-1), lambda d: d.update(conditions=[])):
            protocol = json.loads(file.read_text())
            change(protocol)
            spoiled += 1
            refused += bool(faults(schema, protocol))
    print("\n".join(wrong) or f"{len(files)} protocols fit the schema, {refused} of {spoiled} spoiled ones do not")
    return 1 if wrong or refused < spoiled or len(files) < 15 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The addon's tables of properties, methods and signals, and the help of its classes, say the same; needs no Godot.

Usage: tables.py ROOT"""
import pathlib
import re
import sys
import xml.etree.ElementTree as xml

root = pathlib.Path(sys.argv[1]) / "Source/Api/Godot"
types = {"real": "float", "boolean": "bool", "text": "String", "vector2": "Vector2", "stringArray": "PackedStringArray", "vector2Array": "PackedVector2Array", "dictionary": "Dictionary",
         "integer": "int", "object": "HapticMaterial", "nil": "void"}
bodies, worlds = (root / name for name in ("Bodies.cpp", "WorldClasses.cpp"))


def rows(text):
    """Names and types of a table in C++."""
    return [(name, types[kind]) for name, kind in re.findall(r'\{\s*"(\w+)",\s*type::(\w+),', text) if kind in types]


def between(path, begin, end):
    return path.read_text().split(begin, 1)[1].split(end, 1)[0]


def world(is_space):
    text = between(worlds, "makeProperties(bool is3d)", "\n}")
    found = rows(text)
    assert '{"field_corner", is3d ? type::vector3 : type::vector2,' in text, "field_corner: expected one of 2D and of 3D"
    found.insert(1, ("field_corner", "Vector3" if is_space else "Vector2"))
    return found


methods = [row for row in rows(between(worlds, "methods{", "};")) if not row[0].startswith("_")]  # those the addon calls itself have no help
expected = {"HapticBody": (rows(between(bodies, "bodyProperties() {", "return all")), []),
            "HapticMaterial": (rows(between(bodies, "materialProperties() {", "return all")), []),
            "HapticWorld2D": (world(False), methods), "HapticWorld3D": (world(True), methods)}
wrong = 0
for name, (properties, itsMethods) in expected.items():
    help_ = xml.parse(root / f"addons/physvib/doc_classes/{name}.xml").getroot()
    told = [(member.get("name"), member.get("type")) for member in help_.iter("member")]
    toldMethods = [(method.get("name"), method.find("return").get("type")) for method in help_.iter("method")]
    empty = [element.tag for element in help_.iter() if element.tag in ("member", "description") and not (element.text or "").strip()]
    for what, a, b in (("properties", properties, told), ("methods", itsMethods, toldMethods), ("texts that are empty", [], empty)):
        if a != b:
            wrong += 1
            print(f"{name}: {what}: the table has {a}, the help {b}")
print(f"{sum(len(p) + len(m) for p, m in expected.values())} entries of {len(expected)} classes compared, {wrong} wrong")
sys.exit(1 if wrong else 0)

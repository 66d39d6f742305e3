#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The addon's tables of properties, methods and signals, and the help of its classes, say the same; needs no Godot.

Usage: tables.py ROOT"""
import pathlib
import re
import sys
import xml.etree.ElementTree as xml

root = pathlib.Path(sys.argv[1]) / "Source/Api/Godot"
types = {"real": "float", "boolean": "bool", "text": "String", "vector2": "Vector2", "texts": "PackedStringArray", "places": "PackedVector2Array", "dictionary": "Dictionary", "GDEXTENSION_VARIANT_TYPE_VECTOR3": "Vector3",
         "GDEXTENSION_VARIANT_TYPE_BOOL": "bool", "GDEXTENSION_VARIANT_TYPE_INT": "int", "GDEXTENSION_VARIANT_TYPE_STRING": "String", "GDEXTENSION_VARIANT_TYPE_OBJECT": "HapticMaterial",
         "GDEXTENSION_VARIANT_TYPE_NIL": "void"}
bodies, worlds = (root / name for name in ("Bodies.cpp", "WorldClasses.cpp"))


def rows(text):
    """Names and types of a table in C++."""
    return [(name, types[kind]) for name, kind in re.findall(r'\{\s*"(\w+)",\s*(\w+),', text) if kind in types]


def between(path, begin, end):
    return path.read_text().split(begin, 1)[1].split(end, 1)[0]


def world(is_space):
    text = between(worlds, "propertiesOf(bool isSpace)", "\n}")
    found = rows(text)
    corners = [row for row in found if row[0] == "field_corner"]
    found = [row for row in found if row[0] != "field_corner"]
    found.insert(1, ("field_corner", "Vector3" if is_space else "Vector2"))
    assert len(corners) == 2, "field_corner: expected a row of 2D and one of 3D"
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

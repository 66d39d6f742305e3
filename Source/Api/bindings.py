#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes what Python, Lua, C# and JavaScript repeat of physvib.h and physvib-live.h: structures, constants and functions. Run it when a header has changed;
packages have what it writes, and need no Python. bindings.py [--check]: says which file is not what it would write; exit code 1. Whole files and parts of
files between two marks are written; what is around them, and what a language does with them, is that language's own."""
from __future__ import annotations

import re
import sys
from dataclasses import dataclass, field
from pathlib import Path

api = Path(__file__).resolve().parent


@dataclass
class Value:
    """A member of a structure, or a parameter; type "const physvib_event*", count "64" or ""."""
    type: str
    name: str
    count: str

    @property
    def base(self) -> str:
        return self.type.replace("const ", "").rstrip("*").replace("* const", "")

    @property
    def stars(self) -> int:
        return self.type.count("*")


@dataclass
class Header:
    constants: dict[str, str] = field(default_factory=dict)
    handles: list[str] = field(default_factory=list)
    structures: dict[str, list[Value]] = field(default_factory=dict)
    functions: dict[str, tuple[str, list[Value]]] = field(default_factory=dict)


def value_of(declaration: str) -> Value:
    found = re.fullmatch(r"((?:const )?\w+(?:\*| const)*) ?(\w+)(?:\[(\w+)\])?", " ".join(declaration.split()).replace(" *", "*"))
    if found is None:
        sys.exit(f"bindings.py: expected a type and a name, found {declaration!r}")
    return Value(found[1], found[2], found[3] or "")


def read(path: Path) -> Header:
    text, header = re.sub(r"/\*.*?\*/", "", path.read_text(), flags=re.S), Header()
    header.constants = dict(re.findall(r"^#define PHYSVIB_([A-Z0-9_]+) +\(?(-?[0-9.e+]+)\)?\s*$", text, flags=re.M))
    header.handles = re.findall(r"typedef struct physvib_\w+_name\* (physvib_\w+);", text)
    for name, body in re.findall(r"typedef struct (physvib_\w+) \{(.*?)\} \1;", text, flags=re.S):
        header.structures[name] = [value_of(one) for one in body.split(";")[:-1]]
    for result, name, given in re.findall(r"^PHYSVIB_API ([\w ]+\*?) ?(physvib_\w+)\((.*?)\);", text, flags=re.S | re.M):
        header.functions[name] = (result.strip(), [] if given == "void" else [value_of(one) for one in given.split(",")])
    return header


core, live = read(api / "C/physvib.h"), read(api / "Live/physvib-live.h")
handles, constants = core.handles + live.handles, core.constants | live.constants


def pascal(name: str) -> str:
    return "".join(word[:1].upper() + word[1:] for word in name.split("_"))


def camel(name: str) -> str:
    return name[0] + pascal(name)[1:]


# ---- Python: _header.py and _live_header.py ----

python_types = {"int": "c_int", "double": "c_double", "physvib_int64": "c_int64", "size_t": "c_size_t", "float": "c_float", "char": "c_char"}
numpy_types = {"int": "<i4", "double": "<f8", "physvib_int64": "<i8"}


def python_type(value: Value) -> str:
    if value.base == "char" and value.stars:
        return "c_char_p"
    if value.type in ("float*", "const float*") or value.base == "physvib_event":
        return "c_void_p"  # addresses of numpy's arrays
    made = python_types.get(value.base) or ("c_void_p" if value.base in handles else "C" + pascal(value.base[8:]))
    for _ in range(value.stars):
        made = f"POINTER({made})"
    return made


def python_member(value: Value) -> str:
    count = f" * {constants.get(value.count[8:], value.count)}" if value.count else ""
    return f'("{value.name}", {python_type(value)}{count})'


def python_parameter(value: Value) -> str:
    return f"POINTER({python_type(value)})" if value.count else python_type(value)


def wrapped(start: str, parts: list[str], end: str, between: str = ",", width: int = 160) -> str:
    """`start`, `parts` with `between` behind each but the last, `end`: in lines, each under the first part."""
    lines, indent = [start], " " * len(start)
    for i, part in enumerate(parts):
        part += between if i + 1 < len(parts) else end
        if lines[-1] not in (start, indent):
            part = " " + part
        if len(lines[-1]) + len(part) > width:
            lines.append(indent)
            part = part.lstrip()
        lines[-1] += part
    return "\n".join(lines)


def python_of(header: Header, of: str, before: str) -> str:
    text = f'# SPDX-License-Identifier: MIT\n"""What {of} declares, as ctypes and numpy have it. Written by Source/Api/bindings.py: change the header, not this file."""\n' + before
    text += "".join(f"{name} = {value}\n" for name, value in header.constants.items())
    for name, members in header.structures.items():
        if name == "physvib_event":
            columns = [f'("{one.name}", {repr("<u8") if one.base == "size_t" else repr(numpy_types[one.base])})'.replace("'", '"') for one in members]
            text += "\n" + wrapped("EVENT = np.dtype([", columns, "], align=True)") + "\n"
        else:
            text += f"\n\nclass C{pascal(name[8:])}(Structure):\n" + wrapped("    _fields_ = [", [python_member(one) for one in members], "]") + "\n"
    text += "\n\n#: Of each function its result and its parameters.\nsignatures: dict[str, tuple] = {\n"
    for name, (result, given) in header.functions.items():
        types = [python_type(Value(result, "", "")), *map(python_parameter, given)]
        text += f'    "{name[8:]}": ({", ".join(types)}{"," if len(types) == 1 else ""}),\n'
    return text + "}\n"


from_ctypes = ["POINTER", "Structure", "c_char", "c_char_p", "c_double", "c_float", "c_int", "c_int64", "c_size_t", "c_void_p"]


def imports(text: str) -> str:
    used = [name for name in from_ctypes if re.search(rf"\b{name}\b", text)]
    return f"from ctypes import {', '.join(used)}\n"


def python_files() -> dict[str, str]:
    first = python_of(core, "physvib.h", "")
    second = python_of(live, "physvib-live.h", "")
    return {"Python/physvib/_header.py": python_of(core, "physvib.h", f"from __future__ import annotations\n\n{imports(first)}\nimport numpy as np\n\n"),
            "Python/physvib/_live_header.py": python_of(live, "physvib-live.h",
                                                        f"from __future__ import annotations\n\n{imports(second)}\nfrom ._header import CRendererSettings\n\n")}


# ---- Lua: declarations of LuaJIT, whose compiler reads C without macros ----

def lua_type(value: Value) -> str:
    return value.type.replace("physvib_int64", "int64_t") + ("*" if value.count else "")


def lua_of(header: Header) -> str:
    text = "".join(f"typedef struct {name}_name* {name};\n" for name in header.handles)
    for name, members in header.structures.items():
        parts = []
        for one in members:
            count = f"[{constants.get(one.count[8:], one.count)}]" if one.count else ""
            kind = lua_type(Value(one.type, one.name, ""))
            same = parts and parts[-1].startswith(kind + " ") and "*" not in kind and len(parts[-1]) < 100
            if same:
                parts[-1] += f", {one.name}{count}"
            else:
                parts.append(f"{kind} {one.name}{count}")
        text += wrapped("typedef struct { ", parts, f"; }} {name};", ";") + "\n"
    for name, (result, given) in header.functions.items():
        text += f"{result.replace('physvib_int64', 'int64_t')} {name}({', '.join(map(lua_type, given)) or 'void'});\n"
    return text


# ---- C#: structures and imports; what its programs call is written by hand, in other parts of the same structures ----

sharp_types = {"int": "int", "double": "double", "physvib_int64": "long", "size_t": "UIntPtr"}
sharp_enums = {("physvib_event", "kind"): "Kind"}
lists = {"events", "samples", "motors", "devices", "lives", "starts_ns", "text"}  # these parameters are arrays, other pointers one of it


def sharp_name(name: str) -> str:
    for unit, there in (("_n_s", "_Ns"), ("_m_per_s", "MPerS"), ("_m", "_m")):
        if name.endswith(unit) and not name.endswith("_s_per_m"):
            return pascal(name[:-len(unit)]) + there
    return pascal(name)


def sharp_structure(name: str, members: list[Value]) -> str:
    text = f"[StructLayout(LayoutKind.Sequential)]\npublic partial struct {pascal(name[8:])} {{\n"
    run: list[str] = []
    before = ""
    for one in [*members, Value("", "", "")]:
        if one.base == "char" or one.stars or one.base == "size_t":  # other parts of the structure make texts of them
            kind, called = ("byte[]" if one.base == "char" and not one.stars else "UIntPtr" if one.base == "size_t" else "IntPtr"), camel(one.name)
        elif one.name == "unused":
            kind, called = "int", one.name
        else:
            kind = sharp_enums.get((name, one.name)) or sharp_types.get(one.base, pascal(one.base[8:]))
            kind, called = f"public {kind}{'[]' if one.count else ''}", sharp_name(one.name)
        if one.count:
            kind = f"[MarshalAs(UnmanagedType.ByValArray, SizeConst = {constants.get(one.count[8:], one.count)})] {kind}"
        if kind != before or one.count:
            text += f"    {before} {', '.join(run)};\n" if run else ""
            before, run = kind, []
        run.append(called)
    return text + "}\n"


def sharp_parameter(value: Value) -> str:
    name = "what" if value.name == "event" else camel(value.name)  # a word of C#
    if value.base == "char":
        return f"[Out] byte[] {name}" if not value.type.startswith("const") else f"byte[] {name}"
    if value.count:
        return f"double[] {name}"
    if value.stars == 0:
        return f"{'IntPtr' if value.base in handles else sharp_types[value.base]} {name}"
    if value.stars == 2:
        return f"IntPtr[] {name}"
    is_read = value.type.startswith("const")
    if value.base in handles:
        return f"IntPtr[] {name}" if is_read else f"out IntPtr {name}"
    kind = "float" if value.base == "float" else sharp_types.get(value.base) or pascal(value.base[8:])
    if value.name in lists:
        return f"{'' if is_read else '[In, Out] '}{kind}[] {name}"
    return f"{'out' if kind == 'double' else 'ref'} {kind} {name}"


def sharp_of(header: Header, natives: str) -> str:
    text = "\n".join(sharp_structure(*one) for one in header.structures.items())
    text += f"\nstatic partial class {natives} {{\n"
    for name, (result, given) in header.functions.items():
        kind = "IntPtr" if "*" in result else sharp_types[result]
        text += f"    [DllImport(Library)] internal static extern {kind} {name}({', '.join(map(sharp_parameter, given))});\n"
    return text + "}\n"


# ---- JavaScript: what it calls the members; where they are, the module says ----

script_names = {"is_camera": "isSource", "rate_hz": "rate", "field_radians": "fieldAngle", "point_id": "point"}
script_units = ("_kg_m2", "_m_per_s", "_s_per_m", "_n_s", "_m")


def script_name(name: str) -> str:
    if name in script_names:
        return script_names[name]
    for unit in script_units:
        if name.endswith(unit):
            return camel(name[:-len(unit)])
    return camel(name[:-2]) if name == "settling_s" else camel(re.sub("_per_s$", "_per_second", name))


def script_of() -> str:
    text = ""
    for name, members in core.structures.items():
        if name != "physvib_motors":  # its Pad is a class of its own
            told = [one for one in members if one.name not in ("size", "unused") and one.base != "char"]
            text += wrapped(f"    {name}: {{ ", [f"{one.name}: '{script_name(one.name)}'" for one in told], " },") + "\n"
    return text


# ---- Files ----

def between_marks(path: str, mark: str, inside: str) -> str:
    text = (api / path).read_text()
    begin, end = f"{mark} Written by Source/Api/bindings.py: change the header, not this.\n", f"{mark} End of what bindings.py has written.\n"
    if text.count(begin) != 1 or text.count(end) != 1:
        sys.exit(f"bindings.py: {path}: expected the two lines around what it writes, once each")
    return text[:text.index(begin)] + begin + inside + text[text.index(end):]


def main() -> int:
    files = {**python_files(),
             "Lua/physvib.lua": between_marks("Lua/physvib.lua", "--", f"ffi.cdef [[\n{lua_of(core)}{lua_of(live)}]]\n"),
             "CSharp/PhysVib.cs": between_marks("CSharp/PhysVib.cs", "//", sharp_of(core, "Native")),
             "CSharp/PhysVibLive.cs": between_marks("CSharp/PhysVibLive.cs", "//", sharp_of(live, "LiveNative")),
             "JavaScript/package/names.js": between_marks("JavaScript/package/names.js", "//", f"export const names = {{\n{script_of()}}};\n")}
    old = {path: (api / path).read_text() if (api / path).exists() else "" for path in files}
    changed = [path for path, text in files.items() if text != old[path]]
    if "--check" in sys.argv[1:]:
        for path in changed:
            print(f"Source/Api/{path}: is not what the headers say; run Source/Api/bindings.py")
        return 1 if changed else 0
    for path in changed:
        (api / path).write_text(files[path])
        print(f"Source/Api/{path}: written")
    return 0


sys.exit(main())

# SPDX-License-Identifier: MIT
"""What C can, Python, Lua, C# and JavaScript can: every function of physvib.h is called in each of them, and TypeScript knows every member. alike.py ROOT.
What a language leaves out is named below, with its reason. Structures are written by Source/Api/bindings.py, and are no matter of this."""
import re
import sys
from pathlib import Path

root = Path(sys.argv[1])
header = re.sub(r"/\*.*?\*/", "", (root / "Source/Api/C/physvib.h").read_text(), flags=re.S)

LEFT_OUT = {
    "Python": {"event_init", "renderer_pull_interleaved", "events_save"},  # numpy makes events; its arrays are a row per channel; lists are saved with their field or none
    "Lua": set(),
    "C#": {"event_init", "renderer_pull"},  # an Event is zeros; Unity and Godot take frame by frame
    "JavaScript": {"renderer_pull_interleaved", "layout_load", "layout_save", "events_load", "events_load_field", "events_save", "events_save_field", "wav_save",  # an array per channel; a page has no files, but texts and bytes
                   "material_name", "material", "material_load", "sound", "event_of", "renderer_impact", "renderer_impact_of",  # impact.js makes them of the same tables
                   "pads_create", "pads_free", "pads_strike", "pads_send", "pads_pull", "pads_stop", "pads_set_level"},  # its Pad is the same class with a timer per command
}


functions = re.findall(r"PHYSVIB_API [^;]*?physvib_(\w+)\(", header)
python = "\n".join(path.read_text() for path in (root / "Source/Api/Python/physvib").glob("*.py") if "live" not in path.name)
lua = (root / "Source/Api/Lua/physvib.lua").read_text()
sharp = (root / "Source/Api/CSharp/PhysVib.cs").read_text()
live_header = re.sub(r"/\*.*?\*/", "", (root / "Source/Api/Live/physvib-live.h").read_text(), flags=re.S)
live_python = (root / "Source/Api/Python/physvib/live.py").read_text()
live_sharp = (root / "Source/Api/CSharp/PhysVibLive.cs").read_text()
script = "\n".join(path.read_text() for path in sorted((root / "Source/Api/JavaScript/package").glob("*.js")))
faults = []


def demand(language: str, kind: str, name: str, is_there: bool) -> None:
    if not is_there and name not in LEFT_OUT[language]:
        faults.append(f"{language}: {kind} {name} of physvib.h is missing")
    if is_there and name in LEFT_OUT[language]:
        faults.append(f"{language}: {name} is there, and stands among what is left out")


for name in functions:
    called_in_python = re.search(rf'"{name}"[,)\n]|physvib_{name}\b', python.replace(f'"{name}": (', "")) is not None
    demand("Python", "function", name, called_in_python)
    demand("Lua", "function", name, re.search(rf"physvib_{name}\(", lua) is not None)
    demand("JavaScript", "function", name, re.search(rf"(?:call|tell)\('{name}'|'physvib_{name}'|physvib_{name}\(", script) is not None or name.endswith("_init") and f"'{name[:-5]}'" in script)
    demand("C#", "function", name, len(re.findall(rf"physvib_{name}\(", sharp)) > 1)  # declared and called


# Session files are Python's and C's; live_send of Lua is follow's and strike's.
for name in re.findall(r"PHYSVIB_API [^;]*?physvib_(live_\w+)\(", live_header):
    if name != "live_error" and f'"{name}"' not in live_python:
        faults.append(f"Python: function {name} of physvib-live.h is missing")
    if len(re.findall(rf"physvib_{name}\(", live_sharp)) < 2:
        faults.append(f"C#: function {name} of physvib-live.h is missing")
    if name != "live_send" and f"physvib_{name}(" not in lua:
        faults.append(f"Lua: function {name} of physvib-live.h is missing")

# The members of structures, as bindings.py calls them in names.js, in physvib.d.ts, which has words on each.
types = (root / "Source/Api/JavaScript/package/physvib.d.ts").read_text()
known = set(re.findall(r"(\w+)\??:", types)) | {"count", "renderer"}  # the length of places; settings there
for name in sorted(set(re.findall(r"\w+: '(\w+)'", (root / "Source/Api/JavaScript/package/names.js").read_text())) - known):
    faults.append(f"JavaScript: {name} of names.js is missing in physvib.d.ts")

print("\n".join(faults) or f"{len(functions)} functions are called in each language")
sys.exit(1 if faults else 0)

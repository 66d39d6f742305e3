#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""JSON and AHAP of every kind, made here by rule: texts.py PHYSVIB. Each is read, or refused in one line that names the file; JSON as RFC 8259 has it,
but a field twice and more than 16 levels are refused, and .ahap may have a comma after the last item. Exit code 1 if one is otherwise."""
import concurrent.futures
import itertools
import json
import subprocess
import sys
import tempfile
from pathlib import Path

cases = []  # ending, name, bytes, whether it is read


def case(ending, name, content, is_read):
    cases.append((ending, name, content if isinstance(content, bytes) else content.encode(), is_read))


def layout(width="0.1", name='"two"', fields="", front="", behind=""):
    return f'{front}{{"name": {name}, "extent_m": [{width}, 0.06], "enchanters": [{{"x_m": 0, "y_m": 0.03}}, {{"x_m": 1e-1, "y_m": 0.03{fields}}}]}}{behind}'


def pattern(events, front='"Version": 1, '):
    return f'{{{front}"Pattern": [{events}]}}'


def event(fields='"Time": 0.0, "EventType": "HapticTransient"'):
    return f'{{"Event": {{{fields}}}}}'


def numbers():
    whole, fraction, exponent = ("0", "1", "10", "123"), ("", ".0", ".5", ".123456789012345678"), ("", "e0", "E-1", "e+1", "e-30")
    for text in ("".join(parts) for parts in itertools.product(whole, fraction, exponent)):
        case("json", f"number {text}", layout(text), float(text) >= 0.1)  # where the second actuator is
    wrong = ["", "+1", "01", "-01", "00", ".5", "5.", "5.e1", "1e", "1e+", "1E-", "e1", "0x10", "0b1", "1_000", "1,5", "1 000", "NaN", "nan", "Infinity", "-Infinity", "inf", "1e400", "-", "--1", "1-", "1.2.3", "1e5.5",
             "\u22121", "\uff11", "1\u00a0", "40%", "1f", "1L", "1n", "0o7", "$1", '"1"', "true", "null", "[1]", "{}", "1//", "1/*x*/", "TRUE", "(1)", "1;", "'1'"]
    for text in wrong:
        case("json", f"number {text!r}", layout(text), False)
        case("ahap", f"number {text!r}", pattern(event(f'"Time": {text}, "EventType": "HapticTransient"')), False)
    for text in ("0", "-0", "-0.0", "1e-400", "0.1", "1E0", "1.5e0", "0.000000000000000001", "12"):
        case("ahap", f"number {text}", pattern(event(f'"Time": {text}, "EventType": "HapticTransient"')), not text.startswith("-1"))


def strings():
    right = ["a", "", "ä", "\U0001f600", "\\u00e4", "\\ud83d\\ude00", '\\"', "\\\\", "\\/", "a\\u0020b", "\u2028", "\\uD834\\uDD1E"]
    wrong = ["\\x41", "\\u12", "\\u12G4", "\\U0041", "\\", "\\ud83d", "\\ude00\\ud83d", "\\ud83d\\u0041", "\n", "\t", "\0", "\\'", "\\0", '"', "\\u", "\x1f"]
    for text in right + ["x" * 150]:
        case("ahap", f"string {text!r}", pattern(event(), f'"Version": 1, "Metadata": {{"Project": "{text}"}}, '), True)
    for text in wrong:
        for ending, whole in (("json", layout(name=f'"{text}"')), ("ahap", pattern(event(), f'"Version": 1, "Metadata": {{"Project": "{text}"}}, '))):
            case(ending, f"string {text!r}", whole, False)
    for quotes in ("'two'", "two", "\u201ctwo\u201d", '"two', 'two"', '"two""', "`two`"):
        case("json", f"quotes {quotes}", layout(name=quotes), False)
    for raw in (b"\xff", b"\xc3", b"\xc0\xaf", b"\xed\xa0\x80", b"\xf4\x90\x80\x80", b"\xe4", b"\x80", b"\xf0\x9f\x98", b"\xfe\xff"):
        case("json", f"bytes {raw!r}", layout(name='"@"').encode().replace(b"@", raw), False)
        case("ahap", f"bytes {raw!r}", pattern(event(), '"Metadata": {"Project": "@"}, ').encode().replace(b"@", raw), False)


def shapes():
    for space in (" ", "\n", "\r\n", "\t", "\r", " \n\t ", "\n" * 2000):
        case("json", f"space {space[:4]!r}", layout(front=space, behind=space), True)
    for space in ("\u00a0", "\f", "\v", "\u2060", "\u3000", "\u2003", "\0", "\x1f"):
        case("json", f"before {space!r}", layout(front=space), False)
        case("json", f"behind {space!r}", layout(behind=space), False)
    for behind in (",", "]", "}", "{}", "1", "#", "// x", "/* x */", "x", "\0", "\0\0\0", '"', ";", "[", "\n\0", "null"):
        case("json", f"behind {behind!r}", layout(behind=behind), False)
        case("ahap", f"behind {behind!r}", pattern(event()) + behind, False)
    for front in ("// x\n", "/* x */", "# x\n", "<!-- -->", ")]}',\n", "var x = ", "(", "[", ","):
        case("json", f"before {front!r}", layout(front=front), False)
    whole = layout()
    for end in range(0, len(whole), 3):
        case("json", f"cut at {end}", whole[:end], False)
    for text in ("", " ", "[]", "{}", "null", "true", "0", '""', "[", "]", "{", "}", "[[]", "{]", '{"a"}', '{"a":}', "{:1}", "{1:1}", "{a:1}", '{"a" 1}', '{"a"::1}', '{"a":1,}', "[,]", "[1,,2]", "[1 2]", "nul", "tru", "False",
                 "[" * 100000, '{"a":' * 100000, "[" * 17 + "]" * 17, "[1,]", '{"a":1 "b":2}', '{,"a":1}', "\ufeff", "\ufeff{}", "[\u2028", '{"name"'):
        case("json", f"text {text[:30]!r}", text, False)
        case("ahap", f"text {text[:30]!r}", text, False)
    for fields, is_read in ((', "x_m": 0.1', False), (', "label": "R", "label": "L"', False), (', "label": "R"', True), (", ", False), (",, ", False), (', "unknown": 1', False), (', "": 1', False), (' "label": "R"', False), (', "label": null', False)):
        case("json", f"fields {fields}", layout(fields=fields), is_read)
    for encoding in ("utf-16", "utf-16-le", "utf-16-be", "utf-32", "utf-32-be", "cp037"):
        case("json", f"in {encoding}", whole.encode(encoding), False)
        case("ahap", f"in {encoding}", pattern(event()).encode(encoding), False)
    case("json", "after a mark of UTF-8", b"\xef\xbb\xbf" + whole.encode(), True)
    for i, mark in enumerate((b"\xef\xbb", b"\xbb\xbf", b"\xef\xbb\xbf\xef\xbb\xbf")):
        case("json", f"half a mark {i}", mark + whole.encode(), False)


def haptics():
    """Kinds of .ahap: what Apple has, what others write, what is odd."""
    transient, continuous = '"EventType": "HapticTransient"', '"EventType": "HapticContinuous"'
    for kind in (transient, continuous):
        for time in ("", '"Time": 0, ', '"Time": 0.25, ', '"Time": 29, '):
            for duration in ("", '"EventDuration": 0.1, ', '"EventDuration": 1.5, '):
                for parameters in ("", ', "EventParameters": []', ', "EventParameters": [{"ParameterID": "HapticIntensity", "ParameterValue": 0.8}]', ', "EventParameters": [{"ParameterID": "HapticSharpness", "ParameterValue": 0.3},]',
                                   ', "EventParameters": [{"ParameterID": "HapticIntensity", "ParameterValue": 3}]', ', "EventParameters": [{"ParameterID": "AttackTime", "ParameterValue": 0.1}]'):
                    case("ahap", f"{kind} {time}{duration}{parameters}", pattern(event(time + duration + kind + parameters)), True)
    for bad in ("", '"EventType": "Haptic"', '"EventType": 1', '"EventType": "haptictransient"', f'{transient}, "Time": -1', f'{transient}, "Time": "0"', f'{continuous}, "EventDuration": -1', f"{transient}, {transient}",
                f'{transient}, "EventParameters": {{}}', f'{transient}, "EventParameters": [1]', f'{transient}, "EventParameters": [{{"ParameterID": "HapticIntensity", "ParameterValue": "1"}}]', f'{transient}, "Time": 1e9'):
        case("ahap", f"event {bad}", pattern(event(bad)), False)
    for other in ('"AudioContinuous"', '"AudioCustom"'):
        case("ahap", f"{other} beside a haptic one", pattern(event() + "," + event(f'"EventType": {other}')), True)
    point = '{"Time": 0, "ParameterValue": 1}, {"Time": 0.1, "ParameterValue": 0.2}'
    for name in ("HapticIntensityControl", "HapticSharpnessControl", "HapticAttackTimeControl"):
        for time in ("0", "0.05"):
            case("ahap", f"curve {name} {time}", pattern(event(f'{continuous}, "EventDuration": 0.5') + f', {{"ParameterCurve": {{"ParameterID": "{name}", "Time": {time}, "ParameterCurveControlPoints": [{point}]}}}}'), True)
            case("ahap", f"step {name} {time}", pattern(event(f'{continuous}, "EventDuration": 0.5') + f', {{"Parameter": {{"ParameterID": "{name}", "Time": {time}, "ParameterValue": 0.5}}}}'), True)
    for front in ("", '"Version": 1.0, ', '"Version": "1", ', '"Version": 2, ', '"Metadata": {}, ', '"Metadata": {"Project": "x", "Created": "y"}, ', '"x": [[{}]], '):
        case("ahap", f"front {front}", pattern(event(), front), True)
    for end in ("", ",", " ,", ",\n"):
        case("ahap", f"end {end!r}", pattern(event() + end), True)
    for end in (",,", ";", ",]"):
        case("ahap", f"end {end!r}", pattern(event() + end), False)
    for text in ('{"Version": 1}', '{"Pattern": {}}', '{"Pattern": 1}', pattern("1"), pattern("[]"), '{"Pattern": [], "Pattern": []}'):
        case("ahap", f"text {text}", text, False)


def outcome(program, folder, number):
    """Empty, or how the case ended otherwise than wanted."""
    ending, name, content, is_read = cases[number]
    path, out = folder / f"{number:04}.{ending}", folder / f"{number:04}.out.{'wav' if ending == 'json' else 'hjif'}"
    path.write_bytes(content)
    call = ["render", "drop", "--seconds", "0.01", "--layout", path, "--out", out] if ending == "json" else ["export", path, "--to", out]
    run = subprocess.run([program, *call], capture_output=True)
    told = run.stderr.decode("utf-8", "replace").splitlines()
    if is_read and run.returncode == 0 and out.exists():
        return ""
    if not is_read and run.returncode == 1 and len(told) == 1 and str(path) in told[0] and not out.exists():
        return ""
    return f"{ending} {name}: exit {run.returncode}, {told}: expected {'it to be read' if is_read else 'one line that refuses it'}"


def main():
    for make in (numbers, strings, shapes, haptics):
        make()
    for ending, name, content, is_read in cases:  # the judge: Python's parser, which is not stricter
        if is_read:
            json.loads(content.decode("utf-8-sig").replace(",]", "]").replace(",}", "}").replace(" ,]", "]").replace(",\n]", "]"), strict=True)
    with tempfile.TemporaryDirectory() as own, concurrent.futures.ThreadPoolExecutor(2) as pool:
        bad = [line for line in pool.map(lambda i: outcome(sys.argv[1], Path(own), i), range(len(cases))) if line]
    print("\n".join(bad))
    print(f"{len(cases)} texts: {len(cases) - len(bad)} as wanted, {sum(c[3] for c in cases)} of them to be read")
    return 1 if bad else 0


sys.exit(main())

# SPDX-License-Identifier: MIT
"""skipped.py on tests of every way to leave something out: skipped_test.py ROOT CTEST."""
import subprocess
import sys
import tempfile
from pathlib import Path

root, ctest = Path(sys.argv[1]), sys.argv[2]
WAYS = {"ran": "echo done", "said-nothing-of-it": "echo '12 blocks skipped, 0 skipped'", "code": "exit 77", "gtest": "echo '[  SKIPPED ] A.B (0 ms)'",
        "disabled-within": "echo '  YOU HAVE 1 DISABLED TEST'", "unittest": "echo 'OK (skipped=1)'", "script": "echo 'mixer: skipped, there is no display'",
        "node": "echo '# skipped 2'", "off": "echo done", "long": "seq 100000; echo 'skipped: late'", "odd": r"printf '\\033[1m\\001\\377\\n'"}
QUIET = {"ran", "said-nothing-of-it", "odd"}


def looked(kept: str, cache: str = "", quiet: bool = False, at_night: "tuple[str, ...]" = ()) -> "subprocess.CompletedProcess[str]":
    (folder / "kept.txt").write_text("# a comment\n" + kept)
    (folder / "CMakeCache.txt").write_text(cache)
    words = ["--quiet"] * quiet + [word for name in at_night for word in ("--at-night", name)] + ["--kept", folder / "kept.txt", folder, folder / "report.xml"]
    return subprocess.run([root / "Tests/House/skipped.py", *words], capture_output=True, text=True)


with tempfile.TemporaryDirectory() as name:
    folder = Path(name)
    lines = [f"add_test([=[{test}]=] sh -c [=[{script}]=])" for test, script in WAYS.items()]
    lines += ["set_tests_properties(code PROPERTIES SKIP_RETURN_CODE 77)", "set_tests_properties(off PROPERTIES DISABLED TRUE)"]
    (folder / "CTestTestfile.cmake").write_text("\n".join(lines) + "\n")
    subprocess.run([ctest, "--test-dir", folder, "--output-junit", folder / "report.xml", "--test-output-size-passed", "1000000"],
                   check=True, capture_output=True)
    bare = looked("")
    assert bare.returncode == 1 and bare.stdout == "", bare
    assert {line.split(":")[0] for line in bare.stderr.splitlines()} == set(WAYS) - QUIET, bare.stderr
    why = "".join(f"{test} | a reason | Tests/nightly.sh hours\n" for test in set(WAYS) - QUIET)
    good = looked(why)
    assert good.returncode == 0 and good.stderr == "" and len(good.stdout.splitlines()) == len(WAYS) - len(QUIET), good
    assert "not run here: off (disabled): a reason; Tests/nightly.sh hours does" in good.stdout, good.stdout
    assert looked(why, quiet=True).stdout == ""
    assert looked(why + "more | a reason | Tests/nightly.sh nothing\n").stderr == "more: Tests/nightly.sh nothing does not exist\n"
    assert looked(why + "more | a reason | Tests/none.sh\n").stderr == "more: Tests/none.sh does not exist\n"
    for line in ("PHYSVIB_LOVE:FILEPATH=PHYSVIB_LOVE-NOTFOUND\n", "UNICORN_FOUND:INTERNAL=\n"):
        assert looked(why, "PHYSVIB_ALL:BOOL=ON\nUNICORN_FOUND:INTERNAL=1\n" + line).stderr == "tests are left out: " + line
    # What is left to the night by its name may be absent, and is named; by itself it may not.
    absent, night = "PHYSVIB_ENGINE_LOVE:FILEPATH=PHYSVIB_ENGINE_LOVE-NOTFOUND\n", why + "PHYSVIB_ENGINE_* | a reason | Tests/nightly.sh hours\n"
    assert looked(night, absent).stderr == "tests are left out: " + absent
    left = looked(night, absent, at_night=("PHYSVIB_ENGINE_*",))
    assert left.returncode == 0 and "not run here: PHYSVIB_ENGINE_*: a reason; Tests/nightly.sh hours does\n" in left.stdout, left
    assert looked(night, absent.replace("ENGINE_", ""), at_night=("PHYSVIB_ENGINE_*",)).returncode == 1
    two = absent + "PHYSVIB_PICO_SDK:PATH=PHYSVIB_PICO_SDK-NOTFOUND\n"
    night += "PHYSVIB_PICO_SDK | a reason | Tests/nightly.sh pico\n"
    assert looked(night, two, at_night=("PHYSVIB_ENGINE_*",)).stderr == "tests are left out: PHYSVIB_PICO_SDK:PATH=PHYSVIB_PICO_SDK-NOTFOUND\n"
    assert looked(night, two, at_night=("", "PHYSVIB_ENGINE_*", "PHYSVIB_PICO_SDK")).returncode == 0
    assert looked(why, at_night=("PHYSVIB_ENGINE_*",)).stderr == "PHYSVIB_ENGINE_*: Tests/House/skips.txt has no reason for it\n"
    print(f"{len(WAYS) - len(QUIET)} ways to leave a test out are seen")

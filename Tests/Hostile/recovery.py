# SPDX-License-Identifier: GPL-3.0-or-later
"""The crashes of recovery.sh: recovery.py MIXER CRASHES SEED. A session is known by the name of its scene,
which whatever goes on from it has as well."""
import glob
import json
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

mixer, crashes, seed = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
random.seed(seed)
configuration = tempfile.mkdtemp(prefix="physvib-recovery-")
metadata = f"/dev/shm/jack_db-{os.getuid()}"  # JACK's; a program that is killed while it opens it leaves it locked
has_metadata = os.path.exists(metadata)
folder = os.path.join(configuration, "physvib")
quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}


def start(full_after=None):
    def fill():
        if full_after is not None:
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (full_after, full_after))

    words = [mixer, "--device", "None:no device"]
    return subprocess.Popen(words, env={**os.environ, "XDG_CONFIG_HOME": configuration}, preexec_fn=fill, **quiet)


def hand(*words):
    subprocess.run(["xdotool", *words], check=False, timeout=20, **quiet)


def press(key):
    hand("mousemove", "720", "20", "key", key)


def draw():
    hand("mousemove", "720", "300", "key", "b", "click", "1")  # a ball: something to keep a copy of


def window(seconds):
    end = time.time() + seconds
    while time.time() < end:
        found = subprocess.run(["xdotool", "search", "--name", "PhysVib mixer"], check=False, **quiet)
        if found.returncode == 0:
            return True
        time.sleep(0.1)
    return False


def whole():
    """Names of copies that are whole, by file."""
    names = {}
    for path in glob.glob(os.path.join(folder, "recovery-*.json")):
        try:
            if os.path.isfile(path):
                names[path] = json.load(open(path))["takes"][-1]["scene"]["name"]
        except ValueError:
            pass
    return names


def put(name, path, cut=False):
    session = json.loads(template)
    for take in session["takes"]:
        take["scene"]["name"] = name
    text = json.dumps(session)
    with open(path, "w") as file:
        file.write(text[: random.randrange(len(text))] if cut else text)


def first_copy():
    run = start()
    try:
        assert window(60), "the mixer does not start"
        time.sleep(1)
        for _ in range(30):
            draw()
            time.sleep(3)
            if whole():
                return open(next(iter(whole()))).read()
        raise AssertionError("the mixer keeps no copy")
    finally:
        run.kill()
        run.wait()


template = first_copy()
for each in glob.glob(os.path.join(folder, "recovery-*")):
    os.remove(each)
known, lost, full, cut = set(), [], 0, 0
for crash in range(crashes):
    place = os.path.join(folder, f"recovery-{90_000_000 + 10 * crash}")
    for k in range(random.choice((0, 1, 1, 2))):
        put(f"s{crash}-{k}", f"{place}{k}.json")
    if random.random() < 0.25:
        time.sleep(0.02)
        put("cut", f"{place}9.json", cut=True)
        cut += 1
    before = set(whole().values()) | known
    limit = random.choice((None, None, random.randrange(30_000)))
    full += limit is not None
    runs = [start(limit) for _ in range(random.choice((1, 1, 1, 2)))]
    if window(30):
        end = time.time() + random.uniform(0, 5)
        time.sleep(random.uniform(0, 1))
        while time.time() < end:
            act = random.choice(("Return", "Return", "Right", None))
            press(act) if act else draw()
            time.sleep(random.uniform(0, 1.5))
    for run in runs:
        run.kill()
        run.wait()
    held = whole()
    gone = sorted(before - set(held.values()))
    if gone:
        lost += gone
        print(f"crash {crash}: lost {' '.join(gone)}", flush=True)
    for n, (path, name) in enumerate(sorted(held.items())):
        if name == "shake-the-box":  # a session of its own: another one by name from now on
            times = os.stat(path)
            put(f"s{crash}-own{n}", path)
            os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))
    known = set(whole().values())
shutil.rmtree(configuration)
if not has_metadata:
    shutil.rmtree(metadata, ignore_errors=True)
print(f"{crashes} crashes, {full} on a full disk, {cut} copies cut short:",
      f"{len(lost)} sessions lost, {len(known)} on the disk at the end")
sys.exit(1 if lost else 0)

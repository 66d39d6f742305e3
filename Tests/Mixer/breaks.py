#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Breaks the mixer's code in 60 ways, one after the other, and says which of them its tests catch. usage: breaks.py --check | BUILD [NUMBER...]
--check: only whether each break still has its place in the code, in a second. BUILD: a folder for a copy of the sources and a build of its own, so that
one may go on editing. All breaks are compiled once, and PHYSVIB_BREAK says which one the program has; a break then costs 25 s of tests in parts. A test
that fails is run once more by itself: only if it fails again the break counts as caught. Exit code 1 if a place is missing, or fewer than 55 of 60 are
caught."""
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
DESK, WINDOW, WORLD, STRIPS, OUTPUT = "Desk", "Window", "World", "Strips", "Output"
BREAKS = [  # file, what stands there, what is put there instead
    (f"{DESK}/Desk.cpp", "isRefused = isSame(mix_, before);", "isRefused = false;"),
    (f"{DESK}/Desk.cpp", "if (isRefused) --edits_;", ""),
    (f"{DESK}/Desk.cpp", "takeOutputs(output().channelMap(), mix_.strips);", ""),
    (f"{DESK}/Desk.cpp", "quietenNew(mix_.strips, settled.strips);", ""),
    (f"{DESK}/Desk.cpp", "setSilent(start.isSilent);", "setSilent(false);"),
    (f"{DESK}/Desk.cpp", "if (mix_.count() < 2) return;", ""),
    (f"{DESK}/Desk.cpp", "mix.strips.erase(mix.strips.begin() + enchanter);", "mix.strips.pop_back();"),
    (f"{DESK}/Desk.cpp", "saved_.lengthNs = session().status().sessionNs;", ""),
    (f"{DESK}/Desk.cpp", "isSilent_ = output().isSilent();\n    sendChangeMessage();", "sendChangeMessage();"),
    (f"{DESK}/DeskMessages.cpp", "waiting_.push_front(shown_);", ""),
    (f"{DESK}/DeskMessages.cpp", "if (isOf(shown_, label)) show({});", ""),
    (f"{DESK}/DeskMessages.cpp", "*same = std::move(message);", "waiting_.push_back(std::move(message));"),
    (f"{DESK}/DeskRouting.cpp", "output != choice.marker", "true"),
    (f"{DESK}/DeskRouting.cpp", "if (isFree(output)) mix.strips[j].output = output;", ""),
    (f"{DESK}/DeskCompare.cpp", "next.levelDb = std::max(leastStripDb, next.levelDb - loweredDb_);", ""),
    (f"{DESK}/DeskCompare.cpp", "isB_ = !isB_;", ""),
    (f"{DESK}/DeskCompare.cpp", "mix.seed = now.seed;", ""),
    (f"{DESK}/DeskCompare.cpp", "mix.levelDb == setDb_", "true"),
    (f"{DESK}/DeskCompare.cpp", "desk_.undoManager().getRedoDescription() != compareStep", "true"),
    (f"{DESK}/DeskWorld.cpp", "if (!isDone && !isRepeated_) run(false);", ""),
    (f"{DESK}/DeskLook.cpp", "recording_.take(played);", ""),
    (f"{DESK}/DeskLook.cpp", "recent_.add(played.event);", ""),
    (f"{DESK}/DeskStrikes.cpp", "pulse.amplitude = strikeAmplitude;", "pulse.amplitude = 0.0;"),
    (f"{DESK}/DeskLanes.cpp", "lane = thinned(sumOf(lane, moved));", "lane = thinned(moved);"),
    (f"{DESK}/DeskLanes.cpp", "highest - mostStripDb", "highest"),
    (f"{DESK}/UserFolder.cpp", "isTaken || folder.value.getChildFile(numbered + ending).exists()", "folder.value.getChildFile(numbered + ending).exists()"),
    (f"{STRIPS}/LaneRow.cpp", "std::clamp(point.seconds, from, std::max(from, to))", "point.seconds"),
    (f"{STRIPS}/LaneRow.cpp", "lane().size() >= mostGainPoints", "false"),
    (f"{STRIPS}/LaneRow.cpp", "move(pointAt(e.position), std::exchange(isMoved_, true));", "move(pointAt(e.position), false);"),
    (f"{STRIPS}/GroupView.cpp", "removeGroup(mix, static_cast<int>(index_));", "mix.groups.pop_back();"),
    (f"{WINDOW}/Arrangement.cpp", "std::min(fair, width * 70 / 100)", "fair"),
    (f"{WINDOW}/FileCard.cpp", "file.existsAsFile() && file != replaced_", "false"),
    (f"{WINDOW}/FileCard.cpp", "replaced_ = juce::File{};", ""),
    (f"{WINDOW}/FileCard.cpp", 'if (key == juce::KeyPress::escapeKey) return onCancel(), true;', ""),
    (f"{WINDOW}/QuestionCard.cpp", "if (!answers_[which].isEnabled) return;", ""),
    (f"{WINDOW}/QuestionCard.cpp", "if (key == answers_[k].key) return act(k), true;", ""),
    (f"{WINDOW}/FirstStart.cpp", "mix.levelDb = std::min(firstDb, mix.levelDb);", "mix.levelDb = firstDb;"),
    (f"{WINDOW}/FirstStart.cpp", "outputs < 1", "false"),
    (f"{WINDOW}/FirstStart.cpp", "areNamed ? beforePads + meant : std::ssize(many)", "std::ssize(many)"),
    (f"{WINDOW}/FirstStart.cpp", "meant += kind->isMeant ? 1 : 0;", ""),
    (f"{WINDOW}/MixerView.cpp", "bar_.setAlwaysOnTop(isShow);", ""),
    (f"{WINDOW}/MixerView.cpp", "if (key == KeyPress::escapeKey) return desk_.setSilent(true), true;", "if (key == KeyPress::escapeKey) return desk_.setSilent(!desk_.isSilent()), true;"),
    (f"{WINDOW}/MixerView.cpp", "if (key == KeyPress{'a', juce::ModifierKeys::noModifiers, 0}) return world_.compare().toggle(), true;", ""),
    (f"{WINDOW}/TopBar.cpp", "redo_.setEnabled(history.canRedo());", "redo_.setEnabled(false);"),
    (f"{WINDOW}/TopBar.cpp", "board_.setBounds(area.removeFromRight(108));", "board_.setBounds(area.removeFromRight(0));"),
    (f"{WINDOW}/TopBar.cpp", "silence_.onClick = [this] { desk_.setSilent(!desk_.isSilent()); };", "silence_.onClick = [this] { desk_.setSilent(true); };"),
    (f"{WINDOW}/PageLink.cpp", 'if (mix.seed != 1) link += "&seed=" + std::to_string(mix.seed);', ""),
    (f"{WINDOW}/PageLink.cpp", '"-_"', '"+/"'),
    (f"{WORLD}/WorldPanel.cpp", "if (!isShow_ && pane_.takeKey(key)) return true;", "if (pane_.takeKey(key)) return true;"),
    (f"{WORLD}/WorldPanel.cpp", "if (isShow_) area.removeFromRight(silenceWidth);", ""),
    (f"{WORLD}/WorldPanel.cpp", "pane_.letItRain();", ""),
    (f"{WORLD}/WorldMenu.cpp", "target.enchanter >= 0", "false"),
    (f"{WORLD}/DrawRain.cpp", "rainWay_.isFountain", "false"),
    (f"{WORLD}/DrawStrokes.cpp", "bodies[k].name = names[k];", 'bodies[k].name = names[0] + "." + std::to_string(k);'),
    (f"{WORLD}/DrawStrokes.cpp", "hintOnBody(desk_, first);", ""),
    (f"{WORLD}/FeltHint.cpp", "if (why.empty()) return desk.messages().withdraw(feltLabel);", "if (why.empty()) return;"),
    (f"{WORLD}/MaterialPalette.cpp", "hintOnMaterial(desk_, i);", ""),
    (f"{WORLD}/DrawPane.cpp", "if (tool != DrawTool::choose) chosen_.clear();", ""),
    (f"{STRIPS}/StripsPanel.cpp", "attach_.setVisible(desk_.mix().count() < limits::maxEnchanters);", ""),
    (f"{OUTPUT}/TakesTab.cpp", "if (eventsOf(file).existsAsFile()) remove(eventsOf(file));", ""),
]


BROKEN = """#pragma once
#include <cstdlib>
inline bool isBroken(int number) {
    static const char* const chosen = std::getenv("PHYSVIB_BREAK");
    return chosen != nullptr && std::atoi(chosen) == number;
}
"""
PARTS = 8


def prepare(folder: pathlib.Path) -> None:
    tree = folder / "sources"
    shutil.rmtree(tree, ignore_errors=True)
    shutil.copytree(ROOT, tree, symlinks=True, ignore=lambda at, names: [name for name in names if name == ".git" or (at == str(ROOT / "build") and name != "juce")])
    for unpacked in (tree / "build").glob("juce/usr/lib/**/*.cmake"):  # names its own folder; so each compiler's call is that of ROOT, which ccache knows
        unpacked.write_text(unpacked.read_text().replace(str(ROOT), str(tree)))
    (tree / "Standalone/Mixer/Broken.h").write_text(BROKEN)
    for number, (file, old, new) in enumerate(BREAKS, 1):
        path = tree / "Standalone/Mixer" / file
        text = path.read_text()
        if "Broken.h" not in text:
            text = text.replace("#include", '#include "Mixer/Broken.h"\n#include', 1)
        isStatement = old.endswith(";")
        path.write_text(text.replace(old, f"{{ if (isBroken({number})) {{ {new} }} else {{ {old} }} }}" if isStatement else f"(isBroken({number}) ? ({new}) : ({old}))"))
    subprocess.run(["cmake", "--preset", "release"], check=True, cwd=tree, stdout=subprocess.DEVNULL)


def build(folder: pathlib.Path) -> bool:
    return subprocess.run(["cmake", "--build", folder / "sources/build/release", "--target", "physvib-mixer-tests"], capture_output=True).returncode == 0


def failing(folder: pathlib.Path, number: int = 0) -> str:
    """The name of the test that fails with that break, or nothing."""
    environment = {**os.environ, "PHYSVIB_BREAK": str(number)}
    program = folder / "sources/build/release/bin/physvib-mixer-tests"
    parts = [
        subprocess.Popen([program, "--gtest_brief=1", "--gtest_fail_fast"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, errors="replace",
                         env={**environment, "GTEST_TOTAL_SHARDS": str(PARTS), "GTEST_SHARD_INDEX": str(part)})
        for part in range(PARTS)
    ]
    found = ""
    for part in parts:
        try:
            text = part.communicate(timeout=300)[0]
        except subprocess.TimeoutExpired:
            text = "hangs"
            part.kill()
        if part.returncode and not found:
            name = re.search(r"\[  FAILED  \] ([\w./]+)", text)
            try:
                again = subprocess.run([program, f"--gtest_filter={name[1] if name else '*'}"], capture_output=True, timeout=300, env=environment).returncode
            except subprocess.TimeoutExpired:
                again = 1
            if again:
                found = name[1] if name else "crash or hang"
                for other in parts:
                    other.kill()
    return found


def main() -> None:
    missing = [f"{file}: {old}" for file, old, _ in BREAKS if (ROOT / "Standalone/Mixer" / file).read_text().count(old) != 1]
    if missing or len(BREAKS) != 60:
        sys.exit("\n".join(missing) + f"\n{len(missing)} of {len(BREAKS)} breaks have no place of their own in the code")
    if sys.argv[1] == "--check":
        return print(f"{len(BREAKS)} breaks have their places")
    folder = pathlib.Path(sys.argv[1]).resolve()
    chosen = [int(number) for number in sys.argv[2:]] or list(range(1, len(BREAKS) + 1))
    prepare(folder)
    if not build(folder):
        sys.exit("the code with its breaks does not build")
    if by := failing(folder):
        sys.exit(f"the code as it is does not pass: {by}")
    caught = 0
    for number in chosen:
        file, old, _ = BREAKS[number - 1]
        by = failing(folder, number)
        caught += by != ""
        print(f"{number:2} {'caught' if by else 'NOT CAUGHT':10} {file}: {old} {by}", flush=True)
    print(f"{caught} of {len(chosen)} caught")
    sys.exit(caught < len(chosen) * 55 / 60)


main()

#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Breaks the mixer's code in 60 ways, one after the other, and says which of them its tests catch. usage: breaks.py --check | BUILD [NUMBER...]
--check: only whether each break still has its place in the code, in a second. BUILD: a folder for a copy of the sources and a build of its own, so that
one may go on editing. All breaks are compiled once, and PHYSVIB_BREAK says which one the program has. Each is met by the test that caught it before;
only if that one passes by all others, in parts: 4 minutes. A break is caught by a test that fails by itself with it and passes without. Exit
code 1 if a place is missing, or fewer than 55 of 60 are caught."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
BREAKS = [  # file, what stands there, what is put there instead, the test that is tried first
    ("Model/MixerModel.cpp", "isRefused = isSame(mix_, before);", "isRefused = false;", "MixerRouting.ARefusedOutputIsNeitherShownNorSaved"),
    ("Model/MixerModel.cpp", "if (isRefused) --edits_;", "", "MixerRouting.ARefusedOutputIsNeitherShownNorSaved"),
    ("Model/MixerModel.cpp", "showPlayedOutputs(output().channelMap(), mix_.strips);", "", "MixerRouting.ARefusedOutputIsNeitherShownNorSaved"),
    ("Model/MixerModel.cpp", "quietenNew(mix_.strips, settled.strips);", "", "MixerRouting.NewActuatorsAreNoLouderThanTheQuietest"),
    ("Model/MixerModel.cpp", "setSilent(start.isSilent);", "setSilent(false);", "MixerModel.StartsSilentIfItIsAsked"),
    ("Model/MixerModel.cpp", "if (mix_.count() < 2) return;", "", "MixerModel.TheLastEnchanterStays"),
    ("Model/MixerModel.cpp", "mix.strips.erase(mix.strips.begin() + enchanter);", "mix.strips.pop_back();", "MixerModel.AFifthEnchanterIsAttachedWhileItPlaysStartsQuietlyAndCanBeTakenBack"),
    ("Model/MixerModel.cpp", "saved_.lengthNs = session().status().sessionNs;", "", "MixerModel.ASavedSessionIsAsLongAsItWasPlayed"),
    ("Model/MixerModel.cpp", "isSilent_ = output().isSilent();\n    sendChangeMessage();", "sendChangeMessage();", "MixerOsc.SilenceNeitherWaitsForTheWindowNorNeedsRoom"),
    ("Model/MixerMessages.cpp", "waiting_.push_front(shown_);", "", "MixerView.MessagesWaitForEachOtherAndNoneIsGluedToAnother"),
    ("Model/MixerMessages.cpp", "if (isOf(shown_, label)) show({});", "", "MixerView.AMessageIsFoundByItsLabel"),
    ("Model/MixerMessages.cpp", "*same = std::move(message);", "waiting_.push_back(std::move(message));", "MixerView.AMessageIsFoundByItsLabel"),
    ("Model/MixerDevice.cpp", "model.device().choice().inUse()", "std::vector<int>{}", "MixerRouting.FreeOutputsAreNeitherTheMonitorsNorTheMarkers"),
    ("Model/MixerDevice.cpp", "if (isWithout(mix, j)) mix.strips[j].output = freeOutput(mix.strips, inUse, outputs);", "", "MixerRouting.ASessionWithAConflictPlaysWhatItCanAndHealsByOneClick"),
    ("Model/MixerWorld.cpp", "next.levelDb = std::max(leastStripDb, next.levelDb - loweredDb_);", "", "MixerCompare.OneKeyChangesBetweenTwoMixesAtMatchedLevels"),
    ("Model/MixerWorld.cpp", "isB_ = !isB_;", "", "MixerCompare.OneKeyChangesBetweenTwoMixesAtMatchedLevels"),
    ("Model/MixerWorld.cpp", "mix.seed = now.seed;", "", "MixerCompare.TheWorldStaysAndUndoEndsTheComparison"),
    ("Model/MixerWorld.cpp", "mix.levelDb == setDb_", "true", "MixerCompare.ALevelThatIsSetMeanwhileIsMeant"),
    ("Model/MixerWorld.cpp", "model_.undoManager().getRedoDescription() != compareStep", "true", "MixerCompare.TheWorldStaysAndUndoEndsTheComparison"),
    ("Model/MixerWorld.cpp", "if (!isDone && !isRepeated_) run(false);", "", ""),  # refused in the middle only with 100,000 inputs, and then the way back is refused too
    ("Model/MixerModel.cpp", "recording_.add(played);", "", "MixerModel.ARecordingHasAChannelPerEnchanterAndTheEventsOfIt"),
    ("Model/MixerModel.cpp", "recent_.add(played.event);", "", "Scope.PlayedEventsAreListedTheNewestFirst"),
    ("Model/MixerInputs.cpp", "pulse.amplitude = strikeAmplitude;", "pulse.amplitude = 0.0;", "MixerRouting.AnOutputThatAnotherHasIsExchanged"),
    ("Model/MixerRecording.cpp", "lane = thinned(sumOf(lane, moved));", "lane = thinned(moved);", "RecordedLanes.AreAddedToTheLaneThatPlays"),
    ("Model/MixerRecording.cpp", "highest - mostStripDb", "highest", "RecordedLanes.AreFeltAsTheFadersThatWereMoved"),
    ("Model/MixerRecording.cpp", "isTaken || folder.value.getChildFile(numbered + ending).exists()", "folder.value.getChildFile(numbered + ending).exists()", "UserFolder.NothingIsOverwritten"),
    ("Strips/LanesTab.cpp", "std::clamp(point.seconds, from, std::max(from, to))", "point.seconds", "LanesByHand.APointStaysBetweenItsNeighbours"),
    ("Strips/LanesTab.cpp", "lane().size() >= mostGainPoints", "false", "LanesByHand.HaveAsManyPointsAsAFileMayHold"),
    ("Strips/LanesTab.cpp", "move(pointAt(e.position), std::exchange(isMoved_, true));", "move(pointAt(e.position), false);", "LanesByHand.ANewPointIsDraggedFromWhereItWasAddedAndUndoneWithIt"),
    ("Strips/StripsPanel.cpp", "removeGroup(mix, static_cast<int>(index_));", "mix.groups.pop_back();", "Groups.AreMadeRenamedMutedAndTakenApartInTheWindow"),
    ("Window/MixerView.cpp", "std::min(fair, width * 70 / 100)", "fair", "Arrangement.ManyStripsLeaveTheScopeItsPart"),
    ("Widgets/Cards.cpp", "file.existsAsFile() && file != replaced_", "false", "FileCard.AFileIsReplacedAtTheSecondPressOnly"),
    ("Widgets/Cards.cpp", "replaced_ = juce::File{};", "", "FileCard.AFileIsReplacedAtTheSecondPressOnly"),
    ("Widgets/Cards.cpp", "if (key == juce::KeyPress::escapeKey) return onCancel(), true;", "", "FileCard.ListsFoldersAndFilesOfTheEndingAndOpensOnlyWhatIsThere"),
    ("Widgets/Cards.cpp", "if (!answers_[which].isEnabled) return;", "", "MixerView.ReturnIsTheFirstAnswerAndTheOthersAreButtonsAndKeys"),
    ("Widgets/Cards.cpp", "if (key == answers_[k].key) return act(k), true;", "", "MixerView.ReturnIsTheFirstAnswerAndTheOthersAreButtonsAndKeys"),
    ("Window/FirstStart.cpp", "mix.levelDb = std::min(firstDb, mix.levelDb);", "mix.levelDb = firstDb;", "FirstStart.TestsFromTheLevelOfBeforeIfThatIsLower"),
    ("Window/FirstStart.cpp", "outputs < 1", "false", "FirstStart.ADeviceWithoutOutputsIsNoChoiceAndNoDeviceSaysWhatThatMeans"),
    ("Window/FirstStart.cpp", "areNamed ? beforePads + meant : std::ssize(many)", "std::ssize(many)", "FirstStart.HeadphonesByNameComeBeforeAControllerAndOtherSpeakersBehindIt"),
    ("Window/FirstStart.cpp", "meant += kind->isMeant ? 1 : 0;", "", "FirstStart.HeadphonesByNameComeBehindABoard"),
    ("Window/MixerView.cpp", "bar_.setAlwaysOnTop(isShow);", "", "MixerView.NothingCoversTheButtonThatSilencesInAShow"),
    ("Window/MixerView.cpp", "if (key == KeyPress::escapeKey) return model_.setSilent(true), true;", "if (key == KeyPress::escapeKey) return model_.setSilent(!model_.isSilent()), true;", "MixerView.ButtonsDoWhatTheySay"),
    ("Window/MixerView.cpp", "if (key == KeyPress{'a', juce::ModifierKeys::noModifiers, 0}) return world_.compare().toggle(), true;", "", "MixerCompare.OneKeyChangesBetweenTwoMixesAtMatchedLevels"),
    ("Window/TopBar.cpp", "redo_.setEnabled(history.canRedo());", "redo_.setEnabled(false);", "MixerView.ButtonsDoWhatTheySay"),
    ("Window/TopBar.cpp", "board_.setBounds(area.removeFromRight(108));", "board_.setBounds(area.removeFromRight(0));", "MixerView.TheStatesOfDeviceAndBoardAreShownAtEverySize"),
    ("Window/TopBar.cpp", "silence_.onClick = [this] { model_.setSilent(!model_.isSilent()); };", "silence_.onClick = [this] { model_.setSilent(true); };", "MixerView.ButtonsDoWhatTheySay"),
    ("Window/PageLink.cpp", 'if (mix.seed != 1) link += "&seed=" + std::to_string(mix.seed);', "", "PageLink.ABuiltInSceneIsItsNameAndOnlyWhatDiffersIsSaid"),
    ("Window/PageLink.cpp", '"-_"', '"+/"', "PageLink.ASceneOfOnesOwnGoesAlongWhole"),
    ("World/WorldPanel.cpp", "if (!isShow_ && pane_.handleKey(key)) return true;", "if (pane_.handleKey(key)) return true;", "MixerView.NoToolIsChosenWhereNoneIsShown"),
    ("World/WorldPanel.cpp", "if (isShow_) area.removeFromRight(silenceWidth);", "", "MixerView.NothingCoversTheButtonThatSilencesInAShow"),
    ("World/WorldPanel.cpp", "pane_.spawnDueBodies();", "", "Drawing.ARainComesBallByBallWhileTheWorldRunsAndIsOneStepOfUndo"),
    ("World/WorldPanel.cpp", "target.enchanter >= 0", "false", "WorldMenu.EachThingHasItsOwn"),
    ("World/DrawPane.cpp", "rainPattern_.isFountain", "false", "Drawing.ARainComesBallByBallWhileTheWorldRunsAndIsOneStepOfUndo"),
    ("World/DrawPane.cpp", "bodies[k].name = names[k];", 'bodies[k].name = names[0] + "." + std::to_string(k);', "Drawing.TheBodiesOfARainHaveNumberedNamesWhateverIsLeftOfAnother"),
    ("World/DrawPane.cpp", "hintOnBody(model_, first);", "", "FeltHint.ABodyThatGivesNothingIsMadeAHapticSourceThatVibrates"),
    ("Model/MixerMessages.cpp", "if (why.empty()) return model.messages().withdraw(feltLabel);", "if (why.empty()) return;", "FeltHint.GoesWhenAFeltMaterialIsChosen"),
    ("World/DrawBar.cpp", "hintOnMaterial(model_, i);", "", "FeltHint.AMaterialThatGivesNothingSaysSoAndIsMadeFelt"),
    ("World/DrawPane.cpp", "if (tool != DrawTool::choose) chosen_.clear();", "", "Drawing.WhoTakesAnotherToolChoosesNothing"),
    ("Strips/StripsPanel.cpp", "attach_.setVisible(model_.mix().count() < limits::maxEnchanters);", "", "Arrangement.StripsWidenWithTheirPanelAndScrollWhenTheyAreMany"),
    ("Output/TakesTab.cpp", "if (eventsOf(file).existsAsFile()) remove(eventsOf(file));", "", "TakesTab.ATakeIsCopiedAndDeletedWithItsEvents"),
]


BROKEN = """#pragma once
#include <cstdlib>
inline bool isBroken(int number) {
    static const char* const chosen = std::getenv("PHYSVIB_BREAK");
    return chosen != nullptr && std::atoi(chosen) == number;
}
"""
PARTS, SECONDS = 8, 300


def prepare(folder: pathlib.Path) -> None:
    tree = folder / "sources"
    shutil.rmtree(tree, ignore_errors=True)
    shutil.copytree(ROOT, tree, symlinks=True, ignore=lambda at, names: [name for name in names if name == ".git" or (at == str(ROOT / "build") and name != "juce")])
    for unpacked in (tree / "build").glob("juce/usr/lib/**/*.cmake"):  # names its own folder; so each compiler's call is that of ROOT, which ccache knows
        unpacked.write_text(unpacked.read_text().replace(str(ROOT), str(tree)))
    (tree / "Standalone/Mixer/Broken.h").write_text(BROKEN)
    for number, (file, old, new, _) in enumerate(BREAKS, 1):
        path = tree / "Standalone/Mixer" / file
        text = path.read_text()
        if "Broken.h" not in text:
            text = text.replace("#include", '#include "Mixer/Broken.h"\n#include', 1)
        isStatement = old.endswith(";")
        path.write_text(text.replace(old, f"{{ if (isBroken({number})) {{ {new} }} else {{ {old} }} }}" if isStatement else f"(isBroken({number}) ? ({new}) : ({old}))"))
    subprocess.run(["cmake", "--preset", "release"], check=True, cwd=tree, stdout=subprocess.DEVNULL)


def build(folder: pathlib.Path) -> bool:
    return subprocess.run(["cmake", "--build", folder / "sources/build/release", "--target", "physvib-mixer-tests"], capture_output=True).returncode == 0


def suspects(output: str) -> list[str]:
    """The tests that failed, or else the one that was running."""
    failed = re.findall(r"\[  FAILED  \] ([\w./]+)", output)
    return sorted(set(failed)) or re.findall(r"\[ RUN      \] ([\w./]+)", output)[-1:]


def fails(program: pathlib.Path, test: str, number: int) -> bool:
    environment = {**os.environ, "PHYSVIB_BREAK": str(number)}
    try:
        return subprocess.run([program, f"--gtest_filter={test}"], capture_output=True, timeout=SECONDS, env=environment).returncode != 0
    except subprocess.TimeoutExpired:
        return True


def failing(folder: pathlib.Path, number: int = 0, first: str = "") -> str:
    """The name of a test that fails with that break, and only with it, or nothing. `first` is tried before the others."""
    program = folder / "sources/build/release/bin/physvib-mixer-tests"

    def is_caught_by(test: str) -> bool:
        return fails(program, test, number) and not (number and fails(program, test, 0))

    if first and is_caught_by(first):
        return first
    with tempfile.TemporaryDirectory() as outputs:
        parts = {}
        for part in range(PARTS):
            environment = {**os.environ, "PHYSVIB_BREAK": str(number), "GTEST_TOTAL_SHARDS": str(PARTS), "GTEST_SHARD_INDEX": str(part)}
            output = pathlib.Path(outputs, str(part))
            with output.open("w") as out:
                parts[output] = subprocess.Popen([program], stdout=out, stderr=subprocess.DEVNULL, env=environment)
        end, found = time.monotonic() + SECONDS, ""
        while parts and not found:
            time.sleep(0.2)
            for output, part in list(parts.items()):
                if part.poll() is None and time.monotonic() < end:
                    continue
                part.kill()
                part.wait()
                del parts[output]
                if part.returncode and not found:
                    found = next(filter(is_caught_by, suspects(output.read_text(errors="replace"))), "")
        for part in parts.values():
            part.kill()
            part.wait()
    return found


def main() -> None:
    missing = [f"{file}: {old}" for file, old, *_ in BREAKS if (ROOT / "Standalone/Mixer" / file).read_text().count(old) != 1]
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
        file, old, _, first = BREAKS[number - 1]
        by = failing(folder, number, first)
        caught += by != ""
        print(f"{number:2} {'caught' if by else 'NOT CAUGHT':10} {file}: {old} {by}", flush=True)
    print(f"{caught} of {len(chosen)} caught")
    sys.exit(caught < len(chosen) * 55 / 60)


main()

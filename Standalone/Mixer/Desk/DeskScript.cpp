// SPDX-License-Identifier: GPL-3.0-or-later
// Converts the log of a scene run to the script of a scene.
#include "Mixer/Desk/DeskScript.h"
#include "Io/Text/ReadableNumber.h"
#include "Mixer/Desk/Desk.h"
#include "Mixer/Desk/DeskWords.h"
#include "Scene/SceneValidation.h"
#include <algorithm>

namespace physvib {
namespace {

const juce::String editName{"Record a script"};

} // namespace

void DeskScript::start() {
    if (isRecording_) return;
    auto scene = std::make_shared<const Scene>(sceneToRecord(desk_.world().drawing().drawn()));
    takesBefore_ = desk_.saved().log.takes.size();
    desk_.change(editName, [&scene](Mix& mix) { mix.scene = scene; });
    recordedIn_ = desk_.mix().scene;
    worldEdits_ = desk_.world().edits();
    seconds_ = 0.0;
    inputs_ = 0;
    isRecording_ = true;
    if (desk_.session().world().slowness() == 0) desk_.setSlowness(1);
}

void DeskScript::look() {
    if (!isRecording_) return;
    if (desk_.mix().scene != recordedIn_) { // another scene was chosen
        isRecording_ = false;
        return desk_.report("The recording of hands has ended: another scene was chosen. No script was kept");
    }
    const auto& takes = desk_.saved().log.takes;
    if (takes.size() <= takesBefore_) return; // the world has not restarted yet
    const SceneRun& take = takes[takesBefore_];
    seconds_ = 1e-9 * static_cast<double>(take.worldEndNs);
    inputs_ = take.inputs.size();
    const bool isFull =
        seconds_ >= maxRecordedSeconds(*recordedIn_) || inputs_ >= maxRecordedInputs(*recordedIn_);
    const bool isOver = takes.size() > takesBefore_ + 1 || desk_.world().edits() != worldEdits_;
    if (isFull || isOver) stop();
    if (isFull)
        desk_.tell("The script is full: the recording of hands ended after " +
                   utf8(readable::number(hands_.lengthSeconds, 1)) + " s");
}

void DeskScript::stop() {
    if (!isRecording_) return;
    isRecording_ = false;
    applied_.clear();
    const auto& takes = desk_.saved().log.takes;
    if (takes.size() > takesBefore_)
        hands_ = recordedHands(takes[takesBefore_]);
    else
        hands_ = {};
    if (hands_.inputs.empty()) return desk_.tell("Nothing was recorded: no hand did anything");
    apply({0.0, hands_.lengthSeconds, false}, true);
}

// Keeps bodies that were drawn meanwhile.
void DeskScript::apply(const ScriptTrim& trim, bool goesOn) {
    Scene scene = desk_.world().drawing().drawn();
    scene.script = recordedIn_->script;
    scene.scriptPeriodSeconds = recordedIn_->scriptPeriodSeconds;
    scene = withHands(std::move(scene), hands_, trim);
    if (const auto fault = validate(scene); !fault.empty()) return desk_.report("The script: " + utf8(fault));
    auto next = std::make_shared<const Scene>(std::move(scene));
    std::erase_if(applied_, [](const auto& one) { return one.first.expired(); });
    applied_.emplace_back(next, trim);
    desk_.change(
        editName, [&next](Mix& mix) { mix.scene = next; }, goesOn);
}

const HandScript* DeskScript::hands() const {
    const bool isOurs = !isRecording_ && std::ranges::any_of(applied_, [this](const auto& one) {
        return one.first.lock() == desk_.mix().scene;
    });
    return isOurs ? &hands_ : nullptr;
}

ScriptTrim DeskScript::trim() const {
    const auto now = std::ranges::find_if(
        applied_, [this](const auto& one) { return one.first.lock() == desk_.mix().scene; });
    return now == applied_.end() ? ScriptTrim{} : now->second;
}

void DeskScript::setTrim(const ScriptTrim& trim, bool goesOn) {
    if (hands() == nullptr || trim == this->trim()) return;
    apply(trim, goesOn);
}

} // namespace physvib

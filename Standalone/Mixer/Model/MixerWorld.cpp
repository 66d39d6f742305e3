// SPDX-License-Identifier: GPL-3.0-or-later
// Applies inputs and edits, converts the log of a scene run to a script, and matches the levels of two mixes.
#include "Mixer/Model/MixerWorld.h"
#include "Mixer/Model/MixerModel.h"
#include "Scene/SceneEdits.h"
#include "Scene/SceneValidation.h"
#include "Scene/World/BodyLists.h"
#include <map>

namespace physvib {

/// An edit of the drawing in JUCE's undo history.
class MixerWorld::Edit final : public juce::UndoableAction {
public:
    Edit(MixerHistory& history, SceneEdit edit)
        : history_{history}
        , edit_{std::move(edit)} {}
    // false if the session refuses it, so that JUCE keeps no step
    bool perform() override {
        const bool isDone = submit(true);
        return std::exchange(wasPerformed_, true) || isDone;
    }
    bool undo() override { // always true: JUCE would forget all steps if one failed
        if (!submit(false)) world().onError_("Undo: " + std::exchange(world().editError_, {}));
        return true;
    }
    int getSizeInUnits() override { return 1; }
    // merges successive changes of a sound or texture by one control
    juce::UndoableAction* createCoalescedAction(juce::UndoableAction* nextAction) override {
        const auto* nextEdit = dynamic_cast<Edit*>(nextAction);
        if (nextEdit == nullptr ||
            !(changesSameMaterial<SoundAction>(*nextEdit) || changesSameMaterial<TextureAction>(*nextEdit)))
            return nullptr;
        auto* mergedEdit = new Edit{history_, edit_.mergedWith(nextEdit->edit_)};
        mergedEdit->wasPerformed_ = true;
        return mergedEdit;
    }

private:
    template <class ChangeAction>
    bool changesSameMaterial(const Edit& next) const {
        const auto &actions = edit_.actions(), &nextActions = next.edit_.actions();
        if (actions.size() != 1 || nextActions.size() != 1) return false;
        const auto *before = std::get_if<ChangeAction>(&actions.front()),
                   *after = std::get_if<ChangeAction>(&nextActions.front());
        return before != nullptr && after != nullptr && before->material == after->material;
    }
    // Submits all actions at once: in a slow world each would wait for a step, and Esc would wait for all.
    bool submit(bool isForward) {
        MixerWorld& world = this->world();
        const SceneDrawing oldDrawing = world.drawing_;
        std::vector<Action> actions;
        edit_.perform(isForward, world.drawing_, world.posesNow(), [&](std::span<const Action> part) {
            world.drawing_.apply(part);
            actions.insert(actions.end(), part.begin(), part.end());
        });
        if (auto error = world.session_.submit({std::span<const Action>{actions}}).error; !error.empty()) {
            world.drawing_ = oldDrawing;
            return world.editError_ = std::move(error), false;
        }
        for (const Action& action : actions) world.reportInput(isLasting(action));
        return true;
    }
    MixerWorld& world() const { return history_.model->world(); }
    MixerHistory& history_;
    SceneEdit edit_;
    bool wasPerformed_ = false;
};

MixerWorld::MixerWorld(Session& session, const Mix& mix, MixerHistory& history,
                       std::function<void(bool changesDisplay)> onInput,
                       std::function<void(const std::string&)> onError)
    : session_{session}
    , mix_{mix}
    , history_{history}
    , onInput_{std::move(onInput)}
    , onError_{std::move(onError)}
    , drawing_{*mix.scene} {}

std::string MixerWorld::apply(const Action& action) {
    auto error = session_.submit({action}).error;
    if (!error.empty()) return error;
    drawing_.apply(action);
    reportInput(isLasting(action));
    return error;
}

void MixerWorld::reportInput(bool changesDisplay) {
    if (changesDisplay) ++editCount_;
    onInput_(changesDisplay);
}

CurrentPose MixerWorld::posesNow() const {
    std::vector<BodyPose> poses;
    session_.world().readPoses(poses);
    std::map<std::string, std::optional<BodyPose>> last; // last body of each name
    for (std::size_t i = 0; const BodyDescription& body : allBodies(scene())) {
        last[body.name] = i < poses.size() && poses[i].isPresent ? poseWithinLimits(poses[i]) : std::nullopt;
        ++i;
    }
    return [last = std::move(last)](const std::string& body) {
        const auto found = last.find(body);
        return found == last.end() ? std::nullopt : found->second;
    };
}

std::string MixerWorld::edit(const juce::String& name, std::vector<Action> actions, bool continuesEdit) {
    for (Action& action : actions)
        if (auto* spawn = std::get_if<SpawnAction>(&action); spawn != nullptr && spawn->body.name.empty())
            spawn->body.name = drawing_.unusedName("added");
    if (actions.empty()) return {};
    if (auto error = drawing_.check(actions); !error.empty()) return error;
    history_.beginStep(name, continuesEdit);
    editError_.clear();
    history_.undo.perform(new Edit{history_, SceneEdit{std::move(actions)}});
    return std::exchange(editError_, {});
}

juce::String MixerWorld::overloadWarning(std::int64_t sessionNs, std::int64_t posesNs,
                                         const std::vector<BodyPose>& poses) {
    const auto share =
        pace_.poll(sessionNs, session_.world().stalledNs() + std::max<std::int64_t>(0, sessionNs - posesNs));
    if (!share) return {};
    const auto bodies = std::ranges::count_if(poses, &BodyPose::isPresent);
    const bool wasOverloaded = std::exchange(isOverloaded_, *share < RealTimeMonitor::minShare &&
                                                                bodies >= RealTimeMonitor::minBodies);
    if (wasOverloaded || !isOverloaded_) return {};
    const int percent = juce::roundToInt(100.0 * *share);
    return utf8(readable::number(static_cast<double>(bodies), 0)) +
           " bodies: " + (percent < 1 ? juce::String{"less than 1"} : juce::String{percent}) +
           " % of real time; the physics takes it. Fewer bodies or slow motion help";
}

std::string MixerWorld::restartScene(bool isSameScene) {
    auto scene = std::make_shared<Scene>(isSameScene ? drawing_.drawn() : *mix_.scene);
    drawing_ = SceneDrawing{*scene};
    ++editCount_;
    const SessionState state{std::move(scene), mix_.seed};
    if (!(state == session_.world().state())) return session_.world().setState(state);
    session_.world().restart();
    return {};
}

namespace {

const juce::String scriptEditName{"Record a script"};

constexpr const char* compareEditName = "Compare A and B";

/// The contacts played last; if there are none, one at each of 15 places of the field.
std::vector<CollisionEvent> contactsToMatch(const MixerModel& model) {
    std::vector<CollisionEvent> events;
    for (const RecentContact& contact : model.recentContacts().newestFirst()) events.push_back(contact.event);
    if (!events.empty()) return events;
    const Scene& scene = model.world().scene();
    for (const double x : {0.1, 0.3, 0.5, 0.7, 0.9})
        for (const double y : {0.2, 0.5, 0.8}) {
            CollisionEvent event;
            event.x = x * scene.fieldWidthMetres;
            event.y = y * scene.fieldHeightMetres;
            event.amplitude = 1.0;
            events.push_back(event);
        }
    return events;
}

/// `mix` with the world of `source`, since the world is not part of the comparison.
Mix copyWorld(Mix mix, const Mix& source) {
    mix.scene = source.scene;
    mix.seed = source.seed;
    mix.dragNewtonSecondsPerScreenMetre = source.dragNewtonSecondsPerScreenMetre;
    return mix;
}

} // namespace

void MixerScript::start() {
    if (isRecording_) return;
    auto scene = std::make_shared<const Scene>(sceneToRecord(model_.world().drawing().drawn()));
    runIndex_ = model_.savedSession().log.runs.size();
    model_.change(scriptEditName, [&scene](Mix& mix) { mix.scene = scene; });
    recordedScene_ = model_.mix().scene;
    worldEditCount_ = model_.world().editCount();
    seconds_ = 0.0;
    inputCount_ = 0;
    isRecording_ = true;
    if (model_.session().world().slowness() == 0) model_.setSlowness(1);
}

void MixerScript::poll() {
    if (!isRecording_) return;
    if (model_.mix().scene != recordedScene_) { // another scene was chosen
        isRecording_ = false;
        return model_.report(
            "The recording of hands has ended: another scene was chosen. No script was kept");
    }
    const auto& runs = model_.savedSession().log.runs;
    if (runs.size() <= runIndex_) return; // the world has not restarted yet
    const SceneRun& run = runs[runIndex_];
    seconds_ = 1e-9 * static_cast<double>(run.worldEndNs);
    inputCount_ = run.inputs.size();
    const bool isFull =
        seconds_ >= maxRecordedSeconds(*recordedScene_) || inputCount_ >= maxRecordedInputs(*recordedScene_);
    const bool hasEnded = runs.size() > runIndex_ + 1 || model_.world().editCount() != worldEditCount_;
    if (isFull || hasEnded) stop();
    if (isFull)
        model_.announce("The script is full: the recording of hands ended after " +
                        utf8(readable::number(recording_.lengthSeconds, 1)) + " s");
}

void MixerScript::stop() {
    if (!isRecording_) return;
    isRecording_ = false;
    sceneTrims_.clear();
    const auto& runs = model_.savedSession().log.runs;
    if (runs.size() > runIndex_)
        recording_ = recordedInputs(runs[runIndex_]);
    else
        recording_ = {};
    if (recording_.inputs.empty()) return model_.announce("Nothing was recorded: no hand did anything");
    apply({0.0, recording_.lengthSeconds, false}, true);
}

// Keeps the bodies that were drawn since the recording.
void MixerScript::apply(const ScriptTrim& trim, bool continuesEdit) {
    Scene scene = model_.world().drawing().drawn();
    scene.script = recordedScene_->script;
    scene.scriptPeriodSeconds = recordedScene_->scriptPeriodSeconds;
    scene = sceneWithInputs(std::move(scene), recording_, trim);
    if (const auto error = validate(scene); !error.empty())
        return model_.report("The script: " + utf8(error));
    auto editedScene = std::make_shared<const Scene>(std::move(scene));
    std::erase_if(sceneTrims_, [](const auto& entry) { return entry.first.expired(); });
    sceneTrims_.emplace_back(editedScene, trim);
    model_.change(scriptEditName, continuesEdit, [&editedScene](Mix& mix) { mix.scene = editedScene; });
}

const RecordedInputs* MixerScript::recording() const {
    const bool isRecorded = !isRecording_ && std::ranges::any_of(sceneTrims_, [this](const auto& entry) {
        return entry.first.lock() == model_.mix().scene;
    });
    return isRecorded ? &recording_ : nullptr;
}

ScriptTrim MixerScript::trim() const {
    const auto found = std::ranges::find_if(
        sceneTrims_, [this](const auto& entry) { return entry.first.lock() == model_.mix().scene; });
    return found == sceneTrims_.end() ? ScriptTrim{} : found->second;
}

void MixerScript::setTrim(const ScriptTrim& trim, bool continuesEdit) {
    if (recording() == nullptr || trim == this->trim()) return;
    apply(trim, continuesEdit);
}

double contactEnergyG2(const Mix& mix, std::span<const CollisionEvent> events) {
    const auto strips = effectiveStrips(mix);
    const PhantomPanner panner = mix.panner();
    double sumG2 = 0.0;
    for (const CollisionEvent& event : events) {
        PhantomPanner::Gains gains{};
        panner.gainsAt(event, gains);
        for (std::size_t j = 0; j < strips.size(); ++j) {
            if (strips[j].output < 0 || isSilent(strips, j)) continue;
            const double levelG = std::abs(event.amplitude) * static_cast<double>(gains[j]) *
                                  static_cast<double>(channelGain(strips[j])) *
                                  mix.layout.actuators[j].fullScaleG;
            sumG2 += levelG * levelG;
        }
    }
    return sumG2 * static_cast<double>(masterGain(mix)) * static_cast<double>(masterGain(mix));
}

bool MixerCompare::isComparing() const {
    return otherMix_ && model_.undoManager().getRedoDescription() != compareEditName;
}

// The current mix without the lowering by toggle(), unless the user has set the level since.
Mix MixerCompare::userMix() const {
    Mix mix = model_.mix();
    if (mix.levelDb == appliedLevelDb_) mix.levelDb = std::min(0.0, mix.levelDb + loweredDb_);
    return mix;
}

void MixerCompare::toggle() {
    if (!isComparing()) {
        end();
        appliedLevelDb_ = model_.mix().levelDb;
        otherMix_ = model_.mix();
    }
    const Mix oldMix = userMix();
    Mix newMix = copyWorld(*otherMix_, model_.mix());
    const auto events = contactsToMatch(model_);
    const double oldG2 = contactEnergyG2(oldMix, events), newG2 = contactEnergyG2(newMix, events);
    loweredDb_ = oldG2 > 0.0 && newG2 > oldG2 ? 10.0 * std::log10(newG2 / oldG2) : 0.0;
    if (newMix.levelDb > minStripDb) newMix.levelDb = std::max(minStripDb, newMix.levelDb - loweredDb_);
    appliedLevelDb_ = newMix.levelDb;
    isBActive_ = !isBActive_;
    otherMix_ = oldMix;
    model_.edit(compareEditName, newMix, true); // changes back and forth are one step
}

void MixerCompare::end() {
    otherMix_.reset();
    isBActive_ = false;
    loweredDb_ = 0.0;
}

} // namespace physvib

// SPDX-License-Identifier: GPL-3.0-or-later
// Applies inputs and edits, converts the log of a scene run to a script, and matches the levels of two mixes.
#include "Mixer/Model/MixerWorld.h"
#include "Mixer/Model/MixerModel.h"
#include "Scene/SceneEdits.h"
#include "Scene/SceneValidation.h"
#include "Scene/World/SceneCast.h"
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
        const bool isDone = run(true);
        return std::exchange(isRepeated_, true) || isDone;
    }
    bool undo() override { // always true: JUCE would forget all steps if one failed
        if (!run(false)) world().onFault_("Undo: " + std::exchange(world().refused_, {}));
        return true;
    }
    int getSizeInUnits() override { return 1; }
    // merges successive changes of a sound or texture by one control
    juce::UndoableAction* createCoalescedAction(juce::UndoableAction* next) override {
        const auto* other = dynamic_cast<Edit*>(next);
        if (other == nullptr || !(isTurned<SoundAction>(*other) || isTurned<TextureAction>(*other)))
            return nullptr;
        auto* both = new Edit{history_, edit_.followedBy(other->edit_)};
        both->isRepeated_ = true;
        return both;
    }

private:
    template <class Turned>
    bool isTurned(const Edit& next) const {
        const auto &here = edit_.forth(), &there = next.edit_.forth();
        if (here.size() != 1 || there.size() != 1) return false;
        const auto *before = std::get_if<Turned>(&here.front()), *after = std::get_if<Turned>(&there.front());
        return before != nullptr && after != nullptr && before->material == after->material;
    }
    // Submits all actions at once: in a slow world each would wait for a step, and Esc for all of them.
    bool run(bool isForth) {
        MixerWorld& world = this->world();
        const SceneDrawing before = world.drawing_;
        std::vector<Action> actions;
        edit_.run(isForth, world.drawing_, world.posesNow(), [&](std::span<const Action> some) {
            world.drawing_.take(some);
            actions.insert(actions.end(), some.begin(), some.end());
        });
        if (auto fault = world.session_.submit({std::span<const Action>{actions}}).error; !fault.empty()) {
            world.drawing_ = before;
            return world.refused_ = std::move(fault), false;
        }
        for (const Action& action : actions) world.acted(isLasting(action));
        return true;
    }
    MixerWorld& world() const { return history_.model->world(); }
    MixerHistory& history_;
    SceneEdit edit_;
    bool isRepeated_ = false;
};

MixerWorld::MixerWorld(Session& session, const Mix& mix, MixerHistory& history,
                       std::function<void(bool isShown)> onInput,
                       std::function<void(const std::string&)> onFault)
    : session_{session}
    , mix_{mix}
    , history_{history}
    , onInput_{std::move(onInput)}
    , onFault_{std::move(onFault)}
    , drawing_{*mix.scene} {}

std::string MixerWorld::act(const Action& action) {
    auto fault = session_.submit({action}).error;
    if (!fault.empty()) return fault;
    drawing_.take(action);
    acted(isLasting(action));
    return fault;
}

void MixerWorld::acted(bool isShown) {
    if (isShown) ++edits_;
    onInput_(isShown);
}

PoseNow MixerWorld::posesNow() const {
    std::vector<BodyPose> poses;
    session_.world().readPoses(poses);
    std::map<std::string, std::optional<BodyPose>> last; // last body of each name
    for (std::size_t i = 0; const BodyDescription& body : sceneCast(scene())) {
        last[body.name] = i < poses.size() && poses[i].isPresent ? drawable(poses[i]) : std::nullopt;
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
            spawn->body.name = drawing_.freeName("added");
    if (actions.empty()) return {};
    if (auto fault = drawing_.check(actions); !fault.empty()) return fault;
    auto& undo = history_.undo;
    if (!continuesEdit || undo.getCurrentTransactionName() != name) undo.beginNewTransaction(name);
    refused_.clear();
    undo.perform(new Edit{history_, SceneEdit{std::move(actions)}});
    return std::exchange(refused_, {});
}

juce::String MixerWorld::tooMuch(std::int64_t sessionNs, std::int64_t posesNs,
                                 const std::vector<BodyPose>& poses) {
    const auto share =
        pace_.look(sessionNs, session_.world().slippedNs() + std::max<std::int64_t>(0, sessionNs - posesNs));
    if (!share) return {};
    const auto bodies = std::ranges::count_if(poses, &BodyPose::isPresent);
    const bool wasTooMuch =
        std::exchange(isTooMuch_, *share < PaceWatch::leastShare && bodies >= PaceWatch::minBodies);
    if (wasTooMuch || !isTooMuch_) return {};
    const int percent = juce::roundToInt(100.0 * *share);
    return utf8(readable::number(static_cast<double>(bodies), 0)) +
           " bodies: " + (percent < 1 ? juce::String{"less than 1"} : juce::String{percent}) +
           " % of real time; the physics takes it. Fewer bodies or slow motion help";
}

std::string MixerWorld::begin(bool isSameScene) {
    auto scene = std::make_shared<Scene>(isSameScene ? drawing_.drawn() : *mix_.scene);
    drawing_ = SceneDrawing{*scene};
    ++edits_;
    const SessionState state{std::move(scene), mix_.seed};
    if (!(state == session_.world().state())) return session_.world().setState(state);
    session_.world().restart();
    return {};
}

namespace {

const juce::String editName{"Record a script"};

constexpr const char* compareStep = "Compare A and B";

/// The contacts played last; before there are any, one at each of 15 places.
std::vector<CollisionEvent> contactsOf(const MixerModel& model) {
    std::vector<CollisionEvent> events;
    for (const RecentContact& contact : model.recent().newestFirst()) events.push_back(contact.event);
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

/// `mix` with the world of `now`: only the rest is compared.
Mix withWorldOf(Mix mix, const Mix& now) {
    mix.scene = now.scene;
    mix.seed = now.seed;
    mix.dragNewtonSecondsPerScreenMetre = now.dragNewtonSecondsPerScreenMetre;
    return mix;
}

} // namespace

void MixerScript::start() {
    if (isRecording_) return;
    auto scene = std::make_shared<const Scene>(sceneToRecord(model_.world().drawing().drawn()));
    runsBefore_ = model_.saved().log.takes.size();
    model_.change(editName, [&scene](Mix& mix) { mix.scene = scene; });
    recordedIn_ = model_.mix().scene;
    worldEdits_ = model_.world().edits();
    seconds_ = 0.0;
    inputs_ = 0;
    isRecording_ = true;
    if (model_.session().world().slowness() == 0) model_.setSlowness(1);
}

void MixerScript::look() {
    if (!isRecording_) return;
    if (model_.mix().scene != recordedIn_) { // another scene was chosen
        isRecording_ = false;
        return model_.report(
            "The recording of hands has ended: another scene was chosen. No script was kept");
    }
    const auto& runs = model_.saved().log.takes;
    if (runs.size() <= runsBefore_) return; // the world has not restarted yet
    const SceneRun& run = runs[runsBefore_];
    seconds_ = 1e-9 * static_cast<double>(run.worldEndNs);
    inputs_ = run.inputs.size();
    const bool isFull =
        seconds_ >= maxRecordedSeconds(*recordedIn_) || inputs_ >= maxRecordedInputs(*recordedIn_);
    const bool isOver = runs.size() > runsBefore_ + 1 || model_.world().edits() != worldEdits_;
    if (isFull || isOver) stop();
    if (isFull)
        model_.announce("The script is full: the recording of hands ended after " +
                        utf8(readable::number(hands_.lengthSeconds, 1)) + " s");
}

void MixerScript::stop() {
    if (!isRecording_) return;
    isRecording_ = false;
    applied_.clear();
    const auto& runs = model_.saved().log.takes;
    if (runs.size() > runsBefore_)
        hands_ = recordedHands(runs[runsBefore_]);
    else
        hands_ = {};
    if (hands_.inputs.empty()) return model_.announce("Nothing was recorded: no hand did anything");
    apply({0.0, hands_.lengthSeconds, false}, true);
}

// Keeps bodies that were drawn meanwhile.
void MixerScript::apply(const ScriptTrim& trim, bool continuesEdit) {
    Scene scene = model_.world().drawing().drawn();
    scene.script = recordedIn_->script;
    scene.scriptPeriodSeconds = recordedIn_->scriptPeriodSeconds;
    scene = withHands(std::move(scene), hands_, trim);
    if (const auto fault = validate(scene); !fault.empty())
        return model_.report("The script: " + utf8(fault));
    auto next = std::make_shared<const Scene>(std::move(scene));
    std::erase_if(applied_, [](const auto& one) { return one.first.expired(); });
    applied_.emplace_back(next, trim);
    model_.change(
        editName, [&next](Mix& mix) { mix.scene = next; }, continuesEdit);
}

const HandScript* MixerScript::hands() const {
    const bool isOurs = !isRecording_ && std::ranges::any_of(applied_, [this](const auto& one) {
        return one.first.lock() == model_.mix().scene;
    });
    return isOurs ? &hands_ : nullptr;
}

ScriptTrim MixerScript::trim() const {
    const auto now = std::ranges::find_if(
        applied_, [this](const auto& one) { return one.first.lock() == model_.mix().scene; });
    return now == applied_.end() ? ScriptTrim{} : now->second;
}

void MixerScript::setTrim(const ScriptTrim& trim, bool continuesEdit) {
    if (hands() == nullptr || trim == this->trim()) return;
    apply(trim, continuesEdit);
}

double energyOf(const Mix& mix, std::span<const CollisionEvent> events) {
    const auto strips = feltStrips(mix);
    const PhantomPanner panner = mix.panner();
    double sum = 0.0;
    for (const CollisionEvent& event : events) {
        PhantomPanner::Gains gains{};
        panner.gainsAt(event, gains);
        for (std::size_t j = 0; j < strips.size(); ++j) {
            if (strips[j].output < 0 || isSilent(strips, j)) continue;
            const double g = std::abs(event.amplitude) * static_cast<double>(gains[j]) *
                             static_cast<double>(channelGain(strips[j])) *
                             mix.layout.enchanters[j].fullScaleG;
            sum += g * g;
        }
    }
    return sum * static_cast<double>(masterGain(mix)) * static_cast<double>(masterGain(mix));
}

bool MixerCompare::isOn() const { return other_ && model_.undoManager().getRedoDescription() != compareStep; }

// Without the lowering by toggle(), unless the user has set the level since.
Mix MixerCompare::own() const {
    Mix mix = model_.mix();
    if (mix.levelDb == setDb_) mix.levelDb = std::min(0.0, mix.levelDb + loweredDb_);
    return mix;
}

void MixerCompare::toggle() {
    if (!isOn()) {
        end();
        setDb_ = model_.mix().levelDb;
        other_ = model_.mix();
    }
    const Mix before = own();
    Mix next = withWorldOf(*other_, model_.mix());
    const auto events = contactsOf(model_);
    const double here = energyOf(before, events), there = energyOf(next, events);
    loweredDb_ = here > 0.0 && there > here ? 10.0 * std::log10(there / here) : 0.0;
    if (next.levelDb > leastStripDb) next.levelDb = std::max(leastStripDb, next.levelDb - loweredDb_);
    setDb_ = next.levelDb;
    isB_ = !isB_;
    other_ = before;
    model_.edit(compareStep, next, true); // changes back and forth are one step
}

void MixerCompare::end() {
    other_.reset();
    isB_ = false;
    loweredDb_ = 0.0;
}

} // namespace physvib

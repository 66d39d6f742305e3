// SPDX-License-Identifier: GPL-3.0-or-later
// Applies inputs and undoable edits to the mixer's world.
#include "Mixer/Desk/DeskWorld.h"
#include "Io/Text/ReadableNumber.h"
#include "Mixer/Desk/DeskWords.h"
#include "Scene/World/SceneCast.h"
#include <algorithm>
#include <map>
#include <utility>

namespace physvib {

/// An edit of the drawing in JUCE's undo history.
class DeskWorld::Edit final : public juce::UndoableAction {
public:
    Edit(DeskWorld& world, SceneEdit edit)
        : world_{world}
        , edit_{std::move(edit)} {}
    // refused in the middle: what was done of it is taken back, and JUCE keeps no step
    bool perform() override {
        const bool isDone = run(true);
        if (!isDone && !isRepeated_) run(false);
        return std::exchange(isRepeated_, true) || isDone;
    }
    bool undo() override { return run(false); }
    int getSizeInUnits() override { return 1; }
    // merges successive changes of a sound or texture by one control
    juce::UndoableAction* createCoalescedAction(juce::UndoableAction* next) override {
        const auto* other = dynamic_cast<Edit*>(next);
        if (other == nullptr || !(isTurned<SoundAction>(*other) || isTurned<TextureAction>(*other)))
            return nullptr;
        auto* both = new Edit{world_, edit_.followedBy(other->edit_)};
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
    bool run(bool isForth) {
        const auto now = [this](const std::string& body) { return world_.poseNow(body); };
        auto fault = edit_.run(isForth, world_.drawing_, now,
                               [this](const Action& action) { return world_.act(action); });
        const bool isDone = fault.empty();
        if (!isDone) world_.refused_ = std::move(fault);
        return isDone;
    }
    DeskWorld& world_;
    SceneEdit edit_;
    bool isRepeated_ = false;
};

DeskWorld::DeskWorld(Session& session, const Mix& mix, juce::UndoManager& undo,
                     std::function<void(bool isShown)> onInput)
    : session_{session}
    , mix_{mix}
    , undo_{undo}
    , onInput_{std::move(onInput)}
    , drawing_{*mix.scene} {}

std::string DeskWorld::act(const Action& action) {
    auto fault = session_.submit({action}).error;
    if (!fault.empty()) return fault;
    const bool isShown = drawing_.take(action);
    if (isShown) ++edits_;
    onInput_(isShown);
    return fault;
}

std::optional<BodyPose> DeskWorld::poseNow(const std::string& body) const {
    const auto cast = sceneCast(scene());
    std::vector<BodyPose> poses;
    session_.world().readPoses(poses);
    std::size_t last = cast.size(); // last body of that name
    while (last-- > 0 && cast[last].name != body) {
    }
    // not present, or it is created at the next step, at its drawn place
    if (last >= poses.size() || !poses[last].isPresent) return std::nullopt;
    return poses[last];
}

PoseNow DeskWorld::posesNow() const {
    std::vector<BodyPose> poses;
    session_.world().readPoses(poses);
    std::map<std::string, std::optional<BodyPose>> last; // last body of each name
    for (std::size_t i = 0; const BodyDescription& body : sceneCast(scene())) {
        last[body.name] = i < poses.size() && poses[i].isPresent ? std::optional{poses[i]} : std::nullopt;
        ++i;
    }
    return [last = std::move(last)](const std::string& body) {
        const auto found = last.find(body);
        return found == last.end() ? std::nullopt : found->second;
    };
}

std::string DeskWorld::edit(const juce::String& name, std::vector<Action> actions, bool goesOn) {
    for (Action& action : actions)
        if (auto* spawn = std::get_if<SpawnAction>(&action); spawn != nullptr && spawn->body.name.empty())
            spawn->body.name = drawing_.freeName("added");
    if (actions.empty()) return {};
    if (auto fault = drawing_.check(actions); !fault.empty()) return fault;
    if (!goesOn || undo_.getCurrentTransactionName() != name) undo_.beginNewTransaction(name);
    refused_.clear();
    undo_.perform(new Edit{*this, SceneEdit{std::move(actions)}});
    return std::exchange(refused_, {});
}

juce::String DeskWorld::tooMuch(std::int64_t sessionNs, std::int64_t posesNs,
                                const std::vector<BodyPose>& poses) {
    const auto share =
        pace_.look(sessionNs, session_.world().slippedNs() + std::max<std::int64_t>(0, sessionNs - posesNs));
    if (!share) return {};
    const auto bodies = std::ranges::count_if(poses, &BodyPose::isPresent);
    const bool wasTooMuch =
        std::exchange(isTooMuch_, *share < PaceWatch::leastShare && bodies >= PaceWatch::leastBodies);
    if (wasTooMuch || !isTooMuch_) return {};
    const int percent = juce::roundToInt(100.0 * *share);
    return utf8(readable::number(static_cast<double>(bodies), 0)) +
           " bodies: " + (percent < 1 ? juce::String{"less than 1"} : juce::String{percent}) +
           " % of real time; the physics takes it. Fewer bodies or slow motion help";
}

std::string DeskWorld::begin(bool isSameScene) {
    auto scene = std::make_shared<Scene>(isSameScene ? drawing_.drawn() : *mix_.scene);
    drawing_ = SceneDrawing{*scene};
    ++edits_;
    const SessionState state{std::move(scene), mix_.seed};
    if (!(state == session_.world().state())) return session_.world().setState(state);
    session_.world().restart();
    return {};
}

} // namespace physvib

// SPDX-License-Identifier: GPL-3.0-or-later
// Applies edits of the mixer state to session (SentMix) and output, opens the device, collects played events.
#include "Mixer/Model/MixerModel.h"
#include "Scene/Drawing/BodyEdits.h"
#include "Scene/SceneFile.h"
#include <juce_gui_basics/juce_gui_basics.h>
#include <limits>

namespace physvib {
namespace {

constexpr int stepsPerSecond = 100;
constexpr const char* deviceLabel = "device"; // as Rig names it
constexpr double newStripDb = -12.0;          // quiet, because people may be holding the actuators

SessionSetup makeSetup(const Mix& mix) {
    SessionSetup setup;
    setup.scene = *mix.scene;
    setup.seed = mix.seed;
    setup.stepsPerSecond = stepsPerSecond;
    setup.channels = MixerModel::channels;
    setup.panner = mix.panner();
    setup.layout = mix.layout;
    setup.longestGapSeconds = threadGapSeconds(stepsPerSecond);
    setup.contactSound.emplace();
    setup.contactChannels = 2;
    setup.marks = MarkedOnsets::all;
    return setup;
}

/// Limits the gains of new strips to the lowest gain of an existing strip that plays.
void limitNewStrips(std::span<const Strip> oldStrips, std::span<Strip> strips) {
    double maxDb = maxStripDb;
    for (const Strip& strip : oldStrips)
        if (strip.gainDb > minStripDb) maxDb = std::min(maxDb, strip.gainDb);
    for (std::size_t j = oldStrips.size(); j < strips.size(); ++j)
        strips[j].gainDb = std::min(strips[j].gainDb, maxDb);
}

RigSettings makeRigSettings(const Mix& mix, const DeviceChoice& device) {
    return {.setup = makeSetup(mix), .sinks = device.sinks, .awaitsSinks = false};
}

bool isSame(const PhantomPanner& a, const PhantomPanner& b) {
    return a.law() == b.law() && a.exponent() == b.exponent() &&
           (a.requestedLaw() == b.requestedLaw() || !hasParts(a.layout())) &&
           a.fieldWidthMetres() == b.fieldWidthMetres() && a.fieldHeightMetres() == b.fieldHeightMetres() &&
           isSame(a.layout(), b.layout());
}

} // namespace

/// The part of the mixer state that the session has received. Message thread.
class SentMix {
public:
    /// Initial state: the session was created with `panner` and default strips.
    explicit SentMix(const PhantomPanner& panner)
        : panner_{panner} {}

    /// Posts all differences. If the session's queue is full, the rest is posted by the next call.
    void send(Session& session, const Mix& mix) {
        using Kind = RenderControl::Kind;
        const auto post = [&session](Kind kind, const PhantomPanner* panner = nullptr) {
            return session.submit({RenderControl{0, kind, 0, 0.0f, panner}}).error.empty();
        };
        if (const auto panner = mix.panner(); !isSame(panner_, panner)) {
            // a channel may belong to another actuator now
            if (panner.channels() < panner_.channels() && !post(Kind::stopAll)) return;
            if (!post(Kind::panner, &panner)) return;
            panner_ = panner;
        }
        const auto effective = effectiveStrips(mix);
        for (std::size_t j = 0; j < hasLanes_.size(); ++j)
            if (hasLanes_[j]) strips_[j].gain = channelGain(effective[j]); // set by its lane
        sendStrips(strips_, effective, [&session](const RenderControl& control) {
            return session.submit({control}).error.empty();
        });
    }

    /// Sends changed lanes; the session itself then controls strips with a lane.
    void sendLanes(Session& session, const Mix& mix) {
        std::vector<bool> hasLanes(mix.strips.size());
        for (std::size_t j = 0; j < hasLanes.size(); ++j) hasLanes[j] = hasLane(mix, j);
        for (std::size_t j = 0; j < hasLanes_.size(); ++j) // the gain at the end of its lane is unknown here
            if (hasLanes_[j] && (j >= hasLanes.size() || !hasLanes[j]))
                strips_[j].gain = std::numeric_limits<float>::quiet_NaN();
        const bool hasAny = std::ranges::find(hasLanes, true) != hasLanes.end(),
                   hadAny = std::ranges::find(hasLanes_, true) != hasLanes_.end();
        hasLanes_ = std::move(hasLanes);
        if (hasAny || hadAny) session.submit({Lanes{hasAny ? std::make_shared<const Mix>(mix) : nullptr}});
    }

private:
    PhantomPanner panner_;
    std::vector<bool> hasLanes_; // by strip
    std::array<SentStrip, limits::maxActuators> strips_{};
};

Mix MixerModel::defaultMix() {
    Mix mix;
    mix.scene = std::make_shared<const Scene>(*findBuiltInScene("shake-the-box"));
    mix.layout = presetLayout("phone4");
    mix.resizeStrips();
    return mix;
}

/// An undoable edit of the mixer state; repeated edits of one fader merge into one.
class MixerModel::MixEdit final : public juce::UndoableAction, public MixStates {
public:
    MixEdit(MixerHistory& history, Mix oldMix, Mix newMix)
        : MixStates{std::move(oldMix), std::move(newMix)}
        , history_{history} {
        history_.mixEdits.insert(this);
    }
    ~MixEdit() override { history_.mixEdits.erase(this); }
    MixEdit(const MixEdit&) = delete;
    // JUCE keeps no step of an action that fails at first, but forgets all steps if one fails later
    bool perform() override {
        const bool isDone = history_.model->apply(after);
        return std::exchange(wasPerformed_, true) || isDone;
    }
    bool undo() override { return history_.model->apply(before), true; }
    int getSizeInUnits() override { return 1; }
    juce::UndoableAction* createCoalescedAction(juce::UndoableAction* nextAction) override {
        const auto* nextEdit = dynamic_cast<MixEdit*>(nextAction);
        if (nextEdit == nullptr) return nullptr;
        auto* mergedEdit = new MixEdit{history_, before, nextEdit->after};
        mergedEdit->wasPerformed_ = true;
        return mergedEdit;
    }

private:
    MixerHistory& history_;
    bool wasPerformed_ = false;
};

MixerModel::MixerModel(AudioDrivers drivers, const DeviceChoice& device, Mix mix, MixerStart start)
    : mix_{std::move(mix)}
    , rig_{makeRigSettings(mix_, device), drivers}
    , device_{rig_, std::move(drivers), mix_, [this] { sendChangeMessage(); }}
    , recording_{session(), output(), mix_, [this] { sendChangeMessage(); }}
    , history_{start.history ? std::move(start.history) : std::make_shared<MixerHistory>()}
    , world_{session(), mix_, *history_, [this](bool changesDisplay) { countEdit(changesDisplay); },
             [this](const std::string& error) { report(utf8(error)); }}
    , sentMix_{std::make_unique<SentMix>(mix_.panner())}
    , eventPlayer_{session(),
                   output(),
                   mix_,
                   world_,
                   [this] { countEdit(true); },
                   [this](const Result<std::string>& note) { onClipRead(note); }} {
    history_->model = this;
    const auto withoutOutput = removeSharedOutputs(mix_.strips);
    savedSession_.run = makeSetup(mix_).run();
    savedSession_.panner = mix_.panner();
    savedSession_.layout = mix_.layout;
    maxActuators_ = mix_.count();
    signals_.tap().setActiveChannels(mix_.count());
    exposure_.setLayout(mix_.layout);
    session().sinks().attach(signals_.tap());
    const auto error = rig_.connectSinks();
    setSilent(start.isSilent); // before anything can be felt
    session().world().setSlowness(start.isPaused ? 0 : 1);
    open(device);
    if (!error.empty()) messages_.show({utf8(error), false, {}, "sinks"});
    reportNoOutput(*this, withoutOutput);
    sentMix_->sendLanes(session(), mix_);
    sentMix_->send(session(), mix_);
    editCount_ = 0;
    rig_.start();
}

MixerModel::~MixerModel() {
    output().stop();
    recording_.complete(); // first, since closing devices may hang
    inputs_.close();
    rig_.close();
}

void MixerModel::edit(const juce::String& name, const Mix& newMix, bool continuesEdit, bool restoresPoses) {
    history_->beginStep(name, continuesEdit);
    if (const Scene& drawn = world_.drawing().drawn();
        newMix.scene != mix_.scene && (restoresPoses || drawn != *mix_.scene)) {
        auto base = std::make_shared<const Scene>(restoresPoses ? sceneNow(drawn, world_.posesNow()) : drawn);
        const auto oldScene = std::exchange(mix_.scene, std::move(base));
        history_->drawnScenes.emplace_back(oldScene, mix_.scene);
    }
    Mix adjustedMix = newMix;
    limitNewStrips(mix_.strips, adjustedMix.strips);
    const auto withoutHeadphone = assignNewStrips(device_.choice(), adjustedMix.strips, mix_.strips.size());
    const auto withoutOutput = removeSharedOutputs(adjustedMix.strips);
    history_->undo.perform(new MixEdit{*history_, mix_, std::move(adjustedMix)});
    reportNoOutput(*this, withoutOutput);
    reportNoHeadphoneOutput(*this, withoutHeadphone);
}

void MixerModel::changeByMessage(const std::function<void(Mix&)>& change) {
    Mix newMix = mix_;
    change(newMix);
    if (!juce::Component::isMouseButtonDownAnywhere()) return edit("Strips by message", newMix, true);
    apply(newMix);
    for (MixStates* edit : history_->mixEdits)
        for (Mix* mix : {&edit->before, &edit->after})
            if (mix->count() == mix_.count()) change(*mix); // else its channels are others
}

bool MixerModel::apply(const Mix& newMix) {
    const Mix oldMix = std::exchange(mix_, newMix);
    if (history_->isSame(mix_.scene, oldMix.scene)) mix_.scene = oldMix.scene; // keeps the drawn bodies
    bool isRejected = false;
    ++editCount_;
    maxActuators_ = std::max(maxActuators_, mix_.count());
    if (mix_.scene != oldMix.scene || mix_.seed != oldMix.seed)
        reportIfError(world_.restartScene(mix_.scene == oldMix.scene));
    signals_.tap().setActiveChannels(mix_.count());
    exposure_.setLayout(mix_.layout);
    sentMix_->sendLanes(session(), mix_);
    sentMix_->send(session(), mix_);
    if (!mix_.strips.empty() &&
        !std::ranges::equal(oldMix.strips, mix_.strips, {}, &Strip::output, &Strip::output))
        if (const auto error = device_.assignOutputs(); !error.empty()) {
            setStripOutputs(output().channelMap(), mix_.strips); // rejected: neither displayed nor saved
            report(utf8(error));
            isRejected = isSame(mix_, oldMix);
        }
    if (std::ranges::none_of(mix_.strips, [](const Strip& strip) { return strip.output < 0; }))
        for (const char* label : {noOutputLabel, noHeadphoneOutputLabel}) messages_.withdraw(label);
    output().setLevel(masterGain(mix_));
    if (isRejected) --editCount_;
    sendChangeMessage();
    return !isRejected;
}

bool MixerModel::attach(double shareX, double shareY) {
    if (mix_.count() >= limits::maxActuators) return false;
    change("Attach an actuator", [&](Mix& mix) {
        auto& layout = mix.layout;
        const auto label = [](int n) {
            return describeLayout("", ActuatorLayout{1, 1, n + 1, {}}).actuators.back().label;
        };
        int n = 0;
        while (std::ranges::any_of(layout.actuators, [&](const auto& e) { return e.label == label(n); })) ++n;
        layout.name = "own";
        layout.actuators.push_back(
            {label(n), layout.actuators.back().actuator, layout.actuators.back().fullScaleG});
        auto& geometry = layout.geometry;
        const double x = shareX * geometry.extentWidthMetres, y = shareY * geometry.extentHeightMetres;
        // depth and part of the body are those of the nearest actuator in the view
        const auto others = std::span{geometry.places}.first(static_cast<std::size_t>(geometry.count));
        const auto nearest = *std::ranges::min_element(
            others, {}, [=](const ActuatorPlace& p) { return std::hypot(p.xMetres - x, p.yMetres - y); });
        geometry.places[others.size()] = {x, y, nearest.zMetres, nearest.part};
        ++geometry.count;
        mix.strips.push_back(makeNextStrip(mix.strips));
        mix.strips.back().gainDb = newStripDb;
    });
    return true;
}

void MixerModel::detach(int actuator) {
    if (mix_.count() < 2) return;
    change("Detach " + labelOf(mix_, actuator), [&](Mix& mix) {
        auto& layout = mix.layout;
        auto& places = layout.geometry.places;
        std::copy(places.begin() + actuator + 1, places.begin() + layout.geometry.count,
                  places.begin() + actuator);
        --layout.geometry.count;
        layout.name = "own";
        layout.actuators.erase(layout.actuators.begin() + actuator);
        mix.strips.erase(mix.strips.begin() + actuator);
    });
}

const SavedSession& MixerModel::savedSession() {
    savedSession_.channels = maxActuators_;
    savedSession_.lengthNs = session().status().sessionNs;
    session().readLog(savedSession_.log);
    savedSession_.mix = mix_;
    return savedSession_;
}

std::string MixerModel::open(const DeviceChoice& choice) {
    const int slowness = session().world().slowness();
    const DeviceChoice oldChoice = device_.choice();
    auto error = device_.open(choice);
    if (!choice.isHeadphones) {
        messages_.withdraw(noHeadphoneOutputLabel);
        if (oldChoice.isHeadphones) leaveHeadphones(*this, oldChoice);
    }
    session().world().setSlowness(slowness); // the first device resets it
    if (!error.empty())
        messages_.show({utf8(error), false, {}, deviceLabel});
    else
        messages_.withdraw(deviceLabel);
    signals_.setRate(output().sampleRateHz());
    sendChangeMessage(); // outputs or their names may have changed
    return error;
}

std::string MixerModel::moveOutputsToMonitor(std::vector<int> outputs, double levelDb) {
    if (!std::ranges::all_of(outputs, [this](int output) {
            return output >= device_.outputCount() || device_.listening().isFree(output);
        }))
        change("Listen instead of feeling", [&](Mix& mix) {
            for (Strip& strip : mix.strips)
                if (std::ranges::find(outputs, strip.output) != outputs.end()) strip.output = -1;
        });
    return device_.listening().setMonitor(std::move(outputs), levelDb);
}

void MixerModel::checkOutput() {
    sentMix_->send(session(), mix_); // retries controls for which the queue was full
    if (isSilent_ != output().isSilent()) showSilence();
    const int slowness = session().world().slowness();
    device_.maintain();
    session().world().setSlowness(slowness);
    // each source of errors has a message of its own
    const auto oldErrors = std::exchange(rigErrors_, rig_.errors());
    for (const RigError& previous : oldErrors)
        if (std::ranges::find(rigErrors_, previous.source, &RigError::source) == rigErrors_.end())
            messages_.withdraw(utf8(previous.source));
    for (const RigError& error : rigErrors_)
        if (std::ranges::find(oldErrors, error) == oldErrors.end())
            messages_.show({utf8(error.text), false, {}, utf8(error.source)});
}

void MixerModel::restart(std::uint32_t seed) {
    if (seed != mix_.seed) return change("Seed", [seed](Mix& mix) { mix.seed = seed; });
    reportIfError(world_.restartScene(true));
    countEdit();
}

void MixerModel::setSlowness(int slowness) {
    session().world().setSlowness(slowness);
    sendChangeMessage();
}

void MixerModel::countEdit(bool changesDisplay) {
    ++editCount_;
    if (changesDisplay) sendChangeMessage(); // lets idle views repaint
}

void MixerModel::onClipRead(const Result<std::string>& note) {
    if (!note) return report(utf8(note.error));
    const auto cliplessSink = device_.sinkWithoutClips();
    if (!note.value.empty()) announce(utf8(note.value));
    if (cliplessSink.isNotEmpty())
        messages_.add({"The " + cliplessSink + " plays no clips: it is felt on the device alone", true});
    countEdit();
}

bool MixerModel::reportIfError(const std::string& error) {
    if (!error.empty()) report(utf8(error));
    return !error.empty();
}

void MixerModel::setSilent(bool silent) {
    output().setSilent(silent);
    showSilence();
}

bool MixerModel::isVisualOnly() const {
    return device_.hasNoDevice() && session().sinks().states().empty() && inputs_.choice().receiver.empty();
}

void MixerModel::showSilence() {
    isSilent_ = output().isSilent();
    sendChangeMessage();
}

void MixerModel::setDisplayWidth(double metres) {
    displayWidthMetres_ = metres;
    sendChangeMessage();
}

MixerSnapshot MixerModel::poll() {
    const WorldRunner& world = session().world();
    signals_.setSceneTime(world.runNumber(),
                          1e-9 * static_cast<double>(world.sceneNs()) - device_.outputLatencySeconds(),
                          world.slowness());
    MixerSignals::PlayedFlags isPlayed{};
    for (std::size_t j = 0; j < mix_.strips.size(); ++j) isPlayed[j] = !isSilent_ && device_.isPlayed(j);
    const float maxPeak = signals_.updatePeaks(snapshot_, mix_.count(), isPlayed);
    snapshot_.session = session().status();
    snapshot_.device = output().status();
    exposure_.update();
    snapshot_.dailyExposure = exposure_.dailyA8();
    collectPlayed();
    snapshot_.hits.clear();
    snapshot_.hits.swap(hits_);
    recording_.poll(snapshot_.device);
    lanes_.poll();
    snapshot_.meters.limiterGain = snapshot_.session.render.limiterGain;
    snapshot_.meters.guardGain = snapshot_.device.guardGain;
    snapshot_.meters.actuatorCount = mix_.count();
    for (std::size_t j = 0; j < static_cast<std::size_t>(mix_.count()); ++j)
        snapshot_.meters.isConnected[j] = mix_.strips[j].output >= 0;
    snapshot_.masterPeak = maxPeak * masterGain(mix_);
    snapshot_.posesNs = session().world().readPoses(snapshot_.poses);
    snapshot_.latencyNs = static_cast<std::int64_t>(1e9 * device_.outputLatencySeconds());
    checkOutput();
    if (const auto warning =
            world_.overloadWarning(snapshot_.session.sessionNs, snapshot_.posesNs, snapshot_.poses);
        warning.isNotEmpty())
        report(warning);
    script_.poll();
    if (inputs_.hasNewMessages()) ++editCount_; // events from messages are part of the saved session
    return snapshot_;
}

void MixerModel::collectPlayed() {
    rig_.drainPlayed([this](const PlayedEvent& played) {
        hits_.push_back(played.event);
        recentContacts_.add(played.event);
        recording_.add(played);
    });
}

} // namespace physvib

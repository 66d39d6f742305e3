// SPDX-License-Identifier: GPL-3.0-or-later
// From the mix to the session's controls, and from what was played to what is shown.
#include "Mixer/Desk.h"
#include "Files/ActuatorFile.h"
#include "Files/SceneCatalogue.h"
#include "Physics/InputCheck.h"
#include "Physics/SceneCast.h"
#include "Physics/SceneEdits.h"
#include <algorithm>
#include <cmath>

namespace physvib {

namespace {

constexpr int stepsPerSecond = 100;
constexpr double gapSeconds = 0.005; // the driver's thread shares the machine with painting
constexpr double boardSeconds = 0.05; // the link needs 20 to 40 ms; more than that is told as trouble
constexpr double holdMs = 1500.0, maintainMs = 1000.0, boardPatienceMs = 2000.0; // greeting and clock take half a second
constexpr double newStripDb = -12.0; // hands are attached
constexpr double strikeAmplitude = 0.5; // of pulses and auditions, in front of strip, ceiling and master

juce::String utf8Text(const std::string& words) { return juce::String::fromUTF8(words.c_str()); }
double nowMs() { return juce::Time::getMillisecondCounterHiRes(); }

Mix shakeTheBox() {
    Mix mix;
    mix.scene = std::make_shared<const Scene>(*findBuiltInScene("shake-the-box"));
    EnchanterLayout layout;
    layoutPreset("phone4", layout);
    mix.layout = describeLayout("phone4", layout);
    mix.resizeStrips();
    return mix;
}

SessionSetup setupOf(const Mix& mix, bool hasBoard) {
    SessionSetup setup;
    setup.scene = *mix.scene;
    setup.seed = mix.seed;
    setup.stepsPerSecond = stepsPerSecond;
    setup.channels = Desk::channels;
    setup.panner = mix.panner();
    setup.longestGapSeconds = gapSeconds;
    if (hasBoard) setup.boardSeconds = boardSeconds;
    return setup;
}

float levelOf(const Mix& mix) { return mix.levelDb <= leastStripDb ? 0.0f : static_cast<float>(std::pow(10.0, mix.levelDb / 20.0)); }

bool isSame(const PhantomPanner& a, const PhantomPanner& b) {
    return a.law() == b.law() && a.exponent() == b.exponent() && a.fieldWidthMetres() == b.fieldWidthMetres() && a.fieldHeightMetres() == b.fieldHeightMetres() &&
           isSame(a.layout(), b.layout());
}

} // namespace

Mix Desk::firstMix() { return shakeTheBox(); }

juce::String titleOf(const std::string& name) {
    const auto words = juce::String::fromUTF8(name.c_str()).replaceCharacter('-', ' ');
    return words.substring(0, 1).toUpperCase() + words.substring(1);
}

/// One thing to undo; edits of a held fader grow into one.
class Desk::MixEdit final : public juce::UndoableAction {
public:
    MixEdit(Desk& desk, Mix before, Mix after)
        : desk_{desk}
        , before_{std::move(before)}
        , after_{std::move(after)} {}
    bool perform() override { return desk_.apply(after_), true; }
    bool undo() override { return desk_.apply(before_), true; }
    int getSizeInUnits() override { return 1; }
    juce::UndoableAction* createCoalescedAction(juce::UndoableAction* next) override {
        const auto* other = dynamic_cast<MixEdit*>(next);
        return other != nullptr ? new MixEdit{desk_, before_, other->after_} : nullptr;
    }

private:
    Desk& desk_;
    Mix before_, after_;
};

/// Does something to the world, and the opposite; a body that comes back has another name.
class Desk::WorldEdit final : public juce::UndoableAction {
public:
    WorldEdit(Desk& desk, Action action)
        : desk_{desk}
        , forth_{{std::move(action)}} {}
    bool perform() override { return run(forth_, back_); }
    bool undo() override { return run(back_, forth_); }
    int getSizeInUnits() override { return 1; }
    juce::UndoableAction* createCoalescedAction(juce::UndoableAction* next) override { // a sound that is turned
        const auto* other = dynamic_cast<WorldEdit*>(next);
        const auto *here = soundOf(this), *there = soundOf(other);
        if (here == nullptr || there == nullptr || here->material != there->material) return nullptr;
        auto* both = new WorldEdit{desk_, *there};
        both->back_ = back_;
        return both;
    }

private:
    static const SoundAction* soundOf(const WorldEdit* edit) {
        return edit != nullptr && edit->forth_.size() == 1 ? std::get_if<SoundAction>(&edit->forth_.front()) : nullptr;
    }
    bool run(const std::vector<Action>& actions, std::vector<Action>& opposite) {
        opposite.clear();
        for (const Action& wanted : actions) {
            const Action action = desk_.renamed(wanted);
            const auto back = desk_.undoOf(action);
            if (!desk_.act(action).empty()) return false;
            opposite.insert(opposite.begin(), back.begin(), back.end());
        }
        return true;
    }
    Desk& desk_;
    std::vector<Action> forth_, back_;
};

Desk::Desk(AudioDeviceTypes types, const DeviceChoice& device, Mix mix)
    : types_{std::move(types)}
    , mix_{std::move(mix)}
    , session_{setupOf(mix_, !device.board.empty())}
    , tap_{channels, 1 << 14}
    , output_{session_, types_}
    , undo_{1000, 30}
    , sceneNow_{*mix_.scene} {
    saved_.run = setupOf(mix_, false).run();
    saved_.panner = mix_.panner();
    mostEnchanters_ = mix_.count();
    tap_.hear(mix_.count());
    output_.listen(&tap_);
    open(device);
    postDifferences(mix_, true);
    edits_ = 0;
    if (!device.board.empty()) {
        link_ = std::make_unique<BoardLink>(device.board == anyBoard ? std::string{} : device.board);
        onBoard_ = std::make_unique<BoardOutput>(session_, output_, *link_, mix_.panner());
        boardReadyAtMs_ = nowMs();
    }
    driver_ = std::make_unique<ThreadDriver>(session_, stepsPerSecond);
}

Desk::~Desk() {
    driver_.reset();
    onBoard_.reset();
    output_.close();
}

void Desk::edit(const juce::String& name, const Mix& next, bool goesOn) {
    if (!goesOn || undo_.getCurrentTransactionName() != name) undo_.beginNewTransaction(name);
    undo_.perform(new MixEdit{*this, mix_, next});
}

void Desk::apply(const Mix& next) {
    const Mix before = std::exchange(mix_, next);
    ++edits_;
    mostEnchanters_ = std::max(mostEnchanters_, mix_.count());
    if (mix_.scene != before.scene || mix_.seed != before.seed) takeScene(mix_.scene == before.scene);
    tap_.hear(mix_.count());
    postDifferences(before, false);
    if (outputMap() != std::vector<int>{} && (before.count() != mix_.count() || !std::ranges::equal(before.strips, mix_.strips, {}, &Strip::output, &Strip::output)))
        if (const auto error = output_.assign(outputMap(), mix_.count()); !error.empty()) report(utf8Text(error));
    output_.setLevel(levelOf(mix_));
    sendChangeMessage();
}

// What the session plays by: as little as has changed.
void Desk::postDifferences(const Mix& before, bool all) {
    using Kind = RenderControl::Kind;
    if (!all && !isSame(before.panner(), mix_.panner())) {
        if (mix_.count() < before.count()) session_.post({0, Kind::stopAll, 0, 0.0f, {}}); // a channel may be another enchanter's now
        session_.post({0, Kind::panner, 0, 0.0f, mix_.panner()});
    }
    for (int j = 0; j < mix_.count(); ++j) {
        const auto i = static_cast<std::size_t>(j);
        const Strip strip = mix_.strips[i], old = !all && i < before.strips.size() ? before.strips[i] : Strip{};
        const bool isSilent = mix_.isSilent(j), wasSilent = !all && i < before.strips.size() && before.isSilent(j);
        if (channelGain(strip) != channelGain(old)) session_.post({0, Kind::gain, j, channelGain(strip), {}});
        if (strip.delayMs != old.delayMs) session_.post({0, Kind::delay, j, static_cast<float>(1e-3 * strip.delayMs), {}});
        if (strip.ceilingDb != old.ceilingDb) session_.post({0, Kind::ceiling, j, ceilingOf(strip), {}});
        if (isSilent != wasSilent) session_.post({0, Kind::mute, j, isSilent ? 1.0f : 0.0f, {}});
    }
}

std::vector<int> Desk::outputMap() const {
    std::vector<int> map;
    for (const Strip& strip : mix_.strips) map.push_back(strip.output);
    return map;
}

bool Desk::attach(double shareX, double shareY) {
    if (mix_.count() >= limits::maxEnchanters) return false;
    change("Attach an enchanter", [&](Mix& mix) {
        auto& layout = mix.layout;
        const auto label = [&layout](int n) { return describeLayout("", EnchanterLayout{1, 1, n + 1, {}}).enchanters.back().label; };
        int n = 0;
        while (std::ranges::any_of(layout.enchanters, [&](const auto& e) { return e.label == label(n); })) ++n;
        layout.name = "own";
        layout.enchanters.push_back({label(n), layout.enchanters.back().actuator, layout.enchanters.back().fullScaleG});
        layout.geometry.places[static_cast<std::size_t>(layout.geometry.count++)] = {shareX * layout.geometry.extentWidthMetres, shareY * layout.geometry.extentHeightMetres};
        mix.strips.push_back(mix.nextStrip());
        mix.strips.back().gainDb = newStripDb;
    });
    return true;
}

void Desk::detach(int enchanter) {
    if (mix_.count() < 2) return;
    change("Detach " + juce::String::fromUTF8(mix_.layout.enchanters[static_cast<std::size_t>(enchanter)].label.c_str()), [&](Mix& mix) {
        auto& layout = mix.layout;
        auto& places = layout.geometry.places;
        std::copy(places.begin() + enchanter + 1, places.begin() + layout.geometry.count, places.begin() + enchanter);
        --layout.geometry.count;
        layout.name = "own";
        layout.enchanters.erase(layout.enchanters.begin() + enchanter);
        mix.strips.erase(mix.strips.begin() + enchanter);
    });
}

std::string Desk::act(const Action& action) {
    const auto fault = session_.act(action);
    if (!fault.empty()) return fault;
    ++edits_;
    showEdit(action);
    return {};
}

void Desk::showEdit(const Action& action) {
    if (std::holds_alternative<SpawnAction>(action)) sceneNow_.inputs.push_back({0.0, action});
    else if (std::holds_alternative<MaterialAction>(action) || std::holds_alternative<SoundAction>(action) || std::holds_alternative<CameraAction>(action))
        describeEdit(sceneNow_, action);
    else return;
    ++worldEdits_;
    sendChangeMessage();
}

// A name is given once.
Action Desk::renamed(const Action& action) {
    Action named = action;
    if (auto* spawn = std::get_if<SpawnAction>(&named)) spawn->body.name = "added " + std::to_string(++added_);
    return named;
}

std::vector<Action> Desk::undoOf(const Action& action) const {
    const auto cast = sceneCast(sceneNow_);
    const auto body = [&cast](const std::string& name) { return std::ranges::find(cast, name, &BodyDescription::name); };
    if (const auto* spawn = std::get_if<SpawnAction>(&action)) return {RemoveAction{spawn->body.name}};
    if (const auto* removal = std::get_if<RemoveAction>(&action)) {
        const auto found = body(removal->body);
        std::vector<BodyPose> poses;
        session_.readPoses(poses);
        const auto index = static_cast<std::size_t>(found - cast.begin());
        if (found == cast.end() || index >= poses.size()) return {};
        BodyDescription back = *found;
        back.positionMetres = {poses[index].xMetres, poses[index].yMetres};
        back.angleRadians = poses[index].angleRadians;
        return {SpawnAction{back, {}}};
    }
    if (const auto* material = std::get_if<MaterialAction>(&action)) {
        const auto found = body(material->body);
        std::vector<Action> back;
        for (std::size_t i = 0; found != cast.end() && i < found->fixtures.size(); ++i) back.push_back(MaterialAction{material->body, static_cast<int>(i), found->fixtures[i].material});
        return back;
    }
    if (const auto* sound = std::get_if<SoundAction>(&action)) {
        const auto& old = sceneNow_.materials[static_cast<std::size_t>(sound->material)];
        return {SoundAction{sound->material, old.frequencyHz, old.decayPerSecond}};
    }
    return {};
}

std::string Desk::editWorld(const juce::String& name, const Action& action, bool goesOn) {
    Action trial = action;
    if (auto* spawn = std::get_if<SpawnAction>(&trial)) spawn->body.name = "added " + std::to_string(added_ + 1);
    Scene scene = sceneNow_;
    if (auto fault = InputCheck{scene}.take(trial); !fault.empty()) return fault;
    if (!goesOn || undo_.getCurrentTransactionName() != name) undo_.beginNewTransaction(name);
    undo_.perform(new WorldEdit{*this, action});
    return {};
}

const SavedSession& Desk::saved() {
    saved_.channels = mostEnchanters_;
    saved_.lengthNs = session_.status().sessionNs;
    session_.readLog(saved_.log);
    saved_.mix = mix_;
    return saved_;
}

std::string Desk::startRecording(const juce::File& file) {
    if (recording_) return {};
    if (output_.sampleRateHz() == 0) return "nothing to record: no device runs";
    auto recording = std::make_unique<Recording>(file.getFullPathName().toStdString(), mix_.count(), output_.sampleRateHz());
    if (!recording->error().empty()) return recording->error();
    recording_ = std::move(recording);
    recordingFile_ = file;
    isEnding_ = false;
    output_.record(&recording_->recorder());
    sendChangeMessage();
    return {};
}

void Desk::stopRecording() {
    if (!isRecording()) return;
    output_.record(nullptr);
    isEnding_ = true;
    endsAfterBlock_ = output_.status().blocks + 1;
    sendChangeMessage();
}

double Desk::recordedSeconds() const noexcept {
    return recording_ ? static_cast<double>(recording_->recorder().frames()) / recording_->recorder().sampleRateHz() : 0.0;
}

// R has let go of it when a block has come since; events of the last frames have been played by then.
void Desk::finishRecording() {
    recording_->drain();
    if (!isEnding_ && output_.isRecording()) return;
    if (isEnding_ && now_.device.isRunning && now_.device.blocks <= endsAfterBlock_) return;
    const Provenance provenance{PHYSVIB_VERSION, {{"scene", mix_.scene->name}, {"seed", std::to_string(mix_.seed)}}};
    recordedFrom_ = recording_->recorder().firstFrame();
    const auto lost = recording_->recorder().framesLost();
    auto error = utf8Text(recording_->finish(session_.playOutFrames(), provenance));
    if (error.isEmpty() && lost > 0) error = "frames missing in the recording: " + juce::String{static_cast<juce::int64>(lost)};
    if (error.isEmpty() && !isEnding_) error = "the recording ends where the device changed its rate";
    recording_.reset();
    if (onRecorded) onRecorded(recordingFile_, error);
    sendChangeMessage();
}

void Desk::restart(std::uint32_t seed) {
    if (seed != mix_.seed) return change("Seed", [seed](Mix& mix) { mix.seed = seed; });
    ++edits_;
    takeScene(true);
    sendChangeMessage();
}

// The world begins anew. What was measured or tuned stays, as the strips do.
void Desk::takeScene(bool keepsSounds) {
    auto scene = std::make_shared<Scene>(*mix_.scene);
    for (std::size_t i = 0; keepsSounds && i < scene->materials.size(); ++i) {
        scene->materials[i].frequencyHz = sceneNow_.materials[i].frequencyHz;
        scene->materials[i].decayPerSecond = sceneNow_.materials[i].decayPerSecond;
    }
    sceneNow_ = *scene;
    ++worldEdits_;
    if (const SessionState state{std::move(scene), mix_.seed}; state == session_.state()) session_.restart();
    else if (const auto fault = session_.setState(state); !fault.empty()) report(utf8Text(fault));
}

void Desk::setSlowness(int slowness) {
    session_.setSlowness(slowness);
    sendChangeMessage();
}

void Desk::strike(int enchanter, std::vector<CollisionEvent> strikes) {
    const auto& layout = mix_.layout.geometry;
    const auto& place = layout.places[static_cast<std::size_t>(enchanter)]; // there it is alone
    for (auto& s : strikes) {
        s.x = place.xMetres / layout.extentWidthMetres * mix_.scene->fieldWidthMetres;
        s.y = place.yMetres / layout.extentHeightMetres * mix_.scene->fieldHeightMetres;
    }
    ++edits_;
    session_.play(strikes);
}

std::string Desk::audition(int material, double shareX, double shareY) {
    const auto index = static_cast<std::size_t>(material);
    if (index >= sceneNow_.materials.size() || sceneNow_.materials[index].frequencyHz <= 0.0) return "expected a material that sounds";
    const Material& heard = sceneNow_.materials[index];
    CollisionEvent hit;
    hit.frequencyHz = heard.frequencyHz;
    hit.decayPerSecond = heard.decayPerSecond;
    hit.amplitude = strikeAmplitude;
    hit.x = shareX * sceneNow_.fieldWidthMetres;
    hit.y = shareY * sceneNow_.fieldHeightMetres;
    ++edits_;
    return session_.play({&hit, 1}) ? std::string{} : heard.name + ": cannot be played";
}

void Desk::testPulse(int enchanter) {
    CollisionEvent pulse;
    const auto profile = findActuator(mix_.layout.enchanters[static_cast<std::size_t>(enchanter)].actuator);
    pulse.frequencyHz = profile && profile.value.resonanceHz ? *profile.value.resonanceHz : 205.0; // where the thesis' actuators are strongest
    pulse.decayPerSecond = 30.0;
    pulse.amplitude = strikeAmplitude;
    strike(enchanter, {pulse});
}

void Desk::testSweep(int enchanter) {
    std::vector<CollisionEvent> tones;
    constexpr int count = 40;
    for (int k = 0; k < count; ++k) {
        CollisionEvent tone;
        tone.timeNs = k * std::int64_t{60'000'000};
        tone.durationNs = 60'000'000;
        tone.frequencyHz = 40.0 * std::pow(10.0, static_cast<double>(k) / (count - 1)); // 40 to 400 Hz: what is felt
        tone.amplitude = 0.3;
        tones.push_back(tone);
    }
    strike(enchanter, std::move(tones));
}

std::string Desk::open(const DeviceChoice& device) {
    AudioOutputSettings settings{device.name, outputMap(), device.sampleRateHz, device.blockFrames, levelOf(mix_), mix_.count(), true, listening_};
    const auto error = output_.open(settings);
    device_ = device;
    report(deviceTrouble_ = utf8Text(error));
    scope_.setRate(output_.sampleRateHz());
    spectrum_.setRate(output_.sampleRateHz());
    return error;
}

std::string Desk::hear(const ListeningSettings& listening) {
    auto error = output_.hear(listening);
    if (error.empty()) listening_ = listening;
    return error;
}

juce::String Desk::outputTrouble() {
    const auto device = utf8Text(output_.maintain()), board = boardTrouble();
    return device.isEmpty() || board.isEmpty() ? device + board : device + "; " + board;
}

// Without a port of its own the link tries one after the other: what it says of each would only flicker.
juce::String Desk::boardTrouble() {
    const auto status = board();
    if (!status) return {};
    if (status->state == BoardLinkStatus::State::ready) {
        boardReadyAtMs_ = nowMs();
        if (status->playOutMs <= 1e3 * boardSeconds) return {};
        return "The board needs its strikes " + juce::String{status->playOutMs, 0} + " ms before they are felt; the session allows for " + juce::String{1e3 * boardSeconds, 0};
    }
    if (nowMs() - boardReadyAtMs_ < boardPatienceMs && status->connections == 0) return {};
    if (device_.board == anyBoard) return status->connections > 0 ? "The board is gone; it is looked for on every serial port" : "No board answers on any serial port";
    return "The board at " + utf8Text(device_.board) + (status->connections > 0 ? " is gone" : " does not answer") + "; it is looked for twice a second";
}

void Desk::setSilent(bool silent) {
    isSilent_ = silent;
    output_.setSilent(silent);
    sendChangeMessage();
}

double Desk::playOutSeconds() const noexcept {
    return output_.sampleRateHz() > 0 ? static_cast<double>(session_.playOutFrames()) / output_.sampleRateHz() : 0.0;
}

void Desk::report(const juce::String& trouble) {
    if (trouble == trouble_ && !isNews_) return;
    trouble_ = trouble;
    isNews_ = false;
    sendChangeMessage();
}

void Desk::tell(const juce::String& news) {
    trouble_ = news;
    isNews_ = true;
    sendChangeMessage();
}

void Desk::measure(const float* const* block, int frames) {
    const int heard = mix_.count();
    scope_.add(block, heard, frames);
    spectrum_.add(block, heard, frames);
    for (int j = 0; j < heard; ++j) {
        const auto range = juce::FloatVectorOperations::findMinAndMax(block[j], frames);
        const float peak = std::max(-range.getStart(), range.getEnd());
        auto& shown = now_.meters.peaks[static_cast<std::size_t>(j)];
        shown = std::max(shown, peak);
    }
}

DeskMoment Desk::look() {
    const double now = nowMs(), passed = std::min(1000.0, now - lookedAtMs_);
    lookedAtMs_ = now;
    const auto fall = static_cast<float>(std::pow(10.0, -meterFallDbPerSecond * passed / 20'000.0));
    for (auto& peak : now_.meters.peaks) peak = peak * fall < 1e-4f ? 0.0f : peak * fall;
    tap_.read([this](const float* const* block, int frames) { measure(block, frames); });
    now_.session = session_.status();
    now_.device = output_.status();
    now_.hits.clear();
    for (PlayedEvent played; session_.played().pop(played);) {
        now_.hits.push_back(played.event);
        recent_.push_front(played.event);
        if (recording_) recording_->take(played);
    }
    if (recent_.size() > mostRecent) recent_.resize(mostRecent);
    if (recording_) finishRecording();
    now_.meters.limiterGain = now_.session.render.limiterGain;
    now_.meters.enchanters = mix_.count();
    float loudest = 0.0f;
    for (std::size_t j = 0; j < static_cast<std::size_t>(mix_.count()); ++j) {
        const float peak = now_.meters.peaks[j];
        now_.meters.isConnected[j] = mix_.strips[j].output >= 0;
        if (peak >= now_.holds[j] || now - heldAtMs_[j] > holdMs) now_.holds[j] = peak, heldAtMs_[j] = now;
        loudest = std::max(loudest, peak);
    }
    now_.masterPeak = isSilent_ ? 0.0f : loudest * levelOf(mix_);
    now_.sessionNs = session_.readPoses(now_.poses);
    now_.aheadNs = static_cast<std::int64_t>(1e9 * playOutSeconds());
    if (now - maintainedAtMs_ > maintainMs) {
        maintainedAtMs_ = now;
        if (const auto trouble = outputTrouble(); trouble != deviceTrouble_) report(deviceTrouble_ = trouble);
    }
    return now_;
}

} // namespace physvib

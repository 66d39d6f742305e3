// SPDX-License-Identifier: GPL-3.0-or-later
// Applies messages to the displayed state, posts events at an actuator or a place, and reads clips.
#include "Mixer/Model/MixerInputs.h"
#include "Core/Samples.h"
#include "Core/Units.h"
#include "Live/Recordings/LoadRecordings.h"
#include "Mixer/Model/MixerModel.h"
#include "Scene/ActuatorFile.h"
#include <numbers>

namespace physvib {
namespace {

double stripDb(float gain) {
    return gain == 0.0f
               ? leastStripDb
               : std::clamp(toDecibels(std::abs(static_cast<double>(gain))), leastStripDb, mostStripDb);
}

constexpr std::size_t maxWaiting = 1000; // reached only if the message thread hangs
constexpr int reportMilliseconds = 10;

OscSettings settingsOf(const OscChoice& choice) {
    OscSettings settings;
    settings.address = choice.use == OscUse::anyComputer ? oscAnyComputer : oscThisComputer;
    if (choice.use != OscUse::off) settings.port = oscUsualPort;
    settings.receiver = choice.receiver;
    settings.turnRadians = choice.turnDegrees * std::numbers::pi / 180.0;
    return settings;
}

constexpr double strikeAmplitude = 0.5; // of pulses and auditions, before strip, ceiling and master

} // namespace

std::vector<std::string> ownAddresses() {
    std::vector<std::string> all;
    for (const auto& address : juce::IPAddress::getAllAddresses(false))
        if (const auto words = address.toString().toStdString();
            !words.starts_with("127.") && !words.starts_with("0."))
            all.push_back(words);
    return all;
}

std::string MixerInputs::use(const OscChoice& choice) {
    const OscChoice before = std::exchange(choice_, choice);
    std::string error = open();
    if (error.empty()) return error;
    choice_ = before;
    if (!open().empty()) choice_ = {};
    return error;
}

// Closes the open port first, because it may be the one to be opened.
std::string MixerInputs::open() {
    close();
    if (choice_.use == OscUse::off && choice_.receiver.empty()) return {};
    messages_.emplace(model_.session());
    port_ = std::make_unique<OscPort>(
        settingsOf(choice_), model_.session(), *messages_, model_.output(),
        OscHooks{[this](const LineInput& input, const OscOrigin& origin) { return receive(input, origin); },
                 [this] { return std::string{model_.output().isLent() ? "a study is running" : ""}; }});
    std::string error = port_->error();
    if (!error.empty())
        close();
    else if (!choice_.receiver.empty())
        startTimer(reportMilliseconds);
    return error;
}

void MixerInputs::close() {
    stopTimer();
    port_.reset(); // after this no thread triggers an update
    cancelPendingUpdate();
    waiting_.clear();
    come_ = refused_ = 0;
    fault_.clear();
}

void MixerInputs::timerCallback() { model_.collectPlayed(); }

bool MixerInputs::haveCome() {
    if (!port_) return false;
    const std::uint64_t messages = port_->status().counts.messages;
    return std::exchange(come_, messages) != messages;
}

std::string MixerInputs::apply(const LineInput& input) {
    if (const auto* action = std::get_if<Action>(&input)) return model_.world().act(*action);
    if (const auto* control = std::get_if<OwnedControl>(&input)) return apply(*control);
    if (const auto* silence = std::get_if<SilenceControl>(&input)) {
        std::string fault = takeSilence(model_.output().silence(), *silence, MuteRequester::osc);
        model_.showSilence();
        return fault;
    }
    return {};
}

std::string MixerInputs::apply(const RenderControl& control) {
    using Kind = RenderControl::Kind;
    const auto strip = static_cast<std::size_t>(control.channel);
    if (control.channel < 0 || control.channel >= model_.mix().count())
        return "expected a channel from 1 to " + std::to_string(model_.mix().count()) + ", found " +
               std::to_string(control.channel + 1);
    if (control.kind != Kind::gain && control.kind != Kind::mute)
        return "expected gain, mute or silence; the rest is set at the desk";
    model_.change(
        "Strips by message",
        [&](Mix& mix) {
            if (control.kind == Kind::mute)
                mix.strips[strip].isMuted = control.value != 0.0f;
            else
                mix.strips[strip].gainDb = stripDb(control.value),
                mix.strips[strip].isInverted = control.value < 0.0f;
        },
        true);
    return {};
}

// Silence takes effect at once; the message thread only displays it. On the port's thread.
std::string MixerInputs::receive(const LineInput& input, const OscOrigin& origin) {
    const auto* silence = std::get_if<SilenceControl>(&input);
    const bool isDone = silence != nullptr && silence->isOn;
    if (isDone) takeSilence(model_.output().silence(), *silence, MuteRequester::osc);
    const std::lock_guard lock{mutex_};
    if (waiting_.size() == maxWaiting) return isDone ? "" : "too many inputs at once";
    waiting_.push_back({input, origin});
    triggerAsyncUpdate();
    return {};
}

void MixerInputs::handleAsyncUpdate() {
    std::vector<Waiting> inputs;
    {
        const std::lock_guard lock{mutex_};
        inputs.swap(waiting_);
    }
    for (const Waiting& one : inputs) {
        const std::string fault = apply(one.input);
        if (fault.empty()) continue;
        port_->refuse(one.origin, fault);
        fault_ = fault;
        ++refused_;
    }
}

std::optional<OscStatus> MixerInputs::status() const {
    if (!port_) return {};
    OscStatus status = port_->status();
    status.counts.refused += refused_;
    if (status.counts.fault.empty()) status.counts.fault = fault_;
    return status;
}

MixerStrikes::MixerStrikes(Session& session, const AudioOutput& output, const Mix& mix,
                           const MixerWorld& world, std::function<void()> onStrike,
                           std::function<void(const Result<std::string>&)> onClip)
    : session_{session}
    , output_{output}
    , mix_{mix}
    , world_{world}
    , onStrike_{std::move(onStrike)}
    , onClip_{std::move(onClip)}
    , messages_{session} {}

MixerStrikes::~MixerStrikes() {
    constexpr int untilItHasBeenRead = -1;
    reader_.removeAllJobs(false, untilItHasBeenRead); // after this no thread triggers an update
    cancelPendingUpdate();
}

EnchanterPlace MixerStrikes::onField(double shareX, double shareY) const {
    return {shareX * world_.scene().fieldWidthMetres, shareY * world_.scene().fieldHeightMetres};
}

// Place on the field at which only this actuator plays.
EnchanterPlace MixerStrikes::placeOf(int enchanter) const {
    const auto& layout = mix_.layout.geometry;
    const auto& place = nth(layout.places, enchanter);
    const double wide = mix_.scene->fieldWidthMetres;
    return {place.xMetres / layout.extentWidthMetres * wide,
            place.yMetres / layout.extentHeightMetres * mix_.scene->fieldHeightMetres,
            place.zMetres / layout.extentWidthMetres * wide};
}

bool MixerStrikes::strike(std::vector<CollisionEvent> strikes, const EnchanterPlace& at) {
    for (auto& s : strikes) {
        s.x = at.xMetres;
        s.y = at.yMetres;
        s.z = at.zMetres;
    }
    const bool isStruck{session_.submit({Strikes{strikes}})};
    onStrike_();
    return isStruck;
}

std::string MixerStrikes::audition(int material, double shareX, double shareY) {
    const auto index = static_cast<std::size_t>(material);
    const auto& materials = world_.scene().materials;
    if (index >= materials.size() || materials[index].frequencyHz <= 0.0)
        return "expected a material that sounds";
    const Material& sound = materials[index];
    CollisionEvent hit;
    hit.frequencyHz = sound.frequencyHz;
    hit.decayPerSecond = sound.decayPerSecond;
    hit.amplitude = strikeAmplitude;
    return strike({hit}, onField(shareX, shareY)) ? std::string{} : sound.name + ": cannot be played";
}

void MixerStrikes::testPulse(int enchanter) {
    CollisionEvent pulse;
    const auto profile = findActuator(nth(mix_.layout.enchanters, enchanter).actuator);
    // resonance of the thesis' actuators
    pulse.frequencyHz = profile && profile.value.resonanceHz ? *profile.value.resonanceHz : 205.0;
    pulse.decayPerSecond = 30.0;
    pulse.amplitude = strikeAmplitude;
    strike({pulse}, placeOf(enchanter));
}

void MixerStrikes::testSweep(int enchanter) {
    std::vector<CollisionEvent> tones;
    constexpr int count = 40;
    for (int k = 0; k < count; ++k) {
        CollisionEvent tone;
        tone.timeNs = k * std::int64_t{60'000'000};
        // 40 to 400 Hz, the main range of vibration perception
        tone.frequencyHz = 40.0 * std::pow(10.0, static_cast<double>(k) / (count - 1));
        tone.durationNs = softEndNs(tone.frequencyHz, 60'000'000);
        tone.amplitude = 0.3;
        tones.push_back(tone);
    }
    strike(std::move(tones), placeOf(enchanter));
}

void MixerStrikes::feel(const juce::StringArray& files, const EnchanterPlace& at, bool isAlone) {
    if (files.size() != 1)
        return onClip_(Failure{"Expected one clip, found " + std::to_string(files.size()) + " files"});
    PlainMessage clip{
        "clip", {{"file", pathOf(juce::File{files[0]})}, {"place", std::vector{at.xMetres, at.yMetres}}}};
    if (isAlone) clip.values.push_back({"law", std::string{nameOf(Spread::alone)}});
    read(std::move(clip));
}

bool isClipDrag(const juce::StringArray& files) {
    return !files.isEmpty() && !files[0].endsWithIgnoreCase(".json");
}

// A clip that has no note of its own is reported with this one.
void MixerStrikes::read(PlainMessage clip, std::string said) {
    reader_.addJob([this, clip = std::move(clip), said = std::move(said)] {
        auto result = strike(clip);
        if (result && !said.empty()) result.value = said;
        const std::lock_guard lock{mutex_};
        results_.push_back(std::move(result));
        triggerAsyncUpdate();
    });
}

// Runs on the reader's thread.
Result<std::string> MixerStrikes::strike(const PlainMessage& clip) {
    const auto unlessLent = [this](const std::string& path) { // a study may have borrowed it meanwhile
        return output_.isLent() ? Result<LoadedClip>{Failure{"a study is running"}} : loadWholeClip(path);
    };
    const auto result = messages_.take(clip, nullptr, unlessLent);
    if (!result) return Failure{result.error};
    // a note, if there is one
    return result.value.values.empty() ? std::string{}
                                       : std::get<std::string>(result.value.values.front().value);
}

void MixerStrikes::handleAsyncUpdate() {
    std::vector<Result<std::string>> results;
    {
        const std::lock_guard lock{mutex_};
        results.swap(results_);
    }
    for (const auto& result : results) onClip_(result);
}

} // namespace physvib

// SPDX-License-Identifier: GPL-3.0-or-later
// Opens the OSC port, applies its messages to the mixer state, and plays test events and clips.
#include "Mixer/Model/MixerInputs.h"
#include "Core/Samples.h"
#include "Core/Units.h"
#include "Live/Recordings/LoadRecordings.h"
#include "Mixer/Model/MixerModel.h"
#include "Scene/ActuatorFile.h"
#include <numbers>

namespace physvib {
namespace {

double faderDbFromGain(float gain) {
    return gain == 0.0f ? minStripDb
                        : std::clamp(toDecibels(std::abs(static_cast<double>(gain))), minStripDb, maxStripDb);
}

constexpr std::size_t maxPendingInputs = 1000; // reached only if the message thread hangs
constexpr int reportIntervalMs = 10;

OscSettings toOscSettings(const OscChoice& choice) {
    OscSettings settings;
    settings.address = choice.access == OscAccess::anyComputer ? oscAnyAddress : oscLoopbackAddress;
    if (choice.access != OscAccess::off) settings.port = oscDefaultPort;
    settings.receiver = choice.receiver;
    settings.phoneAngleRadians = choice.phoneTurnDegrees * std::numbers::pi / 180.0;
    return settings;
}

constexpr double testAmplitude = 0.5; // share of full scale of a pulse or audition, before the strip

} // namespace

std::vector<std::string> localAddresses() {
    std::vector<std::string> addresses;
    for (const auto& address : juce::IPAddress::getAllAddresses(false))
        if (const auto text = address.toString().toStdString();
            !text.starts_with("127.") && !text.starts_with("0."))
            addresses.push_back(text);
    return addresses;
}

std::string MixerInputs::configure(const OscChoice& choice) {
    const OscChoice oldChoice = std::exchange(choice_, choice);
    std::string error = open();
    if (error.empty()) return error;
    choice_ = oldChoice;
    if (!open().empty()) choice_ = {};
    return error;
}

// Closes the open port first, because it may be the one to be opened.
std::string MixerInputs::open() {
    close();
    if (choice_.access == OscAccess::off && choice_.receiver.empty()) return {};
    messages_.emplace(model_.session());
    port_ = std::make_unique<OscPort>(
        toOscSettings(choice_), model_.session(), *messages_, model_.output(),
        OscHooks{
            [this](const LineInput& input, const OscOrigin& origin) { return receive(input, origin); },
            [this] { return std::string{model_.output().isPlayingBorrowed() ? "a study is running" : ""}; }});
    std::string error = port_->error();
    if (!error.empty())
        close();
    else if (!choice_.receiver.empty())
        startTimer(reportIntervalMs);
    return error;
}

void MixerInputs::close() {
    stopTimer();
    port_.reset(); // after this no thread triggers an update
    cancelPendingUpdate();
    pendingInputs_.clear();
    lastMessageCount_ = refusedCount_ = 0;
    lastError_.clear();
}

void MixerInputs::timerCallback() { model_.collectPlayed(); }

bool MixerInputs::hasNewMessages() {
    if (!port_) return false;
    const std::uint64_t messages = port_->status().counts.messages;
    return std::exchange(lastMessageCount_, messages) != messages;
}

std::string MixerInputs::apply(const LineInput& input) {
    if (const auto* action = std::get_if<Action>(&input)) return model_.world().apply(*action);
    if (const auto* control = std::get_if<OwnedControl>(&input)) return apply(*control);
    if (const auto* silence = std::get_if<SilenceControl>(&input)) {
        std::string error = applySilence(model_.output().silence(), *silence, MuteRequester::osc);
        model_.showSilence();
        return error;
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
    model_.changeByMessage([&](Mix& mix) {
        if (strip >= mix.strips.size()) return; // the actuator came later
        if (control.kind == Kind::mute)
            mix.strips[strip].isMuted = control.value != 0.0f;
        else
            mix.strips[strip].gainDb = faderDbFromGain(control.value),
            mix.strips[strip].isInverted = control.value < 0.0f;
    });
    return {};
}

// Runs on the port's thread. Silence takes effect at once; the message thread only displays it.
std::string MixerInputs::receive(const LineInput& input, const OscOrigin& origin) {
    const auto* silence = std::get_if<SilenceControl>(&input);
    const bool isSilenced = silence != nullptr && silence->isOn;
    if (isSilenced) applySilence(model_.output().silence(), *silence, MuteRequester::osc);
    const std::lock_guard lock{mutex_};
    if (pendingInputs_.size() == maxPendingInputs) return isSilenced ? "" : "too many inputs at once";
    pendingInputs_.push_back({input, origin});
    triggerAsyncUpdate();
    return {};
}

void MixerInputs::handleAsyncUpdate() {
    std::vector<PendingInput> inputs;
    {
        const std::lock_guard lock{mutex_};
        inputs.swap(pendingInputs_);
    }
    for (const PendingInput& pending : inputs) {
        const std::string error = apply(pending.input);
        if (error.empty()) continue;
        port_->refuse(pending.origin, error);
        lastError_ = error;
        ++refusedCount_;
    }
}

std::optional<OscStatus> MixerInputs::status() const {
    if (!port_) return {};
    OscStatus status = port_->status();
    status.counts.refused += refusedCount_;
    if (status.counts.lastError.empty()) status.counts.lastError = lastError_;
    return status;
}

MixerEventPlayer::MixerEventPlayer(Session& session, const AudioOutput& output, const Mix& mix,
                                   const MixerWorld& world, std::function<void()> onEvent,
                                   std::function<void(const Result<std::string>&)> onClip)
    : session_{session}
    , output_{output}
    , mix_{mix}
    , world_{world}
    , onEvent_{std::move(onEvent)}
    , onClip_{std::move(onClip)}
    , messages_{session} {}

MixerEventPlayer::~MixerEventPlayer() {
    constexpr int noTimeoutMs = -1;
    reader_.removeAllJobs(false, noTimeoutMs); // after this no thread triggers an update
    cancelPendingUpdate();
}

ActuatorPlace MixerEventPlayer::fieldPosition(double shareX, double shareY) const {
    return {shareX * world_.scene().fieldWidthMetres, shareY * world_.scene().fieldHeightMetres};
}

// The actuator's place scaled to the field; an event there is played by it alone.
ActuatorPlace MixerEventPlayer::actuatorPosition(int actuator) const {
    const auto& layout = mix_.layout.geometry;
    const auto& place = nth(layout.places, actuator);
    const double fieldWidthMetres = mix_.scene->fieldWidthMetres;
    return {place.xMetres / layout.extentWidthMetres * fieldWidthMetres,
            place.yMetres / layout.extentHeightMetres * mix_.scene->fieldHeightMetres,
            place.zMetres / layout.extentWidthMetres * fieldWidthMetres};
}

bool MixerEventPlayer::playEvents(std::vector<CollisionEvent> events, const ActuatorPlace& place) {
    for (auto& event : events) {
        event.x = place.xMetres;
        event.y = place.yMetres;
        event.z = place.zMetres;
    }
    const bool isAccepted{session_.submit({Strikes{events}})};
    onEvent_();
    return isAccepted;
}

std::string MixerEventPlayer::audition(int material, double shareX, double shareY) {
    const auto index = static_cast<std::size_t>(material);
    const auto& materials = world_.scene().materials;
    if (index >= materials.size() || materials[index].frequencyHz <= 0.0)
        return "expected a material that sounds";
    const Material& sound = materials[index];
    CollisionEvent hit;
    hit.frequencyHz = sound.frequencyHz;
    hit.decayPerSecond = sound.decayPerSecond;
    hit.amplitude = testAmplitude;
    return playEvents({hit}, fieldPosition(shareX, shareY)) ? std::string{}
                                                            : sound.name + ": cannot be played";
}

void MixerEventPlayer::testPulse(int actuator) {
    CollisionEvent pulse;
    const auto profile = findActuator(nth(mix_.layout.actuators, actuator).actuator);
    // actuators without a profile get the resonance of those in the thesis
    pulse.frequencyHz = profile && profile.value.resonanceHz ? *profile.value.resonanceHz : 205.0;
    pulse.decayPerSecond = 30.0;
    pulse.amplitude = testAmplitude;
    playEvents({pulse}, actuatorPosition(actuator));
}

void MixerEventPlayer::testSweep(int actuator) {
    std::vector<CollisionEvent> tones;
    constexpr int toneCount = 40;
    for (int k = 0; k < toneCount; ++k) {
        CollisionEvent tone;
        tone.timeNs = k * std::int64_t{60'000'000};
        // 40 to 400 Hz, the main range of vibration perception
        tone.frequencyHz = 40.0 * std::pow(10.0, static_cast<double>(k) / (toneCount - 1));
        tone.durationNs = toneEndNs(tone.frequencyHz, 60'000'000);
        tone.amplitude = 0.3;
        tones.push_back(tone);
    }
    playEvents(std::move(tones), actuatorPosition(actuator));
}

void MixerEventPlayer::playClipFile(const juce::StringArray& files, const ActuatorPlace& place,
                                    bool isSingleActuator) {
    if (files.size() != 1)
        return onClip_(Failure{"Expected one clip, found " + std::to_string(files.size()) + " files"});
    PlainMessage clip{
        "clip",
        {{"file", pathOf(juce::File{files[0]})}, {"place", std::vector{place.xMetres, place.yMetres}}}};
    if (isSingleActuator) clip.values.push_back({"law", std::string{nameOf(Spread::nearest)}});
    queueClip(std::move(clip));
}

bool isClipDrag(const juce::StringArray& files) {
    return !files.isEmpty() && !files[0].endsWithIgnoreCase(".json");
}

// If `note` is not empty, it is reported instead of the note of the clip.
void MixerEventPlayer::queueClip(PlainMessage clip, std::string note) {
    reader_.addJob([this, clip = std::move(clip), note = std::move(note)] {
        auto result = playClip(clip);
        if (result && !note.empty()) result.value = note;
        const std::lock_guard lock{mutex_};
        results_.push_back(std::move(result));
        triggerAsyncUpdate();
    });
}

// Runs on the reader's thread.
Result<std::string> MixerEventPlayer::playClip(const PlainMessage& clip) {
    const auto loadClip = [this](const std::string& path) { // a study may have borrowed it meanwhile
        return output_.isPlayingBorrowed() ? Result<LoadedClip>{Failure{"a study is running"}}
                                           : loadWholeClip(path);
    };
    const auto result = messages_.handle(clip, nullptr, loadClip);
    if (!result) return Failure{result.error};
    // the answer has at most one value, a note
    return result.value.values.empty() ? std::string{}
                                       : std::get<std::string>(result.value.values.front().value);
}

void MixerEventPlayer::handleAsyncUpdate() {
    std::vector<Result<std::string>> results;
    {
        const std::lock_guard lock{mutex_};
        results.swap(results_);
    }
    for (const auto& result : results) onClip_(result);
}

} // namespace physvib

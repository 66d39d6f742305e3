// SPDX-License-Identifier: GPL-3.0-or-later
// Opening, keeping and feeding a device.
#include "Host/Devices/AudioOutput.h"
#include <algorithm>
#include <cmath>
#include <thread>

namespace physvib {

namespace {

constexpr double fadeInSeconds = 0.005;
constexpr double noiseFadeSeconds = 2.0; // to full scale; nobody shall start

} // namespace

AudioOutput::AudioOutput(Session& session, AudioDeviceTypes types, const std::atomic<bool>* isEnded)
    : own_{session}
    , played_{&session}
    , types_{std::move(types)}
    , isEnded_{isEnded} {}

AudioOutput::~AudioOutput() { close(); }

std::string AudioOutput::open(const AudioOutputSettings& settings) {
    close();
    if (auto error = map_.want(own_.channels(), settings.channelMap, settings.enchanters, settings.listening.outputs()); !error.empty()) return error;
    settings_ = settings;
    setLevel(settings.level);
    setHeardLevels();
    return openDevice();
}

std::string AudioOutput::assign(const std::vector<int>& channelMap, int enchanters) { return remap(channelMap, enchanters, settings_.listening); }

std::string AudioOutput::hear(const ListeningSettings& listening) { return remap(settings_.channelMap, settings_.enchanters, listening); }

std::string AudioOutput::remap(const std::vector<int>& channelMap, int enchanters, const ListeningSettings& listening) {
    if (auto error = map_.want(own_.channels(), channelMap, enchanters, listening.outputs()); !error.empty()) return error;
    const AudioOutputSettings before = settings_;
    settings_.channelMap = channelMap;
    settings_.enchanters = enchanters;
    settings_.listening = listening;
    if (auto error = listeningFault(); !error.empty()) {
        settings_ = before;
        map_.want(own_.channels(), before.channelMap, before.enchanters, before.listening.outputs());
        return error;
    }
    setHeardLevels();
    if (!found_.device || !running_) return {};
    if (settings_.opensAll) map_.place(found_.device->getActiveOutputChannels());
    else stopDevice(), void(openDevice());
    return {};
}

// The noise's generator has a level of its own.
void AudioOutput::setHeardLevels() {
    const ListeningSettings& l = settings_.listening;
    const auto gainOf = [](double db, double leastDb, double mostDb) { return std::pow(10.0, std::clamp(db, leastDb, mostDb) / 20.0); };
    noiseGain_ = l.noise.empty() ? 0.0f : static_cast<float>(gainOf(l.noiseDb, PinkNoise::leastDb, PinkNoise::mostDb) / PinkNoise::rootMeanSquare);
    contactGain_ = l.contacts.empty() ? 0.0f : static_cast<float>(gainOf(l.contactDb, leastContactDb, mostContactDb));
}

// Unlike an enchanter without an output, which is felt as missing, noise that is missing would go unnoticed.
std::string AudioOutput::listeningFault() const {
    if (!settings_.listening.contacts.empty() && own_.heardChannels() == 0) return "expected a session that makes contact sounds, found none";
    if (!settings_.listening.marks.empty() && !own_.marks()) return "expected a session that marks its onsets, found none";
    if (!found_.device || map_.highestHeard() < deviceOutputs()) return {};
    return settings_.device + ": has " + std::to_string(deviceOutputs()) + " outputs; expected one of them to listen to or for marks, found output " + std::to_string(map_.highestHeard() + 1);
}

std::string AudioOutput::inputFault() const {
    if (!found_.device || settings_.inputs.empty()) return {};
    const int inputs = found_.device->getInputChannelNames().size(), wanted = std::ranges::max(settings_.inputs);
    return wanted < inputs ? "" : settings_.device + ": has " + std::to_string(inputs) + " inputs; expected one of them, found input " + std::to_string(wanted + 1);
}

std::string AudioOutput::openDevice() {
    found_ = findAudioDevice(types_, settings_.device, !settings_.inputs.empty());
    if (!found_.device) return settings_.device + ": no such device (see physvib devices); nothing else is played on";
    auto error = listeningFault();
    if (error.empty()) error = inputFault();
    if (error.empty()) error = startDevice();
    if (error.empty()) settings_.device = found_.fullName(); // this one from now on, also where another driver knows its name
    else stopDevice();
    return error;
}

std::string AudioOutput::startDevice() {
    auto& device = *found_.device;
    const int offered = device.getOutputChannelNames().size();
    auto outputs = map_.outputs(offered);
    if (settings_.opensAll) outputs.setRange(0, offered, true);
    if (outputs.isZero()) return settings_.device + ": has none of the outputs that are wanted";
    juce::BigInteger inputs;
    for (const int k : settings_.inputs) inputs.setBit(k);
    const auto error = device.open(inputs, outputs, settings_.sampleRateHz > 0 ? settings_.sampleRateHz : device.getCurrentSampleRate(),
                                   settings_.blockFrames > 0 ? settings_.blockFrames : device.getDefaultBufferSize());
    if (error.isNotEmpty()) return settings_.device + ": " + error.toStdString();
    largestBlock_ = 0;
    device.start(this);
    if (running_) return {};
    const int rate = juce::roundToInt(device.getCurrentSampleRate());
    return settings_.device + (isSampleRate(rate) ? ": the device does not start" : ": runs at " + std::to_string(rate) + " Hz; expected 5000 to 192000");
}

void AudioOutput::stopDevice() {
    if (found_.device) found_.device->stop();
    found_.device.reset(); // before its driver
    found_.type.reset();
    running_ = false;
}

// A device that calls no more is not waited for.
void AudioOutput::fadeOut() {
    if (!running_ || !found_.device) return;
    ending_ = true;
    const auto blocks = status().blocks + 2; // one may have begun before
    const auto end = Clock::now() + std::chrono::milliseconds{10} + std::chrono::milliseconds{3000 * block_ / rate_};
    while (running_ && status().blocks < blocks && Clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds{1});
}

bool AudioOutput::lend(Session* other) {
    if (rate_ == 0) return false;
    if (other != nullptr) other->prepare(rate_, block_);
    else if (played_.load() != &own_ && (lentRate_ != rate_ || lentBlock_ != block_)) own_.resume(rate_, block_);
    if (played_.load() == &own_) lentRate_ = rate_, lentBlock_ = block_;
    played_.store(other != nullptr ? other : &own_);
    while (isInBlock_.load()) std::this_thread::sleep_for(std::chrono::milliseconds{1}); // a block at most
    return true;
}

void AudioOutput::close() {
    fadeOut();
    stopDevice();
    settings_.device.clear();
}

std::string AudioOutput::maintain(Clock::time_point now) {
    if (settings_.device.empty()) return {};
    if (hasGone(now)) {
        stopDevice();
        if (auto error = openDevice(); !error.empty()) return error;
        ++losses_;
        seenAt_ = now;
    }
    if (std::min(largestBlock_.load(), limits::maxBlockFrames) > block_) { // L has to cover the new block
        found_.device->stop();
        found_.device->start(this);
    }
    return unfelt();
}

// Some drivers say so; JUCE's ALSA thread just ends.
bool AudioOutput::hasGone(Clock::time_point now) {
    if (!found_.device || !found_.device->isOpen() || !running_) return true;
    const auto blocks = load_.read().blocks;
    const bool isIdle = found_.device->getActiveOutputChannels().isZero(); // nothing is connected, so nothing is called for
    if (blocks != seenBlocks_ || isIdle || seenAt_ == Clock::time_point{}) seenAt_ = now;
    seenBlocks_ = blocks;
    return now - seenAt_ > patience;
}

std::string AudioOutput::unfelt() const {
    if (map_.unfelt() == 0) return {};
    return settings_.device + ": " + std::to_string(map_.unfelt()) + " of " + std::to_string(map_.enchanters()) + " enchanters have no output there";
}

void AudioOutput::audioDeviceAboutToStart(juce::AudioIODevice* device) {
    const int rate = juce::roundToInt(device->getCurrentSampleRate());
    const int block = std::min(std::max(device->getCurrentBufferSizeSamples(), largestBlock_.load()), limits::maxBlockFrames);
    if (!isSampleRate(rate) || block < 1) return; // stays silent
    Session& session = *played_.load();
    if (rate_ == 0) session.prepare(rate, block);
    else if (rate != rate_ || block != block_) session.resume(rate, block);
    if (auto* recorder = recorder_.load(std::memory_order_relaxed); recorder && recorder->sampleRateHz() != rate) recorder_ = nullptr;
    rate_ = rate;
    latencyNs_ = std::int64_t{1'000'000'000} * device->getOutputLatencyInSamples() / rate;
    prepareBuffers(block);
    exposure_.prepare(rate);
    motors_.clear();
    for (const int j : settings_.onOff) motors_.push_back({static_cast<std::size_t>(j), OnOffSteps{rate, settings_.onOffThreshold}});
    map_.place(device->getActiveOutputChannels());
    map_.settle(rate);
    ending_ = false;
    master_.prepare(rate, fadeInSeconds, 0.0f);
    noiseRamp_.prepare(rate, noiseFadeSeconds, 0.0f);
    contactRamp_.prepare(rate, fadeInSeconds, 0.0f);
    running_ = true;
}

void AudioOutput::prepareBuffers(int block) {
    block_ = block;
    noiseScratch_.assign(static_cast<std::size_t>(block), 0.0f);
    scratch_.assign(static_cast<std::size_t>(own_.outputs()), std::vector<float>(static_cast<std::size_t>(block)));
    scratchAt_.clear();
    for (auto& channel : scratch_) scratchAt_.push_back(channel.data());
}

void AudioOutput::audioDeviceIOCallbackWithContext(const float* const* in, int inputs, float* const* out, int outputs, int frames,
                                                   const juce::AudioIODeviceCallbackContext&) {
    if (inputTap_ != nullptr && inputs > 0 && frames > 0 && running_.load(std::memory_order_relaxed)) inputTap_->take(in, inputs, frames, played_.load()->nextNs(0), rate_);
    renderBlock(out, outputs, frames);
}

void AudioOutput::renderBlock(float* const* out, int outputs, int frames) noexcept PHYSVIB_NONBLOCKING {
    for (int k = 0; k < outputs; ++k) juce::FloatVectorOperations::clear(out[k], frames);
    if (frames < 1 || !running_.load(std::memory_order_relaxed)) return;
    const auto start = juce::Time::getHighResolutionTicks();
    isInBlock_.store(true);
    Session& session = *played_.load();
    FeltMoment felt{session.nextFeltNs(), std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch()).count() + latencyNs_};
    felt.behindNs = session.nextNs(0) - felt.sessionNs + latencyNs_;
    if (frames > largestBlock_.load(std::memory_order_relaxed)) largestBlock_.store(frames, std::memory_order_relaxed);
    const bool rests = isSilent() || ending_.load(std::memory_order_relaxed);
    for (auto [ramp, gain] : {std::pair{&master_, &level_}, {&noiseRamp_, &noiseGain_}, {&contactRamp_, &contactGain_}}) {
        if (rests) ramp->moveTo(0.0f, frames);
        else ramp->moveTo(gain->load(std::memory_order_relaxed));
    }
    if (rests) areMarksOpen_ = false;
    for (int done = 0; done < frames; done += block_) renderPart(session, out, outputs, done, std::min(block_, frames - done), rests);
    if (session.nextFeltNs() != felt.sessionNs) // else nobody steps the world: session time stands still
        for (auto& newest : felt_) newest.write(felt);
    isInBlock_.store(false);
    measure(start, frames);
}

void AudioOutput::renderPart(Session& session, float* const* out, int outputs, int first, int frames, bool rests) noexcept {
    session.render(scratchAt_.data(), frames, RenderMode::realtime);
    renderHeard(session, out, outputs, first, frames);
    renderMarks(session, out, outputs, first, frames, rests);
    for (int j = session.channels(); j < own_.channels(); ++j) juce::FloatVectorOperations::clear(scratchAt_[static_cast<std::size_t>(j)], frames);
    if (auto* recorder = recorder_.load(std::memory_order_acquire)) recorder->take(scratchAt_.data(), frames, session.framesRendered() - frames);
    if (tap_ != nullptr) tap_->take(scratchAt_.data(), frames);
    switchMotors(frames);
    for (int j = 0; j < session.channels(); ++j) { // the limiter, if on, leaves nothing to cut
        float* at = scratchAt_[static_cast<std::size_t>(j)];
        juce::FloatVectorOperations::clip(at, at, -session.ceiling(j), session.ceiling(j), frames);
    }
    master_.apply(scratchAt_.data(), session.channels(), frames);
    for (int j = 0; j < session.channels(); ++j) {
        float* at = scratchAt_[static_cast<std::size_t>(j)];
        const int k = map_.play(j, at, frames);
        if (k < 0 || k >= outputs) continue;
        juce::FloatVectorOperations::copy(out[k] + first, at, frames);
        if (std::ranges::find(motors_, static_cast<std::size_t>(j), &Motor::enchanter) == motors_.end()) exposure_.take(j, at, frames); // how a motor shakes, nobody says
    }
    exposure_.publish();
}

// A step late, as it says what was in it; then as loud as ceiling and master level let it be.
void AudioOutput::switchMotors(int frames) noexcept {
    for (Motor& motor : motors_)
        for (int n = 0; n < frames; ++n) {
            float& sample = scratchAt_[motor.enchanter][n];
            motor.steps.take(sample, [](long long, bool) {});
            sample = motor.steps.isOn() ? 1.0f : 0.0f;
        }
}

void AudioOutput::renderHeard(const Session& session, float* const* out, int outputs, int first, int frames) noexcept {
    if (noiseGain_.load(std::memory_order_relaxed) > 0.0f) {
        float* noise = noiseScratch_.data();
        std::generate_n(noise, frames, [this] { return noise_.next(); });
        noiseRamp_.apply(&noise, 1, frames);
        addTo(Heard::noise, &noise, 1, out, outputs, first, frames);
    }
    if (session.heardChannels() == 0) return;
    float* const* const ears = scratchAt_.data() + session.channels();
    contactRamp_.apply(ears, session.heardChannels(), frames);
    addTo(Heard::contacts, ears, session.heardChannels(), out, outputs, first, frames);
}

// What is silenced is not felt, so it is not marked; what is left of a pulse when all comes back has its edge in the silence.
void AudioOutput::renderMarks(const Session& session, float* const* out, int outputs, int first, int frames, bool rests) noexcept {
    if (!session.marks()) return;
    float* marks = scratchAt_[static_cast<std::size_t>(session.outputs() - 1)];
    int begin = rests ? frames : 0;
    while (begin < frames && !areMarksOpen_) areMarksOpen_ = marks[begin] == 0.0f, begin += areMarksOpen_ ? 0 : 1;
    marks += begin;
    addTo(Heard::marks, &marks, 1, out, outputs, first + begin, frames - begin);
}

// Of two signals the outputs take turns: left, right, left... Nothing else plays on them; together noise and contacts stay within full scale.
void AudioOutput::addTo(Heard source, float* const* signals, int count, float* const* out, int outputs, int first, int frames) noexcept {
    for (int i = 0; i < OutputMap::mostHeard; ++i) {
        const int k = map_.heardAt(source, i);
        if (k < 0 || k >= outputs) continue;
        juce::FloatVectorOperations::add(out[k] + first, signals[i % count], frames);
        juce::FloatVectorOperations::clip(out[k] + first, out[k] + first, -1.0f, 1.0f, frames);
    }
}

void AudioOutput::measure(juce::int64 startTicks, int frames) noexcept {
    const double taken = juce::Time::highResolutionTicksToSeconds(juce::Time::getHighResolutionTicks() - startTicks);
    measured_.last = static_cast<float>(taken * rate_ / frames);
    measured_.worst = std::max(measured_.worst, measured_.last);
    ++measured_.blocks;
    load_.write(measured_);
}

AudioOutputStatus AudioOutput::status() {
    const Load load = load_.read();
    const bool isRunning = running_;
    return {load.blocks, load.last, load.worst, found_.device && isRunning ? found_.device->getXRunCount() : -1, isRunning, losses_};
}

int AudioOutput::deviceLatencyFrames() const { return found_.device ? found_.device->getOutputLatencyInSamples() : 0; }

int AudioOutput::deviceOutputs() const { return found_.device ? found_.device->getOutputChannelNames().size() : 0; }

} // namespace physvib

// SPDX-License-Identifier: MIT
// Opens, feeds and supervises the audio device that plays a session on the actuators.
#include "Live/Devices/AudioOutput.h"

namespace physvib {

namespace {

using namespace std::chrono_literals;

constexpr double fadeInSeconds = 0.005;
constexpr DeviceSession::TimeLimit openLimit = 10s;    // time limit for a device that a user opens
constexpr DeviceSession::TimeLimit retryLimit = 500ms; // a slower driver is tried again a second later
constexpr DeviceSession::TimeLimit closeLimit = 400ms; // a JACK client aborted here keeps its server busy
constexpr auto firstBlockLimit = 1s;                   // time for a newly opened device to ask for a block
constexpr std::chrono::milliseconds minFade = 100ms, maxFade = 400ms; // limits of three blocks' time
constexpr int maxOutputs = 65'536;                                    // of a device

/// The latency that the driver reports, plus what it cannot know.
int latencyFrames(AudioDevice& device) {
    const double addedSeconds = isPico(device.name()) ? picoLatencySeconds : 0.0;
    return device.deviceLatencyFrames() + static_cast<int>(std::lround(addedSeconds * device.sampleRateHz()));
}

} // namespace

AudioOutput::AudioOutput(Session& session, AudioDrivers drivers, const std::atomic<bool>* isEnded)
    : OutputClock{isEnded}
    , played_{session}
    , receipts_{session.channels()}
    , deviceSession_{std::move(drivers), isEnded} {}

AudioOutput::~AudioOutput() { close(); }

std::string AudioOutput::open(const AudioOutputSettings& settings) {
    close();
    if (auto error = map_.request(played_.ownSession().channels(), settings.channelMap,
                                  settings.actuatorCount, settings.listening.outputs());
        !error.empty())
        return error;
    settings_ = settings;
    setLevel(settings.level);
    monitorMix_.setLevels(settings.listening);
    openedAt_ = Clock::now();
    return openDevice(openLimit);
}

std::string AudioOutput::setMap(const std::vector<int>& channelMap, int actuatorCount,
                                const ListeningSettings& listening) {
    if (auto error =
            map_.request(played_.ownSession().channels(), channelMap, actuatorCount, listening.outputs());
        !error.empty())
        return error;
    const AudioOutputSettings previous = settings_;
    settings_.channelMap = channelMap;
    settings_.actuatorCount = actuatorCount;
    settings_.listening = listening;
    if (auto error = listeningError(); !error.empty()) {
        settings_ = previous;
        map_.request(played_.ownSession().channels(), previous.channelMap, previous.actuatorCount,
                     previous.listening.outputs());
        return error;
    }
    monitorMix_.setLevels(listening);
    if (!deviceSession_.device() || !isRunning_) return {};
    if (settings_.opensAll) return map_.applyRequest(deviceSession_.device()->activeOutputs()), std::string{};
    deviceSession_.close();
    isRunning_ = false;
    openDevice(openLimit);
    return {};
}

// A missing actuator output is noticed because nothing is felt there. A missing noise output would go
// unnoticed, so it is an error.
std::string AudioOutput::listeningError() const {
    if (!settings_.listening.contacts.empty() && played_.ownSession().rendered().contactAudioChannels() == 0)
        return "expected a session that makes contact sounds, found none";
    if (!settings_.listening.marks.empty() && !played_.ownSession().rendered().marks())
        return "expected a session that marks its onsets, found none";
    return deviceSession_.device() ? deviceRequest().errorFor(*deviceSession_.device()) : std::string{};
}

DeviceRequest AudioOutput::deviceRequest() const {
    DeviceRequest request{settings_.device,         {},
                          map_.outputs(maxOutputs), map_.highestListeningOutput(),
                          settings_.sampleRateHz,   settings_.blockFrames,
                          settings_.opensAll};
    request.inputs.insert(settings_.inputs.begin(), settings_.inputs.end());
    return request;
}

std::string AudioOutput::openDevice(DeviceSession::TimeLimit limit) {
    if (auto error = listeningError(); !error.empty()) return error;
    if (auto error = deviceSession_.open(deviceRequest(), limit); !error.empty()) return error;
    maxFrames_ = 0;
    deviceSession_.start(*this);
    if (!isRunning_) {
        const int rate = deviceSession_.device()->sampleRateHz();
        deviceSession_.close();
        return settings_.device +
               (isSampleRate(rate) ? ": the device does not start"
                                   : ": runs at " + std::to_string(rate) + " Hz; expected 5000 to 192000");
    }
    wasConnected_ = !deviceSession_.device()->activeOutputs().empty();
    settings_.device = deviceSession_.fullName(); // from now on this very device, even if another driver has
                                                  // one with the same name
    return {};
}

// Waits until the fade has been played, but for a limited time, because the device may have stopped calling.
void AudioOutput::fadeOut() {
    if (!isRunning_) return;
    isEnding_ = true;
    const auto lastBlock = status().blocks + 2; // one block may have started before `isEnding_` was set
    const auto end =
        Clock::now() +
        std::clamp(std::chrono::milliseconds{3000 * blockFrames() / sampleRateHz()}, minFade, maxFade);
    while (isRunning_ && status().blocks < lastBlock && Clock::now() < end) std::this_thread::sleep_for(1ms);
}

void AudioOutput::stop() {
    fadeOut();
    deviceSession_.detach();
    deviceGuard_.storeSums();
    isRunning_ = false;
}

bool AudioOutput::playInstead(Session* other) {
    if (sampleRateHz() == 0) return false;
    played_.playInstead(other);
    deviceSession_.awaitBlock();
    return true;
}

void AudioOutput::close() {
    stop();
    deviceSession_.close(closeLimit);
    played_.end();
    settings_.device.clear();
}

std::string AudioOutput::maintain(Clock::time_point now) {
    if (settings_.device.empty()) return {};
    const int losses = watch_.losses();
    if (isGone(now)) {
        if (deviceSession_.device()) deviceSession_.close();
        isRunning_ = false;
        if (auto error = openDevice(retryLimit); !error.empty())
            return deviceSession_.isMissing()
                       ? settings_.device +
                             " has stopped; it is looked for every second, and time stands still"
                       : error;
        watch_.countLoss(now);
    }
    const bool isPaused = watch_.losses() == losses && now - openedAt_ > firstBlockLimit && !isPlaying();
    std::string message = adaptToDevice();
    if (settings_.device.starts_with(std::string{nullDeviceType} + ":"))
        return message; // nothing is felt there
    if (message.empty() && isPaused && map_.unassignedActuators() < map_.drivenActuators())
        message = settings_.device + " does not ask for samples: nothing is felt, and time stands still";
    if (message.empty() && deviceGuard_.hasNewEpisodes(status().guardEpisodes))
        message = settings_.device +
                  ": an actuator was turned down: what it got held its coil at nearly direct current";
    if (!message.empty() || map_.unassignedActuators() == 0) return message;
    return settings_.device + ": " + std::to_string(map_.unassignedActuators()) + " of " +
           std::to_string(map_.drivenActuators()) + " actuators have no output there";
}

// Some drivers report that a device has gone, others just stop asking. A device whose outputs were
// disconnected may not be called, but has not gone. A driver may also miss that JACK connects the outputs,
// and then sees none from the start.
bool AudioOutput::isGone(Clock::time_point now) {
    auto* const device = deviceSession_.device();
    if (!device || !device->isOpen() || !isRunning_) return true;
    const bool isConnected = !device->activeOutputs().empty();
    wasConnected_ = wasConnected_ || isConnected;
    return watch_.isGone(now, loadMeter_.read().blocks, wasConnected_ && !isConnected);
}

// Restarts the session at another sample rate, or with a longer output latency for longer blocks or a new
// sink. Empty, or one line on the changed rate.
std::string AudioOutput::adaptToDevice() {
    const int rate = deviceSession_.device()->sampleRateHz(), formerRate = sampleRateHz();
    const bool isChanged = rate != formerRate && rate > 0;
    if (isChanged || std::min(maxFrames_.load(), limits::maxBlockFrames) > blockFrames() ||
        !coversSinks(played_.currentSession()))
        deviceSession_.restart();
    return isChanged ? settings_.device + ": runs at " + std::to_string(rate) + " Hz now, at " +
                           std::to_string(formerRate) + " Hz before"
                     : std::string{};
}

void AudioOutput::aboutToStart(AudioDevice& device) {
    const int rate = device.sampleRateHz();
    const int block = std::min(std::max(device.blockFrames(), maxFrames_.load()), limits::maxBlockFrames);
    if (!isSampleRate(rate) || block < 1) return; // the device plays silence
    played_.begin(rate, block, latencyFrames(device), device.isReal());
    inputTap_ = settings_.tap;
    converter_ = settings_.converter;
    exposure_.prepare(rate);
    receipts_.begin();
    deviceGuard_.begin(deviceSession_.fullName(), device.activeOutputs(), rate);
    onOffMotors_.prepare(settings_.onOffActuators, rate, settings_.onOffThreshold);
    monitorMix_.prepare(rate, block);
    map_.applyRequest(device.activeOutputs());
    map_.finishFades(rate);
    isEnding_ = false;
    masterRamp_.prepare(rate, fadeInSeconds, 0.0f);
    isRunning_ = true;
}

void AudioOutput::processBlock(const float* const* in, int inputs, float* const* out, int outputs,
                               int frames) noexcept {
    if (inputTap_ != nullptr && inputs > 0 && frames > 0 && isRunning_.load(std::memory_order_relaxed))
        inputTap_->push(in, inputs, frames, played_.currentSession().timeline().nextNs(0), sampleRateHz());
    renderBlock(out, outputs, frames);
}

void AudioOutput::renderBlock(float* const* out, int outputs, int frames) noexcept PHYSVIB_NONBLOCKING {
    for (int k = 0; k < outputs; ++k) std::fill_n(out[k], frames, 0.0f);
    if (frames < 1 || !isRunning_.load(std::memory_order_relaxed)) return;
    const auto start = Clock::now();
    Session& session = played_.currentSession();
    const std::int64_t startNs = steadyNs(start);
    const OutputMoment moment = played_.nextOutputMoment(startNs);
    if (session.pulse().isPaused(startNs)) { // this is the first block after a pause
        receipts_.begin();
        session.endPause(startNs);
        masterRamp_.prepare(sampleRateHz(), fadeInSeconds, 0.0f);
    }
    if (frames > maxFrames_.load(std::memory_order_relaxed))
        maxFrames_.store(frames, std::memory_order_relaxed);
    const bool isSilenced = isSilent() || isEnding_.load(std::memory_order_relaxed);
    if (isSilenced)
        masterRamp_.moveTo(0.0f, frames);
    else
        masterRamp_.moveTo(level());
    monitorMix_.begin(isSilenced, frames);
    for (int done = 0; done < frames; done += blockFrames())
        renderPart(session, out, outputs, done, std::min(blockFrames(), frames - done));
    if (session.timeline().nextOutputNs() != moment.sessionNs)
        publish(moment); // otherwise nothing steps the world, and session time stands still
    session.pulse().blockRendered(startNs);
    loadMeter_.addBlock(start, frames, sampleRateHz());
}

void AudioOutput::renderPart(Session& session, float* const* out, int outputs, int first,
                             int frames) noexcept {
    float* const* const samples = played_.samples();
    const Timeline& time = session.timeline();
    const std::int64_t renderedBefore = time.framesRendered();
    session.render(samples, frames, RenderMode::realtime);
    monitorMix_.render(session, samples, out, outputs, first, frames);
    for (int j = session.channels(); j < played_.ownSession().channels(); ++j)
        std::fill_n(samples[j], frames, 0.0f);
    played_.ownSession().sinks().onBlock(
        {samples, frames, time.framesRendered() - frames, sampleRateHz(), played_.ownSession().channels()});
    onOffMotors_.apply(samples, frames);
    for (int j = 0; j < session.channels(); ++j) { // with the limiter on, nothing is clipped here
        clip(samples[j], session.rendered().ceiling(j), frames);
    }
    masterRamp_.apply(samples, session.channels(), frames);
    if (converter_ != nullptr && !converter_->convert(samples, frames)) converter_ = nullptr;
    std::array<float*, limits::maxActuators> sent{}, coilSamples{}; // each actuator's output; if not on/off
    for (int j = 0; j < session.channels(); ++j) {
        float* signal = samples[j];
        const int k = map_.play(j, signal, frames);
        if (k < 0 || k >= outputs) continue;
        std::copy_n(signal, frames, out[k] + first);
        sent[static_cast<std::size_t>(j)] = out[k] + first;
        if (onOffMotors_.has(j)) continue;
        coilSamples[static_cast<std::size_t>(j)] = out[k] + first;
        deviceGuard_.setChannel(j, k);
    }
    deviceGuard_.process(coilSamples.data(), frames);
    const std::int64_t nextFrame = time.framesRendered() - time.outputLatencyFrames();
    if (time.framesRendered() > renderedBefore) // else session time stands still
        receipts_.addBlock(played_.borrowNumber(), nextFrame - frames, sampleRateHz(), sent.data(), frames);
    for (int j = 0; j < session.channels(); ++j)
        if (const float* const s = coilSamples[static_cast<std::size_t>(j)]) exposure_.add(j, s, frames);
    exposure_.publish(); // on/off motors are left out: their vibration level is unknown
}

AudioOutputStatus AudioOutput::status() {
    const LoadMeter::Load load = loadMeter_.read();
    const RenderStatus& rendered = played_.currentSession().status().render;
    const bool isRunning = isRunning_;
    return {load.blocks,
            load.last,
            load.worst,
            deviceSession_.device() ? deviceSession_.device()->xruns() : -1,
            isRunning,
            watch_.losses(),
            std::min(deviceGuard_.gain(), rendered.guardGain),
            deviceGuard_.episodes() + rendered.guarded};
}

int AudioOutput::deviceLatencyFrames() const {
    return deviceSession_.device() ? latencyFrames(*deviceSession_.device()) : 0;
}

int AudioOutput::deviceOutputs() const {
    return deviceSession_.device() ? deviceSession_.device()->outputs() : 0;
}

} // namespace physvib

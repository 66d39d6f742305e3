// SPDX-License-Identifier: MIT
// Opens, feeds and supervises the audio device that plays a session on the actuators.
#include "Live/Devices/AudioOutput.h"

namespace physvib {

namespace {

using namespace std::chrono_literals;

constexpr double fadeInSeconds = 0.005;
constexpr DeviceSession::Limit opening = 10s;     // time limit for a device that a user opens
constexpr DeviceSession::Limit reopening = 500ms; // a driver that takes longer is tried again a second later
constexpr DeviceSession::Limit ending = 400ms;    // a JACK client aborted here keeps its server busy
constexpr auto firstBlock = 1s;                   // time for a newly opened device to ask for a block
constexpr std::chrono::milliseconds leastFade = 100ms, mostFade = 400ms; // limits of three blocks' time
constexpr int mostOutputs = 65'536;                                      // of a device

/// The latency that the driver reports, plus what it cannot know.
int latencyFrames(AudioDevice& device) {
    const double own = isPico(device.name()) ? picoLatencySeconds : 0.0;
    return device.deviceLatencyFrames() + static_cast<int>(std::lround(own * device.sampleRateHz()));
}

} // namespace

AudioOutput::AudioOutput(Session& session, AudioDrivers drivers, const std::atomic<bool>* isEnded)
    : OutputClock{isEnded}
    , played_{session}
    , receipts_{session.channels()}
    , keeper_{std::move(drivers), isEnded} {}

AudioOutput::~AudioOutput() { close(); }

std::string AudioOutput::open(const AudioOutputSettings& settings) {
    close();
    if (auto error = map_.want(played_.own().channels(), settings.channelMap, settings.enchanters,
                               settings.listening.outputs());
        !error.empty())
        return error;
    settings_ = settings;
    setLevel(settings.level);
    heard_.setLevels(settings.listening);
    openedAt_ = Clock::now();
    return openDevice(opening);
}

std::string AudioOutput::remap(const std::vector<int>& channelMap, int enchanters,
                               const ListeningSettings& listening) {
    if (auto error = map_.want(played_.own().channels(), channelMap, enchanters, listening.outputs());
        !error.empty())
        return error;
    const AudioOutputSettings before = settings_;
    settings_.channelMap = channelMap;
    settings_.enchanters = enchanters;
    settings_.listening = listening;
    if (auto error = listeningFault(); !error.empty()) {
        settings_ = before;
        map_.want(played_.own().channels(), before.channelMap, before.enchanters, before.listening.outputs());
        return error;
    }
    heard_.setLevels(listening);
    if (!keeper_.device() || !running_) return {};
    if (settings_.opensAll) return map_.place(keeper_.device()->activeOutputs()), std::string{};
    keeper_.close();
    running_ = false;
    openDevice(opening);
    return {};
}

// A missing actuator output is noticed because nothing is felt there. A missing noise output would go
// unnoticed, so it is an error.
std::string AudioOutput::listeningFault() const {
    if (!settings_.listening.contacts.empty() && played_.own().rendered().heard() == 0)
        return "expected a session that makes contact sounds, found none";
    if (!settings_.listening.marks.empty() && !played_.own().rendered().marks())
        return "expected a session that marks its onsets, found none";
    return keeper_.device() ? wish().fault(*keeper_.device()) : std::string{};
}

DeviceRequest AudioOutput::wish() const {
    DeviceRequest w{settings_.device,          {},
                    map_.outputs(mostOutputs), map_.highestHeard(),
                    settings_.sampleRateHz,    settings_.blockFrames,
                    settings_.opensAll};
    w.inputs.insert(settings_.inputs.begin(), settings_.inputs.end());
    return w;
}

std::string AudioOutput::openDevice(DeviceSession::Limit limit) {
    if (auto error = listeningFault(); !error.empty()) return error;
    if (auto error = keeper_.open(wish(), limit); !error.empty()) return error;
    largestBlock_ = 0;
    keeper_.start(*this);
    if (!running_) {
        const int rate = keeper_.device()->sampleRateHz();
        keeper_.close();
        return settings_.device +
               (isSampleRate(rate) ? ": the device does not start"
                                   : ": runs at " + std::to_string(rate) + " Hz; expected 5000 to 192000");
    }
    wasConnected_ = !keeper_.device()->activeOutputs().empty();
    settings_.device = keeper_.fullName(); // from now on this very device, even if another driver has one
                                           // with the same name
    return {};
}

// Waits until the fade has been played, but for a limited time, because the device may have stopped calling.
void AudioOutput::fadeOut() {
    if (!running_) return;
    ending_ = true;
    const auto blocks = status().blocks + 2; // one block may have started before `ending_` was set
    const auto end =
        Clock::now() +
        std::clamp(std::chrono::milliseconds{3000 * blockFrames() / sampleRateHz()}, leastFade, mostFade);
    while (running_ && status().blocks < blocks && Clock::now() < end) std::this_thread::sleep_for(1ms);
}

void AudioOutput::stop() {
    fadeOut();
    keeper_.letGo();
    guard_.giveBack();
    running_ = false;
}

bool AudioOutput::playInstead(Session* other) {
    if (sampleRateHz() == 0) return false;
    played_.playInstead(other);
    keeper_.awaitBlock();
    return true;
}

void AudioOutput::close() {
    stop();
    keeper_.close(ending);
    played_.end();
    settings_.device.clear();
}

std::string AudioOutput::maintain(Clock::time_point now) {
    if (settings_.device.empty()) return {};
    const int before = watch_.losses();
    if (hasGone(now)) {
        if (keeper_.device()) keeper_.close();
        running_ = false;
        if (auto error = openDevice(reopening); !error.empty())
            return keeper_.isMissing()
                       ? settings_.device +
                             " has stopped; it is looked for every second, and time stands still"
                       : error;
        watch_.lose(now);
    }
    const bool isStill = watch_.losses() == before && now - openedAt_ > firstBlock && !isPlaying();
    std::string changed = follow();
    if (settings_.device.starts_with(std::string{noDeviceType} + ":"))
        return changed; // nothing is felt there
    if (changed.empty() && isStill && map_.unfelt() < map_.enchanters())
        changed = settings_.device + " does not ask for samples: nothing is felt, and time stands still";
    if (changed.empty() && guard_.hasNews(status().guarded))
        changed = settings_.device +
                  ": an actuator was turned down: what it got held its coil at nearly direct current";
    if (!changed.empty() || map_.unfelt() == 0) return changed;
    return settings_.device + ": " + std::to_string(map_.unfelt()) + " of " +
           std::to_string(map_.enchanters()) + " actuators have no output there";
}

// Some drivers report that a device has gone, others just stop asking. A device whose outputs were
// disconnected may not be called, but has not gone. A driver may also miss that JACK connects the outputs,
// and then sees none from the start.
bool AudioOutput::hasGone(Clock::time_point now) {
    auto* const device = keeper_.device();
    if (!device || !device->isOpen() || !running_) return true;
    const bool isConnected = !device->activeOutputs().empty();
    wasConnected_ = wasConnected_ || isConnected;
    return watch_.hasGone(now, load_.read().blocks, wasConnected_ && !isConnected);
}

// Restarts the session at another sample rate, or with a longer output latency for longer blocks or a new
// sink. Empty, or one line on the changed rate.
std::string AudioOutput::follow() {
    const int rate = keeper_.device()->sampleRateHz(), before = sampleRateHz();
    const bool isChanged = rate != before && rate > 0;
    if (isChanged || std::min(largestBlock_.load(), limits::maxBlockFrames) > blockFrames() ||
        !coversSinks(played_.now()))
        keeper_.restart();
    return isChanged ? settings_.device + ": runs at " + std::to_string(rate) + " Hz now, at " +
                           std::to_string(before) + " Hz before"
                     : std::string{};
}

void AudioOutput::aboutToStart(AudioDevice& device) {
    const int rate = device.sampleRateHz();
    const int block = std::min(std::max(device.blockFrames(), largestBlock_.load()), limits::maxBlockFrames);
    if (!isSampleRate(rate) || block < 1) return; // the device plays silence
    played_.begin(rate, block, latencyFrames(device), device.isReal());
    inputTap_ = settings_.tap;
    converter_ = settings_.converter;
    exposure_.prepare(rate);
    receipts_.begin();
    guard_.begin(keeper_.fullName(), device.activeOutputs(), rate);
    motors_.prepare(settings_.onOff, rate, settings_.onOffThreshold);
    heard_.prepare(rate, block);
    map_.place(device.activeOutputs());
    map_.settle(rate);
    ending_ = false;
    master_.prepare(rate, fadeInSeconds, 0.0f);
    running_ = true;
}

void AudioOutput::block(const float* const* in, int inputs, float* const* out, int outputs,
                        int frames) noexcept {
    if (inputTap_ != nullptr && inputs > 0 && frames > 0 && running_.load(std::memory_order_relaxed))
        inputTap_->take(in, inputs, frames, played_.now().timeline().nextNs(0), sampleRateHz());
    renderBlock(out, outputs, frames);
}

void AudioOutput::renderBlock(float* const* out, int outputs, int frames) noexcept PHYSVIB_NONBLOCKING {
    for (int k = 0; k < outputs; ++k) std::fill_n(out[k], frames, 0.0f);
    if (frames < 1 || !running_.load(std::memory_order_relaxed)) return;
    const auto start = Clock::now();
    Session& session = played_.now();
    const std::int64_t startNs = steadyNs(start);
    const OutputMoment felt = played_.nextFelt(startNs);
    if (session.pulse().isStill(startNs)) { // this is the first block after a pause
        receipts_.begin();
        session.comeBack(startNs);
        master_.prepare(sampleRateHz(), fadeInSeconds, 0.0f);
    }
    if (frames > largestBlock_.load(std::memory_order_relaxed))
        largestBlock_.store(frames, std::memory_order_relaxed);
    const bool rests = isSilent() || ending_.load(std::memory_order_relaxed);
    if (rests)
        master_.moveTo(0.0f, frames);
    else
        master_.moveTo(level());
    heard_.begin(rests, frames);
    for (int done = 0; done < frames; done += blockFrames())
        renderPart(session, out, outputs, done, std::min(blockFrames(), frames - done));
    if (session.timeline().nextFeltNs() != felt.sessionNs)
        tell(felt); // otherwise nothing steps the world, and session time stands still
    session.pulse().beat(startNs);
    load_.take(start, frames, sampleRateHz());
}

void AudioOutput::renderPart(Session& session, float* const* out, int outputs, int first,
                             int frames) noexcept {
    float* const* const samples = played_.samples();
    const Timeline& time = session.timeline();
    const std::int64_t before = time.framesRendered();
    session.render(samples, frames, RenderMode::realtime);
    heard_.render(session, samples, out, outputs, first, frames);
    for (int j = session.channels(); j < played_.own().channels(); ++j) std::fill_n(samples[j], frames, 0.0f);
    played_.own().sinks().rendered({samples, frames, time.framesRendered() - frames, sampleRateHz()});
    motors_.apply(samples, frames);
    for (int j = 0; j < session.channels(); ++j) { // with the limiter on, nothing is clipped here
        clip(samples[j], session.rendered().ceiling(j), frames);
    }
    master_.apply(samples, session.channels(), frames);
    if (converter_ != nullptr && !converter_->convert(samples, frames)) converter_ = nullptr;
    std::array<float*, limits::maxEnchanters> left{}, felt{}; // at each actuator's output; those with a coil
    for (int j = 0; j < session.channels(); ++j) {
        float* at = samples[j];
        const int k = map_.play(j, at, frames);
        if (k < 0 || k >= outputs) continue;
        std::copy_n(at, frames, out[k] + first);
        left[static_cast<std::size_t>(j)] = out[k] + first;
        if (motors_.has(j)) continue;
        felt[static_cast<std::size_t>(j)] = out[k] + first;
        guard_.follow(j, k);
    }
    guard_.process(felt.data(), frames);
    const std::int64_t next = time.framesRendered() - time.outputLatencyFrames();
    if (time.framesRendered() > before) // else session time stands still, as nothing steps the world yet
        receipts_.take(played_.number(), next - frames, sampleRateHz(), left.data(), frames);
    for (int j = 0; j < session.channels(); ++j)
        if (const float* const at = felt[static_cast<std::size_t>(j)]) exposure_.take(j, at, frames);
    exposure_.publish(); // on/off motors are left out: their vibration level is unknown
}

AudioOutputStatus AudioOutput::status() {
    const LoadMeter::Load load = load_.read();
    const RenderStatus& rendered = played_.now().status().render;
    const bool isRunning = running_;
    return {load.blocks,
            load.last,
            load.worst,
            keeper_.device() ? keeper_.device()->xruns() : -1,
            isRunning,
            watch_.losses(),
            std::min(guard_.gain(), rendered.guardGain),
            guard_.episodes() + rendered.guarded};
}

int AudioOutput::deviceLatencyFrames() const {
    return keeper_.device() ? latencyFrames(*keeper_.device()) : 0;
}

int AudioOutput::deviceOutputs() const { return keeper_.device() ? keeper_.device()->outputs() : 0; }

} // namespace physvib

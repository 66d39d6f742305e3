// SPDX-License-Identifier: GPL-3.0-or-later
// Opening, keeping and feeding a device.
#include "Host/AudioOutput.h"
#include <algorithm>

namespace physvib {

namespace {

constexpr double fadeInSeconds = 0.005;

std::vector<std::unique_ptr<juce::AudioIODeviceType>> deviceTypes() {
    std::vector<std::unique_ptr<juce::AudioIODeviceType>> types;
    const auto add = [&](juce::AudioIODeviceType* type) {
        if (type == nullptr) return; // not on this system
        types.emplace_back(type);
        type->scanForDevices();
    };
    add(juce::AudioIODeviceType::createAudioIODeviceType_JACK());
    add(juce::AudioIODeviceType::createAudioIODeviceType_ALSA());
    add(juce::AudioIODeviceType::createAudioIODeviceType_CoreAudio());
    add(juce::AudioIODeviceType::createAudioIODeviceType_WASAPI(juce::WASAPIDeviceMode::exclusive));
    add(juce::AudioIODeviceType::createAudioIODeviceType_ASIO());
    return types;
}

bool isMeant(const std::string& wanted, const juce::AudioIODeviceType& type, const juce::String& name) {
    const std::string plain = name.toStdString();
    return wanted == plain || wanted == type.getTypeName().toStdString() + ":" + plain;
}

int channelsOf(juce::AudioIODeviceType& type, const juce::String& name) {
    const std::unique_ptr<juce::AudioIODevice> device{type.createDevice(name, {})};
    return device ? device->getOutputChannelNames().size() : 0;
}

} // namespace

std::vector<AudioDeviceName> listAudioDevices() {
    std::vector<AudioDeviceName> devices;
    for (const auto& type : deviceTypes())
        for (const auto& name : type->getDeviceNames(false))
            devices.push_back({type->getTypeName().toStdString(), name.toStdString(), channelsOf(*type, name)});
    return devices;
}

AudioOutput::AudioOutput(Session& session)
    : session_{session} {}

AudioOutput::~AudioOutput() { close(); }

std::string AudioOutput::open(const AudioOutputSettings& settings) {
    close();
    settings_ = settings;
    setLevel(settings.level);
    return openDevice();
}

std::string AudioOutput::openDevice() {
    for (auto& type : deviceTypes())
        for (const auto& name : type->getDeviceNames(false)) {
            if (!isMeant(settings_.device, *type, name)) continue;
            device_.reset(type->createDevice(name, {}));
            if (!device_) return settings_.device + ": the device cannot be opened";
            type_ = std::move(type);
            juce::BigInteger outputs;
            outputs.setRange(0, device_->getOutputChannelNames().size(), true);
            const auto error = device_->open({}, outputs, settings_.sampleRateHz > 0 ? settings_.sampleRateHz : device_->getCurrentSampleRate(),
                                             settings_.blockFrames > 0 ? settings_.blockFrames : device_->getDefaultBufferSize());
            if (error.isNotEmpty()) return settings_.device + ": " + error.toStdString();
            device_->start(this);
            return running_ ? std::string{} : settings_.device + ": the device does not start";
        }
    return settings_.device + ": no such device (see physvib devices); nothing else is played on";
}

void AudioOutput::close() {
    if (device_) device_->stop();
    device_.reset();
    type_.reset();
    running_ = false;
}

std::string AudioOutput::maintain() {
    if (settings_.device.empty() || (device_ && device_->isOpen() && running_)) return {};
    close();
    return openDevice();
}

void AudioOutput::audioDeviceAboutToStart(juce::AudioIODevice* device) {
    const int rate = juce::roundToInt(device->getCurrentSampleRate());
    const int block = std::min(device->getCurrentBufferSizeSamples(), limits::maxBlockFrames);
    if (rate < limits::minSampleRateHz || rate > limits::maxSampleRateHz || block < 1) return; // stays silent
    if (rate_ == 0) session_.prepare(rate, block);
    else if (rate != rate_ || block != block_) session_.resume(rate, block);
    if (auto* recorder = recorder_.load(std::memory_order_relaxed); recorder && recorder->sampleRateHz() != rate) recorder_ = nullptr;
    rate_ = rate;
    block_ = block;
    scratch_.assign(static_cast<std::size_t>(session_.channels()), std::vector<float>(static_cast<std::size_t>(block)));
    scratchAt_.clear();
    for (auto& channel : scratch_) scratchAt_.push_back(channel.data());
    mapOutputs(device->getActiveOutputChannels());
    master_.prepare(rate, fadeInSeconds, 0.0f);
    running_ = true;
}

// The callback gets the active outputs only, packed together.
void AudioOutput::mapOutputs(const juce::BigInteger& active) {
    outputOf_.fill(-1);
    for (int j = 0; j < session_.channels(); ++j) {
        const bool isMapped = !settings_.channelMap.empty();
        if (isMapped && j >= static_cast<int>(settings_.channelMap.size())) continue;
        const int wanted = isMapped ? settings_.channelMap[static_cast<std::size_t>(j)] : j;
        if (wanted < 0 || !active[wanted]) continue;
        int packed = 0;
        for (int k = 0; k < wanted; ++k) packed += active[k] ? 1 : 0;
        outputOf_[static_cast<std::size_t>(j)] = packed;
    }
}

void AudioOutput::audioDeviceStopped() { running_ = false; }
void AudioOutput::audioDeviceError(const juce::String&) { running_ = false; }

void AudioOutput::audioDeviceIOCallbackWithContext(const float* const*, int, float* const* out, int outputs, int frames,
                                                   const juce::AudioIODeviceCallbackContext&) {
    for (int k = 0; k < outputs; ++k) juce::FloatVectorOperations::clear(out[k], frames);
    if (!running_.load(std::memory_order_relaxed)) return;
    const auto start = juce::Time::getHighResolutionTicks();
    master_.moveTo(silent_.load(std::memory_order_relaxed) ? 0.0f : level_.load(std::memory_order_relaxed));
    for (int done = 0; done < frames; done += block_) renderPart(out, outputs, done, std::min(block_, frames - done));
    const double taken = juce::Time::highResolutionTicksToSeconds(juce::Time::getHighResolutionTicks() - start);
    measured_.last = static_cast<float>(taken * rate_ / frames);
    measured_.worst = std::max(measured_.worst, measured_.last);
    ++measured_.blocks;
    load_.write(measured_);
}

void AudioOutput::renderPart(float* const* out, int outputs, int first, int frames) noexcept {
    session_.render(scratchAt_.data(), frames, RenderMode::realtime);
    if (auto* recorder = recorder_.load(std::memory_order_acquire)) recorder->take(scratchAt_.data(), frames);
    master_.apply(scratchAt_.data(), session_.channels(), frames);
    for (int j = 0; j < session_.channels(); ++j) {
        const int k = outputOf_[static_cast<std::size_t>(j)];
        if (k >= 0 && k < outputs) juce::FloatVectorOperations::add(out[k] + first, scratchAt_[static_cast<std::size_t>(j)], frames);
    }
}

AudioOutputStatus AudioOutput::status() {
    const Load load = load_.read();
    const bool isRunning = running_;
    return {load.blocks, load.last, load.worst, device_ && isRunning ? device_->getXRunCount() : -1, isRunning};
}

int AudioOutput::deviceLatencyFrames() const { return device_ ? device_->getOutputLatencyInSamples() : 0; }

} // namespace physvib

// SPDX-License-Identifier: MIT
// Plays on an ALSA device.
#include "Live/Devices/AlsaDevice.h"
#include <algorithm>

namespace physvib {

AlsaDevice::AlsaDevice(const AlsaLibrary& alsa, std::string name, const std::string& outputId,
                       const std::string& inputId)
    : name_{std::move(name)}
    , in_{alsa, inputId, SND_PCM_STREAM_CAPTURE}
    , out_{alsa, outputId, SND_PCM_STREAM_PLAYBACK} {
    if (!inputId.empty()) inputRange_ = in_.pcm.range();
    if (!outputId.empty()) outputRange_ = out_.pcm.range();
}

std::string AlsaDevice::Direction::open(const ChannelSet& wanted, const AlsaRange& range, int& rateHz,
                                        int& blockFrames) {
    active.clear();
    for (const int k : wanted)
        if (pcm.hasName() && (k < range.maxChannels || range.maxChannels == 0)) active.insert(k);
    if (active.empty()) return {};
    return pcm.open(std::max(range.minChannels, *active.rbegin() + 1), rateHz, blockFrames);
}

void AlsaDevice::Direction::prepare(int blockFrames) {
    const auto frames = static_cast<std::size_t>(blockFrames);
    interleaved.assign(frames * static_cast<std::size_t>(pcm.channels()), 0.0f);
    channels.assign(active.size(), std::vector<float>(frames, 0.0f));
    buffers.clear();
    for (auto& channel : channels) buffers.push_back(channel.data());
}

void AlsaDevice::Direction::split() noexcept {
    const auto step = static_cast<std::size_t>(pcm.channels());
    auto channel = channels.begin();
    for (const int k : active) {
        const float* from = interleaved.data() + k;
        for (float& sample : *channel) {
            sample = *from;
            from += step;
        }
        ++channel;
    }
}

void AlsaDevice::Direction::join() noexcept {
    const auto step = static_cast<std::size_t>(pcm.channels());
    auto channel = channels.begin();
    for (const int k : active) {
        float* to = interleaved.data() + k;
        for (const float sample : *channel) {
            *to = sample;
            to += step;
        }
        ++channel;
    }
}

std::string AlsaDevice::open(const ChannelSet& inputs, const ChannelSet& outputs, int sampleRateHz,
                             int blockFrames) {
    close();
    rateHz_ = sampleRateHz > 0 ? sampleRateHz : std::max(outputRange_.rateHz, inputRange_.rateHz);
    blockFrames_ = blockFrames > 0 ? blockFrames : defaultBlockFrames();
    std::string error = out_.open(outputs, outputRange_, rateHz_, blockFrames_);
    const int playedRateHz = rateHz_;
    if (error.empty()) error = in_.open(inputs, inputRange_, rateHz_, blockFrames_);
    if (error.empty() && !out_.pcm.isOpen())
        error = "expected an output of the device, found none of those wanted";
    if (error.empty() && playedRateHz != rateHz_)
        error = "its inputs run at " + std::to_string(rateHz_) + " Hz, its outputs at " +
                std::to_string(playedRateHz) + " Hz; expected one rate";
    if (!error.empty()) return close(), error;
    in_.prepare(blockFrames_);
    out_.prepare(blockFrames_);
    isEnding_ = hasFailed_ = false;
    thread_ = std::thread{[this] { run(); }};
    return {};
}

void AlsaDevice::close() {
    stop();
    isEnding_ = true;
    if (thread_.joinable()) thread_.join(); // it waits for the device for at most 100 ms at a time
    in_.pcm.close();
    out_.pcm.close();
}

void AlsaDevice::start(DeviceUser& user) {
    if (isOpen()) slot_.begin(*this, user);
}

void AlsaDevice::stop() {
    if (DeviceUser* const user = slot_.end()) user->stopped();
}

// All of one block. False: the device is being closed, or has gone.
bool AlsaDevice::moveAll(Direction& direction) noexcept {
    const auto step = static_cast<std::size_t>(direction.pcm.channels());
    for (int moved = 0, done = 0; moved < blockFrames_; moved += done) {
        float* const at = direction.interleaved.data() + static_cast<std::size_t>(moved) * step;
        if (direction.pcm.move(at, blockFrames_ - moved, done) == AlsaPcm::Moved::failed) hasFailed_ = true;
        if (isEnding_ || hasFailed_) return false;
    }
    return true;
}

void AlsaDevice::run() noexcept {
    const int inputs = static_cast<int>(in_.active.size()), outputs = static_cast<int>(out_.active.size());
    if (inputs > 0) in_.pcm.begin();
    while (!isEnding_) {
        if (inputs > 0 && !moveAll(in_)) return;
        in_.split();
        slot_.call([&](DeviceUser* user) {
            if (user != nullptr)
                user->block(in_.buffers.data(), inputs, out_.buffers.data(), outputs, blockFrames_);
            else
                for (auto& channel : out_.channels) std::ranges::fill(channel, 0.0f);
        });
        out_.join();
        if (!moveAll(out_)) return;
    }
}

} // namespace physvib

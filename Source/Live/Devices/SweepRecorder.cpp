// SPDX-License-Identifier: MIT
// An audio callback plays and records a sweep while the message thread waits for its end.
#include "Live/Devices/SweepRecorder.h"
#include "Core/Actuators/OutputGuard.h"
#include "Core/Nonblocking.h"
#include <algorithm>

namespace physvib {
namespace {

class SweepCallback final : public AudioDeviceCallback {
public:
    explicit SweepCallback(RecordedSweep& sweep)
        : sweep_{sweep} {}
    std::size_t framesDone() const noexcept { return framesDone_.load(std::memory_order_acquire); }

private:
    void processBlock(const float* const* in, int inputs, float* const* out, int outputs,
                      int frames) noexcept PHYSVIB_NONBLOCKING override {
        for (int j = 0; j < outputs; ++j)
            if (out[j] != nullptr) std::fill_n(out[j], frames, 0.0f);
        const std::size_t start = framesDone_.load(std::memory_order_relaxed),
                          count = std::min(static_cast<std::size_t>(frames), sweep_.played.size() - start);
        if (outputs < 1 || inputs < 1 || out[0] == nullptr || in[0] == nullptr) return;
        std::copy_n(sweep_.played.begin() + static_cast<std::ptrdiff_t>(start), count, out[0]);
        std::copy_n(in[0], count, sweep_.recorded.begin() + static_cast<std::ptrdiff_t>(start));
        framesDone_.store(start + count, std::memory_order_release);
    }
    void aboutToStart(AudioDevice&) override {}
    void stopped() override {}

    RecordedSweep& sweep_;
    std::atomic<std::size_t> framesDone_{0};
};

/// Applies OutputGuard in advance, so that the measurement uses the samples that leave the device.
void applyGuard(std::vector<float>& samples, int rateHz) {
    const auto guard = std::make_unique<OutputGuard>();
    guard->prepare(rateHz, 1, GuardPlace::last);
    float* const channel = samples.data();
    guard->process(&channel, static_cast<int>(samples.size()));
}

/// Waits until all is played; false if there is no progress for too long.
bool awaitEnd(const SweepCallback& callback, std::size_t frames) {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::seconds timeOut{3};
    auto progressAt = Clock::now();
    for (std::size_t lastDone = 0; callback.framesDone() < frames;) {
        std::this_thread::sleep_for(std::chrono::milliseconds{20});
        if (callback.framesDone() != lastDone) lastDone = callback.framesDone(), progressAt = Clock::now();
        if (Clock::now() - progressAt > timeOut) return false;
    }
    return true;
}

} // namespace

Result<RecordedSweep> recordSweep(const SweepPorts& ports, const SweepSource& source,
                                  const AudioDrivers& drivers) {
    const auto failed = [&](const std::string& why) { return Failure{ports.device + ": " + why}; };
    const FoundDevice found = findAudioDevice(drivers, ports.device, true);
    if (!found.device) return failed("no such audio device (see physvib devices)");
    AudioDevice& device = *found.device;
    const int outputs = device.outputs(), inputs = device.inputs();
    if (ports.output >= outputs)
        return failed("has " + std::to_string(outputs) + " outputs, expected --channel within them");
    if (ports.input >= inputs)
        return failed("has " + std::to_string(inputs) + " inputs, expected --input within them");
    if (const auto error = device.open({ports.input}, {ports.output}, ports.sampleRateHz, 0); !error.empty())
        return failed(error);
    RecordedSweep sweep;
    sweep.rateHz = device.sampleRateHz();
    sweep.played = source(sweep.rateHz);
    applyGuard(sweep.played, device.sampleRateHz());
    sweep.recorded.resize(sweep.played.size());
    SweepCallback callback{sweep};
    device.start(callback);
    const bool isWhole = awaitEnd(callback, sweep.played.size());
    sweep.xruns = device.xruns();
    device.stop();
    device.close();
    if (!isWhole) return failed("stopped playing before the sweep was over");
    return sweep;
}

} // namespace physvib

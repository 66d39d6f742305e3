// SPDX-License-Identifier: MIT
// Selects the session that a device plays, its own or a borrowed one, and holds its sample rate, block size
// and output buffers.
#pragma once
#include "Live/Session/OutputClock.h"
#include "Live/Session/Session.h"
#include <atomic>
#include <vector>

namespace physvib {

class PlayedSession {
public:
    explicit PlayedSession(Session& own)
        : own_{own}
        , now_{&own} {}

    Session& own() const noexcept { return own_; }
    /// Any thread.
    Session& now() const noexcept { return *now_.load(); }
    bool isLent() const noexcept { return &now() != &own_; }
    /// Of the session that plays: 0, the own one; else how many have been borrowed so far. Any thread.
    std::uint32_t number() const noexcept { return isLent() ? lends_.load() : 0; }

    /// 0: no device has run. M and R, as the next two.
    int sampleRateHz() const noexcept { return rate_; }
    int blockFrames() const noexcept { return block_; }
    /// Buffers of blockFrames() frames for each output of the own session.
    float* const* samples() const noexcept { return at_.data(); }

    /// Starts or resumes the current session at that rate, on a device with that latency; its pauses count if
    /// it is real. M, while R does not run.
    void begin(int sampleRateHz, int maxBlockFrames, int latencyFrames, bool isReal) {
        if (rate_ == 0)
            now().prepare(sampleRateHz, maxBlockFrames);
        else if (sampleRateHz != rate_ || maxBlockFrames != block_ || !coversSinks(now()))
            now().resume(sampleRateHz, maxBlockFrames);
        rate_ = sampleRateHz;
        block_ = maxBlockFrames;
        latencyNs_ = std::int64_t{1'000'000'000} * latencyFrames / rate_;
        pauseNs_ =
            isReal ? DevicePulse::limitNs(std::int64_t{1'000'000'000} * block_ / rate_) : DevicePulse::never;
        beginPulse();
        samples_.assign(static_cast<std::size_t>(own_.rendered().count()),
                        std::vector<float>(static_cast<std::size_t>(block_)));
        at_.clear();
        for (auto& channel : samples_) at_.push_back(channel.data());
    }

    /// No device is open. M, while R does not run.
    void end() noexcept {
        pauseNs_ = 0;
        if (rate_ != 0) now().pulse().end();
    }

    /// Time at which the next block is felt, for a block requested at `steadyNs`. R.
    OutputMoment nextFelt(std::int64_t steadyNs) const noexcept {
        const std::int64_t felt = now().timeline().nextFeltNs();
        return {felt, steadyNs + latencyNs_, now().timeline().nextNs(0) - felt + latencyNs_, rate_};
    }

    /// Plays another session from the next block on; null returns to the own one. A device has run. M.
    void playInstead(Session* other) {
        if (other != nullptr)
            other->prepare(rate_, block_);
        else if (isLent() && (lentRate_ != rate_ || lentBlock_ != block_))
            own_.resume(rate_, block_);
        if (!isLent()) lentRate_ = rate_, lentBlock_ = block_;
        lends_ += other != nullptr ? 1 : 0;
        now_.store(other != nullptr ? other : &own_);
        beginPulse();
    }

private:
    void beginPulse() noexcept { now().pulse().begin(pauseNs_, steadyNs()); }

    Session& own_;
    std::atomic<Session*> now_; // sequentially consistent, as the calls of DeviceSession: after a change, M
                                // can see whether R may still use the old session
    std::atomic<std::uint32_t> lends_{0};
    int lentRate_ = 0, lentBlock_ = 0; // of the own session when another was borrowed
    std::int64_t pauseNs_ = DevicePulse::never;

    // R; set while the device is stopped
    int rate_ = 0, block_ = 0;
    std::int64_t latencyNs_ = 0; // of the device
    std::vector<std::vector<float>> samples_;
    std::vector<float*> at_;
};

} // namespace physvib

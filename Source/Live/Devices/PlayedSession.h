// SPDX-License-Identifier: MIT
// Selects the session that a device plays, its own or a borrowed one, and holds its sample rate, block size
// and output buffers.
#pragma once
#include "Live/Session/FeltOutput.h"
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

    /// 0: no device has run. M and R, as the next two.
    int sampleRateHz() const noexcept { return rate_; }
    int blockFrames() const noexcept { return block_; }
    /// Buffers of blockFrames() frames for each output of the own session.
    float* const* samples() const noexcept { return at_.data(); }

    /// Starts or resumes the current session at that rate, on a device with that latency. M, while R does not
    /// run.
    void begin(int sampleRateHz, int maxBlockFrames, int latencyFrames) {
        if (rate_ == 0)
            now().prepare(sampleRateHz, maxBlockFrames);
        else if (sampleRateHz != rate_ || maxBlockFrames != block_)
            now().resume(sampleRateHz, maxBlockFrames);
        rate_ = sampleRateHz;
        block_ = maxBlockFrames;
        latencyNs_ = std::int64_t{1'000'000'000} * latencyFrames / rate_;
        samples_.assign(static_cast<std::size_t>(own_.rendered().count()),
                        std::vector<float>(static_cast<std::size_t>(block_)));
        at_.clear();
        for (auto& channel : samples_) at_.push_back(channel.data());
    }

    /// Time at which the next block is felt, for a block requested at `steadyNs`. R.
    FeltMoment nextFelt(std::int64_t steadyNs) const noexcept {
        const std::int64_t felt = now().timeline().nextFeltNs();
        return {felt, steadyNs + latencyNs_, now().timeline().nextNs(0) - felt + latencyNs_, rate_};
    }

    /// Plays another session from the next block on; null returns to the own one. A device has run. M.
    void lend(Session* other) {
        if (other != nullptr)
            other->prepare(rate_, block_);
        else if (isLent() && (lentRate_ != rate_ || lentBlock_ != block_))
            own_.resume(rate_, block_);
        if (!isLent()) lentRate_ = rate_, lentBlock_ = block_;
        now_.store(other != nullptr ? other : &own_);
    }

private:
    Session& own_;
    std::atomic<Session*> now_; // sequentially consistent, as the calls of DeviceKeeper: after a change, M
                                // can see whether R may still use the old session
    int lentRate_ = 0, lentBlock_ = 0; // of the own session when another was borrowed

    // R; set while the device is stopped
    int rate_ = 0, block_ = 0;
    std::int64_t latencyNs_ = 0; // of the device
    std::vector<std::vector<float>> samples_;
    std::vector<float*> at_;
};

} // namespace physvib

// SPDX-License-Identifier: GPL-3.0-or-later
// Which session a device plays: its own, or one that it was lent; at which rate, and where a block of it
// goes.
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

    /// 0: no device has run. M and R, as what follows.
    int sampleRateHz() const noexcept { return rate_; }
    int blockFrames() const noexcept { return block_; }
    /// Room for that many frames of each output of the own one.
    float* const* samples() const noexcept { return at_.data(); }

    /// What plays goes on at that rate, or begins, on a device that is felt so late. M, while R does not run.
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

    /// Of the next block, asked for at `steadyNs`. R.
    FeltMoment nextFelt(std::int64_t steadyNs) const noexcept {
        const std::int64_t felt = now().timeline().nextFeltNs();
        return {felt, steadyNs + latencyNs_, now().timeline().nextNs(0) - felt + latencyNs_, rate_};
    }

    /// Another from the next block on; null: the own one goes on. A device has run. M.
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
    std::atomic<Session*> now_; // sequentially consistent, as the keeper's calls: who has changed it sees
                                // whether R may still have the old one
    int lentRate_ = 0, lentBlock_ = 0; // as they were when a session was lent

    // R, set while the device is stopped
    int rate_ = 0, block_ = 0;
    std::int64_t latencyNs_ = 0; // of the device
    std::vector<std::vector<float>> samples_;
    std::vector<float*> at_;
};

} // namespace physvib

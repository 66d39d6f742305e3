// SPDX-License-Identifier: MIT
// The scene that a session plays, and the take that is to begin next.
#pragma once
#include "Session/SessionSetup.h"
#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <utility>

namespace physvib {

/// Part of a session. A mutex of its own guards the state, taken after all others.
class WantedTake {
public:
    /// Plays another scene, as a new take, from the next step on; a state equal to state() changes nothing. Empty, or
    /// what is wrong with the scene, and nothing is done. Any thread but R.
    std::string setState(SessionState state);

    /// What is played, or will be from the next step on. Any thread but R.
    SessionState state() const;

protected:
    explicit WantedTake(SessionState state)
        : state_{std::move(state)} {}
    ~WantedTake() = default;

    /// The scene is to start anew at that session frame; -1: not any more. R, wait-free, or M.
    void setRestart(std::int64_t frame) noexcept { restartFrame_.store(frame, std::memory_order_release); }
    std::int64_t restartFrame() const noexcept { return restartFrame_.load(std::memory_order_acquire); } ///< -1: not wanted

    /// Calls start(frame, state) if a new take is wanted: at that session frame, or now if it is -1. It is wanted until that
    /// returns. Whoever holds the world.
    template <class Start>
    void take(Start start) {
        const std::int64_t frame = restartFrame_.exchange(-1, std::memory_order_acquire);
        const std::lock_guard lock{mutex_};
        if (frame < 0 && !isNew_) return;
        start(frame, state_);
        isNew_ = false;
    }

private:
    std::atomic<std::int64_t> restartFrame_{-1};
    mutable std::mutex mutex_; // taken last; guards what follows
    SessionState state_;
    bool isNew_ = false;
};

} // namespace physvib

// SPDX-License-Identifier: MIT
// A state waits for whoever steps the world.
#include "Session/WantedTake.h"
#include "Physics/Scenes/SceneValidation.h"

namespace physvib {

std::string WantedTake::setState(SessionState state) {
    if (std::string fault = validate(*state.scene); !fault.empty()) return fault;
    const std::lock_guard lock{mutex_};
    if (state == state_) return {};
    state_ = std::move(state);
    isNew_ = true;
    return {};
}

SessionState WantedTake::state() const {
    const std::lock_guard lock{mutex_};
    return state_;
}

} // namespace physvib

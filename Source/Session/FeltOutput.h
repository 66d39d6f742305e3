// SPDX-License-Identifier: MIT
// What a second output has to know of the one that a session is felt on.
#pragma once
#include "Session/SilenceHolders.h"
#include <cstdint>

namespace physvib {

/// At `steadyNs` of the steady clock, hands feel what happened at `sessionNs`.
struct FeltMoment {
    std::int64_t sessionNs = 0, steadyNs = 0;
    std::int64_t behindNs = 0; ///< by which what is felt lies behind the present: L, and the device's own
};

/// Who follows it; each reads the newest for itself.
enum class FeltReader { board, messages };

class FeltOutput {
public:
    /// Of the newest block that the session went on with; {}: none yet. One thread per reader.
    virtual FeltMoment felt(FeltReader reader) noexcept = 0;
    /// Master level, as a gain. Any thread, wait-free.
    virtual float level() const noexcept = 0;
    /// Nothing is felt, whatever the level. Any thread, wait-free.
    virtual bool isSilent() const noexcept { return silence_.isSilent(); }

    /// Who holds it silent. Any thread.
    SilenceHolders& silence() noexcept { return silence_; }
    /// The wish of a person at the machine: silent within a block, or back in a ramp, whoever has asked for
    /// silence. Any thread, without locks.
    void setSilent(bool silent) noexcept {
        silent ? void(silence_.ask(SilenceHolder::machine)) : silence_.liftAll();
    }

protected:
    ~FeltOutput() = default;

private:
    SilenceHolders silence_;
};

} // namespace physvib

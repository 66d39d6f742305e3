// SPDX-License-Identifier: MIT
// What a second output has to know of the one that a session is felt on.
#pragma once
#include <cstdint>

namespace physvib {

/// At `steadyNs` of the steady clock, hands feel what happened at `sessionNs`.
struct FeltMoment {
    std::int64_t sessionNs = 0, steadyNs = 0;
};

class FeltOutput {
public:
    /// Of the newest block that the session went on with. One reader; {0, 0}: none yet.
    virtual FeltMoment felt() noexcept = 0;
    /// Master level, as a gain. Any thread, wait-free.
    virtual float level() const noexcept = 0;
    /// Nothing is felt, whatever the level. Any thread, wait-free.
    virtual bool isSilent() const noexcept = 0;

protected:
    ~FeltOutput() = default;
};

} // namespace physvib

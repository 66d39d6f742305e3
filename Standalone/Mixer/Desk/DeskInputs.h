// SPDX-License-Identifier: GPL-3.0-or-later
// External input of the mixer by messages, applied to the displayed state.
#pragma once
#include "Mixer/Desk/DeskOsc.h"
#include <memory>
#include <optional>
#include <string>

namespace physvib {

class Desk;

/// Message thread only.
class DeskInputs {
public:
    /// `desk` outlives it.
    explicit DeskInputs(Desk& desk)
        : desk_{desk} {}

    /// Sets the OSC port. Empty, or an error, and then the old port stays.
    std::string use(const OscChoice& choice);
    const OscChoice& choice() const noexcept { return choice_; }
    std::optional<OscStatus> status() const { return osc_ ? std::optional{osc_->status()} : std::nullopt; }

    bool haveCome(); ///< true if messages have come since the last call

    void close() { osc_.reset(); } ///< stops all input

private:
    std::string open();
    std::string take(const LineInput& input);
    std::string take(const RenderControl& control);

    Desk& desk_;
    OscChoice choice_;
    std::uint64_t messages_ = 0; // as of the last haveCome()
    std::unique_ptr<DeskOsc> osc_;
};

} // namespace physvib

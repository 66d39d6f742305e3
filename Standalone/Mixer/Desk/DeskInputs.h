// SPDX-License-Identifier: GPL-3.0-or-later
// What comes to the desk from outside, by messages: it moves what the desk shows.
#pragma once
#include "Mixer/Desk/DeskOsc.h"
#include <memory>
#include <optional>
#include <string>

namespace physvib {

class Desk;

/// M only.
class DeskInputs {
public:
    /// `desk` outlives it.
    explicit DeskInputs(Desk& desk)
        : desk_{desk} {}

    /// Messages by OSC, from now on; empty, or why not, and then as before.
    std::string use(const OscChoice& choice);
    const OscChoice& choice() const noexcept { return choice_; }
    std::optional<OscStatus> status() const { return osc_ ? std::optional{osc_->status()} : std::nullopt; }

    bool haveCome(); ///< whether messages have come since it was asked last

    void close() { osc_.reset(); } ///< nothing comes any more

private:
    std::string open();
    std::string take(const LineInput& input);
    std::string take(const RenderControl& control);

    Desk& desk_;
    OscChoice choice_;
    std::uint64_t messages_ = 0; // as of haveCome()
    std::unique_ptr<DeskOsc> osc_;
};

} // namespace physvib

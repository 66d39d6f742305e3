// SPDX-License-Identifier: MIT
// The recordings that a session has played, each set once at each rate.
#pragma once
#include "Session/ContactSounds.h"
#include <algorithm>
#include <deque>
#include <span>
#include <vector>

namespace physvib {

/// All there were: R may still know any. Not while another thread asks: M.
class RecordingSets {
public:
    /// What a renderer takes of them at that rate; it lives as long as this object.
    std::span<const RecordedContact> at(int sampleRateHz, const std::vector<ContactRecording>& recordings) {
        const auto known = std::ranges::find_if(sets_, [&](const Set& set) { return set.sampleRateHz == sampleRateHz && set.recordings == recordings; });
        if (known != sets_.end()) return known->sounds.contacts();
        return sets_.emplace_back(Set{recordings, sampleRateHz, {recordings, sampleRateHz}}).sounds.contacts();
    }

private:
    struct Set {
        std::vector<ContactRecording> recordings;
        int sampleRateHz;
        ContactSounds sounds; // at that rate
    };
    std::deque<Set> sets_;
};

} // namespace physvib

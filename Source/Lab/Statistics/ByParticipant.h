// SPDX-License-Identifier: MIT
// Groups trials by participant.
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace physvib {

/// The trials of each participant, in the order of first trials. Any thread (allocates).
template <class Trial>
std::vector<std::pair<std::string, std::vector<Trial>>> byParticipant(const std::vector<Trial>& trials) {
    std::map<std::string_view, std::size_t> places;
    std::vector<std::pair<std::string, std::vector<Trial>>> own;
    for (const Trial& trial : trials) {
        const auto [at, isNew] = places.try_emplace(trial.participant, own.size());
        if (isNew) own.emplace_back(trial.participant, std::vector<Trial>{});
        own[at->second].second.push_back(trial);
    }
    return own;
}

} // namespace physvib

// SPDX-License-Identifier: MIT
// Main effects and interactions of an experimental design.
#pragma once
#include "Lab/Statistics/LongTable.h"
#include <algorithm>
#include <bit>
#include <string>
#include <vector>

namespace physvib {

struct DesignEffect {
    unsigned within = 0; ///< bit mask of within-factors
    bool isBetween = false;

    /// "group:a:b". Any thread (allocates).
    std::string name(const Design& design) const {
        std::string words = isBetween ? design.between->name : "";
        for (std::size_t i = 0; i < design.within.size(); ++i)
            if (within >> i & 1u) words.append(words.empty() ? "" : ":").append(design.within[i].name);
        return words;
    }
};

/// All effects: the grand mean first, then by the number of within-factors. Any thread (allocates).
inline std::vector<DesignEffect> effectsOf(const Design& design) {
    std::vector<DesignEffect> effects;
    for (unsigned within = 0; within < 1u << design.within.size(); ++within) {
        effects.push_back({within, false});
        if (design.between) effects.push_back({within, true});
    }
    std::ranges::stable_sort(effects, {}, [](const DesignEffect& e) { return std::popcount(e.within); });
    return effects;
}

} // namespace physvib

// SPDX-License-Identifier: MIT
// Splits two-part condition names such as PHONE-3x3 into series and groups of a chart, and into factors of a
// test.
#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace physvib {

/// The summary of a condition; null if there is none.
template <class Summary>
const Summary* conditionNamed(const std::vector<Summary>& all, const std::string& name) {
    const auto found = std::ranges::find(all, name, &Summary::condition);
    return found == all.end() ? nullptr : &*found;
}

struct ConditionAxes {
    std::vector<std::string> series, groups; ///< one empty series if conditions are groups
    std::vector<std::string> factors;        ///< for --within; empty if there is only one condition

    std::string conditionOf(std::size_t s, std::size_t g) const {
        return series[s].empty() ? groups[g] : series[s] + "-" + groups[g];
    }

    /// Precondition: `names` are unique. Any thread (allocates).
    static ConditionAxes of(std::vector<std::string> names) {
        std::ranges::sort(names);
        ConditionAxes axes;
        for (const std::string& name : names) {
            const std::size_t hyphen = name.find('-');
            if (hyphen == std::string::npos || name.find('-', hyphen + 1) != std::string::npos)
                return plain(std::move(names));
            add(axes.series, name.substr(0, hyphen));
            add(axes.groups, name.substr(hyphen + 1));
        }
        if (axes.series.size() * axes.groups.size() != names.size() || axes.groups.size() < 2)
            return plain(std::move(names));
        if (axes.series.size() > 1) axes.factors.emplace_back("condition.1");
        axes.factors.emplace_back("condition.2");
        return axes;
    }

private:
    static ConditionAxes plain(std::vector<std::string> names) {
        const bool isOne = names.size() < 2;
        return {{""},
                std::move(names),
                isOne ? std::vector<std::string>{} : std::vector<std::string>{"condition"}};
    }
    static void add(std::vector<std::string>& words, std::string word) {
        if (std::ranges::find(words, word) == words.end()) words.push_back(std::move(word));
    }
};

} // namespace physvib

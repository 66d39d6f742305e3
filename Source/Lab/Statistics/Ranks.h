// SPDX-License-Identifier: MIT
// Ranks of values, from 1; tied values get their mean rank.
#pragma once
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace physvib {

struct Ranking {
    std::vector<double> ranks; ///< rank of each value
    double tieTerm = 0.0;      ///< sum of t^3 - t over groups of t equal values
    bool hasTies() const noexcept { return tieTerm > 0.0; }
};

/// Any thread (allocates).
inline Ranking rankingOf(std::span<const double> values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
    Ranking ranking{std::vector<double>(values.size())};
    for (std::size_t from = 0, to = 0; from < order.size(); from = to) {
        while (to < order.size() && values[order[to]] == values[order[from]]) ++to;
        for (std::size_t i = from; i < to; ++i)
            ranking.ranks[order[i]] = 0.5 * static_cast<double>(from + to + 1);
        const auto equal = static_cast<double>(to - from);
        ranking.tieTerm += equal * equal * equal - equal;
    }
    return ranking;
}

} // namespace physvib

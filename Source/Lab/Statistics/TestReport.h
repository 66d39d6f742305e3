// SPDX-License-Identifier: MIT
// What a test over participants has found: a line per effect.
#pragma once
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace physvib {

/// Of effects of two and more degrees of freedom within participants.
struct Sphericity {
    std::optional<double> mauchlyW, mauchlyP; ///< none where there are too few participants, or some
                                              ///< differences follow from others
    double epsilonHuynhFeldt = 1.0;           ///< may exceed 1; its p takes it for 1 then
    double pHuynhFeldt = 1.0;
};

struct TestLine {
    std::string effect;
    std::optional<double> df1, df2, statistic, p, pCorrected, epsilon, effectSize;
    std::size_t n = 0; ///< participants
    std::optional<Sphericity> sphericity{};
};

struct TestReport {
    std::string fault;        ///< one line; then there are no lines
    std::string statistic{};  ///< its letter
    std::string effectSize{}; ///< its name; empty: none
    std::string correction{}; ///< what made pCorrected; empty: nothing
    std::vector<std::string> notes{};
    std::vector<TestLine> lines{};
};

enum class Correction { none, holm, bonferroni };

/// Corrects the lines' p for being so many. Any thread.
inline void correctForNumber(TestReport& report, Correction correction) {
    if (correction == Correction::none) return;
    report.correction = correction == Correction::holm ? "Holm" : "Bonferroni";
    std::vector<std::size_t> order(report.lines.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return report.lines[i].p.value_or(1.0); });
    double most = 0.0;
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
        TestLine& line = report.lines[order[rank]];
        const auto tests =
            static_cast<double>(correction == Correction::holm ? order.size() - rank : order.size());
        most = std::max(most, std::min(1.0, tests * line.p.value_or(1.0)));
        line.pCorrected = most;
    }
}

} // namespace physvib

// SPDX-License-Identifier: MIT
// Result of a statistical test over participants: one line per effect.
#pragma once
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace physvib {

/// 95 % interval.
struct Interval95 {
    double least = 0.0, most = 0.0;
};

struct TestLine {
    std::string effect;
    std::optional<double> df1, df2, statistic, p, pCorrected, epsilon, effectSize;
    std::size_t n = 0; ///< number of participants
    std::optional<Interval95> effectInterval{};
    std::optional<double> difference{}; ///< pairs by t: of the means, over participants
    std::optional<Interval95> differenceInterval{};
};

struct TestReport {
    std::string fault;        ///< error in one line; then `lines` is empty
    std::string statistic{};  ///< symbol of the statistic
    std::string effectSize{}; ///< name of the effect size; empty: none
    std::string correction{}; ///< name of the correction in pCorrected; empty: none
    std::vector<std::string> notes{};
    std::vector<TestLine> lines{};
};

enum class Correction { none, holm, bonferroni };

/// Sets the corrected p for the number of lines. Any thread.
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

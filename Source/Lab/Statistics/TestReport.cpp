// SPDX-License-Identifier: MIT
// Correction for multiple comparisons: Bonferroni and Holm (1979).
#include "Lab/Statistics/TestReport.h"
#include <algorithm>
#include <numeric>

namespace physvib {

void correctForNumber(TestReport& report, Correction correction) {
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

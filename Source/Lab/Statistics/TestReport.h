// SPDX-License-Identifier: MIT
// Result of a statistical test over participants: one line per effect.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace physvib {

/// Sphericity of a within-participant effect with two or more degrees of freedom.
struct Sphericity {
    std::optional<double> mauchlyW, mauchlyP; ///< none if there are too few participants, or differences are
                                              ///< linearly dependent
    double epsilonHuynhFeldt = 1.0;           ///< may exceed 1; its p uses at most 1
    double pHuynhFeldt = 1.0;
};

struct TestLine {
    std::string effect;
    std::optional<double> df1, df2, statistic, p, pCorrected, epsilon, effectSize;
    std::size_t n = 0; ///< number of participants
    std::optional<Sphericity> sphericity{};
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
void correctForNumber(TestReport& report, Correction correction);

} // namespace physvib

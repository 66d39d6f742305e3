// SPDX-License-Identifier: MIT
// What a test over participants has found: a line per effect.
#pragma once
#include <cstddef>
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
void correctForNumber(TestReport& report, Correction correction);

} // namespace physvib

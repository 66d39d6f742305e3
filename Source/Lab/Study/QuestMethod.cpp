// SPDX-License-Identifier: MIT
// Converts QUEST+ settings to a grid of psychometric functions, and to and from text.
#include "Lab/Study/QuestMethod.h"
#include "Lab/Study/NumberWord.h"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

namespace physvib {
namespace {

constexpr double mostLevels = 201.0; // with as many thresholds: at most 300,000 functions, a few milliseconds
                                     // per trial
constexpr int widths = 7;            // in equal ratios; with fewer, the threshold's posterior is biased to
                                     // the nearest width

double levelsOf(const QuestMethod& m) { return std::floor((m.mostDb - m.leastDb) / m.stepDb + 1e-6) + 1.0; }

/// Level of a step, rounded so that it prints with few digits.
double levelAt(const QuestMethod& m, int step) {
    return std::round((m.leastDb + step * m.stepDb) * 1e6) * 1e-6;
}

std::vector<std::string_view> wordsOf(std::string_view text) {
    std::vector<std::string_view> words;
    while (!text.empty()) {
        words.push_back(text.substr(0, text.find(' ')));
        text.remove_prefix(std::min(words.back().size() + 1, text.size()));
    }
    return words;
}

bool take(std::string_view word, double& number) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return error == std::errc{} && end == word.data() + word.size() && std::isfinite(number);
}

} // namespace

std::string questFault(const QuestMethod& m) {
    if (!(m.leastDb < m.mostDb)) return ": expected least_db < most_db";
    if (!(m.leastWidthDb <= m.mostWidthDb)) return ": expected least_width_db <= most_width_db";
    if (const double levels = levelsOf(m); !(levels <= mostLevels))
        return ".step_db: expected at most " + numberWord(mostLevels) + " levels, found " +
               numberWord(levels);
    return {};
}

QuestPlan questPlan(const QuestMethod& m, double guess) {
    QuestPlan plan{m.shape, guess, {}, {}, {}, {m.lapse}};
    for (int step = 0; step < static_cast<int>(levelsOf(m)); ++step) plan.levels.push_back(levelAt(m, step));
    plan.thresholds = plan.levels;
    for (int i = 0; i < widths; ++i)
        plan.widths.push_back(m.leastWidthDb * std::pow(m.mostWidthDb / m.leastWidthDb, i / (widths - 1.0)));
    return plan;
}

std::string questWords(const QuestMethod& m, double guess) {
    return std::string(psychometricShapeNames[static_cast<std::size_t>(m.shape)]) + " guess " +
           numberWord(guess) + " lapse " + numberWord(m.lapse) + " levels_db " + numberWord(m.leastDb) + ' ' +
           numberWord(m.stepDb) + ' ' + numberWord(m.mostDb) + " widths_db " + numberWord(m.leastWidthDb) +
           ' ' + numberWord(m.mostWidthDb);
}

std::optional<QuestPlan> questPlan(std::string_view text) {
    const auto words = wordsOf(text);
    if (words.size() != 12 || words[1] != "guess" || words[3] != "lapse" || words[5] != "levels_db" ||
        words[9] != "widths_db")
        return std::nullopt;
    const auto shape = std::ranges::find(psychometricShapeNames, words[0]);
    QuestMethod m;
    double guess = 0.0;
    const bool areNumbers = take(words[2], guess) && take(words[4], m.lapse) && take(words[6], m.leastDb) &&
                            take(words[7], m.stepDb) && take(words[8], m.mostDb) &&
                            take(words[10], m.leastWidthDb) && take(words[11], m.mostWidthDb);
    if (!areNumbers || shape == psychometricShapeNames.end() ||
        !(guess > 0.0 && guess < 1.0 && m.lapse > 0.0 && m.lapse <= mostLapse && m.stepDb > 0.0 &&
          m.leastWidthDb > 0.0) ||
        !questFault(m).empty())
        return std::nullopt;
    m.shape = static_cast<PsychometricShape>(shape - psychometricShapeNames.begin());
    return questPlan(m, guess);
}

} // namespace physvib

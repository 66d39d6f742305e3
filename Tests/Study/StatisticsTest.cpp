// SPDX-License-Identifier: MIT
// Tests over participants against R (the tables in R/ and the script that made them), and bad designs, which
// are refused by name.
#include "Lab/Statistics/Distributions.h"
#include "Lab/Statistics/EffectIntervals.h"
#include "Lab/Statistics/LongTable.h"
#include "Lab/Statistics/Pairs.h"
#include "Lab/Statistics/RankTests.h"
#include "Lab/Statistics/RepeatedMeasures.h"
#include "Lab/Statistics/ShapiroWilk.h"
#include "TestPlaces.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <sstream>

namespace physvib {
namespace {

std::vector<std::string> partsOf(const std::string& text, char at) {
    std::vector<std::string> parts{""};
    for (const char c : text)
        if (c == at)
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

/// A line of designs.txt.
Design designOf(const std::string& levels, const std::string& groups, const std::string& values) {
    std::vector<std::size_t> sizes;
    if (levels != "-")
        for (const auto& size : partsOf(levels, 'x')) sizes.push_back(std::stoul(size));
    const std::vector<std::string> names{"a", "b", "c"};
    LongTable table{"y",
                    {names.begin(), names.begin() + static_cast<std::ptrdiff_t>(sizes.size())},
                    groups == "-" ? "" : "g"};
    std::size_t cells = 1;
    for (const auto size : sizes) cells *= size;
    std::size_t at = 0;
    for (const std::string& value : partsOf(values, ',')) {
        const std::size_t participant = at / cells;
        std::vector<std::string> own(sizes.size());
        for (std::size_t cell = at++ % cells, i = sizes.size(); i-- > 0; cell /= sizes[i])
            own[i] = std::to_string(cell % sizes[i] + 1);
        if (value != "NA")
            table.add("P" + std::to_string(participant), {own.begin(), own.end()},
                      groups == "-" ? "" : groups.substr(participant, 1), std::stod(value));
    }
    return Design::of(table);
}

const std::map<std::string, std::function<TestReport(const Design&)>> testsByName{
    {"anova", repeatedMeasures},
    {"aligned", alignedRanks},
    {"friedman", friedman},
    {"wilcoxon", wilcoxon},
    {"mann-whitney", mannWhitney},
    {"kruskal-wallis", kruskalWallis},
    {"shapiro", shapiroByCell},
    {"pairs-t", [](const Design& d) { return pairs(d, PairTest::student, Correction::holm); }},
    {"pairs-ranks", [](const Design& d) { return pairs(d, PairTest::ranks, Correction::bonferroni); }},
};

/// Within a millionth; p below 1e-12 (and what is rounding in either program) absolutely. "?": R has no
/// figure where there is one.
bool agrees(std::optional<double> ours, const std::string& theirs) {
    if (theirs == "?") return ours && std::isfinite(*ours);
    if (theirs.empty() || !ours) return theirs.empty() && !ours;
    const double expected = std::stod(theirs);
    return std::abs(*ours - expected) <= 1e-6 * std::abs(expected) + 1e-12;
}

/// Of figures that R's thirteen digits can tell; 0 of those that are rounding.
double relativeError(std::optional<double> ours, const std::string& theirs) {
    if (!ours || theirs.empty() || theirs == "?") return 0.0;
    const double expected = std::stod(theirs);
    return std::abs(expected) < 1e-12 ? 0.0 : std::abs(*ours / expected - 1.0);
}

/// The columns df1 to mauchly_p of results.csv, without n.
std::vector<std::optional<double>> numbersOf(const TestLine& l) {
    std::vector<std::optional<double>> numbers{
        l.df1, l.df2, l.statistic, l.p, l.pCorrected, l.epsilon, l.effectSize, static_cast<double>(l.n),
        {},    {},    {},          {}};
    if (l.sphericity) {
        numbers[8] = l.sphericity->epsilonHuynhFeldt, numbers[9] = l.sphericity->pHuynhFeldt;
        numbers[10] = l.sphericity->mauchlyW, numbers[11] = l.sphericity->mauchlyP;
    }
    return numbers;
}

TEST(Statistics, AsInR) {
    const char* const elsewhere = std::getenv("PHYSVIB_DESIGNS");
    const std::string folder = elsewhere ? elsewhere : PHYSVIB_SOURCE_DIR "/Tests/Study/R";
    std::ifstream designs{folder + "/designs.txt"}, results{folder + "/results.csv"};
    std::map<std::string, Design> known;
    std::string line;
    std::getline(designs, line);
    for (std::string id, levels, groups, values; designs >> id >> levels >> groups >> values;)
        known.emplace(id, designOf(levels, groups, values));
    ASSERT_GE(known.size(), 100u);
    std::map<std::pair<std::string, std::string>, std::pair<TestReport, std::size_t>> reports;
    std::size_t compared = 0, refused = 0;
    double largest = 0.0; // relative error
    std::getline(results, line), std::getline(results, line);
    const auto columns = partsOf(line, ',');
    while (std::getline(results, line)) {
        auto cells = partsOf(line, ',');
        auto [at, isNew] = reports.try_emplace({cells[0], cells[1]});
        if (isNew) at->second.first = testsByName.at(cells[1])(known.at(cells[0]));
        auto& [report, next] = at->second;
        if (cells[2] == "refused") {
            EXPECT_NE(report.fault, "") << line;
            ++refused;
            continue;
        }
        ASSERT_EQ(report.fault, "") << line;
        ASSERT_LT(next, report.lines.size()) << line;
        const TestLine& ours = report.lines[next++];
        EXPECT_EQ(ours.effect, cells[2]) << line;
        const auto numbers = numbersOf(ours);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            EXPECT_TRUE(agrees(numbers[i], cells[i + 3]))
                << columns[i + 3] << ": ours is " << (numbers[i] ? std::to_string(*numbers[i]) : "none")
                << "\n"
                << line;
            largest = std::max(largest, relativeError(numbers[i], cells[i + 3]));
            ++compared;
        }
    }
    for (const auto& [id, report] : reports)
        EXPECT_EQ(report.second, report.first.lines.size()) << id.first << " " << id.second;
    EXPECT_GT(compared, 5000u);
    RecordProperty("designs", static_cast<int>(known.size()));
    std::cout << known.size() << " designs, " << reports.size() << " tests, " << compared << " figures, "
              << refused << " refused by both; largest relative error " << largest << '\n';
}

TEST(Statistics, ExactTailsAsTabled) {
    EXPECT_NEAR(signedRankTwoSided(0, 5), 2.0 / 32.0, 1e-15);
    EXPECT_NEAR(signedRankTwoSided(15, 5), 2.0 / 32.0, 1e-15);
    EXPECT_NEAR(rankSumTwoSided(0, 3, 3), 2.0 / 20.0, 1e-15);
    EXPECT_NEAR(rankSumTwoSided(1, 2, 4), 2.0 * 2.0 / 15.0, 1e-15);
    EXPECT_NEAR(studentQuantile(0.975, 11), 2.2009851600916388, 1e-12);
    EXPECT_NEAR(studentQuantile(0.025, 1), -12.706204736174698, 1e-10);
}

Design oneFactor(std::vector<std::vector<double>> rows) {
    LongTable table{"y", {"a"}, ""};
    for (std::size_t p = 0; p < rows.size(); ++p)
        for (std::size_t c = 0; c < rows[p].size(); ++c)
            table.add("P" + std::to_string(p), {std::to_string(c)}, "", rows[p][c]);
    return Design::of(table);
}

TEST(Statistics, BadDesignsAreRefusedByName) {
    const auto all = [](const Design& design, const std::string& words) {
        for (const char* name : {"anova", "aligned", "friedman", "wilcoxon", "pairs-t", "pairs-ranks"}) {
            const auto report = testsByName.at(name)(design);
            EXPECT_NE(report.fault.find(words), std::string::npos) << name << ": " << report.fault;
            EXPECT_TRUE(report.lines.empty());
        }
    };
    all(oneFactor({{1}, {2}, {3}}), "column a: expected two or more levels, found only 0");
    all(oneFactor({{5, 5}, {5, 5}, {5, 5}}), "found none");
    all(oneFactor({{1, 2}}), "expected two or more participants, found only P0");
    all(oneFactor({{1}, {2, 3, 4}}).fault.empty() ? oneFactor({{1}, {2, 3}, {4}}) : Design{},
        "expected two or more participants, found only P1");
    EXPECT_NE(shapiroByCell(oneFactor({{1, 2}, {2, 3}}))
                  .fault.find("a=0: expected 3 to 5000 participants, found 2"),
              std::string::npos);
    EXPECT_NE(
        shapiroByCell(oneFactor({{1, 2}, {1, 3}, {1, 4}})).fault.find("a=0: expected values that differ"),
        std::string::npos);
    EXPECT_NE(wilcoxon(oneFactor({{1, 2, 3}, {2, 4, 1}})).fault.find("expected two levels, found 3"),
              std::string::npos);
}

TEST(Statistics, DifferencesThatAreTheSameForEveryoneHaveNoMauchlyTest) {
    for (const auto& rows :
         {std::vector<std::vector<double>>{{2, 5, 1, 0}, {3, 4, 1, 0}, {3, 2, 1, 0}, {1, 2, 1, 0}},
          {{0.1, 0.7, 1.3, 3.1},
           {0.3, 0.1, -0.1, 2.2},
           {0.2, 0.9, 1.6, 4.7},
           {0.6, 0.7, 0.8, 1.9},
           {0.5, 0.2, -0.1, 0.4}}}) { // as much from the first to the second as on
        const TestReport report = repeatedMeasures(oneFactor(rows));
        ASSERT_EQ(report.fault, "");
        ASSERT_TRUE(report.lines[0].sphericity);
        EXPECT_FALSE(report.lines[0].sphericity->mauchlyW || report.lines[0].sphericity->mauchlyP);
        EXPECT_TRUE(*report.lines[0].epsilon > 0.0 && *report.lines[0].epsilon <= 1.0);
    }
}

TEST(Statistics, TablesThatAreMostlyEmptyTakeNoMemory) {
    LongTable table{"y", {"a"}, ""};
    for (int p = 0; p < 20'000; ++p) table.add("P" + std::to_string(p), {std::to_string(p % 1000)}, "", p);
    EXPECT_EQ(Design::of(table).fault,
              "expected at most 10000000 values, found 20000 participants with 1000 combinations of levels");
}

TEST(Statistics, NoFigureIsMissingHoweverLargeOrSmallTheValues) {
    for (const double scale : {1e100, 1.0, 1e-90, 1e-150, 1e-300})
        for (const auto& [name, test] : testsByName) {
            const bool isOfGroups = name == "mann-whitney" || name == "kruskal-wallis";
            LongTable table{"y", isOfGroups ? std::vector<std::string>{} : std::vector<std::string>{"a"},
                            isOfGroups ? "g" : ""};
            for (int p = 0; p < 8; ++p)
                for (int c = 0; c < (isOfGroups ? 1 : 2); ++c) {
                    const std::string level = std::to_string(c);
                    const std::vector<std::string_view> levels(isOfGroups ? 0 : 1, level);
                    table.add("P" + std::to_string(p), levels, isOfGroups ? (p % 2 ? "x" : "y") : "",
                              scale * ((p * 5 + c * 3) % 7 + 0.5 * p * c));
                }
            const auto report = test(Design::of(table));
            EXPECT_EQ(report.fault.empty(), !report.lines.empty()) << name;
            for (const auto& line : report.lines)
                for (const auto& number : numbersOf(line))
                    EXPECT_TRUE(std::isfinite(number.value_or(0.0))) << name << " at " << scale;
        }
}

TEST(Statistics, WhatIsMissingIsNamed) {
    LongTable table{"y", {"a", "b"}, "g"};
    const auto add = [&](const char* p, const char* a, const char* b, const char* g, double y) {
        table.add(p, {a, b}, g, y);
    };
    for (const char* p : {"P1", "P2", "P3", "P4"})
        for (const char* a : {"x", "y"})
            add(p, a, "u", p[1] < '3' ? "old" : "new", p[1] + (*a == 'x') * p[1] % 3);
    add("P1", "x", "v", "old", 3);
    EXPECT_EQ(Design::of(table).fault, "expected every combination of levels, found no value of a=y:b=v");
    for (const char* p : {"P1", "P2", "P3"}) add(p, "y", "v", p[1] < '3' ? "old" : "new", 4);
    add("P2", "x", "v", "old", 5);
    add("P3", "x", "v", "new", 5);
    add("P3", "x", "v", "new", 8);
    const Design design = Design::of(table);
    EXPECT_EQ(design.fault, "");
    ASSERT_EQ(design.warnings.size(), 2u);
    EXPECT_EQ(design.warnings[1], "left out, because a combination of levels has no value: P4");
    EXPECT_EQ(design.value(2, 1), 6.5);
    add("P1", "x", "v", "new", 3);
    EXPECT_EQ(Design::of(table).fault, "participant P1: expected one value of g, found old and new");
}

TEST(Statistics, FirstLevelMeansFirstInTheFile) {
    EXPECT_EQ(*wilcoxon(oneFactor({{3, 1}, {5, 2}, {9, 3}})).lines[0].statistic, 6.0);
    LongTable table{"y", {}, "g"};
    for (int i = 0; i < 3; ++i)
        table.add("z" + std::to_string(i), {}, "z", 10 + i), table.add("a" + std::to_string(i), {}, "a", i);
    const auto report = mannWhitney(Design::of(table));
    EXPECT_EQ(*report.lines[0].statistic, 9.0);
    EXPECT_EQ(*report.lines[0].effectSize, 1.0);
}

TEST(Statistics, EffectSizesHaveIntervals) {
    const auto t = noncentralityOfT(2.83, 126.0); // as R's MBESS::conf.limits.nct
    ASSERT_TRUE(t);
    EXPECT_NEAR(t->least, 0.8337502, 1e-5);
    EXPECT_NEAR(t->most, 4.815359, 1e-5);
    EXPECT_NEAR(noncentralityOfT(-2.83, 126.0)->least, -t->most, 1e-9) << "the other way round";
    EXPECT_NEAR(noncentralityOfT(100.1, 10.0)->least, noncentralityOfT(99.9, 10.0)->least, 0.3)
        << "by another way from 100 on";
    const auto f = noncentralityOfF(16.0, 1.0, 20.0), of = noncentralityOfT(4.0, 20.0);
    EXPECT_NEAR(std::sqrt(f->least), of->least, 1e-3) << "F of one degree is t squared";
    EXPECT_NEAR(std::sqrt(f->most), of->most, 1e-3);
    EXPECT_EQ(noncentralityOfF(0.5, 2.0, 20.0)->least, 0.0);
    EXPECT_FALSE(intervalOfR(1.0, 0.1)) << "nothing is known of how far beyond";
    // a mean difference of 1
    const auto pair =
        pairs(oneFactor({{1, 1}, {2, 0.5}, {3, 3}, {4, 1.5}}), PairTest::student, Correction::none).lines[0];
    ASSERT_TRUE(pair.differenceInterval && pair.effectInterval);
    EXPECT_NEAR(*pair.difference, 1.0, 1e-12);
    const double half = studentQuantile(0.975, 3.0) * *pair.difference / *pair.statistic;
    EXPECT_NEAR(pair.differenceInterval->least, 1.0 - half, 1e-9);
    EXPECT_LT(pair.effectInterval->least, *pair.effectSize);
    EXPECT_GT(pair.effectInterval->most, *pair.effectSize);
    const auto ranks = wilcoxon(oneFactor({{1, 2}, {2, 1}, {3, 1.5}, {4, 1}, {5, 1}})).lines[0];
    EXPECT_FALSE(ranks.difference) << "ranks have none in the measure's unit";
}

TEST(Statistics, ThirteenOfTwentyIsNoMajorityOfPeople) {
    std::vector<std::vector<double>> shares; // of 108 trials each: 13 people for, 7 against
    for (int p = 0; p < 20; ++p) shares.push_back({p < 13 ? 0.55 + 0.001 * p : 0.38 - 0.001 * p, 0.5});
    const auto report = wilcoxon(oneFactor(shares));
    EXPECT_GT(*report.lines[0].p, 0.2) << "a sign test over their trials says < 0.001";
}

} // namespace
} // namespace physvib

// SPDX-License-Identifier: MIT
// Charts as SVG: nothing of a file is escapeXml, series differ without colours, simulated data say so.
#include "Io/Charts/Charts.h"
#include "Io/Charts/ChartParts.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <numbers>

namespace physvib::charts_test {

std::size_t countOf(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size()))
        ++n;
    return n;
}

/// One of each kind, with these words wherever words can be.
std::vector<std::string> chartsWith(const std::string& words, bool isSimulated) {
    const ChartFrame frame{"c", words, isSimulated};
    BarChart bars{frame,
                  words,
                  words,
                  {words, "b"},
                  {{words, {ChartValue{40, 30, 50}, std::nullopt}},
                   {"two", {ChartValue{60, 60, 60}, ChartValue{20, 10, 30}}}}};
    bars.reference = {50.0, words};
    bars.ceilings = {90.0, 95.0};
    bars.ceilingLabel = words;
    LineChart lines{frame, words, words, {{words, {{1, {2, 1, 3}}, {2, {4, 4, 4}}}}}};
    lines.references = {{2.0, words}};
    lines.threshold = {1.5, 1.2, 1.8};
    lines.thresholdLabel = words;
    GridChart grid{frame, words, words, {words, "2"}, {"1", words}, {1.0, 0.5, std::nullopt, 0.0}};
    PlaceChart places{frame,
                      1,
                      2,
                      {{0, 0.2, 0.2}, {1, 0.7, 0.6}},
                      {{0, 0.3, 0.3, 0.01, 0.02, 0.005}},
                      {{0.25, 0.5}, {0.75, 0.5}}};
    places.territory = {0, 1, 0, 1};
    places.mapColumns = 2;
    return {barChart(bars), lineChart(lines), gridChart(grid), placeChart(places)};
}

TEST(Charts, NothingOfAFileBecomesMarkup) {
    EXPECT_EQ(escapeXml("<b a=\"1\" c='2'>&"), "&lt;b a=&quot;1&quot; c=&#39;2&#39;&gt;&amp;");
    EXPECT_EQ(escapeXml("a\x01\xff"), "a\\x01\\xff");
    for (const std::string& svg : chartsWith("\"/><script>alert('1')</script>", false)) {
        EXPECT_EQ(svg.find("<script"), std::string::npos) << svg;
        EXPECT_NE(svg.find("&lt;script&gt;"), std::string::npos);
    }
}

// Along each diagonal of the field, y downwards, and along both axes.
TEST(Charts, EllipsesLeanAsTheirAnswersDo) {
    PlaceChart chart{{"c", "places", false}, 1, 1, {}, {}, {{0.5, 0.5}}};
    const auto degreesOf = [&](double varianceX, double varianceY, double covariance) {
        chart.ellipses = {{0, 0.5, 0.5, varianceX, varianceY, covariance}};
        const std::string svg = placeChart(chart), turn = "rotate(";
        return std::stod(svg.substr(svg.find(turn, svg.find("<ellipse")) + turn.size()));
    };
    const double down = degreesOf(0.01, 0.01, 0.009), up = degreesOf(0.01, 0.01, -0.009);
    EXPECT_GT(down, 20.0);
    EXPECT_LT(down, 70.0);
    EXPECT_NEAR(up, -down, 1e-6);
    EXPECT_NEAR(degreesOf(0.04, 0.001, 0.0), 0.0, 1e-6);
    EXPECT_NEAR(std::abs(degreesOf(0.001, 0.04, 0.0)), 90.0, 1e-6);
}

TEST(Charts, SimulatedOnesAreWatermarkedAndOthersAreNot) {
    for (const std::string& svg : chartsWith("x", true)) EXPECT_EQ(countOf(svg, ">SIMULATED<"), 1u);
    for (const std::string& svg : chartsWith("x", false))
        EXPECT_EQ(countOf(svg, "SIMULATED") + countOf(svg, "simulated"), 0u);
}

TEST(Charts, ASheetHasThemSideBySideAndThenInRows) {
    GridChart grid{{"c", "grid"}, "row", "column", {"1"}, {"1"}, {1.0}}; // 330 wide: four beside each other
    const std::string one = gridChart(grid), sheet = chartSheet({one, one, one, one, one});
    EXPECT_EQ(chartSheet({one}), one);
    EXPECT_EQ(countOf(sheet, one), 5u) << "each as it is";
    const std::size_t from = one.find("height=\"") + 8;
    const std::string height = one.substr(from, one.find('"', from) - from);
    for (const std::string& place :
         {std::string{"0 0"}, std::string{"330 0"}, std::string{"990 0"}, "0 " + height})
        EXPECT_EQ(countOf(sheet, "<g transform=\"translate(" + place + ")\">"), 1u) << place;
    EXPECT_EQ(sheet.find("width=\"1320\""), sheet.find("width=\"")) << sheet.substr(0, 200);
}

TEST(Charts, TheSameInputGivesTheSameBytesWithoutAnyNetwork) {
    const auto first = chartsWith("a", true), again = chartsWith("a", true);
    EXPECT_EQ(first, again);
    for (const std::string& svg : first) {
        EXPECT_EQ(countOf(svg, "http"), 1u) << "the name of SVG alone";
        for (const char* bad : {"nan", "inf", "href", "@import", "url(h"})
            EXPECT_EQ(svg.find(bad), std::string::npos) << bad;
    }
}

TEST(Charts, SeriesAreToldApartWithoutColours) {
    std::set<std::string> hatches, markers;
    std::set<std::string_view> dashes, colours;
    for (std::size_t s = 0; s < chartStyles; ++s) {
        Svg bar{{"n", ""}, 10, 10}, marker{{"n", ""}, 10, 10};
        bar.bar({1, 1}, 5, 5, s);
        marker.marker({5, 5}, s);
        const std::string drawn = bar.finish(), marked = marker.finish();
        const std::size_t at = drawn.find("<path d=");
        hatches.insert(at == std::string::npos ? "plain" : drawn.substr(at, drawn.find("stroke", at) - at));
        markers.insert(marked.substr(marked.find("<rect"),
                                     marked.find("fill", marked.find("<rect") + 60) - marked.find("<rect")));
        dashes.insert(seriesDash(s));
        colours.insert(seriesColour(s));
    }
    EXPECT_EQ(hatches.size(), chartStyles);
    EXPECT_EQ(markers.size(), chartStyles);
    EXPECT_EQ(dashes.size(), chartStyles);
    EXPECT_EQ(colours.size(), chartStyles);
}

using Triple = std::array<double, 3>;
using Mixing = std::array<Triple, 3>;

Triple mixed(const Mixing& rows, const Triple& colour) {
    Triple out{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) out[i] += rows[i][j] * colour[j];
    return out;
}

/// Linear red, green and blue of "#0072B2".
Triple lightOf(std::string_view words) {
    Triple light{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double c = std::stoi(std::string{words.substr(1 + 2 * i, 2)}, nullptr, 16) / 255.0;
        light[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    }
    return light;
}

/// CIE L*a*b*, in which 2.3 is a difference that is just seen.
Triple labOf(Triple light) {
    for (double& c : light) c = std::clamp(c, 0.0, 1.0);
    const Triple xyz = mixed({{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}},
                             light),
                 white{0.9505, 1.0, 1.089};
    Triple f{};
    for (std::size_t i = 0; i < 3; ++i)
        f[i] = xyz[i] / white[i] > 0.008856 ? std::cbrt(xyz[i] / white[i])
                                            : 7.787 * xyz[i] / white[i] + 16.0 / 116.0;
    return {116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])};
}

TEST(Charts, ColourBlindReadersSeeEveryColourAsAnother) {
    const std::pair<const char*, Mixing> eyes[] = {
        // Machado and others 2009, complete
        {"without red",
         {{{0.152286, 1.052583, -0.204868},
           {0.114503, 0.786281, 0.099216},
           {-0.003882, -0.048116, 1.051998}}}},
        {"without green",
         {{{0.367322, 0.860646, -0.227968},
           {0.280085, 0.672501, 0.047413},
           {-0.011820, 0.042940, 0.968881}}}},
        {"without blue",
         {{{1.255528, -0.076749, -0.178779},
           {-0.078411, 0.930809, 0.147602},
           {0.004733, 0.691367, 0.303900}}}},
    };
    for (const auto& [words, eye] : eyes) {
        double least = 1000.0;
        for (std::size_t a = 0; a < chartStyles; ++a)
            for (std::size_t b = 0; b < a; ++b) {
                const Triple one = labOf(mixed(eye, lightOf(seriesColour(a)))),
                             other = labOf(mixed(eye, lightOf(seriesColour(b))));
                least = std::min(least, std::hypot(one[0] - other[0], one[1] - other[1], one[2] - other[2]));
            }
        EXPECT_GT(least, 15.0) << words;
        std::cout << words << ": the two that are most alike differ by " << least << '\n';
    }
}

TEST(Charts, AxesHaveRoundTicksAroundAllValues) {
    const ChartAxis axis = ChartAxis::linear(0.0, 93.4);
    EXPECT_EQ(axis.max, 100.0);
    EXPECT_EQ(axis.tickLabels, (std::vector<std::string>{"0", "20", "40", "60", "80", "100"}));
    EXPECT_DOUBLE_EQ(axis.share(25.0), 0.25);
    EXPECT_EQ(ChartAxis::linear(-0.031, 0.042).tickLabels,
              (std::vector<std::string>{"-0.04", "-0.02", "0.00", "0.02", "0.04", "0.06"}));
    const ChartAxis same = ChartAxis::linear(7.0, 7.0);
    EXPECT_LT(same.min, 7.0);
    EXPECT_GT(same.max, 7.0);
    const ChartAxis logarithmic = ChartAxis::logarithmic(0.05, 0.8);
    EXPECT_EQ(logarithmic.tickLabels, (std::vector<std::string>{"0.05", "0.1", "0.2", "0.5"}));
    EXPECT_NEAR(logarithmic.share(0.2), 0.5, 1e-12);
}

TEST(Charts, TurnedNamesOfGroupsEndWithinThePicture) {
    for (std::size_t groups = 2; groups <= 24; ++groups) {
        BarChart chart{{"c", "Scores"}, "condition", "score", {}, {{"", {}}}};
        for (std::size_t g = 0; g < groups; ++g)
            chart.add("condition=cycling stimulus=140 group=expert", {1.0, 1.0, 1.0});
        const std::string svg = barChart(chart);
        const auto numberBehind = [&](const std::string& words, std::size_t from) {
            const std::size_t at = svg.find(words, from);
            return at == svg.npos ? std::nan("") : std::stod(svg.substr(at + words.size()));
        };
        const double height = numberBehind("height=\"", 0),
                     width = textWidth(chart.groups.front(), detail::smallSize);
        for (const double degrees : {35.0, 90.0}) {
            const std::size_t at = svg.find("text-anchor=\"end\" fill=\"#222\" transform=\"rotate(-" +
                                            std::to_string(static_cast<int>(degrees)) + " ");
            if (at == svg.npos) continue;
            const double x = numberBehind("x=\"", svg.rfind("<text", at)),
                         y = numberBehind("y=\"", svg.rfind("<text", at)),
                         angle = degrees * std::numbers::pi / 180.0;
            EXPECT_LE(y + width * std::sin(angle), height) << groups;
            EXPECT_GE(x - width * std::cos(angle), 0.0) << groups;
        }
    }
}

TEST(Charts, BarsAreAsHighAsTheirValues) {
    const auto heightOf = [](double value) {
        const std::string svg = barChart({{"c", "t", false},
                                          "x",
                                          "y",
                                          {"g"},
                                          {{"", {ChartValue{value, value, value}}}},
                                          {},
                                          {},
                                          {},
                                          0.0,
                                          100.0});
        const std::size_t at = svg.find("height=", svg.find("fill=\"#0072B2\"") - 40) + 8;
        return std::stod(svg.substr(at));
    };
    EXPECT_NEAR(heightOf(80.0), 2.0 * heightOf(40.0), 0.02);
    EXPECT_NEAR(heightOf(100.0), 250.0, 0.02);
}

} // namespace physvib::charts_test

// SPDX-License-Identifier: MIT
// Each hit, pulse and phantom of the studies as published, beside what the thesis prescribes of it: what
// differs is in the table of deviations, and what is in the table differs.
#include "Core/EventShaping.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Study/StudyPlan.h"
#include "Lab/Thesis/ThesisPage.h"
#include "Live/Session/OfflineRender.h"
#include "Studies/StudyCalls.h"
#include "Studies/StudyCheck.h"
#include "Support/Has.h"
#include "Thesis/ThesisReport.h"
#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace physvib::thesis_hits_test {

constexpr int rateHz = 48000;

std::string wordAfter(const std::string& call, const std::string& name) {
    const std::size_t from = call.find(name) + name.size();
    return call.substr(from, call.find(' ', from) - from);
}

/// Parts of hits that differ, and the first case of each.
class Differences {
public:
    void expect(HitProperty part, double found, double prescribed, const std::string& call) {
        if (std::abs(found - prescribed) <= 1e-6 * std::max(1.0, std::abs(prescribed))) return;
        add(part, call + ": " + std::to_string(found) + " for " + std::to_string(prescribed));
    }
    void add(HitProperty part, const std::string& words) {
        if (parts.insert(part).second) said += words + "\n";
    }
    std::set<HitProperty> parts;
    std::string said;
};

void comparePattern(const PatternJob& pattern, const PlayableStimulus& felt, Differences& out) {
    const double seconds = std::stod(pattern.label.substr(pattern.label.find('-') + 1)) / 1000.0;
    ASSERT_EQ(felt.stimulus.events.size(), pattern.label.find('-'));
    for (std::size_t k = 0; k < felt.stimulus.events.size(); ++k) {
        const CollisionEvent& e = felt.stimulus.events[k];
        PhantomPanner::Gains gains{};
        felt.stimulus.panner.gainsAt(e.x, e.y, gains);
        for (int j = 0; j < felt.stimulus.panner.channels(); ++j)
            out.expect(HitProperty::gains, gains[static_cast<std::size_t>(j)],
                       j == pattern.label[k] - 'A' ? 1.0 : 0.0, pattern.label);
        out.expect(HitProperty::duration, static_cast<double>(e.timeNs) * 1e-9,
                   static_cast<double>(k) * (seconds + 0.1), pattern.label + " begins");
        out.expect(HitProperty::duration, static_cast<double>(e.durationNs) * 1e-9, seconds, pattern.label);
        out.expect(HitProperty::amplitude, e.amplitude, 1.0, pattern.label);
        out.expect(HitProperty::frequency, e.frequencyHz, 205.0, pattern.label);
        out.expect(HitProperty::decay, e.decayPerSecond, 0.0, pattern.label);
    }
}

/// Eq. 4.2 of actuators at the corners, A upper left to D lower right; of the other conditions Eq. 4.3, which
/// has no value at the far ones.
void comparePhantom(const PhantomJob& phantom, const std::string& condition, const PlayableStimulus& felt,
                    Differences& out) {
    const std::string call = condition + " " + textOf(StimulusJob{phantom});
    ASSERT_EQ(felt.stimulus.events.size(), 1u);
    const CollisionEvent& e = felt.stimulus.events.front();
    const auto& [grid, cell] = std::get<GridPlace>(phantom.target);
    const bool isCorners = condition.find("x") != std::string::npos;
    const auto share = [&](int at, int count) {
        return isCorners ? static_cast<double>(at) / static_cast<double>(count - 1)
                         : (static_cast<double>(at) + 0.5) / static_cast<double>(count);
    };
    const double right = share(cell.column - 1, grid.columns), down = share(cell.row - 1, grid.rows);
    PhantomPanner::Gains gains{};
    felt.stimulus.panner.gainsAt(e.x, e.y, gains);
    const double linear[]{(1 - right) * (1 - down), right * (1 - down), (1 - right) * down, right * down};
    for (std::size_t j = 0; j < 4; ++j) {
        const double dx = j % 2 == 0 ? right : 1 - right, dy = j < 2 ? down : 1 - down;
        const double printed = (1 - std::log2(1 - dx)) * (1 - std::log2(1 - dy));
        out.expect(HitProperty::gains, gains[j], condition.ends_with("LOGARITHM") ? printed : linear[j],
                   call);
    }
    out.expect(HitProperty::duration, static_cast<double>(e.durationNs) * 1e-9, 1.0, call);
    out.expect(HitProperty::amplitude, e.amplitude, 1.0, call);
    out.expect(HitProperty::frequency, e.frequencyHz, 205.0, call);
    out.expect(HitProperty::decay, e.decayPerSecond, 0.0, call);
}

void compareHits(const std::string& call, const PlayableStimulus& felt, double fieldMetres,
                 Differences& out) {
    const std::string pair = wordAfter(call, "pair="), method = wordAfter(call, "--method ");
    const auto [hz, decay] = pair == "wood-wood"     ? std::pair{349.0, 106.99}
                             : pair == "steel-steel" ? std::pair{430.0, 11.97}
                                                     : std::pair{80.0, 34.13};
    const bool isSound = method == "SV", fixesLevel = method.starts_with("AF"),
               fixesFrequency = method.find("FF") != method.npos, fixesDecay = method.ends_with("DRF");
    ASSERT_FALSE(felt.stimulus.events.empty()) << call;
    for (const CollisionEvent& e : felt.stimulus.events) {
        if (isMeanCompensation(e)) {
            out.add(HitProperty::guard, call + ": the mean of a hit is taken off");
            continue;
        }
        const double ofPhysics =
            e.source.impulseNewtonSeconds / (2.0 * e.source.massKg) / (2.0 * fieldMetres); // Eq. 5.4, 5.7
        const double fixed = 1.5 / felt.layout.actuators.front().fullScaleG;
        out.expect(HitProperty::amplitude,
                   e.amplitude * felt.gains.front() / (fixesLevel ? fixed : ofPhysics), 1.0,
                   call + ", share of what is prescribed");
        if (isSound) continue;
        out.expect(HitProperty::frequency, e.frequencyHz, fixesFrequency ? 250.0 : hz, call);
        out.expect(HitProperty::decay, e.decayPerSecond, fixesDecay ? 0.0 : decay, call);
        out.expect(HitProperty::duration, static_cast<double>(e.durationNs) * 1e-9,
                   fixesDecay ? 0.02 : std::log(10.0) / decay, call);
    }
}

Differences differencesOf(const Protocol& protocol) {
    Differences out;
    std::set<std::string> calls;
    for (const PlannedStimulus& planned : plannedStimuli(protocol)) {
        const TrialJob job = planned.job(protocol);
        const std::string call = std::visit([](const auto& one) { return textOf(one); }, job);
        if (!planned.isHighest || !calls.insert(call).second) continue;
        const auto felt = makePlayableStimulus(job, rateHz, protocol.folder);
        EXPECT_TRUE(felt) << felt.error;
        if (!felt) break;
        const auto* const stimulus = std::get_if<StimulusJob>(&job);
        if (stimulus == nullptr)
            compareHits(call, felt.value, call.find("box-study") != call.npos ? 6.4 : 2.9, out);
        else if (const auto* const pattern = std::get_if<PatternJob>(&stimulus->stimulus))
            comparePattern(*pattern, felt.value, out);
        else
            comparePhantom(std::get<PhantomJob>(stimulus->stimulus),
                           protocol.conditions[planned.condition].name, felt.value, out);
    }
    const bool isNormalised = makePlayableWorld({*calls.begin()}).value.setup.normalisesBlocks; // 5.1.3
    for (const CheckedStimulus& one : checkStudy(protocol, 0).stimuli) {
        const std::string name = protocol.name + " " + one.label + " " + one.part;
        if (!isNormalised && one.peakShare > 1.0 + 1e-6)
            out.add(HitProperty::limiter, name + " peaks at " + std::to_string(one.peakG) + " g");
        if (one.minGuardGain < 1.0)
            out.add(HitProperty::guard, name + " down to " + std::to_string(one.minGuardGain));
    }
    return out;
}

TEST(ThesisHits, DifferFromThePrintAsTheTableSays) {
    ASSERT_EQ(thesisVersions().size(), 5u);
    for (const Protocol& protocol : thesisVersions()) {
        std::set<HitProperty> told;
        for (const ThesisDeviation& one : findDeviations(protocol))
            if (one.property != HitProperty::none) told.insert(one.property);
        const Differences found = differencesOf(protocol);
        EXPECT_EQ(found.parts, told) << protocol.name << "\n" << found.said;
    }
}

double scaleG(const PlayableStimulus& felt) {
    return felt.gains.front() * felt.layout.actuators.front().fullScaleG;
}

/// Peak of each hit in g while it sounds, as played or, with `isLimited` false, as asked for.
std::vector<double> peaksOf(const PlayableStimulus& felt, bool isLimited) {
    std::vector<double> samples;
    renderOffline(felt.stimulus.events,
                  {.renderer = {rateHz, 0, felt.stimulus.panner, isLimited},
                   .frames = std::llround(felt.stimulus.seconds * rateHz)},
                  [&](const float* const* channels, int frames) {
                      for (int n = 0; n < frames; ++n) samples.push_back(std::abs(channels[0][n]));
                      return true;
                  });
    std::vector<double> peaks;
    for (const CollisionEvent& e : felt.stimulus.events) {
        const auto from =
                       std::min(samples.size(), static_cast<std::size_t>(e.timeNs * rateHz / 1'000'000'000)),
                   to = std::min(samples.size(), from + rateHz / 50);
        if (isMeanCompensation(e)) continue;
        peaks.push_back(scaleG(felt) * (from < to
                                            ? *std::max_element(samples.begin() + static_cast<long>(from),
                                                                samples.begin() + static_cast<long>(to))
                                            : 0.0));
    }
    return peaks;
}

/// What takes the mean off a hit, and the hit's peak with and without.
std::string meanCompensation(const CollisionEvent& hit, const CollisionEvent& off, double scale) {
    double with = 0.0, without = 0.0;
    for (double t = 0.0; t < 1e-9 * static_cast<double>(off.durationNs); t += 1.0 / rateHz) {
        const double own = hit.amplitude * std::exp(-hit.decayPerSecond * t) *
                           std::sin(2.0 * std::numbers::pi * hit.frequencyHz * t);
        without = std::max(without, scale * std::abs(own));
        with = std::max(with, scale * std::abs(own + off.amplitude * std::sin(2.0 * std::numbers::pi *
                                                                              off.frequencyHz * t)));
    }
    const auto g = [](double value) { return fixedNumber(value, 2) + " g"; };
    return g(-off.amplitude * scale) + " at " + fixedNumber(off.frequencyHz, 0) + " Hz, peak " + g(with) +
           " for " + g(without);
}

TEST(ThesisHits, WhatLimiterAndGuardTakeIsTold) {
    const Protocol protocol = findProtocol("eight-methods-thesis").value;
    std::set<std::string> calls, told;
    double most = 0.0, least = 1.0;
    std::size_t hits = 0, lower = 0;
    for (const PlannedStimulus& planned : plannedStimuli(protocol)) {
        const TrialJob job = planned.job(protocol);
        const std::string call = std::visit([](const auto& one) { return textOf(one); }, job);
        if (!planned.label.starts_with("AF") || !calls.insert(call).second) continue;
        const auto felt = makePlayableStimulus(job, rateHz);
        const auto asked = peaksOf(felt.value, false), played = peaksOf(felt.value, true);
        hits += asked.size();
        for (std::size_t k = 0; k < asked.size(); ++k) {
            lower += played[k] < 0.95 * asked[k];
            most = std::max(most, asked[k]);
            if (asked[k] > 0.1) least = std::min(least, played[k] / asked[k]);
        }
        const auto& events = felt.value.stimulus.events;
        for (std::size_t k = 1; k < events.size(); ++k)
            if (isMeanCompensation(events[k]))
                told.insert(planned.part + ", " + planned.label + ": " +
                            meanCompensation(events[k - 1], events[k], scaleG(felt.value)));
    }
    for (const CheckedStimulus& one : checkStudy(protocol, 0).stimuli)
        EXPECT_EQ(one.minGuardGain, 1.0) << one.label << " " << one.part;
    const auto rowOf = [](HitProperty part) {
        return std::string{std::ranges::find_if(thesisDeviations, [part](const ThesisDeviation& one) {
                               return one.protocol == "eight-methods" && one.property == part;
                           })->inProtocol};
    };
    EXPECT_TRUE(hasAll(rowOf(HitProperty::limiter),
                       {fixedNumber(most, 1) + " g together",
                        fixedNumber(100.0 * static_cast<double>(lower) / static_cast<double>(hits), 0) +
                            " % of hits are weakened, at most to " + fixedNumber(100.0 * least, 0) + " %"}));
    ASSERT_EQ(told.size(), 2U);
    for (const std::string& words : told) {
        EXPECT_TRUE(words.starts_with("rubber-concrete, AF-FV-DR")) << words;
        EXPECT_TRUE(has(rowOf(HitProperty::guard), words.substr(words.find(": ") + 2))) << words;
    }
}

// What is printed and cannot be, what follows from it, and what is marked as simulated.

TEST(Thesis, StandsBesideWhatFollowsFromIt) {
    const auto files = thesisPage().files;
    const std::string transfer = files.at("transfer.csv"), resolutions = files.at("resolutions.csv");
    EXPECT_EQ(timesIn(transfer, ",NO: "), 1u) << transfer;
    EXPECT_TRUE(has(transfer.substr(transfer.rfind("RING-5x5")), "tolerance 1,25,2.62,")) << transfer;
    EXPECT_TRUE(
        hasAll(resolutions, {"PHONE-LINEAR,", "PHONE-LOGARITHM,", "RING-LINEAR,", "RING-LOGARITHM,"}));
    EXPECT_TRUE(hasAll(resolutions, {",5 x 5,5 x 5,", ",5 x 4,5 x 4,", ",6 x 4,6 x 4,", ",7 x 4,7 x 4,"}));
    EXPECT_EQ(timesIn(files.at("printed-tests.csv"), "Table 4.1;"), 24u);
}

TEST(Thesis, RehearsalsAreMarkedAsSimulated) {
    const auto files = thesisReport();
    const std::string html = files.at("index.html");
    EXPECT_TRUE(has(html, "SIMULATED"));
    EXPECT_EQ(timesIn(html, ">SIMULATED</text>"), timesIn(html, ">rehearsed (simulated)<"))
        << "rehearsals' pictures, and no other";
    for (const char* study :
         {"patterns", "phantom-grids", "phantom-places", "model-or-sound", "eight-methods"}) {
        EXPECT_TRUE(has(html, std::string("href=\"") + study + "/index.html\"")) << study;
        EXPECT_TRUE(has(files.at(std::string{study} + "/index.html"), ">SIMULATED</div>")) << study;
    }
}

} // namespace physvib::thesis_hits_test

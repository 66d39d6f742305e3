// SPDX-License-Identifier: GPL-3.0-or-later
// Checks a study by rendering its stimuli without the limiter.
#include "Studies/StudyCheck.h"
#include "Core/Actuators/Exposure.h"
#include "Core/Actuators/OutputGuard.h"
#include "Core/EventShaping.h"
#include "Core/NameNumbers.h"
#include "Core/Units.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/CsvTable.h"
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Report/ReportBuilder.h"
#include "Lab/Study/Stimulus.h"
#include "Lab/Study/StudyPlan.h"
#include "Live/Session/ContactSounds.h"
#include "Live/Session/OfflineRender.h"
#include "Live/Session/SessionRender.h"
#include "Scene/LayoutFile.h"
#include "Studies/StudyCalls.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>

namespace physvib {
namespace {

constexpr int checkRateHz = 48000;
constexpr double longestWithoutBreakSeconds = 30.0 * 60.0;
constexpr double longestSeconds = 3.0 * 3600.0; // of one participant, with breaks
constexpr double weakDb = 6.0; // above the detection threshold; most people feel this at once

/// Minimum gain that the output guard would apply to a stimulus.
class GuardTrial {
public:
    explicit GuardTrial(int channels) { guard_->prepare(checkRateHz, channels, GuardPlace::rendered); }
    /// Processes `blocks` multiplied by `gains`, clipped as by the device.
    void take(const float* const* blocks, const std::vector<float>& gains, int frames) {
        std::array<float*, static_cast<std::size_t>(limits::maxEnchanters)> at{};
        samples_.resize(gains.size() * static_cast<std::size_t>(frames));
        for (std::size_t j = 0; j < gains.size(); ++j) {
            at[j] = samples_.data() + j * static_cast<std::size_t>(frames);
            std::transform(blocks[j], blocks[j] + frames, at[j],
                           [&](float x) { return std::clamp(x * gains[j], -1.0f, 1.0f); });
        }
        guard_->process(at.data(), frames);
        least_ = std::min(least_, static_cast<double>(guard_->gain()));
    }
    double leastGain() const noexcept { return least_; }

private:
    std::unique_ptr<OutputGuard> guard_ = std::make_unique<OutputGuard>();
    std::vector<float> samples_;
    double least_ = 1.0;
};

template <class Number>
void addTo(std::uint64_t& print, const Number* numbers, std::size_t count) {
    print = fnv1a({reinterpret_cast<const char*>(numbers), count * sizeof(Number)}, print);
}

/// Sums of one actuator.
struct ChannelSums {
    double peak = 0.0, squares = 0.0, weightedSquares = 0.0;
    HandWeighting weighting{checkRateHz};
};

void measure(const FeltStimulus& felt, CheckedStimulus& checked) {
    const auto channels = static_cast<std::size_t>(felt.stimulus.panner.channels());
    std::vector<ChannelSums> sums(channels);
    GuardTrial guard{static_cast<int>(channels)};
    const ContactSounds sounds{felt.recordings, checkRateHz};
    const OfflineSettings settings{.renderer = rendererFor(felt.stimulus, checkRateHz),
                                   .frames = std::llround(felt.stimulus.seconds * checkRateHz),
                                   .contacts = {sounds.contacts()}};
    double block = 0.0;
    checked.print = fnv1a({});
    addTo(checked.print, felt.gains.data(), channels);
    renderOffline(felt.stimulus.events, settings, [&](const float* const* blocks, int frames) {
        ++block;
        for (std::size_t j = 0; j < channels; ++j) {
            // silent blocks are left out, as nobody feels how long the silence at the end is
            if (std::any_of(blocks[j], blocks[j] + frames, [](float sample) { return sample != 0.0f; })) {
                const double at[]{block, static_cast<double>(j)};
                addTo(checked.print, at, std::size(at));
                addTo(checked.print, blocks[j], static_cast<std::size_t>(frames));
            }
            for (int n = 0; n < frames; ++n) {
                const double sample = static_cast<double>(blocks[j][n]) * felt.gains[j],
                             weighted = sums[j].weighting.process(sample);
                sums[j].peak = std::max(sums[j].peak, std::abs(sample));
                sums[j].squares += sample * sample;
                sums[j].weightedSquares += weighted * weighted;
            }
        }
        guard.take(blocks, felt.gains, frames);
        return true;
    });
    checked.seconds = felt.stimulus.seconds;
    checked.guardGain = guard.leastGain();
    for (std::size_t j = 0; j < channels; ++j) {
        const double fullScaleG = felt.layout.enchanters[j].fullScaleG;
        if (sums[j].peak > checked.peakShare)
            checked.peakShare = sums[j].peak, checked.neededG = sums[j].peak * fullScaleG;
        checked.peakG = std::max(checked.peakG, sums[j].peak * fullScaleG);
        checked.rmsG = std::max(
            checked.rmsG,
            std::sqrt(sums[j].squares / static_cast<double>(std::max<std::int64_t>(1, settings.frames))) *
                fullScaleG);
        checked.squareGSeconds += sums[j].weightedSquares / checkRateHz * fullScaleG * fullScaleG;
    }
    const auto strongest = std::ranges::max_element(felt.stimulus.events, {}, &CollisionEvent::amplitude);
    if (strongest != felt.stimulus.events.end()) checked.frequencyHz = strongest->frequencyHz;
}

std::string signedNumber(double number, int decimals) {
    return number < 0.0 ? fixedNumber(number, decimals)
                        : std::string{"+"}.append(fixedNumber(number, decimals));
}

std::string nameOf(const Protocol& protocol, const CheckedStimulus& s) {
    std::string name = "condition " + printable(protocol.conditions[s.condition].name) + ", " +
                       (s.label.empty() ? std::string{"any place"} : cleanLine(s.label));
    if (!s.part.empty()) name += ", " + printable(s.part);
    return s.levelDb == 0.0 ? name : name + " at " + signedNumber(s.levelDb, 1) + " dB";
}

double inDb(double share) { return toDecibels(std::max(share, 1e-6)); }

std::string limiterWords(const Protocol& protocol, const CheckedStimulus& s) {
    return nameOf(protocol, s) + ": peaks " + fixedNumber(inDb(s.peakShare), 1) +
           " dB above full scale, which the limiter would lower: expected a layout of at least " +
           fixedNumber(s.neededG, 2) + " g (full_scale_g), or a level that is as much lower";
}

bool needsLimiter(const CheckedStimulus& s) { return s.error.empty() && s.peakShare > 1.0 + fullScaleSlack; }

double aboveThresholdDb(const CheckedStimulus& s) {
    return inDb(s.peakG / detectionThresholdG(s.frequencyHz));
}

void judge(const Protocol& protocol, const CheckedStimulus& s, StudyCheck& check) {
    if (!s.error.empty()) return void(check.errors.push_back(nameOf(protocol, s) + ": " + s.error));
    if (needsLimiter(s)) (s.isOpenEnded ? check.warnings : check.errors).push_back(limiterWords(protocol, s));
    if (s.guardGain < 1.0)
        check.warnings.push_back(
            nameOf(protocol, s) + ": turned down to " + fixedNumber(100.0 * s.guardGain, 0) +
            " % where it is slowest, as its actuator would get nearly direct current: what is "
            "felt differs from what is asked for");
    if (!s.isHighest || s.levelDb <= -limits::maxLevelDb) return; // the latter is meant to be silent
    if (s.peakG <= 0.0)
        check.warnings.push_back(nameOf(protocol, s) + ": nothing is felt");
    else if (const double db = aboveThresholdDb(s); db < weakDb && !s.isOpenEnded)
        check.warnings.push_back(nameOf(protocol, s) + ": weak: " + fixedNumber(1e3 * s.peakG, 1) + " mg, " +
                                 fixedNumber(std::abs(db), 1) + " dB " + (db < 0.0 ? "below" : "above") +
                                 " the threshold of detection at " + fixedNumber(s.frequencyHz, 0) +
                                 " Hz (assumed: " + fixedNumber(1e3 * detectionThresholdG(s.frequencyHz), 0) +
                                 " mg)");
}

using Cells = std::vector<std::string>;

/// Table header, and one row per stimulus.
std::vector<Cells> rowsOf(const Protocol& protocol, const std::vector<CheckedStimulus>& stimuli) {
    std::vector<Cells> rows{{"condition", "stimulus", "part", "level_db", "peak_g", "rms_g",
                             "below_full_scale_db", "above_threshold_db", "seconds"}};
    for (const CheckedStimulus& s : stimuli) {
        Cells& row = rows.emplace_back(Cells{printable(protocol.conditions[s.condition].name),
                                             cleanLine(s.label), cleanLine(s.part), numberText(s.levelDb)});
        if (!s.error.empty())
            row.emplace_back("cannot be played");
        else
            for (const auto& [figure, decimals] : {std::pair{s.peakG, 4},
                                                   {s.rmsG, 4},
                                                   {-inDb(s.peakShare), 1},
                                                   {aboveThresholdDb(s), 1},
                                                   {s.seconds, 2}})
                row.push_back(fixedNumber(figure, decimals));
    }
    return rows;
}

std::string tabbed(const std::vector<Cells>& rows) {
    std::string text;
    for (const Cells& row : rows)
        for (std::size_t c = 0; c < row.size(); ++c) text += row[c] + (c + 1 < row.size() ? "\t" : "\n");
    return text;
}

std::string csvOf(std::vector<Cells> rows) {
    std::string text;
    for (Cells& row : rows) {
        row.resize(rows.front().size());
        text += csvLine(row);
    }
    return text;
}

std::string listOf(const char* what, const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += what + line + "\n";
    return text;
}

std::string minutes(double seconds) { return fixedNumber(seconds / 60.0, 0) + " min"; }

/// The result for a stimulus of the plan at its highest level; null if there is none.
const CheckedStimulus* checkedOf(const std::vector<CheckedStimulus>& all, std::size_t condition,
                                 const std::string& label, const std::string& part) {
    const auto found = std::find_if(all.rbegin(), all.rend(), [&](const CheckedStimulus& s) {
        return s.condition == condition && s.label == label && (s.part == part || part.empty());
    });
    return found != all.rend() ? &*found : nullptr;
}

void judgePlan(const Protocol& protocol, int participants, StudyCheck& check) {
    double squareGSeconds = 0.0; // over all trials of one participant, at one play each
    const PlannedTime time =
        plannedTime(protocol, [&](std::size_t condition, const std::string& label, const std::string& part) {
            const CheckedStimulus* const one = checkedOf(check.stimuli, condition, label, part);
            return one != nullptr ? one->seconds : 0.0;
        });
    for (const PlannedTrials& trials : plannedTrials(protocol))
        if (const CheckedStimulus* const one =
                checkedOf(check.stimuli, trials.condition, trials.label, trials.part))
            squareGSeconds += trials.count * one->squareGSeconds;
    const double exposure = dailyExposure(squareGSeconds);
    check.facts.push_back("trials: " + std::to_string(time.trials) + ", at most " + minutes(time.seconds) +
                          " with breaks, at one play of each part and " +
                          fixedNumber(PlannedTime::answerSeconds, 0) + " s per answer");
    check.facts.push_back("exposure: A(8) " + fixedNumber(exposure, 3) +
                          " m/s2 of one participant on one day, at one play of each part and the highest "
                          "levels (action value " +
                          fixedNumber(exposureActionValue, 1) + ")");
    if (exposure > protocol.exposureLimit)
        check.warnings.push_back("exposure: A(8) of " + fixedNumber(exposure, 2) +
                                 " m/s2 is above the protocol's limit of " +
                                 numberText(protocol.exposureLimit) + ", at which the study pauses");
    if (time.seconds > longestSeconds)
        check.warnings.push_back("time: " + minutes(time.seconds) + " of one participant, more than " +
                                 minutes(longestSeconds) + ": expected fewer repetitions or conditions");
    if (time.longestStretchSeconds > longestWithoutBreakSeconds)
        check.warnings.push_back("breaks: expected one at least every " +
                                 minutes(longestWithoutBreakSeconds) + ", found " +
                                 minutes(time.longestStretchSeconds) + " without");
    if (protocol.conditions.size() < 2 || participants < 1) return;
    const OrderBalance balance = orderBalance(protocol, participants);
    const std::string words = counted(static_cast<std::size_t>(participants), "participant") +
                              ": a condition is at one place " + std::to_string(balance.fewestAtPlace) +
                              " to " + std::to_string(balance.mostAtPlace) + " times; " +
                              std::to_string(balance.successions) + " of " +
                              std::to_string(balance.possibleSuccessions) + " successions occur";
    check.facts.push_back("orders: " + words);
    if (!balance.isBalanced()) check.warnings.push_back("orders are not balanced: " + words);
}

/// Warns about breaks that have no effect.
void judgeBreaks(const Protocol& protocol, StudyCheck& check) {
    for (const SessionPlan& session : protocol.sessions) {
        const std::string at = "breaks of session " + printable(session.name) + ": ";
        if (session.breakEvery > 0 && session.breakSeconds <= 0.0)
            check.warnings.push_back(at + "expected break_s above 0 s beside break_every " +
                                     std::to_string(session.breakEvery) + ", found none");
        if (session.breakEvery == 0 && session.breakSeconds > 0.0)
            check.warnings.push_back(at + "expected break_every beside break_s " +
                                     numberText(session.breakSeconds) + ", found none: there is no break");
    }
}

/// Checks the stimuli of a plan, each call once.
class Stimuli {
public:
    /// `isWhole`: see studyFault().
    Stimuli(const Protocol& protocol, bool isWhole)
        : protocol_{protocol}
        , isWhole_{isWhole} {}

    CheckedStimulus check(const PlannedStimulus& planned) {
        const TrialJob job = planned.job(protocol_);
        const auto* const world = std::get_if<WorldSet>(&protocol_.conditions[planned.condition].stimuli);
        const bool isOpenEnded = world != nullptr && world->hasHands;
        const auto [at, isNew] = made_.try_emplace(textOf(job));
        if (isNew) {
            at->second.print = printOfCall(job);
            if (isWhole_ || (planned.isHighest && !isOpenEnded)) render(job, at->second);
        }
        CheckedStimulus checked = at->second;
        static_cast<PlannedStimulus&>(checked) = planned;
        checked.isOpenEnded = isOpenEnded;
        return checked;
    }

private:
    static std::string textOf(const TrialJob& job) {
        return std::visit([](const auto& one) { return physvib::textOf(one); }, job);
    }
    void render(const TrialJob& job, CheckedStimulus& checked) const {
        if (const auto* const stimulus = std::get_if<StimulusJob>(&job);
            !isWhole_ && stimulus != nullptr && isWithin(*stimulus, checked))
            return;
        const auto felt = feltStimulus(job, checkRateHz, protocol_.folder);
        if (!felt)
            checked.error = felt.error;
        else
            measure(felt.value, checked);
    }
    /// Whether a pulse or phantom is within full scale by the layout's gains alone; then its print and length
    /// follow from them, because a study has hundreds of stimuli.
    bool isWithin(StimulusJob job, CheckedStimulus& checked) const {
        job.layout = besideProtocol(protocol_.folder, job.layout);
        const auto layout = layoutNamed(job.layout);
        const auto made = layout ? makeStimulus(job, layout.value) : Result<Stimulus>{Failure{layout.error}};
        if (!made) return false;
        PhantomPanner::Gains gains{};
        checked.print = fnv1a({});
        for (const CollisionEvent& event : made.value.events) {
            made.value.panner.gainsAt(event.x, event.y, gains);
            const double words[]{static_cast<double>(event.timeNs), event.frequencyHz, event.decayPerSecond,
                                 static_cast<double>(event.durationNs)};
            addTo(checked.print, words, std::size(words));
            for (std::size_t j = 0; j < layout.value.enchanters.size(); ++j) {
                const double share = event.amplitude * gains[j] / layout.value.enchanters[j].fullScaleG;
                if (std::abs(share) > 1.0) return false;
                addTo(checked.print, &share, 1);
            }
        }
        checked.seconds = made.value.seconds;
        return true;
    }

    const Protocol& protocol_;
    bool isWhole_;
    std::map<std::string, CheckedStimulus> made_; // by call
};

} // namespace

std::uint64_t printOfCall(const TrialJob& job) {
    return std::visit([](const auto& one) { return fnv1a(textOf(one)); }, job);
}

StudyCheck checkStudy(const Protocol& protocol, int participants, const std::function<bool()>& goesOn) {
    StudyCheck check;
    Stimuli stimuli{protocol, true};
    std::set<std::string> spreadParts;
    for (const PlannedStimulus& planned : plannedStimuli(protocol)) {
        if (goesOn && !goesOn()) return check;
        if (planned.isSpread) spreadParts.insert(cleanLine(planned.part));
        check.stimuli.push_back(stimuli.check(planned));
    }
    check.facts.push_back("levels in g: samples as rendered, without the limiter, times the full scale of " +
                          fullScales(protocol));
    if (!spreadParts.empty())
        check.facts.push_back("levels: sessions can reach more than " + std::to_string(mostPlannedLevels) +
                              " of " +
                              listed(std::vector<std::string>{spreadParts.begin(), spreadParts.end()}) +
                              ", so " + std::to_string(mostPlannedLevels + 1) +
                              " were rendered, evenly spread from the lowest to the highest");
    for (const CheckedStimulus& s : check.stimuli) judge(protocol, s, check);
    judgeRules(protocol, check);
    judgePlan(protocol, participants, check);
    judgeBreaks(protocol, check);
    for (const ThesisDeviation& one : deviationsOf(protocol))
        check.deviations.push_back(std::string{one.section}
                                       .append(": ")
                                       .append(one.thesis)
                                       .append("; here: ")
                                       .append(one.here)
                                       .append(one.change.empty() ? "" : "; as published: ")
                                       .append(one.change));
    return check;
}

std::string textOf(const StudyCheck& check, const Protocol& protocol) {
    return tabbed(rowsOf(protocol, check.stimuli)) + "\n" + listOf("", check.facts) +
           listOf("deviation from the thesis, ", check.deviations) + listOf("error: ", check.errors) +
           listOf("warning: ", check.warnings);
}

std::string htmlOf(const StudyCheck& check, const Protocol& protocol) {
    ReportPage page{"Study check: " + printable(protocol.name), false};
    page.paragraph(cleanLine(protocol.title));
    page.heading("Errors and warnings");
    if (check.errors.empty() && check.warnings.empty()) page.paragraph("None was found.");
    for (const auto& [what, lines] : {std::pair{"Errors: the study is refused", &check.errors},
                                      {"Warnings: for a person to decide", &check.warnings}}) {
        if (lines->empty()) continue;
        page.subheading(what);
        page.list(*lines);
    }
    page.heading("Plan");
    page.list(check.facts);
    if (!check.deviations.empty()) {
        page.subheading("Deviations from the thesis");
        page.list(check.deviations);
    }
    page.heading("Stimuli");
    page.paragraph(
        "Of the strongest actuator, at the lowest and the highest level that a session can set (at "
        "each, where a level is more than a gain), without the limiter. peak_g and rms_g are accelerations "
        "in g; above_threshold_db is the peak over an "
        "assumed threshold of detection.");
    page.table(csvOf(rowsOf(protocol, check.stimuli)), "physvib study check", check.stimuli.size());
    return page.html();
}

std::string studyFault(const Protocol& protocol) {
    StudyCheck check;
    Stimuli stimuli{protocol, false};
    for (const PlannedStimulus& planned : plannedStimuli(protocol)) {
        check.stimuli.push_back(stimuli.check(planned));
        judge(protocol, check.stimuli.back(), check);
        if (!check.errors.empty()) return check.errors.front();
    }
    judgeRules(protocol, check);
    return check.errors.empty() ? std::string{} : check.errors.front();
}

} // namespace physvib

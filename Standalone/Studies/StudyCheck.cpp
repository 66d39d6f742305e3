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
#include "Lab/Study/StimulusJob.h"
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
constexpr double maxSecondsWithoutBreak = 30.0 * 60.0;
constexpr double maxStudySeconds = 3.0 * 3600.0; // of one participant, with breaks
constexpr double minSensationLevelDb = 6.0; // above the detection threshold; most people feel this at once

/// Minimum gain that the output guard would apply to a stimulus.
class GuardSimulation {
public:
    explicit GuardSimulation(int channels) { guard_->prepare(checkRateHz, channels, GuardPlace::rendered); }
    /// Processes `blocks` multiplied by `gains`, clipped as by the device.
    void process(const float* const* blocks, const std::vector<float>& gains, int frames) {
        std::array<float*, static_cast<std::size_t>(limits::maxActuators)> channels{};
        samples_.resize(gains.size() * static_cast<std::size_t>(frames));
        for (std::size_t j = 0; j < gains.size(); ++j) {
            channels[j] = samples_.data() + j * static_cast<std::size_t>(frames);
            std::transform(blocks[j], blocks[j] + frames, channels[j],
                           [&](float x) { return std::clamp(x * gains[j], -1.0f, 1.0f); });
        }
        guard_->process(channels.data(), frames);
        minGain_ = std::min(minGain_, static_cast<double>(guard_->gain()));
    }
    double minGain() const noexcept { return minGain_; }

private:
    std::unique_ptr<OutputGuard> guard_ = std::make_unique<OutputGuard>();
    std::vector<float> samples_;
    double minGain_ = 1.0;
};

template <class Number>
void addToHash(std::uint64_t& hash, const Number* numbers, std::size_t count) {
    hash = fnv1a({reinterpret_cast<const char*>(numbers), count * sizeof(Number)}, hash);
}

/// Peak and sums of squares of one actuator's samples, in shares of full scale.
struct ChannelSums {
    double peak = 0.0, squares = 0.0, weightedSquares = 0.0;
    HandWeighting weighting{checkRateHz};
};

void measure(const PlayableStimulus& playable, CheckedStimulus& checked) {
    const auto channels = static_cast<std::size_t>(playable.stimulus.panner.channels());
    std::vector<ChannelSums> sums(channels);
    GuardSimulation guard{static_cast<int>(channels)};
    const ContactSounds sounds{playable.recordings, checkRateHz};
    const OfflineSettings settings{.renderer = rendererFor(playable.stimulus, checkRateHz),
                                   .frames = std::llround(playable.stimulus.seconds * checkRateHz),
                                   .contacts = {sounds.contacts()}};
    double block = 0.0;
    checked.samplesHash = fnv1a({});
    addToHash(checked.samplesHash, playable.gains.data(), channels);
    renderOffline(playable.stimulus.events, settings, [&](const float* const* blocks, int frames) {
        ++block;
        for (std::size_t j = 0; j < channels; ++j) {
            // silent blocks are left out of the hash: the length of silence at the end is not felt
            if (std::any_of(blocks[j], blocks[j] + frames, [](float sample) { return sample != 0.0f; })) {
                const double position[]{block, static_cast<double>(j)};
                addToHash(checked.samplesHash, position, std::size(position));
                addToHash(checked.samplesHash, blocks[j], static_cast<std::size_t>(frames));
            }
            for (int n = 0; n < frames; ++n) {
                const double sample = static_cast<double>(blocks[j][n]) * playable.gains[j],
                             weighted = sums[j].weighting.process(sample);
                sums[j].peak = std::max(sums[j].peak, std::abs(sample));
                sums[j].squares += sample * sample;
                sums[j].weightedSquares += weighted * weighted;
            }
        }
        guard.process(blocks, playable.gains, frames);
        return true;
    });
    checked.seconds = playable.stimulus.seconds;
    checked.minGuardGain = guard.minGain();
    for (std::size_t j = 0; j < channels; ++j) {
        const double fullScaleG = playable.layout.actuators[j].fullScaleG;
        if (sums[j].peak > checked.peakShare)
            checked.peakShare = sums[j].peak, checked.requiredFullScaleG = sums[j].peak * fullScaleG;
        checked.peakG = std::max(checked.peakG, sums[j].peak * fullScaleG);
        checked.rmsG = std::max(
            checked.rmsG,
            std::sqrt(sums[j].squares / static_cast<double>(std::max<std::int64_t>(1, settings.frames))) *
                fullScaleG);
        checked.squareGSeconds += sums[j].weightedSquares / checkRateHz * fullScaleG * fullScaleG;
    }
    const auto strongest = std::ranges::max_element(playable.stimulus.events, {}, &CollisionEvent::amplitude);
    if (strongest != playable.stimulus.events.end()) checked.frequencyHz = strongest->frequencyHz;
}

std::string signedNumber(double number, int decimals) {
    return number < 0.0 ? fixedNumber(number, decimals)
                        : std::string{"+"}.append(fixedNumber(number, decimals));
}

std::string stimulusName(const Protocol& protocol, const CheckedStimulus& s) {
    std::string name = "condition " + printable(protocol.conditions[s.condition].name) + ", " +
                       (s.label.empty() ? std::string{"any place"} : cleanLine(s.label));
    if (!s.part.empty()) name += ", " + printable(s.part);
    return s.levelDb == 0.0 ? name : name + " at " + signedNumber(s.levelDb, 1) + " dB";
}

double toDb(double share) { return toDecibels(std::max(share, 1e-6)); }

std::string limiterText(const Protocol& protocol, const CheckedStimulus& s) {
    return stimulusName(protocol, s) + ": peaks " + fixedNumber(toDb(s.peakShare), 1) +
           " dB above full scale, which the limiter would lower: expected a layout of at least " +
           fixedNumber(s.requiredFullScaleG, 2) + " g (full_scale_g), or a level that is as much lower";
}

bool needsLimiter(const CheckedStimulus& s) { return s.error.empty() && s.peakShare > 1.0 + fullScaleSlack; }

double sensationLevelDb(const CheckedStimulus& s) {
    return toDb(s.peakG / detectionThresholdG(s.frequencyHz));
}

void addFindings(const Protocol& protocol, const CheckedStimulus& s, StudyCheck& check) {
    if (!s.error.empty()) return void(check.errors.push_back(stimulusName(protocol, s) + ": " + s.error));
    if (needsLimiter(s)) (s.isOpenEnded ? check.warnings : check.errors).push_back(limiterText(protocol, s));
    if (s.minGuardGain < 1.0)
        check.warnings.push_back(
            stimulusName(protocol, s) + ": turned down to " + fixedNumber(100.0 * s.minGuardGain, 0) +
            " % where it is slowest, as its actuator would get nearly direct current: what is "
            "felt differs from what is asked for");
    if (!s.isHighest || s.levelDb <= -limits::maxLevelDb) return; // the lowest level is meant to be silent
    if (s.peakG <= 0.0)
        check.warnings.push_back(stimulusName(protocol, s) + ": nothing is felt");
    else if (const double db = sensationLevelDb(s); db < minSensationLevelDb && !s.isOpenEnded)
        check.warnings.push_back(
            stimulusName(protocol, s) + ": weak: " + fixedNumber(1e3 * s.peakG, 1) + " mg, " +
            fixedNumber(std::abs(db), 1) + " dB " + (db < 0.0 ? "below" : "above") +
            " the threshold of detection at " + fixedNumber(s.frequencyHz, 0) +
            " Hz (assumed: " + fixedNumber(1e3 * detectionThresholdG(s.frequencyHz), 0) + " mg)");
}

using Cells = std::vector<std::string>;

/// Table header, and one row per stimulus.
std::vector<Cells> makeRows(const Protocol& protocol, const std::vector<CheckedStimulus>& stimuli) {
    std::vector<Cells> rows{{"condition", "stimulus", "part", "level_db", "peak_g", "rms_g",
                             "below_full_scale_db", "above_threshold_db", "seconds"}};
    for (const CheckedStimulus& s : stimuli) {
        Cells& row = rows.emplace_back(Cells{printable(protocol.conditions[s.condition].name),
                                             cleanLine(s.label), cleanLine(s.part), numberText(s.levelDb)});
        if (!s.error.empty())
            row.emplace_back("cannot be played");
        else
            for (const auto& [value, decimals] : {std::pair{s.peakG, 4},
                                                  {s.rmsG, 4},
                                                  {-toDb(s.peakShare), 1},
                                                  {sensationLevelDb(s), 1},
                                                  {s.seconds, 2}})
                row.push_back(fixedNumber(value, decimals));
    }
    return rows;
}

std::string toTabLines(const std::vector<Cells>& rows) {
    std::string text;
    for (const Cells& row : rows)
        for (std::size_t c = 0; c < row.size(); ++c) text += row[c] + (c + 1 < row.size() ? "\t" : "\n");
    return text;
}

std::string toCsv(std::vector<Cells> rows) {
    std::string text;
    for (Cells& row : rows) {
        row.resize(rows.front().size());
        text += csvLine(row);
    }
    return text;
}

std::string prefixLines(const char* prefix, const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += prefix + line + "\n";
    return text;
}

std::string toMinutes(double seconds) { return fixedNumber(seconds / 60.0, 0) + " min"; }

/// The result for a stimulus of the plan at its highest level; null if there is none.
const CheckedStimulus* findChecked(const std::vector<CheckedStimulus>& results, std::size_t condition,
                                   const std::string& label, const std::string& part) {
    const auto result = std::find_if(results.rbegin(), results.rend(), [&](const CheckedStimulus& s) {
        return s.condition == condition && s.label == label && (s.part == part || part.empty());
    });
    return result != results.rend() ? &*result : nullptr;
}

void checkPlan(const Protocol& protocol, int participants, StudyCheck& check) {
    double squareGSeconds = 0.0; // over all trials of one participant, at one play each
    const PlannedTime time =
        plannedTime(protocol, [&](std::size_t condition, const std::string& label, const std::string& part) {
            const CheckedStimulus* const checked = findChecked(check.stimuli, condition, label, part);
            return checked != nullptr ? checked->seconds : 0.0;
        });
    for (const PlannedTrials& trials : plannedTrials(protocol))
        if (const CheckedStimulus* const checked =
                findChecked(check.stimuli, trials.condition, trials.label, trials.part))
            squareGSeconds += trials.count * checked->squareGSeconds;
    const double exposure = dailyExposure(squareGSeconds);
    check.facts.push_back("trials: " + std::to_string(time.trials) + ", at most " + toMinutes(time.seconds) +
                          " with breaks, at one play of each part and " +
                          fixedNumber(PlannedTime::answerSeconds, 0) + " s per answer");
    check.facts.push_back("exposure: A(8) " + fixedNumber(exposure, 3) +
                          " m/s2 of one participant on one day, at one play of each part and the highest "
                          "levels (action value " +
                          fixedNumber(exposureActionMetresPerSecond2, 1) + ")");
    if (exposure > protocol.exposureLimit)
        check.warnings.push_back("exposure: A(8) of " + fixedNumber(exposure, 2) +
                                 " m/s2 is above the protocol's limit of " +
                                 numberText(protocol.exposureLimit) + ", at which the study pauses");
    if (time.seconds > maxStudySeconds)
        check.warnings.push_back("time: " + toMinutes(time.seconds) + " of one participant, more than " +
                                 toMinutes(maxStudySeconds) + ": expected fewer repetitions or conditions");
    if (time.maxStretchSeconds > maxSecondsWithoutBreak)
        check.warnings.push_back("breaks: expected one at least every " + toMinutes(maxSecondsWithoutBreak) +
                                 ", found " + toMinutes(time.maxStretchSeconds) + " without");
    if (protocol.conditions.size() < 2 || participants < 1) return;
    const OrderBalance balance = orderBalance(protocol, participants);
    const std::string balanceText = plural(static_cast<std::size_t>(participants), "participant") +
                                    ": a condition is at one place " + std::to_string(balance.minAtPosition) +
                                    " to " + std::to_string(balance.maxAtPosition) + " times; " +
                                    std::to_string(balance.successions) + " of " +
                                    std::to_string(balance.possibleSuccessions) + " successions occur";
    check.facts.push_back("orders: " + balanceText);
    if (!balance.isBalanced()) check.warnings.push_back("orders are not balanced: " + balanceText);
}

/// Warns about breaks that have no effect.
void checkBreaks(const Protocol& protocol, StudyCheck& check) {
    for (const SessionPlan& session : protocol.sessions) {
        const std::string prefix = "breaks of session " + printable(session.name) + ": ";
        if (session.breakEvery > 0 && session.breakSeconds <= 0.0)
            check.warnings.push_back(prefix + "expected break_s above 0 s beside break_every " +
                                     std::to_string(session.breakEvery) + ", found none");
        if (session.breakEvery == 0 && session.breakSeconds > 0.0)
            check.warnings.push_back(prefix + "expected break_every beside break_s " +
                                     numberText(session.breakSeconds) + ", found none: there is no break");
    }
}

/// Checks the stimuli of a plan, each call once.
class StimulusChecker {
public:
    /// `isComplete`: see findStudyError().
    StimulusChecker(const Protocol& protocol, bool isComplete)
        : protocol_{protocol}
        , isComplete_{isComplete} {}

    CheckedStimulus check(const PlannedStimulus& planned) {
        const TrialJob job = planned.job(protocol_);
        const auto* const world = std::get_if<WorldSet>(&protocol_.conditions[planned.condition].stimuli);
        const bool isOpenEnded = world != nullptr && world->isInteractive;
        const auto [entry, isNew] = checked_.try_emplace(textOf(job));
        if (isNew) {
            entry->second.samplesHash = callHash(job);
            if (isComplete_ || (planned.isHighest && !isOpenEnded)) render(job, entry->second);
        }
        CheckedStimulus checked = entry->second;
        static_cast<PlannedStimulus&>(checked) = planned;
        checked.isOpenEnded = isOpenEnded;
        return checked;
    }

private:
    static std::string textOf(const TrialJob& job) {
        return std::visit([](const auto& typedJob) { return physvib::textOf(typedJob); }, job);
    }
    void render(const TrialJob& job, CheckedStimulus& checked) const {
        if (const auto* const stimulus = std::get_if<StimulusJob>(&job);
            !isComplete_ && stimulus != nullptr && isWithinFullScale(*stimulus, checked))
            return;
        const auto playable = makePlayableStimulus(job, checkRateHz, protocol_.folder);
        if (!playable)
            checked.error = playable.error;
        else
            measure(playable.value, checked);
    }
    /// Whether a pulse or phantom is within full scale by the layout's gains alone. Then its hash and
    /// duration are set without rendering it, because a study has hundreds of stimuli.
    bool isWithinFullScale(StimulusJob job, CheckedStimulus& checked) const {
        job.layout = resolveProtocolPath(protocol_.folder, job.layout);
        const auto layout = resolveLayout(job.layout);
        const auto pulse = layout ? makeStimulus(job, layout.value) : Result<Stimulus>{Failure{layout.error}};
        if (!pulse) return false;
        PhantomPanner::Gains gains{};
        checked.samplesHash = fnv1a({});
        for (const CollisionEvent& event : pulse.value.events) {
            pulse.value.panner.gainsAt(event.x, event.y, gains);
            const double values[]{static_cast<double>(event.timeNs), event.frequencyHz, event.decayPerSecond,
                                  static_cast<double>(event.durationNs)};
            addToHash(checked.samplesHash, values, std::size(values));
            for (std::size_t j = 0; j < layout.value.actuators.size(); ++j) {
                const double share = event.amplitude * gains[j] / layout.value.actuators[j].fullScaleG;
                if (std::abs(share) > 1.0) return false;
                addToHash(checked.samplesHash, &share, 1);
            }
        }
        checked.seconds = pulse.value.seconds;
        return true;
    }

    const Protocol& protocol_;
    bool isComplete_;
    std::map<std::string, CheckedStimulus> checked_; // by call
};

} // namespace

std::uint64_t callHash(const TrialJob& job) {
    return std::visit([](const auto& typedJob) { return fnv1a(textOf(typedJob)); }, job);
}

StudyCheck checkStudy(const Protocol& protocol, int participants, const std::function<bool()>& keepGoing) {
    StudyCheck check;
    StimulusChecker stimuli{protocol, true};
    std::set<std::string> spacedParts;
    for (const PlannedStimulus& planned : plannedStimuli(protocol)) {
        if (keepGoing && !keepGoing()) return check;
        if (planned.isEvenlySpaced) spacedParts.insert(cleanLine(planned.part));
        check.stimuli.push_back(stimuli.check(planned));
    }
    check.facts.push_back("levels in g: samples as rendered, without the limiter, times the full scale of " +
                          fullScales(protocol));
    if (!spacedParts.empty())
        check.facts.push_back("levels: sessions can reach more than " + std::to_string(maxPlannedLevels) +
                              " of " +
                              nameList(std::vector<std::string>{spacedParts.begin(), spacedParts.end()}) +
                              ", so " + std::to_string(maxPlannedLevels + 1) +
                              " were rendered, evenly spread from the lowest to the highest");
    for (const CheckedStimulus& s : check.stimuli) addFindings(protocol, s, check);
    checkRules(protocol, check);
    checkPlan(protocol, participants, check);
    checkBreaks(protocol, check);
    for (const ThesisDeviation& deviation : findDeviations(protocol))
        check.deviations.push_back(std::string{deviation.section}
                                       .append(": ")
                                       .append(deviation.inThesis)
                                       .append("; here: ")
                                       .append(deviation.inProtocol)
                                       .append(deviation.change.empty() ? "" : "; as published: ")
                                       .append(deviation.change));
    return check;
}

std::string toText(const StudyCheck& check, const Protocol& protocol) {
    return toTabLines(makeRows(protocol, check.stimuli)) + "\n" + prefixLines("", check.facts) +
           prefixLines("deviation from the thesis, ", check.deviations) +
           prefixLines("error: ", check.errors) + prefixLines("warning: ", check.warnings);
}

std::string toHtml(const StudyCheck& check, const Protocol& protocol) {
    ReportPage page{"Study check: " + printable(protocol.name), false};
    page.addParagraph(cleanLine(protocol.title));
    page.addHeading("Errors and warnings");
    if (check.errors.empty() && check.warnings.empty()) page.addParagraph("None was found.");
    for (const auto& [heading, lines] : {std::pair{"Errors: the study is refused", &check.errors},
                                         {"Warnings: for a person to decide", &check.warnings}}) {
        if (lines->empty()) continue;
        page.addSubheading(heading);
        page.addList(*lines);
    }
    page.addHeading("Plan");
    page.addList(check.facts);
    if (!check.deviations.empty()) {
        page.addSubheading("Deviations from the thesis");
        page.addList(check.deviations);
    }
    page.addHeading("Stimuli");
    page.addParagraph(
        "Of the strongest actuator, at the lowest and the highest level that a session can set (at "
        "each, where a level is more than a gain), without the limiter. peak_g and rms_g are accelerations "
        "in g; above_threshold_db is the peak over an "
        "assumed threshold of detection.");
    page.addTable(toCsv(makeRows(protocol, check.stimuli)), "physvib study check", check.stimuli.size());
    return page.html();
}

std::string findStudyError(const Protocol& protocol) {
    StudyCheck check;
    StimulusChecker stimuli{protocol, false};
    for (const PlannedStimulus& planned : plannedStimuli(protocol)) {
        check.stimuli.push_back(stimuli.check(planned));
        addFindings(protocol, check.stimuli.back(), check);
        if (!check.errors.empty()) return check.errors.front();
    }
    checkRules(protocol, check);
    return check.errors.empty() ? std::string{} : check.errors.front();
}

} // namespace physvib

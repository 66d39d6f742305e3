// SPDX-License-Identifier: MIT
// Response models of the simulated observer, one per task.
#include "Lab/Study/SimulatedObserver.h"
#include "Core/Units.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace physvib {
namespace {

/// Rounds to a multiple of 1/perUnit, so that the number prints with few digits.
double roundTo(double value, double perUnit) { return std::round(value * perUnit) / perUnit; }

/// True if the method name contains this varying part, e.g. "AV" in AV-FF-DRV.
bool varies(const std::string& label, const char* part) {
    return ("-" + label + "-").find(std::string("-") + part + "-") != std::string::npos;
}

/// Means as the thesis prints them; spreads so that its printed tests follow (ObserverTest checks this).
ObserverSettings thesisObserver(ObserverSettings settings) {
    settings.placeBlur = 0.2073;
    settings.ringBlur = 0.1524;
    settings.blurSpread = 0.11;
    settings.pulsePlaceConfusion = 0.0129; // 92.1 % of patterns right
    settings.preferenceSpread = 0.15;
    settings.amplitudeSpread = 10.2;
    settings.frequencySpread = 14.7;
    settings.decaySpread = 3.6;
    return settings;
}

/// Individual parameters of a participant, from the seed and the number alone.
ObserverSettings individualObserver(ObserverSettings settings, const Protocol& protocol,
                                    const Participant& participant) {
    SeededRandom random{static_cast<std::uint64_t>(protocol.seed),
                        "observer/" + std::to_string(participant.number) + "/self"};
    settings.placeBlur *= std::exp(settings.blurSpread * random.normal());
    settings.ringBlur *= std::exp(settings.blurSpread * random.normal());
    settings.firstAlternativePreference = std::clamp(
        settings.firstAlternativePreference + settings.preferenceSpread * random.normal(), 0.0, 1.0);
    settings.amplitudeScore += settings.amplitudeSpread * random.normal();
    settings.frequencyScore += settings.frequencySpread * random.normal();
    settings.decayScore += settings.decaySpread * random.normal();
    return settings;
}

/// Level of the alternative that an adjustment is compared with.
double comparedLevelDb(const SessionPlan& session) {
    for (const Alternative& alternative : session.alternatives)
        if (alternative.name != session.adjustment->alternative) return alternative.levelDb;
    return 0.0;
}

/// The answer to one trial: the model of each task, and the random numbers of the trial.
struct Response {
    const ObserverSettings& settings;
    const SessionPlan& session;
    const ConditionPlan& condition;
    const Trial& trial;
    SeededRandom random;

    Answer answer() {
        Answer answer;
        answer.plays =
            1 + static_cast<int>(random.below(
                    session.maxPlays == 0 ? 3 : static_cast<std::size_t>(std::min(3, session.maxPlays))));
        const double playedSeconds = session.minSeconds *
                                     static_cast<double>(std::max<std::size_t>(1, trial.parts.size())),
                     thinkingSeconds = 0.8 - 1.5 * std::log(1.0 - random.uniform());
        answer.timedOut = session.answerSeconds > 0.0 && thinkingSeconds > session.answerSeconds;
        answer.seconds =
            roundTo(playedSeconds + (answer.timedOut ? session.answerSeconds : thinkingSeconds), 1000.0);
        if (answer.timedOut) return answer;
        switch (session.answerKind()) {
        case AnswerKind::request:
            if (session.minTouches > 0)
                answer.place = FieldPlace{roundTo(random.uniform(), 1e4), roundTo(random.uniform(), 1e4)};
            else
                answer.response = requestedLabel();
            break;
        case AnswerKind::label: answer.response = identifiedLabel(); break;
        case AnswerKind::place:
            answer.place = perceivedPlace(std::get<GridSet>(condition.stimuli).grid());
            break;
        case AnswerKind::choice:
            answer.response = session.answers.empty() ? chosenAlternative() : answerByRank();
            break;
        case AnswerKind::scores:
            for (std::size_t s = 0; s < session.scores().size(); ++s) {
                const double score = ratingScore();
                answer.scores.push_back(
                    session.points > 0 ? 1.0 + std::round(0.01 * score * (session.points - 1)) : score);
            }
            break;
        case AnswerKind::level:
            answer.value =
                std::clamp(roundTo(comparedLevelDb(session) + settings.levelNoiseDb * random.normal(),
                                   1.0 / session.adjustment->stepDb),
                           session.adjustment->minDb, session.adjustment->maxDb);
            break;
        case AnswerKind::number:
            answer.value = std::clamp(magnitudeEstimate(), minEstimate, maxEstimate);
            break;
        case AnswerKind::words: answer.response = verbalAnswer(); break;
        }
        return answer;
    }

private:
    std::string requestedLabel() const {
        const auto items = conditionStimuli(condition);
        return items[static_cast<std::size_t>(trial.number - 1) % items.size()].label;
    }

    std::string identifiedLabel() {
        if (const auto* patterns = std::get_if<PatternSet>(&condition.stimuli))
            return patternLabel(perceivedPattern(*parsePatternLabel(trial.stimulus), *patterns));
        if (const auto* set = std::get_if<GridSet>(&condition.stimuli))
            return gridLabel(set->grid().nearest(perceivedPlace(set->grid())));
        const auto items = conditionStimuli(condition); // unknown kind of stimulus: confused at a fixed rate
        return random.chance(settings.pulsePlaceConfusion) ? items[random.below(items.size())].label
                                                           : trial.stimulus;
    }

    PulsePattern perceivedPattern(PulsePattern pattern, const PatternSet& set) {
        const auto otherCount = static_cast<std::size_t>(set.enchanters - 1);
        for (int k = 0; k < pattern.count; ++k) {
            int& place = pattern.actuators[static_cast<std::size_t>(k)];
            if (otherCount > 0 && random.chance(settings.pulsePlaceConfusion))
                place = (place + 1 + static_cast<int>(random.below(otherCount))) % set.enchanters;
        }
        if (set.pulseSeconds.size() > 1 && random.chance(settings.durationConfusion)) {
            const double played = pattern.pulseSeconds;
            do pattern.pulseSeconds = set.pulseSeconds[random.below(set.pulseSeconds.size())];
            while (pattern.pulseSeconds == played);
        }
        if (pattern.count > 1 && random.chance(settings.numerosityConfusion)) --pattern.count;
        return pattern;
    }

    double blur() const noexcept {
        if (condition.observerBlur > 0.0) return condition.observerBlur;
        return settings.ringBlur > 0.0 && condition.layout.starts_with("ring") ? settings.ringBlur
                                                                               : settings.placeBlur;
    }

    FieldPlace perceivedPlace(const PhantomGrid& grid) {
        const auto perceive = [&](double position, double offset) {
            const double middle = 0.5 + (1.0 - settings.centralTendency) * (position - 0.5) + offset;
            return roundTo(std::clamp(middle + blur() * random.normal(), 0.0, 1.0), 1e6);
        };
        const FieldPlace place = grid.place(*targetCell(condition, trial));
        const double x = perceive(place.x, settings.offsetX);
        return {x, perceive(place.y, settings.offsetY)};
    }

    /// Rank of the stimulus among all, by its number or its position in the list, from 0 to 1.
    double relativeRank() const {
        const auto items = conditionStimuli(condition);
        const auto number = parseNumber<double>(trial.stimulus);
        const auto before =
            number ? std::ranges::count_if(
                         items,
                         [&](const StimulusItem& item) { return parseNumber<double>(item.label) < number; })
                   : std::ranges::find(items, trial.stimulus, &StimulusItem::label) - items.begin();
        return (static_cast<double>(before) + 0.5) / static_cast<double>(items.size());
    }

    /// Picks the stronger of two different levels; otherwise the first listed alternative, by its preference.
    std::string chosenAlternative() {
        if (session.adaptedAlternative()) {
            std::size_t strongest = 0;
            double maxPerceivedDb = -1e9;
            for (std::size_t i = 0; i < trial.parts.size(); ++i)
                if (const double perceivedDb =
                        trial.partLevelsDb[i] + settings.levelNoiseDb * random.normal();
                    perceivedDb > maxPerceivedDb) {
                    maxPerceivedDb = perceivedDb;
                    strongest = i;
                }
            return trial.parts[strongest];
        }
        if (!session.correct.empty()) // more often correct at higher ranks
            return random.chance(1.25 * relativeRank() - 0.125)
                       ? session.correct
                       : session.alternatives[random.below(session.alternatives.size())].name;
        if (random.chance(settings.firstAlternativePreference)) return session.alternatives.front().name;
        return session.alternatives[1 + random.below(session.alternatives.size() - 1)].name;
    }

    /// The answer at the stimulus' rank in the list of answers, with noise.
    std::string answerByRank() {
        const double share = relativeRank() + 0.2 * random.normal();
        return session.answers[static_cast<std::size_t>(std::clamp(share, 0.0, 0.999) *
                                                        static_cast<double>(session.answers.size()))];
    }

    /// Answers with characters that CSV, HTML and spreadsheets must not change; sometimes empty.
    std::string verbalAnswer() {
        static constexpr std::array words{"weak, short", "like \"tapping\"", "=strong", "<rough> & deep",
                                          "\uac15\ud55c"};
        if (session.mayBeEmpty && random.chance(0.25)) return {};
        return words[random.below(words.size())];
    }

    double ratingScore() {
        const double score = settings.scoreBase + settings.amplitudeScore * varies(trial.stimulus, "AV") +
                             settings.frequencyScore * varies(trial.stimulus, "FV") +
                             settings.decayScore * varies(trial.stimulus, "DRV") +
                             settings.scoreNoise * random.normal();
        return std::round(std::clamp(score, 0.0, 100.0));
    }

    /// Stevens' power law with an exponent near one and the same level noise.
    double magnitudeEstimate() {
        const double levelG = parseNumber<double>(trial.stimulus).value_or(condition.levelG);
        const double db =
            toDecibels(std::max(levelG, 1e-6)) + trial.levelDb + settings.levelNoiseDb * random.normal();
        return std::max(0.01, roundTo(10.0 * fromDecibels(0.9 * db), 100.0));
    }
};

} // namespace

std::optional<ObserverSettings> observerNamed(std::string_view name) {
    ObserverSettings settings;
    settings.name = name;
    if (name == "simulated-PHONE") settings.placeBlur = 0.2073;
    if (name == "simulated-RING") settings.placeBlur = 0.1524;
    if (name == "simulated-thesis") return thesisObserver(settings);
    return name == "simulated" || settings.placeBlur != ObserverSettings{}.placeBlur ? std::optional{settings}
                                                                                     : std::nullopt;
}

SimulatedObserver::SimulatedObserver(ObserverSettings settings, const Protocol& protocol,
                                     const Participant& participant)
    : settings_{individualObserver(std::move(settings), protocol, participant)}
    , protocol_{protocol}
    , participant_{participant} {}

Answer SimulatedObserver::answer(const Experiment& experiment) const {
    const Trial& trial = experiment.trial();
    const SessionPlan& session = experiment.session();
    const ConditionPlan& condition = experiment.condition();
    return Response{settings_, session, condition, trial,
                    SeededRandom{static_cast<std::uint64_t>(protocol_.seed),
                                 "observer/" + std::to_string(participant_.number) + "/" + condition.name +
                                     "/" + session.name + "/" + std::to_string(trial.number)}}
        .answer();
}

} // namespace physvib

// SPDX-License-Identifier: MIT
// Table of all protocol fields: name in files, member of the structs, and valid range. Readers and writers of
// protocols, their schema and reports pass themselves as the visitor `v`.
#pragma once
#include "Lab/Study/Protocol.h"
#include "Lab/Study/StimulusJob.h"
#include "Scene/SceneFields.h"

namespace physvib {

inline constexpr std::array<std::string_view, 3> trialOrderNames{"given", "random", "blocks"};
inline constexpr std::array<std::string_view, 3> conditionOrderNames{"given", "random", "latin-square"};
inline constexpr std::array<std::string_view, 4> stimulusSetNames{"patterns", "grid", "calls", "world"};
inline constexpr std::array<std::string_view, 2> gridPointNames{"corners", "middles"};

namespace studyBounds {
/// Range of a field that becomes part of a stimulus.
constexpr Bounds boundsOf(const ParameterRange& range) { return {range.min, range.max}; }
inline constexpr Bounds levelDb = absMax(limits::maxLevelDb);
inline constexpr Bounds breakSeconds = upTo(86400.0); // a day
inline constexpr Bounds trialCount = upTo(100000.0);  // number of trials in a week
inline constexpr Bounds screenItems{{}, {}, 0, 64};   // alternatives, objects or scales that fit on a screen
inline constexpr Bounds callBytes = upTo(static_cast<double>(maxCallBytes)); // length of text in bytes
inline constexpr Bounds gridLines{1.0, 16.0}; // number of grid lines that merging can divide
                                              // (Identification.h)
} // namespace studyBounds

/// A field that a file may leave out.
template <class T, class F>
void optionalField(auto& v, std::string_view name, F T::*member, const Bounds& bounds = {}) {
    v.field(name, member, bounds, Need::optional);
}

void visitFields(auto& v, FieldsOf<PatternSet>) {
    v.field("enchanters", &PatternSet::enchanters, Bounds{1.0, 26.0}, Need::required);
    optionalField(v, "pulse_s", &PatternSet::pulseSeconds, Bounds{0.001, 10.0, 1, 8});
    optionalField(v, "gap_s", &PatternSet::gapSeconds, studyBounds::boundsOf(parameterRanges::gapSeconds));
}

void visitFields(auto& v, FieldsOf<GridSet>) {
    v.field("columns", &GridSet::columns, studyBounds::gridLines, Need::required);
    v.field("rows", &GridSet::rows, studyBounds::gridLines, Need::required);
    v.choice("points", &GridSet::points, gridPointNames);
    v.choice("law", &GridSet::law, panningLawNames);
    optionalField(v, "exponent", &GridSet::exponent, studyBounds::boundsOf(parameterRanges::exponent));
    optionalField(v, "seconds", &GridSet::seconds, studyBounds::boundsOf(parameterRanges::seconds));
}

void visitFields(auto& v, FieldsOf<StudyFactor>) {
    v.field("name", &StudyFactor::name, anyText, Need::required);
    v.field("values", &StudyFactor::values, items(1, 256), Need::required);
    optionalField(v, "labels", &StudyFactor::labels, items(0, 256));
    optionalField(v, "alternative", &StudyFactor::alternative);
    optionalField(v, "otherwise", &StudyFactor::otherValue);
}

void visitFields(auto& v, FieldsOf<StudyVariable>) {
    v.field("name", &StudyVariable::name, anyText, Need::required);
    v.field("at_0_db", &StudyVariable::at0Db, Bounds{1e-6, 1e6}, Need::required);
    optionalField(v, "roves", &StudyVariable::isRoving);
}

template <class Set>
void visitCalls(auto& v) {
    optionalField(v, "factors", static_cast<std::vector<StudyFactor> Set::*>(&Set::factors), items(0, 16));
    v.field("call", static_cast<std::string Set::*>(&Set::call), studyBounds::callBytes, Need::required);
    optionalField(v, "variables", static_cast<std::vector<StudyVariable> Set::*>(&Set::variables),
                  items(0, 8));
}

void visitFields(auto& v, FieldsOf<CallSet>) { visitCalls<CallSet>(v); }

void visitFields(auto& v, FieldsOf<WorldSet>) {
    visitCalls<WorldSet>(v);
    optionalField(v, "hands", &WorldSet::isInteractive);
    optionalField(v, "display_scale", &WorldSet::displayScale, Bounds{1.0, 10000.0});
}

void visitFields(auto& v, FieldsOf<StudySoundFile>) {
    v.field("frequency_hz", &StudySoundFile::frequencyHz, Bounds{1.0, limits::maxFrequencyHz},
            Need::required);
    v.field("file", &StudySoundFile::file, anyText, Need::required);
}

void visitFields(auto& v, FieldsOf<MaterialPictureFile>) {
    v.field("material", &MaterialPictureFile::material, anyText, Need::required);
    v.field("file", &MaterialPictureFile::file, anyText, Need::required);
}

void visitFields(auto& v, FieldsOf<ConditionPlan>) {
    using C = ConditionPlan;
    v.field("name", &C::name, anyText, Need::required);
    optionalField(v, "group", &C::group);
    optionalField(v, "layout", &C::layout);
    optionalField(v, "frequency_hz", &C::frequencyHz, studyBounds::boundsOf(parameterRanges::frequencyHz));
    optionalField(v, "at_resonance", &C::isAtResonance);
    optionalField(v, "level_g", &C::levelG, studyBounds::boundsOf(parameterRanges::levelG));
    optionalField(v, "observer_blur", &C::observerBlur, Bounds{0.001, 1.0});
    v.variant("stimuli", &C::stimuli, stimulusSetNames);
}

void visitFields(auto& v, FieldsOf<Alternative>) {
    v.field("name", &Alternative::name, anyText, Need::required);
    optionalField(v, "level_db", &Alternative::levelDb, studyBounds::levelDb);
}

void visitFields(auto& v, FieldsOf<Adjustment>) {
    using A = Adjustment;
    v.field("alternative", &A::alternative, anyText, Need::required);
    optionalField(v, "start_db", &A::startDb, studyBounds::levelDb);
    optionalField(v, "random_start", &A::hasRandomStart);
    optionalField(v, "step_db", &A::stepDb, Bounds{0.01, 20.0});
    optionalField(v, "least_db", &A::minDb, studyBounds::levelDb);
    optionalField(v, "most_db", &A::maxDb, studyBounds::levelDb);
}

void visitFields(auto& v, FieldsOf<StaircasePlan>) {
    using S = StaircasePlan;
    v.field("alternative", &S::alternative, anyText, Need::required);
    optionalField(v, "start_db", &S::startDb, studyBounds::levelDb);
    optionalField(v, "starts_db", &S::startsDb,
                  Bounds{studyBounds::levelDb.min, studyBounds::levelDb.max, 0, 8});
    optionalField(v, "step_db", &S::stepDb, Bounds{0.01, 20.0});
    optionalField(v, "least_step_db", &S::minStepDb, Bounds{0.01, 20.0});
    optionalField(v, "least_db", &S::minDb, studyBounds::levelDb);
    optionalField(v, "most_db", &S::maxDb, studyBounds::levelDb);
    optionalField(v, "up_ratio", &S::upRatio, Bounds{0.1, 10.0});
    optionalField(v, "down", &S::down, Bounds{1.0, 10.0});
    optionalField(v, "reversals", &S::reversals, Bounds{2.0, 100.0});
    optionalField(v, "most_trials", &S::maxTrials, Bounds{1.0, 10000.0});
}

void visitFields(auto& v, FieldsOf<QuestMethod>) {
    using Q = QuestMethod;
    v.field("alternative", &Q::alternative, anyText, Need::required);
    v.choice("shape", &Q::shape, psychometricShapeNames);
    optionalField(v, "least_db", &Q::minDb, studyBounds::levelDb);
    optionalField(v, "most_db", &Q::maxDb, studyBounds::levelDb);
    optionalField(v, "step_db", &Q::stepDb, Bounds{0.01, 20.0});
    optionalField(v, "least_width_db", &Q::minWidthDb, Bounds{0.1, 100.0});
    optionalField(v, "most_width_db", &Q::maxWidthDb, Bounds{0.1, 100.0});
    optionalField(v, "lapse", &Q::lapse, Bounds{0.001, maxLapseRate});
    optionalField(v, "trials", &Q::trials, Bounds{1.0, 10000.0});
    optionalField(v, "deviation_db", &Q::deviationDb, Bounds{0.0, 100.0});
}

void visitFields(auto& v, FieldsOf<SessionPlan>) {
    using S = SessionPlan;
    v.field("name", &S::name, anyText, Need::required);
    optionalField(v, "training", &S::isTraining);
    v.choice("task", &S::task, studyTaskNames);
    optionalField(v, "question", &S::question);
    optionalField(v, "instruction", &S::instruction);
    optionalField(v, "feedback", &S::givesFeedback);
    optionalField(v, "interval_s", &S::intervalSeconds, studyBounds::breakSeconds);
    v.choice("order", &S::order, trialOrderNames);
    optionalField(v, "repetitions", &S::repetitions, Bounds{1.0, 1000.0});
    optionalField(v, "fewest_touches", &S::minTouches, studyBounds::trialCount);
    optionalField(v, "most_plays", &S::maxPlays, studyBounds::trialCount);
    optionalField(v, "least_s", &S::minSeconds, studyBounds::breakSeconds);
    optionalField(v, "answer_within_s", &S::answerSeconds, studyBounds::breakSeconds);
    optionalField(v, "break_before_s", &S::breakBeforeSeconds, studyBounds::breakSeconds);
    optionalField(v, "break_every", &S::breakEvery, studyBounds::trialCount);
    optionalField(v, "break_s", &S::breakSeconds, studyBounds::breakSeconds);
    optionalField(v, "alternatives", &S::alternatives, studyBounds::screenItems);
    optionalField(v, "both_orders", &S::bothOrders);
    optionalField(v, "answers", &S::answers, studyBounds::screenItems);
    optionalField(v, "objects", &S::objects, studyBounds::screenItems);
    optionalField(v, "scales", &S::scales, studyBounds::screenItems);
    optionalField(v, "reference", &S::reference);
    optionalField(v, "points", &S::points, upTo(11.0));
    optionalField(v, "once", &S::isQuestionnaire);
    optionalField(v, "pairs", &S::comparesPairs);
    optionalField(v, "definitions", &S::definitions, studyBounds::screenItems);
    optionalField(v, "anchors", &S::anchors, studyBounds::screenItems);
    optionalField(v, "show_numbers", &S::showsNumbers);
    optionalField(v, "adjustment", &S::adjustment);
    optionalField(v, "staircase", &S::staircase);
    optionalField(v, "quest", &S::quest);
    optionalField(v, "correct", &S::correct);
    optionalField(v, "until_correct", &S::untilCorrect, studyBounds::trialCount);
    optionalField(v, "rove_db", &S::roveDb, Bounds{0.0, 40.0});
    optionalField(v, "modulus", &S::modulus);
    optionalField(v, "modulus_number", &S::modulusNumber, Bounds{1e-6, 1e6});
    optionalField(v, "may_be_empty", &S::mayBeEmpty);
    optionalField(v, "levels_from", &S::levelsFrom);
    optionalField(v, "levels_file", &S::levelsFile);
}

void visitFields(auto& v, FieldsOf<Protocol>) {
    using P = Protocol;
    v.field("name", &P::name, anyText, Need::required);
    optionalField(v, "title", &P::title);
    optionalField(v, "seed", &P::seed, upTo(1e9));
    optionalField(v, "pink_noise", &P::hasPinkNoise);
    optionalField(v, "pink_noise_db", &P::pinkNoiseDb, Bounds{PinkNoise::minDb, PinkNoise::maxDb});
    optionalField(v, "exposure_limit_m_per_s2", &P::exposureLimit,
                  Bounds{0.01, exposureLimitMetresPerSecond2});
    optionalField(v, "sounds", &P::sounds, items(0, 64));
    optionalField(v, "pictures", &P::pictures, items(0, 16));
    v.choice("condition_order", &P::conditionOrder, conditionOrderNames);
    optionalField(v, "condition_break_s", &P::conditionBreakSeconds, studyBounds::breakSeconds);
    optionalField(v, "closing_question", &P::closingQuestion);
    optionalField(v, "words", &P::translation);
    v.field("conditions", &P::conditions, items(1, 256), Need::required);
    v.field("sessions", &P::sessions, items(1, 64), Need::required);
}

} // namespace physvib

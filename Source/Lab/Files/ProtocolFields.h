// SPDX-License-Identifier: MIT
// Table of all protocol fields: name in files, member of the structs, and valid range.
#pragma once
#include "Lab/Study/Protocol.h"
#include "Lab/Study/Stimulus.h"
#include "Scene/SceneFields.h"

namespace physvib {

inline constexpr std::array<std::string_view, 3> trialOrderNames{"given", "random", "blocks"};
inline constexpr std::array<std::string_view, 3> conditionOrderNames{"given", "random", "latin-square"};
inline constexpr std::array<std::string_view, 4> stimulusSetNames{"patterns", "grid", "calls", "world"};
inline constexpr std::array<std::string_view, 2> gridPointNames{"corners", "middles"};

namespace studyBounds {
/// Range of a field that becomes part of a stimulus.
constexpr Bounds of(const StimulusRange& range) { return {range.least, range.most}; }
inline constexpr Bounds levelDb = within(limits::maxLevelDb);
inline constexpr Bounds rest = upTo(86400.0);   // a day
inline constexpr Bounds count = upTo(100000.0); // number of trials in a week
inline constexpr Bounds names{{}, {}, 0, 64};   // alternatives, objects or scales that fit on a screen
inline constexpr Bounds call = upTo(static_cast<double>(mostCallBytes)); // length of text in bytes
inline constexpr Bounds lines{1.0, 16.0}; // number of grid lines that merging can divide (Identification.h)
} // namespace studyBounds

/// A field that a file may leave out.
template <class T, class F>
void mayHave(auto& v, std::string_view name, F T::*member, const Bounds& bounds = {}) {
    v.field(name, member, bounds, Need::optional);
}

void visitFields(auto& v, FieldsOf<PatternSet>) {
    v.field("enchanters", &PatternSet::enchanters, Bounds{1.0, 26.0}, Need::required);
    mayHave(v, "pulse_s", &PatternSet::pulseSeconds, Bounds{0.001, 10.0, 1, 8});
    mayHave(v, "gap_s", &PatternSet::gapSeconds, studyBounds::of(stimulusRanges::gapSeconds));
}

void visitFields(auto& v, FieldsOf<GridSet>) {
    v.field("columns", &GridSet::columns, studyBounds::lines, Need::required);
    v.field("rows", &GridSet::rows, studyBounds::lines, Need::required);
    v.choice("points", &GridSet::points, gridPointNames);
    v.choice("law", &GridSet::law, panningLawNames);
    mayHave(v, "exponent", &GridSet::exponent, studyBounds::of(stimulusRanges::exponent));
    mayHave(v, "seconds", &GridSet::seconds, studyBounds::of(stimulusRanges::seconds));
}

void visitFields(auto& v, FieldsOf<StudyFactor>) {
    v.field("name", &StudyFactor::name, anyText, Need::required);
    v.field("values", &StudyFactor::values, items(1, 256), Need::required);
    mayHave(v, "labels", &StudyFactor::labels, items(0, 256));
    mayHave(v, "alternative", &StudyFactor::alternative);
    mayHave(v, "otherwise", &StudyFactor::otherwise);
}

void visitFields(auto& v, FieldsOf<StudyVariable>) {
    v.field("name", &StudyVariable::name, anyText, Need::required);
    v.field("at_0_db", &StudyVariable::at0Db, Bounds{1e-6, 1e6}, Need::required);
    mayHave(v, "roves", &StudyVariable::roves);
}

template <class Set>
void visitCalls(auto& v) {
    mayHave(v, "factors", static_cast<std::vector<StudyFactor> Set::*>(&Set::factors), items(0, 16));
    v.field("call", static_cast<std::string Set::*>(&Set::call), studyBounds::call, Need::required);
    mayHave(v, "variables", static_cast<std::vector<StudyVariable> Set::*>(&Set::variables), items(0, 8));
}

void visitFields(auto& v, FieldsOf<CallSet>) { visitCalls<CallSet>(v); }

void visitFields(auto& v, FieldsOf<WorldSet>) {
    visitCalls<WorldSet>(v);
    mayHave(v, "hands", &WorldSet::hasHands);
    mayHave(v, "display_scale", &WorldSet::displayScale, Bounds{1.0, 10000.0});
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
    mayHave(v, "group", &C::group);
    mayHave(v, "layout", &C::layout);
    mayHave(v, "frequency_hz", &C::frequencyHz, studyBounds::of(stimulusRanges::frequencyHz));
    mayHave(v, "at_resonance", &C::isAtResonance);
    mayHave(v, "level_g", &C::levelG, studyBounds::of(stimulusRanges::levelG));
    mayHave(v, "observer_blur", &C::observerBlur, Bounds{0.001, 1.0});
    v.variant("stimuli", &C::stimuli, stimulusSetNames);
}

void visitFields(auto& v, FieldsOf<Alternative>) {
    v.field("name", &Alternative::name, anyText, Need::required);
    mayHave(v, "level_db", &Alternative::levelDb, studyBounds::levelDb);
}

void visitFields(auto& v, FieldsOf<Adjustment>) {
    using A = Adjustment;
    v.field("alternative", &A::alternative, anyText, Need::required);
    mayHave(v, "start_db", &A::startDb, studyBounds::levelDb);
    mayHave(v, "random_start", &A::startsAnywhere);
    mayHave(v, "step_db", &A::stepDb, Bounds{0.01, 20.0});
    mayHave(v, "least_db", &A::leastDb, studyBounds::levelDb);
    mayHave(v, "most_db", &A::mostDb, studyBounds::levelDb);
}

void visitFields(auto& v, FieldsOf<StaircasePlan>) {
    using S = StaircasePlan;
    v.field("alternative", &S::alternative, anyText, Need::required);
    mayHave(v, "start_db", &S::startDb, studyBounds::levelDb);
    mayHave(v, "starts_db", &S::startsDb,
            Bounds{studyBounds::levelDb.least, studyBounds::levelDb.most, 0, 8});
    mayHave(v, "step_db", &S::stepDb, Bounds{0.01, 20.0});
    mayHave(v, "least_step_db", &S::leastStepDb, Bounds{0.01, 20.0});
    mayHave(v, "least_db", &S::leastDb, studyBounds::levelDb);
    mayHave(v, "most_db", &S::mostDb, studyBounds::levelDb);
    mayHave(v, "up_ratio", &S::upRatio, Bounds{0.1, 10.0});
    mayHave(v, "down", &S::down, Bounds{1.0, 10.0});
    mayHave(v, "reversals", &S::reversals, Bounds{2.0, 100.0});
    mayHave(v, "most_trials", &S::mostTrials, Bounds{1.0, 10000.0});
}

void visitFields(auto& v, FieldsOf<QuestMethod>) {
    using Q = QuestMethod;
    v.field("alternative", &Q::alternative, anyText, Need::required);
    v.choice("shape", &Q::shape, psychometricShapeNames);
    mayHave(v, "least_db", &Q::leastDb, studyBounds::levelDb);
    mayHave(v, "most_db", &Q::mostDb, studyBounds::levelDb);
    mayHave(v, "step_db", &Q::stepDb, Bounds{0.01, 20.0});
    mayHave(v, "least_width_db", &Q::leastWidthDb, Bounds{0.1, 100.0});
    mayHave(v, "most_width_db", &Q::mostWidthDb, Bounds{0.1, 100.0});
    mayHave(v, "lapse", &Q::lapse, Bounds{0.001, mostLapse});
    mayHave(v, "trials", &Q::trials, Bounds{1.0, 10000.0});
    mayHave(v, "deviation_db", &Q::deviationDb, Bounds{0.0, 100.0});
}

void visitFields(auto& v, FieldsOf<SessionPlan>) {
    using S = SessionPlan;
    v.field("name", &S::name, anyText, Need::required);
    mayHave(v, "training", &S::isTraining);
    v.choice("task", &S::task, studyTaskNames);
    mayHave(v, "question", &S::question);
    mayHave(v, "instruction", &S::instruction);
    mayHave(v, "feedback", &S::givesFeedback);
    mayHave(v, "interval_s", &S::intervalSeconds, studyBounds::rest);
    v.choice("order", &S::order, trialOrderNames);
    mayHave(v, "repetitions", &S::repetitions, Bounds{1.0, 1000.0});
    mayHave(v, "fewest_touches", &S::fewestTouches, studyBounds::count);
    mayHave(v, "most_plays", &S::mostPlays, studyBounds::count);
    mayHave(v, "least_s", &S::leastSeconds, studyBounds::rest);
    mayHave(v, "answer_within_s", &S::answerSeconds, studyBounds::rest);
    mayHave(v, "break_before_s", &S::breakBeforeSeconds, studyBounds::rest);
    mayHave(v, "break_every", &S::breakEvery, studyBounds::count);
    mayHave(v, "break_s", &S::breakSeconds, studyBounds::rest);
    mayHave(v, "alternatives", &S::alternatives, studyBounds::names);
    mayHave(v, "both_orders", &S::bothOrders);
    mayHave(v, "answers", &S::answers, studyBounds::names);
    mayHave(v, "objects", &S::objects, studyBounds::names);
    mayHave(v, "scales", &S::scales, studyBounds::names);
    mayHave(v, "reference", &S::reference);
    mayHave(v, "points", &S::points, upTo(11.0));
    mayHave(v, "once", &S::isOnce);
    mayHave(v, "pairs", &S::comparesPairs);
    mayHave(v, "definitions", &S::definitions, studyBounds::names);
    mayHave(v, "anchors", &S::anchors, studyBounds::names);
    mayHave(v, "show_numbers", &S::showsNumbers);
    mayHave(v, "adjustment", &S::adjustment);
    mayHave(v, "staircase", &S::staircase);
    mayHave(v, "quest", &S::quest);
    mayHave(v, "correct", &S::correct);
    mayHave(v, "until_correct", &S::untilCorrect, studyBounds::count);
    mayHave(v, "rove_db", &S::roveDb, Bounds{0.0, 40.0});
    mayHave(v, "modulus", &S::modulus);
    mayHave(v, "modulus_number", &S::modulusNumber, Bounds{1e-6, 1e6});
    mayHave(v, "may_be_empty", &S::mayBeEmpty);
    mayHave(v, "levels_from", &S::levelsFrom);
    mayHave(v, "levels_file", &S::levelsFile);
}

void visitFields(auto& v, FieldsOf<Protocol>) {
    using P = Protocol;
    v.field("name", &P::name, anyText, Need::required);
    mayHave(v, "title", &P::title);
    mayHave(v, "seed", &P::seed, upTo(1e9));
    mayHave(v, "pink_noise", &P::hasPinkNoise);
    mayHave(v, "pink_noise_db", &P::pinkNoiseDb, Bounds{PinkNoise::leastDb, PinkNoise::mostDb});
    mayHave(v, "exposure_limit_m_per_s2", &P::exposureLimit, Bounds{0.01, exposureLimitValue});
    mayHave(v, "sounds", &P::sounds, items(0, 64));
    mayHave(v, "pictures", &P::pictures, items(0, 16));
    v.choice("condition_order", &P::conditionOrder, conditionOrderNames);
    mayHave(v, "condition_break_s", &P::conditionBreakSeconds, studyBounds::rest);
    mayHave(v, "closing_question", &P::closingQuestion);
    mayHave(v, "words", &P::words);
    v.field("conditions", &P::conditions, items(1, 256), Need::required);
    v.field("sessions", &P::sessions, items(1, 64), Need::required);
}

} // namespace physvib

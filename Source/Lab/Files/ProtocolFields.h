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

void visitFields(auto& v, FieldsOf<PatternSet>) {
    v.field("enchanters", &PatternSet::enchanters, Bounds{1.0, 26.0}, Need::required);
    v.field("pulse_s", &PatternSet::pulseSeconds, Bounds{0.001, 10.0, 1, 8}, Need::optional);
    v.field("gap_s", &PatternSet::gapSeconds, studyBounds::of(stimulusRanges::gapSeconds), Need::optional);
}

void visitFields(auto& v, FieldsOf<GridSet>) {
    v.field("columns", &GridSet::columns, studyBounds::lines, Need::required);
    v.field("rows", &GridSet::rows, studyBounds::lines, Need::required);
    v.choice("points", &GridSet::points, gridPointNames);
    v.choice("law", &GridSet::law, panningLawNames);
    v.field("exponent", &GridSet::exponent, studyBounds::of(stimulusRanges::exponent), Need::optional);
    v.field("seconds", &GridSet::seconds, studyBounds::of(stimulusRanges::seconds), Need::optional);
}

void visitFields(auto& v, FieldsOf<StudyFactor>) {
    v.field("name", &StudyFactor::name, anyText, Need::required);
    v.field("values", &StudyFactor::values, items(1, 256), Need::required);
    v.field("labels", &StudyFactor::labels, items(0, 256), Need::optional);
    v.field("alternative", &StudyFactor::alternative, anyText, Need::optional);
    v.field("otherwise", &StudyFactor::otherwise, anyText, Need::optional);
}

void visitFields(auto& v, FieldsOf<StudyVariable>) {
    v.field("name", &StudyVariable::name, anyText, Need::required);
    v.field("at_0_db", &StudyVariable::at0Db, Bounds{1e-6, 1e6}, Need::required);
    v.field("roves", &StudyVariable::roves, {}, Need::optional);
}

template <class Set>
void visitCalls(auto& v) {
    v.field("factors", static_cast<std::vector<StudyFactor> Set::*>(&Set::factors), items(0, 16),
            Need::optional);
    v.field("call", static_cast<std::string Set::*>(&Set::call), studyBounds::call, Need::required);
    v.field("variables", static_cast<std::vector<StudyVariable> Set::*>(&Set::variables), items(0, 8),
            Need::optional);
}

void visitFields(auto& v, FieldsOf<CallSet>) { visitCalls<CallSet>(v); }

void visitFields(auto& v, FieldsOf<WorldSet>) {
    visitCalls<WorldSet>(v);
    v.field("hands", &WorldSet::hasHands, {}, Need::optional);
    v.field("display_scale", &WorldSet::displayScale, Bounds{1.0, 10000.0}, Need::optional);
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
    v.field("group", &C::group, anyText, Need::optional);
    v.field("layout", &C::layout, anyText, Need::optional);
    v.field("frequency_hz", &C::frequencyHz, studyBounds::of(stimulusRanges::frequencyHz), Need::optional);
    v.field("at_resonance", &C::isAtResonance, {}, Need::optional);
    v.field("level_g", &C::levelG, studyBounds::of(stimulusRanges::levelG), Need::optional);
    v.field("observer_blur", &C::observerBlur, Bounds{0.001, 1.0}, Need::optional);
    v.variant("stimuli", &C::stimuli, stimulusSetNames);
}

void visitFields(auto& v, FieldsOf<Alternative>) {
    v.field("name", &Alternative::name, anyText, Need::required);
    v.field("level_db", &Alternative::levelDb, studyBounds::levelDb, Need::optional);
}

void visitFields(auto& v, FieldsOf<Adjustment>) {
    using A = Adjustment;
    v.field("alternative", &A::alternative, anyText, Need::required);
    v.field("start_db", &A::startDb, studyBounds::levelDb, Need::optional);
    v.field("random_start", &A::startsAnywhere, {}, Need::optional);
    v.field("step_db", &A::stepDb, Bounds{0.01, 20.0}, Need::optional);
    v.field("least_db", &A::leastDb, studyBounds::levelDb, Need::optional);
    v.field("most_db", &A::mostDb, studyBounds::levelDb, Need::optional);
}

void visitFields(auto& v, FieldsOf<StaircasePlan>) {
    using S = StaircasePlan;
    v.field("alternative", &S::alternative, anyText, Need::required);
    v.field("start_db", &S::startDb, studyBounds::levelDb, Need::optional);
    v.field("starts_db", &S::startsDb, Bounds{studyBounds::levelDb.least, studyBounds::levelDb.most, 0, 8},
            Need::optional);
    v.field("step_db", &S::stepDb, Bounds{0.01, 20.0}, Need::optional);
    v.field("least_step_db", &S::leastStepDb, Bounds{0.01, 20.0}, Need::optional);
    v.field("least_db", &S::leastDb, studyBounds::levelDb, Need::optional);
    v.field("most_db", &S::mostDb, studyBounds::levelDb, Need::optional);
    v.field("up_ratio", &S::upRatio, Bounds{0.1, 10.0}, Need::optional);
    v.field("down", &S::down, Bounds{1.0, 10.0}, Need::optional);
    v.field("reversals", &S::reversals, Bounds{2.0, 100.0}, Need::optional);
    v.field("most_trials", &S::mostTrials, Bounds{1.0, 10000.0}, Need::optional);
}

void visitFields(auto& v, FieldsOf<QuestMethod>) {
    using Q = QuestMethod;
    v.field("alternative", &Q::alternative, anyText, Need::required);
    v.choice("shape", &Q::shape, psychometricShapeNames);
    v.field("least_db", &Q::leastDb, studyBounds::levelDb, Need::optional);
    v.field("most_db", &Q::mostDb, studyBounds::levelDb, Need::optional);
    v.field("step_db", &Q::stepDb, Bounds{0.01, 20.0}, Need::optional);
    v.field("least_width_db", &Q::leastWidthDb, Bounds{0.1, 100.0}, Need::optional);
    v.field("most_width_db", &Q::mostWidthDb, Bounds{0.1, 100.0}, Need::optional);
    v.field("lapse", &Q::lapse, Bounds{0.001, mostLapse}, Need::optional);
    v.field("trials", &Q::trials, Bounds{1.0, 10000.0}, Need::optional);
    v.field("deviation_db", &Q::deviationDb, Bounds{0.0, 100.0}, Need::optional);
}

void visitFields(auto& v, FieldsOf<SessionPlan>) {
    using S = SessionPlan;
    v.field("name", &S::name, anyText, Need::required);
    v.field("training", &S::isTraining, {}, Need::optional);
    v.choice("task", &S::task, studyTaskNames);
    v.field("question", &S::question, anyText, Need::optional);
    v.field("instruction", &S::instruction, anyText, Need::optional);
    v.field("feedback", &S::givesFeedback, {}, Need::optional);
    v.field("interval_s", &S::intervalSeconds, studyBounds::rest, Need::optional);
    v.choice("order", &S::order, trialOrderNames);
    v.field("repetitions", &S::repetitions, Bounds{1.0, 1000.0}, Need::optional);
    v.field("fewest_touches", &S::fewestTouches, studyBounds::count, Need::optional);
    v.field("most_plays", &S::mostPlays, studyBounds::count, Need::optional);
    v.field("least_s", &S::leastSeconds, studyBounds::rest, Need::optional);
    v.field("answer_within_s", &S::answerSeconds, studyBounds::rest, Need::optional);
    v.field("break_before_s", &S::breakBeforeSeconds, studyBounds::rest, Need::optional);
    v.field("break_every", &S::breakEvery, studyBounds::count, Need::optional);
    v.field("break_s", &S::breakSeconds, studyBounds::rest, Need::optional);
    v.field("alternatives", &S::alternatives, studyBounds::names, Need::optional);
    v.field("both_orders", &S::bothOrders, {}, Need::optional);
    v.field("answers", &S::answers, studyBounds::names, Need::optional);
    v.field("objects", &S::objects, studyBounds::names, Need::optional);
    v.field("scales", &S::scales, studyBounds::names, Need::optional);
    v.field("reference", &S::reference, anyText, Need::optional);
    v.field("points", &S::points, upTo(11.0), Need::optional);
    v.field("once", &S::isOnce, {}, Need::optional);
    v.field("pairs", &S::comparesPairs, {}, Need::optional);
    v.field("definitions", &S::definitions, studyBounds::names, Need::optional);
    v.field("anchors", &S::anchors, studyBounds::names, Need::optional);
    v.field("show_numbers", &S::showsNumbers, {}, Need::optional);
    v.field("adjustment", &S::adjustment, {}, Need::optional);
    v.field("staircase", &S::staircase, {}, Need::optional);
    v.field("quest", &S::quest, {}, Need::optional);
    v.field("correct", &S::correct, anyText, Need::optional);
    v.field("until_correct", &S::untilCorrect, studyBounds::count, Need::optional);
    v.field("rove_db", &S::roveDb, Bounds{0.0, 40.0}, Need::optional);
    v.field("modulus", &S::modulus, anyText, Need::optional);
    v.field("modulus_number", &S::modulusNumber, Bounds{1e-6, 1e6}, Need::optional);
    v.field("may_be_empty", &S::mayBeEmpty, {}, Need::optional);
    v.field("levels_from", &S::levelsFrom, anyText, Need::optional);
    v.field("levels_file", &S::levelsFile, anyText, Need::optional);
}

void visitFields(auto& v, FieldsOf<Protocol>) {
    using P = Protocol;
    v.field("name", &P::name, anyText, Need::required);
    v.field("title", &P::title, anyText, Need::optional);
    v.field("seed", &P::seed, upTo(1e9), Need::optional);
    v.field("pink_noise", &P::hasPinkNoise, {}, Need::optional);
    v.field("pink_noise_db", &P::pinkNoiseDb, Bounds{PinkNoise::leastDb, PinkNoise::mostDb}, Need::optional);
    v.field("exposure_limit_m_per_s2", &P::exposureLimit, Bounds{0.01, exposureLimitValue}, Need::optional);
    v.field("sounds", &P::sounds, items(0, 64), Need::optional);
    v.field("pictures", &P::pictures, items(0, 16), Need::optional);
    v.choice("condition_order", &P::conditionOrder, conditionOrderNames);
    v.field("condition_break_s", &P::conditionBreakSeconds, studyBounds::rest, Need::optional);
    v.field("closing_question", &P::closingQuestion, anyText, Need::optional);
    v.field("words", &P::words, anyText, Need::optional);
    v.field("conditions", &P::conditions, items(1, 256), Need::required);
    v.field("sessions", &P::sessions, items(1, 64), Need::required);
}

} // namespace physvib

// SPDX-License-Identifier: GPL-3.0-or-later
// Composes the texts of tasks.
#include "Mixer/Studies/StudyWords.h"
#include "Io/Text/CsvText.h"
#include "Mixer/Window/Parts.h"
#include <cmath>

namespace physvib {

juce::String
StudyWords::operator()(const std::string& english,
                       std::initializer_list<std::pair<const char*, juce::String>> values) const {
    if (!words_.name.empty() && !words_.texts.contains(english)) missed_.insert(english);
    auto text = utf8(words_.of(english));
    for (const auto& [name, value] : values) text = text.replace("{" + juce::String{name} + "}", value);
    return text;
}

juce::String StudyWords::lines(const TaskText& text, const ConditionPlan& condition) const {
    auto own = std::holds_alternative<GridSet>(condition.stimuli)      ? text.onGrid
               : std::holds_alternative<PatternSet>(condition.stimuli) ? text.ofPatterns
                                                                       : std::string_view{};
    if (own.empty()) own = text.usual;
    juce::StringArray said;
    while (!own.empty()) said.add((*this)(std::string{takeUntil('\n', own)}));
    return said.joinIntoString("\n");
}

juce::String StudyWords::question(const SessionPlan& session, const ConditionPlan& condition) const {
    return session.question.empty() ? lines(describe(session.task).question, condition)
                                    : (*this)(session.question);
}

juce::String StudyWords::feel(const SessionPlan& session) const {
    const StudyWords& say = *this;
    if (session.mostPlays == 0) return say("Feel it as often as you like.") + "\n";
    if (session.mostPlays == 1) return say("Feel it once.") + "\n";
    return say("Feel it at most {n} times.", {{"n", juce::String{session.mostPlays}}}) + "\n";
}

juce::String StudyWords::instruction(const SessionPlan& session, const ConditionPlan& condition) const {
    const StudyWords& say = *this;
    if (!session.instruction.empty()) return say(session.instruction);
    if (const auto* world = std::get_if<WorldSet>(&condition.stimuli); world != nullptr && world->hasHands)
        return say("The numbers show one world each: drag what moves in it, and tilt it with the arrow keys, "
                   "each about half of the time.") +
               "\n" +
               (session.leastSeconds > 0.0
                    ? say("Play with each for at least {n} s, then pause and answer.",
                          {{"n", number(session.leastSeconds, session.leastSeconds < 1.0 ? 1 : 0)}})
                    : say("Play with each, then pause and answer."));
    if (session.fewestTouches > 0)
        return say("Touch the field anywhere and feel that place.") + "\n" +
               say("Go on for as long as you like; Next ends the training.");
    const bool saysPlays = session.answer() != AnswerKind::wish && session.alternatives.empty();
    return (saysPlays ? feel(session) : juce::String{}) +
           lines(describe(session.task).instruction, condition);
}

juce::String StudyWords::ordinal(int part) const {
    static constexpr std::array names{"The first",  "The second", "The third",
                                      "The fourth", "The fifth",  "The sixth"};
    const auto i = static_cast<std::size_t>(part);
    return i < names.size() ? (*this)(names[i]) : (*this)("Number {n}", {{"n", juce::String{part + 1}}});
}

juce::String minutesText(double seconds) {
    const int whole = static_cast<int>(std::ceil(seconds));
    return juce::String{whole / 60} + ":" + juce::String{whole % 60}.paddedLeft('0', 2);
}

} // namespace physvib

// SPDX-License-Identifier: GPL-3.0-or-later
// Words of the tasks.
#include "Mixer/Studies/StudyWords.h"
#include "Mixer/Window/Parts.h"
#include <cmath>

namespace physvib {

juce::String StudyWords::operator()(const std::string& english, std::initializer_list<std::pair<const char*, juce::String>> values) const {
    if (!words_.name.empty() && !words_.texts.contains(english)) missed_.insert(english);
    auto text = utf8(words_.of(english));
    for (const auto& [name, value] : values) text = text.replace("{" + juce::String{name} + "}", value);
    return text;
}

juce::String StudyWords::question(const SessionPlan& session, const ConditionPlan& condition) const {
    const StudyWords& say = *this;
    if (!session.question.empty()) return say(session.question);
    const bool isGrid = std::holds_alternative<GridSet>(condition.stimuli);
    switch (session.task) {
    case StudyTask::explore: return say(session.fewestTouches > 0 || isGrid ? "Where do you want to feel it?" : "What do you want to feel?");
    case StudyTask::identify: return say(isGrid ? "Where did you feel it?" : "What did you feel?");
    case StudyTask::locate: return say("Where did you feel it?");
    case StudyTask::choose: return say("Which one do you choose?");
    case StudyTask::rate: return say("Rate what you felt.");
    case StudyTask::adjust: return say("Make both equal.");
    case StudyTask::estimate: return say("How much is it?");
    }
    return {};
}

juce::String StudyWords::feel(const SessionPlan& session) const {
    const StudyWords& say = *this;
    if (session.mostPlays == 0) return say("Feel it as often as you like.") + "\n";
    if (session.mostPlays == 1) return say("Feel it once.") + "\n";
    return say("Feel it at most {n} times.", {{"n", juce::String{session.mostPlays}}}) + "\n";
}

juce::String StudyWords::instruction(const SessionPlan& session, const ConditionPlan& condition) const {
    const StudyWords& say = *this;
    const bool isGrid = std::holds_alternative<GridSet>(condition.stimuli), isPattern = std::holds_alternative<PatternSet>(condition.stimuli);
    if (const auto* world = std::get_if<WorldSet>(&condition.stimuli); world != nullptr && world->hasHands)
        return say("The numbers show one world each: drag what moves in it, and tilt it with the arrow keys.") + "\n" +
               (session.leastSeconds > 0.0 ? say("Play with each for at least {n} s, then pause and answer.", {{"n", number(session.leastSeconds, session.leastSeconds < 1.0 ? 1 : 0)}})
                                           : say("Play with each, then pause and answer."));
    switch (session.task) {
    case StudyTask::explore:
        if (session.fewestTouches > 0) return say("Touch the field anywhere and feel that place.") + "\n" + say("Go on for as long as you like; Next ends the training.");
        return say("Choose what you want to feel, as often as you like.") + "\n" + say("When everything was felt once, Next ends the training.");
    case StudyTask::identify:
        if (isPattern) return feel(session) + say("Then choose the place of its first pulse, and the whole pattern.");
        return feel(session) + say(isGrid ? "Then choose the point where you felt it." : "Then say which one it was.");
    case StudyTask::locate: return feel(session) + say("Then mark where you felt it, anywhere on the field.");
    case StudyTask::choose: return say("Feel each of them, then choose one.");
    case StudyTask::rate: return feel(session) + say("Then set every scale, and go on.");
    case StudyTask::adjust: return say("Feel both in turn, as often as you like.") + "\n" + say("Make the marked one softer or stronger until both are equal, and go on.");
    case StudyTask::estimate: return feel(session) + say("Then type a number, and go on.");
    }
    return {};
}

juce::String StudyWords::ordinal(int part) const {
    static constexpr std::array names{"The first", "The second", "The third", "The fourth", "The fifth", "The sixth"};
    const auto i = static_cast<std::size_t>(part);
    return i < names.size() ? (*this)(names[i]) : (*this)("Number {n}", {{"n", juce::String{part + 1}}});
}

juce::String minutesText(double seconds) {
    const int whole = static_cast<int>(std::ceil(seconds));
    return juce::String{whole / 60} + ":" + juce::String{whole % 60}.paddedLeft('0', 2);
}

} // namespace physvib

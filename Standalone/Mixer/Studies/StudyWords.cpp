// SPDX-License-Identifier: GPL-3.0-or-later
// Words of the tasks.
#include "Mixer/Studies/StudyWords.h"
#include <cmath>

namespace physvib {

juce::String questionOf(const SessionPlan& session, const ConditionPlan& condition) {
    if (!session.question.empty()) return juce::String::fromUTF8(session.question.c_str());
    const bool isGrid = std::holds_alternative<GridSet>(condition.stimuli);
    switch (session.task) {
    case StudyTask::explore: return session.fewestTouches > 0 || isGrid ? "Where do you want to feel it?" : "What do you want to feel?";
    case StudyTask::identify: return isGrid ? "Where did you feel it?" : "What did you feel?";
    case StudyTask::locate: return "Where did you feel it?";
    case StudyTask::choose: return "Which one do you choose?";
    case StudyTask::rate: return "Rate what you felt.";
    case StudyTask::adjust: return "Make both equal.";
    case StudyTask::estimate: return "How much is it?";
    }
    return {};
}

juce::String instructionOf(const SessionPlan& session, const ConditionPlan& condition) {
    const bool isGrid = std::holds_alternative<GridSet>(condition.stimuli), isPattern = std::holds_alternative<PatternSet>(condition.stimuli);
    const juce::String again = session.mostPlays == 0 ? "as often as you like" : session.mostPlays == 1 ? "once" : "at most " + juce::String{session.mostPlays} + " times";
    const juce::String feel = "Feel it with the space bar, " + again + ".\n";
    switch (session.task) {
    case StudyTask::explore:
        if (session.fewestTouches > 0) return "Touch the field anywhere and feel that place.\nThe training takes " + juce::String{session.fewestTouches} + " touches.";
        return "Choose what you want to feel, as often as you like.\nThe training ends when everything was felt once.";
    case StudyTask::identify:
        if (isPattern) return feel + "Then choose the place of its first pulse, and the whole pattern.";
        return feel + (isGrid ? "Then click the point where you felt it." : "Then say which one it was.");
    case StudyTask::locate: return feel + "Then click where you felt it, anywhere on the field.";
    case StudyTask::choose: return "Feel each of them with the space bar, " + again + ".\nThen choose one.";
    case StudyTask::rate: {
        const juce::String least = session.leastSeconds > 0.0 ? "for at least " + juce::String{session.leastSeconds} + " s" : again;
        return "Feel " + juce::String{session.objects.empty() ? "it" : "each of them"} + " with the space bar, " + least + ".\nThen set every scale, and go on.";
    }
    case StudyTask::adjust: return "Feel both in turn, as often as you like.\nMake the marked one softer or stronger until both are equal, and go on.";
    case StudyTask::estimate: return feel + "Then type a number, and go on.";
    }
    return {};
}

juce::String minutesText(double seconds) {
    const int whole = static_cast<int>(std::ceil(seconds));
    return juce::String{whole / 60} + ":" + juce::String{whole % 60}.paddedLeft('0', 2);
}

} // namespace physvib

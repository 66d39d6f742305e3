// SPDX-License-Identifier: GPL-3.0-or-later
// Common parts of participants' screens: buttons, focus by arrow keys, and translated texts.
#include "Mixer/Studies/StudyParts.h"
#include "Io/Text/CsvText.h"

namespace physvib {

FullScreen::FullScreen(MixerModel& model, const juce::String& title)
    : model_{model} {
    setTitle(title);
    setOpaque(true);
    setWantsKeyboardFocus(true);
    setFocusContainerType(FocusContainerType::keyboardFocusContainer);
    silence_.setTitle("Silence");
    silence_.getProperties().set(stopProperty, true);
    silence_.onClick = [this] { model_.setSilent(!model_.isSilent()), refresh(); };
}

void FullScreen::showSilence(const juce::String& on, const juce::String& off) {
    silence_.setButtonText(model_.isSilent() ? on : off);
    silence_.setToggleState(model_.isSilent(), juce::dontSendNotification);
}

void FullScreen::close() const {
    if (onClose) juce::MessageManager::callAsync([close = onClose] { close(); });
}

BigButton::BigButton(const juce::String& words, const juce::String& name)
    : juce::Button{name}
    , words_{words} {
    setTitle(name);
}

void BigButton::setWords(const juce::String& words, const juce::String& remark) {
    if (words == words_ && remark == remark_) return;
    words_ = words;
    remark_ = remark;
    setDescription(remark);
    repaint();
}

void BigButton::setShare(double share) {
    if (std::abs(share - share_) < 1e-3) return;
    share_ = share;
    repaint();
}

void BigButton::paintButton(juce::Graphics& g, bool isOver, bool isDown) {
    const float light = isEnabled() || getToggleState() ? 1.0f : 0.4f;
    auto ink = shade(*this, Shade::text);
    if (isMain_) {
        g.setColour(shade(*this, Shade::accent)
                        .withMultipliedAlpha(isEnabled() ? 1.0f : 0.25f)
                        .brighter(isOver && isEnabled() ? 0.1f : 0.0f));
        g.fillRoundedRectangle(getLocalBounds().toFloat().reduced(1.0f), 8.0f);
        if (isEnabled())
            ink = shade(*this, Shade::accent).getPerceivedBrightness() > 0.55f
                      ? juce::Colour{palette::Argb{0xff101218}}
                      : juce::Colours::white;
    } else {
        drawTarget(g, *this, isOver, isDown);
    }
    auto area = getLocalBounds().reduced(12, 8);
    if (share_ >= 0.0) {
        auto bar = area.removeFromBottom(5).toFloat();
        area.removeFromBottom(3);
        fillRound(g, *this, Shade::line, bar, 2.5f);
        fillRound(g, *this, Shade::accent,
                  bar.withWidth(bar.getWidth() * static_cast<float>(std::min(1.0, share_))), 2.5f);
    }
    const int line = 24, lines = remark_.isEmpty() ? line : line + 20;
    area = area.withSizeKeepingCentre(area.getWidth(), std::min(lines, area.getHeight()));
    g.setColour(ink.withMultipliedAlpha(light));
    g.setFont(text::font(getHeight() >= 48 && words_.length() < 24 ? text::large : text::medium));
    g.drawText(words_, area.removeFromTop(line), juce::Justification::centred, true);
    g.setColour((isMain_ ? ink : shade(*this, Shade::muted)).withMultipliedAlpha(light));
    g.setFont(text::font(text::small));
    g.drawText(remark_, area, juce::Justification::centred, true);
    if (!isMarked_) return;
    g.setColour(shade(*this, Shade::accent));
    g.fillEllipse(
        juce::Rectangle<float>{8.0f, 8.0f}.withCentre({static_cast<float>(getWidth()) - 11.0f, 11.0f}));
}

void drawTarget(juce::Graphics& g, const juce::Button& button, bool isOver, bool isDown, float corner) {
    const auto area = button.getLocalBounds().toFloat().reduced(1.0f);
    auto colour = button.getToggleState() ? shade(button, Shade::accent).withMultipliedAlpha(0.35f)
                                          : shade(button, Shade::raised);
    if (isOver && button.isEnabled()) colour = colour.brighter(0.1f);
    if (isDown) colour = colour.darker(0.15f);
    g.setColour(button.isEnabled() ? colour : colour.withMultipliedAlpha(0.5f));
    g.fillRoundedRectangle(area, corner);
    g.setColour(shade(button, button.getToggleState() ? Shade::accent : Shade::line));
    g.drawRoundedRectangle(area, corner, button.getToggleState() ? 2.0f : 1.0f);
}

juce::Rectangle<float> fieldIn(juce::Rectangle<float> area, const EnchanterLayout& layout) {
    const auto wide = static_cast<float>(layout.extentWidthMetres / layout.extentHeightMetres);
    const float width = std::min(area.getWidth(), area.getHeight() * wide);
    return area.withSizeKeepingCentre(width, width / wide);
}

FieldPlace placeOf(const EnchanterLayout& layout, int enchanter) {
    const auto& place = nth(layout.places, enchanter);
    return {place.xMetres / layout.extentWidthMetres, 1.0 - place.yMetres / layout.extentHeightMetres};
}

juce::Point<float> pointOn(const juce::Rectangle<float>& field, const FieldPlace& place) {
    return {field.getX() + field.getWidth() * static_cast<float>(place.x),
            field.getY() + field.getHeight() * static_cast<float>(place.y)};
}

juce::Point<int> wayOf(const juce::KeyPress& key) {
    const auto is = [&key](int code) { return key.isKeyCode(code) ? 1 : 0; };
    return {is(juce::KeyPress::rightKey) - is(juce::KeyPress::leftKey),
            is(juce::KeyPress::downKey) - is(juce::KeyPress::upKey)};
}

bool moveFocus(juce::Component& parent, const juce::KeyPress& key) {
    const auto way = wayOf(key);
    if (way.isOrigin()) return false;
    juce::Component* from = nullptr;
    for (auto* child : parent.getChildren())
        if (child->hasKeyboardFocus(true)) from = child;
    for (auto* child : parent.getChildren()) // focus is elsewhere: start from the chosen button
        if (auto* button = dynamic_cast<juce::Button*>(child);
            from == nullptr && button != nullptr && button->getToggleState())
            from = child;
    juce::Component* best = nullptr;
    double least = 1e9;
    for (auto* child : parent.getChildren()) {
        if (child == from || !child->isVisible() || !child->isEnabled() || !child->getWantsKeyboardFocus())
            continue;
        const auto step =
            from != nullptr ? child->getBounds().getCentre() - from->getBounds().getCentre() : way;
        const int along = step.x * way.x + step.y * way.y,
                  aside = std::abs(step.x * way.y) + std::abs(step.y * way.x);
        if (along <= 0 || along < aside / 2) continue;
        if (const double far = along + 2.0 * aside; far < least) {
            least = far;
            best = child;
        }
    }
    if (best != nullptr) best->grabKeyboardFocus();
    return true;
}

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
    if (session.isOnce) return {};
    const bool saysPlays = session.answer() != AnswerKind::wish && session.alternatives.empty();
    const StudyTask task = session.answers.empty() ? session.task : StudyTask::identify;
    const auto within = [&](double s) {
        return "\n" + say("Answer within {n} s.", {{"n", number(s, s < 10.0 ? 1 : 0)}});
    };
    return (saysPlays ? feel(session) : juce::String{}) + lines(describe(task).instruction, condition) +
           (session.answerSeconds > 0.0 ? within(session.answerSeconds) : juce::String{});
}

juce::String StudyWords::ordinal(int part) const {
    static constexpr std::array names{"The first",  "The second", "The third",
                                      "The fourth", "The fifth",  "The sixth"};
    const auto i = static_cast<std::size_t>(part);
    return i < names.size() ? (*this)(names[i]) : (*this)("Number {n}", {{"n", juce::String{part + 1}}});
}

} // namespace physvib

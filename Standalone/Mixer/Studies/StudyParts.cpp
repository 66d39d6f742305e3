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
    silenceButton_.setTitle("Silence");
    silenceButton_.getProperties().set(stopProperty, true);
    silenceButton_.onClick = [this] { model_.setSilent(!model_.isSilent()), refresh(); };
}

void FullScreen::updateSilenceButton(const juce::String& silentText, const juce::String& playingText) {
    silenceButton_.setButtonText(model_.isSilent() ? silentText : playingText);
    silenceButton_.setToggleState(model_.isSilent(), juce::dontSendNotification);
}

void FullScreen::close() const {
    if (onClose) juce::MessageManager::callAsync([close = onClose] { close(); });
}

BigButton::BigButton(const juce::String& label, const juce::String& name)
    : juce::Button{name}
    , label_{label} {
    setTitle(name);
}

void BigButton::setText(const juce::String& label, const juce::String& remark) {
    if (label == label_ && remark == remark_) return;
    label_ = label;
    remark_ = remark;
    setDescription(remark);
    repaint();
}

void BigButton::setProgress(double share) {
    if (std::abs(share - progress_) < 1e-3) return;
    progress_ = share;
    repaint();
}

void BigButton::paintButton(juce::Graphics& g, bool isOver, bool isDown) {
    const float alpha = isEnabled() || getToggleState() ? 1.0f : 0.4f;
    auto ink = shade(*this, Shade::text);
    if (isPrimary_) {
        g.setColour(shade(*this, Shade::accent)
                        .withMultipliedAlpha(isEnabled() ? 1.0f : 0.25f)
                        .brighter(isOver && isEnabled() ? 0.1f : 0.0f));
        g.fillRoundedRectangle(getLocalBounds().toFloat().reduced(1.0f), 8.0f);
        if (isEnabled())
            ink = shade(*this, Shade::accent).getPerceivedBrightness() > 0.55f
                      ? juce::Colour{palette::Argb{0xff101218}}
                      : juce::Colours::white;
    } else {
        drawButtonShape(g, *this, isOver, isDown);
    }
    auto area = getLocalBounds().reduced(12, 8);
    if (progress_ >= 0.0) {
        auto bar = area.removeFromBottom(5).toFloat();
        area.removeFromBottom(3);
        fillRound(g, *this, Shade::line, bar, 2.5f);
        fillRound(g, *this, Shade::accent,
                  bar.withWidth(bar.getWidth() * static_cast<float>(std::min(1.0, progress_))), 2.5f);
    }
    const int labelHeight = 24, textHeight = remark_.isEmpty() ? labelHeight : labelHeight + 20;
    area = area.withSizeKeepingCentre(area.getWidth(), std::min(textHeight, area.getHeight()));
    g.setColour(ink.withMultipliedAlpha(alpha));
    g.setFont(text::font(getHeight() >= 48 && label_.length() < 24 ? text::large : text::medium));
    g.drawText(label_, area.removeFromTop(labelHeight), juce::Justification::centred, true);
    g.setColour((isPrimary_ ? ink : shade(*this, Shade::muted)).withMultipliedAlpha(alpha));
    g.setFont(text::font(text::small));
    g.drawText(remark_, area, juce::Justification::centred, true);
    if (!isMarked_) return;
    g.setColour(shade(*this, Shade::accent));
    g.fillEllipse(
        juce::Rectangle<float>{8.0f, 8.0f}.withCentre({static_cast<float>(getWidth()) - 11.0f, 11.0f}));
}

void drawButtonShape(juce::Graphics& g, const juce::Button& button, bool isOver, bool isDown, float corner) {
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

juce::Rectangle<float> fitField(juce::Rectangle<float> area, const ActuatorLayout& layout) {
    const auto aspect = static_cast<float>(layout.extentWidthMetres / layout.extentHeightMetres);
    const float width = std::min(area.getWidth(), area.getHeight() * aspect);
    return area.withSizeKeepingCentre(width, width / aspect);
}

FieldPlace actuatorPlace(const ActuatorLayout& layout, int actuator) {
    const auto& place = nth(layout.places, actuator);
    return {place.xMetres / layout.extentWidthMetres, 1.0 - place.yMetres / layout.extentHeightMetres};
}

juce::Point<float> toPixel(const juce::Rectangle<float>& field, const FieldPlace& place) {
    return {field.getX() + field.getWidth() * static_cast<float>(place.x),
            field.getY() + field.getHeight() * static_cast<float>(place.y)};
}

juce::Point<int> arrowDirection(const juce::KeyPress& key) {
    const auto isPressed = [&key](int code) { return key.isKeyCode(code) ? 1 : 0; };
    return {isPressed(juce::KeyPress::rightKey) - isPressed(juce::KeyPress::leftKey),
            isPressed(juce::KeyPress::downKey) - isPressed(juce::KeyPress::upKey)};
}

bool moveFocus(juce::Component& parent, const juce::KeyPress& key) {
    const auto direction = arrowDirection(key);
    if (direction.isOrigin()) return false;
    juce::Component* focus = nullptr;
    for (auto* child : parent.getChildren())
        if (child->hasKeyboardFocus(true)) focus = child;
    for (auto* child : parent.getChildren()) // focus is elsewhere: start from the chosen button
        if (auto* button = dynamic_cast<juce::Button*>(child);
            focus == nullptr && button != nullptr && button->getToggleState())
            focus = child;
    juce::Component* nextFocus = nullptr;
    double minDistance = 1e9;
    for (auto* child : parent.getChildren()) {
        if (child == focus || !child->isVisible() || !child->isEnabled() || !child->getWantsKeyboardFocus())
            continue;
        const auto offset =
            focus != nullptr ? child->getBounds().getCentre() - focus->getBounds().getCentre() : direction;
        const int along = offset.x * direction.x + offset.y * direction.y,
                  across = std::abs(offset.x * direction.y) + std::abs(offset.y * direction.x);
        if (along <= 0 || along < across / 2) continue;
        if (const double distance = along + 2.0 * across; distance < minDistance) {
            minDistance = distance;
            nextFocus = child;
        }
    }
    if (nextFocus != nullptr) nextFocus->grabKeyboardFocus();
    return true;
}

juce::String
StudyTexts::operator()(const std::string& english,
                       std::initializer_list<std::pair<const char*, juce::String>> values) const {
    if (!translation_.name.empty() && !translation_.texts.contains(english)) untranslated_.insert(english);
    auto text = utf8(translation_.translate(english));
    for (const auto& [name, value] : values) text = text.replace("{" + juce::String{name} + "}", value);
    return text;
}

juce::String StudyTexts::taskText(const TaskText& text, const ConditionPlan& condition) const {
    auto lines = std::holds_alternative<GridSet>(condition.stimuli)      ? text.forGrid
                 : std::holds_alternative<PatternSet>(condition.stimuli) ? text.forPatterns
                                                                         : std::string_view{};
    if (lines.empty()) lines = text.standard;
    juce::StringArray translated;
    while (!lines.empty()) translated.add((*this)(std::string{takeUntil('\n', lines)}));
    return translated.joinIntoString("\n");
}

juce::String StudyTexts::question(const SessionPlan& session, const ConditionPlan& condition) const {
    return session.question.empty() ? taskText(taskDescription(session.task).question, condition)
                                    : (*this)(session.question);
}

juce::String StudyTexts::playText(const SessionPlan& session) const {
    const StudyTexts& tr = *this;
    if (session.maxPlays == 0) return tr("Feel it as often as you like.") + "\n";
    if (session.maxPlays == 1) return tr("Feel it once.") + "\n";
    return tr("Feel it at most {n} times.", {{"n", juce::String{session.maxPlays}}}) + "\n";
}

juce::String StudyTexts::instruction(const SessionPlan& session, const ConditionPlan& condition) const {
    const StudyTexts& tr = *this;
    if (!session.instruction.empty()) return tr(session.instruction);
    if (const auto* world = std::get_if<WorldSet>(&condition.stimuli);
        world != nullptr && world->isInteractive)
        return tr("The numbers show one world each: drag what moves in it, and tilt it with the arrow keys, "
                  "each about half of the time.") +
               "\n" +
               (session.minSeconds > 0.0
                    ? tr("Play with each for at least {n} s, then pause and answer.",
                         {{"n", number(session.minSeconds, session.minSeconds < 1.0 ? 1 : 0)}})
                    : tr("Play with each, then pause and answer."));
    if (session.minTouches > 0)
        return tr("Touch the field anywhere and feel that place.") + "\n" +
               tr("Go on for as long as you like; Next ends the training.");
    if (session.isQuestionnaire) return {};
    const bool saysPlays = session.answerKind() != AnswerKind::request && session.alternatives.empty();
    const StudyTask task = session.answers.empty() ? session.task : StudyTask::identify;
    const auto limitText = [&](double s) {
        return "\n" + tr("Answer within {n} s.", {{"n", number(s, s < 10.0 ? 1 : 0)}});
    };
    return (saysPlays ? playText(session) : juce::String{}) +
           taskText(taskDescription(task).instruction, condition) +
           (session.answerSeconds > 0.0 ? limitText(session.answerSeconds) : juce::String{});
}

juce::String StudyTexts::ordinal(int part) const {
    static constexpr std::array names{"The first",  "The second", "The third",
                                      "The fourth", "The fifth",  "The sixth"};
    const auto i = static_cast<std::size_t>(part);
    return i < names.size() ? (*this)(names[i]) : (*this)("Number {n}", {{"n", juce::String{part + 1}}});
}

} // namespace physvib

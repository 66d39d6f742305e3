// SPDX-License-Identifier: GPL-3.0-or-later
// Layout of a question: text, and answer buttons in rows of three.
#include "Mixer/Window/QuestionCard.h"
#include <utility>

namespace physvib {

namespace {
constexpr int edgeX = 24, edgeY = 20;
}

/// A field with its title.
class QuestionCard::Input final : public juce::Component {
public:
    explicit Input(const Field& field)
        : name{field.title} {
        text.setTitle(name);
        text.setFont(juce::Font{physvib::text::medium});
        text.setText(field.value, false);
        text.setSelectAllWhenFocused(true);
        if (field.allowed.isNotEmpty()) text.setInputRestrictions(32, field.allowed);
        list.setTitle(name);
        list.addItemList(field.choices, 1);
        list.setText(field.value, juce::dontSendNotification);
        addAndMakeVisible(control());
    }
    juce::Component& control() { return list.getNumItems() > 0 ? static_cast<juce::Component&>(list) : text; }
    juce::String value() const { return list.getNumItems() > 0 ? list.getText() : text.getText().trim(); }
    void paint(juce::Graphics& g) override {
        g.setColour(shade(*this, Shade::muted));
        g.setFont(juce::Font{physvib::text::small});
        g.drawText(name, getLocalBounds().withWidth(nameWidth), juce::Justification::centredLeft, true);
    }
    void resized() override { control().setBounds(getLocalBounds().withTrimmedLeft(nameWidth)); }

    static constexpr int nameWidth = 130;
    const juce::String name;
    juce::TextEditor text;
    juce::ComboBox list;
};

QuestionCard::~QuestionCard() = default;

QuestionCard::QuestionCard(const juce::String& title, const juce::String& words, std::vector<Answer> answers,
                           const std::vector<Field>& fields)
    : answers_{std::move(answers)} {
    setTitle(title);
    setDescription(words);
    setWantsKeyboardFocus(true);
    title_.setText(title, juce::dontSendNotification);
    title_.setFont(juce::Font{text::large, juce::Font::bold});
    words_.setText(words, juce::dontSendNotification);
    words_.setFont(juce::Font{text::medium});
    words_.setJustificationType(juce::Justification::topLeft);
    words_.setMinimumHorizontalScale(1.0f); // it has space for all lines
    for (juce::Component* c : {&title_, &words_}) addAndMakeVisible(c);
    answers_.front().key = juce::KeyPress{juce::KeyPress::returnKey};
    for (std::size_t k = 0; k < answers_.size(); ++k) {
        const Answer& answer = answers_[k];
        auto& button = *buttons_.emplace_back(std::make_unique<juce::TextButton>(answer.words));
        button.setTitle(answer.words);
        if (answer.key.isValid())
            button.setTooltip(answer.words + " (" + answer.key.getTextDescription() + ")");
        button.setEnabled(answer.isEnabled);
        button.setToggleState(k == 0 && answer.isEnabled, juce::dontSendNotification); // Return selects it
        button.onClick = [this, k] { act(k); };
        addAndMakeVisible(button);
    }
    for (const Field& field : fields) {
        auto& added = *inputs_.emplace_back(std::make_unique<Input>(field));
        addAndMakeVisible(added);
        if (field.onChange)
            added.list.onChange =
                added.text.onTextChange = [this, &added, use = field.onChange] { use(*this, added.value()); };
        added.text.onReturnKey = [this] { act(0); };
        added.text.onEscapeKey = [this] { keyPressed(juce::KeyPress{juce::KeyPress::escapeKey}); };
    }
    prepareControls(*this);
    fit();
}

// The title, the words and the rows; beside them a picture.
void QuestionCard::fit() {
    const int rows = (static_cast<int>(answers_.size()) + perRow - 1) / perRow;
    const int high = (words_.getText().isEmpty() ? 110 : 174) + rows * (rowHigh + gap) +
                     static_cast<int>(inputs_.size()) * (rowHeight + gap);
    if (picture_.isNull()) return setSize(wide, high);
    setSize(wide + edgeX + picture_.getWidth(), std::max(high, picture_.getHeight() + 2 * edgeY));
}

void QuestionCard::setPicture(const juce::Image& picture) {
    const auto middle = getBounds().getCentre();
    picture_ = picture;
    fit();
    setCentrePosition(middle);
    repaint();
}

juce::String QuestionCard::value(const juce::String& field) const {
    for (const auto& input : inputs_)
        if (input->name == field) return input->value();
    return {};
}

void QuestionCard::setValue(const juce::String& field, const juce::String& value) {
    for (auto& input : inputs_)
        if (input->name == field) {
            input->text.setText(value, false);
            input->list.setText(value, juce::dontSendNotification);
        }
}

void QuestionCard::answer(const juce::String& words) {
    for (std::size_t k = 0; k < answers_.size(); ++k)
        if (answers_[k].words == words) return act(k);
}

// Asynchronous, because the button's click is still being handled and the action may destroy the card.
void QuestionCard::act(std::size_t which) {
    if (!answers_[which].isEnabled) return;
    juce::MessageManager::callAsync([safe = juce::Component::SafePointer<QuestionCard>{this}, which] {
        if (safe == nullptr) return;
        const auto act = safe->answers_[which].act;
        act();
    });
}

bool QuestionCard::keyPressed(const juce::KeyPress& key) {
    for (std::size_t k = 0; k < answers_.size(); ++k)
        if (buttons_[k]->hasKeyboardFocus(false) && key == juce::KeyPress::returnKey) return act(k), true;
    for (std::size_t k = 0; k < answers_.size(); ++k)
        if (key == answers_[k].key) return act(k), true;
    return false;
}

void QuestionCard::paint(juce::Graphics& g) {
    drawCard(g, *this);
    g.setImageResamplingQuality(juce::Graphics::lowResamplingQuality); // sharp on finer screens
    g.drawImageAt(picture_, getWidth() - edgeX - picture_.getWidth(), edgeY);
}

void QuestionCard::resized() {
    auto area = getLocalBounds().reduced(edgeX, edgeY);
    if (!picture_.isNull()) area.removeFromRight(picture_.getWidth() + edgeX);
    title_.setBounds(area.removeFromTop(30));
    const int width = (area.getWidth() - (perRow - 1) * gap) / perRow;
    auto rows = area.removeFromBottom(
        static_cast<int>(buttons_.size() + perRow - 1) / perRow * (rowHigh + gap) - gap);
    for (std::size_t k = 0; k < buttons_.size(); ++k) {
        const auto at = static_cast<int>(k);
        buttons_[k]->setBounds(rows.getX() + at % perRow * (width + gap),
                               rows.getY() + at / perRow * (rowHigh + gap), width, rowHigh);
    }
    area.removeFromBottom(gap);
    for (auto input = inputs_.rbegin(); input != inputs_.rend(); ++input) {
        (*input)->setBounds(area.removeFromBottom(rowHeight));
        area.removeFromBottom(gap);
    }
    words_.setBounds(area.withTrimmedTop(4));
}

} // namespace physvib

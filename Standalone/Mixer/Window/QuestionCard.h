// SPDX-License-Identifier: GPL-3.0-or-later
// Dialogue card over the window, with fields to fill in: Return selects the first answer, buttons and keys
// the others.
#pragma once
#include "Mixer/Window/Parts.h"
#include <functional>
#include <memory>
#include <vector>

namespace physvib {

/// Message thread only.
class QuestionCard final : public juce::Component {
public:
    static constexpr int wide = 520, perRow = 3, rowHigh = 34;

    struct Answer {
        juce::String words;
        std::function<void()> act; ///< may destroy the card
        bool isEnabled = true;
        juce::KeyPress key{};
    };

    /// Asks for a text, or for one of some choices.
    struct Field {
        juce::String title, value;
        juce::String allowed{};                                                   ///< characters; empty: all
        juce::StringArray choices{};                                              ///< empty: any text
        std::function<void(QuestionCard&, const juce::String& value)> onChange{}; ///< chosen or typed
    };

    QuestionCard(const juce::String& title, const juce::String& words, std::vector<Answer> answers,
                 const std::vector<Field>& fields = {});
    ~QuestionCard() override;

    juce::String value(const juce::String& field) const; ///< as typed
    void setValue(const juce::String& field, const juce::String& value);

    /// A square beside the words, with sharp pixels; null: none.
    void setPicture(const juce::Image& picture);
    const juce::Image& picture() const noexcept { return picture_; }

    /// Same as a click on that button; no effect if it is missing or disabled.
    void answer(const juce::String& words);
    juce::String words() const { return words_.getText(); }
    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    class Input;
    void act(std::size_t which);

    void fit();

    juce::Label title_, words_;
    juce::Image picture_;
    std::vector<Answer> answers_;
    std::vector<std::unique_ptr<juce::TextButton>> buttons_;
    std::vector<std::unique_ptr<Input>> inputs_;
};

} // namespace physvib

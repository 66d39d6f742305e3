// SPDX-License-Identifier: GPL-3.0-or-later
// Timeline with a mark for each recorded input and the two ends of the kept part.
#include "Mixer/World/ScriptStrip.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

constexpr double stepSeconds = 0.01; // one step of the world; parts start and end at steps

juce::String countOf(std::size_t inputs) {
    return juce::String{static_cast<int>(inputs)} + (inputs == 1 ? " input" : " inputs");
}

} // namespace

ScriptStrip::ScriptStrip(Desk& desk)
    : desk_{desk} {
    setTitle("Script of hands");
    words_.setFont(juce::Font{text::medium});
    for (auto* slider : {&from_, &to_}) {
        slider->setSliderStyle(juce::Slider::LinearBar);
        slider->setRange(0.0, 1.0, stepSeconds);
        slider->valueFromTextFunction = [](const juce::String& words) {
            return words.retainCharacters("0123456789.").getDoubleValue();
        };
        slider->onDragEnd = [this] { use(); };
        slider->onValueChange = [this, slider] {
            if (!slider->isMouseButtonDown()) use();
            repaint();
        };
    }
    from_.setTitle("The script begins at");
    from_.setTooltip("Where the script begins, in seconds of the recording");
    from_.textFromValueFunction = [](double s) { return "from " + number(s, 2) + " s"; };
    to_.setTitle("The script ends at");
    to_.setTooltip("Where the script ends, in seconds of the recording");
    to_.textFromValueFunction = [](double s) { return "to " + number(s, 2) + " s"; };
    repeats_.setTitle("Repeat the script");
    repeats_.setTooltip("Begins again at its end, for ever");
    repeats_.onClick = [this] { use(); };
    end_.setTitle("End the recording of hands");
    end_.setTooltip("End the recording of hands (Ctrl+Shift+R)");
    end_.setToggleState(true, juce::dontSendNotification);
    end_.onClick = [this] { desk_.script().stop(); };
    again_.setTitle("Play the script from the start");
    again_.onClick = [this] { desk_.restart(desk_.mix().seed); };
    close_.setTitle("Close the script of hands");
    close_.setTooltip("The script stays");
    close_.onClick = [this] {
        closed_ = desk_.mix().scene;
        setVisible(false);
    };
    for (juce::Component* c :
         std::initializer_list<juce::Component*>{&words_, &from_, &to_, &repeats_, &end_, &again_, &close_})
        addChildComponent(c);
    setSize(400, high);
}

void ScriptStrip::refresh(bool isHand) {
    const auto& script = desk_.script();
    const HandScript* hands = script.hands();
    setVisible(isHand && (script.isRecording() || (hands != nullptr && closed_ != desk_.mix().scene)));
    if (!isVisible()) return;
    const bool isOther = std::exchange(shown_, desk_.mix().scene) != desk_.mix().scene,
               isTurned = std::exchange(wasRecording_, script.isRecording()) != script.isRecording();
    if (isOther || isTurned) show();
    const auto dot = "  " + juce::String::charToString(0x00b7) + "  ";
    if (script.isRecording())
        words_.setText("Recording hands" + dot + number(script.seconds(), 1) + " s" + dot +
                           countOf(script.inputs()),
                       juce::dontSendNotification);
    else
        words_.setText("Script of hands" + dot + countOf(hands->inputs.size()) + " in " +
                           number(hands->lengthSeconds, 2) + " s",
                       juce::dontSendNotification);
    words_.setColour(juce::Label::textColourId,
                     shade(*this, script.isRecording() ? Shade::limit : Shade::text));
}

void ScriptStrip::show() {
    const bool isRecording = desk_.script().isRecording();
    setSize(getWidth(), isRecording ? recordingHigh : high);
    words_.setVisible(true);
    end_.setVisible(isRecording);
    for (juce::Component* c :
         std::initializer_list<juce::Component*>{&from_, &to_, &repeats_, &again_, &close_})
        c->setVisible(!isRecording);
    if (const HandScript* hands = desk_.script().hands()) {
        const ScriptTrim trim = desk_.script().trim();
        for (auto* slider : {&from_, &to_})
            slider->setRange(0.0, std::max(stepSeconds, hands->lengthSeconds), stepSeconds);
        from_.setValue(trim.fromSeconds, juce::dontSendNotification);
        to_.setValue(trim.toSeconds, juce::dontSendNotification);
        repeats_.setToggleState(trim.repeats, juce::dontSendNotification);
        repeats_.setEnabled(desk_.mix().scene->scriptPeriodSeconds == 0.0 ||
                            trim.repeats); // otherwise the rest of the script has its own period
    }
    repaint();
}

void ScriptStrip::use() {
    if (desk_.script().hands() == nullptr) return;
    if (to_.getValue() - from_.getValue() < stepSeconds) return show(); // the part would be empty
    desk_.script().setTrim({from_.getValue(), to_.getValue(), repeats_.getToggleState()});
    repaint();
}

juce::Rectangle<int> ScriptStrip::lane() const {
    return getLocalBounds().reduced(12, 8).removeFromBottom(22);
}

float ScriptStrip::placeOf(double seconds) const {
    const auto at = lane().toFloat();
    return at.getX() +
           static_cast<float>(seconds / std::max(stepSeconds, from_.getMaximum())) * at.getWidth();
}

void ScriptStrip::paint(juce::Graphics& g) {
    g.setColour(shade(*this, Shade::raised).withAlpha(0.96f));
    g.fillRoundedRectangle(getLocalBounds().toFloat(), 8.0f);
    const HandScript* hands = desk_.script().hands();
    if (hands == nullptr) return;
    const auto at = lane().toFloat();
    g.setColour(shade(*this, Shade::well));
    g.fillRoundedRectangle(at, 4.0f);
    const float from = placeOf(from_.getValue()), to = placeOf(to_.getValue());
    g.setColour(shade(*this, Shade::accent).withAlpha(0.18f));
    g.fillRect(at.withLeft(from).withRight(to));
    for (const LiveInput& input : hands->inputs) {
        const float x = placeOf(input.timeSeconds);
        const bool isIn = x >= from && x <= to, isHeld = std::holds_alternative<GripAction>(input.action);
        g.setColour(shade(*this, isIn ? Shade::text : Shade::muted).withAlpha(isIn ? 0.9f : 0.35f));
        g.fillRect(juce::Rectangle<float>{1.5f, isHeld ? 7.0f : 16.0f}.withCentre({x, at.getCentreY()}));
    }
    g.setColour(shade(*this, Shade::accent));
    for (const float x : {from, to})
        g.fillRect(juce::Rectangle<float>{3.0f, at.getHeight()}.withCentre({x, at.getCentreY()}));
}

// Moves the nearer end.
void ScriptStrip::mouseDown(const juce::MouseEvent& e) {
    dragged_ = nullptr;
    if (desk_.script().hands() == nullptr || !lane().expanded(6, 4).contains(e.getPosition())) return;
    dragged_ =
        std::abs(e.position.x - placeOf(from_.getValue())) < std::abs(e.position.x - placeOf(to_.getValue()))
            ? &from_
            : &to_;
    mouseDrag(e);
}

void ScriptStrip::mouseDrag(const juce::MouseEvent& e) {
    if (dragged_ == nullptr) return;
    const auto at = lane().toFloat();
    dragged_->setValue(from_.getMaximum() * static_cast<double>((e.position.x - at.getX()) / at.getWidth()),
                       juce::dontSendNotification);
    repaint();
}

void ScriptStrip::mouseUp(const juce::MouseEvent&) {
    if (std::exchange(dragged_, nullptr) != nullptr) use();
}

void ScriptStrip::resized() {
    auto area = getLocalBounds().reduced(12, 8);
    auto row = area.removeFromTop(24);
    for (auto* button : {&close_, &again_})
        button->setBounds(row.removeFromRight(button == &close_ ? 60 : 110)), row.removeFromRight(6);
    end_.setBounds(getLocalBounds().reduced(12, 8).removeFromTop(24).removeFromRight(90));
    words_.setBounds(row);
    area.removeFromTop(5);
    row = area.removeFromTop(22);
    from_.setBounds(row.removeFromLeft(130));
    row.removeFromLeft(8);
    to_.setBounds(row.removeFromLeft(130));
    row.removeFromLeft(12);
    repeats_.setBounds(row.removeFromLeft(90));
}

} // namespace physvib

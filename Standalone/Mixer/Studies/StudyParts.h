// SPDX-License-Identifier: GPL-3.0-or-later
// Common parts of participants' screens: large buttons, a field with its actuators, arrow keys.
#pragma once
#include "Host/Views/WorldPictures.h"
#include "Io/Result.h"
#include "Lab/Files/Words.h"
#include "Lab/Study/Identification.h"
#include "Lab/Study/Protocol.h"
#include "Mixer/Widgets/Parts.h"
#include "Scene/LayoutFile.h"
#include <juce_core/juce_core.h>
#include <set>
#include <string>
#include <vector>

namespace physvib {

/// Left and right margin of the screens that fill the window, in pixels.
constexpr int pageInset = 40;

/// A large button with text, a smaller remark below, and a bar at its lower edge.
class BigButton final : public juce::Button {
public:
    /// `name` is for screen readers.
    BigButton(const juce::String& words, const juce::String& name);
    void setWords(const juce::String& words, const juce::String& remark = {});
    void setShare(double share);   ///< of the bar, 0 to 1; negative: no bar
    void setMain(bool isMain);     ///< the button that continues
    void setMarked(bool isMarked); ///< shows a dot
    void paintButton(juce::Graphics& g, bool isOver, bool isDown) override;

private:
    juce::String words_, remark_;
    double share_ = -1.0;
    bool isMain_ = false, isMarked_ = false;
};

/// Draws the background of a button in its state.
void drawTarget(juce::Graphics& g, const juce::Button& button, bool isOver, bool isDown, float corner = 8.0f);

/// Largest centred rectangle in `area` with the layout's aspect ratio.
juce::Rectangle<float> fieldIn(juce::Rectangle<float> area, const EnchanterLayout& layout);
/// Place of an actuator on the field: x to the right, y downwards, 0 to 1.
FieldPlace placeOf(const EnchanterLayout& layout, int enchanter);
juce::Point<float> pointOn(const juce::Rectangle<float>& field, const FieldPlace& place);
/// Draws the field with its actuators as labelled rings.
void drawField(juce::Graphics& g, const juce::Component& component, const juce::Rectangle<float>& field,
               const LayoutDescription& layout);

/// Draws an actuator of the field with its label, which is moved outwards if a point lies on it.
void drawEnchanterBeside(juce::Graphics& g, const juce::Component& component,
                         const juce::Rectangle<float>& field, const LayoutDescription& layout, int enchanter);

/// Moves the focus to the nearest child of `parent` in the direction of an arrow key; false for other keys.
bool moveFocus(juce::Component& parent, const juce::KeyPress& key);

/// Texts for participants, translated and with values inserted.
/// The texts of the screens and of a protocol in the participant's language. Message thread.
class StudyWords {
public:
    explicit StudyWords(Words words = {})
        : words_{std::move(words)} {}

    /// "trial {n}" with the value of {n}. Without a translation: English, and recorded in missed().
    juce::String operator()(const std::string& english,
                            std::initializer_list<std::pair<const char*, juce::String>> values = {}) const;
    const std::set<std::string>& missed() const noexcept { return missed_; }

    /// Question of a trial: the protocol's, or the task's default.
    juce::String question(const SessionPlan& session, const ConditionPlan& condition) const;
    /// Course of a session, in a few lines.
    juce::String instruction(const SessionPlan& session, const ConditionPlan& condition) const;
    /// "the first", for the parts to choose from.
    juce::String ordinal(int part) const;

private:
    juce::String lines(const TaskText& text, const ConditionPlan& condition) const;
    juce::String feel(const SessionPlan& session) const;
    Words words_;
    mutable std::set<std::string> missed_;
};

/// "1:05". Any thread.
juce::String minutesText(double seconds);

/// Appearance of a world for a participant: pictures of materials, and display scale.
/// That participant's pictures, or an error line. Message thread.
Result<std::vector<MaterialPicture>> materialPictures(const Protocol& protocol,
                                                      const std::string& participant);

/// Empty, or an error if the protocol has a display scale but the display width (metres) is not set (0). Any
/// thread (allocates).
std::string displayScaleFault(const Protocol& protocol, double displayWidthMetres);

} // namespace physvib

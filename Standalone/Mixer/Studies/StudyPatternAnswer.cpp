// SPDX-License-Identifier: GPL-3.0-or-later
// Answer for patterns in two clicks: the first pulse's actuator, then an icon of the whole pattern (thesis
// 3.2.2). Icons show the order by colour and number, and the actuator by place.
#include "Mixer/Studies/StudyAnswer.h"
#include "Mixer/Studies/StudyParts.h"
#include "Stimuli/PulsePattern.h"
#include <map>

namespace physvib {
namespace {

juce::Colour orderColour(int pulse) { return palette::ramp(1 + 2 * pulse); } // from cool to warm colours

void drawPulse(juce::Graphics& g, juce::Point<float> at, float radius, int pulse, float light) {
    const auto disc = juce::Rectangle<float>{2.0f * radius, 2.0f * radius}.withCentre(at);
    g.setColour(orderColour(pulse).withMultipliedAlpha(light));
    g.fillEllipse(disc);
    g.setColour(juce::Colour{palette::Argb{0xff101218}}.withMultipliedAlpha(light));
    g.setFont(juce::Font{text::small, juce::Font::bold});
    g.drawText(juce::String{pulse + 1}, disc, juce::Justification::centred, false);
}

/// Button with a pattern on a small field.
class PatternIcon final : public juce::Button {
public:
    PatternIcon(const PulsePattern& p, const LayoutDescription& layout)
        : juce::Button{utf8(patternLabel(p))}
        , pattern{p}
        , layout_{layout} {
        juce::StringArray words;
        for (int k = 0; k < p.count; ++k)
            words.add(
                utf8(layout.enchanters[static_cast<std::size_t>(p.enchanters[static_cast<std::size_t>(k)])]
                         .label));
        setTitle(words.joinIntoString(" then ") + ", " +
                 juce::String{juce::roundToInt(1e3 * p.pulseSeconds)} + " ms");
    }
    const PulsePattern pattern;
    bool isFelt = false;

    void paintButton(juce::Graphics& g, bool isOver, bool isDown) override {
        drawTarget(g, *this, isOver, isDown, 6.0f);
        const float light = isEnabled() ? 1.0f : 0.4f, radius = 8.5f;
        // In low icons the discs of two rows touch.
        const float above = std::clamp(0.5f * static_cast<float>(getHeight()) - radius - 1.0f, radius, 14.0f);
        const auto inner = getLocalBounds().toFloat().reduced(18.0f, above);
        for (int j = 0; j < layout_.geometry.count; ++j) {
            const auto at = pointOn(inner, placeOf(layout_.geometry, j));
            int here = 0;
            for (int k = 0; k < pattern.count; ++k)
                here += pattern.enchanters[static_cast<std::size_t>(k)] == j ? 1 : 0;
            if (here == 0) {
                g.setColour(shade(*this, Shade::muted).withMultipliedAlpha(0.55f * light));
                g.drawEllipse(juce::Rectangle<float>{7.0f, 7.0f}.withCentre(at), 1.5f);
            }
            // Pulses of one actuator are drawn side by side, towards the centre of the icon.
            float x = std::clamp(at.x - 0.5f * static_cast<float>(here - 1) * 2.0f * radius, 4.0f + radius,
                                 static_cast<float>(getWidth()) - 4.0f - radius -
                                     static_cast<float>(here - 1) * 2.0f * radius);
            for (int k = 0; k < pattern.count; ++k) {
                if (pattern.enchanters[static_cast<std::size_t>(k)] != j) continue;
                drawPulse(g, {x, at.y}, radius, k, light);
                x += 2.0f * radius;
            }
        }
        if (!isFelt) return;
        g.setColour(shade(*this, Shade::accent));
        g.drawRoundedRectangle(getLocalBounds().toFloat().reduced(1.0f), 6.0f, 1.5f);
    }

private:
    const LayoutDescription& layout_;
};

class PatternAnswer final : public ChosenAnswer {
public:
    PatternAnswer(const ConditionPlan& condition, const LayoutDescription& layout, const StudyWords& words)
        : layout_{layout}
        , say_{words} {
        setTitle("Patterns");
        for (const StimulusItem& item : stimuliOf(condition))
            if (const auto pattern = parsePatternLabel(item.label)) addIcon(*pattern);
        for (int j = 0; j < layout_.geometry.count; ++j) {
            const auto label = utf8(layout_.enchanters[static_cast<std::size_t>(j)].label);
            auto& button = firsts_.emplace_back(std::make_unique<BigButton>(label, "First pulse: " + label));
            button->onClick = [this, j] { chooseFirst(j); };
            addAndMakeVisible(*button);
        }
        chooseFirst(-1);
    }
    std::string keys() const override { return "Letter: first pulse.  Arrows and Enter: pattern."; }
    bool takeKey(const juce::KeyPress& key) override {
        const auto typed =
            juce::String::charToString(juce::CharacterFunctions::toUpperCase(key.getTextCharacter()));
        for (int j = 0; j < layout_.geometry.count; ++j)
            if (isEnabled() && typed == utf8(layout_.enchanters[static_cast<std::size_t>(j)].label))
                return chooseFirst(j), focusIcons(), true;
        return moveFocus(*this, key);
    }
    void beginAnew() override { firsts_.front()->grabKeyboardFocus(); }
    void mark(const std::set<std::string>& felt) override {
        for (auto& icon : icons_) icon->isFelt = felt.contains(patternLabel(icon->pattern));
        repaint();
    }

    void paint(juce::Graphics& g) override {
        const auto heading = [&](const juce::String& words, juce::Rectangle<int> row) {
            g.setColour(shade(*this, isEnabled() ? Shade::text : Shade::muted));
            g.setFont(juce::Font{text::medium, juce::Font::bold});
            g.drawText(words, row, juce::Justification::centredLeft, true);
        };
        heading("1   " + say_("Place of the first pulse"), firstHeading_);
        heading("2   " + say_("Whole pattern"), iconHeading_);
        g.setColour(shade(*this, Shade::well));
        g.fillRoundedRectangle(field_.expanded(50.0f, 44.0f), 12.0f);
        auto legend = iconHeading_.withTrimmedLeft(170);
        static constexpr std::array names{"first", "second", "third"};
        for (int k = 0; k < 3; ++k) {
            auto part = legend.removeFromLeft(92);
            drawPulse(g, part.removeFromLeft(20).toFloat().getCentre(), 8.5f, k, 1.0f);
            g.setColour(shade(*this, Shade::muted));
            g.setFont(juce::Font{text::small});
            g.drawText(say_(names[static_cast<std::size_t>(k)]), part.withTrimmedLeft(6),
                       juce::Justification::centredLeft, true);
        }
        g.setColour(shade(*this, Shade::muted));
        g.setFont(juce::Font{text::medium});
        if (first_ < 0)
            g.drawText(say_("Choose the first pulse's place."), iconsArea_, juce::Justification::centred,
                       true);
        for (const auto& [ms, row] : rows_)
            g.drawText(say_("Pulses of {n} ms", {{"n", juce::String{ms}}}), row,
                       juce::Justification::centredLeft, true);
    }

    void resized() override {
        auto area = getLocalBounds();
        auto left = area.removeFromLeft(std::clamp(getWidth() / 4, 240, 330));
        area.removeFromLeft(32);
        firstHeading_ = left.removeFromTop(32);
        iconHeading_ = area.removeFromTop(32);
        field_ = fieldIn(left.removeFromTop(std::min(left.getHeight(), 300)).toFloat().reduced(50.0f, 44.0f),
                         layout_.geometry);
        for (int j = 0; j < layout_.geometry.count; ++j)
            firsts_[static_cast<std::size_t>(j)]->setBounds(juce::Rectangle<int>{72, 64}.withCentre(
                pointOn(field_, placeOf(layout_.geometry, j)).toInt()));
        iconsArea_ = area;
        placeIcons();
    }
    void enablementChanged() override { repaint(); }

private:
    void addIcon(const PulsePattern& pattern) {
        auto& icon = icons_.emplace_back(std::make_unique<PatternIcon>(pattern, layout_));
        icon->onClick = [this, at = icon.get()] { choose(patternLabel(at->pattern)); };
        addChildComponent(*icon);
    }

    void chooseFirst(int enchanter) {
        first_ = enchanter;
        for (std::size_t j = 0; j < firsts_.size(); ++j)
            firsts_[j]->setToggleState(static_cast<int>(j) == enchanter, juce::dontSendNotification);
        for (auto& icon : icons_) icon->setVisible(icon->pattern.enchanters[0] == enchanter);
        placeIcons();
        repaint();
    }

    void focusIcons() {
        for (auto& icon : icons_)
            if (icon->isVisible()) return icon->grabKeyboardFocus();
    }

    /// One row group per duration, with the icons of one, two and three pulses.
    void placeIcons() {
        std::map<int, std::vector<PatternIcon*>> shown;
        for (auto& icon : icons_)
            if (icon->isVisible())
                shown[juce::roundToInt(1e3 * icon->pattern.pulseSeconds)].push_back(icon.get());
        rows_.clear();
        if (shown.empty()) return;
        constexpr int across = 7, captionHeight = 26, space = 6;
        int lines = 0;
        for (const auto& [ms, some] : shown) lines += (static_cast<int>(some.size()) + across - 1) / across;
        auto area = iconsArea_;
        const int free = area.getHeight() - captionHeight * static_cast<int>(shown.size());
        const int height = std::clamp(free / lines - space, 28, 110); // equal in all rows
        const int width = std::clamp(area.getWidth() / across - space, 60, 150);
        for (const auto& [ms, some] : shown) {
            rows_.emplace_back(ms, area.removeFromTop(captionHeight));
            juce::Rectangle<int> row;
            for (std::size_t i = 0; i < some.size(); ++i) {
                if (i % across == 0) row = area.removeFromTop(height + space);
                some[i]->setBounds(
                    row.removeFromLeft(width + space).withTrimmedRight(space).withTrimmedBottom(space));
            }
        }
    }

    void showChosen(const std::string& response) override {
        for (auto& icon : icons_)
            icon->setToggleState(patternLabel(icon->pattern) == response, juce::dontSendNotification);
    }

    const LayoutDescription layout_;
    const StudyWords& say_;
    std::vector<std::unique_ptr<BigButton>> firsts_;
    std::vector<std::unique_ptr<PatternIcon>> icons_;
    juce::Rectangle<int> firstHeading_, iconHeading_, iconsArea_;
    juce::Rectangle<float> field_;
    std::vector<std::pair<int, juce::Rectangle<int>>> rows_; // duration in ms, and area of its caption
    int first_ = -1;
};

} // namespace

std::unique_ptr<StudyAnswer> makePatternAnswer(const ConditionPlan& condition,
                                               const LayoutDescription& layout, const StudyWords& words) {
    return std::make_unique<PatternAnswer>(condition, layout, words);
}

} // namespace physvib

// SPDX-License-Identifier: GPL-3.0-or-later
// Answers on the field: a cell of a grid, any place, or a pattern of pulses.
#include "Mixer/Studies/StudyParts.h"
#include "Stimuli/Stimulus.h"
#include <map>

namespace physvib {
namespace {

constexpr float margin = 24.0f;

void drawRing(juce::Graphics& g, const juce::Component& component, juce::Point<float> centre,
              const LayoutDescription& layout, int actuator) {
    const auto ring = juce::Rectangle<float>{26.0f, 26.0f}.withCentre(centre);
    g.setColour(shade(component, Shade::panel));
    g.fillEllipse(ring);
    g.setColour(actuatorColour(component, actuator));
    g.drawEllipse(ring, 2.0f);
    g.setFont(text::font(text::small, juce::Font::bold));
    g.drawText(utf8(nth(layout.actuators, actuator).label), ring, juce::Justification::centred, false);
}

/// The field with its actuators as labelled rings.
void drawField(juce::Graphics& g, const juce::Component& component, const juce::Rectangle<float>& field,
               const LayoutDescription& layout) {
    fillRound(g, component, Shade::well, field, 10.0f);
    g.setColour(shade(component, Shade::line));
    g.drawRoundedRectangle(field, 10.0f, 1.5f);
    for (int j = 0; j < layout.geometry.count; ++j)
        drawRing(g, component, toPixel(field, actuatorPlace(layout.geometry, j)), layout, j);
}

/// Draws an actuator beside its place, towards the outside, as a point of the grid may lie on it.
void drawActuatorBeside(juce::Graphics& g, const juce::Component& component,
                        const juce::Rectangle<float>& field, const LayoutDescription& layout, int actuator) {
    constexpr float offsetPixels = 46.0f;
    const auto place = actuatorPlace(layout.geometry, actuator);
    const auto outwardSign = [](double share) { return share < 0.34 ? -1.0f : share > 0.66 ? 1.0f : 0.0f; };
    juce::Point<float> offset{outwardSign(place.x), outwardSign(place.y)};
    if (offset.isOrigin()) offset.y = -1.0f;
    drawRing(g, component, toPixel(field, place) + offset * (offsetPixels / offset.getDistanceFromOrigin()),
             layout, actuator);
}

/// A point of the grid at the place of its stimulus: yellow, red once it was played, as in thesis Fig. 4.1.
class CellButton final : public juce::Button {
public:
    explicit CellButton(const GridCell& c)
        : juce::Button{utf8(gridLabel(c))}
        , cell{c} {
        setTitle("Row " + juce::String{c.row} + ", column " + juce::String{c.column});
    }
    const GridCell cell;
    bool wasPlayed = false;
    void paintButton(juce::Graphics& g, bool isOver, bool isDown) override {
        const auto disc = getLocalBounds().toFloat().reduced(2.0f);
        drawButtonShape(g, *this, isOver, isDown, disc.getWidth() / 2.0f);
        g.setColour(juce::Colour{palette::Argb{wasPlayed ? 0xffff6b6b : 0xffe8b800}}.withMultipliedAlpha(
            isEnabled() ? 1.0f : 0.4f));
        g.fillEllipse(juce::Rectangle<float>{14.0f, 14.0f}.withCentre(disc.getCentre()));
    }
};

/// Answer on a grid. All grids of a layout have their corners at the same pixels. The outer points of a grid
/// with Points::corners lie on the actuators.
class CellAnswer final : public ButtonAnswer {
public:
    CellAnswer(const GridSet& grid, const LayoutDescription& layout)
        : grid_{grid.grid()}
        , layout_{layout} {
        setTitle("Grid");
        for (const GridCell& cell : grid_.cells()) {
            auto& button = cells_.emplace_back(std::make_unique<CellButton>(cell));
            addChoice(*button, gridLabel(cell));
            addAndMakeVisible(*button);
        }
    }
    std::string keyHelp() const override { return "Arrows and Enter: place.  Enter: confirm."; }
    bool handleKey(const juce::KeyPress& key) override { return moveFocus(*this, key); }
    void focusFirst() override { cells_[cells_.size() / 2]->grabKeyboardFocus(); }
    void markPlayed(const std::set<std::string>& played) override {
        for (auto& cell : cells_) cell->wasPlayed = played.contains(gridLabel(cell->cell));
        repaint();
    }
    void paint(juce::Graphics& g) override {
        fillRound(g, *this, Shade::well, field().expanded(cellMargin - 6.0f), 14.0f);
        for (int j = 0; j < layout_.geometry.count; ++j) drawActuatorBeside(g, *this, field(), layout_, j);
    }
    void resized() override {
        const auto area = field();
        const auto spacing = [](float length, int lines) {
            return lines > 1 ? length / static_cast<float>(lines - 1) : length;
        };
        const int size = juce::roundToInt(std::clamp(
            0.8f * std::min(spacing(area.getWidth(), grid_.columns), spacing(area.getHeight(), grid_.rows)),
            22.0f, 60.0f));
        for (auto& cell : cells_)
            cell->setBounds(juce::Rectangle<int>{size, size}.withCentre(
                toPixel(area, grid_.place(cell->cell)).roundToInt()));
    }

private:
    static constexpr float cellMargin = 62.0f; // space for the points at the edge and their labels
    juce::Rectangle<float> field() const {
        return fitField(getLocalBounds().toFloat().reduced(cellMargin), layout_.geometry);
    }
    PhantomGrid grid_;
    const LayoutDescription layout_;
    std::vector<std::unique_ptr<CellButton>> cells_;
};

/// Answer at any place. A click or Enter sets the mark; the next one moves it.
class PlaceAnswer final : public StudyAnswer {
public:
    explicit PlaceAnswer(const LayoutDescription& layout)
        : layout_{layout} {
        setTitle("Field");
        setHelpText("Arrows move the mark, with Shift in large steps; Enter sets it");
        setWantsKeyboardFocus(true);
        setMouseCursor(juce::MouseCursor::CrosshairCursor);
    }
    Answer answer() const override { return {.response = {}, .place = acceptedMark_, .scores = {}}; }
    bool isComplete() const override { return acceptedMark_.has_value(); }
    std::string keyHelp() const override { return "Arrows (Shift: far) and Enter: place.  Enter: confirm."; }
    void focusFirst() override { grabKeyboardFocus(); }

    bool handleKey(const juce::KeyPress& key) override {
        if (!isEnabled()) return false;
        const double step = key.getModifiers().isShiftDown() ? 0.1 : 0.01;
        if (const auto direction = arrowDirection(key); !direction.isOrigin())
            return moveMark({mark_.x + direction.x * step, mark_.y + direction.y * step}), true;
        // if the mark is already here, Enter is passed on to confirm
        if (key.isKeyCode(juce::KeyPress::returnKey) && acceptedMark_ != mark_) return acceptMark(), true;
        return false;
    }
    bool keyPressed(const juce::KeyPress& key) override { return handleKey(key); }
    // JUCE also reports a resting mouse when the component below it changes; that must not move the mark
    void mouseMove(const juce::MouseEvent& e) override {
        if (std::exchange(lastMouse_, e.position).value_or(e.position) != e.position) moveMarkTo(e);
    }
    void mouseDrag(const juce::MouseEvent& e) override { moveMarkTo(e); }
    void mouseDown(const juce::MouseEvent& e) override { moveMarkTo(e); }
    void mouseUp(const juce::MouseEvent& e) override {
        if (!isEnabled() || !field().expanded(margin).contains(e.position)) return;
        moveMarkTo(e);
        acceptMark();
    }

    void paint(juce::Graphics& g) override {
        drawField(g, *this, field(), layout_);
        if (acceptedMark_) {
            g.setColour(shade(*this, Shade::highlight));
            g.fillEllipse(juce::Rectangle<float>{18.0f, 18.0f}.withCentre(toPixel(field(), *acceptedMark_)));
        }
        if (!isEnabled()) return;
        const auto centre = toPixel(field(), mark_);
        g.setColour(shade(*this, Shade::accent));
        g.drawEllipse(juce::Rectangle<float>{30.0f, 30.0f}.withCentre(centre), 2.0f);
        g.drawLine({centre.translated(-22.0f, 0.0f), centre.translated(22.0f, 0.0f)}, 1.5f);
        g.drawLine({centre.translated(0.0f, -22.0f), centre.translated(0.0f, 22.0f)}, 1.5f);
    }
    void enablementChanged() override { repaint(); }

private:
    juce::Rectangle<float> field() const {
        return fitField(getLocalBounds().toFloat().reduced(margin), layout_.geometry);
    }
    void moveMarkTo(const juce::MouseEvent& e) {
        const auto f = field();
        moveMark({(e.position.x - f.getX()) / f.getWidth(), (e.position.y - f.getY()) / f.getHeight()});
    }
    void moveMark(const FieldPlace& place) {
        const auto toShare = [](double share) { return std::round(1e4 * std::clamp(share, 0.0, 1.0)) / 1e4; };
        mark_ = {toShare(place.x), toShare(place.y)};
        setDescription("Mark at " + juce::String{100.0 * mark_.x, 0} + " % to the right, " +
                       juce::String{100.0 * mark_.y, 0} + " % down");
        repaint();
    }
    void acceptMark() {
        acceptedMark_ = mark_;
        repaint();
        onChange();
        onAnswer();
    }

    const LayoutDescription layout_;
    FieldPlace mark_{0.5, 0.5};
    std::optional<FieldPlace> acceptedMark_;
    std::optional<juce::Point<float>> lastMouse_; // last mouse position
};

} // namespace

std::unique_ptr<StudyAnswer> makeCellAnswer(const GridSet& grid, const LayoutDescription& layout) {
    return std::make_unique<CellAnswer>(grid, layout);
}
std::unique_ptr<StudyAnswer> makePlaceAnswer(const LayoutDescription& layout) {
    return std::make_unique<PlaceAnswer>(layout);
}

// Answer for patterns in two clicks: the first pulse's actuator, then an icon of the whole pattern (thesis
// 3.2.1, Fig. 3.9 and 3.10). Icons show the order by colour and number, and the actuator by place.

namespace {

/// Red, green or purple, as printed in the thesis; light enough for the dark number on it.
juce::Colour orderColour(int pulse) {
    constexpr std::array<palette::Argb, 3> colours{0xffff6b6b, 0xff5fd07a, 0xffc38bff};
    return juce::Colour{nth(colours, pulse)};
}

void drawPulse(juce::Graphics& g, juce::Point<float> centre, float radius, int pulse, float alpha) {
    const auto disc = juce::Rectangle<float>{2.0f * radius, 2.0f * radius}.withCentre(centre);
    g.setColour(orderColour(pulse).withMultipliedAlpha(alpha));
    g.fillEllipse(disc);
    g.setColour(juce::Colour{palette::Argb{0xff101218}}.withMultipliedAlpha(alpha));
    g.setFont(text::font(text::small, juce::Font::bold));
    g.drawText(juce::String{pulse + 1}, disc, juce::Justification::centred, false);
}

/// Button with a pattern on a small field.
class PatternIcon final : public juce::Button {
public:
    PatternIcon(const PulsePattern& p, const LayoutDescription& layout)
        : juce::Button{utf8(patternLabel(p))}
        , pattern{p}
        , layout_{layout} {
        juce::StringArray names;
        for (int k = 0; k < p.count; ++k) names.add(utf8(nth(layout.actuators, nth(p.actuators, k)).label));
        setTitle(names.joinIntoString(" then ") + ", " +
                 juce::String{juce::roundToInt(1e3 * p.pulseSeconds)} + " ms");
    }
    const PulsePattern pattern;
    bool wasPlayed = false;

    void paintButton(juce::Graphics& g, bool isOver, bool isDown) override {
        drawButtonShape(g, *this, isOver, isDown, 6.0f);
        const float alpha = isEnabled() ? 1.0f : 0.4f, radius = 8.5f;
        // the discs of two rows must not overlap in low icons
        const float marginY =
            std::clamp(0.5f * static_cast<float>(getHeight()) - radius - 1.0f, radius, 14.0f);
        const auto inner = getLocalBounds().toFloat().reduced(18.0f, marginY);
        for (int j = 0; j < layout_.geometry.count; ++j) {
            const auto centre = toPixel(inner, actuatorPlace(layout_.geometry, j));
            int pulseCount = 0;
            for (int k = 0; k < pattern.count; ++k) pulseCount += nth(pattern.actuators, k) == j ? 1 : 0;
            if (pulseCount == 0) {
                g.setColour(shade(*this, Shade::muted).withMultipliedAlpha(0.55f * alpha));
                g.drawEllipse(juce::Rectangle<float>{7.0f, 7.0f}.withCentre(centre), 1.5f);
            }
            // Pulses of one actuator are drawn side by side, towards the centre of the icon.
            float x = std::clamp(centre.x - 0.5f * static_cast<float>(pulseCount - 1) * 2.0f * radius,
                                 4.0f + radius,
                                 static_cast<float>(getWidth()) - 4.0f - radius -
                                     static_cast<float>(pulseCount - 1) * 2.0f * radius);
            for (int k = 0; k < pattern.count; ++k) {
                if (nth(pattern.actuators, k) != j) continue;
                drawPulse(g, {x, centre.y}, radius, k, alpha);
                x += 2.0f * radius;
            }
        }
        if (!wasPlayed) return;
        g.setColour(shade(*this, Shade::accent));
        g.drawRoundedRectangle(getLocalBounds().toFloat().reduced(1.0f), 6.0f, 1.5f);
    }

private:
    const LayoutDescription& layout_;
};

class PatternAnswer final : public ButtonAnswer {
public:
    PatternAnswer(const ConditionPlan& condition, const LayoutDescription& layout, const StudyTexts& texts)
        : layout_{layout}
        , translate_{texts} {
        setTitle("Patterns");
        for (const StimulusItem& item : conditionStimuli(condition))
            if (const auto pattern = parsePatternLabel(item.label)) addIcon(*pattern);
        for (int j = 0; j < layout_.geometry.count; ++j) {
            const auto label = utf8(nth(layout_.actuators, j).label);
            auto& button =
                firstButtons_.emplace_back(std::make_unique<BigButton>(label, "First pulse: " + label));
            button->onClick = [this, j] { chooseFirst(j); };
            addAndMakeVisible(*button);
        }
        chooseFirst(-1);
    }
    std::string keyHelp() const override { return "Letter: first pulse.  Arrows and Enter: pattern."; }
    bool handleKey(const juce::KeyPress& key) override {
        const auto typedLetter =
            juce::String::charToString(juce::CharacterFunctions::toUpperCase(key.getTextCharacter()));
        for (int j = 0; j < layout_.geometry.count; ++j)
            if (isEnabled() && typedLetter == utf8(nth(layout_.actuators, j).label))
                return chooseFirst(j), focusIcons(), true;
        return moveFocus(*this, key);
    }
    void focusFirst() override { firstButtons_.front()->grabKeyboardFocus(); }
    void markPlayed(const std::set<std::string>& played) override {
        for (auto& icon : icons_) icon->wasPlayed = played.contains(patternLabel(icon->pattern));
        repaint();
    }

    void paint(juce::Graphics& g) override {
        const auto drawHeading = [&](const juce::String& heading, juce::Rectangle<int> row) {
            setInk(g, *this, isEnabled() ? Shade::text : Shade::muted, text::medium, juce::Font::bold);
            g.drawText(heading, row, juce::Justification::centredLeft, true);
        };
        drawHeading("1   " + translate_("Place of the first pulse"), firstHeading_);
        drawHeading("2   " + translate_("Whole pattern"), iconHeading_);
        fillRound(g, *this, Shade::well, field_.expanded(50.0f, 44.0f), 12.0f);
        auto legend = iconHeading_.withTrimmedLeft(170);
        static constexpr std::array names{"first", "second", "third"};
        for (int k = 0; k < 3; ++k) {
            auto part = legend.removeFromLeft(92);
            drawPulse(g, part.removeFromLeft(20).toFloat().getCentre(), 8.5f, k, 1.0f);
            setInk(g, *this, Shade::muted, text::small);
            g.drawText(translate_(nth(names, k)), part.withTrimmedLeft(6), juce::Justification::centredLeft,
                       true);
        }
        setInk(g, *this, Shade::muted, text::medium);
        if (firstActuator_ < 0)
            g.drawText(translate_("Choose the first pulse's place."), iconsArea_,
                       juce::Justification::centred, true);
        for (const auto& [milliseconds, row] : captions_)
            g.drawText(translate_("Pulses of {n} ms", {{"n", juce::String{milliseconds}}}), row,
                       juce::Justification::centredLeft, true);
    }

    void resized() override {
        auto area = getLocalBounds();
        auto leftArea = area.removeFromLeft(std::clamp(getWidth() / 4, 240, 330));
        area.removeFromLeft(32);
        firstHeading_ = leftArea.removeFromTop(32);
        iconHeading_ = area.removeFromTop(32);
        field_ = fitField(
            leftArea.removeFromTop(std::min(leftArea.getHeight(), 300)).toFloat().reduced(50.0f, 44.0f),
            layout_.geometry);
        for (int j = 0; j < layout_.geometry.count; ++j)
            nth(firstButtons_, j)
                ->setBounds(juce::Rectangle<int>{72, 64}.withCentre(
                    toPixel(field_, actuatorPlace(layout_.geometry, j)).toInt()));
        iconsArea_ = area;
        placeIcons();
    }
    void enablementChanged() override { repaint(); }

private:
    void addIcon(const PulsePattern& pattern) {
        auto& icon = icons_.emplace_back(std::make_unique<PatternIcon>(pattern, layout_));
        addChoice(*icon, patternLabel(pattern));
        addChildComponent(*icon);
    }

    void chooseFirst(int actuator) {
        firstActuator_ = actuator;
        for (std::size_t j = 0; j < firstButtons_.size(); ++j)
            firstButtons_[j]->setToggleState(static_cast<int>(j) == actuator, juce::dontSendNotification);
        for (auto& icon : icons_) icon->setVisible(icon->pattern.actuators[0] == actuator);
        placeIcons();
        repaint();
    }

    void focusIcons() {
        for (auto& icon : icons_)
            if (icon->isVisible()) return icon->grabKeyboardFocus();
    }

    /// One group per duration, the longest at the left, with the icons of one, two and three pulses.
    void placeIcons() {
        std::map<int, std::vector<PatternIcon*>, std::greater<>> groups;
        for (auto& icon : icons_)
            if (icon->isVisible())
                groups[juce::roundToInt(1e3 * icon->pattern.pulseSeconds)].push_back(icon.get());
        captions_.clear();
        if (groups.empty()) return;
        constexpr int captionHeight = 26, spacing = 6, minWidth = 60;
        auto area = iconsArea_;
        const int groupWidth = area.getWidth() / static_cast<int>(groups.size());
        // in narrower icons, places cannot be distinguished
        const int columns = std::clamp(groupWidth / (minWidth + spacing), 1, groups.size() > 1 ? 4 : 7);
        const int width = std::min(groupWidth / columns - spacing, 150);
        for (const auto& [milliseconds, icons] : groups) {
            auto group = area.removeFromLeft(groupWidth);
            captions_.emplace_back(milliseconds, group.removeFromTop(captionHeight));
            const int lines = (static_cast<int>(icons.size()) + columns - 1) / columns;
            const int height = std::clamp(group.getHeight() / lines - spacing, 28, 110);
            juce::Rectangle<int> row;
            for (std::size_t i = 0; i < icons.size(); ++i) {
                if (static_cast<int>(i) % columns == 0) row = group.removeFromTop(height + spacing);
                icons[i]->setBounds(
                    row.removeFromLeft(width + spacing).withTrimmedRight(spacing).withTrimmedBottom(spacing));
            }
        }
    }

    const LayoutDescription layout_;
    const StudyTexts& translate_;
    std::vector<std::unique_ptr<BigButton>> firstButtons_;
    std::vector<std::unique_ptr<PatternIcon>> icons_;
    juce::Rectangle<int> firstHeading_, iconHeading_, iconsArea_;
    juce::Rectangle<float> field_;
    std::vector<std::pair<int, juce::Rectangle<int>>> captions_; // duration in ms, and its area
    int firstActuator_ = -1;
};

} // namespace

std::unique_ptr<StudyAnswer> makePatternAnswer(const ConditionPlan& condition,
                                               const LayoutDescription& layout, const StudyTexts& texts) {
    return std::make_unique<PatternAnswer>(condition, layout, texts);
}

} // namespace physvib

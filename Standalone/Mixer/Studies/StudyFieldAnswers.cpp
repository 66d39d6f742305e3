// SPDX-License-Identifier: GPL-3.0-or-later
// Answers on the field: a cell of a grid, any place, or a pattern of pulses.
#include "Mixer/Studies/StudyParts.h"
#include "Stimuli/Stimulus.h"
#include <map>

namespace physvib {
namespace {

constexpr float margin = 24.0f;

void drawRing(juce::Graphics& g, const juce::Component& component, juce::Point<float> at,
              const LayoutDescription& layout, int enchanter) {
    const auto ring = juce::Rectangle<float>{26.0f, 26.0f}.withCentre(at);
    g.setColour(shade(component, Shade::panel));
    g.fillEllipse(ring);
    g.setColour(enchanterColour(component, enchanter));
    g.drawEllipse(ring, 2.0f);
    g.setFont(text::font(text::small, juce::Font::bold));
    g.drawText(utf8(nth(layout.enchanters, enchanter).label), ring, juce::Justification::centred, false);
}

/// The field with its actuators as labelled rings.
void drawField(juce::Graphics& g, const juce::Component& component, const juce::Rectangle<float>& field,
               const LayoutDescription& layout) {
    fillRound(g, component, Shade::well, field, 10.0f);
    g.setColour(shade(component, Shade::line));
    g.drawRoundedRectangle(field, 10.0f, 1.5f);
    for (int j = 0; j < layout.geometry.count; ++j)
        drawRing(g, component, pointOn(field, placeOf(layout.geometry, j)), layout, j);
}

/// An actuator of the field, moved outwards if a point lies on it.
void drawEnchanterBeside(juce::Graphics& g, const juce::Component& component,
                         const juce::Rectangle<float>& field, const LayoutDescription& layout,
                         int enchanter) {
    constexpr float way = 46.0f;
    const auto place = placeOf(layout.geometry, enchanter);
    const auto outwards = [](double share) { return share < 0.34 ? -1.0f : share > 0.66 ? 1.0f : 0.0f; };
    juce::Point<float> out{outwards(place.x), outwards(place.y)};
    if (out.isOrigin()) out.y = -1.0f;
    drawRing(g, component, pointOn(field, place) + out * (way / out.getDistanceFromOrigin()), layout,
             enchanter);
}

/// A point of the grid at the place of its stimulus: yellow, red once it was felt, as thesis Fig. 4.1 has it.
class CellButton final : public juce::Button {
public:
    explicit CellButton(const GridCell& c)
        : juce::Button{utf8(gridLabel(c))}
        , cell{c} {
        setTitle("Row " + juce::String{c.row} + ", column " + juce::String{c.column});
    }
    const GridCell cell;
    bool isFelt = false;
    void paintButton(juce::Graphics& g, bool isOver, bool isDown) override {
        const auto disc = getLocalBounds().toFloat().reduced(2.0f);
        drawTarget(g, *this, isOver, isDown, disc.getWidth() / 2.0f);
        g.setColour(juce::Colour{palette::Argb{isFelt ? 0xffff6b6b : 0xffe8b800}}.withMultipliedAlpha(
            isEnabled() ? 1.0f : 0.4f));
        g.fillEllipse(juce::Rectangle<float>{14.0f, 14.0f}.withCentre(disc.getCentre()));
    }
};

/// Answer on a grid. All grids of a layout have their corners at the same pixels: the outer points of
/// `corners` lie on the actuators.
class CellAnswer final : public ChosenAnswer {
public:
    CellAnswer(const GridSet& grid, const LayoutDescription& layout)
        : grid_{grid.grid()}
        , layout_{layout} {
        setTitle("Grid");
        for (const GridCell& cell : grid_.cells()) {
            auto& button = cells_.emplace_back(std::make_unique<CellButton>(cell));
            offer(*button, gridLabel(cell));
            addAndMakeVisible(*button);
        }
    }
    std::string keys() const override { return "Arrows and Enter: place.  Enter: confirm."; }
    bool handleKey(const juce::KeyPress& key) override { return moveFocus(*this, key); }
    void beginAnew() override { cells_[cells_.size() / 2]->grabKeyboardFocus(); }
    void mark(const std::set<std::string>& felt) override {
        for (auto& cell : cells_) cell->isFelt = felt.contains(gridLabel(cell->cell));
        repaint();
    }
    void paint(juce::Graphics& g) override {
        fillRound(g, *this, Shade::well, field().expanded(cellMargin - 6.0f), 14.0f);
        for (int j = 0; j < layout_.geometry.count; ++j) drawEnchanterBeside(g, *this, field(), layout_, j);
    }
    void resized() override {
        const auto f = field();
        const auto between = [](float length, int lines) {
            return lines > 1 ? length / static_cast<float>(lines - 1) : length;
        };
        const int size = juce::roundToInt(std::clamp(
            0.8f * std::min(between(f.getWidth(), grid_.columns), between(f.getHeight(), grid_.rows)), 22.0f,
            60.0f));
        for (auto& cell : cells_)
            cell->setBounds(juce::Rectangle<int>{size, size}.withCentre(
                pointOn(f, grid_.place(cell->cell)).roundToInt()));
    }

private:
    static constexpr float cellMargin = 62.0f; // space for the points at the edge and their labels
    juce::Rectangle<float> field() const {
        return fieldIn(getLocalBounds().toFloat().reduced(cellMargin), layout_.geometry);
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
    Answer answer() const override { return {.response = {}, .place = marked_, .scores = {}}; }
    bool isComplete() const override { return marked_.has_value(); }
    std::string keys() const override { return "Arrows (Shift: far) and Enter: place.  Enter: confirm."; }
    void beginAnew() override { grabKeyboardFocus(); }

    bool handleKey(const juce::KeyPress& key) override {
        if (!isEnabled()) return false;
        const double step = key.getModifiers().isShiftDown() ? 0.1 : 0.01;
        if (const auto way = wayOf(key); !way.isOrigin())
            return moveMark({mark_.x + way.x * step, mark_.y + way.y * step}), true;
        // if the mark is already here, Enter is passed on to confirm
        if (key.isKeyCode(juce::KeyPress::returnKey) && marked_ != mark_) return acceptMark(), true;
        return false;
    }
    bool keyPressed(const juce::KeyPress& key) override { return handleKey(key); }
    // JUCE also reports a resting mouse when the component below it changes; that must not move the mark
    void mouseMove(const juce::MouseEvent& e) override {
        if (std::exchange(seenAt_, e.position).value_or(e.position) != e.position) follow(e);
    }
    void mouseDrag(const juce::MouseEvent& e) override { follow(e); }
    void mouseDown(const juce::MouseEvent& e) override { follow(e); }
    void mouseUp(const juce::MouseEvent& e) override {
        if (!isEnabled() || !field().expanded(margin).contains(e.position)) return;
        follow(e);
        acceptMark();
    }

    void paint(juce::Graphics& g) override {
        drawField(g, *this, field(), layout_);
        if (marked_) {
            g.setColour(shade(*this, Shade::now));
            g.fillEllipse(juce::Rectangle<float>{18.0f, 18.0f}.withCentre(pointOn(field(), *marked_)));
        }
        if (!isEnabled()) return;
        const auto at = pointOn(field(), mark_);
        g.setColour(shade(*this, Shade::accent));
        g.drawEllipse(juce::Rectangle<float>{30.0f, 30.0f}.withCentre(at), 2.0f);
        g.drawLine({at.translated(-22.0f, 0.0f), at.translated(22.0f, 0.0f)}, 1.5f);
        g.drawLine({at.translated(0.0f, -22.0f), at.translated(0.0f, 22.0f)}, 1.5f);
    }
    void enablementChanged() override { repaint(); }

private:
    juce::Rectangle<float> field() const {
        return fieldIn(getLocalBounds().toFloat().reduced(margin), layout_.geometry);
    }
    void follow(const juce::MouseEvent& e) {
        const auto f = field();
        moveMark({(e.position.x - f.getX()) / f.getWidth(), (e.position.y - f.getY()) / f.getHeight()});
    }
    void moveMark(const FieldPlace& to) {
        const auto rounded = [](double share) { return std::round(1e4 * std::clamp(share, 0.0, 1.0)) / 1e4; };
        mark_ = {rounded(to.x), rounded(to.y)};
        setDescription("Mark at " + juce::String{100.0 * mark_.x, 0} + " % to the right, " +
                       juce::String{100.0 * mark_.y, 0} + " % down");
        repaint();
    }
    void acceptMark() {
        marked_ = mark_;
        repaint();
        onChange();
        onAnswer();
    }

    const LayoutDescription layout_;
    FieldPlace mark_{0.5, 0.5};
    std::optional<FieldPlace> marked_;
    std::optional<juce::Point<float>> seenAt_; // last mouse position
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

/// Red, green, purple, as printed; light enough for the dark number on it.
juce::Colour orderColour(int pulse) {
    constexpr std::array<palette::Argb, 3> colours{0xffff6b6b, 0xff5fd07a, 0xffc38bff};
    return juce::Colour{nth(colours, pulse)};
}

void drawPulse(juce::Graphics& g, juce::Point<float> at, float radius, int pulse, float light) {
    const auto disc = juce::Rectangle<float>{2.0f * radius, 2.0f * radius}.withCentre(at);
    g.setColour(orderColour(pulse).withMultipliedAlpha(light));
    g.fillEllipse(disc);
    g.setColour(juce::Colour{palette::Argb{0xff101218}}.withMultipliedAlpha(light));
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
        juce::StringArray words;
        for (int k = 0; k < p.count; ++k) words.add(utf8(nth(layout.enchanters, nth(p.enchanters, k)).label));
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
            for (int k = 0; k < pattern.count; ++k) here += nth(pattern.enchanters, k) == j ? 1 : 0;
            if (here == 0) {
                g.setColour(shade(*this, Shade::muted).withMultipliedAlpha(0.55f * light));
                g.drawEllipse(juce::Rectangle<float>{7.0f, 7.0f}.withCentre(at), 1.5f);
            }
            // Pulses of one actuator are drawn side by side, towards the centre of the icon.
            float x = std::clamp(at.x - 0.5f * static_cast<float>(here - 1) * 2.0f * radius, 4.0f + radius,
                                 static_cast<float>(getWidth()) - 4.0f - radius -
                                     static_cast<float>(here - 1) * 2.0f * radius);
            for (int k = 0; k < pattern.count; ++k) {
                if (nth(pattern.enchanters, k) != j) continue;
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
            const auto label = utf8(nth(layout_.enchanters, j).label);
            auto& button = firsts_.emplace_back(std::make_unique<BigButton>(label, "First pulse: " + label));
            button->onClick = [this, j] { chooseFirst(j); };
            addAndMakeVisible(*button);
        }
        chooseFirst(-1);
    }
    std::string keys() const override { return "Letter: first pulse.  Arrows and Enter: pattern."; }
    bool handleKey(const juce::KeyPress& key) override {
        const auto typed =
            juce::String::charToString(juce::CharacterFunctions::toUpperCase(key.getTextCharacter()));
        for (int j = 0; j < layout_.geometry.count; ++j)
            if (isEnabled() && typed == utf8(nth(layout_.enchanters, j).label))
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
            ink(g, *this, isEnabled() ? Shade::text : Shade::muted, text::medium, juce::Font::bold);
            g.drawText(words, row, juce::Justification::centredLeft, true);
        };
        heading("1   " + say_("Place of the first pulse"), firstHeading_);
        heading("2   " + say_("Whole pattern"), iconHeading_);
        fillRound(g, *this, Shade::well, field_.expanded(50.0f, 44.0f), 12.0f);
        auto legend = iconHeading_.withTrimmedLeft(170);
        static constexpr std::array names{"first", "second", "third"};
        for (int k = 0; k < 3; ++k) {
            auto part = legend.removeFromLeft(92);
            drawPulse(g, part.removeFromLeft(20).toFloat().getCentre(), 8.5f, k, 1.0f);
            ink(g, *this, Shade::muted, text::small);
            g.drawText(say_(nth(names, k)), part.withTrimmedLeft(6), juce::Justification::centredLeft, true);
        }
        ink(g, *this, Shade::muted, text::medium);
        if (first_ < 0)
            g.drawText(say_("Choose the first pulse's place."), iconsArea_, juce::Justification::centred,
                       true);
        for (const auto& [ms, row] : captions_)
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
            nth(firsts_, j)
                ->setBounds(juce::Rectangle<int>{72, 64}.withCentre(
                    pointOn(field_, placeOf(layout_.geometry, j)).toInt()));
        iconsArea_ = area;
        placeIcons();
    }
    void enablementChanged() override { repaint(); }

private:
    void addIcon(const PulsePattern& pattern) {
        auto& icon = icons_.emplace_back(std::make_unique<PatternIcon>(pattern, layout_));
        offer(*icon, patternLabel(pattern));
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

    /// One group per duration, the longest at the left, with the icons of one, two and three pulses.
    void placeIcons() {
        std::map<int, std::vector<PatternIcon*>, std::greater<>> shown;
        for (auto& icon : icons_)
            if (icon->isVisible())
                shown[juce::roundToInt(1e3 * icon->pattern.pulseSeconds)].push_back(icon.get());
        captions_.clear();
        if (shown.empty()) return;
        constexpr int captionHeight = 26, space = 6, least = 60;
        auto area = iconsArea_;
        const int wide = area.getWidth() / static_cast<int>(shown.size());
        // In narrower icons places are not told apart.
        const int across = std::clamp(wide / (least + space), 1, shown.size() > 1 ? 4 : 7);
        const int width = std::min(wide / across - space, 150);
        for (const auto& [ms, some] : shown) {
            auto group = area.removeFromLeft(wide);
            captions_.emplace_back(ms, group.removeFromTop(captionHeight));
            const int lines = (static_cast<int>(some.size()) + across - 1) / across;
            const int height = std::clamp(group.getHeight() / lines - space, 28, 110);
            juce::Rectangle<int> row;
            for (std::size_t i = 0; i < some.size(); ++i) {
                if (static_cast<int>(i) % across == 0) row = group.removeFromTop(height + space);
                some[i]->setBounds(
                    row.removeFromLeft(width + space).withTrimmedRight(space).withTrimmedBottom(space));
            }
        }
    }

    const LayoutDescription layout_;
    const StudyWords& say_;
    std::vector<std::unique_ptr<BigButton>> firsts_;
    std::vector<std::unique_ptr<PatternIcon>> icons_;
    juce::Rectangle<int> firstHeading_, iconHeading_, iconsArea_;
    juce::Rectangle<float> field_;
    std::vector<std::pair<int, juce::Rectangle<int>>> captions_; // duration in ms, and its area
    int first_ = -1;
};

} // namespace

std::unique_ptr<StudyAnswer> makePatternAnswer(const ConditionPlan& condition,
                                               const LayoutDescription& layout, const StudyWords& words) {
    return std::make_unique<PatternAnswer>(condition, layout, words);
}

} // namespace physvib

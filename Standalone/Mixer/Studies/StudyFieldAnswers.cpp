// SPDX-License-Identifier: GPL-3.0-or-later
// Answers on the field: a cell of a grid, or any place.
#include "Mixer/Studies/StudyAnswer.h"
#include "Mixer/Studies/StudyParts.h"
#include <cmath>
#include <utility>

namespace physvib {
namespace {

constexpr float margin = 24.0f;

/// A point of the grid at the place of its stimulus.
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
        g.setColour(shade(*this, isFelt || getToggleState() ? Shade::accent : Shade::muted)
                        .withMultipliedAlpha(isEnabled() ? 1.0f : 0.4f));
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
            button->onClick = [this, cell] { choose(gridLabel(cell)); };
            addAndMakeVisible(*button);
        }
    }
    std::string keys() const override { return "Arrows and Enter: place.  Enter: confirm."; }
    bool takeKey(const juce::KeyPress& key) override { return moveFocus(*this, key); }
    void beginAnew() override { cells_[cells_.size() / 2]->grabKeyboardFocus(); }
    void mark(const std::set<std::string>& felt) override {
        for (auto& cell : cells_) cell->isFelt = felt.contains(gridLabel(cell->cell));
        repaint();
    }
    void paint(juce::Graphics& g) override {
        g.setColour(shade(*this, Shade::well));
        g.fillRoundedRectangle(field().expanded(cellMargin - 6.0f), 14.0f);
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
    void showChosen(const std::string& response) override {
        for (auto& cell : cells_)
            cell->setToggleState(gridLabel(cell->cell) == response, juce::dontSendNotification);
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
    Answer answer() const override {
        Answer answer;
        answer.place = marked_;
        return answer;
    }
    bool isComplete() const override { return marked_.has_value(); }
    std::string keys() const override { return "Arrows (Shift: far) and Enter: place.  Enter: confirm."; }
    void beginAnew() override { grabKeyboardFocus(); }

    bool takeKey(const juce::KeyPress& key) override {
        if (!isEnabled()) return false;
        const double step = key.getModifiers().isShiftDown() ? 0.1 : 0.01;
        if (key.isKeyCode(juce::KeyPress::leftKey)) return moveMark({mark_.x - step, mark_.y}), true;
        if (key.isKeyCode(juce::KeyPress::rightKey)) return moveMark({mark_.x + step, mark_.y}), true;
        if (key.isKeyCode(juce::KeyPress::upKey)) return moveMark({mark_.x, mark_.y - step}), true;
        if (key.isKeyCode(juce::KeyPress::downKey)) return moveMark({mark_.x, mark_.y + step}), true;
        // if the mark is already here, Enter is passed on to confirm
        if (key.isKeyCode(juce::KeyPress::returnKey) && marked_ != mark_) return take(), true;
        return false;
    }
    bool keyPressed(const juce::KeyPress& key) override { return takeKey(key); }
    void mouseMove(const juce::MouseEvent& e) override { // JUCE also reports a resting mouse when the
                                                         // component below it changes; that must not move the
                                                         // mark
        if (std::exchange(seenAt_, e.position).value_or(e.position) != e.position) follow(e);
    }
    void mouseDrag(const juce::MouseEvent& e) override { follow(e); }
    void mouseDown(const juce::MouseEvent& e) override { follow(e); }
    void mouseUp(const juce::MouseEvent& e) override {
        if (!isEnabled() || !field().expanded(margin).contains(e.position)) return;
        follow(e);
        take();
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
    void take() {
        marked_ = mark_;
        repaint();
        if (onChange) onChange();
        if (onAnswer) onAnswer();
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

} // namespace physvib

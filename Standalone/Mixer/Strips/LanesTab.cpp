// SPDX-License-Identifier: GPL-3.0-or-later
// Rows for all strips and groups, with a time axis.
#include "Mixer/Strips/LanesTab.h"
#include "Mixer/Strips/ScopeView.h"

namespace physvib {
namespace {

constexpr int labelWidth = 92, minRow = 34, betweenRows = 6, footHigh = 18;

constexpr float pointSize = 8.0f, pointInset = 5.0f; // so that points at the edge are fully visible
constexpr double nudgeSeconds = 0.05, nudgeDb = 0.5, leapDb = 3.0;

juce::String wordsOf(const GainPoint& point) {
    return (point.db <= leastStripDb ? juce::String{"silent"} : number(point.db, 1) + " dB") + " at " +
           number(point.seconds, 2) + " s";
}

} // namespace

LanesTab::LanesTab(MixerModel& model)
    : model_{model} {
    setTitle("Gain lanes");
    viewport_.setViewedComponent(&rows_, false);
    viewport_.setScrollBarsShown(true, false);
    viewport_.setScrollBarThickness(8);
    addAndMakeVisible(viewport_);
    mixChanged();
}

void LanesTab::mixChanged() {
    const std::size_t wanted = model_.mix().strips.size() + model_.mix().groups.size();
    if (rows_.lanes.size() != wanted) {
        rows_.lanes.clear();
        for (std::size_t i = 0; i < wanted; ++i) {
            rows_.lanes.push_back(std::make_unique<LaneRow>(model_, i));
            rows_.addAndMakeVisible(*rows_.lanes.back());
        }
        prepareControls(rows_);
        resized();
    }
    for (auto& lane : rows_.lanes) lane->mixChanged();
    shownSeconds_ = -1.0;
    rows_.repaint();
}

// Covers the scene so far and all points.
double LanesTab::spanSeconds() const {
    double needed = model_.signals().run().seconds();
    const auto include = [&needed](const GainLane& lane) {
        if (!lane.empty()) needed = std::max(needed, lane.back().seconds);
    };
    for (const Strip& strip : model_.mix().strips) include(strip.lane);
    for (const StripGroup& group : model_.mix().groups) include(group.lane);
    double span = 10.0;
    for (int k = 0; span < needed; ++k) span *= k % 3 == 1 ? 1.5 : 2.0; // 20, 30, 60, 120, 180, 360...
    return span;
}

void LanesTab::refresh(const MixerMoment&) {
    const double seconds = model_.signals().run().seconds(), span = spanSeconds();
    if (seconds == shownSeconds_ && span == spanSeconds_) return;
    shownSeconds_ = seconds;
    if (span != std::exchange(spanSeconds_, span)) repaint(foot_);
    for (auto& lane : rows_.lanes) lane->show(span);
}

void LanesTab::Rows::paint(juce::Graphics& g) {
    g.setFont(text::font(text::medium, juce::Font::bold));
    const auto& mix = model.mix();
    for (std::size_t i = 0; i < std::min(lanes.size(), mix.strips.size() + mix.groups.size()); ++i) {
        const bool isStrip = i < mix.strips.size();
        g.setColour(isStrip ? enchanterColour(*this, static_cast<int>(i)) : shade(*this, Shade::text));
        const auto words =
            utf8(isStrip ? mix.layout.enchanters[i].label : mix.groups[i - mix.strips.size()].name);
        g.drawFittedText(words, lanes[i]->getBounds().withX(0).withWidth(labelWidth - 8),
                         juce::Justification::centredLeft, 1, 1.0f);
    }
}

void LanesTab::paint(juce::Graphics& g) {
    ink(g, *this, Shade::muted, text::small);
    const auto axis = foot_.withTrimmedLeft(labelWidth);
    g.drawText("0", axis, juce::Justification::centredLeft, false);
    g.drawText(number(std::max(10.0, spanSeconds_), 0) + " s of the scene", axis,
               juce::Justification::centredRight, false);
    const auto room = axis.withTrimmedLeft(20).withTrimmedRight(110);
    for (const char* words : {"Click adds a point. Record (Ctrl+R), and the faders you move are written.",
                              "Click adds a point. Ctrl+R records faders.", "Click adds a point."})
        if (text::pixels(g.getCurrentFont(), words) <= room.getWidth())
            return g.drawText(words, room, juce::Justification::centred, false);
}

void LanesTab::resized() {
    auto area = getLocalBounds();
    foot_ = area.removeFromBottom(footHigh);
    area.removeFromBottom(2);
    viewport_.setBounds(area);
    const int count = std::max(1, static_cast<int>(rows_.lanes.size()));
    const int each = std::max(minRow, (area.getHeight() + betweenRows) / count - betweenRows),
              high = count * (each + betweenRows) - betweenRows;
    rows_.setSize(area.getWidth() - (high > area.getHeight() ? 10 : 0), high);
    auto rest = rows_.getLocalBounds().withTrimmedLeft(labelWidth);
    for (auto& lane : rows_.lanes) lane->setBounds(rest.removeFromTop(each)), rest.removeFromTop(betweenRows);
}

// Mouse and keyboard editing of a gain lane; its vertical scale is that of a fader.

LaneRow::LaneRow(MixerModel& model, std::size_t number)
    : model_{model}
    , number_{number} {
    setWantsKeyboardFocus(true);
    mixChanged();
}

juce::NormalisableRange<double> LaneRow::scale() {
    juce::NormalisableRange<double> range{leastStripDb, mostStripDb};
    range.setSkewForCentre(-15.0); // as in setUpFader
    return range;
}

const GainLane& LaneRow::lane() const {
    static const GainLane none;
    if (!isThere()) return none;
    return isGroup() ? model_.mix().groups[group()].lane : model_.mix().strips[number_].lane;
}

std::vector<int> LaneRow::channels() const {
    if (!isThere()) return {};
    if (!isGroup()) return {static_cast<int>(number_)};
    std::vector<int> all;
    for (int j = 0; j < model_.mix().count(); ++j)
        if (nth(model_.mix().strips, j).group == static_cast<int>(group())) all.push_back(j);
    return all;
}

void LaneRow::mixChanged() {
    if (!isThere()) return;
    name_ =
        utf8(isGroup() ? model_.mix().groups[group()].name : model_.mix().layout.enchanters[number_].label);
    setTitle("Gain lane of " + name_);
    if (chosen_ >= static_cast<int>(lane().size())) chosen_ = -1;
    describeChosen();
    repaint();
}

void LaneRow::describeChosen() {
    const bool isOne = chosen_ >= 0;
    setDescription(lane().empty() ? juce::String{"no points"}
                   : isOne        ? wordsOf(nth(lane(), chosen_))
                                  : countOf(lane().size(), "point"));
    setTooltip("Gain of " + name_ +
               " on top of its fader: click adds a point, drag moves it, right click takes it away. " +
               getDescription());
}

void LaneRow::show(double spanSeconds) {
    spanSeconds_ = spanSeconds;
    repaint();
}

juce::Point<float> LaneRow::placeOf(const GainPoint& point) const {
    const auto area = getLocalBounds().toFloat().reduced(pointInset);
    return {area.getX() + area.getWidth() * static_cast<float>(point.seconds / spanSeconds_),
            area.getBottom() - area.getHeight() * static_cast<float>(scale().convertTo0to1(
                                                      std::clamp(point.db, leastStripDb, mostStripDb)))};
}

GainPoint LaneRow::pointAt(juce::Point<float> place) const {
    const auto area = getLocalBounds().toFloat().reduced(pointInset);
    const double x = std::clamp(static_cast<double>((place.x - area.getX()) / area.getWidth()), 0.0, 1.0),
                 y = std::clamp(static_cast<double>((area.getBottom() - place.y) / area.getHeight()), 0.0,
                                1.0);
    const double db = scale().convertFrom0to1(y);
    return {x * spanSeconds_, std::abs(db) < 0.7 ? 0.0 : std::round(10.0 * db) / 10.0}; // snaps to 0 dB
}

int LaneRow::nearest(juce::Point<float> place) const {
    int found = -1;
    float least = pointSize;
    for (int i = 0; i < static_cast<int>(lane().size()); ++i)
        if (const float d = placeOf(nth(lane(), i)).getDistanceFrom(place); d < least) least = d, found = i;
    return found;
}

void LaneRow::edit(const GainLane& lane, bool continuesEdit) {
    if (!isThere()) return;
    model_.change(
        "Gain lane of " + name_,
        [&](Mix& mix) { (isGroup() ? mix.groups[group()].lane : mix.strips[number_].lane) = lane; },
        continuesEdit);
    describeChosen();
    repaint();
}

void LaneRow::add(const GainPoint& point) {
    if (lane().size() >= mostGainPoints)
        return model_.report("Gain lane of " + name_ + ": at most " +
                             juce::String{static_cast<int>(mostGainPoints)} + " points");
    GainLane next = lane();
    const auto at =
        next.insert(std::ranges::upper_bound(next, point.seconds, {}, &GainPoint::seconds), point);
    chosen_ = static_cast<int>(at - next.begin());
    edit(next);
}

// Limited to the times of its neighbours.
void LaneRow::move(GainPoint point, bool continuesEdit) {
    GainLane next = lane();
    const auto i = static_cast<std::size_t>(chosen_);
    const double from = i > 0 ? next[i - 1].seconds : 0.0,
                 to = i + 1 < next.size() ? next[i + 1].seconds : spanSeconds_;
    next[i] = {std::clamp(point.seconds, from, std::max(from, to)),
               std::clamp(point.db, leastStripDb, mostStripDb)};
    if (next[i] != lane()[i]) edit(next, continuesEdit);
}

void LaneRow::removeChosen() {
    if (chosen_ < 0) return;
    GainLane next = lane();
    next.erase(next.begin() + chosen_);
    chosen_ = std::min(chosen_, static_cast<int>(next.size()) - 1);
    edit(next);
}

void LaneRow::mouseDown(const juce::MouseEvent& e) {
    grabKeyboardFocus();
    const int there = nearest(e.position);
    if (e.mods.isPopupMenu()) {
        chosen_ = there;
        return there >= 0 ? removeChosen() : showMenu();
    }
    isDragging_ = true;
    isMoved_ = there < 0; // a move after adding continues the same edit
    if (there >= 0)
        chosen_ = there, describeChosen(), repaint();
    else
        add(pointAt(e.position));
}

void LaneRow::mouseDrag(const juce::MouseEvent& e) {
    if (!isDragging_ || chosen_ < 0 || (!isMoved_ && !e.mouseWasDraggedSinceMouseDown())) return;
    move(pointAt(e.position), std::exchange(isMoved_, true));
}

void LaneRow::showMenu() {
    juce::PopupMenu menu;
    menu.addSectionHeader("Gain lane of " + name_);
    menu.addItem("Take all points away", !lane().empty(), false,
                 [safe = juce::Component::SafePointer<LaneRow>{this}] {
                     if (safe != nullptr) safe->edit({});
                 });
    menu.setLookAndFeel(&getLookAndFeel());
    menu.showMenuAsync(juce::PopupMenu::Options{}.withTargetComponent(this).withMousePosition());
}

bool LaneRow::keyPressed(const juce::KeyPress& key) {
    using juce::KeyPress;
    const auto& mods = key.getModifiers();
    const int code = key.getKeyCode(), last = static_cast<int>(lane().size()) - 1;
    const bool isSide = code == KeyPress::leftKey || code == KeyPress::rightKey;
    if (code == KeyPress::returnKey || code == KeyPress::insertKey) {
        const double now = std::min(spanSeconds_, model_.signals().run().seconds());
        return add({now, laneDbAt(lane(), now)}), true;
    }
    if (lane().empty()) return false;
    if (code == KeyPress::deleteKey || code == KeyPress::backspaceKey)
        return mods.isShiftDown() ? (edit({}), true) : (removeChosen(), true);
    if (isSide && (!mods.isShiftDown() || chosen_ < 0)) {
        chosen_ = std::clamp(chosen_ + (code == KeyPress::leftKey ? -1 : 1), 0, last);
        return describeChosen(), repaint(), true;
    }
    if (chosen_ < 0) return false;
    GainPoint point = nth(lane(), chosen_);
    if (isSide)
        point.seconds += code == KeyPress::leftKey ? -nudgeSeconds : nudgeSeconds;
    else if (code == KeyPress::upKey || code == KeyPress::downKey)
        point.db += (mods.isShiftDown() ? leapDb : nudgeDb) * (code == KeyPress::upKey ? 1.0 : -1.0);
    else
        return false;
    move(point, true);
    return true;
}

void LaneRow::drawWave(juce::Graphics& g) const {
    const auto area = getLocalBounds().toFloat().reduced(pointInset, 2.0f);
    const RunTrace& trace = model_.signals().run();
    for (const int j : channels()) {
        juce::RectangleList<float> columns;
        for (float x = 0.0f; x < area.getWidth(); x += 1.0f) {
            const double from = spanSeconds_ * static_cast<double>(x / area.getWidth()),
                         to = spanSeconds_ * static_cast<double>((x + 1.0f) / area.getWidth());
            if (from > trace.seconds()) break;
            const auto range = trace.range(j, from, to);
            const float top = shownLevel(range.highest), bottom = shownLevel(range.lowest),
                        reach = 0.5f * area.getHeight();
            columns.addWithoutMerging({area.getX() + x, area.getCentreY() - reach * top - 0.5f, 1.0f,
                                       reach * (top - bottom) + 1.0f});
        }
        g.setColour(enchanterColour(*this, j).withMultipliedAlpha(model_.mix().isSilent(j) ? 0.2f : 0.5f));
        g.fillRectList(columns);
    }
}

void LaneRow::drawLine(juce::Graphics& g) const {
    const auto right = static_cast<float>(getWidth()) - pointInset;
    juce::Path line;
    line.startNewSubPath(placeOf({0.0, laneDbAt(lane(), 0.0)}));
    for (const GainPoint& point : lane()) line.lineTo(placeOf(point));
    line.lineTo({right, lane().empty() ? placeOf({0.0, 0.0}).y : placeOf(lane().back()).y});
    g.setColour(shade(*this, lane().empty() ? Shade::line : Shade::text));
    g.strokePath(line, juce::PathStrokeType{lane().empty() ? 1.0f : 1.6f});
    for (int i = 0; i < static_cast<int>(lane().size()); ++i) {
        const auto at = juce::Rectangle<float>{pointSize, pointSize}.withCentre(placeOf(nth(lane(), i)));
        g.setColour(shade(*this, i == chosen_ ? Shade::accent : Shade::text));
        g.fillEllipse(i == chosen_ ? at.expanded(1.5f) : at.reduced(1.0f));
    }
}

void LaneRow::paint(juce::Graphics& g) {
    fillRound(g, *this, Shade::well, getLocalBounds().toFloat(), 3.0f);
    drawWave(g);
    const juce::Graphics::ScopedSaveState saved{g};
    g.reduceClipRegion(getLocalBounds());
    drawLine(g);
    const float now = placeOf({model_.signals().run().seconds(), 0.0}).x;
    g.setColour(shade(*this, Shade::now));
    g.fillRect(now - 0.75f, 0.0f, 1.5f, static_cast<float>(getHeight()));
}

} // namespace physvib

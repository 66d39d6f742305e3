// SPDX-License-Identifier: GPL-3.0-or-later
// Rows with the gain lanes of all strips and groups over a time axis, and the editing of their points.
#include "Mixer/Strips/LanesTab.h"
#include "Mixer/Strips/ScopeView.h"

namespace physvib {
namespace {

constexpr int labelWidth = 92, minRowHeight = 34, laneRowGap = 6, footHeight = 18;

constexpr float pointSize = 8.0f, pointInset = 5.0f; // keeps points at the edge fully visible
constexpr double pointStepSeconds = 0.05, pointStepDb = 0.5, largePointStepDb = 3.0;
constexpr double maxKeyGapMs = 1000.0; // between keys of one undo step

juce::String pointText(const GainPoint& point) {
    return (point.db <= minStripDb ? juce::String{"silent"} : number(point.db, 1) + " dB") + " at " +
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
    const std::size_t laneCount = model_.mix().strips.size() + model_.mix().groups.size();
    if (rows_.lanes.size() != laneCount) {
        rows_.lanes.clear();
        for (std::size_t i = 0; i < laneCount; ++i) {
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

// Returns a round duration that covers the scene so far and all points of the lanes.
double LanesTab::spanSeconds() const {
    double neededSeconds = model_.signals().runTrace().seconds();
    const auto include = [&neededSeconds](const GainLane& lane) {
        if (!lane.empty()) neededSeconds = std::max(neededSeconds, lane.back().seconds);
    };
    for (const Strip& strip : model_.mix().strips) include(strip.lane);
    for (const StripGroup& group : model_.mix().groups) include(group.lane);
    double span = 10.0;
    for (int k = 0; span < neededSeconds; ++k) span *= k % 3 == 1 ? 1.5 : 2.0; // 20, 30, 60, 120, 180, 360...
    return span;
}

void LanesTab::refresh(const MixerSnapshot&) {
    const double seconds = model_.signals().runTrace().seconds(), span = spanSeconds();
    if (seconds == shownSeconds_ && span == spanSeconds_) return;
    shownSeconds_ = seconds;
    if (span != std::exchange(spanSeconds_, span)) repaint(axisArea_);
    for (auto& lane : rows_.lanes) lane->setSpan(span);
}

void LanesTab::Rows::paint(juce::Graphics& g) {
    g.setFont(text::font(text::medium, juce::Font::bold));
    const auto& mix = model.mix();
    for (std::size_t i = 0; i < std::min(lanes.size(), mix.strips.size() + mix.groups.size()); ++i) {
        const bool isStrip = i < mix.strips.size();
        g.setColour(isStrip ? actuatorColour(*this, static_cast<int>(i)) : shade(*this, Shade::text));
        const auto label =
            utf8(isStrip ? mix.layout.actuators[i].label : mix.groups[i - mix.strips.size()].name);
        g.drawFittedText(label, lanes[i]->getBounds().withX(0).withWidth(labelWidth - 8),
                         juce::Justification::centredLeft, 1, 1.0f);
    }
}

void LanesTab::paint(juce::Graphics& g) {
    setInk(g, *this, Shade::muted, text::small);
    const auto axis = axisArea_.withTrimmedLeft(labelWidth);
    g.drawText("0", axis, juce::Justification::centredLeft, false);
    g.drawText(number(std::max(10.0, spanSeconds_), 0) + " s of the scene", axis,
               juce::Justification::centredRight, false);
    const auto room = axis.withTrimmedLeft(20).withTrimmedRight(110);
    for (const char* hint : {"Click adds a point. Record (Ctrl+R), and the faders you move are written.",
                             "Click adds a point. Ctrl+R records faders.", "Click adds a point."})
        if (text::pixelWidth(g.getCurrentFont(), hint) <= room.getWidth())
            return g.drawText(hint, room, juce::Justification::centred, false);
}

void LanesTab::resized() {
    auto area = getLocalBounds();
    axisArea_ = area.removeFromBottom(footHeight);
    area.removeFromBottom(2);
    viewport_.setBounds(area);
    const int laneCount = std::max(1, static_cast<int>(rows_.lanes.size()));
    const int laneHeight = std::max(minRowHeight, (area.getHeight() + laneRowGap) / laneCount - laneRowGap),
              totalPixels = laneCount * (laneHeight + laneRowGap) - laneRowGap;
    rows_.setSize(area.getWidth() - (totalPixels > area.getHeight() ? 10 : 0), totalPixels);
    auto space = rows_.getLocalBounds().withTrimmedLeft(labelWidth);
    for (auto& lane : rows_.lanes)
        lane->setBounds(space.removeFromTop(laneHeight)), space.removeFromTop(laneRowGap);
}

// Mouse and keyboard editing of a gain lane; its vertical scale is that of a fader.

LaneRow::LaneRow(MixerModel& model, std::size_t index)
    : model_{model}
    , index_{index} {
    setWantsKeyboardFocus(true);
    mixChanged();
}

juce::NormalisableRange<double> LaneRow::scale() {
    juce::NormalisableRange<double> range{minStripDb, maxStripDb};
    range.setSkewForCentre(-15.0); // like the faders
    return range;
}

const GainLane& LaneRow::lane() const {
    static const GainLane none;
    if (!isValid()) return none;
    return isGroup() ? model_.mix().groups[groupIndex()].lane : model_.mix().strips[index_].lane;
}

std::vector<int> LaneRow::channels() const {
    if (!isValid()) return {};
    if (!isGroup()) return {static_cast<int>(index_)};
    std::vector<int> all;
    for (int j = 0; j < model_.mix().count(); ++j)
        if (nth(model_.mix().strips, j).group == static_cast<int>(groupIndex())) all.push_back(j);
    return all;
}

void LaneRow::mixChanged() {
    if (!isValid()) return;
    name_ = utf8(isGroup() ? model_.mix().groups[groupIndex()].name
                           : model_.mix().layout.actuators[index_].label);
    setTitle("Gain lane of " + name_);
    if (selectedPoint_ >= static_cast<int>(lane().size())) selectedPoint_ = -1;
    describeSelectedPoint();
    repaint();
}

void LaneRow::describeSelectedPoint() {
    const bool hasSelection = selectedPoint_ >= 0;
    setDescription(lane().empty() ? juce::String{"no points"}
                   : hasSelection ? pointText(nth(lane(), selectedPoint_))
                                  : countText(lane().size(), "point"));
    setTooltip("Gain of " + name_ +
               " on top of its fader: click adds a point, drag moves it, right click takes it away. " +
               getDescription());
}

void LaneRow::setSpan(double spanSeconds) {
    spanSeconds_ = spanSeconds;
    repaint();
}

juce::Point<float> LaneRow::toPixel(const GainPoint& point) const {
    const auto area = getLocalBounds().toFloat().reduced(pointInset);
    return {area.getX() + area.getWidth() * static_cast<float>(point.seconds / spanSeconds_),
            area.getBottom() - area.getHeight() * static_cast<float>(scale().convertTo0to1(
                                                      std::clamp(point.db, minStripDb, maxStripDb)))};
}

GainPoint LaneRow::pointAt(juce::Point<float> pixel) const {
    const auto area = getLocalBounds().toFloat().reduced(pointInset);
    const double x = std::clamp(static_cast<double>((pixel.x - area.getX()) / area.getWidth()), 0.0, 1.0),
                 y = std::clamp(static_cast<double>((area.getBottom() - pixel.y) / area.getHeight()), 0.0,
                                1.0);
    const double db = scale().convertFrom0to1(y);
    return {x * spanSeconds_, std::abs(db) < 0.7 ? 0.0 : std::round(10.0 * db) / 10.0}; // snaps to 0 dB
}

int LaneRow::nearestPoint(juce::Point<float> pixel) const {
    int nearest = -1;
    float minDistance = pointSize;
    for (int i = 0; i < static_cast<int>(lane().size()); ++i)
        if (const float distance = toPixel(nth(lane(), i)).getDistanceFrom(pixel); distance < minDistance)
            minDistance = distance, nearest = i;
    return nearest;
}

void LaneRow::edit(const GainLane& lane, bool continuesEdit) {
    if (!isValid()) return;
    if (!continuesEdit) lastKeyMs_ = 0.0;
    model_.change("Gain lane of " + name_, continuesEdit, [&](Mix& mix) {
        (isGroup() ? mix.groups[groupIndex()].lane : mix.strips[index_].lane) = lane;
    });
    describeSelectedPoint();
    repaint();
}

void LaneRow::add(const GainPoint& point) {
    if (lane().size() >= maxGainPoints)
        return model_.report("Gain lane of " + name_ + ": at most " +
                             juce::String{static_cast<int>(maxGainPoints)} + " points");
    GainLane newLane = lane();
    const auto newPoint =
        newLane.insert(std::ranges::upper_bound(newLane, point.seconds, {}, &GainPoint::seconds), point);
    selectedPoint_ = static_cast<int>(newPoint - newLane.begin());
    edit(newLane);
}

// Moves the selected point, at most to the times of its neighbours.
void LaneRow::move(GainPoint point, bool continuesEdit) {
    GainLane newLane = lane();
    const auto i = static_cast<std::size_t>(selectedPoint_);
    const double minSeconds = i > 0 ? newLane[i - 1].seconds : 0.0,
                 maxSeconds = i + 1 < newLane.size() ? newLane[i + 1].seconds : spanSeconds_;
    newLane[i] = {std::clamp(point.seconds, minSeconds, std::max(minSeconds, maxSeconds)),
                  std::clamp(point.db, minStripDb, maxStripDb)};
    if (newLane[i] != lane()[i]) edit(newLane, continuesEdit);
}

void LaneRow::removeSelectedPoint() {
    if (selectedPoint_ < 0) return;
    GainLane newLane = lane();
    newLane.erase(newLane.begin() + selectedPoint_);
    selectedPoint_ = std::min(selectedPoint_, static_cast<int>(newLane.size()) - 1);
    edit(newLane);
}

void LaneRow::mouseDown(const juce::MouseEvent& e) {
    grabKeyboardFocus();
    const int point = nearestPoint(e.position);
    if (e.mods.isPopupMenu()) {
        selectedPoint_ = point;
        return point >= 0 ? removeSelectedPoint() : showMenu();
    }
    isDragging_ = true;
    hasMoved_ = point < 0; // a move after adding continues the same edit
    if (point >= 0)
        selectedPoint_ = point, describeSelectedPoint(), repaint();
    else
        add(pointAt(e.position));
}

void LaneRow::mouseDrag(const juce::MouseEvent& e) {
    if (!isDragging_ || selectedPoint_ < 0 || (!hasMoved_ && !e.mouseWasDraggedSinceMouseDown())) return;
    move(pointAt(e.position), std::exchange(hasMoved_, true));
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
    const bool isHorizontalKey = code == KeyPress::leftKey || code == KeyPress::rightKey;
    if (code == KeyPress::returnKey || code == KeyPress::insertKey) {
        const double seconds = std::min(spanSeconds_, model_.signals().runTrace().seconds());
        return add({seconds, laneDbAt(lane(), seconds)}), true;
    }
    if (lane().empty()) return false;
    if (code == KeyPress::deleteKey || code == KeyPress::backspaceKey)
        return mods.isShiftDown() ? (edit({}), true) : (removeSelectedPoint(), true);
    if (isHorizontalKey && (!mods.isShiftDown() || selectedPoint_ < 0)) {
        selectedPoint_ = std::clamp(selectedPoint_ + (code == KeyPress::leftKey ? -1 : 1), 0, last);
        return describeSelectedPoint(), repaint(), true;
    }
    if (selectedPoint_ < 0) return false;
    GainPoint point = nth(lane(), selectedPoint_);
    if (isHorizontalKey)
        point.seconds += code == KeyPress::leftKey ? -pointStepSeconds : pointStepSeconds;
    else if (code == KeyPress::upKey || code == KeyPress::downKey)
        point.db +=
            (mods.isShiftDown() ? largePointStepDb : pointStepDb) * (code == KeyPress::upKey ? 1.0 : -1.0);
    else
        return false;
    if (nowMs() - std::exchange(lastKeyMs_, nowMs()) > maxKeyGapMs)
        model_.undoManager().beginNewTransaction();
    move(point, true);
    return true;
}

void LaneRow::drawWave(juce::Graphics& g) const {
    const auto area = getLocalBounds().toFloat().reduced(pointInset, 2.0f);
    const RunTrace& trace = model_.signals().runTrace();
    for (const int j : channels()) {
        juce::RectangleList<float> columns;
        for (float x = 0.0f; x < area.getWidth(); x += 1.0f) {
            const double startSeconds = spanSeconds_ * static_cast<double>(x / area.getWidth()),
                         endSeconds = spanSeconds_ * static_cast<double>((x + 1.0f) / area.getWidth());
            if (startSeconds > trace.seconds()) break;
            const auto range = trace.range(j, startSeconds, endSeconds);
            const float top = displayLevel(range.highest), bottom = displayLevel(range.lowest),
                        halfHeight = 0.5f * area.getHeight();
            columns.addWithoutMerging({area.getX() + x, area.getCentreY() - halfHeight * top - 0.5f, 1.0f,
                                       halfHeight * (top - bottom) + 1.0f});
        }
        g.setColour(actuatorColour(*this, j).withMultipliedAlpha(model_.mix().isSilent(j) ? 0.2f : 0.5f));
        g.fillRectList(columns);
    }
}

void LaneRow::drawLine(juce::Graphics& g) const {
    const auto right = static_cast<float>(getWidth()) - pointInset;
    juce::Path line;
    line.startNewSubPath(toPixel({0.0, laneDbAt(lane(), 0.0)}));
    for (const GainPoint& point : lane()) line.lineTo(toPixel(point));
    line.lineTo({right, lane().empty() ? toPixel({0.0, 0.0}).y : toPixel(lane().back()).y});
    g.setColour(shade(*this, lane().empty() ? Shade::line : Shade::text));
    g.strokePath(line, juce::PathStrokeType{lane().empty() ? 1.0f : 1.6f});
    for (int i = 0; i < static_cast<int>(lane().size()); ++i) {
        const auto dot = juce::Rectangle<float>{pointSize, pointSize}.withCentre(toPixel(nth(lane(), i)));
        g.setColour(shade(*this, i == selectedPoint_ ? Shade::accent : Shade::text));
        g.fillEllipse(i == selectedPoint_ ? dot.expanded(1.5f) : dot.reduced(1.0f));
    }
}

void LaneRow::paint(juce::Graphics& g) {
    fillRound(g, *this, Shade::well, getLocalBounds().toFloat(), 3.0f);
    drawWave(g);
    const juce::Graphics::ScopedSaveState saved{g};
    g.reduceClipRegion(getLocalBounds());
    drawLine(g);
    const float nowX = toPixel({model_.signals().runTrace().seconds(), 0.0}).x;
    g.setColour(shade(*this, Shade::highlight));
    g.fillRect(nowX - 0.75f, 0.0f, 1.5f, static_cast<float>(getHeight()));
}

} // namespace physvib

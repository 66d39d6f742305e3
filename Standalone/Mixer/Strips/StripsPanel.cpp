// SPDX-License-Identifier: GPL-3.0-or-later
// Creates and removes strip views with their actuators.
#include "Mixer/Strips/StripsPanel.h"
#include "Host/Views/WorldView.h"

namespace physvib {

StripsPanel::AttachPlace::AttachPlace()
    : juce::Button{"Attach an actuator"} {
    setTitle("Attach an actuator");
    setTooltip("Attach an actuator: press, or drag it onto the field");
}

void StripsPanel::AttachPlace::paintButton(juce::Graphics& g, bool isOver, bool) {
    const auto area = getLocalBounds().toFloat().reduced(1.0f);
    juce::Path outline, dashed;
    outline.addRoundedRectangle(area, 6.0f);
    constexpr float dashes[]{5.0f, 5.0f};
    juce::PathStrokeType{1.2f}.createDashedStroke(dashed, outline, dashes, 2);
    g.setColour(shade(*this, isOver ? Shade::accent : Shade::line));
    g.fillPath(dashed);
    g.setColour(shade(*this, isOver ? Shade::accent : Shade::muted));
    g.setFont(juce::Font{text::large});
    g.drawText("+", area.withTrimmedBottom(24.0f), juce::Justification::centred, false);
    g.setFont(juce::Font{text::small});
    g.drawText("attach", area.withTrimmedTop(24.0f), juce::Justification::centred, false);
}

void StripsPanel::AttachPlace::mouseDrag(const juce::MouseEvent& e) {
    auto* container = juce::DragAndDropContainer::findParentDragContainerFor(this);
    if (container == nullptr || container->isDragAndDropActive() || e.getDistanceFromDragStart() < 6) return;
    setState(buttonNormal);
    container->startDragging(WorldView::newEnchanter, this);
}

StripsPanel::StripsPanel(Desk& desk)
    : desk_{desk}
    , master_{desk} {
    setTitle("Mixer");
    viewport_.setViewedComponent(&row_, false);
    viewport_.setScrollBarsShown(false, true);
    viewport_.setScrollBarThickness(8);
    addAndMakeVisible(viewport_);
    addAndMakeVisible(master_);
    row_.addAndMakeVisible(attach_);
    attach_.onClick = [this] { desk_.attach(0.5, 0.5); };
    takeMix();
}

void StripsPanel::takeMix() {
    juce::StringArray labels, names;
    for (const auto& e : desk_.mix().layout.enchanters) labels.add(utf8(e.label));
    for (const auto& group : desk_.mix().groups) names.add(utf8(group.name));
    const bool areOther = labels != labels_, areOtherGroups = names != groupNames_;
    labels_ = labels;
    groupNames_ = names;
    if (areOther) makeStrips();
    if (areOtherGroups) makeGroups();
    for (auto& strip : strips_) strip->takeMix();
    for (auto& group : groups_) group->takeMix();
    if (areOther || areOtherGroups) {
        attach_.toFront(false); // last in Tab order
        resized();
    }
    attach_.setVisible(desk_.mix().count() < limits::maxEnchanters);
    master_.takeMix();
}

void StripsPanel::makeStrips() {
    strips_.clear();
    for (int j = 0; j < desk_.mix().count(); ++j) {
        strips_.push_back(std::make_unique<StripView>(desk_, j));
        row_.addAndMakeVisible(*strips_.back());
    }
    for (auto& strip : strips_) prepareControls(*strip); // colours depend on the parent component
    for (auto& group : groups_) group->toFront(false);
}

void StripsPanel::makeGroups() {
    groups_.clear();
    for (int k = 0; k < static_cast<int>(desk_.mix().groups.size()); ++k) {
        groups_.push_back(std::make_unique<GroupView>(desk_, k));
        row_.addAndMakeVisible(*groups_.back());
    }
    for (auto& group : groups_) prepareControls(*group);
}

void StripsPanel::refresh(const DeskMoment& moment) {
    for (auto& strip : strips_) strip->refresh(moment);
    master_.refresh(moment);
}

void StripsPanel::focusOfChildComponentChanged(FocusChangeType) {
    auto* focused = getCurrentlyFocusedComponent();
    if (focused == nullptr || !row_.isParentOf(focused)) return;
    const auto at = row_.getLocalArea(focused, focused->getLocalBounds());
    if (!viewport_.getViewArea().contains(at))
        viewport_.setViewPosition(std::max(0, at.getCentreX() - viewport_.getViewWidth() / 2), 0);
}

void StripsPanel::paint(juce::Graphics& g) { drawPanel(g, *this); }

int StripsPanel::fixedWidth() const {
    return static_cast<int>(groups_.size()) * (GroupView::width + between) + attachWidth;
}

int StripsPanel::widthFor(int strip) const {
    return static_cast<int>(strips_.size()) * (strip + between) + fixedWidth() + MasterStrip::width + 8 +
           2 * panelInset;
}

void StripsPanel::showOutputs(int enchanter) {
    if (enchanter < 0 || enchanter >= static_cast<int>(strips_.size())) return;
    auto& strip = *strips_[static_cast<std::size_t>(enchanter)];
    viewport_.setViewPosition(std::max(0, strip.getX() - between), 0);
    strip.showOutputs();
}

void StripsPanel::resized() {
    auto area = getLocalBounds().reduced(panelInset, 10);
    master_.setBounds(area.removeFromRight(MasterStrip::width));
    area.removeFromRight(8);
    viewport_.setBounds(area);
    const int strips = std::max(1, static_cast<int>(strips_.size())), rest = area.getWidth() - fixedWidth(),
              width = juce::jlimit(StripView::width, StripView::mostWidth, rest / strips - between),
              needed = strips * (width + between) + fixedWidth();
    row_.setSize(std::max(needed, area.getWidth()), area.getHeight() - (needed > area.getWidth() ? 10 : 0));
    auto places = row_.getLocalBounds();
    for (auto& strip : strips_)
        strip->setBounds(places.removeFromLeft(width)), places.removeFromLeft(between);
    for (auto& group : groups_)
        group->setBounds(places.removeFromLeft(GroupView::width)), places.removeFromLeft(between);
    attach_.setBounds(places.removeFromLeft(attachWidth).withTrimmedTop(2).withTrimmedBottom(2));
}

} // namespace physvib

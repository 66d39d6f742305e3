// SPDX-License-Identifier: GPL-3.0-or-later
// A list that is brought up to date a few times a second.
#include "Mixer/Output/EventsTab.h"
#include "Mixer/Materials/HitWords.h"

namespace physvib {

namespace {

constexpr int rowPixels = 22, headPixels = 18;
constexpr double showMs = 250.0;

struct Columns {
    juce::Rectangle<int> time, dot, name, frequency, decay, level, enchanter, place;
    explicit Columns(juce::Rectangle<int> row) {
        row.reduce(10, 0);
        const int each = row.getWidth() / 8;
        time = row.removeFromLeft(each);
        dot = row.removeFromLeft(20);
        place = row.removeFromRight(each + 24);
        enchanter = row.removeFromRight(each - 24);
        level = row.removeFromRight(each - 10);
        decay = row.removeFromRight(each - 6);
        frequency = row.removeFromRight(each - 6);
        name = row;
    }
};

juce::String timeText(std::int64_t ns) { return number(1e-9 * static_cast<double>(ns), 3) + " s"; }
/// What sounds; of what rolls or slides also how, and how many grains it has passed.
juce::String nameOf(const Scene& scene, const RecentContact& contact) {
    const auto name = materialName(scene, contact.event);
    const auto kind = contact.event.source.kind;
    if (kind == ContactKind::hit) return name;
    return name + (kind == ContactKind::roll ? ", rolls, " : ", slides, ") + juce::String{contact.grains} + (contact.grains == 1 ? " grain" : " grains");
}

juce::String placeNumbers(const CollisionEvent& hit) { return number(hit.x, 2) + ", " + number(hit.y, 2) + " m"; }

} // namespace

EventsTab::EventsTab(Desk& desk)
    : desk_{desk} {
    setTitle("Events");
    list_.setTitle("List of played events");
    list_.setRowHeight(rowPixels);
    addAndMakeVisible(list_);
}

void EventsTab::refresh(const DeskMoment& moment) {
    const double now = juce::Time::getMillisecondCounterHiRes();
    if (moment.session.render.played == seen_ || now - shownAtMs_ < showMs) return;
    shownAtMs_ = now;
    seen_ = moment.session.render.played;
    shown_.assign(desk_.recent().begin(), desk_.recent().end());
    list_.updateContent();
    list_.repaint();
}

juce::String EventsTab::Rows::getNameForRow(int row) {
    if (row < 0 || row >= getNumRows()) return {};
    const auto& contact = tab_.shown_[static_cast<std::size_t>(row)];
    const auto& hit = contact.event;
    const auto& scene = tab_.desk_.sceneNow();
    return nameOf(scene, contact) + " at " + timeText(hit.timeNs) + ", " + number(feltMost(tab_.desk_.mix(), hit).levelG, 2) + " g " + placeText(scene, hit);
}

void EventsTab::Rows::paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) {
    if (row >= getNumRows()) return;
    const auto& contact = tab_.shown_[static_cast<std::size_t>(row)];
    const auto& hit = contact.event;
    const auto& desk = tab_.desk_;
    if (isSelected) {
        g.setColour(shade(tab_, Shade::accent).withAlpha(0.16f));
        g.fillRect(0, 0, width, height);
    }
    const Columns at{{width, height}};
    const auto most = feltMost(desk.mix(), hit);
    const int material = materialOf(desk.sceneNow(), hit);
    g.setColour(material < 0 ? palette::other : palette::material(material));
    g.fillEllipse(at.dot.toFloat().withSizeKeepingCentre(10.0f, 10.0f).translated(-4.0f, 0.0f));
    const auto cell = [&](const juce::String& words, juce::Rectangle<int> area, Shade which, bool isNumber) {
        g.setColour(shade(tab_, which));
        g.drawText(words, area, isNumber ? juce::Justification::centredRight : juce::Justification::centredLeft, true);
    };
    g.setFont(juce::Font{text::small});
    cell(timeText(hit.timeNs), at.time, Shade::muted, false);
    cell(nameOf(desk.sceneNow(), contact), at.name, Shade::text, false);
    cell(number(hit.frequencyHz, 1), at.frequency, Shade::text, true);
    cell(number(hit.decayPerSecond, 1), at.decay, Shade::text, true);
    cell(number(most.levelG, 3), at.level, Shade::text, true);
    cell(placeNumbers(hit), at.place, Shade::muted, true);
    g.setFont(juce::Font{text::small, juce::Font::bold});
    g.setColour(enchanterColour(tab_, most.enchanter));
    g.drawText(utf8(desk.mix().layout.enchanters[static_cast<std::size_t>(most.enchanter)].label), at.enchanter, juce::Justification::centred, true);
}

void EventsTab::paint(juce::Graphics& g) {
    const Columns at{getLocalBounds().withHeight(headPixels).withWidth(list_.getVisibleRowWidth())};
    g.setFont(juce::Font{text::small});
    g.setColour(shade(*this, Shade::muted));
    const auto head = [&](const juce::String& words, juce::Rectangle<int> area, juce::Justification where) { g.drawText(words, area, where, true); };
    head("Contact", at.time, juce::Justification::centredLeft);
    head("Material", at.name, juce::Justification::centredLeft);
    head("f Hz", at.frequency, juce::Justification::centredRight);
    head(juce::String::charToString(0x03c4) + " 1/s", at.decay, juce::Justification::centredRight);
    head("g", at.level, juce::Justification::centredRight);
    head("most on", at.enchanter, juce::Justification::centred);
    head("x, y", at.place, juce::Justification::centredRight);
}

void EventsTab::resized() { list_.setBounds(getLocalBounds().withTrimmedTop(headPixels)); }

} // namespace physvib

// SPDX-License-Identifier: GPL-3.0-or-later
// Controls of a strip group and their edits of the mixer state.
#include "Mixer/Strips/GroupView.h"
#include "Host/Views/StripParts.h"
#include "Io/Disk/FileLimits.h"
#include "Live/Documents/Mix.h"
#include <algorithm>

namespace physvib {

GroupView::GroupView(Desk& desk, int group)
    : desk_{desk}
    , index_{static_cast<std::size_t>(group)} {
    const auto label = utf8(this->group().name);
    setTitle("Group " + label);
    name_.setTitle("Name of " + label);
    name_.setTooltip("Double click, or Return: another name");
    name_.setFont(juce::Font{text::medium, juce::Font::bold});
    name_.setJustificationType(juce::Justification::centred);
    name_.setMinimumHorizontalScale(0.8f);
    name_.setBorderSize({0, 0, 0, 0});
    name_.setEditable(false, true);
    name_.setWantsKeyboardFocus(true);
    name_.onTextChange = [this] { rename(); };
    level_.setFont(juce::Font{text::small});
    level_.setJustificationType(juce::Justification::centred);
    level_.setTitle("Gain of the group " + label);
    fader_.setUp(leastStripDb, mostStripDb, "Gain of the group " + label);
    onSlide(fader_, [this](bool goesOn) {
        change(
            "Gain", [this](StripGroup& g) { g.gainDb = fader_.getValue(); }, goesOn);
    });
    mute_.setTitle("Mute the group " + label);
    mute_.setTooltip("Mute all of the group");
    mute_.getProperties().set(tintProperty, static_cast<juce::int64>(palette::limit.getARGB()));
    mute_.onClick = [this] { change("Mute", [](StripGroup& g) { g.isMuted = !g.isMuted; }); };
    remove_ = quietButton("Ungroup", "Ungroup " + label);
    remove_->setTooltip("The strips take over what the group does to them");
    remove_->onClick = [this] {
        // deferred, because this view is deleted with the group
        juce::MessageManager::callAsync([safe = juce::Component::SafePointer<GroupView>{this}] {
            if (safe != nullptr) safe->remove();
        });
    };
    for (juce::Component* c :
         std::initializer_list<juce::Component*>{&name_, &level_, &fader_, &mute_, remove_.get()})
        addAndMakeVisible(c);
    takeMix();
}

template <class Change>
void GroupView::change(const juce::String& name, Change change, bool goesOn) {
    desk_.change(
        name + " of " + utf8(group().name), [&](Mix& mix) { change(mix.groups[index_]); }, goesOn);
}

void GroupView::rename() {
    const auto name = name_.getText().trim();
    const bool isFit = name.isNotEmpty() && name.getNumBytesAsUTF8() <= limits::maxNameBytes;
    if (isFit && name != utf8(group().name))
        change("Name", [&](StripGroup& g) { g.name = name.toStdString(); });
    else
        name_.setText(utf8(group().name), juce::dontSendNotification);
}

void GroupView::remove() {
    desk_.change("Ungroup " + utf8(group().name),
                 [this](Mix& mix) { removeGroup(mix, static_cast<int>(index_)); });
}

void GroupView::takeMix() {
    if (!name_.isBeingEdited()) name_.setText(utf8(group().name), juce::dontSendNotification);
    if (!fader_.isMouseButtonDown()) fader_.setValue(group().gainDb, juce::dontSendNotification);
    level_.setText(group().gainDb <= leastStripDb ? juce::String{"silent"}
                                                  : number(group().gainDb, 1) + " dB",
                   juce::dontSendNotification);
    level_.setColour(juce::Label::textColourId, shade(*this, Shade::muted));
    mute_.setToggleState(group().isMuted, juce::dontSendNotification);
    repaint();
}

bool GroupView::keyPressed(const juce::KeyPress& key) {
    if (key != juce::KeyPress::returnKey || !name_.hasKeyboardFocus(false)) return false;
    name_.showEditor();
    return true;
}

void GroupView::paint(juce::Graphics& g) {
    if (index_ >= desk_.mix().groups.size()) return; // the group was removed; the view follows in a moment
    auto area = getLocalBounds();
    g.setColour(shade(*this, Shade::raised));
    g.fillRoundedRectangle(area.toFloat(), 6.0f);
    auto bar = area.removeFromTop(4).toFloat();
    std::vector<int> members;
    for (int j = 0; j < desk_.mix().count(); ++j)
        if (desk_.mix().strips[static_cast<std::size_t>(j)].group == static_cast<int>(index_))
            members.push_back(j);
    if (members.empty()) g.setColour(shade(*this, Shade::line)), g.fillRoundedRectangle(bar, 2.0f);
    juce::StringArray labels;
    const float each = bar.getWidth() / static_cast<float>(std::max<std::size_t>(1, members.size()));
    for (const int j : members) {
        g.setColour(enchanterColour(*this, j).withMultipliedAlpha(desk_.mix().isSilent(j) ? 0.35f : 1.0f));
        g.fillRoundedRectangle(bar.removeFromLeft(each).reduced(0.5f, 0.0f), 2.0f);
        labels.add(utf8(desk_.mix().layout.enchanters[static_cast<std::size_t>(j)].label));
    }
    g.setColour(shade(*this, Shade::muted));
    g.setFont(juce::Font{text::small});
    g.drawText(members.empty() ? juce::String{"no strip yet"} : labels.joinIntoString(" "),
               getLocalBounds().withTrimmedTop(28).removeFromTop(18).reduced(4, 0),
               juce::Justification::centred, true);
}

void GroupView::resized() {
    auto area = getLocalBounds();
    name_.setBounds(area.withTrimmedTop(8).removeFromTop(20).reduced(3, 0));
    area.removeFromTop(56);
    remove_->setBounds(area.removeFromBottom(22).reduced(2, 0));
    area.removeFromBottom(26);
    level_.setBounds(area.removeFromBottom(22));
    mute_.setBounds(area.removeFromBottom(24).withSizeKeepingCentre(28, 24));
    area.removeFromBottom(8);
    fader_.setBounds(area.withSizeKeepingCentre(32, area.getHeight()).expanded(0, 8));
}

void showGroupMenu(Desk& desk, std::size_t strip, juce::Component& from) {
    const auto& mix = desk.mix();
    const auto label = utf8(mix.layout.enchanters[strip].label);
    const auto put = [&desk, strip, label](int group) {
        desk.change("Group of " + label, [&](Mix& m) { m.strips[strip].group = group; });
    };
    juce::PopupMenu menu;
    menu.addSectionHeader("Group of " + label);
    menu.addItem("None", true, mix.strips[strip].group < 0, [put] { put(-1); });
    for (int k = 0; k < static_cast<int>(mix.groups.size()); ++k)
        menu.addItem(utf8(mix.groups[static_cast<std::size_t>(k)].name), true, mix.strips[strip].group == k,
                     [put, k] { put(k); });
    menu.addSeparator();
    const auto fresh = freeGroupName(mix);
    menu.addItem("New: " + utf8(fresh), mix.groups.size() < mostGroups, false, [&desk, strip, label, fresh] {
        desk.change("Group of " + label, [&](Mix& m) { m.strips[strip].group = addGroup(m, fresh); });
    });
    menu.setLookAndFeel(&from.getLookAndFeel());
    menu.showMenuAsync(juce::PopupMenu::Options{}.withTargetComponent(from));
}

} // namespace physvib

// SPDX-License-Identifier: GPL-3.0-or-later
// Controls of channel strips and groups, their edits of the mixer state, and their arrangement in the panel.
#include "Mixer/Strips/StripsPanel.h"
#include "Core/Units.h"
#include "Host/Views/WorldView.h"
#include "Io/Disk/ReadFile.h"

namespace physvib {
namespace {

/// Menu of the groups that the strip may join, and of a new one.
void showGroupMenu(MixerModel& model, std::size_t strip, juce::Component& anchor) {
    const auto& mix = model.mix();
    const auto label = labelOf(mix, strip);
    const auto setGroup = [&model, strip, label](int group) {
        model.change("Group of " + label, [&](Mix& m) { m.strips[strip].group = group; });
    };
    juce::PopupMenu menu;
    menu.addSectionHeader("Group of " + label);
    menu.addItem("None", true, mix.strips[strip].group < 0, [setGroup] { setGroup(-1); });
    for (int k = 0; k < static_cast<int>(mix.groups.size()); ++k)
        menu.addItem(utf8(nth(mix.groups, k).name), true, mix.strips[strip].group == k,
                     [setGroup, k] { setGroup(k); });
    menu.addSeparator();
    const auto name = freeGroupName(mix);
    menu.addItem("New: " + utf8(name), mix.groups.size() < maxGroups, false, [&model, strip, label, name] {
        model.change("Group of " + label, [&](Mix& m) { m.strips[strip].group = addGroup(m, name); });
    });
    menu.setLookAndFeel(&anchor.getLookAndFeel());
    menu.showMenuAsync(juce::PopupMenu::Options{}.withTargetComponent(anchor));
}

} // namespace

StripView::StripView(MixerModel& model, int strip)
    : StripParts{labelOf(model.mix(), strip)}
    , model_{model}
    , index_{static_cast<std::size_t>(strip)}
    , sweep_{Icon::sweep, "Sweep on " + labelOf(model.mix(), index_)} {
    const auto label = labelOf(model.mix(), index_);
    onSliderChange(fader_, [this](bool continuesEdit) {
        change("Gain", continuesEdit, [this](Strip& s) { s.gainDb = fader_.getValue(); });
    });
    ceiling_.textFromValueFunction = [this](double db) {
        return "at most " + number(db, 1) + " dB, " +
               gText(stripLevelG(model_, index_, static_cast<float>(fromDecibels(db)))) + " g";
    };
    onSliderChange(ceiling_, [this](bool continuesEdit) {
        change("Ceiling", continuesEdit, [this](Strip& s) { s.ceilingDb = ceiling_.getValue(); });
    });
    output_.setTitle("Output of " + label);
    output_.setJustificationType(juce::Justification::centred);
    output_.onChange = [this] {
        model_.change("Output of " + labelOf(model_.mix(), index_),
                      [this](Mix& mix) { assignOutput(mix.strips, index_, output_.getSelectedId() - 2); });
    };
    group_ = makeLinkButton("group", "Group of " + label, [this] { showGroupMenu(model_, index_, *group_); });
    test_ = makeLinkButton(juce::String::fromUTF8("Test \xe2\x96\xb8"), "Test pulse on " + label);
    test_->setTooltip("A pulse at the actuator's resonance (T)");
    test_->onClick = [this] { model_.eventPlayer().testPulse(static_cast<int>(index_)); };
    sweep_.getProperties().set(quietProperty, true);
    sweep_.setTooltip("A sweep from 40 to 400 Hz (Shift+T)");
    sweep_.onClick = [this] { model_.eventPlayer().testSweep(static_cast<int>(index_)); };
    addAll(*this, {&output_, group_.get(), test_.get(), &sweep_});
    mixChanged();
}

void StripView::change(const juce::String& name, bool continuesEdit,
                       const std::function<void(Strip&)>& modify) {
    if (!isValid()) return; // the strip was removed; its view follows
    model_.change(name + " of " + labelOf(model_.mix(), index_), continuesEdit,
                  [&](Mix& mix) { modify(mix.strips[index_]); });
}

void StripView::fillOutputs() {
    output_.clear(dontNotify);
    output_.addItem("none", 1);
    std::vector<juce::String> names;
    const DeviceChoice& choice = model_.device().choice();
    for (int k = 0; k < model_.device().outputCount(); ++k) names.push_back(utf8(choice.outputName(k)));
    const Mix& mix = model_.mix();
    for (std::size_t j = 0; j < mix.strips.size(); ++j) // a choice exchanges the outputs of both actuators
        if (const auto k = static_cast<std::size_t>(mix.strips[j].output);
            j != index_ && mix.strips[j].output >= 0 && k < names.size())
            names[k] += " of " + labelOf(mix, j);
    const int output = strip().output;
    hasOutput_ = model_.output().hasOutput(static_cast<int>(index_));
    const juce::String absent = hasOutput_ ? "" : " (not there)";
    const auto reserved = choice.reservedOutputs();
    for (int k = 0; const auto& name : names) {
        const bool isInUse = std::ranges::find(reserved, k) != reserved.end();
        const juce::String suffix = !isInUse ? "" : k == choice.markerOutput ? " (triggers)" : " (monitor)";
        output_.addItem(name + (k == output ? absent : suffix), k + 2);
        output_.setItemEnabled(k++ + 2, !isInUse);
    }
    if (output >= model_.device().outputCount())
        output_.addItem(utf8(choice.outputName(output)) + absent, output + 2);
    output_.setSelectedId(strip().output + 2, dontNotify);
}

void StripView::mixChanged() {
    const Strip& s = strip();
    show(s, stripCeilingG(model_, index_));
    const auto& profile = model_.mix().layout.actuators[index_].actuator;
    group_->setButtonText(s.group < 0 ? juce::String{"group"} : utf8(nth(model_.mix().groups, s.group).name));
    group_->setTooltip("Strips of a group share a fader and a mute (G). Actuator: " +
                       (profile == "none" ? juce::String{"no profile"} : utf8(profile)));
    fillOutputs();
}

void StripView::refresh(const MixerSnapshot& snapshot) {
    if (!isValid()) return;
    if (strip().output >= 0 && hasOutput_ != model_.output().hasOutput(static_cast<int>(index_)))
        fillOutputs();
    meter_.set(snapshot.meters.peaks[index_], snapshot.heldPeaks[index_]);
    level_.setText(gText(model_.isSilent() ? 0.0 : stripLevelG(model_, index_, snapshot.heldPeaks[index_])),
                   dontNotify);
}

bool StripView::keyPressed(const juce::KeyPress& key) {
    if (!isValid()) return false;
    if (key == juce::KeyPress{'t'}) return model_.eventPlayer().testPulse(static_cast<int>(index_)), true;
    if (key == juce::KeyPress{'t', juce::ModifierKeys::shiftModifier, 0})
        return model_.eventPlayer().testSweep(static_cast<int>(index_)), true;
    if (key == juce::KeyPress{'g'}) return showGroupMenu(model_, index_, *group_), true;
    return false;
}

void StripView::mouseDown(const juce::MouseEvent& e) {
    if (e.mods.isPopupMenu() && isValid()) showGroupMenu(model_, index_, *group_);
}

void StripView::paint(juce::Graphics& g) {
    if (!isValid()) return;
    StripParts::paint(g, static_cast<int>(index_), labelOf(model_.mix(), index_),
                      !model_.device().isPlayed(index_)                 ? "no output"
                      : model_.mix().strips[index_].isMuted             ? "muted"
                      : model_.mix().isSilent(static_cast<int>(index_)) ? "not soloed"
                                                                        : "");
}

void StripView::setDropping(bool isDropping) {
    isDropping_ = isDropping;
    repaint();
}

void StripView::filesDropped(const juce::StringArray& files, int, int) {
    setDropping(false);
    model_.eventPlayer().playClipOn(files, static_cast<int>(index_));
}

void StripView::paintOverChildren(juce::Graphics& g) {
    if (!isDropping_) return;
    const auto area = getLocalBounds().toFloat().reduced(1.0f);
    fillRound(g, *this, Shade::accent, area, 6.0f, 0.14f);
    g.setColour(shade(*this, Shade::accent));
    g.drawRoundedRectangle(area, 6.0f, 2.0f);
}

void StripView::resized() {
    group_->setBounds(getLocalBounds().withTrimmedTop(24).removeFromTop(17));
    auto area = getLocalBounds().withTrimmedTop(MasterStrip::metersTop);
    auto row = area.removeFromBottom(20).reduced(2, 0);
    test_->setBounds(row.removeFromLeft(row.getWidth() * 6 / 10));
    sweep_.setBounds(row);
    output_.setBounds(area.removeFromBottom(24).reduced(2, 1));
    place(area, std::max(0, (getWidth() - fullWidth) / 2), getWidth() >= roomyWidth);
}

void StripsPanel::AttachPlace::paintButton(juce::Graphics& g, bool isOver, bool) {
    const auto area = getLocalBounds().toFloat().reduced(1.0f);
    juce::Path outline, dashed;
    outline.addRoundedRectangle(area, 6.0f);
    constexpr float dashes[]{5.0f, 5.0f};
    juce::PathStrokeType{1.2f}.createDashedStroke(dashed, outline, dashes, 2);
    g.setColour(shade(*this, isOver ? Shade::accent : Shade::line));
    g.fillPath(dashed);
    setInk(g, *this, isOver ? Shade::accent : Shade::muted, text::large);
    g.drawText("+", area.withTrimmedBottom(24.0f), juce::Justification::centred, false);
    g.setFont(text::font(text::small));
    g.drawText("attach", area.withTrimmedTop(24.0f), juce::Justification::centred, false);
}

StripsPanel::StripsPanel(MixerModel& model)
    : model_{model}
    , master_{model} {
    setTitle("Mixer");
    viewport_.setViewedComponent(&row_, false);
    viewport_.setScrollBarsShown(false, true);
    viewport_.setScrollBarThickness(8);
    addAndMakeVisible(viewport_);
    addAndMakeVisible(master_);
    row_.addAndMakeVisible(attach_);
    mixChanged();
}

void StripsPanel::mixChanged() {
    juce::StringArray labels, names;
    for (const auto& e : model_.mix().layout.actuators) labels.add(utf8(e.label));
    for (const auto& group : model_.mix().groups) names.add(utf8(group.name));
    const bool haveStripsChanged = labels != labels_, haveGroupsChanged = names != groupNames_;
    labels_ = labels;
    groupNames_ = names;
    const auto rebuild = [this](auto& views, int count) {
        using View = typename std::decay_t<decltype(views)>::value_type::element_type;
        views.clear();
        for (int k = 0; k < count; ++k)
            row_.addAndMakeVisible(*views.emplace_back(std::make_unique<View>(model_, k)));
        for (auto& view : views) prepareControls(*view); // colours depend on the parent component
    };
    if (haveStripsChanged) {
        rebuild(strips_, model_.mix().count());
        for (auto& group : groups_) group->toFront(false);
    }
    if (haveGroupsChanged) rebuild(groups_, names.size());
    for (auto& strip : strips_) strip->mixChanged();
    for (auto& group : groups_) group->mixChanged();
    if (haveStripsChanged || haveGroupsChanged) {
        attach_.toFront(false); // last in Tab order
        resized();
    }
    attach_.setVisible(model_.mix().count() < limits::maxActuators);
    master_.mixChanged();
}

void StripsPanel::refresh(const MixerSnapshot& snapshot) {
    for (auto& strip : strips_) strip->refresh(snapshot);
    master_.refresh(snapshot);
}

void StripsPanel::focusOfChildComponentChanged(FocusChangeType) {
    auto* focused = getCurrentlyFocusedComponent();
    if (focused == nullptr || !row_.isParentOf(focused)) return;
    const auto area = row_.getLocalArea(focused, focused->getLocalBounds());
    if (!viewport_.getViewArea().contains(area))
        viewport_.setViewPosition(std::max(0, area.getCentreX() - viewport_.getViewWidth() / 2), 0);
}

// Scrolls by whole strips: one begins at the left edge, or, at the end of the row, one ends at the right.
void StripsPanel::Row::visibleAreaChanged(const juce::Rectangle<int>& area) {
    const int maxX = getViewedComponent() != nullptr ? getViewedComponent()->getWidth() - area.getWidth() : 0;
    const int snapX = stripPitch > 0 ? (area.getX() + stripPitch / 2) / stripPitch * stripPitch : area.getX();
    if (snapX != area.getX() && area.getX() < maxX) setViewPosition(std::min(snapX, maxX), 0);
}

int StripsPanel::fixedWidth() const {
    return static_cast<int>(groups_.size()) * (GroupView::width + stripGap) + attachWidth;
}

int StripsPanel::widthFor(int width) const {
    return static_cast<int>(strips_.size()) * (width + stripGap) + fixedWidth() + MasterStrip::width + 8 +
           2 * panelInset;
}

void StripsPanel::showOutputs(int actuator) {
    if (actuator < 0 || actuator >= static_cast<int>(strips_.size())) return;
    auto& strip = *nth(strips_, actuator);
    viewport_.setViewPosition(std::max(0, strip.getX() - stripGap), 0);
    strip.showOutputs();
}

void StripsPanel::resized() {
    auto area = getLocalBounds().reduced(panelInset, 6);
    master_.setBounds(area.removeFromRight(MasterStrip::width));
    area.removeFromRight(8);
    viewport_.setBounds(area);
    const int strips = std::max(1, static_cast<int>(strips_.size())), room = area.getWidth() - fixedWidth(),
              width = juce::jlimit(StripView::width, StripView::maxWidth, room / strips - stripGap),
              needed = strips * (width + stripGap) + fixedWidth();
    if (needed > area.getWidth()) // shows whole strips
        viewport_.setSize(area.getWidth() / (width + stripGap) * (width + stripGap), area.getHeight());
    row_.setSize(std::max(needed, area.getWidth()), area.getHeight() - (needed > area.getWidth() ? 10 : 0));
    viewport_.stripPitch = width + stripGap;
    viewport_.setSingleStepSizes(width + stripGap, 0);
    auto places = row_.getLocalBounds();
    for (auto& strip : strips_)
        strip->setBounds(places.removeFromLeft(width)), places.removeFromLeft(stripGap);
    for (auto& group : groups_)
        group->setBounds(places.removeFromLeft(GroupView::width)), places.removeFromLeft(stripGap);
    attach_.setBounds(places.removeFromLeft(attachWidth).withTrimmedTop(2).withTrimmedBottom(2));
}

GroupView::GroupView(MixerModel& model, int group)
    : model_{model}
    , index_{static_cast<std::size_t>(group)} {
    const auto label = utf8(this->group().name);
    setTitle("Group " + label);
    describe(name_, "Name of " + label, "Double click, or Return: another name");
    name_.setFont(text::font(text::medium, juce::Font::bold));
    name_.setJustificationType(juce::Justification::centred);
    name_.setMinimumHorizontalScale(0.8f);
    name_.setBorderSize({0, 0, 0, 0});
    name_.setEditable(false, true);
    name_.setWantsKeyboardFocus(true);
    name_.onTextChange = [this] { rename(); };
    level_.setFont(text::font(text::small));
    level_.setJustificationType(juce::Justification::centred);
    level_.setTitle("Gain of the group " + label);
    fader_.configure(minStripDb, maxStripDb, "Gain of the group " + label);
    onSliderChange(fader_, [this](bool continuesEdit) {
        change("Gain", continuesEdit, [this](StripGroup& g) { g.gainDb = fader_.getValue(); });
    });
    describe(mute_, "Mute the group " + label, "Mute all of the group");
    mute_.getProperties().set(tintProperty, static_cast<juce::int64>(palette::limit.getARGB()));
    mute_.onClick = [this] { change("Mute", false, [](StripGroup& g) { g.isMuted = !g.isMuted; }); };
    remove_ = makeLinkButton("Ungroup", "Ungroup " + label);
    remove_->setTooltip("The strips take over what the group does to them");
    remove_->onClick = [this] {
        callLater(*this, [](GroupView& view) { // which is deleted with the group
            view.model_.change("Ungroup " + utf8(view.group().name),
                               [&](Mix& mix) { removeGroup(mix, static_cast<int>(view.index_)); });
        });
    };
    addAll(*this, {&name_, &level_, &fader_, &mute_, remove_.get()});
    mixChanged();
}

template <class Change>
void GroupView::change(const juce::String& name, bool continuesEdit, Change change) {
    model_.change(name + " of " + utf8(group().name), continuesEdit,
                  [&](Mix& mix) { change(mix.groups[index_]); });
}

void GroupView::rename() {
    const auto name = name_.getText().trim();
    const auto& groups = model_.mix().groups;
    const bool isFree = std::ranges::find(groups, name.toStdString(), &StripGroup::name) == groups.end();
    if (isFree && name.isNotEmpty() && name.getNumBytesAsUTF8() <= limits::maxNameBytes)
        change("Name", false, [&](StripGroup& g) { g.name = name.toStdString(); });
    else
        name_.setText(utf8(group().name), dontNotify);
}

void GroupView::mixChanged() {
    if (!name_.isBeingEdited()) name_.setText(utf8(group().name), dontNotify);
    if (!fader_.isMouseButtonDown()) fader_.setValue(group().gainDb, dontNotify);
    level_.setText(group().gainDb <= minStripDb ? juce::String{"silent"} : number(group().gainDb, 1) + " dB",
                   dontNotify);
    level_.setColour(juce::Label::textColourId, shade(*this, Shade::muted));
    mute_.setToggleState(group().isMuted, dontNotify);
    repaint();
}

bool GroupView::keyPressed(const juce::KeyPress& key) {
    if (key != juce::KeyPress::returnKey || !name_.hasKeyboardFocus(false)) return false;
    name_.showEditor();
    return true;
}

void GroupView::paint(juce::Graphics& g) {
    if (index_ >= model_.mix().groups.size()) return; // the group was removed; the view follows in a moment
    auto area = getLocalBounds();
    fillRound(g, *this, Shade::raised, area.toFloat(), 6.0f);
    drawFaderScale(g, fader_, getWidth());
    auto bar = area.removeFromTop(4).toFloat();
    std::vector<int> members;
    for (int j = 0; j < model_.mix().count(); ++j)
        if (nth(model_.mix().strips, j).group == static_cast<int>(index_)) members.push_back(j);
    if (members.empty()) g.setColour(shade(*this, Shade::line)), g.fillRoundedRectangle(bar, 2.0f);
    juce::StringArray labels;
    const float memberWidth = bar.getWidth() / static_cast<float>(std::max<std::size_t>(1, members.size()));
    for (const int j : members) {
        g.setColour(actuatorColour(*this, j).withMultipliedAlpha(model_.mix().isSilent(j) ? 0.35f : 1.0f));
        g.fillRoundedRectangle(bar.removeFromLeft(memberWidth).reduced(0.5f, 0.0f), 2.0f);
        labels.add(labelOf(model_.mix(), j));
    }
    setInk(g, *this, Shade::muted, text::small);
    g.drawText(members.empty() ? juce::String{"no strip yet"} : labels.joinIntoString(" "),
               getLocalBounds().withTrimmedTop(24).removeFromTop(17).reduced(4, 0),
               juce::Justification::centred, true);
}

void GroupView::resized() {
    auto area = getLocalBounds();
    name_.setBounds(area.withTrimmedTop(4).removeFromTop(20).reduced(3, 0));
    area.removeFromTop(MasterStrip::metersTop);
    remove_->setBounds(area.removeFromBottom(20).reduced(2, 0));
    mute_.setBounds(area.removeFromBottom(24).withSizeKeepingCentre(28, 24));
    level_.setBounds(area.removeFromBottom(18));
    area.removeFromBottom(8);
    fader_.setBounds(area.withSizeKeepingCentre(32, area.getHeight()).expanded(0, 8));
}

} // namespace physvib

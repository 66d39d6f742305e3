// SPDX-License-Identifier: GPL-3.0-or-later
// Controls of channel strips and their edits of the mixer state; their views come and go with the actuators.
#include "Mixer/Strips/StripsPanel.h"
#include "Core/Units.h"
#include "Host/Views/WorldView.h"
#include "Io/Disk/ReadFile.h"

namespace physvib {
namespace {

/// Of the groups that a strip may have, and a new one.
void showGroupMenu(MixerModel& model, std::size_t strip, juce::Component& from) {
    const auto& mix = model.mix();
    const auto label = labelOf(mix, strip);
    const auto put = [&model, strip, label](int group) {
        model.change("Group of " + label, [&](Mix& m) { m.strips[strip].group = group; });
    };
    juce::PopupMenu menu;
    menu.addSectionHeader("Group of " + label);
    menu.addItem("None", true, mix.strips[strip].group < 0, [put] { put(-1); });
    for (int k = 0; k < static_cast<int>(mix.groups.size()); ++k)
        menu.addItem(utf8(nth(mix.groups, k).name), true, mix.strips[strip].group == k, [put, k] { put(k); });
    menu.addSeparator();
    const auto fresh = freeGroupName(mix);
    menu.addItem("New: " + utf8(fresh), mix.groups.size() < mostGroups, false, [&model, strip, label, fresh] {
        model.change("Group of " + label, [&](Mix& m) { m.strips[strip].group = addGroup(m, fresh); });
    });
    menu.setLookAndFeel(&from.getLookAndFeel());
    menu.showMenuAsync(juce::PopupMenu::Options{}.withTargetComponent(from));
}

} // namespace

StripView::StripView(MixerModel& model, int strip)
    : StripParts{labelOf(model.mix(), strip)}
    , model_{model}
    , index_{static_cast<std::size_t>(strip)}
    , sweep_{Sign::sweep, "Sweep on " + labelOf(model.mix(), index_)} {
    const auto label = labelOf(model.mix(), index_);
    onSlide(fader_, [this](bool continuesEdit) {
        change(
            "Gain", [this](Strip& s) { s.gainDb = fader_.getValue(); }, continuesEdit);
    });
    ceiling_.textFromValueFunction = [this](double db) {
        return "at most " + number(db, 1) + " dB, " +
               inG(gOf(model_, index_, static_cast<float>(fromDecibels(db)))) + " g";
    };
    onSlide(ceiling_, [this](bool continuesEdit) {
        change(
            "Ceiling", [this](Strip& s) { s.ceilingDb = ceiling_.getValue(); }, continuesEdit);
    });
    output_.setTitle("Output of " + label);
    output_.setJustificationType(juce::Justification::centred);
    output_.onChange = [this] {
        model_.change("Output of " + labelOf(model_.mix(), index_),
                      [this](Mix& mix) { giveOutput(mix.strips, index_, output_.getSelectedId() - 2); });
    };
    group_ = quietButton("group", "Group of " + label, [this] { showGroupMenu(model_, index_, *group_); });
    test_ = quietButton(juce::String::fromUTF8("Test \xe2\x96\xb8"), "Test pulse on " + label);
    test_->setTooltip("A pulse at the actuator's resonance (T)");
    test_->onClick = [this] { model_.strikes().testPulse(static_cast<int>(index_)); };
    sweep_.getProperties().set(quietProperty, true);
    sweep_.setTooltip("A sweep from 40 to 400 Hz (Shift+T)");
    sweep_.onClick = [this] { model_.strikes().testSweep(static_cast<int>(index_)); };
    addAll(*this, {&output_, group_.get(), test_.get(), &sweep_});
    mixChanged();
}

void StripView::change(const juce::String& name, const std::function<void(Strip&)>& how, bool continuesEdit) {
    if (!isThere()) return; // a press that came before the views followed
    model_.change(
        name + " of " + labelOf(model_.mix(), index_), [&](Mix& mix) { how(mix.strips[index_]); },
        continuesEdit);
}

void StripView::fillOutputs() {
    output_.clear(quietly);
    output_.addItem("none", 1);
    std::vector<juce::String> names;
    const DeviceChoice& choice = model_.device().choice();
    for (int k = 0; k < model_.device().outputs(); ++k) names.push_back(utf8(choice.nameOf(k)));
    const Mix& mix = model_.mix();
    for (std::size_t j = 0; j < mix.strips.size(); ++j) // who would be exchanged
        if (const auto k = static_cast<std::size_t>(mix.strips[j].output);
            j != index_ && mix.strips[j].output >= 0 && k < names.size())
            names[k] += " of " + labelOf(mix, j);
    const int own = strip().output;
    isPlaced_ = model_.output().isPlaced(static_cast<int>(index_));
    const juce::String gone = isPlaced_ ? "" : " (not there)";
    const auto inUse = choice.inUse();
    for (int k = 0; const auto& name : names) {
        const bool isInUse = std::ranges::find(inUse, k) != inUse.end();
        const juce::String by = !isInUse ? "" : k == choice.marker ? " (triggers)" : " (monitor)";
        output_.addItem(name + (k == own ? gone : by), k + 2);
        output_.setItemEnabled(k++ + 2, !isInUse);
    }
    if (own >= model_.device().outputs()) output_.addItem(utf8(choice.nameOf(own)) + gone, own + 2);
    output_.setSelectedId(strip().output + 2, quietly);
}

void StripView::mixChanged() {
    const Strip& s = strip();
    show(s, maxG(model_, index_));
    const auto& profile = model_.mix().layout.enchanters[index_].actuator;
    group_->setButtonText(s.group < 0 ? juce::String{"group"} : utf8(nth(model_.mix().groups, s.group).name));
    group_->setTooltip("Strips of a group share a fader and a mute (G). Actuator: " +
                       (profile == "none" ? juce::String{"no profile"} : utf8(profile)));
    fillOutputs();
}

void StripView::refresh(const MixerMoment& moment) {
    if (!isThere()) return;
    if (strip().output >= 0 && isPlaced_ != model_.output().isPlaced(static_cast<int>(index_))) fillOutputs();
    meter_.set(moment.meters.peaks[index_], moment.holds[index_]);
    level_.setText(inG(model_.isSilent() ? 0.0 : gOf(model_, index_, moment.holds[index_])), quietly);
}

bool StripView::keyPressed(const juce::KeyPress& key) {
    if (!isThere()) return false;
    if (key == juce::KeyPress{'t'}) return model_.strikes().testPulse(static_cast<int>(index_)), true;
    if (key == juce::KeyPress{'t', juce::ModifierKeys::shiftModifier, 0})
        return model_.strikes().testSweep(static_cast<int>(index_)), true;
    if (key == juce::KeyPress{'g'}) return showGroupMenu(model_, index_, *group_), true;
    return false;
}

void StripView::mouseDown(const juce::MouseEvent& e) {
    if (e.mods.isPopupMenu() && isThere()) showGroupMenu(model_, index_, *group_);
}

void StripView::paint(juce::Graphics& g) {
    if (!isThere()) return;
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
    model_.strikes().feelOn(files, static_cast<int>(index_));
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
    place(area, std::max(0, (getWidth() - wholeWidth) / 2), getWidth() >= easyWidth);
}

void StripsPanel::AttachPlace::paintButton(juce::Graphics& g, bool isOver, bool) {
    const auto area = getLocalBounds().toFloat().reduced(1.0f);
    juce::Path outline, dashed;
    outline.addRoundedRectangle(area, 6.0f);
    constexpr float dashes[]{5.0f, 5.0f};
    juce::PathStrokeType{1.2f}.createDashedStroke(dashed, outline, dashes, 2);
    g.setColour(shade(*this, isOver ? Shade::accent : Shade::line));
    g.fillPath(dashed);
    ink(g, *this, isOver ? Shade::accent : Shade::muted, text::large);
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
    for (const auto& e : model_.mix().layout.enchanters) labels.add(utf8(e.label));
    for (const auto& group : model_.mix().groups) names.add(utf8(group.name));
    const bool areOther = labels != labels_, areOtherGroups = names != groupNames_;
    labels_ = labels;
    groupNames_ = names;
    const auto make = [this](auto& views, int count) {
        using View = typename std::decay_t<decltype(views)>::value_type::element_type;
        views.clear();
        for (int k = 0; k < count; ++k)
            row_.addAndMakeVisible(*views.emplace_back(std::make_unique<View>(model_, k)));
        for (auto& view : views) prepareControls(*view); // colours depend on the parent component
    };
    if (areOther) {
        make(strips_, model_.mix().count());
        for (auto& group : groups_) group->toFront(false);
    }
    if (areOtherGroups) make(groups_, names.size());
    for (auto& strip : strips_) strip->mixChanged();
    for (auto& group : groups_) group->mixChanged();
    if (areOther || areOtherGroups) {
        attach_.toFront(false); // last in Tab order
        resized();
    }
    attach_.setVisible(model_.mix().count() < limits::maxEnchanters);
    master_.mixChanged();
}

void StripsPanel::refresh(const MixerMoment& moment) {
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

// Scrolls by whole strips: one begins at the left edge, or at the end of the row, one ends at the right.
void StripsPanel::Row::visibleAreaChanged(const juce::Rectangle<int>& area) {
    const int most = getViewedComponent() != nullptr ? getViewedComponent()->getWidth() - area.getWidth() : 0;
    const int whole = step > 0 ? (area.getX() + step / 2) / step * step : area.getX();
    if (whole != area.getX() && area.getX() < most) setViewPosition(std::min(whole, most), 0);
}

int StripsPanel::fixedWidth() const {
    return static_cast<int>(groups_.size()) * (GroupView::width + between) + attachWidth;
}

int StripsPanel::widthFor(int strip) const {
    return static_cast<int>(strips_.size()) * (strip + between) + fixedWidth() + MasterStrip::width + 8 +
           2 * panelInset;
}

void StripsPanel::showOutputs(int enchanter) {
    if (enchanter < 0 || enchanter >= static_cast<int>(strips_.size())) return;
    auto& strip = *nth(strips_, enchanter);
    viewport_.setViewPosition(std::max(0, strip.getX() - between), 0);
    strip.showOutputs();
}

void StripsPanel::resized() {
    auto area = getLocalBounds().reduced(panelInset, 6);
    master_.setBounds(area.removeFromRight(MasterStrip::width));
    area.removeFromRight(8);
    viewport_.setBounds(area);
    const int strips = std::max(1, static_cast<int>(strips_.size())), rest = area.getWidth() - fixedWidth(),
              width = juce::jlimit(StripView::width, StripView::mostWidth, rest / strips - between),
              needed = strips * (width + between) + fixedWidth();
    if (needed > area.getWidth()) // whole ones in sight
        viewport_.setSize(area.getWidth() / (width + between) * (width + between), area.getHeight());
    row_.setSize(std::max(needed, area.getWidth()), area.getHeight() - (needed > area.getWidth() ? 10 : 0));
    viewport_.step = width + between;
    viewport_.setSingleStepSizes(width + between, 0);
    auto places = row_.getLocalBounds();
    for (auto& strip : strips_)
        strip->setBounds(places.removeFromLeft(width)), places.removeFromLeft(between);
    for (auto& group : groups_)
        group->setBounds(places.removeFromLeft(GroupView::width)), places.removeFromLeft(between);
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
    fader_.setUp(leastStripDb, mostStripDb, "Gain of the group " + label);
    onSlide(fader_, [this](bool continuesEdit) {
        change(
            "Gain", [this](StripGroup& g) { g.gainDb = fader_.getValue(); }, continuesEdit);
    });
    describe(mute_, "Mute the group " + label, "Mute all of the group");
    mute_.getProperties().set(tintProperty, static_cast<juce::int64>(palette::limit.getARGB()));
    mute_.onClick = [this] { change("Mute", [](StripGroup& g) { g.isMuted = !g.isMuted; }); };
    remove_ = quietButton("Ungroup", "Ungroup " + label);
    remove_->setTooltip("The strips take over what the group does to them");
    remove_->onClick = [this] {
        later(*this, [](GroupView& view) { // which is deleted with the group
            view.model_.change("Ungroup " + utf8(view.group().name),
                               [&](Mix& mix) { removeGroup(mix, static_cast<int>(view.index_)); });
        });
    };
    addAll(*this, {&name_, &level_, &fader_, &mute_, remove_.get()});
    mixChanged();
}

template <class Change>
void GroupView::change(const juce::String& name, Change change, bool continuesEdit) {
    model_.change(
        name + " of " + utf8(group().name), [&](Mix& mix) { change(mix.groups[index_]); }, continuesEdit);
}

void GroupView::rename() {
    const auto name = name_.getText().trim();
    const bool isFit = name.isNotEmpty() && name.getNumBytesAsUTF8() <= limits::maxNameBytes;
    if (isFit && name != utf8(group().name))
        change("Name", [&](StripGroup& g) { g.name = name.toStdString(); });
    else
        name_.setText(utf8(group().name), quietly);
}

void GroupView::mixChanged() {
    if (!name_.isBeingEdited()) name_.setText(utf8(group().name), quietly);
    if (!fader_.isMouseButtonDown()) fader_.setValue(group().gainDb, quietly);
    level_.setText(
        group().gainDb <= leastStripDb ? juce::String{"silent"} : number(group().gainDb, 1) + " dB", quietly);
    level_.setColour(juce::Label::textColourId, shade(*this, Shade::muted));
    mute_.setToggleState(group().isMuted, quietly);
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
    drawScale(g, fader_, getWidth());
    auto bar = area.removeFromTop(4).toFloat();
    std::vector<int> members;
    for (int j = 0; j < model_.mix().count(); ++j)
        if (nth(model_.mix().strips, j).group == static_cast<int>(index_)) members.push_back(j);
    if (members.empty()) g.setColour(shade(*this, Shade::line)), g.fillRoundedRectangle(bar, 2.0f);
    juce::StringArray labels;
    const float each = bar.getWidth() / static_cast<float>(std::max<std::size_t>(1, members.size()));
    for (const int j : members) {
        g.setColour(enchanterColour(*this, j).withMultipliedAlpha(model_.mix().isSilent(j) ? 0.35f : 1.0f));
        g.fillRoundedRectangle(bar.removeFromLeft(each).reduced(0.5f, 0.0f), 2.0f);
        labels.add(labelOf(model_.mix(), j));
    }
    ink(g, *this, Shade::muted, text::small);
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

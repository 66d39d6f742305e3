// SPDX-License-Identifier: GPL-3.0-or-later
// Controls of channel strips and their edits of the mixer state.
#include "Mixer/Strips/StripView.h"
#include "Core/Units.h"
#include "Mixer/Strips/StripsPanel.h"
#include <cmath>

namespace physvib {

StripView::StripView(MixerModel& model, int strip)
    : StripParts{utf8(model.mix().layout.enchanters[static_cast<std::size_t>(strip)].label)}
    , model_{model}
    , index_{static_cast<std::size_t>(strip)}
    , sweep_{Sign::sweep, "Sweep on " + utf8(model.mix().layout.enchanters[index_].label)} {
    const auto label = utf8(model.mix().layout.enchanters[index_].label);
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
        model_.change("Output of " + utf8(model_.mix().layout.enchanters[index_].label),
                      [this](Mix& mix) { giveOutput(mix.strips, index_, output_.getSelectedId() - 2); });
    };
    group_ = quietButton("group", "Group of " + label);
    group_->onClick = [this] { showGroupMenu(model_, index_, *group_); };
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
    const auto label = utf8(model_.mix().layout.enchanters[index_].label);
    model_.change(
        name + " of " + label, [&](Mix& mix) { how(mix.strips[index_]); }, continuesEdit);
}

void StripView::fillOutputs() {
    output_.clear(juce::dontSendNotification);
    output_.addItem("none", 1);
    std::vector<juce::String> names;
    const DeviceChoice& choice = model_.device().choice();
    for (int k = 0; k < model_.device().outputs(); ++k) names.push_back(utf8(choice.nameOf(k)));
    const Mix& mix = model_.mix();
    for (std::size_t j = 0; j < mix.strips.size(); ++j) // who would be exchanged
        if (const auto k = static_cast<std::size_t>(mix.strips[j].output);
            j != index_ && mix.strips[j].output >= 0 && k < names.size())
            names[k] += " of " + utf8(mix.layout.enchanters[j].label);
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
    output_.setSelectedId(strip().output + 2, juce::dontSendNotification);
}

void StripView::mixChanged() {
    const Strip& s = strip();
    show(s, maxG(model_, index_));
    const auto& profile = model_.mix().layout.enchanters[index_].actuator;
    group_->setButtonText(s.group < 0 ? juce::String{"group"}
                                      : utf8(model_.mix().groups[static_cast<std::size_t>(s.group)].name));
    group_->setTooltip("Strips of a group share a fader and a mute (G). Actuator: " +
                       (profile == "none" ? juce::String{"no profile"} : utf8(profile)));
    fillOutputs();
}

void StripView::refresh(const MixerMoment& moment) {
    if (!isThere()) return;
    if (strip().output >= 0 && isPlaced_ != model_.output().isPlaced(static_cast<int>(index_))) fillOutputs();
    meter_.set(moment.meters.peaks[index_], moment.holds[index_]);
    level_.setText(inG(model_.isSilent() ? 0.0 : gOf(model_, index_, moment.holds[index_])),
                   juce::dontSendNotification);
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
    StripParts::paint(g, static_cast<int>(index_), utf8(model_.mix().layout.enchanters[index_].label),
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
    g.setColour(shade(*this, Shade::accent).withAlpha(0.14f));
    g.fillRoundedRectangle(area, 6.0f);
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

} // namespace physvib

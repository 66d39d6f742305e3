// SPDX-License-Identifier: GPL-3.0-or-later
// The master strip, which shows level, limiter and ceiling of the total output as a strip or in a row.
#include "Mixer/Widgets/MixerWidgets.h"

namespace physvib {

double stripLevelG(const MixerModel& model, std::size_t strip, float peak) {
    return peak * masterGain(model.mix()) * model.mix().layout.actuators[strip].fullScaleG;
}
double stripCeilingG(const MixerModel& model, std::size_t strip) {
    return stripLevelG(model, strip, channelCeiling(model.mix().strips[strip]));
}

MasterStrip::MasterStrip(MixerModel& model, bool isFlat)
    : model_{model}
    , isFlat_{isFlat} {
    setTitle(isFlat ? "Master in a row" : "Master");
    fader_.configure(minStripDb, 0.0, isFlat ? "Master gain, in a row" : "Master gain", defaultLevelDb);
    if (isFlat) fader_.setHorizontal();
    onSliderChange(fader_, [this](bool continuesEdit) {
        model_.change("Master gain", continuesEdit, [this](Mix& mix) { mix.levelDb = fader_.getValue(); });
    });
    if (!isFlat) addAll(*this, {&meter_, &limiter_});
    addAndMakeVisible(fader_);
    mixChanged();
}

void MasterStrip::mixChanged() {
    if (!fader_.isMouseButtonDown()) fader_.setValue(model_.mix().levelDb, dontNotify);
    repaint();
}

void MasterStrip::refresh(const MixerSnapshot& snapshot) {
    meter_.set(snapshot.masterPeak, snapshot.masterPeak);
    // a silenced output is not limited
    const bool isSilent = model_.isSilent();
    if (limiter_.set(isSilent ? 1.0f : snapshot.meters.limiterGain,
                     isSilent ? 1.0f : snapshot.meters.guardGain))
        repaint();
}

double MasterStrip::highestCeilingG() const {
    double maxG = 0.0;
    for (std::size_t j = 0; j < static_cast<std::size_t>(model_.mix().count()); ++j)
        maxG = std::max(maxG, stripCeilingG(model_, j));
    return maxG;
}

// While the limiter acts, its gain is shown instead of the ceiling.
void MasterStrip::paintFlat(juce::Graphics& g) const {
    const bool isLimiting = limiter_.isHolding();
    auto textArea = getLocalBounds().withRight(fader_.getX());
    setInk(g, *this, Shade::text, text::small, juce::Font::bold);
    g.drawText("Master " + number(model_.mix().levelDb, 1) + " dB", textArea.removeFromTop(getHeight() / 2),
               juce::Justification::centredLeft, false);
    setInk(g, *this,
           isLimiting              ? Shade::limit
           : warning_.isNotEmpty() ? Shade::highlight
                                   : Shade::muted,
           text::small);
    g.drawText(isLimiting              ? limiterLabel()
               : warning_.isNotEmpty() ? warning_
                                       : "at most " + gText(highestCeilingG()) + " g",
               textArea, juce::Justification::centredLeft, false);
}

void MasterStrip::paint(juce::Graphics& g) {
    if (isFlat_) return paintFlat(g);
    drawFaderScale(g, fader_, getWidth());
    setInk(g, *this, Shade::text, text::medium, juce::Font::bold);
    g.drawText("Master", getLocalBounds().withTrimmedTop(4).removeFromTop(20), juce::Justification::centred,
               false);
    setInk(g, *this, Shade::muted, text::small);
    g.drawText(number(model_.mix().levelDb, 1) + " dB", getLocalBounds().withTrimmedTop(24).removeFromTop(16),
               juce::Justification::centred, false);
    g.setColour(shade(*this, limiter_.isHolding() ? Shade::limit : Shade::muted));
    g.drawText(limiterLabel(), limiterArea_, juce::Justification::centred, false);
    g.setColour(shade(*this, Shade::muted));
    g.drawText("at most", ceilingNameArea_, juce::Justification::centred, false);
    setInk(g, *this, Shade::text, text::small, juce::Font::bold);
    g.drawText(gText(highestCeilingG()) + " g", ceilingArea_, juce::Justification::centred, false);
}

void MasterStrip::resized() {
    if (isFlat_) return fader_.setBounds(getLocalBounds().withTrimmedLeft(flatTextWidth));
    auto area = getLocalBounds().withTrimmedTop(metersTop);
    ceilingArea_ = area.removeFromBottom(20);
    ceilingNameArea_ = area.removeFromBottom(20);
    limiterArea_ = area.removeFromBottom(22);
    area.removeFromBottom(8);
    meter_.setBounds(area.withX(10).withWidth(14));
    limiter_.setBounds(area.withX(31).withWidth(8));
    fader_.setBounds(area.withX(34).withWidth(40).expanded(0, 8));
}

} // namespace physvib

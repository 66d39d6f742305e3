// SPDX-License-Identifier: GPL-3.0-or-later
// Level, limiter and ceiling of the total output, as a strip or in a row.
#include "Mixer/Widgets/Parts.h"

namespace physvib {

double gOf(const MixerModel& model, std::size_t strip, float peak) {
    return peak * masterGain(model.mix()) * model.mix().layout.enchanters[strip].fullScaleG;
}
double maxG(const MixerModel& model, std::size_t strip) {
    return gOf(model, strip, ceilingOf(model.mix().strips[strip]));
}

MasterStrip::MasterStrip(MixerModel& model, bool isFlat)
    : model_{model}
    , isFlat_{isFlat} {
    setTitle(isFlat ? "Master in a row" : "Master");
    fader_.setUp(leastStripDb, 0.0, isFlat ? "Master gain, in a row" : "Master gain", safeStartDecibels);
    if (isFlat) fader_.lieDown();
    onSlide(fader_, [this](bool continuesEdit) {
        model_.change(
            "Master gain", [this](Mix& mix) { mix.levelDb = fader_.getValue(); }, continuesEdit);
    });
    if (!isFlat) addAll(*this, {&meter_, &limiter_});
    addAndMakeVisible(fader_);
    mixChanged();
}

void MasterStrip::mixChanged() {
    if (!fader_.isMouseButtonDown()) fader_.setValue(model_.mix().levelDb, quietly);
    repaint();
}

void MasterStrip::refresh(const MixerMoment& moment) {
    meter_.set(moment.masterPeak, moment.masterPeak);
    // a silenced output is not limited
    const bool isSilent = model_.isSilent();
    if (limiter_.set(isSilent ? 1.0f : moment.meters.limiterGain, isSilent ? 1.0f : moment.meters.guardGain))
        repaint();
}

double MasterStrip::mostG() const {
    double most = 0.0;
    for (std::size_t j = 0; j < static_cast<std::size_t>(model_.mix().count()); ++j)
        most = std::max(most, maxG(model_, j));
    return most;
}

// While the limiter acts, its text replaces that of the ceiling.
void MasterStrip::paintFlat(juce::Graphics& g) const {
    const bool isHeld = limiter_.isHolding();
    auto words = getLocalBounds().withRight(fader_.getX());
    ink(g, *this, Shade::text, text::small, juce::Font::bold);
    g.drawText("Master " + number(model_.mix().levelDb, 1) + " dB", words.removeFromTop(getHeight() / 2),
               juce::Justification::centredLeft, false);
    ink(g, *this, isHeld ? Shade::limit : remark_.isNotEmpty() ? Shade::now : Shade::muted, text::small);
    g.drawText(isHeld                 ? limiterWords()
               : remark_.isNotEmpty() ? remark_
                                      : "at most " + inG(mostG()) + " g",
               words, juce::Justification::centredLeft, false);
}

void MasterStrip::paint(juce::Graphics& g) {
    if (isFlat_) return paintFlat(g);
    drawScale(g, fader_, getWidth());
    ink(g, *this, Shade::text, text::medium, juce::Font::bold);
    g.drawText("Master", getLocalBounds().withTrimmedTop(4).removeFromTop(20), juce::Justification::centred,
               false);
    ink(g, *this, Shade::muted, text::small);
    g.drawText(number(model_.mix().levelDb, 1) + " dB", getLocalBounds().withTrimmedTop(24).removeFromTop(16),
               juce::Justification::centred, false);
    g.setColour(shade(*this, limiter_.isHolding() ? Shade::limit : Shade::muted));
    g.drawText(limiterWords(), limiterText_, juce::Justification::centred, false);
    g.setColour(shade(*this, Shade::muted));
    g.drawText("at most", ceilingName_, juce::Justification::centred, false);
    ink(g, *this, Shade::text, text::small, juce::Font::bold);
    g.drawText(inG(mostG()) + " g", ceiling_, juce::Justification::centred, false);
}

void MasterStrip::resized() {
    if (isFlat_) return fader_.setBounds(getLocalBounds().withTrimmedLeft(flatWords));
    auto area = getLocalBounds().withTrimmedTop(metersTop);
    ceiling_ = area.removeFromBottom(20);
    ceilingName_ = area.removeFromBottom(20);
    limiterText_ = area.removeFromBottom(22);
    area.removeFromBottom(8);
    meter_.setBounds(area.withX(10).withWidth(14));
    limiter_.setBounds(area.withX(31).withWidth(8));
    fader_.setBounds(area.withX(34).withWidth(40).expanded(0, 8));
}

} // namespace physvib

// SPDX-License-Identifier: GPL-3.0-or-later
// Drawing of meters, faders and ceiling handles, on a common dB scale.
#include "Host/Views/StripParts.h"
#include <cmath>

namespace physvib {

namespace {
void fillMeter(juce::Graphics& g, const juce::Component& meter) {
    const auto bar = meter.getLocalBounds().toFloat();
    g.setColour(shade(meter, Shade::well));
    g.fillRoundedRectangle(bar, 3.0f);
    g.setColour(shade(meter, Shade::line));
    g.drawRoundedRectangle(bar.reduced(0.5f), 3.0f, 1.0f);
}
} // namespace

void Fader::configure(double minDb, double maxDb, const juce::String& title, double defaultDb) {
    setSliderStyle(LinearVertical);
    setSliderSnapsToMousePosition(false);
    setTextBoxStyle(NoTextBox, true, 0, 0);
    getProperties().set(faderProperty, true);
    setRange(minDb, maxDb, 0.1);
    setSkewFactorFromMidPoint(-15.0);
    setTitle(title);
    setDoubleClickReturnValue(true, defaultDb);
    textFromValueFunction = [](double db) {
        return db <= minStripDb ? juce::String{"silent"} : readable::numberString(db, 1) + " dB";
    };
    setPopupDisplayEnabled(true, true, nullptr);
    setWantsKeyboardFocus(true);
}

void Fader::resized() {
    juce::Slider::resized();
    const int margins = 2 * getLookAndFeel().getSliderThumbRadius(*this), // that JUCE keeps at the ends
        length = isHorizontal() ? getWidth() : getHeight();
    setMouseDragSensitivity(std::max(1, length - margins)); // the handle follows the pointer
}

void drawFaderScale(juce::Graphics& g, const Fader& fader, int right) {
    constexpr int figureWidth = 20, minSpacing = 10; // pixels
    const int x = fader.getBounds().getCentreX() + 4;
    const bool hasFigures = x + 12 + figureWidth <= right;
    g.setFont(text::font(11.0f));
    for (int last = -minSpacing; const int db : {6, 0, -6, -12, -24, -40}) {
        if (db > fader.getMaximum()) continue;
        const int y = fader.getY() + juce::roundToInt(fader.getPositionOfValue(db));
        g.setColour(shade(fader, db == 0 ? Shade::text : Shade::muted));
        g.fillRect(x, y, db == 0 ? 9 : 6, 1);
        if (!hasFigures || y - last < minSpacing) continue;
        last = y;
        g.drawText((db > 0 ? "+" : "") + readable::numberString(db, 0), x + 12, y - 7, figureWidth, 14,
                   juce::Justification::centredLeft, false);
    }
}

void PeakMeter::set(float peak, float hold) {
    const float height = meterHeight(peak), holdHeight = meterHeight(hold);
    if (std::abs(height - peak_) < 0.004f && std::abs(holdHeight - hold_) < 0.004f) return;
    peak_ = height;
    hold_ = holdHeight;
    setDescription(peak > 0.001f ? readable::numberString(juce::Decibels::gainToDecibels(peak), 0) + " dB"
                                 : juce::String{"silent"});
    repaint();
}

void PeakMeter::paint(juce::Graphics& g) {
    const auto bar = getLocalBounds().toFloat();
    fillMeter(g, *this);
    const auto green = palette::actuator(3);
    const auto lit = bar.withTrimmedTop(bar.getHeight() * (1.0f - peak_));
    if (lit.getHeight() > 0.5f) {
        juce::ColourGradient ramp{green.darker(0.7f), bar.getBottomLeft(), palette::limit, bar.getTopLeft(),
                                  false};
        ramp.addColour(0.6, green);
        ramp.addColour(0.85, palette::highlight);
        g.setGradientFill(ramp);
        g.fillRoundedRectangle(lit, 3.0f);
    }
    if (hold_ <= 0.0f) return;
    g.setColour(shade(*this, Shade::text));
    g.fillRect(bar.getX() - 1.0f, bar.getY() + bar.getHeight() * (1.0f - hold_), bar.getWidth() + 2.0f, 2.0f);
}

bool LimiterBar::set(float limiterGain, float guardGain) {
    const bool isGuard = guardGain < limiterGain;
    const float db = juce::Decibels::gainToDecibels(std::min(guardGain, limiterGain), -60.0f);
    if (std::abs(db - db_) < 0.05f && isGuard == isGuard_) return false;
    isGuard_ = isGuard, db_ = db;
    return repaint(), true;
}

void LimiterBar::paint(juce::Graphics& g) {
    const auto bar = getLocalBounds().toFloat();
    fillMeter(g, *this);
    if (!isHolding()) return;
    g.setColour(shade(*this, Shade::limit));
    g.fillRoundedRectangle(bar.withHeight(std::max(3.0f, std::min(1.0f, db_ / -20.0f) * bar.getHeight())),
                           3.0f);
}

static_assert(minCeilingDb == meterFloorDb, "the handle moves along the whole meter");

CeilingHandle::CeilingHandle(const juce::String& label) {
    setSliderStyle(LinearVertical);
    setTextBoxStyle(NoTextBox, true, 0, 0);
    setRange(minCeilingDb, 0.0, 0.5);
    setSliderSnapsToMousePosition(false);
    setScrollWheelEnabled(false);
    setDoubleClickReturnValue(false, 0.0);
    setPopupDisplayEnabled(true, true, nullptr);
    setMouseCursor(juce::MouseCursor::UpDownResizeCursor);
    setWantsKeyboardFocus(true);
    setTitle("Ceiling of " + label);
}

void CeilingHandle::placeOver(juce::Rectangle<int> meter) {
    const int thumb = getLookAndFeel().getSliderThumbRadius(*this); // JUCE keeps this margin at both ends
    setMouseDragSensitivity(std::max(1, meter.getHeight()));        // the mark follows the pointer
    setBounds(meter.withLeft(meter.getX() - markWidth).expanded(0, thumb));
}

void CeilingHandle::paint(juce::Graphics& g) {
    const auto y = getPositionOfValue(getValue());
    juce::Path mark;
    mark.addTriangle(0.0f, y - 5.0f, 0.0f, y + 5.0f, static_cast<float>(markWidth) - 2.0f, y);
    g.setColour(shade(*this, Shade::limit));
    g.fillPath(mark);
    g.fillRect(static_cast<float>(markWidth) - 1.0f, y - 0.75f,
               static_cast<float>(getWidth() - markWidth) + 1.0f, 1.5f);
}

StripParts::StripParts(const juce::String& label)
    : meter_{"Level of " + label}
    , ceiling_{label} {
    setTitle("Strip " + label);
    fader_.configure(minStripDb, maxStripDb, "Gain of " + label);
    const auto toggle = [&](juce::TextButton& button, const juce::String& name, juce::Colour tint,
                            bool Strip::*flag) {
        button.setTitle(name + " " + label);
        button.setTooltip(name);
        button.getProperties().set(tintProperty, static_cast<juce::int64>(tint.getARGB()));
        button.onClick = [this, flag, name] { change(name, [flag](Strip& s) { s.*flag = !(s.*flag); }); };
    };
    toggle(mute_, "Mute", palette::limit, &Strip::isMuted);
    toggle(solo_, "Solo", palette::highlight, &Strip::isSolo);
    toggle(polarity_, "Polarity", palette::actuator(4), &Strip::isInverted);
    delay_.setTitle("Delay of " + label);
    delay_.onClick = [this] { showDelayMenu(); };
    level_.setTitle("Level of " + label + " in g");
    level_.setFont(text::font(text::small, juce::Font::bold));
    level_.setJustificationType(juce::Justification::centredRight);
    level_.setBorderSize({0, 0, 0, 0});
    ceilingLabel_.setTitle("Ceiling of " + label + " in g");
    ceilingLabel_.setFont(text::font(text::small));
    ceilingLabel_.setBorderSize({0, 4, 0, 0});
    for (juce::Component* c : std::initializer_list<juce::Component*>{
             &mute_, &solo_, &polarity_, &meter_, &fader_, &ceiling_, &delay_, &level_, &ceilingLabel_})
        addAndMakeVisible(c);
}

void StripParts::show(const Strip& strip, double ceilingG) {
    constexpr auto quietly = juce::dontSendNotification;
    if (!fader_.isMouseButtonDown()) fader_.setValue(strip.gainDb, quietly);
    if (!ceiling_.isMouseButtonDown()) ceiling_.setValue(strip.ceilingDb, quietly);
    mute_.setToggleState(strip.isMuted, quietly);
    solo_.setToggleState(strip.isSolo, quietly);
    polarity_.setToggleState(strip.isInverted, quietly);
    delayMs_ = strip.delayMs;
    delay_.setButtonText(delayMs_ > 0.0 ? readable::numberString(delayMs_, delayMs_ < 1.0 ? 1 : 0)
                                        : juce::String{"ms"});
    delay_.setToggleState(delayMs_ > 0.0, quietly);
    delay_.setTooltip("Delay: " + readable::numberString(delayMs_, 1) + " ms");
    ceilingLabel_.setText("/ " + gText(ceilingG) + " g", quietly);
    ceilingLabel_.setTooltip("Ceiling: " + readable::numberString(strip.ceilingDb, 1) + " dB of full scale");
    ceilingLabel_.setColour(juce::Label::textColourId,
                            shade(*this, strip.ceilingDb < 0.0 ? Shade::text : Shade::muted));
    repaint();
}

void StripParts::showDelayMenu() {
    juce::PopupMenu menu;
    menu.addSectionHeader("Delay");
    for (const double ms : {0.0, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0})
        menu.addItem(readable::numberString(ms, ms == 0.5 ? 1 : 0) + " ms", true, delayMs_ == ms,
                     [this, ms] { change("Delay", [ms](Strip& s) { s.delayMs = ms; }); });
    menu.setLookAndFeel(&getLookAndFeel());
    menu.showMenuAsync(juce::PopupMenu::Options{}.withTargetComponent(delay_).withDeletionCheck(*this));
}

void StripParts::place(juce::Rectangle<int> area, int left, bool hasButtonColumn) {
    auto row = area.removeFromBottom(18);
    level_.setBounds(row.removeFromLeft(row.getWidth() * 42 / 100));
    ceilingLabel_.setBounds(row);
    row = area.removeFromBottom(hasButtonColumn ? 0 : 24);
    area.removeFromBottom(8);
    constexpr int column = 24, figuresEnd = 103;
    if (hasButtonColumn)
        row =
            area.withX(std::min(left + figuresEnd, getWidth() - column - 1)).withWidth(column).expanded(0, 8);
    const int buttonSize = (hasButtonColumn ? row.getHeight() : row.getWidth()) / 4;
    for (auto* button : {&mute_, &solo_, &polarity_, &delay_})
        button->setBounds(hasButtonColumn ? row.removeFromTop(buttonSize).reduced(0, 1)
                                          : row.removeFromLeft(buttonSize).reduced(1, 0));
    meter_.setBounds(area.withWidth(12).withX(left + 10));
    ceiling_.placeOver(meter_.getBounds());
    fader_.setBounds(area.withX(left + 47).withWidth(32).expanded(0, 8));
}

void StripParts::paint(juce::Graphics& g, int actuator, const juce::String& name, const juce::String& why) {
    const bool isQuiet = why.isNotEmpty();
    auto row = getLocalBounds();
    g.setColour(actuatorColour(*this, actuator).withMultipliedAlpha(isQuiet ? 0.35f : 1.0f));
    g.fillRoundedRectangle(row.removeFromTop(4).toFloat(), 2.0f);
    row = row.withTrimmedTop(4).removeFromTop(20);
    const auto bold = text::font(text::medium, juce::Font::bold), plain = text::font(text::small);
    const double gainDb = fader_.getValue();
    const auto gain = isQuiet ? why : gainDb == 0.0 ? juce::String{} : fader_.textFromValueFunction(gainDb);
    constexpr int spacing = 5;
    const int gainWidth = text::pixelWidth(plain, gain) + spacing, nameWidth = text::pixelWidth(bold, name);
    if (gain.isNotEmpty() && nameWidth + gainWidth <= row.getWidth()) {
        row = row.withSizeKeepingCentre(nameWidth + gainWidth, row.getHeight());
        g.setColour(shade(*this, Shade::muted));
        g.setFont(plain);
        g.drawText(gain, row.removeFromRight(gainWidth), juce::Justification::centredRight, false);
    }
    g.setColour(shade(*this, isQuiet ? Shade::muted : Shade::text));
    g.setFont(bold);
    g.drawText(name, row, juce::Justification::centred, true);
    drawFaderScale(g, fader_, mute_.getY() < fader_.getBottom() ? mute_.getX() : getWidth());
    g.setColour(shade(*this, Shade::muted));
    g.setFont(text::font(11.0f));
    const auto bar = meter_.getBounds().toFloat();
    for (const int db : {0, -20, -40, -60}) {
        const float y = bar.getY() + bar.getHeight() * static_cast<float>(db) / meterFloorDb;
        g.drawText(readable::numberString(db, 0),
                   juce::Rectangle{bar.getRight() + 4.0f, y - 7.0f, 24.0f, 14.0f},
                   juce::Justification::centredLeft, false);
    }
}

} // namespace physvib

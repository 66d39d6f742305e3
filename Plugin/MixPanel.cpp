// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the plug-in's mixer strips, and applies their changes to the state.
#include "MixPanel.h"
#include "Core/Units.h"
#include "EditorParts.h"
#include "Scene/ActuatorFile.h"

namespace physvib {

namespace {

constexpr int stripGap = 6, masterWidth = 84;
constexpr double holdMs = 1500.0;

juce::String inG(double g) { return number(g, g < 9.995 ? 2 : 1); }

void tinted(juce::TextButton& button, juce::Colour tint) {
    button.getProperties().set(tintProperty, static_cast<juce::int64>(tint.getARGB()));
}

} // namespace

MixStrip::MixStrip(const MixHands& hands, int strip, const juce::String& label)
    : hands_{hands}
    , index_{static_cast<std::size_t>(strip)}
    , label_{label}
    , meter_{"Level of " + label}
    , ceiling_{label} {
    setTitle("Strip " + label);
    fader_.setUp(leastStripDb, mostStripDb, "Gain of " + label);
    fader_.onValueChange = [this] { change([this](Strip& s) { s.gainDb = fader_.getValue(); }); };
    ceiling_.textFromValueFunction = [this](double db) {
        return "ceiling " + number(db, 1) + " dB, " + inG(fromDecibels(db) * enchanter_.fullScaleG) + " g";
    };
    ceiling_.onValueChange = [this] { change([this](Strip& s) { s.ceilingDb = ceiling_.getValue(); }); };
    const auto toggle = [&](juce::TextButton& button, const juce::String& name, juce::Colour tint,
                            bool Strip::*what) {
        button.setTitle(name + " " + label);
        button.setTooltip(name);
        tinted(button, tint);
        button.onClick = [this, what] { change([what](Strip& s) { s.*what = !(s.*what); }); };
    };
    toggle(mute_, "Mute", palette::limit, &Strip::isMuted);
    toggle(solo_, "Solo", palette::now, &Strip::isSolo);
    toggle(polarity_, "Polarity", palette::enchanter(4), &Strip::isInverted);
    delay_.setTitle("Delay of " + label);
    delay_.onClick = [this] { askDelay(); };
    actuator_.setTitle("Actuator of " + label);
    actuator_.setTooltip("This actuator's profile, and whether it is equalised");
    actuator_.getProperties().set(quietProperty, true);
    actuator_.onClick = [this] { askActuator(); };
    level_.setFont(text::font(text::small, juce::Font::bold));
    level_.setJustificationType(juce::Justification::centredRight);
    level_.setBorderSize({0, 0, 0, 0});
    most_.setFont(text::font(text::small));
    most_.setBorderSize({0, 4, 0, 0});
    for (juce::Component* c : std::initializer_list<juce::Component*>{
             &meter_, &fader_, &ceiling_, &mute_, &solo_, &polarity_, &delay_, &actuator_, &level_, &most_})
        addAndMakeVisible(c);
}

void MixStrip::change(const std::function<void(Strip&)>& how) {
    hands_.edit([this, &how](PluginState& state) {
        if (index_ < state.strips.size()) how(state.strips[index_]);
    });
}

void MixStrip::take(const PluginState& state) {
    strip_ = state.strips[index_];
    enchanter_ = state.layout.enchanters[index_];
    isSilent_ = isSilent(state.strips, index_);
    isEqualised_ = state.equalised[index_].isKnown();
    if (!fader_.isMouseButtonDown()) fader_.setValue(strip_.gainDb, juce::dontSendNotification);
    if (!ceiling_.isMouseButtonDown()) ceiling_.setValue(strip_.ceilingDb, juce::dontSendNotification);
    mute_.setToggleState(strip_.isMuted, juce::dontSendNotification);
    solo_.setToggleState(strip_.isSolo, juce::dontSendNotification);
    polarity_.setToggleState(strip_.isInverted, juce::dontSendNotification);
    delay_.setButtonText(strip_.delayMs > 0.0 ? number(strip_.delayMs, strip_.delayMs < 1.0 ? 1 : 0)
                                              : juce::String{"ms"});
    delay_.setToggleState(strip_.delayMs > 0.0, juce::dontSendNotification);
    delay_.setTooltip("Delay: " + number(strip_.delayMs, 1) + " ms");
    actuator_.setButtonText(
        (enchanter_.actuator == "none" ? juce::String{"no profile"} : words(enchanter_.actuator)) +
        (isEqualised_ ? " EQ" : ""));
    most_.setText("/ " + inG(ceilingOf(strip_) * enchanter_.fullScaleG) + " g", juce::dontSendNotification);
    most_.setColour(juce::Label::textColourId,
                    shade(*this, strip_.ceilingDb < 0.0 ? Shade::text : Shade::muted));
    repaint();
}

void MixStrip::update(float peak, bool isConnected) {
    const double now = juce::Time::getMillisecondCounterHiRes();
    if (peak >= hold_ || now > holdUntilMs_) hold_ = peak, holdUntilMs_ = now + holdMs;
    meter_.set(peak, hold_);
    level_.setText(isConnected ? inG(hold_ * enchanter_.fullScaleG)
                               : juce::String{juce::CharPointer_UTF8{"\xe2\x80\x93"}},
                   juce::dontSendNotification);
    if (isConnected == isConnected_) return;
    isConnected_ = isConnected;
    level_.setTooltip(isConnected ? juce::String{} : "The track has no channel for this actuator");
    repaint();
}

void MixStrip::askDelay() {
    juce::PopupMenu menu;
    menu.addSectionHeader("Delay");
    for (const double ms : {0.0, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0})
        menu.addItem(number(ms, ms < 1.0 && ms > 0.0 ? 1 : 0) + " ms", true, strip_.delayMs == ms,
                     [this, ms] { change([ms](Strip& s) { s.delayMs = ms; }); });
    menu.setLookAndFeel(&getLookAndFeel());
    menu.showMenuAsync(juce::PopupMenu::Options{}.withTargetComponent(delay_).withDeletionCheck(*this));
}

void MixStrip::askActuator() {
    juce::PopupMenu menu;
    menu.addSectionHeader("Actuator of " + label_);
    menu.addItem("no profile", true, enchanter_.actuator == "none", [this] { chooseActuator("none"); });
    for (const auto& profile : builtInActuators())
        menu.addItem(words(profile.name), true, enchanter_.actuator == profile.name,
                     [this, name = profile.name] { chooseActuator(name); });
    menu.addItem(juce::String::fromUTF8("Open a profile\xe2\x80\xa6"), [this] {
        chooser_ =
            std::make_unique<juce::FileChooser>("An actuator's profile", juce::File{}, "*.json", false);
        chooser_->launchAsync(juce::FileBrowserComponent::openMode |
                                  juce::FileBrowserComponent::canSelectFiles,
                              [this](const juce::FileChooser& chooser) {
                                  if (const auto file = chooser.getResult(); file != juce::File{})
                                      chooseActuator(file.getFullPathName().toStdString());
                              });
    });
    menu.addSeparator();
    const auto profile = findActuator(enchanter_.actuator);
    const bool canBe = isEqualised_ || (profile && equaliserFault(profile.value).empty());
    menu.addItem("Equalised: flat in its band", canBe, isEqualised_, [this] { equalise(!isEqualised_); });
    menu.setLookAndFeel(&getLookAndFeel());
    menu.showMenuAsync(juce::PopupMenu::Options{}.withTargetComponent(actuator_).withDeletionCheck(*this));
}

// Who was equalised stays so, if the other actuator can be.
void MixStrip::chooseActuator(const std::string& nameOrPath) {
    const auto profile =
        nameOrPath == "none" ? Result<ActuatorProfile>{ActuatorProfile{}} : findActuator(nameOrPath);
    if (!profile) return hands_.report(words(profile.error));
    const auto& p = profile.value;
    const bool canBe = !p.name.empty() && equaliserFault(p).empty();
    hands_.edit([&, j = index_](PluginState& state) {
        auto& enchanter = state.layout.enchanters[j];
        enchanter.actuator = p.name.empty() ? "none" : p.name;
        if (p.fullScaleG) enchanter.fullScaleG = *p.fullScaleG;
        if (state.equalised[j].isKnown())
            state.equalised[j] = canBe ? EqualisedActuator{p.resonator(), *p.band} : EqualisedActuator{};
    });
}

void MixStrip::equalise(bool on) {
    const auto profile = findActuator(enchanter_.actuator);
    if (on && (!profile || !equaliserFault(profile.value).empty())) return;
    hands_.edit([&, j = index_](PluginState& state) {
        state.equalised[j] =
            on ? EqualisedActuator{profile.value.resonator(), *profile.value.band} : EqualisedActuator{};
    });
}

void MixStrip::paint(juce::Graphics& g) {
    auto area = getLocalBounds();
    const bool isQuiet = isSilent_ || !isConnected_;
    g.setColour(enchanterColour(*this, static_cast<int>(index_)).withMultipliedAlpha(isQuiet ? 0.35f : 1.0f));
    g.fillRoundedRectangle(area.removeFromTop(4).toFloat(), 2.0f);
    g.setColour(shade(*this, isQuiet ? Shade::muted : Shade::text));
    g.setFont(text::font(text::medium, juce::Font::bold));
    g.drawText(label_, area.withTrimmedTop(4).removeFromTop(20), juce::Justification::centred, true);
    g.setColour(shade(*this, Shade::muted));
    g.setFont(text::font(text::small));
    for (const int db : {0, -20, -40, -60}) { // the meter's scale, right of the fader
        const auto y = static_cast<float>(meter_.getY()) +
                       static_cast<float>(meter_.getHeight()) * static_cast<float>(db) / meterFloorDb;
        g.drawText(number(db, 0),
                   juce::Rectangle<float>{static_cast<float>(getWidth()) - 27.0f, y - 7.0f, 26.0f, 14.0f},
                   juce::Justification::centredRight, false);
    }
}

void MixStrip::resized() {
    auto area = getLocalBounds().withTrimmedTop(28);
    actuator_.setBounds(area.removeFromTop(20));
    area.removeFromTop(10);
    auto row = area.removeFromBottom(22);
    level_.setBounds(row.removeFromLeft(row.getWidth() * 42 / 100));
    most_.setBounds(row);
    row = area.removeFromBottom(24);
    const int each = row.getWidth() / 4;
    for (auto* button : {&mute_, &solo_, &polarity_, &delay_})
        button->setBounds(row.removeFromLeft(each).reduced(1, 0));
    area.removeFromBottom(10);
    meter_.setBounds(area.withWidth(12).withX(10));
    ceiling_.placeOver(meter_.getBounds());
    fader_.setBounds(area.withX(24).withWidth(32).expanded(0, 8));
}

MixPanel::MixPanel(PluginProcessor& plugin, MixHands hands)
    : hands_{std::move(hands)}
    , levelAttachment_{(level_.setUp(leastStripDb, 0.0, "Level"), plugin.parameter(Parameter::level)),
                       level_} {
    setTitle("Mix");
    level_.setDoubleClickReturnValue(true, rowOf(Parameter::level).initial);
    viewport_.setViewedComponent(&row_, false);
    viewport_.setScrollBarsShown(false, true);
    viewport_.setScrollBarThickness(8);
    limiter_.setTitle("Limiter");
    limiter_.setTooltip(
        "One gain for all actuators: keeps each below its ceiling, and each impact at its place");
    limiter_.onClick = [this] { hands_.edit([](PluginState& s) { s.limiterEnabled = !s.limiterEnabled; }); };
    for (juce::Component* c : std::initializer_list<juce::Component*>{&viewport_, &level_, &limiter_})
        addAndMakeVisible(c);
}

void MixPanel::take(const PluginState& state) {
    juce::StringArray labels;
    for (const auto& e : state.layout.enchanters) labels.add(words(e.label));
    if (labels != labels_) {
        strips_.clear();
        for (int j = 0; j < labels.size(); ++j) {
            strips_.push_back(std::make_unique<MixStrip>(hands_, j, labels[j]));
            row_.addAndMakeVisible(*strips_.back());
        }
        labels_ = labels;
        resized();
    }
    for (auto& strip : strips_) strip->take(state);
    limiter_.setToggleState(state.limiterEnabled, juce::dontSendNotification);
}

void MixPanel::update(const ChannelMeters& meters) {
    for (std::size_t j = 0; j < strips_.size(); ++j)
        strips_[j]->update(meters.peaks[j], meters.isConnected[j] || meters.enchanters == 0);
    limiterGain_ = std::min(meters.limiterGain, meters.guardGain);
    isGuard_ = meters.guardGain < meters.limiterGain;
    repaint(levelName_.getUnion(limiterValue_));
}

int MixPanel::wishedWidth() const {
    return 2 * panelInset + static_cast<int>(strips_.size()) * (MixStrip::width + stripGap) + stripGap +
           masterWidth;
}

void MixPanel::paint(juce::Graphics& g) {
    fillPanel(g, *this, getLocalBounds());
    g.setColour(shade(*this, Shade::text));
    g.setFont(text::font(text::medium, juce::Font::bold));
    g.drawText("Level", levelName_, juce::Justification::centred, false);
    g.setFont(text::font(text::small));
    g.setColour(shade(*this, Shade::muted));
    g.drawText(level_.getTextFromValue(level_.getValue()), levelValue_, juce::Justification::centred, false);
    g.setColour(shade(*this, Shade::well));
    g.fillRoundedRectangle(limiterBar_.toFloat(), 3.0f);
    const float db = juce::Decibels::gainToDecibels(limiterGain_),
                reduction = juce::jlimit(0.0f, 1.0f, -db / 20.0f);
    const bool isLimiting = db < -0.05f;
    g.setColour(shade(*this, isLimiting ? Shade::limit : Shade::muted));
    if (isLimiting)
        g.fillRoundedRectangle(limiterBar_.toFloat().withHeight(
                                   std::max(3.0f, reduction * static_cast<float>(limiterBar_.getHeight()))),
                               3.0f);
    const juce::String value = number(isLimiting ? db : 0.0f, 1);
    g.drawText(isGuard_ ? "guard " + value : value + " dB", limiterValue_, juce::Justification::centred,
               false);
}

void MixPanel::resized() {
    auto area = getLocalBounds().reduced(panelInset, 10);
    auto master = area.removeFromRight(masterWidth);
    area.removeFromRight(stripGap);
    viewport_.setBounds(area);
    const int needed = static_cast<int>(strips_.size()) * (MixStrip::width + stripGap);
    row_.setSize(std::max(needed, area.getWidth()), area.getHeight() - (needed > area.getWidth() ? 10 : 0));
    auto places = row_.getLocalBounds();
    for (auto& strip : strips_)
        strip->setBounds(places.removeFromLeft(MixStrip::width)), places.removeFromLeft(stripGap);
    levelName_ = master.withTrimmedTop(8).removeFromTop(20);
    levelValue_ = master.withTrimmedTop(28).removeFromTop(20);
    master.removeFromTop(58);
    limiterValue_ = master.removeFromBottom(22);
    limiter_.setBounds(master.removeFromBottom(24).reduced(4, 0));
    master.removeFromBottom(10);
    limiterBar_ = master.withX(master.getX() + 14).withWidth(8);
    level_.setBounds(master.withX(master.getX() + 34).withWidth(40).expanded(0, 8));
}

} // namespace physvib

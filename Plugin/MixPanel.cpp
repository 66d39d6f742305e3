// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the plug-in's mixer strips, and applies their changes to the state.
#include "Core/Units.h"
#include "EditorPanels.h"
#include "EditorParts.h"

namespace physvib {

namespace {

constexpr int stripGap = 6, masterWidth = 84;
constexpr double peakHoldMs = 1500.0;

} // namespace

MixStrip::MixStrip(const EditorActions& actions, int strip, const juce::String& label)
    : StripParts{label}
    , actions_{actions}
    , index_{static_cast<std::size_t>(strip)}
    , label_{label} {
    fader_.onValueChange = [this] { change({}, [this](Strip& s) { s.gainDb = fader_.getValue(); }); };
    ceiling_.textFromValueFunction = [this](double db) {
        return "ceiling " + number(db, 1) + " dB, " + gText(fromDecibels(db) * details_.fullScaleG) + " g";
    };
    ceiling_.onValueChange = [this] { change({}, [this](Strip& s) { s.ceilingDb = ceiling_.getValue(); }); };
    actuator_.setTitle("Actuator of " + label);
    actuator_.setTooltip("This actuator's profile, and whether it is equalised");
    actuator_.getProperties().set(quietProperty, true);
    actuator_.onClick = [this] {
        makeActuatorMenu().showMenuAsync(
            juce::PopupMenu::Options{}.withTargetComponent(actuator_).withDeletionCheck(*this));
    };
    addAndMakeVisible(actuator_);
}

void MixStrip::change(const juce::String&, const std::function<void(Strip&)>& edit) {
    actions_.edit([this, &edit](PluginState& state) {
        if (index_ < state.strips.size()) edit(state.strips[index_]);
    });
}

void MixStrip::showState(const PluginState& state) {
    const auto& strip = state.strips[index_];
    details_ = state.layout.actuators[index_];
    isSilent_ = isSilent(state.strips, index_);
    isEqualised_ = state.equalised[index_].isKnown();
    show(strip, channelCeiling(strip) * details_.fullScaleG);
    actuator_.setButtonText(
        (details_.actuator == "none" ? juce::String{"no profile"} : fromUtf8(details_.actuator)) +
        (isEqualised_ ? " EQ" : ""));
}

void MixStrip::update(float peak, bool isConnected) {
    const double now = juce::Time::getMillisecondCounterHiRes();
    if (peak >= peakHold_ || now > holdUntilMs_) peakHold_ = peak, holdUntilMs_ = now + peakHoldMs;
    meter_.set(peak, peakHold_);
    level_.setText(isConnected ? gText(peakHold_ * details_.fullScaleG)
                               : juce::String{juce::CharPointer_UTF8{"\xe2\x80\x93"}},
                   juce::dontSendNotification);
    if (isConnected == isConnected_) return;
    isConnected_ = isConnected;
    level_.setTooltip(isConnected ? juce::String{} : "The track has no channel for this actuator");
    repaint();
}

juce::PopupMenu MixStrip::makeActuatorMenu() {
    juce::PopupMenu menu;
    menu.addSectionHeader("Actuator of " + label_);
    menu.addItem("no profile", true, details_.actuator == "none", [this] { chooseActuator("none"); });
    for (const auto& profile : builtInActuators())
        menu.addItem(fromUtf8(profile.name), true, details_.actuator == profile.name,
                     [this, name = profile.name] { chooseActuator(name); });
    menu.addItem(fromUtf8("Open a profile\xe2\x80\xa6"), [this] {
        chooseFile(chooser_, "An actuator's profile", openFlags,
                   [this](const juce::File& file) { chooseActuator(file.getFullPathName().toStdString()); });
    });
    menu.addSeparator();
    const auto found = profile();
    const bool canEqualise = isEqualised_ || (found && equaliserError(found.value).empty());
    menu.addItem("Equalised: flat in its band", canEqualise, isEqualised_,
                 [this] { equalise(!isEqualised_); });
    menu.setLookAndFeel(&getLookAndFeel());
    return menu;
}

// An equalised strip stays equalised if the new actuator's profile allows it.
void MixStrip::chooseActuator(const std::string& nameOrPath) {
    const auto profile =
        nameOrPath == "none" ? Result<ActuatorProfile>{ActuatorProfile{}} : findActuator(nameOrPath);
    if (!profile) return actions_.report(fromUtf8(profile.error));
    const auto& p = chosen_ = profile.value;
    const bool canEqualise = !p.name.empty() && equaliserError(p).empty();
    actions_.edit([&, j = index_](PluginState& state) {
        auto& details = state.layout.actuators[j];
        details.actuator = p.name.empty() ? "none" : p.name;
        if (p.fullScaleG) details.fullScaleG = *p.fullScaleG;
        if (state.equalised[j].isKnown())
            state.equalised[j] =
                canEqualise ? EqualisedActuator{p.resonator(), *p.band} : EqualisedActuator{};
    });
}

Result<ActuatorProfile> MixStrip::profile() const {
    return chosen_.name == details_.actuator ? chosen_ : findActuator(details_.actuator);
}

void MixStrip::equalise(bool on) {
    const auto found = profile();
    if (on && (!found || !equaliserError(found.value).empty())) return;
    actions_.edit([&, j = index_](PluginState& state) {
        state.equalised[j] =
            on ? EqualisedActuator{found.value.resonator(), *found.value.band} : EqualisedActuator{};
    });
}

void MixStrip::paint(juce::Graphics& g) {
    StripParts::paint(g, static_cast<int>(index_), label_,
                      !isConnected_ ? "no output"
                      : isSilent_   ? "muted"
                                    : "");
}

void MixStrip::resized() {
    auto area = getLocalBounds().withTrimmedTop(28);
    actuator_.setBounds(area.removeFromTop(20));
    place(area.withTrimmedTop(10), 0);
}

MixPanel::MixPanel(PluginProcessor& plugin, EditorActions actions)
    : actions_{std::move(actions)}
    , levelAttachment_{(level_.configure(minStripDb, 0.0, "Level"), plugin.parameter(Parameter::level)),
                       level_} {
    setTitle("Mix");
    level_.setDoubleClickReturnValue(true, rowOf(Parameter::level).initial);
    level_.setTooltip(fromUtf8(rowOf(Parameter::level).help));
    level_.addMouseListener(this, false);
    viewport_.setViewedComponent(&row_, false);
    viewport_.setScrollBarsShown(false, true);
    viewport_.setScrollBarThickness(8);
    limiter_.setTitle("Limiter");
    limiter_.setTooltip(
        "One gain for all actuators: keeps each below its ceiling, and each impact at its place");
    limiter_.onClick = [this] {
        actions_.edit([](PluginState& s) { s.limiterEnabled = !s.limiterEnabled; });
    };
    for (juce::Component* c :
         std::initializer_list<juce::Component*>{&viewport_, &level_, &limiter_, &limiterBar_})
        addAndMakeVisible(c);
}

void MixPanel::showState(const PluginState& state) {
    juce::StringArray labels;
    for (const auto& e : state.layout.actuators) labels.add(fromUtf8(e.label));
    if (labels != labels_) {
        strips_.clear();
        for (int j = 0; j < labels.size(); ++j) {
            strips_.push_back(std::make_unique<MixStrip>(actions_, j, labels[j]));
            row_.addAndMakeVisible(*strips_.back());
        }
        labels_ = labels;
        resized();
    }
    for (auto& strip : strips_) strip->showState(state);
    limiter_.setToggleState(state.limiterEnabled, juce::dontSendNotification);
}

void MixPanel::update(const ChannelMeters& meters) {
    for (std::size_t j = 0; j < strips_.size(); ++j)
        strips_[j]->update(meters.peaks[j], meters.isConnected[j] || meters.actuatorCount == 0);
    limiterBar_.set(meters.limiterGain, meters.guardGain);
    repaint(levelName_.getUnion(limiterValue_));
}

int MixPanel::preferredWidth() const {
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
    g.setColour(shade(*this, limiterBar_.isHolding() ? Shade::limit : Shade::muted));
    g.drawText(limiterBar_.isGuard() ? "guard " + limiterBar_.decibels() : limiterBar_.decibels() + " dB",
               limiterValue_, juce::Justification::centred, false);
}

void MixPanel::resized() {
    auto area = getLocalBounds().reduced(panelInset, 10);
    auto master = area.removeFromRight(masterWidth);
    area.removeFromRight(stripGap);
    viewport_.setBounds(area);
    const int stripsWidth = static_cast<int>(strips_.size()) * (MixStrip::width + stripGap);
    if (stripsWidth > area.getWidth()) area.removeFromBottom(10), master.removeFromBottom(10); // scroll bar's
    row_.setSize(std::max(stripsWidth, area.getWidth()), area.getHeight());
    auto places = row_.getLocalBounds();
    for (auto& strip : strips_)
        strip->setBounds(places.removeFromLeft(MixStrip::width)), places.removeFromLeft(stripGap);
    levelName_ = master.withTrimmedTop(8).removeFromTop(20);
    levelValue_ = master.withTrimmedTop(28).removeFromTop(20);
    master.removeFromTop(58);
    limiterValue_ = master.removeFromBottom(22);
    limiter_.setBounds(master.removeFromBottom(24).reduced(4, 0));
    master.removeFromBottom(8);
    limiterBar_.setBounds(master.withX(master.getX() + 14).withWidth(8));
    level_.setBounds(master.withX(master.getX() + 34).withWidth(40).expanded(0, 8));
}

} // namespace physvib

// SPDX-License-Identifier: GPL-3.0-or-later
// Lists the choices of devices and sinks, and tests each actuator with pulses. Levels start low, because
// people may be holding the actuators.
#include "Mixer/Window/FirstStart.h"
#include "Live/Devices/AudioDevice.h"

namespace physvib {
namespace {

constexpr int maxRows = 6, rowGap = 5, fieldHeight = 200;
constexpr int readyCheckMs = 100,
              maxReadyChecks = 50; // 5 s: boards need half a second, Bluetooth needs one

/// Whether the system's name of a device is that of headphones.
bool isHeadphoneName(const std::string& device) {
    const auto name = juce::String::fromUTF8(device.c_str()).toLowerCase();
    for (const char* word : {"headphone", "headset", "earphone", "earbud", "airpods", "kopfh", "casque"})
        if (name.contains(word)) return true;
    return false;
}

/// A row of a list of choices, with a radio button.
class Row final : public juce::Button {
public:
    explicit Row(const juce::String& label)
        : juce::Button{label} {
        setTitle(label);
    }
    void paintButton(juce::Graphics& g, bool isOver, bool) override {
        auto area = getLocalBounds();
        const bool isChosen = getToggleState();
        fillRound(g, *this, Shade::accent, area.toFloat(), 6.0f, isChosen ? 0.2f : isOver ? 0.08f : 0.0f);
        const auto ring = area.removeFromLeft(40).toFloat().withSizeKeepingCentre(14.0f, 14.0f);
        g.setColour(shade(*this, isChosen ? Shade::accent : Shade::muted));
        g.drawEllipse(ring, 1.5f);
        if (isChosen) g.fillEllipse(ring.reduced(3.5f));
        setInk(g, *this, Shade::text, text::medium);
        g.drawText(getName(), area, juce::Justification::centredLeft, true);
    }
};

} // namespace

std::vector<DetectedSink> detectSinks() {
    std::vector<DetectedSink> sinks;
    for (const SinkKind& kind : sinkKinds())
        for (SinkUnit& unit : kind.listUnits())
            if (unit.isLikely) sinks.push_back({&kind, std::move(unit)});
    return sinks;
}

std::vector<PlaybackChoice> playbackChoices(const AudioDrivers& drivers,
                                            const std::vector<DetectedSink>& sinks) {
    const auto devices = sortedByLikelihood(listAudioDevices(drivers));
    std::vector<PlaybackChoice> mainChoices, stereoChoices, choices;
    for (const auto& device : devices) {
        const int outputs = hardwareOutputCount(device);
        if (device.type == nullDeviceType || outputs < 1) continue; // it could play nothing
        PlaybackChoice choice{utf8(device.type + ":" + device.name) + ", " + countText(outputs, "output") +
                                  (outputs == 2 ? ": two actuators" : ""),
                              {device.type + ":" + device.name},
                              outputs};
        (outputs > 2 ? mainChoices : stereoChoices).push_back(std::move(choice));
    }
    // the best sound device for headphones: one that is named so, else the first
    std::optional<PlaybackChoice> headphones;
    if (const auto& candidates = stereoChoices.empty() ? mainChoices : stereoChoices; !candidates.empty()) {
        const auto namedHeadphones = std::ranges::find_if(candidates, [](const PlaybackChoice& c) {
            return isHeadphoneName(c.device.name) && c.outputs >= 2;
        });
        headphones = namedHeadphones != candidates.end() ? *namedHeadphones : candidates.front();
    }
    const bool hasNamedHeadphones = headphones && isHeadphoneName(headphones->device.name);
    // multichannel devices, preferred sinks and devices named as headphones come before the other sinks
    const auto multichannelCount = std::ssize(mainChoices);
    std::ptrdiff_t preferredCount = 0;
    for (const auto& [kind, unit] : sinks) { // a sink alone, without a sound device
        PlaybackChoice choice{utf8(std::string{kind->title} + ": " + unit.address) +
                                  (unit.label.empty() ? juce::String{} : "  " + utf8(unit.label)),
                              {std::string{nullDeviceType} + ":" + nullDeviceName},
                              kind->actuators,
                              true};
        choice.device.setSink(*kind, unit.address);
        mainChoices.insert(kind->isPreferred ? mainChoices.begin() : mainChoices.end(), std::move(choice));
        preferredCount += kind->isPreferred ? 1 : 0;
    }
    if (headphones && headphones->outputs >= 2) {
        headphones->title = "Headphones: " + utf8(headphones->device.name);
        headphones->isHeadphones = true;
        const auto index = hasNamedHeadphones ? multichannelCount + preferredCount : std::ssize(mainChoices);
        mainChoices.insert(mainChoices.begin() + std::min<std::ptrdiff_t>(index, maxRows - 1), *headphones);
    }
    choices = std::move(mainChoices);
    choices.insert(choices.end(), stereoChoices.begin(), stereoChoices.end());
    choices.push_back({noDeviceTitle, {std::string{nullDeviceType} + ":" + nullDeviceName}, 0});
    return choices;
}

FirstStart::FirstStart(MixerModel& model, std::vector<PlaybackChoice> choices)
    : Card{cardWidth}
    , model_{model}
    , choices_{std::move(choices)} {
    for (int i = 0; i < std::min(maxRows, static_cast<int>(choices_.size())); ++i) {
        auto& row = *rows_.emplace_back(std::make_unique<Row>(
            nth(choices_, i).title + (i == 0 && choices_.size() > 1 ? "  (likely)" : "")));
        row.onClick = [this, i] { choose(i); };
        addChildComponent(row);
    }
    playButton_.onClick = [this] { openChosen(); };
    noDeviceButton_.onClick = [this] { end(true); };
    feltButton_.onClick = [this] { confirmPulse(); };
    louderButton_.onClick = [this] { raiseLevel(); };
    notFeltButton_.onClick = [this] { denyPulse(); };
    doneButton_.onClick = [this] { end(true); };
    updateTexts();
}

void FirstStart::choose(int index) {
    chosenIndex_ = juce::jlimit(0, std::max(0, static_cast<int>(rows_.size()) - 1), index);
    updateTexts();
}

void FirstStart::openChosen() {
    if (choices_.empty()) return end(false);
    const PlaybackChoice choice = nth(choices_, chosenIndex_);
    if (choice.outputs == 0) {
        model_.announce("No device: the world is seen, not felt. Output has the devices");
        return end(true);
    }
    if (choice.isSink) {
        if (onSink) onSink(choice.device);
        return;
    }
    if (choice.isHeadphones) {
        auto oldOutputs = model_.device().outputMap(); // restored after the headphones
        model_.change("Headphones", [](Mix& mix) { fitLayoutTo(DeviceChoice::earCount, mix); });
        return openHeadphones(model_, choice.device, std::move(oldOutputs)).empty() ? end(true)
                                                                                    : updateTexts();
    }
    if (const auto error = model_.open(choice.device); !error.empty()) return updateTexts();
    test(std::max(1, std::min(choice.outputs, model_.device().outputCount())));
}

void FirstStart::test(int outputs) {
    if (testIndex_ < 0) slownessBefore_ = model_.session().world().slowness();
    model_.setSlowness(0); // pauses the world: only test pulses play
    model_.change("First start", [&, outputs](Mix& mix) {
        fitLayoutTo(outputs, mix, model_.device().choice().name);
        for (int j = 0; j < mix.count(); ++j) nth(mix.strips, j).output = j;
        mix.levelDb = std::min(startDb, mix.levelDb);
    });
    testIndex_ = 0;
    readyCheckCount_ = 0;
    areSinksReady() ? pulse() : startTimer(readyCheckMs);
    updateTexts();
}

// A sink may not be ready yet, and then its first pulse would be lost.
bool FirstStart::areSinksReady() const {
    return coversSinks(model_.session()) &&
           std::ranges::all_of(model_.session().sinks().states(), &SinkState::isReady);
}

void FirstStart::timerCallback() {
    if (!areSinksReady() && ++readyCheckCount_ < maxReadyChecks) return;
    stopTimer();
    pulse();
    updateTexts();
}

void FirstStart::pulse() {
    if (testIndex_ >= 0 && testIndex_ < model_.mix().count()) model_.eventPlayer().testPulse(testIndex_);
}

void FirstStart::testNext() {
    if (++testIndex_ >= model_.mix().count()) return end(true);
    pulse();
    updateTexts();
}

// The tested actuator may have been detached by a message or in the window behind.
bool FirstStart::isDetached() const { return testIndex_ >= model_.mix().count(); }

void FirstStart::confirmPulseAt(double shareX, double shareY) {
    if (isDetached()) return testNext();
    model_.change("Place of an actuator", [&](Mix& mix) {
        auto& layout = mix.layout.geometry;
        auto& place = nth(layout.places, testIndex_); // depth and part stay
        place.xMetres = juce::jlimit(0.0, 1.0, shareX) * layout.extentWidthMetres;
        place.yMetres = juce::jlimit(0.0, 1.0, shareY) * layout.extentHeightMetres;
        mix.layout.name = "own";
    });
    testNext();
}

void FirstStart::denyPulse() {
    if (isDetached()) return testNext();
    model_.change("Not felt", [this](Mix& mix) { nth(mix.strips, testIndex_).output = -1; });
    testNext();
}

void FirstStart::raiseLevel() {
    if (isDetached()) return testNext();
    model_.change("Louder", true, [](Mix& mix) { mix.levelDb = std::min(maxDb, mix.levelDb + stepDb); });
    pulse();
    updateTexts();
}

void FirstStart::end(bool hasChosen) {
    model_.undoManager().clearUndoHistory(); // undo must not raise the level of the test
    if (std::exchange(testIndex_, -1) >= 0) {
        model_.setSlowness(slownessBefore_);
        model_.announce("It stays as quiet as it was tested: the master's fader raises it");
    }
    if (onEnd) onEnd(hasChosen); // may destroy this object
}

bool FirstStart::keyPressed(const juce::KeyPress& key) {
    using juce::KeyPress;
    if (const bool isTest = testIndex_ >= 0; key == KeyPress::escapeKey)
        return end(isTest), !isTest; // after a test, Esc also silences: the world goes on
    if (testIndex_ < 0) {
        if (key == KeyPress::upKey) return choose(chosenIndex_ - 1), true;
        if (key == KeyPress::downKey) return choose(chosenIndex_ + 1), true;
        if (key == KeyPress::returnKey) return openChosen(), true;
        return false;
    }
    if (key == KeyPress::returnKey) return confirmPulse(), true;
    if (key.getKeyCode() == 'L' || key.getTextCharacter() == 'l') return raiseLevel(), true;
    if (key.getKeyCode() == 'N' || key.getTextCharacter() == 'n') return denyPulse(), true;
    if (key == KeyPress::spaceKey) return pulse(), true;
    return false;
}

void FirstStart::updateTexts() {
    const bool isTest = testIndex_ >= 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        rows_[i]->setVisible(!isTest);
        rows_[i]->setToggleState(static_cast<int>(i) == chosenIndex_, dontNotify);
    }
    if (!isTest) {
        const bool hasChoice = choices_.size() > 1;
        setTexts("Where are your actuators?",
                 (hasChoice
                      ? nth(choices_, chosenIndex_).isHeadphones
                            ? "Play here begins at once, for ears. Nothing plays before."
                            : "Play here tests each of them in turn, quietly at first. Nothing plays before."
                      : "No device was found. Plug one in, and choose it under Output.") +
                     juce::String{" Then drag a ball to throw it; Esc silences."});
        playButton_.setButtonText(hasChoice ? "Play here" : "Go on");
        setAnswers(hasChoice ? std::vector{&playButton_, &noDeviceButton_} : std::vector{&playButton_});
    } else {
        const auto& label = nth(model_.mix().layout.actuators, testIndex_).label;
        const int output = nth(model_.mix().strips, testIndex_).output;
        louderButton_.setEnabled(model_.mix().levelDb < maxDb);
        setAnswers({&feltButton_, &louderButton_, &notFeltButton_, &doneButton_});
        setTexts(
            "Did you feel it? Where?",
            isTimerRunning()
                ? "It is looked for" + ellipsis()
                : "Actuator " + utf8(label) +
                      (output >= 0 ? ", output " + juce::String{output + 1} : juce::String{}) +
                      (model_.mix().levelDb < maxDb ? ", quietly" : ", as loud as a test gets") +
                      ". Click the place where you felt it, or Felt if it is where it is drawn. Space plays "
                      "it again.");
    }
    fitToContents();
}

void FirstStart::mouseDown(const juce::MouseEvent& e) {
    const auto field = field_;
    if (testIndex_ < 0 || !field.contains(e.getPosition())) return;
    confirmPulseAt(static_cast<double>(e.x - field.getX()) / field.getWidth(),
                   1.0 - static_cast<double>(e.y - field.getY()) / field.getHeight());
}

void FirstStart::paint(juce::Graphics& g) {
    Card::paint(g);
    if (testIndex_ < 0) return;
    const auto field = field_;
    fillRound(g, *this, Shade::well, field.toFloat(), 6.0f);
    const auto& layout = model_.mix().layout.geometry;
    for (int j = 0; j < layout.count; ++j) {
        const auto& place = nth(layout.places, j);
        const auto centre =
            juce::Point<double>{field.getX() + place.xMetres / layout.extentWidthMetres * field.getWidth(),
                                field.getBottom() -
                                    place.yMetres / layout.extentHeightMetres * field.getHeight()}
                .toFloat();
        const auto badge =
            juce::Rectangle<float>{28.0f, 28.0f}.withCentre(centre).constrainedWithin(field.toFloat());
        g.setColour(actuatorColour(*this, j).withAlpha(j == testIndex_ ? 1.0f : 0.35f));
        j == testIndex_ ? g.fillRoundedRectangle(badge, 7.0f) : g.drawRoundedRectangle(badge, 7.0f, 2.0f);
        setInk(g, *this, j == testIndex_ ? Shade::well : Shade::muted, text::medium, juce::Font::bold);
        g.drawText(labelOf(model_.mix(), j), badge, juce::Justification::centred, false);
    }
}

int FirstStart::contentHeight() const {
    return testIndex_ >= 0 ? fieldHeight : static_cast<int>(rows_.size()) * (cardRowHeight + rowGap);
}

void FirstStart::placeContent(juce::Rectangle<int> content) {
    field_ = content.withSizeKeepingCentre(360, fieldHeight);
    for (auto& row : rows_)
        row->setBounds(content.removeFromTop(cardRowHeight)), content.removeFromTop(rowGap);
}

} // namespace physvib

// SPDX-License-Identifier: GPL-3.0-or-later
// First-start assistant: device choice and test pulses. Levels start low, because people may be holding the
// actuators.
#include "Mixer/Window/FirstStart.h"
#include "Live/Devices/AudioDevice.h"

namespace physvib {
namespace {

constexpr int mostRows = 6, rowGap = 5, fieldHigh = 200;
constexpr int lookMs = 100,
              maxLooks = 50; // time for a sink to become ready: greeting and clock of a board need half a
                             // second, Bluetooth one

/// Whether the system's name of a device is that of headphones.
bool isForEars(const std::string& device) {
    const auto name = juce::String::fromUTF8(device.c_str()).toLowerCase();
    for (const char* word : {"headphone", "headset", "earphone", "earbud", "airpods", "kopfh", "casque"})
        if (name.contains(word)) return true;
    return false;
}

/// A row of a list of choices, with a radio button.
class Row final : public juce::Button {
public:
    explicit Row(const juce::String& words)
        : juce::Button{words} {
        setTitle(words);
    }
    void paintButton(juce::Graphics& g, bool isOver, bool) override {
        auto area = getLocalBounds();
        const bool isChosen = getToggleState();
        fillRound(g, *this, Shade::accent, area.toFloat(), 6.0f, isChosen ? 0.2f : isOver ? 0.08f : 0.0f);
        const auto ring = area.removeFromLeft(40).toFloat().withSizeKeepingCentre(14.0f, 14.0f);
        g.setColour(shade(*this, isChosen ? Shade::accent : Shade::muted));
        g.drawEllipse(ring, 1.5f);
        if (isChosen) g.fillEllipse(ring.reduced(3.5f));
        ink(g, *this, Shade::text, text::medium);
        g.drawText(getName(), area, juce::Justification::centredLeft, true);
    }
};

} // namespace

std::vector<SinkOffer> likelySinks() {
    std::vector<SinkOffer> offers;
    for (const SinkKind& kind : sinkKinds())
        for (SinkPlace& place : kind.places())
            if (place.isLikely) offers.push_back({&kind, std::move(place)});
    return offers;
}

std::vector<FeltChoice> feltChoices(const AudioDrivers& drivers, const std::vector<SinkOffer>& offers) {
    const auto devices = byLikelihood(listAudioDevices(drivers));
    std::vector<FeltChoice> many, few, all;
    for (const auto& device : devices) {
        const int outputs = ownOutputs(device);
        if (device.type == noDeviceType || outputs < 1) continue; // nothing could be felt or heard there
        FeltChoice choice{utf8(device.type + ":" + device.name) + ", " + countOf(outputs, "output") +
                              (outputs == 2 ? ": two actuators" : ""),
                          {device.type + ":" + device.name},
                          outputs};
        (outputs > 2 ? many : few).push_back(std::move(choice));
    }
    // best choice among sound devices: headphones by their name, else any
    std::optional<FeltChoice> ears;
    if (const auto& heard = few.empty() ? many : few; !heard.empty()) {
        const auto named = std::ranges::find_if(
            heard, [](const FeltChoice& c) { return isForEars(c.device.name) && c.outputs >= 2; });
        ears = named != heard.end() ? *named : heard.front();
    }
    const bool areNamed = ears && isForEars(ears->device.name);
    // a device with a motor for each output, and headphones that say so, come before what vibrates beside it
    const auto beforePads = std::ssize(many);
    std::ptrdiff_t meant = 0;
    for (const auto& [kind, place] : offers) { // choice with the sink only, without a sound device
        FeltChoice choice{utf8(std::string{kind->title} + ": " + place.where) +
                              (place.about.empty() ? juce::String{} : "  " + utf8(place.about)),
                          {std::string{noDeviceType} + ":" + noDeviceName},
                          kind->actuators,
                          true};
        choice.device.want(*kind, place.where);
        many.insert(kind->isMeant ? many.begin() : many.end(), std::move(choice));
        meant += kind->isMeant ? 1 : 0;
    }
    if (ears && ears->outputs >= 2) {
        ears->title = "Headphones: " + utf8(ears->device.name);
        ears->isHeard = true;
        const auto at = areNamed ? beforePads + meant : std::ssize(many);
        many.insert(many.begin() + std::min<std::ptrdiff_t>(at, mostRows - 1), *ears);
    }
    all = std::move(many);
    all.insert(all.end(), few.begin(), few.end());
    all.push_back({noDeviceTitle, {std::string{noDeviceType} + ":" + noDeviceName}, 0});
    return all;
}

FirstStart::FirstStart(MixerModel& model, std::vector<FeltChoice> choices)
    : Card{wide}
    , model_{model}
    , choices_{std::move(choices)} {
    for (int i = 0; i < std::min(mostRows, static_cast<int>(choices_.size())); ++i) {
        auto& row = *rows_.emplace_back(std::make_unique<Row>(
            nth(choices_, i).title + (i == 0 && choices_.size() > 1 ? "  (likely)" : "")));
        row.onClick = [this, i] { choose(i); };
        addChildComponent(row);
    }
    play_.onClick = [this] { playHere(); };
    without_.onClick = [this] { end(true); };
    felt_.onClick = [this] { felt(); };
    louder_.onClick = [this] { louder(); };
    notFelt_.onClick = [this] { notFelt(); };
    done_.onClick = [this] { end(true); };
    show();
}

void FirstStart::choose(int index) {
    chosen_ = juce::jlimit(0, std::max(0, static_cast<int>(rows_.size()) - 1), index);
    show();
}

void FirstStart::playHere() {
    if (choices_.empty()) return end(false);
    const FeltChoice choice = nth(choices_, chosen_);
    if (choice.outputs == 0) {
        model_.announce("No device: the world is seen, not felt. Output has the devices");
        return end(true);
    }
    if (choice.isBeside) {
        if (onSink) onSink(choice.device);
        return;
    }
    if (choice.isHeard) {
        auto before = model_.device().outputMap(); // of all, which come back after them
        model_.change("Headphones", [](Mix& mix) { fitLayoutTo(DeviceChoice::ears, mix); });
        return useHeadphones(model_, choice.device, std::move(before)).empty() ? end(true) : show();
    }
    if (const auto error = model_.open(choice.device); !error.empty()) return show();
    test(std::max(1, std::min(choice.outputs, model_.device().outputs())));
}

void FirstStart::test(int outputs) {
    if (tested_ < 0) slowness_ = model_.session().world().slowness();
    model_.setSlowness(0); // pause the world, so that only test pulses are felt
    model_.change("First start", [&, outputs](Mix& mix) {
        fitLayoutTo(outputs, mix, model_.device().choice().name);
        for (int j = 0; j < mix.count(); ++j) nth(mix.strips, j).output = j;
        mix.levelDb = std::min(firstDb, mix.levelDb);
    });
    tested_ = 0;
    looks_ = 0;
    isPlayed() ? pulse() : startTimer(lookMs);
    show();
}

// A sink may not be ready yet, and then its first pulse would be lost.
bool FirstStart::isPlayed() const {
    return coversSinks(model_.session()) &&
           std::ranges::all_of(model_.session().sinks().states(), &SinkState::isReady);
}

void FirstStart::timerCallback() {
    if (!isPlayed() && ++looks_ < maxLooks) return;
    stopTimer();
    pulse();
    show();
}

void FirstStart::pulse() {
    if (tested_ >= 0 && tested_ < model_.mix().count()) model_.strikes().testPulse(tested_);
}

void FirstStart::next() {
    if (++tested_ >= model_.mix().count()) return end(true);
    pulse();
    show();
}

// The tested actuator may have been detached by a message or in the window behind.
bool FirstStart::isGone() const { return tested_ >= model_.mix().count(); }

void FirstStart::feltAt(double shareX, double shareY) {
    if (isGone()) return next();
    model_.change("Place of an actuator", [&](Mix& mix) {
        auto& layout = mix.layout.geometry;
        auto& place = nth(layout.places, tested_); // depth and part stay
        place.xMetres = juce::jlimit(0.0, 1.0, shareX) * layout.extentWidthMetres;
        place.yMetres = juce::jlimit(0.0, 1.0, shareY) * layout.extentHeightMetres;
        mix.layout.name = "own";
    });
    next();
}

void FirstStart::notFelt() {
    if (isGone()) return next();
    model_.change("Not felt", [this](Mix& mix) { nth(mix.strips, tested_).output = -1; });
    next();
}

void FirstStart::louder() {
    if (isGone()) return next();
    model_.change(
        "Louder", [](Mix& mix) { mix.levelDb = std::min(mostDb, mix.levelDb + louderDb); }, true);
    pulse();
    show();
}

void FirstStart::end(bool hasChosen) {
    model_.undoManager().clearUndoHistory(); // no undo raises the level at which it has tested
    if (std::exchange(tested_, -1) >= 0) {
        model_.setSlowness(slowness_);
        model_.announce("It stays as quiet as it was tested: the master's fader raises it");
    }
    if (onEnd) onEnd(hasChosen); // may destroy this object
}

bool FirstStart::keyPressed(const juce::KeyPress& key) {
    using juce::KeyPress;
    if (const bool isTest = tested_ >= 0; key == KeyPress::escapeKey)
        return end(isTest), !isTest; // after a test it silences: the world goes on
    if (tested_ < 0) {
        if (key == KeyPress::upKey) return choose(chosen_ - 1), true;
        if (key == KeyPress::downKey) return choose(chosen_ + 1), true;
        if (key == KeyPress::returnKey) return playHere(), true;
        return false;
    }
    if (key == KeyPress::returnKey) return felt(), true;
    if (key.getKeyCode() == 'L' || key.getTextCharacter() == 'l') return louder(), true;
    if (key.getKeyCode() == 'N' || key.getTextCharacter() == 'n') return notFelt(), true;
    if (key == KeyPress::spaceKey) return pulse(), true;
    return false;
}

void FirstStart::show() {
    const bool isTest = tested_ >= 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        rows_[i]->setVisible(!isTest);
        rows_[i]->setToggleState(static_cast<int>(i) == chosen_, quietly);
    }
    if (!isTest) {
        const bool hasChoice = choices_.size() > 1;
        say("Where are your actuators?",
            (hasChoice ? nth(choices_, chosen_).isHeard
                             ? "Play here begins at once, for ears. Nothing plays before."
                             : "Play here tests each of them in turn, quietly at first. Nothing plays before."
                       : "No device was found. Plug one in, and choose it under Output.") +
                juce::String{" Then drag a ball to throw it; Esc silences."});
        play_.setButtonText(hasChoice ? "Play here" : "Go on");
        setAnswers(hasChoice ? std::vector{&play_, &without_} : std::vector{&play_});
    } else {
        const auto& label = nth(model_.mix().layout.enchanters, tested_).label;
        const int output = nth(model_.mix().strips, tested_).output;
        louder_.setEnabled(model_.mix().levelDb < mostDb);
        setAnswers({&felt_, &louder_, &notFelt_, &done_});
        say("Did you feel it? Where?",
            isTimerRunning()
                ? "It is looked for" + dots()
                : "Actuator " + utf8(label) +
                      (output >= 0 ? ", output " + juce::String{output + 1} : juce::String{}) +
                      (model_.mix().levelDb < mostDb ? ", quietly" : ", as loud as a test gets") +
                      ". Click the place where you felt it, or Felt if it is where it is drawn. Space plays "
                      "it again.");
    }
    fit();
}

void FirstStart::mouseDown(const juce::MouseEvent& e) {
    const auto at = field_;
    if (tested_ < 0 || !at.contains(e.getPosition())) return;
    feltAt(static_cast<double>(e.x - at.getX()) / at.getWidth(),
           1.0 - static_cast<double>(e.y - at.getY()) / at.getHeight());
}

void FirstStart::paint(juce::Graphics& g) {
    Card::paint(g);
    if (tested_ < 0) return;
    const auto at = field_;
    fillRound(g, *this, Shade::well, at.toFloat(), 6.0f);
    const auto& layout = model_.mix().layout.geometry;
    for (int j = 0; j < layout.count; ++j) {
        const auto& place = nth(layout.places, j);
        const auto centre =
            juce::Point<double>{at.getX() + place.xMetres / layout.extentWidthMetres * at.getWidth(),
                                at.getBottom() - place.yMetres / layout.extentHeightMetres * at.getHeight()}
                .toFloat();
        const auto badge =
            juce::Rectangle<float>{28.0f, 28.0f}.withCentre(centre).constrainedWithin(at.toFloat());
        g.setColour(enchanterColour(*this, j).withAlpha(j == tested_ ? 1.0f : 0.35f));
        j == tested_ ? g.fillRoundedRectangle(badge, 7.0f) : g.drawRoundedRectangle(badge, 7.0f, 2.0f);
        ink(g, *this, j == tested_ ? Shade::well : Shade::muted, text::medium, juce::Font::bold);
        g.drawText(labelOf(model_.mix(), j), badge, juce::Justification::centred, false);
    }
}

int FirstStart::contentHigh() const {
    return tested_ >= 0 ? fieldHigh : static_cast<int>(rows_.size()) * (rowHigh + rowGap);
}

void FirstStart::place(juce::Rectangle<int> content) {
    field_ = content.withSizeKeepingCentre(360, fieldHigh);
    for (auto& row : rows_) row->setBounds(content.removeFromTop(rowHigh)), content.removeFromTop(rowGap);
}

} // namespace physvib

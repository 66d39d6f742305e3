// SPDX-License-Identifier: GPL-3.0-or-later
// Controls of scene, time and recording in the top bar, and its status of device, board and load.
#include "Live/Devices/AudioDevice.h"
#include "Mixer/Window/MixerView.h"
#include "Scene/SceneFile.h"

namespace physvib {

namespace {

constexpr int updatesPerClock = 3, updatesPerNumbers = 12;
constexpr int sceneFileId = 1000; // item id; those of the user's scenes follow
constexpr std::array<int, 4> slownessSteps{1, 2, 4, 8};

juce::String clockText(std::int64_t ns) {
    const auto hundredths = ns / 10'000'000;
    return juce::String{hundredths / 6000}.paddedLeft('0', 2) + ":" +
           juce::String{hundredths / 100 % 60}.paddedLeft('0', 2) + "." +
           juce::String{hundredths % 100}.paddedLeft('0', 2);
}

juce::String countedText(std::uint64_t n, const char* noun) {
    return number(static_cast<double>(n), 0) + " " + noun;
}

const juce::String discSymbol = juce::String::charToString(0x25cf) + " ";
juce::String joinedByDots(const juce::StringArray& parts) {
    return parts.joinIntoString("  " + juce::String::charToString(0x00b7) + "  ");
}

} // namespace

TopBar::TopBar(MixerModel& model)
    : model_{model}
    , hasBoard_{!model.session().sinks().states().empty()} {
    setTitle("Transport and device");
    describe(menu_, "Menu", "Open, save, record, render (F10)");
    menu_.setMouseClickGrabsKeyboardFocus(false); // the keyboard stays with its owner
    menu_.onClick = [this] { onMenu(menu_); };
    save_.onClick = [this] { onSave(); };
    undo_.onClick = [this] { model_.undoManager().undo(); };
    redo_.onClick = [this] { model_.undoManager().redo(); };
    scene_.setTitle("Scene");
    listScenes();
    scene_.onChange = [this] { chooseScene(); };
    pause_.onClick = [this] { togglePause(); };
    step_.onClick = [this] { model_.session().world().stepOnce(); };
    describe(slow_, "Slow motion", "Slow motion: each press halves the speed of the world");
    slow_.onClick = [this] {
        const auto step = std::ranges::find(slownessSteps, std::max(1, model_.session().world().slowness()));
        model_.setSlowness(step + 1 < slownessSteps.end() ? step[1] : 1);
    };
    restart_.onClick = [this] { model_.restart(model_.mix().seed); };
    describe(seed_, "Seed", "Seed of the scene: another seed is another course");
    seed_.setFont(text::font(text::medium));
    seed_.setEditable(true);
    seed_.setWantsKeyboardFocus(true);
    seed_.onTextChange = [this] {
        const auto typedSeed = seed_.getText().retainCharacters("0123456789").getLargeIntValue();
        model_.restart(static_cast<std::uint32_t>(juce::jlimit<juce::int64>(0, 0xffffffffll, typedSeed)));
        mixChanged();
    };
    time_.setTitle("Time");
    time_.setFont(text::font(text::medium, juce::Font::bold));
    describe(record_, "Record", "Record what is played, and every event (Ctrl+R)");
    record_.getProperties().set(tintProperty, static_cast<juce::int64>(palette::limit.getARGB()));
    record_.onClick = [this] { onRecord(); };
    device_.setMouseClickGrabsKeyboardFocus(false);
    device_.setMouseCursor(juce::MouseCursor::PointingHandCursor);
    device_.onClick = [this] { onDevice(); };
    mode_.setTitle("Mode");
    mode_.onClick = [this] { onMode(); };
    silence_.getProperties().set(stopProperty, true);
    silence_.setMouseClickGrabsKeyboardFocus(false); // an open card keeps the keyboard
    describe(silence_, "Silence",
             "Silence every actuator at once; a press lifts the silence. Esc silences too; an open card, "
             "menu or drag it ends, and then silences only what sounds, or did 1.5 s before");
    silence_.onClick = [this] { model_.setSilent(!model_.isSilent()); };
    addAll(*this, {&menu_, &save_, &undo_, &redo_, &scene_, &pause_, &step_, &slow_, &restart_, &seed_,
                   &time_, &record_, &mode_, &device_, &board_, &load_, &silence_});
    setRecording(false);
    setPlayMode(false);
    mixChanged();
}

void TopBar::setOwnScenes(const juce::Array<juce::File>& files) {
    if (files == ownScenes_) return;
    ownScenes_ = files;
    listScenes();
    mixChanged();
}

void TopBar::listScenes() {
    scene_.clear(dontNotify);
    for (int id = 1; const auto& scene : builtInScenes()) scene_.addItem(displayTitle(scene.name), id++);
    scene_.addSeparator();
    for (int k = 0; k < ownScenes_.size(); ++k)
        scene_.addItem(ownScenes_[k].getFileNameWithoutExtension(), sceneFileId + 1 + k);
    scene_.addItem(juce::String::fromUTF8("Scene file\xe2\x80\xa6"), sceneFileId);
}

void TopBar::chooseScene() {
    const int id = scene_.getSelectedId();
    if (id == sceneFileId) {
        mixChanged();
        onOpenScene();
    } else if (id > sceneFileId) {
        onOwnScene(ownScenes_[id - sceneFileId - 1]);
    } else if (id > 0) {
        const auto& scene = nth(builtInScenes(), id - 1);
        if (scene == *model_.mix().scene) return;
        model_.change("Scene", [&scene](Mix& mix) { mix.scene = std::make_shared<const Scene>(scene); });
    }
}

void TopBar::mixChanged() {
    const auto& mix = model_.mix();
    scene_.setText(displayTitle(mix.scene->name), dontNotify);
    seed_.setText("seed " + juce::String{static_cast<juce::int64>(mix.seed)}, dontNotify);
    const int slowness = model_.session().world().slowness();
    pause_.setIcon(slowness == 0 ? Icon::play : Icon::pause,
                   slowness == 0 ? "Let the world go on (Space)" : "Pause the world (Space)");
    pause_.setToggleState(slowness == 0, dontNotify);
    step_.setEnabled(slowness == 0);
    slow_.setButtonText(slowness < 2 ? juce::String::fromUTF8("1\xc3\x97") : "1/" + juce::String{slowness});
    slow_.setToggleState(slowness > 1, dontNotify);
    silence_.setToggleState(model_.isSilent(), dontNotify);
    silence_.setButtonText(model_.isSilent() ? "SILENT: press to feel" : "SILENCE  Esc");
    const auto& history = model_.undoManager();
    undo_.setEnabled(history.canUndo());
    redo_.setEnabled(history.canRedo());
    undo_.setTooltip("Undo: " + history.getUndoDescription() + " (Ctrl+Z)");
    redo_.setTooltip("Redo: " + history.getRedoDescription() + " (Ctrl+Shift+Z)");
}

void TopBar::setRecording(bool isRecording) {
    record_.setToggleState(isRecording, dontNotify);
    isRecording_ = isRecording;
    recordingStartNs_ = -1;
    record_.setButtonText(discSymbol + (isRecording ? "Recording" : "Record"));
}

void TopBar::refresh(const MixerSnapshot& snapshot) {
    const int phase = updates_++ % updatesPerNumbers; // faster numbers are illegible
    if (phase % updatesPerClock == 0) time_.setText(clockText(snapshot.session.sessionNs), dontNotify);
    if (phase != 0) return;
    if (isRecording_) {
        if (recordingStartNs_ < 0) recordingStartNs_ = snapshot.session.sessionNs;
        record_.setButtonText(
            discSymbol + clockText(snapshot.session.sessionNs - recordingStartNs_).dropLastCharacters(3));
    }
    // the device and its latency, as long as there is room
    const auto& output = model_.output();
    const auto name = juce::String::fromUTF8(output.device().c_str());
    const bool isWithoutDevice = name.startsWith(juce::String{nullDeviceType} + ":");
    const auto rateText =
        number(output.sampleRateHz() / 1000.0, output.sampleRateHz() % 1000 == 0 ? 0 : 1) + " kHz";
    const auto latencyText = "felt " + number(1e3 * model_.device().outputLatencySeconds(), 0) + " ms ",
               longText = latencyText + "after the contact";
    const int nameWidth = getHeight() > lineHeight ? 170 : 0; // width of the name in the second line
    const bool hasRoom =
        text::pixelWidth(text::font(text::small), longText) <= device_.getWidth() - nameWidth;
    const auto deviceText = isWithoutDevice ? juce::String{"No device"} : name;
    const bool isVisualOnly = model_.isVisualOnly();
    if (!snapshot.device.isRunning)
        device_.set("No sound", model_.device().error().upToFirstOccurrenceOf(";", false, false),
                    Shade::limit);
    else
        device_.set(isPlayMode_ ? deviceText
                                : joinedByDots({deviceText, rateText, juce::String{output.blockFrames()}}),
                    isVisualOnly ? juce::String{"seen, not felt"}
                    : hasRoom    ? longText
                                 : latencyText + "later",
                    isVisualOnly ? Shade::highlight : Shade::text);
    device_.setTooltip(name);
    // load and recent losses
    const bool hadWarning = warnsOfLoad_;
    const auto& render = snapshot.session.render;
    constexpr double lossDisplayMs = 5e3; // then only Telemetry shows them, in its totals
    const Losses losses{render.late, model_.session().world().drops() + render.unsent};
    if (std::exchange(losses_, losses) != losses) lostAtMs_ = nowMs();
    if (nowMs() - lostAtMs_ > lossDisplayMs || losses.late < seenLosses_.late ||
        losses.lost < seenLosses_.lost)
        seenLosses_ = losses; // counts become smaller when another device is opened
    const Losses newLosses{losses.late - seenLosses_.late, losses.lost - seenLosses_.lost};
    load_.set("Load " + number(100.0 * snapshot.device.load, 1) + " %",
              joinedByDots({countedText(newLosses.late, "late"), countedText(newLosses.lost, "lost")}),
              newLosses == Losses{} ? Shade::text : Shade::highlight);
    warnsOfLoad_ = newLosses.lost > 0 || snapshot.device.load > 0.5f;
    const auto sinks = model_.session().sinks().states();
    const bool areReady = std::ranges::all_of(sinks, &SinkState::isReady);
    board_.set(sinks.empty() ? juce::String{"Board: none"}
               : areReady    ? displayTitle(sinks.front().name) + ": ready"
                             : "No " + utf8(std::ranges::find(sinks, false, &SinkState::isReady)->name),
               model_.isSilent() ? juce::String{"silenced"}
                                 : countedText(static_cast<std::uint64_t>(render.liveModes),
                                               render.liveModes == 1 ? "tone rings" : "tones ring"),
               sinks.empty() ? Shade::muted
               : areReady    ? Shade::accent
                             : Shade::limit);
    if (hadWarning != warnsOfLoad_) resized();
}

void TopBar::setShowMode(bool isShowMode) {
    isShowMode_ = isShowMode;
    showControls();
}

void TopBar::setPlayMode(bool isPlayMode) {
    isPlayMode_ = isPlayMode;
    mode_.setButtonText(isPlayMode ? "Engineer" : "Play");
    mode_.setTooltip(isPlayMode ? "Strips, lanes, events, materials, outputs and studies as well (F2)"
                                : "The world, and what one needs to play (F2)");
    updates_ = 0; // refreshes the figures, which depend on the mode
    showControls();
}

void TopBar::showControls() {
    for (auto* child : getChildren()) child->setVisible(!isShowMode_ || child == &silence_);
    physvib::setVisible({&step_, &slow_, &seed_, &time_}, !isShowMode_ && !isPlayMode_);
    resized();
}

void TopBar::resized() {
    auto area = getLocalBounds().reduced(gap, 9);
    const bool isOneLine = getHeight() <= lineHeight;
    const auto stateArea = area.removeFromBottom(isOneLine ? 0 : secondLineHeight).translated(0, 5);
    area.setHeight(lineHeight - 18);
    constexpr int buttonWidth = 36, wideGap = 8, narrowGap = 2;
    silence_.setBounds(area.removeFromRight(166));
    area.removeFromRight(wideGap);
    struct Control {
        juce::Component* component;
        int width, gapAfter;
    };
    for (const auto& [component, width, gapAfter] :
         std::initializer_list<Control>{{&menu_, 60, wideGap},
                                        {&save_, buttonWidth, narrowGap},
                                        {&undo_, buttonWidth, narrowGap},
                                        {&redo_, buttonWidth, wideGap},
                                        {&scene_, 134, wideGap},
                                        {&pause_, buttonWidth, narrowGap},
                                        {&step_, buttonWidth, narrowGap},
                                        {&slow_, buttonWidth, narrowGap},
                                        {&restart_, buttonWidth, wideGap},
                                        {&seed_, 66, 0},
                                        {&time_, 82, 0},
                                        {&record_, 90, wideGap},
                                        {&mode_, 66, wideGap}}) {
        if (!component->isVisible()) continue;
        component->setBounds(area.removeFromLeft(area.getWidth() < width ? 0 : width)); // hidden without room
        area.removeFromLeft(gapAfter);
    }
    if (!isShowMode_) placeStates(isOneLine ? area : stateArea);
}

// In play mode, and where there is little room, load and board are shown only with a warning or a board.
void TopBar::placeStates(juce::Rectangle<int> area) {
    const bool isSecondLine = getHeight() > lineHeight,
               hasRoom = !isPlayMode_ && (isSecondLine || getWidth() >= minStatusWidth);
    load_.setVisible(hasRoom || warnsOfLoad_);
    board_.setVisible(hasRoom || hasBoard_);
    if (load_.isVisible()) load_.setBounds(area.removeFromRight(isSecondLine ? 200 : 112));
    if (board_.isVisible()) board_.setBounds(area.removeFromRight(isSecondLine ? 200 : 108));
    device_.setBounds(area.withTrimmedRight(8));
}

} // namespace physvib

// SPDX-License-Identifier: GPL-3.0-or-later
// Controls and status text of the top bar.
#include "Live/Devices/AudioDevice.h"
#include "Mixer/Window/MixerView.h"
#include "Scene/SceneFile.h"

namespace physvib {

namespace {

constexpr int looksPerTime = 3, looksPerNumbers = 12;
constexpr int sceneFileId = 1000; // followed by the user's scenes
constexpr std::array<int, 4> paces{1, 2, 4, 8};

juce::String clock(std::int64_t ns) {
    const auto hundredths = ns / 10'000'000;
    return juce::String{hundredths / 6000}.paddedLeft('0', 2) + ":" +
           juce::String{hundredths / 100 % 60}.paddedLeft('0', 2) + "." +
           juce::String{hundredths % 100}.paddedLeft('0', 2);
}

juce::String count(std::uint64_t n, const char* what) {
    return number(static_cast<double>(n), 0) + " " + what;
}

const juce::String disc = juce::String::charToString(0x25cf) + " ";
juce::String dotted(const juce::StringArray& parts) {
    return parts.joinIntoString("  " + juce::String::charToString(0x00b7) + "  ");
}

} // namespace

TopBar::TopBar(MixerModel& model)
    : model_{model}
    , hasBoard_{!model.session().sinks().states().empty()} {
    setTitle("Transport and device");
    describe(menu_, "Menu", "Open, save, record, render (F10)");
    menu_.setMouseClickGrabsKeyboardFocus(false); // after its menu the keys are again of who had them
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
        const auto at = std::ranges::find(paces, std::max(1, model_.session().world().slowness()));
        model_.setSlowness(at + 1 < paces.end() ? at[1] : 1);
    };
    restart_.onClick = [this] { model_.restart(model_.mix().seed); };
    describe(seed_, "Seed", "Seed of the scene: another seed is another course");
    seed_.setFont(text::font(text::medium));
    seed_.setEditable(true);
    seed_.setWantsKeyboardFocus(true);
    seed_.onTextChange = [this] {
        const auto typed = seed_.getText().retainCharacters("0123456789").getLargeIntValue();
        model_.restart(static_cast<std::uint32_t>(juce::jlimit<juce::int64>(0, 0xffffffffll, typed)));
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
    silence_.setMouseClickGrabsKeyboardFocus(false); // an open card keeps it
    describe(silence_, "Silence",
             "Silence every actuator at once; a press lifts the silence. Esc silences too; an open card, "
             "menu or drag it ends, and then silences only what sounds, or did 1.5 s before");
    silence_.onClick = [this] { model_.setSilent(!model_.isSilent()); };
    addAll(*this, {&menu_, &save_, &undo_, &redo_, &scene_, &pause_, &step_, &slow_, &restart_, &seed_,
                   &time_, &record_, &mode_, &device_, &board_, &load_, &silence_});
    setRecording(false);
    setPlay(false);
    mixChanged();
}

void TopBar::setOwnScenes(const juce::Array<juce::File>& files) {
    if (files == own_) return;
    own_ = files;
    listScenes();
    mixChanged();
}

void TopBar::listScenes() {
    scene_.clear(quietly);
    for (int id = 1; const auto& scene : builtInScenes()) scene_.addItem(titleOf(scene.name), id++);
    scene_.addSeparator();
    for (int k = 0; k < own_.size(); ++k)
        scene_.addItem(own_[k].getFileNameWithoutExtension(), sceneFileId + 1 + k);
    scene_.addItem(juce::String::fromUTF8("Scene file\xe2\x80\xa6"), sceneFileId);
}

void TopBar::chooseScene() {
    const int id = scene_.getSelectedId();
    if (id == sceneFileId) {
        mixChanged();
        onOpenScene();
    } else if (id > sceneFileId) {
        onOwnScene(own_[id - sceneFileId - 1]);
    } else if (id > 0) {
        const auto& scene = nth(builtInScenes(), id - 1);
        if (scene == *model_.mix().scene) return;
        model_.change("Scene", [&scene](Mix& mix) { mix.scene = std::make_shared<const Scene>(scene); });
    }
}

void TopBar::mixChanged() {
    const auto& mix = model_.mix();
    scene_.setText(titleOf(mix.scene->name), quietly);
    seed_.setText("seed " + juce::String{static_cast<juce::int64>(mix.seed)}, quietly);
    const int slowness = model_.session().world().slowness();
    pause_.setSign(slowness == 0 ? Sign::play : Sign::pause,
                   slowness == 0 ? "Let the world go on (Space)" : "Pause the world (Space)");
    pause_.setToggleState(slowness == 0, quietly);
    step_.setEnabled(slowness == 0);
    slow_.setButtonText(slowness < 2 ? juce::String::fromUTF8("1\xc3\x97") : "1/" + juce::String{slowness});
    slow_.setToggleState(slowness > 1, quietly);
    silence_.setToggleState(model_.isSilent(), quietly);
    silence_.setButtonText(model_.isSilent() ? "SILENT: press to feel" : "SILENCE  Esc");
    const auto& history = model_.undoManager();
    undo_.setEnabled(history.canUndo());
    redo_.setEnabled(history.canRedo());
    undo_.setTooltip("Undo: " + history.getUndoDescription() + " (Ctrl+Z)");
    redo_.setTooltip("Redo: " + history.getRedoDescription() + " (Ctrl+Shift+Z)");
}

void TopBar::setRecording(bool isRecording) {
    record_.setToggleState(isRecording, quietly);
    isRecording_ = isRecording;
    recordedFromNs_ = -1;
    record_.setButtonText(disc + (isRecording ? "Recording" : "Record"));
}

void TopBar::refresh(const MixerMoment& moment) {
    const int turn = looks_++ % looksPerNumbers; // numbers that change 30 times a second are illegible
    if (turn % looksPerTime == 0) time_.setText(clock(moment.session.sessionNs), quietly);
    if (turn != 0) return;
    if (isRecording_) {
        if (recordedFromNs_ < 0) recordedFromNs_ = moment.session.sessionNs;
        record_.setButtonText(disc + clock(moment.session.sessionNs - recordedFromNs_).dropLastCharacters(3));
    }
    const auto& output = model_.output();
    const auto name = juce::String::fromUTF8(output.device().c_str());
    const bool isNone = name.startsWith(juce::String{noDeviceType} + ":");
    const auto numbers =
        number(output.sampleRateHz() / 1000.0, output.sampleRateHz() % 1000 == 0 ? 0 : 1) + " kHz";
    const auto felt = "felt " + number(1e3 * model_.device().outputLatencySeconds(), 0) + " ms ",
               whole = felt + "after the contact";
    const int beside = getHeight() > lineHeight ? 170 : 0; // for the name, in its line
    const bool isWhole = text::pixels(text::font(text::small), whole) <= device_.getWidth() - beside;
    const auto shown = isNone ? juce::String{"No device"} : name;
    const bool isSeen = model_.isOnlySeen();
    if (!moment.device.isRunning)
        device_.set("No sound", model_.device().trouble().upToFirstOccurrenceOf(";", false, false),
                    Shade::limit);
    else
        device_.set(isPlay_ ? shown : dotted({shown, numbers, juce::String{output.blockFrames()}}),
                    isSeen    ? juce::String{"seen, not felt"}
                    : isWhole ? whole
                              : felt + "later",
                    isSeen ? Shade::now : Shade::text);
    device_.setTooltip(name);
    const bool hadLoad = isToldOfLoad_;
    const auto& r = moment.session.render;
    constexpr double untilFineMs = 5e3; // without any more; Telemetry goes on counting
    const Lost now{r.late, model_.session().world().drops() + r.untold};
    if (std::exchange(lost_, now) != now) lostAtMs_ = nowMs();
    if (nowMs() - lostAtMs_ > untilFineMs || now.late < lostBefore_.late || now.lost < lostBefore_.lost)
        lostBefore_ = now; // fewer: of another device
    const Lost news{now.late - lostBefore_.late, now.lost - lostBefore_.lost};
    load_.set("Load " + number(100.0 * moment.device.load, 1) + " %",
              dotted({count(news.late, "late"), count(news.lost, "lost")}),
              news == Lost{} ? Shade::text : Shade::now);
    isToldOfLoad_ = news.lost > 0 || moment.device.load > 0.5f;
    const auto sinks = model_.session().sinks().states();
    const bool areReady = std::ranges::all_of(sinks, &SinkState::isReady);
    board_.set(sinks.empty() ? juce::String{"Board: none"}
               : areReady    ? titleOf(sinks.front().name) + ": ready"
                             : "No " + utf8(std::ranges::find(sinks, false, &SinkState::isReady)->name),
               model_.isSilent() ? juce::String{"silenced"}
                                 : count(static_cast<std::uint64_t>(r.liveModes),
                                         r.liveModes == 1 ? "tone rings" : "tones ring"),
               sinks.empty() ? Shade::muted
               : areReady    ? Shade::accent
                             : Shade::limit);
    if (hadLoad != isToldOfLoad_) resized();
}

void TopBar::setShow(bool isShow) {
    isShow_ = isShow;
    showControls();
}

void TopBar::setPlay(bool isPlay) {
    isPlay_ = isPlay;
    mode_.setButtonText(isPlay ? "Engineer" : "Play");
    mode_.setTooltip(isPlay ? "Strips, lanes, events, materials, outputs and studies as well (F2)"
                            : "The world, and what one needs to play (F2)");
    looks_ = 0; // its figures are of the mode
    showControls();
}

void TopBar::showControls() {
    for (auto* child : getChildren()) child->setVisible(!isShow_ || child == &silence_);
    physvib::setVisible({&step_, &slow_, &seed_, &time_}, !isShow_ && !isPlay_);
    resized();
}

void TopBar::resized() {
    auto area = getLocalBounds().reduced(gap, 9);
    const bool isOneLine = getHeight() <= lineHeight;
    const auto states = area.removeFromBottom(isOneLine ? 0 : secondLine).translated(0, 5);
    area.setHeight(lineHeight - 18);
    constexpr int button = 36, between = 8, tight = 2;
    silence_.setBounds(area.removeFromRight(166));
    area.removeFromRight(between);
    struct Control {
        juce::Component* component;
        int width, after;
    };
    for (const auto& [component, width, after] : std::initializer_list<Control>{{&menu_, 60, between},
                                                                                {&save_, button, tight},
                                                                                {&undo_, button, tight},
                                                                                {&redo_, button, between},
                                                                                {&scene_, 134, between},
                                                                                {&pause_, button, tight},
                                                                                {&step_, button, tight},
                                                                                {&slow_, button, tight},
                                                                                {&restart_, button, between},
                                                                                {&seed_, 66, 0},
                                                                                {&time_, 82, 0},
                                                                                {&record_, 90, between},
                                                                                {&mode_, 66, between}}) {
        if (!component->isVisible()) continue;
        component->setBounds(area.removeFromLeft(area.getWidth() < width ? 0 : width)); // whole, or not
        area.removeFromLeft(after);
    }
    if (!isShow_) placeStates(isOneLine ? area : states);
}

// To play, and where there is little room, a load and a board are seen when they have something to say.
void TopBar::placeStates(juce::Rectangle<int> area) {
    const bool isSecond = getHeight() > lineHeight,
               hasRoom = !isPlay_ && (isSecond || getWidth() >= minFacts);
    load_.setVisible(hasRoom || isToldOfLoad_);
    board_.setVisible(hasRoom || hasBoard_);
    if (load_.isVisible()) load_.setBounds(area.removeFromRight(isSecond ? 200 : 112));
    if (board_.isVisible()) board_.setBounds(area.removeFromRight(isSecond ? 200 : 108));
    device_.setBounds(area.withTrimmedRight(8));
}

} // namespace physvib

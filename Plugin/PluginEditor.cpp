// SPDX-License-Identifier: GPL-3.0-or-later
// Layout of the plug-in's window, and its update from the processor 25 times a second.
#include "PluginEditor.h"
#include "EditorParts.h"
#include "PluginFiles.h"
#include "PluginSettings.h"

namespace physvib {

namespace {

constexpr int framesPerSecond = 25; // few, because windows may be drawn in software
constexpr int barHeight = 50, groupsHeight = 124, statusHeight = 26, margin = 12;
constexpr int minWidth = 960, minHeight = 540, defaultWidth = 1180, defaultHeight = 700;

void dim(juce::Label& label) { label.setColour(juce::Label::textColourId, shade(label, Shade::muted)); }

void styleCaption(juce::Label& label, const juce::String& shown) {
    label.setText(shown, juce::dontSendNotification);
    label.setFont(text::font(text::small));
    label.setBorderSize({0, 0, 0, 0});
    label.setJustificationType(juce::Justification::centredRight);
}

/// A parameter's short name within its group's panel, whose heading has the rest.
std::string_view panelName(const ParameterRow& row) {
    switch (row.parameter) {
    case Parameter::law: return "Law";
    case Parameter::exponent: return "Exponent";
    case Parameter::strikeX: return "Shift x";
    case Parameter::strikeY: return "Shift y";
    case Parameter::musicSides: return "Channels";
    case Parameter::velocityCurve: return "Velocity";
    default: return row.name;
    }
}

/// A choice's text, short enough for a narrow list.
std::string_view panelChoice(std::string_view choice) {
    if (choice == "as the preset") return "preset";
    if (choice == "as the scene") return "scene";
    if (choice == "moves the place") return "place";
    if (choice == "left and right") return "L and R";
    return choice.substr(0, choice.find("tone")); // "12 semi"
}

} // namespace

ParameterControl::ParameterControl(HostParameter& parameter)
    : parameter_{parameter} {
    for (juce::Component* c : std::initializer_list<juce::Component*>{&knob_, &list_, &name_})
        c->addMouseListener(this, true);
    const auto& row = parameter.row();
    styleCaption(name_, fromUtf8(panelName(row)));
    name_.setMinimumHorizontalScale(0.75f);
    name_.setJustificationType(juce::Justification::centred);
    addAndMakeVisible(name_);
    if (!row.choices.empty()) {
        // a choice that repeats the one before is not listed
        const auto all = row.choices;
        const auto idOf = [all](std::string_view choice) {
            return 1 + static_cast<int>(std::ranges::find(all, choice) - all.begin());
        };
        for (int id = 1; const auto choice : all)
            if (id++ == idOf(choice)) list_.addItem(fromUtf8(panelChoice(choice)), idOf(choice));
        list_.setTitle(fromUtf8(row.name));
        list_.setTooltip(fromUtf8(row.help));
        addAndMakeVisible(list_);
        const auto last = static_cast<float>(all.size() - 1);
        listAttachment_ = std::make_unique<juce::ParameterAttachment>(parameter, [=, this](float place) {
            const auto& choice = all[static_cast<std::size_t>(juce::roundToInt(place * last))];
            list_.setSelectedId(idOf(choice), juce::dontSendNotification);
        });
        listAttachment_->sendInitialUpdate();
        list_.onChange = [this, last] {
            if (const int id = list_.getSelectedId(); id > 0)
                listAttachment_->setValueAsCompleteGesture(static_cast<float>(id - 1) / last);
        };
        return;
    }
    knob_.setSliderStyle(juce::Slider::RotaryHorizontalVerticalDrag);
    knob_.setColour(juce::Slider::textBoxOutlineColourId, juce::Colours::transparentBlack);
    knob_.setTextBoxStyle(juce::Slider::TextBoxBelow, false, 76, 20);
    knob_.setTitle(fromUtf8(row.name));
    knob_.setTooltip(fromUtf8(row.help));
    addAndMakeVisible(knob_);
    knobAttachment_ = std::make_unique<juce::SliderParameterAttachment>(parameter, knob_);
    knob_.setDoubleClickReturnValue(true, parameter.convertFrom0to1(parameter.getDefaultValue()));
}

// The component's children pass their mouse events on to it.
void ParameterControl::mouseDown(const juce::MouseEvent& e) {
    if (e.mods.isPopupMenu() && onMenu) onMenu(*this);
}

void ParameterControl::editValue() { knob_.showTextBox(); }

void ParameterControl::rename(int choice, const juce::String& text) {
    if (list_.getItemText(choice) == text) return;
    const bool isShown = list_.getSelectedItemIndex() == choice;
    list_.changeItemText(choice + 1, text);
    if (isShown) list_.setSelectedItemIndex(choice, juce::dontSendNotification);
}

void ParameterControl::resized() {
    auto area = getLocalBounds();
    name_.setBounds(area.removeFromTop(18));
    area.reduce(2, 0);
    knob_.setBounds(area);
    for (auto* const part : knob_.getChildren()) // its value needs all of a narrow knob's width
        if (auto* const value = dynamic_cast<juce::Label*>(part)) {
            value->setBorderSize({0, 0, 0, 0});
            value->setFont(text::font(getWidth() < 67 ? text::small : text::medium));
        }
    list_.setBounds(area.removeFromTop(28));
}

void ParameterControl::lookAndFeelChanged() { dim(name_); }

PluginEditor::PluginEditor(PluginProcessor& plugin)
    : AudioProcessorEditor{plugin}
    , plugin_{plugin}
    , silenceAttachment_{plugin.parameter(Parameter::bypass), silence_}
    , midiPanel_{editorActions(true)}
    , mix_{plugin, editorActions(false)}
    , keys_{[&plugin](int note, int velocity) { plugin.playKey(note, velocity); }} {
    setLookAndFeel(&look_);
    setOpaque(true);
    setWantsKeyboardFocus(true); // a click anywhere lets Esc silence; other keys are the host's
    title_.setText("PhysVib", juce::dontSendNotification);
    title_.setFont(text::font(text::large, juce::Font::bold));
    styleCaption(seedName_, "seed");
    styleCaption(stepsName_, "steps");
    status_.setFont(text::font(text::small));
    hintLabel_.setFont(text::font(text::medium));
    hintLabel_.setJustificationType(juce::Justification::centred);
    hintLabel_.setInterceptsMouseClicks(false, false);
    files_.setButtonText("Files");
    for (juce::Component* c : std::initializer_list<juce::Component*>{
             &title_, &scene_,     &layout_,    &files_,   &seedName_, &seed_,  &stepsName_,
             &steps_, &restart_,   &midi_,      &silence_, &direct_,   &tempo_, &fitOutputs_,
             &world_, &hintLabel_, &midiPanel_, &mix_,     &keys_,     &status_})
        addAndMakeVisible(c);
    mix_.onMenu = [this] { showMenu(makeMenu(plugin_.parameter(Parameter::level))); };
    addParameterControls();
    setUpControls();
    showMidi(false);
    stateChanged();
    setTheme(savedTheme());
    setResizable(true, true);
    setResizeLimits(minWidth, minHeight, 2400, 1600);
    const bool isSaved = state_.editorWidth >= minWidth && state_.editorHeight >= minHeight;
    setSize(isSaved ? state_.editorWidth : defaultWidth, isSaved ? state_.editorHeight : defaultHeight);
    startTimerHz(framesPerSecond);
}

PluginEditor::~PluginEditor() {
    stopTimer();
    if (hostWindow_ != nullptr) hostWindow_->removeKeyListener(this);
    setLookAndFeel(nullptr);
}

// Creates a control for each parameter but level (in the mix panel), bypass (the SILENCE button) and, without
// a side chain, those of music.
void PluginEditor::addParameterControls() {
    const bool hasMusic = plugin_.getBusCount(true) > 0;
    for (const auto& group : parameterGroups()) {
        if (group.parameters.front() == Parameter::beats && !hasMusic) continue;
        // timing is shown in the group "World"
        const bool isTime = group.parameters.front() == Parameter::timing;
        if (!isTime) groups_.push_back({group.name, {}});
        for (const auto which : group.parameters) {
            auto& controls = (isTime ? *std::ranges::find(groups_, std::string_view{"World"}, &Group::name)
                                     : groups_.back())
                                 .controls;
            controls.push_back(std::make_unique<ParameterControl>(plugin_.parameter(which)));
            addAndMakeVisible(*controls.back());
            controls.back()->onMenu = [this](ParameterControl& control) {
                std::function<void()> editValue;
                if (!control.isList()) editValue = [&control] { control.editValue(); };
                showMenu(makeMenu(control.parameter(), editValue));
            };
            if (which == Parameter::material || which == Parameter::noteMaterial)
                materialLists_.push_back(controls.back().get());
        }
    }
}

void PluginEditor::setUpControls() {
    fillPresets();
    for (int id = 1; const auto name : layoutPresetNames) layout_.addItem(fromUtf8(name), id++);
    for (const int steps : {50, 100, 200, 500, 1000}) steps_.addItem(juce::String{steps} + " /s", steps);
    scene_.setTitle("Instrument or world");
    layout_.setTitle("Layout");
    steps_.setTitle("Steps per second");
    steps_.setTooltip("How often the world is stepped: more lets hits be felt sooner");
    steps_.setEditableText(true);
    seed_.setTitle("Seed");
    seed_.setFont(text::font(text::medium));
    seed_.setIndents(8, 7);
    seed_.setInputRestrictions(10, "0123456789");
    restart_.setClickingTogglesState(true);
    restart_.setTooltip(
        "The scene starts at its seed whenever the transport starts or jumps, and is silent while it stands");
    tempo_.setClickingTogglesState(true);
    tempo_.setTooltip(
        "The same, and the scene's script and motors follow the host's tempo, from a beat on: at 120 "
        "a minute as the scene has them");
    direct_.setClickingTogglesState(true);
    direct_.setTooltip("Low-latency mode for notes: the host is told the limiter's latency only. Collisions "
                       "keep the output latency L, so they are felt later than the track beside them");
    fitOutputs_.setTooltip(
        "Place the actuators anew, as many as the host has outputs for, so that nothing is lost");
    fitOutputs_.onClick = [this] {
        message_.clear();
        plugin_.arrangeForOutputs();
    };
    files_.setTooltip("Open a preset, a scene, a layout or a saved session of your own (or drop it here); "
                      "save a preset; export what was felt");
    midi_.setTooltip("What notes and controllers do");
    silence_.setClickingTogglesState(true);
    silence_.setTooltip(fromUtf8(rowOf(Parameter::bypass).help));
    silence_.getProperties().set(stopProperty, true);
    silence_.onClick = [this] {
        if (!silence_.getToggleState()) plugin_.setStopped(false);
    };
    scene_.onChange = [this] {
        const int id = scene_.getSelectedId();
        if (id == 0) return;
        message_.clear();
        if (id < firstUserPreset)
            plugin_.choosePreset(id - 1);
        else
            open(presets_[static_cast<std::size_t>(id - firstUserPreset)]);
        stateChanged(); // the list shows what plays, not what could not be opened
    };
    layout_.onChange = [this] {
        if (const int i = layout_.getSelectedItemIndex(); i >= 0)
            edit([i](PluginState& s) {
                applyLayoutPreset(s, layoutPresetNames[static_cast<std::size_t>(i)]);
            });
    };
    steps_.onChange = [this] {
        const int steps = juce::jlimit(Simulation::minStepsPerSecond, Simulation::maxStepsPerSecond,
                                       steps_.getText().getIntValue());
        edit([steps](PluginState& s) { s.stepsPerSecond = steps; });
    };
    seed_.onReturnKey = seed_.onFocusLost = [this] {
        if (seed_.getText() == seedText()) return;
        edit([this](PluginState& s) {
            s.seed = static_cast<std::uint32_t>(
                std::min<juce::int64>(seed_.getText().getLargeIntValue(), 0xffffffff));
        });
    };
    const auto setTransportOnClick = [this](juce::Button& button, TransportMode on, TransportMode off) {
        button.onClick = [this, &button, on, off] {
            edit([&](PluginState& s) { s.transport = button.getToggleState() ? on : off; });
        };
    };
    setTransportOnClick(restart_, TransportMode::restartOnPlay, TransportMode::free);
    setTransportOnClick(tempo_, TransportMode::inTempo, TransportMode::restartOnPlay);
    direct_.onClick = [this] { edit([this](PluginState& s) { s.isDirect = direct_.getToggleState(); }); };
    files_.onClick = [this] { showMenu(makeFilesMenu(), &files_); };
    midi_.onClick = [this] { showMidi(!midiPanel_.isVisible()); };
}

// True if Esc only closes a list, a menu or a value box. A dialog is closed, and the output silenced as well.
bool PluginEditor::hasOpenPopup() {
    const auto* const modal = juce::Component::getCurrentlyModalComponent();
    return modal != nullptr && dynamic_cast<const juce::TopLevelWindow*>(modal) == nullptr;
}

juce::TextEditor* PluginEditor::openValueBox() const {
    const auto* const value = dynamic_cast<juce::Label*>(juce::Component::getCurrentlyModalComponent());
    return isParentOf(value) ? value->getCurrentTextEditor() : nullptr;
}

// Keys without a focus, as after a value was typed, reach the wrapper's window around this one.
void PluginEditor::listenToHostWindow() {
    if (auto* const peer = getPeer()) hostKeys_.setWindow(peer->getNativeHandle());
    if (auto* const around = getTopLevelComponent(); around != this && hostWindow_ == nullptr)
        (hostWindow_ = around)->addKeyListener(this);
}

// A value box gets keys before it has the focus (see refresh()). While any popup is open, the host gets none.
bool PluginEditor::keyPressed(const juce::KeyPress& key) {
    if (auto* const box = openValueBox()) return box->keyPressed(key);
    return juce::Component::getCurrentlyModalComponent() == nullptr &&
           !key.isKeyCode(juce::KeyPress::escapeKey) && hostKeys_.forward(x11KeySymbol(key.getKeyCode()));
}

EditorActions PluginEditor::editorActions(bool areChecked) {
    return {[this, areChecked](const std::function<void(PluginState&)>& change) {
                PluginState newState = plugin_.state();
                change(newState);
                if (const auto read = areChecked ? readPluginState(pluginStateJson(newState), "MIDI")
                                                 : Result<PluginState>{PluginState{}};
                    !read)
                    return report(fromUtf8(read.error));
                edit(change);
            },
            [this](const juce::String& message) { report(message); }};
}

void PluginEditor::edit(const std::function<void(PluginState&)>& change) {
    PluginState state = plugin_.state();
    change(state);
    message_.clear();
    plugin_.edit(std::move(state));
}

void PluginEditor::showMidi(bool on) {
    midiPanel_.setVisible(on);
    world_.setVisible(!on);
    midi_.setToggleState(on, juce::dontSendNotification);
}

void PluginEditor::setTheme(Theme theme) {
    look_.setTheme(theme);
    sendLookAndFeelChange();
    for (auto* const name : {&seedName_, &stepsName_}) dim(*name);
    seed_.applyColourToAllText(shade(*this, Shade::text));
    mix_.showState(state_);
    refreshControls();
}

void PluginEditor::updateMaterialNames() {
    const auto& materials = state_.scene.materials;
    for (auto* const list : materialLists_)
        for (std::size_t m = 1; m < rowOf(list->which()).choices.size(); ++m)
            list->rename(
                static_cast<int>(m),
                fromUtf8(rowOf(list->which()).choices[m]) +
                    (m <= materials.size() ? "  " + fromUtf8(materials[m - 1].name) : juce::String{}));
}

// Shows and hides controls by the state and the knobs, and updates the keyboard and the MIDI panel.
void PluginEditor::refreshControls() {
    shownKnobs_ = plugin_.noteKnobs();
    for (auto& group : groups_)
        for (auto& control : group.controls) {
            control->setVisible(isParameterUsed(state_, shownKnobs_, control->which()));
            control->resized(); // a new look recreates the value's label
        }
    keys_.showState(state_, shownKnobs_);
    auto adjusted = state_;
    adjusted.voice = adjustedVoice(state_.voice, shownKnobs_);
    midiPanel_.showState(adjusted);
    if (!getLocalBounds().isEmpty()) resized();
    repaint();
}

void PluginEditor::stateChanged() {
    shownStateVersion_ = plugin_.stateVersion();
    state_ = plugin_.state();
    const auto select = [](juce::ComboBox& box, const std::string& name) {
        box.setText(fromUtf8(name.empty() ? "(no name)" : name), juce::dontSendNotification);
        // what bears its name may be another: it acts when it is chosen again
        for (juce::PopupMenu::MenuItemIterator items{*box.getRootMenu()}; items.next();)
            items.getItem().action = items.getItem().itemID == box.getSelectedId() ? box.onChange : nullptr;
    };
    select(scene_, displayName(state_.scene.name));
    select(layout_, state_.layout.name);
    steps_.setText(juce::String{state_.stepsPerSecond} + " /s", juce::dontSendNotification);
    seed_.setText(seedText(), false);
    restart_.setToggleState(state_.transport != TransportMode::free, juce::dontSendNotification);
    tempo_.setToggleState(state_.transport == TransportMode::inTempo, juce::dontSendNotification);
    direct_.setToggleState(state_.isDirect, juce::dontSendNotification);
    const bool hasMotion = hasWorld(state_);
    for (auto* const c :
         std::initializer_list<juce::Component*>{&direct_, &tempo_, &stepsName_, &steps_, &seedName_, &seed_})
        c->setVisible(hasMotion);
    const auto value = [this](Parameter p) { return plugin_.parameter(p).value(); };
    world_.show(state_.scene);
    world_.show(state_.layout,
                makePanner(state_, lawFromValue(value(Parameter::law)), value(Parameter::exponent)));
    mix_.showState(state_);
    updateMaterialNames();
    refreshControls(); // places all anew: there may be more or fewer strips
}

void PluginEditor::refresh() {
    if (plugin_.stateVersion() != shownStateVersion_) stateChanged();
    if (plugin_.noteKnobs() != shownKnobs_) refreshControls();
    finishLearning();
    listenToHostWindow();
    if (auto* const box = openValueBox(); box && !box->hasKeyboardFocus(false)) {
        hostKeys_.grabKeyboard();
        box->grabKeyboardFocus();
    }
    const auto hits = plugin_.drainEvents();
    const auto meters = plugin_.meters();
    const auto status = plugin_.runs().status();
    previousSteppedBlocks_ = std::exchange(steppedBlocks_, status.blocksSteppedInRender);
    const int rate = std::max(1, plugin_.preparedRateHz());
    std::vector<BodyPose> poses;
    const auto posesNs = plugin_.runs().readPoses(poses);
    std::vector<CollisionEvent> playedNow;
    for (const auto& hit : hits) playedNow.push_back(hit.played.event);
    world_.update({std::move(poses), posesNs, plugin_.runs().outputLatencyFrames() * 1'000'000'000 / rate,
                   playedNow, meters.peaks});
    mix_.update(meters);
    const int outputs = plugin_.outputCount();
    fitOutputs_.setVisible(outputs > 0 && outputText(meters).isNotEmpty());
    fitOutputs_.setButtonText("Use " + juce::String{outputs});
    const bool isSilent = plugin_.isStopped() || plugin_.parameter(Parameter::bypass).value() > 0.5;
    silence_.setToggleState(isSilent, juce::dontSendNotification);
    hintLabel_.setColour(juce::Label::backgroundColourId,
                         shade(*this, Shade::panel).withAlpha(state_.scene.bodies.empty() ? 0.0f : 0.9f));
    const bool isWaiting = state_.transport != TransportMode::free && meters.actuatorCount == 0;
    hintLabel_.setVisible(
        world_.isVisible() &&
        (isSilent || isWaiting || (state_.scene.bodies.empty() && status.session.render.played == 0)));
    if (hintLabel_.isVisible())
        showHint(isSilent    ? "SILENT. Press SILENCE again to feel what is played."
                 : isWaiting ? "Waits for play: start the host's transport (Restart on play is on)."
                             : "Press a key below, or play a note: you feel it at its place.\n"
                               "The list at the upper left has other instruments, and worlds.\n"
                               "Press SILENCE to stop everything at once.");
    auto errorText = plugin_.errorText();
    if (plugin_.hasRefusedChunk())
        errorText << " - the host's session keeps it until something is edited here";
    if (errorText.isEmpty()) errorText = message_;
    status_.setColour(juce::Label::textColourId,
                      errorText.isEmpty() ? shade(*this, Shade::muted) : shade(*this, Shade::limit));
    if (errorText.isEmpty()) {
        errorText = findHelp(juce::Desktop::getInstance().getMainMouseSource().getComponentUnderMouse());
        if (errorText.isEmpty()) errorText = statusLine(status, meters);
    }
    status_.setText(errorText, juce::dontSendNotification);
}

// Places the hint near the middle where it covers no actuator; only its first line if there is no room.
void PluginEditor::showHint(const juce::String& text) {
    const auto tryToPlace = [this](const juce::String& shown, int y, bool anywhere = false) {
        const int lines = juce::StringArray::fromLines(shown).size();
        const auto at = world_.getLocalBounds().withSizeKeepingCentre(420, 6 + 15 * lines).translated(0, y);
        const auto around = at.toFloat().expanded(4.0f);
        const auto covers = [&](const auto& badge) { return badge.intersects(around); };
        if (!anywhere && std::ranges::any_of(world_.badges(), covers)) return false;
        hintLabel_.setText(shown, juce::dontSendNotification);
        hintLabel_.setBounds(at + world_.getPosition());
        return true;
    };
    const auto first = text.upToFirstOccurrenceOf("\n", false, false);
    for (const auto& shown : {text, first})
        for (int y = 0; y < world_.getHeight() / 2 - 30; y += 4)
            if (tryToPlace(shown, -y) || tryToPlace(shown, y)) return;
    tryToPlace(first, 0, true);
}

juce::String PluginEditor::findHelp(juce::Component* underMouse) const {
    if (!isParentOf(underMouse)) return {};
    for (; underMouse != this; underMouse = underMouse->getParentComponent())
        if (auto* const client = dynamic_cast<juce::TooltipClient*>(underMouse))
            if (const auto help = client->getTooltip(); help.isNotEmpty()) return help;
    return {};
}

// Describes the output latency: a block and the stepping thread, two steps of the world, and the limiter.
juce::String PluginEditor::latencyText() const {
    const int rate = plugin_.preparedRateHz();
    const auto ms = [rate](std::int64_t frames) {
        return juce::String{1e3 * static_cast<double>(frames) / rate, 1} + " ms";
    };
    const auto& runs = plugin_.runs();
    const std::int64_t all = runs.outputLatencyFrames(), limiter = HapticRenderer::latencyFramesAt(rate),
                       steps = hasWorld(state_)
                                   ? std::min<std::int64_t>(all - limiter, 2 * rate / state_.stepsPerSecond)
                                   : 0,
                       buffering = all - limiter - steps;
    juce::String line = "felt " + ms(all) + (steps > 0 ? " after the contact: " : " after the note: ");
    if (buffering > 0) line << ms(buffering) << (steps == 0 ? " to detect beats + " : " block and thread + ");
    if (steps > 0) line << ms(steps) << " two steps + ";
    line << ms(limiter) << " limiter";
    if (runs.isDirect() && runs.latencyFrames() != all)
        line << ", strikes " << ms(runs.latencyFrames()) << " after the note (reported to the host)";
    else
        line << " (reported to the host)";
    return line;
}

juce::String PluginEditor::outputText(const ChannelMeters& meters) const {
    const int actuators = actuatorCount(state_);
    if (meters.actuatorCount == 0 || meters.connectedCount >= actuators) return {}; // 0: no run yet
    juce::StringArray unconnected;
    for (int j = 0; j < actuators; ++j)
        if (const auto index = static_cast<std::size_t>(j); !meters.isConnected[index])
            unconnected.add(fromUtf8(state_.layout.actuators[index].label));
    return "   |   " + juce::String{meters.connectedCount} + " outputs for " + juce::String{actuators} +
           " actuators: not felt " + unconnected.joinIntoString(", ");
}

juce::String PluginEditor::statusLine(const RunsStatus& status, const ChannelMeters& meters) const {
    if (plugin_.preparedRateHz() == 0 || plugin_.runs().outputLatencyFrames() == 0)
        return "The host has not started the plug-in yet.";
    const auto& r = status.session.render;
    juce::String line = latencyText() + outputText(meters);
    if (status.blocksSteppedInRender > previousSteppedBlocks_)
        line << "   |   the host waits for the world (ahead of time, or the world is too heavy)";
    if (const auto* music = plugin_.getBus(true, 0);
        music && !music->isEnabled() &&
        (plugin_.parameter(Parameter::beats).value() > 0.0 ||
         gainFromLevelDb(plugin_.parameter(Parameter::music).value()) > 0.0))
        line << "   |   no beats and no music: the side chain is off";
    const auto count = [&line](std::uint64_t n, const char* what) {
        if (n > 0) line << "   |   " << juce::String{static_cast<juce::int64>(n)} << what;
    };
    count(status.late, " impacts felt late");
    count(r.rejected + status.session.refused, " impacts left out");
    count(plugin_.displacedMessages(), " notes came late from the host");
    count(static_cast<std::uint64_t>(status.stalledNs) / 1'000'000, " ms the world stood still");
    count(status.delayedBlocks, " blocks until it could start");
    return line;
}

void PluginEditor::paint(juce::Graphics& g) {
    g.fillAll(shade(*this, Shade::background));
    for (const auto& group : groups_) {
        if (!group.isShown()) continue;
        fillPanel(g, *this, group.bounds);
        g.setColour(shade(*this, Shade::text));
        g.setFont(text::font(text::small, juce::Font::bold));
        g.drawText(fromUtf8(group.name), group.bounds.reduced(14, 8).removeFromTop(16),
                   juce::Justification::centredLeft, false);
    }
}

void PluginEditor::resized() {
    if (getWidth() >= minWidth) plugin_.setEditorSize(getWidth(), getHeight());
    auto area = getLocalBounds().reduced(margin, 0);
    auto bar = area.removeFromTop(barHeight).reduced(0, 10);
    auto foot = area.removeFromBottom(statusHeight);
    foot.removeFromRight(margin); // where the window is resized
    fitOutputs_.setBounds(foot.removeFromRight(92).reduced(4, 2));
    status_.setBounds(foot);
    const auto placeLeft = [&bar](juce::Component& c, int width, int space = panelGap) {
        if (!c.isVisible()) return;
        c.setBounds(bar.removeFromLeft(width)), bar.removeFromLeft(space);
    };
    silence_.setBounds(bar.removeFromRight(92));
    bar.removeFromRight(panelGap);
    placeLeft(title_, 88);
    placeLeft(scene_, std::min(170, bar.getWidth() - 612)); // the others take as much
    placeLeft(layout_, 84);
    placeLeft(files_, 44);
    placeLeft(midi_, 44);
    placeLeft(seedName_, 30, 4);
    placeLeft(seed_, 48);
    placeLeft(stepsName_, 34, 4);
    placeLeft(steps_, 68);
    placeLeft(restart_, 94, 4);
    placeLeft(tempo_, 52, 4);
    placeLeft(direct_, 50, 0);
    keys_.setBounds(area.removeFromBottom(KeyboardPanel::height));
    area.removeFromBottom(panelGap);
    auto controls = area.removeFromBottom(groupsHeight);
    area.removeFromBottom(panelGap);
    placeGroups(controls);
    mix_.setBounds(area.removeFromRight(std::min(mix_.preferredWidth(), area.getWidth() / 2)));
    area.removeFromRight(panelGap);
    world_.setBounds(area);
    midiPanel_.setBounds(world_.getBounds());
}

std::vector<PluginEditor::Group::Column> PluginEditor::Group::columns() const {
    std::vector<Column> columns;
    for (const auto& control : controls) {
        if (!control->isVisible()) continue;
        const bool isBelow = control->isList() && !columns.empty() && columns.back().size() == 1 &&
                             columns.back().front()->isList();
        if (!isBelow) columns.emplace_back();
        columns.back().push_back(control.get());
    }
    return columns;
}

// Places the groups side by side, as wide as their controls require.
void PluginEditor::placeGroups(juce::Rectangle<int> controls) {
    const auto sharesOf = [](const Group& group) {
        int shares = 0;
        for (const auto& column : group.columns()) shares += column.front()->widthShares();
        return shares;
    };
    int all = 0;
    Group* last = nullptr;
    int gaps = -panelGap;
    for (auto& group : groups_)
        if (group.isShown()) last = &group, all += sharesOf(group), gaps += panelGap;
    const int width = controls.getWidth() - gaps;
    for (auto& group : groups_) {
        if (!group.isShown()) continue;
        const int shares = sharesOf(group);
        group.bounds = &group == last ? controls : controls.removeFromLeft(width * shares / all);
        controls.removeFromLeft(panelGap);
        auto places = group.bounds.reduced(6, 6).withTrimmedTop(18);
        const int inside = places.getWidth();
        for (const auto& column : group.columns()) {
            auto place = places.removeFromLeft(inside * column.front()->widthShares() / shares);
            const int height = place.getHeight() / static_cast<int>(column.size());
            for (auto* const control : column) control->setBounds(place.removeFromTop(height));
        }
    }
}

} // namespace physvib

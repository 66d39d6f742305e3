// SPDX-License-Identifier: GPL-3.0-or-later
// Places, choices, and what is asked of the processor 25 times a second.
#include "PluginEditor.h"
#include "Files/SceneCatalogue.h"
#include "Host/Palette.h"

namespace physvib {

namespace {

constexpr int framesPerSecond = 25; // a software renderer has other things to do
constexpr int barHeight = 46, controlsHeight = 118, statusHeight = 26, metersWidth = 230;

juce::String words(std::string_view utf8) { return juce::String::fromUTF8(utf8.data(), static_cast<int>(utf8.size())); }

} // namespace

ParameterControl::ParameterControl(HostParameter& parameter) {
    const auto& row = parameter.row();
    name_.setText(words(row.name), juce::dontSendNotification);
    name_.setJustificationType(juce::Justification::centred);
    name_.setFont(juce::Font{text::small});
    name_.setColour(juce::Label::textColourId, palette::muted);
    addAndMakeVisible(name_);
    if (row.scale == ParameterScale::toggle) {
        button_.setButtonText("SILENCE");
        button_.setClickingTogglesState(true);
        button_.getProperties().set(stopProperty, true);
        button_.setTooltip(words(row.help));
        addAndMakeVisible(button_);
        buttonAttachment_ = std::make_unique<juce::ButtonParameterAttachment>(parameter, button_);
        return;
    }
    knob_.setSliderStyle(juce::Slider::RotaryHorizontalVerticalDrag);
    knob_.setColour(juce::Slider::textBoxOutlineColourId, juce::Colours::transparentBlack); // asked for when the box is made
    knob_.setTextBoxStyle(juce::Slider::TextBoxBelow, false, 92, 20);
    knob_.setTooltip(words(row.help));
    addAndMakeVisible(knob_);
    knobAttachment_ = std::make_unique<juce::SliderParameterAttachment>(parameter, knob_);
    knob_.setDoubleClickReturnValue(true, parameter.convertFrom0to1(parameter.getDefaultValue()));
}

void ParameterControl::resized() {
    auto area = getLocalBounds().reduced(2);
    name_.setBounds(area.removeFromTop(20));
    knob_.setBounds(area);
    button_.setBounds(area.reduced(6, std::max(0, area.getHeight() / 2 - 24)));
}

PluginEditor::PluginEditor(PluginProcessor& plugin)
    : AudioProcessorEditor{plugin}
    , plugin_{plugin} {
    setLookAndFeel(&look_);
    setOpaque(true);
    title_.setText("PhysVib", juce::dontSendNotification);
    title_.setFont(juce::Font{text::large, juce::Font::bold});
    seedName_.setText("Seed", juce::dontSendNotification);
    status_.setFont(juce::Font{text::medium});
    for (juce::Component* c : std::initializer_list<juce::Component*>{&title_, &scene_, &layout_, &seedName_, &seed_, &restart_, &world_, &meters_, &status_}) addAndMakeVisible(c);
    for (std::size_t i = 0; i < parameterCount; ++i) {
        controls_.push_back(std::make_unique<ParameterControl>(plugin.parameter(static_cast<Parameter>(i))));
        addAndMakeVisible(*controls_.back());
    }
    fillChoices();
    takeState();
    setResizable(true, true);
    setResizeLimits(720, 460, 2400, 1600);
    setSize(1040, 640);
    startTimerHz(framesPerSecond);
}

PluginEditor::~PluginEditor() {
    stopTimer();
    setLookAndFeel(nullptr);
}

void PluginEditor::fillChoices() {
    for (int id = 1; const auto& scene : builtInScenes()) scene_.addItem(words(scene.name), id++);
    for (int id = 1; const auto name : layoutPresetNames) layout_.addItem(words(name), id++);
    seed_.setInputRestrictions(10, "0123456789");
    scene_.onChange = [this] { edit([this](PluginState& s) { s.scene = builtInScenes()[static_cast<std::size_t>(scene_.getSelectedItemIndex())]; }); };
    layout_.onChange = [this] { edit([this](PluginState& s) { s.layout = presetLayout(layoutPresetNames[static_cast<std::size_t>(layout_.getSelectedItemIndex())]); }); };
    seed_.onReturnKey = [this] { edit([this](PluginState& s) { s.seed = static_cast<std::uint32_t>(std::min<juce::int64>(seed_.getText().getLargeIntValue(), 0xffffffff)); }); };
    restart_.onClick = [this] { edit([this](PluginState& s) { s.transport = restart_.getToggleState() ? TransportMode::restartOnPlay : TransportMode::free; }); };
}

template <class Change>
void PluginEditor::edit(Change change) {
    PluginState state = plugin_.state();
    change(state);
    plugin_.edit(std::move(state));
}

void PluginEditor::takeState() {
    shown_ = plugin_.stateCount();
    state_ = plugin_.state();
    const auto select = [](juce::ComboBox& box, const std::string& name) { // a scene or layout of one's own is its name only
        const auto shown = words(name);
        box.setText(shown.isEmpty() ? juce::String{"(no name)"} : shown, juce::dontSendNotification);
    };
    select(scene_, state_.scene.name);
    select(layout_, state_.layout.name);
    seed_.setText(juce::String{static_cast<juce::int64>(state_.seed)}, false);
    restart_.setToggleState(state_.transport == TransportMode::restartOnPlay, juce::dontSendNotification);
    const auto value = [this](Parameter p) { return plugin_.parameter(p).value(); };
    world_.show(state_.scene);
    world_.show(state_.layout, {state_.layout.geometry, static_cast<PanningLaw>(value(Parameter::law)), value(Parameter::exponent), state_.scene.fieldWidthMetres, state_.scene.fieldHeightMetres});
}

void PluginEditor::refresh() {
    if (plugin_.stateCount() != shown_) takeState();
    const auto hits = plugin_.takes().takeLog();
    const auto meters = plugin_.meters();
    const auto status = plugin_.takes().status();
    played_ = status.session.render.played;
    const int rate = std::max(1, plugin_.preparedRateHz());
    std::vector<BodyPose> poses;
    const auto at = plugin_.takes().poses(poses);
    std::vector<CollisionEvent> felt;
    for (const auto& hit : hits) felt.push_back(hit.played.event);
    world_.update({std::move(poses), at, plugin_.takes().playOutFrames() * 1'000'000'000 / rate, felt, meters.peaks});
    meters_.update(meters, state_.layout);
    auto trouble = plugin_.trouble();
    if (plugin_.keepsRefused()) trouble << " - the host's session keeps it until something is edited here";
    status_.setColour(juce::Label::textColourId, trouble.isEmpty() ? shade(*this, Shade::muted) : shade(*this, Shade::limit));
    status_.setText(trouble.isEmpty() ? statusLine(status, meters) : trouble, juce::dontSendNotification);
}

juce::String PluginEditor::statusLine(const TakesStatus& status, const ChannelMeters& meters) const {
    const int rate = plugin_.preparedRateHz(), enchanters = enchantersOf(state_);
    if (rate == 0 || plugin_.takes().playOutFrames() == 0) return "The host has not started the plug-in yet.";
    const auto& r = status.session.render;
    const auto ms = [rate](std::int64_t frames) { return juce::String{1e3 * static_cast<double>(frames) / rate, 1} + " ms"; };
    juce::String line = "felt " + ms(plugin_.takes().playOutFrames()) + " after the contact (told to the host)";
    if (status.burstFrames > 0) line << ", " << ms(status.burstFrames) << " of it as the host asks ahead of time";
    if (status.waitedFrames > 0) line << ": it came during this run, which is not the bounce before that";
    if (meters.connected < enchanters) line << "   |   " << meters.connected << " of " << enchanters << " connected";
    line << "   |   take " << status.take << "   |   " << juce::String{static_cast<juce::int64>(r.played)} << " played, "
         << juce::String{static_cast<juce::int64>(status.late)} << " late, " << juce::String{static_cast<juce::int64>(r.rejected + status.session.refused)} << " refused";
    if (status.slippedNs > 0) line << ", " << juce::String{static_cast<double>(status.slippedNs) * 1e-6, 1} << " ms of stalls";
    if (status.delayedBlocks > 0) line << ", " << juce::String{static_cast<juce::int64>(status.delayedBlocks)} << " blocks of delayed starts";
    return line;
}

void PluginEditor::paint(juce::Graphics& g) { g.fillAll(shade(*this, Shade::ground)); }

void PluginEditor::resized() {
    auto area = getLocalBounds().reduced(12, 6);
    auto bar = area.removeFromTop(barHeight).reduced(0, 9);
    status_.setBounds(area.removeFromBottom(statusHeight));
    auto controls = area.removeFromBottom(controlsHeight).withTrimmedTop(8);
    title_.setBounds(bar.removeFromLeft(104));
    scene_.setBounds(bar.removeFromLeft(170));
    layout_.setBounds(bar.withTrimmedLeft(10).removeFromLeft(110));
    bar.removeFromLeft(130);
    seedName_.setBounds(bar.removeFromLeft(48));
    seed_.setBounds(bar.removeFromLeft(96));
    restart_.setBounds(bar.withTrimmedLeft(14).removeFromLeft(150));
    const int width = controls.getWidth() / static_cast<int>(controls_.size());
    for (auto& c : controls_) c->setBounds(controls.removeFromLeft(width));
    meters_.setBounds(area.removeFromRight(metersWidth));
    world_.setBounds(area.withTrimmedRight(8));
}

} // namespace physvib

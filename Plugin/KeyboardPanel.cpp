// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the keyboard: keys, their marks and labels.
#include "KeyboardPanel.h"
#include "EditorParts.h"
#include "MidiPanel.h"
#include <algorithm>

namespace physvib {

namespace {

constexpr int captionPixels = 20;

bool isBlackKey(int note) { return juce::MidiMessage::isMidiNoteBlack(note); }

/// How many white keys lie below.
int whiteKeysBelow(int note) {
    int count = 0;
    for (int n = KeyboardPanel::lowest; n < note; ++n) count += isBlackKey(n) ? 0 : 1;
    return count;
}

const NoteRule* ruleOf(int note, const PluginState& state) {
    const auto found = std::ranges::find(state.notes, note, &NoteRule::note);
    return found == state.notes.end() ? nullptr : &*found;
}

bool doesNothing(int note, const MidiTable& table, const PluginState& state, const NoteKnobs& knobs) {
    return table.groupOf(note) < 0 && table.strikeOf(note, knobs, state.layout.geometry).frequencyHz <= 0.0;
}

} // namespace

juce::String wordsOfKey(int note, const MidiTable& table, const PluginState& state, const NoteKnobs& knobs) {
    const juce::String name = juce::MidiMessage::getMidiNoteName(note, true, true, 4) + ": ";
    const NoteRule* const rule = ruleOf(note, state);
    if (rule && table.groupOf(note) >= 0) return name + wordsOf(*rule, state.scene);
    if (doesNothing(note, table, state, knobs))
        return name + "silent, as the scene has no material that vibrates";
    const CollisionEvent sound = table.strikeOf(note, knobs, state.layout.geometry);
    const auto percent = [](double part, double whole) { return number(100.0 * part / whole, 0) + " %"; };
    juce::String text =
        name +
        (rule ? words(state.scene.materials[static_cast<std::size_t>(rule->material)].name) + ", "
              : juce::String{}) +
        number(sound.frequencyHz, 0) + " Hz, ";
    text << percent(sound.x, table.fieldWidthMetres()) << " from the left, "
         << percent(sound.y, table.fieldHeightMetres()) << " from below";
    return table.isHeld(note, knobs) ? text + ", as long as it is held" : text;
}

KeyboardPanel::KeyboardPanel(std::function<void(int, int)> play)
    : play_{std::move(play)} {
    setTitle("Keyboard");
}

void KeyboardPanel::take(const PluginState& state, const NoteKnobs& knobs) {
    state_ = state;
    knobs_ = knobs;
    table_ = MidiTable{state};
    repaint();
}

juce::Rectangle<float> KeyboardPanel::boundsOf(int note) const {
    const auto keys = getLocalBounds().reduced(panelInset, 6).withTrimmedTop(captionPixels).toFloat();
    const float width = keys.getWidth() / static_cast<float>(whiteKeysBelow(highest + 1)),
                left = keys.getX() + width * static_cast<float>(whiteKeysBelow(note));
    if (isBlackKey(note)) return {left - 0.3f * width, keys.getY(), 0.6f * width, 0.6f * keys.getHeight()};
    return {left, keys.getY(), width - 1.0f, keys.getHeight()};
}

int KeyboardPanel::noteAt(juce::Point<int> place) const {
    int found = -1;
    for (int note = lowest; note <= highest; ++note)
        if ((found < 0 || isBlackKey(note) || !isBlackKey(found)) && boundsOf(note).contains(place.toFloat()))
            found = note;
    return found;
}

int KeyboardPanel::velocityAt(juce::Point<int> place) const {
    const int note = noteAt(place);
    if (note < 0) return 0;
    const auto key = boundsOf(note);
    return juce::jlimit(
        1, 127,
        juce::roundToInt(30.0f + 97.0f * (static_cast<float>(place.y) - key.getY()) / key.getHeight()));
}

void KeyboardPanel::press(juce::Point<int> place) {
    const int note = noteAt(place);
    show(note);
    if (note == pressed_) return;
    letGo();
    if (note < 0) return;
    pressed_ = note;
    play_(note, velocityAt(place));
    repaint();
}

void KeyboardPanel::letGo() {
    if (pressed_ < 0) return;
    play_(pressed_, 0);
    pressed_ = -1;
    repaint();
}

void KeyboardPanel::show(int note) {
    if (note == shown_) return;
    shown_ = note;
    repaint();
}

void KeyboardPanel::paintKey(juce::Graphics& g, int note) const {
    const auto key = boundsOf(note);
    const bool isBlack = isBlackKey(note);
    auto colour = isBlack ? juce::Colour{0xff24262b} : juce::Colour{0xffe9e9ea};
    if (note == pressed_) colour = shade(*this, Shade::accent);
    g.setColour(doesNothing(note, table_, state_, knobs_) ? colour.withMultipliedAlpha(0.35f) : colour);
    g.fillRoundedRectangle(key, 2.0f);
    g.setColour(shade(*this, Shade::line)); // white keys on a light ground
    g.drawRoundedRectangle(key, 2.0f, 1.0f);
    if (ruleOf(note, state_)) {
        g.setColour(shade(*this, Shade::accent));
        g.fillRoundedRectangle(key.withTop(key.getBottom() - 5.0f).reduced(2.0f, 0.0f), 1.5f);
    }
    if (note % 12 != 0) return;
    g.setColour(juce::Colour{0xff5a5d66});
    g.setFont(juce::Font{10.0f});
    g.drawText(juce::MidiMessage::getMidiNoteName(note, true, true, 4),
               key.withTrimmedBottom(6.0f).removeFromBottom(12.0f).expanded(4.0f, 0.0f),
               juce::Justification::centred, false);
}

void KeyboardPanel::paint(juce::Graphics& g) {
    fillPanel(g, *this, getLocalBounds());
    const juce::String usual = "Keyboard: click a key to feel it, lower on the key is harder. Marked keys "
                               "have a rule of their own (MIDI).";
    g.setColour(shade(*this, shown_ < 0 ? Shade::muted : Shade::text));
    g.setFont(juce::Font{text::small});
    g.drawText(shown_ < 0 ? usual : wordsOfKey(shown_, table_, state_, knobs_),
               getLocalBounds().reduced(panelInset, 3).removeFromTop(captionPixels),
               juce::Justification::centredLeft, true);
    for (const bool isBlack : {false, true})
        for (int note = lowest; note <= highest; ++note)
            if (isBlackKey(note) == isBlack) paintKey(g, note);
}

} // namespace physvib

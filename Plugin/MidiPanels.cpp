// SPDX-License-Identifier: GPL-3.0-or-later
// The list of MIDI rules with a form for each kind (the state reader checks the input), and the keyboard.
#include "EditorPanels.h"
#include "EditorParts.h"
#include <algorithm>

namespace physvib {
namespace {

constexpr int rowPixels = 30;

juce::String percent(double share) { return number(100.0 * share, 0) + " %"; }
juce::String noteName(int note) { return juce::MidiMessage::getMidiNoteName(note, true, true, 4); }

template <class List, class Name>
juce::StringArray namesIn(const List& list, Name name) {
    juce::StringArray names;
    for (const auto& item : list) names.add(fromUtf8(item.*name));
    return names;
}

void addChoice(juce::AlertWindow& form, const juce::String& id, const juce::StringArray& choices, int chosen,
               const juce::String& title) {
    form.addComboBox(id, choices, title);
    form.getComboBoxComponent(id)->setSelectedItemIndex(std::max(0, chosen), juce::dontSendNotification);
}

double readNumber(juce::AlertWindow& form, const juce::String& id) {
    return form.getTextEditorContents(id).getDoubleValue();
}

} // namespace

juce::String describe(const NoteRule& rule, const Scene& scene) {
    const auto at = " at " + percent(rule.x) + ", " + percent(rule.y);
    const auto vector = number(rule.atFullVelocity.x, 1) + ", " + number(rule.atFullVelocity.y, 1);
    if (rule.kind == NoteKind::push) return "pushes " + fromUtf8(rule.object) + " by " + vector + " N s";
    const auto& material = fromUtf8(scene.materials[static_cast<std::size_t>(rule.material)].name);
    if (rule.kind == NoteKind::strike) return "strikes " + material + at;
    return "spawns a disc of " + material + at + ", radius " + number(rule.radiusMetres, 2) + " m, " +
           vector + " m/s";
}

juce::String describe(const ControllerRule& rule) {
    const int which = findParameter(rule.parameter);
    return "moves " +
           (which < 0 ? fromUtf8(rule.parameter) : fromUtf8(rowOf(static_cast<Parameter>(which)).name)) +
           " over its whole range";
}

MidiPanel::MidiPanel(EditorActions actions)
    : actions_{std::move(actions)} {
    setTitle("Notes and controllers");
    title_.setText("Notes and controllers", juce::dontSendNotification);
    title_.setFont(text::font(text::medium, juce::Font::bold));
    hint_.setFont(text::font(text::small));
    list_.setRowHeight(rowPixels);
    addNote_.onClick = [this] { showNoteForm(-1, {.note = 60}); };
    addController_.onClick = [this] { showControllerForm(-1, {1, std::string{rowOf(Parameter::level).id}}); };
    change_.onClick = [this] { change(list_.getSelectedRow()); };
    remove_.onClick = [this] { remove(list_.getSelectedRow()); };
    for (juce::Component* c : std::initializer_list<juce::Component*>{&title_, &hint_, &list_, &addNote_,
                                                                      &addController_, &change_, &remove_})
        addAndMakeVisible(c);
    updateButtons();
}

void MidiPanel::showState(const PluginState& state) {
    state_ = state;
    const juce::String sound = state.voice.pitch == NotePitch::material ? "every octave is a material"
                               : state.voice.isHeld ? "each its own pitch, as long as its key is held"
                                                    : "each its own pitch";
    const juce::String place = state.voice.placement == NotePlacement::octave ? "from left (C) to right (B)"
                               : state.voice.placement == NotePlacement::actuators
                                   ? "at one actuator after the other"
                                   : "in the middle";
    hint_.setText("Other notes strike: " + sound + ", " + place + ".", juce::dontSendNotification);
    hint_.setColour(juce::Label::textColourId, shade(*this, Shade::muted));
    list_.updateContent();
    list_.repaint();
    updateButtons();
}

void MidiPanel::updateButtons() {
    const bool isChosen = list_.getSelectedRow() >= 0 && list_.getSelectedRow() < getNumRows();
    change_.setEnabled(isChosen);
    remove_.setEnabled(isChosen);
}

// The note or controller, and a description of its rule.
std::pair<juce::String, juce::String> MidiPanel::describeRow(int row) const {
    if (isNoteRow(row)) return {noteName(noteIn(row).note), describe(noteIn(row), state_.scene)};
    return {"CC " + juce::String{controllerIn(row).controller}, describe(controllerIn(row))};
}

juce::String MidiPanel::getNameForRow(int row) {
    if (row < 0 || row >= getNumRows()) return {};
    const auto [key, description] = describeRow(row);
    return key + " " + description;
}

void MidiPanel::paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) {
    if (row >= getNumRows()) return;
    if (isSelected) {
        g.setColour(shade(*this, Shade::accent).withAlpha(0.16f));
        g.fillRect(0, 0, width, height);
    }
    auto area = juce::Rectangle<int>{width, height}.reduced(10, 0);
    const auto [key, description] = describeRow(row);
    g.setFont(text::font(text::medium, juce::Font::bold));
    g.setColour(shade(*this, Shade::accent));
    g.drawText(key, area.removeFromLeft(64), juce::Justification::centredLeft, false);
    g.setFont(text::font(text::medium));
    g.setColour(shade(*this, Shade::text));
    g.drawText(description, area, juce::Justification::centredLeft, true);
}

void MidiPanel::change(int row) {
    if (row < 0 || row >= getNumRows()) return;
    if (isNoteRow(row))
        showNoteForm(noteIn(row).note, noteIn(row));
    else
        showControllerForm(controllerIn(row).controller, controllerIn(row));
}

void MidiPanel::remove(int row) {
    if (row < 0 || row >= getNumRows()) return;
    actions_.edit([this, row](PluginState& state) {
        if (isNoteRow(row))
            std::erase(state.notes, noteIn(row));
        else
            std::erase(state.controllers, controllerIn(row));
    });
}

// This panel owns the form, because a host may close the window before the user answers.
juce::AlertWindow& MidiPanel::newForm(const juce::String& title) {
    form_ =
        std::make_unique<juce::AlertWindow>(title, juce::String{}, juce::MessageBoxIconType::NoIcon, this);
    form_->setLookAndFeel(&getLookAndFeel());
    return *form_;
}

void MidiPanel::showForm(std::function<void(juce::AlertWindow&)> onAccept) {
    form_->addButton("OK", 1, juce::KeyPress{juce::KeyPress::returnKey});
    form_->addButton("Cancel", 0, juce::KeyPress{juce::KeyPress::escapeKey});
    form_->enterModalState(
        true, juce::ModalCallbackFunction::create([panel = juce::Component::SafePointer<MidiPanel>{this},
                                                   onAccept = std::move(onAccept)](int answer) {
            if (panel == nullptr || panel->form_ == nullptr) return;
            if (answer == 1) onAccept(*panel->form_);
            panel->form_->setVisible(false);
        }));
}

void MidiPanel::showNoteForm(int replaced, NoteRule rule) {
    const auto bodies = namesIn(state_.scene.bodies, &BodyDescription::name);
    auto& form = newForm("A note");
    form.addTextEditor("note", juce::String{rule.note}, "Note, 0 to 127 (60 is C4)");
    addChoice(form, "do", {"strikes a material at a place", "pushes a body", "spawns a disc at a place"},
              static_cast<int>(rule.kind), "What it does");
    addChoice(form, "material", namesIn(state_.scene.materials, &Material::name), rule.material,
              "Material (strikes, spawns)");
    addChoice(form, "object", bodies, bodies.indexOf(fromUtf8(rule.object)), "Body (pushes)");
    form.addTextEditor("x", juce::String{100.0 * rule.x}, "Place from the left, % (strikes, spawns)");
    form.addTextEditor("y", juce::String{100.0 * rule.y}, "Place from below, %");
    form.addTextEditor("vx", juce::String{rule.atFullVelocity.x},
                       "At full velocity to the right: N s (pushes), m/s (spawns)");
    form.addTextEditor("vy", juce::String{rule.atFullVelocity.y}, "At full velocity upwards");
    form.addTextEditor("radius", juce::String{rule.radiusMetres}, "Radius in m (spawns)");
    showForm([this, replaced, rule](juce::AlertWindow& answers) mutable {
        rule.note = answers.getTextEditorContents("note").getIntValue();
        rule.kind = static_cast<NoteKind>(answers.getComboBoxComponent("do")->getSelectedItemIndex());
        const auto material = answers.getComboBoxComponent("material")->getText();
        const int found = namesIn(state_.scene.materials, &Material::name).indexOf(material);
        if (rule.kind != NoteKind::push && found < 0)
            return actions_.report("The scene has no material " + material);
        rule.material = std::max(0, found);
        rule.object = answers.getComboBoxComponent("object")->getText().toStdString();
        rule.x = 0.01 * readNumber(answers, "x");
        rule.y = 0.01 * readNumber(answers, "y");
        rule.atFullVelocity = {readNumber(answers, "vx"), readNumber(answers, "vy")};
        rule.radiusMetres = readNumber(answers, "radius");
        storeRule(replaced, rule);
    });
}

void MidiPanel::showControllerForm(int replaced, ControllerRule rule) {
    auto& form = newForm("A controller");
    form.addTextEditor("controller", juce::String{rule.controller}, "Controller, 0 to 119");
    addChoice(form, "parameter", namesIn(allParameters(), &ParameterRow::name), findParameter(rule.parameter),
              "Parameter that it moves");
    showForm([this, replaced, rule](juce::AlertWindow& answers) mutable {
        rule.controller = answers.getTextEditorContents("controller").getIntValue();
        const int chosen = answers.getComboBoxComponent("parameter")->getSelectedItemIndex();
        rule.parameter = rowOf(static_cast<Parameter>(chosen)).id;
        storeRule(replaced, rule);
    });
}

// Replaces the rule of the edited note and any other rule for the same note; rules stay sorted by note. By
// number, as the list may have changed while the form was open.
void MidiPanel::storeRule(int replaced, const NoteRule& rule) {
    actions_.edit([replaced, &rule](PluginState& state) {
        std::erase_if(state.notes, [&](const NoteRule& other) {
            return other.note == rule.note || other.note == replaced;
        });
        const auto place = std::ranges::find_if(
            state.notes, [&rule](const NoteRule& other) { return other.note > rule.note; });
        state.notes.insert(place, rule);
    });
}

void MidiPanel::storeRule(int replaced, const ControllerRule& rule) {
    actions_.edit([replaced, &rule](PluginState& state) {
        std::erase_if(state.controllers, [&](const ControllerRule& other) {
            return other.controller == rule.controller || other.controller == replaced;
        });
        state.controllers.push_back(rule);
    });
}

void MidiPanel::paint(juce::Graphics& g) { fillPanel(g, *this, getLocalBounds()); }

void MidiPanel::resized() {
    auto area = getLocalBounds().reduced(panelInset);
    title_.setBounds(area.removeFromTop(24));
    auto row = area.removeFromBottom(28);
    for (auto* button : {&addNote_, &addController_, &change_, &remove_})
        button->setBounds(row.removeFromLeft(120).reduced(0, 1)), row.removeFromLeft(8);
    hint_.setBounds(area.removeFromBottom(30));
    list_.setBounds(area.withTrimmedTop(6));
}

namespace {

constexpr int captionPixels = 20;

bool isBlackKey(int note) { return juce::MidiMessage::isMidiNoteBlack(note); }

/// The number of white keys of the keyboard below `note`.
int whiteKeysBelow(int note) {
    int count = 0;
    for (int n = KeyboardPanel::lowestNote; n < note; ++n) count += isBlackKey(n) ? 0 : 1;
    return count;
}

const NoteRule* findRule(int note, const PluginState& state) {
    const auto found = std::ranges::find(state.notes, note, &NoteRule::note);
    return found == state.notes.end() ? nullptr : &*found;
}

bool doesNothing(int note, const MidiTable& table, const PluginState& state, const NoteKnobs& knobs) {
    return table.noteGroup(note) < 0 && table.strikeOf(note, knobs, state.layout.geometry).frequencyHz <= 0.0;
}

} // namespace

juce::String describeKey(int note, const MidiTable& table, const PluginState& state, const NoteKnobs& knobs) {
    const juce::String name = noteName(note) + ": ";
    const NoteRule* const rule = findRule(note, state);
    if (rule && table.noteGroup(note) >= 0) return name + describe(*rule, state.scene);
    if (doesNothing(note, table, state, knobs))
        return name + "silent, as the scene has no material that vibrates";
    const CollisionEvent sound = table.strikeOf(note, knobs, state.layout.geometry);
    const auto percent = [](double part, double whole) { return number(100.0 * part / whole, 0) + " %"; };
    juce::String text = name;
    if (rule) text << fromUtf8(state.scene.materials[static_cast<std::size_t>(rule->material)].name) << ", ";
    text << number(sound.frequencyHz, 0) << " Hz, " << percent(sound.x, table.fieldWidthMetres())
         << " from the left, " << percent(sound.y, table.fieldHeightMetres()) << " from below";
    return table.isHeld(note, knobs) ? text + ", as long as it is held" : text;
}

KeyboardPanel::KeyboardPanel(std::function<void(int, int)> play)
    : play_{std::move(play)} {
    setTitle("Keyboard");
}

void KeyboardPanel::showState(const PluginState& state, const NoteKnobs& knobs) {
    state_ = state;
    knobs_ = knobs;
    table_ = MidiTable{state};
    repaint();
}

juce::Rectangle<float> KeyboardPanel::keyArea(int note) const {
    const auto keys = getLocalBounds().reduced(panelInset, 6).withTrimmedTop(captionPixels).toFloat();
    const float width = keys.getWidth() / static_cast<float>(whiteKeysBelow(highestNote + 1)),
                left = keys.getX() + width * static_cast<float>(whiteKeysBelow(note));
    if (isBlackKey(note)) return {left - 0.3f * width, keys.getY(), 0.6f * width, 0.6f * keys.getHeight()};
    return {left, keys.getY(), width - 1.0f, keys.getHeight()};
}

int KeyboardPanel::noteAt(juce::Point<int> place) const {
    int found = -1;
    for (int note = lowestNote; note <= highestNote; ++note)
        if ((found < 0 || isBlackKey(note) || !isBlackKey(found)) && keyArea(note).contains(place.toFloat()))
            found = note;
    return found;
}

int KeyboardPanel::velocityAt(juce::Point<int> place) const {
    const int note = noteAt(place);
    if (note < 0) return 0;
    const auto key = keyArea(note);
    return juce::jlimit(
        1, 127,
        juce::roundToInt(30.0f + 97.0f * (static_cast<float>(place.y) - key.getY()) / key.getHeight()));
}

void KeyboardPanel::press(juce::Point<int> place) {
    const int note = noteAt(place);
    showNote(note);
    if (note == pressedNote_) return;
    releaseKey();
    if (note < 0) return;
    pressedNote_ = note;
    play_(note, velocityAt(place));
    repaint();
}

void KeyboardPanel::releaseKey() {
    if (pressedNote_ < 0) return;
    play_(pressedNote_, 0);
    pressedNote_ = -1;
    repaint();
}

void KeyboardPanel::showNote(int note) {
    if (note == hoveredNote_) return;
    hoveredNote_ = note;
    repaint();
}

void KeyboardPanel::paintKey(juce::Graphics& g, int note) const {
    const auto key = keyArea(note);
    const bool isBlack = isBlackKey(note);
    auto colour = isBlack ? juce::Colour{0xff24262b} : juce::Colour{0xffe9e9ea};
    if (note == pressedNote_) colour = shade(*this, Shade::accent);
    g.setColour(doesNothing(note, table_, state_, knobs_) ? colour.withMultipliedAlpha(0.35f) : colour);
    g.fillRoundedRectangle(key, 2.0f);
    g.setColour(shade(*this, Shade::line)); // white keys on a light ground
    g.drawRoundedRectangle(key, 2.0f, 1.0f);
    if (findRule(note, state_)) {
        g.setColour(shade(*this, Shade::accent));
        g.fillRoundedRectangle(key.withTop(key.getBottom() - 5.0f).reduced(2.0f, 0.0f), 1.5f);
    }
    if (note % 12 != 0) return;
    g.setColour(juce::Colour{0xff5a5d66});
    g.setFont(text::font(10.0f));
    g.drawText(noteName(note), key.withTrimmedBottom(6.0f).removeFromBottom(12.0f).expanded(4.0f, 0.0f),
               juce::Justification::centred, false);
}

void KeyboardPanel::paint(juce::Graphics& g) {
    fillPanel(g, *this, getLocalBounds());
    const juce::String hint = "Keyboard: click a key to feel it, lower on the key is harder. Marked keys "
                              "have a rule of their own (MIDI).";
    g.setColour(shade(*this, hoveredNote_ < 0 ? Shade::muted : Shade::text));
    g.setFont(text::font(text::small));
    g.drawText(hoveredNote_ < 0 ? hint : describeKey(hoveredNote_, table_, state_, knobs_),
               getLocalBounds().reduced(panelInset, 3).removeFromTop(captionPixels),
               juce::Justification::centredLeft, true);
    for (const bool isBlack : {false, true})
        for (int note = lowestNote; note <= highestNote; ++note)
            if (isBlackKey(note) == isBlack) paintKey(g, note);
}

} // namespace physvib

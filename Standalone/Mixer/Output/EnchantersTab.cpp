// SPDX-License-Identifier: GPL-3.0-or-later
// List of actuators, and controls of the panner.
#include "Mixer/Output/OutputTab.h"
#include "Mixer/Widgets/Cards.h"
#include "Scene/ActuatorFile.h"

namespace physvib {
namespace {

constexpr int enchanterRowPixels = 34;

// Index of the preset with this geometry, whatever its name; -1: none.
int presetOf(const EnchanterLayout& layout) {
    const auto isThat = [&layout](std::string_view name) {
        return isSame(presetLayout(name).geometry, layout);
    };
    const auto found = std::ranges::find_if(layoutPresetNames, isThat);
    return found == layoutPresetNames.end() ? -1 : static_cast<int>(found - layoutPresetNames.begin());
}

juce::Font nameFont() { return text::font(text::medium, juce::Font::bold); }
juce::String placeText(const ActuatorPlace& at) {
    return number(1e3 * at.xMetres, 0) + ", " + number(1e3 * at.yMetres, 0) + " mm";
}
juce::String profileText(const EnchanterDescription& e) {
    return e.actuator == "none" ? juce::String{"no profile"} : utf8(e.actuator);
}

/// Widths of the longest name, place and profile, with what is kept after them.
std::array<int, 3> widestOf(const LayoutDescription& layout) {
    constexpr int after = 12;
    const auto font = text::font(text::medium);
    std::array<int, 3> widest{};
    const auto widen = [&widest](std::size_t column, const juce::Font& in, const juce::String& words) {
        widest[column] = std::max(widest[column], text::pixels(in, words) + after);
    };
    for (std::size_t i = 0; i < layout.enchanters.size(); ++i) {
        widen(0, nameFont(), utf8(layout.enchanters[i].label));
        widen(1, font, placeText(layout.geometry.places[i]));
        widen(2, font, profileText(layout.enchanters[i]));
    }
    return widest;
}

/// Widths of these columns in a row; the full scale has the rest. Where there is no room, names and profiles
/// share what numbers leave.
std::array<int, 3> columnsIn(int width, const std::array<int, 3>& widest) {
    constexpr int fullScale = 66, most = 3;
    auto [name, place, profile] = widest;
    const int rest = width - fullScale - place;
    if (name + profile > rest) {
        profile = std::max(std::min(profile, rest / 2), rest - name);
        name = rest - profile;
    }
    const int more = std::max(0, rest - name - profile) / most;
    return {name + more, place + more, profile};
}

} // namespace

void EnchantersTab::Module::paintButton(juce::Graphics& g, bool isOver, bool) {
    const auto area = getLocalBounds().toFloat().reduced(1.0f);
    fillRound(g, *this, isOver ? Shade::raised : Shade::well, area, 6.0f);
    const auto badge = area.withWidth(26.0f).withSizeKeepingCentre(26.0f, 26.0f).translated(8.0f, 0.0f);
    g.setColour(shade(*this, Shade::accent));
    g.drawRoundedRectangle(badge, 6.0f, 2.0f);
    g.setFont(text::font(text::large));
    g.drawText("+", badge, juce::Justification::centred, false);
    ink(g, *this, Shade::text, text::medium);
    g.drawText("Drag onto the field to attach", area.withTrimmedLeft(46.0f), juce::Justification::centredLeft,
               true);
}

juce::String EnchantersTab::getNameForRow(int row) {
    return row < getNumRows() ? "Actuator " + labelOf(model_.mix(), row) : juce::String{};
}

void EnchantersTab::paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) {
    const auto& mix = model_.mix();
    if (row >= mix.count()) return;
    const auto i = static_cast<std::size_t>(row);
    const auto& e = mix.layout.enchanters[i];
    const auto& place = mix.layout.geometry.places[i];
    if (isSelected) drawChosenRow(g, *this, width, height);
    auto area = juce::Rectangle<int>{width, height}.reduced(10, 0);
    const auto colour = enchanterColour(*this, row);
    g.setColour(colour);
    g.fillEllipse(area.removeFromLeft(14).toFloat().withSizeKeepingCentre(12.0f, 12.0f));
    area.removeFromLeft(12);
    const auto cell = [&](const juce::String& words, int w, Shade which,
                          juce::Justification where = juce::Justification::centredLeft) {
        g.setColour(shade(*this, which));
        g.drawText(words, area.removeFromLeft(w), where, true);
    };
    const auto columns = columnsIn(area.getWidth(), widest_);
    g.setFont(nameFont());
    cell(utf8(e.label), columns[0], Shade::text);
    g.setFont(text::font(text::medium));
    cell(placeText(place), columns[1], Shade::text);
    cell(profileText(e), columns[2], Shade::muted);
    cell(number(e.fullScaleG, 2) + " g", area.getWidth(), Shade::muted, juce::Justification::centredRight);
}

EnchantersTab::EnchantersTab(MixerModel& model, WorldView& world)
    : model_{model}
    , world_{world} {
    setTitle("Actuators");
    preset_.setTitle("Preset");
    for (int id = 1; const auto name : layoutPresetNames)
        preset_.addItem(juce::String{name.data()}.toUpperCase(), id++);
    preset_.setTextWhenNothingSelected("own");
    preset_.onChange = [this] { usePreset(); };
    law_.setTitle("Panning law");
    for (int id = 1; const auto name : panningLawNames) law_.addItem(juce::String{name.data()}, id++);
    law_.onChange = [this] {
        model_.change("Panning law",
                      [this](Mix& mix) { mix.law = nth(panningLaws, law_.getSelectedItemIndex()).law; });
    };
    exponent_.setTitle("Exponent");
    // the colour is read when the text box is created
    exponent_.setColour(juce::Slider::textBoxOutlineColourId, juce::Colours::transparentBlack);
    exponent_.setSliderStyle(juce::Slider::LinearHorizontal);
    exponent_.setTextBoxStyle(juce::Slider::TextBoxRight, false, 46, 24);
    exponent_.setRange(0.25, 4.0, 0.05);
    exponent_.setSkewFactorFromMidPoint(1.0);
    exponent_.setDoubleClickReturnValue(true, 1.0);
    onSlide(exponent_, [this](bool continuesEdit) {
        model_.change(
            "Exponent", [this](Mix& mix) { mix.exponent = exponent_.getValue(); }, continuesEdit);
    });
    list_.setTitle("List of actuators");
    list_.setRowHeight(enchanterRowPixels);
    maps_.setTitle("Map of the chosen actuator");
    maps_.onClick = [this] { visibilityChanged(); };
    detach_ = quietButton("Detach", "Detach the chosen actuator (Delete)", [this] {
        if (chosen_ >= 0) model_.detach(chosen_);
    });
    edit_ = quietButton(juce::String::fromUTF8("Name, profile\xe2\x80\xa6"),
                        "Name, profile and full scale of the chosen actuator (Return)", [this] {
                            if (chosen_ >= 0) editRow(chosen_);
                        });
    hint_.setMinimumHorizontalScale(1.0f); // two lines rather than narrow letters
    addAll(*this, {&module_, &presetName_, &preset_, &lawName_, &law_, &exponentName_, &exponent_, &list_,
                   edit_.get(), detach_.get(), &maps_, &hint_});
    world_.onSelect = [this](int enchanter) {
        if (enchanter >= 0) list_.selectRow(enchanter);
    };
    mixChanged();
}

void EnchantersTab::selectedRowsChanged(int enchanter) {
    chosen_ = enchanter;
    world_.select(enchanter);
    visibilityChanged();
    detach_->setEnabled(chosen_ >= 0 && model_.mix().count() > 1);
    edit_->setEnabled(chosen_ >= 0);
}

void EnchantersTab::editRow(int enchanter) {
    const auto i = static_cast<std::size_t>(enchanter);
    const auto& e = model_.mix().layout.enchanters[i];
    juce::StringArray profiles{"none"};
    for (const auto& profile : builtInActuators()) profiles.add(utf8(profile.name));
    constexpr const char* fullScale = "Full scale in g";
    QuestionCard::Field actuator{"Actuator", utf8(e.actuator), {}, profiles};
    actuator.onChange = [](QuestionCard& card, const juce::String& name) {
        const auto profile = findActuator(name.toStdString());
        if (profile && profile.value.fullScaleG)
            card.setValue(fullScale, juce::String{*profile.value.fullScaleG});
    };
    askForValues(*this, "Actuator " + utf8(e.label), "Take",
                 {{"Label", utf8(e.label)},
                  std::move(actuator),
                  {fullScale, juce::String{e.fullScaleG}, "0123456789.,"}},
                 [this, i](const juce::StringArray& values) {
                     applyRow(i, values[0].toStdString(), values[1].toStdString(),
                              values[2].replaceCharacter(',', '.').getDoubleValue());
                 });
}

void EnchantersTab::applyRow(std::size_t i, const std::string& label, const std::string& profile, double g) {
    const auto& all = model_.mix().layout.enchanters;
    if (i >= all.size()) return; // it was detached meanwhile
    for (std::size_t k = 0; k < all.size(); ++k)
        if (label.empty() || (k != i && all[k].label == label))
            return model_.report("Label: expected one that no other actuator has");
    if (!(g > 0.0 && g <= 100.0))
        return model_.report("Full scale: expected a number of g above 0, at most 100");
    model_.change("Actuator " + utf8(label), [&](Mix& mix) {
        mix.layout.enchanters[i].label = label;
        mix.layout.enchanters[i].actuator = profile;
        mix.layout.enchanters[i].fullScaleG = g;
    });
}

void EnchantersTab::usePreset() {
    const int index = preset_.getSelectedItemIndex();
    if (index < 0) return;
    const auto name = nth(layoutPresetNames, index);
    model_.change("Preset " + juce::String{name.data()}.toUpperCase(), [name](Mix& mix) {
        mix.layout = presetLayout(name, mix.layout.enchanters);
        mix.resizeStrips();
    });
}

void EnchantersTab::mixChanged() {
    const auto& mix = model_.mix();
    preset_.setSelectedItemIndex(presetOf(mix.layout.geometry), quietly);
    law_.setSelectedItemIndex(static_cast<int>(mix.law), quietly);
    if (!exponent_.isMouseButtonDown()) exponent_.setValue(mix.exponent, quietly);
    widest_ = widestOf(mix.layout);
    list_.updateContent();
    list_.repaint();
    if (chosen_ >= mix.count()) list_.deselectAllRows();
    selectedRowsChanged(list_.getSelectedRow());
}

void EnchantersTab::resized() {
    auto area = getLocalBounds();
    const bool isTight = area.getHeight() < 300; // a short panel gives its gaps to the list
    const int space = isTight ? 6 : 12;
    module_.setBounds(area.removeFromTop(isTight ? 34 : 44));
    area.removeFromTop(space);
    auto names = area.removeFromTop(18), row = area.removeFromTop(rowHeight);
    const int third = (row.getWidth() - 2 * gap) / 3;
    const auto place = [&](juce::Label& name, juce::Component& control, int w) {
        name.setBounds(names.removeFromLeft(w));
        control.setBounds(row.removeFromLeft(w));
        names.removeFromLeft(gap);
        row.removeFromLeft(gap);
    };
    place(presetName_, preset_, third);
    place(lawName_, law_, third - 20);
    place(exponentName_, exponent_, row.getWidth());
    area.removeFromTop(space);
    auto bottom = area.removeFromBottom(28);
    maps_.setBounds(area.removeFromBottom(28));
    detach_->setBounds(bottom.removeFromRight(80));
    edit_->setBounds(bottom.removeFromRight(140));
    hint_.setBounds(bottom);
    area.removeFromBottom(isTight ? 4 : 8);
    list_.setBounds(area.withHeight(area.getHeight() / list_.getRowHeight() * list_.getRowHeight())); // whole
                                                                                                      // rows
}

} // namespace physvib

// SPDX-License-Identifier: GPL-3.0-or-later
// The list of actuators, with layout presets and editing, and the controls of the panning law.
#include "Mixer/Output/OutputTab.h"
#include "Mixer/Widgets/Cards.h"
#include "Scene/ActuatorFile.h"

namespace physvib {
namespace {

constexpr int actuatorRowPixels = 34, titlePixels = 18, buttonPixels = 28;

/// Index of the preset with the geometry of this layout, whatever its name; -1: none.
int findPreset(const ActuatorLayout& layout) {
    const auto hasGeometry = [&layout](std::string_view name) {
        return isSame(presetLayout(name).geometry, layout);
    };
    const auto found = std::ranges::find_if(layoutPresetNames, hasGeometry);
    return found == layoutPresetNames.end() ? -1 : static_cast<int>(found - layoutPresetNames.begin());
}

juce::Font nameFont() { return text::font(text::medium, juce::Font::bold); }
juce::String placeText(const ActuatorPlace& place) {
    return number(1e3 * place.xMetres, 0) + ", " + number(1e3 * place.yMetres, 0) + " mm";
}
juce::String profileText(const ActuatorDescription& actuator) {
    return actuator.actuator == "none" ? juce::String{"no profile"} : utf8(actuator.actuator);
}

/// Pixel widths of the longest name, place and profile, each with the gap after it.
std::array<int, 3> measureColumns(const LayoutDescription& layout) {
    constexpr int columnGap = 12;
    const auto font = text::font(text::medium);
    std::array<int, 3> widths{};
    const auto widen = [&widths](std::size_t column, const juce::Font& cellFont, const juce::String& cell) {
        widths[column] = std::max(widths[column], text::pixelWidth(cellFont, cell) + columnGap);
    };
    for (std::size_t i = 0; i < layout.actuators.size(); ++i) {
        widen(0, nameFont(), utf8(layout.actuators[i].label));
        widen(1, font, placeText(layout.geometry.places[i]));
        widen(2, font, profileText(layout.actuators[i]));
    }
    return widths;
}

/// Pixel widths of these columns in a row; the full scale gets the rest. If the row is too narrow, names and
/// profiles share what the numbers leave.
std::array<int, 3> fitColumns(int width, const std::array<int, 3>& widths) {
    constexpr int fullScaleWidth = 66, columnCount = 3;
    auto [name, place, profile] = widths;
    const int remaining = width - fullScaleWidth - place;
    if (name + profile > remaining) {
        profile = std::max(std::min(profile, remaining / 2), remaining - name);
        name = remaining - profile;
    }
    const int extra = std::max(0, remaining - name - profile) / columnCount;
    return {name + extra, place + extra, profile};
}

} // namespace

void ActuatorsTab::NewActuatorButton::paintButton(juce::Graphics& g, bool isOver, bool) {
    const auto area = getLocalBounds().toFloat().reduced(1.0f);
    fillRound(g, *this, isOver ? Shade::raised : Shade::well, area, 6.0f);
    const auto badge = area.withWidth(26.0f).withSizeKeepingCentre(26.0f, 26.0f).translated(8.0f, 0.0f);
    g.setColour(shade(*this, Shade::accent));
    g.drawRoundedRectangle(badge, 6.0f, 2.0f);
    g.setFont(text::font(text::large));
    g.drawText("+", badge, juce::Justification::centred, false);
    setInk(g, *this, Shade::text, text::medium);
    g.drawText("Drag onto the field to attach", area.withTrimmedLeft(46.0f), juce::Justification::centredLeft,
               true);
}

juce::String ActuatorsTab::getNameForRow(int row) {
    return row < getNumRows() ? "Actuator " + labelOf(model_.mix(), row) : juce::String{};
}

void ActuatorsTab::paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) {
    const auto& mix = model_.mix();
    if (row >= mix.count()) return;
    const auto i = static_cast<std::size_t>(row);
    const auto& description = mix.layout.actuators[i];
    const auto& place = mix.layout.geometry.places[i];
    if (isSelected) drawSelectedRow(g, *this, width, height);
    auto area = juce::Rectangle<int>{width, height}.reduced(10, 0);
    const auto colour = actuatorColour(*this, row);
    g.setColour(colour);
    g.fillEllipse(area.removeFromLeft(14).toFloat().withSizeKeepingCentre(12.0f, 12.0f));
    area.removeFromLeft(12);
    const auto cell = [&](const juce::String& cellText, int cellWidth, Shade tone,
                          juce::Justification side = juce::Justification::centredLeft) {
        g.setColour(shade(*this, tone));
        g.drawText(cellText, area.removeFromLeft(cellWidth), side, true);
    };
    const auto columns = fitColumns(area.getWidth(), columnWidths_);
    g.setFont(nameFont());
    cell(utf8(description.label), columns[0], Shade::text);
    g.setFont(text::font(text::medium));
    cell(placeText(place), columns[1], Shade::text);
    cell(profileText(description), columns[2], Shade::muted);
    cell(number(description.fullScaleG, 2) + " g", area.getWidth(), Shade::muted,
         juce::Justification::centredRight);
}

ActuatorsTab::ActuatorsTab(MixerModel& model, WorldView& world)
    : model_{model}
    , world_{world} {
    setTitle("Actuators");
    preset_.setTitle("Preset");
    for (int id = 1; const auto name : layoutPresetNames)
        preset_.addItem(juce::String{name.data()}.toUpperCase(), id++);
    preset_.setTextWhenNothingSelected("own");
    preset_.onChange = [this] { applyPreset(); };
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
    onSliderChange(exponent_, [this](bool continuesEdit) {
        model_.change("Exponent", continuesEdit, [this](Mix& mix) { mix.exponent = exponent_.getValue(); });
    });
    list_.setTitle("List of actuators");
    list_.setRowHeight(actuatorRowPixels);
    mapToggle_.setTitle("Map of the chosen actuator");
    mapToggle_.onClick = [this] { visibilityChanged(); };
    detach_ = makeLinkButton("Detach", "Detach the chosen actuator (Delete)", [this] {
        if (selectedRow_ >= 0) model_.detach(selectedRow_);
    });
    edit_ = makeLinkButton(juce::String::fromUTF8("Name, profile\xe2\x80\xa6"),
                           "Name, profile and full scale of the chosen actuator (Return)", [this] {
                               if (selectedRow_ >= 0) editRow(selectedRow_);
                           });
    hint_.setMinimumHorizontalScale(1.0f); // two lines rather than narrow letters
    addAll(*this, {&newActuator_, &presetLabel_, &preset_, &lawLabel_, &law_, &exponentLabel_, &exponent_,
                   &list_, edit_.get(), detach_.get(), &mapToggle_, &hint_});
    world_.onSelect = [this](int actuator) {
        if (actuator >= 0) list_.selectRow(actuator);
    };
    mixChanged();
}

void ActuatorsTab::selectedRowsChanged(int actuator) {
    selectedRow_ = actuator;
    world_.select(actuator);
    visibilityChanged();
    detach_->setEnabled(selectedRow_ >= 0 && model_.mix().count() > 1);
    edit_->setEnabled(selectedRow_ >= 0);
}

void ActuatorsTab::editRow(int actuator) {
    const auto i = static_cast<std::size_t>(actuator);
    const auto& description = model_.mix().layout.actuators[i];
    juce::StringArray profiles{"none"};
    for (const auto& profile : builtInActuators()) profiles.add(utf8(profile.name));
    constexpr const char* fullScaleName = "Full scale in g";
    QuestionCard::Field actuatorField{"Actuator", utf8(description.actuator), {}, profiles};
    actuatorField.onChange = [](QuestionCard& card, const juce::String& name) {
        const auto profile = findActuator(name.toStdString());
        if (profile && profile.value.fullScaleG)
            card.setValue(fullScaleName, juce::String{*profile.value.fullScaleG});
    };
    askForValues(*this, "Actuator " + utf8(description.label), "Take",
                 {{"Label", utf8(description.label)},
                  std::move(actuatorField),
                  {fullScaleName, juce::String{description.fullScaleG}, "0123456789.,"}},
                 [this, i](const juce::StringArray& values) {
                     applyRow(i, values[0].toStdString(), values[1].toStdString(),
                              values[2].replaceCharacter(',', '.').getDoubleValue());
                 });
}

void ActuatorsTab::applyRow(std::size_t row, const std::string& label, const std::string& profile,
                            double fullScaleG) {
    const auto& actuators = model_.mix().layout.actuators;
    if (row >= actuators.size()) return; // it was detached meanwhile
    for (std::size_t k = 0; k < actuators.size(); ++k)
        if (label.empty() || (k != row && actuators[k].label == label))
            return model_.report("Label: expected one that no other actuator has");
    if (!(fullScaleG > 0.0 && fullScaleG <= 100.0))
        return model_.report("Full scale: expected a number of g above 0, at most 100");
    model_.change("Actuator " + utf8(label), [&](Mix& mix) {
        mix.layout.actuators[row].label = label;
        mix.layout.actuators[row].actuator = profile;
        mix.layout.actuators[row].fullScaleG = fullScaleG;
    });
}

void ActuatorsTab::applyPreset() {
    const int index = preset_.getSelectedItemIndex();
    if (index < 0) return;
    const auto name = nth(layoutPresetNames, index);
    model_.change("Preset " + juce::String{name.data()}.toUpperCase(), [name](Mix& mix) {
        mix.layout = presetLayout(name, mix.layout.actuators);
        mix.resizeStrips();
    });
}

void ActuatorsTab::mixChanged() {
    const auto& mix = model_.mix();
    preset_.setSelectedItemIndex(findPreset(mix.layout.geometry), dontNotify);
    law_.setSelectedItemIndex(static_cast<int>(mix.law), dontNotify);
    if (!exponent_.isMouseButtonDown()) exponent_.setValue(mix.exponent, dontNotify);
    columnWidths_ = measureColumns(mix.layout);
    list_.updateContent();
    list_.repaint();
    if (selectedRow_ >= mix.count()) list_.deselectAllRows();
    selectedRowsChanged(list_.getSelectedRow());
}

void ActuatorsTab::resized() {
    auto area = getLocalBounds();
    const bool isLow = area.getHeight() < 300; // a short panel gives its gaps to the list
    const int space = isLow ? 6 : 12;
    newActuator_.setBounds(area.removeFromTop(isLow ? 34 : 44));
    area.removeFromTop(space);
    auto names = area.removeFromTop(titlePixels), row = area.removeFromTop(rowHeight);
    const int third = (row.getWidth() - 2 * gap) / 3;
    const auto place = [&](juce::Label& name, juce::Component& control, int w) {
        name.setBounds(names.removeFromLeft(w));
        control.setBounds(row.removeFromLeft(w));
        names.removeFromLeft(gap);
        row.removeFromLeft(gap);
    };
    place(presetLabel_, preset_, third);
    place(lawLabel_, law_, third - 20);
    place(exponentLabel_, exponent_, row.getWidth());
    area.removeFromTop(space);
    auto bottom = area.removeFromBottom(buttonPixels);
    mapToggle_.setBounds(area.removeFromBottom(buttonPixels));
    detach_->setBounds(bottom.removeFromRight(80));
    edit_->setBounds(bottom.removeFromRight(140));
    hint_.setBounds(bottom);
    area.removeFromBottom(isLow ? 4 : 8);
    list_.setBounds(area.withHeight(area.getHeight() / list_.getRowHeight() * list_.getRowHeight()));
}

} // namespace physvib

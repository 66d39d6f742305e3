// SPDX-License-Identifier: GPL-3.0-or-later
// Keyboard commands for tools and selected bodies.
#include "Mixer/World/DrawPane.h"

namespace physvib {

void DrawPane::nudge(Vector byMetres, double byRadians) {
    std::map<std::string, BodyPlace> places;
    for (const std::string& name : chosen_)
        if (auto place = placeNow(name))
            places.emplace(name, BodyPlace{{place->metres.x + byMetres.x, place->metres.y + byMetres.y},
                                           place->angleRadians + byRadians});
    edit(byRadians != 0.0 ? "Turn" : "Move", movedTo(desk_.world().drawing(), places));
}

void DrawPane::scaleChosen(double factor) {
    changeChosen("Size",
                 [factor](const Scene&, BodyDescription& body) { body = scaledBody(body, factor, factor); });
}

void DrawPane::paste(const Copied& copy, Vector beside) {
    std::vector<std::string> names;
    edit("Paste", pasted(desk_.world().drawing(), copy, beside, names));
    use(DrawTool::choose);
    choose(names);
}

void DrawPane::pasteAt(Vector place) {
    const Vector& from = copied_.bodies.front().positionMetres;
    paste(copied_, {place.x - from.x, place.y - from.y});
}

void DrawPane::copy(const std::vector<std::string>& names) {
    copied_ = copied(desk_.world().drawing(), names);
}

void DrawPane::eraseAll(const std::vector<std::string>& names) {
    edit("Erase", erased(desk_.world().drawing(), names));
}

bool DrawPane::takeToolKey(const juce::KeyPress& key) {
    if (key.getModifiers().isAnyModifierKeyDown()) return false;
    for (const auto& words : drawTools)
        if (key.getKeyCode() ==
                juce::CharacterFunctions::toUpperCase(static_cast<juce::juce_wchar>(words.key)) ||
            key.getTextCharacter() == static_cast<juce::juce_wchar>(words.key))
            return use(words.tool), true;
    if (key.getTextCharacter() == 'g') return setSnapping(!snaps_), true;
    return false;
}

bool DrawPane::takeKey(const juce::KeyPress& key) {
    using juce::KeyPress;
    const auto command = juce::ModifierKeys::commandModifier;
    if (takeToolKey(key)) return true;
    if (tool_ == DrawTool::hand) return false;
    if (key == KeyPress::returnKey && tool_ == DrawTool::polygon && !stroke_.empty())
        return closePolygon(), true;
    if (key == KeyPress::returnKey && (isStroke(tool_) || tool_ == DrawTool::polygon))
        return addInTheMiddle(), true;
    if (key == KeyPress{'a', command, 0}) {
        std::vector<std::string> all;
        for (const auto& body : desk_.world().drawing().drawn().bodies) all.push_back(body.name);
        return use(DrawTool::choose), choose(all), true;
    }
    const double step = desk_.world().scene().fieldHeightMetres / gridsPerField;
    const Vector beside{2.0 * step, 2.0 * step};
    if (key == KeyPress{'v', command, 0} && hasCopy()) return paste(copied_, beside), true;
    if (key == KeyPress::tabKey || chosen_.empty()) return false;
    if (key == KeyPress::deleteKey || key == KeyPress::backspaceKey) return eraseAll(chosen_), true;
    if (key == KeyPress{'c', command, 0}) return copy(chosen_), true;
    if (key == KeyPress{'d', command, 0})
        return paste(copied(desk_.world().drawing(), chosen_), beside), true;
    if (key == KeyPress::leftKey) return nudge({-step, 0.0}, 0.0), true;
    if (key == KeyPress::rightKey) return nudge({step, 0.0}, 0.0), true;
    if (key == KeyPress::upKey) return nudge({0.0, step}, 0.0), true;
    if (key == KeyPress::downKey) return nudge({0.0, -step}, 0.0), true;
    if (key.getModifiers().isCommandDown()) return false; // zoom has Ctrl and the same signs
    if (key.getTextCharacter() == '[') return nudge({}, turnStep), true;
    if (key.getTextCharacter() == ']') return nudge({}, -turnStep), true;
    if (key.getTextCharacter() == '+') return scaleChosen(1.1), true;
    if (key.getTextCharacter() == '-') return scaleChosen(1.0 / 1.1), true;
    return false;
}

} // namespace physvib

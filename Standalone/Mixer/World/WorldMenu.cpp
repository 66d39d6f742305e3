// SPDX-License-Identifier: GPL-3.0-or-later
// Menus of what lies under the pointer: an actuator, a body, or the empty field.
#include "Mixer/World/WorldPanel.h"

namespace physvib {

juce::PopupMenu WorldPanel::menuAt(juce::Point<float> place) {
    juce::PopupMenu menu;
    const auto target = view_.targetAt(place);
    if (target.enchanter >= 0)
        addActuatorItems(menu, target.enchanter);
    else if (!target.body.empty())
        addBodyItems(menu, target.body, view_.metresAt(place));
    else
        addEmptyItems(menu, target.at, view_.metresAt(place));
    menu.setLookAndFeel(&getLookAndFeel());
    return menu;
}

void WorldPanel::showMenu(juce::Point<float> place) {
    menuAt(place).showMenuAsync(juce::PopupMenu::Options{}.withTargetComponent(view_).withMousePosition());
}

void WorldPanel::addActuatorItems(juce::PopupMenu& menu, int enchanter) {
    menu.addSectionHeader("Actuator " +
                          utf8(desk_.mix().layout.enchanters[static_cast<std::size_t>(enchanter)].label));
    menu.addItem("Test pulse", [this, enchanter] { desk_.strikes().testPulse(enchanter); });
    menu.addItem("Sweep", [this, enchanter] { desk_.strikes().testSweep(enchanter); });
    menu.addItem("Output" + dots(), onOutput != nullptr, false, [this, enchanter] { onOutput(enchanter); });
    menu.addItem("Name, profile" + dots(), onProfile != nullptr, false,
                 [this, enchanter] { onProfile(enchanter); });
    menu.addSeparator();
    menu.addItem("Detach", desk_.mix().count() > 1, false, [this, enchanter] { desk_.detach(enchanter); });
}

// Bodies that a script adds are not part of the drawing: they only change their material.
void WorldPanel::addBodyItems(juce::PopupMenu& menu, const std::string& body, Vector place) {
    juce::PopupMenu materials;
    const auto& scene = desk_.world().drawing().drawn();
    const auto* drawn = desk_.world().drawing().find(body);
    const bool isDrawn = drawn != nullptr, moves = isDrawn && drawn->type == BodyType::dynamicBody;
    for (int i = 0; i < static_cast<int>(scene.materials.size()); ++i)
        materials.addItem(utf8(scene.materials[static_cast<std::size_t>(i)].name), true,
                          isDrawn && drawn->fixtures[0].material == i, [this, body, i] {
                              edit("Material of " + utf8(body), MaterialAction{body, everyFixture, i});
                          });
    menu.addSectionHeader(utf8(body));
    menu.addSubMenu("Material", materials);
    menu.addItem("Select", isDrawn, false,
                 [this, body] { pane_.use(DrawTool::choose), pane_.choose({body}); });
    if (isDrawn && motorOf(scene, body) != nullptr)
        menu.addItem("Motor: speed and torque",
                     [this, body] { pane_.use(DrawTool::choose), pane_.choose({body}); });
    else
        menu.addItem("Motor here", moves, false, [this, place] { pane_.joinAt(DrawTool::motor, place); });
    if (isDrawn && springOf(scene, body) != nullptr)
        menu.addItem("Spring: stiffness",
                     [this, body] { pane_.use(DrawTool::choose), pane_.choose({body}); });
    else
        menu.addItem("Spring here", moves, false, [this, place] { pane_.joinAt(DrawTool::spring, place); });
    menu.addItem("Pin here", moves, false, [this, place] { pane_.joinAt(DrawTool::pin, place); });
    menu.addSeparator();
    menu.addItem("Copy", isDrawn, false, [this, body] { pane_.copy({body}); });
    menu.addItem("Delete", isDrawn, false, [this, body] { pane_.eraseAll({body}); });
}

void WorldPanel::addEmptyItems(juce::PopupMenu& menu, FieldShare at, Vector place) {
    for (const DrawTool tool : {DrawTool::ball, DrawTool::box, DrawTool::wall, DrawTool::rain})
        menu.addItem("Add " + juce::String{wordsOf(tool).name}.toLowerCase(),
                     [this, tool, place] { pane_.addAt(tool, place); });
    menu.addItem("Paste here", pane_.hasCopy(), false, [this, place] { pane_.pasteAt(place); });
    menu.addSeparator();
    menu.addItem("Attach an actuator here", desk_.mix().count() < limits::maxEnchanters, false,
                 [this, at] { desk_.attach(at.x, at.y); });
}

} // namespace physvib

// SPDX-License-Identifier: GPL-3.0-or-later
// Size and menu.
#include "Mixer/MixerWindow.h"

namespace physvib {

MixerWindow::MixerWindow(Desk& desk)
    : juce::DocumentWindow{"PhysVib mixer", palette::ground, allButtons, false}
    , desk_{desk}
    , view_{desk} {
    setUsingNativeTitleBar(true);
    setContentNonOwned(&view_, true);
    setResizable(true, false);
    setResizeLimits(MixerView::leastWidth, MixerView::leastHeight, 7680, 4320);
    view_.topBar().onMenu = [this](juce::Component& from) { showMenu(from); };
    if (const auto* display = juce::Desktop::getInstance().getDisplays().getPrimaryDisplay()) {
        const auto room = display->userArea;
        centreWithSize(std::min(1440, room.getWidth()), std::min(900, room.getHeight() - 30));
    }
    addToDesktop();
    setVisible(true);
    view_.grabKeyboardFocus();
}

void MixerWindow::showMenu(juce::Component& from) {
    auto& undo = desk_.undoManager();
    juce::PopupMenu menu, look;
    const auto isLight = view_.ground() == Ground::light;
    look.addItem("Dark", true, !isLight, [this] { view_.setGround(Ground::dark); });
    look.addItem("Light", true, isLight, [this] { view_.setGround(Ground::light); });
    menu.addItem(undo.canUndo() ? "Undo: " + undo.getUndoDescription() : juce::String{"Undo"}, undo.canUndo(), false, [&undo] { undo.undo(); });
    menu.addItem(undo.canRedo() ? "Redo: " + undo.getRedoDescription() : juce::String{"Redo"}, undo.canRedo(), false, [&undo] { undo.redo(); });
    menu.addSeparator();
    menu.addSubMenu("Look", look);
    menu.addItem("Quit", [] { juce::JUCEApplicationBase::quit(); });
    menu.showMenuAsync(juce::PopupMenu::Options{}.withTargetComponent(from));
}

} // namespace physvib

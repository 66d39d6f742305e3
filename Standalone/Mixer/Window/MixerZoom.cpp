// SPDX-License-Identifier: GPL-3.0-or-later
// Zoom and full screen of the window.
#include "Mixer/Window/MixerWindow.h"
#include <array>

namespace physvib {
namespace {

constexpr std::array<int, 6> zooms{75, 100, 125, 150, 175, 200};
constexpr const char* zoomSetting = "zoom";
constexpr juce::Point<int> usualDisplay{1920, 1080}; // at 100 %

/// Room of the display in pixels at 100 %.
juce::Point<int> displayRoom() {
    auto& desktop = juce::Desktop::getInstance();
    const auto* display = desktop.getDisplays().getPrimaryDisplay();
    if (display == nullptr) return usualDisplay;
    const auto area = display->userArea.toFloat() * desktop.getGlobalScaleFactor();
    return {juce::roundToInt(area.getWidth()), juce::roundToInt(area.getHeight())};
}

bool fits(int percent, juce::Point<int> room) {
    return 100 * room.x >= percent * MixerView::leastWidth &&
           100 * room.y >= percent * MixerView::leastHeight;
}

/// The largest zoom that leaves the window the room of a usual display.
int automaticZoom(juce::Point<int> room) {
    int best = 100;
    for (const int percent : zooms)
        if (100 * room.x >= percent * usualDisplay.x && 100 * room.y >= percent * usualDisplay.y)
            best = std::max(best, percent);
    return best;
}

} // namespace

int MixerWindow::zoom() {
    const int percent = files_.settings().getIntValue(zoomSetting); // which may hold anything
    return std::ranges::find(zooms, percent) == zooms.end() ? 0 : percent;
}

void MixerWindow::setZoom(int percent) {
    files_.settings().setValue(zoomSetting, percent);
    applyZoom();
}

void MixerWindow::stepZoom(int by) {
    const int now = juce::roundToInt(100.0f * juce::Desktop::getInstance().getGlobalScaleFactor());
    const auto at = std::ranges::lower_bound(zooms, now) - zooms.begin() + by;
    if (at >= 0 && at < std::ssize(zooms) && fits(zooms[static_cast<std::size_t>(at)], displayRoom()))
        setZoom(zooms[static_cast<std::size_t>(at)]);
}

// Plus needs Shift on some keyboards, and has a key of its own beside the digits.
int MixerWindow::zoomStepOf(const juce::KeyPress& key) {
    if (!key.getModifiers().isCommandDown()) return 0;
    const int code = key.getKeyCode();
    if (code == '+' || code == '=' || code == juce::KeyPress::numberPadAdd) return 1;
    return code == '-' || code == juce::KeyPress::numberPadSubtract ? -1 : 0;
}

// The window keeps its size on the screen.
void MixerWindow::applyZoom() {
    auto& desktop = juce::Desktop::getInstance();
    const auto room = displayRoom();
    int percent = zoom() > 0 ? zoom() : automaticZoom(room);
    while (percent > zooms.front() && !fits(percent, room)) percent -= 25;
    const float before = desktop.getGlobalScaleFactor(), after = 0.01f * static_cast<float>(percent);
    if (juce::approximatelyEqual(before, after)) return;
    const auto bounds = (getBounds().toFloat() * (before / after)).toNearestInt();
    desktop.setGlobalScaleFactor(after);
    if (isOnDesktop()) setBounds(bounds);
}

void MixerWindow::setShow(bool isShow) {
    juce::Desktop::getInstance().setKioskModeComponent(isShow ? this : nullptr, false);
    view_->setShow(isShow);
    view_->grabKeyboardFocus();
}

juce::PopupMenu MixerWindow::viewMenu() {
    juce::PopupMenu menu;
    menu.addSectionHeader("Zoom: Ctrl++ and Ctrl+-");
    menu.addItem("Zoom: by the display (Ctrl+0)", true, zoom() == 0, [this] { setZoom(0); });
    for (const int percent : zooms)
        menu.addItem("Zoom: " + juce::String{percent} + " %", fits(percent, displayRoom()), zoom() == percent,
                     [this, percent] { setZoom(percent); });
    menu.addSeparator();
    menu.addItem("Full screen for a show (F11)", true, view_->isShow(),
                 [this] { setShow(!view_->isShow()); });
    menu.addItem("Automatic panels", view_->dividers() != Dividers{}, false,
                 [this] { view_->setDividers({}); });
    return menu;
}

} // namespace physvib

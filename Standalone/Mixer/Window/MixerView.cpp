// SPDX-License-Identifier: GPL-3.0-or-later
// Creates the tabs, arranges panels, cards and messages, handles keys, and updates the display.
#include "Mixer/Window/MixerView.h"
#include "Mixer/Materials/MaterialsTab.h"
#include "Mixer/Output/EventsTab.h"
#include "Mixer/Output/OutputTab.h"
#include "Mixer/Output/TakesTab.h"
#include "Mixer/Strips/LanesTab.h"
#include "Mixer/Strips/ScopeView.h"
#include "Mixer/Studies/StudiesTab.h"

namespace physvib {
namespace {

constexpr int dismissWidth = 90, panelMargin = 4;

/// A tab beside or below the world, and the function that creates it.
struct TabEntry {
    bool isBesideWorld;
    const char* name;
    std::unique_ptr<Tab> (*make)(MixerModel& model, WorldView& world);
};

template <class T>
std::unique_ptr<Tab> make(MixerModel& model, WorldView& world) {
    if constexpr (std::is_constructible_v<T, MixerModel&, WorldView&>)
        return std::make_unique<T>(model, world);
    else
        return std::make_unique<T>(model);
}

// All tabs, in their order.
constexpr TabEntry tabEntries[]{
    {true, "Actuators", make<ActuatorsTab>}, {true, "Materials", make<MaterialsTab>},
    {true, "Output", make<OutputTab>},       {true, "Studies", make<StudiesTab>},
    {false, "Played now", make<ScopeView>},  {false, "Gain lanes", make<LanesTab>},
    {false, "Events", make<EventsTab>},      {false, "Takes", make<TakesTab>},
    {false, "Telemetry", make<TelemetryTab>}};

/// Fades in a component at its current place.
void fadeIn(juce::Component& c) {
    constexpr int fadeMs = 120;
    if (c.isShowing()) juce::Desktop::getInstance().getAnimator().fadeIn(&c, fadeMs);
}

/// Gives typed text the colour of the theme; JUCE would keep the colour in which it was typed.
void recolourTexts(juce::Component& parent) {
    if (auto* const editor = dynamic_cast<juce::TextEditor*>(&parent))
        editor->applyColourToAllText(shade(parent, Shade::text));
    for (auto* child : parent.getChildren()) recolourTexts(*child);
}

/// Shortens paths at their beginning until each fits into a line of `room` pixels.
juce::String shortenedPaths(const juce::String& message, const juce::Font& font, int room) {
    auto all = juce::StringArray::fromTokens(message, " ", {});
    for (auto& word : all)
        while (room > 40 && text::pixelWidth(font, word) > room) {
            const auto remainder = word.trimCharactersAtStart(ellipsis() + "/");
            word =
                ellipsis() + (remainder.containsChar('/') ? remainder.fromFirstOccurrenceOf("/", true, false)
                                                          : remainder.substring(1));
        }
    return all.joinIntoString(" ");
}

} // namespace

MixerView::MixerView(MixerModel& model)
    : model_{model}
    , bar_{model}
    , world_{model}
    , strips_{model} {
    juce::Font::setDefaultMinimumHorizontalScaleFactor(1.0f); // letters keep their width
    setLookAndFeel(&look_);
    setOpaque(true);
    setTitle("PhysVib mixer");
    setWantsKeyboardFocus(true);
    for (const TabEntry& tab : tabEntries)
        (tab.isBesideWorld ? tabs_ : scope_).add(tab.name, tab.make(model, world_.view()));
    tabs_.onOpen = [this](bool isOpen) { setPanels({isOpen, panels().hasLower}); };
    scope_.onOpen = [this](bool isOpen) { setPanels({panels().hasDrawer, isOpen}); };
    bar_.onMode = [this] { setMode(mode_ == Mode::play ? Mode::engineer : Mode::play); };
    world_.onOutput = [this](int actuator) {
        setPanels({panels().hasDrawer, true});
        strips_.showOutputs(actuator);
    };
    world_.onProfile = [this](int actuator) {
        tabs_.choose("Actuators");
        tabs_.find<ActuatorsTab>()->editRow(actuator);
    };
    world_.onMaterial = [this](int material, bool isRecording) {
        tabs_.choose("Materials");
        auto& tab = *tabs_.find<MaterialsTab>();
        tab.choose(material);
        if (isRecording) tab.browse();
    };
    messageLabel_.setTitle("Trouble");
    messageLabel_.setFont(text::font(text::medium));
    dismiss_ = makeLinkButton("Dismiss", "Dismiss the message");
    dismiss_->onClick = [this] { model_.report({}); };
    action_ = makeLinkButton({}, "Act on the message");
    action_->onClick = [this] {
        const auto run = model_.messages().current().action.run;
        model_.report({});
        if (run) run();
    };
    addAll(*this, {&world_, &tabs_, &scope_, &strips_, &sideDivider_, &lowerDivider_, &scopeDivider_, &bar_});
    sideDivider_.onMove = [this](int pixels) {
        moveDivider(&Dividers::side, -pixels, getWidth(), tabs_.getWidth());
    };
    lowerDivider_.onMove = [this](int pixels) {
        moveDivider(&Dividers::lower, -pixels, getHeight(), scope_.getHeight());
    };
    scopeDivider_.onMove = [this](int pixels) {
        moveDivider(&Dividers::strips, -pixels, getWidth(), strips_.getWidth());
    };
    for (const auto& [divider, share] : {std::pair{&sideDivider_, &Dividers::side},
                                         {&lowerDivider_, &Dividers::lower},
                                         {&scopeDivider_, &Dividers::strips}})
        divider->onReset = [this, share = share] {
            dividers_.*share = 0.0;
            resized();
        };
    addHidden(*this, {&overlay_, &messageLabel_, dismiss_.get(), action_.get()});
    prepareControls(*this);
    model_.addChangeListener(this);
    addMouseListener(this, true);
    mixChanged();
    showPanels();
    setSize(1440, 900);
    startTimerHz(framesPerSecond);
}

MixerView::~MixerView() {
    model_.removeChangeListener(this);
    setLookAndFeel(nullptr);
}

void MixerView::setTheme(Theme theme) {
    look_.setTheme(theme);
    recolourTexts(*this);
    sendLookAndFeelChange();
    mixChanged();
    repaint();
}

void MixerView::mixChanged() {
    idleUpdates_ = 0;
    if (isTimerRunning() && getTimerInterval() > 1000 / framesPerSecond) startTimerHz(framesPerSecond);
    bar_.mixChanged();
    updateTypeface();
    world_.mixChanged();
    tabs_.mixChanged();
    strips_.mixChanged();
    scope_.mixChanged();
    if (const auto reason = silenceReason(model_); reason != silenceReason_) {
        silenceReason_ = reason;
        hintOnLevels(model_, reason);
    }
    const bool hasMessage = model_.messageText().isNotEmpty();
    messageLabel_.setTooltip(model_.messageText());
    messageLabel_.setColour(juce::Label::textColourId, shade(*this, Shade::text));
    const auto tint = shade(*this, model_.isInfo() ? Shade::accent : Shade::limit);
    messageLabel_.setColour(juce::Label::backgroundColourId,
                            shade(*this, Shade::panel).interpolatedWith(tint, 0.17f));
    const auto& action = model_.messages().current().action.name;
    action_->setButtonText(action);
    action_->setTitle(action);
    action_->setTooltip(action);
    action_->setVisible(action.isNotEmpty());
    const bool isNew = hasMessage && !messageLabel_.isVisible();
    messageLabel_.setVisible(hasMessage);
    dismiss_->setVisible(hasMessage);
    resized(); // the shares of strips and field may change
    if (isNew) fadeIn(messageLabel_);
}

// The handle moves with the panels, so each call starts from their current places.
void MixerView::moveDivider(double Dividers::*share, int pixels, int totalPixels, int currentPixels) {
    dividers_.*share = static_cast<double>(currentPixels + pixels) /
                       (totalPixels - (share == &Dividers::lower ? bar_.getHeight() : 0) - 2 * panelMargin);
    resized();
}

void MixerView::setDividers(const Dividers& dividers) {
    dividers_ = dividers;
    resized();
}

void MixerView::setShowMode(bool isShowMode) {
    isShowMode_ = isShowMode;
    bar_.setShowMode(isShowMode);
    bar_.setAlwaysOnTop(isShowMode); // no message and no card may cover the button that silences
    world_.setShowMode(isShowMode);
    showPanels();
}

void MixerView::setMode(Mode mode) {
    mode_ = mode;
    bar_.setPlayMode(mode == Mode::play);
    showPanels();
}

void MixerView::setPanels(const Panels& panels) {
    nth(panels_, mode_) = panels;
    showPanels();
}

// By default the lower panels are folded where they would leave the field too little room.
Panels MixerView::panels() const {
    constexpr int minHeightForLower = 760;
    const auto& userPanels = nth(panels_, mode_);
    return userPanels.value_or(Panels{false, mode_ == Mode::engineer && getHeight() >= minHeightForLower});
}

juce::String MixerView::panelLayout() const {
    juce::String layout{mode_ == Mode::play ? "play" : "engineer"};
    for (const auto& panels : panels_)
        layout << (!panels ? juce::String{" -"}
                           : juce::String{" "} + (panels->hasDrawer ? "1" : "0") +
                                 (panels->hasLower ? "1" : "0"));
    return layout;
}

void MixerView::setPanelLayout(const juce::String& text) {
    const auto tokens = juce::StringArray::fromTokens(text, " ", {});
    for (int k = 0; k < 2; ++k)
        if (tokens[k + 1].length() == 2)
            nth(panels_, k) = Panels{tokens[k + 1][0] == '1', tokens[k + 1][1] == '1'};
    setMode(tokens[0] == "engineer" ? Mode::engineer : Mode::play);
}

void MixerView::showPanels() {
    using Fold = TabPanel::Fold;
    const auto [hasDrawer, hasLower] = shownPanels_ = panels();
    const bool isEngineer = mode_ == Mode::engineer;
    tabs_.setFold(hasDrawer ? Fold::none : Fold::column);
    scope_.setFold(hasLower ? Fold::none : Fold::row);
    world_.setPlayMode(!isEngineer, !hasLower);
    for (const auto& [panel, isUnfolded] :
         std::initializer_list<std::pair<juce::Component*, bool>>{{&tabs_, hasDrawer || isEngineer},
                                                                  {&sideDivider_, hasDrawer},
                                                                  {&scope_, hasLower || isEngineer},
                                                                  {&strips_, hasLower},
                                                                  {&lowerDivider_, hasLower},
                                                                  {&scopeDivider_, hasLower}})
        panel->setVisible(isUnfolded && !isShowMode_ && screen_ == nullptr);
    resized();
    repaint();
}

// Selects a typeface with the letters of all names. Those of the scene are read only after it was edited.
void MixerView::updateTypeface() {
    juce::String shownText = model_.messageText() + juce::String::fromUTF8(model_.output().device().c_str());
    for (const auto& actuator : model_.mix().layout.actuators) shownText += utf8(actuator.label);
    if (std::exchange(checkedEditCount_, model_.world().editCount()) != model_.world().editCount()) {
        const Scene& scene = model_.world().drawing().drawn();
        shownText += utf8(scene.name);
        for (const auto& body : scene.bodies) shownText += utf8(body.name);
        for (const auto& material : scene.materials) shownText += utf8(material.name);
    }
    if (!typeface_.ensureLetters(shownText)) return;
    sendLookAndFeelChange();
    repaint();
}

void MixerView::updateOverlay() {
    const auto* const modal = juce::Component::getCurrentlyModalComponent();
    overlay_.update(openCard() != nullptr, modal != nullptr && modal->isOnDesktop());
}

void MixerView::updateWorld() {
    updateOverlay();
    snapshot_ = model_.poll();
    for (std::size_t j = 0; j < peaks_.size(); ++j)
        peaks_[j] = std::max(peaks_[j], snapshot_.meters.peaks[j]);
    world_.refresh(snapshot_);
}

void MixerView::refresh() {
    updateWorld();
    snapshot_.meters.peaks = std::exchange(peaks_, {});
    bar_.refresh(snapshot_);
    tabs_.refresh(snapshot_); // even if folded: studies, takes and lanes go on
    scope_.refresh(snapshot_);
    strips_.refresh(snapshot_);
    if (std::exchange(lastShownCount_, model_.messages().shownCount()) != lastShownCount_)
        messageAtMs_ = nowMs(), activityAtMs_ = 0.0;
    constexpr double newsMs = 10e3; // the message covers the materials of the drawing bar
    const bool hasExpired = model_.isInfo() ? nowMs() - messageAtMs_ > newsMs
                                            : activityAtMs_ > 0.0 && nowMs() - activityAtMs_ > errorShownMs;
    if (hasExpired && !model_.messages().current().isPersistent()) model_.report({});
    adaptFrameRate();
}

// Errors stay until a user who may have read them moves the mouse or presses a key.
void MixerView::recordUserActivity() {
    if (activityAtMs_ == 0.0 && messageLabel_.isVisible() && openCard() == nullptr && screen_ == nullptr)
        activityAtMs_ = nowMs();
}

// The world moves smoothly at 60 Hz; numbers and meters need fewer updates.
void MixerView::timerCallback() {
    const bool isSlow = getTimerInterval() > 1000 / framesPerSecond;
    isSlow || ++updates_ % worldUpdatesPerPanelUpdate == 0 ? refresh() : updateWorld();
}

// Reduces the update rate while nothing moves and nothing plays, or nobody sees it.
void MixerView::adaptFrameRate() {
    const auto& peaks = snapshot_.meters.peaks;
    const bool isIdle = model_.session().world().slowness() == 0 && snapshot_.hits.empty() &&
                        std::ranges::all_of(peaks, [](float p) { return p == 0.0f; });
    idleUpdates_ = isIdle ? idleUpdates_ + 1 : 0;
    const auto* peer = getPeer();
    const bool isHidden = peer != nullptr && peer->isMinimised(),
               isSlow = isHidden || idleUpdates_ > 2 * framesPerSecond / worldUpdatesPerPanelUpdate;
    const int intervalMs = 1000 / (isSlow ? idleFramesPerSecond : framesPerSecond);
    if (isTimerRunning() && getTimerInterval() != intervalMs) startTimer(intervalMs);
}

void MixerView::setFirstStart(std::unique_ptr<FirstStart> card) {
    firstStart_ = std::move(card);
    showOpenCard();
}

void MixerView::setCard(std::unique_ptr<juce::Component> card) {
    card_ = std::move(card);
    showOpenCard();
}

// Whether Esc only closes a card or menu, or ends a drag. It also silences if anything plays, or has played
// within the time for which meters hold peaks.
bool MixerView::escapeOnlyCloses() {
    if (openCard() == nullptr && juce::Component::getCurrentlyModalComponent() == nullptr &&
        !world_.isDragging())
        return false;
    updateWorld();
    return model_.isVisualOnly() ||
           std::ranges::all_of(snapshot_.heldPeaks, [](float h) { return h == 0.0f; });
}

void MixerView::showOpenCard() {
    auto* const open = openCard();
    updateOverlay();
    if (open == nullptr) return grabKeyboardFocus();
    overlay_.toFront(false);
    addAndMakeVisible(*open);
    recolourTexts(*open);
    open->toFront(false);
    placeCards();
    fadeIn(*open);
    cardFocus_.focusCard(*open);
}

void MixerView::setProgress(juce::Component* card) {
    progress_ = card;
    if (card == nullptr) return;
    addAndMakeVisible(*card);
    placeCards();
}

void MixerView::setDropShown(bool isShown) {
    isDropShown_ = isShown;
    repaint();
}

bool MixerView::shouldDropFilesWhenDraggedExternally(const juce::DragAndDropTarget::SourceDetails& details,
                                                     juce::StringArray& files, bool& canMoveFiles) {
    if (details.description != EventsTab::dragDescription) return false;
    canMoveFiles = false;
    files = scope_.find<EventsTab>()->filesToDrag();
    return !files.isEmpty();
}

// JUCE's buttons react to every mouse button. A button that is released at once ignores the right click.
void MixerView::releaseButtonAtRightClick(const juce::MouseEvent& e) {
    auto* const button = dynamic_cast<juce::Button*>(e.eventComponent);
    if (button != nullptr && e.mods.isPopupMenu()) button->setState(juce::Button::buttonNormal);
}

void MixerView::setScreen(juce::Component* screen) {
    for (auto& child : hiddenByScreen_)
        if (child) child->setVisible(true);
    hiddenByScreen_.clear();
    screen_ = screen;
    if (screen == nullptr) return showPanels(); // the panels may have changed meanwhile
    for (auto* child : getChildren())
        if (child->isVisible()) hiddenByScreen_.emplace_back(child);
    screen->setBounds(getLocalBounds());
    addAndMakeVisible(*screen);
    for (auto& child : hiddenByScreen_)
        if (child) child->setVisible(false); // also hides the focus outline
    if (screen->isShowing()) screen->grabKeyboardFocus();
}

void MixerView::chooseStudy(const StudySelection& study) {
    tabs_.choose("Studies");
    auto& tab = *tabs_.find<StudiesTab>();
    if (study.folder.isNotEmpty())
        tab.setFolder(juce::File::getCurrentWorkingDirectory().getChildFile(study.folder));
    if (study.participant.isNotEmpty()) tab.setParticipant(study.participant, std::max(1, study.number));
    tab.chooseProtocol(study.protocol.toStdString());
}

bool MixerView::pauseStudy() {
    auto* const screen = tabs_.find<StudiesTab>()->screen();
    if (screen != nullptr) screen->requestClose();
    return screen != nullptr;
}

bool MixerView::keyPressed(const juce::KeyPress& key) {
    using juce::KeyPress;
    recordUserActivity();
    if (auto* const open = openCard()) { // regardless of the focus, which Tab moves within it
        if (key.isKeyCode(KeyPress::tabKey)) return false;
        if (!open->keyPressed(key) && key == KeyPress::escapeKey) model_.setSilent(true);
        return true;
    }
    // no key reaches the world behind a screen
    if (screen_ != nullptr)
        return screen_->keyPressed(key) || (key == KeyPress::escapeKey && (model_.setSilent(true), true));
    if (key == KeyPress::escapeKey && world_.isDragging()) return world_.cancelDrag(), true;
    if (key == KeyPress::escapeKey) return model_.setSilent(true), true;
    if (key == KeyPress::F2Key) return bar_.onMode(), true;
    if (key == KeyPress::F3Key) return setPanels({panels().hasDrawer, !panels().hasLower}), true;
    if (key == KeyPress::F4Key) return setPanels({!panels().hasDrawer, panels().hasLower}), true;
    if (key == KeyPress::spaceKey) return bar_.togglePause(), true;
    if (key == KeyPress{'.'}) return model_.session().world().stepOnce(), true;
    if (key == KeyPress{'a', juce::ModifierKeys::noModifiers, 0}) return world_.compare().toggle(), true;
    if (key == KeyPress{'z', juce::ModifierKeys::commandModifier, 0})
        return model_.undoManager().undo(), true;
    if (key == KeyPress{'z', juce::ModifierKeys::commandModifier | juce::ModifierKeys::shiftModifier, 0} ||
        key == KeyPress{'y', juce::ModifierKeys::commandModifier, 0})
        return model_.undoManager().redo(), true;
    return world_.keyPressed(key);
}

void MixerView::paintOverChildren(juce::Graphics& g) {
    if (!isDropShown_) return;
    g.setColour(shade(*this, Shade::accent));
    g.drawRect(getLocalBounds(), 3);
}

void MixerView::resized() {
    if (panels() != shownPanels_) return showPanels(); // which calls resized()
    auto area = getLocalBounds();
    if (isShowMode_) {
        world_.setBounds(area);
        bar_.setBounds(area.removeFromTop(TopBar::lineHeight).removeFromRight(TopBar::showWidth));
    } else {
        bar_.setBounds(area.removeFromTop(bar_.heightFor(getWidth())));
        const auto places =
            arrange(area.reduced(panelMargin),
                    {strips_.widthFor(StripView::fullWidth), strips_.widthFor(StripView::maxWidth)},
                    dividers_, mode_, panels());
        for (const auto& [panel, bounds] :
             std::initializer_list<std::pair<juce::Component*, juce::Rectangle<int>>>{
                 {&world_, places.world},
                 {&tabs_, places.tabs},
                 {&scope_, places.scope},
                 {&strips_, places.strips},
                 {&sideDivider_, places.sideDivider},
                 {&lowerDivider_, places.lowerDivider},
                 {&scopeDivider_, places.scopeDivider}})
            panel->setBounds(bounds);
    }
    layOutMessage(world_.bannerArea() + world_.getPosition());
    placeCards();
}

// Text and buttons are side by side; if the text has too little room, the buttons are below it.
void MixerView::layOutMessage(juce::Rectangle<int> banner) {
    constexpr int inset = 2, textMargin = 8, minTextWidth = 240;
    const auto& font = messageLabel_.getFont();
    const int line = banner.getHeight(),
              actionWidth = action_->isVisible()
                                ? 30 + text::pixelWidth(text::font(text::medium), action_->getButtonText())
                                : 0,
              buttonsWidth = dismissWidth - 2 + actionWidth;
    const bool isBelow = banner.getWidth() - buttonsWidth < minTextWidth;
    messageLabel_.setBorderSize({0, panelInset, isBelow ? line : 0, isBelow ? 4 : buttonsWidth + 4});
    const int room = banner.getWidth() - messageLabel_.getBorderSize().getLeftAndRight() - 2;
    messageLabel_.setText(shortenedPaths(messageLabel_.getTooltip(), font, room), dontNotify);
    const int height = std::max(line, text::heightInLines(font, messageLabel_.getText(), room) + textMargin) +
                       (isBelow ? line : 0);
    banner = banner.getY() > world_.getBounds().getCentreY() ? banner.withTop(banner.getBottom() - height)
                                                             : banner.withHeight(height);
    messageLabel_.setBounds(banner);
    auto buttons = banner.removeFromBottom(isBelow ? line : banner.getHeight()).reduced(inset);
    dismiss_->setBounds(buttons.removeFromRight(dismissWidth - 4));
    action_->setBounds(buttons.removeFromRight(actionWidth));
}

void MixerView::placeCards() {
    overlay_.setBounds(getLocalBounds());
    const auto middle = getLocalBounds().withTrimmedTop(bar_.heightFor(getWidth())).getCentre();
    if (firstStart_) firstStart_->setCentrePosition(middle);
    if (card_) card_->setCentrePosition(middle);
    if (progress_ != nullptr)
        progress_->setTopLeftPosition(world_.getRight() - progress_->getWidth() - 8,
                                      world_.getBottom() - 56 - progress_->getHeight());
}

namespace {

constexpr double minDivider = 0.05, maxDivider = 0.95;

int clampBetween(int lowest, int value, int highest) {
    return std::max(lowest, std::min(value, highest)); // in a small window, lowest may exceed highest
}

int dividerPixels(double share, int totalPixels, int automaticPixels) {
    return share > 0.0 ? juce::roundToInt(share * totalPixels) : automaticPixels;
}

} // namespace

juce::String Dividers::toText() const {
    return juce::String{side, 4} + " " + juce::String{lower, 4} + " " + juce::String{strips, 4};
}

Dividers Dividers::fromText(const juce::String& text) {
    const auto tokens = juce::StringArray::fromTokens(text, " ", {});
    const auto share = [&](int k) {
        const double value = tokens[k].getDoubleValue();
        return value >= minDivider && value <= maxDivider ? value : 0.0;
    };
    return {share(0), share(1), share(2)};
}

Arrangement arrange(juce::Rectangle<int> area, const StripWidths& widths, const Dividers& dividers, Mode mode,
                    const Panels& panels) {
    using Sizes = Arrangement;
    Arrangement places;
    const int width = area.getWidth(), height = area.getHeight(),
              names = mode == Mode::engineer ? TabPanel::foldedPixels : 0;
    const int side = panels.hasDrawer
                         ? clampBetween(Sizes::minSide,
                                        dividerPixels(dividers.side, width, std::min(560, width * 30 / 100)),
                                        width - Sizes::minSide - Sizes::dividerWidth)
                         : names;
    const int lower =
        panels.hasLower
            ? clampBetween(Sizes::minLower,
                           dividerPixels(dividers.lower, height, std::min(340, height * 30 / 100)),
                           height - Sizes::minWorldHeight - Sizes::dividerWidth)
            : names;
    const int automaticStrips = std::min(std::max(widths.minStrips, width * 45 / 100), widths.maxStrips);
    const int strips = clampBetween(
        Sizes::minStrips, dividerPixels(dividers.strips, width, std::min(automaticStrips, width * 70 / 100)),
        width - Sizes::minScope - Sizes::dividerWidth);
    auto bottom = area.removeFromBottom(lower);
    places.lowerDivider = area.removeFromBottom(lower > 0 ? Sizes::dividerWidth : 0);
    places.tabs = area.removeFromRight(side);
    places.sideDivider = area.removeFromRight(side > 0 ? Sizes::dividerWidth : 0);
    places.world = area;
    if (panels.hasLower) {
        places.strips = bottom.removeFromRight(strips);
        places.scopeDivider = bottom.removeFromRight(Sizes::dividerWidth);
    }
    places.scope = bottom;
    return places;
}

} // namespace physvib

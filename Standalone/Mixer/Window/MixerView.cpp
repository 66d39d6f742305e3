// SPDX-License-Identifier: GPL-3.0-or-later
// The panels, keyboard handling, and display updates.
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

constexpr int dismissWidth = 90, edge = 4;

/// A tab beside the world, or else below it.
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
    {true, "Actuators", make<EnchantersTab>}, {true, "Materials", make<MaterialsTab>},
    {true, "Output", make<OutputTab>},        {true, "Studies", make<StudiesTab>},
    {false, "Played now", make<ScopeView>},   {false, "Gain lanes", make<LanesTab>},
    {false, "Events", make<EventsTab>},       {false, "Takes", make<TakesTab>},
    {false, "Telemetry", make<TelemetryTab>}};

/// Fades in a component at its present place.
void comeIn(juce::Component& c) {
    constexpr int ms = 120;
    if (c.isShowing()) juce::Desktop::getInstance().getAnimator().fadeIn(&c, ms);
}

/// Gives typed text the colour of the theme; JUCE keeps the one that it was typed in.
void inkTexts(juce::Component& in) {
    if (auto* const editor = dynamic_cast<juce::TextEditor*>(&in))
        editor->applyColourToAllText(shade(in, Shade::text));
    for (auto* child : in.getChildren()) inkTexts(*child);
}

/// Shortens paths at their beginning until each fits into a line of `room` pixels.
juce::String fittingWords(const juce::String& words, const juce::Font& font, int room) {
    auto all = juce::StringArray::fromTokens(words, " ", {});
    for (auto& word : all)
        while (room > 40 && text::pixels(font, word) > room) {
            const auto rest = word.trimCharactersAtStart(dots() + "/");
            word = dots() + (rest.containsChar('/') ? rest.fromFirstOccurrenceOf("/", true, false)
                                                    : rest.substring(1));
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
    world_.onOutput = [this](int enchanter) {
        setPanels({panels().hasDrawer, true});
        strips_.showOutputs(enchanter);
    };
    world_.onProfile = [this](int enchanter) {
        tabs_.choose("Actuators");
        tabs_.find<EnchantersTab>()->editRow(enchanter);
    };
    world_.onMaterial = [this](int material, bool isRecording) {
        tabs_.choose("Materials");
        auto& tab = *tabs_.find<MaterialsTab>();
        tab.choose(material);
        if (isRecording) tab.browse();
    };
    trouble_.setTitle("Trouble");
    trouble_.setFont(text::font(text::medium));
    dismiss_ = quietButton("Dismiss", "Dismiss the message");
    dismiss_->onClick = [this] { model_.report({}); };
    act_ = quietButton({}, "Act on the message");
    act_->onClick = [this] {
        const auto act = model_.messages().shown().act.run;
        model_.report({});
        if (act) act();
    };
    addAll(*this, {&world_, &tabs_, &scope_, &strips_, &side_, &lower_, &between_, &bar_});
    side_.onMove = [this](int by) { moveDivider(&Dividers::side, -by, getWidth(), tabs_.getWidth()); };
    lower_.onMove = [this](int by) { moveDivider(&Dividers::lower, -by, getHeight(), scope_.getHeight()); };
    between_.onMove = [this](int by) { moveDivider(&Dividers::strips, -by, getWidth(), strips_.getWidth()); };
    for (const auto& [divider, which] :
         {std::pair{&side_, &Dividers::side}, {&lower_, &Dividers::lower}, {&between_, &Dividers::strips}})
        divider->onReset = [this, which = which] {
            dividers_.*which = 0.0;
            resized();
        };
    addHidden(*this, {&curtain_, &trouble_, dismiss_.get(), act_.get()});
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
    inkTexts(*this);
    sendLookAndFeelChange();
    mixChanged();
    repaint();
}

void MixerView::mixChanged() {
    restedLooks_ = 0;
    if (isTimerRunning() && getTimerInterval() > 1000 / framesPerSecond) startTimerHz(framesPerSecond);
    bar_.mixChanged();
    showLetters();
    world_.mixChanged();
    tabs_.mixChanged();
    strips_.mixChanged();
    scope_.mixChanged();
    if (const auto why = whySilent(model_); why != whySilent_) {
        whySilent_ = why;
        hintOnLevels(model_, why);
    }
    const bool isTrouble = model_.trouble().isNotEmpty();
    trouble_.setTooltip(model_.trouble());
    trouble_.setColour(juce::Label::textColourId, shade(*this, Shade::text));
    const auto tint = shade(*this, model_.isNews() ? Shade::accent : Shade::limit);
    trouble_.setColour(juce::Label::backgroundColourId,
                       shade(*this, Shade::panel).interpolatedWith(tint, 0.17f));
    const auto& act = model_.messages().shown().act.name;
    act_->setButtonText(act);
    act_->setTitle(act);
    act_->setTooltip(act);
    act_->setVisible(act.isNotEmpty());
    const bool comes = isTrouble && !trouble_.isVisible();
    trouble_.setVisible(isTrouble);
    dismiss_->setVisible(isTrouble);
    resized(); // the strips or the field may want another share
    if (comes) comeIn(trouble_);
}

// The handle moves with the panels, so each call starts from their present places.
void MixerView::moveDivider(double Dividers::*which, int pixels, int whole, int now) {
    dividers_.*which = static_cast<double>(now + pixels) /
                       (whole - (which == &Dividers::lower ? bar_.getHeight() : 0) - 2 * edge);
    resized();
}

void MixerView::setDividers(const Dividers& dividers) {
    dividers_ = dividers;
    resized();
}

void MixerView::setShow(bool isShow) {
    isShow_ = isShow;
    bar_.setShow(isShow);
    bar_.setAlwaysOnTop(isShow); // no message and no card may cover the button that silences
    world_.setShow(isShow);
    showPanels();
}

void MixerView::setMode(Mode mode) {
    mode_ = mode;
    bar_.setPlay(mode == Mode::play);
    showPanels();
}

void MixerView::setPanels(const Panels& panels) {
    nth(panels_, mode_) = panels;
    showPanels();
}

// By default the lower panels are folded where they would leave the field too little room.
Panels MixerView::panels() const {
    constexpr int least = 760;
    const auto& chosen = nth(panels_, mode_);
    return chosen.value_or(Panels{false, mode_ == Mode::engineer && getHeight() >= least});
}

juce::String MixerView::order() const {
    juce::String words{mode_ == Mode::play ? "play" : "engineer"};
    for (const auto& panels : panels_)
        words << (!panels
                      ? juce::String{" -"}
                      : juce::String{" "} + (panels->hasDrawer ? "1" : "0") + (panels->hasLower ? "1" : "0"));
    return words;
}

void MixerView::setOrder(const juce::String& order) {
    const auto words = juce::StringArray::fromTokens(order, " ", {});
    for (int k = 0; k < 2; ++k)
        if (words[k + 1].length() == 2)
            nth(panels_, k) = Panels{words[k + 1][0] == '1', words[k + 1][1] == '1'};
    setMode(words[0] == "engineer" ? Mode::engineer : Mode::play);
}

void MixerView::showPanels() {
    using Fold = TabPanel::Fold;
    const auto [hasDrawer, hasLower] = shownPanels_ = panels();
    const bool isEngineer = mode_ == Mode::engineer;
    tabs_.setFold(hasDrawer ? Fold::none : Fold::column);
    scope_.setFold(hasLower ? Fold::none : Fold::row);
    world_.setPlay(!isEngineer, !hasLower);
    for (const auto& [panel, isThere] :
         std::initializer_list<std::pair<juce::Component*, bool>>{{&tabs_, hasDrawer || isEngineer},
                                                                  {&side_, hasDrawer},
                                                                  {&scope_, hasLower || isEngineer},
                                                                  {&strips_, hasLower},
                                                                  {&lower_, hasLower},
                                                                  {&between_, hasLower}})
        panel->setVisible(isThere && !isShow_ && screen_ == nullptr);
    resized();
    repaint();
}

// Names in files may be in any script, so a typeface with their letters is selected.
void MixerView::showLetters() {
    juce::String words = model_.trouble() + juce::String::fromUTF8(model_.output().device().c_str());
    for (const auto& enchanter : model_.mix().layout.enchanters) words += utf8(enchanter.label);
    if (std::exchange(lettersOf_, model_.world().edits()) != model_.world().edits()) { // only after changes
        const Scene& scene = model_.world().drawing().drawn();
        words += utf8(scene.name);
        for (const auto& body : scene.bodies) words += utf8(body.name);
        for (const auto& material : scene.materials) words += utf8(material.name);
    }
    if (!letters_.show(words)) return;
    sendLookAndFeelChange();
    repaint();
}

void MixerView::drawCurtain() {
    const auto* const modal = juce::Component::getCurrentlyModalComponent();
    curtain_.draw(openCard() != nullptr, modal != nullptr && modal->isOnDesktop());
}

void MixerView::look() {
    drawCurtain();
    latest_ = model_.look();
    for (std::size_t j = 0; j < peaks_.size(); ++j) peaks_[j] = std::max(peaks_[j], latest_.meters.peaks[j]);
    world_.refresh(latest_);
}

void MixerView::refresh() {
    look();
    latest_.meters.peaks = std::exchange(peaks_, {});
    bar_.refresh(latest_);
    tabs_.refresh(latest_); // folded or not: a study goes on there, takes and lanes are followed
    scope_.refresh(latest_);
    strips_.refresh(latest_);
    if (std::exchange(told_, model_.messages().told()) != told_) newsAtMs_ = nowMs(), seenAtMs_ = 0.0;
    constexpr double newsMs = 10e3; // it lies over the materials to draw with
    const bool isOver =
        model_.isNews() ? nowMs() - newsAtMs_ > newsMs : seenAtMs_ > 0.0 && nowMs() - seenAtMs_ > faultMs;
    if (isOver && !model_.messages().shown().lasts()) model_.report({});
    keepPace();
}

// Errors stay until somebody may have read them: a user who moves the mouse or presses a key.
void MixerView::attend() {
    if (seenAtMs_ == 0.0 && trouble_.isVisible() && openCard() == nullptr && screen_ == nullptr)
        seenAtMs_ = nowMs();
}

// Motion needs more pictures than numbers and meters do.
void MixerView::timerCallback() {
    const bool isSeldom = getTimerInterval() > 1000 / framesPerSecond;
    isSeldom || ++looks_ % worldsPerPanel == 0 ? refresh() : look();
}

// Reduces the update rate while nothing moves and nothing plays, or nobody sees it.
void MixerView::keepPace() {
    const auto& peaks = latest_.meters.peaks;
    const bool isAtRest = model_.session().world().slowness() == 0 && latest_.hits.empty() &&
                          std::ranges::all_of(peaks, [](float p) { return p == 0.0f; });
    restedLooks_ = isAtRest ? restedLooks_ + 1 : 0;
    const auto* peer = getPeer();
    const bool isHidden = peer != nullptr && peer->isMinimised(),
               isSeldom = isHidden || restedLooks_ > 2 * framesPerSecond / worldsPerPanel;
    const int wanted = 1000 / (isSeldom ? restFramesPerSecond : framesPerSecond);
    if (isTimerRunning() && getTimerInterval() != wanted) startTimer(wanted);
}

void MixerView::setFirstStart(std::unique_ptr<FirstStart> card) {
    firstStart_ = std::move(card);
    raiseCard();
}

void MixerView::setCard(std::unique_ptr<juce::Component> card) {
    card_ = std::move(card);
    raiseCard();
}

// Whether Esc closes a card or menu, or ends a drag, without silencing. It silences as well if anything
// sounds, or did as long ago as meters hold peaks.
bool MixerView::onlyCloses() {
    if (openCard() == nullptr && juce::Component::getCurrentlyModalComponent() == nullptr &&
        !world_.isDragging())
        return false;
    look();
    return model_.isOnlySeen() || std::ranges::all_of(latest_.holds, [](float h) { return h == 0.0f; });
}

void MixerView::raiseCard() {
    auto* const open = openCard();
    drawCurtain();
    if (open == nullptr) return grabKeyboardFocus();
    curtain_.toFront(false);
    addAndMakeVisible(*open);
    inkTexts(*open);
    open->toFront(false);
    placeCards();
    comeIn(*open);
    cardFocus_.give(*open);
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
    if (details.description != EventsTab::dragged) return false;
    canMoveFiles = false;
    files = scope_.find<EventsTab>()->filesToDrag();
    return !files.isEmpty();
}

// JUCE's buttons take every button of the mouse. One that is not down when it is released does nothing.
void MixerView::releaseAtRightClick(const juce::MouseEvent& e) {
    auto* const button = dynamic_cast<juce::Button*>(e.eventComponent);
    if (button != nullptr && e.mods.isPopupMenu()) button->setState(juce::Button::buttonNormal);
}

void MixerView::setScreen(juce::Component* screen) {
    for (auto& child : hidden_)
        if (child) child->setVisible(true);
    hidden_.clear();
    screen_ = screen;
    if (screen == nullptr) return showPanels(); // as they have been ordered meanwhile
    for (auto* child : getChildren())
        if (child->isVisible()) hidden_.emplace_back(child);
    screen->setBounds(getLocalBounds());
    addAndMakeVisible(*screen);
    for (auto& child : hidden_)
        if (child) child->setVisible(false); // the outline of what had the focus goes with it
    if (screen->isShowing()) screen->grabKeyboardFocus();
}

void MixerView::chooseStudy(const StudyCall& call) {
    tabs_.choose("Studies");
    auto& tab = *tabs_.find<StudiesTab>();
    if (call.folder.isNotEmpty())
        tab.setFolder(juce::File::getCurrentWorkingDirectory().getChildFile(call.folder));
    if (call.participant.isNotEmpty()) tab.setParticipant(call.participant, std::max(1, call.number));
    tab.chooseProtocol(call.protocol.toStdString());
}

bool MixerView::pauseStudy() {
    auto* const screen = tabs_.find<StudiesTab>()->screen();
    if (screen != nullptr) screen->closeRequested();
    return screen != nullptr;
}

bool MixerView::keyPressed(const juce::KeyPress& key) {
    using juce::KeyPress;
    attend();
    if (auto* const open = openCard()) { // regardless of the focus, which Tab moves within it
        if (key.isKeyCode(KeyPress::tabKey)) return false;
        if (!open->keyPressed(key) && key == KeyPress::escapeKey) model_.setSilent(true);
        return true;
    }
    // without a focused component, keys go to the screen before the world
    if (screen_ != nullptr && screen_->keyPressed(key)) return true;
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
    if (panels() != shownPanels_) return showPanels(); // which comes back here
    auto area = getLocalBounds();
    if (isShow_) {
        world_.setBounds(area);
        bar_.setBounds(area.removeFromTop(TopBar::lineHeight).removeFromRight(TopBar::showWidth));
    } else {
        bar_.setBounds(area.removeFromTop(bar_.heightFor(getWidth())));
        const auto a =
            arrange(area.reduced(edge),
                    {strips_.widthFor(StripView::wholeWidth), strips_.widthFor(StripView::mostWidth)},
                    dividers_, mode_, panels());
        for (const auto& [panel, bounds] :
             std::initializer_list<std::pair<juce::Component*, juce::Rectangle<int>>>{{&world_, a.world},
                                                                                      {&tabs_, a.tabs},
                                                                                      {&scope_, a.scope},
                                                                                      {&strips_, a.strips},
                                                                                      {&side_, a.side},
                                                                                      {&lower_, a.lower},
                                                                                      {&between_, a.between}})
            panel->setBounds(bounds);
    }
    placeTrouble(world_.bannerArea() + world_.getPosition());
    placeCards();
}

// Words and buttons stand side by side; where the words would have no room, the buttons are below them.
void MixerView::placeTrouble(juce::Rectangle<int> banner) {
    constexpr int inset = 2, between = 8, leastWords = 240;
    const auto& font = trouble_.getFont();
    const int high = banner.getHeight(),
              actWidth =
                  act_->isVisible() ? 30 + text::pixels(text::font(text::medium), act_->getButtonText()) : 0,
              buttonsWidth = dismissWidth - 2 + actWidth;
    const bool isBelow = banner.getWidth() - buttonsWidth < leastWords;
    trouble_.setBorderSize({0, panelInset, isBelow ? high : 0, isBelow ? 4 : buttonsWidth + 4});
    const int room = banner.getWidth() - trouble_.getBorderSize().getLeftAndRight() - 2;
    trouble_.setText(fittingWords(trouble_.getTooltip(), font, room), quietly);
    const int wanted =
        std::max(high, text::high(font, trouble_.getText(), room) + between) + (isBelow ? high : 0);
    banner = banner.getY() > world_.getBounds().getCentreY() ? banner.withTop(banner.getBottom() - wanted)
                                                             : banner.withHeight(wanted);
    trouble_.setBounds(banner);
    auto buttons = banner.removeFromBottom(isBelow ? high : banner.getHeight()).reduced(inset);
    dismiss_->setBounds(buttons.removeFromRight(dismissWidth - 4));
    act_->setBounds(buttons.removeFromRight(actWidth));
}

void MixerView::placeCards() {
    curtain_.setBounds(getLocalBounds());
    const auto middle = getLocalBounds().withTrimmedTop(bar_.heightFor(getWidth())).getCentre();
    if (firstStart_) firstStart_->setCentrePosition(middle);
    if (card_) card_->setCentrePosition(middle);
    if (progress_ != nullptr)
        progress_->setTopLeftPosition(world_.getRight() - progress_->getWidth() - 8,
                                      world_.getBottom() - 56 - progress_->getHeight());
}

namespace {

constexpr double least = 0.05, most = 0.95;

int between(int lowest, int value, int highest) {
    return std::max(lowest, std::min(value, highest)); // a small window keeps the lowest
}

int shareOr(double share, int whole, int automatic) {
    return share > 0.0 ? juce::roundToInt(share * whole) : automatic;
}

} // namespace

juce::String Dividers::text() const {
    return juce::String{side, 4} + " " + juce::String{lower, 4} + " " + juce::String{strips, 4};
}

Dividers Dividers::of(const juce::String& text) {
    const auto words = juce::StringArray::fromTokens(text, " ", {});
    const auto share = [&](int k) {
        const double value = words[k].getDoubleValue();
        return value >= least && value <= most ? value : 0.0;
    };
    return {share(0), share(1), share(2)};
}

Arrangement arrange(juce::Rectangle<int> area, const Wanted& wanted, const Dividers& dividers, Mode mode,
                    const Panels& panels) {
    using A = Arrangement;
    Arrangement a;
    const int width = area.getWidth(), height = area.getHeight(),
              names = mode == Mode::engineer ? TabPanel::folded : 0;
    const int side = panels.hasDrawer
                         ? between(A::minSide, shareOr(dividers.side, width, std::min(560, width * 30 / 100)),
                                   width - A::minSide - A::seam)
                         : names;
    const int lower =
        panels.hasLower
            ? between(A::minLower, shareOr(dividers.lower, height, std::min(340, height * 30 / 100)),
                      height - A::minWorldHeight - A::seam)
            : names;
    const int fair = std::min(std::max(wanted.minStrips, width * 45 / 100), wanted.maxStrips);
    const int strips =
        between(A::minStrips, shareOr(dividers.strips, width, std::min(fair, width * 70 / 100)),
                width - A::minScope - A::seam);
    auto bottom = area.removeFromBottom(lower);
    a.lower = area.removeFromBottom(lower > 0 ? A::seam : 0);
    a.tabs = area.removeFromRight(side);
    a.side = area.removeFromRight(side > 0 ? A::seam : 0);
    a.world = area;
    if (panels.hasLower) {
        a.strips = bottom.removeFromRight(strips);
        a.between = bottom.removeFromRight(A::seam);
    }
    a.scope = bottom;
    return a;
}

} // namespace physvib

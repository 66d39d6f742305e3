// SPDX-License-Identifier: GPL-3.0-or-later
// The panels, keyboard handling, and display updates.
#include "Mixer/Window/MixerView.h"
#include "Mixer/Materials/MaterialsTab.h"
#include "Mixer/Output/EnchantersTab.h"
#include "Mixer/Output/EventsTab.h"
#include "Mixer/Output/OutputTab.h"
#include "Mixer/Output/TakesTab.h"
#include "Mixer/Output/TelemetryTab.h"
#include "Mixer/Strips/LanesTab.h"
#include "Mixer/Strips/ScopeView.h"
#include "Mixer/Studies/StudiesTab.h"
#include "Mixer/World/FeltHint.h"
#include <utility>

namespace physvib {

namespace {

constexpr int dismissWidth = 90;

} // namespace

MixerView::MixerView(Desk& desk)
    : desk_{desk}
    , bar_{desk}
    , world_{desk}
    , strips_{desk} {
    setLookAndFeel(&look_);
    setOpaque(true);
    setTitle("PhysVib mixer");
    setWantsKeyboardFocus(true);
    tabs_.add("Actuators", std::make_unique<EnchantersTab>(desk, world_.view()));
    world_.onOutput = [this](int enchanter) { strips_.showOutputs(enchanter); };
    world_.onProfile = [this](int enchanter) {
        if (auto* actuators = dynamic_cast<EnchantersTab*>(tabs_.find("Actuators")))
            actuators->editRow(enchanter);
    };
    tabs_.add("Materials", std::make_unique<MaterialsTab>(desk, world_.view()));
    tabs_.add("Output", std::make_unique<OutputTab>(desk));
    tabs_.add("Studies", std::make_unique<StudiesTab>(desk));
    scope_.add("Played now", std::make_unique<ScopeView>(desk));
    scope_.add("Gain lanes", std::make_unique<LanesTab>(desk));
    scope_.add("Events", std::make_unique<EventsTab>(desk));
    scope_.add("Takes", std::make_unique<TakesTab>(desk));
    scope_.add("Telemetry", std::make_unique<TelemetryTab>(desk));
    trouble_.setTitle("Trouble");
    trouble_.setFont(juce::Font{text::medium});
    dismiss_ = quietButton("Dismiss", "Dismiss the message");
    dismiss_->onClick = [this] { desk_.report({}); };
    act_ = quietButton({}, "Act on the message");
    act_->onClick = [this] {
        const auto act = desk_.messages().shown().act.run;
        desk_.report({});
        if (act) act();
    };
    for (juce::Component* c : std::initializer_list<juce::Component*>{&world_, &tabs_, &scope_, &strips_,
                                                                      &side_, &lower_, &between_, &bar_})
        addAndMakeVisible(c);
    side_.onMove = [this](int by) { moveDivider(&Dividers::side, -by, getWidth(), tabs_.getWidth()); };
    lower_.onMove = [this](int by) { moveDivider(&Dividers::lower, -by, getHeight(), scope_.getHeight()); };
    between_.onMove = [this](int by) { moveDivider(&Dividers::strips, -by, getWidth(), strips_.getWidth()); };
    for (const auto& [divider, which] :
         {std::pair{&side_, &Dividers::side}, {&lower_, &Dividers::lower}, {&between_, &Dividers::strips}})
        divider->onReset = [this, which = which] {
            dividers_.*which = 0.0;
            resized();
        };
    addChildComponent(curtain_);
    addChildComponent(trouble_);
    addChildComponent(*dismiss_);
    addChildComponent(*act_);
    prepareControls(*this);
    desk_.addChangeListener(this);
    addMouseListener(this, true);
    takeMix();
    setSize(1440, 900);
    startTimerHz(framesPerSecond);
}

MixerView::~MixerView() {
    desk_.removeChangeListener(this);
    setLookAndFeel(nullptr);
}

void MixerView::setGround(Ground ground) {
    look_.setGround(ground);
    sendLookAndFeelChange();
    takeMix();
    repaint();
}

void MixerView::takeMix() {
    restedLooks_ = 0;
    if (isTimerRunning() && getTimerInterval() > 1000 / framesPerSecond) startTimerHz(framesPerSecond);
    bar_.takeMix();
    showLetters();
    world_.takeMix();
    tabs_.takeMix();
    strips_.takeMix();
    scope_.takeMix();
    if (const auto why = whySilent(desk_.mix()); why != whySilent_) {
        whySilent_ = why;
        hintOnLevels(desk_, why);
    }
    const bool isTrouble = desk_.trouble().isNotEmpty();
    trouble_.setText(desk_.trouble(), juce::dontSendNotification);
    trouble_.setColour(juce::Label::textColourId, shade(*this, Shade::text));
    const auto tint = shade(*this, desk_.isNews() ? Shade::accent : Shade::limit);
    trouble_.setColour(juce::Label::backgroundColourId,
                       shade(*this, Shade::panel).interpolatedWith(tint, 0.17f));
    const auto& act = desk_.messages().shown().act.name;
    act_->setButtonText(act);
    act_->setTitle(act);
    act_->setTooltip(act);
    act_->setVisible(act.isNotEmpty());
    trouble_.setVisible(isTrouble);
    dismiss_->setVisible(isTrouble);
    resized(); // the strips or the field may want another share
}

// The handle moves with the panels, so each call starts from their present places.
void MixerView::moveDivider(double Dividers::*which, int pixels, int whole, int now) {
    dividers_.*which = static_cast<double>(now + pixels) /
                       (whole - (which == &Dividers::lower ? bar_.getHeight() : 0) - 2 * gap);
    resized();
}

void MixerView::setDividers(const Dividers& dividers) {
    dividers_ = dividers;
    resized();
}

void MixerView::setShow(bool isShow) {
    isShow_ = isShow;
    for (juce::Component* c :
         std::initializer_list<juce::Component*>{&tabs_, &scope_, &strips_, &side_, &lower_, &between_})
        c->setVisible(!isShow);
    bar_.setShow(isShow);
    bar_.setAlwaysOnTop(isShow); // no message and no card may cover the button that silences
    world_.setShow(isShow);
    resized();
    repaint();
}

// Names in files may be in any script, so a typeface with their letters is selected.
void MixerView::showLetters() {
    juce::String words = desk_.trouble() + juce::String::fromUTF8(desk_.output().device().c_str());
    for (const auto& enchanter : desk_.mix().layout.enchanters) words += utf8(enchanter.label);
    if (std::exchange(lettersOf_, desk_.world().edits()) != desk_.world().edits()) { // only after changes
        const Scene& scene = desk_.world().drawing().drawn();
        words += utf8(scene.name);
        for (const auto& body : scene.bodies) words += utf8(body.name);
        for (const auto& material : scene.materials) words += utf8(material.name);
    }
    if (!letters_.show(words)) return;
    sendLookAndFeelChange();
    repaint();
}

void MixerView::look() {
    latest_ = desk_.look();
    for (std::size_t j = 0; j < peaks_.size(); ++j) peaks_[j] = std::max(peaks_[j], latest_.meters.peaks[j]);
    world_.refresh(latest_);
}

void MixerView::refresh() {
    look();
    latest_.meters.peaks = std::exchange(peaks_, {});
    bar_.refresh(latest_);
    if (!isShow_) {
        tabs_.refresh(latest_);
        scope_.refresh(latest_);
        strips_.refresh(latest_);
    }
    keepPace();
}

// Motion needs more pictures than numbers and meters do.
void MixerView::timerCallback() {
    const bool isSeldom = getTimerInterval() > 1000 / framesPerSecond;
    isSeldom || ++looks_ % worldsPerPanel == 0 ? refresh() : look();
}

// Reduces the update rate while nothing moves and nothing plays, or nobody sees it.
void MixerView::keepPace() {
    const auto& peaks = latest_.meters.peaks;
    const bool isAtRest = desk_.session().world().slowness() == 0 && latest_.hits.empty() &&
                          std::ranges::all_of(peaks, [](float p) { return p == 0.0f; });
    restedLooks_ = isAtRest ? restedLooks_ + 1 : 0;
    const auto* peer = getPeer();
    const bool isHidden = peer != nullptr && peer->isMinimised(),
               isSeldom = isHidden || restedLooks_ > 2 * framesPerSecond / worldsPerPanel;
    const int wanted = 1000 / (isSeldom ? restFramesPerSecond : framesPerSecond);
    if (isTimerRunning() && getTimerInterval() != wanted) startTimer(wanted);
}

void MixerView::setHint(bool isShown) {
    if (isShown == isHintShown_) return;
    isHintShown_ = isShown;
    repaint(world_.getBounds());
}

void MixerView::setFirstStart(std::unique_ptr<FirstStart> card) {
    firstStart_ = std::move(card);
    raiseCard();
}

void MixerView::setCard(std::unique_ptr<juce::Component> card) {
    card_ = std::move(card);
    raiseCard();
}

void MixerView::raiseCard() {
    auto* const open = openCard();
    curtain_.setVisible(open != nullptr);
    if (open == nullptr) return grabKeyboardFocus();
    curtain_.toFront(false);
    addAndMakeVisible(*open);
    open->toFront(false);
    placeCards();
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
    auto* events = dynamic_cast<EventsTab*>(scope_.find("Events"));
    if (events == nullptr || details.description != EventsTab::dragged) return false;
    canMoveFiles = false;
    files = events->filesToDrag();
    return !files.isEmpty();
}

void MixerView::mouseDown(const juce::MouseEvent& e) {
    setHint(false);
    releaseAtRightClick(e);
}

// JUCE's buttons take every button of the mouse. One that is not down when it is released does nothing.
void MixerView::releaseAtRightClick(const juce::MouseEvent& e) {
    auto* const button = dynamic_cast<juce::Button*>(e.eventComponent);
    if (button != nullptr && e.mods.isPopupMenu()) button->setState(juce::Button::buttonNormal);
}

// A screen covers everything. Without a focused component, keys go to the screen before the world.
bool MixerView::covered(const juce::KeyPress& key) {
    const auto screen = std::ranges::find_if(getChildren(), [](const auto* child) {
        return child->isVisible() && child->getWantsKeyboardFocus();
    });
    return screen != getChildren().end() && (*screen)->keyPressed(key);
}

bool MixerView::keyPressed(const juce::KeyPress& key) {
    using juce::KeyPress;
    if (auto* const open = openCard()) { // regardless of the focus, which Tab moves within it
        if (key.isKeyCode(KeyPress::tabKey)) return false;
        if (!open->keyPressed(key) && key == KeyPress::escapeKey) desk_.setSilent(true);
        return true;
    }
    if (!world_.isVisible() && covered(key)) return true;
    setHint(false);
    if (key == KeyPress::escapeKey) return desk_.setSilent(true), true;
    if (key == KeyPress::spaceKey) return bar_.togglePause(), true;
    if (key == KeyPress{'.'}) return desk_.session().world().stepOnce(), true;
    if (key == KeyPress{'a', juce::ModifierKeys::noModifiers, 0}) return world_.compare().toggle(), true;
    if (key == KeyPress{'z', juce::ModifierKeys::commandModifier, 0}) return desk_.undoManager().undo(), true;
    if (key == KeyPress{'z', juce::ModifierKeys::commandModifier | juce::ModifierKeys::shiftModifier, 0} ||
        key == KeyPress{'y', juce::ModifierKeys::commandModifier, 0})
        return desk_.undoManager().redo(), true;
    return world_.keyPressed(key);
}

void MixerView::paint(juce::Graphics& g) { g.fillAll(shade(*this, Shade::ground)); }

void MixerView::paintOverChildren(juce::Graphics& g) {
    if (isDropShown_) {
        g.setColour(shade(*this, Shade::accent));
        g.drawRect(getLocalBounds(), 3);
    }
    if (!isHintShown_) return;
    static const juce::StringArray lines{
        "Hold the actuators: they start quietly, a quarter of full scale.",
        "Drag a ball to throw it. The bar at the left draws balls, walls and joints.",
        "Esc silences everything. More is in the menu, at the top left."};
    const juce::Font font{text::medium};
    const auto at = world_.getBounds().withSizeKeepingCentre(590, 34 + 26 * lines.size());
    g.setColour(shade(*this, Shade::raised).withAlpha(0.95f));
    g.fillRoundedRectangle(at.toFloat(), 10.0f);
    g.setFont(font);
    auto area = at.reduced(20, 15);
    for (const auto& line : lines) {
        g.setColour(shade(*this, Shade::text));
        g.drawText(line, area.removeFromTop(26), juce::Justification::centredLeft, true);
    }
}

void MixerView::resized() {
    auto area = getLocalBounds();
    if (isShow_) {
        world_.setBounds(area);
        bar_.setBounds(area.removeFromTop(TopBar::lineHeight).removeFromRight(TopBar::showWidth));
    } else {
        bar_.setBounds(area.removeFromTop(TopBar::heightFor(getWidth())));
        const auto a = arrange(area.reduced(gap),
                               {world_.fieldAspect(), strips_.widthFor(StripView::width),
                                strips_.widthFor(StripView::mostWidth)},
                               dividers_);
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
    const auto banner = world_.bannerArea() + world_.getPosition();
    trouble_.setBounds(banner);
    auto buttons = banner.reduced(2);
    dismiss_->setBounds(buttons.removeFromRight(dismissWidth - 4));
    if (act_->isVisible())
        act_->setBounds(
            buttons.removeFromRight(30 + juce::Font{text::medium}.getStringWidth(act_->getButtonText())));
    trouble_.setBorderSize({0, panelInset, 0, banner.getRight() - buttons.getRight() + 4});
    placeCards();
}

void MixerView::placeCards() {
    curtain_.setBounds(getLocalBounds());
    const auto middle = getLocalBounds().withTrimmedTop(TopBar::heightFor(getWidth())).getCentre();
    if (firstStart_) firstStart_->setCentrePosition(middle);
    if (card_) card_->setCentrePosition(middle);
    if (progress_ != nullptr)
        progress_->setTopLeftPosition(world_.getRight() - progress_->getWidth() - 8,
                                      world_.getBottom() - 56 - progress_->getHeight());
}

} // namespace physvib

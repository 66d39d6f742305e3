// SPDX-License-Identifier: GPL-3.0-or-later
// Layout of the panels, keyboard handling, and display updates 30 times a second.
#include "Mixer/Window/MixerView.h"
#include "Mixer/Materials/MaterialsTab.h"
#include "Mixer/Output/EnchantersTab.h"
#include "Mixer/Output/EventsTab.h"
#include "Mixer/Output/OutputTab.h"
#include "Mixer/Output/TelemetryTab.h"
#include "Mixer/Strips/LanesTab.h"
#include "Mixer/Strips/ScopeView.h"
#include "Mixer/Studies/StudiesTab.h"
#include <utility>

namespace physvib {

namespace {

constexpr int barHeight = 52, stripsHeight = 292, troubleHeight = 34;

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
    tabs_.add("Materials", std::make_unique<MaterialsTab>(desk, world_.view()));
    tabs_.add("Output", std::make_unique<OutputTab>(desk));
    tabs_.add("Studies", std::make_unique<StudiesTab>(desk));
    scope_.add("Played now", std::make_unique<ScopeView>(desk));
    scope_.add("Gain lanes", std::make_unique<LanesTab>(desk));
    scope_.add("Events", std::make_unique<EventsTab>(desk));
    scope_.add("Telemetry", std::make_unique<TelemetryTab>(desk));
    trouble_.setTitle("Trouble");
    trouble_.setBorderSize({0, panelInset, 0, panelInset});
    trouble_.setFont(juce::Font{text::medium});
    dismiss_ = quietButton("Dismiss", "Dismiss the message");
    dismiss_->onClick = [this] { desk_.report({}); };
    for (juce::Component* c :
         std::initializer_list<juce::Component*>{&bar_, &world_, &tabs_, &scope_, &strips_})
        addAndMakeVisible(c);
    addChildComponent(trouble_);
    addChildComponent(*dismiss_);
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
    const bool isTrouble = desk_.trouble().isNotEmpty();
    trouble_.setText(desk_.trouble(), juce::dontSendNotification);
    trouble_.setColour(juce::Label::textColourId, shade(*this, Shade::text));
    if (isTrouble == trouble_.isVisible())
        return repaint(trouble_.getBounds().getUnion(dismiss_->getBounds()));
    trouble_.setVisible(isTrouble);
    dismiss_->setVisible(isTrouble);
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

void MixerView::refresh() {
    latest_ = desk_.look();
    bar_.refresh(latest_);
    world_.refresh(latest_);
    tabs_.refresh(latest_);
    scope_.refresh(latest_);
    strips_.refresh(latest_);
    keepPace();
}

// Reduces the update rate while the world is paused and nothing plays.
void MixerView::keepPace() {
    const auto& peaks = latest_.meters.peaks;
    const bool isAtRest = desk_.session().world().slowness() == 0 && latest_.hits.empty() &&
                          std::ranges::all_of(peaks, [](float p) { return p == 0.0f; });
    restedLooks_ = isAtRest ? restedLooks_ + 1 : 0;
    const int wanted = 1000 / (restedLooks_ > 2 * framesPerSecond ? restFramesPerSecond : framesPerSecond);
    if (isTimerRunning() && getTimerInterval() != wanted) startTimer(wanted);
}

void MixerView::setHint(bool isShown) {
    if (isShown == isHintShown_) return;
    isHintShown_ = isShown;
    repaint(world_.getBounds());
}

void MixerView::setFirstStart(std::unique_ptr<FirstStart> card) {
    firstStart_ = std::move(card);
    if (!firstStart_) return grabKeyboardFocus();
    addAndMakeVisible(*firstStart_);
    resized();
    firstStart_->grabKeyboardFocus();
}

void MixerView::setQuestion(std::unique_ptr<QuestionCard> card) {
    question_ = std::move(card);
    if (!question_) return grabKeyboardFocus();
    addAndMakeVisible(*question_);
    resized();
    question_->grabKeyboardFocus();
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

// A screen covers everything. Without a focused component, keys go to the screen before the world.
bool MixerView::covered(const juce::KeyPress& key) {
    const auto screen = std::ranges::find_if(getChildren(), [](const auto* child) {
        return child->isVisible() && child->getWantsKeyboardFocus();
    });
    return screen != getChildren().end() && (*screen)->keyPressed(key);
}

bool MixerView::keyPressed(const juce::KeyPress& key) {
    using juce::KeyPress;
    if (!world_.isVisible() && covered(key)) return true;
    if (question_ && question_->keyPressed(key)) return true; // regardless of the focus
    if (firstStart_ && firstStart_->keyPressed(key)) return true;
    setHint(false);
    if (key == KeyPress::escapeKey) return desk_.takeEscape(), true;
    if (key == KeyPress::spaceKey) return bar_.togglePause(), true;
    if (key == KeyPress{'.'}) return desk_.session().world().stepOnce(), true;
    if (key == KeyPress{'z', juce::ModifierKeys::commandModifier, 0}) return desk_.undoManager().undo(), true;
    if (key == KeyPress{'z', juce::ModifierKeys::commandModifier | juce::ModifierKeys::shiftModifier, 0} ||
        key == KeyPress{'y', juce::ModifierKeys::commandModifier, 0})
        return desk_.undoManager().redo(), true;
    return world_.keyPressed(key);
}

void MixerView::paint(juce::Graphics& g) {
    g.fillAll(shade(*this, Shade::ground));
    if (!trouble_.isVisible()) return;
    g.setColour(shade(*this, desk_.isNews() ? Shade::accent : Shade::limit).withAlpha(0.22f));
    g.fillRoundedRectangle(trouble_.getBounds().getUnion(dismiss_->getBounds()).toFloat(), 6.0f);
}

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
    bar_.setBounds(area.removeFromTop(barHeight));
    area.reduce(gap, gap);
    if (trouble_.isVisible()) {
        auto row = area.removeFromTop(troubleHeight);
        dismiss_->setBounds(row.removeFromRight(90));
        trouble_.setBounds(row);
        area.removeFromTop(gap);
    }
    const int lower = std::min(stripsHeight, area.getHeight() * 44 / 100);
    auto bottom = area.removeFromBottom(lower);
    area.removeFromBottom(gap);
    const int right = juce::jlimit(400, 640, area.getWidth() * 39 / 100);
    tabs_.setBounds(area.removeFromRight(right));
    area.removeFromRight(gap);
    world_.setBounds(area);
    const auto middle = getLocalBounds().withTrimmedTop(barHeight).getCentre();
    if (firstStart_) firstStart_->setCentrePosition(middle);
    if (question_) question_->setCentrePosition(middle);
    strips_.setBounds(bottom.removeFromRight(right));
    bottom.removeFromRight(gap);
    scope_.setBounds(bottom);
}

} // namespace physvib

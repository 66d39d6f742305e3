// SPDX-License-Identifier: GPL-3.0-or-later
// Layout, menus and mouse input of the panel, the text on the strongest hit, and the script strip.
#include "Mixer/World/WorldPanel.h"
#include "Core/NameNumbers.h"
#include "Scene/SceneEdits.h"
#include <limits>

namespace physvib {
namespace {

constexpr double minHitTextMs = 900.0;  // minimum time that a hit is described, unless a stronger one comes
constexpr double gripIntervalMs = 10.0; // between inputs while a body is held; mice report more often
constexpr double gripSeconds = 0.02;    // duration of each grip; the next one comes before its end
// widths of the panel in pixels at which law, master and drag knob have room; bottom row and knobs
constexpr int minWidthWithLaw = 700, masterWidth = 260, minWidthWithKnob = 820, footerHeight = 42,
              knobWidth = 38;
const juce::String separator = "  " + juce::String::charToString(0x00b7) + "  ";
const juce::String kiloNewtonSeconds = juce::String::fromUTF8("kN\xc2\xb7s");

juce::String strengthText(double g) {
    return g < 0.02 ? "hardly felt" : g < 0.1 ? "felt softly" : g < 0.4 ? "felt" : "felt strongly";
}

constexpr double stepSeconds = 0.01; // step of the trim sliders: one step of the world

} // namespace

WorldPanel::WorldPanel(MixerModel& model)
    : model_{model} {
    setTitle("World");
    setWantsKeyboardFocus(true);
    // what the pointer does in the view
    view_.onFling = [this](const std::string& body, Vector screenMetres, Vector point) {
        const double push = model_.mix().dragNewtonSecondsPerScreenMetre;
        model_.reportIfError(
            model_.world().apply(ImpulseAction{body, {push * screenMetres.x, push * screenMetres.y}, point}));
    };
    view_.onHold = [this](const std::string& body, Vector point, Vector target) {
        pendingGrip_ = GripAction{body, target, point, gripSeconds};
        sendGrip();
    };
    view_.onRelease = [this](const std::string& body) {
        pendingGrip_.reset();
        model_.reportIfError(model_.world().apply(GripAction{body, {}, {}}));
    };
    view_.flingText = [this](double screenMetres) {
        return "drag " + number(1e-3 * model_.mix().dragNewtonSecondsPerScreenMetre * screenMetres, 2) + " " +
               kiloNewtonSeconds;
    };
    view_.onAttach = [this](FieldShare share) { model_.attach(share.x, share.y); };
    view_.onDetach = [this](int actuator) { model_.detach(actuator); };
    view_.acceptsFiles = isClipDrag;
    view_.onFiles = [this](const juce::StringArray& files, int actuator, FieldShare share) {
        if (actuator >= 0)
            model_.eventPlayer().playClipOn(files, actuator);
        else
            model_.eventPlayer().playClipAt(files, share.x, share.y);
    };
    view_.onMove = [this](int actuator, FieldShare newShare) {
        const auto name = "Move " + labelOf(model_.mix(), actuator);
        model_.change(name, std::exchange(isBadgeMoving_, true), [&](Mix& mix) {
            auto& layout = mix.layout.geometry;
            auto& place = nth(layout.places, actuator); // depth and part of the body stay unchanged
            place.xMetres = newShare.x * layout.extentWidthMetres;
            place.yMetres = newShare.y * layout.extentHeightMetres;
            mix.layout.name = "own";
        });
    };
    view_.addMouseListener(this, false);
    view_.onMenu = pane_.onMenu = [this](juce::Point<float> place) {
        makeMenu(place).showMenuAsync(
            juce::PopupMenu::Options{}.withTargetComponent(view_).withMousePosition());
    };
    // row below the view
    hitLabel_.setTitle("Strongest hit");
    hitLabel_.setFont(text::font(text::medium));
    lawLabel_.setBorderSize({0, 0, 0, 6});
    for (auto* name : {&tiltLabel_, &dragLabel_}) name->setBorderSize({0, 5, 0, 0});
    lawLabel_.setJustificationType(juce::Justification::centredRight);
    tilt_.onValueChange = [this] {
        if (player_ && player_->moves())
            sendInput(player_->tilt(tilt_.angleRadians()));
        else
            model_.world().apply(TiltAction{tilt_.angleRadians()});
    };
    drag_.setTitle("Drag strength");
    drag_.setSliderStyle(juce::Slider::RotaryHorizontalVerticalDrag);
    drag_.setTextBoxStyle(juce::Slider::NoTextBox, true, 0, 0);
    drag_.setTooltip("Drag strength: how hard a body is pushed per metre of the screen that it is dragged; "
                     "double click: as in the thesis");
    drag_.setRange(minDrag, maxDrag, 1'000.0);
    drag_.setSkewFactorFromMidPoint(10'000.0);
    drag_.setDoubleClickReturnValue(true, defaultDrag);
    drag_.textFromValueFunction = [](double push) {
        return number(1e-3 * push, 0) + " " + kiloNewtonSeconds + "/m";
    };
    onSliderChange(drag_, [this](bool continuesEdit) {
        model_.change("Drag strength", continuesEdit,
                      [this](Mix& mix) { mix.dragNewtonSecondsPerScreenMetre = drag_.getValue(); });
    });
    abButton_.setTitle("Compare A and B");
    abButton_.onClick = [this] { comparison_.toggle(); };
    addAll(*this, {&view_, &pane_, &toolBar_, &hitLabel_, &lawLabel_, &abButton_, &tilt_, &tiltLabel_, &drag_,
                   &dragLabel_});
    addHidden(*this, {&master_, &palette_, &bodyPanel_, &scriptStrip_});
    pane_.onChange = [this] { showTools(); };
    mixChanged();
}

void WorldPanel::mixChanged() {
    const auto& mix = model_.mix();
    const auto& scene = model_.world().scene();
    if (shownScene_ != mix.scene) {
        player_.emplace(scene);
        pendingInputs_.clear();
        if (!player_->isPresent()) player_.reset();
        tiltLabel_.setText(player_ ? "arrows play" : "gravity", juce::dontSendNotification);
    }
    if (shownScene_ != mix.scene || shownEditCount_ != model_.world().editCount()) view_.show(scene);
    shownScene_ = mix.scene;
    shownEditCount_ = model_.world().editCount();
    pane_.mixChanged();
    showTools();
    std::vector<bool> muted, withoutOutput;
    for (int j = 0; j < mix.count(); ++j) {
        withoutOutput.push_back(!model_.device().isPlayed(static_cast<std::size_t>(j)));
        muted.push_back(mix.isSilent(j) || withoutOutput.back());
    }
    view_.show(mix.layout, mix.panner(), std::move(muted), std::move(withoutOutput));
    master_.mixChanged();
    view_.setDisplayWidth(model_.displayWidthMetres());
    lawLabel_.setText(juce::String{nameOf(mix.panner().law()).data()} + " law" + separator + "exponent " +
                          number(mix.exponent, 1),
                      juce::dontSendNotification);
    const bool isB = comparison_.isComparing() && comparison_.activeState() == 'B';
    abButton_.setButtonText(!comparison_.isComparing() ? "A/B" : isB ? "B" : "A");
    abButton_.setToggleState(comparison_.isComparing(), juce::dontSendNotification);
    abButton_.setTooltip(!comparison_.isComparing()
                             ? juce::String{"Compare two laws, layouts or mixes (A): B begins as a copy of A"}
                             : juce::String{isB ? "B" : "A"} + " plays, " +
                                   number(comparison_.loweredDb(), 1) +
                                   " dB lower, as loud as the other (A changes; the menu ends it)");
    if (!drag_.isMouseButtonDown())
        drag_.setValue(mix.dragNewtonSecondsPerScreenMetre, juce::dontSendNotification);
    dragLabel_.setText("drag " + drag_.getTextFromValue(drag_.getValue()), juce::dontSendNotification);
}

void WorldPanel::showTools() {
    if (isShowMode_ && pane_.tool() != DrawTool::hand)
        return pane_.setTool(DrawTool::hand); // calls this again
    toolBar_.refresh();
    palette_.refresh();
    palette_.setVisible(!isShowMode_ && pane_.tool() != DrawTool::hand);
    scriptStrip_.refresh(!isShowMode_ && pane_.tool() == DrawTool::hand);
    bodyPanel_.refresh();
    placeBodyPanel();
}

/// Place in the field where the body panel covers least of badges and selection. It stays where it is if no
/// other place is better, and while the pointer is over it.
juce::Rectangle<int> WorldPanel::bodyPanelAreaInField(int width, int height) const {
    const auto field = juce::Rectangle<float>{view_.pixelOfShare({0.0, 1.0}), view_.pixelOfShare({1.0, 0.0})}
                           .toNearestInt() +
                       view_.getPosition();
    const auto inner = field.reduced(24);
    const auto selectionArea = pane_.selectionBounds().toNearestInt().expanded(4) + pane_.getPosition();
    const auto coveredPixels = [&](juce::Rectangle<int> place) {
        const auto overlap = [&place](juce::Rectangle<int> other) {
            const auto common = place.getIntersection(other);
            return common.getWidth() * common.getHeight();
        };
        int sum = overlap(selectionArea);
        for (const auto& badge : view_.badges()) sum += overlap(badge.toNearestInt() + view_.getPosition());
        return sum;
    };
    auto best = bodyPanel_.getBounds();
    const bool isPlaced = best.getWidth() == width && best.getHeight() == height && inner.contains(best);
    if (isPlaced && bodyPanel_.isMouseOver(true)) return best;
    int minCovered = isPlaced ? coveredPixels(best) : std::numeric_limits<int>::max();
    for (const int y : {inner.getY(), inner.getCentreY() - height / 2, inner.getBottom() - height})
        for (const int x : {inner.getRight() - width, inner.getX(), inner.getCentreX() - width / 2})
            if (const juce::Rectangle<int> place{x, y, width, height}; coveredPixels(place) < minCovered)
                best = place, minCovered = coveredPixels(place);
    return best;
}

// The body panel is beside the field if there is room, else in a line above it, else in it.
void WorldPanel::placeBodyPanel() {
    if (!bodyPanel_.isVisible()) return;
    const auto freeArea = getLocalBounds()
                              .withTrimmedTop(palette_.getBottom() + 2)
                              .withTrimmedBottom(footerHeight)
                              .withLeft(palette_.getX())
                              .withTrimmedRight(8);
    const auto edgeAt = [this](double metres) {
        return juce::roundToInt(view_.pixelOfMetres({metres, 0.0}).x) + view_.getX();
    };
    // badges lie on the edge of the field, walls outside it
    constexpr int distance = 20, minGap = 4, width = BodyPanel::preferredWidth;
    const int right = edgeAt(model_.world().scene().fieldWidthMetres), left = edgeAt(0.0) - width;
    const int height = bodyPanel_.heightFor(width);
    juce::Rectangle<int> place{0, freeArea.getCentreY() - height / 2, width, height};
    if (right + minGap + width <= freeArea.getRight())
        place.setX(std::min(right + distance, freeArea.getRight() - width));
    else if (left - minGap >= freeArea.getX())
        place.setX(std::max(left - distance, freeArea.getX()));
    else {
        place = freeArea.withHeight(bodyPanel_.heightFor(freeArea.getWidth()));
        constexpr int badge = 15; // height of a badge above the field
        const int top = juce::roundToInt(view_.pixelOfShare({0.0, 1.0}).y) + view_.getY() - badge;
        if (place.getBottom() > top) place = bodyPanelAreaInField(width, height);
    }
    bodyPanel_.setBounds(place);
}

juce::Rectangle<int> WorldPanel::bannerArea() const {
    auto row = getLocalBounds().reduced(8, 4);
    if (isShowMode_) return row.withTrimmedRight(silenceWidth).withHeight(28);
    // beside the knobs and A/B if there is room
    if (const auto freeRow = row.withRight(tilt_.getX() - 8); hasMaster_ || freeRow.getWidth() >= 280)
        row = freeRow;
    return row.removeFromBottom(footerHeight - 9);
}

void WorldPanel::setShowMode(bool isShow) {
    isShowMode_ = isShow;
    if (isShow) pane_.setTool(DrawTool::hand);
    physvib::setVisible({&toolBar_, &hitLabel_, &tilt_, &tiltLabel_}, !isShow);
    showTools();
    resized();
}

void WorldPanel::setPlayMode(bool isPlay, bool hasMaster) {
    isPlayMode_ = isPlay;
    hasMaster_ = hasMaster;
    resized();
}

/// Sends input of a player. The first one replaces the scene's script: the world restarts without it.
void WorldPanel::sendInput(const std::vector<Action>& actions) {
    if (actions.empty()) return;
    if (const Scene& drawn = model_.world().drawing().drawn(); sceneForUserInput(drawn) != drawn) {
        auto scene = sceneForUserInput(drawn);
        previousRunCount_ = model_.savedSession().log.runs.size();
        model_.change("Play",
                      [&scene](Mix& mix) { mix.scene = std::make_shared<const Scene>(std::move(scene)); });
        shownScene_ = model_.mix().scene; // so that mixChanged() keeps the player
        pendingInputs_ = actions;
        return;
    }
    if (!pendingInputs_.empty()) {
        pendingInputs_ = actions;
        return;
    }
    for (const Action& action : actions) model_.reportIfError(model_.world().apply(action));
}

bool WorldPanel::keyPressed(const juce::KeyPress& key) {
    if (!isShowMode_ && pane_.handleKey(key)) return true; // show mode has no tools
    if (!player_) return tilt_.handleKey(key);
    if (key == juce::KeyPress::leftKey) return sendInput(player_->steer(-1)), true;
    if (key == juce::KeyPress::rightKey) return sendInput(player_->steer(1)), true;
    if (key == juce::KeyPress::downKey) return sendInput(player_->steer(0)), true;
    return false;
}

// A body that is moved stops when the key is released; one that is driven keeps going.
bool WorldPanel::keyStateChanged(bool isDown) {
    using juce::KeyPress;
    if (isDown || !player_ || !player_->moves() || KeyPress::isKeyCurrentlyDown(KeyPress::leftKey) ||
        KeyPress::isKeyCurrentlyDown(KeyPress::rightKey))
        return false;
    return sendInput(player_->steer(0)), false;
}

double WorldPanel::fieldXMetres(float x) const {
    const float left = view_.pixelOfShare({0.0, 0.0}).x, right = view_.pixelOfShare({1.0, 0.0}).x;
    return model_.world().scene().fieldWidthMetres * static_cast<double>((x - left) / (right - left));
}

void WorldPanel::mouseUp(const juce::MouseEvent&) {
    isBadgeMoving_ = false;
    if (std::exchange(pointerXMetres_, {}) && player_) sendInput(player_->steer(0));
}

void WorldPanel::cancelDrag() {
    view_.cancelDrag();
    pane_.cancelStroke();
    if (std::exchange(isBadgeMoving_, false) && model_.undoManager().getNumActionsInCurrentTransaction() > 0)
        model_.undoManager().undo(); // unless the hand has undone it
    if (std::exchange(pointerXMetres_, {}) && player_) sendInput(player_->steer(0));
}

void WorldPanel::updatePlayer() {
    if (!player_) return;
    // the first inputs are sent once the world has restarted
    if (!pendingInputs_.empty() && model_.savedSession().log.runs.size() > previousRunCount_)
        sendInput(std::exchange(pendingInputs_, {}));
    if (!player_->moves()) return;
    const float bodyX = view_.pixelOfBody(player_->body()).x;
    if (bodyX < -1e3f) return;
    if (pointerXMetres_) sendInput(player_->moveTowards(*pointerXMetres_, fieldXMetres(bodyX)));
    for (const Action& action : player_->keepInside(fieldXMetres(bodyX))) model_.world().apply(action);
}

void WorldPanel::sendGrip() {
    if (!pendingGrip_ || nowMs() - lastGripMs_ < gripIntervalMs) return;
    lastGripMs_ = nowMs();
    model_.reportIfError(model_.world().apply(*std::exchange(pendingGrip_, {})));
}

juce::String WorldPanel::hitText(const CollisionEvent& hit) const {
    const auto& scene = model_.world().scene();
    const auto name = materialName(scene, hit), place = placeText(scene, hit);
    if (isClip(hit.sound)) return fitInLines({name, place});
    const double g = strongestActuatorFor(model_, hit).levelG; // 0: its actuators are muted or have no output
    const bool isOnlySeen = g < 0.005 || (isPlayMode_ && model_.isVisualOnly());
    auto feltText = (isOnlySeen    ? juce::String{"seen"}
                     : isPlayMode_ ? strengthText(g)
                                   : number(g, 2) + " g") +
                    " " + place;
    if (isOnlySeen) feltText << ": " << reasonNotPlayed(model_, hit);
    if (isPlayMode_) return fitInLines({name, feltText});
    const auto hz = number(hit.frequencyHz, 0) + " Hz";
    const auto tau = juce::String::charToString(0x03c4) + " " + number(hit.decayPerSecond, 0) + " /s";
    for (const auto& parts : {juce::StringArray{name, hz, tau, feltText}, {name, hz, feltText}})
        if (const auto fittingText = fitInLines(parts); fittingText.isNotEmpty()) return fittingText;
    return fitInLines({name, feltText});
}

/// The parts in one or two lines; empty if they do not fit.
juce::String WorldPanel::fitInLines(const juce::StringArray& parts) const {
    const auto font = hitLabel_.getFont();
    const int freeWidth = hitLabel_.getWidth() - hitLabel_.getBorderSize().getLeftAndRight() - 10;
    juce::StringArray lines{parts[0]};
    for (int k = 1; k < parts.size(); ++k) {
        const auto longer = lines.strings.getReference(lines.size() - 1) + separator + parts[k];
        if (text::pixelWidth(font, longer) <= freeWidth)
            lines.set(lines.size() - 1, longer);
        else
            lines.add(parts[k]);
    }
    return lines.size() <= 2 ? lines.joinIntoString("\n") : juce::String{};
}

/// Why nothing is felt; empty if something is or may soon be felt.
juce::String WorldPanel::findNothingFeltReason(double nowMs, bool isRunning) const {
    constexpr double maxQuietMs = 4000.0;
    if (const auto reason = muteReason(); reason.isNotEmpty()) return reason;
    if (!isRunning) return "no device plays";
    if (model_.session().world().slowness() == 0) return "paused";
    const Scene& drawn = model_.world().drawing().drawn();
    const auto hasBody = [&drawn](auto matches) {
        return std::ranges::any_of(drawn.bodies, matches) ||
               std::ranges::any_of(drawn.script, [&matches](const ScriptInput& input) {
                   const auto* addedBody = bodyAddedBy(input.action);
                   return addedBody != nullptr && matches(*addedBody);
               });
    };
    if (!hasBody([](const BodyDescription& body) { return body.type != BodyType::staticBody; }))
        return "draw a ball: B";
    if (nowMs - hitTimeMs_ > minHitTextMs && !hasBody(isSource)) return "no body is a haptic source";
    if (nowMs - hitTimeMs_ <= maxQuietMs) return "";
    const bool haveAllLeft = std::ranges::all_of(drawn.bodies, [&](const BodyDescription& body) {
        const auto place = body.type == BodyType::staticBody ? std::nullopt : pane_.currentPlace(body.name);
        if (!place) return true;
        const auto [x, y] = place->metres;
        return x < 0.0 || y < 0.0 || x > drawn.fieldWidthMetres || y > drawn.fieldHeightMetres;
    });
    return haveAllLeft && drawn.script.empty() ? "all that moves has left the field" : "no hits";
}

void WorldPanel::showHit() {
    const auto hit = shownHit_.amplitude == 0.0 ? juce::String{} : hitText(shownHit_);
    hitLabel_.setText(nothingFeltReason_.isEmpty() ? hit : fitInLines({"Nothing felt", nothingFeltReason_}),
                      juce::dontSendNotification);
}

void WorldPanel::refresh(const MixerSnapshot& snapshot) {
    const double now = nowMs();
    if (std::exchange(hitScene_, model_.mix().scene) != model_.mix().scene) shownHit_ = {}, hitTimeMs_ = now;
    bool hasNewHit = false;
    for (const auto& hit : snapshot.hits)
        if (now - hitTimeMs_ > minHitTextMs || std::abs(hit.amplitude) > std::abs(shownHit_.amplitude))
            shownHit_ = hit, hitTimeMs_ = now, hasNewHit = true;
    if (const auto reason = findNothingFeltReason(now, snapshot.device.isRunning);
        reason != std::exchange(nothingFeltReason_, reason) || hasNewHit)
        showHit();
    if (hasMaster_) master_.refresh(snapshot);
    updatePlayer();
    sendGrip();
    pane_.spawnDueBodies();
    if (model_.script().isRecording() || scriptStrip_.isVisible())
        scriptStrip_.refresh(pane_.tool() == DrawTool::hand);
    placeBodyPanel();
    static constexpr decltype(snapshot.meters.peaks) noPeaks{};
    const bool isFelt = muteReason().isEmpty();
    const auto& peaks = isFelt ? snapshot.meters.peaks : noPeaks; // badges glow only for what is felt
    view_.update({snapshot.poses, snapshot.posesNs, snapshot.latencyNs, snapshot.hits,
                  std::span{peaks}.first(static_cast<std::size_t>(model_.mix().count())), isFelt});
}

void WorldPanel::resized() {
    auto row = getLocalBounds().reduced(panelInset, 0).removeFromBottom(footerHeight).withTrimmedBottom(5);
    const bool showsFigures = !isShowMode_ && !isPlayMode_;
    lawLabel_.setVisible(showsFigures && getWidth() >= minWidthWithLaw + (hasMaster_ ? masterWidth : 0));
    abButton_.setVisible(showsFigures);
    master_.setVisible(!isShowMode_ && hasMaster_);
    physvib::setVisible({&drag_, &dragLabel_},
                        showsFigures && (!hasMaster_ || getWidth() >= minWidthWithKnob));
    if (hasMaster_) {
        master_.setBounds(row.removeFromRight(getWidth() >= minWidthWithKnob ? masterWidth : 200));
        row.removeFromRight(gap);
    }
    if (showsFigures) abButton_.setBounds(row.removeFromRight(46).reduced(2, 5));
    if (lawLabel_.isVisible()) lawLabel_.setBounds(row.removeFromRight(174));
    if (drag_.isVisible()) {
        dragLabel_.setBounds(row.removeFromRight(104));
        drag_.setBounds(row.removeFromRight(knobWidth));
    }
    tiltLabel_.setBounds(row.removeFromRight(58));
    tilt_.setBounds(row.removeFromRight(knobWidth));
    hitLabel_.setBounds(row);
    showHit();
    auto top = getLocalBounds().reduced(6, 8).withTrimmedBottom(footerHeight);
    const int toolsWidth = isShowMode_ ? 0 : DrawBar::widthFor(top.getHeight());
    toolBar_.setBounds(top.removeFromLeft(toolsWidth));
    view_.setBounds(getLocalBounds().reduced(3)); // inside the panel's round corners
    constexpr int silenceHeight = 40;             // the button lies over the corner of a show
    view_.setPadding(
        isShowMode_ ? juce::BorderSize<int>{silenceHeight, 0, 0, 0}
                    : juce::BorderSize<int>{hasMaster_ ? 51 : 20, toolsWidth - 12, footerHeight - 14, 0});
    pane_.setBounds(view_.getBounds().withTrimmedBottom(isShowMode_ ? 0 : footerHeight - 4)); // above the row
    top.removeFromLeft(8);
    scriptStrip_.setBounds(top.withHeight(scriptStrip_.getHeight()));
    palette_.setBounds(top.removeFromTop(26));
    placeBodyPanel();
}

juce::PopupMenu WorldPanel::makeMenu(juce::Point<float> place) {
    juce::PopupMenu menu;
    const auto target = view_.targetAt(place);
    if (target.actuator >= 0)
        addActuatorItems(menu, target.actuator);
    else if (!target.body.empty())
        addBodyItems(menu, target.body, view_.metresAt(place));
    else
        addFieldItems(menu, target.at, view_.metresAt(place));
    menu.setLookAndFeel(&getLookAndFeel());
    return menu;
}

void WorldPanel::addActuatorItems(juce::PopupMenu& menu, int actuator) {
    menu.addSectionHeader("Actuator " + labelOf(model_.mix(), actuator));
    menu.addItem("Test pulse", [this, actuator] { model_.eventPlayer().testPulse(actuator); });
    menu.addItem("Sweep", [this, actuator] { model_.eventPlayer().testSweep(actuator); });
    const auto isMuted = [actuator](auto& mix) -> auto& { return nth(mix.strips, actuator).isMuted; };
    menu.addItem("Mute", true, isMuted(model_.mix()),
                 [this, isMuted] { model_.change("Mute", [&](Mix& mix) { isMuted(mix) = !isMuted(mix); }); });
    menu.addItem("Output" + ellipsis(), onOutput != nullptr, false, [this, actuator] { onOutput(actuator); });
    menu.addItem("Name, profile" + ellipsis(), onProfile != nullptr, false,
                 [this, actuator] { onProfile(actuator); });
    menu.addSeparator();
    menu.addItem("Detach", model_.mix().count() > 1, false, [this, actuator] { model_.detach(actuator); });
}

// Bodies that a script adds are not part of the drawing: only their material can be changed.
void WorldPanel::addBodyItems(juce::PopupMenu& menu, const std::string& body, Vector place) {
    juce::PopupMenu materials;
    const auto& scene = model_.world().drawing().drawn();
    const auto* drawn = model_.world().drawing().find(body);
    const bool isDrawn = drawn != nullptr, moves = isDrawn && drawn->type == BodyType::dynamicBody;
    for (int i = 0; i < static_cast<int>(scene.materials.size()); ++i)
        materials.addItem(utf8(nth(scene.materials, i).name), true,
                          isDrawn && drawn->fixtures[0].material == i, [this, body, i] {
                              model_.reportIfError(model_.world().edit(
                                  "Material of " + utf8(body), MaterialAction{body, everyFixture, i}));
                          });
    menu.addSectionHeader(utf8(body));
    menu.addSubMenu("Material", materials);
    const auto selectBody = [this, body] { pane_.setTool(DrawTool::select), pane_.select({body}); };
    menu.addItem("Select", isDrawn, false, selectBody);
    if (isDrawn && findMotor(scene, body) != nullptr)
        menu.addItem("Motor: speed and torque", selectBody);
    else
        menu.addItem("Motor here", moves, false, [this, place] { pane_.addJointAt(DrawTool::motor, place); });
    if (isDrawn && findSpring(scene, body) != nullptr)
        menu.addItem("Spring: stiffness", selectBody);
    else
        menu.addItem("Spring here", moves, false,
                     [this, place] { pane_.addJointAt(DrawTool::spring, place); });
    menu.addItem("Pin here", moves, false, [this, place] { pane_.addJointAt(DrawTool::pin, place); });
    menu.addSeparator();
    menu.addItem("Copy", isDrawn, false, [this, body] { pane_.copy({body}); });
    menu.addItem("Delete", isDrawn, false, [this, body] { pane_.eraseBodies({body}); });
}

void WorldPanel::addFieldItems(juce::PopupMenu& menu, FieldShare share, Vector place) {
    for (const DrawTool tool : {DrawTool::ball, DrawTool::box, DrawTool::wall, DrawTool::rain})
        menu.addItem("Add " + juce::String{toolInfo(tool).name}.toLowerCase(),
                     [this, tool, place] { pane_.addAt(tool, place); });
    menu.addItem("Paste here", pane_.hasCopy(), false, [this, place] { pane_.pasteAt(place); });
    menu.addSeparator();
    menu.addItem("Attach an actuator here", model_.mix().count() < limits::maxActuators, false,
                 [this, share] { model_.attach(share.x, share.y); });
}

ScriptStrip::ScriptStrip(MixerModel& model)
    : model_{model} {
    setTitle("Script of hands");
    status_.setFont(text::font(text::medium));
    for (auto* slider : {&fromSlider_, &toSlider_}) {
        slider->setSliderStyle(juce::Slider::LinearBar);
        slider->setRange(0.0, 1.0, stepSeconds);
        slider->valueFromTextFunction = [](const juce::String& typed) { return typedNumber(typed, false); };
        slider->onDragEnd = [this] { applyTrim(); };
        slider->onValueChange = [this, slider] {
            if (!slider->isMouseButtonDown()) applyTrim();
            repaint();
        };
    }
    describe(fromSlider_, "The script begins at", "Where the script begins, in seconds of the recording");
    fromSlider_.textFromValueFunction = [](double s) { return "from " + number(s, 2) + " s"; };
    describe(toSlider_, "The script ends at", "Where the script ends, in seconds of the recording");
    toSlider_.textFromValueFunction = [](double s) { return "to " + number(s, 2) + " s"; };
    describe(repeatToggle_, "Repeat the script", "Begins again at its end, for ever");
    repeatToggle_.onClick = [this] { applyTrim(); };
    describe(endButton_, "End the recording of hands", "End the recording of hands (Ctrl+Shift+R)");
    endButton_.setToggleState(true, juce::dontSendNotification);
    endButton_.onClick = [this] { model_.script().stop(); };
    restartButton_.setTitle("Play the script from the start");
    restartButton_.onClick = [this] { model_.restart(model_.mix().seed); };
    describe(closeButton_, "Close the script of hands", "The script stays");
    closeButton_.onClick = [this] {
        closedScene_ = model_.mix().scene;
        setVisible(false);
    };
    addHidden(*this, {&status_, &fromSlider_, &toSlider_, &repeatToggle_, &endButton_, &restartButton_,
                      &closeButton_});
    setSize(400, fullHeight);
}

void ScriptStrip::refresh(bool isHandTool) {
    const auto& script = model_.script();
    const RecordedInputs* recording = script.recording();
    setVisible(isHandTool &&
               (script.isRecording() || (recording != nullptr && closedScene_ != model_.mix().scene)));
    if (!isVisible()) return;
    const bool hasNewScene = std::exchange(shownScene_, model_.mix().scene) != model_.mix().scene,
               hasToggled = std::exchange(isRecordingShown_, script.isRecording()) != script.isRecording();
    if (hasNewScene || hasToggled) showScript();
    if (script.isRecording())
        status_.setText("Recording hands" + separator + number(script.seconds(), 1) + " s" + separator +
                            countText(script.inputs(), "input"),
                        juce::dontSendNotification);
    else
        status_.setText("Script of hands" + separator + countText(recording->inputs.size(), "input") +
                            " in " + number(recording->lengthSeconds, 2) + " s",
                        juce::dontSendNotification);
    status_.setColour(juce::Label::textColourId,
                      shade(*this, script.isRecording() ? Shade::limit : Shade::text));
}

void ScriptStrip::showScript() {
    const bool isRecording = model_.script().isRecording();
    setSize(getWidth(), isRecording ? recordingHeight : fullHeight);
    status_.setVisible(true);
    endButton_.setVisible(isRecording);
    physvib::setVisible({&fromSlider_, &toSlider_, &repeatToggle_, &restartButton_, &closeButton_},
                        !isRecording);
    if (const RecordedInputs* recording = model_.script().recording()) {
        const ScriptTrim trim = model_.script().trim();
        for (auto* slider : {&fromSlider_, &toSlider_})
            slider->setRange(0.0, std::max(stepSeconds, recording->lengthSeconds), stepSeconds);
        fromSlider_.setValue(trim.fromSeconds, juce::dontSendNotification);
        toSlider_.setValue(trim.toSeconds, juce::dontSendNotification);
        repeatToggle_.setToggleState(trim.repeats, juce::dontSendNotification);
        repeatToggle_.setEnabled(model_.mix().scene->scriptPeriodSeconds == 0.0 ||
                                 trim.repeats); // otherwise the rest of the script has its own period
    }
    repaint();
}

void ScriptStrip::applyTrim() {
    if (model_.script().recording() == nullptr) return;
    if (toSlider_.getValue() - fromSlider_.getValue() < stepSeconds)
        return showScript(); // the part would be empty
    model_.script().setTrim({fromSlider_.getValue(), toSlider_.getValue(), repeatToggle_.getToggleState()});
    repaint();
}

float ScriptStrip::toPixelX(double seconds) const {
    const auto area = track().toFloat();
    return area.getX() +
           static_cast<float>(seconds / std::max(stepSeconds, fromSlider_.getMaximum())) * area.getWidth();
}

void ScriptStrip::paint(juce::Graphics& g) {
    fillRound(g, *this, Shade::raised, getLocalBounds().toFloat(), 8.0f, 0.96f);
    const RecordedInputs* recording = model_.script().recording();
    if (recording == nullptr) return;
    const auto area = track().toFloat();
    fillRound(g, *this, Shade::well, area, 4.0f);
    const float fromX = toPixelX(fromSlider_.getValue()), toX = toPixelX(toSlider_.getValue());
    g.setColour(shade(*this, Shade::accent).withAlpha(0.18f));
    g.fillRect(area.withLeft(fromX).withRight(toX));
    for (const LiveInput& input : recording->inputs) {
        const float x = toPixelX(input.timeSeconds);
        const bool isUsed = x >= fromX && x <= toX, isHeld = std::holds_alternative<GripAction>(input.action);
        g.setColour(shade(*this, isUsed ? Shade::text : Shade::muted).withAlpha(isUsed ? 0.9f : 0.35f));
        g.fillRect(juce::Rectangle<float>{1.5f, isHeld ? 7.0f : 16.0f}.withCentre({x, area.getCentreY()}));
    }
    g.setColour(shade(*this, Shade::accent));
    for (const float x : {fromX, toX})
        g.fillRect(juce::Rectangle<float>{3.0f, area.getHeight()}.withCentre({x, area.getCentreY()}));
}

// Drags the nearer end of the trimmed part.
void ScriptStrip::mouseDown(const juce::MouseEvent& e) {
    draggedSlider_ = nullptr;
    if (model_.script().recording() == nullptr || !track().expanded(6, 4).contains(e.getPosition())) return;
    draggedSlider_ = std::abs(e.position.x - toPixelX(fromSlider_.getValue())) <
                             std::abs(e.position.x - toPixelX(toSlider_.getValue()))
                         ? &fromSlider_
                         : &toSlider_;
    mouseDrag(e);
}

void ScriptStrip::mouseDrag(const juce::MouseEvent& e) {
    if (draggedSlider_ == nullptr) return;
    const auto area = track().toFloat();
    draggedSlider_->setValue(fromSlider_.getMaximum() *
                                 static_cast<double>((e.position.x - area.getX()) / area.getWidth()),
                             juce::dontSendNotification);
    repaint();
}

void ScriptStrip::mouseUp(const juce::MouseEvent&) {
    if (std::exchange(draggedSlider_, nullptr) != nullptr) applyTrim();
}

void ScriptStrip::resized() {
    auto area = getLocalBounds().reduced(12, 8);
    auto row = area.removeFromTop(24);
    for (auto* button : {&closeButton_, &restartButton_})
        button->setBounds(row.removeFromRight(button == &closeButton_ ? 60 : 110)), row.removeFromRight(6);
    endButton_.setBounds(getLocalBounds().reduced(12, 8).removeFromTop(24).removeFromRight(90));
    status_.setBounds(row);
    area.removeFromTop(5);
    row = area.removeFromTop(22);
    fromSlider_.setBounds(row.removeFromLeft(130));
    row.removeFromLeft(8);
    toSlider_.setBounds(row.removeFromLeft(130));
    row.removeFromLeft(12);
    repeatToggle_.setBounds(row.removeFromLeft(90));
}

} // namespace physvib

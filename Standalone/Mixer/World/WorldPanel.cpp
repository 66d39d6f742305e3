// SPDX-License-Identifier: GPL-3.0-or-later
// Layout, menus and mouse input of the panel, the text on the strongest hit, and the script strip.
#include "Mixer/World/WorldPanel.h"
#include "Core/NameNumbers.h"
#include "Scene/SceneEdits.h"
#include <limits>

namespace physvib {
namespace {

constexpr double shownMs = 900.0;    // minimum time that a hit is described, unless a stronger one comes
constexpr double handMs = 10.0;      // between inputs while a body is held; mice report more often
constexpr double handSeconds = 0.02; // of each grip; the next one comes before its end
// widths of the panel in pixels at which law, master and drag knob have room; height of the bottom row
constexpr int lawNeeds = 700, masterNeeds = 260, knobNeeds = 820, foot = 42;
const juce::String dot = "  " + juce::String::charToString(0x00b7) + "  ";
const juce::String kiloNewtonSeconds = juce::String::fromUTF8("kN\xc2\xb7s");

juce::String strengthWords(double g) {
    return g < 0.02 ? "hardly felt" : g < 0.1 ? "felt softly" : g < 0.4 ? "felt" : "felt strongly";
}

constexpr double stepSeconds = 0.01; // one step of the world; a trim starts and ends at steps

} // namespace

WorldPanel::WorldPanel(MixerModel& model)
    : model_{model} {
    setTitle("World");
    setWantsKeyboardFocus(true);
    view_.onPull = [this](const std::string& body, Vector screenMetres, Vector point) {
        const double push = model_.mix().dragNewtonSecondsPerScreenMetre;
        model_.reportFault(
            model_.world().act(ImpulseAction{body, {push * screenMetres.x, push * screenMetres.y}, point}));
    };
    view_.onHold = [this](const std::string& body, Vector point, Vector to) {
        hand_ = GripAction{body, to, point, handSeconds};
        moveHand();
    };
    view_.onLetGo = [this](const std::string& body) {
        hand_.reset();
        model_.reportFault(model_.world().act(GripAction{body, {}, {}}));
    };
    view_.pullText = [this](double screenMetres) {
        return "drag " + number(1e-3 * model_.mix().dragNewtonSecondsPerScreenMetre * screenMetres, 2) + " " +
               kiloNewtonSeconds;
    };
    view_.onAttach = [this](FieldShare at) { model_.attach(at.x, at.y); };
    view_.onDetach = [this](int enchanter) { model_.detach(enchanter); };
    view_.acceptsFiles = isClipDrag;
    view_.onFiles = [this](const juce::StringArray& files, int enchanter, FieldShare at) {
        if (enchanter >= 0)
            model_.strikes().feelOn(files, enchanter);
        else
            model_.strikes().feelAt(files, at.x, at.y);
    };
    view_.onMove = [this](int enchanter, FieldShare to) {
        model_.change(
            "Move " + labelOf(model_.mix(), enchanter),
            [&](Mix& mix) {
                auto& layout = mix.layout.geometry;
                auto& place = nth(layout.places, enchanter); // depth and part stay
                place.xMetres = to.x * layout.extentWidthMetres;
                place.yMetres = to.y * layout.extentHeightMetres;
                mix.layout.name = "own";
            },
            std::exchange(isMoving_, true));
    };
    view_.addMouseListener(this, false);
    view_.onMenu = pane_.onMenu = [this](juce::Point<float> place) {
        menuAt(place).showMenuAsync(
            juce::PopupMenu::Options{}.withTargetComponent(view_).withMousePosition());
    };
    sentence_.setTitle("Strongest hit");
    sentence_.setFont(text::font(text::medium));
    law_.setBorderSize({0, 0, 0, 6});
    for (auto* name : {&tiltName_, &dragName_}) name->setBorderSize({0, 5, 0, 0});
    law_.setJustificationType(juce::Justification::centredRight);
    tilt_.onValueChange = [this] {
        if (player_ && player_->moves())
            play(player_->tilt(tilt_.angleRadians()));
        else
            model_.world().act(TiltAction{tilt_.angleRadians()});
    };
    drag_.setTitle("Drag strength");
    drag_.setSliderStyle(juce::Slider::RotaryHorizontalVerticalDrag);
    drag_.setTextBoxStyle(juce::Slider::NoTextBox, true, 0, 0);
    drag_.setTooltip("Drag strength: how hard a body is pushed per metre of the screen that it is dragged; "
                     "double click: as in the thesis");
    drag_.setRange(leastDrag, mostDrag, 1'000.0);
    drag_.setSkewFactorFromMidPoint(10'000.0);
    drag_.setDoubleClickReturnValue(true, thesisDrag);
    drag_.textFromValueFunction = [](double push) {
        return number(1e-3 * push, 0) + " " + kiloNewtonSeconds + "/m";
    };
    onSlide(drag_, [this](bool continuesEdit) {
        model_.change(
            "Drag strength", [this](Mix& mix) { mix.dragNewtonSecondsPerScreenMetre = drag_.getValue(); },
            continuesEdit);
    });
    compare_.setTitle("Compare A and B");
    compare_.onClick = [this] { ab_.toggle(); };
    addAll(*this,
           {&view_, &pane_, &bar_, &sentence_, &law_, &compare_, &tilt_, &tiltName_, &drag_, &dragName_});
    addHidden(*this, {&master_, &palette_, &body_, &script_});
    pane_.onChange = [this] { showTools(); };
    mixChanged();
}

void WorldPanel::mixChanged() {
    const auto& mix = model_.mix();
    const auto& scene = model_.world().scene();
    if (shown_ != mix.scene) {
        player_.emplace(scene);
        first_.clear();
        if (!player_->isThere()) player_.reset();
        tiltName_.setText(player_ ? "arrows play" : "gravity", juce::dontSendNotification);
    }
    if (shown_ != mix.scene || shownEdits_ != model_.world().edits()) view_.show(scene);
    shown_ = mix.scene;
    shownEdits_ = model_.world().edits();
    pane_.mixChanged();
    showTools();
    std::vector<bool> muted, without;
    for (int j = 0; j < mix.count(); ++j) {
        without.push_back(!model_.device().isPlayed(static_cast<std::size_t>(j)));
        muted.push_back(mix.isSilent(j) || without.back());
    }
    view_.show(mix.layout, mix.panner(), std::move(muted), std::move(without));
    master_.mixChanged();
    view_.setDisplayWidth(model_.displayWidthMetres());
    law_.setText(juce::String{nameOf(mix.panner().law()).data()} + " law" + dot + "exponent " +
                     number(mix.exponent, 1),
                 juce::dontSendNotification);
    const bool isB = ab_.isOn() && ab_.shown() == 'B';
    compare_.setButtonText(!ab_.isOn() ? "A/B" : isB ? "B" : "A");
    compare_.setToggleState(ab_.isOn(), juce::dontSendNotification);
    compare_.setTooltip(!ab_.isOn()
                            ? juce::String{"Compare two laws, layouts or mixes (A): B begins as a copy of A"}
                            : juce::String{isB ? "B" : "A"} + " plays, " + number(ab_.loweredDb(), 1) +
                                  " dB lower, as loud as the other (A changes; the menu ends it)");
    if (!drag_.isMouseButtonDown())
        drag_.setValue(mix.dragNewtonSecondsPerScreenMetre, juce::dontSendNotification);
    dragName_.setText("drag " + drag_.getTextFromValue(drag_.getValue()), juce::dontSendNotification);
}

void WorldPanel::showTools() {
    if (isShow_ && pane_.tool() != DrawTool::hand) return pane_.use(DrawTool::hand); // calls this again
    bar_.show();
    palette_.show();
    palette_.setVisible(!isShow_ && pane_.tool() != DrawTool::hand);
    script_.refresh(!isShow_ && pane_.tool() == DrawTool::hand);
    body_.show();
    placeInspector();
}

/// Place in the field where the body panel covers least of badges and selection. It stays where it is if no
/// other place is better, and while the pointer is over it.
juce::Rectangle<int> WorldPanel::withinField(int wide, int high) const {
    const auto field = juce::Rectangle<float>{view_.placeOfShare({0.0, 1.0}), view_.placeOfShare({1.0, 0.0})}
                           .toNearestInt() +
                       view_.getPosition();
    const auto inner = field.reduced(24);
    const auto chosen = pane_.chosenArea().toNearestInt().expanded(4) + pane_.getPosition();
    const auto covers = [&](juce::Rectangle<int> place) {
        const auto overlap = [&place](juce::Rectangle<int> with) {
            const auto both = place.getIntersection(with);
            return both.getWidth() * both.getHeight();
        };
        int sum = overlap(chosen);
        for (const auto& badge : view_.badges()) sum += overlap(badge.toNearestInt() + view_.getPosition());
        return sum;
    };
    auto best = body_.getBounds();
    const bool isThere = best.getWidth() == wide && best.getHeight() == high && inner.contains(best);
    if (isThere && body_.isMouseOver(true)) return best;
    int least = isThere ? covers(best) : std::numeric_limits<int>::max();
    for (const int y : {inner.getY(), inner.getCentreY() - high / 2, inner.getBottom() - high})
        for (const int x : {inner.getRight() - wide, inner.getX(), inner.getCentreX() - wide / 2})
            if (const juce::Rectangle<int> place{x, y, wide, high}; covers(place) < least)
                best = place, least = covers(place);
    return best;
}

// Beside the field if there is room, else in a line above it, else in it.
void WorldPanel::placeInspector() {
    if (!body_.isVisible()) return;
    const auto room = getLocalBounds()
                          .withTrimmedTop(palette_.getBottom() + 2)
                          .withTrimmedBottom(foot)
                          .withLeft(palette_.getX())
                          .withTrimmedRight(8);
    const auto edgeAt = [this](double metres) {
        return juce::roundToInt(view_.placeOfMetres({metres, 0.0}).x) + view_.getX();
    };
    // badges lie on the edge of the field, walls outside it
    constexpr int apart = 20, least = 4, wide = BodyPanel::wide;
    const int right = edgeAt(model_.world().scene().fieldWidthMetres), left = edgeAt(0.0) - wide;
    const int high = body_.heightFor(wide);
    juce::Rectangle<int> place{0, room.getCentreY() - high / 2, wide, high};
    if (right + least + wide <= room.getRight())
        place.setX(std::min(right + apart, room.getRight() - wide));
    else if (left - least >= room.getX())
        place.setX(std::max(left - apart, room.getX()));
    else {
        place = room.withHeight(body_.heightFor(room.getWidth()));
        constexpr int badge = 15; // height of a badge above the field
        const int top = juce::roundToInt(view_.placeOfShare({0.0, 1.0}).y) + view_.getY() - badge;
        if (place.getBottom() > top) place = withinField(wide, high);
    }
    body_.setBounds(place);
}

juce::Rectangle<int> WorldPanel::bannerArea() const {
    auto row = getLocalBounds().reduced(8, 4);
    if (isShow_) return row.withTrimmedRight(silenceWidth).withHeight(28);
    // beside the knobs and A/B if there is room
    if (const auto beside = row.withRight(tilt_.getX() - 8); hasMaster_ || beside.getWidth() >= 280)
        row = beside;
    return row.removeFromBottom(foot - 9);
}

void WorldPanel::setShow(bool isShow) {
    isShow_ = isShow;
    if (isShow) pane_.use(DrawTool::hand);
    physvib::setVisible({&bar_, &sentence_, &tilt_, &tiltName_}, !isShow);
    showTools();
    resized();
}

void WorldPanel::setPlay(bool isPlay, bool hasMaster) {
    isPlay_ = isPlay;
    hasMaster_ = hasMaster;
    resized();
}

/// Sends input of a player. The first one replaces the scene's script: the world restarts without it.
void WorldPanel::play(const std::vector<Action>& actions) {
    if (actions.empty()) return;
    if (const Scene& drawn = model_.world().drawing().drawn(); sceneForHands(drawn) != drawn) {
        auto scene = sceneForHands(drawn);
        runsBefore_ = model_.saved().log.takes.size();
        model_.change("Play",
                      [&scene](Mix& mix) { mix.scene = std::make_shared<const Scene>(std::move(scene)); });
        shown_ = model_.mix().scene; // keeps the player
        first_ = actions;
        return;
    }
    if (!first_.empty()) {
        first_ = actions;
        return;
    }
    for (const Action& action : actions) model_.reportFault(model_.world().act(action));
}

bool WorldPanel::keyPressed(const juce::KeyPress& key) {
    if (!isShow_ && pane_.handleKey(key)) return true; // show mode has no tools
    if (!player_) return tilt_.handleKey(key);
    if (key == juce::KeyPress::leftKey) return play(player_->steer(-1)), true;
    if (key == juce::KeyPress::rightKey) return play(player_->steer(1)), true;
    if (key == juce::KeyPress::downKey) return play(player_->steer(0)), true;
    return false;
}

// A body that is moved stops when the key is released; one that is driven keeps going.
bool WorldPanel::keyStateChanged(bool isDown) {
    using juce::KeyPress;
    if (isDown || !player_ || !player_->moves() || KeyPress::isKeyCurrentlyDown(KeyPress::leftKey) ||
        KeyPress::isKeyCurrentlyDown(KeyPress::rightKey))
        return false;
    return play(player_->steer(0)), false;
}

/// x on the field in metres, from an x in pixels of the view.
double WorldPanel::metresAt(float x) const {
    const float left = view_.placeOfShare({0.0, 0.0}).x, right = view_.placeOfShare({1.0, 0.0}).x;
    return model_.world().scene().fieldWidthMetres * static_cast<double>((x - left) / (right - left));
}

void WorldPanel::mouseUp(const juce::MouseEvent&) {
    isMoving_ = false;
    if (std::exchange(pointed_, {}) && player_) play(player_->steer(0));
}

void WorldPanel::cancelDrag() {
    view_.cancelDrag();
    pane_.cancelStroke();
    if (std::exchange(isMoving_, false)) model_.undoManager().undo();
    if (std::exchange(pointed_, {}) && player_) play(player_->steer(0));
}

void WorldPanel::lookAfterPlayer() {
    if (!player_) return;
    // the world has restarted
    if (!first_.empty() && model_.saved().log.takes.size() > runsBefore_) play(std::exchange(first_, {}));
    if (!player_->moves()) return;
    const float at = view_.placeOfBody(player_->body()).x;
    if (at < -1e3f) return;
    if (pointed_) play(player_->moveTowards(*pointed_, metresAt(at)));
    for (const Action& action : player_->keepInside(metresAt(at))) model_.world().act(action);
}

void WorldPanel::moveHand() {
    if (!hand_ || nowMs() - handAtMs_ < handMs) return;
    handAtMs_ = nowMs();
    model_.reportFault(model_.world().act(*std::exchange(hand_, {})));
}

juce::String WorldPanel::sentenceOn(const CollisionEvent& hit) const {
    const auto& scene = model_.world().scene();
    const auto name = materialName(scene, hit), place = placeText(scene, hit);
    if (isClip(hit.sound)) return inLines({name, place});
    const double g = strongestOf(model_, hit).levelG; // 0: its actuators are muted or have no output
    const bool isSeen = g < 0.005 || (isPlay_ && model_.isOnlySeen());
    auto felt = (isSeen    ? juce::String{"seen"}
                 : isPlay_ ? strengthWords(g)
                           : number(g, 2) + " g") +
                " " + place;
    if (isSeen) felt << ": " << whyOnlySeen(model_, hit);
    if (isPlay_) return inLines({name, felt});
    const auto hz = number(hit.frequencyHz, 0) + " Hz";
    const auto tau = juce::String::charToString(0x03c4) + " " + number(hit.decayPerSecond, 0) + " /s";
    for (const auto& parts : {juce::StringArray{name, hz, tau, felt}, {name, hz, felt}})
        if (const auto words = inLines(parts); words.isNotEmpty()) return words;
    return inLines({name, felt});
}

/// The parts in one or two lines; empty if they do not fit.
juce::String WorldPanel::inLines(const juce::StringArray& parts) const {
    const auto font = sentence_.getFont();
    const int room = sentence_.getWidth() - sentence_.getBorderSize().getLeftAndRight() - 10;
    juce::StringArray lines{parts[0]};
    for (int k = 1; k < parts.size(); ++k) {
        const auto longer = lines.strings.getReference(lines.size() - 1) + dot + parts[k];
        if (text::pixels(font, longer) <= room)
            lines.set(lines.size() - 1, longer);
        else
            lines.add(parts[k]);
    }
    return lines.size() <= 2 ? lines.joinIntoString("\n") : juce::String{};
}

/// Why nothing is felt; empty if something is or may soon be felt.
juce::String WorldPanel::whyNothing(double nowMs, bool isRunning) const {
    constexpr double quietMs = 4000.0;
    if (const auto why = whyMuted(); why.isNotEmpty()) return why;
    if (!isRunning) return "no device plays";
    if (model_.session().world().slowness() == 0) return "paused";
    const Scene& drawn = model_.world().drawing().drawn();
    const auto hasBody = [&drawn](auto is) {
        return std::ranges::any_of(drawn.bodies, is) ||
               std::ranges::any_of(drawn.script, [&is](const ScriptInput& input) {
                   const auto* brought = bodyPutBy(input.action);
                   return brought != nullptr && is(*brought);
               });
    };
    if (!hasBody([](const BodyDescription& body) { return body.type != BodyType::staticBody; }))
        return "draw a ball: B";
    if (nowMs - hitAtMs_ > shownMs && !hasBody(isSource)) return "no body is a haptic source";
    if (nowMs - hitAtMs_ <= quietMs) return "";
    const bool areAllOut = std::ranges::all_of(drawn.bodies, [&](const BodyDescription& body) {
        const auto at = body.type == BodyType::staticBody ? std::nullopt : pane_.placeNow(body.name);
        if (!at) return true;
        const auto [x, y] = at->metres;
        return x < 0.0 || y < 0.0 || x > drawn.fieldWidthMetres || y > drawn.fieldHeightMetres;
    });
    return areAllOut && drawn.script.empty() ? "all that moves has left the field" : "no hits";
}

void WorldPanel::showSentence() {
    const auto hit = shownHit_.amplitude == 0.0 ? juce::String{} : sentenceOn(shownHit_);
    sentence_.setText(why_.isEmpty() ? hit : inLines({"Nothing felt", why_}), juce::dontSendNotification);
}

void WorldPanel::refresh(const MixerMoment& moment) {
    const double now = nowMs();
    if (std::exchange(hitScene_, model_.mix().scene) != model_.mix().scene) shownHit_ = {}, hitAtMs_ = now;
    bool isOther = false;
    for (const auto& hit : moment.hits)
        if (now - hitAtMs_ > shownMs || std::abs(hit.amplitude) > std::abs(shownHit_.amplitude))
            shownHit_ = hit, hitAtMs_ = now, isOther = true;
    if (const auto why = whyNothing(now, moment.device.isRunning); why != std::exchange(why_, why) || isOther)
        showSentence();
    if (hasMaster_) master_.refresh(moment);
    lookAfterPlayer();
    moveHand();
    pane_.spawnDueBodies();
    if (model_.script().isRecording() || script_.isVisible()) script_.refresh(pane_.tool() == DrawTool::hand);
    placeInspector();
    static constexpr decltype(moment.meters.peaks) none{};
    const bool isFelt = whyMuted().isEmpty();
    const auto& peaks = isFelt ? moment.meters.peaks : none; // badges glow only for what is felt
    view_.update({moment.poses, moment.sessionNs, moment.aheadNs, moment.hits,
                  std::span{peaks}.first(static_cast<std::size_t>(model_.mix().count())), isFelt});
}

void WorldPanel::resized() {
    auto row = getLocalBounds().reduced(panelInset, 0).removeFromBottom(foot).withTrimmedBottom(5);
    const bool isEngineer = !isShow_ && !isPlay_;
    law_.setVisible(isEngineer && getWidth() >= lawNeeds + (hasMaster_ ? masterNeeds : 0));
    compare_.setVisible(isEngineer);
    master_.setVisible(!isShow_ && hasMaster_);
    physvib::setVisible({&drag_, &dragName_}, isEngineer && (!hasMaster_ || getWidth() >= knobNeeds));
    if (hasMaster_) {
        master_.setBounds(row.removeFromRight(getWidth() >= knobNeeds ? masterNeeds : 200));
        row.removeFromRight(gap);
    }
    if (isEngineer) compare_.setBounds(row.removeFromRight(46).reduced(2, 5));
    if (law_.isVisible()) law_.setBounds(row.removeFromRight(174));
    if (drag_.isVisible()) {
        dragName_.setBounds(row.removeFromRight(104));
        drag_.setBounds(row.removeFromRight(38));
    }
    tiltName_.setBounds(row.removeFromRight(58));
    tilt_.setBounds(row.removeFromRight(38));
    sentence_.setBounds(row);
    showSentence();
    auto top = getLocalBounds().reduced(6, 8).withTrimmedBottom(foot);
    const int tools = isShow_ ? 0 : DrawBar::widthFor(top.getHeight());
    bar_.setBounds(top.removeFromLeft(tools));
    view_.setBounds(getLocalBounds().reduced(3)); // inside the panel's round corners
    constexpr int silenceHigh = 40;               // the button lies over the corner of a show
    view_.setRoom(isShow_ ? juce::BorderSize<int>{silenceHigh, 0, 0, 0}
                          : juce::BorderSize<int>{hasMaster_ ? 51 : 20, tools - 12, foot - 14, 0});
    pane_.setBounds(view_.getBounds().withTrimmedBottom(isShow_ ? 0 : foot - 4)); // not over the bottom row
    top.removeFromLeft(8);
    script_.setBounds(top.withHeight(script_.getHeight()));
    palette_.setBounds(top.removeFromTop(26));
    placeInspector();
}

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

void WorldPanel::addActuatorItems(juce::PopupMenu& menu, int enchanter) {
    menu.addSectionHeader("Actuator " + labelOf(model_.mix(), enchanter));
    menu.addItem("Test pulse", [this, enchanter] { model_.strikes().testPulse(enchanter); });
    menu.addItem("Sweep", [this, enchanter] { model_.strikes().testSweep(enchanter); });
    const auto isMuted = [enchanter](auto& mix) -> auto& { return nth(mix.strips, enchanter).isMuted; };
    menu.addItem("Mute", true, isMuted(model_.mix()),
                 [this, isMuted] { model_.change("Mute", [&](Mix& mix) { isMuted(mix) = !isMuted(mix); }); });
    menu.addItem("Output" + dots(), onOutput != nullptr, false, [this, enchanter] { onOutput(enchanter); });
    menu.addItem("Name, profile" + dots(), onProfile != nullptr, false,
                 [this, enchanter] { onProfile(enchanter); });
    menu.addSeparator();
    menu.addItem("Detach", model_.mix().count() > 1, false, [this, enchanter] { model_.detach(enchanter); });
}

// Bodies that a script adds are not part of the drawing: they only change their material.
void WorldPanel::addBodyItems(juce::PopupMenu& menu, const std::string& body, Vector place) {
    juce::PopupMenu materials;
    const auto& scene = model_.world().drawing().drawn();
    const auto* drawn = model_.world().drawing().find(body);
    const bool isDrawn = drawn != nullptr, moves = isDrawn && drawn->type == BodyType::dynamicBody;
    for (int i = 0; i < static_cast<int>(scene.materials.size()); ++i)
        materials.addItem(utf8(nth(scene.materials, i).name), true,
                          isDrawn && drawn->fixtures[0].material == i, [this, body, i] {
                              model_.reportFault(model_.world().edit("Material of " + utf8(body),
                                                                     MaterialAction{body, everyFixture, i}));
                          });
    menu.addSectionHeader(utf8(body));
    menu.addSubMenu("Material", materials);
    const auto choose = [this, body] { pane_.use(DrawTool::choose), pane_.choose({body}); };
    menu.addItem("Select", isDrawn, false, choose);
    if (isDrawn && motorOf(scene, body) != nullptr)
        menu.addItem("Motor: speed and torque", choose);
    else
        menu.addItem("Motor here", moves, false, [this, place] { pane_.joinAt(DrawTool::motor, place); });
    if (isDrawn && springOf(scene, body) != nullptr)
        menu.addItem("Spring: stiffness", choose);
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
    menu.addItem("Attach an actuator here", model_.mix().count() < limits::maxEnchanters, false,
                 [this, at] { model_.attach(at.x, at.y); });
}

ScriptStrip::ScriptStrip(MixerModel& model)
    : model_{model} {
    setTitle("Script of hands");
    words_.setFont(text::font(text::medium));
    for (auto* slider : {&from_, &to_}) {
        slider->setSliderStyle(juce::Slider::LinearBar);
        slider->setRange(0.0, 1.0, stepSeconds);
        slider->valueFromTextFunction = [](const juce::String& words) {
            return words.retainCharacters("0123456789.").getDoubleValue();
        };
        slider->onDragEnd = [this] { use(); };
        slider->onValueChange = [this, slider] {
            if (!slider->isMouseButtonDown()) use();
            repaint();
        };
    }
    describe(from_, "The script begins at", "Where the script begins, in seconds of the recording");
    from_.textFromValueFunction = [](double s) { return "from " + number(s, 2) + " s"; };
    describe(to_, "The script ends at", "Where the script ends, in seconds of the recording");
    to_.textFromValueFunction = [](double s) { return "to " + number(s, 2) + " s"; };
    describe(repeats_, "Repeat the script", "Begins again at its end, for ever");
    repeats_.onClick = [this] { use(); };
    describe(end_, "End the recording of hands", "End the recording of hands (Ctrl+Shift+R)");
    end_.setToggleState(true, juce::dontSendNotification);
    end_.onClick = [this] { model_.script().stop(); };
    again_.setTitle("Play the script from the start");
    again_.onClick = [this] { model_.restart(model_.mix().seed); };
    describe(close_, "Close the script of hands", "The script stays");
    close_.onClick = [this] {
        closed_ = model_.mix().scene;
        setVisible(false);
    };
    addHidden(*this, {&words_, &from_, &to_, &repeats_, &end_, &again_, &close_});
    setSize(400, high);
}

void ScriptStrip::refresh(bool isHand) {
    const auto& script = model_.script();
    const HandScript* hands = script.hands();
    setVisible(isHand && (script.isRecording() || (hands != nullptr && closed_ != model_.mix().scene)));
    if (!isVisible()) return;
    const bool isOther = std::exchange(shown_, model_.mix().scene) != model_.mix().scene,
               isTurned = std::exchange(wasRecording_, script.isRecording()) != script.isRecording();
    if (isOther || isTurned) show();
    const auto dot = "  " + juce::String::charToString(0x00b7) + "  ";
    if (script.isRecording())
        words_.setText("Recording hands" + dot + number(script.seconds(), 1) + " s" + dot +
                           countOf(script.inputs(), "input"),
                       juce::dontSendNotification);
    else
        words_.setText("Script of hands" + dot + countOf(hands->inputs.size(), "input") + " in " +
                           number(hands->lengthSeconds, 2) + " s",
                       juce::dontSendNotification);
    words_.setColour(juce::Label::textColourId,
                     shade(*this, script.isRecording() ? Shade::limit : Shade::text));
}

void ScriptStrip::show() {
    const bool isRecording = model_.script().isRecording();
    setSize(getWidth(), isRecording ? recordingHigh : high);
    words_.setVisible(true);
    end_.setVisible(isRecording);
    physvib::setVisible({&from_, &to_, &repeats_, &again_, &close_}, !isRecording);
    if (const HandScript* hands = model_.script().hands()) {
        const ScriptTrim trim = model_.script().trim();
        for (auto* slider : {&from_, &to_})
            slider->setRange(0.0, std::max(stepSeconds, hands->lengthSeconds), stepSeconds);
        from_.setValue(trim.fromSeconds, juce::dontSendNotification);
        to_.setValue(trim.toSeconds, juce::dontSendNotification);
        repeats_.setToggleState(trim.repeats, juce::dontSendNotification);
        repeats_.setEnabled(model_.mix().scene->scriptPeriodSeconds == 0.0 ||
                            trim.repeats); // otherwise the rest of the script has its own period
    }
    repaint();
}

void ScriptStrip::use() {
    if (model_.script().hands() == nullptr) return;
    if (to_.getValue() - from_.getValue() < stepSeconds) return show(); // the part would be empty
    model_.script().setTrim({from_.getValue(), to_.getValue(), repeats_.getToggleState()});
    repaint();
}

float ScriptStrip::placeOf(double seconds) const {
    const auto at = lane().toFloat();
    return at.getX() +
           static_cast<float>(seconds / std::max(stepSeconds, from_.getMaximum())) * at.getWidth();
}

void ScriptStrip::paint(juce::Graphics& g) {
    fillRound(g, *this, Shade::raised, getLocalBounds().toFloat(), 8.0f, 0.96f);
    const HandScript* hands = model_.script().hands();
    if (hands == nullptr) return;
    const auto at = lane().toFloat();
    fillRound(g, *this, Shade::well, at, 4.0f);
    const float from = placeOf(from_.getValue()), to = placeOf(to_.getValue());
    g.setColour(shade(*this, Shade::accent).withAlpha(0.18f));
    g.fillRect(at.withLeft(from).withRight(to));
    for (const LiveInput& input : hands->inputs) {
        const float x = placeOf(input.timeSeconds);
        const bool isIn = x >= from && x <= to, isHeld = std::holds_alternative<GripAction>(input.action);
        g.setColour(shade(*this, isIn ? Shade::text : Shade::muted).withAlpha(isIn ? 0.9f : 0.35f));
        g.fillRect(juce::Rectangle<float>{1.5f, isHeld ? 7.0f : 16.0f}.withCentre({x, at.getCentreY()}));
    }
    g.setColour(shade(*this, Shade::accent));
    for (const float x : {from, to})
        g.fillRect(juce::Rectangle<float>{3.0f, at.getHeight()}.withCentre({x, at.getCentreY()}));
}

// Moves the nearer end.
void ScriptStrip::mouseDown(const juce::MouseEvent& e) {
    dragged_ = nullptr;
    if (model_.script().hands() == nullptr || !lane().expanded(6, 4).contains(e.getPosition())) return;
    dragged_ =
        std::abs(e.position.x - placeOf(from_.getValue())) < std::abs(e.position.x - placeOf(to_.getValue()))
            ? &from_
            : &to_;
    mouseDrag(e);
}

void ScriptStrip::mouseDrag(const juce::MouseEvent& e) {
    if (dragged_ == nullptr) return;
    const auto at = lane().toFloat();
    dragged_->setValue(from_.getMaximum() * static_cast<double>((e.position.x - at.getX()) / at.getWidth()),
                       juce::dontSendNotification);
    repaint();
}

void ScriptStrip::mouseUp(const juce::MouseEvent&) {
    if (std::exchange(dragged_, nullptr) != nullptr) use();
}

void ScriptStrip::resized() {
    auto area = getLocalBounds().reduced(12, 8);
    auto row = area.removeFromTop(24);
    for (auto* button : {&close_, &again_})
        button->setBounds(row.removeFromRight(button == &close_ ? 60 : 110)), row.removeFromRight(6);
    end_.setBounds(getLocalBounds().reduced(12, 8).removeFromTop(24).removeFromRight(90));
    words_.setBounds(row);
    area.removeFromTop(5);
    row = area.removeFromTop(22);
    from_.setBounds(row.removeFromLeft(130));
    row.removeFromLeft(8);
    to_.setBounds(row.removeFromLeft(130));
    row.removeFromLeft(12);
    repeats_.setBounds(row.removeFromLeft(90));
}

} // namespace physvib

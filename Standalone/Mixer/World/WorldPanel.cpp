// SPDX-License-Identifier: GPL-3.0-or-later
// What hands do in the world becomes inputs of the session.
#include "Mixer/World/WorldPanel.h"
#include "Core/NameNumbers.h"
#include "Mixer/Materials/HitWords.h"
#include "Scene/SceneEdits.h"
#include <limits>
#include <utility>

namespace physvib {

namespace {

constexpr double tellMs = 900.0;     // a sentence stays at least so long, unless a stronger hit comes
constexpr double handMs = 10.0;      // between inputs of a hand that holds; mice tell of themselves up to a
                                     // thousand times a second
constexpr double handSeconds = 0.02; // for each way: the next input comes before it has ended, and the hand
                                     // does not stop between
constexpr int lawNeeds = 700; // pixels of the panel; else there is no room for what the tab says as well
const juce::String dot = "  " + juce::String::charToString(0x00b7) + "  ";
const juce::String kiloNewtonSeconds = juce::String::fromUTF8("kN\xc2\xb7s");

} // namespace

WorldPanel::WorldPanel(Desk& desk)
    : desk_{desk} {
    setTitle("World");
    setWantsKeyboardFocus(true);
    view_.onPull = [this](const std::string& body, Vector screenMetres, Vector point) {
        pull(body, screenMetres, point);
    };
    view_.onHold = [this](const std::string& body, Vector point, Vector to) { hold(body, point, to); };
    view_.onLetGo = [this](const std::string& body) { letGo(body); };
    view_.pullText = [this](double screenMetres) {
        return "drag " + number(1e-3 * desk_.mix().dragNewtonSecondsPerScreenMetre * screenMetres, 2) + " " +
               kiloNewtonSeconds;
    };
    view_.onAttach = [this](FieldShare at) { desk_.attach(at.x, at.y); };
    view_.onDetach = [this](int enchanter) { desk_.detach(enchanter); };
    view_.takesFiles = isClipDrag;
    view_.onFiles = [this](const juce::StringArray& files, int enchanter, FieldShare at) {
        if (enchanter >= 0)
            desk_.strikes().feelOn(files, enchanter);
        else
            desk_.strikes().feelAt(files, at.x, at.y);
    };
    view_.onMove = [this](int enchanter, FieldShare to) {
        desk_.change(
            "Move " + utf8(desk_.mix().layout.enchanters[static_cast<std::size_t>(enchanter)].label),
            [&](Mix& mix) {
                auto& layout = mix.layout.geometry;
                auto& place = layout.places[static_cast<std::size_t>(enchanter)]; // depth and part stay
                place.xMetres = to.x * layout.extentWidthMetres;
                place.yMetres = to.y * layout.extentHeightMetres;
                mix.layout.name = "own";
            },
            std::exchange(isMoving_, true));
    };
    view_.addMouseListener(this, false);
    view_.onMenu = pane_.onMenu = [this](juce::Point<float> place) { showMenu(place); };
    sentence_.setTitle("Strongest hit");
    sentence_.setFont(juce::Font{text::medium});
    sentence_.setMinimumHorizontalScale(0.8f);
    law_.setFont(juce::Font{text::small});
    law_.setJustificationType(juce::Justification::centredRight);
    tilt_.onValueChange = [this] {
        if (player_ && player_->moves())
            play(player_->tilt(tilt_.angleRadians()));
        else
            desk_.world().act(TiltAction{tilt_.angleRadians()});
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
    onSlide(drag_, [this](bool goesOn) {
        desk_.change(
            "Drag strength", [this](Mix& mix) { mix.dragNewtonSecondsPerScreenMetre = drag_.getValue(); },
            goesOn);
    });
    for (auto* name : {&tiltName_, &dragName_}) name->setFont(juce::Font{text::small});
    compare_.setTitle("Compare A and B");
    compare_.onClick = [this] { ab_.toggle(); };
    for (juce::Component* c : std::initializer_list<juce::Component*>{
             &view_, &pane_, &bar_, &sentence_, &law_, &compare_, &tilt_, &tiltName_, &drag_, &dragName_})
        addAndMakeVisible(c);
    addChildComponent(palette_);
    addChildComponent(body_);
    addChildComponent(script_);
    pane_.onChange = [this] { showTools(); };
    takeMix();
}

void WorldPanel::takeMix() {
    const auto& mix = desk_.mix();
    const auto& scene = desk_.world().scene();
    if (shown_ != mix.scene) {
        player_.emplace(scene);
        first_.clear();
        if (!player_->isThere()) player_.reset();
        tiltName_.setText(player_ ? "arrows play" : "gravity", juce::dontSendNotification);
    }
    if (shown_ != mix.scene || shownEdits_ != desk_.world().edits()) view_.show(scene);
    shown_ = mix.scene;
    shownEdits_ = desk_.world().edits();
    pane_.takeMix();
    showTools();
    view_.show(mix.layout, mix.panner());
    view_.setDisplayWidth(desk_.displayWidthMetres());
    law_.setText(juce::String{nameOf(mix.panner().law()).data()} + " law" + dot + "exponent " +
                     number(mix.exponent, 1),
                 juce::dontSendNotification);
    law_.setColour(juce::Label::textColourId, shade(*this, Shade::muted));
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
    for (auto* name : {&tiltName_, &dragName_})
        name->setColour(juce::Label::textColourId, shade(*this, Shade::muted));
    sentence_.setColour(juce::Label::textColourId, shade(*this, Shade::now));
}

void WorldPanel::showTools() {
    if (isShow_ && pane_.tool() != DrawTool::hand) return pane_.use(DrawTool::hand); // which comes back here
    bar_.show();
    palette_.show();
    palette_.setVisible(!isShow_ && pane_.tool() != DrawTool::hand);
    script_.refresh(!isShow_ && pane_.tool() == DrawTool::hand);
    body_.show();
    placeInspector();
}

// It stays where it is until another place covers half as much of what is selected and of the badges.
void WorldPanel::placeInspector() {
    if (!body_.isVisible()) return;
    const auto room = getLocalBounds()
                          .withTrimmedLeft(bar_.getRight())
                          .withTrimmedTop(40)
                          .withTrimmedBottom(48)
                          .reduced(8, 0);
    std::vector<juce::Rectangle<int>> inTheWay{pane_.chosenArea().toNearestInt() + pane_.getPosition()};
    for (int j = 0; j < desk_.mix().count(); ++j)
        inTheWay.push_back(view_.badgeAt(j).toNearestInt() + view_.getPosition());
    const auto covered = [&](const juce::Rectangle<int>& place) {
        int pixels = 0;
        for (const auto& other : inTheWay) {
            const auto common = place.getIntersection(other);
            pixels += common.getWidth() * common.getHeight();
        }
        return pixels;
    };
    const auto now =
        juce::Rectangle<int>{BodyPanel::wide, body_.wantedHeight()}.withPosition(body_.getPosition());
    auto best = now;
    int least = room.contains(now) ? (covered(now) + 1) / 2 : std::numeric_limits<int>::max();
    constexpr int places = 6; // along each side
    for (int y = 0; y < places; ++y)
        for (int x = places - 1; x >= 0; --x) {
            const auto place =
                now.withPosition(room.getX() + x * (room.getWidth() - now.getWidth()) / (places - 1),
                                 room.getY() + y * (room.getHeight() - now.getHeight()) / (places - 1));
            if (const int pixels = covered(place); pixels < least) least = pixels, best = place;
        }
    body_.setBounds(best);
}

double WorldPanel::fieldAspect() const {
    const auto& scene = desk_.world().scene();
    return scene.fieldWidthMetres / std::max(scene.fieldHeightMetres, 1e-6);
}

juce::Rectangle<int> WorldPanel::bannerArea() const {
    auto area = getLocalBounds().withTrimmedLeft(isShow_ ? 8 : bar_.getRight());
    if (isShow_) area.removeFromRight(silenceWidth);
    return area.reduced(8, 4).withHeight(36);
}

void WorldPanel::setShow(bool isShow) {
    isShow_ = isShow;
    if (isShow) pane_.use(DrawTool::hand);
    for (juce::Component* c : std::initializer_list<juce::Component*>{&bar_, &sentence_, &compare_, &tilt_,
                                                                      &tiltName_, &drag_, &dragName_})
        c->setVisible(!isShow);
    showTools();
    resized();
}

// ---- a scene's player

/// Who begins to play takes over from the scene's script: the world begins anew without what that did.
void WorldPanel::play(const std::vector<Action>& actions) {
    if (actions.empty()) return;
    if (const Scene& drawn = desk_.world().drawing().drawn(); sceneForHands(drawn) != drawn) {
        auto scene = sceneForHands(drawn);
        takesBefore_ = desk_.saved().log.takes.size();
        desk_.change("Play",
                     [&scene](Mix& mix) { mix.scene = std::make_shared<const Scene>(std::move(scene)); });
        shown_ = desk_.mix().scene; // the same player goes on
        first_ = actions;
        return;
    }
    if (!first_.empty()) {
        first_ = actions;
        return;
    }
    for (const Action& action : actions)
        if (const auto fault = desk_.world().act(action); !fault.empty()) desk_.report(utf8(fault));
}

bool WorldPanel::keyPressed(const juce::KeyPress& key) {
    if (!isShow_ && pane_.takeKey(key)) return true; // no tool where none is shown
    if (!player_) return tilt_.takeKey(key);
    if (key == juce::KeyPress::leftKey) return play(player_->steer(-1)), true;
    if (key == juce::KeyPress::rightKey) return play(player_->steer(1)), true;
    if (key == juce::KeyPress::downKey) return play(player_->steer(0)), true;
    return false;
}

// What is moved goes for as long as a key is held; what is driven goes on.
bool WorldPanel::keyStateChanged(bool isDown) {
    using juce::KeyPress;
    if (isDown || !player_ || !player_->moves() || KeyPress::isKeyCurrentlyDown(KeyPress::leftKey) ||
        KeyPress::isKeyCurrentlyDown(KeyPress::rightKey))
        return false;
    return play(player_->steer(0)), false;
}

void WorldPanel::mouseDrag(const juce::MouseEvent& e) {
    const float left = view_.placeOfShare({0.0, 0.0}).x, right = view_.placeOfShare({1.0, 0.0}).x;
    if (player_ && player_->moves() && e.eventComponent == &view_ && !view_.isHolding())
        pointed_ = desk_.world().scene().fieldWidthMetres *
                   static_cast<double>((e.position.x - left) / (right - left));
}

void WorldPanel::mouseUp(const juce::MouseEvent&) {
    if (std::exchange(pointed_, {}) && player_) play(player_->steer(0));
}

std::optional<double> WorldPanel::playersPlace() {
    const float left = view_.placeOfShare({0.0, 0.0}).x, right = view_.placeOfShare({1.0, 0.0}).x,
                at = view_.placeOfBody(player_->body()).x;
    return at < -1e3f ? std::nullopt
                      : std::optional{desk_.world().scene().fieldWidthMetres *
                                      static_cast<double>((at - left) / (right - left))};
}

void WorldPanel::lookAfterPlayer() {
    if (!player_) return;
    // the world has begun anew
    if (!first_.empty() && desk_.saved().log.takes.size() > takesBefore_) play(std::exchange(first_, {}));
    if (!player_->moves()) return;
    const auto place = playersPlace();
    if (!place) return;
    if (pointed_) play(player_->moveTowards(*pointed_, *place));
    for (const Action& action : player_->keepInside(*place)) desk_.world().act(action);
}

void WorldPanel::pull(const std::string& body, Vector screenMetres, Vector point) {
    const double push = desk_.mix().dragNewtonSecondsPerScreenMetre;
    const auto fault =
        desk_.world().act(ImpulseAction{body, {push * screenMetres.x, push * screenMetres.y}, point});
    if (!fault.empty()) desk_.report(utf8(fault));
}

void WorldPanel::hold(const std::string& body, Vector point, Vector to) {
    hand_ = GripAction{body, to, point, handSeconds};
    moveHand();
}

void WorldPanel::letGo(const std::string& body) {
    hand_.reset();
    if (const auto fault = desk_.world().act(GripAction{body, {}, {}}); !fault.empty())
        desk_.report(utf8(fault));
}

void WorldPanel::moveHand() {
    if (!hand_ || nowMs() - handAtMs_ < handMs) return;
    handAtMs_ = nowMs();
    if (const auto fault = desk_.world().act(*std::exchange(hand_, {})); !fault.empty())
        desk_.report(utf8(fault));
}

juce::String WorldPanel::sentenceOn(const CollisionEvent& hit) const {
    const auto& scene = desk_.world().scene();
    const auto name = materialName(scene, hit), place = placeText(scene, hit);
    if (isClip(hit.sound)) return inLines({name, place});
    const auto hz = number(hit.frequencyHz, 0) + " Hz",
               felt = number(feltMost(desk_.mix(), hit).levelG, 2) + " g " + place;
    const auto tau = juce::String::charToString(0x03c4) + " " + number(hit.decayPerSecond, 0) + " /s";
    for (const auto& parts : {juce::StringArray{name, hz, tau, felt}, {name, hz, felt}})
        if (const auto words = inLines(parts); words.isNotEmpty()) return words;
    return inLines({name, felt});
}

/// In one line or two, broken between the parts; empty if there is no room.
juce::String WorldPanel::inLines(const juce::StringArray& parts) const {
    const auto font = sentence_.getFont();
    const int room = sentence_.getWidth() - sentence_.getBorderSize().getLeftAndRight();
    juce::StringArray lines{parts[0]};
    for (int k = 1; k < parts.size(); ++k) {
        const auto longer = lines.strings.getReference(lines.size() - 1) + dot + parts[k];
        if (font.getStringWidth(longer) <= room)
            lines.set(lines.size() - 1, longer);
        else
            lines.add(parts[k]);
    }
    return lines.size() <= 2 ? lines.joinIntoString("\n") : juce::String{};
}

void WorldPanel::refresh(const DeskMoment& moment) {
    const double now = juce::Time::getMillisecondCounterHiRes();
    for (const auto& hit : moment.hits)
        if (now - hitAtMs_ > tellMs || std::abs(hit.amplitude) > std::abs(told_.amplitude)) {
            told_ = hit;
            hitAtMs_ = now;
            sentence_.setText(sentenceOn(hit), juce::dontSendNotification);
        }
    lookAfterPlayer();
    moveHand();
    pane_.letItRain();
    if (desk_.script().isRecording() || script_.isVisible()) script_.refresh(pane_.tool() == DrawTool::hand);
    placeInspector(); // what is selected moves
    view_.update({moment.poses, moment.sessionNs, moment.aheadNs, moment.hits,
                  std::span{moment.meters.peaks}.first(static_cast<std::size_t>(desk_.mix().count()))});
}

void WorldPanel::edit(const juce::String& name, const Action& action) {
    if (const auto fault = desk_.world().edit(name, action); !fault.empty()) desk_.report(utf8(fault));
}

void WorldPanel::paint(juce::Graphics& g) { drawPanel(g, *this); }

void WorldPanel::resized() {
    auto area = getLocalBounds().reduced(panelInset, 10);
    auto row = area.removeFromBottom(38);
    law_.setVisible(!isShow_ && getWidth() >= lawNeeds);
    compare_.setBounds(row.removeFromRight(46).reduced(2, 5));
    if (law_.isVisible()) law_.setBounds(row.removeFromRight(174));
    dragName_.setBounds(row.removeFromRight(104));
    drag_.setBounds(row.removeFromRight(38));
    tiltName_.setBounds(row.removeFromRight(58));
    tilt_.setBounds(row.removeFromRight(38));
    sentence_.setBounds(row);
    if (hitAtMs_ > 0.0) sentence_.setText(sentenceOn(told_), juce::dontSendNotification);
    auto top = getLocalBounds().reduced(6, 8).withTrimmedBottom(48);
    const int tools = isShow_ ? 0 : DrawBar::widthFor(top.getHeight());
    bar_.setBounds(top.removeFromLeft(tools));
    view_.setBounds(getLocalBounds().reduced(3)); // inside the panel's round corners
    constexpr int silenceHigh = 40;               // the button lies over the corner of a show
    view_.setRoom(isShow_ ? juce::BorderSize<int>{silenceHigh, 0, 0, 0}
                          : juce::BorderSize<int>{20, tools - 12, 44, 0});
    pane_.setBounds(view_.getBounds());
    top.removeFromLeft(8);
    script_.setBounds(top.withHeight(script_.getHeight()));
    palette_.setBounds(top.removeFromTop(26));
    placeInspector();
}

} // namespace physvib

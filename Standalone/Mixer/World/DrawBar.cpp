// SPDX-License-Identifier: GPL-3.0-or-later
// Buttons and controls that show and change the selected tool, material and bodies.
#include "Mixer/World/DrawBar.h"
#include "Scene/SceneLimits.h"
#include <algorithm>

namespace physvib {

class DrawBar::ToolButton final : public juce::Button {
public:
    explicit ToolButton(const DrawToolWords& words)
        : juce::Button{words.name}
        , tool{words.tool} {
        setTitle(words.name);
        setTooltip(juce::String{words.name} + ": " + words.does + " (" +
                   juce::String::charToString(static_cast<juce::juce_wchar>(words.key)).toUpperCase() + ")");
    }
    void paintButton(juce::Graphics& g, bool isOver, bool isDown) override {
        getLookAndFeel().drawButtonBackground(g, *this, {}, isOver, isDown);
        g.setColour(shade(*this, getToggleState() ? Shade::well : Shade::text));
        g.fillPath(signOf(tool), juce::AffineTransform::translation(getLocalBounds().toFloat().getCentre()));
    }
    const DrawTool tool;
};

DrawBar::DrawBar(DrawPane& pane)
    : pane_{pane} {
    setTitle("Tools");
    for (const auto& words : drawTools) {
        auto& button = *tools_.emplace_back(std::make_unique<ToolButton>(words));
        button.onClick = [this, tool = words.tool] { pane_.use(tool); };
        button.setWantsKeyboardFocus(true);
        addAndMakeVisible(button);
    }
    snap_.setTitle("Snap");
    snap_.setTooltip("Snap to a grid (G)");
    snap_.onClick = [this] { pane_.setSnapping(!pane_.snaps()); };
    addAndMakeVisible(snap_);
    show();
}

DrawBar::~DrawBar() = default;

void DrawBar::show() {
    for (auto& button : tools_)
        button->setToggleState(button->tool == pane_.tool(), juce::dontSendNotification);
    snap_.setToggleState(pane_.snaps(), juce::dontSendNotification);
}

namespace {
constexpr int buttonCount = static_cast<int>(drawTools.size()) + 1;
}

int DrawBar::highFor(int height) {
    return height + between >= buttonCount * (high + between) ? high : lowHigh;
}

int DrawBar::perColumn(int height) { return std::max(1, (height + between) / (highFor(height) + between)); }

int DrawBar::widthFor(int height) {
    const int rows = perColumn(height);
    return (buttonCount + rows - 1) / rows * (wide + between) - between;
}

void DrawBar::resized() {
    const int rows = perColumn(getHeight()), each = highFor(getHeight());
    for (int k = 0; k <= static_cast<int>(tools_.size()); ++k) {
        auto& button = k < static_cast<int>(tools_.size())
                           ? static_cast<juce::Component&>(*tools_[static_cast<std::size_t>(k)])
                           : snap_;
        button.setBounds(k / rows * (wide + between), k % rows * (each + between), wide, each);
    }
}

BodyPanel::BodyPanel(Desk& desk, DrawPane& pane)
    : desk_{desk}
    , pane_{pane} {
    setTitle("Chosen bodies");
    const auto change = [this](const juce::String& name, auto what, bool goesOn = false) {
        pane_.changeChosen(
            name, [what](const Scene& scene, BodyDescription& body) { what(scene, body); }, goesOn);
    };
    name_.setFont(juce::Font{text::small, juce::Font::bold});
    caption(densityName_, "density");
    caption(bounceName_, "bounce");
    caption(speedName_, "motor");
    caption(torqueName_, "torque");
    caption(springName_, "spring");
    moves_.setTitle("Moves");
    moves_.setTooltip("Moving, or static");
    moves_.onClick = [this, change] {
        change("Moves", [moves = moves_.getToggleState()](const Scene& s, BodyDescription& b) {
            setMoving(s, b, moves);
        });
    };
    source_.setTitle("Haptic source");
    source_.setTooltip("Its collisions are felt");
    source_.onClick = [this, change] {
        change("Haptic source",
               [is = source_.getToggleState()](const Scene& s, BodyDescription& b) { setSource(s, b, is); });
    };
    for (auto* slider : {&density_, &bounce_, &speed_, &torque_, &spring_}) {
        slider->setSliderStyle(juce::Slider::LinearHorizontal);
        // read when the text box is created
        slider->setColour(juce::Slider::textBoxOutlineColourId, juce::Colours::transparentBlack);
        slider->setTextBoxStyle(juce::Slider::TextBoxRight, false, 62, 20);
    }
    density_.setTitle("Density");
    density_.setTooltip("Density, in kg per square metre; the mass follows from it");
    density_.setRange(1.0, 20'000.0, 1.0);
    density_.setSkewFactorFromMidPoint(800.0);
    onSlide(density_, [this, change](bool goesOn) {
        change(
            "Density", [kg = density_.getValue()](const Scene&, BodyDescription& b) { setDensity(b, kg); },
            goesOn);
    });
    bounce_.setTitle("Bounce");
    bounce_.setTooltip("Coefficient of restitution of this body alone");
    bounce_.setRange(0.0, 1.0, 0.01);
    onSlide(bounce_, [this, change](bool goesOn) {
        change(
            "Bounce",
            [bounce = bounce_.getValue()](const Scene&, BodyDescription& b) {
                for (auto& fixture : b.fixtures) fixture.restitution = bounce;
            },
            goesOn);
    });
    constexpr double fastest = 20.0; // rad/s, about three turns a second
    speed_.setTitle("Motor speed");
    speed_.setTooltip("Speed of the motor, in rad/s, counter-clockwise; 0 with a torque: a brake");
    speed_.setRange(-fastest, fastest, 0.1);
    speed_.setDoubleClickReturnValue(true, 0.0);
    torque_.setTitle("Motor torque");
    torque_.setTooltip("Most that the motor turns with, in N m; 0: no motor");
    torque_.setRange(0.0, 1e6, 1.0);
    torque_.setSkewFactorFromMidPoint(1e3);
    for (auto* slider : {&speed_, &torque_}) onSlide(*slider, [this](bool goesOn) { drive(goesOn); });
    spring_.setTitle("Stiffness of the spring");
    spring_.setTooltip("How fast the spring lets its bodies swing, in Hz; they return to their start");
    spring_.setRange(0.1, 20.0, 0.1);
    spring_.setSkewFactorFromMidPoint(2.0);
    onSlide(spring_, [this](bool goesOn) { stiffen(goesOn); });
    for (juce::Component* c : std::initializer_list<juce::Component*>{
             &name_, &moves_, &source_, &densityName_, &density_, &bounceName_, &bounce_, &speedName_,
             &speed_, &torqueName_, &torque_, &springName_, &spring_})
        addAndMakeVisible(c);
}

void BodyPanel::drive(bool goesOn) {
    const auto actions = driven(desk_.world().drawing(), drivenJoint_,
                                {speed_.getValue(), torque_.getValue()}, desk_.world().posesNow());
    const auto error = actions ? desk_.world().edit("Motor", actions.value, goesOn) : actions.error;
    if (!error.empty()) desk_.report(utf8(error));
}

void BodyPanel::stiffen(bool goesOn) {
    const auto actions = sprung(desk_.world().drawing(), springJoint_, spring_.getValue());
    const auto error = actions ? desk_.world().edit("Spring", actions.value, goesOn) : actions.error;
    if (!error.empty()) desk_.report(utf8(error));
}

void BodyPanel::show() {
    const auto& chosen = pane_.chosen();
    const auto* body = chosen.empty() ? nullptr : desk_.world().drawing().find(chosen[0]);
    setVisible(body != nullptr && pane_.tool() == DrawTool::choose);
    if (body == nullptr) return;
    const Scene& scene = desk_.world().drawing().drawn();
    const auto* motor = chosen.size() == 1 ? motorOf(scene, chosen[0]) : nullptr;
    drivenJoint_ = motor ? motor->name : std::string{};
    for (juce::Component* c :
         std::initializer_list<juce::Component*>{&speedName_, &speed_, &torqueName_, &torque_})
        c->setVisible(motor != nullptr);
    if (motor && !speed_.isMouseButtonDown() && !torque_.isMouseButtonDown()) {
        speed_.setValue(driveOf(*motor).radiansPerSecond, juce::dontSendNotification);
        torque_.setValue(driveOf(*motor).maxTorqueNewtonMetres, juce::dontSendNotification);
    }
    const auto* spring = chosen.size() == 1 ? springOf(scene, chosen[0]) : nullptr;
    springJoint_ = spring ? spring->name : std::string{};
    springName_.setVisible(spring != nullptr);
    spring_.setVisible(spring != nullptr);
    if (spring && !spring_.isMouseButtonDown())
        spring_.setValue(springHzOf(*spring), juce::dontSendNotification);
    const auto material = utf8(scene.materials[static_cast<std::size_t>(body->fixtures[0].material)].name);
    name_.setText(
        (chosen.size() == 1 ? utf8(chosen[0]) : juce::String{static_cast<int>(chosen.size())} + " bodies") +
            " " + juce::String::charToString(0x00b7) + " " + material,
        juce::dontSendNotification);
    moves_.setToggleState(body->type == BodyType::dynamicBody, juce::dontSendNotification);
    source_.setToggleState(std::ranges::any_of(body->fixtures, &FixtureDescription::isCamera),
                           juce::dontSendNotification);
    const auto& fixture = body->fixtures[0];
    if (!density_.isMouseButtonDown()) density_.setValue(densityOf(scene, *body), juce::dontSendNotification);
    if (!bounce_.isMouseButtonDown())
        bounce_.setValue(fixture.restitution.value_or(
                             scene.materials[static_cast<std::size_t>(fixture.material)].restitution),
                         juce::dontSendNotification);
    for (auto* label : {&densityName_, &bounceName_, &speedName_, &torqueName_, &springName_})
        label->setColour(juce::Label::textColourId, shade(*this, Shade::muted));
}

void BodyPanel::paint(juce::Graphics& g) {
    g.setColour(shade(*this, Shade::raised).withAlpha(0.95f));
    g.fillRoundedRectangle(getLocalBounds().toFloat(), 8.0f);
}

void BodyPanel::resized() {
    auto area = getLocalBounds().reduced(10, 6);
    name_.setBounds(area.removeFromTop(24));
    auto row = area.removeFromTop(rowHigh);
    moves_.setBounds(row.removeFromLeft(80));
    source_.setBounds(row);
    for (const auto& [label, slider] : {std::pair{&densityName_, &density_},
                                        {&bounceName_, &bounce_},
                                        {&speedName_, &speed_},
                                        {&torqueName_, &torque_},
                                        {&springName_, &spring_}}) {
        if (!slider->isVisible()) continue;
        row = area.removeFromTop(rowHigh);
        label->setBounds(row.removeFromLeft(50));
        slider->setBounds(row);
    }
}

} // namespace physvib

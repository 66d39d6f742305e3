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

void DrawBar::resized() {
    constexpr int between = 3;
    const int high = std::min(30, (getHeight() + between) / static_cast<int>(tools_.size() + 1) - between);
    auto area = getLocalBounds();
    for (auto& button : tools_) button->setBounds(area.removeFromTop(high)), area.removeFromTop(between);
    snap_.setBounds(area.removeFromTop(high));
}

class MaterialPalette::Swatch final : public juce::Button {
public:
    Swatch(const juce::String& name, juce::Colour colour)
        : juce::Button{name}
        , colour_{colour} {
        setTitle("Material " + name);
        setTooltip(name + ": draw with it; with the mouse over it, it is played once");
        setWantsKeyboardFocus(true);
    }
    int wanted() const { return 34 + juce::Font{text::small}.getStringWidth(getName()); }
    std::function<void()> onEnter;
    void mouseEnter(const juce::MouseEvent& e) override {
        juce::Button::mouseEnter(e);
        if (onEnter) onEnter();
    }
    void paintButton(juce::Graphics& g, bool isOver, bool) override {
        g.setColour(shade(*this, getToggleState() ? Shade::raised : Shade::panel)
                        .brighter(isOver ? 0.1f : 0.0f)
                        .withAlpha(0.95f));
        g.fillRoundedRectangle(getLocalBounds().toFloat(), 6.0f);
        g.setColour(colour_);
        g.fillEllipse(8.0f, 0.5f * static_cast<float>(getHeight()) - 6.0f, 12.0f, 12.0f);
        g.setColour(shade(*this, getToggleState() ? Shade::text : Shade::muted));
        g.setFont(juce::Font{text::small});
        g.drawText(getName(), getLocalBounds().withTrimmedLeft(26), juce::Justification::centredLeft, true);
    }

private:
    juce::Colour colour_;
};

MaterialPalette::MaterialPalette(Desk& desk, DrawPane& pane)
    : desk_{desk}
    , pane_{pane} {
    setTitle("Materials to draw with");
    setInterceptsMouseClicks(false, true);
}

MaterialPalette::~MaterialPalette() = default;

void MaterialPalette::show() {
    const auto& materials = desk_.world().drawing().drawn().materials;
    if (shown_ != materials) {
        shown_ = materials;
        swatches_.clear();
        for (int i = 0; i < static_cast<int>(materials.size()); ++i) {
            auto& swatch = *swatches_.emplace_back(std::make_unique<Swatch>(
                utf8(materials[static_cast<std::size_t>(i)].name), palette::material(i)));
            swatch.onClick = [this, i] { pane_.setMaterial(i); };
            // a material that makes no sound reports it elsewhere
            swatch.onEnter = [this, i] { desk_.strikes().audition(i, 0.5, 0.5); };
            addAndMakeVisible(swatch);
            prepareControls(swatch); // it is created after the other controls
        }
        resized();
    }
    for (std::size_t i = 0; i < swatches_.size(); ++i)
        swatches_[i]->setToggleState(static_cast<int>(i) == pane_.material(), juce::dontSendNotification);
}

void MaterialPalette::resized() {
    auto area = getLocalBounds();
    for (auto& swatch : swatches_)
        swatch->setBounds(area.removeFromLeft(std::min(swatch->wanted(), area.getWidth()))),
            area.removeFromLeft(4);
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
    for (auto* slider : {&density_, &bounce_}) {
        slider->setSliderStyle(juce::Slider::LinearHorizontal);
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
    for (juce::Component* c : std::initializer_list<juce::Component*>{
             &name_, &moves_, &source_, &densityName_, &density_, &bounceName_, &bounce_})
        addAndMakeVisible(c);
}

void BodyPanel::show() {
    const auto& chosen = pane_.chosen();
    const auto* body = chosen.empty() ? nullptr : desk_.world().drawing().find(chosen[0]);
    setVisible(body != nullptr && pane_.tool() == DrawTool::choose);
    if (body == nullptr) return;
    const Scene& scene = desk_.world().drawing().drawn();
    name_.setText(chosen.size() == 1 ? utf8(chosen[0])
                                     : juce::String{static_cast<int>(chosen.size())} + " bodies",
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
    for (auto* label : {&densityName_, &bounceName_})
        label->setColour(juce::Label::textColourId, shade(*this, Shade::muted));
}

void BodyPanel::paint(juce::Graphics& g) {
    g.setColour(shade(*this, Shade::raised).withAlpha(0.95f));
    g.fillRoundedRectangle(getLocalBounds().toFloat(), 8.0f);
}

void BodyPanel::resized() {
    auto area = getLocalBounds().reduced(10, 6);
    name_.setBounds(area.removeFromTop(24));
    auto row = area.removeFromTop(28);
    moves_.setBounds(row.removeFromLeft(80));
    source_.setBounds(row);
    for (const auto& [label, slider] : {std::pair{&densityName_, &density_}, {&bounceName_, &bounce_}}) {
        row = area.removeFromTop(28);
        label->setBounds(row.removeFromLeft(50));
        slider->setBounds(row);
    }
}

} // namespace physvib

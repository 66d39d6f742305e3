// SPDX-License-Identifier: GPL-3.0-or-later
// Chips of the materials to draw with: each shows its decay, and plays under the mouse.
#include "Host/Views/Palette.h"
#include "Mixer/World/DrawBar.h"
#include "Mixer/World/FeltHint.h"
#include "Scene/Drawing/FeltTrial.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace physvib {

/// A material's chip: a picture of its decay, or a flat line for a material that does not vibrate.
class MaterialPalette::Swatch final : public juce::Button {
public:
    Swatch(const Material& material, juce::Colour colour)
        : juce::Button{utf8(material.name)}
        , material_{material}
        , colour_{colour} {
        setTitle("Material " + getName());
        setWantsKeyboardFocus(true);
    }
    /// `why`: it is not felt at usual impacts; empty: it is.
    void setWhy(const std::string& why) {
        isFelt_ = why.empty();
        setTooltip(isFelt_ ? getName() + ": draw with it; with the mouse over it, it is played once"
                           : getName() + " is not felt at usual impacts: " + utf8(why));
        repaint();
    }
    enum class Show { picture, name, remark }; ///< a remark says in words that it is not felt
    int wanted(Show show) const {
        return show == Show::picture ? 32 : 38 + juce::Font{text::small}.getStringWidth(words(show));
    }
    void setShow(Show show) {
        show_ = show;
        repaint();
    }
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
        g.strokePath(decay(), juce::PathStrokeType{1.6f},
                     juce::AffineTransform::translation(7.0f, 0.5f * static_cast<float>(getHeight())));
        g.setColour(shade(*this, getToggleState() ? Shade::text : Shade::muted));
        g.setFont(juce::Font{text::small});
        g.drawText(words(show_), getLocalBounds().withTrimmedLeft(30), juce::Justification::centredLeft,
                   true);
    }

private:
    juce::String words(Show show) const {
        return show == Show::picture ? juce::String{}
                                     : getName() + (show == Show::remark && !isFelt_ ? ": not felt" : "");
    }
    /// The first tenth of a second, with fewer waves than it has, so that they can be told apart.
    juce::Path decay() const {
        constexpr double wide = 18.0, high = 8.0, seconds = 0.1, wavesPerHertz = 0.012;
        juce::Path path;
        path.startNewSubPath(0.0f, 0.0f);
        for (double x = 0.5; x <= wide; x += 0.5) {
            const double share = x / wide;
            const double wave =
                std::sin(juce::MathConstants<double>::twoPi * wavesPerHertz * material_.frequencyHz * share);
            path.lineTo(
                static_cast<float>(x),
                static_cast<float>(-high * wave * std::exp(-material_.decayPerSecond * seconds * share)));
        }
        return path;
    }

    const Material material_;
    const juce::Colour colour_;
    Show show_ = Show::name;
    bool isFelt_ = true;
};

namespace {

constexpr std::array<DrawPane::RainWay, 7> rainWays{
    {{0, false}, {5, false}, {20, false}, {50, false}, {5, true}, {20, true}, {50, true}}};

/// What a trial of materials depends on: which kinds of surfaces the scene has.
std::set<std::tuple<bool, int, bool>> surfacesOf(const Scene& scene) {
    std::set<std::tuple<bool, int, bool>> all;
    for (const BodyDescription& body : scene.bodies)
        for (const FixtureDescription& f : body.fixtures)
            all.emplace(body.type == BodyType::dynamicBody, f.material, f.isCamera);
    return all;
}

} // namespace

MaterialPalette::MaterialPalette(Desk& desk, DrawPane& pane)
    : desk_{desk}
    , pane_{pane} {
    setTitle("Materials to draw with");
    setInterceptsMouseClicks(false, true);
    count_.setTitle("Balls of a rain");
    count_.setTooltip("How many balls a rain has");
    for (const int count : {10, 20, 50, 100, 200, 500, 1000})
        count_.addItem(juce::String{count} + " balls", count);
    count_.onChange = [this] { pane_.setRainCount(count_.getSelectedId()); };
    way_.setTitle("How the rain comes");
    way_.setTooltip("All at once, ball by ball, or upwards from one place");
    for (int id = 1; const auto& way : rainWays)
        way_.addItem(way.perSecond == 0
                         ? juce::String{"at once"}
                         : (way.isFountain ? "fountain, " : "") + juce::String{way.perSecond} + " a second",
                     id++);
    way_.onChange = [this] {
        if (const int k = way_.getSelectedItemIndex(); k >= 0)
            pane_.setRainWay(rainWays[static_cast<std::size_t>(k)]);
    };
    addChildComponent(count_);
    addChildComponent(way_);
}

MaterialPalette::~MaterialPalette() = default;

void MaterialPalette::show() {
    const Scene& scene = desk_.world().drawing().drawn();
    const auto& materials = scene.materials;
    const bool areOther = shown_ != materials;
    if (areOther) {
        shown_ = materials;
        swatches_.clear();
        for (int i = 0; i < static_cast<int>(materials.size()); ++i) {
            auto& swatch = *swatches_.emplace_back(
                std::make_unique<Swatch>(materials[static_cast<std::size_t>(i)], palette::material(i)));
            swatch.onClick = [this, i] {
                pane_.setMaterial(i);
                hintOnMaterial(desk_, i);
            };
            // a material that makes no sound reports it elsewhere
            swatch.onEnter = [this, i] { desk_.strikes().audition(i, 0.5, 0.5); };
            addAndMakeVisible(swatch);
            prepareControls(swatch); // it is created after the other controls
        }
    }
    if (areOther || surfaces_ != surfacesOf(scene)) {
        surfaces_ = surfacesOf(scene);
        for (int i = 0; i < static_cast<int>(swatches_.size()); ++i)
            swatches_[static_cast<std::size_t>(i)]->setWhy(whyNotFelt(scene, i));
        resized();
    }
    count_.setSelectedId(pane_.rainCount(), juce::dontSendNotification);
    way_.setSelectedItemIndex(
        static_cast<int>(std::ranges::find(rainWays, pane_.rainWay()) - rainWays.begin()),
        juce::dontSendNotification);
    if (const bool isRain = pane_.tool() == DrawTool::rain; isRain != count_.isVisible()) {
        count_.setVisible(isRain);
        way_.setVisible(isRain);
        resized();
    }
    for (std::size_t i = 0; i < swatches_.size(); ++i)
        swatches_[i]->setToggleState(static_cast<int>(i) == pane_.material(), juce::dontSendNotification);
    if (std::exchange(chosen_, pane_.material()) != pane_.material()) resized(); // its name may need room
}

void MaterialPalette::resized() {
    constexpr int between = 4;
    auto area = getLocalBounds();
    for (auto [list, wide] : {std::pair{&count_, 106}, {&way_, 150}})
        if (list->isVisible()) list->setBounds(area.removeFromLeft(wide)), area.removeFromLeft(between);
    using Show = Swatch::Show;
    const auto showOf = [](const Swatch& swatch, Show others) { // the selected one keeps its name
        return others == Show::picture && swatch.getToggleState() ? Show::name : others;
    };
    Show show = Show::remark;
    for (; show != Show::picture; show = show == Show::remark ? Show::name : Show::picture) {
        int wide = -between;
        for (const auto& swatch : swatches_) wide += swatch->wanted(show) + between;
        if (wide <= area.getWidth()) break;
    }
    for (auto& swatch : swatches_) {
        const Show its = showOf(*swatch, show);
        swatch->setShow(its);
        swatch->setBounds(area.removeFromLeft(std::min(swatch->wanted(its), area.getWidth())));
        area.removeFromLeft(between);
    }
}

} // namespace physvib

// SPDX-License-Identifier: GPL-3.0-or-later
// Buttons and controls that show and change the selected tool, material and bodies.
#include "Mixer/World/DrawBar.h"
#include "Mixer/Widgets/Cards.h"
#include "Scene/Drawing/ImpactTrial.h"
#include "Scene/SceneLimits.h"

namespace physvib {

class DrawBar::ToolButton final : public juce::Button {
public:
    explicit ToolButton(const DrawToolInfo& info)
        : juce::Button{info.name}
        , tool{info.tool} {
        setTitle(info.name);
        getProperties().set(iconProperty, true);
        setTooltip(juce::String{info.name} + ": " + info.help + " (" +
                   juce::String::charToString(static_cast<juce::juce_wchar>(info.key)).toUpperCase() + ")");
    }
    void paintButton(juce::Graphics& g, bool isOver, bool isDown) override {
        getLookAndFeel().drawButtonBackground(g, *this, {}, isOver, isDown);
        g.setColour(shade(*this, getToggleState() ? Shade::well : Shade::text));
        g.fillPath(toolIcon(tool),
                   juce::AffineTransform::translation(getLocalBounds().toFloat().getCentre()));
    }
    const DrawTool tool;
};

DrawBar::DrawBar(DrawPane& pane)
    : pane_{pane} {
    setTitle("Tools");
    for (const auto& info : drawTools) {
        auto& button = *tools_.emplace_back(std::make_unique<ToolButton>(info));
        button.onClick = [this, tool = info.tool] { pane_.setTool(tool); };
        button.setWantsKeyboardFocus(true);
        addAndMakeVisible(button);
    }
    describe(snapButton_, "Snap", "Snap to a grid (G)");
    snapButton_.onClick = [this] { pane_.setSnapping(!pane_.isSnapping()); };
    addAndMakeVisible(snapButton_);
    refresh();
}

DrawBar::~DrawBar() = default;

void DrawBar::refresh() {
    for (auto& button : tools_)
        button->setToggleState(button->tool == pane_.tool(), juce::dontSendNotification);
    snapButton_.setToggleState(pane_.isSnapping(), juce::dontSendNotification);
}

namespace {
constexpr int buttonCount = static_cast<int>(drawTools.size()) + 1;

/// Group of a button: 0 hand and selection, 1 shapes, 2 joints, 3 eraser and grid.
int buttonGroup(int button) { return button < 2 ? 0 : button < 9 ? 1 : button < 14 ? 2 : 3; }

constexpr std::array<RainPattern, 7> rainPatterns{
    {{0, false}, {5, false}, {20, false}, {50, false}, {5, true}, {20, true}, {50, true}}};

/// Kinds of surfaces (moving, material, haptic source), on which silentBodyReason() depends.
std::set<std::tuple<bool, int, bool>> collectSurfaces(const Scene& scene) {
    std::set<std::tuple<bool, int, bool>> surfaces;
    for (const BodyDescription& body : scene.bodies)
        for (const FixtureDescription& fixture : body.fixtures)
            surfaces.emplace(body.type == BodyType::dynamicBody, fixture.material, fixture.isCamera);
    return surfaces;
}

bool vibrates(const Scene& scene, const BodyDescription& body) {
    return nth(scene.materials, body.fixtures[0].material).frequencyHz > 0.0;
}
/// Opens the menu of a material, or directly the editor of its name and colour.
void editMaterial(juce::Component& target, bool isMenu, MixerModel& model, int material,
                  const std::function<void(int)>& onCreated, const OpenMaterialPage& openPage) {
    if (!isMenu) return askMaterial(target, model, material, false, [](int) {});
    showMaterialMenu(target, model, material, onCreated,
                     [&openPage, material](bool isRecording) { openPage(material, isRecording); });
}
} // namespace

int DrawBar::buttonHeightFor(int height) {
    return height + spacing >= buttonCount * (buttonHeight + spacing) ? buttonHeight : lowButtonHeight;
}

// Spreads the buttons evenly over as many columns as are needed.
int DrawBar::buttonsPerColumn(int height) {
    const int maxPerColumn = std::max(1, (height + spacing) / (buttonHeightFor(height) + spacing));
    const int columns = (buttonCount + maxPerColumn - 1) / maxPerColumn;
    return (buttonCount + columns - 1) / columns;
}

int DrawBar::widthFor(int height) {
    const int rows = buttonsPerColumn(height);
    return (buttonCount + rows - 1) / rows * (buttonWidth + spacing) - spacing;
}

void DrawBar::resized() {
    const int rows = buttonsPerColumn(getHeight()), height = buttonHeightFor(getHeight());
    const int groupGap = rows < buttonCount
                             ? 0 // several columns
                             : std::min((getHeight() + spacing - rows * (height + spacing)) / 3, 8);
    for (int k = 0; k <= static_cast<int>(tools_.size()); ++k) {
        auto& button = k < static_cast<int>(tools_.size()) ? static_cast<juce::Component&>(*nth(tools_, k))
                                                           : snapButton_;
        button.setBounds(k / rows * (buttonWidth + spacing),
                         k % rows * (height + spacing) + buttonGroup(k) * groupGap, buttonWidth, height);
    }
}

/// A material's chip: a picture of its decay, or a flat line for a material that does not vibrate.
class MaterialSwatch final : public juce::Button {
public:
    MaterialSwatch(const Material& material, juce::Colour colour)
        : juce::Button{utf8(material.name)}
        , material_{material}
        , colour_{colour} {
        setTitle("Material " + getName());
        setWantsKeyboardFocus(true);
    }
    /// `reason`: why typical impacts of the material are not felt; empty: they are felt.
    void setSilentReason(const std::string& reason) {
        isPerceptible_ = reason.empty();
        setTooltip(isPerceptible_ ? getName() + ": draw with it; a double click: its name and colour"
                                  : getName() + " is not felt at usual impacts: " + utf8(reason));
        repaint();
    }
    static constexpr int iconWidth = 32;
    int widthWithName() const { return 38 + text::pixelWidth(text::font(text::small), getName()); }
    std::function<void()> onEnter;
    std::function<void(MaterialSwatch&, bool isMenu)> onEdit; ///< double click; right click: isMenu
    void mouseDown(const juce::MouseEvent& e) override {
        e.mods.isPopupMenu() ? onEdit(*this, true) : juce::Button::mouseDown(e);
    }
    void mouseDoubleClick(const juce::MouseEvent&) override { onEdit(*this, false); }
    void mouseEnter(const juce::MouseEvent& e) override {
        juce::Button::mouseEnter(e);
        if (onEnter) onEnter();
    }
    void paintButton(juce::Graphics& g, bool isOver, bool) override {
        g.setColour(shade(*this, getToggleState() ? Shade::raised : Shade::panel)
                        .brighter(isOver ? 0.1f : 0.0f)
                        .withAlpha(0.95f));
        g.fillRoundedRectangle(getLocalBounds().toFloat(), 6.0f);
        g.setColour(shade(*this, Shade::accent)); // underlined as tabs are; a frame would mark the focus
        if (getToggleState()) g.fillRect(getLocalBounds().reduced(6, 0).removeFromBottom(2));
        g.setColour(colour_);
        const float middle = 0.5f * static_cast<float>(getHeight());
        const float left = std::min(7.0f, 0.5f * static_cast<float>(getWidth()) - 9.0f);
        g.strokePath(decay(), juce::PathStrokeType{1.6f}, juce::AffineTransform::translation(left, middle));
        g.setColour(shade(*this, getToggleState() ? Shade::text : Shade::muted));
        if (!isPerceptible_) g.drawLine(5.0f, middle + 8.0f, 27.0f, middle - 8.0f, 1.5f); // struck out
        g.setFont(text::font(text::small));
        if (getWidth() >= widthWithName())
            g.drawText(getName(), getLocalBounds().withTrimmedLeft(30), juce::Justification::centredLeft,
                       true);
    }

private:
    /// Decay in the first tenth of a second, drawn with fewer waves than it has, so that they are distinct.
    juce::Path decay() const {
        constexpr double width = 18.0, height = 8.0, seconds = 0.1, wavesPerHertz = 0.012;
        juce::Path path;
        path.startNewSubPath(0.0f, 0.0f);
        for (double x = 0.5; x <= width; x += 0.5) {
            const double share = x / width;
            const double wave =
                std::sin(juce::MathConstants<double>::twoPi * wavesPerHertz * material_.frequencyHz * share);
            path.lineTo(
                static_cast<float>(x),
                static_cast<float>(-height * wave * std::exp(-material_.decayPerSecond * seconds * share)));
        }
        return path;
    }

    const Material material_;
    const juce::Colour colour_;
    bool isPerceptible_ = true;
};

BodyPanel::BodyPanel(MixerModel& model, DrawPane& pane, const OpenMaterialPage& openPage)
    : model_{model}
    , pane_{pane}
    , openPage_{openPage} {
    setTitle("Chosen bodies");
    const auto change = [this](const juce::String& name, auto bodyChange, bool continuesEdit = false) {
        pane_.changeSelected(name, bodyChange, continuesEdit);
        refresh(); // shows the old value again if the change was refused
    };
    const auto bindSlider = [change](juce::Slider& slider, const char* name, auto set) {
        onSliderChange(slider, [change, name, set, &slider](bool continuesEdit) {
            change(
                name, [set, value = slider.getValue()](const Scene&, BodyDescription& b) { set(b, value); },
                continuesEdit);
        });
    };
    nameLabel_.setFont(text::font(text::small, juce::Font::bold));
    nameLabel_.setMinimumHorizontalScale(1.0f);
    describe(moves_, "Moves", "Moving, or static");
    moves_.onClick = [this, change] {
        change("Moves",
               [moves = moves_.getToggleState()](const Scene&, BodyDescription& b) { setMoving(b, moves); });
    };
    describe(source_, "Haptic source", "Its collisions are felt");
    source_.onClick = [this, change] {
        bool hasAny = !source_.getToggleState();
        change("Haptic source", [&hasAny, setsSource = !hasAny](const Scene& s, BodyDescription& b) {
            if (setsSource && !vibrates(s, b)) return;
            setSource(s, b, setsSource);
            hasAny = true;
        });
        if (!hasAny) model_.report("Nothing chosen has a material that vibrates: choose another one below");
    };
    for (auto* slider : {&density_, &bounce_, &speed_, &torque_, &spring_, &belt_}) {
        // set before the style, which creates the text box
        slider->setColour(juce::Slider::textBoxOutlineColourId, juce::Colours::transparentBlack);
        slider->setSliderStyle(juce::Slider::LinearBar);
    }
    // density and bounce
    describe(density_, "Density", "Density, in kg per square metre; the mass follows from it");
    density_.setRange(1.0, 20'000.0, 1.0);
    density_.textFromValueFunction = [](double kg) {
        return number(kg, 0) + (kg < 200.0 ? " light" : kg < 2000.0 ? " medium" : " heavy");
    };
    bounce_.textFromValueFunction = [](double b) {
        return number(b, 2) + (b < 0.2 ? " dead" : b < 0.7 ? " lively" : " bouncy");
    };
    density_.setSkewFactorFromMidPoint(800.0);
    bindSlider(density_, "Density", setDensity);
    describe(bounce_, "Bounce", "Coefficient of restitution of this body alone");
    bounce_.setRange(0.0, 1.0, 0.01);
    bindSlider(bounce_, "Bounce", [](BodyDescription& b, double bounce) {
        for (auto& fixture : b.fixtures) fixture.restitution = bounce;
    });
    // motor, spring and belt of a single body
    constexpr double maxSpeed = 20.0; // rad/s, about three turns a second
    describe(speed_, "Motor speed",
             "Speed of the motor, in rad/s, counter-clockwise; 0 with a torque: a brake");
    speed_.setRange(-maxSpeed, maxSpeed, 0.1);
    speed_.setTextValueSuffix(" rad/s");
    speed_.setDoubleClickReturnValue(true, 0.0);
    describe(torque_, "Motor torque", "Most that the motor turns with, in N m; 0: no motor");
    torque_.setRange(0.0, 1e6, 1.0);
    torque_.setSkewFactorFromMidPoint(1e3);
    torque_.setTextValueSuffix(" N m");
    for (auto* slider : {&speed_, &torque_})
        onSliderChange(*slider, [this](bool continuesEdit) {
            edit("Motor",
                 motorActions(model_.world().drawing(), motorJoint_, {speed_.getValue(), torque_.getValue()},
                              model_.world().posesNow()),
                 continuesEdit);
        });
    describe(spring_, "Stiffness of the spring",
             "How fast the spring lets its bodies swing, in Hz; they return to their start");
    spring_.setRange(0.1, 20.0, 0.1);
    spring_.setSkewFactorFromMidPoint(2.0);
    spring_.setTextValueSuffix(" Hz");
    onSliderChange(spring_, [this](bool continuesEdit) {
        edit("Spring", springActions(model_.world().drawing(), springJoint_, spring_.getValue()),
             continuesEdit);
    });
    describe(belt_, "Belt speed", "Speed of the conveyor belt, in m/s, on top to the right");
    belt_.setRange(-20.0, 20.0, 0.1);
    belt_.setTextValueSuffix(" m/s");
    bindSlider(belt_, "Belt speed", [](BodyDescription& b, double speed) {
        constexpr double minBeltSpeed = 0.01; // m/s; a belt without speed would be a wall
        b.velocityMetresPerSecond.x = speed == 0.0 ? minBeltSpeed : speed;
    });
    // material
    newButton_.onClick = [this] { askMaterial(*this, model_, pane_.material(), true, assignMaterial_); };
    editLink_ = makeLinkButton({}, "Material of what is chosen");
    editLink_->setTooltip("The material: name, colour, copy, figures, recording");
    editLink_->onClick = [this] {
        const auto* body =
            pane_.selected().empty() ? nullptr : model_.world().drawing().find(pane_.selected()[0]);
        if (body != nullptr)
            editMaterial(*editLink_, true, model_, body->fixtures[0].material, assignMaterial_, openPage_);
    };
    addAll(*this, {&newButton_, editLink_.get(), &nameLabel_, &moves_, &source_, &densityLabel_, &density_,
                   &bounceLabel_, &bounce_, &speedLabel_, &speed_, &torqueLabel_, &torque_, &springLabel_,
                   &spring_, &beltLabel_, &belt_});
}

BodyPanel::~BodyPanel() = default;

void BodyPanel::refresh() {
    const auto& selection = pane_.selected();
    const auto* body = selection.empty() ? nullptr : model_.world().drawing().find(selection[0]);
    setVisible(body != nullptr && pane_.tool() != DrawTool::hand);
    if (body == nullptr) return;
    const Scene& scene = model_.world().drawing().drawn();
    // motor, spring and belt of a single body
    const auto* motor = selection.size() == 1 ? findMotor(scene, selection[0]) : nullptr;
    motorJoint_ = motor ? motor->name : std::string{};
    physvib::setVisible({&speedLabel_, &speed_, &torqueLabel_, &torque_}, motor != nullptr);
    if (motor && !speed_.isMouseButtonDown() && !torque_.isMouseButtonDown()) {
        speed_.setValue(driveOf(*motor).speedRadiansPerSecond, juce::dontSendNotification);
        torque_.setValue(driveOf(*motor).maxTorqueNewtonMetres, juce::dontSendNotification);
    }
    const auto* spring = selection.size() == 1 ? findSpring(scene, selection[0]) : nullptr;
    springJoint_ = spring ? spring->name : std::string{};
    physvib::setVisible({&springLabel_, &spring_}, spring != nullptr);
    if (spring && !spring_.isMouseButtonDown())
        spring_.setValue(springHzOf(*spring), juce::dontSendNotification);
    const double belt = body->velocityMetresPerSecond.x;
    physvib::setVisible({&beltLabel_, &belt_},
                        selection.size() == 1 && body->type == BodyType::staticBody && belt != 0.0);
    if (!belt_.isMouseButtonDown()) belt_.setValue(belt, juce::dontSendNotification);
    // properties in which the bodies may differ
    const auto differs = [&](auto property) {
        return std::ranges::any_of(selection, [&](const std::string& name) {
            const auto* otherBody = model_.world().drawing().find(name);
            return otherBody != nullptr && property(*otherBody) != property(*body);
        });
    };
    const auto effectiveBounce = [&scene](const BodyDescription& b) {
        const auto& f = b.fixtures[0];
        return f.restitution.value_or(nth(scene.materials, f.material).restitution);
    };
    const auto captionText = [](const char* caption, bool isMarked) {
        return caption + (isMarked ? " " + juce::String::charToString(0x2260) : juce::String{}); // not equal
    };
    densityLabel_.setText(captionText("density", differs([&](const auto& b) { return densityOf(scene, b); })),
                          juce::dontSendNotification);
    bounceLabel_.setText(captionText("bounce", differs(effectiveBounce)), juce::dontSendNotification);
    // ticked if all bodies that can have the property have it; otherwise a press gives it to them
    const auto showToggle = [&](juce::ToggleButton& button, const char* caption, auto canHave, auto isOn) {
        int capableCount = 0, tickedCount = 0;
        for (const std::string& name : selection)
            if (const auto* b = model_.world().drawing().find(name); b != nullptr && canHave(*b))
                ++capableCount, tickedCount += isOn(*b) ? 1 : 0;
        button.setToggleState(capableCount > 0 && tickedCount == capableCount, juce::dontSendNotification);
        button.setButtonText(captionText(caption, tickedCount > 0 && tickedCount < capableCount));
    };
    showToggle(
        moves_, "moves",
        [](const BodyDescription& b) {
            return !std::holds_alternative<ChainShape>(b.fixtures[0].shape); // a line is always static
        },
        [](const BodyDescription& b) { return b.type == BodyType::dynamicBody; });
    showToggle(
        source_, "haptic source", [&scene](const BodyDescription& b) { return vibrates(scene, b); },
        isSource);
    const bool isMixed = differs([](const auto& b) { return b.fixtures[0].material; });
    const auto material = isMixed ? juce::String{"several materials"}
                                  : utf8(nth(scene.materials, body->fixtures[0].material).name);
    if (std::exchange(shownMaterials_, scene.materials) != scene.materials) {
        swatches_.clear();
        for (int i = 0; i < static_cast<int>(shownMaterials_.size()); ++i) {
            auto& swatch = *swatches_.emplace_back(std::make_unique<MaterialSwatch>(
                nth(shownMaterials_, i), palette::material(shownMaterials_, i)));
            describe(swatch, "Made of " + swatch.getName(),
                     swatch.getName() + ": what is chosen is made of it");
            swatch.onClick = [this, i] { assignMaterial_(i); };
            swatch.onEdit = [this, i](MaterialSwatch& target, bool isMenu) {
                editMaterial(target, isMenu, model_, i, assignMaterial_, openPage_);
            };
            addAndMakeVisible(swatch);
            prepareControls(swatch);
        }
        resized();
    }
    for (int i = 0; auto& swatch : swatches_)
        swatch->setToggleState(i++ == body->fixtures[0].material && !isMixed, juce::dontSendNotification);
    nameLabel_.setText(selection.size() == 1 ? utf8(selection[0])
                                             : juce::String{static_cast<int>(selection.size())} + " bodies",
                       juce::dontSendNotification);
    editLink_->setButtonText(material);
    editLink_->setEnabled(!isMixed);
    if (!density_.isMouseButtonDown()) density_.setValue(densityOf(scene, *body), juce::dontSendNotification);
    if (!bounce_.isMouseButtonDown()) bounce_.setValue(effectiveBounce(*body), juce::dontSendNotification);
}

// A control stays in one line with its label; in a narrow panel each slider has its own line.
int BodyPanel::layOut(int width, bool setsBounds) {
    constexpr int nameWidth = 94, materialWidth = 100, widerMaterial = 114, movesWidth = 80,
                  sourceWidth = 118, markWidth = 18, captionWidth = 58, swatchWidth = 28, gapWidth = 4;
    const int right = width - edge;
    int x = edge, y = edge;
    const auto place = [&](std::initializer_list<std::pair<juce::Component*, int>> parts) {
        int totalWidth = 0;
        for (const auto& [control, controlWidth] : parts) totalWidth += controlWidth;
        if (!parts.begin()->first->isVisible()) return;
        if (x > edge && x + totalWidth > right) x = edge, y += lineHeight;
        for (const auto& [control, controlWidth] : parts) {
            if (setsBounds)
                control->setBounds(juce::Rectangle<int>{x, y, controlWidth, lineHeight}.reduced(0, 1));
            x += controlWidth;
        }
        x += gapWidth;
    };
    place({{&nameLabel_, nameWidth},
           {editLink_.get(), width > 2 * preferredWidth ? materialWidth : widerMaterial}});
    // marked buttons (the bodies differ) are wider, and each has a line of its own
    const auto isMarked = [](const juce::Button& button) {
        return button.getButtonText().containsChar(0x2260);
    };
    if (isMarked(moves_) || isMarked(source_)) {
        place({{&moves_, movesWidth + markWidth}});
        place({{&source_, sourceWidth + markWidth}});
    } else
        place({{&moves_, movesWidth}, {&source_, sourceWidth}});
    for (auto& swatch : swatches_) // the button for a new material stays beside the last swatch
        if (swatch != swatches_.back())
            place({{swatch.get(), swatchWidth}}), x -= gapWidth;
        else
            place({{swatch.get(), swatchWidth}, {&newButton_, swatchWidth}});
    const int barWidth = width > 2 * preferredWidth ? 112 : right - edge - captionWidth;
    for (const auto& [label, slider] : {std::pair{&densityLabel_, &density_},
                                        {&bounceLabel_, &bounce_},
                                        {&speedLabel_, &speed_},
                                        {&torqueLabel_, &torque_},
                                        {&springLabel_, &spring_},
                                        {&beltLabel_, &belt_}})
        place({{label, captionWidth}, {slider, barWidth}});
    return y + lineHeight + edge;
}

MaterialPalette::MaterialPalette(MixerModel& model, DrawPane& pane, const OpenMaterialPage& openPage)
    : model_{model}
    , pane_{pane}
    , openPage_{openPage} {
    setTitle("Materials to draw with");
    setInterceptsMouseClicks(false, true);
    describe(ballCountChoice_, "Balls of a rain", "How many balls a rain has");
    for (const int count : {10, 20, 50, 100, 200, 500, 1000})
        ballCountChoice_.addItem(juce::String{count} + " balls", count);
    ballCountChoice_.onChange = [this] { pane_.setRainCount(ballCountChoice_.getSelectedId()); };
    describe(patternChoice_, "How the rain comes", "All at once, ball by ball, or upwards from one place");
    for (int id = 1; const auto& rain : rainPatterns)
        patternChoice_.addItem(rain.bodiesPerSecond == 0
                                   ? juce::String{"at once"}
                                   : (rain.isFountain ? "fountain, " : "") +
                                         juce::String{rain.bodiesPerSecond} + " a second",
                               id++);
    patternChoice_.onChange = [this] {
        if (const int k = patternChoice_.getSelectedItemIndex(); k >= 0)
            pane_.setRainPattern(nth(rainPatterns, k));
    };
    newButton_.onClick = [this] { askMaterial(*this, model_, pane_.material(), true, selectMaterial_); };
    editButton_.setButtonText("Edit" + ellipsis());
    describe(editButton_, "Edit the material", "The chosen material: name, colour, copy, figures, recording");
    editButton_.onClick = [this] {
        editMaterial(editButton_, true, model_, pane_.material(), selectMaterial_, openPage_);
    };
    addAll(*this, {&newButton_, &editButton_, &nameLabel_});
    addHidden(*this, {&ballCountChoice_, &patternChoice_});
}

MaterialPalette::~MaterialPalette() = default;

void MaterialPalette::refresh() {
    const Scene& scene = model_.world().drawing().drawn();
    const auto& materials = scene.materials;
    const bool haveChanged = shownMaterials_ != materials;
    if (haveChanged) {
        shownMaterials_ = materials;
        swatches_.clear();
        for (int i = 0; i < static_cast<int>(materials.size()); ++i) {
            auto& swatch = *swatches_.emplace_back(
                std::make_unique<MaterialSwatch>(nth(materials, i), palette::material(materials, i)));
            swatch.onClick = [this, i] { selectMaterial_(i); };
            swatch.onEdit = [this, i](MaterialSwatch& target, bool isMenu) {
                editMaterial(target, isMenu, model_, i, selectMaterial_, openPage_);
            };
            // the result is ignored: the tooltip already says that a material is silent
            swatch.onEnter = [this, i] { model_.eventPlayer().audition(i, 0.5, 0.5); };
            addAndMakeVisible(swatch);
            prepareControls(swatch); // it is created after the other controls
        }
    }
    if (haveChanged || surfaces_ != collectSurfaces(scene)) {
        surfaces_ = collectSurfaces(scene);
        for (int i = 0; i < static_cast<int>(swatches_.size()); ++i)
            nth(swatches_, i)->setSilentReason(silentBodyReason(scene, i));
        resized();
    }
    ballCountChoice_.setSelectedId(pane_.rainCount(), juce::dontSendNotification);
    patternChoice_.setSelectedItemIndex(
        static_cast<int>(std::ranges::find(rainPatterns, pane_.rainPattern()) - rainPatterns.begin()),
        juce::dontSendNotification);
    physvib::setVisible({&ballCountChoice_, &patternChoice_}, pane_.tool() == DrawTool::rain);
    for (int i = 0; i < static_cast<int>(swatches_.size()); ++i) {
        auto& swatch = *nth(swatches_, i);
        swatch.setToggleState(i == pane_.material(), juce::dontSendNotification);
        if (i == pane_.material()) nameLabel_.setText(swatch.getName(), juce::dontSendNotification);
    }
    placeName();
}

// A change of selection or tool moves no swatch, because the pointer may be on its way to one.
void MaterialPalette::resized() {
    constexpr int gapWidth = 4, countWidth = 106, patternWidth = 150, newWidth = 28, editWidth = 52;
    auto area = getLocalBounds();
    patternChoice_.setBounds(area.removeFromRight(patternWidth));
    ballCountChoice_.setBounds(area.removeFromRight(countWidth + gapWidth).withTrimmedRight(gapWidth));
    int namesWidth = newWidth + gapWidth + editWidth;
    for (const auto& swatch : swatches_) namesWidth += swatch->widthWithName() + gapWidth;
    const bool hasNames = namesWidth <= area.getWidth();
    for (auto& swatch : swatches_) {
        swatch->setBounds(
            area.removeFromLeft(hasNames ? swatch->widthWithName() : MaterialSwatch::iconWidth));
        area.removeFromLeft(gapWidth);
    }
    newButton_.setBounds(area.removeFromLeft(newWidth));
    editButton_.setVisible(area.getWidth() >= gapWidth + editWidth); // without room: double-click a swatch
    editButton_.setBounds(area.withTrimmedLeft(gapWidth).removeFromLeft(editWidth));
    placeName();
}

// The name uses the space of the rain's lists while they are hidden; it is shown only if it fits whole.
void MaterialPalette::placeName() {
    constexpr int edges = 12;
    nameLabel_.setBounds(
        getLocalBounds()
            .withLeft((editButton_.isVisible() ? editButton_.getRight() : newButton_.getRight()) + edges)
            .withRight(ballCountChoice_.isVisible() ? ballCountChoice_.getX() : getWidth()));
    const bool hasNames = !swatches_.empty() && swatches_.front()->getWidth() > MaterialSwatch::iconWidth;
    nameLabel_.setVisible(!hasNames && text::pixelWidth(nameLabel_.getFont(), nameLabel_.getText()) + edges <=
                                           nameLabel_.getWidth());
}

} // namespace physvib

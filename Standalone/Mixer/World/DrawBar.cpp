// SPDX-License-Identifier: GPL-3.0-or-later
// Buttons and controls that show and change the selected tool, material and bodies.
#include "Mixer/World/DrawBar.h"
#include "Mixer/Widgets/Cards.h"
#include "Scene/Drawing/FeltTrial.h"
#include "Scene/SceneLimits.h"

namespace physvib {

class DrawBar::ToolButton final : public juce::Button {
public:
    explicit ToolButton(const DrawToolWords& words)
        : juce::Button{words.name}
        , tool{words.tool} {
        setTitle(words.name);
        getProperties().set(iconProperty, true);
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
    describe(snap_, "Snap", "Snap to a grid (G)");
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

/// Group of a button: 0 hand and selection, 1 shapes, 2 joints, 3 eraser and grid.
int groupOf(int button) { return button < 2 ? 0 : button < 9 ? 1 : button < 14 ? 2 : 3; }

constexpr std::array<RainPattern, 7> rainPatterns{
    {{0, false}, {5, false}, {20, false}, {50, false}, {5, true}, {20, true}, {50, true}}};

/// Kinds of surfaces (moving, material, haptic source), on which whyNotFelt() depends.
std::set<std::tuple<bool, int, bool>> surfacesOf(const Scene& scene) {
    std::set<std::tuple<bool, int, bool>> all;
    for (const BodyDescription& body : scene.bodies)
        for (const FixtureDescription& f : body.fixtures)
            all.emplace(body.type == BodyType::dynamicBody, f.material, f.isCamera);
    return all;
}

bool vibrates(const Scene& scene, const BodyDescription& body) {
    return nth(scene.materials, body.fixtures[0].material).frequencyHz > 0.0;
}
/// Opens the menu of a material, or directly the editor of its name and colour.
void editMaterial(juce::Component& from, bool isMenu, MixerModel& model, int material,
                  const std::function<void(int)>& made, const MaterialPage& page) {
    if (!isMenu) return askMaterial(from, model, material, false, [](int) {});
    showMaterialMenu(from, model, material, made,
                     [&page, material](bool isRecording) { page(material, isRecording); });
}
} // namespace

int DrawBar::highFor(int height) {
    return height + between >= buttonCount * (high + between) ? high : lowHigh;
}

// Spreads the buttons evenly over as many columns as are needed.
int DrawBar::perColumn(int height) {
    const int most = std::max(1, (height + between) / (highFor(height) + between));
    const int columns = (buttonCount + most - 1) / most;
    return (buttonCount + columns - 1) / columns;
}

int DrawBar::widthFor(int height) {
    const int rows = perColumn(height);
    return (buttonCount + rows - 1) / rows * (wide + between) - between;
}

void DrawBar::resized() {
    const int rows = perColumn(getHeight()), each = highFor(getHeight());
    const int apart = rows < buttonCount ? 0 // several columns
                                         : std::min((getHeight() + between - rows * (each + between)) / 3, 8);
    for (int k = 0; k <= static_cast<int>(tools_.size()); ++k) {
        auto& button =
            k < static_cast<int>(tools_.size()) ? static_cast<juce::Component&>(*nth(tools_, k)) : snap_;
        button.setBounds(k / rows * (wide + between), k % rows * (each + between) + groupOf(k) * apart, wide,
                         each);
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
    /// `why`: why the material is not felt at usual impacts; empty: it is felt.
    void setWhy(const std::string& why) {
        isFelt_ = why.empty();
        setTooltip(isFelt_ ? getName() + ": draw with it; a double click: its name and colour"
                           : getName() + " is not felt at usual impacts: " + utf8(why));
        repaint();
    }
    static constexpr int pictureWide = 32;
    int namedWide() const { return 38 + text::pixels(text::font(text::small), getName()); }
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
        g.setColour(shade(*this, Shade::accent)); // as in tabs; frames mark the focus
        if (getToggleState()) g.fillRect(getLocalBounds().reduced(6, 0).removeFromBottom(2));
        g.setColour(colour_);
        const float middle = 0.5f * static_cast<float>(getHeight());
        const float left = std::min(7.0f, 0.5f * static_cast<float>(getWidth()) - 9.0f);
        g.strokePath(decay(), juce::PathStrokeType{1.6f}, juce::AffineTransform::translation(left, middle));
        g.setColour(shade(*this, getToggleState() ? Shade::text : Shade::muted));
        if (!isFelt_) g.drawLine(5.0f, middle + 8.0f, 27.0f, middle - 8.0f, 1.5f); // struck out
        g.setFont(text::font(text::small));
        if (getWidth() >= namedWide())
            g.drawText(getName(), getLocalBounds().withTrimmedLeft(30), juce::Justification::centredLeft,
                       true);
    }

private:
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
    bool isFelt_ = true;
};

BodyPanel::BodyPanel(MixerModel& model, DrawPane& pane, const MaterialPage& page)
    : model_{model}
    , pane_{pane}
    , page_{page} {
    setTitle("Chosen bodies");
    const auto change = [this](const juce::String& name, auto what, bool continuesEdit = false) {
        pane_.changeChosen(name, what, continuesEdit);
        show(); // restores the display if it was refused
    };
    const auto slides = [change](juce::Slider& slider, const char* name, auto set) {
        onSlide(slider, [change, name, set, &slider](bool continuesEdit) {
            change(
                name, [set, value = slider.getValue()](const Scene&, BodyDescription& b) { set(b, value); },
                continuesEdit);
        });
    };
    name_.setFont(text::font(text::small, juce::Font::bold));
    name_.setMinimumHorizontalScale(1.0f);
    describe(moves_, "Moves", "Moving, or static");
    moves_.onClick = [this, change] {
        change("Moves",
               [moves = moves_.getToggleState()](const Scene&, BodyDescription& b) { setMoving(b, moves); });
    };
    describe(source_, "Haptic source", "Its collisions are felt");
    source_.onClick = [this, change] {
        bool canBe = !source_.getToggleState();
        change("Haptic source", [&canBe, is = !canBe](const Scene& s, BodyDescription& b) {
            if (is && !vibrates(s, b)) return;
            setSource(s, b, is);
            canBe = true;
        });
        if (!canBe) model_.report("Nothing chosen has a material that vibrates: choose another one below");
    };
    for (auto* slider : {&density_, &bounce_, &speed_, &torque_, &spring_, &belt_}) {
        // read when the text box is created
        slider->setColour(juce::Slider::textBoxOutlineColourId, juce::Colours::transparentBlack);
        slider->setSliderStyle(juce::Slider::LinearBar);
    }
    describe(density_, "Density", "Density, in kg per square metre; the mass follows from it");
    density_.setRange(1.0, 20'000.0, 1.0);
    density_.textFromValueFunction = [](double kg) {
        return number(kg, 0) + (kg < 200.0 ? " light" : kg < 2000.0 ? " medium" : " heavy");
    };
    bounce_.textFromValueFunction = [](double b) {
        return number(b, 2) + (b < 0.2 ? " dead" : b < 0.7 ? " lively" : " bouncy");
    };
    density_.valueFromTextFunction = bounce_.valueFromTextFunction = [](const juce::String& words) {
        return words.retainCharacters("0123456789.").getDoubleValue();
    };
    density_.setSkewFactorFromMidPoint(800.0);
    slides(density_, "Density", setDensity);
    describe(bounce_, "Bounce", "Coefficient of restitution of this body alone");
    bounce_.setRange(0.0, 1.0, 0.01);
    slides(bounce_, "Bounce", [](BodyDescription& b, double bounce) {
        for (auto& fixture : b.fixtures) fixture.restitution = bounce;
    });
    constexpr double fastest = 20.0; // rad/s, about three turns a second
    describe(speed_, "Motor speed",
             "Speed of the motor, in rad/s, counter-clockwise; 0 with a torque: a brake");
    speed_.setRange(-fastest, fastest, 0.1);
    speed_.setTextValueSuffix(" rad/s");
    speed_.setDoubleClickReturnValue(true, 0.0);
    describe(torque_, "Motor torque", "Most that the motor turns with, in N m; 0: no motor");
    torque_.setRange(0.0, 1e6, 1.0);
    torque_.setSkewFactorFromMidPoint(1e3);
    torque_.setTextValueSuffix(" N m");
    for (auto* slider : {&speed_, &torque_})
        onSlide(*slider, [this](bool continuesEdit) {
            edit("Motor",
                 driven(model_.world().drawing(), drivenJoint_, {speed_.getValue(), torque_.getValue()},
                        model_.world().posesNow()),
                 continuesEdit);
        });
    describe(spring_, "Stiffness of the spring",
             "How fast the spring lets its bodies swing, in Hz; they return to their start");
    spring_.setRange(0.1, 20.0, 0.1);
    spring_.setSkewFactorFromMidPoint(2.0);
    spring_.setTextValueSuffix(" Hz");
    onSlide(spring_, [this](bool continuesEdit) {
        edit("Spring", sprung(model_.world().drawing(), springJoint_, spring_.getValue()), continuesEdit);
    });
    describe(belt_, "Belt speed", "Speed of the conveyor belt, in m/s, on top to the right");
    belt_.setRange(-20.0, 20.0, 0.1);
    belt_.setTextValueSuffix(" m/s");
    slides(belt_, "Belt speed", [](BodyDescription& b, double speed) {
        constexpr double still = 0.01; // with 0 it would be a wall
        b.velocityMetresPerSecond.x = speed == 0.0 ? still : speed;
    });
    new_.onClick = [this] { askMaterial(*this, model_, pane_.material(), true, give_); };
    material_ = quietButton({}, "Material of what is chosen");
    material_->setTooltip("The material: name, colour, copy, figures, recording");
    material_->onClick = [this] {
        const auto* body =
            pane_.chosen().empty() ? nullptr : model_.world().drawing().find(pane_.chosen()[0]);
        if (body != nullptr) editMaterial(*material_, true, model_, body->fixtures[0].material, give_, page_);
    };
    addAll(*this, {&new_, material_.get(), &name_, &moves_, &source_, &densityName_, &density_, &bounceName_,
                   &bounce_, &speedName_, &speed_, &torqueName_, &torque_, &springName_, &spring_, &beltName_,
                   &belt_});
}

BodyPanel::~BodyPanel() = default;

void BodyPanel::show() {
    const auto& chosen = pane_.chosen();
    const auto* body = chosen.empty() ? nullptr : model_.world().drawing().find(chosen[0]);
    setVisible(body != nullptr && pane_.tool() != DrawTool::hand);
    if (body == nullptr) return;
    const Scene& scene = model_.world().drawing().drawn();
    const auto* motor = chosen.size() == 1 ? motorOf(scene, chosen[0]) : nullptr;
    drivenJoint_ = motor ? motor->name : std::string{};
    physvib::setVisible({&speedName_, &speed_, &torqueName_, &torque_}, motor != nullptr);
    if (motor && !speed_.isMouseButtonDown() && !torque_.isMouseButtonDown()) {
        speed_.setValue(driveOf(*motor).radiansPerSecond, juce::dontSendNotification);
        torque_.setValue(driveOf(*motor).maxTorqueNewtonMetres, juce::dontSendNotification);
    }
    const auto* spring = chosen.size() == 1 ? springOf(scene, chosen[0]) : nullptr;
    springJoint_ = spring ? spring->name : std::string{};
    physvib::setVisible({&springName_, &spring_}, spring != nullptr);
    if (spring && !spring_.isMouseButtonDown())
        spring_.setValue(springHzOf(*spring), juce::dontSendNotification);
    const double belt = body->velocityMetresPerSecond.x;
    physvib::setVisible({&beltName_, &belt_},
                        chosen.size() == 1 && body->type == BodyType::staticBody && belt != 0.0);
    if (!belt_.isMouseButtonDown()) belt_.setValue(belt, juce::dontSendNotification);
    const auto differ = [&](auto what) {
        return std::ranges::any_of(chosen, [&](const std::string& name) {
            const auto* other = model_.world().drawing().find(name);
            return other != nullptr && what(*other) != what(*body);
        });
    };
    const auto bounceOf = [&scene](const BodyDescription& b) {
        const auto& f = b.fixtures[0];
        return f.restitution.value_or(nth(scene.materials, f.material).restitution);
    };
    const auto marked = [](const char* words, bool isMarked) {
        return words + (isMarked ? " " + juce::String::charToString(0x2260) : juce::String{}); // not equal
    };
    densityName_.setText(marked("density", differ([&](const auto& b) { return densityOf(scene, b); })),
                         juce::dontSendNotification);
    bounceName_.setText(marked("bounce", differ(bounceOf)), juce::dontSendNotification);
    // ticked if all bodies that can have the property have it; otherwise a press gives it to them
    const auto tick = [&](juce::ToggleButton& button, const char* words, auto can, auto is) {
        int all = 0, are = 0;
        for (const std::string& name : chosen)
            if (const auto* b = model_.world().drawing().find(name); b != nullptr && can(*b))
                ++all, are += is(*b) ? 1 : 0;
        button.setToggleState(all > 0 && are == all, juce::dontSendNotification);
        button.setButtonText(marked(words, are > 0 && are < all));
    };
    tick(
        moves_, "moves",
        [](const BodyDescription& b) {
            return !std::holds_alternative<ChainShape>(b.fixtures[0].shape); // a line stays where it is
        },
        [](const BodyDescription& b) { return b.type == BodyType::dynamicBody; });
    tick(
        source_, "haptic source", [&scene](const BodyDescription& b) { return vibrates(scene, b); },
        isSource);
    const bool isMixed = differ([](const auto& b) { return b.fixtures[0].material; });
    const auto material = isMixed ? juce::String{"several materials"}
                                  : utf8(nth(scene.materials, body->fixtures[0].material).name);
    if (std::exchange(shown_, scene.materials) != scene.materials) {
        materials_.clear();
        for (int i = 0; i < static_cast<int>(shown_.size()); ++i) {
            auto& swatch = *materials_.emplace_back(
                std::make_unique<MaterialSwatch>(nth(shown_, i), palette::material(shown_, i)));
            describe(swatch, "Made of " + swatch.getName(),
                     swatch.getName() + ": what is chosen is made of it");
            swatch.onClick = [this, i] { give_(i); };
            swatch.onEdit = [this, i](MaterialSwatch& from, bool isMenu) {
                editMaterial(from, isMenu, model_, i, give_, page_);
            };
            addAndMakeVisible(swatch);
            prepareControls(swatch);
        }
        resized();
    }
    for (int i = 0; auto& swatch : materials_)
        swatch->setToggleState(i++ == body->fixtures[0].material && !isMixed, juce::dontSendNotification);
    name_.setText(chosen.size() == 1 ? utf8(chosen[0])
                                     : juce::String{static_cast<int>(chosen.size())} + " bodies",
                  juce::dontSendNotification);
    material_->setButtonText(material);
    material_->setEnabled(!isMixed);
    if (!density_.isMouseButtonDown()) density_.setValue(densityOf(scene, *body), juce::dontSendNotification);
    if (!bounce_.isMouseButtonDown()) bounce_.setValue(bounceOf(*body), juce::dontSendNotification);
}

// What goes together stays in one line; in a narrow panel a slider has a line of its own.
int BodyPanel::flow(int width, bool places) {
    constexpr int nameWide = 94, materialWide = 100, widerMaterial = 114, movesWide = 80, sourceWide = 118,
                  markWide = 18, captionWide = 58, swatchWide = 28, between = 4;
    const int right = width - edge;
    int x = edge, y = edge;
    const auto put = [&](std::initializer_list<std::pair<juce::Component*, int>> parts) {
        int wanted = 0;
        for (const auto& [part, wide] : parts) wanted += wide;
        if (!parts.begin()->first->isVisible()) return;
        if (x > edge && x + wanted > right) x = edge, y += rowHigh;
        for (const auto& [part, wide] : parts) {
            if (places) part->setBounds(juce::Rectangle<int>{x, y, wide, rowHigh}.reduced(0, 1));
            x += wide;
        }
        x += between;
    };
    put({{&name_, nameWide}, {material_.get(), width > 2 * wide ? materialWide : widerMaterial}});
    // marked buttons (the bodies differ) are wider, and each has a line of its own
    const auto marks = [](const juce::Button& button) { return button.getButtonText().containsChar(0x2260); };
    if (marks(moves_) || marks(source_)) {
        put({{&moves_, movesWide + markWide}});
        put({{&source_, sourceWide + markWide}});
    } else
        put({{&moves_, movesWide}, {&source_, sourceWide}});
    for (auto& swatch : materials_) // the button for a new material stays beside the last swatch
        if (swatch != materials_.back())
            put({{swatch.get(), swatchWide}}), x -= between;
        else
            put({{swatch.get(), swatchWide}, {&new_, swatchWide}});
    const int barWide = width > 2 * wide ? 112 : right - edge - captionWide;
    for (const auto& [label, slider] : {std::pair{&densityName_, &density_},
                                        {&bounceName_, &bounce_},
                                        {&speedName_, &speed_},
                                        {&torqueName_, &torque_},
                                        {&springName_, &spring_},
                                        {&beltName_, &belt_}})
        put({{label, captionWide}, {slider, barWide}});
    return y + rowHigh + edge;
}

MaterialPalette::MaterialPalette(MixerModel& model, DrawPane& pane, const MaterialPage& page)
    : model_{model}
    , pane_{pane}
    , page_{page} {
    setTitle("Materials to draw with");
    setInterceptsMouseClicks(false, true);
    describe(count_, "Balls of a rain", "How many balls a rain has");
    for (const int count : {10, 20, 50, 100, 200, 500, 1000})
        count_.addItem(juce::String{count} + " balls", count);
    count_.onChange = [this] { pane_.setRainCount(count_.getSelectedId()); };
    describe(way_, "How the rain comes", "All at once, ball by ball, or upwards from one place");
    for (int id = 1; const auto& way : rainPatterns)
        way_.addItem(way.perSecond == 0
                         ? juce::String{"at once"}
                         : (way.isFountain ? "fountain, " : "") + juce::String{way.perSecond} + " a second",
                     id++);
    way_.onChange = [this] {
        if (const int k = way_.getSelectedItemIndex(); k >= 0) pane_.setRainPattern(nth(rainPatterns, k));
    };
    new_.onClick = [this] { askMaterial(*this, model_, pane_.material(), true, use_); };
    edit_.setButtonText("Edit" + dots());
    describe(edit_, "Edit the material", "The chosen material: name, colour, copy, figures, recording");
    edit_.onClick = [this] { editMaterial(edit_, true, model_, pane_.material(), use_, page_); };
    addAll(*this, {&new_, &edit_, &name_});
    addHidden(*this, {&count_, &way_});
}

MaterialPalette::~MaterialPalette() = default;

void MaterialPalette::show() {
    const Scene& scene = model_.world().drawing().drawn();
    const auto& materials = scene.materials;
    const bool areOther = shown_ != materials;
    if (areOther) {
        shown_ = materials;
        swatches_.clear();
        for (int i = 0; i < static_cast<int>(materials.size()); ++i) {
            auto& swatch = *swatches_.emplace_back(
                std::make_unique<MaterialSwatch>(nth(materials, i), palette::material(materials, i)));
            swatch.onClick = [this, i] { use_(i); };
            swatch.onEdit = [this, i](MaterialSwatch& from, bool isMenu) {
                editMaterial(from, isMenu, model_, i, use_, page_);
            };
            // a material that makes no sound reports it elsewhere
            swatch.onEnter = [this, i] { model_.strikes().audition(i, 0.5, 0.5); };
            addAndMakeVisible(swatch);
            prepareControls(swatch); // it is created after the other controls
        }
    }
    if (areOther || surfaces_ != surfacesOf(scene)) {
        surfaces_ = surfacesOf(scene);
        for (int i = 0; i < static_cast<int>(swatches_.size()); ++i)
            nth(swatches_, i)->setWhy(whyNotFelt(scene, i));
        resized();
    }
    count_.setSelectedId(pane_.rainCount(), juce::dontSendNotification);
    way_.setSelectedItemIndex(
        static_cast<int>(std::ranges::find(rainPatterns, pane_.rainPattern()) - rainPatterns.begin()),
        juce::dontSendNotification);
    physvib::setVisible({&count_, &way_}, pane_.tool() == DrawTool::rain);
    for (int i = 0; i < static_cast<int>(swatches_.size()); ++i) {
        auto& swatch = *nth(swatches_, i);
        swatch.setToggleState(i == pane_.material(), juce::dontSendNotification);
        if (i == pane_.material()) name_.setText(swatch.getName(), juce::dontSendNotification);
    }
    placeName();
}

// Selection and tool move no swatch, because the pointer may be on its way to one.
void MaterialPalette::resized() {
    constexpr int between = 4, countWide = 106, wayWide = 150, newWide = 28, editWide = 52;
    auto area = getLocalBounds();
    way_.setBounds(area.removeFromRight(wayWide));
    count_.setBounds(area.removeFromRight(countWide + between).withTrimmedRight(between));
    int named = newWide + between + editWide;
    for (const auto& swatch : swatches_) named += swatch->namedWide() + between;
    const bool areNamed = named <= area.getWidth();
    for (auto& swatch : swatches_) {
        swatch->setBounds(area.removeFromLeft(areNamed ? swatch->namedWide() : MaterialSwatch::pictureWide));
        area.removeFromLeft(between);
    }
    new_.setBounds(area.removeFromLeft(newWide));
    edit_.setVisible(area.getWidth() >= between + editWide); // else by a double click on a swatch
    edit_.setBounds(area.withTrimmedLeft(between).removeFromLeft(editWide));
    placeName();
}

// The name uses the space of the rain's lists while they are hidden; it is shown only if it fits whole.
void MaterialPalette::placeName() {
    constexpr int edges = 12;
    name_.setBounds(getLocalBounds()
                        .withLeft((edit_.isVisible() ? edit_.getRight() : new_.getRight()) + edges)
                        .withRight(count_.isVisible() ? count_.getX() : getWidth()));
    const bool areNamed = !swatches_.empty() && swatches_.front()->getWidth() > MaterialSwatch::pictureWide;
    name_.setVisible(!areNamed && text::pixels(name_.getFont(), name_.getText()) + edges <= name_.getWidth());
}

} // namespace physvib

// SPDX-License-Identifier: GPL-3.0-or-later
// Draws icons, texts, dividers and spectra, computes the levels of spectra, and arranges tabs.
#include "Mixer/Widgets/MixerWidgets.h"
#include "Core/Units.h"
#include "Host/Views/WorldView.h"
#include "Measure/Spectrum.h"
#include <numbers>

namespace physvib {
namespace {

juce::Path iconPath(Icon icon) {
    juce::Path path, line;
    switch (icon) {
    case Icon::play: path.addTriangle(-4.0f, -6.0f, -4.0f, 6.0f, 6.0f, 0.0f); break;
    case Icon::pause:
        path.addRectangle(-5.0f, -6.0f, 3.5f, 12.0f);
        path.addRectangle(1.5f, -6.0f, 3.5f, 12.0f);
        break;
    case Icon::step:
        path.addTriangle(-6.0f, -5.5f, -6.0f, 5.5f, 2.0f, 0.0f);
        path.addRectangle(3.5f, -5.5f, 2.5f, 11.0f);
        break;
    case Icon::restart:
        line.addCentredArc(0.0f, 0.0f, 5.5f, 5.5f, 0.0f, -2.2f, 2.6f, true);
        juce::PathStrokeType{2.0f}.createStrokedPath(path, line);
        path.addTriangle(-8.2f, -1.0f, -1.6f, -2.2f, -5.6f, -7.0f);
        break;
    case Icon::save: // down into a tray
        path.addRectangle(-1.0f, -7.0f, 2.0f, 7.0f);
        path.addTriangle(-4.5f, -1.5f, 4.5f, -1.5f, 0.0f, 3.5f);
        path.addRectangle(-7.0f, 5.0f, 14.0f, 2.0f);
        break;
    case Icon::undo:
    case Icon::redo:
        line.addCentredArc(0.5f, 1.5f, 5.5f, 4.5f, 0.0f, -1.3f, 2.6f, true);
        juce::PathStrokeType{2.0f}.createStrokedPath(path, line);
        path.addTriangle(-8.0f, 0.5f, -1.0f, 1.5f, -6.5f, -5.5f);
        if (icon == Icon::redo) path.applyTransform(juce::AffineTransform::scale(-1.0f, 1.0f));
        break;
    case Icon::plus:
        path.addRectangle(-6.0f, -1.0f, 12.0f, 2.0f);
        path.addRectangle(-1.0f, -6.0f, 2.0f, 12.0f);
        break;
    case Icon::sweep: // a wave of rising frequency
        line.startNewSubPath(-9.0f, 0.0f);
        for (int k = 1; k <= 54; ++k) {
            const float t = static_cast<float>(k) / 54.0f;
            line.lineTo(-9.0f + 18.0f * t,
                        -4.5f * std::sin(juce::MathConstants<float>::twoPi * (0.7f * t + 2.0f * t * t)));
        }
        juce::PathStrokeType{1.6f}.createStrokedPath(path, line);
    }
    return path;
}

/// Hann window (Oppenheim and Schafer 7.2); its sum is half its length.
const std::vector<double>& hannWindow() {
    static const std::vector<double> weights = [] {
        std::vector<double> w(SpectrumTrace::windowSize);
        for (std::size_t i = 0; i < w.size(); ++i)
            w[i] = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) /
                                        static_cast<double>(w.size()));
        return w;
    }();
    return weights;
}

constexpr int scrollBarWidth = 12;         // with the gap beside it
constexpr int maxMargin = 60, maxCut = 14; // pixels that a name's width grows, or shrinks in a narrow panel

int tabNameWidth(const juce::String& name) {
    return text::pixelWidth(text::font(text::medium, juce::Font::bold), name) + 6;
}

} // namespace

IconButton::IconButton(Icon icon, const juce::String& name)
    : juce::Button{name}
    , icon_{icon} {
    setIcon(icon, name);
}

void IconButton::setIcon(Icon icon, const juce::String& name) {
    if (icon == icon_ && name == getTitle()) return;
    icon_ = icon;
    describe(*this, name, name);
    repaint();
}

void IconButton::paintButton(juce::Graphics& g, bool isOver, bool isDown) {
    getLookAndFeel().drawButtonBackground(g, *this, {}, isOver, isDown);
    const bool isQuiet = getProperties()[quietProperty];
    g.setColour(shade(*this, !isEnabled()       ? Shade::muted
                             : getToggleState() ? Shade::well
                             : isQuiet          ? Shade::accent
                                                : Shade::text));
    g.fillPath(iconPath(icon_), juce::AffineTransform::translation(getLocalBounds().toFloat().getCentre()));
}

void TwoLineText::set(const juce::String& first, const juce::String& second, Shade firstShade) {
    if (first == first_ && second == second_ && firstShade == shade_) return;
    first_ = first;
    second_ = second;
    shade_ = firstShade;
    setDescription(first + ", " + second);
    repaint();
}

void TwoLineText::paint(juce::Graphics& g) {
    auto area = getLocalBounds();
    const auto font = text::font(text::small);
    const auto line = [&](const juce::String& label, juce::Rectangle<int> row, Shade tone) {
        g.setColour(shade(*this, tone));
        g.setFont(font);
        g.drawText(label, row, juce::Justification::centredLeft, true);
    };
    const bool isLow = 0.5f * static_cast<float>(getHeight()) < font.getHeight();
    line(first_,
         isLow ? area.removeFromLeft(text::pixelWidth(font, first_) + gap)
               : area.removeFromTop(getHeight() / 2),
         shade_);
    line(second_, area, Shade::muted);
}

void drawPanel(juce::Graphics& g, const juce::Component& component) {
    fillRound(g, component, Shade::panel, component.getLocalBounds().toFloat(), 8.0f);
}

void drawCard(juce::Graphics& g, const juce::Component& component) {
    const auto area = component.getLocalBounds().toFloat();
    g.setColour(shade(component, Shade::panel)); // pressed buttons stand out on it
    g.fillRoundedRectangle(area, 12.0f);
    g.setColour(shade(component, Shade::accent));
    g.drawRoundedRectangle(area.reduced(0.75f), 12.0f, 1.5f);
}

std::unique_ptr<juce::TextButton> makeLinkButton(const juce::String& label, const juce::String& name,
                                                 std::function<void()> onClick) {
    auto button = std::make_unique<juce::TextButton>(label);
    describe(*button, name, name);
    button->onClick = std::move(onClick);
    button->getProperties().set(quietProperty, true);
    return button;
}

double typedNumber(const juce::String& typed, bool isWhole) {
    const auto digits = typed.retainCharacters("-0123456789.,");
    const bool hasThousands = isWhole || digits.containsChar('.');
    return (hasThousands ? digits.removeCharacters(",") : digits.replaceCharacter(',', '.')).getDoubleValue();
}

void onSliderChange(juce::Slider& slider, std::function<void(bool)> onChange) {
    if (!slider.valueFromTextFunction)
        slider.valueFromTextFunction = [&slider](const juce::String& typed) {
            return typedNumber(typed, slider.getInterval() >= 1.0);
        };
    const auto isFirst = std::make_shared<bool>(true);
    slider.onDragStart = [isFirst] { *isFirst = true; };
    slider.onValueChange = [&slider, isFirst, onChange = std::move(onChange)] {
        onChange(slider.isMouseButtonDown() && !std::exchange(*isFirst, false));
    };
}

void prepareControls(juce::Component& root) {
    auto* slider = dynamic_cast<juce::Slider*>(&root);
    if (slider != nullptr) slider->setWantsKeyboardFocus(true);
    if (auto* editor = dynamic_cast<juce::TextEditor*>(&root); editor != nullptr && !editor->isMultiLine())
        editor->setJustification(juce::Justification::centredLeft); // in the middle of its height
    // disabled controls are included
    const bool isBox = dynamic_cast<juce::ComboBox*>(&root) != nullptr;
    const bool isControl = slider != nullptr || isBox || root.getWantsKeyboardFocus() ||
                           dynamic_cast<juce::Button*>(&root) != nullptr;
    if (isControl && root.getParentComponent() != nullptr) root.setHasFocusOutline(true);
    if (slider == nullptr && !isBox) // these handle their own children
        for (auto* child : root.getChildren()) prepareControls(*child);
}

Caption::Caption(const juce::String& caption, Shade tone)
    : tone_{tone} {
    setText(caption, dontNotify);
    setFont(text::font(text::small));
    setBorderSize({0, 0, 0, 0});
}

void addAll(juce::Component& parent, std::initializer_list<juce::Component*> children) {
    for (auto* child : children) parent.addAndMakeVisible(child);
}
void addHidden(juce::Component& parent, std::initializer_list<juce::Component*> children) {
    for (auto* child : children) parent.addChildComponent(child);
}
void setVisible(std::initializer_list<juce::Component*> components, bool areVisible) {
    for (auto* component : components) component->setVisible(areVisible);
}

AttachButton::AttachButton(MixerModel& model, const juce::String& title, const juce::String& tooltip)
    : juce::Button{title} {
    describe(*this, title, tooltip);
    onClick = [&model] { model.attach(0.5, 0.5); };
}

void AttachButton::mouseDrag(const juce::MouseEvent& e) {
    auto* container = juce::DragAndDropContainer::findParentDragContainerFor(this);
    if (container == nullptr || container->isDragAndDropActive() || e.getDistanceFromDragStart() < 6) return;
    setState(buttonNormal);
    container->startDragging(WorldView::newActuatorDrag, this);
}

Divider::Divider(const juce::String& title, bool isVertical)
    : isVertical_{isVertical} {
    describe(*this, title, title + ": drag it; double click: automatic");
    setWantsKeyboardFocus(true);
    setMouseClickGrabsKeyboardFocus(false); // the world keeps its keys
    setHasFocusOutline(true);
    setMouseCursor(isVertical ? juce::MouseCursor::LeftRightResizeCursor
                              : juce::MouseCursor::UpDownResizeCursor);
}

bool Divider::keyPressed(const juce::KeyPress& key) {
    using juce::KeyPress;
    constexpr int stepPixels = 16;
    const auto decreaseKey = isVertical_ ? KeyPress::leftKey : KeyPress::upKey,
               increaseKey = isVertical_ ? KeyPress::rightKey : KeyPress::downKey;
    if (key == decreaseKey || key == increaseKey)
        return onMove(key == increaseKey ? stepPixels : -stepPixels), true;
    if (key == KeyPress::backspaceKey) return onReset(), true;
    return false;
}

void Divider::paint(juce::Graphics& g) {
    g.setColour(shade(*this, isMouseOverOrDragging() ? Shade::accent : Shade::muted));
    constexpr float length = 36.0f, thickness = 3.0f;
    const auto handle = getLocalBounds().toFloat().withSizeKeepingCentre(isVertical_ ? thickness : length,
                                                                         isVertical_ ? length : thickness);
    g.fillRoundedRectangle(handle, 1.5f);
}

// The divider follows the mouse, so the distance is counted from its current place.
void Divider::mouseDrag(const juce::MouseEvent& e) {
    const auto movedBy = e.position - e.mouseDownPosition;
    onMove(juce::roundToInt(isVertical_ ? movedBy.x : movedBy.y));
}

double FrequencyAxis::shareFromHz(double hz) {
    return std::log(std::max(hz, 1e-3) / lowHz) / std::log(highHz / lowHz);
}
SpectrumLevels toSpectrumLevels(std::span<const double> magnitudes, double binHz, double fullScale) {
    SpectrumLevels levels;
    const double halfStep = 0.5 / (FrequencyAxis::pointCount - 1),
                 lastBin = static_cast<double>(magnitudes.size()) - 1.0;
    for (int k = 0; k < FrequencyAxis::pointCount; ++k) {
        const double share = static_cast<double>(k) / (FrequencyAxis::pointCount - 1);
        const double fromBin = FrequencyAxis::hzFromShare(share - halfStep) / binHz,
                     toBin = std::min(lastBin, FrequencyAxis::hzFromShare(share + halfStep) / binHz);
        const auto magnitudeAt = [&](double bin) { // at low frequencies the points are denser than the bins
            const auto i = static_cast<std::size_t>(bin);
            return i + 1 < magnitudes.size()
                       ? std::lerp(magnitudes[i], magnitudes[i + 1], bin - static_cast<double>(i))
                       : 0.0;
        };
        double maxMagnitude = std::max(magnitudeAt(fromBin), magnitudeAt(toBin));
        for (auto i = static_cast<std::size_t>(std::ceil(fromBin)); i <= static_cast<std::size_t>(toBin); ++i)
            maxMagnitude = std::max(maxMagnitude, magnitudes[i]);
        const double db = toDecibels(std::max(maxMagnitude / fullScale, 1e-9));
        nth(levels, k) = std::max(FrequencyAxis::floorDb, static_cast<float>(db));
    }
    return levels;
}

juce::Rectangle<int> drawFrequencyAxis(juce::Graphics& g, const juce::Component& component,
                                       juce::Rectangle<int> area) {
    const auto foot = area.removeFromBottom(16);
    g.setFont(text::font(text::small));
    for (const int hz : {20, 50, 100, 200, 500, 1000}) {
        const int x = area.getX() + juce::roundToInt(FrequencyAxis::shareFromHz(hz) * (area.getWidth() - 1));
        g.setColour(shade(component, Shade::line).withMultipliedAlpha(0.7f));
        g.drawVerticalLine(x, static_cast<float>(area.getY()), static_cast<float>(area.getBottom()));
        g.setColour(shade(component, Shade::muted));
        const auto label = hz == 1000 ? juce::String{"1k"} : juce::String{hz};
        const auto alignment = hz == 20     ? juce::Justification::centredLeft
                               : hz == 1000 ? juce::Justification::centredRight
                                            : juce::Justification::centred;
        g.drawText(label,
                   juce::Rectangle<int>{40, foot.getHeight()}
                       .withCentre({x, foot.getCentreY()})
                       .constrainedWithin(foot),
                   alignment, false);
    }
    return area;
}

void drawSpectrum(juce::Graphics& g, std::span<const float, FrequencyAxis::pointCount> heights,
                  juce::Rectangle<float> area, juce::Colour colour) {
    juce::Path curve, ground;
    ground.startNewSubPath(area.getBottomLeft());
    for (std::size_t k = 0; k < heights.size(); ++k) {
        const juce::Point<float> point{area.getX() + area.getWidth() * static_cast<float>(k) /
                                                         static_cast<float>(heights.size() - 1),
                                       area.getBottom() - area.getHeight() * heights[k]};
        k == 0 ? curve.startNewSubPath(point) : curve.lineTo(point);
        ground.lineTo(point);
    }
    ground.lineTo(area.getBottomRight());
    ground.closeSubPath();
    g.setColour(colour.withAlpha(0.14f));
    g.fillPath(ground);
    g.setColour(colour);
    g.strokePath(curve, juce::PathStrokeType{1.5f});
}

SpectrumLevels channelSpectrum(const SpectrumTrace& trace, int channel) {
    auto samples = trace.windowSamples(channel);
    if (samples.empty()) {
        SpectrumLevels none;
        none.fill(FrequencyAxis::floorDb);
        return none;
    }
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] *= hannWindow()[i];
    const auto spectrum = magnitudes(samples);
    // a full-scale sine gives half of the weights' sum, which is half of the window's size
    return toSpectrumLevels(spectrum, 0.5 * trace.rateHz() / static_cast<double>(spectrum.size() - 1),
                            0.25 * SpectrumTrace::windowSize);
}

class TabPanel::TabButton final : public juce::Button {
public:
    explicit TabButton(const juce::String& name)
        : juce::Button{name} {
        setTitle(name);
        setRadioGroupId(1); // choose() alone toggles it: JUCE would click the one before, and fold the panel
    }
    void paintButton(juce::Graphics& g, bool isOver, bool) override {
        const bool isChosen = isOpen && getToggleState();
        auto area = getLocalBounds();
        if (isVertical) {
            g.addTransform(juce::AffineTransform::rotation(juce::MathConstants<float>::halfPi)
                               .translated(static_cast<float>(getWidth()), 0.0f));
            area = {getHeight(), getWidth()};
        }
        setInk(g, *this, isChosen || isOver ? Shade::text : Shade::muted, text::medium,
               isChosen ? juce::Font::bold : juce::Font::plain);
        g.drawText(getName(), area.withTrimmedBottom(isOpen ? 4 : 0), juce::Justification::centred, false);
        g.setColour(isChosen && !hasKeyboardFocus(false) ? shade(*this, Shade::accent)
                                                         : juce::Colours::transparentBlack);
        g.fillRect(area.removeFromBottom(2));
    }
    bool isOpen = true, isVertical = false;
};

TabPanel::TabPanel(const juce::String& title) { setTitle(title); }
TabPanel::~TabPanel() = default;

void TabPanel::add(const juce::String& name, std::unique_ptr<Tab> tab) {
    auto button = std::make_unique<TabButton>(name);
    button->onClick = [this, name, index = pages_.size()] {
        index == selectedPage_&& fold_ == Fold::none&& onOpen ? onOpen(false) : choose(name);
    };
    addAndMakeVisible(*button);
    auto viewport = std::make_unique<juce::Viewport>();
    viewport->setViewedComponent(tab.get(), false);
    viewport->setScrollBarsShown(true, false);
    tab->setVisible(false); // tabs are visible only while they are selected
    viewport->setScrollBarThickness(8);
    addChildComponent(*viewport);
    pages_.push_back({std::move(button), std::move(tab), std::move(viewport), 0});
    if (pages_.size() == 1) choose(name);
}

void TabPanel::choose(const juce::String& name) {
    for (std::size_t i = 0; i < pages_.size(); ++i) {
        const bool isChosen = pages_[i].button->getName() == name;
        if (isChosen) selectedPage_ = i;
        pages_[i].button->setToggleState(isChosen, dontNotify);
    }
    setFold(fold_);
    if (onOpen) onOpen(true);
}

void TabPanel::setFold(Fold fold) {
    fold_ = fold;
    for (std::size_t i = 0; i < pages_.size(); ++i) {
        const bool isShown = i == selectedPage_ && fold == Fold::none;
        pages_[i].viewport->setVisible(isShown);
        pages_[i].tab->setVisible(isShown);
        pages_[i].button->isOpen = fold == Fold::none;
        pages_[i].button->isVertical = fold == Fold::column;
        pages_[i].button->repaint();
    }
    resized();
}

juce::StringArray TabPanel::names() const {
    juce::StringArray all;
    for (const auto& page : pages_) all.add(page.button->getName());
    return all;
}

void TabPanel::refresh(const MixerSnapshot& snapshot) {
    if (selectedPage_ >= pages_.size() || fold_ != Fold::none) return;
    const auto& page = pages_[selectedPage_];
    page.tab->refresh(snapshot);
    if (page.tab->minHeight(page.viewport->getWidth()) != page.minHeight) resized(); // it says more, or less
}

void TabPanel::resized() {
    if (pages_.empty()) return;
    const bool isColumn = fold_ == Fold::column;
    auto area = isColumn ? getLocalBounds().reduced(0, panelInset)
                         : getLocalBounds().reduced(panelInset, fold_ == Fold::row ? 0 : 8);
    auto names = isColumn ? area : area.removeFromTop(32);
    int remaining = isColumn ? names.getHeight() : names.getWidth();
    for (auto& page : pages_) remaining -= tabNameWidth(page.button->getName());
    remaining = juce::jlimit(-maxCut, isColumn ? 24 : maxMargin, remaining / static_cast<int>(pages_.size()));
    if (isColumn) {
        for (auto& page : pages_)
            page.button->setBounds(names.removeFromTop(tabNameWidth(page.button->getName()) + remaining));
        return;
    }
    for (auto& page : pages_)
        page.button->setBounds(names.removeFromLeft(tabNameWidth(page.button->getName()) + remaining)
                                   .withTrimmedRight(std::max(0, remaining / 3)));
    if (fold_ == Fold::row) return;
    area.removeFromTop(10);
    for (auto& page : pages_) {
        page.viewport->setBounds(area);
        page.minHeight = page.tab->minHeight(area.getWidth());
        const int room = page.minHeight > area.getHeight() ? scrollBarWidth : 0;
        page.tab->setSize(area.getWidth() - room,
                          std::max(area.getHeight(), page.tab->minHeight(area.getWidth() - room)));
    }
}

} // namespace physvib

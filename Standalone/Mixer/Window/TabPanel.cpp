// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the tab names, with a line below the selected one.
#include "Mixer/Window/TabPanel.h"

namespace physvib {

namespace {

constexpr int barRoom = 12;                  // of the scroll bar, and beside it
constexpr int widestRest = 60, mostCut = 14; // margin beside a name, and what a narrow panel takes from it

int widthOf(const juce::String& name) {
    return juce::Font{text::medium, juce::Font::bold}.getStringWidth(name) + 6;
}

} // namespace

class TabPanel::Name final : public juce::Button {
public:
    explicit Name(const juce::String& name)
        : juce::Button{name} {
        setTitle(name);
        setRadioGroupId(1);
        setClickingTogglesState(true);
    }
    void paintButton(juce::Graphics& g, bool isOver, bool) override {
        const bool isChosen = getToggleState();
        g.setColour(shade(*this, isChosen || isOver ? Shade::text : Shade::muted));
        g.setFont(juce::Font{text::medium, isChosen ? juce::Font::bold : juce::Font::plain});
        g.drawText(getName(), getLocalBounds().withTrimmedBottom(4), juce::Justification::centred, false);
        g.setColour(isChosen ? shade(*this, Shade::accent) : juce::Colours::transparentBlack);
        g.fillRect(getLocalBounds().removeFromBottom(2));
    }
};

TabPanel::TabPanel(const juce::String& title) { setTitle(title); }
TabPanel::~TabPanel() = default;

void TabPanel::add(const juce::String& name, std::unique_ptr<Tab> tab) {
    auto button = std::make_unique<Name>(name);
    button->onClick = [this, name] { choose(name); };
    addAndMakeVisible(*button);
    auto view = std::make_unique<juce::Viewport>();
    view->setViewedComponent(tab.get(), false);
    view->setScrollBarsShown(true, false);
    tab->setVisible(false); // tabs tell by their visibility whether they are chosen
    view->setScrollBarThickness(8);
    addChildComponent(*view);
    pages_.push_back({std::move(button), std::move(tab), std::move(view), 0});
    if (pages_.size() == 1) choose(name);
}

void TabPanel::choose(const juce::String& name) {
    for (std::size_t i = 0; i < pages_.size(); ++i) {
        const bool isChosen = pages_[i].name->getName() == name;
        if (isChosen) chosen_ = i;
        pages_[i].name->setToggleState(isChosen, juce::dontSendNotification);
        pages_[i].view->setVisible(isChosen);
        pages_[i].tab->setVisible(isChosen);
    }
    resized();
}

juce::StringArray TabPanel::names() const {
    juce::StringArray all;
    for (const auto& page : pages_) all.add(page.name->getName());
    return all;
}

Tab* TabPanel::find(const juce::String& name) const {
    for (const auto& page : pages_)
        if (page.name->getName() == name) return page.tab.get();
    return nullptr;
}

void TabPanel::takeMix() {
    for (auto& page : pages_) page.tab->takeMix();
}

void TabPanel::refresh(const DeskMoment& moment) {
    if (chosen_ >= pages_.size()) return;
    const auto& page = pages_[chosen_];
    page.tab->refresh(moment);
    if (page.tab->leastHeight(page.view->getWidth()) != page.least) resized(); // it says more, or less
}

void TabPanel::paint(juce::Graphics& g) { drawPanel(g, *this); }

void TabPanel::resized() {
    auto area = getLocalBounds().reduced(panelInset, 8);
    auto names = area.removeFromTop(32);
    if (pages_.empty()) return;
    int rest = names.getWidth();
    for (auto& page : pages_) rest -= widthOf(page.name->getName());
    rest = juce::jlimit(-mostCut, widestRest, rest / static_cast<int>(pages_.size()));
    for (auto& page : pages_)
        page.name->setBounds(names.removeFromLeft(widthOf(page.name->getName()) + rest)
                                 .withTrimmedRight(std::max(0, rest / 3)));
    area.removeFromTop(10);
    for (auto& page : pages_) {
        page.view->setBounds(area);
        page.least = page.tab->leastHeight(area.getWidth());
        const int room = page.least > area.getHeight() ? barRoom : 0;
        page.tab->setSize(area.getWidth() - room,
                          std::max(area.getHeight(), page.tab->leastHeight(area.getWidth() - room)));
    }
}

} // namespace physvib

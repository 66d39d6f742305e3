// SPDX-License-Identifier: GPL-3.0-or-later
// List of names and values in columns; redraws only on changes.
#pragma once
#include "Host/Views/Look.h"
#include <vector>

namespace physvib {

struct Fact {
    juce::String name, value;
    Shade shade = Shade::text;
    bool operator==(const Fact&) const = default;
};

class FactList final : public juce::Component {
public:
    FactList(const juce::String& title, int columns);

    void set(std::vector<Fact> facts);
    const std::vector<Fact>& facts() const noexcept { return facts_; }
    void paint(juce::Graphics& g) override;
    std::unique_ptr<juce::AccessibilityHandler> createAccessibilityHandler() override {
        return std::make_unique<juce::AccessibilityHandler>(*this, juce::AccessibilityRole::staticText);
    }

private:
    const int columns_;
    std::vector<Fact> facts_;
};

} // namespace physvib

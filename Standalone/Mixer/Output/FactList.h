// SPDX-License-Identifier: GPL-3.0-or-later
// List of names and values in columns, fewer where they are narrow; redraws only on changes.
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
    FactList(const juce::String& title, int mostColumns);

    void set(std::vector<Fact> facts);
    const std::vector<Fact>& facts() const noexcept { return facts_; }
    int heightFor(int width) const; ///< at which all of it is seen
    void paint(juce::Graphics& g) override;
    std::unique_ptr<juce::AccessibilityHandler> createAccessibilityHandler() override {
        return std::make_unique<juce::AccessibilityHandler>(*this, juce::AccessibilityRole::staticText);
    }

private:
    struct Places {
        int columns = 1, nameWidth = 0, rows = 0, lines = 0; // lines: of the highest column
        std::vector<int> linesOf;                            // of each fact
    };
    Places placesIn(int width) const;

    const int mostColumns_;
    std::vector<Fact> facts_;
};

} // namespace physvib

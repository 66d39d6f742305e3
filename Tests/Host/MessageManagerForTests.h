// SPDX-License-Identifier: GPL-3.0-or-later
// JUCE's message manager for all tests of a program, with or without a display.
#pragma once
#include "Host/MessageLoop.h"
#include <gtest/gtest.h>
#include <juce_gui_basics/juce_gui_basics.h>
#include <optional>

namespace physvib::test {

/// From before the first test until after the last one: JUCE's own statics do not outlive those of a program.
class MessageManagerForTests final : public testing::Environment {
public:
    void SetUp() override { initialised_.emplace(); }
    void TearDown() override { initialised_.reset(); }

private:
    std::optional<juce::ScopedJuceInitialiser_GUI> initialised_;
};
inline testing::Environment* const messageManagerForTests =
    testing::AddGlobalTestEnvironment(new MessageManagerForTests);

} // namespace physvib::test

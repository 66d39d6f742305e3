// SPDX-License-Identifier: MIT
// Whether a text holds some words: a check that fails says both.
#pragma once
#include <gtest/gtest.h>
#include <string_view>

namespace physvib {

/// For EXPECT_TRUE(has(text, "words")) and EXPECT_FALSE; of a long text it says the beginning.
inline ::testing::AssertionResult has(std::string_view text, std::string_view words) {
    const bool isThere = text.find(words) != text.npos;
    return (isThere ? ::testing::AssertionSuccess() : ::testing::AssertionFailure())
           << "\"" << words << "\" in: " << text.substr(0, 4000);
}

} // namespace physvib

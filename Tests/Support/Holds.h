// SPDX-License-Identifier: MIT
// Whether a text holds some words, said with both if not.
#pragma once
#include <gtest/gtest.h>
#include <string_view>

namespace physvib {

inline testing::AssertionResult holds(std::string_view text, std::string_view words) {
    return (text.find(words) == std::string_view::npos ? testing::AssertionFailure()
                                                       : testing::AssertionSuccess())
           << '"' << words << "\" in: " << text;
}

} // namespace physvib

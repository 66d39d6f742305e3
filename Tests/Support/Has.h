// SPDX-License-Identifier: MIT
// Whether a text holds some words: a check that fails says both.
#pragma once
#include <gtest/gtest.h>
#include <initializer_list>
#include <string_view>

namespace physvib {

/// For EXPECT_TRUE(has(text, "words")) and EXPECT_FALSE; of a long text it says the beginning.
inline ::testing::AssertionResult has(std::string_view text, std::string_view words) {
    const bool isThere = text.find(words) != text.npos;
    return (isThere ? ::testing::AssertionSuccess() : ::testing::AssertionFailure())
           << "\"" << words << "\" in: " << text.substr(0, 4000);
}

/// All of the words, or the first that is not there.
inline ::testing::AssertionResult hasAll(std::string_view text,
                                         std::initializer_list<std::string_view> words) {
    for (const std::string_view one : words)
        if (auto isThere = has(text, one); !isThere) return isThere;
    return ::testing::AssertionSuccess();
}

/// None of the words, or the first that is there.
inline ::testing::AssertionResult hasNone(std::string_view text,
                                          std::initializer_list<std::string_view> words) {
    for (const std::string_view one : words)
        if (const auto isThere = has(text, one)) return ::testing::AssertionFailure() << isThere.message();
    return ::testing::AssertionSuccess();
}

/// How often the words are in the text.
inline std::size_t timesIn(std::string_view text, std::string_view words) {
    std::size_t times = 0;
    for (auto at = text.find(words); at != text.npos; at = text.find(words, at + words.size())) ++times;
    return times;
}

} // namespace physvib

// SPDX-License-Identifier: MIT
// What a participant reads, in their language: a text for each of the screens' and of the built-in protocols'
// own, which are English.
#pragma once
#include "Io/Result.h"
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// The version of the format that is read.
constexpr int wordsFormatVersion = 1;

struct Words {
    std::string name;                                      ///< "ko"; empty: the English ones
    std::string language;                                  ///< as its speakers call it
    std::map<std::string, std::string, std::less<>> texts; ///< by the English text

    /// The text in this language; one that is not there stays as it is. Any thread.
    const std::string& of(const std::string& english) const {
        const auto found = texts.find(english);
        return found == texts.end() ? english : found->second;
    }
};

/// `{"physvib_words": 1, "name": "ko", "language": "...", "texts": {"Begin": "..."}}`. A {name} of an English
/// text stands in its translation as well. Or, of the first thing that is wrong, one line. Any thread.
Result<Words> readWords(std::string_view text, std::string_view name);

/// Those that come with PhysVib, but for English. Built on first use; any thread.
const std::vector<Words>& builtInWords();

/// Built-in words by their name ("en": English), else those of the file. M only.
Result<Words> findWords(const std::string& nameOrPath);

} // namespace physvib

// SPDX-License-Identifier: MIT
// Translations of the texts for participants: each English text of the screens and built-in protocols, in
// another language.
#pragma once
#include "Io/Result.h"
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Version of the format that can be read.
constexpr int translationFormatVersion = 1;

struct Translation {
    std::string name;        ///< "ko"; empty: English
    std::string language;    ///< its name in that language
    std::string englishName; ///< its name in English, for displays without its letters; may be empty
    std::map<std::string, std::string, std::less<>> texts; ///< by the English text

    /// The translation of a text; the text itself if there is none. Any thread.
    const std::string& translate(const std::string& english) const {
        const auto found = texts.find(english);
        return found == texts.end() ? english : found->second;
    }
};

/// Parses `{"physvib_words": 1, "name": "ko", "language": "...", "texts": {"Begin": "..."}}`; otherwise one
/// line on the first error. A {name} in an English text must be in its translation too. Any thread.
Result<Translation> readTranslation(std::string_view text, std::string_view name);

/// Built-in translations, without English. Created on first use; any thread.
const std::vector<Translation>& builtInTranslations();

/// A built-in translation by name ("en": English), else the one of a file. Message thread only.
Result<Translation> findTranslation(const std::string& nameOrPath);

} // namespace physvib

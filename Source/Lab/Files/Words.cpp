// SPDX-License-Identifier: MIT
// Reads translations, and checks that each has the same placeholders as its English text.
#include "Lab/Files/Words.h"
#include "Io/Disk/Embedded.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Json/JsonText.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/StudyTables.h"
#include "Scene/SceneJson.h"
#include <algorithm>
#include <set>

namespace physvib {

const std::vector<EmbeddedFile>& embeddedWords(); // Source/Lab/Words/*.json, in listing order

namespace {

std::set<std::string> namesIn(const std::string& text) {
    std::set<std::string> names;
    for (std::size_t at = text.find('{'); at != std::string::npos; at = text.find('{', at + 1))
        names.insert(text.substr(at, text.find('}', at) - at));
    return names;
}

Words readWordsRoot(Json& json) {
    const JsonField root{json, {}};
    checkVersion(root, "physvib_words", wordsFormatVersion);
    root.expectObject({"physvib_words", "name", "language", "in_english", "texts"});
    Words words{root["name"].text(),
                root["language"].text(),
                root.has("in_english") ? root["in_english"].text() : root["name"].text(),
                {}};
    root["texts"].expectObject();
    for (const auto& [english, text] : json["texts"].items()) {
        const JsonField field = root["texts"][english.c_str()];
        words.texts.emplace(english, field.text());
        if (namesIn(english) != namesIn(words.texts[english]))
            field.fail("expected the same names in braces as in the English text");
    }
    return words;
}

} // namespace

Result<Words> readWords(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxProtocolFileBytes, readWordsRoot);
}

const std::vector<Words>& builtInWords() {
    static const std::vector<Words> all = readEmbedded(embeddedWords(), readWords);
    return all;
}

Result<Words> findWords(const std::string& nameOrPath) {
    if (isJsonPath(nameOrPath)) return loadText(nameOrPath, limits::maxProtocolFileBytes, readWords);
    if (nameOrPath.empty() || nameOrPath == "en") return Words{};
    const auto& all = builtInWords();
    const auto found = std::ranges::find(all, nameOrPath, &Words::name);
    if (found != all.end()) return *found;
    std::string names = "en";
    for (const Words& words : all) names += ", " + words.name;
    return Failure{"no words " + inQuotes(nameOrPath) + "; expected " + names + " or a file"};
}

} // namespace physvib

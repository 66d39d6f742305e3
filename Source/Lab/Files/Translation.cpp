// SPDX-License-Identifier: MIT
// Reads translations, and checks that each has the same placeholders as its English text.
#include "Lab/Files/Translation.h"
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

std::set<std::string> findNames(const std::string& text) {
    std::set<std::string> names;
    for (std::size_t start = text.find('{'); start != std::string::npos; start = text.find('{', start + 1))
        names.insert(text.substr(start, text.find('}', start) - start));
    return names;
}

Translation readTranslationRoot(Json& json) {
    const JsonField root{json, {}};
    checkVersion(root, "physvib_words", translationFormatVersion);
    root.expectObject({"physvib_words", "name", "language", "in_english", "texts"});
    Translation words{root["name"].text(),
                      root["language"].text(),
                      root.has("in_english") ? root["in_english"].text() : root["name"].text(),
                      {}};
    root["texts"].expectObject();
    for (const auto& [english, text] : json["texts"].items()) {
        const JsonField field = root["texts"][english.c_str()];
        words.texts.emplace(english, field.text());
        if (findNames(english) != findNames(words.texts[english]))
            field.fail("expected the same names in braces as in the English text");
    }
    return words;
}

} // namespace

Result<Translation> readTranslation(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxProtocolFileBytes, readTranslationRoot);
}

const std::vector<Translation>& builtInTranslations() {
    static const std::vector<Translation> all = readEmbedded(embeddedWords(), readTranslation);
    return all;
}

Result<Translation> findTranslation(const std::string& nameOrPath) {
    if (isJsonPath(nameOrPath)) return loadText(nameOrPath, limits::maxProtocolFileBytes, readTranslation);
    if (nameOrPath.empty() || nameOrPath == "en") return Translation{};
    const auto& all = builtInTranslations();
    const auto found = std::ranges::find(all, nameOrPath, &Translation::name);
    if (found != all.end()) return *found;
    std::string names = "en";
    for (const Translation& words : all) names += ", " + words.name;
    return Failure{"no words " + inQuotes(nameOrPath) + "; expected " + names + " or a file"};
}

} // namespace physvib

// SPDX-License-Identifier: GPL-3.0-or-later
// Parses option values; each reader returns what it expected, and the parser adds the option's name.
#include "Calls/RenderWords.h"
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include "Lab/Study/Stimulus.h"
#include <algorithm>

namespace physvib {
namespace {

std::string readField(const std::string& word, FieldSize& field) {
    const auto read = parseField(word);
    if (!read) return std::string{expectedField} + inQuotes(word);
    field = *read;
    return {};
}

std::string readSettings(const std::vector<std::string>& words, SceneSettings& settings) {
    for (const std::string& word : words) {
        const auto equals = word.find('=');
        if (equals == 0 || equals == std::string::npos) return "expected NAME=VALUE";
        settings.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    }
    return {};
}

std::string readSounds(const std::vector<std::string>& words, RecordedSounds& sounds) {
    for (const std::string& word : words) {
        const auto equals = word.find('=');
        const auto hz = parseNumber<double>(std::string_view{word}.substr(0, equals));
        if (equals == std::string::npos || equals == 0 || equals + 1 == word.size() || (hz && !(*hz > 0.0)))
            return "expected MATERIAL=FILE.wav, a material and its recorded contact, or HZ=FILE.wav, its "
                   "frequency";
        const RecordedSound sound{hz ? "" : word.substr(0, equals), hz.value_or(0.0),
                                  word.substr(equals + 1)};
        const auto isSame = [&](const RecordedSound& other) { return other.name() == sound.name(); };
        if (std::ranges::any_of(sounds, isSame))
            return "expected one recording of " + sound.name() + ", found another";
        sounds.push_back(sound);
    }
    return {};
}

std::string readLaw(const std::string& word, PanningLaw& law) {
    return panningLawNamed(word, law)
               ? std::string{}
               : "expected " + listed(panningLawNames, " or ") + ", found " + inQuotes(word);
}

std::string readMethod(const std::string& word, RenderJob& job) {
    job.playsRecordings = word == "SV";
    if (job.playsRecordings || renderingMethodNamed(word, job.method)) return {};
    return "expected a name from AV-FV-DRV to AF-FF-DRF, or SV, found " + inQuotes(word);
}

} // namespace

Option& addLaw(OptionTable& command, PanningLaw& law) {
    const auto read = [&law](const std::string& word) { return readLaw(word, law); };
    return command.addRead(stimulusWords::law, std::string{nameOf(law)}, read,
                           "panning law: " + listed(panningLawNames));
}

Option& addSounds(OptionTable& command, RecordedSounds& sounds, std::string says) {
    const WordsReader read = [&sounds](const std::vector<std::string>& words) {
        return readSounds(words, sounds);
    };
    return command.addRow("--sound", read, std::move(says)).as("MATERIAL=FILE.wav").single();
}

Option& addField(OptionTable& command, FieldSize& field) {
    const auto read = [&field](const std::string& word) { return readField(word, field); };
    return command
        .addRead("--field", {}, read,
                 "metres that x and y span (scene: its field; events: as they say, or the layout's extent)")
        .as("W,H");
}

Option& addSettings(OptionTable& command, SceneSettings& settings) {
    const WordsReader read = [&settings](const std::vector<std::string>& words) {
        return readSettings(words, settings);
    };
    return command.addRow("--set", read, "a variable of the scene; may be repeated")
        .as("NAME=VALUE")
        .single();
}

Option& addMethod(OptionTable& command, RenderJob& job) {
    const auto read = [&job](const std::string& word) { return readMethod(word, job); };
    return command.addRead("--method", job.methodName(), read,
                           "A{V,F}-F{V,F}-DR{V,F}: amplitude, frequency, decay varied by physics or fixed; "
                           "or SV, recorded contacts");
}

} // namespace physvib

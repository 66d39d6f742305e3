// SPDX-License-Identifier: GPL-3.0-or-later
// Beside the parts that were played, so that the recording and its events stay as they are.
#include "Mixer/Output/KeptPart.h"
#include "Io/Disk/AtomicFile.h"
#include <cmath>

namespace physvib {
namespace {

constexpr const char *fromField = "from_s", *toField = "to_s", *ofField = "of_s";
constexpr double sameLength = 1e-6; // as written in text

juce::File fileOf(const juce::File& take) {
    return partsFolder(take).getChildFile(take.getFileNameWithoutExtension() + ".json");
}

} // namespace

juce::File partsFolder(const juce::File& take) { return take.getSiblingFile("parts"); }

// The length is kept as well, because a later recording may have the name of one that is gone.
juce::Range<double> keptPart(const juce::File& take, double seconds) {
    const juce::Range<double> whole{0.0, seconds};
    const auto kept = juce::JSON::parse(fileOf(take).loadFileAsString());
    const auto field = [&](const char* name) { return static_cast<double>(kept.getProperty(name, -1.0)); };
    const double from = field(fromField), to = field(toField);
    const bool isOfThisTake = std::abs(field(ofField) - seconds) <= sameLength;
    return isOfThisTake && from >= 0.0 && from < to && to <= seconds ? juce::Range{from, to} : whole;
}

std::string keepPart(const juce::File& take, double seconds, juce::Range<double> part) {
    const auto file = fileOf(take);
    if (part == juce::Range{0.0, seconds})
        return !file.existsAsFile() || file.deleteFile()
                   ? std::string{}
                   : file.getFullPathName().toStdString() + ": cannot be deleted";
    auto* const fields = new juce::DynamicObject; // owned by the value below
    const juce::var kept{fields};
    fields->setProperty(fromField, part.getStart());
    fields->setProperty(toField, part.getEnd());
    fields->setProperty(ofField, seconds);
    file.getParentDirectory().createDirectory();
    return writeFile(file.getFullPathName().toStdString(),
                     juce::JSON::toString(kept, true, 15).toStdString() + "\n");
}

} // namespace physvib

// SPDX-License-Identifier: GPL-3.0-or-later
// Loads pictures for participants. Picture files are untrusted, so their size is checked before decoding.
#include "Mixer/Studies/StudyLooks.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/ProtocolFile.h"
#include <algorithm>

namespace physvib {
namespace {

constexpr std::size_t mostPictureBytes = 16'000'000;
constexpr unsigned mostPixels = 4096; // maximum width and height

/// Reads a side of a PNG: a big-endian number after its signature.
unsigned sideAt(const std::string& png, std::size_t at) {
    unsigned side = 0;
    for (std::size_t i = at; i < at + 4; ++i) side = 256 * side + static_cast<unsigned char>(png[i]);
    return side;
}

bool isSmallPng(const std::string& text) {
    constexpr std::string_view begin{"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16};
    if (text.size() < 24 || !text.starts_with(begin)) return false;
    return std::ranges::all_of(std::initializer_list<unsigned>{sideAt(text, 16), sideAt(text, 20)},
                               [](unsigned side) { return side > 0 && side <= mostPixels; });
}

} // namespace

Result<std::vector<MaterialPicture>> materialPictures(const Protocol& protocol,
                                                      const std::string& participant) {
    std::vector<MaterialPicture> pictures;
    for (std::size_t i = 0; i < protocol.pictures.size(); ++i) {
        const std::string at = "pictures[" + std::to_string(i) + "].file: ",
                          path = picturePath(protocol.pictures[i], participant);
        if (auto fault = linkFault(protocol.folder, path); !fault.empty()) return Failure{at + fault};
        const auto text = readFile(besideProtocol(protocol.folder, path), mostPictureBytes);
        if (!text) return Failure{at + text.error};
        auto image = isSmallPng(text.value)
                         ? juce::ImageFileFormat::loadFrom(text.value.data(), text.value.size())
                         : juce::Image{};
        if (image.isNull())
            return Failure{at + path + ": expected a PNG picture of at most " + std::to_string(mostPixels) +
                           " x " + std::to_string(mostPixels) + " pixels"};
        pictures.push_back({protocol.pictures[i].material, std::move(image)});
    }
    return pictures;
}

std::string displayScaleFault(const Protocol& protocol, double displayWidthMetres) {
    if (displayWidthMetres > 0.0) return {};
    for (const ConditionPlan& condition : protocol.conditions)
        if (const auto* const world = std::get_if<WorldSet>(&condition.stimuli);
            world != nullptr && world->displayScale > 0.0)
            return "condition " + printable(condition.name) +
                   ": display_scale: expected the width of the display to be set in the mixer's menu, as 1:" +
                   numberText(world->displayScale) + " is measured on it";
    return {};
}

} // namespace physvib
